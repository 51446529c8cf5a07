"""What was chosen, and the scene, the command and the Python program that say the same: no page and no computation."""

from __future__ import annotations

import hashlib
import json
import math
import re
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

import viscofriction as vf

from .._fitting import Deformation, Fit, Vertical
from .._forms import Family, Typed, number, problem, problem_of_load, shown
from .._sweeping import command_of, program_of

#: Ends of the names of files that hold heights with their positions, and of tables.
MAPS = {".asc", ".gsf", ".npy", ".sdf", ".sur", ".x3p", ".xyz"}
TABLES = {".csv", ".dat", ".tsv", ".txt"}
#: Largest number of temperatures, each of which is a curve of the picture.
LARGEST_COUNT = 6
#: Largest number of speeds.
LARGEST_N_SPEEDS = 1000
#: Heights within the shortest wave that is kept of a map, unless another one is chosen: a first picture in seconds.
HEIGHTS_PER_WAVE = 8
#: Units in which lengths are chosen and shown, with their powers of ten.
LENGTHS = {"mm": -3, "µm": -6, "m": 0}
#: What a key without a value has; of two numbers both are empty then.
NOTHING: tuple[Any, ...] = (None, [None, None])
#: What a scene may have beside its material and its load.
FAMILIES: tuple[Family, ...] = ("indenter", "interface", "heat", "strain")


