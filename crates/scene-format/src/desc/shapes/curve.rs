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

scene_words! {
    /// How the points of a tube's path are joined.
    pub enum TubeCurve, "curve of a tube" {
        /// By a smooth curve through all of them: centripetal Catmull-Rom.
        CatmullRom,
        /// By straight lines, with round elbows.
        Linear,
        /// By Bezier curves, as drawing programs have them: a point that the path passes, two handles, the next point
        /// that it passes, two handles, and so on, 3n + 1 points in all. It sets out towards the handle after a point,
        /// and comes from the one before it: where these and the point lie on one line it is smooth, else it has a
        /// round elbow. A handle in the place of its point leaves the way to the other one.
        Bezier,
    }
}
