//! Loading from the file system: extensions, files that are not there, materials beside an OBJ file.

use scene_format::desc::{
    Albedo, Amount, BlinnPhong, Diffuse, Emissive, LightGroup, Material, Mirror, TextureWrap, Transparent,
};
use scene_format::diagnostic::Span;
use std::fs;
use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, NO_INDEX, Place, load};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";

fn diagnostic(path: &Path) -> [String; 4] {
    let error = load(path).expect_err("an error").to_diagnostic(Span::NONE);
    let folder = format!("{}/", path.parent().expect("folder").display());
    [error.code.to_string(), error.message.replace(&folder, ""), error.expected, error.hint]
}

#[test]
fn extensions_decide_the_format() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("a.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("a.b.Off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\nelement face 1\n\
             property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        ),
        ("a.Stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        assert_eq!(load(&path).expect("a mesh").triangles, [[0, 1, 2]], "{name}");
    }
}

/// What the language says of itself names every format that is read here.
#[test]
fn the_words_of_the_language_name_every_format() {
    let reference = scene_format::reference();
    let row = reference.lines().find(|line| line.starts_with("| `file` |") && line.contains("OBJ")).expect("a row");
    let explained = scene_format::explain("E0510").expect("an explanation");
    let hint = "Scene(objects: [Pyramid()])";
    let faults = match scene_format::load_str("m.ron", hint, scene_format::Syntax::Ron, Path::new("."), &[]) {
        Err(scene_format::LoadError::Invalid { diagnostics, .. }) => diagnostics,
        other => panic!("{other:?}"),
    };
    let hint = faults.iter().map(|fault| fault.hint.clone()).collect::<String>();
    for format in MeshFormat::ALL {
        for text in [row, &format!("{explained:?}"), &hint] {
            assert!(text.contains(format.name()), "{} in {text}", format.name());
        }
    }
}

#[test]
fn files_that_cannot_be_read_are_named_with_a_hint() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("Cat.obj"), "").expect("written");
    fs::create_dir(path("dir.obj")).expect("a folder");
    let no_file = "there is no file";
    for (name, code, message, expected, hint) in [
        ("dog.obj", "E0501", format!("{no_file} dog.obj"), "", "paths are relative to the folder of the scene file"),
        ("cat.OBJ", "E0501", format!("{no_file} cat.OBJ"), "", "the folder has `Cat.obj`"),
        ("dir.obj", "E0502", "dir.obj is not a regular file".into(), "a file, not a folder, pipe or device", ""),
        (
            "cat.fbx",
            "E0502",
            "cat.fbx: meshes of this type cannot be read".into(),
            "a mesh file that ends in `.obj`, `.off`, `.ply`, `.stl`, `.gltf` or `.glb`",
            "export the mesh as OBJ, OFF, PLY, STL, glTF or GLB",
        ),
        (
            "cat.obj.gz",
            "E0502",
            "cat.obj.gz: meshes of this type cannot be read".into(),
            "a mesh file that ends in `.obj`, `.off`, `.ply`, `.stl`, `.gltf` or `.glb`",
            "unpack the file first",
        ),
    ] {
        assert_eq!(diagnostic(&path(name)), [code.to_owned(), message, expected.to_owned(), hint.to_owned()]);
    }
    assert_eq!(diagnostic(&path("Cat.obj/x.obj"))[0], "E0501");
}

/// Loads an OBJ file with this MTL beside it, one triangle for each material named.
fn with_mtl(mtl: &str, names: &[&str]) -> Result<MeshData, MeshError> {
    let folder = tempfile::tempdir().expect("a folder");
    let mut obj = format!("mtllib my model.mtl\n{TRIANGLE}");
    for name in names {
        obj += &format!("usemtl {name}\nf 1 2 3\n");
    }
    fs::create_dir(folder.path().join("maps")).expect("a folder");
    for picture in ["fur.png", "maps/two words.jpg"] {
        fs::write(folder.path().join(picture), "").expect("written");
    }
    fs::write(folder.path().join("my model.mtl"), mtl).expect("written");
    fs::write(folder.path().join("m.obj"), obj).expect("written");
    load(&folder.path().join("m.obj"))
}

