//! How many hypotheses there are, where they are too many to count: an estimate by random walks down the tree.
//!
//! A walk takes one of the b successors of each hypothesis at random, and counts each as b (D. E. Knuth, Estimating the efficiency of
//! backtrack programs, 1975): the product of all b until a depth is, on the average, how many hypotheses there are at that depth.

use std::error::Error;

use hssh_search::Experience;
use hssh_topology::{Axioms, Rules, Step};
use hssh_world::{grid, snake};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::table::{aligned, grouped};

/// Walks down each tree.
const WALKS: u32 = 200_000;

/// The planar maps of a snake through a square grid.
struct Case {
    side: u32,
    most_places: Option<u32>,
    /// How many there are, as far as they were counted.
    counted: Option<u64>,
}

const CASES: [Case; 4] = [
    Case { side: 4, most_places: Some(16), counted: Some(8_452) },
    Case { side: 4, most_places: None, counted: Some(223_865) },
    Case { side: 5, most_places: Some(25), counted: Some(76_010_646) },
    Case { side: 5, most_places: None, counted: None },
];

/// `cargo xtask bench size`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    println!("Planar searches of snakes: hypotheses by {} random walks each.\n", grouped(u64::from(WALKS)));
    let heads = ["", "places", "estimated", "standard error", "counted"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for case in &CASES {
        let (mean, error) = case.estimate()?;
        rows.push(vec![
            format!("{0}×{0}", case.side),
            case.most_places.map_or("any".to_owned(), |most| most.to_string()),
            format!("{mean:.3e}"),
            format!("{error:.1e}"),
            case.counted.map_or("–".to_owned(), grouped),
        ]);
    }
    println!("{}", aligned(&rows));
    Ok(())
}

impl Case {
    /// The mean over all walks, and its standard error.
    fn estimate(&self) -> Result<(f64, f64), Box<dyn Error>> {
        let world = grid(self.side, self.side, 8.0)?;
        let exploration = world.explore(&world.route_through(&snake(self.side, self.side))?)?;
        let experience = Experience::from(&exploration);
        let axioms = Axioms { max_genus: Some(0), max_places: self.most_places, ..Axioms::default() };
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..WALKS {
            let size = walk(&experience, &axioms, &mut random);
            sum += size;
            squares += size * size;
        }
        let walks = f64::from(WALKS);
        let mean = sum / walks;
        Ok((mean, ((squares / walks - mean * mean) / walks).sqrt()))
    }
}

/// What one walk says of the size of the whole tree.
fn walk(experience: &Experience, axioms: &Axioms, random: &mut ChaCha8Rng) -> f64 {
    let rules = Rules { catalog: &experience.catalog, axioms };
    let mut hypothesis = experience.root();
    let mut step = Step::default();
    let (mut size, mut level) = (1.0, 1.0);
    for &observation in &experience.observations {
        hypothesis.step(observation, rules, &mut step);
        if step.derivations.is_empty() {
            break;
        }
        level *= step.derivations.len() as f64;
        size += level;
        let chosen = step.derivations[random.random_range(0..step.derivations.len())];
        let _ = hypothesis.follow(observation, chosen, rules.catalog);
    }
    size
}
