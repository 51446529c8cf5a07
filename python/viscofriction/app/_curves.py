"""The picture of a computation: in the page by plotly, which zooms and tells what was clicked, and in files by the package."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._friction import MeasuredFriction
from .._plotting import COLOURS, axes, label
from .._sweeping import Sweep

SPEED, TEMPERATURE, FRICTION = "load.velocity", "material.file.temperature", "friction_coefficient"
#: Beside friction: the column, what the legend says, and dash, width and opacity of the line.
BESIDE = (
    ("friction_from_hysteresis", "hysteresis", "dot", 1.5, 0.9),
    ("friction_from_shear", "shear", "dash", 1.5, 0.9),
    ("persson_friction_coefficient_2006", "theory (Persson 2006)", "longdash", 1.0, 0.7),
)
FREE = {"paper_bgcolor": "rgba(0,0,0,0)", "plot_bgcolor": "rgba(0,0,0,0)", "margin": {"l": 50, "r": 10, "t": 10, "b": 40}}


def plotly(sweeps: Mapping[str, Sweep], measured: MeasuredFriction | None) -> dict[str, Any]:
    """Friction with its bars, parts, band and theory over the speed, a colour for each temperature; measured friction is grey.

    A point holds its part of the computation and its row.
    """
    traces = [trace for part, sweep in sweeps.items() for trace in _of_part(part, sweep)]
    if measured is not None:
        temperatures = [None] if measured.temperature is None else np.unique(measured.temperature).tolist()
        for nth, one in enumerate(temperatures):
            chosen = np.full(measured.mu.size, True) if measured.temperature is None else measured.temperature == one
            trace = _line("measured" + ("" if one is None else f", {one:g} °C"), measured.velocity[chosen], measured.mu[chosen])
            trace |= {"mode": "markers", "marker": {"color": "#888888", "symbol": ("x", "diamond", "square", "star")[nth % 4], "size": 8}}
            errors = None if measured.standard_error is None else measured.standard_error[chosen]
            traces.append(trace | _bars(errors, "#888888"))
    axis = {"gridcolor": "rgba(128,128,128,0.3)", "zeroline": False, "automargin": True}
    layout = {
        "xaxis": axis | {"type": "log", "title": {"text": label(SPEED)}, "exponentformat": "power"},
        "yaxis": axis | {"title": {"text": label(FRICTION)}, "rangemode": "tozero", "hoverformat": ".4g"},
        "legend": {"orientation": "h", "y": -0.25},
        # The zoom stays while the picture grows.
        "uirevision": "same",
        "height": 480,
    }
    return {"data": traces, "layout": layout | FREE, "config": {"displaylogo": False, "displayModeBar": False}}


def curves(sweep: Sweep) -> Iterator[tuple[str, NDArray[np.int64], str]]:
    """Of each curve of a sweep what it is of, the rows of its points, and its colour."""
    if TEMPERATURE not in sweep.keys:
        yield "μ", np.arange(len(sweep)), COLOURS[0]
        return
    for nth, temperature in enumerate(np.unique(sweep[TEMPERATURE])):
        yield f"{temperature:g} °C", np.flatnonzero(sweep[TEMPERATURE] == temperature), COLOURS[nth % len(COLOURS)]


def points(sweeps: Mapping[str, Sweep]) -> dict[tuple[str, int], str]:
    """All points by their part and row, with what a list of them says."""
    found = {}
    for part, sweep in sweeps.items():
        for name, row in ((name, row) for name, rows, _ in curves(sweep) for row in rows):
            no_answer = "" if np.isfinite(sweep[FRICTION][row]) else " (no answer)"
            found[part, int(row)] = f"{sweep[SPEED][row]:g} m/s, {name}{_beside(part)}{no_answer}"
    return found


def _beside(part: str) -> str:
    return ", without heat" if part.endswith("-without-heat") else ""


def _of_part(part: str, sweep: Sweep) -> Iterator[dict[str, Any]]:
    known = sweep.to_dict()
    for name, rows, colour in curves(sweep):
        name, speed, friction = name + _beside(part), sweep[SPEED][rows], sweep[FRICTION][rows]
        band = sweep[f"{FRICTION}_material_error"][rows] if f"{FRICTION}_material_error" in known else None
        if band is not None:
            ends = np.concatenate([friction - band, (friction + band)[::-1]])
            around = _line(name, np.concatenate([speed, speed[::-1]]), ends)
            yield around | {"fill": "toself", "fillcolor": colour, "opacity": 0.2, "mode": "none", "hoverinfo": "skip", "showlegend": False}
        style = {"color": colour, "width": 1.5 if _beside(part) else 2, "dash": "dashdot" if _beside(part) else "solid"}
        of_point = {"customdata": [[part, int(row)] for row in rows], "marker": {"size": 9}, "mode": "lines+markers"}
        yield _line(name, speed, friction) | {"line": style} | of_point | _bars(sweep[f"{FRICTION}_error"][rows], colour)
        for column, what, dash, width, opacity in () if _beside(part) else BESIDE:
            if column in known:
                line = {"color": colour, "dash": dash, "width": width}
                yield _line(f"{name}, {what}", speed, sweep[column][rows]) | {"line": line, "opacity": opacity, "mode": "lines"}


def _line(name: str, x: NDArray[np.float64], y: NDArray[np.float64]) -> dict[str, Any]:
    return {"name": name, "x": x.tolist(), "y": _plain(y)}


def _bars(errors: NDArray[np.float64] | None, colour: str) -> dict[str, Any]:
    return {} if errors is None else {"error_y": {"type": "data", "color": colour, "width": 4, "array": _plain(errors)}}


def _plain(values: NDArray[np.float64]) -> list[float | None]:
    return [value if np.isfinite(value) else None for value in values.tolist()]


def new_axes(size: tuple[float, float] = (6.0, 4.0)) -> Any:
    """Axes of a picture of their own, which any thread may draw."""
    from matplotlib.figure import Figure

    ax = Figure(figsize=size, layout="constrained").subplots()
    ax.set_prop_cycle(color=COLOURS)
    return axes(ax)


def drawn(sweeps: Mapping[str, Sweep], measured: MeasuredFriction | None) -> Any:
    """The picture for files, as axes of matplotlib."""
    ax = new_axes((8.0, 6.0))
    for part, sweep in sweeps.items():
        ax.set_prop_cycle(color=COLOURS)
        if len(sweep) and _beside(part):
            sweep.plot(ax, name="without heat", style="-.", parts=False)
        elif len(sweep):
            sweep.plot(ax, measured=measured)
    return ax


def picture(ax: Any, ends: str = "png") -> bytes:
    """The picture of these axes as a file: "png" or "svg"."""
    out = io.BytesIO()
    ax.figure.savefig(out, format=ends, dpi=130)
    return out.getvalue()
