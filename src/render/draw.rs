//! One frame: what is written, and what is drawn into which texture, in order.

use crate::model::Handedness;
use crate::scene::{FrameCost, Light, Pass, RenderFrame, ViewMode};

use super::Renderer;
use super::band::Band;
use super::instances::{InstanceRange, pose_count, poses};
use super::light_passes::Common;
use super::model::{GpuModel, Posed};
use super::recipe::{Cut, Draw, Faces, Maps, ModelDraw, Purpose, Shading};
use super::target::Target;
use super::timing::FrameEncoder;
use super::uniforms::map_band;
use super::view::View;

/// A range of columns of the picture, pixels, under one light. Two lights are two draws of one frame, each inside its columns: no blending,
/// no second target, and each shows what it alone would show.
type Columns = (Light, std::ops::Range<u32>);

impl Renderer {
    /// Draws a frame, or what lies over the model alone where the scene stays. Returns what is known of its cost.
    pub(super) fn draw(
        &mut self,
        frame: &RenderFrame<'_>,
        target: &mut Target,
        encoder: &mut FrameEncoder,
        scene_stays: bool,
    ) -> FrameCost {
        let common = &mut self.common;
        common.environments.write(&common.device, &common.queue, frame);
        let (device, queue) = (&self.common.device, &self.common.queue);
        let mut posed_anew = false;
        if let Some(model) = &mut self.model {
            if let Some(bones) = &mut model.bones {
                let ghosts = frame.ghosts.palettes.iter().map(|palette| &palette.0[..]);
                bones.write(queue, poses(frame).chain(ghosts));
                posed_anew = bones.first_changed(pose_count(frame));
            }
            if let Some(colors) = &frame.vertex_colors {
                model.set_colors(device, queue, colors);
            }
            let mirrors = frame.world_from_model.matrix3.determinant() < 0.0;
            let is_clockwise = (model.handedness == Handedness::Right) == mirrors;
            let sides = [(Faces::Counterclockwise, -1.0), (Faces::Clockwise, 1.0)];
            let (front, front_sign) = sides[usize::from(is_clockwise)];
            model.front = front;
            self.instances
                .write(device, queue, frame, model.bones.as_ref(), front_sign);
        }
        self.overlays.write(device, queue, frame);
        self.shape.update(frame, self.instances.roster(), posed_anew);
        let (parts, is_sample) = (parts(frame, target.size()), frame.sample.is_some());
        let (band, map) = (target.band(), map_band(frame, target.band()));
        let view = if is_sample { &mut self.at_rest } else { &mut self.window };
        for (light, _) in &parts {
            view.add_light(&self.common, *light, self.options.shadow_map_side);
        }
        if frame.options.draws(Pass::AmbientOcclusion) {
            view.make_room(device, target, map, is_sample);
        }
        let pipelines = &self.common.pipelines;
        let model = self.model.as_ref().map(|model| {
            let bones = model.bones.as_ref().filter(|_| !frame.palette.0.is_empty());
            let posed = Posed {
                pipelines,
                bones: bones.unwrap_or(&self.no_bones),
                instances: self.instances.all(),
                skinned: bones.is_some(),
                hidden: frame.hidden_submeshes,
            };
            (model, posed)
        });
        let columns_of = |light| parts.iter().find(|part| part.0 == light).map(|(_, columns)| columns);
        let View { lights, geometry } = view;
        for passes in lights.iter_mut() {
            if columns_of(passes.light()).is_none() {
                continue;
            }
            passes.write(&self.common, frame, band);
            if scene_stays {
                continue;
            }
            let is_read = frame.draws_under(Pass::AmbientOcclusion, passes.light());
            if let (true, Some(model), Some(geometry)) = (is_read, model, &mut *geometry) {
                let model = with(model, self.instances.in_sight());
                let shape = (self.shape.revision_in_sight, model);
                passes.draw_geometry(&self.common, encoder, (geometry, map), shape);
            }
        }
        for passes in lights.iter_mut().filter(|_| !scene_stays) {
            if let Some(columns) = columns_of(passes.light()) {
                let (geometry, shape) = (geometry.as_ref(), (self.shape.revision, model));
                passes.draw(&self.common, encoder, frame, (columns, band, geometry), shape);
            }
        }
        let own = model.map(|model| with(model, self.instances.own()));
        pipelines.set_samples(target.samples());
        target.set_overlays(frame.has_overlays(), !scene_stays, frame.sample);
        if !scene_stays {
            self.draw_picture(frame, target, &parts, own, encoder);
        }
        target.draw_layer(&self.common.device, encoder, frame.has_overlays(), |pass, kind| {
            self.draw_over(frame, band, &parts, own, pass, [kind == 0, kind == 1]);
        });
        let [draws, vertices] = model.map_or([0; 2], |(model, _)| model.take_drawn());
        FrameCost {
            draws,
            vertices,
            uploaded_bytes: self.common.queue.take_bytes(),
            ..FrameCost::default()
        }
    }

