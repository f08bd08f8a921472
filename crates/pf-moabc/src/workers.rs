//! Threads that wait for work: starting one takes as long as a hundred evaluations.

use rayon_core::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// As many threads as were wanted last, this one included. Clones share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workers {
    pool: Option<Arc<ThreadPool>>,
}

impl Workers {
    /// Does every piece of work, the first on this thread; all of them, if there are no others.
    pub(crate) fn share<T: Send>(
        &mut self,
        threads: usize,
        pieces: impl Iterator<Item = T>,
        work: impl Fn(T) + Sync,
    ) {
        let mut pieces = pieces;
        let Some(pool) = self.pool(threads) else {
            pieces.for_each(work);
            return;
        };
        let first = pieces.next();
        pool.in_place_scope(|scope| {
            let work = &work;
            for piece in pieces {
                scope.spawn(move |_| work(piece));
            }
            if let Some(first) = first {
                work(first);
            }
        });
    }

    /// The other threads; `None` if there are none to be had.
    fn pool(&mut self, threads: usize) -> Option<Arc<ThreadPool>> {
        let others = threads.checked_sub(1).filter(|&others| others > 0)?;
        let fits = |pool: &Arc<ThreadPool>| pool.current_num_threads() == others;
        if !self.pool.as_ref().is_some_and(fits) {
            let built = ThreadPoolBuilder::new().num_threads(others).build();
            self.pool = built.ok().map(Arc::new);
        }
        self.pool.clone()
    }
}
