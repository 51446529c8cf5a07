"""Pictures, where matplotlib is installed."""

from __future__ import annotations

import base64
import html
import io
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._results import QUANTITIES

Numbers = NDArray[np.float64]
Values = NDArray[Any]

# Numbers of a scene, and the quantities of an answer.
LABELS = {name: label for name, (label, _) in QUANTITIES.items()} | {
    "velocity": "speed v [m/s]",
    "stroke": "stroke [m]",
    "frequency": "frequency f [1/s]",
    "track": "track L [m]",
    "duration": "duration t [s]",
    "sliding_distance": "sliding distance s [m]",
    "radius": "radius R [m]",
    "thickness": "thickness h [m]",
    "temperature": "temperature T [°C]",
    "shortest_wavelength": "shortest wavelength [m]",
}
# The program draws in the same colours: those of Okabe and Ito, and viridis.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#aa3377", "#000000"]
FIELD = "viridis"
# Units that take a prefix, so that lengths stand in mm, µm or nm, and the prefixes from 10⁻¹² on.
PREFIXED = {"m", "s", "m/s", "N", "Pa", "N/m"}
PREFIXES = ["p", "n", "µ", "m", "", "k", "M", "G"]
# Part of the load on elements of the darkest colour, where colours are logarithmic.
DARKEST = 0.01
# With more lines than these a legend says nothing.
LINES = 6
# Heights along an edge of a picture: those between them are left out, because each takes some 200 bytes while it is drawn.
MOST_DRAWN = 1000
# Beside friction: the key in a table, what the legend says, and the line.
BESIDE: tuple[tuple[str, str, Any], ...] = (
    ("friction_from_hysteresis", "hysteresis", ":"),
    ("friction_from_shear", "shear", "--"),
    ("persson_friction_coefficient_2006", "Persson (2006)", (0, (8, 3))),
)


def axes(ax: Any) -> Any:
    """These axes, or new ones."""
    if ax is None:
        import matplotlib.pyplot as pyplot

        ax = pyplot.subplots(layout="constrained")[1]
        ax.set_prop_cycle(color=COLOURS)
    return ax


def new_axes(size: tuple[float, float] = (6.0, 4.0)) -> Any:
    """Axes of a picture of their own, which any thread may draw."""
    from matplotlib.figure import Figure

    ax = Figure(figsize=size, layout="constrained").subplots()
    ax.set_prop_cycle(color=COLOURS)
    return ax


def file_of(ax: Any, ends: str = "png") -> bytes:
    """The picture of axes as a file: "png" or "svg"."""
    out = io.BytesIO()
    ax.figure.savefig(out, format=ends, dpi=130)
    return out.getvalue()


def image(ax: Any, meaning: str) -> str:
    """The picture of axes as a part of a page, with the words in its place for who does not see it."""
    return f'<img alt="{html.escape(meaning)}" src="data:image/png;base64,{base64.b64encode(file_of(ax)).decode()}">'


def label(name: str) -> str:
    """What is written at an axis; a key of a scene ends with the name of its quantity."""
    last = name.rsplit(".", 1)[-1]
    return LABELS.get(last, name if last == name else f"{name} [SI]")


def tidy(ax: Any, x: str, y: str, varied: tuple[Numbers | None, Numbers | None]) -> Any:
    """Names the axes, makes those logarithmic that vary so, and keeps the digits of the others few."""
    for axis, values, name in (("x", varied[0], x), ("y", varied[1], y)):
        if values is not None and values.min() > 0 and values.max() > 30 * values.min():
            getattr(ax, f"set_{axis}scale")("log")
        else:
            name = few(ax, axis, name)
        getattr(ax, f"set_{axis}label")(name)
    return ax


def few(ax: Any, axis: str, name: str) -> str:
    """Keeps the digits of an axis few, by a prefix of the unit or a power of ten; returns its label."""
    ax.locator_params(axis=axis, nbins=6)
    factor, name = prefixed(name, getattr(ax, f"get_{axis}lim")())
    if factor is None:
        ax.ticklabel_format(axis=axis, style="sci", scilimits=(-3, 4), useMathText=True)
    else:
        getattr(ax, f"{axis}axis").set_major_formatter(in_units_of(factor))
    return name


def in_units_of(factor: float) -> Any:
    """A formatter of ticks."""
    from matplotlib.ticker import FuncFormatter

    return FuncFormatter(lambda value, _: f"{value / factor:.6g}".replace("-", "−"))


