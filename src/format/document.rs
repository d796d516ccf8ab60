//! What a `.m3d` file says, in the file's own words. No meaning is added here; [`import`](crate::import) translates.

use crate::diagnostic::{Entry, Places};

/// Which of the known spellings of the format a file uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// The DirectX 12 book: materials with `Fresnel0` and `Roughness`.
    #[default]
    D3d12,
    /// The DirectX 11 book: materials with `Ambient`, `Specular` and `Reflectivity`.
    D3d11,
    /// The Blender exporter of imm_engine: dashes, short labels, z up.
    Imm,
    /// The books' static models, `car.txt` and `skull.txt`: vertices with positions and normals alone, and triangles.
    Text,
}

impl Dialect {
    /// The short word that outputs use: `d3d12`, `d3d11`, `imm`, `txt`.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::D3d12 => "d3d12",
            Self::D3d11 => "d3d11",
            Self::Imm => "imm",
            Self::Text => "txt",
        }
    }
}

/// A parsed file. Lists keep the file's order; nothing is mended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// Spelling of the file.
    pub dialect: Dialect,
    /// `Materials` section.
    pub materials: Vec<Material>,
    /// `SubsetTable` section; subset i is drawn with material i.
    pub subsets: Vec<Subset>,
    /// `Vertices` section.
    pub vertices: Vec<Vertex>,
    /// `Triangles` section: three vertex indices a row.
    pub triangles: Vec<[u32; 3]>,
    /// `BoneOffsets` section: row vectors, row by row, translation in the last four (bind space -> bone space).
    pub bone_offsets: Vec<[f32; 16]>,
    /// `BoneHierarchy` section: −1 for a root. As long as `bone_offsets`.
    pub bone_parents: Vec<i32>,
    /// `AnimationClips` section.
    pub clips: Vec<AnimationClip>,
}

/// One entry of the `Materials` section.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// `Name` (D3D12); empty when the dialect has none.
    pub name: String,
    /// `Diffuse`.
    pub diffuse: [f32; 3],
    /// The part in which the two books differ.
    pub reflectance: Reflectance,
    /// `AlphaClip`.
    pub alpha_clip: bool,
    /// `MaterialTypeName` (D3D12) or `Effect` (D3D11).
    pub type_name: String,
    /// `DiffuseMap`; `None` when empty, `None` or `Null`.
    pub diffuse_map: Option<String>,
    /// `NormalMap`; likewise.
    pub normal_map: Option<String>,
}

/// How a material reflects, by dialect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance {
    /// DirectX 12 book.
    Fresnel {
        /// `Fresnel0`: reflectance at normal incidence.
        fresnel0: [f32; 3],
        /// `Roughness`, 0…1.
        roughness: f32,
    },
    /// DirectX 11 book and imm.
    Phong {
        /// `Ambient`.
        ambient: [f32; 3],
        /// `Specular`.
        specular: [f32; 3],
        /// `SpecPower`.
        spec_power: f32,
        /// `Reflectivity`.
        reflectivity: [f32; 3],
    },
}

/// One row of the `SubsetTable`. Only the face range is used by the books; the vertex range is often wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Subset {
    /// `SubsetID`.
    pub id: u32,
    /// `VertexStart`.
    pub vertex_start: u32,
    /// `VertexCount`.
    pub vertex_count: u32,
    /// `FaceStart`: first triangle.
    pub face_start: u32,
    /// `FaceCount`: number of triangles.
    pub face_count: u32,
}

/// One entry of the `Vertices` section. Without bones the weights and indices are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// `Position`.
    pub position: [f32; 3],
    /// `Tangent`; the fourth number is the bitangent's sign, 1 when the file has three.
    pub tangent: [f32; 4],
    /// `Normal`.
    pub normal: [f32; 3],
    /// `Tex-Coords`, origin top left.
    pub tex_coords: [f32; 2],
    /// `BlendWeights`.
    pub blend_weights: [f32; 4],
    /// `BlendIndices`: the file's bone numbers.
    pub blend_indices: [u32; 4],
}

/// One `AnimationClip`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnimationClip {
    /// The rest of the `AnimationClip` line; not always unique.
    pub name: String,
    /// One entry per bone, in the file's numbering.
    pub bones: Vec<BoneAnimation>,
}

/// The keys of one bone in one clip, in the file's order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoneAnimation {
    /// Keys; may be empty or unsorted.
    pub keyframes: Vec<Keyframe>,
}

/// One key: the bone relative to its parent (`toParent`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe {
    /// `Time` in seconds; infinite for what is no finite number.
    pub time_secs: f32,
    /// `Pos`.
    pub translation: [f32; 3],
    /// `Scale`.
    pub scale: [f32; 3],
    /// `Quat`: x, y, z, w.
    pub rotation: [f32; 4],
}

/// Where the rows of a [`Document`] stand in its file: line numbers from 1, parallel to the document's lists.
/// Empty lists for a document that was not read from a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LineMap {
    /// First line of each material.
    pub materials: Vec<u32>,
    /// Line of each subset.
    pub subsets: Vec<u32>,
    /// First line of each vertex.
    pub vertices: Vec<u32>,
    /// The vertices whose fields are not on lines that follow one another, in order, and the line of each field.
    pub vertices_apart: Vec<(u32, [u32; 6])>,
    /// All fields of a vertex are on its first line.
    pub vertices_on_one_line: bool,
    /// Line of each triangle.
    pub triangles: Vec<u32>,
    /// Line of each bone offset.
    pub bone_offsets: Vec<u32>,
    /// Line of each parent.
    pub bone_parents: Vec<u32>,
    /// Line of each clip and of each of its bones.
    pub clips: Vec<ClipLines>,
}

