//! Nothing is drawn while nothing changes.

use bindpose::anim::SkinView;
use bindpose::session::{File, JointCommand, LookCommand, PlayCommand};

use crate::models::{moving, still};
use crate::page::{WIDE, Window, phone, window};
use crate::skeleton::chains;

/// Passes until no other is asked for.
#[track_caller]
fn assert_settles(window: &mut Window) {
    window.harness.run();
    assert!(
        !window.harness.ctx.has_requested_repaint(),
        "{:?}",
        window.harness.ctx.repaint_causes()
    );
}

#[test]
fn a_window_that_nobody_touches_asks_for_no_pass() {
    let files = || {
        vec![
            vec![],
            vec![moving("a.m3d")],
            vec![still("a.m3d")],
            vec![File::new("a.m3d", *b"")],
        ]
    };
    let wide = files().into_iter().map(|files| window(WIDE, files));
    for mut window in wide.chain(files().into_iter().map(phone)) {
        assert_settles(&mut window);
        let picture = window.session().picture_revision();
        window.wait(0.2);
        assert_settles(&mut window);
        assert_eq!(window.session().picture_revision(), picture);
    }
}

#[test]
fn a_playing_window_asks_for_the_next_pass_and_a_paused_one_stops() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(PlayCommand::Play);
    window.wait(0.2);
    assert!(window.harness.ctx.has_requested_repaint());
    window.apply(PlayCommand::Pause);
    assert_settles(&mut window);
}

#[test]
fn a_clip_of_no_length_asks_for_no_pass() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(PlayCommand::SelectClip(2));
    window.apply(PlayCommand::Play);
    assert_settles(&mut window);
}

#[test]
fn what_was_touched_settles() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for label in [
        "Findings",
        "Help (?)",
        "At the end: loops",
        "Lines over the model",
        "Vertex normals",
        "Lighting",
        "Split",
        "Frame the model",
        "Painted, 12",
        "Last frame",
        "Dope sheet and curves",
        "Bone 1, ",
        "Sheet: Curves",
        "Time 1.000 / 1.000 s",
    ] {
        window.click(label);
        assert_settles(&mut window);
    }
}

#[test]
fn an_explained_vertex_and_a_pointer_that_rests_on_its_bones_settle() {
    for mut window in [window(WIDE, chains(5)), phone(chains(5))] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
        window.apply(JointCommand::SelectVertex(Some(4)));
        for row in ["Bone 1: weight", "Unfold the matrices of Bone 0"] {
            if row.starts_with("Unfold") {
                window.click("Explain this vertex");
            }
            let at = window.rect(row).center();
            window.harness.hover_at(at);
            assert_settles(&mut window);
        }
    }
}
