//! What begins like a model.

use bindpose::format::begins_like_model;

#[test]
fn beginnings_of_models_are_known_however_they_are_spelt() {
    for text in [
        "***************m3d-File-Header***************\n#Materials 1\n",
        "\u{feff}***************m3d-File-Header***************\r\n",
        "\n\n  --- M3D_FILE_HEADER ---\n",
        "#Materials 5\n#Vertices 3\n",
        "\t# materials: 5\r#Vertices 3\r",
    ] {
        assert!(begins_like_model(text.as_bytes()), "{text:?}");
    }
}

#[test]
fn other_texts_and_bytes_do_not_begin_like_one() {
    let late = format!("{}\n#Materials 1\n", " ".repeat(1 << 16));
    for text in [
        "",
        "Textures by somebody. Free to use.\n",
        "# Materials\n\nAll of them are PBR.\n",
        "---\ntitle: a page\n---\n",
        "8BPS\0\u{1}\0\0",
        &late,
    ] {
        assert!(!begins_like_model(text.as_bytes()), "{text:?}");
    }
}
