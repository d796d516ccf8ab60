//! The space that a clip needs: a box around all that it reaches, and the few points by which it is framed.

use glam::{Vec3, Vec4};

use super::buffers::PoseBuffers;
use super::compile::CompiledClip;
use super::pose::Palette;
use super::skin::skin_position;
use super::vertex_groups::{MovedBox, VertexGroups};
use crate::model::{Aabb, Mesh, Model};
use crate::slices::{Slices, Stage};

/// The most vertices that are skinned for one box or one set of points: tens of milliseconds of work.
const VERTEX_BUDGET: usize = 8_000_000;

/// Lines along which the farthest points are kept, both ways. With 32 the hull of a round thing is short by about 3 %.
const AXES: usize = 32;
/// Times of a clip that are looked at, evenly spread.
const TIMES: usize = 12;

/// The space that a clip needs, in model space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extent {
    /// Box of the skinned vertices. A static model keeps its bind bounds.
    ///
    /// Exact at the key times: a vertex is left out only where the box of its group shows that it lies inside. Between two keys a turning
    /// part may reach a little further, by less than `r (1 − cos(θ / 2))` for a point at distance `r` that turns by `θ` between them. Two
    /// limits bound the work: above 1 000 key times the span is sampled evenly, and above 8 million vertices in all only the boxes of
    /// large groups are moved, so that the result is too large rather than too small.
    pub bounds: Aabb,
    /// The vertices that lie farthest in many directions, at times spread over the clip. Their hull is nearly that of all the model
    /// reaches, and they are at most `2 · 32` a time. Above 8 million vertices in all, of each group every n-th is looked at.
    pub points: Vec<Vec3>,
    /// Where the points of each time end.
    point_ends: Vec<usize>,
}

impl Extent {
    /// At so many times of a clip the farthest points are looked for.
    pub const MOST_POSES: usize = TIMES;

    /// The farthest points of each of these times.
    pub fn poses(&self) -> impl Iterator<Item = &[Vec3]> {
        let starts = std::iter::once(0).chain(self.point_ends.iter().copied());
        starts
            .zip(&self.point_ends)
            .map(|(start, &end)| &self.points[start..end])
    }

    /// That of a clip, or of rest without one. `groups` are those of the model's mesh.
    pub async fn of(model: &Model, groups: &VertexGroups, clip: Option<&CompiledClip>, slices: &Slices) -> Self {
        let mut job = ExtentJob::new(model, clip, slices).await;
        let all = job.times_left();
        loop {
            slices.pause_at(Stage::Measuring, all - job.times_left(), all).await;
            if !job.step(model, groups, clip, slices).await {
                return job.extent;
            }
        }
    }
}

/// Works out an [`Extent`], one time of the clip after the other. It is given the same model, groups and clip at each step.
struct ExtentJob {
    /// Times for the box that are left, the last first.
    bounds_times_secs: Vec<f32>,
    /// Box by boxes of joints: see [`Extent::bounds`].
    by_joint: Option<VertexGroups>,
    /// Times for the points that are left, the last first.
    points_times_secs: Vec<f32>,
    /// Vertices of a group are looked at in such steps.
    stride: usize,
    extremes: Extremes,
    buffers: PoseBuffers,
    extent: Extent,
}

impl ExtentJob {
    async fn new(model: &Model, clip: Option<&CompiledClip>, slices: &Slices) -> Self {
        let mesh = &model.mesh;
        let vertex_count = mesh.vertex_count();
        // A static model stands still.
        let clip = clip.filter(|_| !mesh.influences.is_empty());
        let (mut bounds_times_secs, mut points_times_secs) = (Vec::new(), vec![0.0]);
        if let Some(clip) = clip {
            bounds_times_secs = clip.probe_times_secs();
            bounds_times_secs.reverse();
            let length_secs = clip.end_secs() - clip.start_secs();
            let times = if length_secs > 0.0 { TIMES } else { 1 };
            let time_secs = |i| clip.start_secs() + i as f32 / (TIMES - 1) as f32 * length_secs;
            points_times_secs = (0..times).rev().map(time_secs).collect();
        }
        let is_too_much = vertex_count.saturating_mul(bounds_times_secs.len()) > VERTEX_BUDGET;
        Self {
            by_joint: match is_too_much {
                true => Some(VertexGroups::by_joint(mesh, slices).await),
                false => None,
            },
            stride: (vertex_count * points_times_secs.len()).div_ceil(VERTEX_BUDGET).max(1),
            bounds_times_secs,
            points_times_secs,
            extremes: Extremes::new(),
            buffers: PoseBuffers::for_skeleton(&model.skeleton),
            extent: Extent::default(),
        }
    }

