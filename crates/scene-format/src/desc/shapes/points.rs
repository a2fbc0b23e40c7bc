//! Lists of points that shapes are made of.

use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::read::{Reader, make_room};
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;

/// Reads a list of `least` points or more, each by the rule of `point`; `noun`: what the list is. `None`: something was
/// wrong, and told.
pub(super) fn read<P: Words>(
    reader: &mut Reader<'_>,
    item: Item<'_, '_>,
    at: &'static FieldDef,
    point: &'static FieldDef,
    (noun, least): (&str, usize),
) -> Option<Vec<P>> {
    let (mut points, mut whole, mut wrong) = (Vec::new(), true, 0);
    let told = reader.told();
    reader.passed_over = false;
    reader.items(item, at, |reader, child| {
        make_room(&mut points, item, child);
        match P::read(reader, child, point) {
            Some(point) => points.push(point),
            None => (whole, wrong) = (false, wrong + 1),
        }
    })?;
    if points.is_empty() && wrong > 1 {
        // Points of the plane where points of space stand, or the other way round: that is one mistake.
        reader.once(told, codes::WRONG_COUNT, wrong);
        reader.once(told, codes::EXPRESSION_TYPE, wrong);
    }
    if !whole || reader.passed_over || item.is_damaged() {
        return None;
    }
    if points.len() < least {
        let items = if matches!(P::TYPE, Type::Number) { "numbers" } else { "points" };
        let message = format!("{noun} has at least {least} {items}, not {}", points.len());
        let fault = Diagnostic::error(codes::WRONG_COUNT, item.head(), message);
        reader.report(fault.expected(format!("{least} {items} or more")));
        return None;
    }
    points.shrink_to_fit();
    Some(points)
}
