//! Where contact may occur and how long it will be about, from surface, material and load: what a refinement starts from.

use indenters::{Axisymmetric, Control, SlidingLoad, Surface, contact_radius};

use crate::elements::footprint::{Footprint, MAX_HEIGHT_IN_DEPTH_SCALES};
use crate::elements::grid::whole_elements;
use crate::stationary::steady::depth_scale_of_surface;
use crate::{BemError, Elastomer};

/// Elements along the contact length of the one-dimensional model on the coarsest grids.
const COARSEST: f64 = 5.0;
/// Edge of the coarsest elements in thicknesses of a layer; twice as long ones are refused.
const THICKNESSES: f64 = 16.0;
/// Jumps of the slope above this part of it, squared, decide how fast errors fall; the small ones of a table do not.
pub(crate) const NEGLIGIBLE_KINKS: f64 = 0.01;
/// Cells of a height map along the contact and one beyond either end of it; more of them are small, and their edges with them.
const MANY_CELLS: f64 = 8.0;
/// Jump of the slope between two cells, as a part of the slope at the end of the contact, that is an edge.
const LARGE_JUMP: f64 = 0.3;
/// Height that is left of a steep flank one element further in, at least, on the coarsest grids.
const RESOLVED: f64 = 0.3;
/// Refinements by √2 at most; the limit of unknowns ends most before.
pub(crate) const MAX_REFINEMENTS: i32 = 24;
/// Contact length of the one-dimensional model of a paraboloid over the length on which it is below a depth scale.
const SHORTER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The grids on which a surface is solved.
pub(crate) struct GridPlan {
    pub(crate) footprint: Footprint,
    /// Δx of the coarsest grids, \[m].
    pub(crate) coarsest_spacing: f64,
    /// p of the sharpest point h ∼ r^p in contact; 2 or more for a smooth surface.
    pub(crate) apex_exponent: f64,
    /// Sum of the squares of the jumps of the slope in contact over the square of the slope at its end, at most 1.
    pub(crate) kinks: f64,
    /// Whether the contact lies on a few cells of a height map whose slopes differ much.
    pub(crate) shows_cells: bool,
}

impl GridPlan {
    /// For a body that slides.
    pub(crate) fn sliding(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let depth = match load.control() {
            Control::NormalForce(_) => depth_scale_of_surface(surface, elastomer, load)?,
            Control::IndentationDepth(depth) => depth,
        };
        let footprint = Footprint::sliding(surface, elastomer, load)?;
        let mut plan = Self::risen(surface, elastomer, depth, |depth| {
            match surface.as_axisymmetric() {
                Some(body) => Self::of_body(body, footprint, depth),
                None => Ok(Self::of_surface(surface, footprint, depth)),
            }
        })?;
        plan.kinks = kinks(surface, depth, &footprint)?;
        plan.shows_cells = shows_cells(surface, depth);
        if plan.kinks > NEGLIGIBLE_KINKS {
            // Each is as sharp as a cone.
            plan.apex_exponent = plan.apex_exponent.min(1.0);
        }
        Ok(plan)
    }

    /// For a body that is pressed into an elastic material.
    pub(crate) fn pressed(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        control: Control,
    ) -> Result<Self, BemError> {
        let [depth, highest] = match control {
            Control::NormalForce(force) => {
                let load = SlidingLoad::new(force, 1.0)?;
                let depth = depth_scale_of_surface(surface, elastomer, &load)?;
                [depth, MAX_HEIGHT_IN_DEPTH_SCALES * depth]
            }
            Control::IndentationDepth(depth) => [depth; 2],
        };
        let footprint = Footprint::reached(surface, elastomer, highest)?;
        Self::risen(surface, elastomer, depth, |depth| {
            Ok(Self::of_surface(surface, footprint, depth))
        })
    }

