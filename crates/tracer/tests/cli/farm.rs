//! `tracer farm`, with programs in the place of Slurm's that keep what they are told. `cargo xtask prove slurm` does it
//! with Slurm itself.

use crate::support::{Ran, Sandbox};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// A name that a shell and Slurm would take apart.
const ODD: &str = "it's \"odd\" %j $HOME";

/// A folder with Slurm's programs: `sbatch` numbers its calls and keeps their words, a line each, `squeue` prints what
/// stands in `queue`.
struct Cluster(Sandbox);

impl Cluster {
    fn new() -> Self {
        let sandbox = Sandbox::new();
        fs::create_dir_all(sandbox.path("bin")).expect("a folder");
        fs::create_dir_all(sandbox.path(ODD)).expect("a folder");
        let cluster = Cluster(sandbox);
        cluster.program(
            "sbatch",
            "n=$(($(cat \"$HERE/last\" 2>/dev/null || echo 0) + 1)); echo $n >\"$HERE/last\"\n\
             printf '%s\\n' \"$@\" >\"$HERE/sbatch.$n\"; echo \"$n;a-cluster\"",
        );
        cluster.program(
            "squeue",
            "printf '%s\\n' \"$@\" >\"$HERE/squeue\"; \n\
             case \"$*\" in *%Z*) cat \"$HERE/workdir\" 2>/dev/null;; *) cat \"$HERE/queue\" 2>/dev/null;; esac; true",
        );
        cluster.program(
            "scontrol",
            // As Slurm does, it ends the whole job for a requeue, scontrol and script alike.
            "echo \"$@\" >>\"$HERE/scontrol\"\n\
             case $1 in show) echo 'MaxArraySize = 101';; requeue) kill -TERM $PPID $$;; esac",
        );
        cluster.program("scancel", "echo \"$@\" >>\"$HERE/scancel\"");
        cluster
    }

    fn program(&self, name: &str, body: &str) {
        let here = self.0.path("");
        let name = format!("bin/{name}");
        self.0.write(&name, format!("#!/bin/sh\nHERE='{}'\n{body}\n", here.display()));
        fs::set_permissions(self.0.path(&name), fs::Permissions::from_mode(0o755)).expect("ours");
    }

    fn path(&self) -> String {
        format!("{}:{}", self.0.path("bin").display(), std::env::var("PATH").unwrap_or_default())
    }

    fn farm(&self, arguments: &[&str]) -> Ran {
        let mut command = self.0.command(&[&["farm"], arguments].concat());
        Ran::of(command.env("PATH", self.path()))
    }

    /// Three parts of the scene in a folder of an odd name.
    fn slurm(&self, more: &[&str]) -> Ran {
        let picture = format!("{ODD}/a.exr");
        self.farm(&[&["slurm", "scene.ron", "-o", &picture, "--parts", "3", "--samples", "6"], more].concat())
    }

    fn folder(&self) -> String {
        format!("{ODD}/a.farm")
    }

    /// Starts a script as Slurm does.
    fn start(&self, script: &str, task: u32) -> Child {
        let mut command = std::process::Command::new("sh");
        command.arg(self.0.path(&self.folder()).join(script)).env("PATH", self.path()).current_dir("/");
        command.env("SLURM_ARRAY_TASK_ID", task.to_string()).env("SLURM_ARRAY_JOB_ID", "7").env("SLURM_JOB_ID", "8");
        command.env("SLURMD_NODENAME", "n1").env("SLURM_CPUS_ON_NODE", "1");
        let name = if script == "merge.sh" { "merge".to_owned() } else { format!("part-{task}") };
        let log = self.0.path(&self.folder()).join(format!("logs/{name}.log"));
        let log = fs::OpenOptions::new().create(true).append(true).open(log).expect("a log");
        command.stdin(Stdio::null()).stdout(log.try_clone().expect("a handle")).stderr(log);
        command.spawn().expect("a shell")
    }

    #[track_caller]
    fn script(&self, script: &str, task: u32, code: i32) {
        assert_eq!(self.start(script, task).wait().expect("it ends").code(), Some(code), "{}", self.log(task));
    }

    fn log(&self, task: u32) -> String {
        self.0.text(&format!("{}/logs/part-{task}.log", self.folder()))
    }

