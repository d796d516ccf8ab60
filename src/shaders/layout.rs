//! Twins of the WGSL structs and of the vertex inputs. A test compares each offset with what naga computes for the shader.

use bytemuck::{Pod, Zeroable};

/// Twin of `Camera` in `camera.wgsl`, which says what each member means. Matrices are column by column, as in glam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in camera.wgsl, where each is used")]
pub struct Camera {
    pub clip_from_world: [[f32; 4]; 4],
    pub eye: [f32; 3],
    pub is_perspective: f32,
    pub forward: [f32; 3],
    pub depth_near: f32,
    pub eye_per_x: [f32; 3],
    pub depth_far: f32,
    pub eye_per_y: [f32; 3],
    pub exposure_stops: f32,
    pub forward_per_x: [f32; 3],
    pub view_mode: u32,
    pub forward_per_y: [f32; 3],
    pub first_row: f32,
    pub viewport_pixels: [f32; 2],
    pub jitter: [f32; 2],
    pub map_size: [f32; 2],
    pub sample: f32,
    pub points_high: f32,
    pub first_map_row: f32,
    pub unused: [f32; 3],
}

/// Twin of `Light` in `light.wgsl`, which says what each member means. Matrices are column by column, as in glam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in light.wgsl, where each is used")]
pub struct Light {
    pub shadow_clip_from_world: [[f32; 4]; 4],
    pub to_key: [f32; 3],
    pub shadow_texel: f32,
    pub to_rim: [f32; 3],
    pub shadow_radius_texels: f32,
    pub to_book_light_1: [f32; 3],
    pub occlusion_radius: f32,
    pub to_book_light_2: [f32; 3],
    pub book_unit: f32,
    pub key_shadow: u32,
    pub reflections: f32,
    pub is_book: u32,
    pub normal_green_sign: f32,
    pub fine_occlusion: u32,
    pub shadow_taps: u32,
    pub shadow_depth: f32,
    pub noise_turn: f32,
    pub key_color: [f32; 3],
    pub key_mirrored: f32,
    pub rim_color: [f32; 3],
    pub lamp_tangent: f32,
}

/// Twin of `Ground` in `ground.wgsl`, which says what each member means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in ground.wgsl, where each is used")]
pub struct Ground {
    pub backdrop_center_srgb: [f32; 4],
    pub backdrop_edge_srgb: [f32; 4],
    pub grid: [f32; 4],
    pub floor: [f32; 4],
    pub background_srgb: [f32; 3],
    pub background: u32,
    pub center: [f32; 2],
    pub contact_center: [f32; 2],
    pub contact_half_width: f32,
    pub contact_strength: f32,
    pub shadow_strength: f32,
    pub height: f32,
    pub grid_cell: f32,
    pub grid_reach: f32,
    pub floor_reach: f32,
    pub unused: f32,
}

/// Twin of `Material` in `material.wgsl`, which says what each member means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in material.wgsl, where each is used")]
pub struct Material {
    pub albedo: [f32; 3],
    pub roughness: f32,
    pub fresnel0: [f32; 3],
    pub alpha_clip: f32,
    pub book_albedo: [f32; 3],
    pub is_phong: u32,
    pub ambient: [f32; 3],
    pub spec_power: f32,
    pub specular: [f32; 3],
    pub normal_channels: u32,
    pub reflectivity: [f32; 3],
    pub normal_lengths: u32,
    pub identity_srgb: [f32; 3],
    pub threshold_step: f32,
}

/// Twin of `MapPlace` in `all_maps.wgsl`: the rows of a 2×3 matrix. `all_maps.wgsl` says what their w are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in all_maps.wgsl, where each is used")]
pub struct MapPlace {
    pub u: [f32; 4],
    pub v: [f32; 4],
}

