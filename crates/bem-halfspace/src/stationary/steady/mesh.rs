//! The stationary problem on a grid: the candidate elements, their heights, kernel and symmetry.
//!
//! On a dashpot of the viscosity η, sliding at the speed v, the surface sinks by ∫w/(ηv) dx under the load potential w. Between
//! the rear edges of two neighbouring elements the gap changes by this integral minus the rise of the body. Where the body does
//! not rise, the gap is therefore larger at the rear than at the front, and no element can touch. Only elements over which the
//! body rises are candidates. On any other material all elements that the body covers are.
//!
//! Theory: docs/theory/stationary-half-space.md, "Where the gap is evaluated".

use std::collections::BTreeSet;
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use indenters::{Surface, checked_height};
use numerics::{in_range, positive, whole_part};

use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;
use crate::stationary::steady::SteadyOptions;
use crate::stationary::steady::loading::{GridLoading, Loading};
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::wake_table::WakeTable;
use crate::{BemError, Grid};

/// A candidate: an element that may touch.
struct Element {
    /// Row in the footprint.
    row: usize,
    /// Column in the footprint.
    column: usize,
    /// Height at the collocation point, in units of the depth scale.
    height: f64,
    /// Mean of ∂h/∂x.
    slope: f64,
    /// Slope for the friction from dissipation: of a body with edges, that between the collocation points of the two neighbours.
    dissipating_slope: f64,
}

/// The problem on a grid. Heights are in units of the depth scale D and lengths in Δx. The load of an element is
/// 2 (1 − ν) J(Δx/v) P Δx/(4πD), which is P Δx²/(4πηvD) for the dashpot.
pub(super) struct Mesh {
    /// Grid and tolerance.
    pub(super) options: SteadyOptions,
    /// Creep, control and units on this grid.
    pub(super) loading: GridLoading,
    /// True if only elements over which the body rises are candidates.
    only_rising: bool,
    /// Rows and columns of the footprint.
    shape: [usize; 2],
    /// Position of row 0 and column 0 in elements from the lowest point.
    origin: [f64; 2],
    /// Mirror symmetry of grid and body in y.
    mirror: Mirror,
    /// Candidates, row by row.
    elements: Vec<Element>,
    /// True for each element of the footprint that ends in a vertical wall, row-major.
    walls: Vec<bool>,
    /// First and last row, and first and last column, between which the contact must lie.
    inner_limits: [[usize; 2]; 2],
    /// Influence coefficients by the offset of two elements.
    table: Arc<WakeTable>,
}

impl Mesh {
    /// Samples the surface on a grid.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for options out of range and a body that can touch nowhere; [`BemError::GridTooLarge`];
    /// [`BemError::Indenter`] for heights that are NaN or −∞; [`BemError::TrackTooShort`].
    pub(super) fn new(
        surface: &dyn Surface,
        loading: &Loading,
        options: &SteadyOptions,
        plans: &mut Plans,
    ) -> Result<Self, BemError> {
        positive("spacing along x", options.spacing[0])?;
        positive("spacing along y", options.spacing[1])?;
        for value in options.phase {
            let is_allowed = (-0.5..=0.5).contains(&value);
            in_range("phase", value, is_allowed, "between -1/2 and 1/2")?;
        }

        // Sample the body on the whole footprint. With a mirror symmetry only half of the candidates are kept.
        let [x, y] = options.phase;
        let [[behind, ahead], [right, left]] = options.footprint.elements(options.spacing)?;
        let mut mesh = Self {
            options: *options,
            loading: loading.on_grid(options.spacing)?,
            only_rising: loading.creep.only_flows(),
            shape: [behind + ahead + 1, right + left + 1],
            origin: [x - behind as f64, y - right as f64],
            mirror: Mirror::None,
            elements: Vec::new(),
            walls: Vec::new(),
            inner_limits: [[0, behind + ahead], [0, right + left]],
            table: Arc::default(),
        };
        // Refuse a grid that is too large before it is sampled.
        Grid::new(mesh.shape, options.spacing)?;
        mesh.sample(surface)?;
        if surface.mirrors()[1] {
            mesh.keep_half();
        }
        // A footprint without candidates has no contact, and is refused.
        let parameter = "number of elements of the footprint that may touch";
        positive(parameter, mesh.n_elements() as f64)?;

        // Tabulate the kernel for all offsets between two candidates.
        let candidates = mesh.region(0..mesh.n_elements());
        mesh.check_track(candidates.shape[0])?;
        mesh.table = plans.prepare(&mesh.loading.creep, mesh.aspect(), candidates.shape);
        Ok(mesh)
    }

