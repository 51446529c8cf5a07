//! The indenter on the elements of its footprint.

use indenters::Surface;

use crate::BemError;

/// Heights and slopes over the footprint, row-major with y fastest.
pub(super) struct SampledIndenter {
    /// Height at the centre of the element, in units of the depth scale.
    pub(super) height: Vec<f64>,
    /// Mean of ∂h/∂x at the element over the step that ends now; not finite where a vertical wall has passed.
    pub(super) mean_slope: Vec<f64>,
    /// ∂h/∂x at the end of the step.
    pub(super) end_slope: Vec<f64>,
}

impl SampledIndenter {
    /// Samples a surface whose lowest point lies over the centre of the element `apex`.
    pub(super) fn new(
        surface: &impl Surface,
        spacing: [f64; 2],
        (shape, apex): ([usize; 2], [usize; 2]),
        depth_scale: f64,
    ) -> Result<Self, BemError> {
        let position = |row: usize, column: usize| {
            let x = (row as f64 - apex[0] as f64) * spacing[0];
            let y = (column as f64 - apex[1] as f64) * spacing[1];
            [x, y]
        };
        let (mut height, mut mean_slope, mut end_slope) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..shape[0] {
            for column in 0..shape[1] {
                let here = surface.height(position(row, column));
                if here.is_nan() || here == f64::NEG_INFINITY {
                    return Err(BemError::InvalidHeight {
                        row,
                        column,
                        value: here,
                    });
                }
                // One step earlier the indenter was one element behind, and this element one ahead.
                let before = surface.height(position(row + 1, column));
                height.push(here / depth_scale);
                mean_slope.push((before - here) / spacing[0]);
                let slope = surface.gradient(position(row, column))[0];
                if slope.is_nan() && here.is_finite() {
                    let [parameter, allowed] = ["slope of the surface", "a number"];
                    return Err(BemError::InvalidParameter {
                        parameter,
                        value: slope,
                        allowed,
                    });
                }
                end_slope.push(slope);
            }
        }
        Ok(Self {
            height,
            mean_slope,
            end_slope,
        })
    }

    /// The lowest element, as [row, column]; the first of several.
    pub(super) fn lowest(&self, columns: usize) -> [usize; 2] {
        let lowest =
            (0..self.height.len()).min_by(|a, b| self.height[*a].total_cmp(&self.height[*b]));
        lowest.map_or([0, 0], |index| [index / columns, index % columns])
    }
}
