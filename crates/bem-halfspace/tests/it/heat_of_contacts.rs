//! The temperature of sliding contacts that are heated by their own friction: exact values, an independent quadrature, powers, limits.

use std::f64::consts::PI;

use bem_halfspace::heat::{
    ContactKind, Counterface, HeatConductor, SlidingContact, TemperatureRise,
};
use bem_halfspace::{BemError, Grid, InvalidParameter, PressureField, ShiftOfWave, WaveShift};
use numerics::Estimate;
use rheology::{
    Material, ModulusFactors, Prony, RelaxationBranch, RelaxationSpectrum, StandardSolid,
    StandardSolidParameters, Viscous,
};

/// Conductivity, \[W/(m K)].
const CONDUCTIVITY: f64 = 0.25;
/// Diffusivity, \[m²/s].
const DIFFUSIVITY: f64 = 1.2e-7;
/// Radius of contacts, \[m].
const RADIUS: f64 = 1e-3;
/// Largest pressure of contacts, \[Pa].
const LARGEST_PRESSURE: f64 = 1e5;

fn rubber() -> HeatConductor {
    HeatConductor::new(CONDUCTIVITY, DIFFUSIVITY).expect("a conductor")
}

/// Pressure with the shape of that of Hertz under a sphere, on `n` elements across the contact.
fn hertz(n: usize) -> PressureField {
    let edge = 2.0 * RADIUS / n as f64;
    let place = |number: usize| (number as f64 + 0.5) * edge - RADIUS;
    let pressure = |index: usize| {
        let [x, y] = [index / n, index % n].map(|number| place(number) / RADIUS);
        LARGEST_PRESSURE * (1.0 - x * x - y * y).max(0.0).sqrt()
    };
    PressureField {
        grid: Grid::new([n; 2], [edge; 2]).expect("a grid"),
        origin: [place(0); 2],
        pressure: (0..n * n).map(pressure).collect(),
    }
}

/// A standard solid whose two moduli are equal.
fn solid(modulus: f64, relaxation_time: f64) -> StandardSolid {
    StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: modulus,
        maxwell_modulus: modulus,
        viscosity: modulus * relaxation_time,
    })
    .expect("a material")
}

/// A contact without shear.
fn heated_by_bulk<'a>(
    pressure: &'a PressureField,
    material: &'a dyn Material,
    velocity: f64,
    bulk_power: f64,
) -> SlidingContact<'a> {
    SlidingContact {
        pressure,
        material,
        factors: ModulusFactors::NONE,
        wave_shift: None,
        velocity,
        shear_power: 0.0,
        contact_area: None,
        bulk_power,
    }
}

/// The temperature under an insulating body.
fn heated(contact: &SlidingContact<'_>, kind: ContactKind) -> TemperatureRise {
    let found = contact.temperature(&rubber(), Counterface::Insulating, kind);
    found.expect("a temperature")
}

/// Péclet number, and the largest and the mean of k T a/P for the power P dissipated under a Hertzian pressure
/// on a standard solid of two equal moduli with the relaxation time a/(2v). Dissipation by Fourier transforms on a period of 32 radii,
/// temperature by sums over point sources, outside of this workspace; the elements had an eighth of the radius less.
const OF_HERTZ: [[f64; 3]; 3] = [
    [0.1, 0.10936, 0.09714],
    [1.0, 0.06180, 0.04041],
    [10.0, 0.00921, 0.00404],
];
/// Error of the values: between elements of a sixteenth and of a thirty-second of the radius they change by 0.3 % in the mean, and at the
/// largest temperature by 2 %.
const REFERENCE_ERRORS: [f64; 2] = [0.02, 0.004];
/// Power P over p₀² a³/(2η) (ω a η/G)² of the same source, with the largest pressure p₀ and ω = v/a.
const POWER_OF_HERTZ: f64 = 0.4034;

