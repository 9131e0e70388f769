//! Collapsed tails: whatever the file says about a vertex, a face or a corner is found again at the right place.

use std::collections::HashMap;
use std::io::Cursor;

use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Ply, Property};

use crate::meshes::{ACROSS, AROUND, Mesh, grid, sphere, torus, torus_texture};
use crate::workspace::Workspace;

/// Work enough for the tail: thresholds that the torus does not meet.
const HARSH: [&str; 6] = ["--feature-angle", "off", "--tail-min-angle", "25", "--tail-max-angle", "115"];
const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// What a file that came from the torus holds: vertices and faces say which one they are.
struct Found {
    vertices: Vec<(usize, [f64; 3])>,
    faces: Vec<(usize, [usize; 3])>,
    /// Of the corners, if the format has them.
    textures: Vec<[[f64; 2]; 3]>,
}

impl Found {
    /// The vertices of a face by what they say which they are.
    fn names(&self, face: usize) -> [u32; 3] {
        self.faces[face].1.map(|v| self.vertices[v].0 as u32)
    }

    /// Of the torus without sweeps: most vertices are where they were, so their places tell which they are.
    fn check(&self, report: &serde_json::Value) {
        let mesh = torus();
        let count = |stage: &str, key: &str| report[stage][key].as_u64().unwrap() as usize;
        assert_eq!((self.vertices.len(), self.faces.len()), (count("after", "vertices"), count("after", "triangles")));
        assert!(count("tail", "vertices_removed") > 3 && count("tail", "flipped") > 3, "{report}");
        self.check_vertices(&mesh);
        self.check_faces(&mesh);
        self.check_textures();
    }

    fn check_vertices(&self, mesh: &Mesh) {
        let bits = |point: &[f64; 3]| point.map(f64::to_bits);
        let places: HashMap<_, _> = mesh.points.iter().enumerate().map(|(v, point)| (bits(point), v)).collect();
        let unmoved: Vec<_> =
            self.vertices.iter().filter_map(|(v, point)| Some((*v, *places.get(&bits(point))?))).collect();
        assert!(unmoved.iter().all(|(name, place)| name == place), "a vertex took over what belongs to another");
        assert!(unmoved.len() > mesh.points.len() / 5, "only {} vertices have stayed where they were", unmoved.len());
        assert!(self.vertices.is_sorted_by(|a, b| a.0 < b.0), "the order of the vertices changed");
    }

    fn check_faces(&self, mesh: &Mesh) {
        let turned = |[a, b, c]: [u32; 3]| {
            if a < b && a < c {
                [a, b, c]
            } else if b < c {
                [b, c, a]
            } else {
                [c, a, b]
            }
        };
        let whole: HashMap<_, _> =
            mesh.faces.iter().enumerate().map(|(f, face)| (turned([face[0], face[1], face[2]]), f)).collect();
        let (mut same, mut astray) = (0, 0);
        for face in 0..self.faces.len() {
            let (source, names) = (self.faces[face].0, self.names(face));
            if let Some(&former) = whole.get(&turned(names)) {
                // A face may have gone and come back in its neighbour's place, but not where no vertex has moved.
                let rests = self.faces[face].1.iter().all(|&v| mesh.points[self.vertices[v].0] == self.vertices[v].1);
                assert!(source == former || !rests, "face {former} has what belongs to {source}");
                same += usize::from(source == former);
                astray += usize::from(source != former);
            }
            assert!(names.iter().any(|name| mesh.faces[source].contains(name)), "face {face} is far from its source");
        }
        assert!(astray <= mesh.faces.len() / 500, "{astray} faces have what belongs to others");
        assert!(same > mesh.faces.len() / 2 && same < self.faces.len(), "{same} faces stayed");
        assert!(self.faces.is_sorted_by(|a, b| a.0 <= b.0), "faces have left the places of their sources");
    }

    fn check_textures(&self) {
        for (face, texture) in self.textures.iter().enumerate() {
            let names = self.names(face);
            for (name, corner) in names.iter().zip(texture) {
                let own = [*name as usize % AROUND, *name as usize / AROUND];
                for (axis, circle) in [AROUND, ACROSS].into_iter().enumerate() {
                    let k = (corner[axis] * 64.0) as usize;
                    assert_eq!(k % circle, own[axis], "a corner at vertex {name} has the texture of another");
                }
            }
            for axis in [0, 1] {
                let along = texture.map(|corner| corner[axis]);
                let spread = along.iter().fold(0.0, |w: f64, x| along.iter().fold(w, |w, y| w.max(x - y)));
                assert!(spread < 0.2, "face {face} lies on both sides of the seam: {texture:?}");
            }
        }
    }
}

