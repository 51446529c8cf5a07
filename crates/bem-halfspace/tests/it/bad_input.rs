//! Bad input gives a typed error that names the parameter and its value.

use bem_halfspace::indent::indent_history_on_grid;
use bem_halfspace::slide::{
    March, Motion, StationaryOptions, Transient, slide, slide_on_grid, slide_to_stationary,
};
use bem_halfspace::steady::{
    SteadyBody::Line, SteadyOptions, SteadySliding, steady, steady_on_grid,
};
use bem_halfspace::{
    BemError, ContactState, Control, Convolution, Footprint, Grid, GridOptions, HistoryPoint,
    indent, press,
};
use indenters::{Cylinder, FlatPunch, PressingLoad, Sphere, Surface};
use numerics::{Accuracy, MessageNumber};
use rheology::{CreepSpectrum, Material, Prony, RelaxationSpectrum};

use crate::support::{
    Formula, Pressing, Scene, after, assert_refused, at_depth, motions, paraboloid, power, prony,
    squares, three_elements, under_force, viscous,
};

const NOT_POSITIVE_AND_FINITE: [f64; 5] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY];

const FORCE: Control = Control::NormalForce(1.0);
const MAY_TOUCH: &str = "number of elements of the footprint that may touch";

fn solid() -> Prony {
    three_elements(0.1, 1.0, 1.0)
}

/// Checks the parameter and the value that an error names.
#[track_caller]
fn assert_bad<T>(bad: f64, result: Result<T, BemError>, name: &str) {
    let text = result.as_ref().err().map(ToString::to_string);
    let text = text.unwrap_or_default();
    let said = format!(" is {}", MessageNumber(bad));
    assert!(text.ends_with(&said), "{bad}: {text}");
    assert_refused(bad, result, name);
}

/// Slides the unit paraboloid over a number of contact lengths, on eight elements along the contact with changed options.
fn slid(lengths: f64, change: impl FnOnce(&mut GridOptions)) -> Result<Transient, BemError> {
    let scene = Scene::unit(2.0);
    let mut options = scene.options(8.0);
    change(&mut options);
    let load = scene.load_over(lengths);
    slide_on_grid(&scene.body, &scene.material, &load, &options)
}

/// Stationary state of a body under the load of the unit paraboloid, on its grid with changed options.
fn steady_with(
    body: &impl Surface,
    change: impl FnOnce(&mut SteadyOptions),
) -> Result<SteadySliding, BemError> {
    let scene = Scene::unit(2.0);
    let mut options = scene.steady_options(6.0);
    change(&mut options);
    steady_on_grid(body, &scene.material, &scene.load, &options)
}

/// Options of square elements in a square footprint.
fn steady_in(body: &impl Surface, spacing: f64, end: f64) -> Result<SteadySliding, BemError> {
    steady_with(body, |options| {
        *options = SteadyOptions::new([spacing; 2], Footprint::square(end));
    })
}

#[test]
fn options_out_of_range_are_refused() {
    type Change = fn(&mut [f64; 2], &mut Footprint, f64);
    let of_elements: [(_, Change); 4] = [
        ("spacing along x", |spacing, _, bad| spacing[0] = bad),
        ("spacing along y", |spacing, _, bad| spacing[1] = bad),
        ("footprint along x", |_, area, bad| area.x[1] = bad),
        ("footprint along y", |_, area, bad| area.y[0] = -bad),
    ];
    let body = paraboloid(0.3);
    for bad in NOT_POSITIVE_AND_FINITE {
        for (name, change) in of_elements {
            let moved = slid(1.0, |to| change(&mut to.spacing, &mut to.footprint, bad));
            assert_bad(bad, moved, name);
            let solved = |to: &mut SteadyOptions| change(&mut to.spacing, &mut to.footprint, bad);
            assert_bad(bad, steady_with(&body, solved), name);
        }
        let moved = slid(1.0, |grid| grid.contact.tolerance = bad);
        assert_bad(bad, moved, "contact tolerance");
        let solved = steady_with(&body, |grid| grid.tolerance = bad);
        assert_bad(bad, solved, "tolerance");
        let solved = Scene::unit(2.0).try_steady(bad);
        assert_bad(bad, solved, "relative_error");
    }
    for bad in [0.51, -0.6, f64::NAN] {
        let solved = steady_with(&body, |options| options.phase[1] = bad);
        assert_bad(bad, solved, "phase");
    }
}

