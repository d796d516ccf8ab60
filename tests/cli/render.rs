//! `bindpose render`, on both backends. Without an adapter these fail and say what to install.

use std::path::Path;

use image::RgbaImage;

use crate::program::{FIGURE, Run, bindpose, fixture, run, run_command, scratch, scratch_folder, shared, words};

/// Draws, and gives the picture with what was printed.
pub(crate) fn draw(name: &str, file: &str, arguments: &[&str]) -> (RgbaImage, String) {
    let path = scratch(name);
    let path = path.to_str().expect("UTF-8");
    let printed = run(["render", file, "-o", path].iter().chain(arguments)).fine();
    let picture = image::open(path).expect("is a picture").into_rgba8();
    (picture, printed)
}

/// Share of the pixels in which some channel differs by more than `tolerance`.
pub(crate) fn share_that_differs(a: &RgbaImage, b: &RgbaImage, tolerance: u8) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let differs = a
        .pixels()
        .zip(b.pixels())
        .filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > tolerance));
    differs.count() as f64 / f64::from(a.width() * a.height())
}

/// Columns and rows that hold something, of a picture with nothing behind: left, right, top, bottom.
pub(crate) fn extent(picture: &RgbaImage) -> Option<[u32; 4]> {
    // A shadow on the ground is black.
    let is_model = |[red, green, blue, alpha]: [u8; 4]| alpha > 127 && [red, green, blue] != [0; 3];
    let covered = picture.enumerate_pixels().filter(|(_, _, pixel)| is_model(pixel.0));
    covered.fold(None, |extent, (x, y, _)| {
        let [left, right, top, bottom] = extent.unwrap_or([x, x, y, y]);
        Some([left.min(x), right.max(x), top.min(y), bottom.max(y)])
    })
}

fn a_framed_figure(backend: &str) {
    let name = format!("framed-{backend}.png");
    let (picture, printed) = draw(
        &name,
        FIGURE,
        &words(&format!(
            "--backend {backend} --size 301x200 --clip Wave --time 0.4 --view front --transparent"
        )),
    );
    assert_eq!(picture.dimensions(), (301, 200));
    assert!(
        printed.contains(&name) && printed.contains("301x200, Wave at 0.4 s"),
        "{printed}"
    );

    // The whole clip is framed, so that a single pose fills a good part of the height and leaves a margin.
    let [left, right, top, bottom] = extent(&picture).expect("something is drawn");
    assert!(bottom - top > 120 && top > 2 && bottom < 198, "{top} to {bottom}");
    assert!(left > 60 && right < 240, "{left} to {right}");
    assert_eq!(picture.get_pixel(0, 0).0, [0, 0, 0, 0]);
}

#[test]
fn a_figure_is_framed_on_vulkan() {
    a_framed_figure("vulkan");
}

#[test]
fn a_figure_is_framed_on_gl() {
    a_framed_figure("gl");
}

#[test]
fn a_crowd_is_said_and_framed() {
    let alone = ["--size", "200x150", "--transparent"];
    let (one, printed) = draw("crowd-1.png", FIGURE, &alone);
    assert!(!printed.contains("instances"), "{printed}");
    let (three, printed) = draw(
        "crowd-3.png",
        FIGURE,
        &[&alone[..], &["--crowd", "3", "--seed", "7"]].concat(),
    );
    assert!(printed.contains(" s, 3 instances, drawn by"), "{printed}");
    // They stand beside each other, and all have room in the picture.
    let [one, three] = [&one, &three].map(|picture| extent(picture).expect("something is drawn"));
    let [left, right, top, bottom] = three;
    assert!(right - left > one[1] - one[0], "{one:?} {three:?}");
    assert!(left > 0 && top > 0 && right < 199 && bottom < 149, "{three:?}");
}

fn same_frame_twice(backend: &str) -> RgbaImage {
    let line = format!("--backend {backend} --size 320x180 --clip Walk --time 0.3");
    let arguments = words(&line);
    let (first, _) = draw(&format!("first-{backend}.png"), FIGURE, &arguments);
    let (second, _) = draw(&format!("second-{backend}.png"), FIGURE, &arguments);
    assert_eq!(first, second, "the same time gives the same picture");
    first
}

#[test]
fn both_backends_draw_the_same_picture() {
    let (vulkan, gl) = (same_frame_twice("vulkan"), same_frame_twice("gl"));
    // Two rasterisers differ along edges.
    let differs = share_that_differs(&vulkan, &gl, 24);
    assert!(differs < 0.01, "{differs}");
}

