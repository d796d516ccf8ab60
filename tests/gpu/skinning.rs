//! Vertex blending on the GPU, read back, against a textbook in f64 and against its twin on the CPU.

use bindpose::anim::{Palette, SkinnedVertices, skin};
use bindpose::model::{Influences, Mesh};
use bindpose::render::{BoneTexture, Queue};
use bindpose::shaders::{InfluenceVertex, SKINNING_WGSL};
use glam::{Affine3A, DMat3, DMat4, DVec3, EulerRot, Mat3, Quat, Vec3};
use wgpu::util::DeviceExt as _;

use crate::gpu::{Gpu, PROBED, drawn, nothing, probe};

const VERTICES: usize = 512;

/// A vertex in bind space, as the probe reads it.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct GeometryVertex {
    position: [f32; 3],
    normal: [f32; 3],
    tangent: [f32; 4],
}

/// f32 blending of four matrices, relative to the length of the result.
const TOLERANCE: f64 = 1e-4;

/// A small generator of even numbers, the same everywhere.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
    fn within(&mut self, least: f32, greatest: f32) -> f32 {
        least + (greatest - least) * self.unit()
    }
    fn vector(&mut self, reach: f32) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| self.within(-reach, reach)))
    }
}

/// Turned, moved, and every third one stretched unevenly, every seventh mirrored as well.
fn random_palette(random: &mut Random, joints: usize) -> Palette {
    let joint = |joint: usize| {
        let turn = random.vector(3.0);
        let rotation = Quat::from_euler(EulerRot::XYZ, turn.x, turn.y, turn.z);
        let mut scale = if joint % 3 == 1 {
            Vec3::new(0.4, 1.7, 1.1)
        } else {
            Vec3::ONE
        };
        if joint % 7 == 3 {
            scale.x = -scale.x;
        }
        Affine3A::from_scale_rotation_translation(scale, rotation, random.vector(20.0))
    };
    Palette((0..joints).map(joint).collect())
}

fn random_vertices(random: &mut Random, joints: usize) -> (Vec<GeometryVertex>, Vec<InfluenceVertex>) {
    let vertex = |index: usize| {
        let geometry = GeometryVertex {
            position: random.vector(50.0).to_array(),
            normal: random.vector(1.0).normalize_or(Vec3::Y).to_array(),
            tangent: random
                .vector(1.0)
                .normalize_or(Vec3::X)
                .extend(if index.is_multiple_of(2) { 1.0 } else { -1.0 })
                .to_array(),
        };
        let mut weights: [f32; 4] = std::array::from_fn(|_| random.unit());
        // From four influences down to none, which leaves the vertex where it is.
        let influences = 4 - index % 5;
        weights[influences..].fill(0.0);
        let sum: f32 = weights.iter().sum();
        if sum > 0.0 {
            weights = weights.map(|weight| weight / sum);
        }
        let mut picks: [u32; 4] =
            std::array::from_fn(|_| ((random.unit() * joints as f32) as u32).min(joints as u32 - 1));
        // The last joint is the one that a texture too small would lose.
        if index.is_multiple_of(8) {
            picks[0] = joints as u32 - 1;
        }
        (geometry, InfluenceVertex { joints: picks, weights })
    };
    (0..VERTICES).map(vertex).unzip()
}

/// Position, normal and tangent, and the tangent's w.
type Skinned = ([DVec3; 3], f64);

/// Straight from the definition, in f64: blend 4×4 matrices, normals by the inverse transpose.
fn skin_by_definition(palette: &Palette, geometry: &GeometryVertex, influences: &InfluenceVertex) -> Skinned {
    let vector = |array: [f32; 3]| Vec3::from(array).as_dvec3();
    let [tx, ty, tz, sign] = geometry.tangent;
    let bind = [vector(geometry.position), vector(geometry.normal), vector([tx, ty, tz])];
    if influences.weights == [0.0; 4] {
        return (bind, f64::from(sign));
    }
    let mut blended = DMat4::ZERO;
    for (joint, weight) in influences.joints.into_iter().zip(influences.weights) {
        blended += glam::Mat4::from(palette.0[joint as usize]).as_dmat4() * f64::from(weight);
    }
    let linear = DMat3::from_mat4(blended);
    let moved = [
        (blended * bind[0].extend(1.0)).truncate(),
        (linear.inverse().transpose() * bind[1]).normalize(),
        (linear * bind[2]).normalize(),
    ];
    (moved, f64::from(sign) * linear.determinant().signum())
}

/// What the twin on the CPU says.
fn skin_on_cpu(palette: &Palette, geometry: &[GeometryVertex], influences: &[InfluenceVertex]) -> Vec<Skinned> {
    let mesh = Mesh {
        positions: geometry.iter().map(|vertex| vertex.position.into()).collect(),
        normals: geometry.iter().map(|vertex| vertex.normal.into()).collect(),
        tangents: geometry.iter().map(|vertex| vertex.tangent.into()).collect(),
        influences: influences
            .iter()
            .map(|&InfluenceVertex { joints, weights }| Influences { joints, weights })
            .collect(),
        ..Mesh::default()
    };
    let mut out = SkinnedVertices::default();
    skin(&mesh, palette, &mut out);
    let tangents = out.tangents.iter().map(|tangent| tangent.as_dvec4());
    let directions = out.normals.iter().map(|normal| normal.as_dvec3()).zip(tangents);
    let positions = out.positions.iter().map(|position| position.as_dvec3());
    positions
        .zip(directions)
        .map(|(position, (normal, tangent))| ([position, normal, tangent.truncate()], tangent.w))
        .collect()
}

