"""The picture of a computation: in the page by plotly, which zooms and tells what was clicked, and in files by the package."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._friction import MeasuredFriction
from .._plotting import COLOURS, label, new_axes
from .._sweeping import Sweep

SPEED, TEMPERATURE, FRICTION = "load.velocity", "material.file.temperature", "friction_coefficient"
#: Beside friction: the column, what the legend says, the dash of the line, and the mark of a single point.
BESIDE = (
    ("friction_from_hysteresis", "hysteresis", "dot", "triangle-down-open"),
    ("friction_from_shear", "shear", "dash", "triangle-up-open"),
    ("persson_friction_coefficient_2006", "theory (Persson 2006)", "longdash", "circle-open"),
)
FREE, GREY = "rgba(0,0,0,0)", "#888888"
#: In the place of axes without points.
EMPTY = {"text": "Choose a material, a body<br>and a load, then Compute:<br>friction over the speed is drawn here.", "showarrow": False, "font": {"size": 15}}


def plotly(sweeps: Mapping[str, Sweep], measured: MeasuredFriction | None) -> dict[str, Any]:
    """Friction with its bars, parts, band and theory over the speed, and what was measured, in a colour for each temperature.

    A point holds its part of the computation and its row.
    """
    traces = [trace for part, sweep in sweeps.items() for trace in _of_part(part, sweep)]
    if measured is not None:
        colours = {name: colour for sweep in sweeps.values() for name, _, colour in curves(sweep)}
        temperatures = np.full(measured.mu.size, np.nan) if measured.temperature is None else measured.temperature
        for nth, one in enumerate(np.unique(temperatures).tolist()):
            chosen, name = np.equal(temperatures, one) | np.isnan(one), "" if np.isnan(one) else f"{one:g} °C"
            trace = _line(", ".join(filter(None, ["measured", name])), measured.velocity[chosen], measured.mu[chosen])
            colour = colours.get(name, GREY)
            trace |= {"mode": "markers", "marker": {"color": colour, "symbol": ("x", "diamond", "square", "star")[nth % 4], "size": 8}}
            traces.append(trace | _bars(None if measured.standard_error is None else measured.standard_error[chosen], colour))
    axis = {"visible": bool(traces), "gridcolor": "rgba(128,128,128,0.3)", "zeroline": False, "automargin": True}
    layout = {
        "xaxis": axis | {"type": "log", "title": {"text": label(SPEED)}, "exponentformat": "power"},
        "yaxis": axis | {"title": {"text": label(FRICTION)}, "rangemode": "tozero", "hoverformat": ".4g"},
        "legend": {"orientation": "h", "y": 1.02, "yanchor": "bottom"},
        "annotations": [] if traces else [EMPTY | {"xref": "paper", "yref": "paper"}],
        # The zoom stays while the picture grows.
        **{"uirevision": "same", "paper_bgcolor": FREE, "plot_bgcolor": FREE, "margin": {"l": 50, "r": 10, "t": 10, "b": 40}},
    }
    return {"data": traces, "layout": layout, "config": {"displaylogo": False, "displayModeBar": False}}


def curves(sweep: Sweep) -> Iterator[tuple[str, NDArray[np.int64], str]]:
    """Of each curve of a sweep the temperature, if there is one, the rows of its points, and its colour."""
    if TEMPERATURE not in sweep.keys:
        yield "", np.arange(len(sweep)), COLOURS[0]
        return
    for nth, temperature in enumerate(np.unique(sweep[TEMPERATURE])):
        yield f"{temperature:g} °C", np.flatnonzero(sweep[TEMPERATURE] == temperature), COLOURS[nth % len(COLOURS)]


def points(sweeps: Mapping[str, Sweep]) -> dict[tuple[str, int], str]:
    """All points by their part and row, with what a list of them says."""
    named = {part: (f"{_beside(part)}, " if _beside(part) else "", sweep.points) for part, sweep in sweeps.items()}
    return {(part, row): begin + text for part, (begin, texts) in named.items() for row, text in enumerate(texts)}


def notes(sweeps: Mapping[str, Sweep]) -> list[str]:
    """The warnings of the points, and why others have no answer."""
    return [": ".join(filter(None, [_beside(part), note])) for part, sweep in sweeps.items() for note in sweep.notes]


def _beside(part: str) -> str:
    return "without heat" if part.endswith("-without-heat") else ""


def _of_part(part: str, sweep: Sweep) -> Iterator[dict[str, Any]]:
    known, texts = sweep.to_dict(), points({part: sweep})
    for name, rows, colour in curves(sweep):
        name, speed, friction = ", ".join(filter(None, [name or "μ", _beside(part)])), sweep[SPEED][rows], sweep[FRICTION][rows]
        band = sweep[f"{FRICTION}_material_error"][rows] if f"{FRICTION}_material_error" in known else None
        if band is not None:
            ends = np.concatenate([friction - band, (friction + band)[::-1]])
            around = _line(name, np.concatenate([speed, speed[::-1]]), ends)
            yield around | {"fill": "toself", "fillcolor": colour, "opacity": 0.2, "mode": "none", "hoverinfo": "skip", "showlegend": False}
        style = {"color": colour, "width": 1.5 if _beside(part) else 2, "dash": "dashdot" if _beside(part) else "solid"}
        of_point = {"customdata": [[part, int(row)] for row in rows], "text": [texts[part, int(row)] for row in rows]}
        look = {"line": style, "marker": {"size": 9}, "mode": "lines+markers", "hovertemplate": "%{text}<extra></extra>"}
        yield _line(name, speed, friction) | look | of_point | _bars(sweep[f"{FRICTION}_error"][rows], colour)
        for column, what, dash, symbol in () if _beside(part) else BESIDE:
            if column in known:
                line = {"line": {"color": colour, "dash": dash, "width": 1.5}, "marker": {"size": 13, "symbol": symbol}, "cliponaxis": False}
                # A line through a single point would be invisible.
                yield _line(f"{name}, {what}", speed, sweep[column][rows]) | line | {"mode": "markers" if rows.size == 1 else "lines"}


def _line(name: str, x: NDArray[np.float64], y: NDArray[np.float64]) -> dict[str, Any]:
    return {"name": name, "x": x.tolist(), "y": _plain(y)}


def _bars(errors: NDArray[np.float64] | None, colour: str) -> dict[str, Any]:
    return {} if errors is None else {"error_y": {"type": "data", "color": colour, "width": 4, "array": _plain(errors)}}


def _plain(values: NDArray[np.float64]) -> list[float | None]:
    return [value if np.isfinite(value) else None for value in values.tolist()]


def drawn(sweeps: Mapping[str, Sweep], measured: MeasuredFriction | None) -> Any:
    """The picture for files, as axes of matplotlib."""
    ax = new_axes((8.0, 6.0))
    for part, sweep in sweeps.items():
        ax.set_prop_cycle(color=COLOURS)
        options: dict[str, Any] = {"name": "without heat", "style": "-.", "parts": False} if _beside(part) else {"measured": measured}
        if len(sweep):
            sweep.plot(ax, **options)
    return ax
