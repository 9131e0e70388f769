//! What fuzzing has found, as small as it can be.

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, smooth};

use crate::shapes;

/// The volume overflows, and the difference of two infinite ones is no number.
#[test]
fn a_volume_that_no_number_can_hold_has_no_change() {
    let (mut positions, triangles) = shapes::scaled(shapes::spindle(12), 1e300);
    let report = smooth(&mut positions, &triangles, &Options::default(), &Constraints::default(), &mut silent);
    let report = report.expect("a result");
    assert!(report.moved > 0 && report.before.volume.is_infinite());
    assert_eq!(report.volume_relative_change, 0.0);
}
