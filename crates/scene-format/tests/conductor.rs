//! Metals are told in exactly one of three ways, and what belongs to one of them stands with no other.

use scene_format::desc::{Conductor, Material, MaterialRef, Reflectance};
use scene_format::{LoadError, Severity, Syntax, load_str};
use std::path::Path;

fn load(material: &str) -> Result<Conductor, Vec<(String, String)>> {
    let text = format!(
        "Scene(camera: Camera(position: (0, 1, 5)), background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1, \
         material: {material})])"
    );
    match load_str("metal.ron", &text, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => match loaded.scene.objects[0].value.material() {
            MaterialRef::Inline(material) => match &material.value {
                Material::Conductor(conductor) => Ok((**conductor).clone()),
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        },
        Err(LoadError::Invalid { diagnostics, .. }) => {
            let errors = diagnostics.iter().filter(|fault| fault.severity == Severity::Error);
            Err(errors.map(|fault| (fault.code.as_str().to_owned(), fault.message.clone())).collect())
        }
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn three_ways() {
    assert!(matches!(load("Conductor(metal: Gold)").unwrap().reflectance, Reflectance::Metal(_)));
    let exact = load("Conductor(ior: (0.2, 0.9, 1.1), k: 3, roughness: 0.5)").unwrap();
    let Reflectance::Complex { ior, k } = exact.reflectance else { panic!() };
    assert_eq!((ior.value, k.value, exact.roughness.constant()), ([0.2, 0.9, 1.1], [3.0; 3], Some(0.5)));
    let tinted = load("Conductor(reflectance: \"#ffffff\", multiple_scattering: false)").unwrap();
    let Reflectance::Tinted { edge_tint, .. } = tinted.reflectance else { panic!() };
    assert_eq!((edge_tint, tinted.multiple_scattering), ([1.0; 3].into(), false));
}

#[test]
fn what_does_not_go_together_is_told() {
    for (material, code, message) in [
        ("Conductor()", "E0209", "a conductor needs one of"),
        ("Conductor(metal: Gold, reflectance: 0.5)", "E0209", "a conductor has both"),
        ("Conductor(ior: 1.5)", "E0202", "needs the field `k`"),
        ("Conductor(metal: Gold, k: 3)", "E0201", "a conductor without `ior` has no `k`"),
        ("Conductor(metal: Gold, edge_tint: 0.5)", "E0201", "a conductor without `reflectance` has no `edge_tint`"),
    ] {
        let faults = load(material).unwrap_err();
        let [(of_fault, text)] = &faults[..] else { panic!("{material}: {faults:?}") };
        assert!(of_fault == code && text.contains(message), "{material}: {of_fault} {text}");
    }
}
