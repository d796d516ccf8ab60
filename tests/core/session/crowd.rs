//! Several instances of the open model: what each shows, where it stands, which one is selected.

use bindpose::anim::{LoopMode, PoseBuffers, WrapMode};
use bindpose::model::UpAxis;
use bindpose::scene::{Aabb, CrowdInstance, RenderFrame};
use bindpose::session::{
    CameraCommand, Command, CrowdCommand, CrowdState, File, FileCommand, HistoryCommand, JointCommand, MAX_CROWD,
    PlayCommand, QualityCommand, QualityMode, Session, SubmeshCommand, ViewState,
};
use glam::{Affine3A, Vec2, Vec3};

use super::models::{jointed, moving, still};
use super::{in_picture, on_screen, opened, orbit, zoom};
use crate::documents::soldier_bytes;

fn set(session: &mut Session, count: usize, seed: u32) {
    session.apply(CrowdCommand::Set { count, seed });
}

fn select(session: &mut Session, instance: usize) {
    session.apply(CrowdCommand::Select(instance));
}

/// A crowd of the model that moves, at rest.
fn crowd(count: usize, seed: u32) -> Session {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    set(&mut session, count, seed);
    settle(&mut session);
    session
}

/// Lets the camera come to where it was sent.
fn settle(session: &mut Session) {
    session.apply(CameraCommand::BeginDrag);
    session.apply(CameraCommand::EndDrag);
    session.apply(CameraCommand::FrameModel);
}

fn bits(palette: &[Affine3A]) -> Vec<[u32; 12]> {
    let matrices = palette.iter();
    matrices
        .map(|matrix| matrix.to_cols_array().map(f32::to_bits))
        .collect()
}

/// Place and palette of each of the others, sorted by place.
type Figures = Vec<([u32; 3], Vec<[u32; 12]>)>;

fn figures(frame: &RenderFrame<'_>) -> Figures {
    let joints = frame.palette.0.len();
    let figure = |instance: &CrowdInstance| {
        let start = instance.palette as usize * joints;
        let place = Vec3::from(instance.world_from_model.translation);
        (
            place.to_array().map(f32::to_bits),
            bits(&frame.crowd.palettes[start..start + joints]),
        )
    };
    let mut figures: Figures = frame.crowd.instances.iter().map(figure).collect();
    figures.sort();
    figures
}

/// Where the selected instance stands, its clip and its time.
fn selected(session: &mut Session) -> (Vec3, Option<usize>, f32) {
    let place = session.frame().world_from_model.translation;
    (place.into(), session.clip_index(), session.playback().time_secs())
}

/// The same of every instance, in their order.
fn all(session: &Session) -> Vec<(Vec3, Option<usize>, f32)> {
    let mut session = session.clone();
    (0..session.crowd().count)
        .map(|instance| {
            select(&mut session, instance);
            selected(&mut session)
        })
        .collect()
}

/// All palettes of a frame are those that a single character has at the clips and times of [`all`].
fn assert_posed(session: &mut Session) {
    let each = all(session);
    let first = session.crowd().selected;
    let weight = session.bind_weight();
    let open = session.open_model().expect("open").clone();
    let mut expected: Figures = Vec::new();
    for (place, clip, time_secs) in each
        .iter()
        .enumerate()
        .filter_map(|(i, each)| (i != first).then_some(*each))
    {
        let mut buffers = PoseBuffers::for_skeleton(&open.model.skeleton);
        if let Some(clip) = clip {
            buffers.evaluate(&open.model.skeleton, &open.compiled[clip], time_secs);
            buffers.bring_toward_bind(&open.model.skeleton, weight);
        }
        expected.push((place.to_array().map(f32::to_bits), bits(&buffers.palette.0)));
    }
    expected.sort();
    assert!(figures(&session.frame()) == expected);
}

#[test]
fn the_first_stays_as_it_is_and_the_others_have_clips_and_times_of_their_own() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    session.apply(PlayCommand::Seek { time_secs: 0.4 });
    let (before, palette) = (selected(&mut session), session.frame().palette.clone());
    set(&mut session, 60, 1);
    assert_eq!(selected(&mut session), before);
    assert_eq!(bits(&session.frame().palette.0), bits(&palette.0));
    let each = all(&session);
    for clip in 0..3 {
        assert!(each.iter().filter(|each| each.1 == Some(clip)).count() > 8, "{each:?}");
    }
    let times: std::collections::BTreeSet<u32> = each.iter().map(|each| each.2.to_bits()).collect();
    assert!(times.len() > 30, "only the clip of one key has equal times");
    assert_posed(&mut session);
}

