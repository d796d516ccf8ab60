//! The camera, the space of the world, and when the picture is another one.

use bindpose::anim::{self, CompiledClip, LoopMode, PoseBuffers};
use bindpose::model::{Front, Handedness, UpAxis, world_from_model};
use bindpose::scene::{Camera, Insets, Overlay, Projection, Theme, ViewPreset};
use bindpose::session::{CameraCommand, Command, File, FileCommand, LookCommand, PlayCommand, Session};
use glam::{Vec2, Vec3};

use super::models::{self, moving, still};
use super::{opened, orbit, viewport, zoom};

const FREE: Insets = Insets {
    left: 0.0,
    right: 0.0,
    top: 0.0,
    bottom: 0.0,
};

/// All that the clip on show reaches at its frames, in the picture: x right and y up, −1…1, and depth.
fn reached_in_picture(session: &mut Session, aspect: f32) -> Vec<Vec3> {
    let frame = session.frame();
    let clip_from_world = frame.camera.clip_from_view(aspect, &frame.world_bounds) * frame.camera.view_from_world();
    let world_from_model = frame.world_from_model;
    let open = session.open_model().expect("open");
    let (skeleton, mesh) = (&open.model.skeleton, &open.model.mesh);
    let mut buffers = PoseBuffers::for_skeleton(skeleton);
    let mut positions = Vec::new();
    let mut reached = Vec::new();
    for frame in 0..session.clip().map_or(1, bindpose::model::Clip::frame_count) {
        if let Some(clip) = session.clip() {
            buffers.evaluate(skeleton, &CompiledClip::new(clip), clip.time_of_frame(frame));
        }
        anim::skin_positions(mesh, &buffers.palette, &mut positions);
        let in_picture = |&point: &Vec3| clip_from_world.project_point3(world_from_model.transform_point3(point));
        reached.extend(positions.iter().map(in_picture));
    }
    reached
}

/// In the studio as a portrait is taken, under the books' light as the books' demos have it. What is looked at keeps
/// its size.
#[test]
fn the_first_view_is_30_degrees_high_and_that_of_the_books_45() {
    let mut session = opened(moving("a.m3d"));
    let wide = |session: &Session| match session.camera().projection {
        Projection::Perspective { fov_y_radians } => fov_y_radians.to_degrees(),
        Projection::Orthographic => panic!("it is a perspective view"),
    };
    let camera = *session.camera();
    assert_eq!(
        (camera.yaw_radians, camera.pitch_radians),
        ViewPreset::ThreeQuarter.yaw_pitch_radians()
    );
    assert!(
        camera.yaw_radians.abs() > 0.4 && camera.pitch_radians > 0.1,
        "{camera:?}"
    );
    assert!((wide(&session) - 30.0).abs() < 1e-3);
    session.apply(LookCommand::ToggleLight);
    assert!((wide(&session) - 45.0).abs() < 1e-3);
    let size = camera.height_in_view();
    assert!((session.camera().height_in_view() / size - 1.0).abs() < 1e-4);
    session.apply(CameraCommand::Reset);
    assert!((wide(&session) - 45.0).abs() < 1e-3, "a reset keeps the light");
    session.apply(LookCommand::ToggleLight);
    assert!((wide(&session) - 30.0).abs() < 1e-3);
}

