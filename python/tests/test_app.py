"""The page without a browser: what is chosen, and that scene file, command, program and tables of it are the same to the last bit."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import ExitStack, closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT

import viscofriction as vf

pytest.importorskip("nicegui", reason="the page needs the extra app")

from viscofriction import _bodies, _forms  # noqa: E402
from viscofriction.app import _choices, _curves, _work  # noqa: E402
from viscofriction.app._choices import Choices  # noqa: E402

DATA = ROOT / "examples" / "data"
BALL = Choices(
    material="tread-rubber.csv",
    tables={"indenter": {"sphere": {"radius": 5e-3}}},
    force=1.0,
    slowest=1e-3,
    fastest=1e-2,
    n_speeds=2,
    temperatures=(0.0, 20.0),
    relative_error=0.1,
)
HOT = replace(
    BALL,
    tables={**BALL.tables, "interface": {"constant": {"shear_strength": 1e5}}, "heat": {"": {"conductivity": 0.25, "diffusivity": 1.2e-7}}},
    n_speeds=1,
)
ROUGH = {"indenter": {"height-map": {"file": "road.x3p", "edges": "mirrored"}}}


def self_affine(**changed: Any) -> dict[str, Any]:
    keys = {"period": [0.01, 0.01], "hurst_exponent": 0.8, "rms_slope": 0.3, "longest_wavelength": 5e-3, "shortest_wavelength": 1e-3, "seed": 1}
    return {"indenter": {"self-affine": keys | changed}}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with files as a laboratory has them."""
    for name in ("tread-rubber.csv", "road.x3p", "dry-friction.csv"):
        shutil.copy(DATA / name, tmp_path)
    return tmp_path


def computed(choices: Choices, folder: Path) -> _work.Project:
    project = _work.Project(folder)
    project.choose(choices)
    project.compute().wait()
    assert project.computation is not None and project.computation.problem == "" and project.computation.state == "finished"
    return project


@pytest.mark.parametrize("choices", [BALL, replace(HOT, temperatures=(20.0,))], ids=["ball", "hot ball"])
def test_scene_command_and_python_compute_the_same_table(choices: Choices, folder: Path, tmp_path: Path, program: Callable[..., str]) -> None:
    project = computed(choices, folder)
    tables = project.exported("CSV")
    assert set(tables) == {"friction-1.csv", *(["friction-1-without-heat.csv"] if "heat" in choices.tables else [])}
    # By the commands, from the scene files and from nothing else than the material.
    for name in tables:
        (folder / name).unlink()
    [command] = project.exported("Command").values()
    lines = [line for line in command.decode().splitlines() if not line.startswith("#")]
    assert len(lines) == len(tables)
    where = os.getcwd()
    try:
        os.chdir(folder)
        for line in lines:
            program(*line.split()[1:])
    finally:
        os.chdir(where)
    assert {name: (folder / name).read_bytes() for name in tables} == tables
    # By the program in Python, from the table of moduli.
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    shutil.copy(folder / "tread-rubber.csv", elsewhere)
    [(name, script)] = project.exported("Python").items()
    (elsewhere / name).write_bytes(script)
    subprocess.run([sys.executable, name], check=True, cwd=elsewhere, env=os.environ | {"MPLBACKEND": "Agg"})
    assert {name: (elsewhere / name).read_bytes() for name in tables} == tables
    assert (elsewhere / "friction-1-material.toml").read_bytes() == (folder / "friction-1-material.toml").read_bytes()
    for name, text in project.exported("Scene file").items():
        assert (folder / name).read_bytes() == text


