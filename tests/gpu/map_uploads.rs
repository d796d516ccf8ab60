//! Which maps go up when: counted, not timed.

use std::sync::Arc;

use bindpose::image::Image;
use bindpose::model::{MapSlot, Submesh};
use bindpose::render::MaterialImages;

use crate::scenes::{Scene, material};
use crate::textures::{HEIGHT, WIDTH, card_once, diffuse, images, plain};

/// The card with a material for each of its two triangles.
fn halves() -> Scene {
    let mut scene = card_once();
    scene.model.materials.push(material("other half", [1.0; 3]));
    scene.model.mesh.submeshes = [(0, 0), (1, 1)]
        .map(|(triangle_start, material)| Submesh {
            triangle_start,
            triangle_count: 1,
            material,
        })
        .to_vec();
    scene
}

fn of(diffuse: Option<&Arc<Image>>) -> MaterialImages<'_> {
    images(diffuse.map(|image| (MapSlot::Diffuse, image)))
}

on_both_backends! {
    fn one_new_map_goes_up_alone_and_the_others_stay(gpu) {
        let scene = halves();
        let [red, green, blue] = [[200, 20, 20, 255], [20, 200, 20, 255], [20, 20, 200, 255]].map(plain);
        let maps = |first, second| [of(first), of(second)];
        let mut renderer = gpu.renderer();
        let mut target = gpu.target(WIDTH, HEIGHT);
        renderer.set_model(&scene.model).expect("small");
        assert_eq!(renderer.set_maps(&maps(Some(&red), Some(&red))), 1, "once for both materials");
        assert_eq!(renderer.set_maps(&maps(Some(&red), Some(&green))), 1, "the new one");
        assert_eq!(renderer.set_maps(&maps(Some(&green), Some(&red))), 0, "exchanged");
        renderer.set_model(&scene.model).expect("small");
        assert_eq!(renderer.set_maps(&maps(Some(&green), Some(&red))), 0, "the model came again");
        assert_eq!(renderer.set_maps(&maps(Some(&green), Some(&blue))), 1, "another in place of the red one");
        renderer.render(&scene.frame(), &mut target);
        let expected = gpu.draw_with_maps(&scene, &maps(Some(&green), Some(&blue)), WIDTH, HEIGHT);
        assert_eq!(gpu.read(&target), expected);

        assert_eq!(renderer.set_maps(&maps(Some(&red), None)), 1, "what was given up goes up again");
        let as_both = [images([(MapSlot::Diffuse, &red), (MapSlot::Normal, &red)])];
        assert_eq!(renderer.set_maps(&as_both), 1, "read in another way it is another texture");
        renderer.clear_model();
        assert_eq!(renderer.set_maps(&as_both), 0, "no model");
    }

    /// A picture that is dropped leaves its address to the next one, which must not pass for it.
    fn a_picture_at_the_address_of_another_one_is_not_taken_for_it(gpu) {
        let scene = card_once();
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        for grey in 0..20 {
            let image = plain([grey * 10, 0, 0, 255]);
            assert_eq!(Arc::strong_count(&image), 1);
            let maps = diffuse(&image);
            assert_eq!(renderer.set_maps(&maps), 1);
        }
    }
}
