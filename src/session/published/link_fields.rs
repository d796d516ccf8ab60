//! The fields of links: their names, where they stand in what a link says, and how their values are written.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use serde_json::{Value, json};

/// The names of all fields.
pub fn names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|(name, ..)| *name).chain([CAMERA])
}

/// A field: its name in links, where it stands in `Linked` as a JSON pointer, and how it is written.
pub(super) type Field = (&'static str, &'static str, Form);

/// How a field is written.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Form {
    /// As it is. An empty text where there is no value.
    Text,
    /// 1 or 0.
    Flag,
    /// In the fewest digits that are read as the same number.
    Number,
    /// An angle in radians, written in degrees.
    Degrees,
    /// Numbers with commas between them.
    Numbers,
    /// Names with commas between them; a number can be one.
    Names,
    /// A name and a number.
    Pair,
    /// Numbers, by the names of the object's fields.
    Object(&'static [&'static str]),
    /// A colour without its `#`, or a name.
    Color,
}

/// All but the camera's, in the order of writing.
pub(super) const FIELDS: &[Field] = &[
    ("clip", "/view/playback/clip", Form::Text),
    ("t", TIME, Form::Number),
    (PLAYING, "/view/playback/playing", Form::Flag),
    ("back", "/view/playback/backward", Form::Flag),
    ("speed", "/view/playback/speed", Form::Number),
    ("loop", "/view/playback/loopMode", Form::Text),
    ("wrap", "/view/playback/wrapMode", Form::Text),
    ("range", "/view/playback/rangeSecs", Form::Numbers),
    ("blend", "/view/playback/blend", Form::Pair),
    ("inplace", "/view/playback/inPlace", Form::Names),
    ("fade", "/view/playback/crossfadeSecs", Form::Number),
    ("bind", "/view/playback/bindWeight", Form::Number),
    ("bone", "/view/selection/bone", Form::Number),
    ("vertex", "/view/selection/vertex", Form::Number),
    ("subset", "/view/selection/subset", Form::Number),
    ("hide", "/view/selection/hiddenSubsets", Form::Numbers),
    ("solo", "/view/selection/soloSubset", Form::Number),
    ("skin", "/view/appearance/skinView", Form::Text),
    ("bones", "/view/appearance/bonesVisible", Form::Flag),
    ("bonestyle", "/view/appearance/boneStyle", Form::Text),
    ("labels", "/view/appearance/labelsVisible", Form::Flag),
    ("trails", "/view/appearance/trails", Form::Numbers),
    (
        "ghosts",
        "/view/appearance/ghosts",
        Form::Object(&["before", "after", "stepFrames"]),
    ),
    ("bindghost", "/view/appearance/bindGhost", Form::Flag),
    ("light", "/view/appearance/light", Form::Text),
    ("split", "/view/appearance/split", Form::Number),
    ("view", "/view/appearance/viewMode", Form::Text),
    ("bg", "/view/appearance/background", Form::Color),
    ("overlay", "/view/appearance/overlays", Form::Names),
    ("lines", "/view/appearance/lineLength", Form::Number),
    ("exposure", "/view/appearance/exposureStops", Form::Number),
    ("env", "/view/appearance/environmentTurnRadians", Form::Degrees),
    ("lamps", "/view/appearance/bookLightsTurnRadians", Form::Degrees),
    ("ground", "/view/appearance/groundOffset", Form::Number),
    ("green", "/view/appearance/normalGreenFlipped", Form::Flag),
    ("hand", "/view/appearance/handedness", Form::Text),
    ("up", "/view/appearance/upAxis", Form::Text),
    ("crowd", "/view/crowd/count", Form::Number),
    ("seed", "/view/crowd/seed", Form::Number),
    ("instance", "/view/crowd/selected", Form::Number),
    ("ortho", "/view/camera/orthographic", Form::Flag),
    ("turntable", "/view/camera/turntable", Form::Flag),
    ("quality", "/quality", Form::Text),
    ("panel", "/panels", Form::Names),
];

/// The name of the field that says whether time moves.
pub(super) const PLAYING: &str = "play";

/// Where the time stands. A link without it is about the start of its clip.
pub(super) const TIME: &str = "/view/playback/timeSecs";

