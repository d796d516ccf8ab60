//! Addresses of buffers and images: data in place, or a file beside.

use std::borrow::Cow;

use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use base64::{Engine as _, alphabet};

/// What an address of a glTF file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Uri<'a> {
    /// The bytes themselves, with the media type that is given for them.
    Data {
        /// `image/png`; empty when none is given.
        media_type: &'a str,
        /// What was encoded.
        bytes: Vec<u8>,
    },
    /// A path relative to the file, percent-decoded, with `/` between its parts.
    Path(String),
}

/// Why an address cannot be followed, in a few words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UriError {
    /// A data URI that does not say what it holds, or has no comma before the data.
    #[error("its data URI does not begin as one")]
    NoData,
    /// Letters that no base64 text has, or too few of them.
    #[error("its data URI is no base64 text")]
    NotBase64,
    /// Percent signs without two digits, or text that is not UTF-8.
    #[error("its address is not percent-encoded as it should be")]
    NotPercentEncoded,
    /// An address elsewhere, or a path from the root.
    #[error("only data and relative paths are read, not addresses elsewhere")]
    NotRelative,
}

impl<'a> Uri<'a> {
    /// Reads an address.
    ///
    /// # Errors
    /// When it is neither sound data nor a relative path.
    pub fn parse(text: &'a str) -> Result<Self, UriError> {
        if text.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
            return data(&text[5..]);
        }
        let scheme = text.split(['/', '?', '#']).next().unwrap_or_default();
        if text.starts_with('/') || scheme.contains(':') {
            return Err(UriError::NotRelative);
        }
        let path = percent_decoded(text).ok_or(UriError::NotPercentEncoded)?;
        let path = String::from_utf8(path.into_owned()).map_err(|_| UriError::NotPercentEncoded)?;
        let path = path.replace('\\', "/");
        if path.is_empty() || path.starts_with('/') || path.contains('\0') {
            return Err(UriError::NotRelative);
        }
        Ok(Self::Path(path))
    }
}

fn data(text: &str) -> Result<Uri<'_>, UriError> {
    let (head, body) = text.split_once(',').ok_or(UriError::NoData)?;
    let mut parts = head.split(';');
    let media_type = parts.next().unwrap_or_default();
    if parts.clone().any(str::is_empty) {
        return Err(UriError::NoData);
    }
    let bytes = if parts.any(|part| part.eq_ignore_ascii_case("base64")) {
        let has_too_little_padding = body.ends_with('=') && !body.len().is_multiple_of(4);
        let decoded = BASE64.decode(body).ok().filter(|_| !has_too_little_padding);
        decoded.ok_or(UriError::NotBase64)?
    } else {
        percent_decoded(body).ok_or(UriError::NotPercentEncoded)?.into_owned()
    };
    Ok(Uri::Data { media_type, bytes })
}

/// With padding or without, whatever the bits are that are left at the end.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The bytes that a text stands for; `None` where a percent sign has no two digits behind it.
fn percent_decoded(text: &str) -> Option<Cow<'_, [u8]>> {
    let is_digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_hexdigit);
    let bytes = text.as_bytes();
    let is_sound = |at: usize| is_digit(bytes.get(at + 1)) && is_digit(bytes.get(at + 2));
    let sound = memchr::memchr_iter(b'%', bytes).all(is_sound);
    sound.then(|| percent_encoding::percent_decode(bytes).into())
}