    fn words(&self, call: u32) -> Vec<String> {
        self.0.text(&format!("sbatch.{call}")).lines().map(str::to_owned).collect()
    }

    fn has(&self, name: &str) -> bool {
        self.0.path(&self.folder()).join(name).exists()
    }

    fn wait_for(&self, name: &str) -> PathBuf {
        let path = self.0.path(&self.folder()).join(name);
        let start = Instant::now();
        while !path.exists() {
            assert!(start.elapsed() < Duration::from_secs(60), "{} does not come", path.display());
            std::thread::sleep(Duration::from_millis(10));
        }
        path
    }
}

fn send(signal: &str, child: &Child) {
    let line = format!("kill -{signal} {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &line]).status().expect("a shell").success());
}

#[test]
fn parts_and_merge_make_the_picture_of_one_machine() {
    let cluster = Cluster::new();
    cluster.0.run(&["render", "scene.ron", "-q", "-o", "one.exr", "--samples", "6"]).ends(0);
    let more = ["--time-limit", "2h", "--partition", "p", "--sbatch-arg=--mem=1 G", "-j", "2", "--every", "5s"];
    let ran = cluster.slurm(&more).ends(0);
    ran.says(&["of 3 parts 3 submitted as job 1; job 2 merges them", "tracer farm status 'it'\\''s \"odd\" %j $HOME/"]);
    let folder = cluster.0.path(&cluster.folder()).display().to_string();
    let words = cluster.words(1);
    for word in
        ["--array=1-3", "--requeue", "--open-mode=append", "--signal=B:USR1@60", "--time=0-02:00:00", "--mem=1 G"]
    {
        assert!(words.iter().any(|found| found == word), "{word}: {words:?}");
    }
    let log = format!("--output={}/logs/part-%a.log", folder.replace('%', "%%"));
    assert!(words.contains(&log) && words.contains(&format!("--chdir={folder}")), "{words:?}");
    assert!(words.contains(&"--partition=p".to_owned()) && words.contains(&"--cpus-per-task=2".to_owned()));
    assert_eq!(words.last(), Some(&format!("{folder}/part.sh")));
    let words = cluster.words(2);
    assert!(words.contains(&"--dependency=afterany:1".to_owned()), "{words:?}");
    assert_eq!(words.last(), Some(&format!("{folder}/merge.sh")));

    cluster.0.write(
        "queue",
        "1|1|RUNNING|n1|0:07|None\n1|2|PENDING||0:00|Priority\n1|3|PENDING||0:00|Priority\n\
         2|N/A|PENDING||0:00|Dependency\n",
    );
    let told = cluster.farm(&["status", &cluster.folder()]).ends(3).out_text();
    for line in [
        "1           running",
        "on n1 for 0:07",
        "2-3         waiting",
        "Priority",
        "Dependency",
        "1 running, 2 waiting; 0 %",
    ] {
        assert!(told.contains(line), "{line}:\n{told}");
    }
    assert!(cluster.0.text("squeue").contains("--jobs=1,2"));
    (1..=3).for_each(|task| cluster.script("part.sh", task, 0));
    cluster.0.write("queue", "2|N/A|RUNNING|n1|0:01|None\n");
    cluster.0.write("workdir", format!("{folder}\n"));
    let told = cluster.farm(&["status", "2"]).ends(3).out_text();
    assert!(
        told.contains("1-3         done") && told.contains("merge       running") && told.contains("100 %"),
        "{told}"
    );
    cluster.script("merge.sh", 0, 0);
    assert_eq!(cluster.0.read(&format!("{ODD}/a.exr")), cluster.0.read("one.exr"));
    let told = cluster.farm(&["status", "1_2", "--json"]).ends(0).out_text();
    let json: Value = serde_json::from_str(&told).expect("JSON");
    assert_eq!((&json["parts"][2]["state"], &json["merge"]["state"]), (&"done".into(), &"done".into()));
    assert_eq!(json["parts"][1]["samples"], serde_json::json!([2, 2]));
    // The same line again has nothing to do, but where the picture is gone.
    cluster.0.write("queue", "");
    cluster.slurm(&["-j", "9"]).ends(0).says(&["all 3 parts are done and merged"]);
    assert_eq!(cluster.0.text("last"), "2\n");
    fs::remove_file(cluster.0.path(&format!("{ODD}/a.exr"))).expect("a file");
    cluster.slurm(&[]).ends(0).says(&["of 3 parts 3 done already; job 3 merges them"]);
    assert!(!cluster.words(3).iter().any(|word| word.starts_with("--dependency")));
    cluster.script("merge.sh", 0, 0);
    assert_eq!(cluster.0.read(&format!("{ODD}/a.exr")), cluster.0.read("one.exr"));
}

#[test]
fn a_dry_run_prints_the_scripts_and_submits_nothing() {
    let cluster = Cluster::new();
    // Where no Slurm is, too.
    let mut command = cluster.0.command(&["farm", "slurm", "scene.ron", "-o", "a b.png", "--parts", "2", "--dry-run"]);
    let told = Ran::of(command.env("PATH", "/nowhere")).ends(0).silent().out_text();
    for words in [
        "a b.farm/part.sh\n#!/bin/sh",
        "merge \"$folder\"/parts/*of\"$parts\".tracer -o 'a b.png'",
        "\nsbatch --parsable",
    ] {
        assert!(told.contains(words), "{words}:\n{told}");
    }
    assert!(told.contains("--array=1-2") && told.contains("--dependency=afterany:JOB"), "{told}");
    assert_eq!(cluster.0.files(), ["bin", ODD, "scene.ron"]);
    let mut command = cluster.0.command(&["farm", "slurm", "scene.ron", "-o", "a.png", "--parts", "2"]);
    Ran::of(command.env("PATH", "/nowhere")).ends(1).says(&["there is no scontrol here", "--dry-run", "docs/scale.md"]);
    assert_eq!(cluster.0.files(), ["bin", ODD, "scene.ron"]);
}

/// A farm for each frame, each with parts and a merge of its own; the pictures are those of one machine.
#[test]
fn frames_are_farms() {
    let cluster = Cluster::new();
    let sandbox = &cluster.0;
    let moving = crate::support::SCENE.replace("center: (1, 1, 0)", "center: (\"=1+frame\", 1, 0)");
    sandbox.write("film.ron", moving.replace("    camera:", "    animation: Animation(frames: 4),\n    camera:"));
    let line = ["slurm", "film.ron", "-o", "shot_####.png", "--parts", "2", "--frames", "1-2"];
    let dry = cluster.farm(&[&line[..], &["--dry-run"]].concat()).ends(0).out_text();
    for word in ["shot_0001.farm/part.sh", "shot_0002.farm/merge.sh", "--frame 1 ", "--frame 2 ", "-o shot_0002.png"] {
        assert!(dry.contains(word), "{word} is not in:\n{dry}");
    }
    assert!(!cluster.has("last") && !cluster.has("shot_0001.farm") && !dry.contains("##"), "{dry}");
    cluster.farm(&line).ends(0).says(&["shot_0001.farm: of 2 parts", "shot_0002.farm: of 2 parts"]);
    assert_eq!(sandbox.text("last").trim(), "4", "an array and a merge for each frame");
    let all = ["status", "shot_0001.farm", "shot_0002.farm"];
    cluster.farm(&all).ends(1);
    let run = |frame: u32, script: &str, task: u32| {
        let script = sandbox.path(&format!("shot_000{frame}.farm/{script}"));
        let mut command = std::process::Command::new("sh");
        command.arg(script).env("PATH", cluster.path()).current_dir("/").env("SLURM_ARRAY_TASK_ID", task.to_string());
        command.env("SLURM_ARRAY_JOB_ID", "7").env("SLURM_JOB_ID", "8").env("SLURM_CPUS_ON_NODE", "1");
        Ran::of(&mut command).ends(0);
    };
    for frame in 1..=2 {
        run(frame, "part.sh", 1);
        run(frame, "part.sh", 2);
        run(frame, "merge.sh", 0);
        sandbox.run(&["render", "film.ron", "--frame", &frame.to_string(), "-o", "one.png"]).ends(0);
        assert_eq!(sandbox.read(&format!("shot_000{frame}.png")), sandbox.read("one.png"), "frame {frame}");
    }
    let status = cluster.farm(&all).ends(0).out_text();
    assert!(status.contains("shot_0001.farm") && status.contains("shot_0002.farm"), "{status}");
    let json = cluster.farm(&[&all[..], &["--json"]].concat()).ends(0).out_text();
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json.as_array().map(Vec::len), Some(2));
    cluster.farm(&["cancel", "shot_0001.farm", "shot_0002.farm"]).ends(0).says(&["no job of it waits or runs"]);
    // The same line goes on: nothing is left to do.
    cluster.farm(&line).ends(0).says(&["shot_0001.farm: all 2 parts are done", "shot_0002.farm: all 2 parts are done"]);
    assert_eq!(sandbox.text("last").trim(), "4");
    // Before anything is submitted.
    cluster
        .farm(&["slurm", "film.ron", "-o", "shot.png", "--parts", "2", "--frames", "1-2"])
        .ends(2)
        .says(&["put ####"]);
    let more = ["--folder", "all.farm"];
    cluster.farm(&[&line[..], &more].concat()).ends(2).says(&["put ####", "all.farm"]);
    cluster.farm(&[&line[..], &["--frame", "1"]].concat()).ends(2);
    cluster
        .farm(&["slurm", "film.ron", "-o", "f_####.png", "--parts", "2", "--frame", "3"])
        .ends(0)
        .says(&["f_0003.farm"]);
}