def prefixed(name: str, limits: tuple[float, float]) -> tuple[float | None, str]:
    """What the numbers of an axis count in, and its label with the prefix; None where the unit takes none."""
    quantity, bracket, unit = name.removesuffix("]").rpartition("[")
    largest = max(map(abs, limits))
    if not bracket or unit not in PREFIXED or not largest > 0:
        return None, name
    step = min(max(math.floor((math.log10(largest) + 1e-9) / 3), -4), 3)
    return 10.0 ** (3 * step), f"{quantity}[{PREFIXES[step + 4]}{unit}]"


def plot(answer: Any, ax: Any) -> Any:
    """Friction, or where nothing slides the depth, over what varies; the pressure or the history of a single scene."""
    if answer.shape == ():
        return single(answer, axes(ax))
    values, errors, quantity = answer.mu, answer.mu_error, "friction_coefficient"
    if values is None:
        values, errors, quantity = answer.indentation_depth, answer.indentation_depth_error, "indentation_depth"
    if values is None or errors is None:
        raise ValueError("there is no friction and no depth to draw")
    loads = {name: np.ravel(load) for name, load in answer.loads.items()}
    counts = {name: np.unique(load).size for name, load in loads.items()}
    # Over what has the most values; one line for each combination of the others.
    over = max(counts, key=lambda name: counts[name])
    others = {name: load for name, load in loads.items() if name != over and counts[name] > 1}
    return lines(axes(ax), (over, loads[over]), others, (quantity, np.ravel(values), np.ravel(errors)))


@dataclass(frozen=True)
class Beside:
    """What stands beside the lines of a quantity.

    ``band``: Half the width of a band around each line.
    ``curves``: Curves in the colour of each line: what the legend says, the line of matplotlib, and the values.
    ``name``: What the legend says of all lines.
    ``style``: Of the lines, as matplotlib has it.
    """

    band: Numbers | None = None
    curves: tuple[tuple[str, Any, Numbers], ...] = ()
    name: str = ""
    style: str = "-"


def table(ax: Any, keys: dict[str, Values], drawn: tuple[str, Numbers, Numbers], beside: Beside) -> Any:
    """A quantity over the key with the most numbers: a line for each combination of the others, or colours over two."""
    counts = {name: np.unique(values).size if values.dtype.kind == "f" else 0 for name, values in keys.items()}
    over = max(counts, key=lambda name: counts[name])
    if counts[over] == 0:
        raise ValueError("no key that varies has numbers")
    others = {name: values for name, values in keys.items() if name != over}
    if len(set(families(others, keys[over].size))) <= LINES:
        return lines(ax, (over, keys[over]), others, drawn, beside)
    if len(others) == 1 and all(counts.values()):
        return grid(ax, list(keys.items()), drawn[:2])
    raise ValueError(f"the keys beside {over} have more than {LINES} combinations, and the picture would say nothing")


def families(others: dict[str, Values], count: int) -> list[str]:
    """What each point has in common with others of its line."""

    def named(name: str, value: Any) -> str:
        return f"{name.rsplit('.', 1)[-1]}: {value}" if isinstance(value, str) else f"{label(name)}: {value:.4g}"

    return [", ".join(named(name, values[index]) for name, values in others.items()) for index in range(count)]


def lines(
    ax: Any,
    over: tuple[str, Numbers],
    others: dict[str, Values],
    drawn: tuple[str, Numbers, Numbers],
    beside: Beside = Beside(),
) -> Any:
    """A quantity with its bars over another, one line for each combination of the others."""
    (name, where), (quantity, values, errors) = over, drawn
    of = np.array(families(others, where.size))
    distinct = list(dict.fromkeys(of.tolist()))
    # Of several sweeps in one picture, colours and kinds of lines are named once.
    known = ax.get_legend_handles_labels()[1]
    for family in distinct:
        of_family = np.flatnonzero(of == family)
        order = of_family[np.argsort(where[of_family], kind="stable")]
        bars = ax.errorbar(
            where[order],
            values[order],
            yerr=errors[order],
            capsize=2,
            marker="o",
            markersize=3,
            linestyle=beside.style,
            label=None if family in known else family or None,
        )
        colour = bars.lines[0].get_color()
        if beside.band is not None:
            edges = values[order] - beside.band[order], values[order] + beside.band[order]
            ax.fill_between(where[order], *edges, color=colour, alpha=0.2, linewidth=0)
        for _, style, curve in beside.curves:
            ax.plot(where[order], curve[order], linestyle=style, color=colour, linewidth=1)
    for what, style in [(beside.name, beside.style), *(curve[:2] for curve in beside.curves)]:
        if what and what not in known:
            ax.plot([], [], linestyle=style, color="0.4", linewidth=1, label=what)
    if 1 < len(distinct) <= LINES or beside.name or beside.curves:
        legend(ax)
    return tidy(ax, label(name), label(quantity), (where, None))


