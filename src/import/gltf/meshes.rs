//! From primitives to one mesh: the vertices of all meshes of the scene in the file's order, and a submesh for each primitive.
//!
//! Primitives of one mesh that share their attributes share their vertices. A mesh on several nodes is read once and copied.
//!
//! Vertices stay in the file's order, so normals that are absent come out smooth, where glTF asks for flat ones.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, Vec2, Vec3, Vec4};

use super::influences::{self, Set, Weighted};
use super::nodes::Nodes;
use super::skeleton::{MeshUse, Rig};
use super::vertices::Vertices;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::gltf::{Fault, Primitive, Reader, Root, fault, out_of_range};
use crate::import::normals::{is_direction, mend_normals};
use crate::import::tangents::mend_tangents;
use crate::model::{Handedness, Influences, Mesh, Submesh, index_out_of_range};

/// What is kept of a mesh on each node: all streams of a vertex, three indices, and a submesh with its name.
const BYTES_PER_VERTEX: u64 = 104;
const BYTES_PER_TRIANGLE: u64 = 12;
const BYTES_PER_SUBMESH: u64 = 64;

const TRIANGLES: u64 = 4;
const TRIANGLE_STRIP: u64 = 5;
const TRIANGLE_FAN: u64 = 6;

/// What of the document a mesh is made of.
pub(super) struct Source<'a> {
    pub(super) root: &'a Root,
    pub(super) reader: &'a Reader<'a>,
    pub(super) nodes: &'a Nodes,
    pub(super) rig: &'a Rig,
    /// Whether a map of some material takes the second texture coordinates.
    pub(super) second_tex_coords: bool,
    /// Whether a material has a normal map, which asks for tangents.
    pub(super) normal_maps: bool,
}

impl<'a> Source<'a> {
    /// The joints of the slots of a primitive's skin, and what brings its vertices into bind space.
    fn skin_of(&self, mesh: &MeshUse, part: &Primitive) -> Option<(&'a [u32], DAffine3)> {
        let skin = self.rig.skins.get(mesh.skin?)?.as_ref()?;
        part.attributes
            .contains_key("JOINTS_0")
            .then_some((skin.joints.as_slice(), skin.bind_from_mesh))
    }
}

/// What is noted of all vertices together.
#[derive(Default)]
struct Noted {
    positions: Tally,
    tex_coords: Tally,
    normals: Tally,
    tangents: Tally,
    colors: Tally,
    weights: influences::Noted,
}

/// The vertices that primitives of a mesh share.
struct Shared<'a> {
    /// The first of these primitives, and where it is.
    part: &'a Primitive,
    pointer: String,
    plain: Vertices,
    /// The same with morph targets at the weights of the last node that had some.
    morphed: Option<(&'a [f32], Vertices)>,
    /// Joints and weights, where a skin asked for them.
    sets: Option<Vec<Set>>,
}

struct Part<'a> {
    of_file: &'a Primitive,
    pointer: String,
    mode: u64,
    material: u32,
    /// Which vertices it has among the mesh's.
    shared: usize,
    /// Its vertices in the order in which they make triangles.
    corners: Vec<u32>,
}

/// The mesh of a scene.
///
/// # Errors
/// When a primitive names what is not there, or numbers of the wrong kind.
pub(super) fn mesh(source: &Source<'_>, uses: &[MeshUse], diagnostics: &mut Diagnostics) -> Result<Mesh, Fault> {
    let mut builder = Builder {
        source,
        mesh: Mesh::default(),
        noted: Noted::default(),
        diagnostics,
    };
    // They are in the order of their meshes.
    for uses in uses.chunk_by(|a, b| a.mesh == b.mesh) {
        builder.add(uses)?;
    }
    builder.finish()
}

struct Builder<'a> {
    source: &'a Source<'a>,
    mesh: Mesh,
    noted: Noted,
    diagnostics: &'a mut Diagnostics,
}

