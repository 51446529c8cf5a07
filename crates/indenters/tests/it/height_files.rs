//! What is no map is refused with its reason, and what heads of files state counts.

#[cfg(feature = "topography")]
use indenters::topography::LateralUnit;
use indenters::topography::{Topography, TopographyError};

const SPACING: [f64; 2] = [2e-6, 3e-6];

fn read(
    extension: &str,
    contents: impl AsRef<[u8]>,
    spacing: Option<[f64; 2]>,
) -> Result<Topography, TopographyError> {
    Topography::read(extension, contents.as_ref(), spacing, 1 << 24)
}

/// A surface of 8 × 6 points, `scale` times its heights.
fn height(column: u32, row: u32, scale: f64) -> f64 {
    let phase = f64::from(7 * column + 5 * row * row + column * column);
    scale * (1.0 + phase.sin())
}

fn rows(scale: f64) -> Vec<Vec<String>> {
    let row = |row| {
        let heights = (0..8).map(|column| height(column, row, scale));
        heights.map(|height| format!("{height:.9e}")).collect()
    };
    (0..6).map(row).collect()
}

fn lines(rows: &[Vec<String>], separator: &str) -> String {
    rows.iter().map(|row| row.join(separator) + "\n").collect()
}

/// Whether the heights are those of the surface, and so far apart.
fn is_surface(found: &Topography, spacing: [f64; 2]) -> bool {
    let is_height =
        |(index, found): (u32, &f64)| (found - height(index % 8, index / 8, 1e-6)).abs() < 1e-12;
    let are_heights = (0..48).zip(&found.heights).all(is_height);
    let are_apart = (0..2).all(|axis| (found.spacing[axis] / spacing[axis] - 1.0).abs() < 2e-3);
    found.shape == [6, 8] && are_heights && are_apart
}

/// Requires that texts are refused, with these reasons.
fn assert_refused<const N: usize>(texts: [(String, &str); N]) {
    for (text, reason) in texts {
        let refused = read("csv", &text, Some(SPACING))
            .expect_err(&text)
            .to_string();
        assert!(refused.contains(reason), "{refused}\n--- of\n{text}");
    }
}

#[test]
fn texts_of_something_else_than_heights_are_refused() {
    let plain = lines(&rows(1e-6), ",");
    let labelled = |label: &dyn Fn(usize) -> String| -> String {
        let rows = rows(1e-6).into_iter().enumerate();
        rows.map(|(index, row)| format!("{},{}\n", label(index), row.join(",")))
            .collect()
    };
    let index = labelled(&|index| index.to_string());
    let axis = labelled(&|index| format!("{:.3}", 0.125 * index as f64));
    let point = |index: u32| {
        format!(
            "{} {} {}\n",
            index % 8,
            index / 8,
            height(index % 8, index / 8, 1.0)
        )
    };
    let points: String = (0..48).map(point).collect();
    let gwyddion = "# Channel: A\n# Width: 16 um\n# Height: 18 um\n# Value units: V\n";
    let corner = "column 1: a finite height is needed, and not 'y\\x'; are the first row";
    let phase = "line 8: a second block of heights begins ('# Phase')";
    assert_refused([
        (
            format!(",0,1,2,3,4,5,6,7\n{index}"),
            "first row and the first column",
        ),
        (index, "first column is an index"),
        (axis, "first column is an index or an axis"),
        (format!("0,1,2,3,4,5,6,7\n{plain}"), "first row is an index"),
        (format!("y\\x,1,2,3,4,5,6,7\n{plain}"), corner),
        (points, "extension xyz"),
        (format!("{plain}\n{plain}"), "line 8: a second block"),
        (format!("{plain}# Phase\n{plain}"), phase),
        (
            format!("{gwyddion}{plain}"),
            "line 4: the values are in 'V'",
        ),
    ]);
}

