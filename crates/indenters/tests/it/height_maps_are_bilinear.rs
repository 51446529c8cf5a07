//! A height map is exact at its nodes, bilinear between them, ends at its edge, and has its lowest point at the origin.

use casebook::assert_matches;
use indenters::{HeightMap, IndenterError, Surface};

/// Heights a + b x + c y + d x y, which a bilinear surface reproduces, lowest at row 1 and column 2.
fn map(scale: f64) -> HeightMap {
    let height = |[x, y]: [f64; 2]| scale * (2.0 * x.abs() + 3.0 * y.abs() + 5.0 * (x * y).abs());
    let heights = (0..4).flat_map(|row| {
        (0..5).map(move |column| [f64::from(row) - 1.0, 0.5 * (f64::from(column) - 2.0)])
    });
    let heights = heights.map(|place| 7.0 * scale + height(place)).collect();
    HeightMap::new([4, 5], [scale, 0.5 * scale], heights).expect("a map")
}

#[test]
fn a_bilinear_surface_is_reproduced_in_any_unit() {
    for scale in [1e-12, 1.0, 1e12] {
        let map = map(scale);
        for [x, y] in [
            [0.0, 0.0],
            [0.25, 0.1],
            [-0.75, 0.9],
            [2.0, -1.0],
            [1.5, -0.6],
        ] {
            let expected = scale * (2.0 * f64::abs(x) + 3.0 * f64::abs(y) + 5.0 * f64::abs(x * y));
            let actual = map.height([x * scale, y * scale]);
            // Twenty heights of up to 24 in units of the scale are rounded once, and mixed.
            assert!(
                (actual - expected).abs() <= 64.0 * f64::EPSILON * scale,
                "h({x}, {y}) is {actual} instead of {expected} at the scale {scale:e}"
            );
        }
        let gradient = map.gradient([0.5 * scale, -0.25 * scale]);
        for (actual, expected) in gradient.into_iter().zip([2.0 + 1.25, -3.0 - 2.5]) {
            assert!(
                (actual - expected).abs() < 1e-13,
                "{gradient:?} at the scale {scale:e}, expected {expected}"
            );
        }
    }
}

#[test]
fn a_map_ends_at_its_edge() {
    let map = map(1.0);
    assert_eq!(map.extent(), [[-1.0, 2.0], [-1.0, 1.0]], "the edges");
    for outside in [[-1.001, 0.0], [2.001, 0.0], [0.0, 1.001], [f64::NAN, 0.0]] {
        let [height, gradient] = [map.height(outside), map.gradient(outside)[0]];
        assert!(
            height == f64::INFINITY && gradient == 0.0,
            "{height} and {gradient} at {outside:?}"
        );
    }
}

#[test]
fn what_lies_below_a_height_is_inside_its_rectangle() {
    let map = map(1.0);
    for (height, expected) in [
        (0.0, [[-1.0, 1.0], [-0.5, 0.5]]),
        (1.6, [[-1.0, 1.0], [-1.0, 1.0]]),
        (2.1, [[-1.0, 2.0], [-1.0, 1.0]]),
    ] {
        assert_eq!(map.extent_below(height), expected, "below {height}");
    }
}

#[test]
fn of_equal_lowest_heights_the_nearest_to_the_middle_is_the_origin() {
    let heights = vec![0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0];
    let map = HeightMap::new([4, 3], [1.0, 1.0], heights).expect("a map");
    assert_eq!(
        map.extent(),
        [[-1.0, 2.0], [-1.0, 1.0]],
        "seen from row 1, column 1"
    );
}

#[test]
fn grids_that_do_not_fit_are_refused() {
    let new = |shape, spacing, heights: &[f64]| HeightMap::new(shape, spacing, heights.to_vec());
    let square = [0.0, 1.0, 2.0, 3.0];
    let few = new([1, 4], [1.0; 2], &square);
    assert_matches!(few, Err(IndenterError::TooFew { length: 1, .. }));
    let many = new([2, 3], [1.0; 2], &square);
    assert_matches!(
        many,
        Err(IndenterError::LengthMismatch {
            first_length: 6,
            ..
        })
    );
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for spacing in [[bad, 1.0], [1.0, bad]] {
            let result = new([2, 2], spacing, &square);
            assert_matches!(
                result,
                Err(IndenterError::InvalidParameter { .. }),
                "{spacing:?}"
            );
        }
    }
    for heights in [
        [0.0, f64::NAN, 1.0, 1.0],
        [0.0, f64::INFINITY, 1.0, 1.0],
        [-1e308, 1e308, 0.0, 0.0],
    ] {
        let result = new([2, 2], [1.0; 2], &heights);
        assert_matches!(
            result,
            Err(IndenterError::InvalidParameter { .. }),
            "{heights:?}"
        );
    }
}

#[test]
fn a_map_has_the_mirrors_of_its_nodes() {
    // Rows at x = -1, 0, 1, columns at y = -1, 0, 1.
    for (heights, expected) in [
        ([2.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 2.0], [true, true]),
        ([2.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 3.0, 2.0], [false, true]),
        ([2.0, 1.0, 2.0, 1.0, 0.0, 3.0, 2.0, 1.0, 2.0], [true, false]),
        // The lowest node is not in the middle, through which the nodes are mirrored.
        ([2.0, 0.0, 2.0, 1.0, 4.0, 1.0, 2.0, 0.0, 2.0], [false, true]),
    ] {
        let map = HeightMap::new([3, 3], [1.0, 0.5], heights.to_vec()).expect("a map");
        assert_eq!(map.mirrors(), expected, "mirrors of {heights:?}");
    }
}
