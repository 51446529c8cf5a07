//! Concatenation of the parts of a curve, whose times may begin again.

use super::depth::min_max;
use super::read::CurveFile;
use super::{IndentationCurve, Note};
use crate::MeasurementError;
use crate::table::Source;

/// Largest distance at which the beginning of a part continues, or repeats, the previous part: from its end or its
/// beginning. It is relative to the duration of the previous part for times, and to its range for depths. Chosen: it is
/// above the gap or overlap of parts of one ramp and small against a part.
const JOIN_TOLERANCE: f64 = 0.1;

/// A point of a curve, and its line in the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// Time, \[s].
    pub(super) time: f64,
    /// Depth, \[m].
    pub(super) depth: f64,
    /// Force, \[N].
    pub(super) force: f64,
    /// Line in the file, counted from 1.
    pub(super) line: usize,
}

/// The parts that are joined so far.
#[derive(Default)]
pub(super) struct JoinedCurve {
    pub(super) curve: IndentationCurve,
    pub(super) notes: Vec<String>,
    /// Index of the first point of the last part.
    begin: usize,
    /// Shift of the times of the last part, \[s].
    shift: f64,
}

impl JoinedCurve {
    /// Appends points. Where their time begins again, a new part goes on one time step after the last point, with a note.
    pub(super) fn append(
        &mut self,
        source: &Source,
        points: &[Point],
    ) -> Result<(), MeasurementError> {
        for point in points {
            if self.begins_again(point.time) {
                self.begin_part(source, point, points)?;
            }
            self.curve.time.push(point.time + self.shift);
            self.curve.depth.push(point.depth);
            self.curve.force.push(point.force);
        }
        Ok(())
    }

    /// The joined curve, with each note once.
    pub(super) fn finish(self) -> CurveFile {
        let mut notes: Vec<Note> = Vec::new();
        for note in self.notes.into_iter().map(Note::File) {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        CurveFile {
            curve: self.curve,
            notes,
        }
    }

    /// Whether a time is near that of the first point of the last part, and not after its last point.
    fn begins_again(&self, time: f64) -> bool {
        let part = &self.curve.time[self.begin..];
        let [Some(first), Some(last)] = [part.first(), part.last()] else {
            return false;
        };
        let time = time + self.shift;
        part.len() > 1 && time <= *last && (time - first).abs() <= JOIN_TOLERANCE * (last - first)
    }

    /// Begins a part one time step after the previous one; refused if the depth is not continuous.
    fn begin_part(
        &mut self,
        source: &Source,
        point: &Point,
        points: &[Point],
    ) -> Result<(), MeasurementError> {
        let IndentationCurve { time, depth, .. } = &self.curve;
        let n = time.len();
        let [low, high] = min_max(&depth[self.begin..]);
        let near = JOIN_TOLERANCE * (high - low);
        let [first, last] = [depth[self.begin], depth[n - 1]];
        let ahead = points.iter().filter(|one| one.line >= point.line);
        let deepest = ahead.map(|one| one.depth).fold(f64::NEG_INFINITY, f64::max);
        // A curve that has returned to its first depth is complete.
        let is_complete =
            (last - first).abs() <= near && high - near > last && deepest > high - near;
        if is_complete || (point.depth - last).abs() > near {
            let problem = format!(
                "the time begins again at {:?} s, and it is another curve that begins: give each curve a file of its own",
                point.time
            );
            return Err(source.wrong_line(point.line, &problem));
        }
        let step = time[n - 1] - time[n - 2];
        let begin = time[n - 1] + step;
        self.shift = begin - point.time;
        self.begin = n;
        self.notes.push(format!(
            "the time begins again in line {}: it goes on at {begin:.6} s, one step after the line before",
            point.line
        ));
        Ok(())
    }
}
