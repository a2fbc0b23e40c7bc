//! Meshes: files loaded once each, and what the scene writes out, placed as often as the scene says, brought into
//! render space.
//!
//! A mesh that is placed once is moved vertex by vertex, in f64, and so is each copy of one whose copies are few
//! triangles together ([`flattened`]). Any other stays in a frame of its own, recentred and scaled by a power of two to
//! a size of about one, and its instances carry matrices.

use super::assets::Sources;
use super::kept::build_tree;
pub use super::loading::{Loaded, load};
use super::materials::MaterialBuilder;
use super::placed::Placed;
use super::polygonal::{Geometry, Polygonal, polygonal};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use scene_format::desc::{Emissive, Instances, MaterialRef, Placements, Radiometric, Shading};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use std::sync::Arc;
use tracer_kernels::bvh;
use tracer_kernels::scene::materials::BxdfFlags;
use tracer_kernels::scene::{FlatLight, Frame, Instance, Light, Material, Mesh, NONE, Shape, Solids, Triangles};
use tracer_kernels::shapes::Row;
use tracer_mesh::{MeshData, NO_INDEX, normals::vertex_normals};

/// Which material each object of triangles has.
pub struct Assigned {
    /// Per object: one for all of it, or [`NONE`] for what its file says per triangle.
    of_object: Vec<u32>,
    /// Per object: how all of it shines, where it does.
    emissive: Vec<Option<Arc<Emissive>>>,
    /// Per file: materials of its triangles' material indices, with the default last; empty where no object asks for
    /// them.
    of_file: Vec<Vec<u32>>,
    /// Per file the radiance of each of these that shines; empty where none does.
    shining: Vec<Vec<Option<[f64; 3]>>>,
}

/// Resolves the materials of the objects: what the scene names, else those of the file, else the default.
pub fn assign_materials(
    desc: &SceneDesc,
    loaded: &Loaded,
    builder: &mut MaterialBuilder,
    diagnostics: &mut Diagnostics,
) -> Assigned {
    let count = loaded.files.len();
    let mut assigned = Assigned {
        of_object: Vec::new(),
        emissive: Vec::new(),
        of_file: vec![Vec::new(); count],
        shining: vec![Vec::new(); count],
    };
    for (object, file) in polygonal(desc).zip(&loaded.file_of_object) {
        let own = file.filter(|&f| !loaded.files[f].triangle_material.is_empty());
        let whole = match (object.material, own) {
            (MaterialRef::Default, Some(f)) => {
                if assigned.of_file[f].is_empty() {
                    assigned.of_file[f] = loaded.files[f]
                        .materials
                        .iter()
                        .map(|m| builder.add(&m.material, None, || m.name.value.to_string()))
                        .collect();
                    assigned.of_file[f].push(builder.default_material());
                    let radiance = |&material: &u32| match builder.emissive(material)?.radiometric() {
                        Radiometric::Radiance(radiance) => Some(radiance),
                        // What files say is radiance.
                        Radiometric::Intensity(_) | Radiometric::Power(_) => None,
                    };
                    let shining: Vec<_> = assigned.of_file[f].iter().map(radiance).collect();
                    if shining.iter().any(Option::is_some) {
                        assigned.shining[f] = shining;
                    }
                }
                NONE
            }
            (reference, _) => builder.resolve(reference, object.number, diagnostics),
        };
        assigned.of_object.push(whole);
        assigned.emissive.push(builder.emissive(whole).cloned());
    }
    assigned
}

impl Assigned {
    /// Whether anything shines by the materials of its own file.
    pub fn shines_by_file(&self) -> bool {
        self.shining.iter().any(|materials| !materials.is_empty())
    }

    /// What the file's own materials shine that an object has.
    fn own_radiance(&self, object: usize, file: usize) -> impl Iterator<Item = [f64; 3]> {
        let own = if self.of_object[object] == NONE { &self.shining[file][..] } else { &[] };
        own.iter().flatten().copied()
    }
}

