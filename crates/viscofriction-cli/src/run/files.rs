//! Output files of one answer: result.json, fields as NPY and CSV, pictures as SVG and PNG.

use std::iter;

use anyhow::Result;
use viscofriction::Estimate;
use viscofriction::bem_halfspace::Grid;
use viscofriction::npy::to_npy;
use viscofriction::scene::Source;
use viscofriction::solve::{Answer, Curve, HistoryRow, Problem};

use super::pictures::Shown;
use super::{Timed, pictures, report, spectrum};
use viscofriction_plot::Figure;

use crate::output::{NewFiles, OutputFolder, to_csv};
use crate::sweep::{labelled, labelled_in};

/// Names of all files that an answer may have.
pub(super) const NAMES: &str = "result.json report.html realisations.csv history.csv history.svg history.png history_over_time.svg history_over_time.png \
    motion.csv motion.svg motion.png motion_over_time.svg motion_over_time.png \
    pressure.csv pressure.npy pressure.svg pressure.png pressure_x.npy pressure_y.npy \
    gap.csv gap.npy gap.svg gap.png gap_x.npy gap_y.npy \
    line_load.csv line_load.npy line_load.svg line_load.png \
    spectral_sensitivity.csv spectral_sensitivity.svg spectral_sensitivity.png \
    line_pressure.csv line_pressure.npy line_pressure.svg line_pressure.png \
    temperature.csv temperature.npy temperature.svg temperature.png";