@dataclass(frozen=True)
class Choices:
    """All that a person has chosen. Files are names in the folder; all numbers are in SI, temperatures in °C. A text that is no number is
    kept as it was typed, until ``check`` refuses it.

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
    reference_temperature: Typed = None
    tables: Mapping[str, Mapping[str, Mapping[str, Any]]] = field(default_factory=dict)
    thickness: Typed = None
    force: Typed = None
    slowest: Typed = 1e-3
    fastest: Typed = 10.0
    n_speeds: Typed = 5.0
    temperatures: tuple[Typed, ...] = ()
    relative_error: Typed = 0.05
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
        return next(({name: value for name, value in keys.items() if value not in NOTHING} for keys in chosen.values()), {})

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
        known["unit"] = known["unit"] if known.get("unit") in LENGTHS else "mm"
        kept = {one.name: known[one.name] for one in fields(cls) if one.name in known}
        return cls(**kept | {"temperatures": tuple(kept.get("temperatures", ()))})


def fit(choices: Choices, folder: Path) -> Fit:
    """The fit of the table of moduli. Raises ValueError with line and column."""
    check(choices, "reference_temperature")
    return vf.fit_material(folder / choices.material, **choices.of_fit)


def guessed_temperatures(found: Fit) -> tuple[float, ...]:
    """Temperatures for a first picture: 0 °C and 20 °C where the shift law holds, or that of the fit."""
    if found.shift is None:
        return ()
    first, last = found.shift["temperature_range"]
    return tuple(one for one in (0.0, 20.0) if first <= one <= last) or (found.shift["temperature"],)


def temperatures(text: str) -> tuple[Typed, ...]:
    """Numbers between blanks or semicolons, and words that are none."""
    return tuple(number(word) for word in text.replace(", ", " ").replace(";", " ").split())


def surface(choices: Choices, folder: Path) -> tuple[vf.HeightMap, Choices]:
    """The chosen height map, and the choices with what was guessed where nothing is chosen: a unit of plausible heights, and the
    shortest wave. Raises ValueError with the line of the file or the key."""
    keys = dict(choices.keys("indenter"))
    if text := problem("indenter", "height-map", keys):
        raise ValueError(text)
    file = vf.HeightMapFile(**keys | {"file": folder / keys["file"]})
    found, unit = vf.plausible_height_map(file)
    keys |= {} if unit is None else {"unit": unit}
    if choices.is_periodic and file.shortest_wavelength is None:
        keys["shortest_wavelength"] = float(f"{HEIGHTS_PER_WAVE * max(found.spacing):.3g}")
    return found, choices.with_table("indenter", "height-map", keys)


def check(choices: Choices, only: str = "") -> None:
    """Raises ValueError for what is missing, no number, or out of the range that the package allows, in a sentence that begins with the key;
    with ``only`` for nothing but this key, while others may be missing."""
    for problem in _problems(choices, only):
        if only in ("", re.split("[ :]", problem)[0]):
            raise ValueError(problem)


def _problems(choices: Choices, only: str) -> Iterator[str]:
    if not choices.material:
        yield "material: a table of moduli is needed"
    if isinstance(choices.reference_temperature, str):
        yield f"reference_temperature must be a number, but is {choices.reference_temperature}"
    if choices.kind("indenter") is None:
        yield "indenter: a body is needed"
    chosen = {family: kind for family in FAMILIES if (kind := choices.kind(family)) is not None}
    yield from filter(None, (problem(family, kind, choices.keys(family), only) for family, kind in chosen.items()))
    if "heat" in chosen and choices.is_periodic and "duration" not in choices.keys("heat"):
        yield "heat.duration is needed: the time for which the surface has been sliding [s], because its mean temperature grows"
    load = {"layer.thickness": choices.thickness, f"load.{choices.force_key}": choices.force, "solve.relative_error": choices.relative_error}
    yield from filter(None, [problem_of_load(load, only)])
    speeds: dict[str, Any] = {"slowest": choices.slowest, "fastest": choices.fastest}
    wrong = {name: speed for name, speed in speeds.items() if not isinstance(speed, int | float) or not 0 < speed < math.inf}
    yield from (f"load.velocity.{name} must be finite and greater than 0, but is {shown(speed) or 'missing'}" for name, speed in wrong.items())
    if choices.n_speeds not in range(1, LARGEST_N_SPEEDS + 1):
        yield f"load.velocity.count must be a whole number from 1 to {LARGEST_N_SPEEDS}, but is {shown(choices.n_speeds) or 'missing'}"
    elif choices.n_speeds != 1 and not wrong and speeds["slowest"] >= speeds["fastest"]:
        name, what, other = ("slowest", "less", "fastest") if only.endswith("slowest") else ("fastest", "greater", "slowest")
        yield f"load.velocity.{name} must be {what} than the {other}, {speeds[other]:g} m/s, but is {speeds[name]:g}"
    hot = choices.temperatures
    if not all(isinstance(one, int | float) and math.isfinite(one) for one in hot):
        yield f"material.file.temperature must be numbers between blanks, such as 0 20.5 39, but is {' '.join(map(shown, hot))}"
    elif len(hot) > LARGEST_COUNT:
        yield f"material.file.temperature: at most {LARGEST_COUNT} temperatures are drawn"
    elif len(set(hot)) < len(hot):
        yield "material.file.temperature: a temperature is given twice"


def _table(choices: Choices, family: str) -> dict[str, Any]:
    kind, keys = choices.kind(family), dict(choices.keys(family))
    return {kind: keys} if kind else keys


def speeds(choices: Choices) -> list[float]:
    """The speeds [m/s], in equal factors, with three digits."""
    count, slowest, fastest = (float(one or 0) for one in (choices.n_speeds, choices.slowest, choices.fastest))
    spaced = np.geomspace(slowest, fastest if count > 1 else slowest, int(count))
    return list(dict.fromkeys(float(f"{speed:.3g}") for speed in spaced))


def vary(choices: Choices) -> dict[str, list[float]]:
    """The keys that vary, as ``vf.sweep`` takes them; the speed varies fastest. Raises ValueError for what is missing or wrong."""
    check(choices)
    hot: Any = choices.temperatures
    return ({"material.file.temperature": list(hot)} if hot else {}) | {"load.velocity": speeds(choices)}


def scene(choices: Choices, name: str, *, heated: bool = True) -> dict[str, Any]:
    """The scene of the computation with this name, for the folder of its files. Raises ValueError for what is missing."""
    check(choices)
    given: dict[str, Any] = {family: _table(choices, family) for family in FAMILIES if family in choices.tables and (heated or family != "heat")}
    given |= {} if choices.thickness is None else {"layer": {"thickness": choices.thickness}}
    material = {"path": material_file(choices, name)} | ({"temperature": choices.temperatures[0]} if choices.temperatures else {})
    load = {choices.force_key: choices.force, "velocity": speeds(choices)[0]}
    return given | {"material": {"file": material}, "load": load, "solve": {"relative_error": choices.relative_error}}


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


def command(choices: Choices, name: str) -> str:
    """The commands of the program that compute the same in the folder, or go on with what is there."""
    lines = []
    for part, table in parts(choices, name).items():
        lines += [command_of(f"{part}.toml", vary(choices), f"{part}.csv", sensitivity=with_band(choices, table), measured=choices.measured)]
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
    for part, table in parts(choices, name).items():
        lines += [program_of(table, vary(choices), f"{part}.csv", sensitivity=with_band(choices, table), picture=f"{part}.png")]
    return "\n".join(lines)


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
