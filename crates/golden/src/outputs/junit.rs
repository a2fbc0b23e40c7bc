//! The run as the XML that CI servers read, in the form of Jenkins' JUnit plugin.

use super::whole;
use crate::outcome::{Outcome, Verdict};

/// Text of an element or an attribute; what XML 1.0 has no place for becomes U+FFFD.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\t' => out.push('\t'),
            '\r' | '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A suite for each folder, a case for each scene.
pub fn report(outcomes: &[Outcome]) -> String {
    let count = |of: &[&Outcome], errors: bool| {
        let failed = of.iter().filter(|outcome| !outcome.verdict.passes());
        failed.filter(|outcome| matches!(outcome.verdict, Verdict::Wrong { .. }) == errors).count()
    };
    let seconds = |of: &[&Outcome]| of.iter().map(|outcome| outcome.seconds).sum::<f64>();
    let all: Vec<&Outcome> = outcomes.iter().collect();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tracer golden\" tests=\"{}\" \
            failures=\"{}\" errors=\"{}\" time=\"{:.3}\">\n",
        all.len(),
        count(&all, false),
        count(&all, true),
        seconds(&all)
    );
    let mut folders: Vec<&str> = Vec::new();
    outcomes.iter().for_each(|outcome| {
        if !folders.contains(&outcome.folder.as_str()) {
            folders.push(&outcome.folder);
        }
    });
    for folder in folders {
        let of: Vec<&Outcome> = outcomes.iter().filter(|outcome| outcome.folder == folder).collect();
        xml += &format!(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3}\">\n",
            escaped(folder),
            of.len(),
            count(&of, false),
            count(&of, true),
            seconds(&of)
        );
        of.iter().for_each(|outcome| xml += &case(outcome));
        xml += "  </testsuite>\n";
    }
    xml + "</testsuites>\n"
}

fn case(outcome: &Outcome) -> String {
    let Outcome { folder, name, seconds, file, .. } = outcome;
    let head = format!(
        "    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" time=\"{seconds:.3}\"",
        escaped(folder),
        escaped(name),
        escaped(&file.display().to_string())
    );
    let element = match &outcome.verdict {
        Verdict::Equal => return format!("{head}/>\n"),
        verdict if verdict.passes() => {
            return format!("{head}><system-out>{}</system-out></testcase>\n", escaped(&outcome.sentence()));
        }
        Verdict::Wrong { .. } => "error",
        _ => "failure",
    };
    let (kind, message) = (outcome.verdict.word(), escaped(&outcome.sentence()));
    format!(
        "{head}>\n      <{element} type=\"{kind}\" message=\"{message}\">{}</{element}>\n    </testcase>\n",
        escaped(&whole(outcome))
    )
}
