//! What a user types, and what comes back.

use crate::support::{text, xtask};

/// What a command prints that succeeds, and does so on standard output.
fn printed(line: &str) -> String {
    let output = xtask(line);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn scaling_factors_as_json_have_the_fields_of_the_contract() {
    let json = printed("scaling-factors --exponent 2 --relative-error 0.01 --format json");
    let rows: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let number = |field: &str| rows[0][field].as_f64().expect(field);
    let [exponent, factor, error] = ["exponent", "scaling_factor", "error"].map(number);
    let [unknowns, seconds] = ["unknowns", "seconds"].map(number);
    let is_solved = unknowns > 0.0 && seconds > 0.0;
    assert!((exponent - 2.0).abs() < 1e-15 && is_solved, "{json}");
    // The finest value known is 0.6996.
    let off = (factor - 0.6996).abs();
    assert!(off <= error && error <= 0.01 * factor, "{json}");
}

#[test]
fn scaling_factors_default_to_the_cone_and_the_paraboloid() {
    let table = printed("scaling-factors --relative-error 0.01 --format csv");
    let cells = table.lines().map(|line| line.split(',').next());
    let exponents: Vec<&str> = cells.flatten().collect();
    assert_eq!(exponents, ["exponent", "1.0", "2.0"], "{table}");
}

#[test]
fn wrong_input_ends_with_status_2_and_says_what_is_allowed() {
    for (line, needed) in [
        ("scaling-factors --exponent 0.5", "above 1/2, but is 0.5"),
        ("scaling-factors --exponent nan", "above 1/2, but is NaN"),
        ("scaling-factors --exponent inf", "above 1/2, but is inf"),
        ("scaling-factors --exponent two", "invalid value 'two'"),
        ("scaling-factors --relative-error 1", "0.1, but is 1"),
        ("scaling-factors --format xml", "table, csv, json"),
        ("reproduce-figures --everything", "unexpected argument"),
        ("evidence stationary --largest nan", "1e7, but is NaN"),
        ("evidence stationary --table colours", "growth, error-bars"),
        ("evidence calibration --scenes 0", "from 1 to 100000"),
        ("evidence stability --only nonsense", "is in no case"),
        ("reproduce", "unrecognized subcommand"),
    ] {
        let output = xtask(line);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {message}");
        assert!(message.contains(needed), "{line} says: {message}");
        assert_eq!(text(&output.stdout), "", "{line} printed");
    }
}

#[test]
fn every_command_explains_itself() {
    let commands = "reproduce-figures scaling-factors scaling-table evidence dependencies ci";
    for command in commands.split(' ') {
        let help = printed(&format!("{command} --help"));
        assert!(help.contains("Usage: cargo xtask"), "{help}");
    }
}
