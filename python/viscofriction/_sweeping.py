"""A scene for many values of its keys, on one machine or on the workers of a cluster."""

from __future__ import annotations

import copy
import csv
import io
import os
import re
import shlex
import shutil
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import reduce
from pathlib import Path
from pprint import pformat
from typing import IO, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, count, numbers, text_of
from ._friction import MeasuredFriction
from ._results import QUANTITIES, html_page, html_table, noted, with_bars, with_unit
from ._solving import MAX_SCENE_SIZE, Progress, Scene, read, shown

__all__ = ["Sweep", "read_sweep", "scene_of_point", "sweep"]

# Columns that hold no numbers, and those that hold whole ones; keys may hold either.
TEXTS = {"sweep", "check", "program", "method", "model", "warnings", "failure"}
WHOLE = {"point", "points", "unknowns"}

# Largest table of a sweep that is read back, [bytes]: 1 GiB, for more rows than a sweep may have points.
MAX_SWEEP_SIZE = 64 * MAX_SCENE_SIZE

Row = list[str]
Finished = list[tuple[int, Row]]


class Sweep(Compared):
    """The rows of a sweep, in the order of the points; the last key varies fastest.

    ``keys`` are those that vary; ``table["friction_coefficient"]`` is a column, and ``pandas.DataFrame(table.to_dict())`` has all.
    """

    def __init__(self, header: Row, rows: list[Row], vary: dict[str, Any]) -> None:
        self._header = header
        self._rows = rows
        self._texts = TEXTS | {key for key, values in vary.items() if isinstance(values, list)}
        #: The keys that vary.
        self.keys = list(vary)

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, column: str) -> NDArray[Any]:
        """The numbers of a column by the name that it has in the CSV, NaN where not known; texts of one that holds texts."""
        if column not in self._header:
            raise KeyError(f"there is no column {column!r}; there are {', '.join(self._header)}")
        cells = self._cells(column)
        return np.array(cells) if column in self._texts else np.array([float(cell) if cell else np.nan for cell in cells])

    def _cells(self, column: str) -> Row:
        index = self._header.index(column)
        return [row[index] for row in self._rows]

    @property
    def failures(self) -> list[str | None]:
        """Of each point why it has no answer, or None."""
        return [text or None for text in self._cells("failure")]

    @property
    def warnings(self) -> list[str]:
        """Sentences about the validity of the answers, each once, with how many points have it; the column has all."""
        return _native.shared_warnings([text.split(" | ") if text else [] for text in self._cells("warnings")])

    @property
    def points(self) -> list[str]:
        """Of each point what varies, and its friction with the total standard uncertainty where that is known, else with its error."""
        from ._plotting import label

        total, error = self._known("friction_coefficient_uncertainty"), self["friction_coefficient_error"]
        errors = error if total is None else np.where(np.isnan(total), error, total)
        printed = with_bars(self["friction_coefficient"], errors)
        parts = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", label(key)) for key in self.keys]
        names = [(part[1], f" {part[2]}" if part[2] else "") for part in parts if part is not None]
        values = [[f"{value:g}" if isinstance(value, float) else value for value in self[key].tolist()] for key in self.keys]
        where = [", ".join(f"{name} = {value}{unit}" for (name, unit), value in zip(names, row)) for row in zip(*values)]
        return [f"{place}: {'μ = ' + friction if friction else 'no answer'}" for place, friction in zip(where, printed)]

    @property
    def notes(self) -> list[str]:
        """The ``warnings``, and of each point without an answer what varies and why it has none."""
        return [*self.warnings, *(f"{point}: {failure}" for point, failure in zip(self.points, self.failures) if failure)]

    def to_dict(self) -> dict[str, list[Any]]:
        """Columns by their names, numbers as int and float, None where not known; a column of which nothing is known is left out."""
        columns: dict[str, list[Any]] = {}
        for name in self._header:
            cells = self._cells(name)
            if name in self._texts:
                columns[name] = list(cells)
            elif any(cells):
                number = int if name in WHOLE else float
                columns[name] = [number(cell) if cell else None for cell in cells]
        return columns

    def to_csv(self, file: str | os.PathLike[str]) -> None:
        """Writes the table of the program's ``sweep``; a file that is there is not replaced."""
        with Path(file).open("x", encoding="utf-8", newline="") as out:
            out.write(_text(self._header, *self._rows))

    def __repr__(self) -> str:
        failed = sum(failure is not None for failure in self.failures)
        failures = f", {failed} without an answer" if failed else ""
        warnings = "".join(f"\n{text}" for text in noted(self.warnings))
        return f"<{len(self)} points over {', '.join(self.keys)}{failures}{warnings}>"

    def _repr_html_(self) -> str:
        return self._html()

    def _html(self, *, all_rows: bool = False) -> str:
        known = [name for name in QUANTITIES if any(self._cells(name))]
        head = [*self.keys, *(with_unit(name, QUANTITIES[name][1][0]) for name in known)]
        columns = [self._cells(key) for key in self.keys]
        columns += [with_bars(self[name], self[f"{name}_error"]) for name in known]
        rows = list(zip(*columns, strict=True))
        return html_table(f"{len(self)} points", head, rows, self.notes, all_rows=all_rows)

    def plot(
        self,
        ax: Any = None,
        quantity: str = "friction_coefficient",
        *,
        measured: MeasuredFriction | None = None,
        name: str = "",
        style: str = "-",
        parts: bool = True,
    ) -> Any:
        """Draws a quantity with its bars over the key that has the most values, a line for each combination of the others where they
        are few, or as colours over two; returns the axes of matplotlib.

        Beside friction are its parts from hysteresis and shear, Persson's theory, and the band of an uncertain material, where they are
        known, and ``measured`` friction. ``name`` is what the legend says of all lines, and ``style`` their line.
        Without ``parts`` only the lines, bars and bands are drawn.
        """
        from . import _plotting

        keys = {key: self[key] for key in self.keys}
        drawn = (quantity, self[quantity], self[quantity + "_error"])
        curves = _plotting.BESIDE if parts and quantity == "friction_coefficient" else ()
        known = tuple((what, line, values) for key, what, line in curves if (values := self._known(key)) is not None)
        beside = _plotting.Beside(self._known(f"{quantity}_material_error"), known, name, style)
        axes = _plotting.table(_plotting.axes(ax), keys, drawn, beside)
        if measured is not None:
            _plotting.measured(axes, measured.velocity, measured.mu, measured.standard_error, measured.temperature)
        return axes

    def to_html(self, file: str | os.PathLike[str], *, picture: Any = None, texts: Mapping[str, str] | None = None) -> None:
        """Writes a page of its own with the picture, all points with their errors, the warnings, and ``texts`` by their names, such as the
        scene; a file that is there is not replaced. ``picture`` are axes of matplotlib, those of ``plot`` unless others are given."""
        axes, title = self.plot() if picture is None else picture, f"A sweep over {' and '.join(self.keys)}"
        with Path(file).open("x", encoding="utf-8") as out:
            out.write(page_of(title, axes, {"": self}, texts or {}))

    def _known(self, column: str) -> NDArray[np.float64] | None:
        """The numbers of a column of which something is known."""
        values = self[column] if column in self._header else np.array([np.nan])
        return None if np.isnan(values).all() else values


