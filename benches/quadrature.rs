//! The equivalent line by quadrature, for a body that also has it in closed form.

use std::hint::black_box;

use benches::report_error;
use criterion::Criterion;
use indenters::{Axisymmetric, IndenterError, Sphere, abel_height};

fn main() -> Result<(), IndenterError> {
    let mut criterion = Criterion::default().configure_from_args();
    let sphere = Sphere::new(1.0)?;
    let x = 0.5;
    let name = "quadrature/equivalent_line";
    let heights = [abel_height(&sphere, x), sphere.line_height(x)];
    report_error(name, "height", heights);
    criterion.bench_function(name, |bencher| {
        bencher.iter(|| abel_height(&sphere, black_box(x)));
    });
    criterion.final_summary();
    Ok(())
}
