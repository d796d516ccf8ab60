//! The JSON as it stands: one struct for each object that is read, with the names of glTF 2.0. Lists that are absent are empty.

#![expect(missing_docs, reason = "the names are the format's")]

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, Unexpected, Visitor};
use serde_json::Value;

/// A whole number of 0 or more: an index, a count or a length. JSON may write it as `2.0`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Index(pub u64);

impl<'de> Deserialize<'de> for Index {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Whole;
        impl Visitor<'_> for Whole {
            type Value = Index;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a whole number of 0 or more")
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Index, E> {
                Ok(Index(number))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Index, E> {
                let whole = u64::try_from(number).map_err(|_| E::invalid_value(Unexpected::Signed(number), &self));
                whole.map(Index)
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Index, E> {
                // Beyond 2⁵³ not every whole number has its own f64.
                if number.fract() == 0.0 && (0.0..9e15).contains(&number) {
                    Ok(Index(number as u64))
                } else {
                    Err(E::invalid_value(Unexpected::Float(number), &self))
                }
            }
        }
        deserializer.deserialize_any(Whole)
    }
}

macro_rules! objects {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field:meta])* $key:ident : $kind:ty,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Deserialize)]
        #[serde(rename_all = "camelCase")]
        pub struct $name { $($(#[$field])* pub $key: $kind,)* }
    )*};
}

objects! {
    Root {
        asset: Option<Asset>,
        scene: Option<Index>,
        scenes: Option<Vec<Scene>>,
        nodes: Option<Vec<Node>>,
        meshes: Option<Vec<Mesh>>,
        skins: Option<Vec<Skin>>,
        animations: Option<Vec<Animation>>,
        accessors: Option<Vec<Accessor>>,
        buffer_views: Option<Vec<BufferView>>,
        buffers: Option<Vec<Buffer>>,
        materials: Option<Vec<Material>>,
        textures: Option<Vec<Texture>>,
        images: Option<Vec<Image>>,
        samplers: Option<Vec<Sampler>>,
        cameras: Option<Vec<IgnoredAny>>,
        extensions_used: Option<Vec<String>>,
        extensions_required: Option<Vec<String>>,
        extras: Option<Value>,
    }

    /// What wrote the file, and for which version of glTF.
    Asset {
        version: String,
        min_version: Option<String>,
        generator: Option<String>,
        copyright: Option<String>,
        extras: Option<Value>,
    }

    Scene {
        nodes: Option<Vec<Index>>,
        extras: Option<Value>,
    }

    Node {
        name: Option<String>,
        children: Option<Vec<Index>>,
        mesh: Option<Index>,
        skin: Option<Index>,
        camera: Option<Index>,
        matrix: Option<[f32; 16]>,
        translation: Option<[f32; 3]>,
        rotation: Option<[f32; 4]>,
        scale: Option<[f32; 3]>,
        weights: Option<Vec<f32>>,
        #[serde(default)]
        extensions: NodeExtensions,
        extras: Option<Value>,
    }

    /// The extensions of a node that are counted.
    NodeExtensions {
        #[serde(rename = "KHR_lights_punctual")]
        light: Option<IgnoredAny>,
    }

    Mesh {
        name: Option<String>,
        primitives: Vec<Primitive>,
        weights: Option<Vec<f32>>,
        extras: Option<Value>,
    }

    /// A part of a mesh with one material.
    Primitive {
        attributes: BTreeMap<String, Index>,
        indices: Option<Index>,
        material: Option<Index>,
        mode: Option<Index>,
        #[serde(default)]
        targets: Vec<BTreeMap<String, Index>>,
    }

    /// Joints, and where they are in the bind pose.
    Skin {
        name: Option<String>,
        joints: Vec<Index>,
        inverse_bind_matrices: Option<Index>,
        skeleton: Option<Index>,
        extras: Option<Value>,
    }

    Animation {
        name: Option<String>,
        channels: Vec<Channel>,
        samplers: Vec<AnimationSampler>,
        extras: Option<Value>,
    }

    Channel {
        sampler: Index,
        target: Target,
    }

    Target {
        node: Option<Index>,
        path: Path,
    }

    AnimationSampler {
        input: Index,
        output: Index,
        #[serde(default)]
        interpolation: Interpolation,
    }

    Accessor {
        buffer_view: Option<Index>,
        byte_offset: Option<Index>,
        component_type: Index,
        #[serde(default)]
        normalized: bool,
        count: Index,
        #[serde(rename = "type")]
        kind: String,
        sparse: Option<Sparse>,
    }

    /// Elements of an accessor that are others than in its buffer.
    Sparse {
        count: Index,
        indices: SparseIndices,
        values: SparseValues,
    }

    SparseIndices {
        buffer_view: Index,
        byte_offset: Option<Index>,
        component_type: Index,
    }

    SparseValues {
        buffer_view: Index,
        byte_offset: Option<Index>,
    }

    BufferView {
        buffer: Index,
        byte_offset: Option<Index>,
        byte_length: Index,
        byte_stride: Option<Index>,
        target: Option<Index>,
    }

    Buffer {
        uri: Option<String>,
        byte_length: Index,
    }

    Material {
        name: Option<String>,
        pbr_metallic_roughness: Option<PbrMetallicRoughness>,
        normal_texture: Option<NormalTexture>,
        occlusion_texture: Option<OcclusionTexture>,
        emissive_texture: Option<TextureInfo>,
        emissive_factor: Option<[f32; 3]>,
        alpha_mode: Option<String>,
        alpha_cutoff: Option<f32>,
        #[serde(default)]
        double_sided: bool,
        #[serde(default)]
        extensions: MaterialExtensions,
        extras: Option<Value>,
    }

    /// The extensions of a material that are read.
    MaterialExtensions {
        #[serde(rename = "KHR_materials_unlit")]
        unlit: Option<Value>,
        #[serde(rename = "KHR_materials_emissive_strength")]
        emissive_strength: Option<EmissiveStrength>,
        #[serde(rename = "KHR_materials_transmission")]
        transmission: Option<Transmission>,
        #[serde(rename = "KHR_materials_ior")]
        ior: Option<Ior>,
        #[serde(rename = "KHR_materials_specular")]
        specular: Option<Specular>,
        #[serde(rename = "KHR_materials_clearcoat")]
        clearcoat: Option<Clearcoat>,
        #[serde(rename = "KHR_materials_sheen")]
        sheen: Option<Sheen>,
    }

    Ior {
        ior: Option<f32>,
    }

    Specular {
        specular_factor: Option<f32>,
        specular_color_factor: Option<[f32; 3]>,
        specular_texture: Option<TextureInfo>,
        specular_color_texture: Option<TextureInfo>,
    }

    Clearcoat {
        clearcoat_factor: Option<f32>,
        clearcoat_roughness_factor: Option<f32>,
        clearcoat_texture: Option<TextureInfo>,
        clearcoat_roughness_texture: Option<TextureInfo>,
        clearcoat_normal_texture: Option<NormalTexture>,
    }

    Sheen {
        sheen_color_factor: Option<[f32; 3]>,
        sheen_roughness_factor: Option<f32>,
        sheen_color_texture: Option<TextureInfo>,
        sheen_roughness_texture: Option<TextureInfo>,
    }

    Transmission {
        transmission_factor: Option<f32>,
        transmission_texture: Option<IgnoredAny>,
    }

    EmissiveStrength {
        emissive_strength: Option<f32>,
    }

    PbrMetallicRoughness {
        base_color_factor: Option<[f32; 4]>,
        base_color_texture: Option<TextureInfo>,
        metallic_factor: Option<f32>,
        roughness_factor: Option<f32>,
        metallic_roughness_texture: Option<TextureInfo>,
    }

    TextureInfo {
        index: Index,
        tex_coord: Option<Index>,
        #[serde(default)]
        extensions: TextureInfoExtensions,
    }

    NormalTexture {
        scale: Option<f32>,
        #[serde(flatten)]
        info: TextureInfo,
    }

    OcclusionTexture {
        strength: Option<f32>,
        #[serde(flatten)]
        info: TextureInfo,
    }

    /// The extensions of a texture's use that are read.
    TextureInfoExtensions {
        #[serde(rename = "KHR_texture_transform")]
        transform: Option<TextureTransform>,
    }

    TextureTransform {
        offset: Option<[f32; 2]>,
        rotation: Option<f32>,
        scale: Option<[f32; 2]>,
        tex_coord: Option<Index>,
    }

    Texture {
        sampler: Option<Index>,
        source: Option<Index>,
        name: Option<String>,
        #[serde(default)]
        extensions: BTreeMap<String, Value>,
    }

    Image {
        uri: Option<String>,
        mime_type: Option<String>,
        buffer_view: Option<Index>,
        name: Option<String>,
    }

    Sampler {
        mag_filter: Option<Index>,
        min_filter: Option<Index>,
        wrap_s: Option<Index>,
        wrap_t: Option<Index>,
    }
}

