//! Time–temperature superposition of isotherms onto their neighbours: G*(ω, T) = b_T G*(a_T ω, T_r).
//!
//! Moduli of rubber are entropic and scale with T ρ, so that b_T ≈ T/T_r (Ferry 1980, Viscoelastic Properties of Polymers,
//! ch. 11). Other b_T show a change of the material, or of the geometry of the sample, with temperature.

use super::bridge::{KnownShift, LAW_TOLERANCE, LawShift, shift_by_law};
use super::master_curve::Isotherm;
use super::overlap::{LogCurves, ModulusFactor, Pair, Place};
use crate::{KELVIN_AT_ZERO_CELSIUS, RheologyError};
use numerics::positive;

/// Vertical shift: the change of the moduli of isotherms with temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VerticalShift {
    /// No change: b_T = 1.
    None,
    /// Change with the absolute temperature, as for an ideal rubber: b_T = T/T_r.
    Entropic,
    /// A free factor for each isotherm.
    Free,
}

impl VerticalShift {
    /// All kinds of vertical shift with their names.
    pub const NAMED: [(&'static str, Self); 3] = [
        ("none", Self::None),
        ("entropic", Self::Entropic),
        ("free", Self::Free),
    ];
}

/// Reason for the choice of the vertical shift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VerticalChoice {
    /// The vertical shift was given.
    Given,
    /// The isotherms agree significantly better than with the other kinds.
    FoundInData,
    /// The isotherms agree equally well with b_T = 1 and b_T = T/T_r; b_T = 1 is taken.
    NotInData,
}

/// Options of the superposition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuperpositionOptions {
    /// Vertical shift; `None` lets the isotherms decide.
    pub vertical: Option<VerticalShift>,
    /// Absolute temperature of the zero of the temperature scale, \[K]; by default that of °C.
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

/// A pair of isotherms, one shifted onto the other.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Link {
    /// Index of the isotherm that stays.
    pub(super) fixed: usize,
    /// Index of the isotherm that is shifted onto it.
    pub(super) moved: usize,
    /// Source of the shift.
    pub(super) by: LinkedBy,
}

/// Source of the shift of a pair.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) enum LinkedBy {
    /// The residuals in the overlap.
    Overlap {
        /// Variances with which the residuals of ln G' and ln G'' are weighted.
        variances: [f64; 2],
        /// Whether ln a was fitted rather than given.
        finds_shift: bool,
        /// Prior standard deviation of ln b; `None` if b was given.
        modulus_spread: Option<f64>,
    },
    /// The law of other pairs: their links, and the derivatives of this shift by theirs.
    Law(Vec<(usize, f64)>),
    /// A given law.
    Given,
}

/// Result of the superposition.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Superposed {
    /// Shifts ln a in the order of the isotherms.
    pub(super) log_factors: Vec<f64>,
    /// Shifts ln b in the order of the isotherms.
    pub(super) log_moduli: Vec<f64>,
    /// Pairs from the reference outwards.
    pub(super) links: Vec<Link>,
    /// Vertical shift that was used.
    pub(super) vertical: VerticalShift,
    /// Reason for this shift.
    pub(super) choice: VerticalChoice,
    /// Shifts ln b of an ideal rubber if the data leave them undecided, else empty.
    pub(super) undecided: Vec<f64>,
}

/// Smallest natural logarithm of the likelihood ratio that decides between two kinds of vertical shift. Chosen: odds of 20 to 1.
const MIN_LOG_LIKELIHOOD_RATIO: f64 = 3.0;
/// Largest deviation of the logarithm of a free modulus factor b, from that of a bound vertical shift (b_T = 1 or T/T_r), that an
/// instrument explains.
///
/// Derived: three times the prior scale of the factors in the covariance of the moduli.
const INSTRUMENT_FACTOR: f64 = 0.03;
/// Largest ratio of the residuals to the scatter of single points with which isotherms agree. Chosen.
const MAX_RESIDUAL_RATIO: f64 = 2.0;
/// Prior standard deviation of the logarithm of a free modulus factor b around that of the better bound vertical shift, b_T = 1
/// or T/T_r. Chosen: a larger one lets factors compensate wrong shifts.
const PRIOR_MODULUS_SPREAD: f64 = 0.1;
/// Ratio of the residuals of a pair to the median of all pairs above which its placement is rejected. Chosen.
const FORCED_RESIDUAL_RATIO: f64 = 4.0;

