//! Random scenes over all that a scene can be: every kind of body and material is drawn from the types of the scene file, so
//! that the compiler refuses one that is forgotten.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

use anyhow::{Context, Result};
use strum::IntoEnumIterator as _;
use viscofriction::npy::to_npy;
use viscofriction::scene::{
    Branch, Edges, HeightMapTable, HeightsAre, Indenter, IndenterKind, Layer, Load, LoadPoint,
    MaterialKind, MaterialTable, Method, Model, Scene, SelfAffineSurface, Shift, ShiftLaw, Solve,
    Term,
};
use viscofriction::solve::{Body, Problem, body, choose, half_space};
use viscofriction::{Files, WrongInput};

use crate::output::write_atomically;
use crate::random::Random;

/// A scene, and what the files hold that it names.
#[derive(Debug, Clone)]
pub(super) struct Case {
    pub(super) scene: Scene,
    /// Lengths of a profile or a height map.
    pub(super) lengths: Option<Lengths>,
    /// The material of a file.
    pub(super) material: Option<MaterialTable>,
    /// About half the length of the contact, \[m].
    pub(super) contact: f64,
}

/// A file of lengths \[m], row by row.
#[derive(Debug, Clone)]
pub(super) struct Lengths {
    file: &'static str,
    pub(super) columns: usize,
    pub(super) values: Vec<f64>,
}

/// Memory of one solution, which bounds the size of a scene.
const MEMORY: &str = "48 MiB";
/// Relative errors that are asked for.
const ERRORS: [f64; 4] = [0.1, 0.05, 0.02, 0.01];
/// Half the decades over which the units of length, stress and time are spread; some scenes are extreme.
const DECADES: [f64; 8] = [3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 9.0, 40.0];
/// Files that scenes name.
const HEIGHTS: [&str; 2] = ["heights.npy", "heights.csv"];
/// Of materials that know their shift law, \[°C].
const TEMPERATURES: [f64; 2] = [10.0, 40.0];
const PROFILE: &str = "profile.csv";
const MATERIAL: &str = "material.toml";

/// Reads a file of a case.
pub(super) fn read(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    std::fs::read(path).map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

impl Case {
    /// Writes the scene, as `viscofriction run` takes it, and its files into a folder.
    pub(super) fn write(&self, folder: &Path, name: &str) -> Result<()> {
        let text = toml::to_string(&self.scene).context("a scene as text")?;
        write_atomically(&folder.join(name), text.as_bytes())?;
        self.write_files(folder)
    }

    fn write_files(&self, folder: &Path) -> Result<()> {
        if let Some(lengths) = &self.lengths {
            write_atomically(&folder.join(lengths.file), &lengths.contents())?;
        }
        if let Some(material) = &self.material {
            let text = toml::to_string(&BTreeMap::from([("material", material)]))?;
            write_atomically(&folder.join(MATERIAL), text.as_bytes())?;
        }
        Ok(())
    }

    /// The problem that the scene states, or what is wrong with it.
    pub(super) fn problem(&self, folder: &Path) -> Result<Problem> {
        self.write_files(folder)?;
        Ok(Problem::new(&self.scene, folder, read)?)
    }
}

impl Lengths {
    fn contents(&self) -> Vec<u8> {
        let rows = self.values.chunks(self.columns);
        if self.file == HEIGHTS[0] {
            return to_npy(&self.values, &[rows.len(), self.columns]);
        }
        let header = (self.file == PROFILE).then(|| "radius_m,height_m".to_owned());
        let line = |row: &[f64]| {
            let cells: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
            cells.join(",")
        };
        let lines: Vec<String> = header.into_iter().chain(rows.map(line)).collect();
        lines.join("\n").into()
    }
}

/// A scene that is drawn.
struct Sample<'a> {
    random: &'a mut Random,
    /// Units in which the numbers of the scene are moderate, \[m], \[Pa], \[s].
    length: f64,
    stress: f64,
    time: f64,
    /// Half the length of the contact, and the time in which the body slides over it or is pressed.
    contact: f64,
    contact_time: f64,
    lengths: Option<Lengths>,
    material: Option<MaterialTable>,
}