def test_the_material_is_that_of_the_command_in_the_comment(folder: Path, program: Callable[..., str]) -> None:
    choices = replace(BALL, reference_temperature=10.0, vertical="entropic", deformation="tension", band=False, n_speeds=1, temperatures=(10.0,))
    project = computed(choices, folder)
    [command] = project.exported("Command").values()
    comment = command.decode().splitlines()[0].split(": ", 1)[1].split()[1:]
    comment[comment.index("tread-rubber.csv")], comment[-1] = str(folder / "tread-rubber.csv"), str(folder / comment[-1])
    program(*comment)
    theirs, ours = (vf.MaterialFile(folder / name, temperature=10.0) for name in ("friction-1-fit/material.toml", "friction-1-material.toml"))
    omega = np.logspace(-2, 6, 30)
    assert (theirs.loss_modulus(omega) == ours.loss_modulus(omega)).all()


def test_a_stopped_computation_goes_on_also_after_a_new_start(folder: Path) -> None:
    many = replace(BALL, n_speeds=30, band=False)
    project = _work.Project(folder)
    project.choose(many)
    computation = project.compute()
    with pytest.raises(ValueError, match="a computation runs already"):
        project.compute()
    until = time.monotonic() + 120
    while computation.done < 2 and time.monotonic() < until:
        time.sleep(0.01)
    project.stop()
    computation.wait()
    assert computation.state == "stopped" and 2 <= computation.done < computation.total == 60
    assert "stopped; Compute goes on" in computation.told
    kept = (folder / "friction-1.csv").read_text().splitlines()
    again = _work.Project(folder)
    assert again.choices == many and again.computation is not None and again.computation.told == computation.told
    assert len(again.sweeps()["friction-1"]) == computation.done == len(kept) - 1
    again.compute().wait()
    assert again.computation.name == "friction-1" and again.computation.state == "finished"
    assert set(kept) <= set((folder / "friction-1.csv").read_text().splitlines())
    # Other choices, and other contents of a file, are another computation.
    again.choose(replace(many, force=2.0, n_speeds=1))
    again.compute().wait()
    assert again.computation.name == "friction-2" and again.files({".csv"}) == ["dry-friction.csv", "tread-rubber.csv"]
    (folder / "tread-rubber.csv").write_bytes((folder / "tread-rubber.csv").read_bytes() + b"\n")
    again.compute().wait()
    assert again.computation.name == "friction-3"
    # Earlier ones are found again.
    named = again.computations()
    assert list(named) == ["friction-3", "friction-2", "friction-1"]
    assert named["friction-1"] == "friction-1: tread-rubber.csv, sphere, normal force 1 N"
    again.show("friction-1")
    assert len(again.sweeps()["friction-1"]) == 60 and again.choices.force == 2.0


def test_points_are_drawn_with_their_parts_and_what_was_measured(folder: Path) -> None:
    project = computed(HOT, folder)
    project.choose(replace(HOT, measured="dry-friction.csv"))
    drawn = _curves.plotly(project.sweeps(), project.measured())
    json.dumps(drawn, allow_nan=False)
    names = [trace["name"] for trace in drawn["data"] if trace.get("showlegend", True)]
    assert names[:3] == ["0 °C", "0 °C, hysteresis", "0 °C, shear"] and "20 °C, without heat" in names and "measured, 0 °C" in names
    traces = {trace["name"]: trace for trace in drawn["data"]}
    assert traces["measured, 0 °C"]["marker"]["color"] == traces["0 °C"]["line"]["color"] != traces["measured, 40 °C"]["marker"]["color"]
    assert traces["0 °C, shear"]["mode"] == "markers", "a line through one point cannot be seen"
    assert drawn["layout"]["xaxis"]["visible"] and not drawn["layout"]["annotations"]
    empty = _curves.plotly({}, None)["layout"]
    assert not empty["xaxis"]["visible"] and "then Compute" in empty["annotations"][0]["text"]
    points = _curves.points(project.sweeps())
    assert points["friction-1-without-heat", 1].startswith("without heat, temperature T = 20 °C, speed v = 0.001 m/s: μ = ") and len(points) == 4
    assert project.computation is not None
    answer = project.computation.point("friction-1", 1)
    assert answer.mu == project.sweeps()["friction-1"]["friction_coefficient"][1]
    assert answer.temperature.max() > 0
    assert project.exported("SVG")["friction-1.svg"].lstrip().startswith(b"<?xml")
    assert project.exported("PNG")["friction-1.png"].startswith(b"\x89PNG")
    [report] = project.exported("Report").values()
    page = report.decode()
    assert page.count("<table>") == 2 and "[indenter.sphere]" in page and "viscofriction sweep" in page and "<script" not in page


