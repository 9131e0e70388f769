//! Edges along which what belongs to the faces parts.

use super::layout::Layout;
use super::rows::walk;
use crate::failure::Result;
use crate::files::faces::Faces;
use crate::files::seams::{self, Values};

/// Edges along which texture coordinates or materials part, all faces being triangles.
pub fn find(bytes: &[u8], layout: &Layout, faces: &Faces) -> Result<Vec<[u32; 2]>> {
    let (lists, numbers) = (layout.corner_lists(), layout.regions());
    let Some((face, _)) = layout.face.filter(|_| !lists.is_empty() || !numbers.is_empty()) else {
        return Ok(Vec::new());
    };
    let (mut corners, mut regions) = (Vec::new(), Vec::new());
    let (mut places, mut materials) = (Values::default(), Values::default());
    walk(bytes, layout, |element, row| {
        if element != face {
            return Ok(());
        }
        for corner in 0..3 {
            let mut value = Vec::new();
            for &list in &lists {
                let each = row.of(list).len() / 3;
                row.of(list)[each * corner..each * (corner + 1)].iter().for_each(|place| {
                    value.extend_from_slice(&bytes[place.clone()]);
                    value.push(b' ');
                });
            }
            corners.push(places.number(&value));
        }
        let values: Vec<_> = numbers.iter().flat_map(|&p| row.of(p)).map(|place| &bytes[place.clone()]).collect();
        regions.push(materials.number(&values.join(&b' ')));
        Ok(())
    })?;
    Ok(seams::find(&faces.triangles, &corners, &regions))
}
