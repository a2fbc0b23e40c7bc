//! Meshes whose vertices carry everything and whose faces name them by number: what readers of OFF, PLY, STL and glTF
//! share.

use super::coloring::{NO_COLOR, settled};
use super::cursor::Fault;
use super::data::{MAX_COORDINATE, MeshData, NO_INDEX};
use super::error::MeshError;
use super::normals::unit;
use super::oddities::{Oddities, Oddity};
use super::polygon::{PolygonCutter, TooIntricate, is_degenerate};
use std::path::Path;

/// Largest number of vertices, so that an index is never mistaken for [`NO_INDEX`].
pub(super) const MOST_VERTICES: u64 = 1 << 31;

/// Most corners of one face.
const MOST_CORNERS: usize = 1 << 24;

/// A face may have so many corners however few vertices there are.
const FREE_CORNERS: usize = 64;

/// A mesh in the making.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) mesh: MeshData,
    pub(super) oddities: Oddities,
    /// Vertices whose normal has no length.
    zero_normals: usize,
    /// Triangles of parts without normals.
    flat_triangles: u64,
    /// Of the first vertices, as the file has them or [`NO_COLOR`].
    colors: Vec<[f32; 3]>,
    /// What they are multiplied by, and whether they are in sRGB.
    pub(super) colors_are: (f32, bool),
    cutter: PolygonCutter,
}

impl Builder {
    /// The normal of the next vertex.
    pub(super) fn add_normal(&mut self, normal: [f64; 3]) {
        let normal = unit(normal);
        if normal.is_none() {
            self.zero_normals += 1;
            self.oddities.add(Oddity::ZeroNormal);
        }
        self.mesh.normals.push(normal.unwrap_or_default());
    }

    /// Vertices up to this one have no normals, where none were added.
    pub(super) fn lack_normals(&mut self, vertices: usize) {
        self.zero_normals += vertices.saturating_sub(self.mesh.normals.len());
        self.mesh.normals.resize(vertices, [0.0; 3]);
    }

    /// Takes note of triangles without normals.
    pub(super) fn without_normals(&mut self, triangles: u64) {
        self.flat_triangles += triangles;
    }

    /// The colour of the next vertex.
    pub(super) fn add_color(&mut self, color: [f64; 3]) {
        self.colors.push(color.map(|x| x as f32));
    }

    /// Vertices up to this one have no colours, where none were added.
    pub(super) fn lack_colors(&mut self, vertices: usize) {
        self.colors.resize(vertices, NO_COLOR);
    }

    /// Room for the colours of so many vertices.
    pub(super) fn reserve_colors(&mut self, vertices: usize) {
        self.colors.reserve_exact(vertices);
    }

    /// The largest number of all colours.
    pub(super) fn largest_color(&self) -> f32 {
        self.colors.as_flattened().iter().copied().fold(0.0, f32::max)
    }

    /// The texture coordinates of the next vertex, written at a byte.
    pub(super) fn add_uv(&mut self, uv: [f64; 2], at: usize) -> Result<(), Box<Fault>> {
        let uv = uv.map(|coordinate| coordinate as f32);
        if !uv.iter().all(|coordinate| coordinate.is_finite()) {
            return Err(Fault::new(at, "a texture coordinate is too large", "at most 3.4e38"));
        }
        self.mesh.uvs.push(uv);
        Ok(())
    }

    /// An index that a face names at a byte.
    #[inline]
    pub(super) fn corner(&self, index: i64, at: usize) -> Result<u32, Box<Fault>> {
        match usize::try_from(index) {
            Ok(corner) if corner < self.mesh.positions.len() => Ok(corner as u32),
            _ => Err(self.no_vertex(index, at)),
        }
    }

    #[cold]
    fn no_vertex(&self, index: i64, at: usize) -> Box<Fault> {
        let expected = match self.mesh.positions.len() {
            0 => "no face where there are no vertices".to_owned(),
            count => format!("an index from 0 to {}, as there are {count} vertices", count - 1),
        };
        Fault::new(at, format!("there is no vertex {index}"), expected)
    }

    /// A triangle of corners that exist.
    #[inline]
    #[expect(clippy::indexing_slicing, reason = "`corner` has checked every index")]
    pub(super) fn add_triangle(&mut self, triangle: [u32; 3]) {
        if is_degenerate(triangle.map(|corner| self.mesh.positions[corner as usize])) {
            self.oddities.add(Oddity::DegenerateTriangle);
        } else {
            self.make_room(1);
            self.mesh.triangles.push(triangle);
        }
    }