    fn times_left(&self) -> usize {
        self.bounds_times_secs.len() + self.points_times_secs.len()
    }

    /// Looks at one time more. False when all is done.
    async fn step(
        &mut self,
        model: &Model,
        groups: &VertexGroups,
        clip: Option<&CompiledClip>,
        slices: &Slices,
    ) -> bool {
        let mesh = &model.mesh;
        let clip = clip.filter(|_| !mesh.influences.is_empty());
        // The points come first: the box then grows by their vertices at each time before it is asked which groups lie inside.
        let points_time_secs = self.points_times_secs.pop();
        let Some(time_secs) = points_time_secs.or_else(|| self.bounds_times_secs.pop()) else {
            return false;
        };
        if let Some(clip) = clip {
            self.buffers.evaluate(&model.skeleton, clip, time_secs);
        }
        if points_time_secs.is_none() {
            self.grow_bounds(mesh, groups, slices).await;
            return true;
        }
        // Vertices of a model in its bind pose are not moved.
        let is_bound = clip.is_none() && (mesh.influences.is_empty() || model.skeleton.rests_in_bind_pose());
        let pose = Pose {
            mesh,
            palette: (!is_bound).then_some(&self.buffers.palette),
        };
        self.extremes.look(&pose, groups, self.stride, slices).await;
        self.extremes.append(&pose, &mut self.extent.points);
        self.extent.point_ends.push(self.extent.points.len());
        if clip.is_none() {
            self.extent.bounds = pose.bounds();
        }
        true
    }

    async fn grow_bounds(&mut self, mesh: &Mesh, groups: &VertexGroups, slices: &Slices) {
        let (palette, bounds) = (&self.buffers.palette, &mut self.extent.bounds);
        if let Some(groups) = &self.by_joint {
            *bounds = groups
                .iter()
                .fold(*bounds, |bounds, (_, moved)| bounds.union(moved.in_pose(palette)));
            return;
        }
        let pose = Pose {
            mesh,
            palette: Some(palette),
        };
        let farthest = self.extremes.last.iter();
        *bounds = farthest.fold(*bounds, |bounds, &vertex| bounds.include(pose.place(vertex)));
        let grow = |(vertices, moved): (&[u32], &MovedBox)| {
            let moved = moved.narrow_in_pose(palette);
            if !(moved.min.cmpge(bounds.min).all() && moved.max.cmple(bounds.max).all()) {
                *bounds = vertices
                    .iter()
                    .fold(*bounds, |bounds, &vertex| bounds.include(pose.place(vertex)));
            }
        };
        slices.for_each(groups.iter(), grow).await;
    }
}

/// A mesh as a palette moves it, or as it is in the file.
struct Pose<'a> {
    mesh: &'a Mesh,
    palette: Option<&'a Palette>,
}

impl Pose<'_> {
    /// Where a vertex is, model space.
    fn place(&self, vertex: u32) -> Vec3 {
        let vertex = vertex as usize;
        let position = self.mesh.positions[vertex];
        self.palette.map_or(position, |palette| {
            skin_position(palette, &self.mesh.influences[vertex], position)
        })
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_points((0..self.mesh.vertex_count() as u32).map(|vertex| self.place(vertex)))
    }
}

/// Four directions side by side, and which vertices lie farthest along them and against them.
#[derive(Clone, Copy, Debug)]
struct ExtremeLanes {
    x: Vec4,
    y: Vec4,
    z: Vec4,
    greatest: Vec4,
    least: Vec4,
    /// Vertices there: along, against.
    vertices: [[u32; 2]; 4],
}

/// The vertices that lie farthest along directions spread evenly over a sphere; of those that lie equally far the first of the mesh.
#[derive(Clone, Debug)]
struct Extremes {
    lanes: [ExtremeLanes; AXES / 4],
    /// The vertices of the last look: at the next time they lie far out too, so that most groups can be passed over from the start.
    last: Vec<u32>,
}

