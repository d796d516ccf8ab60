//! Where a finding leads.

use bindpose::diagnostic::{Moment, Subject};
use bindpose::session::{File, FileCommand, Session};
use bindpose::ui::for_tests::Goal;

#[test]
fn what_is_not_there_has_no_goal() {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![File::new(
        "figure.m3d",
        include_bytes!("../../../web/sample/figure.m3d").to_vec(),
    )]));
    let open = session.open_model().expect("the sample opens");
    let beyond = [
        Subject::Material(9_999_999),
        Subject::Subset(9_999_999),
        Subject::Vertex(9_999_999),
        Subject::Triangle(u32::MAX),
        Subject::Bone(9_999_999),
        Subject::Clip(9_999_999),
    ];
    assert!(
        beyond
            .into_iter()
            .all(|subject| Goal::of(&session, open, subject, Moment::default()).is_none())
    );
}
