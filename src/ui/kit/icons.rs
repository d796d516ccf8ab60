//! One family of icons, drawn with lines of one weight in a box of 16 units.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

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

impl Icon {
    /// What it is drawn of, `line 8,3 8,12; dot 8,8 1.6`. Points are x right and y down. A line, a closed one and a filled one go through
    /// points; a ring, a dot and a half, filled on the right, have a middle and a radius; an arc has its angles too, in quarter turns
    /// clockwise from the right; rays go from one radius to another, so many; a box is drawn and a bar filled between two corners.
    fn parts(self) -> &'static str {
        match self {
            Self::Play => "fill 5,3.2 13.2,8 5,12.8",
            Self::Pause => "bar 4.2,3.4 6.8,12.6; bar 9.2,3.4 11.8,12.6",
            Self::SkipStart => "line 3.6,3.6 3.6,12.4; fill 12.4,3.6 12.4,12.4 5.6,8",
            Self::SkipEnd => "line 12.4,3.6 12.4,12.4; fill 3.6,3.6 10.4,8 3.6,12.4",
            Self::PlayBackward => "fill 11,3.2 11,12.8 2.8,8",
            Self::StepBack => "fill 9.4,4.2 9.4,11.8 3.4,8; line 12.2,4 12.2,12",
            Self::StepForward => "fill 6.6,4.2 12.6,8 6.6,11.8; line 3.8,4 3.8,12",
            Self::KeyBack => "line 6,4.6 2.6,8 6,11.4; fill 11,4.6 14.4,8 11,11.4 7.6,8",
            Self::KeyForward => "line 10,4.6 13.4,8 10,11.4; fill 5,4.6 8.4,8 5,11.4 1.6,8",
            Self::DopeSheet => concat!(
                "line 1.6,3.6 14.4,3.6; fill 3.4,1.6 5.4,3.6 3.4,5.6 1.4,3.6; fill 8,1.6 10,3.6 8,5.6 6,3.6; ",
                "line 1.6,8 14.4,8; fill 6,6 8,8 6,10 4,8; fill 12.6,6 14.6,8 12.6,10 10.6,8; ",
                "line 1.6,12.4 14.4,12.4; fill 3.4,10.4 5.4,12.4 3.4,14.4 1.4,12.4; fill 10.4,10.4 12.4,12.4 10.4,14.4 8.4,12.4",
            ),
            Self::Sort => "line 2,3.8 14,3.8; line 2,8 10.4,8; line 2,12.2 6,12.2",
            Self::Fold => "line 4.6,1.8 8,5 11.4,1.8; line 2.4,8 13.6,8; line 4.6,14.2 8,11 11.4,14.2",
            Self::Blend => "ring 5.8,8 3.9; ring 10.2,8 3.9",
            Self::Plus => "line 8,3.4 8,12.6; line 3.4,8 12.6,8",
            Self::Dice => "box 2.6,2.6 13.4,13.4; dot 5.4,5.4 1.1; dot 8,8 1.1; dot 10.6,10.6 1.1",
            Self::Once => "line 2,8 11,8; line 8,5 11,8 8,11; line 13.6,3.6 13.6,12.4",
            Self::Loop => concat!(
                "line 2.4,7.4 2.4,6.4 3,5 4.4,4.4 13.2,4.4; line 10.8,2 13.2,4.4 10.8,6.8; ",
                "line 13.6,8.6 13.6,9.6 13,11 11.6,11.6 2.8,11.6; line 5.2,14 2.8,11.6 5.2,9.2",
            ),
            Self::PingPong => "line 2,8 14,8; line 5,5 2,8 5,11; line 11,5 14,8 11,11",
            Self::Frame => concat!(
                "line 2.4,5.4 2.4,2.4 5.4,2.4; line 10.6,2.4 13.6,2.4 13.6,5.4; ",
                "line 13.6,10.6 13.6,13.6 10.6,13.6; line 5.4,13.6 2.4,13.6 2.4,10.6; dot 8,8 1.6",
            ),
            Self::Cube => {
                "closed 8,1.8 13.6,4.9 13.6,11.1 8,14.2 2.4,11.1 2.4,4.9; line 2.4,4.9 8,8 13.6,4.9; line 8,8 8,14.2"
            }
            Self::Open => "line 2,12.6 2,3.4 6.2,3.4 7.8,5.2 13,5.2 13,7.2; closed 2,12.6 4.4,7.2 15,7.2 12.6,12.6",
            Self::Export => "line 3,9.5 3,13 13,13 13,9.5; line 8,2.6 8,10; line 5,7.2 8,10.2 11,7.2",
            Self::Contrast => "ring 8,8 5.6; half 8,8 5.6",
            Self::Sun => "ring 8,8 2.9; rays 8,8 5,6.6 8",
            Self::Layers => "closed 8,2.2 14,5.4 8,8.6 2,5.4; line 2,8.2 8,11.4 14,8.2; line 2,11 8,14.2 14,11",
            Self::Turntable => "arc 8,8 5.6 -0.55,2.75; line 13.9,6.6 12,3.3 8.6,4.9; dot 8,8 1.6",
            Self::Camera => "closed 1.8,5 4.6,5 5.8,3 10.2,3 11.4,5 14.2,5 14.2,12.8 1.8,12.8; ring 8,8.7 2.4",
            Self::Eye => "arc 8,11.54 7.14 -1.67,-0.33; arc 8,4.46 7.14 0.33,1.67; dot 8,8 1.9",
            Self::EyeOff => "arc 8,11.54 7.14 -1.67,-0.33; arc 8,4.46 7.14 0.33,1.67; line 3.2,13 12.8,3",
            Self::Solo => "ring 8,8 4.6; dot 8,8 1.7; rays 8,8 4.6,6.6 4",
            Self::Undo => {
                "line 5.8,2.6 2.6,5.8 5.8,9; line 2.6,5.8 9.8,5.8; arc 9.8,9.4 3.6 -1.5707964,1.5707964; line 9.8,13 5.4,13"
            }
            Self::Redo => {
                "line 10.2,2.6 13.4,5.8 10.2,9; line 13.4,5.8 6.2,5.8; arc 6.2,9.4 3.6 1.5707964,4.712389; line 6.2,13 10.6,13"
            }
            Self::Help => "arc 8,5.9 2.9 2,4.9; line 10.65,7.1 8,8.7 8,10.2; dot 8,12.7 1",
            Self::Close => "line 4.2,4.2 11.8,11.8; line 11.8,4.2 4.2,11.8",
            Self::ChevronDown => "line 4.6,6.4 8,9.8 11.4,6.4",
            Self::Dots => "dot 3.6,8 1.2; dot 8,8 1.2; dot 12.4,8 1.2",
        }
    }
}

