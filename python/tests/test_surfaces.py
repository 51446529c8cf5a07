"""Surfaces from heights: the same one in each format, with its units, its orientation and its holes."""

from __future__ import annotations

import io
import struct
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofriction as vf

# All numbers are exact in float32: a bump without symmetry on 25 × 21 points, highest off the middle.
STEP, SPACING = 2.0**-24, (2.0**-13, 2.0**-14)
X, Y = np.meshgrid(np.arange(25.0), np.arange(21.0))
DX, DY = X - 11.0, Y - 8.0
COUNTS = np.round(4000.0 - 6.0 * DX**2 * (1.0 + 0.02 * DX) - 9.0 * DY**2 * (1.0 + 0.02 * DY) - 4.0 * DX * DY).astype(int)
HEIGHTS = STEP * COUNTS
X3P = """<?xml version="1.0"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1><FeatureType>SUR</FeatureType>
<Axes><CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx!r}</Increment></CX><CY><AxisType>I</AxisType>
<Increment>{dy!r}</Increment></CY><CZ><AxisType>A</AxisType><DataType>{kind}</DataType><Increment>{step!r}</Increment></CZ></Axes>
</Record1><Record3><MatrixDimension><SizeX>25</SizeX><SizeY>21</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink>
<PointDataLink>bindata/data.bin</PointDataLink>{valid}</DataLink></Record3></p:ISO5436_2>"""


def gsf(heights: Any) -> bytes:
    head = f"Gwyddion Simple Field 1.0\nXRes = 25\nYRes = 21\nXReal = {25 * SPACING[0]!r}\nYReal = {21 * SPACING[1]!r}\nZUnits = m\n"
    return head.encode() + b"\0" * (4 - len(head) % 4) + heights.astype("<f4").tobytes()


def sur(counts: Any, bits: int = 32) -> bytes:
    head = bytearray(512)
    head[:12] = b"DIGITAL SURF"
    struct.pack_into("<H", head, 18, 2)
    struct.pack_into("<H", head, 86, 1)
    struct.pack_into("<H6i", head, 98, bits, 1, 4000, 25, 21, 525, 0)
    struct.pack_into("<3f", head, 120, SPACING[0], SPACING[1], STEP)
    for at in (180, 196, 212):
        head[at : at + 16] = b"m".ljust(16)
    struct.pack_into("<2H", head, 334, 3, 2)
    return bytes(head) + b"12345" + counts.astype(f"<i{bits // 8}").tobytes()


def x3p(values: Any, kind: str, valid: Any = None) -> bytes:
    link = "" if valid is None else "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", X3P.format(dx=SPACING[0], dy=SPACING[1], step=STEP, kind=kind, valid=link))
        archive.writestr("bindata/data.bin", values.tobytes())
        if valid is not None:
            archive.writestr("bindata/valid.bin", np.packbits(valid.ravel(), bitorder="little").tobytes())
    return file.getvalue()


def xyz(heights: Any) -> bytes:
    points = [(j * SPACING[0], i * SPACING[1], heights[i, j]) for i in range(21) for j in range(25)]
    return "\n".join(f"{x!r};{y!r};{float(z)!r}" for x, y, z in reversed(points) if np.isfinite(z)).encode()


def asc(heights: Any) -> bytes:
    head = f"ncols 25\nnrows 21\nxllcorner 0\nyllcorner 0\ndx {SPACING[0]!r}\ndy {SPACING[1]!r}\nNODATA_value -1\n"
    rows = np.where(np.isnan(heights), -1, heights).tolist()
    return (head + "\n".join(" ".join(map(repr, row)) for row in rows)).encode()


def text(heights: Any, separator: str, mark: str = ".") -> bytes:
    rows = (separator.join(repr(float(z)).replace(".", mark) for z in row) for row in heights)
    return "\n".join(rows).replace("nan", "").encode()


def npy(heights: Any) -> bytes:
    file = io.BytesIO()
    np.save(file, heights)
    return file.getvalue()