def test_points_without_an_answer_are_named_with_the_reason(folder: Path) -> None:
    large = replace(BALL, force=600.0, slowest=1e-3, fastest=1e3, temperatures=(0.0,), band=False)
    project = computed(large, folder)
    warning, failure = _curves.notes(project.sweeps())
    assert warning.endswith("where linear theory ends (at 1 of 2 points)")
    assert failure.startswith("temperature T = 0 °C, speed v = 0.001 m/s: no answer: at x = ")
    [report] = project.exported("Report").values()
    assert "speed v = 0.001 m/s: no answer: at x = " in report.decode()
    assert project.computation is not None
    with pytest.raises(ValueError, match="a vertical wall of the indenter is in contact"):
        project.computation.point("friction-1", 0)


def test_the_number_of_a_point_has_its_total_uncertainty(folder: Path) -> None:
    sweep = computed(replace(BALL, n_speeds=1, temperatures=(20.0,)), folder).sweeps()["friction-1"]
    total = sweep["friction_coefficient_uncertainty"]
    assert total[0] > sweep["friction_coefficient_error"][0]
    assert sweep.points == [f"temperature T = 20 °C, speed v = 0.001 m/s: μ = {vf._results.with_bars(sweep['friction_coefficient'], total)[0]}"]


def test_the_remaining_time_falls_while_the_next_point_is_computed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    computation = _work.Computation(folder, BALL, "friction-1")
    computation.state, computation._done, computation._begun, computation._last = "running", {"friction-1": 1}, 100.0, 110.0
    told = []
    for now in (110.0, 115.0, 200.0):
        monkeypatch.setattr(_work.time, "monotonic", lambda: now)
        told.append(computation.told.rsplit(", ", 1)[1])
    assert told == ["about 30 s left", "about 25 s left", "about 0 s left"]


def test_a_height_map_is_read_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reads, read = [], _bodies._native.read_heights
    monkeypatch.setattr(_bodies._native, "read_heights", lambda table: reads.append(table) or read(table))
    _choices.surface(replace(BALL, tables=ROUGH), folder)
    assert len(reads) == 1


def test_a_file_that_takes_too_long_to_read_is_refused_at_once(folder: Path) -> None:
    with (folder / "huge.csv").open("wb") as file:
        file.truncate(200 << 20)
    project = _work.Project(folder)
    project.choose(replace(BALL, material="huge.csv", measured="huge.csv"))
    with pytest.raises(ValueError, match="measured: a table of friction has at most 8 MiB here, and huge.csv is larger"):
        project.measured()
    with pytest.raises(ValueError, match="huge.csv: a table of moduli has at most 8 MiB, and this file has 200 MiB"):
        _choices.fit(project.choices, folder)


def test_a_height_map_is_guessed_at_and_said_so(folder: Path) -> None:
    table = {"height-map": {"file": "road.x3p", "edges": "mirrored", "level": True}}
    body, guessed = _choices.surface(replace(BALL, tables={"indenter": table}), folder)
    assert guessed.keys("indenter") == table["height-map"] | {"shortest_wavelength": 3.2e-4} and guessed.is_periodic
    np.savetxt(folder / "micrometres.csv", body.heights * 1e6, delimiter=",")
    table = {"height-map": {"file": "micrometres.csv", "spacing": [4e-5, 4e-5]}}
    other, guessed = _choices.surface(replace(BALL, tables={"indenter": table}), folder)
    assert guessed.keys("indenter")["unit"] == "um" and not guessed.is_periodic and guessed.force_label == "normal force [N]"
    assert np.allclose(other.heights, body.heights, rtol=0, atol=1e-18)
    np.savetxt(folder / "millimetres.csv", body.heights * 1e3, delimiter=",")
    in_mm = {"height-map": {"file": "millimetres.csv", "spacing": [4e-5, 4e-5]}}
    assert _choices.surface(replace(BALL, tables={"indenter": in_mm}), folder)[1].keys("indenter")["unit"] == "mm"
    chosen = replace(BALL, tables={"indenter": {"height-map": table["height-map"] | {"unit": "mm"}}})
    assert _choices.surface(chosen, folder)[1].keys("indenter")["unit"] == "mm"


