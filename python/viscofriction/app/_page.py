"""The page: what is chosen on the left, what comes of it on the right."""

from __future__ import annotations

import base64
import html
import math
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from nicegui import background_tasks, events, run, ui

import viscofriction as vf

from .._fitting import Fit
from .._forms import Family, Key, kinds
from . import _choices, _curves
from ._choices import FAMILIES, LENGTHS, MAPS, TABLES, Choices
from ._work import Project

#: Largest file that is dropped onto the page [bytes]; a larger one is put into the folder.
LARGEST_DROP = 1 << 27
#: Keys of a height map that most people need; the others unfold.
SHOWN = {"file", "unit", "spacing", "edges", "level", "shortest_wavelength", "direction"}
TITLES = {"indenter": "2. Body", "interface": "Shear in the contact", "heat": "Heat of sliding", "strain": "Strain dependence"}
#: What is guessed for a file of heights.
OF_FILE = ("unit", "shortest_wavelength")
#: What a kind begins with.
GUESSED: dict[str, dict[str, Any]] = {"height-map": {"edges": "mirrored", "level": True}}
VERTICAL = {None: "as the isotherms show", "none": "none", "entropic": "with the absolute temperature", "free": "a factor of each"}
DEFORMATION = {None: "as the names of the columns say", "tension": "E: tension", "shear": "G: shear"}
SPEEDS = (
    ("slowest", "load.velocity.slowest", "slowest speed [m/s]"),
    ("fastest", "load.velocity.fastest", "fastest speed [m/s]"),
    ("n_speeds", "load.velocity.count", "number of speeds"),
    ("relative_error", "solve.relative_error", "relative error of the computation"),
)
FIELDS: tuple[Literal["pressure", "gap", "temperature"], ...] = ("pressure", "gap", "temperature")
ELSEWHERE = "Motions, histories and superpositions of powers are not in these forms. The program and Python compute them, from the scene file of this page."


def image(ax: Any, meaning: str) -> str:
    """A picture as a part of the page."""
    return f'<img alt="{html.escape(meaning)}" src="data:image/png;base64,{base64.b64encode(_curves.picture(ax)).decode()}">'


def paragraphs(lines: list[str] | tuple[str, ...]) -> str:
    return "".join(f"<p>{html.escape(line)}</p>" for line in lines)


def raw(content: str) -> None:
    ui.html(content, sanitize=False).classes("wide")


