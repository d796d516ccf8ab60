//! What the books' format does not hold.

use super::document::{names_materials, of_subsets, rests_apart};
use crate::anim::STRAIGHT_ERROR;
use crate::diagnostic::codes;
use crate::diagnostic::collect::counted;
use crate::export::Loss;
use crate::export::losses::Losses;
use crate::format::Dialect;
use crate::model::{
    AlphaMode, Front, JointIndex, JointNames, LocalJoint, MapSlot, Material, MaterialMap, Model, Reflectance, Sampling,
    Track, UpAxis, one_word,
};

/// Bones that the shaders of the books have room for.
const MOST_BONES: usize = 96;

/// The highest bone that the books' loaders keep: they store it in a byte.
const MOST_BONE_INDEX: u32 = 255;

/// Vertices that the books' 16-bit indices name.
const MOST_VERTICES: usize = 1 << 16;

/// What a file of this dialect does not hold of a model, or holds otherwise. `names` are names that a person gave to bones.
pub fn m3d_losses(model: &Model, names: &JointNames, dialect: Dialect) -> Vec<Loss> {
    let mut losses = Losses::default();
    space(model, dialect, &mut losses);
    mesh(model, &mut losses);
    skeleton(model, names, &mut losses);
    keys(model, &mut losses);
    subsets(model, &mut losses);
    single_words(model, dialect, &mut losses);
    let materials: Vec<&Material> = of_subsets(model).collect();
    surfaces(&materials, dialect, &mut losses);
    maps(&materials, &mut losses);
    losses.0
}

fn space(model: &Model, dialect: Dialect, losses: &mut Losses) {
    let up_axis = match dialect {
        Dialect::Imm => UpAxis::Z,
        Dialect::D3d11 | Dialect::D3d12 => UpAxis::Y,
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
            "Characters of the model face the positive axis, as in glTF; those of the format face the negative one."
                .into(),
        );
    }
}

fn mesh(model: &Model, losses: &mut Losses) {
    let mesh = &model.mesh;
    let vertices = |count| counted(count, "vertex has", "vertices have");
    losses.add(
        "vertex-colors",
        mesh.colors.len(),
        format!("{} a colour; the format has none.", vertices(mesh.colors.len())),
    );
    let second = mesh.second_tex_coords.len();
    losses.add(
        "second-tex-coords",
        second,
        format!(
            "{} second texture coordinates; the format has one set.",
            vertices(second)
        ),
    );
    let beyond = mesh.vertex_count().saturating_sub(MOST_VERTICES);
    losses.add(
        codes::MANY_VERTICES.name,
        beyond,
        format!(
            "{} beyond the {MOST_VERTICES} that the books' 16-bit indices name.",
            counted(beyond, "vertex is", "vertices are")
        ),
    );
}

fn skeleton(model: &Model, names: &JointNames, losses: &mut Losses) {
    let skeleton = &model.skeleton;
    let named = (0u32..)
        .zip(skeleton.file_bones())
        .filter(|&(joint, &bone)| skeleton.name(JointIndex(joint)).is_some() || names.get(bone).is_some())
        .count();
    losses.add(
        "joint-names",
        named,
        format!(
            "{} a name; the format numbers its bones.",
            counted(named, "bone has", "bones have")
        ),
    );
    let beyond = skeleton.joint_count().saturating_sub(MOST_BONES);
    losses.add(
        codes::MANY_BONES.name,
        beyond,
        format!(
            "{} beyond the {MOST_BONES} that the books' shaders have room for.",
            counted(beyond, "bone is", "bones are")
        ),
    );
    let is_above = |influences: &&crate::model::Influences| {
        let slots = influences.joints.iter().zip(influences.weights);
        let mut used = slots.filter(|(_, weight)| *weight > 0.0);
        used.any(|(&joint, _)| skeleton.file_bones()[joint as usize] > MOST_BONE_INDEX)
    };
    let above = model.mesh.influences.iter().filter(is_above).count();
    losses.add(
        codes::BONE_INDEX_ABOVE_BYTE.name,
        above,
        format!(
            "{} a bone above {MOST_BONE_INDEX}, of which the books' loaders keep a byte.",
            counted(above, "vertex names", "vertices name")
        ),
    );
    let apart = rests_apart(model).iter().flatten().count();
    losses.add(
        "rest-pose",
        apart,
        format!(
            "{} elsewhere than in the bind pose. In clips without keys for them they get one; without a clip the bind pose is seen.",
            counted(apart, "bone rests", "bones rest")
        ),
    );
}