/// What the copies of an object shine, per copy; empty where it does not. L = P / (pi A), or I / A. Of an object that
/// shines by materials of its file, what each of these shines.
pub fn radiances(loaded: &Loaded, placed: &Placed, assigned: &Assigned) -> Vec<Vec<[f64; 3]>> {
    let of_object = |(object, emissive): (usize, &Option<Arc<Emissive>>)| {
        let Some(file) = loaded.file_of_object[object] else { return Vec::new() };
        let Some(emissive) = emissive else {
            // Copies are alike.
            let is_there = !placed.maps[object].is_empty();
            return assigned.own_radiance(object, file).filter(|_| is_there).collect();
        };
        let data = &loaded.files[file];
        let of_area = |amount: [f64; 3], area: f64| amount.map(|x| if area > 0.0 { x / area } else { 0.0 });
        let radiance = |map: &DAffine3| match emissive.radiometric() {
            Radiometric::Radiance(radiance) => radiance,
            // Along the normal: only flat shapes have one.
            Radiometric::Intensity(intensity) => of_area(intensity, area(data, map)),
            Radiometric::Power(power) => {
                let sides = if emissive.two_sided { 2.0 } else { 1.0 };
                of_area(power, std::f64::consts::PI * sides * area(data, map))
            }
        };
        placed.maps[object].iter().map(radiance).collect()
    };
    assigned.emissive.iter().enumerate().map(of_object).collect()
}

/// The area of a mesh under a map.
fn area(data: &MeshData, map: &DAffine3) -> f64 {
    let corner = |k: u32| map.transform_point3(DVec3::from(data.positions[k as usize]));
    let area = |&[a, b, c]: &[u32; 3]| 0.5 * (corner(b) - corner(a)).cross(corner(c) - corner(a)).length();
    data.triangles.iter().map(area).sum()
}

/// The meshes of a compiled scene.
#[derive(Default)]
pub struct Built {
    /// The lights that are made of triangles.
    pub lights: Vec<Light>,
    /// Each mesh once.
    pub meshes: Vec<Mesh>,
    /// All triangles.
    pub triangles: Triangles,
    /// Copies: of which mesh, and where. The tree is built of them.
    pub copies: Vec<bvh::InstanceGeometry>,
    /// Per copy its material, or [`NONE`] for those of its triangles, and its object.
    pub of_copies: Vec<[u32; 2]>,
    /// Per copy which of the coordinates that [`build`] was given it is written in; empty where nobody asks.
    pub coordinates: Vec<u32>,
    /// Objects whose materials by their files would shine, but whose copies share their triangles.
    pub unlit: Vec<Span>,
    /// Per mesh the file that it is of, and its first vertex.
    pub vertices_of: Vec<(usize, u32)>,
}

/// A mesh as it enters the scene: a file, smooth or flat.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Variant {
    file: usize,
    smooth: bool,
}

/// Copies that have so many triangles together at most, and are at most so many, are flattened. Rays that enter an
/// instance are up to a third slower than others; so many triangles are built in about a tenth of a second and take 20
/// to 35 MB (docs/performance.md: two to three million triangles a second, 80 to 130 bytes each).
const FLATTENED_TRIANGLES: usize = 1 << 18;
const FLATTENED_COPIES: usize = 1024;
/// So many boxes at most have triangles of their own: each takes 1.3 kB of the tree. Of so many rays take no longer
/// where they share their triangles, and the tree is built in a twelfth of the time; of fewer that was not measured.
const FLATTENED_BOXES: usize = 1 << 18;

/// Whether each copy of this object has its own triangles; `copies`: those of all objects with this mesh.
fn flattened(object: &Polygonal<'_>, copies: usize, triangles: usize) -> bool {
    copies == 1
        || match object.instances {
            Instances::Auto if matches!(object.geometry, Geometry::Unit(_)) => copies <= FLATTENED_BOXES,
            Instances::Auto => copies <= FLATTENED_COPIES && copies.saturating_mul(triangles) <= FLATTENED_TRIANGLES,
            Instances::Always => false,
            Instances::Never => true,
        }
}

