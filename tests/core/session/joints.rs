//! Joints and vertices selected, hovered, named; the skeleton and the skin as they are shown.

use std::collections::BTreeMap;

use bindpose::anim::{SkinView, dominant_joint, skin_positions};
use bindpose::model::{JointIndex, SavedNames};
use bindpose::scene::{BoneStyle, OverlayGeometry, ViewPreset, colors_of_values, legend};
use bindpose::session::{
    CameraCommand, Command, File, FileCommand, JointCommand, JointRow, LookCommand, NameCommand, PlayCommand, Session,
    SubmeshCommand,
};
use glam::{Affine3A, Vec2, Vec3};

use super::models::{self, jointed, moving, still};
use super::{on_screen, opened, viewport, zoom};
use crate::chains::mirrored;
use crate::documents::soldier_bytes;

use JointCommand::{
    Hover, HoverAt, Select, SelectAt, SelectChild, SelectParent, SelectVertex, SetAllFolded, SetFolded,
};
use LookCommand::{ClearTrails, SetBoneStyle, SetBonesVisible, SetLabelsVisible, SetSkinView, ToggleTrail};

fn chains(count: usize) -> Session {
    opened(models::file("chains.m3d", &mirrored(count)))
}

fn rename(session: &mut Session, joint: u32, name: &str) {
    session.apply(NameCommand::Rename {
        joint: JointIndex(joint),
        name: name.to_owned(),
    });
}

fn rows(session: &Session, query: &str) -> Vec<JointRow> {
    let mut rows = Vec::new();
    session.joint_rows(query, &mut rows);
    rows
}

fn bones(rows: &[JointRow]) -> Vec<u32> {
    rows.iter().map(|row| row.bone).collect()
}

/// What is drawn over the model.
pub(super) fn seen_through(session: &mut Session) -> OverlayGeometry {
    session.frame().seen_through.cloned().unwrap_or_default()
}

/// A colour for each vertex; none while the skin is shown as it is.
pub(super) fn skin_colors(session: &mut Session) -> Vec<[u8; 4]> {
    let colors = session.frame().vertex_colors;
    colors.map(|colors| colors.colors_srgb.to_vec()).unwrap_or_default()
}

