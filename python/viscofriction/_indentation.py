"""Bodies that follow a history of depth or force, and the material behind a measured one."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, columns, count, text_of
from ._bodies import HeightMap, Pyramid
from ._kinds import Cylinder, HeightMapFile, SelfAffine, Spectrum
from ._materials import Prony
from ._results import Answer
from ._solving import ask, given
from ._tables import Body, Material

Numbers = NDArray[np.float64]

__all__ = ["Finding", "IndentationFit", "Indentation", "fit_indentation", "indent"]


@dataclass(frozen=True, eq=False, repr=False)
class Indentation(Compared):
    """A history, point by point, and the largest error of each quantity, 0 of what was given; all in SI.

    ``time``, ``normal_force``, ``indentation_depth``: Time [s], force [N], and depth of the lowest point [m].
    ``normal_force_error``, ``indentation_depth_error``: Absolute errors that hold at every point.
    ``contact_radius``, ``contact_radius_error``: Radius of the contact [m] of a body of revolution on a half space, and on a
    layer where the contact grows and shrinks once.
    ``work``, ``work_error``: Work since the first point [J], of the same.
    ``contact_area``, ``contact_area_error``: Area of the contact [m²] of other bodies and histories.
    ``warnings``: Sentences about the validity of the answer.
    """

    time: Numbers
    normal_force: Numbers
    indentation_depth: Numbers
    normal_force_error: float
    indentation_depth_error: float
    contact_radius: Numbers | None = None
    contact_radius_error: float | None = None
    work: Numbers | None = None
    work_error: float | None = None
    contact_area: Numbers | None = None
    contact_area_error: float | None = None
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
        depth, force = map(_plotting.label, ("indentation_depth", "normal_force"))
        return _plotting.tidy(axes, depth, force, (None, None))


@dataclass(frozen=True)
class Finding:
    """What a curve says about one quantity.

    ``value``, ``error``, ``unit``: Value and standard error in this unit; None where the curve does not determine it.
    ``interval``: Ends of the 95 % interval; None on a side on which the curve sets no bound.
    """

    value: float | None
    error: float | None
    unit: str
    interval: tuple[float | None, float | None]

    def times(self, factor: float) -> Finding:
        """The same of this quantity times a factor, as 2 (1 + ν) makes Young's modulus of a shear modulus."""
        value, error, low, high = (
            None if one is None else factor * one for one in (self.value, self.error, *self.interval)
        )
        return Finding(value, error, self.unit, (low, high))

    def __str__(self) -> str:
        known = "not determined"
        if self.value is not None and self.error is not None:
            known = f"{_native.printed(self.value, self.error)} {self.unit}".rstrip()
        low, high = ("…" if end is None else f"{end:.4g}" for end in self.interval)
        return f"{known}, 95 % within {low} and {high}"


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Compared):
    """The material behind a curve.

    ``findings``: By name: moduli and times, ``contact_point``, ``baseline`` and ``tilt``.
    ``correlation``: Correlation of the errors of the findings in their order (of the logarithms of moduli and times).
    ``material``: The material, of a power law its expansion over the times of the curve.
    ``noise``, ``residual``: Standard deviation of the force before the contact [N], where there are at least 10 points, and of
    all points.
    ``correlated_points``: How many points one independent point stands for.
    ``time``, ``depth``, ``force``, ``fitted_force``: The points that were fitted [s, m, N], and the force of the fit [N].
    ``flags``: What is doubtful about it.
    ``notes``: What was decided or guessed.
    """

    findings: Mapping[str, Finding]
    correlation: Numbers
    material: Prony
    noise: float | None
    residual: float
    correlated_points: float
    time: Numbers
    depth: Numbers
    force: Numbers
    fitted_force: Numbers
    flags: tuple[str, ...]
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        rows = []
        for name, one in self.findings.items():
            rows.append(f"  {name}: {one}")
            if name.startswith("G"):
                rows.append(f"  E{name[1:]}: {one.times(2 * (1 + self.material.poisson_ratio))}")
        sentences = [*(f"  note: {note}" for note in self.notes), *(f"  flag: {flag}" for flag in self.flags)]
        return "\n".join(["fit of a curve", *rows, *sentences])

    def to_dict(self) -> dict[str, Any]:
        """All that is known, under the names of the attributes, as numbers, texts, lists and dictionaries of them."""
        known = {field.name: getattr(self, field.name) for field in fields(self)}
        known["findings"] = {name: asdict(one) for name, one in self.findings.items()}
        known["material"] = self.material._table()
        plain: dict[str, Any] = json.loads(json.dumps(known, default=np.ndarray.tolist))
        return plain

    def plot(self, ax: Any = None) -> Any:
        """Draws the measured force and that of the fit over time; returns the axes of matplotlib."""
        from . import _plotting

        axes = _plotting.axes(ax)
        axes.plot(self.time, self.force, ".", markersize=3, color="0.6", label="measured")
        axes.plot(self.time, self.fitted_force, label="fit")
        axes.legend()
        return _plotting.tidy(axes, "time t [s]", "force F [N]", (None, None))


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
    the first point is there too, to 1e-4 of its largest value. So it is on a layer of a ``thickness`` [m], bonded to a rigid base,
    as long as the contact grows once and then shrinks once. Other histories on a layer, and height maps, are followed with
    boundary elements, to a ``relative_error`` of the largest force or depth.

    Raises ValueError for wrong input and NotReached where there is no answer.
    """
    path_of = given(indentation_depth=indentation_depth, normal_force=normal_force)
    if len(path_of) != 1:
        raise ValueError("either indentation_depth or normal_force is needed, one of them")
    [name] = path_of
    times, path = columns(time=time, **path_of)
    scene = {
        "indenter": _axisymmetric(body),
        "material": material,
        "load": {},
        "layer": None if thickness is None else {"thickness": thickness},
        "solve": {"relative_error": relative_error},
    }
    answer = ask(Answer, scene, {}, (), None, history=(name, times, path), fields=work)
    known: dict[str, Any] = answer._single()
    history, warnings = known["history"] | known["history_errors"], list(answer.warnings)
    if isinstance(body, Pyramid):
        warnings.append("the contact of a pyramid is no disc, so that the way back is an approximation")
        history = {key: value for key, value in history.items() if not key.startswith("contact_")}
    return Indentation(**history, warnings=tuple(warnings))


def _axisymmetric(body: Body) -> Body:
    """The body itself, or the cone for a pyramid."""
    return body.cone if isinstance(body, Pyramid) else body


def _of_revolution(body: Body) -> dict[str, Any]:
    """The table of a body whose force the fit knows."""
    if not isinstance(body, Body):
        raise ValueError(f"body must be a Body of this package, but is {text_of(body)}")
    if isinstance(body, Cylinder | HeightMap | HeightMapFile | SelfAffine | Spectrum):
        known = "Sphere, Paraboloid, Cone, Pyramid, FlatPunch, Power and the others that are round about their axis"
        raise ValueError(f"body must be a body of revolution, but is a {type(body).__name__}; these are: {known}")
    return _axisymmetric(body)._table()


def _measured(curve: Any, spring_constant: float | None) -> list[ArrayLike]:
    """Time, depth and force of a curve with named columns, of the package afmformats, pandas or a dictionary."""
    names = set(getattr(curve, "columns", curve))
    stated = getattr(curve, "metadata", {})

    def column(*known: str) -> Numbers | None:
        found = next((name for name in known if name in names), None)
        return None if found is None else np.asarray(curve[found], dtype=np.float64)

    def missing(what: str) -> ValueError:
        return ValueError(f"{what} is needed; the columns are {', '.join(sorted(map(str, names)))}")

    force, time = column("force"), column("time")
    if force is None:
        raise missing("a column 'force' [N]")
    rate = stated.get("rate approach")
    if time is None and rate:
        time = np.arange(force.size) / rate
    if time is None:
        raise missing("a column 'time' [s]")
    depth, tip = column("depth", "indentation"), column("tip position")
    height = column("height (measured)", "height (piezo)")
    if depth is None and tip is not None:
        depth = -tip
    if depth is None and height is not None:
        stiffness = spring_constant or stated.get("spring constant")
        if not stiffness:
            raise missing("beside the height the spring_constant [N/m]")
        depth = -height - force / stiffness
    elif depth is not None and spring_constant is not None:
        raise ValueError("spring_constant has no effect, because the depth is there: leave it out")
    if depth is None:
        raise missing("a column 'depth', 'tip position' or 'height (measured)' [m]")
    return [time, depth, force]


def fit_indentation(
    time: ArrayLike | str | os.PathLike[str] | Mapping[str, ArrayLike] | Any,
    depth: ArrayLike | None = None,
    force: ArrayLike | None = None,
    *,
    body: Body,
    material: Literal["elastic", "standard-solid", "prony", "power-law"] = "standard-solid",
    branches: int | None = None,
    poisson_ratio: float = 0.5,
    thickness: float | Literal["fit"] | None = None,
    tilt: bool = True,
    before_retraction: bool = False,
    profile: bool = True,
    spring_constant: float | None = None,
    sensitivity: float | None = None,
    ramp_rate: float | None = None,
) -> IndentationFit:
    """The material behind a curve of force [N] over depth [m] and time [s], with 95 % intervals.

    Depth grows towards the sample, force is that on the sample; both count from any zero, as contact point, baseline and
    (with ``tilt``) the slope of the baseline are fitted along. Instead of the three arrays the name of a table will do, whose
    columns and units are found (also in the text exports of JPK, NanoScope and Asylum); ``spring_constant`` [N/m] and
    ``sensitivity`` [m/V] are for deflections in it, and ``ramp_rate`` [1/s] for the two halves of a ramp without times.
    Or a curve with named columns in SI, as ``afmformats.load_data(file)[0]`` reads it from the files of many microscopes:
    "time", "force", and "depth", "tip position" or "height (measured)", with the spring constant that it knows.

    ``thickness`` [m] is that of a sample bonded to a rigid base, under a body of revolution; "fit" finds it with the material, and
    says where the curve does not determine it; without it the sample is a half space.

    ``material`` is "elastic", "standard-solid", "prony" with ``branches`` (or as many as the curve tells apart) or "power-law".
    Where the curve does not determine how a material relaxes, the elastic one is given, and ``notes`` say so.
    ``before_retraction`` leaves the way back out, on which most bodies stick. ``profile`` takes all intervals from the profile
    likelihood; without it only those that a covariance cannot give, which is faster for maps of many curves. The
    interpreter's lock is released, so that threads fit several curves at a time.

    Raises ValueError for wrong input and for a damaged curve, with the reason.
    """
    if thickness is not None and isinstance(body, Pyramid):
        raise ValueError("thickness needs a body of revolution, and a Pyramid is none; take the Cone that is closest")
    request: dict[str, Any] = {
        "body": _of_revolution(body),
        "file": None,
        "columns": None,
        "spring_constant": spring_constant,
        "sensitivity": sensitivity,
        "ramp_rate": ramp_rate,
        "material": material,
        "branches": count("branches", branches),
        "poisson_ratio": poisson_ratio,
        "thickness": thickness,
        "tilt": tilt,
        "before_retraction": before_retraction,
        "profile": profile,
    }
    if isinstance(time, str | os.PathLike):
        if depth is not None or force is not None:
            raise ValueError("depth and force: a file has its own")
        request["file"] = os.fspath(time)
    elif hasattr(time, "columns") or isinstance(time, Mapping):
        if depth is not None or force is not None:
            raise ValueError("depth and force: a curve has its own")
        if (sensitivity, ramp_rate) != (None, None):
            raise ValueError("sensitivity and ramp_rate are for files")
        request["columns"] = columns(**dict(zip(("time", "depth", "force"), _measured(time, spring_constant), strict=True)))
    else:
        if depth is None or force is None:
            raise ValueError("depth and force are needed beside time")
        if (spring_constant, sensitivity, ramp_rate) != (None, None, None):
            raise ValueError("spring_constant, sensitivity and ramp_rate are for files")
        request["columns"] = columns(time=time, depth=depth, force=force)
    found = _native.fit_curve(request)
    findings = {}
    for name, unit, estimate, (lower, upper) in found["findings"]:
        value, error = estimate or (None, None)
        findings[name] = Finding(value, error, unit, (lower, upper))
    material_found = Prony(
        found["equilibrium_modulus"],
        found["branches"],
        poisson_ratio=poisson_ratio,
        valid_frequencies=found["valid_frequencies"],
    )
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
        tuple(found["notes"]),
    )
