//! Colours of skins and their legends.

use bindpose::anim::SkinView;
use bindpose::import::m3d;
use bindpose::model::{JointIndex, Skeleton};
use bindpose::scene::{colors_of_counts, colors_of_joints, colors_of_values, joint_colors, legend, linear_from_srgb8};
use glam::{Affine3A, Vec3};

use crate::chains::mirrored_model;
use crate::documents::real_file;

#[test]
fn a_legends_stops_have_their_colours_and_lie_in_order() {
    let mut colors = Vec::new();
    for view in SkinView::ALL {
        let stops = legend(view);
        assert!(stops.is_sorted_by(|a, b| a.value < b.value), "{view:?}");
        let values: Vec<f32> = stops.iter().map(|stop| stop.value).collect();
        colors_of_values(stops, &values, &mut colors);
        let of_stops: Vec<_> = stops.iter().map(|stop| stop.color_srgb).collect();
        assert_eq!(colors, of_stops, "{view:?}");
    }
    assert!(legend(SkinView::DominantJoint).is_empty() && !legend(SkinView::Stretch).is_empty());
}

#[test]
fn between_stops_colours_are_mixed_and_beyond_them_held() {
    let stops = legend(SkinView::Weight);
    let (first, last) = (stops[0].color_srgb, stops[stops.len() - 1].color_srgb);
    let mut colors = Vec::new();
    colors_of_values(
        stops,
        &[-1.0, f32::NEG_INFINITY, f32::NAN, 2.0, f32::INFINITY],
        &mut colors,
    );
    assert_eq!(colors, [first, first, first, last, last]);
    let middle = (stops[0].value + stops[1].value) * 0.5;
    colors_of_values(stops, &[middle], &mut colors);
    for channel in 0..4 {
        let mean = (f32::from(first[channel]) + f32::from(stops[1].color_srgb[channel])) * 0.5;
        assert!((f32::from(colors[0][channel]) - mean).abs() <= 1.0);
    }
    colors_of_values(&[], &[0.5], &mut colors);
    assert_eq!(colors.len(), 1);
}

#[test]
fn counts_have_the_colours_of_their_legend() {
    let mut colors = Vec::new();
    colors_of_counts(&[0, 1, 2, 3, 4, 9], &mut colors);
    let mut expected: Vec<_> = legend(SkinView::InfluenceCount)
        .iter()
        .map(|stop| stop.color_srgb)
        .collect();
    expected.push(expected[4]);
    assert_eq!(colors, expected);
}

/// Oklab of an sRGB colour.
fn oklab(color: [u8; 4]) -> Vec3 {
    let [r, g, b] = [color[0], color[1], color[2]].map(linear_from_srgb8);
    let l = (0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b).cbrt();
    let m = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b).cbrt();
    let s = (0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b).cbrt();
    Vec3::new(
        0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    )
}

/// Neighbours differ by several times what can just be told apart (about 0.02 in Oklab).
fn check_neighbours(skeleton: &Skeleton) {
    let colors = joint_colors(skeleton);
    assert_eq!(colors.len(), skeleton.joint_count());
    let parents = skeleton.parents();
    for (joint, parent) in parents.iter().enumerate() {
        let siblings = (0..joint).rev().filter(|&other| parents[other] == *parent).take(2);
        let neighbours = siblings.chain(parent.map(JointIndex::index));
        for neighbour in neighbours {
            let apart = oklab(colors[joint]).distance(oklab(colors[neighbour]));
            assert!(apart > 0.07, "joints {joint} and {neighbour}: {apart}");
        }
    }
}

#[test]
fn neighbouring_joints_are_clearly_different() {
    for count in [1, 2, 300, 2_000] {
        check_neighbours(&mirrored_model(count).skeleton);
    }
    // A star, a chain and no tree at all.
    for parent in [
        |_: u32| Some(JointIndex(0)),
        |joint| Some(JointIndex(joint - 1)),
        |_| None,
    ] {
        let parents = (0..500)
            .map(|joint| if joint == 0 { None } else { parent(joint) })
            .collect();
        let skeleton = Skeleton::new(parents, vec![Affine3A::IDENTITY; 500], (0..500).collect()).expect("sound");
        check_neighbours(&skeleton);
    }
    if let Some(parsed) = real_file("d3d12/soldier") {
        check_neighbours(&m3d::from_parsed(&parsed).expect("sound").0.skeleton);
    }
}

#[test]
fn vertices_have_the_colour_of_their_joint_or_grey() {
    let of_joints = joint_colors(&mirrored_model(3).skeleton);
    let mut colors = Vec::new();
    colors_of_joints(
        &[Some(JointIndex(2)), None, Some(JointIndex(3))],
        &of_joints,
        &mut colors,
    );
    assert_eq!(colors[0], of_joints[2]);
    assert_eq!(colors[1], colors[2], "none, and one that is not there");
    assert!(!of_joints.contains(&colors[1]));
}
