//! Which texts are scenes: editors tell of every file of TOML and JSON, and most of them are of other programs.

use scene_format::Syntax;
use scene_format::analysis::words_at_top;

/// Words at the top of scenes that hardly any other file has there.
const OWN: [&str; 8] = ["camera", "cameras", "effects", "lights", "materials", "objects", "render", "textures"];

/// Words at the top of scenes that other programs have, too. `version` is one of everybody's and tells nothing.
const SHARED: [&str; 6] = ["animation", "background", "image", "include", "output", "vars"];

/// Whether a text is a scene: RON always is; TOML and JSON with a word that scenes alone have at the top, or two of
/// those that other files have as well.
pub fn is_scene(text: &str, syntax: Syntax) -> bool {
    syntax == Syntax::Ron || weight(text, syntax) >= 2
}

/// Whether it may become a scene by what is written at a byte: there is no more than a word of scenes, comments and
/// brackets around that line.
pub fn may_become_scene(text: &str, syntax: Syntax, byte: usize) -> bool {
    let begin = text[..byte].rfind('\n').map_or(0, |at| at + 1);
    let end = text[byte..].find('\n').map_or(text.len(), |at| byte + at);
    let is_empty = |line: &str| line.starts_with('#') || line.bytes().all(|byte| matches!(byte, b'{' | b'}'));
    let others = text[..begin].lines().chain(text[end..].lines());
    weight(text, syntax) > 0 || others.map(str::trim).all(is_empty)
}

/// How many of the words of scenes it has at the top; those of scenes alone count twice.
fn weight(text: &str, syntax: Syntax) -> usize {
    let words = words_at_top(text, syntax);
    let of = |names: &[&str]| words.iter().filter(|word| names.contains(&word.as_str())).count();
    2 * of(&OWN) + of(&SHARED)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Syntax::{Json, Ron, Toml};
    use std::collections::BTreeSet;

    #[test]
    fn files_of_other_programs_are_no_scenes() {
        let others = [
            ("[package]\nname = \"a\"\nversion = \"0.1.0\"\n\n[dependencies]\n", Toml),
            ("version = 4\n\n[[package]]\nname = \"adler2\"\n", Toml),
            ("[scene.noise]\nseed = 5\n", Toml),
            ("{ \"name\": \"a\", \"version\": \"1.0.0\", \"scripts\": {} }", Json),
            ("{ \"include\": [\"src\"], \"compilerOptions\": { \"render\": 1 } }", Json),
            ("{ \"version\": \"3\", \"services\": { \"a\": { \"image\": \"b\" } } }", Json),
            ("{ \"manifest_version\": 3, \"version\": \"1\", \"background\": { \"scripts\": [] } }", Json),
            ("[1, 2]", Json),
            ("", Toml),
            ("{", Json),
        ];
        for (text, syntax) in others {
            assert!(!is_scene(text, syntax), "{text}");
        }
    }

    #[test]
    fn scenes_are_scenes_whatever_is_wrong_with_them() {
        let scenes = [
            ("Scene()", Ron),
            ("", Ron),
            ("background = 1\nvars = { r = 1 }\n", Toml),
            ("[[objects]]\nSphere = { radus = 1 }\n", Toml),
            ("[render]\nsamples = -4\n", Toml),
            ("version = 1 1\n[materials.red]\nDiffuse = { albedo = \n", Toml),
            ("{ \"objects\": [{ \"Sphere\": { \"radius\": } ] }", Json),
            ("{ \"version\" 1, \"camera\": { \"from\": [0, 0, 5] } }", Json),
            ("{ \"camera\": {", Json),
        ];
        for (text, syntax) in scenes {
            assert!(is_scene(text, syntax), "{text}");
        }
    }

    /// Whoever gives scenes another word says which of both it is.
    #[test]
    fn all_words_of_scenes_are_known() {
        let schema: serde_json::Value = serde_json::from_str(&scene_format::schema()).expect("JSON");
        let words = schema["properties"].as_object().expect("fields").keys().map(String::as_str);
        let words: BTreeSet<&str> = words.filter(|word| !["$schema", "version"].contains(word)).collect();
        assert_eq!(words, OWN.into_iter().chain(SHARED).collect());
    }

    #[test]
    fn what_is_begun_may_become_a_scene() {
        let at_end = |text: &str, syntax| may_become_scene(text, syntax, text.len());
        assert!(at_end("# a room\n\nobj", Toml) && at_end("background = 1\nob", Toml) && at_end("{\n  \"ob", Json));
        assert!(!at_end("[package]\nname = \"a\"\nob", Toml));
        assert!(!may_become_scene("{\n  \n  \"name\": 1\n}", Json, 4));
    }
}
