//! Shapes at and near the border beyond which the friction on a parallel dashpot has no limit (16).

use friction_analytic::power_sliding;
use indenters::{Axisymmetric, EquivalentLine, FlatCone, SampledLine, TruncatedParaboloid};
use mdr_core::{MdrError, steady};
use numerics::Estimate;
use rheology::{KelvinVoigt, Material};

use crate::support::{ASKED, assert_agree, load, material, power, prony, slid};

fn flat_ends(radius: f64) -> [Box<dyn Axisymmetric>; 2] {
    let cone = FlatCone::new(radius, 1.0).expect("a body");
    let worn = TruncatedParaboloid::new(radius, 1.0).expect("a body");
    [Box::new(cone), Box::new(worn)]
}

/// (16) diverges for p ≤ 1/2 and behind a kink that rises, also where the contact reaches beyond the kink by less than the
/// rounding of its position; without a parallel dashpot it does not.
#[test]
fn a_dashpot_under_a_cusp_or_a_kink_is_refused() {
    let dashpots: [Box<dyn Material>; 2] = [
        Box::new(material(1.0)),
        Box::new(KelvinVoigt::new(1.0, 1.0).expect("a solid")),
    ];
    let branch = prony([0.0, 0.0], &[(1.0, 1.0)]);
    let mut bodies: Vec<(Box<dyn Axisymmetric>, f64)> =
        vec![(Box::new(power(0.3)), 0.0), (Box::new(power(0.5)), 0.0)];
    for radius in [1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e4, 1e6, 1e7, 1e8] {
        bodies.extend(flat_ends(radius).map(|body| (body, radius)));
    }
    for (body, kink) in bodies {
        let line = EquivalentLine(&*body);
        for dashpot in &dashpots {
            let error = steady(&line, &**dashpot, &load(4.0, 1.0), ASKED).err();
            let Some(MdrError::FrictionDiverges { position }) = error else {
                panic!("{dashpot:?}, kink at {kink}: {error:?}");
            };
            // The cusp is found where no polynomial resolves it.
            let allowed = if kink > 0.0 { 1e-12 * kink } else { 0.011 };
            let off = (position.abs() - kink).abs();
            assert!(off <= allowed, "{position}, kink at {kink}");
        }
        if kink < 1.0 {
            let friction = slid(&line, &branch, &load(4.0, 1.0)).friction_coefficient;
            let is_known = friction.value > 0.0 && friction.is_within(ASKED);
            assert!(is_known, "{branch:?}, kink at {kink}: {friction:?}");
        }
    }
}

/// Near p = 1/2 most of the friction comes from a cusp that no polynomial resolves.
#[test]
fn the_error_of_sharp_cusps_stays_within_its_bar() {
    let (dashpot, load) = (material(1.0), load(4.0, 1.0));
    for exponent in [0.53, 0.54, 0.55, 0.57, 0.6, 0.65, 0.7, 0.8, 0.9] {
        let profile = power(exponent);
        let exact = power_sliding(&profile, &dashpot, &load).expect("a closed form");
        match steady(&EquivalentLine(&profile), &dashpot, &load, ASKED) {
            Ok(got) => {
                let exact = Estimate::exact(exact.friction_coefficient);
                assert_agree([got.friction_coefficient, exact], &exponent);
            }
            // Documented for cusps that are too slow to be summed.
            Err(MdrError::FrictionDiverges { .. }) if exponent < 0.55 => {}
            Err(error) => panic!("p = {exponent}: {error}"),
        }
    }
}

/// Behind a flat end the line is as steep as an inverse root, so that the rounding of positions moves heights by more
/// than the tolerance: halving pieces there gains nothing, and must end.
///
/// Two hundred polynomials are 13 to an octave of the distance from the kink; the contact at the largest radius is so
/// flat that the rounding of its depth is above 1e-10.
#[test]
fn a_flat_end_on_a_solid_takes_few_polynomials_however_exact_it_is_wanted() {
    let solid = prony([1.0, 0.0], &[(1.0, 1.0)]);
    for exponent in [-6, -3, -1, 0, 1] {
        for body in flat_ends(10_f64.powi(exponent)) {
            let slid = |error: f64| steady(&EquivalentLine(&*body), &solid, &load(4.0, 1.0), error);
            let exact = slid(1e-9).expect("a state").friction_coefficient;
            for asked in [1e-6, 1e-9, 1e-11, 1e-12, 1e-13] {
                let got = match slid(asked) {
                    Err(MdrError::NotConverged { .. }) if asked < 1e-9 => continue,
                    got => got.expect("a state"),
                };
                assert_agree([got.friction_coefficient, exact], &(exponent, asked));
                let n_pieces = got.n_pieces;
                assert!(n_pieces < 200, "{n_pieces} polynomials to {asked:e}");
            }
        }
    }
}

/// Teeth far behind the one that is the anchor were overlooked, because they are narrow at their distance from it.
#[test]
fn all_teeth_of_a_row_carry_their_part_of_the_force() {
    let row = |teeth: u32| {
        let corners = (0..=2 * teeth).map(|corner| (f64::from(corner), f64::from(1 - corner % 2)));
        let (positions, heights) = corners.unzip();
        SampledLine::new(positions, heights).expect("a row of teeth")
    };
    let rubber = prony([1.0, 0.0], &[(9.0, 1.0)]);
    let slide = |teeth: u32| {
        let force = load(0.01 * f64::from(teeth), 0.002);
        steady(&row(teeth), &rubber, &force, 1e-9).expect("a contact")
    };
    let (one, many) = (slide(1), slide(20));
    assert_eq!(many.contacts.len(), 20, "teeth that touch");
    assert_agree(
        [many, one].map(|state| state.friction_coefficient),
        &"teeth",
    );
}
