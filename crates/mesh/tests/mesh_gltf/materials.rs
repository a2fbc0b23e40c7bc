//! The materials of glTF files, and their pictures.

use crate::support::{File, SQUARE};
use scene_format::desc::{
    Albedo, Amount, BlinnPhong, Conductor, Diffuse, Emissive, LightGroup, Mapping, Material, Multiply, Reflectance,
    Texture, TextureFilter, TextureWrap, Transparent,
};
use serde_json::{Value, json};
use std::path::Path;
use tracer_mesh::{Files, MeshFormat, NO_INDEX, file_of, load, parse};

/// A square with these materials, one primitive for each.
fn with_materials(materials: &[Value]) -> File {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let indices = file.shorts(&[0, 1, 2, 0, 2, 3]);
    let primitive = |k: usize| json!({ "attributes": { "POSITION": positions }, "indices": indices, "material": k });
    let primitives: Vec<Value> = (0..materials.len()).map(primitive).collect();
    let mesh = file.mesh(Value::Array(primitives));
    file.root(json!({ "mesh": mesh }));
    file.json["materials"] = Value::Array(materials.to_vec());
    file
}

/// What one material becomes, and what is told.
fn turned(material: &Value) -> (Material, String) {
    let mesh = with_materials(std::slice::from_ref(material)).read();
    let told: Vec<&str> = mesh.warnings.iter().map(|warning| warning.message.as_str()).collect();
    let told = told.join("").replace("the mesh's own materials are taken only in part: not supported: ", "");
    (mesh.materials[0].material.clone(), told)
}

fn diffuse(color: [f64; 3]) -> Material {
    Material::Diffuse(Diffuse { albedo: color.into() })
}

fn glass(ior: f64, color: [f64; 3]) -> Material {
    Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance: color.into() }))
}

fn shining(radiance: [f64; 3]) -> Material {
    let (amount, color, group) = (Amount::Radiance(radiance).into(), [1.0; 3].into(), LightGroup::default());
    Material::Emissive(Box::new(Emissive { amount, color, two_sided: true, group }))
}

