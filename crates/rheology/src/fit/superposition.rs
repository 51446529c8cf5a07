//! Isotherms shifted onto their neighbours, in frequency and in modulus: G*(ω, T) = b_T G*(a_T ω, T_r).
//!
//! Moduli of rubber are entropic and scale with T ρ, so that b_T ≈ T/T_r (Ferry 1980, Viscoelastic Properties of Polymers, ch. 11);
//! other b_T say how the material changes with temperature, or how the geometry of the sample does.

use super::bridge::{HOLDS, Known, bridged};
use super::master_curve::Isotherm;
use super::overlap::{Lines, ModulusFactor, Pair, Place};
use crate::{KELVIN_AT_ZERO_CELSIUS, RheologyError};
use numerics::positive;

/// How the moduli of isotherms change with temperature, besides their times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VerticalShift {
    /// Not at all: b_T = 1.
    None,
    /// With the absolute temperature, as of an ideal rubber: b_T = T/T_r.
    Entropic,
    /// By a factor of each isotherm of its own.
    Free,
}

impl VerticalShift {
    /// All kinds with their names.
    pub const NAMED: [(&'static str, Self); 3] = [
        ("none", Self::None),
        ("entropic", Self::Entropic),
        ("free", Self::Free),
    ];
}

/// Why the moduli are taken to change as they do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VerticalChoice {
    /// It was asked for.
    Given,
    /// The isotherms lie on one another better than with the other kinds.
    FoundInData,
    /// The isotherms lie on one another as well without and with the absolute temperature: b_T = 1.
    NotInData,
}

/// How isotherms are to be put onto one curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuperpositionOptions {
    /// How moduli change; without it what the isotherms show.
    pub vertical: Option<VerticalShift>,
    /// What is to be added to the temperatures of the isotherms for K; by default they are in °C.
    pub kelvin_at_zero: f64,
}

impl Default for SuperpositionOptions {
    fn default() -> Self {
        Self {
            vertical: None,
            kelvin_at_zero: KELVIN_AT_ZERO_CELSIUS,
        }
    }
}

/// An isotherm beside the one that it was shifted onto.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Link {
    pub(super) fixed: usize,
    pub(super) moved: usize,
    pub(super) by: LinkedBy,
}

/// What says where an isotherm belongs.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) enum LinkedBy {
    /// The residuals where both overlap.
    Overlap {
        /// What residuals of ln G' and ln G'' are weighed by.
        variances: [f64; 2],
        /// Whether the shift of the frequencies was found, and not known before.
        finds_shift: bool,
        /// What was known of ln b before, where it was found, as a standard deviation.
        modulus_spread: Option<f64>,
    },
    /// The law of other pairs: places in the list of links, and what the shift of each is a part of this one.
    Law(Vec<(usize, f64)>),
    /// Nothing but a law that was given.
    Given,
}

/// Where all isotherms are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Superposed {
    /// ln of the factors of their frequencies and of their moduli, in the order of the isotherms.
    pub(super) log_factors: Vec<f64>,
    pub(super) log_moduli: Vec<f64>,
    /// Each after the one that its isotherm was shifted onto.
    pub(super) links: Vec<Link>,
    pub(super) vertical: VerticalShift,
    pub(super) choice: VerticalChoice,
    /// ln of the factors of the moduli that would be those of an ideal rubber, where the data do not show whether they are; else none.
    pub(super) undecided: Vec<f64>,
}

/// How much likelier, in ln, one kind of b_T without constants must be than the other one before it counts as found.
const DECIDED: f64 = 3.0;
/// Free factors within this of the kind without constants are what one instrument makes of one sample from isotherm to isotherm,
/// and no property of the material: three times the scatter of factors that the covariance of the moduli assumes.
const BY_INSTRUMENT: f64 = 0.03;
/// Isotherms meet where their residuals are within this many times those of the scatter of their points.
const MEETS: f64 = 2.0;
/// What is known of ln b of neighbours before they are looked at, where it is free: some 10 % beside the kind without constants.
const MODULUS_SPREAD: f64 = 0.1;
/// A pair whose residuals are this many times those of the pair in the middle was put together by force.
const FORCED: f64 = 4.0;

