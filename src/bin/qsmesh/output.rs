//! The files that a subcommand writes: the mesh, and a plot where one is asked for.

use std::path::Path;

use qsmesh::{Measurement, Report};

use crate::arguments::{FileArguments, Shown};
use crate::failure::Result;
use crate::files::{Format, MeshFile, Revision, Target};
use crate::plot::{Picture, Plot, State};
use crate::quality_colors;

/// Places that were looked at before the work begins.
pub struct Output {
    target: Target,
    plot: Option<Plot>,
    quality_colors: Option<Shown>,
}

impl Output {
    /// Looks at the places.
    pub fn prepare(files: &FileArguments) -> Result<Self> {
        let target = Target::prepare(&files.output)?;
        let plot = files.plot.as_ref().map(Plot::prepare).transpose()?;
        Ok(Self { target, plot, quality_colors: files.quality_colors })
    }

    /// What the mesh file is to hold.
    pub fn format(&self) -> Format {
        self.target.format()
    }

    /// Writes what has become of `file`, which lies at `input`. The plot is whole before the mesh file is replaced and
    /// is put in its place after it. Returns what to tell the user.
    pub fn write(&self, input: &Path, file: &MeshFile, revision: &Revision, report: &Report) -> Result<Vec<String>> {
        let paint = self.quality_colors.map(|shown| quality_colors::paint(shown, file, revision)).transpose()?;
        let states = [
            State {
                name: "before",
                positions: &file.positions,
                triangles: &file.faces.triangles,
                measurement: &report.before,
            },
            State {
                name: "after",
                positions: &revision.positions,
                triangles: revision.triangles(&file.faces),
                measurement: &report.after,
            },
        ];
        let title = title(input, &[&report.before, &report.after]);
        let draw = |plot: &Plot| plot.stage(&Picture::new(&title, &states)?);
        let drawn = self.plot.as_ref().map(draw).transpose()?;
        let notes = file.save(&self.target, revision, paint.as_ref())?;
        drawn.map_or(Ok(()), |drawn| drawn.put())?;
        Ok(notes)
    }
}

/// The mesh's name and how many triangles it has, in each state where that differs.
pub fn title(input: &Path, states: &[&Measurement]) -> String {
    let name = input.file_name().unwrap_or(input.as_os_str()).to_string_lossy();
    let mut counts: Vec<_> = states.iter().map(|state| grouped(state.triangles)).collect();
    counts.dedup();
    format!("{name}: {} triangles", counts.join(" → "))
}

/// With a comma before every three digits.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use qsmesh::Measurement;

    use super::title;

    #[test]
    fn counts_that_agree_are_told_once() {
        let [few, many] = [999, 1_096_966].map(|triangles| Measurement { triangles, ..Measurement::default() });
        assert_eq!(title(Path::new("in/a.ply"), &[&few, &few]), "a.ply: 999 triangles");
        assert_eq!(title(Path::new("b.obj"), &[&many, &few]), "b.obj: 1,096,966 → 999 triangles");
    }
}
