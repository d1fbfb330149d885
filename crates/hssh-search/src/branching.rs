//! The branching factor with and without planarity, measured and predicted (equation (3.1)).

use hssh_topology::{Axioms, Derivation, Hypothesis, Observation, PendingGateway, Rules, StarCatalog, Step};
use serde::Serialize;

/// One expansion of a planar map, as equation (3.1) looks at it.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct BranchingSample {
    /// p: pending gateways.
    pub pending: u32,
    /// p_i: pending gateways in the face that the exit lies in.
    pub pending_in_face: u32,
    /// f: faces; the one around a single place counts.
    pub faces: u32,
    /// m: links between places that both existed already.
    pub matches: u32,
    /// b: successors without planarity.
    pub successors: u32,
    /// b_p: planar successors.
    pub planar_successors: u32,
    /// Pending gateways that match the observation, the exit among them.
    pub consistent: u32,
    /// Those of them in the face that the exit lies in.
    pub consistent_in_face: u32,
}

impl BranchingSample {
    /// b_p / b as measured.
    #[must_use]
    pub fn measured(&self) -> f64 {
        f64::from(self.planar_successors) / f64::from(self.successors)
    }

    /// (p_i / p̄) · 1 / (m + 1), with p̄ = p / f: the right-hand side of (3.1).
    #[must_use]
    pub fn predicted(&self) -> f64 {
        reduction(self.pending_in_face, self.pending, self.faces, self.matches)
    }

    /// The same with p and p_i restricted to the pending gateways that match the observation, as the
    /// end of section 3.3 proposes.
    #[must_use]
    pub fn predicted_from_consistent(&self) -> f64 {
        reduction(self.consistent_in_face, self.consistent, self.faces, self.matches)
    }
}

fn reduction(in_face: u32, pending: u32, faces: u32, matches: u32) -> f64 {
    let average = f64::from(pending) / f64::from(faces);
    f64::from(in_face) / average / f64::from(matches + 1)
}

/// Looks at one expansion: how many successors an observation has with the given axioms but without
/// planarity, and how many of them are planar. `None` if the observation is predicted.
#[must_use]
pub fn branching(
    hypothesis: &Hypothesis,
    observation: Observation,
    catalog: &StarCatalog,
    axioms: &Axioms,
) -> Option<BranchingSample> {
    let mut hypothesis = hypothesis.clone();
    let axioms = Axioms { max_genus: None, ..*axioms };
    let mut step = Step::default();
    hypothesis.step(observation, Rules { catalog, axioms: &axioms }, &mut step);
    let map = &hypothesis.map;
    let exit = map.pending(hypothesis.exit(observation))?;
    let is_planar = |derivation: &Derivation| match *derivation {
        Derivation::Predicted | Derivation::NewPlace => true,
        Derivation::Closure(gateway) => {
            map.pending(gateway).is_some_and(|gateway| map.share_face(exit, gateway))
        }
    };
    let in_face = map.graph().pending_edges_of_face(exit.edge()).count() as u32;
    let matching = |gateway: PendingGateway| {
        let (place, olp) = (map.place(gateway.olp()), map.local(gateway.olp()));
        catalog.matches(observation.star, observation.entry, map.star(place), olp)
    };
    let others = map.pending_gateways().filter(|&gateway| gateway != exit && matching(gateway));
    let (same, different): (Vec<_>, Vec<_>) = others.partition(|&gateway| map.share_face(exit, gateway));
    Some(BranchingSample {
        pending: map.pending_count(),
        pending_in_face: in_face,
        faces: map.graph().face_count().max(1),
        matches: map.link_count() + 1 - map.place_count(),
        successors: step.derivations.len() as u32,
        planar_successors: step.derivations.iter().filter(|derivation| is_planar(derivation)).count() as u32,
        consistent: (same.len() + different.len()) as u32 + 1,
        consistent_in_face: same.len() as u32 + 1,
    })
}
