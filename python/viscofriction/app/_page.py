"""The page: what is chosen on the left, what comes of it on the right."""

from __future__ import annotations

import html
import re
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

from nicegui import background_tasks, events, run, ui

from .._fitting import Fit
from .._forms import Family, Key, Typed, kinds, shifted, shown
from .._forms import number as typed_number
from .._plotting import image, label, new_axes
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
ENDS = (("slowest", "load.velocity.slowest", "slowest speed [m/s]"), ("fastest", "load.velocity.fastest", "fastest speed [m/s]"))
SPEEDS = (*ENDS, ("n_speeds", "load.velocity.count", "number of speeds"), ("relative_error", "solve.relative_error", "relative error"))
FIELDS: tuple[Literal["pressure", "gap", "temperature"], ...] = ("pressure", "gap", "temperature")
ELSEWHERE = "Motions, histories and superpositions of powers are not in these forms. The program and Python compute them, from the scene file of this page."
#: The picture is for the mouse.
PLOT = 'role=img aria-label="friction over the speed; the list of points below has the same points for the keyboard"'
#: The button of an upload, with a name that is read aloud.
UPLOAD = '<q-btn flat no-caps icon="upload_file" label="or drop a file here" aria-label="drop or choose a file: {}"><q-uploader-add-trigger /></q-btn>'
#: A number in a sentence about a length [m], after its comparison or before its unit.
METRES = re.compile(r"((?:is|than|least|most|,) )(-?\d+(?:\.\d+)?(?:e-?\d+)?)( m\b)?")


def paragraphs(lines: Iterable[str], look: str = "") -> str:
    return "".join(f'<p class="{look}">{html.escape(line)}</p>' for line in lines)


def raw(content: str) -> None:
    ui.html(content, sanitize=False).classes("wide")


