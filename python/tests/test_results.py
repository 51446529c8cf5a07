"""What results offer: arrays, texts, pictures."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscofriction as vf

SPEEDS = np.logspace(-3, 1, 5)
SOLID = vf.StandardSolid(1e6, 1e7, 1e4)


def test_a_single_scene_reads_well_in_text_and_notebook() -> None:
    answer = vf.slide(vf.Cone(0.1), vf.Viscous(1e4), normal_force=1.0, velocity=0.01)
    assert repr(answer).splitlines()[:2] == ["analytic, half-space", "  friction_coefficient: 0.0891298 ± 7.3e-06"]
    assert "<td>friction_coefficient</td><td>0.0891298</td><td>7.3e-06</td>" in answer._repr_html_()


def test_friction_is_drawn_over_speed_with_its_bars() -> None:
    answer = vf.slide(vf.Cone(0.1), SOLID, normal_force=2.0, velocity=SPEEDS, model="line")
    axes = answer.plot()
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_xscale()) == ("speed [m/s]", "friction coefficient", "log")
    (line, *_), *_ = axes.containers
    assert (line.get_xdata() == SPEEDS).all()
    assert answer.mu is not None and (line.get_ydata() == answer.mu).all()


def test_families_and_grids_are_drawn() -> None:
    forces = np.array([[1.0], [2.0]])
    axes = vf.slide(vf.Cone(0.1), SOLID, normal_force=forces, velocity=SPEEDS, model="line").plot()
    assert len(axes.containers) == 2
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["normal force [N]: 1", "normal force [N]: 2"]
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 1.0}}
    table = vf.sweep(scene, {"load.velocity": SPEEDS, "load.normal_force": [1.0, 2.0, 3.0]})
    axes = table.plot()
    assert (axes.get_xlabel(), axes.get_xscale(), axes.get_yscale()) == ("speed [m/s]", "log", "linear")
    assert (axes.collections[0].get_array() == table["friction_coefficient"].reshape(5, 3).T).all()


def test_pressure_is_drawn_where_it_is() -> None:
    answer = vf.slide(vf.Sphere(5e-3), SOLID, normal_force=2.0, velocity=0.1, relative_error=1e-2)
    assert answer.pressure.shape == (answer.x.size, answer.y.size)
    element = (answer.x[1] - answer.x[0]) * (answer.y[1] - answer.y[0])
    assert math.isclose(answer.pressure.sum() * element, 2.0, rel_tol=1e-6)
    axes = answer.plot()
    assert axes.get_xlabel() == "x [m]"
    assert (axes.collections[0].get_array() == answer.pressure.T).all()


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
    assert friction.mu is not None and friction.mu_error is not None
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