/// The points by which a clip is framed are taken at a dozen times: between them it may reach a little further, into the
/// margin that framing leaves, but not out of the free part.
#[test]
fn a_framed_model_lies_in_what_panels_leave_free_at_every_time() {
    #[rustfmt::skip]
    let all_insets = [
        FREE,
        Insets { top: 0.06, bottom: 0.1, ..FREE },
        Insets { left: 0.3, top: 0.06, bottom: 0.1, ..FREE },
        Insets { right: 0.3, ..FREE },
        Insets { left: 0.2, right: 0.2, top: 0.2, bottom: 0.3 },
    ];
    for file in [moving("a.m3d"), still("a.m3d")] {
        let mut session = opened(file);
        for projection in [Camera::default().projection, Projection::Orthographic] {
            if session.camera().projection != projection {
                session.apply(CameraCommand::ToggleProjection);
            }
            for (aspect, insets) in [0.46, 1.0, 1.6, 3.5]
                .into_iter()
                .flat_map(|aspect| all_insets.map(|i| (aspect, i)))
            {
                session.apply(CameraCommand::SetViewport { aspect, insets });
                for preset in ViewPreset::ALL {
                    session.apply(CameraCommand::LookFrom(preset));
                    let what = format!("{preset:?} {projection:?} {aspect} {insets:?}");
                    let points = reached_in_picture(&mut session, aspect);
                    let (mut least, mut greatest) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
                    for point in points {
                        (least, greatest) = (least.min(point), greatest.max(point));
                    }
                    assert!(
                        least.x >= -1.0 + 2.0 * insets.left && greatest.x <= 1.0 - 2.0 * insets.right,
                        "{what}"
                    );
                    assert!(
                        least.y >= -1.0 + 2.0 * insets.bottom && greatest.y <= 1.0 - 2.0 * insets.top,
                        "{what}"
                    );
                    assert!(least.z >= 0.0 && greatest.z <= 1.0, "{what}: no plane cuts");
                    // And it is no dot in the middle: one of the two ways is well used.
                    let free = Vec2::new(
                        2.0 - 2.0 * (insets.left + insets.right),
                        2.0 - 2.0 * (insets.top + insets.bottom),
                    );
                    let used = ((greatest - least).truncate() / free).max_element();
                    assert!(used > 0.6, "{what}: {used}");
                }
            }
        }
    }
}

#[test]
fn a_framed_model_stays_framed_in_another_window_and_a_panned_one_stays_put() {
    let narrow = viewport(0.25);
    let wide = viewport(2.0);
    let mut session = opened(still("a.m3d"));
    session.apply(wide.clone());
    let in_wide = session.camera().distance;
    session.apply(narrow.clone());
    assert!(session.camera().distance > in_wide * 1.2);
    session.apply(wide.clone());
    assert!((session.camera().distance / in_wide - 1.0).abs() < 1e-3);

    session.apply(orbit(0.4, 0.1));
    session.apply(narrow.clone());
    assert!(session.camera().distance > in_wide * 1.2, "turning leaves it framed");

    for command in [
        CameraCommand::Pan {
            drag: Vec2::new(0.1, 0.0),
        },
        zoom(0.9),
    ] {
        session.apply(CameraCommand::FrameModel);
        session.apply(command);
        let chosen = *session.camera();
        session.apply(wide.clone());
        session.apply(narrow.clone());
        assert_eq!(session.camera(), &chosen);
    }
    session.apply(CameraCommand::FrameModel);
    session.apply(wide);
    assert!(session.camera().distance < in_wide * 1.2, "framed again");
}

#[test]
fn a_window_without_a_shape_is_left_out() {
    let mut session = opened(still("a.m3d"));
    let before = *session.camera();
    for (aspect, left) in [
        (0.0, 0.0),
        (f32::NAN, 0.0),
        (f32::INFINITY, 0.0),
        (-1.0, 0.0),
        (1.0, f32::NAN),
    ] {
        session.apply(CameraCommand::SetViewport {
            aspect,
            insets: Insets { left, ..FREE },
        });
        session.apply(CameraCommand::FrameModel);
        assert_eq!(session.camera(), &before);
    }
}

#[test]
fn zooming_ends_before_the_model_is_passed_or_a_dot() {
    let mut session = opened(still("a.m3d"));
    let radius = session.world_bounds().radius();
    for (factor, distance) in [
        (0.5, radius * 1e-2),
        (2.0, radius * 100.0),
        (0.0, radius * 1e-2),
        (f32::INFINITY, radius * 100.0),
    ] {
        for _ in 0..64 {
            session.apply(CameraCommand::Zoom {
                factor,
                pointer: Vec2::new(0.2, -0.3),
            });
        }
        let reached = session.camera().distance;
        assert!(
            (reached / distance - 1.0).abs() < 1e-4,
            "{reached} instead of {distance}"
        );
        assert!(session.camera().target.is_finite());
    }
}

