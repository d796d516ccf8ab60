//! Small glTF files made in code, so that a test says what its file has.

use serde_json::{Value, json};

/// A document that grows, with one buffer.
pub(crate) struct Gltf {
    pub(crate) json: Value,
    pub(crate) bin: Vec<u8>,
}

impl Gltf {
    pub(crate) fn new(json: Value) -> Self {
        let mut all = json!({ "asset": { "version": "2.0" }, "scene": 0, "accessors": [], "bufferViews": [] });
        for (key, value) in json.as_object().expect("an object") {
            all[key] = value.clone();
        }
        Self {
            json: all,
            bin: Vec::new(),
        }
    }

    /// Adds a buffer view of some bytes; its index.
    pub(crate) fn view(&mut self, bytes: &[u8], stride: Option<usize>) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len() });
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        self.bin.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    /// Adds an accessor; its index.
    pub(crate) fn accessor(&mut self, accessor: Value) -> usize {
        self.push("accessors", accessor)
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    /// An accessor of floats; its index.
    pub(crate) fn floats<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = rows
            .as_flattened()
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        let view = self.view(&bytes, None);
        self.accessor(json!({ "bufferView": view, "componentType": 5126, "count": rows.len(), "type": kind(N) }))
    }

    /// An accessor of whole numbers of 16 bits; its index.
    pub(crate) fn shorts<const N: usize>(&mut self, rows: &[[u16; N]]) -> usize {
        let bytes: Vec<u8> = rows
            .as_flattened()
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        let view = self.view(&bytes, None);
        self.accessor(json!({ "bufferView": view, "componentType": 5123, "count": rows.len(), "type": kind(N) }))
    }

    fn with_buffer(&self, uri: Option<String>) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bin.is_empty() {
            json["buffers"] = json!([{ "byteLength": self.bin.len() }]);
            if let Some(uri) = uri {
                json["buffers"][0]["uri"] = uri.into();
            }
        }
        for list in ["accessors", "bufferViews"] {
            if json[list].as_array().is_some_and(Vec::is_empty) {
                json.as_object_mut().expect("an object").remove(list);
            }
        }
        serde_json::to_vec_pretty(&json).expect("values are written")
    }

    /// As text with its data in place.
    pub(crate) fn text(&self) -> Vec<u8> {
        self.with_buffer(Some(format!(
            "data:application/octet-stream;base64,{}",
            base64(&self.bin)
        )))
    }

    /// As text that names a file with the data.
    pub(crate) fn text_beside(&self, uri: &str) -> Vec<u8> {
        self.with_buffer(Some(uri.to_owned()))
    }

    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.with_buffer(None);
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bin = self.bin.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let chunks: &[(&[u8; 4], &[u8])] = &[(b"JSON", &json), (b"BIN\0", &bin)];
        let chunks = &chunks[..if bin.is_empty() { 1 } else { 2 }];
        glb(chunks)
    }
}

/// A `.glb` file of these chunks.
pub(crate) fn glb(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, chunk) in chunks {
        body.extend((chunk.len() as u32).to_le_bytes());
        body.extend(*kind);
        body.extend(*chunk);
    }
    let length = 12 + body.len() as u32;
    [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes(), &body].concat()
}

fn kind(numbers: usize) -> &'static str {
    match numbers {
        1 => "SCALAR",
        2 => "VEC2",
        3 => "VEC3",
        4 => "VEC4",
        _ => "MAT4",
    }
}

pub(crate) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let number = group.iter().fold(0, |number, &byte| number << 8 | u32::from(byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let letter = LETTERS[(number >> (18 - 6 * place)) as usize & 63];
            text.push(if place <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}
