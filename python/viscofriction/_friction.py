"""Friction as a rheometer: moduli of a material and shear strengths from measured friction over speed and temperature."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, columns
from ._indentation import Finding
from ._solving import Scene, given, read

Numbers = NDArray[np.float64]
Free = Literal["moduli", "shift", "interface"]

__all__ = ["FrictionFit", "MeasuredFriction", "fit_friction", "read_friction"]


@dataclass(frozen=True, eq=False, repr=False)
class FrictionFit(Compared):
    """The material behind measured friction, and the shear strength of its contact.

    ``findings``: By the path of each number below ``material``: "prony.branches[0].modulus"; of a shift law "C1" and "C2", or
    "E_a"; of an interface the whole path: "interface.bell.velocity".
    ``free``: What was sought: "moduli", "shift", "interface".
    ``material``: The material that was found, as a table for scenes: ``vf.solve({"material": fit.material, …})``.
    ``interface``: The interface that was found, as a table for scenes; None where the scene has none.
    ``velocity``, ``shifted_velocity``: Speeds [m/s] as measured, and at the temperature of the material.
    ``mu``, ``fitted_mu``: Friction coefficients as measured, and of the fit.
    ``standard_error``: Standard errors, where all points have one.
    ``residual``: Standard deviation of the residuals: over the standard errors where they are given, else relative to the
    friction, or of the friction coefficient (``noise="absolute"``).
    ``freedom``: Points and priors less parameters.
    ``solver_error``: Largest relative error of the computed friction.
    ``prior``: What was taken to be known of the moduli before the fit: "covariance", "none" or {"relative": spread}.
    ``notes``: How a table was read where that is not plain: signs, means of runs.
    ``flags``: What is doubtful about it.
    """

    findings: Mapping[str, Finding]
    free: tuple[Free, ...]
    material: Mapping[str, Any]
    interface: Mapping[str, Any] | None
    velocity: Numbers
    shifted_velocity: Numbers
    mu: Numbers
    fitted_mu: Numbers
    standard_error: Numbers | None
    residual: float
    freedom: int
    solver_error: float
    prior: Literal["covariance", "none"] | Mapping[str, float]
    notes: tuple[str, ...]
    flags: tuple[str, ...]

    def __repr__(self) -> str:
        rows = [f"  {name}: {one}" for name, one in self.findings.items()]
        head = f"fit of {self.mu.size} points of friction"
        return "\n".join([head, *self.notes, *rows, *(f"  flag: {flag}" for flag in self.flags)])

    def to_dict(self) -> dict[str, Any]:
        """All that is known, under the names of the attributes, as numbers, texts, lists and dictionaries of them."""
        known = {field.name: getattr(self, field.name) for field in fields(self)}
        known["findings"] = {name: asdict(one) for name, one in self.findings.items()}
        plain: dict[str, Any] = json.loads(json.dumps(known, default=np.ndarray.tolist))
        return plain

    def plot(self, ax: Any = None) -> Any:
        """Draws measured and fitted friction over the speed at the temperature of the material; returns the axes of matplotlib."""
        from . import _plotting

        axes = _plotting.axes(ax)
        order = np.argsort(self.shifted_velocity)
        axes.errorbar(self.shifted_velocity, self.mu, self.standard_error, fmt=".", color="0.5", label="measured")
        axes.plot(self.shifted_velocity[order], self.fitted_mu[order], label="fit")
        axes.legend()
        return _plotting.tidy(axes, "speed v a_T [m/s]", "friction coefficient μ", (self.shifted_velocity, None))


@dataclass(frozen=True, eq=False)
class MeasuredFriction(Compared):
    """A table of measured friction in SI units, as arrays; columns that the table does not have are None.

    ``velocity``, ``mu``: Speeds [m/s] and friction coefficients.
    ``standard_error``: Standard errors of the friction coefficients.
    ``temperature``, ``normal_force``: Temperature of the elastomer [°C], and normal force [N], of each point.
    ``notes``: How the table was read where that is not plain: signs, means of runs.
    """

    velocity: Numbers
    mu: Numbers
    standard_error: Numbers | None
    temperature: Numbers | None
    normal_force: Numbers | None
    notes: tuple[str, ...]


def read_friction(
    file: str | os.PathLike[str], *, track_radius: float | None = None, run_in: float | None = None
) -> MeasuredFriction:
    """The friction of a table as a tribometer exports it; names and units, separator, decimal mark and encoding are found.

    Columns and options are those of ``fit_friction``. Raises ValueError with line and column.
    """
    found = json.loads(_native.read_friction(os.fspath(file), track_radius, run_in))

    def column(name: str) -> Numbers | None:
        values = [point[name] for point in found["points"]]
        return None if None in values else np.array(values, dtype=float)

    velocity, mu = (np.array([point[name] for point in found["points"]]) for name in ("velocity", "friction_coefficient"))
    error, temperature, force = (column(name) for name in ("standard_error", "temperature", "normal_force"))
    return MeasuredFriction(velocity, mu, error, temperature, force, tuple(found["notes"]))


def fit_friction(
    velocity: ArrayLike | str | os.PathLike[str],
    mu: ArrayLike | None = None,
    *,
    scene: Scene,
    standard_error: ArrayLike | None = None,
    temperature: ArrayLike | None = None,
    normal_force: ArrayLike | None = None,
    free: Free | Sequence[Free] = (),
    noise: Literal["relative", "absolute"] = "relative",
    prior: float | Literal["covariance", "none"] = "covariance",
    track_radius: float | None = None,
    run_in: float | None = None,
) -> FrictionFit:
    """The moduli of a scene's material, or the shear strength of its interface, from friction coefficients ``mu`` over speed [m/s],
    with 95 % intervals.

    The scene is a file or a dictionary, as of ``vf.solve``: a body, its load, a material with the moduli to begin with, and perhaps
    an interface; its speed does not matter. Instead of arrays the name of a table will do, whose columns and units are found. Beside the friction
    there may be its ``standard_error``, the ``temperature`` [°C] and the ``normal_force`` [N] of each point.

    ``free`` is what is sought, one or several of "moduli", the constants of the material's "shift" law, and the numbers of the
    "interface"; unless given, the interface, or the moduli in a scene without one. Without standard errors ``noise``
    is "relative" to the friction or "absolute". ``prior`` is what is known of the moduli before the fit: the "covariance" of the
    material, as ``fit_material`` finds it (nothing where it has none), one relative standard deviation of all moduli that relax
    within its valid frequencies, or "none".

    ``track_radius`` [m] is that of a table with rotational speeds; ``run_in`` [s] is left out at the beginning of every run at
    constant speed of a table over time, whose mean is a point.

    Raises ValueError for wrong input, and where no material explains the points, with the reason.
    """
    table, folder, heights = read(scene)
    if heights is not None:
        raise ValueError("a HeightMapFile is needed in the place of a HeightMap")
    table.setdefault("load", {})
    request: dict[str, Any] = {
        "scene": table,
        "folder": folder,
        "file": None,
        "columns": None,
        "free": [free] if isinstance(free, str) else list(free),
        "noise": noise,
        "prior": str(prior),
        "track_radius": track_radius,
        "run_in": run_in,
    }
    beside = given(standard_error=standard_error, temperature=temperature, normal_force=normal_force)
    if isinstance(velocity, str | os.PathLike):
        if mu is not None or beside:
            raise ValueError("mu, standard_error, temperature and normal_force: a file has its own")
        request["file"] = os.fspath(velocity)
    else:
        if mu is None:
            raise ValueError("mu is needed beside velocity")
        if track_radius is not None or run_in is not None:
            raise ValueError("track_radius and run_in: only a file may have rotational speeds or runs over time")
        names = ["velocity", "mu", *beside]
        found = dict(zip(names, columns(velocity=velocity, mu=mu, **beside), strict=True))
        for name in ("velocity", "mu", "standard_error", "normal_force"):
            if name in found and not (found[name] > 0).all():
                raise ValueError(f"{name} must be greater than 0")
        request["columns"] = [found.get(name) for name in ("velocity", "mu", "standard_error", "temperature", "normal_force")]
    return _fit(json.loads(_native.fit_points(request)))


def _fit(found: dict[str, Any]) -> FrictionFit:
    fit, points = found["fit"], found["points"]
    findings = {}
    for one in fit["findings"]:
        estimate = one["estimate"] or {"value": None, "error": None}
        lower, upper = one["interval"]
        findings[one["name"]] = Finding(estimate["value"], estimate["error"], one["unit"], (lower, upper))
    errors = [point["standard_error"] for point in points]
    return FrictionFit(
        findings,
        tuple(found["free"]),
        found["material"],
        found["interface"],
        np.array([point["velocity"] for point in points]),
        np.array(found["shifted_velocities"]),
        np.array([point["friction_coefficient"] for point in points]),
        np.array(fit["fitted"]),
        None if None in errors else np.array(errors),
        fit["residual"],
        fit["freedom"],
        found["solver_error"],
        found["prior"],
        tuple(found["notes"]),
        tuple(fit["flags"]),
    )
