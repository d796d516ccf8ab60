//! A model that was exported bends the light as the one that it was made of: green of normal maps and bitangents go together.

use bindpose::image::{decode, encode_png};
use bindpose::render::MaterialImages;
use bindpose::scene::{Insets, Light, ViewMode, ViewPreset};
use bindpose::session::{
    CameraCommand, ExportFormat, ExportOptions, File, FileCommand, LookCommand, Session, WrittenModel,
};
use serde_json::json;

use crate::gltf_files::Gltf;
use crate::gpu::{Gpu, Picture, difference};

const SIDE: u32 = 120;

/// The map's side.
const TEXELS: u32 = 64;

/// Directions that lean right, left, up and down in the picture, where green is up.
const LEANS: [[u8; 4]; 4] = [
    [204, 128, 230, 255],
    [51, 128, 230, 255],
    [128, 204, 230, 255],
    [128, 51, 230, 255],
];

/// Two cards that face +z, the right one with its texture mirrored. Tangents are computed, or in the file.
fn cards(with_tangents: bool, is_skinned: bool) -> Vec<File> {
    let mut file = Gltf::new(&json!({
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "textures": [{ "source": 0 }, { "source": 1 }],
        "materials": [{
            "normalTexture": { "index": 0 },
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 }, "metallicFactor": 0.0, "roughnessFactor": 1.0 },
        }],
    }));
    let card = |left: f32| {
        [
            [left, 2.0, 0.0],
            [left, 0.0, 0.0],
            [left + 1.0, 0.0, 0.0],
            [left + 1.0, 2.0, 0.0],
        ]
    };
    let coords = |left: f32, right: f32| [[left, 0.0], [left, 1.0], [right, 1.0], [right, 0.0]];
    let positions = file.floats(&[card(-1.1), card(0.1)].concat());
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 8]);
    let tex_coords = file.floats(&[coords(0.0, 1.0), coords(1.0, 0.0)].concat());
    let indices = file.shorts(&[[0], [1], [2], [0], [2], [3], [4], [5], [6], [4], [6], [7]]);
    let mut attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": tex_coords });
    if with_tangents {
        let [plain, mirrored] = [[1.0, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, -1.0]];
        attributes["TANGENT"] = file.floats(&[[plain; 4], [mirrored; 4]].concat()).into();
    }
    if is_skinned {
        attributes["JOINTS_0"] = file.shorts(&[[0; 4]; 8]).into();
        attributes["WEIGHTS_0"] = file.floats(&[[1.0, 0.0, 0.0, 0.0]; 8]).into();
        file.json["skins"] = json!([{ "joints": [1] }]);
        file.json["nodes"] = json!([{ "mesh": 0, "skin": 0 }, { "name": "hips" }]);
        file.json["scenes"] = json!([{ "nodes": [0, 1] }]);
    }
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }]);
    // Quarters so large that a filter leaves their middles alone.
    let places = (0..TEXELS).flat_map(|y| (0..TEXELS).map(move |x| (2 * x / TEXELS, 2 * y / TEXELS)));
    let texels: Vec<[u8; 4]> = places.map(|(x, y)| LEANS[(2 * y + x) as usize]).collect();
    let png = encode_png(texels.as_flattened(), TEXELS, TEXELS).expect("a picture");
    let grey = encode_png(&[128, 128, 128, 255], 1, 1).expect("a texel");
    let [leans, grey] = [png, grey].map(|png| file.view(&png, None));
    file.json["images"] = json!([
        { "bufferView": leans, "mimeType": "image/png", "name": "leans" },
        { "bufferView": grey, "mimeType": "image/png", "name": "grey" },
    ]);
    // Each in another form.
    match (with_tangents, is_skinned) {
        (true, false) => vec![File::new("cards.glb", file.glb())],
        (_, false) => vec![File::new("cards.gltf", file.text())],
        _ => vec![
            File::new("cards.gltf", file.text_beside("cards.bin")),
            File::new("cards.bin", file.bin),
        ],
    }
}

pub(crate) fn opened(files: Vec<File>) -> Session {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(files));
    session.apply(CameraCommand::SetViewport {
        aspect: 1.0,
        insets: Insets::default(),
    });
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    session
}

