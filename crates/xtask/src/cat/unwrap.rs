//! Texture coordinates: an atlas of flat views.
//!
//! Each part of the cat is seen from the six sides of a box; a triangle belongs to the view that it faces. So a texture
//! coordinate is an affine function of the position within a chart, the same for every mesh of the cat: meshes of any
//! number of triangles share one texture, no triangle is stretched by more than 1/cos 55 degrees, and none runs across
//! a seam (vertices on a chart's border have one texture coordinate per chart).

use super::anatomy::{Cat, Part};
use super::mesh::{Mesh, area_vector};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Texels between charts and around them.
const GUTTER: f64 = 5.0;
/// A triangle may follow its neighbours into a view that it faces at least this much (cosine).
const FACING: f64 = 0.4;

/// A side of the box that views are taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// From +x.
    Front,
    /// From -x.
    Back,
    /// From +y.
    Above,
    /// From -y.
    Below,
    /// From +z.
    Right,
    /// From -z.
    Left,
}

const SIDES: [Side; 6] = [Side::Front, Side::Back, Side::Above, Side::Below, Side::Right, Side::Left];

impl Side {
    fn direction(self) -> DVec3 {
        match self {
            Side::Front => DVec3::X,
            Side::Back => DVec3::NEG_X,
            Side::Above => DVec3::Y,
            Side::Below => DVec3::NEG_Y,
            Side::Right => DVec3::Z,
            Side::Left => DVec3::NEG_Z,
        }
    }

    /// Where a viewer on this side sees `p`: right and up.
    fn see(self, p: DVec3) -> DVec2 {
        match self {
            Side::Front => DVec2::new(-p.z, p.y),
            Side::Back => DVec2::new(p.z, p.y),
            Side::Above => DVec2::new(p.x, -p.z),
            Side::Below => DVec2::new(p.x, p.z),
            Side::Right => DVec2::new(p.x, p.y),
            Side::Left => DVec2::new(-p.x, p.y),
        }
    }
}

/// A part seen from a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ChartId {
    /// The part.
    pub part: Part,
    /// Where it is seen from.
    pub side: Side,
}

/// A mesh and the chart of each of its triangles.
pub struct Charted {
    /// The mesh.
    pub mesh: Mesh,
    /// A chart per triangle.
    pub charts: Vec<ChartId>,
}

impl Charted {
    /// Gives each triangle its chart.
    pub fn new(mesh: Mesh, cat: &Cat) -> Charted {
        let charts = charts(&mesh, cat);
        Charted { mesh, charts }
    }
}

fn charts(mesh: &Mesh, cat: &Cat) -> Vec<ChartId> {
    let normals: Vec<DVec3> =
        (0..mesh.triangles.len()).map(|t| area_vector(mesh.corners(t)).normalize_or_zero()).collect();
    let mut ids: Vec<ChartId> = (0..mesh.triangles.len())
        .map(|t| {
            let [a, b, c] = mesh.corners(t);
            let facing = |s: &Side| s.direction().dot(normals[t]);
            let side = SIDES.into_iter().max_by(|s, r| facing(s).total_cmp(&facing(r))).unwrap_or(Side::Above);
            ChartId { part: cat.part((a + b + c) / 3.0), side }
        })
        .collect();
    // Ragged borders become straighter: a triangle with two neighbours in one other chart joins it.
    let mut neighbours = vec![Vec::with_capacity(3); mesh.triangles.len()];
    for pair in mesh.edge_sides().chunks_exact(2) {
        neighbours[pair[0].triangle].push(pair[1].triangle);
        neighbours[pair[1].triangle].push(pair[0].triangle);
    }
    for _ in 0..3 {
        for t in 0..ids.len() {
            let around: Vec<ChartId> = neighbours[t].iter().map(|&n| ids[n]).collect();
            let twice = around.iter().find(|id| around.iter().filter(|other| other == id).count() >= 2);
            if let Some(&id) = twice
                && id.part == ids[t].part
                && id.side.direction().dot(normals[t]) > FACING
            {
                ids[t] = id;
            }
        }
    }
    ids
}

