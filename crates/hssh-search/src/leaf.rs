//! Open hypotheses, and what appraises them.

use std::cmp::Ordering;
use std::fmt::Debug;

use hssh_metrics::SolveError;
use hssh_topology::{Outcome, Removals};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::limits::StopReason;
use crate::report::{Probable, Score};
use crate::tree::{Child, NodeId, Tree};
use crate::visit::MeasurementError;
use crate::visited::Visited;

/// An objective at work: it says what makes one map better than another, and how good the maps can be at best that come of
/// an open hypothesis.
pub(crate) trait Appraise: Debug + Sync + Sized {
    /// What orders hypotheses and maps: the less, the better. That of a hypothesis that explains everything is the
    /// value of its map.
    type Key: Copy + Ord + Debug + Send + Sync;
    /// What a hypothesis carries along besides its key.
    type Load: Clone + Debug + Send + Sync;

    /// Whether keys weigh probabilities. Then the value of a map depends on the whole branch, and all maps found belong to
    /// the answer; else it follows from the map alone, and only the best ones do.
    const WEIGHS: bool;

    /// Takes notice of the travels that are new. A limit may stop it, and the next call goes on.
    ///
    /// # Errors
    /// If a travel cannot be used.
    fn observe(&mut self, context: Context<'_>, tree: &Tree) -> Result<Option<StopReason>, MeasurementError>;

    /// Appraises a leaf anew that was made when there were only `before` travels to explain.
    fn renew(
        &self,
        leaf: &mut Leaf<Self>,
        before: usize,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    );

    /// The leaf that every search begins with.
    fn root(&self, context: Context<'_>) -> Leaf<Self>;

    /// The successors of a settled leaf.
    ///
    /// # Errors
    /// If a layout cannot be computed.
    fn grow(&self, leaf: &Leaf<Self>, cursor: &mut Cursor, tree: &Tree, context: Context<'_>)
    -> Growth<Self>;

    /// Whether the key of a leaf is final, or only estimated.
    fn is_settled(&self, leaf: &Leaf<Self>) -> bool;

    /// Makes the key final. By what factor it rose of what was promised, if that was relied on and is less than 1.
    ///
    /// # Errors
    /// If a layout cannot be computed.
    fn settle(
        &self,
        leaf: &mut Leaf<Self>,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Result<Option<f64>, SolveError>;

    /// No map that comes of the leaf has a lower key than this; `None` if its key is no bound.
    fn bound(&self, leaf: &Leaf<Self>) -> Option<Self::Key>;

    /// The greatest key that counts as equal to this one, or that is `slack` nats beyond that.
    fn reach(&self, key: Self::Key, slack: f64) -> Self::Key;

    /// Whether a map can come of a leaf at all, as far as is known.
    fn is_possible(&self, leaf: &Leaf<Self>) -> bool {
        let _ = leaf;
        true
    }

    /// By how many nats one key is above another: how far a reach has to be widened.
    fn distance(&self, from: Self::Key, to: Self::Key) -> f64 {
        self.nats(to) - self.nats(from)
    }

    /// Minus ln of what a map weighs, if keys do; else 0.
    fn nats(&self, key: Self::Key) -> f64;

    /// ln of what all maps that come of a leaf can weigh together at most, if keys do; else 0.
    fn log_mass(&self, leaf: &Leaf<Self>) -> f64;

    /// Whether hypotheses are turned down as soon as no closed map can come of them.
    fn turns_down_early(&self) -> bool;

    /// The key in public terms.
    fn score(&self, key: Self::Key) -> Score;

    /// What makes the map of a settled leaf probable, if keys weigh; `visited` is where the robot was.
    fn probable(&self, leaf: &Leaf<Self>, visited: &Visited) -> Option<Probable> {
        let _ = (leaf, visited);
        None
    }

    /// The bytes that a leaf takes.
    fn bytes(&self, leaf: &Leaf<Self>) -> u64;
}

/// A hypothesis that is not expanded yet.
#[derive(Debug)]
pub(crate) struct Leaf<A: Appraise> {
    /// What decides its turn.
    pub(crate) key: A::Key,
    /// What decides between equal keys: how many came to its level before.
    pub(crate) arrival: u32,
    pub(crate) node: NodeId,
    /// How many travels it explains.
    pub(crate) depth: u32,
    /// Its pending gateways.
    pub(crate) pending: u32,
    pub(crate) load: A::Load,
}

impl<A: Appraise> Leaf<A> {
    /// A leaf that no level has received yet.
    pub(crate) fn new(key: A::Key, node: NodeId, depth: usize, pending: u32, load: A::Load) -> Self {
        Leaf { key, arrival: u32::MAX, node, depth: depth as u32, pending, load }
    }

    pub(crate) fn depth(&self) -> usize {
        self.depth as usize
    }

    pub(crate) fn is_closed(&self) -> bool {
        self.pending == 0
    }

    /// Whether so many travels more can use up its pending gateways, two at most each.
    pub(crate) fn is_closable(&self, travels: usize) -> bool {
        self.pending as usize <= 2 * (travels - self.depth())
    }
}

impl<A: Appraise> Clone for Leaf<A> {
    fn clone(&self) -> Self {
        let Leaf { key, arrival, node, depth, pending, ref load } = *self;
        Leaf { key, arrival, node, depth, pending, load: load.clone() }
    }
}

/// The lower its key the sooner, then the older.
impl<A: Appraise> Ord for Leaf<A> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key.cmp(&other.key).then(self.arrival.cmp(&other.arrival))
    }
}

impl<A: Appraise> PartialOrd for Leaf<A> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<A: Appraise> PartialEq for Leaf<A> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<A: Appraise> Eq for Leaf<A> {}

/// What the recursive step makes of a leaf. The leaves' nodes are not in the tree yet.
#[derive(Debug)]
pub(crate) struct Grown<A: Appraise> {
    pub(crate) outcome: Outcome,
    pub(crate) removals: Removals,
    pub(crate) successors: Vec<(Child, Leaf<A>)>,
    /// The leaf once more, for the successors that were not spelled out yet.
    pub(crate) rest: Option<Leaf<A>>,
}

/// What came of an attempt to grow a leaf: no successors if a layout cannot be computed.
pub(crate) type Growth<A> = Result<Grown<A>, SolveError>;

/// Whether something that matters may come of a leaf.
pub(crate) fn matters<A: Appraise>(appraiser: &A, leaf: &Leaf<A>, reach: Option<A::Key>) -> bool {
    appraiser.is_possible(leaf)
        && reach.is_none_or(|reach| appraiser.bound(leaf).is_none_or(|bound| bound <= reach))
}
