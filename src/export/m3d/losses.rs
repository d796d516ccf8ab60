//! What the books' format does not hold.

use super::document::{names_materials, of_subsets, rests_apart};
use crate::anim::STRAIGHT_ERROR;
use crate::diagnostic::codes;
use crate::diagnostic::collect::{few, named, quoted};
use crate::diagnostic::limits::{MOST_BONE_INDEX, MOST_BONES, MOST_MATERIALS, MOST_VERTICES};
use crate::export::Loss;
use crate::export::losses::Losses;
use crate::format::Dialect;
use crate::model::{
    AlphaMode, Front, JointIndex, JointNames, LocalJoint, MapSlot, Material, Model, Object, Reflectance, Sampling,
    Track, UpAxis, one_word,
};

/// What a file of this dialect does not hold of a model, or holds otherwise. `names` are names that a person gave to bones.
pub fn m3d_losses(model: &Model, names: &JointNames, dialect: Dialect) -> Vec<Loss> {
    let mut losses = Losses::default();
    if dialect == Dialect::Text {
        left_out_of_text(model, &mut losses);
        space(model, dialect, &mut losses);
        return losses.0;
    }
    let copyright = model.copyright.as_deref().unwrap_or_default();
    losses.add(
        "copyright",
        usize::from(model.copyright.is_some()),
        format!("The line of copyright is left out: \"{copyright}\"."),
    );
    extras(model, &mut losses);
    space(model, dialect, &mut losses);
    mesh(model, &mut losses);
    skeleton(model, names, &mut losses);
    keys(model, &mut losses);
    subsets(model, dialect, &mut losses);
    single_words(model, dialect, &mut losses);
    let materials: Vec<&Material> = of_subsets(model).collect();
    surfaces(&materials, dialect, &mut losses);
    maps(&materials, &mut losses);
    losses.0
}

/// What a text model has no place for.
fn left_out_of_text(model: &Model, losses: &mut Losses) {
    let Model {
        mesh, materials, clips, ..
    } = model;
    let has_look = |material: &&Material| {
        **material
            != Material {
                name: material.name.clone(),
                ..Material::default()
            }
    };
    for (code, count, subject, rest) in [
        (
            "materials-left-out",
            materials.iter().filter(has_look).count(),
            ["material is", "materials are"],
            "left out; the format has none.",
        ),
        (
            "subsets-joined",
            mesh.submeshes.len().saturating_sub(1),
            ["more subset is", "more subsets are"],
            "drawn with the first; the format has no subsets.",
        ),
        (
            "tex-coords-left-out",
            mesh.tex_coords
                .iter()
                .filter(|tex_coords| **tex_coords != Default::default())
                .count(),
            ["vertex has", "vertices have"],
            "texture coordinates; the format has none.",
        ),
        (
            "vertex-colors",
            mesh.colors.len(),
            ["vertex has", "vertices have"],
            "a colour; the format has no vertex colours.",
        ),
        (
            "bones-left-out",
            model.skeleton.joint_count(),
            ["bone is", "bones are"],
            "left out, and the weights of vertices; the format is for what stands still.",
        ),
        (
            "clips-left-out",
            clips.len(),
            ["clip is", "clips are"],
            "left out; the format is for what stands still.",
        ),
    ] {
        losses.count(code, count, subject, rest);
    }
}

fn extras(model: &Model, losses: &mut Losses) {
    let names = |object: &Object| match object.node.name.as_str() {
        "" => "one without a name".to_owned(),
        name => name.to_owned(),
    };
    let has_extras = |object: &&Object| object.node.extras.is_some() || object.mesh.extras.is_some();
    let with_extras: Vec<String> = model.objects.iter().filter(has_extras).map(names).collect();
    losses.count(
        codes::GLTF_EXTRAS_LEFT_OUT.name,
        with_extras.len(),
        ["object has", "objects have"],
        &format!("extras (custom properties), which are left out: {}.", few(&with_extras)),
    );
}

fn space(model: &Model, dialect: Dialect, losses: &mut Losses) {
    let up_axis = match dialect {
        Dialect::Imm => UpAxis::Z,
        Dialect::D3d11 | Dialect::D3d12 | Dialect::Text => UpAxis::Y,
    };
    if model.up_axis != up_axis {
        let [written, taken] = [model.up_axis, up_axis].map(|axis| axis.label().to_lowercase());
        losses.add(
            "up-axis",
            1,
            format!("The model has {written}; the dialect's files are read with {taken}, so it lies down."),
        );
    }
    if model.front != Front::Negative {
        losses.add(
            "front",
            1,
            "The model faces the other way than characters of the format do, and is seen from behind there.".into(),
        );
    }
}

