"""Materials from measured moduli."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, columns, count, number
from ._materials import Prony

Numbers = NDArray[np.float64]
File = str | os.PathLike[str]
#: What a "storage modulus" without a letter is: E' or G'.
Deformation = Literal["tension", "shear"]
#: How the moduli of isotherms change with temperature.
Vertical = Literal["none", "entropic", "free"]

_VERTICAL: dict[Vertical, str] = {
    "none": "moduli do not change with temperature, b_T = 1",
    "entropic": "moduli grow with the absolute temperature, b_T = T/T_r",
    "free": "the moduli of each isotherm have a factor b_T",
}

__all__ = ["Fit", "IsothermShift", "Moduli", "fit_material", "fit_relaxation", "read_moduli", "scaling_factor"]


@dataclass(frozen=True)
class IsothermShift:
    """Where an isotherm is on a master curve: G*(ω, T) = b_T G*(a_T ω, T_r).

    ``temperature``: In the unit of the table.
    ``log10_factor``, ``log10_factor_error``: log₁₀ a_T, and its standard error.
    ``modulus_factor``, ``modulus_factor_error``: b_T, and its standard error.
    ``placed_by_law``: Whether it overlaps too little with its neighbour, and the law of the other shifts places it, or one that
    it follows.
    """

    temperature: float
    log10_factor: float
    log10_factor_error: float | None
    modulus_factor: float
    modulus_factor_error: float | None
    placed_by_law: bool

@dataclass(frozen=True)
class Fit:
    """A Prony series, and how well it fits.

    ``material``: The series, of several isotherms with its shift law.
    ``rms_relative_error``: Root mean square over all points of the relative error of the modulus.
    ``max_relative_error``: The largest of these errors.
    ``storage_error``: Root mean square and largest error of G' by itself, relative to its own size; None of a relaxation modulus.
    ``loss_error``: The same of G''.
    ``log10_factors``: Of several isotherms that were shifted onto one another, pairs of temperature and log₁₀ of the factor of
    frequency.
    ``shifts``: Of several isotherms what is known of each of them on the master curve.
    ``vertical``: How the moduli of several isotherms change with temperature; None of a single curve.
    ``vertical_is_found``: Whether that was asked for or is what the isotherms show; without it they do not show whether moduli
    change, and b_T = 1.
    ``temperature``: Of isotherms the temperature of the material, in the unit of the table.
    ``covariance``: Covariance [Pa²] of the moduli: the equilibrium modulus, and the branches in their order.
    ``covariance_method``: How it was found.
    ``measured``: The moduli of a table that were fitted, of several isotherms shifted onto the master curve: at the frequencies a_T ω
    the moduli over b_T, with the temperature at which each was measured.
    ``warnings``: Sentences about moduli whose errors are not noise: above 1 % rms, with too few changes of sign along the isotherms
    (Geary 1970).
    """

    material: Prony
    rms_relative_error: float
    max_relative_error: float
    storage_error: tuple[float, float] | None = None
    loss_error: tuple[float, float] | None = None
    log10_factors: tuple[tuple[float, float], ...] = ()
    shifts: tuple[IsothermShift, ...] = ()
    vertical: Vertical | None = None
    vertical_is_found: bool = True
    temperature: float | None = None
    covariance: Numbers | None = field(default=None, compare=False, repr=False)
    covariance_method: str | None = None
    measured: Moduli | None = field(default=None, compare=False, repr=False)
    warnings: tuple[str, ...] = ()

    @property
    def residuals(self) -> tuple[Numbers, Numbers]:
        """Relative errors of G' and G'' at the points of ``measured``: fitted over measured modulus, less 1."""
        points = self.measured
        if points is None or points.angular_frequency is None or points.storage is None or points.loss is None:
            raise AttributeError("residuals belong to the fit of a table with storage and loss modulus")
        omega = points.angular_frequency
        fitted = self.material.storage_modulus(omega), self.material.loss_modulus(omega)
        return fitted[0] / points.storage - 1, fitted[1] / points.loss - 1

    @property
    def decisions(self) -> tuple[str, ...]:
        """What was found and decided, as sentences: the window, the residuals, the law of temperatures and the vertical shift."""
        low, high = self.material.valid_frequencies or (0.0, 0.0)
        lines = [f"{len(self.material.branches)} branches; measured from {low:.3g} rad/s to {high:.3g} rad/s, on the master curve of isotherms"]
        for name, errors in (("G′", self.storage_error), ("G″", self.loss_error)):
            if errors is not None:
                lines.append(f"relative error of {name}: {100 * errors[0]:.2g} % rms, {100 * errors[1]:.2g} % at most")
        if self.shift is not None:
            first, last = self.shift["temperature_range"]
            lines.append(f"material at {self.shift['temperature']:g} °C; its shift law holds from {first:g} °C to {last:g} °C")
        if self.vertical is not None:
            lines.append(_VERTICAL[self.vertical])
        if not self.vertical_is_found:
            lines.append("the isotherms do not show whether moduli change with temperature, and the errors of the moduli include both")
        placed = ", ".join(f"{shift.temperature:g}" for shift in self.shifts if shift.placed_by_law)
        return (*lines, f"placed by the shift law of the others: the isotherms of {placed}") if placed else tuple(lines)

    def plot(self, ax: Any = None) -> Any:
        """Draws the moduli of a table and of the fit over the frequency, on the master curve, and below them the relative error of every
        point; returns the upper axes of matplotlib."""
        from . import _plotting

        return _plotting.master_curve(self, _plotting.axes(ax))

    @property
    def material_with_error(self) -> Prony:
        """The material with its largest relative error, which is then in all bars, for times 1/ω within the measured frequencies."""
        lowest, highest = self.material.valid_frequencies or (0.0, 0.0)
        branches: Any = [{"modulus": modulus, "relaxation_time": time} for modulus, time in self.material.branches]
        approximation = (self.max_relative_error, (1 / highest, 1 / lowest))
        return replace(self.material, branches=branches, approximation=approximation, relative_covariance=None)

    @property
    def shift(self) -> Mapping[str, Any] | None:
        """The shift law of the material, as in a scene's ``shift``, in °C, where several isotherms have one."""
        return self.material.shift

    def at(self, temperature: float) -> Prony:
        """The material at another temperature, in the unit of the table, by the shift law; the frequencies at which it was
        measured shift along, and moduli change by b_T.

        Raises ValueError outside of the law's range of temperatures.
        """
        if self.shift is None or self.temperature is None:
            raise ValueError("temperature: the fit has no shift law, which needs isotherms of several temperatures")
        return self.material.at(number("temperature", temperature) + (self.shift["temperature"] - self.temperature))


