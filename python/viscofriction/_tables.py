"""Bodies, materials, interfaces, heat and strain dependences as tables of a scene."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import as_value, numbers

__all__ = ["Body", "Heated", "Interface", "Material", "StrainDependence"]


class Table:
    """One table of a scene, whose keys are the fields. Numbers are checked when it is made."""

    _family: ClassVar[str]
    #: Name of the table within that of its family; empty for a family of one kind.
    _kind: ClassVar[str]
    #: Lists of tables by their key, with the keys of each.
    _lists: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            object.__setattr__(self, field.name, as_value(getattr(self, field.name)))
        _native.check_table({self._family: self._table()})

    def _table(self) -> dict[str, Any]:
        """The table as a scene has it."""
        keys = {field.name: self._value(field.name) for field in fields(self)}  # type: ignore[arg-type]
        return {self._kind: keys} if self._kind else keys

    def _value(self, key: str) -> Any:
        value, names = getattr(self, key), self._lists.get(key, ())
        if key in ("file", "path") and isinstance(value, str):
            return os.path.abspath(value)
        if names and isinstance(value, tuple):
            is_entry = [isinstance(entry, tuple) and len(entry) == len(names) for entry in value]
            return [dict(zip(names, entry)) if fits else entry for entry, fits in zip(value, is_entry)]
        return value


class Body(Table):
    """A rigid body. Its lowest point is the origin; lengths are in metres."""

    _family = "indenter"


class Interface(Table):
    """Shear strength of the real contact, whose part of the friction is the shear strength times the contact area over the normal
    force."""

    _family = "interface"


class Heated(Table):
    """Heat of sliding, by which the temperature of the contact is computed."""

    _family = "heat"


class StrainDependence(Table):
    """Factors of the moduli over the strain amplitude, which are those at the strain of the contact."""

    _family = "strain"


class Material(Table):
    """A material, given by its behaviour in shear. Moduli [Pa], viscosities [Pa s] and times [s].

    ``valid_frequencies`` are the lowest and the highest angular frequency at which it was measured [rad/s]; an answer whose friction
    comes from others warns, and says how much in ``dissipation``.
    """

    _family = "material"

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

    def to_toml(self) -> str:
        """Text of a material file, which scenes and a ``MaterialFile`` name: ``Path("rubber.toml").write_text(rubber.to_toml())``."""
        return _native.toml_text({self._family: self._table()})

    def _curve(self, quantity: str, name: str, values: ArrayLike) -> NDArray[np.float64]:
        array = numbers(name, values)
        scene = {"material": self._table()}
        curve = _native.material_curve(scene, os.getcwd(), quantity, array.ravel())
        return curve.reshape(array.shape)
