//! What a material looks like in the books' light, with its pictures, and what the books' materials say so that it looks the same.

use std::collections::HashMap;
use std::f32::consts::LN_2;
use std::rc::Rc;

use glam::{Affine2, Vec2, Vec3};

use crate::export::MapImages;
use crate::format::{self, Dialect};
use crate::image::Image;
use crate::image::srgb::{curve, linear_from_srgb, srgb_from_linear};
use crate::model::{FresnelSurface, MapSlot, Material, Mesh, Model, Reflectance, Sampling, Submesh, Wrap};

/// Points of the triangles of a material at which its maps are looked up, at most, and of one triangle.
const MOST_POINTS: usize = 2048;
const MOST_POINTS_OF_TRIANGLE: usize = 256;

/// Of a picture's levels the first one with no more texels than this is looked up for means.
const MOST_TEXELS: u32 = 1 << 18;

/// The least SpecPower: of a lower one the lobe spreads over all that is lit, and at 0 it is 1 everywhere.
const LEAST_POWER: f32 = 8.0;

/// What a ball mirrors more by Schlick's term than face on, on average over its disc: ∫ 2 c (1 − c)⁵ dc.
const GRAZING: f32 = 1.0 / 21.0;

/// Metalness that differs by no more than this is even: two steps of eight bits.
const EVEN: f32 = 2.5 / 255.0;

/// What a material shows on average over the surface that it covers, in the light of the DirectX 12 book.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Of the diffuse map, sRGB-encoded; 1 without one.
    texel: Vec3,
    /// The diffuse colour, sRGB-encoded.
    albedo: Vec3,
    fresnel0: Vec3,
    /// The mean of roughness, 0 … 1.
    pub roughness: f32,
    /// The mean of metalness, 0 … 1.
    pub metallic: f32,
    is_even: bool,
    /// How a diffuse map with the metalness in it is made.
    bake: Option<Bake>,
    is_baked: bool,
}

/// How a diffuse map is made of a picture of base colours and one of metalness.
#[derive(Clone, Debug, PartialEq)]
pub struct Bake {
    factor: Vec3,
    metallic: f32,
    /// Fresnel0 where it is no metal.
    dielectric: Vec3,
    /// How much of Fresnel0 comes to the diffuse colour.
    fresnel0: Vec3,
    /// Texture coordinates of the new map -> those of metalness.
    metallic_from_map: Affine2,
    wrap: [Wrap; 2],
    /// How the new map is sampled.
    pub sampling: Sampling,
}

/// The looks of all materials. Pictures that are not there are none; where that of metalness is not, a material is taken for no metal.
pub fn looks(model: &Model, maps: &MapImages<'_>) -> Vec<Look> {
    let mut decoded: HashMap<*const Image, Rc<Texels>> = HashMap::new();
    let mut texels = |material: usize, slot: MapSlot| {
        let image = *maps.get(&(material, slot))?;
        let texels = decoded.entry(std::ptr::from_ref(image));
        Some(Rc::clone(texels.or_insert_with(|| Rc::new(Texels::of_mean(image)))))
    };
    let mut drawn: Vec<Vec<Submesh>> = vec![Vec::new(); model.materials.len()];
    for submesh in &model.mesh.submeshes {
        drawn[submesh.material as usize].push(*submesh);
    }
    let materials = model.materials.iter().zip(drawn).enumerate();
    materials
        .map(|(index, (material, drawn))| match material.reflectance {
            Reflectance::MetallicRoughness { .. } => {
                let [base, metallic] = [MapSlot::Diffuse, MapSlot::MetallicRoughness]
                    .map(|slot| Some((texels(index, slot)?, material.map(slot)?.sampling)));
                if base.is_none() && metallic.is_none() {
                    return Look::of_numbers(material);
                }
                let mut look = Look::of_points(material, &points(&model.mesh, &drawn), [&base, &metallic]);
                // A base colour that is named and not there cannot be multiplied.
                let is_known = base.is_some() || material.diffuse_map.is_none();
                let [base, metallic] = [base, metallic].map(|map| map.map(|(_, sampling)| sampling));
                look.bake = metallic
                    .filter(|_| is_known && !look.is_even)
                    .and_then(|metallic| Bake::new(material, base, metallic));
                look
            }
            _ => Look::of_numbers(material),
        })
        .collect()
}

