//! Files that are damaged, and such as are made to become much: reading them takes memory and time by their size.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

use bindpose::anim::CompiledClip;
use bindpose::import::import;

use crate::binary_fbx::{Binary, array, text};
use crate::measured;
use crate::shared::shared;

/// How many times the file reading it may hold at once, beside what a model of one triangle takes.
const MOST_GROWTH: u64 = 20;
const LEAST: u64 = 1 << 16;

/// How long reading one of these files may take. The slowest take some five seconds in a build with little optimisation. One on
/// which reading hangs, or looks through all for each, takes many minutes.
const MOST_TIME: Duration = Duration::from_secs(60);

/// The most that is held while some bytes are read, and their clips made ready to play.
fn peak_bytes(name: &str, bytes: &[u8]) -> u64 {
    let held = measured(|| match black_box(import(bytes)) {
        Ok(imported) => {
            assert!(imported.model.mesh.indices.len().is_multiple_of(3));
            drop(black_box(CompiledClip::all(&imported.model.clips)));
        }
        Err(refused) => assert!(!refused.error.message.is_empty(), "{name}"),
    });
    held.peak_bytes
}

#[test]
fn damaged_fbx_ends_soon_and_takes_no_more_memory_than_twenty_times_the_file() {
    let Some(folder) = shared("fbx/damaged") else { return };
    let paths = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let mut told = Vec::new();
    let mut count = 0;
    for path in paths.filter(|path| path.extension().is_some_and(|extension| extension == "fbx")) {
        let bytes = std::fs::read(&path).expect("a file");
        let name = path.display().to_string();
        let start = Instant::now();
        let peak_bytes = peak_bytes(&name, &bytes);
        let taken = start.elapsed();
        count += 1;
        if peak_bytes > LEAST + MOST_GROWTH * bytes.len() as u64 || taken > MOST_TIME {
            told.push(format!("{name}: {peak_bytes} and {taken:.1?} for {}", bytes.len()));
        }
    }
    assert!(told.is_empty(), "{} of {count}:\n{}", told.len(), told.join("\n"));
    assert!(count > 50, "{count}");
}

/// A file of text while it is made.
#[derive(Default)]
struct Made {
    objects: String,
    connections: String,
}

impl Made {
    /// A model of the number 1, on which all hangs.
    fn new() -> Self {
        let mut made = Self::default();
        made.object("Model", 1, "Mesh", "");
        made.hang(1, 0, "");
        made
    }

    fn object(&mut self, class: &str, id: usize, kind: &str, inner: &str) {
        writeln!(
            self.objects,
            "{class}: {id}, \"{class}::{id}\", \"{kind}\" {{\n{inner}\n}}"
        )
        .expect("a string");
    }

    fn hang(&mut self, child: usize, parent: usize, property: &str) {
        writeln!(self.connections, "C: \"OP\",{child},{parent},\"{property}\"").expect("a string");
    }

    fn file(&self) -> Vec<u8> {
        let Self { objects, connections } = self;
        format!("; FBX 7.4.0 project file\nObjects: {{\n{objects}}}\nConnections: {{\n{connections}}}\n").into_bytes()
    }
}

/// Materials on a model that has no maps but one.
fn materials(made: &mut Made, count: usize, property: &str) {
    made.object("Texture", 2, "", "FileName: \"a.png\"");
    made.hang(2, 1, property);
    for material in 100..100 + count {
        made.object("Material", material, "", "");
        made.hang(material, 1, "");
    }
}

/// Textures of one picture, each of a material of its own.
fn textures(made: &mut Made, count: usize, video: &str) {
    made.object("Video", 2, "Clip", video);
    for material in 100..100 + count {
        let texture = count + material;
        made.object("Material", material, "", "");
        made.hang(material, 1, "");
        made.object("Texture", texture, "", "");
        made.hang(texture, material, "DiffuseColor");
        made.hang(2, texture, "");
    }
}

/// Bones that are in the skins of all geometries, which have no polygons.
fn skins(made: &mut Made, count: usize) {
    made.object("Deformer", 2, "Skin", "");
    for geometry in 100..100 + count {
        let cluster = count + geometry;
        made.object(
            "Geometry",
            geometry,
            "Mesh",
            "Vertices: 0,0,0\nPolygonVertexIndex: 0,-1",
        );
        made.hang(geometry, 1, "");
        made.hang(2, geometry, "");
        made.object("Deformer", cluster, "Cluster", "");
        made.hang(cluster, 2, "");
        made.hang(1, cluster, "");
    }
}

/// Triangles on one model, as many as it has materials.
fn triangles(made: &mut Made, count: usize) {
    materials(made, count, "DiffuseColor");
    for geometry in 1000 + count..1000 + 2 * count {
        made.object(
            "Geometry",
            geometry,
            "Mesh",
            "Vertices: 0,0,0,1,0,0,0,1,0\nPolygonVertexIndex: 0,1,-3",
        );
        made.hang(geometry, 1, "");
    }
}