/// Each option against the plain picture: by how much of it that must at least differ.
#[test]
fn every_option_changes_the_picture() {
    let plain = ["--size", "320x180", "--clip", "Walk"];
    let (picture, _) = draw("plain.png", FIGURE, &plain);
    for (name, more, at_least) in [
        ("time.png", &["--time", "0.3"][..], 0.005),
        ("side.png", &["--view", "right"], 0.01),
        ("top.png", &["--view", "top"], 0.1),
        ("light.png", &["--theme", "light"], 0.5),
        ("no-grid.png", &["--no-grid"], 0.002),
        ("transparent.png", &["--transparent"], 0.5),
        ("aperture.png", &["--aperture", "0.3"], 0.01),
        ("one-sample.png", &["--samples", "1"], 0.002),
    ] {
        let (other, _) = draw(name, FIGURE, &[&plain[..], more].concat());
        let differs = share_that_differs(&picture, &other, 2);
        assert!(differs >= at_least, "{name}: {differs}");
    }
    let (explicit, _) = draw(
        "explicit.png",
        FIGURE,
        &[&plain[..], &["--view", "three-quarter", "--theme", "dark"]].concat(),
    );
    assert_eq!(picture, explicit, "the defaults are what they say");
}

/// The mean of 16 where the CPU draws and for each of many pictures, else of 64; of as many as are asked for.
#[test]
fn a_picture_is_the_mean_of_as_many_samples_as_are_said() {
    let plain = words("--size 96x72 --clip Walk");
    let with = |name: &str, more: &str| draw(name, FIGURE, &[&plain[..], &words(more)].concat());
    let (unsaid, printed) = with("samples-unsaid.png", "");
    let [few, many] = [16, 64].map(|count| with(&format!("samples-{count}.png"), &format!("--samples {count}")).0);
    assert_ne!(few, many);
    let is_software = printed.contains("llvmpipe");
    assert!(unsaid == if is_software { few } else { many }, "{printed}");

    let folder = |more: &str| {
        let folder = scratch_folder(&format!("samples{more}"));
        let path = folder.to_str().expect("UTF-8");
        let arguments = words("--size 96x72 --clip Walk --frames 2");
        run(["render", FIGURE, "-o", path]
            .iter()
            .chain(&arguments)
            .chain(&words(more)))
        .fine();
        let first = folder.join("frame-0000.png");
        image::open(first).expect("is a picture").into_rgba8()
    };
    let [unsaid, few, many] = ["", "--samples 16", "--samples 64"].map(folder);
    assert!(unsaid == few && unsaid != many);
}

/// Also models without clips, without bones, with their z up.
#[test]
fn any_model_is_drawn() {
    for (name, file) in [
        ("static.png", "good/d3d11_static.m3d"),
        ("imm.png", "good/imm_skinned.m3d"),
    ] {
        let (picture, _) = draw(
            name,
            &fixture(file),
            &["--size", "64x64", "--transparent", "--view", "isometric"],
        );
        assert!(extent(&picture).is_some(), "{file}");
    }
    let Some(soldier) = shared("models/d3d12/soldier.m3d") else {
        return;
    };
    let (picture, _) = draw(
        "soldier.png",
        &soldier,
        &["--size", "200x300", "--transparent", "--view", "front"],
    );
    let [left, right, top, bottom] = extent(&picture).expect("something is drawn");
    assert!(bottom - top > 200 && bottom - top > right - left, "he stands upright");
}

#[test]
fn a_picture_that_no_gpu_draws_is_refused() {
    // No process has the memory of the last, but the GPU is asked first.
    for (size, why) in ["100000x10", "10x100000", "4000000000x4000000000"].map(|size| (size, "pixels a side")) {
        let path = scratch(&format!("large-{size}.png"));
        let run = run(["render", FIGURE, "-o", path.to_str().expect("UTF-8"), "--size", size]);
        run.refused(2);
        let told = format!("error: a picture of {} pixels is too large", size.replace('x', " × "));
        assert!(run.err.contains(&told) && run.err.contains(why), "{}", run.err);
        assert!(!path.exists());
    }
}

