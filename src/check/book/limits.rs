//! What the books' demos cannot show, or show otherwise than it is meant, though their loaders read it.

use std::collections::BTreeSet;

use super::demo::{Book, DEMO_CLIP, DEMO_MATERIALS, DEMO_SCALE, SEEN_HEIGHTS};
use crate::diagnostic::collect::{counted, named};
use crate::diagnostic::limits::{MOST_BONE_INDEX, MOST_BONES, MOST_MATERIALS, MOST_VERTICES};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::format::{Document, Keyframe, Material, QuickRows, QuickRun, Vertex};
use crate::model::Handedness;
use crate::sorting;

/// What is known of a file beside its bytes. What is not known is not judged.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known<'a> {
    /// What the file means. Without it limits are found only in a file that the loader reads as it is meant.
    pub document: Option<&'a Document>,
    /// Which of the document's rows stand as they should in the bytes, so that they are not read again.
    pub quick: Option<&'a QuickRows>,
    /// Handedness of the model.
    pub handedness: Option<Handedness>,
    /// Names of maps for which there is no file.
    pub missing_maps: Option<&'a [String]>,
}

impl<'a> Known<'a> {
    /// What the file means, and which of its rows need not be read again.
    pub(super) fn rows(&self) -> Option<(&'a Document, &'a QuickRows)> {
        self.document.zip(self.quick)
    }

    /// The keys of a bone in a clip, where they need not be read again.
    pub(super) fn track(&self, clip: u32, bone: u32) -> Option<(&'a [Keyframe], &'a QuickRun)> {
        let (document, quick) = self.rows()?;
        let [clip, bone] = [clip, bone].map(|index| index as usize);
        let keys = &document.clips.get(clip)?.bones.get(bone)?.keyframes;
        Some((keys, quick.tracks.get(clip)?.get(bone)?.as_ref()?))
    }
}

/// Something that a demo cannot show as it is meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limit {
    /// Name of its [`Code`](crate::diagnostic::Code).
    pub code: &'static str,
    /// One sentence.
    pub message: String,
}

impl Limit {
    /// It as a finding; `whose` is whose limit it is.
    pub fn diagnostic(&self, whose: &str) -> Option<Diagnostic> {
        Some(codes::named(self.code)?.says(format!("{whose}: {}", self.message)))
    }
}

/// A fourth weight may differ by this from what the shader makes of it: files have six digits.
const WEIGHT_TOLERANCE: f32 = 1e-3;

/// Normal maps without bumps: the one that an export for the book adds, and the demo's own.
const FLAT_MAPS: [&str; 2] = ["flat_normal.dds", "default_nmap.dds"];

/// A rotation's length may differ by this from 1 before one sees it: a thousandth of a bone's length.
const ROTATION_TOLERANCE: f32 = 1e-3;

/// All limits that a file meets, the gravest first. `document` is what the file means, where that is known; `read` is what the loader made
/// of it, by which materials and maps are judged: the demos know no word for "no map".
pub(super) fn limits(book: Book, document: Option<&Document>, read: &Document, known: &Known<'_>) -> Vec<Limit> {
    let mut limits = Limits(Vec::new());
    if let Some(document) = document {
        limits.meant(book, document, known);
    }
    if book == Book::D3d12 {
        limits.materials(&read.materials);
    }
    limits.maps(book, read, known.missing_maps);
    limits.0
}

/// The first map that a demo cannot open, whatever lies beside the file: its material, and its name as the loader reads it.
pub(super) fn unreadable_map(book: Book, read: &Document) -> Option<(usize, &String)> {
    let kinds: &[&str] = match book {
        // D3DX of that time.
        Book::D3d11 => &["dds", "bmp", "jpg", "jpeg", "png", "tif", "tiff", "gif"],
        Book::D3d12 => &["dds"],
    };
    let is_read = |name: &str| {
        let extension = name.rsplit_once('.').map(|(_, extension)| extension);
        extension.is_some_and(|extension| kinds.iter().any(|kind| kind.eq_ignore_ascii_case(extension)))
    };
    maps(read).find(|(_, name)| !is_read(name))
}

pub(super) fn map_count(document: &Document) -> usize {
    maps(document).map(|(_, name)| name).collect::<BTreeSet<_>>().len()
}

fn maps(document: &Document) -> impl Iterator<Item = (usize, &String)> {
    let of_each = document.materials.iter().enumerate();
    of_each.flat_map(|(index, material)| {
        let maps = [&material.diffuse_map, &material.normal_map];
        maps.into_iter().flatten().map(move |name| (index, name))
    })
}

struct Limits(Vec<Limit>);

impl Limits {
    fn meant(&mut self, book: Book, document: &Document, known: &Known<'_>) {
        self.vertices(document);
        if document.bone_parents.is_empty() {
            return;
        }
        self.bones(document);
        self.influences(document);
        self.clips(document);
        self.alpha(document);
        self.space(document, known.handedness);
        if book == Book::D3d12 {
            self.tangent_signs(document);
        }
    }

