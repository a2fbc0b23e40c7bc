//! The Polygon File Format (PLY), as Turk describes it ("The PLY Polygon File Format", 1994) and as programs write it.
//!
//! - ASCII and binary of both byte orders; all types by their old and new names; elements in any order.
//! - `vertex`: `x y z`, normals `nx ny nz`, texture coordinates `u v`, `s t` or `texture_u texture_v`.
//! - `face`: a list `vertex_indices` or `vertex_index`. `tristrips`: such a list, -1 between strips.
//! - Colours of vertices: `red green blue`, `diffuse_red diffuse_green diffuse_blue` or `r g b`, where they are wanted:
//!   whole numbers are in sRGB, from 0 to 65535 of type ushort and else from 0 to 255, floats are linear, from 0 to 1.
//! - All else is stepped over; colours of faces, and their texture coordinates, are counted.
//!
//! The counts of the header are only compared with what is there; memory is reserved by the size of the file.

mod header;
mod source;

use super::builder::{Builder, MOST_VERTICES, check_room, coordinate};
use super::colors::Wanted;
use super::cursor::Fault;
use super::data::MeshData;
use super::error::MeshError;
use super::oddities::Oddity;
use header::{Element, Encoding, Header, Kind, Scalar};
use source::{Ascii, Binary, Source};
use std::path::Path;

/// Reads a PLY file.
pub(super) fn read(text: &[u8], path: &Path, wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    let header = Header::parse(text).map_err(|fault| MeshError::at_line(path, text, *fault))?;
    let builder = match header.encoding {
        Encoding::Ascii => Reader::new(Ascii::new(text, header.data)).read(&header, wanted),
        Encoding::LittleEndian => Reader::new(Binary::<false>::new(text, header.data)).read(&header, wanted),
        Encoding::BigEndian => Reader::new(Binary::<true>::new(text, header.data)).read(&header, wanted),
    };
    let builder = builder.map_err(|fault| {
        if header.encoding == Encoding::Ascii || fault.at < header.data {
            MeshError::at_line(path, text, *fault)
        } else {
            MeshError::at_byte(path, *fault)
        }
    })?;
    let faces = header.elements.iter().find(|element| element.name == b"face").map_or(0, |element| element.count);
    let found = format!("the file has {} vertices and {faces} faces", builder.mesh.positions.len());
    builder.finish(path, &found)
}

/// What an element is for.
enum Role {
    Vertices(VertexLayout),
    Faces,
    Strips,
    Nothing,
}

/// Where a property of a vertex goes: its position, its normal, its texture coordinates, its colour.
const SLOTS: usize = 3 + 3 + 2 + 3;

/// What vertices have besides their positions.
#[derive(Clone, Copy, Default)]
struct VertexLayout {
    normal: bool,
    uv: bool,
    color: Option<ColorLayout>,
}

/// How colours are written.
#[derive(Clone, Copy)]
struct ColorLayout {
    /// What each channel is multiplied by, so that it goes from 0 to 1.
    scale: [f64; 3],
    is_srgb: bool,
}

/// The names of the properties of colours.
const COLORS: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]];

/// What is done with the next properties of an item.
enum Step {
    /// These are not needed.
    Skip {
        values: u64,
        bytes: u64,
    },
    SkipList {
        count: Scalar,
        item: Scalar,
    },
    /// This is a number of the vertex.
    Take {
        kind: Scalar,
        slot: usize,
    },
    /// These are the corners of the face.
    TakeList {
        count: Scalar,
        item: Scalar,
    },
}

/// An element and how to read it.
struct Plan<'h> {
    element: &'h Element<'h>,
    role: Role,
    steps: Vec<Step>,
}

