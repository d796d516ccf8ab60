//! Tests of `anim`.
