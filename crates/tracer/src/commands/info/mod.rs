//! `tracer info`: what is in a scene, and what it takes; what is in a checkpoint; what a picture tells of itself.

mod objects;
mod picture;

use crate::args::InfoArgs;
use crate::cache;
use crate::checkpoint::{self, Place, is_film};
use crate::failure::{Failure, exit};
use crate::loading::{Known, asset_files, compile, is_dash, load};
use crate::memory::{human, of_film};
use crate::shell::{Shell, counted};
use scene_format::desc::Object;
use scene_format::{Defaults, SceneDesc, Syntax, hash_hex, to_text};
use serde_json::json;
use std::fs::File;
use std::io::Write;
use std::process::ExitCode;
use tracer_core::scene::Statistics;
use tracer_core::{Crop, FilmError, KeptError, KeptFile, SavedFilm, Scene, is_kept_file};

pub(super) fn run(args: &InfoArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    if !is_dash(&args.scene.scene) && is_film(&args.scene.scene) {
        return of_checkpoint(args);
    }
    if !is_dash(&args.scene.scene) && is_kept_file(&args.scene.scene) {
        return of_kept(args);
    }
    if let Some(of) = Some(&args.scene.scene).filter(|path| !is_dash(path)).and_then(|path| cache::subject(path)) {
        return of_record(args, &of);
    }
    if let Some(told) = picture::told(&args.scene.scene)? {
        return picture::of_picture(args, &told);
    }
    let desc = load(&args.scene, shell)?;
    let text = if args.resolved {
        let syntax = args.scene.syntax.map(Syntax::from).or_else(|| Syntax::from_path(&args.scene.scene));
        to_text(&desc, syntax.unwrap_or(Syntax::Ron), Defaults::Shown)
    } else {
        let scene = compile(&desc, args.scene.diagnostics, Known::Nothing, shell)?;
        if args.objects {
            return print(&match args.json {
                true => format!("{:#}\n", objects::as_json(&scene, &desc)),
                false => objects::as_text(&scene, &desc),
            });
        }
        let facts = Facts {
            name: name(&desc),
            film: of_film(Crop::whole(scene.size), &desc.render, scene.layers, false),
            statistics: scene.statistics(),
            scene,
            desc,
        };
        if args.json { format!("{:#}\n", facts.as_json()) } else { facts.as_text() }
    };
    print(&text)
}

/// Whether anything is asked that only scenes have.
fn is_for_scenes(args: &InfoArgs) -> bool {
    args.objects || args.resolved || !args.scene.sets().is_empty()
}

/// Of a checkpoint, which is read to its end: whoever asks wants to know whether it is whole.
fn of_checkpoint(args: &InfoArgs) -> Result<ExitCode, Failure> {
    let path = &args.scene.scene;
    if is_for_scenes(args) {
        return Err(Failure::wrong(format!(
            "{} is a checkpoint; --objects, --resolved, --set, --camera and --frame are for scenes",
            path.display()
        )));
    }
    let file = File::open(path).map_err(FilmError::Io);
    let checked = file.and_then(|file| Ok((file.metadata()?.len(), SavedFilm::open(file)?.check()?)));
    let (bytes, head) = checked.map_err(|error| {
        let shown = path.display();
        let before = Place::unchecked(path).is_ok_and(|place| is_film(&place.previous()));
        let before = if before { format!("; the one before is {shown}.previous") } else { String::new() };
        Failure::could_not(format!("{shown} cannot be used: {error}{before}"))
    })?;
    let text = match args.json {
        true => format!("{:#}\n", checkpoint::as_json(path, bytes, &head)),
        false => checkpoint::as_text(path, bytes, &head),
    };
    print(&text)
}

