//! One mesh of all uses of meshes, in bind space: vertices where their skin or node has them, mended, in the order in which they come.

use std::ops::Range;
use std::sync::Arc;

use glam::{DAffine3, DMat3, Vec2, Vec3, Vec4};

use super::{MeshUse, Scene};
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Code, Fault, Subject, codes};
use crate::import::normals::{is_direction, make_normals_unit, mend_normals};
use crate::import::tangents::mend_tangents;
use crate::import::weights;
use crate::model::{Handedness, Influences, Mesh, Object, Submesh};
use crate::slices::Slices;

/// Attributes of the vertices of a part of a mesh. Those that are absent are empty; all others have one length.
#[derive(Clone, Default)]
pub(in crate::import) struct Vertices {
    pub(in crate::import) positions: Vec<[f32; 3]>,
    pub(in crate::import) normals: Vec<[f32; 3]>,
    pub(in crate::import) tangents: Vec<[f32; 4]>,
    pub(in crate::import) tex_coords: Vec<[f32; 2]>,
    pub(in crate::import) second_tex_coords: Vec<[f32; 2]>,
    pub(in crate::import) colors: Vec<[f32; 4]>,
}

/// A mesh while parts are added to it, and what is noted of all vertices together.
#[derive(Default)]
pub(in crate::import) struct MeshBuilder {
    mesh: Mesh,
    objects: Vec<(MeshUse, Range<usize>)>,
    /// Whether a material has a normal map, which asks for tangents.
    normal_maps: bool,
    /// Whether a map of some material takes the second texture coordinates.
    second_tex_coords: bool,
    pub(in crate::import) weights: weights::Noted,
    positions: Tally,
    tex_coords: Tally,
    normals: Tally,
    tangents: Tally,
    colors: Tally,
}

impl MeshBuilder {
    pub(in crate::import) fn new(normal_maps: bool, second_tex_coords: bool) -> Self {
        Self {
            normal_maps,
            second_tex_coords,
            ..Self::default()
        }
    }

    pub(in crate::import) fn vertex_count(&self) -> usize {
        self.mesh.vertex_count()
    }

    /// Says of which use all submeshes are that were added since the last call.
    pub(in crate::import) fn end_object(&mut self, of: MeshUse) {
        let start = self.objects.last().map_or(0, |(_, submeshes)| submeshes.end);
        let submeshes = start..self.mesh.submeshes.len();
        if !submeshes.is_empty() {
            self.objects.push((of, submeshes));
        }
    }

    /// Adds vertices, brought into bind space; `influences` are none in a model without joints. What is absent is 0.
    ///
    /// # Errors
    /// `too_many` when no index could name the last of them.
    pub(in crate::import) fn add_vertices(
        &mut self,
        vertices: &Vertices,
        influences: Vec<Influences>,
        bind_from_mesh: &DAffine3,
        too_many: impl FnOnce() -> Fault,
    ) -> Result<(), Fault> {
        let count = vertices.positions.len();
        let start = self.vertex_count();
        if start + count > u32::MAX as usize {
            return Err(too_many());
        }
        self.place(vertices, bind_from_mesh);
        let mesh = &mut self.mesh;
        if mesh.influences.is_empty() {
            // Most files have one part, and need no copy.
            mesh.influences = influences;
        } else {
            mesh.influences.extend(influences);
        }
        self.add_tex_coords(vertices);
        // A stream that only some parts have is filled up for the others.
        let mesh = &mut self.mesh;
        if !vertices.colors.is_empty() {
            mesh.colors.resize(start, Vec4::ONE);
            for (vertex, stored) in (start as u32..).zip(&vertices.colors) {
                let color = color(stored);
                if color.to_array() != *stored {
                    self.colors.add(vertex);
                }
                mesh.colors.push(color);
            }
        } else if !mesh.colors.is_empty() {
            mesh.colors.resize(start + count, Vec4::ONE);
        }
        Ok(())
    }

