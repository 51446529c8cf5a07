//! What is drawn for a random scene: numbers under the names that they have in `recipes.toml`, load, motion and accuracy.

use std::f64::consts::TAU;
use std::path::Path;

use anyhow::Result;
use toml::{Table, Value};
use viscofriction::Files;
use viscofriction::scene::{
    Branch, Counterface, Edges, EnergyUnit, Heat, Interface, Key, LoadPoint, Model, MotionPoint,
    Scene, Shift, ShiftLaw, Strain, StrokeShape, Term, VerticalLaw,
};
use viscofriction::solve::{Body, body, half_space};

use super::{HEIGHTS, Lengths, Motion, PROFILE, Range, SPECTRUM, keys_of, read};
use crate::evidence::unit::Unit;
use crate::random::Random;

/// Relative error requested of reciprocating motions, and of those through points, on the half space. Chosen: a smaller one
/// takes too long.
const ERROR_OF_MOTION: f64 = 0.1;
/// Range of validity of drawn shift laws, \[°C]. Chosen; reference and actual temperature are drawn from it.
const TEMPERATURES: [f64; 2] = [10.0, 40.0];

/// A scene that is being drawn.
pub(super) struct Sample<'a> {
    /// Source of everything drawn.
    pub(super) random: &'a mut Random,
    /// Units in which the numbers of the scene are moderate, \[m], \[Pa], \[s].
    pub(super) length: f64,
    pub(super) stress: f64,
    pub(super) time: f64,
    /// Half the length of the contact \[m], and the time \[s] in which the body slides over it or is pressed.
    pub(super) contact: f64,
    pub(super) contact_time: f64,
    /// The file of the body, if it has one.
    pub(super) lengths: Option<Lengths>,
    /// Numbers and other values drawn so far, by their names in the recipes.
    pub(super) drawn: Table,
}

