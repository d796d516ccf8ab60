//! From which side triangles are drawn, and on which side light falls.

use bindpose::anim::Palette;
use bindpose::model::{Handedness, Mesh, Model};
use bindpose::scene::{Background, Camera, Insets, Light, Pass, Passes, RenderFrame, ViewMode, ViewPreset};
use bindpose::session::{CameraCommand, Command, ExportFormat, File, LookCommand, MaterialCommand, Session};
use glam::{Affine3A, Vec3};
use serde_json::{Value, json};

use crate::exported::{exported, opened};
use crate::gltf_files::Gltf;
use crate::gltf_materials::{blended, metallic_roughness, over, unlit};
use crate::gpu::{Gpu, Picture, difference};
use crate::scenes::{RED, Scene};
use crate::sets::{Plate, SIZE, block, floor, plates, shadow_of_lid, shelter};
use crate::shared::shared;
use crate::still_life::add_ball;
use crate::textures::linear;

const BLACK: [u8; 4] = [0, 0, 0, 255];

/// The six walls of a box that stands on y = 0 or, where it is larger than 1, around such a box. They face outwards.
fn walls(side: f32) -> [Plate; 6] {
    let center = Vec3::Y * 0.5;
    let wall = |out: Vec3, along_u: Vec3, along_v: Vec3| Plate {
        corner: center + (out - along_u - along_v) * 0.5 * side,
        along_u: along_u * side,
        along_v: along_v * side,
        normal: out,
    };
    [
        wall(Vec3::NEG_Z, Vec3::X, Vec3::Y),
        wall(Vec3::Z, Vec3::X, Vec3::Y),
        wall(Vec3::NEG_X, Vec3::Z, Vec3::Y),
        wall(Vec3::X, Vec3::Z, Vec3::Y),
        wall(Vec3::Y, Vec3::X, Vec3::Z),
        wall(Vec3::NEG_Y, Vec3::X, Vec3::Z),
    ]
}

/// Turns the triangles of a submesh round, and leaves its normals.
fn wind_otherwise(mesh: &mut Mesh, submesh: usize) {
    let start = 3 * mesh.submeshes[submesh].triangle_start as usize;
    let count = 3 * mesh.submeshes[submesh].triangle_count as usize;
    let (triangles, _) = mesh.indices[start..start + count].as_chunks_mut::<3>();
    triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
}

/// A red box in a larger black one whose fronts are on its inside: how characters get outlines.
fn outlined(is_double_sided: bool) -> Scene {
    let mut model = plates(&walls(1.0).into_iter().chain(walls(1.1)).collect::<Vec<_>>());
    for submesh in 6..12 {
        wind_otherwise(&mut model.mesh, submesh);
    }
    model.mesh.normals[24..]
        .iter_mut()
        .for_each(|normal| *normal = -*normal);
    model.materials[..6].fill(metallic_roughness(RED, 0.0, 0.7));
    model.materials[6..].fill(unlit([0; 3]));
    for material in &mut model.materials[6..] {
        material.double_sided = is_double_sided;
    }
    let mut scene = Scene::of(model);
    (scene.camera.yaw_radians, scene.camera.pitch_radians) = (-0.5, 0.4);
    scene
}

/// What is seen of places on the box: its front, its left and its top.
fn on_box(scene: &Scene, picture: &Picture) -> [[u8; 4]; 3] {
    let places = [
        Vec3::new(0.0, 0.4, -0.5),
        Vec3::new(0.5, 0.5, 0.0),
        Vec3::new(0.1, 1.0, 0.1),
    ];
    places.map(|place| picture.at(scene.pixel_of(place, SIZE)))
}

/// A file of a box on some nodes, skinned or not.
fn boxes(nodes: &Value, material: &Value, skin: Option<Value>) -> Vec<File> {
    let mesh = plates(&walls(1.0)).mesh;
    let mut file = Gltf::new(&json!({ "scenes": [{ "nodes": [0] }], "nodes": nodes, "materials": [material] }));
    // The same numbers are right-handed and wound against the clock.
    let numbers = |vectors: &[Vec3]| -> Vec<[f32; 3]> { vectors.iter().map(Vec3::to_array).collect() };
    let indices: Vec<[u16; 1]> = mesh.indices.iter().map(|&index| [index as u16]).collect();
    let mut attributes =
        json!({ "POSITION": file.floats(&numbers(&mesh.positions)), "NORMAL": file.floats(&numbers(&mesh.normals)) });
    if let Some(skin) = skin {
        // The upper half follows the second joint.
        let joints: Vec<[u16; 4]> = mesh
            .positions
            .iter()
            .map(|at| [u16::from(at.y > 0.5), 0, 0, 0])
            .collect();
        attributes["JOINTS_0"] = file.shorts(&joints).into();
        attributes["WEIGHTS_0"] = file.floats(&vec![[1.0, 0.0, 0.0, 0.0]; joints.len()]).into();
        file.json["skins"] = json!([skin]);
    }
    let indices = file.shorts(&indices);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }]);
    vec![File::new("boxes.glb", file.glb())]
}

