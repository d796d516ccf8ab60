//! What a frame takes, computed from the sizes and the taps of its passes: the table in PERFORMANCE.md. `BLESS=1 cargo test --test gpu
//! performance` writes it anew. This needs no GPU.

use std::fmt::Write as _;
use std::path::Path;

use bindpose::render::for_tests::{CONTACT_BLURS, CONTACT_MAP_SIZE, SHADOW_TAPS, bytes_at_rest, half, occlusion_blurs};
use bindpose::render::{RendererOptions, SampleCount, Target};
use bindpose::scene::Light;
use bindpose::shaders::{self, JOINTS_PER_ROW, Program};

/// Parts of the picture that the model covers, and in which the ground is seen beside it.
const MODEL: f64 = 0.25;
const GROUND: f64 = 0.375;
/// Part of these where something may be in the way of the key.
const IN_SHADOW: f64 = 0.4;
/// The least fraction of the picture's sides while it moves on a slow device, and then with few samples; see `session/look/pacing.rs`. The
/// last step leaves ambient occlusion out, too.
const LEAST_SCALE: f64 = 0.5;

const SIZES: [[u32; 2]; 3] = [[1920, 1080], [2560, 1440], [3840, 2160]];

#[derive(Clone, Copy)]
struct Way {
    name: &'static str,
    lights: &'static [Light],
    /// A clip plays. Otherwise the camera moves alone.
    is_posed: bool,
}

#[rustfmt::skip]
const WAYS: [Way; 5] = [
    Way { name: "studio, a clip plays", lights: &[Light::Studio], is_posed: true },
    Way { name: "book, a clip plays", lights: &[Light::Book], is_posed: true },
    Way { name: "divided, a clip plays", lights: &[Light::Book, Light::Studio], is_posed: true },
    Way { name: "studio, the camera moves", lights: &[Light::Studio], is_posed: false },
    Way { name: "book, the camera moves", lights: &[Light::Book], is_posed: false },
];

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Taken {
    passes: u32,
    /// Texels and samples that are cleared or drawn.
    written: f64,
    /// Texels that shaders ask for; a filter's own reads are not counted.
    read: f64,
    /// Of both.
    bytes: f64,
    uploaded_bytes: usize,
}

impl Taken {
    /// All textures of a frame but the contact map have texels of four bytes.
    fn pass(&mut self, written: f64, read: f64) {
        self.pass_of(4.0, written, read);
    }

    fn pass_of(&mut self, bytes: f64, written: f64, read: f64) {
        self.passes += 1;
        self.written += written;
        self.read += read;
        self.bytes += bytes * (written + read);
    }
}

/// The value of a constant in a shader.
fn constant(program: Program, name: &str) -> f64 {
    let source = program.source();
    let (_, rest) = source.split_once(&format!("const {name}: i32 = ")).expect(name);
    let (value, _) = rest.split_once(';').expect(name);
    value.parse().expect(name)
}

/// Texels that the shader of ambient occlusion reads for one of its own.
fn occlusion_taps(light: Light, few: bool) -> f64 {
    let named = |program, name: &str| constant(program, &if few { format!("FEW_{name}") } else { name.to_owned() });
    1.0 + match light {
        Light::Studio => {
            let program = shaders::OCCLUSION_STUDIO;
            2.0 * named(program, "SLICES") * named(program, "STEPS")
        }
        Light::Book if few => constant(shaders::OCCLUSION_BOOK, "FEW_OFFSETS"),
        Light::Book => constant(shaders::OCCLUSION_BOOK, "OFFSET_COUNT"),
    }
}

/// A frame of this size in pixels, with all passes. `few`: as the coarsest step that still draws all of them.
fn taken(way: Way, size: [u32; 2], samples: SampleCount, few: bool) -> Taken {
    let mut taken = Taken::default();
    let area = |[width, height]: [u32; 2]| f64::from(width) * f64::from(height);
    let (pixels, halved) = (area(size), area(half(size)));
    let side = RendererOptions::default().shadow_map_side;
    let shadow_taps = f64::from(SHADOW_TAPS) * if few { 0.5 } else { 1.0 };
    // Colour and depth.
    taken.pass(2.0 * halved, 0.0);
    let share = 1.0 / way.lights.len() as f64;
    let mut read = 0.0;
    for &light in way.lights {
        // The studio's key stands beside the camera.
        if way.is_posed || light == Light::Studio {
            taken.pass(area([side; 2]), 0.0);
        }
        let taps = occlusion_taps(light, few);
        let reads = |taps: f64| halved * share * (MODEL * taps + (1.0 - MODEL));
        taken.pass(halved, reads(taps));
        let radius = constant(shaders::OCCLUSION_BLUR, "BLUR_RADIUS");
        // Normals and depth here and along the row, and occlusion along the row.
        let blur_taps = 1.0 + 2.0 * (2.0 * radius + 1.0);
        for _ in 0..2 * occlusion_blurs(light) {
            taken.pass(halved, reads(blur_taps));
        }
        if light == Light::Studio && way.is_posed {
            let texels = area([CONTACT_MAP_SIZE; 2]);
            // The middle, and each pair beside it.
            let pairs = shaders::CONTACT_BLUR.source().matches("* beside(").count();
            let taps = 1.0 + 2.0 * pairs as f64;
            let bytes = 2.0;
            taken.pass_of(bytes, texels, 0.0);
            for _ in 0..CONTACT_BLURS {
                taken.pass_of(bytes, texels, texels * taps);
            }
        }
        let is_studio = light == Light::Studio;
        let contact_taps = if is_studio { 1.0 } else { 0.0 };
        // The studio looks for what casts a shadow, and filters where something does.
        let shadow_taps = if is_studio {
            shadow_taps * (0.5 + IN_SHADOW)
        } else {
            shadow_taps
        };
        // Two maps, four texels of occlusion, and the reflection; under the studio its table for the environment and for the lamp.
        let on_model = 7.0 + 2.0 * contact_taps + shadow_taps;
        read += pixels * share * (MODEL * on_model + GROUND * (shadow_taps + contact_taps));
        taken.uploaded_bytes +=
            size_of::<shaders::Camera>() + size_of::<shaders::Light>() + size_of::<shaders::Ground>();
    }
    // Colour and depth of each sample, and what they are resolved to.
    let resolved = f64::from(u8::from(samples != SampleCount::One));
    taken.pass(pixels * (2.0 * f64::from(samples.count()) + resolved), read);
    taken.uploaded_bytes += Light::ALL.len() * size_of::<shaders::Environment>() + 3 * size_of::<shaders::Line>();
    // The model, for each corner of lines, and its highlight.
    taken.uploaded_bytes += (4 + 1) * size_of::<shaders::Instance>();
    if way.is_posed {
        // A row of bones.
        taken.uploaded_bytes += JOINTS_PER_ROW as usize * 3 * size_of::<[f32; 4]>();
    }
    taken
}

