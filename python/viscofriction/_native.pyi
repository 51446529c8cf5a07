"""What the compiled part offers; the modules beside it make Python of it."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Progress = Callable[[int, int], object]

def solve_loads(loads: dict[str, Any], progress: Progress | None) -> dict[str, Any]: ...
def sweep_plan(sweep: dict[str, Any]) -> tuple[list[str], list[list[str]]]: ...
def sweep_points(
    sweep: dict[str, Any], points: list[int], progress: Progress | None
) -> list[list[str]]: ...
def material_curve(
    scene: dict[str, Any], folder: str, quantity: str, values: NDArray[np.float64]
) -> NDArray[np.float64]: ...
def fit_oscillation(
    angular_frequency: NDArray[np.float64],
    storage: NDArray[np.float64],
    loss: NDArray[np.float64],
    options: dict[str, Any],
) -> dict[str, Any]: ...
def fit_relaxation(
    time: NDArray[np.float64], modulus: NDArray[np.float64], options: dict[str, Any]
) -> dict[str, Any]: ...
def read_moduli(
    file: str, poisson_ratio: float, deformation: str | None
) -> list[tuple[float | None, list[NDArray[np.float64]]]]: ...
def master_curve(
    isotherms: list[tuple[float, list[NDArray[np.float64]]]], reference_temperature: float
) -> tuple[list[NDArray[np.float64]], list[list[float]]]: ...
def surface_numbers(
    heights: NDArray[np.float64], spacing: tuple[float, float], repeats: bool
) -> dict[str, Any]: ...
def scaling_factor(exponent: float) -> tuple[float, float]: ...
def fit_curve(curve: dict[str, Any]) -> dict[str, Any]: ...
