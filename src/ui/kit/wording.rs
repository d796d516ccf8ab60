//! Numbers and names as people read them.

/// A whole number with thousands grouped by narrow spaces: `13 748`.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 * 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A length or a mean with about three significant digits: `73.4`, `0.0123`, `13 748`.
pub fn measured(length: f32) -> String {
    match length.abs() {
        _ if !length.is_finite() => "–".to_owned(),
        0.0 => "0".to_owned(),
        size if !(1e-3..1e7).contains(&size) => format!("{length:.2e}"),
        size if size >= 1000.0 => {
            let sign = if length < 0.0 { "−" } else { "" };
            format!("{sign}{}", grouped(size.round() as usize))
        }
        size if size >= 100.0 => format!("{length:.0}"),
        size if size >= 10.0 => format!("{length:.1}"),
        size if size >= 1.0 => format!("{length:.2}"),
        size if size >= 0.1 => format!("{length:.3}"),
        size if size >= 0.01 => format!("{length:.4}"),
        _ => format!("{length:.5}"),
    }
}

/// A time in milliseconds: `0.42 ms`, `12.3 ms`.
pub fn milliseconds(secs: f32) -> String {
    let millisecs = secs * 1e3;
    let decimals = if millisecs < 9.995 { 2 } else { 1 };
    format!("{millisecs:.decimals$} ms")
}

/// An amount of data with about three digits: `96 B`, `1.54 kB`, `12.3 MB`.
pub fn bytes(count: u64) -> String {
    if count < 1000 {
        return format!("{count} B");
    }
    let mut amount = count as f64 / 1e3;
    let mut unit = "kB";
    for larger in ["MB", "GB"] {
        if amount >= 999.5 {
            (amount, unit) = (amount / 1e3, larger);
        }
    }
    let decimals = if amount < 9.995 { 2 } else { usize::from(amount < 99.95) };
    format!("{amount:.decimals$} {unit}")
}

/// A name cut to some characters, with an ellipsis in its middle.
pub(in crate::ui) fn shortened(name: &str, most: usize) -> String {
    let count = name.chars().count();
    if count <= most {
        return name.to_owned();
    }
    let tail = most / 2;
    let head = name.chars().take(most - 1 - tail);
    head.chain(['…']).chain(name.chars().skip(count - tail)).collect()
}

/// The end of a path, after an ellipsis if something is cut.
pub(in crate::ui) fn shortened_front(path: &str, most: usize) -> String {
    let count = path.chars().count();
    if count <= most {
        return path.to_owned();
    }
    std::iter::once('…')
        .chain(path.chars().skip(count + 1 - most))
        .collect()
}

/// A number without trailing zeros.
pub(in crate::ui) fn trimmed(number: f32) -> String {
    let text = format!("{number:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A label with its first letter large.
pub(in crate::ui) fn capital(label: &str) -> String {
    let mut letters = label.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// `1 note`, `2 notes`.
pub(in crate::ui) fn counted(count: usize, word: &str) -> String {
    format!("{} {word}{}", grouped(count), if count == 1 { "" } else { "s" })
}

/// `1 vertex`, `945 vertices`.
pub(in crate::ui) fn counted_vertices(count: u32) -> String {
    match count {
        1 => "1 vertex".to_owned(),
        count => format!("{} vertices", grouped(count as usize)),
    }
}
