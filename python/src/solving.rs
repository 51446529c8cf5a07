//! Scenes solved for arrays of loads, and the points of sweeps.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{IntoPyArray as _, PyArray1, PyArrayMethods as _, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use viscofriction::numerics::SilentProgress;
use viscofriction::scene::{Indenter, Layer, LoadPoint, Method, SceneError, Source};
use viscofriction::solve::{
    Budget, Parts, Sensitivity, body, body_of_heights, check_derivatives, half_space,
    spectral_sensitivity, with_fields, with_sensitivity,
};
use viscofriction::sweep::{Plan, SweepRow, Varied, Vary, each_once, header};
use viscofriction::{
    Answer, Estimate, Files, Motion, Problem, QUANTITIES, ReadFile, Scene, SolveError, Warning,
    plan, solve,
};

use crate::background;
use crate::reading::read_file;
use crate::roughness::topography;
use crate::tables::{table, wrong};

/// Sets a number of the load that may differ from scene to scene.
type Column = fn(&mut Scene, f64);

/// A scene with the columns that differ between the solved scenes.
struct Scenes {
    scene: Scene,
    folder: PathBuf,
    /// Body and elastomer of all scenes.
    parts: Parts,
    columns: Vec<(Column, Vec<f64>)>,
}

impl Scenes {
    /// Scene number `index`, with one of `parts` equal parts of the memory.
    fn scene(&self, index: usize, parts: u64) -> Result<Scene, SceneError> {
        let mut scene = self.scene.clone();
        for (column, values) in &self.columns {
            column(&mut scene, values[index]);
        }
        scene.solve.limit_memory(None, parts)?;
        Ok(scene)
    }

    /// Problem number `index`, with one of `parts` equal parts of the memory.
    fn problem(&self, index: usize, parts: u64) -> PyResult<Problem> {
        let scene = self.scene(index, parts).map_err(wrong)?;
        let problem = Problem::with_parts(&scene, self.parts.clone(), &self.folder, read_file)
            .map_err(wrong)?;
        plan(&problem).map_err(wrong)?;
        Ok(problem)
    }
}

/// The setter of a column by its name.
fn column(name: &str) -> PyResult<Column> {
    let set: Column = match name {
        "normal_force" => |scene, force| scene.load.normal_force = Some(force),
        "indentation_depth" => |scene, depth| scene.load.indentation_depth = Some(depth),
        "mean_pressure" => |scene, pressure| scene.load.mean_pressure = Some(pressure),
        "velocity" => |scene, velocity| scene.load.velocity = Some(velocity),
        "track" => |scene, track| scene.load.track = Some(track),
        "stroke" => |scene, stroke| scene.load.stroke = Some(stroke),
        "frequency" => |scene, frequency| scene.load.frequency = Some(frequency),
        "thickness" => |scene, thickness| scene.layer = Some(Layer { thickness }),
        "duration" => |scene, duration| scene.solve.duration = Some(duration),
        "sliding_distance" => |scene, distance| scene.solve.sliding_distance = Some(distance),
        other => return Err(wrong(format!("{other} does not vary from scene to scene"))),
    };
    Ok(set)
}

/// Arguments of [`solve_loads`].
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Loads<'py> {
    scene: Bound<'py, PyDict>,
    /// Folder of the files that the scene names.
    folder: PathBuf,
    /// Heights of the body, in place of the file that the scene names.
    heights: Option<PyReadonlyArray2<'py, f64>>,
    /// Arrays of equal length by name.
    columns: Vec<(String, PyReadonlyArray1<'py, f64>)>,
    /// A history that replaces that of the scene: name of the control, times, and values.
    history: Option<(
        String,
        PyReadonlyArray1<'py, f64>,
        PyReadonlyArray1<'py, f64>,
    )>,
    /// True to compute fields that may take longer than the answer.
    fields: bool,
    /// True to compute the derivatives by the numbers of the scene.
    sensitivity: bool,
    spectral_sensitivity: bool,
}

