//! One fault gives one error: nothing is said that vanishes when the fault is mended.

mod common;

use common::{FULL_RON, FULL_TOML, errors};
use scene_format::Syntax;

fn check(text: &str, syntax: Syntax, faults: &[(&str, &str, &str)]) {
    assert_eq!(errors(text, syntax), Vec::new(), "the scene is right");
    let mut wrong = Vec::new();
    for (right, fault, code) in faults {
        assert!(text.contains(right), "{right} is not in the scene");
        let broken = text.replacen(right, fault, 1);
        let found = errors(&broken, syntax);
        let codes: Vec<&str> = found.iter().map(|fault| fault.code.as_str()).collect();
        if codes != [*code] {
            let messages: Vec<String> = found.iter().map(|fault| format!("{} {}", fault.code, fault.message)).collect();
            wrong.push(format!("{right} -> {fault}: expected {code}, found {messages:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), faults.len(), wrong.join("\n"));
}

#[test]
fn one_fault_in_ron_is_one_error() {
    check(
        FULL_RON,
        Syntax::Ron,
        &[
            // Syntax.
            ("fov: 60)", "fov: 60", "E0102"),
            ("(0, 1, 55)", "(0, 1, 55]", "E0103"),
            ("(0, 1, 55)", "(0, 1 55)", "E0104"),
            ("radius: 10, material", "radius: 10 material", "E0104"),
            ("width: 320", "width = 320", "E0105"),
            ("seed: 7", "seed: ", "E0106"),
            ("seed: 7,", "seed: 7,,", "E0106"),
            ("\"cat.obj\"", "\"cat.obj", "E0107"),
            ("\"cat.obj\"", "cat.obj\"", "E0118"),
            ("exposure: 0.5", "exposure: 0.5.1", "E0109"),
            ("exposure: 0.5", "exposure: @", "E0101"),
            ("\"white\":", "white:", "E0111"),
            ("// A scene", "/* A scene", "E0107"),
            ("Scene(", "Scene((", "E0102"),
            ("DropTo(y: -20),", "DropTo(y: -20", "E0102"),
            ("material: \"glass\"),", "material: \"glass\",", "E0102"),
            ("            ],\n            placements", "            placements", "E0102"),
            ("[Translate((1, 0, 0))]", "[Translate((1, 0, 0)]", "E0102"),
            ("Translate((9, 0, 0))", "Translate((9, 0, 0)))", "E0103"),
            // Structure.
            ("camera: Camera(", "camra: Camera(", "E0201"),
            ("position:", "positoin:", "E0201"),
            ("objects: [", "object: [", "E0201"),
            ("radius: 10", "radus: 10", "E0201"),
            ("file: \"cat.obj\"", "fil: \"cat.obj\"", "E0201"),
            ("radius: 10, ", "", "E0202"),
            ("file: \"cat.obj\",", "", "E0209"),
            ("ior: 1.52, ", "", "E0202"),
            ("intensity: 3974", "", "E0209"),
            ("intensity: 3974", "intensty: 3974", "E0201"),
            ("power: 100", "power: 100, radiance: 1", "E0209"),
            ("radius: 10", "radius: \"10\"", "E0203"),
            ("radius: 10", "radius: (10, 1)", "E0203"),
            ("fov: 60", "fov: true", "E0203"),
            ("samples: 16", "samples: 16.5", "E0305"),
            ("\"cat.obj\"", "7", "E0203"),
            ("Camera(", "Camra(", "E0204"),
            ("Sphere(", "Ball(", "E0204"),
            ("Gaussian(sigma: 0.4)", "Gauss(sigma: 0.4)", "E0204"),
            ("Gaussian(sigma: 0.4)", "Gaussian", "E0203"),
            ("Filmic", "Filmik", "E0204"),
            ("Filmic", "\"Filmic\"", "E0203"),
            ("Filmic", "Filmic()", "E0203"),
            ("\"white\": Diffuse(", "\"white\": Difuse(", "E0204"),
            ("radius: 10,", "radius: 10, radius: 10,", "E0205"),
            ("(20, 30, -20)", "(20, 30)", "E0206"),
            ("(20, 30, -20)", "(20, 30, -20, 1)", "E0206"),
            ("Translate((9, 0, 0))", "Translate(9, 0, 0)", "E0206"),
            ("Translate((9, 0, 0))", "Translate(by: (9, 0, 0))", "E0203"),
            ("version: 1", "version: 2", "E0208"),
            ("version: 1,", "let: 1,", "E0210"),
            // Values.
            ("radius: 10", "radius: -10", "E0301"),
            ("sigma: 0.4", "sigma: -0.4", "E0302"),
            ("(0.1, 0.2, 0.3)", "(0.1, -0.2, 0.3)", "E0302"),
            ("fov: 60", "fov: 180", "E0303"),
            ("ior: 1.52", "ior: 0.009", "E0303"),
            ("reflectance: 0.5", "reflectance: 1.5", "E0303"),
            ("specular: 0.05", "specular: 5", "E0303"),
            ("width: 320", "width: 0", "E0303"),
            ("samples: 16", "samples: 0", "E0303"),
            ("exponent: 1000", "exponent: inf", "E0304"),
            ("(20, 30, -20)", "(20, NaN, -20)", "E0304"),
            ("\"#3344dd\"", "\"#3344d\"", "E0306"),
            ("axis: (0, 1, 0)", "axis: (0, 0, 0)", "E0307"),
            ("up: (0, 1, 0)", "up: (0, 0, 0)", "E0307"),
            ("position: (0, 1, 55)", "position: (0, 0, 0)", "E0308"),
            ("position: (0, 1, 55)", "position: (0, 9, 0)", "E0309"),
            ("\"cat.png\"", "\"\"", "E0310"),
            ("Scale(2)", "Scale(0)", "E0540"),
            // Expressions.
            ("radius: 10", "radius: \"=10*\"", "E0601"),
            ("radius: 10", "radius: \"=(10\"", "E0601"),
            ("radius: 10", "radius: \"=r\"", "E0602"),
            ("radius: 10", "radius: \"=sinus(10)\"", "E0602"),
            ("radius: 10", "radius: \"=(1, 2)\"", "E0603"),
            ("radius: 10", "radius: \"=1/0\"", "E0604"),
            ("radius: 10", "radius: \"=-10\"", "E0301"),
            ("samples: 16", "samples: \"=33/2\"", "E0305"),
            ("(20, 30, -20)", "(20, \"=30+\", -20)", "E0601"),
            ("(20, 30, -20)", "\"=(20, 30)\"", "E0603"),
            ("version: 1,", "vars: { \"a\": \"=b\", \"b\": \"=a\" },", "E0407"),
            ("version: 1,", "vars: { \"a b\": 1 },", "E0408"),
            ("Sphere(center: (20", "Repeat(count: 2), Sphere(center: (20", "E0202"),
            ("Sphere(center: (20", "Repeat(count: 2.5, items: []), Sphere(center: (20", "E0305"),
            (
                "Sphere(center: (20",
                "Repeat(count: 2, items: [Sphere(radius: 1, center: \"=i\")]), Sphere(center: (20",
                "E0603",
            ),
            ("Sphere(center: (20", "Repeat(count: 2, index: \"pi\", items: []), Sphere(center: (20", "E0408"),
            ("version: 1,", "vars: { \"a\": 1, \"a\": 2 },", "E0402"),
            // Names.
            ("material: \"glass\"", "material: \"gloss2\"", "E0401"),
            ("\"white\": Diffuse(albedo: 1)", "\"white\": Diffuse(albedo: 1), \"white\": Mirror()", "E0402"),
        ],
    );
}

#[test]
fn one_fault_in_toml_is_one_error() {
    check(
        FULL_TOML,
        Syntax::Toml,
        &[
            // Syntax.
            ("[0, 1, 55]", "[0, 1, 55", "E0102"),
            ("[0, 1, 55]", "[0, 1, 55}", "E0103"),
            ("[0, 1, 55]", "[0, 1 55]", "E0104"),
            ("[0, 1, 55]", "(0, 1, 55)", "E0101"),
            ("radius = 10, material", "radius = 10 material", "E0104"),
            ("fov = 60", "fov: 60", "E0105"),
            ("fov = 60", "fov", "E0105"),
            ("fov = 60", "fov =", "E0106"),
            ("fov = 60", "fov == 60", "E0101"),
            ("fov = 60", "fov = 60,", "E0112"),
            ("fov = 60", "= 60", "E0119"),
            ("fov = 60", "fov = 60 70", "E0112"),
            ("fov = 60", "fov = 6_0_", "E0109"),
            ("fov = 60", "fov = 060", "E0109"),
            ("fov = 60", "fov = .5", "E0109"),
            ("file = \"cat.obj\"", "file = \"cat.obj", "E0107"),
            ("file = \"cat.obj\"", "file = cat.obj", "E0118"),
            ("file = \"cat.obj\"", "file = \"models\\cat.obj\"", "E0108"),
            ("[camera]", "[camera", "E0102"),
            ("[[objects]]", "[[objects]", "E0102"),
            ("[camera]", "[]", "E0119"),
            ("material = \"glass\" }", "material = \"glass\"", "E0102"),
            ("{ Translate = [9, 0, 0] },", "{ Translate = [9, 0, 0] ],", "E0103"),
            ("{ Translate = [9, 0, 0] },", "{ Translate = [9, 0, 0] }},", "E0103"),
            ("{ Translate = [9, 0, 0] },", "{ Translate = [9, 0, 0 },", "E0102"),
            ("{ DropTo = { y = -20 } },\n]", "{ DropTo = { y = -20 } },\n", "E0102"),
            ("{ Gaussian = { sigma = 0.4 } }", "{ Gaussian = { sigma = 0.4 }", "E0102"),
            ("[image]", "[camera]\nfov = 50\n[image]", "E0117"),
            // Structure.
            ("[camera]", "[camra]", "E0201"),
            ("position = ", "positoin = ", "E0201"),
            ("radius = 10", "radus = 10", "E0201"),
            ("radius = 10, ", "", "E0202"),
            ("file = \"cat.obj\"\n", "", "E0209"),
            ("ior = 1.52, ", "", "E0202"),
            (", intensity = 3974", "", "E0209"),
            ("power = 100", "power = 100, radiance = 1", "E0209"),
            ("radius = 10", "radius = \"10\"", "E0203"),
            ("fov = 60", "fov = true", "E0203"),
            ("fov = 60", "fov = 2020-01-01", "E0203"),
            ("samples = 16", "samples = 16.5", "E0305"),
            ("Sphere = {", "Ball = {", "E0204"),
            ("{ Gaussian = { sigma = 0.4 } }", "{ Gauss = { sigma = 0.4 } }", "E0204"),
            ("{ Gaussian = { sigma = 0.4 } }", "\"Gaussian\"", "E0203"),
            ("\"Filmic\"", "\"Filmik\"", "E0204"),
            ("\"Filmic\"", "Filmic", "E0118"),
            ("\"Filmic\"", "{ Filmic = {} }", "E0203"),
            ("{ Diffuse = { albedo = 1 } }", "{ Difuse = { albedo = 1 } }", "E0204"),
            ("{ Diffuse = { albedo = 1 } }", "{ albedo = 1 }", "E0203"),
            ("radius = 10,", "radius = 10, radius = 10,", "E0205"),
            ("fov = 60", "fov = 60\nfov = 70", "E0205"),
            ("[20, 30, -20]", "[20, 30]", "E0206"),
            ("version = 1", "version = 2", "E0208"),
            ("version = 1", "let = 1", "E0210"),
            ("version = 1", "vars = 1", "E0203"),
            // Values.
            ("radius = 10", "radius = -10", "E0301"),
            ("sigma = 0.4", "sigma = -0.4", "E0302"),
            ("fov = 60", "fov = 180", "E0303"),
            ("ior = 1.52", "ior = 0.009", "E0303"),
            ("exponent = 1000", "exponent = inf", "E0304"),
            ("[20, 30, -20]", "[20, nan, -20]", "E0304"),
            ("\"#3344dd\"", "\"3344dd\"", "E0306"),
            ("axis = [0, 1, 0]", "axis = [0, 0, 0]", "E0307"),
            ("position = [0, 1, 55]", "position = [0, 0, 0]", "E0308"),
            ("position = [0, 1, 55]", "position = [0, 9, 0]", "E0309"),
            ("\"cat.png\"", "\"\"", "E0310"),
            ("{ Scale = 2 }", "{ Scale = 0 }", "E0540"),
            // Names.
            ("material = \"glass\"", "material = \"gloss2\"", "E0401"),
        ],
    );
}
