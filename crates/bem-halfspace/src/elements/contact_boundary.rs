//! Sub-element position of the contact boundary, and its derivatives by loads and gaps.
//!
//! While a contact grows past the elements of a row, the load x of the last one inside rises from 0, and the gap g of the first
//! one outside falls to 0. Both change linearly as long as the active set does not. The fraction
//!
//! ```text
//! s = x/(x + κ g)
//! ```
//!
//! of an element rises from 0 to 1 meanwhile; then the next element is the last one inside, with s = 0. The number of elements
//! plus these fractions is an area that is continuous when elements are exchanged, for any κ. Its derivative at a fixed active
//! set is therefore that of the area, up to local variations, and exactly so at each pair if κ is the ratio of the range of x to
//! that of g. This ratio is a property of the kernel k of the grid. In units of 1/b, with the second difference
//! b = k₀ − (k₁ + k₋₁)/2 along the row, it lies between 0.3, for a singular pressure, and 0.6, for one that vanishes like a root.
//!
//! Rows alone give the whole area, and so do columns. With the normal n, a pair along x therefore has the weight n_x², and one
//! along y the weight n_y².
//!
//! The *boundary weight* is the same sum, weighted with the square of the load x + κ g at which an element leaves the boundary.
//! It measures the error that the elements leave at the boundary, a product of a load and an adjoint load that both rise like x.
//!
//! Theory: docs/theory/sensitivities.md.

/// Product κ b of the load–gap ratio κ at a straight boundary and the second difference b of the kernel of a line of elements, where the
/// pressure vanishes like a root. Measured under a parabolic cylinder on an elastic half plane: with it the fraction of a pair is linear
/// in the position of the boundary, to 0.001 (case of `evidence tuning`).
const LOAD_GAP_RATIO: f64 = 0.6;
/// Second difference k₀ − (k₁ + k₋₁)/2 of the kernel of an infinite line of elements, over their width. Derived: 3 ln 3, from the
/// integral of −2 ln |x| over an element.
pub(crate) const LINE_SECOND_DIFFERENCE: f64 = 3.295_836_866_004_329;

/// Loads of the elements in contact and gaps of their neighbours, on a box of elements.
pub(crate) struct BoundaryField {
    /// Rows and columns of the box.
    pub(crate) shape: [usize; 2],
    /// True if the box is a whole period, so that its opposite ends are neighbours.
    pub(crate) is_periodic: bool,
    /// Aspect ratio Δy/Δx of an element.
    pub(crate) aspect: f64,
    /// Flag of each element: true in contact.
    pub(crate) inside: Vec<bool>,
    /// Load x of an element in contact, gap g of an element outside, row-major; not finite if unknown. Units are those of the caller,
    /// with gap = kernel · load.
    pub(crate) values: Vec<f64>,
    /// Second difference b = k₀ − (k₁ + k₋₁)/2 of the kernel along x and y, in units of gap over load.
    pub(crate) second_difference: [f64; 2],
    /// Increase of the load of each element inside, or decrease of the gap of each element outside, per unit of depth; the ratio of the
    /// two is κ. `None` for boundaries of many elements.
    pub(crate) unit_depth_response: Option<Vec<f64>>,
}

/// Area of the polygons that bound a contact.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PolygonArea {
    /// Area of the polygons, in elements.
    pub(crate) area: f64,
    /// Length of their projections onto both axes, in edges of elements.
    pub(crate) edges: f64,
}

impl PolygonArea {
    /// Area less the mean `excess` of the polygons per edge, in elements.
    pub(crate) fn corrected(&self, excess: f64) -> f64 {
        self.area - excess * self.edges
    }
}

/// Load–gap ratios κ along both axes, at a straight boundary where the pressure vanishes like a root. The kernel is that of an elastic
/// half space, with `edges` of the elements; the boundary passes all elements of a line at the same time.
pub(crate) fn root_load_gap_ratios(edges: [f64; 2]) -> [f64; 2] {
    edges.map(|edge| LOAD_GAP_RATIO / (LINE_SECOND_DIFFERENCE * edge))
}

/// The derivatives of one quantity, area or boundary weight, at a fixed active set.
#[derive(Debug, Clone)]
pub(crate) struct BoundaryDerivatives {
    /// Derivatives by the load or gap of each element of the box.
    pub(crate) by_values: Vec<f64>,
    /// Derivatives by the second difference of the kernel along each axis.
    pub(crate) by_second_difference: [f64; 2],
}

/// Derivatives of area and boundary weight of a contact by loads, gaps and kernel.
#[derive(Debug, Clone)]
pub(crate) struct ContactBoundary {
    /// Derivatives of the area, in elements.
    pub(crate) area: BoundaryDerivatives,
    /// Derivatives of the boundary weight, in the unit of a squared load.
    pub(crate) boundary_weight: BoundaryDerivatives,
}

