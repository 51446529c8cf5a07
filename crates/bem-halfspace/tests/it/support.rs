//! Bodies, materials, loads, grids, solved problems and comparisons that several claims share.

use std::f64::consts::FRAC_2_PI;
use std::fmt::Debug;

use bem_halfspace::indent::{MotionRow, indent_history_on_grid};
use bem_halfspace::slide::{Motion, PressureField, Transient, slide_on_grid};
use bem_halfspace::steady::{SteadyEstimate, SteadyOptions, SteadySliding, steady, steady_on_grid};
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution,
    Footprint, Grid, GridOptions, HistoryPoint, solve_contact,
};
pub(crate) use casebook::{Formula, prony};
use indenters::rough::{PeriodicSurface, SelfAffine};
use indenters::{PowerProfile, SlidingLoad, Surface};
#[cfg(feature = "rough")]
use numerics::MaxElements;
use numerics::{Estimate, Request};
use rayon::ThreadPoolBuilder;
use rheology::{Compressible, Elastic, Material, Prony, Viscous};

/// Tight enough that the active set and ten digits are those of the exact discrete solution.
pub(crate) const TIGHT: ContactOptions = ContactOptions {
    tolerance: 1e-13,
    max_iterations: 5000,
};

/// A rigid body over a grid, of which a control makes a contact problem.
#[derive(Debug, Clone)]
pub(crate) struct Pressing {
    pub(crate) convolution: Convolution,
    pub(crate) heights: Vec<f64>,
    pub(crate) compliance: f64,
    pub(crate) largest_pressure: f64,
    pub(crate) options: ContactOptions,
}

impl Pressing {
    /// The body with these heights at [row, column], solved tightly for the shear modulus 1.
    pub(crate) fn new(convolution: Convolution, height: impl Fn([f64; 2]) -> f64) -> Self {
        let [rows, columns] = convolution.grid().shape();
        let at = |index: usize| height([(index / columns) as f64, (index % columns) as f64]);
        Self {
            heights: (0..rows * columns).map(at).collect(),
            convolution,
            compliance: 1.0,
            largest_pressure: f64::INFINITY,
            options: TIGHT,
        }
    }

    /// A body with its lowest point over the centre of `n` × `n` square elements of the given edge.
    pub(crate) fn centred(surface: &impl Surface, n: usize, edge: f64) -> Self {
        let grid = Grid::new([n; 2], [edge; 2]).expect("a valid grid");
        let position = |index: f64| (index - 0.5 * (n as f64 - 1.0)) * edge;
        Self::new(Convolution::new(&grid), |element| {
            surface.height(element.map(position))
        })
    }

    /// Solves from the pressure of a state.
    pub(crate) fn solve_from(
        &self,
        state: &mut ContactState,
        control: Control,
    ) -> Result<Contact, BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.heights,
            compliance: self.compliance,
            largest_pressure: self.largest_pressure,
            control,
        };
        solve_contact(&problem, state, &self.options)
    }

    /// Solves without a guess.
    pub(crate) fn solve(&self, control: Control) -> (Contact, ContactState) {
        let mut state = ContactState::new(&self.convolution);
        let contact = self.solve_from(&mut state, control);
        (contact.expect("a solved contact"), state)
    }
}

/// Compares two numbers that may differ by `allowed`.
#[track_caller]
pub(crate) fn assert_near(what: impl Debug, actual: f64, expected: f64, allowed: f64) {
    let error = (actual - expected).abs();
    assert!(
        error <= allowed,
        "{what:?}: {actual:e} instead of {expected:e}, off by {error:e}, allowed {allowed:e}"
    );
}

/// Compares two numbers up to a relative error.
#[track_caller]
pub(crate) fn assert_close(what: impl Debug, actual: f64, expected: f64, relative_error: f64) {
    assert_near(what, actual, expected, relative_error * expected.abs());
}

/// Compares pairs of numbers up to a relative error of each.
#[track_caller]
pub(crate) fn assert_all_close<const N: usize>(
    what: impl Debug,
    actual: [f64; N],
    expected: [f64; N],
    relative_error: f64,
) {
    for (actual_one, expected_one) in actual.into_iter().zip(expected) {
        let place = (&what, actual, expected);
        assert_close(place, actual_one, expected_one, relative_error);
    }
}

/// Asserts that the expected value lies within the bar, and that the bar is at most a given fraction of it.
#[track_caller]
pub(crate) fn assert_bar(what: impl Debug, got: Estimate, expected: f64, widest: f64) {
    assert_near(&what, got.value, expected, got.error);
    let allowed = widest * expected.abs();
    assert!(got.error <= allowed, "{what:?}: {got:?}, allowed {allowed}");
}

/// The bars of two values overlap.
#[track_caller]
pub(crate) fn assert_bars_agree(what: impl Debug, one: Estimate, other: Estimate) {
    assert_near(what, one.value, other.value, one.error + other.error);
}

