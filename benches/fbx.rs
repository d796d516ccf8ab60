//! Reading FBX beside ufbx, a reader in C, in one run: a file of about 20 MB, binary and as text. Both make meshes of it; ours makes a model that is proved.
//! What inflating its arrays takes is told apart, and what the records with their numbers take.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use bindpose::fbx::{Budget, Record, parse};
use bindpose::import::import;
use criterion::{Criterion, criterion_group, criterion_main};
use ufbx::{InflateInput, InflateRetain, LoadOpts};

/// Quads along each side, so that either file has about 20 MB.
const SIDE_OF_BINARY: u32 = 500;
const SIDE_OF_TEXT: u32 = 256;

/// The arrays of a hilly sheet: positions, corners, normals of corners, texture coordinates, and indices of these.
struct Sheet {
    positions: Vec<f64>,
    corners: Vec<i32>,
    normals: Vec<f64>,
    tex_coords: Vec<f64>,
    tex_coord_indices: Vec<i32>,
}

impl Sheet {
    fn new(side: u32) -> Self {
        let points = || (0..=side).flat_map(move |y| (0..=side).map(move |x| [f64::from(x), f64::from(y)]));
        let height = |x: f64, y: f64| (x * 0.11).sin() * (y * 0.07).cos() * 5.0;
        let quads = (0..side).flat_map(|y| (0..side).map(move |x| y * (side + 1) + x));
        let corners: Vec<u32> = quads
            .flat_map(|at| [at, at + 1, at + side + 2, at + side + 1])
            .collect();
        let normal = |&at: &u32| {
            let [x, y] = [f64::from(at % (side + 1)), f64::from(at / (side + 1))];
            let slopes = [
                height(x + 0.01, y) - height(x - 0.01, y),
                height(x, y + 0.01) - height(x, y - 0.01),
            ];
            let length = (slopes[0].powi(2) + slopes[1].powi(2) + 4e-4).sqrt();
            [-slopes[0] / length, -slopes[1] / length, 0.02 / length]
        };
        let ends = |(place, &at): (usize, &u32)| if place % 4 == 3 { !(at as i32) } else { at as i32 };
        Self {
            positions: points().flat_map(|[x, y]| [x, y, height(x, y)]).collect(),
            normals: corners.iter().flat_map(normal).collect(),
            tex_coords: points()
                .flat_map(|[x, y]| [x, y].map(|at| at / f64::from(side)))
                .collect(),
            tex_coord_indices: corners.iter().map(|&at| at as i32).collect(),
            corners: corners.iter().enumerate().map(ends).collect(),
        }
    }

    fn text(&self) -> Vec<u8> {
        let mut file = String::from(
            "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\nObjects:  {\n\tGeometry: 1, \"Geometry::Sheet\", \"Mesh\" {\n",
        );
        fn array<T: std::fmt::Display>(file: &mut String, name: &str, numbers: &[T]) {
            write!(file, "{name}: *{} {{\na: ", numbers.len()).expect("a string");
            for (place, number) in numbers.iter().enumerate() {
                let comma = if place == 0 { "" } else { "," };
                write!(file, "{comma}{number}").expect("a string");
            }
            file.push_str("\n}\n");
        }
        array(&mut file, "Vertices", &self.positions);
        array(&mut file, "PolygonVertexIndex", &self.corners);
        file.push_str("LayerElementNormal: 0 {\nMappingInformationType: \"ByPolygonVertex\"\nReferenceInformationType: \"Direct\"\n");
        array(&mut file, "Normals", &self.normals);
        file.push_str("}\nLayerElementUV: 0 {\nMappingInformationType: \"ByPolygonVertex\"\nReferenceInformationType: \"IndexToDirect\"\n");
        array(&mut file, "UV", &self.tex_coords);
        array(&mut file, "UVIndex", &self.tex_coord_indices);
        file.push_str("}\nLayer: 0 {\nLayerElement:  {\nType: \"LayerElementNormal\"\nTypedIndex: 0\n}\nLayerElement:  {\nType: \"LayerElementUV\"\nTypedIndex: 0\n}\n}\n}\n\tModel: 2, \"Model::Sheet\", \"Mesh\" {\n\t}\n}\nConnections:  {\n\tC: \"OO\",1,2\n\tC: \"OO\",2,0\n}\n");
        file.into_bytes()
    }