#[test]
fn what_is_no_number_leaves_the_camera_alone() {
    let mut session = opened(moving("a.m3d"));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let before = *session.camera();
        session.apply(orbit(bad, 0.1));
        session.apply(orbit(0.1, bad));
        session.apply(CameraCommand::Pan {
            drag: Vec2::new(bad, 0.0),
        });
        session.apply(CameraCommand::Pan {
            drag: Vec2::new(0.0, bad),
        });
        assert_eq!(session.camera(), &before);
        session.apply(CameraCommand::Zoom {
            factor: 0.9,
            pointer: Vec2::new(bad, 0.1),
        });
        assert!(session.camera().target.is_finite());
    }
    let before = *session.camera();
    session.apply(zoom(f32::NAN));
    assert_eq!(session.camera(), &before);
}

#[test]
fn a_model_of_absurd_size_leaves_the_camera_finite() {
    for size in [1e-38, 1e-20, 1e18, 1e38] {
        let mut document = models::document();
        for vertex in &mut document.vertices {
            vertex.position = vertex.position.map(|x| x * size);
        }
        let mut session = opened(models::file("a.m3d", &document));
        for preset in ViewPreset::ALL {
            session.apply(CameraCommand::LookFrom(preset));
            session.apply(CameraCommand::Zoom {
                factor: 0.8,
                pointer: Vec2::ONE,
            });
            session.apply(CameraCommand::Pan { drag: Vec2::ONE });
            let camera = session.camera();
            assert!(
                camera.target.is_finite() && camera.distance.is_finite() && camera.distance > 0.0,
                "{size}: {camera:?}"
            );
        }
    }
}

#[test]
fn the_projection_changes_and_back_and_a_reset_is_the_first_view() {
    let mut session = opened(still("a.m3d"));
    let first = *session.camera();
    session.apply(CameraCommand::ToggleProjection);
    assert_eq!(session.camera().projection, Projection::Orthographic);
    session.apply(CameraCommand::LookFrom(ViewPreset::Back));
    session.apply(CameraCommand::Pan { drag: Vec2::ONE });
    session.apply(CameraCommand::Reset);
    assert_eq!(session.camera(), &first);
}

#[test]
fn handedness_and_up_axis_change_the_world_and_back() {
    let mut session = opened(moving("a.m3d"));
    let world = |session: &mut Session| session.frame().world_from_model;
    assert_eq!((session.handedness(), session.up_axis()), (Handedness::Left, UpAxis::Y));
    let found = world(&mut session);
    assert_eq!(found, glam::Affine3A::IDENTITY);
    let camera = *session.camera();

    session.apply(Command::SetHandedness(Some(Handedness::Right)));
    assert_eq!(session.handedness_override(), Some(Handedness::Right));
    assert_eq!(
        world(&mut session),
        world_from_model(Handedness::Right, UpAxis::Y, Front::Negative)
    );
    // x is mirrored: the box stands on the other side.
    assert!(session.world_bounds().center().x < 0.0);

    session.apply(Command::SetUpAxis(Some(UpAxis::Z)));
    assert_eq!(
        world(&mut session),
        world_from_model(Handedness::Right, UpAxis::Z, Front::Negative)
    );
    // The file's z, from −1 to 0, is up now.
    assert!(session.world_bounds().center().y < 0.0);

    session.apply(Command::SetHandedness(None));
    session.apply(Command::SetUpAxis(None));
    assert_eq!(
        (session.handedness_override(), session.up_axis_override()),
        (None, None)
    );
    assert_eq!(world(&mut session), found);
    assert_eq!(session.camera(), &camera, "framed as at first");
}

#[test]
fn the_box_of_the_world_holds_all_that_the_clip_reaches() {
    let mut session = opened(moving("a.m3d"));
    let bent = session.world_bounds();
    assert!(bent.min.x < models::BOX[0].x - 1.0 && bent.max.y > models::BOX[1].y - 1e-3);
    // While a clip that plays fades, both are in the box.
    session.apply(PlayCommand::Pause);
    session.apply(PlayCommand::SelectClip(2));
    let unbent = session.world_bounds();
    assert!(
        unbent.min.abs_diff_eq(models::BOX[0], 1e-4) && unbent.max.abs_diff_eq(models::BOX[1], 1e-4),
        "{unbent:?}"
    );
}

