//! What a fuzzer tries: each target takes any bytes, and must come back without a panic. `cargo xtask fuzz` makes bytes up;
//! the tests give all targets the bytes that it found worth keeping.

pub mod corpus;

use bindpose::anim::CompiledClip;
use bindpose::edit::Edits;
use bindpose::import;
use bindpose::model::JointNames;
use bindpose::session::{ExportFormat, ExportJob, File, FileCommand, Session, ToExport};
use bindpose::{check, image};

/// Something to try, and how it is called.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// As the environment variable [`TARGET`] and the folder of its corpus have it.
    pub name: &'static str,
    /// Tries these bytes.
    pub run: fn(&[u8]),
}

/// The environment variable that names the target to the fuzzer.
pub const TARGET: &str = "BINDPOSE_FUZZ_TARGET";

/// All of them.
pub const TARGETS: [Target; 6] = [
    Target {
        name: "models",
        run: models,
    },
    Target {
        name: "buffers",
        run: buffers,
    },
    Target {
        name: "pictures",
        run: pictures,
    },
    Target {
        name: "archives",
        run: archives,
    },
    Target {
        name: "whole",
        run: whole,
    },
    Target { name: "fbx", run: fbx },
];

/// A model of any format, with nothing beside it, is read and looked over.
fn models(bytes: &[u8]) {
    let _begins = import::begins_like_model(bytes);
    let _beside = import::files_beside(bytes);
    look_over(bytes);
}

/// An FBX file is read and looked over, whatever its first bytes are: as text where these are letters, else as a binary one.
fn fbx(bytes: &[u8]) {
    let start: &[u8] = match bytes.first() {
        Some(byte) if byte.is_ascii_graphic() || byte.is_ascii_whitespace() => b"; FBX 7.4.0 project file\n",
        _ => b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0",
    };
    look_over(&[start, bytes].concat());
    models(bytes);
}

/// The numbers of a sound `.glb` are replaced: positions, weights, matrices, times and keys are whatever comes.
fn buffers(bytes: &[u8]) {
    /// Header of the file, and of its first chunk.
    const JSON_AT: usize = 20;
    let mut file = include_bytes!("../../../tests/fixtures/gltf/banner.glb").to_vec();
    let json_len = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let numbers = &mut file[JSON_AT + json_len + 8..];
    let count = numbers.len().min(bytes.len());
    numbers[..count].copy_from_slice(&bytes[..count]);
    look_over(&file);
}

fn look_over(bytes: &[u8]) {
    match import::import(bytes) {
        Ok(imported) => {
            let model = &imported.model;
            let compiled = CompiledClip::all(&model.clips);
            let _findings = check::model(model, &compiled, &*imported.source.places(bytes));
        }
        Err(refused) => assert!(!refused.error.message.is_empty(), "every refusal has words"),
    }
}

/// A picture is read by its own marks, and by an extension where it has none.
fn pictures(bytes: &[u8]) {
    let _checked = image::check(bytes, "picture.tga");
    let _side = image::cube_side(bytes);
    if let Ok(picture) = image::decode(bytes, "picture.tga") {
        let _texels = picture.to_rgba8(0, 0);
    }
}

/// An archive is unpacked, and its models are read with its pictures.
fn archives(bytes: &[u8]) {
    let _loaded = load("drop.zip", bytes);
}

/// A model goes the whole way: it is read, edited, written in a format, and read again. The last byte says how.
fn whole(bytes: &[u8]) {
    let Some((&how, bytes)) = bytes.split_last() else {
        return;
    };
    let Some(session) = load("model", bytes) else { return };
    let Some(open) = session.open_model() else { return };
    let format = [ExportFormat::Glb, ExportFormat::D3d12, ExportFormat::D3d11][usize::from(how % 3)];
    let asked = |bit: u8| how >> bit & 1 == 1;
    let edits = Edits {
        fix: asked(2),
        reduce: asked(3).then_some(1e-3),
        close_loop_secs: asked(4).then_some(0.1),
        scale: asked(5).then_some(2.5),
        for_book: asked(6) && format != ExportFormat::Glb,
        ..Edits::default()
    };
    let what = ToExport {
        model: open.model.clone(),
        names: &JointNames::default(),
        changes: Vec::new(),
        losses: Vec::new(),
        edits,
        maps: session.maps(),
        format,
        writes_maps: asked(7),
        turns_green: false,
    };
    if let Ok(file) = ExportJob::new("model", what).run() {
        assert!(
            load(&file.name, &file.bytes).is_some(),
            "what was written as {format:?} cannot be read"
        );
    }
}

/// The largest model of a drop of one file, with its pictures.
fn load(name: &str, bytes: &[u8]) -> Option<Session> {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![File::new(name, bytes)]));
    session.open_model().is_some().then_some(session)
}
