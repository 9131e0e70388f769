//! The order of the visits, and which stars can be visited at once.

use super::blocks;
use super::colors::{self, COLORS, Mark};
use super::shares::Shares;
use super::surroundings::Surroundings;
use super::task::Task;
use super::turns::{self, Turn};
use crate::error::Error;
use crate::memory;
use crate::star::TOGETHER;
use crate::threads::Threads;

/// Vertices up to which a mesh is swept by blocks, where neighbours mostly follow each other by index, so that bad shapes are carried
/// a little further. Beyond, many blocks at once would be too much for a processor's caches, and shares are faster by a quarter.
pub(super) const LARGE: usize = 1 << 18;

/// Vertices of a task between blocks or shares, at most: few enough for all threads to end at about the same time.
const TASK: usize = 128 * TOGETHER;

/// The vertices that may move, in the order of their visits. It depends on the mesh alone.
pub(super) struct Schedule {
    /// First those inside the blocks or the shares: lists of tasks, each of which waits for those before it in its own list only.
    inside: Vec<Vec<Lot>>,
    /// Then those that have neighbours in another one: for each colour tasks that don't wait for each other.
    between: Vec<Vec<Lot>>,
    /// Then those that no colour was left for, to be visited one by one.
    rest: Vec<u32>,
}

/// What a task consists of.
pub(super) struct Lot {
    pub vertices: Vec<u32>,
    /// What `vertices` consist of.
    pub turns: Vec<Turn>,
}

impl Schedule {
    pub fn new(around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        Self::with(around, around.stars.len() > LARGE, threads)
    }

    /// By shares, or else by blocks.
    fn with(around: &Surroundings<'_>, by_shares: bool, threads: &Threads<'_>) -> Result<Self, Error> {
        let shares = Shares::of(around.stars.len());
        let mut marks = if by_shares { shares.marks(around, threads) } else { blocks::marks(around, threads) }?;
        colors::give_between(around, &mut marks);
        let inside =
            if by_shares { shares.lots(around, &marks, threads) } else { blocks::lots(around, &marks, threads) }?;
        let (between, rest) = between(&marks)?;
        let between = between.into_iter().filter(|vertices| !vertices.is_empty());
        let between =
            between.map(|vertices| lots_of_color(around, &vertices, threads)).collect::<Result<_, Error>>()?;
        Ok(Self { inside, between, rest })
    }

    /// How many vertices there are.
    pub fn len(&self) -> usize {
        let lots = self.inside.iter().chain(&self.between).flatten();
        lots.map(|lot| lot.vertices.len()).sum::<usize>() + self.rest.len()
    }

    /// The inside of blocks or shares: lists of tasks, each of which waits for those before it in its own list only.
    pub fn inside(&self) -> impl ExactSizeIterator<Item = impl Iterator<Item = Task<'_>>> {
        self.inside.iter().map(|lots| lots.iter().map(Lot::task))
    }

    /// What lies between them, colour by colour.
    pub fn between(&self) -> impl Iterator<Item = Vec<Task<'_>>> {
        self.between.iter().map(|lots| lots.iter().map(Lot::task).collect())
    }

    /// The vertices that are in no task, to be visited one by one.
    pub fn rest(&self) -> &[u32] {
        &self.rest
    }
}

impl Lot {
    fn task(&self) -> Task<'_> {
        Task { vertices: &self.vertices, turns: &self.turns }
    }
}

/// For each colour the vertices that have it between the parts, and those that no colour was left for.
fn between(marks: &[Mark]) -> Result<(Vec<Vec<u32>>, Vec<u32>), Error> {
    let (mut colors, mut rest) = (vec![Vec::new(); COLORS], Vec::new());
    for (v, mark) in (0..).zip(marks) {
        if mark.is_inside() {
            continue;
        }
        match mark.color_between() {
            Some(color) => memory::push(&mut colors[color], v)?,
            None if mark.is_left_over() => memory::push(&mut rest, v)?,
            None => {}
        }
    }
    Ok((colors, rest))
}

/// Vertices of each task from so many of one colour: full turns, so that these are the same for any number of threads.
fn task_size(vertices: usize, threads: &Threads<'_>) -> usize {
    vertices.div_ceil(threads.count()).next_multiple_of(TOGETHER).min(TASK)
}

