//! What must hold of every result.

use qsmesh::{Error, Measurement, Options, Sources};

/// The errors that a mesh with finite coordinates and indices in range may meet.
pub fn assert_allowed(error: &Error) {
    let about_arguments = matches!(error, Error::BadOption { .. } | Error::FeatureEdgeOutOfRange { .. });
    assert!(about_arguments || *error == Error::Cancelled, "{error}");
}

pub fn assert_finite(positions: &[[f64; 3]]) {
    assert!(positions.iter().flatten().all(|x| x.is_finite()), "a coordinate is not finite");
}

/// Figures are numbers, if not always finite ones: an area of coordinates of 1e300 is infinite.
pub fn assert_figures(before: &Measurement, after: &Measurement, change: f64, deviation: f64) {
    for measured in [before, after] {
        let figures = [measured.volume, measured.area, measured.shape.min, measured.edge_ratio.mean];
        assert!(figures.iter().all(|x| !x.is_nan()), "a figure is not a number: {figures:?}");
    }
    assert!(!change.is_nan() && deviation >= 0.0, "change {change}, deviation {deviation}");
}

/// No star's worst triangle falls below the floor, or falls further.
pub fn assert_no_worse(before: &Measurement, after: &Measurement, options: &Options) {
    let least = before.shape.min.min(options.quality_floor);
    assert!(after.shape.min >= least - 1e-9, "{} became {}", before.shape.min, after.shape.min);
}

/// The bits of vertices that may not move.
pub fn assert_bits(before: &[[f64; 3]], after: &[[f64; 3]], stays: impl Fn(usize) -> bool) {
    let changed = |v: usize| before[v].map(f64::to_bits) != after[v].map(f64::to_bits);
    let moved = (0..before.len()).find(|&v| stays(v) && changed(v));
    assert_eq!(moved, None, "a vertex that had to stay has other bits");
}

/// Every output element names an input element.
pub fn assert_sources(sources: &Sources, vertices: usize, before: &[[u32; 3]], after: &[[u32; 3]]) {
    assert!(sources.vertex.windows(2).all(|w| w[0] < w[1]), "vertices have changed their order");
    assert!(sources.vertex.iter().all(|&v| (v as usize) < vertices));
    assert_eq!((sources.triangle.len(), sources.corner.len()), (after.len(), 3 * after.len()));
    assert!(sources.triangle.iter().all(|&t| (t as usize) < before.len()));
    for (corner, &source) in sources.corner.iter().enumerate() {
        let vertex = after.as_flattened()[corner] as usize;
        assert_eq!(before.as_flattened()[source as usize], sources.vertex[vertex], "corner {corner} is of another vertex");
    }
}
