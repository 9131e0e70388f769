//! Which stars can be visited at once: blocks of vertices, and colours for what lies between the blocks.

use super::visit::Surroundings;
use crate::error::Error;
use crate::memory;

/// Vertices of consecutive numbers that make a block.
pub(super) const BLOCK: usize = 512;

/// Colours at most. Vertices for which none is left are visited one by one.
const COLORS: usize = 63;

/// The vertices that may move, in the order of their visits. It depends on the mesh alone.
pub(super) struct Schedule {
    /// First the inner vertices of each block, by index: their neighbours lie in their own block, or don't move. Then the
    /// others, by colour: no two of one colour are neighbours. Then those that no colour was left for.
    pub vertices: Vec<u32>,
    /// Ends of the blocks in `vertices`.
    pub blocks: Vec<usize>,
    /// Ends of the colours behind the blocks.
    pub colors: Vec<usize>,
}

impl Schedule {
    pub fn new(around: &Surroundings<'_>) -> Result<Self, Error> {
        let mut vertices = around.movable()?;
        let mut blocks = memory::reserved(around.stars.len().div_ceil(BLOCK))?;
        let border = part(around, &mut vertices, &mut blocks)?;
        let mut schedule = Self { vertices, blocks, colors: Vec::new() };
        let colors = greedy(around, &border)?;
        schedule.add_border(&colors, &border);
        Ok(schedule)
    }

    /// Adds the border, colour by colour, by counting.
    fn add_border(&mut self, colors: &[u8], border: &[u32]) {
        let mut counts = [0; COLORS + 1];
        colors.iter().for_each(|&color| counts[usize::from(color)] += 1);
        let mut next = [self.vertices.len(); COLORS + 1];
        for color in 0..COLORS {
            next[color + 1] = next[color] + counts[color];
        }
        self.colors.extend(next[1..].iter().zip(counts).filter(|&(_, count)| count > 0).map(|(&end, _)| end));
        self.vertices.resize(self.vertices.len() + border.len(), 0);
        for (&v, &color) in border.iter().zip(colors) {
            let place = &mut next[usize::from(color)];
            self.vertices[*place] = v;
            *place += 1;
        }
    }
}

/// Takes the vertices with neighbours in other blocks out of `vertices`, and tells where each block ends in what is left.
fn part(around: &Surroundings<'_>, vertices: &mut Vec<u32>, blocks: &mut Vec<usize>) -> Result<Vec<u32>, Error> {
    let block = |v: u32| v as usize / BLOCK;
    let moves = |v: u32| around.features.role(v).moves();
    let is_inner = |v: u32| around.stars.ring(v).iter().all(|&r| block(r) == block(v) || !moves(r));
    let mut border = memory::reserved(vertices.iter().filter(|&&v| !is_inner(v)).count())?;
    let mut inner = 0;
    for i in 0..vertices.len() {
        let v = vertices[i];
        blocks.resize(block(v), inner);
        if is_inner(v) {
            vertices[inner] = v;
            inner += 1;
        } else {
            border.push(v);
        }
    }
    vertices.truncate(inner);
    blocks.push(inner);
    Ok(border)
}

/// Gives each vertex of the border, by index, the first colour that none of its neighbours there has.
fn greedy(around: &Surroundings<'_>, border: &[u32]) -> Result<Vec<u8>, Error> {
    const NONE: u8 = u8::MAX;
    let mut colors = memory::filled(NONE, around.stars.len())?;
    for &v in border {
        let taken = around.stars.ring(v).iter().fold(0_u64, |taken, &r| match colors[r as usize] {
            NONE => taken,
            color => taken | 1 << color,
        });
        colors[v as usize] = (taken.trailing_ones() as u8).min(COLORS as u8);
    }
    let mut of_border = memory::reserved(border.len())?;
    of_border.extend(border.iter().map(|&v| colors[v as usize]));
    Ok(of_border)
}
