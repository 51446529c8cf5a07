//! The grids that a refinement starts from: footprint and approximate contact length from surface, material and load.

use indenters::{Axisymmetric, Control, SlidingLoad, Surface, line_radius};
use numerics::whole_part;

use crate::elements::footprint::{Footprint, MAX_HEIGHT_IN_DEPTH_SCALES};
use crate::elements::grid::whole_elements;
use crate::stationary::steady::depth_scale_of_surface;
use crate::substrate::base::MAX_EDGE_OVER_THICKNESS;
use crate::{BemError, Elastomer};

/// Largest fraction of the whole at which a feature has no say in the choice of grids: [`GridPlan::kinks`], the sum of the squared
/// jumps of the slope in contact relative to the squared slope at the end, and the load of a patch relative to that of the contact.
/// The small kinks of a tabulated profile are negligible, and the error estimates of a contact contain the effect of small patches.
/// Chosen; from 0 to 0.1 nothing changes (case of `evidence tuning`).
pub(crate) const NEGLIGIBLE_FRACTION: f64 = 0.01;
/// Number of elements along the contact length of the one-dimensional model on the coarsest grids. Chosen: with 4
/// bars are 0.3 to 3.9 times as wide, with 3 an answer leaves its bar (case of `evidence tuning`).
const ELEMENTS_ON_COARSEST_GRID: f64 = 5.0;
/// Largest edge of the coarsest elements in thicknesses of a layer. Derived: half of the edge that is refused, because nested
/// iteration and error estimates also solve on elements of up to twice the edge.
const MAX_SPACING_OVER_THICKNESS: f64 = 0.5 * MAX_EDGE_OVER_THICKNESS;
/// Largest number of cells of a height map along the contact at which elements resolve single cells and their edges. Chosen (case
/// of `evidence tuning`).
const MAX_VISIBLE_CELLS: f64 = 8.0;
/// Smallest jump of the slope between two cells of a height map that counts as an edge, as a fraction of the slope at the end of
/// the contact. Chosen (case of `evidence tuning`). With a smaller one, bodies without edges get the lower order and wider bars
/// of edges.
const MIN_EDGE_JUMP: f64 = 0.3;
/// Largest number of refinements of the coarsest grid by √2. Chosen to limit the time: the finest grid has 2¹² times as many
/// elements along the contact as the coarsest. Most refinements end earlier at the limit of unknowns.
pub(crate) const MAX_REFINEMENTS: i32 = 24;
/// Ratio of the contact length of a paraboloid in the one-dimensional model to the length on which it lies below the depth.
/// Derived: the equivalent line of r² is 2 x², so that it has the depth at 1/√2 of the distance.
const CONTACT_OVER_INTERSECTION_LENGTH: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Plan of the grids on which a surface is solved.
pub(crate) struct GridPlan {
    /// Rectangle in which contact may occur.
    pub(crate) footprint: Footprint,
    /// Element length Δx of the coarsest grids, \[m].
    pub(crate) coarsest_spacing: f64,
    /// Exponent p of the sharpest point h ∼ r^p in contact; 2 or more for a smooth surface.
    pub(crate) apex_exponent: f64,
    /// Sum of the squared jumps of the slope in contact over the squared slope at the end of the contact, at most 1. The jumps are those
    /// at the edges of a body, or between the cells of a height map along the line through its lowest point.
    pub(crate) kinks: f64,
    /// True if elements resolve edges: those of a body, or those of single cells of a height map.
    pub(crate) has_edges: bool,
}

