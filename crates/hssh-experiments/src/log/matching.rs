//! What the matching of local maps tells (section 2.4): of pairs of visits, among maps that stars alone cannot tell
//! apart, and in the posterior.

use std::error::Error;

use hssh_causal::Exploration;
use hssh_local::{Survey, resemblance};
use hssh_search::{Appearance, Mapper, Order, PosteriorModel, Proving};
use hssh_topology::{Axioms, Isomorphism, Position};

use super::truth::Truth;

/// Weights of a local map's log-likelihood ratio against that of a travel.
const WEIGHTS: [f64; 4] = [0.0, 0.02, 0.05, 0.1];

/// Of all probability, so much may be in maps that are not looked at.
const REST: f64 = 0.01;

/// The least and the greatest log-likelihood ratio of pairs of visits to one place and to different ones.
pub(super) fn pairs(survey: &Survey, truth: &Truth) -> String {
    let places: Vec<Option<&str>> = survey.visits.iter().map(|visit| truth.place_of(visit)).collect();
    let (mut same, mut different) = (Vec::new(), Vec::new());
    for second in 0..places.len() {
        for first in 0..second {
            let (one, other) = (&survey.visits[first], &survey.visits[second]);
            for phi in Isomorphism::all(&other.star.star, &one.star.star) {
                let Some(found) = resemblance(one, other, phi) else { continue };
                // Of several ways to turn the one onto the other, one is true: that with the least turn
                // of the building, which the track keeps to some 40° over the log.
                let is_upright = found.placed.theta.abs() < std::f64::consts::FRAC_PI_4;
                let is_same = places[first].is_some() && places[first] == places[second] && is_upright;
                let list = if is_same { &mut same } else { &mut different };
                list.push(found.log_likelihood_ratio);
            }
        }
    }
    let range = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        match values[..] {
            [] => "none".to_owned(),
            [least, .., most] => {
                format!(
                    "{} pairs, {least:.1} to {most:.1}, median {:.1}",
                    values.len(),
                    values[values.len() / 2]
                )
            }
            [only] => format!("1 pair, {only:.1}"),
        }
    };
    let threshold = same.iter().copied().fold(f64::INFINITY, f64::min);
    let above = different.iter().filter(|&&ratio| ratio >= threshold).count();
    format!(
        "  local maps of one place: log-likelihood ratio of {}\n  of isomorphic others: {}; {above} of them above the least of the former",
        range(&mut same),
        range(&mut different)
    )
}

/// The maps that are optimal by topology without planarity, each with what the local maps say of it: the sum of the
/// log-likelihood ratios of all visits that it takes for visits to one place.
pub(super) fn among_optimal(survey: &Survey, exploration: &Exploration) -> Result<String, Box<dyn Error>> {
    let mapper = Mapper::builder().axioms(Axioms::default()).explain(exploration)?;
    let (report, _) = mapper.answer(1);
    let (_, maps) = mapper.answer(report.finals.optimal as usize);
    let mut said: Vec<(f64, u32)> =
        maps.iter().map(|map| (likeness(survey, &mapper.visits(map.node)), map.measure.genus)).collect();
    said.sort_by(|a, b| b.0.total_cmp(&a.0));
    let said: Vec<String> =
        said.iter().map(|(likeness, genus)| format!("{likeness:.0} nats (genus {genus})")).collect();
    Ok(format!(
        "  without planarity {} maps, {} optimal; their local maps: {}",
        report.finals.final_maps,
        report.finals.optimal,
        said.join(", ")
    ))
}

/// What the local maps say of a map: each visit against the first one to the same place.
fn likeness(survey: &Survey, positions: &[Position]) -> f64 {
    let of = |(later, position): (usize, &Position)| {
        let first = positions.iter().position(|other| other.place == position.place)?;
        let (one, other) = (&survey.visits[first], &survey.visits[later]);
        (first < later).then(|| resemblance(one, other, position.phi)).flatten()
    };
    positions.iter().enumerate().filter_map(of).map(|found| found.log_likelihood_ratio).sum()
}

/// The probability of the most probable planar map by the weight of the local maps.
pub(super) fn gain(survey: &Survey, exploration: &Exploration) -> Result<String, Box<dyn Error>> {
    let model = PosteriorModel::evidence(exploration).ok_or("the exploration has no odometry")?;
    let visits = &survey.visits;
    let degrees: Vec<u32> = visits.iter().map(|visit| visit.star.star.degree()).collect();
    let mut said = Vec::new();
    for weight in WEIGHTS {
        let appearance = Appearance::new(&degrees, |later, earlier, rotation| {
            let (first, second) = (&visits[earlier], &visits[later]);
            let mut isomorphisms = Isomorphism::all(&second.star.star, &first.star.star);
            let phi = isomorphisms.find(|phi| phi.rotation() == rotation);
            let found = phi.and_then(|phi| resemblance(first, second, phi));
            found.map_or(0.0, |found| weight * found.log_likelihood_ratio)
        });
        let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
        let search = Mapper::builder().posterior(model).axioms(axioms).appearance(appearance);
        let search = search.order(Order::Cyclic).proving(Proving { rest: REST, ..Proving::default() });
        let maps = search.explain(exploration)?.maps(1);
        let best = maps.first().and_then(|map| map.probable.as_ref()).ok_or("no map")?;
        said.push(format!("{:.3} at {weight}", best.at_most));
    }
    Ok(format!("  probability of the best planar map by the weight of local maps: {}", said.join(", ")))
}
