//! What can go wrong, and which element or option is to blame.

use std::fmt;

/// Why a call was refused. On every error the caller's buffers are as they were.
///
/// Bad *elements* (zero-area triangles, non-manifold edges, unused vertices) are not errors: they are
/// skipped and counted in the [`Report`](crate::Report). An error means that the input cannot be read at all.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A triangle names a vertex that does not exist.
    IndexOutOfRange {
        /// Triangle number, from 0.
        triangle: usize,
        /// The vertex index that it holds.
        index: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// A coordinate is NaN or infinite.
    NonFinite {
        /// Vertex number, from 0.
        vertex: usize,
    },
    /// An option lies outside its range.
    BadOption {
        /// The field of [`Options`](crate::Options), or of `qsm_options`.
        name: &'static str,
        /// The value found.
        value: f64,
    },
    /// [`Constraints::locked`](crate::Constraints) is neither empty nor as long as the vertices.
    LockLength {
        /// Entries found.
        found: usize,
        /// Vertices in the mesh.
        vertex_count: usize,
    },
    /// [`TailOptions::mask`](crate::TailOptions::mask) is neither empty nor as long as the triangles.
    MaskLength {
        /// Entries found.
        found: usize,
        /// Triangles in the mesh.
        triangle_count: usize,
    },
    /// A marked feature edge names a vertex that does not exist.
    FeatureEdgeOutOfRange {
        /// Position in the list of marked edges, from 0.
        edge: usize,
        /// The vertex index that it holds.
        index: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// [`Constraints::seeds`](crate::Constraints::seeds) is neither empty nor as long as the vertices, and the order asks
    /// for it.
    SeedLength {
        /// Entries found.
        found: usize,
        /// Vertices in the mesh.
        vertex_count: usize,
    },
    /// [`Constraints::visits`](crate::Constraints::visits) names a vertex that does not exist, and the order asks for it.
    VisitOutOfRange {
        /// Position in the list of visits, from 0.
        visit: usize,
        /// The vertex index that it holds.
        index: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// More vertices than 32-bit indices can name, or more triangles than the library can address.
    TooLarge {
        /// The count that was passed.
        count: usize,
    },
    /// The progress callback asked to stop.
    Cancelled,
    /// Working memory could not be had.
    OutOfMemory {
        /// Bytes of the allocation that failed.
        bytes: usize,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IndexOutOfRange { triangle, index, vertex_count } => {
                write!(f, "triangle {triangle} names vertex {index}, but there are {vertex_count} vertices")
            }
            Self::NonFinite { vertex } => write!(f, "vertex {vertex} has a coordinate that is not finite"),
            Self::BadOption { name, value } => write!(f, "option {name} has the unusable value {value}"),
            Self::LockLength { found, vertex_count } => {
                write!(f, "the vertex mask has {found} entries for {vertex_count} vertices")
            }
            Self::MaskLength { found, triangle_count } => {
                write!(f, "the triangle mask has {found} entries for {triangle_count} triangles")
            }
            Self::FeatureEdgeOutOfRange { edge, index, vertex_count } => {
                write!(f, "feature edge {edge} names vertex {index}, but there are {vertex_count} vertices")
            }
            Self::SeedLength { found, vertex_count } => {
                write!(f, "the mask of seeds has {found} entries for {vertex_count} vertices")
            }
            Self::VisitOutOfRange { visit, index, vertex_count } => {
                write!(f, "visit {visit} names vertex {index}, but there are {vertex_count} vertices")
            }
            Self::TooLarge { count } => write!(f, "a count of {count} elements is more than can be addressed"),
            Self::Cancelled => write!(f, "cancelled by the progress callback"),
            Self::OutOfMemory { bytes } => write!(f, "could not allocate {bytes} bytes of working memory"),
        }
    }
}

impl std::error::Error for Error {}