/// Twin of `MaterialMaps` in `all_maps.wgsl`, which says what each member means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in all_maps.wgsl, where each is used")]
pub struct MaterialMaps {
    pub places: [MapPlace; 9],
    pub emissive: [f32; 3],
    pub opacity: f32,
    pub metallic: f32,
    pub normal_scale: f32,
    pub occlusion_strength: f32,
    pub least_solid_alpha: f32,
    pub present: u32,
    pub has_map_alpha: u32,
    pub is_metallic_roughness: u32,
    pub is_unlit: u32,
    pub dielectric_fresnel0: [f32; 3],
    pub specular: f32,
    pub sheen: [f32; 3],
    pub sheen_roughness: f32,
    pub coat: f32,
    pub coat_roughness: f32,
    pub boundary_fresnel0: f32,
    pub solid: f32,
    pub coat_normal_scale: f32,
    pub coat_normal_channels: u32,
    pub coat_normal_lengths: u32,
    pub unused: u32,
}

/// Twin of `Environment` in `environment.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Environment {
    /// Irradiance over π as spherical harmonics: [`Irradiance::to_uniform`](crate::light::Irradiance::to_uniform).
    pub sh: [[f32; 4]; 9],
    /// World x of the environment's x axis, which is horizontal and of unit length.
    pub turn_cos: f32,
    /// World z of the same axis.
    pub turn_sin: f32,
    pub intensity: f32,
    /// Levels of the specular cube; 0 where it is not to be read.
    pub specular_level_count: f32,
}

/// Twin of `Accumulation` in `accumulate.wgsl`, which says what each member means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in accumulate.wgsl, where each is used")]
pub struct Accumulation {
    pub share: f32,
    pub turn: f32,
    pub first_row: f32,
    pub unused: f32,
}

/// Twin of `Composite` in `composite.wgsl`, which says what each member means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
#[expect(missing_docs, reason = "documented in composite.wgsl, where each is used")]
pub struct Composite {
    pub picture: [f32; 4],
    pub layer: [f32; 4],
    pub is_root: f32,
    pub dithers: f32,
    pub first_row: f32,
    pub unused: f32,
}

/// Twin of `Line` in `lines.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Line {
    /// sRGB, straight alpha.
    pub color_srgb: [f32; 4],
    /// World units.
    pub length: f32,
    /// Fills the struct to whole 16 bytes.
    pub unused: [f32; 3],
}

/// Where every vertex is in bind space: shader location 0. A stream of its own, since passes that draw depth read nothing else.
pub type PositionVertex = [f32; 3];

/// What every vertex has besides: shader locations 1–3, bind space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SurfaceVertex {
    /// Location 1, unit.
    pub normal: [f32; 3],
    /// Location 2; w = ±1.
    pub tangent: [f32; 4],
    /// Location 3.
    pub tex_coord: [f32; 2],
}

/// What a vertex has besides where materials read all maps: shader locations 13 and 14.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct MoreMapsVertex {
    /// Location 13, linear, 16 bits a channel for 0…1.
    pub color: [u16; 4],
    /// Location 14.
    pub second_tex_coord: [f32; 2],
}

/// What a skinned vertex has besides: shader locations 4 and 5. Indices have 32 bits, as a skeleton may have more than
/// 65 536 joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct InfluenceVertex {
    /// Location 4.
    pub joints: [u32; 4],
    /// Location 5.
    pub weights: [f32; 4],
}

/// What an instance of the model has: shader locations 7–12. Location 6 is the colour of a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Instance {
    /// Locations 7–9: rows of a 3×4 matrix, the file's space -> the world.
    pub rows: [[f32; 4]; 3],
    /// Location 10, sRGB, straight alpha: the colour of a highlight or a ghost.
    pub tint_srgb: [f32; 4],
    /// Location 11: where its joints begin in the bone texture.
    pub first_joint: u32,
    /// Location 12: +1 when clockwise triangles show their front in the world, −1 when counter-clockwise ones do.
    pub front_sign: f32,
}
