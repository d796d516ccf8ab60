//! FBX as its files have it.

mod damage;
mod materials;
mod motion;
mod oracle;
mod places;
mod polygons;
mod surface;

use bindpose::diagnostic::{Fault, Position};
use bindpose::fbx::{Budget, Document, Record, begins_like_fbx, parse};
use bindpose::import::{Imported, import};

use proptest::prelude::*;

use crate::binary_fbx::{Binary, array, text};
use crate::properties::cases;
use crate::shared::shared;

/// A small file of text.
const TEXT: &str = "; FBX 7.4.0 project file
; ----
FBXHeaderExtension:  {
\tFBXVersion: 7400
\tCreator: \"A \t&quot;pen&quot;\"
}
Objects:  {
\tGeometry: 42, \"Geometry::Cube\", \"Mesh\" {
\t\tVertices: *6 {
\t\t\ta: -1,0.5,2e1,
4,5,6
\t\t}
\t\tShading: T
\t\tEmpty: *0 {
\t\t}
\t\tContent: , \"YWJj\"
\t}
}
";

/// A mesh with an array.
fn mesh(array: &[u8]) -> Vec<u8> {
    let mut file = Binary::new(7400);
    file.record(
        "Objects",
        0,
        &[],
        Some(&|file| {
            let values = [b"L\x2a\0\0\0\0\0\0\0".to_vec(), text("Cube\0\x01Geometry")].concat();
            file.record(
                "Geometry",
                2,
                &values,
                Some(&|file| file.record("Vertices", 1, array, None)),
            );
        }),
    );
    file.0.extend([0; 13]);
    file.0.extend(b"what stands behind");
    file.0
}

fn of_mesh<'a, 'b>(document: &'b Document<'a>) -> &'b Record<'a> {
    document
        .find("Objects")
        .and_then(|objects| objects.find("Geometry"))
        .expect("a mesh")
}

/// What stands where, of a file that cannot be read.
fn fault(bytes: &[u8]) -> Fault {
    parse(bytes).map(drop).expect_err("it is damaged")
}

#[test]
fn text_is_read() {
    let document = parse(TEXT.as_bytes()).expect("it is sound");
    assert_eq!((document.version, document.is_binary), (7400, false));
    let creator = document
        .find("FBXHeaderExtension")
        .and_then(|header| header.find("Creator"));
    assert_eq!(creator.expect("it is there").text(0).expect("text"), "A \t\"pen\"");
    let mesh = of_mesh(&document);
    assert_eq!((mesh.integer(0), mesh.text(2).as_deref()), (Some(42), Some("Mesh")));
    assert_eq!(mesh.name_of(1).as_deref(), Some("Cube"));
    let budget = Budget::of_file(TEXT.len());
    let numbers = |name: &str| mesh.find(name).expect(name).numbers(&budget).expect("numbers");
    assert_eq!(numbers("Vertices"), [-1.0, 0.5, 20.0, 4.0, 5.0, 6.0]);
    assert_eq!(numbers("Empty"), [0.0; 0]);
    assert_eq!(
        mesh.find("Shading").and_then(|shading| shading.text(0)).as_deref(),
        Some("T")
    );
    assert_eq!(
        mesh.find("Content").and_then(|content| content.text(0)).as_deref(),
        Some("YWJj")
    );
}

#[test]
fn rows_of_numbers_of_the_older_text_are_arrays() {
    let row = (0..20).map(|number| number.to_string()).collect::<Vec<_>>().join(",");
    let file = format!(
        "; FBX 6.1.0 project file\nVertices: {}\n,5.5\nKeys: 1,2,L,3\nNext: 1,2\n",
        row.replace(",9,", ",9\n,")
    );
    let document = parse(file.as_bytes()).expect("it is sound");
    assert_eq!(document.version, 6100);
    let numbers = document
        .find("Vertices")
        .expect("it is there")
        .numbers(&Budget::of_file(0))
        .expect("numbers");
    assert_eq!((numbers.len(), numbers[19], numbers[20]), (21, 19.0, 5.5));
    assert_eq!(document.find("Keys").expect("it is there").values.len(), 4);
    assert_eq!(
        document
            .find("Next")
            .expect("it is there")
            .integers(&Budget::of_file(0))
            .expect("numbers"),
        [1, 2]
    );
}

