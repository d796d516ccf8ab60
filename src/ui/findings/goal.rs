//! What a finding is about, and how to go there.

use crate::diagnostic::Subject;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, LookCommand, OpenModel, PlayCommand, Session, SubmeshCommand, named_maps};
use crate::ui::skeleton::state::SidePage;
use crate::ui::state::UiState;
use crate::ui::wording::grouped;

/// A part of the open model, and how to show it.
pub(super) struct Goal {
    /// What it is called: `Bone 3`, `Submesh 0`, `Clip walk`.
    pub(super) words: String,
    /// Select and show it.
    commands: Vec<Command>,
    /// The page of the side panel that lists it, if any.
    page: Option<SidePage>,
}

impl Goal {
    /// How to show a subject. None if the model lacks it, or if no submesh has this material.
    pub(super) fn of(session: &Session, open: &OpenModel, subject: Subject) -> Option<Self> {
        let mesh = &open.model.mesh;
        match subject {
            Subject::Bone(bone) => {
                let joints = open.model.skeleton.joint_of_bone();
                Some(Self::bone(session, *joints.get(bone as usize)?))
            }
            Subject::Vertex(vertex) => ((vertex as usize) < mesh.vertex_count()).then(|| Self::vertex(vertex)),
            // A triangle cannot be selected; its first corner can.
            Subject::Triangle(triangle) => Some(Self {
                words: format!("Triangle {}", grouped(triangle as usize)),
                ..Self::vertex(*mesh.indices.get(triangle as usize * 3)?)
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
                Self::of(session, open, Subject::Material(material as u32))
            }
            Subject::Clip(clip) => {
                let name = &open.model.clips.get(clip as usize)?.name;
                Some(Self {
                    words: format!("Clip {name}"),
                    // The timeline shows it.
                    commands: vec![PlayCommand::SelectClip(clip as usize).into()],
                    page: None,
                })
            }
        }
    }

    fn bone(session: &Session, joint: JointIndex) -> Self {
        Self {
            words: session.joint_label(joint),
            commands: vec![
                JointCommand::SelectVertex(None).into(),
                JointCommand::Select(Some(joint)).into(),
                LookCommand::SetBonesVisible(true).into(),
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
    pub(super) fn go(self, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
        state.frames_selection = self
            .commands
            .iter()
            .any(|command| matches!(command, Command::Joint(_) | Command::Submesh(_)));
        if let Some(page) = self.page {
            state.skeleton.show_page(session, page);
        }
        commands.extend(self.commands);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::{File, FileCommand};

    #[test]
    fn what_is_not_there_has_no_goal() {
        let mut session = Session::new(true);
        session.apply(FileCommand::Add(vec![File::new(
            "figure.m3d",
            include_bytes!("../../../web/sample/figure.m3d").to_vec(),
        )]));
        let open = session.open_model().expect("the sample opens");
        let beyond = [
            Subject::Material(9_999_999),
            Subject::Subset(9_999_999),
            Subject::Vertex(9_999_999),
            Subject::Triangle(u32::MAX),
            Subject::Bone(9_999_999),
            Subject::Clip(9_999_999),
        ];
        assert!(
            beyond
                .into_iter()
                .all(|subject| Goal::of(&session, open, subject).is_none())
        );
    }
}
