//! What a file of the books' format says of a model.

use glam::Vec4;

use super::look::Look;
use crate::anim::straight;
use crate::format::{self, AnimationClip, BoneAnimation, Dialect, Document, Keyframe, Subset, Vertex};
use crate::model::{JointIndex, LocalJoint, MapSlot, Material, Model, Track, one_word, unique_words};

/// A joint this near to its place in the bind pose, in sizes of the model, is there: matrices lose as much.
const REST_TOLERANCE: f32 = 1e-5;

/// The materials in the order of the subsets, since subset i is drawn with material i.
pub(super) fn of_subsets(model: &Model) -> impl Iterator<Item = &Material> + Clone {
    let materials = model.mesh.submeshes.iter().map(|submesh| submesh.material as usize);
    materials.map(|material| &model.materials[material])
}

/// Whether a file of the dialect says the name of a material.
pub(super) fn names_materials(dialect: Dialect) -> bool {
    dialect == Dialect::D3d12
}

/// `looks` are those of the model's materials.
pub(super) fn document(model: &Model, dialect: Dialect, looks: &[Look]) -> Document {
    let skinned = model.skeleton.joint_count() > 0;
    let tangents = model.mesh.tangents_or_computed();
    let rests = rests_apart(model);
    let material_names = unique_words(of_subsets(model).map(|material| material.name.as_str()));
    let clip_names = unique_words(model.clips.iter().map(|clip| clip.name.as_str()));
    let submeshes = match dialect {
        Dialect::Text => &[],
        _ => &model.mesh.submeshes[..],
    };
    let of_subsets = submeshes.iter().map(|submesh| submesh.material as usize);
    let materials = of_subsets.map(|material| (&model.materials[material], &looks[material]));
    Document {
        dialect,
        materials: materials
            .zip(material_names)
            .map(|(of_model, name)| material(of_model, name, dialect, skinned))
            .collect(),
        subsets: subsets(model).collect(),
        vertices: (0..model.mesh.vertex_count())
            .map(|index| vertex(model, &tangents, index))
            .collect(),
        triangles: model
            .mesh
            .indices
            .chunks_exact(3)
            .map(|corners| [corners[0], corners[1], corners[2]])
            .collect(),
        bone_offsets: in_file_order(model).map(|joint| offset(model, joint)).collect(),
        bone_parents: in_file_order(model).map(|joint| parent_bone(model, joint)).collect(),
        clips: model
            .clips
            .iter()
            .zip(clip_names)
            .map(|(clip, name)| AnimationClip {
                name,
                bones: in_file_order(model)
                    .map(|joint| keys(&clip.tracks[joint.index()], rests[joint.index()].as_ref()))
                    .collect(),
            })
            .collect(),
    }
}

fn in_file_order(model: &Model) -> impl Iterator<Item = JointIndex> {
    model.skeleton.joint_of_bone().iter().copied()
}

fn parent_bone(model: &Model, joint: JointIndex) -> i32 {
    let parent = model.skeleton.parents()[joint.index()];
    parent.map_or(-1, |parent| model.skeleton.file_bones()[parent.index()].cast_signed())
}

/// Row vectors, row by row, are the columns of our column-vector matrix.
fn offset(model: &Model, joint: JointIndex) -> [f32; 16] {
    glam::Mat4::from(model.skeleton.joint_from_bind()[joint.index()]).to_cols_array()
}

fn material((material, look): (&Material, &Look), name: String, dialect: Dialect, skinned: bool) -> format::Material {
    let (diffuse, reflectance) = look.written_values(material, dialect);
    let map = |slot| material.map_name(slot).map(one_word);
    format::Material {
        name: if names_materials(dialect) { name } else { String::new() },
        diffuse,
        reflectance,
        alpha_clip: material.is_cut(),
        type_name: if skinned { "Skinned" } else { "Normal" }.to_owned(),
        diffuse_map: map(MapSlot::Diffuse),
        normal_map: map(MapSlot::Normal),
    }
}

