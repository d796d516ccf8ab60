//! The light's shaders compile, translate for WebGL2 and see their uniforms as the twins lay them out.

use std::mem::offset_of;

use bindpose::light::studio::KEY_SIZE;
use bindpose::shaders::{Environment, STUDIO_LIGHT, TONE_MAP_WGSL};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Calls everything, so that nothing is left out of the translation.
const FRAGMENT: &str = "
@fragment
fn fragment(@location(0) normal: vec3<f32>) -> @location(0) vec4<f32> {
    let surface = StudioSurface(vec3<f32>(0.5), vec3<f32>(0.04), 0.4, normal, normal, normal, 1.0);
    let lights = StudioLights(normal, vec3<f32>(1.0), 1.0, normal, vec3<f32>(1.0));
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

#[test]
fn both_sides_spread_the_key_alike() {
    let module = module();
    let (_, constant) = module
        .constants
        .iter()
        .find(|(_, constant)| constant.name.as_deref() == Some("KEY_SIZE"))
        .expect("studio.wgsl names it");
    let naga::Expression::Literal(literal) = module.global_expressions[constant.init] else {
        panic!("not a literal");
    };
    assert_eq!(literal, naga::Literal::F32(KEY_SIZE));
}
