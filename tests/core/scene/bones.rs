//! Bones placed, drawn, picked and named.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::import::m3d;
use bindpose::model::{Front, Handedness, JointIndex, Model, UpAxis, world_from_model};
use bindpose::scene::{
    Aabb, BoneColors, BoneStyle, Bones, Camera, Light, MarkedJoints, OverlayGeometry, OverlayVertex, Projection,
    Screen, Theme, append_bones, label_places, pick_joint,
};
use glam::{Affine3A, Vec2, Vec3};

use crate::chains::mirrored_model;
use crate::documents::{arm, model_of, soldier};

/// Bones of a model at half of its first clip, in a world that mirrors.
fn placed(model: &Model) -> Bones {
    let mut pose = PoseBuffers::default();
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.5);
    let mut bones = Bones::default();
    bones.place(
        &model.skeleton,
        &pose.model,
        world_from_model(Handedness::Right, UpAxis::Y, Front::Negative),
        radius(model),
    );
    bones
}

fn radius(model: &Model) -> f32 {
    model.bind_bounds().radius()
}

/// A picture of all joints.
fn screen(bones: &Bones, projection: Projection) -> Screen {
    let bounds = Aabb::from_points(bones.bones().iter().flat_map(|bone| [bone.from, bone.to]));
    let camera = Camera {
        target: bounds.center(),
        distance: bounds.radius().max(0.1) * 3.0,
        projection,
        ..Camera::default()
    };
    let aspect = 1.5;
    Screen {
        clip_from_world: camera.clip_from_view(aspect, &bounds) * camera.view_from_world(),
        aspect,
    }
}

fn drawn(bones: &Bones, style: BoneStyle, marked: MarkedJoints) -> OverlayGeometry {
    let mut out = OverlayGeometry::default();
    append_bones(bones, style, marked, BoneColors::of(Theme::Dark), &mut out);
    out
}

#[test]
fn bones_run_from_each_joint_to_its_children_and_leaves_have_stubs() {
    for model in [
        model_of(&arm()).0,
        mirrored_model(1),
        mirrored_model(300),
        mirrored_model(2_000),
    ] {
        let bones = placed(&model);
        let parents = model.skeleton.parents();
        let leaves = (0..parents.len() as u32)
            .filter(|&joint| !parents.contains(&Some(JointIndex(joint))))
            .count();
        let with_parent = parents.iter().flatten().count();
        assert_eq!(bones.bones().len(), with_parent + leaves);
        let place = |joint: JointIndex| bones.position(joint).expect("there");
        for (joint, parent) in (0..).map(JointIndex).zip(parents) {
            let Some(parent) = *parent else { continue };
            let is_it = |bone: &&bindpose::scene::Bone| bone.joint == parent && bone.to == place(joint);
            assert_eq!(bones.bones().iter().filter(is_it).count(), 1, "{joint:?}");
        }
        for bone in bones.bones() {
            assert_eq!(bone.from, place(bone.joint));
            assert!(bone.from.distance(bone.to) > 0.0 && bone.to.is_finite());
        }
    }
}

#[test]
fn a_stub_goes_on_where_its_bone_came_from() {
    let (model, _) = model_of(&arm());
    let bones = placed(&model);
    let stub = bones
        .bones()
        .iter()
        .find(|bone| bone.joint == JointIndex(2))
        .expect("the hand is a leaf");
    let before = bones.position(JointIndex(1)).expect("there");
    let (way, came) = ((stub.to - stub.from).normalize(), (stub.from - before).normalize());
    assert!(way.distance(came) < 1e-5);
    assert!(stub.from.distance(stub.to) < stub.from.distance(before));
}

#[test]
fn joints_at_one_place_have_a_stub_along_the_bone_before_or_along_their_y() {
    let mut document = arm();
    for bone in &mut document.clips[0].bones[2].keyframes {
        bone.translation = [0.0; 3];
    }
    let bones = placed(&model_of(&document).0);
    assert_eq!(
        bones.bones().len(),
        3,
        "one bone and a stub for each of the two joints at its end"
    );
    let stubs: Vec<_> = bones.bones()[1..].iter().map(|bone| bone.to - bone.from).collect();
    assert!(stubs[0].distance(stubs[1]) < 1e-6);

    let lone = placed(&mirrored_model(1));
    let [bone] = lone.bones() else {
        panic!("one stub: {lone:?}")
    };
    assert!((bone.to - bone.from).normalize().distance(Vec3::Y) < 1e-2);
}

#[test]
fn no_skeleton_and_poses_that_are_too_short_draw_what_is_there() {
    let mut bones = Bones::default();
    bones.place(&Default::default(), &Default::default(), Affine3A::IDENTITY, 1.0);
    for style in BoneStyle::ALL {
        assert_eq!(
            drawn(&bones, style, MarkedJoints::default()),
            OverlayGeometry::default()
        );
    }
    let model = mirrored_model(300);
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.model.0.truncate(5);
    bones.place(&model.skeleton, &pose.model, Affine3A::IDENTITY, 0.0);
    assert!(bones.bones().iter().all(|bone| bone.joint.0 < 5));
    assert_eq!(bones.position(JointIndex(5)), None);
}