#[test]
fn damaged_texts_are_refused_with_the_place() {
    let plain = lines(&rows(1e-6), ",");
    let both = "line 1: '4,866' has a comma and '967.0' in line 1 a point";
    let thousands = "begins with '\"4,866.5\",\"967.0\"' (is there a separator of thousands?)";
    let exponent = "1.2e-06;2.5e-06\n3.7e-06;4.1e-0".to_owned();
    assert_refused([
        ("4,866;967.0\n4,360;303.5\n".to_owned(), both),
        (
            "\"4,866.5\",\"967.0\"\n\"4,360.1\",\"303.5\"\n".to_owned(),
            thousands,
        ),
        (
            plain.replacen('\n', ",1\n", 2),
            "line 1: 8 values are needed",
        ),
        (
            plain.replacen('\n', "\n1,2,x,4,5,6,7,8\n", 1),
            "line 2: column 3",
        ),
        (format!("6,8\n{plain}"), "line 1: 8 values are needed"),
        (format!("1,2,3,x,5,6,7,8\n{plain}"), "line 1: column 4"),
        (
            "1.25;2.50\n3.75;4.1".to_owned(),
            "line 2: the text ends with '4.1'",
        ),
        (exponent, "line 2: the text ends with '4.1e-0'"),
        ("nothing\n".to_owned(), "x3p"),
    ]);
}

#[test]
fn a_table_with_names_of_columns_is_no_height_map() {
    let rows = "0.01,2.5,0.3\n0.1,2.9,0.4\n1.0,3.5,0.6\n10.0,4.4,0.9\n";
    let moduli = "f,E',E''\nHz,MPa,MPa\n";
    let friction = "v (mm/s),mu,standard error\n";
    assert_refused([moduli, friction].map(|names| {
        let reason = "line 1: the columns have the names";
        (format!("{names}{rows}"), reason)
    }));
    // Names that number the columns are those of a matrix, and so are lines about the instrument.
    for head in ["V1,V2,V3\n", "Profiler X,no. 7\n"] {
        let found = read("csv", format!("{head}{rows}"), Some(SPACING));
        assert_eq!(found.expect("a map").shape, [4, 3], "{head}");
    }
}

#[test]
fn other_formats_are_named_with_those_that_are_read() {
    for (contents, reason) in [
        (&b"VK4_\0\0\0\0"[..], "Keyence"),
        (b"PK\x03\x04 arr_0.npy", "npz"),
        (b"\x01\x02\x03\x04\x05\x06\x07\x08\x0e", "binary"),
    ] {
        let refused = read("csv", contents, Some(SPACING))
            .expect_err(reason)
            .to_string();
        let mut words = [reason, "x3p", "read_topography", "numpy.save"].into_iter();
        assert!(words.all(|word| refused.contains(word)), "{refused}");
    }
}

#[test]
fn what_stands_above_the_heights_is_skipped_with_a_note_and_counts() {
    let nanometres = lines(&rows(1e3), "\t");
    let gwyddion = "# Kanal: Höhe\n# Breite: 16,0 µm\n# Höhe: 18,0 µm\n# Werteeinheiten: nm\n";
    let found = read("txt", format!("{gwyddion}{nanometres}"), None).expect("a map");
    assert!(
        is_surface(&found, SPACING) && found.states_unit,
        "{found:?}"
    );
    let other = read("txt", format!("{gwyddion}{nanometres}"), Some([1e-6, 3e-6]));
    assert!(
        matches!(other, Err(TopographyError::Spacing { .. })),
        "{other:?}"
    );
    let profiler = format!("Profiler X, no. 7\nX points\t8\nZ unit: nm\n{nanometres}");
    let found = read("txt", &profiler, Some(SPACING)).expect("a map");
    assert!(is_surface(&found, SPACING), "{found:?}");
    assert!(found.notes[0].contains("lines 1 to 3"), "{:?}", found.notes);
    let missing = read("txt", profiler, None);
    assert!(
        matches!(missing, Err(TopographyError::Spacing { .. })),
        "{missing:?}"
    );
}

