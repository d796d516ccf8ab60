//! What scripts give as arguments, and the errors that are thrown for those that make no sense.

use js_sys::{RangeError, TypeError};
use wasm_bindgen::JsValue;

use super::is_absent;
use crate::script::{Given, Misuse};

/// What a script gave, to be checked.
pub(super) fn given(value: &JsValue) -> Given {
    if let Some(number) = value.as_f64() {
        Given::Number(number)
    } else if let Some(text) = value.as_string() {
        Given::Text(text)
    } else if value.is_object() {
        Given::Other("an object".to_owned())
    } else {
        // Such as `JsValue(undefined)`.
        let words = format!("{value:?}");
        let inner = words.strip_prefix("JsValue(").and_then(|words| words.strip_suffix(')'));
        Given::Other(inner.unwrap_or(&words).to_owned())
    }
}

/// The value, or the error that the call throws.
pub(super) fn checked<T>(value: Result<T, Misuse>) -> Result<T, JsValue> {
    value.map_err(|misuse| match misuse {
        Misuse::Type(message) => TypeError::new(&message).into(),
        Misuse::Range(message) => RangeError::new(&message).into(),
    })
}

/// The value if one was given, or the error that the call throws.
pub(super) fn optional<T>(
    value: &JsValue,
    check: impl FnOnce(&Given) -> Result<T, Misuse>,
) -> Result<Option<T>, JsValue> {
    if is_absent(value) {
        return Ok(None);
    }
    checked(check(&given(value))).map(Some)
}