/// Where each chart lies in the texture.
pub struct Atlas {
    size: f64,
    charts: BTreeMap<ChartId, Place>,
}

#[derive(Clone, Copy)]
struct Place {
    /// What the view sees at the chart's lower left corner.
    min: DVec2,
    /// The chart's lower left corner in texels.
    corner: DVec2,
    /// Texels per unit of length.
    density: f64,
}

impl Atlas {
    /// Packs the charts of all meshes into a square of `size` texels, as dense as they fit.
    pub fn pack(meshes: &[Charted], size: usize) -> Atlas {
        let mut boxes: BTreeMap<ChartId, (DVec2, DVec2)> = BTreeMap::new();
        for charted in meshes {
            for (t, id) in charted.charts.iter().enumerate() {
                for p in charted.mesh.corners(t) {
                    let seen = id.side.see(p);
                    let (min, max) = boxes.entry(*id).or_insert((seen, seen));
                    *min = min.min(seen);
                    *max = max.max(seen);
                }
            }
        }
        let size = size as f64;
        // The largest density that fits, by bisection; half a texel per unit surely does.
        let (mut fits, mut fails) = (0.5, 100.0);
        for _ in 0..24 {
            let middle = 0.5 * (fits + fails);
            if pack_shelves(&boxes, size, middle).is_some() { fits = middle } else { fails = middle }
        }
        let charts = pack_shelves(&boxes, size, fits).unwrap_or_default();
        Atlas { size, charts }
    }

    /// Texture coordinates of a point in a chart, (0, 0) at the texture's lower left; `None` where the atlas lacks the
    /// chart.
    pub fn uv(&self, id: ChartId, p: DVec3) -> Option<DVec2> {
        let place = self.charts.get(&id)?;
        Some((place.corner + (id.side.see(p) - place.min) * place.density) / self.size)
    }
}

/// Faces get more texels than flanks.
fn detail(part: Part) -> f64 {
    match part {
        Part::Head => 2.2,
        Part::LeftEar | Part::RightEar | Part::LeftEarHollow | Part::RightEarHollow => 1.5,
        _ => 1.0,
    }
}

/// Rows of charts, tall ones first; `None` where they do not fit.
fn pack_shelves(
    boxes: &BTreeMap<ChartId, (DVec2, DVec2)>,
    size: f64,
    density: f64,
) -> Option<BTreeMap<ChartId, Place>> {
    let mut order: Vec<(ChartId, DVec2, DVec2, f64)> = boxes
        .iter()
        .map(|(id, (min, max))| {
            let density = density * detail(id.part);
            (*id, *min, ((*max - *min) * density).ceil() + DVec2::splat(2.0 * GUTTER), density)
        })
        .collect();
    order.sort_by(|a, b| b.2.y.total_cmp(&a.2.y).then(a.0.cmp(&b.0)));
    let mut places = BTreeMap::new();
    let mut shelves: Vec<(f64, f64, f64)> = Vec::new(); // bottom, height, used width
    for (id, min, extent, density) in order {
        let room = shelves.iter().position(|s| s.2 + extent.x <= size && extent.y <= s.1);
        let shelf = match room {
            Some(shelf) => shelf,
            None => {
                let bottom = shelves.last().map_or(0.0, |s| s.0 + s.1);
                if bottom + extent.y > size || extent.x > size {
                    return None;
                }
                shelves.push((bottom, extent.y, 0.0));
                shelves.len() - 1
            }
        };
        let s = &mut shelves[shelf];
        places.insert(id, Place { min, corner: DVec2::new(s.2, s.0) + DVec2::splat(GUTTER), density });
        s.2 += extent.x;
    }
    Some(places)
}
