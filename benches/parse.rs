//! Reading a file: the product beside the textbook, and beside three.js, in one run.
//!
//! The textbook splits on whitespace and calls `str::parse`, as the books' loaders do with `ifstream >>`. Both must give the
//! same document before anything is timed.

use std::hint::black_box;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};
use std::str::{FromStr, SplitAsciiWhitespace};
use std::time::Duration;

use bindpose::anim::CompiledClip;
use bindpose::check;
use bindpose::export::{MapImages, glb};
use bindpose::format::{
    AnimationClip, BoneAnimation, Dialect, Document, Keyframe, Material, Reflectance, Subset, Vertex, parse, write,
};
use bindpose::import;
use bindpose::model::JointNames;
use bindpose::session::{File, FileCommand, Session, load};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

#[expect(clippy::print_stdout, reason = "what was read belongs to how long it took")]
fn parsing(criterion: &mut Criterion) {
    let (name, bytes) = input();
    let parsed = parse(&bytes).expect("the input is sound");
    assert_eq!(
        parsed.document,
        Textbook::document(&bytes),
        "product and textbook must agree"
    );
    let Document {
        vertices, triangles, ..
    } = &parsed.document;
    println!(
        "parse/{name}: {} vertices and {} triangles, the same as the textbook's",
        vertices.len(),
        triangles.len()
    );

    let mut group = criterion.benchmark_group(format!("parse/{name}"));
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.measurement_time(Duration::from_secs(5)).sample_size(50);
    group.bench_function("product", |bencher| bencher.iter(|| parse(black_box(&bytes))));
    group.bench_function("textbook", |bencher| {
        bencher.iter(|| Textbook::document(black_box(&bytes)));
    });
    group.finish();
    let product = || drop(black_box(parse(black_box(&bytes))));
    report_ratio("parsing: textbook / product", product, || {
        drop(black_box(Textbook::document(black_box(&bytes))));
    });
    let import = || import::import(black_box(&bytes)).expect("the input is sound");
    report_ratio(
        "parsing, building and checking / parsing and building",
        || drop(black_box(import())),
        || {
            let imported = import();
            let compiled = CompiledClip::all(&imported.model.clips);
            drop(black_box(check::model(
                &imported.model,
                &compiled,
                &*imported.source.places(&bytes),
            )));
        },
    );
    let file = File::new("model.m3d", bytes.as_slice());
    report_ratio(
        "loading with the books' verdicts / without",
        || drop(black_box(load(&file))),
        || {
            let mut session = Session::new(true);
            session.apply(FileCommand::Add(vec![file.clone()]));
            drop(black_box(session));
        },
    );
    let model = import().model;
    report_ratio(
        "writing as .glb without maps / parsing and building",
        || drop(black_box(import())),
        || drop(black_box(glb(&model, &JointNames::default(), &MapImages::new()))),
    );
}

