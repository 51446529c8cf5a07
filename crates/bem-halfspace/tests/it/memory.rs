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
    let [few, forty, more] = [12, 40, 160].map(Accuracy::Elements);
    let materials = every_kind_of_material().into_iter();
    for (name, material) in materials.filter(|(name, _)| name.starts_with(['e', 'v', 't'])) {
        let material = &*material;
        let stated = steady_memory(&body, material, &load, 40);
        let solve = || steady(&body, material, &load, forty);
        check(("steady", name), stated, solve);
        let stated = steady_memory(&whole, material, &load, 40);
        let solve = || steady(&whole, material, &load, forty);
        check(("whole", name), stated, solve);
        let stated = indent_memory(&body, material, &pressing, 160);
        let solve = || indent(&body, material, &pressing, more);
        check(("indent", name), stated, solve);
        let load = after(load, 30.0);
        let stated = slide_memory(&sharp, material, &load, 12);
        let solve = || slide(&sharp, material, &load, few);
        check(("slide", name), stated, solve);
    }
}