/// A number that says which record it stands in, told apart from all others.
fn number(text: &str) -> usize {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

/// The torus with a weight and texture coordinates for everything; comments number the faces. `index` writes the index
/// of a vertex (from 0) of which there are so many.
fn torus_obj(index: impl Fn(usize, usize) -> String) -> String {
    let mesh = torus();
    let mut text = "mtllib a.mtl\no ring\n".to_string();
    for (v, [x, y, z]) in mesh.points.iter().enumerate() {
        text += &format!("v {x} {y} {z} {v} 0 1\n");
    }
    let mut records: HashMap<[u64; 2], usize> = HashMap::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        if f % mesh.faces.len() == 0 {
            text += "g lower\nusemtl red\ns 1\n";
        }
        if f == mesh.faces.len() / 2 {
            text += "g upper half\n# the other material\nusemtl green\ns off\n";
        }
        let mut corners = String::new();
        for (v, corner) in face.iter().zip(torus_texture(face)) {
            let next = records.len();
            let record = *records.entry(corner.map(f64::to_bits)).or_insert_with(|| {
                text += &format!("vt {} {}\n", corner[0], corner[1]);
                next
            });
            corners += &format!(" {}/{}", index(*v as usize, mesh.points.len()), record + 1);
        }
        text += &format!("f{corners} # {f}\n");
    }
    text + "# end\n"
}

fn positive(v: usize, _: usize) -> String {
    (v + 1).to_string()
}

fn found_in_obj(text: &str) -> Found {
    let mut found = Found { vertices: Vec::new(), faces: Vec::new(), textures: Vec::new() };
    let mut records: Vec<[f64; 2]> = Vec::new();
    let mut textures = Vec::new();
    for line in text.lines() {
        let words: Vec<_> = line.split(' ').collect();
        match words[0] {
            "v" => {
                let point = [1, 2, 3].map(|k| words[k].parse().unwrap());
                assert_eq!(words[5..], ["0", "1"]);
                found.vertices.push((number(words[4]), point));
            }
            "vt" => records.push([1, 2].map(|k| words[k].parse().unwrap())),
            "f" => {
                let corners = [1, 2, 3].map(|k| words[k].split_once('/').unwrap());
                let vertex = |text: &str| match text.strip_prefix('-') {
                    Some(back) => found.vertices.len() - number(back),
                    None => number(text) - 1,
                };
                found.faces.push((number(words[5]), corners.map(|(v, _)| vertex(v))));
                textures.push(corners.map(|(_, vt)| number(vt) - 1));
            }
            _ => {}
        }
    }
    // A face may name a record that comes after it.
    found.textures = textures.into_iter().map(|corners| corners.map(|record| records[record])).collect();
    found
}

#[test]
fn obj_keeps_weights_textures_and_comments() {
    let workspace = Workspace::with(&[("a.obj", torus_obj(positive).as_bytes())]);
    let report = workspace.report("collapse-tails", "a.obj", "b.obj", &HARSH);
    let after = workspace.text("b.obj");
    let found = found_in_obj(&after);
    found.check(&report);
    assert_eq!(found.textures.len(), found.faces.len());
    // With sweeps before, the same holds but for the places of the vertices.
    workspace.report("improve", "a.obj", "c.obj", &HARSH);
    let swept = found_in_obj(&workspace.text("c.obj"));
    swept.check_faces(&torus());
    swept.check_textures();
}

#[test]
fn general_flips_carry_everything_too() {
    let workspace = Workspace::with(&[("a.obj", torus_obj(positive).as_bytes())]);
    let report = workspace.report("improve", "a.obj", "b.obj", &[&HARSH[..], &["--flips"]].concat());
    assert!(report["tail"]["general_flips"].as_u64().unwrap() > 100);
    let found = found_in_obj(&workspace.text("b.obj"));
    found.check_faces(&torus());
    found.check_textures();
}

