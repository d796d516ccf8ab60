//! Tests of `sample`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use bindpose::format::{self, AnimationClip, Document, LineMap, Reflectance};
use bindpose::model::{Handedness, Model, UpAxis};
use glam::{DMat4, DQuat, DVec3};

static FIGURE: LazyLock<Document> = LazyLock::new(bindpose::sample::figure);

/// Positions are written to 5 decimals, 0.01 mm.
const WRITTEN_METRES: f64 = 1e-5;

#[test]
fn the_skin_is_closed_and_each_edge_has_two_opposite_triangles() {
    let (welded, vertex_of) = welded(&FIGURE);
    let mut edges = BTreeMap::<(usize, usize), u32>::new();
    for triangle in &FIGURE.triangles {
        let corners = triangle.map(|corner| vertex_of[corner as usize]);
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            *edges.entry((corners[a], corners[b])).or_default() += 1;
        }
    }
    for (&(from, to), &count) in &edges {
        assert_eq!(
            count, 1,
            "edge {from}-{to} at {} runs {count} times the same way",
            welded[from]
        );
        assert!(
            edges.contains_key(&(to, from)),
            "edge {from}-{to} at {} is open",
            welded[from]
        );
    }
    // One piece without a handle: vertices − edges + faces = 2.
    let euler = welded.len() as i64 - edges.len() as i64 / 2 + FIGURE.triangles.len() as i64;
    assert_eq!(euler, 2);
}

#[test]
fn winding_and_normals_point_outwards_as_in_left_handed_files() {
    let mut inside_out = Vec::new();
    for triangle in &FIGURE.triangles {
        let [a, b, c] = triangle.map(|corner| position(corner));
        let normals = triangle.map(|corner| vector(FIGURE.vertices[corner as usize].normal));
        let facing = (b - a)
            .cross(c - a)
            .normalize()
            .dot(normals.into_iter().sum::<DVec3>().normalize());
        if facing <= 0.0 {
            inside_out.push((a, facing));
        }
    }
    assert!(inside_out.is_empty(), "{inside_out:?}");
    // Consistent winding could still be inside out as a whole: the enclosed volume tells.
    let volume: f64 = FIGURE
        .triangles
        .iter()
        .map(|t| t.map(position))
        .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
        .sum();
    assert!((0.07..0.14).contains(&volume), "{volume} cubic metres");
}

#[test]
fn normals_and_tangents_are_unit_and_across() {
    // Four decimals.
    const ROUNDING: f64 = 3e-4;
    for (index, vertex) in FIGURE.vertices.iter().enumerate() {
        let (normal, [x, y, z, w]) = (vector(vertex.normal), vertex.tangent);
        let tangent = vector([x, y, z]);
        assert!((normal.length() - 1.0).abs() < ROUNDING, "vertex {index}: {normal}");
        assert!((tangent.length() - 1.0).abs() < ROUNDING, "vertex {index}: {tangent}");
        assert!(
            normal.dot(tangent).abs() < ROUNDING,
            "vertex {index}: {normal} and {tangent}"
        );
        assert!(w.abs() == 1.0, "vertex {index}: {w}");
    }
}

#[test]
fn tangents_follow_the_texture_across_each_triangle() {
    // Where a coarse triangle spans a crease, as between fingers, its corners lean away from it; that stays rare.
    let (mut leaning, mut turned) = (0, 0);
    for triangle in &FIGURE.triangles {
        let [a, b, c] = triangle.map(position);
        let [ta, tb, tc] = triangle.map(|corner| FIGURE.vertices[corner as usize].tex_coords.map(f64::from));
        let (u1, v1, u2, v2) = (tb[0] - ta[0], tb[1] - ta[1], tc[0] - ta[0], tc[1] - ta[1]);
        let area = u1 * v2 - u2 * v1;
        // A triangle without area in the texture would have no direction.
        assert!(area.abs() > 1e-7, "triangle {triangle:?} at {a}");
        let along_u = ((b - a) * v2 - (c - a) * v1) / area;
        let along_v = ((c - a) * u1 - (b - a) * u2) / area;
        for corner in triangle {
            let vertex = FIGURE.vertices[*corner as usize];
            let [x, y, z, w] = vertex.tangent;
            let (tangent, normal) = (vector([x, y, z]), vector(vertex.normal));
            let bitangent = normal.cross(tangent) * f64::from(w);
            let (u, v) = (tangent.dot(along_u.normalize()), bitangent.dot(along_v.normalize()));
            leaning += usize::from(u < 0.4 || v < 0.4);
            turned += usize::from(u < 0.0 || v < 0.0);
        }
    }
    let corners = 3 * FIGURE.triangles.len();
    assert!(
        leaning < corners / 400 && turned < corners / 3_000,
        "{leaning} corners lean away, {turned} are turned"
    );
}

