//! Charts: places whose stars are known as far as visits have shown them, and the links between their ends.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::model::Sightings;
use crate::axioms::Axioms;
use crate::ids::{MapOlp, Olp, PlaceId, StarId};
use crate::map::TopologicalMap;
use crate::star::{OlpName, Passability, Sign, Star, StarEnd};

/// An end of a place of a [`Chart`]: numbered in order of creation, whatever its position in the star.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct ChartEnd(u32);

impl ChartEnd {
    /// The end as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What is known of an end.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct EndRecord {
    /// Its place.
    pub place: PlaceId,
    /// The other direction of its local path.
    pub opposite: ChartEnd,
    /// Whether it is a gateway.
    pub open: bool,
    /// Its appearance, if it has one.
    #[serde(with = "label")]
    pub label: Option<Arc<str>>,
    /// The end that it is linked to.
    pub link: Option<ChartEnd>,
    /// How often its link was gone along.
    pub passed: u32,
    /// What was seen of it.
    pub sightings: Sightings,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct PlaceRecord {
    /// Clockwise.
    ends: Vec<ChartEnd>,
    visits: u32,
}

/// Places and links, as far as an exploration with errors has shown them. Unlike a [`TopologicalMap`], a chart can change
/// anywhere: a place gains ends, or is inserted on a link. What its links make of paths, faces and boundary relations is computed when it is
/// asked for.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Chart {
    places: Vec<PlaceRecord>,
    ends: Vec<EndRecord>,
    /// In the order in which they were made.
    links: Vec<[ChartEnd; 2]>,
    /// By place that was put on a link: the ends that face the link's two ends.
    through: Vec<[ChartEnd; 2]>,
}

/// Labels as plain text.
mod label {
    use std::sync::Arc;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(
        label: &Option<Arc<str>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        label.as_deref().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<str>>, D::Error> {
        Ok(Option::<String>::deserialize(deserializer)?.map(Arc::from))
    }
}

/// On which side of the way along a link a junction has its stem.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Side {
    /// Right of the way.
    Right,
    /// Left of the way.
    Left,
}

/// A junction that was put on a link.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Junction {
    pub(super) toward_from: ChartEnd,
    pub(super) toward_to: ChartEnd,
    pub(super) stem: ChartEnd,
}

impl Chart {
    /// The number of places.
    #[must_use]
    pub fn place_count(&self) -> u32 {
        self.places.len() as u32
    }

    /// All places, in the order in which they were found.
    pub fn places(&self) -> impl ExactSizeIterator<Item = PlaceId> + use<> {
        (0..self.place_count()).map(PlaceId::new)
    }

    /// All links, in the order in which they were made.
    #[must_use]
    pub fn links(&self) -> &[[ChartEnd; 2]] {
        &self.links
    }

    /// How many ends there are.
    #[must_use]
    pub fn end_count(&self) -> usize {
        self.ends.len()
    }

    /// An end.
    #[must_use]
    pub fn end(&self, end: ChartEnd) -> &EndRecord {
        &self.ends[end.index()]
    }

    /// The ends of a place, clockwise.
    #[must_use]
    pub fn ends_of(&self, place: PlaceId) -> &[ChartEnd] {
        &self.places[place.index()].ends
    }

