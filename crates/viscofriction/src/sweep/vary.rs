//! Varied keys, samples and shards of a sweep, as the command line gives them.

use std::fmt;
use std::str::FromStr;

/// A varied key with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Vary {
    /// The path of the key, such as `load.velocity`.
    pub key: String,
    /// Values in the given order.
    pub values: Vec<Varied>,
}

/// Key under which the number of a sample of the uncertain quantities is varied.
pub const SAMPLE: &str = "sample";

impl Vary {
    /// The scene itself, and `count` samples of its uncertain numbers.
    ///
    /// # Errors
    /// A sentence that states the allowed numbers.
    pub fn samples(count: &str) -> Result<Self, String> {
        // The scene itself takes one of the allowed points, so there is one sample less.
        let count = whole_number("N", count, MAX_POINTS - 1)?;
        let values = (0..=count).map(|sample| Varied::Number(sample as f64));
        Ok(Self {
            key: SAMPLE.to_owned(),
            values: values.collect(),
        })
    }
}

/// A value of a varied key.
#[derive(Debug, Clone, PartialEq)]
pub enum Varied {
    /// A number.
    Number(f64),
    /// A text, such as a file name or a word of the scene; `true` and `false` are those of TOML.
    Text(String),
}

/// Formats the value as a cell of a row.
impl fmt::Display for Varied {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(out, "{number:?}"),
            Self::Text(text) => out.write_str(text),
        }
    }
}

/// Every `count`-th point, starting with the `number`-th.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard, from 1 to `count`.
    pub number: usize,
    /// Number of shards.
    pub count: usize,
}

/// Spacing of the values of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
}

/// Number of points of a sweep above which it is refused. Chosen; more are probably a mistake.
pub(super) const MAX_POINTS: usize = 1_000_000;

impl FromStr for Vary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "KEY=START:STOP:COUNT[:log] or KEY=a,b,c is needed";
        let (key, values) = text.split_once('=').ok_or(form)?;
        let key = key.trim();
        if key.is_empty() {
            return Err(form.to_owned());
        }
        let parts: Vec<&str> = values.split(':').collect();
        let values = match parts[..] {
            [start, stop, count] => spaced_values([start, stop, count], Scale::Linear)?,
            [start, stop, count, "log"] => spaced_values([start, stop, count], Scale::Logarithmic)?,
            [one] if !one.contains(',') => return Err(form.to_owned()),
            _ if values.contains(',') => listed_values(values)?,
            _ => return Err(form.to_owned()),
        };
        Ok(Self {
            key: key.to_owned(),
            values,
        })
    }
}

/// Values separated by commas: all numbers, or all texts.
fn listed_values(list: &str) -> Result<Vec<Varied>, String> {
    let values = list.split(',').map(str::trim);
    let is_number = |value: &str| value.parse::<f64>().is_ok();
    if values.clone().any(is_number) {
        let numbers = values.map(|value| finite_number("a value", value).map(Varied::Number));
        return numbers.collect();
    }
    let text = |value: &str| match value {
        "" => Err("a value is missing between commas".to_owned()),
        text => Ok(Varied::Text(text.to_owned())),
    };
    values.map(text).collect()
}

/// COUNT values from START to STOP at equal differences or ratios, as the command line gives them; both ends are exact. An
/// error names what is wrong.
fn spaced_values([start, stop, count]: [&str; 3], scale: Scale) -> Result<Vec<Varied>, String> {
    let [start, stop] = [finite_number("START", start)?, finite_number("STOP", stop)?];
    let count = whole_number("COUNT", count, MAX_POINTS)?;
    if scale == Scale::Logarithmic && !(start > 0.0 && stop > 0.0) {
        return Err("START and STOP must be greater than 0 on a logarithmic scale".to_owned());
    }
    let value = |index: usize| {
        let fraction = index as f64 / (count - 1) as f64;
        match (index, scale) {
            (0, _) => start,
            (index, _) if index + 1 == count => stop,
            (_, Scale::Linear) => start + (stop - start) * fraction,
            (_, Scale::Logarithmic) => or_power_of_ten(start * (stop / start).powf(fraction)),
        }
    };
    Ok((0..count).map(value).map(Varied::Number).collect())
}

/// The nearest power of ten if a value differs from it by rounding only, so that it is printed as 1e-3 rather than with 17
/// digits; else the value.
fn or_power_of_ten(value: f64) -> f64 {
    let power = format!("1e{:.0}", value.log10()).parse().unwrap_or(value);
    // The computed value counts as the power of ten if it differs by no more than the rounding of quotient, power and product.
    let is_power = (value / power - 1.0).abs() <= 8.0 * f64::EPSILON;
    if is_power { power } else { value }
}

/// A finite number; an error names the parameter.
fn finite_number(name: &str, text: &str) -> Result<f64, String> {
    let refused = |needed: &str| format!("{name} must be {needed}, but is {text}");
    let value: f64 = text.parse().map_err(|_| refused("a number"))?;
    let finite = Some(value).filter(|value| value.is_finite());
    finite.ok_or_else(|| refused("finite"))
}

/// A whole number from 1 to `most`; an error names the parameter.
fn whole_number(name: &str, text: &str, most: usize) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if (1..=most).contains(&value) => Ok(value),
        _ => Err(format!(
            "{name} must be a whole number from 1 to {most}, but is {text}"
        )),
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, count) = text.split_once('/').ok_or("I/N is needed, such as 1/4")?;
        let count = whole_number("N", count, MAX_POINTS)?;
        let number = whole_number("I", number, count)?;
        Ok(Self { number, count })
    }
}

impl Shard {
    /// True if a point, counted from 0, belongs to this shard.
    pub const fn holds(self, point: usize) -> bool {
        point % self.count == self.number - 1
    }
}