#[test]
fn weights_sum_to_one_and_unused_slots_are_empty() {
    for (index, vertex) in FIGURE.vertices.iter().enumerate() {
        let sum: f64 = vertex.blend_weights.iter().copied().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-6, "vertex {index}: {sum}");
        assert!(
            vertex.blend_weights.is_sorted_by(|a, b| a >= b),
            "vertex {index}: {:?}",
            vertex.blend_weights
        );
        for (slot, &joint) in vertex.blend_indices.iter().enumerate() {
            assert!((joint as usize) < FIGURE.bone_offsets.len());
            let repeated = vertex.blend_indices[..slot].contains(&joint);
            assert!(
                vertex.blend_weights[slot] == 0.0 && joint == 0 || !repeated,
                "vertex {index}: joint {joint} twice"
            );
        }
    }
}

#[test]
fn every_joint_but_the_root_moves_the_skin() {
    let mut most = vec![0.0f32; FIGURE.bone_offsets.len()];
    for vertex in &FIGURE.vertices {
        for (weight, joint) in vertex.blend_weights.into_iter().zip(vertex.blend_indices) {
            most[joint as usize] = most[joint as usize].max(weight);
        }
    }
    for (joint, (&most, &parent)) in most.iter().zip(&FIGURE.bone_parents).enumerate() {
        assert_eq!(parent < 0, joint == 0, "joint {joint}");
        assert!(parent < joint as i32, "joint {joint} comes before its parent");
        assert!(
            if joint == 0 { most == 0.0 } else { most > 0.4 },
            "joint {joint} moves at most {most}"
        );
    }
}

#[test]
fn one_leg_does_not_move_the_other() {
    let right_leg: Vec<usize> = (0..FIGURE.bone_parents.len())
        .filter(|joint| is_below(*joint, RIGHT_THIGH))
        .collect();
    assert_eq!(right_leg.len(), 4);
    for vertex in FIGURE.vertices.iter().filter(|vertex| vertex.position[0] > 0.0) {
        for (weight, joint) in vertex.blend_weights.into_iter().zip(vertex.blend_indices) {
            assert!(weight == 0.0 || !right_leg.contains(&(joint as usize)), "{vertex:?}");
        }
    }
}

#[test]
fn subsets_cover_all_triangles_and_only_their_own_vertices() {
    let (mut face, mut vertex) = (0, 0);
    assert_eq!(FIGURE.subsets.len(), FIGURE.materials.len());
    for subset in &FIGURE.subsets {
        assert_eq!((subset.face_start, subset.vertex_start), (face, vertex));
        assert!(subset.face_count > 100);
        face += subset.face_count;
        vertex += subset.vertex_count;
        let own = subset.vertex_start..vertex;
        let triangles = &FIGURE.triangles[subset.face_start as usize..face as usize];
        assert!(triangles.iter().flatten().all(|corner| own.contains(corner)));
    }
    assert_eq!(
        (face as usize, vertex as usize),
        (FIGURE.triangles.len(), FIGURE.vertices.len())
    );
    assert!(
        (8_000..14_000).contains(&FIGURE.triangles.len()),
        "{} triangles",
        FIGURE.triangles.len()
    );
}

#[test]
fn materials_are_physically_plausible() {
    for material in &FIGURE.materials {
        let Reflectance::Fresnel { fresnel0, roughness } = material.reflectance else {
            panic!("{} is not of the DirectX 12 book", material.name)
        };
        assert!(
            fresnel0.iter().all(|f| (0.02..0.2).contains(f)),
            "{}: {fresnel0:?}",
            material.name
        );
        assert!((0.05..=1.0).contains(&roughness), "{}: {roughness}", material.name);
        assert!(
            material.diffuse.iter().all(|c| (0.0..0.9).contains(c)),
            "{}: {:?}",
            material.name,
            material.diffuse
        );
    }
}

#[test]
fn it_stands_on_the_ground_and_is_1_8_m_tall() {
    let bounds = |axis: usize| {
        let values = FIGURE.vertices.iter().map(|vertex| f64::from(vertex.position[axis]));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| {
            (min.min(value), max.max(value))
        })
    };
    let ((left, right), (bottom, top)) = (bounds(0), bounds(1));
    assert!(bottom.abs() < 0.003, "{bottom}");
    assert!((1.76..1.82).contains(&top), "{top}");
    assert!((left + right).abs() < 2.0 * WRITTEN_METRES, "{left} … {right}");
}