#: Files that say how far apart their points are, and others.
FILES = {
    "asc": asc(HEIGHTS),
    "gsf": gsf(HEIGHTS),
    "sur": sur(COUNTS),
    "SUR": sur(COUNTS, 16),
    "x3p": x3p(HEIGHTS, "D"),
    "X3P": x3p(COUNTS.astype("<i2"), "I"),
    "xyz": xyz(HEIGHTS),
}
SPACED = {
    "csv": text(HEIGHTS, ","),
    "semicolons and decimal commas": text(HEIGHTS, ";", ","),
    "tabs": text(HEIGHTS, "\t"),
    "blanks and decimal commas": text(HEIGHTS, " ", ","),
    "npy": npy(HEIGHTS),
    "in Fortran order.npy": npy(np.asfortranarray(HEIGHTS)),
    "single.npy": npy(HEIGHTS.astype("<f4")),
}


def pressed(body: vf.Body) -> dict[str, Any]:
    return vf.press(body, vf.Elastic(1e6), indentation_depth=2e-5, relative_error=0.005).to_dict()


@pytest.fixture(scope="module")
def expected() -> dict[str, Any]:
    return pressed(vf.HeightMap(HEIGHTS, SPACING))


@pytest.mark.parametrize("extension", [*FILES, *SPACED])
def test_every_format_is_the_same_surface(extension: str, expected: dict[str, Any], tmp_path: Path) -> None:
    file = tmp_path / f"surface.{extension}"
    file.write_bytes((FILES | SPACED)[extension])
    found = pressed(vf.HeightMapFile(file, spacing=SPACING if extension in SPACED else None))
    # Positions and heights in decimals are rounded; sides of the contact tell left from right and front from rear.
    assert found["normal_force"] == pytest.approx(expected["normal_force"], rel=1e-12)
    assert found["contact_box"] == pytest.approx(expected["contact_box"], rel=1e-9)
    assert len(set(map(abs, expected["contact_box"].values()))) == 4


@pytest.mark.parametrize(
    "body",
    [
        vf.HeightMap(HEIGHTS.astype(np.float32), SPACING),
        vf.HeightMap(np.asfortranarray(HEIGHTS), SPACING),
        vf.HeightMap(3e-4 - HEIGHTS, SPACING, heights_are="gap"),
        vf.HeightMap(1e6 * HEIGHTS, SPACING, unit="um"),
        # An array that was written with x down its columns.
        vf.HeightMap(np.rot90(HEIGHTS, -1), SPACING[::-1], direction=90),
        vf.HeightMap(HEIGHTS[::-1, ::-1], SPACING, direction=180),
        vf.HeightMap(np.rot90(HEIGHTS), SPACING[::-1], direction=270),
    ],
    ids=["float32", "Fortran", "gap", "um", "90", "180", "270"],
)
def test_what_an_array_holds_can_be_said(body: vf.Body, expected: dict[str, Any]) -> None:
    found = pressed(body)
    assert found["normal_force"] == pytest.approx(expected["normal_force"], rel=1e-9)
    assert found["contact_box"] == pytest.approx(expected["contact_box"], rel=1e-9)


