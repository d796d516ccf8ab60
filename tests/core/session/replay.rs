//! What was recorded plays again: the same commands and times give the same state, to the bit.

use bindpose::anim::Palette;
use bindpose::scene::{FrameOptions, Overlay, Overlays, RenderFrame};
use bindpose::session::{CameraCommand, Changes, Command, CrowdCommand, File, FileCommand, PlayCommand, Session};
use glam::Vec3;
use proptest::prelude::*;

use super::models::{moving, still};
use super::random::{command, number};
use super::{dropped, viewport};
use crate::documents::soldier_bytes;

/// A command, or time that goes by.
#[derive(Clone, Debug, PartialEq)]
enum Step {
    Apply(Command),
    Advance(f32),
}

/// All that a session shows, numbers to the bit: the shortest digits of a float name it alone.
fn snapshot(session: &mut Session) -> String {
    let (pose, over) = {
        let frame = session.frame();
        let bits = |palette: &Palette| -> Vec<[u32; 12]> {
            let matrices = palette.0.iter();
            matrices
                .map(|matrix| matrix.to_cols_array().map(f32::to_bits))
                .collect()
        };
        let ghosts: Vec<_> = frame.ghosts.palettes.iter().map(bits).collect();
        let over = format!(
            "{ghosts:?} {:?} {:?} {:?} {:?}",
            frame.crowd, frame.ghosts.colors_srgb, frame.seen_through, frame.vertex_colors
        );
        (bits(frame.palette), over)
    };
    let events = session.take_events();
    let session = &*session;
    let time = (
        session.playback(),
        session.crowd(),
        session.frame_place(),
        session.is_scrubbing(),
        session.blend(),
    );
    let view = (
        session.camera(),
        session.handedness(),
        session.up_axis(),
        session.submeshes(),
        session.quality(),
    );
    let skeleton = (
        session.joints(),
        session.weighed_joint(),
        session.look().ghosts,
        session.look().bind_ghost,
        session.bind_weight(),
    );
    let look = (session.look(), session.sky_file().map(|file| &file.path));
    let revisions = (
        session.model_revision(),
        session.maps_revision(),
        session.picture_revision(),
    );
    let clips: Vec<_> = session.open_model().iter().flat_map(|open| open.clip_list()).collect();
    let notices: Vec<_> = session.diagnostics().collect();
    format!(
        "{pose:?} {over} {events:?} {time:?} {:?} {:?} {view:?} {skeleton:?} {look:?} {revisions:?} {clips:?} {notices:?} {:?} {:?}",
        session.clip_index(),
        (session.crossfade_secs(), session.is_fading(), session.is_moving()),
        session.error(),
        session.materials(),
    )
}

fn run(start: &[File], steps: &[Step]) -> Vec<String> {
    let mut session = dropped(start.to_vec());
    steps
        .iter()
        .map(|step| {
            let changes = take(&mut session, step.clone());
            format!("{changes:?} {}", snapshot(&mut session))
        })
        .collect()
}

fn take(session: &mut Session, step: Step) -> Changes {
    match step {
        Step::Apply(command) => session.apply(command),
        Step::Advance(dt_secs) => session.advance(dt_secs),
    }
}

/// All that a renderer is told, but for the counter of the vertex colours: of the scene, and of what lies over it.
fn told_to_renderer(session: &mut Session) -> [String; 2] {
    let RenderFrame {
        camera,
        world_from_model,
        world_bounds,
        ground,
        mesh: _,
        palette,
        crowd,
        hidden_submeshes,
        highlighted_submesh,
        vertex_colors,
        ghosts,
        seen_through,
        sample: _,
        options,
    } = session.frame();
    let colors = vertex_colors.map(|colors| colors.colors_srgb);
    let mut lines = Overlays::default();
    lines.set(Overlay::Grid, options.overlays.has(Overlay::Grid));
    let of_scene = FrameOptions {
        overlays: lines,
        ..options
    };
    [
        format!(
            "{camera:?} {world_from_model:?} {world_bounds:?} {ground:?} {palette:?} {crowd:?} {hidden_submeshes:?} {colors:?} {of_scene:?}"
        ),
        format!(
            "{highlighted_submesh:?} {ghosts:?} {seen_through:?} {:?}",
            options.overlays
        ),
    ]
}

