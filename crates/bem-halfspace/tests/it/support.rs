//! Grids, contact problems and sliding scenes that several claims share.

use bem_halfspace::indent::{IndentRow, IndentStep, indent_history_on_grid};
use bem_halfspace::slide::{Transient, slide_on_grid};
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution,
    Footprint, Grid, GridOptions, solve_contact,
};
use indenters::{PowerProfile, SlidingLoad, Surface};
use rheology::{Compressible, Material, Prony, RelaxationBranch, RelaxationSpectrum, Viscous};

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

    /// A body with the given heights on unit elements.
    pub(crate) fn on_unit_elements(shape: [usize; 2], heights: &[f64]) -> Self {
        let grid = Grid::new(shape, [1.0; 2]).expect("a valid grid");
        Self {
            heights: heights.to_vec(),
            ..Self::new(Convolution::new(&grid), |_| 0.0)
        }
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

/// The largest difference of two fields relative to the largest expected value.
pub(crate) fn difference(actual: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(actual.len(), expected.len(), "fields of one grid");
    let largest = expected.iter().fold(0.0, |top: f64, u| top.max(u.abs()));
    let differences = actual.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / largest
}

/// A small whole number among the inputs of a case.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small counts"
)]
pub(crate) fn count(case: &casebook::Case, name: &str) -> usize {
    case.input(name) as usize
}

/// A body without symmetry, and its mirror image in y.
pub(crate) struct Skewed {
    pub(crate) body: PowerProfile,
    /// 1 or −1.
    pub(crate) handedness: f64,
}

impl Surface for Skewed {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        let y = self.handedness * y;
        self.body.height([x + 0.4 * y, 1.3 * y])
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let y = self.handedness * y;
        let [along, across] = self.body.gradient([x + 0.4 * y, 1.3 * y]);
        [along, self.handedness * (0.4 * along + 1.3 * across)]
    }
}

/// A power profile h = c r^p on a viscous half space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene {
    pub(crate) body: PowerProfile,
    pub(crate) material: Viscous,
    pub(crate) load: SlidingLoad,
}

impl Scene {
    pub(crate) fn new(
        [coefficient, exponent]: [f64; 2],
        viscosity: f64,
        [force, velocity]: [f64; 2],
    ) -> Self {
        Self {
            body: PowerProfile::new(coefficient, exponent).expect("a valid profile"),
            material: Viscous::new(viscosity).expect("a valid material"),
            load: SlidingLoad::new(force, velocity).expect("a valid load"),
        }
    }

    /// Every number of order one.
    pub(crate) fn unit(exponent: f64) -> Self {
        Self::new([0.3, exponent], 2.0, [0.5, 0.7])
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
        let footprint = Footprint::sliding(&self.body, &self.material, &self.load);
        GridOptions::new([spacing, spacing], footprint.expect("a footprint"))
    }

    /// The load after sliding over `lengths` of the contact length.
    pub(crate) fn load_over(&self, lengths: f64) -> SlidingLoad {
        let load = self.load.after(lengths * self.contact_length());
        load.expect("a distance")
    }

    pub(crate) fn slide(&self, elements: f64, lengths: f64) -> Transient {
        let (load, options) = (self.load_over(lengths), self.options(elements));
        slide_on_grid(&self.body, &self.material, &load, &options).expect("a transient")
    }
}

/// The depths of a body under a constant force at some times, on one grid.
pub(crate) fn pressed(
    body: &dyn Surface,
    material: &dyn Material,
    (force, times): (f64, &[f64]),
    options: &GridOptions,
) -> Vec<IndentRow> {
    let steps = IndentStep::constant(Control::NormalForce(force), times);
    indent_history_on_grid(body, material, &steps, options).expect("an indentation")
}

/// A material from its relaxation: lone spring \[Pa], lone dashpot \[Pa s], and (modulus, time) of the branches.
pub(crate) fn prony([equilibrium_modulus, viscosity]: [f64; 2], branches: &[(f64, f64)]) -> Prony {
    let branches = branches
        .iter()
        .map(|&(modulus, relaxation_time)| RelaxationBranch {
            modulus,
            relaxation_time,
        });
    let relaxation = RelaxationSpectrum::new(equilibrium_modulus, viscosity, branches.collect());
    Prony::new(relaxation.expect("moduli")).expect("a material")
}

/// The materials that the casebook gives by their moduli, or by the name alone.
pub(crate) fn material_of(case: &casebook::Case) -> Prony {
    if !case.has_input("Ge") {
        assert_eq!(
            case.input_text("model"),
            "P3",
            "the one model without moduli"
        );
        return three_branches();
    }
    let [moduli, times] = ["G", "tau"].map(|name| case.input_list(name));
    let branches: Vec<(f64, f64)> = moduli.into_iter().zip(times).collect();
    let viscosity = if case.has_input("eta") {
        case.input("eta")
    } else {
        0.0
    };
    prony([case.input("Ge"), viscosity], &branches)
}

/// Model P3 of the casebook: relaxation times over nine decades.
pub(crate) fn three_branches() -> Prony {
    prony([1e5, 0.0], &[(5e8, 1e-6), (2e7, 0.01), (3e5, 1e3)])
}

/// One material of each kind, with moduli and times of order one.
pub(crate) fn every_kind_of_material() -> Vec<(&'static str, Box<dyn Material>)> {
    let glassy = prony([0.4, 0.0], &[(2.0, 0.3), (1.0, 2.0)]);
    vec![
        ("elastic", Box::new(prony([1.5, 0.0], &[]))),
        ("viscous", Box::new(prony([0.0, 2.0], &[]))),
        ("Kelvin-Voigt", Box::new(prony([0.7, 1.1], &[]))),
        ("Maxwell", Box::new(prony([0.0, 0.0], &[(2.0, 0.6)]))),
        ("three elements", Box::new(prony([0.3, 0.0], &[(3.0, 0.4)]))),
        (
            "compressible",
            Box::new(Compressible::new(&glassy, 0.3).expect("a Poisson ratio")),
        ),
        ("two branches", Box::new(glassy)),
    ]
}
