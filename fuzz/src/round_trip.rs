//! Reading a file, changing its mesh, writing it and reading it again.

use std::io::Write;

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Sources, TailOptions};

use crate::failure::Result;
use crate::files::faces::Faces;
use crate::files::positions::Positions;
use crate::files::revision::Revision;

/// What a reader returns.
pub type Mesh<C> = (Positions, Faces, C);

/// Larger meshes would make a round take too long.
const LARGEST: usize = 300;

/// One format: how it is read, and how a revision of what was read is written.
pub struct Format<C> {
    pub read: fn(Vec<u8>) -> Result<Mesh<C>>,
    pub write: fn(&C, &mut dyn Write, &Positions, &Revision, &Faces) -> Result<Vec<String>>,
    pub seams: fn(&C, &Faces) -> Result<Vec<[u32; 2]>>,
    /// Whether an unchanged mesh is written with the very bytes that it was read from.
    pub keeps_bytes: fn(&[u8]) -> bool,
}

/// Whatever the bytes are: an error or a mesh, and of a mesh what is written can be read again.
pub fn check<C>(format: &Format<C>, bytes: &[u8]) {
    let Ok((positions, faces, carrier)) = (format.read)(bytes.to_vec()) else { return };
    let written = |new: &Revision| {
        let mut out = Vec::new();
        (format.write)(&carrier, &mut out, &positions, new, &faces).expect("what was read can be written");
        out
    };
    let same = written(&Revision::of_positions(positions.clone()));
    if (format.keeps_bytes)(bytes) {
        assert!(same == bytes, "a file without changes was changed");
    }
    // Records that name vertices which aren't there may be all of a file without any, and then nothing is left.
    if positions.len() == 0 || positions.len() > LARGEST || faces.triangles.len() > LARGEST {
        return;
    }
    let seams = if faces.polygons.is_empty() { (format.seams)(&carrier, &faces).expect("seams") } else { vec![] };
    let Some(revision) = improved(&positions, &faces, &seams) else { return };
    let (again, faces_again, _) = (format.read)(written(&revision)).expect("what was written can be read");
    assert_eq!(faces_again.triangles.len(), revision.triangles(&faces).len());
    for (new, old) in faces_again.triangles.iter().zip(revision.triangles(&faces)) {
        for (&v, &w) in new.iter().zip(old) {
            assert_eq!(again.at(v as usize), revision.positions.at(w as usize), "another position was written");
        }
    }
}

/// The mesh as the command would make it; `None` where the library refuses it.
fn improved(positions: &Positions, faces: &Faces, seams: &[[u32; 2]]) -> Option<Revision> {
    let mut positions = positions.clone();
    match &mut positions {
        Positions::F32(points) => improve(points, faces, seams),
        Positions::F64(points) => improve(points, faces, seams),
    }
    .map(|remeshed| remeshed.revision(positions, faces))
}

/// New connectivity, if there is one.
struct Remeshed(Option<(Vec<[u32; 3]>, Sources, usize)>);

impl Remeshed {
    fn revision(self, positions: Positions, faces: &Faces) -> Revision {
        match self.0 {
            None => Revision::of_positions(positions),
            Some((triangles, sources, vertices)) => {
                Revision::of_mesh(positions, &triangles, &sources, vertices, faces.len()).0
            }
        }
    }
}

fn improve<T: qsmesh::Coordinate>(points: &mut Vec<[T; 3]>, faces: &Faces, seams: &[[u32; 2]]) -> Option<Remeshed> {
    let (options, tail) = (Options { measure: false, ..Options::default() }, TailOptions::default());
    let fixed = Constraints { feature_edges: seams, ..Constraints::default() };
    if !faces.polygons.is_empty() {
        qsmesh::smooth(points, &faces.triangles, &options, &fixed, &mut silent).ok()?;
        return Some(Remeshed(None));
    }
    let (mut triangles, mut sources, vertices) = (faces.triangles.clone(), Sources::default(), points.len());
    qsmesh::improve(points, &mut triangles, &options, &tail, &fixed, &mut sources, &mut silent).ok()?;
    Some(Remeshed(Some((triangles, sources, vertices))))
}