#[test]
fn a_crowd_is_that_of_its_seed_and_grows_without_moving_anybody() {
    let (small, large) = (crowd(10, 4), crowd(50, 4));
    assert_eq!(all(&small), all(&large)[..10]);
    let mut grown = small.clone();
    set(&mut grown, 50, 4);
    assert_eq!(all(&grown), all(&large));
    set(&mut grown, 10, 4);
    assert_eq!(all(&grown), all(&small));
    set(&mut grown, 10, 5);
    let (before, after) = (all(&small), all(&grown));
    assert_eq!(before[0], after[0]);
    let stayed = before
        .iter()
        .zip(&after)
        .skip(1)
        .filter(|(before, after)| before.0 == after.0);
    assert_eq!(stayed.count(), 0, "another seed, other places");
    assert_ne!(
        before[1..].iter().map(|each| each.1).collect::<Vec<_>>(),
        after[1..].iter().map(|each| each.1).collect::<Vec<_>>()
    );
}

#[test]
fn counts_are_clamped_and_nothing_has_no_crowd() {
    let mut session = crowd(5, 1);
    for (count, expected) in [(0, 1), (usize::MAX, MAX_CROWD), (1, 1), (2, 2)] {
        set(&mut session, count, 9);
        assert_eq!(
            session.crowd(),
            CrowdState {
                count: expected,
                seed: 9,
                selected: 0
            }
        );
    }
    select(&mut session, 2);
    assert_eq!(session.crowd().selected, 0, "there is no third");
    let mut empty = Session::new(false);
    set(&mut empty, 5, 1);
    assert_eq!(
        (empty.crowd(), empty.frame().crowd.instances.len()),
        (CrowdState::default(), 0)
    );
}

#[test]
fn nobody_stands_in_another_whichever_axis_is_up() {
    for up_axis in [UpAxis::Y, UpAxis::Z] {
        let mut session = crowd(30, 2);
        session.apply(Command::SetUpAxis(Some(up_axis)));
        let mut alone = opened(moving("a.m3d"));
        alone.apply(Command::SetUpAxis(Some(up_axis)));
        let bind = alone.open_model().expect("open").bind_bounds;
        let size = bind.transformed(alone.frame().world_from_model).size();
        let places: Vec<Vec3> = all(&session).into_iter().map(|each| each.0).collect();
        for (index, a) in places.iter().enumerate() {
            assert_eq!(a.y, places[0].y, "all stand on the ground");
            for b in &places[..index] {
                let apart = (*a - *b).abs();
                assert!(apart.x > size.x * 0.5 || apart.z > size.z * 0.5, "{a} {b} {size}");
            }
        }
        assert_posed(&mut session);
    }
}

#[test]
fn time_goes_by_for_all_and_each_comes_round_in_its_own_clip() {
    let mut session = opened(moving("a.m3d"));
    set(&mut session, 30, 3);
    session.apply(PlayCommand::SetSpeed(0.5));
    let mut apart: Vec<Session> = (0..30)
        .map(|instance| {
            let mut one = session.clone();
            select(&mut one, instance);
            set(&mut one, 30, 3);
            one
        })
        .collect();
    for dt_secs in [0.1, 0.7, 0.016, 3.3] {
        session.advance(dt_secs);
        let expected: Vec<_> = apart
            .iter_mut()
            .map(|one| {
                one.advance(dt_secs);
                selected(one)
            })
            .collect();
        assert_eq!(all(&session), expected);
    }
    session.apply(PlayCommand::Pause);
    let paused = all(&session);
    session.advance(1.0);
    assert_eq!(all(&session), paused);
    session.apply(PlayCommand::ToggleBackward);
    session.advance(0.25);
    let spans = |session: &Session, clip: Option<usize>| {
        let clip = &session.open_model().expect("open").model.clips[clip.expect("a clip")];
        [clip.start_secs, clip.end_secs]
    };
    for (was, is) in paused.iter().zip(all(&session)) {
        let [start_secs, end_secs] = spans(&session, was.1);
        let back = was.2 - 0.125;
        let expected = match end_secs - start_secs {
            0.0 => start_secs,
            length if back < start_secs => back + length,
            _ => back,
        };
        assert!((is.2 - expected).abs() < 1e-5, "{was:?} {is:?}");
    }
}