/// The power of the material is stated twice as large as the pressure dissipates. A quarter of the heat of the bulk is then its error, also
/// beside a shear of a hundred times that power.
#[test]
fn power_that_is_not_resolved_is_an_error_of_the_bulk_alone() {
    let field = hertz(24);
    let velocity = 2.0 * DIFFUSIVITY / RADIUS;
    let (modulus, time) = (1e6, 0.5 * RADIUS / velocity);
    let material = solid(modulus, time);
    let dissipated = POWER_OF_HERTZ * LARGEST_PRESSURE.powi(2) * RADIUS.powi(3) * time
        / (2.0 * modulus)
        * (velocity / RADIUS).powi(2);
    let relative_error = |shear_power: f64| {
        let contact = SlidingContact {
            pressure: &field,
            material: &material,
            factors: ModulusFactors::NONE,
            wave_shift: None,
            velocity,
            shear_power,
            contact_area: None,
            bulk_power: 2.0 * dissipated,
        };
        let mean = heated(&contact, ContactKind::Body).mean;
        mean.error / mean.value
    };
    let [of_bulk, of_both] = [0.0, 200.0 * dissipated].map(relative_error);
    assert!(of_bulk > 0.2, "{of_bulk}");
    assert!(of_both < 0.1 * of_bulk, "{of_both} beside {of_bulk}");
}

#[test]
fn the_bulk_under_a_hertzian_pressure_has_the_temperature_of_point_sources() {
    for n in [24, 48] {
        let field = hertz(n);
        for [peclet_number, largest, mean] in OF_HERTZ {
            let velocity = 2.0 * DIFFUSIVITY * peclet_number / RADIUS;
            let (modulus, time) = (1e6, 0.5 * RADIUS / velocity);
            let viscosity = modulus * time;
            let bulk_power = POWER_OF_HERTZ * LARGEST_PRESSURE.powi(2) * RADIUS.powi(3)
                / (2.0 * viscosity)
                * (velocity / RADIUS * viscosity / modulus).powi(2);
            let material = solid(modulus, time);
            let contact = heated_by_bulk(&field, &material, velocity, bulk_power);
            let found = heated(&contact, ContactKind::Body);
            let scale = CONDUCTIVITY * RADIUS / bulk_power;
            let found = [found.largest, found.mean];
            let expected = [largest, mean];
            for ((found, expected), error) in found.into_iter().zip(expected).zip(REFERENCE_ERRORS)
            {
                let found: Estimate = found * scale;
                let off = (found.value - expected).abs();
                let allowed = found.error + error * expected;
                assert!(
                    off < allowed,
                    "n {n}, Pe {peclet_number}: {found}, not {expected}"
                );
                assert!(
                    found.error < 0.15 * expected,
                    "n {n}, Pe {peclet_number}: {found}"
                );
            }
        }
    }
}

/// Heat reaches the surface of a fast contact from a layer that the elements do not resolve. Bars on any number of elements overlap, those of
/// grids whose number of elements is not a multiple of another one, too.
#[test]
fn bars_of_a_layer_that_elements_do_not_resolve_overlap() {
    let velocity = 1.0;
    let (modulus, time) = (1e6, 0.01 * RADIUS / velocity);
    let material = solid(modulus, time);
    let rises = [10, 16, 20, 24, 33, 40, 48].map(|n| {
        let field = hertz(n);
        let contact = heated_by_bulk(&field, &material, velocity, 1e-3);
        let rise = heated(&contact, ContactKind::Body);
        let in_depth = rise.by_depth.expect("a profile").mean();
        [rise.largest, rise.mean, in_depth]
    });
    for (index, one) in rises.iter().enumerate() {
        for other in &rises[..index] {
            for (one, other) in one.iter().zip(other) {
                let apart = (one.value - other.value).abs();
                assert!(apart <= one.error + other.error, "{one} and {other}");
            }
        }
    }
    // The temperature grows with each halving of the elements, so that coarse bars contain the values on finer grids.
    let ([coarse, ..], [.., fine]) = (&rises, &rises);
    assert!(
        fine[1].value > 1.5 * coarse[1].value,
        "{} and {}",
        fine[1],
        coarse[1]
    );
    assert!(
        fine[1].value < coarse[1].value + coarse[1].error,
        "{} and {}",
        fine[1],
        coarse[1]
    );
}

