//! Whatever a person does, in whatever order, the session stays in order.

use std::collections::BTreeSet;

use bindpose::anim::{Direction, GhostPlan, LoopMode, MAX_SPEED, MIN_SPEED, SkinView, WrapMode};
use bindpose::model::{
    AlphaMode, Handedness, JointIndex, Material, Reflectance, SavedNames, UpAxis, hierarchy_fingerprint,
};
use bindpose::scene::{BoneStyle, Insets, Overlay, Theme, ViewPreset};
use bindpose::session::{
    CameraCommand, Command, CrowdCommand, CrowdState, Event, File, FileCommand, HistoryCommand, JointCommand,
    LookCommand, MaterialCommand, NameCommand, PlayCommand, Session, SubmeshCommand,
};
use glam::{Vec2, Vec3};
use proptest::prelude::*;

use super::joints::{seen_through, skin_colors};
use super::models::cube;
use super::models::{self, broken, jointed, moving, still};
use super::submeshes::parted;
use crate::chains::mirrored;

/// Numbers as pointers and programs give them, and those that they should not.
pub(super) fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -3.0f32..3.0,
        1 => prop::sample::select(vec![0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e-40, 1e12]),
    ]
}

fn vector() -> impl Strategy<Value = Vec2> {
    (number(), number()).prop_map(Vec2::from)
}

fn files() -> impl Strategy<Value = Vec<File>> {
    let one = prop::sample::select(vec![
        moving("a.m3d"),
        moving("b.m3d"),
        jointed("a.m3d"),
        still("c.m3d"),
        models::file("d.m3d", &mirrored(7)),
        broken("a.m3d"),
        models::file("a.m3d", &parted(models::document())),
        File::new("skin.dds", *b"not looked at"),
        cube("sky.dds", 2, [7; 4]),
    ]);
    prop::collection::vec(one, 0..3)
}

fn moving_camera() -> impl Strategy<Value = CameraCommand> {
    let pair = || (number(), number());
    prop_oneof![
        Just(CameraCommand::BeginDrag),
        Just(CameraCommand::EndDrag),
        pair().prop_map(|(yaw_radians_per_sec, pitch_radians_per_sec)| CameraCommand::Fling {
            yaw_radians_per_sec,
            pitch_radians_per_sec
        }),
        any::<bool>().prop_map(CameraCommand::SetTurntable),
        Just(CameraCommand::ToggleTurntable),
        (pair(), number(), any::<bool>()).prop_map(|((x, y), z, fast)| CameraCommand::Fly {
            direction: Vec3::new(x, y, z),
            fast
        }),
        pair().prop_map(|(yaw_radians, pitch_radians)| CameraCommand::FlyLook {
            yaw_radians,
            pitch_radians
        }),
    ]
}

fn submesh_command() -> impl Strategy<Value = SubmeshCommand> {
    prop_oneof![
        (0usize..4, any::<bool>()).prop_map(|(submesh, visible)| SubmeshCommand::SetVisible { submesh, visible }),
        (0usize..4).prop_map(SubmeshCommand::Solo),
        Just(SubmeshCommand::ShowAll),
        prop::option::of(0usize..4).prop_map(SubmeshCommand::Select),
        vector().prop_map(SubmeshCommand::SelectAt),
        prop::option::of(0usize..4).prop_map(SubmeshCommand::Hover),
        prop::option::of(vector()).prop_map(SubmeshCommand::HoverAt),
    ]
}

fn joint_command() -> impl Strategy<Value = JointCommand> {
    let any_joint = || (0u32..9).prop_map(JointIndex);
    prop_oneof![
        4 => prop::option::of(any_joint()).prop_map(JointCommand::Select),
        4 => vector().prop_map(JointCommand::SelectAt),
        1 => Just(JointCommand::SelectParent),
        1 => Just(JointCommand::SelectChild),
        1 => prop::option::of(any_joint()).prop_map(JointCommand::Hover),
        1 => prop::option::of(vector()).prop_map(JointCommand::HoverAt),
        1 => prop::option::of(0u32..40).prop_map(JointCommand::SelectVertex),
        1 => (any_joint(), any::<bool>()).prop_map(|(joint, folded)| JointCommand::SetFolded { joint, folded }),
        1 => any::<bool>().prop_map(JointCommand::SetAllFolded),
    ]
}

