"""The numbers are those of the program, to the last bit."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

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
    vary = ["--vary", "load.velocity=0.1,0.2,0.3", "--vary", "solve.model=line,half-space"]
    program("sweep", scene, *vary, "--out", tmp_path / "sweep.csv")
    table = vf.sweep(scene, {"load.velocity": [0.1, 0.2, 0.3], "solve.model": ["line", "half-space"]})
    table.to_csv(tmp_path / "ours.csv")
    theirs, ours = ((tmp_path / name).read_text().splitlines() for name in ("sweep.csv", "ours.csv"))
    # The first column is the fingerprint of the text of the scene.
    assert [row.split(",")[1:] for row in ours] == [row.split(",")[1:] for row in theirs]


def test_what_one_of_them_began_the_other_goes_on_with(program: Callable[..., str], tmp_path: Path) -> None:
    scene, speeds = SCENES / "ball-on-rubber.toml", [1e-3, 1e-2, 1e-1, 1.0]
    vary = ["--vary", "load.velocity=1e-3:1:4:log"]
    program("sweep", scene, *vary, "--out", tmp_path / "whole.csv")
    whole = (tmp_path / "whole.csv").read_text()
    begun = "".join(whole.splitlines(keepends=True)[:3])
    for name, resume in {
        "theirs.csv": lambda file: program("sweep", scene, *vary, "--resume", "--out", file),
        "ours.csv": lambda file: vf.sweep(scene, {"load.velocity": speeds}, out=file, resume=True),
    }.items():
        vf.sweep(scene, {"load.velocity": speeds}, out=tmp_path / name, stop=lambda: True)
        assert len(vf.read_sweep(tmp_path / name)) == 0
        (tmp_path / name).write_text(begun)
        resume(tmp_path / name)
        assert (tmp_path / name).read_text() == whole


@pytest.mark.parametrize(("option", "named"), [("--sensitivity", {"sensitivity": True}), ("--samples 3", {"samples": 3})])
def test_a_sweep_of_uncertain_numbers_has_the_rows_of_the_program(
    option: str, named: dict[str, Any], program: Callable[..., str], tmp_path: Path
) -> None:
    scene = tmp_path / "scene.toml"
    load = "load = { normal_force = 1.0, velocity = 0.1 }"
    cone = "indenter.cone = { slope = 0.1 }\nmaterial.viscous = { viscosity = 1e4 }"
    scene.write_text(f'{cone}\n{load}\nuncertainty = {{ "load.normal_force" = 0.05 }}\n')
    program("sweep", scene, "--vary", "load.velocity=0.1,0.2", *option.split(), "--out", tmp_path / "theirs.csv")
    table = vf.sweep(scene, {"load.velocity": [0.1, 0.2]}, **named)
    table.to_csv(tmp_path / "ours.csv")
    theirs, ours = ((tmp_path / name).read_text().splitlines() for name in ("theirs.csv", "ours.csv"))
    assert [row.split(",")[1:] for row in ours] == [row.split(",")[1:] for row in theirs]
    # The load of a cone on a dashpot is proportional to the width of its contact.
    assert np.isclose(table["contact_area_uncertainty"][0], 2 * 0.05 * table["contact_area"][0], rtol=1e-2)
    assert table.keys == ["load.velocity", *(["sample"] if "samples" in named else [])]


def test_samples_are_counted_and_need_uncertain_numbers() -> None:
    scene = {"indenter": vf.Cone(0.1), "material": vf.Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 0.1}}
    for samples, message in ((0, "samples must be a whole number from 1 to 999999, but is 0"), (1.5, "samples must be a whole number"), (3, "samples need a number")):
        with pytest.raises(ValueError, match=message):
            vf.sweep(scene, samples=samples)  # type: ignore[arg-type]


def test_arrays_have_the_answers_of_single_loads() -> None:
    rubber = vf.StandardSolid(1e6, 1e7, 1e4)
    speeds = np.logspace(-3, 2, 6)
    every = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=speeds, relative_error=1e-2)
    for index in (0, 3, 5):
        one = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=speeds[index], relative_error=1e-2)
        assert every.mu[index] == one.mu
        assert every.area[index] == one.area


def test_layers_are_arrays_of_thicknesses() -> None:
    rubber = vf.Prony(1e6, [(1e7, 1e-3), (3e6, 1e-1)])
    layers = vf.slide(vf.Cylinder(0.05), rubber, normal_force=2e3, velocity=1.0, thickness=[1e-3, 1e-2])
    one = vf.slide(vf.Cylinder(0.05), rubber, normal_force=2e3, velocity=1.0, thickness=1e-2)
    assert layers.mu[0] < layers.mu[1] == one.mu
    with pytest.raises(ValueError, match="layer.thickness must be finite and greater than 0, but is -1"):
        vf.press(vf.Sphere(0.01), vf.Elastic(1e6), normal_force=1.0, thickness=-1.0)


def test_a_history_is_named_arrays() -> None:
    answer = vf.solve(SCENES / "press-hold-pull-press.toml")
    history = answer.history
    assert set(history) == {"time", "normal_force", "indentation_depth", "contact_radius"}
    assert (np.diff(history["time"]) >= 0).all() and history["normal_force"].max() > 0


def export(*temperatures: float, entropic: bool = False) -> str:
    """A table of Young's moduli, as an instrument writes it: one isotherm per temperature, a decade apart for 10 °C."""
    rubber = vf.Prony(1e6, [(1e7, 1e-3), (3e6, 1e-1)])
    lines = ["Gummi, gemessen", "f (Hz);T (°C);E' (MPa);E'' (MPa)"]
    for temperature in temperatures:
        hertz = np.logspace(-2, 2, 17)
        omega = 2 * np.pi * hertz * 10 ** (0.1 * (20.0 - temperature))
        megapascals = 3e-6 * ((temperature + 273.15) / 293.15 if entropic else 1.0)
        moduli = zip(rubber.storage_modulus(omega), rubber.loss_modulus(omega), strict=True)
        for frequency, (storage, loss) in zip(hertz, moduli, strict=True):
            lines.append(f"{frequency:.6e};{temperature};{megapascals * storage:.9e};{megapascals * loss:.9e}".replace(".", ","))
    return "\n".join(lines)