impl Sample<'_> {
    /// Adds values to [`Self::drawn`] under `names`, separated by blanks, in the same order.
    fn draw<V: Into<Value>, const N: usize>(&mut self, names: &str, values: [V; N]) {
        let names = names.split(' ').map(str::to_owned);
        self.drawn.extend(names.zip(values.map(Into::into)));
    }

    /// The shear strength of a contact: constant, or a bell over the velocity.
    pub(super) fn interface(&mut self) -> Interface {
        let shear_strength = self.stress * 10_f64.powf(self.random.between([-4.0, 0.0]));
        let velocity = self.contact / self.contact_time * self.random.decades(2.0);
        let width = self.random.between([0.5, 4.0]);
        if self.random.uniform() < 0.5 {
            return Interface::Constant { shear_strength };
        }
        Interface::Bell {
            shear_strength,
            velocity,
            width,
            activation_energy: None,
            activation_energy_unit: EnergyUnit::default(),
            reference_temperature: TEMPERATURES[0],
        }
    }

    /// Heat of sliding, at Péclet numbers of 0.03 to 100, that heats a contact with a friction coefficient of a tenth by a hundredth of a
    /// kelvin to a few kelvin.
    pub(super) fn heat(&mut self) -> Heat {
        let velocity = self.contact / self.contact_time;
        let rise = 10_f64.powf(self.random.between([-2.0, 0.5]));
        let peclet_number = 10_f64.powf(self.random.between([-1.5, 2.0]));
        let share = self.random.uniform();
        let counterfaces = [
            Counterface::Insulating,
            Counterface::Conducting,
            Counterface::Share(share),
        ];
        Heat {
            conductivity: 0.1 * self.stress * velocity * self.contact / rise,
            diffusivity: Some(velocity * self.contact / peclet_number),
            density: None,
            heat_capacity: None,
            ambient_temperature: None,
            counterface: self.random.choice(&counterfaces),
            duration: Some(self.contact_time * 10_f64.powf(self.random.between([0.0, 2.0]))),
        }
    }

    /// Strain dependence with a critical strain of about the slope of a body, whose loss modulus has a peak or falls less than the storage
    /// modulus.
    pub(super) fn strain(&mut self) -> Strain {
        Strain::Kraus {
            critical_strain: 10_f64.powf(self.random.between([-3.0, -0.5])),
            exponent: self.random.between([0.4, 0.8]),
            storage_ratio: self.random.between([0.2, 0.9]),
            loss_peak_ratio: self.random.between([1.0, 2.0]),
        }
    }

    /// Draws what a body of this kind may need: slopes, radii and what no range of a key describes.
    pub(super) fn draw_body(&mut self, kind: &str) -> Result<()> {
        let slope = 10_f64.powf(self.random.between([-2.5, -0.3]));
        let radius = self.length * 10_f64.powf(self.random.between([0.3, 1.5]));
        let tip = self.contact * 10_f64.powf(self.random.between([-1.0, 0.3]));
        let values = [slope, radius, tip, 0.5 / radius, self.contact];
        self.draw("slope radius tip curvature contact", values);
        match kind {
            "power" => {
                let exponents = [1.0, 2.0, self.random.between([0.55, 5.0])];
                let exponent = self.random.choice(&exponents);
                let coefficient = slope * self.length.powf(1.0 - exponent);
                self.draw("coefficient exponent", [coefficient, exponent]);
            }
            "superposition" => {
                let exponents = [[0.7, 2.0], [2.0, 4.0]].map(|range| self.random.between(range));
                let terms = exponents.map(|exponent| Term {
                    coefficient: slope * self.length.powf(1.0 - exponent),
                    exponent,
                });
                self.draw("terms", [Value::try_from(terms)?]);
            }
            "table" => self.draw_table(slope),
            "height-map" => self.draw_height_map(slope)?,
            "self-affine" => {
                self.draw_self_affine();
            }
            "spectrum" => self.draw_spectrum(slope),
            _ => {}
        }
        Ok(())
    }

    /// Draws the required numbers of a kind that neither its recipe has nor anything else has drawn: within the bounds of the
    /// schema if it has both, otherwise within half a decade of 1 in the units of the scene.
    pub(super) fn draw_numbers(&mut self, kind: &str, recipes: &Table) -> Result<()> {
        let own = recipes.get(kind).and_then(Value::as_table);
        for Key { name, words, .. } in keys_of(kind).filter(|key| key.is_required) {
            let is_known = [own, Some(&self.drawn)]
                .into_iter()
                .flatten()
                .any(|known| known.contains_key(name));
            if is_known || words["type"] != "number" {
                continue;
            }
            let bound = |word: &str| words[word].as_f64();
            let least = bound("minimum").or(bound("exclusiveMinimum"));
            let most = bound("maximum").or(bound("exclusiveMaximum"));
            let value = match [least, most] {
                [Some(least), Some(most)] => self.random.between([least, most]),
                _ => {
                    let unit = Unit::parse(words["x-unit"].as_str().unwrap_or_default())?;
                    let scale = self.length.powi(unit.length)
                        * self.stress.powi(unit.stress)
                        * self.time.powi(unit.time);
                    scale * self.random.decades(0.5)
                }
            };
            self.draw(name, [value]);
        }
        Ok(())
    }

    /// Draws the file of a profile: a power of the radius \[m], given at a few or many radii, between which it is straight.
    fn draw_table(&mut self, slope: f64) {
        let exponent = self.random.between([1.0, 3.0]);
        let count = self.random.choice(&[4, 12, 40]);
        let row = |row: i32| {
            let part = 4.0 * f64::from(row) / f64::from(count);
            [part, slope * part.powf(exponent)].map(|value| value * self.length)
        };
        self.lengths = Some(Lengths {
            file: PROFILE,
            columns: 2,
            values: (0..=count).flat_map(row).collect(),
        });
    }

    /// Draws the file of a height map, gaps \[m] row by row: a rippled dome within walls, or a wavy surface that repeats
    /// itself.
    fn draw_height_map(&mut self, slope: f64) -> Result<()> {
        let edges = [Edges::Wall, Edges::Periodic, Edges::Mirrored];
        let edges = self.random.choice(&edges);
        let counts = [(); 2].map(|()| self.random.choice(&[15_u32, 16, 22, 27, 32]));
        let waves: Vec<[f64; 3]> = (0..5).map(|_| self.wave(slope)).collect();
        let (dome, ripple) = match edges {
            Edges::Wall => (0.25 * slope, 0.02),
            _ => (0.0, 1.0),
        };
        let gap = |place: [u32; 2]| {
            let [x, y] = [0, 1].map(|axis| f64::from(place[axis]) / f64::from(counts[axis]));
            let wave = |[amplitude, along, across]: &[f64; 3]| {
                amplitude * (TAU * (along * x + across * y + amplitude / slope)).cos()
            };
            let waves: f64 = waves.iter().map(wave).sum();
            let from_middle = [x, y].map(|part| (4.0 * (part - 0.5)).powi(2));
            self.length * (dome * from_middle.iter().sum::<f64>() + ripple * waves)
        };
        let [columns, rows] = counts;
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        let values = places.map(gap).collect();
        let spacing = counts.map(|count| 4.0 * self.length / f64::from(count));
        let file = self.random.choice(&HEIGHTS);
        self.lengths = Some(Lengths {
            file,
            columns: columns as usize,
            values,
        });
        let values = [
            file.into(),
            spacing.to_vec().into(),
            Value::try_from(edges)?,
        ];
        self.draw("file spacing edges", values);
        Ok(())
    }

    /// A wave of a height map: ratio of the amplitude to the unit of length, and how many times the wave fits into the map along
    /// and across.
    fn wave(&mut self, slope: f64) -> [f64; 3] {
        let counts = [1.0, 2.0, 3.0, 4.0];
        let [along, across] = [(); 2].map(|()| self.random.choice(&counts));
        let across = self.random.choice(&[across, -across, 0.0]);
        [slope * self.random.between([0.1, 1.0]) / TAU, along, across]
    }

    /// Draws the file of a spectrum: both ends of a self-affine one, wave number q \[1/m] and density C \[m⁴]. C ∼ q^(−2 − 2H)
    /// is scaled to the root mean square slope: 2π ∫ q³ C dq = slope².
    fn draw_spectrum(&mut self, slope: f64) {
        let [hurst_exponent, longest, shortest] = self.draw_self_affine();
        let [first, last] = [longest, shortest].map(|length| TAU / length);
        let power = 2.0 - 2.0 * hurst_exponent;
        let whole = TAU * first.powi(4) * (power * (last / first).ln()).exp_m1() / power;
        let density = slope * slope / whole;
        let end = density * (last / first).powf(power - 4.0);
        self.lengths = Some(Lengths {
            file: SPECTRUM,
            columns: 2,
            values: vec![first, density, last, end],
        });
    }

    /// Draws a self-affine surface; returns its Hurst exponent and its longest and shortest wavelength \[m].
    fn draw_self_affine(&mut self) -> [f64; 3] {
        let longest = self.length * self.random.choice(&[1.0, 0.5]);
        let period = vec![self.length, self.length * self.random.choice(&[1.0, 1.5])];
        let hurst_exponent = self.random.between([0.2, 0.95]);
        let shortest = longest / self.random.choice(&[2.0, 4.0, 6.0]);
        let seed = self.random.choice(&[1_i64, 2, 3, 4, 5, 6, 7, 8]);
        let numbers = [hurst_exponent, longest, shortest];
        self.draw(
            "hurst_exponent longest_wavelength shortest_wavelength",
            numbers,
        );
        self.draw("period seed", [Value::from(period), seed.into()]);
        numbers
    }

    /// Draws what a material of this kind may need; all are drawn for every kind but the series and the shift.
    pub(super) fn draw_material(&mut self, kind: &str) -> Result<()> {
        let compressible = self.random.between([-0.9, 0.5]);
        let poisson_ratio = self.random.choice(&[0.5, compressible]);
        let (stress, time) = (self.stress, self.time);
        let viscosity = stress * time * self.random.decades(1.0);
        let maxwell_modulus = stress * self.random.decades(2.5);
        let time_range = [1e-3, 1e3].map(|ratio| ratio * self.contact_time);
        let order = self.random.between([0.05, 0.95]);
        let equilibrium_modulus = self.random.choice(&[0.0, stress]);
        self.draw(
            "stress time poisson_ratio viscosity",
            [stress, time, poisson_ratio, viscosity],
        );
        self.draw(
            "maxwell_modulus maxwell_viscosity",
            [maxwell_modulus, maxwell_modulus * time],
        );
        let quasi_property = stress * time.powf(order);
        let fractional = [order, quasi_property, equilibrium_modulus];
        self.draw("order quasi_property equilibrium_modulus", fractional);
        self.draw("time_range", [time_range.to_vec()]);
        if ["prony", "file"].contains(&kind) {
            self.draw_prony()?;
        }
        if kind == "file" {
            let law = ShiftLaw::Wlf([[2.0, 20.0], [40.0, 200.0]].map(|c| self.random.between(c)));
            let shift = Shift {
                temperature: self.random.between(TEMPERATURES),
                temperature_range: TEMPERATURES,
                law,
                vertical: self
                    .random
                    .choice(&[false, true])
                    .then_some(VerticalLaw::Entropic),
            };
            self.draw("shift", [Value::try_from(shift)?]);
            let other = self.random.between(TEMPERATURES);
            if let Some(other) = self.random.choice(&[None, Some(other)]) {
                self.draw("temperature", [other]);
            }
        }
        Ok(())
    }

    /// Draws a Prony series of up to eight branches: with or without an equilibrium modulus, a viscosity and a window of
    /// validity.
    fn draw_prony(&mut self) -> Result<()> {
        let count = self.random.choice(&[1, 2, 3, 8]);
        let branch = |_| Branch {
            modulus: self.stress * self.random.decades(2.0),
            relaxation_time: self.time * self.random.decades(3.0),
        };
        let branches: Vec<Branch> = (0..count).map(branch).collect();
        let viscosity = self.stress * self.time * self.random.decades(2.0);
        let lowest = self.random.decades(2.0) / self.contact_time;
        let highest = lowest * 10_f64.powf(self.random.between([0.5, 4.0]));
        let modulus = self.random.choice(&[self.stress, self.stress, 0.0]);
        let viscosity = self.random.choice(&[0.0, 0.0, viscosity]);
        self.draw("lone_modulus lone_viscosity", [modulus, viscosity]);
        self.draw("branches", [Value::try_from(branches)?]);
        if self.random.choice(&[false, true]) {
            self.draw("window", [vec![lowest, highest]]);
        }
        Ok(())
    }

    /// Draws load, motion, model and accuracy into `scene`, whose body and material are drawn and whose files are in `folder`.
    /// A body that is refused keeps no load.
    pub(super) fn motion(&mut self, scene: &mut Scene, range: &Range, folder: &Path) -> Result<()> {
        let files = Files::of(scene, folder, read)?;
        // A body that is refused, such as one of a file of lengths beyond 1e30 m, needs no load to be refused.
        let Ok(body) = body(&scene.indenter, &files).map(|of_scene| of_scene.body) else {
            return Ok(());
        };
        let [force, depth] = self.load(scene, &body, &files)?;
        let is_round = matches!(body, Body::Revolution(_)) && scene.layer.is_none();
        if is_round && self.random.uniform() < 0.25 {
            scene.solve.model = Some(Model::Line);
        }
        scene.solve.relative_error = Some(self.random.choice(&range.errors));
        scene.solve.max_memory = Some(range.memory.clone());
        let at_depth = self.random.uniform() < range.depths;
        let motion = self.random.choice(&range.motions);
        if let Body::Periodic(surface) = &body {
            let area: f64 = surface.period().iter().product();
            scene.load.mean_pressure = Some(force / area);
        } else if motion == Motion::History {
            scene.load.history = Some(self.history((!at_depth).then_some(force), depth));
            return Ok(());
        } else if at_depth {
            scene.load.indentation_depth = Some(depth);
        } else {
            scene.load.normal_force = Some(force);
        }
        let velocity = 2.0 * self.contact / self.contact_time;
        if matches!(motion, Motion::Stroke | Motion::Path) {
            self.move_along(scene, velocity);
            return Ok(());
        }
        let lengths = 3.0 * self.random.decades(range.distances);
        let slides = !matches!(motion, Motion::Pressed | Motion::History);
        scene.load.velocity = Some(if slides { velocity } else { 0.0 });
        match motion {
            Motion::Track => scene.load.track = Some(10.0 * lengths * self.contact),
            Motion::Stationary | Motion::Stroke | Motion::Path => {}
            Motion::SlidingForTime => scene.solve.duration = Some(lengths * self.contact_time),
            Motion::SlidingOverDistance => {
                scene.solve.sliding_distance = Some(lengths * self.contact);
            }
            Motion::Pressed | Motion::History => scene.solve.duration = Some(self.contact_time),
        }
        Ok(())
    }

    /// Force \[N] and depth D \[m] of a contact of about the radius a that was drawn, by D = h(a) = 2 (1 − ν) F J(t)/(4 a): the
    /// depth of a flat punch of this radius on the half space, which is enough for the order of magnitude. ν is Poisson's
    /// ratio, J the creep compliance.
    fn load(&mut self, scene: &Scene, body: &Body, files: &Files<'_>) -> Result<[f64; 2]> {
        let material = half_space(&scene.material, files)?.material;
        let compliance =
            material.half_space_factor() * material.creep_compliance(self.contact_time)?;
        let depth = match body {
            Body::Revolution(body) => match body.profile_height(self.contact) {
                height if height > 0.0 => height,
                _ => 0.02 * self.contact,
            },
            Body::Periodic(surface) => {
                let area: f64 = surface.period().iter().product();
                let pressure = surface.rms_slope() * 10_f64.powf(self.random.between([-2.0, 0.5]));
                return Ok([pressure * area / compliance, 0.0]);
            }
            Body::Cylinder(cylinder) => {
                // Choose the force per length F' from F' J(t) 2 (1 − ν) = π a²/R, with the creep compliance J, the Poisson ratio
                // ν, half the contact length a and the radius R.
                let force = self.contact * self.contact / cylinder.radius() / compliance;
                return Ok([force, 0.01 * self.contact]);
            }
            Body::HeightMap(_) => 0.02 * self.contact,
        };
        Ok([4.0 * self.contact * depth / compliance, depth])
    }

    /// Draws a motion at about `velocity` \[m/s]: reciprocating over a part of a contact or some contacts, or through up to five
    /// points with a rest at some of them. On the half space it is solved to [`ERROR_OF_MOTION`].
    fn move_along(&mut self, scene: &mut Scene, velocity: f64) {
        if scene.solve.model.is_none() {
            scene.solve.relative_error = Some(ERROR_OF_MOTION);
        }
        if self.random.choice(&[false, true]) {
            let stroke = self.contact * 10_f64.powf(self.random.between([-1.5, 0.8]));
            scene.load.stroke = Some(stroke);
            scene.load.frequency = Some(0.5 * velocity / stroke);
            let shapes = [None, Some(StrokeShape::Triangular)];
            scene.load.shape = self.random.choice(&shapes);
            return;
        }
        let (mut time, mut position) = (0.0, 0.0);
        let count = self.random.choice(&[2, 3, 5]);
        let mut points = Vec::new();
        for number in 0..count {
            points.push(MotionPoint {
                time,
                position,
                normal_force: None,
                indentation_depth: None,
            });
            let step = self.contact * self.random.between([-3.0, 3.0]);
            let stops = number > 0 && self.random.uniform() < 0.3;
            position += if stops { 0.0 } else { step };
            time += step.abs() / velocity * self.random.decades(0.5);
        }
        scene.load.motion = Some(points);
    }

    /// Up to six points of a force \[N] or, without one, of a depth \[m] that rises and falls, with dwells and jumps.
    fn history(&mut self, force: Option<f64>, depth: f64) -> Vec<LoadPoint> {
        let count = self.random.choice(&[2, 3, 4, 6]);
        let (mut time, mut level) = (0.0, 0.0);
        let mut points = Vec::new();
        for _ in 0..count {
            points.push(LoadPoint {
                time,
                normal_force: force.map(|force| force * level),
                indentation_depth: force.is_none().then_some(depth * level),
            });
            let step = self.contact_time * self.random.decades(1.0);
            time += self.random.choice(&[step, step, step, step, 0.0]);
            let next = self.random.uniform();
            level = self.random.choice(&[next, next, next, level, 0.0]);
        }
        points
    }
}
