//! Rules of glTF that a file can break and still be read. What is refused elsewhere is not looked at here, nor what no picture shows:
//! cameras, and lists of nothing.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::buffers::subject;
use super::json::{Accessor, Index, Primitive, Root};
use super::parse::escaped;
use super::{Fit, Interpolation, Path, Uri, Wanted};
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};

const FLOAT: u64 = 5126;
const UNSIGNED_INT: u64 = 5125;

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
            let size = component_size(accessor.component_type.0);
            if size.is_none() {
                let message = format!("There is no component type {}.", accessor.component_type.0);
                self.broken(at("/componentType"), message);
            }
            if accessor.count.0 == 0 {
                self.broken(at("/count"), "An accessor has no elements.");
            }
            if accessor.normalized && matches!(accessor.component_type.0, FLOAT | UNSIGNED_INT) {
                self.broken(
                    at("/normalized"),
                    "Only numbers of 8 and 16 bits are normalised; others are taken as they are.",
                );
            }
            let view = self.refers(root.buffer_views(), "buffer view", accessor.buffer_view, || {
                at("/bufferView")
            });
            if accessor.buffer_view.is_none() && accessor.byte_offset.is_some() {
                self.broken(at("/byteOffset"), "An offset without a buffer view; left out.");
            }
            let offset = accessor.byte_offset.unwrap_or_default().0;
            let begin = view.map_or(0, |view| view.byte_offset.unwrap_or_default().0);
            if accessor.kind.starts_with("MAT") && !offset.is_multiple_of(4) {
                self.broken(
                    at("/byteOffset"),
                    "A matrix does not begin at a multiple of four bytes.",
                );
            } else if let Some(size) = size
                && !(offset.is_multiple_of(size) && offset.saturating_add(begin).is_multiple_of(size))
            {
                self.broken(
                    at("/byteOffset"),
                    format!("Numbers of {size} bytes do not begin at a multiple of {size} bytes."),
                );
            }
            if let (Some(view), Some(size)) = (view, size) {
                let element = size * numbers(&accessor.kind);
                let stride = view.byte_stride.map_or(element, |stride| stride.0);
                if stride < element {
                    self.broken(
                        at(""),
                        format!("Elements of {element} bytes do not fit a step of {stride} bytes."),
                    );
                }
                let end = accessor
                    .count
                    .0
                    .saturating_sub(1)
                    .saturating_mul(stride)
                    .saturating_add(element)
                    .saturating_add(offset);
                if accessor.count.0 > 0 && end > view.byte_length.0 {
                    self.broken(
                        at(""),
                        format!(
                            "An accessor needs {end} bytes of a buffer view of {}.",
                            view.byte_length.0
                        ),
                    );
                }
            }
            if let Some(sparse) = &accessor.sparse {
                if sparse.count.0 > accessor.count.0 || sparse.count.0 == 0 {
                    let message = format!(
                        "The sparse accessor replaces {} elements, but has {}.",
                        sparse.count.0, accessor.count.0
                    );
                    self.broken(at("/sparse/count"), message);
                }
                let views = [
                    ("indices", sparse.indices.buffer_view),
                    ("values", sparse.values.buffer_view),
                ];
                for (key, view) in views {
                    let pointer = || at(&format!("/sparse/{key}/bufferView"));
                    let view = self.refers(root.buffer_views(), "buffer view", Some(view), pointer);
                    if view.is_some_and(|view| view.byte_stride.is_some()) {
                        self.broken(pointer(), "Data of a sparse accessor have a step between elements.");
                    }
                }
            }
        }
    }

    fn buffer_views(&mut self) {
        let root = self.root;
        for (index, view) in root.buffer_views().iter().enumerate() {
            let at = |key: &str| format!("/bufferViews/{index}{key}");
            let buffer = self.refers(root.buffers(), "buffer", Some(view.buffer), || at("/buffer"));
            let offset = view.byte_offset.unwrap_or_default().0;
            if buffer.is_some_and(|buffer| offset.saturating_add(view.byte_length.0) > buffer.byte_length.0) {
                self.broken(at(""), "A buffer view reaches beyond its buffer.");
            }
            if view.byte_length.0 == 0 {
                self.broken(at("/byteLength"), "A buffer view has no bytes.");
            }
            if let Some(stride) = view.byte_stride {
                if !stride.0.is_multiple_of(4) || !(4..=252).contains(&stride.0) {
                    self.broken(
                        at("/byteStride"),
                        format!("A step of {} bytes is no multiple of 4 from 4 to 252.", stride.0),
                    );
                }
                if stride.0 > view.byte_length.0 {
                    self.broken(
                        at("/byteStride"),
                        "A step between elements is longer than the buffer view.",
                    );
                }
            }
        }
    }

    fn images_and_textures(&mut self) {
        let root = self.root;
        for (index, image) in root.images().iter().enumerate() {
            let at = |key: &str| format!("/images/{index}{key}");
            if image.uri.is_some() == image.buffer_view.is_some() {
                self.broken(at(""), "A picture has either an address or a buffer view.");
            }
            self.refers(root.buffer_views(), "buffer view", image.buffer_view, || {
                at("/bufferView")
            });
            if let Some(Err(error)) = image.uri.as_ref().map(|uri| Uri::parse(uri)) {
                self.broken(at("/uri"), format!("A picture is not read: {error}."));
            }
        }
        for (index, texture) in root.textures().iter().enumerate() {
            let at = |key: &str| format!("/textures/{index}/{key}");
            self.refers(root.samplers(), "sampler", texture.sampler, || at("sampler"));
            self.refers(root.images(), "picture", texture.source, || at("source"));
        }
    }

    fn meshes(&mut self) {
        let root = self.root;
        // How buffer views are used: as indices or not, by which attributes.
        let mut as_indices: HashMap<Index, bool> = HashMap::new();
        let mut attribute_views: HashMap<Index, HashSet<Index>> = HashMap::new();
        for (mesh, of_file) in root.meshes().iter().enumerate() {
            for (index, part) in of_file.primitives.iter().enumerate() {
                let at = format!("/meshes/{mesh}/primitives/{index}");
                self.primitive(part, &at, &mut as_indices, &mut attribute_views);
            }
            if of_file.primitives.is_empty() {
                self.broken(format!("/meshes/{mesh}/primitives"), "A mesh has no primitives.");
            }
            let targets = of_file.primitives.first().map_or(0, |part| part.targets.len());
            if of_file.weights.as_ref().is_some_and(|weights| weights.len() != targets) {
                self.broken(
                    format!("/meshes/{mesh}/weights"),
                    "There is not one weight for each morph target.",
                );
            }
            if of_file.primitives.iter().any(|part| part.targets.len() != targets) {
                self.broken(
                    format!("/meshes/{mesh}"),
                    "Primitives of one mesh have different numbers of morph targets.",
                );
            }
        }
    }

    fn primitive(
        &mut self,
        part: &'a Primitive,
        at: &str,
        as_indices: &mut HashMap<Index, bool>,
        attribute_views: &mut HashMap<Index, HashSet<Index>>,
    ) {
        let root = self.root;
        let material = self.refers(root.materials(), "material", part.material, || format!("{at}/material"));
        let indices = self.refers(root.accessors(), "accessor", part.indices, || format!("{at}/indices"));
        let mut overridden = |rules: &mut Self, accessor: &Accessor, is_index: bool, pointer: String| {
            let Some(view) = accessor.buffer_view else { return };
            if *as_indices.entry(view).or_insert(is_index) != is_index {
                rules.broken(pointer, "A buffer view has both indices and attributes.");
            }
        };
        if let Some(indices) = indices {
            let pointer = || format!("{at}/indices");
            overridden(self, indices, true, pointer());
            let view = indices.buffer_view.and_then(|view| entry(root.buffer_views(), view));
            if view.is_some_and(|view| view.byte_stride.is_some()) {
                self.broken(pointer(), "Indices have a step between them.");
            }
        }
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
                overridden(self, of_file, false, pointer.clone());
                if let Some(view) = of_file.buffer_view {
                    let users = attribute_views.entry(view).or_default();
                    users.insert(accessor);
                    let has_step = entry(root.buffer_views(), view).is_none_or(|view| view.byte_stride.is_some());
                    if users.len() > 1 && !has_step {
                        self.broken(
                            pointer,
                            "Attributes share a buffer view that does not say the step between elements.",
                        );
                    }
                }
            }
        }
        self.sets_in_order(&part.attributes, at);
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

    /// Numbered attributes begin at 0 and leave none out; joints come with weights.
    fn sets_in_order(&mut self, attributes: &BTreeMap<String, Index>, at: &str) {
        let mut counts: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
        for key in attributes.keys().filter(|key| !key.starts_with('_')) {
            if let Some((name, number)) = key.rsplit_once('_')
                && let Ok(number) = number.parse::<u64>()
            {
                let (count, most) = counts.entry(name).or_default();
                *count += 1;
                *most = (*most).max(number);
            }
        }
        for (name, (count, most)) in &counts {
            if most.checked_add(1) != Some(*count) {
                self.broken(
                    format!("{at}/attributes"),
                    format!("The attributes {name} are not numbered from 0 on."),
                );
            }
        }
        let count = |name: &str| counts.get(name).map_or(0, |&(count, _)| count);
        if count("JOINTS") != count("WEIGHTS") {
            self.broken(
                format!("{at}/attributes"),
                "There are not as many JOINTS as WEIGHTS; those without the other are left out.",
            );
        }
    }

    fn nodes_and_skins(&mut self) {
        let root = self.root;
        for (node, of_file) in root.nodes().iter().enumerate() {
            let at = |key: &str| format!("/nodes/{node}/{key}");
            self.refers(root.cameras(), "camera", of_file.camera, || at("camera"));
            let mesh = of_file.mesh.and_then(|mesh| entry(root.meshes(), mesh));
            if let (Some(mesh), Some(weights)) = (mesh, &of_file.weights)
                && mesh
                    .primitives
                    .first()
                    .is_some_and(|part| part.targets.len() != weights.len())
            {
                self.broken(at("weights"), "There is not one weight for each morph target.");
            }
            if of_file.weights.is_some() && of_file.mesh.is_none() {
                self.broken(at("weights"), "Weights of morph targets without a mesh.");
            }
            if let Some(numbers) = &of_file.matrix
                && is_sheared(numbers)
            {
                let message = format!("The matrix of node {node} shears or flattens space, which a joint cannot.");
                self.diagnostics
                    .add(&codes::GLTF_MATRIX_SHEARED, Place::pointer(at("matrix")), message);
            }
        }
        for (skin, of_file) in root.skins().iter().enumerate() {
            self.refers(root.nodes(), "node", of_file.skeleton, || {
                format!("/skins/{skin}/skeleton")
            });
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

fn component_size(component: u64) -> Option<u64> {
    Some(match component {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        UNSIGNED_INT | FLOAT => 4,
        _ => return None,
    })
}

fn numbers(kind: &str) -> u64 {
    match kind {
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => 1,
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
