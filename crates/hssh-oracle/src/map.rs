//! A topological map as plain data: places, and links between their ends (section 2.3.1).

use hssh_causal::{Exploration, StarType};
use hssh_topology::{Passability, Star};

use crate::embedding::RotationSystem;
use crate::star;

/// An oriented local path of a map: the place, in order of creation, and the position in its star.
pub type End = (usize, usize);

/// Places and links. Nothing is derived in advance and nothing is checked.
#[derive(Clone, PartialEq, Debug)]
pub struct Map<'a> {
    /// Where the star types are looked up.
    pub exploration: &'a Exploration,
    /// The star type of every place, in order of creation.
    pub places: Vec<StarType>,
    /// Which ends are joined, in order of creation.
    pub links: Vec<(End, End)>,
}

impl<'a> Map<'a> {
    /// The star of a place.
    #[must_use]
    pub fn star(&self, place: usize) -> &'a Star {
        self.exploration.star(self.places[place])
    }

    /// Every end of every place, travelable or closed.
    #[must_use]
    pub fn ends(&self) -> Vec<End> {
        let of_place = |place| (0..self.star(place).ends().len()).map(move |end| (place, end));
        (0..self.places.len()).flat_map(of_place).collect()
    }

    /// The other end of the same local path.
    #[must_use]
    pub fn opposite(&self, (place, end): End) -> End {
        (place, star::opposite(self.star(place), end))
    }

    /// The end that an end is linked to.
    #[must_use]
    pub fn partner(&self, end: End) -> Option<End> {
        self.links.iter().find_map(|&(a, b)| {
            if a == end {
                Some(b)
            } else if b == end {
                Some(a)
            } else {
                None
            }
        })
    }

    /// Whether an end is travelable but not linked.
    #[must_use]
    pub fn is_pending(&self, end: End) -> bool {
        let passability = self.star(end.0).ends()[end.1].passability;
        passability == Passability::Travelable && self.partner(end).is_none()
    }

    /// The pending gateways by ascending place and end.
    #[must_use]
    pub fn pending_gateways(&self) -> Vec<End> {
        self.ends().into_iter().filter(|&end| self.is_pending(end)).collect()
    }

    /// How many pairs of existing places were linked: the *m* of equation (3.1).
    #[must_use]
    pub fn matches(&self) -> usize {
        self.links.len() + 1 - self.places.len()
    }

    /// The linked ends, in the order in which [`Map::rotation_system`] numbers its darts.
    #[must_use]
    pub fn linked_ends(&self) -> Vec<End> {
        self.ends().into_iter().filter(|&end| self.partner(end).is_some()).collect()
    }

    /// The underlying embedded graph: a vertex for every place and a dart for every linked end, in
    /// the clockwise order of the stars. Pending and closed ends are skipped (section 3.3).
    #[must_use]
    pub fn rotation_system(&self) -> RotationSystem {
        let darts = self.linked_ends();
        let dart = |end: End| darts.iter().position(|&other| other == end).expect("the end is linked");
        let around = |place| (0..darts.len()).filter(|&dart| darts[dart].0 == place).collect();
        let reverse = |&end: &End| dart(self.partner(end).expect("a dart is a linked end"));
        RotationSystem {
            around: (0..self.places.len()).map(around).collect(),
            reverse: darts.iter().map(reverse).collect(),
        }
    }

    /// The sets P₁ … P_f: for every face, in the order of [`RotationSystem::faces`], the pending
    /// gateways in it (Definition 3.2). A map without links has one face.
    #[must_use]
    pub fn pending_by_face(&self) -> Vec<Vec<End>> {
        let (darts, faces) = (self.linked_ends(), self.rotation_system().faces());
        if faces.is_empty() {
            return vec![self.pending_gateways()];
        }
        let mut pending_by_face = vec![Vec::new(); faces.len()];
        for (place, end) in self.pending_gateways() {
            // It comes after e_{i+1}, so this is the first dart met counterclockwise.
            let degree = self.star(place).ends().len();
            let dart = (1..degree)
                .map(|steps| (place, (end + degree - steps) % degree))
                .find_map(|other| darts.iter().position(|&dart| dart == other))
                .expect("every place of a map with links is linked");
            let face = faces.iter().position(|face| face.contains(&dart)).expect("every dart lies on a face");
            pending_by_face[face].push((place, end));
        }
        pending_by_face
    }
}
