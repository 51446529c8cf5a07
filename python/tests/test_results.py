"""What results offer: arrays, texts, pictures."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT

from conftest import ROOT

import viscofriction as vf
from viscofriction._results import QUANTITIES

SPEEDS = np.logspace(-3, 1, 5)
SOLID = vf.StandardSolid(1e6, 1e7, 1e4)


def test_a_single_scene_reads_well_in_text_and_notebook() -> None:
    answer = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=0.01)
    assert repr(answer).splitlines()[:2] == ["analytic, half-space", "  friction_coefficient: 0.0891298 ± 0.0000073"]
    assert "<td>friction_coefficient</td><td>0.0891298 ± 0.0000073</td>" in answer._repr_html_()


def test_friction_is_hysteresis_and_shear() -> None:
    speeds = np.array([1e-3, 1e-2])
    interface = vf.BellShear(1e5, 1e-3, width=2.0)
    found = vf.slide(vf.Sphere(5e-3), SOLID, normal_force=1.0, velocity=speeds, interface=interface, relative_error=0.05)
    assert found.friction_from_shear is not None and found.friction_from_hysteresis is not None
    np.testing.assert_allclose(found.mu, found.friction_from_hysteresis + found.friction_from_shear, rtol=1e-14)
    strength = 1e5 * np.exp(-((np.log10(speeds / 1e-3) / 2.0) ** 2))
    np.testing.assert_allclose(found.friction_from_shear, strength * found.contact_area, rtol=1e-12)
    scene = {"indenter": vf.Sphere(5e-3), "material": SOLID, "load": {"normal_force": 1.0, "velocity": 1e-2}}
    alone = vf.solve(scene | {"interface": interface, "solve": {"relative_error": 0.05}})
    assert alone.mu == found.mu[1]
    assert vf.solve(scene | {"solve": {"relative_error": 0.05}}).friction_from_shear is None


def test_a_contact_is_heated_by_its_shear() -> None:
    # At the Péclet number 1 a uniform disc is 0.55542 q a/k warm in the mean.
    radius = (3 * 1.0 * 5e-3 / 16e6) ** (1 / 3)
    velocity = 2 * 1.2e-7 / radius
    options: dict[str, Any] = {"normal_force": 1.0, "velocity": velocity, "relative_error": 0.05}
    shear = vf.ConstantShear(1e5)
    answer = vf.slide(vf.Sphere(5e-3), vf.Elastic(1e6), interface=shear, heat=vf.Heat(0.25, diffusivity=1.2e-7), **options)
    assert answer.mean_temperature_rise == pytest.approx(0.55542 * 1e5 * velocity * radius / 0.25, rel=0.05)
    assert answer["largest_temperature_rise"] > answer["mean_temperature_rise"]
    assert answer.temperature.shape == answer.pressure.shape
    assert np.isnan(answer["effective_temperature"]), "nothing depends on it"
    conducting = vf.Heat(0.25, density=1e3, heat_capacity=2e3, counterface={"share": 1.0})
    cold = vf.slide(vf.Sphere(5e-3), vf.Elastic(1e6), interface=shear, heat=conducting, **options)
    assert cold.mean_temperature_rise == 0.0


def test_every_printed_quantity_is_an_attribute() -> None:
    answer = vf.slide(vf.Cone(0.1), SOLID, normal_force=2.0, velocity=0.1, relative_error=0.1)
    printed = [line.split(":")[0].strip() for line in repr(answer).splitlines()[1:]]
    assert {"friction_coefficient", "contact_area", "tangential_force"} <= set(printed)
    for name in printed:
        value, error = getattr(answer, name), getattr(answer, f"{name}_error")
        assert (value, error) == (answer[name], answer[f"{name}_error"]) and error >= 0.0, name
        assert name in dir(vf.Answer) and getattr(vf.Answer, name).__doc__
    assert (answer.mu, answer.mu_error) == (answer.friction_coefficient, answer.friction_coefficient_error)
    assert (answer.area, answer.area_error) == (answer.contact_area, answer.contact_area_error)
    assert answer.mean_pressure is None and math.isnan(answer["mean_pressure"])
    with pytest.raises(KeyError, match="there is no column 'friction'"):
        answer["friction"]
    with pytest.raises(AttributeError):
        _ = answer.friction


WAVES: dict[str, Any] = {"period": (1e-3, 1e-3), "hurst_exponent": 0.8, "rms_slope": 0.1}
WAVES |= {"longest_wavelength": 1e-3, "shortest_wavelength": 2.5e-4, "seed": 1}
ROUGH = vf.SelfAffine(**WAVES)
#: Every kind of answer, with quantities that it has beside force or pressure.
KINDS: dict[str, tuple[Callable[[], vf.Answer], set[str]]] = {
    "pressed": (lambda: vf.press(vf.Sphere(5e-3), vf.Elastic(1e6), normal_force=1.0), {"contact_area", "indentation_depth"}),
    "line": (lambda: vf.slide(vf.Sphere(5e-3), SOLID, normal_force=1.0, velocity=0.1, model="line"), {"friction_coefficient"}),
    "cycle": (
        lambda: vf.move(vf.Cone(0.1), SOLID, normal_force=1.0, stroke=1e-2, frequency=1.0, model="line", relative_error=0.05),
        {"friction_coefficient", "peak_friction", "dissipated_energy"},
    ),
    "rough": (
        lambda: vf.slide(ROUGH, SOLID, mean_pressure=1e5, velocity=1e-3, relative_error=0.1),
        {"friction_coefficient", "area_fraction", "mean_pressure", "friction_from_dissipation", "contact_area"},
    ),
    "realisations": (
        lambda: vf.slide(vf.SelfAffine(**WAVES, realisations=2), SOLID, mean_pressure=1e5, velocity=1e-3, relative_error=0.1),
        {"friction_coefficient", "area_fraction", "mean_pressure"},
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_answer_has_its_quantities_as_attributes(kind: str) -> None:
    solve, expected = KINDS[kind]
    answer = solve()
    printed = {line.split(":")[0].strip() for line in repr(answer).splitlines()[1:] if not line.strip().startswith("warning")}
    known = {name for name in QUANTITIES if getattr(answer, name) is not None}
    assert expected <= known <= printed, printed
    for name in QUANTITIES:
        value, error = getattr(answer, name), getattr(answer, f"{name}_error")
        assert (value is None) == (error is None) == math.isnan(answer[name]), name
        assert value is None or (value, error) == (answer[name], answer[f"{name}_error"])
    plain = answer.to_dict()
    assert all(plain[name] == getattr(answer, name) for name in known)


def test_a_sweep_has_columns_of_the_printed_names() -> None:
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 0.1}}
    table = vf.sweep(scene, {"load.velocity": [0.1, 0.2]})
    answer = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=[0.1, 0.2])
    for name in QUANTITIES:
        assert np.array_equal(table[name], answer[name], equal_nan=True), name
        assert np.array_equal(table[f"{name}_error"], answer[f"{name}_error"], equal_nan=True), name


def test_units_of_a_cylinder_are_per_length() -> None:
    answer = vf.press(vf.Cylinder(0.05), vf.Elastic(1e6), normal_force=[1e3, 2e3])
    assert "<th>normal_force [N/m]</th>" in answer._repr_html_() and "<th>contact_area [m²/m]</th>" in answer._repr_html_()


def test_friction_is_drawn_over_speed_with_its_bars() -> None:
    answer = vf.slide(vf.Cone(0.1), SOLID, normal_force=2.0, velocity=SPEEDS, model="line")
    axes = answer.plot()
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_xscale()) == ("speed v [m/s]", "friction coefficient μ", "log")
    (line, *_), *_ = axes.containers
    assert (line.get_xdata() == SPEEDS).all()
    assert (line.get_ydata() == answer.mu).all()


def test_families_and_grids_are_drawn() -> None:
    forces = np.array([[1.0], [2.0]])
    axes = vf.slide(vf.Cone(0.1), SOLID, normal_force=forces, velocity=SPEEDS, model="line").plot()
    assert len(axes.containers) == 2
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["normal force F [N]: 1", "normal force F [N]: 2"]
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 1.0}}
    table = vf.sweep(scene, {"load.velocity": np.logspace(-3, 1, 8), "load.normal_force": np.arange(1.0, 8.0)})
    axes = table.plot()
    assert (axes.get_xlabel(), axes.get_xscale(), axes.get_yscale()) == ("speed v [m/s]", "log", "linear")
    assert (axes.collections[0].get_array() == table["friction_coefficient"].reshape(8, 7).T).all()
    vary = {"solve.model": ["line", "half-space"], "load.normal_force": [1.0, 2.0], "load.velocity": SPEEDS}
    axes = vf.sweep(scene, vary).plot()
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts[:2] == ["model: line, normal force F [N]: 1", "model: line, normal force F [N]: 2"] and len(texts) == 4
    with pytest.raises(ValueError, match="no key that varies has numbers"):
        vf.sweep(scene, {"solve.model": ["line", "half-space"]}).plot()


def test_the_picture_of_a_sweep_has_what_the_program_draws(tmp_path: Path) -> None:
    fit = vf.fit_material(ROOT / "examples/data/tread-rubber.csv", reference_temperature=20.0)
    (tmp_path / "rubber.toml").write_text(fit.material.to_toml(), encoding="utf-8")
    scene = {
        "indenter": vf.Sphere(5e-3),
        "material": vf.MaterialFile(tmp_path / "rubber.toml", temperature=20.0),
        "interface": vf.ConstantShear(1e5),
        "load": {"normal_force": 2.0, "velocity": 1.0},
        "solve": {"relative_error": 0.05},
    }
    table = vf.sweep(scene, {"material.file.temperature": [0.0, 20.0], "load.velocity": [1e-3, 1e-2, 1e-1]}, sensitivity=True)
    measured = vf.read_friction(ROOT / "examples/data/dry-friction.csv")
    axes = table.plot(measured=measured, name="ball", style="-.")
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert set(texts[:5]) == {"temperature T [°C]: 0", "temperature T [°C]: 20", "ball", "hysteresis", "shear"}
    assert "measured, 0 °C" in texts and len(texts) == 5 + np.unique(measured.temperature).size
    assert axes.get_legend().get_bbox_to_anchor().x0 >= axes.bbox.x1, "many entries stand beside the picture"
    upper = axes.collections[1].get_paths()[0].vertices[:, 1].max()
    band = table["friction_coefficient"] + table["friction_coefficient_material_error"]
    assert any(np.isclose(upper, band[points].max(), rtol=1e-12) for points in (slice(3), slice(3, None)))
    file = tmp_path / "report.html"
    table.to_html(file, picture=axes, texts={"the scene": "<scene> & more"})
    page = file.read_text(encoding="utf-8")
    assert "&lt;scene&gt; &amp; more" in page and "<svg" in page and page.count("<tr>") == 1 + len(table)
    assert "http://" not in page.replace("http://www.w3.org", "").replace("http://purl.org", "").replace("http://creativecommons.org", "")
    with pytest.raises(FileExistsError):
        table.to_html(file)


def test_a_master_curve_a_map_and_a_temperature_are_drawn() -> None:
    fit = vf.fit_material(ROOT / "examples/data/tread-rubber.csv", reference_temperature=20.0)
    assert fit.decisions[1:3] == ("relative error of G′: 1 % rms, 2.4 % at most", "relative error of G″: 1.6 % rms, 4.3 % at most")
    assert fit.decisions[3:] == (
        "material at 20 °C; its shift law holds from -40.24 °C to 39.94 °C",
        "moduli do not change with temperature, b_T = 1",
    )
    axes = fit.plot()
    assert (axes.get_xlabel(), axes.get_xscale(), axes.get_yscale()) == ("angular frequency a_T ω [rad/s]", "log", "log")
    assert fit.measured is not None and (axes.lines[0].get_ydata() == fit.measured.storage).all()
    storage, loss = axes.figure.axes[1].lines[:2]
    assert (storage.get_ydata() == 100 * fit.residuals[0]).all() and (loss.get_ydata() == 100 * fit.residuals[1]).all()
    with pytest.raises(ValueError, match="the fit of a table"):
        vf.fit_relaxation(SPEEDS, fit.material.relaxation_modulus(SPEEDS)).plot()
    narrow = replace(fit, measured=vf.Moduli(np.array([1.0, 2.0, 3.0]), np.array([1e6, 2e6, 3e6]), np.array([1e6, 1e6, 1e6])))
    assert narrow.plot().get_xscale() == "linear"
    heights = np.array([[0.0, 1e-6, 0.0], [1e-6, 5e-6, 1e-6], [0.0, 1e-6, 0.0]])
    axes = vf.HeightMap(heights, 1e-5).plot()
    drawn = np.asarray(axes.collections[0].get_array()).reshape(3, 3)
    assert np.allclose(drawn, heights - heights.mean(), rtol=0, atol=1e-18)
    heat = vf.Heat(0.25, density=1150.0, heat_capacity=1800.0)
    answer = vf.slide(vf.Sphere(5e-3), fit.material, normal_force=0.2, velocity=0.01, heat=heat, interface=vf.ConstantShear(1e5), relative_error=0.1)
    axes = answer.plot(field="temperature")
    assert (np.ravel(axes.collections[0].get_array()) == np.ravel(answer.temperature)).all()


def test_the_gap_is_around_the_contact() -> None:
    answer = vf.slide(vf.Sphere(5e-3), SOLID, normal_force=0.2, velocity=0.01, relative_error=0.01)
    assert answer.gap.shape == (answer.gap_y.size, answer.gap_x.size)
    rows, columns = (np.abs(here[:, np.newaxis] - there).argmin(axis=0) for here, there in ((answer.gap_y, answer.y), (answer.gap_x, answer.x)))
    assert np.allclose(answer.gap_x[columns], answer.x) and np.allclose(answer.gap_y[rows], answer.y)
    in_contact = answer.gap[np.ix_(rows, columns)][answer.pressure > 0.0]
    assert np.abs(in_contact).max() < 1e-4 * answer.gap.max(), "0 in the contact"
    drawn = answer.plot(field="gap").collections[0].get_array()
    assert drawn.compressed().size < answer.gap.size and drawn.max() == answer.gap.max()
    line = vf.slide(vf.Cylinder(5e-3), SOLID, normal_force=100.0, velocity=0.01, relative_error=0.1)
    assert line.gap.shape == (1, line.gap_x.size) and (line.plot(field="gap").lines[0].get_ydata() == line.gap[0]).all()
    with pytest.raises(AttributeError, match="analytic has no gap"):
        vf.slide(vf.Sphere(5e-3), SOLID, normal_force=0.2, velocity=0.01, relative_error=0.1).gap  # noqa: B018


def test_results_know_their_warnings_and_what_is_not_in_them() -> None:
    slides = ["adhesion", "strain dependence", "heating", "interfacial shear"]
    steep, load = vf.Cone(0.8), {"normal_force": 1.0, "velocity": 0.01}
    answer = vf.slide(steep, vf.Viscous(1e4), **load)
    (sentence,) = answer.warnings
    assert sentence.startswith("the mean slope") and answer.not_modelled == slides
    assert vf.slide(vf.Cone(0.1), vf.Viscous(1e4), **load).warnings == []
    several = vf.slide(steep, vf.Viscous(1e4), normal_force=1.0, velocity=SPEEDS)
    assert several.warnings == [f"{sentence} (at 5 of 5 points)"] and several.not_modelled == slides
    scene = {"indenter": steep, "material": vf.Viscous(1e4), "load": load}
    table = vf.sweep(scene, {"indenter.cone.slope": [0.1, 0.8, 0.9]})
    (shared,) = table.warnings
    assert shared == f"{sentence} (at 2 of 3 points, with the numbers of the first)"
    assert table["warnings"].tolist()[:2] == ["", sentence]
    for result in (answer, several, table):
        assert "warning: the mean slope" in repr(result) and "<p>the mean slope" in result._repr_html_()


def test_numbers_of_tables_are_numbers() -> None:
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 1.0}}
    table = vf.sweep(scene, {"load.velocity": SPEEDS, "solve.model": ["line", "half-space"]})
    columns = table.to_dict()
    assert {type(value) for value in columns["friction_coefficient"] + columns["load.velocity"]} == {float}
    assert {type(value) for value in columns["point"] + columns["unknowns"]} == {int}
    assert columns["solve.model"] == table["solve.model"].tolist() == ["line", "half-space"] * 5
    assert "mean_pressure" not in columns
    several = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=SPEEDS).to_dict()
    assert several["velocity"] == SPEEDS.tolist()
    assert {type(value) for value in several["friction_coefficient"]} == {float}
    assert {len(column) for column in several.values()} == {SPEEDS.size}, "columns of a DataFrame"


def test_many_answers_are_a_table_in_a_notebook() -> None:
    answers = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=np.logspace(-3, 1, 30))
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 1.0}}
    table = vf.sweep(scene, {"load.velocity": np.logspace(-3, 1, 30)})
    for result in (answers, table):
        text = result._repr_html_()
        assert text.count("<tr>") == 22 and "…" in text, "the names, ten rows, dots and ten rows"
        assert "<td>0.001</td>" in text and "friction_coefficient</th>" in text and " ± " in text


def test_pressure_is_drawn_where_it_is() -> None:
    answer = vf.slide(vf.Sphere(5e-3), SOLID, normal_force=2.0, velocity=0.1, relative_error=1e-2)
    assert answer.pressure.shape == (answer.y.size, answer.x.size)
    assert answer.x.size != answer.y.size
    element = (answer.x[1] - answer.x[0]) * (answer.y[1] - answer.y[0])
    assert math.isclose(answer.pressure.sum() * element, 2.0, rel_tol=1e-6)
    axes = answer.plot()
    assert axes.get_xlabel() == "x [mm]"
    assert (axes.collections[0].get_array().filled(0.0) == answer.pressure).all()


def test_fields_belong_to_single_scenes() -> None:
    answer = vf.slide(vf.Cone(0.1), SOLID, normal_force=2.0, velocity=SPEEDS, model="line")
    with pytest.raises(AttributeError, match="single scene"):
        _ = answer.pressure


def test_materials_have_their_closed_forms() -> None:
    omega = np.array([[0.1, 1.0], [10.0, 100.0]])
    maxwell = vf.Maxwell(2.0, 3.0)
    i_omega_tau = 1j * omega * 1.5
    modulus = 2.0 * i_omega_tau / (1 + i_omega_tau)
    np.testing.assert_allclose(maxwell.storage_modulus(omega), modulus.real, rtol=1e-14)
    np.testing.assert_allclose(maxwell.loss_modulus(omega), modulus.imag, rtol=1e-14)
    np.testing.assert_allclose(maxwell.relaxation_modulus(omega), 2.0 * np.exp(-omega / 1.5), rtol=1e-14)
    np.testing.assert_allclose(maxwell.creep_compliance(omega), 0.5 + omega / 3.0, rtol=1e-14)


def test_fractional_elements_are_power_laws_in_their_range() -> None:
    omega = np.logspace(-3, 3, 13)
    pot = vf.Springpot(2e6, 0.3, time_range=(1e-3, 1e3), equilibrium_modulus=1e5)
    modulus = 1e5 + 2e6 * (1j * omega) ** 0.3
    np.testing.assert_allclose(pot.storage_modulus(omega), modulus.real, rtol=3e-7)
    np.testing.assert_allclose(pot.loss_modulus(omega), modulus.imag, rtol=3e-7)
    maxwell = vf.FractionalMaxwell(3e6, 0.1, 0.6, time_range=(1e-3, 1e3))
    z = (1j * 0.1 * omega) ** 0.6
    np.testing.assert_allclose(maxwell.loss_modulus(omega), (3e6 * z / (1 + z)).imag, rtol=3e-7)
    bare = vf.Springpot(2e6, 0.9, time_range=(1e-3, 1e3))
    time = np.logspace(-3, 3, 13)
    np.testing.assert_allclose(bare.relaxation_modulus(time), 2e6 * time**-0.9 / math.gamma(0.1), rtol=2e-6)
    np.testing.assert_allclose(bare.creep_compliance(time), time**0.9 / (2e6 * math.gamma(1.9)), rtol=2e-6)
    with pytest.raises(ValueError, match="angular_frequency"):
        pot.loss_modulus(2e3)
    with pytest.raises(ValueError, match="time_range"):
        vf.Springpot(2e6, 0.3, time_range=(1e3, 1e-3)).loss_modulus(1.0)
    ball, load = vf.Sphere(5e-3), {"normal_force": 2.0, "relative_error": 1e-2}
    friction = vf.slide(ball, pot, velocity=[0.01, 0.1], **load)
    assert (friction.mu > 0.0).all() and (friction.mu_error <= 1e-2 * friction.mu).all()
    with pytest.raises(vf.NotReached, match="time_range"):
        vf.slide(ball, pot, velocity=100.0, **load)


def test_a_fit_finds_the_material_in_any_order() -> None:
    rubber = vf.Prony(1e6, [(1e7, 1e-3), (3e6, 1e-1)])
    frequency = np.logspace(4, -2, 40) / (2 * np.pi)
    omega = 2 * np.pi * frequency
    fit = vf.fit_material(frequency, rubber.storage_modulus(omega), rubber.loss_modulus(omega))
    np.testing.assert_allclose(np.array(fit.material.branches), rubber.branches, rtol=1e-10)
    assert fit.max_relative_error < 1e-12
    time = np.logspace(-4, 1, 40)
    relaxed = vf.fit_relaxation(time, rubber.relaxation_modulus(time), branches=2)
    np.testing.assert_allclose(relaxed.material.equilibrium_modulus, 1e6, rtol=1e-6)


def test_the_scaling_factor_of_the_cone_is_known() -> None:
    value, error = vf.scaling_factor(1.0)
    assert abs(value - 0.5674) < 1e-3 and 0.0 < error < 1e-3


CURVE = (np.linspace(0.0, 1.0, 40), np.linspace(-1e-6, 1e-6, 40))


def curve_fit() -> vf.IndentationFit:
    time, depth = CURVE
    force = vf.indent(vf.Cone(0.5), vf.Elastic(1e3), time=time, indentation_depth=depth).normal_force
    scatter = 1e-12 * np.random.default_rng(1).standard_normal(time.size)
    return vf.fit_indentation(time, depth, force + scatter, body=vf.Cone(0.5), profile=False)


def test_what_is_equal_compares_equal_and_travels_as_it_is() -> None:
    """Bodies, materials and results by their values, with arrays and NaN in them, and after a journey to another process."""
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 1.0}}

    def made(scale: float) -> list[object]:
        heights = scale * np.add.outer(np.arange(4.0), np.arange(3.0) ** 2)
        speeds = scale * np.array([0.1, 1.0])
        return [
            vf.Sphere(scale),
            vf.Superposition([(scale, 2.0)]),
            vf.SelfAffine((1.0, scale), 0.5, 1.0, 1.0, 0.5, 0),
            vf.HeightMap(heights, 1.0),
            vf.HeightMap(heights, 1.0).roughness,
            vf.Prony(1e6, [(scale, 1.0)]),
            vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=speeds),
            vf.press(vf.Cone(0.1), vf.Elastic(1e4), normal_force=scale),
            vf.sweep(scene, {"load.velocity": speeds}),
            vf.indent(vf.Cone(0.5), vf.Elastic(1e3), time=CURVE[0], indentation_depth=scale * CURVE[1]),
        ]

    for one, same, other in zip(made(1.0), made(1.0), made(2.0), strict=True):
        for equal in (same, pickle.loads(pickle.dumps(one)), copy.deepcopy(one), copy.copy(one)):
            assert (one == equal) is True and (one != equal) is False, one
        assert (one == other) is False and (one == "else") is False, one
    assert pickle.loads(pickle.dumps(fit := curve_fit())) == fit == curve_fit()


def test_parameters_make_bodies_and_materials_equal_however_they_are_given() -> None:
    branches = [(1e7, 1e-3), (3e6, 0.1)]
    assert len({vf.Prony(1e6, given) for given in (branches, tuple(branches), np.array(branches))}) == 1
    assert vf.MaterialFile(Path("a.toml")) == vf.MaterialFile("a.toml")
    assert vf.Sphere(1.0) != vf.FlatPunch(1.0) and vf.Elastic(1.0) != vf.Elastic(1.0, poisson_ratio=0.3)
    assert hash(vf.HeightMap(np.eye(3), 1.0)) == hash(vf.HeightMap(np.eye(3), (1.0, 1.0)))


def test_what_was_not_reached_travels() -> None:
    with pytest.raises(vf.NotReached) as raised:
        vf.slide(vf.Sphere(5e-3), vf.Prony(100.0, [(1e3, 1.0)]), normal_force=2000.0, velocity=1.0, model="line")
    there = pickle.loads(pickle.dumps(raised.value))
    assert str(there) == str(raised.value) and there.answer == raised.value.answer


def test_what_was_reached_is_held_with_its_bars() -> None:
    far = {"normal_force": 1.0, "velocity": 0.01, "sliding_distance": 2e-3, "method": "bem-transient"}
    with pytest.raises(vf.NotReached, match="was not reached to the relative error 1e-6") as raised:
        vf.slide(vf.Cone(0.1), vf.Viscous(1e4), **far, relative_error=1e-6)
    answer = raised.value.answer
    assert 1e-6 * answer.mu < answer.mu_error < 0.1 * answer.mu
    assert answer.pressure.size > 0 and answer.to_dict()["not_reached"] == str(raised.value)
    assert "not reached: the friction coefficient" in repr(answer)
    assert pickle.loads(pickle.dumps(answer)) == answer


def test_a_law_of_ones_own_has_its_error_in_the_bars(capsys: pytest.CaptureFixture[str]) -> None:
    page = (ROOT / "docs" / "own-material.md").read_text()
    programs = [block.split("```")[0] for block in page.split("```python\n")[1:]]
    names: dict[str, Any] = {}
    for program in programs:
        exec(program, names)
    by_function, by_table = (line.split("μ = ")[1].split(" ± ") for line in capsys.readouterr().out.splitlines())
    (mu, error), (other, other_error) = (map(float, pair) for pair in (by_function, by_table))
    assert 0 < error < 1e-3 * mu and abs(mu - other) <= error + other_error
    rubber = names["rubber"]
    bare = vf.Prony(rubber.equilibrium_modulus, [{"modulus": g, "relaxation_time": t} for g, t in rubber.branches])
    narrow = vf.slide(vf.Sphere(5e-3), bare, normal_force=2.0, velocity=0.1)
    assert narrow.mu_error + rubber.approximation[0] * mu < error


def test_a_law_that_raises_or_rises_is_refused() -> None:
    def broken(time: float) -> float:
        raise KeyError("my law")

    with pytest.raises(KeyError, match="my law"):
        vf.Prony.from_relaxation(broken, (1e-3, 1e3))
    with pytest.raises(ValueError, match="a relative error of"):
        vf.Prony.from_relaxation(lambda time: 1.0 + time / (1.0 + time), (1e-3, 1e3))


def test_derivatives_are_arrays() -> None:
    forces = [1.0, 2.0]
    answer = vf.slide(vf.Cone(0.1), SOLID, normal_force=forces, velocity=0.1, model="line", sensitivity=True)
    known = answer.sensitivity
    moduli = ["equilibrium_modulus", "maxwell_modulus", "viscosity"]
    sums = sum(known[f"material.standard-solid.{name}"]["friction_coefficient"] for name in moduli)
    # Twice the stresses and twice the force are the same scene.
    assert sums + known["load.normal_force"]["friction_coefficient"] == pytest.approx(np.zeros(2), abs=1e-6)
    assert (known["load.velocity"]["friction_coefficient_error"] < 1e-6).all()
    with pytest.raises(AttributeError, match="sensitivity=True"):
        vf.slide(vf.Cone(0.1), SOLID, normal_force=1.0, velocity=0.1, model="line").sensitivity  # noqa: B018
    single = vf.solve({"indenter": vf.Cone(0.1), "material": SOLID, "load": {"normal_force": 1.0, "velocity": 0.1}}, sensitivity=True)
    assert math.isfinite(single.sensitivity["indenter.cone.slope"]["friction_coefficient"])


def test_derivatives_by_frequencies_add_up_to_the_unit_of_stress() -> None:
    answer = vf.slide(vf.Sphere(5e-3), SOLID, normal_force=1.0, velocity=0.1, sensitivity=True, spectral_sensitivity=True)
    bands = answer.spectral_sensitivity
    assert bands["from_rad_per_s"][0] == 0.0
    assert np.array_equal(bands["from_rad_per_s"][1:], bands["to_rad_per_s"][:-1])
    assert bands["outside_valid_frequencies"] is None
    by_both = sum(bands[f"friction_coefficient_by_{modulus}_modulus"].sum() for modulus in ("storage", "loss"))
    # Under a force the friction is that of the force over the unit of stress.
    by_force = answer.sensitivity["load.normal_force"]["friction_coefficient"]
    assert abs(by_both + by_force) < 0.02 * abs(by_force)
    with pytest.raises(AttributeError, match="spectral_sensitivity=True"):
        vf.slide(vf.Sphere(5e-3), SOLID, normal_force=1.0, velocity=0.1).spectral_sensitivity  # noqa: B018


def test_derivatives_that_are_not_known_are_refused_before_anything_is_computed() -> None:
    heat = vf.Heat(conductivity=0.25, diffusivity=1e-7)
    strain = vf.KrausStrain(critical_strain=0.02, exponent=0.6, storage_ratio=0.3, loss_peak_ratio=1.5)
    # An answer within 1e-12 would not be reached.
    asked = {"normal_force": 1.0, "velocity": [0.1, 0.2], "relative_error": 1e-12}
    for asked_for in ("sensitivity", "spectral_sensitivity"):
        refused: list[tuple[str, dict[str, object]]] = [("solve.method", {"model": "line", "method": "mdr-transient"})]
        if asked_for == "spectral_sensitivity":
            refused += [("heat", {"heat": heat}), ("strain", {"strain": strain})]
        for key, effect in refused:
            with pytest.raises(ValueError, match=f"^{key}: .*, or leave {asked_for} out$"):
                vf.slide(vf.Sphere(5e-3), SOLID, **asked, **effect, **{asked_for: True})  # type: ignore[arg-type]


def test_an_answer_has_the_error_of_its_material() -> None:
    rubber = vf.Prony(1e6, [(1e7, 1e-3), (3e6, 1e-1)], relative_covariance=np.diag([0.0, 0.01, 0.01]))
    scene = {
        "indenter": vf.Cone(0.1),
        "material": rubber,
        "load": {"normal_force": 1.0, "velocity": 0.1},
        "solve": {"model": "line"},
        "uncertainty": {"load.normal_force": 0.02},
    }
    answer = vf.solve(scene, sensitivity=True)
    slopes = [answer.sensitivity[f"material.prony.branches[{branch}].modulus"]["friction_coefficient"] for branch in (0, 1)]
    expected = 0.1 * np.hypot(*slopes) * answer.mu
    assert answer.friction_coefficient_material_error == pytest.approx(expected, rel=1e-9)
    squares = sum(answer.budget[source]["friction_coefficient"] ** 2 for source in ("numerics", "material", "load.normal_force"))
    assert answer.budget["total"]["friction_coefficient"] == pytest.approx(np.sqrt(squares))
    assert answer.to_dict()["friction_coefficient_material_error"] == answer.friction_coefficient_material_error
    plain = vf.solve(scene)
    assert plain.friction_coefficient_material_error is None
    with pytest.raises(AttributeError, match="sensitivity=True"):
        plain.budget  # noqa: B018
    speeds = vf.slide(vf.Cone(0.1), rubber, normal_force=1.0, velocity=[0.1, 0.2], model="line", sensitivity=True)
    assert np.shape(speeds.friction_coefficient_material_error) == (2,)
    with pytest.raises(ValueError, match="covariance.relative"):
        vf.slide(vf.Cone(0.1), vf.Prony(1e6, [(1e7, 1e-3)], relative_covariance=[[0.1]]), normal_force=1.0, velocity=0.1)


def test_isotherms_that_do_not_lie_on_one_curve_are_a_warning_as_of_the_program(tmp_path: Path) -> None:
    table = ROOT / "examples" / "data" / "tread-rubber.csv"
    assert vf.fit_material(table).warnings == ()
    moduli = vf.read_moduli(table)
    omega, temperature, storage, loss = moduli.angular_frequency, moduli.temperature, moduli.storage, moduli.loss
    assert omega is not None and temperature is not None and storage is not None and loss is not None
    wave = 1 + 0.1 * np.sin(2 * np.pi * np.log10(omega) / 3 + temperature / 7)
    columns = np.transpose([omega / (2 * np.pi), temperature, wave * storage, loss])
    head = "f,T,G′,G″\nHz,C,Pa,Pa"
    np.savetxt(tmp_path / "wave.csv", columns, "%.9g", ",", header=head, comments="", encoding="utf-8")
    # The program counts the same changes.
    [warning] = vf.fit_material(tmp_path / "wave.csv").warnings
    assert warning.startswith("the errors of G', 6.67 % rms, are not noise: from one frequency to the next they change their sign 15 of 72 times")
    assert "the isotherms do not lie on one curve" in warning