    fn binary(&self) -> Vec<u8> {
        let mut file = Binary(b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0".to_vec());
        let layer = |file: &mut Binary, name: &str, reference: &str, arrays: &[(&str, Vec<u8>)]| {
            file.record(name, &[int(0)], |file| {
                file.record("MappingInformationType", &[text("ByPolygonVertex")], |_| ());
                file.record("ReferenceInformationType", &[text(reference)], |_| ());
                for (name, array) in arrays {
                    file.record(name, std::slice::from_ref(array), |_| ());
                }
            });
        };
        file.record("Objects", &[], |file| {
            file.record(
                "Geometry",
                &[long(1), text("Sheet\0\x01Geometry"), text("Mesh")],
                |file| {
                    file.record("Vertices", &[doubles(&self.positions)], |_| ());
                    file.record("PolygonVertexIndex", &[ints(&self.corners)], |_| ());
                    layer(
                        file,
                        "LayerElementNormal",
                        "Direct",
                        &[("Normals", doubles(&self.normals))],
                    );
                    let uv = [
                        ("UV", doubles(&self.tex_coords)),
                        ("UVIndex", ints(&self.tex_coord_indices)),
                    ];
                    layer(file, "LayerElementUV", "IndexToDirect", &uv);
                    file.record("Layer", &[int(0)], |file| {
                        for name in ["LayerElementNormal", "LayerElementUV"] {
                            file.record("LayerElement", &[], |file| {
                                file.record("Type", &[text(name)], |_| ());
                                file.record("TypedIndex", &[int(0)], |_| ());
                            });
                        }
                    });
                },
            );
            file.record("Model", &[long(2), text("Sheet\0\x01Model"), text("Mesh")], |_| ());
        });
        file.record("Connections", &[], |file| {
            file.record("C", &[text("OO"), long(1), long(2)], |_| ());
            file.record("C", &[text("OO"), long(2), long(0)], |_| ());
        });
        file.0.extend([0; 13]);
        file.0
    }
}

struct Binary(Vec<u8>);

impl Binary {
    fn record(&mut self, name: &str, values: &[Vec<u8>], inner: impl FnOnce(&mut Self)) {
        let start = self.0.len();
        let values_len: usize = values.iter().map(Vec::len).sum();
        self.0.extend([0; 4]);
        self.0.extend((values.len() as u32).to_le_bytes());
        self.0.extend((values_len as u32).to_le_bytes());
        self.0.push(name.len() as u8);
        self.0.extend(name.bytes());
        self.0.extend(values.concat());
        let before = self.0.len();
        inner(self);
        if self.0.len() > before {
            self.0.extend([0; 13]);
        }
        let end = (self.0.len() as u32).to_le_bytes();
        self.0[start..start + 4].copy_from_slice(&end);
    }
}

fn int(number: i32) -> Vec<u8> {
    [&b"I"[..], &number.to_le_bytes()].concat()
}

fn long(number: i64) -> Vec<u8> {
    [&b"L"[..], &number.to_le_bytes()].concat()
}

fn text(text: &str) -> Vec<u8> {
    [&b"S"[..], &(text.len() as u32).to_le_bytes(), text.as_bytes()].concat()
}

fn doubles(numbers: &[f64]) -> Vec<u8> {
    packed(
        b'd',
        numbers.len(),
        &numbers
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect::<Vec<_>>(),
    )
}

fn ints(numbers: &[i32]) -> Vec<u8> {
    packed(
        b'i',
        numbers.len(),
        &numbers
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect::<Vec<_>>(),
    )
}

fn packed(kind: u8, count: usize, bytes: &[u8]) -> Vec<u8> {
    let deflated = miniz_oxide::deflate::compress_to_vec_zlib(bytes, 1);
    let words = [count as u32, 1, deflated.len() as u32].map(u32::to_le_bytes).concat();
    [&[kind][..], &words, &deflated].concat()
}

/// All arrays of a record and of those in it are made, as far as they are no single numbers. Gives how many numbers there are.
fn numbers(record: &Record<'_>, budget: &Budget) -> usize {
    let own = record.numbers(budget).expect("it is sound").len();
    own + record.records.iter().map(|inner| numbers(inner, budget)).sum::<usize>()
}

fn records(bytes: &[u8]) -> usize {
    let budget = Budget::of_file(bytes.len());
    let document = parse(bytes).expect("it is sound");
    document.records.iter().map(|record| numbers(record, &budget)).sum()
}

/// Of what [`packed`] gives: what is deflated, and how long it was.
fn deflated(array: &[u8]) -> (&[u8], usize) {
    let size = if array[0] == b'd' { 8 } else { 4 };
    let count = u32::from_le_bytes([array[1], array[2], array[3], array[4]]) as usize;
    (&array[13..], count * size)
}

fn inflate(arrays: &[Vec<u8>]) {
    for (bytes, len) in arrays.iter().map(|array| deflated(array)) {
        let inflated = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(black_box(bytes), len);
        assert_eq!(black_box(inflated.expect("it is sound")).len(), len);
    }
}

fn inflate_by_ufbx(arrays: &[Vec<u8>]) {
    for (bytes, len) in arrays.iter().map(|array| deflated(array)) {
        let mut inflated = vec![0; len];
        let input = InflateInput {
            total_size: bytes.len(),
            data: bytes.as_ptr().cast(),
            data_size: bytes.len(),
            buffer: std::ptr::null_mut(),
            buffer_size: 0,
            read_fn: None,
            read_user: std::ptr::null_mut(),
            progress_cb: ufbx::RawProgressCb::default(),
            progress_interval_hint: 0,
            progress_size_before: 0,
            progress_size_after: 0,
            no_header: false,
            no_checksum: false,
            internal_fast_bits: 0,
        };
        let mut retain = InflateRetain {
            initialized: false,
            data: [0; 1024],
        };
        let came_out = ufbx::inflate(&mut inflated, black_box(&input), &mut retain);
        assert_eq!(came_out, black_box(&inflated).len() as isize);
    }
}

/// Seconds of each work, round by round, each in turn.
fn rounds<const WORKS: usize>(mut works: [&mut dyn FnMut(); WORKS]) -> Vec<[f64; WORKS]> {
    let mut round = || {
        works.each_mut().map(|work| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
    };
    // The first one warms up.
    round();
    (0..15).map(|_| round()).collect()
}

/// The round whose ratio of its first two is the median.
fn median<const WORKS: usize>(mut rounds: Vec<[f64; WORKS]>) -> [f64; WORKS] {
    rounds.sort_by(|a, b| (a[0] / a[1]).total_cmp(&(b[0] / b[1])));
    rounds[rounds.len() / 2]
}

#[expect(clippy::print_stdout, reason = "the ratio is what the benchmark is for")]
fn tell(what: &str, [ours, theirs]: [f64; 2]) {
    let ratio = ours / theirs;
    println!(
        "{what}: {:.0} ms, ufbx {:.0} ms; in one round: {ratio:.2}",
        ours * 1e3,
        theirs * 1e3
    );
}

fn reading(_: &mut Criterion) {
    let [of_binary, of_text] = [SIDE_OF_BINARY, SIDE_OF_TEXT].map(Sheet::new);
    for (name, bytes) in [("binary", of_binary.binary()), ("text", of_text.text())] {
        let model = import(&bytes).expect("it is sound").model;
        let scene = ufbx::load_memory(&bytes, LoadOpts::default()).expect("it is sound");
        assert_eq!(model.mesh.triangle_count(), scene.meshes[0].num_triangles);
        drop((model, scene));
        let by_ufbx = || ufbx::load_memory(black_box(&bytes), LoadOpts::default()).expect("it is sound");
        let found = median(rounds([
            &mut || drop(black_box(import(black_box(&bytes)).expect("it is sound"))),
            &mut || drop(black_box(by_ufbx())),
        ]));
        let megabytes = bytes.len() as f64 / 1e6;
        tell(&format!("reading {name} FBX of {megabytes:.1} MB"), found);
        let found = median(rounds([
            &mut || assert!(black_box(records(black_box(&bytes))) > 1000),
            &mut || drop(black_box(by_ufbx())),
        ]));
        tell("    its records and numbers alone, beside all of ufbx", found);
    }
    let arrays = [
        doubles(&of_binary.positions),
        ints(&of_binary.corners),
        doubles(&of_binary.normals),
        doubles(&of_binary.tex_coords),
        ints(&of_binary.tex_coord_indices),
    ];
    let found = median(rounds([&mut || inflate(&arrays), &mut || inflate_by_ufbx(&arrays)]));
    tell("    inflating the arrays of the binary one alone", found);
}

criterion_group!(benches, reading);
criterion_main!(benches);