#[test]
fn a_bone_is_selected_and_hovered_where_it_is_drawn() {
    let mut session = opened(moving("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(PlayCommand::Seek { time_secs: 0.0 });
    let points: Vec<Vec3> = session
        .bones()
        .bones()
        .iter()
        .map(|bone| bone.from.midpoint(bone.to))
        .collect();
    for (index, point) in (0..).zip(points) {
        let pointer = on_screen(&mut session, point);
        session.apply(SelectAt(pointer));
        session.apply(HoverAt(Some(pointer)));
        let expected = Some(JointIndex(index));
        assert_eq!(
            (session.joints().selected(), session.joints().hovered()),
            (expected, expected)
        );
    }
    for nowhere in [Vec2::splat(0.99), Vec2::NAN] {
        session.apply(Select(Some(JointIndex(0))));
        session.apply(SelectAt(nowhere));
        assert_eq!(session.joints().selected(), None);
    }
    session.apply(HoverAt(None));
    assert_eq!(session.joints().hovered(), None);
}

#[test]
fn up_and_down_the_chain() {
    let mut session = chains(9);
    let mut after = |command| {
        session.apply(command);
        session.joints().selected().map(|joint| joint.0)
    };
    assert_eq!(after(SelectParent), None);
    assert_eq!(after(SelectChild), Some(0));
    assert_eq!(after(SelectParent), Some(0), "a root has no parent");
    assert_eq!(after(SelectChild), Some(1));
    assert_eq!(after(SelectChild), Some(3));
    assert_eq!(after(Select(Some(JointIndex(7)))), Some(7));
    assert_eq!(after(SelectChild), Some(7), "a leaf has no child");
    assert_eq!(after(SelectParent), Some(5));
    assert_eq!(after(Select(None)), None);
}

#[test]
fn the_picture_is_another_one_exactly_when_what_stands_out_or_is_shown_changed() {
    let mut session = chains(5);
    session.apply(PlayCommand::Pause);
    let mut changes = |command: Command| {
        let before = session.picture_revision();
        session.apply(command);
        session.picture_revision() != before
    };
    let (first, none) = (Some(JointIndex(1)), None);
    let named = NameCommand::Rename {
        joint: JointIndex(1),
        name: "arm".to_owned(),
    };
    // Each changes the picture, and once more changes nothing.
    for command in [
        Command::from(Hover(first)),
        Hover(none).into(),
        Select(first).into(),
        SelectParent.into(),
        SelectVertex(Some(2)).into(),
        SetBonesVisible(true).into(),
        SetBoneStyle(BoneStyle::Axes).into(),
        SetLabelsVisible(true).into(),
        SetSkinView(Some(SkinView::Stretch)).into(),
        named.into(),
        NameCommand::Clear.into(),
    ] {
        assert!(changes(command.clone()), "{command:?}");
        assert!(!changes(command.clone()), "{command:?} once more");
    }
    assert!(changes(ToggleTrail(JointIndex(1)).into()) && changes(ClearTrails.into()) && !changes(ClearTrails.into()));
    assert!(!changes(SetAllFolded(true).into()), "the tree is beside the picture");
}

#[test]
fn what_the_model_has_not_is_left_alone() {
    for mut session in [opened(moving("a.m3d")), opened(still("a.m3d")), Session::new(false)] {
        let state = |session: &Session| {
            let (joints, look, names) = (session.joints(), session.look(), session.joint_names());
            (joints.clone(), look.clone(), names.clone())
        };
        let before = state(&session);
        let none = JointIndex(u32::MAX);
        for command in [
            Command::from(Select(Some(none))),
            Hover(Some(none)).into(),
            SelectVertex(Some(u32::MAX)).into(),
            Command::Joint(SetFolded {
                joint: none,
                folded: true,
            }),
            Command::Name(NameCommand::Rename {
                joint: none,
                name: "x".to_owned(),
            }),
            ToggleTrail(none).into(),
            Command::Name(NameCommand::Import(SavedNames {
                fingerprint: 1,
                names: BTreeMap::from([(0, "x".to_owned())]),
            })),
        ] {
            session.apply(command.clone());
            assert_eq!(state(&session), before, "{command:?}");
        }
        assert_eq!(session.inspect_joint(none), None);
        assert_eq!(session.explain_vertex(), None);
    }
}

#[test]
fn a_clicked_vertex_stays_the_same_while_time_goes_on_and_is_explained_where_it_is() {
    let mut session = opened(moving("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(PlayCommand::Seek { time_secs: 0.0 });
    session.apply(SetSkinView(Some(SkinView::Weight)));
    session.apply(SelectAt(Vec2::new(0.02, 0.05)));
    let selected = *session.joints().selected_vertex().expect("the front is there");
    assert_eq!(selected.hit.map(|hit| hit.vertex), Some(selected.vertex));
    let mut places = Vec::new();
    for time_secs in [0.0, 0.3, 0.9] {
        session.apply(PlayCommand::Seek { time_secs });
        assert_eq!(session.joints().selected_vertex(), Some(&selected), "the same vertex");
        let explained = session.explain_vertex().expect("selected");
        let palette = session.frame().palette.clone();
        let mut positions = Vec::new();
        skin_positions(
            &session.open_model().expect("open").model.mesh,
            &palette,
            &mut positions,
        );
        assert!(explained.position.distance(positions[selected.vertex as usize]) < 1e-5);
        places.push(explained.position);
    }
    assert_ne!(places[0], places[1], "in another pose");
    rename(&mut session, 1, "upper");
    let text = session
        .explain_vertex()
        .expect("selected")
        .to_text(|joint| session.joint_name(joint));
    assert!(text.contains("bone 1 \"upper\", weight"), "{text}");
    session.apply(SelectAt(Vec2::splat(0.999)));
    assert_eq!(session.joints().selected_vertex(), None, "beside the skin");
}

#[test]
fn rows_fold_and_a_selection_unfolds_what_it_hangs_from() {
    let mut session = chains(5);
    let all = [0, 1, 3, 2, 4];
    assert_eq!(bones(&rows(&session, "")), all);
    session.apply(SetFolded {
        joint: JointIndex(1),
        folded: true,
    });
    assert_eq!(bones(&rows(&session, " ")), [0, 1, 2, 4]);
    assert!(rows(&session, "")[1].folded && rows(&session, "")[1].has_children);
    session.apply(SetAllFolded(true));
    let row = rows(&session, "");
    assert_eq!((bones(&row), row[0].branch_vertices), (vec![0], 15));
    session.apply(Select(Some(JointIndex(3))));
    assert_eq!(bones(&rows(&session, "")), [0, 1, 3, 2], "bone 2 stays folded");
    session.apply(SetAllFolded(false));
    let row = rows(&session, "");
    assert_eq!(bones(&row), all);
    assert!(row.iter().all(|row| !row.folded && !row.found));
    let depths: Vec<_> = row.iter().map(|row| row.depth).collect();
    assert_eq!(depths, [0, 1, 2, 1, 2]);
    // Each bone's three vertices are its own and its parent's.
    assert_eq!(
        (row[2].own_vertices, row[1].own_vertices, row[1].branch_vertices),
        (3, 6, 6)
    );
}

#[test]
fn a_search_finds_numbers_and_names_with_what_they_hang_from_even_when_folded() {
    let mut session = chains(41);
    rename(&mut session, 3, "Left Elbow");
    rename(&mut session, 12, "Toe 7");
    session.apply(SetAllFolded(true));
    for query in ["3", "#3", "bone 3", " BONE 3 ", "elbow", "LEFT e"] {
        let rows = rows(&session, query);
        assert_eq!(bones(&rows), [0, 1, 3], "{query}");
        let found: Vec<_> = rows.iter().map(|row| row.found).collect();
        assert_eq!(found, [false, false, true]);
    }
    let seven = rows(&session, "7");
    let found: Vec<_> = seven.iter().filter(|row| row.found).map(|row| row.bone).collect();
    assert_eq!(found, [7, 12], "a number and a name");
    assert!(rows(&session, "nobody").is_empty() && rows(&session, "41").is_empty());
    assert!(rows(&Session::new(false), "").is_empty());
}

#[test]
fn names_are_given_shown_proposed_for_the_other_side_and_accepted() {
    let mut session = chains(5);
    assert_eq!(session.joint_label(JointIndex(3)), "Bone 3");
    assert!(session.proposed_names().is_empty());
    let revision = session.joint_names_revision();
    rename(&mut session, 3, "L hand");
    assert_eq!(session.joint_label(JointIndex(3)), "L hand");
    assert!(session.joint_names_revision() > revision);
    let expected = BTreeMap::from([(4, "R hand".to_owned())]);
    assert_eq!(session.proposed_names(), expected);
    session.apply(NameCommand::AcceptMirrored);
    assert_eq!(session.joint_names().get(4), Some("R hand"));
    assert!(session.proposed_names().is_empty());

    let saved = session.saved_joint_names().expect("a model is open");
    session.apply(NameCommand::Clear);
    assert!(session.joint_names().is_empty());
    session.apply(NameCommand::Import(saved.clone()));
    assert_eq!(session.saved_joint_names(), Some(saved.clone()));

    let mut other = chains(7);
    other.apply(NameCommand::Import(saved));
    assert!(other.joint_names().is_empty(), "another hierarchy");
    assert_eq!(Session::new(false).saved_joint_names(), None);
}

#[test]
fn the_same_file_again_keeps_names_and_choices_and_another_one_does_not() {
    let mut session = chains(5);
    rename(&mut session, 1, "arm");
    for command in [
        Command::from(Select(Some(JointIndex(3)))),
        SelectVertex(Some(1)).into(),
        ToggleTrail(JointIndex(2)).into(),
        Command::Joint(SetFolded {
            joint: JointIndex(2),
            folded: true,
        }),
        SetBonesVisible(true).into(),
        SetSkinView(Some(SkinView::Weight)).into(),
    ] {
        session.apply(command);
    }
    session.apply(PlayCommand::SetBindWeight(0.5));
    let again = |session: &mut Session, path: &str, count| {
        session.apply(FileCommand::Add(vec![models::file(path, &mirrored(count))]));
    };
    again(&mut session, "chains.m3d", 5);
    assert_eq!(session.joint_names().get(1), Some("arm"));
    assert_eq!(
        (session.joints().selected(), &session.look().trails[..]),
        (Some(JointIndex(3)), &[JointIndex(2)][..])
    );
    assert!(session.joints().is_folded(JointIndex(2)));
    let vertex = session.joints().selected_vertex().map(|selected| selected.vertex);
    assert_eq!(vertex, Some(1), "of a mesh of the same size");
    assert_eq!(session.bind_weight(), 0.5);

    again(&mut session, "chains.m3d", 7);
    assert_eq!(session.joints().selected_vertex(), None, "of another mesh");
    assert!(session.joint_names().is_empty(), "another hierarchy");
    assert_eq!((session.joints().count(), session.joints().selected()), (7, None));

    rename(&mut session, 1, "arm");
    again(&mut session, "other.m3d", 7);
    assert!(session.joint_names().is_empty() && session.look().trails.is_empty());
    assert_eq!(session.bind_weight(), 0.0);
    assert!(session.look().bones_visible, "how it is shown stays");
    assert_eq!(session.look().skin_view, Some(SkinView::Weight));
}

#[test]
fn the_bind_weight_goes_from_the_clip_to_the_bind_pose_and_back() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    session.apply(PlayCommand::Seek { time_secs: 0.3 });
    let animated = session.frame().palette.0.clone();
    let revision = session.picture_revision();
    session.apply(PlayCommand::SetBindWeight(0.25));
    assert!(session.picture_revision() > revision);
    assert_ne!(session.frame().palette.0, animated);
    session.apply(PlayCommand::SetBindWeight(f32::NAN));
    assert_eq!(session.bind_weight(), 0.25);
    session.apply(PlayCommand::ToggleBindPose);
    assert_eq!(session.bind_weight(), 1.0);
    assert_eq!(session.frame().palette.0, [Affine3A::IDENTITY; 2]);
    let hit = session.pick(Vec2::ZERO).expect("the model is in the middle");
    session.apply(PlayCommand::ToggleBindPose);
    assert_eq!(session.frame().palette.0, animated);
    assert_ne!(session.pick(Vec2::ZERO), Some(hit), "what is picked is what is seen");
    session.apply(PlayCommand::SetBindWeight(7.0));
    assert_eq!(session.bind_weight(), 1.0);
}

#[test]
fn bones_follow_the_pose_the_handedness_and_what_is_shown() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Seek { time_secs: 0.0 });
    assert_eq!(seen_through(&mut session), OverlayGeometry::default(), "hidden");
    session.apply(SetBonesVisible(true));
    let mut drawn = Vec::new();
    for command in [
        Command::from(SetBoneStyle(BoneStyle::Lines)),
        SetBoneStyle(BoneStyle::Axes).into(),
        PlayCommand::Seek { time_secs: 0.3 }.into(),
        Select(Some(JointIndex(1))).into(),
        Hover(Some(JointIndex(0))).into(),
        Command::SetHandedness(Some(bindpose::model::Handedness::Right)),
        Command::SetUpAxis(Some(bindpose::model::UpAxis::Z)),
        Command::SetTheme(bindpose::scene::Theme::Light),
        FileCommand::Add(vec![jointed("b.m3d")]).into(),
        FileCommand::Add(vec![still("c.m3d")]).into(),
    ] {
        session.apply(command.clone());
        let out = seen_through(&mut session);
        assert!(!drawn.contains(&out), "{command:?} is seen");
        drawn.push(out);
    }
    assert_eq!(drawn.last(), Some(&OverlayGeometry::default()), "no bones");
}

#[test]
fn hidden_bones_leave_the_selected_and_the_hovered_one_unless_the_skin_has_colours() {
    let mut session = opened(moving("a.m3d"));
    session.apply(SetBoneStyle(BoneStyle::Lines));
    let count = |session: &mut Session| seen_through(session).lines.len() / 2;
    assert_eq!(count(&mut session), 0);
    let revision = session.picture_revision();
    session.apply(Select(Some(JointIndex(1))));
    assert!(count(&mut session) == 1 && session.picture_revision() > revision);
    session.apply(Hover(Some(JointIndex(0))));
    let both = seen_through(&mut session);
    assert_eq!(both.lines.len() / 2, 2);
    session.apply(SetBonesVisible(true));
    assert_eq!(seen_through(&mut session), both, "there are no others");
    session.apply(SetBonesVisible(false));
    session.apply(SetSkinView(Some(SkinView::Weight)));
    assert_eq!(count(&mut session), 0, "the colours are those of the bone");
    session.apply(SetSkinView(None));
    session.apply(Hover(None));
    session.apply(Select(None));
    assert_eq!(count(&mut session), 0);
}

#[test]
fn labels_are_those_in_view_and_the_selected_comes_first() {
    let mut session = chains(41);
    let mut places = Vec::new();
    session.joint_labels(0.0, &mut places);
    assert!(places.is_empty(), "hidden");
    session.apply(SetLabelsVisible(true));
    session.apply(Select(Some(JointIndex(20))));
    session.apply(Hover(Some(JointIndex(7))));
    session.joint_labels(0.0, &mut places);
    assert_eq!(
        (places.len(), places[0].joint, places[1].joint),
        (41, JointIndex(20), JointIndex(7))
    );
}

#[test]
fn names_stand_only_where_bones_are_drawn_and_bring_them() {
    let mut session = chains(5);
    let shown = |session: &mut Session| {
        let mut places = Vec::new();
        session.joint_labels(0.0, &mut places);
        assert_eq!(places.is_empty(), !session.look().labels_visible());
        (session.look().bones_visible, session.look().labels_visible())
    };
    for (command, bones_and_names, why) in [
        (SetLabelsVisible(true), (true, true), "names without bones say nothing"),
        (SetBonesVisible(false), (false, false), "they go with the bones"),
        (SetBonesVisible(true), (true, true), "and come back with them"),
        (SetBonesVisible(false), (false, false), ""),
        (SetLabelsVisible(true), (true, true), "asked for alone, with the bones"),
        (SetLabelsVisible(false), (true, false), "bones stay without names"),
        (SetBonesVisible(false), (false, false), ""),
        (
            SetLabelsVisible(false),
            (false, false),
            "nothing comes by being left out",
        ),
        (SetBonesVisible(true), (true, false), ""),
    ] {
        session.apply(command);
        assert_eq!(shown(&mut session), bones_and_names, "{command:?}: {why}");
    }
}

#[test]
fn skin_colours_are_those_of_the_view_and_their_key_changes_with_them() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    let vertices = session.open_model().expect("open").model.mesh.vertex_count();
    assert!(
        skin_colors(&mut session).is_empty() && session.skin_colors_key().is_none(),
        "the skin as it is"
    );

    let mut seen = Vec::new();
    for view in SkinView::ALL {
        session.apply(SetSkinView(Some(view)));
        assert_eq!(skin_colors(&mut session).len(), vertices);
        let key = session.skin_colors_key().expect("shown");
        assert!(!seen.contains(&key));
        seen.push(key);
        session.apply(PlayCommand::Seek {
            time_secs: 0.1 + seen.len() as f32 * 0.2,
        });
        assert_eq!(
            session.skin_colors_key() != Some(key),
            view == SkinView::Stretch,
            "only stretch is of a pose"
        );
    }
    session.apply(SetSkinView(Some(SkinView::Weight)));
    let colors = skin_colors(&mut session);
    assert!(
        colors
            .iter()
            .all(|color| *color == legend(SkinView::Weight)[0].color_srgb),
        "no joint, no weight"
    );
    let key = session.skin_colors_key();
    session.apply(Select(Some(JointIndex(1))));
    assert_ne!(session.skin_colors_key(), key);
    let colors = skin_colors(&mut session);
    let mesh = &session.open_model().expect("open").model.mesh;
    let heights: Vec<f32> = mesh.positions.iter().map(|position| position.y / 4.0).collect();
    let mut expected = Vec::new();
    colors_of_values(legend(SkinView::Weight), &heights, &mut expected);
    assert_eq!(colors, expected, "the upper joint's weight grows with height");
    assert_eq!(Session::new(false).skin_colors_key(), None);

    // Of a vertex the strongest joint, where nothing else was chosen.
    let mesh = &session.open_model().expect("open").model.mesh;
    let [lowest, highest] = [0.0, 4.0].map(|y| {
        let place = mesh.positions.iter().position(|position| position.y == y);
        place.expect("the box is four high") as u32
    });
    session.apply(SelectVertex(Some(lowest)));
    assert_eq!(session.weighed_joint(), Some(JointIndex(1)), "the selected joint stays");
    session.apply(Select(None));
    assert_eq!(session.weighed_joint(), Some(JointIndex(0)));
    session.apply(SelectVertex(Some(highest)));
    assert_eq!(session.weighed_joint(), Some(JointIndex(1)));
    let colors = skin_colors(&mut session);
    assert_eq!(colors, expected);
}

