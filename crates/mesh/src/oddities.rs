//! Counts of things in a mesh file that are odd but do no harm, told in one warning.

use super::cursor::shown;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::Span;
use std::path::Path;

/// A kind of oddity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Oddity {
    /// A triangle without area, or a part of a polygon without.
    DegenerateTriangle,
    /// A polygon whose border crosses itself: cut as well as can be.
    CrossingPolygon,
    /// An OFF or PLY face of fewer than three corners.
    SmallFace,
    /// An OBJ `l`.
    LineElement,
    /// An OBJ `p`.
    PointElement,
    /// A triangle without normals in a file where others have them.
    MissingNormals,
    /// A triangle without texture coordinates in a file where others have them.
    MissingUvs,
    /// A vertex normal of length zero.
    ZeroNormal,
    /// Vertex normals that no face names.
    UnusedNormals,
    /// Texture coordinates that no face names.
    UnusedUvs,
    /// A vertex with a colour that nobody wants.
    VertexColor,
    /// A vertex without a colour in a file where others have them.
    MissingColor,
    /// A vertex whose colour is beyond 0 to 1.
    ClippedColor,
    /// A face with a colour.
    FaceColor,
    /// A vertex with a weight other than 1.
    Weight,
    /// A line after the last face of an OFF file, or what comes last in another.
    TrailingLine,
    /// A byte after the data of a binary file.
    TrailingByte,
    /// A PLY face with texture coordinates for each corner.
    CornerUvs,
    /// A glTF primitive of points or lines.
    OtherPrimitive,
    /// A glTF primitive without positions.
    NoPositions,
}

impl Oddity {
    const ALL: [Oddity; 20] = [
        Oddity::DegenerateTriangle,
        Oddity::CrossingPolygon,
        Oddity::SmallFace,
        Oddity::LineElement,
        Oddity::PointElement,
        Oddity::MissingNormals,
        Oddity::MissingUvs,
        Oddity::ZeroNormal,
        Oddity::UnusedNormals,
        Oddity::UnusedUvs,
        Oddity::VertexColor,
        Oddity::MissingColor,
        Oddity::ClippedColor,
        Oddity::FaceColor,
        Oddity::Weight,
        Oddity::TrailingLine,
        Oddity::TrailingByte,
        Oddity::CornerUvs,
        Oddity::OtherPrimitive,
        Oddity::NoPositions,
    ];

    /// What is counted, for one and for many, and what was done with it.
    fn words(self) -> [&'static str; 3] {
        match self {
            Oddity::DegenerateTriangle => ["triangle without area", "triangles without area", "left out"],
            Oddity::CrossingPolygon => ["polygon that crosses itself", "polygons that cross themselves", "cut roughly"],
            Oddity::SmallFace => ["face of fewer than 3 corners", "faces of fewer than 3 corners", "left out"],
            Oddity::LineElement => ["line (`l`)", "lines (`l`)", "left out"],
            Oddity::PointElement => ["point element (`p`)", "point elements (`p`)", "left out"],
            Oddity::MissingNormals => ["triangle without vertex normals", "triangles without vertex normals", "flat"],
            Oddity::MissingUvs => {
                ["triangle without texture coordinates", "triangles without texture coordinates", "kept"]
            }
            Oddity::ZeroNormal => ["vertex normal of length zero", "vertex normals of length zero", "ignored"],
            Oddity::UnusedNormals => {
                ["vertex normal that no face names", "vertex normals that no face names", "ignored"]
            }
            Oddity::UnusedUvs => {
                ["texture coordinate that no face names", "texture coordinates that no face names", "ignored"]
            }
            Oddity::VertexColor => ["vertex colour", "vertex colours", "ignored"],
            Oddity::MissingColor => ["vertex without a colour", "vertices without a colour", "white"],
            Oddity::ClippedColor => ["vertex colour beyond 0 to 1", "vertex colours beyond 0 to 1", "clipped"],
            Oddity::FaceColor => ["face colour", "face colours", "ignored"],
            Oddity::Weight => ["vertex weight other than 1", "vertex weights other than 1", "ignored"],
            Oddity::TrailingLine => ["line after the last face", "lines after the last face", "ignored"],
            Oddity::TrailingByte => ["byte after the last face", "bytes after the last face", "ignored"],
            Oddity::CornerUvs => {
                ["face with texture coordinates of its own", "faces with texture coordinates of their own", "ignored"]
            }
            Oddity::OtherPrimitive => ["primitive of points or lines", "primitives of points or lines", "left out"],
            Oddity::NoPositions => ["primitive without `POSITION`", "primitives without `POSITION`", "left out"],
        }
    }
}

/// How many names of unknown statements are shown: a file of another kind may have a different one in every line.
const NAMES: usize = 8;

/// How many bytes of such a name are kept.
const NAME_BYTES: usize = 200;

/// How often each oddity occurred.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Oddities {
    counts: [u64; Oddity::ALL.len()],
    /// Statements that are not read.
    unread: u64,
    /// Their first different names, one more than are shown.
    unread_names: Vec<Vec<u8>>,
}

impl Oddities {
    /// Counts one more.
    pub(super) fn add(&mut self, oddity: Oddity) {
        self.add_many(oddity, 1);
    }

    /// Counts several more.
    #[expect(clippy::indexing_slicing, reason = "one count for each oddity")]
    pub(super) fn add_many(&mut self, oddity: Oddity, count: u64) {
        self.counts[oddity as usize] += count;
    }

    /// Counts a statement that is not read.
    #[expect(clippy::indexing_slicing, reason = "cut to the name's length")]
    pub(super) fn add_statement(&mut self, name: &[u8]) {
        self.unread += 1;
        self.add_name(&name[..name.len().min(NAME_BYTES)]);
    }

    fn add_name(&mut self, name: &[u8]) {
        if self.unread_names.len() <= NAMES && !self.unread_names.iter().any(|known| known == name) {
            self.unread_names.push(name.to_vec());
        }
    }

    /// Adds the counts of a later part of the same file.
    pub(super) fn merge(&mut self, later: Oddities) {
        for (count, more) in self.counts.iter_mut().zip(later.counts) {
            *count += more;
        }
        self.unread += later.unread;
        later.unread_names.iter().for_each(|name| self.add_name(name));
    }

    /// All of them in words, parted by semicolons; empty when there are none.
    #[expect(clippy::indexing_slicing, reason = "one count for each oddity")]
    pub(super) fn summary(&self) -> String {
        let mut parts = Vec::new();
        for oddity in Oddity::ALL {
            let [one, many, done] = oddity.words();
            match self.counts[oddity as usize] {
                0 => {}
                1 => parts.push(format!("1 {one} ({done})")),
                count => parts.push(format!("{count} {many} ({done})")),
            }
        }
        if self.unread > 0 {
            let mut names: Vec<String> = self.unread_names.iter().take(NAMES).map(|name| shown(name)).collect();
            if self.unread_names.len() > NAMES {
                names.push("...".to_owned());
            }
            let statements = if self.unread == 1 { "statement" } else { "statements" };
            parts.push(format!("{} {statements} not known here: {} (ignored)", self.unread, names.join(" ")));
        }
        parts.join("; ")
    }

    /// The one warning `W0510` about the file, when there is anything to tell.
    pub(super) fn to_warning(&self, path: &Path) -> Option<Diagnostic> {
        let summary = self.summary();
        (!summary.is_empty()).then(|| {
            Diagnostic::warning(codes::MESH_ODDITIES, Span::NONE, format!("the mesh has oddities: {summary}"))
                .at_line(path, 0)
        })
    }
}