    /// A face of corners that exist; it starts at a byte.
    #[inline]
    pub(super) fn add_face(&mut self, corners: &[u32], at: usize) -> Result<(), Box<Fault>> {
        match *corners {
            [a, b, c] => self.add_triangle([a, b, c]),
            [] | [_] | [_, _] => self.oddities.add(Oddity::SmallFace),
            _ => self.add_polygon(corners, at)?,
        }
        Ok(())
    }

    #[expect(clippy::indexing_slicing, reason = "`corner` has checked every index, and polygons number their corners")]
    fn add_polygon(&mut self, corners: &[u32], at: usize) -> Result<(), Box<Fault>> {
        let count = corners.len();
        if count > MOST_CORNERS {
            let message = format!("a face with {count} corners");
            return Err(Fault::new(at, message, format!("at most {MOST_CORNERS}")));
        }
        // Edges between the rings of an outline with holes pass twice through a vertex, so that there are fewer than
        // twice as many corners as vertices. An outline with more is no simple one, and would take long to look
        // through.
        if count > FREE_CORNERS + 2 * self.mesh.positions.len() {
            return Err(TooIntricate::fault(at, count));
        }
        self.make_room(count - 2);
        let MeshData { positions, triangles, .. } = &mut self.mesh;
        let border = corners.iter().map(|&corner| positions[corner as usize]);
        let cut = self.cutter.cut(border).map_err(|TooIntricate| TooIntricate::fault(at, count))?;
        triangles.extend(cut.triangles.iter().map(|triangle| triangle.map(|number| corners[number as usize])));
        self.oddities.add_many(Oddity::DegenerateTriangle, (count - 2 - cut.triangles.len()) as u64);
        self.oddities.add_many(Oddity::CrossingPolygon, u64::from(cut.crossing));
        Ok(())
    }

    /// Grows by quarters: a vector that doubles takes three times its size while it is copied.
    #[inline]
    fn make_room(&mut self, triangles: usize) {
        let vector = &mut self.mesh.triangles;
        if vector.capacity() - vector.len() < triangles {
            vector.reserve_exact(triangles.max(vector.len() / 4).max(4));
        }
    }

    /// The mesh with its warning; without triangles the error, with what the file has instead.
    #[expect(clippy::indexing_slicing, reason = "there is a normal for every vertex")]
    pub(super) fn finish(mut self, path: &Path, found: &str) -> Result<MeshData, MeshError> {
        if !self.mesh.normals.is_empty() {
            self.lack_normals(self.mesh.positions.len());
            self.oddities.add_many(Oddity::MissingNormals, self.flat_triangles);
        }
        let Builder { mut mesh, mut oddities, zero_normals, colors, colors_are: (scale, is_srgb), .. } = self;
        if mesh.triangles.is_empty() {
            let odd = oddities.summary();
            let hint = if odd.is_empty() { found.to_owned() } else { format!("{found}: {odd}") };
            return Err(MeshError::Empty { path: path.to_owned(), hint });
        }
        mesh.colors = settled(colors, mesh.positions.len(), scale, is_srgb, &mut oddities);
        if zero_normals == mesh.normals.len() {
            mesh.normals = Vec::new();
        } else if zero_normals > 0 {
            let normals = &mesh.normals;
            let without = |corner: u32| if normals[corner as usize] == [0.0; 3] { NO_INDEX } else { corner };
            let corners: Vec<[u32; 3]> = mesh.triangles.iter().map(|triangle| triangle.map(without)).collect();
            if corners.as_flattened().iter().all(|&corner| corner == NO_INDEX) {
                mesh.normals = Vec::new();
            } else {
                mesh.normal_triangles = Some(corners);
            }
        }
        mesh.warnings.extend(oddities.to_warning(path));
        Ok(mesh)
    }
}

/// A coordinate, read at a byte, of at most [`MAX_COORDINATE`] in magnitude.
#[inline]
pub(super) fn coordinate(value: f64, at: usize) -> Result<f64, Box<Fault>> {
    if value.abs() <= MAX_COORDINATE {
        return Ok(value);
    }
    let message = format!("the coordinate `{value:e}` is too large");
    Err(Fault::new(at, message, format!("a magnitude of at most {MAX_COORDINATE:e}")))
}

/// A fault where a header promises more of something than the bytes that follow can hold.
pub(super) fn check_room(at: usize, count: u64, most: u64, what: &str, bytes: usize) -> Result<(), Box<Fault>> {
    if count <= most {
        return Ok(());
    }
    let message = format!("the header promises {count} {what}, but the file is too short for them");
    Err(Fault::new(at, message, format!("at most {most} {what} in the {bytes} bytes that follow")))
}