impl<'h> Plan<'h> {
    fn new(element: &'h Element<'h>, wanted: Wanted<'_>) -> Result<Plan<'h>, Box<Fault>> {
        let (role, takes) = match element.name {
            b"vertex" => {
                let (layout, slots) = vertex_slots(element, wanted)?;
                (Role::Vertices(layout), slots)
            }
            b"face" | b"tristrips" => match index_list(element)? {
                Some(list) if element.name == b"face" => (Role::Faces, vec![(list, 0)]),
                Some(list) => (Role::Strips, vec![(list, 0)]),
                None => (Role::Nothing, Vec::new()),
            },
            _ => (Role::Nothing, Vec::new()),
        };
        let mut takes = takes.into_iter().peekable();
        let mut steps = Vec::new();
        for (number, property) in element.properties.iter().enumerate() {
            let taken = takes.next_if(|&(taken, _)| taken == number);
            match (property.kind, taken, steps.last_mut()) {
                (Kind::Scalar(kind), Some((_, slot)), _) => steps.push(Step::Take { kind, slot }),
                (Kind::Scalar(kind), None, Some(Step::Skip { values, bytes })) => {
                    *values += 1;
                    *bytes += kind.bytes();
                }
                (Kind::Scalar(kind), None, _) => steps.push(Step::Skip { values: 1, bytes: kind.bytes() }),
                (Kind::List { count, item }, Some(_), _) => steps.push(Step::TakeList { count, item }),
                (Kind::List { count, item }, None, _) => steps.push(Step::SkipList { count, item }),
            }
        }
        Ok(Plan { element, role, steps })
    }
}

/// The numbers of the properties that are read, ascending, each with its slot.
type Taken = Vec<(usize, usize)>;

fn vertex_slots(element: &Element, wanted: Wanted<'_>) -> Result<(VertexLayout, Taken), Box<Fault>> {
    const EXPECTED: &str = "the properties `x`, `y` and `z` of the element `vertex`, each a number";
    let find = |name: &str| {
        let scalar = |kind| matches!(kind, Kind::Scalar(_));
        let mut found =
            element.properties.iter().enumerate().filter(|(_, p)| p.name == name.as_bytes() && scalar(p.kind));
        let first = found.next().map(|(number, _)| number);
        match found.next() {
            Some(_) => Err(Fault::new(element.at, format!("the vertices have two properties `{name}`"), EXPECTED)),
            None => Ok(first),
        }
    };
    let mut taken = Vec::new();
    for (slot, name) in ["x", "y", "z"].into_iter().enumerate() {
        match find(name)? {
            Some(number) => taken.push((number, slot)),
            None => {
                return Err(Fault::new(element.at, format!("the vertices have no property `{name}`"), EXPECTED));
            }
        }
    }
    let mut layout = VertexLayout::default();
    if let [Some(x), Some(y), Some(z)] = [find("nx")?, find("ny")?, find("nz")?] {
        taken.extend([(x, 3), (y, 4), (z, 5)]);
        layout.normal = true;
    }
    for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]] {
        if let (false, Some(u), Some(v)) = (layout.uv, find(u)?, find(v)?) {
            taken.extend([(u, 6), (v, 7)]);
            layout.uv = true;
        }
    }
    for names in COLORS.iter().filter(|_| wanted.colors) {
        if let (None, [Some(red), Some(green), Some(blue)]) =
            (layout.color, [find(names[0])?, find(names[1])?, find(names[2])?])
        {
            taken.extend([(red, 8), (green, 9), (blue, 10)]);
            layout.color = Some(ColorLayout::of([red, green, blue].map(|k| element.properties.get(k).map(|p| p.kind))));
        }
    }
    taken.sort_unstable();
    Ok((layout, taken))
}

impl ColorLayout {
    fn of(kinds: [Option<Kind>; 3]) -> Self {
        let scale = |kind| match kind {
            Some(Kind::Scalar(Scalar::U16)) => 1.0 / 65535.0,
            Some(Kind::Scalar(kind)) if kind.is_integer() => 1.0 / 255.0,
            _ => 1.0,
        };
        let is_whole = |kind: &Option<Kind>| matches!(kind, Some(Kind::Scalar(kind)) if kind.is_integer());
        ColorLayout { scale: kinds.map(scale), is_srgb: kinds.iter().all(is_whole) }
    }
}

/// The number of the property that lists the corners of faces or strips; none where there are no faces.
fn index_list(element: &Element) -> Result<Option<usize>, Box<Fault>> {
    const EXPECTED: &str = "one list `vertex_indices` or `vertex_index` of an integer type";
    let mut lists = element.properties.iter().enumerate().filter_map(|(number, property)| match property.kind {
        Kind::List { item, .. } if matches!(property.name, b"vertex_indices" | b"vertex_index") => Some((number, item)),
        _ => None,
    });
    let what = element.what();
    match (lists.next(), lists.next()) {
        (None, _) if element.count == 0 => Ok(None),
        (None, _) => Err(Fault::new(element.at, format!("the {what} have no list of vertices"), EXPECTED)),
        (Some(_), Some(_)) => Err(Fault::new(element.at, format!("the {what} have two lists of vertices"), EXPECTED)),
        (Some((_, item)), None) if !item.is_integer() => {
            Err(Fault::new(element.at, format!("the {what} name their vertices by fractional numbers"), EXPECTED))
        }
        (Some((number, _)), None) => Ok(Some(number)),
    }
}

struct Reader<S> {
    source: S,
    builder: Builder,
    /// The corners of one face.
    corners: Vec<u32>,
}