impl Loads<'_> {
    /// The scenes of the arguments.
    fn scenes(&self) -> PyResult<Scenes> {
        let columns = self
            .columns
            .iter()
            .map(|(name, values)| Ok((column(name)?, values.as_array().to_vec())));
        let mut scene = Scene::try_from(table(&self.scene, "")?).map_err(wrong)?;
        if let Some((control, times, values)) = &self.history {
            let (times, values) = (times.as_array(), values.as_array());
            let point = |(&time, &value): (&f64, &f64)| LoadPoint {
                time,
                normal_force: (control == "normal_force").then_some(value),
                indentation_depth: (control == "indentation_depth").then_some(value),
            };
            scene.load.history = Some(times.iter().zip(values).map(point).collect());
        }
        let files = Files::of(&scene, &self.folder, read_file).map_err(wrong)?;
        let body = match (&self.heights, &scene.indenter) {
            (Some(heights), Indenter::HeightMap(table)) => {
                body_of_heights(table, topography(heights, table)?)
            }
            _ => body(&scene.indenter, &files),
        };
        let parts = Parts {
            body: Arc::new(body.map_err(wrong)?),
            half_space: Arc::new(half_space(&scene.material, &files).map_err(wrong)?),
        };
        Ok(Scenes {
            scene,
            folder: self.folder.clone(),
            parts,
            columns: columns.collect::<PyResult<_>>()?,
        })
    }
}

impl Loads<'_> {
    /// Rejects requested derivatives that the method of a problem does not have.
    fn check_derivatives(&self, problem: &Problem) -> Result<(), SolveError> {
        if !(self.sensitivity || self.spectral_sensitivity) {
            return Ok(());
        }
        let by_numbers = self.sensitivity.then_some("sensitivity");
        let by_moduli = self.spectral_sensitivity.then_some("spectral_sensitivity");
        let method = plan(problem)?.method();
        Ok(check_derivatives(problem, method, by_numbers, by_moduli)?)
    }
}

/// Solves one scene for each row of the columns.
///
/// Returns a dictionary: `columns`, arrays of all numbers by name, NaN if not known; `answers`, other results as dictionaries
/// or None, with the JSON of a single answer; `failures`, messages or None; `wrong_inputs`, whether the input was invalid.
#[pyfunction]
pub(crate) fn solve_loads<'py>(
    py: Python<'py>,
    loads: Loads<'py>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let scenes = loads.scenes()?;
    let (fields, sensitivity) = (loads.fields, loads.sensitivity);
    let spectral = loads.spectral_sensitivity;
    let count = scenes.columns.first().map_or(1, |(_, values)| values.len());
    let threads = scenes.scene.solve.threads;
    let problems = (0..count).map(|index| scenes.problem(index, 1));
    // Fields are those of a single scene.
    let problems = problems.map(|problem| match count {
        1 => problem.map(Problem::with_gap),
        _ => problem,
    });
    let problems: Vec<Problem> = problems.collect::<PyResult<_>>()?;
    for problem in &problems {
        loads.check_derivatives(problem).map_err(wrong)?;
    }
    // A history in closed form may take seconds, so it runs in the background.
    let is_quick = |problem: &Problem| {
        let is_closed = plan(problem).is_ok_and(|plan| plan.method() == Method::Analytic);
        is_closed && !matches!(problem.motion(), Motion::History { .. })
    };
    let is_quick = count == 1 && is_quick(&problems[0]);
    let has_limit = scenes.scene.solve.max_memory.is_some();
    let work = move |index: usize, parts: u64| {
        let solve = |problem: &Problem| -> Result<Answer, SolveError> {
            let mut answer = solve(problem)?;
            if sensitivity {
                let files = (&*scenes.folder, read_file as ReadFile);
                let scene = scenes.scene(index, parts)?;
                answer = with_sensitivity(&scene, files, problem, answer, &SilentProgress)?;
            }
            if spectral {
                answer.spectral_sensitivity =
                    Some(spectral_sensitivity(problem, &answer, &SilentProgress)?);
            }
            Ok(if fields {
                with_fields(problem, answer)
            } else {
                answer
            })
        };
        if parts == 1 || !has_limit {
            return Some(solve(&problems[index]));
        }
        // With all of the memory the problem was already built without an error.
        let problem = scenes.problem(index, parts).ok()?;
        let answer = solve(&problem);
        (!problem.is_short_of_memory()).then_some(answer)
    };
    let answers = if is_quick {
        // Faster than starting a thread.
        py.detach(|| work(0, 1)).into_iter().collect()
    } else {
        background::all(py, count, threads, progress, work)?
    };
    // A history given as arrays is returned as arrays only.
    let has_text = count == 1 && loads.history.is_none();
    to_python(py, answers, has_text)
}