impl Look {
    /// Of the numbers of a material alone.
    pub(super) fn of_numbers(material: &Material) -> Self {
        Self::of_points(material, &[([Vec2::ZERO; 2], 1.0)], [&None, &None])
    }

    fn of_points(
        material: &Material,
        points: &[([Vec2; 2], f32)],
        [base, metallic_roughness]: [&Option<(Rc<Texels>, Sampling)>; 2],
    ) -> Self {
        let surface = material.fresnel_surface();
        let mut look = Self {
            texel: Vec3::ONE,
            albedo: material.diffuse.into(),
            fresnel0: surface.fresnel0.into(),
            roughness: surface.roughness,
            metallic: 0.0,
            is_even: true,
            bake: None,
            is_baked: false,
        };
        let Reflectance::MetallicRoughness { metallic, roughness } = material.reflectance else {
            return look;
        };
        let is_unknown = material.metallic_roughness_map.is_some() && metallic_roughness.is_none();
        let dielectric = Vec3::from(material.layers.fresnel0());
        let numbers = [if is_unknown { 0.0 } else { metallic }, roughness];
        (look.texel, look.albedo, look.fresnel0, look.roughness) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO, 0.0);
        let (mut all, mut least, mut most) = (0.0_f32, 1.0_f32, 0.0_f32);
        for &(coords, share) in points {
            let at = |map: &Option<(Rc<Texels>, Sampling)>| {
                let place = |(texels, sampling): &(Rc<Texels>, Sampling)| {
                    texels.at(sampling.tex_coords(coords[0], coords[1]), sampling.wrap)
                };
                map.as_ref().map_or([1.0; 4], place)
            };
            let [red, green, blue, _] = at(base);
            let texel = Vec3::new(red, green, blue);
            let [_, rough, metal, _] = at(metallic_roughness);
            let (metallic, roughness) = (numbers[0] * metal, numbers[1] * rough);
            let color = Vec3::from(material.diffuse) * texel.map(curve);
            look.texel += texel * share;
            look.albedo += (color * (1.0 - metallic)).map(encoded) * share;
            look.fresnel0 += dielectric.lerp(color, metallic) * share;
            look.roughness += roughness * share;
            look.metallic += metallic * share;
            (least, most) = (least.min(metallic), most.max(metallic));
            all += share;
        }
        for sum in [&mut look.texel, &mut look.albedo, &mut look.fresnel0] {
            *sum /= all;
        }
        (look.roughness, look.metallic) = (look.roughness / all, look.metallic / all);
        look.is_even = most - least <= EVEN;
        look
    }

    /// How a diffuse map with 1 − metalness in it is made for this book, where metalness is uneven and the texture coordinates allow it.
    /// From now on the material has such a map.
    pub fn bake(&mut self, dialect: Dialect) -> Option<Bake> {
        let mut bake = self.bake.take()?;
        self.is_baked = true;
        if dialect != Dialect::D3d12 {
            bake.fresnel0 = self.lobe().0 / self.fresnel0.max(Vec3::splat(f32::MIN_POSITIVE));
        }
        Some(bake)
    }

    /// Whether its diffuse map is made so.
    pub fn is_baked(&self) -> bool {
        self.is_baked
    }

    /// In the words of the DirectX 11 book: what comes to the diffuse colour, Specular, and SpecPower.
    ///
    /// The other book's light (`LightingUtil.hlsl`) has the lobe s = Fresnel0 · (m + 8) / 8 · cosᵐ of the half angle with m = 256 · (1 −
    /// roughness), brought below 1 by s / (1 + s), times Lambert's term. Where m is 0 that is a diffuse colour. This book's
    /// (`LightHelper.fx`) has the cosine of the mirrored light to the power of SpecPower. The powers are such that both are half as high at
    /// the same place. The factors 2.1 and 0.8 bring them nearest on average over a ball, lit from anywhere, and 8 lets the one go over
    /// into the other.
    fn lobe(&self) -> (Vec3, Vec3, f32) {
        let power = 256.0 * (1.0 - self.roughness.clamp(0.0, 1.0));
        let rough = (-power / 8.0).exp();
        let low = |height: Vec3| height / (height + 1.0);
        let height = self.fresnel0 * (power + 8.0) / 8.0;
        let white = if self.is_baked { Vec3::ONE } else { self.texel };
        let diffuse = (low(self.fresnel0) * rough).min((white - self.albedo).max(Vec3::ZERO));
        let half = (height.element_sum() / 3.0 + 2.0).ln();
        let spec_power = (2.1 * LN_2 * power / (4.0 * half)).max(LEAST_POWER).round();
        (diffuse, 0.8 * low(height) * (1.0 - rough), spec_power)
    }

    /// What a file of this book says of the material: its diffuse colour, and how it reflects. What the book has words for stays.
    pub(super) fn written_values(&self, material: &Material, dialect: Dialect) -> ([f32; 3], format::Reflectance) {
        match (dialect, material.reflectance) {
            (Dialect::D3d12, Reflectance::Fresnel { .. } | Reflectance::Phong { .. }) => {
                let FresnelSurface {
                    fresnel0, roughness, ..
                } = material.fresnel_surface();
                return (material.diffuse, format::Reflectance::Fresnel { fresnel0, roughness });
            }
            (
                _,
                Reflectance::Phong {
                    ambient,
                    specular,
                    spec_power,
                    reflectivity,
                },
            ) => {
                let reflectance = format::Reflectance::Phong {
                    ambient,
                    specular,
                    spec_power,
                    reflectivity,
                };
                return (material.diffuse, reflectance);
            }
            _ => {}
        }
        // The number by which the map's mean becomes the colour's. A map that is made has the colour itself.
        let of_map = |color: Vec3, texel: Vec3| -> [f32; 3] {
            if self.is_baked && color == texel {
                return [1.0; 3];
            }
            let quotient = color / texel.max(Vec3::splat(0.5 / 255.0));
            quotient.clamp(Vec3::ZERO, Vec3::ONE).map(short).into()
        };
        if dialect == Dialect::D3d12 {
            let reflectance = format::Reflectance::Fresnel {
                fresnel0: self.fresnel0.map(short).into(),
                roughness: short(self.roughness),
            };
            let texel = if self.is_baked { self.albedo } else { self.texel };
            return (of_map(self.albedo, texel), reflectance);
        }
        let (added, specular, spec_power) = self.lobe();
        let diffuse = self.albedo + added;
        let texel = if self.is_baked { diffuse } else { self.texel };
        let mirrored = self.fresnel0 + (1.0 - self.fresnel0) * GRAZING;
        let reflectance = format::Reflectance::Phong {
            ambient: of_map(self.albedo, texel),
            specular: specular.map(short).into(),
            spec_power,
            reflectivity: (mirrored * (1.0 - self.roughness)).map(short).into(),
        };
        (of_map(diffuse, texel), reflectance)
    }
}