/// Tasks from vertices of one colour.
fn lots_of_color(around: &Surroundings<'_>, vertices: &[u32], threads: &Threads<'_>) -> Result<Vec<Lot>, Error> {
    let lots = threads.map_each(vertices.chunks(task_size(vertices.len(), threads)).collect(), |vertices| {
        let (mut vertices, mut turns) = (memory::copied(vertices)?, Vec::new());
        turns::take(around, &mut vertices, &mut turns)?;
        Ok(Lot { vertices, turns })
    });
    lots.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::options::{Constraints, Options};
    use crate::preparation::Preparation;

    /// A flat grid of this many squares, its vertices numbered row by row, or all over the place.
    fn grid([columns, rows]: [u32; 2], shuffled: bool) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let count = (columns + 1) * (rows + 1);
        let number = |v: u32| if shuffled { (u64::from(v) * 7919 % u64::from(count)) as u32 } else { v };
        let mut positions = vec![[0.0; 3]; count as usize];
        for v in 0..count {
            positions[number(v) as usize] = [f64::from(v % (columns + 1)), f64::from(v / (columns + 1)), 0.0];
        }
        let squares = (0..rows).flat_map(|y| (0..columns).map(move |x| y * (columns + 1) + x));
        let halves = |a: u32| [[a, a + 1, a + columns + 2], [a, a + columns + 2, a + columns + 1]];
        let triangles = squares.flat_map(halves).map(|corners| corners.map(number)).collect();
        (positions, triangles)
    }

    /// Asserts that each vertex has its place, and no neighbours where they would meet. Returns how many tasks there are.
    fn check(squares: [u32; 2], shuffled: bool, by_shares: bool) -> usize {
        let (positions, triangles) = grid(squares, shuffled);
        let options = Options::default();
        let prepared =
            Preparation::new(positions.as_slice(), &triangles, &options, &Constraints::default(), &Threads::ONE)
                .unwrap();
        let around = prepared.surroundings(&options);
        let schedule = Schedule::with(&around, by_shares, &Threads::ONE).unwrap();
        let several = Threads::with(3, 1_000_000, |threads| Schedule::with(&around, by_shares, threads)).unwrap();
        // How long tasks are is up to the threads, but not what goes side by side, nor in which order.
        assert!(several.rest() == schedule.rest());
        assert!(several.between().map(turns_in).eq(schedule.between().map(turns_in)));
        assert!(!by_shares || several.inside().flatten().eq(schedule.inside().flatten()));
        let mut seen: Vec<u32> = schedule.rest().to_vec();
        let inside: Vec<Vec<_>> = schedule.inside().map(Iterator::collect).collect();
        let between = schedule.between().map(|tasks| tasks.into_iter().map(|task| vec![task]).collect());
        for lists in std::iter::once(inside).chain(between) {
            let mut owners = HashMap::new();
            for (number, &task) in lists.iter().enumerate().flat_map(|(n, list)| list.iter().map(move |task| (n, task)))
            {
                seen.extend(task.vertices);
                owners.extend(task.vertices.iter().map(|&v| (v, number)));
                check_turns(&around, task);
            }
            let is_apart = |(v, own): (&u32, &usize)| {
                around.stars.rim(*v).iter().all(|r| owners.get(r).is_none_or(|other| other == own))
            };
            assert!(owners.iter().all(is_apart), "neighbours in two tasks that don't wait for each other");
        }
        assert_eq!(seen.len(), schedule.len());
        seen.sort_unstable();
        assert_eq!(seen, around.movable().unwrap());
        schedule.inside().len() + schedule.between().map(|round| round.len()).sum::<usize>()
    }

    fn turns_in(tasks: Vec<Task<'_>>) -> Vec<(&[u32], u8)> {
        tasks.into_iter().flat_map(turns_of).collect()
    }

    /// The vertices of each turn, and how many of them go side by side.
    fn turns_of(task: Task<'_>) -> Vec<(&[u32], u8)> {
        let mut left = task.vertices;
        let turn =
            |turn: &Turn| (left.split_off(..usize::from(turn.size)).expect("vertices of a turn"), turn.companions);
        task.turns.iter().map(turn).collect()
    }

    fn check_turns(around: &Surroundings<'_>, task: Task<'_>) {
        assert_eq!(task.turns.iter().map(|turn| usize::from(turn.size)).sum::<usize>(), task.vertices.len());
        for (own, _) in turns_of(task) {
            let meets = |v: &u32| around.stars.rim(*v).iter().any(|r| own.contains(r));
            assert!(!own.iter().any(meets), "neighbours in a turn");
        }
    }

    #[test]
    fn each_vertex_has_its_turn_and_no_neighbour_beside_it() {
        assert_eq!(check([3, 3], false, false), 1);
        for by_shares in [false, true] {
            check([40, 30], true, by_shares);
            assert!(check([199, 399], false, by_shares) > 4);
            assert!(check([199, 399], true, by_shares) > 4);
            // Rows that are longer than blocks and as long as shares.
            assert!(check([4095, 19], false, by_shares) > 4);
        }
    }
}
