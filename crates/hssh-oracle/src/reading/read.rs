//! What a reading costs, and what it makes of the place.

use super::chart::{Chart, ChartEnd, EndId};
use super::merge::{Element, Sight};
use super::model::{Evidence, ReadingModel};
use crate::star::opposite;

/// The chart after a visit, for every end of the star which end of the place it is (of open ones), and the price.
pub(super) fn read(
    chart: &Chart,
    model: &ReadingModel,
    sight: Sight,
    place: usize,
    sequence: &[Element],
) -> (Chart, Vec<Option<EndId>>, f64) {
    let mut chart = chart.clone();
    let visits = chart.places[place].visits;
    let mut image = vec![None; sight.star.ends().len()];
    let mut price = 0.0;
    for &element in sequence {
        match element {
            Element::Matched { seen, end } => {
                let evidence = &mut chart.ends[end].evidence;
                if visits > 0 {
                    price += model.shown_again(*evidence);
                }
                evidence.shown += 1;
                image[seen] = Some(end);
            }
            Element::Missed(end) => {
                let evidence = &mut chart.ends[end].evidence;
                price += model.missed(*evidence);
                evidence.missed += 1;
            }
            Element::New(seen) if seen == sight.entry => price += model.first_shown_as_entry(visits),
            Element::New(_) => price += model.first_shown(visits),
        }
    }
    add_new_ends(&mut chart, sight, place, sequence, &mut image);
    let entry = image[sight.entry].expect("the entry is open");
    if matches!(sequence[0], Element::Matched { .. }) {
        price += travel_by(&mut chart, model, entry);
    }
    chart.ends[entry].evidence.travelled = true;
    chart.places[place].visits += 1;
    (chart, image, price)
}

/// The robot leaves or comes in by an end: the price of that, if it is the first time.
pub(super) fn travel_by(chart: &mut Chart, model: &ReadingModel, end: EndId) -> f64 {
    let evidence = &mut chart.ends[end].evidence;
    let price = if evidence.travelled { 0.0 } else { model.travelled_first(*evidence) };
    evidence.travelled = true;
    price
}

/// Makes the new ends, pairs them with their opposites and puts them where they belong.
fn add_new_ends(
    chart: &mut Chart,
    sight: Sight,
    place: usize,
    sequence: &[Element],
    image: &mut [Option<EndId>],
) {
    let degree = sight.star.ends().len();
    let label = |seen: usize| sight.star.ends()[seen].label.clone();
    let matched = image.to_vec();
    let evidence = Evidence { shown: 1, missed: chart.places[place].visits, travelled: false };
    let is_new = |seen: usize| sequence.contains(&Element::New(seen));
    for seen in (0..degree).filter(|&seen| is_new(seen)) {
        let end = match matched[opposite(sight.star, seen)] {
            Some(facing) => {
                let end = chart.ends[facing].opposite;
                chart.places[place].ends.retain(|&other| other != end);
                end
            }
            None => {
                chart.ends.push(ChartEnd { place, open: true, label: None, opposite: usize::MAX, evidence });
                chart.ends.len() - 1
            }
        };
        let new = &mut chart.ends[end];
        (new.open, new.label, new.evidence) = (true, label(seen), evidence);
        image[seen] = Some(end);
    }

    // Open ones: after the element before them, beginning behind an end that was there.
    let begin = sequence.iter().position(|element| !matches!(element, Element::New(_)));
    let begin = begin.expect("at least one end is matched");
    let mut last = usize::MAX;
    for element in sequence[begin..].iter().chain(&sequence[..begin]) {
        match *element {
            Element::Matched { end, .. } | Element::Missed(end) => last = end,
            Element::New(seen) => {
                let end = image[seen].expect("every new end was made");
                chart.put_after(last, end);
                last = end;
            }
        }
    }

    // Opposites; closed ones after what stands before them in the star, the last one first.
    for steps in (0..degree).rev() {
        let seen = (sight.entry + steps) % degree;
        let facing = opposite(sight.star, seen);
        if !is_new(facing) || matched[seen].is_some() {
            continue;
        }
        let facing_end = image[facing].expect("every new end was made");
        if let Some(end) = image[seen] {
            chart.ends[facing_end].opposite = end;
            continue;
        }
        let before = (1..degree)
            .find_map(|back| image[(seen + degree - back) % degree])
            .expect("the entry is an open end");
        let (label, evidence) = (label(seen), Evidence::default());
        chart.ends.push(ChartEnd { place, open: false, label, opposite: facing_end, evidence });
        let closed = chart.ends.len() - 1;
        chart.ends[facing_end].opposite = closed;
        chart.put_after(before, closed);
    }
}

