"""What was chosen, and the scene, the command and the Python program that say the same: no page and no computation."""

from __future__ import annotations

import hashlib
import json
import shlex
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from decimal import Decimal
from itertools import product
from pathlib import Path
from pprint import pformat
from typing import Any

import numpy as np

import viscofriction as vf

from .. import _native
from .._fitting import Deformation, Fit, Vertical
from .._forms import Family, kinds
from .._sweeping import Sweep

#: Ends of the names of files that hold heights with their positions, and of tables.
MAPS = {".asc", ".gsf", ".npy", ".sdf", ".sur", ".x3p", ".xyz"}
TABLES = {".csv", ".dat", ".tsv", ".txt"}
#: Largest number of temperatures, each of which is a curve of the picture.
LARGEST_COUNT = 6
#: Heights within the shortest wave that is kept of a map, unless another one is chosen: a first picture in seconds.
HEIGHTS_PER_WAVE = 8
#: Units in which lengths are chosen and shown, with their powers of ten.
LENGTHS = {"mm": -3, "µm": -6, "m": 0}
#: What a scene may have beside its material and its load.
FAMILIES: tuple[Family, ...] = ("indenter", "interface", "heat", "strain")


@dataclass(frozen=True)
class Choices:
    """All that a person has chosen. Files are names in the folder; all numbers are in SI, temperatures in °C.

    ``material``: A table of moduli, or a material file (TOML).
    ``tables``: Of "indenter", "interface", "heat" and "strain" the chosen kind with its keys, as in a scene; absent where nothing is.
    ``thickness``: That of a layer on a rigid base [m]; None for a half space.
    ``force``: Normal force [N], of a cylinder per length, or of a periodic surface the mean pressure [Pa].
    ``temperatures``: Those of the curves; empty for a material without a shift law.
    ``cold_too``: With heat, the friction without it as well.
    ``band``: What the uncertainty of the material makes of the friction as well; in curves without heat and strain, with which it takes long.
    ``measured``: A table of measured friction, which is drawn.
    ``unit``: The unit in which lengths are chosen and shown.
    """

    material: str = ""
    deformation: Deformation | None = None
    vertical: Vertical | None = None
    reference_temperature: float | None = None
    tables: Mapping[str, Mapping[str, Mapping[str, Any]]] = field(default_factory=dict)
    thickness: float | None = None
    force: float | None = None
    slowest: float | None = 1e-3
    fastest: float | None = 10.0
    n_speeds: float | None = 5.0
    temperatures: tuple[float, ...] = ()
    relative_error: float | None = 0.05
    band: bool = True
    cold_too: bool = True
    measured: str = ""
    unit: str = "mm"

    def kind(self, family: str) -> str | None:
        """The chosen kind of a family, None where nothing is chosen."""
        return next(iter(self.tables.get(family, {})), None)

    def keys(self, family: str) -> Mapping[str, Any]:
        """The keys of the chosen kind that have a value."""
        chosen = self.tables.get(family, {})
        return next(({name: value for name, value in keys.items() if value is not None} for keys in chosen.values()), {})

    def with_table(self, family: str, kind: str | None, keys: Mapping[str, Any]) -> Choices:
        """The same with this kind of a family, or without one."""
        others = {name: table for name, table in self.tables.items() if name != family}
        return replace(self, tables=others if kind is None else others | {family: {kind: dict(keys)}})

    @property
    def is_periodic(self) -> bool:
        """Whether the body repeats itself, so that it is pressed by a mean pressure."""
        repeats = self.keys("indenter").get("edges", "wall") != "wall"
        return self.kind("indenter") in ("self-affine", "spectrum") or (self.kind("indenter") == "height-map" and repeats)

    @property
    def is_fitted(self) -> bool:
        """Whether the material is a table of moduli, which is fitted, and no material file."""
        return not self.material.endswith(".toml")

    @property
    def of_fit(self) -> dict[str, Any]:
        """The options of the fit that are chosen."""
        options = {"deformation": self.deformation, "vertical": self.vertical, "reference_temperature": self.reference_temperature}
        return {option: value for option, value in options.items() if value is not None}

    @property
    def force_key(self) -> str:
        """The key of the load that is chosen."""
        return "mean_pressure" if self.is_periodic else "normal_force"

    @property
    def force_label(self) -> str:
        """That key with its unit."""
        unit = "Pa" if self.is_periodic else "N/m" if self.kind("indenter") == "cylinder" else "N"
        return f"{self.force_key.replace('_', ' ')} [{unit}]"

    @property
    def title(self) -> str:
        """Material, body, load, and what else is chosen, in a few words."""
        body = [self.kind("indenter"), self.keys("indenter").get("file")]
        load = None if self.force is None else f"{self.force_label.replace(' [', f' {self.force:g} ').rstrip(']')}"
        effects = [family for family in FAMILIES[1:] if family in self.tables]
        return ", ".join(filter(None, [self.material, *body, load, *effects]))

    def to_json(self) -> str:
        """A text from which ``from_json`` makes the same choices."""
        return json.dumps(asdict(self), indent=1, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Choices:
        """The choices of such a text; keys of other versions are left out. Raises ValueError for another text."""
        known = json.loads(text)
        if not isinstance(known, dict) or not isinstance(known.get("tables", {}), dict):
            raise ValueError("the choices must be an object of JSON")
        names = {one.name for one in fields(cls)} - ({"unit"} if known.get("unit") not in LENGTHS else set())
        kept = {name: value for name, value in known.items() if name in names}
        return cls(**kept | {"temperatures": tuple(kept.get("temperatures", ()))})


def shifted(number: float | None, power: int) -> float | None:
    """A number times a power of ten with the same digits, which a product in floating point may change."""
    return None if number is None else float(Decimal(repr(number)).scaleb(power))


def fit(choices: Choices, folder: Path) -> Fit:
    """The fit of the table of moduli. Raises ValueError with line and column."""
    return vf.fit_material(folder / choices.material, **choices.of_fit)


def guessed_temperatures(found: Fit) -> tuple[float, ...]:
    """Temperatures for a first picture: 0 °C and 20 °C where the shift law holds, or that of the fit."""
    if found.shift is None:
        return ()
    first, last = found.shift["temperature_range"]
    return tuple(one for one in (0.0, 20.0) if first <= one <= last) or (found.shift["temperature"],)


def number(text: Any) -> float | None:
    """The number of a text or a number, None for an empty text. Raises ValueError for a comma, which may be either of two things."""
    words = "" if text is None else str(text).strip()
    try:
        return float(words) if words else None
    except ValueError:
        raise ValueError(f"must be a number with a decimal point and without separators, such as 0.01, but is {words}") from None


def shown(value: float | None) -> str:
    """A number as a text, with all its digits and no others."""
    return "" if value is None else repr(value).removesuffix(".0")


def temperatures(text: str) -> tuple[float, ...]:
    """Numbers between blanks or semicolons. Raises ValueError for anything else, such as a decimal comma."""
    try:
        return tuple(float(word) for word in text.replace(", ", " ").replace(";", " ").split())
    except ValueError:
        raise ValueError(f"material.file.temperature must be numbers between blanks, such as 0 20 39, but is {text}") from None


def surface(choices: Choices, folder: Path) -> tuple[vf.HeightMap, Choices]:
    """The chosen height map, and the choices with what was guessed where nothing is chosen: a unit of plausible heights, and the
    shortest wave. Raises ValueError with the line of the file or the key."""
    keys = dict(choices.keys("indenter"))
    file = vf.HeightMapFile(**keys | {"file": folder / keys["file"]})
    unit = file.unit or vf.plausible_unit(file)
    found = vf.read_height_map(replace(file, unit=unit))
    keys |= {} if unit is None else {"unit": unit}
    if choices.is_periodic and file.shortest_wavelength is None:
        keys["shortest_wavelength"] = float(f"{HEIGHTS_PER_WAVE * max(found.spacing):.3g}")
    return found, choices.with_table("indenter", "height-map", keys)


def check(choices: Choices, family: Family) -> None:
    """Raises ValueError for a number that is missing or out of its range in the table of a family."""
    kind = choices.kind(family)
    if kind is None:
        return
    table = choices.keys(family)
    for key in kinds(family)[kind].keys:
        if key.is_required and table.get(key.name) in (None, ""):
            path = ".".join(part for part in (family, kind, key.name) if part)
            raise ValueError(f"{path} is needed: {key.meaning}")
    if family == "heat" and choices.is_periodic and table.get("duration") is None:
        raise ValueError("heat.duration is needed: the time for which the surface has been sliding [s], because its mean temperature grows")
    _native.check_table({family: _table(choices, family)})


def _table(choices: Choices, family: str) -> dict[str, Any]:
    kind, keys = choices.kind(family), dict(choices.keys(family))
    return {kind: keys} if kind else keys


def speeds(choices: Choices) -> list[float]:
    """The speeds [m/s], in equal factors, with three digits. Raises ValueError for what is missing or out of its range."""
    first = _positive("load.velocity.slowest", choices.slowest)
    last = _positive("load.velocity.fastest", choices.fastest)
    count = choices.n_speeds
    if count is None or not float(count).is_integer() or not 1 <= count <= 1000:
        raise ValueError(f"load.velocity.count must be a whole number from 1 to 1000, but is {_shown(count)}")
    if count > 1 and last <= first:
        raise ValueError(f"load.velocity.fastest must be greater than the slowest, {first:g} m/s, but is {last:g}")
    rounded = [float(f"{speed:.3g}") for speed in np.geomspace(first, last if count > 1 else first, int(count))]
    return list(dict.fromkeys(rounded))


def vary(choices: Choices) -> dict[str, list[float]]:
    """The keys that vary, as ``vf.sweep`` takes them; the speed varies fastest."""
    if len(choices.temperatures) > LARGEST_COUNT:
        raise ValueError(f"material.file.temperature: at most {LARGEST_COUNT} temperatures are drawn")
    if not np.isfinite(choices.temperatures).all():
        raise ValueError("material.file.temperature must be numbers between blanks, such as 0 20 39")
    if len(set(choices.temperatures)) < len(choices.temperatures):
        raise ValueError("material.file.temperature: a temperature is given twice")
    hot = {"material.file.temperature": list(choices.temperatures)} if choices.temperatures else {}
    return hot | {"load.velocity": speeds(choices)}


def scene(choices: Choices, name: str, *, heated: bool = True) -> dict[str, Any]:
    """The scene of the computation with this name, for the folder of its files. Raises ValueError for what is missing."""
    if not choices.material:
        raise ValueError("material: a table of moduli is needed")
    if choices.kind("indenter") is None:
        raise ValueError("indenter: a body is needed")
    for family in FAMILIES:
        check(choices, family)
    effects = [family for family in FAMILIES[1:] if family in choices.tables and (heated or family != "heat")]
    material: dict[str, Any] = {"path": material_file(choices, name)}
    if choices.temperatures:
        material["temperature"] = choices.temperatures[0]
    layer = {} if choices.thickness is None else {"layer": {"thickness": _positive("layer.thickness", choices.thickness)}}
    load = {choices.force_key: _positive(f"load.{choices.force_key}", choices.force), "velocity": speeds(choices)[0]}
    return {
        "indenter": _table(choices, "indenter"),
        "material": {"file": material},
        **layer,
        **{family: _table(choices, family) for family in effects},
        "load": load,
        "solve": {"relative_error": _positive("solve.relative_error", choices.relative_error)},
    }


def material_file(choices: Choices, name: str) -> str:
    """The material file of a computation: that of its fit, or the chosen one."""
    return f"{name}-material.toml" if choices.is_fitted else choices.material


def parts(choices: Choices, name: str) -> dict[str, dict[str, Any]]:
    """The scenes of a computation by the names of their files without ends: with heat, and without it where that was chosen."""
    cold = {f"{name}-without-heat": scene(choices, name, heated=False)} if "heat" in choices.tables and choices.cold_too else {}
    return {name: scene(choices, name)} | cold


def with_band(choices: Choices, part: Mapping[str, Any]) -> bool:
    """Whether a scene of a computation is solved with the band of its material."""
    return choices.band and not {"heat", "strain"} & part.keys()


def scene_text(table: Mapping[str, Any]) -> str:
    """The scene file of a scene."""
    return _native.toml_text(dict(table))


def command(choices: Choices, name: str) -> str:
    """The commands of the program that compute the same in the folder, or go on with what is there."""
    # A list has two values and more.
    several = {key: ",".join(map(repr, values)) for key, values in vary(choices).items()}
    varied = [f"--vary {key}={values if ',' in values else f'{values}:{values}:1'}" for key, values in several.items()]
    measured, lines = ["--measured", shlex.quote(choices.measured)] if choices.measured else [], []
    for part, table in parts(choices, name).items():
        band = ["--sensitivity"] * with_band(choices, table)
        lines += [" ".join([f"viscofriction sweep {part}.toml", *varied, *band, *measured, f"--resume --out {part}.csv"])]
    if choices.is_fitted:
        given = [f"--{option.replace('_', '-')} {value}" for option, value in choices.of_fit.items()]
        words = ["viscofriction fit-material", shlex.quote(choices.material), *given, f"--out {name}-fit"]
        lines.insert(0, f"# {name}-material.toml is the material.toml of: {' '.join(words)}")
    return "\n".join(lines) + "\n"


def python(choices: Choices, name: str) -> str:
    """A program in Python that computes the same in the folder."""
    lines = ["import viscofriction as vf", ""]
    if choices.is_fitted:
        given = "".join(f", {option}={value!r}" for option, value in choices.of_fit.items())
        lines = ["from pathlib import Path", "", *lines, f"fit = vf.fit_material({choices.material!r}{given})"]
        lines += [f"Path({material_file(choices, name)!r}).write_text(fit.material.to_toml(), encoding='utf-8')", ""]
    lines += [f"vary = {pformat(vary(choices), sort_dicts=False)}"]
    for part, table in parts(choices, name).items():
        lines += ["", f"scene = {pformat(table, sort_dicts=False)}"]
        sweep = f"sweep = vf.sweep(scene, vary, sensitivity={with_band(choices, table)}, out={part + '.csv'!r}, resume=True)"
        lines += [sweep, f"sweep.plot().figure.savefig({part + '.png'!r})"]
    return "\n".join(lines) + "\n"


def digests(choices: Choices, folder: Path) -> dict[str, str]:
    """The files of the choices that a computation reads, with what tells other contents of the same name."""
    named = [choices.material, *(keys.get("file", "") for keys in map(choices.keys, choices.tables))]
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in named if name and (folder / name).is_file()}