impl Extremes {
    fn new() -> Self {
        let lanes = std::array::from_fn(|group| {
            let axes: [Vec3; 4] = std::array::from_fn(|lane| axis(4 * group + lane));
            ExtremeLanes {
                x: Vec4::from_array(axes.map(|axis| axis.x)),
                y: Vec4::from_array(axes.map(|axis| axis.y)),
                z: Vec4::from_array(axes.map(|axis| axis.z)),
                greatest: Vec4::NEG_INFINITY,
                least: Vec4::INFINITY,
                vertices: [[u32::MAX; 2]; 4],
            }
        });
        Self {
            lanes,
            last: Vec::new(),
        }
    }

    /// Finds those of a pose. Of each group every n-th vertex counts.
    async fn look(&mut self, pose: &Pose<'_>, groups: &VertexGroups, stride: usize, slices: &Slices) {
        for lanes in &mut self.lanes {
            (lanes.greatest, lanes.least) = (Vec4::NEG_INFINITY, Vec4::INFINITY);
            lanes.vertices = [[u32::MAX; 2]; 4];
        }
        for vertex in std::mem::take(&mut self.last) {
            self.take(vertex, pose.place(vertex));
        }
        let bound = Palette::default();
        let look = |(vertices, moved): (&[u32], &MovedBox)| {
            let reached = self.may_reach_out(&moved.narrow_in_pose(pose.palette.unwrap_or(&bound)));
            if reached != 0 {
                for &vertex in vertices.iter().step_by(stride) {
                    self.take_along(reached, vertex, pose.place(vertex));
                }
            }
        };
        slices.for_each(groups.iter(), look).await;
        let met = self.lanes.iter().flat_map(|lanes| lanes.vertices).flatten();
        self.last.extend(met.filter(|&vertex| vertex != u32::MAX));
        self.last.sort_unstable();
        self.last.dedup();
    }

    /// Along which lanes something in a box may lie as far as what is known: a bit for each.
    fn may_reach_out(&self, within: &Aabb) -> u32 {
        let (center, half) = ((within.min + within.max) * 0.5, (within.max - within.min) * 0.5);
        self.lanes.iter().rev().fold(0, |reached, lanes| {
            let middle = lanes.along(center);
            let reach = lanes.x.abs() * half.x + lanes.y.abs() * half.y + lanes.z.abs() * half.z;
            // Not so where one of them is no number.
            let is_within = ((middle + reach).cmplt(lanes.greatest) & (middle - reach).cmpgt(lanes.least)).all();
            reached << 1 | u32::from(!is_within)
        })
    }

    fn take(&mut self, vertex: u32, position: Vec3) {
        self.take_along((1 << (AXES / 4)) - 1, vertex, position);
    }

    /// Takes a vertex where it lies farther than those before, along the lanes whose bits are set.
    #[inline]
    fn take_along(&mut self, mut reached: u32, vertex: u32, position: Vec3) {
        while let Some(lanes) = self.lanes.get_mut(reached.trailing_zeros() as usize) {
            reached &= reached - 1;
            let along = lanes.along(position);
            if (along.cmpge(lanes.greatest) | along.cmple(lanes.least)).any() {
                lanes.take(vertex, along);
            }
        }
    }

    /// Adds where they are, direction by direction.
    fn append(&self, pose: &Pose<'_>, points: &mut Vec<Vec3>) {
        let vertices = self.lanes.iter().flat_map(|lanes| lanes.vertices).flatten();
        points.extend(
            vertices
                .filter(|&vertex| vertex != u32::MAX)
                .map(|vertex| pose.place(vertex)),
        );
    }
}

impl ExtremeLanes {
    fn along(&self, position: Vec3) -> Vec4 {
        self.x * position.x + self.y * position.y + self.z * position.z
    }

    fn take(&mut self, vertex: u32, along: Vec4) {
        for (lane, [far, near]) in self.vertices.iter_mut().enumerate() {
            let along = along[lane];
            if along > self.greatest[lane] || (along == self.greatest[lane] && vertex < *far) {
                (self.greatest[lane], *far) = (along, vertex);
            }
            if along < self.least[lane] || (along == self.least[lane] && vertex < *near) {
                (self.least[lane], *near) = (along, vertex);
            }
        }
    }
}

/// One of [`AXES`] directions spread evenly over half a sphere (a Fibonacci lattice).
fn axis(index: usize) -> Vec3 {
    let golden_angle = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    let y = 1.0 - (index as f32 + 0.5) / AXES as f32;
    let (sin, cos) = (golden_angle * index as f32).sin_cos();
    let radius = (1.0 - y * y).sqrt();
    Vec3::new(radius * cos, y, radius * sin)
}