#[test]
fn materials_are_the_nearest_of_ours() {
    let matt = |factor: [f64; 4]| json!({ "baseColorFactor": factor, "metallicFactor": 0, "roughnessFactor": 0.9 });
    let metal = |roughness: f64| {
        let reflectance = Reflectance::Tinted { reflectance: [0.9, 0.6, 0.2].into(), edge_tint: [1.0; 3].into() };
        let (roughness, multiple_scattering) = (roughness.into(), true);
        Material::Conductor(Box::new(Conductor { reflectance, roughness, multiple_scattering }))
    };
    let alpha = 0.4_f64 * 0.4;
    let gloss = Material::BlinnPhong(Box::new(BlinnPhong {
        albedo: [0.5; 3].into(),
        exponent: (2.0 / (alpha * alpha) - 2.0).into(),
        specular: 0.04.into(),
        energy_conserving: true,
    }));
    let gold = json!({ "baseColorFactor": [0.9, 0.6, 0.2, 1], "roughnessFactor": 0.3 });
    let alloy = json!({ "baseColorFactor": [0.9, 0.6, 0.2, 1], "metallicFactor": 0.75, "roughnessFactor": 0.3 });
    let clear = json!({ "KHR_materials_transmission": { "transmissionFactor": 1 } });
    let body = json!({
        "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_volume": { "thicknessFactor": 0.1, "attenuationDistance": 2 },
        "KHR_materials_ior": { "ior": 1.33 },
    });
    let smooth = json!({ "baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0, "roughnessFactor": 0 });
    let strong = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 20 } });
    let old = json!({ "KHR_materials_pbrSpecularGlossiness": { "diffuseFactor": [0.1, 0.2, 0.3, 1] } });
    for (material, expected, told) in [
        (json!({ "pbrMetallicRoughness": matt([0.1, 0.2, 0.3, 1.0]) }), diffuse([0.1, 0.2, 0.3]), ""),
        (
            json!({ "pbrMetallicRoughness": matt([0.5, 0.5, 0.5, 0.25]), "alphaMode": "BLEND" }),
            diffuse([0.5; 3]),
            "`alphaMode` BLEND and an opacity of 0.25 (taken as opaque)",
        ),
        (
            json!({ "pbrMetallicRoughness": matt([2.0, 0.5, 0.5, 1.0]), "normalTexture": { "index": 0 } }),
            diffuse([1.0, 0.5, 0.5]),
            "`normalTexture`, a colour beyond 0 to 1 (clipped)",
        ),
        (json!({ "pbrMetallicRoughness": gold }), metal(0.3), ""),
        (json!({ "pbrMetallicRoughness": alloy }), metal(0.3), "`metallicFactor` between 0 and 1 (taken as 1)"),
        (
            json!({ "pbrMetallicRoughness":
                { "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 0.4 } }),
            gloss,
            "",
        ),
        (json!({ "pbrMetallicRoughness": smooth, "extensions": clear }), glass(1.5, [1.0, 0.5, 0.25]), ""),
        (
            json!({ "pbrMetallicRoughness": smooth, "extensions": body }),
            glass(1.33, [1.0, 0.5, 0.25]),
            "what a body of glass takes (`attenuationDistance`)",
        ),
        (json!({ "emissiveFactor": [1, 0.5, 0], "doubleSided": true }), shining([1.0, 0.5, 0.0]), ""),
        (json!({ "emissiveFactor": [1, 0.5, 0], "extensions": strong }), shining([20.0, 10.0, 0.0]), ""),
        (
            json!({ "pbrMetallicRoughness": matt([0.1, 0.2, 0.3, 1.0]), "extensions": { "KHR_materials_unlit": {} } }),
            shining([0.1, 0.2, 0.3]),
            "",
        ),
        (json!({ "extensions": old }), diffuse([0.1, 0.2, 0.3]), "the gloss of `KHR_materials_pbrSpecularGlossiness`"),
    ] {
        let (found, said) = turned(&material);
        assert_eq!((found, said.as_str()), (expected, told), "{material}");
    }
}

#[test]
fn each_triangle_has_its_own() {
    let named = |name: &str, grey: f64| {
        let factors = json!({ "baseColorFactor": [grey, grey, grey, 1], "metallicFactor": 0 });
        json!({ "name": name, "pbrMetallicRoughness": factors })
    };
    let mut file = with_materials(&[named("a", 0.1), named("b", 0.2), named("a", 0.3)]);
    let primitives = &mut file.json["meshes"][0]["primitives"];
    primitives[0].as_object_mut().expect("a primitive").remove("material");
    primitives[1]["material"] = 2.into();
    primitives[2]["material"] = 0.into();
    let mesh = file.read();
    assert_eq!(mesh.triangle_material, [NO_INDEX, NO_INDEX, 0, 0, 1, 1]);
    let found: Vec<(&str, &Material)> =
        mesh.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    // Two of one name are told apart.
    assert_eq!(found, [("a", &diffuse([0.3; 3])), ("materials[0]", &diffuse([0.1; 3]))]);
    // A mesh that was kept reads them anew.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.glb");
    std::fs::write(&path, file.glb()).expect("written");
    let mut kept = load(&path).expect("a mesh");
    let materials = std::mem::take(&mut kept.materials);
    assert!(kept.read_materials(&path, &Files::default()).expect("read"));
    assert_eq!(kept.materials, materials);
    // The number of a material that there is not.
    file.json["meshes"][0]["primitives"][0]["material"] = 7.into();
    let fault = crate::support::fault_of(parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")));
    assert_eq!(fault[0], "there is no materials[7]");
}

/// A material with a picture of this kind.
fn with_picture(file: &mut File, image: Value, place: Value) {
    file.json["images"] = json!([image]);
    file.json["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33071, "wrapT": 33071 }]);
    file.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = place;
}

#[test]
fn pictures_lie_beside_the_file_and_within_it() {
    let plain = json!({ "pbrMetallicRoughness": { "metallicFactor": 0 } });
    let folder = tempfile::tempdir().expect("a folder");
    let picture = |file: &File, name: &str| -> (Texture, String) {
        let path = folder.path().join(name);
        let bytes = if name.ends_with("glb") { file.glb() } else { file.json.to_string().into_bytes() };
        std::fs::write(&path, bytes).expect("written");
        let mesh = load(&path).expect("a mesh");
        let told: Vec<String> = mesh.warnings.iter().map(|warning| warning.message.clone()).collect();
        match &mesh.materials[0].material {
            Material::Diffuse(Diffuse { albedo: Albedo::Texture(texture) }) => (texture.clone(), told.join("")),
            other => panic!("{other:?}"),
        }
    };
    // Beside it, with a blank in its name.
    std::fs::write(folder.path().join("a b.png"), b"PNG of the disk").expect("written");
    let mut file = with_materials(std::slice::from_ref(&plain));
    with_picture(&mut file, json!({ "uri": "a%20b.png" }), json!({ "index": 0 }));
    let (texture, told) = picture(&file, "beside.glb");
    assert_eq!((&*texture.file.value, told.as_str()), (&*folder.path().join("a b.png"), ""));
    assert_eq!((texture.filter, texture.wrap), (TextureFilter::Nearest, TextureWrap::Clamp));
    // As a `data:` URI, and in the container.
    let mut file = with_materials(std::slice::from_ref(&plain));
    with_picture(&mut file, json!({ "uri": "data:image/png;base64,UE5H" }), json!({ "index": 0 }));
    let view = file.view(b"PNG of a view");
    file.json["images"].as_array_mut().expect("pictures").push(json!({ "bufferView": view, "mimeType": "image/png" }));
    let (texture, _) = picture(&file, "within.glb");
    let path = folder.path().join("within.glb");
    assert_eq!(*texture.file.value, *path.join("images[0]"));
    assert_eq!(file_of(&texture.file.value), path);
    let read = |name: &str| Files::default().read_picture(&path.join(name)).map_err(|error| error.to_string());
    assert_eq!(read("images[0]").as_deref(), Ok(&b"PNG"[..]));
    assert_eq!(read("images[1]").as_deref(), Ok(&b"PNG of a view"[..]));
    assert!(read("images[2]").is_err_and(|error| error.ends_with("there is no images[2]")));
    let mut memory = Files::default();
    memory.insert("m.glb", file.glb());
    assert_eq!(memory.read_picture(Path::new("m.glb/images[0]")).expect("read"), b"PNG");
    // What is not there.
    let mut file = with_materials(std::slice::from_ref(&plain));
    with_picture(&mut file, json!({ "uri": "gone.png" }), json!({ "index": 0 }));
    let mesh = file.read();
    let told = &mesh.warnings[0].message;
    assert!(told.ends_with("no such picture (the colour alone is taken): gone.png"), "{told}");
}

/// The corners of the picture that a point of glTF's coordinates shows, by the formula of three.js and of Blender.
#[test]
fn texture_transforms_are_those_of_other_programs() {
    let mut file = with_materials(&[json!({ "pbrMetallicRoughness":
        { "baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": 1 } })]);
    let (offset, rotation, scale): ([f64; 2], f64, [f64; 2]) = ([0.1, 0.3], 0.6, [2.0, 3.0]);
    let transform = json!({ "offset": offset, "rotation": rotation, "scale": scale });
    let place = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    with_picture(&mut file, json!({ "uri": "data:image/png;base64,UE5H" }), place);
    let mesh = parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")).expect("a mesh");
    let Material::Diffuse(Diffuse { albedo: Albedo::Multiply(product) }) = &mesh.materials[0].material else {
        panic!("{:?}", mesh.materials)
    };
    let Multiply { a: Albedo::Texture(texture), b } = &**product else { panic!("{product:?}") };
    assert_eq!(*b, [0.5, 1.0, 1.0].into());
    assert_ne!(texture.mapping, Mapping::default());
    let [[a, b, x], [c, d, y]] = texture.mapping.by_uv().expect("by coordinates").rows();
    let (sin, cos) = (libm::sin(rotation), libm::cos(rotation));
    for [u, v] in [[0.0, 0.0], [1.0, 0.0], [0.3, 0.9]] {
        let expected =
            [offset[0] + cos * scale[0] * u + sin * scale[1] * v, offset[1] - sin * scale[0] * u + cos * scale[1] * v];
        // Ours run upwards.
        let (s, t) = (u, 1.0 - v);
        let found = [a * s + b * t + x, 1.0 - (c * s + d * t + y)];
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
    }
}

/// Of triangles without texture coordinates those are told that have a picture.
#[test]
fn what_is_one_colour_needs_no_texture_coordinates() {
    for (index, told) in [(0, false), (1, true)] {
        let plain = json!({ "pbrMetallicRoughness": { "metallicFactor": 0 } });
        let mut file = with_materials(&[plain.clone(), plain]);
        let uvs = file.floats(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs.into();
        with_picture(&mut file, json!({ "uri": "data:image/png;base64,UE5H" }), json!({ "index": 0 }));
        let textured = file.json["materials"][0].clone();
        file.json["materials"][index] = textured;
        let mesh = parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")).expect("a mesh");
        let found = mesh.warnings.iter().any(|warning| warning.message.contains("2 triangles without texture"));
        assert_eq!(found, told, "{:?}", mesh.warnings);
    }
}