/// Compares the ends of two contacts along x and y.
#[track_caller]
pub(crate) fn assert_ends(
    what: impl Debug,
    actual: [[f64; 2]; 2],
    expected: [[f64; 2]; 2],
    allowed: f64,
) {
    for (actual, expected) in actual.as_flattened().iter().zip(expected.as_flattened()) {
        assert_near(&what, *actual, *expected, allowed);
    }
}

/// Checks the name of an error, which is that of the parameter where a parameter is refused, and that its numbers say why.
#[track_caller]
pub(crate) fn assert_refused<T>(what: impl Debug, result: Result<T, BemError>, name: &str) {
    let Err(error) = result else {
        panic!("{what:?} was not refused")
    };
    let says_why = match error {
        BemError::GridTooLarge { elements, limit } => elements > limit,
        BemError::GridTooCoarse { elements, needed } => elements < needed,
        BemError::ElementsTooFew {
            elements,
            across,
            least,
            needed,
        } => across < least && elements < needed,
        BemError::ContactNotConverged {
            residual,
            tolerance,
            ..
        } => residual > tolerance && residual.is_finite(),
        BemError::NotStationary {
            drift, tolerance, ..
        } => drift > tolerance,
        BemError::TimeNotResolved {
            error,
            relative_error,
            ..
        } => error > relative_error && error.is_finite(),
        _ => true,
    };
    assert!(says_why, "{what:?}: {error}");
    let in_full = format!("{error:?}");
    let found = match error {
        BemError::InvalidParameter(invalid) => Some(invalid.parameter),
        _ => in_full.split(' ').next(),
    };
    assert_eq!(found, Some(name), "{what:?}: {error}");
}

/// The largest difference of two fields relative to the largest expected value.
pub(crate) fn difference(actual: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(actual.len(), expected.len(), "fields of one grid");
    let largest = expected.iter().fold(0.0, |top: f64, u| top.max(u.abs()));
    let differences = actual.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / largest
}

/// The force that a field carries; refuses tension.
pub(crate) fn carried(field: &PressureField) -> f64 {
    let pressure = &field.pressure;
    assert!(pressure.iter().all(|p| *p >= 0.0), "tension in {field:?}");
    pressure.iter().sum::<f64>() * field.grid.element_area()
}

/// Runs work on a pool of a given number of threads.
pub(crate) fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a pool").install(work)
}

pub(crate) fn power(coefficient: f64, exponent: f64) -> PowerProfile {
    PowerProfile::new(coefficient, exponent).expect("a body")
}

pub(crate) fn cone(slope: f64) -> PowerProfile {
    power(slope, 1.0)
}

/// A random self-affine surface of unit period and an rms slope of 0.1, with waves from half the period on: Hurst exponent, roll-off
/// and shortest wave length, and seed.
pub(crate) fn random_surface(
    [hurst_exponent, roll_off_wavelength, shortest_wavelength]: [f64; 3],
    seed: u64,
) -> PeriodicSurface {
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent,
        rms_slope: 0.1,
        longest_wavelength: 0.5,
        shortest_wavelength,
        roll_off_wavelength,
        seed,
    };
    surface.surface().expect("a surface")
}

pub(crate) fn paraboloid(coefficient: f64) -> PowerProfile {
    power(coefficient, 2.0)
}

pub(crate) fn under_force(force: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::new(force, velocity).expect("a load")
}

pub(crate) fn at_depth(depth: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::at_depth(depth, velocity).expect("a load")
}

pub(crate) fn after(load: SlidingLoad, distance: f64) -> SlidingLoad {
    load.after(distance).expect("a distance")
}

/// Square elements in a square footprint of this half width.
pub(crate) fn squares(spacing: f64, half_width: f64) -> GridOptions {
    GridOptions::new([spacing; 2], Footprint::square(half_width))
}

/// Square elements in a square footprint, with contacts solved to a tight tolerance.
pub(crate) fn tight(options: GridOptions) -> GridOptions {
    GridOptions {
        contact: TIGHT,
        ..options
    }
}

/// Slides from first touch on.
pub(crate) fn slid(
    body: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    options: &GridOptions,
) -> Transient {
    slide_on_grid(body, &material, load, options).expect("a transient")
}

/// Motions to positions \[m] at times \[s].
pub(crate) fn motions(path: impl IntoIterator<Item = (f64, f64, Control)>) -> Vec<Motion> {
    let motion = |(time, position, control)| Motion {
        time,
        position,
        control,
    };
    path.into_iter().map(motion).collect()
}

/// A power profile h = c r^p on a half space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene<M = Viscous> {
    pub(crate) body: PowerProfile,
    pub(crate) material: M,
    pub(crate) load: SlidingLoad,
}

impl<M: Material> Scene<M> {
    pub(crate) fn new(body: PowerProfile, material: M, load: SlidingLoad) -> Self {
        Self {
            body,
            material,
            load,
        }
    }

    pub(crate) fn footprint(&self) -> Footprint {
        Footprint::sliding(&self.body, &self.material, &self.load).expect("a footprint")
    }

