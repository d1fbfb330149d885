//! Certificates: what a proof rests on, as text that another program can check by itself.
//!
//! The format is described in docs/certificate.md.

use std::fmt::Write;

use hssh_causal::Exploration;
use hssh_metrics::SolveError;
use hssh_topology::{GenusRank, Measure};

use crate::builder::{MapperBuilder, Objective};
use crate::context::Context;
use crate::cursor::Cursor;
use crate::engine::{Engine, log_sum};
use crate::experience::Experience;
use crate::fingerprint::fingerprint;
use crate::leaf::{Appraise, Leaf};
use crate::order::{Goal, Order};
use crate::pack::Pack;
use crate::posterior::{ByPosterior, MapPrior, Metrical, PlacePrior};
use crate::preference::ByPreference;
use crate::report::Score;
use crate::tree::{NodeId, Tree};

/// What a certificate says of a node of the tree.
#[derive(Clone, Copy, Debug)]
enum Entry {
    /// The recursive step was applied.
    Expanded,
    /// Every map that comes of it is worth no more than that.
    Open(Score),
    /// It explains everything and is worth that.
    Found(Score),
    /// No closed map comes of it.
    TurnedDown,
}

/// Of a search by preference.
pub(crate) fn by_preference(
    engine: &Engine<ByPreference>,
    options: &MapperBuilder,
    experience: &Experience,
    exploration: &Exploration,
) -> String {
    let preference = engine.appraiser.preference;
    let genus = match preference.genus {
        GenusRank::Ignored => "ignored",
        GenusRank::First => "first",
        GenusRank::Last => "last",
    };
    let mut entries = entries(engine, &open(engine));
    // Of a map the genus is told, whether or not it counts.
    let travels = engine.travels();
    let mut cursor = Cursor::new(experience);
    for node in engine.tree.nodes().filter(|&node| engine.tree.depth(node) == travels) {
        if options.order == Order::BreadthFirst || matches!(entries[node.index()], Entry::Found(_)) {
            let measure = Measure::of(&cursor.go_to(node, &engine.tree, experience).map);
            entries[node.index()] = Entry::Found(Score::Measure(measure));
        }
    }
    let mut text = head(options, exploration);
    let _ = writeln!(text, "objective preference {genus}");
    let measures = entries.iter().filter_map(|entry| match entry {
        Entry::Found(Score::Measure(measure)) => Some(*measure),
        _ => None,
    });
    let best = measures.min_by_key(|measure| preference.rank(*measure)).map(Score::Measure);
    text += &body(&engine.tree, &entries, best, "");
    text
}

/// Of a search by posterior. All open hypotheses are laid out first, so that no bound rests on a linear estimate. `None` if that
/// shows that one of them is no worse than the best map, or cannot be laid out.
pub(crate) fn by_posterior(
    engine: &Engine<ByPosterior>,
    options: &MapperBuilder,
    exploration: &Exploration,
    context: Context<'_>,
) -> Option<String> {
    let appraiser = &engine.appraiser;
    let open = laid_out(engine, context)?;
    let best = engine.found.first().map(|found| found.leaf.key);
    let reach = best.map(|best| appraiser.reach(best, 0.0));
    if open
        .iter()
        .any(|leaf| reach.is_none_or(|reach| appraiser.bound(leaf).is_none_or(|bound| bound <= reach)))
    {
        return None;
    }
    let rest = rest(engine, &open);
    let mut text = head(options, exploration);
    text += "objective posterior\n";
    if let Objective::Posterior(model) = options.objective {
        text += &match (model.metrical, engine.appraiser.tariff.corridor()) {
            (Metrical::Ignored, _) => "metrical ignored\n".to_owned(),
            (Metrical::Evidence(PlacePrior::Uniform(prior)), _) => {
                format!("metrical evidence uniform {:?}\n", prior.area())
            }
            (Metrical::Evidence(_), Some(corridor)) => {
                let crate::Corridor { length, spread, deviation, crooked } = corridor;
                format!("metrical evidence corridor {length:?} {spread:?} {deviation:?} {crooked:?}\n")
            }
            (Metrical::Likelihood | Metrical::Evidence(_), _) => "metrical likelihood\n".to_owned(),
        };
        text += &match model.prior {
            MapPrior::Flat => "prior flat\n".to_owned(),
            MapPrior::Choices => "prior choices\n".to_owned(),
            MapPrior::Simplicity(weights) => {
                format!("prior simplicity {:?} {:?} {:?}\n", weights.c1, weights.c2, weights.c3)
            }
        };
    }
    for (later, earlier, rotation, ratio) in engine.appraiser.appearance.ratios() {
        let _ = writeln!(text, "appearance {later} {earlier} {rotation} {ratio:?}");
    }
    let mut after = String::new();
    let _ = writeln!(after, "rest {rest:?}");
    if engine.appraiser.measured.is_some() {
        let _ = writeln!(after, "trust lowest-minimum {}", engine.solved + open.len() as u64);
    }
    let best = best.map(|best| appraiser.score(best));
    text += &body(&engine.tree, &entries(engine, &open), best, &after);
    Some(text)
}

/// The probability of all maps that were not found, at most, with no open hypothesis left to a linear estimate. `None` if one of them
/// cannot be laid out.
pub(crate) fn rest_laid_out(engine: &Engine<ByPosterior>, context: Context<'_>) -> Option<f64> {
    Some(rest(engine, &laid_out(engine, context)?))
}

