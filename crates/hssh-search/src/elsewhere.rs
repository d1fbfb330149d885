//! Open hypotheses that wait where memory is not: in pages that somebody else keeps.

use std::fmt::Debug;
use std::io;
use std::sync::{Arc, OnceLock};

use hssh_topology::Axioms;

use crate::helpers::{read, written};
use crate::leaf::{Appraise, Leaf};
use crate::pack::{Pack, PackedLeaf};

/// Keeps pages for which a search has no memory: this crate neither reads nor writes files.
pub trait Store: Debug + Send + Sync {
    /// Keeps a page; its number, until it is [dropped](Self::drop_page).
    ///
    /// # Errors
    /// If it cannot be kept. Then the search keeps it in memory.
    fn keep(&self, page: &[u8]) -> io::Result<u64>;

    /// A page that was kept.
    ///
    /// # Errors
    /// If it cannot be read. Then the search cannot go on.
    fn page(&self, number: u64) -> io::Result<Vec<u8>>;

    /// A page is not needed any more.
    fn drop_page(&self, number: u64);
}

/// Where pages are, and what it takes to read them.
#[derive(Clone, Debug)]
pub(crate) struct Elsewhere {
    store: Arc<dyn Store>,
    axioms: Axioms,
    /// Why a page was lost, if one was.
    lost: Arc<OnceLock<io::Error>>,
    /// Whether a page could not be kept.
    full: Arc<OnceLock<io::Error>>,
}

/// Leaves that are kept elsewhere.
#[derive(Debug)]
pub(crate) struct Page<A: Appraise> {
    number: u64,
    /// The key and the arrival of its first leaf.
    pub(crate) first: (A::Key, u32),
    pub(crate) leaves: usize,
    /// What they took in memory.
    pub(crate) bytes: u64,
}

impl Elsewhere {
    pub(crate) fn new(store: Arc<dyn Store>, axioms: Axioms) -> Self {
        Elsewhere { store, axioms, lost: Arc::default(), full: Arc::default() }
    }

    /// Why a page was lost, if one was.
    pub(crate) fn lost(&self) -> Option<&io::Error> {
        self.lost.get()
    }

    /// Whether no more pages can be kept.
    pub(crate) fn is_full(&self) -> bool {
        self.full.get().is_some()
    }

    /// Keeps leaves, of which there is one at least, that take so many bytes. `None` if that is not possible.
    pub(crate) fn keep<A: Pack>(&self, leaves: &[Leaf<A>], bytes: u64) -> Option<Page<A>> {
        let first = leaves.first().map(|leaf| (leaf.key, leaf.arrival))?;
        let shared = A::share(leaves.iter().map(|leaf| &leaf.load));
        let packed: Vec<PackedLeaf<A::Key, A::Packed>> =
            leaves.iter().map(|leaf| PackedLeaf::of(leaf, &shared)).collect();
        match self.store.keep(&written(Vec::new(), &(&shared, packed))) {
            Ok(number) => Some(Page { number, first, leaves: leaves.len(), bytes }),
            Err(error) => {
                let _ = self.full.set(error);
                None
            }
        }
    }

    /// The leaves of a page; none if it was lost.
    pub(crate) fn look<A: Pack>(&self, page: &Page<A>) -> Vec<Leaf<A>> {
        let unpacked = self.store.page(page.number).and_then(|written| {
            let leaves = unwritten(&written, &self.axioms).filter(|leaves| leaves.len() == page.leaves);
            leaves.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidData, "something of it was changed"))
        });
        unpacked.unwrap_or_else(|error| {
            let _ = self.lost.set(error);
            Vec::new()
        })
    }

    /// A page is not needed any more.
    pub(crate) fn drop<A: Pack>(&self, page: Page<A>) {
        self.store.drop_page(page.number);
    }

    /// A page as it is.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(crate) fn written<A: Pack>(&self, page: &Page<A>) -> io::Result<Vec<u8>> {
        self.store.page(page.number)
    }

    /// Takes the leaves of a page back.
    pub(crate) fn take<A: Pack>(&self, page: Page<A>) -> Vec<Leaf<A>> {
        let leaves = self.look(&page);
        self.drop(page);
        leaves
    }
}

/// A page as it is read.
type Read<A> = (<A as Pack>::Read, Vec<PackedLeaf<<A as Appraise>::Key, <A as Pack>::Packed>>);

/// The leaves that a page has. `None` if it is none.
pub(crate) fn unwritten<A: Pack>(page: &[u8], axioms: &Axioms) -> Option<Vec<Leaf<A>>> {
    let (shared, packed): Read<A> = read(page)?;
    packed.into_iter().map(|leaf| leaf.unpack(&shared, axioms)).collect()
}