/// Pictures with the names of their files, without extension, in the order of the report.
pub(super) type Pictures = Vec<(&'static str, Figure)>;

/// Writes all files of the answer and the report; result.json is the last, so that its presence implies the others.
pub(super) fn write(
    (source, problem): (&Source, &Problem),
    timed: &Timed<'_>,
    folder: &OutputFolder,
) -> Result<()> {
    let answer = timed.answer;
    let out = folder.begin()?;
    let mut pictures = Pictures::new();
    if let Some(spectral) = &answer.spectral_sensitivity {
        let (names, columns): (Vec<String>, Vec<Vec<f64>>) = spectral.columns().into_iter().unzip();
        let row = |band: usize| columns.iter().map(move |values| values[band]);
        let rows = (0..spectral.bands.len()).map(|band| row(band).collect::<Vec<f64>>());
        out.write("spectral_sensitivity.csv", &to_csv(&names.join(" "), rows)?)?;
        let figure = spectrum::figure(problem, spectral);
        pictures.push(("spectral_sensitivity", figure));
    }
    if let Some(ensemble) = &answer.ensemble {
        let first = ensemble.realisations.first().into_iter();
        let keys = first.flat_map(|one| one.quantities.iter());
        let names = keys.map(|(key, _)| format!(" {key} {key}_error"));
        let rows = ensemble.realisations.iter().map(|one| {
            let quantities = one.quantities.iter();
            let numbers = quantities.flat_map(|(_, known)| [known.value, known.error]);
            (one.seed, numbers.collect::<Vec<f64>>())
        });
        let names = format!("seed{}", names.collect::<String>());
        out.write("realisations.csv", &to_csv(&names, rows)?)?;
    }
    let shown = shown(source, answer)?;
    write_pressure(answer, shown, (&out, &mut pictures))?;
    write_gap(answer, shown, (&out, &mut pictures))?;
    write_temperature(answer, shown, (&out, &mut pictures))?;
    write_line(answer, (&out, &mut pictures))?;
    write_history(answer, (&out, &mut pictures))?;
    let mut drawn = Pictures::new();
    for (name, figure) in pictures {
        if out.draw(name, &figure)? {
            drawn.push((name, figure));
        }
    }
    let page = report::page((source, problem), timed, &drawn)?;
    out.write("report.html", page.as_bytes())?;
    let result = format!("{}\n", serde_json::to_string_pretty(timed)?);
    out.write("result.json", result.as_bytes())?;
    out.finish()
}

/// Extent of the maps of the pressure and the temperature: the surroundings of a body, a period, or one of four mirror images.
fn shown(source: &Source, answer: &Answer) -> Result<Shown> {
    let scene = source.table()?;
    let map = scene
        .get("indenter")
        .and_then(|body| body.get("height-map"));
    let edges = map.and_then(|map| map.get("edges")?.as_str());
    Ok(match (answer.area_fraction, edges) {
        (None, _) => Shown::Body,
        (Some(_), Some("mirrored")) => Shown::Quarter,
        (Some(_), _) => Shown::Period,
    })
}

/// Writes the pressure on the half space as pressure.csv and pressure.npy, row-major with the shape (n_y, n_x), and its
/// coordinates; and adds its picture.
fn write_pressure(
    answer: &Answer,
    shown: Shown,
    (out, pictures): (&NewFiles<'_>, &mut Pictures),
) -> Result<()> {
    let Some(field) = &answer.fields.pressure else {
        return Ok(());
    };
    let [x, y] = write_field(
        ("pressure", "pressure_pa"),
        (&field.grid, field.origin),
        &field.pressure,
        out,
    )?;
    out.write("pressure_x.npy", &to_npy(&x, &[x.len()]))?;
    out.write("pressure_y.npy", &to_npy(&y, &[y.len()]))?;
    pictures.push(("pressure", pictures::pressure(answer, field, shown)?));
    Ok(())
}

/// Writes the gap around the contact as gap.csv and gap.npy, row-major with the shape (n_y, n_x), and its coordinates, and adds its
/// picture; of a line contact it is one line along x.
fn write_gap(
    answer: &Answer,
    shown: Shown,
    (out, pictures): (&NewFiles<'_>, &mut Pictures),
) -> Result<()> {
    let Some(field) = &answer.fields.gap else {
        return Ok(());
    };
    let places = (&field.grid, field.origin);
    let [x, y] = write_field(("gap", "gap_m"), places, &field.gap, out)?;
    out.write("gap_x.npy", &to_npy(&x, &[x.len()]))?;
    out.write("gap_y.npy", &to_npy(&y, &[y.len()]))?;
    let figure = if answer.is_per_length {
        let along = x.iter().zip(&field.gap).map(|(x, gap)| [*x, *gap]);
        pictures::curve("position x [m]", "gap [m]", along.collect())
    } else {
        let slides = answer.friction_coefficient.is_some();
        pictures::gap(field, (shown, slides))
    };
    pictures.push(("gap", figure));
    Ok(())
}

/// Writes the temperature rise of the surface as temperature.csv and temperature.npy, at the places of the pressure, and adds its
/// picture; of a line contact it is one line along x.
fn write_temperature(
    answer: &Answer,
    shown: Shown,
    (out, pictures): (&NewFiles<'_>, &mut Pictures),
) -> Result<()> {
    let Some(field) = &answer.fields.temperature else {
        return Ok(());
    };
    let places = (&field.grid, field.origin);
    let [x, _] = write_field(
        ("temperature", "temperature_rise_k"),
        places,
        &field.rise,
        out,
    )?;
    let figure = if answer.is_per_length {
        let along = x.iter().zip(&field.rise).map(|(x, rise)| [*x, *rise]);
        pictures::curve("position x [m]", "temperature rise [K]", along.collect())
    } else {
        pictures::temperature(field, shown)
    };
    pictures.push(("temperature", figure));
    Ok(())
}

/// Writes a field on the elements of a grid, whose first element has its centre at `origin` \[m], as NAME.csv and as NAME.npy,
/// row-major with the shape (n_y, n_x), and returns the coordinates along x and y, \[m].
fn write_field(
    (name, column): (&str, &str),
    (grid, origin): (&Grid, [f64; 2]),
    values: &[f64],
    out: &NewFiles<'_>,
) -> Result<[Vec<f64>; 2]> {
    let [x, y] = [0, 1].map(|axis| {
        let place = |index: usize| origin[axis] + index as f64 * grid.spacing()[axis];
        let places = (0..grid.shape()[axis]).map(place);
        places.collect::<Vec<f64>>()
    });
    // Rows run along x, as in height maps.
    let places = (0..y.len()).flat_map(|row| (0..x.len()).map(move |column| [column, row]));
    let value = |[column, row]: [usize; 2]| values[column * y.len() + row];
    let ordered: Vec<f64> = places.clone().map(value).collect();
    let rows = places.zip(&ordered);
    let table = rows.map(|([column, row], value)| [x[column], y[row], *value]);
    out.write(
        &format!("{name}.csv"),
        &to_csv(&format!("x_m y_m {column}"), table)?,
    )?;
    out.write(
        &format!("{name}.npy"),
        &to_npy(&ordered, &[y.len(), x.len()]),
    )?;
    Ok([x, y])
}

/// Writes the line load and the line pressure over the position, as CSV and NPY with the shape (n, 2), and adds their pictures.
fn write_line(answer: &Answer, (out, pictures): (&NewFiles<'_>, &mut Pictures)) -> Result<()> {
    let (load, pressure) = (&answer.fields.line_load, &answer.fields.line_pressure);
    let load = ("line_load", "load_n_per_m", "load per length [N/m]", load);
    let pressure = ("line_pressure", "pressure_pa", "pressure [Pa]", pressure);
    for (name, column, label, points) in [load, pressure] {
        if points.is_empty() {
            continue;
        }
        let names = format!("x_m {column}");
        out.write(&format!("{name}.csv"), &to_csv(&names, points)?)?;
        let array = to_npy(&points.concat(), &[points.len(), 2]);
        out.write(&format!("{name}.npy"), &array)?;
        let figure = pictures::curve("position x [m]", label, points.clone());
        pictures.push((name, figure));
    }
    Ok(())
}

/// Writes the columns of a history or motion with their errors, as history.csv or motion.csv.
fn write_columns(curve: &Curve, out: &NewFiles<'_>) -> Result<()> {
    let Curve { times, columns } = curve;
    let rows = times.iter().enumerate().map(|(index, time)| {
        let known = columns.iter().map(|column| column.values[index]);
        let numbers = known.flat_map(|known| [known.value, known.error]);
        iter::once(*time).chain(numbers).collect::<Vec<f64>>()
    });
    let names: String = columns
        .iter()
        .map(|column| column.name)
        .map(|[name, unit]| format!(" {name}_{unit} {name}_error_{unit}"))
        .collect();
    let header = format!("time_s{names}");
    out.write(&format!("{}.csv", curve.name()), &to_csv(&header, rows)?)
}

/// Writes a motion: its points with their errors, and the tangential force of all steps over position and over time.
fn write_motion(answer: &Answer, (out, pictures): (&NewFiles<'_>, &mut Pictures)) -> Result<()> {
    write_columns(&answer.fields.curve, out)?;
    let steps = &answer.fields.motion_steps;
    let force = labelled_in("tangential_force", answer.is_per_length);
    // Close the loop of a cycle over the position, but not over time.
    let first = steps.first().filter(|_| answer.dissipated_energy.is_some());
    let looped = steps.iter().chain(first).map(|step| [step[1], step[2]]);
    let looped = pictures::directed_curve("position x [m]", &force, looped.collect(), Vec::new());
    pictures.push(("motion", looped));
    let over_time = steps.iter().map(|step| [step[0], step[2]]);
    let over_time = pictures::curve("time t [s]", &force, over_time.collect());
    pictures.push(("motion_over_time", over_time));
    Ok(())
}

/// Writes a history: its points with their errors, force over depth if both vary, and the computed quantity over time. Its
/// pictures are curves through the steps between the points where these are known, else the points alone.
fn write_curve(answer: &Answer, (out, pictures): (&NewFiles<'_>, &mut Pictures)) -> Result<()> {
    let curve = &answer.fields.curve;
    write_columns(curve, out)?;
    let steps = &answer.fields.history_steps;
    let known = |name| curve.column(name).map_or(&[][..], |column| &column.values);
    let names = ["normal_force", "indentation_depth"];
    let ([force, depth], labels) = (
        names.map(known),
        names.map(|name| labelled_in(name, answer.is_per_length)),
    );
    let [of_force, of_depth] = [&labels[0], &labels[1]];
    // Steps that are the points need no markers.
    let has_markers = steps.len() != curve.times.len();
    let shown = |given: Vec<[f64; 2]>| if has_markers { given } else { Vec::new() };
    let varies = |values: &[Estimate]| values.windows(2).any(|pair| pair[0] != pair[1]);
    if varies(force) && varies(depth) {
        let given = depth.iter().zip(force);
        let given = given
            .map(|(depth, force)| [depth.value, force.value])
            .collect();
        let along = steps.iter().map(|step| [step[1], step[2]]).collect();
        let figure = if steps.is_empty() {
            pictures::points(of_depth, of_force, given)
        } else {
            pictures::directed_curve(of_depth, of_force, along, shown(given))
        };
        pictures.push(("history", figure));
    }
    let is_found = depth.iter().any(|depth| depth.error > 0.0);
    let (found, label, column) = if is_found {
        (depth, of_depth, 1)
    } else {
        (force, of_force, 2)
    };
    let given = curve
        .times
        .iter()
        .zip(found)
        .map(|(time, found)| [*time, found.value])
        .collect();
    let along = steps.iter().map(|step| [step[0], step[column]]).collect();
    let figure = if steps.is_empty() {
        pictures::points("time t [s]", label, given)
    } else {
        pictures::curve_through("time t [s]", label, along, shown(given))
    };
    pictures.push(("history_over_time", figure));
    Ok(())
}

/// Writes the motion, the indentation history or the sliding history that the answer has.
fn write_history(answer: &Answer, (out, pictures): (&NewFiles<'_>, &mut Pictures)) -> Result<()> {
    if !answer.fields.motion_steps.is_empty() {
        return write_motion(answer, (out, pictures));
    }
    if !answer.fields.curve.times.is_empty() {
        return write_curve(answer, (out, pictures));
    }
    let rows = &answer.fields.history;
    if rows.is_empty() {
        return Ok(());
    }
    out.write("history.csv", &to_csv("", rows)?)?;
    let point = |row: &HistoryRow| [row.sliding_distance_m, row.friction_coefficient];
    let points = rows.iter().map(point).collect();
    let friction = labelled("friction_coefficient");
    let figure = pictures::curve("sliding distance s [m]", &friction, points);
    pictures.push(("history", figure));
    Ok(())
}