impl<S: Source> Reader<S> {
    fn new(source: S) -> Self {
        Reader { source, builder: Builder::default(), corners: Vec::new() }
    }

    fn read(mut self, header: &Header, wanted: Wanted<'_>) -> Result<Builder, Box<Fault>> {
        let plan = |element| Plan::new(element, wanted);
        let plans = header.elements.iter().map(plan).collect::<Result<Vec<Plan>, _>>()?;
        let mut all_vertices = plans.iter().filter(|plan| matches!(plan.role, Role::Vertices(_)));
        let expected = "one element `vertex`";
        match (all_vertices.next(), all_vertices.next()) {
            (None, _) => return Err(Fault::new(header.at_end, "the header has no element `vertex`", expected)),
            (_, Some(plan)) => return Err(Fault::new(plan.element.at, "a second element `vertex`", expected)),
            (Some(_), None) => {}
        }
        let mut vertices_are_read = false;
        // Faces that come before the vertices are read after them.
        let mut waiting = Vec::new();
        for plan in &plans {
            self.check_room(plan)?;
            match plan.role {
                Role::Vertices(layout) => {
                    self.read_vertices(plan, layout)?;
                    vertices_are_read = true;
                }
                Role::Faces | Role::Strips if vertices_are_read => self.read_faces(plan)?,
                Role::Faces | Role::Strips => {
                    waiting.push((plan, self.source.clone()));
                    self.skip_element(plan)?;
                }
                Role::Nothing => self.skip_element(plan)?,
            }
            self.count_colors(plan, wanted);
        }
        let end = self.source.clone();
        for (plan, source) in waiting {
            self.source = source;
            self.read_faces(plan)?;
        }
        end.count_rest(&mut self.builder.oddities);
        Ok(self.builder)
    }

    /// Refuses a count that the rest of the file has no room for.
    fn check_room(&self, plan: &Plan) -> Result<(), Box<Fault>> {
        let element = plan.element;
        let (mut bytes, mut values) = (0, 0);
        for step in &plan.steps {
            match *step {
                Step::Skip { values: more, bytes: length } => {
                    bytes += length;
                    values += more;
                }
                Step::Take { kind: one, .. }
                | Step::SkipList { count: one, .. }
                | Step::TakeList { count: one, .. } => {
                    bytes += one.bytes();
                    values += 1;
                }
            }
        }
        let most = if values == 0 { u64::MAX } else { self.source.most_items(bytes, values) };
        check_room(element.at, element.count, most, &element.what(), self.source.bytes_left())?;
        if element.name == b"vertex" && element.count > MOST_VERTICES {
            let message = format!("{} vertices", element.count);
            return Err(Fault::new(element.at, message, format!("at most {MOST_VERTICES}")));
        }
        Ok(())
    }

    /// Reads every item of an element.
    fn read_items(
        &mut self,
        plan: &Plan,
        mut item: impl FnMut(&mut Self, &[Step]) -> Result<(), Box<Fault>>,
    ) -> Result<(), Box<Fault>> {
        if plan.steps.is_empty() {
            // Items of nothing take no bytes, so there may be any number of them.
            return Ok(());
        }
        for number in 0..plan.element.count {
            let read = self.source.start_item().and_then(|()| item(self, &plan.steps));
            if let Err(mut fault) = read.and_then(|()| self.source.end_item()) {
                if fault.message.is_empty() {
                    let (count, what) = (plan.element.count, plan.element.what());
                    fault.message = format!("the file ends after {number} of {count} {what}");
                    fault.expected = format!("as many {what} as the header says");
                }
                return Err(S::expecting(fault, plan.element));
            }
        }
        Ok(())
    }

    fn skip_element(&mut self, plan: &Plan) -> Result<(), Box<Fault>> {
        self.read_items(plan, |reader, steps| {
            for step in steps {
                match *step {
                    Step::Take { kind, .. } => reader.source.skip(1, kind.bytes())?,
                    Step::Skip { values, bytes } => reader.source.skip(values, bytes)?,
                    Step::SkipList { count, item } | Step::TakeList { count, item } => reader.skip_list(count, item)?,
                }
            }
            Ok(())
        })
    }

    fn skip_list(&mut self, count: Scalar, item: Scalar) -> Result<(), Box<Fault>> {
        let length = self.source.length(count, item)?;
        self.source.skip(length, length.saturating_mul(item.bytes()))
    }

