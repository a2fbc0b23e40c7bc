//! How points of an outline are joined.

use crate::words::scene_words;

scene_words! {
    /// How the points of a profile or an outline are joined.
    pub enum Curve, "curve" {
        /// By straight lines: an edge where they turn by more than 40 degrees, else they are shaded as round.
        Linear,
        /// By a smooth curve through all of them: centripetal Catmull-Rom. It swings out beyond its points where long
        /// and short distances between them meet; a point more in the long one keeps it there.
        CatmullRom,
    }
}