def legend(ax: Any) -> None:
    """A legend in the picture, or at its right where that would cover the lines."""
    is_long = len(ax.get_legend_handles_labels()[1]) > LINES
    ax.legend(**({"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)} if is_long else {}))


def grid(ax: Any, over: list[tuple[str, Numbers]], drawn: tuple[str, Numbers]) -> Any:
    """A quantity over two others, the second fastest, as colours."""
    (first, x), (second, y) = ((name, np.unique(values)) for name, values in over)
    places = tuple(np.searchsorted(axis, values) for axis, (_, values) in zip((x, y), over, strict=True))
    values = np.full((x.size, y.size), np.nan)
    values[places] = drawn[1]
    image = ax.pcolormesh(x, y, values.T, shading="nearest", cmap=FIELD)
    ax.figure.colorbar(image, ax=ax, label=label(drawn[0]))
    return tidy(ax, label(first), label(second), (x, y))


def measured(ax: Any, velocity: Numbers, mu: Numbers, error: Numbers | None, temperature: Numbers | None) -> Any:
    """Measured friction as grey crosses, which are named by their temperature where there are several."""
    temperatures = [None] if temperature is None else np.unique(temperature).tolist()
    for nth, one in enumerate(temperatures):
        chosen = slice(None) if temperature is None else temperature == one
        name = "measured" if one is None else f"measured, {one:g} °C"
        yerr = None if error is None else error[chosen]
        ax.errorbar(velocity[chosen], mu[chosen], yerr, fmt="xv^s+d"[nth % 6], color="0.5", markersize=5, capsize=2, label=name)
    legend(ax)
    return ax


def master_curve(fit: Any, ax: Any) -> Any:
    """The moduli of a fit over the frequency, and the points that were fitted, where they are on its master curve; below them the
    relative errors of the fit."""
    from mpl_toolkits.axes_grid1 import make_axes_locatable

    points = fit.measured
    if points is None or points.angular_frequency is None:
        raise ValueError("a picture belongs to the fit of a table with storage and loss modulus")
    omega = np.geomspace(points.angular_frequency.min(), points.angular_frequency.max(), 200)
    fitted = fit.material.storage_modulus(omega), fit.material.loss_modulus(omega)
    for name, curve, known, colour in zip(("G′", "G″"), fitted, (points.storage, points.loss), COLOURS):
        ax.plot(points.angular_frequency, known, "o", color=colour, markersize=3, fillstyle="none", label=f"{name} measured")
        ax.plot(omega, curve, color=colour, label=name)
    ax.legend()
    shifted = ("angular frequency a_T ω [rad/s]", "modulus G/b_T [Pa]") if fit.shifts else ("angular frequency ω [rad/s]", "modulus G [Pa]")
    tidy(ax, *shifted, (omega, np.concatenate(fitted)))
    if ax.figure.axes == [ax]:
        # A constrained layout leaves no room for the labels of what is appended.
        ax.figure.set_layout_engine("none")
        ax.set_position((0.15, 0.15, 0.82, 0.82))
    below = make_axes_locatable(ax).append_axes("bottom", "30%", pad=0.1, sharex=ax)
    for residuals, colour in zip(fit.residuals, COLOURS):
        below.plot(points.angular_frequency, 100 * residuals, "o", color=colour, markersize=3, fillstyle="none")
    below.axhline(0.0, color="0.5", linewidth=1)
    below.set(xlabel=ax.get_xlabel(), ylabel="error [%]")
    ax.tick_params(labelbottom=False)
    ax.xaxis.label.set_visible(False)
    return ax


def heights(surface: Any, ax: Any) -> Any:
    """A map in its colours, whose summits touch first, with the direction of motion."""
    (rows, columns), (dx, dy) = surface.heights.shape, surface.spacing
    step = max(1, max(rows, columns) // MOST_DRAWN)
    shown = surface.heights[::step, ::step] - np.nanmean(surface.heights)
    image = ax.pcolormesh(dx * np.arange(0, columns, step), dy * np.arange(0, rows, step), shown, shading="nearest", cmap=FIELD)
    _coloured(ax, image, "height z [m]", float(np.nanmax(np.abs(shown))))
    motion(ax)
    return tidy(ax, "x [m]", "y [m]", (None, None))


def _coloured(ax: Any, image: Any, name: str, largest: float) -> None:
    """A field with its bar of colours, as it lies in the plane."""
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import LogLocator

    factor, name = prefixed(name, (0.0, largest))
    # All labels count in the unit of the name, so that a logarithmic bar has no minor ones.
    ticks = LogLocator(subs=(1.0, 2.0, 5.0)) if isinstance(image.norm, LogNorm) else None
    bar = ax.figure.colorbar(image, ax=ax, label=name, format=in_units_of(factor or 1.0), ticks=ticks)
    if ticks is not None:
        bar.minorticks_off()
    ax.set_aspect("equal")


def motion(ax: Any) -> None:
    """An arrow along the direction of motion."""
    arrow = {"arrowstyle": "->"}
    ax.annotate("", xy=(0.3, 0.06), xytext=(0.06, 0.06), xycoords="axes fraction", arrowprops=arrow)
    ax.text(0.06, 0.09, "motion", bbox={"color": "white", "alpha": 0.7, "pad": 1}, transform=ax.transAxes)


def temperature(answer: Any, ax: Any) -> Any:
    """Rise of the temperature of the surface."""
    rise = answer.temperature
    if rise.shape[0] == 1:
        ax.plot(answer.line_pressure[:, 0], rise[0])
        return tidy(ax, "x [m]", "temperature rise [K]", (None, None))
    image = ax.pcolormesh(answer.x, answer.y, rise, shading="nearest", cmap="inferno")
    _coloured(ax, image, "temperature rise [K]", float(rise.max()))
    motion(ax)
    return tidy(ax, "x [m]", "y [m]", (None, None))


def gap(answer: Any, ax: Any) -> Any:
    """Gap between body and elastomer; the contact stays white."""
    if answer.gap.shape[0] == 1:
        ax.plot(answer.gap_x, answer.gap[0])
        return tidy(ax, "x [m]", "gap [m]", (None, None))
    # A gap within the tolerance of the contact solver is none.
    shown = np.ma.masked_less_equal(answer.gap, 1e-5 * answer.gap.max())
    image = ax.pcolormesh(answer.gap_x, answer.gap_y, shown, shading="nearest", cmap=FIELD)
    _coloured(ax, image, "gap [m]", float(answer.gap.max()))
    if answer.mu is not None:
        motion(ax)
    return tidy(ax, "x [m]", "y [m]", (None, None))


def single(answer: Any, ax: Any) -> Any:
    """Pressure on the half space, with the direction of motion; load along a line; pressure across a cylinder; a history."""
    known = answer._single()
    if "motion" in known:
        ax.plot(answer.motion["position"], answer.motion["tangential_force"], marker=".")
        return tidy(ax, "position x [m]", LABELS["tangential_force"], (None, None))
    for name, what in (("line_load", "load per length [N/m]"), ("line_pressure", "pressure [Pa]")):
        if name in known:
            ax.plot(known[name][:, 0], known[name][:, 1])
            return tidy(ax, "x [m]", what, (None, None))
    if "pressure" not in known and "history" in known:
        ax.plot(answer.history["indentation_depth"], answer.history["normal_force"], marker=".")
        return tidy(ax, LABELS["indentation_depth"], LABELS["normal_force"], (None, None))
    pressure = np.ma.masked_less_equal(answer.pressure, 0.0)
    image = ax.pcolormesh(answer.x, answer.y, pressure, shading="nearest", cmap=FIELD, norm=colours(answer, pressure))
    _coloured(ax, image, "pressure P [Pa]", float(pressure.max()))
    if answer.mu is not None:
        motion(ax)
    return tidy(ax, "x [m]", "y [m]", (None, None))


def colours(answer: Any, pressure: Any) -> Any:
    """Linear from zero to a peak that is known; else logarithmic, and darkest where 1 % of the load is."""
    from matplotlib.colors import LogNorm, Normalize

    if answer.peak_pressure is not None:
        return Normalize(0.0, pressure.max())
    loaded = np.sort(pressure.compressed())
    lowest = loaded[np.searchsorted(np.cumsum(loaded), DARKEST * loaded.sum())]
    return LogNorm(min(lowest, 0.4 * loaded[-1]), loaded[-1])
