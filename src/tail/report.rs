//! What the treatment of the tail did, in figures.

use crate::quality::Measurement;

/// What is wrong with a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Defect {
    /// It names a vertex twice, or has no area.
    Degenerate,
    /// Its longest edge is too long for its shortest.
    Needle,
    /// Its largest angle is too large.
    Cap,
    /// Its smallest angle is too small, the rest passes.
    SmallAngle,
}

/// Why a triangle could not be cured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The cure would have moved or crossed a feature.
    Feature,
    /// The cure would have moved or removed what the caller locked.
    Locked,
    /// The cure would have moved the boundary.
    Boundary,
    /// The neighbourhood is no disc, or the cure would have made it none.
    Topology,
    /// The cure would have passed `max_deviation`.
    Deviation,
    /// The cure would have folded the surface or bent it sharply, or left a triangle below the quality floor.
    Fold,
    /// No operation made the worst triangle of the neighbourhood better, or the bounds on attempts or operations were
    /// reached.
    NoGain,
}

/// A triangle that is still in the tail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Leftover {
    /// Its number in the triangles that came out.
    pub triangle: u32,
    /// What is wrong with it.
    pub defect: Defect,
    /// Why it could not be cured.
    pub reason: Reason,
}

/// Result of [`collapse_tails`](crate::collapse_tails).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TailReport {
    /// The mesh as it came into the call. All zero if `measure` was off.
    pub before: Measurement,
    /// The mesh as it left. All zero if `measure` was off.
    pub after: Measurement,
    /// (after − before) / |before| of the signed volume; 0 for a mesh that is not closed.
    pub volume_relative_change: f64,
    /// Triangles in the tail when the treatment began.
    pub tails_before: usize,
    /// Triangles in the tail when it ended: the length of `leftovers`.
    pub tails_after: usize,
    /// Cures by vertex moves alone.
    pub moved: usize,
    /// Edges collapsed.
    pub collapsed: usize,
    /// Vertices removed and their stars retriangulated.
    pub removed: usize,
    /// Edges flipped to cure a tail.
    pub flipped: usize,
    /// Edges flipped because `flips` was on.
    pub general_flips: usize,
    /// Vertices that are no longer there.
    pub vertices_removed: usize,
    /// Triangles that are no longer there.
    pub triangles_removed: usize,
    /// Share of the triangles that came in which have kept their three vertices, 0 to 1.
    pub triangles_unchanged: f64,
    /// What could not be cured, by rising triangle number.
    pub leftovers: Vec<Leftover>,
    /// Greatest distance of a moved vertex from the surface that came into the call, and of a removed one from the
    /// triangles that took its place, in the units of the coordinates. Found by a local search, so never less than the
    /// true distance. 0 if `measure` was off.
    pub max_deviation: f64,
    /// Wall time of the treatment alone, in seconds.
    pub seconds: f64,
}