/// A chain of joints that inherit scale one way or another. One curve that swings out at each of its keys scales all of them.
fn scaled_chain(made: &mut Made, joints: usize, keys: usize, inherit: u8) {
    let list = |value: &dyn Fn(usize) -> usize| {
        (0..keys)
            .map(|key| value(key).to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    let curve = format!(
        "KeyTime: {}\nKeyValueFloat: {}\nKeyAttrFlags: 1032\nKeyAttrDataFloat: 0,0,0,0\nKeyAttrRefCount: {keys}",
        list(&|key| key * 46_186_000),
        list(&|key| 1 + key % 2),
    );
    made.object("AnimationStack", 2, "", "");
    made.object("AnimationLayer", 3, "", "");
    made.object("AnimationCurve", 4, "", &curve);
    made.hang(3, 2, "");
    for joint in 100..100 + joints {
        let node = joints + joint;
        let inherits = format!("Properties70: {{\nP: \"InheritType\", \"enum\", \"\", \"\",{inherit}\n}}");
        made.object("Model", joint, "LimbNode", &inherits);
        made.hang(joint, if joint == 100 { 1 } else { joint - 1 }, "");
        made.object("AnimationCurveNode", node, "", "");
        made.hang(node, 3, "");
        made.hang(node, joint, "Lcl Scaling");
        for axis in ["d|X", "d|Y", "d|Z"] {
            made.hang(4, node, axis);
        }
    }
}

/// A binary geometry with these arrays, and a model that has it.
fn binary(arrays: &[(&str, Vec<u8>)], normals: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut file = Binary::new(7400);
    let object = |id: u8, name: &str| [vec![b'L', id, 0, 0, 0, 0, 0, 0, 0], text(name), text("Mesh")].concat();
    let write = |to: &mut Binary, values: &[(&str, Vec<u8>)]| {
        for (name, value) in values {
            to.record(name, 1, value, None);
        }
    };
    let objects = |to: &mut Binary| {
        let inner = |to: &mut Binary| {
            write(to, arrays);
            to.record("LayerElementNormal", 0, &[], Some(&|to| write(to, normals)));
        };
        to.record("Geometry", 3, &object(2, "G\0\x01Geometry"), Some(&inner));
        to.record("Model", 3, &object(1, "M\0\x01Model"), Some(&|_| ()));
    };
    file.record("Objects", 0, &[], Some(&objects));
    let connection = [text("OO"), object(2, "")[..9].to_vec(), object(1, "")[..9].to_vec()].concat();
    file.record("Connections", 0, &[], Some(&|to| to.record("C", 3, &connection, None)));
    file.0.extend([0; 13]);
    file.0
}

fn deflated(kind: u8, count: u32, bytes: &[u8]) -> Vec<u8> {
    array(kind, count, true, &miniz_oxide::deflate::compress_to_vec_zlib(bytes, 6))
}

/// An outline of so many corners that lie in two places, each with another normal than those before it.
fn corners(count: u32) -> Vec<u8> {
    let bytes = |numbers: &mut dyn Iterator<Item = i32>| numbers.flat_map(i32::to_le_bytes).collect::<Vec<u8>>();
    let ends = bytes(&mut (1..count).map(|_| 0).chain([-1]));
    let normals = bytes(&mut (0..count as i32).map(|corner| corner % 100));
    let values: Vec<u8> = (0..300).flat_map(|number| f64::from(number).to_le_bytes()).collect();
    binary(
        &[
            ("Vertices", array(b'd', 3, false, &[0; 24])),
            ("PolygonVertexIndex", deflated(b'i', count, &ends)),
        ],
        &[
            ("MappingInformationType", text("ByPolygonVertex")),
            ("ReferenceInformationType", text("IndexToDirect")),
            ("Normals", deflated(b'd', 300, &values)),
            ("NormalsIndex", deflated(b'i', count, &normals)),
        ],
    )
}

#[test]
fn what_many_share_is_neither_copied_nor_looked_through_for_each() {
    /// What any file may hold: both its budgets, which have 64 MiB each, while lists of as much grow.
    const MOST_BYTES: u64 = 256 << 20;
    let made = |make: &dyn Fn(&mut Made)| {
        let mut made = Made::new();
        make(&mut made);
        made.file()
    };
    let long = "x".repeat(2 << 20);
    let mut told = Vec::new();
    for (name, bytes) in [
        (
            "a path of many textures",
            made(&|made| textures(made, 300, &format!("FileName: \"{long}\""))),
        ),
        (
            "a property of many materials",
            made(&|made| materials(made, 300, &long)),
        ),
        ("a skin of many geometries", made(&|made| skins(made, 2000))),
        (
            "a model with many materials and geometries",
            made(&|made| triangles(made, 40_000)),
        ),
        (
            "a picture with many records",
            made(&|made| textures(made, 20_000, &"A:\n".repeat(200_000))),
        ),
        (
            "a curve that swings, of a chain that inherits scale",
            made(&|made| scaled_chain(made, 64, 40_000, 1)),
        ),
        (
            "a curve that swings, of a chain that inherits scale on its own axes",
            made(&|made| scaled_chain(made, 64, 40_000, 0)),
        ),
        ("corners that all differ", corners(4_000_000)),
        (
            "bytes that become numbers",
            binary(&[("Vertices", deflated(b'b', 50_000_000, &vec![0; 50_000_000]))], &[]),
        ),
    ] {
        let start = Instant::now();
        let peak_bytes = peak_bytes(name, &bytes);
        let taken = start.elapsed();
        if peak_bytes > MOST_BYTES + MOST_GROWTH * bytes.len() as u64 || taken > MOST_TIME {
            told.push(format!(
                "{name}: {} MiB and {taken:.1?} for {}",
                peak_bytes >> 20,
                bytes.len()
            ));
        }
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}
