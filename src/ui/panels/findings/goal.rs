//! What a finding is about, and how to go there.

use std::fmt::Write as _;

use crate::diagnostic::{Moment, Subject};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, OpenModel, PlayCommand, Session, SubmeshCommand, named_maps};
use crate::ui::cx::Cx;
use crate::ui::kit::wording::grouped;
use crate::ui::panels::skeleton::state::SidePage;
use crate::ui::state::UiState;

/// A part of the open model, and how to show it.
pub struct Goal {
    /// What it is called: `Bone 3`, `Submesh 0`, `Clip walk`.
    pub(super) words: String,
    commands: Vec<Command>,
    /// The page of the side panel that lists it, if any.
    page: Option<SidePage>,
}

impl Goal {
    /// How to show a subject, and of a clip the moment. None if the model lacks it, or if no submesh has this material.
    pub fn of(session: &Session, open: &OpenModel, subject: Subject, moment: Moment) -> Option<Self> {
        let mesh = &open.model.mesh;
        match subject {
            Subject::Bone(bone) => Some(Self::bone(session, joint_of(open, bone)?)),
            Subject::Vertex(vertex) => ((vertex as usize) < mesh.vertex_count()).then(|| Self::vertex(vertex)),
            Subject::Triangle(triangle) => mesh.triangle(triangle).map(|_| Self {
                words: format!("Triangle {}", grouped(triangle as usize)),
                commands: vec![JointCommand::SelectTriangle(triangle).into()],
                page: None,
            }),
            Subject::Subset(submesh) => {
                let submesh = submesh as usize;
                (submesh < mesh.submeshes.len()).then(|| Self::submesh(session, submesh, format!("Subset {submesh}")))
            }
            Subject::Material(material) => {
                let has_it = |submesh: &crate::model::Submesh| submesh.material == material;
                let submesh = mesh.submeshes.iter().position(has_it)?;
                let name = &open.model.materials.get(material as usize)?.name;
                Some(Self::submesh(session, submesh, format!("Material {name}")))
            }
            Subject::Map(map) => {
                let (material, ..) = named_maps(&open.model.materials).nth(map as usize)?;
                Self::of(session, open, Subject::Material(material as u32), moment)
            }
            Subject::Clip(clip) => {
                let name = &open.model.clips.get(clip as usize)?.name;
                let mut goal = Self {
                    words: format!("Clip {name}"),
                    // The timeline shows it.
                    commands: vec![PlayCommand::SelectClip(clip as usize).into()],
                    page: None,
                };
                if let Some(time_secs) = moment.time_secs {
                    write!(goal.words, " at {time_secs:.2} s").ok()?;
                    goal.commands.push(PlayCommand::Pause.into());
                    goal.commands.push(PlayCommand::Seek { time_secs }.into());
                }
                if let Some(joint) = moment.bone.and_then(|bone| joint_of(open, bone)) {
                    let bone = Self::bone(session, joint);
                    write!(goal.words, ", {}", bone.words).ok()?;
                    goal.commands.extend(bone.commands);
                    goal.page = bone.page;
                }
                Some(goal)
            }
        }
    }

    fn bone(session: &Session, joint: JointIndex) -> Self {
        Self {
            words: session.joint_label(joint),
            commands: vec![
                JointCommand::SelectVertex(None).into(),
                // While bones are hidden it is drawn alone.
                JointCommand::Select(Some(joint)).into(),
            ],
            page: Some(SidePage::Skeleton),
        }
    }

    fn vertex(vertex: u32) -> Self {
        Self {
            words: format!("Vertex {}", grouped(vertex as usize)),
            commands: vec![
                JointCommand::Select(None).into(),
                JointCommand::SelectVertex(Some(vertex)).into(),
            ],
            page: None,
        }
    }

    fn submesh(session: &Session, submesh: usize, words: String) -> Self {
        let mut commands = vec![SubmeshCommand::Select(Some(submesh)).into()];
        if !session.submeshes().is_visible(submesh) {
            commands.push(SubmeshCommand::SetVisible { submesh, visible: true }.into());
        }
        Self {
            words,
            commands,
            page: Some(SidePage::Model),
        }
    }

    /// Goes there. The selection is framed in the next pass, when its panels are open.
    pub(super) fn go(self, cx: &mut Cx<'_, UiState>) {
        cx.state.frames_selection = self
            .commands
            .iter()
            .any(|command| matches!(command, Command::Joint(_) | Command::Submesh(_)));
        if let Some(page) = self.page {
            cx.state.skeleton.show_page(cx.session, page);
        }
        cx.commands.extend(self.commands);
    }
}

/// The joint of a bone of the file.
fn joint_of(open: &OpenModel, bone: u32) -> Option<JointIndex> {
    open.model.skeleton.joint_of_bone().get(bone as usize).copied()
}