def test_moduli_may_change_with_the_absolute_temperature(tmp_path: Path) -> None:
    table = tmp_path / "export.csv"
    table.write_text(export(0.0, 10.0, 20.0, 30.0, 40.0, entropic=True), encoding="latin-1")
    fit = vf.fit_material(table)
    assert fit.vertical == "entropic" and fit.vertical_is_found and fit.shift is not None
    assert fit.shift["vertical"] == "entropic"
    for shift in fit.shifts:
        assert np.isclose(shift.modulus_factor, (shift.temperature + 273.15) / 293.15, rtol=1e-12)
        assert shift.modulus_factor_error == 0.0 and shift.log10_factor_error is not None and not shift.placed_by_law
        assert abs(shift.log10_factor - 0.1 * (20.0 - shift.temperature)) < 2e-3
    warm = fit.at(26.0)
    assert np.isclose(warm.equilibrium_modulus / fit.material.equilibrium_modulus, 299.15 / 293.15, rtol=1e-12)
    free = vf.fit_material(table, vertical="free")
    assert free.vertical == "free" and abs(free.shifts[0].modulus_factor * 293.15 / 273.15 - 1) < 0.02
    with pytest.raises(ValueError, match='vertical must be one of "none", "entropic", "free"'):
        vf.fit_material(table, vertical="rubber")


