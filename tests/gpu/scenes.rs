//! Small models made by hand, and how they are looked at.

use bindpose::anim::Palette;
use bindpose::model::{Influences, JointIndex, Material, Mesh, Model, Reflectance, Skeleton, Submesh};
use bindpose::scene::{
    Aabb, Camera, Crowd, CrowdInstance, FrameOptions, Ghosts, Ground, Overlay, OverlayGeometry, Overlays, Projection,
    RenderFrame, Theme, VertexColors,
};
use glam::{Affine3A, Quat, Vec2, Vec3};

/// Of as many ghosts as a scene has.
pub(crate) const GHOST_SRGB: [[u8; 4]; 2] = [[255, 0, 0, 255], [0, 255, 0, 255]];

/// All that a frame needs.
pub(crate) struct Scene {
    pub(crate) model: Model,
    pub(crate) palette: Palette,
    pub(crate) world_from_model: Affine3A,
    pub(crate) world_bounds: Aabb,
    pub(crate) camera: Camera,
    pub(crate) options: FrameOptions,
    pub(crate) hidden: Vec<bool>,
    pub(crate) highlighted: Option<usize>,
    /// Colours of vertices, none for the view mode's.
    pub(crate) colors_srgb: Vec<[u8; 4]>,
    pub(crate) ghosts: Vec<Palette>,
    pub(crate) crowd: Vec<CrowdInstance>,
    /// How many of the crowd may be seen; the others come after them.
    pub(crate) in_sight: usize,
    /// One palette after another.
    pub(crate) crowd_palettes: Vec<Affine3A>,
    pub(crate) seen_through: OverlayGeometry,
}

impl Scene {
    /// A model as it stands, seen from its front, in the dark theme without a grid.
    pub(crate) fn of(model: Model) -> Self {
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
                overlays: Overlays::none(),
                ..FrameOptions::default()
            },
            world_bounds,
            model,
            hidden: Vec::new(),
            highlighted: None,
            colors_srgb: Vec::new(),
            ghosts: Vec::new(),
            crowd: Vec::new(),
            in_sight: 0,
            crowd_palettes: Vec::new(),
            seen_through: OverlayGeometry::default(),
        }
    }

    /// From above and the right of the model's front, with the grid.
    pub(crate) fn three_quarter(mut self, theme: Theme) -> Self {
        self.camera.yaw_radians = -0.7;
        self.camera.pitch_radians = 0.3;
        self.options.theme = theme;
        self.options.overlays.set(Overlay::Grid, true);
        self
    }

    /// The file's space is brought into the world by this.
    pub(crate) fn in_world(mut self, world_from_model: Affine3A) -> Self {
        self.world_from_model = world_from_model;
        self.world_bounds = self.world_bounds.transformed(world_from_model);
        self.camera.target = self.world_bounds.center();
        self
    }

    /// The same, this much larger.
    pub(crate) fn scaled(self, scale: f32) -> Self {
        let distance = self.camera.distance * scale;
        let mut scene = self.in_world(Affine3A::from_scale(Vec3::splat(scale)));
        scene.camera.distance = distance;
        scene
    }

    /// Adds an instance in sight, in a pose of its own.
    pub(crate) fn add_to_crowd(&mut self, world_from_model: Affine3A, palette: &Palette) {
        let joints = self.palette.0.len().max(1);
        self.crowd.push(CrowdInstance {
            world_from_model,
            palette: (self.crowd_palettes.len() / joints) as u32,
        });
        self.crowd_palettes.extend(&palette.0);
        self.in_sight = self.crowd.len();
    }

    pub(crate) fn frame(&self) -> RenderFrame<'_> {
        RenderFrame {
            camera: self.camera,
            world_from_model: self.world_from_model,
            world_bounds: self.world_bounds,
            ground: Ground::under(&self.world_bounds, &mut []),
            mesh: Some(&self.model.mesh),
            palette: &self.palette,
            crowd: Crowd {
                instances: &self.crowd,
                in_sight: self.in_sight,
                palettes: &self.crowd_palettes,
            },
            hidden_submeshes: &self.hidden,
            highlighted_submesh: self.highlighted,
            vertex_colors: (!self.colors_srgb.is_empty()).then_some(VertexColors {
                colors_srgb: &self.colors_srgb,
                revision: self
                    .colors_srgb
                    .iter()
                    .flatten()
                    .map(|&channel| u64::from(channel))
                    .sum(),
            }),
            ghosts: Ghosts {
                palettes: &self.ghosts,
                colors_srgb: &GHOST_SRGB[..self.ghosts.len()],
            },
            seen_through: Some(&self.seen_through),
            sample: None,
            options: self.options,
        }
    }

    /// The pixel in which a point of the world lies in a picture of this size.
    pub(crate) fn pixel_of(&self, world: Vec3, [width, height]: [u32; 2]) -> [u32; 2] {
        let aspect = width as f32 / height as f32;
        let clip_from_world = self.camera.clip_from_view(aspect, &self.world_bounds) * self.camera.view_from_world();
        let ndc = clip_from_world.project_point3(world);
        assert!(ndc.x.abs() < 1.0 && ndc.y.abs() < 1.0, "{world} is out of view");
        [(ndc.x + 1.0) * width as f32, (1.0 - ndc.y) * height as f32].map(|place| (place * 0.5) as u32)
    }
}

