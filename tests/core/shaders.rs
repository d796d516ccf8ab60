//! Every shader program is sound, translates for WebGL2, and sees its structs as the Rust twins lay them out. No GPU.

use std::collections::BTreeMap;
use std::mem::offset_of;

use bindpose::shaders::{
    Accumulation, Camera, Composite, Environment, Ground, InfluenceVertex, Instance, JOINTS_PER_ROW, Light, Line,
    Material, MaterialMaps, MoreMapsVertex, PROGRAMS, PositionVertex, Program, SurfaceVertex,
};
use naga::back::glsl;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

fn compile(program: &Program) -> (naga::Module, ModuleInfo) {
    let source = program.source();
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string_with_path(&source, program.name)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string_with_path(&source, program.name)));
    (module, info)
}

#[test]
fn every_entry_point_is_valid_and_translates_to_glsl_es_300() {
    let options = glsl::Options {
        version: glsl::Version::Embedded {
            version: 300,
            is_webgl: true,
        },
        ..glsl::Options::default()
    };
    let mut found = Vec::new();
    for program in PROGRAMS {
        let (module, info) = compile(program);
        let mut entry_points = Vec::new();
        for entry_point in &module.entry_points {
            let pipeline = glsl::PipelineOptions {
                shader_stage: entry_point.stage,
                entry_point: entry_point.name.clone(),
                multiview: None,
            };
            let mut text = String::new();
            let policies = naga::proc::BoundsCheckPolicies::default();
            glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
                .and_then(|mut writer| writer.write())
                .unwrap_or_else(|error| panic!("{}/{}: {error}", program.name, entry_point.name));
            assert!(text.starts_with("#version 300 es"), "{text}");
            entry_points.push(entry_point.name.as_str());
        }
        found.push(format!("{}: {}", program.name, entry_points.join(" ")));
    }
    let expected = [
        "mesh-studio: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth",
        "mesh-studio-all: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth fragment_opaque_part \
            fragment_blended fragment_stochastic",
        "mesh-book: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth",
        "mesh-book-all: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth fragment_opaque_part \
            fragment_blended fragment_stochastic",
        "mesh-inspect: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth",
        "mesh-inspect-all: vertex_static vertex_skinned fragment fragment_cut fragment_cut_smooth",
        "skin-view: vertex_static vertex_skinned fragment fragment_cut",
        "skin-view-all: vertex_static vertex_skinned fragment fragment_cut",
        "caster: vertex_static vertex_skinned",
        "caster-cut: vertex_static vertex_skinned fragment",
        "caster-cut-all: vertex_static vertex_skinned fragment",
        "mesh-geometry: vertex_static vertex_skinned fragment fragment_cut",
        "mesh-geometry-all: vertex_static vertex_skinned fragment fragment_cut",
        "occlusion-book: vertex fragment",
        "occlusion-studio: vertex fragment",
        "occlusion-blur: vertex fragment_rows fragment_columns",
        "contact: vertex_static vertex_skinned fragment",
        "contact-cut: vertex_static vertex_skinned fragment cut_static cut_skinned fragment_cut",
        "contact-cut-all: vertex_static vertex_skinned fragment cut_static cut_skinned fragment_cut",
        "contact-blur: vertex fragment_rows fragment_columns",
        "backdrop: vertex fragment",
        "lines: edge_static edge_skinned normal_static normal_skinned tangent_static tangent_skinned world_line world_vertex \
            fragment",
        "highlight: vertex_static vertex_skinned fragment",
        "accumulate: vertex fragment",
        "composite: vertex fragment fragment_picture",
        "probe: vertex fragment",
    ];
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found, expected);
    }
}

/// A struct as offsets of its members and its size.
#[derive(Debug, PartialEq)]
struct Layout {
    members: Vec<(String, usize)>,
    size: usize,
}

macro_rules! twin {
    ($type:ident { $($member:ident),* $(,)? }) => {
        (
            stringify!($type).to_owned(),
            Layout {
                members: vec![$((stringify!($member).to_owned(), offset_of!($type, $member))),*],
                size: size_of::<$type>(),
            },
        )
    };
}