    /// Adds positions, normals and tangents, brought into bind space. Absent ones are 0.
    fn place(&mut self, vertices: &Vertices, bind_from_mesh: &DAffine3) {
        let count = vertices.positions.len();
        let stays = *bind_from_mesh == DAffine3::IDENTITY;
        let mesh = &mut self.mesh;
        let normal_from_normal = normal_matrix(bind_from_mesh);
        let sign = bind_from_mesh.matrix3.determinant().signum() as f32;
        mesh.positions.reserve(count);
        mesh.normals.reserve(count);
        for (vertex, &position) in (mesh.positions.len() as u32..).zip(&vertices.positions) {
            let stored = Vec3::from_array(position);
            let placed = if stays {
                stored
            } else {
                bind_from_mesh.transform_point3(stored.as_dvec3()).as_vec3()
            };
            let is_sound = placed.is_finite();
            if !is_sound {
                self.positions.add(vertex);
            }
            mesh.positions.push(if is_sound { placed } else { Vec3::ZERO });
        }
        let direction = |stored: Vec3, by: &DMat3| match (by * stored.as_dvec3()).try_normalize() {
            _ if stays => stored,
            Some(direction) if is_direction(stored) => direction.as_vec3(),
            _ => Vec3::ZERO,
        };
        for (vertex, &normal) in (mesh.normals.len() as u32..).zip(&vertices.normals) {
            let normal = direction(Vec3::from_array(normal), &normal_from_normal);
            if !is_direction(normal) {
                self.normals.add(vertex);
            }
            mesh.normals.push(normal);
        }
        let end = mesh.positions.len();
        if !vertices.tangents.is_empty() {
            mesh.tangents.reserve(end - mesh.tangents.len());
            mesh.tangents.resize(end - count, Vec4::ZERO);
        }
        for (vertex, &[x, y, z, w]) in (mesh.tangents.len() as u32..).zip(&vertices.tangents) {
            let tangent = direction(Vec3::new(x, y, z), &bind_from_mesh.matrix3);
            if !is_direction(tangent) || w.abs() != 1.0 {
                self.tangents.add(vertex);
            }
            mesh.tangents.push(tangent.extend(if w < 0.0 { -sign } else { sign }));
        }
        debug_assert!(vertices.normals.is_empty() || vertices.normals.len() == count);
        mesh.normals.resize(end, Vec3::ZERO);
        if self.normal_maps || !mesh.tangents.is_empty() {
            mesh.tangents.resize(end, Vec4::ZERO);
        }
    }

    fn add_tex_coords(&mut self, vertices: &Vertices) {
        let mesh = &mut self.mesh;
        let end = mesh.positions.len();
        let noted = &mut self.tex_coords;
        let mut add = |to: &mut Vec<Vec2>, from: &[[f32; 2]]| {
            for &stored in from {
                let stored = Vec2::from_array(stored);
                if !stored.is_finite() {
                    noted.add(to.len() as u32);
                }
                to.push(if stored.is_finite() { stored } else { Vec2::ZERO });
            }
            to.resize(end, Vec2::ZERO);
        };
        add(&mut mesh.tex_coords, &vertices.tex_coords);
        if self.second_tex_coords {
            add(&mut mesh.second_tex_coords, &vertices.second_tex_coords);
        }
    }

    /// Adds a submesh of triangles whose fronts run against the clock; theirs is the vertex `start` and those behind it.
    ///
    /// # Errors
    /// `too_many` when no number could name the last of them.
    pub(in crate::import) fn add_triangles(
        &mut self,
        triangles: impl Iterator<Item = [u32; 3]>,
        (start, is_mirrored): (u32, bool),
        material: u32,
        too_many: impl Fn() -> Fault,
    ) -> Result<(), Fault> {
        let triangle_start = self.mesh.triangle_count();
        // In a model they run with the clock.
        let wound = |[a, b, c]: [u32; 3]| {
            let corners = if is_mirrored { [a, b, c] } else { [a, c, b] };
            corners.map(|corner| start + corner)
        };
        self.mesh.indices.extend(triangles.flat_map(wound));
        let triangle_count = self.mesh.triangle_count() - triangle_start;
        let number = |count: usize| u32::try_from(count).map_err(|_| too_many());
        self.mesh.submeshes.push(Submesh {
            triangle_start: number(triangle_start)?,
            triangle_count: number(triangle_count)?,
            material,
        });
        Ok(())
    }