fn mesh(model: &Model, losses: &mut Losses) {
    let mesh = &model.mesh;
    let vertices = ["vertex has", "vertices have"];
    losses.count(
        "vertex-colors",
        mesh.colors.len(),
        vertices,
        "a colour; the format has no vertex colours.",
    );
    losses.count(
        "second-tex-coords",
        mesh.second_tex_coords.len(),
        vertices,
        "a second UV map (texture coordinates); the format has one.",
    );
    let beyond = mesh.vertex_count().saturating_sub(MOST_VERTICES);
    losses.count(
        codes::MANY_VERTICES.name,
        beyond,
        ["vertex is", "vertices are"],
        &format!("beyond the {MOST_VERTICES} that the books' 16-bit indices can number."),
    );
}

fn skeleton(model: &Model, names: &JointNames, losses: &mut Losses) {
    let skeleton = &model.skeleton;
    let named = (0u32..)
        .zip(skeleton.file_bones())
        .filter(|&(joint, &bone)| skeleton.name(JointIndex(joint)).is_some() || names.get(bone).is_some())
        .count();
    losses.count(
        "joint-names",
        named,
        ["bone has", "bones have"],
        "a name; the format numbers its bones.",
    );
    let beyond = skeleton.joint_count().saturating_sub(MOST_BONES);
    losses.count(
        codes::MANY_BONES.name,
        beyond,
        ["bone is", "bones are"],
        &format!("beyond the {MOST_BONES} that the books' shaders have room for."),
    );
    let is_above = |influences: &&crate::model::Influences| {
        let slots = influences.joints.iter().zip(influences.weights);
        let mut used = slots.filter(|(_, weight)| *weight > 0.0);
        used.any(|(&joint, _)| skeleton.file_bones()[joint as usize] > MOST_BONE_INDEX)
    };
    let above = model.mesh.influences.iter().filter(is_above).count();
    losses.count(
        codes::BONE_INDEX_ABOVE_BYTE.name,
        above,
        ["vertex names", "vertices name"],
        &format!("a bone above {MOST_BONE_INDEX}, of which the books' loaders keep a byte."),
    );
    let apart = rests_apart(model).iter().flatten().count();
    losses.count(
        "rest-pose",
        apart,
        ["bone rests", "bones rest"],
        "elsewhere than in the bind pose. A clip without keys for such a bone gets one; without a clip the bind pose is \
         seen.",
    );
}

fn keys(model: &Model, losses: &mut Losses) {
    let count = |is: fn(&Track) -> bool| {
        let tracks = model.clips.iter().flat_map(|clip| &clip.tracks);
        tracks.filter(|track| is(track)).count()
    };
    let united = count(|track| !track.has_rows());
    losses.count(
        "keys-united",
        united,
        ["track has", "tracks have"],
        "channels with keys at different times; each key of one becomes a key of all three, where the others are at that time.",
    );
    let stepped = count(Track::holds);
    losses.count(
        "step-keys",
        stepped,
        ["track holds its values", "tracks hold their values"],
        "from key to key (constant interpolation); each such key becomes two, the second just before the next.",
    );
    let cubic = count(Track::bends);
    losses.count(
        "cubic-keys",
        cubic,
        ["track follows", "tracks follow"],
        &format!(
            "splines (Bézier curves); straight pieces take their place, off by at most {STRAIGHT_ERROR:e} of the track's range, \
             for rotations {STRAIGHT_ERROR:e} radians."
        ),
    );
    // One that rests apart gets a key there.
    let rests = rests_apart(model);
    let is_empty = |(track, rest): &(&Track, &Option<LocalJoint>)| !track.has_keys() && rest.is_none();
    let empty = model
        .clips
        .iter()
        .flat_map(|clip| clip.tracks.iter().zip(&rests))
        .filter(is_empty)
        .count();
    losses.count(
        codes::TRACK_EMPTY.name,
        empty,
        ["bone has", "bones have"],
        &format!(
            "no keys in a clip and {} none; the books' demos need one. Without `--keep-empty` each gets one at rest.",
            if empty == 1 { "gets" } else { "get" }
        ),
    );
}