/// An element in contact and its neighbour outside along an axis.
#[derive(Debug, Clone, Copy)]
struct BoundaryPair {
    /// Index of the element in contact.
    inside: usize,
    /// Index of its neighbour without load.
    outside: usize,
    /// Axis from one to the other: 0 along x, 1 along y.
    axis: usize,
}

impl BoundaryDerivatives {
    /// Zero derivatives on a box of `n` elements.
    fn zero(n: usize) -> Self {
        Self {
            by_values: vec![0.0; n],
            by_second_difference: [0.0; 2],
        }
    }

    /// Adds the derivatives of the fraction s = x/(x + κ g) of a pair, times (x + κ g)²/κ and a weight.
    fn add_pair(&mut self, field: &BoundaryField, pair: BoundaryPair, weight: f64) {
        let [load, gap] = [pair.inside, pair.outside].map(|element| field.values[element]);
        self.by_values[pair.inside] += weight * gap;
        self.by_values[pair.outside] -= weight * load;
        self.by_second_difference[pair.axis] +=
            weight * load * gap / field.second_difference[pair.axis];
    }
}

impl ContactBoundary {
    /// Derivatives of area and boundary weight: sums of the contributions of all pairs at the boundary of a contact.
    pub(crate) fn new(field: &BoundaryField) -> Self {
        let mut boundary = Self {
            area: BoundaryDerivatives::zero(field.values.len()),
            boundary_weight: BoundaryDerivatives::zero(field.values.len()),
        };
        for pair in field.boundary_pairs() {
            let ratio = field.load_gap_ratio(pair);
            // Compute the load x + κ g with which the element inside leaves the boundary. Skip pairs where it is not positive,
            // because negative gaps are errors of the solution.
            let leaving_load = field.values[pair.inside] + ratio * field.values[pair.outside];
            if leaving_load <= 0.0 {
                continue;
            }
            let weight = field.squared_normal(pair, ratio, leaving_load) * ratio;
            let area_weight = weight / leaving_load.powi(2);
            boundary.area.add_pair(field, pair, area_weight);
            boundary.boundary_weight.add_pair(field, pair, weight);
        }
        boundary
    }
}

impl BoundaryField {
    /// Area of the polygons that divide each pair at the boundary in the ratio s : 1 − s, for load–gap ratios κ along both axes. A gap
    /// that is not known counts as half an element.
    ///
    /// Elements without load must surround the contact. A box of one column is infinite along y.
    pub(crate) fn polygon_area(&self, load_gap_ratios: [f64; 2]) -> PolygonArea {
        let elements = 0..self.inside.len();
        elements.fold(PolygonArea::default(), |sum, first| {
            let part = self.area_ahead_of(first, load_gap_ratios);
            PolygonArea {
                area: sum.area + part.area,
                edges: sum.edges + part.edges,
            }
        })
    }