    /// The open ends of a place, clockwise.
    pub fn open_ends_of(&self, place: PlaceId) -> impl Iterator<Item = ChartEnd> + '_ {
        self.ends_of(place).iter().copied().filter(|&end| self.end(end).open)
    }

    /// On how many visits a place was reported.
    #[must_use]
    pub fn visits(&self, place: PlaceId) -> u32 {
        self.places[place.index()].visits
    }

    /// All open ends without a link, in the order of their creation.
    pub fn pending_ends(&self) -> impl Iterator<Item = ChartEnd> + '_ {
        let ends = (0..self.ends.len() as u32).map(ChartEnd);
        ends.filter(|&end| self.is_pending(end))
    }

    /// Where a robot went on that passed a place before it was known to be there, coming in by that end.
    #[must_use]
    pub fn through(&self, end: ChartEnd) -> Option<ChartEnd> {
        self.through.iter().find_map(|&[near, far]| match end {
            end if end == near => Some(far),
            end if end == far => Some(near),
            _ => None,
        })
    }

    /// Whether an end is open and not linked.
    #[must_use]
    pub fn is_pending(&self, end: ChartEnd) -> bool {
        let record = self.end(end);
        record.open && record.link.is_none()
    }

    /// A place's star as it stands, clockwise from its first end.
    ///
    /// # Panics
    /// Never: every place has ends, each with its opposite.
    #[must_use]
    pub fn star(&self, place: PlaceId) -> Star {
        let ends = self.ends_of(place);
        let number = |end: ChartEnd| {
            let path = end.min(self.end(end).opposite);
            ends.iter().filter(|&&other| other.min(self.end(other).opposite) == other && other < path).count()
        };
        let star_end = |&end: &ChartEnd| {
            let record = self.end(end);
            let sign = if end < record.opposite { Sign::Plus } else { Sign::Minus };
            StarEnd {
                name: OlpName { local_path: number(end) as u32, sign },
                passability: if record.open { Passability::Travelable } else { Passability::Closed },
                label: record.label.as_ref().map(|label| label.to_string()),
            }
        };
        Star::new(ends.iter().map(star_end)).expect("ends come in pairs, and no place is without")
    }

    /// The map that the links make, if it satisfies the axioms: its places are the chart's, with their stars numbered as they are.
    #[must_use]
    pub fn map(&self, axioms: &Axioms) -> Option<TopologicalMap> {
        let mut map = TopologicalMap::new();
        let mut olps = vec![MapOlp::new(0); self.ends.len()];
        for place in self.places() {
            if axioms.violated_by_new_place(&map).is_some() {
                return None;
            }
            map.add_place(StarId::new(place.number()), &self.star(place));
            for (position, end) in self.ends_of(place).iter().enumerate() {
                olps[end.index()] = map.olp(place, Olp::new(position as u32));
            }
        }
        let mut joined = vec![false; self.places.len()];
        for link in &self.links {
            let [a, b] = link.map(|end| map.pending(olps[end.index()]).expect("links join open ends once"));
            // Whoever links a place that has no link yet to another one finds it: only the bound on places forbids that.
            let [from, to] = link.map(|end| self.end(end).place);
            let is_closure = from == to || (joined[from.index()] && joined[to.index()]);
            if is_closure && axioms.violated_by_closure(&map, a, b).is_some() {
                return None;
            }
            map.link(a, b);
            (joined[from.index()], joined[to.index()]) = (true, true);
        }
        axioms.violated_by_boundaries(&map).is_none().then_some(map)
    }

    /// Whether whatever its parts refer to is there: a chart that was read may have been written by anybody.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let is_end = |end: &ChartEnd| end.index() < self.ends.len();
        let is_record = |record: &EndRecord| {
            record.place.index() < self.places.len()
                && is_end(&record.opposite)
                && record.link.as_ref().is_none_or(is_end)
        };
        let of_places =
            self.places.iter().all(|place| !place.ends.is_empty() && place.ends.iter().all(is_end));
        let pairs = self.links.iter().chain(&self.through);
        of_places && self.ends.iter().all(is_record) && pairs.flatten().all(is_end)
    }

    /// Adds a place that looks like that; its ends by those of the star. It was not visited yet.
    pub(super) fn add_place(&mut self, star: &Star) -> Vec<ChartEnd> {
        let place = PlaceId::new(self.place_count());
        let first = self.ends.len() as u32;
        let end_at = |olp: Olp| ChartEnd(first + olp.number());
        for olp in star.olps() {
            self.ends.push(EndRecord {
                place,
                opposite: end_at(star.opposite(olp)),
                open: star.is_travelable(olp),
                label: star.ends()[olp.index()].label.as_deref().map(Arc::from),
                link: None,
                passed: 0,
                sightings: Sightings::default(),
            });
        }
        let ends: Vec<ChartEnd> = star.olps().map(end_at).collect();
        self.places.push(PlaceRecord { ends: ends.clone(), visits: 0 });
        ends
    }

    /// Adds an end to a place, right after another one, its opposite to be set by [`pair`](Self::pair).
    pub(super) fn insert_end(&mut self, after: ChartEnd, open: bool, label: Option<Arc<str>>) -> ChartEnd {
        let end = ChartEnd(self.ends.len() as u32);
        let place = self.end(after).place;
        let sightings = Sightings::default();
        self.ends.push(EndRecord { place, opposite: end, open, label, link: None, passed: 0, sightings });
        self.put_after(after, end);
        end
    }

    /// Moves an end of a place right after another one.
    pub(super) fn move_end(&mut self, after: ChartEnd, end: ChartEnd) {
        let place = self.end(end).place;
        self.places[place.index()].ends.retain(|&other| other != end);
        self.put_after(after, end);
    }

    fn put_after(&mut self, after: ChartEnd, end: ChartEnd) {
        let ends = &mut self.places[self.ends[after.index()].place.index()].ends;
        let position =
            ends.iter().position(|&other| other == after).expect("an end is among those of its place");
        ends.insert(position + 1, end);
    }

    /// Makes two ends the two directions of one local path.
    pub(super) fn pair(&mut self, a: ChartEnd, b: ChartEnd) {
        self.ends[a.index()].opposite = b;
        self.ends[b.index()].opposite = a;
    }

    /// Links two pending ends, which nobody passed yet.
    pub(super) fn link(&mut self, a: ChartEnd, b: ChartEnd) {
        debug_assert!(self.is_pending(a) && self.is_pending(b) && a != b, "links join pending ends");
        self.links.push([a, b]);
        self.tie(a, b, 0);
    }

    fn tie(&mut self, a: ChartEnd, b: ChartEnd, passed: u32) {
        for (end, other) in [(a, b), (b, a)] {
            let record = &mut self.ends[end.index()];
            (record.link, record.passed) = (Some(other), passed);
        }
    }

    /// Puts a place on a link, which falls in two: ⟨from, near⟩ and ⟨far, its other end⟩, each passed as often as it was.
    pub(super) fn divide(&mut self, from: ChartEnd, near: ChartEnd, far: ChartEnd) {
        let (to, passed) = (self.end(from).link.expect("only links are divided"), self.end(from).passed);
        let index = self.links.iter().position(|&[a, b]| a == from || b == from).expect("it is linked");
        let halves =
            if self.links[index][0] == from { [[from, near], [far, to]] } else { [[to, far], [near, from]] };
        self.links.splice(index..=index, halves);
        self.tie(from, near, passed);
        self.tie(to, far, passed);
        self.through.push([near, far]);
    }

    /// Puts a junction that nobody saw on a link, with its stem on that side of the way from `from` on.
    pub(super) fn add_junction(&mut self, from: ChartEnd, side: Side) -> Junction {
        // Clockwise from the way ahead.
        let star = match side {
            Side::Right => "0+ 1+ 0- (1-)",
            Side::Left => "0+ (1+) 0- 1-",
        };
        let ends = self.add_place(&star.parse().expect("the star of a junction"));
        let stem = if side == Side::Right { ends[1] } else { ends[3] };
        let junction = Junction { toward_from: ends[2], toward_to: ends[0], stem };
        for end in [junction.toward_from, junction.toward_to, junction.stem] {
            self.ends[end.index()].sightings.travelled = true;
        }
        self.divide(from, junction.toward_from, junction.toward_to);
        junction
    }

    /// The robot went along the link of an end.
    pub(super) fn pass(&mut self, end: ChartEnd) {
        let other = self.end(end).link.expect("the robot goes along links");
        self.ends[end.index()].passed += 1;
        self.ends[other.index()].passed += 1;
    }

    /// The robot left or came in by an end.
    pub(super) fn travel(&mut self, end: ChartEnd) {
        self.ends[end.index()].sightings.travelled = true;
    }

    pub(super) fn sightings_mut(&mut self, end: ChartEnd) -> &mut Sightings {
        &mut self.ends[end.index()].sightings
    }

    pub(super) fn open(&mut self, end: ChartEnd, label: Option<Arc<str>>) {
        let record = &mut self.ends[end.index()];
        (record.open, record.label) = (true, label);
    }

    /// A visit to the place was reported.
    pub(super) fn visit(&mut self, place: PlaceId) {
        self.places[place.index()].visits += 1;
    }
}
