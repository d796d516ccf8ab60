//! Decimal numbers: a quick exact path for what exporters write, and the mending of what some write instead.

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reading {
    /// A number as `str::parse::<f32>` reads it; always finite.
    Plain(f32),
    /// Written in a foreign way, such as `1,5` or `1.0f`, but clear.
    Mended(f32),
    /// `NaN`, an infinity, or beyond the range of `f32`.
    NotFinite,
}

/// Reads the number that begins at `window[1]` and ends before a blank, and gives it with the place of that blank. What
/// stands at `window[0]` does not matter; it is the blank before the number.
///
/// The value is the `f32` nearest to the decimal, exactly as `str::parse` gives it. `None` says nothing about the text: it is
/// only not one of the plain cases, and [`read`] decides.
#[inline(always)]
pub(super) fn plain(window: &[u8; WINDOW]) -> Option<(f32, usize)> {
    let negative = window[1] == b'-';
    let start = 1 + usize::from(negative);
    let first = u64::from(window[start].wrapping_sub(b'0'));
    if first > 9 {
        return None;
    }
    // Only the sign bit, so that -0 keeps it.
    let signed = |value: f32, end| (f32::from_bits(value.to_bits() ^ (u32::from(negative) << 31)), end);
    // One or two digits before the point are the common cases by far.
    let second = u64::from(window[start + 1].wrapping_sub(b'0'));
    let (whole, point) = if window[start + 1] == b'.' {
        (first, start + 1)
    } else if window[start + 2] == b'.' && second <= 9 {
        (first * 10 + second, start + 2)
    } else if window[start + 1] <= b' ' {
        return Some(signed(first as i64 as f32, start + 1));
    } else {
        let (whole, behind) = whole_part(window, start)?;
        if window[behind & INSIDE] <= b' ' {
            // Seven digits, which f32 holds exactly.
            return Some(signed(whole as i64 as f32, behind));
        }
        if window[behind & INSIDE] != b'.' {
            let end = end_of_token(window)?;
            return with_exponent(window, whole, 0, behind, end).map(|value| signed(value, end));
        }
        (whole, behind)
    };
    let (part, count) = leading_digits(eight(window, point + 1));
    if count == 0 {
        return None;
    }
    let mantissa = whole * TEN_TO[count & 15] + part;
    let behind = point + 1 + count;
    if window[behind & INSIDE] <= b' ' {
        return scaled(mantissa, PART_OF[count & 15]).map(|value| signed(value, behind));
    }
    let end = end_of_token(window)?;
    more_digits(window, mantissa, count, behind, end).map(|value| signed(value, end))
}

/// Goes on behind `count` digits of the fraction: with more of them, when these were eight, and an exponent.
#[inline(never)]
fn more_digits(window: &[u8; WINDOW], mantissa: u64, count: usize, behind: usize, end: usize) -> Option<f32> {
    if count < 8 {
        return with_exponent(window, mantissa, count, behind, end);
    }
    let (part, more) = leading_digits(eight(window, behind));
    // 18 digits keep the mantissa below 2^63.
    if mantissa >= 10_000_000_000 {
        return None;
    }
    let mantissa = if more > 0 {
        mantissa * TEN_TO[more & 15] + part
    } else {
        mantissa
    };
    if behind + more == end {
        return nearest(mantissa, -8 - more as i64);
    }
    with_exponent(window, mantissa, 8 + more, behind + more, end)
}

/// The value of `mantissa` with `fraction` digits behind its point, and of the exponent at `behind`, which must reach to `end`.
#[inline(never)]
fn with_exponent(window: &[u8; WINDOW], mantissa: u64, fraction: usize, behind: usize, end: usize) -> Option<f32> {
    if window.get(behind)? | 0x20 != b'e' {
        return None;
    }
    let (exponent, length) = written_exponent(window.get(behind + 1..)?)?;
    if behind + 1 + length != end {
        return None;
    }
    nearest(mantissa, exponent - fraction as i64)
}

/// The digits before the point, at most seven, and the place behind them.
#[inline(always)]
fn whole_part(window: &[u8; WINDOW], start: usize) -> Option<(u64, usize)> {
    let (whole, count) = leading_digits(eight(window, start));
    (1..8).contains(&count).then_some((whole, start + count))
}

