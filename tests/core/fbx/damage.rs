//! What is told of damaged files: where it is, and of which object and which of its records.

use bindpose::diagnostic::Fault;
use bindpose::fbx::{Budget, Record, Value, parse};
use bindpose::import::import;
use bindpose::session::{File, FileCommand, Session};

use super::surface::skinned;
use crate::binary_fbx::{Binary, array, text};

#[test]
fn damage_names_the_object_and_its_property() {
    let file = skinned(&[1.0]);
    for (from, to, told) in [
        (
            "-6",
            "-9",
            "In \"L\": PolygonVertexIndex: A polygon names control point 8, but there are 6.",
        ),
        (
            "Indexes: *6",
            "Indexes: *7",
            "An array says that it has 7 numbers, and has 6.",
        ),
    ] {
        let refused = import(file.replacen(from, to, 1).as_bytes()).map(drop).expect_err(told);
        assert_eq!(refused.error.message, told);
        assert!(
            refused.error.position.is_some_and(|position| position.line > 5),
            "{:?}",
            refused.error
        );
    }
}

/// What stands for the bytes of an array that is damaged.
const NO_ZLIB: &[u8] = b"what nobody deflated";

/// A file of text as a binary one, in which the first array of a record of this name is damaged.
fn binary(file: &str, damaged: &str) -> Vec<u8> {
    fn write(to: &mut Binary, record: &Record<'_>, damaged: &str) {
        let value = |value: &Value<'_>| match value {
            Value::Integer(integer) => [&b"L"[..], &integer.to_le_bytes()].concat(),
            Value::Number(number) => [&b"D"[..], &number.to_le_bytes()].concat(),
            Value::Text(word) => text(&String::from_utf8_lossy(word)),
            Value::Array(_) => {
                let numbers = record.numbers(&Budget::of_file(0)).expect("of text");
                let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
                let is_damaged = record.name == damaged;
                let bytes = if is_damaged { NO_ZLIB } else { &bytes };
                array(b'd', numbers.len() as u32, is_damaged, bytes)
            }
        };
        let values: Vec<u8> = record.values.iter().flat_map(value).collect();
        let inner = |to: &mut Binary| record.records.iter().for_each(|inner| write(to, inner, damaged));
        let inner: Option<&dyn Fn(&mut Binary)> = if record.records.is_empty() { None } else { Some(&inner) };
        to.record(&record.name, record.values.len() as u32, &values, inner);
    }
    let document = parse(file.as_bytes()).expect("it is sound");
    let mut to = Binary::new(7400);
    document
        .records
        .iter()
        .for_each(|record| write(&mut to, record, damaged));
    to.0.extend([0; 13]);
    to.0
}

fn refused(bytes: &[u8]) -> Fault {
    Box::new(import(bytes).map(drop).expect_err("it is damaged").error)
}

/// A bone that moves a sheet, and is moved by a curve.
fn moved() -> String {
    let curve = "\tAnimationStack: 10, \"AnimStack::Take\", \"\" {\n\t}\n\tAnimationLayer: 11, \"AnimLayer::Base\", \"\" {\n\t}\n\t\
                 AnimationCurveNode: 12, \"AnimCurveNode::T\", \"\" {\n\t}\n\tAnimationCurve: 13, \"AnimCurve::\", \"\" {\n\t\tKeyTime: *2 \
                 {\n\t\t\ta: 0,46186158000\n\t\t}\n\t\tKeyValueFloat: *2 {\n\t\t\ta: 0,100\n\t\t}\n\t\tKeyAttrFlags: *1 {\n\t\t\ta: \
                 4\n\t\t}\n\t\tKeyAttrRefCount: *1 {\n\t\t\ta: 2\n\t\t}\n\t}\n\tModel: 2,";
    let connections = "C: \"OO\",11,10\n\tC: \"OO\",12,11\n\tC: \"OP\",13,12,\"d|X\"\n\tC: \"OP\",12,100,\"Lcl Translation\"\n\tC: \"OO\",2,0\n";
    skinned(&[1.0])
        .replacen("\tModel: 2,", curve, 1)
        .replacen("C: \"OO\",2,0\n", connections, 1)
        .replacen("\"SubDeformer::\"", "\"SubDeformer::Wrist\"", 1)
}