#[test]
fn trails_are_of_the_chosen_joints_through_the_clip_on_show() {
    let mut session = opened(moving("a.m3d"));
    // A trail of n points has n - 1 steps, each drawn as a line of two ends.
    let steps = |session: &mut Session| seen_through(session).lines.len() / 2;
    assert_eq!(steps(&mut session), 0);
    session.apply(ToggleTrail(JointIndex(1)));
    assert_eq!(steps(&mut session), 30);
    session.apply(PlayCommand::SelectClip(1));
    assert_eq!(steps(&mut session), 60);
    session.apply(ToggleTrail(JointIndex(0)));
    assert_eq!(steps(&mut session), 120);
    session.apply(ClearTrails);
    assert_eq!(steps(&mut session), 0);
    session.apply(ToggleTrail(JointIndex(1)));
    assert_eq!(steps(&mut session), 60);
}

#[test]
fn the_soldier_is_inspected_explained_and_coloured() {
    let Some(bytes) = soldier_bytes() else { return };
    let mut session = opened(File::new("soldier.m3d", bytes));
    session.apply(PlayCommand::Seek { time_secs: 0.517 });
    session.apply(SetSkinView(Some(SkinView::Weight)));
    session.apply(SelectAt(Vec2::ZERO));
    assert!(
        session
            .explain_vertex()
            .is_some_and(|explained| !explained.influences.is_empty())
    );
    let readout = session.inspect_joint(JointIndex(10)).expect("58 joints");
    assert!(!readout.model.is_mirrored() && readout.to_text().contains("finalTransform"));
    for view in SkinView::ALL {
        session.apply(SetSkinView(Some(view)));
        assert_eq!(skin_colors(&mut session).len(), 13_748);
    }
    let pairs = session.mirror_pairs();
    assert!(pairs.len() >= 20, "{}", pairs.len());
}

