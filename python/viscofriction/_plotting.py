"""Pictures, where matplotlib is installed."""

from __future__ import annotations

from typing import Any

import numpy as np

LABELS = {
    "velocity": "speed [m/s]",
    "normal_force": "normal force [N]",
    "indentation_depth": "depth [m]",
    "duration": "duration [s]",
    "sliding_distance": "sliding distance [m]",
}


def axes(ax: Any) -> Any:
    """These axes, or new ones."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as pyplot

    return pyplot.subplots()[1]


def plot(answer: Any, ax: Any) -> Any:
    """Friction, or where nothing slides the depth, over what varies; the pressure of a single scene."""
    if answer.shape == ():
        return pressure(answer, axes(ax))
    values, errors, label = answer.mu, answer.mu_error, "friction coefficient"
    if values is None:
        values, errors, label = answer.indentation_depth, answer.indentation_depth_error, "depth [m]"
    if values is None or errors is None:
        raise ValueError("there is no friction and no depth to draw")
    varied = [name for name, load in answer.loads.items() if np.unique(load).size > 1]
    name = varied[0] if varied else next(iter(answer.loads))
    where = np.ravel(answer.loads[name])
    ax = axes(ax)
    order = np.argsort(where, kind="stable")
    bars = {"yerr": np.ravel(errors)[order], "capsize": 2, "marker": "o", "markersize": 3}
    line = "-" if len(varied) < 2 else "none"
    ax.errorbar(where[order], np.ravel(values)[order], linestyle=line, **bars)
    if where.min() > 0 and where.max() > 30 * where.min():
        ax.set_xscale("log")
    ax.set_xlabel(LABELS[name])
    ax.set_ylabel(label)
    return ax


def pressure(answer: Any, ax: Any) -> Any:
    """Pressure on the half space, with the direction of motion; load along a line; pressure across a cylinder."""
    answers = answer._single()
    for name, label in (("line_load", "load per length [N/m]"), ("line_pressure", "pressure [Pa]")):
        if name in answers:
            ax.plot(answers[name][:, 0], answers[name][:, 1])
            ax.set_xlabel("x [m]")
            ax.set_ylabel(label)
            return ax
    image = ax.pcolormesh(answer.x, answer.y, answer.pressure.T, shading="nearest", cmap="magma")
    ax.figure.colorbar(image, ax=ax, label="pressure [Pa]")
    ax.set_aspect("equal")
    if answer.mu is not None:
        ax.annotate(
            "",
            xy=(0.3, 0.06),
            xytext=(0.06, 0.06),
            xycoords="axes fraction",
            arrowprops={"arrowstyle": "->", "color": "white"},
        )
        ax.text(0.06, 0.09, "motion", color="white", transform=ax.transAxes)
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    return ax
