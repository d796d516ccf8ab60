//! What a finding is about, and how to go there.

use std::fmt::Write as _;

use crate::diagnostic::{Moment, Subject};
use crate::model::Submesh;
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
        let (model, mesh) = (&open.model, &open.model.mesh);
        let goal = |words, page, commands| Some(Self { words, commands, page });
        match subject {
            Subject::Bone(bone) => {
                let joint = *model.skeleton.joint_of_bone().get(bone as usize)?;
                let select = JointCommand::Select(Some(joint)).into();
                let commands = vec![JointCommand::SelectVertex(None).into(), select];
                goal(session.joint_label(joint), Some(SidePage::Skeleton), commands)
            }
            Subject::Vertex(vertex) if (vertex as usize) < mesh.vertex_count() => {
                let select = JointCommand::SelectVertex(Some(vertex)).into();
                let commands = vec![JointCommand::Select(None).into(), select];
                goal(format!("Vertex {}", grouped(vertex as usize)), None, commands)
            }
            Subject::Vertex(_) => None,
            Subject::Triangle(triangle) => {
                mesh.triangle(triangle)?;
                let commands = vec![JointCommand::SelectTriangle(triangle).into()];
                goal(format!("Triangle {}", grouped(triangle as usize)), None, commands)
            }
            Subject::Subset(submesh) => {
                mesh.submeshes.get(submesh as usize)?;
                Some(Self::submesh(session, submesh as usize, format!("Subset {submesh}")))
            }
            Subject::Material(material) => {
                let has_it = |submesh: &Submesh| submesh.material == material;
                let submesh = mesh.submeshes.iter().position(has_it)?;
                let name = &model.materials.get(material as usize)?.name;
                Some(Self::submesh(session, submesh, format!("Material {name}")))
            }
            Subject::Map(map) => {
                let (material, ..) = named_maps(&model.materials).nth(map as usize)?;
                Self::of(session, open, Subject::Material(material as u32), moment)
            }
            Subject::Clip(clip) => {
                let name = &model.clips.get(clip as usize)?.name;
                // The timeline shows it.
                let commands = vec![PlayCommand::SelectClip(clip as usize).into()];
                let mut goal = goal(format!("Clip {name}"), None, commands)?;
                if let Some(time_secs) = moment.time_secs {
                    write!(goal.words, " at {time_secs:.2} s").ok()?;
                    goal.commands.push(PlayCommand::Pause.into());
                    goal.commands.push(PlayCommand::Seek { time_secs }.into());
                }
                let bone = moment.bone.map(Subject::Bone);
                if let Some(bone) = bone.and_then(|bone| Self::of(session, open, bone, moment)) {
                    write!(goal.words, ", {}", bone.words).ok()?;
                    goal.commands.extend(bone.commands);
                    goal.page = bone.page;
                }
                Some(goal)
            }
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