#[cfg(feature = "topography")]
mod measured {
    use super::*;

    fn points(scale: [f64; 2], digits: usize) -> String {
        let line = |index: u32| {
            let (column, row) = (index % 8, index / 8);
            let [x, y] = [f64::from(column) * 2e-6, f64::from(row) * 3e-6].map(|at| at * scale[0]);
            format!(
                "{x:.digits$e} {y:.digits$e} {:.9e}\n",
                height(column, row, 1e-6 * scale[1])
            )
        };
        (0..48).map(line).collect()
    }

    #[test]
    fn points_have_the_units_of_their_names() {
        for (name, scale, digits, unit) in [
            ("", [1.0, 1.0], 9, LateralUnit::AsHeights),
            ("", [1.0, 1.0], 1, LateralUnit::AsHeights),
            (
                "# x [um] y [um] z [nm]\n",
                [1e6, 1e9],
                9,
                LateralUnit::Stated,
            ),
            ("X(mm),Y(mm),Z(µm)\n", [1e3, 1e6], 2, LateralUnit::Stated),
        ] {
            let found = read("xyz", format!("{name}{}", points(scale, digits)), None).expect(name);
            assert!(
                is_surface(&found, SPACING) && found.lateral_unit == unit,
                "{name}: {found:?}"
            );
            assert_eq!(found.states_unit, !name.is_empty());
        }
        let twice = points([1.0, 1.0], 9).repeat(2);
        for (text, reason) in [
            (twice, "line 49: the point at x = 0, y = 0 stands in line 1"),
            ("1 2 3 4\n2 3 4 5\n".to_owned(), "the lines have 4 numbers"),
            (
                "x [px] y [px] z [nm]\n0 0 1\n1 0 1\n".to_owned(),
                "line 1: the unit 'px'",
            ),
            (
                "0 0 1\n1 0 1\n3.3 1 2\n3.9 1 2\n".to_owned(),
                "beside a grid",
            ),
        ] {
            let refused = read("xyz", text, None).expect_err(reason).to_string();
            assert!(refused.contains(reason), "{refused}");
        }
    }

    #[test]
    fn esri_grids_agree_with_their_lines() {
        let grid = |head: &str| read("asc", format!("{head}\n{}", lines(&rows(1e-6), " ")), None);
        let found = grid("NCOLS 8\nnrows 6\ndx 2e-6\ndy 3e-6\nNODATA_value nan").expect("a grid");
        assert!(
            is_surface(&found, SPACING) && found.lateral_unit == LateralUnit::Unstated,
            "{found:?}"
        );
        for head in [
            "ncols 6\nnrows 8\ncellsize 1",
            "ncols 12\nnrows 4\ncellsize 1",
            "ncols 4\nnrows 12\ncellsize 1",
        ] {
            grid(head).expect_err(head);
        }
        let marked = "ncols 2\nnrows 2\ncellsize 1\nNODATA_value -3.4028234663852886e+38\n1 -3.402823e+38\n3 4\n";
        let found = read("asc", marked, None).expect("a grid");
        assert!(
            found.missing() == 1 && found.heights[1].is_nan(),
            "{found:?}"
        );
        // A row may go on in the next line.
        let wrapped = "ncols 5\nnrows 2\ncellsize 1\n1 2 3\n4 5\n6 7 8\n9 10\n";
        assert_eq!(read("asc", wrapped, None).expect("a grid").shape, [2, 5]);
    }

    fn binary(version: &[u8], kind: u8, numbers: &[u8]) -> Vec<u8> {
        let counts: Vec<u8> = if version.ends_with(b"2.0") {
            [8_u32, 6]
                .iter()
                .flat_map(|count| count.to_le_bytes())
                .collect()
        } else {
            [8_u16, 6]
                .iter()
                .flat_map(|count| count.to_le_bytes())
                .collect()
        };
        let scales = [2e-6_f64, 3e-6, 1e-12, -1.0];
        let scales: Vec<u8> = scales
            .iter()
            .flat_map(|scale| scale.to_le_bytes())
            .collect();
        [
            version,
            &[b' '; 34],
            &counts,
            &scales,
            &[0, kind, 0],
            numbers,
        ]
        .concat()
    }

