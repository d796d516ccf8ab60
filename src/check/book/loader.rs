//! The books' `LoadM3d`, read by read: D3D11 of 2012 and D3D12 of 2015, chapter 23 "Character Animation". They differ in their materials.
//! Without bones the loader for static models is meant, which ends with the triangles.

use super::demo::Book;
use super::limits::Known;
use super::stream::{Stream, Trouble};
use crate::diagnostic::Entry;
use crate::format::quick;
use crate::format::{AnimationClip, BoneAnimation, Dialect, Document, Keyframe, Material, Reflectance, Subset, Vertex};
use crate::slices::{Slices, at_once};

/// What a loader made of a file.
#[derive(Clone, Debug)]
pub struct Reading {
    /// What was read before it went wrong. Names of maps are kept as they stand, `None` too. Of rows that are known the vertices and
    /// triangles are left out, and of each bone all keys but the first.
    pub document: Document,
    /// How many vertices were read whole.
    pub vertices: usize,
    /// How many triangles were read whole.
    pub triangles: usize,
    /// The counts of the header, as the loader believes them.
    pub counts: Counts,
    /// The read that failed: nothing after it was read.
    pub stop: Option<Trouble>,
    /// The first word that was taken for something else, without a failure.
    pub mistake: Option<Trouble>,
}

/// Counts of the header.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Of the materials, and of the subsets too.
    pub materials: u32,
    /// Of the vertices.
    pub vertices: u32,
    /// Of the triangles.
    pub triangles: u32,
    /// Of the bones.
    pub bones: u32,
    /// Of the clips.
    pub clips: u32,
}

const HEADER: [&str; 6] = [
    "Materials",
    "Subsets",
    "Vertices",
    "Triangles",
    "Bones",
    "AnimationClips",
];
const SUBSET: [&str; 5] = ["SubsetID", "VertexStart", "VertexCount", "FaceStart", "FaceCount"];
const VERTEX: [&str; 6] = [
    "Position",
    "Tangent",
    "Normal",
    "Tex-Coords",
    "BlendWeights",
    "BlendIndices",
];
const MATERIAL: [&str; 13] = [
    "Name",
    "Ambient",
    "Diffuse",
    "Specular",
    "SpecPower",
    "Reflectivity",
    "Fresnel0",
    "Roughness",
    "AlphaClip",
    "MaterialTypeName",
    "Effect",
    "DiffuseMap",
    "NormalMap",
];
const KEY: [&str; 4] = ["Time", "Pos", "Scale", "Quat"];

/// Reads a file as a book's loader does. Makes room only for what is there. Rows of which is known that it reads them as they are meant are
/// passed over.
pub fn read(book: Book, bytes: &[u8], known: &Known<'_>) -> Reading {
    at_once(read_in(book, bytes, known, &Slices::ENDLESS))
}

/// [`read`] in slices.
pub(super) async fn read_in(book: Book, bytes: &[u8], known: &Known<'_>, slices: &Slices) -> Reading {
    let mut loader = Loader {
        stream: Stream::new(bytes),
        slices,
        document: Document {
            dialect: match book {
                Book::D3d11 => Dialect::D3d11,
                Book::D3d12 => Dialect::D3d12,
            },
            ..Document::default()
        },
        passed: [0; 2],
    };
    let counts = loader.header();
    loader.materials(counts.materials).await;
    loader.subsets(counts.materials).await;
    loader.vertices(counts.vertices, counts.bones, known).await;
    loader.triangles(counts.triangles, counts.vertices, known).await;
    if counts.bones > 0 {
        loader.offsets(counts.bones).await;
        loader.hierarchy(counts.bones).await;
        loader.clips(counts.clips, counts.bones, known).await;
    }
    let Loader {
        stream,
        document,
        passed: [vertices, triangles],
        ..
    } = loader;
    let (stop, mistake) = stream.into_troubles();
    Reading {
        vertices: vertices + document.vertices.len(),
        triangles: triangles + document.triangles.len(),
        document,
        counts,
        stop,
        mistake,
    }
}

struct Loader<'a> {
    stream: Stream<'a>,
    slices: &'a Slices,
    document: Document,
    /// Vertices and triangles that were passed over.
    passed: [usize; 2],
}

