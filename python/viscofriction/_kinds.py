"""Bodies, materials, interfaces, heat and strain dependences with the keys of a scene, in SI. `cargo xtask kinds` writes this file."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from ._tables import Body, Heated, Interface, Material, StrainDependence

__all__ = [
    "Power",
    "Cone",
    "Paraboloid",
    "Sphere",
    "Spheroid",
    "Superposition",
    "FlatPunch",
    "FlatCone",
    "RoundTippedCone",
    "Hyperboloid",
    "TruncatedParaboloid",
    "Cylinder",
    "ProfileFile",
    "HeightMapFile",
    "SelfAffine",
    "Spectrum",
    "Viscous",
    "Elastic",
    "KelvinVoigt",
    "Maxwell",
    "StandardSolid",
    "Springpot",
    "FractionalMaxwell",
    "MaterialFile",
    "ConstantShear",
    "BellShear",
    "ShearFile",
    "Heat",
    "KrausStrain",
    "StrainFile",
]

# Words of a scene.
Edges = Literal["wall", "periodic", "mirrored"]
EnergyUnit = Literal["J/mol", "kJ/mol", "eV"]
HeightsAre = Literal["surface", "gap"]
LengthUnit = Literal["m", "mm", "um", "nm"]
Method = Literal["analytic", "mdr-steady", "mdr-transient", "bem-steady", "bem-transient"]
Model = Literal["line", "half-space"]
StrainAmplitude = Literal["single", "double"]
StrainDeformation = Literal["tension", "shear"]
StrokeShape = Literal["sinusoidal", "triangular"]


@dataclass(frozen=True)
class Power(Body):
    """h = coefficient r^exponent.

    ``coefficient``: Coefficient c > 0, [m^(1 − p)].
    ``exponent``: Exponent p > 0.
    """

    coefficient: float
    exponent: float
    _kind = "power"


@dataclass(frozen=True)
class Cone(Body):
    """h = slope r.

    ``slope``: Slope of the flank, > 0.
    """

    slope: float
    _kind = "cone"


@dataclass(frozen=True)
class Paraboloid(Body):
    """h = curvature r².

    ``curvature``: Coefficient of r², > 0, [1/m]; half the inverse of the radius of curvature.
    """

    curvature: float
    _kind = "paraboloid"


@dataclass(frozen=True)
class Sphere(Body):
    """The exact sphere.

    ``radius``: Radius > 0, [m].
    """

    radius: float
    _kind = "sphere"


@dataclass(frozen=True)
class Spheroid(Body):
    """Half a spheroid: h = height (1 − √(1 − r²/radius²)).

    ``radius``: Semi-axis across > 0, [m].
    ``height``: Semi-axis along z > 0, [m].
    """

    radius: float
    height: float
    _kind = "spheroid"


@dataclass(frozen=True)
class Superposition(Body):
    """A sum of powers.

    ``terms``: The terms; that of the lowest exponent has a positive coefficient. If that of the highest has a negative one, the body ends at
    its outermost crest.
    Each is a pair of coefficient and exponent.
    """

    terms: Sequence[tuple[float, float]]
    _kind = "superposition"
    _lists = {"terms": ("coefficient", "exponent")}


@dataclass(frozen=True)
class FlatPunch(Body):
    """A flat end with a vertical wall.

    ``radius``: Radius > 0, [m].
    """

    radius: float
    _kind = "flat-punch"


@dataclass(frozen=True)
class FlatCone(Body):
    """A cone whose tip is cut off.

    ``radius``: Radius of the flat end > 0, [m].
    ``slope``: Slope of the flank, > 0.
    """

    radius: float
    slope: float
    _kind = "flat-cone"


@dataclass(frozen=True)
class RoundTippedCone(Body):
    """A cone whose tip is part of a sphere.

    ``radius``: Radius of the tip > 0, [m].
    ``slope``: Slope of the flank, > 0.
    """

    radius: float
    slope: float
    _kind = "round-tipped-cone"


@dataclass(frozen=True)
class Hyperboloid(Body):
    """A hyperboloid of revolution: round at the tip, a cone far from it.

    ``radius``: Radius of the tip > 0, [m].
    ``slope``: Slope of the flank, > 0.
    """

    radius: float
    slope: float
    _kind = "hyperboloid"


@dataclass(frozen=True)
class TruncatedParaboloid(Body):
    """A paraboloid whose tip is cut off.

    ``radius``: Radius of the flat end > 0, [m].
    ``curvature``: Coefficient of r², > 0, [1/m].
    """

    radius: float
    curvature: float
    _kind = "truncated-paraboloid"


@dataclass(frozen=True)
class Cylinder(Body):
    """The parabola of a cylinder, infinite along y; loads and areas are per length.

    ``radius``: Radius > 0, [m].
    """

    radius: float
    _kind = "cylinder"


@dataclass(frozen=True)
class ProfileFile(Body):
    """A body of revolution from a table of radii and heights, linear between its rows.

    ``file``: CSV file with the columns radius_m and height_m, in the folder of the scene; both begin with 0, radii increase.
    """

    file: str | os.PathLike[str]
    _kind = "table"


@dataclass(frozen=True)
class HeightMapFile(Body):
    """A surface from a grid of heights: bilinear between them, or periodic, the sum of waves through them.

    ``file``: File in the folder of the scene: a text of one line of heights for each y, without names; with the extension npy an array of
    NumPy of the shape (n_y, n_x), float64 or float32; with the extensions asc, gsf, sdf, sur, x3p and xyz a measured surface.
    ``direction``: Direction in which the body moves, degrees from x towards y, 0, 90, 180 or 270. Results have x along the motion.
    ``edges``: What is beyond the grid.
    ``"wall"``: The body ends with a wall.
    ``"periodic"``: The grid repeats itself without limit; it takes load.mean_pressure.
    ``"mirrored"``: The grid and its mirror images repeat themselves: no height jumps at an edge. The periods are twice as long.
    ``fill_missing``: True to fill heights that were not measured with the mean of their known neighbours, from the edges of holes inwards.
    ``heights_are``: What the heights are.
    ``"surface"``: Heights of the surface, out of the rigid body: the largest touch first.
    ``"gap"``: The gap between the surface and a plane that it touches, into the body: the smallest touch first.
    ``lateral_unit``: Unit of x and y in files that have positions and do not state it (xyz, asc, gsf); without it metres, or in xyz `unit`.
    ``"m"``: Metre.
    ``"mm"``: Millimetre.
    ``"um"``: Micrometre.
    ``"nm"``: Nanometre.
    ``level``: True to subtract the least-squares plane, after `fill_missing`.
    ``shortest_wavelength``: Wavelength > 0 below which waves are left out of a periodic surface, [m]; without it all waves of the grid are kept.
    ``spacing``: Distances of neighbouring heights along x and y, > 0, [m]; not of a measured surface, which has its own, nor of a text
    that states its size.
    ``unit``: Unit of the heights; files that state it (gsf, sdf, sur, x3p, heads of texts) keep their own; without it metres.
    ``"m"``: Metre.
    ``"mm"``: Millimetre.
    ``"um"``: Micrometre.
    ``"nm"``: Nanometre.
    """

    file: str | os.PathLike[str]
    _: KW_ONLY
    direction: float = 0.0
    edges: Literal["wall", "periodic", "mirrored"] = "wall"
    fill_missing: bool = False
    heights_are: Literal["surface", "gap"] = "surface"
    lateral_unit: Literal["m", "mm", "um", "nm"] | None = None
    level: bool = False
    shortest_wavelength: float | None = None
    spacing: tuple[float, float] | None = None
    unit: Literal["m", "mm", "um", "nm"] | None = None
    _kind = "height-map"


@dataclass(frozen=True)
class SelfAffine(Body):
    """A random self-affine surface that is periodic along x and y; it takes load.mean_pressure.

    ``period``: Periods along x and y, > 0, [m].
    ``hurst_exponent``: Hurst exponent, between 0 and 1.
    ``rms_slope``: Root mean square of the slope, > 0.
    ``longest_wavelength``: Longest wavelength > 0, [m].
    ``shortest_wavelength``: Shortest wavelength > 0, [m].
    ``seed``: Another seed draws another surface.
    ``realisations``: Number of surfaces, with this seed and the next ones, from 1 to 1000: the answer is their mean; without it 1, or with
    `standard_error` at most 1000.
    ``roll_off_wavelength``: Wavelength > 0 above which the spectrum is constant, [m]; without it no roll-off.
    ``standard_error``: Relative standard error of the mean at which no more surfaces are drawn, between 0 and 1; `realisations` is then their largest
    number.
    """

    period: tuple[float, float]
    hurst_exponent: float
    rms_slope: float
    longest_wavelength: float
    shortest_wavelength: float
    seed: int
    _: KW_ONLY
    realisations: int | None = None
    roll_off_wavelength: float | None = None
    standard_error: float | None = None
    _kind = "self-affine"


@dataclass(frozen=True)
class Spectrum(Body):
    """A random surface of a power spectrum, which is periodic along x and y; it takes load.mean_pressure.

    ``file``: CSV file with the columns wave_number q = 2π/λ, [1/m], and density C, [m⁴], in the folder of the scene; wave numbers increase,
    and ln C is linear in ln q between the rows. The spectrum.csv of `viscofriction surface` is one.
    ``period``: Periods along x and y, > 0, [m].
    ``seed``: Another seed draws another surface.
    ``convention``: What the densities are.
    ``"persson"``: ⟨h²⟩ = 2π ∫ q C dq (Persson 2001).
    ``"surface-topography"``: ⟨h²⟩ = ∫ q C dq/(2π), 4π² times as much (``SurfaceTopography``, Jacobs, Junge & Pastewka 2017).
    ``realisations``: Number of surfaces, with this seed and the next ones, from 1 to 1000: the answer is their mean; without it 1, or with
    `standard_error` at most 1000.
    ``shortest_wavelength``: Wavelength > 0 below which waves are left out, [m]; without it all waves of the table are kept.
    ``standard_error``: Relative standard error of the mean at which no more surfaces are drawn, between 0 and 1; `realisations` is then their largest
    number.
    """

    file: str | os.PathLike[str]
    period: tuple[float, float]
    seed: int
    _: KW_ONLY
    convention: Literal["persson", "surface-topography"] = "persson"
    realisations: int | None = None
    shortest_wavelength: float | None = None
    standard_error: float | None = None
    _kind = "spectrum"


@dataclass(frozen=True)
class Viscous(Material):
    """A dashpot.

    ``viscosity``: Shear viscosity η > 0, [Pa s].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "viscous"


