//! What is told of a run, read again by parsers of XML, JSON and of the page.

use std::path::PathBuf;
use tracer_golden::noise::Finding;
use tracer_golden::outcome::{Flip, Outcome, Verdict};
use tracer_golden::outputs::{github, html, json, junit, lines};
use tracer_golden::picture::Rgb8;

fn picture(shift: u8) -> Rgb8 {
    let rgb = (0..12 * 8 * 3u32).map(|k| (k % 200) as u8 + shift * u8::from(k % 7 == 0)).collect();
    Rgb8 { width: 12, height: 8, rgb }
}

fn outcome(name: &str, verdict: Verdict) -> Outcome {
    let compared = matches!(verdict, Verdict::Different { .. } | Verdict::WithinNoise { .. });
    let flip = Flip { mean: 0.0125, max: 0.5, map: picture(9) };
    Outcome {
        folder: "golden".to_owned(),
        name: name.to_owned(),
        file: PathBuf::from(format!("golden/{name}.ron")),
        scene: "Scene(objects: []) // 1 < 2 & 3 </pre>\n".to_owned(),
        expected: (compared || verdict == Verdict::Equal).then(|| picture(0)),
        actual: (!matches!(verdict, Verdict::Wrong { .. } | Verdict::Orphan)).then(|| picture(40)),
        flip: compared.then_some(flip),
        verdict,
        seconds: 0.25,
    }
}

/// One of each kind, with what XML, HTML and workflow commands must not take for their own.
fn outcomes() -> Vec<Outcome> {
    let finding =
        Finding { what: "pixel (3, 4) is <far> out & \"bright\"".to_owned(), region: [3, 4, 1, 1], probability: 1e-9 };
    let different = Verdict::Different { why: "5 pixels differ".to_owned(), findings: vec![finding] };
    vec![
        outcome("equal", Verdict::Equal),
        outcome("noise", Verdict::WithinNoise { probability: 0.25 }),
        outcome("a/different, 100%", different),
        outcome("missing", Verdict::Missing),
        outcome("orphan", Verdict::Orphan),
        outcome("wrong", Verdict::Wrong { what: "error[E0201]: <here>\n  | \u{1b}[1mcaret\r\n".to_owned() }),
    ]
}

#[test]
fn junit_is_xml_with_the_right_counts() {
    let xml = junit::report(&outcomes());
    let tree = roxmltree::Document::parse(&xml).unwrap_or_else(|error| panic!("{error}\n{xml}"));
    let suites = tree.root_element();
    let number = |name: &str| suites.attribute(name).expect("an attribute").to_owned();
    assert_eq!([number("tests"), number("failures"), number("errors"), number("time")], ["6", "3", "1", "1.500"]);
    let cases: Vec<_> = tree.descendants().filter(|node| node.has_tag_name("testcase")).collect();
    assert_eq!(cases.len(), 6);
    assert_eq!(cases.iter().filter(|case| case.children().any(|n| n.has_tag_name("failure"))).count(), 3);
    let failure = tree.descendants().find(|node| node.has_tag_name("failure")).expect("a failure");
    assert_eq!(failure.attribute("type"), Some("different"));
    assert!(failure.text().expect("text").contains("pixel (3, 4) is <far> out & \"bright\""));
    let error = tree.descendants().find(|node| node.has_tag_name("error")).expect("an error");
    assert!(error.text().expect("text").contains("error[E0201]: <here>\n  | \u{fffd}[1mcaret"), "{xml}");
}

#[test]
fn json_has_every_scene() {
    let text = json::report(&outcomes()).expect("JSON");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!((&report["golden_version"], &report["passed"], &report["failed"]), (&1.into(), &2.into(), &4.into()));
    let scene = &report["scenes"][2];
    assert_eq!(scene["verdict"], "different");
    assert_eq!(scene["findings"][0]["region"], serde_json::json!([3, 4, 1, 1]));
    assert_eq!((scene["flip_mean"].as_f64(), scene["probability"].as_f64()), (Some(0.0125), Some(1e-9)));
    assert_eq!(report["scenes"][1]["verdict"], "within_noise");
}