@dataclass(frozen=True, eq=False)
class Moduli(Compared):
    """What an instrument has measured: moduli in shear [Pa] as flat arrays; those that were not measured are None.

    ``angular_frequency``, ``storage``, ``loss``: Angular frequency [rad/s], with storage and loss modulus.
    ``temperature``: Of several isotherms the temperature of each point, in the unit of the table.
    ``time``, ``modulus``: Time [s], with the relaxation modulus.
    """

    angular_frequency: Numbers | None = None
    storage: Numbers | None = None
    loss: Numbers | None = None
    temperature: Numbers | None = None
    time: Numbers | None = None
    modulus: Numbers | None = None

def read_moduli(file: File, *, poisson_ratio: float = 0.5, deformation: Deformation | None = None) -> Moduli:
    """The moduli of a table as an instrument exports it; names and units, separator, decimal mark and encoding are found.

    Columns are a frequency with two of E', E'' and tan delta, or of G', G'' and tan delta, perhaps a temperature; or a time with
    a relaxation modulus. Young's moduli become G = E/(2 (1 + ν)); ``deformation``, "tension" or "shear", says which one a
    "storage modulus" is that has no letter. Raises ValueError with line and column.
    """
    parts, _ = _native.read_moduli(os.fspath(file), poisson_ratio, deformation)
    if parts[0][0] is None:
        time, modulus = parts[0][1]
        return Moduli(time=time, modulus=modulus)
    omega, storage, loss = (np.concatenate([columns[nth] for _, columns in parts]) for nth in range(3))
    if len(parts) == 1:
        return Moduli(omega, storage, loss)
    return Moduli(omega, storage, loss, np.concatenate([np.full(columns[0].size, one) for one, columns in parts]))


