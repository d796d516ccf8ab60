//! What polygons become: triangles, materials, weights; and what is told where something has no place in a model.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use bindpose::import::{Imported, import};
use bindpose::model::Model;
use glam::DVec3;
use ufbx::Scene;

use super::files;

/// Areas of what has each material, by its name.
type Areas = BTreeMap<String, f64>;

fn area(model: &Model) -> Areas {
    let mut areas = Areas::new();
    for submesh in &model.mesh.submeshes {
        let name = &model.materials[submesh.material as usize].name;
        let corners = &model.mesh.indices[3 * submesh.triangle_start as usize..][..3 * submesh.triangle_count as usize];
        let corner = |corner: u32| model.mesh.positions[corner as usize].as_dvec3();
        let triangles = corners.as_chunks::<3>().0.iter().map(|&[a, b, c]| {
            let [a, b, c] = [a, b, c].map(corner);
            (b - a).cross(c - a).length() / 2.0
        });
        *areas.entry(name.clone()).or_default() += triangles.sum::<f64>();
    }
    areas
}

/// The same of a scene of ufbx: each polygon by Newell's normal, whose length is twice the area of a flat outline.
fn polygon_areas(scene: &Scene) -> Areas {
    let mut areas = Areas::new();
    for node in scene.nodes.iter() {
        let Some(mesh) = &node.mesh else { continue };
        let to_world = &node.geometry_to_world;
        let place = |corner: usize| {
            let position = mesh.vertices[mesh.vertex_indices[corner] as usize];
            let [x, y, z] = [position.x, position.y, position.z];
            DVec3::new(
                to_world.m00 * x + to_world.m01 * y + to_world.m02 * z + to_world.m03,
                to_world.m10 * x + to_world.m11 * y + to_world.m12 * z + to_world.m13,
                to_world.m20 * x + to_world.m21 * y + to_world.m22 * z + to_world.m23,
            )
        };
        for (index, face) in mesh.faces.iter().enumerate().filter(|(_, face)| face.num_indices >= 3) {
            let outline: Vec<DVec3> = (face.index_begin..face.index_begin + face.num_indices)
                .map(|corner| place(corner as usize))
                .collect();
            let origin = outline[0];
            let doubled: DVec3 = (1..outline.len() - 1)
                .map(|at| (outline[at] - origin).cross(outline[at + 1] - origin))
                .sum();
            let material = mesh.face_material.get(index).copied().unwrap_or_default() as usize;
            let name = node
                .materials
                .get(material)
                .map_or("default", |material| &*material.element.name);
            *areas.entry(name.to_owned()).or_default() += doubled.length() / 2.0;
        }
    }
    areas
}

