//! Small documents written by hand, and the real ones where they are.

use bindpose::anim::{CompiledClip, Extent, VertexGroups};
use bindpose::check;
use bindpose::diagnostic::{Diagnostic, Fault, codes};
use bindpose::format::{
    AnimationClip, BoneAnimation, Document, Keyframe, LineMap, Material, Parsed, Reflectance, Subset, Vertex, parse,
};
use bindpose::import::m3d;
use bindpose::model::{Channel, Model, Track};
use bindpose::slices::{Slices, at_once};
use glam::{Quat, Vec3};

use crate::shared::shared;

/// Real files, by folder and name.
#[rustfmt::skip]
pub(crate) const REAL_FILES: [&str; 6] =
    ["d3d12/soldier", "d3d11/base", "d3d11/stairs", "d3d11/rock", "d3d11/tree", "imm/column"];

/// The figure that the page opens with.
pub(crate) fn figure() -> Parsed {
    parse(include_bytes!("../../web/sample/figure.m3d")).expect("the project's own file parses")
}

/// A real file, where those are at hand.
pub(crate) fn real_file(name: &str) -> Option<Parsed> {
    let bytes = shared_bytes(&format!("models/{name}.m3d"))?;
    Some(parse(&bytes).expect("a real file parses"))
}

/// The D3D12 book's model with a clip, where it is at hand.
pub(crate) fn soldier() -> Option<Parsed> {
    real_file("d3d12/soldier")
}

pub(crate) fn soldier_bytes() -> Option<Vec<u8>> {
    shared_bytes("models/d3d12/soldier.m3d")
}

/// The bytes of a real file, where those are at hand.
pub(crate) fn shared_bytes(path: &str) -> Option<Vec<u8>> {
    shared(path).map(|path| std::fs::read(path).expect("the file can be read"))
}

/// The space that a clip needs, or rest without one.
pub(crate) fn extent(model: &Model, clip: Option<&CompiledClip>) -> Extent {
    at_once(async {
        let groups = VertexGroups::new(&model.mesh, &Slices::ENDLESS).await;
        Extent::of(model, &groups, clip, &Slices::ENDLESS).await
    })
}

/// The model of a document, and all that is found about it.
pub(crate) fn checked(document: &Document, lines: &LineMap) -> (Model, Vec<Diagnostic>) {
    let (model, mut findings) = m3d::from_document(document, lines).expect("the document is sound");
    findings.extend(check::model(&model, &CompiledClip::all(&model.clips), lines));
    (model, findings)
}

/// The same without what is about the mesh and the rig alone: small documents of other tests are full of it.
pub(crate) fn read(document: &Document, lines: &LineMap) -> (Model, Vec<Diagnostic>) {
    let (model, mut findings) = checked(document, lines);
    let alone = |finding: &Diagnostic| codes::OF_MESH_AND_RIG.iter().any(|code| code.name == finding.code);
    findings.retain(|finding| !alone(finding));
    (model, findings)
}

/// The same of a parsed file, with what its parser found before the rest.
pub(crate) fn read_parsed(parsed: &Parsed) -> (Model, Vec<Diagnostic>) {
    let (model, of_model) = read(&parsed.document, &parsed.lines);
    (model, parsed.diagnostics.iter().cloned().chain(of_model).collect())
}

/// The model and the codes of its findings.
pub(crate) fn model_of(document: &Document) -> (Model, Vec<&'static str>) {
    let (model, findings) = read(document, &LineMap::default());
    (model, findings.iter().map(|finding| finding.code).collect())
}

/// The words of the one finding with a code.
pub(crate) fn message_of(document: &Document, code: &str) -> String {
    let (_, findings) = read(document, &LineMap::default());
    let mut matching = findings.into_iter().filter(|finding| finding.code == code);
    let finding = matching.next().unwrap_or_else(|| panic!("no finding {code}"));
    assert!(matching.next().is_none(), "more than one finding {code}");
    finding.message
}

/// Asserts that this is found about a document, in these words, and nothing else.
#[track_caller]
pub(crate) fn assert_told(document: &Document, code: &str, words: &str) {
    let (_, findings) = read(document, &LineMap::default());
    let told: Vec<_> = findings
        .iter()
        .map(|finding| (finding.code, &*finding.message))
        .collect();
    assert_eq!(told, [(code, words)]);
}

/// Whether a message begins as a sentence does, with no small letter, and ends as one.
pub(crate) fn is_sentence(message: &str) -> bool {
    !message.starts_with(char::is_lowercase) && message.ends_with('.')
}

pub(crate) fn material(name: &str) -> Material {
    Material {
        name: name.to_owned(),
        diffuse: [0.5; 3],
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.05; 3],
            roughness: 0.5,
        },
        alpha_clip: false,
        type_name: String::new(),
        diffuse_map: None,
        normal_map: None,
    }
}

