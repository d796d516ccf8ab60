//! A layer of a stack: curves of nodes, and how they come over the layers below.

use std::borrow::Cow;
use std::collections::HashMap;
use std::rc::Rc;

use glam::DVec3;

use crate::diagnostic::Fault;
use crate::diagnostic::collect::shortened;
use crate::fbx::Record;
use crate::import::fbx::curves::Curve;
use crate::import::fbx::file::File;
use crate::import::fbx::nodes::Nodes;
use crate::import::fbx::objects::{Connection, Object, ObjectIndex, Objects};
use crate::import::fbx::transform::{Parts, Transform};

/// What is kept at most where a curve node hangs on something, in each layer that has it.
const BYTES_PER_CONNECTION: u64 = 256;

/// What curves move of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Property {
    Translation,
    Rotation,
    Scale,
}

impl Property {
    pub(super) const ALL: [Self; 3] = [Self::Translation, Self::Rotation, Self::Scale];

    fn named(name: &str) -> Option<Self> {
        match name {
            "Lcl Translation" | "T" => Some(Self::Translation),
            "Lcl Rotation" | "R" => Some(Self::Rotation),
            "Lcl Scaling" | "S" => Some(Self::Scale),
            _ => None,
        }
    }

    fn of(self, parts: &mut Parts) -> &mut DVec3 {
        match self {
            Self::Translation => &mut parts.translation,
            Self::Rotation => &mut parts.rotation,
            Self::Scale => &mut parts.scale,
        }
    }
}

/// A curve for each axis, and what stands where there is none.
#[derive(Clone, Debug, Default)]
struct Axes {
    curves: [Option<Rc<Curve>>; 3],
    without: [Option<f64>; 3],
}

/// What a layer moves of a model, by [`Property`].
#[derive(Clone, Debug, Default)]
pub(super) struct Moved([Option<Axes>; 3]);

impl Moved {
    fn of(&self, property: Property) -> Option<&Axes> {
        self.0[property as usize].as_ref()
    }

    fn has_keys(&self) -> bool {
        let mut curves = self.0.iter().flatten().flat_map(|axes| axes.curves.iter().flatten());
        curves.any(|curve| curve.times_secs().next().is_some())
    }
}

/// How a layer comes over those below: Autodesk's `FbxAnimLayer::EBlendMode`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Blend {
    #[default]
    Additive,
    Override,
    OverrideThrough,
}

/// A layer.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    blend: Blend,
    /// Of the layer, 0…1.
    weight: f64,
    weight_curve: Option<Rc<Curve>>,
    /// Metres of a unit of its translations.
    unit_metres: f64,
    /// Whether rotations follow each other, where angles add up otherwise; and whether scales multiply.
    turns: bool,
    multiplies: bool,
    /// Of each model.
    moved: HashMap<u32, Moved>,
}

/// A property of an object, as it is told.
fn property_of(name: &str, property: &str) -> String {
    format!("{}, {property}", shortened(name))
}

