//! The meshes of a scene, and the skins that move them.

use glam::DAffine3;

use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::gltf::{Fault, Reader, Root, Wanted, fault, out_of_range};
use crate::import::offsets::{self, Words};
pub(super) use crate::import::scene::Rig;
use crate::import::scene::{MeshUse, Scene, Skin};
use crate::model::Skeleton;
use crate::sorting;

const INVERSE_BIND_MATRICES: Words = Words {
    one_has: "inverse bind matrix has",
    many_have: "inverse bind matrices have",
    not_affine: ("a fourth row that is not 0 0 0 1; it was left out.", 1e-6),
    singular: "no inverse; the joint's place in the bind pose is unknown.",
};

/// Finds the meshes of a scene.
///
/// # Errors
/// When a node names a mesh or a skin that is not there.
pub(super) fn find_meshes(root: &Root, scene: &mut Scene, diagnostics: &mut Diagnostics) -> Result<(), Fault> {
    for (node, of_file) in (0u32..).zip(root.nodes()) {
        let pointer = |key: &str| format!("/nodes/{node}/{key}");
        let mut broken = |key: &str, message: String| {
            diagnostics.add(&codes::GLTF_RULE_BROKEN, Place::pointer(pointer(key)), message);
        };
        let skin = match of_file.skin {
            None => None,
            Some(skin) => match usize::try_from(skin.0)
                .ok()
                .and_then(|index| Some((index, root.skins().get(index)?)))
            {
                None => return Err(out_of_range(&pointer("skin"), "skin", skin.0, root.skins().len())),
                Some((_, skin)) if skin.joints.is_empty() => {
                    broken(
                        "skin",
                        format!("The skin of node {node} has no joints; the mesh follows its node."),
                    );
                    None
                }
                Some((index, _)) => Some(index),
            },
        };
        let Some(mesh) = of_file.mesh else {
            if skin.is_some() {
                broken("skin", format!("Node {node} has a skin, but no mesh."));
            }
            continue;
        };
        let index = usize::try_from(mesh.0)
            .ok()
            .filter(|&index| index < root.meshes().len());
        let Some(mesh) = index else {
            return Err(out_of_range(&pointer("mesh"), "mesh", mesh.0, root.meshes().len()));
        };
        if !scene.nodes[node as usize].in_scene {
            continue;
        }
        let parts = || root.meshes()[mesh].primitives.iter();
        let is_weighted = parts().any(|part| part.attributes.contains_key("JOINTS_0"));
        if skin.is_some() && !is_weighted {
            broken(
                "skin",
                format!("Node {node} has a skin, but its mesh has no weights; the mesh follows its node."),
            );
        }
        let skin = skin.filter(|_| is_weighted);
        let is_on_node = skin.is_none() || parts().any(|part| !part.attributes.contains_key("JOINTS_0"));
        scene.uses.push(MeshUse {
            mesh,
            node,
            skin,
            is_on_node,
        });
    }
    sorting::sort(&mut scene.uses);
    Ok(())
}

/// Reads the skins of a scene that has its meshes. The skeleton of all.
///
/// # Errors
/// When a skin names what is not there, or its matrices cannot be read.
pub(super) fn rig(
    root: &Root,
    reader: &Reader<'_>,
    scene: &mut Scene,
    diagnostics: &mut Diagnostics,
) -> Result<Rig, Fault> {
    scene.skins = vec![None; root.skins().len()];
    let wanted = match scene.uses.is_empty() {
        true => (0..root.skins().len()).collect(),
        false => scene.used_skins(),
    };
    for &skin in &wanted {
        scene.skins[skin] = Some(Skin {
            joints: joints(root, skin)?,
            joint_from_mesh: Vec::new(),
        });
    }
    for skin in scene.uses.iter().filter_map(|mesh| mesh.skin) {
        if let Some(read) = scene.skins[skin]
            .as_mut()
            .filter(|read| read.joint_from_mesh.is_empty())
        {
            read.joint_from_mesh = inverse_bind_matrices(root, reader, skin, diagnostics)?;
        }
    }
    let rig = Rig::new(scene)?;
    check_count(rig.joint_of_node.iter().flatten().count(), "/nodes")?;
    check_count(rig.skeleton.joint_count(), "/skins")?;
    for skin in scene.used_skins() {
        let mut joints = scene.skins[skin].iter().flat_map(|skin| &skin.joints);
        if let Some(outside) = joints.find(|&&node| !scene.nodes[node as usize].in_scene) {
            let message = format!("Joint node {outside} of skin {skin} is not in the scene; it is taken all the same.");
            let place = Place::pointer(format!("/skins/{skin}/joints"));
            diagnostics.add(&codes::GLTF_RULE_BROKEN, place, message);
        }
    }
    Ok(rig)
}

/// The nodes of a skin's joints.
fn joints(root: &Root, skin: usize) -> Result<Vec<u32>, Fault> {
    let count = root.nodes().len();
    let joints = root.skins()[skin].joints.iter().enumerate();
    let joints = joints.map(|(slot, node)| match u32::try_from(node.0) {
        Ok(index) if (index as usize) < count => Ok(index),
        _ => {
            let pointer = format!("/skins/{skin}/joints/{slot}");
            Err(out_of_range(&pointer, "node", node.0, count))
        }
    });
    joints.collect()
}

/// Refuses more joints than a vertex can name.
fn check_count(joints: usize, pointer: &str) -> Result<(), Fault> {
    if joints <= Skeleton::MOST_NAMED {
        return Ok(());
    }
    let most = Skeleton::MOST_NAMED;
    let message = format!("The skeleton has {joints} joints; vertices of glTF can name {most} at most.");
    Err(fault(&codes::GLTF_TOO_LARGE, pointer, message))
}

/// The matrices of a skin, one for each of its joints; identities where it has none.
fn inverse_bind_matrices(
    root: &Root,
    reader: &Reader<'_>,
    skin: usize,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<DAffine3>, Fault> {
    let of_file = &root.skins()[skin];
    let pointer = format!("/skins/{skin}/inverseBindMatrices");
    let Some(accessor) = of_file.inverse_bind_matrices else {
        return Ok(vec![DAffine3::IDENTITY; of_file.joints.len()]);
    };
    let rows = reader.floats::<16>(accessor, Wanted::Floats, &pointer)?;
    if rows.len() < of_file.joints.len() {
        let message = format!(
            "Skin {skin} has {} joints, but {} inverse bind matrices.",
            of_file.joints.len(),
            rows.len()
        );
        return Err(fault(&codes::GLTF_ACCESSOR_OUT_OF_RANGE, pointer, message));
    }
    let rows = rows.iter().take(of_file.joints.len());
    let place = |_: &_| Place::pointer(pointer.clone());
    Ok(offsets::mended(rows, &INVERSE_BIND_MATRICES, place, diagnostics))
}
