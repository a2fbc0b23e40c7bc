//! What a terminal can: told by its answers, and by what stands in the environment.

use super::input::Reply;

/// A way to show pictures in a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// kitty's graphics: kitty, Ghostty, Konsole.
    Kitty,
    /// iTerm2's inline images: iTerm2, WezTerm, mintty.
    Iterm,
    /// Sixel: foot, xterm, Windows Terminal, mlterm.
    Sixel,
    /// Unicode half blocks: any terminal.
    Blocks,
}

/// How many colours text has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// 24 bits.
    True,
    /// The 256 of xterm.
    Indexed,
}

/// What all questions are; the last one is answered by every terminal.
///
/// In order: name and version, whether output can be synchronized, the size of a cell, whether a colour of 24 bits
/// stays what it is, attributes.
pub const QUESTIONS: &str = "\x1b[>q\x1b[?2026$p\x1b[16t\x1b[48;2;1;2;3m\x1bP$qm\x1b\\\x1b[0m\x1b[c";

/// Whether it knows kitty's graphics, to be asked before: a picture of one pixel, not to be shown. Not in tmux, which
/// takes it for a title of its window.
pub const ASKS_KITTY: &str = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\";

/// The environment as far as it tells of a terminal.
#[derive(Clone, Debug, Default)]
pub struct Environment {
    pub term: String,
    pub term_program: String,
    /// iTerm2 sets it, and ssh hands it on.
    pub lc_terminal: String,
    pub colorterm: String,
    /// `TMUX` or `STY`: a multiplexer is between us and the terminal.
    pub multiplexed: bool,
}

impl Environment {
    pub fn of_process() -> Self {
        let get = |name| std::env::var(name).unwrap_or_default();
        Environment {
            term: get("TERM"),
            term_program: get("TERM_PROGRAM"),
            lc_terminal: get("LC_TERMINAL"),
            colorterm: get("COLORTERM"),
            multiplexed: !get("TMUX").is_empty() || !get("STY").is_empty(),
        }
    }

    /// Whether tmux or screen is known to be between.
    pub fn is_multiplexed(&self) -> bool {
        self.multiplexed || is_multiplexer(&self.term)
    }
}

/// Whether this begins as the names of tmux and screen do.
fn is_multiplexer(name: &str) -> bool {
    ["tmux", "screen"].iter().any(|known| name.to_lowercase().starts_with(known))
}

/// What a terminal has told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    kitty: bool,
    sixel: bool,
    /// Output can be synchronized.
    pub synchronized: bool,
    colours: bool,
    version: String,
    /// A cell in pixels.
    pub cell: Option<[u32; 2]>,
}

impl Abilities {
    /// Takes an answer; whether it was the last one.
    pub fn take(&mut self, reply: Reply) -> bool {
        match reply {
            Reply::Kitty(can) => self.kitty = can,
            Reply::Attributes(attributes) => {
                self.sixel = attributes.contains(&4);
                return true;
            }
            Reply::Cell([width, height]) => self.cell = (width > 0 && height > 0).then_some([width, height]),
            // Set or not, for good or not: it is known.
            Reply::Mode(2026, is) => self.synchronized = (1..=3).contains(&is),
            Reply::Mode(..) => {}
            Reply::Version(version) => self.version = version,
            Reply::Colours(set) => {
                let numbers: Vec<&str> = set.split([';', ':']).filter(|number| !number.is_empty()).collect();
                self.colours = numbers.ends_with(&["48", "2", "1", "2", "3"]);
            }
        }
        false
    }

    /// Whether tmux or screen is between, which know nothing of pictures, or little. Over ssh only the names tell.
    pub fn is_multiplexed(&self, environment: &Environment) -> bool {
        environment.is_multiplexed() || is_multiplexer(&self.version)
    }

    /// The best way to show a picture.
    pub fn protocol(&self, environment: &Environment) -> Protocol {
        let named = |name: &str| {
            let version = self.version.to_lowercase();
            environment.term_program.to_lowercase().starts_with(name)
                || environment.lc_terminal.to_lowercase().starts_with(name)
                || version.starts_with(name)
        };
        if self.is_multiplexed(environment) {
            Protocol::Blocks
        } else if self.kitty {
            Protocol::Kitty
        } else if named("iterm") || named("wezterm") {
            Protocol::Iterm
        } else if self.sixel {
            Protocol::Sixel
        } else {
            Protocol::Blocks
        }
    }

