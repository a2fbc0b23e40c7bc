//! Groups are read as plain objects that remember where they are put; names lead `--set` to objects and lights.

mod common;

use common::{errors, load};
use scene_format::desc::{Amount, Copies, Material, MaterialRef, Object, Placements};
use scene_format::{Defaults, LoadError, Override, SceneDesc, Syntax, convert, hash_hex, load_str, to_text};
use std::path::Path;

const TABLE: &str = r#"Scene(
    background: 1,
    materials: { "wood": Diffuse(albedo: 0.3) },
    objects: [
        Group(name: "set", material: "wood", transform: [Translate((1, 0, 0))], objects: [
            Box(center: (0, 1, 0), size: (2, 0.1, 2), name: "top"),
            Group(placements: Grid(count: (2, 1, 2)), objects: [
                Mesh(file: "leg.off", name: "leg"),
                Sphere(center: (0, 0, 0), radius: 0.1, material: Mirror(), placements: [[], [Translate((0, 1, 0))]]),
            ], lights: [SphereLight(center: (0, 2, 0), radius: 0.1, power: 3, name: "lamp")]),
        ]),
        Sphere(center: (0, 0, 0), radius: 1, name: "ball"),
    ],
)"#;

fn read(text: &str, syntax: Syntax) -> SceneDesc {
    match load(text, syntax) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}\n{text}"),
    }
}

fn copies(scene: &SceneDesc) -> Vec<u64> {
    scene.objects.iter().map(|object| object.value.placements().known_copies()).collect()
}

#[test]
fn a_group_is_plain_objects_with_the_product_of_all_placements() {
    let scene = read(TABLE, Syntax::Ron);
    assert_eq!(copies(&scene), [1, 4, 8, 4, 1]);
    let wood =
        |k: usize| matches!(scene.objects[k].value.material(), MaterialRef::Named { name, .. } if &**name == "wood");
    assert!(wood(0) && wood(1) && !wood(2) && !wood(4));
    let Some(within) = scene.objects[1].value.placements().within() else { panic!("the leg stands in groups") };
    let groups = within.groups.outwards();
    assert_eq!(groups.len(), 2);
    assert!(matches!(groups[0].placements.copies(), Some(Copies::Pattern(_))) && groups[0].transform.is_empty());
    assert_eq!(groups[1].transform.len(), 1);
    // What stands in the same groups shares them.
    let Some(other) = scene.objects[2].value.placements().within() else { panic!("the ball stands in groups") };
    assert!(std::sync::Arc::ptr_eq(&within.groups, &other.groups));
    assert_eq!(scene.objects[4].value.placements(), &Placements::One);
}

#[test]
fn a_light_of_a_group_is_the_sphere_that_shines_as_it_does() {
    let scene = read(TABLE, Syntax::Ron);
    assert!(scene.lights.is_empty());
    let Object::Sphere(sphere) = &scene.objects[3].value else { panic!("a sphere") };
    let MaterialRef::Inline(material) = &sphere.material else { panic!("its own material") };
    let Material::Emissive(emissive) = &material.value else { panic!("it shines") };
    // L = P / (4 pi^2 r^2) of a sphere light is that of twice the power on both sides: 2P / (2 * 4 pi r^2 * pi).
    assert_eq!((emissive.amount.value.clone(), emissive.two_sided), (Amount::Power([6.0; 3]), true));
    assert_eq!(sphere.name.as_str(), Some("lamp"));
}