/// Shifts every isotherm onto its neighbour nearer to the reference, along a chain of pairs from the reference outwards.
///
/// `known` has ln a_T of all isotherms if a law was given.
pub(super) fn superpose(
    isotherms: &[Isotherm],
    chain: &[[usize; 2]],
    known: Option<&[f64]>,
    options: &SuperpositionOptions,
) -> Result<Superposed, RheologyError> {
    // Check that the absolute temperatures are positive, and take the logarithms of frequencies and moduli.
    for isotherm in isotherms {
        positive("temperature", isotherm.temperature + options.kelvin_at_zero)?;
    }
    let curves: Vec<LogCurves> = isotherms
        .iter()
        .map(|one| LogCurves::new(&one.points))
        .collect();
    let superposition = Superposition {
        isotherms,
        chain,
        known,
        options,
        scatter: scatter(&curves),
        curves,
    };
    // Place the pairs with a given vertical shift, or select one from the data.
    let bound = |vertical| superposition.place_pairs(vertical, None);
    let freed = |about| superposition.place_pairs(about, Some(PRIOR_MODULUS_SPREAD));
    let selected = match options.vertical {
        Some(VerticalShift::Free) => {
            let about = superposition
                .select_vertical()
                .map_or(VerticalShift::None, |selected| selected.vertical);
            Selected {
                vertical: VerticalShift::Free,
                choice: VerticalChoice::Given,
                placed: freed(about)?,
            }
        }
        Some(given) => Selected {
            vertical: given,
            choice: VerticalChoice::Given,
            placed: bound(given)?,
        },
        None => {
            let selected = superposition.select_vertical()?;
            match freed(selected.vertical) {
                Ok(freed)
                    if superposition.free_factors_are_significant(&selected.placed, &freed) =>
                {
                    Selected {
                        vertical: VerticalShift::Free,
                        choice: VerticalChoice::FoundInData,
                        placed: freed,
                    }
                }
                _ => selected,
            }
        }
    };
    Ok(superposition.assemble(selected))
}

/// Variances of the residuals of ln G' and ln G'' from the scatter of single points.
///
/// The median over all isotherms is insensitive to a few points of strong curvature.
fn scatter(curves: &[LogCurves]) -> [f64; 2] {
    let of_all: Vec<[Vec<f64>; 2]> = curves.iter().map(LogCurves::scatter).collect();
    [0, 1].map(|quantity| {
        let mut squares: Vec<f64> = of_all
            .iter()
            .flat_map(|one| one[quantity].clone())
            .collect();
        squares.sort_by(f64::total_cmp);
        let median = squares.get(squares.len() / 2).copied();
        let variance = median.map_or(DEFAULT_SCATTER.powi(2), |median| {
            median / MEDIAN_OF_SQUARED_NORMAL
        });
        RESIDUAL_VARIANCE_RATIO * variance.max(MIN_SCATTER.powi(2))
    })
}

/// Median of the square of a standard normal variable, 0.4549.
const MEDIAN_OF_SQUARED_NORMAL: f64 = 0.455;
/// Ratio of the variance of the distance of a point from the line through two others to that of a point. Derived: 1.5 half way
/// between them, 2 beside one of them.
const RESIDUAL_VARIANCE_RATIO: f64 = 1.5;
/// Relative scatter that is assumed for isotherms of fewer than five points, which do not show it. Chosen.
const DEFAULT_SCATTER: f64 = 0.01;
/// Smallest relative scatter that points are taken to have. Chosen: it is the limit of instruments.
const MIN_SCATTER: f64 = 1e-4;

/// The placement of a pair of isotherms.
#[derive(Debug, Clone, PartialEq)]
struct Placed {
    /// Shift ln a of the frequencies.
    log_factor: f64,
    /// Shift ln b of the moduli.
    log_modulus: f64,
    /// Placement in the overlap; `None` without overlap.
    place: Option<Place>,
    /// Source of the shift.
    by: LinkedBy,
}

