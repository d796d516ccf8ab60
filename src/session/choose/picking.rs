//! The first triangle that a ray meets in the pose of now, without what is hidden or cut away, and without backs that are not drawn.
//!
//! It is done on the CPU, since that is exact on the pose and has no read-back to wait for.

use std::collections::BTreeMap;

use glam::{Affine3A, Vec2, Vec3};

use super::submeshes::Submeshes;
use crate::anim::{self, Palette};
use crate::image::Image;
use crate::model::{MapSlot, Material, Mesh, Wrap};
use crate::scene::{Hit, Ray, pick, value_at};
use crate::session::open::content::Content;
use crate::session::open::maps::Maps;

/// Buffers that are kept from pick to pick.
#[derive(Debug, Default)]
pub(in crate::session) struct Picker {
    /// The revision of the pose of the positions.
    posed: Option<u64>,
    positions: Vec<Vec3>,
    /// The same of another instance of the model than the selected one, as it was met last.
    of_other: Vec<Vec3>,
    palette: Palette,
    /// Instances whose boxes a ray comes into, with the distances.
    entered: Vec<(f32, usize)>,
    sides: Vec<u8>,
    cutouts: Cutouts,
}

impl Picker {
    /// The vertices as they were posed last, model space.
    pub(in crate::session) fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Brings the vertices to the pose of a revision, unless they are there already.
    pub(in crate::session) fn update(&mut self, mesh: &Mesh, palette: &Palette, pose_revision: u64) {
        if self.posed != Some(pose_revision) {
            anim::skin_positions(mesh, palette, &mut self.positions);
            self.posed = Some(pose_revision);
        }
    }

    /// Gets ready for picks of the model with these maps.
    pub(in crate::session) fn prepare(&mut self, content: &Content, maps_revision: u64) {
        let Content {
            open, maps, materials, ..
        } = content;
        self.cutouts.keep_of(maps_revision);
        // Before the search, which asks them in the midst of its triangles.
        for submesh in open.iter().flat_map(|open| &open.model.mesh.submeshes) {
            let material = submesh.material as usize;
            if materials.get(material).is_some_and(may_be_clear) {
                self.cutouts.decode(material, maps);
            }
        }
    }

    /// What a ray of the world meets first of the selected instance, as its vertices were posed last. Submeshes that are left out are
    /// looked through, and what alpha cuts away too.
    pub(in crate::session) fn pick(
        &mut self,
        content: &Content,
        submeshes: &Submeshes,
        world_from_model: Affine3A,
        ray: Ray,
    ) -> Option<Hit> {
        let positions = std::mem::take(&mut self.positions);
        let hit = self.pick_posed(&positions, content, submeshes, world_from_model, ray);
        self.positions = positions;
        hit
    }

    /// The same of another instance, which this palette poses.
    pub(in crate::session) fn pick_other(
        &mut self,
        content: &Content,
        submeshes: &Submeshes,
        (world_from_model, palette): (Affine3A, &[Affine3A]),
        ray: Ray,
    ) -> Option<Hit> {
        let mut positions = std::mem::take(&mut self.of_other);
        self.palette.0.clear();
        self.palette.0.extend_from_slice(palette);
        anim::skin_positions(&content.open.as_ref()?.model.mesh, &self.palette, &mut positions);
        let hit = self.pick_posed(&positions, content, submeshes, world_from_model, ray);
        self.of_other = positions;
        hit
    }

    /// A list for [`first_met`], empty; it comes back by [`Picker::keep_list`].
    pub(in crate::session) fn take_list(&mut self) -> Vec<(f32, usize)> {
        self.entered.clear();
        std::mem::take(&mut self.entered)
    }

    pub(in crate::session) fn keep_list(&mut self, entered: Vec<(f32, usize)>) {
        self.entered = entered;
    }

    fn pick_posed(
        &mut self,
        positions: &[Vec3],
        content: &Content,
        submeshes: &Submeshes,
        world_from_model: Affine3A,
        ray: Ray,
    ) -> Option<Hit> {
        let model = &content.open.as_ref()?.model;
        let (mesh, materials, cutouts) = (&model.mesh, &content.materials, &self.cutouts);
        let along = world_from_model.inverse().transform_vector3(ray.direction) * model.handedness.front_sign() as f32;
        let is_solid = |hit: &Hit| {
            let index = mesh.submeshes[hit.submesh].material as usize;
            let is_clear = |material: &Material| {
                may_be_clear(material) && cutouts.alpha(index, material, mesh, hit) < material.least_alpha()
            };
            let is_back = |corners: &[u32; 3]| {
                let [a, b, c] = corners.map(|vertex| positions[vertex as usize]);
                (b - a).cross(c - a).dot(along) > 0.0
            };
            let is_culled =
                |material: &Material| !material.double_sided && is_back(&mesh.indices.as_chunks().0[hit.triangle]);
            let is_seen = |material: &Material| !is_clear(material) && !is_culled(material);
            submeshes.is_visible(hit.submesh) && materials.get(index).is_none_or(is_seen)
        };
        pick(mesh, positions, world_from_model, ray, &mut self.sides, is_solid)
    }
}

