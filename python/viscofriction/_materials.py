"""Linear viscoelastic materials, given by their behaviour in shear."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, fields
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import as_value, numbers

__all__ = [
    "Elastic",
    "FractionalMaxwell",
    "KelvinVoigt",
    "Material",
    "MaterialFile",
    "Maxwell",
    "Prony",
    "Springpot",
    "StandardSolid",
    "Viscous",
]


class Material:
    """A material. Moduli [Pa], viscosities [Pa s] and times [s] are checked when they are used.

    ``valid_frequencies`` are the lowest and the highest angular frequency at which it was measured [rad/s]; an answer whose friction
    comes from others warns, and says how much in ``dissipation``.
    """

    _kind: ClassVar[str]

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            object.__setattr__(self, field.name, as_value(getattr(self, field.name)))

    def _table(self) -> dict[str, Any]:
        """The table ``[material.…]`` of a scene."""
        keys = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        return {self._kind: keys}

    def storage_modulus(self, angular_frequency: ArrayLike) -> NDArray[np.float64]:
        """G' [Pa] at angular frequencies ≥ 0 [rad/s]."""
        return self._curve("storage_modulus", "angular_frequency", angular_frequency)

    def loss_modulus(self, angular_frequency: ArrayLike) -> NDArray[np.float64]:
        """G'' [Pa] at angular frequencies ≥ 0 [rad/s]."""
        return self._curve("loss_modulus", "angular_frequency", angular_frequency)

    def relaxation_modulus(self, time: ArrayLike) -> NDArray[np.float64]:
        """G(t) [Pa] at times ≥ 0 [s], without the impulse of a lone dashpot."""
        return self._curve("relaxation_modulus", "time", time)

    def creep_compliance(self, time: ArrayLike) -> NDArray[np.float64]:
        """J(t) [1/Pa] at times ≥ 0 [s]."""
        return self._curve("creep_compliance", "time", time)

    def _curve(self, quantity: str, name: str, values: ArrayLike) -> NDArray[np.float64]:
        array = numbers(name, values)
        scene = {"material": self._table()}
        curve = _native.material_curve(scene, os.getcwd(), quantity, array.ravel())
        return curve.reshape(array.shape)


@dataclass(frozen=True)
class Viscous(Material):
    """A dashpot of a viscosity > 0 [Pa s]."""

    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "viscous"


@dataclass(frozen=True)
class Elastic(Material):
    """A spring of a shear modulus > 0 [Pa]."""

    shear_modulus: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "elastic"


@dataclass(frozen=True)
class KelvinVoigt(Material):
    """Spring [Pa] and dashpot [Pa s] in parallel."""

    shear_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "kelvin-voigt"


@dataclass(frozen=True)
class Maxwell(Material):
    """Spring [Pa] and dashpot [Pa s] in series."""

    shear_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "maxwell"


@dataclass(frozen=True)
class StandardSolid(Material):
    """A spring [Pa] in parallel with a Maxwell element of a modulus [Pa] and a viscosity [Pa s]."""

    equilibrium_modulus: float
    maxwell_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "standard-solid"


@dataclass(frozen=True)
class Prony(Material):
    """A spring ≥ 0 [Pa] and branches in parallel, pairs of a modulus [Pa] and a relaxation time [s]."""

    equilibrium_modulus: float
    branches: Sequence[tuple[float, float]]
    _: KW_ONLY
    viscosity: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "prony"

    def _table(self) -> dict[str, Any]:
        table = super()._table()
        branches = [{"modulus": modulus, "relaxation_time": time} for modulus, time in self.branches]
        table[self._kind]["branches"] = branches
        return table


@dataclass(frozen=True)
class Springpot(Material):
    """Between spring and dashpot, G* = coefficient (iω)^exponent, coefficient > 0 [Pa s^exponent], exponent 0.01 to 0.99.

    ``time_range`` is the shortest and the longest time for which it is needed [s]; a spring ≥ 0 [Pa] may be in parallel.
    """

    coefficient: float
    exponent: float
    _: KW_ONLY
    time_range: tuple[float, float]
    equilibrium_modulus: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "springpot"


@dataclass(frozen=True)
class FractionalMaxwell(Material):
    """A spring > 0 [Pa] in series with a springpot, G* = G z/(1 + z), z = (iωτ)^exponent, τ the relaxation time > 0 [s].

    ``time_range`` is the shortest and the longest time for which it is needed [s]; a spring ≥ 0 [Pa] may be in parallel.
    """

    shear_modulus: float
    relaxation_time: float
    exponent: float
    _: KW_ONLY
    time_range: tuple[float, float]
    equilibrium_modulus: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "fractional-maxwell"


@dataclass(frozen=True)
class MaterialFile(Material):
    """The material of a file with a table ``[material.…]``, as ``fit-material`` writes it."""

    path: str | os.PathLike[str]
    _: KW_ONLY
    poisson_ratio: float | None = None
    valid_frequencies: tuple[float, float] | None = None
    _kind = "file"

    def _table(self) -> dict[str, Any]:
        table = super()._table()
        table[self._kind]["path"] = os.fspath(Path(self.path).absolute())
        return table