#[test]
fn the_bind_pose_is_its_own_mirror_image() {
    // Sums that run in the other order on the other side differ in their last bits, and so may the last decimal.
    let cell = |p: DVec3| (p * 2_000.0).round().as_i64vec3().to_array();
    let (welded, _) = welded(&FIGURE);
    let mut cells = BTreeMap::<[i64; 3], Vec<DVec3>>::new();
    for &point in &welded {
        cells.entry(cell(point)).or_default().push(point);
    }
    let mut alone = 0;
    for point in &welded {
        let mirrored = DVec3::new(-point.x, point.y, point.z);
        let [x, y, z] = cell(mirrored);
        let near = |[dx, dy, dz]: [i64; 3]| cells.get(&[x + dx, y + dy, z + dz]).into_iter().flatten();
        let offsets = (0..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]);
        let found = offsets
            .flat_map(near)
            .any(|other| other.distance(mirrored) < 5.0 * WRITTEN_METRES);
        alone += u32::from(!found);
    }
    assert_eq!(alone, 0, "of {} vertices", welded.len());
}

#[test]
fn the_committed_file_is_reproduced() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/sample/figure.m3d");
    let text = format::write(&FIGURE);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, &text).expect("web/sample can be written");
    }
    let committed = std::fs::read_to_string(path).expect("BLESS=1 writes the file that is missing");
    // The download stays small before compression too.
    assert!(committed.len() < 2_500_000, "{} bytes", committed.len());
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        assert!(
            committed == text,
            "web/sample/figure.m3d is not what the generator makes: BLESS=1 writes it anew"
        );
    }
    // Elsewhere a sine may differ in its last bit and flip a last decimal, but never the topology.
    let parsed = format::parse(committed.as_bytes()).expect("the project's own file is well formed");
    assert!(parsed.notices.is_empty(), "{:?}", parsed.notices);
    let (ours, theirs) = (&*FIGURE, &parsed.document);
    assert_eq!((&ours.materials, &ours.subsets), (&theirs.materials, &theirs.subsets));
    assert!(ours.triangles == theirs.triangles);
    assert_eq!(ours.bone_parents, theirs.bone_parents);
    assert_eq!(ours.vertices.len(), theirs.vertices.len());
    for (a, b) in ours.vertices.iter().zip(&theirs.vertices) {
        assert_eq!(a.blend_indices, b.blend_indices);
        assert_close(&a.position, &b.position);
        assert_close(&a.normal, &b.normal);
        assert_close(&a.tangent, &b.tangent);
        assert_close(&a.tex_coords, &b.tex_coords);
        assert_close(&a.blend_weights, &b.blend_weights);
    }
    for (a, b) in ours.bone_offsets.iter().zip(&theirs.bone_offsets) {
        assert_close(a, b);
    }
    let keys = |document: &Document| -> Vec<[f32; 8]> {
        let bones = document.clips.iter().flat_map(|clip| &clip.bones);
        let key = |key: &format::Keyframe| {
            let ([x, y, z], [i, j, k, w]) = (key.translation, key.rotation);
            [key.time_secs, x, y, z, i, j, k, w]
        };
        bones.flat_map(|bone| bone.keyframes.iter().map(key)).collect()
    };
    assert_eq!(keys(ours).len(), keys(theirs).len());
    for (a, b) in keys(ours).iter().zip(&keys(theirs)) {
        assert_close(a, b);
    }
}

/// Equal but for the last of four decimals.
fn assert_close(ours: &[f32], theirs: &[f32]) {
    let close = ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1.5e-4);
    assert!(close && ours.len() == theirs.len(), "{ours:?} is not {theirs:?}");
}

#[test]
fn it_makes_a_left_handed_model_without_a_word() {
    let (model, notices) = Model::from_document(&FIGURE, &LineMap::default()).expect("the figure is sound");
    assert!(notices.is_empty(), "{notices:?}");
    assert_eq!(model.handedness, Handedness::Left);
    assert_eq!(model.up_axis, UpAxis::Y);
    assert!(
        model.clips.iter().all(|clip| clip.frames().keys_per_sec == 30.0),
        "30 keys a second"
    );
}

#[test]
fn two_runs_are_equal() {
    assert!(bindpose::sample::figure() == *FIGURE);
}