/// What [`build`] builds.
pub struct Parts<'a> {
    /// The scene.
    pub desc: &'a SceneDesc,
    /// Its meshes.
    pub loaded: &'a Loaded,
    /// Where they are.
    pub placed: &'a Placed,
    /// Their materials.
    pub assigned: &'a Assigned,
    /// What they shine, in the scene's own unit.
    pub radiances: &'a [Vec<[f64; 3]>],
    /// The engine's unit of radiance.
    pub radiance_unit: f64,
    /// Index of the first light that is made of triangles.
    pub first_light: u32,
}

/// The objects of triangles, each with the mesh that it is. There may be millions: they are gone through, not kept.
fn variants<'d>(desc: &'d SceneDesc, loaded: &'d Loaded) -> impl Iterator<Item = (Polygonal<'d>, Option<Variant>)> {
    let variant = |object: &Polygonal<'_>, file: usize| Variant {
        file,
        smooth: match object.shading {
            Shading::Smooth => true,
            Shading::Flat => false,
            Shading::Auto => !loaded.files[file].normals.is_empty(),
        },
    };
    polygonal(desc).zip(&loaded.file_of_object).map(move |(object, file)| {
        let variant = file.map(|file| variant(&object, file));
        (object, variant)
    })
}

/// Brings the meshes into render space. `written`, where a pattern asks for it: from the coordinates that things are
/// written in to the world, the first the world's own.
pub fn build(frame: &Frame, parts: &Parts<'_>, mut written: Option<&mut Vec<DAffine3>>) -> Built {
    let Parts { desc, loaded, placed, assigned, .. } = *parts;
    let mut copies: BTreeMap<Variant, usize> = BTreeMap::new();
    for ((_, variant), maps) in variants(desc, loaded).zip(&placed.maps) {
        if let Some(variant) = variant {
            *copies.entry(variant).or_default() += maps.len();
        }
    }
    let mut built = Built::default();
    built.reserve(copies.values().sum());
    // Meshes that are shared: where each is, and how it is put back into the frame of its file.
    let mut shared: BTreeMap<Variant, (u32, DAffine3)> = BTreeMap::new();
    let scaled = DAffine3::from_scale(DVec3::splat(frame.scale));
    for (object, (polygonal, variant)) in variants(desc, loaded).enumerate() {
        let Some(variant) = variant else { continue };
        let data = &loaded.files[variant.file];
        let whole = assigned.of_object[object];
        let own_materials = &assigned.of_file[variant.file];
        // Subtract the centre before scaling: nothing is lost far away from the world's origin.
        let worlds = placed.maps[object]
            .iter()
            .map(|map| DAffine3 { matrix3: map.matrix3, translation: map.translation - frame.centre });
        if let Some(written) = written.as_mut() {
            built.add_coordinates(&polygonal, &placed.maps[object], written);
        }
        let flat = flattened(&polygonal, copies[&variant], data.triangles.len());
        let shines_in_part = assigned.own_radiance(object, variant.file).next().is_some();
        // Copies that share their triangles are no lights: of a thousand meshes of which a lamp is a part, each would
        // have to have all its triangles.
        if shines_in_part && !flat {
            built.unlit.push(polygonal.span);
        }
        let shines = assigned.emissive[object].is_some() || shines_in_part && flat;
        if shines || flat {
            for (copy, world) in worlds.enumerate() {
                built.vertices_of.push((variant.file, built.triangles.positions.len() as u32));
                let mesh = built.add_mesh(data, variant.smooth, &world, frame.scale, whole, own_materials);
                built.add_copy(bvh::InstanceGeometry { mesh, placement: None }, whole, polygonal.number);
                if shines {
                    let quads = matches!(polygonal.geometry, Geometry::Unit(_));
                    let mirrored = world.matrix3.determinant() < 0.0;
                    built.add_lights_of(parts, (object, copy), variant.file, (mesh, quads, mirrored));
                }
            }
            continue;
        }
        let (mesh, file_from_object) = *shared.entry(variant).or_insert_with(|| {
            let [low, high] = placed.box_of(object);
            let centre = (low + high) * 0.5;
            let size = (high - low).max_element();
            let exponent = if size > 0.0 { libm::ilogb(size) } else { 0 };
            let scale = libm::scalbn(1.0, -exponent);
            let to_object = DAffine3::from_translation(-centre);
            built.vertices_of.push((variant.file, built.triangles.positions.len() as u32));
            let mesh = built.add_mesh(data, variant.smooth, &to_object, scale, NONE, own_materials);
            (mesh, DAffine3 { translation: centre, ..DAffine3::from_scale(DVec3::splat(1.0 / scale)) })
        });
        for world in worlds {
            let placement = Some(rows(&(scaled * world * file_from_object)));
            built.add_copy(bvh::InstanceGeometry { mesh, placement }, whole, polygonal.number);
        }
    }
    if !built.triangles.light.is_empty() {
        // What lies beyond the end of a column reads its last entry.
        built.triangles.light.push(NONE);
    }
    built
}