impl LineMap {
    /// Line of a field of each vertex.
    pub fn vertex_lines(&self, field: VertexField) -> Vec<u32> {
        if self.vertices_on_one_line {
            return self.vertices.clone();
        }
        let field = field as usize;
        let mut lines: Vec<u32> = self.vertices.iter().map(|line| line + field as u32).collect();
        for &(vertex, of_fields) in &self.vertices_apart {
            if let Some(line) = lines.get_mut(vertex as usize) {
                *line = of_fields[field];
            }
        }
        lines
    }

    fn vertex_line(&self, vertex: u32, field: VertexField) -> Option<u32> {
        if self.vertices_on_one_line {
            return self.vertices.get(vertex as usize).copied();
        }
        let apart = self.vertices_apart.binary_search_by_key(&vertex, |(apart, _)| *apart);
        match apart {
            Ok(place) => Some(self.vertices_apart[place].1[field as usize]),
            Err(_) => Some(self.vertices.get(vertex as usize)? + field as u32),
        }
    }

    /// The clip, track or key that begins last up to a line, and where.
    fn entry_of_clips(&self, line: u32) -> Option<(u32, Entry)> {
        let clip = self
            .clips
            .partition_point(|of_clip| of_clip.clip <= line)
            .checked_sub(1)?;
        let of_clip = &self.clips[clip];
        let clip = clip as u32;
        let Some(bone) = of_clip.bones.partition_point(|&start| start <= line).checked_sub(1) else {
            return Some((of_clip.clip, Entry::Clip(clip)));
        };
        let (start, bone) = (of_clip.bones[bone], bone as u32);
        let run = of_clip.key_runs.partition_point(|run| run.line <= line).checked_sub(1);
        let run = run.map(|run| &of_clip.key_runs[run]).filter(|run| run.bone == bone);
        Some(match run {
            Some(run) => {
                let key = run.key + (line - run.line);
                (line, Entry::Key { clip, bone, key })
            }
            None => (start, Entry::Track { clip, bone }),
        })
    }

    /// Line of a bone's keys in a clip; of the clip when the bone has none.
    pub fn track(&self, clip: u32, bone: u32) -> Option<u32> {
        let lines = self.clips.get(clip as usize)?;
        Some(lines.bones.get(bone as usize).copied().unwrap_or(lines.clip))
    }

    /// First line of each clip.
    pub fn clip_lines(&self) -> Vec<u32> {
        self.clips.iter().map(|lines| lines.clip).collect()
    }
}

impl Places for LineMap {
    fn line(&self, entry: Entry) -> Option<u32> {
        let at = |lines: &[u32], index: u32| lines.get(index as usize).copied();
        match entry {
            Entry::Header => None,
            Entry::Material(index) => at(&self.materials, index),
            Entry::Subset(index) => at(&self.subsets, index),
            Entry::Vertex(index) => at(&self.vertices, index),
            Entry::Tangent(index) => self.vertex_line(index, VertexField::Tangent),
            Entry::Triangle(index) => at(&self.triangles, index),
            Entry::Bone(index) => at(&self.bone_parents, index),
            Entry::Offset(index) => at(&self.bone_offsets, index),
            Entry::Clip(index) => Some(self.clips.get(index as usize)?.clip),
            Entry::Track { clip, bone } => self.track(clip, bone),
            Entry::Key { clip, bone, key } => self.clips.get(clip as usize)?.key(bone, key),
        }
    }

    fn entry_on(&self, line: u32) -> Option<Entry> {
        let last = |lines: &[u32], entry: fn(u32) -> Entry| {
            let index = lines.partition_point(|&start| start <= line).checked_sub(1)?;
            Some((lines[index], entry(index as u32)))
        };
        let lists = [
            last(&self.materials, Entry::Material),
            last(&self.subsets, Entry::Subset),
            last(&self.vertices, Entry::Vertex),
            last(&self.triangles, Entry::Triangle),
            last(&self.bone_offsets, Entry::Offset),
            last(&self.bone_parents, Entry::Bone),
            self.entry_of_clips(line),
        ];
        let nearest = lists.into_iter().flatten().max_by_key(|(start, _)| *start);
        nearest.map(|(_, entry)| entry)
    }
}

/// The lines of a vertex, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as in the file")]
pub enum VertexField {
    Position,
    Tangent,
    Normal,
    TexCoords,
    BlendWeights,
    BlendIndices,
}

/// Lines of one clip.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClipLines {
    /// Line of `AnimationClip`.
    pub clip: u32,
    /// Line of each `Bone… #Keyframes`.
    pub bones: Vec<u32>,
    /// The first key of each bone, and each key that is not on the line after the one before it.
    pub key_runs: Vec<KeyRun>,
}

/// Keys of one bone on lines that follow one another, up to the next run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeyRun {
    /// The bone's number.
    pub bone: u32,
    /// Number of the first key, from 0 for each bone.
    pub key: u32,
    /// Its line.
    pub line: u32,
}

impl ClipLines {
    /// Line of a key of a bone; of the bone itself when the key has none.
    pub fn key(&self, bone: u32, key: u32) -> Option<u32> {
        let behind = self.key_runs.partition_point(|run| (run.bone, run.key) <= (bone, key));
        let run = self.key_runs[..behind].last().filter(|run| run.bone == bone);
        run.map(|run| run.line + (key - run.key))
            .or_else(|| self.bones.get(bone as usize).copied())
    }
}