#[test]
fn offsets_undo_the_bind_pose() {
    // The clips hold the bind lengths, so each joint's offset must put its origin where its children hang from.
    for (joint, &parent) in FIGURE
        .bone_parents
        .iter()
        .enumerate()
        .filter(|(_, parent)| **parent > 0)
    {
        let local = key(&FIGURE.clips[0], joint, 0).0;
        let in_parent = offset(parent as usize) * offset(joint).inverse();
        assert!(
            in_parent.w_axis.truncate().distance(local) < 0.06,
            "joint {joint} hangs {local} from its parent"
        );
        if joint > 1 {
            assert!(
                in_parent.w_axis.truncate().distance(local) < 3.0 * WRITTEN_METRES,
                "joint {joint}"
            );
        }
    }
}

#[test]
fn clips_loop_and_keep_30_keys_a_second() {
    let names: Vec<&str> = FIGURE.clips.iter().map(|clip| clip.name.as_str()).collect();
    assert_eq!(names, ["Walk", "Run", "Wave", "Idle"]);
    for clip in &FIGURE.clips {
        assert_eq!(clip.bones.len(), FIGURE.bone_offsets.len());
        let end = end_secs(clip);
        for (joint, bone) in clip.bones.iter().enumerate() {
            let (first, last) = (bone.keyframes[0], bone.keyframes[bone.keyframes.len() - 1]);
            assert_eq!(
                (first.time_secs, last.time_secs),
                (0.0, end),
                "{} joint {joint}",
                clip.name
            );
            assert_eq!(
                (first.translation, first.rotation),
                (last.translation, last.rotation),
                "{} {joint}",
                clip.name
            );
            for (before, after) in bone.keyframes.iter().zip(&bone.keyframes[1..]) {
                let spans = (after.time_secs - before.time_secs) * 30.0;
                assert!(
                    bone.keyframes.len() == 2 || (spans - 1.0).abs() < 1e-3,
                    "{} joint {joint}",
                    clip.name
                );
                let (a, b) = (quat(before.rotation), quat(after.rotation));
                assert!((a.length() - 1.0).abs() < 1e-5);
                // Neighbours on one side, and no joint jumps: 30 degrees in a thirtieth of a second.
                assert!(
                    a.dot(b) > 15f64.to_radians().cos(),
                    "{} joint {joint} at {}",
                    clip.name,
                    before.time_secs
                );
            }
        }
    }
}

#[test]
fn feet_stay_above_the_ground() {
    // Soles are soft: where they roll over heel and ball they press in a little.
    const PRESSED_METRES: f64 = 0.012;
    for clip in &FIGURE.clips {
        for frame in 0..=frames(clip) {
            let palette = palette(clip, frame);
            let lowest = FIGURE
                .vertices
                .iter()
                .map(|vertex| skinned(vertex, &palette).y)
                .fold(f64::INFINITY, f64::min);
            assert!(lowest > -PRESSED_METRES, "{} frame {frame}: {lowest}", clip.name);
            if clip.name != "Run" {
                assert!(
                    lowest < PRESSED_METRES,
                    "{} frame {frame} floats at {lowest}",
                    clip.name
                );
            }
        }
    }
}

#[test]
fn planted_feet_move_with_the_ground() {
    //             stance      flat part of it     metres a second
    for (name, from, to) in [("Walk", 0.10, 0.32), ("Run", 0.07, 0.16)] {
        let clip = FIGURE.clips.iter().find(|clip| clip.name == name).expect("named above");
        let count = frames(clip);
        for (ankle, shift) in [(LEFT_THIGH + 2, 0.0), (RIGHT_THIGH + 2, 0.5)] {
            let places: Vec<DVec3> = (0..count)
                .filter(|frame| (from..to).contains(&(*frame as f64 / count as f64 + shift).rem_euclid(1.0)))
                .map(|frame| model_from_joint(clip, frame)[ankle].w_axis.truncate())
                .collect();
            assert!(places.len() >= 2, "{name}");
            // Right feet may be planted across the loop: only steps between neighbours count.
            let steps: Vec<DVec3> = places
                .windows(2)
                .map(|pair| pair[1] - pair[0])
                .filter(|d| d.z > 0.0)
                .collect();
            for step in &steps {
                assert!((*step - steps[0]).length() < 5e-4, "{name}: {step} is not {}", steps[0]);
                assert!(
                    step.y.abs() < 5e-4 && step.x.abs() < 5e-4 && step.z > 0.02,
                    "{name}: {step}"
                );
            }
        }
    }
}