    fn add(&mut self, code: &'static Code, message: String) {
        self.0.push(Limit {
            code: code.name,
            message,
        });
    }

    fn vertices(&mut self, document: &Document) {
        let count = document.vertices.len();
        if count > MOST_VERTICES {
            let message = format!("It has {count} vertices; 16-bit indices can number {MOST_VERTICES}.");
            self.add(&codes::MANY_VERTICES, message);
        }
    }

    fn bones(&mut self, document: &Document) {
        let parents = &document.bone_parents;
        let count = parents.len();
        if count > MOST_BONES {
            let message = format!("It has {count} bones; the shaders have room for {MOST_BONES}.");
            self.add(&codes::MANY_BONES, message);
        }
        let bones = || (0i32..).zip(parents).skip(1);
        if let Some((bone, _)) =
            bones().find(|&(_, &parent)| usize::try_from(parent).is_err() || parent as usize >= count)
        {
            let message = format!(
                "Bone {bone} has no parent; only bone 0 may be a root, and memory before the matrices is read."
            );
            self.add(&codes::BOOK_ROOTS, message);
        }
        if let Some(parent) = parents.first().filter(|parent| **parent >= 0) {
            let message = format!("Bone 0 has bone {parent} as its parent; it is taken as the root all the same.");
            self.add(&codes::BOOK_ROOTS, message);
        }
        let before = bones().filter(|&(bone, &parent)| parent >= bone).count();
        if before > 0 {
            let one = "bone stands before its parent, whose matrix is still zero: what hangs on it";
            let many = "bones stand before their parents, whose matrices are still zero: what hangs on them";
            let message = format!("{} shrinks to a point.", counted(before, one, many));
            self.add(&codes::BONES_REORDERED, message);
        }
    }

    /// Of the D3D12 book's demo, which keeps materials by name, beside its own.
    fn materials(&mut self, materials: &[Material]) {
        let count = materials.len();
        if count > MOST_MATERIALS {
            let message = format!("It has {count} materials; the shader reaches the maps of {MOST_MATERIALS}.");
            self.add(&codes::BOOK_MANY_MATERIALS, message);
        }
        let names = materials.iter().map(|material| material.name.as_str());
        let own: Vec<&str> = names.clone().filter(|name| DEMO_MATERIALS.contains(name)).collect();
        if !own.is_empty() {
            let message = format!(
                "The demo has materials of its own called {}: those of the file take their place, and parts of the scene look like them.",
                named(own)
            );
            self.add(&codes::BOOK_MATERIAL_NAME, message);
        }
        let mut met = BTreeSet::new();
        let again: Vec<&str> = names.filter(|name| !name.is_empty() && !met.insert(*name)).collect();
        if !again.is_empty() {
            let message = format!(
                "The demo keeps one material of a name, and draws all that have it with the last one: {}.",
                named(again)
            );
            self.add(&codes::DUPLICATE_MATERIAL_NAME, message);
        }
    }

    fn influences(&mut self, document: &Document) {
        let with_weight = |vertex: &Vertex| {
            let slots = vertex.blend_weights.into_iter().zip(vertex.blend_indices);
            let used = slots.filter(|(weight, _)| *weight != 0.0);
            used.map(|(_, bone)| bone).max().unwrap_or_default()
        };
        let above = document
            .vertices
            .iter()
            .filter(|vertex| with_weight(vertex) > MOST_BONE_INDEX)
            .count();
        if above > 0 {
            let message = format!(
                "{} a bone above {MOST_BONE_INDEX}, of which a byte keeps the remainder: another bone moves {}.",
                counted(above, "vertex names", "vertices name"),
                if above == 1 { "it" } else { "them" }
            );
            self.add(&codes::BONE_INDEX_ABOVE_BYTE, message);
        }
        let differs = |vertex: &&Vertex| {
            let [first, second, third, fourth] = vertex.blend_weights;
            (1.0 - first - second - third - fourth).abs() > WEIGHT_TOLERANCE
        };
        let differing = document.vertices.iter().filter(differs).count();
        if differing > 0 {
            let message = format!(
                "The shader takes what the first three weights leave to 1; in the file {} another fourth weight.",
                counted(differing, "vertex has", "vertices have")
            );
            self.add(&codes::BOOK_FOURTH_WEIGHT, message);
        }
    }

