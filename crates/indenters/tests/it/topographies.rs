//! Heights as text say the same in whatever way they are written, and turn with the direction of motion.

use indenters::topography::{Topography, TopographyError};

const SPACING: [f64; 2] = [0.5, 2.0];

fn read(text: &str) -> Result<Topography, TopographyError> {
    Topography::read("csv", text.as_bytes(), Some(SPACING), 1 << 20)
}

#[test]
fn separators_and_decimal_marks_do_not_matter() {
    let expected = [1.5, -2e-3, 0.25, 4.0, 5.0, 6.0];
    for text in [
        "1.5,-2e-3,0.25\n4,5,6",
        "# um\r\n1.5, -2e-3, 0.25\r\n\r\n4, 5, 6\r\n",
        "1,5;-2e-3;0,25\n4;5;6",
        "\"1,5\"\t-2e-3\t0,25\n4,0\t5,0\t6,0",
        "  1,5 -2,0e-3  0,25\n4,0 5,0 6,0",
        "\u{feff}1.5\t-2e-3\t0.25\n4\t5\t6\n",
    ] {
        let found = read(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let is_same = found.heights == expected && found.shape == [2, 3];
        assert!(is_same, "{text}: {found:?}");
    }
    let utf16 = || "\u{feff}1.5;-2e-3;0.25\n4;5;6\n".encode_utf16();
    let [little, big] = [u16::to_le_bytes, u16::to_be_bytes].map(|bytes| utf16().flat_map(bytes));
    for bytes in [little.collect::<Vec<u8>>(), big.collect()] {
        let found =
            Topography::read("txt", &bytes, Some(SPACING), 1 << 20).expect("heights in UTF-16");
        assert_eq!(found.heights, expected, "{bytes:?}");
    }
    for text in ["1,,3\n4,nan,6", "1\t\t3\n4\tNA\t6", "1;;3\n4;--;6"] {
        let found = read(text).expect("heights with holes");
        let are_missing: Vec<bool> = found.heights.iter().map(|height| height.is_nan()).collect();
        let expected = [false, true, false, false, true, false];
        assert_eq!(are_missing, expected, "{text}");
        let filled = found.filled().heights;
        // Of the two holes each has the other as its neighbour.
        assert_eq!(filled, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "{text}");
    }
    read("1 2\n3 inf").expect_err("no infinite height");
}

/// A ramp that rises along y is one that rises along the motion, where that is along y.
#[test]
fn the_direction_of_motion_becomes_x() {
    let ramp = read("0 0 0\n1 1 1").expect("a ramp");
    for (quarters, tilt, shape) in [
        (0, [0.0, 0.5], [2, 3]),
        (1, [0.5, 0.0], [3, 2]),
        (2, [0.0, -0.5], [2, 3]),
        (3, [-0.5, 0.0], [3, 2]),
    ] {
        let turned = ramp.clone().turned(quarters);
        assert_eq!(turned.shape, shape, "{quarters}");
        for axis in [0, 1] {
            let off = turned.tilt()[axis] - tilt[axis];
            assert!(off.abs() < 1e-15, "{quarters}: {:?}", turned.tilt());
        }
    }
    let map = ramp.body().expect("a body");
    let corners = (map.shape(), map.heights(), map.spacing());
    let expected: &[f64] = &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0];
    assert_eq!(
        corners,
        ([3, 2], expected, SPACING),
        "x first, and into the body"
    );
}
