//! `tracer farm slurm` with a real Slurm on this machine, and the lines of docs/scale.md that need more than a shell:
//! `cargo xtask prove slurm` installs what they need and runs this. It must be root, as Slurm's daemons are.

mod cluster;
mod manual;
mod reaper;
mod ssh;

use cluster::{Cluster, NODES};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output};
use std::time::Instant;

const TRACER: &str = env!("CARGO_BIN_EXE_tracer");
/// A folder of a name that a shell and Slurm would take apart.
const ODD: &str = "it's \"odd\" %j $HOME";

const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 24),
    render: Render(samples: 8, max_bounces: 4),
    background: (0.2, 0.3, 0.4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    objects: [
        Sphere(center: (0, -100, 0), radius: 100),
        Sphere(center: (-1, 1, 0), radius: 1, material: Transparent(ior: 1.5)),
        Sphere(center: (1, 1, 0), radius: 1, material: Mirror(reflectance: 0.9)),
    ],
)
"#;

/// One cluster for all of it: to start one takes as long as most of what it shows.
#[test]
fn a_farm_with_slurm() {
    let start = Instant::now();
    let mut proof = Proof { cluster: Cluster::start() };
    let told = |what: &str| println!("{:5.1} s: {what}", start.elapsed().as_secs_f64());
    told("the cluster stands");
    proof.the_bytes_of_one_machine();
    told("array and merge make the bytes of one machine, in a folder of an odd name");
    proof.by_hand();
    told("the lines by hand, too");
    let samples = proof.samples_of_seconds(5.0);
    // Until Slurm gives a dead node up there is time for the others.
    proof.nothing_is_lost(samples, |proof| {
        told("a node is dead");
        proof.what_fails_is_tried_again_and_named();
        told("a part that fails is tried again, one that fails always is named, and the merge says that it is missing");
        proof.cancelled();
        told("what is cancelled stops, keeps its films, and goes on");
    });
    told("a node that dies, a limit that is near, SIGTERM: gone on with, to the same bytes");
}

struct Proof {
    cluster: Cluster,
}

