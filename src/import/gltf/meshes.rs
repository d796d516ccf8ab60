//! From primitives to one mesh: the vertices of all meshes of the scene in the file's order, and a submesh for each primitive.
//!
//! Primitives of one mesh that share their attributes share their vertices. A mesh on several nodes is read once and copied.
//!
//! Vertices stay in the file's order, so normals that are absent come out smooth, where glTF asks for flat ones.

use std::collections::HashMap;

use super::influences::{self, Set, Weighted};
use super::vertices;
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place, counted};
use crate::gltf::{Fault, Primitive, Reader, Root, fault, out_of_range};
use crate::import::scene::{MeshBuilder, MeshUse, Rig, Scene, Vertices};
use crate::model::{Influences, Mesh, Object, index_out_of_range};
use crate::slices::{Slices, Stage};

/// What is kept of a mesh on each node: all streams of a vertex, three indices, and a submesh with its name.
const BYTES_PER_VERTEX: u64 = 104;
const BYTES_PER_TRIANGLE: u64 = 12;
const BYTES_PER_SUBMESH: u64 = 64;

const TRIANGLES: u64 = 4;
const TRIANGLE_STRIP: u64 = 5;
const TRIANGLE_FAN: u64 = 6;

/// What of the document a mesh is made of.
pub(super) struct Primitives<'a> {
    pub(super) root: &'a Root,
    pub(super) reader: &'a Reader<'a>,
    pub(super) scene: &'a Scene,
    pub(super) rig: &'a Rig,
    /// Whether a map of some material takes the second texture coordinates.
    pub(super) second_tex_coords: bool,
    /// Whether a material has a normal map, which asks for tangents.
    pub(super) normal_maps: bool,
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
    /// Its mesh, and its number there.
    place: [u32; 2],
    mode: u64,
    material: u32,
    /// Which vertices it has among the mesh's.
    shared: usize,
    /// Its vertices in the order in which they make triangles.
    corners: Vec<u32>,
}

/// The meshes of a scene as one.
pub(super) struct Meshed {
    pub(super) mesh: Mesh,
    pub(super) objects: Vec<(MeshUse, Object)>,
    /// Mesh and primitive of each submesh.
    pub(super) places: Vec<[u32; 2]>,
}

/// The mesh of a scene, and its objects.
///
/// # Errors
/// When a primitive names what is not there, or numbers of the wrong kind.
pub(super) async fn mesh(
    source: &Primitives<'_>,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<Meshed, Fault> {
    let mut meshes = Meshes {
        source,
        builder: MeshBuilder::new(source.normal_maps, source.second_tex_coords),
        places: Vec::new(),
        diagnostics,
    };
    // They are in the order of their meshes.
    for uses in source.scene.uses.chunk_by(|a, b| a.mesh == b.mesh) {
        meshes.add(uses, slices).await?;
    }
    let (builder, places) = (meshes.builder, meshes.places);
    Ok(Meshed {
        objects: builder.objects(source.scene),
        mesh: builder.finish(diagnostics, slices).await?,
        places,
    })
}

struct Meshes<'a> {
    source: &'a Primitives<'a>,
    builder: MeshBuilder,
    /// Of each submesh.
    places: Vec<[u32; 2]>,
    diagnostics: &'a mut Diagnostics,
}

/// Whether the skin of its mesh moves a primitive.
fn is_skinned(part: &Primitive) -> bool {
    part.attributes.contains_key("JOINTS_0")
}

