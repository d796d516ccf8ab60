//! Clips of made files: layers, what is told, and where a budget ends.

use std::fmt::Write as _;

use bindpose::anim::{PoseBuffers, skin_positions};
use bindpose::import::{Imported, Refused, import};
use bindpose::model::JointIndex;

use crate::fbx::surface;

/// A straight line from key to key: flags, and four numbers that it has no use for.
pub(super) const STRAIGHT: &str = "4\n\t\t}\n\t\tKeyAttrDataFloat: *4 {\n\t\t\ta: 0,0,0,0";

/// A file without a mesh: the bone 100, what hangs besides it, and what moves on stack 10.
pub(super) struct Made {
    objects: String,
    connections: String,
}

impl Made {
    pub(super) fn new() -> Self {
        let mut made = Self {
            objects: String::new(),
            connections: String::new(),
        };
        made.object("Model", 100, "Bone 0", "");
        made.object("AnimationStack", 10, "Take", "");
        made
    }

    fn object(&mut self, class: &str, id: usize, name: &str, inner: &str) {
        writeln!(
            self.objects,
            "\t{class}: {id}, \"{class}::{name}\", \"LimbNode\" {{\n{inner}\t}}"
        )
        .expect("a string");
    }

    fn hang(&mut self, child: usize, parent: usize, property: &str) {
        writeln!(self.connections, "\tC: \"OP\",{child},{parent},\"{property}\"").expect("a string");
    }

    fn layer(&mut self, id: usize, properties: &str) {
        self.object(
            "AnimationLayer",
            id,
            "",
            &format!("\t\tProperties70:  {{\n{properties}\t\t}}\n"),
        );
        self.hang(id, 10, "");
    }

    /// A curve node of a layer, with a curve for x.
    fn curve_node(&mut self, id: usize, layer: usize, curve: usize) {
        self.object("AnimationCurveNode", id, "", "");
        self.hang(id, layer, "");
        self.hang(curve, id, "d|X");
    }

    /// A key for each value, a second apart; `attributes` are flags and four numbers.
    fn curve(&mut self, id: usize, values: &[f64], flags: &str) {
        let times: Vec<f64> = (0..values.len()).map(|key| 46_186_158_000.0 * key as f64).collect();
        let array = |name: &str, numbers: &[f64]| {
            let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
            format!(
                "\t\t{name}: *{} {{\n\t\t\ta: {}\n\t\t}}\n",
                words.len(),
                words.join(",")
            )
        };
        let inner = [
            array("KeyTime", &times),
            array("KeyValueFloat", values),
            format!("\t\tKeyAttrFlags: *1 {{\n\t\t\ta: {flags}\n\t\t}}\n"),
            array("KeyAttrRefCount", &[values.len() as f64]),
        ];
        self.object("AnimationCurve", id, "", &inner.concat());
    }

    pub(super) fn file(&self) -> String {
        let Self { objects, connections } = self;
        format!(
            "; FBX 7.4.0 project file\nFBXHeaderExtension:  {{\n\tFBXVersion: 7400\n}}\nObjects:  {{\n{objects}}}\nConnections:  {{\n\tC: \
             \"OO\",100,0\n{connections}}}\n"
        )
    }

    pub(super) fn import(&self) -> Result<Imported, Box<Refused>> {
        import(self.file().as_bytes())
    }
}

/// What is told of a file.
fn told(imported: &Imported) -> Vec<(&str, &str)> {
    let findings = imported.diagnostics.iter();
    findings.map(|finding| (finding.code, &*finding.message)).collect()
}

/// One curve of the bone's, on the only layer.
pub(super) fn of_bone(values: &[f64], flags: &str, property: &str) -> Made {
    let mut made = Made::new();
    made.layer(11, "");
    made.curve(13, values, flags);
    made.curve_node(12, 11, 13);
    made.hang(12, 100, property);
    made
}

/// The same curve for so many bones besides.
fn of_many(values: &[f64], bones: usize) -> Made {
    let mut made = of_bone(values, STRAIGHT, "Lcl Translation");
    for bone in 1000..1000 + bones {
        made.object("Model", bone, &format!("Bone {bone}"), "");
        made.hang(12, bone, "Lcl Translation");
    }
    made
}

