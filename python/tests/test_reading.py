"""Files of surfaces take no more memory and time than the scene allows, whatever they say of themselves."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import ROOT

import viscofriction as vf

MAIN = """<ISO5436_2><Record1><Axes><CX><AxisType>I</AxisType><Increment>1e-6</Increment></CX>
<CY><AxisType>I</AxisType><Increment>1e-6</Increment></CY><CZ><DataType>D</DataType></CZ></Axes></Record1>
<Record3><MatrixDimension><SizeX>{size}</SizeX><SizeY>{size}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
<DataLink><PointDataLink>data.bin</PointDataLink></DataLink></Record3></ISO5436_2>"""

READING = """
import resource, sys
import viscofriction as vf

load = {"normal_force": 1.0, "velocity": 0.0}
def solve(body):
    scene = {"indenter": body, "material": vf.Elastic(1e6), "load": load}
    return vf.solve(scene | {"solve": {"duration": 1.0, "max_memory": "64 MiB"}})

solve(vf.Sphere(1.0))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    solve(vf.HeightMapFile(sys.argv[1]))
except ValueError as error:
    print(error)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) >> 10, "MiB")
"""


def x3p(main: str, data: int, *, stated: int | None = None) -> bytes:
    """An archive with so many bytes of zeros as its heights, or ``stated`` ones by its own directory."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("data.bin", bytes(data))
        archive.writestr("main.xml", main)
    contents = file.getvalue()
    return contents if stated is None else contents.replace(data.to_bytes(4, "little"), stated.to_bytes(4, "little"))


GSF = b"Gwyddion Simple Field 1.0\nXRes = 4\nYRes = 4\nXReal = "
FILES = {
    "more data than points": ("x3p", x3p(MAIN.format(size=10), 1 << 28), "more than 4896 bytes"),
    "more data than is stated": ("x3p", x3p(MAIN.format(size=10), 1 << 28, stated=800), "data.bin"),
    "more points than memory": ("x3p", x3p(MAIN.format(size=4096), 1 << 27), "16777216 heights need"),
    "more points than data": ("x3p", x3p(MAIN.format(size=1000), 800), "800 bytes of type 'D'"),
    "a long description": ("x3p", x3p(MAIN.format(size=10) + " " * (1 << 21), 800), "main.xml: more than 1048576 bytes"),
    "many attributes": (
        "x3p",
        x3p("<a " + " ".join(f'a{n}=""' for n in range(60_000)) + "/>", 800),
        "more than 4096 attributes",
    ),
    "a damaged head": ("gsf", GSF + b"9" * (1 << 24), "another beginning"),
}


@pytest.mark.skipif(sys.platform != "linux", reason="peaks of memory are in KiB there")
@pytest.mark.parametrize("name", FILES)
def test_no_file_takes_more_memory_than_the_scene_allows(name: str, tmp_path: Path) -> None:
    extension, contents, message = FILES[name]
    file = tmp_path / f"surface.{extension}"
    file.write_bytes(contents)
    done = subprocess.run(
        [sys.executable, "-c", READING, file], check=True, capture_output=True, text=True, timeout=20, cwd=tmp_path
    )
    said, peak = done.stdout.strip().rsplit("\n", 1)
    assert message in said and len(said) < 400, done.stdout[:1000]
    assert int(peak.split()[0]) <= 64, peak


def test_a_scene_file_has_a_largest_size(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_bytes(b"#" * ((1 << 24) + 1))
    for path in (file, tmp_path, Path("/dev/zero")):
        with pytest.raises(ValueError, match="a regular file of at most 16777216 bytes is needed"):
            vf.solve(path)
    with pytest.raises(FileNotFoundError):
        vf.solve(tmp_path / "none.toml")


#: What each reader says of the files of the others.
EXCHANGED = {
    "moduli": {
        "friction": "this is a table of measured friction",
        "sweep": "this is a table of results of a sweep",
        "map": "these are numbers without names, as of a height map",
        "surface": "the file is binary",
    },
    "friction": {
        "moduli": "this is a table of moduli",
        "sweep": "this is a table of results of a sweep",
        "map": "these are numbers without names, as of a height map",
        "surface": "the file is binary",
    },
    "map": {
        "moduli": "the columns have the names 'Frequenz' and 'Temperatur': this is a table of measurements or results",
        "friction": "the columns have the names 'v (mm/s)' and 'T (C)': this is a table of measurements or results",
        "sweep": "no line is a row of numbers; this one begins with 'sweep,point",
    },
    "sweep": dict.fromkeys(("moduli", "friction", "map", "surface"), "is not the table of a sweep, whose columns begin with sweep, point, points"),
}


@pytest.mark.parametrize(("reader", "given"), [(reader, given) for reader, others in EXCHANGED.items() for given in others])
def test_exchanged_files_are_named(reader: str, given: str, tmp_path: Path) -> None:
    data = ROOT / "examples" / "data"
    (tmp_path / "map.csv").write_text("\n".join("0.1,0.25,0.3,0.15" for _ in range(4)) + "\n")
    ball = {"indenter": vf.Sphere(5e-3), "material": vf.Elastic(1e6), "load": {"normal_force": 1.0, "velocity": 0.0}, "solve": {"duration": 1.0}}
    vf.sweep(ball, {"load.normal_force": [1.0, 2.0]}, out=tmp_path / "sweep.csv")
    files = {"moduli": data / "tread-rubber.csv", "friction": data / "dry-friction.csv", "surface": data / "road.x3p"}
    files |= {"map": tmp_path / "map.csv", "sweep": tmp_path / "sweep.csv"}
    readers = {"moduli": vf.fit_material, "friction": vf.read_friction, "sweep": vf.read_sweep}
    readers["map"] = lambda file: vf.read_height_map(vf.HeightMapFile(file, spacing=(1e-5, 1e-5)))
    with pytest.raises(ValueError, match=re.escape(EXCHANGED[reader][given])):
        readers[reader](files[given])


def test_tables_that_take_too_long_to_fit_are_refused_at_once(tmp_path: Path) -> None:
    large = tmp_path / "large.csv"
    with large.open("wb") as file:
        file.truncate((8 << 20) + 1)
    with pytest.raises(ValueError, match="large.csv: a table of moduli has at most 8 MiB, and this file has 8 MiB"):
        vf.fit_material(large)
    rows = (f"{0.1 + 1e-4 * index},{10 * (index % 3)},2.0,0.3" for index in range(20_001))
    large.write_text("\n".join(["f (Hz),T (C),E' (MPa),E'' (MPa)", *rows]))
    with pytest.raises(ValueError, match="20001 points at 3 temperatures: at most 20000 are shifted"):
        vf.fit_material(large)