    /// Fails with [`BemError::TrackTooShort`] for a track shorter than twice the `rows` of the candidates.
    fn check_track(&self, rows: usize) -> Result<(), BemError> {
        let needed = 2.0 * rows as f64;
        let dx = self.options.spacing[0];
        match self.loading.creep.track {
            Some(track) if track < needed => Err(BemError::TrackTooShort {
                track: track * dx,
                needed: needed * dx,
            }),
            _ => Ok(()),
        }
    }

    /// Rows and columns of the footprint.
    pub(super) const fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Number of candidates.
    pub(super) const fn n_elements(&self) -> usize {
        self.elements.len()
    }

    /// Bounding box of some candidates, given by their indices, with the indices of these candidates in it.
    pub(super) fn region(&self, elements: impl Iterator<Item = usize> + Clone) -> Region {
        Region::around(elements.map(|element| self.indices(element)))
    }

    /// Centre of a row (axis 0) or column (axis 1), relative to the lowest point, \[m].
    pub(super) fn centre(&self, axis: usize, index: usize) -> f64 {
        (self.origin[axis] + index as f64) * self.options.spacing[axis]
    }

    /// Centre of an element relative to the lowest point, \[m].
    pub(super) fn position(&self, element: usize) -> [f64; 2] {
        let Element { row, column, .. } = self.elements[element];
        [self.centre(0, row), self.centre(1, column)]
    }

    /// Samples the surface at all elements of the footprint, and collects the candidates and the walls.
    fn sample(&mut self, surface: &dyn Surface) -> Result<(), BemError> {
        let dx = self.options.spacing[0];
        for row in 0..self.shape[0] {
            for column in 0..self.shape[1] {
                // Evaluate the heights at the rear edge, the collocation point and the front edge of the element.
                let [x, y] = [self.centre(0, row), self.centre(1, column)];
                let shifts = [-0.5, self.loading.creep.collocation_shift, 0.5];
                let positions = shifts.map(|shift| [x + shift * dx, y]);
                let heights = positions.map(|position| surface.height(position));
                let [rear, height, front] = heights;
                // A body may end, with infinite height, but not be undefined.
                for (height, position) in heights.into_iter().zip(positions) {
                    checked_height(height, position)?;
                }
                self.walls
                    .push(front.is_infinite() || !self.only_rising && rear.is_infinite());
                // An element can be in contact only if the body covers all of it. A dashpot alone carries load only where the body
                // presses it down, so that the profile is higher at the front than at the rear.
                let covered = heights.iter().all(|height| height.is_finite());
                if covered && (front > rear || !self.only_rising) {
                    let [height, slope] = [height / self.loading.depth_scale, (front - rear) / dx];
                    let dissipating_slope =
                        self.dissipating_slope(surface, [x, y]).unwrap_or(slope);
                    self.elements.push(Element {
                        row,
                        column,
                        height,
                        slope,
                        dissipating_slope,
                    });
                }
            }
        }
        Ok(())
    }

    /// Keeps the candidates at y ≥ 0 of a surface with a mirror symmetry in y, if the grid has it too.
    fn keep_half(&mut self) {
        self.mirror = match self.options.phase[1].abs() {
            0.0 => Mirror::Centre,
            0.5 => Mirror::Edge,
            _ => return,
        };
        // The image of a candidate must be inside the footprint: the shorter side limits both.
        let origin = self.origin[1];
        let has_image = |column: usize| 2.0 * (origin + column as f64) <= column as f64;
        self.elements
            .retain(|element| origin + element.column as f64 >= 0.0 && has_image(element.column));
        let mut columns = (0..self.shape[1]).rev();
        let last = columns.find(|&column| has_image(column)).unwrap_or(0);
        self.inner_limits[1] = [self.image_column(last), last];
    }

    /// Column of the mirror image of `column`.
    fn image_column(&self, column: usize) -> usize {
        // The distance between the two is an integer, because the phase is 0 or 1/2.
        let distance = 2.0 * (self.origin[1] + column as f64);
        column - whole_part(distance.round())
    }

    /// True if an element has a mirror image in y other than itself, which carries the same load.
    fn has_image(&self, element: &Element) -> bool {
        match self.mirror {
            Mirror::None => false,
            Mirror::Centre => self.image_column(element.column) != element.column,
            Mirror::Edge => true,
        }
    }

    /// Influence coefficient K: displacement of the candidate `to` by the unit load of the candidate `from` and of its mirror image, in
    /// units of the depth scale.
    pub(super) fn influence(&self, to: usize, from: usize) -> f64 {
        let [to, from] = [&self.elements[to], &self.elements[from]];
        let rows = to.row.cast_signed() - from.row.cast_signed();
        self.influence_at_offset(rows, to, from)
    }