fn name_command() -> impl Strategy<Value = NameCommand> {
    let any_joint = || (0u32..9).prop_map(JointIndex);
    let name = prop::sample::select(vec!["", " ", "L arm", "hand", "R_leg", "\u{7}"]);
    let saved = |bones: usize| {
        let (model, _) = crate::documents::model_of(&mirrored(bones));
        let names = [(1, "kept".to_owned()), (99, "none".to_owned())].into();
        let fingerprint = hierarchy_fingerprint(&model.skeleton);
        NameCommand::Import(SavedNames { fingerprint, names })
    };
    prop_oneof![
        2 => (any_joint(), name).prop_map(|(joint, name)| NameCommand::Rename { joint, name: name.to_owned() }),
        1 => Just(NameCommand::AcceptMirrored),
        1 => prop::sample::select(vec![2, 7]).prop_map(saved),
        1 => Just(NameCommand::Clear),
    ]
}

/// How the skeleton and the skin are shown.
fn skeleton_look() -> impl Strategy<Value = LookCommand> {
    let any_joint = || (0u32..9).prop_map(JointIndex);
    prop_oneof![
        1 => prop::sample::select(BoneStyle::ALL.to_vec()).prop_map(LookCommand::SetBoneStyle),
        1 => any::<bool>().prop_map(LookCommand::SetBonesVisible),
        1 => any::<bool>().prop_map(LookCommand::SetLabelsVisible),
        1 => prop::option::of(prop::sample::select(SkinView::ALL.to_vec())).prop_map(LookCommand::SetSkinView),
        1 => any_joint().prop_map(LookCommand::ToggleTrail),
        1 => Just(LookCommand::ClearTrails),
    ]
}

fn material_command() -> impl Strategy<Value = MaterialCommand> {
    let color = || (number(), number(), number()).prop_map(<[f32; 3]>::from);
    let reflectance = prop_oneof![
        3 => (color(), number()).prop_map(|(fresnel0, roughness)| Reflectance::Fresnel { fresnel0, roughness }),
        1 => (color(), number()).prop_map(|(ambient, spec_power)| Reflectance::Phong {
            ambient,
            specular: ambient,
            spec_power,
            reflectivity: ambient
        }),
    ];
    let material = (color(), reflectance, any::<bool>()).prop_map(|(diffuse, reflectance, alpha_clip)| Material {
        name: "any".to_owned(),
        diffuse,
        reflectance,
        alpha: AlphaMode::clipped(alpha_clip),
        ..Material::default()
    });
    prop_oneof![
        2 => (0usize..4, material).prop_map(|(index, material)| MaterialCommand::Edit { index, material: Box::new(material) }),
        1 => (0usize..4).prop_map(MaterialCommand::Reset),
    ]
}

fn timeline() -> impl Strategy<Value = PlayCommand> {
    let direction = prop::sample::select(vec![Direction::Forward, Direction::Backward]);
    let joint = prop::option::of((0u32..4).prop_map(JointIndex));
    prop_oneof![
        (-20.0f64..90.0).prop_map(PlayCommand::SeekFrame),
        prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300]).prop_map(PlayCommand::SeekFrame),
        (direction, joint).prop_map(|(direction, joint)| PlayCommand::StepKey { direction, joint }),
        prop::option::of(number()).prop_map(PlayCommand::SetRangeStart),
        prop::option::of(number()).prop_map(PlayCommand::SetRangeEnd),
        Just(PlayCommand::ClearRange),
        prop::sample::select(vec![WrapMode::Wrap, WrapMode::BookDemo]).prop_map(PlayCommand::SetWrapMode),
        number().prop_map(PlayCommand::SetCrossfade),
        (0usize..5, number()).prop_map(|(clip, weight)| PlayCommand::SetBlend { clip, weight }),
        Just(PlayCommand::ClearBlend),
        (0usize..5, any::<bool>()).prop_map(|(clip, on)| PlayCommand::SetInPlace { clip, on }),
    ]
}

