//! Connected components: disjoint sets of vertices whose unions can be taken back.

/// Disjoint sets, united by size and without path compression, so that the last union can be undone.
#[derive(Clone, Debug, Default)]
pub(super) struct Components {
    parent: Vec<u32>,
    size: Vec<u32>,
}

impl Components {
    /// Adds a set of one.
    pub(super) fn push(&mut self) {
        self.parent.push(self.parent.len() as u32);
        self.size.push(1);
    }

    /// Removes the last element, which must be alone.
    pub(super) fn pop(&mut self) {
        self.parent.pop();
        self.size.pop();
    }

    pub(super) fn root(&self, mut element: u32) -> u32 {
        while self.parent[element as usize] != element {
            element = self.parent[element as usize];
        }
        element
    }

    /// Unites two sets; the root that was hung under the other, `None` if they were one set already.
    pub(super) fn unite(&mut self, a: u32, b: u32) -> Option<u32> {
        let (a, b) = (self.root(a), self.root(b));
        if a == b {
            return None;
        }
        let (big, small) = if self.size[a as usize] >= self.size[b as usize] { (a, b) } else { (b, a) };
        self.parent[small as usize] = big;
        self.size[big as usize] += self.size[small as usize];
        Some(small)
    }

    /// Takes back the last union, given the root that it hung.
    pub(super) fn divide(&mut self, small: u32) {
        let big = self.parent[small as usize];
        self.parent[small as usize] = small;
        self.size[big as usize] -= self.size[small as usize];
    }
}
