//! The list of findings: a click goes to what a finding is about, and opens its lines.

use bindpose::diagnostic::{Subject, codes};
use bindpose::format::{Document, Subset};
use bindpose::model::JointIndex;
use bindpose::session::{ExportFormat, File, FileCommand, JointCommand, PlayCommand, SubmeshCommand};
use bindpose::ui::{Request, report_name};
use egui::accesskit::Action;
use egui::{CursorIcon, Key, Modifiers};

use crate::joint_numbers::copied_by;
use crate::joint_tree::type_text;
use crate::models;
use crate::page::{WIDE, Window, phone, touch_window, window};
use crate::skeleton::selected;

/// A finding about each kind of part: a material that two subsets could mean, a subset of too many triangles, a vertex whose
/// weights are half of what they should be, a bone whose offset is not affine, a clip without keys of a bone; and a triangle
/// that is in no subset.
fn faulty() -> Document {
    let mut document = models::skinned(&models::CLIPS);
    document.materials.push(document.materials[0].clone());
    let faces = document.triangles.len() as u32;
    let whole = document.subsets[0];
    let first = Subset { face_count: 5, ..whole };
    let second = Subset {
        id: 1,
        face_start: 6,
        face_count: faces,
        ..whole
    };
    document.subsets = vec![first, second];
    document.vertices[5].blend_weights = [0.25, 0.25, 0.0, 0.0];
    document.bone_offsets[1][3] = 0.5;
    document.clips[2].bones[1].keyframes.clear();
    // That the lower bone keeps still is no finding with one key.
    document
        .clips
        .iter_mut()
        .for_each(|clip| clip.bones[0].keyframes.truncate(1));
    document
}

const OF_MATERIAL: &str = "note duplicate-material-name: ";
const OF_SUBSET: &str = "warning subset-out-of-range: ";
const OF_VERTEX: &str = "warning weights-not-normalized: ";
const OF_BONE: &str = "warning offset-not-affine: ";
const OF_CLIP: &str = "warning track-empty: ";
const OF_TRIANGLE: &str = "warning triangles-undrawn: ";

pub(crate) fn files() -> Vec<File> {
    vec![models::file("faulty.m3d", &faulty())]
}

/// A wide window with the findings open.
fn opened() -> Window {
    let mut window = window(WIDE, files());
    window.click("Findings: ");
    window
}

/// Whether a finding whose row begins so is listed.
fn lists(window: &Window, row: &str) -> bool {
    !window.named(|name| name.starts_with(row)).is_empty()
}

/// Whether lines of the file are shown.
fn shows_lines(window: &Window) -> bool {
    !window
        .named(|name| name.contains(" | ") && name.contains('^'))
        .is_empty()
}

#[test]
fn the_file_has_a_finding_of_each_kind() {
    let window = opened();
    let subject_of = |start: &str| {
        let code = start.split([' ', ':']).nth(1).expect("severity and code");
        let mut notices = window.session().diagnostics().filter(|notice| notice.code == code);
        notices.next().expect("it is found").subject
    };
    assert_eq!(subject_of(OF_MATERIAL), Some(Subject::Material(1)));
    assert_eq!(subject_of(OF_SUBSET), Some(Subject::Subset(1)));
    assert_eq!(subject_of(OF_VERTEX), Some(Subject::Vertex(5)));
    assert_eq!(subject_of(OF_BONE), Some(Subject::Bone(1)));
    assert_eq!(subject_of(OF_CLIP), Some(Subject::Clip(2)));
    assert_eq!(subject_of(OF_TRIANGLE), Some(Subject::Triangle(5)));
}

