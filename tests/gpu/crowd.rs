//! A crowd is drawn as its instances are drawn alone.

use bindpose::anim::Palette;
use bindpose::render::{Renderer, Target};
use bindpose::scene::{Aabb, CrowdInstance, FrameCost, Light, Overlay, Pass, Passes, Projection, Theme, ViewMode};
use glam::{Affine3A, Vec3};

use crate::gpu::{Gpu, Picture};
use crate::scenes::{FRONT, Scene, bent, bent_tube, card};

const SIZE: [u32; 2] = [240, 120];
/// Bytes in a row of the bone texture: 256 joints of three texels, four floats each.
const ROW_BYTES: u64 = 256 * 3 * 16;
const INSTANCE_BYTES: u64 = 72;

/// Bends of the tubes.
const BENDS: [f32; 3] = [0.3, -0.4, 0.5];

/// Where three tubes stand so that none is in the shadow of another: aslant, across the first light. The box that holds them is so
/// narrow that it counts as tall as one tube: ambient occlusion reaches as far with one tube in it.
fn places(light: Light) -> [Affine3A; 3] {
    let aslant = match light {
        Light::Studio => 2.0,
        Light::Book => -2.0,
    };
    [-1.0, 0.0, 1.0].map(|step: f32| Affine3A::from_translation(Vec3::new(3.6, 0.0, aslant) * step))
}

/// The stage on which [`tubes`] stand, with none of them.
fn stage(light: Light) -> Scene {
    let mut scene = bent_tube(0.0).three_quarter(Theme::Light);
    scene.world_bounds = Aabb {
        min: Vec3::new(-5.2, 0.0, -3.0),
        max: Vec3::new(5.2, 4.0, 3.0),
    };
    scene.camera.yaw_radians = 0.0;
    scene.camera.pitch_radians = 0.2;
    scene.camera.distance = 14.0;
    scene.camera.target = scene.world_bounds.center();
    scene.options.light = light;
    scene
}

/// One of the tubes alone.
fn tube(stage: &Scene, instance: usize) -> Scene {
    let mut scene = stage_again(stage);
    scene.world_from_model = places(stage.options.light)[instance];
    scene.palette = bent(BENDS[instance]);
    scene
}

/// All three, one of them as the frame's own.
fn tubes(stage: &Scene, own: usize) -> Scene {
    let mut scene = tube(stage, own);
    for other in (0..3).filter(|&other| other != own) {
        scene.add_to_crowd(places(stage.options.light)[other], &bent(BENDS[other]));
    }
    scene
}

fn stage_again(stage: &Scene) -> Scene {
    Scene {
        world_bounds: stage.world_bounds,
        camera: stage.camera,
        options: stage.options,
        ..bent_tube(0.0)
    }
}

/// With nothing of the model.
fn without_model(stage: &Scene) -> Scene {
    Scene {
        hidden: vec![true; 2],
        ..tube(stage, 0)
    }
}

/// Each pixel in which one instance alone shows is as there, and each in which none shows is as without them. Where two show, as their
/// shadows on the ground may, it could be anything; those are few.
fn assert_composed(what: &str, together: &Picture, alone: &[Picture], without: &Picture) {
    let mut owned = vec![0; alone.len()];
    let mut shared = 0;
    for y in 0..together.height {
        for x in 0..together.width {
            let bare = without.pixel(x, y);
            let mut shown = (0..alone.len()).filter(|&instance| alone[instance].pixel(x, y) != bare);
            let expected = match (shown.next(), shown.next()) {
                (None, _) => bare,
                (Some(instance), None) => {
                    owned[instance] += 1;
                    alone[instance].pixel(x, y)
                }
                _ => {
                    shared += 1;
                    continue;
                }
            };
            assert_eq!(together.pixel(x, y), expected, "{what}, at {x} {y}");
        }
    }
    assert!(owned.iter().all(|&pixels| pixels > 600), "{what}: {owned:?} pixels");
    assert!(shared < 600, "{what}: {shared} pixels show several instances");
}

