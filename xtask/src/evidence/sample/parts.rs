//! Bodies and materials of random scenes, one arm for each kind.

use std::f64::consts::TAU;

use viscofriction::scene::{
    Branch, Edges, HeightMapTable, HeightsAre, Indenter, IndenterKind, MaterialKind, MaterialTable,
    SelfAffineSurface, Shift, ShiftLaw, Term,
};

use super::{HEIGHTS, Lengths, MATERIAL, PROFILE, Sample};

/// Of materials that know their shift law, \[°C].
const TEMPERATURES: [f64; 2] = [10.0, 40.0];

impl Sample<'_> {
    pub(super) fn body(&mut self, kind: IndenterKind) -> Indenter {
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
    pub(super) fn half_space(&mut self, kind: MaterialKind) -> MaterialTable {
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
            approximation: None,
        }
    }
}
