//! One travel, and what it makes of a hypothesis: the recursive step of section 2.3.1.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_topology::{Axioms, Hypothesis, Observation, Olp, Rules, Star, StarCatalog, Step};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let crossing: Star = "0+ 1+ 0- 1-".parse()?;
    let mut catalog = StarCatalog::new();
    let star = catalog.add(&crossing);
    let axioms = Axioms::default();
    let mut hypothesis = Hypothesis::root(&catalog, star);
    // The robot left by 0+ and came by 1+ to a place that looks the same.
    let observation = Observation { exit: Olp::new(0), entry: Olp::new(1), star };
    let mut step = Step::default();
    hypothesis.step(observation, Rules { catalog: &catalog, axioms: &axioms }, &mut step);
    println!("{:?}:", step.outcome);
    for derivation in &step.derivations {
        println!("  {derivation}"); // n: a new place; c and a gateway: back at the first one, by that gateway
    }
    // Back at the first place, its path would meet a place twice, which the axioms exclude.
    assert_eq!(step.derivations.len(), 1);
    Ok(())
}
