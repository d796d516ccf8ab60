//! A geometry of a file: polygons with what their corners have, as triangles over vertices that differ in something.

use std::collections::HashMap;

use glam::Vec3;

use super::ears::triangulate;
use super::file::File;
use crate::diagnostic::collect::{counted, quoted};
use crate::diagnostic::{Fault, codes};
use crate::fbx::{Budget, Place, Record};
use crate::import::scene::Vertices;
use crate::slices::Slices;
use crate::sorting;

/// Triangles of one material, by its place among those of the node.
pub(super) struct Part {
    pub(super) material: usize,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// A geometry as vertices and triangles.
#[derive(Default)]
pub(super) struct Geometry {
    pub(super) vertices: Vertices,
    /// The control point of each vertex: weights are of these.
    pub(super) control_points: Vec<u32>,
    pub(super) control_point_count: usize,
    pub(super) parts: Vec<Part>,
    /// Polygons of one or two corners.
    pub(super) left_out: usize,
}

/// How the values of a layer belong to corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mapping {
    Corner,
    ControlPoint,
    Polygon,
    All,
}

/// Values of corners: normals, texture coordinates and so on.
struct Layer {
    mapping: Mapping,
    /// Which value each corner, control point or polygon has; empty where they are in that order themselves.
    indices: Vec<i64>,
    values: Vec<f64>,
    width: usize,
}

/// What is kept of a vertex, here and on each node that has its mesh: all its streams; and of a triangle.
pub(super) const BYTES_PER_VERTEX: u64 = 104;
pub(super) const BYTES_PER_TRIANGLE: u64 = 12;

/// In place of a vertex or a value where there is none.
const NONE: u32 = u32::MAX;

/// With so many vertices of its control point a corner is compared: in a file made to be slow they all differ.
const MOST_COMPARED: usize = 64;

/// Where a corner is.
#[derive(Clone, Copy)]
struct Corner {
    index: usize,
    control_point: u32,
    polygon: usize,
}

impl Layer {
    /// The layer of this name, such as `LayerElementNormal` with `Normals` and `NormalsIndex`, that the first `Layer` names, else the first; `None` where there
    /// is none, or by edges.
    async fn first(
        record: &Record<'_>,
        [layer, values, indices]: [&str; 3],
        width: usize,
        budget: &Budget,
        slices: &Slices,
    ) -> Result<Option<Self>, Fault> {
        let index = |record: &Record<'_>| record.integer(0).unwrap_or(0);
        let is_of_layer =
            |element: &&Record<'_>| element.find("Type").and_then(|kind| kind.text(0)).as_deref() == Some(layer);
        let named = record.all("Layer").min_by_key(|&first| index(first));
        let named = named.and_then(|first| {
            first
                .all("LayerElement")
                .find(is_of_layer)?
                .find("TypedIndex")?
                .integer(0)
        });
        let found = record
            .all(layer)
            .min_by_key(|&found| (named != Some(index(found)), index(found)));
        match found {
            Some(found) => Self::read(found, [values, indices], width, budget, slices).await,
            None => Ok(None),
        }
    }

    async fn read(
        record: &Record<'_>,
        [values, indices]: [&str; 2],
        width: usize,
        budget: &Budget,
        slices: &Slices,
    ) -> Result<Option<Self>, Fault> {
        let word = |name: &str| record.find(name).and_then(|record| record.text(0)).unwrap_or_default();
        let mapping = match &*word("MappingInformationType") {
            "ByPolygonVertex" => Mapping::Corner,
            "ByVertex" | "ByVertice" => Mapping::ControlPoint,
            "ByPolygon" => Mapping::Polygon,
            "AllSame" => Mapping::All,
            _ => return Ok(None),
        };
        let is_indexed = word("ReferenceInformationType").starts_with("Index");
        let indices = match record.find(indices).filter(|_| is_indexed) {
            Some(indices) => indices.integers_in(budget, slices).await?,
            None => Vec::new(),
        };
        let Some(values) = record.find(values) else {
            return Ok(None);
        };
        let values = values.numbers_in(budget, slices).await?;
        Ok(Some(Self {
            mapping,
            indices,
            values,
            width,
        }))
    }

    /// Which value a corner has; [`NONE`] where the file has none for it.
    fn index(&self, corner: Corner) -> u32 {
        let place = match self.mapping {
            Mapping::Corner => corner.index,
            Mapping::ControlPoint => corner.control_point as usize,
            Mapping::Polygon => corner.polygon,
            Mapping::All => 0,
        };
        let index = match self.indices.is_empty() {
            true => u32::try_from(place).ok(),
            false => self.indices.get(place).and_then(|&index| u32::try_from(index).ok()),
        };
        let index = index.filter(|&index| (index as usize) < self.values.len() / self.width);
        index.unwrap_or(NONE)
    }

