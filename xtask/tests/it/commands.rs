//! What a user types, and what comes back.

use crate::support::{text, xtask};

/// What a command prints that succeeds, and does so on standard output.
fn printed(line: &str) -> String {
    let output = xtask(line);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn scaling_factors_of_cone_and_paraboloid_are_printed_with_their_errors() {
    let table = printed("scaling-factors --relative-error 0.01");
    let numbers = |row: &str| -> Vec<f64> {
        let cells = row.split('|').map(|cell| cell.trim().parse());
        cells.flatten().collect()
    };
    let rows: Vec<Vec<f64>> = table.lines().skip(2).map(numbers).collect();
    // The finest values known.
    for (row, [exponent, known]) in rows.iter().zip([[1.0, 0.5674], [2.0, 0.6996]]) {
        let [p, factor, error, unknowns, seconds] = row[..] else {
            panic!("{table}");
        };
        let is_asked = (p - exponent).abs() < 1e-15;
        assert!(is_asked && unknowns > 0.0 && seconds > 0.0, "{table}");
        let off = (factor - known).abs();
        assert!(off <= error && error <= 0.01 * factor, "{table}");
    }
    assert_eq!(rows.len(), 2, "{table}");
    let json = printed("scaling-factors --exponent 2 --relative-error 0.01 --format json");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let factor = json[0]["scaling_factor"].as_f64().expect("a factor");
    assert!((factor - rows[1][1]).abs() < 1e-6, "{json} and {table}");
    let csv = printed("scaling-factors --exponent 2 --relative-error 0.01 --format csv");
    let header = "exponent,scaling_factor,error,unknowns,seconds\n2.0,";
    assert!(csv.starts_with(&format!("{header}{factor},")), "{csv}");
}

#[test]
fn wrong_input_ends_with_status_2_and_says_what_is_allowed() {
    for (line, needed) in [
        ("scaling-factors --exponent 0.5", "above 1/2, but is 0.5"),
        ("scaling-factors --exponent nan", "above 1/2, but is NaN"),
        ("scaling-factors --exponent inf", "above 1/2, but is inf"),
        ("scaling-factors --exponent two", "invalid value 'two'"),
        ("scaling-factors --relative-error 1", "0.1, but is 1"),
        ("reproduce-figures --everything", "unexpected argument"),
        ("evidence stationary --largest nan", "1e7, but is NaN"),
        ("evidence stationary --table colours", "growth, error-bars"),
        ("evidence calibration --scenes 0", "from 1 to 100000"),
        ("evidence stability --only nonsense", "is in no case"),
        ("evidence tuning --constant PI", "is not in"),
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