#[test]
fn obj_faces_stay_under_their_records() {
    let before = torus_obj(positive);
    let workspace = Workspace::with(&[("a.obj", before.as_bytes())]);
    workspace.report("collapse-tails", "a.obj", "b.obj", &HARSH);
    let after = workspace.text("b.obj");
    let others = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.starts_with("v ") && !line.starts_with('f')).map(String::from).collect()
    };
    assert_eq!(others(&after), others(&before));
    let (lower, upper) = after.split_once("usemtl green").unwrap();
    let half = torus().faces.len() / 2;
    let names = |text: &str| -> Vec<usize> {
        text.lines().filter(|line| line.starts_with('f')).map(|line| number(line.split_once("# ").unwrap().1)).collect()
    };
    assert!(names(lower).iter().all(|&f| f < half) && names(upper).iter().all(|&f| f >= half));
    // The border between the materials is where it was: on two circles.
    let found = found_in_obj(&after);
    for face in 0..found.faces.len() {
        let rows = found.names(face).map(|v| v as usize / AROUND);
        let is_lower = found.faces[face].0 < half;
        let beyond = rows.iter().filter(|&&j| if is_lower { j > ACROSS / 2 } else { j < ACROSS / 2 && j > 0 }).count();
        assert_eq!(beyond, 0, "face {face} crosses into the other material: {rows:?}");
    }
}

/// The torus whose faces are of two kinds by turns, so that they part along every edge; `face` writes one.
fn parted(header: &str, vertex: impl Fn(&[f64; 3]) -> String, face: impl Fn(&[u32], usize) -> String) -> String {
    let mesh = torus();
    let vertices: String = mesh.points.iter().map(vertex).collect();
    let faces: String = mesh.faces.iter().enumerate().map(|(f, corners)| face(corners, f % 2)).collect();
    format!("{header}{vertices}{faces}")
}

#[test]
fn nothing_is_made_across_seams_and_borders() {
    let obj = |[x, y, z]: &[f64; 3]| format!("v {x} {y} {z}\n");
    let corners = |face: &[u32], more: &str| face.iter().map(|v| format!(" {}{more}", v + 1)).collect::<String>();
    let under = |keyword: &'static str| {
        parted("", obj, move |face, kind| format!("{keyword} {kind}\nf{}\n", corners(face, "")))
    };
    let texture =
        parted("vt 0 0\nvt 1 1\n", obj, |face, kind| format!("f{}\n", corners(face, &format!("/{}", kind + 1))));
    let ply = |property: &str, value: fn(usize) -> String| {
        let header = format!(
            "ply\nformat ascii 1.0\nelement vertex 972\nproperty double x\nproperty double y\nproperty double z\n\
             element face 1944\n{property}\nproperty list uchar int vertex_indices\nend_header\n"
        );
        let face = |face: &[u32], kind| format!("{} 3 {} {} {}\n", value(kind), face[0], face[1], face[2]);
        parted(&header, |[x, y, z]| format!("{x} {y} {z}\n"), face)
    };
    let files = [
        ("usemtl.obj", under("usemtl")),
        ("g.obj", under("g")),
        ("s.obj", under("s")),
        ("o.obj", under("o")),
        ("texture.obj", texture),
        ("number.ply", ply("property int texnumber", |kind| kind.to_string())),
        ("texture.ply", ply("property list uchar float texcoord", |kind| format!("6{}", format!(" {kind}").repeat(6)))),
    ];
    for (name, text) in files {
        let workspace = Workspace::with(&[(name, text.as_bytes())]);
        let output = format!("new_{name}");
        let report = workspace.report("collapse-tails", name, &output, &[&HARSH[..], &["--flips"]].concat());
        let leftovers = report["tail"]["leftovers"].as_array().unwrap();
        assert!(leftovers.len() > 20, "{name} has {} leftovers", leftovers.len());
        assert!(leftovers.iter().all(|leftover| leftover["reason"] == "feature"), "{name}");
        assert!(workspace.text(&output) == text, "{name} changed");
    }
    // The same under names that say nothing.
    let workspace = Workspace::with(&[("a.obj", under("usemap").as_bytes())]);
    let report = workspace.report("collapse-tails", "a.obj", "b.obj", &HARSH);
    assert!(report["tail"]["vertices_removed"].as_u64().unwrap() > 3);
}