/// The next scene of the generator; its files are tried in `folder`.
pub(super) fn sample(random: &mut Random, folder: &Path) -> Result<Case> {
    let decades = random.choice(&DECADES);
    let [length, stress, time] = [1.0, 2.0, 1.0].map(|more| random.decades(decades * more));
    let contact = 0.3 * random.decades(0.3) * length;
    let contact_time = random.decades(3.0) * time;
    let kinds: Vec<IndenterKind> = IndenterKind::iter().collect();
    let materials: Vec<MaterialKind> = MaterialKind::iter().collect();
    let (kind, material) = (random.choice(&kinds), random.choice(&materials));
    let mut sample = Sample {
        random,
        length,
        stress,
        time,
        contact,
        contact_time,
        lengths: None,
        material: None,
    };
    let indenter = sample.body(kind);
    let material = sample.half_space(material);
    let is_thin = sample.random.uniform() < 0.2;
    let thickness = contact * 10_f64.powf(sample.random.between([-1.3, 2.0]));
    let mut case = Case {
        scene: Scene {
            indenter,
            material,
            layer: is_thin.then_some(Layer { thickness }),
            load: EMPTY,
            solve: Solve::default(),
        },
        lengths: sample.lengths.take(),
        material: sample.material.take(),
        contact,
    };
    case.write_files(folder)?;
    for _ in 0..MOTIONS {
        (case.scene.load, case.scene.solve) = (EMPTY, Solve::default());
        sample.motion(&mut case.scene, folder)?;
        let problem = case.problem(folder);
        if problem.is_ok_and(|problem| choose(&problem).is_ok()) {
            break;
        }
    }
    Ok(case)
}

/// Motions that are drawn for a body until one has a method, or the last one is refused.
const MOTIONS: usize = 3;
const EMPTY: Load = Load {
    normal_force: None,
    indentation_depth: None,
    mean_pressure: None,
    velocity: None,
    history: None,
    history_file: None,
};

