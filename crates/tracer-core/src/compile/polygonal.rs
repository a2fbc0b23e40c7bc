//! Objects that become triangles: meshes, and the shapes with flat sides, each of which is one unit shape under an
//! affine map: exact, watertight, and one set of vertices for a million boxes.

use super::placing::sides;
use glam::{DAffine3, DMat3, DVec3};
use scene_format::SceneDesc;
use scene_format::desc::{
    HeightField, InlineMesh, Instances, MaterialRef, MeshSource, Object, Placements, RectBox, Rectangle, Shading,
    Transform,
};
use scene_format::diagnostic::{Span, Spanned};
use std::path::Path;
use std::sync::Arc;
use tracer_mesh::MeshData;
use tracer_mesh::shapes::{Triangulated, of_object};

/// Where triangles come from.
#[derive(Clone, Copy)]
pub enum Geometry<F, I, M, H> {
    /// A file.
    File(F),
    /// The scene.
    Inline(I),
    /// A shape of a size of one about the origin.
    Unit(UnitShape),
    /// A shape whose triangles are made for it.
    Made(M),
    /// A shape that is made of a picture.
    Heights(H),
}

/// A shape of a size of one about the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitShape {
    /// In the plane z = 0, facing +z; x is to the right, y up.
    Square,
    /// Its sides along the axes.
    Cube,
}

/// An object that becomes triangles.
pub struct Polygonal<'a> {
    /// Its place among the objects of the scene.
    pub number: u32,
    /// Its triangles, in a frame of their own.
    pub geometry: Geometry<&'a Spanned<Arc<Path>>, &'a Spanned<InlineMesh>, &'a dyn Triangulated, &'a HeightField>,
    /// From that frame to the one that the object is written in.
    pub local: DAffine3,
    /// Its material.
    pub material: &'a MaterialRef,
    /// Its transforms.
    pub transform: &'a [Spanned<Transform>],
    /// Its copies.
    pub placements: &'a Placements,
    /// Whether copies share triangles.
    pub instances: Instances,
    /// Its normals.
    pub shading: Shading,
    /// Where it stands in the scene.
    pub span: Span,
    /// The part of its file that it is, if it is no whole file.
    pub part: Option<&'a Spanned<String>>,
    /// `mesh`
    pub noun: &'static str,
}

/// The objects of a scene that become triangles, in order.
pub fn polygonal(desc: &SceneDesc) -> impl Iterator<Item = Polygonal<'_>> {
    (0..).zip(&desc.objects).filter_map(|(number, object)| {
        let of_unit = |shape: UnitShape, local: DAffine3, noun: &'static str| {
            Some(Polygonal {
                number,
                geometry: Geometry::Unit(shape),
                local,
                material: object.value.material(),
                transform: object.value.transform(),
                placements: object.value.placements(),
                instances: match shape {
                    // As many triangles as an instance takes memory.
                    UnitShape::Square => Instances::Never,
                    UnitShape::Cube => Instances::Auto,
                },
                shading: Shading::Flat,
                span: object.span,
                part: None,
                noun,
            })
        };
        match &object.value {
            Object::Rectangle(rectangle) => of_unit(UnitShape::Square, of_rectangle(rectangle), "rectangle"),
            Object::Box(cuboid) if !cuboid.is_rounded() => of_unit(UnitShape::Cube, of_box(cuboid), "box"),
            Object::Mesh(mesh) => Some(Polygonal {
                number,
                geometry: match &mesh.source {
                    MeshSource::File(file) => Geometry::File(file),
                    MeshSource::Inline(inline) => Geometry::Inline(inline),
                },
                local: DAffine3::IDENTITY,
                material: &mesh.material,
                transform: &mesh.transform,
                placements: &mesh.placements,
                instances: mesh.instances,
                shading: mesh.shading,
                span: object.span,
                part: mesh.part.name(),
                noun: "mesh",
            }),
            Object::HeightField(field) => Some(of_made(number, object, Geometry::Heights(&**field), "height field")),
            other => of_object(other).map(|shape| of_made(number, object, Geometry::Made(shape), shape.noun())),
        }
    })
}

/// A shape whose triangles are made for it, where it is written.
fn of_made<'a>(
    number: u32,
    object: &'a Spanned<Object>,
    geometry: Geometry<&'a Spanned<Arc<Path>>, &'a Spanned<InlineMesh>, &'a dyn Triangulated, &'a HeightField>,
    noun: &'static str,
) -> Polygonal<'a> {
    Polygonal {
        number,
        geometry,
        local: DAffine3::IDENTITY,
        material: object.value.material(),
        transform: object.value.transform(),
        placements: object.value.placements(),
        instances: Instances::Auto,
        shading: Shading::Auto,
        span: object.span,
        part: None,
        noun,
    }
}

