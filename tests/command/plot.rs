//! Pictures of the histograms.

use std::io::Cursor;

use crate::meshes::{grid, sphere, torus};
use crate::workspace::Workspace;

/// All texts of an SVG file.
fn texts(svg: &str) -> Vec<String> {
    let inside = |part: &str| part.split_once('>').unwrap().1.split_once("</text>").unwrap().0.trim().to_string();
    svg.split("<text").skip(1).map(inside).collect()
}

fn assert_says(texts: &[String], expected: &str) {
    assert!(texts.iter().any(|text| text.contains(expected)), "{expected} is missing in {texts:#?}");
}

#[test]
fn the_svg_has_title_labels_and_the_figures_of_both_states() {
    let workspace = Workspace::with(&[("torus.off", torus().off().as_bytes())]);
    for subcommand in ["smooth", "improve", "collapse-tails"] {
        let report = workspace.report(subcommand, "torus.off", "b.off", &["--plot", "p.svg"]);
        let texts = texts(&workspace.text("p.svg"));
        assert_says(&texts, "torus.off: 1,944");
        for label in ["longest over shortest edge", "angle of a triangle (degrees)", "triangles (% per 1°)"] {
            assert_says(&texts, label);
        }
        for state in ["before", "after"] {
            let figure = |parameter: &str, name: &str| report[state][parameter][name].as_f64().unwrap();
            let (mean, variance) = (figure("edge_ratio", "mean"), figure("edge_ratio", "variance"));
            assert_says(&texts, &format!("{state}: mean {mean:.3}, variance {variance:.3}"));
            assert_says(&texts, &format!("{state}: mean {:.2}°", figure("min_angle", "mean")));
            assert_says(&texts, &format!("greatest {:.2}°", figure("max_angle", "max")));
        }
    }
    assert_eq!(workspace.names(), ["b.off", "p.svg", "torus.off"]);
}

/// Share of the picture that has the colour, in percent.
fn share(pixels: &[u8], color: [u8; 3]) -> f64 {
    100.0 * pixels.chunks_exact(3).filter(|pixel| *pixel == color).count() as f64 / (pixels.len() / 3) as f64
}

#[test]
fn the_png_shows_an_area_a_line_and_text() {
    let workspace = Workspace::with(&[("a.off", torus().off().as_bytes())]);
    workspace.done(&["smooth", "a.off", "-o", "b.off", "--plot", "p.PNG"]);
    let mut reader = png::Decoder::new(Cursor::new(workspace.bytes("p.PNG"))).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((frame.width, frame.height, pixels.len()), (3240, 1080, 3 * 3240 * 1080));
    // Orange at half strength on white; blue; ink, in axes and letters.
    let (area, line, ink) = (share(&pixels, [243, 207, 128]), share(&pixels, [0, 86, 140]), share(&pixels, [30; 3]));
    assert!(area > 2.0 && line > 0.2 && ink > 0.5, "area {area} %, line {line} %, ink {ink} %");
    assert!(share(&pixels, [255; 3]) > 50.0);
}

#[test]
fn the_same_call_draws_the_same_picture() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    for extension in ["svg", "png"] {
        let names = ["p", "q"].map(|name| format!("{name}.{extension}"));
        for name in &names {
            workspace.done(&["smooth", "a.off", "-o", "b.off", "--plot", name]);
        }
        assert_eq!(workspace.bytes(&names[0]), workspace.bytes(&names[1]));
    }
}

#[test]
fn without_a_sweep_both_states_have_the_same_outline() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    // The outlines of one panel after the other, each of the area and then of the line.
    let outlines = |sweeps: &str| {
        workspace.done(&["smooth", "a.off", "-o", "b.off", "--plot", "p.svg", "--iterations", sweeps]);
        let svg = workspace.text("p.svg");
        let drawn = svg.lines().filter(|line| line.starts_with("<polyline") && line.len() > 500);
        drawn.map(|line| line.split_once("points=\"").unwrap().1.to_string()).collect::<Vec<_>>()
    };
    let (still, moved) = (outlines("0"), outlines("2"));
    assert_eq!((still.len(), moved.len()), (6, 6));
    for panel in 0..3 {
        assert_eq!(still[2 * panel], still[2 * panel + 1]);
        assert_ne!(moved[2 * panel], moved[2 * panel + 1]);
    }
}

#[test]
fn triangles_that_no_axis_holds_are_told() {
    let text = "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n30 0.1 0\n3 0 1 2\n3 0 3 1\n3 1 2 4\n";
    let workspace = Workspace::with(&[("a.off", text.as_bytes())]);
    workspace.done(&["smooth", "a.off", "-o", "b.off", "--plot", "p.svg"]);
    let texts = texts(&workspace.text("p.svg"));
    assert_says(&texts, "1 infinite");
    assert_says(&texts, "≥ 10: 66.667 % before, 66.667 % after");
    assert_says(&texts, "without an angle: 33.333 % before, 33.333 % after");
}

#[test]
fn measure_draws_one_state() {
    let name = "a <b> & c.off";
    let workspace = Workspace::with(&[(name, grid().off().as_bytes())]);
    workspace.done(&["measure", name, "--plot", "p.svg"]);
    let texts = texts(&workspace.text("p.svg"));
    assert_says(&texts, "a &lt;b&gt; &amp; c.off: 98 triangles");
    assert_says(&texts, "all: mean");
    assert!(!texts.iter().any(|text| text.contains("before") || text.contains("after")), "{texts:?}");
    assert_eq!(workspace.names(), [name, "p.svg"]);
}

#[test]
fn a_mesh_without_triangles_has_empty_axes() {
    let workspace = Workspace::with(&[("a.off", b"OFF\n1 0 0\n0 0 0\n")]);
    for plot in ["p.svg", "p.png"] {
        workspace.done(&["smooth", "a.off", "-o", "b.off", "--plot", plot]);
    }
    assert_says(&texts(&workspace.text("p.svg")), "a.off: 0 triangles");
}

#[test]
fn another_extension_is_wrong_usage() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    for plot in ["p.pdf", "p", "p.off"] {
        for arguments in [&["smooth", "a.off", "-o", "b.off"][..], &["measure", "a.off"]] {
            let run = workspace.run(&[arguments, &["--plot", plot]].concat());
            assert_eq!(run.code, 2, "{}", run.stderr);
            for word in ["--plot", ".svg", ".png"] {
                assert!(run.stderr.contains(word), "{}", run.stderr);
            }
        }
    }
    assert_eq!(workspace.names(), ["a.off"]);
}

#[test]
fn a_place_that_cannot_be_written_is_told_before_the_work() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes()), ("b.off", b"old")]);
    std::fs::create_dir(workspace.path("p.svg")).unwrap();
    for (plot, expected) in [("missing/p.svg", "missing does not exist"), ("p.svg", "is not a plain file")] {
        let message = workspace.refused(&["smooth", "a.off", "-o", "b.off", "--plot", plot]);
        assert!(message.contains(plot) && message.contains(expected), "{message}");
        assert_eq!(workspace.bytes("b.off"), b"old");
    }
}

#[test]
fn a_mesh_that_is_refused_leaves_the_old_picture() {
    let workspace = Workspace::with(&[("a.off", b"OFF\n1 0 0\nnan 0 0\n"), ("p.svg", b"old")]);
    workspace.refused(&["smooth", "a.off", "-o", "b.off", "--plot", "p.svg"]);
    workspace.refused(&["measure", "a.off", "--plot", "p.svg"]);
    assert_eq!(workspace.bytes("p.svg"), b"old");
}
