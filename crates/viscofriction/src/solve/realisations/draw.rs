//! Choice of the random surfaces that are solved with an error estimate, and of those solved on a coarse grid only.

use std::ops::Range;

use numerics::{Progress, WorkProgress};

use super::coarse::{self, Coarse, REFINEMENT_FACTORS, has_coarse_grids};
use super::each::{at_once, on_threads, solve_each};
use super::sample::{Counts, FEWEST, Sample, first_enough};
use super::statistic_of;
use crate::quantity::scattered;
use crate::solve::answer::{Answer, Fields};
use crate::solve::error::{Result, SolveError};
use crate::solve::problem::Problem;
use crate::solve::solved::Solved;

/// The sampled surfaces with their solutions.
pub(super) struct Drawn<'a> {
    problem: &'a Problem,
    progress: WorkProgress<'a>,
    /// Number of surfaces solved concurrently.
    at_once: usize,
    /// Answers of the first surfaces, with error estimates.
    pub(super) answers: Vec<Answer>,
    /// Coarse solutions of all surfaces, the first ones included; empty if no coarse grid is used.
    pub(super) coarse: Vec<Coarse>,
    /// Reason of the first surface that missed the request, or that the ensemble did; `None` if the request is met.
    pub(super) missed: Option<Box<SolveError>>,
}

/// Ratio of the number of elements of a coarse grid to that of the finest grid of an answer, above which the coarse grid is
/// not tried. Chosen: its spacing would be less than twice that of the answer, so that it saves little.
const MAX_COARSE_WORK: f64 = 0.25;

/// A coarse grid with its solutions for the first surfaces.
struct Trial {
    /// Ratio of the number of elements along each axis to that of the first grid of an answer.
    finer: usize,
    /// Solutions of the surfaces that have an answer, in their order.
    found: Vec<Coarse>,
}

/// Largest number of random surfaces that the problem allows: those of the scene, all of them without a standard error.
fn max_surfaces(problem: &Problem) -> usize {
    usize::try_from(problem.realisations()).unwrap_or(usize::MAX)
}

impl<'a> Drawn<'a> {
    /// Solves the first surface alone, whose grid gives the memory per surface, then the rest: all surfaces, or the smallest
    /// sample if a standard error is requested.
    pub(super) fn new(
        problem: &'a Problem,
        watch: &'a dyn Progress,
        first: impl FnOnce(&dyn Progress) -> Result<Answer>,
    ) -> Result<Self> {
        let count = match problem.standard_error() {
            Some(_) => FEWEST.min(max_surfaces(problem)),
            None => max_surfaces(problem),
        };
        let mut drawn = Self {
            problem,
            progress: WorkProgress::new(watch, count as f64),
            at_once: 1,
            answers: Vec::new(),
            coarse: Vec::new(),
            missed: None,
        };
        let first = first(&drawn.progress.partial(1.0));
        drawn.add_answers([first])?;
        drawn.progress.add(1.0);
        drawn.at_once = at_once(problem, &drawn.answers[0]);
        drawn.solve(count)?;
        Ok(drawn)
    }

    /// Appends answers, of which only the first keeps its fields. One that missed its request is used, and the reason kept.
    fn add_answers(&mut self, found: impl IntoIterator<Item = Result<Answer>>) -> Result<()> {
        for found in found {
            let Solved { mut answer, missed } = Solved::of(found)?;
            self.missed = self.missed.take().or(missed);
            if !self.answers.is_empty() {
                answer.fields = Fields::default();
            }
            self.answers.push(answer);
        }
        Ok(())
    }

    /// Solves further surfaces with error estimates until there are `count` answers.
    fn solve(&mut self, count: usize) -> Result<()> {
        let surfaces = self.answers.len()..count;
        let found = solve_each(self.problem, surfaces, self.at_once, &mut self.progress);
        self.add_answers(found)
    }

    /// Draws and solves further surfaces until the mean has the relative standard error `asked`, with the least work: with or
    /// without a coarse grid. If the largest number of surfaces does not suffice, the reason is kept in `missed`.
    pub(super) fn draw_until(&mut self, asked: f64) -> Result<()> {
        let most = max_surfaces(self.problem);
        if self.relative_standard_error() > asked && most > FEWEST {
            match self.best_coarse_grid(asked) {
                Some(trial) => self.with_coarse_grid(trial, asked, most)?,
                None => self.add_answers_until(asked, most)?,
            }
        }
        let reached = self.relative_standard_error();
        if reached > asked {
            let surfaces = self.surfaces();
            self.missed.get_or_insert_with(|| {
                Box::new(SolveError::TooFewSurfaces {
                    asked,
                    surfaces,
                    reached,
                })
            });
        }
        Ok(())
    }

    /// Number of surfaces that the mean includes.
    pub(super) fn surfaces(&self) -> usize {
        self.answers.len().max(self.coarse.len())
    }

    /// Adds answers, at most `most` in all, until their mean has the relative standard error `asked`. Answers beyond the
    /// smallest sufficient number are dropped, so that the result does not depend on the number of threads.
    fn add_answers_until(&mut self, asked: f64, most: usize) -> Result<()> {
        while self.relative_standard_error() > asked && self.answers.len() < most {
            let solved = self.answers.len();
            let wanted = self.counts(&[], asked, most, 1.0).coarse;
            self.progress
                .set_remaining_work(wanted.saturating_sub(solved).max(1) as f64);
            self.solve(most.min(solved + self.at_once))?;
            let enough = |Sample { fine, .. }: Sample| first_enough(fine, solved + 1, asked);
            let enough = self.with_sample(&[], enough).flatten();
            self.answers.truncate(enough.unwrap_or(self.answers.len()));
        }
        Ok(())
    }