def test_lengths_keep_their_digits_in_every_unit() -> None:
    for shown, power, metres in ((0.1, -3, "0.0001"), (0.3, -3, "0.0003"), (5.0, -3, "0.005"), (320.0, -6, "0.00032"), (1e-3, -3, "1e-06"), (7, 0, "7.0")):
        length = _forms.shifted(shown, power)
        assert repr(length) == metres and _forms.shifted(length, -power) == shown
    for digits in np.random.default_rng(3).integers(1, 10**12, 1000).tolist():
        length = float(f"{digits}e-15")
        assert _forms.shifted(_forms.shifted(length, 3), -3) == length
    # The unit is no part of a computation.
    metres = replace(BALL, unit="m")
    assert _choices.stored(metres, Path()) == _choices.stored(BALL, Path()) and Choices.from_json(metres.to_json()) == metres
    assert Choices.from_json('{"unit": "inch"}').unit == "mm"


def test_what_is_no_number_is_kept_as_it_was_typed() -> None:
    for text in ("1,500", "300.000,5", "1,5,2", "12 mm", "1e-3 bis 1"):
        assert _forms.number(text) == text
    typed = ["0.01", "0,01", "3,0e5", " 3e5 ", "", None]
    assert [_forms.number(text) for text in typed] == [0.01, 0.01, 3e5, 3e5, None, None]
    assert _choices.temperatures("0, 20,5; 39") == (0.0, 20.5, 39.0) and _choices.temperatures("0 warm") == (0.0, "warm")
    assert [_forms.shown(number) for number in (3e5, 0.08, 1e-6, None, "1e-3 bis 1")] == ["300000", "0.08", "1e-06", "", "1e-3 bis 1"]
    wrong = replace(BALL, slowest="1e-3 bis 1", temperatures=(0.0, "warm"), tables={"indenter": {"sphere": {"radius": "5 mm"}}})
    assert Choices.from_json(wrong.to_json()) == wrong


def test_the_same_choices_are_known_again_in_any_order(folder: Path) -> None:
    (folder / "friction-1.json").write_text(_choices.stored(HOT, folder), "utf-8")
    tables = dict(reversed(list(HOT.tables.items())))
    assert list(tables) != list(HOT.tables)
    assert _choices.name_for(replace(HOT, tables=tables), folder) == "friction-1"
    assert _choices.name_for(replace(HOT, n_speeds=3), folder) == "friction-2"


