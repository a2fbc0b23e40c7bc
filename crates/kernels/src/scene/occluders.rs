//! What can hide points of small scenes from each other: the tree's triangles as columns, and boxes around all else.

use crate::bvh::{Accel, SecondBoxes};

/// Columns are as much longer, so that whole vectors can be loaded.
const ROOM: usize = 32;

/// The occluders of a scene of few triangles. Render space.
#[derive(Clone, Debug)]
pub struct OccluderTable {
    /// How many triangles there are.
    pub len: usize,
    /// Corner, axis.
    pub corners: [[Vec<f32>; 3]; 3],
    /// Unit normals; not finite where there is none.
    pub normal: [Vec<f32>; 3],
    /// Along the normal, the triangle's distance from the origin.
    pub height: Vec<f32>,
    /// 1 + 8 L^2 / (2 A), L being the longest side and A the area: so many margins from its plane points may be on
    /// either side of it (`stages::fan`).
    pub slack: Vec<f32>,
    /// The largest coordinate.
    pub magnitude: Vec<f32>,
    /// Primitive ids.
    pub id: Vec<u32>,
    /// Boxes of whatever else is in the tree.
    pub boxes: SecondBoxes,
    /// Primitives that lie in one plane with others, rising: only the tree knows what covers them.
    pub in_one_plane: Vec<u32>,
}

impl OccluderTable {
    /// Of a tree that holds no more triangles than this, and little else; of others `None`.
    pub fn new(accel: &Accel, most: usize) -> Option<Self> {
        let few = accel.few(most)?;
        let len = few.triangles.len();
        let column = |of: &dyn Fn(usize) -> f32| -> Vec<f32> {
            (0..len).map(of).chain(std::iter::repeat_n(0.0, ROOM)).collect()
        };
        let planes: Vec<_> = few.triangles.iter().map(|triangle| plane_of(triangle.corners)).collect();
        let axes = [0, 1, 2];
        Some(Self {
            len,
            corners: axes.map(|v: usize| axes.map(|axis: usize| column(&|k| few.triangles[k].corners[v][axis]))),
            normal: axes.map(|axis: usize| column(&|k| planes[k].normal[axis])),
            height: column(&|k| planes[k].height),
            slack: column(&|k| planes[k].slack),
            magnitude: column(&|k| {
                few.triangles[k].corners.as_flattened().iter().fold(0.0, |most: f32, x| most.max(x.abs()))
            }),
            id: few.triangles.iter().map(|triangle| triangle.primitive).chain([0; ROOM]).collect(),
            boxes: few.boxes,
            in_one_plane: accel.in_one_plane(),
        })
    }

    /// Whether a point on this primitive may be covered by what lies in one plane with it.
    #[inline(always)]
    pub fn may_be_covered(&self, primitive: u32) -> bool {
        !self.in_one_plane.is_empty() && self.in_one_plane.binary_search(&primitive).is_ok()
    }
}

struct TrianglePlane {
    normal: [f32; 3],
    height: f32,
    slack: f32,
}

/// The plane of a triangle.
fn plane_of(corners: [[f32; 3]; 3]) -> TrianglePlane {
    let [a, b, c] = corners.map(|corner| glam::DVec3::from(corner.map(f64::from)));
    let across = (b - a).cross(c - a);
    let normal = across / across.length();
    let longest2 = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
    TrianglePlane {
        normal: normal.to_array().map(|x| x as f32),
        height: normal.dot(a) as f32,
        slack: (1.0 + 8.0 * longest2 / across.length()) as f32,
    }
}