#[test]
fn obj_text_stays_where_nothing_before_it_has_gone() {
    let before = torus_obj(|v, _| format!("{:03}", v + 1));
    let workspace = Workspace::with(&[("a.obj", before.as_bytes())]);
    workspace.report("collapse-tails", "a.obj", "b.obj", &HARSH);
    let after = workspace.text("b.obj");
    let found = found_in_obj(&after);
    let gap = found.vertices.iter().enumerate().find(|(new, (former, _))| new != former).unwrap().0;
    let rows: HashMap<_, _> = before.lines().filter_map(|line| Some((line.split_once("# ")?.1, line))).collect();
    let mut kept = 0;
    for (face, line) in after.lines().filter(|line| line.starts_with('f')).enumerate() {
        let former: Vec<_> = torus().faces[found.faces[face].0].clone();
        if found.names(face)[..] == former && former.iter().all(|&v| (v as usize) < gap) {
            assert_eq!(line, rows[line.split_once("# ").unwrap().1]);
            kept += 1;
        }
    }
    assert!(kept > 5, "only {kept} faces lie before the first gap, at vertex {gap}");
}

#[test]
fn obj_indices_may_count_backwards() {
    let backward = torus_obj(|v, count| format!("-{}", count - v));
    let workspace = Workspace::with(&[("a.obj", torus_obj(positive).as_bytes()), ("b.obj", backward.as_bytes())]);
    workspace.report("collapse-tails", "a.obj", "c.obj", &HARSH);
    workspace.report("collapse-tails", "b.obj", "d.obj", &HARSH);
    let (forward, backward) = (found_in_obj(&workspace.text("c.obj")), found_in_obj(&workspace.text("d.obj")));
    assert_eq!(backward.faces, forward.faces);
    assert!(workspace.text("d.obj").lines().filter(|line| line.starts_with('f')).all(|line| line.starts_with("f -")));
}

/// Vertices of the torus that the tail stage removes.
fn removed(found: &Found) -> Vec<usize> {
    let stays = |v: &usize| found.vertices.iter().any(|(name, _)| name == v);
    (0..AROUND * ACROSS).filter(|v| !stays(v)).collect()
}

#[test]
fn obj_lines_and_points_are_renumbered_or_dropped_with_a_note() {
    let plain = torus_obj(positive);
    let workspace = Workspace::with(&[("a.obj", plain.as_bytes())]);
    workspace.report("collapse-tails", "a.obj", "b.obj", &HARSH);
    let found = found_in_obj(&workspace.text("b.obj"));
    let removed = removed(&found);
    let last = AROUND * ACROSS - 1;
    assert!(!removed.contains(&last) && !removed.contains(&0));
    let more = format!(
        "l 1/1 {0}/2 -1\np {1} 1\nsurf 0 1 0 1 {1}/1\nparm u 0 1\nend\ncurv 0 1 1 {0}\nend\nl 1 {1}\n",
        last + 1,
        removed[0] + 1
    );
    std::fs::write(workspace.path("c.obj"), plain + &more).unwrap();
    let run = workspace.done(&[&["collapse-tails", "c.obj", "-o", "d.obj"], &HARSH[..]].concat());
    let after = workspace.text("d.obj");
    let (_, tail) = after.split_once("# end\n").unwrap();
    let now = found.vertices.len();
    assert_eq!(tail, format!("l 1/1 {now}/2 -1\ncurv 0 1 1 {now}\nend\n"));
    assert!(run.stderr.contains("note: 3 lines, points or free-form elements were dropped"), "{}", run.stderr);
}

#[test]
fn one_obj_normal_a_vertex_goes_with_its_vertex() {
    let mesh = torus();
    let mut text = mesh.obj().lines().filter(|line| line.starts_with('v')).fold(String::new(), |t, l| t + l + "\n");
    (0..mesh.points.len()).for_each(|v| text += &format!("vn 1 0 0 # {v}\n"));
    for face in &mesh.faces {
        text += &face.iter().fold("f".to_string(), |line, v| format!("{line} {0}//{0}", v + 1));
        text.push('\n');
    }
    let workspace = Workspace::with(&[("a.obj", text.as_bytes()), ("b.obj", torus_obj(positive).as_bytes())]);
    workspace.report("collapse-tails", "a.obj", "c.obj", &HARSH);
    let after = workspace.text("c.obj");
    let lines = |keyword: &str| -> Vec<Vec<&str>> {
        let of = |line: &&str| line.split(' ').next() == Some(keyword);
        after.lines().filter(of).map(|line| line.split(' ').collect()).collect()
    };
    let (points, normals) = (lines("v"), lines("vn"));
    assert_eq!(points.len(), normals.len());
    assert!(points.len() < mesh.points.len());
    let vector = |words: &[&str]| [1, 2, 3].map(|k| words[k].parse::<f64>().unwrap());
    for (point, normal) in points.iter().zip(&normals) {
        let ([x, y, z], [a, b, c]) = (vector(point), vector(normal));
        let middle = 3.0 / x.hypot(y);
        let cosine = (x - middle * x) * a + (y - middle * y) * b + z * c;
        assert!(cosine > 0.7, "the normal {normal:?} at {point:?} does not point outward");
        let place = mesh.points.iter().position(|p| *p == [x, y, z]);
        assert!(place.is_none_or(|v| v.to_string() == normal[5]), "the normal of another vertex stayed");
    }
    for face in lines("f") {
        assert!(face[1..].iter().all(|corner| corner.split_once("//").is_some_and(|(v, n)| v == n)), "{face:?}");
    }
}