/// Reads a whole number of up to seven digits, below `limit`, that begins at `start`, and gives it with the place behind the blank or line
/// end behind it. Of numbers one behind the other up to four fit into the window.
#[inline(always)]
pub(super) fn plain_whole(window: &[u8; WINDOW], start: usize, limit: u32) -> Option<(u32, usize)> {
    let (value, count) = leading_digits(eight(window, start));
    // At most seven digits, so that the value fits, and a blank behind them.
    let end = start + count;
    if count == 0 || count == 8 || window[end & INSIDE] > b' ' || value as u32 >= limit {
        return None;
    }
    Some((value as u32, end + 1))
}

/// The place of the first blank or line end behind `window[1]`, for tokens of up to 15 bytes.
#[inline(always)]
fn end_of_token(window: &[u8; WINDOW]) -> Option<usize> {
    let first = blanks(eight(window, 1));
    let second = blanks(eight(window, 9));
    let ahead = if first == 0 {
        64 + second.trailing_zeros()
    } else {
        first.trailing_zeros()
    };
    (first | second != 0).then_some(1 + (ahead / 8) as usize)
}

/// The top bit of the first byte that is a blank or another control character, and unreliable bits behind it.
#[inline(always)]
fn blanks(chunk: u64) -> u64 {
    chunk.wrapping_sub(0x2121_2121_2121_2121) & !chunk & 0x8080_8080_8080_8080
}

/// Bytes that are looked at for one number. Longer ones, and those near the end of the file, are not plain.
pub(super) const WINDOW: usize = 40;

/// Where digits can begin or end in the window, which leaves eight bytes behind. Taken as a mask, it shows the compiler that
/// what is looked at is inside.
const INSIDE: usize = 31;

/// Eight bytes of the window.
#[inline(always)]
fn eight(window: &[u8; WINDOW], start: usize) -> u64 {
    let bytes = window[start & INSIDE..].first_chunk::<8>();
    bytes.map_or(0, |bytes| u64::from_le_bytes(*bytes))
}

/// The digits that eight bytes begin with, as a number, and how many they are. The first byte is the lowest. Without digits
/// the number means nothing.
#[inline(always)]
fn leading_digits(chunk: u64) -> (u64, usize) {
    // Digits become 0…9. The addition sets the top bit of 10…0x89, and the rest has it already or overflows: a byte that
    // overflows is no digit, and carries only into bytes behind it, which do not matter then.
    let values = chunk ^ 0x3030_3030_3030_3030;
    let others = (values.wrapping_add(0x7676_7676_7676_7676) | values) & 0x8080_8080_8080_8080;
    let bits = others.trailing_zeros() & !7;
    // Zeros in front push out what follows the digits.
    let digits = values.wrapping_shl(64 - bits);
    // Pairs, fours and eights are summed in place.
    let pairs = digits.wrapping_mul(10).wrapping_add(digits >> 8);
    let low = (pairs & 0x0000_00FF_0000_00FF).wrapping_mul(0x000F_4240_0000_0064);
    let high = ((pairs >> 16) & 0x0000_00FF_0000_00FF).wrapping_mul(0x0000_2710_0000_0001);
    (low.wrapping_add(high) >> 32, (bits / 8) as usize)
}

/// Powers that join two runs of digits; a run has at most eight.
#[rustfmt::skip]
const TEN_TO: [u64; 16] = [
    1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000, 0, 0, 0, 0, 0, 0, 0,
];

/// What a unit is worth behind as many digits of a fraction.
const PART_OF: [f64; 16] = [
    1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];

/// What stands behind `e`, up to four digits with an optional sign, and its length.
fn written_exponent(text: &[u8]) -> Option<(i64, usize)> {
    let negative = *text.first()? == b'-';
    let start = usize::from(negative || text.first() == Some(&b'+'));
    let mut at = start;
    let mut exponent = 0_i64;
    while at < start + 4
        && let Some(digit) = text.get(at).filter(|byte| byte.is_ascii_digit())
    {
        exponent = exponent * 10 + i64::from(digit - b'0');
        at += 1;
    }
    (at > start).then_some((if negative { -exponent } else { exponent }, at))
}

/// The `f32` nearest to `mantissa * 10^exponent`, for a mantissa below 10^18; `None` where `f64` cannot decide it.
#[inline(always)]
fn nearest(mantissa: u64, exponent: i64) -> Option<f32> {
    // With these powers the product is zero or a normal number of f32, so that no other rounding than the usual one is met.
    scaled(mantissa, *POWERS_OF_TEN.get((exponent - SMALLEST_POWER) as usize)?)
}

