//! Names that no two things share.

use std::collections::BTreeSet;

use crate::account::{PlacesAccount, RoadmapAccount};

/// Names for the regions of a grid map, no two alike.
pub(super) fn region_names(account: &PlacesAccount) -> Vec<String> {
    unique((0..).zip(&account.regions).map(|(number, region)| region.title(number)))
}

/// Names for the nodes of a roadmap, no two alike: a place is called as its region.
pub(super) fn node_names(account: &PlacesAccount, roadmap: &RoadmapAccount) -> Vec<String> {
    let regions = region_names(account);
    unique((0..).zip(&roadmap.nodes).map(|(number, node)| {
        let called = match (node.kind.as_str(), node.number) {
            ("place", _) => regions.get(node.region as usize).cloned(),
            ("passage", Some(number)) => {
                account.passages.get(number as usize).map(|passage| format!("{} {number}", passage.kind))
            }
            _ => None,
        };
        called.unwrap_or_else(|| format!("{} {number}", node.kind))
    }))
}

/// The same names, with a number behind those that were there before.
pub(super) fn unique(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let free = |name: String| {
        let numbered = (2..).map(|number| format!("{name} ({number})"));
        let found = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
        let found = found.unwrap_or(name);
        taken.insert(found.clone());
        found
    };
    names.map(free).collect()
}

/// The names as single words of letters, digits, `.` and `-`, no two alike.
pub(super) fn words<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let word = |name: &str| {
        let letters = name.chars().filter(|letter| letter.is_alphanumeric() || ['.', '-'].contains(letter));
        let word: String = letters.collect();
        let word = if word.is_empty() { "node".to_owned() } else { word };
        let numbered = (2..).map(|number| format!("{word}-{number}"));
        let found = std::iter::once(word.clone()).chain(numbered).find(|word| !taken.contains(word));
        let found = found.unwrap_or(word);
        taken.insert(found.clone());
        found
    };
    names.map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        let names = ["lab", "lab", "lab (2)", "lab"].map(str::to_owned);
        assert_eq!(unique(names.into_iter()), ["lab", "lab (2)", "lab (2) (2)", "lab (3)"]);
        let names = ["lab 2", "lab2", "lab (2)", "", "()", "a_b"];
        assert_eq!(words(names.into_iter()), ["lab2", "lab2-2", "lab2-3", "node", "node-2", "ab"]);
    }
}