/// What stands in a group that the camera does not see is not seen, lamps among it; what is hidden in one that is seen
/// stays so.
#[test]
fn a_group_that_is_hidden_hides_what_is_in_it() {
    let text = r#"Scene(objects: [
        Group(camera_visible: false, objects: [Box(), Group(objects: [Box()])], lights: [
            SphereLight(center: (0, 2, 0), radius: 0.1, power: 3),
        ]),
        Group(objects: [Box(camera_visible: false), Box()], lights: [
            SphereLight(center: (0, 2, 0), radius: 0.1, power: 3, camera_visible: false),
        ]),
    ])"#;
    let scene = read(text, Syntax::Ron);
    let seen = |scene: &SceneDesc| scene.objects.iter().map(|o| o.value.camera_visible()).collect::<Vec<_>>();
    assert_eq!(seen(&scene), [false, false, false, false, true, false]);
    let again = read(&to_text(&scene, Syntax::Ron, Defaults::Hidden), Syntax::Ron);
    assert_eq!(seen(&again), seen(&scene));
}

#[test]
fn a_mesh_in_a_thousand_copies_of_a_group_is_one_object() {
    let text = r#"Scene(background: 1, objects: [
        Group(placements: Grid(count: (10, 10, 10)), objects: [Mesh(file: "a.off")]),
    ])"#;
    let scene = read(text, Syntax::Ron);
    assert_eq!((scene.objects.len(), copies(&scene)), (1, vec![1000]));
}

#[test]
fn what_is_written_again_says_the_same() {
    let scene = read(TABLE, Syntax::Ron);
    for syntax in [Syntax::Ron, Syntax::Toml] {
        for defaults in [Defaults::Hidden, Defaults::Shown] {
            let text = to_text(&scene, syntax, defaults);
            assert_eq!(hash_hex(&read(&text, syntax)), hash_hex(&scene), "{text}");
        }
    }
    let toml = convert("s", TABLE, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.contains("Group") && toml.contains("name = \"top\""), "{toml}");
    assert_eq!(hash_hex(&read(&toml, Syntax::Toml)), hash_hex(&scene), "{toml}");
}

#[test]
fn a_group_without_a_place_of_its_own_leaves_no_trace() {
    let plain = r#"Scene(background: 1, objects: [Box(material: Mirror()), Sphere(center: (0, 0, 0), radius: 1)])"#;
    let grouped = r#"Scene(background: 1,
        objects: [Group(objects: [Group(objects: [Box()], material: Mirror()),
                Sphere(center: (0, 0, 0), radius: 1)])])"#;
    assert_eq!(hash_hex(&read(plain, Syntax::Ron)), hash_hex(&read(grouped, Syntax::Ron)));
}

#[test]
fn groups_stand_sixteen_deep() {
    let nested = |deep: usize| {
        format!("Scene(background: 1, objects: [{}Box(){}])", "Group(objects: [".repeat(deep), "])".repeat(deep))
    };
    assert!(errors(&nested(16), Syntax::Ron).is_empty());
    let found = errors(&nested(17), Syntax::Ron);
    assert_eq!(found.iter().map(|fault| fault.code.as_str()).collect::<Vec<_>>(), ["E0606"]);
}

#[test]
fn a_hundred_million_objects_are_the_most() {
    let copied = |count: u32| {
        format!(
            "Scene(background: 1, objects: [Group(placements: Grid(count: (1000, 1, 1000)), objects: [Box(placements: \
             Ring(count: {count}, radius: 1))])])"
        )
    };
    assert!(errors(&copied(100), Syntax::Ron).is_empty());
    let found = errors(&copied(101), Syntax::Ron);
    assert_eq!(found.iter().map(|fault| fault.code.as_str()).collect::<Vec<_>>(), ["E0606"]);
}

