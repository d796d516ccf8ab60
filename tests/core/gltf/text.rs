//! Addresses, and places in the text.

use bindpose::gltf::{Uri, UriError, position_of};

#[test]
fn base64_is_read_with_and_without_padding() {
    for (text, bytes) in [
        ("", ""),
        ("TQ==", "M"),
        ("TQ", "M"),
        ("TWE=", "Ma"),
        ("TWFu", "Man"),
        ("TWFuTQ==", "ManM"),
    ] {
        let uri = format!("data:;base64,{text}");
        let bytes = bytes.as_bytes().to_vec();
        assert_eq!(Uri::parse(&uri), Ok(Uri::Data { media_type: "", bytes }), "{text}");
    }
    for wrong in ["T", "TQ=", "T===", "TW$u", "TWFu=", "TQ==TQ=="] {
        assert_eq!(
            Uri::parse(&format!("data:;base64,{wrong}")),
            Err(UriError::NotBase64),
            "{wrong}"
        );
    }
}

#[test]
fn paths_are_percent_decoded_and_stay_beside_the_file() {
    assert_eq!(Uri::parse("a%20b/c.bin"), Ok(Uri::Path("a b/c.bin".to_owned())));
    assert_eq!(Uri::parse("../t\\a.png"), Ok(Uri::Path("../t/a.png".to_owned())));
    for elsewhere in ["http://a/b", "/etc/passwd", "C:\\a", "%2fetc", "", "file:a"] {
        assert_eq!(Uri::parse(elsewhere), Err(UriError::NotRelative), "{elsewhere}");
    }
    assert_eq!(Uri::parse("a%2"), Err(UriError::NotPercentEncoded));
    assert_eq!(Uri::parse("a%ff"), Err(UriError::NotPercentEncoded));
}

#[test]
fn data_is_read_in_place() {
    let data = |media_type, bytes: &[u8]| {
        Ok(Uri::Data {
            media_type,
            bytes: bytes.to_vec(),
        })
    };
    assert_eq!(Uri::parse("data:image/png;base64,TWFu"), data("image/png", b"Man"));
    assert_eq!(Uri::parse("DATA:,a%20b"), data("", b"a b"));
    assert_eq!(Uri::parse("data:;base64"), Err(UriError::NoData));
    assert_eq!(Uri::parse("data:;base64,{}"), Err(UriError::NotBase64));
}

#[test]
fn pointers_lead_to_lines_and_columns() {
    let json = b"{ \"a\": [1, {\"b~/\\u0063\": \"x,]}\\\"\"},\n  [[], {}, -1.5e3]],\n\t\"d\" : true }";
    let at = |pointer| position_of(json, pointer).map(|at| (at.line, at.column));
    assert_eq!(at(""), Some((1, 1)));
    assert_eq!(at("/a"), Some((1, 8)));
    assert_eq!(at("/a/1/b~0~1c"), Some((1, 26)));
    assert_eq!(at("/a/2/2"), Some((2, 12)));
    assert_eq!(at("/d"), Some((3, 8)));
    // What is not there is told where it would be.
    assert_eq!(at("/a/9"), Some((1, 8)));
    assert_eq!(at("/d/e"), Some((3, 8)));
    for cut in 0..json.len() {
        let _ = position_of(&json[..cut], "/d/x");
    }
}
