//! What is run: the commands that write files, and those that must not replace one.

use super::run::Folder;

/// How a file that was written is known to be whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It has the bytes of a run without faults.
    Bytes,
    /// A film that can be read to its end: it tells when it was written.
    Film,
    /// JSON that can be read to its end: it tells how long it took.
    Json,
}

/// A command line, and what it writes.
pub struct Case {
    pub name: &'static str,
    pub line: &'static str,
    pub outputs: Vec<(&'static str, Kind)>,
    /// The exit code without faults. Where it is not 0, nothing may change whatever fails.
    pub code: i32,
    /// The folder before.
    pub folder: Folder,
}

const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 12, height: 8),
    render: Render(samples: 2, max_bounces: 3),
    background: (0.2, 0.3, 0.4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    materials: { "board": Diffuse(albedo: Texture(file: "board.png")) },
    objects: [
        Rectangle(center: (0, 0, 0), normal: (0, 1, 0), size: (6, 6), material: "board"),
        Sphere(center: (-1, 1, 0), radius: 1, material: Transparent(ior: 1.5)),
        Mesh(file: "tent.off", material: Mirror(reflectance: 0.9)),
    ],
)
"#;
const TENT: &str = "OFF\n4 4 0\n0 0 1\n2 0 1\n1 0 -1\n1 2 0\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 2 1\n";
/// Laid out by nobody, and with a word that `check --fix` mends.
const UNTIDY: &str = "Scene(background:1,objects:[Sphere(center:(0,0,0),radius:1)])\n";
const WRONG: &str = "Scene(backgruond: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])\n";

fn scene() -> Folder {
    let folder = Folder::new();
    folder.write("plain.ron", UNTIDY);
    folder.ready("render plain.ron -o board.png --size 8x8 --samples 1", 0);
    std::fs::remove_file(folder.path("plain.ron")).expect("a file");
    folder.write("scene.ron", SCENE);
    folder.write("tent.off", TENT);
    folder
}

/// The scene, with older files of these names.
fn with(old: &[&str]) -> Folder {
    let folder = scene();
    // Pictures and reports replace only what begins as theirs do.
    let begin = |name: &str| match name.rsplit_once('.').map(|(_, extension)| extension) {
        Some("png" | "exr" | "hdr" | "pfm") => "PF old",
        Some("json") => "{ \"report_version\": 1 }",
        _ => "old",
    };
    old.iter().for_each(|name| folder.write(name, begin(name)));
    folder
}

