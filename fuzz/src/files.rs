//! The command's readers and writers, which are no library: the same sources, compiled once more, without the part that
//! touches the disk.
#![allow(dead_code, reason = "the command uses what the targets do not")]

#[path = "../../src/bin/qsmesh/files/faces.rs"]
pub mod faces;
#[path = "../../src/bin/qsmesh/files/normals.rs"]
pub mod normals;
#[path = "../../src/bin/qsmesh/files/obj/mod.rs"]
pub mod obj;
#[path = "../../src/bin/qsmesh/files/off.rs"]
pub mod off;
#[path = "../../src/bin/qsmesh/files/paint.rs"]
pub mod paint;
#[path = "../../src/bin/qsmesh/files/ply/mod.rs"]
pub mod ply;
#[path = "../../src/bin/qsmesh/files/positions.rs"]
pub mod positions;
#[path = "../../src/bin/qsmesh/files/revision.rs"]
pub mod revision;
#[path = "../../src/bin/qsmesh/files/seams.rs"]
pub mod seams;
#[path = "../../src/bin/qsmesh/files/splice.rs"]
pub mod splice;
#[path = "../../src/bin/qsmesh/files/stl.rs"]
pub mod stl;
#[path = "../../src/bin/qsmesh/files/text.rs"]
pub mod text;
