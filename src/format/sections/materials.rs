//! Materials: labelled lines in any order. The two books differ only here.

use crate::diagnostic::{Fault, codes};
use crate::format::cursor::Token;
use crate::format::document::{Material, Reflectance};
use crate::format::error::Value;
use crate::format::kind::DiagnosticKind;
use crate::format::label::{Section, is_ruler, same, same_as_any};
use crate::format::reader::Reader;

/// Lines of a material. The order is that of the books; [`Line::LABELS`] has the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Line {
    Name,
    Ambient,
    Diffuse,
    Specular,
    SpecPower,
    Reflectivity,
    Fresnel0,
    Roughness,
    AlphaClip,
    MaterialTypeName,
    Effect,
    DiffuseMap,
    NormalMap,
}

impl Line {
    const COUNT: usize = 13;

    /// The books' label of each line, and other spellings.
    const LABELS: [(Self, &'static str, &'static [&'static str]); Self::COUNT] = [
        (Self::Name, "Name", &["materialname"]),
        (Self::Ambient, "Ambient", &[]),
        (Self::Diffuse, "Diffuse", &["diffusealbedo"]),
        (Self::Specular, "Specular", &[]),
        (Self::SpecPower, "SpecPower", &["specularpower"]),
        (Self::Reflectivity, "Reflectivity", &["reflect"]),
        (Self::Fresnel0, "Fresnel0", &["fresnelr0", "fresnel"]),
        (Self::Roughness, "Roughness", &[]),
        (Self::AlphaClip, "AlphaClip", &[]),
        (Self::MaterialTypeName, "MaterialTypeName", &["materialtype"]),
        (Self::Effect, "Effect", &["effecttype"]),
        (Self::DiffuseMap, "DiffuseMap", &[]),
        (Self::NormalMap, "NormalMap", &[]),
    ];

    /// Lines that a material of the DirectX 12 book must have.
    const OF_FRESNEL: [Self; 8] = [
        Self::Name,
        Self::Diffuse,
        Self::Fresnel0,
        Self::Roughness,
        Self::AlphaClip,
        Self::MaterialTypeName,
        Self::DiffuseMap,
        Self::NormalMap,
    ];

    /// Lines that a material of the DirectX 11 book must have.
    const OF_PHONG: [Self; 9] = [
        Self::Ambient,
        Self::Diffuse,
        Self::Specular,
        Self::SpecPower,
        Self::Reflectivity,
        Self::AlphaClip,
        Self::Effect,
        Self::DiffuseMap,
        Self::NormalMap,
    ];

    fn of_label(label: &[u8]) -> Option<Self> {
        let is = |&(_, name, others): &(Self, &str, &[&str])| same(label, name) || same_as_any(label, others);
        Self::LABELS.iter().find(|entry| is(entry)).map(|&(line, ..)| line)
    }

    fn label(self) -> &'static str {
        Self::LABELS[self as usize].1
    }
}

/// The lines of one material, and where their values begin.
#[derive(Clone, Copy, Default)]
struct Block<'a> {
    lines: [Option<Token<'a>>; Line::COUNT],
    first: Option<Token<'a>>,
}

/// Fewer lines than this are no material. It also bounds the memory that a byte of the file can ask for.
const FEWEST_LINES: usize = 3;

/// Reads the materials, with the line of the first label of each.
pub(in crate::format) async fn materials(
    reader: &mut Reader<'_>,
    count: u32,
) -> Result<(Vec<Material>, Vec<u32>), Fault> {
    /// `Effect:` and two such lines.
    const SMALLEST: usize = 24;
    reader.begin_rows(Section::Materials)?;
    // Blank lines part the materials. Some writers leave them out and some put them anywhere; then a label that comes
    // again begins the next material.
    let blank_lines_part = count_blocks(reader).await == count as usize;
    let room = reader.room_for(count, SMALLEST);
    let (mut materials, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let mut counted = 0;
    while let Some(block) = next_block(reader, blank_lines_part)? {
        reader.pause_every(counted).await;
        if counted < count as usize {
            lines.push(block.first.map_or(0, |first| first.position.line));
            materials.push(material_of(reader, &block)?);
        }
        counted += 1;
    }
    if reader.cursor.peek_token().is_none() && counted <= count as usize {
        let expected = if counted < count as usize {
            format!("material {} of {count}", counted + 1)
        } else {
            "the SubsetTable section".into()
        };
        return Err(reader.end(expected));
    }
    if counted != count as usize {
        return Err(reader.section_row_count("materials", count, counted));
    }
    Ok((materials, lines))
}

/// A labelled line of this section, not yet read: its label, its value, and whether a blank line stands before it. `None`
/// where the section ends.
fn next_line<'a>(reader: &mut Reader<'a>) -> Option<(Token<'a>, Token<'a>, bool)> {
    let before = reader.cursor.line;
    let started = !reader
        .cursor
        .bytes
        .get(reader.cursor.line_start..reader.cursor.at)?
        .trim_ascii()
        .is_empty();
    reader.cursor.skip_space();
    let blank = reader.cursor.line > before + u32::from(started);
    let rest = reader.cursor.rest();
    if rest.is_empty() || is_ruler(rest) || matches!(rest.first(), Some(b'{' | b'}')) {
        return None;
    }
    let (label, behind) = reader.peek_label()?;
    if same_as_any(label.text, &["subsetid", "position", "p"]) {
        return None;
    }
    let mut line = reader.cursor;
    let whole = line.rest_of_line();
    reader.cursor = behind;
    let mut label = label;
    let mut value = if reader.cursor.line == label.position.line {
        reader.cursor.rest_of_line()
    } else {
        Token {
            text: b"",
            position: label.position,
        }
    };
    // `Diffuse Map: x`: a label of two words.
    if Line::of_label(label.text).is_none()
        && let Some(colon) = memchr::memchr(b':', whole.text)
        && let Some(words) = whole.text.get(..=colon)
        && Line::of_label(words).is_some()
    {
        label = Token {
            text: words,
            position: whole.position,
        };
        let text = whole.text.get(colon + 1..).unwrap_or_default().trim_ascii();
        value = Token {
            text,
            position: whole.position,
        };
    }
    Some((label, value, blank))
}

/// Groups of known lines that blank lines part, without reading them.
async fn count_blocks(reader: &Reader<'_>) -> usize {
    let mut ahead = reader.clone();
    let mut blocks = 0;
    let mut fresh = true;
    let mut line = 0;
    while let Some((label, _, blank)) = next_line(&mut ahead) {
        reader.pause_every(line).await;
        line += 1;
        fresh |= blank;
        if Line::of_label(label.text).is_some() {
            blocks += usize::from(fresh);
            fresh = false;
        }
    }
    blocks
}

/// Reads the lines of the next material; `None` where the section ends.
fn next_block<'a>(reader: &mut Reader<'a>, blank_lines_part: bool) -> Result<Option<Block<'a>>, Fault> {
    let mut block = Block::default();
    loop {
        let before = reader.cursor;
        let Some((label, value, blank)) = next_line(reader) else {
            reader.cursor = before;
            return Ok(block.first.is_some().then_some(block));
        };
        if blank_lines_part && blank && block.first.is_some() {
            reader.cursor = before;
            return Ok(Some(block));
        }
        let Some(line) = Line::of_label(label.text) else {
            reader.note(label, DiagnosticKind::unknown(Section::Materials, label.text));
            continue;
        };
        let place = &mut block.lines[line as usize];
        if place.is_some() {
            if !blank_lines_part {
                reader.cursor = before;
                return Ok(Some(block));
            }
            reader.note(label, DiagnosticKind::LabelRepeated(line.label().into()));
        }
        *place = Some(value);
        block.first = block.first.or(Some(label));
    }
}

