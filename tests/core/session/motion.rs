//! The camera as it moves by itself.

use std::f32::consts::{PI, TAU};

use bindpose::scene::{Camera, Insets, ViewPreset};
use bindpose::session::{CameraCommand, FileCommand, Session};
use glam::{Vec2, Vec3};

use super::models::still;
use super::{opened, orbit, viewport, zoom};

const STEP_SECS: f32 = 1.0 / 60.0;

fn fling(yaw_radians_per_sec: f32, pitch_radians_per_sec: f32) -> CameraCommand {
    CameraCommand::Fling {
        yaw_radians_per_sec,
        pitch_radians_per_sec,
    }
}

fn glide(command: CameraCommand) -> CameraCommand {
    CameraCommand::Glide(Box::new(command))
}

fn fly(direction: Vec3) -> CameraCommand {
    CameraCommand::Fly { direction, fast: false }
}

/// Lets time pass until nothing moves; how long it took.
fn run_out(session: &mut Session, step_secs: f32) -> f32 {
    let mut secs = 0.0;
    while session.is_moving() {
        assert!(secs < 10.0, "it never ends");
        let (before, picture) = (*session.camera(), session.picture_revision());
        session.advance(step_secs);
        let moved = *session.camera() != before;
        assert_eq!(moved, session.picture_revision() != picture, "each step is drawn");
        secs += step_secs;
    }
    secs
}

fn turned(from: &Camera, to: &Camera) -> f32 {
    (to.yaw_radians - from.yaw_radians + PI).rem_euclid(TAU) - PI
}

fn close(a: &Camera, b: &Camera) -> bool {
    a.target.abs_diff_eq(b.target, 1e-4) && (a.distance / b.distance - 1.0).abs() < 1e-4 && turned(a, b).abs() < 1e-4
}

#[test]
fn a_turn_that_is_let_go_runs_on_and_out_in_as_many_steps_as_one_likes() {
    let mut ways = Vec::new();
    for step_secs in [1.0 / 144.0, 1.0 / 60.0, 1.0 / 20.0] {
        let mut session = opened(still("a.m3d"));
        let from = *session.camera();
        session.apply(fling(2.0, -1.0));
        assert_eq!(session.camera(), &from, "time moves it");
        let secs = run_out(&mut session, step_secs);
        assert!((0.3..1.2).contains(&secs), "{secs} s");
        ways.push(turned(&from, session.camera()));
        assert!(session.camera().pitch_radians < from.pitch_radians);
    }
    // Two radians a second for 0.15 s, but for the last hundredths of a radian a second that are not waited for.
    assert!(ways.iter().all(|way| (way - 0.3).abs() < 0.005), "{ways:?}");
}

#[test]
fn whatever_a_person_does_next_ends_a_fling_and_a_glide() {
    for start in [fling(3.0, 0.0), glide(CameraCommand::LookFrom(ViewPreset::Back))] {
        for stop in [
            orbit(0.1, 0.0),
            CameraCommand::Pan { drag: Vec2::X },
            zoom(0.9),
            CameraCommand::FrameModel,
            CameraCommand::LookFrom(ViewPreset::Top),
            CameraCommand::Reset,
            CameraCommand::BeginDrag,
            CameraCommand::FlyLook {
                yaw_radians: 0.1,
                pitch_radians: 0.0,
            },
            fling(0.0, 0.0),
        ] {
            let mut session = opened(still("a.m3d"));
            session.apply(start.clone());
            session.advance(STEP_SECS);
            assert!(session.is_moving(), "{start:?}");
            session.apply(stop.clone());
            assert!(!session.is_moving(), "{start:?} {stop:?}");
            let here = *session.camera();
            session.advance(STEP_SECS);
            assert_eq!(session.camera(), &here);
        }
    }
}

#[test]
fn rates_that_are_none_or_next_to_none_move_nothing() {
    let mut session = opened(still("a.m3d"));
    for rate in [f32::NAN, f32::INFINITY, 0.0, 0.001] {
        session.apply(fling(rate, 0.0));
        session.apply(fling(0.0, rate));
        assert!(!session.is_moving(), "{rate}");
    }
    let from = *session.camera();
    session.apply(fling(f32::MAX, 0.0));
    run_out(&mut session, STEP_SECS);
    assert!(session.camera().yaw_radians.is_finite() && session.camera().target == from.target);
}