class Page:
    """One view of the project; several may be open, and all of them show the newest choices and the same computation."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self.marks: dict[Any, object] = {}
        self.seen: Any = None
        ui.add_css(Path(__file__).with_name("page.css"))
        ui.colors(primary="#005a91")
        dark = ui.dark_mode(None)
        with ui.header().classes("items-center justify-between"):
            ui.html("<h1>Friction of rubber</h1>", sanitize=False)
            ui.select({None: "as the system", False: "light", True: "dark"}, label="colours").bind_value(dark).props("dark dense borderless")
        with ui.element("main").classes("both"):
            self.left = ui.column().classes("wide")
            with ui.column().classes("wide"):
                self.results()
        self.forms()
        ui.timer(0.5, self.refresh)

    def forms(self) -> None:
        """The forms with the newest choices."""
        #: What shows the value of a key, and the problem with it, by the path of the key.
        self.fields: dict[str, Any] = {}
        self.unit, self.known = self.chosen.unit, self.chosen
        self.left.clear()
        with self.left:
            self.material()
            self.family("indenter")
            self.load()
            for family in FAMILIES[1:]:
                self.family(family)
        self.look_at_material()
        self.look_at_surface()

    @property
    def chosen(self) -> Choices:
        return self.project.choices

    def choose(self, choices: Choices | None = None, **changed: Any) -> None:
        is_newest = self.known == self.chosen
        self.project.choose(replace(choices or self.chosen, **changed))
        self.known = self.chosen if is_newest else self.known
        self.problem.set_text("")

    def said(self, text: str) -> tuple[str, Any]:
        """A sentence about keys with the labels of their fields, lengths in the unit of the page, and the first field that it names."""
        # A sentence may begin with a key without those above it.
        if (first := re.match(r"([\w-]+(?:\[\d\])?)(?=:| must| is needed)", text)) and first[1] not in self.fields:
            text = next((path for path in self.fields if path.rpartition(".")[2] == first[1]), first[1]) + text[first.end() :]
        paths = [re.escape(path) for path in sorted([*self.fields, _curves.SPEED], key=len, reverse=True)]
        dotted = "|".join(path for path in paths if "." in path)
        named: list[Any] = []

        def name(found: re.Match[str]) -> str:
            named.append(self.fields.get(found[0]))
            return str(named[-1].props["label"] if named[-1] else label(found[0]))

        text = re.sub(rf"^(?:{'|'.join(paths)})(?=:| must| is needed)|(?<![\w./-])(?:{dotted})(?![\w.\[-])", name, text)
        field = next(filter(None, named), None)
        if field is not None and field.props["label"].endswith(f"[{self.unit}]"):
            text = METRES.sub(lambda found: found[1] + shown(self.in_unit(float(found[2]))) + (found[3] and f" {self.unit}" or ""), text)
        return text, field

    def refuse(self, error: Exception, place: str = "") -> None:
        """Says an error beside the field that it names, or the one that it belongs to, and beside the button."""
        text, field = self.said(str(error))
        if (field := field or self.fields.get(place)) is not None:
            field.error = text
        self.problem.set_text(text)

    def tried(self, work: Callable[[], Any], place: str = "") -> Any:
        """What comes of it, or None where it is refused, which is said."""
        try:
            return work()
        except (ValueError, OSError) as error:
            self.refuse(error, place)

    def later(self, place: Any, path: str, what: str, work: Callable[[], Any], tell: Callable[[Any], None]) -> None:
        """Does what takes a while in a thread, if it is something, and tells what came of it unless something else is wanted since."""

        def complain(error: Exception) -> None:
            self.refuse(error, path)
            raw(paragraphs([self.said(str(error))[0]], "text-negative"))

        async def do() -> None:
            # What is read for several choices at the same time would need the memory of all of them.
            async with self.project.locks[path or mark]:
                if self.marks[place] is not mark:
                    return
                try:
                    show = partial(tell, await run.io_bound(work))
                except Exception as error:  # Whatever it is, the page says it, and stays.
                    show = partial(complain, error)
            if self.marks[place] is mark and not place.is_deleted:
                place.clear()
                with place:
                    show()

        mark = self.marks[place] = object()
        place.clear()
        if what:
            with place, ui.row().classes("items-center"):
                ui.spinner(size="lg").props('aria-hidden="true"')
                ui.label(f"{what} …").props("role=status")
            background_tasks.create(do())

    # What is chosen.

    def select(self, path: str, label: str, options: dict[Any, str] | list[str], value: Any, change: Callable[[Any], None]) -> Any:
        return self.field(path, ui.select(options, label=label, value=value, on_change=partial(self.changed, path, change)))

    def changed(self, path: str, change: Callable[[Any], None], event: events.ValueChangeEventArguments[Any]) -> None:
        """Takes a value; its problem is that of the value before."""
        if (field := self.fields.get(path)) is not None:
            field.props(remove="hint").error = None
        change(event.value)

    def text(self, path: str, label: str, value: str, change: Callable[[str], None]) -> Any:
        """A field of a text, which is checked when it is left."""
        field = self.field(path, ui.input(label, value=value, on_change=partial(self.changed, path, change)))
        # Each end of the speeds may be what was wrong with the other.
        return field.on("blur", lambda: self.check(field, *(end for _, path, _ in ENDS if (end := self.fields[path]).error)))

    def check(self, *fields: Any) -> None:
        for field in fields:
            field.error = None
        for path in (path for path, field in self.fields.items() if field in fields):
            self.tried(partial(_choices.check, self.chosen, path))

    def number(self, path: str, label: str, value: Typed, change: Callable[[Typed], None]) -> Any:
        return self.text(path, label, shown(value), lambda text: change(typed_number(text))).props("inputmode=decimal")

    def length(self, path: str, label: str, value: Typed, change: Callable[[Typed], None]) -> Any:
        """A number in the unit of lengths, which is [m] for everybody else."""
        return self.number(path, f"{label} [{self.unit}]", self.in_unit(value), lambda length: change(shifted(length, LENGTHS[self.unit])))

    def in_unit(self, length: Typed) -> Typed:
        return shifted(length, -LENGTHS[self.unit])

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

        upload = ui.upload(auto_upload=True, max_file_size=LARGEST_DROP, on_upload=keep)
        upload.add_slot("header", UPLOAD.format(html.escape(label)))
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
            self.length("layer.thickness", "thickness of a layer", chosen.thickness, partial(self.choose_one, "thickness"))

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
            return fit, image(fit.plot(new_axes()), "moduli over the frequency, measured and fitted") if has_curve else ""

        def tell(found: tuple[Fit, str]) -> None:
            raw(paragraphs(found[0].warnings, "caution") + paragraphs(found[0].decisions) + found[1])
            if not self.chosen.temperatures:
                self.fields["material.file.temperature"].set_value(" ".join(f"{one:g}" for one in _choices.guessed_temperatures(found[0])))

        what = f"reading and fitting {chosen.material}" if chosen.material and chosen.is_fitted else ""
        self.later(self.of_material, "material", what, look, tell)

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
                # The page then has its forms anew, as for what another page chooses.
                unit = ui.select(list(LENGTHS), label="unit of lengths", value=self.unit)
                unit.on_value_change(lambda event: self.project.choose(replace(self.chosen, unit=event.value))).classes("wide")
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
            # What was guessed or chosen for another file is not kept.
            gone = OF_FILE if (kind, key.name) == ("height-map", "file") else ()
            kept = {name: value for name, value in self.chosen.keys(family).items() if name not in gone}
            self.choose(self.chosen.with_table(family, kind, kept | {key.name: None if value == key.default else value}))
            for name in gone:
                self.fields[f"{family}.{kind}.{name}"].props(remove="hint").set_value(None)
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

            def change_end(nth: int, end: Typed) -> None:
                ends[nth] = end
                change(list(ends))

            for nth, axis in enumerate("xy"):
                number(f"{path}[{nth}]", f"{axis}: {label}", ends[nth], partial(change_end, nth))
        else:
            whole = key.entry == "count"
            number(path, label, value, lambda value: change(int(value) if whole and isinstance(value, float) and value.is_integer() else value)).tooltip(key.meaning)

    def look_at_surface(self) -> None:
        chosen, folder = self.chosen, self.project.folder
        self.force.props(f'label="{chosen.force_label}"')
        path = folder / (chosen.keys("indenter").get("file", "") if chosen.kind("indenter") == "height-map" else "")

        def look() -> tuple[Choices, str]:
            found, guessed = _choices.surface(chosen, folder)
            rough, (rows, columns), (dx, dy) = found.roughness, found.heights.shape, found.spacing
            along, across, sq, sa = (f"{self.in_unit(one):.3g} {chosen.unit}" for one in (dx, dy, rough.rms_height, rough.mean_deviation))
            lines = [f"{columns} × {rows} heights along x and y, {along} × {across} apart"]
            lines += [f"Sq {sq}, Sa {sa}, Sdq {rough.rms_gradient:.3g}", f"Ssk {rough.skewness:.2g}, Sku {rough.kurtosis:.2g}"]
            told = paragraphs(lines) + paragraphs(dict.fromkeys([*found.notes, *rough.warnings]), "caution")
            return guessed, told + image(found.plot(new_axes()), "the surface, its summits bright")

        def tell(found: tuple[Choices, str]) -> None:
            guessed = found[0].keys("indenter")
            new = {name: value for name, value in guessed.items() if name not in chosen.keys("indenter")}
            self.choose(self.chosen.with_table("indenter", "height-map", guessed))
            for name, value in new.items():
                field = self.fields[f"indenter.height-map.{name}"]
                field.set_value(shown(self.in_unit(value)) if isinstance(value, float) else value)
                field.props('hint="this is a guess"')
            raw(found[1])

        what = f"reading {path.name}, {path.stat().st_size / 1e6:.3g} MB" if path.is_file() else ""
        self.later(self.of_surface, "indenter.height-map.file", what, look, tell)

    def load(self) -> None:
        chosen = self.chosen
        with ui.card():
            raw("<h2>3. Load and speeds</h2>")
            self.force = self.number("load.normal_force", chosen.force_label, chosen.force, partial(self.choose_one, "force"))
            self.fields["load.mean_pressure"] = self.force
            for name, path, label in SPEEDS:
                self.number(path, label, getattr(chosen, name), partial(self.choose_one, name))
            text = " ".join(map(shown, chosen.temperatures))
            self.text("material.file.temperature", "temperatures [°C]", text, lambda text: self.choose(temperatures=_choices.temperatures(text or "")))
            ui.switch("band of the material", value=chosen.band, on_change=lambda event: self.choose_one("band", event.value))
            self.file("measured", "measured friction", TABLES, chosen.measured, self.choose_measured)
            raw(paragraphs([ELSEWHERE]))

    # What comes of it.

    def results(self) -> None:
        with ui.card():
            with ui.row().classes("items-center wide"):
                ui.button("Compute", on_click=self.compute).props("no-caps").bind_enabled_from(self.project, "is_running", lambda on: not on)
                ui.button("Stop", on_click=self.project.stop).props("no-caps color=negative").bind_visibility_from(self.project, "is_running")
                self.told = ui.label().props("role=status")
            self.shown = ui.select({}, label="computation", on_change=self.show_other).classes("wide")
            self.bar = ui.linear_progress(0.0, show_value=False).props('aria-label="points that are computed"')
            self.problem = ui.label().classes("text-negative wide").props("role=alert")
            self.plot = ui.plotly(_curves.plotly({}, None)).classes("wide chart").props(PLOT)
            self.plot.on("plotly_click", self.clicked, ["points"])
            self.notes = ui.html("", sanitize=False).classes("wide notes")
            with ui.row().classes("wide gap-2"):
                for kind in ("Scene file", "Command", "Python", "CSV", "SVG", "PNG", "Report"):
                    is_text = kind in ("Scene file", "Command", "Python")
                    save = ui.button(kind, on_click=partial(self.show if is_text else self.give, kind), color=None).props("outline no-caps dense")
                    save.props("" if is_text else "icon=download")
            with ui.expansion("all points as a table").classes("wide"):
                self.table = ui.html("", sanitize=False).classes("wide")
        with ui.card():
            raw("<h2>The contact of a point</h2>")
            self.point = ui.select({}, label="point, or click on one", on_change=lambda event: self.look_at_point(event.value)).classes("wide point")
            self.of_point = ui.column().classes("wide")

    def compute(self) -> None:
        self.problem.set_text("")
        self.check(*self.fields.values())
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
        """Shows the newest choices and the state, and the points where there are other ones."""
        if self.chosen != self.known:
            self.forms()
        computation = self.project.computation
        self.bar.set_value(computation.done / computation.total if computation else 0.0)
        self.told.set_text(computation.told if computation else "nothing is computed yet")
        state = (computation, computation and computation.state, computation and computation.done, self.chosen.measured)
        if state == self.seen:
            return
        if self.seen is None or self.seen[:2] != state[:2]:
            # All tables of the folder are read, which takes too long for each point.
            listed = self.project.computations()
            self.shown.set_options(listed, value=computation.name if computation and computation.name in listed else None)
        self.seen = state
        self.draw()
        if computation and computation.problem:
            self.refuse(ValueError(computation.problem))

    def draw(self) -> None:
        sweeps = self.tried(self.project.sweeps) or {}
        self.plot.update_figure(_curves.plotly(sweeps, self.tried(self.project.measured, "measured")))
        self.point.set_options({f"{part}:{row}": text for (part, row), text in _curves.points(sweeps).items()})
        self.notes.set_content(paragraphs((self.said(line)[0] for line in _curves.notes(sweeps)), "caution"))
        self.table.set_content("".join(f"<h3>{html.escape(part)}</h3>" + sweep._repr_html_() for part, sweep in sweeps.items()))

    def clicked(self, event: events.GenericEventArguments) -> None:
        points = [point["customdata"] for point in event.args["points"] if point.get("customdata")]
        for part, row in points[:1]:
            self.point.set_value(f"{part}:{row}")

    def look_at_point(self, chosen: str | None) -> None:
        computation: Any = self.project.computation
        name = dict(self.point.options).get(chosen, "")

        def look() -> str:
            part, row = str(chosen).rsplit(":", 1)
            answer = computation.point(part, int(row))
            fields = FIELDS if answer.largest_temperature_rise is not None else FIELDS[:2]
            known = [field for field in fields if hasattr(answer, field) or hasattr(answer, f"line_{field}")]
            lines = [name, *(f"{answer.method} has no {field} of the contact" for field in fields if field not in known)]
            pictures = [image(answer.plot(new_axes(), field), f"{field} of the contact") for field in known]
            return paragraphs(lines) + paragraphs(answer.warnings, "caution") + "".join(pictures) + str(answer._repr_html_())

        def tell(found: str) -> None:
            raw(found)
            ui.run_javascript(f"setTimeout(() => getHtmlElement({self.point.id}).scrollIntoView({{behavior: 'smooth'}}), 200)")

        self.later(self.of_point, "", name and f"computing {name}", look, tell)

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
