//! The links of a region as one network: where they run together they are one way, and where they part is a branch.

use std::collections::{BTreeMap, BTreeSet};

use super::links::{Link, length};
use super::spread::spread;
use super::window::Window;

/// The network of a region by positions in its window.
pub(super) struct Network {
    /// The terminals in their order, then the branches.
    pub(super) nodes: Vec<usize>,
    /// The ways, each from one node to another.
    pub(super) ways: Vec<Stretch>,
    /// The ways that end at each node, by their numbers.
    ways_at: Vec<Vec<usize>>,
}

/// A way between two nodes.
#[derive(Clone)]
pub(super) struct Stretch {
    /// The nodes by their numbers in the network.
    pub(super) ends: [usize; 2],
    /// The positions from the one to the other.
    pub(super) path: Vec<usize>,
    /// How long it is, in cells.
    pub(super) length: f64,
}

impl Stretch {
    /// The end that is not at a node.
    fn other_end(&self, node: usize) -> usize {
        if self.ends[0] == node { self.ends[1] } else { self.ends[0] }
    }

    /// The same way as seen from one of its ends.
    fn from(mut self, node: usize) -> Self {
        if self.ends[0] != node {
            self.ends.reverse();
            self.path.reverse();
        }
        self
    }
}

/// What may be left out of a network; lengths in cells.
#[derive(Clone, Copy)]
pub(super) struct Pruning {
    /// So many of the terminals, the first ones, are there to stay.
    pub(super) fixed: usize,
    /// Branches nearer to one another than this become one.
    pub(super) shortest: f64,
    /// Ways that lead nowhere count from this length on.
    pub(super) arm: f64,
}

/// The network of links between terminals, without what does not matter.
pub(super) fn network(window: &Window<'_>, terminals: &[usize], links: &[Link], pruning: Pruning) -> Network {
    let mut neighbors: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for pair in links.iter().flat_map(|link| link.path.windows(2)).filter(|pair| pair[0] != pair[1]) {
        neighbors.entry(pair[0]).or_default().insert(pair[1]);
        neighbors.entry(pair[1]).or_default().insert(pair[0]);
    }
    let mut nodes = terminals.to_vec();
    let is_terminal: BTreeSet<usize> = terminals.iter().copied().collect();
    nodes.extend(
        neighbors.iter().filter(|(at, near)| near.len() > 2 && !is_terminal.contains(at)).map(|(&at, _)| at),
    );
    let number: BTreeMap<usize, usize> =
        nodes.iter().enumerate().rev().map(|(number, &position)| (position, number)).collect();
    let mut ways = Vec::new();
    for (&start, &from) in &number {
        for &first in neighbors.get(&start).into_iter().flatten() {
            let mut path = vec![start, first];
            while !number.contains_key(&path[path.len() - 1]) {
                let [before, here] = [path[path.len() - 2], path[path.len() - 1]];
                let Some(&next) = neighbors[&here].iter().find(|&&next| next != before) else { break };
                path.push(next);
            }
            let Some(&to) = number.get(&path[path.len() - 1]) else { continue };
            // Each way is followed from both its ends; of a loop, one direction is as good as the other.
            if from < to || (from == to && path[1] < path[path.len() - 2]) {
                ways.push(Stretch { ends: [from, to], length: length(window, &path), path });
            }
        }
    }
    let mut network = Network { ways_at: vec![Vec::new(); nodes.len()], nodes, ways };
    while network.contract(pruning) || network.cut_spur(pruning) || network.dissolve(pruning) {}
    for (number, way) in network.ways.iter().enumerate() {
        let [from, to] = way.ends;
        network.ways_at[from].push(number);
        if to != from {
            network.ways_at[to].push(number);
        }
    }
    network
}

impl Network {
    /// How many ways end at each node.
    fn degrees(&self) -> Vec<usize> {
        let mut degrees = vec![0; self.nodes.len()];
        self.ways.iter().flat_map(|way| way.ends).for_each(|end| degrees[end] += 1);
        degrees
    }