#[test]
fn a_part_that_fails_is_tried_again_and_named() {
    let cluster = Cluster::new();
    let tracer = env!("CARGO_BIN_EXE_tracer");
    // Part 1 fails at first, part 2 always.
    cluster.program(
        "flaky",
        &format!(
            "case \"$*\" in *'--part 2/3'*) echo 'error: no luck' >&2; exit 5;; *'--part 1/3'*)\n\
             [ -f \"$HERE/once\" ] || {{ : >\"$HERE/once\"; exit 9; }};; esac\nexec '{tracer}' \"$@\""
        ),
    );
    let program = cluster.0.path("bin/flaky").display().to_string();
    let more = ["--program", &program, "--pause", "10ms", "--retries", "2"];
    cluster.slurm(&more).ends(0);
    cluster.script("part.sh", 1, 0);
    assert!(cluster.log(1).contains("exit code 9; started again in 0.01 s"), "{}", cluster.log(1));
    cluster.script("part.sh", 2, 1);
    assert_eq!(cluster.log(2).matches("error: no luck").count(), 3);
    cluster.0.write("queue", "1|3|PENDING||0:00|Priority\n2|N/A|PENDING||0:00|Dependency\n");
    let told = cluster.farm(&["status", &cluster.folder()]).ends(1).out_text();
    for words in [
        "1           done",
        "failed",
        "exit code 5, 3 times on n1",
        "| error: no luck",
        "go on with what is missing: cd ",
    ] {
        assert!(told.contains(words), "{words}:\n{told}");
    }
    cluster.script("part.sh", 3, 0);
    cluster.script("merge.sh", 0, 1);
    cluster.0.write("queue", "");
    let told = cluster.farm(&["status", &cluster.folder()]).ends(1).out_text();
    assert!(
        told.contains("merge       failed") && told.contains("not merged, for these parts are not done: 2"),
        "{told}"
    );
    // The line that it names goes on with the one part.
    cluster.program("flaky", &format!("exec '{tracer}' \"$@\""));
    let (_, line) = told.split_once("what is missing: ").expect("a line");
    let line = line.replace("&& tracer", &format!("&& '{tracer}'"));
    let mut shell = std::process::Command::new("sh");
    Ran::of(shell.args(["-c", &line]).env("PATH", cluster.path()))
        .ends(0)
        .says(&["2 done already, 1 submitted as job 3"]);
    assert!(cluster.words(3).contains(&"--array=2".to_owned()));
    cluster.script("part.sh", 2, 0);
    cluster.script("merge.sh", 0, 0);
    cluster.farm(&["status", &cluster.folder()]).ends(0);
}