/// A scene with these arguments of `--set`, or what is wrong with them.
fn set(text: &str, arguments: &[&str]) -> Result<SceneDesc, (String, String)> {
    let sets: Vec<Override> = arguments.iter().map(|argument| Override::from(*argument)).collect();
    match load_str("s", text, Syntax::Ron, Path::new(""), &sets) {
        Ok(loaded) => Ok(loaded.scene),
        Err(LoadError::Invalid { diagnostics, .. }) => {
            Err((diagnostics[0].message.clone(), format!("{}; {}", diagnostics[0].expected, diagnostics[0].hint)))
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn a_name_leads_to_what_it_names_wherever_that_stands() {
    let scene = set(
        TABLE,
        &["objects.ball.radius=2", "objects.leg.file=\"foot.off\"", "objects.set.transform=[]", "objects.lamp.power=5"],
    );
    let scene = scene.expect("three names");
    assert!(matches!(&scene.objects[4].value, Object::Sphere(ball) if ball.radius.value == 2.0));
    assert!(
        matches!(&scene.objects[1].value, Object::Mesh(leg) if leg.file().expect("a file").value.ends_with("foot.off"))
    );
    // The group has no place of its own now, and what stood in two stands in one.
    assert_eq!(scene.objects[0].value.placements(), &Placements::One);
    let by_number = set(TABLE, &["objects[1].radius=2"]).expect("a number");
    assert!(matches!(&by_number.objects[4].value, Object::Sphere(ball) if ball.radius.value == 2.0));
    let lit = r#"Scene(lights: [SphereLight(center: (0, 5, 0), radius: 1, power: 9, name: "sun")], objects: [Box()])"#;
    let scene = set(lit, &["lights.sun.power=20"]).expect("a light");
    let scene_format::desc::Light::SphereLight(sun) = &scene.lights[0].value;
    assert_eq!(sun.amount.value, scene_format::desc::Amount::Power([20.0; 3]));
    // A light of a group is a light, too, whether the scene has lights of its own or none.
    for own in ["", "lights: [SphereLight(center: (0, 5, 0), radius: 1, power: 9)],"] {
        let bulb = "SphereLight(center: (0, 1, 0), radius: 1, power: 9, name: \"bulb\")";
        let grouped = format!("Scene({own} objects: [Group(objects: [Box()], lights: [{bulb}])])");
        let by_light = set(&grouped, &["lights.bulb.radius=0.5"]).expect("a light in a group");
        assert_eq!(by_light.objects, set(&grouped, &["objects.bulb.radius=0.5"]).expect("the same").objects);
    }
}

#[test]
fn a_name_that_none_or_several_have_is_told_with_those_that_there_are() {
    let (message, more) = set(TABLE, &["objects.bal.radius=2"]).expect_err("no such name");
    assert_eq!(message, "no object has the name \"bal\"");
    assert_eq!(more, "one of `ball`, `lamp`, `leg`, `set` or `top`; did you mean `ball`?");
    let twice = r#"Scene(background: 1, objects: [Box(name: "a"), Group(objects: [Box(name: "a")])])"#;
    let (message, more) = set(twice, &["objects.a.size=2"]).expect_err("two of them");
    assert_eq!(message, "2 objects have the name \"a\"");
    assert_eq!(more, "a name that only one has, or a number; they are objects[0] and objects[1].objects[0]");
    assert!(set(twice, &["objects[1].objects[0].size=2"]).is_ok());
    let repeated = r#"Scene(background: 1, objects: [Repeat(count: 3, items: [Box(name: "a")])])"#;
    let (message, _) = set(repeated, &["objects.a.size=2"]).expect_err("it is many");
    assert_eq!(message, "the object \"a\" stands in a `Repeat`");
    let (message, more) = set("Scene(background: 1, objects: [Box()])", &["objects.a.size=2"]).expect_err("no names");
    assert_eq!(message, "no object has the name \"a\"");
    assert_eq!(
        more,
        "the number of an item in brackets, counted from 0: [0]; names are given in the scene: `name: \"a\"`"
    );
}

#[test]
fn a_pick_is_the_value_that_it_picks() {
    let picked = r##"Scene(background: 1,
        materials: { "red": Pick(from: [Mirror(), Diffuse(albedo: "#ff0000")], index: -1) }, objects: [
        Repeat(count: 3, items: [
            Pick(from: [Box(center: "=(i, 0, 0)"),
                Sphere(center: (0, 0, 0), radius: Pick(from: [1, 2], index: "=i"))], index: "=i"),
        ]),
        Box(material: Pick(from: ["red"], index: 5), transform: [Translate(Pick(from: [(1, 2, 3)], index: 0))]),
    ])"##;
    let plain = r##"Scene(background: 1, materials: { "red": Diffuse(albedo: "#ff0000") }, objects: [
        Box(center: (0, 0, 0)), Sphere(center: (0, 0, 0), radius: 2), Box(center: (2, 0, 0)),
        Box(material: "red", transform: [Translate((1, 2, 3))]),
    ])"##;
    let wanted = hash_hex(&read(plain, Syntax::Ron));
    assert_eq!(hash_hex(&read(picked, Syntax::Ron)), wanted);
    let toml = convert("s", picked, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.matches("Pick").count() == 5, "{toml}");
    assert_eq!(hash_hex(&read(&toml, Syntax::Toml)), wanted, "{toml}");
}

