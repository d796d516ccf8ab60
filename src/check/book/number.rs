//! Which beginning of a word `>>` takes for a number.

/// Why a number was not read.
pub(super) enum Misfit {
    NoNumber,
    OutOfRange,
}

fn digits(text: &[u8]) -> usize {
    text.iter().take_while(|byte| byte.is_ascii_digit()).count()
}

/// How many bytes at the beginning are a decimal number: sign, digits with a point, exponent.
pub(super) fn float_length(word: &[u8]) -> Option<usize> {
    let sign = usize::from(matches!(word.first(), Some(b'+' | b'-')));
    let before = digits(&word[sign..]);
    let mut end = sign + before;
    let mut after = 0;
    if word.get(end) == Some(&b'.') {
        after = digits(&word[end + 1..]);
        end += 1 + after;
    }
    if before + after == 0 {
        return None;
    }
    if let Some(b'e' | b'E') = word.get(end) {
        let sign = usize::from(matches!(word.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(&word[end + 1 + sign..]);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    Some(end)
}

/// The whole number at the beginning, and how many bytes it has.
pub(super) fn whole(word: &[u8]) -> Result<(usize, i64), Misfit> {
    let sign = usize::from(matches!(word.first(), Some(b'+' | b'-')));
    let length = digits(&word[sign..]);
    if length == 0 {
        return Err(Misfit::NoNumber);
    }
    let magnitude = word[sign..sign + length]
        .iter()
        .try_fold(0i64, |value, digit| {
            value.checked_mul(10)?.checked_add(i64::from(digit - b'0'))
        })
        .ok_or(Misfit::OutOfRange)?;
    let value = if word[0] == b'-' { -magnitude } else { magnitude };
    Ok((sign + length, value))
}