#[test]
fn a_sought_time_moves_all_by_the_same_seconds_and_back() {
    let mut session = crowd(30, 3);
    session.apply(PlayCommand::Seek { time_secs: 0.25 });
    let before = all(&session);
    session.apply(PlayCommand::BeginScrub);
    for time_secs in [0.3, 0.9, 0.1] {
        session.apply(PlayCommand::Seek { time_secs });
        assert_posed(&mut session);
    }
    session.apply(PlayCommand::EndScrub);
    assert_ne!(all(&session), before);
    session.apply(PlayCommand::Seek { time_secs: 0.25 });
    for (was, is) in before.iter().zip(all(&session)) {
        assert!((was.2 - is.2).abs() < 1e-6, "{was:?} {is:?}");
    }
    // Going there first or afterwards is the same.
    let mut sought_first = opened(moving("a.m3d"));
    sought_first.apply(PlayCommand::Pause);
    sought_first.apply(PlayCommand::Seek { time_secs: 0.25 });
    set(&mut sought_first, 30, 3);
    for (was, is) in before.iter().zip(all(&sought_first)) {
        assert!((was.2 - is.2).abs() < 1e-6, "{was:?} {is:?}");
    }
    session.apply(PlayCommand::StepFrames(3));
    let stepped = all(&session);
    let step_secs = stepped[0].2 - before[0].2;
    let moved = before
        .iter()
        .zip(&stepped)
        .filter(|(was, is)| (is.2 - was.2 - step_secs).abs() < 1e-4);
    assert!(moved.count() > 15, "{stepped:?}");
}

#[test]
fn a_sought_time_and_back_leaves_all_as_they_were_in_clips_that_play_once() {
    let mut session = crowd(20, 3);
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.apply(PlayCommand::Seek { time_secs: 0.25 });
    let before = all(&session);
    session.apply(PlayCommand::SeekEnd);
    session.apply(PlayCommand::Seek { time_secs: 0.25 });
    for (was, is) in before.iter().zip(all(&session)) {
        assert!((was.2 - is.2).abs() < 1e-6, "{was:?} {is:?}");
    }
}

#[test]
fn played_once_all_stop_with_the_selected_one() {
    let mut session = opened(moving("a.m3d"));
    set(&mut session, 30, 3);
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.advance(0.9);
    assert!(session.playback().is_playing());
    session.advance(0.2);
    assert!(!session.playback().is_playing() && !session.is_animating());
    let stopped = all(&session);
    session.advance(1.0);
    assert_eq!(all(&session), stopped);
    session.apply(PlayCommand::Play);
    session.advance(0.1);
    assert!(
        all(&session)
            .iter()
            .zip(&stopped)
            .filter(|(now, then)| now.2 != then.2)
            .count()
            > 15
    );
}

/// The selected clip may have a single key: the others play all the same.
#[test]
fn others_move_beside_one_whose_clip_has_no_length() {
    let mut session = opened(moving("a.m3d"));
    set(&mut session, 10, 3);
    session.apply(PlayCommand::SelectClip(2));
    session.apply(PlayCommand::SetCrossfade(0.0));
    assert!(session.is_animating());
    let (before, revision) = (all(&session), session.picture_revision());
    session.advance(0.1);
    assert_ne!(all(&session), before);
    assert!(session.picture_revision() > revision);
    set(&mut session, 1, 3);
    session.advance(1.0);
    assert!(!session.is_animating());
}

