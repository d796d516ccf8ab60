//! The words for steps that can be undone.

use super::Value;
use crate::diagnostic::collect::counted;
use crate::session::Session;
use crate::session::choose::submeshes::Visibility;
use crate::session::open::clip_swap::ClipSwap;

impl Session {
    /// What was done, in the words of a person. `clips` and `values` lead back to what was before.
    pub(in crate::session) fn label_of_step(&self, clips: Option<&ClipSwap>, values: &[Value]) -> String {
        match (clips.zip(self.open_model()), values) {
            (Some((clips, open)), _) => match clips.deed(open) {
                (verb, 1, name) => format!("{verb} clip {}", brief(name)),
                (verb, count, _) => format!("{verb} {count} clips"),
            },
            (None, [value]) => self.label_of(value),
            (None, values) => {
                let first = values.first().map_or_else(String::new, |value| self.label_of(value));
                let others = values.len().saturating_sub(1);
                format!("{first} and {}", counted(others, "more change", "more changes"))
            }
        }
    }

    fn label_of(&self, value: &Value) -> String {
        match value {
            Value::Material { index, material } => {
                let verb = if self.is_edited(*index) { "edit" } else { "reset" };
                format!("{verb} {}", brief(&material.name))
            }
            Value::Names(names) => match names.first_key_value() {
                Some((&bone, _)) if names.len() == 1 => match self.joint_names().get(bone as u32) {
                    Some(name) => format!("name bone {bone} {}", brief(name)),
                    None => format!("remove the name of bone {bone}"),
                },
                _ => format!("name {} bones", names.len()),
            },
            Value::Visibility(then) => self.label_of_visibility(then),
            Value::Range(_) if self.playback().range_secs().is_none() => "clear the range".to_owned(),
            Value::Range(_) => "set the range".to_owned(),
            Value::WrapMode(_) => format!("loop: {}", self.playback().wrap_mode().label()),
            Value::Handedness(_) => "set the handedness".to_owned(),
            Value::UpAxis(_) => "set the up axis".to_owned(),
            Value::NormalGreenFlipped(_) => "flip green of normal maps".to_owned(),
            Value::Sky(_) => match self.sky_file() {
                Some(file) => format!("use {} as the sky", brief(file.base_name())),
                None => "remove the sky".to_owned(),
            },
        }
    }

    fn label_of_visibility(&self, then: &Visibility) -> String {
        let submeshes = self.submeshes();
        let name = |index: usize| brief(self.submesh_name(index));
        let was_left_out = then.left_out();
        let differ = |&index: &usize| submeshes.left_out().get(index) != was_left_out.get(index);
        let changed: Vec<usize> = (0..submeshes.count()).filter(differ).collect();
        match (submeshes.solo(), &*changed) {
            (Some(solo), _) if then.solo != Some(solo) => format!("show {} alone", name(solo)),
            (_, &[index]) if submeshes.is_visible(index) => format!("show {}", name(index)),
            (_, &[index]) => format!("hide {}", name(index)),
            _ if !submeshes.left_out().contains(&true) => "show all subsets".to_owned(),
            _ => "show other subsets".to_owned(),
        }
    }
}

/// A name, cut where it is too long for a line of a menu.
fn brief(name: &str) -> String {
    const MOST_CHARS: usize = 24;
    if name.chars().count() <= MOST_CHARS {
        return name.to_owned();
    }
    let mut cut: String = name.chars().take(MOST_CHARS - 1).collect();
    cut.push('…');
    cut
}
