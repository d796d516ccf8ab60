//! What programs are told of a model and of findings, as plain data for serde. The command line writes the keys as they are here, the page
//! in camelCase.

use serde::Serialize;

use crate::check::book::{self, Book};
use crate::diagnostic::{Diagnostic, Position, Subject};
use crate::scene::Aabb;
use crate::session::OpenModel;

/// What a model is and has.
#[derive(Debug, Serialize)]
pub struct Model<'a> {
    /// `d3d12`, `d3d11`, `imm`, `glb` or `gltf`.
    pub dialect: &'static str,
    /// `left` or `right`, found from the triangles.
    pub handedness: &'static str,
    /// `y` or `z`, as the dialect suggests.
    pub up_axis: &'static str,
    /// How much of each there is.
    pub counts: Counts,
    /// The bones, in the order of the file.
    pub bones: Vec<Bone<'a>>,
    /// Names of the materials, in the order of the file.
    pub materials: Vec<&'a str>,
    /// The clips, in the order of the file.
    pub clips: Vec<Clip<'a>>,
    /// Box of all vertices in the file's space; `None` without vertices.
    pub bind_bounds: Option<Bounds>,
}

/// How much of each a model has.
#[derive(Debug, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Counts {
    pub materials: usize,
    pub vertices: usize,
    pub triangles: usize,
    pub bones: usize,
    pub clips: usize,
}

/// A bone.
#[derive(Debug, Serialize)]
pub struct Bone<'a> {
    /// Its name, where the file has one.
    pub name: Option<&'a str>,
    /// Its parent's number in the file.
    pub parent: Option<u32>,
}

/// A clip.
#[derive(Debug, Serialize)]
pub struct Clip<'a> {
    /// Its name, unique in the model.
    pub name: &'a str,
    /// Least time of its keys.
    pub start_secs: f32,
    /// Greatest time of its keys.
    pub end_secs: f32,
    /// Keys a second of the densest track: the unit of a frame.
    pub keys_per_sec: f32,
    /// Number of keys in the file.
    pub keys: usize,
}

/// Corners of a box.
#[derive(Clone, Copy, Debug, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Bounds {
    pub min: [f32; 3],
    pub max: [f32; 3],
}

/// A finding. What cannot be said is `None`.
#[derive(Debug, Serialize)]
pub struct Finding<'a> {
    /// `note`, `warning` or `error`.
    pub severity: &'static str,
    /// Stable name of the kind of finding.
    pub code: &'static str,
    /// One sentence.
    pub message: &'a str,
    /// What belonged in its place, in a few words.
    pub expected: Option<&'a str>,
    /// What stood there, in a few words.
    pub found: Option<&'a str>,
    /// Line, from 1; `None` when it is about the whole file.
    pub line: Option<u32>,
    /// Column in bytes, from 1; `None` when it is about the whole file.
    pub column: Option<u32>,
    /// What of a glTF file's JSON it is about; `None` for other formats, and when it is about the whole file.
    pub json_pointer: Option<&'a str>,
    /// Where it is in a binary file, in bytes from its start.
    pub byte_offset: Option<u64>,
    /// The part of the model that it is about, the first one of several.
    pub subject: Option<Part>,
    /// When it is in the clip that it is about, in seconds of the clip's own time.
    pub time_secs: Option<f32>,
    /// The bone of that clip, by its number in the file.
    pub bone: Option<u32>,
    /// How many alike things it tells of, 1 or more.
    pub count: u32,
    /// Where the first of them stand, at most [`Diagnostic::MOST_PLACES`]; empty when it is about the whole file.
    pub places: Vec<Place>,
}

/// A part of a model.
#[derive(Debug, Serialize)]
pub struct Part {
    /// `material`, `subset`, `vertex`, `triangle`, `bone` or `clip`.
    pub kind: &'static str,
    /// Its number in the file, from 0.
    pub index: u32,
}

/// A place in a file, both numbers from 1, the column in bytes.
#[derive(Debug, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Place {
    pub line: u32,
    pub column: u32,
}

/// What the books' programs make of a file, each if it was asked for.
#[derive(Debug, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Books<'a> {
    pub d3d11: Option<Verdict<'a>>,
    pub d3d12: Option<Verdict<'a>>,
    pub converted: Option<Converted<'a>>,
}

/// Whether a file of another format fits the books' demos once it is converted for them.
#[derive(Debug, Serialize)]
pub struct Converted<'a> {
    /// Whether it does.
    pub fits: bool,
    /// What it exceeds.
    pub limits: Vec<Limit<'a>>,
}

