//! Queue with buckets of path lengths. It gives the order of Dijkstra's algorithm to 0.25 mm, without sorting.

/// Width of a bucket, as a length (mm) of the cheapest possible path; maximum number of buckets.
const BUCKET: f32 = 0.25;
const MOST_BUCKETS: usize = 400_000;

/// A queue that returns the shortest paths first; within a bucket, the last one in is the first one out.
#[derive(Clone, Debug)]
pub(crate) struct Buckets<T> {
    buckets: Vec<Vec<T>>,
    first: usize,
}

impl<T> Default for Buckets<T> {
    fn default() -> Self {
        Self { buckets: Vec::new(), first: 0 }
    }
}

impl<T> Buckets<T> {
    #[inline]
    pub(crate) fn put(&mut self, way: f32, waiting: T) {
        let bucket = bucket_of(way).max(self.first);
        if bucket >= MOST_BUCKETS {
            return;
        }
        if bucket >= self.buckets.len() {
            self.buckets.resize_with(bucket + 1, Vec::new);
        }
        self.buckets[bucket].push(waiting);
    }

    /// Whether all paths shorter than `way` (mm), up to the width of a bucket, have left the queue.
    #[inline]
    pub(crate) fn have_passed(&mut self, way: f32) -> bool {
        self.advance();
        bucket_of(way) < self.first
    }

    #[inline]
    pub(crate) fn pop(&mut self) -> Option<T> {
        self.advance();
        self.buckets.get_mut(self.first)?.pop()
    }

    pub(crate) fn drain(&mut self) -> Vec<T> {
        let waiting = self.buckets.drain(..).flatten().collect();
        self.first = 0;
        waiting
    }

    #[inline]
    fn advance(&mut self) {
        while let Some(bucket) = self.buckets.get_mut(self.first).filter(|bucket| bucket.is_empty()) {
            *bucket = Vec::new();
            self.first += 1;
        }
    }
}

fn bucket_of(way: f32) -> usize {
    (way / BUCKET) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shorter_ways_come_first_and_within_a_bucket_the_last_one() {
        let mut buckets = Buckets::default();
        for (way, name) in [(3.0, 'd'), (0.1, 'b'), (0.2, 'a'), (1.0, 'c'), (1e9, 'x')] {
            buckets.put(way, name);
        }
        assert_eq!([buckets.pop(), buckets.pop()], [Some('a'), Some('b')]);
        assert!(buckets.have_passed(0.9) && !buckets.have_passed(1.1));
        buckets.put(0.0, 'e');
        assert_eq!([buckets.pop(), buckets.pop()], [Some('e'), Some('c')]);
        buckets.put(9.0, 'f');
        assert_eq!(buckets.drain(), ['d', 'f']);
        assert_eq!(buckets.pop(), None);
        buckets.put(0.0, 'g');
        assert_eq!(buckets.pop(), Some('g'));
    }
}
