"""Pressing, sliding, and scenes as the program knows them."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from numpy.typing import ArrayLike

from . import _native
from ._arrays import columns as checked_columns
from ._arrays import numbers, text_of, together
from ._bodies import HeightMap
from ._kinds import Elastic, Method, Model, StrokeShape
from ._results import Answer, MovingAnswer, SlidingAnswer, not_reached
from ._tables import Body, Heated, Interface, Material, StrainDependence, Table

__all__ = ["move", "press", "slide", "solve"]

#: Called with how many scenes are done and how many there are; True shows a bar of tqdm.
Progress = Callable[[int, int], object] | bool | None
# Largest scene file, [bytes]: 16 MiB, as in the command-line program. Scenes are written by hand; large data are in files that they
# name.
MAX_SCENE_SIZE = 1 << 24
Scene = str | os.PathLike[str] | Mapping[str, Any]
Kind = TypeVar("Kind", bound=Answer)


def slide(
    body: Body,
    material: Material,
    *,
    velocity: ArrayLike,
    normal_force: ArrayLike | None = None,
    indentation_depth: ArrayLike | None = None,
    mean_pressure: ArrayLike | None = None,
    sliding_distance: ArrayLike | None = None,
    track: ArrayLike | None = None,
    thickness: ArrayLike | None = None,
    interface: Interface | None = None,
    heat: Heated | None = None,
    strain: StrainDependence | None = None,
    model: Model | None = None,
    method: Method | None = None,
    relative_error: float | None = None,
    elements: int | None = None,
    threads: int | None = None,
    sensitivity: bool = False,
    spectral_sensitivity: bool = False,
    progress: Progress = None,
) -> SlidingAnswer:
    """Friction of a body that slides over a half space of the material, or a layer of it bonded to a rigid base.

    Speed > 0 [m/s], and either normal force [N] or depth [m], or of a periodic surface mean pressure [Pa], are numbers or arrays
    that fit together; so are a sliding distance [m] from first touch, without which the state is stationary, and the thickness [m]
    of a layer. ``model="line"`` asks for the one-dimensional model, ``method`` for one of the program's methods. A ``track`` [m] is
    the length after which the body comes back to the same place. With an ``interface`` the friction is the sum of hysteresis and
    shear in the contact; with ``heat`` the temperature of the contact is computed, and material and shear strength are those at
    this temperature, by the material's ``shift`` law; with ``strain`` the moduli are those at the strain of the contact.
    ``relative_error`` is asked of the friction coefficient, 1e-3 unless given, with ``strain`` 1e-2; ``elements`` is a fixed resolution
    in its place. With ``sensitivity`` the answer has its derivatives by all numbers of the scene, too, and with ``spectral_sensitivity``
    those by the storage and the loss modulus at each frequency, unless it has ``heat`` or ``strain``; a ``HeightMap`` has no such
    numbers. ``progress`` is called with how many loads are done and how many there
    are; True shows a bar of tqdm.

    Raises ValueError for wrong input and NotReached where there is no answer.
    """
    loads = given(
        velocity=velocity,
        normal_force=normal_force,
        indentation_depth=indentation_depth,
        mean_pressure=mean_pressure,
        sliding_distance=sliding_distance,
        track=track,
        thickness=thickness,
    )
    if not (numbers("velocity", velocity) > 0).all():
        raise ValueError(f"velocity must be greater than 0, but is {text_of(velocity)}")
    options = given(
        model=model, method=method, relative_error=relative_error, elements=elements, threads=threads
    )
    derivatives = {"sensitivity": sensitivity, "spectral_sensitivity": spectral_sensitivity}
    scene = {"indenter": body, "material": material, "load": {"velocity": 0.0}, "solve": options}
    scene |= given(interface=interface, heat=heat, strain=strain)
    return ask(SlidingAnswer, scene, *together(loads), progress, derivatives=derivatives)


def move(
    body: Body,
    material: Material,
    *,
    stroke: ArrayLike | None = None,
    frequency: ArrayLike | None = None,
    shape: StrokeShape | None = None,
    time: ArrayLike | None = None,
    position: ArrayLike | None = None,
    normal_force: ArrayLike | None = None,
    indentation_depth: ArrayLike | None = None,
    mean_pressure: ArrayLike | None = None,
    interface: Interface | None = None,
    model: Model | None = None,
    method: Method | None = None,
    relative_error: float | None = None,
    elements: int | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> MovingAnswer:
    """Friction of a body that moves to and fro, or through positions [m] at times [s] that increase.

    Either a ``stroke`` [m] from end to end and a ``frequency`` [1/s], numbers or arrays that fit together, with ``shape`` "sinusoidal"
    or "triangular": the answer is the cycle in which the motion ends; or ``time`` and ``position``, straight from point to point, from
    an undeformed surface on. Force or depth is held, or the mean pressure [Pa] of a periodic surface, whose forces and energy are those
    of one period. ``.motion`` has the forces over time, ``.mu`` is their mean over the path. With an ``interface`` the forces contain
    the shear in the contact. Otherwise as ``slide``.
    """
    pressed = given(normal_force=normal_force, indentation_depth=indentation_depth, mean_pressure=mean_pressure)
    loads = given(stroke=stroke, frequency=frequency) | pressed
    load: dict[str, Any] = given(shape=shape)
    if time is not None or position is not None:
        times, places = checked_columns(**given(time=time, position=position))
        load["motion"] = [{"time": t, "position": x} for t, x in zip(times.tolist(), places.tolist(), strict=True)]
    options = given(model=model, method=method, relative_error=relative_error, elements=elements, threads=threads)
    scene = {"indenter": body, "material": material, "load": load, "solve": options, "interface": interface}
    return ask(MovingAnswer, scene, *together(loads), progress)


def press(
    body: Body,
    material: Material,
    *,
    normal_force: ArrayLike | None = None,
    indentation_depth: ArrayLike | None = None,
    mean_pressure: ArrayLike | None = None,
    duration: ArrayLike | None = None,
    thickness: ArrayLike | None = None,
    model: Model | None = None,
    method: Method | None = None,
    relative_error: float | None = None,
    elements: int | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Answer:
    """Contact of a body that is pressed into a half space of the material, or a layer of it, without sliding.

    Either normal force [N] or depth [m], or of a periodic surface mean pressure [Pa], is held for a duration [s], which an elastic
    material does not need; ``thickness`` [m] is that of a layer bonded to a rigid base. ``method="bem-transient"`` gives the field
    of pressure of every body; ``relative_error`` is asked of the depth, of the force at a given depth, or of the area of a
    periodic surface. Otherwise as ``slide``.
    """
    if duration is None and isinstance(material, Elastic):
        duration = 1.0
    loads = given(
        normal_force=normal_force,
        indentation_depth=indentation_depth,
        mean_pressure=mean_pressure,
        duration=duration,
        thickness=thickness,
    )
    options = given(
        model=model, method=method, relative_error=relative_error, elements=elements, threads=threads
    )
    scene = {"indenter": body, "material": material, "load": {"velocity": 0.0}, "solve": options}
    return ask(Answer, scene, *together(loads), progress)


def solve(
    scene: Scene, *, sensitivity: bool = False, spectral_sensitivity: bool = False, progress: Progress = None
) -> Answer:
    """The answer to a scene: a scene file, or the same as a dictionary.

    In a dictionary bodies, materials, interfaces, heat and strain dependences may stand in the place of their tables:
    ``{"indenter": Sphere(5e-3), "material": Viscous(1e4), "load": {"normal_force": 1.0, "velocity": 0.01}}``.
    With ``sensitivity`` the answer has its derivatives by all numbers of the scene, too, and with ``spectral_sensitivity`` those
    by the storage and the loss modulus at each frequency.
    """
    derivatives = {"sensitivity": sensitivity, "spectral_sensitivity": spectral_sensitivity}
    return ask(Answer, scene, {}, (), progress, derivatives=derivatives)


def ask(
    kind: type[Kind],
    scene: Scene,
    columns: dict[str, Any],
    shape: tuple[int, ...],
    progress: Progress,
    *,
    history: Any = None,
    fields: bool = False,
    derivatives: dict[str, bool] | None = None,
) -> Kind:
    """The answers of a ``kind`` to a scene with other loads, or another history, and with what takes longer than the answer itself."""
    table, folder, heights = read(scene)
    derivatives = derivatives or {"sensitivity": False, "spectral_sensitivity": False}
    if derivatives["sensitivity"] and heights is not None:
        raise ValueError("sensitivity needs a body of numbers, and not one of heights")
    request = {"scene": table, "folder": folder, "heights": heights, "columns": list(columns.items())}
    with shown(progress) as show:
        found = _native.solve_loads(request | {"history": history, "fields": fields} | derivatives, show)
    answer = kind(found, columns, shape)
    not_reached(answer)
    return answer


def given(**values: Any) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def read(scene: Scene) -> tuple[dict[str, Any], str, Any]:
    """The tables of a scene, the folder of the files that it names, and the heights of a map that it holds."""
    if not isinstance(scene, Mapping):
        if not isinstance(scene, str | os.PathLike):
            raise ValueError(f"scene must be the name of a scene file, or the same as a dictionary, but is {text_of(scene)}")
        path = Path(scene)
        try:
            return tomllib.loads(_scene_text(path)), os.fspath(path.parent), None
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise ValueError(f"{path}: {error}") from None
    table = dict(scene)
    heights = None
    body = table.get("indenter")
    if isinstance(body, HeightMap):
        heights = body.heights
    families: dict[str, tuple[type[Table], str]] = {
        "indenter": (Body, "a Body"),
        "material": (Material, "a Material"),
        "interface": (Interface, "a ConstantShear, BellShear or ShearFile"),
        "heat": (Heated, "a Heat"),
        "strain": (StrainDependence, "a KrausStrain or StrainFile"),
    }
    for key, (kind, needed) in families.items():
        value = table.get(key)
        if key in ("interface", "heat", "strain") and value is None:
            table.pop(key, None)
            continue
        if isinstance(value, kind):
            table[key] = value._table()
        elif not isinstance(value, Mapping):
            held = "; give its .material" if isinstance(getattr(value, "material", None), kind) else ""
            raise ValueError(f"{key} must be {needed} of this package, but is {text_of(value)}{held}")
    return table, "", heights


def _scene_text(path: Path) -> str:
    # A device has no end, and a larger file is something else that was named by mistake.
    if path.exists() and (not path.is_file() or path.stat().st_size > MAX_SCENE_SIZE):
        raise ValueError(f"{path}: a regular file of at most {MAX_SCENE_SIZE} bytes is needed")
    return path.read_text("utf-8")


@contextmanager
def shown(progress: Progress) -> Iterator[Callable[[int, int], object] | None]:
    """What is called with the progress."""
    if progress is not True:
        yield progress or None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ValueError("progress=True needs tqdm; give a function, or install tqdm") from None
    with tqdm() as bar:

        def show(done: int, count: int) -> None:
            bar.total = count
            bar.update(done - bar.n)

        yield show
