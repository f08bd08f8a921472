//! Many small tasks on a few threads, in an order that shows nowhere.

use std::{
    num::NonZeroUsize,
    sync::{
        atomic::{AtomicUsize, Ordering},
        mpsc,
    },
    thread,
};

/// Works the tasks 0 to `count` off on so many threads and hands each result to `done`, on the
/// caller's thread and in whatever order they come; `done` says whether to go on. A task that has
/// begun is finished.
pub fn spread<T: Send>(
    threads: NonZeroUsize,
    count: usize,
    work: impl Fn(usize) -> T + Sync,
    mut done: impl FnMut(usize, T) -> bool,
) {
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.get().min(count) {
            let send = send.clone();
            let (next, work) = (&next, &work);
            scope.spawn(move || {
                loop {
                    let task = next.fetch_add(1, Ordering::Relaxed);
                    if task >= count || send.send((task, work(task))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        for (task, result) in receive {
            if !done(task, result) {
                next.store(count, Ordering::Relaxed);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_done_once_and_a_stop_stops() {
        let threads = NonZeroUsize::new(3).unwrap();
        let mut squares = vec![0; 100];
        spread(
            threads,
            100,
            |k| k * k,
            |k, square| {
                squares[k] += square;
                true
            },
        );
        assert!((0..100).all(|k| squares[k] == k * k));
        let mut seen = 0;
        spread(
            threads,
            usize::MAX,
            |k| k,
            |_, _| {
                seen += 1;
                seen < 10
            },
        );
        assert!(seen >= 10);
    }
}
