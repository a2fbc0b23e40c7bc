//! The work behind a picture that follows its file, whoever shows it: studio and watch.

use crate::shared::{Phase, Shared};
use crate::{studio, watch};
use std::sync::Arc;
use std::thread::{Builder, JoinHandle};

/// Begins it; the studio's thread ends when it is told to quit, the watch when nobody holds `shared` any more.
pub fn begin(shared: &Arc<Shared>) -> std::io::Result<JoinHandle<()>> {
    let worker = Arc::clone(shared);
    let studio = Builder::new().name("studio".to_owned()).spawn(move || studio::run(&worker))?;
    let watched = Arc::clone(shared);
    Builder::new().name("watch".to_owned()).spawn(move || watch::run(watched))?;
    Ok(studio)
}

/// Has a picture that is done go on, to twice its samples.
///
/// # Errors
/// When it is not done.
pub fn twice(shared: &Shared) -> Result<(), &'static str> {
    let asked = {
        let state = shared.state();
        let done = state.phase == Phase::Done;
        state.frame.as_ref().filter(|_| done).map(|frame| frame.samples.saturating_mul(2))
    };
    let asked = asked.ok_or("the picture is not done yet")?;
    shared.order(|orders| orders.samples = Some(asked));
    Ok(())
}