fn torus_off() -> String {
    let mesh = torus();
    let mut text = format!("COFF # torus\n{} {} 2916 # counts\n", mesh.points.len(), mesh.faces.len());
    for (v, [x, y, z]) in mesh.points.iter().enumerate() {
        text += &format!("{x} {y} {z} {v} 0 0 255\n");
    }
    for (f, face) in mesh.faces.iter().enumerate() {
        text += &format!("3 {} {} {} {f} 0 1\n", face[0], face[1], face[2]);
    }
    text + "# end"
}

#[test]
fn off_keeps_colours_and_counts_right() {
    let workspace = Workspace::with(&[("a.off", torus_off().as_bytes())]);
    let report = workspace.report("collapse-tails", "a.off", "b.off", &HARSH);
    let after = workspace.text("b.off");
    let mut rows = after.lines().map(|line| line.split(' ').collect::<Vec<_>>());
    assert_eq!(rows.next().unwrap(), ["COFF", "#", "torus"]);
    let counts = rows.next().unwrap();
    let [vertices, faces, edges] = [0, 1, 2].map(|k| number(counts[k]));
    // A torus has as many vertices and faces as edges.
    assert_eq!((vertices + faces, &counts[3..]), (edges, &["#", "counts"][..]));
    let vertex = |words: Vec<&str>| (number(words[3]), [0, 1, 2].map(|k| words[k].parse().unwrap()));
    let face = |words: Vec<&str>| (number(words[4]), [1, 2, 3].map(|k| number(words[k])));
    let vertices = rows.by_ref().take(vertices).map(vertex).collect();
    let faces = rows.by_ref().take(faces).map(face).collect();
    Found { vertices, faces, textures: Vec::new() }.check(&report);
    assert_eq!(rows.next().unwrap(), ["#", "end"]);
    assert!(after.ends_with("# end"));
}

#[test]
fn leftovers_are_named_by_their_place_in_the_new_file() {
    let workspace = Workspace::with(&[("a.off", torus_off().as_bytes())]);
    let more = ["--tail-min-angle", "44", "--tail-max-angle", "95", "--tail-edge-ratio", "9", "--feature-angle", "off"];
    let report = workspace.report("improve", "a.off", "b.off", &more);
    let after = workspace.text("b.off");
    let rows: Vec<Vec<f64>> = after
        .lines()
        .skip(2)
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect())
        .collect();
    let (points, faces) = rows.split_at(report["after"]["vertices"].as_u64().unwrap() as usize);
    let is_tail = |face: &Vec<f64>| {
        let corners = [1, 2, 3].map(|k| &points[face[k] as usize]);
        let side = |a: usize, b: usize| (0..3).map(|k| (corners[a][k] - corners[b][k]).powi(2)).sum::<f64>();
        let mut sides = [side(0, 1), side(1, 2), side(2, 0)];
        sides.sort_by(f64::total_cmp);
        let [a, b, c] = sides;
        let angle = |opposite: f64, p: f64, q: f64| ((p + q - opposite) / (2.0 * (p * q).sqrt())).acos().to_degrees();
        angle(a, b, c) < 44.0 || angle(c, a, b) > 95.0
    };
    let tails: Vec<usize> = (0..faces.len()).filter(|&face| is_tail(&faces[face])).collect();
    let leftovers = report["tail"]["leftovers"].as_array().unwrap();
    let named: Vec<_> = leftovers.iter().map(|leftover| leftover["triangle"].as_u64().unwrap() as usize).collect();
    assert_eq!(named, tails);
    assert!(!tails.is_empty());
}

