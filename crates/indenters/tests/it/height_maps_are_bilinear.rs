//! A height map is exact at its nodes, bilinear between them, ends at its edge, and has its lowest point at the origin.

use casebook::{NOT_POSITIVE, assert_close, assert_matches};
use indenters::{HeightMap, IndenterError, Surface};

/// A surface that is bilinear in every quadrant.
fn bilinear([x, y]: [f64; 2]) -> f64 {
    2.0 * x.abs() + 3.0 * y.abs() + 5.0 * (x * y).abs()
}

/// Its heights in a unit of length, lowest at row 1 and column 2.
fn map(unit: f64) -> HeightMap {
    let place = |node: i32| [f64::from(node / 5) - 1.0, 0.5 * (f64::from(node % 5) - 2.0)];
    let heights = (0..20).map(|node| unit * (7.0 + bilinear(place(node))));
    HeightMap::from_gaps([4, 5], [unit, 0.5 * unit], heights.collect()).expect("a map")
}

#[test]
fn a_bilinear_surface_is_reproduced_in_any_unit() {
    for unit in [1e-12, 1.0, 1e12] {
        let map = map(unit);
        let across = [0.0, 0.1, 0.9, -1.0, -0.6];
        for (x, y) in [0.0, 0.25, -0.75, 2.0, 1.5].into_iter().zip(across) {
            let off = map.height([x * unit, y * unit]) / unit - bilinear([x, y]);
            // Twenty heights of up to 24 units are rounded once, and mixed.
            let is_same = off.abs() <= 64.0 * f64::EPSILON;
            assert!(is_same, "[{x}, {y}]: off by {off} units of {unit:e}");
        }
        let [along, across] = map.gradient([0.5 * unit, -0.25 * unit]);
        assert_close!(along => 2.0 + 1.25, within 3e-14; "unit {unit:e}");
        assert_close!(across => -3.0 - 2.5, within 1e-14; "unit {unit:e}");
    }
}

#[test]
fn a_map_ends_at_its_edge() {
    let map = map(1.0);
    assert_eq!(map.extent(), [[-1.0, 2.0], [-1.0, 1.0]], "the edges");
    for outside in [[-1.001, 0.0], [2.001, 0.0], [0.0, 1.001], [f64::NAN, 0.0]] {
        let (height, gradient) = (map.height(outside), map.gradient(outside));
        let is_none = height.is_infinite() && height > 0.0 && gradient[0].abs() <= 0.0;
        assert!(is_none, "{height} and {gradient:?} at {outside:?}");
    }
}

/// A grid of elements of another spacing reaches the edge up to some units in the last place.
#[test]
fn a_point_beside_the_edge_by_rounding_is_on_it() {
    let map = map(1.0);
    for (axis, ends) in map.extent().into_iter().enumerate() {
        for end in ends {
            let mut position = [0.0; 2];
            position[axis] = end * (1.0 + 4.0 * f64::EPSILON);
            let height = map.height(position);
            position[axis] = end;
            assert_close!(height => map.height(position), within 1e-14; "axis {axis}, {end}");
        }
    }
}

#[test]
fn what_lies_below_a_height_is_inside_its_rectangle() {
    for (height, expected) in [
        (0.0, [[-1.0, 1.0], [-0.5, 0.5]]),
        (1.6, [[-1.0, 1.0], [-1.0, 1.0]]),
        (2.1, [[-1.0, 2.0], [-1.0, 1.0]]),
        (30.0, [[-1.0, 2.0], [-1.0, 1.0]]),
    ] {
        assert_eq!(map(1.0).extent_below(height), expected, "below {height}");
    }
}

#[test]
fn of_equal_lowest_heights_the_nearest_to_the_middle_is_the_origin() {
    let heights = vec![0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0];
    let map = HeightMap::from_gaps([4, 3], [1.0, 1.0], heights).expect("a map");
    let seen = [[-1.0, 2.0], [-1.0, 1.0]];
    assert_eq!(map.extent(), seen, "from row 1, column 1");
}

/// Heights out of the body, whose rows run along x, are the gaps with the other sign and the other order.
#[test]
fn heights_and_gaps_give_one_surface() {
    let gaps = vec![0.5, 3.0, 2.0, 0.0, 1.5, 4.0];
    let heights = [-0.5, -2.0, -1.5, -3.0, -0.0, -4.0].map(|height: f64| 7.0 + height);
    let map = HeightMap::from_gaps([3, 2], [1.0, 0.5], gaps).expect("a map");
    let same = HeightMap::from_heights([2, 3], [1.0, 0.5], &heights).expect("a map");
    assert_eq!(same, map, "heights {heights:?}");
    for (shape, needed) in [([3, 3], 9), ([0, 6], 0)] {
        let other = HeightMap::from_heights(shape, [1.0; 2], &heights);
        assert_matches!(other, Err(IndenterError::LengthMismatch { first_length, .. }) if first_length == needed);
    }
    let few = HeightMap::from_heights([1, 6], [1.0; 2], &heights);
    assert_matches!(few, Err(IndenterError::TooFew { length: 1, .. }));
}

#[test]
fn grids_that_do_not_fit_are_refused() {
    let new =
        |shape, spacing, heights: &[f64]| HeightMap::from_gaps(shape, spacing, heights.to_vec());
    let square = [0.0, 1.0, 2.0, 3.0];
    for shape in [[1, 4], [4, 1]] {
        let few = new(shape, [1.0; 2], &square);
        assert_matches!(few, Err(IndenterError::TooFew { length: 1, .. }));
    }
    let many = new([2, 3], [1.0; 2], &square);
    assert_matches!(many, Err(IndenterError::LengthMismatch { first_length, .. }) if first_length == 6);
    let heights = [[0.0, f64::NAN], [0.0, f64::INFINITY], [-1e308, 1e308]];
    let heights = heights.map(|[low, high]| ([1.0; 2], [low, high, 0.5, 0.5]));
    let bad = NOT_POSITIVE.iter();
    let spacings = bad.flat_map(|bad| [[*bad, 1.0], [1.0, *bad]]);
    for (spacing, heights) in spacings.map(|spacing| (spacing, square)).chain(heights) {
        let result = new([2, 2], spacing, &heights);
        let invalid = matches!(result, Err(IndenterError::InvalidParameter(_)));
        assert!(invalid, "{spacing:?} {heights:?}: {result:?}");
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
        let map = HeightMap::from_gaps([3, 3], [1.0, 0.5], heights.to_vec()).expect("a map");
        assert_eq!(map.mirrors(), expected, "mirrors of {heights:?}");
    }
}
