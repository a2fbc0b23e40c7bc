//! Numbers that may be textures: what stands where one is due, how large the numbers within a texture may be, and what
//! is said of those that are not.

use scene_format::desc::{Albedo, BlinnPhong, Material, MaterialRef};
use scene_format::{LoadError, Severity, Syntax, load_str};
use std::path::Path;

type Faults = Vec<(String, String)>;

fn load(material: &str) -> Result<Material, Faults> {
    let text = format!(
        "Scene(background: 1, textures: {{ \"dots\": Dots(b: 0.5), \"tint\": (0.1, 0.5, 0.9), \"grey\": 0.3 }}, \
         objects: [Sphere(center: (0, 0, 0), radius: 1, material: {material}), \
         Box(material: Diffuse(albedo: Mix(a: \"dots\", b: \"tint\", weight: \"grey\")))])"
    );
    match load_str("numbers.ron", &text, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => match loaded.scene.objects[0].value.material() {
            MaterialRef::Inline(material) => Ok(material.value.clone()),
            other => panic!("{other:?}"),
        },
        Err(LoadError::Invalid { diagnostics, .. }) => {
            let errors = diagnostics.iter().filter(|fault| fault.severity == Severity::Error);
            Err(errors.map(|fault| (fault.code.as_str().to_owned(), fault.message.clone())).collect())
        }
        Err(other) => panic!("{other:?}"),
    }
}

fn glossy(exponent: &str) -> Box<BlinnPhong> {
    match load(&format!("BlinnPhong(exponent: {exponent}, specular: 0.1)")) {
        Ok(Material::BlinnPhong(words)) => words,
        other => panic!("{other:?}"),
    }
}

#[test]
fn numbers_expressions_textures_and_names() {
    for (written, number) in [("1000", 1000.0), ("0.5", 0.5), ("\"=10*20\"", 200.0)] {
        assert_eq!(glossy(written).exponent.constant(), Some(number), "{written}");
    }
    let Albedo::Checkerboard(squares) = glossy("Checkerboard(a: 10, b: (5000, 1, \"=2*3\"))").exponent.0 else {
        panic!()
    };
    assert_eq!([&squares.a, &squares.b], [&[10.0; 3].into(), &[5000.0, 1.0, 6.0].into()]);
    assert!(matches!(glossy("Multiply(a: \"dots\", b: 1000)").exponent.0, Albedo::Multiply(_)));
    // Of a colour the luminance, of a grey the grey.
    let colored = glossy("\"tint\"").exponent.constant().expect("a colour");
    assert!((colored - (0.2126 * 0.1 + 0.7152 * 0.5 + 0.0722 * 0.9)).abs() < 1e-12, "{colored}");
    assert_eq!(glossy("\"grey\"").exponent.constant(), Some(0.3));
    let named = glossy("\"dots\"");
    assert!(matches!(named.exponent.0.resolved(), Albedo::Dots(_)) && named.exponent.constant().is_none());
}

#[test]
fn within_a_texture_the_range_is_that_of_the_field() {
    for (material, code) in [
        ("BlinnPhong(exponent: 20000000, specular: 0.1)", "E0303"),
        ("BlinnPhong(exponent: Dots(b: 20000000), specular: 0.1)", "E0303"),
        ("BlinnPhong(exponent: Mix(b: Dots(a: -1)), specular: 0.1)", "E0302"),
        // How much of which is a share, whatever it is of.
        ("BlinnPhong(exponent: Mix(weight: 2), specular: 0.1)", "E0303"),
        ("BlinnPhong(exponent: Mix(weight: Dots(b: 50)), specular: 0.1)", "E0303"),
        ("BlinnPhong(exponent: Mix(weight: Mix(weight: Dots(), b: 50)), specular: 0.1)", "E0303"),
        ("BlinnPhong(exponent: 9, specular: Dots(b: 2))", "E0303"),
        ("Conductor(metal: Gold, roughness: 1.5)", "E0303"),
        ("Conductor(metal: Gold, roughness: Dots(b: 1.5))", "E0303"),
        ("Conductor(reflectance: 1, edge_tint: Dots(b: 1.5))", "E0303"),
        ("Mirror(reflectance: Dots(b: 1.5))", "E0303"),
        ("Transparent(ior: 1.5, transmittance: Dots(b: 1.5))", "E0303"),
        ("Diffuse(albedo: Dots(b: 1.5))", "E0303"),
        ("Conductor(metal: Gold, roughness: \"nope\")", "E0406"),
        ("Conductor(metal: Gold, edge_tint: \"dots\")", "E0201"),
    ] {
        let faults = load(material).unwrap_err();
        let codes: Vec<&str> = faults.iter().map(|(code, _)| &**code).collect();
        assert_eq!(codes, [code], "{material}: {faults:?}");
    }
    // What follows such a share is as large as the field lets it be.
    assert!(load("BlinnPhong(exponent: Mix(weight: Dots(), b: Mix(weight: Dots(), b: 5000)), specular: 0.1)").is_ok());
    // Three numbers are no number.
    assert_eq!(load("Conductor(metal: Gold, roughness: (0.1, 0.2, 0.3))").unwrap_err().len(), 1);
}
