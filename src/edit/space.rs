//! Size, handedness, up axis and front: geometry, skeleton, keys and curves are turned together, so that the picture in the world is the
//! same, or larger.
//!
//! The order of a triangle's corners stays, since what is mirrored winds the other way round by itself. Only where the triangles wind as
//! in the other hand, as those of glTF do, they are turned round: in a `.m3d` the winding is all that tells the hand.

use glam::{Affine3A, Mat3, Mat3A, Quat, Vec3, Vec3A};

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::diagnostic::Fault;
use crate::model::{Front, Handedness, JointIndex, LocalJoint, Model, Skeleton, UpAxis, world_from_model};

/// The space to come out with; `None` leaves what is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    pub(super) handedness: Option<Handedness>,
    pub(super) up_axis: Option<UpAxis>,
    pub(super) front: Option<Front>,
}

/// Turns a model into another space. The world sees the same.
pub(super) fn turn(edited: &mut Edited, to: Space) {
    let model = &edited.model;
    let (handedness, up_axis, front) = (model.handedness, model.up_axis, model.front);
    let Space {
        handedness: handedness_asked,
        up_axis: to_up_axis,
        front: to_front,
    } = to;
    let (to_handedness, to_up_axis) = (handedness_asked.unwrap_or(handedness), to_up_axis.unwrap_or(up_axis));
    let to_front = to_front.unwrap_or(front);
    let world_from_new = world_from_model(to_handedness, to_up_axis, to_front);
    // Axes are exchanged and turned round, no more: the inverse is exact.
    let new_from_old = world_from_new.matrix3.transpose() * world_from_model(handedness, up_axis, front).matrix3;
    if new_from_old != Mat3A::IDENTITY {
        let exact = Map::new(new_from_old, 1.0).model(&mut edited.model);
        debug_assert!(exact.is_ok(), "numbers change their sign and their place");
    }
    let model = &mut edited.model;
    (model.handedness, model.up_axis, model.front) = (to_handedness, to_up_axis, to_front);
    let turned_round = handedness_asked.is_some() && winds_against(model);
    if turned_round {
        model.mesh.turn_triangles();
    }
    let mut change = |is_one: bool, code, message: String| {
        if is_one {
            edited.changes.push(Change::new(code, message));
        }
    };
    change(
        to_up_axis != up_axis,
        "up-axis-changed",
        format!("{} is up, not {}.", to_up_axis.name(), up_axis.name()),
    );
    change(
        to_handedness != handedness,
        "handedness-changed",
        format!(
            "It is {}-handed, not {}-handed.",
            to_handedness.name(),
            handedness.name()
        ),
    );
    change(
        turned_round,
        "winding-changed",
        "Triangles wind the other way round, as the hand asks for.".to_owned(),
    );
    change(
        to_front != front,
        "front-changed",
        "It is turned round, to face where the format's characters do.".to_owned(),
    );
}

/// Whether most triangles wind as in the other hand: where fronts are clockwise, normals point to the side that the corners go round by
/// the left hand.
fn winds_against(model: &Model) -> bool {
    let sides = model.mesh.indices.as_chunks().0.iter();
    let sides = sides.map(|corners| model.mesh.side_by_normals(*corners) * model.handedness.front_sign());
    let fronts: i64 = sides.map(|side| i64::from(side > 0.0) - i64::from(side < 0.0)).sum();
    fronts < 0
}

pub(super) fn scale(edited: &mut Edited, factor: f32) -> Result<(), EditError> {
    if !(factor.is_finite() && factor > 0.0) {
        return Err(EditError::Refused(format!("The factor of a scale cannot be {factor}.")));
    }
    if factor == 1.0 {
        return Ok(());
    }
    Map::new(Mat3A::IDENTITY, factor).model(&mut edited.model)?;
    edited.changes.push(Change::new(
        "scaled",
        format!("All lengths are multiplied by {factor}."),
    ));
    Ok(())
}