/// The answers as the dictionary of [`solve_loads`].
fn to_python(
    py: Python<'_>,
    answers: Vec<Result<Answer, SolveError>>,
    has_text: bool,
) -> PyResult<Bound<'_, PyDict>> {
    let names = Answer::columns();
    let mut columns = vec![vec![f64::NAN; answers.len()]; names.len()];
    let [others, failures, wrong_inputs] = [(); 3].map(|()| PyList::empty(py));
    for (index, answer) in answers.into_iter().enumerate() {
        failures.append(answer.as_ref().err().map(ToString::to_string))?;
        wrong_inputs.append(answer.as_ref().is_err_and(SolveError::is_wrong_input))?;
        let reached = answer.or_else(|error| error.reached().cloned().ok_or(error));
        match reached {
            Ok(answer) => {
                for (column, (_, value)) in columns.iter_mut().zip(answer.numbers()) {
                    column[index] = value.unwrap_or(f64::NAN);
                }
                let json = has_text
                    .then(|| serde_json::to_string(&answer))
                    .transpose()
                    .map_err(wrong)?;
                let other = other(py, answer)?;
                other.set_item("json", json)?;
                others.append(other)?;
            }
            Err(_) => others.append(py.None())?,
        }
    }
    let arrays = PyDict::new(py);
    for (name, column) in names.into_iter().zip(columns) {
        arrays.set_item(name, column.into_pyarray(py))?;
    }
    let result = PyDict::new(py);
    result.set_item("columns", arrays)?;
    result.set_item("answers", others)?;
    result.set_item("failures", failures)?;
    result.set_item("wrong_inputs", wrong_inputs)?;
    Ok(result)
}

/// Results other than single numbers.
fn other(py: Python<'_>, answer: Answer) -> PyResult<Bound<'_, PyDict>> {
    let dictionary = PyDict::new(py);
    dictionary.set_item("method", answer.method.name())?;
    dictionary.set_item("model", answer.model.name())?;
    dictionary.set_item("is_per_length", answer.is_per_length)?;
    dictionary.set_item("unknowns", answer.unknowns)?;
    dictionary.set_item("iterations", answer.iterations)?;
    let warnings: Vec<String> = answer.warnings.iter().map(Warning::to_string).collect();
    dictionary.set_item("warnings", warnings)?;
    dictionary.set_item("not_modelled", &answer.not_modelled)?;
    let left_out = answer.left_out.iter().copied().map(<&str>::from);
    let left_out: Vec<&str> = left_out.collect();
    dictionary.set_item("left_out", left_out)?;
    add_derivatives(py, &answer, &dictionary)?;
    if let Some(field) = answer.fields.pressure {
        let shape = field.grid.shape();
        let pressure = field.pressure.into_pyarray(py).reshape(shape)?;
        dictionary.set_item("pressure", pressure)?;
        dictionary.set_item("origin", field.origin)?;
        dictionary.set_item("spacing", field.grid.spacing())?;
    }
    if let Some(field) = answer.fields.gap {
        let shape = field.grid.shape();
        dictionary.set_item("gap", field.gap.into_pyarray(py).reshape(shape)?)?;
        dictionary.set_item("gap_origin", field.origin)?;
        dictionary.set_item("gap_spacing", field.grid.spacing())?;
    }
    if let Some(field) = answer.fields.temperature {
        let shape = field.grid.shape();
        let rise = field.rise.into_pyarray(py).reshape(shape)?;
        dictionary.set_item("temperature", rise)?;
    }
    let curve = answer.fields.curve;
    if !curve.times.is_empty() {
        let name = curve.name();
        let [history, errors] = [PyDict::new(py), PyDict::new(py)];
        history.set_item("time", curve.times.into_pyarray(py))?;
        for column in curve.columns {
            let [name, _] = column.name;
            errors.set_item(format!("{name}_error"), column.error())?;
            let values: Vec<f64> = column.values.iter().map(|known| known.value).collect();
            history.set_item(name, values.into_pyarray(py))?;
        }
        dictionary.set_item(name, history)?;
        dictionary.set_item(format!("{name}_errors"), errors)?;
    }
    for (name, pairs) in [
        ("line_load", &answer.fields.line_load),
        ("line_pressure", &answer.fields.line_pressure),
    ] {
        if !pairs.is_empty() {
            let flat = pairs.as_flattened().to_vec().into_pyarray(py);
            dictionary.set_item(name, flat.reshape([pairs.len(), 2])?)?;
        }
    }
    Ok(dictionary)
}

/// Adds derivatives and budget, if requested.
fn add_derivatives<'py>(
    py: Python<'py>,
    answer: &Answer,
    dictionary: &Bound<'py, PyDict>,
) -> PyResult<()> {
    if !answer.sensitivity.is_empty() {
        dictionary.set_item("sensitivity", derivatives(py, &answer.sensitivity)?)?;
    }
    if !answer.budget.entries.is_empty() {
        dictionary.set_item("budget", budget(py, &answer.budget)?)?;
    }
    if let Some(spectral) = &answer.spectral_sensitivity {
        let columns = PyDict::new(py);
        for (name, values) in spectral.columns() {
            columns.set_item(name, values.into_pyarray(py))?;
        }
        columns.set_item(
            "outside_valid_frequencies",
            spectral.outside_valid_frequencies,
        )?;
        dictionary.set_item("spectral_sensitivity", columns)?;
    }
    Ok(())
}

