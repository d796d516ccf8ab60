//! A series of pictures is made from a copy of the session, at its own times and from its own sides.

use std::f32::consts::TAU;

use bindpose::scene::{Camera, Frames, RenderFrame, Shot};
use bindpose::session::{CameraCommand, FileCommand, PlayCommand, Series, Session};

use super::dropped;
use super::models::{moving, still};

fn open(file: bindpose::session::File) -> Session {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![file]));
    session
}

/// Camera and first joint matrix of a picture: what differs between pictures of one series.
fn place(frame: &RenderFrame<'_>) -> (Camera, Option<glam::Affine3A>) {
    (frame.camera, frame.palette.0.last().copied())
}

#[test]
fn each_picture_is_the_one_that_its_time_alone_gives() {
    let mut session = open(moving("a.m3d"));
    let span_secs = session.playback().played_secs();
    let times_secs = Frames::Count(4).times_secs(span_secs);
    let mut series = Series::new(session.clone(), 1.0, Shot::series(&times_secs, 0));
    assert_eq!(series.count(), 4);
    // Out of order, too.
    for index in [2, 0, 3, 1, 2] {
        let pictured = place(&series.frame(index));
        session.apply(PlayCommand::Seek {
            time_secs: times_secs[index],
        });
        assert_eq!(pictured, place(&session.frame_at_rest()), "{index}");
    }
    let poses: Vec<_> = (0..4).map(|index| place(&series.frame(index)).1).collect();
    assert!(poses.windows(2).all(|pair| pair[0] != pair[1]), "the clip moves");
    assert!(series.caption(2)[0].ends_with(" s") && series.caption(9).is_empty());
}

#[test]
fn the_camera_turns_about_the_models_middle_and_keeps_its_distance() {
    for (file, clip) in [(moving("a.m3d"), true), (still("a.m3d"), false)] {
        let session = open(file);
        assert_eq!(session.clip().is_some(), clip);
        let mut series = Series::new(session, 1.5, Shot::series(&[], 8));
        let cameras: Vec<Camera> = (0..8).map(|index| series.frame(index).camera).collect();
        for (index, camera) in cameras.iter().enumerate() {
            assert_eq!(
                (camera.target, camera.distance),
                (cameras[0].target, cameras[0].distance)
            );
            let turned = (camera.yaw_radians - cameras[0].yaw_radians).rem_euclid(TAU);
            assert!((turned - TAU * index as f32 / 8.0).abs() < 1e-4, "{index}: {turned}");
        }
        let center = series.session().world_bounds().center();
        let off = (cameras[0].target - center).with_y(0.0).length();
        assert!(off < 0.1 * series.session().world_bounds().radius(), "{off}");
    }
}

#[test]
fn a_camera_that_was_moved_by_hand_stays() {
    let mut session = open(moving("a.m3d"));
    session.apply(CameraCommand::Zoom {
        factor: 0.5,
        pointer: glam::Vec2::new(0.2, 0.1),
    });
    let camera = *session.camera();
    let mut series = Series::new(session, 2.0, Shot::series(&[0.0], 2));
    let first = series.frame(0).camera;
    assert_eq!((first.target, first.distance), (camera.target, camera.distance));
    // A glide that is under way is where it leads to.
    let mut session = dropped(vec![moving("a.m3d")]);
    let goal = {
        let mut there = session.clone();
        there.apply(CameraCommand::LookFrom(bindpose::scene::ViewPreset::Top));
        *there.camera()
    };
    let from = CameraCommand::LookFrom(bindpose::scene::ViewPreset::Top);
    session.apply(CameraCommand::Glide(Box::new(from)));
    session.advance(0.05);
    let mut series = Series::new(session, 1.0, vec![Shot::default()]);
    assert!(series.frame(0).camera.forward().abs_diff_eq(goal.forward(), 1e-5));
}