/// Members in order; a missing one shows as a difference, since the shader's list is complete.
fn twins() -> BTreeMap<String, Layout> {
    BTreeMap::from([
        twin!(Camera {
            clip_from_world,
            eye,
            is_perspective,
            forward,
            depth_near,
            eye_per_x,
            depth_far,
            eye_per_y,
            exposure_stops,
            forward_per_x,
            view_mode,
            forward_per_y,
            first_row,
            viewport_pixels,
            jitter,
            map_size,
            sample,
            points_high,
            first_map_row,
        }),
        twin!(Light {
            shadow_clip_from_world,
            to_key,
            shadow_texel,
            to_rim,
            shadow_radius_texels,
            to_book_light_1,
            occlusion_radius,
            to_book_light_2,
            book_unit,
            key_shadow,
            reflections,
            is_book,
            normal_green_sign,
            fine_occlusion,
            shadow_taps,
            shadow_depth,
            noise_turn,
            key_color,
            key_mirrored,
            rim_color,
            lamp_tangent,
        }),
        twin!(Ground {
            backdrop_center_srgb,
            backdrop_edge_srgb,
            grid,
            floor,
            background_srgb,
            background,
            center,
            contact_center,
            contact_half_width,
            contact_strength,
            shadow_strength,
            height,
            grid_cell,
            grid_reach,
            floor_reach,
        }),
        twin!(Material {
            albedo,
            roughness,
            fresnel0,
            alpha_clip,
            book_albedo,
            is_phong,
            ambient,
            spec_power,
            specular,
            normal_channels,
            reflectivity,
            normal_lengths,
            identity_srgb,
            threshold_step,
        }),
        twin!(MaterialMaps {
            places,
            emissive,
            opacity,
            metallic,
            normal_scale,
            occlusion_strength,
            least_solid_alpha,
            present,
            has_map_alpha,
            is_metallic_roughness,
            is_unlit,
            dielectric_fresnel0,
            specular,
            sheen,
            sheen_roughness,
            coat,
            coat_roughness,
            boundary_fresnel0,
            solid,
            coat_normal_scale,
            coat_normal_channels,
            coat_normal_lengths,
        }),
        twin!(Environment {
            sh,
            turn_cos,
            turn_sin,
            intensity,
            specular_level_count,
        }),
        twin!(Line { color_srgb, length }),
        twin!(Composite {
            picture,
            layer,
            is_root,
            dithers,
            first_row
        }),
        twin!(Accumulation { share, turn, first_row }),
    ])
}

#[test]
fn uniform_structs_lie_as_their_twins() {
    let mut found = BTreeMap::new();
    for program in PROGRAMS {
        let (module, _) = compile(program);
        let uniforms = module.global_variables.iter().map(|(_, variable)| variable);
        for variable in uniforms.filter(|variable| variable.space == naga::AddressSpace::Uniform) {
            let ty = &module.types[variable.ty];
            let naga::TypeInner::Struct { members, span } = &ty.inner else {
                panic!("{}: a uniform that is no struct", program.name);
            };
            let name = |name: &Option<String>| name.clone().expect("structs and members have names in WGSL");
            let layout = Layout {
                members: members
                    .iter()
                    .map(|member| (name(&member.name), member.offset as usize))
                    .collect(),
                size: *span as usize,
            };
            assert_eq!(layout.size % 16, 0, "{}: WebGL2 wants whole 16 bytes", program.name);
            found.insert(name(&ty.name), layout);
        }
    }
    assert_eq!(found, twins());
}

#[test]
fn uniforms_fit_the_smallest_block_of_webgl2() {
    const SMALLEST_BLOCK: usize = 16 * 1024;
    for bytes in [
        size_of::<Camera>(),
        size_of::<Light>(),
        size_of::<Ground>(),
        size_of::<Material>(),
        size_of::<MaterialMaps>(),
    ] {
        assert!(bytes <= SMALLEST_BLOCK);
    }
}

/// What WebGL2 promises: textures that a fragment shader reads, and attributes of a vertex.
#[test]
fn programs_stay_within_what_webgl2_has() {
    const MOST: usize = 16;
    for program in PROGRAMS {
        let (module, _) = compile(program);
        let is_texture = |(_, variable): &(_, &naga::GlobalVariable)| {
            let inner = &module.types[variable.ty].inner;
            matches!(inner, naga::TypeInner::Image { .. }) && variable.binding.is_some_and(|place| place.group > 1)
        };
        let textures = module.global_variables.iter().filter(is_texture).count();
        assert!(textures <= MOST, "{}: {textures} textures", program.name);
    }
}

#[test]
fn vertices_are_packed_and_within_the_least_stride() {
    // The least that `max_vertex_buffer_array_stride` may be.
    const LEAST_STRIDE: usize = 255;
    assert_eq!(size_of::<PositionVertex>(), 3 * 4);
    assert_eq!(size_of::<SurfaceVertex>(), (3 + 4 + 2) * 4);
    assert_eq!(size_of::<InfluenceVertex>(), (4 + 4) * 4);
    assert_eq!(size_of::<MoreMapsVertex>(), 4 * 2 + 2 * 4);
    assert_eq!(size_of::<Instance>(), (3 * 4 + 4 + 1 + 1) * 4);
    assert!(size_of::<SurfaceVertex>() <= LEAST_STRIDE);
    // The stream holds each instance twice.
    assert!(2 * size_of::<Instance>() <= LEAST_STRIDE);
}

#[test]
fn shader_and_upload_agree_on_joints_per_row() {
    let (module, _) = compile(&bindpose::shaders::MESH_STUDIO);
    let (_, constant) = module
        .constants
        .iter()
        .find(|(_, constant)| constant.name.as_deref() == Some("JOINTS_PER_ROW"))
        .expect("skinning.wgsl names it");
    let naga::Expression::Literal(literal) = module.global_expressions[constant.init] else {
        panic!("not a literal");
    };
    assert_eq!(literal, naga::Literal::U32(JOINTS_PER_ROW));
}