#[test]
fn speed_and_ends_are_for_all_and_clip_range_and_blend_for_one() {
    let mut session = crowd(6, 3);
    session.apply(PlayCommand::SetSpeed(2.0));
    session.apply(PlayCommand::SetLoopMode(LoopMode::PingPong));
    session.apply(PlayCommand::SetWrapMode(WrapMode::BookDemo));
    let clips: Vec<_> = all(&session).into_iter().map(|each| each.1).collect();
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SetRangeEnd(Some(1.0)));
    session.apply(PlayCommand::SetBlend { clip: 0, weight: 0.5 });
    for (instance, clip) in clips.iter().enumerate().skip(1) {
        select(&mut session, instance);
        let playback = session.playback();
        assert_eq!(
            (playback.speed(), playback.loop_mode(), playback.wrap_mode()),
            (2.0, LoopMode::PingPong, WrapMode::BookDemo)
        );
        assert_eq!(
            (session.clip_index(), playback.range_secs(), session.blend()),
            (*clip, None, None)
        );
    }
    select(&mut session, 0);
    assert_eq!(
        (session.clip_index(), session.playback().range_secs()),
        (Some(1), Some([0.5, 1.0]))
    );
    assert_eq!(session.blend(), None, "what is blended in ends with the selection");
    for weight in [0.3, 1.0] {
        session.apply(PlayCommand::SetBindWeight(weight));
        assert_posed(&mut session);
    }
}

#[test]
fn a_fade_ends_when_another_is_selected() {
    let mut session = opened(moving("a.m3d"));
    set(&mut session, 3, 1);
    session.apply(PlayCommand::SelectClip(1));
    session.advance(0.05);
    assert!(session.is_fading());
    select(&mut session, 1);
    assert!(!session.is_fading());
    assert_posed(&mut session);
}

#[test]
fn what_is_read_out_is_of_the_selected_instance() {
    let mut session = crowd(5, 2);
    let each = all(&session);
    let before = session.bones().bones().to_vec();
    select(&mut session, 3);
    assert_eq!(selected(&mut session), each[3]);
    assert_eq!(session.crowd().selected, 3);
    let after = session.bones().bones().to_vec();
    assert_ne!(before[0].from, after[0].from);
    assert!((after[0].from - each[3].0).length() < (before[0].from - each[3].0).length());
    assert_posed(&mut session);
}

#[test]
fn models_without_clips_or_bones_have_crowds_too() {
    for file in [jointed("j.m3d"), still("s.m3d")] {
        let mut session = opened(file);
        let bones = session.frame().palette.0.len();
        set(&mut session, 12, 1);
        let frame = session.frame();
        assert_eq!(frame.crowd.instances.len(), 11);
        assert_eq!(frame.crowd.palettes, vec![Affine3A::IDENTITY; bones]);
        assert!(frame.crowd.instances.iter().all(|instance| instance.palette == 0));
        session.apply(PlayCommand::Play);
        session.advance(0.5);
        assert!(!session.is_animating());
    }
}

fn is_in_picture(session: &mut Session, world: Vec3) -> bool {
    let place = in_picture(session, world);
    place.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&place.z)
}

#[test]
fn the_camera_frames_all_and_then_one_again() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    let alone = (*session.camera(), session.world_bounds());
    set(&mut session, 40, 1);
    assert!(session.is_moving(), "it glides there");
    session.advance(1.0);
    let bounds = session.world_bounds();
    let bind = session.open_model().expect("open").bind_bounds;
    for (place, ..) in all(&session) {
        let world_from_model = session.frame().world_from_model;
        for corner in bind.transformed(world_from_model).corners() {
            let corner = corner + place - all(&session)[0].0;
            assert!(
                bounds.min.cmple(corner).all() && corner.cmple(bounds.max).all(),
                "{corner} {bounds:?}"
            );
        }
        assert!(is_in_picture(&mut session, place), "{place}");
    }
    let of_all = *session.camera();
    session.apply(CameraCommand::FrameSelection);
    assert!(session.camera().distance < of_all.distance / 3.0);
    select(&mut session, 20);
    let target = session.camera().target;
    session.apply(CameraCommand::FrameSelection);
    assert!(
        (session.camera().target - target).length() > 1.0,
        "another instance is framed"
    );
    session.apply(CameraCommand::FrameModel);
    assert_eq!(session.camera().target, of_all.target);
    set(&mut session, 1, 1);
    session.advance(1.0);
    assert!((session.camera().distance - alone.0.distance).abs() < 1e-5);
    assert_eq!(session.world_bounds(), alone.1);
}