#[test]
fn a_glide_goes_the_short_way_and_ends_where_a_jump_would() {
    for (start, command) in [
        (ViewPreset::Front, CameraCommand::LookFrom(ViewPreset::Left)),
        (ViewPreset::Left, CameraCommand::LookFrom(ViewPreset::Front)),
        (ViewPreset::Front, CameraCommand::LookFrom(ViewPreset::Isometric)),
        (ViewPreset::Right, CameraCommand::Reset),
        (ViewPreset::Right, CameraCommand::FrameModel),
    ] {
        let mut session = opened(still("a.m3d"));
        session.apply(CameraCommand::LookFrom(start));
        session.apply(CameraCommand::Pan { drag: Vec2::splat(0.3) });
        let from = *session.camera();
        session.apply(command.clone());
        let there = *session.camera();
        session.apply(CameraCommand::LookFrom(start));
        session.apply(CameraCommand::Pan { drag: Vec2::splat(0.3) });
        assert_eq!(session.camera(), &from);

        session.apply(glide(command.clone()));
        assert_eq!(session.camera(), &from, "no jump");
        let way = turned(&from, &there);
        let mut last = 0.0;
        let mut secs = 0.0;
        while session.is_moving() {
            session.advance(STEP_SECS);
            secs += STEP_SECS;
            let gone = turned(&from, session.camera());
            assert!(
                gone * way.signum() >= last - 1e-5 && gone.abs() <= way.abs() + 1e-5,
                "{command:?}"
            );
            last = gone * way.signum();
        }
        assert!((0.2..0.3).contains(&secs), "{secs} s");
        assert_eq!(session.camera(), &there, "{command:?}");
    }
}

#[test]
fn a_glide_is_quick_at_first_and_slow_at_the_end() {
    let mut session = opened(still("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    let from = *session.camera();
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Right)));
    session.advance(0.125);
    let half = turned(&from, session.camera());
    assert!((half / (PI / 2.0) - 0.875).abs() < 1e-3, "{half}");
}

#[test]
fn sent_again_on_its_way_it_goes_on_from_there() {
    let mut session = opened(still("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Right));
    let right = *session.camera();
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(CameraCommand::Pan { drag: Vec2::X });
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Right)));
    session.advance(0.1);
    let here = *session.camera();
    session.apply(glide(CameraCommand::FrameModel));
    assert_eq!(session.camera(), &here);
    run_out(&mut session, STEP_SECS);
    assert!(close(session.camera(), &right), "the turn to the right is not lost");
}

#[test]
fn a_window_that_changes_on_the_way_changes_the_goal() {
    let narrow = viewport(0.3);
    let mut session = opened(still("a.m3d"));
    session.apply(narrow.clone());
    session.apply(CameraCommand::LookFrom(ViewPreset::Back));
    let there = *session.camera();

    let mut session = opened(still("a.m3d"));
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Back)));
    session.advance(STEP_SECS);
    let here = *session.camera();
    session.apply(narrow);
    assert_eq!(session.camera(), &here, "no jump");
    run_out(&mut session, STEP_SECS);
    assert!(close(session.camera(), &there));
}

#[test]
fn the_camera_glides_out_of_the_way_of_a_panel_and_turns_round_on_its_way() {
    let covered = |bottom| CameraCommand::SetViewport {
        aspect: 1.0,
        insets: Insets {
            bottom,
            ..Insets::default()
        },
    };
    let mut there = opened(still("a.m3d"));
    there.apply(covered(0.5));
    let mut session = opened(still("a.m3d"));
    let first = *session.camera();
    session.apply(fling(1.0, 0.0));
    session.apply(glide(covered(0.5)));
    assert_eq!(session.camera(), &first, "no jump");
    session.advance(STEP_SECS);
    let here = *session.camera();
    assert!(here.distance > first.distance && here.distance < there.camera().distance);
    session.apply(glide(covered(0.0)));
    assert_eq!(session.camera(), &here);
    run_out(&mut session, STEP_SECS);
    assert!(close(session.camera(), &first));
    session.apply(glide(covered(0.5)));
    run_out(&mut session, STEP_SECS);
    assert!(close(session.camera(), there.camera()));
    // Who went elsewhere is left there.
    session.apply(CameraCommand::Pan { drag: Vec2::ONE });
    session.apply(glide(covered(0.0)));
    assert!(!session.is_moving());
}

