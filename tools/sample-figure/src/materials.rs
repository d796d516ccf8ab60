//! Which part of the skin is made of what. Borders are level sets, so that the mesh can be snapped to them.

use bindpose::format;
use glam::DVec3;

use crate::body::{Body, Part};
use crate::maps;
use crate::rig::{ARM, Limb, PALM, Rig, Side};

/// Where the crown begins that closes the helmet, metres above the ground.
pub(crate) const CROWN_HEIGHT: f64 = 1.735;
/// Where the yoke begins that lies over the shoulders, metres above the ground.
pub(crate) const YOKE_HEIGHT: f64 = 1.392;

/// A region of the skin; the first of [`Region::BORDERED`] that contains a point owns it, the suit owns the rest. What is
/// sewn or moulded as one piece is one region, so that texture seams run where real ones would.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Region {
    Visor,
    Sole,
    Foot,
    Boot,
    Palm,
    Hand,
    Cuff,
    EarCup,
    Neck,
    Crown,
    Helmet,
    Pack,
    Badge,
    KneePad,
    Stripe,
    Belt,
    Sleeve,
    Yoke,
    Gusset,
    Leg,
    Trunk,
}

/// One of the file's materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Material {
    Suit,
    Shell,
    Trim,
    Rubber,
    Visor,
}

impl Region {
    const BORDERED: [Region; 20] = [
        Region::Visor,
        Region::Sole,
        Region::Foot,
        Region::Boot,
        Region::Palm,
        Region::Hand,
        Region::Cuff,
        Region::EarCup,
        Region::Neck,
        Region::Crown,
        Region::Helmet,
        Region::Pack,
        Region::Badge,
        Region::KneePad,
        Region::Stripe,
        Region::Belt,
        Region::Sleeve,
        Region::Yoke,
        Region::Gusset,
        Region::Leg,
    ];

    /// What it is made of.
    pub(crate) fn material(self) -> Material {
        match self {
            Region::Visor | Region::Badge => Material::Visor,
            Region::Crown | Region::Helmet => Material::Shell,
            Region::Foot
            | Region::Boot
            | Region::Hand
            | Region::Cuff
            | Region::Pack
            | Region::EarCup
            | Region::Stripe => Material::Trim,
            Region::Sole | Region::Palm | Region::Neck | Region::Belt | Region::KneePad => Material::Rubber,
            Region::Sleeve | Region::Yoke | Region::Gusset | Region::Leg | Region::Trunk => Material::Suit,
        }
    }

    /// The region that owns `point`.
    pub(crate) fn of(body: &Body, rig: &Rig, point: DVec3) -> Region {
        let owner = Region::BORDERED
            .into_iter()
            .find(|region| region.border(body, rig, point) < 0.0);
        owner.unwrap_or(Region::Trunk)
    }

    /// Negative inside, about metres near the border. The trunk has no border of its own.
    pub(crate) fn border(self, body: &Body, rig: &Rig, point: DVec3) -> f64 {
        let band = |y: f64, middle: f64, half: f64| (y - middle).abs() - half;
        let on_left = DVec3::new(point.x.abs(), point.y, point.z);
        let along_arm = |limb| (on_left - rig.origin(Side::Left, limb)).dot(ARM);
        match self {
            Region::Visor => visor(point),
            Region::Sole => point.y - 0.042,
            Region::Foot => point.y - 0.128,
            Region::Boot => point.y - 0.268,
            // Planes across the arm cut the legs too, but those are nearer to the middle.
            Region::Palm => {
                let from_wrist = on_left - rig.origin(Side::Left, Limb::Hand);
                (0.004 - from_wrist.dot(PALM))
                    .max(0.012 - from_wrist.dot(ARM))
                    .max(0.3 - on_left.x)
            }
            Region::Hand => (-0.024 - along_arm(Limb::Hand)).max(0.3 - on_left.x),
            Region::Cuff => (-0.108 - along_arm(Limb::Hand)).max(0.3 - on_left.x),
            Region::Crown => CROWN_HEIGHT - point.y,
            Region::Helmet => 1.45 - point.y,
            Region::Neck => (1.443 - point.y).max(0.011 - body.part_distance(Part::Helmet, point)),
            Region::Pack => body.part_distance(Part::Pack, point) - 0.009,
            Region::Badge => badge(point),
            Region::EarCup => body.part_distance(Part::EarCups, point) - 0.005,
            Region::KneePad => knee_pad(on_left - rig.origin(Side::Left, Limb::Shin)),
            Region::Stripe => band(along_arm(Limb::UpperArm), 0.125, 0.03)
                .max(0.2 - on_left.x)
                .max(1.1 - point.y),
            Region::Belt => band(point.y, 0.995, 0.02).max(on_left.x - 0.25),
            // Upright planes round the armholes. The hips reach as far out but lie lower, the hands lie further out.
            Region::Sleeve => (0.166 - on_left.x).max(1.1 - point.y - 4.0 * (on_left.x - 0.25).max(0.0)),
            Region::Yoke => YOKE_HEIGHT - point.y,
            Region::Gusset => point.distance(DVec3::new(0.0, 0.748, 0.003)) - 0.042,
            // From the crotch outwards and up.
            Region::Leg => point.y - 0.79 - 0.7 * on_left.x,
            Region::Trunk => 1.0,
        }
    }
}

/// A rounded pane in front of the face.
fn visor(point: DVec3) -> f64 {
    let (x, y) = (point.x / 0.126, (point.y - 1.618) / 0.083);
    // Between a circle and a square.
    let pane = ((x * x * x * x + y * y * y * y).sqrt().sqrt() - 1.0) * 0.08;
    pane.max(point.z)
}

/// A disc on the breast.
fn badge(point: DVec3) -> f64 {
    let (x, y) = (point.x, point.y - 1.275);
    ((x * x + y * y).sqrt() - 0.05).max(point.z)
}

/// An oval in front of the left knee.
fn knee_pad(from_knee: DVec3) -> f64 {
    let (x, y) = (from_knee.x / 0.047, from_knee.y / 0.06);
    (((x * x + y * y).sqrt() - 1.0) * 0.05).max(from_knee.z)
}

impl Material {
    /// In the order of the file's subsets.
    pub(crate) const ALL: [Material; 5] = [
        Material::Suit,
        Material::Shell,
        Material::Trim,
        Material::Rubber,
        Material::Visor,
    ];

    /// The file's words; diffuse colours are as they are shown, sRGB. They are right without the maps too, which stay near white.
    pub(crate) fn entry(self) -> format::Material {
        let (name, diffuse, fresnel0, roughness, [diffuse_map, normal_map]) = match self {
            Material::Suit => ("Suit", [0.8489, 0.8323, 0.8036], [0.04; 3], 0.62, maps::SUIT),
            Material::Shell => ("Shell", [0.8434, 0.8489, 0.8489], [0.05; 3], 0.28, maps::TRIM),
            Material::Trim => ("Trim", [0.9163, 0.522, 0.2348], [0.04; 3], 0.45, maps::TRIM),
            Material::Rubber => ("Rubber", [0.2828, 0.2934, 0.3133], [0.04; 3], 0.6, maps::RUBBER),
            Material::Visor => ("Visor", [0.1121, 0.1517, 0.2029], [0.09, 0.1, 0.12], 0.12, maps::VISOR),
        };
        format::Material {
            name: name.into(),
            diffuse,
            reflectance: format::Reflectance::Fresnel { fresnel0, roughness },
            alpha_clip: false,
            type_name: "Skinned".into(),
            diffuse_map: Some(diffuse_map.into()),
            normal_map: Some(normal_map.into()),
        }
    }
}