/// What is drawn again and again beside the model is not seen: rows of which the first is the first of a band.
#[test]
fn a_large_picture_is_drawn_in_bands_without_seams() {
    const FIRST_OF_BAND: u32 = 1024;
    let more = [
        "--size",
        "16384x1216",
        "--samples",
        "1",
        "--view",
        "front",
        "--transparent",
        "--no-grid",
    ];
    let (picture, said) = draw("bands.png", FIGURE, &more);
    assert_eq!(picture.dimensions(), (16384, 1216), "{said}");
    let [left, right, _, bottom] = extent(&picture).expect("something is drawn");
    assert!(bottom > FIRST_OF_BAND + 20, "the feet are in the second band: {bottom}");
    let steps = |row: u32| -> u32 {
        let step = |x| {
            picture
                .get_pixel(x, row - 1)
                .0
                .into_iter()
                .zip(picture.get_pixel(x, row).0)
                .map(|(a, b)| u32::from(a.abs_diff(b)))
                .sum::<u32>()
        };
        (left..right).map(step).sum()
    };
    let around = (2..10)
        .map(|away| steps(FIRST_OF_BAND - away).max(steps(FIRST_OF_BAND + away)))
        .max();
    assert!(
        steps(FIRST_OF_BAND) <= around.unwrap_or_default() * 3 / 2,
        "{} beside {around:?}",
        steps(FIRST_OF_BAND)
    );
}

/// A software GPU has the memory that the process may have.
#[cfg(target_os = "linux")]
#[test]
fn a_picture_that_the_gpu_has_no_memory_for_is_refused_and_never_empty() {
    const MOST_KILOBYTES: &str = "1400000";
    let path = scratch("no-memory.png");
    let mut command = std::process::Command::new("sh");
    command
        .args(["-c", &format!("ulimit -v {MOST_KILOBYTES}; exec \"$0\" \"$@\"")])
        .arg(env!("CARGO_BIN_EXE_bindpose"))
        .args(["render", FIGURE, "--size", "8192x8192", "--backend", "vulkan", "-o"])
        .arg(&path);
    let run = run_command(&mut command);
    run.refused(2);
    let told = "error: a picture of 8192 × 8192 pixels needs about 705 MB of the GPU's memory, and less is free: a smaller one \
                may be drawn";
    assert!(run.err.contains(told), "{}", run.err);
    assert!(!path.exists());
}

/// Where the loader finds no driver, the package to install is named; GL stands in unless Vulkan was asked for.
#[cfg(target_os = "linux")]
#[test]
fn a_missing_driver_is_named_with_its_package() {
    let without_vulkan = |name: &str, more: &[&str]| {
        let path = scratch(name);
        let mut command = bindpose();
        command
            .args(["render", FIGURE, "--size", "32x32", "-o"])
            .arg(path)
            .args(more);
        run_command(
            command
                .env("VK_DRIVER_FILES", "/nowhere")
                .env("VK_ICD_FILENAMES", "/nowhere"),
        )
    };
    let asked = without_vulkan("asked.png", &["--backend", "vulkan"]);
    asked.refused_with(2, "apt-get install mesa-vulkan-drivers");
    let instead = without_vulkan("instead.png", &[]).fine();
    assert!(instead.contains("(GL)"), "{instead}");
}

/// A machine without a desktop has no such folder, and Mesa's layers complain of it.
#[test]
fn drivers_say_nothing_where_all_is_well() {
    for backend in ["vulkan", "gl"] {
        let path = scratch(&format!("quiet-{backend}.png"));
        let mut command = bindpose();
        command.args(["render", FIGURE, "--size", "16x16", "--backend", backend, "-o"]);
        let run = run_command(command.arg(path).env_remove("XDG_RUNTIME_DIR"));
        assert_eq!((run.code, run.err.as_str()), (Some(0), ""), "{backend}");
    }
}

/// Draws the fixture whose material names `skin_diff.dds` and `skin_norm.dds`.
fn draw_skin(folder: &Path, more: &[&str]) -> Run {
    let path = folder.with_extension("png");
    let mut command = bindpose();
    let file = fixture("good/bones_child_first.m3d");
    command.args(["render", &file, "--size", "16x16", "-o"]);
    let run = run_command(command.arg(&path).arg("--textures").arg(folder).args(more));
    assert!(path.is_file(), "{run:?}");
    std::fs::remove_file(path).expect("was written");
    run
}

fn save_texel(path: impl AsRef<Path>) {
    let grey = RgbaImage::from_pixel(1, 1, image::Rgba([128, 128, 255, 255]));
    grey.save(path).expect("writes");
}