/// Of a diffuse colour that is linear; the books write it sRGB-encoded (IEC 61966-2-1).
pub(crate) fn material(name: &str, diffuse: [f32; 3]) -> Material {
    let encoded = |linear: f32| match linear {
        0.0..=0.003_130_8 => linear * 12.92,
        _ => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
    };
    Material {
        name: name.into(),
        diffuse: diffuse.map(encoded),
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.04; 3],
            roughness: 0.7,
        },
        ..Material::default()
    }
}

pub(crate) const RED: [f32; 3] = [0.6, 0.05, 0.05];
pub(crate) const BLUE: [f32; 3] = [0.05, 0.1, 0.6];

/// Which way a flat thing faces along z, and how its triangles go.
#[derive(Clone, Copy)]
pub(crate) struct Facing {
    /// z of the normals, ±1.
    pub(crate) normal_z: f32,
    /// Clockwise for one who looks along +z in a left-handed space.
    pub(crate) clockwise: bool,
}

/// As the books have it: faces -z, clockwise from there.
pub(crate) const FRONT: Facing = Facing {
    normal_z: -1.0,
    clockwise: true,
};

/// An upright card on y = 0, 2 wide and high: blue where x < 0, red where x > 0.
pub(crate) fn card(facing: Facing) -> Model {
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

/// Sides and rings of the tube.
const SIDES: u32 = 24;
const RINGS: u32 = 20;
const TUBE_HEIGHT: f32 = 4.0;
const TUBE_RADIUS: f32 = 0.5;

/// An upright tube on y = 0 of two materials, its upper half bent by a second joint at half height. Weights change over a
/// quarter of the height. Open at both ends.
pub(crate) fn tube() -> Model {
    let mut mesh = Mesh::default();
    for ring in 0..=RINGS {
        let share = ring as f32 / RINGS as f32;
        let upper = ((share - 0.375) / 0.25).clamp(0.0, 1.0);
        for side in 0..SIDES {
            let (sin, cos) = (side as f32 / SIDES as f32 * std::f32::consts::TAU).sin_cos();
            mesh.positions
                .push(Vec3::new(cos * TUBE_RADIUS, share * TUBE_HEIGHT, sin * TUBE_RADIUS));
            mesh.normals.push(Vec3::new(cos, 0.0, sin));
            mesh.tangents.push(Vec3::Y.extend(1.0));
            mesh.tex_coords.push(Vec2::new(side as f32 / SIDES as f32, share));
            mesh.influences.push(Influences {
                joints: [0, 1, 0, 0],
                weights: [1.0 - upper, upper, 0.0, 0.0],
            });
        }
    }
    for ring in 0..RINGS {
        for side in 0..SIDES {
            let [low, low_next] = [side, (side + 1) % SIDES].map(|side| ring * SIDES + side);
            let [high, high_next] = [low + SIDES, low_next + SIDES];
            mesh.indices.extend([low, low_next, high, high, low_next, high_next]);
        }
    }
    let half = RINGS / 2 * SIDES * 2;
    mesh.submeshes = (0..2)
        .map(|part| Submesh {
            triangle_start: part * half,
            triangle_count: half,
            material: part,
        })
        .collect();
    let to_joint = Affine3A::from_translation(Vec3::NEG_Y * (TUBE_HEIGHT / 2.0));
    let skeleton = Skeleton::new(
        vec![None, Some(JointIndex(0))],
        vec![Affine3A::IDENTITY, to_joint],
        vec![0, 1],
    );
    Model {
        materials: vec![material("blue", BLUE), material("sand", [0.5, 0.42, 0.3])],
        mesh,
        skeleton: skeleton.expect("two joints in order"),
        ..Model::default()
    }
}

/// Turns the tube's upper half about z, and makes its lower half twice as thick.
pub(crate) fn bent(angle_radians: f32) -> Palette {
    let middle = Vec3::Y * (TUBE_HEIGHT / 2.0);
    let turn = Affine3A::from_rotation_translation(Quat::from_rotation_z(angle_radians), middle);
    Palette(vec![
        Affine3A::from_scale(Vec3::new(2.0, 1.0, 2.0)),
        turn * Affine3A::from_translation(-middle),
    ])
}

/// The bent tube, framed.
pub(crate) fn bent_tube(angle_radians: f32) -> Scene {
    let mut scene = Scene::of(tube());
    scene.palette = bent(angle_radians);
    scene.world_bounds = Aabb {
        min: Vec3::new(-2.5, 0.0, -1.0),
        max: Vec3::new(2.5, TUBE_HEIGHT, 1.0),
    };
    scene.camera.distance = 9.0;
    scene
}