@pytest.mark.parametrize("extension", ["asc", "gsf", "sur", "x3p", "xyz", "csv", "npy", None])
def test_holes_are_refused_or_filled_with_the_mean_of_their_neighbours(extension: str | None, tmp_path: Path) -> None:
    known = np.ones(HEIGHTS.shape, bool)
    known[7:9, 11] = known[0, 0] = False
    holes = np.where(known, HEIGHTS, np.nan)
    contents = {
        "asc": asc(holes),
        "gsf": gsf(holes),
        "sur": sur(np.where(known, COUNTS, -1)),
        "x3p": x3p(COUNTS.astype("<i2"), "I", known),
        "xyz": xyz(holes),
        "csv": text(holes, ";", ","),
        "npy": npy(holes),
    }

    def body(**options: Any) -> vf.Body:
        if extension is None:
            return vf.HeightMap(np.ma.array(HEIGHTS, mask=~known), SPACING, **options)
        file = tmp_path / f"surface.{extension}"
        file.write_bytes(contents[extension])
        return vf.HeightMapFile(file, spacing=SPACING if extension in ("csv", "npy") else None, **options)

    with pytest.raises(ValueError, match="3 of 525 heights are missing"):
        pressed(body())
    filled = pressed(body(fill_missing=True))
    h = HEIGHTS
    holes[7, 11] = (h[7, 10] + h[7, 12] + h[6, 11]) / 3
    holes[8, 11] = (h[8, 10] + h[8, 12] + h[9, 11]) / 3
    holes[0, 0] = (h[1, 0] + h[0, 1]) / 2
    by_hand = pressed(vf.HeightMap(holes, SPACING))
    assert filled["normal_force"] == pytest.approx(by_hand["normal_force"], rel=1e-12)


def test_a_tilt_is_taken_out_when_asked(tmp_path: Path) -> None:
    file = tmp_path / "surface.x3p"
    tilted = HEIGHTS + 3e-6 * X - 2e-6 * Y
    file.write_bytes(x3p(tilted, "D"))
    plane = np.column_stack([np.ones(525), X.ravel(), Y.ravel()])
    level = HEIGHTS - (plane @ np.linalg.lstsq(plane, HEIGHTS.ravel())[0]).reshape(HEIGHTS.shape)
    for body in (vf.HeightMapFile(file, level=True), vf.HeightMap(tilted, SPACING, level=True)):
        expected = pressed(vf.HeightMap(level, SPACING))["normal_force"]
        assert pressed(body)["normal_force"] == pytest.approx(expected, rel=1e-9)


WRONG = [
    ("asc", b"ncols 2\nnrows 2\ncellsize 1\n1 2 3", "3 heights for 2 × 2 points"),
    ("asc", b"ncols 2\nnrows 2\n1 2 3 4", "no cellsize"),
    ("gsf", b"Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 3\nXReal = 1\nYReal = 1\n\0" + b"\0" * 8, "heights for"),
    ("gsf", b"nothing", "another beginning"),
    ("sur", FILES["sur"][:900], "bytes for"),
    ("sur", b"DIGITAL SURF", "another beginning"),
    ("x3p", FILES["x3p"][:300], "ISO 25178-72"),
    ("x3p", x3p(HEIGHTS[1:], "D"), "bytes of type 'D'"),
    ("xyz", b"0 0 1\n0 1 2\n1.000 0 3\n1.300 1 4\n", "beside a grid"),
    ("xyz", b"0 0 1\n0 1 x\n", "xyz:2: column 3"),
    ("xyz", b"0 0 1\n0 1 2\n1 0 3\n1 1 4\n0 1 2\n", "xyz:5: the point at x = 0, y = 1 stands in line 2"),
    ("vk4", b"VK4_" + b"\0" * 100, "Keyence.*x3p.*read_topography.*numpy.save"),
]


@pytest.mark.parametrize(("extension", "contents", "message"), WRONG)
def test_what_is_no_surface_is_named(extension: str, contents: bytes, message: str, tmp_path: Path) -> None:
    file = tmp_path / f"surface.{extension}"
    file.write_bytes(contents)
    with pytest.raises(ValueError, match=message) as raised:
        pressed(vf.HeightMapFile(file))
    assert str(file) in str(raised.value)


class Topography:
    """What HeightMap.from_topography asks of a topography of the package SurfaceTopography."""

    unit, pixel_size = "µm", np.array(SPACING) * 1e6

    def __init__(self, heights: Any) -> None:
        self._heights = heights

    def heights(self) -> Any:
        return self._heights

    def to_unit(self, unit: str) -> Topography:
        assert unit == "m"
        scaled = Topography(1e-6 * self._heights)
        scaled.pixel_size = np.array(SPACING)
        return scaled