impl Loader<'_> {
    fn header(&mut self) -> Counts {
        let stream = &mut self.stream;
        stream.ruler("the header");
        let mut count = |label, what| {
            stream.label(label, &HEADER);
            stream.uint(what)
        };
        Counts {
            materials: count("Materials", "the number of materials"),
            vertices: count("Vertices", "the number of vertices"),
            triangles: count("Triangles", "the number of triangles"),
            bones: count("Bones", "the number of bones"),
            clips: count("AnimationClips", "the number of clips"),
        }
    }

    /// Reads entries until one fails, and keeps those that were read whole.
    async fn entries<T>(
        &mut self,
        count: u32,
        entry: impl Fn(u32) -> Entry,
        read: impl Fn(&mut Stream<'_>, Dialect) -> T,
        list: impl Fn(&mut Document) -> &mut Vec<T>,
    ) {
        for index in 0..count {
            self.slices.pause_before(index as usize).await;
            self.stream.entry = entry(index);
            let value = read(&mut self.stream, self.document.dialect);
            if self.stream.has_failed() {
                return;
            }
            list(&mut self.document).push(value);
        }
    }

    async fn materials(&mut self, count: u32) {
        self.stream.ruler("the materials");
        self.entries(count, Entry::Material, read_material, |document| {
            &mut document.materials
        })
        .await;
    }

    async fn subsets(&mut self, count: u32) {
        self.stream.ruler("the subsets");
        self.entries(
            count,
            Entry::Subset,
            |stream, _| read_subset(stream),
            |document| &mut document.subsets,
        )
        .await;
    }

    async fn vertices(&mut self, count: u32, bones: u32, known: &Known<'_>) {
        self.stream.ruler("the vertices");
        if let Some((document, quick)) = known.rows()
            && document.vertices.len() == count as usize
            && document.bone_parents.len() == bones as usize
            && let (Some(last), Some(rows)) = (count.checked_sub(1), &quick.vertices)
            && self.stream.pass_over(rows, Entry::Vertex(last))
        {
            self.passed[0] = document.vertices.len();
            return;
        }
        let read = |stream: &mut Stream<'_>, _| {
            let quick = stream.quick(|cursor| quick::vertex::<false>(cursor, bones));
            quick.map_or_else(|| read_vertex(stream, bones > 0), |(vertex, _)| vertex)
        };
        self.entries(count, Entry::Vertex, read, |document| &mut document.vertices)
            .await;
    }

    async fn triangles(&mut self, count: u32, vertices: u32, known: &Known<'_>) {
        self.stream.ruler("the triangles");
        // Of a `USHORT`, and of vertices that are there, as nearly all are.
        let end = vertices.min(1 << 16);
        if let Some((document, quick)) = known.rows()
            && document.triangles.len() == count as usize
            && document.vertices.len() <= end as usize
            && let (Some(last), Some(rows)) = (count.checked_sub(1), &quick.triangles)
            && self.stream.pass_over(rows, Entry::Triangle(last))
        {
            self.passed[1] = document.triangles.len();
            return;
        }
        let read = |stream: &mut Stream<'_>, _| {
            let quick = stream.quick(|cursor| quick::triangle(cursor, end));
            quick.map_or_else(
                || [(); 3].map(|()| u32::from(stream.ushort("a vertex index"))),
                |(triangle, _)| triangle,
            )
        };
        self.entries(count, Entry::Triangle, read, |document| &mut document.triangles)
            .await;
    }

    async fn offsets(&mut self, count: u32) {
        self.stream.ruler("the bone offsets");
        let read = |stream: &mut Stream<'_>, _| {
            stream.label("BoneOffset", &[]);
            stream.quick(quick::offset).unwrap_or_else(|| stream.floats("a number"))
        };
        self.entries(count, Entry::Offset, read, |document| &mut document.bone_offsets)
            .await;
    }

    async fn hierarchy(&mut self, count: u32) {
        self.stream.ruler("the bone hierarchy");
        let read = |stream: &mut Stream<'_>, _| {
            stream.label("ParentIndexOfBone", &[]);
            stream.int("the number")
        };
        self.entries(count, Entry::Bone, read, |document| &mut document.bone_parents)
            .await;
    }

    async fn clips(&mut self, count: u32, bones: u32, known: &Known<'_>) {
        self.stream.ruler("the clips");
        for clip in 0..count {
            let stream = &mut self.stream;
            stream.entry = Entry::Clip(clip);
            stream.label("AnimationClip", &[]);
            let Some(name) = stream.name("the name") else { return };
            // A clip whose name was read is there, with as many of its bones as were read.
            self.document.clips.push(AnimationClip {
                name,
                bones: Vec::new(),
            });
            stream.skip();
            for bone in 0..bones {
                self.slices.pause().await;
                stream.entry = Entry::Track { clip, bone };
                stream.label("Bone", &[]);
                stream.skip();
                let keys = stream.uint("the number of keys");
                stream.skip();
                if stream.has_failed() {
                    return;
                }
                let (mut keyframes, mut passed) = (Vec::new(), 0);
                let track = known
                    .track(clip, bone)
                    .filter(|(track, _)| track.len() == keys as usize);
                if let Some((track, rows)) = track
                    && let Some(key) = keys.checked_sub(1)
                    && stream.pass_over(rows, Entry::Key { clip, bone, key })
                {
                    keyframes.push(track[0]);
                    passed = keys;
                }
                for key in passed..keys {
                    self.slices.pause_before(key as usize).await;
                    stream.entry = Entry::Key { clip, bone, key };
                    let quick = stream.quick(quick::keyframe::<false>);
                    let keyframe = quick.map_or_else(|| read_key(stream), |(keyframe, _)| keyframe);
                    if stream.has_failed() {
                        return;
                    }
                    keyframes.push(keyframe);
                }
                if let Some(clip) = self.document.clips.last_mut() {
                    clip.bones.push(BoneAnimation { keyframes });
                }
                stream.skip();
            }
            stream.skip();
        }
    }
}

