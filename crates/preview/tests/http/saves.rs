//! What happens when files change: scenes, what they use, all that editors do with files.

use crate::support::{SCENE, Sandbox, stage_of};
use serde_json::Value;
use std::fs;
use std::thread::sleep;
use std::time::Duration;

fn texts(state: &Value) -> String {
    let told = state["told"].as_array().expect("a list");
    told.iter().map(|told| told["text"].as_str().expect("a text").to_owned() + "\n").collect()
}

fn wrong(state: &Value) -> bool {
    state["phase"] == "wrong"
}

#[test]
fn each_way_to_save_is_seen() {
    let sandbox = Sandbox::new(SCENE);
    let mut stage = stage_of(&sandbox.done_after(0));
    let mut before = sandbox.pixels();
    for (k, albedo) in ["0.1", "0.3", "0.5", "0.7", "0.9"].iter().enumerate() {
        let text = SCENE.replace("0.8", albedo);
        match k {
            0 => sandbox.write("scene.ron", &text),
            1 | 2 => sandbox.rename_save("scene.ron", &text),
            3 => {
                // As vim does with `backupcopy=no`: the old one is moved away first.
                fs::rename(sandbox.path("scene.ron"), sandbox.path("scene.ron~")).expect("a rename");
                sandbox.write("scene.ron", &text);
            }
            _ => {
                // Emptied, then written.
                sandbox.write("scene.ron", "");
                sleep(Duration::from_millis(30));
                sandbox.write("scene.ron", &text);
            }
        }
        let state = sandbox.done_after(stage);
        stage = stage_of(&state);
        assert_eq!(texts(&state), "", "{k}");
        let now = sandbox.pixels();
        assert_ne!(now, before, "{k}");
        before = now;
    }
    // Saved as it was: nothing to do.
    sandbox.rename_save("scene.ron", &SCENE.replace("0.8", "0.9"));
    sleep(Duration::from_millis(700));
    assert_eq!(stage_of(&sandbox.state()), stage);
}

/// Whoever looks at the terminal is told of a wrong scene once, and when it is right again.
#[test]
fn what_is_wrong_is_told_beside_the_page() {
    let sandbox = Sandbox::new(SCENE);
    let stage = stage_of(&sandbox.done_after(0));
    assert!(sandbox.wrong.lock().expect("nobody panics").is_empty());
    sandbox.rename_save("scene.ron", &SCENE.replace("radius", "radus"));
    sandbox.until(wrong);
    sandbox.rename_save("scene.ron", &SCENE.replace("0.8", "0.7"));
    sandbox.done_after(stage);
    let told = sandbox.wrong.lock().expect("nobody panics").clone();
    assert!(matches!(&told[..], [Some(faults), None] if faults.contains("radus") && faults.contains("^")), "{told:?}");
}

/// A pipe in place of the scene is told, and read by nobody; the scene that comes after it is shown.
#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_the_scene_is_told() {
    let sandbox = Sandbox::new(SCENE);
    let stage = stage_of(&sandbox.done_after(0));
    fs::remove_file(sandbox.path("scene.ron")).expect("it is there");
    let made = std::process::Command::new("mkfifo").arg(sandbox.path("scene.ron")).status().expect("mkfifo");
    assert!(made.success());
    let state = sandbox.until(|state| wrong(state) && texts(state).contains("no regular file"));
    assert!(wrong(&state));
    sandbox.rename_save("scene.ron", &SCENE.replace("0.8", "0.6"));
    sandbox.done_after(stage);
}

#[test]
fn ten_saves_in_a_second_end_with_the_last() {
    let sandbox = Sandbox::new(SCENE);
    sandbox.done_after(0);
    for k in 0..10 {
        sandbox.rename_save("scene.ron", &SCENE.replace("width: 24", &format!("width: {}", 30 + k)));
        sleep(Duration::from_millis(90));
    }
    let state = sandbox.until(|state| state["phase"] == "done" && state["frame"]["size"][0] == 39);
    assert_eq!(texts(&state), "");
}

#[test]
fn while_the_scene_is_wrong_the_last_picture_stays() {
    let sandbox = Sandbox::new(SCENE);
    let first = sandbox.done_after(0);
    let pixels = sandbox.pixels();
    sandbox.write("scene.ron", SCENE.replace("radius", "radus"));
    let state = sandbox.until(wrong);
    let text = texts(&state);
    assert!(
        text.contains("error[E0201]")
            && text.contains("radus: 1")
            && text.contains("^^^^^")
            && text.contains("did you mean"),
        "{text}"
    );
    let place = &state["told"][0]["place"];
    assert_eq!((&place["name"], &place["line"]), (&"scene.ron".into(), &7.into()));
    assert!(place["column"].as_u64() > Some(40) && place.get("path").is_none(), "{place}");
    assert_eq!(stage_of(&state), stage_of(&first));
    assert_eq!(sandbox.pixels(), pixels);
    // Another fault, then none.
    sandbox.write("scene.ron", &SCENE[..SCENE.len() / 2]);
    let half = sandbox.until(|state| wrong(state) && texts(state) != text);
    assert!(texts(&half).contains("error[E01"), "a half-saved file: {}", texts(&half));
    sandbox.write("scene.ron", SCENE.replace("0.8", "0.1"));
    let state = sandbox.done_after(stage_of(&first));
    assert_eq!(texts(&state), "");
    assert_ne!(sandbox.pixels(), pixels);
}

