"""Work away from the interpreter: interruption, progress, other threads, tables that go on, clusters."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import viscofriction as vf

SCENE = {
    "indenter": vf.Sphere(5e-3),
    "material": vf.StandardSolid(1e6, 1e7, 1e4),
    "load": {"normal_force": 2.0, "velocity": 1.0},
    "solve": {"relative_error": 1e-2},
}
SPEEDS = np.logspace(-2, 1, 12)

# Whoever starts the tests may have interruptions ignored.
LONG = """
import signal
import viscofriction as vf
signal.signal(signal.SIGINT, signal.default_int_handler)

def progress(done, count):
    if done == 1:
        print("begun", flush=True)

vf.slide(
    vf.Sphere(5e-3), vf.StandardSolid(1e6, 1e7, 1e4), normal_force=2.0, velocity=[1.0] * 10000, progress=progress
)
"""


FORKING = """
import os, signal, warnings
import numpy as np
import viscofriction as vf
warnings.simplefilter("ignore")

def answers():
    solid = vf.StandardSolid(1e6, 1e7, 1e4)
    return [
        vf.slide(vf.Sphere(5e-3), solid, normal_force=2.0, velocity=[0.1, 1.0], relative_error=0.05),
        vf.slide(vf.Sphere(5e-3), solid, normal_force=2.0, velocity=1.0, relative_error=0.05, threads=2),
        vf.indent(vf.Sphere(5e-6), solid, time=[0.0, 1.0], indentation_depth=[0.0, 1e-7], thickness=1e-5, relative_error=0.1),
    ]

before = answers()
child = os.fork()
if child == 0:
    signal.alarm(30)
    os._exit(0 if answers() == before else 3)
assert os.waitpid(child, 0)[1] == 0, "the child has no answers, or others"
assert answers() == before
"""


def test_a_fork_computes_with_threads_of_its_own(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", FORKING], check=True, cwd=tmp_path, timeout=60)


def test_an_interruption_ends_the_work_at_once(tmp_path: Path) -> None:
    # In a folder without the sources of the package, which would hide the installed one.
    command = [sys.executable, "-c", LONG]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "begun\n"
        child.send_signal(signal.SIGINT)
        try:
            _, errors = child.communicate(timeout=20)
        finally:
            child.kill()
    assert "KeyboardInterrupt" in errors


def test_other_threads_run_and_progress_is_told() -> None:
    counted = 0
    ended = threading.Event()

    def count() -> None:
        nonlocal counted
        while not ended.is_set():
            counted += 1
            ended.wait(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    told: list[tuple[int, int]] = []
    try:
        vf.slide(
            vf.Sphere(5e-3),
            vf.StandardSolid(1e6, 1e7, 1e4),
            normal_force=2.0,
            velocity=SPEEDS,
            relative_error=1e-2,
            progress=lambda done, count: told.append((done, count)),
        )
    finally:
        ended.set()
        thread.join()
    assert counted > 10
    assert told[-1] == (12, 12) and sorted(told) == told


def test_what_progress_raises_comes_back() -> None:
    def stop(done: int, count: int) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        vf.solve(SCENE, progress=stop)


def test_a_table_goes_on_where_it_ended(tmp_path: Path) -> None:
    whole = vf.sweep(SCENE, {"load.velocity": SPEEDS})
    whole.to_csv(tmp_path / "whole.csv")
    text = (tmp_path / "whole.csv").read_text()
    lines = text.splitlines(keepends=True)
    part = tmp_path / "part.csv"
    part.write_text("".join(lines[:5]) + lines[5][:20])
    with pytest.raises(FileExistsError):
        vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=part)
    vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=part, resume=True)
    assert part.read_text() == text
    with pytest.raises(ValueError, match="other points"):
        vf.sweep(SCENE, {"load.velocity": 2 * SPEEDS}, out=part, resume=True)
    assert part.read_text() == text
    friction = whole["friction_coefficient"][0]
    part.write_text(text.replace(f",{friction},", ",nan,", 1))
    with pytest.raises(ValueError, match="line 2, .*friction_coefficient, is \"nan\", and not what was computed"):
        vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=part, resume=True)


def test_a_finished_table_that_is_resumed_says_so(tmp_path: Path) -> None:
    file = tmp_path / "rows.csv"
    whole = vf.sweep(SCENE, {"load.velocity": SPEEDS[:2]}, out=file)
    with pytest.warns(UserWarning, match=r"no point was computed: .*rows\.csv has all 2 already"):
        again = vf.sweep(SCENE, {"load.velocity": SPEEDS[:2]}, out=file, resume=True)
    assert again == whole


def test_a_stopped_sweep_keeps_its_points_and_is_continued(tmp_path: Path) -> None:
    file, speeds = tmp_path / "rows.csv", np.logspace(-4, 1, 40)
    done: list[int] = []
    part = vf.sweep(SCENE, {"load.velocity": speeds}, out=file, progress=lambda n, _: done.append(n), stop=lambda: len(done) >= 2)
    assert 2 <= len(part) == done[-1] < 40 and (part["points"] == 40).all()
    assert vf.read_sweep(file) == part
    none = vf.sweep(SCENE, {"load.velocity": speeds}, out=file, resume=True, stop=lambda: True)
    assert none == part
    whole = vf.sweep(SCENE, {"load.velocity": speeds}, out=file, resume=True)
    assert whole == vf.sweep(SCENE, {"load.velocity": speeds}) and len(whole) == 40


def test_a_long_point_does_not_hold_up_a_stop() -> None:
    scene = SCENE | {"solve": {"relative_error": 1e-6}}
    until = time.monotonic() + 0.2
    stopped = vf.sweep(scene, {"load.velocity": [1e-3, 1.0]}, stop=lambda: time.monotonic() > until)
    assert time.monotonic() < until + 20.0 and len(stopped) <= 2


def test_the_table_of_a_sweep_is_read_back(tmp_path: Path) -> None:
    file = tmp_path / "rows.csv"
    vary = {"load.velocity": SPEEDS, "solve.model": ["line", "half-space"]}
    whole = vf.sweep(SCENE, vary, out=file)
    assert vf.read_sweep(file) == whole
    assert list(vf.read_sweep(file)["solve.model"][:2]) == ["line", "half-space"]
    text = file.read_text()
    file.write_text(text[:-20])
    assert len(vf.read_sweep(file)) == len(whole) - 1
    file.write_text(text.replace(f",{whole['friction_coefficient'][1]},", ",1.5,", 1))
    with pytest.raises(ValueError, match='rows.csv, line 3: column .*friction_coefficient, is "1.5", and not what was computed'):
        vf.read_sweep(file)
    for other in (b"x,y\n1,2\n", b"\xff\xfe\x00", b""):
        file.write_bytes(other)
        with pytest.raises(ValueError, match="rows.csv is not the table of a sweep"):
            vf.read_sweep(file)
    with pytest.raises(ValueError, match="a regular file of at most"):
        vf.read_sweep(tmp_path)


SWEEPING = """
import signal
import sys
import numpy as np
import viscofriction as vf