const TOO_LARGE: &str = "What is in the file would become many times as large as the file.";

#[test]
fn a_curve_of_thousands_of_bones_ends_with_the_budget() {
    // Each of 2000 keys is kept for each of 3000 bones.
    let zigzag: Vec<f64> = (0..2000).map(|key| f64::from(key % 2)).collect();
    let refused = of_many(&zigzag, 3000).import().map(drop).expect_err("it is too large");
    assert_eq!(
        (refused.error.code, &*refused.error.message),
        ("fbx-damaged", TOO_LARGE)
    );
    // None is kept, but all are looked at.
    let imported = of_many(&[5.0; 2000], 3000).import().expect("it is read");
    let moved = imported.model.clips[0]
        .tracks
        .iter()
        .filter(|track| track.has_keys())
        .count();
    assert!((100..2900).contains(&moved), "{moved}");
    let told = told(&imported);
    let left = format!(
        "{} tracks have more keys or layers than are followed in a file of this size; at rest.",
        3001 - moved
    );
    assert!(told.contains(&("fbx-left-out", &*left)), "{told:?}");
    // Of few bones, all are followed.
    let imported = of_many(&zigzag, 20).import().expect("it is read");
    assert_eq!(
        imported.model.clips[0]
            .tracks
            .iter()
            .filter(|track| track.has_keys())
            .count(),
        21
    );
    assert!(self::told(&imported).is_empty(), "{:?}", self::told(&imported));
}

#[test]
fn thousands_of_layers_and_turns_end_with_the_budget() {
    const LEFT: (&str, &str) = (
        "fbx-left-out",
        "1 track has more keys or layers than are followed in a file of this size; at rest.",
    );
    let values: Vec<f64> = (0..600).map(f64::from).collect();
    let layers = |count: usize, has_own: bool| {
        let mut made = of_bone(&values, STRAIGHT, "Lcl Rotation");
        for layer in 1000..1000 + count {
            made.layer(layer, "");
            if has_own {
                made.curve_node(layer + count, layer, 13);
                made.hang(layer + count, 100, "Lcl Rotation");
            } else {
                made.hang(12, layer, "");
            }
        }
        made.import()
    };
    assert_eq!(told(&layers(3000, true).expect("it is read")), [LEFT]);
    let few = layers(3, true).expect("it is read");
    assert_eq!(
        told(&few),
        [("fbx-left-out", "1 clip is of several layers, which become one.")]
    );
    let refused = layers(3000, false).map(drop).expect_err("each layer has each other's");
    assert_eq!(refused.error.message, TOO_LARGE);
    // From each key to the next it turns more than twenty times.
    let turns = |keys: u32| (0..keys).map(|key| 8e3 * f64::from(key % 2)).collect::<Vec<_>>();
    let turning = |keys: u32| {
        of_bone(&turns(keys), STRAIGHT, "Lcl Rotation")
            .import()
            .expect("it is read")
    };
    assert_eq!(told(&turning(20_000)), [LEFT]);
    let imported = turning(20);
    assert!(told(&imported).is_empty(), "{:?}", told(&imported));
    let joint = imported.model.skeleton.joint_of_bone()[0];
    let turned = imported.model.clips[0].tracks[joint.index()].rotation().at(0.1);
    assert!(
        turned.dot(glam::Quat::from_rotation_x(800f32.to_radians())).abs() > 1.0 - 1e-5,
        "{turned}"
    );
}