/// Any command, and any of the camera as a glide too.
pub(super) fn command() -> impl Strategy<Value = Command> {
    let playing = prop_oneof![
        Just(PlayCommand::Play),
        Just(PlayCommand::Pause),
        Just(PlayCommand::Toggle),
        Just(PlayCommand::ToggleBackward),
        number().prop_map(|time_secs| PlayCommand::Seek { time_secs }),
        any::<i32>().prop_map(PlayCommand::StepFrames),
        (-40..40).prop_map(PlayCommand::StepFrames),
        Just(PlayCommand::SeekStart),
        Just(PlayCommand::SeekEnd),
        Just(PlayCommand::BeginScrub),
        Just(PlayCommand::EndScrub),
        (0usize..5).prop_map(PlayCommand::SelectClip),
        any::<i32>().prop_map(PlayCommand::CycleClip),
        number().prop_map(PlayCommand::SetSpeed),
        Just(PlayCommand::Slower),
        Just(PlayCommand::Faster),
        prop::sample::select(vec![LoopMode::Once, LoopMode::Loop, LoopMode::PingPong])
            .prop_map(PlayCommand::SetLoopMode),
        Just(PlayCommand::CycleLoopMode),
    ];
    let pose = prop_oneof![
        number().prop_map(PlayCommand::SetBindWeight),
        Just(PlayCommand::ToggleBindPose),
    ];
    let sent_camera = prop_oneof![
        (number(), number()).prop_map(|(yaw_radians, pitch_radians)| CameraCommand::Orbit {
            yaw_radians,
            pitch_radians
        }),
        vector().prop_map(|drag| CameraCommand::Pan { drag }),
        (number(), vector()).prop_map(|(factor, pointer)| CameraCommand::Zoom { factor, pointer }),
        Just(CameraCommand::FrameModel),
        Just(CameraCommand::FrameSelection),
        prop::sample::select(ViewPreset::ALL.to_vec()).prop_map(CameraCommand::LookFrom),
        Just(CameraCommand::ToggleProjection),
        Just(CameraCommand::Reset),
        (number(), number(), number()).prop_map(|(aspect, left, bottom)| CameraCommand::SetViewport {
            aspect,
            insets: Insets {
                left,
                bottom,
                ..Insets::default()
            },
        }),
    ];
    let camera = prop_oneof![5 => sent_camera, 4 => moving_camera()];
    let camera = (camera, prop::bool::weighted(0.2)).prop_map(|(command, glides)| match glides {
        true => CameraCommand::Glide(Box::new(command)),
        false => command,
    });
    let look = prop_oneof![
        any::<bool>().prop_map(|on| LookCommand::SetOverlay(Overlay::Grid, on)),
        Just(LookCommand::ToggleOverlay(Overlay::Grid)),
        any::<bool>().prop_map(LookCommand::SetBindGhost),
        prop::option::of((0u32..40, 0u32..40, 0u32..3)).prop_map(|plan| {
            LookCommand::SetGhosts(plan.map(|(before, after, step_frames)| GhostPlan {
                before,
                after,
                step_frames,
            }))
        }),
    ];
    let files = prop_oneof![
        Just(FileCommand::ClearSky),
        files().prop_map(FileCommand::Add),
        files().prop_map(FileCommand::AddClips),
        prop::sample::select(vec!["a.m3d", "c.m3d", "none"]).prop_map(|path| FileCommand::Open(path.to_owned())),
        prop::sample::select(vec!["a.m3d", "c.m3d", "none"]).prop_map(|path| FileCommand::Close(path.to_owned())),
        prop::sample::select(vec!["sky.dds", "none"]).prop_map(|path| FileCommand::UseSky(path.to_owned())),
        Just(FileCommand::DismissError),
    ];
    let alone = prop_oneof![
        prop::sample::select(vec![None, Some(Handedness::Left), Some(Handedness::Right)])
            .prop_map(Command::SetHandedness),
        prop::sample::select(vec![None, Some(UpAxis::Y), Some(UpAxis::Z)]).prop_map(Command::SetUpAxis),
        prop::sample::select(vec![Theme::Dark, Theme::Light]).prop_map(Command::SetTheme),
    ];
    let crowd = prop_oneof![
        (prop::sample::select(vec![0, 1, 2, 3, 7, 40]), 0_u32..3)
            .prop_map(|(count, seed)| CrowdCommand::Set { count, seed }),
        (0_usize..8).prop_map(CrowdCommand::Select),
    ];
    let history = prop::sample::select(vec![
        HistoryCommand::Undo,
        HistoryCommand::Redo,
        HistoryCommand::BeginEdit,
        HistoryCommand::EndEdit,
    ]);
    prop_oneof![
        6 => playing.prop_map(Command::Play),
        4 => timeline().prop_map(Command::Play),
        2 => pose.prop_map(Command::Play),
        8 => camera.prop_map(Command::Camera),
        3 => alone,
        4 => submesh_command().prop_map(Command::Submesh),
        4 => joint_command().prop_map(Command::Joint),
        2 => name_command().prop_map(Command::Name),
        2 => skeleton_look().prop_map(Command::Look),
        3 => look.prop_map(Command::Look),
        2 => material_command().prop_map(Command::Material),
        5 => files.prop_map(Command::File),
        3 => crowd.prop_map(Command::Crowd),
        4 => history.prop_map(Command::History),
    ]
}