signal.signal(signal.SIGINT, signal.default_int_handler)
scene = {"indenter": vf.Sphere(5e-3), "material": vf.StandardSolid(1e6, 1e7, 1e4)}
scene |= {"load": {"normal_force": 2.0, "velocity": 1.0}, "solve": {"relative_error": 5e-3}}
vf.sweep(scene, {"load.velocity": np.logspace(-2, 1, 10000)}, out=sys.argv[1], progress=lambda done, _: print(done, flush=True))
"""


def test_an_interrupted_sweep_keeps_every_finished_row(tmp_path: Path) -> None:
    command = [sys.executable, "-c", SWEEPING, tmp_path / "rows.csv"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path
    ) as child:
        assert child.stdout is not None
        told = [child.stdout.readline() for _ in range(3)]
        child.send_signal(signal.SIGINT)
        more, errors = child.communicate(timeout=20)
    done = [int(line) for line in "".join([*told, more]).splitlines()]
    rows = (tmp_path / "rows.csv").read_text().splitlines(keepends=True)
    assert "KeyboardInterrupt" in errors
    # A row is written before it is told, and the interruption may come between both.
    assert done[-1] <= len(rows) - 1 < 100 and rows[-1].endswith("\n")
    assert {row.count(",") for row in rows} == {rows[0].count(",")}


def test_a_table_has_one_writer_and_ends_in_order(tmp_path: Path) -> None:
    file = tmp_path / "rows.csv"
    whole = vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=file)
    text = file.read_text()
    assert text.splitlines()[1:] == [",".join(row) for row in whole._rows]
    first, *rows = text.splitlines(keepends=True)
    file.write_text("".join([first, *rows[:1:-1]]))

    def again(done: int, count: int) -> None:
        with pytest.raises(ValueError, match="another sweep is writing it"):
            vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=file, resume=True)

    vf.sweep(SCENE, {"load.velocity": SPEEDS}, out=file, resume=True, progress=again)
    assert file.read_text() == text
    assert [path.name for path in tmp_path.iterdir()] == ["rows.csv"]


def test_a_cluster_gives_the_same_rows_when_a_worker_dies(tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    alone = vf.sweep(SCENE, {"load.velocity": SPEEDS})
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        processes = list(client.run(os.getpid).values())

        def kill(done: int, count: int) -> None:
            assert len(file.read_text().splitlines()) == done + 1, "a row was reported before it was written"
            if done >= 3 and processes:
                os.kill(processes.pop(), signal.SIGKILL)
                processes.clear()

        file = tmp_path / "rows.csv"
        shared = vf.sweep(SCENE, {"load.velocity": SPEEDS}, client=client, out=file, progress=kill)
    assert not processes
    assert shared._rows == alone._rows
    alone.to_csv(tmp_path / "alone.csv")
    assert file.read_text() == (tmp_path / "alone.csv").read_text()
