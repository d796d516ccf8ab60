//! Which of many a ray meets first, and where a map is clear.

use bindpose::image::Image;
use bindpose::model::Wrap;
use bindpose::scene::Hit;
use bindpose::session::for_tests::{Alpha, first_met};
use glam::{Vec2, Vec3};

#[test]
fn of_a_thousand_instances_only_the_nearest_are_looked_at() {
    let hit = |distance: f32| Hit {
        submesh: 0,
        triangle: 0,
        barycentric: Vec3::X,
        vertex: 0,
        position: Vec3::ZERO,
        distance,
    };
    // Boxes a unit apart and two deep. The ray slips past the first two figures, and meets every other in the middle of its box.
    let boxes = || {
        (0..1_000)
            .rev()
            .map(|instance| (instance as f32, instance))
            .collect::<Vec<_>>()
    };
    let mut asked = Vec::new();
    let first = first_met(&mut boxes(), |instance| {
        asked.push(instance);
        (instance >= 2).then(|| hit(instance as f32 + 1.0))
    });
    assert_eq!(first.map(|(instance, hit)| (instance, hit.distance)), Some((2, 3.0)));
    assert_eq!(asked, [0, 1, 2, 3], "the fourth box begins where the hit is");
    // A hit far in its box is not the first.
    let first = first_met(&mut boxes(), |instance| {
        Some(hit(if instance == 0 { 1.9 } else { instance as f32 + 0.1 }))
    });
    assert_eq!(first.map(|(instance, _)| instance), Some(1));
    assert_eq!(first_met(&mut boxes(), |_| None), None);
    assert_eq!(first_met(&mut [], |_| Some(hit(1.0))), None);
}

#[test]
fn alpha_is_that_of_the_texel_and_goes_on_as_its_map_says() {
    let rgba = [0, 64, 128, 255].map(|alpha| [9, 9, 9, alpha]).concat();
    let image = Image::from_rgba8(2, 2, rgba, "by hand").expect("two by two");
    let alpha = Alpha::of(&image).expect("it has alpha");
    use Wrap::{Clamp, Mirror, Repeat};
    for (x, y, wrap, value) in [
        (0.25, 0.25, Repeat, 0),
        (0.75, 0.25, Repeat, 64),
        (-0.75, 3.75, Repeat, 128),
        (0.999, -0.001, Repeat, 255),
        (f32::NAN, f32::INFINITY, Repeat, 0),
        (-0.75, 1.25, Mirror, 255),
        (1.75, 2.25, Mirror, 0),
        (-9.0, 9.0, Clamp, 128),
        (9.0, f32::NAN, Clamp, 64),
    ] {
        assert_eq!(
            alpha.nearest(Vec2::new(x, y), [wrap; 2]),
            f32::from(value as u8) / 255.0,
            "{x} {y} {wrap:?}"
        );
    }
}