impl<'a> Meshes<'a> {
    /// Adds a mesh for each of its nodes.
    async fn add(&mut self, uses: &[MeshUse], slices: &Slices) -> Result<(), Fault> {
        slices
            .pause_at(Stage::Building, uses[0].mesh, self.source.root.meshes().len())
            .await;
        let (mut shared, parts) = self.read(uses[0].mesh)?;
        let of_vertices = shared
            .iter()
            .map(|shared| BYTES_PER_VERTEX * shared.plain.positions.len() as u64);
        let of_triangles = parts
            .iter()
            .map(|part| BYTES_PER_SUBMESH + BYTES_PER_TRIANGLE * triangle_count(part) as u64);
        let tag = self.source.scene.meshes[uses[0].mesh].len() as u64;
        let once = of_vertices.chain(of_triangles).fold(tag, u64::saturating_add);
        let at = format_args!("/meshes/{}", uses[0].mesh);
        self.source.reader.keep(once.saturating_mul(uses.len() as u64), at)?;
        for mesh in uses {
            let mut starts = vec![None; shared.len()];
            for part in &parts {
                slices.pause().await;
                let start = match starts[part.shared] {
                    Some(start) => start,
                    None => {
                        let start = self.builder.vertex_count() as u32;
                        self.add_vertices(mesh, &mut shared[part.shared])?;
                        *starts[part.shared].insert(start)
                    }
                };
                let placement = self.source.rig.placement(mesh, is_skinned(part.of_file));
                let is_mirrored = placement.matrix3.determinant() < 0.0;
                self.add_triangles(part, start, is_mirrored)?;
                self.places.push(part.place);
            }
            self.builder.end_object(*mesh);
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
                    plain: vertices::read(reader, part, second, &pointer, self.diagnostics)?,
                    morphed: None,
                    sets: None,
                });
            }
            let material = self.material(part, &pointer)?;
            let corners = self.corners(part, mode, shared[of_shared].plain.positions.len(), &pointer)?;
            parts.push(Part {
                of_file: part,
                pointer,
                place: [mesh as u32, index as u32],
                mode,
                material,
                shared: of_shared,
                corners,
            });
        }
        Ok((shared, parts))
    }

    fn add_vertices(&mut self, mesh: &MeshUse, shared: &mut Shared<'a>) -> Result<(), Fault> {
        let influences = self.influences(mesh, shared)?;
        let (part, pointer) = (shared.part, &*shared.pointer);
        let weights = self.morph_weights(mesh);
        let has_morphs = weights.iter().take(part.targets.len()).any(|&weight| weight != 0.0);
        let vertices = if has_morphs {
            let known = shared.morphed.take().filter(|(of, _)| *of == weights);
            let morph = || vertices::morphed(&shared.plain, self.source.reader, part, weights, pointer);
            let vertices = known.map_or_else(morph, |(_, vertices)| Ok(vertices))?;
            &shared.morphed.insert((weights, vertices)).1
        } else {
            &shared.plain
        };
        let placement = self.source.rig.placement(mesh, is_skinned(part));
        let message = "There are more vertices than indices can name.";
        let too_many = || fault(&codes::GLTF_TOO_LARGE, pointer, message);
        self.builder.add_vertices(vertices, influences, &placement, too_many)
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
        if let Some(joints) = source.rig.slots(mesh, is_skinned(part)) {
            let sets = match shared.sets.take() {
                Some(sets) => sets,
                None => influences::sets(source.reader, part, count, pointer)?,
            };
            let weighted = Weighted {
                sets: shared.sets.insert(sets),
                joints,
                first_vertex: self.builder.vertex_count() as u32,
                pointer,
            };
            return weighted.read(count, &mut self.builder.weights);
        }
        let influences = source.rig.influences_on(mesh.node);
        Ok(influences.map_or_else(Vec::new, |influences| vec![influences; count]))
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
        let (builder, corners) = (&mut self.builder, &part.corners);
        let place = (start, is_mirrored);
        let message = "There are more triangles than numbers for them.";
        let too_many = || fault(&codes::GLTF_TOO_LARGE, &*part.pointer, message);
        // What joins two strips has no area.
        let has_area = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        match part.mode {
            TRIANGLES => {
                let triangles = corners.as_chunks().0.iter().copied();
                builder.add_triangles(triangles, place, part.material, too_many)
            }
            TRIANGLE_STRIP => {
                let triangles = corners.array_windows().enumerate();
                let triangles = triangles.map(|(index, &[a, b, c])| if index % 2 == 0 { [a, b, c] } else { [a, c, b] });
                builder.add_triangles(triangles.filter(has_area), place, part.material, too_many)
            }
            _ => {
                let first = corners.first().copied().unwrap_or_default();
                let rest = corners.get(1..).unwrap_or_default();
                let triangles = rest.array_windows().map(|&[b, c]| [b, c, first]);
                builder.add_triangles(triangles.filter(has_area), place, part.material, too_many)
            }
        }
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
}

/// How many triangles a primitive has at most.
fn triangle_count(part: &Part<'_>) -> usize {
    match part.mode {
        TRIANGLES => part.corners.len() / 3,
        _ => part.corners.len().saturating_sub(2),
    }
}
