//! `speed-range`: friction of the three-element solid from the soft elastic limit through the viscous plateau to the
//! stiff one, and where in it the paper's viscous law holds.

mod border;
mod curves;
mod pictures;
mod sliding;
mod validity;

use anyhow::Result;

use super::{Report, Table};

/// Exponents of the profiles: cone and paraboloid, in this order in every table.
const EXPONENTS: [f64; 2] = [1.0, 2.0];

/// Values from 10^first to 10^last, evenly spaced in the logarithm.
#[derive(Debug, Clone, Copy)]
struct Decades {
    first: i32,
    last: i32,
    per_decade: i32,
}

impl Decades {
    fn values(self) -> impl Iterator<Item = f64> {
        (self.first * self.per_decade..=self.last * self.per_decade)
            .map(move |step| 10_f64.powf(f64::from(step) / f64::from(self.per_decade)))
    }
}

/// What is computed.
#[derive(Debug, Clone, Copy)]
struct Extent {
    curve_ratios: &'static [f64],
    curve_speeds: Decades,
    curve_error: f64,
    map_ratios: Decades,
    map_speeds: Decades,
    map_error: f64,
}

const FULL: Extent = Extent {
    curve_ratios: &[1e-6, 1e-4, 1e-2],
    curve_speeds: Decades {
        first: -9,
        last: 3,
        per_decade: 5,
    },
    curve_error: 3e-3,
    map_ratios: Decades {
        first: -6,
        last: 0,
        per_decade: 2,
    },
    map_speeds: Decades {
        first: -8,
        last: 2,
        per_decade: 4,
    },
    map_error: 1e-2,
};

const QUICK: Extent = Extent {
    curve_ratios: &[1e-4],
    curve_speeds: Decades {
        first: -7,
        last: 3,
        per_decade: 1,
    },
    curve_error: 2e-2,
    map_ratios: Decades {
        first: -3,
        last: -1,
        per_decade: 1,
    },
    map_speeds: Decades {
        first: -4,
        last: 1,
        per_decade: 1,
    },
    map_error: 3e-2,
};

/// Computes curves, map and border; a quick run takes fewer speeds and stiffness ratios, and wider error bars.
pub(super) fn report(quick: bool) -> Result<Report> {
    let extent = if quick { QUICK } else { FULL };
    let curves = curves::compute(&extent)?;
    let validity = validity::compute(&extent)?;
    let borders = border::find(&validity)?;
    Ok(Report {
        name: "speed_range",
        tables: vec![
            Table::new("friction_over_speed", &curves)?,
            Table::new("validity", &validity)?,
            Table::new("validity_border", &borders)?,
        ],
        pictures: pictures::all((&curves, &validity, &borders), &extent)?,
        summary: border::printed(&borders).to_string(),
        failure: None,
    })
}
