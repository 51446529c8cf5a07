"""The moduli and shear strengths behind measured friction."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import viscofriction as vf

SPEEDS = np.logspace(-3, 0, 8)


def scene(modulus: float, viscosity: float) -> dict[str, object]:
    return {
        "indenter": vf.Paraboloid(100.0),
        "material": vf.KelvinVoigt(modulus, viscosity),
        "load": {"normal_force": 1.0},
        "solve": {"model": "line"},
    }


def measured() -> np.ndarray:
    known = scene(1e6, 1e4)
    found = vf.slide(known["indenter"], known["material"], normal_force=1.0, velocity=SPEEDS, model="line")
    return found.mu


def test_moduli_come_back_and_the_result_is_plain() -> None:
    mu = measured()
    fit = vf.fit_friction(SPEEDS, mu, scene=scene(3e6, 2e3), standard_error=0.02 * mu)
    for (name, one), truth in zip(fit.findings.items(), (1e6, 1e4), strict=True):
        assert one.value is not None and one.error is not None, name
        assert abs(one.value - truth) < 0.05 * one.error, name
    assert "kelvin-voigt.viscosity" in repr(fit)
    plain = fit.to_dict()
    assert json.loads(json.dumps(plain)) == plain
    again = vf.solve({**scene(1.0, 1.0), "material": fit.material, "load": {"normal_force": 1.0, "velocity": 0.01}})
    assert again.mu == pytest.approx(np.interp(0.01, SPEEDS, mu), rel=0.2)


def test_a_shear_strength_comes_back() -> None:
    speeds = np.logspace(-3, -1, 3)
    body, rubber, load = vf.Cylinder(5e-3), vf.KelvinVoigt(1e6, 1e3), {"normal_force": 100.0}
    known = {"indenter": body, "material": rubber, "interface": vf.ConstantShear(3e4), "solve": {"elements": 512}}
    dry = np.array([vf.solve({**known, "load": {**load, "velocity": v}}).mu for v in speeds.tolist()])
    start = {"indenter": body, "material": rubber, "interface": vf.ConstantShear(1e5), "load": load}
    fit = vf.fit_friction(speeds, dry, scene=start, standard_error=0.02 * dry)
    assert fit.free == ("interface",)
    assert fit.interface is not None
    assert fit.interface["constant"]["shear_strength"] == pytest.approx(3e4, rel=5e-3)
    assert list(fit.findings) == ["interface.constant.shear_strength"]
    axes = fit.plot()
    assert axes.get_xscale() == "log" and axes.get_xlabel() == "speed v a_T [m/s]"


def test_a_table_is_what_the_program_fits(program: Callable[..., str], tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(
        "[indenter.paraboloid]\ncurvature = 100.0\n[material.kelvin-voigt]\nshear_modulus = 3e6\nviscosity = 2e3\n"
        "[load]\nnormal_force = 1.0\n[solve]\nmodel = 'line'\n"
    )
    table = tmp_path / "friction.csv"
    mu = measured() * (1 + 0.02 * np.random.default_rng(3).standard_normal(SPEEDS.size))
    rows = "".join(f"{v!r},{m!r}\n" for v, m in zip(SPEEDS.tolist(), mu.tolist(), strict=True))
    table.write_text("v (m/s),mu\n" + rows)
    fit = vf.fit_friction(table, scene=file)
    known = json.loads(program("fit-friction", str(table), str(file), "--format", "json"))
    estimates = [one["estimate"]["value"] for one in known["fit"]["findings"]]
    assert [one.value for one in fit.findings.values()] == estimates
    assert fit == vf.fit_friction(SPEEDS, mu, scene=file)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"mu": None}, "mu is needed"),
        ({"mu": -np.ones(8)}, "mu must be greater than 0"),
        ({"mu": np.ones(7)}, "as many values"),
        ({"free": "times"}, "free must be"),
        ({"free": "interface"}, "to find the shear strength"),
        ({"noise": "none"}, "noise must be"),
        ({"prior": 0.0}, "prior must be"),
        ({"prior": "known"}, "prior must be covariance, none"),
        ({"mu": 30 * np.ones(8)}, "at most 10"),
        ({"run_in": 10.0}, "only a file"),
    ],
)
def test_wrong_input_is_named(given: dict[str, object], expected: str) -> None:
    arguments = {"mu": measured(), "scene": scene(1e6, 1e4)} | given
    with pytest.raises(ValueError, match=expected):
        vf.fit_friction(SPEEDS, **arguments)




def test_runs_over_time_are_read_as_their_means(tmp_path: Path) -> None:
    table = tmp_path / "friction.csv"
    mu = measured()
    rows = [
        f"{1000 * run + time};{speed / 0.03 * 60 / (2 * np.pi)!r};{friction * (1.01 if time % 2 else 0.99)!r}\n"
        for run, (speed, friction) in enumerate(zip(SPEEDS.tolist(), mu.tolist(), strict=True))
        for time in range(20)
    ]
    table.write_text("t (s);rpm;mu\n" + "".join(rows))
    with pytest.raises(ValueError, match="run_in in Python"):
        vf.fit_friction(table, scene=scene(3e6, 2e3), track_radius=0.03)
    fit = vf.fit_friction(table, scene=scene(3e6, 2e3), track_radius=0.03, run_in=10.0)
    np.testing.assert_allclose(fit.mu, mu, rtol=1e-9)
    np.testing.assert_allclose(fit.velocity, SPEEDS, rtol=1e-9)
    assert fit.prior == "none" and "8 runs at constant speed" in fit.notes[0]


def test_a_table_of_friction_is_read_in_si(tmp_path: Path) -> None:
    table = tmp_path / "friction.csv"
    table.write_text("v (mm/s),T (C),mu,standard error\n10,0,0.2,0.01\n20,5,0.3,0.02\n")
    read = vf.read_friction(table)
    assert read.velocity.tolist() == [0.01, 0.02] and read.mu.tolist() == [0.2, 0.3]
    assert read.standard_error is not None and read.standard_error.tolist() == [0.01, 0.02]
    assert read.temperature is not None and read.temperature.tolist() == [0.0, 5.0] and read.normal_force is None
    assert read == vf.read_friction(str(table)) and read.notes == ()
    table.write_text("v (mm/s),mu\n10,20\n20,30\n")
    with pytest.raises(ValueError, match="friction.csv, line 2, column 2 .*expected a friction coefficient of at most 10"):
        vf.read_friction(table)
