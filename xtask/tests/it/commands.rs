//! What a user types, and what comes back.

use crate::support::{text, xtask};

#[test]
fn scaling_factors_as_json_have_the_fields_of_the_contract() {
    let output = xtask(&[
        "scaling-factors",
        "--exponent",
        "2",
        "--relative-error",
        "0.01",
        "--format",
        "json",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let rows: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let row = &rows[0];
    for field in ["exponent", "scaling_factor", "error", "unknowns", "seconds"] {
        assert!(row[field].is_number(), "{field} of {row}");
    }
    let [factor, error] =
        ["scaling_factor", "error"].map(|field| row[field].as_f64().expect("a number"));
    // The finest value known is 0.6996.
    assert!(
        (factor - 0.6996).abs() <= error && error <= 0.01 * factor,
        "{row}"
    );
}

#[test]
fn scaling_factors_default_to_the_cone_and_the_paraboloid() {
    let output = xtask(&[
        "scaling-factors",
        "--relative-error",
        "0.01",
        "--format",
        "csv",
    ]);
    let table = text(&output.stdout);
    let exponents: Vec<&str> = table
        .lines()
        .filter_map(|line| line.split(',').next())
        .collect();
    assert_eq!(exponents, ["exponent", "1.0", "2.0"], "{table}");
}

#[test]
fn wrong_input_ends_with_status_2_and_says_what_is_allowed() {
    for (arguments, needed) in [
        (
            &["scaling-factors", "--exponent", "0.5"][..],
            "above 1/2, but is 0.5",
        ),
        (
            &["scaling-factors", "--exponent", "nan"],
            "above 1/2, but is NaN",
        ),
        (
            &["scaling-factors", "--exponent", "inf"],
            "above 1/2, but is inf",
        ),
        (
            &["scaling-factors", "--exponent", "two"],
            "invalid value 'two'",
        ),
        (
            &["scaling-factors", "--relative-error", "1"],
            "between 1e-6 and 0.1, but is 1",
        ),
        (
            &["scaling-factors", "--format", "xml"],
            "possible values: table, csv, json",
        ),
        (
            &["reproduce-figures", "--everything"],
            "unexpected argument",
        ),
        (
            &["evidence", "stationary", "--largest", "nan"],
            "between 2e3 and 1e7, but is NaN",
        ),
        (
            &["evidence", "stationary", "--table", "colours"],
            "possible values: growth, speed, error-bars",
        ),
        (&["reproduce"], "unrecognized subcommand"),
    ] {
        let output = xtask(arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(needed), "{arguments:?} says: {message}");
        assert!(
            output.stdout.is_empty(),
            "{arguments:?} printed {}",
            text(&output.stdout)
        );
    }
}

#[test]
fn every_command_explains_itself() {
    for command in [
        "reproduce-figures",
        "scaling-factors",
        "scaling-table",
        "evidence",
        "dependencies",
        "ci",
    ] {
        let output = xtask(&[command, "--help"]);
        assert_eq!(output.status.code(), Some(0), "{command}");
        assert!(
            text(&output.stdout).contains("Usage: cargo xtask"),
            "{}",
            text(&output.stdout)
        );
    }
}