#: Largest table that is fitted [bytes], far above the export of an instrument and read in seconds.
LARGEST_TABLE = 8 << 20
#: Most points of isotherms that are shifted and fitted, in a minute or so.
MOST_SHIFTED = 20_000


def fit_material(
    frequency: ArrayLike | File,
    storage: ArrayLike | None = None,
    loss: ArrayLike | None = None,
    *,
    branches: int | None = None,
    tolerance: float | None = None,
    smoothing: float | None = None,
    liquid: bool = False,
    poisson_ratio: float = 0.5,
    deformation: Deformation | None = None,
    reference_temperature: float | None = None,
    temperature: float | None = None,
    wlf: tuple[float, float] | None = None,
    arrhenius: float | None = None,
    vertical: Vertical | None = None,
) -> Fit:
    """The Prony series with the least relative error of shear moduli [Pa] that were measured over frequency [Hz], in any order.

    Instead of the three arrays the name of a file will do, which ``read_moduli`` reads; isotherms are then shifted to
    ``reference_temperature``, or onto the one in the middle. A shift law may be prescribed: ``wlf``, the constants (C₁, C₂ [K])
    of Williams, Landel and Ferry about the reference temperature, or ``arrhenius``, an activation energy [J/mol].
    ``temperature`` is that of the returned material, by default the reference temperature. All temperatures are in the unit of
    the table. ``vertical`` says how moduli change with temperature: "none", "entropic" (with the absolute temperature, as those
    of rubber) or "free" (by a factor of each); without it as they show.

    Without ``branches`` the fewest are taken whose error is at most 1 + ``tolerance`` (0.02) times that of many;
    ``smoothing`` keeps ``branches`` equally spaced and smooths their moduli with this weight. A ``liquid`` has no equilibrium
    modulus. Young's moduli are divided by 2 (1 + ν) before.

    Raises ValueError for wrong input and for moduli that no series fits.
    """
    options = {"liquid": liquid, "branches": count("branches", branches), "tolerance": tolerance, "smoothing": smoothing}
    superposition = {
        "reference_temperature": reference_temperature,
        "temperature": temperature,
        "wlf": wlf,
        "arrhenius": arrhenius,
        "vertical": vertical,
    }
    if isinstance(frequency, str | os.PathLike):
        if storage is not None or loss is not None:
            raise ValueError("storage and loss: a file has its own")
        path = Path(frequency)
        if path.is_file() and (size := path.stat().st_size) > LARGEST_TABLE:
            raise ValueError(f"{path}: a table of moduli has at most {LARGEST_TABLE >> 20} MiB, and this file has {size / (1 << 20):.0f} MiB")
        measured = _native.read_moduli(os.fspath(frequency), poisson_ratio, deformation)
        return _fit_table(measured, superposition, options, poisson_ratio)
    if storage is None or loss is None:
        raise ValueError("storage and loss are needed beside frequency")
    if given := [name for name, value in ({"deformation": deformation} | superposition).items() if value is not None]:
        raise ValueError(f"{' and '.join(given)}: only for files, whose tables have temperatures and kinds of deformation")
    hertz, shear, viscous = columns(frequency=frequency, storage=storage, loss=loss)
    order = np.argsort(hertz, kind="stable")
    found = _native.fit_oscillation(2 * np.pi * hertz[order], shear[order], viscous[order], options)
    return _fit(found, poisson_ratio)