/// The samples that a part's film has.
fn held(cluster: &Cluster, film: &str) -> u64 {
    let told = cluster.0.run(&["info", &format!("{}/{film}", cluster.folder()), "--json"]).ends(0).out_text();
    serde_json::from_str::<Value>(&told).expect("JSON")["samples_min"].as_u64().expect("a number")
}

#[test]
fn signals_lose_nothing() {
    let cluster = Cluster::new();
    let picture = format!("{ODD}/a.exr");
    let arguments = ["slurm", "scene.ron", "-o", &picture, "--parts", "3", "--samples", "3M", "--every", "100ms"];
    cluster.farm(&[&arguments[..], &["--pause", "10ms"]].concat()).ends(0);
    let film = "parts/1of3.tracer";
    // As Slurm before the limit, to the shell alone: the part goes to the queue again.
    let mut child = cluster.start("part.sh", 1);
    cluster.wait_for(film);
    send("USR1", &child);
    assert_eq!(child.wait().expect("it ends").code(), Some(143), "{}", cluster.log(1));
    assert!(cluster.0.text("scontrol").contains("requeue 7_1"));
    let before = held(&cluster, film);
    assert!(before > 0 && !cluster.has("state/1.failed") && !cluster.has("state/1.tries"));
    // As at a preemption: nothing is queued by ourselves, and what was there is gone on with.
    let mut child = cluster.start("part.sh", 1);
    let start = Instant::now();
    while held(&cluster, film) == before {
        assert!(start.elapsed() < Duration::from_secs(60), "{}", cluster.log(1));
    }
    send("TERM", &child);
    assert_eq!(child.wait().expect("it ends").code(), Some(143), "{}", cluster.log(1));
    assert_eq!(cluster.0.text("scontrol").matches("requeue").count(), 1);
    assert!(held(&cluster, film) > before);
    assert!(cluster.log(1).contains("ended by SIGTERM; what was traced is kept"), "{}", cluster.log(1));
    let told = cluster.farm(&["status", &cluster.folder()]).ends(1).out_text();
    assert!(told.contains("1           stopped") && told.contains(" of 1000000 samples"), "{told}");
    // A limit in which nothing can be traced does not go round for ever.
    cluster.program("idle", "sleep 60 & wait");
    let program = cluster.0.path("bin/idle").display().to_string();
    cluster.farm(&[&arguments[..], &["--program", &program]].concat()).ends(0);
    let mut child = cluster.start("part.sh", 2);
    cluster.wait_for("state/2.began");
    std::thread::sleep(Duration::from_millis(300));
    send("USR1", &child);
    assert_eq!(child.wait().expect("it ends").code(), Some(1), "{}", cluster.log(2));
    assert_eq!(cluster.0.text("scontrol").matches("requeue").count(), 1);
    let told = cluster.farm(&["status", &cluster.folder()]).ends(1).out_text();
    assert!(told.contains("the time limit is too short to trace anything on n1"), "{told}");
}