#[test]
fn triangles_cover_each_polygon_once_in_its_material() {
    // Outlines that are not flat have no area of their own: theirs are compared where they are nearly so.
    let is_flat = |name: &str| {
        [
            "ngon",
            "cube",
            "material",
            "axes",
            "pivot",
            "transform",
            "lambert",
            "phong",
        ]
        .iter()
        .any(|word| name.contains(word))
    };
    let (mut wrong, mut count, mut concave) = (Vec::new(), 0, 0);
    for (name, bytes) in files("files").into_iter().filter(|(name, _)| is_flat(name)) {
        let opts = ufbx::LoadOpts {
            target_unit_meters: 1.0,
            ..ufbx::LoadOpts::default()
        };
        let (Ok(imported), Ok(scene)) = (import(&bytes), ufbx::load_memory(&bytes, opts)) else {
            continue;
        };
        let moves = scene.meshes.iter().any(|mesh| !mesh.skin_deformers.is_empty());
        if moves || imported.model.mesh.positions.is_empty() {
            continue;
        }
        let (ours, theirs) = (area(&imported.model), polygon_areas(&scene));
        let whole: f64 = theirs.values().sum();
        let off = |name: &String| {
            let [our, their] = [&ours, &theirs].map(|areas| areas.get(name).copied().unwrap_or_default());
            (our - their).abs() / whole
        };
        let worst = ours.keys().chain(theirs.keys()).map(off).fold(0.0, f64::max);
        count += 1;
        concave += usize::from(name.contains("ngon"));
        if worst > 1e-3 {
            wrong.push(format!("{name}: {ours:?}, not {theirs:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(
        count == 0 || (count > 30 && concave >= 4),
        "{count} files, {concave} with polygons of many corners"
    );
}

#[test]
fn what_has_no_place_in_a_model_is_told() {
    let found: Vec<(String, Vec<u8>)> = files("files");
    if found.is_empty() {
        return;
    }
    for (start, told) in [
        ("maya_dual_quaternion_7500", "skinned by dual quaternions"),
        ("blender_331_static_blend_shape", "blend shape"),
        ("blender_279_shape_weights_6100_ascii", "blend shape"),
        ("maya_anim_light_7500_ascii", "light"),
        ("maya_camera_light_axes_y_up_7700_ascii", "camera"),
        ("maya_lod_group_7500_ascii", "levels of detail"),
        ("maya_human_ik_7400_binary", "rig"),
        ("maya_constraint_zoo_7500_ascii", "constraint"),
        ("max_geometry_transform_types_7700_ascii", "NURBS"),
        ("maya_anim_layers_", "several layers"),
        ("maya_game_sausage_6100_ascii", "subdivision"),
    ] {
        let mut files = found.iter().filter(|(name, _)| name.starts_with(start));
        let (name, bytes) = files.next().unwrap_or_else(|| panic!("{start} is there"));
        let Imported { diagnostics, .. } = import(bytes).unwrap_or_else(|_| panic!("{name}"));
        let messages: Vec<_> = diagnostics
            .iter()
            .map(|finding| (finding.code, &*finding.message))
            .collect();
        let is_told = messages
            .iter()
            .any(|(code, message)| *code == "fbx-left-out" && message.contains(told));
        assert!(is_told, "{name}: {told} in {messages:?}");
    }
}

#[test]
fn each_kind_that_has_no_place_in_a_model_is_told_once_with_its_objects() {
    let objects: String = (300..)
        .zip([
            ("Geometry", "Sail", "NurbsSurface"),
            ("Geometry", "Rope", "NurbsCurve"),
            ("Deformer", "Cloth", "VertexCacheDeformer"),
            ("Cache", "Points", ""),
            ("Constraint", "Look", "Aim"),
            ("Character", "Rig", ""),
            ("Model", "Foot", "IKEffector"),
            ("Model", "Hip", "FKEffector"),
            ("Model", "Sun", "Light"),
            ("Audio", "Steps", ""),
        ])
        .map(|(id, (class, name, kind))| format!("\t{class}: {id}, \"{class}::{name}\", \"{kind}\" {{\n\t}}\n"))
        .collect();
    let file = skinned(&[1.0]).replacen("Objects:  {\n", &format!("Objects:  {{\n{objects}"), 1);
    let imported = import(file.as_bytes()).unwrap_or_else(|refused| panic!("{:?}", refused.error));
    let mut told: Vec<&str> = imported
        .diagnostics
        .iter()
        .filter(|finding| finding.code == "fbx-left-out")
        .map(|finding| &*finding.message)
        .filter(|message| message.starts_with("Not taken"))
        .collect();
    told.sort_unstable();
    assert_eq!(
        told,
        [
            "Not taken: 1 light: Sun.",
            "Not taken: 1 sound: Steps.",
            "Not taken: 2 NURBS surfaces, patches or lines: Sail, Rope.",
            "Not taken: 2 caches of vertices: Cloth, Points.",
            "Not taken: 4 constraints or rigs of a program: Look, Rig, Foot and 1 more.",
        ]
    );
}

#[test]
fn pictures_in_a_file_are_taken() {
    for name in [
        "blender_293_embedded_textures_7400_binary.fbx",
        "synthetic_embedded_base64_7700_ascii.fbx",
    ] {
        let Some((_, bytes)) = files("files").into_iter().find(|(file, _)| file == name) else {
            return;
        };
        let pictures = import(&bytes).expect("it is sound").pictures;
        assert!(!pictures.is_empty(), "{name}");
        for picture in &pictures {
            assert!(picture.bytes.starts_with(b"\x89PNG"), "{name}: {}", picture.name);
        }
    }
}

/// A sheet of 2 × 1 in the shape of an L, skinned by some bones, each with this weight for all points.
pub(super) fn skinned(weights: &[f64]) -> String {
    let mut objects = String::new();
    let mut connections = String::from("\tC: \"OO\",2,0\n\tC: \"OO\",1,2\n\tC: \"OO\",3,1\n");
    let mut poses = String::new();
    let identity = |x: f64| format!("*16 {{\n\t\t\ta: 1,0,0,0,0,1,0,0,0,0,1,0,{x},0,0,1\n\t\t}}");
    for (bone, weight) in weights.iter().enumerate() {
        let (model, cluster, x) = (100 + bone, 200 + bone, bone as f64);
        writeln!(
            objects,
            "\tModel: {model}, \"Model::Bone {bone}\", \"LimbNode\" {{\n\t\tProperties70:  {{\n\t\t\tP: \"Lcl Translation\", \
             \"Lcl Translation\", \"\", \"A\",{x},0,0\n\t\t}}\n\t}}\n\tDeformer: {cluster}, \"SubDeformer::\", \"Cluster\" {{\n\t\t\
             Indexes: *6 {{\n\t\t\ta: 0,1,2,3,4,5\n\t\t}}\n\t\tWeights: *6 {{\n\t\t\ta: {weight},{weight},{weight},{weight},{weight},\
             {weight}\n\t\t}}\n\t\tTransform: {}\n\t\tTransformLink: {}\n\t}}",
            identity(-x),
            identity(x)
        )
        .expect("a string");
        writeln!(
            connections,
            "\tC: \"OO\",{model},0\n\tC: \"OO\",{cluster},3\n\tC: \"OO\",{model},{cluster}"
        )
        .expect("a string");
        // The pose has the last bone elsewhere.
        let posed = if bone + 1 == weights.len() { x + 5.0 } else { x };
        writeln!(
            poses,
            "\t\tPoseNode:  {{\n\t\t\tNode: {model}\n\t\t\tMatrix: {}\n\t\t}}",
            identity(posed)
        )
        .expect("a string");
    }
    format!(
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {{\n\tFBXVersion: 7400\n}}\nObjects:  {{\n\tGeometry: 1, \"Geometry::L\", \
         \"Mesh\" {{\n\t\tVertices: *18 {{\n\t\t\ta: 0,0,0,2,0,0,2,1,0,1,1,0,1,2,0,0,2,0\n\t\t}}\n\t\tPolygonVertexIndex: *6 {{\n\t\t\ta: \
         0,1,2,3,4,-6\n\t\t}}\n\t}}\n\tModel: 2, \"Model::L\", \"Mesh\" {{\n\t}}\n\tDeformer: 3, \"Deformer::\", \"Skin\" {{\n\t}}\n{objects}\tPose: \
         5, \"Pose::\", \"BindPose\" {{\n{poses}\t}}\n}}\nConnections:  {{\n{connections}}}\n"
    )
}

#[test]
fn of_six_weights_the_four_greatest_are_kept_and_told() {
    let file = skinned(&[0.05, 0.3, 0.1, 0.25, 0.2, 0.1]);
    let imported = import(file.as_bytes()).unwrap_or_else(|refused| panic!("{:?}", refused.error));
    let model = &imported.model;
    assert_eq!(model.mesh.indices.len(), 12, "an L of six corners is four triangles");
    assert!(
        (area(model).values().sum::<f64>() - 3.0 * 1e-4).abs() < 1e-10,
        "in metres: {:?}",
        area(model)
    );
    for influences in &model.mesh.influences {
        let names = influences
            .joints
            .map(|joint| model.skeleton.name(bindpose::model::JointIndex(joint)));
        let found: Vec<_> = names.into_iter().zip(influences.weights).collect();
        let name = |bone: &str| {
            found
                .iter()
                .find(|(name, _)| *name == Some(bone))
                .map(|(_, weight)| *weight)
        };
        // 0.3, 0.25, 0.2 and 0.1 of 0.85; of two equal ones the first stays.
        for (bone, weight) in [("Bone 1", 0.3), ("Bone 3", 0.25), ("Bone 4", 0.2), ("Bone 2", 0.1)] {
            let kept = name(bone).unwrap_or_else(|| panic!("{bone} in {found:?}"));
            assert!((kept - weight / 0.85).abs() < 1e-6, "{bone}: {found:?}");
        }
    }
    let told = |code: &str| {
        let mut findings = imported.diagnostics.iter().filter(|finding| finding.code == code);
        findings.next().map(|finding| finding.message.clone())
    };
    let cut = told("weights-cut").expect("it is told");
    assert!(cut.contains("6 vertices") && cut.contains("15"), "{cut}");
    let posed = told("fbx-left-out").expect("the pose disagrees");
    assert_eq!(
        posed,
        "1 bone is bound in another way than the bind pose says; the skin is believed: Bone 5."
    );
}
