//! Maps: the committed pictures, their channels, and that they repeat.

use std::sync::LazyLock;

use bindpose::image;
use bindpose::sample::SampleMap;

use super::FIGURE;

static MAPS: LazyLock<Vec<SampleMap>> = LazyLock::new(bindpose::sample::maps);

fn path(name: &str) -> String {
    format!("{}/web/sample/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_committed_maps_are_reproduced() {
    let mut download = 0;
    for map in &*MAPS {
        let path = path(map.name);
        if std::env::var_os("BLESS").is_some() {
            let png = image::encode_png(&map.rgba, map.side, map.side).expect("a square of texels");
            std::fs::write(&path, png).expect("web/sample can be written");
        }
        let committed = std::fs::read(&path).expect("BLESS=1 writes the file that is missing");
        download += committed.len();
        // Texels, not bytes: another encoder may pack them otherwise.
        let picture = image::decode(&committed, map.name).expect("the project's own file is well formed");
        assert_eq!((picture.width(), picture.height()), (map.side, map.side), "{}", map.name);
        assert!(
            picture.to_rgba8(0, 0).as_deref() == Some(map.rgba.as_slice()),
            "{path} is not what the generator makes: BLESS=1 writes it anew"
        );
    }
    assert!(download < 700_000, "{download} bytes of maps");
}
