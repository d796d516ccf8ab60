//! A material of glTF that was written for the books looks in their light as it did.

use bindpose::image::encode_png;
use bindpose::render::MaterialImages;
use bindpose::scene::{Background, Insets, Light, Overlay, ViewMode, ViewPreset};
use bindpose::session::{
    CameraCommand, ExportFormat, ExportJob, ExportOptions, File, FileCommand, LookCommand, Session,
};
use serde_json::{Value, json};

use crate::gltf_files::Gltf;
use crate::gpu::{Gpu, Picture};

const SIDE: u32 = 128;

/// Rings and sides of the ball.
const RINGS: u16 = 24;
const SIDES: u16 = 32;

/// Texels of a side of the pictures.
const TEXELS: u32 = 32;

/// A ball that a bone moves, of one material.
fn ball(material: &Value, pictures: &[Vec<u8>]) -> Session {
    let mut file = Gltf::new(&json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0, "skin": 0 }, { "name": "hips" }],
        "skins": [{ "joints": [1] }],
        "materials": [material],
    }));
    let places = (0..=RINGS).flat_map(|ring| (0..=SIDES).map(move |side| (ring, side)));
    let coords: Vec<[f32; 2]> = places
        .map(|(ring, side)| [f32::from(side) / f32::from(SIDES), f32::from(ring) / f32::from(RINGS)])
        .collect();
    let normals: Vec<[f32; 3]> = coords
        .iter()
        .map(|&[u, v]| {
            let (turn, tilt) = (u * std::f32::consts::TAU, v * std::f32::consts::PI);
            [turn.sin() * tilt.sin(), tilt.cos(), turn.cos() * tilt.sin()]
        })
        .collect();
    let mut corners = Vec::new();
    for ring in 0..RINGS {
        for side in 0..SIDES {
            let at = ring * (SIDES + 1) + side;
            let below = at + SIDES + 1;
            corners.extend([[at], [below], [below + 1], [at], [below + 1], [at + 1]]);
        }
    }
    let count = normals.len();
    let positions = file.floats(&normals);
    let attributes = json!({
        "POSITION": positions,
        "NORMAL": file.floats(&normals),
        "TEXCOORD_0": file.floats(&coords),
        "JOINTS_0": file.shorts(&vec![[0; 4]; count]),
        "WEIGHTS_0": file.floats(&vec![[1.0, 0.0, 0.0, 0.0]; count]),
    });
    let indices = file.shorts(&corners);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }]);
    let images: Vec<Value> = pictures
        .iter()
        .enumerate()
        .map(|(index, texels)| {
            let png = encode_png(texels, TEXELS, TEXELS).expect("a picture");
            json!({ "bufferView": file.view(&png, None), "mimeType": "image/png", "name": format!("picture {index}") })
        })
        .collect();
    if !images.is_empty() {
        file.json["textures"] = (0..images.len()).map(|source| json!({ "source": source })).collect();
        file.json["images"] = json!(images);
    }
    opened(vec![File::new("ball.glb", file.glb())])
}

fn opened(files: Vec<File>) -> Session {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(files));
    session.apply(CameraCommand::SetViewport {
        aspect: 1.0,
        insets: Insets::default(),
    });
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session.apply(LookCommand::SetViewMode(ViewMode::Lit));
    session.apply(LookCommand::SetLight(Light::Book));
    session.apply(LookCommand::SetBackground(Background::None));
    session.apply(LookCommand::SetOverlay(Overlay::Grid, false));
    session
}

/// What is written for a book and opened again, with the pictures beside it.
fn written(session: &Session, format: ExportFormat) -> Session {
    let options = ExportOptions {
        format,
        for_book: true,
        ..ExportOptions::default()
    };
    let job: ExportJob = session.export_job(&options).expect("a model is open");
    let written = job.run_apart().expect("it can be written");
    let maps = written.maps.iter().map(|(name, bytes)| File::new(name, bytes.to_vec()));
    let model = File::new("ball.m3d", written.bytes);
    opened([model].into_iter().chain(maps).collect())
}

fn drawn(gpu: &Gpu, mut session: Session) -> Picture {
    let model = session.open_model().expect("it is sound").model.clone();
    let images: Vec<MaterialImages<'_>> = session.maps().images().collect();
    let mut renderer = gpu.renderer();
    renderer.set_model(&model).expect("small");
    renderer.set_maps(&images);
    let mut target = gpu.target(SIDE, SIDE);
    renderer.render(&session.frame_at_rest(), &mut target);
    gpu.read(&target)
}

/// The mean difference and the 99th of a hundred, over the channels of the ball's pixels, of 255.
fn differences(before: &Picture, after: &Picture) -> (f64, u8) {
    let pairs = before.rgba.chunks_exact(4).zip(after.rgba.chunks_exact(4));
    let of_ball = pairs.filter(|(before, after)| before[3] == 255 && after[3] == 255);
    let mut off: Vec<u8> = of_ball
        .flat_map(|(before, after)| (0..3).map(|channel| before[channel].abs_diff(after[channel])))
        .collect();
    assert!(off.len() > 3 * 4000, "only {} numbers are compared", off.len());
    off.sort_unstable();
    let sum: u64 = off.iter().copied().map(u64::from).sum();
    (sum as f64 / off.len() as f64, off[off.len() * 99 / 100])
}