    /// Influence coefficient of two candidates as if their offset along x were `rows`, positive ahead of the load.
    fn influence_at_offset(&self, rows: isize, to: &Element, from: &Element) -> f64 {
        let columns = to.column.abs_diff(from.column);
        let direct = self.table.displacement(rows, columns);
        if !self.has_image(from) {
            return direct;
        }
        direct
            + self
                .table
                .displacement(rows, to.column - self.image_column(from.column))
    }

    /// Creep under the unit load of an element within the element. It is greater than zero, while the displacement itself has an
    /// undetermined constant on a material that flows.
    pub(super) fn self_creep(&self) -> f64 {
        self.table.creep_within_element(0, 0)
    }

    /// Second difference k₀ − (k₁ + k₋₁)/2 of the kernel at the loaded element, along an axis.
    pub(super) fn kernel_second_difference(&self, axis: usize) -> f64 {
        let neighbours = match axis {
            0 => 0.5 * (self.table.displacement(1, 0) + self.table.displacement(-1, 0)),
            _ => self.table.displacement(0, 1),
        };
        self.table.displacement(0, 0) - neighbours
    }

    /// Influence coefficient of two candidates for the reversed motion, an entry of Kᵀ.
    pub(super) fn reversed_influence(&self, to: usize, from: usize) -> f64 {
        let [to, from] = [&self.elements[to], &self.elements[from]];
        let rows = from.row.cast_signed() - to.row.cast_signed();
        self.influence_at_offset(rows, to, from)
    }

    /// Row and column of an element and of its mirror image; twice its own for an element without one.
    pub(super) fn indices(&self, element: usize) -> [[usize; 2]; 2] {
        let Element { row, column, .. } = self.elements[element];
        let has_image = self.has_image(&self.elements[element]);
        let image = has_image.then(|| self.image_column(column));
        [[row, column], [row, image.unwrap_or(column)]]
    }

    /// The given candidates and those that have an edge or a corner in common with one of them, in increasing order.
    pub(super) fn with_neighbours(&self, elements: &[usize]) -> Vec<usize> {
        // Collect the candidates among the nine elements around each given one; a set removes duplicates and sorts them.
        let neighbours = elements.iter().flat_map(|element| {
            let Element { row, column, .. } = self.elements[*element];
            let columns = column.saturating_sub(1)..=column + 1;
            (row.saturating_sub(1)..=row + 1)
                .flat_map(move |row| self.candidates_in_row(row, columns.clone()))
        });
        let found: BTreeSet<usize> = neighbours.collect();
        found.into_iter().collect()
    }

    /// Indices of the candidates of a row within a range of columns; candidates are numbered row by row.
    fn candidates_in_row(&self, row: usize, columns: RangeInclusive<usize>) -> Range<usize> {
        let [first, last] = [*columns.start(), columns.end() + 1].map(|column| {
            self.elements
                .partition_point(|element| (element.row, element.column) < (row, column))
        });
        first..last
    }

    /// Aspect ratio Δy/Δx.
    pub(super) fn aspect(&self) -> f64 {
        self.options.spacing[1] / self.options.spacing[0]
    }

    /// Number of elements that an element represents in sums: 2 with a mirror image, otherwise 1.
    pub(super) fn n_images(&self, element: usize) -> f64 {
        let has_image = self.has_image(&self.elements[element]);
        if has_image { 2.0 } else { 1.0 }
    }

    /// Height at the collocation point of an element, in units of the depth scale.
    pub(super) fn height(&self, element: usize) -> f64 {
        self.elements[element].height
    }

    /// Initial active set: candidates below the depth scale, with negligible loads.
    pub(super) fn initial_active_set(&self) -> Vec<(usize, f64)> {
        let is_low = |element: &usize| self.height(*element) < 1.0;
        let low = (0..self.n_elements()).filter(is_low);
        low.map(|element| (element, f64::EPSILON)).collect()
    }

    /// Multiplies all loads by one factor so that their sum is the given force exactly; at a given depth nothing changes.
    pub(super) fn scale_to_force(&self, loads: &mut [f64]) {
        let control = self.loading.control;
        if control.depth == 0.0 {
            let total = self.total_load(loads.iter().copied().enumerate());
            let scale = control.right / (control.load * total);
            loads.iter_mut().for_each(|load| *load *= scale);
        }
    }

    /// Sum of loads, given with the indices of their candidates; mirror images are included.
    pub(super) fn total_load(&self, loads: impl IntoIterator<Item = (usize, f64)>) -> f64 {
        let weighted = |(element, load)| self.n_images(element) * load;
        loads.into_iter().map(weighted).sum()
    }