/// From the unit square to a rectangle.
fn of_rectangle(rectangle: &Rectangle) -> DAffine3 {
    let [right, up, normal] = sides(DVec3::from(rectangle.normal.value));
    let [width, height] = rectangle.size.value.0;
    DAffine3 {
        matrix3: DMat3::from_cols(right * width, up * height, normal),
        translation: DVec3::from(rectangle.center.value),
    }
}

/// A box as an operand of a solid.
pub(super) fn cube(object: &Object) -> Option<super::curved::Written> {
    let Object::Box(cuboid) = object else { return None };
    if cuboid.is_rounded() {
        return None;
    }
    Some(super::curved::Written { unit: tracer_kernels::shapes::UnitShape::Cube, local: of_box(cuboid), noun: "box" })
}

/// From the unit cube to a box.
fn of_box(cuboid: &RectBox) -> DAffine3 {
    DAffine3 {
        matrix3: DMat3::from_diagonal(DVec3::from(cuboid.size.value.0)),
        translation: DVec3::from(cuboid.center.value),
    }
}

impl UnitShape {
    /// Its triangles: pairs that make parallelograms, each (a, b, c) and (a, c, d) with texture coordinates from 0 to
    /// 1.
    pub fn mesh(self) -> MeshData {
        const UVS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let faces: Vec<[DVec3; 3]> = match self {
            UnitShape::Square => vec![[DVec3::X, DVec3::Y, DVec3::ZERO]],
            UnitShape::Cube => {
                let outward = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
                outward.map(|n| sides(n).map(DVec3::round)).map(|[right, up, n]| [right, up, n]).to_vec()
            }
        };
        let mut mesh = MeshData { uvs: UVS.to_vec(), uv_triangles: Some(Vec::new()), ..MeshData::default() };
        for [right, up, middle] in faces {
            let corner = |k: usize| {
                let [u, v] = UVS[k].map(|t| f64::from(t) - 0.5);
                (right * u + up * v + middle * 0.5).to_array()
            };
            let at = [0, 1, 2, 3].map(|k| {
                // The corners of a box are one vertex each, so that it is closed.
                let known = mesh.positions.iter().position(|p| *p == corner(k));
                known.unwrap_or_else(|| {
                    mesh.positions.push(corner(k));
                    mesh.positions.len() - 1
                }) as u32
            });
            mesh.triangles.extend([[at[0], at[1], at[2]], [at[0], at[2], at[3]]]);
            mesh.uv_triangles.get_or_insert_default().extend([[0, 1, 2], [0, 2, 3]]);
        }
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Right, up and normal of each face as the manual says them, by the corners' texture coordinates; closed and
    /// outwards.
    #[test]
    fn unit_shapes_face_outwards_with_upright_textures() {
        for (shape, faces) in [(UnitShape::Square, 1), (UnitShape::Cube, 6)] {
            let mesh = shape.mesh();
            assert_eq!(mesh.triangles.len(), 2 * faces);
            let of_uvs = mesh.uv_triangles.as_ref().expect("has some");
            let mut volume = 0.0;
            for (corners, uvs) in mesh.triangles.iter().zip(of_uvs) {
                let [a, b, c] = corners.map(|k| DVec3::from(mesh.positions[k as usize]));
                let n = (b - a).cross(c - a).normalize();
                volume += a.dot(b.cross(c)) / 6.0;
                let [right, up, normal] = sides(n);
                assert!((normal - n).length() < 1e-12);
                for (p, uv) in [a, b, c].into_iter().zip(uvs.map(|k| mesh.uvs[k as usize])) {
                    let expected = [right.dot(p) + 0.5, up.dot(p) + 0.5];
                    assert!((0..2).all(|k| (f64::from(uv[k]) - expected[k]).abs() < 1e-12), "{uv:?} {expected:?}");
                }
            }
            assert!((volume - if faces == 6 { 1.0 } else { 0.0 }).abs() < 1e-12);
            assert_eq!(mesh.positions.len(), if faces == 6 { 8 } else { 4 });
        }
    }

    #[test]
    fn sides_are_a_frame_for_every_normal() {
        for n in
            [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1e-6, 1.0, -1e-6], [1.0, 2.0, 3.0], [0.0, 0.0, -1e9], [1e-9, 0.0, 0.0]]
        {
            let [right, up, normal] = sides(DVec3::from(n));
            assert!((normal - DVec3::from(n).normalize()).length() < 1e-12);
            for (a, b) in [(right, up), (up, normal), (normal, right)] {
                assert!(a.dot(b).abs() < 1e-12 && (a.length() - 1.0).abs() < 1e-12, "{n:?}");
            }
            assert!(right.cross(up).dot(normal) > 0.999);
        }
        assert_eq!(sides(DVec3::Y), [DVec3::X, DVec3::NEG_Z, DVec3::Y]);
    }
}
