//! An answer as text: the account of the search, the verdict, and the ranking as a table.

use std::fmt::Write as _;

use hssh_topology::Axiom;

use super::certificate::Worth;
use super::map::AnsweredMap;
use super::search::{SearchObjective, SearchOrder};
use super::verdict::VerdictKind;
use super::{Answer, Assumption};

/// What to print of an answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Listing {
    /// Also what the search made of each travel, and what that took.
    pub levels: bool,
    /// Also which flags of the program show more.
    pub flags: bool,
}

impl Answer {
    /// The answer for people to read.
    #[must_use]
    pub fn to_text(&self, listing: Listing) -> String {
        let mut text = self.doubt().map(|doubt| format!("DOUBTFUL: {doubt}\n")).unwrap_or_default();
        text += &self.account();
        if listing.levels {
            text += &self.levels();
        }
        text += &self.misread();
        text += &self.conclusion(listing);
        text += &self.ranking(listing);
        text += &self.building.as_ref().map(|building| building.to_text(&self.visits)).unwrap_or_default();
        text
    }

    /// Why the best map may well be wrong, if it may.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        if let Some(warning) = self.warnings.iter().find(|warning| warning.is_serious()) {
            return Some(warning.to_string());
        }
        let [least, most] = self.maps.first()?.probability?;
        if most < 0.5 {
            return Some(format!("the best map has a probability of at most {most:.2}"));
        }
        (least < 0.5).then(|| {
            format!("how probable the best map is, is hardly known: between {least:.2} and {most:.2}")
        })
    }

    /// What the search did.
    fn account(&self) -> String {
        let (input, search, certificate) = (&self.input, &self.search, &self.certificate);
        let given = if self.readings.is_some() { "given what is taken for misread, " } else { "" };
        let explained = match input.travels {
            0 => "one place, and no travel to explain".to_owned(),
            _ => format!("{} of {} travels explained", input.explained, input.considered),
        };
        let mut text = format!("{given}{}: {} ({explained})\n", search.name(), search.stop);
        let found = &search.found;
        let tied = if certificate.proved { "optimal" } else { "share the best rank" };
        let rows = [
            ("nodes", Some(search.nodes)),
            ("maps", Some(search.maps_made)),
            ("refuted", Some(search.refuted)),
            ("layouts solved", (search.objective == SearchObjective::Posterior).then_some(search.layouts)),
            ("final maps", Some(found.maps)),
            ("nearly closed", found.nearly_closed),
            ("closed", Some(found.closed)),
            ("closed, perpendicular", found.perpendicular),
            (tied, Some(found.tied)),
        ];
        for (name, count) in rows {
            if let Some(count) = count {
                let _ = writeln!(text, "  {name:<32}{count:>14}");
            }
        }
        if let Some(removals) = &search.removals {
            for axiom in Axiom::ALL {
                let removed = removals.by(axiom);
                if removed > 0 {
                    let _ = writeln!(text, "  removed: {:<23}{removed:>14}", axiom.to_string());
                }
            }
        }
        if let Some(evidence) = &input.evidence {
            let _ = writeln!(
                text,
                "  returns shown by the laser      {:>14}\n  … not confirmed by it           {:>14}\n  … contradicted by the rest      {:>14}\n  nothing of this misleads with a probability of {:.3}",
                evidence.returns, evidence.unconfirmed, evidence.contradicted, evidence.probability
            );
        }
        text + &self.proof()
    }

    /// What is taken for misread, visit by visit.
    fn misread(&self) -> String {
        let Some(readings) = &self.readings else { return String::new() };
        let mut text = format!(
            "  errors of perception            {:>14}\n  … cost                          {:>14.3} of {:.3} nats\n",
            readings.corrections.len(),
            readings.nats_of_errors,
            readings.nats
        );
        for correction in &readings.corrections {
            let _ = writeln!(text, "    {}", correction.sentence);
        }
        text
    }

    /// What is proved.
    fn proof(&self) -> String {
        let certificate = &self.certificate;
        let mut text = String::new();
        if let Some(best) = &certificate.best {
            let _ = writeln!(text, "  best          {}", worth(best));
        }
        if self.search.order == SearchOrder::Proof || self.search.objective == SearchObjective::Posterior {
            let open = match &certificate.open {
                Some(open) => format!("any map that was not found has at least {}", worth(open)),
                None => "nothing is left open".to_owned(),
            };
            let verdict = if certificate.proved { "proved" } else { "not proved" };
            let _ = writeln!(text, "  certificate   {verdict}: {open}");
        }
        for trusted in &certificate.trusted {
            if let (Assumption::LinearEstimates, Some(least)) = (trusted.assumption, trusted.least) {
                let _ = writeln!(text, "  χ² rose by at least {least:.2} of the linear estimate");
            }
        }
        if let Some(rest) = certificate.rest_probability {
            let _ = writeln!(text, "  all other maps together have a probability of at most {rest:.2e}");
        }
        text
    }

    fn levels(&self) -> String {
        let search = &self.search;
        let mut text = format!("  {:>7}{:>14}{:>14}{:>14}\n", "travels", "nodes", "maps", "refuted");
        for level in &search.levels {
            let _ = writeln!(
                text,
                "  {:>7}{:>14}{:>14}{:>14}",
                level.travels, level.nodes, level.maps, level.refuted
            );
        }
        let per_node = search.bytes as f64 / search.nodes.max(1) as f64;
        let _ = writeln!(text, "  {} nodes expanded in {:.3} s", search.expanded, search.seconds);
        let _ = writeln!(text, "  the search took {} bytes, {per_node:.1} a node", search.bytes);
        text
    }

    /// The verdict, how probable the first map is, and what to do if there is none.
    fn conclusion(&self, listing: Listing) -> String {
        let mut text = format!("{}\n", self.verdict.sentence);
        if let Some([least, most]) = self.maps.first().and_then(|map| map.probability) {
            let _ =
                writeln!(text, "The first one's probability is at least {least:.4} and at most {most:.4}.");
        }
        if let (VerdictKind::NoMap, Some(travel), true) =
            (self.verdict.kind, self.verdict.lost_at_travel, listing.flags)
        {
            let _ = writeln!(text, "--travels {travel} maps what was before.");
        }
        text
    }

    fn ranking(&self, listing: Listing) -> String {
        if self.maps.is_empty() {
            return String::new();
        }
        let is_posterior = self.search.objective == SearchObjective::Posterior;
        let mut text = "\n  rank".to_owned();
        if is_posterior {
            text += "   probability       cost     χ²/2";
        }
        text += "  undetermined  paths  places  genus  closed\n";
        for map in &self.maps {
            let _ = writeln!(text, "{}", row(map));
        }
        let unlisted = self.search.found.maps.saturating_sub(self.maps.len() as u64);
        if unlisted > 0 {
            let how = if listing.flags { " (--all lists them)" } else { "" };
            let _ = writeln!(text, "  … and {unlisted} more{how}");
        }
        let ties = self.maps.iter().skip(1).filter(|map| map.tied && is_posterior);
        for (rank, difference) in ties.filter_map(|map| Some((map.rank, map.difference.as_ref()?))) {
            let _ = writeln!(text, "Map {rank} differs from map 1: {}", difference.sentence);
        }
        text
    }
}

/// A map of the ranking in a line.
fn row(map: &AnsweredMap) -> String {
    let mark = if map.optimal { '*' } else { ' ' };
    let mut text = format!("{:>6} {mark}", map.rank);
    if let (Some([least, most]), Some(costs)) = (map.probability, &map.costs) {
        // A probability that is only bounded must not read like one that is known.
        let probability = if least >= 0.99 * most { format!("{most:.3e}") } else { format!("≤{most:.3e}") };
        let _ = write!(text, "{probability:>13}{:>11.3}{:>9.2}", costs.total, costs.of("bend"));
    }
    let measure = map.measure;
    let _ = write!(
        text,
        "{:>12}{:>7}{:>8}{:>7}  {}",
        measure.undetermined_boundaries,
        measure.paths,
        measure.places,
        measure.genus,
        if map.closed { "yes" } else { "no" }
    );
    text
}

fn worth(worth: &Worth) -> String {
    match worth {
        Worth::Nats(nats) => format!("{nats:.3} nats"),
        Worth::Measure(measure) => measure.to_string(),
    }
}