impl Bake {
    fn new(material: &Material, base: Option<Sampling>, metallic: Sampling) -> Option<Self> {
        let sampling = base.unwrap_or(metallic);
        let Reflectance::MetallicRoughness { metallic: number, .. } = material.reflectance else {
            return None;
        };
        let metallic_from_map = metallic.map_from_mesh * sampling.map_from_mesh.inverse();
        let is_same = metallic.map_from_mesh == sampling.map_from_mesh;
        let can_be_made = sampling.second_tex_coords == metallic.second_tex_coords;
        (can_be_made && (is_same || metallic_from_map.is_finite())).then(|| Self {
            factor: material.diffuse.into(),
            metallic: number,
            dielectric: material.layers.fresnel0().into(),
            fresnel0: Vec3::ZERO,
            metallic_from_map: if is_same { Affine2::IDENTITY } else { metallic_from_map },
            wrap: metallic.wrap,
            sampling,
        })
    }

    /// The new map, as large as that of base colours, whose alpha it keeps, else as that of metalness. RGBA, 8 bits a channel.
    pub fn texels(&self, base: Option<&Image>, metallic: &Image) -> (Vec<u8>, u32, u32) {
        let of = base.unwrap_or(metallic);
        let (width, height) = (of.width(), of.height());
        let mut made = match base {
            Some(base) => base.to_rgba8(0, 0).unwrap_or_default(),
            None => vec![u8::MAX; 4 * width as usize * height as usize],
        };
        let metallic = Texels::of_level(metallic, 0);
        let rows = made.chunks_exact_mut(4 * width as usize).zip(0u16..);
        for (row, y) in rows {
            for (texel, x) in row.chunks_exact_mut(4).zip(0u16..) {
                let place = (Vec2::new(x.into(), y.into()) + 0.5) / Vec2::new(width as f32, height as f32);
                let [_, _, metal, _] = metallic.at(self.metallic_from_map.transform_point2(place), self.wrap);
                let metal = metal * self.metallic;
                let linear = Vec3::new(
                    linear_from_srgb(texel[0]),
                    linear_from_srgb(texel[1]),
                    linear_from_srgb(texel[2]),
                );
                let color = self.factor * linear;
                let added = self.fresnel0 * self.dielectric.lerp(color, metal);
                let diffuse = (color * (1.0 - metal)).to_array();
                // Alpha stays; a float beyond what a byte holds is its end.
                for ((byte, diffuse), added) in texel.iter_mut().zip(diffuse).zip(added.to_array()) {
                    *byte = srgb_from_linear(diffuse).saturating_add((added * 255.0).round() as u8);
                }
            }
        }
        (made, width, height)
    }
}

