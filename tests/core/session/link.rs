//! Links: a view as text in an address, and back.

use bindpose::model::{Handedness, JointIndex, UpAxis};
use bindpose::scene::{Background, Insets, Light, Overlay, ViewMode};
use bindpose::session::{
    CameraCommand, Command, CrowdCommand, JointCommand, LookCommand, MAX_LINK_LEN, MaterialCommand, NameCommand,
    PlayCommand, QualityCommand, QualityMode, Session, SubmeshCommand,
};
use proptest::prelude::*;

use super::history::three_parts;
use super::models::{jointed, moving, still};
use super::random::number;
use super::view_state::looking;
use super::{dropped, opened};

fn text(session: &Session) -> String {
    let link = session.link(Vec::new(), MAX_LINK_LEN);
    assert_eq!(link.left_out, [""; 0]);
    link.text
}

/// The names of what was left out.
fn follow(session: &mut Session, text: &str) -> Vec<String> {
    let (linked, left_out) = session.read_link(text);
    session.apply(Command::Restore(Box::new(linked.view)));
    session.apply(QualityCommand::SetMode(linked.quality));
    let name = |field: &String| field.split('=').next().unwrap_or_default().to_owned();
    left_out.iter().map(name).collect()
}

#[test]
fn a_first_visit_has_an_empty_link() {
    for file in [moving("a.m3d"), still("a.m3d"), jointed("a.m3d")] {
        for reduced_motion in [false, true] {
            let mut session = Session::new(reduced_motion);
            session.apply(bindpose::session::FileCommand::Add(vec![file.clone()]));
            assert_eq!(text(&session), "", "{}", file.path);
            if reduced_motion && session.clip().is_some() {
                session.apply(PlayCommand::Seek { time_secs: 0.5 });
                assert_eq!(text(&session), "t=0.5&play=0", "elsewhere it would play on");
                session.apply(PlayCommand::Play);
                assert!(text(&session).contains("play=1"), "{}", text(&session));
                follow(&mut session, "t=0.25");
                assert!(!session.playback().is_playing(), "nothing moves here unasked");
            }
        }
    }
}

#[test]
fn a_change_leaves_the_rest_as_it_is() {
    let mut session = opened(moving("a.m3d"));
    follow(
        &mut session,
        "clip=Turn&t=0.75&play=0&speed=0.5&light=book&cam=70,12,4.2",
    );
    let camera = *session.camera();
    let mut change = |text: &str| {
        let (linked, left_out) = session.read_change(text, &[]);
        session.apply(Command::Restore(Box::new(linked.view)));
        (
            session.clip().map(|clip| clip.name.clone()),
            session.playback().time_secs(),
            *session.camera() == camera,
            left_out,
        )
    };
    let turn = Some("Turn".to_owned());
    assert_eq!(change("exposure=1"), (turn.clone(), 0.75, true, vec![]));
    assert_eq!(
        change("bone=999&clip=Nothing&cam=up&t=x"),
        (
            turn.clone(),
            0.75,
            true,
            ["bone=999", "cam=up", "clip=Nothing", "t=x"].map(String::from).to_vec()
        )
    );
    assert_eq!(change("t=1.25"), (turn, 1.25, true, vec![]));
    let first = opened(moving("a.m3d")).clip().map(|clip| clip.name.clone());
    let name = first.clone().expect("it has clips");
    assert_eq!(change(&format!("clip={name}")), (first, 0.0, true, vec![]));
    assert!(text(&session).contains("speed=0.5"), "{}", text(&session));
}