    /// The plan for the longer contact with a layer that rises, but with elements that are not too long for its thickness
    /// unless those for a half space are.
    fn risen(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        depth: f64,
        plan: impl Fn(f64) -> Result<Self, BemError>,
    ) -> Result<Self, BemError> {
        let mut shortest = plan(depth)?;
        let risen = plan(Footprint::risen(surface, elastomer, depth)?)?.coarsest_spacing;
        let longest = THICKNESSES * elastomer.base().thickness();
        shortest.coarsest_spacing = shortest.coarsest_spacing.max(risen.min(longest));
        Ok(shortest)
    }

    fn of_body(
        body: &dyn Axisymmetric,
        footprint: Footprint,
        depth: f64,
    ) -> Result<Self, BemError> {
        let mut plan = Self {
            footprint,
            coarsest_spacing: contact_radius(body, depth)? / COARSEST,
            apex_exponent: body.profile_exponent(),
            kinks: 0.0,
            shows_cells: false,
        };
        // Where a steep flank is as long as an element, elements stand for nothing, and their contact is hard to find.
        let [_, radius] = plan.footprint.x;
        let flank_is_resolved = |refinement: &i32| {
            let inside = (radius - plan.spacing(*refinement)).max(0.0);
            body.profile_height(inside) >= RESOLVED * body.profile_height(radius)
        };
        if let Some(first) = (0..MAX_REFINEMENTS).find(flank_is_resolved) {
            plan.coarsest_spacing = plan.spacing(first);
        }
        Ok(plan)
    }

    /// For a surface whose contact is about as long as the surface is below `depth`, \[m].
    fn of_surface(surface: &dyn Surface, footprint: Footprint, depth: f64) -> Self {
        let [rear, front] = surface.extent_below(depth)[0];
        Self {
            footprint,
            coarsest_spacing: SHORTER * (0.5 * (front - rear)) / COARSEST,
            apex_exponent: surface.apex_exponent(),
            kinks: 0.0,
            shows_cells: false,
        }
    }

    /// Δx after so many refinements by √2, \[m].
    pub(crate) fn spacing(&self, refinement: i32) -> f64 {
        self.coarsest_spacing * 2.0_f64.powf(-0.5 * f64::from(refinement))
    }

    /// Elements along the contact, about, after so many refinements.
    pub(crate) fn elements(&self, refinement: i32) -> usize {
        whole_elements((self.length() / self.spacing(refinement)).ceil()).unwrap_or(usize::MAX)
    }

    /// Contact length, about, \[m].
    pub(crate) fn length(&self) -> f64 {
        COARSEST * self.coarsest_spacing
    }
}

/// Whether a surface that dips to a depth does so on a few cells, and its slope along x jumps between two of them beside the lowest
/// point: elements then see an edge as that of a flat end.
fn shows_cells(surface: &dyn Surface, depth: f64) -> bool {
    let Some(length) = surface.cell_length() else {
        return false;
    };
    let [rear, front] = surface.extent_below(depth)[0].map(|end| (end / length).round());
    if front - rear > MANY_CELLS {
        return false;
    }
    let slope = |cell: f64| surface.gradient([(cell + 0.5) * length, 0.0])[0];
    let largest = slope(rear).abs().max(slope(front - 1.0).abs());
    let inside = (1..).map(|step| rear + f64::from(step));
    inside
        .take_while(|cell| *cell < front)
        .filter(|cell| cell.abs() > 0.5)
        .any(|cell| (slope(cell) - slope(cell - 1.0)).abs() > LARGE_JUMP * largest)
}

/// How much of the slope of a body that dips to a depth is jumps, as [`GridPlan::kinks`], where contact may occur.
pub(crate) fn kinks(
    surface: &dyn Surface,
    depth: f64,
    footprint: &Footprint,
) -> Result<f64, BemError> {
    let Some(body) = surface.as_axisymmetric() else {
        return Ok(0.0);
    };
    let inside = body.kinks().into_iter();
    let inside = inside.filter(|kink| kink.radius < footprint.x[1]);
    let jumps: f64 = inside.map(|kink| kink.slope_jump.powi(2)).sum();
    if jumps == 0.0 {
        return Ok(0.0);
    }
    let slope = body.profile(contact_radius(body, depth)?).slope;
    Ok((jumps / slope.powi(2)).min(1.0))
}