#[test]
fn a_damaged_array_is_told_with_its_record_its_object_and_its_byte() {
    let file = moved();
    let sound = import(&binary(&file, "none")).unwrap_or_else(|refused| panic!("{:?}", refused.error));
    assert_eq!((sound.model.mesh.indices.len(), sound.model.clips.len()), (12, 1));
    for (name, object, count) in [
        ("Vertices", "In \"L\": ", 18),
        ("PolygonVertexIndex", "In \"L\": ", 6),
        ("Indexes", "In \"Wrist\": ", 6),
        ("Weights", "In \"Wrist\": ", 6),
        ("Transform", "", 16),
        ("TransformLink", "", 16),
        ("Matrix", "", 16),
        ("KeyTime", "", 2),
        ("KeyValueFloat", "", 2),
        ("KeyAttrFlags", "", 1),
    ] {
        let bytes = binary(&file, name);
        let fault = refused(&bytes);
        let numbers = if count == 1 { "number" } else { "numbers" };
        let told = format!("{name}: An array of {count} {numbers} takes {} bytes; ", 8 * count);
        assert!(
            fault.message.starts_with(object) && fault.message.contains(&told),
            "{name}: {}",
            fault.message
        );
        let at = bytes.windows(NO_ZLIB.len()).position(|window| window == NO_ZLIB);
        assert_eq!(fault.byte_offset, at.map(|at| at as u64), "{name}");
    }
}

/// The card with an error has the place as `check` prints it: a byte of a binary file, a line of one of text.
#[test]
fn the_card_of_an_error_has_the_byte_or_the_line() {
    let file = moved();
    let damaged_text = file.replacen("Vertices: *18", "Vertices: *19", 1);
    let line = 1 + damaged_text
        .lines()
        .position(|line| line.contains("*19"))
        .expect("it is there");
    let damaged = binary(&file, "Vertices");
    let at = damaged.windows(NO_ZLIB.len()).position(|window| window == NO_ZLIB);
    for (bytes, place) in [
        (
            damaged_text.into_bytes(),
            format!("sheet.fbx:{line}:13: error[fbx-damaged]: An array"),
        ),
        (
            damaged,
            format!("sheet.fbx@{}: error[fbx-damaged]: In \"L\"", at.expect("it is there")),
        ),
    ] {
        let mut session = Session::new(false);
        session.apply(FileCommand::Add(vec![File::new("sheet.fbx", bytes)]));
        let told = session.error().expect("it is damaged").to_text();
        assert!(told.starts_with(&place), "{told}");
    }
}

#[test]
fn a_file_that_was_cut_off_and_one_of_another_kind_are_told_as_that() {
    let error = |path: &str, bytes: &[u8]| {
        let mut session = Session::new(false);
        session.apply(FileCommand::Add(vec![File::new(path, bytes.to_vec())]));
        session.error().expect("it cannot be read").diagnostic.clone()
    };
    let whole = binary(&skinned(&[1.0]), "");
    let cut = error("cut.fbx", &whole[..whole.len() / 2]);
    let half = whole.len() / 2;
    assert_eq!(cut.code, "fbx-damaged");
    assert!(
        cut.message.starts_with(&format!(
            "The file ends at byte {half}, within a record that goes on to byte "
        )),
        "{}",
        cut.message
    );
    assert!(
        cut.message.ends_with("It may have been cut off on its way here."),
        "{}",
        cut.message
    );
    let other = error("notes.fbx", b"hello, this is no model");
    assert_eq!(
        (&*other.message, other.expected.as_deref()),
        (
            "This is no .fbx file, whatever its name says: it begins with \"hello,\".",
            Some("what .fbx files begin with")
        )
    );
}
