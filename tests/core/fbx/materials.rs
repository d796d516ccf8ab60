//! What materials of a file become: numbers as ufbx finds them, maps, and what is told where a map has no place.

use bindpose::import::{Imported, import, import_beside};
use bindpose::model::{AlphaMode, MapSlot, Reflectance, Wrap};
use bindpose::session::{File, FileCommand, Session};

use super::{files, told};

const LEFT_OUT: &str = "fbx-left-out";

#[test]
fn materials_have_the_numbers_that_ufbx_finds() {
    let (mut wrong, mut count, mut rough, mut bright, mut shiny) = (Vec::new(), 0, 0, 0, 0);
    for (name, bytes) in files("files") {
        let (Ok(imported), Ok(scene)) = (import(&bytes), ufbx::load_memory(&bytes, ufbx::LoadOpts::default())) else {
            continue;
        };
        for material in &imported.model.materials {
            let mut same = scene
                .materials
                .iter()
                .filter(|other| *other.element.name == *material.name);
            let (Some(theirs), None) = (same.next(), same.next()) else {
                continue;
            };
            let pbr = &theirs.pbr;
            let Reflectance::MetallicRoughness { metallic, roughness } = material.reflectance else {
                wrong.push(format!("{name}, {}: no metal or other", material.name));
                continue;
            };
            let is_physical = !theirs.shader_prop_prefix.is_empty();
            let mut compare = |what: &str, ours: f32, theirs: f64| {
                if (f64::from(ours) - theirs).abs() > 1e-4 {
                    wrong.push(format!("{name}, {}: {what} {ours}, not {theirs}", material.name));
                }
            };
            if is_physical && pbr.metalness.has_value {
                compare("metallic", metallic, pbr.metalness.value_vec4.x);
                count += 1;
            }
            // Of a file with glossiness it is what is missing to 1. Exponents of Blinn's and Phong's become others there.
            if is_physical && (pbr.roughness.has_value || pbr.glossiness.has_value) {
                compare("roughness", roughness, pbr.roughness.value_vec4.x);
                rough += 1;
            }
            let [light, strength] = [&pbr.emission_color, &pbr.emission_factor];
            if material.emissive_map.is_none() && light.has_value {
                let light = light.value_vec4;
                for (ours, theirs) in material.emissive.into_iter().zip([light.x, light.y, light.z]) {
                    compare("light", ours, theirs * strength.value_vec4.x);
                }
                bright += usize::from(material.emissive != [0.0; 3]);
            }
            let [shine, factor] = [&pbr.specular_color, &pbr.specular_factor];
            if scene.metadata.creator.contains("Blender") {
                let layers = &material.layers;
                assert_eq!((layers.specular, layers.specular_color), (1.0, [1.0; 3]), "{name}");
            } else if theirs.shader_type == ufbx::ShaderType::FbxPhong && shine.has_value {
                let (shine, factor) = (shine.value_vec4, factor.value_vec4.x);
                let layers = &material.layers;
                for (ours, theirs) in layers.specular_color.into_iter().zip([shine.x, shine.y, shine.z]) {
                    compare("shine", ours * layers.specular, theirs * factor);
                }
                shiny += 1;
            }
            // Of Lambert's and Phong's it is the diffuse colour.
            let [color, factor] = [&pbr.base_color, &pbr.base_factor];
            if material.diffuse_map.is_none() && color.has_value {
                let factor = if factor.has_value { factor.value_vec4.x } else { 1.0 };
                let color = color.value_vec4;
                for (ours, theirs) in material.diffuse.into_iter().zip([color.x, color.y, color.z]) {
                    compare("colour", ours, (theirs * factor).clamp(0.0, 1.0));
                }
                count += 1;
            }
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(
        count == 0 || (count > 40 && rough > 5 && bright > 5 && shiny > 5),
        "{count} colours, {rough} that say how rough they are, {bright} with light of their own, {shiny} that shine"
    );
}

/// A triangle whose material has these properties, and textures: the property on which each hangs, its path, and its bytes in base 64 if they lie in the
/// file.
fn painted(properties: &[&str], textures: &[(&str, &str, Option<&str>)]) -> String {
    let mut objects = String::new();
    let mut connections = String::new();
    for (number, (property, path, bytes)) in (10..).zip(textures) {
        objects.push_str(&format!(
            "\tTexture: {number}, \"Texture::\", \"\" {{\n\t\tRelativeFilename: \"{path}\"\n\t}}\n"
        ));
        connections.push_str(&format!("\tC: \"OP\",{number},3,\"{property}\"\n"));
        if let Some(bytes) = bytes {
            objects.push_str(&format!(
                "\tVideo: {number}0, \"Video::\", \"Clip\" {{\n\t\tContent: ,\n\t\t\t\"{bytes}\"\n\t}}\n"
            ));
            connections.push_str(&format!("\tC: \"OO\",{number}0,{number}\n"));
        }
    }
    let properties: String = properties.iter().map(|line| format!("\t\t\tP: {line}\n")).collect();
    format!(
        "; FBX 7.4.0 project file\nObjects:  {{\n\tGeometry: 1, \"Geometry::\", \"Mesh\" {{\n\t\tVertices: *9 {{\n\t\t\ta: \
         0,0,0,1,0,0,1,1,0\n\t\t}}\n\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: 0,1,-3\n\t\t}}\n\t}}\n\tModel: 2, \"Model::Card\", \"Mesh\" \
         {{\n\t}}\n\tMaterial: 3, \"Material::Paint\", \"\" {{\n\t\tProperties70:  {{\n{properties}\t\t}}\n\t}}\n{objects}}}\n\
         Connections:  {{\n\tC: \"OO\",1,2\n\tC: \"OO\",2,0\n\tC: \"OO\",3,2\n{connections}}}\n"
    )
}

fn read(file: &str) -> Imported {
    import(file.as_bytes()).unwrap_or_else(|refused| panic!("{:?}", refused.error))
}

/// The names of the maps of the first material: of its colour and of its light.
fn maps(imported: &Imported) -> [Option<&str>; 2] {
    let material = &imported.model.materials[0];
    [&material.diffuse_map, &material.emissive_map].map(|map| map.as_ref().map(|map| &*map.name))
}

#[test]
fn a_map_that_is_switched_off_is_not_taken_and_not_told() {
    for (color, switch, textures) in [
        (
            "\"Maya|base_color\", \"Vector3D\", \"Vector\", \"\",0.25,0.5,0.75",
            "\"Maya|use_color_map\", \"float\", \"\", \"\"",
            [
                ("Maya|TEX_color_map", "color.png", None),
                ("Maya|TEX_metallic_map", "metal.png", None),
            ],
        ),
        (
            "\"3dsMax|Parameters|base_color\", \"ColorAndAlpha\", \"\", \"A\",0.25,0.5,0.75,1",
            "\"3dsMax|Parameters|base_color_map_on\", \"Bool\", \"\", \"A\"",
            [
                ("3dsMax|Parameters|base_color_map", "color.png", None),
                ("3dsMax|Parameters|metalness_map", "metal.png", None),
            ],
        ),
    ] {
        let off = read(&painted(&[color, &format!("{switch},0")], &textures));
        assert_eq!(maps(&off), [None, None]);
        assert_eq!(off.model.materials[0].diffuse, [0.25, 0.5, 0.75]);
        let on = read(&painted(&[color, &format!("{switch},1")], &textures));
        assert_eq!(maps(&on), [Some("color.png"), None]);
        assert_eq!(on.model.materials[0].diffuse, [1.0; 3]);
        let metal = textures[1].0;
        let message = format!("1 map is of a kind that has no place in a model: Paint's {metal}.");
        assert_eq!(
            (told(&off, LEFT_OUT), told(&on, LEFT_OUT)),
            (vec![&*message], vec![&*message])
        );
    }
    let black = read(&painted(
        &["\"DiffuseColor\", \"Color\", \"\", \"A\",0,0,0"],
        &[("DiffuseColor", "color.png", None)],
    ));
    assert_eq!(maps(&black), [Some("color.png"), None], "a colour is no switch");
}

#[test]
fn maps_of_metal_and_roughness_of_real_files_are_told_by_name() {
    for (name, maps) in [
        (
            "maya_shaderfx_pbs_material_7700_ascii.fbx",
            &["Maya|TEX_metallic_map"][..],
        ),
        (
            "max_pbr_metal_rough_material_7700_ascii.fbx",
            &["3dsMax|main|metalness_map", "3dsMax|main|Roughness_Map"],
        ),
    ] {
        let Some((_, bytes)) = files("files").into_iter().find(|(file, _)| file == name) else {
            return;
        };
        let imported = import(&bytes).unwrap_or_else(|_| panic!("{name}"));
        let messages = told(&imported, LEFT_OUT).join(" ");
        for map in maps {
            assert!(messages.contains(map), "{name}: {map} in {messages}");
        }
        assert!(!messages.contains("TEX_roughness_map"), "{name}: it is off");
    }
}

#[test]
fn one_picture_of_metal_and_roughness_is_taken_and_two_are_told() {
    let textures = |rough| {
        [
            ("Maya|TEX_metallic_map", "both.png", None),
            ("Maya|TEX_roughness_map", rough, None),
        ]
    };
    let metal = "\"Maya|metallic\", \"float\", \"\", \"\",0.25";
    for (rough, properties, map, numbers) in [
        ("both.png", &[metal][..], Some("both.png"), [1.0, 1.0]),
        ("rough.png", &[metal], None, [0.25, 1.0]),
        // What is glossy in it is not what is rough.
        (
            "both.png",
            &[metal, "\"3dsMax|main|useGlossiness\", \"int\", \"\", \"\",1"],
            None,
            [0.25, 1.0],
        ),
    ] {
        let imported = read(&painted(properties, &textures(rough)));
        let material = &imported.model.materials[0];
        let found = material.metallic_roughness_map.as_ref().map(|map| &*map.name);
        assert_eq!(found, map, "{rough}");
        let [metallic, roughness] = numbers;
        assert_eq!(
            material.reflectance,
            Reflectance::MetallicRoughness { metallic, roughness }
        );
        let count = told(&imported, LEFT_OUT).join(" ").matches("Maya|TEX_").count();
        assert_eq!(count, if map.is_some() { 0 } else { 2 }, "{rough}");
    }
}

/// Each property takes its map to one slot, and to no other.
#[test]
fn maps_come_to_the_slot_of_their_property() {
    use MapSlot::{Diffuse, Emissive, Normal, Occlusion};
    for (property, slot) in [
        ("DiffuseColor", Diffuse),
        ("Maya|TEX_color_map", Diffuse),
        ("Maya|baseColor", Diffuse),
        ("3dsMax|Parameters|base_color_map", Diffuse),
        ("3dsMax|main|base_color_map", Diffuse),
        ("NormalMap", Normal),
        ("Bump", Normal),
        ("Maya|TEX_normal_map", Normal),
        ("Maya|normalCamera", Normal),
        ("3dsMax|Parameters|bump_map", Normal),
        ("3dsMax|main|norm_map", Normal),
        ("EmissiveColor", Emissive),
        ("Maya|TEX_emissive_map", Emissive),
        ("3dsMax|Parameters|emit_color_map", Emissive),
        ("Maya|TEX_ao_map", Occlusion),
        ("3dsMax|main|ao_map", Occlusion),
    ] {
        let imported = read(&painted(&[], &[(property, "map.png", None)]));
        let material = &imported.model.materials[0];
        let filled: Vec<MapSlot> = MapSlot::ALL
            .into_iter()
            .filter(|slot| material.map(*slot).is_some())
            .collect();
        assert_eq!(filled, [slot], "{property}");
        assert!(told(&imported, LEFT_OUT).is_empty(), "{property}");
    }
}

#[test]
fn what_is_transparent_is_blended_and_a_picture_of_it_alone_is_told() {
    let material = |properties: &[&str], textures: &[(&str, &str, Option<&str>)]| {
        let imported = read(&painted(properties, textures));
        let told = told(&imported, LEFT_OUT).len();
        let material = &imported.model.materials[0];
        (material.opacity, material.alpha, told)
    };
    let factor = "\"TransparencyFactor\", \"Number\", \"\", \"A\",";
    let quarter = format!("{factor}0.25");
    let color = "\"TransparentColor\", \"Color\", \"\", \"A\",1,0.5,0";
    assert_eq!(material(&[&quarter], &[]), (0.75, AlphaMode::Blend, 0));
    assert_eq!(material(&[&quarter, color], &[]), (0.875, AlphaMode::Blend, 0));
    // Some exporters say that nothing is seen, and mean all.
    assert_eq!(material(&[&format!("{factor}1")], &[]), (1.0, AlphaMode::Opaque, 0));
    // The alpha of the colour's own picture cuts it; another picture has no place.
    let cut = |by| [("DiffuseColor", "leaf.png", None), ("TransparentColor", by, None)];
    assert_eq!(material(&[], &cut("leaf.png")), (1.0, AlphaMode::Blend, 0));
    assert_eq!(material(&[], &cut("other.png")), (1.0, AlphaMode::Opaque, 1));
}

#[test]
fn phongs_exponent_is_a_roughness_and_lamberts_is_none() {
    let exponent = |value: f32| format!("\"ShininessExponent\", \"Number\", \"\", \"A\",{value}");
    let roughness = |file: &str| match read(file).model.materials[0].reflectance {
        Reflectance::MetallicRoughness { roughness, .. } => roughness,
        _ => panic!("no roughness"),
    };
    // α² = 2 / (n + 2), and α is the square of the roughness: 0 is rough, 30 is a half, 2^9 - 2 a quarter.
    for (given, wanted) in [(0.0, 1.0), (30.0, 0.5), (510.0, 0.25)] {
        let file = painted(&[&exponent(given)], &[]);
        assert!((roughness(&file) - wanted).abs() < 1e-6, "{given}");
        let material = "\"Material::Paint\", \"\" {\n";
        let lambert = file.replacen(material, &format!("{material}\t\tShadingModel: \"lambert\"\n"), 1);
        assert!((roughness(&lambert) - 1.0).abs() < 1e-6, "{given}");
    }
}

#[test]
fn pictures_lie_on_the_mesh_as_ufbx_has_them() {
    let mut file = painted(&[], &[("DiffuseColor", "tiles.png", None)]);
    let property = |name: &str, numbers: &str| format!("\t\t\tP: \"{name}\", \"Vector3D\", \"\", \"A\",{numbers}\n");
    let properties = [
        property("Translation", "0.125,-0.25,0"),
        property("Rotation", "0,0,30"),
        property("Scaling", "2,0.5,1"),
        property("TextureRotationPivot", "0.5,0.25,0"),
        property("TextureScalingPivot", "0.25,0.75,0"),
        "\t\t\tP: \"WrapModeU\", \"enum\", \"\", \"\",1\n".to_owned(),
    ];
    let path = "RelativeFilename: \"tiles.png\"\n";
    let block = format!("{path}\t\tProperties70:  {{\n{}\t\t}}\n", properties.concat());
    file = file.replacen(path, &block, 1);
    let of_files = files("files").into_iter();
    let mut turned = 0;
    for (name, bytes) in of_files.chain([("a made one".to_owned(), file.into_bytes())]) {
        let (Ok(imported), Ok(scene)) = (import(&bytes), ufbx::load_memory(&bytes, ufbx::LoadOpts::default())) else {
            continue;
        };
        for material in &imported.model.materials {
            let Some(map) = &material.diffuse_map else { continue };
            let of_name = |texture: &&ufbx::Texture| {
                let path = texture.relative_filename.replace('\\', "/");
                path.rsplit('/').next() == Some(&map.name)
            };
            let mut all = scene.textures.iter().map(|texture| &**texture).filter(of_name);
            let (Some(texture), None) = (all.next(), all.next()) else {
                continue;
            };
            let theirs = &texture.uv_to_texture;
            for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.3, 0.6)] {
                let x = theirs.m00 * u + theirs.m01 * v + theirs.m03;
                let y = theirs.m10 * u + theirs.m11 * v + theirs.m13;
                // In FBX v runs upwards.
                let ours = map
                    .sampling
                    .map_from_mesh
                    .transform_point2(glam::Vec2::new(u as f32, 1.0 - v as f32));
                let off = (f64::from(ours.x) - x).abs().max((f64::from(ours.y) - (1.0 - y)).abs());
                assert!(
                    off < 1e-4,
                    "{name}, {}: {ours} at ({u}, {v}), not ({x}, {})",
                    map.name,
                    1.0 - y
                );
            }
            let clamped = [texture.wrap_u, texture.wrap_v].map(|wrap| wrap == ufbx::WrapMode::Clamp);
            assert_eq!(map.sampling.wrap.map(|wrap| wrap == Wrap::Clamp), clamped, "{name}");
            turned += usize::from(texture.has_uv_transform);
        }
    }
    assert!(turned > 0, "no picture is turned");
}

