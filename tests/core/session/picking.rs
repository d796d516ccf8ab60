//! What is under the pointer, against unprojecting and a textbook test of every triangle in f64.

use bindpose::anim;
use bindpose::image::encode_png;
use bindpose::model::Mesh;
use bindpose::scene::{Hit, ViewPreset};
use bindpose::session::{CameraCommand, File, MaterialCommand, PlayCommand, Session, SubmeshCommand};
use glam::{DVec3, Vec2, Vec3};

use super::models::{self, document, moving};
use super::submeshes::parted;
use super::{dropped, on_screen, opened, viewport};
use crate::documents::soldier_bytes;

/// The vertices of now, world space.
fn posed(session: &mut Session) -> Vec<Vec3> {
    let frame = session.frame();
    let (world_from_model, palette) = (frame.world_from_model, frame.palette.clone());
    let mesh = &session.open_model().expect("open").model.mesh;
    let mut positions = Vec::new();
    anim::skin_positions(mesh, &palette, &mut positions);
    positions
        .into_iter()
        .map(|p| world_from_model.transform_point3(p))
        .collect()
}

/// Both ends of what the picture shows at a point, world space.
fn unprojected(session: &mut Session, aspect: f32, point: Vec2) -> [DVec3; 2] {
    let frame = session.frame();
    let clip_from_view = frame.camera.clip_from_view(aspect, &frame.world_bounds).as_dmat4();
    let world_from_clip = (clip_from_view * frame.camera.view_from_world().as_dmat4()).inverse();
    [0.0, 1.0].map(|depth| world_from_clip.project_point3(point.as_dvec2().extend(depth)))
}

/// Möller and Trumbore's test: share of the way, where the segment meets the triangle.
fn textbook_meet([start, end]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (way, ab, ac) = (end - start, b - a, c - a);
    let across = way.cross(ac);
    let determinant = ab.dot(across);
    let from_a = start - a;
    let u = from_a.dot(across) / determinant;
    let v = way.dot(from_a.cross(ab)) / determinant;
    let share = ac.dot(from_a.cross(ab)) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&share)).then_some(share)
}

fn textbook_pick(mesh: &Mesh, world: &[Vec3], segment: [DVec3; 2]) -> Option<DVec3> {
    let triangles = mesh.indices.as_chunks::<3>().0.iter();
    let shares = triangles.filter_map(|corners| {
        let corners = corners.map(|corner| world[corner as usize].as_dvec3());
        textbook_meet(segment, corners)
    });
    let nearest = shares.min_by(f64::total_cmp)?;
    Some(segment[0].lerp(segment[1], nearest))
}

/// A net of points over the picture, off its lines of symmetry.
fn points(steps: u32) -> impl Iterator<Item = Vec2> {
    let coordinate = move |step: u32| (step as f32 + 0.437) / steps as f32 * 2.0 - 1.0;
    (0..steps).flat_map(move |row| (0..steps).map(move |column| Vec2::new(coordinate(column), coordinate(row))))
}

/// Picks over the whole picture; how many met the model.
fn check_picks(session: &mut Session, aspect: f32, steps: u32, tolerance: f32) -> usize {
    let world = posed(session);
    let mut met = 0;
    for point in points(steps) {
        let segment = unprojected(session, aspect, point);
        let hit = session.pick(point);
        let mesh = &session.open_model().expect("open").model.mesh;
        let expected = textbook_pick(mesh, &world, segment);
        match (hit, expected) {
            (Some(hit), Some(expected)) => {
                met += 1;
                let off = hit.position.as_dvec3().distance(expected);
                assert!(off < f64::from(tolerance), "{point}: {hit:?} is {off} from {expected}");
                check_hit(mesh, &world, &hit, tolerance);
            }
            (None, None) => {}
            // On an outline the two may round to either side: then the outline is as near as rounding.
            (hit, expected) => assert!(
                is_at_outline(mesh, &world, segment, tolerance),
                "{point}: {hit:?} and {expected:?}"
            ),
        }
    }
    met
}

fn is_at_outline(mesh: &Mesh, world: &[Vec3], [start, end]: [DVec3; 2], tolerance: f32) -> bool {
    let way = (end - start).normalize();
    mesh.indices.as_chunks::<3>().0.iter().any(|corners| {
        let [a, b, c] = corners.map(|corner| world[corner as usize].as_dvec3());
        [(a, b), (b, c), (c, a)].into_iter().any(|(from, to)| {
            let across = way.cross(to - from).normalize_or_zero();
            (from - start).dot(across).abs() < f64::from(tolerance)
        })
    })
}

/// The parts of a hit belong together.
fn check_hit(mesh: &Mesh, world: &[Vec3], hit: &Hit, tolerance: f32) {
    let submesh = &mesh.submeshes[hit.submesh];
    let range = submesh.triangle_start as usize..(submesh.triangle_start + submesh.triangle_count) as usize;
    assert!(range.contains(&hit.triangle), "{hit:?}");
    let corners = mesh.indices.as_chunks::<3>().0[hit.triangle];
    let mixed: Vec3 = corners
        .iter()
        .zip(hit.barycentric.to_array())
        .map(|(&corner, share)| world[corner as usize] * share)
        .sum();
    assert!(mixed.distance(hit.position) < tolerance, "{mixed} {hit:?}");
    assert!(hit.barycentric.min_element() >= 0.0 && (hit.barycentric.element_sum() - 1.0).abs() < 1e-5);
    let from_hit = |corner: u32| world[corner as usize].distance(hit.position);
    assert!(corners.contains(&hit.vertex));
    assert!(
        corners
            .iter()
            .all(|&corner| from_hit(hit.vertex) <= from_hit(corner) + tolerance)
    );
}