def test_a_topography_is_pressed_with_its_tops(expected: dict[str, Any]) -> None:
    found = pressed(vf.HeightMap.from_topography(Topography(1e6 * HEIGHTS.T)))
    assert found["normal_force"] == pytest.approx(expected["normal_force"], rel=1e-9)
    with pytest.raises(ValueError, match="missing"):
        vf.HeightMap.from_topography(Topography(np.ma.masked_greater(HEIGHTS.T, 2e-4)))


def test_a_topography_without_a_unit_needs_one() -> None:
    bare = Topography(1e6 * HEIGHTS.T)
    with pytest.raises(ValueError, match="leave out unit"):
        vf.HeightMap.from_topography(bare, unit="um")
    bare.unit = None  # type: ignore[assignment]
    with pytest.raises(ValueError, match="states no unit"):
        vf.HeightMap.from_topography(bare)
    found = vf.HeightMap.from_topography(bare, unit="um")
    assert found.spacing == pytest.approx(SPACING, rel=1e-12)


@pytest.mark.parametrize("edges", ["wall", "periodic", "mirrored"])
def test_a_flat_map_is_wrong_input(edges: Any) -> None:
    plane = np.add.outer(np.arange(5.0), 3.0 * np.arange(7.0))
    for heights, level in ((np.full((5, 7), 0.1), False), (1e-6 * plane, True)):
        with pytest.raises(ValueError, match="the map is flat"):
            vf.HeightMap(heights, 1e-6, level=level, edges=edges)


def test_lengths_along_x_and_y_have_a_unit(expected: dict[str, Any], tmp_path: Path) -> None:
    points = [(1e6 * j * SPACING[0], 1e6 * i * SPACING[1], HEIGHTS[i, j]) for i in range(21) for j in range(25)]
    lines = ["%.17g %.17g %.17g" % point for point in points]
    for name, text, options in (
        ("metres.xyz", lines, {"lateral_unit": "um"}),
        ("named.xyz", ["# x [um] y [um] z [m]", *lines], {}),
        ("one.xyz", ["%.17g %.17g %.17g" % (x, y, 1e6 * z) for x, y, z in points], {"unit": "um"}),
    ):
        file = tmp_path / name
        file.write_text("\n".join(text))
        found = pressed(vf.HeightMapFile(file, **options))
        assert found["normal_force"] == pytest.approx(expected["normal_force"], rel=1e-9), name


def test_a_topography_of_the_real_package_is_the_same(expected: dict[str, Any]) -> None:
    package = pytest.importorskip("SurfaceTopography")
    sizes = tuple(1e6 * step * count for step, count in zip(SPACING, HEIGHTS.T.shape, strict=True))
    found = pressed(vf.HeightMap.from_topography(package.Topography(1e6 * HEIGHTS.T, sizes, unit="µm")))
    assert found["normal_force"] == pytest.approx(expected["normal_force"], rel=1e-9)


def test_a_periodic_map_is_the_sum_of_its_waves() -> None:
    """Two waves on two grids are one surface, which under a large pressure has the closed form of full contact."""
    solid = vf.StandardSolid(0.25, 2.25, 2.25)

    def answer(n_x: int, n_y: int, pressure: float) -> vf.Answer:
        x, y = np.meshgrid(np.arange(n_x) / n_x, np.arange(n_y) / n_y)
        heights = 0.02 * np.cos(2 * np.pi * (x + 2 * y)) + 0.01 * np.cos(2 * np.pi * (3 * x - y) + 1.0)
        road = vf.HeightMap(heights, (2.0 / n_x, 1.0 / n_y), edges="periodic")
        return vf.slide(road, solid, mean_pressure=pressure, velocity=0.1, relative_error=0.02)

    one, other = answer(16, 8, 0.02), answer(20, 15, 0.02)
    assert one.mu == pytest.approx(other.mu, rel=1e-9) and one.area_fraction < 0.1
    full = answer(16, 8, 100.0)
    assert full.area_fraction == 1.0 and full.mu == pytest.approx(full.persson["friction_coefficient"], rel=1e-10)
    with pytest.raises(ValueError, match="shortest_wavelength: needs edges"):
        vf.HeightMap(np.eye(4), 1.0, shortest_wavelength=1.0)
    with pytest.raises(ValueError, match="short enough for a wave"):
        vf.slide(vf.HeightMap(np.eye(4), 1.0, edges="periodic", shortest_wavelength=9.0), solid, mean_pressure=1.0, velocity=1.0)
    smooth = vf.HeightMap(np.eye(4), 1.0, edges="periodic", shortest_wavelength=2.5)
    assert "edges='periodic'" in repr(smooth) and vf.slide(smooth, solid, mean_pressure=1e3, velocity=1.0).area_fraction == 1.0