#[test]
fn phongs_specular_colour_is_a_part_of_what_glass_reflects() {
    let properties = [
        "\"SpecularColor\", \"Color\", \"\", \"A\",1,0.5,0",
        "\"SpecularFactor\", \"Number\", \"\", \"A\",0.5",
    ];
    let phong = painted(&properties, &[]);
    let fresnel0 = |file: &str| read(file).model.materials[0].layers.fresnel0();
    for (found, wanted) in fresnel0(&phong).into_iter().zip([0.02, 0.01, 0.0]) {
        assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
    }
    let material = "\"Material::Paint\", \"\" {\n";
    let lambert = phong.replacen(material, &format!("{material}\t\tShadingModel: \"lambert\"\n"), 1);
    let plain = fresnel0(&painted(&[], &[]));
    assert_eq!(fresnel0(&lambert), plain, "Lambert's has none");
    let of_blender = phong.replacen(
        "Objects:  {",
        "Creator: \"Blender (stable FBX IO) - 3.4.1\"\nObjects:  {",
        1,
    );
    assert_eq!(fresnel0(&of_blender), plain, "Blender's says nothing");
}

#[test]
fn light_is_as_strong_as_its_own_number_says() {
    let white = "\"Maya|emissionColor\", \"Vector3D\", \"Vector\", \"\",1,1,1";
    for (strength, light) in [("0", 0.0), ("0.5", 0.5)] {
        let factor = format!("\"Maya|emission\", \"float\", \"\", \"\",{strength}");
        let file = painted(&[white, &factor, "\"EmissiveFactor\", \"Number\", \"\", \"A\",3"], &[]);
        assert_eq!(read(&file).model.materials[0].emissive, [light; 3]);
    }
}

