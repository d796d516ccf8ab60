//! One family of icons, drawn with lines of one weight in a box of 16 units.

use std::f32::consts::FRAC_PI_2;

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, vec2};

/// Line weight in points.
const LINE_WIDTH: f32 = 1.4;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::ui) enum Icon {
    Play,
    /// Stop playing.
    Pause,
    /// To the first frame.
    SkipStart,
    /// To the last frame.
    SkipEnd,
    PlayBackward,
    StepBack,
    StepForward,
    /// To the key before.
    KeyBack,
    /// To the key after.
    KeyForward,
    /// Keys in rows.
    DopeSheet,
    /// What moves most first.
    Sort,
    Fold,
    /// Two into one.
    Blend,
    Plus,
    /// Others by chance.
    Dice,
    /// Stop at the end.
    Once,
    Loop,
    PingPong,
    /// Fit into view.
    Frame,
    /// Direction to look from.
    Cube,
    Open,
    /// Save as another format.
    Export,
    /// The other theme, dark or light.
    Contrast,
    /// Light on the model.
    Sun,
    /// Lines over the model.
    Layers,
    Turntable,
    /// A picture as a file.
    Camera,
    Eye,
    /// It cannot be seen.
    EyeOff,
    /// Nothing but this.
    Solo,
    /// Take the last edit back.
    Undo,
    /// Do again what was undone.
    Redo,
    Help,
    Close,
    ChevronDown,
    Dots,
}

