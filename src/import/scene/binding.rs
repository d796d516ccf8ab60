//! How skins are bound: one inverse bind matrix for each joint, and joints that stand in where skins differ.

use glam::{Affine3A, DAffine3};

use crate::diagnostic::Fault;
use crate::model::{JointIndex, LocalJoint, Skeleton};

/// Inverse bind matrices that differ by less are the same, as a part of their size: what files and f32 lose of them.
const ROUNDING: f64 = 1e-5;

/// Skins that are moved by less than this at rest stand there, as a part of their size.
const AS_AT_REST: f64 = 1e-3;

/// How the vertices of a skin are bound.
#[derive(Clone, Debug)]
pub(super) struct BoundSkin {
    pub(super) joints: Vec<u32>,
    pub(super) bind_from_mesh: DAffine3,
}

/// Whether a transform does not flatten space, whatever its unit, and its inverse can be written.
pub(in crate::import) fn is_invertible(matrix: &DAffine3) -> bool {
    let m = matrix.matrix3;
    let volume = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
    m.determinant().abs() > 1e-9 * volume && matrix.inverse().as_affine3a().is_finite()
}

/// Whether two transforms are the same within a part of their size.
fn are_same(a: &DAffine3, b: &DAffine3, tolerance: f64) -> bool {
    let greatest = |numbers: [f64; 3]| numbers.into_iter().fold(1e-30, f64::max);
    let axis = greatest([a.matrix3.x_axis, a.matrix3.y_axis, a.matrix3.z_axis].map(|axis| axis.length()));
    let reach = greatest([axis, a.translation.length(), b.translation.length()]);
    a.matrix3.abs_diff_eq(b.matrix3, tolerance * axis) && a.translation.abs_diff_eq(b.translation, tolerance * reach)
}

/// Inverse bind matrices while they are found. Joints that stand in for others come behind the nodes'.
pub(super) struct Binding {
    /// Of the nodes' joints, relative to the model.
    pub(super) model_at_rest: Vec<DAffine3>,
    pub(super) parents: Vec<Option<u32>>,
    pub(super) rest: Vec<LocalJoint>,
    pub(super) joint_from_bind: Vec<Option<DAffine3>>,
}

impl Binding {
    /// Binds a skin whose slots are these joints.
    pub(super) fn bind(&mut self, joints: &[u32], matrices: &[DAffine3]) -> BoundSkin {
        let known = |binding: &Self, joint: u32| binding.joint_from_bind[joint as usize];
        let shared: Vec<(DAffine3, DAffine3)> = joints
            .iter()
            .zip(matrices)
            .filter_map(|(&joint, &matrix)| Some((known(self, joint)?, matrix)))
            .collect();
        let fits = |bind_from_mesh: &DAffine3| {
            let pairs = || shared.iter();
            is_invertible(bind_from_mesh)
                && pairs().all(|(known, matrix)| are_same(&(*known * *bind_from_mesh), matrix, ROUNDING))
        };
        let differing = shared.iter().find(|(known, _)| is_invertible(known));
        let candidates = [
            Some(DAffine3::IDENTITY),
            differing.map(|(known, matrix)| known.inverse() * *matrix),
        ];
        let bind_from_mesh = if shared.is_empty() {
            self.upright(joints, matrices)
        } else {
            candidates.into_iter().flatten().find(fits)
        };
        let bind_from_mesh = bind_from_mesh.unwrap_or(DAffine3::IDENTITY);
        let mesh_from_bind = bind_from_mesh.inverse();
        let is_moved = bind_from_mesh != DAffine3::IDENTITY;
        let slots = joints.iter().zip(matrices).map(|(&joint, &matrix)| {
            let wanted = if is_moved { matrix * mesh_from_bind } else { matrix };
            match self.joint_from_bind[joint as usize] {
                None => {
                    self.joint_from_bind[joint as usize] = Some(wanted);
                    joint
                }
                Some(known) if are_same(&known, &wanted, ROUNDING) => joint,
                Some(_) => self.stand_in(joint, wanted),
            }
        });
        BoundSkin {
            joints: slots.collect(),
            bind_from_mesh,
        }
    }

