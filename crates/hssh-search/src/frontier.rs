//! Open hypotheses by how many travels they explain, and those set aside because nothing that matters can come of them.
//!
//! Whatever is unlikely to have its turn soon can be sent [elsewhere](Elsewhere). Who comes next does not depend on that.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::io;

use crate::elsewhere::{Elsewhere, Page};
use crate::leaf::{Appraise, Leaf};
use crate::pack::Pack;

/// So many leaves are sent away together, and taken back.
const PAGE: usize = 32;

/// A level that sends leaves away keeps this part of them, the best, and so many at least.
const KEPT: usize = 4;
const LEAST_KEPT: usize = 16;

/// The open hypotheses that explain one number of travels.
#[derive(Debug)]
struct Level<A: Appraise> {
    queue: BinaryHeap<Reverse<Leaf<A>>>,
    /// How many came here so far.
    arrivals: u32,
    /// Those elsewhere: what was sent away at one time, in order, the first page last.
    away: Vec<Vec<Page<A>>>,
}

impl<A: Appraise> Level<A> {
    fn new(arrivals: u32) -> Self {
        Level { queue: BinaryHeap::new(), arrivals, away: Vec::new() }
    }

    fn push(&mut self, mut leaf: Leaf<A>) {
        if leaf.arrival == u32::MAX {
            leaf.arrival = self.arrivals;
            self.arrivals += 1;
        }
        self.queue.push(Reverse(leaf));
    }

    /// The key and the arrival of the best in memory.
    fn here(&self) -> Option<(A::Key, u32)> {
        self.queue.peek().map(|Reverse(leaf)| (leaf.key, leaf.arrival))
    }

    /// The same of the best elsewhere, and with whom it was sent away.
    fn away(&self) -> Option<((A::Key, u32), usize)> {
        let firsts = self.away.iter().enumerate();
        firsts.filter_map(|(number, pages)| Some((pages.last()?.first, number))).min()
    }

    /// The key and the arrival of the best.
    fn first(&self) -> Option<(A::Key, u32)> {
        let away = self.away().map(|(first, _)| first);
        self.here().into_iter().chain(away).min()
    }
}

/// All hypotheses that are not expanded.
#[derive(Debug)]
pub(crate) struct Frontier<A: Appraise> {
    /// By number of travels explained.
    levels: Vec<Level<A>>,
    /// Nothing comes of them that matters, as far as is known.
    parked: Vec<Leaf<A>>,
    /// Those of them that were set aside first.
    parked_away: Vec<Page<A>>,
    /// Where leaves can be sent, if there is any such place.
    pub(crate) elsewhere: Option<Elsewhere>,
    /// What those elsewhere took in memory.
    bytes_away: u64,
}

/// What a checkpoint says of a page: the level and the part of it that it belongs to, or that it was set aside, and what the page says.
pub(crate) struct Told<A: Appraise> {
    pub(crate) part: Option<(u32, u32)>,
    pub(crate) page: Page<A>,
}

impl<A: Pack> Frontier<A> {
    pub(crate) fn new(elsewhere: Option<Elsewhere>) -> Self {
        let (parked, parked_away) = (Vec::new(), Vec::new());
        Frontier { levels: Vec::new(), parked, parked_away, elsewhere, bytes_away: 0 }
    }

    /// Makes levels for so many travels.
    pub(crate) fn make_room(&mut self, travels: usize) {
        self.levels.resize_with(travels + 1, || Level::new(0));
    }

    pub(crate) fn push(&mut self, leaf: Leaf<A>) {
        self.levels[leaf.depth()].push(leaf);
    }

    /// Takes the best of those that explain so many travels.
    pub(crate) fn pop(&mut self, depth: usize) -> Option<Leaf<A>> {
        self.fetch(depth);
        self.levels[depth].queue.pop().map(|Reverse(leaf)| leaf)
    }

    /// The key and the arrival of the best of those that explain so many travels.
    pub(crate) fn first(&self, depth: usize) -> Option<(A::Key, u32)> {
        self.levels[depth].first()
    }

    /// The best of a level is in memory.
    fn fetch(&mut self, depth: usize) {
        let Some(elsewhere) = &self.elsewhere else { return };
        let level = &mut self.levels[depth];
        while let Some((first, number)) = level.away()
            && level.here().is_none_or(|here| first < here)
        {
            let Some(page) = level.away[number].pop() else { return };
            level.away.retain(|pages| !pages.is_empty());
            self.bytes_away -= page.bytes;
            level.queue.extend(elsewhere.take(page).into_iter().map(Reverse));
        }
    }

