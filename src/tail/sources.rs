//! Where every element of the output came from.

/// Maps from output elements to input elements, by which UVs, weights, materials and fields follow the mesh.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Sources {
    /// For each output vertex the input vertex that it is. Rising.
    pub vertex: Vec<u32>,
    /// For each output triangle the input triangle whose place it took.
    pub triangle: Vec<u32>,
    /// For each output corner (3 × triangle + 0, 1 or 2) an input corner (counted likewise) of the same vertex on the same
    /// side of all feature edges, in the source triangle if that is known to have one there.
    pub corner: Vec<u32>,
}
