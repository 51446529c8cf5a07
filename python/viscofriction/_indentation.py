"""Bodies that follow a history of depth or force, and the material behind a measured one."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, columns
from ._bodies import Body
from ._materials import Material, Prony
from ._results import rounded
from ._solving import ask, given

Numbers = NDArray[np.float64]

__all__ = ["Finding", "IndentationFit", "Indentation", "fit_indentation", "indent"]


@dataclass(frozen=True, eq=False, repr=False)
class Indentation(Compared):
    """A history, point by point, and the largest error of each quantity, 0 of what was given; all in SI."""

    #: Time [s], force [N], and depth of the lowest point [m].
    time: Numbers
    normal_force: Numbers
    indentation_depth: Numbers
    #: Absolute errors that hold at every point.
    normal_force_error: float
    indentation_depth_error: float
    #: Radius of the contact [m] of a body of revolution on a half space.
    contact_radius: Numbers | None = None
    contact_radius_error: float | None = None
    #: Work since the first point [J], of the same.
    work: Numbers | None = None
    work_error: float | None = None
    #: Area of the contact [m²] of other bodies, and on layers.
    contact_area: Numbers | None = None
    contact_area_error: float | None = None
    #: Sentences about the validity of the answer.
    warnings: tuple[str, ...] = ()

    def __repr__(self) -> str:
        force, depth = (f"{np.abs(values).max():.4g}" for values in (self.normal_force, self.indentation_depth))
        notes = "".join(f"\n  warning: {text}" for text in self.warnings)
        return f"<indentation of {self.time.size} points, up to {force} N and {depth} m>{notes}"

    def plot(self, ax: Any = None) -> Any:
        """Draws the force over the depth; returns the axes of matplotlib."""
        from . import _plotting

        axes = _plotting.axes(ax)
        axes.plot(self.indentation_depth, self.normal_force, marker=".")
        return _plotting.tidy(axes, "depth [m]", "normal force [N]", (None, None))


@dataclass(frozen=True)
class Finding:
    """What a curve says about one quantity."""

    #: Value and standard error in this unit; None where the curve does not determine it.
    value: float | None
    error: float | None
    unit: str
    #: Ends of the 95 % interval; None on a side on which the curve sets no bound.
    interval: tuple[float | None, float | None]


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Compared):
    """The material behind a curve."""

    #: By name: moduli and times, ``contact_point``, ``baseline`` and ``tilt``.
    findings: Mapping[str, Finding]
    #: Correlation of the errors of the findings in their order (of the logarithms of moduli and times).
    correlation: Numbers
    #: The material, of a power law its expansion over the times of the curve.
    material: Prony
    #: Standard deviation of the force before the contact [N], where there are at least 10 points, and of all points.
    noise: float | None
    residual: float
    #: How many points one independent point stands for.
    correlated_points: float
    #: The points that were fitted [s, m, N], and the force of the fit [N].
    time: Numbers
    depth: Numbers
    force: Numbers
    fitted_force: Numbers
    #: What is doubtful about it.
    flags: tuple[str, ...]

    def __repr__(self) -> str:
        rows = []
        for name, one in self.findings.items():
            known = "not determined"
            if one.value is not None and one.error is not None:
                known = " ± ".join(rounded(one.value, one.error)) + f" {one.unit}".rstrip()
            low, high = ("…" if end is None else f"{end:.4g}" for end in one.interval)
            rows.append(f"  {name}: {known}, 95 % within {low} and {high}")
        return "\n".join(["fit of a curve", *rows, *(f"  flag: {flag}" for flag in self.flags)])

    def plot(self, ax: Any = None) -> Any:
        """Draws the measured force and that of the fit over time; returns the axes of matplotlib."""
        from . import _plotting

        axes = _plotting.axes(ax)
        axes.plot(self.time, self.force, ".", markersize=3, label="measured")
        axes.plot(self.time, self.fitted_force, label="fit")
        axes.legend()
        return _plotting.tidy(axes, "time [s]", "force [N]", (None, None))


def indent(
    body: Body,
    material: Material,
    *,
    time: ArrayLike,
    indentation_depth: ArrayLike | None = None,
    normal_force: ArrayLike | None = None,
    thickness: float | None = None,
    relative_error: float | None = None,
    work: bool = False,
) -> Indentation:
    """Force and contact of a body that follows a history: pressed, held, pulled back, and pressed again.

    Times [s] ≥ 0 that do not decrease, and at each either the depth [m] of the lowest point, negative above the surface, or the
    force [N] ≥ 0; straight from point to point, from an undeformed surface. Of bodies of revolution on a half space all is
    exact up to rounding but the depth under a force that falls, of which ``relative_error`` is asked; with ``work`` that since
    the first point is there too, to 1e-4 of its largest value. Height maps, and all bodies on a layer of a ``thickness`` [m], are followed with boundary elements, to a ``relative_error`` of the
    largest force or depth.

    Raises ValueError for wrong input and NotReached where there is no answer.
    """
    path_of = given(indentation_depth=indentation_depth, normal_force=normal_force)
    if len(path_of) != 1:
        raise ValueError("either indentation_depth or normal_force is needed, one of them")
    [name] = path_of
    times, path = columns(time=time, **path_of)
    scene = {
        "indenter": body,
        "material": material,
        "load": {},
        "layer": None if thickness is None else {"thickness": thickness},
        "solve": {"relative_error": relative_error},
    }
    answer = ask(scene, {}, (), None, history=(name, times, path), fields=work)
    known: dict[str, Any] = answer._single()
    return Indentation(**known["history"], **known["history_errors"], warnings=tuple(answer.warnings))


def fit_indentation(
    time: ArrayLike | str | os.PathLike[str],
    depth: ArrayLike | None = None,
    force: ArrayLike | None = None,
    *,
    body: Body,
    material: str = "standard-solid",
    branches: int | None = None,
    poisson_ratio: float = 0.5,
    tilt: bool = True,
    before_retraction: bool = False,
    profile: bool = True,
    spring_constant: float | None = None,
    sensitivity: float | None = None,
) -> IndentationFit:
    """The material behind a curve of force [N] over depth [m] and time [s], with 95 % intervals.

    Depth grows towards the sample, force is that on the sample; both count from any zero, as contact point, baseline and
    (with ``tilt``) the slope of the baseline are fitted along. Instead of the three arrays the name of a table will do, whose
    columns and units are found; ``spring_constant`` [N/m] and ``sensitivity`` [m/V] are for deflections in it.

    ``material`` is "standard-solid", "prony" with ``branches`` (or as many as the curve tells apart) or "power-law".
    ``before_retraction`` leaves the way back out, on which most bodies stick. ``profile`` takes all intervals from the profile
    likelihood; without it only those that a covariance cannot give, which is faster for maps of many curves. The
    interpreter's lock is released, so that threads fit several curves at a time.

    Raises ValueError for wrong input and for a damaged curve, with the reason.
    """
    request: dict[str, Any] = {
        "body": body._table(),
        "file": None,
        "columns": None,
        "spring_constant": spring_constant,
        "sensitivity": sensitivity,
        "material": material,
        "branches": branches,
        "poisson_ratio": poisson_ratio,
        "tilt": tilt,
        "before_retraction": before_retraction,
        "profile": profile,
    }
    if isinstance(time, str | os.PathLike):
        if depth is not None or force is not None:
            raise ValueError("depth and force: a file has its own")
        request["file"] = os.fspath(time)
    else:
        if depth is None or force is None:
            raise ValueError("depth and force are needed beside time")
        if spring_constant is not None or sensitivity is not None:
            raise ValueError("spring_constant and sensitivity are for files")
        request["columns"] = columns(time=time, depth=depth, force=force)
    found = _native.fit_curve(request)
    findings = {}
    for name, unit, estimate, (lower, upper) in found["findings"]:
        value, error = estimate or (None, None)
        findings[name] = Finding(value, error, unit, (lower, upper))
    material_found = Prony(found["equilibrium_modulus"], found["branches"], poisson_ratio=poisson_ratio)
    seconds, metres, measured, fitted = found["points"]
    return IndentationFit(
        findings,
        np.array(found["correlation"]),
        material_found,
        found["noise"],
        found["residual"],
        found["correlated_points"],
        seconds,
        metres,
        measured,
        fitted,
        tuple(found["flags"]),
    )
