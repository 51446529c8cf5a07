"""What comes back: named arrays with their error bars."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arrays import Compared

__all__ = ["Answer", "NotReached"]

Values = np.float64 | NDArray[np.float64]

# Quantities by their names in JSON and CSV, each with its unit; of each there is the error too.
QUANTITIES = {
    "friction_coefficient": "",
    "normal_force": "N",
    "tangential_force": "N",
    "indentation_depth": "m",
    "contact_area": "m²",
    "peak_pressure": "Pa",
    "mean_pressure": "Pa",
    "area_fraction": "",
    "friction_from_dissipation": "",
    "peak_friction": "",
    "dissipated_energy": "J",
}
# Rows at the beginning and at the end of a table in a notebook.
SHOWN = 10
EDGES = ("x_min", "x_max", "y_min", "y_max")


class NotReached(RuntimeError):
    """The error that was asked for was not reached, or there is no answer.

    ``answer`` holds what was: numbers with their bars, wider than asked for where a sentence in ``failures`` says so, and NaN where
    nothing was found.
    """

    def __init__(self, message: str, answer: Answer) -> None:
        super().__init__(message)
        self.answer = answer

    def __reduce__(self) -> tuple[type[NotReached], tuple[str, Answer]]:
        return type(self), (str(self), self.answer)


class Answer(Compared):
    """Answers to one scene, or to an array of loads; all numbers in SI.

    Quantities have the shape that the loads have together, and are None where the method does not know them: a line has no
    area, the front of a viscous contact no peak pressure. Errors are absolute, 0 of what was given or is exact.
    """

    def __init__(self, found: dict[str, Any], loads: dict[str, NDArray[np.float64]], shape: tuple[int, ...]) -> None:
        self._columns: dict[str, NDArray[np.float64]] = found["columns"]
        self._answers: list[dict[str, Any] | None] = found["answers"]
        #: Of each load, flat: why there is no answer, or None.
        self.failures: list[str | None] = found["failures"]
        self._wrong_inputs: list[bool] = found["wrong_inputs"]
        #: The loads, each in the common shape, by their names.
        self.loads: dict[str, Values] = {name: values.reshape(shape)[()] for name, values in loads.items()}
        #: The common shape; () of a single scene.
        self.shape = shape

    def _values(self, name: str) -> Values | None:
        column = self._columns[name]
        return None if np.isnan(column).all() else column.reshape(self.shape)[()]

    @property
    def mu(self) -> Values | None:
        """Friction coefficient; None where nothing slides."""
        return self._values("friction_coefficient")

    @property
    def mu_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("friction_coefficient_error")

    @property
    def normal_force(self) -> Values | None:
        """Normal force [N], or [N/m] of a cylinder."""
        return self._values("normal_force")

    @property
    def normal_force_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("normal_force_error")

    @property
    def tangential_force(self) -> Values | None:
        """Friction force [N], or [N/m] of a cylinder."""
        return self._values("tangential_force")

    @property
    def tangential_force_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("tangential_force_error")

    @property
    def indentation_depth(self) -> Values | None:
        """Depth of the lowest point below the undeformed surface [m]."""
        return self._values("indentation_depth")

    @property
    def indentation_depth_error(self) -> Values | None:
        """Its absolute error [m]."""
        return self._values("indentation_depth_error")

    @property
    def area(self) -> Values | None:
        """Contact area [m²], or width [m] of a cylinder's contact."""
        return self._values("contact_area")

    @property
    def area_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("contact_area_error")

    @property
    def peak_pressure(self) -> Values | None:
        """Largest pressure [Pa], where it has a limit on refinement."""
        return self._values("peak_pressure")

    @property
    def peak_pressure_error(self) -> Values | None:
        """Its absolute error [Pa]."""
        return self._values("peak_pressure_error")

    @property
    def peak_friction(self) -> Values | None:
        """The largest friction coefficient of a motion to and fro or through points."""
        return self._values("peak_friction")

    @property
    def peak_friction_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("peak_friction_error")

    @property
    def dissipated_energy(self) -> Values | None:
        """Energy that is dissipated in a cycle of a motion to and fro [J]."""
        return self._values("dissipated_energy")

    @property
    def dissipated_energy_error(self) -> Values | None:
        """Its absolute error [J]."""
        return self._values("dissipated_energy_error")

    @property
    def area_fraction(self) -> Values | None:
        """Part of a periodic surface in contact."""
        return self._values("area_fraction")

    @property
    def area_fraction_error(self) -> Values | None:
        """Its absolute error."""
        return self._values("area_fraction_error")

    @property
    def standard_error(self) -> dict[str, Values]:
        """Standard errors of ``friction_coefficient`` and ``area_fraction`` as means over random surfaces, beside their numerical
        errors; empty of one surface."""
        names = ("friction_coefficient", "area_fraction")
        known = {name: self._values(f"{name}_standard_error") for name in names}
        return {name: values for name, values in known.items() if values is not None}

    @property
    def persson(self) -> dict[str, Values]:
        """``area_fraction`` and ``friction_coefficient`` of Persson (2001), ``area_fraction_xu`` of Xu and others (2024) and
        ``friction_coefficient_2006`` of Persson (2006), of periodic surfaces."""
        names = ("area_fraction", "area_fraction_xu", "friction_coefficient", "friction_coefficient_2006")
        theory = {name: self._values(f"persson_{name}") for name in names}
        return {name: values for name, values in theory.items() if values is not None}

    @property
    def dissipation(self) -> dict[str, Values]:
        """Parts of the friction, 0 to 1, where they are known: ``outside_window`` from frequencies at which the material was not
        measured, ``below_window`` and ``above_window``; ``shortest_octave`` from the shortest waves of a rough surface."""
        prefix = "dissipation_"
        names = [name for name in self._columns if name.startswith(prefix)]
        shares = {name.removeprefix(prefix): self._values(name) for name in names}
        return {name: values for name, values in shares.items() if values is not None}

    @property
    def contact_box(self) -> dict[str, Values]:
        """Edges of the contact relative to the lowest point [m], by their names ``x_min`` to ``y_max``."""
        edges = {name: self._values(name) for name in EDGES}
        return {name: values for name, values in edges.items() if values is not None}

    @property
    def contact_box_error(self) -> Values | None:
        """Absolute error of each edge [m]."""
        return self._values("contact_box_error")

    @property
    def method(self) -> str | list[str | None]:
        """The method that answered; of an array of loads a flat list."""
        method: str | list[str | None] = self._one_or_all("method")
        return method

    @property
    def model(self) -> str | list[str | None]:
        """What the elastomer was taken to be; of an array of loads a flat list."""
        model: str | list[str | None] = self._one_or_all("model")
        return model

    @property
    def warnings(self) -> list[str]:
        """Sentences about the validity of the answer; of an array of loads each once, with how many have it."""
        every: list[list[str]] = [answer["warnings"] if answer else [] for answer in self._answers]
        return every[0] if self.shape == () else _native.shared_warnings(every)

    @property
    def not_modelled(self) -> list[str]:
        """What a reader might take to be in the answer and is not, as words of a fixed list."""
        known: list[str] = next((answer["not_modelled"] for answer in self._answers if answer), [])
        return known

    @property
    def pressure(self) -> NDArray[np.float64]:
        """Pressure [Pa] at ``y[i]``, ``x[j]`` of a single scene on the half space: a row runs along x, as of a height map."""
        return self._field("pressure").T

    @property
    def x(self) -> NDArray[np.float64]:
        """Where the pressure is along the motion [m], relative to the lowest point."""
        return self._axis(0)

    @property
    def y(self) -> NDArray[np.float64]:
        """Where the pressure is across the motion [m], relative to the lowest point."""
        return self._axis(1)

    @property
    def line_load(self) -> NDArray[np.float64]:
        """Position [m] and load per length [N/m] of a single scene of the one-dimensional model, two columns."""
        return self._field("line_load")

    @property
    def line_pressure(self) -> NDArray[np.float64]:
        """Position [m] and pressure [Pa] of a single scene of a cylinder, two columns."""
        return self._field("line_pressure")

    @property
    def history(self) -> dict[str, NDArray[np.float64]]:
        """Time [s], normal force [N], depth [m], and radius [m] or area [m²] of the contact along the history of a single scene."""
        if self.shape != () or "history" not in (known := self._single()):
            raise AttributeError("a history belongs to a single scene with [load] history or history_file")
        history: dict[str, NDArray[np.float64]] = known["history"]
        return history

    @property
    def motion(self) -> dict[str, NDArray[np.float64]]:
        """Time [s], position [m], tangential and normal force [N] and depth [m] along the motion of a single scene."""
        if self.shape != () or "motion" not in (known := self._single()):
            raise AttributeError("a motion belongs to a single scene with [load] stroke, motion or motion_file")
        motion: dict[str, NDArray[np.float64]] = known["motion"]
        return motion

    @property
    def sensitivity(self) -> dict[str, dict[str, NDArray[np.float64]]]:
        """d ln(quantity)/d ln(number) by the number of the scene and the quantity, with errors, if it was asked for."""
        known = self._by_number("sensitivity")
        if not known:
            raise AttributeError("derivatives are there where they were asked for: slide(…, sensitivity=True)")
        return known

    @property
    def budget(self) -> dict[str, dict[str, NDArray[np.float64]]]:
        """Standard uncertainties by their source and the quantity: "numerics", "material", the uncertain numbers of the scene, and
        "total". They are there with ``sensitivity=True``, for a material with a covariance or a scene with uncertainties."""
        known = self._by_number("budget")
        if not known:
            needed = "sensitivity=True, and a material with a covariance or a scene with uncertainty"
            raise AttributeError(f"a budget is there where it was asked for: {needed}")
        return known

    @property
    def friction_coefficient_material_error(self) -> Values | None:
        """Standard uncertainty of the friction coefficient by the covariance of the moduli; None where that is not known or was not
        asked for, with ``sensitivity=True``."""
        of_material = self._by_number("budget").get("material", {})
        known = of_material.get("friction_coefficient")
        return None if known is None else known[()]

    def _by_number(self, name: str) -> dict[str, dict[str, NDArray[np.float64]]]:
        """Numbers of all answers by a number of the scene and a quantity, NaN where they are not known."""
        answers = [(answer or {}).get(name, {}) for answer in self._answers]
        numbers = dict.fromkeys(number for known in answers for number in known)
        quantities = dict.fromkeys(name for known in answers for one in known.values() for name in one)

        def values(number: str, quantity: str) -> NDArray[np.float64]:
            all_of = [known.get(number, {}).get(quantity, np.nan) for known in answers]
            return np.array(all_of).reshape(self.shape)

        return {number: {quantity: values(number, quantity) for quantity in quantities} for number in numbers}

    @property
    def spectral_sensitivity(self) -> dict[str, Any]:
        """d ln(quantity)/d ln(modulus) in bands of frequencies of a single scene, as arrays with their errors: the ends of the
        bands [rad/s], ``friction_coefficient_by_loss_modulus`` and so on, and which part of the friction's lies at frequencies
        at which the material was not measured.
        """
        answer = self._single()
        if "spectral_sensitivity" not in answer:
            raise AttributeError("these derivatives are there where they were asked for: slide(…, spectral_sensitivity=True)")
        known: dict[str, Any] = answer["spectral_sensitivity"]
        return known

    def _single(self) -> dict[str, Any]:
        if self.shape != () or self._answers[0] is None:
            raise AttributeError("fields belong to a single scene: ask for one load")
        return self._answers[0]

    def _field(self, name: str) -> NDArray[np.float64]:
        answer = self._single()
        if name not in answer:
            raise AttributeError(f"{answer['method']} has no {name.replace('_', ' ')}")
        field: NDArray[np.float64] = answer[name]
        return field

    def _axis(self, axis: int) -> NDArray[np.float64]:
        count = self._field("pressure").shape[axis]
        answer = self._single()
        return np.asarray(answer["origin"][axis] + answer["spacing"][axis] * np.arange(count))

    def _one_or_all(self, name: str) -> Any:
        every = [answer[name] if answer else None for answer in self._answers]
        return every[0] if self.shape == () else every

    def to_dict(self) -> dict[str, Any]:
        """All that is known: of a single scene the keys and values of the program's JSON, of an array a list for each column."""
        if self.shape == () and self._answers[0] is not None:
            whole: dict[str, Any] = json.loads(self._answers[0]["json"])
            return whole
        entries: dict[str, Any] = {name: np.ravel(load).tolist() for name, load in self.loads.items()}
        entries |= {"method": self.method, "model": self.model}
        known = {name: values for name, values in self._columns.items() if not np.isnan(values).all()}
        entries |= {name: plain(values) for name, values in known.items()}
        for name in ("unknowns", "iterations", "warnings", "not_modelled", "left_out"):
            entries[name] = self._one_or_all(name)
        return entries

    def _rows(self) -> list[tuple[str, str, str, str]]:
        """Name, value, error and unit of what a single scene knows."""
        rows = []
        for name, unit in QUANTITIES.items():
            value, error = (self._values(name + end) for end in ("", "_error"))
            if value is not None and error is not None:
                rows.append((name, *rounded(float(value), float(error)), unit))
        return rows

    def __repr__(self) -> str:
        if self.shape != ():
            known = [name for name in QUANTITIES if self._values(name) is not None]
            loads = ", ".join(self.loads)
            failed = sum(failure is not None for failure in self.failures)
            failures = f", {failed} without an answer" if failed else ""
            warnings = "".join(f"\n{text}" for text in noted(self.warnings))
            return f"<answers of shape {self.shape} over {loads}: {', '.join(known)}{failures}{warnings}>"
        if self._answers[0] is None:
            return f"<no answer: {self.failures[0]}>"
        notes = [f"  not reached: {failure}" for failure in self.failures if failure]
        notes += noted(self.warnings)
        rows = [f"  {name}: {value} {'± ' + error if error else ''} {unit}".rstrip() for name, value, error, unit in self._rows()]
        return "\n".join([f"{self.method}, {self.model}", *rows, *notes])

    def _repr_html_(self) -> str:
        failed = [f"not reached: {failure}" for failure in dict.fromkeys(self.failures) if failure]
        notes = [*self.warnings, *failed]
        if self.shape == ():
            head = ["quantity", "value", "error", "unit"]
            return html_table(f"{self.method}, {self.model}", head, self._rows(), notes)
        known = [name for name in QUANTITIES if self._values(name) is not None]
        head = [*self.loads, *map(with_unit, known)]
        columns = [[f"{load:g}" for load in np.ravel(values)] for values in self.loads.values()]
        for name in known:
            pairs = zip(self._columns[name], self._columns[f"{name}_error"], strict=True)
            columns.append([" ± ".join(filter(None, rounded(*map(float, pair)))) for pair in pairs])
        return html_table(f"{len(self.failures)} answers", head, list(zip(*columns, strict=True)), notes)

    def plot(self, ax: Any = None) -> Any:
        """Draws friction with its bars over what varies, or the pressure of a single scene; returns the axes of matplotlib."""
        from . import _plotting

        return _plotting.plot(self, ax)