#[test]
fn a_layer_adds_no_scale_of_what_it_does_not_move() {
    for (properties, along) in [
        (
            "\t\t\tP: \"ScaleAccumulationMode\", \"enum\", \"\", \"\",1\n",
            [2.25, 1.0, 1.0],
        ),
        (
            "\t\t\tP: \"ScaleAccumulationMode\", \"enum\", \"\", \"\",0\n",
            [0.5, 1.0, 1.0],
        ),
    ] {
        let mut made = of_bone(&[2.0, 2.0], STRAIGHT, "Lcl Scaling");
        // ufbx takes 0 for what the lowest layer does not say.
        let ones = "{\n\t\tProperties70:  {\n\t\t\tP: \"d|Y\", \"Number\", \"\", \"A\",1\n\t\t\tP: \"d|Z\", \"Number\", \"\", \"A\",1\n\t\t}\n";
        let node = "\tAnimationCurveNode: 12, \"AnimationCurveNode::\", \"LimbNode\" ";
        made.objects = made
            .objects
            .replacen(&format!("{node}{{\n"), &format!("{node}{ones}"), 1);
        made.layer(21, properties);
        made.curve(23, &[0.25, 0.25], STRAIGHT);
        made.curve_node(22, 21, 23);
        made.hang(22, 100, "Lcl Scaling");
        let imported = made.import().expect("it is read");
        let joint = imported.model.skeleton.joint_of_bone()[0];
        let scale = imported.model.clips[0].tracks[joint.index()].scale().at(0.5);
        assert!(scale.abs_diff_eq(along.into(), 1e-5), "{scale}, not {along:?}");
        // Where scales multiply, it multiplies by that 0.
        if along[0] > 1.0 {
            let file = made.file();
            let scene = ufbx::load_memory(file.as_bytes(), ufbx::LoadOpts::default()).expect("ufbx reads it");
            let opts = ufbx::EvaluateOpts::default();
            let posed = ufbx::evaluate_scene(&scene, &scene.anim_stacks[0].anim, 0.5, opts).expect("it is evaluated");
            let bone = posed
                .nodes
                .iter()
                .find(|node| *node.element.name == *"Bone 0")
                .expect("a bone");
            let theirs = bone.local_transform.scale;
            assert!(
                scale
                    .as_dvec3()
                    .abs_diff_eq([theirs.x, theirs.y, theirs.z].into(), 1e-5),
                "{scale}"
            );
        }
    }
}

#[test]
fn what_clips_cannot_follow_is_told_with_its_bone() {
    // Flags: cubic, slopes and weights of its own. Both weights are 1, so that it rises straight up in the middle.
    const RISING: &str = "50332680\n\t\t}\n\t\tKeyAttrDataFloat: *4 {\n\t\t\ta: 0,0,655370000,0";
    let imported = of_bone(&[0.0, 100.0], RISING, "Lcl Translation")
        .import()
        .expect("it is read");
    let off = "1 track bends between two keys more than 128 pieces follow: \"Bone 0\" in \"Take\".";
    assert_eq!(told(&imported), [("fbx-left-out", off)]);
    let third = |values: &str| {
        values.replacen(
            "KeyValueFloat: *3 {\n\t\t\ta: 0,100,200",
            "KeyValueFloat: *2 {\n\t\t\ta: 0,100",
            1,
        )
    };
    let file = third(&of_bone(&[0.0, 100.0, 200.0], STRAIGHT, "Lcl Translation").file());
    let imported = import(file.as_bytes()).expect("it is read");
    let short =
        "The curve of \"Bone 0, Lcl Translation\" has 3 times, but 2 values; what has no other half is left out.";
    assert_eq!(told(&imported), [("fbx-rule-broken", short)]);
    assert_eq!(imported.model.clips[0].end_secs, 1.0);
    let again = |times: &str| times.replacen("a: 0,46186158000,", "a: 0,0,", 1);
    let file = again(&of_bone(&[0.0, 100.0, 200.0], STRAIGHT, "Lcl Translation").file());
    let imported = import(file.as_bytes()).expect("it is read");
    let late =
        "The curve of \"Bone 0, Lcl Translation\" has 1 key without a number, or no later than one before; left out.";
    assert_eq!(told(&imported), [("fbx-rule-broken", late)]);
}

#[test]
fn curves_with_the_same_fault_are_told_apart_up_to_four() {
    let mut made = Made::new();
    made.layer(11, "");
    let long = "a".repeat(100_000);
    for bone in 0..6 {
        let (id, curve, node) = (1000 + bone, 2000 + bone, 3000 + bone);
        made.object("Model", id, &format!("{bone}{long}"), "");
        made.curve(curve, &[0.0, 100.0, 200.0], STRAIGHT);
        made.curve_node(node, 11, curve);
        made.hang(node, id, "Lcl Translation");
    }
    let file = made.file().replace("a: 0,46186158000,", "a: 0,0,");
    let imported = import(file.as_bytes()).expect("it is read");
    let told = told(&imported);
    assert_eq!(told.len(), 5, "{told:?}");
    for (bone, (code, message)) in told[..4].iter().enumerate() {
        let name = format!("{bone}{}…", &long[..39]);
        let late = "has 1 key without a number, or no later than one before; left out.";
        assert_eq!(*code, "fbx-rule-broken");
        assert_eq!(*message, format!("The curve of \"{name}, Lcl Translation\" {late}"));
    }
    assert_eq!(
        told[4],
        ("fbx-rule-broken", "Curves with keys that are left out: 2 more.")
    );
}

