//! What the Laplacian methods want of a star.

use glam::DVec3;

use super::local::LocalStar;

/// From the centre to the mean of the ring.
pub(super) fn mean(star: &LocalStar) -> DVec3 {
    let n = star.valence();
    let closes = star.rim_edge(0)[0] == star.rim_edge(n - 1)[1];
    let count = if closes { n } else { n + 1 };
    star.rim().take(count).sum::<DVec3>() / count as f64
}