/// The middle of an instance's box in the picture.
fn middle_of(session: &mut Session, instance: usize) -> Vec2 {
    let place = all(session)[instance].0 - selected(session).0;
    let bind = session.open_model().expect("open").bind_bounds;
    let middle = bind.transformed(session.frame().world_from_model).center() + place;
    on_screen(session, middle)
}

/// The nearest hit of every instance on its own.
fn nearest_apart(session: &Session, pointer: Vec2) -> Option<(usize, f32)> {
    let mut nearest: Option<(usize, f32)> = None;
    for instance in 0..session.crowd().count {
        let mut one = session.clone();
        select(&mut one, instance);
        let world_from_model = one.frame().world_from_model;
        let bounds = one.world_bounds();
        let ray = one.camera().ray(pointer, 1.0, &bounds);
        let mut positions = Vec::new();
        let palette = one.frame().palette.clone();
        let mesh = &one.open_model().expect("open").model.mesh;
        bindpose::anim::skin_positions(mesh, &palette, &mut positions);
        let hit = bindpose::scene::pick(mesh, &positions, world_from_model, ray, &mut Vec::new(), |_| true);
        if let Some(hit) = hit
            && nearest.is_none_or(|(_, distance)| hit.distance < distance)
        {
            nearest = Some((instance, hit.distance));
        }
    }
    nearest
}

#[test]
fn what_is_picked_is_what_the_ray_meets_first_of_all_instances() {
    let mut session = crowd(12, 2);
    let mut met = std::collections::BTreeSet::new();
    for row in 0..15 {
        for column in 0..15 {
            let pointer = Vec2::new(column as f32, row as f32) / 7.0 - 1.003;
            let expected = nearest_apart(&session, pointer);
            let hit = session.pick(pointer);
            assert_eq!(
                hit.map(|hit| hit.distance),
                expected.map(|(_, distance)| distance),
                "{pointer}"
            );
            let mut clicked = session.clone();
            clicked.apply(SubmeshCommand::SelectAt(pointer));
            assert_eq!(clicked.submeshes().selected(), expected.map(|_| 0));
            assert_eq!(clicked.crowd().selected, expected.map_or(0, |(instance, _)| instance));
            met.extend(expected.map(|(instance, _)| instance));
        }
    }
    assert!(met.len() > 6, "{met:?}");
}

#[test]
fn a_click_selects_the_instance_and_what_it_met_of_it() {
    let mut session = crowd(3, 2);
    let at = middle_of(&mut session, 2);
    session.apply(SubmeshCommand::HoverAt(Some(at)));
    assert_eq!(
        session.submeshes().hovered(),
        None,
        "what stands out is of the selected instance"
    );
    session.apply(JointCommand::SelectAt(at));
    assert_eq!(session.crowd().selected, 2);
    assert!(session.joints().selected().is_some());
    session.apply(SubmeshCommand::HoverAt(Some(at)));
    assert_eq!(session.submeshes().hovered(), Some(0));
    let beside = Vec2::new(0.99, 0.99);
    session.apply(JointCommand::SelectAt(beside));
    assert_eq!((session.crowd().selected, session.joints().selected()), (2, None));
}

#[test]
fn a_crowd_is_no_step_and_a_range_goes_back_to_the_instance_that_had_it() {
    let mut session = crowd(4, 1);
    let steps = session.history().undo_label().map(str::to_owned);
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SetRangeEnd(Some(1.0)));
    let range = session.playback().range_secs();
    select(&mut session, 2);
    set(&mut session, 5, 1);
    let (_, clip, _) = selected(&mut session);
    let at = middle_of(&mut session, 3);
    session.apply(SubmeshCommand::SelectAt(at));
    assert_ne!(session.history().undo_label().map(str::to_owned), steps);
    assert_eq!(session.history().undo_label(), Some("set the range"));
    session.apply(HistoryCommand::Undo);
    assert_eq!((session.crowd().selected, session.playback().range_secs()), (0, None));
    session.apply(HistoryCommand::Redo);
    assert_eq!(session.playback().range_secs(), range);
    select(&mut session, 2);
    assert_eq!((session.clip_index(), session.playback().range_secs()), (clip, None));
}

