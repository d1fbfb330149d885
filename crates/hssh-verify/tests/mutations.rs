//! Certificates that were changed are refused, at the line that does not hold.
#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod naive;
mod support;

use hssh_causal::Exploration;
use hssh_topology::Axioms;
use hssh_verify::verify;
use hssh_world::{grid, snake};
use naive::costs::Terms;
use naive::{Objective, Question};
use proptest::prelude::*;
use support::{accepts, fixture};

/// A certificate as lines that can be changed.
#[derive(Clone)]
struct Text(Vec<String>);

impl Text {
    fn of(text: &str) -> Text {
        Text(text.lines().map(str::to_owned).collect())
    }

    /// The index of the `nth` line that starts like this.
    fn find(&self, start: &str, nth: usize) -> usize {
        let found = self.0.iter().enumerate().filter(|(_, line)| line.starts_with(start));
        found.map(|(index, _)| index).nth(nth).unwrap_or_else(|| panic!("no line {nth} like `{start}`"))
    }

    fn set(&self, start: &str, nth: usize, by: &str) -> (Text, usize) {
        let at = self.find(start, nth);
        let mut lines = self.0.clone();
        lines[at] = by.to_owned();
        (Text(lines), at + 1)
    }

    /// Adds to the number in the word `word` of the line.
    fn add(&self, start: &str, nth: usize, word: usize, more: f64) -> (Text, usize) {
        let line = &self.0[self.find(start, nth)];
        let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let sum = words[word].parse::<f64>().unwrap() + more;
        words[word] = if words[word].contains('.') { format!("{sum:?}") } else { format!("{sum}") };
        self.set(start, nth, &words.join(" "))
    }

    fn insert(&self, at: usize, line: &str) -> (Text, usize) {
        let mut lines = self.0.clone();
        lines.insert(at, line.to_owned());
        (Text(lines), at + 1)
    }

    fn remove(&self, at: usize) -> Text {
        let mut lines = self.0.clone();
        lines.remove(at);
        Text(lines)
    }

    fn write(&self) -> String {
        self.0.join("\n") + "\n"
    }
}

fn refused(what: &str, (text, line): &(Text, usize), exploration: &Exploration, reason: &str) {
    let refusal = verify(&text.write(), exploration).expect_err(what);
    assert_eq!(refusal.line, *line, "{what}: {refusal}");
    assert!(refusal.reason.contains(reason), "{what}: `{refusal}` does not say `{reason}`");
}

fn snake_3x3() -> Exploration {
    let world = grid(3, 3, 8.0).unwrap();
    world.explore(&world.route_through(&snake(3, 3)).unwrap()).unwrap()
}

fn preference(exploration: &Exploration, prune: bool, closed: bool) -> Text {
    let mut question = Question::new(exploration, Objective::Preference("last"));
    question.axioms.max_genus = Some(1);
    question.prune = prune;
    question.closed = closed;
    let text = question.prove().text;
    accepts(&text, exploration);
    Text::of(&text)
}

