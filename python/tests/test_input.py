"""Wrong input is a ValueError that names it; arrays come in any layout."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofriction as vf

RUBBER = vf.Prony(1e6, [(1e7, 1e-3)])
BALL = vf.Sphere(5e-3)
BUMP = np.add.outer(np.linspace(-1, 1, 33) ** 2, np.linspace(-1, 1, 33) ** 2) * 1e-3

WRONG: list[tuple[str, dict[str, Any]]] = [
    ("velocity", {"velocity": np.nan}),
    ("velocity", {"velocity": [1.0, np.inf]}),
    ("velocity", {"velocity": []}),
    ("velocity", {"velocity": np.zeros((0, 3))}),
    ("velocity", {"velocity": np.array([1.0, None])}),
    ("velocity", {"velocity": "fast"}),
    ("velocity", {"velocity": 1j}),
    ("velocity", {"velocity": [True]}),
    ("velocity", {"velocity": [[1.0], [1.0, 2.0]]}),
    ("velocity", {"velocity": 0.0}),
    ("velocity", {"velocity": [1.0, -1.0]}),
    ("velocity", {"velocity": np.ones(2), "normal_force": np.ones(3)}),
    ("velocity", {"velocity": np.ma.masked_greater([1.0, 2.0], 1.5)}),
    ("velocity", {"velocity": [1.0, np.ma.masked]}),
    ("normal_force", {"normal_force": -2.0}),
    ("normal_force", {"normal_force": None}),
    ("indentation_depth", {"indentation_depth": 1e-5}),
    ("relative_error", {"relative_error": 2.0}),
    ("elements", {"elements": 3}),
    ("threads", {"threads": 0}),
    ("method", {"method": "guess"}),
    ("model", {"model": "line", "method": "bem-steady"}),
    ("indenter", {"body": "ball"}),
    ("indenter must be a Body of this package, but is 5e-06", {"body": 5e-6}),
    ("interface must be a ConstantShear, BellShear or ShearFile of this package, but is '1e5'", {"interface": "1e5"}),
    ("one-dimensional model", {"interface": vf.ConstantShear(1e5), "model": "line"}),
    ("no-such-table", {"interface": vf.ShearFile("no-such-table.csv")}),
    ("heat must be a Heat of this package, but is 0.25", {"heat": 0.25}),
    ("heat.duration", {"heat": vf.Heat(0.25, diffusivity=1e-7, duration=1.0)}),
    ("no-such-file", {"material": vf.MaterialFile("no-such-file.toml")}),
    ("material", {"material": None}),
    ("material must be a Material of this package, but is a Fit; give its .material", {"material": vf.Fit(RUBBER, 0.0, 0.0)}),
]


@pytest.mark.parametrize(("name", "change"), WRONG, ids=lambda value: str(value))
def test_wrong_input_is_named(name: str, change: dict[str, Any]) -> None:
    given: dict[str, Any] = {"body": BALL, "material": RUBBER, "normal_force": 2.0, "velocity": 1.0} | change
    with pytest.raises(ValueError, match=name.replace("[", r"\[")):
        vf.slide(given.pop("body"), given.pop("material"), **given)


MAKERS: list[tuple[str, Callable[[], Any]]] = [
    ("interface.constant.shear_strength must be finite and greater than 0, but is -1", lambda: vf.ConstantShear(-1.0)),
    ("interface.bell.width must be finite and greater than 0, but is 0", lambda: vf.BellShear(1e5, 1e-3, width=0.0)),
    ("heat: how fast heat spreads is not known", lambda: vf.Heat(0.25)),
    ("heat.counterface.share must be from 0 to 1, but is 2", lambda: vf.Heat(0.25, diffusivity=1e-7, counterface={"share": 2.0})),
    ("indenter.sphere.radius must be finite and greater than 0, but is -1", lambda: vf.Sphere(-1.0)),
    ("indenter.sphere.radius: invalid type: string \"large\"", lambda: vf.Sphere("large")),  # type: ignore[arg-type]
    ("indenter.cone.slope must be finite and greater than 0, but is 0", lambda: vf.Pyramid(0.0)),
    ("indenter.superposition.terms[0].exponent must be finite and greater than 0", lambda: vf.Superposition([(1.0, -1.0)])),
    ("indenter.superposition.terms[0]: a table is needed", lambda: vf.Superposition([(1.0,)])),  # type: ignore[list-item]
    ("indenter.height-map.direction must be 0, 90, 180 or 270, but is 45", lambda: vf.HeightMapFile("map.csv", direction=45)),
    ("indenter.height-map.unit: it must be \"m\", \"mm\", \"um\" or \"nm\", but is \"inch\"", lambda: vf.HeightMapFile("map.csv", unit="inch")),  # type: ignore[arg-type]
    ("material.elastic.poisson_ratio must be greater than -1 and at most 0.5", lambda: vf.Elastic(1e6, poisson_ratio=0.6)),
    ("material.prony.branches[0].relaxation_time must be finite", lambda: vf.Prony(1e6, [(1e6, 0.0)])),
    ("material.file.poisson_ratio must be greater than -1", lambda: vf.MaterialFile("rubber.toml", poisson_ratio=1.0)),
    (
        "indenter.self-affine.shortest_wavelength: it must not be longer than longest_wavelength, 0.1 m, but is 1 m",
        lambda: vf.SelfAffine((1.0, 1.0), 0.5, 0.1, 0.1, 1.0, 1),
    ),
    ("indenter.superposition", lambda: vf.Superposition([(1.0, 2.0), (-1.0, 1.0)])),
    ("material.springpot.time_range", lambda: vf.Springpot(1e6, 0.5, (1.0, 0.1))),
    ("material.elastic.valid_frequencies[0] must be finite", lambda: vf.Elastic(1e6, valid_frequencies=(-1.0, 1.0))),
]


@pytest.mark.parametrize(("message", "make"), MAKERS, ids=lambda value: value if isinstance(value, str) else "")
def test_a_wrong_number_is_named_where_the_object_is_made(message: str, make: Callable[[], Any]) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        make()


def test_files_are_those_of_the_folder_where_the_object_is_made(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "rubber.toml").write_text("[material.elastic]\nshear_modulus = 2.0\n")
    monkeypatch.chdir(tmp_path)
    rubber = vf.MaterialFile(Path("rubber.toml"))
    assert rubber.path == "rubber.toml" and rubber.storage_modulus([1.0])[0] == 2.0


@pytest.mark.parametrize(
    ("name", "heights", "spacing"),
    [
        ("heights", np.ones(3), 1.0),
        ("^heights: the map is flat", np.ones((3, 3)), 1.0),
        ("heights", np.full((3, 3), np.nan), 1.0),
        ("heights", np.ones((3, 3), dtype=object), 1.0),
        ("heights", np.ones((0, 3)), 1.0),
        ("1 of 9 heights are missing", np.ma.masked_less(np.arange(9.0).reshape(3, 3), 1.0), 1.0),
        ("2 of 4 heights are missing", [np.ma.masked_less([1.0, 2.0], 1.5)] * 2, 1.0),
        ("spacing", np.ones((3, 3)), 0.0),
        ("spacing", np.ones((3, 3)), (1.0, 2.0, 3.0)),
    ],
)
def test_a_wrong_height_map_is_named(name: str, heights: Any, spacing: Any) -> None:
    with pytest.raises(ValueError, match=name):
        vf.HeightMap(heights, spacing)


class Table(dict[str, Any]):
    """A table with named columns, as pandas has them."""

    columns = ("modulus", "relaxation_time")


LAW = {"temperature": 20.0, "temperature_range": [0.0, 40.0], "law": {"wlf": [8.0, 100.0]}}
SHIFTED = vf.Fit(vf.Prony(1e6, [(1e7, 1e-3)], shift=LAW), 0.0, 0.0, temperature=20.0)
CURVE = {name: np.arange(40.0) for name in ("time", "depth", "force")}

CALLS: list[tuple[str, Callable[[Any], Any], list[Any]]] = [
    (
        "branches must be a list of pairs",
        lambda branches: vf.Prony(1e6, branches),
        [{"modulus": 1e6, "relaxation_time": 1.0}, Table(), 5.0, "ab", [1e6, 1.0], [(1e6, 1.0, 2.0)], ["ab"]],
    ),
    ("branches must be a whole number", lambda n: vf.fit_material([1.0], [1.0], [1.0], branches=n), [{}, 1.5, -1, True]),
    ("branches must be a whole number", lambda n: vf.fit_relaxation([1.0], [1.0], branches=n), [[2]]),
    ("branches must be a whole number", lambda n: vf.fit_indentation(CURVE, body=BALL, branches=n), [{}]),
    ("scene must be the name of a scene file", vf.solve, [None, 5]),
    ("scene must be the name of a scene file", lambda scene: vf.sweep(scene, {}), [None]),
    ("vary must be a dictionary of keys", lambda vary: vf.sweep({"indenter": BALL, "material": RUBBER}, vary), [None, 1.0]),
    ("temperature must be", SHIFTED.at, [np.ones(2), None, "warm", np.nan]),
    ("^material.file.temperature: ", lambda key: vf.sweep({"indenter": BALL, "material": RUBBER, "load": {}}, {key: [20.0]}), ["material.file.temperature"]),
    ("exponent must be", vf.scaling_factor, [np.ones(2), None, np.inf]),
    ("body must be a Body", lambda body: vf.fit_indentation(CURVE, body=body), [5e-6, None]),
    (
        "body must be a body of revolution, but is a HeightMap",
        lambda body: vf.fit_indentation(CURVE, body=body),
        [vf.HeightMap(BUMP, 1e-4), vf.HeightMapFile("map.csv")],
    ),
    ("spring_constant has no effect", lambda k: vf.fit_indentation(CURVE, body=BALL, spring_constant=k), [0.1]),
    ("sensitivity and ramp_rate are for files", lambda rate: vf.fit_indentation(CURVE, body=BALL, ramp_rate=rate), [1.0]),
]


@pytest.mark.parametrize(("message", "call", "wrong"), CALLS, ids=lambda value: value if isinstance(value, str) else "")
def test_a_wrong_argument_is_named(message: str, call: Callable[[Any], Any], wrong: list[Any]) -> None:
    for value in wrong:
        with pytest.raises(ValueError, match=message):
            call(value)


def test_masked_points_of_a_curve_are_refused_by_name() -> None:
    time = np.linspace(0.0, 1.0, 20)
    hidden = np.ma.masked_greater(time, 0.9)
    for name in ("time", "depth", "force"):
        curve = {"time": time, "depth": time, "force": time, name: hidden}
        with pytest.raises(ValueError, match=f"{name} must not have masked entries"):
            vf.fit_indentation(**curve, body=BALL)
    with pytest.raises(ValueError, match="loss must not have masked entries"):
        vf.fit_material(time, time, hidden)


def test_heights_come_in_any_layout() -> None:
    def depth(heights: Any) -> Any:
        pressed = vf.press(
            vf.HeightMap(heights, 1e-4, heights_are="gap"), vf.Elastic(1e6), normal_force=0.1, relative_error=1e-2
        )
        return pressed.indentation_depth

    expected = depth(BUMP)
    single = BUMP.astype(np.float32)
    wide = np.zeros((66, 66))
    wide[::2, ::2] = BUMP
    shifted = np.frombuffer(b"." + BUMP.tobytes(), dtype=np.float64, offset=1).reshape(BUMP.shape)
    assert depth(BUMP.astype(">f8")) == expected
    for heights in (shifted, np.asfortranarray(BUMP), BUMP[::-1, ::-1][::-1, ::-1], wide[::2, ::2], BUMP.tolist()):
        assert depth(heights) == expected
    assert depth(single) == depth(single.astype(np.float64))


def test_loads_come_in_any_layout() -> None:
    speeds = np.array([0.01, 0.02, 0.03, 0.04])
    cone, oil = vf.Cone(0.1), vf.Viscous(1e4)
    forces = np.array([[1.0], [2.0]])
    every = vf.slide(cone, oil, normal_force=forces, velocity=speeds)
    back = vf.slide(cone, oil, normal_force=forces, velocity=speeds[::-1])
    assert every.shape == (2, 4)
    assert (every.tangential_force == back.tangential_force[:, ::-1]).all()


def test_what_is_not_reached_comes_with_what_was() -> None:
    soft = vf.Prony(100.0, [(1e3, 1.0)])
    with pytest.raises(vf.NotReached, match="normal_force = 2000") as raised:
        vf.slide(BALL, soft, normal_force=[1e-6, 2000.0], velocity=1.0, model="line")
    answer = raised.value.answer
    assert np.isfinite(answer.mu[0]) and np.isnan(answer.mu[1])
    assert answer.failures[0] is None and "2000" in str(answer.failures[1])


def test_wrong_input_that_a_solver_finds_is_a_value_error() -> None:
    scene = {
        "indenter": BALL,
        "material": vf.Prony(1e6, [(1e7, 1e-3)]),
        "load": {"normal_force": 2.0, "velocity": 0.1, "track": 1e-6},
    }
    with pytest.raises(ValueError, match="the track must be twice as long as"):
        vf.solve(scene)


def test_branches_have_names_and_exchanged_pairs_are_refused() -> None:
    moduli, times = [1e7, 3e6, 10.0], [1e-3, 1e-1, 20.0]
    pairs = list(zip(moduli, times, strict=True))
    named = [{"modulus": modulus, "relaxation_time": time} for modulus, time in pairs]
    by_name = vf.Prony(1e6, moduli=np.array(moduli), relaxation_times=times, viscosity=2.0)
    assert by_name == vf.Prony(1e6, pairs, viscosity=2.0) == vf.Prony(1e6, named, viscosity=2.0)
    exchanged = [(time, modulus) for modulus, time in pairs[:2]]
    with pytest.raises(ValueError, match=r"seem to be exchanged: 0.001 Pa and 1e\+07 s"):
        vf.Prony(1e6, exchanged)
    with pytest.raises(ValueError, match="give the transpose"):
        vf.Prony(1e6, np.array(pairs[:2]).T)
    # Names say what is meant.
    assert vf.Prony(1e6, moduli=times[:2], relaxation_times=moduli[:2]).branches == tuple(exchanged)
    for given in (
        {},
        {"moduli": moduli},
        {"branches": pairs, "moduli": moduli, "relaxation_times": times},
        {"moduli": moduli, "relaxation_times": times[:2]},
        {"branches": [{"modulus": 1e6, "time": 1.0}]},
    ):
        with pytest.raises(ValueError, match="relaxation_time"):
            vf.Prony(1e6, **given)  # type: ignore[arg-type]


def test_friction_from_outside_of_the_measured_frequencies_is_said() -> None:
    rubber = vf.Prony(1e6, [(1e7, 1e-3)], valid_frequencies=(1.0, 1e3))
    friction = vf.slide(BALL, rubber, normal_force=2.0, velocity=[1e-6, 0.1, 10.0])
    share = friction.dissipation
    assert np.allclose(share["outside_window"], share["below_window"] + share["above_window"])
    assert share["below_window"][0] > 0.99 and share["outside_window"][1] < 0.1 and share["above_window"][2] > 0.5
    (warning,) = friction.warnings
    assert "was not measured" in warning and warning.endswith("(at 2 of 3 points, with the numbers of the first)")


def test_strain_dependences_are_checked_when_they_are_made() -> None:
    for made in (lambda: vf.KrausStrain(-1.0, 0.3), lambda: vf.KrausStrain(0.1, 2.0)):
        with pytest.raises(ValueError, match="strain.kraus"):
            made()
    with pytest.raises(ValueError, match="strain must be a KrausStrain or StrainFile"):
        vf.slide(BALL, RUBBER, normal_force=1.0, velocity=0.1, strain=0.3)  # type: ignore[arg-type]
    softer = vf.slide(BALL, RUBBER, normal_force=1.0, velocity=0.1, relative_error=0.05, strain=vf.KrausStrain(0.01, 0.3))
    assert softer.strain is not None and softer.strain > 0
    assert softer.friction_coefficient != softer.linear_friction_coefficient


@pytest.mark.parametrize("family", ["indenter", "interface", "heat", "strain"])
def test_every_kind_is_listed_with_its_keys(family: Any) -> None:
    listed = vf.kinds(family)
    assert listed and all(kind.meaning for kind in listed.values())
    for kind in listed.values():
        made = next(one for name in vf._kinds.__all__ if (one := getattr(vf, name))._family == family and one._kind == kind.name)
        assert {key.name for key in kind.keys} == {field.name for field in dataclasses.fields(made)}
        # Required keys first, as in a call; those of a family without kinds have no name of a table.
        assert [key.is_required for key in kind.keys] == sorted((key.is_required for key in kind.keys), reverse=True)
        assert all(key.words for key in kind.keys if key.entry in ("word", "share"))
    assert vf.kinds("indenter")["sphere"].keys[0].unit == "m"
    assert vf.kinds("indenter")["spectrum"].keys[-4].name == "convention"
    assert list(vf.kinds("indenter")["spectrum"].keys[-4].words) == ["persson", "surface-topography"]
    assert vf.kinds("heat")[""].keys[0].unit == "W/m/K"