/// Draws an icon centred in `rect`, 16 points high.
pub(in crate::ui) fn paint(painter: &Painter, rect: Rect, icon: Icon, color: Color32) {
    let origin = rect.center() - vec2(8.0, 8.0);
    let at = |x: f32, y: f32| -> Pos2 { origin + vec2(x, y) };
    let stroke = Stroke::new(LINE_WIDTH, color);
    let line = |points: &[(f32, f32)]| {
        painter.add(Shape::line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke));
    };
    let closed = |points: &[(f32, f32)]| {
        painter.add(Shape::closed_line(
            points.iter().map(|&(x, y)| at(x, y)).collect(),
            stroke,
        ));
    };
    let filled = |points: &[(f32, f32)]| {
        painter.add(Shape::convex_polygon(
            points.iter().map(|&(x, y)| at(x, y)).collect(),
            color,
            Stroke::NONE,
        ));
    };
    let box_of = |x0: f32, y0: f32, x1: f32, y1: f32| Rect::from_min_max(at(x0, y0), at(x1, y1));
    // Part of a circle about (cx, cy), angles in quarter turns clockwise from the right.
    let arc = |cx: f32, cy: f32, radius: f32, from: f32, to: f32| {
        let points = (0..=20).map(|i| {
            let angle = (from + (to - from) * i as f32 / 20.0) * std::f32::consts::FRAC_PI_2;
            at(cx + radius * angle.cos(), cy + radius * angle.sin())
        });
        painter.add(Shape::line(points.collect(), stroke));
    };
    match icon {
        Icon::Play => filled(&[(5.0, 3.2), (13.2, 8.0), (5.0, 12.8)]),
        Icon::Pause => {
            painter.rect_filled(box_of(4.2, 3.4, 6.8, 12.6), 0.8, color);
            painter.rect_filled(box_of(9.2, 3.4, 11.8, 12.6), 0.8, color);
        }
        Icon::SkipStart => {
            line(&[(3.6, 3.6), (3.6, 12.4)]);
            filled(&[(12.4, 3.6), (12.4, 12.4), (5.6, 8.0)]);
        }
        Icon::SkipEnd => {
            line(&[(12.4, 3.6), (12.4, 12.4)]);
            filled(&[(3.6, 3.6), (10.4, 8.0), (3.6, 12.4)]);
        }
        Icon::Once => {
            line(&[(2.0, 8.0), (11.0, 8.0)]);
            line(&[(8.0, 5.0), (11.0, 8.0), (8.0, 11.0)]);
            line(&[(13.6, 3.6), (13.6, 12.4)]);
        }
        Icon::Loop => {
            line(&[(2.4, 7.4), (2.4, 6.4), (3.0, 5.0), (4.4, 4.4), (13.2, 4.4)]);
            line(&[(10.8, 2.0), (13.2, 4.4), (10.8, 6.8)]);
            line(&[(13.6, 8.6), (13.6, 9.6), (13.0, 11.0), (11.6, 11.6), (2.8, 11.6)]);
            line(&[(5.2, 14.0), (2.8, 11.6), (5.2, 9.2)]);
        }
        Icon::PingPong => {
            line(&[(2.0, 8.0), (14.0, 8.0)]);
            line(&[(5.0, 5.0), (2.0, 8.0), (5.0, 11.0)]);
            line(&[(11.0, 5.0), (14.0, 8.0), (11.0, 11.0)]);
        }
        Icon::Frame => {
            line(&[(2.4, 5.4), (2.4, 2.4), (5.4, 2.4)]);
            line(&[(10.6, 2.4), (13.6, 2.4), (13.6, 5.4)]);
            line(&[(13.6, 10.6), (13.6, 13.6), (10.6, 13.6)]);
            line(&[(5.4, 13.6), (2.4, 13.6), (2.4, 10.6)]);
            painter.circle_filled(at(8.0, 8.0), 1.6, color);
        }
        Icon::Cube => {
            closed(&[
                (8.0, 1.8),
                (13.6, 4.9),
                (13.6, 11.1),
                (8.0, 14.2),
                (2.4, 11.1),
                (2.4, 4.9),
            ]);
            line(&[(2.4, 4.9), (8.0, 8.0), (13.6, 4.9)]);
            line(&[(8.0, 8.0), (8.0, 14.2)]);
        }
        Icon::Open => {
            line(&[
                (2.0, 12.6),
                (2.0, 3.4),
                (6.2, 3.4),
                (7.8, 5.2),
                (13.0, 5.2),
                (13.0, 7.2),
            ]);
            closed(&[(2.0, 12.6), (4.4, 7.2), (15.0, 7.2), (12.6, 12.6)]);
        }
        Icon::Contrast => {
            painter.circle_stroke(at(8.0, 8.0), 5.6, stroke);
            let half = (0..=16).map(|i| {
                let angle = (i as f32 / 16.0 - 0.5) * std::f32::consts::PI;
                at(8.0 + 5.6 * angle.cos(), 8.0 + 5.6 * angle.sin())
            });
            painter.add(Shape::convex_polygon(half.collect(), color, Stroke::NONE));
        }
        Icon::Sun => {
            painter.circle_stroke(at(8.0, 8.0), 2.9, stroke);
            for i in 0..8 {
                let (sin, cos) = (i as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
                line(&[(8.0 + 5.0 * cos, 8.0 + 5.0 * sin), (8.0 + 6.6 * cos, 8.0 + 6.6 * sin)]);
            }
        }
        Icon::Layers => {
            closed(&[(8.0, 2.2), (14.0, 5.4), (8.0, 8.6), (2.0, 5.4)]);
            line(&[(2.0, 8.2), (8.0, 11.4), (14.0, 8.2)]);
            line(&[(2.0, 11.0), (8.0, 14.2), (14.0, 11.0)]);
        }
        Icon::Turntable => {
            arc(8.0, 8.0, 5.6, -0.55, 2.75);
            line(&[(13.9, 6.6), (12.0, 3.3), (8.6, 4.9)]);
            painter.circle_filled(at(8.0, 8.0), 1.6, color);
        }
        Icon::Camera => {
            closed(&[
                (1.8, 5.0),
                (4.6, 5.0),
                (5.8, 3.0),
                (10.2, 3.0),
                (11.4, 5.0),
                (14.2, 5.0),
                (14.2, 12.8),
                (1.8, 12.8),
            ]);
            painter.circle_stroke(at(8.0, 8.7), 2.4, stroke);
        }
        Icon::Export => {
            line(&[(3.0, 9.5), (3.0, 13.0), (13.0, 13.0), (13.0, 9.5)]);
            line(&[(8.0, 2.6), (8.0, 10.0)]);
            line(&[(5.0, 7.2), (8.0, 10.2), (11.0, 7.2)]);
        }
        Icon::Eye => {
            arc(8.0, 11.54, 7.14, -1.67, -0.33);
            arc(8.0, 4.46, 7.14, 0.33, 1.67);
            painter.circle_filled(at(8.0, 8.0), 1.9, color);
        }
        Icon::EyeOff => {
            arc(8.0, 11.54, 7.14, -1.67, -0.33);
            arc(8.0, 4.46, 7.14, 0.33, 1.67);
            line(&[(3.2, 13.0), (12.8, 3.0)]);
        }
        Icon::Solo => {
            painter.circle_stroke(at(8.0, 8.0), 4.6, stroke);
            painter.circle_filled(at(8.0, 8.0), 1.7, color);
            for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                line(&[(8.0 + 4.6 * x, 8.0 + 4.6 * y), (8.0 + 6.6 * x, 8.0 + 6.6 * y)]);
            }
        }
        Icon::Undo => {
            line(&[(5.8, 2.6), (2.6, 5.8), (5.8, 9.0)]);
            line(&[(2.6, 5.8), (9.8, 5.8)]);
            arc(9.8, 9.4, 3.6, -FRAC_PI_2, FRAC_PI_2);
            line(&[(9.8, 13.0), (5.4, 13.0)]);
        }
        Icon::Redo => {
            line(&[(10.2, 2.6), (13.4, 5.8), (10.2, 9.0)]);
            line(&[(13.4, 5.8), (6.2, 5.8)]);
            arc(6.2, 9.4, 3.6, FRAC_PI_2, 3.0 * FRAC_PI_2);
            line(&[(6.2, 13.0), (10.6, 13.0)]);
        }
        Icon::Help => {
            arc(8.0, 5.9, 2.9, 2.0, 4.9);
            line(&[(10.65, 7.1), (8.0, 8.7), (8.0, 10.2)]);
            painter.circle_filled(at(8.0, 12.7), 1.0, color);
        }
        Icon::Close => {
            line(&[(4.2, 4.2), (11.8, 11.8)]);
            line(&[(11.8, 4.2), (4.2, 11.8)]);
        }
        Icon::PlayBackward => filled(&[(11.0, 3.2), (11.0, 12.8), (2.8, 8.0)]),
        Icon::StepBack => {
            filled(&[(9.4, 4.2), (9.4, 11.8), (3.4, 8.0)]);
            line(&[(12.2, 4.0), (12.2, 12.0)]);
        }
        Icon::StepForward => {
            filled(&[(6.6, 4.2), (12.6, 8.0), (6.6, 11.8)]);
            line(&[(3.8, 4.0), (3.8, 12.0)]);
        }
        Icon::KeyBack => {
            line(&[(6.0, 4.6), (2.6, 8.0), (6.0, 11.4)]);
            filled(&[(11.0, 4.6), (14.4, 8.0), (11.0, 11.4), (7.6, 8.0)]);
        }
        Icon::KeyForward => {
            line(&[(10.0, 4.6), (13.4, 8.0), (10.0, 11.4)]);
            filled(&[(5.0, 4.6), (8.4, 8.0), (5.0, 11.4), (1.6, 8.0)]);
        }
        Icon::DopeSheet => {
            for (y, keys) in [(3.6, [3.4, 8.0]), (8.0, [6.0, 12.6]), (12.4, [3.4, 10.4])] {
                line(&[(1.6, y), (14.4, y)]);
                for x in keys {
                    filled(&[(x, y - 2.0), (x + 2.0, y), (x, y + 2.0), (x - 2.0, y)]);
                }
            }
        }
        Icon::Sort => {
            for (y, end) in [(3.8, 14.0), (8.0, 10.4), (12.2, 6.0)] {
                line(&[(2.0, y), (end, y)]);
            }
        }
        Icon::Fold => {
            line(&[(4.6, 1.8), (8.0, 5.0), (11.4, 1.8)]);
            line(&[(2.4, 8.0), (13.6, 8.0)]);
            line(&[(4.6, 14.2), (8.0, 11.0), (11.4, 14.2)]);
        }
        Icon::Blend => {
            painter.circle_stroke(at(5.8, 8.0), 3.9, stroke);
            painter.circle_stroke(at(10.2, 8.0), 3.9, stroke);
        }
        Icon::Plus => {
            line(&[(8.0, 3.4), (8.0, 12.6)]);
            line(&[(3.4, 8.0), (12.6, 8.0)]);
        }
        Icon::Dice => {
            painter.rect_stroke(box_of(2.6, 2.6, 13.4, 13.4), 2.4, stroke, StrokeKind::Middle);
            for (x, y) in [(5.4, 5.4), (8.0, 8.0), (10.6, 10.6)] {
                painter.circle_filled(at(x, y), 1.1, color);
            }
        }
        Icon::ChevronDown => line(&[(4.6, 6.4), (8.0, 9.8), (11.4, 6.4)]),
        Icon::Dots => {
            for x in [3.6, 8.0, 12.4] {
                painter.circle_filled(at(x, 8.0), 1.2, color);
            }
        }
    }
}