    /// The objects that were added.
    pub(in crate::import) fn objects(&self, scene: &Scene) -> Vec<(MeshUse, Object)> {
        let object = |of: MeshUse, submeshes: &Range<usize>| Object {
            node: scene.nodes[of.node as usize].tag.clone(),
            mesh: Arc::clone(&scene.meshes[of.mesh]),
            submeshes: submeshes.clone(),
        };
        let objects = self.objects.iter();
        objects.map(|(of, submeshes)| (*of, object(*of, submeshes))).collect()
    }

    /// The mesh, with what is absent computed. What was mended is told.
    ///
    /// # Errors
    /// When its parts do not fit each other.
    pub(in crate::import) async fn finish(self, diagnostics: &mut Diagnostics, slices: &Slices) -> Result<Mesh, Fault> {
        let mut mesh = self.mesh;
        if !mesh.colors.is_empty() {
            mesh.colors.resize(mesh.positions.len(), Vec4::ONE);
        }
        if mesh.colors.iter().all(|&color| color == Vec4::ONE) {
            mesh.colors = Vec::new();
        }
        let mut note = |code: &Code, tally: &Tally, rule: &str| {
            if tally.count > 0 {
                let have = counted(tally.count, "vertex has", "vertices have");
                let place = Place::of_rows(tally, Subject::Vertex, &[]);
                diagnostics.add(code, place, format!("{have} {rule}"));
            }
        };
        let rule = "a position that is not finite; taken as 0.";
        note(&codes::VERTEX_NOT_FINITE, &self.positions, rule);
        let rule = "a texture coordinate that is not finite; taken as 0.";
        note(&codes::VERTEX_NOT_FINITE, &self.tex_coords, rule);
        let rule = "a colour with a number below 0, above 1 or not finite; clamped to 0…1.";
        note(&codes::GLTF_RULE_BROKEN, &self.colors, rule);
        let rule = "a normal that is zero or not finite; computed from the triangles.";
        note(&codes::NORMALS_MISSING, &self.normals, rule);
        let rule = "a tangent that is zero or not finite, or whose fourth number is not 1 or −1; mended.";
        note(&codes::TANGENTS_MISSING, &self.tangents, rule);
        self.weights.tell(diagnostics);
        // What is absent was noted for each part, or is no flaw.
        let mut quiet = Diagnostics::default();
        mesh.check()?;
        let missing = make_normals_unit(&mut mesh, slices).await;
        mend_normals(&mut mesh, &missing, Handedness::Right, Vec::new, &mut quiet);
        if mesh.tangents.is_empty() {
            return Ok(mesh);
        }
        let computed = mesh.tangents.iter().map(|tangent| !is_direction(tangent.truncate()));
        let computed: Vec<bool> = computed.collect();
        mend_tangents(&mut mesh, Vec::new, &mut quiet, slices).await;
        // The green of normal maps points against v there, and so do the bitangents of tangents that a file has.
        for (tangent, _) in mesh.tangents.iter_mut().zip(computed).filter(|(_, computed)| *computed) {
            tangent.w = -tangent.w;
        }
        Ok(mesh)
    }
}

/// Keeps normals square to their surface.
fn normal_matrix(bind_from_mesh: &DAffine3) -> DMat3 {
    // The cofactors: the inverse transpose times the determinant, which a flat transform has too.
    let DMat3 { x_axis, y_axis, z_axis } = bind_from_mesh.matrix3;
    let sign = bind_from_mesh.matrix3.determinant().signum();
    DMat3::from_cols(
        y_axis.cross(z_axis) * sign,
        z_axis.cross(x_axis) * sign,
        x_axis.cross(y_axis) * sign,
    )
}

fn color(stored: &[f32; 4]) -> Vec4 {
    let clamped = stored.map(|number| if number.is_nan() { 1.0 } else { number.clamp(0.0, 1.0) });
    Vec4::from_array(clamped)
}
