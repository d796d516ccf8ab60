//! What can be wished about joints.

use glam::Vec2;

use crate::anim::SkinView;
use crate::model::{JointIndex, SavedNames};
use crate::scene::BoneStyle;

/// A wish about joints. One that the model has not is left out.
#[derive(Clone, Debug, PartialEq)]
pub enum JointCommand {
    /// Selects one, and unfolds what it hangs from, or none.
    Select(Option<JointIndex>),
    /// Selects the bone that is drawn at a point of the picture: x right, y up, −1…1. Beside all bones none.
    SelectAt(Vec2),
    /// Selects the parent of the selected one, if it has one.
    SelectParent,
    /// Selects the first child of the selected one, if it has one; the first root when none is selected.
    SelectChild,
    /// Lets one stand out, or none.
    Hover(Option<JointIndex>),
    /// Lets the bone that is drawn at a point of the picture stand out: x right, y up, −1…1.
    HoverAt(Option<Vec2>),
    /// Selects the vertex nearest to what is drawn of the skin at a point of the picture: x right, y up, −1…1. Beside the skin
    /// none.
    SelectVertexAt(Vec2),
    /// Selects a vertex by its number, or none.
    SelectVertex(Option<u32>),
    /// Folds or unfolds a branch of the tree.
    SetFolded {
        /// Its topmost joint.
        joint: JointIndex,
        /// Whether what hangs from it is left out.
        folded: bool,
    },
    /// Folds or unfolds all branches.
    SetAllFolded(bool),
    /// Names a joint; an empty name takes it away.
    Rename {
        /// Which.
        joint: JointIndex,
        /// What it is called.
        name: String,
    },
    /// Takes the names of [`Session::proposed_names`](crate::session::Session::proposed_names).
    AcceptMirrorNames,
    /// Takes names that were kept, if they belong to a hierarchy like this one. They replace those that are there.
    ImportNames(SavedNames),
    /// Takes all names away.
    ClearNames,
    /// Draws bones in a style.
    SetBoneStyle(BoneStyle),
    /// Shows or hides bones.
    SetBonesVisible(bool),
    /// Shows or hides names at the joints. Names stand only where bones are drawn: showing them shows the bones too.
    SetLabelsVisible(bool),
    /// Shows a number of the skin as colours, or the skin as it is.
    SetSkinView(Option<SkinView>),
    /// Draws the way of a joint through the clip, or leaves it, in turn.
    ToggleTrail(JointIndex),
    /// Leaves all ways.
    ClearTrails,
}
