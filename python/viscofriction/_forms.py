"""The bodies, interfaces and effects that a scene may have, and the keys of each, as data: for forms, menus and completion."""

from __future__ import annotations

import re
import types
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from . import _kinds
from ._tables import Table

__all__ = ["Key", "Kind", "kinds"]

#: What a key takes: a number, a whole number, two numbers, True or False, a word, the name of a file, or a word or a share.
Entry = Literal["number", "count", "pair", "switch", "word", "file", "share"]
Family = Literal["indenter", "interface", "heat", "strain"]

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
