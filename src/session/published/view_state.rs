//! All of a view that a link, an embedding page or a later visit must restore, as plain data.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::anim::{GhostPlan, LoopMode, SkinView, WrapMode};
use crate::model::{Handedness, UpAxis};
use crate::scene::{Background, BoneStyle, Camera, Light, MAX_PITCH_RADIANS, Overlay, Projection, ViewMode};
use crate::session::look::view::{Framed, View};
use crate::session::open::open_model::OpenModel;
use crate::session::play::actor::Actor;
use crate::session::play::instances::CrowdState;

/// How a session looks at its model. Clips go by the names that the list of clips shows, bones by their numbers in the file, so
/// that a state stays right when the file is exported again. What a state does not say has its default value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct ViewState {
    /// From where.
    pub camera: CameraState,
    /// In which light and with what beside it.
    pub appearance: AppearanceState,
    /// At which time of which clip.
    pub playback: PlaybackState,
    /// With how many instances. What the selected one plays is `playback`; the others' clips and times come from the seed.
    pub crowd: CrowdState,
    /// With what selected.
    pub selection: SelectionState,
}

/// Where the camera is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct CameraState {
    /// Point looked at, world space.
    pub target: [f32; 3],
    /// Distance from eye to target, world units, above 0. 0 for a model that is framed, wherever that is in this window.
    pub distance: f32,
    /// Turn about y, radians.
    pub yaw_radians: f32,
    /// Lift of the eye above the horizon, radians.
    pub pitch_radians: f32,
    /// Without perspective.
    pub orthographic: bool,
    /// The model is framed, and stays so in a window of another shape.
    pub framed: bool,
    /// It turns about the model by itself.
    pub turntable: bool,
}

impl Default for CameraState {
    fn default() -> Self {
        Self::of(&View::default())
    }
}

/// How the model appears.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct AppearanceState {
    /// Studio or book light.
    pub light: Light,
    /// Where the picture is divided between both lights, as a fraction of its width.
    pub split: Option<f32>,
    /// What of a surface is shown.
    pub view_mode: ViewMode,
    /// What is behind the model.
    pub background: Background,
    /// Lines that are drawn.
    pub overlays: Vec<Overlay>,
    /// Length of the lines along normals and tangents, as a fraction of the scene's radius.
    pub line_length: f32,
    /// Turn of the environment about y, radians.
    pub environment_turn_radians: f32,
    /// Exposure of the studio light.
    pub exposure_stops: f32,
    /// How far the ground is above where it was found to be, in heights of the model.
    pub ground_offset: f32,
    /// Turn of the book's lights about y, radians.
    pub book_lights_turn_radians: f32,
    /// Whether the green of normal maps points up in the picture.
    pub normal_green_flipped: bool,
    /// Chosen over what was found in the file.
    pub handedness: Option<Handedness>,
    /// Chosen over what was found in the file.
    pub up_axis: Option<UpAxis>,
    /// Whether bones are drawn.
    pub bones_visible: bool,
    /// How bones are drawn.
    pub bone_style: BoneStyle,
    /// Whether names stand at the bones.
    pub labels_visible: bool,
    /// What of the skin is shown as colours.
    pub skin_view: Option<SkinView>,
    /// Poses before and after that of now that are seen as ghosts.
    pub ghosts: Option<GhostPlan>,
    /// Whether the bind pose is seen as a ghost.
    pub bind_ghost: bool,
    /// Bones whose paths through the clip are drawn.
    pub trails: Vec<u32>,
}

impl Default for AppearanceState {
    fn default() -> Self {
        Self::of(&View::default(), &[])
    }
}

/// What plays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct PlaybackState {
    /// Name of the clip.
    pub clip: Option<String>,
    /// Seconds in the clip's own time.
    pub time_secs: f32,
    /// Whether time moves.
    pub playing: bool,
    /// Whether it moves backward.
    pub backward: bool,
    /// Factor of the file's.
    pub speed: f32,
    /// What happens at the end.
    pub loop_mode: LoopMode,
    /// How a loop begins again.
    pub wrap_mode: WrapMode,
    /// Range that plays, seconds; the whole clip without one.
    pub range_secs: Option<[f32; 2]>,
    /// Name of a clip that is blended in, and its weight, 0…1.
    pub blend: Option<(String, f32)>,
    /// Names of clips that are kept over where they start.
    pub in_place: Vec<String>,
    /// Length of crossfades, seconds.
    pub crossfade_secs: f32,
    /// How far the pose is brought to the bind pose, 0…1.
    pub bind_weight: f32,
}

