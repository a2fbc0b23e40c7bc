//! The modules of a crate as its source has them: who is whose child, who names whom, and how long functions are.
//!
//! Read as tokens, not as syntax, so that what stands in macros counts as well. What is compiled for tests alone does
//! not count.

use anyhow::Context as _;
use proc_macro2::{Delimiter, Ident, Spacing, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A path of names from the root of a crate.
pub type Names = Vec<String>;

/// A path in the source: where it stands and what it names.
#[derive(Clone, Debug, PartialEq)]
pub struct Mention {
    /// Line, from 1.
    pub line: usize,
    /// From the root of the crate.
    pub names: Names,
}

/// A function with a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The line of `fn`, from 1.
    pub line: usize,
    /// Lines from there to the brace that closes it.
    pub lines: usize,
    /// A comment right above it, or the first in it, that begins with `Long:`.
    pub reason: bool,
}

/// A module: a file, or a block in one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Module {
    /// Its file.
    pub file: PathBuf,
    /// Modules in it.
    pub children: BTreeSet<String>,
    /// What it brings into scope: by name, from the root of the crate.
    imports: BTreeMap<String, Names>,
    /// All paths that begin in this crate.
    pub mentions: Vec<Mention>,
    /// All functions.
    pub functions: Vec<Function>,
}

/// A crate, by the paths of its modules.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// All modules but those of tests.
    pub modules: BTreeMap<Names, Module>,
}

impl Source {
    /// Reads a crate, given its `lib.rs` or `main.rs`.
    ///
    /// # Errors
    /// When a file cannot be read, or is not Rust.
    pub fn read(root: &Path) -> anyhow::Result<Self> {
        let mut source = Source::default();
        let folder = root.parent().context("a file in a folder")?;
        source.file(root, folder, Vec::new())?;
        Ok(source)
    }

    /// Reads a module and those below it, which lie in `folder`.
    fn file(&mut self, file: &Path, folder: &Path, path: Names) -> anyhow::Result<()> {
        let text = std::fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
        let below = self.text(file, &text, path.clone())?;
        for name in below {
            let flat = folder.join(format!("{name}.rs"));
            let own = folder.join(&name);
            let child = if flat.is_file() { flat } else { own.join("mod.rs") };
            let mut path = path.clone();
            path.push(name);
            self.file(&child, &own, path)?;
        }
        Ok(())
    }

    /// Reads the text of a module; gives those of its children that have files of their own.
    fn text(&mut self, file: &Path, text: &str, path: Names) -> anyhow::Result<Vec<String>> {
        let tokens: TokenStream =
            text.parse().map_err(|fault| anyhow::anyhow!("{} is not Rust: {fault}", file.display()))?;
        let lines: Vec<&str> = text.lines().collect();
        let mut reader = Reader { source: self, file, lines: &lines, root: path.clone(), files: Vec::new() };
        reader.module(path, tokens);
        Ok(reader.files)
    }

    /// The module that holds what a path names, behind all that is only handed on.
    pub fn resolve(&self, names: &[String]) -> Names {
        let (mut names, mut turns) = (names.to_vec(), 0);
        'again: loop {
            let mut at = Vec::new();
            for (k, name) in names.iter().enumerate() {
                let Some(module) = self.modules.get(&at) else { return at };
                if module.children.contains(name) {
                    at.push(name.clone());
                } else if let Some(import) = module.imports.get(name).filter(|_| turns < 16) {
                    names = import.iter().chain(&names[k + 1..]).cloned().collect();
                    turns += 1;
                    continue 'again;
                } else {
                    return at;
                }
            }
            return at;
        }
    }
}

/// Reads a file.
struct Reader<'a> {
    source: &'a mut Source,
    file: &'a Path,
    lines: &'a [&'a str],
    /// The path of the file's own module.
    root: Names,
    files: Vec<String>,
}

