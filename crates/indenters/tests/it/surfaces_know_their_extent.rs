use casebook::{Formula, assert_close};
use indenters::{Cylinder, FlatPunch, HeightMap, PowerProfile, Sphere, Surface, Unmirrored};

/// Paraboloids of both curvatures, turned and moved, or none; only the heights are those of the body.
fn own(curvatures: [f64; 2], angle: f64, moved: [f64; 2]) -> impl Surface {
    let (sine, cosine) = angle.sin_cos();
    Formula::new([false; 2], move |[x, y]| {
        let [x, y] = [x - moved[0], y - moved[1]];
        let [along, across] = [cosine * x + sine * y, cosine * y - sine * x];
        let height = curvatures[0] * along * along + curvatures[1] * across * across;
        (height, [0.0; 2])
    })
}

/// Half widths of {a u² + b v² < h} along x and y, for u, v turned by the angle.
fn half_widths(curvatures: [f64; 2], angle: f64, height: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    let [along, across] = curvatures.map(|curvature| height / curvature);
    [
        (along * cosine * cosine + across * sine * sine).sqrt(),
        (along * sine * sine + across * cosine * cosine).sqrt(),
    ]
}

#[test]
fn an_own_surface_is_searched_tightly_at_every_scale() {
    for scale in [1e-100, 1e-6, 1.0, 1e80] {
        for (aspect, angle, moved) in [
            (1.0, 0.0, [0.0; 2]),
            (1e6, 0.0, [0.0; 2]),
            (1e-3, 0.7, [0.0; 2]),
            (4.0, 1.9, [30.0, -7.0]),
        ] {
            let curvatures = [1.0 / scale, aspect / scale];
            let moved = moved.map(|length: f64| length * scale);
            let extent = own(curvatures, angle, moved).extent_below(scale);
            let half_widths = half_widths(curvatures, angle, scale);
            for axis in [0, 1] {
                let [start, end] = [-1.0, 1.0].map(|side| moved[axis] + side * half_widths[axis]);
                // The origin is in it too.
                let [start, end] = [start.min(0.0), end.max(0.0)];
                let spare = 0.1 * (end - start);
                let [low, high] = extent[axis];
                let is_tight =
                    (start - spare..=start).contains(&low) && (end..=end + spare).contains(&high);
                assert!(
                    is_tight,
                    "axis {axis} of {aspect}, {angle}, scale {scale}: {extent:?} for [{start}, {end}]"
                );
            }
        }
    }
}

#[test]
fn an_endless_surface_has_an_endless_extent() {
    let ridge = own([2.0, 0.0], 0.0, [0.0; 2]);
    let cylinder = Cylinder::new(0.25).unwrap();
    for (extent, spare) in [
        (ridge.extent_below(0.5), 0.05),
        (cylinder.extent_below(0.5), 1e-15),
    ] {
        let [[rear, front], across] = extent;
        let is_endless = across.iter().all(|end| end.is_infinite());
        assert!(is_endless, "{across:?} along the ridge");
        for end in [-rear, front] {
            assert!((0.5..=0.5 + spare).contains(&end), "{end} instead of 0.5");
        }
    }
}

#[test]
fn a_cylinder_is_its_parabola_at_every_scale() {
    for scale in [1e-150, 1.0, 1e150] {
        let cylinder = Cylinder::new(2.0 * scale).unwrap();
        assert_close!(cylinder.height([scale, 7.0]) => 0.25 * scale, within 1e-15);
        assert_close!(cylinder.gradient([scale, 7.0])[0] => 0.5, within 1e-15);
        assert_close!(cylinder.apex_exponent() => 2.0, within 0.0);
        assert_eq!(cylinder.mirrors(), [true; 2], "a cylinder");
    }
}

#[test]
fn a_body_of_revolution_knows_its_extent() {
    let sphere = Sphere::new(1.0).unwrap();
    let punch = FlatPunch::new(0.3).unwrap();
    let cone = PowerProfile::cone(0.1).unwrap();
    let bodies: [(Box<dyn Surface>, f64, f64); 6] = [
        (Box::new(sphere), 0.4, 0.8),
        (Box::new(sphere), 7.0, 1.0),
        (Box::new(punch), 0.4, 0.3),
        (Box::new(cone), 1e-30, 1e-29),
        (Box::new(cone), 1e30, 1e31),
        (Box::new(cone), 0.0, 0.0),
    ];
    for (body, height, radius) in bodies {
        for end in body.extent_below(height).as_flattened() {
            assert_close!(end.abs() => radius, within 1e-14; "below {height}");
        }
    }
    let [inside, outside] = [0.29, 0.31].map(|x| punch.height([x, 0.0]));
    let is_flat = inside.abs() <= 0.0 && outside.is_infinite();
    assert!(is_flat, "{inside} and {outside} of the punch");
}

#[test]
fn only_mirrors_are_hidden_by_unmirrored() {
    let heights = vec![2.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 2.0];
    let map = HeightMap::from_gaps([3, 3], [1.0; 2], heights).unwrap();
    let hidden = Unmirrored(&map);
    assert_eq!((map.mirrors(), hidden.mirrors()), ([true; 2], [false; 2]));
    assert_eq!(hidden.extent_below(0.5), map.extent_below(0.5));
    let at = |body: &dyn Surface| (body.height([0.3, -0.6]), body.gradient([0.3, -0.6]));
    assert_eq!(at(&hidden), at(&map), "the same surface");
    let sphere = Sphere::new(1.0).unwrap();
    let hidden = Unmirrored(&sphere);
    assert!(hidden.as_axisymmetric().is_none(), "it has mirrors");
    assert_close!(hidden.apex_exponent() => 2.0, within 0.0);
}