#[test]
fn a_finding_about_a_bone_leads_to_the_bone_in_view_tree_and_inspector() {
    let mut window = opened();
    // Its row is folded away, and another part is selected.
    window.apply(JointCommand::SetAllFolded(true));
    window.apply(JointCommand::SelectVertex(Some(0)));
    let before = *window.session().camera();
    window.click(OF_BONE);
    let joints = window.session().joints();
    assert_eq!(
        (joints.selected(), joints.selected_vertex()),
        (Some(JointIndex(1)), None)
    );
    assert!(window.session().look().bones_visible, "as the tree is open");
    assert!(window.shows("Selected: Bone 1") && window.shows("Search bones"));
    assert!(
        !window.named(|name| name.starts_with("Bone 1, ")).is_empty(),
        "its row is in view"
    );
    assert!(window.session().camera().distance < before.distance, "it is framed");
    assert!(shows_lines(&window));
}

#[test]
fn a_finding_about_a_vertex_leads_to_the_vertex() {
    let mut window = opened();
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    let before = *window.session().camera();
    window.click(OF_VERTEX);
    let joints = window.session().joints();
    let vertex = joints.selected_vertex().map(|vertex| vertex.vertex);
    assert_eq!((joints.selected(), vertex), (None, Some(5)));
    assert!(window.shows("Selected: Vertex 5") && shows_lines(&window));
    assert!(
        window.session().camera().distance < 0.5 * before.distance,
        "its neighbourhood is framed"
    );
    let session = &mut window.harness.state_mut().session;
    let place = session.explain_vertex().expect("selected").position;
    let at = session.place_in_picture(place).expect("in view").x;
    // Between the list of findings and the inspector.
    let x = 0.5 * (at + 1.0) * WIDE.x;
    let free = window.rect(OF_VERTEX).max.x..=window.rect("Selected: Vertex 5").min.x;
    assert!(free.contains(&x), "{x} {free:?}");
}

#[test]
fn a_finding_about_a_subset_leads_to_the_subset_even_when_it_is_hidden() {
    let mut window = opened();
    window.click("Panel: Skeleton");
    let (subset, visible) = (1, false);
    window.apply(SubmeshCommand::SetVisible {
        submesh: subset,
        visible,
    });
    let before = *window.session().camera();
    window.click(OF_SUBSET);
    let subsets = window.session().submeshes();
    assert_eq!((subsets.selected(), subsets.is_visible(1)), (Some(1), true));
    assert!(
        window.shows("Subset 2 of 2") && window.shows("Subsets"),
        "inspector and list"
    );
    assert_ne!(*window.session().camera(), before, "it is framed");
    assert!(shows_lines(&window));
}

#[test]
fn a_finding_about_a_material_leads_to_the_first_subset_that_has_it() {
    let mut window = opened();
    window.click(OF_MATERIAL);
    assert_eq!(window.session().submeshes().selected(), Some(1));
    assert!(window.shows("Selected: Painted (2)"));
}

#[test]
fn a_finding_about_a_clip_shows_the_clip() {
    let mut window = opened();
    let before = *window.session().camera();
    assert_eq!(window.session().clip_index(), Some(0));
    window.click(OF_CLIP);
    assert_eq!(window.session().clip_index(), Some(2));
    assert!(window.shows("Clip Still, Bone 1") || window.shows("Selected: Bone 1"));
    assert!(shows_lines(&window));
    assert_eq!(selected(&window), Some(1));
    assert!(
        window.session().camera().distance < before.distance,
        "the bone is framed"
    );
    window.apply(PlayCommand::SelectClip(1));
    window.click(OF_CLIP);
    assert_eq!(
        window.session().clip_index(),
        Some(1),
        "a click that shuts a row goes nowhere"
    );
    assert!(!shows_lines(&window));
}

