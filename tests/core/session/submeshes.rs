//! Subsets hidden, shown alone, selected, hovered.

use bindpose::format::{Document, Material, Subset};
use bindpose::scene::ViewPreset;
use bindpose::session::{CameraCommand, FileCommand, Session, SubmeshCommand};
use glam::Vec2;

use super::models::{self, document};
use super::opened;

use SubmeshCommand::{Hover, HoverAt, Select, SelectAt, SetVisible, ShowAll, Solo};

/// Splits a box's document into three subsets with a material each: the sides along x, along y and along z.
pub(super) fn parted(mut document: Document) -> Document {
    let material = document.materials[0].clone();
    let named = |axis: &str| Material {
        name: axis.to_owned(),
        ..material.clone()
    };
    document.materials = ["X", "Y", "Z"].map(named).to_vec();
    let subset = |id: u32| Subset {
        id,
        vertex_start: id * 8,
        vertex_count: 8,
        face_start: id * 4,
        face_count: 4,
    };
    document.subsets = (0..3).map(subset).collect();
    document
}

fn three_parts() -> Session {
    opened(models::file("a.m3d", &parted(document())))
}

fn hide(session: &mut Session, submesh: usize) {
    let visible = false;
    session.apply(SetVisible { submesh, visible });
}

/// What is left out, and which one is alone.
fn left_out_and_solo(session: &mut Session) -> (Vec<bool>, Option<usize>) {
    (left_out(session), session.submeshes().solo())
}

fn left_out(session: &mut Session) -> Vec<bool> {
    session.frame().hidden_submeshes.to_vec()
}

#[test]
fn what_is_hidden_is_left_out_of_the_frame_until_all_is_shown() {
    let mut session = three_parts();
    assert_eq!(
        (session.submeshes().count(), left_out(&mut session)),
        (3, vec![false; 3])
    );
    hide(&mut session, 1);
    assert_eq!(left_out(&mut session), [false, true, false]);
    assert!(!session.submeshes().is_visible(1) && session.submeshes().is_visible(2));
    session.apply(ShowAll);
    assert_eq!(left_out(&mut session), [false; 3]);
}

#[test]
fn one_alone_and_again_brings_back_what_was_hidden_before() {
    let mut session = three_parts();
    hide(&mut session, 0);
    session.apply(Solo(0));
    assert_eq!(left_out(&mut session), [false, true, true], "a hidden one is shown too");
    session.apply(Solo(2));
    assert_eq!(left_out_and_solo(&mut session), (vec![true, true, false], Some(2)));
    session.apply(Solo(2));
    assert_eq!(left_out_and_solo(&mut session), (vec![true, false, false], None));
}

#[test]
fn showing_another_beside_the_one_alone_keeps_the_rest_out() {
    let mut session = three_parts();
    session.apply(Solo(0));
    session.apply(SetVisible {
        submesh: 1,
        visible: true,
    });
    assert_eq!(left_out_and_solo(&mut session), (vec![false, false, true], None));
}

#[test]
fn the_hovered_one_stands_out_unless_it_is_hidden_and_the_selected_one_does_not() {
    let mut session = three_parts();
    session.apply(Select(Some(2)));
    assert_eq!(
        (session.submeshes().selected(), session.frame().highlighted_submesh),
        (Some(2), None)
    );
    session.apply(Hover(Some(1)));
    assert_eq!(session.frame().highlighted_submesh, Some(1));
    hide(&mut session, 1);
    assert_eq!(
        (session.submeshes().hovered(), session.frame().highlighted_submesh),
        (Some(1), None)
    );
    session.apply(Select(None));
    session.apply(Hover(None));
    assert_eq!(
        (session.submeshes().selected(), session.submeshes().hovered()),
        (None, None)
    );
}

#[test]
fn the_pointer_selects_and_hovers_what_is_drawn_under_it() {
    let mut session = three_parts();
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(HoverAt(Some(Vec2::ZERO)));
    assert_eq!(session.submeshes().hovered(), Some(2), "the front");
    session.apply(CameraCommand::LookFrom(ViewPreset::Top));
    session.apply(SelectAt(Vec2::ZERO));
    assert_eq!(session.submeshes().selected(), Some(1), "the top");
    let hit = session.submeshes().selected_at().expect("met there");
    assert!((hit.position.y - 4.0).abs() < 1e-4, "{hit:?}");
    // From above the sides are only seen from within.
    hide(&mut session, 1);
    session.apply(SelectAt(Vec2::ZERO));
    assert_eq!(session.submeshes().selected(), None, "neither top nor bottom");

    session.apply(HoverAt(Some(Vec2::splat(0.999))));
    assert_eq!(session.submeshes().hovered(), None, "beside the model");
    session.apply(HoverAt(None));
    session.apply(SelectAt(Vec2::NAN));
    assert_eq!(
        (session.submeshes().selected(), session.submeshes().hovered()),
        (None, None)
    );
}

#[test]
fn what_the_model_has_not_is_left_alone() {
    let mut session = three_parts();
    let before = session.submeshes().clone();
    for command in [
        SetVisible {
            submesh: 3,
            visible: false,
        },
        Solo(3),
        Select(Some(3)),
        Hover(Some(usize::MAX)),
    ] {
        session.apply(command);
        assert_eq!(session.submeshes(), &before, "{command:?}");
    }
}

#[test]
fn the_picture_is_another_one_exactly_when_what_is_drawn_changed() {
    let mut session = three_parts();
    let mut changes = |command| {
        let before = session.picture_revision();
        session.apply(command);
        session.picture_revision() != before
    };
    let visible = |visible| SetVisible { submesh: 0, visible };
    assert!(changes(visible(false)) && changes(visible(true)) && changes(Solo(1)) && changes(ShowAll));
    assert!(changes(Hover(Some(1))) && changes(Hover(None)));
    assert!(!changes(visible(true)) && !changes(ShowAll) && !changes(Hover(None)) && !changes(Select(Some(1))));
}

#[test]
fn the_same_file_again_keeps_what_was_hidden_and_another_one_shows_all() {
    let mut session = three_parts();
    hide(&mut session, 1);
    session.apply(Select(Some(2)));
    session.apply(FileCommand::Add(vec![models::file("a.m3d", &parted(document()))]));
    assert_eq!(left_out(&mut session), [false, true, false]);
    assert_eq!(session.submeshes().selected(), Some(2));

    session.apply(FileCommand::Add(vec![models::file("b.m3d", &parted(document()))]));
    assert_eq!(
        (left_out(&mut session), session.submeshes().selected()),
        (vec![false; 3], None)
    );

    hide(&mut session, 0);
    session.apply(FileCommand::Add(vec![models::still("b.m3d")]));
    assert_eq!(left_out(&mut session), [false], "another number of subsets");
}