#[test]
fn a_projection_that_changes_on_the_way_stays_changed() {
    let mut session = opened(still("a.m3d"));
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Back)));
    session.advance(STEP_SECS);
    session.apply(CameraCommand::ToggleProjection);
    assert!(session.is_moving());
    run_out(&mut session, STEP_SECS);
    assert_eq!(session.camera().projection, bindpose::scene::Projection::Orthographic);
}

#[test]
fn neither_loading_nor_another_window_glides_and_what_sends_the_camera_nowhere_is_just_done() {
    let mut session = opened(still("a.m3d"));
    assert!(!session.is_moving());
    session.apply(viewport(0.3));
    assert!(!session.is_moving());
    session.apply(glide(CameraCommand::FrameModel));
    assert!(!session.is_moving(), "it is there already");
    session.apply(glide(CameraCommand::SetTurntable(true)));
    assert!(session.turntable());
}

#[test]
fn under_reduced_motion_nothing_runs_on_and_glides_jump() {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![still("a.m3d")]));
    session.apply(fling(5.0, 5.0));
    assert!(!session.is_moving());
    session.apply(CameraCommand::LookFrom(ViewPreset::Back));
    let back = *session.camera();
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Back)));
    assert!(!session.is_moving());
    assert_eq!(session.camera(), &back);
}

#[test]
fn the_turntable_turns_once_in_twelve_seconds_and_waits_while_the_camera_is_held() {
    let mut session = opened(still("a.m3d"));
    let from = *session.camera();
    session.apply(CameraCommand::SetTurntable(true));
    assert!(session.turntable() && session.is_moving());
    for _ in 0..30 {
        session.advance(0.1);
    }
    assert!(
        (turned(&from, session.camera()) - TAU / 4.0).abs() < 1e-3,
        "a quarter in three seconds"
    );

    session.apply(CameraCommand::BeginDrag);
    assert!(!session.is_moving());
    session.apply(orbit(0.5, 0.0));
    let held = *session.camera();
    session.advance(1.0);
    assert_eq!(session.camera(), &held);
    session.apply(CameraCommand::EndDrag);
    assert!(session.is_moving());
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    assert!(session.turntable(), "it is chosen for the viewer, not for the model");
    session.apply(CameraCommand::ToggleTurntable);
    assert!(!session.is_moving() && !session.turntable());

    let mut empty = Session::new(false);
    empty.apply(CameraCommand::SetTurntable(true));
    empty.apply(fly(Vec3::Z));
    assert!(!empty.is_moving(), "there is nothing to turn about or to fly through");
}

#[test]
fn a_glide_on_the_turntable_arrives_before_it_turns_on() {
    let mut session = opened(still("a.m3d"));
    session.apply(CameraCommand::SetTurntable(true));
    session.apply(glide(CameraCommand::LookFrom(ViewPreset::Front)));
    for _ in 0..16 {
        session.advance(STEP_SECS);
    }
    let there = session.camera().yaw_radians;
    assert!(!(0.02..TAU - 0.02).contains(&there), "{there}");
    session.advance(1.0);
    assert!(session.camera().yaw_radians > 0.4);
}