#[test]
fn a_finding_about_a_triangle_shows_its_three_corners() {
    let mut window = opened();
    window.click(OF_TRIANGLE);
    let triangle = faulty().triangles[5];
    let joints = window.session().joints();
    let selected = joints.selected_vertex().map(|vertex| vertex.vertex);
    assert_eq!((selected, joints.selected_triangle()), (Some(triangle[0]), Some(5)));
    let [a, b, c] = triangle;
    let words = format!("First corner of triangle 5, which has vertices {a}, {b} and {c}.");
    assert!(window.shows(&words));
    let session = &mut window.harness.state_mut().session;
    let corners = session.selected_corners().expect("it is selected");
    let free = window.rect(OF_TRIANGLE).max.x..=window.rect("Selected: Vertex ").min.x;
    for (corner, vertex) in corners.into_iter().zip(triangle) {
        let session = &mut window.harness.state_mut().session;
        let at = session.place_in_picture(corner).expect("in view").x;
        let x = 0.5 * (at + 1.0) * WIDE.x;
        assert!(free.contains(&x), "{x} {free:?}");
        window.apply(JointCommand::SelectVertex(Some(vertex)));
        let session = &mut window.harness.state_mut().session;
        assert_eq!(session.explain_vertex().expect("selected").position, corner);
    }
    assert_eq!(
        window.session().joints().selected_triangle(),
        None,
        "a vertex takes its place"
    );
    let to_parts = window.named(|name| name.contains("\nGo to "));
    let words: Vec<&str> = to_parts
        .iter()
        .filter_map(|(name, _)| Some(name.rsplit_once("Go to ")?.1))
        .collect();
    // The worst first, and those as bad in the order of the file.
    let wanted = [
        "Subset 1",
        "Vertex 5",
        "Triangle 5",
        "Bone 1",
        "Clip Still, Bone 1",
        "Material Painted (2)",
    ];
    assert_eq!(words, wanted);
}

#[test]
fn a_finding_about_a_time_of_a_clip_pauses_there() {
    let jumps = include_bytes!("../fixtures/check/loop-jumps.m3d").to_vec();
    let mut window = window(WIDE, vec![File::new("jumps.m3d", jumps)]);
    window.click("Findings: ");
    window.apply(PlayCommand::Play);
    let found = window.session().diagnostics().next().expect("it jumps").clone();
    let moment = found.moment();
    let (time_secs, bone) = (moment.time_secs.expect("at its end"), moment.bone.expect("of a bone"));
    window.click("note loop-jumps: ");
    let session = window.session();
    assert_eq!(selected(&window), Some(bone));
    assert!(!session.playback().is_playing());
    assert_eq!(session.playback().time_secs(), time_secs);
}

#[test]
fn a_file_that_is_read_again_keeps_findings_and_selection() {
    let mut window = opened();
    window.click(OF_VERTEX);
    let selected = |window: &Window| window.session().joints().selected_vertex().map(|vertex| vertex.vertex);
    assert!(shows_lines(&window) && selected(&window) == Some(5));
    window.apply(FileCommand::Add(files()));
    assert!(shows_lines(&window) && selected(&window) == Some(5));
    // Where it was mended its row goes, and the others stay.
    let mut mended = faulty();
    mended.vertices[5].blend_weights = [0.5, 0.5, 0.0, 0.0];
    window.apply(FileCommand::Add(vec![models::file("faulty.m3d", &mended)]));
    assert!(!shows_lines(&window) && lists(&window, OF_BONE));
    window.apply(FileCommand::Add(vec![models::file("another.m3d", &mended)]));
    assert!(!window.harness.state().state.diagnostics_open);
}

#[test]
fn what_was_mended_says_how_to_keep_it_and_leads_to_the_export() {
    for mut window in [window(WIDE, files()), phone(files())] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.click("Findings: ");
        let words = "The file itself is unchanged. Export, or bindpose convert IN OUT, writes it mended.";
        assert!(!window.shows(words));
        window.click_anywhere(OF_VERTEX);
        assert!(window.shows(words));
        window.click_anywhere("Export the model as it is mended");
        window.pass_on();
        assert!(window.session().export().is_some(), "the panel plans it");
    }
}