/// What is shown of an instance, with its name.
type Dress = (&'static str, fn(&mut Scene));

/// All three, but those beside the own one are shrunk to nothing. How soft shadows are and how long lines are goes with the size of one
/// instance, which is known by where the others stand.
fn beside_nothing(stage: &Scene, own: usize) -> Scene {
    let mut scene = tubes(stage, own);
    for other in &mut scene.crowd {
        other.world_from_model *= Affine3A::from_scale(Vec3::ZERO);
    }
    scene
}

/// The three are as each is alone, when the own one is dressed so.
fn compare(gpu: &Gpu, what: &str, stage: &Scene, own: usize, dress: impl Fn(&mut Scene)) {
    let passes = stage.options.passes;
    let needs_size = passes.has(Pass::Shadow) || passes.has(Pass::ContactShadow);
    let mut easel = gpu.easel(stage, &[], SIZE);
    let alone = [0, 1, 2].map(|instance| {
        let is_own = instance == own;
        let mut scene = if needs_size || is_own {
            beside_nothing(stage, instance)
        } else {
            tube(stage, instance)
        };
        if is_own {
            dress(&mut scene);
        }
        easel.draw(&scene)
    });
    let mut without = beside_nothing(stage, own);
    without.hidden = vec![true; 2];
    let without = easel.draw(&without);
    let mut scene = tubes(stage, own);
    dress(&mut scene);
    assert_composed(what, &easel.draw(&scene), &alone, &without);
}

/// What counts the cost of frames of one model.
struct Costs(Renderer, Target);

impl Costs {
    fn new(gpu: &Gpu, scene: &Scene) -> Self {
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        Self(renderer, gpu.target(SIZE[0], SIZE[1]))
    }

    /// The cost of drawing a scene after another one.
    fn after(&mut self, before: &Scene, scene: &Scene) -> FrameCost {
        let Self(renderer, target) = self;
        renderer.render(&before.frame(), target);
        renderer.render(&scene.frame(), target)
    }
}

/// A row of many tubes, more than a row of the bone texture holds.
fn many() -> Scene {
    let mut scene = stage(Light::Studio);
    scene.palette = bent(0.1);
    for index in 0..300 {
        let place = Affine3A::from_scale_rotation_translation(
            Vec3::splat(0.1),
            glam::Quat::IDENTITY,
            Vec3::new((index % 30) as f32 * 0.3 - 4.5, 0.0, (index / 30) as f32 * 0.5 - 2.5),
        );
        scene.add_to_crowd(place, &bent(index as f32 * 0.005));
    }
    scene
}

on_both_backends! {
    /// With all passes and without: the same numbers go through the same steps, so the pixels are the same.
    fn lit_instances_are_as_they_are_alone(gpu) {
        for light in Light::ALL {
            for passes in [
                Passes::none(),
                Passes::all(),
                Passes::none().with(Pass::Shadow, true),
                Passes::none().with(Pass::AmbientOcclusion, true),
                Passes::none().with(Pass::ContactShadow, true),
            ] {
                let mut stage = stage(light);
                stage.options.passes = passes;
                compare(gpu, &format!("{light:?} {passes:?}"), &stage, 0, |_| {});
            }
        }
    }

    fn any_of_them_may_be_the_own_one(gpu) {
        let stage = stage(Light::Studio);
        let mut easel = gpu.easel(&stage, &[], SIZE);
        let pictures = [0, 1, 2].map(|own| easel.draw(&tubes(&stage, own)));
        assert_eq!(pictures[0], pictures[1]);
        assert_eq!(pictures[0], pictures[2]);
    }

    fn view_modes_show_every_instance(gpu) {
        for mode in [ViewMode::BaseColor, ViewMode::ShadingNormal, ViewMode::Shadow, ViewMode::AmbientOcclusion] {
            let mut stage = stage(Light::Studio);
            stage.options.view_mode = mode;
            compare(gpu, &format!("{mode:?}"), &stage, 1, |_| {});
        }
    }

    /// Colours of vertices, the highlight, ghosts, edges and lines of vertices. The others stay lit, ambient occlusion too.
    fn what_is_shown_of_the_own_instance_is_shown_of_it_alone(gpu) {
        let stage = stage(Light::Studio);
        let dresses: [Dress; 6] = [
            ("colours", |scene| scene.colors_srgb = vec![[200, 30, 120, 255]; scene.model.mesh.vertex_count()]),
            ("highlight", |scene| scene.highlighted = Some(1)),
            ("ghosts", |scene| scene.ghosts = vec![bent(0.7), bent(-0.2)]),
            ("edges", |scene| scene.options.overlays.set(Overlay::Wireframe, true)),
            ("normals", |scene| scene.options.overlays.set(Overlay::Normals, true)),
            ("tangents", |scene| scene.options.overlays.set(Overlay::Tangents, true)),
        ];
        for (what, dress) in dresses {
            compare(gpu, what, &stage, 1, dress);
        }
    }

    fn a_static_model_has_a_crowd_and_mirrored_instances_keep_their_front(gpu) {
        let mut alone = Scene::of(card(FRONT));
        alone.world_bounds = Aabb { min: Vec3::new(-4.5, 0.0, -0.2), max: Vec3::new(4.5, 2.0, 0.2) };
        alone.camera.target = alone.world_bounds.center();
        alone.camera.distance = 9.0;
        alone.options.passes = Passes::none();
        let mut easel = gpu.easel(&alone, &[], SIZE);
        let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        let places = [-1.0, 0.0, 1.0].map(|step: f32| Affine3A::from_translation(Vec3::X * 3.2 * step) * mirror);
        let mut pictures = Vec::new();
        for place in places {
            alone.world_from_model = place;
            pictures.push(easel.draw(&alone));
        }
        alone.hidden = vec![true; 2];
        let without = easel.draw(&alone);
        alone.hidden.clear();
        for place in &places[..2] {
            alone.add_to_crowd(*place, &Palette::default());
        }
        assert_composed("cards", &easel.draw(&alone), &pictures, &without);
    }

    /// It is not in the picture, but its shadow is.
    fn an_instance_out_of_sight_casts_a_shadow(gpu) {
        let stage = stage(Light::Studio);
        let mut easel = gpu.easel(&stage, &[], SIZE);
        let lone = tube(&stage, 0);
        let mut scene = tubes(&stage, 0);
        easel.draw(&scene);
        scene.in_sight = 0;
        let unseen = easel.draw(&scene);
        assert!(unseen == gpu.easel(&scene, &[], SIZE).draw(&scene), "nothing stays of what was seen before");
        let alone = easel.draw(&lone);
        let pixels = unseen.rgba.chunks_exact(4).zip(alone.rgba.chunks_exact(4));
        let darker = pixels.filter(|(with, without)| with[1].saturating_add(20) < without[1]).count();
        assert!(darker > 300, "{darker} pixels");
        // Where nothing has a shadow nothing is seen of it.
        let [alone, unseen] = [lone, scene].map(|mut scene| {
            scene.options.view_mode = ViewMode::BaseColor;
            easel.draw(&scene)
        });
        assert_eq!(unseen, alone);
    }

    fn instances_in_equal_poses_share_a_palette(gpu) {
        let stage = stage(Light::Studio);
        let mut easel = gpu.easel(&stage, &[], SIZE);
        let mut scene = tube(&stage, 0);
        for place in &places(Light::Studio)[1..] {
            scene.add_to_crowd(*place, &bent(0.5));
        }
        let own_each = easel.draw(&scene);
        scene.crowd_palettes.truncate(2);
        scene.crowd[1].palette = 0;
        assert_eq!(easel.draw(&scene), own_each);
        // A palette that is not there is the last one.
        scene.crowd[1].palette = 70_000;
        assert_eq!(easel.draw(&scene), own_each);
    }

    /// In bind space nothing is read of the palettes.
    fn a_crowd_in_bind_space_stands_in_bind_space(gpu) {
        let stage = stage(Light::Studio);
        let mut easel = gpu.easel(&stage, &[], SIZE);
        let mut scene = tubes(&stage, 0);
        scene.palette = Palette::default();
        let with_palettes = easel.draw(&scene);
        scene.crowd_palettes.clear();
        assert_eq!(easel.draw(&scene), with_palettes);
    }

    fn more_joints_than_a_row_of_the_bone_texture_holds(gpu) {
        let mut scene = tubes(&stage(Light::Studio), 0);
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let expected = easel.draw(&scene);
        // The last joints of the first row, and some in the third.
        let poses = std::mem::take(&mut scene.crowd_palettes);
        scene.crowd_palettes.resize(600, Affine3A::from_scale(Vec3::splat(3.0)));
        for (other, palette) in [126, 299].into_iter().enumerate() {
            scene.crowd[other].palette = palette as u32;
            scene.crowd_palettes[palette * 2..palette * 2 + 2].copy_from_slice(&poses[other * 2..other * 2 + 2]);
        }
        assert_eq!(easel.draw(&scene), expected);
    }

    fn only_the_rows_that_differ_are_uploaded(gpu) {
        let before = many();
        let mut costs = Costs::new(gpu, &before);
        let still = costs.after(&before, &before);
        let mut uploaded = |change: fn(&mut Scene)| {
            let mut scene = many();
            change(&mut scene);
            costs.after(&before, &scene).uploaded_bytes - still.uploaded_bytes
        };
        assert!(still.uploaded_bytes < ROW_BYTES, "{}: uniforms alone", still.uploaded_bytes);
        assert_eq!(uploaded(|scene| scene.crowd_palettes[0] = Affine3A::from_scale(Vec3::splat(1.5))), ROW_BYTES);
        assert_eq!(uploaded(|scene| scene.crowd_palettes[599] = Affine3A::IDENTITY), ROW_BYTES);
        assert_eq!(uploaded(|scene| scene.crowd_palettes[300..].fill(Affine3A::IDENTITY)), 2 * ROW_BYTES);
        // The own instance four times, the crowd, the highlight.
        let instances = 305 * INSTANCE_BYTES;
        assert_eq!(uploaded(|scene| scene.crowd[7].world_from_model = Affine3A::IDENTITY), instances);
        assert_eq!(uploaded(|scene| scene.crowd.swap(3, 4)), instances);
    }

    /// What is uploaded in parts is what a new renderer uploads whole.
    fn a_change_of_some_rows_shows(gpu) {
        let mut scene = many();
        let mut easel = gpu.easel(&scene, &[], SIZE);
        easel.draw(&scene);
        for change in [
            (|scene| scene.crowd_palettes[400..500].fill(Affine3A::from_scale(Vec3::splat(2.0)))) as fn(&mut Scene),
            |scene| scene.palette = bent(1.0),
            |scene| {
                scene.crowd.truncate(40);
                scene.crowd_palettes.truncate(80);
                scene.in_sight = 40;
            },
            |scene| *scene = many(),
            |scene| scene.add_to_crowd(Affine3A::IDENTITY, &bent(0.2)),
        ] {
            change(&mut scene);
            assert!(easel.draw(&scene) == gpu.easel(&scene, &[], SIZE).draw(&scene));
        }
    }

    /// Indices of the picture, the shadow map, the geometry and the contact map, for each instance that they draw.
    fn vertices_are_counted_for_each_instance_and_pass(gpu) {
        let mut scene = tubes(&stage(Light::Studio), 0);
        let indices = scene.model.mesh.indices.len() as u64;
        scene.in_sight = 1;
        let other = without_model(&scene);
        let mut costs = Costs::new(gpu, &scene);
        let drawn = costs.after(&other, &scene).vertices;
        assert_eq!(drawn, indices * (2 + 3 + 2 + 3));
        assert_eq!(costs.after(&scene, &scene).vertices, indices * 2, "maps are kept");
        scene.options.passes = Passes::none();
        assert_eq!(costs.after(&other, &scene).vertices, indices * 2);
        scene.crowd.push(CrowdInstance { world_from_model: Affine3A::IDENTITY, palette: 0 });
        scene.in_sight = 3;
        scene.camera.projection = Projection::Orthographic;
        assert_eq!(costs.after(&other, &scene).vertices, indices * 4);
    }
}