#[test]
fn a_scene_may_be_wrong_from_the_start_and_gone_for_a_while() {
    let sandbox = Sandbox::new("Scene(");
    let state = sandbox.until(wrong);
    assert!(state["frame"].is_null());
    assert_eq!(sandbox.get("frame").status, 409);
    sandbox.write("scene.ron", SCENE);
    let state = sandbox.done_after(0);
    fs::remove_file(sandbox.path("scene.ron")).expect("it can be deleted");
    let gone = sandbox.until(wrong);
    assert!(texts(&gone).contains("scene.ron is not there any more"), "{}", texts(&gone));
    assert_eq!(stage_of(&gone), stage_of(&state), "the picture stays");
    sandbox.write("scene.ron", SCENE);
    sandbox.until(|state| state["phase"] == "done");
    // A folder in its place is told, too.
    fs::remove_file(sandbox.path("scene.ron")).expect("it can be deleted");
    fs::create_dir(sandbox.path("scene.ron")).expect("a folder");
    sandbox.until(wrong);
    fs::remove_dir(sandbox.path("scene.ron")).expect("it can be deleted");
    sandbox.write("scene.ron", SCENE.replace("0.8", "0.4"));
    sandbox.until(|state| state["phase"] == "done");
}

const OFF: &str = "OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n";

#[test]
fn every_file_that_the_scene_uses_counts() {
    let objects = "objects: [Mesh(file: \"t.obj\"), Mesh(file: \"u.off\", placements: \"p.txt\"), ";
    let sandbox = Sandbox::new(&SCENE.replace("objects: [", objects));
    // Missing from the start: each file that comes is looked at, and then all is well.
    let text = texts(&sandbox.until(wrong));
    assert!(text.contains("t.obj") && text.contains("u.off") && text.contains("p.txt"), "{text}");
    sandbox.write("u.off", OFF);
    sandbox.write("p.txt", "0 0 0\n");
    let obj = "mtllib m.mtl\nusemtl a\nv -2 0 0\nv -1 0 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    sandbox.write("t.obj", obj);
    sandbox.write("m.mtl", "newmtl a\nKd 0.9 0.1 0.1\n");
    let mut stage = stage_of(&sandbox.until(|state| state["phase"] == "done" && texts(state).is_empty()));
    let mut before = sandbox.pixels();
    for (name, text) in [
        ("u.off", OFF.replace("1 1 -1", "2 2 -1")),
        ("p.txt", "1 1 0\n".to_owned()),
        ("m.mtl", "newmtl a\nKd 0.1 0.9 0.1\n".to_owned()),
        ("t.obj", obj.replace("-1 1 0", "-1 2 0")),
    ] {
        sandbox.rename_save(name, &text);
        let state = sandbox.done_after(stage);
        stage = stage_of(&state);
        let now = sandbox.pixels();
        assert_ne!(now, before, "{name}");
        before = now;
    }
    // A picture that only the mesh's own material names: missing, which is told, then there.
    sandbox.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd x.png\n");
    let state = sandbox.until(|state| state["phase"] == "done" && texts(state).contains("x.png"));
    let (stage, before) = (stage_of(&state), sandbox.pixels());
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/globe.png"), sandbox.path("x.png")).expect("a texture");
    assert_eq!(texts(&sandbox.done_after(stage)), "");
    assert_ne!(sandbox.pixels(), before);
}

/// The bytes that this process holds.
#[cfg(target_os = "linux")]
fn resident() -> u64 {
    let status = fs::read_to_string("/proc/self/statm").expect("Linux");
    status.split(' ').nth(1).and_then(|pages| pages.parse::<u64>().ok()).expect("a number") * 4096
}

/// Hundreds of saves, wrong ones among them: what is held goes up and down with the allocator, and does not grow. A
/// film of these 300x200 pixels has 7 MB; one kept of each save would be 2 GB.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn hundreds_of_saves_leave_no_memory_behind() {
    let text = SCENE.replace("width: 24, height: 16", "width: 300, height: 200").replace("samples: 4", "samples: 1");
    let sandbox = Sandbox::new(&text);
    let mut stage = stage_of(&sandbox.done_after(0));
    let mut early = 0;
    for k in 0..300 {
        if k == 30 {
            early = resident();
        }
        if k % 10 == 9 {
            sandbox.write("scene.ron", "Scene(");
            sandbox.until(wrong);
        }
        sandbox.rename_save("scene.ron", &text.replace("fov: 40", &format!("fov: {}", 20 + k % 100)));
        let state = sandbox.done_after(stage);
        stage = stage_of(&state);
        sandbox.pixels();
    }
    let late = resident();
    assert!(late < early + (150 << 20), "{} MB after 30 saves, {} MB after 300", early >> 20, late >> 20);
}
