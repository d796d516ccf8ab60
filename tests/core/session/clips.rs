//! What panels show of clips.

use std::borrow::Cow;

use bindpose::anim::{CompiledClip, LoopMode, WrapMode, loop_gap};
use bindpose::format::Document;
use bindpose::model::JointIndex;
use bindpose::session::{MAX_LINK_LEN, PlayCommand, Session};

use super::{models, opened};
use crate::rigs;

#[test]
fn a_row_of_the_list_says_span_keys_rate_and_file() {
    let clips = vec![rigs::even("late", 3, 3.0, 9, 4.0), rigs::single("one", 3)];
    let session = opened(models::file("in/hero.m3d", &rigs::rig(3, clips)));
    let open = session.open_model().expect("open");
    let rows: Vec<_> = open.clip_list().collect();
    let [late, one] = &rows[..] else { panic!("two clips") };
    assert_eq!((late.name, late.file_name), ("late", "hero.m3d"));
    assert_eq!((late.start_secs, late.end_secs, late.keys_per_sec), (3.0, 5.0, 4.0));
    assert_eq!((late.key_count, late.last_frame), (27, 8));
    assert_eq!(
        (one.start_secs, one.end_secs, one.key_count, one.last_frame),
        (1.5, 1.5, 3, 0)
    );
    assert_eq!(
        (open.loop_gap(2), open.activity(2), open.key_times(2, None)),
        (None, None, &[][..])
    );
}

#[test]
fn read_outs_are_found_once_and_lent_from_then_on() {
    let session = opened(models::file("a.m3d", &rigs::rig(300, vec![rigs::ragged("a", 300)])));
    let open = session.open_model().expect("open");
    let same = |a: Option<*const ()>, b: Option<*const ()>| a.is_some() && a == b;
    let gap = || open.loop_gap(0).map(|gap| std::ptr::from_ref(gap).cast());
    let activity = || open.activity(0).map(|joints| joints.as_ptr().cast());
    let all_keys = || Some(session.key_times(None).as_ptr().cast());
    assert!(same(gap(), gap()) && same(activity(), activity()) && same(all_keys(), all_keys()));
    // The keys of a joint are those of its track.
    let track = open.model.clips[0].tracks[1].times_secs();
    assert!(std::ptr::eq(session.key_times(Some(JointIndex(1))), track));
    assert!(std::ptr::eq(open.key_times(0, Some(JointIndex(1))), track));
}

#[test]
fn a_model_has_a_size_with_a_mesh_and_without() {
    let size = |document: &Document| {
        opened(models::file("a.m3d", document))
            .open_model()
            .expect("open")
            .size()
    };
    let quad = rigs::rig(3, vec![]);
    assert!((size(&quad) - 2.0_f32.sqrt()).abs() < 1e-6);
    let bones = Document {
        vertices: vec![],
        triangles: vec![],
        subsets: vec![],
        ..quad.clone()
    };
    assert!((size(&bones) - 1.0).abs() < 1e-6, "three joints half a unit apart");
    let point = Document {
        bone_offsets: bones.bone_offsets[..1].to_vec(),
        bone_parents: vec![-1],
        ..bones
    };
    assert_eq!(size(&point), 1.0);
}

#[test]
fn the_loop_gap_is_that_of_what_loops() {
    let clips = vec![rigs::even("even", 3, -1.0, 9, 4.0), rigs::single("one", 3)];
    let mut session = opened(models::file("a.m3d", &rigs::rig(3, clips)));
    let between = |span_secs| {
        let session = opened(models::file(
            "a.m3d",
            &rigs::rig(3, vec![rigs::even("even", 3, -1.0, 9, 4.0)]),
        ));
        let open = session.open_model().expect("open");
        loop_gap(
            &open.model.skeleton,
            &CompiledClip::new(&open.model.clips[0]),
            span_secs,
            open.size(),
        )
    };
    assert!(matches!(session.loop_gap(), Some(Cow::Borrowed(_))), "found once");
    assert_eq!(session.loop_gap().as_deref(), Some(&between([-1.0, 1.0])));
    session.apply(PlayCommand::SetRangeStart(Some(-0.3)));
    session.apply(PlayCommand::SetRangeEnd(Some(0.6)));
    assert_eq!(session.loop_gap().as_deref(), Some(&between([-0.3, 0.6])));
    // The demo begins again at 0, and backward at the end.
    session.apply(PlayCommand::SetWrapMode(WrapMode::BookDemo));
    assert_eq!(session.playback().loop_gap_secs(), Some([0.0, 0.6]));
    session.apply(PlayCommand::ToggleBackward);
    assert_eq!(session.playback().loop_gap_secs(), Some([-0.3, 0.6]));
    for mode in [LoopMode::Once, LoopMode::PingPong] {
        session.apply(PlayCommand::SetLoopMode(mode));
        assert!(session.loop_gap().is_some(), "{mode:?} does not jump, a loop would");
    }
    session.apply(PlayCommand::SetLoopMode(LoopMode::Loop));
    session.apply(PlayCommand::SelectClip(1));
    assert_eq!(session.loop_gap(), None, "one pose loops nowhere");
}

#[test]
fn the_first_clip_that_moves_is_shown_first_and_a_link_knows_that() {
    for (names, shown) in [(["rest", "walk", "run"], "walk"), (["walk", "rest", "run"], "walk")] {
        let clips = names.map(|name| match name {
            "rest" => rigs::single(name, 12),
            _ => rigs::even(name, 12, 0.0, 9, 4.0),
        });
        let mut session = opened(models::file("hero.m3d", &rigs::rig(12, clips.to_vec())));
        assert_eq!(session.clip().expect("it has clips").name, shown);
        let link = |session: &Session| session.link(Vec::new(), MAX_LINK_LEN).text;
        assert_eq!(link(&session), "");
        let rest = names.iter().position(|name| *name == "rest").expect("it is one");
        session.apply(PlayCommand::SelectClip(rest));
        assert!(link(&session).contains("clip=rest"), "{}", link(&session));
    }
    let still = vec![rigs::single("rest", 12), rigs::single("other", 12)];
    let session = opened(models::file("hero.m3d", &rigs::rig(12, still)));
    assert_eq!(session.clip().expect("it has clips").name, "rest", "none moves");
}