/// What a book's program makes of a file.
#[derive(Debug, Serialize)]
pub struct Verdict<'a> {
    /// Whether its loader reads the file as it is meant.
    pub reads: bool,
    /// Line, from 1, where it goes wrong.
    pub line: Option<u32>,
    /// Column in bytes, from 1, where it goes wrong.
    pub column: Option<u32>,
    /// What happens there, one sentence.
    pub why: Option<&'a str>,
    /// What one then sees.
    pub shows: &'a str,
    /// Whether its demo ends before it shows anything.
    pub ends: bool,
    /// What the demo cannot show as it is meant.
    pub limits: Vec<Limit<'a>>,
}

/// Something that a book's demo cannot show as it is meant.
#[derive(Debug, Serialize)]
pub struct Limit<'a> {
    /// Stable name of the kind of finding.
    pub code: &'static str,
    /// One sentence.
    pub message: &'a str,
}

impl<'a> Books<'a> {
    /// Those of some verdicts, or of what a file of another format exceeds once it is converted.
    pub fn of(verdicts: &'a [book::Verdict], converted: Option<&'a [book::Limit]>) -> Self {
        let of = |book| verdicts.iter().find(|verdict| verdict.book == book).map(Verdict::from);
        Self {
            d3d11: of(Book::D3d11),
            d3d12: of(Book::D3d12),
            converted: converted.map(|limits| Converted {
                fits: limits.is_empty(),
                limits: limits.iter().map(Limit::from).collect(),
            }),
        }
    }
}

impl<'a> From<&'a book::Limit> for Limit<'a> {
    fn from(limit: &'a book::Limit) -> Self {
        Self {
            code: limit.code,
            message: &limit.message,
        }
    }
}

impl<'a> From<&'a book::Verdict> for Verdict<'a> {
    fn from(verdict: &'a book::Verdict) -> Self {
        Self {
            reads: verdict.reads(),
            line: verdict.position().map(|at| at.line),
            column: verdict.position().map(|at| at.column),
            why: verdict.trouble.as_ref().map(|trouble| trouble.why.as_str()),
            shows: &verdict.shows,
            ends: verdict.ends,
            limits: verdict.limits.iter().map(Limit::from).collect(),
        }
    }
}

impl<'a> From<&'a OpenModel> for Model<'a> {
    fn from(open: &'a OpenModel) -> Self {
        let model = &open.model;
        let skeleton = &model.skeleton;
        let bones = skeleton.joint_of_bone().iter().map(|&joint| Bone {
            name: skeleton.name(joint),
            parent: skeleton.parents()[joint.index()].map(|parent| skeleton.file_bones()[parent.index()]),
        });
        let clips = model.clips.iter().map(|clip| Clip {
            name: &clip.name,
            start_secs: clip.start_secs,
            end_secs: clip.end_secs,
            keys_per_sec: clip.keys_per_sec,
            keys: clip.key_count,
        });
        Self {
            dialect: open.format.as_str(),
            handedness: model.handedness.name(),
            up_axis: model.up_axis.name(),
            counts: Counts {
                materials: model.materials.len(),
                vertices: model.mesh.vertex_count(),
                triangles: model.mesh.triangle_count(),
                bones: model.skeleton.joint_count(),
                clips: model.clips.len(),
            },
            bones: bones.collect(),
            materials: model.materials.iter().map(|material| material.name.as_str()).collect(),
            clips: clips.collect(),
            bind_bounds: Bounds::of(&open.bind_bounds),
        }
    }
}

impl Bounds {
    /// `None` for a box without points.
    pub fn of(bounds: &Aabb) -> Option<Self> {
        (!bounds.is_empty()).then(|| Self {
            min: bounds.min.to_array(),
            max: bounds.max.to_array(),
        })
    }
}

impl<'a> From<&'a Diagnostic> for Finding<'a> {
    fn from(diagnostic: &'a Diagnostic) -> Self {
        let place = |&Position { line, column }: &Position| Place { line, column };
        Self {
            severity: diagnostic.severity.as_str(),
            code: diagnostic.code,
            message: &diagnostic.message,
            expected: diagnostic.expected.as_deref(),
            found: diagnostic.found.as_deref(),
            line: diagnostic.position.map(|position| position.line),
            column: diagnostic.position.map(|position| position.column),
            json_pointer: diagnostic.pointer.as_deref(),
            byte_offset: diagnostic.byte_offset,
            subject: diagnostic.subject.map(Part::from),
            time_secs: diagnostic.moment().time_secs,
            bone: diagnostic.moment().bone,
            count: diagnostic.count,
            places: diagnostic.few_places().iter().map(place).collect(),
        }
    }
}

impl From<Subject> for Part {
    fn from(subject: Subject) -> Self {
        let (kind, index) = subject.kind_and_index();
        Self { kind, index }
    }
}
