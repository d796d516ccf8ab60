//! What a frame cost, for people to read and for the pace of a moving picture.

use crate::modes::modes;

modes! {
    /// Parts of a frame that a GPU may time.
    pub enum TimedPass {
        /// The model's depth from the key light.
        ShadowMap = "shadow map", "Shadow map";
        /// Normals and depth of the model in view.
        Geometry = "geometry", "Normals and depth";
        /// Ambient occlusion and its blur.
        AmbientOcclusion = "ambient occlusion", "Ambient occlusion";
        /// The model from below, and its blur.
        Contact = "contact", "Ground contact";
        /// The picture itself.
        Picture = "picture", "Picture";
    }
}

/// What drawing one frame cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameCost {
    /// Time that the CPU spent on posing and drawing, seconds; `None` where nobody took it.
    pub cpu_secs: Option<f32>,
    /// Time that the GPU spent on each of [`TimedPass::ALL`], seconds, in an earlier frame: its answer takes a while. 0 for a pass that was
    /// not drawn. `None` where the device tells no times.
    pub gpu_secs: Option<[f32; TimedPass::ALL.len()]>,
    /// Draws of the model, in all passes.
    pub draws: u64,
    /// Vertices of the model that were drawn, in all passes: an index counts each time that it is drawn, for each instance. Of several
    /// equal indices a GPU may transform the vertex once. A map that is kept draws none.
    pub vertices: u64,
    /// Bytes that were uploaded since the frame before: what the frame needed, and before it model and maps where they are new.
    pub uploaded_bytes: u64,
}