#[test]
fn another_model_is_alone_and_the_same_file_again_keeps_its_crowd() {
    let mut session = crowd(8, 5);
    select(&mut session, 3);
    let before = all(&session);
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert_eq!(
        session.crowd(),
        CrowdState {
            count: 8,
            seed: 5,
            selected: 3
        }
    );
    assert_eq!(all(&session), before);
    assert_posed(&mut session);
    session.apply(FileCommand::Add(vec![jointed("a.m3d")]));
    assert_eq!(session.crowd().count, 8, "the same file without its clips");
    assert!(all(&session).iter().all(|each| each.1.is_none()));
    session.apply(FileCommand::AddClips(vec![moving("b.m3d")]));
    assert!(all(&session).iter().all(|each| each.1.is_some()));
    assert_posed(&mut session);
    session.apply(FileCommand::Add(vec![still("c.m3d")]));
    assert_eq!(session.crowd(), CrowdState::default());
}

#[test]
fn what_the_gpu_refuses_leaves_the_crowd_of_before() {
    let mut session = crowd(8, 5);
    select(&mut session, 2);
    session.confirm_uploads();
    let before = all(&session);
    session.apply(FileCommand::Add(vec![still("c.m3d")]));
    session.go_back("it is too large");
    assert_eq!(all(&session), before);
    assert_posed(&mut session);
}

#[test]
fn a_view_carries_its_crowd_and_older_views_have_none() {
    let mut session = crowd(9, 6);
    session.apply(PlayCommand::Seek { time_secs: 0.3 });
    let frame = figures(&session.frame());
    let state = session.view_state();
    assert_eq!(
        state.crowd,
        CrowdState {
            count: 9,
            seed: 6,
            selected: 0
        }
    );
    let mut restored = opened(moving("a.m3d"));
    restored.apply(Command::Restore(Box::new(state.clone())));
    assert_eq!(restored.view_state(), state);
    assert_eq!(
        figures(&restored.frame()),
        frame,
        "clips, times and places are those of the seed"
    );
    select(&mut session, 4);
    let state = session.view_state();
    restored.apply(Command::Restore(Box::new(state.clone())));
    assert_eq!(restored.view_state(), state);
    assert_eq!(selected(&mut restored), selected(&mut session));
    let text = serde_json::to_string(&ViewState {
        crowd: CrowdState {
            count: 5_000,
            seed: 1,
            selected: 9_000,
        },
        ..state
    })
    .expect("plain data");
    restored.apply(Command::Restore(Box::new(
        serde_json::from_str(&text).expect("the same"),
    )));
    assert_eq!(
        restored.crowd(),
        CrowdState {
            count: MAX_CROWD,
            seed: 1,
            selected: MAX_CROWD - 1
        }
    );
    restored.apply(Command::Restore(Box::new(
        serde_json::from_str("{}").expect("all by default"),
    )));
    assert_eq!(restored.crowd(), CrowdState::default());
    assert_eq!(selected(&mut restored).0, Vec3::ZERO);
}

/// A pass of the window, in which the picture moves.
fn pass(session: &mut Session, dt_secs: f32) {
    session.begin_pass(dt_secs);
    session.advance(dt_secs);
    session.follow_motion();
}

/// A playing crowd of which some are out of sight and some are small.
fn deep(mode: QualityMode) -> Session {
    let mut session = opened(moving("a.m3d"));
    session.apply(QualityCommand::SetMode(mode));
    set(&mut session, 300, 1);
    session.advance(1.0);
    session.apply(zoom(0.3));
    session
}

/// How many of the others in sight, and of those out of it, changed their palettes.
fn changed(before: &Figures, after: &Figures) -> usize {
    before
        .iter()
        .zip(after)
        .filter(|(before, after)| before != after)
        .count()
}