#[test]
fn where_triangles_are_turned_away_both_sides_can_be_drawn() {
    let file = include_bytes!("../fixtures/check/triangles-turned-away.gltf").to_vec();
    let mut window = window(WIDE, vec![File::new("turned.gltf", file)]);
    window.click("Findings: ");
    window.click_anywhere("warning triangles-turned-away: ");
    let (both, of_file) = ("Draw both sides", "Draw sides as in the file");
    window.click_anywhere(both);
    assert!(window.session().materials()[0].double_sided);
    assert!(!window.shows(both));
    window.click_anywhere(of_file);
    assert!(!window.session().materials()[0].double_sided && window.shows(both));
}

#[test]
fn a_phone_tells_of_warnings_before_anything_is_opened() {
    let mut window = phone(files());
    window.click("Show 5 warnings, 1 note");
    assert!(lists(&window, OF_VERTEX));
    window.click_anywhere(OF_VERTEX);
    window.click("Close the sheet");
    window.assert_shows("Show Vertex 5");
    window.click("Show 5 warnings, 1 note");
    assert!(lists(&window, OF_VERTEX));
}

#[test]
fn a_key_shows_and_hides_the_findings() {
    for mut window in [opened(), phone(files())] {
        window.harness.state_mut().state.diagnostics_open = false;
        window.pass_on();
        assert!(!lists(&window, OF_VERTEX));
        window.press(Modifiers::NONE, Key::D);
        assert!(lists(&window, OF_VERTEX));
        window.press(Modifiers::NONE, Key::D);
        assert!(!lists(&window, OF_VERTEX));
    }
}

#[test]
fn a_finding_about_the_whole_file_leads_nowhere() {
    let mut document = models::skinned(&models::CLIPS);
    document.subsets.clear();
    let mut window = window(WIDE, vec![models::file("whole.m3d", &document)]);
    window.click("Findings: ");
    let camera = *window.session().camera();
    window.click("warning no-subsets: ");
    assert!(window.shows(&codes::NO_SUBSETS.help()) && !shows_lines(&window));
    let session = window.session();
    assert_eq!((session.submeshes().selected(), selected(&window)), (None, None));
    assert_eq!(*session.camera(), camera);
    let leads = |name: &str| name.starts_with("warning no-subsets: ") && name.contains("Go to");
    assert!(window.named(leads).is_empty());
}

#[test]
fn a_finding_can_be_reached_and_opened_by_keys_and_shows_that_it_can_be_clicked() {
    let mut window = opened();
    for _ in 0..200 {
        if window.focused().is_some_and(|name| name.starts_with(OF_BONE)) {
            break;
        }
        window.tab(false);
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(selected(&window), Some(1));
    let at = window.rect(OF_CLIP).center();
    window.hover_at(at);
    assert_eq!(
        window.harness.output().platform_output.cursor_icon,
        CursorIcon::PointingHand
    );
}

#[test]
fn on_a_phone_the_view_above_the_list_goes_there_and_the_inspector_waits_below_it() {
    let mut window = phone(files());
    window.click("Model facts");
    window.click("Findings: ");
    window.click_anywhere(OF_BONE);
    assert_eq!(selected(&window), Some(1));
    assert!(shows_lines(&window));
    window.click("Close");
    assert!(window.shows("Selected: Bone 1"));
}

#[test]
fn every_place_of_a_finding_is_listed_and_leads_there() {
    let mut document = models::skinned(&models::CLIPS);
    for vertex in [2, 5, 9] {
        document.vertices[vertex].blend_weights = [0.25, 0.25, 0.0, 0.0];
    }
    for mut window in [
        window(WIDE, vec![models::file("three.m3d", &document)]),
        phone(vec![models::file("three.m3d", &document)]),
    ] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.click("Findings: ");
        assert!(window.named(|name| name.starts_with("Go to ")).is_empty());
        window.click(OF_VERTEX);
        let vertex = |window: &Window| {
            let vertex = window.session().joints().selected_vertex();
            vertex.map(|vertex| vertex.vertex)
        };
        assert_eq!(vertex(&window), Some(2));
        for other in [9, 5, 2] {
            let lines = |window: &Window| window.named(|name| name.contains(" | ") && name.contains('^'));
            let before = lines(&window);
            let (name, _) = window.named(|name| name.starts_with(&format!("Go to Vertex {other} · line ")))[0].clone();
            window.click_anywhere(&name);
            assert_eq!(vertex(&window), Some(other));
            let (_, line) = name.split_once(" · line ").expect("it has one");
            let shown = lines(&window);
            assert_ne!(shown, before);
            assert!(shown[0].0.contains(&format!("{line} | ")), "{shown:?}");
        }
    }
}

