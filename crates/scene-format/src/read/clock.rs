//! What `frame` and `time` stand for. The animation that says so may itself be said by expressions, so it is read when
//! it is first asked for.

use super::{Reader, Step};
use crate::codes;
use crate::desc::{Animation, Scene};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::expression::{Named, Value};
use crate::schema::FieldDef;
use crate::tree::{Item, NOWHERE};
use crate::words::Words;

#[derive(Debug)]
pub(super) struct Clock {
    /// Where the animation stands on the tape.
    slot: u32,
    state: State,
    /// The share of a frame that has gone by since the frame began.
    share: f64,
    /// An expression of the scene itself that asks for it.
    asked: Option<(Span, &'static str)>,
    /// Some expression asks for `time`.
    goes_by: bool,
    /// Some expression asks for `time` or `frame`, in an included file, too.
    counts: bool,
}

#[derive(Clone, Debug)]
enum State {
    NotYet,
    /// It is being read: whoever asks for it now goes round in a circle.
    Open,
    Done(Animation),
    Failed,
}

impl Default for Clock {
    fn default() -> Self {
        Clock { slot: NOWHERE, state: State::NotYet, share: 0.0, asked: None, goes_by: false, counts: false }
    }
}

impl Clock {
    /// That of a scene, so large a share of a frame after the frame's beginning.
    pub fn of(root: Item<'_, '_>, share: f64) -> Self {
        let animation = root.fields().find(|(key, _)| key.text() == "animation");
        Clock { slot: animation.map_or(NOWHERE, |(_, value)| value.index() as u32), share, ..Clock::default() }
    }
}

impl Reader<'_> {
    /// The animation. That of an included file is looked at and left alone.
    pub(crate) fn animation(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Animation> {
        if !self.open.is_empty() {
            return Animation::read(self, item, at);
        }
        if let State::NotYet = self.clock.state {
            self.read_animation(item, at);
        }
        match &self.clock.state {
            State::Done(animation) => Some(animation.clone()),
            _ => None,
        }
    }

    fn read_animation(&mut self, item: Item<'_, '_>, at: &'static FieldDef) {
        self.clock.state = State::Open;
        let read = Animation::read(self, item, at);
        if let State::Open = self.clock.state {
            // What is broken off, or written twice, says nothing of how many there are.
            let twice = |name: &str| item.fields().filter(|(key, _)| key.text() == name).count() > 1;
            let unsure = item.holds_damage() || twice("frame") || twice("frames");
            let inside = read.filter(|animation| unsure || self.has_frame(animation));
            self.clock.state = inside.map_or(State::Failed, State::Done);
        }
    }

    /// Whether the frame is one of those that there are; else it is reported.
    fn has_frame(&mut self, animation: &Animation) -> bool {
        let (frame, frames) = (animation.frame.value, animation.frames.value);
        if frame < frames {
            return true;
        }
        let message = format!("there is no frame {frame}: the animation has {frames}, counted from 0");
        let (message, expected) = match frames {
            1 => (format!("there is no frame {frame}: the animation has one, frame 0"), "0".to_owned()),
            _ => (message, format!("0 to {}", frames - 1)),
        };
        self.path.push(Step::Field("frame"));
        let fault = Diagnostic::error(codes::OUT_OF_RANGE, animation.frame.span, message).expected(expected);
        let more = frame.saturating_add(1);
        let way = format!("`frames` says how many there are, as in `animation: Animation(frames: {more})`");
        self.report(fault.hint(way));
        self.path.pop();
        false
    }

    /// What `frame` and `time` stand for; `None` for other names.
    pub(super) fn moment(&mut self, name: &str, item: Item<'_, '_>) -> Option<Named> {
        let name = if name == "frame" { "frame" } else { (name == "time").then_some("time")? };
        self.clock.goes_by |= name == "time";
        self.clock.counts = true;
        if self.clock.asked.is_none() && !self.is_included(item.span()) {
            self.clock.asked = Some((item.span(), name));
        }
        if let (State::NotYet, Some(found)) = (&self.clock.state, item.other(self.clock.slot))
            && let Some(at) = Scene::DEF.field("animation")
        {
            let path = std::mem::replace(&mut self.path, vec![Step::Field(at.name)]);
            let open = std::mem::take(&mut self.open);
            if let Some(found) = self.picked(found) {
                self.read_animation(found, at);
            }
            (self.path, self.open) = (path, open);
        }
        let animation = match &self.clock.state {
            State::NotYet => Animation::default(),
            State::Done(animation) => animation.clone(),
            State::Failed => {
                // What the expression names beside it is used where there is a frame.
                self.chosen = true;
                return Some(Named::Failed);
            }
            State::Open => {
                self.clock.state = State::Failed;
                let message = format!("`{name}` is asked for by the animation, which says what it is");
                let fault = Diagnostic::error(codes::CIRCLE, item.span(), message);
                self.report(fault.expected("values that do not need themselves"));
                return Some(Named::Failed);
            }
        };
        let value = match name {
            "frame" => f64::from(animation.frame.value),
            _ => animation.time_at(self.clock.share),
        };
        Some(Named::Value(Value::Number(value)))
    }

    /// Whether anything goes by `time`, and the shutter is open while it does.
    pub(super) fn moves(&self, shutter: &Spanned<f64>) -> bool {
        shutter.value > 0.0 && self.clock.goes_by
    }

    /// Warns where time is asked for that does not go by, and where it goes by and nobody asks for it.
    pub(super) fn nothing_moves(&mut self, shutter: &Spanned<f64>) {
        if shutter.value > 0.0 && !self.clock.goes_by {
            let message = "nothing moves while the shutter is open: no expression asks for `time`";
            self.path.extend([Step::Field("camera"), Step::Field("shutter")]);
            let fault = Diagnostic::warning(codes::NOTHING_MOVES, shutter.span, message);
            self.report(fault.hint(match self.clock.asked {
                Some(_) => "`frame` stays what it is within a frame; `time` goes on",
                None => "write what moves as an expression of `time`, or leave `shutter` out",
            }));
            self.path.truncate(self.path.len() - 2);
        }
        if let State::Done(animation) = &self.clock.state
            && animation.frames.value > 1
            && !self.clock.counts
        {
            let (frames, span) = (animation.frames.value, animation.frames.span);
            let message = format!("all {frames} frames are one picture: no expression asks for `time` or `frame`");
            self.path.extend([Step::Field("animation"), Step::Field("frames")]);
            let fault = Diagnostic::warning(codes::NOTHING_MOVES, span, message);
            self.report(fault.hint("write what moves as an expression of them, as in \"=360*time\""));
            self.path.truncate(self.path.len() - 2);
        }
        let Some((span, name)) = self.clock.asked.filter(|_| self.clock.slot == NOWHERE) else { return };
        // A shutter that is wrong is one all the same.
        let is_wrong = || self.sink.diagnostics.iter().any(|fault| fault.path == "camera.shutter");
        if name == "time" && (shutter.value > 0.0 || is_wrong()) {
            return;
        }
        let message = format!("`{name}` is always 0: the scene has no `animation`");
        let fault = Diagnostic::warning(codes::NOTHING_MOVES, span, message);
        self.report(fault.hint("`animation: Animation(frames: 48)` says how many frames there are"));
    }
}
