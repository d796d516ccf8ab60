//! Clips of a second file whose bones have names: under which name a clip joins, and what is told where bones lie otherwise.

use bindpose::export::{MapImages, glb};
use bindpose::format::Document;
use bindpose::model::JointNames;
use bindpose::session::{File, FileCommand, Session};

use super::opened;
use crate::documents::{model_of, offset};
use crate::rigs;

const BONES: u32 = 12;

fn document() -> Document {
    rigs::rig(BONES, vec![rigs::even("walk", BONES, 0.0, 5, 4.0)])
}

/// As a `.glb`, whose bones have names, and whose clip has this one: a `.m3d` cannot hold each.
fn named(path: &str, document: &Document, clip: &str) -> File {
    let mut model = model_of(document).0;
    clip.clone_into(&mut model.clips[0].name);
    let mut names = JointNames::default();
    (0..BONES).for_each(|bone| names.set(bone, &format!("Bone of {bone}")));
    let written = glb(&model, &names, &MapImages::default()).expect("it can be written");
    File::new(path, written.bytes)
}

/// A model with one clip, to which those of these files were added.
fn joined(guests: Vec<File>) -> Session {
    let mut session = opened(named("hero.glb", &document(), "Scene"));
    session.apply(FileCommand::AddClips(guests));
    assert_eq!(session.error(), None);
    session
}

fn told(session: &Session) -> Vec<&str> {
    let findings = session.diagnostics().filter(|finding| finding.code == "clips-by-names");
    findings.map(|finding| &*finding.message).collect()
}

#[test]
fn a_clip_joins_under_its_name_or_its_files_where_it_says_nothing() {
    for (clip, joins_as) in [
        ("mixamo.com", "walking"),
        ("Take 001", "walking"),
        ("Scene", "walking"),
        ("Armature|mixamo.com", "walking"),
        ("Armature|Scene", "walking"),
        ("Armature| Take 001 ", "walking"),
        ("Armature|", "walking"),
        ("Run", "Run"),
        ("Take 002", "Take 002"),
        ("Scenery", "Scenery"),
        ("mixamo.com|Run", "mixamo.com|Run"),
    ] {
        let session = joined(vec![named("motions/walking.glb", &document(), clip)]);
        let names: Vec<&str> = session
            .open_model()
            .expect("it is open")
            .clip_list()
            .map(|clip| clip.name)
            .collect();
        assert_eq!(names, ["Scene", joins_as], "{clip:?}: that of the model itself stays");
        assert_eq!(told(&session), [""; 0]);
    }
    // Several of one file, and of two.
    let guests =
        ["walking.glb", "v2.walking.glb", "else/walking.glb"].map(|path| named(path, &document(), "mixamo.com"));
    let session = joined(guests.into());
    let clips = session.open_model().expect("it is open").clip_list();
    let names: Vec<&str> = clips.map(|clip| clip.name).collect();
    assert_eq!(names, ["Scene", "walking", "v2.walking", "walking (2)"]);
}

#[test]
fn where_bones_lie_otherwise_it_is_told_that_the_motion_is_relative_to_the_rest_pose() {
    // Each bone lies beside the one before, not above.
    let mut lying = document();
    for bone_offset in &mut lying.bone_offsets {
        let height = -bone_offset[13];
        *bone_offset = offset([height, 0.0, 0.0]);
    }
    let session = joined(vec![named("lying.glb", &lying, "rest")]);
    assert_eq!(
        told(&session),
        ["The bones of lying.glb lie otherwise, so its motion is kept relative to the rest pose."]
    );
    // Of another size they lie alike.
    let mut large = document();
    for bone_offset in &mut large.bone_offsets {
        bone_offset[13] *= 2.0;
    }
    for (clip, document) in [("same", document()), ("large", large)] {
        assert_eq!(
            told(&joined(vec![named("other.glb", &document, clip)])),
            [""; 0],
            "{clip}"
        );
    }
}
