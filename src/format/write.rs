//! Writes a document as a file, so that [`parse`](super::parse) gives the same document again.

use std::fmt::{self, Write as _};

use super::document::{AnimationClip, Dialect, Document, Keyframe, Material, Reflectance, Vertex};
use super::label::Section;
use crate::slices::{Slices, at_once};

/// Writes `document` in its dialect, laid out as the dialect's own exporter does.
///
/// Numbers are as short as they can be and still read back exactly. What the format cannot say is not kept: numbers that are not
/// finite, names with line ends or blanks around them, a map called `None`, a clip name that ends in a brace, and the
/// dialect where the first material contradicts it. Counts are those of the lists; weights and indices are written only when
/// there are bones.
pub fn write(document: &Document) -> String {
    at_once(write_in(document, &Slices::ENDLESS))
}

/// The same, in slices.
pub async fn write_in(document: &Document, slices: &Slices) -> String {
    let mut text = String::new();
    if document.dialect == Dialect::Text {
        // Writing to a String does not fail.
        let written = text_model(&mut text, document, slices).await;
        debug_assert!(written.is_ok());
        return text;
    }
    let mut writer = Writer {
        text: &mut text,
        imm: document.dialect == Dialect::Imm,
    };
    // Writing to a String does not fail.
    let written = writer.document(document, slices).await;
    debug_assert!(written.is_ok());
    text
}

/// As `car.txt` is laid out.
async fn text_model(text: &mut String, document: &Document, slices: &Slices) -> fmt::Result {
    writeln!(text, "VertexCount: {}", document.vertices.len())?;
    writeln!(text, "TriangleCount: {}", document.triangles.len())?;
    writeln!(text, "VertexList (pos, normal)\n{{")?;
    for (index, vertex) in document.vertices.iter().enumerate() {
        slices.pause_before(index).await;
        let [[x, y, z], [nx, ny, nz]] = [vertex.position, vertex.normal];
        writeln!(text, "\t{}", Numbers(&[x, y, z, nx, ny, nz]).to_string().trim_start())?;
    }
    writeln!(text, "}}\nTriangleList\n{{")?;
    for (index, [a, b, c]) in document.triangles.iter().enumerate() {
        slices.pause_before(index).await;
        writeln!(text, "\t{a} {b} {c}")?;
    }
    writeln!(text, "}}")
}

struct Writer<'a> {
    text: &'a mut String,
    imm: bool,
}