#[test]
fn arrays_are_unpacked() {
    let numbers = [1.5f64, -2.0, 1e300];
    let plain: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let deflated = miniz_oxide::deflate::compress_to_vec_zlib(&plain, 6);
    for (is_deflated, bytes) in [(false, &plain), (true, &deflated)] {
        let file = mesh(&array(b'd', 3, is_deflated, bytes));
        let document = parse(&file).expect("it is sound");
        assert_eq!((document.version, document.is_binary), (7400, true));
        let mesh = of_mesh(&document);
        assert_eq!(mesh.name_of(1).as_deref(), Some("Cube"));
        let vertices = mesh.find("Vertices").expect("it is there");
        assert_eq!(
            vertices.numbers(&Budget::of_file(file.len())).expect("numbers"),
            numbers
        );
        assert_eq!(
            vertices.integers(&Budget::of_file(file.len())).expect("numbers")[..2],
            [1, -2]
        );
    }
}

#[test]
fn an_array_is_no_larger_than_its_bytes_allow() {
    let zeros = miniz_oxide::deflate::compress_to_vec_zlib(&[0; 800], 6);
    for (count, bytes, told) in [
        (u32::MAX, &zeros[..], "would become many times as large"),
        (2_000_000, &zeros[..], "deflated ones cannot become so many"),
        (99, &zeros[..], "damaged (HasMoreOutput)"),
        (101, &zeros[..], "800 come out"),
        (100, &zeros[..zeros.len() - 6], "is damaged"),
    ] {
        let file = mesh(&array(b'd', count, true, bytes));
        let document = parse(&file).expect("its records are sound");
        let vertices = of_mesh(&document).find("Vertices").expect("it is there");
        let fault = vertices.numbers(&Budget::of_file(file.len())).expect_err(told);
        assert!(fault.message.contains(told), "{told}: {}", fault.message);
        assert_eq!(fault.code, "fbx-damaged");
        assert!(fault.byte_offset.is_some());
    }
    // Many that are sound, one after the other.
    let file = mesh(&array(b'd', 100, true, &zeros));
    let document = parse(&file).expect("it is sound");
    let vertices = of_mesh(&document).find("Vertices").expect("it is there");
    let budget = Budget::of_file(0);
    let times = (0..).take_while(|_| vertices.numbers(&budget).is_ok()).count();
    assert_eq!(times, (64 << 20) / 800);
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let place = |text: &str| {
        let fault = parse(text.as_bytes()).map(drop).expect_err(text);
        (
            fault.position.map(|Position { line, column }| (line, column)),
            fault.message,
        )
    };
    for (from, to, at, told) in [
        ("*6", "*7", (9, 13), "says that it has 7 numbers, and has 6"),
        ("\t}\n}\n", "\t}\n", (18, 1), "The file ends in \"Objects\""),
        ("Objects:  {", "}", (7, 1), "A } ends what did not begin"),
        ("Shading: T", "Shading T", (13, 3), "\"Shading\" stands here"),
        ("\"YWJj\"", "\"YWJj", (16, 14), "does not end"),
        ("a: -1", "b: -1", (9, 13), "\"{ a:\" was expected"),
    ] {
        let (position, message) = place(&TEXT.replacen(from, to, 1));
        assert_eq!(position, Some(at), "{to}: {message}");
        assert!(message.contains(told), "{to}: {message}");
    }
    let deep = format!("; FBX 7.4.0 project file\n{}", "A: {\n".repeat(100));
    assert!(place(&deep).1.contains("one in the other"));
    let long = place(&format!("; FBX 7.4.0 project file\n{} ", "x".repeat(1 << 20)));
    assert!(long.1.len() < 200, "words are cut");
    let sound = mesh(&array(b'i', 1, false, &[0; 4]));
    assert_eq!(fault(&Binary::new(5000).0).code, "fbx-version");
    assert_eq!(fault(b"; FBX 5.1.0 project file\n").code, "fbx-version");
    for len in 28..sound.len() - 31 {
        let fault = fault(&sound[..len]);
        assert_eq!(fault.code, "fbx-damaged", "{len}");
        assert!(fault.byte_offset.is_some_and(|offset| offset <= len as u64), "{len}");
    }
}

/// All values of a record and what is in it, counted by kind.
fn count(record: &Record<'_>) -> (usize, usize) {
    let inner = record.records.iter().map(count);
    inner.fold((1, record.values.len()), |(records, values), (more, others)| {
        (records + more, values + others)
    })
}

/// What is told of a file with this code.
fn told<'a>(imported: &'a Imported, code: &str) -> Vec<&'a str> {
    let findings = imported.diagnostics.iter().filter(|finding| finding.code == code);
    findings.map(|finding| &*finding.message).collect()
}

