//! Materials edited while one looks on.

use bindpose::format;
use bindpose::model::{AlphaMode, Material, Reflectance};
use bindpose::session::{File, FileCommand, MAX_SPEC_POWER, MaterialCommand, Session};

use super::models::{self, document};
use super::opened;
use super::submeshes::parted;

fn three_materials(path: &str) -> File {
    models::file(path, &parted(document()))
}

fn edit(session: &mut Session, index: usize, change: impl FnOnce(&mut Material)) {
    let mut material = Box::new(session.materials()[index].clone());
    change(&mut material);
    session.apply(MaterialCommand::Edit { index, material });
}

#[test]
fn an_edited_material_is_drawn_and_the_files_stays_known() {
    let mut session = opened(three_materials("a.m3d"));
    let of_file = session.open_model().expect("open").model.materials.clone();
    assert_eq!(session.materials(), of_file);
    let (revision, picture) = (session.materials_revision(), session.picture_revision());

    edit(&mut session, 1, |material| {
        material.diffuse = [0.1, 0.2, 0.3];
        material.name = "renamed".to_owned();
        material.normal_map = Some("other.dds".into());
        material.reflectance = Reflectance::Fresnel {
            fresnel0: [2.0, f32::NAN, 0.5],
            roughness: -1.0,
        };
    });
    let expected = Material {
        diffuse: [0.1, 0.2, 0.3],
        reflectance: Reflectance::Fresnel {
            fresnel0: [1.0, 0.04, 0.5],
            roughness: 0.0,
        },
        ..of_file[1].clone()
    };
    assert_eq!(session.materials()[1], expected);
    assert_eq!(
        [0, 1, 2, 3].map(|index| session.is_edited(index)),
        [false, true, false, false]
    );
    assert!(session.materials_revision() > revision && session.picture_revision() > picture);
    assert_eq!(session.open_model().expect("open").model.materials, of_file);

    session.apply(MaterialCommand::Reset(1));
    assert_eq!(session.materials(), of_file);
    assert!(!session.is_edited(1));
}

#[test]
fn nothing_is_drawn_anew_for_what_changes_nothing() {
    let mut session = opened(three_materials("a.m3d"));
    let (revision, picture) = (session.materials_revision(), session.picture_revision());
    edit(&mut session, 0, |_| {});
    edit(&mut session, 0, |material| material.diffuse[0] = f32::INFINITY);
    session.apply(MaterialCommand::Reset(0));
    session.apply(MaterialCommand::Reset(7));
    let material = Box::new(session.materials()[0].clone());
    session.apply(MaterialCommand::Edit { index: 7, material });
    assert_eq!(
        (session.materials_revision(), session.picture_revision()),
        (revision, picture)
    );
}

#[test]
fn materials_of_the_older_book_are_edited_in_their_own_numbers() {
    let mut document = document();
    document.dialect = format::Dialect::D3d11;
    document.materials[0].reflectance = format::Reflectance::Phong {
        ambient: [0.5; 3],
        specular: [0.2; 3],
        spec_power: 16.0,
        reflectivity: [0.0; 3],
    };
    let mut session = opened(models::file("a.m3d", &document));
    edit(&mut session, 0, |material| {
        material.reflectance = Reflectance::Phong {
            ambient: [0.4; 3],
            specular: [-0.1, 0.3, 1.5],
            spec_power: 5000.0,
            reflectivity: [0.6; 3],
        };
    });
    let expected = Reflectance::Phong {
        ambient: [0.4; 3],
        specular: [0.0, 0.3, 1.0],
        spec_power: 1024.0,
        reflectivity: [0.6; 3],
    };
    assert_eq!(session.materials()[0].reflectance, expected);
    edit(&mut session, 0, |material| {
        material.reflectance = Reflectance::Fresnel {
            fresnel0: [0.1; 3],
            roughness: 0.1,
        };
    });
    assert_eq!(session.materials()[0].reflectance, expected, "it stays of its book");
}

