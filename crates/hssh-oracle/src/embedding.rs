//! Embedded graphs: faces by tracing, genus by the Euler–Poincaré formula (section 3.2).

/// An embedded graph: the darts in clockwise order around every vertex, and their reverses.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RotationSystem {
    /// For every vertex, the darts that leave it, clockwise.
    pub around: Vec<Vec<usize>>,
    /// For every dart, the same edge in the other direction.
    pub reverse: Vec<usize>,
}

impl RotationSystem {
    /// The faces, each the list of its darts (Definition 3.1).
    #[must_use]
    pub fn faces(&self) -> Vec<Vec<usize>> {
        let mut faces: Vec<Vec<usize>> = Vec::new();
        for first in 0..self.reverse.len() {
            if faces.iter().any(|face| face.contains(&first)) {
                continue;
            }
            let mut face = vec![first];
            let mut dart = self.next(first);
            while dart != first {
                face.push(dart);
                dart = self.next(dart);
            }
            faces.push(face);
        }
        faces
    }

    /// next(e) = pred(rev(e)), `pred` being the counterclockwise neighbor.
    fn next(&self, dart: usize) -> usize {
        let reverse = self.reverse[dart];
        let around = &self.around[self.source(reverse)];
        let position = around.iter().position(|&other| other == reverse).expect("it leaves its source");
        around[(position + around.len() - 1) % around.len()]
    }

    fn source(&self, dart: usize) -> usize {
        self.around.iter().position(|darts| darts.contains(&dart)).expect("every dart has a source")
    }

    /// genus = (|E| + 2c − |V| − |I| − f) / 2.
    #[must_use]
    pub fn genus(&self) -> usize {
        let vertices = self.around.len();
        let edges = self.reverse.len() / 2;
        let isolated = self.around.iter().filter(|darts| darts.is_empty()).count();
        let twice = edges + 2 * self.components() - (vertices + isolated + self.faces().len());
        assert!(twice.is_multiple_of(2), "twice the genus is an even number");
        twice / 2
    }

    /// The number of connected components: vertices take the smallest label among their neighbors
    /// until nothing changes.
    fn components(&self) -> usize {
        let mut label: Vec<usize> = (0..self.around.len()).collect();
        loop {
            let before = label.clone();
            for dart in 0..self.reverse.len() {
                let (a, b) = (self.source(dart), self.source(self.reverse[dart]));
                label[a] = label[a].min(label[b]);
            }
            if label == before {
                break;
            }
        }
        (0..label.len()).filter(|&vertex| label[vertex] == vertex).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A simple graph from the clockwise neighbors of every vertex.
    fn simple(neighbors: &[Vec<usize>]) -> RotationSystem {
        let mut darts = Vec::new();
        for (from, around) in neighbors.iter().enumerate() {
            darts.extend(around.iter().map(|&to| (from, to)));
        }
        let dart = |from, to| darts.iter().position(|&other| other == (from, to)).unwrap();
        RotationSystem {
            around: (0..neighbors.len())
                .map(|from| neighbors[from].iter().map(|&to| dart(from, to)).collect())
                .collect(),
            reverse: darts.iter().map(|&(from, to)| dart(to, from)).collect(),
        }
    }

    /// How many of all rotation systems of a graph have genus 0, 1, 2, ….
    fn genus_distribution(neighbors: &[Vec<usize>]) -> Vec<usize> {
        let mut distribution = vec![0; 4];
        let orders: Vec<Vec<Vec<usize>>> = neighbors.iter().map(|around| circular_orders(around)).collect();
        let systems: usize = orders.iter().map(Vec::len).product();
        for mut index in 0..systems {
            let mut chosen = Vec::new();
            for order in &orders {
                chosen.push(order[index % order.len()].clone());
                index /= order.len();
            }
            distribution[simple(&chosen).genus()] += 1;
        }
        distribution
    }

    fn circular_orders(around: &[usize]) -> Vec<Vec<usize>> {
        let (first, rest) = around.split_first().unwrap();
        let mut orders = vec![vec![*first]];
        for &neighbor in rest {
            let insert = |order: &Vec<usize>, position| {
                let mut order = order.clone();
                order.insert(position, neighbor);
                order
            };
            orders = orders
                .iter()
                .flat_map(|order| (1..=order.len()).map(move |position| insert(order, position)))
                .collect();
        }
        orders
    }

    fn complete(vertices: usize) -> Vec<Vec<usize>> {
        (0..vertices).map(|v| (0..vertices).filter(|&w| w != v).collect()).collect()
    }

    #[test]
    fn a_tetrahedron_drawn_in_the_plane() {
        let tetrahedron = simple(&[vec![1, 3, 2], vec![2, 3, 0], vec![0, 3, 1], vec![0, 1, 2]]);
        assert_eq!(tetrahedron.faces().len(), 4);
        assert!(tetrahedron.faces().iter().all(|face| face.len() == 3));
        assert_eq!(tetrahedron.genus(), 0);
    }

    /// The regular map {4,4} with five vertices: around vertex i clockwise i+1, i+2, i−1, i−2.
    #[test]
    fn k5_in_squares_on_the_torus() {
        let k5 = simple(&(0..5).map(|i| [1, 2, 4, 3].map(|d| (i + d) % 5).to_vec()).collect::<Vec<_>>());
        assert_eq!(k5.faces().iter().map(Vec::len).collect::<Vec<_>>(), [4; 5]);
        assert_eq!(k5.genus(), 1);
    }

    /// Three hexagons: around vertex i clockwise i+1, i+3, i+5, modulo 6.
    #[test]
    fn k33_in_hexagons_on_the_torus() {
        let k33 = simple(&(0..6).map(|i| [1, 3, 5].map(|d| (i + d) % 6).to_vec()).collect::<Vec<_>>());
        assert_eq!(k33.faces().iter().map(Vec::len).collect::<Vec<_>>(), [6; 3]);
        assert_eq!(k33.genus(), 1);
    }

    #[test]
    fn loops_crossed_and_uncrossed() {
        let loops = |around| RotationSystem { around: vec![around], reverse: vec![1, 0, 3, 2] };
        assert_eq!(loops(vec![0, 1, 2, 3]).genus(), 0);
        assert_eq!(loops(vec![0, 1, 2, 3]).faces().len(), 3);
        assert_eq!(loops(vec![0, 2, 1, 3]).genus(), 1);
        assert_eq!(loops(vec![0, 2, 1, 3]).faces().len(), 1);
    }

    #[test]
    fn isolated_vertices_and_separate_components_have_no_handles() {
        let triangles =
            simple(&[vec![1, 2], vec![2, 0], vec![0, 1], vec![4, 5], vec![5, 3], vec![3, 4], vec![]]);
        assert_eq!(triangles.faces().len(), 4);
        assert_eq!(triangles.genus(), 0);
        assert_eq!(RotationSystem { around: vec![vec![]], reverse: vec![] }.genus(), 0);
    }

    /// The genus distributions of the literature: how many of all 16, 64 and 7,776 rotation systems of
    /// K4, K3,3 and K5 have genus 0, 1, 2, 3.
    #[test]
    fn genus_distributions_of_small_graphs() {
        let k33: Vec<Vec<usize>> = (0..6).map(|v| (0..6).filter(|w| (v + w) % 2 == 1).collect()).collect();
        assert_eq!(genus_distribution(&complete(4)), [2, 14, 0, 0]);
        assert_eq!(genus_distribution(&k33), [0, 40, 24, 0]);
        assert_eq!(genus_distribution(&complete(5)), [0, 462, 4974, 2340]);
    }
}