const HEADER: &str = "ply\nformat ENCODING 1.0\ncomment one\nelement vertex 972\nproperty uchar red\n\
    property list uchar int name\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n\
    property float ny\nproperty double nz\nelement edge EDGES\nproperty int vertex1\nproperty uchar crease\n\
    property uint vertex2\nelement camera 1\nproperty float vertex1\nelement face 1944\nproperty int name\n\
    property list uchar float texcoord\nproperty list uint8 ushort vertex_indices\nproperty float nx\n\
    property float ny\nproperty float nz\nend_header\n";

macro_rules! put {
    ($bytes:expr, $encoding:expr, $($value:expr),*) => {{
        $(match $encoding {
            "ascii" => $bytes.extend(format!("{} ", $value).bytes()),
            "binary_big_endian" => $bytes.extend(($value).to_be_bytes()),
            _ => $bytes.extend(($value).to_le_bytes()),
        })*
    }};
}

/// The torus with colours, a list for each vertex, texture coordinates, normals of all kinds, and edges of its own.
fn torus_ply(encoding: &str, edges: &[[usize; 2]]) -> Vec<u8> {
    let mesh = torus();
    let header = HEADER.replace("ENCODING", encoding).replace("EDGES", &edges.len().to_string());
    let mut bytes = header.into_bytes();
    let end_row = |bytes: &mut Vec<u8>| bytes.extend(&b"\n"[..usize::from(encoding == "ascii")]);
    for (v, point) in mesh.points.iter().enumerate() {
        let [x, y, z] = point.map(|x| x as f32);
        put!(bytes, encoding, v as u8, 1_u8, v as i32, x, y, z, 0.0_f32, 0.0_f32, 1.0_f64);
        end_row(&mut bytes);
    }
    for (number, [a, b]) in edges.iter().enumerate() {
        put!(bytes, encoding, *a as i32, number as u8, *b as u32);
        end_row(&mut bytes);
    }
    put!(bytes, encoding, 9.0_f32);
    end_row(&mut bytes);
    for (f, face) in mesh.faces.iter().enumerate() {
        put!(bytes, encoding, f as i32, 6_u8);
        torus_texture(face).iter().flatten().for_each(|&x| put!(bytes, encoding, x as f32));
        put!(bytes, encoding, 3_u8, face[0] as u16, face[1] as u16, face[2] as u16, 1.0_f32, 2.0_f32, 3.0_f32);
        end_row(&mut bytes);
    }
    bytes
}

fn parsed(bytes: &[u8]) -> Ply<DefaultElement> {
    Parser::new().read_ply(&mut Cursor::new(bytes)).unwrap()
}

fn float(row: &DefaultElement, name: &str) -> f64 {
    match row[name] {
        Property::Float(x) => f64::from(x),
        Property::Double(x) => x,
        ref other => panic!("{name} is {other:?}"),
    }
}

fn found_in_ply(ply: &Ply<DefaultElement>) -> Found {
    let vertex = |row: &DefaultElement| {
        let Property::ListInt(name) = &row["name"] else { panic!("the list is gone") };
        assert_eq!(row["red"], Property::UChar(name[0] as u8));
        (name[0] as usize, ["x", "y", "z"].map(|axis| float(row, axis)))
    };
    let face = |row: &DefaultElement| {
        let (Property::Int(name), Property::ListUShort(v)) = (&row["name"], &row["vertex_indices"]) else {
            panic!("the types changed")
        };
        (*name as usize, [0, 1, 2].map(|k| usize::from(v[k])))
    };
    let texture = |row: &DefaultElement| {
        let Property::ListFloat(all) = &row["texcoord"] else { panic!("the textures are gone") };
        [0, 1, 2].map(|k| [f64::from(all[2 * k]), f64::from(all[2 * k + 1])])
    };
    let faces = &ply.payload["face"];
    Found {
        vertices: ply.payload["vertex"].iter().map(vertex).collect(),
        faces: faces.iter().map(face).collect(),
        textures: faces.iter().map(texture).collect(),
    }
}

#[test]
fn ply_keeps_every_property_in_every_encoding() {
    let mut first = None;
    for encoding in ENCODINGS {
        let workspace = Workspace::with(&[("a.ply", &torus_ply(encoding, &[]))]);
        let report = workspace.report("collapse-tails", "a.ply", "b.ply", &HARSH);
        let mut after = parsed(&workspace.bytes("b.ply"));
        found_in_ply(&after).check(&report);
        assert_eq!(after.header.elements["vertex"].count, after.payload["vertex"].len());
        assert_eq!(after.header.comments, ["one"]);
        // The encodings differ in nothing but their name.
        after.header.encoding = ply_rs_bw::ply::Encoding::Ascii;
        assert_eq!(*first.get_or_insert(after.clone()), after);
    }
}

