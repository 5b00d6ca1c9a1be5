//! Ids of places, steps and edges, and tables of them that take few bytes each: beside the points of a large
//! file little else has room.

use std::hash::{BuildHasher, Hash, RandomState};

/// The id of a place, a path, a step or an edge. [`MOST_POINTS`] keeps twice their number below the largest.
pub type Id = u32;

/// The most points of all lines that ids can tell apart.
pub const MOST_POINTS: usize = 1 << 30;

const NONE: Id = Id::MAX;

/// The id of the `i`th of at most [`MOST_POINTS`].
pub fn id(i: usize) -> Id {
    i as Id
}

/// Ids from 0, found by keys that stay with the caller.
pub struct Buckets {
    /// The newest id of each bucket.
    newest: Vec<Id>,
    /// The id in the same bucket that is next older than each.
    older: Vec<Id>,
    state: RandomState,
}

impl Buckets {
    /// No ids yet, with room for `count`.
    pub fn with_capacity(count: usize) -> Self {
        let newest = vec![NONE; count.next_power_of_two()];
        Self { newest, older: Vec::with_capacity(count), state: RandomState::new() }
    }

    fn bucket(&self, key: &impl Hash) -> usize {
        self.state.hash_one(key) as usize & (self.newest.len() - 1)
    }

    /// The ids whose key may be this one.
    pub fn like(&self, key: &impl Hash) -> impl Iterator<Item = Id> {
        let some = |id: Id| Some(id).filter(|id| *id != NONE);
        std::iter::successors(some(self.newest[self.bucket(key)]), move |id| some(self.older[*id as usize]))
    }

    /// Gives this key the next id.
    pub fn push(&mut self, key: &impl Hash) -> Id {
        let (bucket, next) = (self.bucket(key), id(self.older.len()));
        self.older.push(std::mem::replace(&mut self.newest[bucket], next));
        next
    }
}

/// The edges at every place, one place's after the other's, each place's by their ids.
pub struct Incidence {
    /// Where the edges of each place begin, and where the last one's end.
    begins: Vec<Id>,
    edges: Vec<Id>,
}

impl Incidence {
    /// Of `edges` whose two places `ends` gives.
    pub fn new(places: usize, edges: usize, ends: impl Fn(usize) -> [Id; 2]) -> Self {
        let mut begins = vec![0; places + 1];
        (0..edges).flat_map(&ends).for_each(|place| begins[place as usize] += 1);
        let mut sum = 0;
        for begin in &mut begins {
            sum += *begin;
            *begin = sum;
        }
        let mut out = vec![0; 2 * edges];
        for edge in (0..edges).rev() {
            for place in ends(edge) {
                let begin = &mut begins[place as usize];
                *begin -= 1;
                out[*begin as usize] = id(edge);
            }
        }
        Self { begins, edges: out }
    }

    pub fn at(&self, place: usize) -> &[Id] {
        &self.edges[self.begins[place] as usize..self.begins[place + 1] as usize]
    }
}
