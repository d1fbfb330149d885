//! The algebra of section 3.2 restated, and everything that a graph carries along counted anew.

use std::collections::BTreeMap;

use super::graph::{EmbeddedGraph, Neighbors};
use crate::ids::{Dart, FaceLabel, Vertex};
use crate::sanity::{Unsound, agrees, holds};

impl EmbeddedGraph {
    /// Restates the algebra of section 3.2 and recounts everything that is carried along, by other ways
    /// than those that made it. For tests and fuzzing: it takes quadratic time.
    ///
    /// # Errors
    /// With the first thing that is not so.
    pub fn sanity_check(&self) -> Result<(), Unsound> {
        self.check_rotations()?;
        self.check_edges()?;
        let walks = self.check_walks()?;
        self.check_components(&walks)?;
        self.check_pending(&walks)
    }

    fn all_darts(&self) -> impl Iterator<Item = Dart> + use<> {
        (0..self.dart_count()).map(Dart::new)
    }

    fn linked_darts(&self) -> impl Iterator<Item = Dart> + '_ {
        self.all_darts().filter(|&dart| !self.is_pending(dart))
    }

    /// Each dart has one place in the circular order of one vertex, the one that it leaves.
    fn check_rotations(&self) -> Result<(), Unsound> {
        let mut darts = Vec::new();
        for vertex in self.vertices() {
            let around: Vec<Dart> = self.darts_of(vertex).collect();
            for (position, &dart) in around.iter().enumerate() {
                let next = around[(position + 1) % around.len()];
                agrees(("vertex of", dart), self.source(dart), vertex)?;
                agrees(("clockwise of", dart), self.succ(dart), next)?;
                agrees(("counterclockwise of", next), self.pred(next), dart)?;
            }
            let linked = around.iter().filter(|&&dart| !self.is_pending(dart)).count() as u32;
            agrees(("degree of", vertex), self.degree[vertex.index()], linked)?;
            agrees(("is isolated", vertex), self.is_isolated(vertex), linked == 0)?;
            darts.extend(around);
        }
        agrees("darts", self.all_darts().collect(), darts)?;
        agrees("records of darts", self.darts.len(), self.dart_count() as usize)
    }

    /// rev is an involution without fixed points, and next a bijection on the darts that it has.
    fn check_edges(&self) -> Result<(), Unsound> {
        for dart in self.linked_darts() {
            let rev = self.rev(dart);
            holds(("another dart than", dart, "is its reverse", rev), rev != Some(dart))?;
            agrees(("rev of rev of", dart), rev.and_then(|rev| self.rev(rev)), Some(dart))?;
            agrees(("target of", dart), self.target(dart), rev.map(|rev| self.source(rev)))?;
            let next = self.next(dart);
            agrees(("before next of", dart), next.and_then(|next| self.before_on_face(next)), Some(dart))?;
            let before = self.before_on_face(dart);
            agrees(("next of before", dart), before.and_then(|before| self.next(before)), Some(dart))?;
        }
        let edges = self.linked_darts().count() as u32;
        agrees("edges", 2 * self.edge_count(), edges)?;
        agrees("pending", self.pending_count(), self.dart_count() - edges)?;
        let isolated =
            self.vertices().filter(|&vertex| self.darts_of(vertex).all(|dart| self.is_pending(dart)));
        agrees("isolated vertices", self.counts.isolated, isolated.count() as u32)
    }

    /// The inverse of next: the reverse of the first edge clockwise of a dart.
    fn before_on_face(&self, dart: Dart) -> Option<Dart> {
        let around = std::iter::successors(Some(self.succ(dart)), |&other| Some(self.succ(other)));
        self.rev(around.take(self.dart_count() as usize).find(|&other| !self.is_pending(other))?)
    }

    /// By dart: the walk that it belongs to. Each is named by its least dart. A linked dart belongs to the
    /// orbit of next that it is in; a pending edge to that of the first dart counterclockwise of it
    /// (Definition 3.2), or to the walk around its vertex if that is isolated.
    fn check_walks(&self) -> Result<Vec<Dart>, Unsound> {
        let mut walks: Vec<Dart> = self.all_darts().collect();
        let mut faces = 0;
        for start in self.linked_darts() {
            if walks[start.index()] == start {
                faces += 1;
                let orbit = std::iter::successors(self.next(start), |&dart| self.next(dart));
                orbit.take_while(|&dart| dart != start).for_each(|dart| walks[dart.index()] = start);
            }
        }
        agrees("faces", self.face_count(), faces)?;
        agrees("traced faces", self.faces().len() as u32, faces)?;
        for vertex in self.vertices() {
            let around: Vec<Dart> = self.darts_of(vertex).collect();
            for (position, &dart) in around.iter().enumerate().filter(|&(_, &dart)| self.is_pending(dart)) {
                let counterclockwise = around[..position].iter().rev().chain(around[position..].iter().rev());
                let edge = counterclockwise.copied().find(|&other| !self.is_pending(other));
                walks[dart.index()] = edge.map_or(around[0], |edge| walks[edge.index()]);
            }
        }
        Ok(walks)
    }

    /// Components by search, and the genus of each by Euler's formula.
    fn check_components(&self, walks: &[Dart]) -> Result<(), Unsound> {
        let mut component: Vec<Option<Vertex>> = vec![None; self.vertex_count() as usize];
        let (mut components, mut genus) = (0, 0);
        for start in self.vertices() {
            if component[start.index()].is_some() {
                continue;
            }
            component[start.index()] = Some(start);
            let mut members = vec![start];
            let mut searched = 0;
            while let Some(&vertex) = members.get(searched) {
                searched += 1;
                for target in self.darts_of(vertex).filter_map(|dart| self.target(dart)) {
                    if component[target.index()].replace(start).is_none() {
                        members.push(target);
                    }
                }
            }
            components += 1;
            let darts: Vec<Dart> = members
                .iter()
                .flat_map(|&v| self.darts_of(v))
                .filter(|&dart| !self.is_pending(dart))
                .collect();
            let faces = darts.iter().filter(|dart| walks[dart.index()] == **dart).count();
            if !darts.is_empty() {
                // |V| − |E| + f = 2 − 2g
                let doubled = (2 + darts.len() / 2).checked_sub(members.len() + faces);
                holds(("genus is whole", start, doubled), doubled.is_some_and(|doubled| doubled % 2 == 0))?;
                genus += doubled.unwrap_or(0) as u32 / 2;
            }
        }
        agrees("components", self.component_count(), components)?;
        agrees("genus", self.genus(), genus)?;
        agrees("is planar", self.is_planar(), genus == 0)?;
        for a in self.vertices() {
            for b in self.vertices() {
                let connected = component[a.index()] == component[b.index()];
                agrees(("connected", a, b), self.are_connected(a, b), connected)?;
            }
        }
        Ok(())
    }

    /// The lists of pending edges, and their labels: the same label if and only if the same walk.
    fn check_pending(&self, walks: &[Dart]) -> Result<(), Unsound> {
        let pending: Vec<Dart> = self.all_darts().filter(|&dart| self.is_pending(dart)).collect();
        agrees("pending edges", self.pending_edges().map(|edge| edge.dart()).collect(), pending)?;
        let mut label_of: BTreeMap<Dart, FaceLabel> = BTreeMap::new();
        let mut walk_of: BTreeMap<FaceLabel, Dart> = BTreeMap::new();
        for edge in self.pending_edges() {
            let (dart, label) = (edge.dart(), self.face_of(edge));
            let walk = walks[dart.index()];
            agrees(("label of the walk of", dart), *label_of.entry(walk).or_insert(label), label)?;
            agrees(("walk of the label of", dart), *walk_of.entry(label).or_insert(walk), walk)?;
            holds((label, "is used up"), label.number() < self.counts.next_face)?;
            let Neighbors { before, after } = self.darts[dart.index()].in_face;
            agrees(("after before", dart), self.darts[before.index()].in_face.after, dart)?;
            agrees(("before after", dart), self.darts[after.index()].in_face.before, dart)?;
            let along: Vec<Dart> = self.pending_edges_of_face(edge).map(|edge| edge.dart()).collect();
            agrees(("pending edges along the face of", dart), along, self.walk_past_pending(dart))?;
        }
        Ok(())
    }

    /// The pending edges that a walk along the face meets from a pending edge on, until it is back.
    fn walk_past_pending(&self, start: Dart) -> Vec<Dart> {
        let mut met = vec![start];
        let mut here = self.pred(start);
        while here != start {
            // Past an edge the walk goes on at its other end.
            let Some(rev) = self.rev(here) else {
                met.push(here);
                here = self.pred(here);
                continue;
            };
            here = self.pred(rev);
        }
        met
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two vertices with an edge between them, a loop that parts the pending edges of the first, and an
    /// isolated vertex.
    fn small_graph() -> EmbeddedGraph {
        let links = [(0, 5), (1, 3)].map(|(a, b)| (Dart::new(a), Dart::new(b)));
        EmbeddedGraph::from_links([5, 2, 2], links).unwrap()
    }

    /// Whatever is carried along, the check sees that it is wrong.
    #[test]
    fn nothing_wrong_goes_unseen() {
        assert_eq!(small_graph().sanity_check(), Ok(()));
        let faults: [fn(&mut EmbeddedGraph); 16] = [
            |graph| graph.counts.edges += 1,
            |graph| graph.counts.components += 1,
            |graph| graph.counts.isolated += 1,
            |graph| graph.counts.faces_and_isolated += 1,
            |graph| graph.counts.pending -= 1,
            |graph| graph.counts.next_face = 0,
            |graph| graph.degree[0] -= 1,
            |graph| graph.darts[0].rev = Dart::new(0),
            |graph| graph.darts[6].rev = Dart::new(0),
            |graph| graph.darts[2].source = Vertex::new(1),
            |graph| graph.darts[2].face = graph.darts[4].face,
            |graph| graph.darts[7].face = FaceLabel::new(100),
            |graph| graph.darts[4].in_face.after = Dart::new(4),
            |graph| graph.darts[7].in_face = graph.darts[8].in_face,
            |graph| graph.pending.leave(6),
            |graph| {
                let _ = graph.components.unite(0, 2);
            },
        ];
        for (number, fault) in faults.into_iter().enumerate() {
            let mut graph = small_graph();
            fault(&mut graph);
            assert!(graph.sanity_check().is_err(), "fault {number}");
        }
    }
}