/// The least and the greatest vertex of some corners.
fn ends<'a>(corners: impl Iterator<Item = &'a [u32; 2]>) -> [u32; 2] {
    let wider = |[least, most]: [u32; 2], &[start, end]: &[u32; 2]| [least.min(start), most.max(end)];
    corners.fold([u32::MAX, 0], wider)
}

/// Subsets may overlap, so the ends of whole blocks of triangles are found once.
fn subsets(model: &Model) -> impl Iterator<Item = Subset> {
    const BLOCK: usize = 1024;
    let (triangles, _) = model.mesh.indices.as_chunks::<3>();
    let of_triangle = |corners: &[u32; 3]| ends(corners.map(|corner| [corner; 2]).iter());
    let of_triangles: Vec<[u32; 2]> = triangles.iter().map(of_triangle).collect();
    let of_blocks: Vec<[u32; 2]> = of_triangles.chunks(BLOCK).map(|block| ends(block.iter())).collect();
    let submeshes = (0u32..).zip(&model.mesh.submeshes);
    submeshes.map(move |(id, submesh)| {
        let start = submesh.triangle_start as usize;
        let end = start + submesh.triangle_count as usize;
        let (first, last) = (start.div_ceil(BLOCK), end / BLOCK);
        let [least, most] = if first < last {
            let sides = [start..first * BLOCK, last * BLOCK..end].map(|side| ends(of_triangles[side].iter()));
            ends(sides.iter().chain(&of_blocks[first..last]))
        } else {
            ends(of_triangles[start..end].iter())
        };
        let is_empty = start == end;
        Subset {
            id,
            vertex_start: if is_empty { 0 } else { least },
            vertex_count: if is_empty { 0 } else { most - least + 1 },
            face_start: submesh.triangle_start,
            face_count: submesh.triangle_count,
        }
    })
}

fn vertex(model: &Model, tangents: &[Vec4], index: usize) -> Vertex {
    let mesh = &model.mesh;
    let influences = mesh.influences.get(index).copied().unwrap_or_default();
    let bone = |slot: usize| match influences.weights[slot] {
        0.0 => 0,
        _ => model.skeleton.file_bones()[influences.joints[slot] as usize],
    };
    Vertex {
        position: mesh.positions[index].to_array(),
        tangent: tangents[index].to_array(),
        normal: mesh.normals[index].to_array(),
        tex_coords: mesh.tex_coords[index].to_array(),
        blend_weights: influences.weights,
        blend_indices: std::array::from_fn(bone),
    }
}

/// The keys of a joint. One that a clip leaves at rest elsewhere than in the bind pose gets a key there, since the format knows no
/// other rest.
fn keys(track: &Track, rest_apart: Option<&LocalJoint>) -> BoneAnimation {
    let keyframes = if track.has_keys() {
        let track = straight(track);
        track
            .keys()
            .map(|(time_secs, joint)| keyframe(time_secs, joint))
            .collect()
    } else {
        rest_apart.map(|&rest| keyframe(0.0, rest)).into_iter().collect()
    };
    BoneAnimation { keyframes }
}

fn keyframe(time_secs: f32, joint: LocalJoint) -> Keyframe {
    Keyframe {
        time_secs,
        translation: joint.translation.to_array(),
        scale: joint.scale.to_array(),
        rotation: joint.rotation.to_array(),
    }
}

/// The rest of each joint that is not where the bind pose has it.
pub(super) fn rests_apart(model: &Model) -> Vec<Option<LocalJoint>> {
    let size = model.bind_bounds().size().length();
    let rests = model.skeleton.rest().iter();
    rests
        .zip(model.skeleton.bind().iter().copied())
        .map(|(&rest, bind)| {
            let near = rest.translation.distance(bind.translation) <= REST_TOLERANCE * size
                && rest.scale.distance(bind.scale) <= REST_TOLERANCE
                && 1.0 - rest.rotation.dot(bind.rotation).abs() <= REST_TOLERANCE;
            (rest != bind && !near).then_some(rest)
        })
        .collect()
}