#[test]
fn maps_that_lack_are_told_and_can_be_denied() {
    let folder = scratch_folder("lacking");
    let normal_map = folder.join("skin_norm.dds");
    std::fs::write(&normal_map, "DDS ").expect("writes");
    let model = fixture("good/bones_child_first.m3d");
    let told = format!(
        "{model}: warning[map-missing]: No file fits the diffuse map \"skin_diff.dds\" of material \"skin\".\n\
         {}: warning[dds-header-cut]: the DDS header takes 128 bytes, and the file has 4\n",
        normal_map.display()
    );
    let deny = ["--deny", "missing-maps"];
    for (more, code) in [(&[][..], 0), (&deny, 1)] {
        let run = draw_skin(&folder, more);
        assert_eq!((run.code, run.err.as_str()), (Some(code), told.as_str()), "{more:?}");
    }

    save_texel(folder.join("SKIN_DIFF.png"));
    std::fs::remove_file(&normal_map).expect("was written");
    save_texel(folder.join("skin_norm.png"));
    let complete = draw_skin(&folder, &deny);
    assert_eq!((complete.code, complete.err.as_str()), (Some(0), ""));

    let nowhere_to_look = run([&["render", &model, "-o", "nothing.png"], &deny[..]].concat());
    assert_eq!(nowhere_to_look.code, Some(2));
}

/// Pipes without a writer, links to nothing, to folders and round in circles; and a file that no memory holds.
#[cfg(target_os = "linux")]
#[test]
fn only_files_with_the_names_of_maps_are_read_from_a_folder() {
    use std::os::unix::fs::symlink;

    let folder = scratch("hazards");
    let elsewhere = scratch("elsewhere");
    for folder in [&folder, &elsewhere] {
        std::fs::create_dir_all(folder).expect("makes a folder");
    }
    save_texel(elsewhere.join("skin_diff.png"));
    symlink(&elsewhere, folder.join("linked")).expect("links");
    symlink(&folder, elsewhere.join("back")).expect("links");
    symlink(&folder, folder.join("circle")).expect("links");
    symlink("itself.png", folder.join("itself.png")).expect("links");
    symlink("/no/such/file", folder.join("nowhere.txt")).expect("links");
    let unnamed = std::fs::File::create(folder.join("unnamed.png")).expect("makes a file");
    unnamed.set_len(1 << 40).expect("takes no place");
    for name in ["pipe.png", "skin_diff.png", "skin_norm.dds"] {
        let made = std::process::Command::new("mkfifo").arg(folder.join(name)).status();
        assert!(made.expect("coreutils are there").success());
    }

    let run = draw_skin(&folder, &["--deny", "missing-maps"]);
    let at = |name: &str| folder.join(name).display().to_string();
    let told = [
        format!(
            "{}: warning[link-broken]: The link cannot be followed: Too many levels of symbolic links (os error 40); skipped.",
            at("itself.png")
        ),
        format!(
            "{}: warning[link-broken]: The link cannot be followed: No such file or directory (os error 2); skipped.",
            at("nowhere.txt")
        ),
        format!(
            "{}: warning[not-a-file]: This is no regular file; skipped.",
            at("skin_diff.png")
        ),
        format!(
            "{}: warning[not-a-file]: This is no regular file; skipped.",
            at("skin_norm.dds")
        ),
        format!(
            "{}: warning[map-missing]: No file fits the normal map \"skin_norm.dds\" of material \"skin\".",
            fixture("good/bones_child_first.m3d")
        ),
    ];
    assert_eq!(run.err.lines().collect::<Vec<_>>(), told);
    assert_eq!(run.code, Some(1), "the pipe is no map");
}

#[test]
fn textures_of_a_folder_are_drawn_at_any_depth() {
    let text = std::fs::read_to_string(FIGURE).expect("the sample is there");
    let line = text
        .lines()
        .find(|line| line.starts_with("DiffuseMap:"))
        .expect("a material");
    let model = scratch("mapped.m3d");
    std::fs::write(&model, text.replacen(line, "DiffuseMap: Coat.dds", 1)).expect("writes");
    let folder = scratch("art");
    std::fs::create_dir_all(folder.join("deep")).expect("makes a folder");
    let red = RgbaImage::from_pixel(4, 4, image::Rgba([200, 10, 10, 255]));
    red.save(folder.join("deep/coat.png")).expect("writes");

    let model = model.to_str().expect("UTF-8");
    let folder = folder.to_str().expect("UTF-8");
    let size = ["--size", "200x150"];
    let (without, _) = draw("unmapped.png", model, &size);
    let (with, _) = draw("mapped.png", model, &[&size[..], &["--textures", folder]].concat());
    assert!(share_that_differs(&without, &with, 16) > 0.02);
    let missing = run(["render", model, "-o", "nothing.png", "--textures", "/no/such/folder"]);
    assert_eq!(missing.code, Some(2));
}