/// The picture of a session from some side.
fn seen(gpu: &Gpu, session: &mut Session, preset: ViewPreset) -> Picture {
    session.apply(CameraCommand::SetViewport {
        aspect: SIZE[0] as f32 / SIZE[1] as f32,
        insets: Insets::default(),
    });
    session.apply(CameraCommand::LookFrom(preset));
    seen_by(gpu, session, None)
}

/// Its picture, by another camera than its own.
fn seen_by(gpu: &Gpu, session: &mut Session, camera: Option<Camera>) -> Picture {
    let mut renderer = gpu.renderer();
    renderer
        .set_model(&session.open_model().expect("it is sound").model)
        .expect("small");
    renderer.set_materials(session.materials());
    let mut target = gpu.target(SIZE[0], SIZE[1]);
    let frame = session.frame_at_rest();
    let camera = camera.unwrap_or(frame.camera);
    renderer.render(&RenderFrame { camera, ..frame }, &mut target);
    gpu.read(&target)
}

on_both_backends! {
    fn an_outline_neither_hides_nor_darkens_what_it_is_around(gpu) {
        let (mut scene, mut closed) = (outlined(false), outlined(true));
        let mut alone = outlined(false);
        alone.hidden = (0..12).map(|submesh| submesh >= 6).collect();
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let mut as_blob = gpu.easel(&closed, &[], SIZE);
        for light in Light::ALL {
            for mode in [ViewMode::Lit, ViewMode::Shadow, ViewMode::AmbientOcclusion, ViewMode::BaseColor] {
                for options in [&mut scene.options, &mut closed.options, &mut alone.options] {
                    (options.light, options.view_mode) = (light, mode);
                }
                let [found, expected] = [&scene, &alone].map(|scene| on_box(scene, &easel.draw(scene)));
                for (found, expected) in found.into_iter().zip(expected) {
                    assert!(difference(found, expected) <= 3, "{light:?} {mode:?}: {found:?} for {expected:?}");
                }
            }
            closed.options.view_mode = ViewMode::Lit;
            assert_eq!(on_box(&closed, &as_blob.draw(&closed)), [BLACK; 3], "from both sides it hides the box");
        }
        // It is seen beside the box.
        scene.options.view_mode = ViewMode::Lit;
        alone.options.view_mode = ViewMode::Lit;
        scene.options.background = Background::Color([255; 3]);
        let picture = easel.draw(&scene);
        let black = picture.rgba.chunks_exact(4).filter(|pixel| **pixel == BLACK).count();
        assert!(black > 100, "{black} pixels of outline");
    }

    /// Whichever hand is chosen: a mirror shows the same sides.
    fn one_looks_into_a_room_from_outside(gpu) {
        let mut model = plates(&walls(1.0));
        for submesh in 0..6 {
            wind_otherwise(&mut model.mesh, submesh);
        }
        model.mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
        model.materials.fill(unlit([200, 30, 30]));
        model.materials[1] = unlit([30, 60, 200]);
        let (inside, outside) = ([30, 60, 200, 255], [200, 30, 30, 255]);
        for (mirror, handedness, expected) in [
            (1.0, Handedness::Left, inside),
            (-1.0, Handedness::Left, inside),
            // The same numbers by the other hand.
            (1.0, Handedness::Right, outside),
            (-1.0, Handedness::Right, outside),
        ] {
            let in_world = Affine3A::from_scale(Vec3::new(mirror, 1.0, 1.0));
            let scene = Scene::of(Model { handedness, ..model.clone() }).in_world(in_world);
            let found = gpu.draw(&scene, SIZE[0], SIZE[1]).middle();
            assert!(difference(found, expected) <= 1, "{mirror} {handedness:?}: {found:?}");
        }
    }

    fn what_light_does_not_see_casts_no_shadow(gpu) {
        for light in Light::ALL {
            for (double_sided, turned, is_dark) in [(false, false, true), (false, true, false), (true, true, true)] {
                let mut scene = shelter();
                (scene.options.light, scene.options.view_mode) = (light, ViewMode::Shadow);
                scene.model.materials[1] = metallic_roughness([0.4; 3], 0.0, 1.0);
                scene.model.materials[1].double_sided = double_sided;
                if turned {
                    wind_otherwise(&mut scene.model.mesh, 1);
                }
                let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
                let found = picture.at(scene.pixel_of(shadow_of_lid(light), SIZE))[0];
                let what = format!("{light:?}, from both sides {double_sided}, turned {turned}: {found}");
                assert!(if is_dark { found < 60 } else { found > 240 }, "{what}");
            }
        }
    }

    /// Of nothing else either: alpha that cuts takes another way.
    fn a_turned_leaf_casts_no_shadow(gpu) {
        for (turned, is_dark) in [(false, true), (true, false)] {
            let mut scene = shelter();
            scene.options.view_mode = ViewMode::Shadow;
            scene.model.materials[1] = bindpose::model::Material {
                alpha: bindpose::model::AlphaMode::Mask { cutoff: 0.5 },
                ..metallic_roughness([0.4; 3], 0.0, 1.0)
            };
            scene.model.materials[0].alpha = bindpose::model::AlphaMode::Mask { cutoff: 0.5 };
            scene.model.mesh.colors = vec![glam::Vec4::ONE; scene.model.mesh.vertex_count()];
            if turned {
                wind_otherwise(&mut scene.model.mesh, 1);
            }
            let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
            let found = picture.at(scene.pixel_of(shadow_of_lid(Light::Studio), SIZE))[0];
            assert!(if is_dark { found < 60 } else { found > 240 }, "turned {turned}: {found}");
        }
    }

    /// Contact is seen from below: what faces down touches the ground, and what faces up alone does not.
    fn what_faces_up_alone_leaves_no_contact(gpu) {
        for (double_sided, normal, touches) in [(false, Vec3::NEG_Y, true), (false, Vec3::Y, false), (true, Vec3::Y, true)] {
            let mut scene = Scene::of(plates(&[Plate { normal, ..floor(1.0) }]));
            scene.model.materials[0] = metallic_roughness([0.4; 3], 0.0, 1.0);
            scene.model.materials[0].double_sided = double_sided;
            scene.world_bounds.max.y = 3.0;
            scene.model.mesh.positions.iter_mut().for_each(|at| at.y += 0.1);
            (scene.camera.yaw_radians, scene.camera.pitch_radians) = (0.3, 0.05);
            let mut easel = gpu.easel(&scene, &[], SIZE);
            let [with, without] = [true, false].map(|contact| {
                scene.options.passes = Passes::none().with(Pass::ContactShadow, contact);
                easel.draw(&scene)
            });
            let share = with.share_that_differs(&without, 2);
            assert!(if touches { share > 0.005 } else { share == 0.0 }, "{normal}, from both sides {double_sided}: {share}");
        }
    }

    fn what_is_not_seen_shuts_out_no_light_of_the_room(gpu) {
        let behind = Plate { corner: Vec3::new(-1.0, 0.0, 0.0), along_u: Vec3::X * 2.0, along_v: Vec3::Y, normal: Vec3::Z };
        let mut scene = Scene::of(plates(&[floor(2.0), behind]));
        scene.model.materials.fill(metallic_roughness([0.4; 3], 0.0, 1.0));
        scene.camera.pitch_radians = 0.6;
        scene.options.view_mode = ViewMode::AmbientOcclusion;
        let found = gpu.draw(&scene, SIZE[0], SIZE[1]);
        scene.hidden = vec![false, true];
        assert!(found == gpu.draw(&scene, SIZE[0], SIZE[1]), "its back is as if it were not there");
        scene.hidden.clear();
        scene.model.materials[1].double_sided = true;
        let share = found.share_that_differs(&gpu.draw(&scene, SIZE[0], SIZE[1]), 8);
        assert!(share > 0.004, "from both sides it shuts out some: {share}");
    }

    /// A ball of glass, blue on the front and red on the back, whatever the order of its triangles; one, some and many of it.
    fn of_glass_the_back_is_drawn_before_the_front(gpu) {
        let mut mesh = Mesh::default();
        add_ball(&mut mesh, Vec3::Y, 1.0);
        let [red, blue] = [[220, 40, 40], [40, 60, 220]];
        mesh.colors = mesh.normals.iter().map(|normal| Vec3::from(linear(if normal.z > 0.0 { red } else { blue })).extend(1.0)).collect();
        let material = blended([255; 3], 0.5);
        let mut scene = Scene::of(Model { mesh, materials: vec![material], ..Model::default() });
        scene.options.background = Background::Color([0; 3]);
        for others in [0, 3, 80] {
            for _ in scene.crowd.len()..others {
                let beside = Affine3A::from_translation(Vec3::X * 9.0 * (1 + scene.crowd.len()) as f32);
                scene.add_to_crowd(beside, &Palette::default());
            }
            let mut easel = gpu.easel(&scene, &[], SIZE);
            for (yaw, [back, front]) in [(0.0, [red, blue]), (std::f32::consts::PI, [blue, red])] {
                scene.camera.yaw_radians = yaw;
                let found = easel.draw(&scene).middle();
                let expected = over([0; 3], &[(back, 0.5), (front, 0.5)]);
                assert!(difference(found, expected) <= 2, "from {yaw}, {others} others: {found:?} for {expected:?}");
            }
        }
        // A nearer ball of a few is drawn whole after the farther one.
        scene.crowd.clear();
        scene.world_bounds.max.z = 5.0;
        scene.add_to_crowd(Affine3A::from_translation(Vec3::Z * 3.0), &Palette::default());
        for (yaw, layers) in [(0.0, [red, blue, red, blue]), (std::f32::consts::PI, [blue, red, blue, red])] {
            scene.camera.yaw_radians = yaw;
            let found = gpu.draw(&scene, SIZE[0], SIZE[1]).middle();
            let expected = over([0; 3], &layers.map(|layer| (layer, 0.5)));
            assert!(difference(found, expected) <= 2, "two from {yaw}: {found:?} for {expected:?}");
        }
    }

    /// Parts of a book's model may be wound in two ways: their normals tell. In glTF the winding does.
    fn each_part_of_a_books_model_is_lit_where_its_normals_point(gpu) {
        for light in Light::ALL {
            let mut sound = block();
            sound.options.light = light;
            let mut mixed = block();
            mixed.options.light = light;
            for submesh in [1, 2] {
                wind_otherwise(&mut mixed.model.mesh, submesh);
            }
            let expected = gpu.draw(&sound, SIZE[0], SIZE[1]);
            let found = gpu.draw(&mixed, SIZE[0], SIZE[1]);
            assert_eq!(found.share_that_differs(&expected, 1), 0.0, "{light:?}");
            mixed.model.materials.fill(bindpose::model::Material { double_sided: true, ..metallic_roughness([0.4; 3], 0.0, 0.7) });
            sound.model.materials = mixed.model.materials.clone();
            let [found, expected] = [&mixed, &sound].map(|scene| gpu.draw(scene, SIZE[0], SIZE[1]));
            assert!(found.share_that_differs(&expected, 10) > 0.1, "{light:?}");
        }
    }

    /// Drawn from its fronts alone, a closed box looks as from both sides: the fronts are found on mirrored nodes, under mirrored roots of
    /// skins that are bent, and where another hand is chosen.
    fn mirrored_nodes_show_their_fronts(gpu) {
        let turn = [0.0, 0.0, 0.25, 0.968_245_8];
        let skinned = |scale: f32| {
            let nodes = json!([
                { "children": [1, 2], "scale": [scale, 1.0, 1.0] }, { "mesh": 0, "skin": 0 },
                { "children": [3] }, { "rotation": turn },
            ]);
            (nodes, Some(json!({ "joints": [2, 3] })))
        };
        let files = [
            (json!([{ "children": [1, 2] }, { "mesh": 0, "translation": [-1.0, 0.0, 0.0] },
                { "mesh": 0, "translation": [1.0, 0.0, 0.0], "scale": [-1.0, 1.0, 1.0] }]), None),
            (json!([{ "children": [1], "scale": [1.0, -1.0, 1.0] }, { "mesh": 0, "rotation": turn, "scale": [2.0, 1.0, -1.0] }]), None),
            (json!([{ "children": [1], "scale": [1.0, 1.0, -2.0] }, { "mesh": 0 }]), None),
            skinned(1.0),
            skinned(-1.0),
        ];
        for (nodes, skin) in files {
            let drawn = |double_sided: bool, hand: Option<Handedness>, preset| {
                let material = json!({ "doubleSided": double_sided, "pbrMetallicRoughness": { "metallicFactor": 0.0, "baseColorFactor": [0.6, 0.1, 0.1, 1.0] } });
                let mut session = opened(boxes(&nodes, &material, skin.clone()));
                session.apply(Command::SetHandedness(hand));
                seen(gpu, &mut session, preset)
            };
            for hand in [None, Some(Handedness::Left)] {
                for preset in [ViewPreset::Front, ViewPreset::Left, ViewPreset::Top] {
                    let [one, both] = [false, true].map(|double_sided| drawn(double_sided, hand, preset));
                    let share = one.share_that_differs(&both, 8);
                    assert!(share < 0.01, "{nodes} {hand:?} {preset:?}: {share}");
                }
            }
        }
    }

    fn both_sides_can_be_asked_for(gpu) {
        let single = json!({ "pbrMetallicRoughness": { "baseColorFactor": [0.6, 0.1, 0.1, 1.0] } });
        let nodes = json!([{ "mesh": 0 }]);
        let mut files = boxes(&nodes, &single, None);
        // Its triangles are turned: corners 1 and 2 of each change places.
        let Some(file) = files.pop() else { return };
        let mut session = opened(vec![turned(&file)]);
        session.apply(LookCommand::SetViewMode(ViewMode::Depth));
        let holed = seen(gpu, &mut session, ViewPreset::Front);
        session.apply(MaterialCommand::DrawBothSides(true));
        let closed = seen(gpu, &mut session, ViewPreset::Front);
        assert!(closed.share_that_differs(&holed, 8) > 0.05);
        session.apply(MaterialCommand::DrawBothSides(false));
        assert!(seen(gpu, &mut session, ViewPreset::Front) == holed);
    }

    /// What the books draw from both sides looks the same as a `.glb`, which says from which sides it is drawn.
    fn a_books_model_looks_the_same_as_glb(gpu) {
        for (path, has_two_sides, shows_backs) in [
            ("models/d3d11/tree.m3d", true, true),
            // Its parts are open where others cover them.
            ("models/d3d12/soldier.m3d", true, false),
            ("models/d3d11/rock.m3d", false, false),
        ] {
            let Some(path) = shared(path) else { continue };
            let bytes = std::fs::read(&path).expect("it can be read");
            let mut session = opened(vec![File::new("model.m3d", bytes)]);
            let (mut again, written) = exported(&session, ExportFormat::Glb, false);
            let says_so = String::from_utf8_lossy(&written.bytes).contains("\"doubleSided\"");
            assert_eq!(says_so, has_two_sides, "{path:?}");
            let mut bare = opened(vec![File::new("model.glb", without_sides(written.bytes))]);
            let mut most = 0.0_f64;
            for preset in [ViewPreset::Front, ViewPreset::Left, ViewPreset::Top] {
                session.apply(CameraCommand::LookFrom(preset));
                let camera = session.frame_at_rest().camera;
                let [before, after, bare] =
                    [&mut session, &mut again, &mut bare].map(|session| seen_by(gpu, session, Some(camera)));
                let share = after.share_that_differs(&before, 20);
                assert!(share < 0.001, "{path:?} looks another way from the {preset:?}: {share}");
                most = most.max(bare.share_that_differs(&before, 20));
            }
            assert_eq!(most > 0.002, shows_backs, "{path:?} has {most} that is seen from behind");
        }
    }
}

/// The same file with its indices, which come last, in another order.
fn turned(file: &File) -> File {
    let mut bytes = file.bytes.to_vec();
    let start = bytes.len() - 2 * 36;
    let (triangles, _) = bytes[start..].as_chunks_mut::<6>();
    for [_, _, a, b, c, d] in triangles {
        std::mem::swap(a, c);
        std::mem::swap(b, d);
    }
    File::new("turned.glb", bytes)
}

/// The same file without what it says of sides.
fn without_sides(mut bytes: Vec<u8>) -> Vec<u8> {
    let word = b"\"doubleSided\"";
    while let Some(at) = bytes.windows(word.len()).position(|found| found == word) {
        bytes[at + 1] = b'D';
    }
    bytes
}