impl Reader<'_> {
    fn module(&mut self, path: Names, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut module = Module { file: self.file.to_owned(), ..Module::default() };
        // Children first: paths may begin with them.
        let mut blocks = Vec::new();
        self.children(&path, &tokens, &mut module, &mut blocks);
        self.items(&path, &tokens, &mut module);
        self.source.modules.insert(path.clone(), module);
        for (name, tokens) in blocks {
            let mut path = path.clone();
            path.push(name);
            self.module(path, tokens);
        }
    }

    /// The modules that stand at this level, and in macros' bodies.
    fn children(
        &mut self,
        path: &Names,
        tokens: &[TokenTree],
        module: &mut Module,
        blocks: &mut Vec<(String, TokenStream)>,
    ) {
        let mut k = 0;
        while k < tokens.len() {
            if let Some(next) = behind_test(tokens, k) {
                k = next;
                continue;
            }
            if let Some((name, behind)) = module_head(tokens, k) {
                match tokens.get(behind) {
                    Some(TokenTree::Group(block)) => {
                        blocks.push((name.clone(), block.stream()));
                        module.children.insert(name);
                    }
                    _ if *path == self.root => {
                        self.files.push(name.clone());
                        module.children.insert(name);
                    }
                    _ => {}
                }
                k = behind;
            } else if let TokenTree::Group(group) = &tokens[k] {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                self.children(path, &inner, module, blocks);
            }
            k += 1;
        }
    }

    /// Paths and functions of this level and all within, but not of modules in it.
    fn items(&self, path: &Names, tokens: &[TokenTree], module: &mut Module) {
        let mut k = 0;
        while k < tokens.len() {
            if let Some(next) = behind_test(tokens, k) {
                k = next;
                continue;
            }
            if let Some((_, behind)) = module_head(tokens, k) {
                k = behind + 1;
                continue;
            }
            match &tokens[k] {
                // Who may see it is no use of it.
                TokenTree::Ident(word) if word == "pub" && is_group(tokens.get(k + 1), Delimiter::Parenthesis) => {
                    k += 1
                }
                TokenTree::Ident(word) if word == "use" && !is_punct(tokens.get(k + 1), '<') => {
                    let end = (k..tokens.len()).find(|&j| is_punct(tokens.get(j), ';')).unwrap_or(tokens.len());
                    self.use_tree(path, &[], &tokens[k + 1..end], module);
                    k = end;
                }
                TokenTree::Ident(word) => {
                    if word == "fn" {
                        module.functions.extend(self.function(tokens, k));
                    }
                    k = self.path(path, tokens, k, module);
                }
                TokenTree::Group(group) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    self.items(path, &inner, module);
                }
                _ => {}
            }
            k += 1;
        }
    }

    /// A path that begins at a word; gives the place of its last token.
    fn path(&self, path: &Names, tokens: &[TokenTree], start: usize, module: &mut Module) -> usize {
        let behind_colons = start >= 2 && is_colons(tokens, start - 2);
        let (names, end) = names_from(tokens, start);
        if !behind_colons
            && names.len() > 1
            && let Some(names) = absolute(path, &names, module)
        {
            module.mentions.push(Mention { line: line_of(&tokens[start]), names });
        }
        end
    }

    /// What a `use` brings, behind `before`.
    fn use_tree(&self, path: &Names, before: &[String], tokens: &[TokenTree], module: &mut Module) {
        for part in tokens.split(|token| is_punct(Some(token), ',')).filter(|part| !part.is_empty()) {
            // A path may begin with `::`, which is another crate.
            if is_colons(part, 0) {
                continue;
            }
            let (mut names, end) = names_from(part, 0);
            names.splice(0..0, before.iter().cloned());
            let rest = part.get(end + 1..).unwrap_or_default();
            let group = rest.iter().find_map(|token| match token {
                TokenTree::Group(group) => Some(group),
                _ => None,
            });
            if let (None, Some(TokenTree::Group(group))) = (group, part.first()) {
                // `use {a, b}`.
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                self.use_tree(path, before, &inner, module);
                continue;
            }
            if let Some(group) = group {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                self.use_tree(path, &names, &inner, module);
                continue;
            }
            let is_self = names.len() > 1 && names.last().is_some_and(|name| name == "self");
            if is_self {
                names.pop();
            }
            let Some(names) = absolute(path, &names, module) else { continue };
            let alias = rest.windows(2).find_map(|pair| match pair {
                [TokenTree::Ident(word), TokenTree::Ident(alias)] if word == "as" => Some(bare(alias)),
                _ => None,
            });
            let is_all = rest.iter().any(|token| is_punct(Some(token), '*'));
            if let Some(name) = alias.or_else(|| names.last().cloned()).filter(|_| !is_all) {
                module.imports.insert(name, names.clone());
            }
            module.mentions.push(Mention { line: line_of(&part[0]), names });
        }
    }

    fn function(&self, tokens: &[TokenTree], k: usize) -> Option<Function> {
        let name = tokens[k + 1..].iter().take(2).find_map(|token| match token {
            TokenTree::Ident(name) => Some(bare(name)),
            _ => None,
        })?;
        let body =
            tokens[k + 1..].iter().take_while(|token| !is_punct(Some(token), ';')).find_map(|token| match token {
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
                _ => None,
            })?;
        let line = line_of(&tokens[k]);
        let (open, close) = (body.span_open().start().line, body.span_close().start().line);
        let is_reason = |line: &&str| line.trim_start().starts_with("// Long: ");
        let above = self.lines[..line - 1].iter().rev().take_while(|line| {
            let line = line.trim_start();
            line.starts_with("//") || line.starts_with("#[")
        });
        let reason = above.copied().chain(self.lines.get(open).copied()).any(|line| is_reason(&line));
        Some(Function { name, line, lines: close + 1 - line, reason })
    }
}

