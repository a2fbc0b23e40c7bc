/// A file to be written.
pub struct File {
    /// Where, from the root of the repository.
    pub path: &'static str,
    /// What it holds.
    pub bytes: Vec<u8>,
}