#[test]
fn a_cube_map_is_the_sky_by_its_own_option_and_only_noted_among_textures() {
    let folder = scratch_folder("skies");
    let sky = folder.join("dusk.dds");
    let faces = [200, 40, 20, 255].repeat(6 * 4 * 4);
    let header = cube_header(4);
    std::fs::write(&sky, [&header[..], &faces].concat()).expect("writes");
    let sky = sky.to_str().expect("UTF-8");
    let size = ["--size", "64x48"];
    let plain = draw("plain.png", FIGURE, &size).0;
    let with_sky = draw("with_sky.png", FIGURE, &[&size[..], &["--sky", sky]].concat()).0;
    let corner = with_sky.get_pixel(1, 1).0;
    assert!(
        corner[0] > 120 && corner[0] > 2 * corner[1].max(corner[2]),
        "{corner:?}"
    );
    assert!(share_that_differs(&plain, &with_sky, 16) > 0.3);

    let output = scratch("noted.png");
    let arguments = ["render", FIGURE, "-o", output.to_str().expect("UTF-8"), "--textures"];
    let noted = run([&arguments[..], &[folder.to_str().expect("UTF-8")], &size].concat());
    let line = format!("{sky}: note[map-is-cube]: This is a cube map; --sky takes it.\n");
    assert!(noted.code == Some(0) && noted.err.contains(&line), "{noted:?}");
    let drawn = image::open(&output).expect("is a picture").into_rgba8();
    assert!(share_that_differs(&plain, &drawn, 2) < 0.001, "it is not the sky");

    // The same light as a panorama.
    let panorama = folder.join("dusk.hdr");
    let texels = [145, 5, 1, 128].repeat(16 * 8);
    std::fs::write(&panorama, [b"#?RADIANCE\n\n-Y 8 +X 16\n", &texels[..]].concat()).expect("writes");
    let panorama = panorama.to_str().expect("UTF-8");
    let of_panorama = draw("panorama.png", FIGURE, &[&size[..], &["--sky", panorama]].concat()).0;
    assert!(share_that_differs(&with_sky, &of_panorama, 4) < 0.01);

    save_texel(folder.join("flat.png"));
    let flat = folder.join("flat.png");
    let unread = folder.join("studio.exr");
    std::fs::write(&unread, b"\x76\x2f\x31\x01").expect("writes");
    let damaged = folder.join("damaged.hdr");
    std::fs::write(&damaged, "#?RADIANCE\n\n-Y 8 +X 16\n").expect("writes");
    let checked = run(["check", FIGURE, "--textures", folder.to_str().expect("UTF-8")]);
    let line = format!(
        "{}: warning[image-unrecognized]: studio.exr cannot be read; a panorama as Radiance (.hdr) or a cube map as .dds can.\n",
        unread.display()
    );
    assert!(checked.err.contains(&line), "{checked:?}");
    for (wrong, words) in [
        (
            unread.to_str().expect("UTF-8"),
            "studio.exr: OpenEXR (.exr) cannot be read; a panorama as Radiance (.hdr)",
        ),
        (
            damaged.to_str().expect("UTF-8"),
            "damaged.hdr: the Radiance file ends or is damaged in its row 0 of 8",
        ),
        (
            flat.to_str().expect("UTF-8"),
            "flat.png is a flat picture; --sky takes a cube map or a panorama",
        ),
        (FIGURE, "this is none of DDS, PNG, JPEG, WebP, TGA, BMP and Radiance"),
        ("/no/such.dds", "/no/such.dds cannot be read"),
    ] {
        let refused = run(["render", FIGURE, "-o", "nothing.png", "--sky", wrong]);
        assert!(refused.code == Some(2) && refused.err.contains(words), "{refused:?}");
    }
}

#[test]
fn a_size_is_two_numbers_above_zero() {
    assert_eq!(draw("tiny.png", FIGURE, &["--size=2X1"]).0.dimensions(), (2, 1));
    for wrong in ["", "1280", "0x5", "5x0", "-1x5", "axb", "1x2x3", "99999999999x1"] {
        let refused = run(["render", FIGURE, "-o", "nothing.png", &format!("--size={wrong}")]);
        let told = refused.err.contains("a size is a width and a height in pixels");
        assert!(refused.code == Some(2) && told, "{wrong}: {refused:?}");
    }
}

/// How a cube map of 32 bits a texel begins.
fn cube_header(side: u32) -> Vec<u8> {
    let mut words = [0_u32; 31];
    (words[0], words[1], words[2], words[3]) = (124, 0x1007, side, side);
    // Colour and alpha by masks; all six faces.
    (words[18], words[19], words[21], words[27]) = (32, 0x41, 32, 0xfe00);
    words[22..26].copy_from_slice(&[0xff, 0xff00, 0xff_0000, 0xff00_0000]);
    let words = words.iter().flat_map(|word| word.to_le_bytes());
    b"DDS ".iter().copied().chain(words).collect()
}