#[test]
fn a_contact_that_does_not_fit_is_refused() {
    let length = Scene::unit(2.0).contact_length();
    let body = paraboloid(0.3);
    for spacing in [1e-7, 1e-200, f64::MIN_POSITIVE] {
        let fine = slid(1.0, |options| options.spacing = [spacing; 2]);
        assert_refused(spacing, fine, "TooManySteps");
        let fine = steady_with(&body, |options| options.spacing = [spacing; 2]);
        assert_refused(spacing, fine, "GridTooLarge");
    }
    for spacing in [length, 1e12 * length] {
        let half_width = 10.0 * spacing;
        let coarse = slid(8.0 * spacing / length, |options| {
            *options = squares(spacing, half_width);
        });
        assert_refused(spacing, coarse, "GridTooCoarse");
        let coarse = steady_in(&body, spacing, half_width);
        assert_refused(spacing, coarse, "GridTooCoarse");
    }
    let beyond = slid(4.0, |grid| grid.footprint = Footprint::square(0.7 * length));
    assert_refused("slide", beyond, "ContactReachesBoundary");
    let beyond = steady_in(&body, length / 6.0, 0.8 * length);
    assert_refused("steady", beyond, "ContactReachesBoundary");
    let options = SteadyOptions::new([0.02; 2], Footprint::square(0.3));
    let beyond = steady_on_grid(&paraboloid(1.0), &solid(), &under_force(1.0, 1.0), &options);
    assert_refused("a solid", beyond, "ContactReachesBoundary");
}

#[test]
fn what_is_not_reached_says_what_was() {
    let slid_once = slid(1.0, |options| options.contact.max_iterations = 1);
    assert_refused("slide", slid_once, "ContactNotConverged");
    let once = steady_with(&paraboloid(0.3), |options| options.max_iterations = 1);
    assert_refused("steady", once, "ContactNotConverged");
    let drifting = Scene::unit(2.0).slide(6.0, 2.0).stationary(1e-3);
    assert_refused("2 contact lengths", drifting, "NotStationary");
    let wanted = StationaryOptions {
        tolerance: 1e-3,
        over_distance: 3.0,
    };
    let (load, grid) = (after(under_force(1.5, 0.3), 4.0), squares(0.2, 2.4));
    let short = slide_to_stationary(&paraboloid(0.5), &viscous(1.2), &load, &grid, &wanted);
    assert_refused("4 m", short, "NotStationary");
}

#[test]
fn bodies_without_numbers_or_without_friction_are_refused() {
    let scene = Scene::unit(2.0);
    let (load, options) = (scene.load_over(1.0), scene.options(8.0));
    let steps = HistoryPoint::held(FORCE, &[1.0]);
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        let height = |x: f64, y: f64| if x > 0.1 { bad } else { x * x + y * y };
        let broken = Formula::new([false; 2], |[x, y]| (height(x, y), [2.0 * x, 2.0 * y]));
        let moved = slide_on_grid(&broken, &scene.material, &load, &options);
        assert_refused(bad, moved, "Indenter(InvalidHeight");
        let pressed = indent_history_on_grid(&broken, &scene.material, &steps, &options);
        assert_refused(bad, pressed, "Indenter(InvalidHeight");
        assert_refused(bad, steady_with(&broken, |_| ()), "Indenter(InvalidHeight");
    }
    // Solvers that choose their grid say so too, before they choose it.
    let whole = solid();
    let at_depth = Control::IndentationDepth(0.1);
    for bad in [0.01, -0.01, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let shifted = Formula::new([false; 2], |[x, y]| {
            (bad + x * x + y * y, [2.0 * x, 2.0 * y])
        });
        let name = if bad.is_nan() || bad == f64::NEG_INFINITY {
            "Indenter(InvalidHeight"
        } else {
            "Indenter(LowestPointNotZero"
        };
        for control in [FORCE, at_depth] {
            assert_refused(bad, press(&shifted, &whole, control, 1e-2), name);
        }
        assert_refused(bad, steady(&shifted, &whole, &scene.load, 1e-2), name);
        assert_refused(bad, steady(Line(&shifted), &whole, &scene.load, 1e-2), name);
        assert_refused(bad, slide(&shifted, &whole, &load, 1e-2), name);
    }
    let nowhere = Formula::new([false; 2], |[x, y]| {
        (
            if x > 0.1 { f64::NAN } else { x * x + y * y },
            [2.0 * x, 2.0 * y],
        )
    });
    assert_refused(
        "NaN",
        press(&nowhere, &whole, FORCE, 1e-2),
        "Indenter(InvalidHeight",
    );
    assert_refused(
        "NaN",
        steady(&nowhere, &whole, &scene.load, 1e-2),
        "Indenter(InvalidHeight",
    );
    let endless = HistoryPoint::held(FORCE, &[1e300]);
    let overflow = indent_history_on_grid(&scene.body, &scene.material, &endless, &options);
    assert_refused("an endless time", overflow, "ContactReachesBoundary");
    let punch = FlatPunch::new(0.5 * scene.contact_length()).expect("a punch");
    let moved = slide_on_grid(&punch, &scene.material, &load, &options);
    assert_refused("punch", moved, "VerticalWall");
    let punch = FlatPunch::new(0.3).expect("a punch");
    assert_refused("punch", steady_in(&punch, 0.02, 0.6), MAY_TOUCH);
    let on_any_grid = steady(&punch, &scene.material, &scene.load, 1e-3);
    assert_refused("punch", on_any_grid, "indentation depth");
    let beyond_its_equator = steady_in(&Sphere::new(0.05).expect("a body"), 0.01, 0.2);
    assert_refused("sphere", beyond_its_equator, "VerticalWall");
    let steep = steady_in(&power(1.0, 1000.0), 0.1, 1.5);
    assert_refused("r^1000", steep, "SlopeNotResolved");
    let steep = Scene::unit(1000.0).try_steady(1e-3);
    assert_refused("r^1000 on any grid", steep, "GridTooLarge");
    for exponent in [0.2, 0.5] {
        let cusp = steady(&power(1.0, exponent), &scene.material, &scene.load, 1e-3);
        assert_refused(exponent, cusp, "apex exponent");
    }
}