fn keys(model: &Model, losses: &mut Losses) {
    let curved = |is: fn(&Track) -> bool| {
        let tracks = model.clips.iter().flat_map(|clip| &clip.tracks);
        tracks.filter(|track| is(track)).count()
    };
    let stepped = curved(|track| track.curves().is_some_and(|curves| curves.holds()));
    losses.add(
        "step-keys",
        stepped,
        format!(
            "{} from key to key; each such key becomes two, the second just before the next.",
            counted(stepped, "track holds its values", "tracks hold their values")
        ),
    );
    let cubic = curved(|track| track.curves().is_some_and(|curves| curves.bends()));
    losses.add(
        "cubic-keys",
        cubic,
        format!(
            "{} splines; straight pieces take their place, off by at most {STRAIGHT_ERROR:e} of what a track ranges over, of rotations \
             that angle in radians.",
            counted(cubic, "track follows", "tracks follow")
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
    losses.add(
        codes::TRACK_EMPTY.name,
        empty,
        format!(
            "{} no keys in a clip and {} none; the books' demos need one. Without `--keep-empty` each gets one at rest.",
            counted(empty, "bone has", "bones have"),
            if empty == 1 { "gets" } else { "get" }
        ),
    );
}

fn subsets(model: &Model, losses: &mut Losses) {
    let mut uses = vec![0_usize; model.materials.len()];
    for submesh in &model.mesh.submeshes {
        uses[submesh.material as usize] += 1;
    }
    let shared: usize = uses.iter().map(|uses| uses.saturating_sub(1)).sum();
    losses.add(
        "materials-shared",
        shared,
        format!(
            "{} a material with another; each gets a copy, since subset i is drawn with material i.",
            counted(shared, "subset shares", "subsets share")
        ),
    );
    let unused = uses.iter().filter(|uses| **uses == 0).count();
    losses.add(
        "materials-unused",
        unused,
        format!(
            "{} left out, since no subset is drawn with it.",
            counted(unused, "material is", "materials are")
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
    losses.add(
        "names-of-one-word",
        count,
        format!(
            "{} more than one word; the books' loaders read names to the first blank, so blanks become underscores.",
            counted(
                count,
                "name of a clip, material or map has",
                "names of clips, materials and maps have"
            )
        ),
    );
    let named = (0..).zip(of_subsets(model)).filter(is_named);
    let unnamed = if names_materials(dialect) { 0 } else { named.count() };
    losses.add(
        "material-names",
        unnamed,
        format!(
            "{} a name; the dialect has none.",
            counted(unnamed, "material has", "materials have")
        ),
    );
}

/// Whether a material is called otherwise than one without a name is shown.
fn is_named((index, material): &(usize, &Material)) -> bool {
    material.name != format!("material {index}")
}

fn surfaces(materials: &[&Material], dialect: Dialect, losses: &mut Losses) {
    let count = |is: &dyn Fn(&Material) -> bool| materials.iter().filter(|material| is(material)).count();
    let are = |count| counted(count, "material is", "materials are");
    let have = |count| counted(count, "material has", "materials have");

    let metallic = count(
        &|material| matches!(material.reflectance, Reflectance::MetallicRoughness { metallic, .. } if metallic > 0.0),
    );
    losses.add(
        "metallic-roughness",
        metallic,
        format!(
            "{} metalness, which the format has not: Fresnel0 is mix(0.04, diffuse, metalness), diffuse is multiplied by 1 − metalness (glTF \
             2.0, appendix B).",
            have(metallic)
        ),
    );
    let phong = count(&|material| matches!(material.reflectance, Reflectance::Phong { .. }));
    if dialect == Dialect::D3d12 {
        losses.add(
            "phong-to-fresnel",
            phong,
            format!(
                "{} of the DirectX 11 book: Fresnel0 is a twentieth of Specular, with Reflectivity for the rest; Roughness^4 is 2 / (SpecPower + \
                 2) (Walter and others 2007); Ambient is left out.",
                are(phong)
            ),
        );
    } else {
        let fresnel = materials.len() - phong;
        losses.add(
            "fresnel-to-phong",
            fresnel,
            format!(
                "{} not of the DirectX 11 book: Diffuse, Specular and SpecPower are those with which its light comes nearest to the other \
                 book's; Ambient is what was Diffuse.",
                are(fresnel)
            ),
        );
    }
    let blended = count(&|material| material.alpha == AlphaMode::Blend);
    losses.add(
        "alpha-blend",
        blended,
        format!("{} blended; drawn opaque.", are(blended)),
    );
    let cutoffs =
        count(&|material| matches!(material.alpha, AlphaMode::Mask { cutoff } if cutoff != Material::ALPHA_CLIP));
    losses.add(
        "alpha-cutoff",
        cutoffs,
        format!(
            "{} cut at another alpha than the books' {}.",
            are(cutoffs),
            Material::ALPHA_CLIP
        ),
    );
    let opacity = count(&|material| material.opacity != 1.0);
    losses.add(
        "opacity",
        opacity,
        format!("{} an alpha beside its colour; the format has none.", have(opacity)),
    );
    let sides = count(&|material| material.double_sided != material.is_cut());
    losses.add(
        "double-sided",
        sides,
        format!(
            "{} sides that the format cannot say: what alpha cuts has two there, all else has one.",
            have(sides)
        ),
    );
    let unlit = count(&|material| material.unlit);
    losses.add("unlit", unlit, format!("{} shown without light; lit here.", are(unlit)));
    let emissive = count(&|material| material.emissive != [0.0; 3]);
    losses.add(
        "emissive",
        emissive,
        format!("{} light of its own; the format has none.", have(emissive)),
    );
    let bent = count(&|material| material.normal_map.is_some() && material.normal_scale != 1.0);
    losses.add(
        "normal-scale",
        bent,
        format!("{} a normal map of another strength than 1.", have(bent)),
    );
}

fn maps(materials: &[&Material], losses: &mut Losses) {
    let count = |of: &[MapSlot], is: &dyn Fn(&MaterialMap) -> bool| {
        let maps = materials
            .iter()
            .flat_map(|material| of.iter().filter_map(|&slot| material.map(slot)));
        maps.filter(|map| is(map)).count()
    };
    for (code, slot) in [
        ("metallic-roughness-map", MapSlot::MetallicRoughness),
        ("occlusion-map", MapSlot::Occlusion),
        ("emissive-map", MapSlot::Emissive),
    ] {
        let maps = count(&[slot], &|_| true);
        let (one, many) = (format!("{} is", slot.label()), format!("{}s are", slot.label()));
        losses.add(
            code,
            maps,
            format!(
                "{} left out; the format has diffuse and normal maps.",
                counted(maps, &one, &many)
            ),
        );
    }
    let kept = [MapSlot::Diffuse, MapSlot::Normal];
    let sampled = count(&kept, &|map| map.sampling != Sampling::default());
    losses.add(
        "map-sampling",
        sampled,
        format!(
            "{} with texture coordinates, edges or a filter of its own; the books' maps repeat as they are.",
            counted(sampled, "map is sampled", "maps are sampled")
        ),
    );
}