fn check(session: &mut Session) -> Result<(), TestCaseError> {
    let camera = *session.camera();
    prop_assert!(
        camera.target.is_finite() && camera.yaw_radians.is_finite(),
        "{camera:?}"
    );
    prop_assert!(camera.pitch_radians.abs() < std::f32::consts::FRAC_PI_2, "{camera:?}");
    prop_assert!(camera.distance.is_finite() && camera.distance > 0.0, "{camera:?}");

    let playback = session.playback();
    let span = playback.start_secs()..=playback.end_secs();
    prop_assert!(span.contains(&playback.time_secs()), "{playback:?}");
    prop_assert!((MIN_SPEED..=MAX_SPEED).contains(&playback.speed()));
    if let Some([start_secs, end_secs]) = playback.range_secs() {
        prop_assert!(start_secs < end_secs && span.contains(&start_secs) && span.contains(&end_secs));
        prop_assert!([start_secs, end_secs] != [*span.start(), *span.end()]);
    }

    let clips = session.open_model().map_or(0, |open| open.model.clips.len());
    prop_assert_eq!(
        session.clip_index().is_some(),
        clips > 0,
        "a model with clips shows one"
    );
    prop_assert!(session.clip_index().is_none_or(|clip| clip < clips));
    if let Some(clip) = session.clip() {
        prop_assert_eq!(span, clip.start_secs..=clip.end_secs);
    } else {
        prop_assert!(!playback.is_playing() && !session.is_animating());
    }

    let blended = session.blend().map(|blend| blend.clip);
    prop_assert!(blended.is_none_or(|clip| clip < clips && blended != session.clip_index()));
    if let Some(open) = session.open_model() {
        let names: BTreeSet<&str> = open.clip_list().map(|clip| clip.name).collect();
        prop_assert_eq!((names.len(), open.clip_list().len()), (clips, clips));
    }

    let of_file: &[Material] = session.open_model().map_or(&[], |open| &open.model.materials);
    prop_assert_eq!(session.materials().len(), of_file.len());
    for (index, (drawn, of_file)) in session.materials().iter().zip(of_file).enumerate() {
        prop_assert_eq!(&drawn.name, &of_file.name);
        prop_assert!(
            drawn.diffuse.iter().all(|channel| (0.0..=1.0).contains(channel)),
            "{drawn:?}"
        );
        prop_assert_eq!(session.is_edited(index), drawn != of_file);
    }

    let submeshes = session.open_model().map_or(0, |open| open.model.mesh.submeshes.len());
    let subsets = session.submeshes();
    prop_assert_eq!(subsets.count(), submeshes);
    prop_assert!(subsets.selected().is_none_or(|selected| selected < submeshes));
    let frame = session.frame();
    prop_assert_eq!(frame.hidden_submeshes.len(), submeshes);
    prop_assert!(
        frame
            .highlighted_submesh
            .is_none_or(|submesh| !frame.hidden_submeshes[submesh])
    );
    if let Some(hit) = session.pick(Vec2::new(0.1, -0.2)) {
        prop_assert!(session.submeshes().is_visible(hit.submesh), "{hit:?}");
        prop_assert!(hit.position.is_finite() && hit.distance >= 0.0, "{hit:?}");
    }

    let joints = session.open_model().map_or(0, |open| open.model.skeleton.joint_count());
    let frame = session.frame();
    prop_assert_eq!(frame.palette.0.len(), joints);
    prop_assert!(frame.palette.0.iter().all(|matrix| matrix.is_finite()));
    check_crowd(session, joints)?;
    check_joints(session, joints)
}