def _fit_table(
    measured: tuple[list[tuple[float | None, list[Numbers]]], bool | None],
    superposition: dict[str, Any],
    options: dict[str, Any],
    poisson_ratio: float,
) -> Fit:
    parts, celsius = measured
    if celsius is None and (given := [name for name, value in superposition.items() if value is not None]):
        raise ValueError(f"{' and '.join(given)}: the table has no temperatures, from which it could be shifted to another one")
    isotherms = [(temperature, columns) for temperature, columns in parts if temperature is not None]
    if not isotherms:
        time, modulus = parts[0][1]
        relaxation = Moduli(time=time, modulus=modulus)
        return replace(_fit(_native.fit_relaxation(time, modulus, options), poisson_ratio), measured=relaxation)
    omega, storage, loss = isotherms[0][1]
    if celsius is None:
        found = _native.fit_oscillation(omega, storage, loss, options)
        return replace(_fit(found, poisson_ratio), measured=Moduli(omega, storage, loss))
    if (n_points := sum(columns[0].size for _, columns in isotherms)) > MOST_SHIFTED:
        problem = f"{n_points} points at {len(isotherms)} temperatures: at most {MOST_SHIFTED} are shifted to a master curve"
        raise ValueError(f"{problem}; ten frequencies per decade and isotherm are enough")
    found = _native.fit_isotherms(isotherms, celsius, superposition, options)
    fit = replace(_fit(found, poisson_ratio), temperature=found["temperature"])
    if len(isotherms) == 1:
        return replace(fit, measured=Moduli(omega, storage, loss))
    errors = found.get("shift_errors") or [(None, None)] * len(isotherms)
    shifts = tuple(_isotherm_shift(*one, *error) for one, error in zip(found["shifts"], errors, strict=True))
    return replace(
        fit,
        log10_factors=tuple((one.temperature, one.log10_factor) for one in shifts),
        shifts=shifts,
        vertical=found["vertical"],
        vertical_is_found=found["vertical_is_found"],
        measured=_master_curve(isotherms, shifts),
    )


def _master_curve(isotherms: list[tuple[float, list[Numbers]]], shifts: tuple[IsothermShift, ...]) -> Moduli:
    """The points of all isotherms where their shifts place them."""
    of_temperature = {shift.temperature: shift for shift in shifts}
    omega, storage, loss, temperatures = [], [], [], []
    for temperature, (frequencies, elastic, viscous) in isotherms:
        shift = of_temperature[temperature]
        omega.append(frequencies * 10**shift.log10_factor)
        storage.append(elastic / shift.modulus_factor)
        loss.append(viscous / shift.modulus_factor)
        temperatures.append(np.full(frequencies.size, temperature))
    return Moduli(*map(np.concatenate, (omega, storage, loss, temperatures)))


def _isotherm_shift(
    temperature: float,
    factors: tuple[float, float],
    placed_by_law: bool,
    log_error: float | None,
    modulus_error: float | None,
) -> IsothermShift:
    log10_factor, modulus_factor = factors
    return IsothermShift(
        temperature,
        log10_factor,
        None if log_error is None else log_error / math.log(10),
        modulus_factor,
        None if modulus_error is None else modulus_factor * modulus_error,
        placed_by_law,
    )


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
    times, moduli = columns(time=time, modulus=modulus)
    order = np.argsort(times, kind="stable")
    options = {"liquid": liquid, "branches": count("branches", branches), "tolerance": tolerance, "smoothing": smoothing}
    return _fit(_native.fit_relaxation(times[order], moduli[order], options), poisson_ratio)


def scaling_factor(exponent: float) -> tuple[float, float]:
    """The factor s(p) between half space and line on a viscous material, for h = c r^p, and its error."""
    return _native.scaling_factor(number("exponent", exponent))


def _fit(found: dict[str, Any], poisson_ratio: float) -> Fit:
    branches = [{"modulus": modulus, "relaxation_time": time} for modulus, time in found["branches"]]
    relative = found.get("relative_covariance")
    material = Prony(
        found["equilibrium_modulus"],
        branches,
        poisson_ratio=poisson_ratio,
        valid_frequencies=found["valid_frequencies"],
        relative_covariance=relative,
        shift=json.loads(found["shift"]) if found.get("shift") else None,
    )
    errors = (found[name] for name in ("rms_relative_error", "max_relative_error", "storage_error", "loss_error"))
    fit = replace(Fit(material, *errors), warnings=tuple(found["warnings"]))
    if relative is None:
        return fit
    moduli = np.array([found["equilibrium_modulus"], *(modulus for modulus, _ in found["branches"])])
    return replace(fit, covariance=relative * np.outer(moduli, moduli), covariance_method=found["covariance_method"])
