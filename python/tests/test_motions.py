"""Bodies that move to and fro, through points, or on a track."""

from __future__ import annotations

import numpy as np
import pytest

import viscofriction as vf

BALL = vf.Sphere(5e-3)
SOLID = vf.StandardSolid(1e6, 1e7, 1e4)


def test_a_stroke_has_a_loop_whose_area_is_the_energy() -> None:
    answer = vf.move(BALL, SOLID, stroke=2e-3, frequency=5.0, normal_force=2.0, model="line", relative_error=1e-2)
    assert 0.0 < answer.mu_error < 1e-2 * answer.mu
    assert answer.dissipated_energy is not None and answer.dissipated_energy_error is not None
    motion = answer.motion
    assert set(motion) >= {"time", "position", "tangential_force", "normal_force", "indentation_depth"}
    force, place = motion["tangential_force"], motion["position"]
    work = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(place)))
    # By trapezes over the points of the picture.
    assert abs(work) == pytest.approx(answer.dissipated_energy, rel=0.02)
    path = float(np.abs(np.diff(place)).sum())
    assert answer.mu == pytest.approx(answer.dissipated_energy / (2.0 * path), rel=0.02)
    axes = answer.plot()
    assert axes.get_xlabel().startswith("position x [")


def test_the_shear_of_an_interface_adds_to_the_forces_of_a_motion() -> None:
    options = {"stroke": 2e-3, "frequency": 5.0, "normal_force": 2.0, "elements": 8}
    bare = vf.move(BALL, SOLID, **options)  # type: ignore[arg-type]
    dry = vf.move(BALL, SOLID, interface=vf.ConstantShear(1e5), **options)  # type: ignore[arg-type]
    assert dry.friction_from_shear is not None and dry.friction_from_hysteresis is not None
    assert dry.friction_from_shear > 0.0
    assert dry.friction_from_hysteresis == pytest.approx(float(bare.mu), rel=1e-12)
    assert dry.mu == pytest.approx(float(dry.friction_from_hysteresis) + float(dry.friction_from_shear), rel=1e-12)


def test_strokes_and_frequencies_fit_together() -> None:
    answer = vf.move(
        BALL, SOLID, stroke=[5e-4, 4e-3], frequency=2.0, shape="triangular", normal_force=2.0, model="line", relative_error=1e-2
    )
    assert answer.shape == (2,)
    steady = vf.slide(BALL, SOLID, normal_force=2.0, velocity=2.0 * 4e-3 * 2.0, model="line")
    assert answer.mu[0] != answer.mu[1]
    # The long stroke slides at one speed for most of its way.
    assert answer.mu[1] == pytest.approx(float(steady.mu), rel=0.3)
    with pytest.raises(AttributeError, match="single scene"):
        answer.motion  # noqa: B018


def test_points_are_followed_from_rest() -> None:
    answer = vf.move(
        BALL, SOLID, time=[0.0, 0.1, 0.2], position=[0.0, 1e-3, 1e-3], normal_force=2.0, model="line", relative_error=1e-2
    )
    assert answer.motion["position"][-1] == 1e-3 and answer.peak_friction is not None
    with pytest.raises(ValueError, match="time"):
        vf.move(BALL, SOLID, time=[0.0, 0.1, 0.1], position=[0.0, 1e-3, 2e-3], normal_force=2.0, model="line")
    with pytest.raises(ValueError, match="stroke"):
        vf.move(BALL, SOLID, stroke=0.0, frequency=1.0, normal_force=2.0, model="line")


def test_a_rough_surface_moves_under_a_mean_pressure() -> None:
    road = vf.SelfAffine(period=(1e-2, 1e-2), hurst_exponent=0.8, rms_slope=0.1, longest_wavelength=5e-3, shortest_wavelength=2.5e-3, seed=1)
    # All gaps are closed, and the energy is that of any larger pressure.
    answer = vf.move(road, SOLID, stroke=2e-3, frequency=5.0, mean_pressure=[1e8, 2e8], relative_error=1e-6)
    assert answer.dissipated_energy is not None
    assert answer.dissipated_energy[0] == pytest.approx(answer.dissipated_energy[1], rel=1e-9)
    assert answer.mu[0] == pytest.approx(2.0 * answer.mu[1], rel=1e-9)


def test_a_long_track_is_a_straight_one() -> None:
    straight = vf.slide(BALL, SOLID, normal_force=2.0, velocity=0.1, model="line")
    tracks = vf.slide(BALL, SOLID, normal_force=2.0, velocity=0.1, track=[5e-3, 10.0], model="line")
    assert tracks.mu[1] == pytest.approx(float(straight.mu), rel=1e-9)
    assert tracks.mu[0] < straight.mu
    on_half_space = vf.slide(BALL, SOLID, normal_force=2.0, velocity=0.1, track=[15e-3, 10.0], relative_error=1e-2)
    assert on_half_space.mu[0] < on_half_space.mu[1]
    with pytest.raises(ValueError, match="track"):
        vf.slide(BALL, SOLID, normal_force=2.0, velocity=0.1, track=0.1, method="bem-transient")
