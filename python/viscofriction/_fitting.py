"""Materials from measured moduli."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import numbers
from ._materials import Prony

__all__ = ["Fit", "fit_material", "fit_relaxation", "scaling_factor"]


@dataclass(frozen=True)
class Fit:
    """A Prony series, and how well it fits."""

    material: Prony
    #: Root mean square over all points of the relative error of the modulus.
    rms_relative_error: float
    #: The largest of these errors.
    max_relative_error: float


def fit_material(
    frequency: ArrayLike,
    storage: ArrayLike,
    loss: ArrayLike,
    *,
    branches: int | None = None,
    tolerance: float | None = None,
    smoothing: float | None = None,
    liquid: bool = False,
    poisson_ratio: float = 0.5,
) -> Fit:
    """The Prony series with the least relative error of shear moduli [Pa] that were measured over frequency [Hz], in any order.

    Without ``branches`` the fewest are taken whose error is at most 1 + ``tolerance`` (0.02) times that of many;
    ``smoothing`` keeps ``branches`` equally spaced and smooths their moduli with this weight. A ``liquid`` has no equilibrium
    modulus. Young's moduli are divided by 2 (1 + ν) before.

    Raises ValueError for wrong input and for moduli that no series fits.
    """
    hertz, shear, viscous = _columns(frequency=frequency, storage=storage, loss=loss)
    order = np.argsort(hertz, kind="stable")
    options = {"liquid": liquid, "branches": branches, "tolerance": tolerance, "smoothing": smoothing}
    found = _native.fit_oscillation(2 * np.pi * hertz[order], shear[order], viscous[order], options)
    return _fit(found, poisson_ratio)


def fit_relaxation(
    time: ArrayLike,
    modulus: ArrayLike,
    *,
    branches: int | None = None,
    tolerance: float | None = None,
    smoothing: float | None = None,
    liquid: bool = False,
    poisson_ratio: float = 0.5,
) -> Fit:
    """The Prony series of relaxation moduli [Pa] that were measured over time [s], in any order; otherwise as fit_material."""
    times, moduli = _columns(time=time, modulus=modulus)
    order = np.argsort(times, kind="stable")
    options = {"liquid": liquid, "branches": branches, "tolerance": tolerance, "smoothing": smoothing}
    return _fit(_native.fit_relaxation(times[order], moduli[order], options), poisson_ratio)


def scaling_factor(exponent: float) -> tuple[float, float]:
    """The factor s(p) between half space and line on a viscous material, for h = c r^p, and its error."""
    return _native.scaling_factor(exponent)


def _columns(**named: ArrayLike) -> list[np.ndarray[Any, np.dtype[np.float64]]]:
    arrays = {name: numbers(name, values, dimensions=1) for name, values in named.items()}
    if len({array.size for array in arrays.values()}) > 1:
        sizes = ", ".join(f"{name}: {array.size}" for name, array in arrays.items())
        raise ValueError(f"as many values of each are needed, but there are {sizes}")
    return list(arrays.values())


def _fit(found: dict[str, Any], poisson_ratio: float) -> Fit:
    branches = [(modulus, time) for modulus, time in found["branches"]]
    material = Prony(found["equilibrium_modulus"], branches, poisson_ratio=poisson_ratio)
    return Fit(material, found["rms_relative_error"], found["max_relative_error"])