#[test]
fn heads_that_do_not_hold() {
    let exploration = snake_3x3();
    let text = preference(&exploration, true, false);
    let other = exploration.prefix(15);
    for (what, changed, reason) in [
        ("no certificate", text.set("hssh-certificate", 0, "hello 1"), "expected `hssh-certificate`"),
        ("another version", text.set("hssh-certificate", 0, "hssh-certificate 2"), "version 2"),
        ("a wrong number of travels", text.add("exploration", 0, 1, 1.0), "another exploration"),
        ("a wrong number of stars", text.add("exploration", 0, 2, -1.0), "another exploration"),
        ("no axioms", text.set("axioms", 0, "axioms nothing"), "axioms as JSON"),
        ("an unknown axiom", text.set("axioms", 0, r#"axioms {"beauty": true}"#), "axioms as JSON"),
        ("an unknown goal", text.set("goal", 0, "goal open"), "expected a goal"),
        ("an unknown objective", text.set("objective", 0, "objective taste"), "expected an objective"),
        ("an unknown order", text.set("objective", 0, "objective preference second"), "genus stands"),
        ("a negative best", text.set("best", 0, "best 0 -6 9 0"), "whole number"),
        ("a signed best", text.set("best", 0, "best 0 +6 9 0"), "whole number"),
        ("a huge best", text.set("best", 0, "best 0 6 99999999999999999999999 0"), "whole number"),
        ("a best of three", text.set("best", 0, "best 0 6 9"), "expected a genus"),
        ("a best of five", text.set("best", 0, "best 0 6 9 0 0"), "one word too many"),
        ("a best that no map has", text.set("best", 0, "best 0 6 8 0"), "not what is claimed"),
        ("one map more", text.add("maps", 0, 1, 1.0), "are in the tree"),
        ("a map fewer", text.add("maps", 0, 1, -1.0), "are in the tree"),
        ("a rest without probability", text.insert(text.find("tree", 0), "rest 0.1"), "expected `tree`"),
    ] {
        refused(what, &changed, &exploration, reason);
    }
    // With another genus for the best, the map with genus 0 is better than that.
    let (genus, _) = text.set("best", 0, "best 0 6 9 1");
    assert!(verify(&genus.write(), &exploration).is_err());
    let line = text.find("exploration", 0) + 1;
    refused("another exploration", &(text.clone(), line), &other, "another exploration");
    let swapped = text.remove(text.find("goal", 0));
    refused("no goal", &(swapped, text.find("goal", 0) + 1), &exploration, "expected `goal`");
}

#[test]
fn trees_that_do_not_hold() {
    let exploration = snake_3x3();
    let text = preference(&exploration, false, false);
    let (last, tree) = (text.0.len(), text.find("tree", 0));
    let (first_map, end) = (text.find("f ", 0), text.find("end", 0));
    for (what, changed, reason) in [
        ("f1 of a map", text.add("f ", 3, 1, 1.0), "(f1, f2, f3) and genus"),
        ("f2 of a map", text.add("f ", 3, 2, 1.0), "(f1, f2, f3) and genus"),
        ("f3 of a map", text.add("f ", 3, 3, -1.0), "(f1, f2, f3) and genus"),
        ("genus of a map", text.add("f ", 3, 4, 1.0), "(f1, f2, f3) and genus"),
        ("a map with five numbers", text.set("f ", 3, "f 0 6 9 0 0"), "(f1, f2, f3)"),
        ("infinite numbers", text.set("f ", 3, "f inf 6 9 0"), "whole number"),
        ("an expansion of a map", text.set("f ", 0, "e 1"), "which cannot be"),
        ("an open complete map", text.set("f ", 0, "o 9 9 9 9"), "cannot be left open"),
        ("a map turned down", text.set("f ", 0, "x"), "only with `goal closed`"),
        ("a map too early", text.set("e ", 4, "f 0 6 9 0"), "no complete map"),
        ("an open node that leads to the best", text.set("e ", 4, "o 0 6 10 0"), "too high"),
        ("an open node no worse than the best", text.set("e ", 4, "o 0 3 5 0"), "no worse"),
        ("an open node far too high", text.set("e ", 4, "o 99999 0 0 0"), "too high"),
        ("an expansion of none", text.set("e ", 4, "e 0"), "at least one"),
        ("an expansion of a negative number", text.set("e ", 4, "e -1"), "whole number"),
        ("garbage", text.set("e ", 4, "q 1"), "expected `e`"),
        ("binary garbage", text.set("e ", 4, "\u{0}\u{7f}"), "expected `e`"),
        ("an end too early", text.set("e ", 4, "end"), "not complete"),
        ("an end with words", text.set("end", 0, "end of it"), "one word too many"),
        ("a second end", text.insert(end + 1, "end"), "nothing may follow"),
        ("a map after the end", text.insert(end + 1, "f 0 6 9 0"), "nothing may follow"),
        ("a map too many", text.insert(end, "f 0 6 9 0"), "expected `end`"),
        ("a node too many", text.insert(end, "e 1"), "expected `end`"),
    ] {
        refused(what, &changed, &exploration, reason);
    }
    let (twice, _) = text.insert(first_map + 1, &text.0[first_map]);
    assert!(verify(&twice.write(), &exploration).is_err(), "a map twice");
    let truncated = Text(text.0[..last - 1].to_vec());
    refused("no end", &(truncated, last), &exploration, "ends where");
    let truncated = Text(text.0[..first_map].to_vec());
    refused("half a tree", &(truncated, first_map + 1), &exploration, "ends where");
    refused("no tree at all", &(Text(text.0[..tree].to_vec()), tree + 1), &exploration, "ends where");
    // All expansions up to the first map in one statement, then one too many.
    let run = first_map - tree - 1;
    let mut lines = text.0.clone();
    lines.splice(tree + 1..first_map, [format!("e {run}")]);
    accepts(&Text(lines.clone()).write(), &exploration);
    lines[tree + 1] = format!("e {}", run + 1);
    refused("an expansion too many", &(Text(lines.clone()), tree + 2), &exploration, "which cannot be");
    lines[tree + 1] = format!("e {}", run - 1);
    refused("an expansion too few", &(Text(lines), tree + 3), &exploration, "no complete map");
}

#[test]
fn dropped_and_swapped_lines() {
    let exploration = snake_3x3();
    let text = preference(&exploration, false, false);
    for at in 0..text.0.len() {
        assert!(verify(&text.remove(at).write(), &exploration).is_err(), "without line {}", at + 1);
        let mut lines = text.0.clone();
        if at + 1 < lines.len() && lines[at] != lines[at + 1] {
            lines.swap(at, at + 1);
            let refusal = verify(&Text(lines).write(), &exploration);
            assert!(refusal.is_err(), "lines {} and {} swapped", at + 1, at + 2);
        }
    }
}

#[test]
fn a_tree_of_other_axioms_or_another_goal() {
    let exploration = snake_3x3();
    let text = preference(&exploration, false, false);
    let with = |axioms: Axioms| {
        let line = format!("axioms {}", serde_json::to_string(&axioms).unwrap());
        text.set("axioms", 0, &line).0.write()
    };
    let own = Axioms { max_genus: Some(1), ..Axioms::default() };
    for axioms in [
        Axioms { max_genus: Some(0), ..own },
        Axioms { max_places: Some(9), ..own },
        Axioms { perpendicular: true, ..own },
        Axioms { consistent_boundaries: true, ..own },
        Axioms { no_self_intersection: false, ..own },
    ] {
        assert!(verify(&with(axioms), &exploration).is_err(), "{axioms:?}");
    }
    let undecidable = Axioms { perpendicular: true, no_self_intersection: false, ..own };
    let refusal = verify(&with(undecidable), &exploration).unwrap_err();
    assert!(refusal.reason.contains("no branch can be closed for not being perpendicular"), "{refusal}");
    let (closed, _) = text.set("goal", 0, "goal closed");
    let refusal = verify(&closed.write(), &exploration).unwrap_err();
    assert!(refusal.reason.contains("only closed maps count"), "{refusal}");
    let (none, _) = text.set("best", 0, "best none");
    refused("a best of none", &(none, text.find("f ", 0) + 1), &exploration, "said to be none");
    // In the order with the genus first, or without it, the same map is the best one here.
    for order in ["first", "ignored"] {
        accepts(&text.set("objective", 0, &format!("objective preference {order}")).0.write(), &exploration);
    }
}

#[test]
fn closed_maps_that_can_still_come_about() {
    let exploration = snake_3x3();
    let text = preference(&exploration, false, true);
    refused("a node that can close", &text.set("e ", 4, "x"), &exploration, "can still be closed");
    refused("a closed map", &text.set("f ", 0, "x"), &exploration, "can still be closed");
    refused("a node that cannot close", &text.set("x", 0, "f 0 6 9 0"), &exploration, "");
    refused("words after it", &text.set("x", 0, "x pending"), &exploration, "one word too many");
    let (any, _) = text.set("goal", 0, "goal any");
    refused("with goal any", &(any, text.find("x", 0) + 1), &exploration, "only with `goal closed`");
}

fn posterior(exploration: &Exploration, metrical: &'static str, prior: &'static str) -> Text {
    let mut question = Question::new(exploration, Objective::Posterior(Terms::new(metrical, prior)));
    question.prune = true;
    let text = question.prove().text;
    assert!(accepts(&text, exploration).open > 0);
    Text::of(&text)
}

#[test]
fn posterior_certificates_that_do_not_hold() {
    let exploration = fixture("aces.ron").prefix(9);
    let text = posterior(&exploration, "evidence corridor 20.0 0.5 0.15 0.1", "flat");
    let at = |line: &str| text.find(line, 0);
    let (metrical, prior) = (at("metrical"), at("prior"));
    for (what, changed, reason) in [
        ("a map that costs more", text.add("f ", 0, 1, 0.01), "nats"),
        ("a map that costs less", text.add("f ", 1, 1, -0.01), "nats"),
        ("a cost that is no number", text.set("f ", 0, "f nan"), "finite number"),
        ("an infinite cost", text.set("f ", 0, "f inf"), "finite number"),
        ("a bound that is infinite", text.set("o ", 0, "o inf"), "finite number"),
        ("a bound that is too high", text.add("o ", 0, 1, 1e6), "too high"),
        ("a bound below the best", text.set("o ", 0, "o -1e300"), "no worse"),
        ("a best too low", text.add("best", 0, 1, -0.5), "not what is claimed"),
        ("no rest", text.set("rest", 0, "rest 0.0"), "can be shown"),
        ("a negative rest", text.set("rest", 0, "rest -0.1"), "from 0 to 1"),
        ("too much rest", text.set("rest", 0, "rest 1.5"), "from 0 to 1"),
        ("trust in something else", text.set("trust", 0, "trust me 1"), "on trust"),
        ("negative trust", text.set("trust", 0, "trust lowest-minimum -1"), "whole number"),
        ("no area", text.set("metrical", 0, "metrical evidence uniform 0.0"), "positive"),
        ("no share", text.set("metrical", 0, "metrical evidence corridor 1.0 1.0 1.0 2.0"), "at most 1"),
        ("no weight", text.set("prior", 0, "prior simplicity 1.0 1.0 0.0"), "positive"),
        ("a negative weight", text.set("prior", 0, "prior simplicity -1.0 1.0 1.0"), "0 or more"),
        ("an unknown prior", text.set("prior", 0, "prior experience"), "expected a prior"),
        ("a visit to come", text.insert(prior + 1, "appearance 10 0 0 1.0"), "later and earlier"),
        ("a visit with itself", text.insert(prior + 1, "appearance 3 3 0 1.0"), "later and earlier"),
        ("a rotation too far", text.insert(prior + 1, "appearance 3 1 4 1.0"), "rotation 4"),
        ("a ratio that is no number", text.insert(prior + 1, "appearance 3 1 0 NaN"), "finite number"),
        ("no metrical", text.insert(metrical, "goal any"), "expected `metrical`"),
    ] {
        refused(what, &changed, &exploration, reason);
    }
    let (twice, line) =
        text.insert(prior + 1, "appearance 3 1 0 1.0").0.insert(prior + 2, "appearance 3 1 0 2.0");
    refused("a ratio twice", &(twice, line), &exploration, "a second time");
    for (start, other) in [
        ("metrical", "metrical evidence corridor 20.0 0.5 0.15 0.2"),
        ("metrical", "metrical evidence uniform 900.0"),
        ("metrical", "metrical likelihood"),
        ("prior", "prior choices"),
        ("prior", "prior simplicity 0.0 2.0 1.0"),
    ] {
        assert!(verify(&text.set(start, 0, other).0.write(), &exploration).is_err(), "{other}");
    }
    let (appearing, _) = text.insert(prior + 1, "appearance 8 0 0 2.0");
    assert!(verify(&appearing.write(), &exploration).is_err());
    let ron = exploration.to_ron();
    let moved = Exploration::from_ron(&ron.replacen("24.1177", "24.1178", 1)).unwrap();
    refused("one travel measured otherwise", &(text.clone(), 2), &moved, "another exploration");
    // A bound that is weaker than it could be changes nothing but the rest.
    let weaker = text.add("o ", 0, 1, -1e-9).0;
    accepts(&weaker.set("rest", 0, "rest 1.0").0.write(), &exploration);
}

#[test]
fn odometry_cannot_count_where_it_was_not_measured() {
    let exploration = fixture("figure-2-4.ron");
    let terms = Terms::new("ignored", "flat");
    let text = Text::of(&Question::new(&exploration, Objective::Posterior(terms)).prove().text);
    accepts(&text.write(), &exploration);
    refused(
        "no odometry",
        &text.set("metrical", 0, "metrical likelihood"),
        &exploration,
        "travel 0 has none",
    );
}

#[test]
fn comments_and_empty_lines_are_ignored_but_counted() {
    let exploration = snake_3x3();
    let text = preference(&exploration, true, false);
    let (text, _) = text.insert(0, "# how the snake was mapped");
    let (text, _) = text.insert(3, "");
    accepts(&text.write(), &exploration);
    refused("a map more", &text.add("maps", 0, 1, 1.0), &exploration, "are in the tree");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Whatever digit is changed, what is accepted claims no more than what is true.
    #[test]
    fn a_changed_digit_is_refused_or_claims_no_more(which in 0usize..10_000, digit in 0u8..10, kind in 0usize..3) {
        let exploration = if kind < 2 { snake_3x3() } else { fixture("aces.ron").prefix(8) };
        let text = match kind {
            0 => preference(&exploration, true, false),
            1 => preference(&exploration, false, true),
            _ => posterior(&exploration, "evidence corridor 20.0 0.5 0.15 0.1", "flat"),
        }.write();
        let mut bytes = text.clone().into_bytes();
        let digits: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at].is_ascii_digit()).collect();
        bytes[digits[which % digits.len()]] = b'0' + digit;
        let changed = String::from_utf8(bytes).unwrap();
        if let Ok(verdict) = verify(&changed, &exploration) {
            let before = accepts(&text, &exploration);
            prop_assert_eq!(verdict.best, before.best);
            prop_assert_eq!(verdict.maps, before.maps);
            // The rest may be claimed to be more than can be shown, and up to rounding less.
            if let (Some(rest), Some(shown)) = (verdict.rest, before.rest) {
                prop_assert!(rest >= shown * (1.0 - 1e-5));
            }
        }
    }

    /// No text makes the checker fall over.
    #[test]
    fn any_text_is_refused_at_one_of_its_lines(text in "(hssh-certificate 1\n)?([a-z#{}0-9.\\- ]{0,20}\n){0,6}") {
        let refusal = verify(&text, &fixture("figure-2-4.ron")).unwrap_err();
        prop_assert!(refusal.line >= 1 && refusal.line <= text.lines().count() + 1);
    }
}
