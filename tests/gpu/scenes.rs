//! Small models made by hand, and how they are looked at.

use bindpose::anim::Palette;
use bindpose::model::{Material, Mesh, Model, Reflectance, Submesh};
use bindpose::scene::{Aabb, Background, Camera, FrameOptions, Projection, RenderFrame, Theme};
use glam::{Affine3A, Vec2, Vec3};

/// All that a frame needs.
pub struct Scene {
    pub model: Model,
    pub palette: Palette,
    pub world_from_model: Affine3A,
    pub world_bounds: Aabb,
    pub camera: Camera,
    pub options: FrameOptions,
}

impl Scene {
    /// A model as it stands, seen from its front, in the dark theme without a grid.
    pub fn of(model: Model) -> Self {
        let world_bounds = Aabb::from_points(model.mesh.positions.iter().copied());
        Self {
            palette: Palette::default(),
            world_from_model: Affine3A::IDENTITY,
            camera: Camera {
                target: world_bounds.center(),
                distance: 4.0 * world_bounds.radius().max(0.25),
                yaw_radians: 0.0,
                pitch_radians: 0.0,
                projection: Projection::Perspective { fov_y_radians: 0.6 },
            },
            options: FrameOptions {
                theme: Theme::Dark,
                background: Background::Backdrop,
                grid_visible: false,
            },
            world_bounds,
            model,
        }
    }

    /// From above and the right of the model's front, with the grid.
    pub fn three_quarter(mut self, theme: Theme) -> Self {
        self.camera.yaw_radians = -0.7;
        self.camera.pitch_radians = 0.3;
        self.options.theme = theme;
        self.options.grid_visible = true;
        self
    }

    /// The file's space is brought into the world by this.
    pub fn in_world(mut self, world_from_model: Affine3A) -> Self {
        self.world_from_model = world_from_model;
        self.world_bounds = self.world_bounds.transformed(world_from_model);
        self.camera.target = self.world_bounds.center();
        self
    }

    /// The same, this much larger.
    pub fn scaled(self, scale: f32) -> Self {
        let distance = self.camera.distance * scale;
        let mut scene = self.in_world(Affine3A::from_scale(Vec3::splat(scale)));
        scene.camera.distance = distance;
        scene
    }

    pub fn frame(&self) -> RenderFrame<'_> {
        RenderFrame {
            camera: self.camera,
            world_from_model: self.world_from_model,
            world_bounds: self.world_bounds,
            palette: &self.palette,
            options: self.options,
        }
    }
}

pub fn material(name: &str, diffuse: [f32; 3]) -> Material {
    Material {
        name: name.into(),
        diffuse,
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.04; 3],
            roughness: 0.7,
        },
        alpha_clip: false,
        diffuse_map: None,
        normal_map: None,
    }
}

pub const RED: [f32; 3] = [0.6, 0.05, 0.05];
pub const BLUE: [f32; 3] = [0.05, 0.1, 0.6];

/// Which way a flat thing faces along z, and how its triangles go.
#[derive(Clone, Copy)]
pub struct Facing {
    /// z of the normals, ±1.
    pub normal_z: f32,
    /// Clockwise for one who looks along +z in a left-handed space.
    pub clockwise: bool,
}

/// As the books have it: faces -z, clockwise from there.
pub const FRONT: Facing = Facing {
    normal_z: -1.0,
    clockwise: true,
};

/// An upright card on y = 0, 2 wide and high: blue where x < 0, red where x > 0.
pub fn card(facing: Facing) -> Model {
    let mut mesh = Mesh::default();
    for (left, right) in [(-1.0, 0.0), (0.0, 1.0)] {
        let first = mesh.positions.len() as u32;
        let corners = [(left, 0.0), (left, 2.0), (right, 2.0), (right, 0.0)];
        mesh.positions.extend(corners.map(|(x, y)| Vec3::new(x, y, 0.0)));
        let turns = if facing.clockwise {
            [0, 1, 2, 0, 2, 3]
        } else {
            [0, 2, 1, 0, 3, 2]
        };
        mesh.indices.extend(turns.map(|corner| first + corner));
    }
    mesh.normals = vec![Vec3::new(0.0, 0.0, facing.normal_z); 8];
    mesh.tangents = vec![Vec3::X.extend(1.0); 8];
    mesh.tex_coords = vec![Vec2::ZERO; 8];
    mesh.submeshes = (0..2)
        .map(|half| Submesh {
            triangle_start: half * 2,
            triangle_count: 2,
            material: half,
        })
        .collect();
    Model {
        materials: vec![material("blue", BLUE), material("red", RED)],
        mesh,
        ..Model::default()
    }
}
