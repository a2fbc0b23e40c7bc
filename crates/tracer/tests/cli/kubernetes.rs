//! The manifests of docs/scale.md: they are read, have no field but those of `batch/v1` and `v1`, obey the rules that
//! its server has for them, and their commands make the picture.

use crate::support::{Sandbox, repository};
use serde::Deserialize;
use std::collections::BTreeMap;

/// `batch/v1`, as far as the manual uses it; a field of another name is a fault.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Job {
    api_version: String,
    kind: String,
    metadata: Metadata,
    spec: JobSpec,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Metadata {
    name: String,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct JobSpec {
    completion_mode: Option<String>,
    completions: Option<u32>,
    parallelism: Option<u32>,
    backoff_limit: Option<u32>,
    backoff_limit_per_index: Option<u32>,
    pod_replacement_policy: Option<String>,
    pod_failure_policy: Option<PodFailurePolicy>,
    template: PodTemplate,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PodFailurePolicy {
    rules: Vec<Rule>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Rule {
    action: String,
    on_pod_conditions: Vec<Condition>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Condition {
    r#type: String,
    status: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PodTemplate {
    spec: PodSpec,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct PodSpec {
    restart_policy: String,
    termination_grace_period_seconds: Option<u32>,
    containers: Vec<Container>,
    volumes: Vec<Volume>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Container {
    name: String,
    image: String,
    working_dir: String,
    command: Vec<String>,
    resources: Resources,
    volume_mounts: Vec<Mount>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Resources {
    requests: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Mount {
    name: String,
    mount_path: String,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Volume {
    name: String,
    persistent_volume_claim: Claim,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Claim {
    claim_name: String,
}

/// The first block of a kind after a heading.
fn block(heading: &str, kind: &str) -> String {
    let manual = std::fs::read_to_string(repository().join("docs/scale.md")).expect("the manual");
    let (_, rest) = manual.split_once(heading).unwrap_or_else(|| panic!("{heading} is not in docs/scale.md"));
    let (_, rest) = rest.split_once(&format!("```{kind}\n")).expect("a block");
    rest.split_once("```").expect("its end").0.to_owned()
}

fn job(heading: &str) -> Job {
    let job: Job = serde_saphyr::from_str(&block(heading, "yaml")).unwrap_or_else(|error| panic!("{heading}: {error}"));
    assert_eq!((job.api_version.as_str(), job.kind.as_str()), ("batch/v1", "Job"));
    let pod = &job.spec.template.spec;
    // What a Job's pods may have: they are not started again for ever.
    assert!(["Never", "OnFailure"].contains(&pod.restart_policy.as_str()));
    for container in &pod.containers {
        assert!(!container.name.is_empty() && container.image.contains('/'));
        for mount in &container.volume_mounts {
            let volume = pod.volumes.iter().find(|volume| volume.name == mount.name).expect("a volume of that name");
            assert!(mount.mount_path.starts_with('/') && !volume.persistent_volume_claim.claim_name.is_empty());
            assert_eq!(mount.mount_path, container.working_dir);
        }
        assert!(container.resources.requests.keys().all(|name| ["cpu", "memory"].contains(&name.as_str())));
    }
    // DNS labels.
    assert!(job.metadata.name.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'-'));
    job
}

#[test]
fn the_manifests_of_the_manual_make_the_picture() {
    let (parts, merge) = (job("### `parts.yaml`"), job("### `merge.yaml`"));
    let spec = &parts.spec;
    assert_eq!(
        (spec.completion_mode.as_deref(), spec.completions, spec.parallelism),
        (Some("Indexed"), Some(16), Some(16))
    );
    // The server's rules: a limit for each index is for indexed Jobs whose pods are never started again in place, as is
    // a policy for failures, with which pods are replaced when they have failed.
    assert!(spec.backoff_limit_per_index == Some(3) && spec.backoff_limit.is_none());
    assert_eq!(spec.template.spec.restart_policy, "Never");
    assert_eq!(spec.pod_replacement_policy.as_deref(), Some("Failed"));
    let rules = &spec.pod_failure_policy.as_ref().expect("a policy").rules;
    let rules: Vec<_> = rules.iter().map(|rule| (rule.action.as_str(), &rule.on_pod_conditions)).collect();
    let [("Ignore", conditions)] = rules[..] else { panic!("another rule") };
    assert!(conditions.iter().all(|of| of.r#type == "DisruptionTarget" && of.status == "True"));
    assert!(spec.template.spec.termination_grace_period_seconds > Some(30));
    assert!(merge.spec.backoff_limit > Some(0) && merge.spec.completions.is_none());

    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("bin")).expect("a folder");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_tracer"), sandbox.path("bin/tracer")).expect("a link");
    sandbox.write("scene.ron", sandbox.text("scene.ron").replace("samples: 2", "samples: 16"));
    sandbox.write("part.sh", block("### The task", "sh"));
    sandbox.run(&["render", "scene.ron", "-q", "-o", "one.exr"]).ends(0);
    let path = format!("{}:{}", sandbox.path("bin").display(), std::env::var("PATH").unwrap_or_default());
    let run = |job: &Job, index: u32| {
        let [container] = &job.spec.template.spec.containers[..] else { panic!("one container") };
        let mut command = std::process::Command::new(&container.command[0]);
        command.args(&container.command[1..]).current_dir(sandbox.path("")).env("PATH", &path);
        let status = command.env("JOB_COMPLETION_INDEX", index.to_string()).status().expect("a shell");
        assert!(status.success(), "{} {index}: {status}", job.metadata.name);
    };
    (0..16).for_each(|index| run(&parts, index));
    run(&merge, 0);
    assert_eq!(sandbox.read("scene.exr"), sandbox.read("one.exr"));
}
