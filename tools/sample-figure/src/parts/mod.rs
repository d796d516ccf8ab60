//! The figure, part by part. Lengths are in metres in the bind pose; limbs are described on the left and mirrored.

mod arm;
mod hand;
mod head;
mod leg;
mod pack;
mod torso;

use glam::{DVec2, DVec3};

use crate::maps::Mark;
use crate::materials::Material;
use crate::rig::Rig;
use crate::shape::{Binding, FINE, Frame, Grid, Loft, Plate, Ring, Solid, ring};

/// A solid and the chart of the atlas that it is laid on.
pub(crate) struct Piece {
    pub(crate) solid: Solid,
    pub(crate) chart: usize,
}

/// A part of the atlas.
pub(crate) struct Chart {
    /// Metres.
    pub(crate) size: DVec2,
    /// Of a plate.
    pub(crate) outline: Vec<DVec2>,
    pub(crate) marks: &'static [Mark],
}

/// The chart of pieces without marks: they all lie on the same plain patch.
pub(crate) const PLAIN: usize = 0;

/// Of painted words: what they leave of a material's colour.
const INK: [f64; 3] = [0.16, 0.17, 0.19];

/// Marks of a plate with nothing on it.
const PLATE: &[Mark] = &[Mark::Gap];

/// The figure's pieces as they are made.
pub(crate) struct Kit<'a> {
    pub(crate) rig: &'a Rig,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) charts: Vec<Chart>,
}

impl Kit<'_> {
    /// All pieces of the figure.
    pub(crate) fn figure(rig: &Rig) -> Kit<'_> {
        let plain = Chart {
            size: DVec2::splat(0.02),
            outline: Vec::new(),
            marks: &[],
        };
        let mut kit = Kit {
            rig,
            pieces: Vec::new(),
            charts: vec![plain],
        };
        head::add(&mut kit);
        torso::add(&mut kit);
        pack::add(&mut kit);
        arm::add(&mut kit);
        hand::add(&mut kit);
        leg::add(&mut kit);
        kit
    }

    fn chart(&mut self, solid: &Solid, marks: &'static [Mark]) -> usize {
        if marks.is_empty() {
            return PLAIN;
        }
        self.charts.push(Chart {
            size: solid.chart_size,
            outline: solid.outline.clone(),
            marks,
        });
        self.charts.len() - 1
    }

    /// A piece in the middle.
    fn one(&mut self, material: Material, grid: &Grid, binding: &Binding, marks: &'static [Mark]) {
        let solid = Solid::new(material, grid, binding);
        let chart = self.chart(&solid, marks);
        self.pieces.push(Piece { solid, chart });
    }

    /// A piece of the left side and its mirror image, each with marks of its own.
    fn sides(&mut self, material: Material, grid: &Grid, binding: &Binding, [left, right]: [&'static [Mark]; 2]) {
        let solid = Solid::new(material, grid, binding);
        let charts = [left, right].map(|marks| self.chart(&solid, marks));
        let mirrored = solid.mirrored();
        for (solid, chart) in [solid, mirrored].into_iter().zip(charts) {
            self.pieces.push(Piece { solid, chart });
        }
    }

    /// A piece of the left side and its mirror image, both with the same marks.
    fn pair(&mut self, material: Material, grid: &Grid, binding: &Binding, marks: &'static [Mark]) {
        let solid = Solid::new(material, grid, binding);
        let chart = self.chart(&solid, marks);
        let mirrored = solid.mirrored();
        self.pieces
            .extend([solid, mirrored].map(|solid| Piece { solid, chart }));
    }
}

/// A bolt with a bevelled head, standing on `origin`.
fn bolt(origin: DVec3, along: DVec3, radius: f64) -> Grid {
    let front = along.any_orthonormal_vector();
    let r = |at: f64, part: f64| ring(at * radius, part * radius, part * radius);
    let rings = [r(-0.5, 1.0), r(0.5, 1.0), r(0.75, 0.7), r(0.75, 0.0)];
    Loft::new(Frame::along(origin, along, front), Vec::from(rings)).grid(FINE)
}

/// Bellows as a stretch of rings: `count` ribs between two rings, each `depth` out of the wall.
fn ribs(from: Ring, to: Ring, count: usize, depth: f64) -> Vec<Ring> {
    // A fold, and both ends of a rib's flat top.
    let profile = [(0.0, 0.0), (0.2, depth), (0.8, depth)];
    let at = |part: f64, depth: f64| {
        let between = |a: f64, b: f64| a + (b - a) * part;
        Ring {
            at: between(from.at, to.at),
            half: from.half + (to.half - from.half) * part + depth,
            centre: from.centre + (to.centre - from.centre) * part,
            square: between(from.square, to.square),
            ..from
        }
    };
    let rib = |rib: usize| profile.map(|(part, depth)| at((rib as f64 + part) / count as f64, depth));
    (0..count).flat_map(rib).chain([to]).collect()
}

/// Adds a plate to a loft.
fn plate<'a>(on: &'a Loft, outline: &'a [[f64; 2]], lift: f64) -> Plate<'a> {
    Plate {
        on,
        outline,
        rounding: 0.014,
        lift,
        bevel: 0.0035,
        longest: 0.07,
    }
}