    /// Part of the polygons in the rectangle between the centres of an element and its neighbours ahead.
    fn area_ahead_of(&self, first: usize, load_gap_ratios: [f64; 2]) -> PolygonArea {
        /// Corners of the rectangle in counter-clockwise order, in units of its edges.
        const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let ([rows, columns], [row, column]) =
            (self.shape, [first / self.shape[1], first % self.shape[1]]);
        let [next_row, next_column] = [(row + 1) % rows, (column + 1) % columns];
        let elements = [
            [row, column],
            [next_row, column],
            [next_row, next_column],
            [row, next_column],
        ]
        .map(|[row, column]| row * columns + column);
        let n_inside = elements
            .iter()
            .filter(|element| self.inside[**element])
            .count();
        // Four corners in contact enclose the whole rectangle, and none nothing.
        if n_inside % 4 == 0 {
            return PolygonArea {
                area: (n_inside / 4) as f64,
                edges: 0.0,
            };
        }
        // Collect the vertices of the part in contact in cyclic order; true for those at which the boundary crosses an edge.
        let mut vertices = Vec::with_capacity(6);
        for from in 0..4 {
            let to = (from + 1) % 4;
            if self.inside[elements[from]] {
                vertices.push((CORNERS[from], false));
            }
            if self.inside[elements[from]] != self.inside[elements[to]] {
                let [inside, outside] = if self.inside[elements[from]] {
                    [from, to]
                } else {
                    [to, from]
                };
                let [load, gap] = [inside, outside].map(|corner| self.values[elements[corner]]);
                // Interpolate the crossing from load and gap, halfway if no gap is known.
                let fraction = if gap.is_finite() {
                    load / (load + load_gap_ratios[from % 2] * gap.max(0.0))
                } else {
                    0.5
                };
                let crossing = [0, 1].map(|axis| {
                    CORNERS[inside][axis]
                        + fraction * (CORNERS[outside][axis] - CORNERS[inside][axis])
                });
                vertices.push((crossing, true));
            }
        }
        // Half the cross products of the ends of its edges add up to the area. The boundary runs between two crossings.
        let next = vertices.iter().cycle().skip(1);
        let mut part = PolygonArea::default();
        for ((a, crosses), (b, leaves)) in vertices.iter().zip(next) {
            part.area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            if *crosses && *leaves {
                part.edges += (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
            }
        }
        part
    }

    /// All pairs of an element in contact and a neighbour outside whose gap is known.
    fn boundary_pairs(&self) -> impl Iterator<Item = BoundaryPair> {
        let inside = (0..self.values.len()).filter(|element| self.inside[*element]);
        inside.flat_map(move |inside| {
            let directions = [(0, true), (0, false), (1, true), (1, false)];
            directions.into_iter().filter_map(move |(axis, ahead)| {
                let outside = self.neighbour(inside, axis, ahead)?;
                let is_boundary = !self.inside[outside] && self.values[outside].is_finite();
                is_boundary.then_some(BoundaryPair {
                    inside,
                    outside,
                    axis,
                })
            })
        })
    }

    /// The ratio κ of load to gap at a pair: from the responses to depth where these are known and positive, else [`LOAD_GAP_RATIO`].
    fn load_gap_ratio(&self, pair: BoundaryPair) -> f64 {
        // Compute the ratio of the responses to depth. A gap that grows with the depth has none, so that the constant replaces
        // it.
        let response = self.unit_depth_response.as_ref();
        let ratio_of_responses =
            response.map(|response| response[pair.inside] / response[pair.outside]);
        ratio_of_responses
            .filter(|ratio| *ratio > 0.0)
            .unwrap_or(LOAD_GAP_RATIO / self.second_difference[pair.axis])
    }

    /// Index of the neighbour of an element along an axis (0 is x, 1 is y), ahead or behind; `None` beyond the end of the box.
    fn neighbour(&self, element: usize, axis: usize, ahead: bool) -> Option<usize> {
        let [rows, columns] = self.shape;
        let mut indices = [element / columns, element % columns];
        let length = [rows, columns][axis];
        indices[axis] = match (ahead, indices[axis]) {
            (true, last) if last + 1 == length => self.is_periodic.then_some(0)?,
            (true, index) => index + 1,
            (false, 0) => self.is_periodic.then_some(length - 1)?,
            (false, index) => index - 1,
        };
        Some(indices[0] * columns + indices[1])
    }

    /// Squared component n_x² or n_y² of the unit normal of the contact boundary along the axis of a pair, from 0 to 1.
    ///
    /// The normal is the gradient of a field that is the load inside the contact and −κ times the gap outside, with κ = `ratio`;
    /// `leaving_load` is the change of the field across the pair.
    fn squared_normal(&self, pair: BoundaryPair, ratio: f64, leaving_load: f64) -> f64 {
        // This closure returns the derivative along the boundary at an element: a central difference, or a one-sided one next to
        // an unknown gap.
        let derivative = |element: usize| {
            let value = |element: usize| match self.values[element] {
                value if self.inside[element] => value,
                value => -ratio * value,
            };
            let neighbour = |ahead| {
                let next = self.neighbour(element, 1 - pair.axis, ahead).map(value);
                next.filter(|value| value.is_finite())
            };
            match (neighbour(true), neighbour(false)) {
                (Some(next), Some(before)) => 0.5 * (next - before),
                (Some(next), None) => next - value(element),
                (None, Some(before)) => value(element) - before,
                (None, None) => 0.0,
            }
        };
        let tangent = 0.5 * (derivative(pair.inside) + derivative(pair.outside));
        // Square the derivatives along both axes, per length in units of Δx. The normal is their direction.
        let spacing = [1.0, self.aspect];
        let squares = [
            (leaving_load / spacing[pair.axis]).powi(2),
            (tangent / spacing[1 - pair.axis]).powi(2),
        ];
        squares[0] / (squares[0] + squares[1])
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// A disc with its radius in elements, on elements of an aspect, whose loads fall by 1 from row to row at its boundary.
    fn disc(radius: f64, centre: f64, aspect: f64) -> BoundaryField {
        let shape = [40, 60];
        let height = |element: usize| {
            let x = (element / shape[1]) as f64 - 20.0 - centre;
            let y = ((element % shape[1]) as f64 - 30.0 - centre) * aspect;
            (radius * radius - x * x - y * y) / (2.0 * radius)
        };
        let heights: Vec<f64> = (0..shape[0] * shape[1]).map(height).collect();
        let value = |height: &f64| match *height {
            height if height > 0.0 => height,
            height => -height / LOAD_GAP_RATIO,
        };
        BoundaryField {
            shape,
            is_periodic: false,
            aspect,
            inside: heights.iter().map(|height| *height > 0.0).collect(),
            values: heights.iter().map(value).collect(),
            second_difference: [1.0; 2],
            unit_depth_response: None,
        }
    }

    /// The change of a measure when all loads grow, and all gaps fall, like those of a disc of a larger radius.
    fn grown(field: &BoundaryField, measure: &BoundaryDerivatives) -> f64 {
        let pairs = measure.by_values.iter().zip(&field.inside);
        let changes = pairs
            .map(|(by_value, inside)| by_value * if *inside { 1.0 } else { -1.0 / LOAD_GAP_RATIO });
        changes.sum()
    }

    #[test]
    fn rows_and_columns_together_know_the_area_of_a_disc() {
        for aspect in [0.6, 1.0] {
            for (radius, centre) in [(14.3, 0.0), (15.0, 0.5), (16.1, 0.21)] {
                let field = disc(radius, centre, aspect);
                let rim = ContactBoundary::new(&field);
                let got = grown(&field, &rim.area);
                let expected = 2.0 * PI * radius / aspect;
                assert!(
                    (got / expected - 1.0).abs() < 0.02,
                    "{got} instead of {expected}"
                );
            }
        }
    }

    /// The sum of the parts does not jump when an element changes sides, and rises by 1 from one to the next.
    #[test]
    fn one_element_after_the_other_comes_into_contact() {
        const STEPS: usize = 100;
        let row = |load: f64| BoundaryField {
            shape: [4, 1],
            is_periodic: false,
            aspect: 1.0,
            inside: vec![false, true, false, false],
            values: vec![f64::NAN, load, (1.0 - load) / LOAD_GAP_RATIO, f64::INFINITY],
            second_difference: [0.5; 2],
            unit_depth_response: None,
        };
        let changes = (0..STEPS).map(|step| {
            let field = row((step as f64 + 0.5) / STEPS as f64);
            grown(&field, &ContactBoundary::new(&field).area) / STEPS as f64
        });
        let whole: f64 = changes.sum();
        assert!((whole - 1.0).abs() < 1e-3, "{whole}");
    }

    /// Polygons of a field that is linear across the boundary have the area of the disc, less that of the segments beyond their chords,
    /// wherever the disc lies between the elements. Their projections onto both axes are its diameters, twice each.
    #[test]
    fn polygons_have_the_area_of_a_disc() {
        for aspect in [0.6, 1.0] {
            for step in 0..8 {
                let (radius, centre) = (14.0 + 0.13 * f64::from(step), 0.11 * f64::from(step));
                let field = disc(radius, centre, aspect);
                let found = field.polygon_area([LOAD_GAP_RATIO; 2]);
                let lost = PI * radius * radius / aspect - found.area;
                assert!(lost > 0.0 && lost < 1.2, "{radius}, {centre}: {lost}");
                let edges = 4.0 * radius * (1.0 + aspect.recip());
                let off = found.edges / edges - 1.0;
                assert!(off.abs() < 0.01, "{radius}, {centre}: {off}");
            }
        }
    }

    /// A strip of one column ends between two elements, a patch with an unknown gap around it in the middle between both.
    #[test]
    fn strips_and_unknown_gaps_end_between_elements() {
        let mut field = BoundaryField {
            shape: [5, 1],
            is_periodic: false,
            aspect: 1.0,
            inside: vec![false, true, true, true, false],
            values: vec![0.5, 3.0, 5.0, 1.0, 1.5],
            second_difference: [1.0; 2],
            unit_depth_response: None,
        };
        let area = field.polygon_area([2.0; 2]).corrected(0.05);
        let expected = 2.0 + 0.75 + 0.25 - 2.0 * 0.05;
        assert!((area - expected).abs() < 1e-14, "{area}");
        field.values[4] = f64::NAN;
        let area = field.polygon_area([2.0; 2]).corrected(0.05);
        assert!((area - expected - 0.25).abs() < 1e-14, "{area}");
    }

    #[test]
    fn a_box_that_wraps_has_no_ends() {
        let mut field = BoundaryField {
            shape: [2, 3],
            is_periodic: true,
            aspect: 1.0,
            inside: vec![true, false, false, true, false, false],
            values: vec![1.0, 2.0, 2.0, 1.0, 2.0, 2.0],
            second_difference: [1.0; 2],
            unit_depth_response: None,
        };
        assert_eq!(field.boundary_pairs().count(), 4);
        field.is_periodic = false;
        assert_eq!(field.boundary_pairs().count(), 2);
    }
}