/// How far from singular a blend is: near zero the normal of the exact blend says nothing about the rounded one.
fn is_well_conditioned(palette: &Palette, influences: &InfluenceVertex) -> bool {
    let mut linear = Mat3::ZERO;
    for (joint, weight) in influences.joints.into_iter().zip(influences.weights) {
        linear += Mat3::from(palette.0[joint as usize].matrix3) * weight;
    }
    influences.weights == [0.0; 4] || linear.determinant().abs() > 0.02
}

fn skin_on_gpu(
    gpu: &Gpu,
    palette: &Palette,
    geometry: &[GeometryVertex],
    influences: &[InfluenceVertex],
) -> Vec<Skinned> {
    let (device, queue) = (&gpu.open.device, &gpu.open.queue);
    let bones_layout = BoneTexture::layout(device);
    let mut bones = BoneTexture::new(device, &bones_layout, palette.0.len());
    bones.write(&Queue::new(queue), [&palette.0[..]]);

    let source = format!(
        "const WIDTH: f32 = {VERTICES}.0;\n{}{}",
        SKINNING_WGSL.source,
        include_str!("skinning_probe.wgsl")
    );
    // Skinning reads its bones from group 1; group 0 is the frame's, which the probe has no use for.
    let (nothing, nothing_group) = nothing(gpu);
    let geometry_attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4];
    let influence_attributes = wgpu::vertex_attr_array![4 => Uint32x4, 5 => Float32x4];
    let buffer_layout = |stride, attributes| {
        Some(wgpu::VertexBufferLayout {
            array_stride: stride as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes,
        })
    };
    let buffers = [
        buffer_layout(size_of::<GeometryVertex>(), &geometry_attributes),
        buffer_layout(size_of::<InfluenceVertex>(), &influence_attributes),
    ];
    let groups = [&nothing, &bones_layout];
    let pipeline = probe(gpu, source, &groups, &buffers, wgpu::PrimitiveTopology::PointList);
    let buffer = |contents| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents,
            usage: wgpu::BufferUsages::VERTEX,
        })
    };
    let geometry_buffer = buffer(bytemuck::cast_slice(geometry));
    let influence_buffer = buffer(bytemuck::cast_slice(influences));
    let bytes = drawn(gpu, PROBED, [VERTICES as u32, 3], |mut pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &nothing_group, &[]);
        pass.set_bind_group(1, bones.group(), &[]);
        pass.set_vertex_buffer(0, geometry_buffer.slice(..));
        pass.set_vertex_buffer(1, influence_buffer.slice(..));
        pass.draw(0..VERTICES as u32, 0..3);
    });
    let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let at = |row: usize, vertex: usize| glam::Vec4::from(texels[row * VERTICES + vertex]).as_dvec4();
    (0..VERTICES)
        .map(|vertex| ([0, 1, 2].map(|row| at(row, vertex).truncate()), at(2, vertex).w))
        .collect()
}

fn compare(gpu: &Gpu, joints: usize) {
    let mut random = Random(joints as u64);
    let palette = random_palette(&mut random, joints);
    let (geometry, influences) = random_vertices(&mut random, joints);
    let on_gpu = skin_on_gpu(gpu, &palette, &geometry, &influences);
    let on_cpu = skin_on_cpu(&palette, &geometry, &influences);
    let mut compared = 0;
    for vertex in 0..VERTICES {
        if !is_well_conditioned(&palette, &influences[vertex]) {
            continue;
        }
        compared += 1;
        let by_definition = skin_by_definition(&palette, &geometry[vertex], &influences[vertex]);
        let (expected, expected_sign) = by_definition;
        for (by, (found, sign)) in [("GPU", on_gpu[vertex]), ("CPU", on_cpu[vertex])] {
            assert_eq!(sign, expected_sign, "{by}: side of the bitangent of vertex {vertex}");
            for (of, what) in ["position", "normal", "tangent"].into_iter().enumerate() {
                let (found, expected) = (found[of], expected[of]);
                let error = found.distance(expected) / expected.length().max(1.0);
                assert!(
                    error <= TOLERANCE,
                    "{by}: {what} of vertex {vertex}: {found} for {expected}, off by {error:e}"
                );
            }
        }
    }
    assert!(compared > VERTICES / 2, "only {compared} vertices were compared");
}

on_both_backends! {
    fn one_joint(gpu) {
        compare(gpu, 1);
    }
    fn as_many_joints_as_the_soldier(gpu) {
        compare(gpu, 58);
    }
    /// One more than a row of the texture, and than a uniform block of WebGL2, has.
    fn one_joint_in_the_second_row(gpu) {
        compare(gpu, 257);
    }
    fn a_thousand_joints(gpu) {
        compare(gpu, 1_000);
    }
    /// More than 16 bits can count.
    fn seventy_thousand_joints(gpu) {
        compare(gpu, 70_000);
    }
}