#[test]
fn each_style_has_its_lines_and_triangles() {
    for model in [mirrored_model(1), model_of(&arm()).0, mirrored_model(2_000)] {
        let bones = placed(&model);
        let count = bones.bones().len();
        for (style, lines, triangles) in [
            (BoneStyle::Lines, 1, 0),
            (BoneStyle::Octahedra, 0, 8),
            (BoneStyle::Axes, 4, 0),
        ] {
            let out = drawn(&bones, style, MarkedJoints::default());
            assert_eq!(
                (out.lines.len(), out.triangles.len()),
                (count * lines * 2, count * triangles * 3),
                "{style:?}"
            );
            let all = out.lines.iter().chain(&out.triangles);
            assert!(
                all.clone()
                    .all(|vertex| Vec3::from(vertex.position).is_finite() && vertex.color_srgb[3] > 0)
            );
        }
    }
}

#[test]
fn octahedra_are_closed_face_outwards_and_get_thinner_in_a_crowd() {
    let mut thickness = Vec::new();
    for count in [5, 2_000] {
        let bones = placed(&mirrored_model(count));
        let out = drawn(&bones, BoneStyle::Octahedra, MarkedJoints::default());
        let scene = bones.scene_radius() * 0.025;
        let mut thickest = 0.0_f32;
        for (bone, corners) in bones.bones().iter().zip(out.triangles.chunks_exact(24)) {
            let points: Vec<Vec3> = corners.iter().map(|corner| corner.position.into()).collect();
            let middle = (bone.from + bone.to) * 0.5;
            let way = (bone.to - bone.from).normalize();
            let mut volume = 0.0;
            for triangle in points.chunks_exact(3) {
                let facing = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
                assert!(
                    facing.dot(triangle[0] - middle) > 0.0,
                    "clockwise from outside in a left-handed world"
                );
                volume += facing.dot(triangle[0] - middle);
                for point in triangle {
                    let off = *point - bone.from;
                    let most = (bone.from.distance(bone.to) * 0.09).min(scene);
                    thickest = thickest.max((off - way * off.dot(way)).length() / most);
                }
            }
            assert!(volume > 0.0);
        }
        thickness.push(thickest);
    }
    assert!(
        (thickness[0] - 1.0).abs() < 1e-2 && (0.25..0.5).contains(&thickness[1]),
        "{thickness:?}"
    );
}

/// How many corners have a colour, whatever its shade.
fn count(vertices: &[OverlayVertex], color: [u8; 4]) -> usize {
    vertices.iter().filter(|vertex| vertex.color_srgb == color).count()
}

#[test]
fn what_is_selected_hovered_or_below_has_its_colour_and_comes_last() {
    let bones = placed(&model_of(&arm()).0);
    let colors = BoneColors::of(Theme::Dark);
    let marked = |selected: Option<u32>, hovered: Option<u32>| MarkedJoints {
        selected: selected.map(JointIndex),
        hovered: hovered.map(JointIndex),
    };
    let lines = |marked| drawn(&bones, BoneStyle::Lines, marked).lines;
    assert_eq!(count(&lines(marked(None, None)), colors.plain), 6);
    let out = lines(marked(Some(0), Some(2)));
    for color in [colors.selected, colors.child_of_selected, colors.hovered] {
        assert_eq!(count(&out, color), 2);
    }
    assert_eq!(out[4].color_srgb, colors.selected, "drawn over the rest");
    assert_eq!(
        count(&lines(marked(Some(1), Some(1))), colors.selected),
        2,
        "selected before hovered"
    );
    assert_eq!(count(&lines(marked(Some(9), Some(9))), colors.plain), 6);
    for theme in [Theme::Dark, Theme::Light] {
        let BoneColors {
            plain,
            child_of_selected,
            hovered,
            selected,
        } = BoneColors::of(theme);
        let mut all = [plain, child_of_selected, hovered, selected];
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "four colours");
    }
}

/// The nearest joint or bone on screen by plain search, in heights of the picture, and the eye's nearest among equals.
fn check_pick(bones: &Bones, screen: &Screen) {
    let project = |point: Vec3| screen.clip_from_world.project_point3(point);
    let radius = 0.01;
    for joint in (0..bones.world_from_joint().len() as u32).map(JointIndex) {
        let place = project(bones.position(joint).expect("there"));
        let picked = pick_joint(bones, screen, place.truncate(), radius).expect("a joint is there");
        let other = project(bones.position(picked).expect("there"));
        let apart = ((other - place).truncate() * Vec2::new(screen.aspect, 1.0) * 0.5).length();
        assert!(apart <= radius * 0.3 + 1e-5, "{joint:?} {picked:?}: {apart}");
        assert!(
            other.z <= place.z + 1e-6,
            "{picked:?} is nearer to the eye than {joint:?}"
        );
    }
}