/// Of a file of a cache, which is read to its end, too.
fn of_kept(args: &InfoArgs) -> Result<ExitCode, Failure> {
    let path = &args.scene.scene;
    let shown = path.display();
    alone(args)?;
    let file = File::open(path).map_err(KeptError::Io).and_then(KeptFile::open);
    let file = file.and_then(|file| file.check().map(|()| file)).map_err(|error| {
        Failure::could_not(format!("{shown} cannot be used: {error}; whoever needs it makes it anew"))
    })?;
    let (kind, bytes, program) = (file.kind.name(), file.bytes, &file.program);
    let text = match args.json {
        true => format!("{:#}\n", json!({"file": path, "kind": kind, "bytes": bytes, "program": program})),
        false => format!("{shown}: a {kind}, kept by --cache; whole, {}\nprogram    {program}\n", human(bytes)),
    };
    print(&text)
}

/// Of a record of a cache: what a file's contents hash to.
fn of_record(args: &InfoArgs, of: &str) -> Result<ExitCode, Failure> {
    alone(args)?;
    let path = &args.scene.scene;
    print(&match args.json {
        true => format!("{:#}\n", json!({"file": path, "kind": "hash", "of": of})),
        false => format!("{}: the hash of {of}, kept by --cache\n", path.display()),
    })
}

/// Refuses what is for scenes, of a file of a cache.
fn alone(args: &InfoArgs) -> Result<(), Failure> {
    if is_for_scenes(args) {
        return Err(Failure::wrong(format!(
            "{} is a file of a cache; --objects, --resolved, --set, --camera and --frame are for scenes",
            args.scene.scene.display()
        )));
    }
    Ok(())
}

fn print(text: &str) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

fn name(desc: &SceneDesc) -> String {
    desc.sources.first().map_or("", |source| source.name.as_str()).to_owned()
}

/// What there is to say.
struct Facts {
    name: String,
    desc: SceneDesc,
    scene: Scene,
    statistics: Statistics,
    film: u64,
}

impl Facts {
    fn count(&self, is: impl Fn(&Object) -> bool) -> usize {
        self.desc.objects.iter().filter(|object| is(&object.value)).count()
    }