impl Proof {
    fn write(&self, name: &str, text: &str) {
        fs::write(self.cluster.path("work").join(name), text).expect("a file");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.cluster.path("work").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn text(&self, name: &str) -> String {
        String::from_utf8_lossy(&self.read(name)).into_owned()
    }

    /// Runs the program; what it says on both outputs.
    #[track_caller]
    fn tracer(&self, arguments: &[&str], code: i32) -> String {
        let mut command: Command = self.cluster.command(TRACER, arguments);
        let Output { status, stdout, stderr } = command.output().expect("the program starts");
        let said = format!("{}{}", String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
        assert_eq!(status.code(), Some(code), "tracer {arguments:?}: {said}");
        said
    }

    #[track_caller]
    fn slurm(&self, picture: &str, parts: &str, more: &[&str]) -> String {
        let arguments = ["farm", "slurm", "scene.ron", "-o", picture, "--parts", parts, "-j", "1", "--every", "200ms"];
        self.tracer(&[&arguments[..], &["--pause", "100ms"], more].concat(), 0)
    }

    fn status(&self, farm: &str) -> (Option<i32>, Value) {
        let output = self.cluster.command(TRACER, &["farm", "status", farm, "--json"]).output().expect("it starts");
        (output.status.code(), serde_json::from_slice(&output.stdout).unwrap_or_default())
    }

    /// Waits until the status ends with this exit code.
    #[track_caller]
    fn wait_for(&self, farm: &str, code: i32) -> Value {
        self.cluster.wait(&format!("exit code {code} of {farm}"), || self.status(farm).0 == Some(code));
        self.status(farm).1
    }

    /// Waits until a part runs and has some samples; gives the node and the samples.
    #[track_caller]
    fn wait_for_samples(&self, farm: &str, part: usize, more_than: u64) -> (String, u64) {
        let look = || {
            let told = &self.status(farm).1["parts"][part - 1];
            let note = told["note"].as_str().unwrap_or_default();
            let node = NODES.iter().find(|node| note.starts_with(&format!("on {node} ")))?;
            let held = told["samples"][0].as_u64()?;
            (told["state"] == "running" && held > more_than).then(|| ((*node).to_owned(), held))
        };
        self.cluster.wait(&format!("part {part} of {farm} at work"), || look().is_some());
        look().expect("it has just been seen")
    }

    fn the_bytes_of_one_machine(&self) {
        fs::create_dir(self.cluster.path("work").join(ODD)).expect("a folder");
        let scene = format!("{ODD}/a scene.ron");
        self.write("scene.ron", SCENE);
        self.write(&scene, SCENE);
        let [one, all] = ["one.exr", "all.exr"].map(|name| format!("{ODD}/{name}"));
        self.tracer(&["render", &scene, "-q", "-o", &one], 0);
        let arguments = ["farm", "slurm", &scene, "-o", &all, "--parts", "4", "--time-limit", "10m", "-j", "1"];
        let said = self.tracer(&arguments, 0);
        assert!(said.contains("of 4 parts 4 submitted as job "), "{said}");
        let told = self.wait_for(&format!("{ODD}/all.farm"), 0);
        assert!(
            told["parts"].as_array().is_some_and(|parts| parts.iter().all(|part| part["state"] == "done")),
            "{told}"
        );
        assert_eq!(self.read(&all), self.read(&one));
        assert!(self.tracer(&arguments, 0).contains("all 4 parts are done and merged"));
        // What the cluster does not take is told before it is tried.
        let most = ["farm", "slurm", "scene.ron", "-o", "b.exr", "--parts", "101", "--samples", "200"];
        assert!(self.tracer(&most, 2).contains("the arrays of this cluster end at 100"));
        let job = told["arrays"][0].as_str().expect("a job").to_owned();
        assert!(self.tracer(&["farm", "status", &job], 0).contains("merged: "));
    }

    /// The lines of docs/scale.md, but for the cores: a node has one here.
    fn by_hand(&self) {
        let bin = self.cluster.path("bin");
        fs::create_dir(&bin).expect("a folder");
        std::os::unix::fs::symlink(TRACER, bin.join("tracer")).expect("a link");
        self.write("scene.ron", &SCENE.replace("samples: 8", "samples: 32"));
        self.write("parts.sbatch", &manual::block("### `parts.sbatch`").replace("task=16", "task=1"));
        let lines = format!("PATH=\"{}:$PATH\"; export PATH\n{}", bin.display(), manual::block("### Submitted"));
        self.cluster.run("sh", &["-euc", &lines]);
        let is_there = || self.cluster.path("work/scene.exr").exists();
        self.cluster.wait("the picture", || is_there() && self.cluster.run("squeue", &["-h"]).is_empty());
        self.tracer(&["render", "scene.ron", "-q", "-o", "hand.exr"], 0);
        assert_eq!(self.read("scene.exr"), self.read("hand.exr"));
        self.write("scene.ron", SCENE);
    }

    fn what_fails_is_tried_again_and_named(&self) {
        let script = format!(
            "#!/bin/sh\ncase \"$*\" in *'--part 2/3'*) echo 'error: no luck' >&2; exit 5;; *'--part 1/3'*)\n\
             [ -f once ] || {{ : >once; exit 1; }};; esac\nexec '{TRACER}' \"$@\"\n"
        );
        self.write("flaky", &script);
        let program = self.cluster.path("work/flaky");
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("ours");
        let program = program.display().to_string();
        self.slurm("f.exr", "3", &["--program", &program]);
        self.cluster.wait("the merge's end", || self.status("f.farm").1["merge"]["state"] == "failed");
        let said = self.tracer(&["farm", "status", "f.farm"], 1);
        for words in [
            "exit code 5, 4 times on n",
            "| error: no luck",
            "not merged, for these parts are not done: 2",
            "2 done, 1 failed",
        ] {
            assert!(said.contains(words), "{words}:\n{said}");
        }
        assert!(self.text("f.farm/logs/part-1.log").contains("exit code 1; started again in 0.1 s"));
        // The cause mended, the same line goes on with the one part.
        self.write("flaky", &format!("#!/bin/sh\nexec '{TRACER}' \"$@\"\n"));
        assert!(self.slurm("f.exr", "3", &["--program", &program]).contains("2 done already, 1 submitted"));
        self.wait_for("f.farm", 0);
        self.tracer(&["render", "scene.ron", "-q", "-o", "g.exr"], 0);
        assert_eq!(self.read("f.exr"), self.read("g.exr"));
    }

    /// So many samples as take one core so long.
    fn samples_of_seconds(&self, seconds: f64) -> u32 {
        let start = Instant::now();
        self.tracer(&["render", "scene.ron", "-q", "-j", "1", "-o", "s.exr", "--samples", "4000"], 0);
        (4000.0 * seconds / start.elapsed().as_secs_f64()) as u32
    }

    fn nothing_is_lost(&mut self, of_part: u32, meanwhile: impl FnOnce(&Self)) {
        let samples = (2 * of_part).to_string();
        let more = ["--samples", &samples];
        self.slurm("n.exr", "2", &more);
        // The node of the first part dies.
        let (node, before) = self.wait_for_samples("n.farm", 1, 0);
        self.cluster.kill_node(&node);
        // The second part's limit is near: Slurm sends this to the script alone.
        self.wait_for_samples("n.farm", 2, 0);
        let job = self.status("n.farm").1["arrays"][0].as_str().expect("a job").to_owned();
        let task = |part: u32| format!("{job}_{part}");
        self.cluster.run("scancel", &["--signal=USR1", "--batch", &task(2)]);
        self.cluster.wait("part 2 in the queue", || self.status("n.farm").1["parts"][1]["state"] == "waiting");
        let held = self.status("n.farm").1["parts"][1]["samples"][0].as_u64().expect("samples");
        assert!(held > 0 && !self.cluster.path("work/n.farm/state/2.failed").exists());
        let one = ["render", "scene.ron", "-q", "-o", "m.exr", "--samples", &samples];
        let mut one = self.cluster.command(TRACER, &one).spawn().expect("the program starts");
        meanwhile(self);
        // Slurm gives the node up after some seconds, and the part goes to the queue; then the node is back.
        self.cluster.wait("part 1 in the queue", || self.status("n.farm").1["parts"][0]["state"] == "waiting");
        self.cluster.start_node(&node);
        // Both go on where they were.
        let (_, now) = self.wait_for_samples("n.farm", 1, before);
        assert!(now > before);
        // SIGTERM to the script and the program at once, as at a preemption.
        self.cluster.run("scancel", &["--signal=TERM", "--full", &task(1)]);
        self.cluster.wait("part 1 stopped", || self.status("n.farm").1["parts"][0]["state"] == "stopped");
        let kept = self.status("n.farm").1["parts"][0]["samples"][0].as_u64().expect("samples");
        assert!(kept >= now, "{kept} of {now}");
        self.slurm("n.exr", "2", &more);
        self.wait_for("n.farm", 0);
        for part in [1, 2] {
            let log = self.text(&format!("n.farm/logs/part-{part}.log"));
            assert_eq!(log.matches("the rendering begins anew").count(), 1, "{log}");
        }
        let log = self.text("n.farm/logs/part-1.log");
        assert!(log.contains("started again 1 times by Slurm") && log.contains("ended by SIGTERM"), "{log}");
        assert!(one.wait().expect("it ends").success());
        assert_eq!(self.read("n.exr"), self.read("m.exr"));
    }

    fn cancelled(&self) {
        let more = ["--samples", "100M"];
        self.slurm("c.exr", "3", &more);
        self.wait_for_samples("c.farm", 1, 0);
        let said = self.tracer(&["farm", "cancel", "c.farm"], 0);
        assert!(said.contains("0 of 3 parts are done, all films are kept"), "{said}");
        let is_stopped = |told: &Value| told["parts"][0]["state"] == "stopped" && told["merge"]["state"] == "stopped";
        self.cluster.wait("nothing of it in the queue", || is_stopped(&self.status("c.farm").1));
        let told = self.wait_for("c.farm", 1);
        assert_eq!((&told["parts"][0]["state"], &told["merge"]["state"]), (&"stopped".into(), &"stopped".into()));
        let held = told["parts"][0]["samples"][0].as_u64().expect("samples");
        assert!(self.slurm("c.exr", "3", &more).contains("of 3 parts 3 submitted"));
        self.wait_for_samples("c.farm", 1, held);
        self.tracer(&["farm", "cancel", "c.farm"], 0);
        self.wait_for("c.farm", 1);
    }
}
