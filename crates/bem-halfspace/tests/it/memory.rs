//! What a solution takes in memory is known before, within a factor.

use bem_halfspace::indent::indent_memory;
use bem_halfspace::slide::slide_memory;
use bem_halfspace::steady::steady_memory;
use bem_halfspace::{Control, PressingLoad, indent, slide, steady};
use indenters::Unmirrored;
use numerics::Accuracy;

use crate::support::{cone, every_kind_of_material, paraboloid, under_force};

/// What was allocated at the same time, on this thread.
#[cfg(feature = "rayon")]
fn taken(solve: impl FnOnce() + Send) -> f64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let measure = || allocation_counter::measure(solve).bytes_max as f64;
    pool.expect("a pool").install(measure)
}

#[cfg(not(feature = "rayon"))]
fn taken(solve: impl FnOnce()) -> f64 {
    allocation_counter::measure(solve).bytes_max as f64
}

/// Not more is taken than stated, and not much less.
#[track_caller]
fn assert_within(what: &str, taken: f64, stated: f64) {
    let holds = taken <= stated && stated <= 6.0 * taken;
    assert!(holds, "{what}: {taken:e} bytes, and {stated:e} were stated");
}

#[test]
fn stated_memory_is_what_a_solution_takes() {
    let (load, pressing) = (under_force(1.0, 1.0), Control::NormalForce(1.0));
    let pressing = PressingLoad::new(pressing, 1.0).expect("a valid load");
    let [body, sharp] = [paraboloid(0.3), cone(0.3)];
    let materials = every_kind_of_material().into_iter();
    for (name, material) in materials.filter(|(name, _)| name.starts_with(['e', 'v', 't'])) {
        let material = &*material;
        let stated = steady_memory(&body, material, &load, 40).expect("a grid");
        let forty = Accuracy::Elements(40);
        let solve = || drop(steady(&body, material, &load, forty).expect("a state"));
        assert_within(&format!("steady, {name}"), taken(solve), stated);
        let whole = Unmirrored(&body);
        let stated = steady_memory(&whole, material, &load, 40).expect("a grid");
        let solve = || drop(steady(&whole, material, &load, forty).expect("a state"));
        assert_within(&format!("without mirrors, {name}"), taken(solve), stated);
        let stated = indent_memory(&body, material, &pressing, 160).expect("a grid");
        let more = Accuracy::Elements(160);
        let solve = || drop(indent(&body, material, &pressing, more).expect("a state"));
        assert_within(&format!("indent, {name}"), taken(solve), stated);
        let load = load.after(30.0).expect("a distance");
        let stated = slide_memory(&sharp, material, &load, 12).expect("a grid");
        let few = Accuracy::Elements(12);
        let solve = || drop(slide(&sharp, material, &load, few).expect("a march"));
        assert_within(&format!("slide, {name}"), taken(solve), stated);
    }
}
