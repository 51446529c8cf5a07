"""The numbers are those of the program, to the last bit."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import SCENES

import viscofriction as vf



@pytest.mark.parametrize("name", sorted(path.stem for path in SCENES.glob("*.toml")))
def test_a_scene_has_the_answer_of_the_program(name: str, program: Callable[..., str]) -> None:
    scene = SCENES / f"{name}.toml"
    printed = json.loads(program("run", scene, "--format", "json"))
    ours = json.loads(json.dumps(vf.solve(scene).to_dict()))
    del printed["seconds"]
    printed["left_out"].remove("files")
    assert ours == printed


def test_a_sweep_has_the_rows_of_the_program(program: Callable[..., str], tmp_path: Path) -> None:
    scene = SCENES / "cone-viscous.toml"
    program("sweep", scene, "--vary", "load.velocity=0.1,0.2,0.3", "--out", tmp_path / "sweep.csv")
    table = vf.sweep(scene, {"load.velocity": [0.1, 0.2, 0.3]})
    table.to_csv(tmp_path / "ours.csv")
    theirs, ours = ((tmp_path / name).read_text().splitlines() for name in ("sweep.csv", "ours.csv"))
    # The first column is the fingerprint of the text of the scene.
    assert [row.split(",")[1:] for row in ours] == [row.split(",")[1:] for row in theirs]


def test_arrays_have_the_answers_of_single_loads() -> None:
    rubber = vf.StandardSolid(1e6, 1e7, 1e4)
    speeds = np.logspace(-3, 2, 6)
    every = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=speeds, relative_error=1e-2)
    for index in (0, 3, 5):
        one = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=speeds[index], relative_error=1e-2)
        assert every.mu is not None and every.mu[index] == one.mu
        assert every.area is not None and every.area[index] == one.area


def test_a_history_is_named_arrays() -> None:
    answer = vf.solve(SCENES / "press-hold-pull-press.toml")
    history = answer.history
    assert set(history) == {"time", "normal_force", "indentation_depth", "contact_radius"}
    assert (np.diff(history["time"]) >= 0).all() and history["normal_force"].max() > 0
