"""A computation in the folder: its files, its thread, its progress, and the points that are there."""

from __future__ import annotations

import asyncio
import filecmp
import math
import os
import re
import threading
import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import viscofriction as vf

from .. import _native
from .._fitting import LARGEST_TABLE
from .._plotting import file_of
from .._sweeping import Sweep, page_of, write_whole
from . import _choices, _curves
from ._choices import Choices

#: Names of the files of computations.
OWN = re.compile(r"(friction-\d+)(-without-heat|-material)?\.(csv|toml)")


class Computation:
    """The sweeps of some choices, in files of the folder that ``vf.sweep`` and the program go on with.

    ``state``, ``problem``: "ready", "running", "stopped", "finished" or "failed", and the sentence of what ended it.
    ``done``, ``total``: Points that are computed, and all of them.
    """

    def __init__(self, folder: Path, choices: Choices, name: str) -> None:
        self.folder, self.choices, self.name = folder, choices, name
        self.problem = ""
        tables = {part: self.table(part) for part in _choices.parts(choices, name)}
        self._done = {part: len(vf.read_sweep(table)) if table.exists() else 0 for part, table in tables.items()}
        self.total = math.prod(map(len, _choices.vary(choices).values())) * len(self._done)
        #: When this run began, with how many points, and when the last point was finished.
        self._begun, self._before, self._last = 0.0, 0, 0.0
        #: Set to ask for the end; the points that are computed stay.
        self.is_ending = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self.state = "finished" if self.done == self.total else "stopped" if self.done else "ready"

    @classmethod
    def all(cls, folder: Path) -> Iterator[Computation]:
        """Those of the folder whose files are whole, the newest first."""
        for name in _choices.named(folder):
            with suppress(ValueError, TypeError, OSError):
                yield cls(folder, Choices.from_json((folder / f"{name}.json").read_text("utf-8")), name)

    def table(self, part: str) -> Path:
        """The file of the points of a part."""
        return self.folder / f"{part}.csv"

    @property
    def done(self) -> int:
        """How many points are computed."""
        return sum(self._done.values())

    @property
    def told(self) -> str:
        """The state as a sentence, with an estimate of what is left from the points of this run; it falls while the next one is computed."""
        now, left = self.done - self._before, "about to begin"
        if now:
            of_missing = (self._last - self._begun) / now * (self.total - self.done)
            left = f"about {max(0.0, of_missing - (time.monotonic() - self._last)):.0f} s left"
        words = {"running": left, "stopped": "stopped; Compute goes on", "finished": "finished", "failed": "ended by an error"}
        return f"{self.name}: {self.done} of {self.total} points, {words.get(self.state, 'Compute begins')}"

    def point(self, part: str, row: int) -> vf.Answer:
        """The answer of a point with its fields and its budget. Raises ValueError with the reason for a point that has none, and NotReached."""
        sweep = self.sweeps()[part]
        if failure := sweep.failures[row]:
            raise ValueError(failure)
        scene = vf.scene_of_point(self.folder / f"{part}.toml", sweep, row)
        return vf.solve(scene, sensitivity=_choices.with_band(self.choices, scene))

    def sweeps(self) -> dict[str, Sweep]:
        """The points that are in the files, by the names of the parts."""
        return {part: vf.read_sweep(self.table(part)) for part in self._done if self.table(part).exists()}

    def start(self) -> None:
        """Writes the files of the scenes and computes the missing points in a thread of its own."""
        self.state, self.problem = "running", ""
        self.is_ending.clear()
        self._begun, self._before = time.monotonic(), self.done
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def wait(self) -> None:
        """Returns when the thread has ended."""
        self._thread.join()

    def _run(self) -> None:
        is_new = not (self.folder / f"{self.name}.json").exists()
        try:
            self._write()
            for part in self._done:
                self._sweep(part)
            self.state = "finished" if self.done == self.total else "stopped"
        except Exception as error:  # Whatever it is, the page says it, and stays.
            self.state, self.problem = "failed", str(error) or type(error).__name__
        if is_new and not self.done:
            self._remove()

    def _write(self) -> None:
        scenes = {part: _native.toml_text(table) for part, table in _choices.parts(self.choices, self.name).items()}
        if self.choices.is_fitted:
            text = _choices.fit(self.choices, self.folder).material.to_toml()
            write_whole(self.folder / _choices.material_file(self.choices, self.name), text)
        for part, text in scenes.items():
            write_whole(self.folder / f"{part}.toml", text)
        write_whole(self.folder / f"{self.name}.json", _choices.stored(self.choices, self.folder))

    def _remove(self) -> None:
        """Gives the name back, for which this run has begun files and there are no points."""
        for name in (f"{self.name}.json", f"{self.name}-material.toml", *(f"{part}.{ends}" for part in self._done for ends in ("toml", "csv"))):
            (self.folder / name).unlink(missing_ok=True)

    def _sweep(self, part: str) -> None:
        def count(done: int, _: int) -> None:
            self._done[part], self._last = done, time.monotonic()

        if self._done[part] < self.total // len(self._done):
            vary, band = _choices.vary(self.choices), _choices.with_band(self.choices, _choices.parts(self.choices, self.name)[part])
            scene, out = self.folder / f"{part}.toml", self.table(part)
            vf.sweep(scene, vary, sensitivity=band, out=out, resume=True, progress=count, stop=self.is_ending.is_set)


