//! The neighbourhood of a tail triangle, taken out of the mesh: two rings of triangles, numbered on their own.

use glam::DVec3;

use super::live::Live;
use super::report::Reason;
use crate::features::Role;
use crate::mesh::StarKind;
use crate::sweep::Surroundings;

/// Stars of more triangles than this are not taken up whole: their centres stay, so that the work on one tail is bounded.
pub(super) const LARGEST_STAR: usize = 48;

/// A triangle of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    /// Corners, as numbers within the patch.
    pub corners: [usize; 3],
    /// Where it lies in the mesh; `None` for one that an operation has made.
    pub slot: Option<u32>,
}

/// What may be done to a vertex of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Freedom {
    /// It may move in its tangent plane, pay volume debts and be removed.
    Full,
    /// It may move in its tangent plane and pay volume debts.
    Move,
    /// It may slide along its crease.
    Slide,
    /// It stays.
    None(Reason),
}

/// Geometry and connectivity of a patch; candidates are changed copies of it.
#[derive(Debug, Clone, Default)]
pub(super) struct Shape {
    pub positions: Vec<DVec3>,
    pub pieces: Vec<Piece>,
}

/// A patch as it lies in the mesh.
#[derive(Default)]
pub(super) struct Patch {
    /// Vertex numbers in the mesh; the corners of the triangle that the patch was taken up for come first.
    pub vertices: Vec<u32>,
    /// Of each vertex; those that may move have their whole star in the patch.
    pub freedom: Vec<Freedom>,
    pub shape: Shape,
}

impl Patch {
    /// Takes up the triangle in a slot, the triangles around its corners, and those around the neighbours of these.
    pub fn around(live: &Live<'_>, surroundings: &Surroundings<'_>, slot: u32) -> Self {
        let mut patch = Self { vertices: live.triangles[slot as usize].to_vec(), ..Self::default() };
        let mut slots = Vec::new();
        patch.take_up(live, &[slot], &mut slots);
        patch.take_up_stars(live, 0..3, &mut slots);
        let inner = patch.vertices.len();
        patch.take_up_stars(live, 3..inner, &mut slots);
        patch.complete(live, surroundings, inner)
    }

    /// Takes up the triangles around some vertices.
    pub fn of_stars(live: &Live<'_>, surroundings: &Surroundings<'_>, centres: &[u32]) -> Self {
        let mut patch = Self { vertices: centres.to_vec(), ..Self::default() };
        patch.take_up_stars(live, 0..centres.len(), &mut Vec::new());
        patch.complete(live, surroundings, centres.len())
    }

    /// Takes up the stars of the patch vertices in a range, but those that are too large.
    fn take_up_stars(&mut self, live: &Live<'_>, centres: std::ops::Range<usize>, slots: &mut Vec<u32>) {
        for v in centres {
            let around = live.around(self.vertices[v]);
            if around.len() <= LARGEST_STAR {
                self.take_up(live, around, slots);
            }
        }
    }

    /// Adds positions and freedoms; the stars of the first `inner` vertices have been taken up.
    fn complete(mut self, live: &Live<'_>, surroundings: &Surroundings<'_>, inner: usize) -> Self {
        self.shape.positions = self.vertices.iter().map(|&v| live.positions[v as usize]).collect();
        self.freedom = (0..self.vertices.len()).map(|v| self.freedom(live, surroundings, v, v < inner)).collect();
        self
    }

    fn take_up(&mut self, live: &Live<'_>, around: &[u32], slots: &mut Vec<u32>) {
        for &slot in around {
            if !slots.contains(&slot) {
                slots.push(slot);
                let corners = live.triangles[slot as usize].map(|v| self.local(v));
                self.shape.pieces.push(Piece { corners, slot: Some(slot) });
            }
        }
    }

    /// Number of a mesh vertex within the patch, given out at its first mention.
    fn local(&mut self, v: u32) -> usize {
        self.vertices.iter().position(|&x| x == v).unwrap_or_else(|| {
            self.vertices.push(v);
            self.vertices.len() - 1
        })
    }

    fn freedom(&self, live: &Live<'_>, around: &Surroundings<'_>, v: usize, inner: bool) -> Freedom {
        let vertex = self.vertices[v];
        let is_whole = inner && live.around(vertex).len() <= LARGEST_STAR;
        match around.features.role(vertex) {
            Role::Locked => Freedom::None(Reason::Locked),
            Role::Boundary | Role::Rim => Freedom::None(Reason::Boundary),
            Role::Corner if around.stars.kind(vertex) == StarKind::Open => Freedom::None(Reason::Boundary),
            Role::Corner => Freedom::None(Reason::Feature),
            Role::NonManifold | Role::Unreferenced => Freedom::None(Reason::Topology),
            _ if !is_whole => Freedom::None(Reason::NoGain),
            Role::Crease => Freedom::Slide,
            Role::Doubtful => Freedom::Move,
            Role::Free => Freedom::Full,
        }
    }

    /// Whether the edge between two patch vertices is a feature.
    pub fn is_feature(&self, around: &Surroundings<'_>, a: usize, b: usize) -> bool {
        around.features.is_feature(around.stars, self.vertices[a], self.vertices[b])
    }

    /// Why a vertex must not be removed, if so.
    pub fn reason_to_exist(&self, v: usize) -> Option<Reason> {
        match self.freedom[v] {
            Freedom::Full => None,
            Freedom::Move | Freedom::Slide => Some(Reason::Feature),
            Freedom::None(reason) => Some(reason),
        }
    }
}

impl Shape {
    pub fn corners(&self, piece: &Piece) -> [DVec3; 3] {
        piece.corners.map(|v| self.positions[v])
    }

    /// The ring of `v`, counter-clockwise; `None` unless it closes, passing each vertex once.
    pub fn ring(&self, v: usize) -> Option<Vec<usize>> {
        let rim: Vec<_> = self.pieces.iter().filter_map(|p| opposite(p.corners, v)).collect();
        cycle(&rim)
    }

    /// Puts the vertices next to `v` into `ring`, in no order and some twice.
    pub fn neighbours(&self, v: usize, ring: &mut Vec<usize>) {
        ring.clear();
        ring.extend(self.pieces.iter().filter_map(|p| opposite(p.corners, v)).flat_map(|(a, b)| [a, b]));
    }

    /// The piece that has the directed edge a → b, with its third corner.
    pub fn beside(&self, a: usize, b: usize) -> Option<(usize, usize)> {
        let third = |p: &Piece| {
            (0..3).find(|&k| p.corners[k] == a && p.corners[(k + 1) % 3] == b).map(|k| p.corners[(k + 2) % 3])
        };
        self.pieces.iter().enumerate().find_map(|(i, p)| third(p).map(|c| (i, c)))
    }
}

/// The edge of a triangle opposite to its corner `v`, in the triangle's own direction.
fn opposite([a, b, c]: [usize; 3], v: usize) -> Option<(usize, usize)> {
    if a == v {
        Some((b, c))
    } else if b == v {
        Some((c, a))
    } else if c == v {
        Some((a, b))
    } else {
        None
    }
}

/// Chains directed edges into one simple cycle that uses them all.
pub(super) fn cycle(edges: &[(usize, usize)]) -> Option<Vec<usize>> {
    let &(first, mut end) = edges.first()?;
    let mut vertices = vec![first];
    while end != first {
        if vertices.contains(&end) {
            return None;
        }
        vertices.push(end);
        end = edges.iter().find(|e| e.0 == end)?.1;
    }
    (vertices.len() == edges.len()).then_some(vertices)
}