#[test]
fn ply_normals_are_those_of_the_new_mesh() {
    let workspace = Workspace::with(&[("a.ply", &torus_ply("ascii", &[]))]);
    let run = workspace.done(&[&["collapse-tails", "a.ply", "-o", "b.ply"], &HARSH[..]].concat());
    assert!(run.stderr.contains("vertex normals were recomputed") && run.stderr.contains("changed faces"));
    let after = parsed(&workspace.bytes("b.ply"));
    let found = found_in_ply(&after);
    let normal = |row: &DefaultElement| ["nx", "ny", "nz"].map(|axis| float(row, axis));
    for ((name, [x, y, z]), row) in found.vertices.iter().zip(&after.payload["vertex"]) {
        let ([a, b, c], middle) = (normal(row), 3.0 / x.hypot(*y));
        let cosine = (x - middle * x) * a + (y - middle * y) * b + z * c;
        assert!(cosine > 0.7, "the normal at vertex {name} does not point outward");
    }
    let mesh = torus();
    let rests = |v: usize| mesh.points[found.vertices[v].0] == found.vertices[v].1;
    for (face, row) in after.payload["face"].iter().enumerate() {
        let (source, corners) = found.faces[face];
        let same = found.names(face)[..] == mesh.faces[source] && corners.into_iter().all(rests);
        let length = normal(row).iter().map(|x| x * x).sum::<f64>();
        assert!(if same { length == 14.0 } else { (length - 1.0).abs() < 1e-5 }, "face {face}: {length}, {same}");
    }
}

#[test]
fn ply_edges_are_renumbered_or_dropped_with_a_note() {
    let workspace = Workspace::with(&[("a.ply", &torus_ply("ascii", &[]))]);
    workspace.report("collapse-tails", "a.ply", "b.ply", &HARSH);
    let removed = removed(&found_in_ply(&parsed(&workspace.bytes("b.ply"))));
    let [a, b] = [AROUND * ACROSS / 2, 1];
    let last = AROUND * ACROSS - 1;
    for encoding in ENCODINGS {
        let bytes = torus_ply(encoding, &[[removed[0], 0], [a, b], [0, removed[1]], [last, 5000]]);
        std::fs::write(workspace.path("c.ply"), bytes).unwrap();
        let run = workspace.done(&[&["collapse-tails", "c.ply", "-o", "d.ply"], &HARSH[..]].concat());
        assert!(run.stderr.contains("2 rows of element edge were dropped"), "{}", run.stderr);
        let after = parsed(&workspace.bytes("d.ply"));
        let found = found_in_ply(&after);
        let now = |v: usize| found.vertices.iter().position(|(name, _)| *name == v).unwrap();
        let edge = |row: &DefaultElement| match (&row["vertex1"], &row["crease"], &row["vertex2"]) {
            (Property::Int(a), Property::UChar(crease), Property::UInt(b)) => (*a as usize, *crease, *b as usize),
            other => panic!("{other:?}"),
        };
        let edges: Vec<_> = after.payload["edge"].iter().map(edge).collect();
        // An index that names no vertex is none that can be renumbered.
        assert_eq!(edges, [(now(a), 1, now(b)), (now(last), 3, 5000)]);
        assert!(now(last) < last);
        assert_eq!(after.payload["camera"].iter().map(|row| float(row, "vertex1")).collect::<Vec<_>>(), [9.0]);
    }
}