#[test]
fn each_joint_is_picked_where_it_is_drawn_unless_another_is_before_it() {
    for model in [
        model_of(&arm()).0,
        mirrored_model(1),
        mirrored_model(300),
        mirrored_model(2_000),
    ] {
        let bones = placed(&model);
        for projection in [Camera::default().projection, Projection::Orthographic] {
            check_pick(&bones, &screen(&bones, projection));
        }
    }
}

#[test]
fn a_bone_is_picked_along_its_length_and_not_beside_it() {
    let bones = placed(&model_of(&arm()).0);
    let screen = screen(&bones, Camera::default().projection);
    let heights = Vec2::new(2.0 / screen.aspect, 2.0);
    for bone in bones.bones() {
        let [from, to] = [bone.from, bone.to].map(|end| screen.clip_from_world.project_point3(end).truncate());
        let middle = from.midpoint(to);
        assert_eq!(pick_joint(&bones, &screen, middle, 0.01), Some(bone.joint));
        let across = ((to - from) / heights).perp().normalize() * heights;
        assert_eq!(
            pick_joint(&bones, &screen, middle + across * 0.009, 0.01),
            Some(bone.joint)
        );
        assert_eq!(pick_joint(&bones, &screen, middle + across * 0.011, 0.01), None);
    }
    for pointer in [Vec2::NAN, Vec2::INFINITY, Vec2::splat(0.99)] {
        assert_eq!(pick_joint(&bones, &screen, pointer, 0.01), None);
    }
    assert_eq!(pick_joint(&bones, &screen, Vec2::ZERO, f32::NAN), None);
}

#[test]
fn a_bone_that_runs_through_the_eye_is_picked_by_the_part_in_view() {
    let (model, _) = model_of(&arm());
    let pose = PoseBuffers::for_skeleton(&model.skeleton);
    let mut bones = Bones::default();
    bones.place(&model.skeleton, &pose.model, Affine3A::IDENTITY, 1.0);
    // Above joint 1, looking down along the arm from the side: joint 2 is behind the eye.
    let camera = Camera {
        target: Vec3::ZERO,
        distance: 1.5,
        yaw_radians: 0.0,
        pitch_radians: 1.3,
        ..Camera::default()
    };
    let bounds = Aabb::from_points([Vec3::splat(-2.0), Vec3::splat(3.0)]);
    let screen = Screen {
        clip_from_world: camera.clip_from_view(1.0, &bounds) * camera.view_from_world(),
        aspect: 1.0,
    };
    let in_front = |y: f32| (screen.clip_from_world * Vec3::new(0.0, y, 0.0).extend(1.0)).w > 0.0;
    assert!(
        in_front(1.2) && !in_front(2.0),
        "the upper bone is cut by the eye's plane"
    );
    let point = screen.clip_from_world.project_point3(Vec3::Y * 1.1).truncate();
    assert_eq!(pick_joint(&bones, &screen, point, 0.005), Some(JointIndex(1)));
}

#[test]
fn labels_stand_at_their_joints_apart_from_each_other_the_chosen_first() {
    let bones = placed(&mirrored_model(2_000));
    let screen = screen(&bones, Projection::perspective(Light::Book));
    let mut all = Vec::new();
    label_places(&bones, &screen, 0.0, &[], &mut all);
    assert_eq!(all.len(), 2_000, "all are in view");
    assert!(all.is_sorted_by(|a, b| a.depth <= b.depth), "near ones first");
    for place in &all {
        let drawn = screen
            .clip_from_world
            .project_point3(bones.position(place.joint).expect("there"));
        assert!(drawn.truncate().distance(place.position) < 1e-5 && (drawn.z - place.depth).abs() < 1e-5);
    }
    let chosen = [all[1_999].joint, all[1_000].joint];
    let mut some = Vec::new();
    label_places(&bones, &screen, 0.05, &chosen, &mut some);
    assert_eq!(some[0].joint, chosen[0], "even the farthest");
    assert!((20..1_000).contains(&some.len()), "{}", some.len());
    for (index, a) in some.iter().enumerate() {
        for b in &some[..index] {
            let apart = ((a.position - b.position) * Vec2::new(screen.aspect, 1.0) * 0.5).length();
            assert!(apart >= 0.05 - 1e-6, "{a:?} {b:?}");
        }
    }
    for place in &all {
        let near = |kept: &bindpose::scene::LabelPlace| {
            ((place.position - kept.position) * Vec2::new(screen.aspect, 1.0) * 0.5).length() < 0.05 * 1.5
        };
        assert!(some.iter().any(near), "left out only beside another");
    }
}

#[test]
fn the_soldiers_joints_are_picked_where_they_are_drawn() {
    let Some(parsed) = soldier() else { return };
    let bones = placed(&m3d::from_parsed(&parsed).expect("sound").0);
    check_pick(&bones, &screen(&bones, Camera::default().projection));
}
