//! While a clip plays, frames allocate nothing: all that a frame fills is kept for the next. What wgpu and egui allocate is theirs. Reading damaged files
//! takes memory by their size.

#[path = "../common/binary_fbx.rs"]
mod binary_fbx;
mod fbx;
#[path = "../common/shared.rs"]
mod shared;

use std::alloc::System;
use std::hint::black_box;

use alloc_tracker::{Allocator, Session as Tracker};
use bindpose::anim::{GhostPlan, SkinView};
use bindpose::model::JointIndex;
use bindpose::session::{Command, CrowdCommand, File, FileCommand, JointCommand, LookCommand, PlayCommand, Session};

#[global_allocator]
static ALLOCATOR: Allocator<System> = Allocator::system();

const FRAME_SECS: f32 = 1.0 / 60.0;
/// By then every buffer has its size, also where a clip begins anew.
const WARMING_FRAMES: u32 = 300;
const FRAMES: u32 = 300;

/// What this thread asked for during some work.
struct Measured {
    allocations: u64,
    /// The most that was held at once.
    peak_bytes: u64,
}

fn measured(work: impl FnOnce()) -> Measured {
    let tracker = Tracker::new().no_stdout().no_file();
    let operation = tracker.operation("frames");
    let span = operation.measure_thread().iterations(1);
    work();
    drop(span);
    let report = tracker.to_report();
    let (_, operation) = report.operations().next().expect("it was measured");
    Measured {
        allocations: operation.total_allocations_count(),
        peak_bytes: operation.peak_outstanding_bytes().expect("of one thread") as u64,
    }
}

/// How often this thread asked for memory during some work.
fn allocations(work: impl FnOnce()) -> u64 {
    measured(work).allocations
}

/// The sample, with what these commands make of it.
fn playing(commands: Vec<Command>) -> Session {
    let mut session = Session::new(false);
    let bytes = include_bytes!("../../web/sample/figure.m3d");
    session.apply(FileCommand::Add(vec![File::new("figure.m3d", &bytes[..])]));
    for command in commands {
        session.apply(command);
    }
    session.apply(PlayCommand::Play);
    session
}

/// One frame as the window has it, up to what a renderer is given. Gives how often memory was asked for.
fn frame(session: &mut Session) -> u64 {
    let count = allocations(|| {
        session.begin_pass(FRAME_SECS);
        session.advance(FRAME_SECS);
        session.follow_motion();
        black_box(session.frame());
    });
    session.take_events();
    count
}

#[test]
fn what_allocates_is_counted() {
    assert_eq!(allocations(|| drop(black_box(Vec::<u8>::with_capacity(8)))), 1);
    assert_eq!(allocations(|| ()), 0);
    assert_eq!(
        measured(|| drop(black_box(Vec::<u8>::with_capacity(800)))).peak_bytes,
        800
    );
}

#[test]
fn frames_of_a_clip_that_plays_allocate_nothing() {
    let joint = JointIndex(7);
    let ghosts = GhostPlan {
        before: 2,
        after: 2,
        step_frames: 4,
    };
    let blend = PlayCommand::SetBlend { clip: 1, weight: 0.5 };
    let ways: [(&str, Vec<Command>); 9] = [
        ("as it opens", vec![]),
        ("two clips", vec![blend.into()]),
        (
            "on the way to the bind pose",
            vec![PlayCommand::SetBindWeight(0.5).into()],
        ),
        (
            "bones",
            vec![
                LookCommand::SetBonesVisible(true).into(),
                JointCommand::Select(Some(joint)).into(),
            ],
        ),
        ("the path of a bone", vec![LookCommand::ToggleTrail(joint).into()]),
        (
            "ghosts",
            vec![
                LookCommand::SetGhosts(Some(ghosts)).into(),
                LookCommand::SetBindGhost(true).into(),
            ],
        ),
        (
            "stretch as colours",
            vec![LookCommand::SetSkinView(Some(SkinView::Stretch)).into()],
        ),
        ("two lights", vec![LookCommand::SetSplit(Some(0.5)).into()]),
        ("a crowd", vec![CrowdCommand::Set { count: 20, seed: 1 }.into()]),
    ];
    let mut told = Vec::new();
    for (name, commands) in ways {
        let mut session = playing(commands);
        for _ in 0..WARMING_FRAMES {
            frame(&mut session);
        }
        let poses = session.picture_revision();
        let count: u64 = (0..FRAMES).map(|_| frame(&mut session)).sum();
        assert!(session.picture_revision() >= poses + u64::from(FRAMES), "{name} moves");
        if count > 0 {
            told.push(format!("{name}: {count} in {FRAMES} frames"));
        }
    }
    assert!(told.is_empty(), "memory was asked for with {}", told.join("; "));
}