@pytest.mark.parametrize("temperatures", [(20.0,), (30.0, 20.0, 10.0)])
def test_a_table_of_an_instrument_has_the_fit_of_the_program(
    temperatures: tuple[float, ...], program: Callable[..., str], tmp_path: Path
) -> None:
    table = tmp_path / "export.csv"
    table.write_text(export(*temperatures), encoding="latin-1")
    program("fit-material", table, "--out", tmp_path / "fit")
    theirs = tomllib.loads((tmp_path / "fit" / "material.toml").read_text())["material"]["prony"]
    fit = vf.fit_material(table)
    assert fit.material.equilibrium_modulus == theirs["equilibrium_modulus"]
    assert fit.material.branches == tuple((one["modulus"], one["relaxation_time"]) for one in theirs["branches"])
    assert [temperature for temperature, _ in fit.log10_factors] == (list(temperatures) if len(temperatures) > 1 else [])
    for temperature, factor in fit.log10_factors:
        assert abs(factor - 0.1 * (20.0 - temperature)) < 1e-3
    assert fit.material.valid_frequencies == tuple(theirs["valid_frequencies"])
    assert fit.temperature == 20.0 and fit.shift == theirs.get("shift")
    relative = np.array(theirs["covariance"]["relative"])
    moduli = np.array([theirs["equilibrium_modulus"], *(one["modulus"] for one in theirs["branches"])])
    assert fit.covariance is not None and np.array_equal(fit.covariance, relative * np.outer(moduli, moduli))
    assert fit.covariance_method == theirs["covariance"]["method"]
    if len(temperatures) > 1:
        for options, theirs in (
            ({"wlf": (8.86, 101.6), "reference_temperature": 20.0}, "--wlf 8.86 101.6 --reference-temperature 20"),
            ({"wlf": (8.86, 101.6), "temperature": 12.0}, "--wlf 8.86 101.6 --temperature 12"),
            ({"arrhenius": 1.65e5}, "--arrhenius 1.65e5"),
            ({"temperature": 24.0}, "--temperature 24"),
        ):
            ours = vf.fit_material(table, **options)  # type: ignore[arg-type]
            program("fit-material", table, *theirs.split(), "--out", tmp_path / theirs)
            [(_, prony)] = tomllib.loads((tmp_path / theirs / "material.toml").read_text())["material"].items()
            assert ours.material.branches == tuple((one["modulus"], one["relaxation_time"]) for one in prony["branches"]), theirs
            assert ours.shift == prony["shift"] and ours.temperature == options.get("temperature", 20.0), theirs
        wanted = vf.fit_material(table, reference_temperature=24.0)
        shifted = fit.at(24.0)
        assert wanted.temperature == 24.0
        frequency = np.logspace(-1, 1, 5)
        assert np.allclose(shifted.loss_modulus(frequency), wanted.material.loss_modulus(frequency), rtol=0.02)
        by_file = vf.MaterialFile(tmp_path / "fit" / "material.toml", temperature=24.0)
        assert np.array_equal(shifted.loss_modulus(frequency), by_file.loss_modulus(frequency))
        assert "covariance" not in repr(fit.material), "a matrix hides all else"
        # A fit is heated by its shift law as the file of the program is.
        hot: dict[str, Any] = {"normal_force": 2.0, "velocity": 0.1, "relative_error": 1e-2}
        hot["interface"] = vf.BellShear(1e5, 1e-2, activation_energy=80.0, activation_energy_unit="kJ/mol")
        hot["heat"] = vf.Heat(0.25, diffusivity=1e-7)
        ours, theirs = (vf.slide(vf.Sphere(5e-3), rubber, **hot) for rubber in (shifted, by_file))
        assert ours.mu == theirs.mu and ours.effective_temperature == theirs.effective_temperature
        assert ours.effective_temperature is not None and ours.effective_temperature > 24.0
        written = tmp_path / "ours.toml"
        written.write_text(fit.material.to_toml())
        known = tomllib.loads(written.read_text())["material"]["prony"]
        assert known.pop("covariance")["relative"] == relative.tolist() and known["shift"] == fit.shift
        again = vf.MaterialFile(written, temperature=24.0)
        assert np.array_equal(shifted.loss_modulus(frequency), again.loss_modulus(frequency))
        with pytest.raises(ValueError, match="from 10 °C to 30 °C"):
            fit.at(31.0)
    else:
        with pytest.raises(ValueError, match="no shift law"):
            fit.at(24.0)
    assert fit.vertical == ("none" if len(temperatures) > 1 else None) and len(fit.shifts) == len(fit.log10_factors)
    moduli = vf.read_moduli(table)
    assert fit.measured is not None and fit.measured.storage is not None and moduli.storage is not None
    assert np.array_equal(np.sort(fit.measured.storage), np.sort(moduli.storage))
    storage_residuals, loss_residuals = fit.residuals
    assert max(abs(storage_residuals).max(), abs(loss_residuals).max()) < 0.02, "the points do not lie on the curve"
    assert moduli.time is None and moduli.storage is not None and moduli.storage.size == 17 * len(temperatures)
    assert (moduli.temperature is None) == (len(temperatures) == 1)
