//! What searches know of the few cells they reach.

use pf_grid::{Layout, Word};

/// What is known of a jump point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<W> {
    pub(super) id: u32,
    /// Least weight found from the start.
    pub(super) g: W,
    /// No less is left to the goal, as earlier searches found out.
    pub(super) left: W,
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
/// By id there is no more than a place among them, which means nothing unless the node there is of that id: so
/// searches that reach little touch little memory, and all is forgotten in no time.
///
/// Source: Briggs and Torczon, *An efficient representation for sparse sets*, 1993.
#[derive(Clone, Debug, Default)]
pub(super) struct Nodes<W> {
    /// By id: where the node is, if it is one.
    places: Vec<u32>,
    all: Vec<Node<W>>,
    generation: u16,
    layout: Option<Layout>,
}

impl<W: Word> Nodes<W> {
    /// Makes ready for grids of a layout, so that the next search need not.
    pub(super) fn prepare(&mut self, layout: &Layout) {
        if self.layout != Some(*layout) {
            self.layout = Some(*layout);
            self.places.clear();
            self.places.resize(layout.len(), 0);
            self.forget();
        }
    }

    /// Begins another search.
    pub(super) fn begin(&mut self) {
        if self.generation == u16::MAX {
            self.forget();
            self.generation = 0;
        }
        self.generation += 1;
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
        self.places[id as usize]
    }

    /// The place of an id, its node, and whether this search has been there. If not, its `g` and what follows mean
    /// nothing.
    #[inline]
    pub(super) fn reach(&mut self, id: u32) -> (u32, &mut Node<W>, bool) {
        let mut place = self.places[id as usize];
        let is_node = self
            .all
            .get(place as usize)
            .is_some_and(|node| node.id == id);
        if !is_node {
            place = self.add(id);
        }
        let node = &mut self.all[place as usize];
        let is_known = is_node && node.generation == self.generation;
        node.generation = self.generation;
        (place, node, is_known)
    }

    #[inline]
    fn add(&mut self, id: u32) -> u32 {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "no more than there are ids"
        )]
        let place = self.all.len() as u32;
        self.places[id as usize] = place;
        if self.all.len() == self.all.capacity() {
            // A vector that grows by itself takes up to twice as much.
            self.all.reserve_exact(self.all.len() / 2 + 64);
        }
        self.all.push(Node {
            id,
            g: W::default(),
            left: W::default(),
            parent: place,
            generation: self.generation,
            arrivals: 0,
            closed: false,
        });
        place
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.places.capacity() * size_of::<u32>() + self.all.capacity() * size_of::<Node<W>>()
    }
}