impl GridPlan {
    /// Plan of footprint and spacings for a body that slides under a load.
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
        let mut plan = Self::with_pile_up(surface, elastomer, depth, |depth| {
            match surface.as_axisymmetric() {
                Some(body) => Self::of_body(body, footprint, depth),
                None => Ok(Self::of_surface(surface, footprint, depth)),
            }
        })?;
        plan.kinks = kinks(surface, depth, &footprint)?;
        plan.has_edges = plan.kinks > NEGLIGIBLE_FRACTION;
        if plan.has_edges {
            // A kink is as sharp as the apex of a cone, so that the exponent is at most 1.
            plan.apex_exponent = plan.apex_exponent.min(1.0);
        }
        if let Some(cells) = CellSlopes::new(surface, depth) {
            plan.kinks = cells.kinks();
            plan.has_edges = cells.are_visible();
        }
        Ok(plan)
    }

    /// Plan of footprint and spacings for a body that is pressed under a force or to a depth, without sliding.
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
        let footprint = Footprint::of_contact_below(surface, elastomer, highest)?;
        Self::with_pile_up(surface, elastomer, depth, |depth| {
            Ok(Self::of_surface(surface, footprint, depth))
        })
    }

    /// The `plan(depth)` for a half space, with the longer elements of the longer contact on a layer, which piles up. Elements longer
    /// than [`MAX_SPACING_OVER_THICKNESS`] allows are taken only if those for a half space are as long.
    fn with_pile_up(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        depth: f64,
        plan: impl Fn(f64) -> Result<Self, BemError>,
    ) -> Result<Self, BemError> {
        // Take the longer one of two spacings: that for the contact without pile-up, and that with it, which the thickness
        // limits.
        let mut shortest = plan(depth)?;
        let with_pile_up =
            plan(Footprint::with_pile_up(surface, elastomer, depth)?)?.coarsest_spacing;
        let longest = MAX_SPACING_OVER_THICKNESS * elastomer.base().thickness();
        shortest.coarsest_spacing = shortest.coarsest_spacing.max(with_pile_up.min(longest));
        Ok(shortest)
    }

    /// The plan for a body of revolution at a `depth` \[m] in the one-dimensional model, whose contact length determines the spacing.
    fn of_body(
        body: &dyn Axisymmetric,
        footprint: Footprint,
        depth: f64,
    ) -> Result<Self, BemError> {
        let spacing = line_radius(body, depth)? / ELEMENTS_ON_COARSEST_GRID;
        Ok(Self::smooth(footprint, spacing, body.profile_exponent()))
    }

    /// The plan for any surface at a `depth` \[m]; the length on which it lies below that depth determines the spacing.
    fn of_surface(surface: &dyn Surface, footprint: Footprint, depth: f64) -> Self {
        let [rear, front] = surface.extent_below(depth)[0];
        let radius = CONTACT_OVER_INTERSECTION_LENGTH * (0.5 * (front - rear));
        let spacing = radius / ELEMENTS_ON_COARSEST_GRID;
        Self::smooth(footprint, spacing, surface.apex_exponent())
    }

    /// The plan for a surface without kinks.
    pub(crate) const fn smooth(
        footprint: Footprint,
        coarsest_spacing: f64,
        apex_exponent: f64,
    ) -> Self {
        Self {
            footprint,
            coarsest_spacing,
            apex_exponent,
            kinks: 0.0,
            has_edges: false,
        }
    }

    /// Element length Δx after a number of refinements by √2, \[m].
    pub(crate) fn spacing(&self, refinement: i32) -> f64 {
        self.coarsest_spacing * 2.0_f64.powf(-0.5 * f64::from(refinement))
    }

    /// Approximate number of elements along the contact after a number of refinements by √2.
    pub(crate) fn elements(&self, refinement: i32) -> usize {
        whole_elements((self.length() / self.spacing(refinement)).ceil()).unwrap_or(usize::MAX)
    }

    /// Approximate contact length in sliding, \[m]: that of the one-dimensional model. Under a pressed body it is half the contact
    /// length.
    pub(crate) fn length(&self) -> f64 {
        ELEMENTS_ON_COARSEST_GRID * self.coarsest_spacing
    }
}

/// Slopes along x of the cells of a height map at y = 0, on which it dips to a depth.
struct CellSlopes {
    /// Slopes of the cells from the rear to the front.
    slopes: Vec<f64>,
    /// Number of cells behind the lowest point.
    n_behind: usize,
}

impl CellSlopes {
    /// The slopes of a surface that dips to `depth` \[m]; `None` if it has no cells.
    fn new(surface: &dyn Surface, depth: f64) -> Option<Self> {
        let length = surface.cell_length()?;
        let [behind, ahead] =
            surface.extent_below(depth)[0].map(|end| whole_part((end / length).round().abs()));
        let position = |cell: usize| cell as f64 - behind as f64 + 0.5;
        let slope = |cell: usize| surface.gradient([position(cell) * length, 0.0])[0];
        Some(Self {
            slopes: (0..behind + ahead).map(slope).collect(),
            n_behind: behind,
        })
    }

    /// Jumps of the slope between two cells away from the lowest point, as fractions of the steeper one of the slopes at both ends.
    fn relative_jumps(&self) -> impl Iterator<Item = f64> {
        let ends = [self.slopes.first(), self.slopes.last()];
        let steepest = ends
            .into_iter()
            .flatten()
            .fold(0.0, |steepest: f64, slope| steepest.max(slope.abs()));
        let jumps = self.slopes.windows(2).enumerate();
        jumps
            .filter(|(index, _)| index + 1 != self.n_behind)
            .map(|(_, pair)| pair[1] - pair[0])
            .filter(|jump| *jump != 0.0)
            .map(move |jump| jump / steepest)
    }

    /// Measure [`GridPlan::kinks`] of the cells.
    fn kinks(&self) -> f64 {
        let squares = self.relative_jumps().map(|jump| jump.powi(2));
        squares.sum::<f64>().min(1.0)
    }

    /// True if the contact lies on a few cells, and the slope jumps between two of them away from the lowest point. Elements then
    /// resolve an edge like that of a flat end.
    fn are_visible(&self) -> bool {
        self.slopes.len() as f64 <= MAX_VISIBLE_CELLS
            && self.relative_jumps().any(|jump| jump.abs() > MIN_EDGE_JUMP)
    }
}

/// Measure [`GridPlan::kinks`] of a body at a `depth` \[m], for the kinks inside its footprint; 0 for surfaces other than bodies of
/// revolution.
pub(crate) fn kinks(
    surface: &dyn Surface,
    depth: f64,
    footprint: &Footprint,
) -> Result<f64, BemError> {
    let Some(body) = surface.as_axisymmetric() else {
        return Ok(0.0);
    };
    // Add up the squared jumps of the slope inside the footprint, to compare them with the squared slope at the end of the
    // contact.
    let jumps: f64 = body
        .kinks()
        .into_iter()
        .filter(|kink| kink.radius < footprint.x[1])
        .map(|kink| kink.slope_jump.powi(2))
        .sum();
    if jumps == 0.0 {
        return Ok(0.0);
    }
    let slope = body.profile(line_radius(body, depth)?).slope;
    Ok((jumps / slope.powi(2)).min(1.0))
}