def page_of(title: str, picture: Any, sweeps: Mapping[str, Sweep], texts: Mapping[str, str]) -> str:
    """A page of its own with a picture, axes of matplotlib, all points of the sweeps below their names, and texts that unfold."""
    drawn = io.StringIO()
    picture.figure.savefig(drawn, format="svg")
    svg = drawn.getvalue()
    tables = [(f"<h2>{name}</h2>" if name else "") + sweep._html(all_rows=True) for name, sweep in sweeps.items()]
    return html_page(title, svg[svg.index("<svg") :] + "".join(tables), texts)


def command_of(scene: str, vary: Mapping[str, list[float]], out: str, *, sensitivity: bool, measured: str = "") -> str:
    """The command of the program that computes the table ``out`` of a sweep of a scene file over numbers, or goes on with it."""
    # A list has two values and more.
    ranges = {key: ",".join(map(repr, values)) if len(values) > 1 else f"{values[0]!r}:{values[0]!r}:1" for key, values in vary.items()}
    words = ["viscofriction sweep", shlex.quote(scene), *(f"--vary {key}={values}" for key, values in ranges.items())]
    options = ["--sensitivity"] * sensitivity + [f"--measured {shlex.quote(measured)}"] * bool(measured)
    return " ".join([*words, *options, f"--resume --out {shlex.quote(out)}"])


def program_of(scene: Mapping[str, Any], vary: Mapping[str, list[float]], out: str, *, sensitivity: bool, picture: str) -> str:
    """Lines of Python that compute the table ``out`` of a sweep, or go on with it, and draw its picture; ``vf`` is this package."""
    lines = [f"scene = {pformat(scene, sort_dicts=False)}", f"vary = {pformat(vary, sort_dicts=False)}"]
    lines += [f"sweep = vf.sweep(scene, vary, sensitivity={sensitivity}, out={out!r}, resume=True)"]
    return "\n".join([*lines, f"sweep.plot().figure.savefig({picture!r})", ""])