/// The open hypotheses, laid out: bounds that rest on no linear estimate of their own.
fn laid_out(engine: &Engine<ByPosterior>, context: Context<'_>) -> Option<Vec<Leaf<ByPosterior>>> {
    let Engine { appraiser, tree, .. } = engine;
    let open = context.crew.map(&open(engine), context.experience, |cursor, leaf| {
        let (mut leaf, mut laid_out) = (leaf.clone(), leaf.clone());
        appraiser.settle(&mut laid_out, cursor, tree, context)?;
        // What was estimated is told as long as it is less: of layouts bent out of all measure a lower one may exist.
        leaf.load.bound = leaf.load.bound.min(laid_out.load.bound);
        Ok::<_, SolveError>(leaf)
    });
    open.into_iter().collect::<Result<Vec<_>, _>>().ok()
}

/// All hypotheses that are not expanded.
fn open<A: Pack>(engine: &Engine<A>) -> Vec<Leaf<A>> {
    let mut open = Vec::new();
    engine.frontier.visit(|leaf| open.push(leaf.clone()));
    open
}

/// The probability of all maps that were not found, at most.
fn rest(engine: &Engine<ByPosterior>, open: &[Leaf<ByPosterior>]) -> f64 {
    let Engine { appraiser, found, .. } = engine;
    let found = log_sum(found.iter().map(|found| -appraiser.nats(found.leaf.key)));
    let open = log_sum(open.iter().map(|leaf| appraiser.log_mass(leaf)));
    if open == f64::NEG_INFINITY { 0.0 } else { 1.0 / (1.0 + (found - open).exp()) }
}

fn head(options: &MapperBuilder, exploration: &Exploration) -> String {
    let (travels, stars) = (exploration.travels().len(), exploration.star_types().len());
    let print = fingerprint(exploration.to_ron().as_bytes());
    let axioms = &options.axioms;
    let most = |most: Option<u32>| most.map_or("null".to_owned(), |most| most.to_string());
    let goal = match (options.goal, options.order) {
        (Goal::ClosedMap, Order::BestFirst | Order::Cyclic | Order::Proof) => "closed",
        (Goal::AnyMap, _) | (_, Order::BreadthFirst) => "any",
    };
    let pairs = |word: &str, same: bool| -> String {
        let pairs = options.constraints.asked().filter(|&(_, is_same)| is_same == same);
        pairs.map(|([earlier, later], _)| format!("{word} {earlier} {later}\n")).collect()
    };
    let said = pairs("same", true) + &pairs("different", false);
    format!(
        "hssh-certificate 1\n\
         exploration {travels} {stars} {print:016x}\n\
         axioms {{\"no_self_intersection\":{},\"no_circular_path\":{},\"max_places\":{},\"max_genus\":{},\
         \"perpendicular\":{},\"consistent_boundaries\":{}}}\n\
         goal {goal}\n{said}",
        axioms.no_self_intersection,
        axioms.no_circular_path,
        most(axioms.max_places),
        most(axioms.max_genus),
        axioms.perpendicular,
        axioms.consistent_boundaries,
    )
}

/// What is said of each node: what was found, what is open, and that all others were expanded.
fn entries<A: Pack>(engine: &Engine<A>, open: &[Leaf<A>]) -> Vec<Entry> {
    let Engine { appraiser, tree, found, rejected, .. } = engine;
    let mut entries = vec![Entry::Expanded; tree.len()];
    let travels = engine.travels();
    for leaf in open {
        let is_map = leaf.depth() == travels && appraiser.is_settled(leaf);
        entries[leaf.node.index()] = match appraiser.bound(leaf) {
            _ if is_map && !engine.goal.accepts(leaf.is_closed()) => Entry::TurnedDown,
            _ if is_map => Entry::Found(appraiser.score(leaf.key)),
            Some(bound) => Entry::Open(appraiser.score(bound)),
            None => Entry::Open(appraiser.score(leaf.key)),
        };
    }
    for found in found {
        entries[found.leaf.node.index()] = Entry::Found(appraiser.score(found.leaf.key));
    }
    for leaf in rejected {
        entries[leaf.node.index()] = Entry::TurnedDown;
    }
    entries
}

/// The values, and the tree in depth-first order. The children of a node stand together, in the order of choice.
fn body(tree: &Tree, entries: &[Entry], best: Option<Score>, more: &str) -> String {
    let maps = entries.iter().filter(|entry| matches!(entry, Entry::Found(_))).count();
    let mut text = format!("best {}\nmaps {maps}\n{more}tree\n", best.map_or("none".to_owned(), plain));

    let mut first_child = vec![u32::MAX; tree.len()];
    let mut children = vec![0_u32; tree.len()];
    for node in tree.nodes() {
        if let Some(parent) = tree.parent(node) {
            let first = &mut first_child[parent.index()];
            *first = (*first).min(node.index() as u32);
            children[parent.index()] += 1;
        }
    }
    let mut expanded = 0_u64;
    let flush = |text: &mut String, expanded: &mut u64| {
        if *expanded > 0 {
            let _ = writeln!(text, "e {expanded}");
            *expanded = 0;
        }
    };
    let mut stack = vec![NodeId::ROOT];
    while let Some(node) = stack.pop() {
        match entries[node.index()] {
            Entry::Expanded => expanded += 1,
            entry => {
                flush(&mut text, &mut expanded);
                match entry {
                    Entry::Open(score) => text += &format!("o {}\n", plain(score)),
                    Entry::Found(score) => text += &format!("f {}\n", plain(score)),
                    _ => text += "x\n",
                }
            }
        }
        let first = first_child[node.index()];
        stack.extend((0..children[node.index()]).rev().map(|child| NodeId::new(first + child)));
    }
    flush(&mut text, &mut expanded);
    text += "end\n";
    text
}

fn plain(score: Score) -> String {
    match score {
        Score::Measure(Measure { undetermined_boundaries, paths, places, genus }) => {
            format!("{undetermined_boundaries} {paths} {places} {genus}")
        }
        Score::Nats(nats) => format!("{nats:?}"),
    }
}