/// The one material of an MTL, and what the warning says of it.
fn material(mtl: &str) -> (Material, String) {
    let mesh = with_mtl(&format!("newmtl m\n{mtl}\n"), &["m"]).expect("a mesh");
    let warning = mesh.warnings.iter().find(|warning| warning.code == "W0511");
    let text = warning.map_or(String::new(), |warning| warning.message.clone());
    let said = text.strip_prefix("the mesh's own materials are taken only in part: ").unwrap_or(&text).to_owned();
    (mesh.materials.into_iter().next().expect("a material").material, said)
}

fn diffuse(color: [f64; 3]) -> Material {
    Material::Diffuse(Diffuse { albedo: Albedo::Color(color.into()) })
}

fn blinn_phong(color: [f64; 3], specular: f64, exponent: f64) -> Material {
    Material::BlinnPhong(Box::new(BlinnPhong {
        albedo: Albedo::Color(color.into()),
        exponent: exponent.into(),
        specular: specular.into(),
        energy_conserving: false,
    }))
}

fn glass(ior: f64, transmittance: [f64; 3]) -> Material {
    Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance: transmittance.into() }))
}

fn emissive(radiance: [f64; 3]) -> Material {
    Material::Emissive(Box::new(Emissive {
        amount: Amount::Radiance(radiance).into(),
        color: [1.0; 3].into(),
        two_sided: true,
        group: LightGroup::default(),
    }))
}

#[test]
fn materials_of_mtl_become_ours() {
    let silent = String::new;
    for (mtl, expected, said) in [
        ("", diffuse([0.8; 3]), silent()),
        ("Ka 1 1 1\nKd 0.1 0.2 0.3\nKe 0 0 0\nillum 1\nKs 1 1 1\nNs 10", diffuse([0.1, 0.2, 0.3]), silent()),
        ("Kd 0 0 0\nKe 3 2 1\nillum 2\nKs 0 0 0\nNs 10", emissive([3.0, 2.0, 1.0]), silent()),
        (
            "Kd 0.5\nKe 3 2 1\nillum 2\nKs 1 1 1\nNs 10\nd 0.5",
            emissive([3.0, 2.0, 1.0]),
            "not supported: `Kd` beside `Ke` (what shines reflects nothing), `Ks` beside `Ke` (what shines reflects \
             nothing), `d` beside `Ke` (what shines reflects nothing)"
                .into(),
        ),
        ("Ke 5 -1 0", emissive([5.0, 0.0, 0.0]), "not supported: `Ke` outside 0 to 1e30 (clipped)".into()),
        ("\tKd 0.5\r", diffuse([0.5; 3]), silent()),
        ("Kd 0.5 0.5 0.5\nKs 0 0 0\nNs 100\nillum 2", diffuse([0.5; 3]), silent()),
        ("Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nNs 100\nillum 2", blinn_phong([0.75; 3], 0.25 / 0.75, 100.0), silent()),
        ("Kd 0 0 0\nKs 1 0.5 0\nNs 0.5", blinn_phong([1.0, 0.5, 0.0], 1.0, 1.0), silent()),
        (
            "Kd 1 1 1\nKs 1 1 1\nNs 1e6",
            blinn_phong([1.0; 3], 0.5, 1e5),
            "not supported: `Kd` + `Ks` above 1 (both scaled down), `Ns` above 100000 (clipped)".into(),
        ),
        (
            "Kd 0 0 0\nKs 0.9 0.8 0.7\nillum 3",
            Material::Mirror(Mirror { reflectance: [0.9, 0.8, 0.7].into() }),
            silent(),
        ),
        (
            "Kd 1 0 0\nillum 5",
            Material::Mirror(Mirror { reflectance: [1.0; 3].into() }),
            "not supported: `Kd` and `map_Kd` of a mirror (`illum` 3 or 5)".into(),
        ),
        ("Kd 0.5 0.5 0.5\nKs 0 0 0\nillum 3", diffuse([0.5; 3]), silent()),
        ("Ni 1.33\nillum 7\nTf 0.9 1 1", glass(1.33, [0.9, 1.0, 1.0]), silent()),
        ("d 0", glass(1.5, [1.0; 3]), silent()),
        (
            "Tr 0.5\nNi 0",
            glass(1.5, [1.0; 3]),
            "not supported: `Ni` below 1 (1.5 is taken), `d` between 0 and 1 (taken as clear glass)".into(),
        ),
        ("d 1\nTr 1", diffuse([0.8; 3]), silent()),
        // `Tr` alone is transparency.
        ("Tr 0", diffuse([0.8; 3]), silent()),
        ("Tr 1", glass(1.5, [1.0; 3]), silent()),
        (
            "Kd 2 0.5 -1\nmap_Bump -bm 2 b.png\nmap_Ke e.png\nPr 0.5\nPm 0\nd -halo 1",
            diffuse([1.0, 0.5, 0.0]),
            "not supported: `Kd` outside 0 to 1 (clipped), `Pr`, `d -halo`, `map_Bump`, `map_Ke`".into(),
        ),
        ("Kd spectral x.rfl 1", diffuse([0.8; 3]), "not supported: `Kd spectral`".into()),
        ("map_Kd none.png\nKd 0.1 0.1 0.1", diffuse([0.1; 3]), "no such picture (`Kd` is taken): none.png".into()),
    ] {
        assert_eq!(material(mtl), (expected, said), "{mtl}");
    }
}