/// Puts every isotherm onto the neighbour that is nearer to the one that stays, by chains of pairs from that one outwards.
///
/// `known` has ln a_T of all isotherms where a law was given.
pub(super) fn superpose(
    isotherms: &[Isotherm],
    chain: &[[usize; 2]],
    known: Option<&[f64]>,
    options: &SuperpositionOptions,
) -> Result<Superposed, RheologyError> {
    for isotherm in isotherms {
        positive("temperature", isotherm.temperature + options.kelvin_at_zero)?;
    }
    let lines: Vec<Lines> = isotherms
        .iter()
        .map(|one| Lines::new(&one.points))
        .collect();
    let neighbours = Neighbours {
        isotherms,
        chain,
        known,
        options,
        scatter: scatter(&lines),
        lines,
    };
    let bound = |vertical| neighbours.placed(vertical, None);
    let freed = |about| neighbours.placed(about, Some(MODULUS_SPREAD));
    let (kind, choice, placed) = match options.vertical {
        Some(VerticalShift::Free) => {
            let about = neighbours
                .chosen()
                .map_or(VerticalShift::None, |(about, ..)| about);
            (VerticalShift::Free, VerticalChoice::Given, freed(about)?)
        }
        Some(given) => (given, VerticalChoice::Given, bound(given)?),
        None => {
            let (kind, choice, placed) = neighbours.chosen()?;
            match freed(kind) {
                Ok(freed) if neighbours.are_free(&placed, &freed) => {
                    (VerticalShift::Free, VerticalChoice::FoundInData, freed)
                }
                _ => (kind, choice, placed),
            }
        }
    };
    Ok(neighbours.joined(kind, choice, placed))
}

/// Variances of residuals of ln G' and ln G'' by the scatter of single points, from the median of all isotherms, which does not ask
/// for the curvature.
fn scatter(lines: &[Lines]) -> [f64; 2] {
    let of_all: Vec<[Vec<f64>; 2]> = lines.iter().map(Lines::scatter).collect();
    [0, 1].map(|quantity| {
        let mut squares: Vec<f64> = of_all
            .iter()
            .flat_map(|one| one[quantity].clone())
            .collect();
        squares.sort_by(f64::total_cmp);
        let median = squares.get(squares.len() / 2).copied();
        let variance = median.map_or(UNKNOWN_SCATTER.powi(2), |median| median / MEDIAN_OF_SQUARE);
        BESIDE_A_LINE * variance.max(LEAST_SCATTER.powi(2))
    })
}

/// Of a number with the variance 1 and a normal distribution.
const MEDIAN_OF_SQUARE: f64 = 0.455;
/// The variance of a point less that of a line between two others, which is a half to one of a point.
const BESIDE_A_LINE: f64 = 1.5;
/// Of isotherms of fewer than five points, relative.
const UNKNOWN_SCATTER: f64 = 0.01;
/// No instrument is better than that, relative.
const LEAST_SCATTER: f64 = 1e-4;

/// A pair of isotherms, put together.
#[derive(Debug, Clone, PartialEq)]
struct Placed {
    log_factor: f64,
    log_modulus: f64,
    /// Where they overlap.
    place: Option<Place>,
    by: LinkedBy,
}

impl Placed {
    /// Where both overlap best.
    fn found(place: Place, modulus_spread: Option<f64>) -> Self {
        Self {
            log_factor: place.log_factor,
            log_modulus: place.log_modulus,
            place: Some(place),
            by: LinkedBy::Overlap {
                variances: place.variances,
                finds_shift: true,
                modulus_spread,
            },
        }
    }

    /// At a shift that is known.
    fn given(log_factor: f64, factor: ModulusFactor, place: Option<Place>) -> Self {
        let free = place.zip(factor.spread);
        Self {
            log_factor,
            log_modulus: place.map_or(factor.centre, |place| place.log_modulus),
            place,
            by: free.map_or(LinkedBy::Given, |(place, spread)| LinkedBy::Overlap {
                variances: place.variances,
                finds_shift: false,
                modulus_spread: Some(spread),
            }),
        }
    }
}

struct Neighbours<'a> {
    isotherms: &'a [Isotherm],
    chain: &'a [[usize; 2]],
    known: Option<&'a [f64]>,
    options: &'a SuperpositionOptions,
    scatter: [f64; 2],
    lines: Vec<Lines>,
}