class Project:
    """What all pages of one folder share: the choices, and the computation that runs or has run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        #: What is read and computed for the page, one after another for each key.
        self.locks: defaultdict[object, asyncio.Lock] = defaultdict(asyncio.Lock)
        self.computation = next(Computation.all(folder), None)
        self.choices = Choices() if self.computation is None else self.computation.choices
        self._draft = folder / "viscofriction-app.json"
        try:
            self.choices = Choices.from_json(self._draft.read_text("utf-8"))
        except FileNotFoundError:
            pass
        except (ValueError, TypeError):
            # Whatever it is, it is not lost.
            self.keep("viscofriction-app-unreadable.json", self._draft)

    @property
    def is_running(self) -> bool:
        """Whether a computation runs: one at a time, so that pages do not slow each other."""
        return self.computation is not None and self.computation.state == "running"

    def choose(self, choices: Choices) -> None:
        """Keeps the choices, also for the next start."""
        self.choices = choices
        write_whole(self._draft, choices.to_json())

    def compute(self) -> Computation:
        """Begins the computation of the choices, or goes on with it. Raises ValueError for what is missing or wrong."""
        if self.is_running:
            raise ValueError("a computation runs already, perhaps of another page; stop it first")
        name = _choices.name_for(self.choices, self.folder)
        self.computation = Computation(self.folder, self.choices, name)
        self.computation.start()
        return self.computation

    def computations(self) -> dict[str, str]:
        """What the computations of the folder are of, by their names, the newest first."""
        return {one.name: f"{one.name}: {one.choices.title}" for one in Computation.all(self.folder)}

    def show(self, name: str) -> None:
        """Shows another computation of the folder. Raises ValueError while one runs."""
        if self.is_running:
            raise ValueError("a computation runs; stop it before another one is shown")
        self.computation = next((one for one in Computation.all(self.folder) if one.name == name), self.computation)

    def files(self, ends: set[str]) -> list[str]:
        """The names of the files in the folder with one of these ends, without those of its computations."""
        paths = sorted(self.folder.iterdir(), key=lambda path: path.name.lower())
        names = [path.name for path in paths if path.is_file() and path.suffix.lower() in ends and not path.name.startswith(".")]
        known = set(_choices.named(self.folder))
        return [name for name in names if not ((own := OWN.fullmatch(name)) and own[1] in known)]

    def keep(self, name: str, dropped: Path) -> str:
        """Keeps a dropped file under its name, or one with a number where another file has that; returns the name."""
        base = Path(Path(name.replace("\\", "/")).name.lstrip(".") or "file")
        path, count = self.folder / base, 1
        while path.exists() and not filecmp.cmp(path, dropped, shallow=False):
            count += 1
            path = self.folder / f"{base.stem} ({count}){base.suffix}"
        os.replace(dropped, path)
        return path.name

    def stop(self) -> None:
        """Ends the computation that runs; its points stay."""
        if self.computation is not None:
            self.computation.is_ending.set()

    def shown(self) -> tuple[Choices, str]:
        """The choices and the name of the computation that is shown, or of the one that would begin."""
        if self.computation is not None:
            return replace(self.computation.choices, measured=self.choices.measured), self.computation.name
        return self.choices, _choices.name_for(self.choices, self.folder)

    def measured(self) -> vf.MeasuredFriction | None:
        """The chosen table of friction. Raises ValueError with line and column."""
        path = self.folder / self.choices.measured
        if path.is_file() and path.stat().st_size > LARGEST_TABLE:
            raise ValueError(f"measured: a table of friction has at most {LARGEST_TABLE >> 20} MiB here, and {path.name} is larger")
        return vf.read_friction(path) if self.choices.measured else None

    def sweeps(self) -> dict[str, Sweep]:
        """The points of the computation that is shown."""
        return {} if self.computation is None else self.computation.sweeps()

    def exported(self, kind: str) -> dict[str, bytes]:
        """Files by their names: "Scene file", "Command", "Python", "CSV", "SVG", "PNG" or "Report" of what is shown. Raises ValueError for
        what is missing in the choices, and without points."""
        choices, name = self.shown()
        scenes = {f"{part}.toml": _native.toml_text(table) for part, table in _choices.parts(choices, name).items()}
        command, python = {f"{name}.sh": _choices.command(choices, name)}, {f"{name}.py": _choices.python(choices, name)}
        texts = {"Scene file": scenes, "Command": command, "Python": python}
        if kind in texts:
            return {file: text.encode() for file, text in texts[kind].items()}
        sweeps = self.sweeps()
        if not any(map(len, sweeps.values())):
            raise ValueError("there are no points yet")
        if kind == "CSV":
            return {f"{part}.csv": (self.folder / f"{part}.csv").read_bytes() for part in sweeps}
        axes = _curves.drawn(sweeps, self.measured())
        if kind != "Report":
            return {f"{name}.{kind.lower()}": file_of(axes, kind.lower())}
        below = {file: text for of in texts.values() for file, text in of.items()}
        return {f"{name}.html": page_of(f"Friction over the speed: {name}", axes, sweeps, below).encode()}