#[test]
fn pictures_are_found_from_the_folder_of_the_mtl() {
    for (mtl, file, wrap, said) in [
        ("map_Kd fur.png", "fur.png", TextureWrap::Repeat, ""),
        ("Kd 1 1 1\nmap_Kd -clamp on -o 0 0 0 -s 1 1 -mm 0 1 fur.png", "fur.png", TextureWrap::Clamp, ""),
        ("map_Kd maps\\two words.jpg", "maps/two words.jpg", TextureWrap::Repeat, ""),
        ("map_Kd C:\\Users\\ann\\fur.png", "fur.png", TextureWrap::Repeat, ""),
        (
            "Kd 0.5 1 1\nmap_Kd -s 2 2 -blendu off -texres 512 fur.png",
            "fur.png",
            TextureWrap::Repeat,
            "not supported: `Kd` other than 1 beside `map_Kd`, `map_Kd -blendu`, `map_Kd -s`, `map_Kd -texres`",
        ),
    ] {
        let (material, found) = material(mtl);
        let Material::Diffuse(Diffuse { albedo: Albedo::Texture(texture) }) = material else { panic!("{material:?}") };
        assert!(texture.file.value.is_absolute() && texture.file.value.ends_with(file), "{:?}", texture.file.value);
        assert_eq!((texture.wrap, found.as_str()), (wrap, said));
    }
}

#[test]
fn triangles_know_their_materials_in_order_of_first_use() {
    let mtl = "newmtl a\nKd 1 0 0\nnewmtl b b\nKd 0 1 0\nnewmtl unused\nKe 1 1 1\nnewmtl a\nKd 0 0 1\n";
    let mesh = with_mtl(mtl, &["b b", "a", "ghost", "b b"]).expect("a mesh");
    assert_eq!(mesh.triangle_material, [0, 1, NO_INDEX, 0]);
    let names: Vec<&str> = mesh.materials.iter().map(|material| &*material.name.value).collect();
    assert_eq!(names, ["b b", "a"]);
    assert_eq!(mesh.materials[1].material, diffuse([1.0, 0.0, 0.0]));
    assert_eq!(
        mesh.warnings.last().map(|warning| (warning.code.as_str(), warning.message.as_str())),
        Some((
            "W0511",
            "the mesh's own materials are taken only in part: no such material (the default is taken): ghost"
        ))
    );
}