#[test]
fn a_click_selects_what_it_is_about_and_one_thing_at_a_time() {
    let mut session = opened(moving("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(PlayCommand::Seek { time_secs: 0.0 });
    let inside = |session: &mut Session| on_screen(session, Vec3::new(0.7, 2.9, 0.5));
    let bone = |session: &mut Session| {
        let bone = session.bones().bones()[0];
        on_screen(session, bone.from.midpoint(bone.to))
    };
    let selected = |session: &Session| {
        let joints = session.joints();
        (
            session.submeshes().selected(),
            joints.selected_vertex().is_some(),
            joints.selected(),
        )
    };
    let at = inside(&mut session);
    session.apply(SubmeshCommand::SelectAt(at));
    assert_eq!(selected(&session), (Some(0), false, None));
    session.apply(SetSkinView(Some(SkinView::Weight)));
    session.apply(SelectAt(at));
    assert_eq!(selected(&session), (None, true, None), "a vertex of a coloured skin");
    let at_bone = bone(&mut session);
    session.apply(SetBonesVisible(true));
    session.apply(SelectAt(at_bone));
    assert_eq!(selected(&session), (None, false, Some(JointIndex(0))), "a bone instead");
    session.apply(SelectAt(at));
    assert_eq!(
        selected(&session),
        (None, true, Some(JointIndex(0))),
        "a vertex with its bone"
    );
    // Beside the skin the bone stays whose weights are shown.
    let nowhere = Vec2::splat(0.99);
    session.apply(SelectAt(nowhere));
    assert_eq!(selected(&session), (None, false, Some(JointIndex(0))));
    session.apply(SetSkinView(None));
    session.apply(SelectAt(nowhere));
    assert_eq!(selected(&session), (None, false, None));
    session.apply(Select(Some(JointIndex(1))));
    session.apply(SubmeshCommand::SelectAt(nowhere));
    assert_eq!(selected(&session), (None, false, None), "a click about subsets");
    session.apply(Select(Some(JointIndex(1))));
    session.apply(SubmeshCommand::Select(Some(0)));
    assert_eq!(selected(&session), (Some(0), false, None));
}

#[test]
fn beside_all_bones_a_click_on_the_skin_selects_the_one_that_moves_it_most() {
    let mut session = opened(moving("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(PlayCommand::Seek { time_secs: 0.0 });
    let corners = session.open_model().expect("open").model.mesh.clone();
    let mut met = 0;
    for step in 0..40 {
        let at = Vec2::new((step % 8) as f32 - 3.5, (step / 8) as f32 - 2.0) * 0.2;
        if session.joint_at(at).is_some() {
            continue;
        }
        let hit = session.pick(at);
        session.apply(SelectAt(at));
        let expected = hit.and_then(|hit| dominant_joint(&corners.influences[hit.vertex as usize]));
        assert_eq!(session.joints().selected(), expected, "{at}");
        met += u32::from(expected.is_some());
    }
    assert!(met > 3, "{met} places of the skin are beside all bones");
}

#[test]
fn a_selected_vertex_is_where_it_is_drawn() {
    let mut session = opened(moving("a.m3d"));
    session.apply(SelectVertex(Some(0)));
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    let place = session.explain_vertex().expect("it is there").position;
    let world = session.frame().world_from_model.transform_point3(place);
    let expected = on_screen(&mut session, world);
    let at = session.place_in_picture(place).expect("in view");
    assert!(at.distance(expected) < 1e-5, "{at} {expected}");
    session.apply(zoom(0.05));
    assert_eq!(session.place_in_picture(place), None, "beside the picture");
}

#[test]
fn the_camera_comes_to_what_is_selected_and_goes_back_to_all_of_it() {
    let mut session = chains(40);
    session.apply(CameraCommand::FrameModel);
    let whole = *session.camera();
    session.apply(CameraCommand::FrameSelection);
    assert_eq!(*session.camera(), whole, "nothing is selected");

    let chosen = JointIndex(31);
    session.apply(Select(Some(chosen)));
    session.apply(CameraCommand::FrameSelection);
    let near = *session.camera();
    assert!(
        near.distance < 0.5 * whole.distance,
        "{} of {}",
        near.distance,
        whole.distance
    );
    let place = session.bones().position(chosen).expect("it is there");
    assert!(
        near.target.distance(place) < 0.5 * near.distance,
        "{} is not near {place}",
        near.target
    );
    // A vertex comes with what is around it.
    session.apply(Select(None));
    session.apply(SelectVertex(Some(60)));
    session.apply(CameraCommand::FrameSelection);
    let (at_vertex, place) = (*session.camera(), session.explain_vertex().expect("selected").position);
    let world = session.frame().world_from_model.transform_point3(place);
    assert!(
        at_vertex.target.distance(world) < 0.1 * at_vertex.distance,
        "{} {world}",
        at_vertex.target
    );
    assert!(
        (0.05..0.5).contains(&(at_vertex.distance / whole.distance)),
        "{at_vertex:?}"
    );
    session.apply(SelectVertex(None));
    session.apply(Select(Some(chosen)));
    session.apply(CameraCommand::FrameSelection);
    assert_eq!(*session.camera(), near);

    // It stays there when the window changes, which would frame all of the model otherwise.
    session.apply(viewport(1.3));
    assert_eq!(session.camera().distance, near.distance);

    session.apply(CameraCommand::FrameModel);
    assert!(session.camera().distance > 1.5 * near.distance);
    session.apply(Select(None));
    session.apply(SubmeshCommand::Select(Some(0)));
    session.apply(zoom(8.0));
    let far = session.camera().distance;
    session.apply(CameraCommand::FrameSelection);
    // The subset is all of the mesh.
    let distance = session.camera().distance;
    assert!(
        distance < 0.5 * far && distance > 0.5 * whole.distance,
        "{distance} from {far}"
    );
}