#[test]
fn keys_of_a_take_that_are_left_out_are_told() {
    let take = |keys: &str| {
        let text = format!(
            "; FBX 6.1.0 project file\nFBXHeaderExtension:  {{\n\tFBXVersion: 6100\n}}\nObjects:  {{\n\tModel: \"Model::Hip\", \"Limb\" \
             {{\n\t}}\n}}\nConnections:  {{\n\tConnect: \"OO\", \"Model::Hip\", \"Model::Scene\"\n}}\nTakes:  {{\n\tTake: \"Walk\" {{\n\t\t\
             Model: \"Model::Hip\" {{\n\t\t\tChannel: \"Transform\" {{\n\t\t\t\tChannel: \"T\" {{\n\t\t\t\t\tChannel: \"X\" \
             {{\n\t\t\t\t\t\tKeyVer: 4005\n\t\t\t\t\t\tKey: {keys}\n\t\t\t\t\t}}\n\t\t\t\t}}\n\t\t\t}}\n\t\t}}\n\t}}\n}}\n"
        );
        import(text.as_bytes()).expect("it is read")
    };
    let told = |keys| {
        let imported = take(keys);
        let findings = imported.diagnostics.into_iter().map(|finding| finding.message);
        (findings.collect::<Vec<_>>(), imported.model.clips[0].end_secs)
    };
    let left_out = |keys| {
        vec![format!(
            "The curve of \"Hip, T\" has {keys} without a number, or no later than one before; left out."
        )]
    };
    assert_eq!(told("0,0,L,46186158000,100,L"), (vec![], 1.0));
    assert_eq!(told("0,0,L,0,50,L,46186158000,100,L"), (left_out("1 key"), 1.0));
    assert_eq!(
        told("0,0,L,46186158000,100,L,92372316000,1e999,L,46186158000,7,L"),
        (left_out("2 keys"), 1.0)
    );
}

#[test]
fn a_cluster_without_its_own_matrix_is_bound_by_its_bones_place_in_the_files_axes() {
    let z_up = "GlobalSettings:  {\n\tProperties70:  {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"FrontAxis\", \"int\", \
                \"Integer\", \"\",1\n\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",-1\n\t}\n}\nObjects:  {";
    let file = surface::skinned(&[0.5, 0.5]).replacen("Objects:  {", z_up, 1);
    let matrix = |x: &str| format!("\t\tTransform: *16 {{\n\t\t\ta: 1,0,0,0,0,1,0,0,0,0,1,0,{x},0,0,1");
    let zeros = format!("\t\tTransform: *16 {{\n\t\t\ta: {}", ["0"; 16].join(","));
    let without = file.replacen(&matrix("-1"), &zeros, 1);
    assert_ne!(without, file);
    let placed = |file: &str| {
        let model = import(file.as_bytes()).expect("it is read").model;
        let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
        pose.set_rest_pose(&model.skeleton);
        // The second bone alone.
        let joint = (0..model.skeleton.joint_count() as u32)
            .find(|&joint| model.skeleton.name(JointIndex(joint)) == Some("Bone 1"))
            .expect("it is there");
        let mut mesh = model.mesh.clone();
        for influences in &mut mesh.influences {
            influences.joints = [joint; 4];
        }
        let mut positions = mesh.positions.clone();
        skin_positions(&mesh, &pose.palette, &mut positions);
        positions
    };
    let [wanted, found] = [&file, &without].map(|file| placed(file));
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!(found.abs_diff_eq(*wanted, 1e-6), "{found}, not {wanted}");
    }
    let height = |positions: &[glam::Vec3]| positions.iter().map(|place| place.z.abs()).fold(0.0, f32::max);
    assert!(height(&wanted) > 0.019, "y of the file is depth: {wanted:?}");
}
