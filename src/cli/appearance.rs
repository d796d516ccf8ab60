//! Arguments for how the model appears: light, view mode, background, lines, passes.

use super::input::one_of;
use crate::scene::{Background, Light, Overlay, Pass, ViewMode};
use crate::session::{LookCommand, PassChoice, QualityCommand, Session};

/// How the model appears.
#[derive(Debug, clap::Args)]
pub(super) struct AppearanceArguments {
    /// The light.
    #[arg(long, value_name = "LIGHT", value_parser = one_of(&Light::ALL, Light::name), default_value = "studio")]
    light: Light,
    /// Divide the picture at a fraction of its width: the light that `--light` says on the right, the other on the left.
    #[arg(long, value_name = "FRACTION", value_parser = fraction)]
    split: Option<f32>,
    /// What of the surface to show.
    #[arg(long, value_name = "MODE", value_parser = one_of(&ViewMode::ALL, ViewMode::name), default_value = "lit")]
    view_mode: ViewMode,
    /// What is behind the model: backdrop, sky, none, or a colour such as #20262e [default: the sky when a cube map is among
    /// the textures, else backdrop].
    #[arg(long, value_name = "BACKGROUND", value_parser = background)]
    background: Option<Background>,
    /// Leave out everything behind the model but its shadows on the ground; the same as `--background none`.
    #[arg(long, conflicts_with = "background")]
    transparent: bool,
    /// Lines to draw; may be given several times.
    #[arg(long, value_name = "LINES", value_parser = one_of(&Overlay::ALL, Overlay::name))]
    overlay: Vec<Overlay>,
    /// Leave out the ground grid.
    #[arg(long)]
    no_grid: bool,
    /// Exposure of the studio light in stops, each of which doubles it.
    #[arg(long, value_name = "STOPS", value_parser = number, default_value = "0", allow_negative_numbers = true)]
    exposure: f32,
    /// Turn the environment about y, degrees.
    #[arg(long, value_name = "DEGREES", value_parser = number, default_value = "0", allow_negative_numbers = true)]
    turn: f32,
    /// Take the green of normal maps as pointing up in the picture, the way of OpenGL.
    #[arg(long)]
    flip_green: bool,
    /// Leave out a costly step; may be given several times.
    #[arg(long, value_name = "STEP", value_parser = one_of(&Pass::ALL, Pass::name))]
    without: Vec<Pass>,
}

impl AppearanceArguments {
    pub(super) fn apply(&self, session: &mut Session) {
        for command in [
            LookCommand::SetLight(self.light),
            LookCommand::SetSplit(self.split),
            LookCommand::SetViewMode(self.view_mode),
            LookCommand::SetOverlay(Overlay::Grid, !self.no_grid),
            LookCommand::SetExposure(self.exposure),
            LookCommand::SetEnvironmentTurn(self.turn.to_radians()),
            LookCommand::SetNormalGreenFlipped(self.flip_green),
        ] {
            session.apply(command);
        }
        let background = if self.transparent {
            Some(Background::None)
        } else {
            self.background
        };
        if let Some(background) = background {
            session.apply(LookCommand::SetBackground(background));
        }
        for &overlay in &self.overlay {
            session.apply(LookCommand::SetOverlay(overlay, true));
        }
        for &pass in &self.without {
            session.apply(QualityCommand::SetPass(pass, PassChoice::Off));
        }
    }
}

fn background(text: &str) -> Result<Background, String> {
    Background::from_name(text).ok_or_else(|| "expected backdrop, sky, none, or a colour such as #20262e".into())
}

fn number(text: &str) -> Result<f32, String> {
    let number: f32 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if number.is_finite() {
        Ok(number)
    } else {
        Err("expected a finite number".into())
    }
}

fn fraction(text: &str) -> Result<f32, String> {
    number(text)
        .ok()
        .filter(|fraction| (0.0..=1.0).contains(fraction))
        .ok_or_else(|| "expected a fraction from 0 to 1".into())
}
