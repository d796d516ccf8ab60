//! Rules of glTF that a file can break and still be read, where that changes what one sees: what names nothing and is left out, and
//! what is taken otherwise than it stands there. Khronos' validator knows all the others; what is refused elsewhere is not looked at here.

use std::collections::{BTreeMap, HashSet};

use super::buffers::subject;
use super::json::{Accessor, Index, Primitive, Root};
use super::places::escaped;
use super::{Fit, Interpolation, Path, Wanted};
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};

const FLOAT: u64 = 5126;

pub(crate) fn note_broken_rules(root: &Root, diagnostics: &mut Diagnostics) {
    let required = root.extensions_required.iter().flatten();
    let mut rules = Rules {
        root,
        is_quantized: required.into_iter().any(|name| name == "KHR_mesh_quantization"),
        diagnostics,
    };
    rules.accessors();
    rules.buffer_views();
    rules.images_and_textures();
    rules.meshes();
    rules.nodes_and_skins();
    rules.animations();
}

struct Rules<'a> {
    root: &'a Root,
    /// Whether the file requires KHR_mesh_quantization.
    is_quantized: bool,
    diagnostics: &'a mut Diagnostics,
}

/// The entry of a list with this index.
fn entry<T>(list: &[T], index: Index) -> Option<&T> {
    list.get(usize::try_from(index.0).ok()?)
}

impl<'a> Rules<'a> {
    fn broken(&mut self, pointer: impl Into<String>, message: impl Into<String>) {
        self.diagnostics
            .add(&codes::GLTF_RULE_BROKEN, Place::pointer(pointer), message.into());
    }

