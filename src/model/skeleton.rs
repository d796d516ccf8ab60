//! Joints, parents before children.

use glam::{Affine3A, DAffine3};

use super::LocalJoint;
use crate::diagnostic::{Fault, codes};

/// Index of a joint in its skeleton (parents-first order).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointIndex(pub u32);

impl JointIndex {
    /// For indexing slices.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A hierarchy of joints: every parent has a lower index than its children. Several roots are fine.
#[derive(Clone, Debug, Default)]
pub struct Skeleton {
    parents: Vec<Option<JointIndex>>,
    joint_from_bind: Vec<Affine3A>,
    model_from_joint: Vec<Affine3A>,
    bind: Vec<LocalJoint>,
    /// Empty where joints rest in the bind pose.
    rest: Vec<LocalJoint>,
    file_bones: Vec<u32>,
    joint_of_bone: Vec<JointIndex>,
    names: Vec<String>,
}

impl Skeleton {
    /// Joints that the 16 bits of a vertex of glTF can name.
    pub const MOST_NAMED: usize = 1 << 16;

    /// A skeleton of joints in parents-first order; `joint_from_bind` are the inverse bind matrices, `file_bones` the
    /// number that each joint has in the file (an order of `0..joint_count`).
    ///
    /// # Errors
    /// When the lists differ in length, a parent does not come before its child, a matrix is not finite, or the file's
    /// numbers are not an order.
    pub fn new(
        parents: Vec<Option<JointIndex>>,
        joint_from_bind: Vec<Affine3A>,
        file_bones: Vec<u32>,
    ) -> Result<Self, Fault> {
        let joint_count = parents.len();
        if joint_from_bind.len() != joint_count || file_bones.len() != joint_count {
            let message = format!(
                "{joint_count} parents, {} inverse bind matrices and {} file bones; every joint has one of each.",
                joint_from_bind.len(),
                file_bones.len()
            );
            return Err(codes::JOINT_COUNT_MISMATCH.says(message).into());
        }
        for (joint, parent) in (0u32..).zip(&parents) {
            if let &Some(JointIndex(parent)) = parent
                && parent >= joint
            {
                let message = format!(
                    "Joint {joint} lists joint {parent} as its parent; a parent must come before its children."
                );
                return Err(codes::PARENT_NOT_BEFORE.says(message).into());
            }
        }
        if let Some(joint) = joint_from_bind.iter().position(|matrix| !matrix.is_finite()) {
            let message = format!("The inverse bind matrix of joint {joint} holds a number that is not finite.");
            return Err(codes::MATRIX_NOT_FINITE.says(message).into());
        }
        let joint_of_bone = inverse_order(&file_bones)?;
        let (model_from_joint, bind) = bind_pose(&parents, &joint_from_bind);
        Ok(Self {
            parents,
            joint_from_bind,
            model_from_joint,
            bind,
            rest: Vec::new(),
            file_bones,
            joint_of_bone,
            names: Vec::new(),
        })
    }

    /// The same skeleton at rest elsewhere than in its bind pose: each joint relative to its parent. Joints beyond the list stay.
    #[must_use]
    pub fn with_rest(mut self, rest: &[LocalJoint]) -> Self {
        let beyond = self.bind.iter().skip(rest.len());
        self.rest = rest.iter().chain(beyond).take(self.bind.len()).copied().collect();
        self
    }

    /// The same skeleton with the file's names of its joints; an empty one stands for none.
    #[must_use]
    pub fn with_names(mut self, names: Vec<String>) -> Self {
        self.names = names;
        self
    }

    /// The file's name of a joint, when it has one.
    pub fn name(&self, joint: JointIndex) -> Option<&str> {
        let name = self.names.get(joint.index())?;
        (!name.is_empty()).then_some(name)
    }

    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.parents.len()
    }

    /// Parent of each joint.
    pub fn parents(&self) -> &[Option<JointIndex>] {
        &self.parents
    }

    /// Inverse bind matrix of each joint: bind space -> joint space.
    pub fn joint_from_bind(&self) -> &[Affine3A] {
        &self.joint_from_bind
    }

    /// Each joint of the bind pose relative to the model; the identity for a joint whose inverse bind matrix is singular.
    pub fn bind_model_from_joint(&self) -> &[Affine3A] {
        &self.model_from_joint
    }

    /// Each joint at rest relative to its parent, where no clip says otherwise: in the bind pose, unless the file has a pose for
    /// that ([`Skeleton::with_rest`]). Shear, which has no part of its own, is dropped.
    pub fn rest(&self) -> &[LocalJoint] {
        if self.rests_in_bind_pose() {
            &self.bind
        } else {
            &self.rest
        }
    }

    /// Whether the file has no pose for rest but the bind pose.
    pub fn rests_in_bind_pose(&self) -> bool {
        self.rest.is_empty()
    }

    /// Each joint of the bind pose relative to its parent. Shear, which has no part of its own, is dropped.
    pub fn bind(&self) -> &[LocalJoint] {
        &self.bind
    }

    /// The file's bone number of each joint, for display and for outputs in the file's order.
    pub fn file_bones(&self) -> &[u32] {
        &self.file_bones
    }

    /// The joint of each bone of the file: the inverse of [`Skeleton::file_bones`].
    pub fn joint_of_bone(&self) -> &[JointIndex] {
        &self.joint_of_bone
    }
}

/// Where each file bone stands; an error unless the numbers are an order of all joints.
fn inverse_order(file_bones: &[u32]) -> Result<Vec<JointIndex>, Fault> {
    let mut joint_of_bone = vec![None; file_bones.len()];
    for (joint, &bone) in (0u32..).zip(file_bones) {
        match joint_of_bone.get_mut(bone as usize) {
            Some(place @ None) => *place = Some(JointIndex(joint)),
            _ => {
                let message = format!(
                    "File bone {bone} of joint {joint} is out of range or taken; the file bones are an order of all joints."
                );
                return Err(codes::FILE_BONE_NOT_UNIQUE.says(message).into());
            }
        }
    }
    // As many distinct numbers in range as there are places: none is left empty.
    Ok(joint_of_bone.into_iter().flatten().collect())
}

/// The bind pose, relative to the model and relative to each parent. Inverted in f64: offsets of real files are near
/// rigid, but the chain of a long skeleton multiplies what is lost here.
fn bind_pose(parents: &[Option<JointIndex>], joint_from_bind: &[Affine3A]) -> (Vec<Affine3A>, Vec<LocalJoint>) {
    let model_from_joint: Vec<DAffine3> = joint_from_bind
        .iter()
        .map(|joint_from_bind| {
            let inverse = joint_from_bind.as_daffine3().inverse();
            if inverse.as_affine3a().is_finite() {
                inverse
            } else {
                DAffine3::IDENTITY
            }
        })
        .collect();
    let bind = parents
        .iter()
        .zip(&model_from_joint)
        .map(|(parent, &model_from_joint_of_child)| {
            let parent_from_model = match parent {
                Some(parent) => model_from_joint[parent.index()].inverse(),
                None => DAffine3::IDENTITY,
            };
            LocalJoint::from_matrix(&(parent_from_model * model_from_joint_of_child))
        })
        .collect();
    (model_from_joint.iter().map(DAffine3::as_affine3a).collect(), bind)
}