/// A wave of pressure q in full contact dissipates p(z) = 4q³ z² e^(−2qz) everywhere alike. At long times the mean temperature of the
/// surface is (√(4Dt/π) − 3/(2q)) Q/k. That of the material that dissipates is (√(4Dt/π) − 63/(32q)) Q/k, with the mean of the larger of
/// two depths of this distribution. A shift of the material changes the power alone.
#[test]
fn one_wave_in_full_contact_has_its_closed_form() {
    let (n, period, amplitude) = (64, 1e-3, 1e4);
    let wave_number = 2.0 * PI / period;
    let pressure = |index: usize| {
        let x = (index / n) as f64 * period / n as f64;
        2.0 * amplitude + amplitude * (wave_number * x).cos()
    };
    let field = PressureField {
        grid: Grid::new([n; 2], [period / n as f64; 2]).expect("a grid"),
        origin: [0.0; 2],
        pressure: (0..n * n).map(pressure).collect(),
    };
    let velocity = 0.01;
    let frequency = velocity * wave_number;
    let branch = |modulus, time| RelaxationBranch::new(modulus, time);
    let branches = vec![branch(3e6, 0.3 / frequency), branch(2e6, 4.0 / frequency)];
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches).expect("a spectrum");
    let material = Prony::new(spectrum).expect("a material");
    for [time_factor, modulus_factor] in [[1.0, 1.0], [0.2, 1.3]] {
        let shift = |wave_number| ShiftOfWave {
            wave_number,
            time_factor,
            modulus_factor,
        };
        let shift = WaveShift::new(&[shift(wave_number)]).expect("a shift");
        // The power per area is ω J'' p²/(4q) in the mean over the wave.
        let compliance = material.complex_compliance(frequency * time_factor);
        let loss = compliance.expect("a compliance").loss / modulus_factor;
        let flux = frequency * loss * amplitude.powi(2) / (4.0 * wave_number);
        let contact = SlidingContact {
            pressure: &field,
            material: &material,
            factors: ModulusFactors::NONE,
            wave_shift: (time_factor < 1.0).then_some(&shift),
            velocity,
            shear_power: 0.0,
            contact_area: None,
            bulk_power: flux * period * period,
        };
        let duration = 1e4;
        let found = heated(&contact, ContactKind::Period { duration });
        let expected = |depth: f64| {
            let diffused = (4.0 * DIFFUSIVITY * duration / PI).sqrt();
            flux * (diffused - depth / wave_number) / CONDUCTIVITY
        };
        let by_depth = found.by_depth.as_ref().expect("a profile");
        let of_wave = Estimate::exact(by_depth.of_wave(wave_number));
        for (rise, expected, allowed) in [
            (found.largest, expected(1.5), 5e-5),
            (found.mean, expected(1.5), 5e-5),
            (found.flux_weighted_mean, expected(1.5), 5e-5),
            (by_depth.mean(), expected(63.0 / 32.0), 2e-4),
            (of_wave, expected(63.0 / 32.0), 2e-4),
        ] {
            let off = (rise.value / expected - 1.0).abs();
            assert!(off < allowed, "{rise}, not {expected}: {off:.1e}");
            assert!(rise.error < 0.012 * expected, "{rise}");
        }
        for rise in [found.largest, found.mean] {
            assert!((rise.value - expected(1.5)).abs() < rise.error, "{rise}");
        }
        let refused = contact.temperature(&rubber(), Counterface::Insulating, ContactKind::Body);
        let is_refused = matches!(refused, Err(BemError::WaveShiftWithoutPeriod));
        assert_eq!(is_refused, time_factor < 1.0);
    }
}

/// The power that the material dissipates below the surface is that of the tangential force, also where it flows.
#[test]
fn a_wrong_power_widens_the_bars() {
    let field = hertz(24);
    let velocity = 2.0 * DIFFUSIVITY / RADIUS;
    let material = solid(1e6, 0.5 * RADIUS / velocity);
    let at = |bulk_power| {
        let contact = SlidingContact {
            pressure: &field,
            material: &material,
            factors: ModulusFactors::NONE,
            wave_shift: None,
            velocity,
            shear_power: 0.0,
            contact_area: None,
            bulk_power,
        };
        heated(&contact, ContactKind::Body).mean
    };
    let viscosity = 1e6 * 0.5 * RADIUS / velocity;
    let power = POWER_OF_HERTZ * LARGEST_PRESSURE.powi(2) * RADIUS.powi(3) / (2.0 * viscosity)
        * (velocity / RADIUS * viscosity / 1e6).powi(2);
    let [right, wrong] = [at(power), at(2.0 * power)];
    assert!(right.error < 0.04 * right.value, "{right}");
    assert!(
        wrong.error > 0.2 * wrong.value,
        "half of the power is not found: {wrong}"
    );
}