/// A picture in the file is known by the place of its object; here a texture has that as its path.
#[test]
fn a_picture_beside_the_file_is_not_taken_for_one_in_it() {
    let bytes = "iVBORw0KGgo=";
    let textures = [("DiffuseColor", "in.png", Some(bytes)), ("EmissiveColor", "#4", None)];
    let file = painted(&[], &textures);
    let kinds: Vec<&str> = file
        .lines()
        .filter(|line| line.ends_with('{') && line.contains("::"))
        .collect();
    assert!(kinds[4].contains("Video"), "{kinds:?}");
    let imported = import_beside(file.as_bytes(), &|path| (path == "#4").then(|| vec![7u8].into()));
    let imported = imported.unwrap_or_else(|refused| panic!("{:?}", refused.error));
    assert_eq!(maps(&imported), [Some("in.png"), Some("#4")]);
    let pictures: Vec<_> = imported
        .pictures
        .iter()
        .map(|picture| (&*picture.name, picture.bytes.len()))
        .collect();
    assert_eq!(pictures, [("in.png", 8), ("#4", 1)]);
}

/// Programs unpack pictures into a folder beside the file, and name them by whatever path they had.
#[test]
fn pictures_of_the_folder_beside_a_file_are_found_in_a_drop() {
    let png = bindpose::image::encode_png(&[10, 20, 30, 255], 1, 1).expect("one pixel");
    for path in [
        "card.fbm\\skin.png",
        "C:\\work\\card.fbm\\skin.png",
        "..\\elsewhere\\skin.png",
    ] {
        let file = painted(&[], &[("DiffuseColor", path, None)]);
        let mut session = Session::new(false);
        session.apply(FileCommand::Add(vec![
            File::new("walk/card.fbx", file.into_bytes()),
            File::new("walk/card.fbm/skin.png", png.clone()),
        ]));
        assert!(session.error().is_none(), "{:?}", session.error());
        let picture = session.maps().image(0, MapSlot::Diffuse);
        let pixel = picture.and_then(|picture| Some(picture.to_rgba8(0, 0)?[..4].to_vec()));
        assert_eq!(pixel, Some(vec![10, 20, 30, 255]), "{path}");
    }
}
