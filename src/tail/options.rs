//! What a caller can choose about the tail.

use crate::error::Error;

/// Settings of [`collapse_tails`](crate::collapse_tails): from where on a triangle belongs to the tail of the
/// distribution, and what may be done about it. Everything is free of scale.
#[derive(Debug, Clone, PartialEq)]
pub struct TailOptions<'a> {
    /// Longest over shortest edge above which a triangle is a tail, above 1. Default 3.
    pub edge_ratio: f64,
    /// Smallest angle in degrees below which a triangle is a tail, above 0 and below 60. Default 20.
    pub min_angle: f64,
    /// Largest angle in degrees above which a triangle is a tail, above 60 and below 180. Default 130.
    pub max_angle: f64,
    /// Flip every interior edge that is no feature where the Delaunay criterion in the tangent plane and the normals
    /// allow it, before tails are looked for. Default false.
    pub flips: bool,
    /// How often one triangle is taken up at most, 1 to 1,000. Default 3; a triangle is taken up again only after
    /// something near it has changed.
    pub attempts: u32,
    /// Operations that are carried out at most, over the whole mesh; `None`: no bound. Default `None`.
    pub operations: Option<usize>,
    /// One entry a triangle, true: may be treated as a tail. Empty: every triangle may. Default empty.
    pub mask: &'a [bool],
}

impl Default for TailOptions<'_> {
    fn default() -> Self {
        Self {
            edge_ratio: 3.0,
            min_angle: 20.0,
            max_angle: 130.0,
            flips: false,
            attempts: 3,
            operations: None,
            mask: &[],
        }
    }
}

impl TailOptions<'_> {
    /// Checks every range.
    ///
    /// # Errors
    /// [`Error::BadOption`] names the first field that lies outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let reject = |name, value| Err(Error::BadOption { name, value });
        if !(self.edge_ratio > 1.0 && self.edge_ratio.is_finite()) {
            return reject("edge_ratio", self.edge_ratio);
        }
        if !(self.min_angle > 0.0 && self.min_angle < 60.0) {
            return reject("min_angle", self.min_angle);
        }
        if !(self.max_angle > 60.0 && self.max_angle < 180.0) {
            return reject("max_angle", self.max_angle);
        }
        if !(1..=1000).contains(&self.attempts) {
            return reject("attempts", f64::from(self.attempts));
        }
        Ok(())
    }

    /// Checks that the mask, if there is one, has an entry for each triangle.
    pub(crate) fn check_mask(&self, triangle_count: usize) -> Result<(), Error> {
        match self.mask.len() {
            0 => Ok(()),
            found if found == triangle_count => Ok(()),
            found => Err(Error::MaskLength { found, triangle_count }),
        }
    }
}