#[test]
fn both_sources_add_up_and_a_conductor_takes_the_shear() {
    let field = hertz(24);
    let velocity = 10.0 * DIFFUSIVITY / RADIUS;
    let material = solid(1e6, 0.5 * RADIUS / velocity);
    let of = |shear_power, bulk_power, counterface| {
        let contact = SlidingContact {
            pressure: &field,
            material: &material,
            factors: ModulusFactors::NONE,
            wave_shift: None,
            velocity,
            shear_power,
            contact_area: None,
            bulk_power,
        };
        contact
            .temperature(&rubber(), counterface, ContactKind::Body)
            .expect("a temperature")
    };
    let [shear, bulk] = [
        of(1e-3, 0.0, Counterface::Insulating),
        of(0.0, 2e-3, Counterface::Insulating),
    ];
    let both = of(1e-3, 2e-3, Counterface::Insulating);
    for (element, rise) in both.temperature.iter().enumerate() {
        let sum = shear.temperature[element] + bulk.temperature[element];
        assert!(
            (rise - sum).abs() < 1e-12 * both.largest.value,
            "element {element}: {rise}, not {sum}"
        );
    }
    assert!(
        (both.total_power / 3e-3 - 1.0).abs() < 1e-15
            && (both.absorbed_power / 3e-3 - 1.0).abs() < 1e-15
    );
    let conducting = of(1e-3, 2e-3, Counterface::Conducting);
    assert_eq!(conducting.temperature, bulk.temperature);
    assert!(
        (conducting.absorbed_power - 2e-3).abs() < 1e-18,
        "{}",
        conducting.absorbed_power
    );
}

/// A uniform disc that is heated by its shear alone is the case of the library for a given flux. The area of the elements in contact
/// differs from that of the disc by up to 0.4 %.
#[test]
fn shear_alone_heats_a_disc_like_a_given_flux() {
    let field = hertz(64);
    let material = Viscous::new(1e4).expect("a material");
    let velocity = 2.0 * DIFFUSIVITY / RADIUS;
    let contact = SlidingContact {
        pressure: &field,
        material: &material,
        factors: ModulusFactors::NONE,
        wave_shift: None,
        velocity,
        shear_power: 1e-3,
        contact_area: None,
        bulk_power: 0.0,
    };
    let found = heated(&contact, ContactKind::Body);
    let scale = CONDUCTIVITY * PI * RADIUS / 1e-3;
    for (found, expected) in [(found.largest, 0.73244), (found.mean, 0.55542)] {
        let found = found * scale;
        let off = (found.value - expected).abs();
        let allowed = found.error + 0.004 * expected;
        assert!(
            off < allowed && found.error < 0.03,
            "{found}, not {expected}"
        );
    }
}

/// The elements in contact cover the disc coarsely, and the temperature is that of the disc. The power of the shear is proportional to the
/// area, so that an area whose error is a tenth holds a disc that is larger by a tenth.
#[test]
fn a_known_area_corrects_the_temperature_of_coarse_elements() {
    let material = Viscous::new(1e4).expect("a material");
    let area = PI * RADIUS.powi(2);
    let [mut farthest, mut farthest_of_elements] = [0.0_f64; 2];
    for n in [6, 8, 12, 18] {
        let field = hertz(n);
        // Péclet number and k T/(q a) of the mean temperature, with the flux q: docs/theory/heat.md.
        for (peclet_number, exact) in [(0.5, 0.66334), (1.0, 0.55542), (10.0, 0.21284)] {
            let mean = |contact_area: Option<Estimate>, radius: f64| {
                let contact = SlidingContact {
                    pressure: &field,
                    material: &material,
                    factors: ModulusFactors::NONE,
                    wave_shift: None,
                    velocity: 2.0 * DIFFUSIVITY * peclet_number / RADIUS,
                    shear_power: area,
                    contact_area,
                    bulk_power: 0.0,
                };
                heated(&contact, ContactKind::Body).mean * (CONDUCTIVITY / radius)
            };
            let corrected = mean(Some(Estimate::exact(area)), RADIUS);
            assert!(
                (corrected.value - exact).abs() <= corrected.error,
                "{n} elements, Pe = {peclet_number}: {corrected}, not {exact}"
            );
            farthest = farthest.max((corrected.value / exact - 1.0).abs());
            let of_elements = mean(None, RADIUS);
            farthest_of_elements =
                farthest_of_elements.max((of_elements.value / exact - 1.0).abs());
            let uncertain = mean(Some(Estimate::new(area, 0.1 * area)), RADIUS);
            let added = (uncertain.error - corrected.error) / corrected.value;
            // The temperature of slow discs grows with the root of the area, that of fast ones with its fourth root.
            let larger = 1.1_f64.sqrt() - 1.0;
            assert!((larger..0.06).contains(&added), "{added}");
        }
    }
    assert!(
        farthest < 0.5 * farthest_of_elements,
        "{farthest}, and {farthest_of_elements} without the area"
    );
}