    /// Takes out everything that explains so many travels, as if nothing had ever come there.
    pub(crate) fn empty(&mut self, depth: usize) -> Vec<Leaf<A>> {
        let mut leaves = self.take_level(depth);
        self.levels[depth].arrivals = 0;
        leaves.shrink_to_fit();
        leaves
    }

    fn take_level(&mut self, depth: usize) -> Vec<Leaf<A>> {
        let level = &mut self.levels[depth];
        let mut leaves: Vec<Leaf<A>> =
            std::mem::take(&mut level.queue).into_iter().map(|Reverse(leaf)| leaf).collect();
        if let Some(elsewhere) = &self.elsewhere {
            for page in std::mem::take(&mut level.away).into_iter().flatten() {
                self.bytes_away -= page.bytes;
                leaves.extend(elsewhere.take(page));
            }
        }
        leaves
    }

    /// Sets a hypothesis aside.
    pub(crate) fn park(&mut self, leaf: Leaf<A>) {
        self.parked.push(leaf);
    }

    /// Takes back what was set aside and may matter now.
    pub(crate) fn unpark(&mut self, matters: impl Fn(&Leaf<A>) -> bool) {
        let mut left = self.unpark_away(&matters);
        for leaf in self.parked.extract_if(.., |leaf| matters(leaf)) {
            self.levels[leaf.depth as usize].push(leaf);
        }
        if !left.is_empty() {
            left.append(&mut self.parked);
            self.parked = left;
        }
    }

    /// The same for those elsewhere; those that stay aside but in memory, if they cannot be sent away again.
    fn unpark_away(&mut self, matters: impl Fn(&Leaf<A>) -> bool) -> Vec<Leaf<A>> {
        let mut left = Vec::new();
        let Some(elsewhere) = &self.elsewhere else { return left };
        for page in std::mem::take(&mut self.parked_away) {
            let mut leaves = elsewhere.look(&page);
            if left.is_empty() && !leaves.iter().any(&matters) {
                self.parked_away.push(page);
                continue;
            }
            let each = page.bytes / (page.leaves as u64).max(1);
            self.bytes_away -= page.bytes;
            elsewhere.drop(page);
            for leaf in leaves.extract_if(.., |leaf| matters(leaf)) {
                self.levels[leaf.depth as usize].push(leaf);
            }
            let kept =
                if left.is_empty() { elsewhere.keep(&leaves, each * leaves.len() as u64) } else { None };
            match kept {
                Some(page) => {
                    self.bytes_away += page.bytes;
                    self.parked_away.push(page);
                }
                None => left.append(&mut leaves),
            }
        }
        left
    }

    /// Takes out everything there is.
    pub(crate) fn drain(&mut self) -> Vec<Leaf<A>> {
        let mut leaves = Vec::new();
        for depth in 0..self.levels.len() {
            leaves.append(&mut self.take_level(depth));
        }
        if let Some(elsewhere) = &self.elsewhere {
            for page in std::mem::take(&mut self.parked_away) {
                self.bytes_away -= page.bytes;
                leaves.extend(elsewhere.take(page));
            }
        }
        leaves.append(&mut self.parked);
        leaves
    }

    /// How many travels the hypothesis explains whose turn it is among all: of equal ones the deepest.
    pub(crate) fn next_level(&self) -> Option<usize> {
        let heads = self.levels.iter().enumerate();
        let heads = heads.filter_map(|(depth, level)| Some((level.first()?.0, Reverse(depth))));
        heads.min().map(|(_, Reverse(depth))| depth)
    }

    /// Takes the next hypotheses of the least key there is, at most that many, the deepest first.
    pub(crate) fn pop_equals(&mut self, most: usize) -> Vec<Leaf<A>> {
        let Some((key, _)) = self.next_level().and_then(|depth| self.first(depth)) else {
            return Vec::new();
        };
        let mut leaves = Vec::new();
        for depth in (0..self.levels.len()).rev() {
            while leaves.len() < most && self.first(depth).is_some_and(|first| first.0 == key) {
                leaves.extend(self.pop(depth));
            }
        }
        leaves
    }

