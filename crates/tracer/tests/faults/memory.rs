//! Memory that is not to be had: an error, never an abort.

use super::cases::Kind;
use super::judge::{Quiet, words};
use super::run::{Folder, Ran};
use super::{cases::Case, is_long};
use rayon::prelude::*;

/// A landscape of as many triangles as a picture of 200 x 200 heights has, under a texture, at 400 x 300 pixels.
const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 3, 6), look_at: (0, 0, 0), fov: 40),
    image: Image(width: 400, height: 300),
    render: Render(samples: 1, max_bounces: 2),
    background: (0.2, 0.3, 0.4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    materials: { "board": Diffuse(albedo: Texture(file: "board.png")) },
    objects: [
        HeightField(file: "board.png", size: (8, 1, 8), material: "board"),
        Mesh(file: "sheet.off", material: Mirror(reflectance: 0.9)),
    ],
)
"#;

/// A sheet of 2 * 150 * 150 triangles.
fn sheet() -> String {
    let n = 150;
    let mut text = format!("OFF\n{} {} 0\n", (n + 1) * (n + 1), 2 * n * n);
    for (x, z) in (0..=n).flat_map(|z| (0..=n).map(move |x| (x, z))) {
        text += &format!("{} {} {}\n", x as f64 * 0.02, 1.0 + (x % 2) as f64 * 0.05, z as f64 * 0.02 - 3.0);
    }
    for (x, z) in (0..n).flat_map(|z| (0..n).map(move |x| (x, z))) {
        let at = z * (n + 1) + x;
        text += &format!("3 {at} {} {}\n3 {} {} {}\n", at + 1, at + n + 1, at + 1, at + n + 2, at + n + 1);
    }
    text
}

fn large() -> Vec<Case> {
    let scene = || {
        let folder = Folder::new();
        folder.write("plain.ron", "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])");
        folder.ready("render plain.ron -o board.png --size 600x600 --samples 1", 0);
        folder.write("scene.ron", SCENE);
        folder.write("sheet.off", sheet());
        folder.write("a.png", "PF old");
        folder
    };
    let film = || {
        let folder = scene();
        folder.ready("render scene.ron --part 1/1 -o p.tracer -q", 0);
        folder
    };
    let case = |name, line, outputs: &[(&'static str, Kind)], folder| Case {
        name,
        line,
        outputs: outputs.to_vec(),
        code: 0,
        folder,
    };
    vec![
        case("pictures", "render scene.ron -o a.png -o a.hdr -o a.pfm", &[("a.png", Kind::Bytes)], scene()),
        case(
            "layers, denoised",
            "render scene.ron -o a.exr --samples 2 --layers depth,normal --denoise --crop 0,0,200,200",
            &[("a.exr", Kind::Bytes)],
            scene(),
        ),
        case(
            "a checkpoint",
            "render scene.ron -o a.png --samples 2 --resume p.tracer --checkpoint c.film --every 1ms",
            &[("a.png", Kind::Bytes), ("c.film", Kind::Film), ("c.film.previous", Kind::Film)],
            {
                let folder = scene();
                folder.ready("render scene.ron -o b.pfm --checkpoint p.tracer -q", 0);
                folder
            },
        ),
        case("merge", "merge p.tracer -o a.png", &[("a.png", Kind::Bytes)], film()),
        case("what is no rendering", "check scene.ron", &[], scene()),
    ]
}

/// What is wrong with a run that may have had too little memory.
fn wrong(case: &Case, quiet: &Quiet, folder: &Folder, ran: &Ran) -> Vec<String> {
    let mut wrong = quiet.wrong(case, folder, ran);
    // It is memory that is to be named, not a file; and what is written twice is another test's.
    wrong.retain(|fault| !fault.starts_with("it does not say") && !fault.starts_with("it cannot be gone on with"));
    let is_said = ["memory", "threads", "address space"].iter().any(|word| ran.err.contains(word));
    if ran.code != Some(0) && !is_said {
        wrong.push("it does not say that memory is short".to_owned());
    }
    wrong
}

#[test]
fn every_large_block_is_refused() {
    let mut count = 0;
    let mut found = Vec::new();
    for case in &large() {
        let quiet = Quiet::of(case);
        let blocks = case.folder.copy().run(&words(case), &[("FAULT_BLOCK", "0".to_owned())]).blocks.len();
        assert!(blocks > 3, "{}: {blocks} large blocks", case.name);
        let step = if is_long() { 1 } else { 1 + blocks / 25 };
        let chosen: Vec<usize> = (1..=blocks).step_by(step).collect();
        count += chosen.len();
        found.par_extend(chosen.into_par_iter().filter_map(|block| {
            let folder = case.folder.copy();
            let ran = folder.run(&words(case), &[("FAULT_BLOCK", block.to_string())]);
            let wrong = wrong(case, &quiet, &folder, &ran);
            (!wrong.is_empty()).then(|| {
                let (name, said) = (case.name, ran.err.trim());
                format!("{name}: block {block} of {blocks}: {}; it says: {said}", wrong.join("; "))
            })
        }));
    }
    println!("{count} blocks were refused");
    assert!(found.is_empty(), "{} of {count}:\n{}", found.len(), found.join("\n"));
}

/// From an address space in which the program just starts to one that is large enough, in steps.
#[test]
fn the_address_space_ends() {
    end_the_address_space(&large(), if is_long() { 4096 } else { 16384 });
}

/// In small steps: threads and their batches have little room between what is loaded and what is enough.
#[test]
fn threads_find_no_room() {
    end_the_address_space(&large()[..1], 1024);
}

fn end_the_address_space(cases: &[Case], step: u64) {
    let limited = |folder: &Folder, case: &Case, kilobytes: u64| {
        folder.run_within(&words(case), &[("FAULT_AT", "0".to_owned())], Some(kilobytes))
    };
    let mut short = 0;
    let mut found = Vec::new();
    for case in cases {
        let quiet = Quiet::of(case);
        let starts = |kilobytes: &u64| {
            let schema = ["schema".to_owned()];
            Folder::new().run_within(&schema, &[("FAULT_AT", "0".to_owned())], Some(*kilobytes)).code == Some(0)
        };
        let first = (1..).map(|k| 4096 * k).find(starts).expect("it starts at all");
        // What is freed may leave less room than there was: once is not enough.
        let mut enough = 0;
        let mut space = first;
        loop {
            let folder = case.folder.copy();
            let ran = limited(&folder, case, space);
            let wrong = wrong(case, &quiet, &folder, &ran);
            if !wrong.is_empty() {
                let (name, said) = (case.name, ran.err.trim());
                found.push(format!("{name} within {space} KiB: {}; it says: {said}", wrong.join("; ")));
            }
            let is_enough = ran.code == Some(0);
            enough = if is_enough { enough + 1 } else { 0 };
            if enough == 3 || space > 4 << 20 {
                break;
            }
            short += usize::from(!is_enough);
            space += step;
        }
    }
    println!("{short} runs had too little");
    assert!(short > 5 && found.is_empty(), "{short} runs, {} wrong:\n{}", found.len(), found.join("\n"));
}