def noted(warnings: list[str]) -> list[str]:
    """Lines below a result, the last of which names the page about warnings."""
    lines = [f"  warning: {text}" for text in warnings]
    return [*lines, "  about warnings: docs/numbers.md"] if lines else []


def plain(values: NDArray[np.float64]) -> list[float | None]:
    """A flat list, with None for what is not known."""
    return [None if math.isnan(value) else value for value in values.tolist()]


def rounded(value: float, error: float) -> tuple[str, str]:
    """Value and error to the digits that the error leaves; nothing of what is not known."""
    if math.isnan(value):
        return "", ""
    if error == 0.0:
        return f"{value:.10g}", ""
    if value == 0.0:
        return "0", f"{error:.2g}"
    digits = max(1, 2 + math.floor(math.log10(abs(value))) - math.floor(math.log10(error)))
    return f"{value:.{min(digits, 17)}g}", f"{error:.2g}"


def with_unit(name: str) -> str:
    """The name of a quantity, with its unit where it has one."""
    return f"{name} [{QUANTITIES[name]}]" if QUANTITIES[name] else name


def html_table(caption: str, head: Sequence[str], rows: Sequence[Sequence[str]], notes: Sequence[str]) -> str:
    """A table for a notebook, of many rows the first and the last, with sentences below it."""
    if len(rows) > 2 * SHOWN:
        rows = [*rows[:SHOWN], ["…"] * len(head), *rows[-SHOWN:]]

    def line(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    body = line(head, "th") + "".join(line(row, "td") for row in rows)
    paragraphs = "".join(f"<p>{html.escape(note)}</p>" for note in notes)
    return f"<table><caption>{html.escape(caption)}</caption>{body}</table>{paragraphs}"


def not_reached(answer: Answer) -> None:
    """Raises ValueError where the input of all loads is wrong, and NotReached where a load has no answer."""
    failed: Sequence[int] = [index for index, failure in enumerate(answer.failures) if failure is not None]
    if not failed:
        return
    first = answer.failures[failed[0]]
    if all(answer._wrong_inputs):
        raise ValueError(str(first))
    if answer.shape == ():
        raise NotReached(str(first), answer)
    loads = ", ".join(f"{name} = {np.ravel(values)[failed[0]]:g}" for name, values in answer.loads.items())
    raise NotReached(f"{len(failed)} of {len(answer.failures)} loads have no answer; {loads}: {first}", answer)
