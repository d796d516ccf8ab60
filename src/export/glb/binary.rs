//! The one buffer, and the views and accessors of it.

use std::ops::Range;

use serde_json::{Value, json};

use super::number::number;

/// What the numbers of an accessor are for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    Vertices = 34_962,
    /// Indices of triangles.
    Indices = 34_963,
    Other = 0,
}

#[derive(Default)]
pub(super) struct Binary {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Binary {
    /// Bytes as a view of their own.
    pub(super) fn view(&mut self, bytes: &[u8], target: Target) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if target != Target::Other {
            view["target"] = json!(target as u32);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// An accessor of a view from a byte on; each of these integers or floats has so many bytes and the type of a component.
    pub(super) fn accessor(&mut self, view: usize, offset: usize, count: usize, component: u32, kind: &str) -> usize {
        let mut accessor = json!({
            "bufferView": view, "componentType": component, "count": count, "type": kind,
        });
        if offset > 0 {
            accessor["byteOffset"] = json!(offset);
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Floats in rows of `N`, with their bounds where `bounded`.
    pub(super) fn floats<const N: usize>(&mut self, rows: &[[f32; N]], target: Target, bounded: bool) -> usize {
        self.slices(rows, target, bounded, std::slice::from_ref(&(0..rows.len())));
        self.accessors.len() - 1
    }

    /// Floats in rows of `N` as one view, and an accessor for each part of the rows, with its bounds where `bounded`.
    pub(super) fn slices<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        target: Target,
        bounded: bool,
        parts: &[Range<usize>],
    ) -> Vec<usize> {
        let view = self.view(bytemuck::cast_slice(rows.as_flattened()), target);
        self.set_stride(view, 4 * N, parts.len());
        let kind = match N {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let accessors = parts.iter().map(|part| {
            let accessor = self.accessor(view, 4 * N * part.start, part.len(), FLOAT, kind);
            if bounded {
                let bound = |pick: fn(f32, f32) -> f32| -> Vec<Value> {
                    let of_column = |column: usize| rows[part.clone()].iter().map(move |row| row[column]).reduce(pick);
                    (0..N)
                        .map(|column| number(of_column(column).unwrap_or_default()))
                        .collect()
                };
                self.accessors[accessor]["min"] = json!(bound(f32::min));
                self.accessors[accessor]["max"] = json!(bound(f32::max));
            }
            accessor
        });
        accessors.collect()
    }

    /// Bytes from row to row, which a view of several accessors must say.
    pub(super) fn set_stride(&mut self, view: usize, stride: usize, accessors: usize) {
        if accessors > 1 {
            self.views[view]["byteStride"] = json!(stride);
        }
    }
}

pub(super) const UNSIGNED_BYTE: u32 = 5121;
pub(super) const UNSIGNED_SHORT: u32 = 5123;
pub(super) const UNSIGNED_INT: u32 = 5125;
pub(super) const FLOAT: u32 = 5126;