    /// Elements twice as long as wide, about `elements` of them along the contact: a paraboloid is at √3 of its contact as high
    /// as at the end of the footprint.
    pub(crate) fn steady_options(&self, elements: f64) -> SteadyOptions {
        let footprint = self.footprint();
        let spacing = footprint.x[1] / (3.0_f64.sqrt() * elements);
        SteadyOptions {
            tolerance: 1e-10,
            ..SteadyOptions::new([spacing, 0.5 * spacing], footprint)
        }
    }

    pub(crate) fn steady_on(&self, options: &SteadyOptions) -> SteadySliding {
        let solved = steady_on_grid(&self.body, &self.material, &self.load, options);
        solved.expect("a stationary state")
    }

    pub(crate) fn try_steady(
        &self,
        accuracy: impl Into<Request<'static>>,
    ) -> Result<SteadyEstimate, BemError> {
        steady(&self.body, &self.material, &self.load, accuracy)
    }

    pub(crate) fn steady(&self, accuracy: impl Into<Request<'static>>) -> SteadyEstimate {
        self.try_steady(accuracy).expect("a stationary state")
    }
}

impl Scene {
    /// On a dashpot, with every number of order one.
    pub(crate) fn unit(exponent: f64) -> Self {
        Self::new(power(0.3, exponent), viscous(2.0), under_force(0.5, 0.7))
    }

    /// Stationary contact length of the one-dimensional model, [m].
    pub(crate) fn contact_length(&self) -> f64 {
        let force = self.load.require_normal_force().expect("a force");
        let depth = 0.25 * force / self.material.viscosity() / self.load.velocity();
        self.body.line_position(depth)
    }

    /// Square elements, `elements` along the contact length.
    pub(crate) fn options(&self, elements: f64) -> GridOptions {
        let spacing = self.contact_length() / elements;
        GridOptions::new([spacing; 2], self.footprint())
    }

    /// The load after sliding over `lengths` of the contact length.
    pub(crate) fn load_over(&self, lengths: f64) -> SlidingLoad {
        after(self.load, lengths * self.contact_length())
    }

    pub(crate) fn slide(&self, elements: f64, lengths: f64) -> Transient {
        let (load, options) = (self.load_over(lengths), self.options(elements));
        slid(&self.body, &self.material, &load, &options)
    }
}

/// The steps of an indentation to times \[s], on one grid.
pub(crate) fn pressed(
    body: &dyn Surface,
    material: &dyn Material,
    path: impl IntoIterator<Item = (f64, Control)>,
    options: &GridOptions,
) -> Vec<MotionRow> {
    let step = |(time, control)| HistoryPoint { time, control };
    let steps: Vec<HistoryPoint> = path.into_iter().map(step).collect();
    indent_history_on_grid(body, &material, &steps, options).expect("an indentation")
}

/// The depths under a constant force at some times.
pub(crate) fn pressed_by(
    force: f64,
    times: &[f64],
) -> impl Iterator<Item = (f64, Control)> + use<'_> {
    let control = Control::NormalForce(force);
    times.iter().map(move |time| (*time, control))
}

pub(crate) fn elastic(shear_modulus: f64) -> Elastic {
    Elastic::new(shear_modulus).expect("a material")
}

pub(crate) fn viscous(viscosity: f64) -> Viscous {
    Viscous::new(viscosity).expect("a material")
}

/// A spring beside a spring and a dashpot in series.
pub(crate) fn three_elements(spring: f64, branch: f64, relaxation_time: f64) -> Prony {
    prony([spring, 0.0], &[(branch, relaxation_time)])
}

/// The three-element solids of the casebook, with the modulus G1 beside G2 and its time.
pub(crate) fn solid_of(case: &casebook::Case) -> Prony {
    three_elements(case.input("G1"), case.input("G2"), case.input("tau"))
}

/// A cone or paraboloid of the casebook whose line is |x| or x².
pub(crate) fn body_of_unit_line(case: &casebook::Case) -> PowerProfile {
    if case.input_text("shape").starts_with("cone") {
        cone(FRAC_2_PI)
    } else {
        paraboloid(0.5)
    }
}

/// One material of each kind, with moduli and times of order one.
pub(crate) fn every_kind_of_material() -> Vec<(&'static str, Box<dyn Material>)> {
    let glassy = prony([0.4, 0.0], &[(2.0, 0.3), (1.0, 2.0)]);
    let compressible = Compressible::new(&glassy, 0.3).expect("a Poisson ratio");
    vec![
        ("elastic", Box::new(prony([1.5, 0.0], &[]))),
        ("viscous", Box::new(prony([0.0, 2.0], &[]))),
        ("Kelvin-Voigt", Box::new(prony([0.7, 1.1], &[]))),
        ("Maxwell", Box::new(prony([0.0, 0.0], &[(2.0, 0.6)]))),
        ("three elements", Box::new(prony([0.3, 0.0], &[(3.0, 0.4)]))),
        ("compressible", Box::new(compressible)),
        ("two branches", Box::new(glassy)),
    ]
}

#[cfg(feature = "rough")]
/// Request of a relative error with at most a number of elements along the resolved length.
pub(crate) fn within(relative_error: f64, elements: &MaxElements) -> Request<'_> {
    Request {
        accuracy: relative_error.into(),
        watch: elements,
    }
}