    /// Whether two values are the same as `f32`: many files repeat a value for each corner.
    fn are_same(&self, [a, b]: [u32; 2]) -> bool {
        let row = |index: u32| {
            let row = &self.values[index as usize * self.width..][..self.width];
            row.iter().map(|&number| (number as f32).to_bits())
        };
        a == b || (a != NONE && b != NONE && row(a).eq(row(b)))
    }

    fn value<const WIDTH: usize>(&self, index: u32) -> [f32; WIDTH] {
        let mut value = [0.0; WIDTH];
        if index != NONE {
            let stored = &self.values[index as usize * self.width..][..self.width.min(WIDTH)];
            for (to, from) in value.iter_mut().zip(stored) {
                *to = *from as f32;
            }
        }
        value
    }
}

/// The polygons of a geometry, each as a range of its corners.
fn polygons(corners: &[i64]) -> impl Iterator<Item = std::ops::Range<usize>> {
    let mut start = 0;
    let ends = corners.iter().enumerate().filter(|(_, corner)| **corner < 0);
    ends.map(move |(end, _)| std::mem::replace(&mut start, end + 1)..end + 1)
}

/// What corners have: normals, texture coordinates, colours, tangents, binormals.
type Layers = [Option<Layer>; 5];

async fn layers(record: &Record<'_>, budget: &Budget, slices: &Slices) -> Result<Layers, Fault> {
    let layer = async |names, width| Layer::first(record, names, width, budget, slices).await;
    Ok([
        layer(["LayerElementNormal", "Normals", "NormalsIndex"], 3).await?,
        layer(["LayerElementUV", "UV", "UVIndex"], 2).await?,
        layer(["LayerElementColor", "Colors", "ColorIndex"], 4).await?,
        layer(["LayerElementTangent", "Tangents", "TangentsIndex"], 3).await?,
        layer(["LayerElementBinormal", "Binormals", "BinormalsIndex"], 3).await?,
    ])
}

