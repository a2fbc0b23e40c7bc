//! Numbers with their unit, `45deg` or `60 W`: the language has one unit for each quantity, and writes none.

use super::decode;
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression::TEMPERATURES;

/// Those in which the language counts as well.
const SAME: [&str; 12] = ["f", "deg", "degree", "degrees", "w", "watt", "watts", "px", "s", "sec", "seconds", "m"];

/// A short word after a number: both, where it is one.
pub(super) fn parted(lexeme: &str) -> Option<(&str, &str)> {
    let unit = lexeme.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | '_'));
    let number = &lexeme[..lexeme.len() - unit.len()];
    let short = (1..=7).contains(&unit.len()) && unit.bytes().all(|byte| byte.is_ascii_alphabetic());
    (short && decode::number(number).is_finite()).then_some((number, unit))
}

/// What is said of a unit. The number stands before it, or is its own word's.
pub(super) fn way(number: Option<&str>, unit: &str) -> String {
    let write = number.map_or("leave it out".to_owned(), |number| format!("write {number}"));
    match unit.to_ascii_lowercase().as_str() {
        "deg" | "degs" | "degree" | "degrees" => format!("{write}: angles are in degrees"),
        "rad" | "rads" | "radian" | "radians" => match number.map(|number| decode::number(number).to_degrees()) {
            Some(degrees) => format!("angles are in degrees: write {}", (degrees * 1e4).round() / 1e4),
            None => "angles are in degrees: 1 rad is 57.2958 of them".to_owned(),
        },
        "w" | "watt" | "watts" => {
            format!("{write}: `power` is in watts of light; a light bulb that takes 60 W is `luminous_power: 800`")
        }
        "m" | "cm" | "mm" | "km" | "in" | "inch" | "inches" | "ft" | "feet" | "meter" | "meters" | "metre"
        | "metres" => "lengths are in the scene's own unit, whichever you take: all of them in the same one".to_owned(),
        "px" | "pixel" | "pixels" => format!("{write}: width and height are in pixels"),
        "s" | "sec" | "secs" | "second" | "seconds" => format!("{write}: times are in seconds"),
        "f" | "h" => format!("{write}: numbers carry no type"),
        _ => "numbers carry no unit; the reference says which unit each field has".to_owned(),
    }
}

/// Says of what begins like a number and ends in a unit what to write.
pub(super) fn joined(mut fault: Diagnostic, lexeme: &str) -> Diagnostic {
    let side = |side: &&str| side.parse::<u32>().is_ok();
    if let Some((width, height)) = lexeme.split_once(['x', 'X']).filter(|(width, height)| side(width) && side(height)) {
        return fault.hint(format!("the sides of a picture are two numbers: width: {width}, height: {height}"));
    }
    let Some((number, unit)) = parted(lexeme) else { return fault };
    if matches!(unit, "K" | "Kelvin" | "kelvin") && TEMPERATURES.contains(&decode::number(number)) {
        let mended = format!("\"=blackbody({number})\"");
        fault = fault.hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: fault.span, replacement: mended });
        return fault;
    }
    fault = fault.hint(way(Some(number), unit));
    if SAME.contains(&unit.to_ascii_lowercase().as_str()) {
        fault.edit = Some(Edit { span: fault.span, replacement: number.to_owned() });
    }
    fault
}

/// The same of a text, `"50 cm"` or `"30°"`: what to write and, where the number itself is meant, the number. A comma
/// for the point, `"1,5"`, too. `None`: it is no number with a unit.
pub(crate) fn in_text(text: &str) -> Option<(String, Option<String>)> {
    let pointed = text.replacen(',', ".", 1);
    if decode::number(&pointed).is_finite() && pointed != text {
        return Some((format!("write {pointed}"), Some(pointed)));
    }
    let squeezed = text.replace('°', "deg").replace([' ', '\u{a0}'], "");
    let (number, unit) = parted(&squeezed)?;
    let same = SAME.contains(&unit.to_ascii_lowercase().as_str());
    Some((way(Some(number), unit), same.then(|| number.to_owned())))
}