impl Default for PlaybackState {
    fn default() -> Self {
        Self::of(&Actor::default(), None)
    }
}

/// What is selected.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct SelectionState {
    /// A bone, by its number in the file.
    pub bone: Option<u32>,
    /// A vertex, by its number in the file.
    pub vertex: Option<u32>,
    /// A subset, by its index.
    pub subset: Option<usize>,
    /// Subsets that are not drawn.
    pub hidden_subsets: Vec<usize>,
    /// The subset that is shown alone.
    pub solo_subset: Option<usize>,
}

impl CameraState {
    pub(in crate::session) fn of(view: &View) -> Self {
        let camera = &view.camera;
        Self {
            target: camera.target.to_array(),
            distance: camera.distance,
            yaw_radians: camera.yaw_radians,
            pitch_radians: camera.pitch_radians,
            orthographic: camera.projection == Projection::Orthographic,
            framed: view.framed != Framed::No,
            turntable: view.motion.turntable(),
        }
    }

    /// The camera under a light. Numbers that no camera can have are replaced by the default one's.
    pub(in crate::session) fn camera(&self, light: Light) -> Camera {
        let default = Camera::default();
        let or = |value: f32, default: f32| if value.is_finite() { value } else { default };
        let target = Vec3::from(self.target);
        let pitch = or(self.pitch_radians, default.pitch_radians);
        Camera {
            target: if target.is_finite() { target } else { default.target },
            distance: if self.distance > 0.0 {
                or(self.distance, default.distance)
            } else {
                default.distance
            },
            yaw_radians: or(self.yaw_radians, default.yaw_radians),
            pitch_radians: pitch.clamp(-MAX_PITCH_RADIANS, MAX_PITCH_RADIANS),
            projection: if self.orthographic {
                Projection::Orthographic
            } else {
                Projection::perspective(light)
            },
        }
    }
}

impl AppearanceState {
    /// `file_bones` has the number in the file of each joint.
    pub(in crate::session) fn of(view: &View, file_bones: &[u32]) -> Self {
        let look = &view.look;
        Self {
            light: look.light,
            split: look.split,
            view_mode: look.view_mode,
            background: look.background,
            overlays: Overlay::ALL
                .into_iter()
                .filter(|&overlay| look.overlays.has(overlay))
                .collect(),
            line_length: look.overlays.line_length,
            environment_turn_radians: look.environment_turn_radians,
            exposure_stops: look.exposure_stops,
            ground_offset: look.ground_offset,
            book_lights_turn_radians: look.book_lights_turn_radians,
            normal_green_flipped: look.normal_green_flipped,
            handedness: view.handedness,
            up_axis: view.up_axis,
            bones_visible: look.bones_visible,
            bone_style: look.bone_style,
            labels_visible: look.labels_visible(),
            skin_view: look.skin_view,
            ghosts: look.ghosts,
            bind_ghost: look.bind_ghost,
            trails: look
                .trails
                .iter()
                .filter_map(|joint| file_bones.get(joint.index()).copied())
                .collect(),
        }
    }
}

impl PlaybackState {
    pub(in crate::session) fn of(actor: &Actor, open: Option<&OpenModel>) -> Self {
        let (playback, mixer) = (&actor.player.playback, &actor.mixer);
        let name = |clip: usize| Some(open?.model.clips.get(clip)?.name.clone());
        let in_place = open.into_iter().flat_map(OpenModel::kept_in_place);
        Self {
            clip: actor.player.clip.and_then(name),
            time_secs: playback.time_secs(),
            playing: playback.is_playing(),
            backward: playback.is_backward(),
            speed: playback.speed(),
            loop_mode: playback.loop_mode(),
            wrap_mode: playback.wrap_mode(),
            range_secs: playback.range_secs(),
            blend: mixer.blend().and_then(|blend| Some((name(blend.clip)?, blend.weight))),
            in_place: in_place.map(|(name, _)| name.clone()).collect(),
            crossfade_secs: mixer.crossfade_secs(),
            bind_weight: actor.bind_weight,
        }
    }
}
