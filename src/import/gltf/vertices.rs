//! The attributes of the vertices of a primitive, as the file has them; its morph targets are added at the weights that they have outside of clips.

use glam::Vec3;

use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::gltf::{Fault, Primitive, Reader, Wanted};
use crate::import::scene::Vertices;

/// The vertices of a primitive, which is at `pointer`, without its morph targets. Second texture coordinates are left out where no map
/// takes them.
///
/// # Errors
/// When an attribute names what is not there, or numbers of the wrong kind.
pub(super) fn read(
    reader: &Reader<'_>,
    part: &Primitive,
    takes_second_tex_coords: bool,
    pointer: &str,
    diagnostics: &mut Diagnostics,
) -> Result<Vertices, Fault> {
    let attributes = Attributes { reader, part, pointer };
    let positions: Vec<[f32; 3]> = attributes.read("POSITION")?;
    let count = positions.len();
    let vertices = Vertices {
        positions,
        normals: fitting(attributes.read("NORMAL")?, count),
        tangents: fitting(attributes.read("TANGENT")?, count),
        tex_coords: fitting(attributes.read("TEXCOORD_0")?, count),
        second_tex_coords: if takes_second_tex_coords {
            fitting(attributes.read("TEXCOORD_1")?, count)
        } else {
            Vec::new()
        },
        colors: fitting(attributes.colors()?, count),
    };
    if vertices.normals.is_empty() {
        let message = "The primitive has no normals; smooth ones were computed from its triangles.";
        diagnostics.add(&codes::GLTF_NORMALS_ABSENT, Place::pointer(pointer), message.to_owned());
    }
    Ok(vertices)
}

/// The same with the morph targets of the primitive at these weights.
///
/// # Errors
/// As [`read`].
pub(super) fn morphed(
    plain: &Vertices,
    reader: &Reader<'_>,
    part: &Primitive,
    weights: &[f32],
    pointer: &str,
) -> Result<Vertices, Fault> {
    let mut vertices = plain.clone();
    for (target, &weight) in weights.iter().take(part.targets.len()).enumerate() {
        if weight != 0.0 && weight.is_finite() {
            morph(&mut vertices, &Attributes { reader, part, pointer }, target, weight)?;
        }
    }
    Ok(vertices)
}

fn morph(vertices: &mut Vertices, attributes: &Attributes<'_>, target: usize, weight: f32) -> Result<(), Fault> {
    let steps = |key: &str| -> Result<Vec<Vec3>, Fault> {
        let Some(&accessor) = attributes.part.targets[target].get(key) else {
            return Ok(Vec::new());
        };
        let pointer = format!("{}/targets/{target}/{key}", attributes.pointer);
        let wanted = Wanted::of_attribute(key).unwrap_or(Wanted::Floats);
        let steps: Vec<[f32; 3]> = attributes.reader.floats(accessor, wanted, &pointer)?;
        Ok(steps.into_iter().map(|step| Vec3::from_array(step) * weight).collect())
    };
    for (position, step) in vertices.positions.iter_mut().zip(steps("POSITION")?) {
        *position = (Vec3::from_array(*position) + step).to_array();
    }
    for (normal, step) in vertices.normals.iter_mut().zip(steps("NORMAL")?) {
        *normal = (Vec3::from_array(*normal) + step).to_array();
    }
    for ([x, y, z, _], step) in vertices.tangents.iter_mut().zip(steps("TANGENT")?) {
        [*x, *y, *z] = (Vec3::new(*x, *y, *z) + step).to_array();
    }
    Ok(())
}

/// An element for each of `count` vertices: more are left out, fewer are none.
fn fitting<T>(mut elements: Vec<T>, count: usize) -> Vec<T> {
    elements.truncate(if elements.len() < count { 0 } else { count });
    elements
}

/// The attributes of a primitive.
struct Attributes<'a> {
    reader: &'a Reader<'a>,
    part: &'a Primitive,
    pointer: &'a str,
}

impl Attributes<'_> {
    /// All elements of an attribute; empty where there is none.
    fn read<const N: usize>(&self, key: &str) -> Result<Vec<[f32; N]>, Fault> {
        let Some(&accessor) = self.part.attributes.get(key) else {
            return Ok(Vec::new());
        };
        let wanted = Wanted::of_attribute(key).unwrap_or(Wanted::Floats);
        self.reader.floats(accessor, wanted, &self.pointer_to(key))
    }

    /// The colours, opaque where they have no alpha.
    fn colors(&self) -> Result<Vec<[f32; 4]>, Fault> {
        let Some(&accessor) = self.part.attributes.get("COLOR_0") else {
            return Ok(Vec::new());
        };
        if self.reader.width(accessor, &self.pointer_to("COLOR_0"))? != Some(3) {
            return self.read("COLOR_0");
        }
        let colors = self.read("COLOR_0")?.into_iter();
        Ok(colors.map(|[red, green, blue]| [red, green, blue, 1.0]).collect())
    }

    fn pointer_to(&self, key: &str) -> String {
        format!("{}/attributes/{key}", self.pointer)
    }
}
