//! Ids and tables that need little memory, because the points of large files already need much.

use std::hash::{BuildHasher, Hash, RandomState};

/// Number of a point or an edge. It can count to more than twice [`MOST_POINTS`].
pub(super) type Id = u32;

pub(super) const MOST_POINTS: usize = 1 << 30;

const NONE: Id = Id::MAX;

pub(super) fn id(i: usize) -> Id {
    i as Id
}

/// A hash table with linear probing. The caller keeps the keys.
#[derive(Default)]
pub(super) struct Table {
    /// The number of slots is a power of two; at most three quarters are in use.
    slots: Vec<Slot>,
    count: usize,
    state: RandomState,
}

#[derive(Clone, Copy)]
struct Slot {
    hash: u32,
    id: Id,
}

impl Table {
    pub(super) fn like(&self, key: &impl Hash) -> impl Iterator<Item = Id> {
        let hash = self.hash(key);
        self.from(hash).take_while(|slot| slot.id != NONE).filter(move |slot| slot.hash == hash).map(|s| s.id)
    }

    pub(super) fn push(&mut self, key: &impl Hash) -> Id {
        if 4 * self.count >= 3 * self.slots.len() {
            let empty = vec![Slot { hash: 0, id: NONE }; (2 * self.slots.len()).max(4)];
            let known = std::mem::replace(&mut self.slots, empty);
            known.into_iter().filter(|slot| slot.id != NONE).for_each(|slot| self.put(slot));
        }
        let slot = Slot { hash: self.hash(key), id: id(self.count) };
        self.put(slot);
        self.count += 1;
        slot.id
    }

    fn put(&mut self, slot: Slot) {
        let mask = self.slots.len() - 1;
        let mut at = slot.hash as usize & mask;
        while self.slots[at].id != NONE {
            at = (at + 1) & mask;
        }
        self.slots[at] = slot;
    }

    fn from(&self, hash: u32) -> impl Iterator<Item = &Slot> {
        let begin = hash as usize & self.slots.len().saturating_sub(1);
        self.slots[begin..].iter().chain(&self.slots[..begin])
    }

    fn hash(&self, key: &impl Hash) -> u32 {
        self.state.hash_one(key) as u32
    }
}

/// Doubles the capacity of a full list, but adds at most the `most` elements that may still come.
pub(super) fn make_room<T>(all: &mut Vec<T>, most: usize) {
    if all.len() == all.capacity() {
        all.reserve_exact(all.len().max(16).min(most.max(1)));
    }
}

pub(super) struct Incidence {
    /// Index of the first edge at each point; at the end, the number of all edges.
    begins: Vec<Id>,
    edges: Vec<Id>,
}

impl Incidence {
    pub(super) fn new(places: usize, edges: usize, ends: impl Fn(usize) -> [Id; 2]) -> Self {
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

    pub(super) fn at(&self, place: usize) -> &[Id] {
        &self.edges[self.begins[place] as usize..self.begins[place + 1] as usize]
    }
}
