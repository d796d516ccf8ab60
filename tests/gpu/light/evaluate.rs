//! Shader formulas, evaluated once for each pixel of a texture that is read back.

use glam::Vec3;

use crate::gpu::{Gpu, PROBED, drawn, probe};

/// The values that the source's `fragment` gives, bit for bit, rows from the top. Groups are bound from 0 on.
pub(super) fn evaluate(
    gpu: &Gpu,
    source: String,
    groups: &[(&wgpu::BindGroupLayout, &wgpu::BindGroup)],
    size: [u32; 2],
) -> Vec<Vec3> {
    let layouts: Vec<_> = groups.iter().map(|(layout, _)| *layout).collect();
    let pipeline = probe(gpu, source, &layouts, &[], wgpu::PrimitiveTopology::TriangleList);
    let bytes = drawn(gpu, PROBED, size, |mut pass| {
        pass.set_pipeline(&pipeline);
        for (index, (_, group)) in (0..).zip(groups) {
            pass.set_bind_group(index, *group, &[]);
        }
        pass.draw(0..3, 0..1);
    });
    let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    texels.into_iter().map(|[x, y, z, _]| Vec3::new(x, y, z)).collect()
}