class Page:
    """One view of the project; several may be open, and all of them show the same computation."""

    def __init__(self, project: Project) -> None:
        self.project = project
        #: What shows the value of a key, and the problem with it, by the path of the key.
        self.fields: dict[str, Any] = {}
        self.marks: dict[Any, object] = {}
        self.seen: Any = None
        # Another page may choose another unit, and this one keeps that of its labels.
        self.unit, self.known = project.choices.unit, project.choices
        ui.add_css(Path(__file__).with_name("page.css"))
        ui.colors(primary="#005a91")
        dark = ui.dark_mode(None)
        with ui.header().classes("items-center justify-between"):
            ui.html("<h1>Friction of rubber</h1>", sanitize=False)
            schemes = {None: "as the system", False: "light", True: "dark"}
            ui.select(schemes, label="colours", on_change=lambda event: dark.set_value(event.value)).props("dark dense borderless")
        with ui.element("main").classes("both"):
            with ui.column().classes("wide"):
                self.material()
                self.family("indenter")
                self.load()
                for family in FAMILIES[1:]:
                    self.family(family)
            with ui.column().classes("wide"):
                self.results()
        ui.timer(0.5, self.refresh)
        self.look_at_material()
        self.look_at_surface()

    @property
    def chosen(self) -> Choices:
        return self.project.choices

    def choose(self, choices: Choices | None = None, **changed: Any) -> None:
        self.project.choose(replace(choices or self.chosen, **changed))
        self.known = self.chosen
        self.problem.set_text("")

    def refuse(self, error: Exception, place: str = "") -> None:
        """Says an error beside the field that it names, or the one that it belongs to, and beside the button."""
        # A sentence begins with the key that is wrong, perhaps without those above it, and may end with other keys of its point.
        text = str(error)
        ends = {path: f"{path.rpartition('.')[2]}:" for path in self.fields}
        # A path of one word may be any word of a sentence.
        places = {path: 0 if text.startswith((end, path)) else text.find(path if "." in path else end) for path, end in ends.items()}
        named = sorted((at, -len(path), path) for path, at in places.items() if at >= 0)
        field = self.fields.get(named[0][2] if named else place)
        if field is not None:
            field.error = str(error)
        self.problem.set_text(str(error))

    def tried(self, work: Callable[[], Any], place: str = "") -> Any:
        """What comes of it, or None where it is refused, which is said."""
        try:
            return work()
        except (ValueError, OSError) as error:
            self.refuse(error, place)

    async def later(self, place: Any, path: str, work: Callable[[], Any], tell: Callable[[Any], None]) -> None:
        """Does what takes a while in a thread, and tells what came of it unless something else is wanted since."""
        mark = self.marks[place] = object()
        place.clear()
        with place:
            ui.spinner(size="lg").props('aria-label="working"')
        try:
            found = await run.io_bound(work)
        except Exception as error:  # Whatever it is, the page says it, and stays.
            found, tell = error, partial(self.refuse, place=path)
        if self.marks[place] is mark:
            place.clear()
            with place:
                tell(found)

    # What is chosen.

    def select(self, path: str, label: str, options: dict[Any, str] | list[str], value: Any, change: Callable[[Any], None]) -> Any:
        return self.field(path, ui.select(options, label=label, value=value, on_change=partial(self.changed, path, change)))

    def changed(self, path: str, change: Callable[[Any], None], event: events.ValueChangeEventArguments[Any]) -> None:
        """Takes a value; its problem is that of the value before."""
        if path in self.fields:
            self.fields[path].error = None
        change(event.value)

    def number(self, path: str, label: str, value: float | None, change: Callable[[float | None], None]) -> Any:
        def read(text: Any) -> None:
            try:
                change(_choices.number(text))
            except ValueError as error:
                # Nothing is computed with the number that was there before.
                change(math.nan)
                self.refuse(ValueError(f"{label} {error}"), path)

        return self.field(path, ui.input(label, value=_choices.shown(value), on_change=partial(self.changed, path, read)).props("inputmode=decimal"))

    def length(self, path: str, label: str, value: float | None, change: Callable[[float | None], None]) -> Any:
        """A number in the unit of lengths, which is [m] for everybody else."""
        return self.number(path, f"{label} [{self.unit}]", self.in_unit(value), lambda shown: change(_choices.shifted(shown, LENGTHS[self.unit])))

    def in_unit(self, length: float | None) -> float | None:
        return _choices.shifted(length, -LENGTHS[self.unit])

    def field(self, path: str, field: Any) -> Any:
        """Keeps a field by the key that it shows; its problem stays until something else is chosen."""
        self.fields[path] = field.props("debounce=300").classes("wide").without_auto_validation()
        return field

    def file(self, path: str, label: str, ends: set[str], value: str, change: Callable[[str], None]) -> None:
        """A file of the folder, or one that is dropped and kept there."""
        names = self.project.files(ends)
        chooser = self.select(path, label, names, value if value in names else None, lambda name: change(name or "")).props("clearable")

        async def keep(event: events.UploadEventArguments) -> None:
            with tempfile.TemporaryDirectory(dir=self.project.folder, prefix=".dropped-") as folder:
                dropped = Path(folder) / "file"
                await event.file.save(dropped)
                kept = await run.io_bound(self.project.keep, event.file.name, dropped)
            chooser.set_options([*dict.fromkeys([*self.project.files(ends), kept])], value=kept)

        upload = ui.upload(label="or drop a file here", auto_upload=True, max_file_size=LARGEST_DROP, on_upload=keep)
        too_large = f"{path}: at most {LARGEST_DROP >> 20} MiB can be dropped; put a larger file into {self.project.folder}"
        upload.props("flat bordered").on_rejected(lambda: self.refuse(ValueError(too_large)))

    def material(self) -> None:
        chosen = self.chosen
        with ui.card():
            raw("<h2>1. Material</h2>")
            self.file("material", "table of moduli", TABLES | {".toml"}, chosen.material, self.choose_table)
            with ui.expansion("master curve").classes("wide"):
                name = "reference_temperature"
                self.number(name, "reference temperature", chosen.reference_temperature, partial(self.choose_material, name))
                for name, label, words in (("vertical", "vertical shift", VERTICAL), ("deformation", "moduli", DEFORMATION)):
                    self.select(name, label, words, getattr(chosen, name), partial(self.choose_material, name))
            self.of_material = ui.column().classes("wide")
            label = "thickness of a layer on a rigid base"
            self.length("layer.thickness", label, chosen.thickness, partial(self.choose_one, "thickness"))

    def choose_unit(self, unit: str) -> None:
        self.choose(unit=unit)
        ui.navigate.reload()

    def choose_one(self, name: str, value: Any) -> None:
        self.choose(**{name: value})

    def choose_table(self, name: str) -> None:
        # Temperatures of another material may be outside the range of this one.
        self.fields["material.file.temperature"].set_value("")
        self.choose_material("material", name)

    def choose_material(self, name: str, value: Any) -> None:
        self.choose_one(name, value)
        self.look_at_material()

    def look_at_material(self) -> None:
        chosen, folder = self.chosen, self.project.folder

        def look() -> tuple[Fit, str]:
            fit = _choices.fit(chosen, folder)
            has_curve = fit.storage_error is not None
            return fit, image(fit.plot(_curves.new_axes()), "moduli over the frequency, measured and fitted") if has_curve else ""

        def tell(found: tuple[Fit, str]) -> None:
            raw(paragraphs(found[0].decisions) + found[1])
            if not self.chosen.temperatures:
                self.fields["material.file.temperature"].set_value(" ".join(f"{one:g}" for one in _choices.guessed_temperatures(found[0])))

        self.of_material.clear()
        if chosen.material and chosen.is_fitted:
            background_tasks.create(self.later(self.of_material, "material", look, tell))

    def family(self, family: Family) -> None:
        """The kinds of a family, and the keys of the chosen one."""
        listed = kinds(family)
        # The table of heat has no kinds.
        options = {None: "none"} | {name: f"{name}: {kind.meaning}"[:60] if name else "computed" for name, kind in listed.items()}

        def choose(kind: str | None) -> None:
            self.choose(self.chosen.with_table(family, kind, GUESSED.get(kind or "", {})))
            fill()
            self.look_at_surface()

        def fill() -> None:
            kind = self.chosen.kind(family)
            self.fields = {path: field for path, field in self.fields.items() if not path.startswith(f"{family}.")}
            form.clear()
            with form:
                keys = () if kind is None else listed[kind].keys
                rare = {key.name for key in keys if kind == "height-map"} - SHOWN
                common, more = ui.column().classes("wide gap-1"), ui.expansion("more").classes("wide")
                more.set_visibility(bool(rare))
                for key in keys:
                    with more if key.name in rare else common:
                        self.key(family, kind or "", key)
                if family == "heat" and kind is not None:
                    ui.switch("also without heat", value=self.chosen.cold_too, on_change=lambda event: self.choose_one("cold_too", event.value))

        with ui.card():
            raw(f"<h2>{TITLES[family]}</h2>")
            if family == "indenter":
                self.select("unit", "unit of lengths", list(LENGTHS), self.unit, self.choose_unit)
            self.select(family, "kind", options, self.chosen.kind(family), choose)
            form = ui.column().classes("wide gap-1")
            if family == "indenter":
                self.of_surface = ui.column().classes("wide")
        fill()

    def key(self, family: Family, kind: str, key: Key) -> None:
        """The field of a key."""
        path, value = ".".join(filter(None, (family, kind, key.name))), self.chosen.keys(family).get(key.name, key.default)
        is_length, label = key.unit == "m", key.name.replace("_", " ")
        number = self.length if is_length else self.number
        label += f" [{key.unit}]" if key.unit and not is_length else ""

        def change(value: Any) -> None:
            if value == self.chosen.keys(family).get(key.name, key.default):
                return
            if path in self.fields:
                self.fields[path].props(remove="hint")
            # What was guessed or chosen for another file is not kept.
            gone = OF_FILE if (kind, key.name) == ("height-map", "file") else ()
            kept = {name: value for name, value in self.chosen.keys(family).items() if name not in gone}
            self.choose(self.chosen.with_table(family, kind, kept | {key.name: None if value == key.default else value}))
            for name in gone:
                self.fields[f"{family}.{kind}.{name}"].props(remove="hint").set_value(None)
            self.tried(lambda: _choices.check(self.chosen, family))
            if family == "indenter":
                self.look_at_surface()

        if key.entry == "file":
            self.file(path, label, MAPS | TABLES if kind == "height-map" else TABLES, value or "", change)
        elif key.entry == "switch":
            ui.switch(label, value=bool(value), on_change=lambda event: change(event.value)).tooltip(key.meaning)
        elif key.entry in ("word", "share"):
            meanings = {word: word if word == meaning else f"{word}: {meaning}" for word, meaning in key.words.items()}
            words = meanings if key.default is not None else {None: "as the file says"} | meanings
            self.select(path, label, words, value if value in words else None, change).tooltip(key.meaning)
        elif key.entry == "pair":
            ends = list(value or (None, None))

            def change_end(nth: int, end: float | None) -> None:
                ends[nth] = end
                change(None if None in ends else list(ends))

            for nth, axis in enumerate("xy"):
                number(path if nth == 0 else f"{path}[1]", f"{axis}: {label}", ends[nth], partial(change_end, nth))
        else:
            whole = key.entry == "count"
            number(path, label, value, lambda value: change(int(value) if whole and value and value.is_integer() else value)).tooltip(key.meaning)

    def look_at_surface(self) -> None:
        chosen, folder = self.chosen, self.project.folder
        self.force.props(f'label="{chosen.force_label}"')
        self.of_surface.clear()
        if chosen.kind("indenter") != "height-map" or not chosen.keys("indenter").get("file"):
            return

        def look() -> tuple[vf.HeightMap, Choices, str]:
            found, guessed = _choices.surface(chosen, folder)
            return found, guessed, image(found.plot(_curves.new_axes()), "the surface, its summits bright")

        def tell(found: tuple[vf.HeightMap, Choices, str]) -> None:
            body, guessed, picture = found
            rough = body.roughness
            (rows, columns), (dx, dy) = body.heights.shape, body.spacing
            along, across, sq, sa = (f"{self.in_unit(one):.3g} {self.unit}" for one in (dx, dy, rough.rms_height, rough.mean_deviation))
            lines = [f"{columns} × {rows} heights along x and y, {along} × {across} apart"]
            lines += [f"Sq {sq}, Sa {sa}, Sdq {rough.rms_gradient:.3g}", f"Ssk {rough.skewness:.2g}, Sku {rough.kurtosis:.2g}"]
            new = {name: value for name, value in guessed.keys("indenter").items() if name not in chosen.keys("indenter")}
            self.choose(self.chosen.with_table("indenter", "height-map", guessed.keys("indenter")))
            for name, value in new.items():
                field = self.fields[f"indenter.height-map.{name}"]
                field.set_value(_choices.shown(self.in_unit(value)) if isinstance(value, float) else value)
                field.props('hint="this is a guess"')
            raw(paragraphs([*lines, *dict.fromkeys([*body.notes, *rough.warnings])]) + picture)

        background_tasks.create(self.later(self.of_surface, "indenter.height-map.file", look, tell))

    def load(self) -> None:
        chosen = self.chosen
        with ui.card():
            raw("<h2>3. Load and speeds</h2>")
            self.force = self.number("load", chosen.force_label, chosen.force, partial(self.choose_one, "force"))
            for name, path, label in SPEEDS:
                self.number(path, label, getattr(chosen, name), partial(self.choose_one, name))
            text = " ".join(f"{one:g}" for one in chosen.temperatures)
            path = "material.file.temperature"
            hot = ui.input("temperatures [°C], between blanks", value=text, on_change=partial(self.changed, path, self.choose_temperatures))
            self.field(path, hot)
            ui.switch("band of the material", value=chosen.band, on_change=lambda event: self.choose_one("band", event.value))
            self.file("measured", "measured friction", TABLES, chosen.measured, self.choose_measured)
            raw(paragraphs([ELSEWHERE]))

    def choose_temperatures(self, text: str) -> None:
        try:
            self.choose(temperatures=_choices.temperatures(text or ""))
        except ValueError as error:
            self.choose(temperatures=(math.nan,))
            self.refuse(error)

    # What comes of it.

    def results(self) -> None:
        with ui.card():
            with ui.row().classes("items-center wide"):
                self.go = ui.button("Compute", on_click=self.compute).props("no-caps")
                self.halt = ui.button("Stop", on_click=lambda: self.project.stop()).props("no-caps color=negative")
                self.told = ui.label().props("role=status")
            self.shown = ui.select({}, label="computation", on_change=self.show_other).classes("wide")
            self.bar = ui.linear_progress(0.0, show_value=False).props('aria-label="points that are computed"')
            self.problem = ui.label().classes("text-negative wide").props("role=alert")
            self.plot = ui.plotly(_curves.plotly({}, None)).classes("wide").props('role=img aria-label="friction over the speed"')
            self.plot.on("plotly_click", self.clicked, ["points"])
            with ui.row().classes("wide"):
                for kind in ("Scene file", "Command", "Python"):
                    ui.button(kind, on_click=partial(self.show, kind), color=None).props("outline no-caps")
                for kind in ("CSV", "SVG", "PNG", "Report"):
                    ui.button(kind, on_click=partial(self.give, kind), color=None).props("outline no-caps icon=download")
            with ui.expansion("all points as a table").classes("wide"):
                self.table = ui.column().classes("wide")
        with ui.card():
            raw("<h2>The contact of a point</h2>")
            self.point = ui.select({}, label="point, or click on one", on_change=lambda event: self.look_at_point(event.value)).classes("wide point")
            self.of_point = ui.column().classes("wide")

    def compute(self) -> None:
        if self.chosen != self.known:
            self.refuse(ValueError("another page has chosen something else; load this page again to see it"))
            return
        self.choose()
        for field in self.fields.values():
            field.error = None
        self.tried(self.project.compute)

    def show_other(self, event: events.ValueChangeEventArguments[Any]) -> None:
        """Shows another computation of the folder, or again this one where another cannot be shown."""
        if event.value and event.value != self.project.shown()[1]:
            self.seen = None
            self.problem.set_text("")
            self.tried(lambda: self.project.show(event.value))

    def choose_measured(self, name: str) -> None:
        self.choose(measured=name)
        self.tried(self.project.measured, "measured")

    def refresh(self) -> None:
        """Shows the state, and the points where there are other ones."""
        computation = self.project.computation
        self.halt.set_visibility(self.project.is_running)
        self.go.set_enabled(not self.project.is_running)
        self.bar.set_value(computation.done / computation.total if computation else 0.0)
        self.told.set_text(computation.told if computation else "nothing is computed yet")
        state = computation and (computation, computation.done, computation.state, self.chosen.measured)
        if computation is None or state == self.seen:
            return
        if self.seen is None or (self.seen[0], self.seen[2]) != (computation, computation.state):
            # All tables of the folder are read, which takes too long for each point.
            self.shown.set_options(self.project.computations(), value=computation.name)
        self.seen = state
        self.draw()
        if computation.problem:
            self.refuse(ValueError(computation.problem))

    def draw(self) -> None:
        sweeps = self.tried(self.project.sweeps) or {}
        self.plot.update_figure(_curves.plotly(sweeps, self.tried(self.project.measured, "measured")))
        self.point.set_options({f"{part}:{row}": text for (part, row), text in _curves.points(sweeps).items()})
        if missing := sum(int(np.isnan(sweep[_curves.FRICTION]).sum()) for sweep in sweeps.values() if len(sweep)):
            self.problem.set_text(f"points without an answer: {missing}; the list of points and the report say why")
        self.table.clear()
        with self.table:
            for part, sweep in sweeps.items():
                raw(f"<h3>{html.escape(part)}</h3>" + sweep._repr_html_())

    def clicked(self, event: events.GenericEventArguments) -> None:
        points = [point["customdata"] for point in event.args["points"] if point.get("customdata")]
        if points:
            self.point.set_value(f"{points[0][0]}:{points[0][1]}")

    def look_at_point(self, chosen: str | None) -> None:
        computation = self.project.computation
        self.of_point.clear()
        if computation is None or not chosen:
            return
        part, row = chosen.rsplit(":", 1)

        def look() -> str:
            answer, title = computation.point(part, int(row))
            fields = FIELDS if answer.largest_temperature_rise is not None else FIELDS[:2]
            known = [field for field in fields if hasattr(answer, field) or hasattr(answer, f"line_{field}")]
            lines = [title, *(f"{answer.method} has no {field} of the contact" for field in fields if field not in known)]
            pictures = [image(answer.plot(_curves.new_axes(), field), f"{field} of the contact") for field in known]
            return paragraphs(lines) + "".join(pictures) + answer._repr_html_()

        def tell(found: str) -> None:
            raw(found)
            ui.run_javascript(f"setTimeout(() => getHtmlElement({self.point.id}).scrollIntoView({{behavior: 'smooth'}}), 200)")

        background_tasks.create(self.later(self.of_point, "", look, tell))

    # What leads on.

    def show(self, kind: str) -> None:
        """Texts by the names of their files, to be read, copied and saved."""
        texts = self.tried(lambda: self.project.exported(kind)) or {}
        with ui.dialog() as dialog, ui.card():
            for name, text in texts.items():
                raw(f"<h2>{html.escape(name)}</h2>")
                ui.code(text.decode()).classes("wide")
                ui.button("Save", on_click=partial(ui.download.content, text, name), color=None).props("no-caps outline")
            ui.button("Close", on_click=dialog.close).props("no-caps")
        dialog.set_value(bool(texts))

    def give(self, kind: str) -> None:
        for name, content in (self.tried(lambda: self.project.exported(kind)) or {}).items():
            ui.download.content(content, name)

