//! Numbers as JSON has them.

use serde_json::{Value, json};

/// A number with the fewest digits that read back to it.
pub(super) fn number(value: f32) -> Value {
    // The shortest digits of an f32, read as f64, come out as the same digits; what is not finite is no number in JSON.
    value
        .to_string()
        .parse::<f64>()
        .map_or(Value::Null, |digits| json!(digits))
}

pub(super) fn numbers<const N: usize>(values: [f32; N]) -> Value {
    Value::Array(values.map(number).to_vec())
}
