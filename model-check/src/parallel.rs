//! Work by several threads.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Does the jobs `0..jobs` on this thread and others, `threads` in all and at least one. `take` receives the number and the result of
/// each job, one at a time, in the order in which they end, and returns whether to go on. If not, no further job begins; `take` still
/// receives the jobs that run.
///
/// # Panics
/// When `run` or `take` panics.
pub fn in_parallel<R>(
    threads: usize,
    jobs: usize,
    run: impl Fn(usize) -> R + Sync,
    take: impl FnMut(usize, R) -> bool + Send,
) {
    let (next, is_over) = (AtomicUsize::new(0), AtomicBool::new(false));
    let take = Mutex::new(take);
    let work = || {
        while !is_over.load(Ordering::Relaxed) {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= jobs {
                return;
            }
            let result = run(number);
            let mut take = take.lock().unwrap_or_else(PoisonError::into_inner);
            if !take(number, result) {
                is_over.store(true, Ordering::Relaxed);
            }
        }
    };
    thread::scope(|scope| {
        let others = (1..threads.min(jobs)).map(|_| scope.spawn(work));
        let others: Vec<_> = others.collect();
        work();
        for other in others {
            if let Err(cause) = other.join() {
                std::panic::resume_unwind(cause);
            }
        }
    });
}

/// Results of `work` on each run of `size` items, in order, whichever thread computes them.
/// Panics when `work` panics, or `size` is 0.
pub(crate) fn map_chunks<T: Sync, R: Send>(
    threads: NonZeroUsize,
    items: &[T],
    size: usize,
    work: impl Fn(&[T]) -> R + Sync,
) -> Vec<R> {
    let chunks: Vec<&[T]> = items.chunks(size).collect();
    let mut results: Vec<Option<R>> = chunks.iter().map(|_| None).collect();
    let run = |number: usize| work(chunks[number]);
    in_parallel(threads.get(), chunks.len(), run, |number, result| {
        results[number] = Some(result);
        true
    });
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_order_with_any_number_of_threads() {
        let items: Vec<u32> = (0..1_003).collect();
        let sums: Vec<u32> = items.chunks(10).map(|chunk| chunk.iter().sum()).collect();
        for threads in 1..=5 {
            let threads = NonZeroUsize::new(threads).unwrap();
            let found = map_chunks(threads, &items, 10, |chunk| chunk.iter().sum::<u32>());
            assert_eq!(found, sums);
        }
        assert!(map_chunks(NonZeroUsize::MIN, &[0_u8; 0], 10, <[u8]>::len).is_empty());
    }

    #[test]
    fn nothing_begins_after_the_end() {
        for threads in 1..=5 {
            let mut taken = Vec::new();
            in_parallel(
                threads,
                1_000,
                |number| 2 * number,
                |number, twice| {
                    taken.push((number, twice));
                    taken.len() < 10
                },
            );
            assert!((10..10 + threads).contains(&taken.len()), "{taken:?}");
            assert!(taken.iter().all(|(number, twice)| 2 * number == *twice));
        }
    }
}
