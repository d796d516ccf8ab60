//! Arguments that say how the model is looked at, as the page's menus do.

use crate::scene::{Background, Light, Overlay, Pass, ViewMode};
use crate::session::{Command, LookCommand, PassChoice, Session};

/// How the model is looked at.
#[derive(Debug, clap::Args)]
pub(super) struct LookArguments {
    /// The light: `studio` or `book`.
    #[arg(long, value_name = "LIGHT", value_parser = light, default_value = "studio")]
    light: Light,
    /// Divide the picture at a share of its width: the book's light on the left, the studio's on the right.
    #[arg(long, value_name = "SHARE", value_parser = share)]
    split: Option<f32>,
    /// What of the surface to show: lit, base-color, normal-map, normal, tangent, uv, roughness, material, depth, ao, shadow.
    #[arg(long, value_name = "MODE", value_parser = view_mode, default_value = "lit")]
    view_mode: ViewMode,
    /// What is behind the model: backdrop, sky, none, or a colour such as #20262e.
    #[arg(long, value_name = "BACKGROUND", value_parser = background, default_value = "backdrop")]
    background: Background,
    /// Leave out everything behind the model; the same as `--background none`.
    #[arg(long, conflicts_with = "background")]
    transparent: bool,
    /// Lines to draw: wireframe, normals, tangents, bounds, axes; may be given several times.
    #[arg(long, value_name = "LINES", value_parser = overlay)]
    overlay: Vec<Overlay>,
    /// Leave out the ground grid.
    #[arg(long)]
    no_grid: bool,
    /// Exposure of the studio light in stops, each of which doubles it.
    #[arg(long, value_name = "STOPS", value_parser = number, default_value = "0", allow_negative_numbers = true)]
    exposure: f32,
    /// Turn the surroundings about y, degrees.
    #[arg(long, value_name = "DEGREES", value_parser = number, default_value = "0", allow_negative_numbers = true)]
    turn: f32,
    /// Take the green of normal maps as pointing up in the picture, the way of OpenGL.
    #[arg(long)]
    flip_green: bool,
    /// Leave out a costly step: shadow, reflections, contact, ao; may be given several times.
    #[arg(long, value_name = "STEP", value_parser = pass)]
    without: Vec<Pass>,
}

impl LookArguments {
    pub(super) fn apply(&self, session: &mut Session) {
        let background = if self.transparent {
            Background::None
        } else {
            self.background
        };
        for command in [
            LookCommand::SetLight(self.light),
            LookCommand::SetSplit(self.split),
            LookCommand::SetViewMode(self.view_mode),
            LookCommand::SetBackground(background),
            LookCommand::SetOverlay(Overlay::Grid, !self.no_grid),
            LookCommand::SetExposure(self.exposure),
            LookCommand::SetEnvironmentTurn(self.turn.to_radians()),
            LookCommand::SetNormalGreenFlipped(self.flip_green),
        ] {
            session.apply(command.into());
        }
        for &overlay in &self.overlay {
            session.apply(LookCommand::SetOverlay(overlay, true).into());
        }
        for &pass in &self.without {
            session.apply(Command::SetPass(pass, PassChoice::Off));
        }
    }
}

/// The one of `all` with this name.
fn named<T: Copy>(text: &str, all: &[T], name: impl Fn(T) -> &'static str) -> Result<T, String> {
    all.iter().copied().find(|&one| name(one) == text).ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|&one| name(one)).collect();
        format!("expected one of {}", names.join(", "))
    })
}

fn light(text: &str) -> Result<Light, String> {
    named(text, &Light::ALL, Light::name)
}

fn view_mode(text: &str) -> Result<ViewMode, String> {
    named(text, &ViewMode::ALL, ViewMode::name)
}

fn overlay(text: &str) -> Result<Overlay, String> {
    named(text, &Overlay::ALL, Overlay::name)
}

fn pass(text: &str) -> Result<Pass, String> {
    named(text, &Pass::ALL, Pass::name)
}

fn background(text: &str) -> Result<Background, String> {
    match text {
        "backdrop" => Ok(Background::Backdrop),
        "sky" => Ok(Background::Sky),
        "none" => Ok(Background::None),
        _ => color(text)
            .map(Background::Color)
            .ok_or_else(|| "expected backdrop, sky, none, or a colour such as #20262e".into()),
    }
}

/// `#20262e`.
fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text
        .strip_prefix('#')
        .filter(|digits| digits.len() == 6 && digits.is_ascii())?;
    let channel = |at: usize| u8::from_str_radix(&digits[at..at + 2], 16).ok();
    Some([channel(0)?, channel(2)?, channel(4)?])
}

fn number(text: &str) -> Result<f32, String> {
    let number: f32 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if number.is_finite() {
        Ok(number)
    } else {
        Err("expected a finite number".into())
    }
}

fn share(text: &str) -> Result<f32, String> {
    number(text)
        .ok()
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a share from 0 to 1".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_understood_and_others_are_answered_with_the_list() {
        for mode in ViewMode::ALL {
            assert_eq!(view_mode(mode.name()), Ok(mode));
        }
        for one in Light::ALL {
            assert_eq!(light(one.name()), Ok(one));
        }
        assert_eq!(light("lamp"), Err("expected one of studio, book".into()));
    }

    #[test]
    fn colours_are_six_digits() {
        assert_eq!(background("#20262e"), Ok(Background::Color([0x20, 0x26, 0x2e])));
        for wrong in ["", "#", "#20262", "20262e", "#20262g", "#ääää", "#+12-34"] {
            assert!(background(wrong).is_err(), "{wrong}");
        }
    }
}
