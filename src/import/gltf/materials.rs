//! From the document's materials to ours.

use std::f32::consts::PI;

use glam::{Affine2, Mat2, Vec2};
use serde_json::Value;

use super::images::Images;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::diagnostic::{Subject, codes};
use crate::gltf::{self, Fault, Index, Root, TextureInfo, out_of_range};
use crate::model::{AlphaMode, MapSlot, Material, MaterialMap, Reflectance, Sampling, Wrap, unique_names};

const NEAREST: [u64; 3] = [9728, 9984, 9986];
const CLAMP_TO_EDGE: u64 = 33071;
const MIRRORED_REPEAT: u64 = 33648;

/// One material for each of the document's, and behind them the one of primitives without any.
///
/// # Errors
/// When a material names a texture that is not there.
pub(super) fn materials(root: &Root, images: &Images, diagnostics: &mut Diagnostics) -> Result<Vec<Material>, Fault> {
    let names = root
        .materials()
        .iter()
        .map(|material| material.name.as_deref().unwrap_or_default());
    let names = unique_names(names.chain(["default"]), "material", |index, name| {
        if (index as usize) < root.materials().len() {
            let message = format!("Another material has the same name; this one is shown as \"{name}\".");
            let place = Place::pointer(format!("/materials/{index}/name")).about(Subject::Material(index));
            diagnostics.add(&codes::DUPLICATE_MATERIAL_NAME, place, message);
        }
    });
    let mut materials = Vec::with_capacity(names.len());
    for (index, name) in names.into_iter().enumerate() {
        materials.push(match root.materials().get(index) {
            None => Material {
                name,
                diffuse: [1.0; 3],
                reflectance: Reflectance::MetallicRoughness {
                    metallic: 1.0,
                    roughness: 1.0,
                },
                double_sided: false,
                ..Material::default()
            },
            Some(of_file) => {
                let mut reader = MaterialReader {
                    root,
                    images,
                    index,
                    diagnostics,
                };
                let material = reader.read(name, of_file)?;
                match of_file.extras.as_ref().and_then(|extras| extras.get("bindpose")) {
                    Some(values) => of_book(material, values),
                    None => material,
                }
            }
        });
    }
    Ok(materials)
}

/// Reads one material. What it reads of glTF's layers is in `layers.rs`.
pub(super) struct MaterialReader<'a> {
    root: &'a Root,
    images: &'a Images,
    pub(super) index: usize,
    pub(super) diagnostics: &'a mut Diagnostics,
}

