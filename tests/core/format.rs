//! Tests of `format`.

mod real_files;
