//! What is on the screen, and what has to be written for it to show something else.

use super::ask::{Abilities, Depth, Environment, Protocol};
use super::blocks::Blocks;
use super::device::Size;
use super::inline::{Kitty, iterm, png, through_tmux};
use super::layout::{Grid, Placed};
use super::scaled::{Picture, scaled};
use super::sixel::sixel;
use super::words::Line;
use crate::picture::developed;
use crate::shared::Frame;
use std::fmt::Write;
use std::sync::Arc;
use tracer_core::Look;

/// What is to be shown.
pub struct View {
    pub frame: Option<Arc<Frame>>,
    pub look: Look,
    /// Lines under the picture.
    pub lines: Vec<Line>,
    /// The last line.
    pub status: String,
}

/// What a picture on the screen is of.
#[derive(Clone, Copy, PartialEq)]
struct Shown {
    frame: u64,
    look: Look,
    placed: Placed,
}

pub struct Screen {
    protocol: Protocol,
    depth: Depth,
    synchronized: bool,
    /// Between us and the terminal is tmux, which has to be asked to hand on what it does not know.
    tmux: bool,
    told_cell: Option<[u32; 2]>,
    size: Size,
    grid: Grid,
    blocks: Blocks,
    kitty: Kitty,
    shown: Option<Shown>,
    /// The lines under the picture as they are, from the last one up.
    lines: Vec<Line>,
    /// Nothing of what was there is there any more.
    wiped: bool,
}

impl Screen {
    pub fn new(abilities: &Abilities, environment: &Environment, wanted: Option<Protocol>, size: Size) -> Self {
        let protocol = wanted.unwrap_or_else(|| abilities.protocol(environment));
        Screen {
            protocol,
            depth: abilities.depth(environment),
            synchronized: abilities.synchronized,
            tmux: abilities.is_multiplexed(environment),
            told_cell: abilities.cell,
            size,
            grid: Grid::new(protocol, size, abilities.cell),
            blocks: Blocks::default(),
            kitty: Kitty::new(),
            shown: None,
            lines: Vec::new(),
            wiped: true,
        }
    }

    pub fn size(&self) -> Size {
        self.size
    }

    /// The most pixels that can be seen.
    pub fn visible(&self) -> [u32; 2] {
        self.grid.visible([self.size.columns, self.size.rows.saturating_sub(1)])
    }

    /// The terminal has this size now, and nothing of ours may be on it.
    pub fn resize(&mut self, size: Size) {
        // What it told of its cells may not hold any more; what the system knows does.
        self.told_cell = self.told_cell.filter(|_| size.cell.is_none());
        self.size = size;
        self.grid = Grid::new(self.protocol, size, self.told_cell);
        self.wiped = true;
    }

    /// What takes all pictures off the screen for good.
    pub fn farewell(&self) -> String {
        if self.protocol == Protocol::Kitty { self.handed_on(&self.kitty.farewell()) } else { String::new() }
    }

    /// What has to be written for this to be shown; empty: it is.
    pub fn draw(&mut self, view: &View) -> String {
        let mut text = String::new();
        let under = u16::try_from(view.lines.len() + 1).unwrap_or(u16::MAX);
        let rows = self.size.rows.saturating_sub(under);
        let cells = [self.size.columns, rows];
        let placed = view.frame.as_ref().and_then(|frame| self.grid.place(frame.size, cells));
        let moved = self.shown.map(|shown| shown.placed) != placed || self.lines.len() != usize::from(under);
        if self.wiped || moved {
            text.push_str(&self.wipe());
        }
        if let (Some(frame), Some(placed)) = (&view.frame, placed) {
            let shown = Shown { frame: frame.number, look: view.look, placed };
            if self.shown != Some(shown) {
                let picture = scaled(&developed(&frame.film, &view.look), frame.film.size(), placed.points);
                text.push_str(&self.picture(&picture, placed));
                self.shown = Some(shown);
            }
        }
        let last = (view.status.clone(), None);
        let lines: Vec<Line> = std::iter::once(last).chain(view.lines.iter().rev().cloned()).collect();
        for (k, line) in lines.iter().enumerate().filter(|(k, line)| self.lines.get(*k) != Some(line)) {
            let Some(row) = usize::from(self.size.rows).checked_sub(k).filter(|&row| row > 0) else { break };
            let _ = write!(text, "\x1b[{row};1H");
            if let Some(colour) = line.1 {
                let _ = write!(text, "\x1b[{colour}m");
            }
            text.push_str(&line.0);
            text.push_str("\x1b[0m\x1b[K");
        }
        self.lines = lines;
        if self.synchronized && !text.is_empty() { format!("\x1b[?2026h{text}\x1b[?2026l") } else { text }
    }

    /// Takes everything off the screen.
    fn wipe(&mut self) -> String {
        let gone = self.kitty.clear();
        self.blocks.forget();
        (self.shown, self.wiped) = (None, false);
        self.lines.clear();
        format!("{}\x1b[0m\x1b[2J", self.handed_on(&gone))
    }

    fn picture(&mut self, picture: &Picture, placed: Placed) -> String {
        let [x, y] = placed.at;
        let cursor = format!("\x1b[{};{}H", y + 1, x + 1);
        match self.protocol {
            Protocol::Blocks => self.blocks.draw(picture, placed.at, self.depth),
            // Pictures have no more pixels than terminals: there is one.
            Protocol::Sixel => sixel(picture).map_or(String::new(), |words| cursor + &words),
            Protocol::Kitty | Protocol::Iterm => {
                let Ok(png) = png(picture) else { return String::new() };
                let cells = (!self.grid.known).then_some(placed.covered);
                let [sends, shows, removes] = match self.protocol {
                    Protocol::Kitty => self.kitty.draw(&png, cells),
                    _ => [String::new(), iterm(&png, placed.covered), String::new()],
                };
                let shows = if self.tmux {
                    // The cursor of the terminal is not that of tmux, which moves it whenever it likes.
                    through_tmux(&format!("\x1b7{cursor}{shows}\x1b8"))
                } else {
                    cursor + &shows
                };
                self.handed_on(&sends) + &shows + &self.handed_on(&removes)
            }
        }
    }

    /// Words of a protocol as they get to the terminal.
    fn handed_on(&self, words: &str) -> String {
        if self.tmux {
            // One by one: tmux takes no more than a megabyte at once.
            words.split_inclusive("\x1b\\").map(through_tmux).collect()
        } else {
            words.to_owned()
        }
    }
}
