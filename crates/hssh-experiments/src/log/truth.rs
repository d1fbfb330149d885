//! The true visits of the ACES log, and how many of them a survey found.

use std::error::Error;
use std::path::Path;

use hssh_local::{Survey, Visit};

/// A visit as it was: the place and the first and last scan near it.
struct TrueVisit {
    place: String,
    scans: (usize, usize),
}

/// The hand-made topology: `EDGE name name`, `VISIT name first last`.
pub(super) struct Truth {
    visits: Vec<TrueVisit>,
    edges: Vec<[String; 2]>,
}

impl Truth {
    pub(super) fn read(file: &Path) -> Result<Self, Box<dyn Error>> {
        let text = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
        let mut truth = Truth { visits: Vec::new(), edges: Vec::new() };
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["EDGE", from, to] => truth.edges.push([from.to_owned(), to.to_owned()]),
                ["VISIT", place, first, last] => truth.add(place, (first.parse()?, last.parse()?)),
                _ => {}
            }
        }
        Ok(truth)
    }

    /// Two visits to one place in succession are one.
    fn add(&mut self, place: &str, scans: (usize, usize)) {
        match self.visits.last_mut() {
            Some(before) if before.place == place => before.scans.1 = scans.1,
            _ => self.visits.push(TrueVisit { place: place.to_owned(), scans }),
        }
    }

    fn degree(&self, place: &str) -> usize {
        self.edges.iter().flatten().filter(|name| *name == place).count()
    }

    /// The place of a visit: that whose scans it shares.
    pub(super) fn place_of(&self, visit: &Visit) -> Option<&str> {
        let (first, last) = visit.scans;
        let meets = |truth: &&TrueVisit| truth.scans.0 <= last && first <= truth.scans.1;
        self.visits.iter().find(meets).map(|truth| truth.place.as_str())
    }

    /// Visits found, stars with the right number of ways out, and false places.
    pub(super) fn score(&self, survey: &Survey) -> String {
        let found = |truth: &&TrueVisit| {
            survey.visits.iter().any(|visit| visit.scans.0 <= truth.scans.1 && truth.scans.0 <= visit.scans.1)
        };
        let places: Vec<Option<&str>> = survey.visits.iter().map(|visit| self.place_of(visit)).collect();
        let is_right = |(visit, place): &(&Visit, &Option<&str>)| {
            place.is_some_and(|place| visit.star.gateways().count() == self.degree(place))
        };
        let right = survey.visits.iter().zip(&places).filter(is_right).count();
        let names: Vec<&str> = places.iter().map(|place| place.unwrap_or("?")).collect();
        format!(
            "  visits found {} of {}, stars right {right}, false places {}: {}",
            self.visits.iter().filter(found).count(),
            self.visits.len(),
            places.iter().filter(|place| place.is_none()).count(),
            names.join(" ")
        )
    }
}
