//! Numbers that become colours.

use super::{Albedo, Pattern, SolidMapping};
use crate::codes;
use crate::desc::Color;
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Words, scene_struct, scene_words};

scene_struct! {
    /// Colours by the luminance of another texture: what is dark there has the first colour, what is light the last,
    /// with any number of steps between.
    pub struct ColorRamp as "ColorRamp", "a ramp of colours" {
        /// What says which colour: the luminance of a texture, from 0 to 1. A picture here is read as numbers: see
        /// `color_space`.
        input: Albedo => Rule::share();
        /// 2 to 64 colours, each at a number from 0 to 1 that is not below the one before: `[(at: 0, color: 0.1), (at:
        /// 0.6, color: "#c03020")]`. Two at the same number make an edge.
        stops: Stops;
        /// Between two stops.
        interpolation: RampInterpolation = RampInterpolation::Linear;
    }
}

scene_struct! {
    /// A colour of a ramp.
    pub struct Stop as "Stop", "a stop" {
        /// Where it is.
        at: Spanned<f64> => Rule::within("a number", 0.0, 1.0);
        /// The colour there.
        color: Spanned<Color> => Rule::share();
    }
}

scene_words! {
    /// How a ramp goes from one stop to the next.
    pub enum RampInterpolation, "interpolation of a ramp" {
        /// Evenly.
        Linear,
        /// Slowly at both stops, faster between: f^2 (3 - 2 f).
        Smooth,
        /// Not at all: a colour holds until the next stop.
        Constant,
    }
}

/// The colours of a ramp; at least two where they were read.
#[derive(Clone, Debug, PartialEq)]
pub struct Stops(pub Vec<Stop>);

/// Most stops of a ramp.
const MOST_STOPS: usize = 64;

impl Words for Stops {
    const TYPE: Type = Type::List(&Stop::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if reader.stops_elsewhere(item) {
            return None;
        }
        let before = std::mem::take(&mut reader.passed_over);
        let (mut stops, mut wrong) = (Vec::new(), false);
        reader.items(item, at, |reader, child| {
            let stop = if reader.stop_elsewhere(child) { None } else { Stop::read(reader, child, at) };
            wrong |= stop.is_none();
            stops.extend(stop);
        })?;
        wrong |= std::mem::replace(&mut reader.passed_over, before);
        if wrong {
            // What is wrong with them has been said.
            return None;
        }
        if !(2..=MOST_STOPS).contains(&stops.len()) {
            let message = format!("a ramp of colours has {} stops", stops.len());
            reader.report(Diagnostic::error(codes::OUT_OF_RANGE, item.head(), message).expected("2 to 64 stops"));
            return None;
        }
        let falls = stops.windows(2).find(|pair| pair[1].at.value < pair[0].at.value);
        if let Some([before, after]) = falls {
            let message = format!("the stop at {} comes after that at {}", after.at.value, before.at.value);
            reader.report(
                Diagnostic::error(codes::OUT_OF_RANGE, after.at.span, message)
                    .expected("stops in the order of their numbers")
                    .hint("put it before the other one")
                    .label(before.at.span, "this one is further on"),
            );
            return None;
        }
        Some(Stops(stops))
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}

impl Pattern for ColorRamp {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.input]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        None
    }
}
