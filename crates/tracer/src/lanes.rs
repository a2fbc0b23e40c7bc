//! TRACER_LANES: how many lanes the engine computes in. The picture is the same for all.

use crate::failure::Failure;
use tracer_core::Level;

/// The level that the environment asks for; the best when it asks for none.
///
/// # Errors
/// When TRACER_LANES is no number of lanes, or one that this CPU does not have.
pub fn from_environment() -> Result<Level, Failure> {
    let Some(value) = std::env::var_os("TRACER_LANES").filter(|value| !value.is_empty()) else {
        return Ok(Level::best());
    };
    let lanes = match value.to_str() {
        Some("1") => 1,
        Some("8") => 8,
        Some("16") => 16,
        _ => {
            let value = value.to_string_lossy();
            return Err(Failure::wrong(format!("TRACER_LANES is `{value}`; expected 1, 8 or 16 (or unset it)")));
        }
    };
    Level::from_lanes(lanes).ok_or_else(|| {
        let mut has: Vec<String> = Level::available().iter().map(|level| level.lanes().to_string()).collect();
        has.dedup();
        Failure::could_not(format!(
            "TRACER_LANES is {lanes}, but this CPU computes in {} lanes only; unset TRACER_LANES",
            has.join(" or ")
        ))
    })
}