fn check_crowd(session: &mut Session, joints: usize) -> Result<(), TestCaseError> {
    let CrowdState { count, selected, .. } = session.crowd();
    prop_assert!(count >= 1 && selected < count);
    prop_assert!(count == 1 || session.open_model().is_some());
    let crowd = session.frame().crowd;
    prop_assert_eq!(crowd.instances.len(), count - 1);
    prop_assert!(crowd.in_sight < count);
    prop_assert!(crowd.palettes.iter().all(|matrix| matrix.is_finite()));
    for instance in crowd.instances {
        prop_assert!(instance.world_from_model.is_finite());
        prop_assert!((instance.palette as usize + 1) * joints <= crowd.palettes.len());
    }
    Ok(())
}

fn check_joints(session: &mut Session, count: usize) -> Result<(), TestCaseError> {
    prop_assert!((0.0..=1.0).contains(&session.bind_weight()));
    let joints = session.joints().clone();
    prop_assert_eq!(joints.count(), count);
    let marked = [joints.selected(), joints.hovered()].into_iter().flatten();
    prop_assert!(
        marked
            .chain(session.look().trails.iter().copied())
            .all(|joint| joint.index() < count)
    );
    prop_assert!(session.joint_names().all().keys().all(|&bone| bone < count));
    prop_assert!(session.joint_names().all().values().all(|name| !name.trim().is_empty()));

    let mut rows = Vec::new();
    session.joint_rows("", &mut rows);
    prop_assert!(rows.len() <= count && (rows.is_empty() == (count == 0)));
    if let Some(selected) = joints.selected() {
        let readout = session.inspect_joint(selected).expect("it is there");
        prop_assert!(readout.model.position.is_finite() && readout.model.rotation.is_normalized());
    }

    let vertices = session.open_model().map_or(0, |open| open.model.mesh.vertex_count());
    prop_assert!(
        joints
            .selected_vertex()
            .is_none_or(|selected| (selected.vertex as usize) < vertices)
    );
    prop_assert_eq!(session.explain_vertex().is_some(), joints.selected_vertex().is_some());
    prop_assert_eq!(
        skin_colors(session).len(),
        if session.skin_colors_key().is_some() {
            vertices
        } else {
            0
        }
    );

    let overlay = seen_through(session);
    let mut corners = overlay.lines.iter().chain(&overlay.triangles);
    if session.look().trails.is_empty() {
        let look = session.look();
        // While bones are hidden only marked ones are drawn, and none on a coloured skin. The selected one of a crowd stands in a ring.
        let is_marked = joints.selected().or(joints.hovered()).is_some() && look.skin_view.is_none();
        prop_assert_eq!(
            corners.clone().count() > 0,
            ((look.bones_visible || is_marked) && count > 0) || session.crowd().count > 1
        );
    }
    prop_assert!(corners.all(|corner| Vec3::from(corner.position).is_finite()));
    Ok(())
}

proptest! {
    #![proptest_config(crate::properties::cases(96))]

    #[test]
    fn no_order_of_commands_brings_it_out_of_order(
        steps in prop::collection::vec((command(), prop::option::of(number())), 1..60),
    ) {
        let mut session = Session::new(false);
        session.apply(FileCommand::Add(vec![moving("a.m3d"), still("c.m3d")]));
        session.take_events();
        let mut playing = session.playback().is_playing();
        for (command, dt_secs) in steps {
            let (picture, camera, time_secs) =
                (session.picture_revision(), *session.camera(), session.playback().time_secs());
            session.apply(command);
            if let Some(dt_secs) = dt_secs {
                let (picture, moves) = (session.picture_revision(), session.is_moving());
                session.advance(dt_secs);
                prop_assert!(moves || session.picture_revision() == picture, "nothing moved");
            }
            check(&mut session)?;
            let moved = *session.camera() != camera || session.playback().time_secs() != time_secs;
            prop_assert!(!moved || session.picture_revision() > picture, "a change that nobody draws");

            // Listeners who count from the start know whether it plays.
            for event in session.take_events() {
                match event {
                    Event::Play => playing = true,
                    Event::Pause => playing = false,
                    Event::Load | Event::Error | Event::TimeUpdate | Event::PlaybackChange => {}
                }
            }
            prop_assert_eq!(playing, session.playback().is_playing());
        }
    }
}