impl MaterialReader<'_> {
    fn read(&mut self, name: String, of_file: &gltf::Material) -> Result<Material, Fault> {
        let no_surface = gltf::PbrMetallicRoughness::default();
        let surface = of_file.pbr_metallic_roughness.as_ref().unwrap_or(&no_surface);
        let at = |key: &str| format!("pbrMetallicRoughness/{key}");
        let [red, green, blue, opacity] = surface.base_color_factor.unwrap_or([1.0; 4]);
        let [red, green, blue, opacity] =
            [red, green, blue, opacity].map(|factor| self.within(&at("baseColorFactor"), factor, [0.0, 1.0]));
        let reflectance = Reflectance::MetallicRoughness {
            metallic: self.within(
                &at("metallicFactor"),
                surface.metallic_factor.unwrap_or(1.0),
                [0.0, 1.0],
            ),
            roughness: self.within(
                &at("roughnessFactor"),
                surface.roughness_factor.unwrap_or(1.0),
                [0.0, 1.0],
            ),
        };
        let strength = of_file.extensions.emissive_strength.as_ref();
        let strength = strength
            .and_then(|extension| extension.emissive_strength)
            .unwrap_or(1.0);
        let strength = self.within("extensions/KHR_materials_emissive_strength", strength, [0.0, f32::MAX]);
        let emissive = of_file.emissive_factor.unwrap_or_default();
        let emissive = emissive.map(|factor| self.within("emissiveFactor", factor, [0.0, 1.0]) * strength);
        let alpha = self.alpha(of_file);
        let normal = of_file.normal_texture.as_ref();
        let occlusion = of_file.occlusion_texture.as_ref();
        let normal_scale = normal.and_then(|normal| normal.scale).unwrap_or(1.0);
        let occlusion_strength = occlusion.and_then(|occlusion| occlusion.strength).unwrap_or(1.0);
        let (layers, [specular_map, clearcoat_map, clearcoat_normal_map, sheen_map]) =
            self.layers(&of_file.extensions, alpha, &name)?;
        Ok(Material {
            diffuse: [red, green, blue],
            opacity,
            reflectance,
            layers,
            alpha,
            double_sided: of_file.double_sided,
            unlit: of_file.extensions.unlit.is_some(),
            emissive: emissive.map(|light| if light.is_finite() { light } else { 0.0 }),
            normal_scale: if normal_scale.is_finite() { normal_scale } else { 1.0 },
            occlusion_strength: self.within("occlusionTexture/strength", occlusion_strength, [0.0, 1.0]),
            diffuse_map: self.map(surface.base_color_texture.as_ref(), &at("baseColorTexture"))?,
            normal_map: self.map(normal.map(|normal| &normal.info), "normalTexture")?,
            metallic_roughness_map: self.map(
                surface.metallic_roughness_texture.as_ref(),
                &at("metallicRoughnessTexture"),
            )?,
            occlusion_map: self.map(occlusion.map(|occlusion| &occlusion.info), "occlusionTexture")?,
            emissive_map: self.map(of_file.emissive_texture.as_ref(), "emissiveTexture")?,
            specular_map,
            clearcoat_map,
            clearcoat_normal_map,
            sheen_map,
            name,
        })
    }

    fn alpha(&mut self, of_file: &gltf::Material) -> AlphaMode {
        match of_file.alpha_mode.as_deref() {
            None | Some("OPAQUE") => AlphaMode::Opaque,
            Some("BLEND") => AlphaMode::Blend,
            Some("MASK") => AlphaMode::Mask {
                cutoff: self.within("alphaCutoff", of_file.alpha_cutoff.unwrap_or(0.5), [0.0, f32::MAX]),
            },
            Some(other) => {
                self.broken(
                    "alphaMode",
                    format!("There is no alpha mode \"{other}\"; taken as OPAQUE."),
                );
                AlphaMode::Opaque
            }
        }
    }

    /// A number brought between its bounds.
    pub(super) fn within(&mut self, key: &str, number: f32, [least, most]: [f32; 2]) -> f32 {
        let inside = if number.is_nan() {
            least
        } else {
            number.clamp(least, most)
        };
        if inside != number {
            self.broken(key, format!("{number} is out of range; taken as {inside}."));
        }
        inside
    }

    fn broken(&mut self, key: &str, message: String) {
        let place =
            Place::pointer(format!("/materials/{}/{key}", self.index)).about(Subject::Material(self.index as u32));
        self.diagnostics.add(&codes::GLTF_RULE_BROKEN, place, message);
    }

    pub(super) fn map(&mut self, info: Option<&TextureInfo>, key: &str) -> Result<Option<MaterialMap>, Fault> {
        let Some(info) = info else { return Ok(None) };
        let textures = self.root.textures();
        let found = usize::try_from(info.index.0)
            .ok()
            .and_then(|index| Some((index, textures.get(index)?)));
        let Some((index, texture)) = found else {
            let pointer = format!("/materials/{}/{key}/index", self.index);
            return Err(out_of_range(&pointer, "texture", info.index.0, textures.len()));
        };
        let Some(source) = texture.image() else {
            let message = match texture.extensions.keys().next() {
                Some(name) => format!("Texture {index} has its picture in the extension {name} alone; left out."),
                None => format!("Texture {index} has no picture; left out."),
            };
            let place = Place::pointer(format!("/textures/{index}")).about(Subject::Material(self.index as u32));
            self.diagnostics.add(&codes::GLTF_IMAGE_NOT_READ, place, message);
            return Ok(None);
        };
        let image = usize::try_from(source.0)
            .ok()
            .and_then(|source| self.images.names.get(source));
        let Some(name) = image else {
            let count = self.images.names.len();
            return Err(out_of_range(
                &format!("/textures/{index}/source"),
                "image",
                source.0,
                count,
            ));
        };
        let Some(name) = name.clone() else {
            return Ok(None);
        };
        let sampling = self.sampling(info, texture, index, key)?;
        Ok(Some(MaterialMap { name, sampling }))
    }

    fn sampling(
        &mut self,
        info: &TextureInfo,
        texture: &gltf::Texture,
        index: usize,
        key: &str,
    ) -> Result<Sampling, Fault> {
        let samplers = self.root.samplers();
        let sampler = match texture.sampler {
            None => None,
            Some(Index(sampler)) => match usize::try_from(sampler).ok().and_then(|sampler| samplers.get(sampler)) {
                None => {
                    let pointer = format!("/textures/{index}/sampler");
                    return Err(out_of_range(&pointer, "sampler", sampler, samplers.len()));
                }
                found => found,
            },
        };
        let wrap = |mode: Option<Index>| match mode.map(|mode| mode.0) {
            Some(CLAMP_TO_EDGE) => Wrap::Clamp,
            Some(MIRRORED_REPEAT) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        let transform = info.extensions.transform.as_ref();
        let set = transform
            .and_then(|transform| transform.tex_coord)
            .or(info.tex_coord)
            .map_or(0, |set| set.0);
        if set > 1 {
            self.broken(
                &format!("{key}/texCoord"),
                format!("Texture coordinates {set} are not read; the first are taken."),
            );
        }
        let map_from_mesh = transform.map_or(Affine2::IDENTITY, |transform| {
            let [offset, scale] = [
                transform.offset.unwrap_or_default(),
                transform.scale.unwrap_or([1.0; 2]),
            ];
            // Turned against the clock, where v points down: glTF's matrix is that of the opposite angle.
            let rotation = Mat2::from_angle(-transform.rotation.unwrap_or_default() % (2.0 * PI));
            let scaled = rotation * Mat2::from_diagonal(Vec2::from_array(scale));
            Affine2::from_mat2_translation(scaled, Vec2::from_array(offset))
        });
        let is_sound = map_from_mesh.is_finite();
        if !is_sound {
            self.broken(
                &format!("{key}/extensions"),
                "The transform of a texture is not finite; left out.".to_owned(),
            );
        }
        Ok(Sampling {
            second_tex_coords: set == 1,
            map_from_mesh: if is_sound { map_from_mesh } else { Affine2::IDENTITY },
            wrap: [
                wrap(sampler.and_then(|sampler| sampler.wrap_s)),
                wrap(sampler.and_then(|sampler| sampler.wrap_t)),
            ],
            nearest: sampler
                .and_then(|sampler| sampler.mag_filter)
                .is_some_and(|filter| NEAREST.contains(&filter.0)),
            ..Sampling::default()
        })
    }
}

