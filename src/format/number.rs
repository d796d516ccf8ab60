//! Decimal numbers: a quick exact path for what exporters write, and the mending of what some write instead.

/// A number that needed help.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reading {
    /// A number as `str::parse::<f32>` reads it; always finite.
    Plain(f32),
    /// Written in a foreign way, such as `1,5` or `1.0f`, but clear.
    Mended(f32),
    /// `NaN`, an infinity, or beyond the range of `f32`.
    NotFinite,
}

/// Reads the number at `at`, which must start there and end at a blank, and gives it with the place behind it.
///
/// The value is the `f32` nearest to the decimal, exactly as `str::parse` gives it. `None` says nothing about the text: it is
/// only not one of the plain cases, and [`read`] decides.
#[inline]
pub(super) fn plain(bytes: &[u8], mut at: usize) -> Option<(f32, usize)> {
    let negative = *bytes.get(at)? == b'-';
    at += usize::from(negative);
    let mut digits = at;
    let mut mantissa = 0_u64;
    let mut byte = *bytes.get(at)?;
    while byte.is_ascii_digit() {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
        at += 1;
        byte = *bytes.get(at)?;
    }
    digits = at - digits;
    let mut exponent = 0;
    if byte == b'.' {
        at += 1;
        let fraction = at;
        loop {
            let (value, count) = up_to_eight_digits(bytes, at)?;
            mantissa = mantissa.wrapping_mul(TEN_TO[count]).wrapping_add(value);
            at += count;
            if count < 8 {
                break;
            }
        }
        digits += at - fraction;
        // At most the length of the file; more than 18 digits are turned away below.
        exponent = fraction as i64 - at as i64;
        byte = *bytes.get(at)?;
    }
    // 18 digits keep the mantissa below 2^63.
    if digits == 0 || digits > 18 {
        return None;
    }
    if byte | 0x20 == b'e' {
        at += 1;
        byte = *bytes.get(at)?;
        let small = byte == b'-';
        if small || byte == b'+' {
            at += 1;
            byte = *bytes.get(at)?;
        }
        let start = at;
        let mut written = 0_i64;
        while byte.is_ascii_digit() && at - start < 4 {
            written = written * 10 + i64::from(byte - b'0');
            at += 1;
            byte = *bytes.get(at)?;
        }
        if at == start {
            return None;
        }
        exponent += if small { -written } else { written };
    }
    if !matches!(byte, b' ' | b'\n' | b'\r' | b'\t') {
        return None;
    }
    let value = nearest(mantissa, exponent)?;
    Some((if negative { -value } else { value }, at))
}

/// The `f32` nearest to `mantissa * 10^exponent`, for a mantissa below 2^63; `None` where `f64` cannot decide it.
#[inline]
fn nearest(mantissa: u64, exponent: i64) -> Option<f32> {
    if mantissa == 0 {
        return Some(0.0);
    }
    let power = *POWERS_OF_TEN.get(usize::try_from(exponent - SMALLEST_POWER).ok()?)?;
    // Signed, because that conversion is one instruction where the unsigned one is several.
    let product = mantissa as i64 as f64 * power;
    // Outside the normal numbers of f32 the rounding below would be another one.
    if !(f64::from(f32::MIN_POSITIVE)..f64::from(f32::MAX)).contains(&product) {
        return None;
    }
    // Mantissa, power and product are each off by half a unit of f64 at most. Rounding to f32 can only go wrong when that
    // reaches across a midpoint between two f32, where the 29 bits that will be dropped are 1000…0.
    let dropped = (product.to_bits() & 0x1FFF_FFFF) as i64;
    if (dropped - 0x1000_0000).abs() <= MIDPOINT_MARGIN {
        return None;
    }
    Some(product as f32)
}

/// Units in the last place of `f64` that are kept from a midpoint: the three halves above, with room.
const MIDPOINT_MARGIN: i64 = 8;

/// Reads as many of the next eight bytes as are digits. `None` within eight bytes of the end of the file.
#[inline]
fn up_to_eight_digits(bytes: &[u8], at: usize) -> Option<(u64, usize)> {
    let chunk = u64::from_le_bytes(*bytes.get(at..)?.first_chunk::<8>()?);
    // Digits become 0…9. Adding 0x76 then sets the top bit of 10…0x8F, and the rest has it already. A byte that overflows
    // carries into bytes behind it only, and it is itself no digit.
    let values = chunk ^ 0x3030_3030_3030_3030;
    let others = (values.wrapping_add(0x7676_7676_7676_7676) | values) & 0x8080_8080_8080_8080;
    let count = (others.trailing_zeros() / 8) as usize;
    if count == 0 {
        return Some((0, 0));
    }
    // Zeros in front push out what follows the digits; then pairs, fours and eights are summed in place.
    let values = values << (64 - 8 * count);
    let pairs = values.wrapping_mul(10).wrapping_add(values >> 8);
    let low = (pairs & 0x0000_00FF_0000_00FF).wrapping_mul(0x000F_4240_0000_0064);
    let high = ((pairs >> 16) & 0x0000_00FF_0000_00FF).wrapping_mul(0x0000_2710_0000_0001);
    Some((low.wrapping_add(high) >> 32, count))
}

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

/// Powers that join two runs of digits.
const TEN_TO: [u64; 9] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// Exponent of the first of [`POWERS_OF_TEN`]: 18 digits behind the point of the smallest normal `f32`, and some.
const SMALLEST_POWER: i64 = -64;

#[rustfmt::skip]
const POWERS_OF_TEN: [f64; 103] = [
    1e-64, 1e-63, 1e-62, 1e-61, 1e-60, 1e-59, 1e-58, 1e-57, 1e-56, 1e-55, 1e-54, 1e-53, 1e-52, 1e-51, 1e-50, 1e-49,
    1e-48, 1e-47, 1e-46, 1e-45, 1e-44, 1e-43, 1e-42, 1e-41, 1e-40, 1e-39, 1e-38, 1e-37, 1e-36, 1e-35, 1e-34, 1e-33,
    1e-32, 1e-31, 1e-30, 1e-29, 1e-28, 1e-27, 1e-26, 1e-25, 1e-24, 1e-23, 1e-22, 1e-21, 1e-20, 1e-19, 1e-18, 1e-17,
    1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1,
    1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21,
    1e22, 1e23, 1e24, 1e25, 1e26, 1e27, 1e28, 1e29, 1e30, 1e31, 1e32, 1e33, 1e34, 1e35, 1e36, 1e37, 1e38,
];
