"""The bodies, interfaces and effects that a scene may have, and the keys of each, as data: for forms, menus and completion."""

from __future__ import annotations

import math
import re
import types
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, fields
from decimal import Decimal
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from . import _kinds, _native
from ._tables import Table

__all__ = ["Key", "Kind", "kinds"]

#: What a key takes: a number, a whole number, two numbers, True or False, a word, the name of a file, or a word or a share.
Entry = Literal["number", "count", "pair", "switch", "word", "file", "share"]
Family = Literal["indenter", "interface", "heat", "strain"]

#: What is typed where a number is wanted: a number, a text that is none, or nothing.
Typed = float | str | None

# Kinds with a list of tables.
_WITH_LISTS = {"Superposition"}


@dataclass(frozen=True)
class Key:
    """A key of a kind.

    ``name``, ``entry``: Its name in a scene, and what it takes.
    ``meaning``: What it is, with its range and its unit.
    ``unit``: The unit; empty for what has none.
    ``is_required``, ``default``: Whether it must be given, and its value where it is not.
    ``words``: The words that it takes, with what they mean.
    """

    name: str
    entry: Entry
    meaning: str
    unit: str
    is_required: bool
    default: Any
    words: Mapping[str, str]


@dataclass(frozen=True)
class Kind:
    """A kind of body, interface, heat or strain dependence: its name in a scene, what it is, and its keys, the required ones first."""

    name: str
    meaning: str
    keys: tuple[Key, ...]


@cache
def kinds(family: Family) -> dict[str, Kind]:
    """The kinds of "indenter", "interface", "heat" or "strain" by their names in a scene, without those with lists of tables; heat has
    one without a name."""
    classes = (getattr(_kinds, name) for name in _kinds.__all__ if name not in _WITH_LISTS)
    return {one._kind: _kind(one) for one in classes if one._family == family}


def _kind(of: type[Table]) -> Kind:
    head, *documented = re.split(r"^\s*``(?=\w+``:)", of.__doc__ or "", flags=re.MULTILINE)
    meanings = dict(text.split("``: ", 1) for text in documented)
    hints = get_type_hints(of)
    keys = []
    for field in fields(of):  # type: ignore[arg-type]
        meaning, *words = re.split(r'^\s*``"(?=[\w/-]+"``:)', meanings[field.name], flags=re.MULTILINE)
        known = dict(word.split('"``: ', 1) for word in words)
        entry, allowed = _entry(field.name, hints[field.name])
        is_required = field.default is MISSING
        default = None if is_required else field.default
        labels = {word: known.get(word, word).split("``{")[0].strip().rstrip(".") for word in allowed}
        meaning = " ".join(meaning.split())
        unit = re.search(r"\[([^\]]+)\]", meaning) if entry in ("number", "pair") else None
        keys.append(Key(field.name, entry, meaning, unit[1] if unit else "", is_required, default, labels))
    # What must be given stands before what may be.
    return Kind(of._kind, head.strip(), tuple(sorted(keys, key=lambda key: not key.is_required)))


def _entry(name: str, hint: Any) -> tuple[Entry, tuple[str, ...]]:
    """What a key of this type takes, and the words that it takes."""
    options = [one for one in get_args(hint) if one is not types.NoneType] if get_origin(hint) in (Union, types.UnionType) else [hint]
    words = next((get_args(one) for one in options if get_origin(one) is Literal), ())
    if any(get_origin(one) is Mapping for one in options):
        return "share", words
    if words:
        return "word", words
    plain: dict[Any, Entry] = {float: "number", int: "count", bool: "switch"}
    if options[0] in plain:
        return plain[options[0]], ()
    return ("pair" if get_origin(options[0]) is tuple else "file"), ()


def number(text: str | None) -> Typed:
    """The number of a text, also with a decimal comma; None for an empty text; and the text where it is no number, or may be two: 1,500."""
    words = (text or "").strip()
    try:
        return float(words if re.fullmatch(r"[-+]?[1-9]\d{0,2},\d{3}", words) else words.replace(",", ".")) if words else None
    except ValueError:
        return words


def shown(value: Typed) -> str:
    """What is typed: of a number all its digits and no others."""
    return "" if value is None else value if isinstance(value, str) else repr(value).removesuffix(".0")


def shifted(value: Typed, power: int) -> Typed:
    """A number times a power of ten with the same digits, which a product in floating point may change; a text stays as it is."""
    return value if value is None or isinstance(value, str) else float(Decimal(repr(value)).scaleb(power))


def problem(family: Family, kind: str, typed: Mapping[str, Any], only: str = "") -> str | None:
    """Why the keys of a kind are refused, in a sentence that begins with the key and has the allowed range, or None; numbers may be texts and
    missing. With ``only`` those of other keys are not looked at."""
    entered: dict[str, Typed] = {}
    table: dict[str, Any] = {}
    for key in kinds(family)[kind].keys:
        path, value = ".".join(filter(None, (family, kind, key.name))), typed.get(key.name)
        if key.entry == "pair" and (value or key.is_required):
            value = [_checkable(entered, f"{path}[{nth}]", one, only) for nth, one in enumerate(value or (None, None))]
        elif key.entry in ("number", "count") and (value is not None or key.is_required):
            value = _checkable(entered, path, value, only)
        elif key.is_required and not value and only in ("", path):
            return f"{path} is needed: {key.meaning}"
        table |= {} if value is None else {key.name: value}
    return _refused(lambda: _native.check_table({family: {kind: table} if kind else table}), entered, only)


def problem_of_load(typed: Mapping[str, Typed], only: str = "") -> str | None:
    """The same of "load.normal_force", "load.mean_pressure", "layer.thickness" and "solve.relative_error", by these paths."""
    entered: dict[str, Typed] = {}
    # Without a thickness there is no layer.
    wanted = {path: value for path, value in typed.items() if value is not None or path != "layer.thickness"}
    given = {path: _checkable(entered, path, value, only) for path, value in wanted.items()}
    # They are checked with the scene of a ball; a mean pressure has the range of a force.
    scene: dict[str, Any] = {"indenter": {"sphere": {"radius": 1.0}}, "material": {"elastic": {"shear_modulus": 1.0}}}
    scene |= {"load": {"normal_force": 1.0, "velocity": 1.0}, "layer": {"thickness": 1.0}, "solve": {}}
    pressure = "load.mean_pressure"
    for path, value in given.items():
        table, key = path.replace(pressure, "load.normal_force").split(".")
        scene[table][key] = value
    plan = {"scene": scene, "folder": "", "vary": [], "sensitivity": False, "samples": None}
    names = {"load.normal_force": pressure} if pressure in typed else {}
    return _refused(lambda: _native.sweep_plan(plan), entered, only, names)


def _checkable(entered: dict[str, Typed], path: str, value: Typed, only: str) -> float:
    """The number of a key, in the place of another entry one that is refused, or that is accepted where the key is not looked at."""
    entered[path] = value
    if isinstance(value, int | float):
        return value
    return math.nan if only in ("", path) else 1.0


def _refused(check: Callable[[], object], entered: Mapping[str, Typed], only: str, names: Mapping[str, str] = {}) -> str | None:
    """The sentence of the package, with what was entered in the place of what is no number."""
    try:
        check()
    except ValueError as error:
        text = re.sub(r": invalid type: .*, expected (.*?)(;.*)?$", r" must be \1, but is not a number", str(error).split(" (point 1: ")[0])
        path = re.split(r" |: ", text)[0]
        named = names.get(path, path)
        text = named + text[len(path) :].replace("not a number", shown(entered.get(named)) or "missing")
        return text if named == only or not only else None
    return None