/// Where it goes on behind an item for tests alone, if one begins here.
fn behind_test(tokens: &[TokenTree], k: usize) -> Option<usize> {
    let Some(TokenTree::Group(attribute)) = tokens.get(k + 1).filter(|_| is_punct(tokens.get(k), '#')) else {
        return None;
    };
    let mut words = attribute.stream().into_iter();
    let (Some(TokenTree::Ident(word)), Some(TokenTree::Group(condition))) = (words.next(), words.next()) else {
        return None;
    };
    let has = |wanted: &str| condition.to_string().split(|c: char| !c.is_alphanumeric()).any(|word| word == wanted);
    if word != "cfg" || !has("test") || has("not") {
        return None;
    }
    let is_end = |token: &TokenTree| is_group(Some(token), Delimiter::Brace) || is_punct(Some(token), ';');
    let end = tokens[k + 2..].iter().position(is_end);
    Some(end.map_or(tokens.len(), |end| k + 3 + end))
}

/// The name of a module whose head begins here, and the place behind: a block, or a semicolon.
fn module_head(tokens: &[TokenTree], k: usize) -> Option<(String, usize)> {
    let TokenTree::Ident(word) = &tokens[k] else { return None };
    if word != "mod" {
        return None;
    }
    // In a macro its name may be an argument.
    let at = if is_punct(tokens.get(k + 1), '$') { k + 2 } else { k + 1 };
    let Some(TokenTree::Ident(name)) = tokens.get(at) else { return None };
    let is_head = is_group(tokens.get(at + 1), Delimiter::Brace) || is_punct(tokens.get(at + 1), ';');
    is_head.then(|| (bare(name), at + 1))
}

/// The names of a path that begins here, and the place of the last.
fn names_from(tokens: &[TokenTree], start: usize) -> (Names, usize) {
    let (mut names, mut end) = (Names::new(), start);
    let mut k = start;
    while let Some(TokenTree::Ident(name)) = tokens.get(k) {
        names.push(bare(name));
        end = k;
        if !is_colons(tokens, k + 1) {
            break;
        }
        k += 3;
    }
    (names, end)
}

/// A path from the root of the crate, if it begins in it.
fn absolute(at: &Names, names: &[String], module: &Module) -> Option<Names> {
    let mut base = match names.first()?.as_str() {
        "crate" => return Some(names[1..].to_vec()),
        "self" | "super" => at.clone(),
        child if module.children.contains(child) => return Some(at.iter().chain(names).cloned().collect()),
        _ => return None,
    };
    let rest = names.iter().skip_while(|name| match name.as_str() {
        "super" => base.pop().is_some(),
        word => word == "self",
    });
    let rest: Vec<String> = rest.cloned().collect();
    base.extend(rest);
    Some(base)
}

/// A word as files have it: `box`, not `r#box`.
fn bare(word: &Ident) -> String {
    let word = word.to_string();
    word.strip_prefix("r#").map(str::to_owned).unwrap_or(word)
}

fn line_of(token: &TokenTree) -> usize {
    token.span().start().line
}

fn is_punct(token: Option<&TokenTree>, char: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == char)
}

