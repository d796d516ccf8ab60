//! What the GPU refuses is not open: what was open before is open again.

use bindpose::diagnostic::codes;
use bindpose::image::encode_png;
use bindpose::model::MapSlot;
use bindpose::session::{Event, File, FileCommand, PlayCommand, Session};

use super::{models, opened};

fn name(session: &Session) -> Option<&str> {
    session.open_model().map(|open| open.file.base_name())
}

#[test]
fn a_model_that_is_refused_leaves_the_one_before_as_it_was() {
    let mut session = opened(models::moving("first.m3d"));
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::Seek { time_secs: 1.0 });
    session.confirm_uploads();
    let (camera, before) = (*session.camera(), session.model_revision());
    let palette = session.frame().palette.0.clone();
    session.take_events();

    session.apply(FileCommand::Add(vec![models::still("second.m3d")]));
    assert_eq!((name(&session), session.error()), (Some("second.m3d"), None));
    let refused = session.model_revision();
    session.go_back("the model is too large");
    assert_eq!(name(&session), Some("first.m3d"));
    let error = session.error().expect("shown");
    assert_eq!(
        (error.diagnostic.code, error.file_name.as_str()),
        (codes::GPU_REFUSED.name, "second.m3d")
    );
    assert_eq!(
        error.diagnostic.message,
        "This cannot be drawn here: the model is too large."
    );
    assert_eq!((session.clip_index(), session.playback().time_secs()), (Some(1), 1.0));
    assert_eq!(*session.camera(), camera);
    assert_eq!(session.frame().palette.0, palette);
    assert_eq!(session.files().models().len(), 1);
    assert!(session.model_revision() != before && session.model_revision() != refused);
    let events = session.take_events();
    assert!(events.ends_with(&[Event::Load, Event::Error]), "{events:?}");
}

#[test]
fn of_two_that_came_at_once_none_is_left_and_what_was_confirmed_stays() {
    let mut session = opened(models::moving("first.m3d"));
    session.confirm_uploads();
    session.apply(FileCommand::Add(vec![models::still("second.m3d")]));
    session.apply(FileCommand::Add(vec![models::still("third.m3d")]));
    session.go_back("no");
    assert_eq!(name(&session), Some("first.m3d"));
    // On a weaker device the one that was open may be refused too.
    session.go_back("no again");
    assert_eq!((name(&session), session.files().files().len()), (None, 0));
    assert_eq!(session.error().expect("shown").file_name, "first.m3d");
    session.apply(FileCommand::Add(vec![models::still("fourth.m3d")]));
    assert_eq!((name(&session), session.error()), (Some("fourth.m3d"), None));
}

#[test]
fn maps_that_are_refused_leave_the_maps_before() {
    let mut document = models::document();
    document.materials[0].diffuse_map = Some("a.png".to_owned());
    let mut session = opened(models::file("box.m3d", &document));
    let picture = |red| File::new("a.png", encode_png(&[red, 0, 0, 255], 1, 1).expect("one pixel"));
    let red = |session: &Session| Some(session.maps().image(0, MapSlot::Diffuse)?.to_rgba8(0, 0)?[0]);
    session.apply(FileCommand::Add(vec![picture(1)]));
    session.confirm_uploads();
    let maps = session.maps_revision();
    session.apply(FileCommand::Add(vec![picture(2)]));
    assert_eq!(red(&session), Some(2));
    session.go_back("no memory");
    assert_eq!((red(&session), name(&session)), (Some(1), Some("box.m3d")));
    assert!(session.maps_revision() > maps + 1);
}
