//! Distribution of the answers of samples, compared with first-order propagation of uncertainty.

use std::f64::consts::TAU;

use comfy_table::Table;
use viscofriction::Quantity;
use viscofriction::numerics::Rounded;
use viscofriction::sweep::SAMPLE;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Series};

use super::file::RowTable;
use super::picture::{HALF_WIDTH_95_PERCENT, drawable};
use crate::output::markdown;
use crate::run::range_with_zero;

/// The answers of a sweep over samples only.
pub(super) struct Samples {
    /// Axis label of the quantity.
    label: String,
    /// Value for the scene itself, and its standard uncertainty to first order.
    nominal: [f64; 2],
    /// Values of the samples in increasing order.
    sorted: Vec<f64>,
}

impl Samples {
    /// The samples of a sweep; `None` for other sweeps, and for fewer than two answers.
    pub(super) fn of(table: &RowTable) -> Option<Self> {
        let place = |name: &str| table.place(name);
        let key = place(SAMPLE).filter(|&key| table.keys() == Some(key..key + 1))?;
        let number = |row: usize, column: usize| table.rows[row].fields[column].parse::<f64>().ok();
        let is_nominal = |row: &usize| number(*row, key) == Some(0.0);
        let row = (0..table.rows.len()).find(is_nominal)?;
        // A quantity that the scene gives has no column of an uncertainty, and is left out.
        let known = |quantity: &Quantity| {
            let uncertainty = number(row, place(&format!("{}_uncertainty", quantity.key))?)?;
            let column = place(quantity.key)?;
            let nominal = [number(row, column)?, uncertainty];
            Some((quantity.label(), column, nominal))
        };
        let (label, column, nominal) = drawable().find_map(known)?;
        let others = (0..table.rows.len()).filter(|row| !is_nominal(row));
        let mut sorted: Vec<f64> = others.filter_map(|row| number(row, column)).collect();
        sorted.sort_by(f64::total_cmp);
        (sorted.len() > 1).then_some(Self {
            label,
            nominal,
            sorted,
        })
    }

    /// Mean, standard deviation and quantiles of the samples, and those of the normal distribution to first order.
    pub(super) fn table(&self) -> Table {
        let n = self.sorted.len() as f64;
        let mean = self.sorted.iter().sum::<f64>() / n;
        let squares: f64 = self.sorted.iter().map(|value| (value - mean).powi(2)).sum();
        let [nominal, uncertainty] = self.nominal;
        let half = HALF_WIDTH_95_PERCENT * uncertainty;
        let [low, middle, high] = [0.025, 0.5, 0.975].map(|part| self.quantile(part));
        let rows = [
            (
                format!("{n} samples"),
                [mean, (squares / (n - 1.0)).sqrt(), low, middle, high],
            ),
            (
                "first order".to_owned(),
                [
                    nominal,
                    uncertainty,
                    nominal - half,
                    nominal,
                    nominal + half,
                ],
            ),
        ];
        let mut table = markdown("of the | mean | standard deviation | 2.5 % | 50 % | 97.5 %");
        for (name, numbers) in rows {
            let cells = numbers.map(|number| Rounded(number).to_string());
            table.add_row(std::iter::once(name).chain(cells));
        }
        table
    }

    /// Value below which a fraction `part` of the samples lies, by linear interpolation between neighbouring samples.
    fn quantile(&self, part: f64) -> f64 {
        let last = self.sorted.len() - 1;
        let place = part * last as f64;
        let below = viscofriction::numerics::whole_part(place).min(last);
        let above = (below + 1).min(last);
        let rest = place - below as f64;
        self.sorted[below] + rest * (self.sorted[above] - self.sorted[below])
    }

    /// Cumulative distribution of the samples and of the normal distribution to first order.
    pub(super) fn figure(&self) -> Figure {
        let n = self.sorted.len() as f64;
        let values = self.sorted.iter().enumerate();
        let drawn = values.map(|(place, value)| [*value, (place as f64 + 0.5) / n]);
        let drawn = Series::line(drawn.collect(), Line::thick(Dash::Solid), Colour::Blue);
        let [nominal, uncertainty] = self.nominal;
        let steps = f64::from(STEPS_PER_SIDE);
        let mut below = 0.0;
        let normal = (-STEPS_PER_SIDE..=STEPS_PER_SIDE).map(|step| {
            let z = HALF_RANGE * f64::from(step) / steps;
            let height = (-0.5 * z * z).exp() / TAU.sqrt() * HALF_RANGE / steps;
            below += height;
            [nominal + z * uncertainty, below - 0.5 * height]
        });
        let normal = Series::line(normal.collect(), Line::thin(Dash::Dashed), Colour::Red);
        let series = [drawn.labelled("samples"), normal.labelled("first order")];
        let ends = series
            .iter()
            .flat_map(|one| &one.points)
            .map(|point| point[0]);
        let x = Axis::linear(&*self.label, range_with_zero(ends));
        let y = Axis::linear("part of the samples below", [0.0, 1.0]);
        Figure::single(Chart::new(x, y, series.into()))
    }
}

/// Distance from the mean up to which the normal distribution is drawn, in standard deviations. Chosen: beyond it the
/// density is below e⁻⁸ = 3e-4 of its maximum.
const HALF_RANGE: f64 = 4.0;
/// Number of steps of the drawn normal distribution on each side of the mean, over which its density is summed. Chosen: a
/// step is 0.02 standard deviations, over which the density is nearly linear.
const STEPS_PER_SIDE: i32 = 200;