/// What a channel moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Path {
    #[default]
    Translation,
    Rotation,
    Scale,
    Weights,
    #[serde(other)]
    Unknown,
}

/// How values go from key to key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Interpolation {
    #[default]
    Linear,
    Step,
    CubicSpline,
    /// A word that glTF does not have.
    #[serde(other)]
    Unknown,
}

/// A list of the document; empty where it is absent.
macro_rules! lists {
    ($($name:ident : $kind:ty,)*) => {
        impl Root {$(
            #[doc = concat!("`", stringify!($name), "`; empty where the document has none.")]
            pub fn $name(&self) -> &[$kind] {
                self.$name.as_deref().unwrap_or_default()
            }
        )*}
    };
}

lists! {
    scenes: Scene,
    nodes: Node,
    meshes: Mesh,
    skins: Skin,
    animations: Animation,
    accessors: Accessor,
    buffer_views: BufferView,
    buffers: Buffer,
    materials: Material,
    textures: Texture,
    images: Image,
    samplers: Sampler,
    cameras: IgnoredAny,
}

impl Node {
    /// Its children.
    pub fn children(&self) -> impl Iterator<Item = u64> {
        self.children.iter().flatten().map(|child| child.0)
    }
}

impl Texture {
    /// The image with its picture: that of EXT_texture_webp where it has one.
    pub fn image(&self) -> Option<Index> {
        let webp = self.extensions.get("EXT_texture_webp");
        let source = webp.and_then(|webp| webp.get("source")?.as_u64());
        source.map(Index).or(self.source)
    }
}