def test_a_mirrored_map_has_no_steps() -> None:
    """A ramp that is mirrored is a triangle wave; repeated as it is, it jumps, and the jump has steep waves."""
    ramp = np.tile(np.linspace(0.0, 1e-3, 32), (4, 1))
    mirrored, jumping = (vf.HeightMap(ramp, 1e-3, edges=edges) for edges in ("mirrored", "periodic"))
    assert mirrored.roughness.rms_gradient == pytest.approx(1 / 31, rel=0.1)
    assert jumping.roughness.rms_gradient > 3 * mirrored.roughness.rms_gradient
    with pytest.raises(ValueError, match="edges: unknown variant `open`"):
        vf.HeightMap(ramp, 1e-3, edges="open")  # type: ignore[arg-type]


def test_strange_heights_are_warned_of() -> None:
    """Micrometres that are read as metres, and a tilt that makes a step where the map is repeated."""
    x = 2 * np.pi * np.arange(32) / 32
    waves = np.cos(x) + np.cos(2 * x)[:, np.newaxis]
    tilted = waves + 0.5 * x

    def said(heights: Any, **options: Any) -> list[str]:
        road = vf.HeightMap(heights, 1e-4, **{"edges": "periodic"} | options)
        answer = vf.press(road, vf.Elastic(1e6), mean_pressure=1e9, relative_error=0.1)
        assert set(road.roughness.warnings) <= set(answer.warnings)
        others = ("linear theory", "the shortest octave", "three mirror images")
        return [text for text in answer.warnings if not any(other in text for other in others)]

    assert not said(waves, unit="um") and not said(tilted, unit="um", edges="mirrored")
    [unit] = said(waves)
    assert "span 4.000e0 m over 3.100e-3 m" in unit and 'unit = "mm"' in unit
    [step] = said(tilted, unit="um")
    assert "of the mean square slope along x" in step and "3.0" in step
    assert not said(tilted, unit="um", level=True)


def test_roughness_of_a_wave_is_known() -> None:
    x = 2 * np.pi * np.arange(32) / 32
    wave = vf.HeightMap(1e-3 * np.cos(2 * x) * np.ones((8, 1)), (1e-2 / 32, 1e-2 / 8), edges="periodic")
    found = wave.roughness
    q = 2 * np.pi * 2 / 1e-2
    assert found.rms_height == pytest.approx(1e-3 / np.sqrt(2), rel=1e-12)
    assert found.rms_slopes == (pytest.approx(q * found.rms_height, rel=1e-12), 0.0)
    assert found.rms_curvature == pytest.approx(q**2 * found.rms_height / 2, rel=1e-12)
    assert found.kurtosis == pytest.approx(1.5, rel=1e-12) and found.peak == pytest.approx(1e-3, rel=1e-12)
    assert found.spectrum.shape[1] == 2 and found.profile_spectra[0][:, 1].argmax() == 2


def test_a_rough_surface_is_pressed() -> None:
    """On an elastic material, with its pressure; on a fluid after a time the contact is that of the spring 1/J(t)."""
    road = vf.SelfAffine((1e-2, 1e-2), 0.8, 0.1, 5e-3, 2.5e-3, 1)
    pressed = vf.press(road, vf.Elastic(1e6), mean_pressure=1e5, relative_error=0.05)
    assert pressed.pressure is not None and 0.1 < pressed.area_fraction < 0.9
    fluid = vf.press(road, vf.Maxwell(2e6, 1e6), mean_pressure=1e5, duration=0.5, relative_error=0.05)
    assert fluid.area_fraction == pytest.approx(pressed.area_fraction, rel=1e-9)