/// Two runners on either side of the lowest point; the footprint covers only one of them.
#[test]
fn a_footprint_that_misses_the_image_of_the_body_is_refused() {
    let sledge = Formula::new([true; 2], |[x, y]| {
        let aside = y.abs() - 3.0;
        let runner = x * x + aside.powi(2);
        let is_there = aside.abs() < 1.0;
        let height = if is_there { runner } else { f64::INFINITY };
        (height, [2.0 * x, 2.0 * aside * y.signum()])
    });
    for y in [[-1.0, 5.0], [-5.0, 1.0]] {
        let solved = steady_with(&sledge, |options| {
            options.spacing = [0.2; 2];
            options.footprint = Footprint { x: [-5.0, 5.0], y };
        });
        assert_refused(y, solved, MAY_TOUCH);
    }
}

#[test]
fn scenes_without_a_state_at_rest_are_refused() {
    let (grid, held) = (Accuracy::Elements(16), Control::IndentationDepth(0.01));
    let pressed = press(&paraboloid(0.5), &viscous(1.0), held, grid);
    assert_refused("a dashpot", pressed, "NoEquilibrium");
    let relaxed = PressingLoad::new(held, 1e6).expect("a load");
    let fluid = prony([0.0, 0.0], &[(4.0, 0.5)]);
    let name = "relaxation modulus of a depth held so long";
    let relaxed = indent(&paraboloid(0.5), &fluid, &relaxed, grid);
    assert_refused("a fluid", relaxed, name);
    // At a constant depth the body sinks without limit, and so it does under a line load.
    let scene = Scene::new(paraboloid(0.3), viscous(2.0), at_depth(0.1, 1.0));
    let name = "SlidingDistanceMissing";
    assert_refused("a state", scene.try_steady(1e-3), name);
    let march = slide(&scene.body, &scene.material, &scene.load, 1e-2);
    assert_refused("a march", march, name);
    let (cylinder, load) = (Cylinder::new(1.0), under_force(1.0, 1.0));
    let cylinder = cylinder.expect("a body");
    for fluid in [prony([0.0, 2.0], &[]), prony([0.0, 0.0], &[(1.0, 2.0)])] {
        let line = steady(Line(&cylinder), &fluid, &load, 1e-2);
        assert_refused(&fluid, line, "fluidity");
    }
}

/// Speeds at which a length over a speed, or the compliance after that time, overflows or underflows.
#[test]
fn speeds_beyond_all_numbers_are_refused_or_not_reached() {
    for velocity in [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300] {
        let scene = Scene::new(paraboloid(1.0), solid(), under_force(1.0, velocity));
        let state = scene.try_steady(1e-2);
        let friction = state.map(|state| state.friction_coefficient);
        let holds = match &friction {
            Err(BemError::NotReached { value, error, .. }) => value.abs().max(*error) < 1e-8,
            Ok(_) => false,
            Err(error) => matches!(error, BemError::InvalidParameter(_)),
        };
        assert!(holds, "v = {velocity:e}: {friction:?}");
    }
}