impl<'a> Builder<'a> {
    /// Adds a mesh for each of its nodes.
    fn add(&mut self, uses: &[MeshUse]) -> Result<(), Fault> {
        let (mut shared, parts) = self.read(uses[0].mesh)?;
        let of_vertices = shared
            .iter()
            .map(|shared| BYTES_PER_VERTEX * shared.plain.positions.len() as u64);
        let of_triangles = parts
            .iter()
            .map(|part| BYTES_PER_SUBMESH + BYTES_PER_TRIANGLE * triangle_count(part) as u64);
        let once = of_vertices.chain(of_triangles).fold(0, u64::saturating_add);
        let at = format_args!("/meshes/{}", uses[0].mesh);
        self.source.reader.keep(once.saturating_mul(uses.len() as u64), at)?;
        for mesh in uses {
            let mut starts = vec![None; shared.len()];
            for part in &parts {
                let start = match starts[part.shared] {
                    Some(start) => start,
                    None => {
                        let start = self.mesh.vertex_count() as u32;
                        self.add_vertices(mesh, &mut shared[part.shared])?;
                        *starts[part.shared].insert(start)
                    }
                };
                let is_mirrored = self.placement(mesh, part.of_file).matrix3.determinant() < 0.0;
                self.add_triangles(part, start, is_mirrored)?;
            }
        }
        Ok(())
    }

    /// The primitives of a mesh that have triangles, and their vertices.
    fn read(&mut self, mesh: usize) -> Result<(Vec<Shared<'a>>, Vec<Part<'a>>), Fault> {
        let (mut shared, mut parts) = (Vec::new(), Vec::new());
        let mut with_attributes = HashMap::new();
        for (index, part) in self.source.root.meshes()[mesh].primitives.iter().enumerate() {
            let pointer = format!("/meshes/{mesh}/primitives/{index}");
            let mode = part.mode.map_or(TRIANGLES, |mode| mode.0);
            let what = match mode {
                TRIANGLES..=TRIANGLE_FAN if part.attributes.contains_key("POSITION") => None,
                TRIANGLES..=TRIANGLE_FAN => Some("has no positions"),
                0 => Some("is of points"),
                1..=3 => Some("is of lines"),
                _ => Some("is of a mode that glTF does not have"),
            };
            if let Some(what) = what {
                let message = format!("Primitive {index} of mesh {mesh} {what}; left out.");
                self.diagnostics
                    .add(&codes::GLTF_PRIMITIVE_LEFT_OUT, Place::pointer(pointer), message);
                continue;
            }
            let of_shared = *with_attributes
                .entry((&part.attributes, &part.targets))
                .or_insert(shared.len());
            if of_shared == shared.len() {
                let (reader, second) = (self.source.reader, self.source.second_tex_coords);
                shared.push(Shared {
                    part,
                    pointer: pointer.clone(),
                    plain: Vertices::read(reader, part, second, &pointer, self.diagnostics)?,
                    morphed: None,
                    sets: None,
                });
            }
            let material = self.material(part, &pointer)?;
            let corners = self.corners(part, mode, shared[of_shared].plain.positions.len(), &pointer)?;
            parts.push(Part {
                of_file: part,
                pointer,
                mode,
                material,
                shared: of_shared,
                corners,
            });
        }
        Ok((shared, parts))
    }

    /// What brings the vertices of a primitive into bind space.
    fn placement(&self, mesh: &MeshUse, part: &Primitive) -> DAffine3 {
        match self.source.skin_of(mesh, part) {
            Some((_, bind_from_mesh)) => bind_from_mesh,
            None => self.source.rig.on_node(mesh.node, self.source.nodes).1,
        }
    }

    fn add_vertices(&mut self, mesh: &MeshUse, shared: &mut Shared<'a>) -> Result<(), Fault> {
        let influences = self.influences(mesh, shared)?;
        let (part, pointer) = (shared.part, &*shared.pointer);
        let weights = self.morph_weights(mesh);
        let has_morphs = weights.iter().take(part.targets.len()).any(|&weight| weight != 0.0);
        let vertices = if has_morphs {
            let known = shared.morphed.take().filter(|(of, _)| *of == weights);
            let morph = || shared.plain.morphed(self.source.reader, part, weights, pointer);
            let vertices = known.map_or_else(morph, |(_, vertices)| Ok(vertices))?;
            &shared.morphed.insert((weights, vertices)).1
        } else {
            &shared.plain
        };
        let count = vertices.positions.len();
        let start = self.mesh.vertex_count();
        if start + count > u32::MAX as usize {
            return Err(fault(
                &codes::GLTF_TOO_LARGE,
                pointer,
                "There are more vertices than indices can name.",
            ));
        }
        let placement = self.placement(mesh, part);
        self.place(vertices, &placement);
        let mesh = &mut self.mesh;
        if mesh.influences.is_empty() {
            // Most files have one primitive, and need no copy.
            mesh.influences = influences;
        } else {
            mesh.influences.extend(influences);
        }
        self.add_tex_coords(vertices);
        // A stream that only some primitives have is filled up for the others.
        let mesh = &mut self.mesh;
        if !vertices.colors.is_empty() {
            mesh.colors.resize(start, Vec4::ONE);
            for (vertex, stored) in (start as u32..).zip(&vertices.colors) {
                let color = color(stored);
                if color.to_array() != *stored {
                    self.noted.colors.add(vertex);
                }
                mesh.colors.push(color);
            }
        } else if !mesh.colors.is_empty() {
            mesh.colors.resize(start + count, Vec4::ONE);
        }
        Ok(())
    }

