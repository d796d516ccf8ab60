//! FBX with pictures beside it.

use std::fs;

use bindpose::image::encode_png;
use serde_json::json;

use crate::program::{run, scratch_folder};

/// A triangle whose colour is a picture.
const CARD: &str = "; FBX 7.4.0 project file
Objects:  {
\tGeometry: 1, \"Geometry::\", \"Mesh\" {
\t\tVertices: *9 {
\t\t\ta: 0,0,0,1,0,0,1,1,0
\t\t}
\t\tPolygonVertexIndex: *3 {
\t\t\ta: 0,1,-3
\t\t}
\t}
\tModel: 2, \"Model::Card\", \"Mesh\" {
\t}
\tMaterial: 3, \"Material::Paint\", \"\" {
\t}
\tTexture: 4, \"Texture::\", \"\" {
\t\tRelativeFilename: \"PATH\"
\t}
}
Connections:  {
\tC: \"OO\",1,2
\tC: \"OO\",2,0
\tC: \"OO\",3,2
\tC: \"OP\",4,3,\"DiffuseColor\"
}
";

/// Programs unpack what lies in NAME.fbx into NAME.fbm, and the path in the file is often one of another machine.
#[test]
fn pictures_are_found_beside_the_file_and_in_its_folder_of_pictures() {
    let png = encode_png(&[10, 20, 30, 255], 1, 1).expect("one pixel");
    for (at, (path, place)) in [
        ("skin.png", "skin.png"),
        ("card.fbm\\skin.png", "card.fbm/skin.png"),
        ("C:\\work\\other.fbm\\skin.png", "card.fbm/skin.png"),
        ("maps\\skin.png", "card.fbm/skin.png"),
    ]
    .into_iter()
    .enumerate()
    {
        let folder = scratch_folder(&format!("fbm_{at}"));
        let file = folder.join("card.fbx");
        fs::write(&file, CARD.replace("PATH", path)).expect("can be written");
        let state = || {
            let found = run(["info", "--json", file.to_str().expect("UTF-8")]).json();
            assert_eq!(found["maps"][0]["name"], "skin.png");
            found["maps"][0]["state"].clone()
        };
        assert_eq!(state(), json!("missing"), "{path}");
        fs::create_dir_all(folder.join("card.fbm")).expect("can be made");
        fs::write(folder.join(place), &png).expect("can be written");
        assert_eq!(state(), json!("found"), "{path}");
    }
}