/// From a space into another: axes are exchanged and turned round, then all lengths are multiplied.
struct Map {
    axes: Mat3A,
    factor: f32,
    /// 1, or −1 where it mirrors.
    sign: f32,
}

impl Map {
    fn new(axes: Mat3A, factor: f32) -> Self {
        Self {
            axes,
            factor,
            sign: axes.determinant(),
        }
    }

    fn model(&self, model: &mut Model) -> Result<(), EditError> {
        let mesh = &mut model.mesh;
        for position in &mut mesh.positions {
            *position = self.point(*position);
        }
        for normal in &mut mesh.normals {
            *normal = self.direction(*normal);
        }
        for tangent in &mut mesh.tangents {
            // A mirror turns the cross product of normal and tangent round.
            *tangent = self.direction(tangent.truncate()).extend(tangent.w * self.sign);
        }
        mesh.check()?;
        model.skeleton = self.skeleton(&model.skeleton)?;
        for clip in &mut model.clips {
            let tracks = clip.tracks.iter().map(|track| {
                track.mapped(
                    |value| self.point(value),
                    |value| self.rotation(value),
                    |value| self.scale(value),
                )
            });
            *clip = with_tracks(clip, tracks.collect::<Result<_, Fault>>()?);
        }
        Ok(())
    }

    fn skeleton(&self, skeleton: &Skeleton) -> Result<Skeleton, EditError> {
        let joint_from_bind = skeleton.joint_from_bind().iter().map(|matrix| self.matrix(matrix));
        let rest: Vec<LocalJoint> = skeleton.rest().iter().map(|joint| self.joint(joint)).collect();
        if let Some(joint) = rest.iter().position(|joint| !joint.is_finite()) {
            let bone = skeleton.file_bones()[joint];
            return Err(EditError::Overflows(format!("Bone {bone} is too far away at rest.")));
        }
        let turned = Skeleton::new(
            skeleton.parents().to_vec(),
            joint_from_bind.collect(),
            skeleton.file_bones().to_vec(),
        )?;
        Ok(rested(turned, skeleton, &rest).with_names(names_of(skeleton).collect()))
    }

    /// A matrix of the old space, there and back.
    fn matrix(&self, matrix: &Affine3A) -> Affine3A {
        Affine3A {
            matrix3: self.axes * matrix.matrix3 * self.axes.transpose(),
            translation: self.axes * matrix.translation * self.factor,
        }
    }

    fn joint(&self, joint: &LocalJoint) -> LocalJoint {
        LocalJoint {
            rotation: self.rotation(joint.rotation),
            translation: self.point(joint.translation),
            scale: self.scale(joint.scale),
        }
    }

    fn point(&self, point: Vec3) -> Vec3 {
        self.direction(point) * self.factor
    }

    fn direction(&self, direction: Vec3) -> Vec3 {
        (self.axes * Vec3A::from(direction)).into()
    }

    /// The axis of a turn is no direction: a mirror turns it round once more.
    fn rotation(&self, value: Quat) -> Quat {
        Quat::from_vec4((self.direction(value.xyz()) * self.sign).extend(value.w))
    }

    /// Factors along axes change their places, not their signs.
    fn scale(&self, scale: Vec3) -> Vec3 {
        Mat3::from_cols(
            self.axes.x_axis.abs().into(),
            self.axes.y_axis.abs().into(),
            self.axes.z_axis.abs().into(),
        ) * scale
    }
}

/// A skeleton made of an old one, at rest here, unless the old one rests in its bind pose.
pub(super) fn rested(new: Skeleton, old: &Skeleton, rest: &[LocalJoint]) -> Skeleton {
    if old.rests_in_bind_pose() {
        new
    } else {
        new.with_rest(rest)
    }
}

/// The file's names of all joints; an empty one stands for none.
pub(super) fn names_of(skeleton: &Skeleton) -> impl Iterator<Item = String> {
    let joints = (0..skeleton.joint_count() as u32).map(JointIndex);
    joints.map(|joint| skeleton.name(joint).unwrap_or_default().to_owned())
}