/// The rows of a map as single precision.
fn rows(map: &DAffine3) -> [[f32; 4]; 3] {
    [0, 1, 2].map(|r| {
        let row = map.matrix3.row(r);
        [row.x as f32, row.y as f32, row.z as f32, map.translation[r] as f32]
    })
}

impl Built {
    /// Makes room for so many copies: of millions a list that grows is in memory one and a half times too often.
    fn reserve(&mut self, copies: usize) {
        self.copies.reserve_exact(copies);
        self.of_copies.reserve_exact(copies);
    }

    fn add_copy(&mut self, copy: bvh::InstanceGeometry, material: u32, object: u32) {
        self.copies.push(copy);
        self.of_copies.push([material, object]);
    }

    /// The copies as they are rendered. Trees are built before they are made: nothing takes more memory than that.
    pub fn instances(&self) -> Vec<Instance> {
        let instance = |(copy, &[material, object]): (&bvh::InstanceGeometry, &[u32; 2])| {
            let &bvh::InstanceGeometry { mesh, placement } = copy;
            Instance { mesh, material, object, placement }
        };
        self.copies.iter().zip(&self.of_copies).map(instance).collect()
    }

    /// The tree over these meshes, the first `spheres`, and the shapes, whose first has the id `first_shape`; planes
    /// are the last of them. What is left out keeps its numbers.
    #[allow(clippy::too_many_arguments)]
    pub fn tree(
        &self,
        acceleration: bvh::Acceleration,
        spheres: &[bvh::SphereGeometry],
        (shapes, solids): (&[Shape], &Solids),
        first_shape: u32,
        materials: &[Material],
        sources: &Sources<'_>,
        left_out: bvh::LeftOut<'_>,
    ) -> Result<Arc<bvh::Accel>, bvh::BuildError> {
        let first_primitive = first_shape + shapes.len() as u32;
        let t = &self.triangles;
        let meshes: Vec<bvh::MeshGeometry> = self
            .meshes
            .iter()
            .map(|m| bvh::MeshGeometry {
                positions: &t.positions,
                triangles: &t.vertices[m.first_triangle as usize..][..m.triangle_count as usize],
                first_primitive: first_primitive + m.first_triangle,
            })
            .collect();
        let (bounded, endless) = shapes.split_at(shapes.partition_point(|shape| !shape.unit.is_endless()));
        let placed: Vec<bvh::ShapeGeometry> = bounded.iter().map(Shape::geometry).collect();
        let planes: Vec<Row> = endless.iter().map(|shape| Row::new(&shape.unit, &shape.placement)).collect();
        let (meshes, instances) = (&meshes[..], &self.copies[..]);
        let (parts, planes) = (&solids.parts[..], &planes[..]);
        let shapes_placed = &placed[..];
        let geometry =
            bvh::Geometry { spheres, shapes: shapes_placed, first_shape, parts, planes, meshes, instances, left_out };
        build_tree((sources.kept, sources.store), &geometry, acceleration, &self.ranks(shapes, materials))
    }

    /// Adds what the copies of an object are written in.
    fn add_coordinates(&mut self, object: &Polygonal<'_>, maps: &[DAffine3], written: &mut Vec<DAffine3>) {
        if object.transform.is_empty() && matches!(object.placements, Placements::One) {
            self.coordinates.push(0);
            return;
        }
        let from_written = object.local.inverse();
        for map in maps {
            self.coordinates.push(written.len() as u32);
            written.push(*map * from_written);
        }
    }