#[test]
fn the_first_triangle_of_the_pose_on_show_is_met_from_every_side() {
    for toggled in [false, true] {
        let mut session = opened(moving("a.m3d"));
        let aspect = 1.6;
        session.apply(viewport(aspect));
        if toggled {
            session.apply(CameraCommand::ToggleProjection);
        }
        for (time_secs, preset) in
            [0.0, 0.26, 0.7]
                .into_iter()
                .zip([ViewPreset::ThreeQuarter, ViewPreset::Back, ViewPreset::Isometric])
        {
            session.apply(PlayCommand::Seek { time_secs });
            session.apply(CameraCommand::LookFrom(preset));
            let met = check_picks(&mut session, aspect, 24, 1e-4);
            assert!(met > 20, "{preset:?}: {met}");
        }
    }
}

#[test]
fn a_corner_that_is_seen_is_met_where_it_is_drawn() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Seek { time_secs: 0.26 });
    let world = posed(&mut session);
    let mesh = session.open_model().expect("open").model.mesh.clone();
    let mut seen = 0;
    for corners in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = corners.map(|corner| world[corner as usize]);
        // Just inside the first corner.
        let point = a * 0.98 + b * 0.01 + c * 0.01;
        let pointer = on_screen(&mut session, point);
        let hit = session.pick(pointer).expect("it is drawn there");
        if hit.position.distance(point) < 1e-3 {
            assert_eq!(hit.vertex, corners[0]);
            seen += 1;
        }
    }
    assert!((4..12).contains(&seen), "three sides face the eye, or so: {seen}");
}

#[test]
fn no_ray_slips_through_the_edges_between_triangles() {
    let mut session = opened(models::still("a.m3d"));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    // Along the edge that divides the front, in steps of no round number.
    let [from, to] =
        [Vec3::new(-0.5, 0.0, -1.0), Vec3::new(1.5, 4.0, -1.0)].map(|corner| on_screen(&mut session, corner));
    for step in 1..2000 {
        let point = from.lerp(to, step as f32 / 2000.0);
        let hit = session.pick(point).expect("the front is closed");
        assert!((hit.position.z + 1.0).abs() < 1e-4, "{point} falls through to {hit:?}");
    }
}

#[test]
fn what_is_hidden_is_looked_through() {
    let mut session = opened(models::file("a.m3d", &parted(document())));
    session.apply(CameraCommand::LookFrom(ViewPreset::Front));
    let front = session.pick(Vec2::ZERO).expect("the front");
    assert_eq!(front.submesh, 2);
    assert!((front.position.z + 1.0).abs() < 1e-4);
    let visible = false;
    session.apply(SubmeshCommand::SetVisible { submesh: 2, visible });
    assert_eq!(session.pick(Vec2::ZERO), None, "front and back are one subset");
}

#[test]
fn what_alpha_cuts_is_looked_through_only_where_the_material_cuts() {
    // The upper half of the map is cut away, the lower half just not.
    let alphas = [25, 25, 26, 26];
    let pixels = alphas.map(|alpha| [200, 10, 10, alpha]).concat();
    let map = File::new("leaf.png", encode_png(&pixels, 2, 2).expect("two by two"));
    for alpha_clip in [true, false] {
        let mut document = document();
        document.materials[0].alpha_clip = alpha_clip;
        document.materials[0].diffuse_map = Some("leaf.dds".to_owned());
        let mut session = dropped(vec![models::file("a.m3d", &document), map.clone()]);
        session.apply(CameraCommand::LookFrom(ViewPreset::Front));
        // On the front, z = −1, u runs along x and v along y: v > 0.5 is the upper part, and the lower rows of the map.
        let world = |session: &mut Session, y: f32| {
            let point = Vec3::new(0.5, y, -1.0);
            let point = on_screen(session, point);
            session.pick(point).map(|hit| (hit.position.z + 1.0).abs() < 1e-3)
        };
        assert_eq!(world(&mut session, 3.0), Some(true), "kept");
        let below = world(&mut session, 1.0);
        assert_eq!(below == Some(true), !alpha_clip, "{below:?}");

        let material = Box::new(bindpose::model::Material {
            alpha: bindpose::model::AlphaMode::clipped(true),
            ..session.materials()[0].clone()
        });
        session.apply(MaterialCommand::Edit { index: 0, material });
        assert_ne!(world(&mut session, 1.0), Some(true), "edited to be cut");
    }
}

#[test]
fn with_nothing_open_or_no_place_nothing_is_met() {
    assert_eq!(Session::new(false).pick(Vec2::ZERO), None);
    let mut session = opened(models::still("a.m3d"));
    for point in [Vec2::NAN, Vec2::new(f32::INFINITY, 0.0), Vec2::splat(1e30)] {
        assert_eq!(session.pick(point), None);
    }
}

#[test]
fn the_running_soldier_is_met_where_it_is_drawn() {
    let Some(bytes) = soldier_bytes() else { return };
    let mut session = opened(File::new("soldier.m3d", bytes));
    session.apply(PlayCommand::Seek { time_secs: 0.517 });
    let met = check_picks(&mut session, 1.0, 9, 2e-3);
    assert!(met > 10, "{met}");
}
