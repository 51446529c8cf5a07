"""Type checkers know the words of options, and which numbers may be None."""

from __future__ import annotations

import inspect
import subprocess
import sys
import typing
from collections.abc import Iterator
from pathlib import Path

import pytest
import viscofriction as vf
from viscofriction._results import QUANTITIES

RIGHT = """
import numpy as np

import viscofriction as vf

rubber = vf.Prony(1e6, [(1e7, 1e-3)], valid_frequencies=(1.0, 1e3))
friction = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=np.logspace(-3, 1, 5), model="line", method="mdr-steady")
print(friction.mu + friction.mu_error, 2.0 * friction.friction_coefficient, abs(friction.tangential_force).max())
if friction.contact_area is not None:
    print(friction.contact_area.max())
moved = vf.move(vf.Cone(0.1), rubber, normal_force=1.0, stroke=1e-3, frequency=1.0, shape="triangular")
print(moved.peak_friction.max(), moved.warnings)
kept: list[vf.SlidingAnswer] = [friction, moved]
cycles: dict[str, vf.MovingAnswer] = {"first": moved}
tables: list[vf.Interface | vf.Heated | vf.StrainDependence] = [vf.ConstantShear(1e5)]
table = vf.sweep("scene.toml", {"load.velocity": [1.0, 2.0], "solve.model": ["line", "half-space"]}, sensitivity=True, samples=3)
print(table["friction_coefficient"].max())
fit = vf.fit_material("table.csv", wlf=(8.86, 101.6), temperature=20.0, vertical="entropic", deformation="shear")
print(fit.material.equilibrium_modulus, fit.max_relative_error)
curve = vf.fit_indentation("curve.csv", body=vf.Sphere(1e-6), material="power-law", thickness="fit")
found = vf.fit_friction([1.0, 2.0], [0.1, 0.2], scene="scene.toml", free=("moduli", "shift"), noise="absolute", prior="none")
bump = vf.HeightMap(np.ones((3, 3)), 1e-6, edges="mirrored", unit="um", heights_are="gap")
answer = vf.solve("scene.toml")
"""
WRONG = [
    'friction.friction',
    'friction.contact_area.max()',
    'vf.slide(vf.Sphere(1.0), rubber, velocity=1.0, model="lines")',
    'vf.press(vf.Sphere(1.0), rubber, method="bem")',
    'vf.move(vf.Cone(0.1), rubber, shape="square")',
    'vf.fit_material("table.csv", vertical="rubber")',
    'vf.read_moduli("table.csv", deformation="bending")',
    'vf.fit_indentation("curve.csv", body=vf.Sphere(1.0), material="maxwell")',
    'vf.fit_friction([1.0], [0.1], scene="scene.toml", noise="white")',
    'vf.HeightMap(np.ones((3, 3)), 1e-6, edges="open")',
]


def errors(script: Path) -> list[int]:
    """Lines of the script in which mypy finds errors, in a folder without the sources of the package."""
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", script.name]
    found = subprocess.run(command, cwd=script.parent, capture_output=True, text=True, check=False)
    assert not found.stderr, found.stderr
    lines = [line.split(":") for line in found.stdout.splitlines() if ": error:" in line]
    assert all(parts[0] == script.name for parts in lines), found.stdout
    return [int(parts[1]) for parts in lines]


def test_a_strict_checker_accepts_right_calls_and_refuses_wrong_words(tmp_path: Path) -> None:
    quantities = [f"print(answer.{name}, answer.{name}_error)" for name in QUANTITIES]
    lines = [*RIGHT.splitlines(), *quantities]
    script = tmp_path / "script.py"
    script.write_text("\n".join([*lines, *WRONG, ""]))
    assert errors(script) == [len(lines) + 1 + index for index in range(len(WRONG))]


def classes(annotation: object) -> Iterator[type]:
    """The classes of the package in an annotation."""
    if isinstance(annotation, type) and annotation.__module__.startswith("viscofriction"):
        yield annotation
    for part in typing.get_args(annotation):
        yield from classes(part)


@pytest.mark.parametrize("name", sorted(vf.__all__))
def test_every_class_of_a_signature_can_be_imported(name: str) -> None:
    public = getattr(vf, name)
    members = vars(public).items() if isinstance(public, type) else []
    described = [member for key, member in members if not key.startswith("_")] + [public]
    functions = [getattr(member, "fget", getattr(member, "__func__", member)) for member in described]
    for function in filter(inspect.isroutine, functions):
        found = {one for hint in typing.get_type_hints(function).values() for one in classes(hint)}
        assert {one.__name__ for one in found} <= set(vf.__all__)


def test_answers_are_of_the_class_that_the_signature_says() -> None:
    rubber = vf.StandardSolid(1e6, 1e7, 1e4)
    assert type(vf.slide(vf.Cone(0.1), rubber, normal_force=1.0, velocity=0.1, model="line")) is vf.SlidingAnswer
    assert type(vf.press(vf.Cone(0.1), vf.Elastic(1e6), normal_force=1.0)) is vf.Answer
    moved = vf.move(vf.Cone(0.1), rubber, normal_force=1.0, stroke=1e-3, frequency=1.0, model="line", relative_error=0.1)
    assert type(moved) is vf.MovingAnswer