    /// Who wins where surfaces lie in one place: what shines, then what lets no light through.
    fn ranks(&self, shapes: &[Shape], materials: &[Material]) -> bvh::Ranks {
        let of_material = |index: u32| match materials.get(index as usize) {
            Some(material) if material.traits().flags.has(BxdfFlags::TRANSMISSION) => bvh::TRANSMITS,
            _ => 1,
        };
        let t = &self.triangles;
        let shines = |triangle: usize| t.light.get(triangle).is_some_and(|&light| light != NONE);
        let of_triangle = |(triangle, &material)| if shines(triangle) { 0 } else { of_material(material) };
        let of_shape = |shape: &Shape| if shape.light == NONE { of_material(shape.material) } else { 0 };
        let of_copy = |&[material, _]: &[u32; 2]| (material != NONE).then_some(material);
        bvh::Ranks {
            triangles: t.material.iter().enumerate().map(of_triangle).collect(),
            instances: self.of_copies.iter().map(|of| of_copy(of).map(of_material)).collect(),
            shapes: shapes.iter().map(of_shape).collect(),
            materials: (0..materials.len() as u32).any(|k| of_material(k) == bvh::TRANSMITS).then(|| bvh::Materials {
                triangles: t.material.clone(),
                instances: self.of_copies.iter().map(of_copy).collect(),
                shapes: shapes.iter().map(|shape| shape.material).collect(),
            }),
        }
    }

    /// Adds a mesh, its vertices mapped and then scaled; gives its index. `whole`: one material for all triangles, or
    /// [`NONE`].
    fn add_mesh(
        &mut self,
        data: &MeshData,
        smooth: bool,
        map: &DAffine3,
        scale: f64,
        whole: u32,
        own_materials: &[u32],
    ) -> u32 {
        let t = &mut self.triangles;
        let first_triangle = t.vertices.len() as u32;
        let first_vertex = t.positions.len();
        let mirrored = map.matrix3.determinant() < 0.0;
        // A mirrored mesh winds the other way: swapping two corners keeps its outside outside.
        let wound = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        let shifted = |first: usize| {
            let first = first as u32;
            move |corner: u32| if corner == NO_INDEX { NONE } else { corner + first }
        };
        extend(&mut t.positions, &data.positions, |p| {
            (map.transform_point3(DVec3::from(*p)) * scale).as_vec3().to_array()
        });
        extend(&mut t.vertices, &data.triangles, |v| wound(*v).map(shifted(first_vertex)));

        if smooth {
            let computed;
            let (normals, indices) = if data.normals.is_empty() {
                computed = vertex_normals(&data.positions, &data.triangles);
                (&computed, &data.triangles)
            } else {
                (&data.normals, data.normal_triangles.as_ref().unwrap_or(&data.triangles))
            };
            let first = t.normals.len();
            // Inverse transpose; turned along when the map mirrors, because the outside stays outside.
            let inverse = map.matrix3.inverse().transpose();
            extend(&mut t.normals, normals, |n| {
                (inverse * DVec3::from(n.map(f64::from))).normalize_or_zero().as_vec3().to_array()
            });
            t.normal_indices.resize(first_triangle as usize, [NONE; 3]);
            // A triangle with a corner that has no normal is flat.
            extend(&mut t.normal_indices, indices, |n| {
                if n.contains(&NO_INDEX) { [NONE; 3] } else { wound(*n).map(shifted(first)) }
            });
        } else if !t.normal_indices.is_empty() {
            t.normal_indices.resize(t.vertices.len(), [NONE; 3]);
        }

        if !data.uvs.is_empty() {
            let first = t.uvs.len();
            t.uvs.extend_from_slice(&data.uvs);
            t.uv_indices.resize(first_triangle as usize, [NONE; 3]);
            let indices = data.uv_triangles.as_ref().unwrap_or(&data.triangles);
            extend(&mut t.uv_indices, indices, |n| {
                if n.contains(&NO_INDEX) { [NONE; 3] } else { wound(*n).map(shifted(first)) }
            });
        } else if !t.uv_indices.is_empty() {
            t.uv_indices.resize(t.vertices.len(), [NONE; 3]);
        }

        let material = |k: usize| match (whole, own_materials.split_last()) {
            (NONE, Some((&default, own))) => {
                data.triangle_material.get(k).and_then(|&m| own.get(m as usize)).copied().unwrap_or(default)
            }
            (NONE, None) => 0,
            (whole, _) => whole,
        };
        t.material.extend((0..data.triangles.len()).map(material));
        self.meshes.push(Mesh { first_triangle, triangle_count: data.triangles.len() as u32 });
        self.meshes.len() as u32 - 1
    }

