"""What comes back: named arrays with their error bars."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arrays import Compared
from ._kinds import Method, Model

__all__ = ["Answer", "MovingAnswer", "NotReached", "SlidingAnswer"]

Values = np.float64 | NDArray[np.float64]

#: Of each quantity, by its name in JSON and CSV: the label at an axis, and the units of a body and of a cylinder.
QUANTITIES = {key: (label, units) for key, label, *units in _native.quantities()}
#: Attributes of an answer, with the quantities that they are.
ATTRIBUTES = {name: name for name in QUANTITIES} | {"mu": "friction_coefficient", "area": "contact_area"}
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

    Every quantity is an attribute of its printed name, ``contact_area``, beside its absolute error, ``contact_area_error``, 0 of
    what was given or is exact; ``mu`` and ``area`` are short for friction coefficient and contact area. Quantities have the shape
    that the loads have together, and are None where the method does not know them: a line has no area, the front of a viscous
    contact no peak pressure. ``answer["contact_area"]`` is the same with NaN in place of None.
    """

    if TYPE_CHECKING:
        normal_force: Values
        normal_force_error: Values
        friction_coefficient: Values | None
        friction_coefficient_error: Values | None
        mu: Values | None
        mu_error: Values | None
        friction_from_hysteresis: Values | None
        friction_from_hysteresis_error: Values | None
        friction_from_shear: Values | None
        friction_from_shear_error: Values | None
        tangential_force: Values | None
        tangential_force_error: Values | None
        indentation_depth: Values | None
        indentation_depth_error: Values | None
        contact_area: Values | None
        contact_area_error: Values | None
        area: Values | None
        area_error: Values | None
        peak_pressure: Values | None
        peak_pressure_error: Values | None
        mean_contact_pressure: Values | None
        mean_contact_pressure_error: Values | None
        mean_pressure: Values | None
        mean_pressure_error: Values | None
        area_fraction: Values | None
        area_fraction_error: Values | None
        friction_from_dissipation: Values | None
        friction_from_dissipation_error: Values | None
        peak_friction: Values | None
        peak_friction_error: Values | None
        dissipated_energy: Values | None
        dissipated_energy_error: Values | None
        largest_temperature_rise: Values | None
        largest_temperature_rise_error: Values | None
        mean_temperature_rise: Values | None
        mean_temperature_rise_error: Values | None
        effective_temperature: Values | None
        effective_temperature_error: Values | None
        temperature_model_spread: Values | None
        temperature_model_spread_error: Values | None
        strain: Values | None
        strain_error: Values | None
        storage_factor: Values | None
        storage_factor_error: Values | None
        loss_factor: Values | None
        loss_factor_error: Values | None
        linear_friction_coefficient: Values | None
        linear_friction_coefficient_error: Values | None

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

    def __getitem__(self, column: str) -> Values:
        """The numbers of a column by the name that it has in the CSV, NaN where they are not known."""
        if column not in self._columns:
            raise KeyError(f"there is no column {column!r}; there are {', '.join(self._columns)}")
        return self._columns[column].reshape(self.shape)[()]

    @property
    def standard_error(self) -> dict[str, Values]:
        """Standard errors of ``friction_coefficient`` and ``area_fraction`` as means over random surfaces, beside their numerical
        errors; empty of one surface."""
        return self._between("", "_standard_error")

    @property
    def persson(self) -> dict[str, Values]:
        """``area_fraction`` and ``friction_coefficient`` of Persson (2001), ``area_fraction_xu`` of Xu and others (2024) and
        ``friction_coefficient_2006`` of Persson (2006), of periodic surfaces."""
        return self._between("persson_")

    @property
    def dissipation(self) -> dict[str, Values]:
        """Parts of the friction, 0 to 1, where they are known: ``outside_window`` from frequencies at which the material was not
        measured, ``below_window`` and ``above_window``; ``shortest_octave`` from the shortest waves of a rough surface."""
        return self._between("dissipation_")

    @property
    def contact_box(self) -> dict[str, Values]:
        """Edges of the contact relative to the lowest point [m], by their names ``x_min`` to ``y_max``."""
        edges = {name: self._values(name) for name in EDGES}
        return {name: values for name, values in edges.items() if values is not None}

    @property
    def contact_box_error(self) -> Values | None:
        """Absolute error of each edge [m]."""
        return self._values("contact_box_error")

    def _between(self, prefix: str, suffix: str = "") -> dict[str, Values]:
        """The columns with this beginning and end of which something is known, by the rest of their names."""
        names = [name for name in self._columns if name.startswith(prefix) and name.endswith(suffix)]
        known = {name.removeprefix(prefix).removesuffix(suffix): self._values(name) for name in names}
        return {name: values for name, values in known.items() if values is not None}

    @property
    def method(self) -> Method | list[Method | None]:
        """The method that answered; of an array of loads a flat list."""
        method: Method | list[Method | None] = self._one_or_all("method")
        return method

    @property
    def model(self) -> Model | list[Model | None]:
        """What the elastomer was taken to be; of an array of loads a flat list."""
        model: Model | list[Model | None] = self._one_or_all("model")
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
    def gap(self) -> NDArray[np.float64]:
        """Gap [m] between body and elastomer at ``gap_y[i]``, ``gap_x[j]`` of a single scene on the half space: around the contact, where it is
        0 within the tolerance of the contact solver, or of a period; of a cylinder one row along x."""
        return self._field("gap").T

    @property
    def gap_x(self) -> NDArray[np.float64]:
        """Where the gap is along the motion [m], relative to the lowest point."""
        return self._axis(0, "gap")

    @property
    def gap_y(self) -> NDArray[np.float64]:
        """Where the gap is across the motion [m], relative to the lowest point."""
        return self._axis(1, "gap")

    @property
    def x(self) -> NDArray[np.float64]:
        """Where the pressure is along the motion [m], relative to the lowest point."""
        return self._axis(0)

    @property
    def y(self) -> NDArray[np.float64]:
        """Where the pressure is across the motion [m], relative to the lowest point."""
        return self._axis(1)

    @property
    def temperature(self) -> NDArray[np.float64]:
        """Temperature rise [K] of the surface at the places of ``pressure``, of a single scene with heat; of a cylinder one row along x."""
        return self._field("temperature").T

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
        """Time [s], position [m], tangential and normal force [N], depth [m], and contact area [m²] on the half space, along a motion."""
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

    def _axis(self, axis: int, field: Literal["pressure", "gap"] = "pressure") -> NDArray[np.float64]:
        count = self._field(field).shape[axis]
        prefix = "gap_" if field == "gap" else ""
        origin, spacing = (self._single()[f"{prefix}{name}"][axis] for name in ("origin", "spacing"))
        return np.asarray(origin + spacing * np.arange(count))

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

    def _rows(self) -> list[tuple[str, str, str]]:
        """Name, value with its error, and unit of what a single scene knows."""
        return [(name, self._printed(name)[0], self._unit(name)) for name in self._known()]

    def _known(self) -> list[str]:
        return [name for name in QUANTITIES if self._values(name) is not None]

    def _printed(self, name: str) -> list[str]:
        return with_bars(self._columns[name], self._columns[f"{name}_error"])

    def _unit(self, name: str) -> str:
        of_body, of_cylinder = QUANTITIES[name][1]
        return of_cylinder if any(answer and answer["is_per_length"] for answer in self._answers) else of_body

    def __repr__(self) -> str:
        if self.shape != ():
            loads = ", ".join(self.loads)
            failed = sum(failure is not None for failure in self.failures)
            failures = f", {failed} without an answer" if failed else ""
            warnings = "".join(f"\n{text}" for text in noted(self.warnings))
            return f"<answers of shape {self.shape} over {loads}: {', '.join(self._known())}{failures}{warnings}>"
        if self._answers[0] is None:
            return f"<no answer: {self.failures[0]}>"
        notes = [f"  not reached: {failure}" for failure in self.failures if failure]
        notes += noted(self.warnings)
        rows = [f"  {name}: {value} {unit}".rstrip() for name, value, unit in self._rows()]
        return "\n".join([f"{self.method}, {self.model}", *rows, *notes])

    def _repr_html_(self) -> str:
        failed = [f"not reached: {failure}" for failure in dict.fromkeys(self.failures) if failure]
        notes = [*self.warnings, *failed]
        if self.shape == ():
            head = ["quantity", "value", "unit"]
            return html_table(f"{self.method}, {self.model}", head, self._rows(), notes) + self._budget_html()
        known = self._known()
        head = [*self.loads, *(with_unit(name, self._unit(name)) for name in known)]
        columns = [[_native.printed(load, 0.0) for load in np.ravel(values)] for values in self.loads.values()]
        columns += map(self._printed, known)
        return html_table(f"{len(self.failures)} answers", head, list(zip(*columns, strict=True)), notes)

    def _budget_html(self) -> str:
        """Where the uncertainty of the friction coefficient is from, if it is known."""
        of_friction = {source: known.get("friction_coefficient", np.array(np.nan)) for source, known in self._by_number("budget").items()}
        rows = [[source, f"{float(value):.2g}"] for source, value in of_friction.items() if not np.isnan(value)]
        return html_table("standard uncertainty of the friction coefficient", ["source", "value"], rows, []) if rows else ""

    def plot(self, ax: Any = None, field: Literal["pressure", "gap", "temperature"] = "pressure") -> Any:
        """Draws friction with its bars over what varies, or the pressure, the gap or the temperature rise of a single scene; returns the axes
        of matplotlib."""
        from . import _plotting

        if field == "pressure":
            return _plotting.plot(self, ax)
        return (_plotting.gap if field == "gap" else _plotting.temperature)(self, _plotting.axes(ax))