#[test]
fn other_settings_are_refused_and_what_differs_is_named() {
    let cluster = Cluster::new();
    cluster.slurm(&[]).ends(0);
    let refused = |more: &[&str], says: &str| {
        cluster.slurm(more).ends(2).says(&["is of another rendering: ", says, "--folder"]);
    };
    refused(&["--seed", "4"], "the seed is 4 here".replace("4 here", "0 there and 4 here").as_str());
    refused(&["--size", "41x24"], "the size is 40x24 there and 41x24 here");
    refused(&["--set", "camera.fov=41"], "`camera` of the scene has changed");
    refused(&["--exposure", "1"], "the exposure is 0 there and 1 here");
    refused(&["--set", "output.backdrop=1"], "the backdrop is the background there and 1 1 1 here");
    refused(&["--denoise=on"], "--denoise is off there and on here");
    refused(&["--split", "rows", "--size", "40x96"], "--split is not told there and rows here");
    let folder = cluster.folder();
    let other = ["slurm", "scene.ron", "-o", "b.exr", "--parts", "4", "--samples", "6", "--folder", &folder];
    cluster.farm(&other).ends(2).says(&["the number of parts is 3 there and 4 here", "-o is "]);
    assert_eq!(cluster.0.text("last"), "2\n");
    // How it is done may change.
    cluster.0.write("queue", "1|1|RUNNING|n1|0:07|None\n1|2|PENDING||0:00|Priority\n2|N/A|PENDING||0:00|Dependency\n");
    let ran = cluster.slurm(&["--retries", "9", "--every", "2m", "--partition", "q"]).ends(0);
    ran.says(&["of 3 parts 1 running, 1 waiting, 1 submitted as job 3; job 4 merges them"]);
    // The merge comes after both arrays; the one before is cancelled.
    assert!(cluster.words(3).contains(&"--array=3".to_owned()));
    assert!(cluster.words(4).contains(&"--dependency=afterany:1:3".to_owned()));
    assert_eq!(cluster.0.text("scancel"), "2\n");
    cluster.0.write("queue", "1|1|RUNNING|n1|0:07|None\n3|3|PENDING||0:00|Priority\n4|N/A|PENDING||0:00|Dependency\n");
    cluster
        .farm(&["cancel", &folder])
        .ends(0)
        .says(&["cancelled jobs 1, 3, 4; 0 of 3 parts are done", "to go on: cd "]);
    assert_eq!(cluster.0.text("scancel"), "2\n4\n1 3\n");
    cluster.0.write("queue", "");
    cluster.farm(&["cancel", &folder]).ends(0).says(&["no job of it waits or runs"]);
}

