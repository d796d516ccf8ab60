//! One vertex through the formula of the book's chapter, step by step.

use std::fmt::Write;

use glam::Vec3;

use super::table::{RowMatrix, aligned, number};
use crate::anim::buffers::PoseBuffers;
use crate::model::{JointIndex, Model};

/// How a vertex comes to its place in a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexExplanation {
    /// Index in the mesh, which is the file's.
    pub vertex: u32,
    /// Where bind space has it.
    pub bind_position: Vec3,
    /// The joints that have weight, in the file's order of slots. None: the vertex stays where it is.
    pub influences: Vec<ExplainedInfluence>,
    /// Where it comes, model space: the sum, and what [`skin`](crate::anim::skin()) says too.
    pub position: Vec3,
}

/// What one joint does to a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExplainedInfluence {
    /// Which.
    pub joint: JointIndex,
    /// Its number in the file.
    pub bone: u32,
    /// Its weight, 0…1.
    pub weight: f32,
    /// Bind space -> joint.
    pub offset: RowMatrix,
    /// Joint -> model.
    pub to_root: RowMatrix,
    /// offset · toRoot: bind space -> model.
    pub final_transform: RowMatrix,
    /// Where the joint alone would bring the vertex, model space.
    pub moved: Vec3,
    /// That, times the weight.
    pub weighted: Vec3,
}

/// Explains a vertex of a model in a pose of its skeleton. None for a vertex that is not there.
pub fn explain_vertex(model: &Model, pose: &PoseBuffers, vertex: u32) -> Option<VertexExplanation> {
    let bind_position = *model.mesh.positions.get(vertex as usize)?;
    let skeleton = &model.skeleton;
    let influences = model.mesh.influences.get(vertex as usize).copied();
    let slots = influences
        .into_iter()
        .flat_map(|influences| influences.joints.into_iter().zip(influences.weights));
    let influences: Vec<_> = slots
        .filter(|&(_, weight)| weight > 0.0)
        .filter_map(|(joint, weight)| {
            let index = joint as usize;
            let model_from_bind = *pose.palette.0.get(index)?;
            let moved = model_from_bind.transform_point3(bind_position);
            Some(ExplainedInfluence {
                joint: JointIndex(joint),
                bone: *skeleton.file_bones().get(index)?,
                weight,
                offset: RowMatrix::from(skeleton.joint_from_bind()[index]),
                to_root: RowMatrix::from(*pose.model.0.get(index)?),
                final_transform: RowMatrix::from(model_from_bind),
                moved,
                weighted: moved * weight,
            })
        })
        .collect();
    Some(VertexExplanation {
        vertex,
        bind_position,
        position: if influences.is_empty() {
            bind_position
        } else {
            influences.iter().map(|influence| influence.weighted).sum()
        },
        influences,
    })
}

impl VertexExplanation {
    /// The whole sum as text for the clipboard, in the file's row vectors and with the books' names. `name_of` gives the name
    /// of a joint if a person gave one.
    pub fn to_text<'a>(&self, name_of: impl Fn(JointIndex) -> Option<&'a str>) -> String {
        let mut text = format!(
            "vertex {}: row vectors, matrices row by row as in the file\n\
             v' = sum of weight · (v · finalTransform)    finalTransform = offset · toRoot\n\n",
            self.vertex
        );
        let mut points = vec![self.bind_position, self.position];
        points.extend(
            self.influences
                .iter()
                .flat_map(|influence| [influence.moved, influence.weighted]),
        );
        // One width for all, so that they stand below each other.
        let points = aligned(
            &points
                .iter()
                .map(|point| point.to_array().map(number))
                .collect::<Vec<_>>(),
        );
        // Writing into a String cannot fail.
        let _ = writeln!(text, "v                  = [ {}  1 ]", points[0]);
        for (influence, points) in self.influences.iter().zip(points[2..].chunks(2)) {
            let name = name_of(influence.joint);
            let name = name.map(|name| format!(" \"{name}\"")).unwrap_or_default();
            let _ = writeln!(
                text,
                "\nbone {}{name}, weight {}",
                influence.bone,
                number(influence.weight)
            );
            text.push_str(&influence.product());
            let _ = writeln!(text, "v · finalTransform = [ {}  1 ]", points[0]);
            let _ = writeln!(text, "        · weight   = [ {} ]", points[1]);
        }
        let why = if self.influences.is_empty() {
            "no bone has weight: "
        } else {
            ""
        };
        let _ = writeln!(text, "\n{why}v'                 = [ {}  1 ]", points[1]);
        text
    }
}

impl ExplainedInfluence {
    /// offset · toRoot = finalTransform, side by side.
    fn product(&self) -> String {
        let blocks = [&self.offset, &self.to_root, &self.final_transform].map(RowMatrix::lines);
        let widths = blocks.each_ref().map(|lines| lines[0].len() + 4);
        let mut text = String::new();
        for ((name, width), gap) in ["offset", "toRoot", "finalTransform"]
            .into_iter()
            .zip(widths)
            .zip(["   ", "   ", ""])
        {
            let _ = write!(text, "{name:^width$}{gap}");
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
        let [offset, to_root, final_transform] = &blocks;
        for (row, ((offset, to_root), product)) in offset.iter().zip(to_root).zip(final_transform).enumerate() {
            let (times, equals) = if row == 1 { ("·", "=") } else { (" ", " ") };
            let _ = writeln!(text, "[ {offset} ] {times} [ {to_root} ] {equals} [ {product} ]");
        }
        text
    }
}