    /// What brings the mesh of a skin to where it is at rest, when all its joints move it alike there, or when it is of quite
    /// another size in the file, or mirrored: exporters that scale a character leave its mesh as it was. `None` where it stays as it is.
    fn upright(&self, joints: &[u32], matrices: &[DAffine3]) -> Option<DAffine3> {
        let at_rest = |(&joint, matrix): (&u32, &DAffine3)| self.model_at_rest[joint as usize] * *matrix;
        let first = joints
            .iter()
            .zip(matrices)
            .min_by_key(|(joint, _)| **joint)
            .map(at_rest)?;
        if !is_invertible(&first) || are_same(&first, &DAffine3::IDENTITY, AS_AT_REST) {
            return None;
        }
        let are_alike = || {
            joints
                .iter()
                .zip(matrices)
                .all(|slot| are_same(&first, &at_rest(slot), AS_AT_REST))
        };
        // Negative where it mirrors: fronts are then wound the other way.
        let size = first.matrix3.determinant().cbrt();
        (!(0.5..2.0).contains(&size) || are_alike()).then_some(first)
    }

    /// A joint on another one, for another inverse bind matrix.
    fn stand_in(&mut self, joint: u32, joint_from_bind: DAffine3) -> u32 {
        let stand_in = self.parents.len() as u32;
        self.parents.push(Some(joint));
        self.rest.push(LocalJoint::IDENTITY);
        self.joint_from_bind.push(Some(joint_from_bind));
        stand_in
    }

    /// Places the first `count` joints that no skin binds where their relatives are in the bind pose, and where they are at rest
    /// when no skin binds any of these.
    pub(super) fn place_others(&mut self, count: usize) {
        let local: Vec<DAffine3> = self
            .rest
            .iter()
            .map(|rest| rest.parent_from_joint().as_daffine3())
            .collect();
        for joint in (0..count).rev() {
            let Some(parent) = self.parents[joint] else { continue };
            if self.joint_from_bind[parent as usize].is_none()
                && let Some(joint_from_bind) = self.joint_from_bind[joint]
                && let parent_from_bind = local[joint] * joint_from_bind
                && is_invertible(&parent_from_bind)
            {
                self.joint_from_bind[parent as usize] = Some(parent_from_bind);
            }
        }
        let mut model_from_joint: Vec<DAffine3> = Vec::with_capacity(count);
        for (joint, local) in local.iter().enumerate().take(count) {
            let model_from_parent =
                self.parents[joint].map_or(DAffine3::IDENTITY, |parent| model_from_joint[parent as usize]);
            let placed = match self.joint_from_bind[joint] {
                Some(joint_from_bind) if is_invertible(&joint_from_bind) => joint_from_bind.inverse(),
                _ => model_from_parent * *local,
            };
            model_from_joint.push(placed);
            if self.joint_from_bind[joint].is_none() {
                let is_sound = is_invertible(&placed);
                self.joint_from_bind[joint] = Some(if is_sound { placed.inverse() } else { DAffine3::IDENTITY });
            }
        }
    }

    /// The joint that carries a mesh without a skin, and what brings the mesh into bind space.
    pub(super) fn bind_on(&mut self, joint: u32) -> (Option<u32>, DAffine3) {
        match self.joint_from_bind[joint as usize] {
            Some(joint_from_bind) if is_invertible(&joint_from_bind) => (Some(joint), joint_from_bind.inverse()),
            _ => (Some(self.stand_in(joint, DAffine3::IDENTITY)), DAffine3::IDENTITY),
        }
    }

    pub(super) fn skeleton(self, file_bones: Vec<u32>, names: Vec<String>) -> Result<Skeleton, Fault> {
        let matrix = |matrix: Option<DAffine3>| {
            let matrix = matrix.unwrap_or(DAffine3::IDENTITY).as_affine3a();
            if matrix.is_finite() { matrix } else { Affine3A::IDENTITY }
        };
        let joint_from_bind = self.joint_from_bind.into_iter().map(matrix).collect();
        let parents = self.parents.into_iter().map(|parent| parent.map(JointIndex)).collect();
        let skeleton = Skeleton::new(parents, joint_from_bind, file_bones)?;
        Ok(skeleton.with_rest(&self.rest).with_names(names))
    }
}