/// glTF beside three.js, which reads the same bytes in node, in the next moment of the same run. Without pictures: what a browser does
/// with them is no part of either. Our own reading makes a model that is proved, tangents included.
#[expect(clippy::print_stdout, reason = "a benchmark that cannot run says so")]
fn reading_gltf(_: &mut Criterion) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = root.join("../shared/gltf/models/CesiumMan.glb");
    let bare = Path::new(env!("CARGO_TARGET_TMPDIR")).join("CesiumMan-bare.glb");
    if !source.exists() {
        println!("reading glTF: {} is not there", source.display());
        return;
    }
    let node = Command::new("node")
        .arg(root.join("tests/browser/read_gltf.js"))
        .args([&source, &bare])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let mut node = match node {
        Ok(node) => node,
        Err(error) => {
            println!("reading glTF: node cannot be started: {error}");
            return;
        }
    };
    let mut asked = node.stdin.take().expect("it is piped");
    let mut told = BufReader::new(node.stdout.take().expect("it is piped")).lines();
    let mut line = || {
        told.next()
            .and_then(Result::ok)
            .expect("node answers; `npm ci` in tests/browser installs three.js")
    };
    assert_eq!(line(), "ready");
    let bytes = std::fs::read(&bare).expect("node has written it");
    let mut ours = || drop(black_box(import::import(black_box(&bytes)).expect("the file is sound")));
    let rounds: Vec<[f64; 2]> = (0..301)
        .map(|_| {
            writeln!(asked, "again").expect("node listens");
            let theirs = line().parse().expect("seconds");
            [seconds(&mut ours), theirs]
        })
        .collect();
    let [ours, theirs] = [0, 1].map(|side| median(rounds.iter().map(|round| round[side]).collect()) * 1e3);
    let ratio = median(rounds.iter().map(|[ours, theirs]| ours / theirs).collect());
    println!(
        "reading CesiumMan.glb without its picture: {ours:.3} ms, three.js {theirs:.3} ms; in one round: {ratio:.2}"
    );
    drop(asked);
    let _ = node.wait();
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Both in turn, so that what else the machine does falls on both: how many times as long as the first the second takes in one round,
/// median, least and greatest.
#[expect(clippy::print_stdout, reason = "the ratio is what the benchmark is for")]
fn report_ratio(name: &str, mut first: impl FnMut(), mut second: impl FnMut()) {
    const ROUNDS: usize = 31;
    let mut ratios: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let second = seconds(&mut second);
            second / seconds(&mut first)
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    let [low, median, high] = [0, ROUNDS / 2, ROUNDS - 1].map(|index| ratios[index]);
    println!("{name}, in one round: {median:.2} ({low:.2} to {high:.2})");
}

fn seconds(work: &mut impl FnMut()) -> f64 {
    let start = std::time::Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// The soldier where it is at hand, otherwise a document of its size.
fn input() -> (&'static str, Vec<u8>) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models/d3d12/soldier.m3d");
    match std::fs::read(path) {
        Ok(bytes) => ("soldier", bytes),
        Err(_) => ("generated", write(&soldier_sized()).into_bytes()),
    }
}

/// A document with as many rows as the soldier has, of numbers with as many digits.
fn soldier_sized() -> Document {
    const BONES: u32 = 58;
    let mut state = 0x2545_F491_u32;
    let mut next = move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    };
    let mut number = move |size: f32| (next() as f32 / u32::MAX as f32 - 0.5) * size;
    let vertices = (0..13_748)
        .map(|index: u32| Vertex {
            position: std::array::from_fn(|_| number(70.0)),
            tangent: [number(2.0), number(2.0), number(2.0), -1.0],
            normal: std::array::from_fn(|_| number(2.0)),
            tex_coords: std::array::from_fn(|_| number(2.0)),
            blend_weights: [number(0.5).abs(), number(0.5).abs(), 0.0, 0.0],
            blend_indices: [index % BONES, (index + 7) % BONES, 0, 0],
        })
        .collect::<Vec<_>>();
    let keyframe = |key: u16, number: &mut dyn FnMut(f32) -> f32| Keyframe {
        time_secs: f32::from(key) / 60.0,
        translation: std::array::from_fn(|_| number(40.0)),
        scale: [1.0; 3],
        rotation: std::array::from_fn(|_| number(2.0)),
    };
    Document {
        dialect: Dialect::D3d12,
        materials: vec![Material {
            name: "body".into(),
            diffuse: [1.0; 3],
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.05; 3],
                roughness: 0.5,
            },
            alpha_clip: false,
            type_name: "Skinned".into(),
            diffuse_map: Some("body_diff.dds".into()),
            normal_map: Some("body_norm.dds".into()),
        }],
        subsets: vec![Subset {
            id: 0,
            vertex_start: 0,
            vertex_count: 13_748,
            face_start: 0,
            face_count: 22_507,
        }],
        vertices,
        triangles: (0..22_507_u32)
            .map(|index| [0, 1, 2].map(|corner| (index / 2 + corner) % 13_748))
            .collect(),
        bone_offsets: (0..BONES).map(|_| std::array::from_fn(|_| number(50.0))).collect(),
        bone_parents: (-1..57).collect(),
        clips: vec![AnimationClip {
            name: "Take1".into(),
            bones: (0..BONES)
                .map(|_| BoneAnimation {
                    keyframes: (0..76).map(|key| keyframe(key, &mut number)).collect(),
                })
                .collect(),
        }],
    }
}