def test_a_layer_is_a_table_of_the_scene() -> None:
    assert _choices.scene(replace(BALL, thickness=2e-3), "friction-1")["layer"] == {"thickness": 2e-3}
    assert "layer" not in _choices.scene(BALL, "friction-1")


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        ({"thickness": 0.0}, "layer.thickness must be finite and greater than 0, but is 0"),
        ({"tables": ROUGH | {"heat": {"": {"conductivity": 0.25, "diffusivity": 1.2e-7}}}}, "heat.duration is needed: the time"),
        ({"material": ""}, "material: a table of moduli is needed"),
        ({"tables": {}}, "indenter: a body is needed"),
        ({"tables": {"indenter": {"height-map": {}}}}, "indenter.height-map.file is needed: File in the folder"),
        ({"tables": {"indenter": {"sphere": {"radius": -1.0}}}}, "indenter.sphere.radius must be finite and greater than 0, but is -1"),
        ({"tables": {"indenter": {"sphere": {"radius": None}}}}, "indenter.sphere.radius must be finite and greater than 0, but is missing"),
        ({"tables": {"indenter": {"sphere": {"radius": "5 mm"}}}}, "indenter.sphere.radius must be finite and greater than 0, but is 5 mm"),
        ({"tables": self_affine(seed=1.5)}, "indenter.self-affine.seed must be a whole number, but is 1.5"),
        ({"tables": self_affine(period=[0.01, None])}, "indenter.self-affine.period[1] must be finite and greater than 0, but is missing"),
        ({"force": None}, "load.normal_force must be finite and greater than 0, but is missing"),
        ({"force": 0.0, "tables": ROUGH}, "load.mean_pressure must be finite and greater than 0, but is 0"),
        ({"slowest": -1.0}, "load.velocity.slowest must be finite and greater than 0, but is -1"),
        ({"slowest": "1e-3 bis 1"}, "load.velocity.slowest must be finite and greater than 0, but is 1e-3 bis 1"),
        ({"fastest": 1e-4}, "load.velocity.fastest must be greater than the slowest, 0.001 m/s, but is 0.0001"),
        ({"n_speeds": 2.5}, "load.velocity.count must be a whole number from 1 to 1000, but is 2.5"),
        ({"n_speeds": 100000.0}, "load.velocity.count must be a whole number from 1 to 1000, but is 100000"),
        ({"temperatures": (0.0, 0.0)}, "material.file.temperature: a temperature is given twice"),
        ({"temperatures": tuple(range(7))}, "material.file.temperature: at most 6 temperatures"),
        ({"temperatures": (0.0, "warm")}, "material.file.temperature must be numbers between blanks, such as 0 20.5 39, but is 0 warm"),
        ({"relative_error": 0.0}, "solve.relative_error must be greater than 0 and at most 0.1, but is 0"),
        ({"relative_error": 2.0}, "solve.relative_error must be greater than 0 and at most 0.1, but is 2"),
        ({"relative_error": None}, "solve.relative_error must be greater than 0 and at most 0.1, but is missing"),
    ],
)
def test_what_is_wrong_is_named_before_anything_is_computed(wrong: dict[str, Any], problem: str, folder: Path) -> None:
    project = _work.Project(folder)
    project.choose(replace(BALL, **wrong))
    with pytest.raises(ValueError) as refused:
        project.compute()
    assert str(refused.value).startswith(problem)
    assert not list(folder.glob("friction-*"))
    # The field alone says the same when it is left, and no field that is right says anything.
    path = problem.split(" ")[0].rstrip(":")
    with pytest.raises(ValueError) as refused:
        _choices.check(project.choices, path)
    assert str(refused.value).startswith(problem)
    for other in {"load.velocity.slowest", "load.velocity.count", "solve.relative_error", "layer.thickness"} - {path}:
        if not path.startswith("load.velocity") or not other.startswith("load.velocity"):
            _choices.check(project.choices, other)


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        ({"material": "road.x3p"}, "road.x3p"),
        ({"temperatures": (0.0, 100.0)}, "material.file.temperature"),
        ({"tables": {"indenter": {"height-map": {"file": "tread-rubber.csv"}}}}, "tread-rubber.csv:5: the columns have the names"),
    ],
)
def test_what_only_the_computation_finds_wrong_is_said(wrong: dict[str, Any], problem: str, folder: Path) -> None:
    project = _work.Project(folder)
    project.choose(replace(BALL, **wrong))
    project.compute().wait()
    assert project.computation is not None and project.computation.state == "failed" and problem in project.computation.problem
    # It leaves no entry, and its number is free.
    assert project.computations() == {} and not list(folder.glob("friction-*"))
    # What was there before stays: another program may be about to compute it.
    kept = folder / "friction-1.json"
    kept.write_text(_choices.stored(project.choices, folder), "utf-8")
    project.compute().wait()
    assert kept.exists() and project.computation.name == "friction-1"
    for path in folder.glob("friction-*"):
        path.unlink()
    project.choose(replace(BALL, n_speeds=1, temperatures=(0.0,), band=False))
    project.compute().wait()
    assert list(project.computations()) == ["friction-1"]