#[test]
fn a_link_is_written_as_a_person_would_write_it() {
    let mut session = opened(moving("a.m3d"));
    for command in [
        PlayCommand::Pause,
        PlayCommand::SelectClip(1),
        PlayCommand::Seek { time_secs: 0.75 },
        PlayCommand::SetSpeed(0.5),
        PlayCommand::SetRangeStart(Some(0.75)),
        PlayCommand::SetRangeEnd(Some(1.5)),
    ] {
        session.apply(command);
    }
    session.apply(JointCommand::Select(Some(bindpose::model::JointIndex(1))));
    session.apply(LookCommand::SetLight(Light::Book));
    session.apply(LookCommand::SetViewMode(ViewMode::ShadingNormal));
    session.apply(LookCommand::SetBackground(Background::Color([0x20, 0x26, 0x2e])));
    session.apply(LookCommand::SetOverlay(Overlay::Wireframe, true));
    session.apply(LookCommand::SetEnvironmentTurn(90_f32.to_radians()));
    session.apply(Command::SetUpAxis(Some(UpAxis::Z)));
    session.apply(Command::SetUpAxis(None));
    session.apply(Command::SetHandedness(None));
    session.apply(CrowdCommand::Set { count: 3, seed: 7 });
    session.apply(QualityCommand::SetMode(QualityMode::Low));
    session.apply(CameraCommand::FrameModel);
    let link = text(&session);
    assert_eq!(
        link,
        "clip=Turn&t=0.75&play=0&speed=0.5&range=0.75,1.5&bone=1&light=book&view=normal&bg=20262e\
         &overlay=grid,wireframe&env=90&crowd=3&seed=7&quality=low"
    );
    let mut elsewhere = opened(moving("a.m3d"));
    assert_eq!(follow(&mut elsewhere, &link), [""; 0]);
    assert_eq!(text(&elsewhere), link);
    assert_eq!(elsewhere.quality().mode(), QualityMode::Low);
    assert_eq!(elsewhere.history().undo_label(), None, "no step");
    // Nothing leads back to the first visit.
    assert_eq!(follow(&mut elsewhere, ""), [""; 0]);
    assert_eq!(text(&elsewhere), "");
}

#[test]
fn a_camera_that_went_round_what_it_framed_is_where_it_was_in_windows_of_one_shape() {
    let shaped = |aspect| {
        let mut session = opened(moving("a.m3d"));
        let insets = Insets::default();
        session.apply(CameraCommand::SetViewport { aspect, insets });
        for _ in 0..100 {
            session.advance(0.05);
        }
        session.apply(PlayCommand::Pause);
        session
    };
    let orbit = CameraCommand::Orbit {
        yaw_radians: 0.6,
        pitch_radians: 0.5,
    };
    let mut session = shaped(1.5);
    session.apply(orbit);
    let (camera, link) = (*session.camera(), text(&session));
    let mut same = shaped(1.5);
    assert_eq!(follow(&mut same, &link), [""; 0]);
    assert!(
        (same.camera().distance - camera.distance).abs() < 1e-5 * camera.distance,
        "{link}"
    );
    assert!(
        same.camera().target.distance(camera.target) < 1e-5 * camera.distance,
        "{link}"
    );
    // Who follows it has the same link, also when panels have opened, and passes it on.
    let insets = Insets {
        left: 0.2,
        ..Insets::default()
    };
    same.apply(CameraCommand::SetViewport { aspect: 1.5, insets });
    assert_eq!(text(&same), link);
    // In a window of another shape it is seen whole.
    let mut narrow = shaped(0.5);
    assert_eq!(follow(&mut narrow, &text(&same)), [""; 0]);
    let insets = Insets::default();
    same.apply(CameraCommand::SetViewport { aspect: 0.5, insets });
    for seen in [&narrow, &same] {
        assert!(seen.is_framed());
        assert!(seen.camera().distance > 1.5 * camera.distance);
    }
    session.apply(CameraCommand::FrameModel);
    assert!(
        (session.camera().distance - camera.distance).abs() > 1e-3 * camera.distance,
        "it shows"
    );
    assert_eq!(text(&session).split(',').count(), 2, "{}", text(&session));
}

#[test]
fn a_camera_is_framed_or_where_its_numbers_say() {
    let mut session = opened(moving("a.m3d"));
    assert!(follow(&mut session, "cam=70,12").is_empty());
    let camera = session.view_state().camera;
    assert_eq!(
        [camera.yaw_radians, camera.pitch_radians],
        [70_f32, 12.0].map(f32::to_radians)
    );
    assert!(camera.framed);
    assert_eq!(text(&session), "cam=70,12");
    assert!(follow(&mut session, "cam=70,12,4.2").is_empty());
    let near = session.view_state().camera;
    assert_eq!((near.distance, near.target, near.framed), (4.2, camera.target, false));
    assert!(follow(&mut session, "cam=right").is_empty());
    assert_eq!(text(&session), "cam=90,0");
    assert!(follow(&mut session, "cam=-10.5,3,7,1,-2,0.125").is_empty());
    assert_eq!(text(&session), "cam=-10.5,3,7,1,-2,0.125");
    session.apply(CameraCommand::Reset);
    for _ in 0..100 {
        session.advance(0.05);
    }
    for damaged in [
        "",
        "1",
        "1,2,0",
        "1,2,-3",
        "1,2,3,4",
        "1,2,3,4,5,6,0",
        "1,2,3,4,5,6,7,8",
        "x,2",
        "1,2,inf",
        "1,NaN",
    ] {
        let before = session.view_state().camera;
        assert_eq!(follow(&mut session, &format!("cam={damaged}")), ["cam"], "{damaged}");
        assert!(before.framed && session.view_state().camera.framed, "{damaged}");
    }
}