impl Neighbours<'_> {
    fn pair(&self, [fixed, moved]: [usize; 2]) -> Pair<'_> {
        Pair {
            fixed: &self.lines[fixed],
            moved: &self.lines[moved],
            scatter: self.scatter,
        }
    }

    fn kelvin(&self, isotherm: usize) -> f64 {
        self.isotherms[isotherm].temperature + self.options.kelvin_at_zero
    }

    /// ln of the ratio of the moduli of two isotherms by a kind of b_T without constants.
    fn log_modulus(&self, vertical: VerticalShift, [fixed, moved]: [usize; 2]) -> f64 {
        match vertical {
            VerticalShift::Entropic => (self.kelvin(moved) / self.kelvin(fixed)).ln(),
            VerticalShift::None | VerticalShift::Free => 0.0,
        }
    }

    /// All pairs with the factors of the moduli of a kind without constants, or about them.
    fn placed(
        &self,
        vertical: VerticalShift,
        spread: Option<f64>,
    ) -> Result<Vec<Placed>, RheologyError> {
        let factor = |pair: &[usize; 2]| ModulusFactor {
            centre: self.log_modulus(vertical, *pair),
            spread,
        };
        let factors: Vec<ModulusFactor> = self.chain.iter().map(factor).collect();
        let pairs = self.chain.iter().zip(&factors);
        if let Some(known) = self.known {
            let at = |(pair, factor): (&[usize; 2], &ModulusFactor)| {
                let log_factor = known[pair[1]] - known[pair[0]];
                let place = self.pair(*pair).at(log_factor, *factor);
                Placed::given(log_factor, *factor, place)
            };
            return Ok(pairs.map(at).collect());
        }
        let places = pairs.map(|(pair, factor)| self.pair(*pair).best(*factor));
        let places: Vec<Option<Place>> = places.collect();
        let forced = forced(&places);
        let of_link = |link: usize| {
            let factor = factors[link];
            let law = forced[link]
                .then(|| self.by_law(&places, &forced, link))
                .flatten();
            if let Some((log_factor, parts)) = law
                && self.belongs(link, log_factor, factor, places[link])
            {
                return Ok(Placed {
                    log_factor,
                    log_modulus: factor.centre,
                    place: None,
                    by: LinkedBy::Law(parts),
                });
            }
            let [first, second] = self.chain[link].map(|one| self.isotherms[one].temperature);
            let place = places[link].ok_or(RheologyError::NoOverlap { first, second })?;
            Ok(Placed::found(place, spread))
        };
        (0..places.len()).map(of_link).collect()
    }

    /// Whether a pair belongs where the law puts it rather than where it meets best.
    fn belongs(
        &self,
        link: usize,
        log_factor: f64,
        factor: ModulusFactor,
        place: Option<Place>,
    ) -> bool {
        let pair = self.pair(self.chain[link]);
        let is_elsewhere = place.is_none_or(|place| {
            // What overlaps as little as it may is farther apart where the law says so.
            let is_beyond = place.is_at_the_end() && pair.at(log_factor, factor).is_none();
            is_beyond || (place.log_factor - log_factor).abs() > HOLDS
        });
        is_elsewhere && pair.allows(log_factor, factor)
    }

    /// The shift of a pair by the law of the others around it, and their parts in it.
    fn by_law(
        &self,
        places: &[Option<Place>],
        forced: &[bool],
        link: usize,
    ) -> Option<(f64, Vec<(usize, f64)>)> {
        let temperatures = |link: usize| self.chain[link].map(|one| self.kelvin(one));
        let known = (0..places.len()).filter(|other| !forced[*other]);
        let known = known.filter_map(|other| {
            Some(Known {
                link: other,
                temperatures: temperatures(other),
                log_factor: places[other]?.log_factor,
            })
        });
        bridged(known.collect(), temperatures(link))
    }

    /// The kind without constants that the pairs are nearer to each other with.
    fn chosen(&self) -> Result<(VerticalShift, VerticalChoice, Vec<Placed>), RheologyError> {
        let without = self.placed(VerticalShift::None, None);
        let Ok(entropic) = self.placed(VerticalShift::Entropic, None) else {
            return Ok((VerticalShift::None, VerticalChoice::NotInData, without?));
        };
        let Ok(without) = without else {
            return Ok((
                VerticalShift::Entropic,
                VerticalChoice::FoundInData,
                entropic,
            ));
        };
        let likelier = self.likelier(&entropic, &without);
        let choice = if likelier.abs() > DECIDED {
            VerticalChoice::FoundInData
        } else {
            VerticalChoice::NotInData
        };
        Ok(if likelier > DECIDED {
            (VerticalShift::Entropic, choice, entropic)
        } else {
            (VerticalShift::None, choice, without)
        })
    }

    /// ln of the ratio of the likelihoods of two ways to put the pairs together, each with the variances that it needs.
    fn likelier(&self, one: &[Placed], other: &[Placed]) -> f64 {
        let pairs = one.iter().zip(other);
        let pairs = pairs.filter_map(|(one, other)| Some((one.place?, other.place?)));
        let parts = pairs.flat_map(|(one, other)| {
            [0, 1].map(|quantity| {
                let variance =
                    |place: &Place| place.mean_squares[quantity] + self.scatter[quantity];
                // Each point is in two residuals: in that of its own and in those of the points beside it.
                let points = 0.5 * other.overlaps[quantity];
                0.5 * points * (variance(&other) / variance(&one)).ln()
            })
        });
        parts.sum()
    }

    /// Whether the free factors are found in the data: likelier by more than their number costs (Schwarz 1978, Ann. Stat. 6, 461),
    /// farther from what they are without than what instruments make, and with them both moduli meet within their scatter, which
    /// factors that only make up for a wrong shift do not achieve.
    fn are_free(&self, without: &[Placed], freed: &[Placed]) -> bool {
        let overlaps = without.iter().filter_map(|placed| placed.place);
        let points: f64 = overlaps.clone().flat_map(|place| place.overlaps).sum();
        let costs = 0.5 * (0.5 * points).max(1.0).ln() * overlaps.count() as f64;
        let [free, bound] =
            [freed, without].map(|placed| self.summed(placed, |one| one.log_modulus));
        let away = free
            .iter()
            .zip(&bound)
            .map(|(free, bound)| (free - bound).abs());
        let meet = |place: Place| {
            let mut parts = place.mean_squares.iter().zip(self.scatter);
            parts.all(|(square, scatter)| *square <= MEETS * MEETS * scatter)
        };
        let places: Vec<bool> = freed
            .iter()
            .filter_map(|placed| placed.place.map(meet))
            .collect();
        let apart = places.iter().filter(|meets| !**meets).count();
        self.likelier(freed, without) > costs + DECIDED
            && away.fold(0.0, f64::max) > BY_INSTRUMENT
            && 2 * apart < places.len()
    }

    /// Sums along the chains, by the isotherms.
    fn summed(&self, placed: &[Placed], of_pair: impl Fn(&Placed) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.isotherms.len()];
        for ([fixed, moved], placed) in self.chain.iter().zip(placed) {
            sums[*moved] = sums[*fixed] + of_pair(placed);
        }
        sums
    }

    fn joined(
        &self,
        vertical: VerticalShift,
        choice: VerticalChoice,
        placed: Vec<Placed>,
    ) -> Superposed {
        let log_factors = match self.known {
            Some(known) => known.to_vec(),
            None => self.summed(&placed, |one| one.log_factor),
        };
        let log_moduli = self.summed(&placed, |one| one.log_modulus);
        let undecided = match choice {
            VerticalChoice::NotInData => {
                let reference = self.chain.first().map_or(0, |[fixed, _]| *fixed);
                let others = 0..self.isotherms.len();
                let entropic = |one| self.log_modulus(VerticalShift::Entropic, [reference, one]);
                others.map(entropic).collect()
            }
            VerticalChoice::Given | VerticalChoice::FoundInData => Vec::new(),
        };
        let links = self.chain.iter().zip(placed);
        let link = |([fixed, moved], placed): (&[usize; 2], Placed)| Link {
            fixed: *fixed,
            moved: *moved,
            by: placed.by,
        };
        Superposed {
            log_factors,
            log_moduli,
            links: links.map(link).collect(),
            vertical,
            choice,
            undecided,
        }
    }
}

/// Which pairs do not overlap, or only by force: as little as they may, or with residuals far above those of the others.
fn forced(places: &[Option<Place>]) -> Vec<bool> {
    let medians = [0, 1].map(|quantity| {
        let squares = places
            .iter()
            .flatten()
            .map(|place| place.mean_squares[quantity]);
        let mut squares: Vec<f64> = squares.collect();
        squares.sort_by(f64::total_cmp);
        // Of two pairs the better one.
        squares
            .get(squares.len().saturating_sub(1) / 2)
            .copied()
            .unwrap_or_default()
    });
    let is_forced = |place: &Place| {
        let parts = place.mean_squares.iter().zip(medians);
        let is_far = |(own, median): (&f64, f64)| *own > FORCED * FORCED * median;
        place.is_at_the_end() || parts.into_iter().any(is_far)
    };
    places
        .iter()
        .map(|place| place.as_ref().is_none_or(is_forced))
        .collect()
}
