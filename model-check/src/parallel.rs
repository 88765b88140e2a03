//! Work on slices by several threads, with results in the order of the slice.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What `work` makes of each run of `size` items, in order. Which thread does what shows nowhere.
///
/// # Panics
/// When `work` panics, or `size` is 0.
pub(crate) fn map_chunks<T: Sync, R: Send>(
    threads: NonZeroUsize,
    items: &[T],
    size: usize,
    work: impl Fn(&[T]) -> R + Sync,
) -> Vec<R> {
    let chunks: Vec<&[T]> = items.chunks(size).collect();
    let workers = threads.get().min(chunks.len());
    if workers <= 1 {
        return chunks.into_iter().map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(chunk) = chunks.get(place) else {
                return done;
            };
            done.push((place, work(chunk)));
        }
    };
    let mut done = thread::scope(|scope| {
        let others: Vec<_> = (1..workers).map(|_| scope.spawn(take)).collect();
        let mut done = take();
        for other in others {
            match other.join() {
                Ok(more) => done.extend(more),
                Err(cause) => std::panic::resume_unwind(cause),
            }
        }
        done
    });
    done.sort_unstable_by_key(|&(place, _)| place);
    done.into_iter().map(|(_, result)| result).collect()
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
}