    /// Makes lights of the triangles of a copy that shines, in whole or in part; `mesh`: its own, whether it is made of
    /// quads, and whether it is mirrored.
    fn add_lights_of(
        &mut self,
        parts: &Parts<'_>,
        (object, copy): (usize, usize),
        file: usize,
        (mesh, quads, mirrored): (u32, bool, bool),
    ) {
        let in_unit = |radiance: [f64; 3]| radiance.map(|x| x / parts.radiance_unit);
        if let Some(emissive) = &parts.assigned.emissive[object] {
            let radiance = in_unit(parts.radiances[object][copy]);
            let shine = Shine { two_sided: emissive.two_sided, quads, mirrored };
            self.add_lights(mesh, &shine, parts.first_light, |_| Some(radiance));
            return;
        }
        let (materials, own) = (&parts.loaded.files[file].triangle_material, &parts.assigned.shining[file]);
        let radiance = |triangle: usize| {
            let material = *materials.get(triangle)?;
            own.get(material as usize).copied().flatten().map(in_unit)
        };
        // What files say shines to both sides.
        let shine = Shine { two_sided: true, quads, mirrored };
        self.add_lights(mesh, &shine, parts.first_light, radiance);
    }

    /// Makes lights of a mesh's triangles, or of their pairs where those are parallelograms; `first`: the index of the
    /// first of [`Built::lights`] among all lights. `radiance`: of a triangle of the mesh, in the engine's unit.
    fn add_lights(&mut self, mesh: u32, shine: &Shine, first: u32, radiance: impl Fn(usize) -> Option<[f64; 3]>) {
        let Mesh { first_triangle, triangle_count } = self.meshes[mesh as usize];
        let t = &mut self.triangles;
        t.light.resize(first_triangle as usize, NONE);
        for triangle in first_triangle..first_triangle + triangle_count {
            let Some(radiance) = radiance((triangle - first_triangle) as usize) else {
                t.light.push(NONE);
                continue;
            };
            let second = shine.quads && (triangle - first_triangle) % 2 == 1;
            if !second && let Some([a, b, c]) = t.corners(triangle) {
                // Of a pair the first triangle is (p, q, r), the second (p, r, s) with s = p + r - q, where none is
                // mirrored: then (p, r, q). Edges from q span both.
                let [corner, first, second] = match (shine.quads, shine.mirrored) {
                    (false, _) => [a, b, c],
                    (true, false) => [b, c, a],
                    (true, true) => [c, a, b],
                };
                let two_sided = shine.two_sided;
                let edges = [first - corner, second - corner];
                let flat = FlatLight { corner, edges, radiance, two_sided, offset: 0.0 };
                self.lights.push(if shine.quads { Light::Parallelogram(flat) } else { Light::Triangle(flat) });
            }
            t.light.push(first + self.lights.len() as u32 - 1);
        }
    }
}

/// How a mesh shines.
struct Shine {
    two_sided: bool,
    /// Its triangles are pairs that make parallelograms.
    quads: bool,
    /// It was mirrored.
    mirrored: bool,
}

/// From this many on, things are mapped by all threads.
const PARALLEL: usize = 4096;

/// Appends what becomes of each of these.
fn extend<T: Sync, U: Send>(to: &mut Vec<U>, from: &[T], map: impl Fn(&T) -> U + Sync + Send) {
    if from.len() < PARALLEL {
        to.extend(from.iter().map(map));
    } else {
        to.par_extend(from.par_iter().map(map));
    }
}
