//! Scenes built of flat plates, where it is known what lies in shadow and what in a corner.

use bindpose::model::{Mesh, Model, Submesh};
use bindpose::scene::{Aabb, Light, Projection};
use glam::{Vec2, Vec3};

use crate::scenes::{Scene, material};

pub(crate) const SIZE: [u32; 2] = [160, 120];

/// A parallelogram with texture coordinates 0 … 1 along its sides.
pub(crate) struct Plate {
    pub(crate) corner: Vec3,
    pub(crate) along_u: Vec3,
    pub(crate) along_v: Vec3,
    pub(crate) normal: Vec3,
}

/// Each plate is a submesh with a material of its own, a matt grey.
pub(crate) fn plates(plates: &[Plate]) -> Model {
    let mut mesh = Mesh::default();
    for (index, plate) in (0..).zip(plates) {
        let &Plate {
            corner,
            along_u,
            along_v,
            normal,
        } = plate;
        let first = mesh.positions.len() as u32;
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            mesh.positions.push(corner + along_u * u + along_v * v);
            mesh.tex_coords.push(Vec2::new(u, v));
        }
        mesh.normals.extend([normal; 4]);
        mesh.tangents.extend([along_u.normalize().extend(1.0); 4]);
        let is_clockwise = along_u.cross(along_v).dot(normal) > 0.0;
        let turns = if is_clockwise {
            [0, 1, 2, 0, 2, 3]
        } else {
            [0, 2, 1, 0, 3, 2]
        };
        mesh.indices.extend(turns.map(|turn| first + turn));
        mesh.submeshes.push(Submesh {
            triangle_start: index * 2,
            triangle_count: 2,
            material: index,
        });
    }
    Model {
        materials: plates.iter().map(|_| material("plate", [0.4; 3])).collect(),
        mesh,
        ..Model::default()
    }
}

/// Lies on y = 0 round the origin.
pub(crate) fn floor(half_size: f32) -> Plate {
    Plate {
        corner: Vec3::new(-half_size, 0.0, -half_size),
        along_u: Vec3::X * 2.0 * half_size,
        along_v: Vec3::Z * 2.0 * half_size,
        normal: Vec3::Y,
    }
}

/// A floor 4 wide and, 1 above it, a plate 1 wide: submeshes 0 and 1. Seen from straight above, in parallel.
pub(crate) fn shelter() -> Scene {
    let lid = Plate {
        corner: Vec3::new(-0.5, 1.0, -0.5),
        along_u: Vec3::X,
        along_v: Vec3::Z,
        normal: Vec3::Y,
    };
    let mut scene = Scene::of(plates(&[floor(2.0), lid]));
    scene.camera.pitch_radians = std::f32::consts::FRAC_PI_2 - 1e-3;
    scene.camera.projection = Projection::Orthographic;
    scene
}

/// Where the middle of the shelter's lid throws its shadow, as it stands.
pub(crate) fn shadow_of_lid(light: Light) -> Vec3 {
    // Both lights stand above; the studio's beside the viewer, who looks along +z from here.
    let along = match light {
        Light::Studio => Vec3::new(-0.64, -0.74, 0.34) / 0.74,
        Light::Book => Vec3::new(1.0, -1.0, 1.0),
    };
    Vec3::Y + along
}

/// A block 2 wide that stands on the ground, seen from above in front.
pub(crate) fn block() -> Scene {
    let plate = |corner: [f32; 3], along_u, along_v, normal| Plate {
        corner: Vec3::from(corner),
        along_u,
        along_v,
        normal,
    };
    let (x, y, z) = (Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Z * 2.0);
    let mut scene = Scene::of(plates(&[
        plate([-1.0, 0.0, -1.0], x, z, Vec3::NEG_Y),
        plate([-1.0, 2.0, -1.0], x, z, Vec3::Y),
        plate([-1.0, 0.0, -1.0], x, y, Vec3::NEG_Z),
        plate([-1.0, 0.0, 1.0], x, y, Vec3::Z),
        plate([-1.0, 0.0, -1.0], z, y, Vec3::NEG_X),
        plate([1.0, 0.0, -1.0], z, y, Vec3::X),
    ]));
    scene.camera.pitch_radians = 0.6;
    scene
}

/// A floor 4 wide, a wall at its back and another at its right, 2 high: submeshes 0, 1, 2. Their corner is seen from above.
pub(crate) fn corner() -> Scene {
    let back = Plate {
        corner: Vec3::new(-2.0, 0.0, 2.0),
        along_u: Vec3::X * 4.0,
        along_v: Vec3::Y * 2.0,
        normal: Vec3::NEG_Z,
    };
    let right = Plate {
        corner: Vec3::new(2.0, 0.0, 2.0),
        along_u: Vec3::Z * -4.0,
        along_v: Vec3::Y * 2.0,
        normal: Vec3::NEG_X,
    };
    let mut scene = Scene::of(plates(&[floor(2.0), back, right]));
    scene.camera.yaw_radians = 0.4;
    scene.camera.pitch_radians = 0.6;
    scene.camera.target = Vec3::new(1.3, 0.4, 1.3);
    scene.camera.distance = 4.0;
    scene
}

/// Upright plates 1 wide that face the viewer, one behind and beside the other: near, between, far.
pub(crate) fn row() -> Scene {
    let upright = |x: f32, z: f32| Plate {
        corner: Vec3::new(x, 0.0, z),
        along_u: Vec3::X,
        along_v: Vec3::Y,
        normal: Vec3::NEG_Z,
    };
    let mut scene = Scene::of(plates(&[upright(-2.0, 0.0), upright(-0.5, 1.0), upright(1.0, 2.0)]));
    scene.camera.projection = Projection::Orthographic;
    scene
}

/// In [`corner`]: on the open floor, where floor and back wall meet, and where all three do.
pub(crate) const OPEN_EDGE_CORNER: [Vec3; 3] = [
    Vec3::new(0.6, 0.0, 0.6),
    Vec3::new(1.0, 0.04, 1.96),
    Vec3::new(1.96, 0.04, 1.96),
];

/// The middles of the plates of [`row`].
pub(crate) const ROW: [Vec3; 3] = [
    Vec3::new(-1.5, 0.5, 0.0),
    Vec3::new(0.0, 0.5, 1.0),
    Vec3::new(1.5, 0.5, 2.0),
];

/// A box in which nothing of the scene is.
pub(crate) const UNIT_BOX: Aabb = Aabb {
    min: Vec3::NEG_ONE,
    max: Vec3::ONE,
};
