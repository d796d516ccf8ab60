//! Times, frames and speeds as people type them.

use bindpose::anim::LocalJoint;
use bindpose::model::{Clip, Track};
use bindpose::ui::for_tests::{Unit, number_and_unit, speed, time};

#[test]
fn times_and_frames_are_read_as_people_write_them() {
    for (typed, in_secs, in_frames) in [
        ("0.33", Some((0.33, Unit::Secs)), Some((0.33, Unit::Frames))),
        (" 1,25 s", Some((1.25, Unit::Secs)), Some((1.25, Unit::Secs))),
        ("0.5 seconds", Some((0.5, Unit::Secs)), Some((0.5, Unit::Secs))),
        ("f20", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
        ("20 f", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
        ("Frame 20", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
        ("31 / 75", Some((31.0, Unit::Secs)), Some((31.0, Unit::Frames))),
        ("31 of 75", Some((31.0, Unit::Secs)), Some((31.0, Unit::Frames))),
        ("−2", Some((-2.0, Unit::Secs)), Some((-2.0, Unit::Frames))),
        (".5", Some((0.5, Unit::Secs)), Some((0.5, Unit::Frames))),
        ("", None, None),
        ("soon", None, None),
        ("f", None, None),
        ("20 x", None, None),
        ("f20 s", None, None),
        ("1.2.3", None, None),
    ] {
        assert_eq!(number_and_unit(typed, Unit::Secs), in_secs, "{typed:?}");
        assert_eq!(number_and_unit(typed, Unit::Frames), in_frames, "{typed:?}");
    }
}

#[test]
fn what_is_outside_of_the_clip_is_refused_with_its_end() {
    let keys = (0..=15).map(|frame| (0.75 + frame as f32 / 30.0, LocalJoint::IDENTITY));
    let clip = Clip::new("clip", vec![Track::new(keys).expect("keys in order")]);
    let read = |typed| time(typed, &clip, Unit::Secs);
    assert_eq!(read("1.25"), Ok(1.25));
    assert_eq!(read("1.2504"), Ok(1.25), "it is shown so");
    assert_eq!(read("f15"), Ok(1.25));
    assert_eq!(read("1.3"), Err("Beyond the clip's end, 1.25 s".to_owned()));
    assert_eq!(read("0"), Err("Before the clip's start, 0.75 s".to_owned()));
    assert_eq!(read("16 f"), Err("Beyond the last frame, 15".to_owned()));
    assert_eq!(read("f-1"), Err("Before the first frame, 0".to_owned()));
    assert_eq!(read("soon"), Err("Type seconds, 0.33 s, or a frame, f20".to_owned()));
}

#[test]
fn speeds_are_read_within_their_bounds() {
    assert_eq!(speed("0.5×"), Ok(0.5));
    for typed in ["0", "-1", "5", "fast"] {
        assert_eq!(speed(typed), Err("A number from 0.05 to 4".to_owned()), "{typed}");
    }
}
