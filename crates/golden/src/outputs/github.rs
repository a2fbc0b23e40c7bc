//! Annotations of GitHub's Actions.

use super::whole;
use crate::outcome::Outcome;

/// A line for each failure, which the runner shows at the file.
pub fn annotations(outcomes: &[Outcome]) -> String {
    // As the runner decodes them.
    let escaped = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| escaped(text).replace(':', "%3A").replace(',', "%2C");
    let failed = outcomes.iter().filter(|outcome| !outcome.verdict.passes());
    let line = |outcome: &Outcome| {
        let (file, title) = (outcome.file.display().to_string(), format!("golden {}/{}", outcome.folder, outcome.name));
        format!("::error file={},title={}::{}\n", property(&file), property(&title), escaped(&whole(outcome)))
    };
    failed.map(line).collect()
}
