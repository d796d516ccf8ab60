//! The light's shaders compile, translate for WebGL2 and see their uniforms as the twins lay them out.

use std::mem::offset_of;

use bindpose::light::LAMP_RADIUS_RADIANS;
use bindpose::shaders::{BOOK_WGSL, Environment, STUDIO_LIGHT, TONE_MAP_WGSL};
use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::twins::book::{BOOK_AMBIENT, BOOK_STRENGTHS};
use crate::twins::studio::LAMP_RADIANCE;

/// Calls everything, so that nothing is left out of the translation.
const FRAGMENT: &str = "
@fragment
fn fragment(@location(0) normal: vec3<f32>) -> @location(0) vec4<f32> {
    let surface = StudioSurface(
        vec3<f32>(0.5), vec3<f32>(0.04), 1.0, 0.4, normal, normal, normal, 1.0, vec3<f32>(0.1), 0.5, 0.5, 0.1, normal);
    let lights = StudioLights(normal, vec3<f32>(1.0), 1.0, 1.0, normal, vec3<f32>(1.0));
    return vec4<f32>(tone_mapped(exposed(studio_light(surface, lights), 0.5)), 1.0);
}
";

fn source() -> String {
    let files = STUDIO_LIGHT.iter().chain([&TONE_MAP_WGSL]).map(|file| file.source);
    files.chain([FRAGMENT]).collect()
}

fn module() -> naga::Module {
    let source = source();
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)))
}

#[test]
fn the_studio_light_translates_to_glsl_es_300() {
    use naga::back::glsl;
    let module = module();
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source())));
    let options = glsl::Options {
        version: glsl::Version::Embedded {
            version: 300,
            is_webgl: true,
        },
        ..glsl::Options::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: naga::ShaderStage::Fragment,
        entry_point: "fragment".to_owned(),
        multiview: None,
    };
    let mut text = String::new();
    let policies = naga::proc::BoundsCheckPolicies::default();
    glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(text.contains("samplerCube") && text.contains("sampler2D"), "{text}");
}

#[test]
fn the_environment_lies_as_its_twin() {
    let module = module();
    let (_, ty) = module
        .types
        .iter()
        .find(|(_, ty)| ty.name.as_deref() == Some("Environment"))
        .expect("environment.wgsl names it");
    let naga::TypeInner::Struct { members, span } = &ty.inner else {
        panic!("not a struct");
    };
    let found: Vec<(&str, usize)> = members
        .iter()
        .map(|member| (member.name.as_deref().unwrap_or_default(), member.offset as usize))
        .collect();
    let expected = [
        ("sh", offset_of!(Environment, sh)),
        ("turn_cos", offset_of!(Environment, turn_cos)),
        ("turn_sin", offset_of!(Environment, turn_sin)),
        ("intensity", offset_of!(Environment, intensity)),
        ("specular_level_count", offset_of!(Environment, specular_level_count)),
    ];
    assert_eq!(found, expected);
    assert_eq!(*span as usize, size_of::<Environment>());
}

/// The value of a constant of the module: a number or a vector of literals.
fn constant(module: &naga::Module, name: &str) -> Vec<f32> {
    let mut constants = module.constants.iter();
    let (_, constant) = constants
        .find(|(_, constant)| constant.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("no shader has a constant {name}"));
    numbers(module, constant.init)
}

fn numbers(module: &naga::Module, expression: naga::Handle<naga::Expression>) -> Vec<f32> {
    match &module.global_expressions[expression] {
        naga::Expression::Literal(naga::Literal::F32(number)) => vec![*number],
        naga::Expression::Splat { size, value } => numbers(module, *value).repeat(*size as usize),
        naga::Expression::Compose { components, .. } => components
            .iter()
            .flat_map(|component| numbers(module, *component))
            .collect(),
        other => panic!("{other:?} is no number"),
    }
}

/// Irradiance of a disc that faces the surface, over π, is its radiance times sin² of its radius.
#[test]
fn a_white_surface_that_faces_the_lamp_shows_its_colour() {
    assert_eq!(constant(&module(), "LAMP_RADIANCE"), [LAMP_RADIANCE]);
    assert!((LAMP_RADIANCE * LAMP_RADIUS_RADIANS.sin().powi(2) - 1.0).abs() < 1e-5);
}

#[test]
fn both_sides_have_the_same_book_lights() {
    let source = BOOK_WGSL.source;
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    for (strength, name) in BOOK_STRENGTHS
        .into_iter()
        .zip(["BOOK_STRENGTH_0", "BOOK_STRENGTH_1", "BOOK_STRENGTH_2"])
    {
        assert_eq!(constant(&module, name), strength.to_array(), "{name}");
    }
    assert_eq!(constant(&module, "BOOK_AMBIENT"), BOOK_AMBIENT.to_array());
}
