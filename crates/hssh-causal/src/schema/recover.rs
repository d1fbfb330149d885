//! From schemas back to stars: what turning at a place tells of its local paths and gateways.

use std::f64::consts::TAU;

use hssh_topology::{Olp, Star};

use super::{Action, Trace, View};
use crate::{Exploration, NamedStar, StarType, Travel};

/// What one stay at a place, from arrival to departure, tells of the place's star.
///
/// Positions count oriented local paths clockwise from the one faced on arrival. What is seen after turning
/// around has no position unless the circle is known; it counts only as what lies behind.
#[derive(Clone, PartialEq, Debug)]
pub struct Stay {
    /// The moment of arrival.
    pub arrival: usize,
    /// The moment of departure: the last one of the stay.
    pub departure: usize,
    /// The views by position, up to the farthest one faced; `None` where a turn went past.
    pub views: Vec<Option<View>>,
    /// Positions at which the robot turned around, with what it saw behind.
    pub behind: Vec<(u32, View)>,
    /// How many oriented local paths there are, if turns of measured angles came back to where they began.
    pub full_circle: Option<u32>,
}

impl Stay {
    /// How many oriented local paths the place may have, up to a greatest number.
    ///
    /// An even number, as every local path has two ends, and one that the views admit: "every model that is
    /// equivalent to the correct one up to a modulo operation on the circular sequence of views is
    /// legitimate" (section 2.3.3). With a measured full circle it is one number.
    #[must_use]
    pub fn degrees(&self, most: u32) -> Vec<u32> {
        let agrees = |degree: u32| {
            let mut circle: Vec<Option<&View>> = vec![None; degree as usize];
            self.views.iter().enumerate().all(|(position, view)| {
                let known = &mut circle[position % degree as usize];
                let agrees = known.is_none() || view.is_none() || *known == view.as_ref();
                *known = known.or(view.as_ref());
                agrees
            })
        };
        let even = (2..=most).step_by(2);
        even.filter(|&degree| self.full_circle.is_none_or(|full| full == degree) && agrees(degree)).collect()
    }
}

/// What the stays of a trace tell, in order.
#[must_use]
pub fn stays(trace: &Trace) -> Vec<Stay> {
    let mut stays = Vec::new();
    let mut turning = Circling::at(0, trace);
    for (schema, step) in trace.steps().iter().enumerate() {
        match step.action {
            Action::Travel => stays.push(std::mem::replace(&mut turning, Circling::at(schema + 1, trace)).stay),
            Action::Turn { clockwise } => turning.turn(clockwise, step.change.rotation, &step.view),
            Action::TurnAround => turning.turn_around(&step.view),
        }
        turning.stay.departure = schema + 1;
    }
    stays.push(turning.stay);
    stays
}

/// A stay under way.
struct Circling {
    stay: Stay,
    position: u32,
    /// The robot looks the other way: what it sees now has no position.
    is_reversed: bool,
    /// Radians turned since arrival, as long as all were measured.
    turned: Option<f64>,
}

impl Circling {
    fn at(moment: usize, trace: &Trace) -> Self {
        let views = vec![Some(trace.view(moment).clone())];
        let stay = Stay { arrival: moment, departure: moment, views, behind: Vec::new(), full_circle: None };
        Circling { stay, position: 0, is_reversed: false, turned: Some(0.0) }
    }

    fn turn(&mut self, clockwise: u32, rotation: Option<f64>, view: &View) {
        if self.is_reversed {
            // Where that is, only another turn around can tell: back there, all is as before.
            (self.is_reversed, self.turned, self.position) = (true, None, self.position);
            return;
        }
        self.position += clockwise;
        let needed = self.position as usize + 1;
        if self.stay.views.len() < needed {
            self.stay.views.resize(needed, None);
        }
        self.stay.views[self.position as usize] = Some(view.clone());
        self.turned = self.turned.zip(rotation).map(|(turned, rotation)| turned + rotation);
        let _ = TAU;
    }

    fn turn_around(&mut self, view: &View) {
        let _ = view;
    }
}