fn steps(most: usize) -> impl Strategy<Value = Vec<Step>> {
    let step = prop_oneof![2 => command().prop_map(Step::Apply), 1 => number().prop_map(Step::Advance)];
    prop::collection::vec(step, 1..most)
}

proptest! {
    #![proptest_config(crate::properties::cases(48))]

    #[test]
    fn a_recorded_list_gives_the_same_state_again(steps in steps(40)) {
        let start = [moving("a.m3d"), still("c.m3d")];
        // A recording is kept apart from what it was made of.
        let recorded: Vec<Step> = steps.clone();
        let (first, again) = (run(&start, &steps), run(&start, &recorded));
        for (step, (first, again)) in steps.iter().zip(first.iter().zip(&again)) {
            prop_assert_eq!(first, again, "{:?}", step);
        }
    }
}

proptest! {
    #![proptest_config(crate::properties::cases(48))]

    #[test]
    fn a_frame_that_differs_is_told_as_a_change_of_the_picture(steps in steps(40)) {
        each_change_is_told(steps)?;
    }
}

/// After each step the picture is told as changed if the frame differs, and the scene if that does.
fn each_change_is_told(steps: Vec<Step>) -> Result<(), TestCaseError> {
    let mut session = dropped(vec![moving("a.m3d"), still("c.m3d")]);
    let revisions = |session: &Session| [session.scene_revision(), session.picture_revision()];
    let mut before = (told_to_renderer(&mut session), revisions(&session));
    for step in steps {
        let changes = take(&mut session, step.clone());
        let now = (told_to_renderer(&mut session), revisions(&session));
        prop_assert!(now.0 == before.0 || changes.picture, "{:?}: {changes:?}", step);
        prop_assert!(now.0[0] == before.0[0] || changes.scene, "{:?}: {changes:?}", step);
        prop_assert!(changes.picture || !changes.scene);
        let told = [changes.scene, changes.picture];
        prop_assert_eq!([0, 1].map(|of| now.1[of] > before.1[of]), told);
        before = now;
    }
    Ok(())
}

/// The shape of the picture decides which instances are in sight, although the camera stays where it is after a flight.
#[test]
fn another_shape_of_a_crowds_picture_is_told() {
    let fly = CameraCommand::Fly {
        direction: Vec3::new(2.143_096_7, 0.0, -0.639_14),
        fast: false,
    };
    let narrow = viewport(0.231_031_75);
    each_change_is_told(vec![
        Step::Apply(CrowdCommand::Set { count: 2, seed: 0 }.into()),
        Step::Advance(0.182_157_43),
        Step::Apply(fly.into()),
        Step::Advance(1.359_390_5),
        Step::Apply(narrow.into()),
    ])
    .unwrap();
}

#[test]
fn a_session_with_a_real_file_plays_again() {
    let Some(bytes) = soldier_bytes() else { return };
    let soldier = File::new("soldier.m3d", bytes);
    let mut steps = vec![
        Step::Apply(FileCommand::AddClips(vec![soldier.clone()]).into()),
        Step::Apply(PlayCommand::SetCrossfade(0.2).into()),
        Step::Apply(PlayCommand::SetSpeed(0.37).into()),
        Step::Apply(PlayCommand::SetRangeStart(Some(0.3)).into()),
    ];
    for turn in 0..60 {
        steps.push(Step::Advance(0.016_683_351));
        if turn % 10 == 9 {
            steps.push(Step::Apply(PlayCommand::CycleClip(1).into()));
        }
    }
    let (first, again) = (
        run(std::slice::from_ref(&soldier), &steps),
        run(std::slice::from_ref(&soldier), &steps),
    );
    assert!(first == again && first.first() != first.last());
}
