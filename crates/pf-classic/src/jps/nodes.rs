//! What searches know of the few cells they reach.

use pf_grid::Word;

/// What is known of a jump point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<W> {
    pub(super) id: u32,
    /// Where its place is in the table.
    slot: u32,
    /// No less is left to the goal, as earlier searches found out.
    pub(super) left: W,
    /// Least weight found from the start.
    pub(super) g: W,
    /// The place of the jump point before it.
    pub(super) parent: u32,
    /// The search that `g` and what follows belong to; of others they are as good as never written.
    generation: u16,
    /// The set of directions in which it was reached at weight `g`.
    pub(super) arrivals: u8,
    /// Expanded at weight `g`.
    pub(super) closed: bool,
}

/// The nodes of a search and of those before it that it learns from, one after the other as they were reached.
///
/// Their places are in a hash table with linear probing. What is in it means nothing unless the node at that place says
/// that it is the one meant: so searches that reach little touch little memory, and all is forgotten in no time.
///
/// Source: Knuth, *The Art of Computer Programming* 3, section 6.4; Briggs and Torczon, *An efficient representation for
/// sparse sets*, 1993.
#[derive(Clone, Debug, Default)]
pub(super) struct Nodes<W> {
    /// The places of nodes; a power of two of them, four times as many as there are nodes at the least.
    table: Vec<u32>,
    /// What is left of a product is so many bits shorter.
    shift: u32,
    all: Vec<Node<W>>,
    generation: u16,
}

/// Of so many bits is the number of slots at first.
const FIRST: u32 = 10;
/// 2^64 over the golden ratio: the upper bits of its multiples tell apart what lies in a row.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl<W: Word> Nodes<W> {
    /// Begins another search.
    pub(super) fn begin(&mut self) {
        if self.generation == u16::MAX {
            self.forget();
            self.generation = 0;
        }
        self.generation += 1;
        if self.table.is_empty() {
            (self.table, self.shift) = (vec![0; 1 << FIRST], u64::BITS - FIRST);
        }
    }

    /// Forgets all nodes.
    pub(super) fn forget(&mut self) {
        self.all.clear();
    }

    /// The node at a place.
    #[inline]
    pub(super) fn at(&mut self, place: u32) -> &mut Node<W> {
        &mut self.all[place as usize]
    }

    /// The same, to read.
    pub(super) fn get(&self, place: u32) -> &Node<W> {
        &self.all[place as usize]
    }

    /// The place of an id that was reached.
    pub(super) fn place(&self, id: u32) -> u32 {
        self.table[self.find(id).0 as usize]
    }

    /// The slot in which the place of an id is, or would be, and whether it is.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a number of slots")]
    fn find(&self, id: u32) -> (u32, bool) {
        let mut slot = (u64::from(id).wrapping_mul(GOLDEN) >> self.shift) as u32;
        loop {
            match self.all.get(self.table[slot as usize] as usize) {
                Some(node) if node.id == id => return (slot, true),
                Some(node) if node.slot == slot => {
                    slot = (slot + 1) & (self.table.len() as u32 - 1);
                }
                _ => return (slot, false),
            }
        }
    }

    /// The place of an id, its node, and whether this search has been there. If not, its `g` and what follows mean
    /// nothing.
    #[inline]
    pub(super) fn reach(&mut self, id: u32) -> (u32, &mut Node<W>, bool) {
        let (slot, is_node) = self.find(id);
        let place = if is_node {
            self.table[slot as usize]
        } else {
            self.add(id, slot)
        };
        let node = &mut self.all[place as usize];
        let is_known = is_node && node.generation == self.generation;
        node.generation = self.generation;
        (place, node, is_known)
    }

    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "no more than there are ids"
    )]
    fn add(&mut self, id: u32, slot: u32) -> u32 {
        let place = self.all.len() as u32;
        self.table[slot as usize] = place;
        if self.all.len() == self.all.capacity() {
            // A vector that grows by itself takes up to twice as much.
            self.all.reserve_exact(self.all.len() / 2 + 64);
        }
        self.all.push(Node {
            id,
            slot,
            left: W::default(),
            g: W::default(),
            parent: place,
            generation: self.generation,
            arrivals: 0,
            closed: false,
        });
        if self.all.len() * 4 > self.table.len() {
            self.grow();
        }
        place
    }

    #[cold]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "no more than there are ids"
    )]
    fn grow(&mut self) {
        let slots = 2 * self.table.len();
        // The old memory goes before the new comes.
        self.table = Vec::new();
        self.table = vec![0; slots];
        self.shift -= 1;
        // What is not put in yet is not in the table.
        for place in 0..self.all.len() {
            let (slot, _) = self.find(self.all[place].id);
            self.table[slot as usize] = place as u32;
            self.all[place].slot = slot;
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.table.capacity() * size_of::<u32>() + self.all.capacity() * size_of::<Node<W>>()
    }
}