#[test]
fn stl_facets_keep_their_attribute_bytes() {
    let mesh = torus();
    let mut bytes = b"solid by hand".to_vec();
    bytes.resize(80, b'.');
    bytes.extend((mesh.faces.len() as u32).to_le_bytes());
    let facet = |face: &[u32]| -> Vec<u8> {
        face.iter().flat_map(|&v| mesh.points[v as usize]).flat_map(|x| (x as f32).to_le_bytes()).collect()
    };
    for (f, face) in mesh.faces.iter().enumerate() {
        bytes.extend([0; 12]);
        bytes.extend(facet(face));
        bytes.extend((f as u16).to_le_bytes());
    }
    let workspace = Workspace::with(&[("a.stl", &bytes)]);
    let report = workspace.report("collapse-tails", "a.stl", "b.stl", &HARSH);
    let after = workspace.bytes("b.stl");
    let count = report["after"]["triangles"].as_u64().unwrap() as u32;
    assert!((count as usize) < mesh.faces.len());
    assert_eq!((&after[..80], &after[80..84]), (&bytes[..80], &count.to_le_bytes()[..]));
    assert_eq!(after.len(), 84 + 50 * count as usize);
    let mut same = 0;
    for facet_now in after[84..].chunks_exact(50) {
        let source = usize::from(u16::from_le_bytes([facet_now[48], facet_now[49]]));
        let stays = facet_now[12..48] == facet(&mesh.faces[source]);
        assert_eq!(stays, facet_now[..12] == [0; 12], "the normal of facet {source}");
        same += usize::from(stays);
    }
    assert!(same > 50 && same < count as usize, "{same} facets stayed");
}

#[test]
fn another_format_holds_the_new_mesh() {
    let workspace = Workspace::with(&[("a.off", torus().off().as_bytes())]);
    let report = workspace.report("improve", "a.off", "b.off", &HARSH);
    let measured = |name: &str| -> serde_json::Value {
        serde_json::from_str(&workspace.done(&["measure", name, "--json"]).stdout).unwrap()
    };
    for name in ["b.ply", "b.obj"] {
        workspace.report("improve", "a.off", name, &HARSH);
        assert_eq!(measured(name), measured("b.off"), "{name}");
    }
    workspace.report("improve", "a.off", "b.stl", &HARSH);
    let stl = measured("b.stl");
    assert!(stl["triangles"].as_u64().unwrap() < report["before"]["triangles"].as_u64().unwrap());
    assert_eq!(stl["boundary_edges"], 0);
}

#[test]
fn kept_tails_are_smoothing() {
    let files = [
        ("a.obj", torus_obj(positive).into_bytes()),
        ("a.ply", torus_ply("binary_big_endian", &[[0, 1]])),
        ("a.off", grid().off().into_bytes()),
    ];
    for (name, bytes) in files {
        let workspace = Workspace::with(&[(name, &bytes)]);
        let (smoothed, kept) = (format!("smoothed_{name}"), format!("kept_{name}"));
        let mut told = workspace.smooth(name, &smoothed, &["--iterations", "3"]);
        let mut also = workspace.report("improve", name, &kept, &["--iterations", "3", "--keep-tails"]);
        assert_eq!(workspace.bytes(&smoothed), workspace.bytes(&kept));
        assert_ne!(workspace.bytes(&kept), bytes);
        [&mut told, &mut also].into_iter().for_each(|report| report["seconds"] = 0.into());
        assert_eq!(told, also);
    }
}

#[test]
fn nothing_to_cure_nothing_changes() {
    let text = sphere().off();
    let workspace = Workspace::with(&[("a.off", text.as_bytes()), ("a.obj", sphere().obj().as_bytes())]);
    let none = ["--tail-min-angle", "1", "--tail-max-angle", "179", "--tail-edge-ratio", "99"];
    for name in ["a.off", "a.obj"] {
        let output = name.replace('a', "b");
        let report = workspace.report("collapse-tails", name, &output, &none);
        assert_eq!((&report["tail"]["tails_before"], &report["tail"]["triangles_unchanged"]), (&0.into(), &1.0.into()));
        assert_eq!(workspace.bytes(&output), workspace.bytes(name));
    }
}

#[test]
fn polygons_are_refused_with_a_way_out() {
    let workspace = Workspace::with(&[("a.off", grid().off().as_bytes()), ("b.off", b"old")]);
    for subcommand in ["improve", "collapse-tails"] {
        let message = workspace.refused(&[subcommand, "a.off", "-o", "b.off"]);
        assert!(message.starts_with("error: a.off: face 0 (counted from 0) has 4 corners"), "{message}");
        assert!(message.contains("--keep-tails") && message.contains("triangulate"), "{message}");
        assert_eq!(workspace.bytes("b.off"), b"old");
    }
    let late = sphere().off().replacen("258 512 0", "258 513 0", 1) + "4 0 1 2 3\n";
    std::fs::write(workspace.path("c.off"), late).unwrap();
    assert!(
        workspace.refused(&["improve", "c.off", "-o", "b.off"]).contains("face 512 (counted from 0) has 4 corners")
    );
    workspace.done(&["improve", "a.off", "-o", "b.off", "--keep-tails"]);
}
