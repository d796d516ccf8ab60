//! Binary FBX files, made.

/// Bytes of a binary file of any version before 7.5.
#[derive(Default)]
pub(crate) struct Binary(pub(crate) Vec<u8>);

impl Binary {
    pub(crate) fn new(version: u32) -> Self {
        Self([b"Kaydara FBX Binary  \0\x1a\0".as_slice(), &version.to_le_bytes()].concat())
    }

    /// A record whose values are these bytes, and what `inner` writes into it.
    pub(crate) fn record(&mut self, name: &str, count: u32, values: &[u8], inner: Option<&dyn Fn(&mut Self)>) {
        let start = self.0.len();
        self.0.extend([0; 4]);
        self.0.extend(count.to_le_bytes());
        self.0.extend((values.len() as u32).to_le_bytes());
        self.0.push(name.len() as u8);
        self.0.extend(name.bytes());
        self.0.extend(values);
        if let Some(inner) = inner {
            inner(self);
            self.0.extend([0; 13]);
        }
        let end = (self.0.len() as u32).to_le_bytes();
        self.0[start..start + 4].copy_from_slice(&end);
    }
}

pub(crate) fn text(value: &str) -> Vec<u8> {
    [&b"S"[..], &(value.len() as u32).to_le_bytes(), value.as_bytes()].concat()
}

pub(crate) fn array(kind: u8, count: u32, is_deflated: bool, bytes: &[u8]) -> Vec<u8> {
    let words = [count, u32::from(is_deflated), bytes.len() as u32];
    let words = words.iter().flat_map(|word| word.to_le_bytes());
    std::iter::once(kind)
        .chain(words)
        .chain(bytes.iter().copied())
        .collect()
}
