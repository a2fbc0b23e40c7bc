//! Scenes written in code.

use scene_format::SceneDesc;
use scene_format::desc::{
    Albedo, Amount, BlinnPhong, Color, Diffuse, Effects, Image, Instances, Light, LightGroup, Material, MaterialRef,
    Mesh, MeshSource, Mirror, Name, Object, Part, PixelFilter, Placements, Render, Shading, Sphere, SphereLight,
    Texture, TextureFilter, TextureWrap, ThinLens, Transform, Transparent, Vec3,
};
use scene_format::diagnostic::Spanned;
use std::path::Path;

/// A scene of `size` x `size` pixels with these lights and objects; box filter, no lens, black background.
pub fn scene(size: u32, lights: Vec<SphereLight>, objects: Vec<Object>) -> SceneDesc {
    SceneDesc {
        image: Image { width: size.into(), height: size.into() },
        effects: Effects { antialiasing: PixelFilter::Box, ..Effects::default() },
        lights: lights.into_iter().map(|l| Spanned::from(Light::SphereLight(l))).collect(),
        objects: objects.into_iter().map(Spanned::from).collect(),
        ..SceneDesc::default()
    }
}

/// Changes to a scene, one after the other.
pub trait Describe: Sized {
    fn bounces(self, n: u32) -> Self;
    fn background(self, radiance: Color) -> Self;
    fn camera(self, position: Vec3, look_at: Vec3, fov: f64) -> Self;
    fn filter(self, filter: PixelFilter) -> Self;
    fn lens(self, aperture: f64, focus_distance: f64) -> Self;
}

impl Describe for SceneDesc {
    fn bounces(self, n: u32) -> Self {
        SceneDesc { render: Render { max_bounces: n.into(), ..self.render.clone() }, ..self }
    }
    fn background(self, radiance: Color) -> Self {
        SceneDesc { background: radiance.into(), ..self }
    }
    fn camera(mut self, position: Vec3, look_at: Vec3, fov: f64) -> Self {
        self.camera.position = position.into();
        self.camera.look_at = look_at.into();
        self.camera.fov = fov.into();
        self
    }
    fn filter(mut self, filter: PixelFilter) -> Self {
        self.effects.antialiasing = filter;
        self
    }
    fn lens(mut self, aperture: f64, focus_distance: f64) -> Self {
        self.effects.depth_of_field = Some(ThinLens::new(aperture, focus_distance));
        self
    }
}

/// A light of this radiance.
pub fn light(center: Vec3, radius: f64, radiance: Color) -> SphereLight {
    SphereLight {
        center: center.into(),
        radius: radius.into(),
        amount: Amount::Radiance(radiance).into(),
        color: [1.0; 3],
        camera_visible: true,
        name: Name::default(),
        group: LightGroup::default(),
    }
}

/// A sphere.
pub fn sphere(center: Vec3, radius: f64, material: Material) -> Object {
    Object::Sphere(Box::new(Sphere {
        center: center.into(),
        radius: radius.into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

/// A mesh from a file.
pub fn mesh(file: &Path, material: Material, shading: Shading, transform: Vec<Transform>) -> Object {
    placed(file, material, shading, transform, Placements::One)
}

/// Copies of a mesh, as instances even if they are few.
pub fn placed(
    file: &Path,
    material: Material,
    shading: Shading,
    transform: Vec<Transform>,
    placements: Placements,
) -> Object {
    Object::from(Mesh {
        source: MeshSource::File(file.to_owned().into()),
        part: Part::default(),
        material: inline(material),
        transform: transform.into_iter().map(Spanned::from).collect(),
        placements,
        instances: Instances::Always,
        shading,
        camera_visible: true,
        name: Name::default(),
    })
}

fn inline(material: Material) -> MaterialRef {
    MaterialRef::Inline(Box::new(material.into()))
}

/// Uniform scale about the mesh's barycentre.
pub fn scale(factor: f64) -> Transform {
    Transform::Scale { factor: [factor; 3], about: None }
}

/// Turn about an axis through the mesh's barycentre.
pub fn rotate(axis: Vec3, degrees: f64) -> Transform {
    Transform::Rotate { axis, degrees, about: None }
}

/// Lambert.
pub fn diffuse(albedo: Color) -> Material {
    Material::Diffuse(Diffuse { albedo: Albedo::Color(albedo.into()) })
}

/// Lambert, from a picture.
pub fn textured(file: &Path, filter: TextureFilter, wrap: TextureWrap) -> Material {
    Material::Diffuse(Diffuse { albedo: picture(file, filter, wrap) })
}

/// A picture as an albedo.
pub fn picture(file: &Path, filter: TextureFilter, wrap: TextureWrap) -> Albedo {
    Albedo::Texture(Texture { filter, wrap, ..Texture::of(file.to_owned().into()) })
}

/// A mirror.
pub fn mirror(reflectance: Color) -> Material {
    Material::Mirror(Mirror { reflectance: reflectance.into() })
}

/// A smooth dielectric.
pub fn glass(ior: f64) -> Material {
    Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance: [1.0; 3].into() }))
}

/// Blinn-Phong by the report's formula.
pub fn blinn_phong(albedo: Color, exponent: f64, specular: f64) -> Material {
    glossy(Albedo::Color(albedo.into()), exponent, specular, false)
}

/// Blinn-Phong with the energy-conserving lobe.
pub fn conserving(albedo: Color, exponent: f64, specular: f64) -> Material {
    glossy(Albedo::Color(albedo.into()), exponent, specular, true)
}

/// Blinn-Phong.
pub fn glossy(albedo: Albedo, exponent: f64, specular: f64, energy_conserving: bool) -> Material {
    let [exponent, specular] = [exponent, specular].map(f64::into);
    Material::BlinnPhong(Box::new(BlinnPhong { albedo, exponent, specular, energy_conserving }))
}

/// The room of the report: six diffuse spheres of radius 10000.
pub fn room() -> Vec<Object> {
    let r = 10_000.0;
    let wall = |center: Vec3, albedo: Color| sphere(center, r, diffuse(albedo));
    vec![
        wall([0.0, -20.0 - r, 0.0], [1.0, 1.0, 1.0]),
        wall([0.0, 50.0 + r, 0.0], [1.0, 0.01, 0.01]),
        wall([0.0, 0.0, -50.0 - r], [0.01, 1.0, 1.0]),
        wall([0.0, 0.0, 100.0 + r], [1.0, 0.01, 1.0]),
        wall([-50.0 - r, 0.0, 0.0], [0.01, 1.0, 0.01]),
        wall([50.0 + r, 0.0, 0.0], [0.01, 0.01, 1.0]),
    ]
}

/// The report's light, as a radiance.
pub fn room_light() -> SphereLight {
    light([-10.0, 20.0, 40.0], 5.0, [50.6; 3])
}
