//! What a call did, in figures.

use std::ops::Add;

use crate::quality::Measurement;

/// Why vertices kept their bits. Each vertex of the mesh is either moved or counted under exactly one reason.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Kept {
    /// In no triangle.
    pub unreferenced: usize,
    /// Locked by the caller.
    pub locked: usize,
    /// On a non-manifold edge or vertex, or where the winding is inconsistent.
    pub non_manifold: usize,
    /// In a star without area, or with too few triangles to have an inside.
    pub degenerate: usize,
    /// On a boundary that stays fixed.
    pub boundary: usize,
    /// On a corner of the features or of a sliding boundary.
    pub corner: usize,
    /// Every move that was tried was refused by the guard.
    pub guard: usize,
    /// Every move that was tried would have passed `max_deviation`.
    pub deviation: usize,
    /// Already where the operation on its star would put it, or not visited in the order that was chosen.
    pub settled: usize,
}

impl Add for Kept {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            unreferenced: self.unreferenced + other.unreferenced,
            locked: self.locked + other.locked,
            non_manifold: self.non_manifold + other.non_manifold,
            degenerate: self.degenerate + other.degenerate,
            boundary: self.boundary + other.boundary,
            corner: self.corner + other.corner,
            guard: self.guard + other.guard,
            deviation: self.deviation + other.deviation,
            settled: self.settled + other.settled,
        }
    }
}

/// Wall time of the library's own work, in seconds; measuring is not part of it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Seconds {
    /// Everything but measuring.
    pub total: f64,
    /// Validation and stars.
    pub adjacency: f64,
    /// Finding features.
    pub features: f64,
    /// Sweeps.
    pub sweeps: f64,
    /// Tail treatment; 0 where there was none.
    pub tail: f64,
}

/// Result of [`smooth`](crate::smooth).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// The mesh as it came. All zero if `measure` was off.
    pub before: Measurement,
    /// The mesh as it left. All zero if `measure` was off.
    pub after: Measurement,
    /// (after − before) / |before| of the signed volume; 0 for a mesh that is not closed.
    pub volume_relative_change: f64,
    /// Vertices that have moved.
    pub moved: usize,
    /// Vertices that have not, by reason.
    pub kept: Kept,
    /// Triangles left out of all stars because they name a vertex twice.
    pub skipped_triangles: usize,
    /// Edges taken as features: creases and marked edges, boundary edges not counted.
    pub feature_edges: usize,
    /// Visits, over all sweeps, in which the guard or `max_deviation` shortened the step.
    pub moves_halved: usize,
    /// Visits, over all sweeps, in which no step was acceptable.
    pub moves_refused: usize,
    /// Greatest distance of a moved vertex from the original surface, in the units of the coordinates. Found by a local
    /// search, so never less than the true distance. 0 if `measure` was off.
    pub max_deviation: f64,
    /// Where the time went.
    pub seconds: Seconds,
}