#[test]
fn what_a_model_does_not_have_is_named_and_the_rest_is_shown() {
    let mut session = opened(moving("a.m3d"));
    let left_out = follow(
        &mut session,
        "clip=Fly&bone=99&vertex=1000000&subset=7&hide=0,5&solo=9&trails=0,77&blend=Swim,0.5&view=uv&newer=1&speed=&=&play",
    );
    assert_eq!(
        left_out,
        [
            "", "blend", "bone", "clip", "hide", "newer", "play", "solo", "speed", "subset", "trails", "vertex"
        ]
    );
    let state = session.view_state();
    assert_eq!(state.appearance.view_mode, ViewMode::TexCoords);
    assert_eq!(
        (state.playback.clip.as_deref(), state.playback.speed),
        (Some("Bend"), 1.0)
    );
    assert_eq!(
        (state.selection.hidden_subsets, state.appearance.trails),
        (vec![0], vec![0])
    );
}

#[test]
fn what_is_left_out_is_told_with_its_value_cut_short() {
    let session = opened(moving("a.m3d"));
    let (linked, left_out) =
        session.read_link("clip=Fl%20y&newer=123456789012345678901234567890&play&t=99&%zz=%07a%ff");
    assert_eq!(
        left_out,
        [
            "clip=Fl y",
            "newer=123456789012345678901234…",
            "play",
            "t=99",
            "zz=a\u{fffd}"
        ]
    );
    let clip = session.clip().expect("it has clips");
    assert_eq!(linked.view.playback.time_secs, clip.end_secs);
    assert_eq!(session.read_change(&format!("t={}", clip.end_secs), &[]).1, [""; 0]);
    let (changed, left_out) = session.read_change("t=99", &[]);
    assert_eq!(
        (changed.view.playback.time_secs, &*left_out),
        (clip.end_secs, &["t=99".to_owned()][..])
    );
}

#[test]
fn each_field_with_rubbish_is_left_out_or_brought_into_range() {
    let mut session = opened(three_parts("a.m3d"));
    let names: Vec<&str> = bindpose::session::link_names().collect();
    assert!(names.len() > 40);
    for name in names {
        for value in [
            "",
            "-1",
            "1e999",
            "NaN",
            "x",
            ",",
            "%",
            "%ff",
            "1,2,3,4,5",
            "99999999999999999999",
            "\u{0}",
            "#",
            "🦴",
        ] {
            let left_out = follow(&mut session, &format!("{name}={value}"));
            assert!(
                left_out.is_empty() || left_out == [name],
                "{name}={value}: {left_out:?}"
            );
            // What it came to is a link again.
            let link = text(&session);
            assert!(follow(&mut session, &link).is_empty(), "{name}={value}: {link}");
            assert_eq!(text(&session), link, "{name}={value}");
        }
    }
}

#[test]
fn edits_of_the_file_are_not_in_a_link() {
    let mut session = opened(jointed("a.m3d"));
    let mut material = Box::new(session.materials()[0].clone());
    material.diffuse = [0.1, 0.2, 0.3];
    session.apply(MaterialCommand::Edit { index: 0, material });
    session.apply(NameCommand::Rename {
        joint: JointIndex(0),
        name: "Hips".to_owned(),
    });
    assert!(session.is_edited(0) && session.history().undo_label().is_some());
    assert_eq!(text(&session), "");
}

#[test]
fn the_readme_names_every_field() {
    let readme = include_str!("../../../README.md");
    for name in bindpose::session::link_names() {
        assert!(readme.contains(&format!("`{name}`")), "{name}");
    }
}

#[test]
fn of_a_long_link_the_longest_fields_are_left_out() {
    let mut session = opened(three_parts("a.m3d"));
    session.apply(SubmeshCommand::SetVisible {
        submesh: 1,
        visible: false,
    });
    session.apply(LookCommand::SetLight(Light::Book));
    session.apply(CameraCommand::FrameModel);
    let panels = vec!["skeleton".to_owned(), "keys".to_owned()];
    let whole = session.link(panels.clone(), MAX_LINK_LEN);
    assert_eq!(whole.text, "hide=1&light=book&panel=skeleton,keys");
    for len in 0..=whole.text.len() {
        let link = session.link(panels.clone(), len);
        assert!(link.text.len() <= len, "{len}: {}", link.text);
        assert_eq!(link.left_out.is_empty(), len == whole.text.len());
    }
    assert_eq!(session.link(panels, 20).left_out, ["panel"]);
}

