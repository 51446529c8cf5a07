//! Native module of the Python package `viscofriction`: scenes solved for arrays of loads, sweeps, properties of materials, and
//! fits.
//!
//! The module keeps no state; Python holds bodies, materials and results. Invalid input raises a `ValueError` that names it.
//! A missed request is returned as data, from which Python makes its own exception.

mod background;
mod friction;
mod indentation;
mod materials;
mod moduli;
mod reading;
mod roughness;
mod solving;
mod tables;

/// The native module.
#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use super::friction::{fit_points, read_friction};
    #[pymodule_export]
    use super::indentation::fit_curve;
    #[pymodule_export]
    use super::materials::{
        expand_relaxation, fit_oscillation, fit_relaxation, material_curve, scaling_factor,
    };
    #[pymodule_export]
    use super::moduli::{fit_isotherms, read_moduli, shifted};
    #[pymodule_export]
    use super::roughness::{check_height_map, read_heights, surface_numbers};
    #[pymodule_export]
    use super::solving::{
        changed_row, printed, quantities, shared_warnings, solve_loads, sweep_plan, sweep_points,
        sweep_problem,
    };
    #[pymodule_export]
    use super::tables::{check_table, toml_text};
}