    /// Adds answers and coarse solutions until they suffice, at most doubling both at a time, because the variance estimated from
    /// few surfaces is inaccurate.
    fn with_coarse_grid(&mut self, trial: Trial, asked: f64, most: usize) -> Result<()> {
        let Trial { finer, found } = trial;
        let part = self.coarse_work(&found);
        self.coarse = found;
        while self.relative_standard_error() > asked {
            // From the variances found so far, choose how many answers and coarse solutions this round shall reach.
            let now = Counts {
                fine: self.answers.len(),
                coarse: self.coarse.len(),
            };
            let wanted = self.counts(&self.coarse, asked, most, part);
            let coarse = wanted.coarse.clamp(now.coarse, 2 * now.coarse);
            let fine = wanted.fine.clamp(now.fine, 2 * now.fine).min(coarse);
            if [fine, coarse] == [now.fine, now.coarse] {
                break;
            }
            let [fine_left, coarse_left] = [
                wanted.fine.max(fine) - now.fine,
                wanted.coarse.max(coarse) - now.coarse,
            ];
            self.progress
                .set_remaining_work(fine_left as f64 + part * coarse_left as f64);
            // Solve the additional surfaces of this round, first with the accuracy of an answer, then on the coarse grid.
            self.solve(fine)?;
            // If a contact is not found on the coarse grid, continue with answers only.
            let Some(more) = self.on_coarse_grid(finer, now.coarse..coarse) else {
                self.coarse.clear();
                return self.add_answers_until(asked, most);
            };
            self.progress.add(part * more.len() as f64);
            self.coarse.extend(more);
        }
        Ok(())
    }

    /// The coarse grid that minimises the estimated work for an unlimited number of surfaces; `None` if no coarse grid saves work.
    /// A finer grid is not tried if its work would exceed the minimum even with perfect correlation.
    fn best_coarse_grid(&self, asked: f64) -> Option<Trial> {
        if !has_coarse_grids(self.problem) {
            return None;
        }
        // Begin with the work needed without a coarse grid; a coarse grid is only used if the total work is less.
        let alone = self.counts(&[], asked, usize::MAX, 1.0).coarse as f64;
        let (mut best, mut least) = (None, alone);
        for finer in REFINEMENT_FACTORS {
            let found = self.on_coarse_grid(finer, 0..self.answers.len())?;
            let part = self.coarse_work(&found);
            let Counts { fine, coarse } = self.counts(&found, asked, usize::MAX, part);
            let work = fine as f64 + part * coarse as f64;
            if work < least {
                (best, least) = (Some(Trial { finer, found }), work);
            }
            // Halving the spacing takes four times the work: stop if that cannot pay.
            let next = 4.0 * part;
            if next > MAX_COARSE_WORK || FEWEST as f64 + next * alone > least {
                break;
            }
        }
        best
    }

    /// Coarse solutions of a range of surfaces, in batches of four per concurrent answer; `None` if one contact is not found.
    fn on_coarse_grid(&self, finer: usize, surfaces: Range<usize>) -> Option<Vec<Coarse>> {
        let surfaces: Vec<u64> = surfaces.map(|surface| surface as u64).collect();
        let one = |surface| coarse::solve(self.problem, surface, finer);
        let found = surfaces
            .chunks(4 * self.at_once)
            .flat_map(|some| on_threads(some, one));
        found.collect()
    }

    /// Ratio of the work for a coarse solution to that for an answer, estimated as the ratio of the numbers of elements; infinite
    /// without a coarse solution.
    fn coarse_work(&self, coarse: &[Coarse]) -> f64 {
        let on = |elements: Option<usize>| elements.map_or(f64::INFINITY, |n| n as f64);
        let of_answer = self.answers[0]
            .period_grid
            .map(|[rows, columns]| rows * columns);
        on(coarse.first().map(|one| one.elements)) / on(of_answer)
    }

    /// A statistic of the quantity that the standard error refers to, friction or, if nothing slides, the area fraction. `None`
    /// if an answer or a coarse solution lacks it.
    fn with_sample<T>(&self, coarse: &[Coarse], statistic: impl FnOnce(Sample) -> T) -> Option<T> {
        let first = &self.answers[0];
        let asked = scattered().find(|quantity| (quantity.of)(first).is_some())?;
        statistic_of(asked, (&self.answers, coarse), statistic)
    }

    /// Numbers of answers and coarse solutions that reach the relative standard error `asked` with the least work, each at most
    /// `most`; `part` is the work for a coarse solution over that for an answer. Both are `most` if the quantity is not known.
    fn counts(&self, coarse: &[Coarse], asked: f64, most: usize, part: f64) -> Counts {
        let all = Counts {
            fine: most,
            coarse: most,
        };
        let wanted = self.with_sample(coarse, |sample| sample.wanted(asked, most, part));
        wanted.unwrap_or(all)
    }

    /// Relative standard error so far; infinite if the quantity is not known.
    fn relative_standard_error(&self) -> f64 {
        let error = self.with_sample(&self.coarse, |sample| sample.relative_standard_error());
        error.unwrap_or(f64::INFINITY)
    }
}
