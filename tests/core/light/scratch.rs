use bindpose::light::studio::*;
use bindpose::light::tone_map::*;
use bindpose::light::*;
use glam::*;
use std::time::Instant;

#[test]
fn pictures() {
    let out = "/tmp/light";
    let t = Instant::now();
    let studio = Environment::studio();
    eprintln!("studio {:?} average {}", t.elapsed(), studio.average());
    let t = Instant::now();
    let prefiltered = Prefiltered::of(&studio);
    eprintln!("prefilter {:?}", t.elapsed());
    let t = Instant::now();
    let table = BrdfTable::new(32);
    eprintln!("table {:?}", t.elapsed());
    let big = Environment::from_fn(128, |d| studio.sample(d));
    let t = Instant::now();
    let _ = Prefiltered::of(&big);
    eprintln!("prefilter 128 {:?}", t.elapsed());
    for (n, e) in [("studio", &studio), ("daylight", &Environment::daylight())] {
        let (w, h) = (768u32, 384u32);
        let mut px = vec![];
        for y in 0..h {
            for x in 0..w {
                let a = (x as f32 + 0.5) / w as f32 * std::f32::consts::TAU; // middle = +z
                let el = (0.5 - (y as f32 + 0.5) / h as f32) * std::f32::consts::PI;
                let d = Vec3::new(-el.cos() * a.sin(), el.sin(), -el.cos() * a.cos());
                let c = tone_mapped(e.sample(d) * if n == "studio" { 0.5 } else { 1.0 });
                px.extend(srgb(c));
            }
        }
        std::fs::write(
            format!("{out}/{n}.png"),
            bindpose::image::encode_png(&px, w, h).unwrap(),
        )
        .unwrap();
    }
    for n in [
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::NEG_Z,
        Vec3::Z,
        Vec3::X,
        Vec3::NEG_X,
        vec3(0.64, 0.74, -0.34),
    ] {
        eprintln!("irradiance {n}: {}", prefiltered.irradiance().towards(n.normalize()));
    }
    let s = Surroundings {
        prefiltered: &prefiltered,
        brdf_table: &table,
        turn: (1.0, 0.0),
        intensity: 1.0,
    };
    // columns: roughness; rows: materials
    let roughs = [0.08, 0.2, 0.35, 0.5, 0.7, 1.0];
    let mats = [
        (vec3(0.6, 0.42, 0.33), Vec3::splat(0.04)),
        (vec3(0.12, 0.13, 0.15), Vec3::splat(0.04)),
        (vec3(0.23, 0.28, 0.17), Vec3::splat(0.04)),
        (Vec3::splat(0.8), Vec3::splat(0.04)),
        (Vec3::ZERO, vec3(0.95, 0.93, 0.88)),
        (Vec3::ZERO, vec3(1.0, 0.77, 0.34)),
    ];
    let r = 150usize;
    let (w, h) = (r * roughs.len(), r * mats.len());
    let mut px = vec![];
    for y in 0..h {
        for x in 0..w {
            let (m, q) = (mats[y / r], roughs[x / r]);
            let fx = ((x % r) as f32 + 0.5) / r as f32 * 2.2 - 1.1;
            let fy = -(((y % r) as f32 + 0.5) / r as f32 * 2.2 - 1.1);
            let rr = fx * fx + fy * fy;
            let bg = Vec3::splat(0.035);
            let mut c = bg;
            if rr < 1.0 {
                let n = vec3(fx, fy, -(1.0 - rr).sqrt());
                let to_key = vec3(0.64, 0.74, -0.34).normalize();
                let surface = StudioSurface {
                    albedo: m.0,
                    fresnel0: m.1,
                    roughness: q,
                    normal: n,
                    smooth_normal: n,
                    to_eye: Vec3::NEG_Z,
                    ambient_occlusion: 1.0,
                };
                let f = n.dot(to_key);
                let t = (f / 0.4).clamp(0.0, 1.0);
                let lights = StudioLights {
                    to_key,
                    key_color: KEY_COLOR,
                    key_visible: t * t * (3.0 - 2.0 * t),
                    to_rim: vec3(-0.72, 0.36, 0.58).normalize(),
                    rim_color: RIM_COLOR,
                };
                c = tone_mapped(s.studio_light(&surface, &lights));
            }
            px.extend(srgb(c));
        }
    }
    std::fs::write(
        format!("{out}/spheres.png"),
        bindpose::image::encode_png(&px, w as u32, h as u32).unwrap(),
    )
    .unwrap();
}
fn srgb(c: Vec3) -> [u8; 4] {
    let f = |v: f32| {
        let v = v.clamp(0.0, 1.0);
        ((if v < 0.0031308 {
            v * 12.92
        } else {
            1.055 * v.powf(1.0 / 2.4) - 0.055
        }) * 255.0)
            .round() as u8
    };
    [f(c.x), f(c.y), f(c.z), 255]
}