    /// Load-weighted means of the slopes.
    pub(super) fn mean_slopes(&self, loads: &[(usize, f64)]) -> LoadWeightedSlopes {
        let (mut sums, mut total_load) = ([0.0; 3], 0.0);
        // Sum the slopes of the loaded elements, weighted with their loads and their number of mirror images.
        for &(element, load) in loads {
            let Element {
                slope,
                dissipating_slope,
                ..
            } = self.elements[element];
            for (sum, slope) in sums.iter_mut().zip([slope, slope.abs(), dissipating_slope]) {
                *sum += self.n_images(element) * load * slope;
            }
            total_load += self.n_images(element) * load;
        }
        let [slope, absolute_slope, dissipating_slope] = sums.map(|sum| sum / total_load);
        LoadWeightedSlopes {
            slope,
            absolute_slope,
            dissipating_slope,
        }
    }

    /// Central difference of the heights of the two neighbours along x, under a body with edges. Friction from the slope in the
    /// element itself is too low, by a term of the order of √Δx where the contact ends near the edge. `None` under a body without
    /// edges, and where a neighbour is not covered by the body.
    fn dissipating_slope(&self, surface: &dyn Surface, centre: [f64; 2]) -> Option<f64> {
        if !self.loading.has_edges {
            return None;
        }
        let dx = self.options.spacing[0];
        let height = |shift| {
            let x = centre[0] + (self.loading.creep.collocation_shift + shift) * dx;
            surface.height([x, centre[1]])
        };
        let slope = (height(1.0) - height(-1.0)) / (2.0 * dx);
        slope.is_finite().then_some(slope)
    }

    /// Load-weighted mean of half the difference of the gaps ahead of and behind each element; gaps of loaded elements are 0.
    pub(super) fn mean_gap_difference(&self, loads: &[f64], gaps: &[f64]) -> f64 {
        // This closure returns the gap of a neighbour, which is 0 if the neighbour is loaded or no candidate.
        let gap = |row: usize, column: usize| {
            let neighbour = self.candidates_in_row(row, column..=column).next();
            let open = neighbour.filter(|one| loads[*one] <= 0.0);
            open.map_or(0.0, |one| gaps[one])
        };
        let (mut sum, mut total_load) = (0.0, 0.0);
        for (index, load) in loads.iter().enumerate().filter(|(_, load)| **load > 0.0) {
            let Element { row, column, .. } = self.elements[index];
            let weighted = self.n_images(index) * load;
            sum += 0.5 * weighted * (gap(row + 1, column) - gap(row.wrapping_sub(1), column));
            total_load += weighted;
        }
        sum / total_load
    }

    /// Row, column and load of every loaded element, mirror images included.
    pub(super) fn loaded_indices(&self, loads: &[(usize, f64)]) -> Vec<([usize; 2], f64)> {
        let with_image = |&(element, load): &(usize, f64)| {
            let [own, image] = self.indices(element);
            let both = std::iter::once(own).chain((image != own).then_some(image));
            both.map(move |indices| (indices, load))
        };
        loads.iter().flat_map(with_image).collect()
    }

    /// True if a box of rows and columns lies inside the footprint, not at its boundary.
    pub(super) fn contains_inside(&self, bounds: &Bounds) -> bool {
        (0..2).all(|axis| {
            let [first, last] = self.inner_limits[axis];
            bounds.lower[axis] > first && bounds.upper[axis] <= last
        })
    }

    /// True if the element ahead of a loaded one ends in a vertical wall, or the one behind it, unless only rising elements are
    /// candidates.
    pub(super) fn faces_wall(&self, element: [usize; 2]) -> bool {
        let [row, column] = element;
        let is_wall = |row: usize| {
            let wall = self.walls.get(row * self.shape[1] + column);
            wall.is_some_and(|wall| *wall)
        };
        is_wall(row + 1) || !self.only_rising && row.checked_sub(1).is_some_and(is_wall)
    }

    /// Largest |rise| of the body over a loaded element, in units of the depth scale.
    pub(super) fn max_rise(&self, loads: &[(usize, f64)]) -> f64 {
        let (dx, unit) = (self.options.spacing[0], self.loading.depth_scale);
        let rise = |&(element, _): &(usize, f64)| (self.elements[element].slope * dx / unit).abs();
        loads.iter().map(rise).fold(0.0, f64::max)
    }
}

/// Load-weighted means of the slopes of a body.
pub(super) struct LoadWeightedSlopes {
    /// Mean of ∂h/∂x.
    pub(super) slope: f64,
    /// Mean of |∂h/∂x|.
    pub(super) absolute_slope: f64,
    /// Mean of the slope for the friction from dissipation, without the gaps next to the contact.
    pub(super) dissipating_slope: f64,
}