fn subsets(model: &Model, dialect: Dialect, losses: &mut Losses) {
    let count = model.mesh.submeshes.len();
    losses.add(
        codes::BOOK_MANY_MATERIALS.name,
        if dialect == Dialect::D3d12 { count.saturating_sub(MOST_MATERIALS) } else { 0 },
        format!("There are {count} materials, one for each subset; the demo of the D3D12 book reaches the maps of {MOST_MATERIALS}."),
    );
    let mut uses = vec![0_usize; model.materials.len()];
    for submesh in &model.mesh.submeshes {
        uses[submesh.material as usize] += 1;
    }
    let shared: usize = uses.iter().map(|uses| uses.saturating_sub(1)).sum();
    losses.count(
        "materials-shared",
        shared,
        ["subset shares", "subsets share"],
        "a material with another one: each gets its own copy, since the format has one material for each subset.",
    );
    let unused = model.materials.iter().zip(&uses).filter(|(_, uses)| **uses == 0);
    let unused: Vec<&str> = unused.map(|(material, _)| material.name.as_str()).collect();
    losses.count(
        "materials-unused",
        unused.len(),
        ["material is", "materials are"],
        &format!(
            "left out, since nothing is drawn with {}: {}.",
            if unused.len() == 1 { "it" } else { "them" },
            named(unused)
        ),
    );
}

fn single_words(model: &Model, dialect: Dialect, losses: &mut Losses) {
    let several = |name: &&str| one_word(name) != **name;
    let clips = model
        .clips
        .iter()
        .map(|clip| clip.name.as_str())
        .filter(several)
        .count();
    let materials = of_subsets(model)
        .map(|material| material.name.as_str())
        .filter(|_| names_materials(dialect))
        .filter(several)
        .count();
    let maps = of_subsets(model)
        .flat_map(|material| [MapSlot::Diffuse, MapSlot::Normal].map(|slot| material.map_name(slot)))
        .flatten()
        .filter(several)
        .count();
    let count = clips + materials + maps;
    losses.count(
        "names-of-one-word",
        count,
        [
            "name of a clip, material or map has",
            "names of clips, materials and maps have",
        ],
        "more than one word; the books' loaders read names to the first blank, so blanks become underscores.",
    );
    let named = (0..).zip(of_subsets(model)).filter(is_named);
    let unnamed = if names_materials(dialect) { 0 } else { named.count() };
    losses.count(
        "material-names",
        unnamed,
        ["material has", "materials have"],
        "a name; the dialect has none.",
    );
}

/// Whether a material is called otherwise than one without a name is shown.
fn is_named((index, material): &(usize, &Material)) -> bool {
    material.name != format!("material {index}")
}

fn surfaces(materials: &[&Material], dialect: Dialect, losses: &mut Losses) {
    let mut losses = OfMaterials { materials, all: losses };
    losses.add(
        "metallic-roughness",
        &|material| matches!(material.reflectance, Reflectance::MetallicRoughness { metallic, .. } if metallic > 0.0),
        IS,
        "metal, for which the format has no number: the colour gets darker and the reflection (Fresnel0) takes it on",
    );
    let is_phong = |material: &&&Material| matches!(material.reflectance, Reflectance::Phong { .. });
    let phong = materials.iter().filter(is_phong).count();
    if dialect == Dialect::D3d12 {
        losses.all.count(
            "phong-to-fresnel",
            phong,
            IS,
            "of the DirectX 11 book: Fresnel0 is a twentieth of Specular, with Reflectivity for the rest; Roughness^4 is 2 / (SpecPower + 2) \
             (Walter and others 2007); Ambient is left out.",
        );
    } else {
        losses.all.count(
            "fresnel-to-phong",
            materials.len() - phong,
            IS,
            "not of the DirectX 11 book: Diffuse, Specular and SpecPower are those with which its light comes nearest to the other book's; \
             Ambient is what was Diffuse.",
        );
    }
    losses.add(
        "alpha-blend",
        &|material| material.alpha == AlphaMode::Blend,
        IS,
        "transparent by blending and drawn opaque",
    );
    losses.add(
        "alpha-cutoff",
        &|material| matches!(material.alpha, AlphaMode::Mask { cutoff } if cutoff != Material::ALPHA_CLIP),
        IS,
        &format!("cut out at another alpha than the books' {}", Material::ALPHA_CLIP),
    );
    losses.add(
        "opacity",
        &|material| material.opacity != 1.0,
        HAS,
        "an alpha beside the colour, which the format has not",
    );
    // A book's own material is drawn from both sides here, whatever its demo does.
    let has_sides = |material: &Material| matches!(material.reflectance, Reflectance::MetallicRoughness { .. });
    losses.add(
        "double-sided",
        &|material| has_sides(material) && material.double_sided && !material.is_cut(),
        IS,
        "two-sided (without backface culling), and back faces will not be drawn",
    );
    losses.add(
        "double-sided",
        &|material| has_sides(material) && !material.double_sided && material.is_cut(),
        IS,
        "one-sided, and back faces will be drawn, as the books do of what is cut out",
    );
    losses.add(
        "unlit",
        &|material| material.unlit,
        IS,
        "shown without light (unlit) in the file; here light falls on it",
    );
    losses.add(
        "emissive",
        &|material| material.emissive != [0.0; 3],
        HAS,
        "light of its own (emission), which the format has not",
    );
    losses.add(
        "layers",
        &|material| {
            let layers = &material.layers;
            layers.clearcoat > 0.0
                || layers.sheen_color != [0.0; 3]
                || layers.transmission > 0.0
                || material.specular_map.is_some()
        },
        HAS,
        "a clear coat, a sheen, transmission or a specular map, which the format has not",
    );
    losses.add(
        "normal-scale",
        &|material| material.normal_map.is_some() && material.normal_scale != 1.0,
        HAS,
        "a normal map of another strength than 1, which the format has not",
    );
}