fn is_colons(tokens: &[TokenTree], k: usize) -> bool {
    let is_joint = matches!(tokens.get(k), Some(TokenTree::Punct(punct)) if punct.spacing() == Spacing::Joint);
    is_joint && is_punct(tokens.get(k), ':') && is_punct(tokens.get(k + 1), ':')
}

fn is_group(token: Option<&TokenTree>, delimiter: Delimiter) -> bool {
    matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == delimiter)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(texts: &[(&str, &str)]) -> Source {
        let mut source = Source::default();
        for (path, text) in texts {
            let path: Names = path.split('/').filter(|name| !name.is_empty()).map(str::to_owned).collect();
            source.text(Path::new("a.rs"), text, path).unwrap();
        }
        source
    }

    fn mentioned(source: &Source, path: &[&str]) -> Vec<(usize, String)> {
        let path: Names = path.iter().map(|&name| name.to_owned()).collect();
        let mentions = &source.modules[&path].mentions;
        mentions.iter().map(|mention| (mention.line, source.resolve(&mention.names).join("/"))).collect()
    }

    #[test]
    fn all_ways_to_name_a_thing_are_seen() {
        let root = "mod a; mod b; mod c; mod r#box { use crate::a::A; }";
        let a = "pub struct A;";
        let b = "pub use crate::a::A;\npub fn f() {}";
        let c = "use super::{a::A as Other, b::{self, f}};\nuse crate::b::A;\nfn g() { b::f(); crate::a::A; }\n\
                 macro_rules! m { () => { $crate::a::A } }\n\
                 pub(in crate::a) fn h() -> std::a::A {}\nuse {crate::a::*};";
        let source = source(&[("", root), ("a", a), ("b", b), ("c", c)]);
        let a = |line| (line, "a".to_owned());
        let b = |line| (line, "b".to_owned());
        // What `b` hands on is of `a`; `b::f` begins with a name that the first line brought and is no new arrow.
        assert_eq!(mentioned(&source, &["c"]), [a(1), b(1), b(1), a(2), a(3), a(4), a(6)]);
        assert_eq!(mentioned(&source, &["box"]), [a(1)]);
    }

    #[test]
    fn modules_in_files_and_macros_are_places_of_their_own() {
        let source = source(&[
            ("", "mod a;"),
            (
                "a",
                "mod inner { use super::f; use crate::b; }\n\
                 macro_rules! m { ($l:ident) => { mod $l { use super::*; } } }",
            ),
        ]);
        assert_eq!(mentioned(&source, &["a", "inner"]), [(1, "a".to_owned()), (1, String::new())]);
        assert_eq!(mentioned(&source, &["a", "l"]), [(2, "a".to_owned())]);
        assert!(mentioned(&source, &["a"]).is_empty());
    }

    #[test]
    fn tests_count_for_nothing() {
        let text = "#[cfg(test)]\nmod tests;\n#[cfg(test)]\n#[path = \"x\"]\nmod more { use crate::a; }\n\
                    #[cfg(test)]\nuse crate::a;\n#[cfg(not(test))]\nuse crate::b;";
        let source = source(&[("", text)]);
        assert!(source.modules[&Names::new()].children.is_empty());
        assert_eq!(mentioned(&source, &[]), [(9, String::new())]);
    }

    #[test]
    fn functions_are_measured_and_reasons_seen() {
        let text = "fn a() {\n}\nimpl B {\n    // Long: it is a table.\n    #[inline]\n    pub fn c<T>(x: T)\n    \
                    where\n        T: D,\n    {\n        fn d() { }\n    }\n}\n\
                    trait E { fn f(); fn g() {\n    // Long: said within.\n} }";
        let source = source(&[("", text)]);
        let found = source.modules[&Names::new()].functions.iter();
        let found: Vec<_> = found.map(|f| (f.name.as_str(), f.line, f.lines, f.reason)).collect();
        assert_eq!(found, [("a", 1, 2, false), ("c", 6, 6, true), ("d", 10, 1, false), ("g", 13, 3, true)]);
    }

    #[test]
    fn what_is_no_rust_is_told_with_its_file() {
        let fault = Source::default().text(Path::new("a.rs"), "fn a( {", Names::new()).unwrap_err();
        assert!(fault.to_string().starts_with("a.rs is not Rust:"), "{fault}");
    }
}
