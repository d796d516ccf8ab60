//! A still life: one of each thing that light can meet.

use std::sync::Arc;

use bindpose::image::Image;
use bindpose::model::{AlphaMode, MapSlot, Material, Mesh, Model, Reflectance, Submesh};
use bindpose::render::MaterialImages;
use glam::{Vec2, Vec3};

use crate::scenes::{Scene, material};
use crate::sets::{Plate, floor, plates};
use crate::textures::{directions, square};

/// Rings and sides of a ball.
const RINGS: u32 = 16;
const SIDES: u32 = 24;

/// A tray with a wall at its back, on it a smooth metal ball, a rough ball, and a ball of the DirectX 11 book's making; a fence
/// that alpha cuts in front.
pub(crate) fn still_life() -> Scene {
    let wall = Plate {
        corner: Vec3::new(-2.0, 0.0, 1.6),
        along_u: Vec3::X * 4.0,
        along_v: Vec3::Y * 1.4,
        normal: Vec3::NEG_Z,
    };
    let fence = Plate {
        corner: Vec3::new(-1.9, 0.75, -1.6),
        along_u: Vec3::X * 1.5,
        along_v: Vec3::NEG_Y * 0.75,
        normal: Vec3::NEG_Z,
    };
    let mut model: Model = plates(&[floor(2.0), wall, fence]);
    for (center, radius) in [
        (Vec3::new(-1.0, 0.7, 0.3), 0.7),
        (Vec3::new(0.45, 0.5, -0.5), 0.5),
        (Vec3::new(1.25, 0.6, 0.6), 0.6),
    ] {
        add_ball(&mut model.mesh, center, radius);
    }
    let with = |name, diffuse, fresnel0, roughness| Material {
        reflectance: Reflectance::Fresnel { fresnel0, roughness },
        ..material(name, diffuse)
    };
    model.materials = vec![
        with("tray", [0.5; 3], [0.04; 3], 0.6),
        with("wall", [0.35, 0.38, 0.42], [0.04; 3], 0.9),
        Material {
            alpha: AlphaMode::clipped(true),
            ..with("fence", [0.3, 0.32, 0.1], [0.04; 3], 0.5)
        },
        with("metal", [0.02; 3], [0.9, 0.7, 0.4], 0.15),
        with("clay", [0.55, 0.12, 0.08], [0.03; 3], 0.85),
        Material {
            reflectance: Reflectance::Phong {
                ambient: [0.1, 0.2, 0.5],
                specular: [0.8; 3],
                spec_power: 24.0,
                reflectivity: [0.15; 3],
            },
            ..material("varnish", [0.08, 0.16, 0.45])
        },
    ];
    let mut scene = Scene::of(model);
    scene.camera.yaw_radians = -0.45;
    scene.camera.pitch_radians = 0.32;
    scene.camera.target = Vec3::new(0.0, 0.5, 0.0);
    scene.camera.distance = 8.2;
    scene
}

/// Maps of the still life: a grid on the tray, holes in the fence, ripples on the clay.
pub(crate) struct StillLifeMaps {
    grid: Arc<Image>,
    holes: Arc<Image>,
    ripples: Arc<Image>,
}

impl StillLifeMaps {
    pub(crate) fn new() -> Self {
        let byte = |value: f32| (value * 127.5 + 127.5).round() as u8;
        Self {
            grid: square(64, |x, y| {
                let is_line = x % 16 == 0 || y % 16 == 0;
                if is_line {
                    [70, 74, 84, 255]
                } else {
                    [196, 200, 206, 255]
                }
            }),
            holes: square(32, |x, y| {
                let is_hole = x % 8 > 2 && y % 16 > 4;
                [230, 230, 230, if is_hole { 0 } else { 255 }]
            }),
            ripples: directions(64, |x, y| {
                let slope = |place: u32| 0.45 * (place as f32 / 64.0 * std::f32::consts::TAU * 4.0).sin();
                let normal = Vec3::new(slope(x), slope(y), 1.0).normalize();
                [byte(normal.x), byte(normal.y), byte(normal.z), 255]
            }),
        }
    }

    /// In the order of the still life's materials.
    pub(crate) fn images(&self) -> [MaterialImages<'_>; 6] {
        let mut images = [MaterialImages::default(); 6];
        images[0][MapSlot::Diffuse as usize] = Some(&self.grid);
        images[2][MapSlot::Diffuse as usize] = Some(&self.holes);
        images[4][MapSlot::Normal as usize] = Some(&self.ripples);
        images
    }
}

/// A submesh with the next material.
pub(crate) fn add_ball(mesh: &mut Mesh, center: Vec3, radius: f32) {
    add_ball_of(mesh, center, radius, [RINGS, SIDES]);
}

/// The same of so many rings and sides.
pub(crate) fn add_ball_of(mesh: &mut Mesh, center: Vec3, radius: f32, [rings, sides]: [u32; 2]) {
    let first = mesh.positions.len() as u32;
    for ring in 0..=rings {
        let v = ring as f32 / rings as f32;
        let (ring_radius, y) = (v * std::f32::consts::PI).sin_cos();
        for side in 0..=sides {
            let u = side as f32 / sides as f32;
            let (sin, cos) = (u * std::f32::consts::TAU).sin_cos();
            let normal = Vec3::new(cos * ring_radius, y, sin * ring_radius);
            mesh.positions.push(center + normal * radius);
            mesh.normals.push(normal);
            mesh.tangents.push(Vec3::new(-sin, 0.0, cos).extend(1.0));
            mesh.tex_coords.push(Vec2::new(u * 2.0, v));
        }
    }
    let triangle_start = mesh.indices.len() as u32 / 3;
    for ring in 0..rings {
        for side in 0..sides {
            let above = first + ring * (sides + 1) + side;
            let below = above + sides + 1;
            mesh.indices
                .extend([above, above + 1, below, below, above + 1, below + 1]);
        }
    }
    mesh.submeshes.push(Submesh {
        triangle_start,
        triangle_count: rings * sides * 2,
        material: mesh.submeshes.len() as u32,
    });
}