fn material_of(reader: &mut Reader<'_>, block: &Block<'_>) -> Result<Material, Fault> {
    let first = block.first.unwrap_or(Token {
        text: b"",
        position: reader.cursor.position(),
    });
    let given = |line: Line| block.lines[line as usize];
    if block.lines.iter().flatten().count() < FEWEST_LINES {
        let fault = codes::MATERIAL_INCOMPLETE.says(codes::MATERIAL_INCOMPLETE.sentence);
        return Err(Reader::error_at(first, fault.expected("the lines of a material")));
    }
    let of_fresnel = [Line::Fresnel0, Line::Roughness].into_iter().filter_map(given).count();
    let of_phong = [Line::Ambient, Line::Specular, Line::SpecPower, Line::Reflectivity];
    let of_phong = of_phong.into_iter().filter_map(given).count();
    let fresnel = match (of_fresnel, of_phong) {
        (0, 0) => given(Line::Effect).is_none() && given(Line::Name).is_some(),
        (_, phong) => of_fresnel * 2 >= phong && of_fresnel > 0,
    };
    let expected: &[Line] = if fresnel { &Line::OF_FRESNEL } else { &Line::OF_PHONG };
    for &line in expected.iter().filter(|&&line| given(line).is_none()) {
        reader.note(first, DiagnosticKind::MaterialLineMissing(line.label()));
    }
    for &(line, label, _) in &Line::LABELS {
        if let Some(value) = given(line)
            && !expected.contains(&line)
            && line != Line::Name
        {
            let place = Token {
                text: b"",
                position: value.position,
            };
            reader.note(place, DiagnosticKind::unknown(Section::Materials, label.as_bytes()));
        }
    }
    let text = |line| given(line).map_or_else(String::new, |value| String::from_utf8_lossy(value.text).into_owned());
    let map = |line| Some(text(line)).filter(|name| !is_no_map(name));
    let reflectance = if fresnel {
        Reflectance::Fresnel {
            fresnel0: numbers(reader, given(Line::Fresnel0), Line::Fresnel0, [0.01; 3])?,
            roughness: number(reader, given(Line::Roughness), Line::Roughness, 0.5)?,
        }
    } else {
        Reflectance::Phong {
            ambient: numbers(reader, given(Line::Ambient), Line::Ambient, [0.5; 3])?,
            specular: numbers(reader, given(Line::Specular), Line::Specular, [0.2; 3])?,
            spec_power: number(reader, given(Line::SpecPower), Line::SpecPower, 16.0)?,
            reflectivity: numbers(reader, given(Line::Reflectivity), Line::Reflectivity, [0.0; 3])?,
        }
    };
    Ok(Material {
        name: text(Line::Name),
        diffuse: numbers(reader, given(Line::Diffuse), Line::Diffuse, [1.0; 3])?,
        reflectance,
        alpha_clip: alpha_clip(reader, given(Line::AlphaClip)),
        type_name: text(if fresnel { Line::MaterialTypeName } else { Line::Effect }),
        diffuse_map: map(Line::DiffuseMap),
        normal_map: map(Line::NormalMap),
    })
}