/// Derivatives with their errors, by number of the scene and quantity.
fn derivatives<'py>(
    py: Python<'py>,
    sensitivities: &[Sensitivity],
) -> PyResult<Bound<'py, PyDict>> {
    let by_number = PyDict::new(py);
    for sensitivity in sensitivities {
        let by_quantity = PyDict::new(py);
        for (key, known) in sensitivity.derivatives.iter() {
            by_quantity.set_item(key, known.value)?;
            by_quantity.set_item(format!("{key}_error"), known.error)?;
        }
        by_number.set_item(&sensitivity.parameter, by_quantity)?;
    }
    Ok(by_number)
}

/// Uncertainties by source and quantity, with the total.
fn budget<'py>(py: Python<'py>, budget: &Budget) -> PyResult<Bound<'py, PyDict>> {
    let sources = PyDict::new(py);
    for (source, known) in budget.rows() {
        let of_source = PyDict::new(py);
        for (key, known) in known.iter() {
            of_source.set_item(key, known)?;
        }
        sources.set_item(source, of_source)?;
    }
    Ok(sources)
}

/// Key, label at an axis, unit of a body and unit of a cylinder of each quantity of an answer.
#[pyfunction]
pub(crate) fn quantities() -> Vec<(&'static str, String, &'static str, &'static str)> {
    let quantities = QUANTITIES.iter().map(|quantity| {
        let unit = quantity.unit;
        (
            quantity.key,
            quantity.label(),
            unit.of_body,
            unit.of_cylinder,
        )
    });
    quantities.collect()
}

/// A value with its error as the program prints it.
#[pyfunction]
pub(crate) fn printed(value: f64, error: f64) -> String {
    Estimate::new(value, error).to_string()
}

/// Each warning of many answers once, with the number of answers that share it.
#[pyfunction]
pub(crate) fn shared_warnings(answers: Vec<Vec<String>>) -> Vec<String> {
    let answers = answers
        .iter()
        .map(|warnings| warnings.iter().map(String::as_str).collect());
    let shared = each_once(answers).into_iter();
    shared.map(|warning| warning.to_string()).collect()
}

/// Arguments of a sweep.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Sweep<'py> {
    scene: Bound<'py, PyDict>,
    /// Folder of the files that the scene names.
    folder: PathBuf,
    /// Varied keys with their values.
    vary: Vec<(String, Values<'py>)>,
    /// True to compute the uncertainties from the covariance of the material and from the scene.
    sensitivity: bool,
    /// Number of samples of what is uncertain in the scene; `None` for no samples.
    samples: Option<i64>,
}

/// Values of a varied key.
#[derive(FromPyObject)]
enum Values<'py> {
    Numbers(PyReadonlyArray1<'py, f64>),
    Texts(Vec<String>),
}

impl Values<'_> {
    /// The values for the plan.
    fn varied(&self) -> Vec<Varied> {
        match self {
            Self::Numbers(values) => values
                .as_array()
                .iter()
                .copied()
                .map(Varied::Number)
                .collect(),
            Self::Texts(values) => values.iter().cloned().map(Varied::Text).collect(),
        }
    }
}