fn case(name: &'static str, line: &'static str, outputs: &[(&'static str, Kind)], folder: Folder) -> Case {
    Case { name, line, outputs: outputs.to_vec(), code: 0, folder }
}

/// One that is refused.
fn refused(name: &'static str, line: &'static str, code: i32, folder: Folder) -> Case {
    Case { name, line, outputs: Vec::new(), code, folder }
}

/// All of them.
pub fn all() -> Vec<Case> {
    let mut cases = pictures();
    cases.extend(films());
    cases.extend(caches());
    cases.extend(scenes());
    cases.extend(spared());
    cases
}

fn pictures() -> Vec<Case> {
    use Kind::{Bytes, Json};
    vec![
        case("png", "render scene.ron -o a.png", &[("a.png", Bytes)], with(&["a.png"])),
        case("png of 16 bits", "render scene.ron -o a.png --bits 16", &[("a.png", Bytes)], with(&[])),
        case("hdr", "render scene.ron -o a.hdr", &[("a.hdr", Bytes)], with(&["a.hdr"])),
        case("pfm", "render scene.ron -o a.pfm", &[("a.pfm", Bytes)], with(&["a.pfm"])),
        case(
            "exr with layers, and a png",
            "render scene.ron -o a.exr -o a.png --layers depth,normal --denoise",
            &[("a.exr", Bytes), ("a.png", Bytes)],
            with(&["a.exr", "a.png"]),
        ),
        case(
            "a report",
            "render scene.ron -o a.pfm --report r.json",
            &[("a.pfm", Bytes), ("r.json", Json)],
            with(&["r.json"]),
        ),
        case("standard output", "render scene.ron -o - --format png", &[], scene()),
        case("merge to standard output", "render scene.ron -o a.png --report -", &[("a.png", Bytes)], scene()),
    ]
}

fn films() -> Vec<Case> {
    use Kind::{Bytes, Film, Json};
    let older = || {
        let folder = scene();
        folder.ready("render scene.ron -o b.pfm --samples 1 --checkpoint c.film -q", 0);
        folder
    };
    let twice = || {
        let folder = older();
        folder.ready("render scene.ron -o b.pfm --samples 2 --resume c.film -q", 0);
        folder
    };
    let parts = || {
        let folder = with(&["a.png"]);
        folder.ready("render scene.ron --part 1/2 -o p1.tracer -q", 0);
        folder.ready("render scene.ron --part 2/2 -o p2.tracer -q", 0);
        folder
    };
    vec![
        case(
            "a checkpoint",
            "render scene.ron -o a.pfm --checkpoint c.film --every 1ms",
            &[("a.pfm", Bytes), ("c.film", Film), ("c.film.previous", Film)],
            with(&["a.pfm"]),
        ),
        case(
            "a checkpoint gone on with",
            "render scene.ron -o a.pfm --samples 5 --resume c.film --every 1ms",
            &[("a.pfm", Bytes), ("c.film", Film), ("c.film.previous", Film)],
            twice(),
        ),
        case("a part", "render scene.ron --part 1/2 -o p.tracer", &[("p.tracer", Film)], scene()),
        case(
            "a part gone on with",
            "render scene.ron --part 1/2 -o p1.tracer --resume p1.tracer",
            &[("p1.tracer", Film), ("p1.tracer.previous", Film)],
            parts(),
        ),
        case(
            "merge",
            "merge p1.tracer p2.tracer -o a.png --report r.json",
            &[("a.png", Bytes), ("r.json", Json)],
            parts(),
        ),
        case("what a film tells", "info p1.tracer", &[], parts()),
    ]
}

/// A mesh and a tree that are kept, and that were.
fn caches() -> Vec<Case> {
    const SIDE: usize = 50;
    let field = || {
        let folder = scene();
        let mut text = format!("OFF\n{} {} 0\n", (SIDE + 1) * (SIDE + 1), 2 * SIDE * SIDE);
        for k in 0..(SIDE + 1) * (SIDE + 1) {
            text += &format!("{} {:.6} {}\n", k % (SIDE + 1), 0.01 * (k % 7) as f64, k / (SIDE + 1));
        }
        for k in 0..SIDE * SIDE {
            let a = k / SIDE * (SIDE + 1) + k % SIDE;
            text += &format!("3 {a} {} {}\n3 {} {} {}\n", a + SIDE + 1, a + 1, a + 1, a + SIDE + 1, a + SIDE + 2);
        }
        folder.write("tent.off", text);
        folder
    };
    let line = "render scene.ron -o a.pfm --cache kept";
    let there = || {
        let folder = field();
        folder.ready(line, 0);
        std::fs::remove_file(folder.path("a.pfm")).expect("it is there");
        folder
    };
    vec![
        case("a cache", line, &[("a.pfm", Kind::Bytes)], field()),
        case("a cache that is there", line, &[("a.pfm", Kind::Bytes)], there()),
    ]
}

fn scenes() -> Vec<Case> {
    use Kind::Bytes;
    let golden = || {
        let folder = Folder::new();
        folder.write("g/one.ron", UNTIDY);
        folder.ready("golden new g --samples 2", 0);
        folder.write("g/golden.toml", "noise = false\nsamples = 2\nsize = [8, 8]\n");
        folder.ready("golden run g", 1);
        folder
    };
    let untidy = |text: &str| {
        let folder = Folder::new();
        folder.write("a.ron", text);
        folder
    };
    let replaced = || {
        let folder = untidy(UNTIDY);
        folder.write("b.toml", "old");
        folder
    };
    vec![
        case("convert", "convert a.ron -o b.toml --force", &[("b.toml", Bytes)], replaced()),
        case("fmt", "fmt a.ron", &[("a.ron", Bytes)], untidy(UNTIDY)),
        case("check --fix", "check a.ron --fix", &[("a.ron", Bytes)], untidy(WRONG)),
        case("new", "new b.ron", &[("b.ron", Bytes)], Folder::new()),
        case(
            "golden accept",
            "golden accept g one --reason right",
            &[("g/one.png", Bytes), ("g/log.md", Bytes)],
            golden(),
        ),
        case("check", "check scene.ron", &[], scene()),
        case("compare", "compare board.png board.png", &[], scene()),
        case("completions", "completions bash", &[], Folder::new()),
        case("man", "man render", &[], Folder::new()),
        case("schema", "schema", &[], Folder::new()),
    ]
}

/// What must not be replaced is not, whatever fails while that is found out.
fn spared() -> Vec<Case> {
    vec![
        refused("a scene file that is there", "convert scene.ron -o b.toml", 2, with(&["b.toml"])),
        refused("the scene's texture", "render scene.ron -o board.png", 2, scene()),
        refused("the scene's mesh as a report", "render scene.ron -o a.png --report tent.off", 2, scene()),
        refused("what is no checkpoint", "render scene.ron -o a.png --checkpoint tent.off", 2, scene()),
        refused("what is no part", "render scene.ron --part 1/2 -o old.tracer", 2, with(&["old.tracer"])),
    ]
}