/// The books' loader in Rust: every word is a token, labels are passed, nothing is checked.
struct Textbook<'a> {
    words: SplitAsciiWhitespace<'a>,
}

impl<'a> Textbook<'a> {
    fn document(bytes: &'a [u8]) -> Document {
        let mut book = Self {
            words: std::str::from_utf8(bytes)
                .expect("the input is text")
                .split_ascii_whitespace(),
        };
        book.pass(1);
        let [materials, vertices, triangles, bones, clips] = [(); 5].map(|()| book.after_label::<usize>());
        book.pass(1);
        let materials = (0..materials).map(|_| book.material()).collect();
        book.pass(1);
        let mut document = Document {
            dialect: Dialect::D3d12,
            materials,
            ..Document::default()
        };
        for _ in 0..document.materials.len() {
            let [id, vertex_start, vertex_count, face_start, face_count] = [(); 5].map(|()| book.after_label());
            document.subsets.push(Subset {
                id,
                vertex_start,
                vertex_count,
                face_start,
                face_count,
            });
        }
        book.pass(1);
        document.vertices = (0..vertices).map(|_| book.vertex()).collect();
        book.pass(1);
        document.triangles = (0..triangles).map(|_| book.several()).collect();
        book.pass(1);
        document.bone_offsets = (0..bones).map(|_| book.labelled()).collect();
        book.pass(1);
        document.bone_parents = (0..bones).map(|_| book.after_label()).collect();
        book.pass(1);
        document.clips = (0..clips).map(|_| book.clip(bones)).collect();
        document
    }

    fn pass(&mut self, words: usize) {
        for _ in 0..words {
            self.words.next();
        }
    }

    fn value<T: FromStr>(&mut self) -> T {
        self.words
            .next()
            .and_then(|word| word.parse().ok())
            .expect("the input is sound")
    }

    fn several<T: FromStr, const N: usize>(&mut self) -> [T; N] {
        std::array::from_fn(|_| self.value())
    }

    fn after_label<T: FromStr>(&mut self) -> T {
        self.pass(1);
        self.value()
    }

    fn labelled<T: FromStr, const N: usize>(&mut self) -> [T; N] {
        self.pass(1);
        self.several()
    }

    fn material(&mut self) -> Material {
        let name = self.after_label();
        let diffuse = self.labelled();
        let fresnel0 = self.labelled();
        let roughness = self.after_label();
        Material {
            name,
            diffuse,
            reflectance: Reflectance::Fresnel { fresnel0, roughness },
            alpha_clip: self.after_label::<u8>() != 0,
            type_name: self.after_label(),
            diffuse_map: Some(self.after_label()),
            normal_map: Some(self.after_label()),
        }
    }

    fn vertex(&mut self) -> Vertex {
        Vertex {
            position: self.labelled(),
            tangent: self.labelled(),
            normal: self.labelled(),
            tex_coords: self.labelled(),
            blend_weights: self.labelled(),
            blend_indices: self.labelled(),
        }
    }

    fn clip(&mut self, bones: usize) -> AnimationClip {
        let name = self.after_label();
        self.pass(1);
        let bones = (0..bones).map(|_| self.bone_animation()).collect();
        self.pass(1);
        AnimationClip { name, bones }
    }

    fn bone_animation(&mut self) -> BoneAnimation {
        self.pass(1);
        let count = self.after_label::<usize>();
        self.pass(1);
        let keyframes = (0..count)
            .map(|_| Keyframe {
                time_secs: self.after_label(),
                translation: self.labelled(),
                scale: self.labelled(),
                rotation: self.labelled(),
            })
            .collect();
        self.pass(1);
        BoneAnimation { keyframes }
    }
}

criterion_group!(benches, parsing, reading_gltf);
criterion_main!(benches);
