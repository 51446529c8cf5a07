"""A scene for many values of its keys, on one machine or on the workers of a cluster."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, numbers
from ._solving import Progress, Scene, read, shown

__all__ = ["Sweep", "sweep"]

# Rows that are computed before they are written.
BATCH = 64


class Sweep(Compared):
    """The rows of a sweep, in the order of the points; the last key varies fastest."""

    def __init__(self, header: list[str], rows: list[list[str]], keys: list[str]) -> None:
        self._header = header
        self._rows = rows
        #: The keys that vary.
        self.keys = keys

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        """The numbers of a column by the name that it has in the CSV, NaN where not known."""
        index = self._header.index(column) if column in self._header else None
        if index is None:
            raise KeyError(f"there is no column {column!r}; there are {', '.join(self._header)}")
        return np.array([float(row[index]) if row[index] else np.nan for row in self._rows])

    @property
    def failures(self) -> list[str | None]:
        """Of each point why it has no answer, or None."""
        return [row[-1] or None for row in self._rows]

    def to_dict(self) -> dict[str, list[Any]]:
        """Columns by their names, as numbers where they are numbers."""
        texts = ("sweep", "check", "method", "model", "failure")
        columns: dict[str, list[Any]] = {}
        for index, name in enumerate(self._header):
            cells = [row[index] for row in self._rows]
            columns[name] = cells if name in texts else [float(cell) if cell else None for cell in cells]
        return columns

    def to_csv(self, file: str | os.PathLike[str]) -> None:
        """Writes the table of the program's ``sweep``; a file that is there is not replaced."""
        with Path(file).open("x", encoding="utf-8", newline="") as out:
            out.write(_line(self._header) + "".join(map(_line, self._rows)))

    def __repr__(self) -> str:
        failed = sum(failure is not None for failure in self.failures)
        failures = f", {failed} without an answer" if failed else ""
        return f"<{len(self)} points over {', '.join(self.keys)}{failures}>"

    def plot(self, ax: Any = None, quantity: str = "friction_coefficient") -> Any:
        """Draws a quantity, with its bars over one key that varies, as colours over two; returns the axes of matplotlib."""
        from . import _plotting

        over = [(key, self[key]) for key in self.keys]
        if len(over) == 2:
            return _plotting.grid(_plotting.axes(ax), over, (quantity, self[quantity]))
        if len(over) != 1:
            raise ValueError(f"one key must vary, or two, but {len(over)} do")
        bars = self[quantity + "_error"]
        return _plotting.lines(_plotting.axes(ax), over[0], {}, (quantity, self[quantity], bars))


def sweep(
    scene: Scene,
    vary: Mapping[str, ArrayLike],
    *,
    client: Any = None,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: Progress = None,
) -> Sweep:
    """Solves a scene for all combinations of the values of its keys, such as ``vary={"load.velocity": v}``.

    With a ``client`` of dask.distributed each point is a task of that cluster, done again where a worker dies; rows and their
    order are the same to the last bit. ``out`` is a CSV file, written as points are finished; with ``resume`` the points
    that it holds are not computed again.

    What a method could not reach is part of its row. Raises ValueError for wrong input, before anything is computed.
    """
    table, folder, heights = read(scene)
    if heights is not None:
        raise ValueError("indenter: a sweep needs the heights in a file, {'height-map': {'file': …, 'spacing': …}}")
    values = [(key, numbers(key, wanted, dimensions=1)) for key, wanted in vary.items()]
    request = {"scene": table, "folder": os.path.abspath(folder), "vary": values}
    header, identities = _native.sweep_plan(request)
    rows: list[list[str] | None] = [None] * len(identities)
    if out is not None:
        _begin(Path(out), header, identities, rows, resume)
    missing = [point for point, row in enumerate(rows) if row is None]
    with shown(progress) as show:
        done = len(rows) - len(missing)
        for batch in _batches(request, missing, client):
            for point, row in batch:
                rows[point] = row
            if out is not None:
                with Path(out).open("a", encoding="utf-8", newline="") as file:
                    file.write("".join(_line(row) for _, row in batch))
            done += len(batch)
            if show is not None:
                show(done, len(rows))
    finished = [row for row in rows if row is not None]
    return Sweep(header, finished, list(vary))


def _batches(request: dict[str, Any], points: list[int], client: Any) -> Any:
    """Points and their rows, in order, some at a time."""
    if client is None:
        for start in range(0, len(points), BATCH):
            batch = points[start : start + BATCH]
            yield list(zip(batch, _native.sweep_points(request, batch, None), strict=True))
        return
    futures = [client.submit(_row, request, point, pure=False) for point in points]
    for point, future in zip(points, futures, strict=True):
        yield [(point, future.result())]


def _row(request: dict[str, Any], point: int) -> list[str]:
    # What has travelled need not be aligned.
    vary = [(key, numbers(key, values)) for key, values in request["vary"]]
    return _native.sweep_points(request | {"vary": vary}, [point], None)[0]


def _begin(
    file: Path,
    header: list[str],
    identities: list[list[str]],
    rows: list[list[str] | None],
    resume: bool,
) -> None:
    """Writes the names into a new file, or reads the rows of an older one that are of this sweep."""
    if not file.exists():
        file.write_text(_line(header), encoding="utf-8")
        return
    if not resume:
        raise FileExistsError(f"{file} is there already; resume=True goes on with it")
    text = file.read_text(encoding="utf-8")
    whole = text[: text.rfind("\n") + 1]
    old = list(csv.reader(io.StringIO(whole)))
    if not old or old[0] != header:
        raise ValueError(f"{file} is not the table of this sweep: its columns differ")
    for row in old[1:]:
        point = int(row[1]) - 1 if len(row) == len(header) and row[1].isdecimal() else -1
        if not 0 <= point < len(rows) or row[: len(identities[point])] != identities[point]:
            raise ValueError(f"{file} is not the table of this sweep: it holds other points")
        rows[point] = row
    if whole != text:
        # The last line was not finished.
        os.truncate(file, len(whole.encode("utf-8")))


def _line(fields: list[str]) -> str:
    line = io.StringIO()
    csv.writer(line, lineterminator="\n").writerow(fields)
    return line.getvalue()