#[test]
fn flight_covers_a_radius_a_second_or_four_and_no_more_across() {
    for (direction, fast, radii) in [
        (Vec3::Z, false, 1.0),
        (Vec3::NEG_X, false, 1.0),
        (Vec3::Y, true, 4.0),
        (Vec3::new(1.0, 0.0, 1.0), false, 1.0),
        (Vec3::new(0.0, 0.0, 0.5), false, 0.5),
        (Vec3::new(9.0, 0.0, 0.0), false, 1.0),
    ] {
        let mut session = opened(still("a.m3d"));
        let radius = session.world_bounds().radius();
        let from = *session.camera();
        session.apply(CameraCommand::Fly { direction, fast });
        assert!(session.is_moving());
        for _ in 0..60 {
            session.advance(STEP_SECS);
        }
        let way = session.camera().eye() - from.eye();
        assert!((way.length() / radius - radii).abs() < 1e-3, "{direction}: {way}");
        let seen = Vec3::new(way.dot(from.right()), way.y, way.dot(from.forward()));
        assert!(direction.x == 0.0 || direction.x * seen.x > 0.0, "{direction}: {way}");
        assert!(direction.z == 0.0 || direction.z * seen.z > 0.0, "{direction}: {way}");
        assert_eq!(session.camera().forward(), from.forward());
        session.apply(fly(Vec3::ZERO));
        assert!(!session.is_moving());
    }
}

#[test]
fn flight_ends_far_outside_and_a_flown_camera_stays_put_in_another_window() {
    let mut session = opened(still("a.m3d"));
    let bounds = session.world_bounds();
    session.apply(fly(Vec3::NEG_Z));
    for _ in 0..100 {
        session.advance(5.0);
    }
    let off = session.camera().eye().distance(bounds.center()) / bounds.radius();
    assert!((99.0..101.0).contains(&off), "{off}");
    // Who panned farther out is not pulled back.
    session.apply(CameraCommand::Pan {
        drag: Vec2::splat(50.0),
    });
    let outside = session.camera().eye();
    session.advance(0.01);
    assert!(session.camera().eye().distance(outside) < 0.1 * bounds.radius());
    session.apply(fly(Vec3::NAN));
    assert!(!session.is_moving());
    let here = *session.camera();
    session.apply(viewport(0.3));
    assert_eq!(session.camera(), &here);
}

#[test]
fn looking_around_turns_on_the_spot() {
    let mut session = opened(still("a.m3d"));
    let from = *session.camera();
    session.apply(CameraCommand::FlyLook {
        yaw_radians: 0.4,
        pitch_radians: 0.1,
    });
    let camera = session.camera();
    assert!(camera.eye().abs_diff_eq(from.eye(), 1e-4));
    assert!((turned(&from, camera) - 0.4).abs() < 1e-5);
    assert!(camera.forward().y > from.forward().y);
}

#[test]
fn no_plane_cuts_what_is_ahead_while_one_flies_through_the_model() {
    let mut session = opened(still("a.m3d"));
    let radius = session.world_bounds().radius();
    session.apply(CameraCommand::LookFrom(ViewPreset::Isometric));
    session.apply(fly(Vec3::Z));
    let mut was_inside = false;
    for _ in 0..600 {
        session.advance(STEP_SECS);
        let bounds = session.world_bounds();
        let camera = session.camera();
        let (near, far) = camera.depth_range(&bounds);
        let eye = camera.eye();
        let is_inside = eye.cmpge(bounds.min).all() && eye.cmple(bounds.max).all();
        was_inside |= is_inside;
        for corner in bounds.corners() {
            let depth = (corner - eye).dot(camera.forward());
            assert!(depth < far, "{depth} {far}");
            assert!(
                depth < 0.0 || depth > near || near < radius * 7e-3,
                "{near} cuts {depth}"
            );
        }
        assert!(0.0 < near && near < far);
        // 24 bits of depth over this span leave steps far finer than the model.
        assert!(far / near <= 1001.0, "{near} {far}");
        assert!(!is_inside || near <= radius * 7e-3, "{near} is a sheet before the eye");
    }
    assert!(was_inside);
}

#[test]
fn time_that_is_none_moves_no_camera() {
    let mut session = opened(still("a.m3d"));
    session.apply(CameraCommand::SetTurntable(true));
    let here = *session.camera();
    for dt_secs in [f32::NAN, f32::INFINITY, -1.0, 0.0] {
        session.advance(dt_secs);
        assert_eq!(session.camera(), &here);
    }
}
