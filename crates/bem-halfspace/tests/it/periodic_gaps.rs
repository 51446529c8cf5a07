//! The gap below a periodic surface is complementary to the pressure, and its mean the distance of the mean planes.

use bem_halfspace::periodic;
use bem_halfspace::{Accuracy, GapField, Grid, Layer, PeriodicLoad};
use indenters::rough::{PeriodicSurface, SelfAffine, Wave};
use rheology::KelvinVoigt;

use crate::gaps::check_complementary;
use crate::support::{assert_refused, prony};

#[test]
fn below_a_periodic_surface_its_mean_is_the_distance_of_the_mean_planes() {
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent: 0.8,
        rms_slope: 0.2,
        longest_wavelength: 0.5,
        shortest_wavelength: 0.1,
        roll_off_wavelength: 0.5,
        seed: 4,
    };
    let surface = surface.surface().expect("a surface");
    let rubber = prony([0.3, 0.0], &[(3.0, 0.4)]);
    let load = PeriodicLoad::new(0.02, 0.3).expect("a load");
    let elements = Accuracy::Elements(128);
    let found = periodic::steady(&surface, &rubber, &load, elements).expect("a state");
    let state = found.finest;
    let field = periodic::gap(&surface, &rubber, &load, &state.pressure).expect("a gap");
    check_complementary("sliding", &field, &state.pressure, 1e-7);
    let mean = |field: &GapField| field.gap.iter().sum::<f64>() / field.gap.len() as f64;
    let distance = -state.mean_depth;
    assert!(
        (mean(&field) - distance).abs() <= 1e-7,
        "{} {distance}",
        mean(&field)
    );
    // A field that is no contact of this surface is refused.
    let mut short = state.pressure.clone();
    short.pressure.pop();
    let mut unloaded = state.pressure.clone();
    unloaded.pressure.fill(0.0);
    let mut wider = state.pressure.clone();
    wider.grid = Grid::new(wider.grid.shape(), [0.1; 2]).expect("a grid");
    let refused = [
        (short, "LengthMismatch"),
        (unloaded, "largest pressure"),
        (wider, "period"),
    ];
    for (pressure, expected) in refused {
        let found = periodic::gap(&surface, &rubber, &load, &pressure);
        assert_refused(expected, found, expected);
    }
    // On the way from rest to the stationary state.
    let marched = load.after(0.5).expect("a distance");
    let marched = periodic::slide(&surface, &rubber, &marched, elements);
    let state = marched.expect("a march").finest;
    check_complementary("march", &state.gap, &state.pressure, 1e-6);
    let distance = -state.rows[state.rows.len() - 1].mean_depth;
    let mean_gap = mean(&state.gap);
    assert!((mean_gap - distance).abs() <= 1e-7, "{mean_gap} {distance}");
    // On a layer at rest the mean pressure compresses the material.
    let layer = Layer::new(&rubber, 0.3).expect("a layer");
    let load = PeriodicLoad::pressed(0.02, 2.0).expect("a load");
    let pressed = periodic::steady(&surface, &layer, &load, elements)
        .expect("a state")
        .finest;
    let field = periodic::gap(&surface, &layer, &load, &pressed.pressure).expect("a gap");
    check_complementary("layer", &field, &pressed.pressure, 3e-7);
}

/// Behind the contact of a viscous material a whole strip of elements penetrates by less than the tolerance if it is left out, and the area
/// is too small.
#[test]
fn few_elements_in_contact_are_left_out() {
    let wave = |numbers| Wave {
        numbers,
        amplitude: 1e-5,
        phase: 0.0,
    };
    let waves = [[1, 0], [0, 1]].map(wave).to_vec();
    let surface = PeriodicSurface::new([1.6e-3; 2], waves).expect("a surface");
    let material = KelvinVoigt::new(1e6, 1e4).expect("a material");
    let load = PeriodicLoad::new(8101.64, 0.078_437_8).expect("a load");
    let found = periodic::steady(&surface, &material, &load, Accuracy::Elements(512));
    let pressure = found.expect("a state").finest.pressure;
    let gap = periodic::gap(&surface, &material, &load, &pressure).expect("a gap");
    let elements = pressure.pressure.iter().zip(&gap.gap);
    let (inside, outside): (Vec<_>, Vec<_>) = elements.partition(|(pressure, _)| **pressure > 0.0);
    let solver_error = inside
        .iter()
        .fold(0.0_f64, |max, (_, gap)| max.max(gap.abs()));
    let penetrating = outside.iter().filter(|(_, gap)| **gap < -solver_error);
    let (n_wrong, n_inside) = (penetrating.count(), inside.len());
    assert!(n_inside > 5000, "{n_inside}");
    assert!(200 * n_wrong <= n_inside, "{n_wrong} of {n_inside}");
}