impl Placed {
    /// Placement with the best agreement in the overlap; `modulus_spread` is the prior standard deviation of ln b, `None` if b was
    /// given.
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

    /// Placement at a given shift ln a, with the factor b that the overlap determines if it is free.
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

/// A vertical shift with the placements of all pairs.
struct Selected {
    /// Kind of the vertical shift.
    vertical: VerticalShift,
    /// Reason for this kind.
    choice: VerticalChoice,
    /// Placements of all pairs.
    placed: Vec<Placed>,
}

/// The isotherms that are superposed.
struct Superposition<'a> {
    /// Isotherms in any order.
    isotherms: &'a [Isotherm],
    /// Pairs from the reference outwards, the isotherm nearer to it first.
    chain: &'a [[usize; 2]],
    /// Given ln a_T of all isotherms.
    known: Option<&'a [f64]>,
    /// Given vertical shift and zero of the temperature.
    options: &'a SuperpositionOptions,
    /// Variances of the residuals of ln G' and ln G'' from the scatter of points.
    scatter: [f64; 2],
    /// Logarithms of frequency and moduli of each isotherm.
    curves: Vec<LogCurves>,
}

impl Superposition<'_> {
    /// Curves of a fixed and a moved isotherm.
    fn pair(&self, [fixed, moved]: [usize; 2]) -> Pair<'_> {
        Pair {
            fixed: &self.curves[fixed],
            moved: &self.curves[moved],
            scatter: self.scatter,
        }
    }

    /// Absolute temperature of an isotherm, \[K].
    fn kelvin(&self, isotherm: usize) -> f64 {
        self.isotherms[isotherm].temperature + self.options.kelvin_at_zero
    }

    /// Shift ln b from a fixed to a moved isotherm for a bound vertical shift, b_T = 1 or T/T_r; 0 for a free one.
    fn log_modulus(&self, vertical: VerticalShift, [fixed, moved]: [usize; 2]) -> f64 {
        match vertical {
            VerticalShift::Entropic => (self.kelvin(moved) / self.kelvin(fixed)).ln(),
            VerticalShift::None | VerticalShift::Free => 0.0,
        }
    }

    /// Placements of all pairs with a bound vertical shift, b_T = 1 or T/T_r, or with free factors around it.
    ///
    /// `spread` is the prior standard deviation of a free ln b; `None` if b_T is bound.
    fn place_pairs(
        &self,
        vertical: VerticalShift,
        spread: Option<f64>,
    ) -> Result<Vec<Placed>, RheologyError> {
        // Set the prior of the modulus factor of each pair: its centre is that of the vertical shift, its width the given one.
        let factor = |pair: &[usize; 2]| ModulusFactor {
            centre: self.log_modulus(vertical, *pair),
            spread,
        };
        let factors: Vec<ModulusFactor> = self.chain.iter().map(factor).collect();
        let pairs = self.chain.iter().zip(&factors);
        // If the shifts are given, each pair has the difference of its two given shifts.
        if let Some(known) = self.known {
            let at = |(pair, factor): (&[usize; 2], &ModulusFactor)| {
                let log_factor = known[pair[1]] - known[pair[0]];
                let place = self.pair(*pair).place_at(log_factor, *factor);
                Placed::given(log_factor, *factor, place)
            };
            return Ok(pairs.map(at).collect());
        }
        // Otherwise find the shifts with the best agreement; those that are forced are replaced by the law of the others.
        let places = pairs.map(|(pair, factor)| self.pair(*pair).best_place(*factor));
        let places: Vec<Option<Place>> = places.collect();
        let forced = forced_placements(&places);
        let of_link = |link: usize| {
            let factor = factors[link];
            let law = forced[link]
                .then(|| self.by_law(&places, &forced, link))
                .flatten();
            if let Some(law) = law
                && self.belongs_to_law(link, law.log_factor, factor, places[link])
            {
                return Ok(Placed {
                    log_factor: law.log_factor,
                    log_modulus: factor.centre,
                    place: None,
                    by: LinkedBy::Law(law.weights),
                });
            }
            let [first, second] = self.chain[link].map(|one| self.isotherms[one].temperature);
            let place = places[link].ok_or(RheologyError::NoOverlap { first, second })?;
            Ok(Placed::found(place, spread))
        };
        (0..places.len()).map(of_link).collect()
    }

    /// Whether the shift by the law replaces the best placement of a pair.
    fn belongs_to_law(
        &self,
        link: usize,
        log_factor: f64,
        factor: ModulusFactor,
        place: Option<Place>,
    ) -> bool {
        let pair = self.pair(self.chain[link]);
        let is_elsewhere = place.is_none_or(|place| {
            // A pair with the smallest admissible overlap may be farther apart by the law.
            let is_beyond =
                place.has_minimal_overlap() && pair.place_at(log_factor, factor).is_none();
            is_beyond || (place.log_factor - log_factor).abs() > LAW_TOLERANCE
        });
        is_elsewhere && pair.is_compatible(log_factor, factor)
    }

    /// Shift of the pair `link` by the law of the accepted pairs around it; `None` if there is no such law.
    fn by_law(&self, places: &[Option<Place>], forced: &[bool], link: usize) -> Option<LawShift> {
        let temperatures = |link: usize| self.chain[link].map(|one| self.kelvin(one));
        let known = (0..places.len())
            .filter(|other| !forced[*other])
            .filter_map(|other| {
                Some(KnownShift {
                    link: other,
                    temperatures: temperatures(other),
                    log_factor: places[other]?.log_factor,
                })
            });
        shift_by_law(known.collect(), temperatures(link))
    }

    /// The bound vertical shift, b_T = 1 or T/T_r, for which the pairs agree better.
    fn select_vertical(&self) -> Result<Selected, RheologyError> {
        // If the isotherms can be placed with one kind of vertical shift only, that kind is taken.
        let without = self.place_pairs(VerticalShift::None, None);
        let Ok(entropic) = self.place_pairs(VerticalShift::Entropic, None) else {
            return Ok(Selected {
                vertical: VerticalShift::None,
                choice: VerticalChoice::NotInData,
                placed: without?,
            });
        };
        let Ok(without) = without else {
            return Ok(Selected {
                vertical: VerticalShift::Entropic,
                choice: VerticalChoice::FoundInData,
                placed: entropic,
            });
        };
        // Otherwise the data decide, or leave it undecided.
        let log_likelihood_ratio = self.log_likelihood_ratio(&entropic, &without);
        let choice = if log_likelihood_ratio.abs() > MIN_LOG_LIKELIHOOD_RATIO {
            VerticalChoice::FoundInData
        } else {
            VerticalChoice::NotInData
        };
        let (vertical, placed) = if log_likelihood_ratio > MIN_LOG_LIKELIHOOD_RATIO {
            (VerticalShift::Entropic, entropic)
        } else {
            (VerticalShift::None, without)
        };
        Ok(Selected {
            vertical,
            choice,
            placed,
        })
    }

    /// ln of the likelihood ratio of two lists of placements of the same pairs, `one` over `other`, each with its maximum-likelihood
    /// variances.
    fn log_likelihood_ratio(&self, one: &[Placed], other: &[Placed]) -> f64 {
        let pairs = one
            .iter()
            .zip(other)
            .filter_map(|(one, other)| Some((one.place?, other.place?)));
        let parts = pairs.flat_map(|(one, other)| {
            [0, 1].map(|quantity| {
                let variance =
                    |place: &Place| place.mean_squares[quantity] + self.scatter[quantity];
                // Each point enters two residuals: its own, and those of neighbouring points of the other isotherm.
                let points = 0.5 * other.overlaps[quantity];
                0.5 * points * (variance(&other) / variance(&one)).ln()
            })
        });
        parts.sum()
    }

    /// Whether the data determine free factors of the moduli; three conditions must hold:
    /// - their likelihood exceeds the cost of their number (Schwarz 1978, Ann. Stat. 6, 461);
    /// - they deviate from the bound factors by more than an instrument explains;
    /// - most pairs agree within the scatter of points, unlike with factors that compensate a wrong shift.
    fn free_factors_are_significant(&self, without: &[Placed], freed: &[Placed]) -> bool {
        // Each free factor costs half the logarithm of the number of points (the Bayesian information criterion); sum over the
        // pairs.
        let overlaps = without.iter().filter_map(|placed| placed.place);
        let points: f64 = overlaps.clone().flat_map(|place| place.overlaps).sum();
        let costs = 0.5 * (0.5 * points).max(1.0).ln() * overlaps.count() as f64;
        // Compute the difference between free and bound factors of each isotherm; the largest decides.
        let [free, bound] =
            [freed, without].map(|placed| self.sum_along_chain(placed, |one| one.log_modulus));
        let away = free
            .iter()
            .zip(&bound)
            .map(|(free, bound)| (free - bound).abs());
        // Tell the pairs whose residuals are within the scatter of points from those that do not meet.
        let meet = |place: Place| {
            let mut parts = place.mean_squares.iter().zip(self.scatter);
            parts.all(|(square, scatter)| {
                *square <= MAX_RESIDUAL_RATIO * MAX_RESIDUAL_RATIO * scatter
            })
        };
        let places: Vec<bool> = freed
            .iter()
            .filter_map(|placed| placed.place.map(meet))
            .collect();
        let apart = places.iter().filter(|meets| !**meets).count();
        self.log_likelihood_ratio(freed, without) > costs + MIN_LOG_LIKELIHOOD_RATIO
            && away.fold(0.0, f64::max) > INSTRUMENT_FACTOR
            && 2 * apart < places.len()
    }

    /// Sums of a quantity of the pairs along the chain, for every isotherm.
    fn sum_along_chain(&self, placed: &[Placed], of_pair: impl Fn(&Placed) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.isotherms.len()];
        for ([fixed, moved], placed) in self.chain.iter().zip(placed) {
            sums[*moved] = sums[*fixed] + of_pair(placed);
        }
        sums
    }

    /// Superposition of all isotherms from the placements of the pairs.
    fn assemble(&self, selected: Selected) -> Superposed {
        let Selected {
            vertical,
            choice,
            placed,
        } = selected;
        // Add up the shifts of the pairs along the chain, which gives the shift of each isotherm.
        let log_factors = match self.known {
            Some(known) => known.to_vec(),
            None => self.sum_along_chain(&placed, |one| one.log_factor),
        };
        let log_moduli = self.sum_along_chain(&placed, |one| one.log_modulus);
        // If the data do not decide the vertical shift, keep the factors that it has for an ideal rubber, for the error of the
        // moduli.
        let undecided = match choice {
            VerticalChoice::NotInData => {
                let reference = self.chain.first().map_or(0, |[fixed, _]| *fixed);
                let others = 0..self.isotherms.len();
                let entropic = |one| self.log_modulus(VerticalShift::Entropic, [reference, one]);
                others.map(entropic).collect()
            }
            VerticalChoice::Given | VerticalChoice::FoundInData => Vec::new(),
        };
        // Collect for each pair of the chain how it was placed.
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

/// True for each pair whose placement is rejected: without overlap, with nearly the smallest admissible one, or with residuals far
/// above the median of all pairs.
fn forced_placements(places: &[Option<Place>]) -> Vec<bool> {
    let medians = [0, 1].map(|quantity| {
        let squares = places
            .iter()
            .flatten()
            .map(|place| place.mean_squares[quantity]);
        let mut squares: Vec<f64> = squares.collect();
        squares.sort_by(f64::total_cmp);
        // Take the median; of two pairs it is the better one.
        squares
            .get(squares.len().saturating_sub(1) / 2)
            .copied()
            .unwrap_or_default()
    });
    let is_forced = |place: &Place| {
        let parts = place.mean_squares.iter().zip(medians);
        let is_far = |(own, median): (&f64, f64)| {
            *own > FORCED_RESIDUAL_RATIO * FORCED_RESIDUAL_RATIO * median
        };
        place.has_minimal_overlap() || parts.into_iter().any(is_far)
    };
    places
        .iter()
        .map(|place| place.as_ref().is_none_or(is_forced))
        .collect()
}
