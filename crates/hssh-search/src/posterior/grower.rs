//! The recursive step with its costs: what each successor of a hypothesis pays.

use std::sync::Arc;

use hssh_metrics::{Marginals, SolveError};
use hssh_topology::{Extension, Hypothesis, Position};

use crate::context::Context;
use crate::crew::{Look, Scratch, Step, expand};
use crate::frames::Trail;
use crate::measured::{Measured, PlacedTravel};
use crate::posterior::appearance::Appearance;
use crate::posterior::cost::{Cost, Tariff};
use crate::posterior::layout::{Layout, Strain};
use crate::posterior::leaf::{Leaf, Placing};
use crate::report::Tally;
use crate::tree::{Child, Cursor, NodeId, Tree};

/// A rise of χ² that does not matter.
const NEGLIGIBLE: f64 = 0.1;

/// What decides the turn of a hypothesis that is not settled.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Guess {
    /// Its parent's layout, which is never worse than its own.
    Parent,
    /// The linear estimate.
    Linear,
}

/// Grows hypotheses and lays them out.
#[derive(Clone, Copy)]
pub(crate) struct Grower<'a> {
    pub(crate) context: Context<'a>,
    pub(crate) tariff: &'a Tariff,
    /// Nothing if the model ignores measurements.
    pub(crate) measured: Option<&'a Measured>,
    /// What visits look like beyond their stars.
    pub(crate) appearance: &'a Appearance,
    pub(crate) guess: Guess,
}

/// A successor before its travel is judged.
struct Successor {
    child: Child,
    position: Position,
    complexity: f64,
    least_complexity: f64,
    pending: u32,
}

/// A hypothesis that is being expanded, in metrical terms.
struct Departure {
    trail: Trail,
    layout: Arc<Layout>,
    /// The distribution of its layout, once a travel between known places asks for it.
    marginals: Option<Marginals>,
}