    /// Notes an index that names nothing.
    fn refers<T>(
        &mut self,
        list: &'a [T],
        what: &str,
        index: Option<Index>,
        pointer: impl FnOnce() -> String,
    ) -> Option<&'a T> {
        let index = index?;
        let found = entry(list, index);
        if found.is_none() {
            let pointer = pointer();
            let message = format!(
                "{} names {what} {}, but there are {}; left out.",
                subject(&pointer),
                index.0,
                list.len()
            );
            self.broken(pointer, message);
        }
        found
    }

    /// Notes whole numbers that are read where floats belong, though they do not belong there either.
    fn whole_numbers(&mut self, accessor: &Accessor, wanted: Wanted, pointer: &str) {
        let rule = match wanted.fit(accessor) {
            Fit::Quantized if !self.is_quantized => {
                "Floats belong here, since the file does not require KHR_mesh_quantization; its whole numbers are taken as they are."
            }
            Fit::NotNormalized => {
                "The accessor does not say that its whole numbers are normalised; taken as if it did."
            }
            Fit::Quantized | Fit::Belongs | Fit::No => return,
        };
        self.broken(pointer, rule);
    }

    fn accessors(&mut self) {
        let root = self.root;
        for (index, accessor) in root.accessors().iter().enumerate() {
            let at = |key: &str| format!("/accessors/{index}{key}");
            self.refers(root.buffer_views(), "buffer view", accessor.buffer_view, || {
                at("/bufferView")
            });
            if let Some(sparse) = &accessor.sparse {
                let views = [
                    ("indices", sparse.indices.buffer_view),
                    ("values", sparse.values.buffer_view),
                ];
                for (key, view) in views {
                    let pointer = || at(&format!("/sparse/{key}/bufferView"));
                    self.refers(root.buffer_views(), "buffer view", Some(view), pointer);
                }
            }
        }
    }

    fn buffer_views(&mut self) {
        let root = self.root;
        for (index, view) in root.buffer_views().iter().enumerate() {
            self.refers(root.buffers(), "buffer", Some(view.buffer), || {
                format!("/bufferViews/{index}/buffer")
            });
        }
    }

    fn images_and_textures(&mut self) {
        let root = self.root;
        for (index, image) in root.images().iter().enumerate() {
            self.refers(root.buffer_views(), "buffer view", image.buffer_view, || {
                format!("/images/{index}/bufferView")
            });
        }
        for (index, texture) in root.textures().iter().enumerate() {
            let at = |key: &str| format!("/textures/{index}/{key}");
            self.refers(root.samplers(), "sampler", texture.sampler, || at("sampler"));
            self.refers(root.images(), "picture", texture.source, || at("source"));
        }
    }

    fn meshes(&mut self) {
        let root = self.root;
        for (mesh, of_file) in root.meshes().iter().enumerate() {
            for (index, part) in of_file.primitives.iter().enumerate() {
                self.primitive(part, &format!("/meshes/{mesh}/primitives/{index}"));
            }
        }
    }

    fn primitive(&mut self, part: &'a Primitive, at: &str) {
        let root = self.root;
        let material = self.refers(root.materials(), "material", part.material, || format!("{at}/material"));
        self.refers(root.accessors(), "accessor", part.indices, || format!("{at}/indices"));
        let count = part
            .attributes
            .get("POSITION")
            .and_then(|&position| Some(entry(root.accessors(), position)?.count));
        let targets = part.targets.iter().enumerate();
        let targets = targets.map(|(index, target)| (format!("{at}/targets/{index}"), target));
        for (list, attributes) in [(format!("{at}/attributes"), &part.attributes)]
            .into_iter()
            .chain(targets)
        {
            for (key, &accessor) in attributes {
                let pointer = format!("{list}/{}", escaped(key));
                if !is_attribute(key) {
                    self.broken(pointer.clone(), format!("There is no attribute {key}; left out."));
                }
                let Some(of_file) = self.refers(root.accessors(), "accessor", Some(accessor), || pointer.clone())
                else {
                    continue;
                };
                if let Some(wanted) = Wanted::of_attribute(key) {
                    self.whole_numbers(of_file, wanted, &pointer);
                }
                if count.is_some_and(|count| count != of_file.count) {
                    let message = format!(
                        "{key} has {} elements for {} vertices.",
                        of_file.count.0,
                        count.unwrap_or_default().0
                    );
                    self.broken(pointer.clone(), message);
                }
            }
        }
        self.joints_have_weights(&part.attributes, at);
        if let Some(material) = material {
            let surface = material.pbr_metallic_roughness.as_ref();
            let infos = [
                surface.and_then(|surface| surface.base_color_texture.as_ref()),
                surface.and_then(|surface| surface.metallic_roughness_texture.as_ref()),
                material.normal_texture.as_ref().map(|normal| &normal.info),
                material.occlusion_texture.as_ref().map(|occlusion| &occlusion.info),
                material.emissive_texture.as_ref(),
            ];
            let sets = infos.into_iter().flatten().map(|info| {
                let transform = info.extensions.transform.as_ref();
                transform
                    .and_then(|transform| transform.tex_coord)
                    .or(info.tex_coord)
                    .unwrap_or_default()
                    .0
            });
            let missing = sets
                .max()
                .filter(|set| !part.attributes.contains_key(&format!("TEXCOORD_{set}")));
            if let Some(set) = missing {
                let message =
                    format!("The material takes texture coordinates {set}, which the primitive does not have.");
                self.broken(format!("{at}/material"), message);
            }
        }
    }

    fn joints_have_weights(&mut self, attributes: &BTreeMap<String, Index>, at: &str) {
        let count = |prefix| attributes.keys().filter(|key| key.starts_with(prefix)).count();
        if count("JOINTS_") != count("WEIGHTS_") {
            self.broken(
                format!("{at}/attributes"),
                "There are not as many JOINTS as WEIGHTS; those without the other are left out.",
            );
        }
    }

    fn nodes_and_skins(&mut self) {
        let root = self.root;
        for (node, of_file) in root.nodes().iter().enumerate() {
            if let Some(numbers) = &of_file.matrix
                && is_sheared(numbers)
            {
                let message = format!("The matrix of node {node} shears or flattens space, which a joint cannot.");
                self.diagnostics.add(
                    &codes::GLTF_MATRIX_SHEARED,
                    Place::pointer(format!("/nodes/{node}/matrix")),
                    message,
                );
            }
        }
        for (skin, of_file) in root.skins().iter().enumerate() {
            let pointer = || format!("/skins/{skin}/inverseBindMatrices");
            self.refers(root.accessors(), "accessor", of_file.inverse_bind_matrices, pointer);
            let mut met = HashSet::new();
            for (slot, &joint) in of_file.joints.iter().enumerate() {
                let pointer = || format!("/skins/{skin}/joints/{slot}");
                self.refers(root.nodes(), "node", Some(joint), pointer);
                if !met.insert(joint) {
                    self.broken(pointer(), "A skin has one joint twice.");
                }
            }
        }
    }

    fn animations(&mut self) {
        let root = self.root;
        for (animation, of_file) in root.animations().iter().enumerate() {
            let mut targets = HashSet::new();
            for (index, channel) in of_file.channels.iter().enumerate() {
                let at = |key: &str| format!("/animations/{animation}/channels/{index}/{key}");
                let node = self.refers(root.nodes(), "node", channel.target.node, || at("target/node"));
                let path = channel.target.path;
                if let Some(node) = channel.target.node
                    && !targets.insert((node, path))
                {
                    self.broken(
                        at("target"),
                        "Another channel moves the same; only the first one is taken.",
                    );
                }
                if path != Path::Weights && node.is_some_and(|node| node.matrix.is_some()) {
                    self.broken(
                        at("target"),
                        "Clips cannot move a node that has a matrix; its parts are moved.",
                    );
                }
                let Some(sampler) = self.refers(&of_file.samplers, "sampler", Some(channel.sampler), || at("sampler"))
                else {
                    continue;
                };
                if let (Path::Rotation, Some(values)) = (path, entry(root.accessors(), sampler.output)) {
                    let pointer = format!("/animations/{animation}/samplers/{}/output", channel.sampler.0);
                    self.whole_numbers(values, Wanted::Rotations, &pointer);
                }
                let count = |accessor| Some(entry(root.accessors(), accessor)?.count.0);
                let each = if sampler.interpolation == Interpolation::CubicSpline {
                    3
                } else {
                    1
                };
                if let (Some(times), Some(values)) = (count(sampler.input), count(sampler.output))
                    && path != Path::Weights
                    && times.saturating_mul(each) != values
                {
                    let message = format!("{times} times have {values} values, where {each} belong to each.");
                    self.broken(at("sampler"), message);
                }
            }
            for (index, sampler) in of_file.samplers.iter().enumerate() {
                let at = |key: &str| format!("/animations/{animation}/samplers/{index}/{key}");
                let input = self.refers(root.accessors(), "accessor", Some(sampler.input), || at("input"));
                self.refers(root.accessors(), "accessor", Some(sampler.output), || at("output"));
                if input.is_some_and(|input| input.component_type.0 != FLOAT || input.kind != "SCALAR") {
                    self.broken(at("input"), "Times are single floats.");
                }
                if sampler.interpolation == Interpolation::Unknown {
                    self.broken(at("interpolation"), "There is no such interpolation; taken as LINEAR.");
                }
            }
        }
    }
}

/// Whether glTF has an attribute of this name, or leaves it to programs.
pub(crate) fn is_attribute(key: &str) -> bool {
    let is_number = |text: &str| {
        !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()) && (text == "0" || !text.starts_with('0'))
    };
    let is_numbered =
        |(name, number): (&str, &str)| matches!(name, "TEXCOORD" | "COLOR" | "JOINTS" | "WEIGHTS") && is_number(number);
    matches!(key, "POSITION" | "NORMAL" | "TANGENT")
        || key.starts_with('_')
        || key.rsplit_once('_').is_some_and(is_numbered)
}

/// Whether the axes of a matrix are not square to each other, or space is flat.
fn is_sheared(numbers: &[f32; 16]) -> bool {
    let axis = |column: usize| glam::Vec3::from_slice(&numbers[column * 4..]).as_dvec3();
    let axes = [axis(0), axis(1), axis(2)];
    let cosine = |a: usize, b: usize| axes[a].dot(axes[b]).abs() / (axes[a].length() * axes[b].length());
    // A flat axis gives NaN, which is not below.
    ![(0, 1), (1, 2), (2, 0)].into_iter().all(|(a, b)| cosine(a, b) < 1e-3)
}