#[test]
fn the_same_file_again_keeps_edits_by_name_and_takes_up_the_rest() {
    let mut session = opened(three_materials("a.m3d"));
    edit(&mut session, 2, |material| material.diffuse = [0.9; 3]);
    let mut document = parted(document());
    document.materials.swap(0, 2);
    for material in &mut document.materials {
        material.diffuse = [0.125; 3];
    }
    session.apply(FileCommand::Add(vec![models::file("a.m3d", &document)]));
    let drawn: Vec<_> = session
        .materials()
        .iter()
        .map(|material| (material.name.as_str(), material.diffuse[0]))
        .collect();
    assert_eq!(drawn, [("Z", 0.9), ("Y", 0.125), ("X", 0.125)]);
    assert_eq!([0, 1, 2].map(|index| session.is_edited(index)), [true, false, false]);
}

#[test]
fn another_model_comes_with_its_own() {
    let mut session = opened(three_materials("a.m3d"));
    edit(&mut session, 2, |material| material.diffuse = [0.9; 3]);
    let revision = session.materials_revision();
    session.apply(FileCommand::Add(vec![three_materials("b.m3d")]));
    assert_eq!(session.materials(), session.open_model().expect("open").model.materials);
    assert!(session.materials_revision() > revision && !session.is_edited(2));
    assert!(Session::new(false).materials().is_empty());
}

fn phong(ambient: f32, spec_power: f32) -> Reflectance {
    Reflectance::Phong {
        ambient: [ambient; 3],
        specular: [0.2; 3],
        spec_power,
        reflectivity: [0.0; 3],
    }
}

/// The first material of a file of the D3D11 book, drawn so, after an edit.
fn phong_edited(of_file: &Reflectance, change: impl FnOnce(&mut Material)) -> [Material; 2] {
    let Reflectance::Phong {
        ambient, spec_power, ..
    } = *of_file
    else {
        panic!("of that book")
    };
    let mut document = document();
    for material in &mut document.materials {
        material.reflectance = format::Reflectance::Phong {
            ambient,
            specular: [0.2; 3],
            spec_power,
            reflectivity: [0.0; 3],
        };
    }
    let mut session = opened(models::file("a.m3d", &document));
    let before = session.materials()[0].clone();
    edit(&mut session, 0, change);
    [before, session.materials()[0].clone()]
}

#[test]
fn values_come_over_in_their_range_and_names_and_the_book_stay() {
    const CUT: AlphaMode = AlphaMode::Mask { cutoff: 0.1 };
    let [before, after] = phong_edited(&phong(0.1, 16.0), |material| {
        material.name = "other".to_owned();
        material.diffuse = [f32::NAN, -3.0, 7.0];
        material.alpha = CUT;
        material.diffuse_map = Some("other.dds".into());
        material.reflectance = phong(0.25, 1e9);
    });
    let expected = Material {
        diffuse: [before.diffuse[0], 0.0, 1.0],
        alpha: CUT,
        reflectance: phong(0.25, MAX_SPEC_POWER),
        ..before
    };
    assert_eq!(after, expected);

    let [before, after] = phong_edited(&phong(0.1, 16.0), |material| {
        material.reflectance = Reflectance::Fresnel {
            fresnel0: [0.1; 3],
            roughness: 0.1,
        };
    });
    assert_eq!(after, before, "values of the other book");
}

#[test]
fn a_number_that_the_file_has_out_of_its_range_stays_while_another_is_edited() {
    for (ambient, spec_power, expected) in [(3.0, 32.0, phong(3.0, 32.0)), (2.9, 16.0, phong(1.0, 16.0))] {
        let [_, after] = phong_edited(&phong(3.0, 16.0), |material| {
            material.reflectance = phong(ambient, spec_power);
        });
        assert_eq!(after.reflectance, expected);
    }
}