/// Passes, written and read texels in millions, and uploaded KiB of each of [`WAYS`] in each of [`SIZES`], by the same rules, as it was
/// before: all was drawn in each frame, once for each light, the background also behind the model, and blurs read where nothing is.
type Before = (u32, f64, f64, f64);
const BEFORE_STUDIO: [Before; 3] = [(11, 27.8, 61.7, 13.1), (11, 46.0, 105.9, 13.1), (11, 97.8, 232.0, 13.1)];
const BEFORE_BOOK: [Before; 3] = [(8, 28.6, 77.0, 13.1), (8, 47.5, 136.9, 13.1), (8, 101.7, 307.9, 13.1)];
const BEFORE_DIVIDED: [Before; 3] = [
    (18, 35.7, 71.9, 13.6),
    (18, 56.6, 123.9, 13.6),
    (18, 116.5, 272.5, 13.6),
];
const BEFORE: [[Before; 3]; 5] = [BEFORE_STUDIO, BEFORE_BOOK, BEFORE_DIVIDED, BEFORE_STUDIO, BEFORE_BOOK];

const HEADER: &str = "| what goes on | picture | passes | written, M | read, M | uploaded, KiB | with one sample written, M | read, M | written and read, MB | least written, M | least read, M |";

fn table() -> String {
    let mut table = format!("{HEADER}\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (way, before) in WAYS.into_iter().zip(BEFORE) {
        for (size, (passes, written, read, kib)) in SIZES.into_iter().zip(before) {
            let after = taken(way, size, SampleCount::Four, false);
            let plain = taken(way, size, SampleCount::One, false);
            let least_size = size.map(|side| (f64::from(side) * LEAST_SCALE) as u32);
            let least = taken(way, least_size, SampleCount::One, true);
            let millions = |texels: f64| texels * 1e-6;
            writeln!(
                table,
                "| {} | {} × {} | {passes} → {} | {written:.1} → {:.1} | {read:.1} → {:.1} | {kib:.1} → {:.1} | {:.1} | {:.1} | {:.0} | {:.1} | {:.1} |",
                way.name,
                size[0],
                size[1],
                after.passes,
                millions(after.written),
                millions(after.read),
                after.uploaded_bytes as f64 / 1024.0,
                millions(plain.written),
                millions(plain.read),
                millions(plain.bytes),
                millions(least.written),
                millions(least.read),
            )
            .expect("a string takes all");
        }
    }
    table
}

#[test]
fn the_table_in_performance_md_is_what_the_constants_say() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("PERFORMANCE.md");
    let text = std::fs::read_to_string(&path).expect("PERFORMANCE.md");
    let start = text.find(HEADER).expect("the table begins with its header");
    let end = start + text[start..].find("\n\n").expect("an empty line after it") + 1;
    let table = table();
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, [&text[..start], &table, &text[end..]].concat()).expect("writes it");
        return;
    }
    assert_eq!(&text[start..end], table, "BLESS=1 writes it anew");
}

/// Colour and depth, two means of half floats, normals with depth, ambient occlusion and the layer above: `at_rest.rs` proves that
/// these are all the textures that there are.
#[test]
fn pictures_at_rest_have_all_pixels_of_large_screens() {
    for size in [[3840, 2160], [5120, 2880]] {
        assert!(
            (Target::affordable_mean_scale(size) - 1.0).abs() < f32::EPSILON,
            "{size:?}"
        );
        assert!(
            Target::affordable_scale(size, SampleCount::Four) < 0.85,
            "while it moves it has fewer"
        );
    }
    assert!(Target::affordable_mean_scale([7680, 4320]) < 0.8);
    assert!(bytes_at_rest() <= 40, "{}", bytes_at_rest());
}

#[test]
fn a_moving_picture_of_1440_rows_stays_within_what_is_asked_for() {
    for way in WAYS {
        let taken = taken(way, [2560, 1440], SampleCount::One, false);
        // The books' light reads what the books say.
        let [most_written, most_read] = match way.lights {
            [Light::Studio] => [20e6, 70e6],
            _ => [26e6, 74e6],
        };
        assert!(
            taken.written <= most_written && taken.read <= most_read,
            "{}: {taken:?}",
            way.name
        );
    }
}
