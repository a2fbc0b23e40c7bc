//! A file whose bytes go to the disk while more are written: else the disk would have nothing to do until the end.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

/// Bytes after which the disk is asked for them.
const AT_ONCE: usize = 8 << 20;

/// Writes a file.
pub struct Flushing {
    file: File,
    /// Bytes that the disk has not been asked for.
    since: usize,
    helper: Option<(SyncSender<()>, JoinHandle<io::Result<()>>)>,
}

impl Flushing {
    /// A new, empty file.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn create(path: &Path) -> io::Result<Self> {
        let file = File::create(path)?;
        let other = file.try_clone()?;
        let (wish, wishes) = sync_channel(1);
        let work = move || flush(&other, &wishes);
        let helper = std::thread::Builder::new().name("flush".to_owned()).spawn(work).ok();
        Ok(Flushing { file, since: 0, helper: helper.map(|thread| (wish, thread)) })
    }

    /// All of it is on the disk.
    ///
    /// # Errors
    /// When it is not.
    pub fn end(mut self) -> io::Result<()> {
        if let Some((wish, thread)) = self.helper.take() {
            drop(wish);
            // An error of the disk is told once: to whoever asks first.
            thread.join().unwrap_or_else(|_| Err(io::Error::other("a thread has panicked")))?;
        }
        self.file.sync_all()
    }
}

fn flush(file: &File, wishes: &Receiver<()>) -> io::Result<()> {
    wishes.iter().try_for_each(|()| file.sync_data())
}

impl Write for Flushing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.since += count;
        if self.since >= AT_ONCE {
            self.since = 0;
            if let Some((wish, _)) = &self.helper {
                // If it is at work, it comes to these bytes later.
                let _ = wish.try_send(());
            }
        }
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