    /// Sends away what was set aside, and of each level all but the best; how many bytes that frees.
    pub(crate) fn send_away(&mut self, bytes: impl Fn(&Leaf<A>) -> u64) -> u64 {
        let Some(elsewhere) = self.elsewhere.as_ref().filter(|elsewhere| !elsewhere.is_full()) else {
            return 0;
        };
        let before = self.bytes_away;
        let mut pages = |leaves: &mut Vec<Leaf<A>>| {
            let mut sent = Vec::new();
            while let Some(page) = {
                let together = &leaves[..leaves.len().min(PAGE)];
                elsewhere.keep(together, together.iter().map(&bytes).sum())
            } {
                leaves.drain(..page.leaves);
                self.bytes_away += page.bytes;
                sent.push(page);
            }
            sent
        };
        self.parked_away.append(&mut pages(&mut self.parked));
        self.parked.shrink_to_fit();
        for level in self.levels.iter_mut().filter(|level| level.queue.len() > LEAST_KEPT) {
            let mut leaves: Vec<Leaf<A>> =
                std::mem::take(&mut level.queue).into_iter().map(|Reverse(leaf)| leaf).collect();
            leaves.sort_unstable();
            let mut worse = leaves.split_off(LEAST_KEPT.max(leaves.len() / KEPT));
            let mut sent = pages(&mut worse);
            leaves.append(&mut worse);
            leaves.shrink_to_fit();
            level.queue = leaves.into_iter().map(Reverse).collect();
            if !sent.is_empty() {
                sent.reverse();
                level.away.push(sent);
            }
        }
        self.bytes_away - before
    }

    /// What those elsewhere took in memory.
    pub(crate) fn bytes_away(&self) -> u64 {
        self.bytes_away
    }

    /// Why some of those elsewhere are lost, if they are.
    pub(crate) fn lost(&self) -> Option<&io::Error> {
        self.elsewhere.as_ref()?.lost()
    }

    /// Those in memory that wait for their turn, in no order that means anything.
    pub(crate) fn queued(&self) -> impl Iterator<Item = &Leaf<A>> {
        self.levels.iter().flat_map(|level| &level.queue).map(|Reverse(leaf)| leaf)
    }

    /// Those in memory that were set aside, in the order in which they were.
    pub(crate) fn parked(&self) -> impl Iterator<Item = &Leaf<A>> {
        self.parked.iter()
    }

    /// How many came to each level.
    pub(crate) fn arrivals(&self) -> impl Iterator<Item = u32> {
        self.levels.iter().map(|level| level.arrivals)
    }

    /// The pages elsewhere, and where they belong.
    pub(crate) fn pages(&self) -> impl Iterator<Item = (Option<(u32, u32)>, &Page<A>)> {
        let of_levels = self.levels.iter().enumerate().flat_map(|(depth, level)| {
            let parts = level.away.iter().enumerate();
            parts.flat_map(move |(part, pages)| {
                pages.iter().map(move |page| (Some((depth as u32, part as u32)), page))
            })
        });
        of_levels.chain(self.parked_away.iter().map(|page| (None, page)))
    }

    /// Puts everything where it was when so many had come to each level.
    pub(crate) fn restore(
        &mut self,
        queued: Vec<Leaf<A>>,
        parked: Vec<Leaf<A>>,
        arrivals: Vec<u32>,
        pages: Vec<Told<A>>,
    ) {
        self.levels = arrivals.into_iter().map(Level::new).collect();
        queued.into_iter().for_each(|leaf| self.push(leaf));
        self.parked = parked;
        let mut last = None;
        for Told { part, page } in pages {
            self.bytes_away += page.bytes;
            match part {
                None => self.parked_away.push(page),
                Some((depth, _)) => {
                    let away = &mut self.levels[depth as usize].away;
                    if last != part {
                        away.push(Vec::new());
                    }
                    away.last_mut().expect("one was pushed").push(page);
                }
            }
            last = part;
        }
    }

    /// How many hypotheses there are.
    pub(crate) fn len(&self) -> u64 {
        let away = self.pages().map(|(_, page)| page.leaves).sum::<usize>();
        (self.queued().count() + self.parked.len() + away) as u64
    }

    /// Shows all hypotheses, in no order that means anything.
    pub(crate) fn visit(&self, mut each: impl FnMut(&Leaf<A>)) {
        self.queued().chain(&self.parked).for_each(&mut each);
        if let Some(elsewhere) = &self.elsewhere {
            self.pages().for_each(|(_, page)| elsewhere.look(page).iter().for_each(&mut each));
        }
    }
}