    /// Takes out a short way from a branch to nowhere; whether there was any.
    fn cut_spur(&mut self, Pruning { fixed, arm, .. }: Pruning) -> bool {
        let degrees = self.degrees();
        let is_spur =
            |way: &Stretch| way.length < arm && way.ends.iter().any(|&end| end >= fixed && degrees[end] == 1);
        let spur = self.ways.iter().position(is_spur);
        spur.map(|spur| self.ways.swap_remove(spur)).is_some()
    }

    /// Makes one way of two that meet where nothing else does; whether there were any.
    fn dissolve(&mut self, Pruning { fixed, .. }: Pruning) -> bool {
        let degrees = self.degrees();
        for node in (fixed..self.nodes.len()).filter(|&node| degrees[node] == 2) {
            let own: Vec<usize> =
                (0..self.ways.len()).filter(|&way| self.ways[way].ends.contains(&node)).collect();
            // A loop has both its ends at one node.
            let [first, second] = own[..] else { continue };
            let after = self.ways.swap_remove(second).from(node);
            let before = self.ways.swap_remove(first).from(node);
            let mut path: Vec<usize> = before.path.into_iter().rev().collect();
            path.extend(after.path.into_iter().skip(1));
            let length = before.length + after.length;
            self.ways.push(Stretch { ends: [before.ends[1], after.ends[1]], path, length });
            return true;
        }
        false
    }

    /// Makes one of two branches that are near to one another; whether there were any.
    fn contract(&mut self, Pruning { fixed, shortest, .. }: Pruning) -> bool {
        let is_short = |way: &Stretch| way.length < shortest && way.ends.iter().all(|&end| end >= fixed);
        let Some(at) = self.ways.iter().position(is_short) else { return false };
        let gone = self.ways.swap_remove(at);
        let [kept, lost] = gone.ends;
        if kept != lost {
            for way in &mut self.ways {
                if way.ends[0] == lost {
                    way.path.splice(0..1, gone.path.iter().copied());
                    way.ends[0] = kept;
                    way.length += gone.length;
                }
                if way.ends[1] == lost {
                    way.path.pop();
                    way.path.extend(gone.path.iter().rev());
                    way.ends[1] = kept;
                    way.length += gone.length;
                }
            }
            self.ways.retain(|way| way.ends != [kept, kept] || way.length >= 2.0 * shortest);
        }
        true
    }

    fn ways_at(&self, node: usize) -> impl Iterator<Item = &Stretch> {
        self.ways_at[node].iter().map(|&way| &self.ways[way])
    }

    /// The nodes within so many cells of one, each with how far it is, on ways that do not lead through `barred`.
    fn near(&self, start: usize, within: f64, barred: Option<usize>) -> impl Iterator<Item = (usize, f64)> {
        spread(start, within, move |node| {
            let onward = self.ways_at(node).map(move |way| (way.other_end(node), way.length));
            onward.filter(move |&(other, _)| Some(other) != barred)
        })
    }

    /// The nodes from which at least three ways lead on by `arm` cells, none nearer to another than that.
    pub(super) fn junctions(&self, arm: f64) -> Vec<usize> {
        let mut is_junction = vec![false; self.nodes.len()];
        for node in 0..self.nodes.len() {
            let leads_on = |way: &&Stretch| {
                let mut beyond = self.near(way.other_end(node), f64::INFINITY, Some(node));
                beyond.any(|(_, far)| way.length + far >= arm)
            };
            if self.ways_at[node].len() > 2 && self.ways_at(node).filter(leads_on).count() > 2 {
                let is_near = |(other, far): (usize, f64)| is_junction[other] && far < arm;
                is_junction[node] = !self.near(node, arm, None).any(is_near);
            }
        }
        (0..self.nodes.len()).filter(|&node| is_junction[node]).collect()
    }
}