    fn draw_picture(
        &self,
        frame: &RenderFrame<'_>,
        target: &Target,
        parts: &[Columns],
        model: Option<(&GpuModel, Posed<'_>)>,
        encoder: &mut FrameEncoder,
    ) {
        let height = target.size()[1];
        let options = &frame.options;
        let Common { pipelines, nothing, .. } = &self.common;
        let is_lit = options.view_mode == ViewMode::Lit;
        // Colours of the skin are the own instance's alone.
        let colored = frame.vertex_colors.is_some();
        // The backdrop replaces all that the model leaves, alpha too. Smooth edges store no alpha: it is there from the beginning.
        let mut pass = target.begin_pass(encoder, wgpu::Color::BLACK, frame.sample);
        let begin_part = |pass: &mut wgpu::RenderPass<'_>, part: &Columns| self.begin_part(pass, frame, part, height);
        for part in parts {
            if let Some((model, own)) = model
                && begin_part(&mut pass, part)
            {
                let shading = if is_lit { Shading::Lit(part.0) } else { Shading::Inspect };
                let instances = if colored {
                    self.instances.crowd_in_sight()
                } else {
                    self.instances.in_sight()
                };
                if instances.count > 0 {
                    let (_, posed) = with((model, own), instances);
                    let purpose = match frame.sample {
                        Some(_) => Purpose::Sample(shading),
                        None => Purpose::Picture(shading),
                    };
                    model.draw(&mut pass, posed, purpose);
                }
                if colored {
                    pass.set_bind_group(2, nothing, &[]);
                    model.draw(&mut pass, own, Purpose::SkinView);
                }
            }
        }
        // Backgrounds from the right: Mesa's software rasteriser fills one column too many at the left of a scissor rectangle.
        for part in parts.iter().rev() {
            if begin_part(&mut pass, part) {
                pass.set_pipeline(&pipelines.get(Draw::Backdrop));
                pass.draw(0..3, 0..1);
            }
        }
        // After the background, which shows through it.
        let blended = model
            .filter(|_| is_lit)
            .map(|(model, _)| model.blended(frame, !colored));
        for part in parts.iter().rev() {
            if let (Some(model), Some(order)) = (model, &blended)
                && !order.is_empty()
                && begin_part(&mut pass, part)
            {
                let (model, posed) = with(model, self.instances.in_sight());
                let draw = ModelDraw::Mesh(Shading::Lit(part.0), Cut::Blended, Maps::All);
                model.draw_blended(&mut pass, posed, order, draw);
            }
        }
        if !target.has_layer() {
            self.draw_over(frame, target.band(), parts, model, &mut pass, [true; 2]);
        }
        // GL resolves the samples by a copy, which the scissor would cut.
        let [width, height] = target.size();
        pass.set_scissor_rect(0, 0, width, height);
    }

    /// Draws what lies over the model: what it can hide, what is seen through it, or both.
    fn draw_over(
        &self,
        frame: &RenderFrame<'_>,
        band: Band,
        parts: &[Columns],
        model: Option<(&GpuModel, Posed<'_>)>,
        pass: &mut wgpu::RenderPass<'_>,
        [on_model, seen_through]: [bool; 2],
    ) {
        let common = &self.common;
        let Common { pipelines, nothing, .. } = common;
        for part in parts {
            if !self.begin_part(pass, frame, part, band.rows) {
                continue;
            }
            if let Some(model) = model.filter(|_| on_model) {
                pass.set_bind_group(2, nothing, &[]);
                self.overlays.draw_on_model(common, pass, frame, model, &self.instances);
            }
            for through in [on_model.then_some(false), seen_through.then_some(true)]
                .into_iter()
                .flatten()
            {
                self.overlays.draw_shapes(pass, pipelines, nothing, band, through);
            }
        }
        // As above.
        pass.set_scissor_rect(0, 0, band.whole[0], band.rows);
    }

    /// Begins to draw into these columns, under their light. False where that was never drawn.
    fn begin_part(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &RenderFrame<'_>,
        (light, columns): &Columns,
        height: u32,
    ) -> bool {
        let view = if frame.sample.is_some() {
            &self.at_rest
        } else {
            &self.window
        };
        let passes = view.lights.iter().find(|passes| passes.light() == *light);
        let Some((passes, [contact, lighting])) = passes.and_then(|passes| Some((passes, passes.lit_groups()?))) else {
            return false;
        };
        pass.set_scissor_rect(columns.start, 0, columns.len() as u32, height);
        pass.set_bind_group(0, passes.frame_group(), &[]);
        pass.set_bind_group(1, contact, &[]);
        pass.set_bind_group(2, lighting, &[]);
        true
    }
}

/// A model drawn with other instances.
fn with<'a>((model, posed): (&'a GpuModel, Posed<'a>), instances: InstanceRange<'a>) -> (&'a GpuModel, Posed<'a>) {
    (model, Posed { instances, ..posed })
}

/// Which light shows in which columns of the picture, from the left.
fn parts(frame: &RenderFrame<'_>, [width, _]: [u32; 2]) -> Vec<Columns> {
    let Some(fraction) = frame.options.split else {
        return vec![(frame.options.light, 0..width)];
    };
    let at = ((fraction.clamp(0.0, 1.0) * width as f32).round() as u32).min(width);
    let light = frame.options.light;
    let mut parts = vec![(light.other(), 0..at), (light, at..width)];
    parts.retain(|(_, columns)| !columns.is_empty());
    parts
}