def named(folder: Path) -> Iterator[str]:
    """The names of the computations in a folder, the newest first."""
    numbers = [path.stem.removeprefix("friction-") for path in folder.glob("friction-*.json")]
    yield from (f"friction-{number}" for number in sorted((int(one) for one in numbers if one.isdecimal()), reverse=True))


def name_for(choices: Choices, folder: Path) -> str:
    """The name of the computation in the folder with these choices and files, or the next one."""
    known = list(named(folder))
    wanted = stored(choices, folder)
    same = [name for name in known if (folder / f"{name}.json").read_text("utf-8") == wanted]
    taken = max((int(name.removeprefix("friction-")) for name in known), default=0)
    while not same and any(folder.glob(f"friction-{taken + 1}[.-]*")):
        taken += 1
    return same[0] if same else f"friction-{taken + 1}"


def stored(choices: Choices, folder: Path) -> str:
    """What the folder keeps of a computation to know it again."""
    kept = asdict(replace(choices, measured="", unit="mm")) | {"files": digests(choices, folder), "version": vf.__version__}
    return json.dumps(kept, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def at_point(folder: Path, part: str, sweep: Sweep, row: int) -> dict[str, Any]:
    """The scene of one point of a sweep, with its files where they are."""
    table = tomllib.loads((folder / f"{part}.toml").read_text("utf-8"))
    files = [keys for family in (*FAMILIES, "material") for keys in table.get(family, {}).values() if isinstance(keys, dict)]
    for keys, name in product(files, ("file", "path")):
        if name in keys:
            keys[name] = str(folder.absolute() / keys[name])
    points = {key: float(sweep[key][row]) for key in sweep.keys}
    table["load"]["velocity"] = points.pop("load.velocity")
    table["material"]["file"] |= {"temperature": temperature for temperature in points.values()}
    return table


def _positive(name: str, value: float | None) -> float:
    if value is None or not np.isfinite(value) or value <= 0:
        raise ValueError(f"{name} must be finite and greater than 0, but is {_shown(value)}")
    return float(value)


def _shown(value: float | None) -> str:
    return "missing" if value is None else f"{value:g}"