/// A group with a step that goes by all that is in it is written as one group, whatever groups are in it.
#[test]
fn groups_in_groups_are_written_as_they_stand() {
    let text = r#"Scene(background: 1, objects: [
        Group(transform: [DropTo(0)], objects: [
            Box(center: (0, 3, 0)),
            Group(placements: [[], [Translate((2, 0, 0))]], objects: [
                Sphere(radius: 0.5, center: (0, 1, 0)),
                Group(transform: [CenterTo((0, 0, 0))], objects: [Box(name: "a"), Box(name: "b")]),
            ]),
            Group(placements: [[]], objects: [Sphere(radius: 1)]),
        ]),
        Group(transform: [Scale(2)], objects: [Box(), Box()]),
        Box(),
    ])"#;
    let scene = read(text, Syntax::Ron);
    for (syntax, defaults) in [
        (Syntax::Ron, Defaults::Hidden),
        (Syntax::Ron, Defaults::Shown),
        (Syntax::Toml, Defaults::Shown),
        (Syntax::Json, Defaults::Hidden),
    ] {
        let written = to_text(&scene, syntax, defaults);
        let again = read(&written, syntax);
        assert_eq!(written.matches("Group").count(), 5, "{written}");
        for step in ["DropTo", "CenterTo"] {
            assert_eq!(written.matches(step).count(), 1, "{written}");
        }
        assert_eq!((hash_hex(&again), copies(&again)), (hash_hex(&scene), copies(&scene)), "{written}");
    }
}

/// In TOML the text "None" says that there is no name: so nothing is called so.
#[test]
fn nothing_is_called_none() {
    for object in [
        "Box(name: \"None\")",
        "Mesh(file: \"a.obj\", part: \"None\")",
        "Box(material: Emissive(radiance: 1, group: \"None\"))",
    ] {
        let found = errors(&format!("Scene(background: 1, objects: [{object}])"), Syntax::Ron);
        assert!(found.len() == 1 && found[0].message == "\"None\" is no name", "{object}: {found:?}");
    }
    read("background = 1\nobjects = [{ Box = { name = \"None\" } }]", Syntax::Toml);
}

/// What stands no times is not what stands once.
#[test]
fn placements_that_come_to_none_are_told() {
    let scene = |count: u32| {
        format!(
            "Scene(background: 1, vars: {{ \"n\": {count} }}, objects: [Box(placements: [Repeat(count: \"=n\", \
             items: [[Translate((\"=2*i\", 0, 0))]])])])"
        )
    };
    assert_eq!(copies(&read(&scene(2), Syntax::Ron)), [2]);
    let found = errors(&scene(0), Syntax::Ron);
    assert!(found.len() == 1 && found[0].message.contains("come to none"), "{found:?}");
    assert_eq!(copies(&read("Scene(background: 1, objects: [Box(placements: [])])", Syntax::Ron)), [1]);
}