    fn read_vertices(&mut self, plan: &Plan, layout: VertexLayout) -> Result<(), Box<Fault>> {
        let count = plan.element.count as usize;
        let mesh = &mut self.builder.mesh;
        mesh.positions.reserve_exact(count);
        mesh.normals.reserve_exact(if layout.normal { count } else { 0 });
        mesh.uvs.reserve_exact(if layout.uv { count } else { 0 });
        if let Some(color) = layout.color {
            self.builder.reserve_colors(count);
            self.builder.colors_are = (1.0, color.is_srgb);
        }
        self.read_items(plan, |reader, steps| {
            let at = reader.source.at();
            let mut values = [0.0; SLOTS];
            for step in steps {
                match *step {
                    Step::Take { kind, slot } => {
                        let at = reader.source.at();
                        let value = reader.source.number(kind)?;
                        let value = if slot < 3 { coordinate(value, at)? } else { value };
                        if let Some(there) = values.get_mut(slot) {
                            *there = value;
                        }
                    }
                    Step::Skip { values, bytes } => reader.source.skip(values, bytes)?,
                    Step::SkipList { count, item } | Step::TakeList { count, item } => reader.skip_list(count, item)?,
                }
            }
            let [x, y, z, nx, ny, nz, u, v, red, green, blue] = values;
            reader.builder.mesh.positions.push([x, y, z]);
            if layout.normal {
                reader.builder.add_normal([nx, ny, nz]);
            }
            if layout.uv {
                reader.builder.add_uv([u, v], at)?;
            }
            if let Some(ColorLayout { scale: [r, g, b], .. }) = layout.color {
                reader.builder.add_color([red * r, green * g, blue * b]);
            }
            Ok(())
        })
    }

    fn read_faces(&mut self, plan: &Plan) -> Result<(), Box<Fault>> {
        let strips = matches!(plan.role, Role::Strips);
        for step in &plan.steps {
            if let (Step::TakeList { count, item }, false) = (step, strips) {
                // Faces are triangles in nearly all files, but there may be no more than fit.
                let most = self.source.most_items(count.bytes() + 3 * item.bytes(), 4);
                self.builder.mesh.triangles.reserve_exact(plan.element.count.min(most) as usize);
            }
        }
        self.read_items(plan, |reader, steps| {
            for step in steps {
                match *step {
                    Step::TakeList { count, item } if strips => reader.read_strips(count, item)?,
                    Step::TakeList { count, item } => reader.read_face(count, item)?,
                    Step::Take { kind, .. } => reader.source.skip(1, kind.bytes())?,
                    Step::Skip { values, bytes } => reader.source.skip(values, bytes)?,
                    Step::SkipList { count, item } => reader.skip_list(count, item)?,
                }
            }
            Ok(())
        })
    }

    #[inline]
    fn read_face(&mut self, count: Scalar, item: Scalar) -> Result<(), Box<Fault>> {
        let start = self.source.at();
        let length = self.source.length(count, item)?;
        self.corners.clear();
        for _ in 0..length {
            let at = self.source.at();
            let corner = self.builder.corner(self.source.integer(item)?, at)?;
            self.corners.push(corner);
        }
        self.builder.add_face(&self.corners, start)
    }

    /// Strips of triangles, every second one wound the other way.
    fn read_strips(&mut self, count: Scalar, item: Scalar) -> Result<(), Box<Fault>> {
        let length = self.source.length(count, item)?;
        let (mut before, mut known, mut odd) = ([0; 2], 0, false);
        for _ in 0..length {
            let at = self.source.at();
            let index = self.source.integer(item)?;
            if index == -1 {
                (known, odd) = (0, false);
                continue;
            }
            let corner = self.builder.corner(index, at)?;
            let [a, b] = before;
            before = [b, corner];
            if known < 2 {
                known += 1;
                continue;
            }
            // Repeated corners join one part of a strip to the next: they are no fault of the mesh.
            if a != b && b != corner && corner != a {
                self.builder.add_triangle(if odd { [b, a, corner] } else { [a, b, corner] });
            }
            odd = !odd;
        }
        Ok(())
    }

    /// Counts what is passed over and would be seen.
    fn count_colors(&mut self, plan: &Plan, wanted: Wanted<'_>) {
        let has = |name: &str| plan.element.properties.iter().any(|property| property.name == name.as_bytes());
        let (colors, count) = (COLORS.iter().any(|names| names.iter().all(|name| has(name))), plan.element.count);
        let oddities = &mut self.builder.oddities;
        match plan.role {
            Role::Vertices(_) if colors && !wanted.colors => oddities.add_many(Oddity::VertexColor, count),
            Role::Faces => {
                oddities.add_many(Oddity::FaceColor, if colors { count } else { 0 });
                oddities.add_many(Oddity::CornerUvs, if has("texcoord") { count } else { 0 });
            }
            _ => {}
        }
    }
}