/// A vertex that faces −z, with u along +x and v along −y.
pub(crate) fn vertex(x: f32, y: f32) -> Vertex {
    Vertex {
        position: [x, y, 0.0],
        tangent: [1.0, 0.0, 0.0, 1.0],
        normal: [0.0, 0.0, -1.0],
        tex_coords: [x, -y],
        ..Vertex::default()
    }
}

pub(crate) fn subset(face_start: u32, face_count: u32) -> Subset {
    Subset {
        face_start,
        face_count,
        ..Subset::default()
    }
}

//  1 --- 2     clockwise from −z, where its normals point: the books' left-handed way
//  |   / |
//  | /   |
//  0 --- 3
pub(crate) fn quad() -> Document {
    Document {
        materials: vec![material("plain")],
        subsets: vec![subset(0, 2)],
        vertices: vec![vertex(0.0, 0.0), vertex(0.0, 1.0), vertex(1.0, 1.0), vertex(1.0, 0.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Document::default()
    }
}

/// The inverse of a translation, row vectors.
pub(crate) fn offset([x, y, z]: [f32; 3]) -> [f32; 16] {
    [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -x, -y, -z, 1.0,
    ]
}

/// A key without rotation or scale.
pub(crate) fn key(time_secs: f32, translation: [f32; 3]) -> Keyframe {
    Keyframe {
        time_secs,
        translation,
        scale: [1.0; 3],
        rotation: [0.0, 0.0, 0.0, 1.0],
    }
}

/// A turn about z.
pub(crate) fn turned(key: Keyframe, angle_radians: f32) -> Keyframe {
    let (sine, cosine) = (angle_radians * 0.5).sin_cos();
    Keyframe {
        rotation: [0.0, 0.0, sine, cosine],
        ..key
    }
}

pub(crate) fn track(keyframes: impl Into<Vec<Keyframe>>) -> BoneAnimation {
    BoneAnimation {
        keyframes: keyframes.into(),
    }
}

/// Three bones one above the other at heights 0, 1 and 2, a strip of vertices along them that blends from each to the
/// next, and a clip `bend` of one second in which each turns by a quarter about z.
pub(crate) fn arm() -> Document {
    let turn = std::f32::consts::FRAC_PI_2;
    let moved = |translation| track([key(0.0, translation), turned(key(1.0, translation), turn)]);
    let vertices = (0..=6).flat_map(|step| {
        let height = step as f32 * 0.5;
        let (bone, above) = ((height as u32).min(2), (height.fract() * 2.0) * 0.5);
        [-0.25, 0.25].map(|x| Vertex {
            blend_weights: [1.0 - above, above, 0.0, 0.0],
            blend_indices: [bone, (bone + 1).min(2), 0, 0],
            ..vertex(x, height)
        })
    });
    Document {
        materials: vec![material("skin")],
        subsets: vec![subset(0, 12)],
        vertices: vertices.collect(),
        triangles: (0..6)
            .flat_map(|step| {
                let low = step * 2;
                [[low, low + 2, low + 3], [low, low + 3, low + 1]]
            })
            .collect(),
        bone_offsets: vec![offset([0.0; 3]), offset([0.0, 1.0, 0.0]), offset([0.0, 2.0, 0.0])],
        bone_parents: vec![-1, 0, 1],
        clips: vec![AnimationClip {
            name: "bend".to_owned(),
            bones: vec![moved([0.0; 3]), moved([0.0, 1.0, 0.0]), moved([0.0, 1.0, 0.0])],
        }],
        ..Document::default()
    }
}

/// The document with its bones in another order: bone `order[i]` of the old one becomes bone i.
pub(crate) fn reordered(document: &Document, order: &[u32]) -> Document {
    let mut place = vec![0; order.len()];
    for (bone, &old) in (0u32..).zip(order) {
        place[old as usize] = bone;
    }
    let mut out = document.clone();
    for (bone, &old) in order.iter().enumerate() {
        let old = old as usize;
        out.bone_offsets[bone] = document.bone_offsets[old];
        out.bone_parents[bone] = match document.bone_parents[old] {
            -1 => -1,
            parent => place[parent as usize] as i32,
        };
        for (clip, old_clip) in out.clips.iter_mut().zip(&document.clips) {
            clip.bones[bone] = old_clip.bones[old].clone();
        }
    }
    for vertex in &mut out.vertices {
        vertex.blend_indices = vertex.blend_indices.map(|bone| place[bone as usize]);
    }
    out
}

/// The track with another translation.
pub(crate) fn with_translation(track: &Track, translation: Result<Channel<Vec3>, Fault>) -> Track {
    let translation = translation.expect("sound keys");
    Track::of_channels(translation, track.rotation().clone(), track.scale().clone())
}

/// The track with another rotation.
pub(crate) fn with_rotation(track: &Track, rotation: Result<Channel<Quat>, Fault>) -> Track {
    let rotation = rotation.expect("sound keys");
    Track::of_channels(track.translation().clone(), rotation, track.scale().clone())
}
