//! What a solution takes in memory is known before, within a factor.

use bem_halfspace::indent::indent_memory;
use bem_halfspace::slide::slide_memory;
use bem_halfspace::steady::steady_memory;
use bem_halfspace::{BemError, Control, PressingLoad, indent, slide, steady};
use indenters::Unmirrored;
use numerics::Accuracy;

use crate::support::{after, cone, every_kind_of_material, on_threads, paraboloid, under_force};

/// Not more is allocated at the same time than stated, and not much less.
#[track_caller]
fn check<T>(
    what: (&str, &str),
    stated: Result<f64, BemError>,
    solve: impl FnOnce() -> Result<T, BemError> + Send,
) {
    let stated = stated.expect("a grid");
    let solve = || drop(solve().expect("a solution"));
    let taken = on_threads(1, || allocation_counter::measure(solve).bytes_max as f64);
    let holds = taken <= stated && stated <= 6.0 * taken;
    assert!(holds, "{what:?}: {taken:e} bytes, {stated:e} stated");
}

#[test]
fn stated_memory_is_what_a_solution_takes() {
    let (load, pressing) = (under_force(1.0, 1.0), Control::NormalForce(1.0));
    let pressing = PressingLoad::new(pressing, 1.0).expect("a valid load");
    let [body, sharp] = [paraboloid(0.3), cone(0.3)];
    let whole = Unmirrored(&body);
    let [few, some, more] = [8, 28, 96].map(Accuracy::Elements);
    let materials = every_kind_of_material().into_iter();
    for (name, material) in materials.filter(|(name, _)| name.starts_with(['e', 'v', 't'])) {
        let material = &*material;
        let stated = steady_memory(&body, &material, &load, 28);
        let solve = || steady(&body, &material, &load, some);
        check(("steady", name), stated, solve);
        let stated = steady_memory(&whole, &material, &load, 28);
        let solve = || steady(&whole, &material, &load, some);
        check(("whole", name), stated, solve);
        let stated = indent_memory(&body, &material, &pressing, 96);
        let solve = || indent(&body, &material, &pressing, more);
        check(("indent", name), stated, solve);
        let load = after(load, 30.0);
        let stated = slide_memory(&sharp, &material, &load, 8);
        let solve = || slide(&sharp, &material, &load, few);
        check(("slide", name), stated, solve);
    }
}

/// Elements of a periodic surface are those along its longer edge; with too few its waves are not resolved.
#[cfg(feature = "rough")]
#[test]
fn a_period_is_solved_on_the_elements_asked_for() {
    use bem_halfspace::PeriodicLoad;
    use bem_halfspace::periodic::{memory, steady};
    use indenters::rough::{PeriodicSurface, Wave};

    use crate::support::{assert_bars_agree, assert_refused, prony};
    let wave = |numbers| Wave {
        numbers,
        amplitude: 0.01,
        phase: 0.3,
    };
    let waves = vec![wave([1, 1]), wave([2, 3])];
    let surface = PeriodicSurface::new([2.0, 1.0], waves).expect("a surface");
    let solid = prony([1.0, 0.0], &[(9.0, 1.0)]);
    let load = PeriodicLoad::new(0.03, 0.3).expect("a load");
    let on = |elements| steady(&surface, &solid, &load, Accuracy::Elements(elements));
    check(("steady", "period"), memory(&surface, 512), || on(512));
    let [coarse, fine] = [132, 512].map(|elements| on(elements).expect("a state"));
    assert_eq!(coarse.finest.pressure.grid.shape(), [132, 132], "shape");
    assert_bars_agree(
        "friction",
        coarse.friction_coefficient,
        fine.friction_coefficient,
    );
    assert_refused("few", on(127), "PeriodTooCoarse");
    assert_refused("many", on(usize::MAX), "GridTooLarge");
}