#[test]
fn of_many_places_the_first_are_listed_and_the_rest_are_counted() {
    let mut document = models::skinned(&models::CLIPS);
    assert_eq!(document.vertices.len(), 24);
    for vertex in &mut document.vertices {
        vertex.blend_weights = [0.25, 0.25, 0.0, 0.0];
    }
    let mut window = window(WIDE, vec![models::file("many.m3d", &document)]);
    window.click("Show 1 warning");
    window.click(OF_VERTEX);
    assert_eq!(window.named(|name| name.starts_with("Go to Vertex ")).len(), 20);
    assert!(window.shows("and 4 more"));
}

/// The names of the rows of findings.
fn listed(window: &Window) -> Vec<String> {
    let starts = ["note ", "warning ", "error "];
    let rows = window.named(|name| starts.iter().any(|start| name.starts_with(start)) && name.contains(": "));
    rows.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn chips_count_each_severity_and_list_it_alone() {
    let mut window = opened();
    let all = listed(&window);
    let count = |severity: &str| all.iter().filter(|name| name.starts_with(severity)).count();
    let (warnings, notes) = (count("warning "), count("note "));
    assert!(warnings > 1 && notes > 0, "{all:?}");
    assert!(
        window
            .named(|name| name.starts_with("Only ") && name.contains("error"))
            .is_empty()
    );
    window.click(&format!("Only {warnings} warnings"));
    assert!(listed(&window).len() == warnings && listed(&window).iter().all(|name| name.starts_with("warning ")));
    window.click("Only 1 note");
    assert!(listed(&window).len() == notes && listed(&window).iter().all(|name| name.starts_with("note ")));
    window.click("Only 1 note");
    assert_eq!(listed(&window), all);
}

#[test]
fn the_search_looks_in_words_and_codes_and_esc_clears_it() {
    let mut window = opened();
    let all = listed(&window);
    window.click("Search findings");
    type_text(&mut window, "OFFSET affine");
    assert_eq!(listed(&window).len(), 1, "{all:?}");
    assert!(listed(&window)[0].starts_with(OF_BONE));
    type_text(&mut window, " banana");
    assert!(listed(&window).is_empty() && window.shows("No finding fits what is chosen above."));
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(listed(&window), all);
    assert!(
        window.harness.state().state.diagnostics_open,
        "it clears and does nothing else"
    );
}

#[test]
fn an_open_row_says_how_to_mend_it_and_leads_to_the_page_of_codes() {
    let mut window = opened();
    let code = codes::named("offset-not-affine").expect("it is in the table");
    assert!(!window.shows(&code.help()));
    window.click(OF_BONE);
    assert!(window.shows(&code.help()) && shows_lines(&window));
    window.click("offset-not-affine");
    let last = window.harness.state().requests.last();
    assert_eq!(last, Some(&Request::ExplainCode("offset-not-affine")));
}

#[test]
fn each_book_has_a_line_that_unfolds_to_what_one_sees_and_the_place() {
    for mut window in [window(WIDE, files()), phone(files())] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.click_anywhere("Books: D3D12 demo: would end with an error");
        let d3d11 = "D3D11 demo: cannot read it";
        window.assert_shows(d3d11);
        assert!(!shows_lines(&window) && window.node(d3d11).data().is_expanded() == Some(false));
        window.click(d3d11);
        assert!(shows_lines(&window) && window.node(d3d11).data().is_expanded() == Some(true));
        assert!(
            !window
                .named(|name| name.starts_with("One sees: It ends with an error"))
                .is_empty()
        );
        window.ask(d3d11, Action::Collapse, None);
        assert!(!shows_lines(&window));
        window.ask(d3d11, Action::Expand, None);
        assert!(shows_lines(&window));
    }
}