/// What a session exports, opened.
pub(crate) fn exported(session: &Session, format: ExportFormat, for_book: bool) -> (Session, WrittenModel) {
    let options = ExportOptions {
        format,
        for_book,
        ..ExportOptions::default()
    };
    let job = session.export_job(&options).expect("a model is open");
    let written = job.run_apart().expect("it can be written");
    let name = format!("cards.{}", format.extension());
    let model = File::new(&name, written.bytes.clone());
    let maps = written.maps.iter().map(|(name, bytes)| File::new(name, bytes.to_vec()));
    (opened([model].into_iter().chain(maps).collect()), written)
}

fn drawn(gpu: &Gpu, session: &mut Session, mode: ViewMode) -> Picture {
    session.apply(LookCommand::SetViewMode(mode));
    session.apply(LookCommand::SetLight(Light::Book));
    let model = session.open_model().expect("it is sound").model.clone();
    let images: Vec<MaterialImages<'_>> = session.maps().images().collect();
    let mut renderer = gpu.renderer();
    renderer.set_model(&model).expect("small");
    assert!(renderer.set_maps(&images) > 0, "it has maps");
    let mut target = gpu.target(SIDE, SIDE);
    renderer.render(&session.frame_at_rest(), &mut target);
    gpu.read(&target)
}

/// The middles of the four texels on each card.
fn middles(picture: &Picture) -> Vec<[u8; 4]> {
    let (rows, columns) = ([0.3, 0.7], [0.18, 0.38, 0.62, 0.82]);
    let at = |part: f64| (part * f64::from(SIDE)) as u32;
    let places = rows.into_iter().flat_map(|y| columns.map(|x| (x, y)));
    places.map(|(x, y)| picture.pixel(at(x), at(y))).collect()
}

/// A texel's green may be rounded once more.
fn assert_same(before: &Picture, after: &Picture, what: &str) {
    let [before, after] = [before, after].map(middles);
    let mut pairs = before.iter().zip(&after);
    assert!(
        pairs.all(|(&before, &after)| difference(before, after) <= 2),
        "{what}:\n{before:?}\n{after:?}"
    );
}

on_both_backends! {
    fn from_gltf_to_the_books_and_back(gpu) {
        for (with_tangents, is_skinned) in [(true, false), (false, false), (true, true)] {
            let mut first = opened(cards(with_tangents, is_skinned));
            let normals = drawn(gpu, &mut first, ViewMode::ShadingNormal);
            let told = middles(&normals);
            assert!(told.iter().any(|&texel| difference(texel, told[0]) > 60), "it leans all ways: {told:?}");
            for (format, for_book) in [
                (ExportFormat::D3d12, false),
                (ExportFormat::D3d12, true),
                (ExportFormat::D3d11, false),
                (ExportFormat::Glb, false),
            ] {
                let what = format!("{} {for_book} {with_tangents} {is_skinned}", format.name());
                let (mut second, written) = exported(&first, format, for_book);
                assert_same(&normals, &drawn(gpu, &mut second, ViewMode::ShadingNormal), &what);
                if format == ExportFormat::Glb {
                    assert!(written.plan.changes.is_empty(), "{:?}", written.plan.changes);
                    continue;
                }
                assert!(written.plan.changes.iter().any(|change| change.code == "normal-green-turned"));
                let findings = &second.open_model().expect("it is sound").diagnostics;
                assert!(findings.iter().all(|finding| finding.code != "tangent-sign-against-uv"), "{findings:?}");
                let leans = written.maps.iter().find(|(name, _)| name.starts_with("leans"));
                let (name, picture) = leans.expect("it is written");
                let texels = decode(picture, name).expect("a picture").to_rgba8(0, 0).expect("texels");
                assert_eq!(texels[texels.len() - 3], 255 - LEANS[3][1], "{name}: green is down");
                let (mut third, written) = exported(&second, ExportFormat::Glb, false);
                assert!(written.plan.changes.iter().any(|change| change.code == "normal-green-turned"));
                assert_same(&normals, &drawn(gpu, &mut third, ViewMode::ShadingNormal), &format!("{what}, back"));
            }
        }
    }

    fn the_books_light_falls_on_it_the_same(gpu) {
        let mut first = opened(cards(false, true));
        let (mut second, _) = exported(&first, ExportFormat::D3d12, true);
        let [before, after] = [&mut first, &mut second].map(|session| drawn(gpu, session, ViewMode::Lit));
        assert_same(&before, &after, "lit");
    }
}