#[test]
fn knees_and_elbows_bend_their_own_way() {
    for clip in &FIGURE.clips {
        for frame in 0..=frames(clip) {
            let joints = model_from_joint(clip, frame);
            let origin = |joint: usize| joints[joint].w_axis.truncate();
            for thigh in [LEFT_THIGH, RIGHT_THIGH] {
                let (upper, lower) = (origin(thigh + 1) - origin(thigh), origin(thigh + 2) - origin(thigh + 1));
                let bent = upper.angle_between(lower).to_degrees();
                assert!(bent < 130.0, "{} frame {frame}: knee {bent}", clip.name);
                // The shin leaves the thigh's line backwards.
                let aside = lower.reject_from(upper);
                assert!(
                    bent < 2.0 || aside.z > 0.0,
                    "{} frame {frame}: the shin bends towards {aside}",
                    clip.name
                );
            }
            for upper_arm in [LEFT_THIGH - 11, RIGHT_THIGH - 11] {
                let upper = origin(upper_arm + 1) - origin(upper_arm);
                let bent = upper
                    .angle_between(origin(upper_arm + 2) - origin(upper_arm + 1))
                    .to_degrees();
                assert!(
                    (5.0..140.0).contains(&bent),
                    "{} frame {frame}: elbow {bent}",
                    clip.name
                );
            }
        }
    }
}

/// Index of the left thigh in the file; shin, foot and toe follow.
const LEFT_THIGH: usize = 19;
/// Likewise of the right thigh.
const RIGHT_THIGH: usize = 35;

fn is_below(joint: usize, ancestor: usize) -> bool {
    joint == ancestor || FIGURE.bone_parents[joint] >= 0 && is_below(FIGURE.bone_parents[joint] as usize, ancestor)
}

fn vector(numbers: [f32; 3]) -> DVec3 {
    DVec3::from_array(numbers.map(f64::from))
}

fn quat(numbers: [f32; 4]) -> DQuat {
    DQuat::from_array(numbers.map(f64::from))
}

fn position(corner: u32) -> DVec3 {
    vector(FIGURE.vertices[corner as usize].position)
}

/// Distinct positions, and which of them each vertex has.
fn welded(figure: &Document) -> (Vec<DVec3>, Vec<usize>) {
    let mut known = BTreeMap::new();
    let mut points = Vec::new();
    let vertex_of = figure.vertices.iter().map(|vertex| {
        *known.entry(vertex.position.map(f32::to_bits)).or_insert_with(|| {
            points.push(vector(vertex.position));
            points.len() - 1
        })
    });
    let vertex_of = vertex_of.collect();
    (points, vertex_of)
}

fn offset(joint: usize) -> DMat4 {
    DMat4::from_cols_array(&FIGURE.bone_offsets[joint].map(f64::from))
}

fn end_secs(clip: &AnimationClip) -> f32 {
    clip.bones
        .iter()
        .flat_map(|bone| bone.keyframes.last())
        .map(|key| key.time_secs)
        .fold(0.0, f32::max)
}

fn frames(clip: &AnimationClip) -> usize {
    (end_secs(clip) * 30.0).round() as usize
}

/// Translation and rotation of a joint at a frame; a still joint has keys at the ends only.
fn key(clip: &AnimationClip, joint: usize, frame: usize) -> (DVec3, DQuat) {
    let keys = &clip.bones[joint].keyframes;
    let key = keys[if keys.len() == 2 { 0 } else { frame }];
    (vector(key.translation), quat(key.rotation).normalize())
}

/// The textbook's way: parents times children.
fn model_from_joint(clip: &AnimationClip, frame: usize) -> Vec<DMat4> {
    let mut model = Vec::<DMat4>::new();
    for (joint, &parent) in FIGURE.bone_parents.iter().enumerate() {
        let (translation, rotation) = key(clip, joint, frame);
        let local = DMat4::from_rotation_translation(rotation, translation);
        model.push(if parent < 0 {
            local
        } else {
            model[parent as usize] * local
        });
    }
    model
}

fn palette(clip: &AnimationClip, frame: usize) -> Vec<DMat4> {
    model_from_joint(clip, frame)
        .into_iter()
        .enumerate()
        .map(|(joint, model)| model * offset(joint))
        .collect()
}

fn skinned(vertex: &bindpose::format::Vertex, palette: &[DMat4]) -> DVec3 {
    let point = vector(vertex.position);
    let influences = vertex.blend_weights.into_iter().zip(vertex.blend_indices);
    influences
        .map(|(weight, joint)| palette[joint as usize].transform_point3(point) * f64::from(weight))
        .sum()
}
