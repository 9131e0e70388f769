//! The threads of one call: a pool of its own, gone when the call returns, never the host's.

use std::iter::Sum;
use std::ops::Range;
use std::thread::available_parallelism;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::Error;
use crate::memory;

/// Vertices for which another thread is worth its start.
const WORTH_A_THREAD: usize = 20_000;

/// One thread or several.
pub(crate) struct Threads<'a>(Option<&'a ThreadPool>);

/// Vertices of a task where each vertex takes about as long as any other.
pub(crate) const PART: usize = 8192;

impl Threads<'_> {
    /// The calling thread alone.
    pub const ONE: Self = Threads(None);

    /// Calls `work` with as many threads as are wanted, 0 meaning all that the machine runs at once, and worth it for a
    /// mesh of `vertex_count` vertices. Where they cannot be had, the calling thread works alone.
    pub fn with<T>(wanted: u32, vertex_count: usize, work: impl FnOnce(&Threads<'_>) -> T) -> T {
        let all = || available_parallelism().map_or(1, usize::from);
        let wanted = if wanted == 0 { all() } else { wanted as usize };
        let count = wanted.min(vertex_count / WORTH_A_THREAD);
        if count <= 1 {
            return work(&Threads::ONE);
        }
        let mut waiting = Some(work);
        let builder = ThreadPoolBuilder::new().num_threads(count).thread_name(|i| format!("qsmesh {i}"));
        let done =
            builder.build_scoped(|thread| thread.run(), |pool| waiting.take().map(|work| work(&Threads(Some(pool)))));
        match (done, waiting) {
            (Ok(Some(result)), _) => result,
            (_, Some(work)) => work(&Threads::ONE),
            (_, None) => unreachable!("a pool that cannot be built takes no work"),
        }
    }

    /// Whether there is one thread.
    pub fn is_one(&self) -> bool {
        self.0.is_none()
    }

    /// How many work at once.
    pub fn count(&self) -> usize {
        self.0.map_or(1, ThreadPool::current_num_threads)
    }

    /// Carries out `work` on one of the threads, so that they don't have to be called together for each thing in it.
    pub fn stay<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match self.0 {
            None => work(),
            Some(pool) => pool.install(work),
        }
    }

    /// Carries out tasks, on the calling thread one by one or on all threads in any order. What they return comes in their
    /// own order.
    pub fn map<T: Send>(&self, tasks: Range<usize>, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
        match self.0 {
            None => tasks.map(work).collect(),
            Some(pool) => pool.install(|| tasks.into_par_iter().map(&work).collect()),
        }
    }

    /// The sum of what tasks return.
    pub fn sum<T: Sum + Send>(&self, tasks: Range<usize>, work: impl Fn(usize) -> T + Sync) -> T {
        self.map(tasks, work).into_iter().sum()
    }

    /// What `work` makes of each number below `count`. The memory is first touched by the threads that fill it.
    pub fn collect<T: Send>(&self, count: usize, work: impl Fn(usize) -> T + Sync) -> Result<Vec<T>, Error> {
        let mut all = memory::spacious(count)?;
        match self.0 {
            None => all.extend((0..count).map(work)),
            Some(pool) => {
                pool.install(|| (0..count).into_par_iter().with_min_len(PART).map(&work).collect_into_vec(&mut all));
            }
        }
        Ok(all)
    }

    /// `count` copies of `value`, which the threads write.
    pub fn filled<T: Copy + Send + Sync>(&self, value: T, count: usize) -> Result<Vec<T>, Error> {
        match self.0 {
            None => memory::filled(value, count),
            Some(_) => self.collect(count, |_| value),
        }
    }

    /// Sorts.
    pub fn sort(&self, all: &mut [u64]) {
        match self.0 {
            None => all.sort_unstable(),
            Some(pool) => pool.install(|| all.par_sort_unstable()),
        }
    }

    /// What `work` makes of the parts of `0..count`, in their order.
    pub fn parts<T: Send>(&self, count: usize, work: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
        self.map(0..count.div_ceil(PART), |part| work(part * PART..((part + 1) * PART).min(count)))
    }

    /// What `work` makes of each of several parts, in their order.
    pub fn map_each<P: Send, T: Send>(&self, parts: Vec<P>, work: impl Fn(P) -> T + Sync) -> Vec<T> {
        match self.0 {
            None => parts.into_iter().map(work).collect(),
            Some(pool) => pool.install(|| parts.into_par_iter().map(&work).collect()),
        }
    }

    /// Carries out a piece of work on each of several parts.
    pub fn each<T: Send>(&self, parts: Vec<T>, work: impl Fn(T) + Sync) {
        match self.0 {
            None => parts.into_iter().for_each(work),
            Some(pool) => pool.install(|| parts.into_par_iter().for_each(&work)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_done_once() {
        for threads in [1, 2, 5] {
            let sum = Threads::with(threads, 1_000_000, |threads| threads.sum(0..100, |i| i));
            assert_eq!(sum, 4950);
        }
    }

    #[test]
    fn small_meshes_stay_on_one_thread() {
        assert!(Threads::with(8, WORTH_A_THREAD, |threads| threads.is_one()));
        assert!(!Threads::with(8, 2 * WORTH_A_THREAD, |threads| threads.is_one()));
    }
}
