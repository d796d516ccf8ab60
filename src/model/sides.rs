//! Which side of a triangle is its front: for one who stands before it, its corners run clockwise. Where one could see a back.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::{AlphaMode, Handedness, Influences, Material, Mesh, Model, Reflectance, Submesh};

impl Handedness {
    /// 1, or −1: cross(b − a, c − a) of a triangle's corners times this points to its front.
    pub fn front_sign(self) -> f64 {
        if self == Self::Left { 1.0 } else { -1.0 }
    }
}

impl Material {
    /// Whether its triangles face as they are wound: in glTF, and wherever one side alone is drawn. A book's material that is drawn from
    /// both sides leaves it to the normals.
    pub(crate) fn faces_as_wound(&self) -> bool {
        !self.double_sided || matches!(self.reflectance, Reflectance::MetallicRoughness { .. })
    }
}

impl Mesh {
    /// cross(b − a, c − a) of three vertices: twice the area of their triangle, along the side from which they run clockwise in a
    /// left-handed space. In f64, since the square of a large coordinate may not fit an f32.
    #[inline]
    pub(crate) fn side_of(&self, corners: [u32; 3]) -> DVec3 {
        let place = |corner: usize| self.positions[corners[corner] as usize].as_dvec3();
        (place(1) - place(0)).cross(place(2) - place(0))
    }

    /// More than 0 where that side is the one to which the normals of a triangle point, less where it is the other.
    pub(crate) fn side_by_normals(&self, corners: [u32; 3]) -> f64 {
        let normal = |corner: usize| self.normals.get(corners[corner] as usize).copied().unwrap_or_default();
        self.side_of(corners)
            .dot((normal(0) + normal(1) + normal(2)).as_dvec3())
    }

    pub(crate) fn turn_triangles(&mut self) {
        let (triangles, _) = self.indices.as_chunks_mut::<3>();
        triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }

    pub(crate) fn triangles_of(&self, submesh: &Submesh) -> &[[u32; 3]] {
        let (triangles, _) = self.indices.as_chunks();
        &triangles[submesh.triangle_start as usize..][..submesh.triangle_count as usize]
    }
}

impl Model {
    /// Of each submesh, whether it is wound against the model's hand: most of its triangles then face away from their normals. A file whose
    /// parts are wound in two ways is lit from the right side everywhere. False for what faces as it is wound: see
    /// [`Material::double_sided`].
    pub fn turned_submeshes(&self) -> Vec<bool> {
        let mesh = &self.mesh;
        // Submeshes may overlap as a file likes: sums up to each triangle give the votes of any range.
        let mut sums = vec![0_i64];
        for corners in mesh.indices.as_chunks().0 {
            let side = mesh.side_by_normals(*corners) * self.handedness.front_sign();
            sums.push(sums[sums.len() - 1] + i64::from(side > 0.0) - i64::from(side < 0.0));
        }
        let is_turned = |submesh: &Submesh| {
            let material = self.materials.get(submesh.material as usize);
            let (start, count) = (submesh.triangle_start as usize, submesh.triangle_count as usize);
            sums[start + count] < sums[start] && material.is_some_and(|material| !material.faces_as_wound())
        };
        mesh.submeshes.iter().map(is_turned).collect()
    }

    /// Of each material, whether it has to be drawn from both sides to look as it does. Not where a book's material shows no backs from
    /// outside: alpha lets nobody look inside, no edge is open, no triangle looks away from its normals, and fronts are outside. `turned`
    /// are the [`Model::turned_submeshes`], which will be turned round.
    pub fn needs_both_sides(&self, turned: &[bool]) -> Vec<bool> {
        let mut of_materials = vec![Vec::new(); self.materials.len()];
        // Where submeshes overlap nobody looks further.
        let counts = self
            .mesh
            .submeshes
            .iter()
            .map(|submesh| submesh.triangle_count as usize);
        let is_tangled = counts.sum::<usize>() > self.mesh.triangle_count();
        for (submesh, &is_turned) in self.mesh.submeshes.iter().zip(turned) {
            let index = submesh.material as usize;
            if !is_tangled && !self.materials[index].faces_as_wound() {
                let front = |&[a, b, c]: &[u32; 3]| if is_turned { [a, c, b] } else { [a, b, c] };
                of_materials[index].extend(self.mesh.triangles_of(submesh).iter().map(front));
            }
        }
        let needs = |(material, triangles): (&Material, Vec<[u32; 3]>)| {
            let is_sealed = || material.alpha == AlphaMode::Opaque && !is_tangled && !self.shows_backs(triangles);
            material.double_sided && (material.faces_as_wound() || !is_sealed())
        };
        self.materials.iter().zip(of_materials).map(needs).collect()
    }

    fn shows_backs(&self, mut triangles: Vec<[u32; 3]>) -> bool {
        let mesh = &self.mesh;
        let sign = self.handedness.front_sign();
        // Vertices in one place that move together are one point.
        let mut points = HashMap::new();
        let mut point = |vertex: u32| {
            let Influences { joints, weights } = mesh.influences.get(vertex as usize).copied().unwrap_or_default();
            let place = (mesh.positions[vertex as usize] + Vec3::ZERO)
                .to_array()
                .map(f32::to_bits);
            let next = points.len();
            *points.entry((place, joints, weights.map(f32::to_bits))).or_insert(next)
        };
        let mut edges: HashMap<[usize; 2], i64> = HashMap::new();
        let mut parts: Vec<usize> = Vec::new();
        triangles.retain(|&corners| {
            let [a, b, c] = corners.map(&mut point);
            parts.extend(parts.len()..=a.max(b).max(c));
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *edges.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
                let [one, other] = [from, to].map(|point| part_of(&mut parts, point));
                parts[one] = other;
            }
            a != b && b != c && c != a
        });
        let looks_away = |corners: &[u32; 3]| mesh.side_by_normals(*corners) * sign < 0.0;
        // What an edge has in one direction it has in the other, but for edges from a point to itself.
        let is_open = |(&[from, to], &sum): (&[usize; 2], &i64)| from != to && sum != 0;
        if triangles.iter().any(looks_away) || edges.iter().any(is_open) {
            return true;
        }
        let mut volumes: HashMap<usize, f64> = HashMap::new();
        let origin = mesh.positions.first().copied().unwrap_or_default().as_dvec3();
        for corners in &triangles {
            let from_origin = mesh.positions[corners[0] as usize].as_dvec3() - origin;
            let part = part_of(&mut parts, point(corners[0]));
            *volumes.entry(part).or_default() += mesh.side_of(*corners).dot(from_origin) * sign;
        }
        volumes.into_values().any(|volume| volume <= 0.0)
    }
}

/// The point that stands for all that are connected with one; on the way each is set nearer to it.
fn part_of(parts: &mut [usize], mut point: usize) -> usize {
    while parts[point] != point {
        parts[point] = parts[parts[point]];
        point = parts[point];
    }
    point
}
