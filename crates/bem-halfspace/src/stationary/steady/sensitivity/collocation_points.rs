//! Heights and slopes of a body at the elements of a contact.

use numerics::in_range;

use crate::BemError;
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::mesh::Mesh;

/// Height of a body \[m] as a function of the point.
pub(super) type Height<'a> = &'a dyn Fn([f64; 2]) -> f64;

/// The points at which a body enters the equations of a contact.
#[derive(Debug)]
pub(super) struct CollocationPoints {
    /// Centres of the elements, of one half where the contact is mirror symmetric, \[m].
    centres: Vec<[f64; 2]>,
    /// Position of the collocation points, in elements from the centres.
    collocation_shift: f64,
    /// Length Δx of an element, \[m].
    spacing: f64,
    /// Unit of heights D, \[m].
    depth_scale: f64,
    /// The slope whose mean under the load is the friction.
    pub(super) slope: FrictionSlope,
}

/// The slope whose mean under the load is the friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FrictionSlope {
    /// The slope of the body over each element.
    Body,
    /// The slope of the displacements at the centre of each element.
    Surface,
    /// The slope of the displacements at the collocation point of each element.
    SurfaceAtCollocationPoints,
}

impl CollocationPoints {
    /// Collocation points of some elements of a mesh, given by the indices of their candidates.
    pub(super) fn new(mesh: &Mesh, elements: &[usize], loading: &Loading) -> Self {
        let is_solid = mesh.loading.is_solid_for_elements();
        let centres = elements.iter().map(|&element| mesh.position(element));
        Self {
            centres: centres.collect(),
            collocation_shift: mesh.loading.creep.collocation_shift,
            spacing: mesh.options.spacing[0],
            depth_scale: loading.depth_scale,
            // The friction follows from slopes on a dashpot, and under edges on a material that is more of a fluid. Otherwise it
            // follows from dissipation.
            slope: match loading.has_edges {
                _ if loading.creep.only_flows() => FrictionSlope::Body,
                true if is_solid => FrictionSlope::SurfaceAtCollocationPoints,
                true => FrictionSlope::Body,
                false => FrictionSlope::Surface,
            },
        }
    }

    /// The unit of slopes: the depth scale over the length of an element.
    pub(super) fn slope_unit(&self) -> f64 {
        self.depth_scale / self.spacing
    }

    /// Heights at `shift` elements from the centres, in units of the depth scale.
    fn heights_at(&self, body: Height, shift: f64) -> Result<Vec<f64>, BemError> {
        let height = |&[x, y]: &[f64; 2]| {
            let height = body([x + shift * self.spacing, y]);
            in_range(
                "height in the contact",
                height,
                height.is_finite(),
                "finite",
            )?;
            Ok(height / self.depth_scale)
        };
        self.centres.iter().map(height).collect()
    }

    /// Heights at the collocation points, in units of the depth scale.
    pub(super) fn heights(&self, body: Height) -> Result<Vec<f64>, BemError> {
        self.heights_at(body, self.collocation_shift)
    }

    /// Explicit slope terms: the part of the friction slope of each element that depends on the body at fixed loads, in units of
    /// [`slope_unit`](Self::slope_unit).
    pub(super) fn explicit_slope_terms(&self, body: Height) -> Result<Vec<f64>, BemError> {
        let rise = |from: f64, to: f64| -> Result<Vec<f64>, BemError> {
            let rear = self.heights_at(body, from)?;
            Ok(differences(rear, &self.heights_at(body, to)?))
        };
        match self.slope {
            FrictionSlope::Body => rise(-0.5, 0.5),
            FrictionSlope::SurfaceAtCollocationPoints => Ok(vec![0.0; self.centres.len()]),
            FrictionSlope::Surface => {
                let outer = rise(self.collocation_shift - 1.0, self.collocation_shift + 1.0)?;
                let pairs = rise(-0.5, 0.5)?.into_iter().zip(outer);
                Ok(pairs.map(|(own, outer)| own - 0.5 * outer).collect())
            }
        }
    }
}

/// Element-wise differences `to` − `from`.
pub(super) fn differences(mut from: Vec<f64>, to: &[f64]) -> Vec<f64> {
    from.iter_mut()
        .zip(to)
        .for_each(|(from, to)| *from = to - *from);
    from
}