impl Sweep<'_> {
    /// The plan of the sweep.
    fn plan(&self) -> PyResult<Plan> {
        let text = table(&self.scene, "")?.to_string();
        let source = Source::new(&self.folder.join("scene"), text.into_bytes()).map_err(wrong)?;
        let vary = self.vary.iter().map(|(key, values)| {
            Ok(Vary {
                key: key.clone(),
                values: values.varied(),
            })
        });
        let samples = self.samples.map(|count| Vary::samples(&count.to_string()));
        let samples =
            samples.map(|samples| samples.map_err(|why| wrong(why.replacen("N ", "samples ", 1))));
        let vary = vary.chain(samples).collect::<PyResult<Vec<_>>>()?;
        let mut plan = Plan::new(source, &vary, read_file).map_err(|error| self.wrong(&error))?;
        plan.sensitivity = self.sensitivity || self.samples.is_some();
        Ok(plan)
    }

    /// Exception with a message about the scene, without the line of its text, which was not written by the caller.
    fn wrong(&self, error: &impl std::fmt::Display) -> PyErr {
        let text = error.to_string();
        let of_scene = text.strip_prefix(&*self.folder.join("scene").to_string_lossy());
        let problem = of_scene.and_then(|located| located.split_once(": "));
        wrong(problem.map_or(&*text, |(_, problem)| problem))
    }
}

/// Names of the columns and number of points of a sweep, after validation of all points.
#[pyfunction]
pub(crate) fn sweep_plan(sweep: Sweep<'_>) -> PyResult<(Vec<String>, usize)> {
    let plan = sweep.plan()?;
    let points: Vec<usize> = (0..plan.n_points()).collect();
    plan.validate(&points)
        .map_err(|error| sweep.wrong(&error))?;
    Ok((header(&plan), plan.n_points()))
}

/// Index of the first row that was changed or belongs to another sweep, with the reason; None if all rows are valid.
#[pyfunction]
pub(crate) fn sweep_problem(
    sweep: Sweep<'_>,
    rows: Vec<(usize, Vec<String>)>,
) -> PyResult<Option<(usize, String)>> {
    let plan = sweep.plan()?;
    let header = header(&plan);
    let numbered = rows.into_iter().enumerate();
    let mut problems = numbered.filter_map(|(place, (point, fields))| {
        let row = SweepRow { point, fields };
        let other = || "it holds other points".to_owned();
        match row.check(&header) {
            Ok(()) => (!plan.has(&row)).then(|| (place, other())),
            Err(problem) => Some((place, problem.to_string())),
        }
    });
    Ok(problems.next())
}

/// Index of the first row of a table with these names of columns that was changed, with the reason; None if all rows are as
/// they were computed.
#[pyfunction]
pub(crate) fn changed_row(header: Vec<String>, rows: Vec<Vec<String>>) -> Option<(usize, String)> {
    let rows = rows.into_iter().enumerate();
    rows.map(|(place, fields)| {
        (
            place,
            SweepRow {
                point: place,
                fields,
            },
        )
    })
    .find_map(|(place, row)| Some((place, row.check(&header).err()?.to_string())))
}

/// Computes points of a sweep. `take` receives lists of points and their rows, as the program writes them, soon after they are
/// computed and in any order, and at least every 50 ms an empty list.
#[pyfunction]
pub(crate) fn sweep_points<'py>(
    py: Python<'py>,
    sweep: Sweep<'py>,
    points: Vec<usize>,
    take: &Bound<'py, PyAny>,
) -> PyResult<()> {
    let plan = sweep.plan()?;
    if let Some(point) = points.iter().find(|point| **point >= plan.n_points()) {
        return Err(wrong(format!("points: there is no point {point}")));
    }
    let count = points.len();
    let work = move |index: usize, parts| plan.solve_within(points[index], parts);
    background::each(py, count, None, work, |finished| {
        let rows = finished.into_iter().map(|(_, row)| {
            let row = row.map_err(wrong)?;
            Ok((row.point, row.fields))
        });
        let rows: Vec<(usize, Vec<String>)> = rows.collect::<PyResult<_>>()?;
        take.call1((rows,)).map(drop)
    })
}

/// A new array of function values.
pub(crate) fn mapped<'py>(
    values: &PyReadonlyArray1<'py, f64>,
    function: impl Fn(f64) -> PyResult<f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let array = values.as_array();
    let results = array.iter().map(|value| function(*value));
    let results: Vec<f64> = results.collect::<PyResult<_>>()?;
    Ok(results.into_pyarray(values.py()))
}