#[test]
fn annotations_are_single_lines() {
    let text = github::annotations(&outcomes());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "{text}");
    assert_eq!(
        lines[0].split_once("::5 pixels differ").map(|(head, _)| head),
        Some("::error file=golden/a/different%2C 100%25.ron,title=golden golden/a/different%2C 100%25")
    );
    assert!(lines[3].contains("error[E0201]: <here>%0A"), "{text}");
}

#[test]
fn a_line_each() {
    let all = outcomes();
    assert_eq!(lines::line(&all[0]), "ok    golden/equal: equal (0.25 s)\n");
    assert!(lines::line(&all[1]).contains("within the noise of both pictures (p = 0.25); FLIP mean 0.0125"));
    let different = lines::line(&all[2]);
    assert!(different.starts_with("FAIL  golden/a/different, 100%: 5 pixels differ; pixel (3, 4)"), "{different}");
    assert!(different.contains("tracer golden accept golden 'a/different, 100%' --reason"), "{different}");
    assert!(lines::line(&all[5]).contains("\n        | "), "{:?}", lines::line(&all[5]));
    assert_eq!(lines::summary(&all), "2 passed (1 within noise), 4 failed\n");
}

/// The page holds all that it needs, says what a person does next, and is well-formed: read as XML but for what HTML
/// writes otherwise.
#[test]
fn the_page_is_whole() {
    let html = html::page(&outcomes(), &|x| [(x * 255.0) as u8; 3]).expect("a page");
    let body =
        html.split_once("<body>").and_then(|(_, rest)| rest.split_once("<script>")).expect("a body and a script").0;
    let mut xml = format!("<body>{body}</body>");
    for void in ["<img ", "<input "] {
        let closed: Vec<String> = xml
            .split(void)
            .enumerate()
            .map(|(k, part)| if k == 0 { part.to_owned() } else { part.replacen('>', "/>", 1) })
            .collect();
        xml = closed.join(void);
    }
    let tree = roxmltree::Document::parse(&xml).unwrap_or_else(|error| panic!("{error}\n{xml}"));
    let all = |name: &'static str| tree.descendants().filter(move |node| node.has_tag_name(name));
    assert_eq!((all("h1").count(), all("h2").count(), all("section").count()), (1, 5, 5));
    // Expected, actual, the wipe's two, difference and FLIP, of two scenes; the missing one's alone.
    assert_eq!(all("img").count(), 2 * 6 + 1);
    for image in all("img") {
        assert!(image.attribute("src").is_some_and(|src| src.starts_with("data:image/png;base64,iVBORw0KGgo")));
        assert!(image.attribute("alt").is_some_and(|alt| !alt.is_empty()));
    }
    assert_eq!(all("input").count(), 2);
    assert!(all("input").all(|input| input.attribute("aria-label").is_some_and(|label| label.contains("wipe"))));
    // Every link leads to a place in the page.
    let ids: Vec<&str> = tree.descendants().filter_map(|node| node.attribute("id")).collect();
    assert_eq!(all("a").count(), 5);
    assert!(all("a").all(|a| a.attribute("href").is_some_and(|href| ids.contains(&href.trim_start_matches('#')))));
    let command = all("pre").filter_map(|pre| pre.text()).find(|text| text.starts_with("tracer golden accept"));
    assert_eq!(command, Some("tracer golden accept golden 'a/different, 100%' --reason \"why it changed\""));
    assert!(all("pre").any(|pre| pre.text().is_some_and(|text| text.contains("1 < 2 & 3 </pre>"))));
    // Nothing is asked of anybody.
    assert!(!html.contains("http://") && !html.contains("https://") && html.contains("default-src 'none'"));
}