#[test]
fn a_book_that_reads_the_file_tells_its_limits() {
    let mut document = models::skinned(&models::CLIPS);
    document.clips[0].name = "Take1".to_owned();
    for material in &mut document.materials {
        material.diffuse_map = Some("skin.dds".to_owned());
        material.normal_map = Some("bumps.dds".to_owned());
    }
    let mut window = window(WIDE, vec![models::file("take.m3d", &document)]);
    window.click("Books: D3D12 demo: shows it");
    let verdict = window.session().verdicts().last().expect("of the D3D12 book").clone();
    assert!(
        verdict.reads() && !verdict.ends && !verdict.limits.is_empty(),
        "{verdict:?}"
    );
    window.click("D3D12 demo: shows it, if these 2 maps lie beside it · ");
    for limit in &verdict.limits {
        assert!(window.shows(&limit.message) && window.shows(limit.code), "{limit:?}");
    }
}

#[test]
fn the_report_is_copied_as_text_and_saved_by_the_page() {
    let mut window = opened();
    let copied = copied_by(&mut window, "Copy report");
    assert_eq!(copied, window.session().report());
    assert!(
        copied.contains("D3D11 demo: cannot read it. It takes \"Name:\"") && copied.contains("[offset-not-affine]: "),
        "{copied}"
    );
    assert!(window.shows("Copied the report"));
    window.click("Save report");
    assert_eq!(window.harness.state().requests.last(), Some(&Request::SaveReport));
    assert_eq!(report_name(window.session()), "faulty.sarif");
}

#[test]
fn of_thousands_of_findings_only_those_near_the_view_are_laid_out_and_the_search_finds_the_others() {
    let damaged = |index: usize| File::new(&format!("{index}.png"), vec![1, 2, 3]);
    let mut window = window(WIDE, vec![models::file("box.m3d", &models::document())]);
    window.apply(FileCommand::Add((0..3000).map(damaged).collect()));
    assert!(window.session().diagnostics().count() >= 3000);
    window.click("Findings: ");
    let laid_out = listed(&window).len();
    assert!((5..100).contains(&laid_out), "{laid_out}");
    window.click("Search findings");
    type_text(&mut window, "2999.png");
    assert_eq!(listed(&window).len(), 1);
}

#[test]
fn with_a_mouse_the_buttons_stay_below_the_rows_and_for_fingers_they_come_after_them() {
    let low = egui::vec2(844.0, 390.0);
    for (mut window, is_touch) in [(window(low, files()), false), (touch_window(low, files()), true)] {
        window.click("Model facts");
        window.click_anywhere("Findings: ");
        assert!(!listed(&window).is_empty());
        let transport = window.rect("Play (Space)");
        for button in ["Copy report", "Save report"] {
            let rect = window.rect(button);
            assert_eq!(rect.max.y > transport.min.y, is_touch, "{button} {rect:?}");
            assert!(!is_touch || rect.height() >= 44.0);
        }
    }
}

#[test]
fn a_book_that_does_not_show_the_file_leads_to_an_export_for_it() {
    for (line, book, format) in [
        ("D3D11 demo: cannot read it", "D3D11 demo", ExportFormat::D3d11),
        ("D3D12 demo: would end", "D3D12 demo", ExportFormat::D3d12),
    ] {
        for (mut window, is_wide) in [(window(WIDE, files()), true), (phone(files()), false)] {
            if !is_wide {
                window.click("Model facts");
            }
            window.click_anywhere("Books: D3D12 demo: ");
            window.click_anywhere(line);
            window.click_anywhere(&format!("Export for this book: {book}"));
            window.pass_on();
            let options = window.session().export().expect("the panel is open").options;
            assert_eq!((options.format, options.for_book), (format, true));
        }
    }
}