    #[test]
    fn surfaces_of_iso_25178_71_are_read_in_text_and_binary() {
        let head = "aISO-1.0\r\nManufacID = X\r\nNumPoints = 8\r\nNumProfiles = 6\r\nXscale = 2E-6\r\nYscale = 3E-6\r\n\
            Zscale = 1e-9\r\nZresolution = -1\r\nCompression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n";
        let text = format!("{head}{}*\r\n", lines(&rows(1e3), " "));
        let all = (0..48).map(|index| height(index % 8, index / 8, 1e6));
        let all: Vec<f64> = all.collect();
        #[expect(clippy::cast_possible_truncation, reason = "below 2e6")]
        let whole: Vec<u8> = all
            .iter()
            .flat_map(|height| (height.round() as i32).to_le_bytes())
            .collect();
        let real: Vec<u8> = all.iter().flat_map(|height| height.to_le_bytes()).collect();
        for contents in [
            text.clone().into_bytes(),
            binary(b"bISO-1.0", 7, &real),
            binary(b"bISO-2.0", 6, &whole),
            binary(b"bBCR-1.0", 2, &whole),
        ] {
            let found = read("sdf", &contents, None).expect("a surface");
            assert!(
                is_surface(&found, SPACING) && found.states_unit,
                "{found:?}"
            );
            let damaged = &contents[..contents.len() * 9 / 10];
            read("sdf", damaged, None).expect_err("too few heights");
        }
        let mut holes = whole;
        holes[8..12].copy_from_slice(&i32::MIN.to_le_bytes());
        let found = read("sdf", binary(b"bISO-1.0", 6, &holes), None).expect("a surface");
        assert!(
            found.missing() == 1 && found.heights[2].is_nan(),
            "{found:?}"
        );
        let found = read("sdf", text.replacen(&rows(1e3)[0][3], "BAD", 1), None);
        assert!(found.expect("a surface").heights[3].is_nan());
        for (name, wrong) in [
            ("Compression = 0", "Compression = 1"),
            ("DataType = 7", "DataType = 9"),
            ("*", "+"),
        ] {
            read("sdf", text.replace(name, wrong), None).expect_err(wrong);
        }
    }

    #[test]
    fn inverted_surfaces_of_digital_surf_are_turned_back_as_gwyddion_does() {
        let file = |inversion: u16| {
            let mut head = vec![0_u8; 512];
            head[..12].copy_from_slice(b"DIGITAL SURF");
            for (at, number) in [(18, 2_u16), (98, 16), (290, inversion)] {
                head[at..at + 2].copy_from_slice(&number.to_le_bytes());
            }
            for (at, number) in [(108, 2_u32), (112, 2)] {
                head[at..at + 4].copy_from_slice(&number.to_le_bytes());
            }
            for (at, number) in [(120, 2e-6_f32), (124, 3e-6), (128, 1.0)] {
                head[at..at + 4].copy_from_slice(&number.to_le_bytes());
            }
            let heights = [1_i16, 2, 3, 4]
                .iter()
                .flat_map(|height| height.to_le_bytes());
            head.extend(heights);
            read("sur", head, None)
        };
        for (inversion, expected) in [
            (0, [1.0, 2.0, 3.0, 4.0]),
            (1, [-1.0, -2.0, -3.0, -4.0]),
            (2, [-2.0, -1.0, -4.0, -3.0]),
            (3, [-3.0, -4.0, -1.0, -2.0]),
        ] {
            let found = file(inversion).expect("a surface");
            assert_eq!(found.heights, expected, "{inversion}");
            assert_eq!(
                found.notes.len(),
                usize::from(inversion > 0),
                "{:?}",
                found.notes
            );
        }
        file(4).expect_err("no such inversion");
    }
}