def scene_of_point(scene: Scene, sweep: Sweep, row: int) -> dict[str, Any]:
    """The scene of one point of its sweep, for ``vf.solve``, which has its fields; files are named from the root of the file system."""
    given, folder, _ = read(scene)
    table = copy.deepcopy(given)
    for family in ("indenter", "material", "interface", "strain"):
        for keys in (keys for keys in table.get(family, {}).values() if isinstance(keys, dict)):
            keys |= {name: os.path.abspath(os.path.join(folder, keys[name])) for name in ("file", "path") if name in keys}
    for key in sweep.keys:
        *above, last = key.split(".")
        value = sweep[key][row].item()
        reduce(lambda place, name: place.setdefault(name, {}), above, table)[last] = value
    return table


def sweep(
    scene: Scene,
    vary: Mapping[str, ArrayLike] | None = None,
    *,
    sensitivity: bool = False,
    samples: int | None = None,
    client: Any = None,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: Progress = None,
    stop: Callable[[], object] | None = None,
) -> Sweep:
    """Solves a scene for all combinations of the values of its keys, such as ``vary={"load.velocity": v}``.

    Values are numbers, or texts: files, ``{"material.file.path": ["a.toml", "b.toml"]}``, and words of a scene,
    ``{"solve.model": ["line", "half-space"]}``.

    With ``sensitivity`` there are columns of what the covariance of the material (``friction_coefficient_material_error``) and all
    uncertainties of the scene (``friction_coefficient_uncertainty``) make of every point. ``samples`` draws what is uncertain so
    many times, from 1 to 999999: the key ``sample`` then varies too, and its value 0 is the scene itself with these columns.

    With a ``client`` of dask.distributed each point is a task of that cluster, done again where a worker dies; rows are the
    same to the last bit. ``out`` is a CSV file, to which each point is added, and ``progress`` called, as soon as it is finished,
    in any order; at the end the file is sorted. With ``resume`` the points that it holds are not computed again, as after
    an interruption; where it holds all of them a warning says so.

    ``stop`` is asked about every 50 ms, with a client at every finished point: once it is true, no more points are computed, and
    the sweep has those that are finished, fewer than its column ``points`` says. ``out`` keeps them, and ``resume`` goes on. Other
    threads run while a sweep computes.

    What a method could not reach is part of its row. Raises ValueError for wrong input, before anything is computed.
    """
    table, folder, heights = read(scene)
    if heights is not None:
        raise ValueError("indenter: a sweep needs the heights in a file, {'height-map': {'file': …, 'spacing': …}}")
    if vary is None and samples is not None:
        vary = {}
    if not isinstance(vary, Mapping):
        raise ValueError(f"vary must be a dictionary of keys and their values, such as {{'load.velocity': v}}, but is {text_of(vary)}")
    values = {key: _values(key, wanted) for key, wanted in vary.items()}
    request: dict[str, Any] = {
        "scene": table,
        "folder": os.path.abspath(folder),
        "vary": list(values.items()),
        "sensitivity": sensitivity,
        "samples": count("samples", samples),
    }
    header, n_points = _native.sweep_plan(request)
    rows: list[Row | None] = [None] * n_points
    with shown(progress) as show, _opened(out, header, request, rows, resume) as file:
        missing = [point for point, row in enumerate(rows) if row is None]
        done = len(rows) - len(missing)
        if not missing:
            warnings.warn(f"no point was computed: {out} has all {len(rows)} already", stacklevel=2)

        def take(finished: Finished) -> None:
            nonlocal done
            if file is not None and finished:
                file.write(_text(*(row for _, row in finished)))
                file.flush()
            for point, row in finished:
                rows[point] = row
            done += len(finished)
            if show is not None and finished:
                show(done, len(rows))
            if stop is not None and stop():
                raise _Stopped

        with suppress(_Stopped):
            if missing:
                take([])
                _compute(request, missing, client, take)
        complete = [row for row in rows if row is not None]
        if out is not None:
            # In the order of the points.
            write_whole(Path(out).resolve(), _text(header, *complete))
    if samples is not None:
        values["sample"] = np.arange(samples + 1.0)
    return Sweep(header, complete, values)


class _Stopped(Exception):
    """No more points are wanted."""


