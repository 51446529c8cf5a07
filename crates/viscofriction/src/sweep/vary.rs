//! What the command line says about the points of a sweep.

use std::str::FromStr;

/// A key and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Vary {
    /// Such as `load.velocity`.
    pub key: String,
    start: f64,
    stop: f64,
    /// Number of values.
    pub count: usize,
    log: bool,
}

/// Every `count`-th point, beginning with the `number`-th.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 1 to `count`.
    pub number: usize,
    /// Number of shards.
    pub count: usize,
}

/// More points than this are a mistake.
pub(super) const MOST_POINTS: usize = 1_000_000;

impl FromStr for Vary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "KEY=START:STOP:COUNT[:log] is needed";
        let (key, values) = text.split_once('=').ok_or(form)?;
        let parts: Vec<&str> = values.split(':').collect();
        let (start, stop, count, log) = match parts[..] {
            [start, stop, count] => (start, stop, count, false),
            [start, stop, count, "log"] => (start, stop, count, true),
            _ => return Err(form.to_owned()),
        };
        let vary = Self {
            key: key.trim().to_owned(),
            start: number("START", start)?,
            stop: number("STOP", stop)?,
            count: whole("COUNT", count, MOST_POINTS)?,
            log,
        };
        if vary.key.is_empty() {
            return Err(form.to_owned());
        }
        if log && !(vary.start > 0.0 && vary.stop > 0.0) {
            return Err("START and STOP must be greater than 0 on a logarithmic scale".to_owned());
        }
        Ok(vary)
    }
}

fn number(name: &str, text: &str) -> Result<f64, String> {
    let value: f64 = text
        .parse()
        .map_err(|_| format!("{name} must be a number, but is {text}"))?;
    if value.is_finite() {
        return Ok(value);
    }
    Err(format!("{name} must be finite, but is {text}"))
}

fn whole(name: &str, text: &str, most: usize) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if (1..=most).contains(&value) => Ok(value),
        _ => Err(format!(
            "{name} must be a whole number from 1 to {most}, but is {text}"
        )),
    }
}

impl Vary {
    /// The value of a given index; both ends are met exactly.
    #[must_use]
    pub fn value(&self, index: usize) -> f64 {
        if index == 0 {
            return self.start;
        }
        if index + 1 == self.count {
            return self.stop;
        }
        let fraction = index as f64 / (self.count - 1) as f64;
        if self.log {
            return self.start * (self.stop / self.start).powf(fraction);
        }
        self.start + (self.stop - self.start) * fraction
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, count) = text.split_once('/').ok_or("I/N is needed, such as 1/4")?;
        let count = whole("N", count, MOST_POINTS)?;
        let number = whole("I", number, count)?;
        Ok(Self { number, count })
    }
}

impl Shard {
    /// Whether a point, counted from 0, belongs to this shard.
    #[must_use]
    pub const fn holds(self, point: usize) -> bool {
        point % self.count == self.number - 1
    }
}