#[cfg(test)]
mod tests {
    use hssh_topology::Star;

    use super::super::merge::{anchored, with_new_entry};
    use super::*;

    /// What a place with the star `known` becomes by each reading that matches so many ends: its ends clockwise from
    /// the entry, open (o) or closed (c), each with a number that it shares with its opposite.
    fn revised(known: &str, anchor: Option<usize>, seen: &str, entry: usize, matched: usize) -> Vec<String> {
        let (known, star): (Star, Star) = (known.parse().unwrap(), seen.parse().unwrap());
        let mut chart = Chart::default();
        chart.add_visited_place(&known);
        let sight = Sight { star: &star, entry };
        let sequences = match anchor {
            Some(y) => anchored(&chart, sight, y),
            None => with_new_entry(&chart, sight, 0),
        };
        let matches_so_many = |sequence: &&Vec<Element>| {
            sequence.iter().filter(|element| matches!(element, Element::Matched { .. })).count() == matched
        };
        let model = ReadingModel::default();
        let describe = |sequence: &Vec<Element>| {
            let (chart, image, _) = read(&chart, &model, sight, 0, sequence);
            let around = &chart.places[0].ends;
            let begin = around.iter().position(|&end| Some(end) == image[entry]).unwrap();
            let clockwise: Vec<usize> = [&around[begin..], &around[..begin]].concat();
            let letter = |&end: &usize| {
                let pair = end.min(chart.ends[end].opposite);
                format!("{}{pair}", if chart.ends[end].open { 'o' } else { 'c' })
            };
            clockwise.iter().map(letter).collect::<Vec<_>>().join(" ")
        };
        sequences.iter().filter(matches_so_many).map(describe).collect()
    }

    /// A corridor seen as a T: the stem is new on its side, and its closed opposite on the other.
    #[test]
    fn a_new_end_brings_its_closed_opposite() {
        assert_eq!(revised("0+ 0-", Some(0), "0+ 1+ 0- (1-)", 0, 2), ["o0 o2 o0 c2"]);
    }

    /// A dead end seen as a corridor: what was closed opens.
    #[test]
    fn a_closed_opposite_opens() {
        assert_eq!(revised("0+ (0-)", Some(0), "0+ 0-", 0, 1), ["o0 o0"]);
    }

    /// A T seen by the end that was closed: it opens, and stands where it was, opposite the stem.
    #[test]
    fn a_closed_opposite_opens_as_entry() {
        assert_eq!(revised("0+ 1+ 0- (1-)", None, "0+ 1+ 0- 1-", 3, 3), ["o1 o0 o1 o0"]);
    }

    /// New ends that are opposites of each other are so in the place too.
    #[test]
    fn new_opposites_are_opposites() {
        assert_eq!(revised("0+ 0-", Some(0), "0+ 1+ 0- 1-", 0, 2), ["o0 o2 o0 o2"]);
    }

    /// No reading of a T as a corridor with the stem ahead: opposites agree.
    #[test]
    fn opposites_agree() {
        assert!(revised("0+ 0-", Some(0), "0+ 1+ (0-) (1-)", 0, 2).is_empty());
    }
}