/// Applies a command and tells whether the picture is another one by it.
fn changes(session: &mut Session, command: Command) -> bool {
    let before = session.picture_revision();
    session.apply(command);
    session.picture_revision() != before
}

#[test]
fn the_picture_is_another_one_exactly_when_something_in_it_changed() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    let revision = session.picture_revision();
    session.advance(1.0);
    assert_eq!(session.picture_revision(), revision, "paused");

    let changing: Vec<Command> = vec![
        PlayCommand::Seek { time_secs: 0.5 }.into(),
        PlayCommand::StepFrames(1).into(),
        PlayCommand::SeekEnd.into(),
        PlayCommand::SelectClip(1).into(),
        PlayCommand::CycleClip(1).into(),
        orbit(0.1, 0.0).into(),
        CameraCommand::Pan { drag: Vec2::X }.into(),
        zoom(0.5).into(),
        CameraCommand::FrameModel.into(),
        CameraCommand::LookFrom(ViewPreset::Left).into(),
        CameraCommand::ToggleProjection.into(),
        CameraCommand::Reset.into(),
        Command::SetHandedness(Some(Handedness::Right)),
        Command::SetUpAxis(Some(UpAxis::Z)),
        Command::Look(LookCommand::SetOverlay(Overlay::Grid, false)),
        Command::Look(LookCommand::ToggleOverlay(Overlay::Grid)),
        Command::SetTheme(Theme::Light),
        viewport(0.5).into(),
        FileCommand::Add(vec![moving("a.m3d")]).into(),
        FileCommand::Add(vec![moving("b.m3d")]).into(),
    ];
    for command in changing {
        assert!(changes(&mut session, command.clone()), "{command:?}");
    }
    session.apply(PlayCommand::Pause);
    let idle: Vec<Command> = vec![
        PlayCommand::Pause.into(),
        PlayCommand::Play.into(),
        PlayCommand::Pause.into(),
        PlayCommand::BeginScrub.into(),
        PlayCommand::EndScrub.into(),
        PlayCommand::Seek { time_secs: 0.0 }.into(),
        PlayCommand::SeekStart.into(),
        PlayCommand::StepFrames(-1).into(),
        PlayCommand::SelectClip(0).into(),
        PlayCommand::CycleClip(0).into(),
        PlayCommand::SetSpeed(2.0).into(),
        PlayCommand::Slower.into(),
        PlayCommand::SetLoopMode(LoopMode::Once).into(),
        PlayCommand::CycleLoopMode.into(),
        CameraCommand::Pan { drag: Vec2::ZERO }.into(),
        Command::Look(LookCommand::SetOverlay(Overlay::Grid, true)),
        Command::SetTheme(Theme::Light),
        viewport(0.5).into(),
        Command::SetHandedness(None),
        Command::SetUpAxis(Some(UpAxis::Y)),
        FileCommand::Open("nowhere".to_owned()).into(),
        FileCommand::Add(vec![File::new("c.m3d", *b"")]).into(),
        FileCommand::DismissError.into(),
    ];
    session.apply(CameraCommand::FrameModel);
    for command in idle {
        assert!(!changes(&mut session, command.clone()), "{command:?}");
    }
}

#[test]
fn the_grid_and_the_theme_are_in_the_frame() {
    let mut session = opened(still("a.m3d"));
    assert!(session.frame().options.overlays.has(Overlay::Grid));
    session.apply(LookCommand::ToggleOverlay(Overlay::Grid));
    session.apply(Command::SetTheme(Theme::Light));
    let options = session.frame().options;
    assert!(!options.overlays.has(Overlay::Grid));
    assert_eq!(options.theme, Theme::Light);
}

#[test]
fn with_nothing_open_everything_is_in_order() {
    let mut session = Session::new(false);
    for command in [
        Command::from(PlayCommand::Play),
        CameraCommand::FrameModel.into(),
        zoom(0.5).into(),
        PlayCommand::SelectClip(0).into(),
        FileCommand::Open("a.m3d".to_owned()).into(),
    ] {
        assert!(!session.apply(command).model);
    }
    session.advance(1.0);
    let frame = session.frame();
    assert!(frame.world_bounds.is_empty() && frame.palette.0.is_empty());
    assert!(frame.camera.target.is_finite() && frame.camera.distance > 0.0);
}
