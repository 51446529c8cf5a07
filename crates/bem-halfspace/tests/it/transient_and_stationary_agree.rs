//! The march in time and the direct stationary solution, two methods with nothing in common but the elements, arrive
//! at the same friction, outline and depth.

use bem_halfspace::slide::{Transient, slide_on_grid};
use bem_halfspace::steady::{SteadyOptions, SteadySliding, steady, steady_on_grid};
use bem_halfspace::{Footprint, GridOptions};
use indenters::{PowerProfile, SlidingLoad, Surface};
use rheology::Viscous;

/// Δy/Δx, as in the direct solution.
const ASPECT: f64 = 0.5;
/// Sliding distances, the second four times the first.
const DISTANCES: [f64; 2] = [16.0, 64.0];
/// Shifts of the body against the grid, in elements. The outline follows the elements, which scatters the friction of
/// one grid by 1e-3; the mean over the shifts has a trend.
const SHIFTS: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

/// A surface that is shifted along x and y.
struct Shifted<'surface, S> {
    surface: &'surface S,
    shift: [f64; 2],
}

impl<S: Surface> Surface for Shifted<'_, S> {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        self.surface.height([x + self.shift[0], y + self.shift[1]])
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.surface
            .gradient([x + self.shift[0], y + self.shift[1]])
    }
}

/// An elliptic paraboloid that slides along none of its axes: no symmetry is left.
struct Skew;

impl Surface for Skew {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        x * x + 0.6 * x * y + 0.6 * y * y
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x + 0.6 * y, 0.6 * x + 1.2 * y]
    }

    fn apex_exponent(&self) -> f64 {
        2.0
    }
}

/// A surface on the half space on which F_N/(4ηv) is 1.
struct Scene<'surface, S> {
    surface: &'surface S,
    footprint: Footprint,
    /// Elements per unit of length of the coarser of the two grids from which the march is extrapolated.
    elements: f64,
}

impl<S: Surface> Scene<'_, S> {
    fn material_and_load() -> (Viscous, SlidingLoad) {
        let material = Viscous::new(1.0).expect("a material");
        (material, SlidingLoad::new(4.0, 1.0).expect("a load"))
    }

    fn march(&self, elements: f64, shift: [f64; 2], sliding_distance: f64) -> Transient {
        let (material, load) = Self::material_and_load();
        let spacing = 1.0 / elements;
        let load = load.after(sliding_distance).expect("a distance");
        let options = GridOptions::new([spacing, ASPECT * spacing], self.footprint);
        let surface = Shifted {
            surface: self.surface,
            shift: [shift[0] * spacing, shift[1] * ASPECT * spacing],
        };
        slide_on_grid(&surface, &material, &load, &options).expect("a transient")
    }

    /// In the march the body is half an element further at the end of a step than in its middle.
    fn direct(&self, elements: f64) -> SteadySliding {
        let (material, load) = Self::material_and_load();
        let options = SteadyOptions {
            phase: [0.5, 0.0],
            ..SteadyOptions::new([1.0 / elements, ASPECT / elements], self.footprint)
        };
        steady_on_grid(self.surface, &material, &load, &options).expect("a stationary state")
    }

    /// Stationary friction of the march: its grids extrapolated at one distance over a factor of two in the spacing,
    /// and the change from that distance to infinity on the coarse grid.
    fn extrapolated_march(&self) -> f64 {
        let order = (2.0 * self.surface.apex_exponent() - 1.0).min(1.5);
        let friction = |elements: f64, shift: [f64; 2]| {
            let march = self.march(elements, shift, DISTANCES[0]);
            march.last().friction_coefficient
        };
        let [coarse, fine] = [self.elements, 2.0 * self.elements].map(|elements| {
            let values = SHIFTS.map(|shift| friction(elements, shift));
            0.25 * values.iter().sum::<f64>()
        });
        let far = self.march(self.elements, SHIFTS[0], DISTANCES[1]);
        let near = &far.rows[far.rows.len() / 4 - 1];
        let limit = far.stationary(0.05).expect("a stationary state");
        fine + (fine - coarse) / (order.exp2() - 1.0) + limit.friction_coefficient
            - near.friction_coefficient
    }

    fn check(&self, name: &str) {
        let (material, load) = Self::material_and_load();
        let direct = steady(self.surface, &material, &load, 2e-4).expect("a friction coefficient");
        let direct = direct.friction_coefficient.value;
        let march = self.extrapolated_march();
        assert!(
            (march / direct - 1.0).abs() < 5e-4,
            "{name}: friction {march} of the march, {direct} directly"
        );
        for elements in [self.elements, 2.0 * self.elements] {
            self.check_state(
                name,
                elements,
                &self.march(elements, [0.0, 0.0], DISTANCES[0]),
            );
        }
    }

    /// Outline to one element, and depth to terms of the order (contact length)/(sliding distance), of one grid.
    fn check_state(&self, name: &str, elements: f64, march: &Transient) {
        let (direct, last) = (self.direct(elements), march.last());
        let shift = 0.5 / elements;
        let bounds = [
            [last.contact_x[0] + shift, direct.contact_x[0]],
            [last.contact_x[1] + shift, direct.contact_x[1]],
            [last.contact_y[0], direct.contact_y[0]],
            [last.contact_y[1], direct.contact_y[1]],
        ];
        for [march, direct] in bounds {
            assert!(
                (march - direct).abs() < 1.01 / elements,
                "{name}, {elements} elements: bound {march} of the march, {direct} directly"
            );
        }
        let depth = direct.depth.after(last.sliding_distance).expect("a depth");
        let allowed = 2.0 * direct.depth.depth_per_e_fold / last.sliding_distance;
        assert!(
            (last.indentation_depth - depth).abs() < allowed,
            "{name}, {elements} elements: depth {} of the march, {depth} directly, allowed {allowed}",
            last.indentation_depth
        );
    }
}

#[test]
fn the_cone_slides_alike_in_both() {
    let cone = PowerProfile::cone(1.0).expect("a cone");
    Scene {
        surface: &cone,
        footprint: Footprint::square(1.6),
        elements: 10.0,
    }
    .check("cone");
}

#[test]
fn the_paraboloid_slides_alike_in_both() {
    let paraboloid = PowerProfile::paraboloid(1.0).expect("a paraboloid");
    Scene {
        surface: &paraboloid,
        footprint: Footprint::square(1.4),
        elements: 7.0,
    }
    .check("paraboloid");
}

#[test]
fn a_skew_body_slides_alike_in_both() {
    Scene {
        surface: &Skew,
        footprint: Footprint::square(2.2),
        elements: 7.0,
    }
    .check("skew paraboloid");
}