#[test]
fn a_damaged_part_is_rendered_again() {
    let cluster = Cluster::new();
    cluster.slurm(&[]).ends(0);
    (1..=3).for_each(|task| cluster.script("part.sh", task, 0));
    let film = format!("{}/parts/2of3.tracer", cluster.folder());
    let mut bytes = cluster.0.read(&film);
    let at = bytes.len() - 50;
    bytes[at] ^= 1;
    cluster.0.write(&film, bytes);
    cluster.slurm(&[]).ends(0).says(&["2of3.tracer cannot be used: ", "2 done already, 1 submitted as job 3"]);
    assert!(cluster.words(3).contains(&"--array=2".to_owned()));
    cluster.script("part.sh", 2, 0);
    cluster.script("merge.sh", 0, 0);
}

#[test]
fn what_is_wrong_is_told_before_anything_is_submitted() {
    let cluster = Cluster::new();
    let wrong = |arguments: &[&str], says: &[&str]| {
        cluster.farm(&[&["slurm"], arguments].concat()).ends(2).says(says);
        assert!(!cluster.0.path("last").exists() && !cluster.0.path("a.farm").exists(), "{arguments:?}");
    };
    let of = |scene, more: &[&'static str]| [&[scene, "-o", "a.exr", "--parts", "2"], more].concat();
    wrong(&["scene.ron", "-o", "a.exr"], &["--parts"]);
    wrong(&["scene.ron", "--parts", "2"], &["--output"]);
    wrong(&of("none.ron", &[]), &["there is no scene file none.ron"]);
    wrong(&of("-", &[]), &["scene and picture cannot be -"]);
    wrong(&of("scene.ron", &["--set", "camera.fov=-1"]), &["camera"]);
    wrong(&of("scene.ron", &["--set", "render.noise=0.1"]), &["`render.noise` is a goal"]);
    wrong(&of("scene.ron", &["--time-limit", "4"]), &["is it minutes or seconds?"]);
    wrong(
        &of("scene.ron", &["--samples", "1", "--set", "image.height=8"]),
        &["--parts 2: there are 1 parts by samples"],
    );
    wrong(
        &["scene.ron", "-o", "a.exr", "--parts", "200", "--samples", "300"],
        &["--parts 200: the arrays of this cluster end at 100 (its MaxArraySize is 101)"],
    );
    wrong(&of("scene.ron", &["--folder", "back\\slash"]), &["backslash"]);
    wrong(&of("scene.ron", &["--folder", "bin"]), &["is there already and is no farm"]);
    cluster.farm(&["status", "a.exr"]).ends(2).says(&["there is no farm a.exr"]);
    cluster.farm(&["status", "bin"]).ends(2).says(&["bin is no farm: it has no farm.json"]);
    cluster.farm(&["cancel", "99"]).ends(2).says(&["there is no farm of job 99"]);
    cluster.program("sbatch", "echo 'sbatch: error: invalid partition specified: p' >&2; exit 1");
    cluster
        .farm(&["slurm", "scene.ron", "-o", "a.exr", "--parts", "2"])
        .ends(1)
        .says(&["sbatch fails: sbatch: error: invalid partition"]);
    // Of what was refused nothing is in the way.
    cluster.program("sbatch", "echo 5");
    cluster.farm(&["slurm", "scene.ron", "-o", "a.exr", "--parts", "2"]).ends(0).says(&["2 submitted as job 5"]);
}
