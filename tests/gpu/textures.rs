//! Pictures made by hand, and a card to put them on.

use std::sync::Arc;

use bindpose::image::{Image, MapKind, decode};
use bindpose::model::{MapSlot, Mesh, Model, Submesh};
use bindpose::render::MaterialImages;
use bindpose::scene::{Projection, linear_from_srgb8};
use glam::{Vec2, Vec3};

use crate::scenes::{Scene, material};

pub(crate) const WHITE: [f32; 3] = [1.0; 3];

/// Sides of the pictures of [`square`] and [`card`].
pub(crate) const WIDTH: u32 = 160;
pub(crate) const HEIGHT: u32 = 100;

/// A square picture of colours with its mips, texel by texel.
pub(crate) fn square(side: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Arc<Image> {
    Arc::new(texels(side, texel).with_mips(MapKind::Diffuse))
}

/// The same of directions.
pub(crate) fn directions(side: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Arc<Image> {
    Arc::new(texels(side, texel).with_mips(MapKind::Normal))
}

/// The same of numbers.
pub(crate) fn numbers(side: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Arc<Image> {
    Arc::new(texels(side, texel).with_mips(MapKind::Data))
}

/// The same texel everywhere, which needs no mips.
pub(crate) fn plain(texel: [u8; 4]) -> Arc<Image> {
    Arc::new(texels(4, |_, _| texel))
}

pub(crate) fn texels(side: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let texels = (0..side * side).flat_map(|index| texel(index % side, index / side));
    Image::from_rgba8(side, side, texels.collect(), "test").expect("a small picture")
}

/// A DDS file with a four-character code or, for `DX10`, a DXGI format and alpha mode, and all its levels.
pub(crate) fn dds(code: &[u8; 4], [dxgi, alpha_mode]: [u32; 2], side: u32, blocks: &[u8]) -> Arc<Image> {
    let mut words = [0; 31];
    words[..7].copy_from_slice(&[124, 0x2_1007, side, side, 0, 0, u32::BITS - side.leading_zeros()]);
    words[18..21].copy_from_slice(&[32, 4, u32::from_le_bytes(*code)]);
    words[26] = 0x1000;
    let dx10 = [dxgi, 3, 0, 1, alpha_mode];
    let dx10: &[u32] = if code == b"DX10" { &dx10 } else { &[] };
    let mut file = b"DDS ".to_vec();
    file.extend(words.iter().chain(dx10).flat_map(|word| word.to_le_bytes()));
    file.extend(blocks);
    Arc::new(decode(&file, "test.dds").unwrap_or_else(|error| panic!("{error}")))
}

/// A cube map whose faces have one colour each, +x −x +y −y +z −z.
pub(crate) fn cube(side: u32, faces: [[u8; 3]; 6]) -> Image {
    let mut words = [0; 31];
    words[..4].copy_from_slice(&[124, 0x1007, side, side]);
    words[18..26].copy_from_slice(&[32, 0x41, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000]);
    // Complex; a cube with all of its faces.
    words[26..28].copy_from_slice(&[0x1008, 0xfe00]);
    let mut file = b"DDS ".to_vec();
    file.extend(words.iter().flat_map(|word: &u32| word.to_le_bytes()));
    for [red, green, blue] in faces {
        file.extend([red, green, blue, 255].repeat((side * side) as usize));
    }
    decode(&file, "cube.dds").unwrap_or_else(|error| panic!("{error}"))
}

/// An sRGB colour as a material's diffuse colour.
pub(crate) fn linear(srgb: [u8; 3]) -> [f32; 3] {
    srgb.map(linear_from_srgb8)
}

/// An upright square of one colour, 2 wide, on y = 0, that faces -z; u goes right and v goes down over `tex_coords`, from
/// its top left to its bottom right. Seen straight from its front in parallel projection.
pub(crate) fn card(diffuse: [f32; 3], tex_coords: [Vec2; 2]) -> Scene {
    let [first, last] = tex_coords;
    let mesh = Mesh {
        positions: [(-1.0, 0.0), (-1.0, 2.0), (1.0, 2.0), (1.0, 0.0)]
            .map(|(x, y)| Vec3::new(x, y, 0.0))
            .to_vec(),
        normals: vec![Vec3::NEG_Z; 4],
        tangents: vec![Vec3::X.extend(1.0); 4],
        tex_coords: vec![Vec2::new(first.x, last.y), first, Vec2::new(last.x, first.y), last],
        indices: vec![0, 1, 2, 0, 2, 3],
        submeshes: vec![Submesh {
            triangle_start: 0,
            triangle_count: 2,
            material: 0,
        }],
        ..Mesh::default()
    };
    let model = Model {
        materials: vec![material("card", diffuse)],
        mesh,
        ..Model::default()
    };
    let mut scene = Scene::of(model);
    scene.camera.projection = Projection::Orthographic;
    scene
}

/// [`card`] with a map once across it.
pub(crate) fn card_once() -> Scene {
    card(WHITE, [Vec2::ZERO, Vec2::ONE])
}

pub(crate) fn diffuse(image: &Arc<Image>) -> [MaterialImages<'_>; 1] {
    [images([(MapSlot::Diffuse, image)])]
}

pub(crate) fn normal(image: &Arc<Image>) -> [MaterialImages<'_>; 1] {
    [images([(MapSlot::Normal, image)])]
}

/// The images of a material that has these maps alone.
pub(crate) fn images<'a>(maps: impl IntoIterator<Item = (MapSlot, &'a Arc<Image>)>) -> MaterialImages<'a> {
    let mut images = MaterialImages::default();
    for (slot, image) in maps {
        images[slot as usize] = Some(image);
    }
    images
}

/// Where on the card a pixel's middle lies, 0 … 1 from its top left; `None` off the card and at its very edge.
pub(crate) fn on_card(scene: &Scene, x: u32, y: u32) -> Option<Vec2> {
    let per_pixel = scene.camera.height_in_view() / HEIGHT as f32;
    let from_middle = Vec2::new(
        x as f32 + 0.5 - WIDTH as f32 / 2.0,
        y as f32 + 0.5 - HEIGHT as f32 / 2.0,
    ) * per_pixel;
    let place = (from_middle + 1.0) / 2.0;
    let inside = 0.03..0.97;
    (inside.contains(&place.x) && inside.contains(&place.y)).then_some(place)
}

/// Every pixel of the card, with its place.
pub(crate) fn pixels_of_card(scene: &Scene) -> impl Iterator<Item = (u32, u32, Vec2)> {
    (0..WIDTH * HEIGHT).filter_map(move |index| {
        let (x, y) = (index % WIDTH, index / WIDTH);
        on_card(scene, x, y).map(|place| (x, y, place))
    })
}