impl Layer {
    /// A layer of 7.x.
    ///
    /// # Errors
    /// When an array of a curve is damaged, or the budget has no room for what is moved.
    pub(super) fn read(
        (file, curves): (&mut File<'_, '_>, &mut HashMap<ObjectIndex, Rc<Curve>>),
        objects: &Objects<'_, '_>,
        nodes: &Nodes,
        (index, layer): (ObjectIndex, &Object<'_, '_>),
    ) -> Result<Self, Fault> {
        let mut moved: HashMap<u32, Moved> = HashMap::new();
        let mut weight_curve = None;
        for (_, curve_node) in objects.children(layer, "AnimationCurveNode") {
            let connections = curve_node.children.len() + curve_node.parents.len();
            file.budget
                .keep(BYTES_PER_CONNECTION * connections as u64, curve_node.record.place)?;
            let moves =
                |parent: &Connection<'_>| Some((node_of(nodes, parent.to)?, Property::named(&parent.property)?));
            let first = curve_node.parents.iter().find(|parent| moves(parent).is_some());
            let of = || match first {
                Some(parent) => property_of(&objects.get(parent.to).name, &parent.property),
                None => shortened(&curve_node.name).into_owned(),
            };
            let mut axes = Axes {
                without: ["d|X", "d|Y", "d|Z"].map(|name| curve_node.number(name).filter(|number| number.is_finite())),
                ..Axes::default()
            };
            for child in objects.hanging(curve_node, "AnimationCurve") {
                let axis = match &*child.property {
                    "d|X" | "d|Weight" => 0,
                    "d|Y" => 1,
                    "d|Z" => 2,
                    _ => continue,
                };
                let known = match curves.get(&child.to) {
                    Some(known) => Rc::clone(known),
                    None => Rc::new(Curve::read(objects.get(child.to).record, file, &of)?),
                };
                curves.insert(child.to, Rc::clone(&known));
                axes.curves[axis] = Some(known);
            }
            for parent in &curve_node.parents {
                match moves(parent) {
                    Some((model, property)) => {
                        moved.entry(model).or_default().0[property as usize] = Some(axes.clone());
                    }
                    None if parent.property == "Weight" && parent.to == index => weight_curve = axes.curves[0].clone(),
                    None => (),
                }
            }
        }
        Ok(Self {
            blend: match layer.integer("BlendMode") {
                Some(1) => Blend::Override,
                Some(2) => Blend::OverrideThrough,
                _ => Blend::Additive,
            },
            weight: part_of(layer.number("Weight").unwrap_or(100.0)),
            weight_curve,
            turns: layer.integer("RotationAccumulationMode").unwrap_or(0) == 0,
            multiplies: layer.integer("ScaleAccumulationMode").unwrap_or(0) == 0,
            unit_metres: file.settings.unit_metres,
            moved,
        })
    }