    /// The weights that the morph targets of a mesh have outside of clips.
    fn morph_weights(&self, mesh: &MeshUse) -> &'a [f32] {
        let root = self.source.root;
        let of_node = root.nodes()[mesh.node as usize].weights.as_ref();
        let of_mesh = root.meshes()[mesh.mesh].weights.as_ref();
        of_node.or(of_mesh).map_or(&[][..], Vec::as_slice)
    }

    fn influences(&mut self, mesh: &MeshUse, shared: &mut Shared<'a>) -> Result<Vec<Influences>, Fault> {
        let source = self.source;
        let (part, pointer, count) = (shared.part, &*shared.pointer, shared.plain.positions.len());
        if let Some((joints, _)) = source.skin_of(mesh, part) {
            let sets = match shared.sets.take() {
                Some(sets) => sets,
                None => influences::sets(source.reader, part, count, pointer)?,
            };
            let weighted = Weighted {
                sets: shared.sets.insert(sets),
                joints,
                first_vertex: self.mesh.vertex_count() as u32,
                pointer,
            };
            return weighted.read(count, &mut self.noted.weights);
        }
        Ok(match source.rig.on_node(mesh.node, source.nodes).0 {
            None => Vec::new(),
            Some(joint) => {
                let influences = Influences {
                    joints: [joint, 0, 0, 0],
                    weights: [1.0, 0.0, 0.0, 0.0],
                };
                vec![influences; count]
            }
        })
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
                self.noted.positions.add(vertex);
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
                self.noted.normals.add(vertex);
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
                self.noted.tangents.add(vertex);
            }
            mesh.tangents.push(tangent.extend(if w < 0.0 { -sign } else { sign }));
        }
        debug_assert!(vertices.normals.is_empty() || vertices.normals.len() == count);
        mesh.normals.resize(end, Vec3::ZERO);
        if self.source.normal_maps || !mesh.tangents.is_empty() {
            mesh.tangents.resize(end, Vec4::ZERO);
        }
    }

    fn add_tex_coords(&mut self, vertices: &Vertices) {
        let mesh = &mut self.mesh;
        let end = mesh.positions.len();
        let noted = &mut self.noted.tex_coords;
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
        if self.source.second_tex_coords {
            add(&mut mesh.second_tex_coords, &vertices.second_tex_coords);
        }
    }

    fn material(&self, part: &Primitive, pointer: &str) -> Result<u32, Fault> {
        let count = self.source.root.materials().len();
        let material = match part.material {
            None => Some(count),
            Some(material) => usize::try_from(material.0).ok().filter(|&index| index < count),
        };
        let material = material.and_then(|material| u32::try_from(material).ok());
        material.ok_or_else(|| {
            let index = part.material.unwrap_or_default().0;
            out_of_range(&format!("{pointer}/material"), "material", index, count)
        })
    }

    fn add_triangles(&mut self, part: &Part<'_>, start: u32, is_mirrored: bool) -> Result<(), Fault> {
        let corners = &part.corners;
        let triangle_start = self.mesh.triangle_count();
        // Fronts run against the clock in glTF, and with it in a model.
        let wound = |[a, b, c]: [u32; 3]| {
            let corners = if is_mirrored { [a, b, c] } else { [a, c, b] };
            corners.map(|corner| start + corner)
        };
        // What joins two strips has no area.
        let has_area = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let indices = &mut self.mesh.indices;
        match part.mode {
            TRIANGLES => {
                let (triangles, _) = corners.as_chunks();
                indices.extend(triangles.iter().flat_map(|&triangle| wound(triangle)));
            }
            TRIANGLE_STRIP => {
                let triangles = corners.array_windows().enumerate();
                let triangles = triangles.map(|(index, &[a, b, c])| if index % 2 == 0 { [a, b, c] } else { [a, c, b] });
                indices.extend(triangles.filter(has_area).flat_map(wound));
            }
            _ => {
                let first = corners.first().copied().unwrap_or_default();
                let rest = corners.get(1..).unwrap_or_default();
                let triangles = rest.array_windows().map(|&[b, c]| [b, c, first]);
                indices.extend(triangles.filter(has_area).flat_map(wound));
            }
        }
        let triangle_count = self.mesh.triangle_count() - triangle_start;
        let number = |count: usize| {
            let message = "There are more triangles than numbers for them.";
            u32::try_from(count).map_err(|_| fault(&codes::GLTF_TOO_LARGE, &*part.pointer, message))
        };
        self.mesh.submeshes.push(Submesh {
            triangle_start: number(triangle_start)?,
            triangle_count: number(triangle_count)?,
            material: part.material,
        });
        Ok(())
    }

    /// The vertices of a primitive in the order in which they make triangles.
    fn corners(&mut self, part: &Primitive, mode: u64, vertex_count: usize, pointer: &str) -> Result<Vec<u32>, Fault> {
        let reader = self.source.reader;
        let corners = match part.indices {
            None => {
                reader.spend(vertex_count as u64, pointer)?;
                (0..vertex_count as u32).collect()
            }
            Some(indices) => {
                let pointer = format!("{pointer}/indices");
                let corners = reader.whole::<1>(indices, &pointer)?.into_flattened();
                if let Some(place) = index_out_of_range(&corners, vertex_count) {
                    let message = format!(
                        "Index {place} names vertex {}, but there are {vertex_count}.",
                        corners[place]
                    );
                    return Err(fault(&codes::VERTEX_OUT_OF_RANGE, pointer, message));
                }
                corners
            }
        };
        let left = corners.len() % 3;
        if mode == TRIANGLES && left > 0 {
            let message = format!(
                "{} at the end make no triangle; left out.",
                counted(left, "corner", "corners")
            );
            self.diagnostics
                .add(&codes::GLTF_RULE_BROKEN, Place::pointer(pointer), message);
        }
        Ok(corners)
    }

    fn finish(mut self) -> Result<Mesh, Fault> {
        let mesh = &mut self.mesh;
        if !mesh.colors.is_empty() {
            mesh.colors.resize(mesh.positions.len(), Vec4::ONE);
        }
        if mesh.colors.iter().all(|&color| color == Vec4::ONE) {
            mesh.colors = Vec::new();
        }
        let mut note = |code, tally: &Tally, rule: &str| {
            if tally.count > 0 {
                let have = counted(tally.count, "vertex has", "vertices have");
                self.diagnostics.add(
                    code,
                    Place::of_rows(tally, Subject::Vertex, &[]),
                    format!("{have} {rule}"),
                );
            }
        };
        note(
            &codes::VERTEX_NOT_FINITE,
            &self.noted.positions,
            "a position that is not finite; taken as 0.",
        );
        note(
            &codes::VERTEX_NOT_FINITE,
            &self.noted.tex_coords,
            "a texture coordinate that is not finite; taken as 0.",
        );
        note(
            &codes::GLTF_RULE_BROKEN,
            &self.noted.colors,
            "a colour with a number below 0, above 1 or not finite; clamped to 0…1.",
        );
        let rule = "a normal that is zero or not finite; computed from the triangles.";
        note(&codes::NORMALS_MISSING, &self.noted.normals, rule);
        let rule = "a tangent that is zero or not finite, or whose fourth number is not 1 or −1; mended.";
        note(&codes::TANGENTS_MISSING, &self.noted.tangents, rule);
        self.noted.weights.tell(self.diagnostics);
        // What is absent was noted for each primitive, or is no flaw.
        let mut quiet = Diagnostics::default();
        mesh.check()?;
        mend_normals(mesh, Handedness::Right, Vec::new, &mut quiet);
        if mesh.tangents.is_empty() {
            return Ok(self.mesh);
        }
        let computed = mesh.tangents.iter().map(|tangent| !is_direction(tangent.truncate()));
        let computed: Vec<bool> = computed.collect();
        mend_tangents(mesh, Vec::new, &mut quiet);
        // The green of glTF's normal maps points against v, and so do the bitangents of tangents that a file has.
        for (tangent, _) in mesh.tangents.iter_mut().zip(computed).filter(|(_, computed)| *computed) {
            tangent.w = -tangent.w;
        }
        Ok(self.mesh)
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

/// How many triangles a primitive has at most.
fn triangle_count(part: &Part<'_>) -> usize {
    match part.mode {
        TRIANGLES => part.corners.len() / 3,
        _ => part.corners.len().saturating_sub(2),
    }
}

fn color(stored: &[f32; 4]) -> Vec4 {
    let clamped = stored.map(|number| if number.is_nan() { 1.0 } else { number.clamp(0.0, 1.0) });
    Vec4::from_array(clamped)
}