    fn clips(&mut self, document: &Document) {
        let clips = &document.clips;
        let first_word = |name: &'_ str| name.split_whitespace().next().unwrap_or_default().to_owned();
        if clips.iter().all(|clip| clip.name != DEMO_CLIP) {
            let names: Vec<_> = clips.iter().take(3).map(|clip| format!("\"{}\"", clip.name)).collect();
            let has = if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            };
            let message = format!("The demo plays the clip \"{DEMO_CLIP}\"; the file has {has}.");
            self.add(&codes::BOOK_CLIP_NAME, message);
        }
        let mut names: Vec<_> = clips.iter().map(|clip| first_word(&clip.name)).collect();
        sorting::sort(&mut names);
        let all = names.len();
        names.dedup();
        if names.len() < all {
            let message = format!(
                "{} of {all} clips can be found: they are kept by the first word of their name, and the last of a name stays.",
                names.len()
            );
            self.add(&codes::DUPLICATE_CLIP_NAME, message);
        }
        let tracks = || clips.iter().flat_map(|clip| &clip.bones);
        let steps_back = |bone: &&crate::format::BoneAnimation| {
            bone.keyframes
                .windows(2)
                .any(|keys| keys[0].time_secs > keys[1].time_secs)
        };
        let unsorted = tracks().filter(steps_back).count();
        if unsorted > 0 {
            let message = format!(
                "The keys of {} are not in the order of time: the motion jumps.",
                counted(unsorted, "track", "tracks")
            );
            self.add(&codes::KEYS_NOT_SORTED, message);
        }
        let keys = || tracks().flat_map(|bone| &bone.keyframes);
        let stretched = keys().filter(|key| {
            let length = key.rotation.map(|part| part * part).iter().sum::<f32>().sqrt();
            (length - 1.0).abs() > ROTATION_TOLERANCE
        });
        let stretched = stretched.count();
        if stretched > 0 {
            let message = format!(
                "{} of another length than 1: what hangs on the bone is stretched.",
                counted(stretched, "key has a rotation", "keys have rotations")
            );
            self.add(&codes::ROTATION_NOT_UNIT, message);
        }
    }

    fn alpha(&mut self, document: &Document) {
        let cut = document.materials.iter().filter(|material| material.alpha_clip).count();
        if cut > 0 {
            let message = format!(
                "The demo does not look at AlphaClip: {} drawn without holes.",
                counted(cut, "material is", "materials are")
            );
            self.add(&codes::BOOK_ALPHA_CLIP, message);
        }
    }

    /// The demos mirror z, since their soldier is right-handed, and scale by [`DEMO_SCALE`].
    fn space(&mut self, document: &Document, handedness: Option<Handedness>) {
        if handedness == Some(Handedness::Left) {
            self.add(
                &codes::BOOK_HANDEDNESS,
                "The demo mirrors z, for right-handed models; this one is left-handed and is shown inside out."
                    .to_owned(),
            );
        }
        let heights = document.vertices.iter().map(|vertex| vertex.position[1]);
        let [least, most] = heights.fold([f32::INFINITY, f32::NEG_INFINITY], |[least, most], height| {
            [least.min(height), most.max(height)]
        });
        let height = (most - least) * DEMO_SCALE;
        let [small, large] = SEEN_HEIGHTS;
        if height.is_finite() && !(small..=large).contains(&height) {
            let message = format!(
                "The demo scales by {DEMO_SCALE}: the model is {} high in its file and {} there, beside a soldier of 3.6.",
                rounded(most - least),
                rounded(height)
            );
            self.add(&codes::BOOK_SIZE, message);
        }
    }

    /// The D3D12 book's loader throws the fourth number of a tangent away, and its shader takes cross(normal, tangent) in the world. The
    /// demo's mirror turns that round, so that it is right where the number is negative.
    fn tangent_signs(&mut self, document: &Document) {
        let is_flat = |map: &String| FLAT_MAPS.iter().any(|flat| map.eq_ignore_ascii_case(flat));
        let mut maps = document
            .materials
            .iter()
            .filter_map(|material| material.normal_map.as_ref());
        let mapped = maps.any(|map| !is_flat(map));
        let positive = document
            .vertices
            .iter()
            .filter(|vertex| vertex.tangent[3] > 0.0)
            .count();
        if mapped && positive > 0 {
            let message = format!(
                "The sign of tangents is not read: where it is 1, on {}, bumps of normal maps look like dents.",
                counted(positive, "vertex", "vertices")
            );
            self.add(&codes::BOOK_TANGENT_SIGN, message);
        }
    }

    fn maps(&mut self, book: Book, read: &Document, missing: Option<&[String]>) {
        if let Some((material, name)) = unreadable_map(book, read) {
            let message = match name.as_str() {
                "None" | "Null" => format!(
                    "Material {material} lacks a map, and the demo opens two of each: it looks for a file \"{name}\" and ends with an error."
                ),
                _ => format!("\"{name}\" is no picture that the demo reads: it ends with an error."),
            };
            self.add(&codes::BOOK_MAP_FORMAT, message);
        }
        if let Some(missing) = missing
            && let Some(first) = missing.first()
        {
            let message = format!(
                "{} missing, \"{first}\" among them: the demo ends with an error unless all lie beside the file.",
                counted(missing.len(), "map is", "maps are")
            );
            self.add(&codes::MAP_MISSING, message);
        }
    }
}

fn rounded(length: f32) -> String {
    let digits = (2 - length.abs().max(1e-6).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{length:.digits$}")
}
