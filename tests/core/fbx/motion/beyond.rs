//! Curves before their first key and after their last, beside ufbx; and keys that nothing needs.

use bindpose::import::import;
use bindpose::model::{Clip, Track};

use super::made::{STRAIGHT, of_bone};

/// The one track of a file that moves.
fn track(clip: &Clip) -> &Track {
    clip.tracks.iter().find(|track| track.has_keys()).expect("it moves")
}

#[test]
fn curves_go_on_beyond_their_ends_as_ufbx_has_them() {
    const CONSTANT: &str = "2\n\t\t}\n\t\tKeyAttrDataFloat: *4 {\n\t\t\ta: 0,0,0,0";
    // Flags: cubic, slopes of its own. The bits of 2 and 0.5.
    const CUBIC: &str = "1032\n\t\t}\n\t\tKeyAttrDataFloat: *4 {\n\t\t\ta: 1073741824,1056964608,0,0";
    const TICKS_PER_SEC: i64 = 46_186_158_000;
    const SPAN_SECS: [i64; 2] = [-8, 14];
    let [start, end] = SPAN_SECS.map(|secs| secs * TICKS_PER_SEC);
    let span = format!(
        "\tAnimationStack: 10, \"AnimationStack::Take\", \"LimbNode\" {{\n\t\tProperties70:  {{\n\t\t\tP: \"LocalStart\", \"KTime\", \
         \"Time\", \"\",{start}\n\t\t\tP: \"LocalStop\", \"KTime\", \"Time\", \"\",{end}\n\t\t}}\n"
    );
    let mut wrong = Vec::new();
    for (name, flags) in [("straight", STRAIGHT), ("constant", CONSTANT), ("cubic", CUBIC)] {
        for (kind, count) in [
            ('C', -1),
            ('K', -1),
            ('R', -1),
            ('R', 2),
            ('A', -1),
            ('A', 1),
            ('A', 0),
            ('M', -1),
            ('M', 2),
            ('M', 1),
        ] {
            let ending = format!("-Extrapolation:  {{\n\t\t\tType: {kind}\n\t\t\tRepetition: {count}\n\t\t}}\n");
            let file = of_bone(&[1.0, 3.0, 0.0, 5.0], flags, "Lcl Translation").file();
            let file = file
                .replacen(
                    "\t\tKeyAttrFlags:",
                    &format!("\t\tPre{ending}\t\tPost{ending}\t\tKeyAttrFlags:"),
                    1,
                )
                .replacen(
                    "\tAnimationStack: 10, \"AnimationStack::Take\", \"LimbNode\" {\n",
                    &span,
                    1,
                );
            let imported = import(file.as_bytes()).expect("it is read");
            let clip = &imported.model.clips[0];
            assert_eq!([clip.start_secs, clip.end_secs], SPAN_SECS.map(|secs| secs as f32));
            let scene = ufbx::load_memory(file.as_bytes(), ufbx::LoadOpts::default()).expect("ufbx reads it");
            let curve = &scene.anim_curves[0];
            // Whole seconds are left out: there it may have two values.
            let times = (0..440).map(|step| -7.985 + 0.05 * f64::from(step));
            let seams = (-7..14).flat_map(|secs| [-1e-3, 1e-3].map(|away| f64::from(secs) + away));
            for secs in times.chain(seams) {
                let theirs = ufbx::evaluate_curve(curve, secs, 0.0);
                let ours = f64::from(track(clip).translation().at(secs as f32).x) * 100.0;
                // Just beside a key it is as far off as it moves in a number's last bit.
                if (ours - theirs).abs() > 2e-4 {
                    wrong.push(format!("{name}, {kind} {count}, at {secs}: {ours}, not {theirs}"));
                    break;
                }
            }
            let findings = imported.diagnostics.iter();
            let told: Vec<_> = findings.map(|finding| &*finding.message).collect();
            assert!(told.is_empty(), "{name}, {kind} {count}: {told:?}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn keys_that_lie_on_the_line_between_others_are_left_out() {
    let keys = |values: &[f64], property: &str| {
        let imported = of_bone(values, STRAIGHT, property).import().expect("it is read");
        let track = track(&imported.model.clips[0]).clone();
        for (secs, &value) in (0u8..).zip(values).filter(|_| property == "Lcl Translation") {
            let x = track.translation().at(f32::from(secs)).x * 100.0;
            assert!((f64::from(x) - value).abs() < 1e-3, "{x}, not {value}");
        }
        track.times_secs().to_vec()
    };
    assert_eq!(
        keys(&[0.0, 1.0, 2.0, 3.0, 10.0, 9.0, 8.0], "Lcl Translation"),
        [0.0, 3.0, 4.0, 6.0]
    );
    assert_eq!(keys(&[0.0, 10.0, 20.0, 30.0, 0.0], "Lcl Rotation"), [0.0, 3.0, 4.0]);
    // Some stay: of 32 one at least.
    let line: Vec<f64> = (0..100).map(f64::from).collect();
    assert_eq!(keys(&line, "Lcl Translation"), [0.0, 32.0, 64.0, 96.0, 99.0]);
}

#[test]
fn times_are_counted_in_the_unit_that_the_header_names() {
    for (version, unit, secs) in [
        (1003, 0, 3.0),
        (1004, 127, 3.0),
        (1004, 0, 3.0 * 46_186_158_000.0 / 141_120_000.0),
    ] {
        let file = of_bone(&[1.0, 3.0, 0.0, 5.0], STRAIGHT, "Lcl Translation").file();
        let header = format!(
            "\tFBXHeaderVersion: {version}\n\tFBXVersion: 7400\n\tOtherFlags:  {{\n\t\tTCDefinition: {unit}\n\t}}\n"
        );
        let file = file.replacen("\tFBXVersion: 7400\n", &header, 1);
        let imported = import(file.as_bytes()).expect("it is read");
        let theirs = ufbx::load_memory(file.as_bytes(), ufbx::LoadOpts::default()).expect("ufbx reads it");
        let last = theirs.anim_curves[0].keyframes.last().expect("it has keys").time;
        let ours = f64::from(imported.model.clips[0].end_secs);
        assert!(
            (ours - last).abs() < 1e-4 * last && (ours - secs).abs() < 1e-4 * secs,
            "{version} {unit}: {ours}, {last}, {secs}"
        );
    }
}
