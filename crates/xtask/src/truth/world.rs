//! A scene that is being made: what a person would write, and the files beside it.

use super::meshes::{Point, Shape};
use anyhow::Context as _;
use scene_format::desc::{
    Albedo, Amount, Color, Diffuse, Faces, Image, InlineMesh, Instances, Light, LightGroup, Material, MaterialRef,
    Mesh, MeshSource, Mirror, Name, Object, Part, Placements, Shading, Sphere, SphereLight, Transform, Transparent,
};
use scene_format::diagnostic::Spanned;
use scene_format::{Defaults, SceneDesc, to_ron};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene and the files that it names.
#[derive(Clone, Debug)]
pub struct World {
    /// The scene; its files are named as in `files`.
    pub desc: SceneDesc,
    /// Contents by name.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl World {
    /// Nothing yet; a picture of `size` x `size` pixels.
    pub fn new(size: u32) -> Self {
        let image = Image { width: size.into(), height: size.into() };
        World { desc: SceneDesc { image, ..SceneDesc::default() }, files: BTreeMap::new() }
    }

    /// Adds a file; the name says what is in it, so that equal files are one.
    pub fn file(&mut self, name: &str, ending: &str, bytes: Vec<u8>) -> PathBuf {
        // Fowler, Noll and Vo: FNV-1a.
        let hash =
            bytes.iter().fold(0xcbf2_9ce4_8422_2325u64, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let name = format!("{name}-{:08x}.{ending}", hash as u32);
        self.files.insert(name.clone(), bytes);
        PathBuf::from(name)
    }

    /// Adds a sphere.
    pub fn sphere(&mut self, center: Point, radius: f64, material: Material) {
        let material = inline(material);
        let sphere = Sphere {
            center: center.into(),
            radius: radius.into(),
            material,
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        };
        self.desc.objects.push(Object::Sphere(Box::new(sphere)).into());
    }

    /// Adds a mesh as it stands.
    pub fn mesh(&mut self, name: &str, shape: &Shape, material: Material) {
        let is_part = self.desc.objects.len().is_multiple_of(2);
        let text = if is_part {
            // With another one behind it, which does not show.
            format!("o it\n{}o other\nv 0 9 0\nv 9 9 0\nv 0 9 9\nf -3 -2 -1\n", shape.obj())
        } else {
            shape.obj()
        };
        let file = self.file(name, "obj", text.into_bytes());
        let part = Part::from(is_part.then_some("it"));
        self.place((MeshSource::File(file.into()), part), material, Vec::new());
    }

    /// Adds a mesh from one of the files.
    pub fn placed(&mut self, file: PathBuf, material: Material, transform: Vec<Transform>) {
        self.place((MeshSource::File(file.into()), Part::default()), material, transform);
    }

    /// Adds a mesh that the scene writes out, without normals and texture coordinates, with the colours of its points
    /// or none.
    pub fn written_out(
        &mut self,
        (shape, colors): (&Shape, Vec<Color>),
        material: Material,
        transform: Vec<Transform>,
    ) {
        let mut faces = Faces::default();
        shape.triangles.iter().for_each(|corners| faces.push(&corners.map(|corner| corner as u32)));
        let mesh = InlineMesh { points: shape.positions.clone(), faces, colors };
        self.place((MeshSource::Inline(Arc::new(mesh.into())), Part::default()), material, transform);
    }

    fn place(&mut self, (source, part): (MeshSource, Part), material: Material, transform: Vec<Transform>) {
        let mesh = Mesh {
            source,
            part,
            material: inline(material),
            transform: transform.into_iter().map(Spanned::from).collect(),
            placements: Placements::One,
            instances: Instances::Auto,
            shading: Shading::Auto,
            camera_visible: true,
            name: Name::default(),
        };
        self.desc.objects.push(Object::from(mesh).into());
    }

    /// Adds a lamp of this radiance.
    pub fn lamp(&mut self, center: Point, radius: f64, radiance: Color) {
        let amount = Amount::Radiance(radiance).into();
        let light = SphereLight {
            center: center.into(),
            radius: radius.into(),
            amount,
            color: [1.0; 3],
            camera_visible: true,
            name: Name::default(),
            group: LightGroup::default(),
        };
        self.desc.lights.push(Light::SphereLight(light).into());
    }

    /// Where the camera stands.
    pub fn camera(&mut self, position: Point, look_at: Point, fov: f64) {
        self.desc.camera.position = position.into();
        self.desc.camera.look_at = look_at.into();
        self.desc.camera.fov = fov.into();
    }

    /// Says how many bounces.
    pub fn bounces(&mut self, n: u32) {
        self.desc.render.max_bounces = n.into();
    }

    /// The scene as text, with a comment before it.
    pub fn text(&self, comment: &str) -> String {
        let comment: String = comment.lines().map(|line| format!("// {line}\n")).collect();
        comment + &to_ron(&self.desc, Defaults::Hidden)
    }

    /// Writes scene and files into a folder; gives where the scene is.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, folder: &Path, name: &str, comment: &str) -> anyhow::Result<PathBuf> {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
        let write = |name: &str, bytes: &[u8]| {
            let path = folder.join(name);
            std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display())).map(|()| path)
        };
        // What shrinking has left over is not written.
        let text = self.text(comment);
        for (name, bytes) in self.files.iter().filter(|(name, _)| text.contains(name.as_str())) {
            write(name, bytes)?;
        }
        write(&format!("{name}.ron"), text.as_bytes())
    }

    /// The way of every scene: written, loaded, compiled.
    ///
    /// # Errors
    /// The scene is refused: the generator draws what is not legal, or the loader refuses what is.
    pub fn compiled(&self) -> anyhow::Result<tracer_core::Scene> {
        let folder = tempfile::tempdir()?;
        let path = self.write(folder.path(), "scene", "")?;
        super::written::loaded(&path)
    }
}

/// The grey radiance of the brightest thing that gives light.
pub fn brightest(scene: &tracer_core::Scene) -> f64 {
    let lights = scene.lights.iter().map(|light| grey(light.radiance()));
    let texels = scene.environment().into_iter().flat_map(|sky| {
        let texel = |k: u32| sky.texel(k % sky.width, k / sky.width);
        (0..sky.width * sky.height).filter_map(texel)
    });
    let all = lights.chain(texels.map(|texel| grey(texel.map(f64::from))));
    all.fold(grey(scene.background.map(f64::from)), f64::max) * scene.radiance_unit
}

/// What is compared: the mean of the channels, so that a fault in any of them shows.
pub fn grey(color: Color) -> f64 {
    color.iter().sum::<f64>() / 3.0
}

/// A material written where it is used.
pub fn inline(material: Material) -> MaterialRef {
    MaterialRef::Inline(Box::new(material.into()))
}

/// Lambert.
pub fn diffuse(albedo: Color) -> Material {
    Material::Diffuse(Diffuse { albedo: Albedo::Color(albedo.into()) })
}

/// Lambert, grey.
pub fn matt(albedo: f64) -> Material {
    diffuse([albedo; 3])
}

/// A mirror that loses nothing.
pub fn mirror() -> Material {
    Material::Mirror(Mirror { reflectance: [1.0; 3].into() })
}

/// Clear glass.
pub fn glass(ior: f64) -> Material {
    tinted(ior, [1.0; 3])
}

/// Coloured glass.
pub fn tinted(ior: f64, transmittance: Color) -> Material {
    Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance: transmittance.into() }))
}