/// Texture coordinates, first and second, of points spread over triangles, and how much of the surface each stands for.
fn points(mesh: &Mesh, drawn: &[Submesh]) -> Vec<([Vec2; 2], f32)> {
    let total: u64 = drawn.iter().map(|submesh| u64::from(submesh.triangle_count)).sum();
    let count = (MOST_POINTS as u64).min(total * MOST_POINTS_OF_TRIANGLE as u64);
    if count == 0 {
        return vec![([Vec2::ZERO; 2], 1.0)];
    }
    let mut rest = drawn.iter();
    let (mut current, mut before) = (rest.next(), 0);
    (0..count)
        .filter_map(|point| {
            let triangle = point * total / count;
            while triangle - before >= u64::from(current?.triangle_count) {
                before += u64::from(current?.triangle_count);
                current = rest.next();
            }
            // No more than the triangles of a mesh.
            let triangle = (u64::from(current?.triangle_start) + triangle - before) as usize;
            let corners = [0, 1, 2].map(|corner| mesh.indices[3 * triangle + corner] as usize);
            let [a, b, c] = corners.map(|vertex| mesh.positions[vertex]);
            // Spread evenly (Roberts' R2).
            let [mut u, mut v] = [0.754_877_7, 0.569_840_3].map(|step: f64| (0.5 + point as f64 * step).fract() as f32);
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let at = |coords: &[Vec2]| {
                let [a, b, c] = corners.map(|vertex| coords.get(vertex).copied().unwrap_or_default());
                a + (b - a) * u + (c - a) * v
            };
            let area = (b - a).cross(c - a).length();
            // So many of them can be added up.
            let area = if area <= 1e30 { area.max(f32::MIN_POSITIVE) } else { 1.0 };
            Some(([at(&mesh.tex_coords), at(&mesh.second_tex_coords)], area))
        })
        .collect()
}

#[derive(Debug)]
struct Texels {
    size: [u32; 2],
    rgba: Vec<u8>,
}

impl Texels {
    fn of_level(image: &Image, level: u32) -> Self {
        let (width, height) = image.level_size(level);
        Self {
            size: [width, height],
            rgba: image.to_rgba8(0, level).unwrap_or_default(),
        }
    }

    /// A level that is small, where there is one.
    fn of_mean(image: &Image) -> Self {
        let is_small = |level: &u32| {
            let (width, height) = image.level_size(*level);
            width * height <= MOST_TEXELS
        };
        Self::of_level(image, (0..image.level_count()).find(is_small).unwrap_or_default())
    }

    /// The texel there, 0 … 1 a channel as it is stored.
    fn at(&self, place: Vec2, wrap: [Wrap; 2]) -> [f32; 4] {
        let axis = |place: f32, size: u32, wrap: Wrap| {
            let part = match wrap {
                Wrap::Repeat => place.rem_euclid(1.0),
                Wrap::Clamp => place,
                Wrap::Mirror => 1.0 - (place.rem_euclid(2.0) - 1.0).abs(),
            };
            // What is no number, or beyond the ends, is cut where integers are.
            ((part * size as f32) as usize).min(size as usize - 1)
        };
        let [width, height] = self.size;
        let texel = axis(place.y, height, wrap[1]) * width as usize + axis(place.x, width, wrap[0]);
        let texel = self.rgba.get(4 * texel..4 * texel + 4).unwrap_or(&[0; 4]);
        std::array::from_fn(|channel| f32::from(texel[channel]) / 255.0)
    }
}

/// IEC 61966-2-1.
fn encoded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear.max(0.0) * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// A number of a surface with five digits behind the point.
fn short(number: f32) -> f32 {
    (number * 1e5).round() / 1e5
}