def test_many_surfaces_of_a_spectrum_have_their_mean_and_its_standard_error(tmp_path: Path) -> None:
    file = tmp_path / "spectrum.csv"
    file.write_text("wave_number,density\n1250,1e-15\n2600,1e-16\n")
    rubber, load = vf.Prony(1e6, [(1e7, 1e-3)]), {"mean_pressure": 1e5, "velocity": 0.1, "relative_error": 0.05}
    single = [vf.slide(vf.Spectrum(file, (1e-2, 1e-2), seed), rubber, **load).mu for seed in (3, 4)]
    both = vf.slide(vf.Spectrum(file, (1e-2, 1e-2), 3, realisations=2), rubber, **load)
    assert both.mu == pytest.approx(np.mean(single), rel=1e-12)
    assert both.standard_error["friction_coefficient"] == pytest.approx(abs(single[0] - single[1]) / 2, rel=1e-9)
    known = vf.slide(vf.Spectrum(file, (1e-2, 1e-2), 3, standard_error=0.2), rubber, **load)
    assert known.standard_error["friction_coefficient"] <= 0.2 * known.mu
    with pytest.raises(ValueError, match=r"indenter\.spectrum\.realisations must be from 1 to 1000, but is 0"):
        vf.slide(vf.Spectrum(file, (1e-2, 1e-2), 3, realisations=0), rubber, **load)


@pytest.mark.parametrize("name", ["scan.x3p", "scan.gsf"])
def test_a_file_of_heights_is_read_as_a_scene_has_it(name: str, tmp_path: Path) -> None:
    data = struct.pack("<525i", *COUNTS.ravel())
    file = tmp_path / name
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as parts:
        parts.writestr("main.xml", X3P.format(dx=SPACING[0], dy=SPACING[1], step=STEP, kind="L", valid=""))
        parts.writestr("bindata/data.bin", data)
    file.write_bytes(archive.getvalue() if name.endswith("x3p") else gsf(HEIGHTS.astype(np.float32)))
    read = vf.read_height_map(vf.HeightMapFile(file, level=True, direction=90, unit="mm"))
    assert any("the file states the unit of its heights: unit has no effect" in note for note in read.notes)
    given = vf.HeightMap(HEIGHTS, SPACING, level=True, direction=90)
    one, other = (vf.press(body, vf.Elastic(1e6), indentation_depth=1e-6) for body in (read, given))
    assert one.normal_force == other.normal_force and np.array_equal(one.pressure, other.pressure)
    assert read.shortest_wavelength is None and read.edges == "wall"


def test_a_file_that_holds_no_heights_is_refused_with_its_name(tmp_path: Path) -> None:
    file = tmp_path / "notes.x3p"
    file.write_text("no heights")
    with pytest.raises(ValueError, match="^[^:]*notes.x3p: "):
        vf.read_height_map(file)
    with pytest.raises(ValueError, match="^[^:]*absent.csv: No such file"):
        vf.read_height_map(vf.HeightMapFile(tmp_path / "absent.csv", spacing=(1e-6, 1e-6)))
    np.save(tmp_path / "map.npy", HEIGHTS)
    with pytest.raises(ValueError, match="^spacing: "):
        vf.read_height_map(tmp_path / "map.npy")


def test_a_unit_is_guessed_where_the_file_states_none(tmp_path: Path) -> None:
    for name, factor in (("um", 1e6), ("nm", 1e9), ("mm", 1e3), (None, 1.0)):
        file = tmp_path / f"{name}.csv"
        np.savetxt(file, HEIGHTS * factor, delimiter=",")
        guess = vf.plausible_unit(vf.HeightMapFile(file, spacing=SPACING))
        assert guess == name, name
