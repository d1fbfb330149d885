//! Sets that grow together: which of many things, by number, are in one.

/// Disjoint sets of numbers, each represented by one of its members.
#[derive(Default)]
pub(crate) struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// So many sets of one.
    pub(crate) fn singletons(count: usize) -> Self {
        DisjointSets { parent: (0..count as u32).collect() }
    }

    /// One more set, of one more number.
    pub(crate) fn add(&mut self) -> u32 {
        let added = self.parent.len() as u32;
        self.parent.push(added);
        added
    }

    /// How many numbers there are.
    pub(crate) fn len(&self) -> usize {
        self.parent.len()
    }

    pub(crate) fn representative(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let above = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = above; // path halving
            member = above;
        }
        member
    }

    /// Joins the set of one representative to that of another, which stands for both.
    pub(crate) fn join(&mut self, gone: u32, kept: u32) {
        self.parent[gone as usize] = kept;
    }
}