def read_sweep(file: str | os.PathLike[str]) -> Sweep:
    """The points in the table of a sweep, of this package or of the program, also while it is written and after an interruption.

    A last line that is not complete is left out. Raises ValueError for another file, and for a row that was changed.
    """
    path = Path(file)
    if not path.is_file() or path.stat().st_size > MAX_SWEEP_SIZE:
        raise ValueError(f"{path}: a regular file of at most {MAX_SWEEP_SIZE} bytes is needed")
    try:
        text = path.read_bytes().decode("utf-8-sig")
        header, *rows = list(csv.reader(io.StringIO(text[: text.rfind("\n") + 1]))) or [[]]
    except (UnicodeDecodeError, csv.Error):
        header, rows = [], []
    if header[:3] != ["sweep", "point", "points"] or "check" not in header:
        raise ValueError(f"{path} is not the table of a sweep, whose columns begin with sweep, point, points")
    is_whole = [len(row) == len(header) and row[1].isdecimal() for row in rows]
    problem = (is_whole.index(False), "there is no point") if not all(is_whole) else _native.changed_row(header, rows)
    if problem is not None:
        raise ValueError(f"{path}, line {problem[0] + 2}: {problem[1]}")
    rows.sort(key=lambda row: int(row[1]))
    keys = header[3 : header.index("check")]
    cells = {key: [row[3 + place] for row in rows] for place, key in enumerate(keys)}
    return Sweep(header, rows, {key: column if any(map(_is_text, column)) else () for key, column in cells.items()})


def _is_text(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return True
    return False


def _values(key: str, wanted: Any) -> NDArray[np.float64] | list[str]:
    """Numbers as an array; texts, files, True and False as a list of texts."""
    if isinstance(wanted, list | tuple | np.ndarray):
        texts = [
            str(value).lower() if isinstance(value, bool | np.bool_) else str(os.fspath(value))
            for value in wanted
            if isinstance(value, str | os.PathLike | bool | np.bool_)
        ]
        if texts and len(texts) == len(wanted):
            return texts
    return numbers(key, wanted, dimensions=1)


def _compute(request: dict[str, Any], points: list[int], client: Any, take: Callable[[Finished], None]) -> None:
    """Hands over points and their rows as they are finished."""
    if client is None:
        _native.sweep_points(request, points, take)
        return
    import distributed

    as_completed: Any = distributed.as_completed
    futures = client.map(_row, points, request=request, pure=False)
    try:
        for _, finished in as_completed(futures, with_results=True):
            take([finished])
    finally:
        # After an interruption nobody waits for them.
        client.cancel(futures)


def _row(point: int, request: dict[str, Any]) -> tuple[int, Row]:
    # What has travelled need not be aligned.
    vary = [(key, values if isinstance(values, list) else numbers(key, values)) for key, values in request["vary"]]
    finished: Finished = []
    _native.sweep_points(request | {"vary": vary}, [point], finished.extend)
    return finished[0]


@contextmanager
def _opened(
    out: str | os.PathLike[str] | None,
    header: Row,
    request: dict[str, Any],
    rows: list[Row | None],
    resume: bool,
) -> Iterator[IO[str] | None]:
    """A new file with its names, or an older one whose rows, which are of this sweep, are read; closed to other writers."""
    if out is None:
        yield None
        return
    path = Path(out)
    if path.exists() and not resume:
        raise FileExistsError(f"{path} is there already; resume=True goes on with it")
    with path.open("a+", encoding="utf-8", newline="") as file:
        _lock(file, path)
        file.seek(0)
        text = file.read()
        whole = text[: text.rfind("\n") + 1]
        for row in _old_rows(path, whole, header, request):
            rows[int(row[1]) - 1] = row
        # The last line need not be finished.
        file.truncate(len(whole.encode("utf-8")))
        file.write("" if whole else _text(header))
        file.flush()
        yield file


def _old_rows(path: Path, text: str, header: Row, request: dict[str, Any]) -> list[Row]:
    """The rows of an older file, which are refused if they are of another sweep, or not what was computed."""
    first, *old = list(csv.reader(io.StringIO(text))) or [header]
    if first != header:
        raise ValueError(f"{path} is not the table of this sweep: its columns differ")
    points = [int(row[1]) - 1 if len(row) == len(header) and row[1].isdecimal() else -1 for row in old]
    if any(point < 0 for point in points):
        raise ValueError(f"{path}, line {points.index(-1) + 2}: there is no point")
    problem = _native.sweep_problem(request, list(zip(points, old, strict=True)))
    if problem is not None:
        raise ValueError(f"{path}, line {problem[0] + 2}, is not of this sweep: {problem[1]}")
    return old


def _lock(file: IO[str], path: Path) -> None:
    """Refuses a file that another process writes, the program included, where the system can tell."""
    try:
        import fcntl
    except ImportError:
        return
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise ValueError(f"{path}: another sweep is writing it") from None


def write_whole(path: Path, text: str) -> None:
    """Writes a file so that it is whole or the old one; one that is there with this text stays as it is."""
    if path.exists() and path.read_bytes() == text.encode("utf-8"):
        return
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8", newline="")
    if path.exists():
        shutil.copymode(path, part)
    part.replace(path)


def _text(*rows: Row) -> str:
    lines = io.StringIO()
    csv.writer(lines, lineterminator="\n").writerows(rows)
    return lines.getvalue()
