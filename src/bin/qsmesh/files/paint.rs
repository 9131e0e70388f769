//! Quality as numbers and colours beside a mesh.

/// What is written beside one face or vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// Quality, 0 to 1.
    pub quality: f32,
    /// Red, green, blue.
    pub color: [u8; 3],
}

/// Tints of a mesh as it goes into its file.
#[derive(Debug)]
pub struct Paint {
    /// Of the faces, in their order.
    pub faces: Vec<Tint>,
    /// Of the vertices.
    pub vertices: Vec<Tint>,
}