#[test]
fn contacts_out_of_range_are_refused() {
    let grid = Grid::new([3, 2], [1.0, 1.0]).expect("a valid grid");
    let good = Pressing::new(Convolution::new(&grid), |_| 0.0);
    let solve = |heights: &[f64], compliance: f64, control: Control| {
        let mut body = good.clone();
        (body.heights, body.compliance) = (heights.to_vec(), compliance);
        body.solve_from(&mut ContactState::new(&good.convolution), control)
    };
    let short = format!("{:?}", solve(&[0.0; 5], 1.0, FORCE));
    assert!(short.contains("length: 5, elements: 6 }"), "{short}");
    let short = solve(&[0.0; 5], 1.0, FORCE);
    assert_refused("five heights", short, "LengthMismatch");
    let nowhere = solve(&[f64::INFINITY; 6], 1.0, FORCE);
    assert_refused("no body", nowhere, "separation");
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        let broken = solve(&[0.0, bad, 0.0, 0.0, 0.0, 0.0], 1.0, FORCE);
        assert_refused(bad, broken, "InvalidHeight");
    }
    for bad in NOT_POSITIVE_AND_FINITE {
        assert_bad(bad, solve(&[0.0; 6], bad, FORCE), "compliance");
        let grid = Grid::new([4, 4], [1.0, bad]);
        assert_bad(bad, grid, "spacing along y");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let pressed = solve(&[0.0; 6], 1.0, Control::NormalForce(bad));
        assert_bad(bad, pressed, "normal_force");
    }
    let deep = solve(&[0.0; 6], 1.0, Control::IndentationDepth(f64::INFINITY));
    assert_refused("infinitely deep", deep, "indentation_depth");
    let empty = Grid::new([0, 4], [1.0; 2]);
    assert_refused("no elements", empty, "number of elements along x");
    let huge = Grid::new([1 << 20; 2], [1.0; 2]);
    assert_refused("2^40 elements", huge, "GridTooLarge");
}

#[test]
fn motions_out_of_range_are_refused() {
    let (body, material) = (paraboloid(0.5), three_elements(0.1, 2.0, 0.5));
    let good = motions([0.1, 0.2].map(|time| (time, time, Control::NormalForce(0.5))));
    let options = squares(0.1, 1.6);
    let march = |motions: &[Motion]| March::new(&body, &material, motions, &options).map(|_| ());
    assert_refused("never", march(&[]), "number of steps");
    for motions in [[good[1], good[0]], [good[0], good[0]]] {
        assert_refused("no time", march(&motions), "time step");
    }
    let [force, depth] = [Control::NormalForce, Control::IndentationDepth];
    for bad in [f64::NAN, f64::INFINITY] {
        for (name, bad_motion) in [
            ("time step", (bad, 0.1, FORCE)),
            ("position", (0.1, bad, FORCE)),
            ("normal_force", (0.1, 0.1, force(bad))),
            ("indentation_depth", (0.1, 0.1, depth(bad))),
        ] {
            assert_bad(bad, march(&motions([bad_motion])), name);
        }
    }
    let far = motions([(0.1, 0.1, FORCE), (0.2, 1e12, FORCE)]);
    assert_refused("a path too long", march(&far), "GridTooLarge");
    let tension = motions([(0.1, 0.1, force(-1.0))]);
    assert_refused("tension", march(&tension), "normal_force");
    let nowhere = Formula::new([false; 2], |_| (f64::INFINITY, [0.0; 2]));
    let march = March::new(&nowhere, &material, &good[..1], &options).map(|_| ());
    assert_refused("no body", march, "height of the surface");
}

/// A material that relaxes as a solid and creeps as a spring.
#[derive(Debug)]
struct Contradictory;

impl Material for Contradictory {
    fn relaxation(&self) -> RelaxationSpectrum {
        solid().relaxation()
    }

    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::new(1.0, 0.0, Vec::new()).expect("a spring")
    }
}

#[test]
fn materials_with_contradictory_spectra_are_refused() {
    let (grid, name) = (
        Accuracy::Elements(16),
        "largest |G*(ω) J*(ω) - 1| of relaxation() and creep()",
    );
    let (body, force) = (paraboloid(0.5), under_force(1.0, 1.0));
    let pressed = press(&body, &Contradictory, FORCE, grid);
    assert_refused("pressing", pressed, name);
    let load = PressingLoad::new(FORCE, 1.0).expect("a load");
    assert_refused(
        "indenting",
        indent(&body, &Contradictory, &load, grid),
        name,
    );
    assert_refused("marching", slide(&body, &Contradictory, &force, 1e-2), name);
    assert_refused("sliding", steady(&body, &Contradictory, &force, 1e-2), name);
    let cylinder = Cylinder::new(1.0).expect("a body");
    let line = steady(Line(&cylinder), &Contradictory, &force, 1e-2);
    assert_refused("a line", line, name);
}