fn is_no_map(name: &str) -> bool {
    name.is_empty() || name.eq_ignore_ascii_case("none") || name.eq_ignore_ascii_case("null")
}

fn number(reader: &mut Reader<'_>, value: Option<Token<'_>>, line: Line, default: f32) -> Result<f32, Fault> {
    numbers(reader, value, line, [default]).map(|[number]| number)
}

/// The numbers of a line that is there, or the defaults.
fn numbers<const N: usize>(
    reader: &mut Reader<'_>,
    value: Option<Token<'_>>,
    line: Line,
    defaults: [f32; N],
) -> Result<[f32; N], Fault> {
    let Some(value) = value else { return Ok(defaults) };
    let what = Value::Number(line.label());
    let mut numbers = defaults;
    let mut words = words(value);
    for number in &mut numbers {
        let Some(word) = words.next() else {
            // One grey number for three colours, or a file that ends inside the line.
            return Err(what.missing().at(end_of(value), 0).into());
        };
        *number = reader.number_of(word, what, *number)?;
    }
    if let Some(word) = words.next() {
        reader.note(word, DiagnosticKind::ValuesSurplus);
    }
    Ok(numbers)
}

fn alpha_clip(reader: &mut Reader<'_>, value: Option<Token<'_>>) -> bool {
    let Some(value) = value else { return false };
    let mut words = words(value);
    let Some(word) = words.next() else {
        reader.note(value, DiagnosticKind::AlphaClipUnreadable);
        return false;
    };
    if let Some(surplus) = words.next() {
        reader.note(surplus, DiagnosticKind::ValuesSurplus);
    }
    let is = |names: [&str; 2]| {
        names
            .into_iter()
            .any(|name| word.text.eq_ignore_ascii_case(name.as_bytes()))
    };
    if is(["true", "yes"]) {
        return true;
    }
    if is(["false", "no"]) {
        return false;
    }
    match fast_float2::parse::<f32, _>(word.text) {
        Ok(number) if !number.is_nan() => number != 0.0,
        _ => {
            reader.note(word, DiagnosticKind::AlphaClipUnreadable);
            false
        }
    }
}

/// The words of a value, each with its place.
fn words<'a>(value: Token<'a>) -> impl Iterator<Item = Token<'a>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let rest = value.text.get(at..)?;
        let start = at + rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        let rest = value.text.get(start..)?;
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        at = start + length;
        Some(Token {
            text: rest.get(..length)?,
            position: column_after(value, start),
        })
    })
}

fn end_of(value: Token<'_>) -> crate::diagnostic::Position {
    column_after(value, value.text.len())
}

fn column_after(value: Token<'_>, bytes: usize) -> crate::diagnostic::Position {
    let mut position = value.position;
    position.column = position.column.saturating_add(u32::try_from(bytes).unwrap_or(u32::MAX));
    position
}
