"""The Prony series, a material of which lists may be given in several ways."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import columns, number, text_of
from ._tables import Material

__all__ = ["Prony"]


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

    ``shift`` is the change of times and moduli with temperature, a dictionary as the key ``shift`` of a scene, by which ``at`` and the
    heat of sliding take the material to other temperatures.
    """

    equilibrium_modulus: float
    branches: tuple[tuple[float, float], ...]
    _: KW_ONLY
    viscosity: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    approximation: tuple[float, tuple[float, float]] | None = None
    relative_covariance: tuple[tuple[float, ...], ...] | None = field(default=None, repr=False)
    shift: Mapping[str, Any] | None = field(default=None, hash=False)
    _kind = "prony"
    _lists = {"branches": ("modulus", "relaxation_time")}

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
        shift: Mapping[str, Any] | None = None,
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
            "shift": shift,
        }
        rows = None
        if relative_covariance is not None:
            rows = tuple(tuple(float(entry) for entry in row) for row in np.atleast_2d(np.asarray(relative_covariance, float)))
        for name, value in (values | {"relative_covariance": rows}).items():
            object.__setattr__(self, name, value)
        self.__post_init__()

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

    def at(self, temperature: float) -> Prony:
        """The material at another temperature [°C] by its ``shift`` law; the frequencies at which it was measured shift along.

        Raises ValueError without a law, and outside of its range of temperatures.
        """
        if self.shift is None:
            raise ValueError("temperature: the material has no shift law, which a fit of isotherms of several temperatures finds")
        factor, stiffer, law = _native.shifted(json.dumps(self.shift), number("temperature", temperature))
        window, known = self.valid_frequencies, self.approximation
        branches: Any = [{"modulus": modulus * stiffer, "relaxation_time": time * factor} for modulus, time in self.branches]
        return replace(
            self,
            equilibrium_modulus=self.equilibrium_modulus * stiffer,
            branches=branches,
            viscosity=self.viscosity * stiffer * factor,
            valid_frequencies=window and (window[0] / factor, window[1] / factor),
            approximation=known and (known[0], (known[1][0] * factor, known[1][1] * factor)),
            shift=json.loads(law),
        )

    def _table(self) -> dict[str, Any]:
        [(kind, keys)] = super()._table().items()
        rows = keys.pop("relative_covariance")
        if rows is not None:
            keys["covariance"] = {"relative": [list(row) for row in rows]}
        if self.approximation is not None:
            error, times = self.approximation
            keys["approximation"] = {"relative_error": error, "time_range": times}
        return {kind: keys}


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