#[test]
fn a_link_that_is_far_too_long_is_read_as_far_as_a_page_writes() {
    let mut session = opened(moving("a.m3d"));
    let text = format!("view=uv&{}&speed=2", "🦴=1&".repeat(500_000));
    let left_out = follow(&mut session, &text);
    assert!(
        left_out.iter().any(|name| name.starts_with("all behind")),
        "{left_out:?}"
    );
    let state = session.view_state();
    assert_eq!(
        (state.appearance.view_mode, state.playback.speed),
        (ViewMode::TexCoords, 1.0)
    );
}

#[test]
fn names_with_any_character_come_back() {
    let mut session = opened(moving("a.m3d"));
    for name in ["Übergang & Lauf=2, #1 50%", "走る", "a+b c"] {
        let link = session.link(vec![name.to_owned()], MAX_LINK_LEN).text;
        assert!(link.bytes().all(|byte| byte.is_ascii_graphic()), "{link}");
        assert_eq!(session.read_link(&link).0.panels, [name]);
    }
    session.apply(Command::SetHandedness(Some(Handedness::Right)));
    assert!(text(&session).starts_with("hand=right"), "{}", text(&session));
}

proptest! {
    #![proptest_config(crate::properties::cases(96))]

    #[test]
    fn a_link_brings_back_what_was_seen(
        before in prop::collection::vec((looking(), prop::option::of(number())), 0..30),
        other in prop::collection::vec(looking(), 0..20),
    ) {
        let mut session = dropped(vec![moving("a.m3d"), still("c.m3d")]);
        // In one window: a model is framed in it.
        let is_window = |command: &Command| format!("{command:?}").contains("SetViewport");
        for (command, dt_secs) in before.into_iter().filter(|(command, _)| !is_window(command)) {
            session.apply(command);
            dt_secs.map(|dt_secs| session.advance(dt_secs));
        }
        let (link, state) = (text(&session), session.view_state());
        let mut elsewhere = dropped(vec![moving("a.m3d"), still("c.m3d")]);
        for command in other.into_iter().filter(|command| !is_window(command)) {
            elsewhere.apply(command);
        }
        prop_assert_eq!(follow(&mut elsewhere, &link), [""; 0], "{}", link);
        let mut found = elsewhere.view_state();
        // A model that is framed is so wherever it is looked at, unless the camera went round it since: then it is where it was.
        let is_at_a_place = link.split('&').any(|field| field.starts_with("cam=") && field.split(',').count() > 2);
        if !state.camera.framed || is_at_a_place {
            prop_assert_eq!(&found.camera, &state.camera, "{}", link);
        }
        if state.appearance.light == Light::Studio && state.appearance.split.is_none() {
            found.appearance.book_lights_turn_radians = state.appearance.book_lights_turn_radians;
        }
        found.camera = bindpose::session::CameraState { distance: state.camera.distance, target: state.camera.target, ..found.camera };
        prop_assert_eq!(found, state, "{}", &link);
        prop_assert_eq!(text(&elsewhere), link);
    }

    #[test]
    fn any_text_is_a_link(text in ".{0,200}", fields in prop::collection::vec(("[a-z]{1,9}", "[-0-9a-z.,%#]{0,12}"), 0..8)) {
        let fields: Vec<String> = fields.into_iter().map(|(name, value)| format!("{name}={value}")).collect();
        let mut session = opened(moving("a.m3d"));
        for link in [text, fields.join("&")] {
            follow(&mut session, &link);
        }
    }
}

/// Whoever writes a link, reading it ends soon.
#[test]
fn of_a_link_of_megabytes_the_start_is_read() {
    let session = opened(moving("a.m3d"));
    let fields: Vec<String> = (0..300_000).map(|number| format!("x{number}=1")).collect();
    let (_, left_out) = session.read_link(&fields.join("&"));
    assert!(left_out.contains(&"x0=1".to_owned()), "{left_out:?}");
    assert!((100..1_000).contains(&left_out.len()), "{}", left_out.len());
}
