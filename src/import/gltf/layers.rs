//! What glTF's extensions say of the layers of a material: index of refraction, specular, clear coat, sheen, transmission.

use super::materials::MaterialReader;
use crate::diagnostic::collect::Place;
use crate::diagnostic::{Subject, codes};
use crate::gltf::{self, Fault, TextureInfo};
use crate::model::{AlphaMode, Layers, MaterialMap};

/// The channels of a map that a value of a layer is in.
const COLOR: [bool; 4] = [true, true, true, false];
const ALPHA: [bool; 4] = [false, false, false, true];
const RED: [bool; 4] = [true, false, false, false];
const GREEN: [bool; 4] = [false, true, false, false];

impl MaterialReader<'_> {
    /// What the extensions say of how it reflects, with the maps of specular, clear coat, its normals and sheen.
    pub(super) fn layers(
        &mut self,
        extensions: &gltf::MaterialExtensions,
        alpha: AlphaMode,
        name: &str,
    ) -> Result<(Layers, [Option<MaterialMap>; 4]), Fault> {
        let mut layers = Layers::default();
        let mut maps = [const { None }; 4];
        let [specular_map, coat_map, coat_normal_map, sheen_map] = &mut maps;
        let mut left_out = Vec::new();
        let at = |extension: &str, key: &str| format!("extensions/KHR_materials_{extension}/{key}");
        let (unit, any) = ([0.0, 1.0], [0.0, f32::MAX]);
        if let Some(ior) = extensions.ior.as_ref().and_then(|of_file| of_file.ior) {
            layers.ior = if ior == 0.0 {
                ior
            } else {
                self.within(&at("ior", "ior"), ior, [1.0, f32::MAX])
            };
        }
        if let Some(specular) = &extensions.specular {
            let at = |key: &str| at("specular", key);
            let [factor, color] = [at("specularFactor"), at("specularColorFactor")];
            layers.specular = self.within(&factor, specular.specular_factor.unwrap_or(1.0), unit);
            let of_file = specular.specular_color_factor.unwrap_or([1.0; 3]);
            layers.specular_color = of_file.map(|channel| self.within(&color, channel, any));
            let parts = [
                (&specular.specular_color_texture, "specularColorTexture", COLOR),
                (&specular.specular_texture, "specularTexture", ALPHA),
            ];
            *specular_map = self.layer_map("specular", parts, &mut left_out)?;
        }
        if let Some(coat) = &extensions.clearcoat {
            let at = |key: &str| at("clearcoat", key);
            let [factor, roughness] = [at("clearcoatFactor"), at("clearcoatRoughnessFactor")];
            layers.clearcoat = self.within(&factor, coat.clearcoat_factor.unwrap_or_default(), unit);
            let of_file = coat.clearcoat_roughness_factor.unwrap_or_default();
            layers.clearcoat_roughness = self.within(&roughness, of_file, unit);
            let parts = [
                (&coat.clearcoat_texture, "clearcoatTexture", RED),
                (&coat.clearcoat_roughness_texture, "clearcoatRoughnessTexture", GREEN),
            ];
            *coat_map = self.layer_map("clearcoat", parts, &mut left_out)?;
            let normal = coat.clearcoat_normal_texture.as_ref();
            *coat_normal_map = self.map(normal.map(|normal| &normal.info), &at("clearcoatNormalTexture"))?;
            let scale = normal.and_then(|normal| normal.scale);
            layers.clearcoat_normal_scale = scale.filter(|scale| scale.is_finite()).unwrap_or(1.0);
        }
        if let Some(sheen) = &extensions.sheen {
            let at = |key: &str| at("sheen", key);
            let [color, roughness] = [at("sheenColorFactor"), at("sheenRoughnessFactor")];
            let of_file = sheen.sheen_color_factor.unwrap_or_default();
            layers.sheen_color = of_file.map(|channel| self.within(&color, channel, unit));
            let of_file = sheen.sheen_roughness_factor.unwrap_or_default();
            layers.sheen_roughness = self.within(&roughness, of_file, unit);
            let parts = [
                (&sheen.sheen_color_texture, "sheenColorTexture", COLOR),
                (&sheen.sheen_roughness_texture, "sheenRoughnessTexture", ALPHA),
            ];
            *sheen_map = self.layer_map("sheen", parts, &mut left_out)?;
            // A sheen whose colour cannot be read: its number is white.
            let has_color = sheen_map.as_ref().is_some_and(|map| map.sampling.channels[0]);
            if sheen.sheen_color_texture.is_some() && !has_color {
                layers.sheen_color = [0.0; 3];
            }
        }
        if let Some(transmission) = &extensions.transmission {
            layers.transmission = self.transmission(transmission, alpha, name);
            // Its number is 1 then, and what the map says to be whole would be glass.
            if transmission.transmission_texture.is_some() {
                layers.transmission = 0.0;
                left_out.push("transmissionTexture (and the transmission with it)");
            }
        }
        if !left_out.is_empty() {
            let message = format!("Maps of the material \"{name}\" are left out: {}.", left_out.join(", "));
            let place = Place::pointer(format!("/materials/{}/extensions", self.index));
            let place = place
                .about(Subject::Material(self.index as u32))
                .counting(left_out.len());
            self.diagnostics.add(&codes::GLTF_MAP_LEFT_OUT, place, message);
        }
        Ok((layers, maps))
    }

    /// The one map of a layer, which two textures name, each for channels of its own. Of two pictures the first is taken.
    fn layer_map(
        &mut self,
        extension: &str,
        parts: [(&Option<TextureInfo>, &'static str, [bool; 4]); 2],
        left_out: &mut Vec<&'static str>,
    ) -> Result<Option<MaterialMap>, Fault> {
        let mut taken: Option<MaterialMap> = None;
        for (info, key, channels) in parts {
            let at = format!("extensions/KHR_materials_{extension}/{key}");
            let Some(mut map) = self.map(info.as_ref(), &at)? else {
                continue;
            };
            let before = taken.as_ref().map_or([false; 4], |before| before.sampling.channels);
            map.sampling.channels = before;
            if taken.as_ref().is_some_and(|before| *before != map) {
                left_out.push(key);
                continue;
            }
            map.sampling.channels = std::array::from_fn(|channel| before[channel] || channels[channel]);
            taken = Some(map);
        }
        Ok(taken)
    }

    /// How much light goes through the surface, 0…1.
    fn transmission(&mut self, of_file: &gltf::Transmission, alpha: AlphaMode, name: &str) -> f32 {
        let key = "extensions/KHR_materials_transmission";
        let factor = of_file.transmission_factor.unwrap_or_default();
        let factor = self.within(&format!("{key}/transmissionFactor"), factor, [0.0, 1.0]);
        if factor > 0.0 && of_file.transmission_texture.is_none() {
            let drawn = match alpha {
                AlphaMode::Mask { .. } => "opaque, since alpha cuts it",
                AlphaMode::Opaque | AlphaMode::Blend => "blended, which neither bends nor tints what is behind it",
            };
            let message = format!("Light goes through the material \"{name}\"; it is drawn {drawn}.");
            let place = Place::pointer(format!("/materials/{}/{key}", self.index));
            let place = place.about(Subject::Material(self.index as u32));
            self.diagnostics.add(&codes::GLTF_TRANSMISSION, place, message);
        }
        factor
    }
}