impl Writer<'_> {
    async fn document(&mut self, document: &Document, slices: &Slices) -> fmt::Result {
        let bones = document.bone_offsets.len();
        let sign = if self.imm { "" } else { "#" };
        self.ruler(Section::Header)?;
        writeln!(self.text, "{sign}Materials {}", document.materials.len())?;
        if document.subsets.len() != document.materials.len() {
            writeln!(self.text, "{sign}Subsets {}", document.subsets.len())?;
        }
        writeln!(self.text, "{sign}Vertices {}", document.vertices.len())?;
        writeln!(self.text, "{sign}Triangles {}", document.triangles.len())?;
        writeln!(self.text, "{sign}Bones {bones}")?;
        writeln!(self.text, "{sign}AnimationClips {}", document.clips.len())?;

        self.section(Section::Materials)?;
        for (index, material) in document.materials.iter().enumerate() {
            if index > 0 {
                writeln!(self.text)?;
            }
            self.material(material)?;
        }
        self.section(Section::SubsetTable)?;
        for subset in &document.subsets {
            let [id, start, count] = [subset.id, subset.vertex_start, subset.vertex_count];
            write!(self.text, "SubsetID: {id} VertexStart: {start} VertexCount: {count} ")?;
            writeln!(
                self.text,
                "FaceStart: {} FaceCount: {}",
                subset.face_start, subset.face_count
            )?;
        }
        self.section(Section::Vertices)?;
        for (index, vertex) in document.vertices.iter().enumerate() {
            if index > 0 {
                writeln!(self.text)?;
            }
            slices.pause_before(index).await;
            self.vertex(vertex, bones > 0)?;
        }
        self.section(Section::Triangles)?;
        for (index, [a, b, c]) in document.triangles.iter().enumerate() {
            slices.pause_before(index).await;
            writeln!(self.text, "{a} {b} {c}")?;
        }
        if bones > 0 || !document.clips.is_empty() {
            self.skeleton(document)?;
            self.section(Section::AnimationClips)?;
            for clip in &document.clips {
                self.clip(clip, slices).await?;
            }
        }
        Ok(())
    }

    fn skeleton(&mut self, document: &Document) -> fmt::Result {
        let (offset, parent) = if self.imm {
            ("B", "P")
        } else {
            ("BoneOffset", "ParentIndexOfBone")
        };
        let colon = if self.imm { ":" } else { "" };
        self.section(Section::BoneOffsets)?;
        for (bone, numbers) in document.bone_offsets.iter().enumerate() {
            writeln!(self.text, "{offset}{bone}{colon}{}", Numbers(numbers))?;
        }
        self.section(Section::BoneHierarchy)?;
        for (bone, index) in document.bone_parents.iter().enumerate() {
            writeln!(self.text, "{parent}{bone}: {index}")?;
        }
        Ok(())
    }

    fn section(&mut self, section: Section) -> fmt::Result {
        writeln!(self.text)?;
        self.ruler(section)
    }

    fn ruler(&mut self, section: Section) -> fmt::Result {
        if self.imm {
            let name = match section {
                Section::Header => "M3D_File_Header",
                Section::SubsetTable => "Subset_Table",
                Section::BoneOffsets => "Bone_Offsets",
                Section::BoneHierarchy => "Bone_Hierarchy",
                Section::AnimationClips => "Animation_Clips",
                _ => section.name(),
            };
            writeln!(self.text, "{name:->43}-")
        } else {
            writeln!(self.text, "***************{:*<30}", section.name())
        }
    }

    fn material(&mut self, material: &Material) -> fmt::Result {
        let alpha_clip = u32::from(material.alpha_clip);
        let type_label = match material.reflectance {
            Reflectance::Fresnel { .. } => "MaterialTypeName",
            Reflectance::Phong { .. } => "Effect",
        };
        match material.reflectance {
            Reflectance::Fresnel { fresnel0, roughness } => {
                writeln!(self.text, "Name: {}", line(&material.name))?;
                writeln!(self.text, "Diffuse:{}", Numbers(&material.diffuse))?;
                writeln!(self.text, "Fresnel0:{}", Numbers(&fresnel0))?;
                writeln!(self.text, "Roughness:{}", Numbers(&[roughness]))?;
            }
            Reflectance::Phong {
                ambient,
                specular,
                spec_power,
                reflectivity,
            } => {
                if !material.name.is_empty() {
                    writeln!(self.text, "Name: {}", line(&material.name))?;
                }
                writeln!(self.text, "Ambient:{}", Numbers(&ambient))?;
                writeln!(self.text, "Diffuse:{}", Numbers(&material.diffuse))?;
                writeln!(self.text, "Specular:{}", Numbers(&specular))?;
                writeln!(self.text, "SpecPower:{}", Numbers(&[spec_power]))?;
                writeln!(self.text, "Reflectivity:{}", Numbers(&reflectivity))?;
            }
        }
        writeln!(self.text, "AlphaClip: {alpha_clip}")?;
        writeln!(self.text, "{type_label}: {}", line(&material.type_name))?;
        for (label, map) in [
            ("DiffuseMap", &material.diffuse_map),
            ("NormalMap", &material.normal_map),
        ] {
            writeln!(
                self.text,
                "{label}: {}",
                map.as_deref().map_or_else(|| "None".into(), line)
            )?;
        }
        Ok(())
    }

    fn vertex(&mut self, vertex: &Vertex, skinned: bool) -> fmt::Result {
        let labels = if self.imm {
            ["P", "T", "N", "T", "W", "I"]
        } else {
            [
                "Position",
                "Tangent",
                "Normal",
                "Tex-Coords",
                "BlendWeights",
                "BlendIndices",
            ]
        };
        let [position, tangent, normal, tex_coords, weights, indices] = labels;
        writeln!(self.text, "{position}:{}", Numbers(&vertex.position))?;
        writeln!(self.text, "{tangent}:{}", Numbers(&vertex.tangent))?;
        writeln!(self.text, "{normal}:{}", Numbers(&vertex.normal))?;
        writeln!(self.text, "{tex_coords}:{}", Numbers(&vertex.tex_coords))?;
        if skinned {
            let [a, b, c, d] = vertex.blend_indices;
            writeln!(self.text, "{weights}:{}", Numbers(&vertex.blend_weights))?;
            writeln!(self.text, "{indices}: {a} {b} {c} {d}")?;
        }
        Ok(())
    }

    async fn clip(&mut self, clip: &AnimationClip, slices: &Slices) -> fmt::Result {
        let (bone_label, count_label) = if self.imm { ("B", "#K") } else { ("Bone", "#Keyframes") };
        writeln!(self.text, "AnimationClip {}\n{{", line(&clip.name))?;
        for (bone, animation) in clip.bones.iter().enumerate() {
            writeln!(
                self.text,
                "\t{bone_label}{bone} {count_label}: {}\n\t{{",
                animation.keyframes.len()
            )?;
            for (index, keyframe) in animation.keyframes.iter().enumerate() {
                slices.pause_before(index).await;
                self.keyframe(keyframe)?;
            }
            writeln!(self.text, "\t}}\n")?;
        }
        writeln!(self.text, "}}")
    }

    fn keyframe(&mut self, keyframe: &Keyframe) -> fmt::Result {
        let labels = if self.imm {
            ["T", "P", "S", "Q"]
        } else {
            ["Time", "Pos", "Scale", "Quat"]
        };
        let [time, translation, scale, rotation] = labels;
        write!(self.text, "\t\t{time}:{}", Numbers(&[keyframe.time_secs]))?;
        write!(self.text, " {translation}:{}", Numbers(&keyframe.translation))?;
        write!(self.text, " {scale}:{}", Numbers(&keyframe.scale))?;
        writeln!(self.text, " {rotation}:{}", Numbers(&keyframe.rotation))
    }
}

/// Numbers, each with a blank before it.
struct Numbers<'a>(&'a [f32]);

impl fmt::Display for Numbers<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for number in self.0 {
            // Both forms are the shortest that reads back exactly; the exponent keeps the very small and large ones short.
            if *number != 0.0 && !(1e-4..1e9).contains(&number.abs()) {
                write!(f, " {number:E}")?;
            } else {
                write!(f, " {number}")?;
            }
        }
        Ok(())
    }
}

/// A name as the rest of a line can hold it.
fn line(name: &str) -> String {
    name.replace(['\n', '\r'], " ").trim_ascii().to_owned()
}