/// The real files of a folder.
fn files(folder: &str) -> Vec<(String, Vec<u8>)> {
    let Some(folder) = shared(&format!("fbx/{folder}")) else {
        return Vec::new();
    };
    let entries = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "fbx"))
        .collect();
    paths.sort();
    paths
        .into_iter()
        .map(|path| {
            (
                path.file_name().expect("a name").to_string_lossy().into_owned(),
                std::fs::read(path).expect("a file"),
            )
        })
        .collect()
}

#[test]
fn real_files_are_read() {
    for (name, bytes) in files("files").into_iter().chain(files("mixamo")) {
        assert!(begins_like_fbx(&bytes), "{name}");
        match parse(&bytes) {
            Ok(document) => {
                let objects = document.find("Objects").unwrap_or_else(|| panic!("{name} has objects"));
                assert!(count(objects).1 > 0, "{name}");
                each_array(&document, &bytes).unwrap_or_else(|fault| panic!("{name}: {fault:?}"));
            }
            Err(fault) if name.contains("_fail_") => assert!(fault.code.starts_with("fbx-"), "{name}: {fault:?}"),
            Err(fault) => assert_eq!(fault.code, "fbx-version", "{name}: {fault:?}"),
        }
    }
}

/// Unpacks all arrays.
fn each_array(document: &Document<'_>, bytes: &[u8]) -> Result<(), Fault> {
    fn of(record: &Record<'_>, budget: &Budget) -> Result<(), Fault> {
        record.numbers(budget)?;
        record.records.iter().try_for_each(|inner| of(inner, budget))
    }
    let budget = Budget::of_file(bytes.len());
    document.records.iter().try_for_each(|record| of(record, &budget))
}

#[test]
fn damaged_files_are_an_answer() {
    for (_, bytes) in files("damaged") {
        if let Ok(document) = parse(&bytes) {
            let _ = each_array(&document, &bytes);
        }
        let _ = import(&bytes);
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn files_that_are_cut_or_changed_are_an_answer(
        which in 0..3usize,
        cut in proptest::option::of(0.0..1.0f64),
        changes in proptest::collection::vec((0.0..1.0f64, any::<u8>()), 0..12),
    ) {
        let name = ["walker", "walking", "waving"][which];
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/fixtures/fbx/{name}.fbx"));
        let mut bytes = std::fs::read(path).expect("it is there");
        let len = bytes.len() as f64;
        for (place, byte) in changes {
            bytes[(place * len) as usize] = byte;
        }
        bytes.truncate(cut.map_or(bytes.len(), |cut| (cut * len) as usize));
        if let Err(refused) = import(&bytes) {
            prop_assert!(!refused.error.message.is_empty());
        }
    }
}

#[test]
fn arrays_in_arrays_and_runs_without_end_are_an_answer() {
    let nested = format!("; FBX 7.4.0 project file\nA: {}", "*{a:".repeat(200_000));
    assert_eq!(fault(nested.as_bytes()).message, "A: An array lies in an array.");
    let file = surface::skinned(&[1.0]);
    let curve = format!(
        "\tAnimationStack: 10, \"AnimStack::Take\", \"\" {{\n\t}}\n\tAnimationLayer: 11, \"AnimLayer::Base\", \"\" {{\n\t}}\n\t\
         AnimationCurveNode: 12, \"AnimCurveNode::T\", \"\" {{\n\t}}\n\tAnimationCurve: 13, \"AnimCurve::\", \"\" {{\n\t\tKeyTime: *3 \
         {{\n\t\t\ta: 0,46186158000,92372316000\n\t\t}}\n\t\tKeyValueFloat: *3 {{\n\t\t\ta: 0,100,200\n\t\t}}\n\t\tKeyAttrFlags: *1 \
         {{\n\t\t\ta: 4\n\t\t}}\n\t\tKeyAttrRefCount: *1 {{\n\t\t\ta: {}\n\t\t}}\n\t}}\n\tModel: 2,",
        i64::MIN
    );
    let connections = "C: \"OO\",11,10\n\tC: \"OO\",12,11\n\tC: \"OP\",13,12,\"d|X\"\n\tC: \"OP\",12,100,\"Lcl Translation\"\n\tC: \"OO\",2,0\n";
    let file = file
        .replacen("\tModel: 2,", &curve, 1)
        .replacen("C: \"OO\",2,0\n", connections, 1);
    let model = import(file.as_bytes()).expect("it is read").model;
    let [clip] = &*model.clips else {
        panic!("{} clips", model.clips.len())
    };
    assert_eq!((clip.start_secs, clip.end_secs), (0.0, 2.0));
    let joint = model.skeleton.joint_of_bone()[0];
    assert_eq!(clip.tracks[joint.index()].translation().at(1.0).x, 1.0, "metres");
}
