//! Which file is which map.

use bindpose::diagnostic::{Severity, Subject};
use bindpose::model::{MapSlot, Material, Reflectance};
use bindpose::session::{Checklist, File, MapNames, MapSource, find_map, find_maps, map_diagnostics};

fn files(paths: &[&str]) -> Vec<File> {
    paths.iter().map(|path| File::new(path, [])).collect()
}

fn material(name: &str, diffuse_map: Option<&str>, normal_map: Option<&str>) -> Material {
    Material {
        name: name.to_owned(),
        diffuse: [1.0; 3],
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.05; 3],
            roughness: 0.5,
        },
        diffuse_map: diffuse_map.map(Into::into),
        normal_map: normal_map.map(Into::into),
        ..Material::default()
    }
}

#[test]
fn names_fit_without_case_extension_and_folders() {
    for (name, path) in [
        ("upBody_norm.dds", "upbody_norm.dds"),
        ("upBody_norm.dds", "soldier/maps/UPBODY_NORM.DDS"),
        ("head_diff.tga", "head_diff.dds"),
        ("head_diff", "a/b/c/head_diff.png"),
        ("v1.2_diff", "v1.2_diff.dds"),
        (r"C:\Art\Soldier\head_diff.tga", "textures/head_diff.jpg"),
        ("../Textures/head_diff.dds", "head_diff.dds"),
        (" head_diff.dds ", "head_diff.dds"),
        ("Größe.dds", "GRÖSSE/GRÖßE.DDS"),
    ] {
        let found = find_map(name, &files(&["soldier.m3d", path]), &[]);
        assert_eq!(
            found.map(|found| (found.file, found.rivals)),
            Some((1, vec![])),
            "{name} {path}"
        );
    }
}

#[test]
fn other_names_do_not_fit() {
    for (name, path) in [
        ("head_diff.dds", "head_diff2.dds"),
        ("head_diff.dds", "my_head_diff.dds"),
        ("head.dds", "head/norm.dds"),
        // No picture.
        ("soldier.dds", "soldier.m3d"),
        ("textures/", "textures.dds"),
        ("", ".dds"),
    ] {
        assert_eq!(find_map(name, &files(&[path]), &[]), None, "{name} {path}");
    }
}

/// Whoever reads only the files whose names fit reads all that can be found.
#[test]
fn a_name_fits_exactly_when_the_file_can_be_found() {
    let names = [
        "a.dds",
        "A.b.dds",
        "v1.2_diff",
        r"C:\Art\Größe.TGA",
        "up/head_diff.png",
        "textures/",
        ".dds",
        " a.dds ",
        "",
    ];
    let paths = [
        "a.dds",
        "x/A.PNG",
        "a.b.jpg",
        "a.b",
        "v1.dds",
        "v1.2_diff.dds",
        "GRÖßE.dds",
        r"up\head_diff.bmp",
        "head.dds",
        "textures.dds",
        ".dds",
        ".png",
        "dds.png",
    ];
    for name in names {
        let fitting = MapNames::new(&[material("m", None, Some(name))]);
        for path in paths {
            let file = File::new(path, []);
            let found = find_map(name, std::slice::from_ref(&file), &[]).is_some();
            assert_eq!(fitting.fit(path) && file.is_image(), found, "{name} {path}");
        }
    }
}

#[test]
fn of_several_the_extension_then_the_folders_then_the_path_then_the_order_decides() {
    for (name, paths, file, rivals) in [
        ("a.dds", ["a.png", "x/y/a.dds"], 1, vec![]),
        ("a.dds", ["x/y/a.dds", "long_folder/a.dds"], 1, vec![0]),
        ("a.dds", ["long/a.dds", "x/a.dds"], 1, vec![0]),
        ("a.dds", ["x/a.dds", "y/A.dds"], 0, vec![1]),
        ("a.tga", ["x/a.dds", "a.png"], 1, vec![0]),
        // The name says in which folder.
        (r"D:\maps\stone\a.dds", ["a.dds", "all/stone/a.dds"], 1, vec![0]),
        (
            r"D:\maps\stone\a.dds",
            ["stone/a.dds", "deep/maps/stone/a.dds"],
            1,
            vec![0],
        ),
    ] {
        let found = find_map(name, &files(&paths), &[]).expect("both fit");
        assert_eq!((found.file, found.rivals), (file, rivals), "{name} {paths:?}");
    }
}

#[test]
fn what_was_dropped_later_wins_but_not_over_the_extension_of_the_name() {
    for (paths, drops, file, rivals) in [
        (["a.dds", "x/y/a.dds", "z/a.dds"], [1, 2, 1], 1, vec![]),
        (["x/a.dds", "y/a.dds", "a.dds"], [2, 2, 1], 0, vec![1]),
        (["a.dds", "a.png", "x/a.png"], [1, 2, 3], 0, vec![]),
        (["a.tga", "a.png", "x/a.png"], [1, 1, 2], 2, vec![]),
    ] {
        let found = find_map("a.dds", &files(&paths), &drops).expect("all fit");
        assert_eq!((found.file, found.rivals), (file, rivals), "{paths:?} {drops:?}");
    }
}

#[test]
fn each_material_learns_of_both_maps() {
    let materials = [
        material("head", Some("head_diff.dds"), Some("head_norm.dds")),
        material("jacket", Some("jacket_diff.dds"), Some("jacket_norm.dds")),
        material("plain", None, Some(" ")),
        material("cap", Some("head_diff.dds"), None),
    ];
    let files = files(&[
        "soldier.m3d",
        "n/head_norm.dds",
        "m/jacket_norm.dds",
        "n/jacket_norm.dds",
    ]);
    let maps = find_maps(&materials, &files, &[]);
    let missing = |name: &str| MapSource::Missing(name.to_owned());
    assert_eq!(maps.len(), 4);
    assert_eq!(
        (maps[0].slot(MapSlot::Diffuse), maps[0].slot(MapSlot::Normal).file()),
        (&missing("head_diff.dds"), Some(1))
    );
    assert_eq!(
        (maps[1].slot(MapSlot::Diffuse), maps[1].slot(MapSlot::Normal).file()),
        (&missing("jacket_diff.dds"), Some(2))
    );
    assert_eq!(
        (maps[2].slot(MapSlot::Diffuse), maps[2].slot(MapSlot::Normal)),
        (&MapSource::NoneNamed, &MapSource::NoneNamed)
    );
    assert_eq!(maps[3].slot(MapSlot::Diffuse), &missing("head_diff.dds"));

    // Two materials share a name: it counts once.
    let checklist = Checklist::new(&materials, &maps, |_| true);
    assert_eq!((checklist.named, checklist.found()), (4, 2));
    assert_eq!(checklist.missing, ["head_diff.dds", "jacket_diff.dds"]);
    let checklist = Checklist::new(&materials, &maps, |file| file != 2);
    assert_eq!((checklist.found(), checklist.missing.len()), (1, 2));
    assert_eq!(checklist.unreadable, ["jacket_norm.dds"]);

    let notices = map_diagnostics(&materials, &files, &maps);
    assert!(notices.iter().all(|notice| notice.severity == Severity::Note));
    let lines: Vec<_> = notices
        .iter()
        .map(|notice| (notice.code, notice.subject, notice.message.as_str()))
        .collect();
    assert_eq!(
        lines,
        [(
            "map-ambiguous",
            Some(Subject::Material(1)),
            "the normal map of material \"jacket\" could be several files: m/jacket_norm.dds is taken, not \
             n/jacket_norm.dds"
        )]
    );
}
