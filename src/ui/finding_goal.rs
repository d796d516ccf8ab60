//! Where a click on a finding leads: to the bone, subset, clip or vertex that it is about.

use super::skeleton::SidePage;
use super::state::UiState;
use super::wording::grouped;
use crate::diagnostic::Subject;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, OpenModel, Session, SubsetCommand};

/// A part of the open model, and how it comes on screen.
pub(super) struct Goal {
    /// What it is called: `Bone 3`, `Subset 0`, `Clip walk`.
    pub(super) words: String,
    /// They select and show it.
    commands: Vec<Command>,
    /// The page of the panel on the left that has it, if one does.
    page: Option<SidePage>,
}

impl Goal {
    /// The way to a part of the open model. None for a part that is not there, such as a material that no subset has.
    pub(super) fn of(session: &Session, open: &OpenModel, subject: Subject) -> Option<Self> {
        let mesh = &open.model.mesh;
        match subject {
            Subject::Bone(bone) => {
                let joints = open.model.skeleton.joint_of_bone();
                Some(Self::bone(session, *joints.get(bone as usize)?))
            }
            Subject::Vertex(vertex) => ((vertex as usize) < mesh.vertex_count()).then(|| Self::vertex(vertex)),
            // A triangle cannot be selected; its first corner can.
            Subject::Triangle(triangle) => Some(Self::vertex(*mesh.indices.get(triangle as usize * 3)?)),
            Subject::Subset(subset) => {
                let subset = subset as usize;
                (subset < mesh.submeshes.len()).then(|| Self::subset(session, subset, format!("Subset {subset}")))
            }
            Subject::Material(material) => {
                let has_it = |submesh: &crate::model::Submesh| submesh.material == material;
                let subset = mesh.submeshes.iter().position(has_it)?;
                let name = &open.model.materials.get(material as usize)?.name;
                Some(Self::subset(session, subset, format!("Material {name}")))
            }
            Subject::Clip(clip) => {
                let name = &open.model.clips.get(clip as usize)?.name;
                Some(Self {
                    words: format!("Clip {name}"),
                    // The timeline has it.
                    commands: vec![Command::SelectClip(clip as usize)],
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
                JointCommand::SetBonesVisible(true).into(),
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

    fn subset(session: &Session, subset: usize, words: String) -> Self {
        let mut commands = vec![SubsetCommand::Select(Some(subset)).into()];
        if !session.subsets().is_visible(subset) {
            commands.push(SubsetCommand::SetVisible { subset, visible: true }.into());
        }
        Self {
            words,
            commands,
            page: Some(SidePage::Model),
        }
    }

    /// Goes there. What is selected is framed in the next pass, when its panels stand.
    pub(super) fn go(self, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
        state.frames_selection = self
            .commands
            .iter()
            .any(|command| matches!(command, Command::Joint(_) | Command::Subset(_)));
        if let Some(page) = self.page {
            state.skeleton.show_page(session, page);
        }
        commands.extend(self.commands);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::write;
    use crate::sample::figure;
    use crate::session::File;

    /// No model that can be shown has a finding about a triangle, so no click can lead there yet.
    #[test]
    fn the_way_to_a_triangle_is_that_to_its_first_corner_and_what_is_not_there_has_none() {
        let mut session = Session::new(true);
        session.apply(Command::AddFiles(vec![File::new(
            "figure.m3d",
            write(&figure()).into_bytes(),
        )]));
        let open = session.open_model().expect("the sample opens");
        let corner = open.model.mesh.indices[3 * 7];
        let goal = Goal::of(&session, open, Subject::Triangle(7)).expect("it has triangles");
        let selects: Command = JointCommand::SelectVertex(Some(corner)).into();
        assert!(goal.commands.contains(&selects));
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
