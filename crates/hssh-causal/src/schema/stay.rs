//! From turns to stars: what one stay at a place tells of its local paths and gateways.

use std::f64::consts::TAU;

use hssh_topology::{OlpName, Sign, Star, StarEnd};

use super::{Action, Step, Trace, View};

/// How near to a full circle measured turns have to come, in radians: far less than any local path is wide.
const CLOSE: f64 = 1e-3;

/// What one stay at a place, from arrival to departure, tells of the place's star.
///
/// Positions count oriented local paths clockwise from the one faced on arrival. What is seen after turning
/// around has no position, as nothing says how many oriented local paths lie between; it is known to lie
/// behind, and what is seen by turning on from there is known to exist, no more.
#[derive(Clone, PartialEq, Debug)]
pub struct Stay {
    /// The moment of arrival.
    pub arrival: usize,
    /// The moment of departure: the last one of the stay.
    pub departure: usize,
    /// The views by position, up to the farthest one faced; `None` where a turn went past.
    pub views: Vec<Option<View>>,
    /// Positions at which the robot turned around, with what it then saw.
    pub behind: Vec<(u32, View)>,
    /// How many oriented local paths there are, if one view showed the whole place, or if turns of measured
    /// angles came back to where they began.
    pub degree: Option<u32>,
}

impl Stay {
    /// How many oriented local paths the place may have, up to a greatest number.
    ///
    /// An even number, as every local path has two ends, and one that the views admit: "every model that is
    /// equivalent to the correct one up to a modulo operation on the circular sequence of views is
    /// legitimate" (section 2.3.3). It is one number if [`Stay::degree`] is known.
    #[must_use]
    pub fn degrees(&self, most: u32) -> Vec<u32> {
        let even = (2..=most).step_by(2);
        even.filter(|&degree| self.degree.is_none_or(|known| known == degree))
            .filter(|&degree| self.circle(degree).is_some())
            .collect()
    }

    /// All stars of that many oriented local paths that the stay admits, enumerated from the position faced on
    /// arrival: one for each way to pair the ends that agrees with what was seen behind. `None` if some end
    /// was never faced, so that its attribute is unknown; empty if the views contradict the number.
    #[must_use]
    pub fn stars(&self, degree: u32) -> Option<Vec<Star>> {
        let Some(circle) = self.circle(degree) else { return Some(Vec::new()) };
        let circle: Vec<&View> = circle.into_iter().collect::<Option<_>>()?;
        let lies_behind = |position: usize, opposite: usize| {
            let seen = self.behind.iter().filter(|(at, _)| *at as usize % circle.len() == position);
            seen.into_iter().all(|(_, view)| view == circle[opposite])
        };
        let agrees = |pairs: &Vec<(usize, usize)>| {
            pairs.iter().all(|&(one, other)| lies_behind(one, other) && lies_behind(other, one))
        };
        let admitted = pairings(&(0..circle.len()).collect::<Vec<_>>()).into_iter().filter(agrees);
        Some(admitted.map(|pairs| star(&circle, &pairs)).collect())
    }

    /// The views around a place of that many oriented local paths, unless two at one position differ.
    fn circle(&self, degree: u32) -> Option<Vec<Option<&View>>> {
        let mut circle: Vec<Option<&View>> = vec![None; degree as usize];
        for (position, view) in self.views.iter().enumerate() {
            let Some(view) = view else { continue };
            if circle[position % degree as usize].replace(view).is_some_and(|known| known != view) {
                return None;
            }
        }
        Some(circle)
    }
}

/// All ways to put an even number of things in pairs.
fn pairings(things: &[usize]) -> Vec<Vec<(usize, usize)>> {
    let Some((&first, rest)) = things.split_first() else { return vec![Vec::new()] };
    let with = |&partner: &usize| {
        let others: Vec<usize> = rest.iter().copied().filter(|&other| other != partner).collect();
        pairings(&others).into_iter().map(move |pairs| [vec![(first, partner)], pairs].concat())
    };
    rest.iter().flat_map(with).collect()
}

/// The star with these attributes clockwise and these ends opposite to each other.
fn star(circle: &[&View], pairs: &[(usize, usize)]) -> Star {
    let mut ends: Vec<Option<StarEnd>> = vec![None; circle.len()];
    for (local_path, &(one, other)) in pairs.iter().enumerate() {
        for (position, sign) in [(one, Sign::Plus), (other, Sign::Minus)] {
            let (passability, label) = circle[position].ahead();
            let name = OlpName { local_path: local_path as u32, sign };
            ends[position] = Some(StarEnd { name, passability, label });
        }
    }
    Star::new(ends.into_iter().flatten()).expect("every end of a pairing has its opposite")
}

/// What the stays of a trace tell, in order: one more than there are travels.
#[must_use]
pub fn stays(trace: &Trace) -> Vec<Stay> {
    let mut stays = Vec::new();
    let mut circling = Circling::from(0, trace.view(0));
    for (schema, step) in trace.steps().iter().enumerate() {
        if step.action.is_travel() {
            stays.push(std::mem::replace(&mut circling, Circling::from(schema + 1, &step.view)).stay);
        } else {
            circling.turn(step);
            circling.stay.departure = schema + 1;
        }
    }
    stays.push(circling.stay);
    stays
}

/// Where the robot looks, as far as its turns tell.
#[derive(Clone, Copy)]
enum Facing {
    /// At a position.
    Position(u32),
    /// Away from a position.
    Behind(u32),
    /// It turned on from behind.
    Unknown,
}

/// A stay under way.
struct Circling {
    stay: Stay,
    facing: Facing,
    /// Radians counterclockwise from position 0 to the farthest position reached step by step, as long as all
    /// turns were measured.
    turned: Option<f64>,
}

impl Circling {
    fn from(arrival: usize, view: &View) -> Self {
        let degree = match view {
            View::Place(star) => Some(star.degree()),
            View::Ahead { .. } => None,
        };
        let views = vec![Some(view.clone())];
        let stay = Stay { arrival, departure: arrival, views, behind: Vec::new(), degree };
        Circling { stay, facing: Facing::Position(0), turned: Some(0.0) }
    }

    fn turn(&mut self, step: &Step) {
        self.facing = match (self.facing, step.action) {
            (Facing::Position(position), Action::TurnAround) => {
                self.stay.behind.push((position, step.view.clone()));
                Facing::Behind(position)
            }
            (Facing::Behind(position), Action::TurnAround) => Facing::Position(position),
            (Facing::Position(position), Action::Turn { clockwise }) => {
                self.reach(position + clockwise, step);
                Facing::Position(position + clockwise)
            }
            _ => Facing::Unknown,
        };
    }

    fn reach(&mut self, position: u32, step: &Step) {
        let views = &mut self.stay.views;
        views.resize(views.len().max(position as usize + 1), None);
        views[position as usize] = Some(step.view.clone());
        self.turned = self.turned.zip(step.change.rotation).map(|(turned, rotation)| turned + rotation);
        if self.turned.is_some_and(|turned| (turned + TAU).abs() < CLOSE) {
            self.stay.degree = self.stay.degree.or(Some(position));
        }
    }
}