/// The mean temperature of a period is that of the whole power, whatever the area.
#[test]
fn the_mean_temperature_of_a_period_follows_the_power_alone() {
    let material = Viscous::new(1e4).expect("a material");
    let field = hertz(16);
    let mean = |contact_area: Option<Estimate>| {
        let contact = SlidingContact {
            pressure: &field,
            material: &material,
            factors: ModulusFactors::NONE,
            wave_shift: None,
            velocity: 20.0 * DIFFUSIVITY / RADIUS,
            shear_power: 1e-3,
            contact_area,
            bulk_power: 0.0,
        };
        let rise = heated(&contact, ContactKind::Period { duration: 100.0 });
        let n = rise.temperature.len() as f64;
        [rise.temperature.iter().sum::<f64>() / n, rise.mean.value]
    };
    let [of_period, of_contact] = mean(None);
    let area = 2.0 * PI * RADIUS.powi(2);
    let [of_period_at_area, of_contact_at_area] = mean(Some(Estimate::exact(area)));
    assert!(
        (of_period_at_area / of_period - 1.0).abs() < 1e-12,
        "{of_period_at_area}, not {of_period}"
    );
    // The contact is hotter than the period by a flash that falls with the area.
    let ratio = (of_contact_at_area - of_period) / (of_contact - of_period);
    assert!((0.59..0.71).contains(&ratio), "{ratio}");
}

/// A long contact of a body with a straight front is a line contact in its middle.
#[test]
fn a_line_contact_has_the_temperature_of_a_long_body() {
    let (n, length) = (16, 12);
    let edge = 2.0 * RADIUS / n as f64;
    let along = |row: usize| {
        let x = ((row as f64 + 0.5) * edge - RADIUS) / RADIUS;
        LARGEST_PRESSURE * (1.0 - x * x).sqrt()
    };
    let field = |columns: usize| PressureField {
        grid: Grid::new([n, columns], [edge; 2]).expect("a grid"),
        origin: [0.5 * edge - RADIUS, 0.0],
        pressure: (0..n * columns)
            .map(|index| along(index / columns))
            .collect(),
    };
    let velocity = 2.0 * DIFFUSIVITY / RADIUS;
    let material = solid(1e6, 0.5 * RADIUS / velocity);
    let line = field(1);
    let columns = length * n;
    let body = field(columns);
    let contact = |pressure, power| SlidingContact {
        pressure,
        material: &material,
        factors: ModulusFactors::NONE,
        wave_shift: None,
        velocity,
        shear_power: power,
        contact_area: None,
        bulk_power: power,
    };
    let line = heated(&contact(&line, 1.0), ContactKind::Line);
    let body = heated(&contact(&body, edge * columns as f64), ContactKind::Body);
    let middle = |row: usize| body.temperature[row * columns + columns / 2];
    for (row, rise) in line.temperature.iter().enumerate() {
        let off = (middle(row) / rise - 1.0).abs();
        assert!(off < 0.05, "row {row}: {rise} and {}", middle(row));
    }
}

#[test]
fn impossible_contacts_are_refused() {
    let field = hertz(8);
    let mut unloaded = field.clone();
    unloaded.pressure.fill(0.0);
    let material = Viscous::new(1e4).expect("a material");
    let contact = SlidingContact {
        pressure: &field,
        material: &material,
        factors: ModulusFactors::NONE,
        wave_shift: None,
        velocity: 1.0,
        shear_power: 1.0,
        contact_area: None,
        bulk_power: 1.0,
    };
    for (wrong, name) in [
        (
            SlidingContact {
                velocity: 0.0,
                ..contact
            },
            "velocity",
        ),
        (
            SlidingContact {
                pressure: &unloaded,
                ..contact
            },
            "largest pressure",
        ),
        (
            SlidingContact {
                shear_power: -1.0,
                ..contact
            },
            "power of the shear",
        ),
        (
            SlidingContact {
                bulk_power: f64::NAN,
                ..contact
            },
            "power of the bulk",
        ),
        (
            SlidingContact {
                contact_area: Some(Estimate::exact(-1.0)),
                ..contact
            },
            "contact area",
        ),
    ] {
        let refused = wrong.temperature(&rubber(), Counterface::Insulating, ContactKind::Body);
        let is_named = matches!(
            &refused,
            Err(BemError::InvalidParameter(InvalidParameter { parameter, .. })) if *parameter == name
        );
        assert!(is_named, "{name}: {refused:?}");
    }
}
