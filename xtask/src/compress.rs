//! Bytes made smaller for the way to the browser.

use std::io::Write as _;

use flate2::write::GzEncoder;

/// A content coding that browsers take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Coding {
    Brotli,
    Gzip,
}

/// How hard to try.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// For a page on this machine: tens of megabytes a second.
    Quick,
    /// For a download that is made once and fetched often.
    Best,
}

impl Coding {
    /// The name in `Content-Encoding`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Brotli => "br",
            Self::Gzip => "gzip",
        }
    }

    /// The best coding that an `Accept-Encoding` header allows, if any.
    pub(crate) fn accepted(header: &str) -> Option<Self> {
        let allows = |coding: Self| {
            header.split(',').any(|item| {
                let (name, weight) = item.split_once(';').unwrap_or((item, ""));
                let refused = weight
                    .trim()
                    .strip_prefix("q=")
                    .is_some_and(|q| q.trim().parse() == Ok(0.0_f32));
                name.trim().eq_ignore_ascii_case(coding.name()) && !refused
            })
        };
        [Self::Brotli, Self::Gzip].into_iter().find(|coding| allows(*coding))
    }

    /// The bytes in this coding.
    pub(crate) fn encode(self, bytes: &[u8], effort: Effort) -> Vec<u8> {
        let written = match self {
            Self::Brotli => {
                let quality = if effort == Effort::Best { 11 } else { 3 };
                let params = brotli::enc::BrotliEncoderParams {
                    quality,
                    // The widest that each browser reads: a program is larger than 4 MB.
                    lgwin: 24,
                    size_hint: bytes.len(),
                    ..Default::default()
                };
                let mut out = Vec::new();
                brotli::BrotliCompress(&mut &*bytes, &mut out, &params).map(|_| out)
            }
            Self::Gzip => {
                let level = if effort == Effort::Best {
                    flate2::Compression::best()
                } else {
                    flate2::Compression::fast()
                };
                let mut encoder = GzEncoder::new(Vec::new(), level);
                encoder.write_all(bytes).and_then(|()| encoder.finish())
            }
        };
        // Reading from a slice and writing to a vector: neither can fail.
        written.expect("compressing in memory cannot fail")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    #[test]
    fn the_best_allowed_coding_is_chosen() {
        for (header, coding) in [
            ("gzip, deflate, br, zstd", Some(Coding::Brotli)),
            ("GZIP", Some(Coding::Gzip)),
            ("br;q=0, gzip;q=0.5", Some(Coding::Gzip)),
            ("br;q=0.0", None),
            ("identity", None),
            ("", None),
            ("brotli", None),
        ] {
            assert_eq!(Coding::accepted(header), coding, "{header}");
        }
    }

    #[test]
    fn what_is_encoded_decodes_to_itself() {
        let bytes: Vec<u8> = (0..50_000_u32).flat_map(|i| (i * i).to_le_bytes()).collect();
        for effort in [Effort::Quick, Effort::Best] {
            let mut decoded = Vec::new();
            let encoded = Coding::Gzip.encode(&bytes, effort);
            assert!(encoded.len() < bytes.len());
            flate2::read::GzDecoder::new(&*encoded)
                .read_to_end(&mut decoded)
                .expect("gzip");
            assert_eq!(decoded, bytes);
            let encoded = Coding::Brotli.encode(&bytes, effort);
            assert!(encoded.len() < bytes.len());
            decoded.clear();
            brotli::Decompressor::new(&*encoded, 4096)
                .read_to_end(&mut decoded)
                .expect("brotli");
            assert_eq!(decoded, bytes);
        }
    }
}