    /// The one layer of a take of 6.1.
    pub(super) fn of_take(
        take: &Record<'_>,
        file: &mut File<'_, '_>,
        objects: &Objects<'_, '_>,
        nodes: &Nodes,
    ) -> Self {
        let mut moved: HashMap<u32, Moved> = HashMap::new();
        for model in take.all("Model") {
            let object = model.bytes(0).and_then(|name| objects.named(name));
            let Some((object, node)) = object.and_then(|object| Some((object, node_of(nodes, object)?))) else {
                continue;
            };
            let transform = model.all("Channel").filter(|channel| named(channel) == "Transform");
            for channel in transform.flat_map(|transform| transform.all("Channel")) {
                let channel_name = named(channel);
                let Some(property) = Property::named(&channel_name) else {
                    continue;
                };
                let of = || property_of(&objects.get(object).name, &channel_name);
                let mut axes = Axes::default();
                for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
                    let Some(of_axis) = channel.all("Channel").find(|channel| named(channel) == name) else {
                        continue;
                    };
                    axes.without[axis] = of_axis.find("Default").and_then(|default| default.number(0));
                    let curve = Curve::read_take(of_axis, file, &of);
                    axes.curves[axis] = Some(Rc::new(curve)).filter(|curve| curve.times_secs().next().is_some());
                }
                moved.entry(node).or_default().0[property as usize] = Some(axes);
            }
        }
        Self {
            moved,
            unit_metres: file.settings.unit_metres,
            ..Self::default()
        }
    }

    /// Whether no curve moves a model.
    pub(super) fn is_empty(&self) -> bool {
        self.models().next().is_none()
    }

    /// The models that a curve moves.
    pub(super) fn models(&self) -> impl Iterator<Item = u32> + '_ {
        let moved = self.moved.iter().filter(|(_, moved)| moved.has_keys());
        moved.map(|(&model, _)| model)
    }

    /// The models that it says something of.
    pub(super) fn moved(&self) -> impl ExactSizeIterator<Item = (u32, &Moved)> {
        self.moved.iter().map(|(&model, moved)| (model, moved))
    }

    /// The times of the keys of some properties of a model, again and again where curves repeat them within a span.
    pub(super) fn times_secs<'s>(
        &'s self,
        moved: &'s Moved,
        properties: &'s [Property],
        span: Option<[f64; 2]>,
    ) -> impl Iterator<Item = f64> + 's {
        let axes = properties.iter().filter_map(|&property| moved.of(property));
        let curves = axes.flat_map(|axes| axes.curves.iter().flatten());
        // How much of a layer counts changes what it moves.
        let has_any = curves.clone().next().is_some();
        curves
            .chain(self.weight_curve.iter().filter(move |_| has_any))
            .flat_map(move |curve| curve.times_within(span))
    }

    /// Brings what it has of some properties over the parts of a node, at a time or just before it; the lowest layer replaces them.
    pub(super) fn add_to(
        &self,
        parts: &mut Parts,
        (moved, properties): (&Moved, &[Property]),
        transform: &Transform,
        (secs, is_before): (f64, bool),
        is_lowest: bool,
    ) {
        for &property in properties {
            let Some(axes) = moved.of(property) else { continue };
            let below = property.of(parts);
            let is_over = !is_lowest && self.blend == Blend::Additive;
            // Where it says nothing of an axis, it adds nothing.
            let nothing = match property {
                Property::Scale if self.multiplies => DVec3::ONE,
                _ => DVec3::ZERO,
            };
            let mut value = if is_over { nothing } else { *below };
            let unit = if property == Property::Translation {
                self.unit_metres
            } else {
                1.0
            };
            for axis in 0..3 {
                let curve = axes.curves[axis].as_ref().and_then(|curve| curve.at(secs, is_before));
                if let Some(number) = curve.or(axes.without[axis]) {
                    value[axis] = number * unit;
                }
            }
            if is_lowest || (self.blend == Blend::Override && self.weight >= 1.0 && self.weight_curve.is_none()) {
                *below = value;
                continue;
            }
            let weight = self
                .weight_curve
                .as_ref()
                .and_then(|curve| curve.at(secs, is_before))
                .map_or(self.weight, part_of);
            *below = self.over(property, transform, [*below, value], weight);
        }
    }

    fn over(&self, property: Property, transform: &Transform, [below, value]: [DVec3; 2], weight: f64) -> DVec3 {
        let is_additive = self.blend == Blend::Additive;
        let kept = if is_additive { 1.0 } else { 1.0 - weight };
        match property {
            Property::Scale if self.multiplies => power(below, kept) * power(value, weight),
            Property::Rotation if self.turns => {
                let [below, value] = [below, value].map(|degrees| transform.order.rotation(degrees));
                let rotation = match is_additive {
                    true => below * glam::DQuat::IDENTITY.slerp(value, weight),
                    false => below.slerp(value, weight),
                };
                transform.order.degrees(rotation)
            }
            _ => below * kept + value * weight,
        }
    }
}

/// Of per cents.
fn part_of(percent: f64) -> f64 {
    let part = (percent / 100.0).clamp(0.0, 1.0);
    if part > 0.99999 { 1.0 } else { part }
}

/// Each number to this power, with its sign; to the power of 0 it is 1.
fn power(numbers: DVec3, exponent: f64) -> DVec3 {
    match exponent {
        0.0 => DVec3::ONE,
        1.0 => numbers,
        _ => numbers.map(|number| number.abs().powf(exponent) * number.signum()),
    }
}

/// Which node an object of a connection is.
fn node_of(nodes: &Nodes, object: ObjectIndex) -> Option<u32> {
    nodes.node_of[object.index()]
}

/// The name of a record's first value.
fn named<'s>(record: &'s Record<'_>) -> Cow<'s, str> {
    record.text(0).unwrap_or_default()
}
