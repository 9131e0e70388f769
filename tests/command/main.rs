//! The command as its users meet it: files in, files out, exit codes and messages.
#![cfg(feature = "cli")]

mod arguments;
mod conversion;
mod demo;
mod errors;
mod improve;
mod meshes;
mod obj;
mod off;
mod output;
mod plot;
mod ply;
mod quality_colors;
mod stl;
mod workspace;