class SlidingAnswer(Answer):
    """Answers of ``slide``, whose friction is always known."""

    if TYPE_CHECKING:
        mu: Values
        mu_error: Values
        friction_coefficient: Values
        friction_coefficient_error: Values
        tangential_force: Values
        tangential_force_error: Values


class MovingAnswer(SlidingAnswer):
    """Answers of ``move``, whose largest friction is known too."""

    if TYPE_CHECKING:
        peak_friction: Values
        peak_friction_error: Values


def noted(warnings: list[str]) -> list[str]:
    """Lines below a result, the last of which names the page about warnings."""
    lines = [f"  warning: {text}" for text in warnings]
    return [*lines, "  about warnings: docs/numbers.md"] if lines else []


def plain(values: NDArray[np.float64]) -> list[float | None]:
    """A flat list, with None for what is not known."""
    return [None if math.isnan(value) else value for value in values.tolist()]


def with_bars(values: Iterable[float], errors: Iterable[float]) -> list[str]:
    """Values with their errors as the program prints them; nothing of what is not known."""
    pairs = zip(values, errors, strict=True)
    return ["" if math.isnan(value) else _native.printed(value, error) for value, error in pairs]


def with_unit(name: str, unit: str) -> str:
    """The name of a quantity, with its unit where it has one."""
    return f"{name} [{unit}]" if unit else name