/// Whether a map takes the second texture coordinates.
pub(super) fn take_second_tex_coords(materials: &[Material]) -> bool {
    let maps = materials
        .iter()
        .flat_map(|material| MapSlot::ALL.into_iter().filter_map(|slot| material.map(slot)));
    maps.into_iter().any(|map| map.sampling.second_tex_coords)
}

pub(super) fn have_normal_maps(materials: &[Material]) -> bool {
    materials.iter().any(Material::has_normal_map)
}

/// The material of a book that was written into `extras`, as far as it is there.
fn of_book(read: Material, values: &Value) -> Material {
    let number = |key: &str| {
        values
            .get(key)?
            .as_f64()
            .map(|number| number as f32)
            .filter(|number| number.is_finite())
    };
    let color = |key: &str| {
        let numbers = values.get(key)?.as_array()?;
        let [red, green, blue] = numbers.as_slice() else {
            return None;
        };
        let channel = |value: &Value| {
            value
                .as_f64()
                .map(|number| number as f32)
                .filter(|number| number.is_finite())
        };
        Some([channel(red)?, channel(green)?, channel(blue)?])
    };
    let reflectance = match values.get("reflectance").and_then(Value::as_str) {
        Some("fresnel") => (|| {
            Some(Reflectance::Fresnel {
                fresnel0: color("fresnel0")?,
                roughness: number("roughness")?,
            })
        })(),
        Some("phong") => (|| {
            Some(Reflectance::Phong {
                ambient: color("ambient")?,
                specular: color("specular")?,
                spec_power: number("specPower")?,
                reflectivity: color("reflectivity")?,
            })
        })(),
        _ => None,
    };
    let Some(reflectance) = reflectance else {
        return read;
    };
    let map = |key: &str, read: Option<MaterialMap>| match values.get(key) {
        Some(Value::String(name)) => Some(name.as_str().into()),
        Some(Value::Null) => None,
        _ => read,
    };
    let is_cut = values
        .get("alphaClip")
        .and_then(Value::as_bool)
        .unwrap_or(read.is_cut());
    Material {
        diffuse: color("diffuse").unwrap_or(read.diffuse),
        reflectance,
        alpha: if is_cut {
            AlphaMode::Mask {
                cutoff: Material::ALPHA_CLIP,
            }
        } else {
            AlphaMode::Opaque
        },
        double_sided: read.double_sided,
        diffuse_map: map("diffuseMap", read.diffuse_map),
        normal_map: map("normalMap", read.normal_map),
        name: read.name,
        ..Material::default()
    }
}
