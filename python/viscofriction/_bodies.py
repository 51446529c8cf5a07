"""Bodies of arrays, and the pyramid."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Compared, numbers
from ._kinds import Cone, Edges, HeightMapFile, HeightsAre, LengthUnit
from ._tables import Body

__all__ = ["HeightMap", "Pyramid", "Roughness", "plausible_height_map", "plausible_unit", "read_height_map"]


@dataclass(frozen=True, eq=False)
class Roughness(Compared):
    """What a rough surface is like; heights count from their mean towards the elastomer."""

    #: Root mean square Sq, and mean Sa, of the heights [m]; their skewness Ssk and kurtosis Sku.
    rms_height: float
    mean_deviation: float
    skewness: float
    kurtosis: float
    #: Height of the highest peak Sp and depth of the deepest pit Sv [m].
    peak: float
    pit: float
    #: Root mean squares of the slopes along x and y; of the gradient, Sdq; and of the mean curvature [1/m].
    rms_slopes: tuple[float, float]
    rms_gradient: float
    rms_curvature: float
    #: Nayak's parameter α of an isotropic surface with these moments.
    nayak: float
    #: Rings of wave vectors, ``spectrum[:, 0]`` their mean wave number q [1/m] and ``[:, 1]`` the spectrum C [m⁴], with
    #: ⟨z²⟩ = 2π ∫ q C dq.
    spectrum: NDArray[np.float64]
    #: Along x and y the wave number [1/m] and the mean spectrum [m³] of all profiles.
    profile_spectra: tuple[NDArray[np.float64], NDArray[np.float64]]
    #: What is strange about the heights, such as another unit than theirs.
    warnings: list[str]


@dataclass(frozen=True)
class Pyramid(Body):
    """A four-sided pyramid whose faces have a slope > 0, for ``indent`` and ``fit_indentation``.

    They take the cone with the same elastic force (Bilodeau 1992), exact on the way in; the contact of a pyramid is no disc, so
    that the way back is an approximation. A tip of faces at an angle θ to the axis has the slope 1/tan θ.
    """

    slope: float
    _kind = "pyramid"

    def __post_init__(self) -> None:
        Cone(self.slope)

    @property
    def cone(self) -> Cone:
        """The cone with the same elastic force."""
        return Cone(2 / math.pi / 0.7453 * self.slope)

    def _table(self) -> dict[str, Any]:
        raise ValueError(
            "a Pyramid is a body of indent and fit_indentation only: its .cone has the same elastic force, and another "
            "contact and friction"
        )


class HeightMap(Compared, Body):
    """A surface from heights on a grid, ``heights[i, j]`` at x = j dx and y = i dy, bilinear between them.

    Heights [m] point out of the rigid body, so that the largest touch first; a row runs along x, the direction in which the
    body moves over the elastomer. ``heights_are="gap"`` says that they point into the body and the smallest touch first, and
    ``direction`` (0, 90, 180 or 270 degrees from x towards y) that it moves another way; results have x along the motion.
    ``unit`` is that of the heights ("m", "mm", "um", "nm"), and ``spacing`` (dx, dy) [m], or one number for both.

    NaN and masked entries are heights that are missing: they are refused, or become with ``fill_missing`` the mean of their
    known neighbours from the edges of holes inwards. ``level`` takes the plane of least squares out.

    With ``edges="wall"`` the body ends at the edge of the grid. With ``"periodic"`` it repeats itself, as the sum of waves
    through its heights that are not shorter than ``shortest_wavelength`` [m], and takes a mean pressure; with ``"mirrored"`` its
    mirror images about its last row and column too, so that heights do not jump where a measured patch does not fit to itself.
    Any layout, and float32, will do.
    """

    _kind = "height-map"

    def __init__(
        self,
        heights: ArrayLike,
        spacing: float | tuple[float, float],
        *,
        unit: LengthUnit = "m",
        heights_are: HeightsAre = "surface",
        direction: float = 0,
        fill_missing: bool = False,
        level: bool = False,
        edges: Edges = "wall",
        shortest_wavelength: float | None = None,
    ) -> None:
        # A copy, so that a body stays what it was made of.
        self.heights: NDArray[np.float64] = numbers("heights", heights, dimensions=2, holes=True).copy("K")
        self.heights.flags.writeable = False
        pair = spacing if isinstance(spacing, Sequence) else (spacing, spacing)
        steps = numbers("spacing", pair, dimensions=1)
        if steps.shape != (2,) or not (steps > 0).all():
            raise ValueError(f"spacing must be one or two numbers greater than 0, but is {spacing}")
        self.spacing: tuple[float, float] = (float(steps[0]), float(steps[1]))
        self.unit: LengthUnit = unit
        self.heights_are: HeightsAre = heights_are
        self.direction = direction
        self.fill_missing = fill_missing
        self.level = level
        self.edges: Edges = edges
        #: Of a periodic surface the length [m] of the shortest waves; None for all that the grid knows.
        self.shortest_wavelength = shortest_wavelength
        #: Of heights that were read from a file what is to be known of its units and holes, and what the reader assumed.
        self.notes: tuple[str, ...] = ()
        _native.check_height_map(self.heights, self._table()[self._kind])

    @classmethod
    def from_topography(cls, topography: Any, **options: Any) -> HeightMap:
        """The surface of a topography of the package SurfaceTopography; options as of a ``HeightMap``.

        One that states no unit, such as of a text, needs ``unit``, of its heights and of x and y.
        """
        unit = options.get("unit")
        if topography.unit is None and unit is None:
            raise ValueError('the topography states no unit: give unit="m", "mm", "um" or "nm", that of its x, y and heights')
        if topography.unit is not None and unit is not None:
            raise ValueError(f"the topography states its unit, {topography.unit}: leave out unit")
        scaled = topography if topography.unit is None else topography.to_unit("m")
        metres = {None: 1.0, "m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}.get(unit, 1.0)
        dx, dy = (metres * float(step) for step in scaled.pixel_size)
        # Its first index is along x.
        return cls(scaled.heights().T, (dx, dy), **options)

    def __hash__(self) -> int:
        return hash((self.heights.shape, self.spacing, self.edges, self.shortest_wavelength))

    def __repr__(self) -> str:
        rows, columns = self.heights.shape
        return f"HeightMap({columns} × {rows} heights, spacing={self.spacing}, edges={self.edges!r})"

    @property
    def roughness(self) -> Roughness:
        """What the surface is like: parameters of ISO 25178-2, and power spectra; x is along the motion.

        They are exact for the heights: of a surface that repeats itself those of its waves; of one that ends, slopes and
        curvatures are differences of neighbouring heights, and spectra those under a Hann window.
        """
        return Roughness(**_native.surface_numbers(self.heights, self._table()[self._kind]))

    def plot(self, ax: Any = None) -> Any:
        """Draws the heights about their mean; returns the axes of matplotlib."""
        from . import _plotting

        return _plotting.heights(self, _plotting.axes(ax))

    def _table(self) -> dict[str, Any]:
        names = "spacing unit heights_are direction fill_missing level edges shortest_wavelength"
        keys = {name: getattr(self, name) for name in names.split()}
        # The heights take the place of the file.
        return {self._kind: keys | {"file": "heights"}}


def read_height_map(file: HeightMapFile | str | os.PathLike[str]) -> HeightMap:
    """The surface in a file of heights, ``read_height_map(HeightMapFile("scan.xyz", unit="um"))``, as a scene with these keys has it.

    Its heights are in metres and out of the body, with x along the motion, filled and levelled where that was asked for; ``notes`` say
    what the reader assumed, such as units. Raises ValueError with the line of the file, or the key that does not fit it.
    """
    keys = file if isinstance(file, HeightMapFile) else HeightMapFile(file)
    heights, spacing, notes = _native.read_heights(keys._table()[keys._kind])
    surface = HeightMap(heights, spacing, edges=keys.edges, shortest_wavelength=keys.shortest_wavelength)
    surface.notes = tuple(notes)
    return surface


#: Smallest root mean square slope of a surface whose unit is guessed. Chosen: that of polished glass.
SMALLEST_GRADIENT = 1e-3


def plausible_height_map(file: HeightMapFile) -> tuple[HeightMap, LengthUnit | None]:
    """The surface in a file of heights, with its unit: ``file.unit``, or a guess where neither that nor the file states one. The guess is the first
    of m, µm, nm and mm with slopes as surfaces in contact have them, and None for metres, for a file that states its unit, and where no unit
    helps. A surface that is plausible in metres is read once. Raises ValueError for another file."""
    if file.unit is not None:
        return read_height_map(file), file.unit
    guesses: tuple[LengthUnit | None, ...] = (None, "um", "nm", "mm")
    flat: LengthUnit | None = None
    for unit in guesses:
        surface = read_height_map(replace(file, unit=unit))
        if any("unit" in note for note in surface.notes):
            continue
        # What is flatter than polished glass has probably another unit.
        if unit is None or surface.roughness.rms_gradient >= SMALLEST_GRADIENT:
            return surface, unit
        flat = flat or unit
    return read_height_map(replace(file, unit=flat)), flat


def plausible_unit(file: HeightMapFile) -> LengthUnit | None:
    """The unit of ``plausible_height_map``; None for a file whose ``unit`` is right."""
    return plausible_height_map(replace(file, unit=None))[1]