/// Draws an icon centred in `rect`, 16 points high.
pub(in crate::ui) fn paint(painter: &Painter, rect: Rect, icon: Icon, color: Color32) {
    let origin = rect.center() - vec2(8.0, 8.0);
    for part in icon.parts().split("; ") {
        painter.add(shape(part, origin, color));
    }
}

fn shape(part: &str, origin: Pos2, color: Color32) -> Shape {
    let at = |x: f32, y: f32| origin + vec2(x, y);
    let stroke = Stroke::new(LINE_WIDTH, color);
    let (kind, numbers) = part.split_once(' ').unwrap_or((part, ""));
    let numbers: Vec<f32> = numbers
        .split([' ', ','])
        .filter_map(|number| number.parse().ok())
        .collect();
    let points = || numbers.as_chunks::<2>().0.iter().map(|&[x, y]| at(x, y)).collect();
    // So many lines instead of a part of a circle, angles in radians.
    let around = |[x, y, radius]: [f32; 3], [from, to]: [f32; 2], count: u8| {
        let angles = (0..=count).map(|i| from + (to - from) * f32::from(i) / f32::from(count));
        angles
            .map(|angle| at(x + radius * angle.cos(), y + radius * angle.sin()))
            .collect()
    };
    match (kind, &numbers[..]) {
        ("line", _) => Shape::line(points(), stroke),
        ("closed", _) => Shape::closed_line(points(), stroke),
        ("fill", _) => Shape::convex_polygon(points(), color, Stroke::NONE),
        ("ring", &[x, y, radius]) => Shape::circle_stroke(at(x, y), radius, stroke),
        ("dot", &[x, y, radius]) => Shape::circle_filled(at(x, y), radius, color),
        ("half", &[x, y, radius]) => {
            Shape::convex_polygon(around([x, y, radius], [-0.5 * PI, 0.5 * PI], 16), color, Stroke::NONE)
        }
        ("arc", &[x, y, radius, from, to]) => Shape::line(
            around([x, y, radius], [from, to].map(|quarters| quarters * FRAC_PI_2), 20),
            stroke,
        ),
        ("rays", &[x, y, inner, outer, count]) => {
            let rays = (0..count as u8).map(|i| {
                let (sin, cos) = (f32::from(i) * TAU / count).sin_cos();
                let end = |radius: f32| at(x + radius * cos, y + radius * sin);
                Shape::line(vec![end(inner), end(outer)], stroke)
            });
            Shape::Vec(rays.collect())
        }
        ("bar", &[x0, y0, x1, y1]) => Shape::rect_filled(Rect::from_min_max(at(x0, y0), at(x1, y1)), 0.8, color),
        ("box", &[x0, y0, x1, y1]) => {
            let sides = Rect::from_min_max(at(x0, y0), at(x1, y1));
            Shape::rect_stroke(sides, 2.4, stroke, StrokeKind::Middle)
        }
        _ => Shape::Noop,
    }
}