impl Sample<'_> {
    fn body(&mut self, kind: IndenterKind) -> Indenter {
        let slope = 10_f64.powf(self.random.between([-2.5, -0.3]));
        let radius = self.length * 10_f64.powf(self.random.between([0.3, 1.5]));
        let tip = self.contact * 10_f64.powf(self.random.between([-1.0, 0.3]));
        let curvature = 0.5 / radius;
        match kind {
            IndenterKind::Power => {
                let exponents = [1.0, 2.0, self.random.between([0.55, 5.0])];
                let exponent = self.random.choice(&exponents);
                let coefficient = slope * self.length.powf(1.0 - exponent);
                Indenter::Power {
                    coefficient,
                    exponent,
                }
            }
            IndenterKind::Cone => Indenter::Cone { slope },
            IndenterKind::Paraboloid => Indenter::Paraboloid { curvature },
            IndenterKind::Sphere => Indenter::Sphere { radius },
            IndenterKind::Superposition => self.superposition(slope),
            IndenterKind::FlatPunch => Indenter::FlatPunch {
                radius: self.contact,
            },
            IndenterKind::FlatCone => Indenter::FlatCone { radius: tip, slope },
            IndenterKind::RoundTippedCone => Indenter::RoundTippedCone { radius: tip, slope },
            IndenterKind::Hyperboloid => Indenter::Hyperboloid { radius: tip, slope },
            IndenterKind::TruncatedParaboloid => Indenter::TruncatedParaboloid {
                radius: tip,
                curvature,
            },
            IndenterKind::Cylinder => Indenter::Cylinder { radius },
            IndenterKind::Table => self.table(slope),
            IndenterKind::HeightMap => self.height_map(slope),
            IndenterKind::SelfAffine => self.self_affine(slope),
        }
    }

    fn superposition(&mut self, slope: f64) -> Indenter {
        let exponents = [[0.7, 2.0], [2.0, 4.0]].map(|range| self.random.between(range));
        let terms = exponents.map(|exponent| Term {
            coefficient: slope * self.length.powf(1.0 - exponent),
            exponent,
        });
        Indenter::Superposition {
            terms: terms.into(),
        }
    }

    /// A smooth profile, or one with a kink, straight between some radii.
    fn table(&mut self, slope: f64) -> Indenter {
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
        Indenter::Table {
            file: PROFILE.into(),
        }
    }

    /// A rippled dome, or a wavy surface that repeats itself.
    fn height_map(&mut self, slope: f64) -> Indenter {
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
        let gaps: Vec<f64> = places.map(gap).collect();
        let file = self.random.choice(&HEIGHTS);
        self.lengths = Some(Lengths {
            file,
            columns: columns as usize,
            values: gaps,
        });
        Indenter::HeightMap(HeightMapTable {
            file: file.into(),
            spacing: Some(counts.map(|count| 4.0 * self.length / f64::from(count))),
            unit: None,
            heights_are: HeightsAre::Gap,
            direction: 0.0,
            fill_missing: false,
            level: false,
            edges,
            shortest_wavelength: None,
        })
    }

    /// Amplitude, and how many times it fits into the map along and across.
    fn wave(&mut self, slope: f64) -> [f64; 3] {
        let counts = [1.0, 2.0, 3.0, 4.0];
        let [along, across] = [(); 2].map(|()| self.random.choice(&counts));
        let across = self.random.choice(&[across, -across, 0.0]);
        [slope * self.random.between([0.1, 1.0]) / TAU, along, across]
    }

    fn self_affine(&mut self, rms_slope: f64) -> Indenter {
        let longest = self.length * self.random.choice(&[1.0, 0.5]);
        Indenter::SelfAffine(SelfAffineSurface {
            period: [self.length, self.length * self.random.choice(&[1.0, 1.5])],
            hurst_exponent: self.random.between([0.2, 0.95]),
            rms_slope,
            longest_wavelength: longest,
            shortest_wavelength: longest / self.random.choice(&[2.0, 4.0, 6.0]),
            roll_off_wavelength: None,
            seed: u64::from(self.random.choice(&[1_u32, 2, 3, 4, 5, 6, 7, 8])),
        })
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each kind")]
    fn half_space(&mut self, kind: MaterialKind) -> MaterialTable {
        let compressible = self.random.between([-0.9, 0.5]);
        let poisson_ratio = self.random.choice(&[0.5, compressible]);
        let stress = self.stress;
        let viscosity = stress * self.time * self.random.decades(1.0);
        let maxwell_modulus = stress * self.random.decades(2.5);
        let time_range = [1e-3, 1e3].map(|ratio| ratio * self.contact_time);
        let exponent = self.random.between([0.05, 0.95]);
        let equilibrium_modulus = self.random.choice(&[0.0, stress]);
        match kind {
            MaterialKind::Viscous => MaterialTable::Viscous {
                viscosity,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::Elastic => MaterialTable::Elastic {
                shear_modulus: stress,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::KelvinVoigt => MaterialTable::KelvinVoigt {
                shear_modulus: stress,
                viscosity,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::Maxwell => MaterialTable::Maxwell {
                shear_modulus: stress,
                viscosity,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::StandardSolid => MaterialTable::StandardSolid {
                equilibrium_modulus: stress,
                maxwell_modulus,
                viscosity: maxwell_modulus * self.time,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::Prony => self.prony(poisson_ratio),
            MaterialKind::Springpot => MaterialTable::Springpot {
                coefficient: stress * self.time.powf(exponent),
                exponent,
                equilibrium_modulus,
                time_range,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::FractionalMaxwell => MaterialTable::FractionalMaxwell {
                shear_modulus: stress,
                relaxation_time: self.time,
                exponent,
                equilibrium_modulus,
                time_range,
                poisson_ratio,
                valid_frequencies: None,
            },
            MaterialKind::File => {
                let mut material = self.prony(poisson_ratio);
                let law =
                    ShiftLaw::Wlf([[2.0, 20.0], [40.0, 200.0]].map(|c| self.random.between(c)));
                let temperature = self.random.between(TEMPERATURES);
                if let MaterialTable::Prony { shift, .. } = &mut material {
                    *shift = Some(Shift {
                        temperature,
                        temperature_range: TEMPERATURES,
                        law,
                    });
                }
                self.material = Some(material);
                let other = self.random.between(TEMPERATURES);
                MaterialTable::File {
                    path: MATERIAL.into(),
                    temperature: self.random.choice(&[None, Some(other)]),
                    poisson_ratio: None,
                    valid_frequencies: None,
                }
            }
        }
    }

    /// A solid, a rubber that flows, or a liquid, with up to eight branches.
    fn prony(&mut self, poisson_ratio: f64) -> MaterialTable {
        let count = self.random.choice(&[1, 2, 3, 8]);
        let branch = |_| Branch {
            modulus: self.stress * self.random.decades(2.0),
            relaxation_time: self.time * self.random.decades(3.0),
        };
        let branches = (0..count).map(branch).collect();
        let viscosity = self.stress * self.time * self.random.decades(2.0);
        let lowest = self.random.decades(2.0) / self.contact_time;
        let window = [
            lowest,
            lowest * 10_f64.powf(self.random.between([0.5, 4.0])),
        ];
        MaterialTable::Prony {
            equilibrium_modulus: self.random.choice(&[self.stress, self.stress, 0.0]),
            viscosity: self.random.choice(&[0.0, 0.0, viscosity]),
            branches,
            poisson_ratio,
            valid_frequencies: self.random.choice(&[None, Some(window)]),
            shift: None,
        }
    }

    /// Load, motion, model and what is asked.
    fn motion(&mut self, scene: &mut Scene, folder: &Path) -> Result<()> {
        let files = Files::of(scene, folder, read)?;
        let body = body(&scene.indenter, &files)?.body;
        let [force, depth] = self.load(scene, &body, &files)?;
        let is_round = matches!(body, Body::Revolution(_)) && scene.layer.is_none();
        if is_round && self.random.uniform() < 0.25 {
            scene.solve.model = Some(Model::Line);
        }
        scene.solve.relative_error = Some(self.random.choice(&ERRORS));
        scene.solve.max_memory = Some(MEMORY.to_owned());
        let at_depth = self.random.uniform() < 0.3;
        let kind = self.random.uniform();
        if let Body::Periodic(surface) = &body {
            let area: f64 = surface.period().iter().product();
            scene.load.mean_pressure = Some(force / area);
        } else if kind > 0.8 {
            scene.load.history =
                Some(self.history(if at_depth { None } else { Some(force) }, depth));
            return Ok(());
        } else if at_depth {
            scene.load.indentation_depth = Some(depth);
        } else {
            scene.load.normal_force = Some(force);
        }
        let velocity = 2.0 * self.contact / self.contact_time;
        let lengths = 3.0 * self.random.decades(1.0);
        scene.load.velocity = Some(if kind > 0.65 { 0.0 } else { velocity });
        if kind > 0.65 {
            scene.solve.duration = Some(self.contact_time);
        } else if kind > 0.55 {
            scene.solve.sliding_distance = Some(lengths * self.contact);
        } else if kind > 0.5 {
            scene.solve.duration = Some(lengths * self.contact_time);
        }
        Ok(())
    }

    /// Force \[N] and depth \[m] of a contact of about the length that was drawn: D = h(a) = 2 (1 − ν) F J(t)/(4 a).
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
                // F' J(t) 2 (1 − ν) = π a²/R.
                let force = self.contact * self.contact / cylinder.radius() / compliance;
                return Ok([force, 0.01 * self.contact]);
            }
            Body::HeightMap(_) => 0.02 * self.contact,
        };
        Ok([4.0 * self.contact * depth / compliance, depth])
    }

    /// Up to six points that rise and fall, with dwells and jumps, of a force or, without one, of a depth.
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

/// The methods, from the types of the scene file.
pub(super) fn methods() -> impl Iterator<Item = Method> {
    Method::iter()
}