    // Long: a line of the text for each thing that a scene may have.
    fn as_text(&self) -> String {
        let s = &self.statistics;
        let point = |p: [f64; 3]| format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]));
        let spheres = self.count(|object| matches!(object, Object::Sphere(_)));
        let total = self.desc.objects.len();
        let meshes = self.count(|object| matches!(object, Object::Mesh(_)));
        let flat_sided = self.count(|object| matches!(object, Object::Rectangle(_) | Object::Box(_)));
        let made = self.count(|object| tracer_core::mesh::shapes::of_object(object).is_some());
        let planes = self.count(|object| matches!(object, Object::Plane(_)));
        let curved = total - spheres - planes - meshes - flat_sided - made;
        let tree = s.tree.map_or("none needed".to_owned(), |tree| {
            let (nodes, leaves) = (counted(tree.nodes as usize, "node"), counted(tree.leaves as usize, "leaf"));
            format!("{nodes}, {leaves}, {} deep, {}", tree.depth, human(tree.bytes))
        });
        let mut text = String::new();
        let mut line = |name: &str, value: String| text += &format!("{name:<11}{value}\n");
        line("scene", self.name.clone());
        line("picture", format!("{}x{} pixels", self.scene.size[0], self.scene.size[1]));
        line(
            "render",
            format!("{} samples, {} bounces, seed {}", self.scene.samples, self.scene.max_bounces, self.scene.seed),
        );
        line("objects", {
            let other = [
                (planes, "plane"),
                (flat_sided, "flat-sided shape"),
                (curved, "other curved shape"),
                (made, "triangulated shape"),
            ];
            let other = other.into_iter().filter(|(n, _)| *n > 0).map(|(n, what)| counted(n, what));
            let spheres = std::iter::once(counted(spheres, "sphere"));
            let all: Vec<String> = spheres.chain(other).chain([counted(meshes, "mesh")]).collect();
            format!("{total} ({})", all.join(", "))
        });
        if let Some(objects) = objects::not_in_view(&self.scene, &self.desc) {
            line("no view of", objects);
        }
        line("lights", tracer_core::shining_objects(&self.scene).to_string());
        line(
            "triangles",
            format!(
                "{} in {}, {} in {}",
                s.triangles,
                // Some shapes are made of triangles, too.
                match (made, s.meshes) {
                    (0, meshes) => counted(meshes as usize, "mesh"),
                    (_, 1) => "1 shape".to_owned(),
                    (_, shapes) => format!("{shapes} shapes"),
                },
                s.placed_triangles,
                counted(s.instances as usize, "place")
            ),
        );
        line("materials", format!("{} ({} by name)", s.materials, self.desc.materials.len()));
        for named in &self.desc.materials {
            line("", format!("{:?}", named.name.value));
        }
        line(
            "textures",
            match self.desc.textures.len() {
                0 => s.textures.to_string(),
                named => format!("{} ({named} by name)", s.textures),
            },
        );
        for named in &self.desc.textures {
            line("", format!("{:?}", named.name.value));
        }
        for (k, file) in asset_files(&self.desc).iter().enumerate() {
            line(if k == 0 { "files" } else { "" }, file.display().to_string());
        }
        line(
            "bounds",
            match s.bounds {
                Some(bounds) => {
                    // What is a rounding error of the others is none.
                    let corners = [bounds.min, bounds.max];
                    let most = corners.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
                    let [min, max] = corners.map(|p| p.map(|x| if x.abs() < 1e-6 * most { 0.0 } else { x }));
                    format!("{} to {}", point(min), point(max))
                }
                None => "none: planes have no end".to_owned(),
            },
        );
        line("tree", tree);
        line(
            "memory",
            format!(
                "geometry {}, textures {}, tree {}, film {}",
                human(s.geometry_bytes),
                human(s.texture_bytes),
                human(s.tree.map_or(0, |tree| tree.bytes)),
                human(self.film)
            ),
        );
        line("hash", hash_hex(&self.desc));
        text
    }

    fn as_json(&self) -> serde_json::Value {
        let s = &self.statistics;
        let of_kind = |kind: &str| self.count(|object| object.kind() == kind);
        let counts = Object::KINDS.iter().map(|&(kind, many)| (many.to_owned(), of_kind(kind).into()));
        let total = ("total".to_owned(), self.desc.objects.len().into());
        let objects: serde_json::Map<String, serde_json::Value> = std::iter::once(total).chain(counts).collect();
        json!({
            "scene": self.name,
            "hash": hash_hex(&self.desc),
            "picture": { "width": self.scene.size[0], "height": self.scene.size[1] },
            "render": {
                "samples": self.scene.samples,
                "max_bounces": self.scene.max_bounces,
                "seed": self.scene.seed,
            },
            "objects": objects,
            "lights": tracer_core::shining_objects(&self.scene),
            "meshes": s.meshes,
            "files": asset_files(&self.desc),
            "instances": s.instances,
            "triangles": s.triangles,
            "placed_triangles": s.placed_triangles,
            "materials": s.materials,
            "material_names": self.desc.materials.iter().map(|named| &*named.name.value).collect::<Vec<_>>(),
            "textures": s.textures,
            "texture_names": self.desc.textures.iter().map(|named| &*named.name.value).collect::<Vec<_>>(),
            "bounds": s.bounds.map(|bounds| json!({ "min": bounds.min, "max": bounds.max })),
            "tree": s.tree.map(|tree| json!({
                "nodes": tree.nodes,
                "leaves": tree.leaves,
                "parts": tree.parts,
                "depth": tree.depth,
                "bytes": tree.bytes,
            })),
            "memory": {
                "geometry": s.geometry_bytes,
                "textures": s.texture_bytes,
                "tree": s.tree.map_or(0, |tree| tree.bytes),
                "film": self.film,
            },
        })
    }
}

/// Four significant digits and no more zeros than needed.
pub(super) fn short(x: f64) -> String {
    let digits = if x == 0.0 { 0 } else { (3 - x.abs().log10().floor() as i32).clamp(0, 12) };
    let text = format!("{x:.*}", digits as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (x, text) in
            [(0.0, "0"), (1.0, "1"), (-0.5, "-0.5"), (20050.25, "20050"), (2.71848, "2.718"), (1e-5, "0.00001")]
        {
            assert_eq!(short(x), text);
        }
    }
}
