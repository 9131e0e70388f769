//! The command `qsmesh`: better triangles for mesh files.
#![forbid(unsafe_code)]

mod arguments;
mod colormap;
mod console;
mod demo_command;
mod failure;
mod files;
mod improve_command;
mod isosurface;
mod json;
mod measure_command;
mod output;
mod plot;
mod quality_colors;
mod smooth_command;
mod table;

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Smooth(arguments) => smooth_command::run(&arguments),
        Command::Improve(arguments) => improve_command::run(&arguments),
        Command::CollapseTails(arguments) => improve_command::run_without_sweeps(&arguments),
        Command::Measure(arguments) => measure_command::run(&arguments),
        Command::Demo(arguments) => demo_command::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            console::complain(&failure);
            ExitCode::FAILURE
        }
    }
}
