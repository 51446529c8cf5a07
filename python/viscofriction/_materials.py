"""Linear viscoelastic materials, given by their behaviour in shear."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, fields
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import as_value, columns, numbers, text_of

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


Branches = Sequence[tuple[float, float]] | Sequence[Mapping[str, float]]

#: Of branches in the order of modulus [Pa] and time [s] no material has times that are all so many times the moduli.
_EXCHANGED = 1e3


@dataclass(frozen=True, init=False)
class Prony(Material):
    """A spring ≥ 0 [Pa] and branches in parallel: ``moduli`` [Pa] and ``relaxation_times`` [s] of the same length.

    Instead of both, ``branches`` are dictionaries ``{"modulus": …, "relaxation_time": …}``, or pairs in this order, which are
    refused where all seem to be the other way round.

    A series that stands for another law has an ``approximation`` ``(relative_error, (shortest, longest))``, the largest relative
    error of its moduli at these times [s] and at the frequencies 1/t, which is then in all bars.

    Of a fit, ``relative_covariance`` says how well the moduli are known: covariances over the products of the two moduli, of the spring
    and of the branches in their order, as many rows as columns.
    """

    equilibrium_modulus: float
    branches: tuple[tuple[float, float], ...]
    _: KW_ONLY
    viscosity: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    approximation: tuple[float, tuple[float, float]] | None = None
    relative_covariance: tuple[tuple[float, ...], ...] | None = None
    _kind = "prony"

    def __init__(
        self,
        equilibrium_modulus: float,
        branches: Branches | None = None,
        *,
        moduli: ArrayLike | None = None,
        relaxation_times: ArrayLike | None = None,
        viscosity: float = 0.0,
        poisson_ratio: float = 0.5,
        valid_frequencies: tuple[float, float] | None = None,
        approximation: tuple[float, tuple[float, float]] | None = None,
        relative_covariance: ArrayLike | None = None,
    ) -> None:
        if branches is not None:
            if moduli is not None or relaxation_times is not None:
                raise ValueError("branches: either these or moduli and relaxation_times")
            pairs = _pairs(branches)
        elif moduli is None or relaxation_times is None:
            raise ValueError("moduli and relaxation_times are needed, or branches")
        else:
            stiff, slow = columns(moduli=moduli, relaxation_times=relaxation_times)
            pairs = tuple(zip(stiff.tolist(), slow.tolist(), strict=True))
        values = {
            "equilibrium_modulus": equilibrium_modulus,
            "branches": pairs,
            "viscosity": viscosity,
            "poisson_ratio": poisson_ratio,
            "valid_frequencies": valid_frequencies,
            "approximation": approximation,
        }
        for name, value in values.items():
            object.__setattr__(self, name, as_value(value))
        rows = None
        if relative_covariance is not None:
            rows = tuple(tuple(float(entry) for entry in row) for row in np.atleast_2d(np.asarray(relative_covariance, float)))
        object.__setattr__(self, "relative_covariance", rows)

    @classmethod
    def from_relaxation(
        cls,
        relaxation_modulus: Callable[[float], float],
        time_range: tuple[float, float],
        relative_error: float = 1e-5,
        *,
        poisson_ratio: float = 0.5,
    ) -> Prony:
        """The series that stands for a function G(t) [Pa], with an error that is in all bars.

        ``time_range`` is the shortest and the longest time for which the material is needed [s]: there G(t), and at the frequencies 1/t
        G*, are within ``relative_error`` of the function. It is asked for times beyond the range too, and must fall as that of a
        material does.

        Raises ValueError where no series is as near, and whatever the function raises.
        """
        first, last = (float(time) for time in time_range)
        found = _native.expand_relaxation(relaxation_modulus, first, last, relative_error)
        branches = [{"modulus": modulus, "relaxation_time": time} for modulus, time in found["branches"]]
        approximation = (found["relative_error"], (first, last))
        modulus = found["equilibrium_modulus"]
        return cls(modulus, branches, poisson_ratio=poisson_ratio, approximation=approximation)

    def _table(self) -> dict[str, Any]:
        table = super()._table()
        branches = [{"modulus": modulus, "relaxation_time": time} for modulus, time in self.branches]
        table[self._kind]["branches"] = branches
        if self.approximation is not None:
            error, times = self.approximation
            table[self._kind]["approximation"] = {"relative_error": error, "time_range": times}
        table[self._kind].pop("relative_covariance", None)
        if self.relative_covariance is not None:
            table[self._kind]["covariance"] = {"relative": [list(row) for row in self.relative_covariance]}
        return table


def _pairs(branches: Branches) -> tuple[tuple[float, float], ...]:
    needed = "branches must be a list of pairs of a modulus [Pa] and a relaxation time [s], or of dictionaries of both"
    pairs: list[tuple[float, float]] = []
    has_names = False
    # The elements of a dictionary or of a table are names.
    if isinstance(branches, Mapping | str) or hasattr(branches, "columns") or not isinstance(branches, Iterable):
        raise ValueError(f"{needed}, but is {text_of(branches)}; columns are moduli=… and relaxation_times=…")
    for branch in branches:
        if isinstance(branch, Mapping):
            if set(branch) != {"modulus", "relaxation_time"}:
                raise ValueError(f"branches: the keys modulus and relaxation_time are needed, and not {', '.join(branch)}")
            pairs.append((branch["modulus"], branch["relaxation_time"]))
            has_names = True
        else:
            if isinstance(branch, str) or not isinstance(branch, Iterable) or len(pair := tuple(branch)) != 2:
                raise ValueError(f"{needed}, but holds {text_of(branch)}")
            modulus, time = pair
            pairs.append((modulus, time))
    # What is no number is refused where the branches are used.
    are_numbers = all(isinstance(value, int | float | np.number) for pair in pairs for value in pair)
    if pairs and are_numbers and not has_names and all(time > _EXCHANGED * modulus > 0 for modulus, time in pairs):
        modulus, time = pairs[0]
        raise ValueError(
            f"branches: a pair is a modulus [Pa] and a relaxation time [s], and these seem to be exchanged: {modulus:g} Pa and {time:g} s, "
            f"every time more than {_EXCHANGED:g} times the modulus; if they are meant, give moduli=… and relaxation_times=…"
        )
    if are_numbers and not has_names and len(pairs) == 2 and min(pairs[0]) > _EXCHANGED * max(pairs[1]) > 0:
        raise ValueError(
            "branches: a pair is a modulus [Pa] and a relaxation time [s], and here the first seem to be two moduli and the second two "
            "times; give the transpose, or moduli=… and relaxation_times=…"
        )
    return tuple(pairs)


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
    """The material of a file with a table ``[material.…]``, as ``fit-material`` writes it, at another ``temperature`` [°C] by its law."""

    path: str | os.PathLike[str]
    _: KW_ONLY
    temperature: float | None = None
    poisson_ratio: float | None = None
    valid_frequencies: tuple[float, float] | None = None
    _kind = "file"

    def _table(self) -> dict[str, Any]:
        table = super()._table()
        table[self._kind]["path"] = os.fspath(Path(self.path).absolute())
        return table