/// A preset's name; or yaw and pitch in degrees, and then, unless the model is framed, the distance and the target. Without a target it stays where it is.
/// Behind them width / height of the picture, where in one of another shape the model is framed.
pub(super) const CAMERA: &str = "cam";

/// Names of clips are readable as far as an address may have their characters.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_').remove(b'.').remove(b'~');

impl Form {
    pub(super) fn written(self, value: &Value) -> Option<String> {
        let text = |text: &str| utf8_percent_encode(text, ENCODED).to_string();
        Some(match (self, value) {
            (_, Value::Null) => String::new(),
            (Self::Text, Value::String(name)) => text(name),
            (Self::Color, Value::String(name)) => text(name.trim_start_matches('#')),
            (Self::Flag, Value::Bool(flag)) => u8::from(*flag).to_string(),
            (Self::Number, Value::Number(_)) => number(value)?,
            (Self::Degrees, Value::Number(radians)) => degrees(radians.as_f64()? as f32),
            (Self::Numbers | Self::Names | Self::Pair, Value::Array(items)) => {
                let items = items
                    .iter()
                    .map(|item| item.as_str().map(text).or_else(|| number(item)));
                items.collect::<Option<Vec<_>>>()?.join(",")
            }
            (Self::Object(names), Value::Object(fields)) => {
                let numbers = names.iter().map(|name| number(fields.get(*name)?));
                numbers.collect::<Option<Vec<_>>>()?.join(",")
            }
            _ => return None,
        })
    }

    pub(super) fn read(self, written: &str) -> Option<Value> {
        let text = |written: &str| Some(percent_decode_str(written).decode_utf8().ok()?.into_owned());
        let number = |written: &str| match written.parse::<u64>() {
            Ok(whole) => Some(json!(whole)),
            Err(_) => Some(json!(read_number(written)?)),
        };
        let has_none = matches!(self, Self::Text | Self::Number | Self::Pair | Self::Object(_));
        if written.is_empty() && has_none {
            return Some(Value::Null);
        }
        Some(match self {
            Self::Text => json!(text(written)?),
            Self::Color if is_color(written) => json!(format!("#{written}")),
            Self::Color => json!(text(written)?),
            Self::Flag => match written {
                "1" => json!(true),
                "0" => json!(false),
                _ => return None,
            },
            Self::Number => number(written)?,
            Self::Degrees => json!(read_degrees(written)?),
            Self::Numbers | Self::Names if written.is_empty() => json!([]),
            Self::Numbers => Value::Array(written.split(',').map(number).collect::<Option<_>>()?),
            Self::Names => json!(written.split(',').map(text).collect::<Option<Vec<_>>>()?),
            Self::Pair => {
                let (name, weight) = written.rsplit_once(',')?;
                json!([text(name)?, read_number(weight)?])
            }
            Self::Object(names) => {
                let numbers: Vec<Value> = written.split(',').map(number).collect::<Option<_>>()?;
                let fields = names.iter().map(|name| (*name).to_owned()).zip(numbers.iter().cloned());
                let fits = numbers.len() == names.len();
                fits.then(|| Value::Object(fields.collect()))?
            }
        })
    }
}

fn is_color(text: &str) -> bool {
    text.len() == 6 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// The fewest digits that are read as the same number.
fn number(value: &Value) -> Option<String> {
    match value.as_u64() {
        Some(whole) => Some(whole.to_string()),
        None => Some((value.as_f64()? as f32).to_string()),
    }
}

pub(super) fn read_number(text: &str) -> Option<f32> {
    text.parse::<f32>().ok().filter(|number| number.is_finite())
}

/// An angle in the fewest digits that are read as the same.
pub(super) fn degrees(radians: f32) -> String {
    let degrees = f64::from(radians).to_degrees();
    let written = (0..9).map(|digits| format!("{degrees:.digits$}"));
    let mut exact = written.filter(|text| read_degrees(text) == Some(radians));
    exact.next().unwrap_or_else(|| degrees.to_string())
}

pub(super) fn read_degrees(text: &str) -> Option<f32> {
    let degrees = text.parse::<f64>().ok()?;
    Some(degrees.to_radians() as f32).filter(|radians| radians.is_finite())
}