#[test]
fn faces_before_any_usemtl_have_the_default() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("x.mtl"), "newmtl a\n").expect("written");
    fs::write(folder.path().join("y.mtl"), "newmtl b\n").expect("written");
    let obj = format!("{TRIANGLE}f 1 2 3\nmtllib x.mtl y.mtl\nusemtl ghost\nusemtl b\nf 1 2 3 1\nf 3 2 1\n");
    fs::write(folder.path().join("m.obj"), obj).expect("written");
    let mesh = load(&folder.path().join("m.obj")).expect("a mesh");
    assert_eq!(mesh.triangle_material, [NO_INDEX, 0, 0]);
    assert!(mesh.warnings.iter().all(|warning| warning.code == "W0510"), "{:?}", mesh.warnings);
}

#[test]
fn a_missing_mtl_file_is_one_warning() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.obj");
    fs::write(&path, format!("mtllib gone.mtl\nmtllib gone.mtl\n{TRIANGLE}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n"))
        .expect("written");
    let mesh = load(&path).expect("a mesh");
    let warnings: Vec<&str> = mesh
        .warnings
        .iter()
        .filter(|warning| warning.code == "W0511")
        .map(|warning| warning.message.as_str())
        .collect();
    assert_eq!(
        warnings,
        ["the mesh's own materials are taken only in part: MTL file not read: there is no file gone.mtl; \
          no such material (the default is taken): a, b"]
    );
    assert!(mesh.triangle_material.is_empty() && mesh.materials.is_empty());
}

#[test]
fn a_broken_mtl_file_is_an_error_of_its_line() {
    for (mtl, line, message, expected) in [
        ("newmtl m\nKd 1 2\n", 2, "a number is missing at the end of the line", "a colour: 1 or 3 numbers"),
        ("newmtl m\n\nKd r g b\n", 3, "`r` is not a number", "a colour: 1 or 3 numbers"),
        ("newmtl m\nNs 1e999\n", 2, "`1e999` is not a finite number", "one number"),
        ("newmtl m\nNs 1 2\n", 2, "`2` is too much", "one number"),
        ("newmtl m\nd\n", 2, "a number is missing at the end of the line", "one number"),
        ("newmtl\n", 1, "a name is missing at the end of the line", "the name of a material: `newmtl NAME`"),
        ("newmtl m\nmap_Kd -s 1 1\n", 2, "a name is missing at the end of the line", "a picture: `map_Kd FILE.png`"),
        (
            "Kd 1 1 1\n",
            1,
            "`Kd` stands before the first material",
            "an MTL file: `newmtl NAME`, then what the material is",
        ),
    ] {
        match with_mtl(mtl, &["m"]) {
            Err(MeshError::Broken { path, place: found, message: said, expected: wanted, .. }) => {
                assert!(path.ends_with("my model.mtl"));
                assert_eq!((found, said.as_str(), wanted.as_str()), (Place::Line(line), message, expected));
            }
            other => panic!("{mtl}: {other:?}"),
        }
    }
}

/// tobj's reader of MTL files agrees on what a plain file says.
#[test]
fn tobj_reads_the_same_materials() {
    let mtl = "newmtl a\nKa 0 0 0\nKd 0.25 0.5 0.75\nKs 0 0 0\nNs 12\nNi 1.45\nd 1\nillum 2\n\
               newmtl b\nKd 0 0 0\nKs 0.5 0.25 1\nNs 250\nillum 3\nnewmtl c\nd 0.5\nNi 1.25\n";
    let mesh = with_mtl(mtl, &["a", "b", "c"]).expect("a mesh");
    let (oracle, _) = tobj::load_mtl_buf(&mut mtl.as_bytes()).expect("tobj");
    let color = |color: Option<[f32; 3]>| color.expect("a colour").map(f64::from);
    assert_eq!(mesh.materials[0].material, diffuse(color(oracle[0].diffuse)));
    assert_eq!(mesh.materials[1].material, Material::Mirror(Mirror { reflectance: color(oracle[1].specular).into() }));
    let ior = f64::from(oracle[2].optical_density.expect("Ni"));
    assert_eq!(mesh.materials[2].material, glass(ior, [1.0; 3]));
}
