//! Reading FBX beside ufbx, a reader in C, in one run: a file of about 20 MB, binary and as text. Both make meshes of it; ours makes a model that is proved.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use bindpose::import::import;
use criterion::{Criterion, criterion_group, criterion_main};
use ufbx::LoadOpts;

/// Quads along each side.
const SIDE: u32 = 520;

/// The arrays of a hilly sheet: positions, corners, normals of corners, texture coordinates, and indices of these.
struct Sheet {
    positions: Vec<f64>,
    corners: Vec<i32>,
    normals: Vec<f64>,
    tex_coords: Vec<f64>,
    tex_coord_indices: Vec<i32>,
}

impl Sheet {
    fn new() -> Self {
        let points = || (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| [f64::from(x), f64::from(y)]));
        let height = |x: f64, y: f64| (x * 0.11).sin() * (y * 0.07).cos() * 5.0;
        let quads = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| y * (SIDE + 1) + x));
        let corners: Vec<u32> = quads
            .flat_map(|at| [at, at + 1, at + SIDE + 2, at + SIDE + 1])
            .collect();
        let normal = |&at: &u32| {
            let [x, y] = [f64::from(at % (SIDE + 1)), f64::from(at / (SIDE + 1))];
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
                .flat_map(|[x, y]| [x, y].map(|at| at / f64::from(SIDE)))
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

#[expect(clippy::print_stdout, reason = "the ratio is what the benchmark is for")]
fn reading(_: &mut Criterion) {
    let sheet = Sheet::new();
    for (name, bytes) in [("binary", sheet.binary()), ("text", sheet.text())] {
        let seconds = |work: &mut dyn FnMut()| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        };
        let model = import(&bytes).expect("it is sound").model;
        let scene = ufbx::load_memory(&bytes, LoadOpts::default()).expect("it is sound");
        assert_eq!(model.mesh.triangle_count(), scene.meshes[0].num_triangles);
        let mut ours = || drop(black_box(import(black_box(&bytes)).expect("it is sound")));
        let mut theirs = || {
            drop(black_box(
                ufbx::load_memory(black_box(&bytes), LoadOpts::default()).expect("it is sound"),
            ));
        };
        let mut rounds: Vec<[f64; 2]> = (0..15).map(|_| [seconds(&mut ours), seconds(&mut theirs)]).collect();
        rounds.sort_by(|a, b| (a[0] / a[1]).total_cmp(&(b[0] / b[1])));
        let [ours, theirs] = rounds[rounds.len() / 2];
        println!(
            "reading {name} FBX of {:.1} MB: {:.0} ms, ufbx {:.0} ms; in one round: {:.2}",
            bytes.len() as f64 / 1e6,
            ours * 1e3,
            theirs * 1e3,
            ours / theirs
        );
    }
}

criterion_group!(benches, reading);
criterion_main!(benches);
