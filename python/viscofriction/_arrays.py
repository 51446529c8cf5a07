"""Arrays as they come, checked."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def numbers(name: str, values: ArrayLike, dimensions: int | None = None) -> NDArray[np.float64]:
    """The values as float64, without a copy where they are; a ValueError names what is wrong."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} must be real numbers, but is of the type {array.dtype}")
    if dimensions is not None and array.ndim != dimensions:
        raise ValueError(f"{name} must have {dimensions} dimension(s), but has the shape {array.shape}")
    if array.size == 0:
        raise ValueError(f"{name} must not be empty, but has the shape {array.shape}")
    array = np.require(array, np.float64, ["ALIGNED"])
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, but holds NaN or infinity")
    return array


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
