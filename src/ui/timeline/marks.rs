//! Keys as marks along a width: one by one if there is room, otherwise as bars.

use egui::{Color32, Mesh, Painter, Pos2, Rangef, Rect, Shape, Ui, pos2};

use super::axis::TimeAxis;

/// Keys closer than this are drawn as one bar.
pub const MERGE_POINTS: f32 = 3.0;
/// The greatest radius of a mark.
pub const MOST_RADIUS: f32 = 4.2;
const LEAST_RADIUS: f32 = 1.6;
/// Width of the outline of a hollow mark.
const LINE_WIDTH: f32 = 1.2;
const LEAST_HOLLOW_RADIUS: f32 = 2.4;
const BAR_RADIUS: f32 = 1.5;

/// A mark of one key or of many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    Key(f32),
    /// Keys too close to be told apart.
    Run(Rangef),
}

/// The marks of key times in order, from the left. There are no more than fit the width, and a binary search skips merged keys, so
/// the count of keys does not matter.
pub fn marks(times_secs: &[f32], axis: &TimeAxis, mut draw: impl FnMut(Mark)) {
    let seen = axis.points().expand(MOST_RADIUS);
    let first = times_secs.partition_point(|&secs| axis.x_of(secs) < seen.min);
    let end = times_secs.partition_point(|&secs| axis.x_of(secs) <= seen.max);
    let mut rest = &times_secs[first..end.max(first)];
    while let Some((&first_secs, after)) = rest.split_first() {
        let start = axis.x_of(first_secs);
        let mut last = start;
        rest = after;
        loop {
            let merged = rest.partition_point(|&secs| axis.x_of(secs) < last + MERGE_POINTS);
            let Some(&last_secs) = rest[..merged].last() else { break };
            last = axis.x_of(last_secs);
            rest = &rest[merged..];
        }
        draw(if last > start {
            Mark::Run(Rangef::new(start, last))
        } else {
            Mark::Key(start)
        });
    }
}

/// Radius of the marks of keys that are this far apart, in points.
pub(super) fn mark_radius(spacing: f32) -> f32 {
    (0.4 * spacing).clamp(LEAST_RADIUS, MOST_RADIUS)
}

/// Diamonds and bars in one mesh, so that thousands are cheap.
#[derive(Debug)]
pub(super) struct MarkShape {
    mesh: Mesh,
    /// Half the width of a soft edge.
    feather: f32,
}

impl MarkShape {
    /// An empty mesh.
    pub(super) fn new(ui: &Ui) -> Self {
        Self {
            mesh: Mesh::default(),
            feather: 0.7 / ui.pixels_per_point(),
        }
    }

    /// Adds the marks of a row whose middle is at `y`.
    pub(super) fn add(&mut self, times_secs: &[f32], axis: &TimeAxis, y: f32, radius: f32, color: Color32) {
        marks(times_secs, axis, |mark| match mark {
            Mark::Key(x) => self.diamond(pos2(x, y), radius, color),
            Mark::Run(points) => self.bar(points, y, BAR_RADIUS, color),
        });
    }

    /// Adds marks of which only the outline is drawn; bars are half as high.
    pub(super) fn add_hollow(&mut self, times_secs: &[f32], axis: &TimeAxis, y: f32, radius: f32, color: Color32) {
        marks(times_secs, axis, |mark| match mark {
            Mark::Key(x) if radius >= LEAST_HOLLOW_RADIUS => self.outline(pos2(x, y), radius, color),
            Mark::Key(x) => self.diamond(pos2(x, y), radius, color),
            Mark::Run(points) => self.bar(points, y, 0.5 * BAR_RADIUS, color),
        });
    }

    pub(super) fn bar(&mut self, points: Rangef, y: f32, radius: f32, color: Color32) {
        let rect = Rect::from_x_y_ranges(points.expand(0.5), Rangef::new(y - radius, y + radius));
        self.mesh.add_colored_rect(rect, color);
    }

    fn diamond(&mut self, center: Pos2, radius: f32, color: Color32) {
        let inner = self.corners(center, radius - self.feather, color);
        let outer = self.corners(center, radius + self.feather, Color32::TRANSPARENT);
        self.mesh.add_triangle(inner, inner + 1, inner + 2);
        self.mesh.add_triangle(inner, inner + 2, inner + 3);
        self.ring(inner, outer);
    }

    fn outline(&mut self, center: Pos2, radius: f32, color: Color32) {
        let rings = [
            (radius - LINE_WIDTH - self.feather, Color32::TRANSPARENT),
            (radius - LINE_WIDTH + self.feather, color),
            (radius - self.feather, color),
            (radius + self.feather, Color32::TRANSPARENT),
        ];
        let rings = rings.map(|(radius, color)| self.corners(center, radius.max(0.0), color));
        for pair in rings.windows(2) {
            self.ring(pair[0], pair[1]);
        }
    }

    /// Adds four corners around a point. Returns the index of the first.
    fn corners(&mut self, center: Pos2, radius: f32, color: Color32) -> u32 {
        let first = self.mesh.vertices.len() as u32;
        for (x, y) in [(0.0, -radius), (radius, 0.0), (0.0, radius), (-radius, 0.0)] {
            self.mesh.colored_vertex(pos2(center.x + x, center.y + y), color);
        }
        first
    }

    /// Fills the area between two sets of corners.
    fn ring(&mut self, inner: u32, outer: u32) {
        for corner in 0..4 {
            let next = (corner + 1) % 4;
            self.mesh.add_triangle(inner + corner, outer + corner, inner + next);
            self.mesh.add_triangle(inner + next, outer + corner, outer + next);
        }
    }

    pub(super) fn paint(self, painter: &Painter) {
        if !self.mesh.is_empty() {
            painter.add(Shape::mesh(self.mesh));
        }
    }
}
