//! Addresses of buffers and images: data in place, or a file beside.

use std::borrow::Cow;

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
        base64(body.as_bytes()).ok_or(UriError::NotBase64)?
    } else {
        percent_decoded(body).ok_or(UriError::NotPercentEncoded)?.into_owned()
    };
    Ok(Uri::Data { media_type, bytes })
}

fn percent_decoded(text: &str) -> Option<Cow<'_, [u8]>> {
    let bytes = text.as_bytes();
    if memchr::memchr(b'%', bytes).is_none() {
        return Some(Cow::Borrowed(bytes));
    }
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut rest = bytes;
    while let [first, others @ ..] = rest {
        if *first == b'%' {
            let [high, low, behind @ ..] = others else { return None };
            let digit = |letter: u8| char::from(letter).to_digit(16);
            decoded.push((digit(*high)? * 16 + digit(*low)?) as u8);
            rest = behind;
        } else {
            decoded.push(*first);
            rest = others;
        }
    }
    Some(Cow::Owned(decoded))
}

/// What is no letter of base64 (RFC 4648).
const NO_DIGIT: u8 = 0xff;

const DIGITS: [u8; 256] = {
    let mut digits = [NO_DIGIT; 256];
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut value = 0;
    while value < letters.len() {
        digits[letters[value] as usize] = value as u8;
        value += 1;
    }
    digits
};

/// The bytes of a base64 text with or without padding; `None` when it is none.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let padding = text.iter().rev().take(2).take_while(|&&letter| letter == b'=').count();
    let text = &text[..text.len() - padding];
    if text.len() % 4 == 1 || (padding > 0 && !(text.len() + padding).is_multiple_of(4)) {
        return None;
    }
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for letters in text.chunks(4) {
        let mut group = 0;
        for place in 0..4 {
            let digit = letters.get(place).map_or(0, |&letter| DIGITS[letter as usize]);
            if digit == NO_DIGIT {
                return None;
            }
            group = group << 6 | u32::from(digit);
        }
        let [_, three @ ..] = group.to_be_bytes();
        bytes.extend_from_slice(&three[..letters.len() - 1]);
    }
    Some(bytes)
}