#[test]
fn who_is_out_of_sight_is_posed_every_eighth_time_until_the_picture_rests() {
    let mut session = deep(QualityMode::Auto);
    pass(&mut session, 0.016);
    let frame = session.frame();
    let (in_sight, count) = (frame.crowd.in_sight, frame.crowd.instances.len());
    assert!(in_sight > 20 && count - in_sight > 50, "{in_sight} of {count}");
    let before = figures(&session.frame());
    pass(&mut session, 0.016);
    let after = figures(&session.frame());
    let once = changed(&before, &after);
    assert!(
        once > in_sight / 2 && once < count * 3 / 5,
        "{once} changed, {in_sight} of {count} are in sight"
    );
    for _ in 0..8 {
        pass(&mut session, 0.016);
        session.frame();
    }
    let all_turns = changed(&after, &figures(&session.frame()));
    assert!(all_turns > count / 2, "each has its turn: {all_turns}");

    // At rest all are posed, and the picture is drawn once more for it.
    session.apply(PlayCommand::Pause);
    session.follow_motion();
    let (revision, rests_in_secs) = (session.picture_revision(), session.quality().rests_in_secs());
    assert!(rests_in_secs.is_some_and(|secs| secs < 0.2));
    session.begin_pass(0.5);
    session.follow_motion();
    assert!(session.picture_revision() > revision);
    assert_eq!(session.quality().rests_in_secs(), None);
    assert_posed(&mut session);
}

#[test]
fn with_full_quality_and_for_a_picture_at_rest_all_are_posed_all_the_time() {
    let mut session = deep(QualityMode::Full);
    for _ in 0..3 {
        pass(&mut session, 0.016);
        assert_posed(&mut session);
    }
    let mut session = deep(QualityMode::Auto);
    for _ in 0..3 {
        pass(&mut session, 0.016);
        session.frame();
    }
    let mut still = session.clone();
    still.apply(PlayCommand::Pause);
    still.begin_pass(1.0);
    still.follow_motion();
    let exact = figures(&still.frame());
    assert_ne!(figures(&session.frame()), exact);
    assert_eq!(figures(&session.frame_at_rest()), exact);
}

#[test]
fn those_in_sight_come_first_and_buffers_stay_where_they_are() {
    let mut session = deep(QualityMode::Auto);
    let mut places = std::collections::BTreeSet::new();
    for step in 0..30 {
        session.apply(orbit(0.3, if step % 2 == 0 { 0.1 } else { -0.1 }));
        pass(&mut session, 0.016);
        let bounds: Aabb = session.world_bounds();
        let frame = session.frame();
        let clip_from_world = frame.camera.clip_from_view(1.0, &bounds) * frame.camera.view_from_world();
        for instance in &frame.crowd.instances[frame.crowd.in_sight..] {
            let foot = Vec3::from(instance.world_from_model.translation);
            let clip = clip_from_world * foot.extend(1.0);
            assert!(
                clip.w <= 0.0 || clip.x.abs() > clip.w || clip.y.abs() > clip.w,
                "{foot} is in the picture"
            );
        }
        places.insert((
            frame.crowd.instances.as_ptr() as usize,
            frame.crowd.palettes.as_ptr() as usize,
        ));
    }
    assert_eq!(places.len(), 1);
}

#[test]
fn a_thousand_soldiers_stand_apart_and_are_posed_exactly() {
    let Some(bytes) = soldier_bytes() else { return };
    let mut session = opened(File::new("soldier.m3d", bytes));
    set(&mut session, MAX_CROWD, 1);
    session.advance(1.0);
    session.apply(PlayCommand::Pause);
    let frame = session.frame();
    assert_eq!(frame.crowd.instances.len(), MAX_CROWD - 1);
    assert_eq!(frame.crowd.in_sight, MAX_CROWD - 1, "the camera frames all of them");
    assert_posed(&mut session);
}

/// The window marks the place of the selected instance with a ring on the ground; a picture that is saved has none.
#[test]
fn the_selected_one_stands_in_a_ring() {
    let mut session = crowd(5, 3);
    for instance in [0, 3, 1] {
        select(&mut session, instance);
        let frame = session.frame();
        let (place, ring) = (
            frame.world_from_model.translation,
            &frame.seen_through.expect("it has a ring").triangles,
        );
        let middle = ring.iter().map(|corner| Vec3::from(corner.position)).sum::<Vec3>() / ring.len() as f32;
        let away = (middle - Vec3::from(place)).with_y(0.0).length();
        let radius = (Vec3::from(ring[0].position) - middle).length();
        assert!(away < radius, "{instance}: {away} from the place, {radius} around it");
        assert!(
            session
                .frame_at_rest()
                .seen_through
                .is_none_or(|shapes| shapes.triangles.is_empty())
        );
    }
    set(&mut session, 1, 3);
    assert!(
        session
            .frame()
            .seen_through
            .is_none_or(|shapes| shapes.triangles.is_empty())
    );
}