def _attribute(name: str, end: str) -> property:
    what = "absolute error of the " if end else ""
    doc = f"{what}{QUANTITIES[name][0]}; None where it is not known."
    return property(lambda answer: answer._values(name + end), doc=doc[0].upper() + doc[1:])


for _attribute_name, _name in ATTRIBUTES.items():
    for _end in ("", "_error"):
        setattr(Answer, _attribute_name + _end, _attribute(_name, _end))


def html_table(
    caption: str, head: Sequence[str], rows: Sequence[Sequence[str]], notes: Sequence[str], *, all_rows: bool = False
) -> str:
    """A table for a notebook, of many rows the first and the last unless ``all_rows`` are wanted, with sentences below it."""
    if len(rows) > 2 * SHOWN and not all_rows:
        rows = [*rows[:SHOWN], ["…"] * len(head), *rows[-SHOWN:]]

    def line(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    body = line(head, "th") + "".join(line(row, "td") for row in rows)
    paragraphs = "".join(f"<p>{html.escape(note)}</p>" for note in notes)
    return f"<table><caption>{html.escape(caption)}</caption>{body}</table>{paragraphs}"


#: How pages of their own look.
_STYLE = """body { font: 1em/1.4 sans-serif; max-width: 70em; margin: auto; padding: 1em } table { border-collapse: collapse; font-size: 0.8em;
display: block; overflow: auto } td, th { padding: 0.2em 0.6em; text-align: right } pre { overflow: auto } svg { max-width: 100%; height: auto }"""


def html_page(title: str, body: str, texts: Mapping[str, str]) -> str:
    """A page of its own, without anything from elsewhere, whose end are texts that unfold."""
    named = (f"<details><summary>{html.escape(name)}</summary><pre>{html.escape(text)}</pre></details>" for name, text in texts.items())
    head = f'<meta charset="utf-8"><title>{html.escape(title)}</title><style>{_STYLE}</style>'
    return f'<!doctype html><html lang="en"><head>{head}</head><body><h1>{html.escape(title)}</h1>{body}{"".join(named)}</body></html>\n'


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