/// The `f32` nearest to `mantissa * power`, where `power` is as near to a power of ten as `f64` can be.
#[inline(always)]
fn scaled(mantissa: u64, power: f64) -> Option<f32> {
    // Signed, because that conversion is one instruction where the unsigned one is several.
    let product = mantissa as i64 as f64 * power;
    // Mantissa, power and product are each off by half a unit of f64 at most. Rounding to f32 can only go wrong when that
    // reaches across a midpoint between two f32, where the 29 bits that will be dropped are 1000…0.
    let dropped = product.to_bits() & 0x1FFF_FFFF;
    if dropped.wrapping_sub(0x1000_0000 - MIDPOINT_MARGIN) <= 2 * MIDPOINT_MARGIN {
        return None;
    }
    Some(product as f32)
}

/// Units in the last place of `f64` that are kept from a midpoint: the three halves above, with room.
const MIDPOINT_MARGIN: u64 = 8;

/// Exponent of the first of [`POWERS_OF_TEN`].
const SMALLEST_POWER: i64 = -37;

/// From just above the smallest normal `f32` to where 18 digits reach its largest.
#[rustfmt::skip]
const POWERS_OF_TEN: [f64; 58] = [
    1e-37, 1e-36, 1e-35, 1e-34, 1e-33, 1e-32, 1e-31, 1e-30, 1e-29, 1e-28, 1e-27, 1e-26, 1e-25, 1e-24, 1e-23, 1e-22,
    1e-21, 1e-20, 1e-19, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5,
    1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
    1e16, 1e17, 1e18, 1e19, 1e20,
];

/// Reads a whole token as a number. `None` when it is none, even with good will.
pub(super) fn read(token: &[u8]) -> Option<Reading> {
    if let Ok(value) = fast_float2::parse::<f32, _>(token) {
        return Some(if value.is_finite() {
            Reading::Plain(value)
        } else {
            Reading::NotFinite
        });
    }
    if not_finite(token) {
        return Some(Reading::NotFinite);
    }
    let trimmed = token
        .strip_suffix(b",")
        .or_else(|| token.strip_suffix(b";"))
        .unwrap_or(token);
    let trimmed = trimmed
        .strip_suffix(b"f")
        .or_else(|| trimmed.strip_suffix(b"F"))
        .unwrap_or(trimmed);
    let value = match fast_float2::parse::<f32, _>(trimmed) {
        Ok(value) => value,
        Err(_) => with_decimal_comma(trimmed)?,
    };
    Some(if value.is_finite() {
        Reading::Mended(value)
    } else {
        Reading::NotFinite
    })
}

/// `1,5`: one comma, and no point beside it.
fn with_decimal_comma(token: &[u8]) -> Option<f32> {
    /// No `f32` needs more; anything longer is not a number somebody wrote.
    const LONGEST: usize = 64;
    let mut text = [0; LONGEST];
    let text = text.get_mut(..token.len())?;
    text.copy_from_slice(token);
    let comma = memchr::memchr(b',', text)?;
    if memchr::memchr2(b'.', b',', text.get(comma + 1..)?).is_some() || text.contains(&b'.') {
        return None;
    }
    *text.get_mut(comma)? = b'.';
    fast_float2::parse::<f32, _>(&*text).ok()
}

/// What C and C++ runtimes print for numbers that are none: `-1.#IND`, `1.#QNAN0`, `-nan(ind)`, `inf`.
fn not_finite(token: &[u8]) -> bool {
    let unsigned = token
        .strip_prefix(b"-")
        .or_else(|| token.strip_prefix(b"+"))
        .unwrap_or(token);
    let starts = |word: &str| {
        unsigned
            .get(..word.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(word.as_bytes()))
    };
    if [
        "1.#IND", "1.#INF", "1.#QNAN", "1.#SNAN", "1.#J", "1.#R", "1#IND", "1#INF", "1#QNAN",
    ]
    .into_iter()
    .any(starts)
    {
        return true;
    }
    ["nan(ind)", "nan(snan)", "qnan", "snan"]
        .into_iter()
        .any(|word| unsigned.eq_ignore_ascii_case(word.as_bytes()))
}
