"""Histories, and the material behind a measured one."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import viscofriction as vf

GEL = vf.StandardSolid(2e3, 3e3, 900.0)
TIME = np.linspace(0.0, 2.0, 201)
DEPTH = 1e-6 * (1.0 - np.abs(TIME - 1.0))


def curve(noise: float = 0.0) -> np.ndarray:
    depth = 1e-6 * np.interp(TIME, [0.0, 0.3, 1.0, 2.0], [-0.3, 0.0, 1.0, 0.5])
    force = vf.indent(vf.Sphere(5e-6), GEL, time=TIME, indentation_depth=depth).normal_force
    scatter = np.random.default_rng(1).standard_normal(TIME.size)
    return np.stack([TIME, depth, force + noise * force.max() * scatter])


def test_a_history_is_that_of_the_program(program: Callable[..., str], tmp_path: Path) -> None:
    got = vf.indent(vf.Sphere(5e-6), GEL, time=TIME, indentation_depth=DEPTH)
    with (tmp_path / "path.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["time_s", "indentation_depth_m"])
        rows.writerows(zip(TIME.tolist(), DEPTH.tolist(), strict=True))
    scene = tmp_path / "scene.toml"
    solid = "equilibrium_modulus = 2e3\nmaxwell_modulus = 3e3\nviscosity = 900.0"
    scene.write_text(
        f"[indenter.sphere]\nradius = 5e-6\n[material.standard-solid]\n{solid}\n[load]\nhistory_file = 'path.csv'\n"
    )
    expected = vf.solve(scene).history
    assert (got.normal_force == expected["normal_force"]).all()
    assert (got.contact_radius == expected["contact_radius"]).all()
    assert '"history"' in program("run", scene, "--format", "json")
    # Lost on the way back, and exact up to rounding.
    assert got.normal_force[-1] == 0.0 and got.normal_force_error < 1e-11 * got.normal_force.max()
    axes = got.plot()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("indentation depth d [µm]", "normal force F [nN]")


def test_a_history_on_a_thick_layer_is_that_on_the_half_space() -> None:
    # Pressed again, where elements follow it on a layer.
    for time, depth, error in (
        ([0.0, 1.0, 1.8], [0.0, 1e-6, 0.2e-6], 1e-6),
        ([0.0, 1.0, 1.5, 2.0], [0.0, 1e-6, 0.7e-6, 0.9e-6], 1e-3),
    ):
        exact = vf.indent(vf.Sphere(5e-6), GEL, time=time, indentation_depth=depth, work=True)
        layer = vf.indent(vf.Sphere(5e-6), GEL, time=time, indentation_depth=depth, thickness=5e-3, work=True)
        # At 5 mm a layer is stiffer by 5e-4.
        off = np.abs(layer.normal_force - exact.normal_force).max()
        assert off <= layer.normal_force_error + 6e-4 * exact.normal_force.max()
        assert layer.normal_force_error < error * exact.normal_force.max()
        assert exact.contact_radius is not None
        if layer.contact_radius is None:
            assert error == 1e-3 and layer.contact_area is not None
            area = np.pi * exact.contact_radius[1] ** 2
            assert layer.contact_area[1] == pytest.approx(area, abs=layer.contact_area_error + 1e-3 * area)
        else:
            assert layer.contact_radius[1] == pytest.approx(exact.contact_radius[1], rel=1e-3)
            assert layer.work is not None and layer.work[1] == pytest.approx(exact.work[1], rel=1e-3)
        # What is dissipated, and left in the surface.
        assert exact.work is not None and 0.0 < exact.work[2] < exact.work[1]


def test_a_thin_sample_is_fitted_with_its_thickness() -> None:
    ball, thickness = vf.Sphere(5e-5), 6e-6
    depth = 1e-6 * np.interp(TIME, [0.0, 0.3, 1.0, 2.0], [-0.3, 0.0, 1.0, 0.5])
    force = vf.indent(ball, GEL, time=TIME, indentation_depth=depth, thickness=thickness).normal_force
    measured = force + 0.003 * force.max() * np.random.default_rng(1).standard_normal(TIME.size)
    known, found = (
        vf.fit_indentation(TIME, depth, measured, body=ball, thickness=given, profile=False)
        for given in (thickness, "fit")
    )
    thick = vf.fit_indentation(TIME, depth, measured, body=ball, profile=False)
    modulus = thick.findings["G_inf"].value
    low, high = known.findings["G_inf"].interval
    assert low is not None and high is not None and low < 2e3 < high
    assert modulus is not None and modulus > 3 * high, "taken for a half space"
    low, high = found.findings["thickness"].interval
    assert low is not None and high is not None and low < thickness < high and "thickness" not in known.findings
    wrong = {
        "finite and greater than 0, but is 0": 0.0,
        "but is not a number": float("nan"),
        "but is 'thin'": "thin",
    }
    for reason, given in wrong.items():
        with pytest.raises(ValueError, match="thickness must be") as refused:
            vf.fit_indentation(TIME, depth, measured, body=ball, thickness=given)
        assert reason in str(refused.value) or reason.replace("'", '"') in str(refused.value)
    with pytest.raises(ValueError, match="body of revolution"):
        vf.fit_indentation(TIME, depth, measured, body=vf.Pyramid(1.0), thickness=thickness)


def test_a_depth_follows_from_a_force() -> None:
    time, depth = TIME[:101], DEPTH[:101]
    force = vf.indent(vf.Cone(0.5), GEL, time=time, indentation_depth=depth).normal_force
    back = vf.indent(vf.Cone(0.5), GEL, time=time, normal_force=force)
    # The force is not quite straight from point to point.
    assert np.abs(back.indentation_depth - depth).max() < 1e-3 * depth.max()
    assert back.normal_force_error == 0.0 < back.indentation_depth_error


def test_a_fit_finds_the_material_within_its_intervals() -> None:
    fit = vf.fit_indentation(*curve(noise=0.01), body=vf.Sphere(5e-6))
    for name, truth in {"G_inf": 2e3, "G_1": 3e3, "tau_1": 0.3, "contact_point": 0.0}.items():
        low, high = fit.findings[name].interval
        assert low is not None and high is not None and low < truth < high, (name, fit)
    assert isinstance(fit.material, vf.Prony)
    assert np.abs(fit.fitted_force - fit.force).max() < 0.05 * fit.force.max()
    assert fit.correlation.shape == (len(fit.findings),) * 2
    assert repr(fit).startswith("fit of a curve\n  G_inf: 2040 ± 73 Pa, 95 % within")
    # Young's modulus, 3 G of an incompressible material.
    assert "\n  E_inf: (6.12 ± 0.22)e3 Pa, 95 % within" in repr(fit)
    assert fit.plot().get_xlabel() == "time t [s]"
    plain = json.loads(json.dumps(fit.to_dict()))
    assert plain["findings"]["G_inf"]["value"] == fit.findings["G_inf"].value
    assert plain["fitted_force"] == fit.fitted_force.tolist() and plain["material"]["prony"]["poisson_ratio"] == 0.5
    assert plain.keys() == vars(fit).keys()


def test_an_elastic_curve_has_one_modulus_whatever_was_asked_for() -> None:
    time, depth = TIME[:101], DEPTH[:101] - 0.5e-6
    force = vf.indent(vf.Sphere(5e-6), vf.Elastic(1e3), time=time, indentation_depth=depth).normal_force
    force = force + 0.01 * force.max() * np.random.default_rng(1).standard_normal(time.size)
    for material, notes in ("elastic", 0), ("standard-solid", 1), ("power-law", 1):
        fit = vf.fit_indentation(time, depth, force, body=vf.Sphere(5e-6), material=material)
        low, high = fit.findings["G"].interval
        assert low is not None and high is not None and low < 1e3 < high, (material, fit)
        assert len(fit.notes) == notes and fit.material.branches == (), (material, fit.notes)
        assert all("does not determine how the material relaxes" in note for note in fit.notes)


def test_a_table_is_fitted_as_its_columns_are(tmp_path: Path) -> None:
    time, depth, force = curve(noise=0.01)
    table = tmp_path / "curve.csv"
    np.savetxt(table, np.stack([time, depth, force], axis=1), delimiter=",", header="t (s),d (m),F (N)", comments="")
    of_columns = vf.fit_indentation(time, depth, force, body=vf.Sphere(5e-6), profile=False)
    of_table = vf.fit_indentation(table, body=vf.Sphere(5e-6), profile=False)
    value = of_columns.findings["G_inf"].value
    assert value is not None and of_table.findings["G_inf"].value == pytest.approx(value, rel=1e-9)
    # What is guessed about a file is said, and what is wrong with it as the program says it.
    table.write_text(table.read_text().replace("d (m)", "displacement (m)"))
    [note] = vf.fit_indentation(table, body=vf.Sphere(5e-6), profile=False).notes
    assert note.startswith("'displacement (m)' is taken for the depth of the body")
    table.write_text("\n".join(table.read_text().splitlines()[:20]))
    with pytest.raises(ValueError, match=r"curve\.csv: 19 points are too few"):
        vf.fit_indentation(table, body=vf.Sphere(5e-6))


class Measured(dict[str, np.ndarray]):
    """A curve as afmformats knows it: columns, and what the microscope says beside them."""

    metadata = {"spring constant": 0.05, "rate approach": 100.0}

    @property
    def columns(self) -> list[str]:
        return list(self)


def test_curves_with_named_columns_are_those_of_arrays() -> None:
    time, depth, force = curve(noise=0.01)
    expected = vf.fit_indentation(time, depth, force, body=vf.Sphere(5e-6), profile=False).findings["G_inf"].value
    height = -depth - force / 0.05
    of_microscope = Measured({"force": force, "height (measured)": height, "index": np.arange(time.size)})
    for measured in of_microscope, {"time": time, "force": force, "tip position": -depth}:
        fit = vf.fit_indentation(measured, body=vf.Sphere(5e-6), profile=False)
        assert fit.findings["G_inf"].value == pytest.approx(expected, rel=1e-6)
    for named, message in (
        ({"time": time, "force": force}, "'tip position'"),
        ({"time": time, "force": force, "height (piezo)": height}, "spring_constant"),
        ({"force": force, "depth": depth}, "'time'"),
        ({"time": time}, "'force'"),
    ):
        with pytest.raises(ValueError, match=message):
            vf.fit_indentation(named, body=vf.Sphere(5e-6))


def test_a_pyramid_has_the_force_of_its_cone_and_does_not_slide() -> None:
    pyramid = vf.Pyramid(1 / np.tan(np.radians(35.0)))
    time, depth = [0.0, 1.0], [0.0, 1e-6]
    elastic = vf.indent(pyramid, vf.Elastic(1e3), time=time, indentation_depth=depth)
    # 0.7453 E* d² tan θ, with E* = 4 G.
    assert elastic.normal_force[-1] == pytest.approx(0.7453 * 4e3 * 1e-12 * np.tan(np.radians(35.0)), rel=1e-9)
    assert elastic.contact_radius is None and "way back" in elastic.warnings[-1]
    with pytest.raises(ValueError, match="indent and fit_indentation"):
        vf.slide(pyramid, GEL, normal_force=1.0, velocity=1.0)


def test_wrong_input_is_named() -> None:
    time, depth, force = curve(noise=0.01)
    ball = vf.Sphere(5e-6)
    for message, call in {
        "one of them": lambda: vf.indent(ball, GEL, time=[0.0, 1.0]),
        "as many values": lambda: vf.indent(ball, GEL, time=[0.0, 1.0], indentation_depth=[0.0]),
        "history": lambda: vf.indent(ball, GEL, time=[1.0, 0.0], indentation_depth=[0.0, 1e-6]),
        "material must be": lambda: vf.fit_indentation(time, depth, force, body=ball, material="wood"),
        "body of revolution": lambda: vf.fit_indentation(time, depth, force, body=vf.Cylinder(1.0)),
        "no branches to choose": lambda: vf.fit_indentation(time, depth, force, body=ball, branches=2),
        "as wide as deep|radius must": lambda: vf.fit_indentation(time, depth, force, body=vf.Sphere(1e308)),
        "too few": lambda: vf.fit_indentation(time[:9], depth[:9], force[:9], body=ball),
        "no contact|sign": lambda: vf.fit_indentation(time, depth, -force, body=ball),
        "poisson_ratio": lambda: vf.fit_indentation(time, depth, force, body=ball, poisson_ratio=2.0),
        "depth and force": lambda: vf.fit_indentation(time, body=ball),
        "radius": lambda: vf.fit_indentation(time, depth, force, body=vf.Sphere(-1.0)),
    }.items():
        with pytest.raises(ValueError, match=message):
            call()
