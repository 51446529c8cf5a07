"""Arrays as they come, checked, and values that hold some, compared."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def numbers(
    name: str, values: ArrayLike, dimensions: int | None = None, *, holes: bool = False
) -> NDArray[np.float64]:
    """The values as float64, without a copy where they are; a ValueError names what is wrong.

    Masked entries are wrong too, or NaN where ``holes`` have a meaning.
    """
    masked = is_masked(values)
    if masked and not holes:
        raise ValueError(f"{name} must not have masked entries; leave them out, as compressed() does")
    try:
        array = np.ma.array(values) if masked else np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} must be real numbers, but is of the type {array.dtype}")
    if dimensions is not None and array.ndim != dimensions:
        raise ValueError(f"{name} must have {dimensions} dimension(s), but has the shape {array.shape}")
    if array.size == 0:
        raise ValueError(f"{name} must not be empty, but has the shape {array.shape}")
    if masked:
        array = np.ma.filled(array.astype(np.float64), np.nan)
    array = np.require(array, np.float64, ["ALIGNED"])
    if not (np.isfinite(array) | (holes & np.isnan(array))).all():
        raise ValueError(f"{name} must be finite, but holds NaN or infinity")
    return array


def number(name: str, value: Any) -> float:
    """A single finite number; a ValueError names what is wrong."""
    array = numbers(name, value)
    if array.shape != ():
        raise ValueError(f"{name} must be one number, but has the shape {array.shape}")
    return float(array)


def count(name: str, value: Any) -> int | None:
    """A whole number of at least 0, or None; a ValueError names anything else."""
    is_whole = isinstance(value, int | np.integer) and not isinstance(value, bool) and value >= 0
    if value is not None and not is_whole:
        raise ValueError(f"{name} must be a whole number of at least 0, but is {text_of(value)}")
    return None if value is None else int(value)


def text_of(value: Any) -> str:
    """A value for messages, by its type where it is long."""
    text = repr(value)
    return text if len(text) <= 60 and "\n" not in text else f"a {type(value).__name__}"


def is_masked(values: Any) -> bool:
    """Whether an entry is masked, in an array or in a list of them."""
    if isinstance(values, np.ma.MaskedArray):
        return bool(np.ma.is_masked(values))
    return isinstance(values, list | tuple) and any(map(is_masked, values))


def together(named: dict[str, ArrayLike]) -> tuple[dict[str, NDArray[np.float64]], tuple[int, ...]]:
    """Arrays broadcast to one shape and made flat, and that shape."""
    arrays = {name: numbers(name, values) for name, values in named.items()}
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name}: {array.shape}" for name, array in arrays.items())
        raise ValueError(f"the shapes do not fit together: {shapes}") from None
    return {name: np.broadcast_to(array, shape).ravel() for name, array in arrays.items()}, shape


def columns(**named: ArrayLike) -> list[NDArray[np.float64]]:
    """The values as flat arrays of one length."""
    arrays = {name: numbers(name, values, dimensions=1) for name, values in named.items()}
    if len({array.size for array in arrays.values()}) > 1:
        sizes = ", ".join(f"{name}: {array.size}" for name, array in arrays.items())
        raise ValueError(f"as many values of each are needed, but there are {sizes}")
    return list(arrays.values())


def as_value(given: Any) -> Any:
    """Lists and arrays as tuples and paths as texts, so that equal parameters compare equal and have a hash."""
    if isinstance(given, np.ndarray):
        given = given.tolist()
    if isinstance(given, os.PathLike):
        return os.fspath(given)
    return tuple(map(as_value, given)) if isinstance(given, list | tuple) else given


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal, arrays element by element, and NaN as itself."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return type(one) is type(other) and np.array_equal(one, other, equal_nan=True)
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other or (one != one and other != other))


class Compared:
    """Equal to another of its class where all that it holds is; it holds arrays, and has no hash."""

    def __eq__(self, other: object) -> bool:
        return same(vars(self), vars(other)) if type(self) is type(other) else NotImplemented