impl Grower<'_> {
    /// The tree's first leaf.
    pub(crate) fn root(&self) -> Leaf {
        let experience = self.context.experience;
        let map = Hypothesis::root(&experience.catalog, experience.start).map;
        let travels = self.context.travels() as u32;
        let cost = Cost { complexity: self.tariff.complexity(&map), ..Cost::default() };
        self.leaf(
            NodeId::ROOT,
            0,
            cost,
            self.tariff.least_complexity(&map, travels),
            map.pending_count(),
            Placing::Done(Layout::root()),
        )
    }

    fn leaf(
        &self,
        node: NodeId,
        depth: usize,
        cost: Cost,
        least_complexity: f64,
        pending: u32,
        placing: Placing,
    ) -> Leaf {
        let mut leaf = Leaf { node, depth, cost, least_complexity, bound: 0.0, turn: 0.0, pending, placing };
        self.appraise(&mut leaf);
        leaf
    }

    /// Sets what follows from a leaf's cost.
    fn appraise(&self, leaf: &mut Leaf) {
        let floor = Cost { complexity: leaf.least_complexity, ..leaf.cost };
        leaf.bound = self.tariff.bound(&floor, leaf.depth);
        leaf.turn = match (&leaf.placing, self.guess) {
            (Placing::Strained(origin, _), Guess::Parent) => leaf.cost.with_chi2(origin.chi2).total(),
            (&Placing::Strained(_, promised), Guess::Linear) => leaf.cost.with_chi2(promised).total(),
            (Placing::Done(_) | Placing::Grown(_), _) => leaf.cost.total(),
        };
    }

    /// Lays a hypothesis out, so that its cost is known. By what factor χ² rose of what the linear estimate
    /// promised, if that was relied on.
    pub(crate) fn settle(
        &self,
        leaf: &mut Leaf,
        cursor: &mut Cursor,
        tree: &Tree,
    ) -> Result<f64, SolveError> {
        let (Placing::Strained(origin, promised), Some(measured)) = (&leaf.placing, self.measured) else {
            return Ok(1.0);
        };
        let trail = measured.frames.trail(cursor.visits(leaf.node, tree, self.context.experience));
        let mut layout = origin.bent(&trail, measured, *promised)?;
        // χ² cannot fall along a branch: where it seems to, the parent was caught in a local minimum.
        layout.chi2 = layout.chi2.max(origin.chi2);
        let relied_on = 2.0 * leaf.cost.bend > origin.chi2;
        let factor = (layout.chi2 - origin.chi2 + NEGLIGIBLE) / (promised - origin.chi2 + NEGLIGIBLE);
        let factor = if relied_on { factor } else { 1.0 };
        leaf.cost = leaf.cost.with_chi2(layout.chi2);
        leaf.placing = Placing::Done(Arc::new(layout));
        self.appraise(leaf);
        Ok(factor)
    }

    /// Applies the recursive step to a settled hypothesis.
    pub(crate) fn grow(
        &self,
        leaf: &Leaf,
        cursor: &mut Cursor,
        tree: &mut Tree,
        tally: &mut Tally,
    ) -> Result<Vec<Leaf>, SolveError> {
        let Context { experience, watch, .. } = self.context;
        let travel = leaf.depth;
        let travels_left = (self.context.travels() - travel - 1) as u32;
        let entry = experience.observations[travel].entry;
        let visits = cursor.visits(leaf.node, tree, experience);
        let first_visits = first_visits(&visits);
        let mut departure = self.departure(leaf, visits);

        let (mut successors, mut scratch) = (Vec::new(), Scratch::default());
        let outcome =
            expand(cursor, leaf.node, tree, self.context, &mut scratch, Look::Inside, |child, hypothesis| {
                let map = &hypothesis.map;
                successors.push(Successor {
                    child,
                    position: hypothesis.position_at(child.arrival, entry),
                    complexity: self.tariff.complexity(map),
                    least_complexity: self.tariff.least_complexity(map, travels_left),
                    pending: map.pending_count(),
                });
            });
        let step = Step { outcome, removals: scratch.removals };
        tally.enter(leaf.node, &step, successors.iter().map(|next| &next.child), tree);
        watch.add_nodes(successors.len() as u64);
        watch.explained(travel + 1);

        let choice = self.tariff.choice(successors.len());
        let mut leaves = Vec::with_capacity(successors.len());
        for Successor { child, position, complexity, least_complexity, pending } in successors {
            let is_choice = child.growth.is_some();
            let is_new_place = matches!(child.growth, Some((_, Extension::NewPlace)));
            let mut cost = Cost { complexity, ..leaf.cost };
            cost.choices += if is_choice { choice } else { 0.0 };
            if is_new_place {
                cost.places += self.tariff.new_place(travel);
                cost.appearance += self.appearance.of_new_place(travel + 1);
            } else {
                let first = first_visits[position.place.index()];
                cost.appearance += self.appearance.of_old_place(travel + 1, first, position.phi);
            }
            let placing = match &mut departure {
                None => Placing::Done(Layout::root()),
                Some(departure) if is_new_place => Placing::Grown(Arc::clone(&departure.layout)),
                Some(departure) => {
                    let strain = self.strain(departure, travel, position)?;
                    cost.vagueness += if self.tariff.is_evidence() { strain.vagueness } else { 0.0 };
                    let before = departure.layout.chi2;
                    cost = cost.with_chi2(before + strain.trust * strain.chi2);
                    Placing::Strained(Arc::clone(&departure.layout), before + strain.chi2)
                }
            };
            let node = tree.push(child);
            let next = self.leaf(node, travel + 1, cost, least_complexity, pending, placing);
            leaves.push(next);
        }
        Ok(leaves)
    }

    /// The layout of a hypothesis that is about to be expanded, and where the robot was in it.
    fn departure(&self, leaf: &Leaf, visits: Vec<Position>) -> Option<Departure> {
        let measured = self.measured?;
        let trail = measured.frames.trail(visits);
        let layout = match &leaf.placing {
            Placing::Done(layout) | Placing::Strained(layout, _) => Arc::clone(layout),
            Placing::Grown(origin) => {
                let last = measured.placed(&trail, leaf.depth - 1);
                Arc::new(origin.with_new_place(&last))
            }
        };
        Some(Departure { trail, layout, marginals: None })
    }

    /// What a travel costs that ends at a known place.
    fn strain(&self, departure: &mut Departure, travel: usize, to: Position) -> Result<Strain, SolveError> {
        let Some(measured) = self.measured else { return Ok(Strain::default()) };
        let placed: PlacedTravel = measured.placed_to(&departure.trail, travel, to);
        if departure.marginals.is_none() {
            departure.marginals = Some(departure.layout.marginals(&departure.trail, measured)?);
        }
        departure.marginals.as_ref().map_or(Ok(Strain::default()), |marginals| Strain::of(&placed, marginals))
    }

    /// The layout of a settled leaf.
    pub(crate) fn layout(&self, leaf: &Leaf, cursor: &mut Cursor, tree: &Tree) -> Option<Arc<Layout>> {
        self.departure(leaf, cursor.visits(leaf.node, tree, self.context.experience))
            .map(|departure| departure.layout)
    }
}

/// By place: the visit on which it was found.
fn first_visits(visits: &[Position]) -> Vec<usize> {
    let mut first = Vec::new();
    for (visit, position) in visits.iter().enumerate() {
        if position.place.index() == first.len() {
            first.push(visit);
        }
    }
    first
}