/// What is said of one material, and of several.
type Verb = [&'static str; 2];
const IS: Verb = ["material is", "materials are"];
const HAS: Verb = ["material has", "materials have"];

/// Losses of materials, told with their names.
struct OfMaterials<'a> {
    materials: &'a [&'a Material],
    all: &'a mut Losses,
}

impl OfMaterials<'_> {
    fn add(&mut self, code: &'static str, is: &dyn Fn(&Material) -> bool, verb: Verb, what: &str) {
        let those = self.materials.iter().filter(|material| is(material));
        let names: Vec<&str> = those.map(|material| material.name.as_str()).collect();
        let count = names.len();
        self.all.count(code, count, verb, &format!("{what}: {}.", named(names)));
    }
}

fn maps(materials: &[&Material], losses: &mut Losses) {
    for (code, slot) in [
        ("metallic-roughness-map", MapSlot::MetallicRoughness),
        ("occlusion-map", MapSlot::Occlusion),
        ("emissive-map", MapSlot::Emissive),
    ] {
        let with: Vec<&str> = materials
            .iter()
            .filter(|material| material.map(slot).is_some())
            .map(|material| material.name.as_str())
            .collect();
        let (one, many) = (format!("{} is", slot.label()), format!("{}s are", slot.label()));
        losses.count(
            code,
            with.len(),
            [&one, &many],
            &format!("left out; the format has diffuse and normal maps: of {}.", named(with)),
        );
    }
    let places = materials
        .iter()
        .flat_map(|material| [MapSlot::Diffuse, MapSlot::Normal].map(|slot| (*material, slot)));
    let sampled = places.filter_map(|(material, slot)| {
        let how = otherwise(&material.map(slot)?.sampling)?;
        Some(format!("{} of {} ({how})", slot.label(), quoted(&material.name)))
    });
    let sampled: Vec<String> = sampled.collect();
    losses.count(
        "map-sampling",
        sampled.len(),
        ["map lies", "maps lie"],
        &format!(
            "on the model otherwise than in the books, which repeat a map by the first UVs as they are: {}.",
            few(&sampled)
        ),
    );
}

/// What of a map's place and look the books' format does not say, in a few words.
fn otherwise(sampling: &Sampling) -> Option<String> {
    let Sampling {
        second_tex_coords,
        map_from_mesh,
        wrap,
        nearest,
        ..
    } = Sampling::default();
    let parts = [
        (sampling.second_tex_coords != second_tex_coords, "second UV map"),
        (sampling.map_from_mesh != map_from_mesh, "moved, turned or scaled UVs"),
        (sampling.wrap != wrap, "does not repeat at its edges"),
        (sampling.nearest != nearest, "hard pixels"),
    ];
    let said: Vec<&str> = parts.iter().filter(|part| part.0).map(|part| part.1).collect();
    (!said.is_empty()).then(|| said.join(", "))
}
