//! Open hypotheses with what they cost.

use std::cmp::Ordering;
use std::sync::Arc;

use hssh_metrics::Pose;

use crate::posterior::cost::Cost;
use crate::posterior::layout::Layout;
use crate::tree::NodeId;

/// How a hypothesis is laid out. Nothing is solved before its turn.
#[derive(Clone, Debug)]
pub(crate) enum Placing {
    /// Solved.
    Done(Arc<Layout>),
    /// As its parent, with one place more where the travel leads.
    Grown(Arc<Layout>),
    /// The last travel connects known places of its parent's layout. The linear estimate says what χ² will
    /// become.
    Strained(Arc<Layout>, f64),
}

/// A hypothesis that is not expanded yet.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    pub(crate) node: NodeId,
    pub(crate) depth: usize,
    /// What it costs; while it is strained, at least.
    pub(crate) cost: Cost,
    /// The least ln F of all maps that may come of it.
    pub(crate) least_complexity: f64,
    /// What every map that comes of it costs at least.
    pub(crate) bound: f64,
    /// What decides its turn.
    pub(crate) turn: f64,
    /// Its pending gateways.
    pub(crate) pending: u32,
    pub(crate) placing: Placing,
}

impl Leaf {
    /// Whether its cost is known.
    pub(crate) fn is_settled(&self) -> bool {
        !matches!(self.placing, Placing::Strained(..))
    }

    /// Bytes that it takes, counted as if it shared its layout with no other.
    pub(crate) fn bytes(&self) -> u64 {
        let (Placing::Done(layout) | Placing::Grown(layout) | Placing::Strained(layout, _)) = &self.placing;
        (size_of::<Leaf>() + layout.poses.len() * size_of::<Pose>()) as u64
    }
}

/// The lower its turn the sooner, then the deeper, then the older.
impl Ord for Leaf {
    fn cmp(&self, other: &Self) -> Ordering {
        let deeper_first = other.depth.cmp(&self.depth);
        self.turn.total_cmp(&other.turn).then(deeper_first).then(self.node.cmp(&other.node))
    }
}

impl PartialOrd for Leaf {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Leaf {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Leaf {}