/// Whether one may look through places of it.
fn may_be_clear(material: &Material) -> bool {
    material.least_alpha() > 0.0
}

/// The nearest of what a ray meets of some instances, with whose it is. `entered` has the distances at which it comes into their
/// boxes. `meet` is asked about the nearest box first, and no more when what was met is nearer than the next box.
pub fn first_met(entered: &mut [(f32, usize)], mut meet: impl FnMut(usize) -> Option<Hit>) -> Option<(usize, Hit)> {
    entered.sort_unstable_by(|(a, of_a), (b, of_b)| a.total_cmp(b).then(of_a.cmp(of_b)));
    let mut nearest: Option<(usize, Hit)> = None;
    for &(distance, instance) in entered.iter() {
        if nearest.is_some_and(|(_, nearest)| nearest.distance < distance) {
            break;
        }
        let met = meet(instance).filter(|hit| nearest.is_none_or(|(_, nearest)| hit.distance < nearest.distance));
        nearest = met.map(|hit| (instance, hit)).or(nearest);
    }
    nearest
}

/// Alpha of diffuse maps, by material.
#[derive(Debug, Default)]
struct Cutouts {
    maps_revision: u64,
    /// None where the map is not there or has no alpha.
    of_materials: BTreeMap<usize, Option<Alpha>>,
}

impl Cutouts {
    /// Forgets the alpha of other maps than these.
    fn keep_of(&mut self, maps_revision: u64) {
        if self.maps_revision != maps_revision {
            self.maps_revision = maps_revision;
            self.of_materials.clear();
        }
    }

    fn decode(&mut self, material: usize, maps: &Maps) {
        let alpha = || Alpha::of(maps.image(material, MapSlot::Diffuse)?);
        self.of_materials.entry(material).or_insert_with(alpha);
    }

    /// The alpha of a material at a hit: its own times those of the vertices and of its map.
    fn alpha(&self, index: usize, material: &Material, mesh: &Mesh, hit: &Hit) -> f32 {
        let of_vertices = if mesh.colors.is_empty() {
            1.0
        } else {
            value_at(mesh, &mesh.colors, hit).w
        };
        let of_map = self
            .of_materials
            .get(&index)
            .and_then(Option::as_ref)
            .map_or(1.0, |map| {
                let sampling = material
                    .map(MapSlot::Diffuse)
                    .map(|map| map.sampling)
                    .unwrap_or_default();
                let first = value_at(mesh, &mesh.tex_coords, hit);
                let second = value_at(mesh, &mesh.second_tex_coords, hit);
                map.nearest(sampling.tex_coords(first, second), sampling.wrap)
            });
        material.opacity * of_vertices * of_map
    }
}

/// Alpha of a picture's largest level, rows from the top.
#[derive(Debug)]
pub struct Alpha {
    width: usize,
    height: usize,
    texels: Vec<u8>,
}

impl Alpha {
    pub fn of(image: &Image) -> Option<Self> {
        if !image.has_alpha() {
            return None;
        }
        let rgba = image.to_rgba8(0, 0)?;
        Some(Self {
            width: image.width() as usize,
            height: image.height() as usize,
            texels: rgba.into_iter().skip(3).step_by(4).collect(),
        })
    }

    /// The texel at texture coordinates; 0…1.
    pub fn nearest(&self, tex_coord: Vec2, [along_u, along_v]: [Wrap; 2]) -> f32 {
        let index = |coordinate: f32, wrap, side: usize| {
            let inside = match wrap {
                Wrap::Repeat => coordinate - coordinate.floor(),
                Wrap::Mirror => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
                Wrap::Clamp => coordinate,
            };
            ((inside * side as f32) as usize).min(side - 1)
        };
        let column = index(tex_coord.x, along_u, self.width);
        let row = index(tex_coord.y, along_v, self.height);
        f32::from(self.texels[row * self.width + column]) / 255.0
    }
}
