//! Opening a file at a line in the person's editor.

use std::path::Path;
use std::process::{Command, Stdio};

/// A command that opens a file at a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Editor {
    /// Program and arguments; `{file}`, `{line}` and `{column}` stand for the place.
    words: Vec<String>,
}

/// How editors with a window of their own are told a place. (Those of a terminal have none to open in.)
const KNOWN: [(&[&str], &[&str]); 9] = [
    (&["code", "codium", "cursor", "windsurf", "code-insiders"], &["--goto", "{file}:{line}:{column}"]),
    (&["zed", "zeditor", "subl", "sublime_text"], &["{file}:{line}:{column}"]),
    (&["emacsclient", "emacs"], &["+{line}:{column}", "{file}"]),
    (&["gvim", "mvim", "neovide", "nvim-qt"], &["+{line}", "{file}"]),
    (&["gedit", "gnome-text-editor", "pluma", "xed", "mousepad"], &["+{line}:{column}", "{file}"]),
    (&["kate", "kwrite"], &["--line", "{line}", "--column", "{column}", "{file}"]),
    (&["mate"], &["--line", "{line}:{column}", "{file}"]),
    (&["notepad++"], &["-n{line}", "-c{column}", "{file}"]),
    (&["idea", "pycharm", "clion", "rustrover"], &["--line", "{line}", "--column", "{column}", "{file}"]),
];

impl Editor {
    /// From a command line as a person writes it: `code`, `emacsclient -n`, `myeditor +{line} {file}`. An editor that
    /// is known by its name needs no `{file}`; another one is given the file alone.
    ///
    /// # Errors
    /// A command without a word, or with a quote that is never closed.
    pub fn new(command: &str) -> Result<Self, String> {
        let mut words = split(command)?;
        let Some(program) = words.first() else { return Err("the editor's command is empty".to_owned()) };
        if words.iter().all(|word| !word.contains("{file}")) {
            let form = known(program).unwrap_or(&["{file}"]);
            words.extend(form.iter().map(|&word| word.to_owned()));
        }
        Ok(Editor { words })
    }

    /// The editor that the environment names, where it is known to have a window of its own.
    pub fn from_environment() -> Option<Self> {
        ["TRACER_EDITOR", "VISUAL", "EDITOR"].into_iter().find_map(|name| {
            let command = std::env::var(name).ok()?;
            let program = split(&command).ok()?.into_iter().next()?;
            let is_meant = name == "TRACER_EDITOR" || known(&program).is_some();
            if is_meant { Editor::new(&command).ok() } else { None }
        })
    }

    /// Program and arguments for a place; a line of 0 is the first.
    fn arguments(&self, file: &Path, line: u64, column: u64) -> Vec<String> {
        let (line, column) = (line.max(1).to_string(), column.max(1).to_string());
        let file = file.display().to_string();
        // The file's name last: what stands in it is no place-holder.
        let filled =
            |word: &String| word.replace("{line}", &line).replace("{column}", &column).replace("{file}", &file);
        self.words.iter().map(filled).collect()
    }

    /// Opens a place. The editor goes on by itself.
    ///
    /// # Errors
    /// When the program does not start.
    pub fn open(&self, file: &Path, line: u64, column: u64) -> Result<(), String> {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        let arguments = self.arguments(&file, line, column);
        let mut command = Command::new(&arguments[0]);
        command.args(&arguments[1..]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().map_err(|error| format!("cannot start {}: {error}", arguments[0]))?;
        // Somebody has to wait for it, or it stays in the system's table when it has ended.
        let waits = std::thread::Builder::new().name("editor".to_owned()).spawn(move || child.wait());
        waits.map(drop).map_err(|error| format!("cannot wait for {}: {error}", arguments[0]))
    }
}

/// The arguments of an editor that is known by the name of its program.
fn known(program: &str) -> Option<&'static [&'static str]> {
    let name = Path::new(program).file_stem()?.to_str()?.to_ascii_lowercase();
    KNOWN.iter().find(|(names, _)| names.contains(&name.as_str())).map(|(_, form)| *form)
}

/// Words as a shell splits them: spaces between, quotes around.
fn split(command: &str) -> Result<Vec<String>, String> {
    let mut words: Vec<String> = Vec::new();
    let mut word: Option<String> = None;
    let mut quote: Option<char> = None;
    for c in command.chars() {
        match quote {
            Some(q) if c == q => quote = None,
            Some(_) => word.get_or_insert_default().push(c),
            None if c == '"' || c == '\'' => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            None if c.is_whitespace() => words.extend(word.take()),
            None => word.get_or_insert_default().push(c),
        }
    }
    if quote.is_some() {
        return Err(format!("a quote is never closed in the editor's command: {command}"));
    }
    words.extend(word);
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_editors_are_told_the_place_in_their_way() {
        for (command, expected) in [
            ("code", &["code", "--goto", "/a b.ron:4:7"][..]),
            ("'/opt/my editors/subl' -n", &["/opt/my editors/subl", "-n", "/a b.ron:4:7"]),
            ("emacsclient -n", &["emacsclient", "-n", "+4:7", "/a b.ron"]),
            ("strange", &["strange", "/a b.ron"]),
            ("strange -l{line} -c{column} {file}", &["strange", "-l4", "-c7", "/a b.ron"]),
        ] {
            let editor = Editor::new(command).expect("a command");
            assert_eq!(editor.arguments(Path::new("/a b.ron"), 4, 7), expected, "{command}");
        }
        assert_eq!(
            Editor::new("x {line} {file}").expect("right").arguments(Path::new("{line}"), 0, 0)[1..],
            ["1", "{line}"]
        );
        assert!(Editor::new("  ").is_err() && Editor::new("code 'a").is_err());
    }
}