/// A picture of these texels, by their place.
fn picture(texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let places = (0..TEXELS).flat_map(|y| (0..TEXELS).map(move |x| (x, y)));
    places.flat_map(|(x, y)| texel(x, y)).collect()
}

/// A material with a factor of base colour, and with pictures of base colours (0) and of roughness and metalness (1).
fn material(color: [f32; 3], metallic: f32, roughness: f32, pictures: [bool; 2]) -> Value {
    let [red, green, blue] = color;
    let mut surface = json!({
        "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness,
    });
    if pictures[0] {
        surface["baseColorTexture"] = json!({ "index": 0 });
    }
    if pictures[1] {
        surface["metallicRoughnessTexture"] = json!({ "index": 1 });
    }
    json!({ "name": "skin", "pbrMetallicRoughness": surface })
}

fn cloth() -> Vec<u8> {
    picture(|x, y| [180 - 2 * x as u8, 90 + 2 * y as u8, 60 + (x / 8 % 2 * 60) as u8, 255])
}

/// Roughness in green and metalness in blue.
fn even(roughness: u8, metallic: u8) -> Vec<u8> {
    picture(|_, _| [0, roughness, metallic, 255])
}

const WHITE: [f32; 3] = [1.0; 3];

/// Asserts how near a ball of this material comes in each book's light: the mean and the 99th of a hundred, of 255.
fn assert_near(gpu: &Gpu, what: &str, first: &Session, bounds: [(f64, u8); 2]) {
    let before = drawn(gpu, first.clone());
    for (format, (mean_at_most, most)) in [ExportFormat::D3d12, ExportFormat::D3d11].into_iter().zip(bounds) {
        let (mean, found) = differences(&before, &drawn(gpu, written(first, format)));
        assert!(
            mean <= mean_at_most && found <= most,
            "{what} for {}: off by {mean:.1} on average, {found} for one in a hundred",
            format.name()
        );
    }
}

/// What both books have words for. Edges of shadows and highlights move a little with the plain normal map, which eight bits cannot make
/// quite flat.
const NEAR: (f64, u8) = (6.0, 32);

/// A highlight that is narrow, which moves with that map.
const NARROW: (f64, u8) = (6.0, 45);

/// The DirectX 11 book's highlights do not fade with Lambert's term, and have no Fresnel's.
const OTHER_HIGHLIGHT: (f64, u8) = (8.0, 65);

/// One colour of metal stands for all those of a picture.
const ONE_METAL: (f64, u8) = (10.0, 50);

/// Metal and what is none share Fresnel0 and roughness.
const BOTH: (f64, u8) = (20.0, 100);

on_both_backends! {
    fn a_surface_without_pictures_of_metalness_looks_as_it_did(gpu) {
        for (metallic, roughness, textured, color, bounds) in [
            (0.0, 1.0, true, WHITE, [NEAR, NEAR]),
            (0.0, 0.6, true, WHITE, [NEAR, NEAR]),
            (0.0, 0.3, true, [0.5, 0.7, 1.0], [NEAR, OTHER_HIGHLIGHT]),
            (0.0, 0.9, false, [0.2, 0.5, 0.05], [NEAR, NEAR]),
            (0.0, 0.2, false, [0.6, 0.1, 0.1], [NARROW, OTHER_HIGHLIGHT]),
            (1.0, 1.0, false, [0.8, 0.5, 0.2], [NEAR, NEAR]),
            (1.0, 1.0, true, WHITE, [ONE_METAL, NEAR]),
            (1.0, 0.5, false, [0.8, 0.5, 0.2], [NARROW, OTHER_HIGHLIGHT]),
            (1.0, 0.2, false, [0.8, 0.5, 0.2], [NARROW, OTHER_HIGHLIGHT]),
        ] {
            let pictures = &[cloth()][..usize::from(textured)];
            let first = ball(&material(color, metallic, roughness, [textured, false]), pictures);
            assert_near(gpu, &format!("metal {metallic}, roughness {roughness}, {textured}"), &first, bounds);
        }
    }

    fn pictures_of_metalness_look_as_they_did(gpu) {
        let halves = picture(|x, _| [0, 200, if x < TEXELS / 2 { 0 } else { 255 }, 255]);
        for (name, of_metal, pictures, bounds) in [
            ("none, rough", even(230, 0), [true, true], [NEAR, NEAR]),
            ("none, smooth", even(70, 0), [true, true], [NARROW, OTHER_HIGHLIGHT]),
            ("all, rough", even(255, 255), [true, true], [ONE_METAL, NEAR]),
            ("all, smooth", even(80, 255), [true, true], [ONE_METAL, ONE_METAL]),
            ("all, smooth, one colour", even(80, 255), [false, true], [NARROW, OTHER_HIGHLIGHT]),
            ("half, rough", halves.clone(), [true, true], [ONE_METAL, (10.0, 55)]),
            ("half, one colour", halves, [false, true], [BOTH, BOTH]),
        ] {
            let first = ball(&material(WHITE, 1.0, 1.0, pictures), &[cloth(), of_metal]);
            assert_near(gpu, name, &first, bounds);
        }
    }
}