def test_dropped_files_never_replace_others(folder: Path, tmp_path: Path) -> None:
    project = _work.Project(folder)
    before = (folder / "road.x3p").read_bytes()
    dropped = tmp_path / "dropped"
    for content, kept in ((b"other", "road (2).x3p"), (before, "road.x3p"), (b"third", "road (3).x3p")):
        dropped.write_bytes(content)
        assert project.keep("C:\\scans\\road.x3p", dropped) == kept
        assert (folder / kept).read_bytes() == content
    dropped.write_bytes(b"x")
    assert project.keep("../../.hidden", dropped) == "hidden" and not dropped.exists()
    assert (folder / "road.x3p").read_bytes() == before
    (folder / "friction-7.csv").write_text("v (m/s),mu\n1,0.1\n")
    assert "friction-7.csv" in project.files({".csv"}), "it belongs to no computation"
    assert project.files({".x3p"}) == ["road (2).x3p", "road (3).x3p", "road.x3p"]


def test_choices_of_other_versions_and_damaged_ones_do_no_harm(folder: Path) -> None:
    assert Choices.from_json(HOT.to_json()) == HOT
    assert Choices.from_json('{"material": "a.csv", "colour": 1}') == Choices(material="a.csv")
    for text in ("[]", '{"tables": 1}', "nothing"):
        (folder / "viscofriction-app.json").write_text(text)
        (folder / "friction-1.json").write_text(text)
        project = _work.Project(folder)
        assert project.choices == Choices() and project.computation is None
    kept = {path.read_text() for path in folder.glob("viscofriction-app-unreadable*.json")}
    assert kept == {"[]", '{"tables": 1}', "nothing"}


def test_the_page_is_at_this_machine_and_needs_the_token(folder: Path) -> None:
    import http.client
    import urllib.parse

    command = [sys.executable, "-c", "from viscofriction.app import main; main()", folder, "--no-browser", "--threads", "1"]
    # NiceGUI behaves otherwise where it sees that it is tested.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder, env=environment) as server, ExitStack() as ended:
        ended.callback(server.kill)
        assert server.stdout is not None
        address = urllib.parse.urlsplit(server.stdout.readline().strip())
        assert address.hostname == "127.0.0.1" and address.port is not None

        def answer(path: str, **headers: str) -> tuple[int, str, str]:
            with closing(http.client.HTTPConnection("127.0.0.1", address.port, timeout=60)) as connection:
                connection.request("GET", path, headers=headers)
                found = connection.getresponse()
                return found.status, found.getheader("Set-Cookie") or "", found.read().decode()

        deadline = time.monotonic() + 120
        while time.monotonic() < deadline:
            try:
                answer("/")
                break
            except ConnectionRefusedError:
                time.sleep(0.1)
        assert answer("/")[0] == answer("/?token=guess")[0] == answer("/_nicegui/socket.io/")[0] == 403
        assert "Whoever has started the program finds the address in the terminal" in answer("/")[2]
        status, cookie, _ = answer(f"/?{address.query}")
        assert status == 303 and "HttpOnly" in cookie and "samesite=strict" in cookie.lower()
        cookie = cookie.split(";")[0]
        assert answer("/", Cookie=cookie)[0] == 200
        assert answer("/", Cookie=cookie + "x")[0] == answer("/", Cookie=cookie, Host="elsewhere.example")[0] == 403
    refused = subprocess.run([*command[:3], folder / "absent"], capture_output=True, text=True, cwd=folder, env=environment)
    assert refused.returncode == 2 and "absent is no folder" in refused.stderr