    /// The colours that text may have.
    pub fn depth(&self, environment: &Environment) -> Depth {
        let said = ["truecolor", "24bit"].contains(&environment.colorterm.to_lowercase().as_str());
        let named = ["-direct", "-kitty", "-ghostty"].iter().any(|name| environment.term.ends_with(name));
        if said || named || self.colours || self.kitty { Depth::True } else { Depth::Indexed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(replies: impl IntoIterator<Item = Reply>) -> Abilities {
        let mut abilities = Abilities::default();
        for reply in replies {
            abilities.take(reply);
        }
        abilities
    }

    fn env(term: &str) -> Environment {
        Environment { term: term.to_owned(), ..Environment::default() }
    }

    #[test]
    fn the_best_way_is_chosen_by_what_the_terminal_tells() {
        let sixel = || Reply::Attributes(vec![62, 4, 22]);
        let version = |name: &str| Reply::Version(name.to_owned());
        let plain = env("xterm-256color");
        assert_eq!(told([]).protocol(&plain), Protocol::Blocks);
        assert_eq!(told([Reply::Kitty(true), sixel()]).protocol(&plain), Protocol::Kitty);
        assert_eq!(told([Reply::Kitty(false), sixel()]).protocol(&plain), Protocol::Sixel);
        assert_eq!(told([version("WezTerm 2024"), sixel()]).protocol(&plain), Protocol::Iterm);
        let forwarded = Environment { lc_terminal: "iTerm2".to_owned(), ..plain.clone() };
        assert_eq!(told([]).protocol(&forwarded), Protocol::Iterm);
        let here = Environment { term_program: "iTerm.app".to_owned(), ..plain.clone() };
        assert_eq!(told([]).protocol(&here), Protocol::Iterm);
        assert_eq!(told([Reply::Attributes(vec![62, 22, 44])]).protocol(&plain), Protocol::Blocks);
        // tmux and screen, here and on the other side of ssh.
        let all = || [Reply::Kitty(true), sixel()];
        assert_eq!(told(all()).protocol(&Environment { multiplexed: true, ..plain.clone() }), Protocol::Blocks);
        assert_eq!(told(all()).protocol(&env("screen-256color")), Protocol::Blocks);
        assert_eq!(told([version("tmux 3.5"), sixel()]).protocol(&forwarded), Protocol::Blocks);
    }

    #[test]
    fn colours_are_known_by_the_environment_or_by_asking() {
        let plain = env("xterm-256color");
        assert_eq!(told([]).depth(&plain), Depth::Indexed);
        assert_eq!(told([]).depth(&Environment { colorterm: "truecolor".to_owned(), ..plain.clone() }), Depth::True);
        assert_eq!(told([]).depth(&Environment { colorterm: "256".to_owned(), ..plain.clone() }), Depth::Indexed);
        for (set, depth) in [
            ("48:2::1:2:3", Depth::True),
            ("0;48:2:1:2:3", Depth::True),
            ("48;2;1;2;3", Depth::True),
            ("0;48;5;16", Depth::Indexed),
            ("0", Depth::Indexed),
        ] {
            assert_eq!(told([Reply::Colours(set.to_owned())]).depth(&plain), depth, "{set}");
        }
    }

    #[test]
    fn attributes_are_the_last_answer() {
        let mut abilities = Abilities::default();
        assert!(!abilities.take(Reply::Mode(2026, 2)));
        assert!(!abilities.take(Reply::Cell([9, 18])));
        assert!(abilities.take(Reply::Attributes(vec![1, 2])));
        assert_eq!((abilities.synchronized, abilities.cell), (true, Some([9, 18])));
        abilities.take(Reply::Mode(2026, 0));
        abilities.take(Reply::Cell([0, 0]));
        assert_eq!((abilities.synchronized, abilities.cell), (false, None));
        assert!(QUESTIONS.ends_with("\x1b[c"));
    }
}