/// Reads a geometry of this name.
///
/// # Errors
/// When an array is damaged, a corner names a control point that is not there, or the budget has no room for what is made.
pub(super) async fn read(
    (record, name): (&Record<'_>, &str),
    file: &mut File<'_, '_>,
    slices: &Slices,
) -> Result<Geometry, Fault> {
    let budget = &file.budget;
    let positions = match record.find("Vertices") {
        Some(vertices) => vertices.numbers_in(budget, slices).await?,
        None => Vec::new(),
    };
    let (points, _) = positions.as_chunks::<3>();
    let Some(corners_record) = record.find("PolygonVertexIndex") else {
        return Ok(Geometry::default());
    };
    let corners = corners_record.integers_in(budget, slices).await?;
    let layers = layers(record, budget, slices).await?;
    let materials = material_layer(record, budget)?;
    let unit_metres = file.settings.unit_metres;
    let mut geometry = Geometry {
        control_point_count: points.len(),
        ..Geometry::default()
    };
    // The last vertex of each control point; of each vertex the one before it there, and its values.
    let mut last: Vec<u32> = vec![NONE; points.len()];
    let mut before: Vec<(u32, [u32; 5])> = Vec::new();
    let mut parts: HashMap<usize, usize> = HashMap::new();
    let mut of_polygon: Vec<u32> = Vec::new();
    let (mut without_values, mut not_whole) = (0, 0);
    for (polygon, range) in polygons(&corners).enumerate() {
        slices.pause_before(polygon).await;
        of_polygon.clear();
        if range.len() < 3 {
            geometry.left_out += 1;
            continue;
        }
        for index in range {
            let stored = corners[index];
            // The last corner of a polygon is stored as its complement.
            let control_point = if stored < 0 { !stored } else { stored };
            let point = usize::try_from(control_point).ok().and_then(|index| points.get(index));
            let Some(&point) = point else {
                return Err(out_of_range(corners_record.place, control_point, points.len()));
            };
            let corner = Corner {
                index,
                control_point: control_point as u32,
                polygon,
            };
            let values = layers
                .each_ref()
                .map(|layer| layer.as_ref().map_or(NONE, |layer| layer.index(corner)));
            let lacks = |(layer, value): (&Option<Layer>, &u32)| layer.is_some() && *value == NONE;
            without_values += usize::from(layers.iter().zip(&values).any(lacks));
            let next = geometry.control_points.len() as u32;
            let last = &mut last[corner.control_point as usize];
            let is_same = |&vertex: &u32| {
                let stored = before[vertex as usize].1.into_iter().zip(values);
                let mut pairs = layers.iter().zip(stored);
                pairs.all(|(layer, (a, b))| layer.as_ref().is_none_or(|layer| layer.are_same([a, b])))
            };
            let some = |vertex: u32| (vertex != NONE).then_some(vertex);
            let alike = std::iter::successors(some(*last), |&vertex| some(before[vertex as usize].0));
            let vertex = alike.take(MOST_COMPARED).find(is_same).unwrap_or(next);
            if vertex == next {
                budget.keep(BYTES_PER_VERTEX, corners_record.place)?;
                before.push((std::mem::replace(last, next), values));
                geometry.control_points.push(corner.control_point);
                let point = point.map(|number| (number * unit_metres) as f32);
                push(&mut geometry.vertices, point, &layers, values);
            }
            of_polygon.push(vertex);
        }
        budget.keep(BYTES_PER_TRIANGLE * (of_polygon.len() as u64 - 2), corners_record.place)?;
        let material = materials
            .as_ref()
            .and_then(|layer| layer.material(polygon))
            .unwrap_or(0);
        let part = *parts.entry(material).or_insert(geometry.parts.len());
        if part == geometry.parts.len() {
            geometry.parts.push(Part {
                material,
                triangles: Vec::new(),
            });
        }
        let (positions, triangles) = (&geometry.vertices.positions, &mut geometry.parts[part].triangles);
        not_whole += usize::from(!triangulate(&of_polygon, positions, triangles, &file.ear_tests_left));
    }
    sorting::sort_by_key(&mut geometry.parts, |part| part.material);
    let open = corners.iter().rev().take_while(|corner| **corner >= 0).count();
    for (count, [one, many], what, kind) in [
        (
            without_values,
            ["corner", "corners"],
            "without a normal, a texture coordinate, a colour or a tangent; 0 is taken, and white as a colour",
            "Geometries with corners without a value",
        ),
        (
            open,
            ["corner", "corners"],
            "behind the last polygon; left out",
            "Geometries with corners behind the last polygon",
        ),
        (
            not_whole,
            ["polygon", "polygons"],
            "without an area, with sides that cross or with too many corners; triangles may overlap",
            "Geometries with polygons whose triangles may overlap",
        ),
    ] {
        if count > 0 {
            file.note_each(record.place, &codes::FBX_RULE_BROKEN, kind, || {
                format!("{} of {} {what}.", counted(count, one, many), quoted(name))
            });
        }
    }
    Ok(geometry)
}

fn out_of_range(place: Place, index: i64, count: usize) -> Fault {
    let message = format!("PolygonVertexIndex: A polygon names control point {index}, but there are {count}.");
    Box::new(place.says(&codes::VERTEX_OUT_OF_RANGE, message))
}

/// Adds a vertex; streams that the geometry does not have stay empty.
fn push(vertices: &mut Vertices, position: [f32; 3], layers: &Layers, values: [u32; 5]) {
    let [normals, uv, colors, tangents, binormals] = layers;
    let [normal, tex_coord, color, tangent, binormal] = values;
    vertices.positions.push(position);
    let normal = normals.as_ref().map(|layer| layer.value(normal));
    vertices.normals.extend(normal);
    if let Some(layer) = uv {
        // v runs upwards in FBX.
        let [u, v] = layer.value(tex_coord);
        vertices.tex_coords.push([u, 1.0 - v]);
    }
    if let Some(layer) = colors {
        vertices
            .colors
            .push(if color == NONE { [1.0; 4] } else { layer.value(color) });
    }
    if let Some(layer) = tangents {
        let tangent: [f32; 3] = layer.value(tangent);
        let [normal, stored] = [normal.unwrap_or_default(), tangent].map(Vec3::from_array);
        let binormal = binormals
            .as_ref()
            .map_or(Vec3::ZERO, |layer| Vec3::from_array(layer.value(binormal)));
        // Without a binormal it is as in most files.
        let is_mirrored = normal.cross(stored).dot(binormal) < 0.0;
        let [x, y, z] = tangent;
        vertices.tangents.push([x, y, z, if is_mirrored { -1.0 } else { 1.0 }]);
    }
}

/// The materials of polygons: indices without values.
struct MaterialLayer {
    mapping: Mapping,
    indices: Vec<i64>,
}

impl MaterialLayer {
    fn material(&self, polygon: usize) -> Option<usize> {
        let place = if self.mapping == Mapping::Polygon { polygon } else { 0 };
        usize::try_from(*self.indices.get(place)?).ok()
    }
}

fn material_layer(record: &Record<'_>, budget: &Budget) -> Result<Option<MaterialLayer>, Fault> {
    let Some(layer) = record.find("LayerElementMaterial") else {
        return Ok(None);
    };
    let mapping = layer.find("MappingInformationType").and_then(|record| record.text(0));
    let mapping = match mapping.as_deref() {
        Some("ByPolygon") => Mapping::Polygon,
        _ => Mapping::All,
    };
    let Some(indices) = layer.find("Materials") else {
        return Ok(None);
    };
    Ok(Some(MaterialLayer {
        mapping,
        indices: indices.integers(budget)?,
    }))
}
