//! A naive prover for small explorations: it copies a map for every node, traces everything by walking, and
//! descends with derivatives by finite differences. It shares no code with the checker.

pub(crate) mod costs;
pub(crate) mod map;

use std::fmt::Write;

use hssh_causal::Exploration;
use hssh_topology::Axioms;

use costs::{Costs, Terms};
use map::Hypothesis;

/// What a proof is asked for.
pub(crate) struct Question<'a> {
    pub(crate) exploration: &'a Exploration,
    pub(crate) axioms: Axioms,
    pub(crate) closed: bool,
    pub(crate) objective: Objective,
    /// Whether nodes worse than the best are left open.
    pub(crate) prune: bool,
}

/// What makes a map the best.
#[derive(Clone)]
pub(crate) enum Objective {
    Preference(&'static str),
    Posterior(Terms),
}

/// A certificate with what it was made from.
#[allow(dead_code)] // not every test looks at more than the text
pub(crate) struct Proof {
    pub(crate) text: String,
    /// Hypotheses by the number of travels that they explain.
    pub(crate) levels: Vec<u64>,
    pub(crate) maps: u64,
    pub(crate) best: Option<Vec<f64>>,
    /// By node: the number of its line in the certificate, and the least value of the maps below it.
    pub(crate) least_below: Vec<(usize, Option<Vec<f64>>)>,
}

struct Search<'a> {
    question: &'a Question<'a>,
    best: Option<Vec<f64>>,
    tree: String,
    levels: Vec<u64>,
    maps: u64,
    left: f64,
    found: f64,
    least_below: Vec<(usize, Option<Vec<f64>>)>,
}

impl Question<'_> {
    pub(crate) fn new(exploration: &Exploration, objective: Objective) -> Question<'_> {
        Question { exploration, axioms: Axioms::default(), closed: false, objective, prune: false }
    }

    /// The certificate: first everything is looked at, then again with what was best in mind.
    pub(crate) fn prove(&self) -> Proof {
        let all = self.search(None);
        let search = if self.prune { self.search(all.best.clone()) } else { self.search(None) };
        let mut text = format!(
            "hssh-certificate 1\n{}\naxioms {}\ngoal {}\n",
            hssh_verify::exploration_line(self.exploration),
            serde_json::to_string(&self.axioms).unwrap(),
            if self.closed { "closed" } else { "any" },
        );
        match &self.objective {
            Objective::Preference(genus) => writeln!(text, "objective preference {genus}").unwrap(),
            Objective::Posterior(terms) => text += &terms.head(),
        }
        match &all.best {
            None => text += "best none\n",
            Some(best) => writeln!(text, "best {}", self.write(best)).unwrap(),
        }
        writeln!(text, "maps {}", search.maps).unwrap();
        if let Objective::Posterior(terms) = &self.objective {
            writeln!(
                text,
                "rest {:?}",
                if search.left > 0.0 { search.left / (search.left + search.found) } else { 0.0 }
            )
            .unwrap();
            if terms.metrical != "ignored" {
                text += "trust lowest-minimum 17\n";
            }
        }
        text += "tree\n";
        let head = text.lines().count();
        let least_below =
            search.least_below.iter().map(|(line, least)| (head + line, least.clone())).collect();
        text += &search.tree;
        text += "end\n";
        Proof { text, levels: search.levels, maps: search.maps, best: all.best, least_below }
    }

    fn search(&self, best: Option<Vec<f64>>) -> Search<'_> {
        let levels = vec![0; self.exploration.travels().len() + 1];
        let mut search = Search {
            question: self,
            best,
            tree: String::new(),
            levels,
            maps: 0,
            left: 0.0,
            found: 0.0,
            least_below: Vec::new(),
        };
        let known = search.best.clone();
        search.visit(&Hypothesis::root(self.exploration), &Costs::default(), known.as_deref());
        search
    }

    pub(crate) fn write(&self, value: &[f64]) -> String {
        match &self.objective {
            // Kept in the order of preference; written f1, f2, f3, genus.
            Objective::Preference("first") => format!("{} {} {} {}", value[1], value[2], value[3], value[0]),
            Objective::Preference(_) => format!("{} {} {} {}", value[0], value[1], value[2], value[3]),
            Objective::Posterior(_) => format!("{:?}", value[0]),
        }
    }

    fn rank(&self, [f1, f2, f3, genus]: [usize; 4]) -> Vec<f64> {
        let (f, genus) = ([f1 as f64, f2 as f64, f3 as f64], genus as f64);
        match &self.objective {
            Objective::Preference("first") => vec![genus, f[0], f[1], f[2]],
            _ => vec![f[0], f[1], f[2], genus],
        }
    }

    fn is_less(&self, a: &[f64], b: &[f64]) -> bool {
        let counted = if matches!(self.objective, Objective::Preference("ignored")) { 3 } else { a.len() };
        a[..counted] < b[..counted]
    }
}

impl Search<'_> {
    fn visit(&mut self, node: &Hypothesis, costs: &Costs, known: Option<&[f64]>) -> Option<Vec<f64>> {
        let at = self.least_below.len();
        self.least_below.push((at + 1, None)); // every node has one line
        let least = self.value(node, costs, known);
        self.least_below[at].1.clone_from(&least);
        least
    }

    fn value(&mut self, node: &Hypothesis, costs: &Costs, known: Option<&[f64]>) -> Option<Vec<f64>> {
        let question = self.question;
        let travels = question.exploration.travels().len();
        self.levels[node.explained] += 1;
        let left = travels - node.explained;
        if question.closed && node.pending().len() > 2 * left {
            self.tree += "x\n";
            return None;
        }
        if left == 0 {
            let value = match &question.objective {
                Objective::Preference(_) => {
                    question.rank([node.f1(), node.paths().len(), node.places.len(), node.genus()])
                }
                Objective::Posterior(terms) => vec![terms.total(node, costs)],
            };
            writeln!(self.tree, "f {}", question.write(&value)).unwrap();
            self.maps += 1;
            self.found += (-value[0]).exp();
            if self.best.as_ref().is_none_or(|best| question.is_less(&value, best)) {
                self.best = Some(value.clone());
            }
            return Some(value);
        }
        if let Some(best) = known {
            // A bound that is weaker than the checker's.
            let bound = match &question.objective {
                Objective::Preference(place) => {
                    let genus = if *place == "ignored" { 0 } else { node.genus() };
                    question.rank([0, node.closed_ends().div_ceil(2), node.places.len(), genus])
                }
                Objective::Posterior(terms) => vec![terms.bound(question.exploration, node, costs)],
            };
            let worse = match &question.objective {
                Objective::Preference(_) => question.is_less(best, &bound),
                Objective::Posterior(_) => bound[0] > best[0] + 1e-5 * (1.0 + best[0].abs()),
            };
            if worse {
                writeln!(self.tree, "o {}", question.write(&bound)).unwrap();
                if let Objective::Posterior(terms) = &question.objective {
                    self.left += (terms.branches(question.exploration, node) - bound[0]).exp();
                }
                return None;
            }
        }
        self.tree += "e 1\n";
        let children = node.successors(question.exploration, &question.axioms);
        let mut least: Option<Vec<f64>> = None;
        for child in &children {
            let costs = match &question.objective {
                Objective::Preference(_) => Costs::default(),
                Objective::Posterior(terms) => {
                    terms.step(question.exploration, node, child, costs, children.len())
                }
            };
            if let Some(value) = self.visit(child, &costs, known)
                && least.as_ref().is_none_or(|least| question.is_less(&value, least))
            {
                least = Some(value);
            }
        }
        least
    }
}