fn read_material(stream: &mut Stream<'_>, dialect: Dialect) -> Material {
    let mut color = |label| {
        stream.label(label, &MATERIAL);
        stream.floats(label)
    };
    let (name, diffuse, reflectance);
    if dialect == Dialect::D3d11 {
        let ambient = color("Ambient");
        (name, diffuse) = (String::new(), color("Diffuse"));
        let specular = color("Specular");
        stream.label("SpecPower", &MATERIAL);
        let spec_power = stream.float("SpecPower");
        stream.label("Reflectivity", &MATERIAL);
        reflectance = Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity: stream.floats("Reflectivity"),
        };
    } else {
        stream.label("Name", &MATERIAL);
        name = stream.name("the name").unwrap_or_default();
        stream.label("Diffuse", &MATERIAL);
        diffuse = stream.floats("Diffuse");
        stream.label("Fresnel0", &MATERIAL);
        let fresnel0 = stream.floats("Fresnel0");
        stream.label("Roughness", &MATERIAL);
        reflectance = Reflectance::Fresnel {
            fresnel0,
            roughness: stream.float("Roughness"),
        };
    }
    stream.label("AlphaClip", &MATERIAL);
    let alpha_clip = stream.boolean("AlphaClip");
    let mut word = |label, what| {
        stream.label(label, &MATERIAL);
        stream.name(what)
    };
    let type_label = if dialect == Dialect::D3d11 {
        "Effect"
    } else {
        "MaterialTypeName"
    };
    Material {
        name,
        diffuse,
        reflectance,
        alpha_clip,
        type_name: word(type_label, "the type").unwrap_or_default(),
        diffuse_map: word("DiffuseMap", "the diffuse map"),
        normal_map: word("NormalMap", "the normal map"),
    }
}

fn read_subset(stream: &mut Stream<'_>) -> Subset {
    let [id, vertex_start, vertex_count, face_start, face_count] = SUBSET.map(|label| {
        stream.label(label, &SUBSET);
        stream.uint(label)
    });
    Subset {
        id,
        vertex_start,
        vertex_count,
        face_start,
        face_count,
    }
}

fn read_vertex(stream: &mut Stream<'_>, skinned: bool) -> Vertex {
    let [position, tangent, normal, tex_coords, weights, indices] = VERTEX;
    stream.label(position, &VERTEX);
    let mut vertex = Vertex {
        position: stream.floats(position),
        ..Vertex::default()
    };
    stream.label(tangent, &VERTEX);
    vertex.tangent = stream.floats(tangent);
    stream.label(normal, &VERTEX);
    vertex.normal = stream.floats(normal);
    stream.label(tex_coords, &VERTEX);
    vertex.tex_coords = stream.floats(tex_coords);
    if skinned {
        stream.label(weights, &VERTEX);
        vertex.blend_weights = stream.floats(weights);
        stream.label(indices, &VERTEX);
        // They are read as `int`, and kept as bytes.
        vertex.blend_indices = [(); 4].map(|()| stream.int(indices).cast_unsigned());
    }
    vertex
}

fn read_key(stream: &mut Stream<'_>) -> Keyframe {
    let [time, pos, scale, quat] = KEY;
    stream.label(time, &KEY);
    let time_secs = stream.float(time);
    stream.label(pos, &KEY);
    let translation = stream.floats(pos);
    stream.label(scale, &KEY);
    let scale_factors = stream.floats(scale);
    stream.label(quat, &KEY);
    Keyframe {
        time_secs,
        translation,
        scale: scale_factors,
        rotation: stream.floats(quat),
    }
}
