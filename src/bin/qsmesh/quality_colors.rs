//! `--quality-colors`: where the bad triangles are, or were.

use qsmesh::Parameter;

use crate::arguments::Shown;
use crate::colormap;
use crate::failure::{Failure, Result};
use crate::files::{MeshFile, Paint, Positions, Revision, Tint};

/// Tints by the mean-ratio shape of the triangles before or after the work: a face by its worst triangle, a vertex by
/// the worst triangle around it. A triangle that took the place of another shows that one's former shape.
pub fn paint(shown: Shown, file: &MeshFile, revision: &Revision) -> Result<Paint> {
    let (faces, vertices) = match shown {
        Shown::Before => before(file, revision)?,
        Shown::After => after(file, revision)?,
    };
    let tints = |values: Vec<f64>| values.into_iter().map(tint).collect();
    Ok(Paint { faces: tints(faces), vertices: tints(vertices) })
}

fn tint(quality: f64) -> Tint {
    Tint { quality: quality as f32, color: colormap::color(quality) }
}

/// Qualities of faces and vertices.
type Qualities = (Vec<f64>, Vec<f64>);

fn before(file: &MeshFile, revision: &Revision) -> Result<Qualities> {
    let shapes = shapes(&file.positions, &file.faces.triangles)?;
    let mut faces = vec![0.0; revision.face_count(&file.faces)];
    for (face, fan) in file.faces.fans().into_iter().enumerate() {
        faces[revision.successors(face)].fill(worst(&shapes[fan]));
    }
    let former = around_vertices(&shapes, &file.faces.triangles, file.positions.len());
    let mut vertices = vec![1.0; revision.positions.len()];
    for (vertex, quality) in former.into_iter().enumerate() {
        if let Some(new) = revision.vertex(vertex) {
            vertices[new] = quality;
        }
    }
    Ok((faces, vertices))
}

fn after(file: &MeshFile, revision: &Revision) -> Result<Qualities> {
    let triangles = revision.triangles(&file.faces);
    let shapes = shapes(&revision.positions, triangles)?;
    let vertices = around_vertices(&shapes, triangles, revision.positions.len());
    let faces = if revision.is_remeshed() {
        shapes
    } else {
        file.faces.fans().into_iter().map(|fan| worst(&shapes[fan])).collect()
    };
    Ok((faces, vertices))
}

fn shapes(positions: &Positions, triangles: &[[u32; 3]]) -> Result<Vec<f64>> {
    let shapes = match positions {
        Positions::F32(points) => qsmesh::triangle_quality(points, triangles, Parameter::Shape),
        Positions::F64(points) => qsmesh::triangle_quality(points, triangles, Parameter::Shape),
    };
    shapes.map_err(|error| Failure::new(error.to_string()))
}

/// The least; 0 for a face without triangles.
fn worst(shapes: &[f64]) -> f64 {
    shapes.iter().copied().reduce(f64::min).unwrap_or(0.0)
}

/// The least shape around each vertex; 1 for one in no triangle.
fn around_vertices(shapes: &[f64], triangles: &[[u32; 3]], count: usize) -> Vec<f64> {
    let mut around = vec![1.0; count];
    for (triangle, &shape) in triangles.iter().zip(shapes) {
        for &vertex in triangle {
            let worst: &mut f64 = &mut around[vertex as usize];
            *worst = worst.min(shape);
        }
    }
    around
}