@dataclass(frozen=True)
class Elastic(Material):
    """A spring.

    ``shear_modulus``: Shear modulus G > 0, [Pa].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    shear_modulus: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "elastic"


@dataclass(frozen=True)
class KelvinVoigt(Material):
    """Spring and dashpot in parallel.

    ``shear_modulus``: Shear modulus G > 0, [Pa].
    ``viscosity``: Shear viscosity η > 0, [Pa s].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    shear_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "kelvin-voigt"


@dataclass(frozen=True)
class Maxwell(Material):
    """Spring and dashpot in series.

    ``shear_modulus``: Shear modulus G > 0, [Pa].
    ``viscosity``: Shear viscosity η > 0, [Pa s].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    shear_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "maxwell"


@dataclass(frozen=True)
class StandardSolid(Material):
    """A spring in parallel with a Maxwell element.

    ``equilibrium_modulus``: Shear modulus of the spring > 0, [Pa].
    ``maxwell_modulus``: Shear modulus of the Maxwell element > 0, [Pa].
    ``viscosity``: Viscosity of the Maxwell element > 0, [Pa s].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    equilibrium_modulus: float
    maxwell_modulus: float
    viscosity: float
    _: KW_ONLY
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "standard-solid"


@dataclass(frozen=True)
class Springpot(Material):
    """Between spring and dashpot: G* = K (iω)^a.

    ``coefficient``: Coefficient K > 0, [Pa s^a].
    ``exponent``: Exponent a, from 0.01 to 0.99: almost a spring, and almost a dashpot.
    ``time_range``: Shortest and longest time > 0 for which the material is needed, [s]: the time of a contact length and those of a
    history are within it.
    ``equilibrium_modulus``: Shear modulus ≥ 0 of a spring in parallel, [Pa].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    coefficient: float
    exponent: float
    time_range: tuple[float, float]
    _: KW_ONLY
    equilibrium_modulus: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "springpot"


@dataclass(frozen=True)
class FractionalMaxwell(Material):
    """Spring and springpot in series: G* = G z/(1 + z), z = (iωτ)^a.

    ``shear_modulus``: Shear modulus G > 0 of the spring in series, [Pa].
    ``relaxation_time``: Relaxation time τ > 0, at which spring and springpot have the same modulus |G*|, [s].
    ``exponent``: Exponent a, from 0.01 to 0.99.
    ``time_range``: Shortest and longest time > 0 for which the material is needed, [s], as of a springpot.
    ``equilibrium_modulus``: Shear modulus ≥ 0 of a spring in parallel, [Pa].
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s].
    """

    shear_modulus: float
    relaxation_time: float
    exponent: float
    time_range: tuple[float, float]
    _: KW_ONLY
    equilibrium_modulus: float = 0.0
    poisson_ratio: float = 0.5
    valid_frequencies: tuple[float, float] | None = None
    _kind = "fractional-maxwell"


@dataclass(frozen=True)
class MaterialFile(Material):
    """The material of another file.

    ``path``: A file in the folder of the scene, with a table `[material.…]`, such as the material.toml of `fit-material`.
    ``poisson_ratio``: Poisson ratio, −1 < ν ≤ 1/2; without it that of the file.
    ``temperature``: Temperature to which the shift law takes the material, [°C]; without it that of the file.
    ``valid_frequencies``: Lowest and highest frequency > 0 at which it was measured, [rad/s]; without it those of the file.
    """

    path: str | os.PathLike[str]
    _: KW_ONLY
    poisson_ratio: float | None = None
    temperature: float | None = None
    valid_frequencies: tuple[float, float] | None = None
    _kind = "file"


@dataclass(frozen=True)
class ConstantShear(Interface):
    """A shear strength that is the same at every velocity and temperature.

    ``shear_strength``: Shear strength > 0, [Pa].
    """

    shear_strength: float
    _kind = "constant"


@dataclass(frozen=True)
class BellShear(Interface):
    """A shear strength that is largest at one velocity, τ_0 exp(−(log₁₀(v a_T/v_0)/w)²) (Lorenz et al. 2015).

    ``shear_strength``: Largest shear strength τ_0 > 0, [Pa].
    ``velocity``: Velocity v_0 > 0 of the largest shear strength at the reference temperature, [m/s].
    ``activation_energy``: Activation energy > 0 of a_T by Arrhenius' law, by default in J/mol, from 1 kJ/mol to 10 MJ/mol; without it the temperature has no
    influence.
    ``activation_energy_unit``: Unit of the activation energy.
    ``"J/mol"``: Joule per mole.
    ``"kJ/mol"``: Kilojoule per mole.
    ``"eV"``: Electronvolt per bond.
    ``reference_temperature``: Temperature at which a_T = 1, [°C]; without it 20.
    ``width``: Decades w > 0 of velocity over which the shear strength falls to τ_0/e; without it √10.
    """

    shear_strength: float
    velocity: float
    _: KW_ONLY
    activation_energy: float | None = None
    activation_energy_unit: Literal["J/mol", "kJ/mol", "eV"] = "J/mol"
    reference_temperature: float = 20.0
    width: float = 3.1622776601683795
    _kind = "bell"


@dataclass(frozen=True)
class ShearFile(Interface):
    """Measured shear strengths, interpolated on logarithmic scales and never extrapolated.

    ``file``: A table in the folder of the scene, with columns of speed and shear strength, and optionally of temperature and standard error.
    """

    file: str | os.PathLike[str]
    _kind = "table"


@dataclass(frozen=True)
class Heat(Heated):
    """Heat of sliding: the temperature of the contact is computed, and material and shear strength are those at this temperature.

    ``conductivity``: Thermal conductivity k of the elastomer > 0, [W/m/K].
    ``ambient_temperature``: Temperature of the elastomer far from the contact, [°C]; without it that of the material.
    ``counterface``: What the body does with the heat of the interface.
    ``"insulating"``: It takes no heat.
    ``"conducting"``: It takes all heat of the interface.
    ``{"share": …}``: It takes this share of the heat of the interface, from 0 to 1.
    ``density``: Density ρ of the elastomer > 0, [kg/m³].
    ``diffusivity``: Thermal diffusivity k/(ρc) of the elastomer > 0, [m²/s]; without it density and heat_capacity are given.
    ``duration``: Time > 0 for which a periodic surface has been sliding, [s]; its mean temperature grows with the root of it. Other bodies reach
    a stationary temperature and need none.
    ``heat_capacity``: Specific heat capacity c of the elastomer > 0, [J/kg/K].
    """

    conductivity: float
    _: KW_ONLY
    ambient_temperature: float | None = None
    counterface: Literal["insulating", "conducting"] | Mapping[str, float] = "insulating"
    density: float | None = None
    diffusivity: float | None = None
    duration: float | None = None
    heat_capacity: float | None = None
    _kind = ""


@dataclass(frozen=True)
class KrausStrain(StrainDependence):
    """The form of Kraus (1984), f = r + (1 − r)/(1 + x²) and g = 1 + 2 (p − 1) x/(1 + x²) with x = (ε/ε_c)^m.

    ``critical_strain``: Strain ε_c > 0 of the largest loss modulus.
    ``storage_ratio``: Storage modulus at large strains over that at small ones, 0 < r ≤ 1.
    ``exponent``: Exponent m > 0; without it 0.6, that of carbon black.
    ``loss_peak_ratio``: Largest loss modulus over that at small strains, p ≥ 1; without it 1.
    """

    critical_strain: float
    storage_ratio: float
    _: KW_ONLY
    exponent: float = 0.6
    loss_peak_ratio: float = 1.0
    _kind = "kraus"


@dataclass(frozen=True)
class StrainFile(StrainDependence):
    """A measured strain sweep, interpolated on logarithmic scales; beyond its last strain the factors stay as they are, with a warning.

    ``file``: A CSV file in the folder of the scene: strain with storage_factor and loss_factor, or a strain sweep as instruments export it.
    ``amplitude``: Whether strains are half the distance from peak to peak, or the whole.
    ``"single"``: Half of the distance from peak to peak.
    ``"double"``: The distance from peak to peak.
    ``deformation``: What the strains of the file are; without it what the names of its moduli say.
    ``"tension"``: Tension or compression, whose strain is the equivalent one.
    ``"shear"``: Shear γ, whose equivalent strain is γ/√3.
    """

    file: str | os.PathLike[str]
    _: KW_ONLY
    amplitude: Literal["single", "double"] = "single"
    deformation: Literal["tension", "shear"] | None = None
    _kind = "table"
