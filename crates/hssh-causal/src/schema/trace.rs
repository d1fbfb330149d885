//! Traces: the chain of causal schemas ⟨v, a, v'⟩ that an exploration is at the causal level (section 2.1.2).

use std::f64::consts::{PI, TAU};

use hssh_topology::{Olp, Star};

use super::{Action, Change, Sight, View};
use crate::{Exploration, NamedStar, Odometry, StarType, Travel};

/// How the robot turns from where it looks on arrival to where it leaves.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Turning {
    /// By one action: whoever sees the whole star knows how far to turn.
    Direct,
    /// Clockwise from one oriented local path to the next until it faces the exit; around, if it goes back.
    Stepwise,
    /// First once all around, from one oriented local path to the next, then stepwise.
    AllRound,
    /// First once all around, and at every oriented local path around and back, then stepwise.
    AllRoundAndAround,
}

/// A causal schema ⟨v, a, v'⟩: action `a`, done in a distinctive state with view `v`, led to one with view `v'`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Schema<'a> {
    /// The view before.
    pub from: &'a View,
    /// What the robot did.
    pub action: Action,
    /// The view after.
    pub to: &'a View,
    /// How far that was, where it was measured.
    pub change: Change,
}

/// An action and what it led to.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// What the robot did.
    pub action: Action,
    /// How far that was, where it was measured.
    pub change: Change,
    /// The view after it.
    pub view: View,
}

/// The whole experience of a robot at the causal level: alternating views and actions.
///
/// Its *moments* are counted from 0; schema *i* leads from moment *i* to moment *i* + 1. Which moments are
/// the same distinctive state is not said: that is what maps are about.
#[derive(Clone, PartialEq, Debug)]
pub struct Trace {
    first: View,
    steps: Vec<Step>,
}

impl Trace {
    /// A trace from the first view on.
    #[must_use]
    pub fn new(first: View, steps: Vec<Step>) -> Self {
        Trace { first, steps }
    }

    /// What a robot with that sight, turning that way, experiences in an exploration. It begins facing the
    /// first exit and ends with the last arrival, facing the way it came in: the opposite of the entry.
    /// `None` if there are no travels, since then nothing says which way the robot looks.
    #[must_use]
    pub fn of(exploration: &Exploration, sight: Sight, turning: Turning) -> Option<Self> {
        let exit = exploration.travels().first()?.exit;
        let mut robot =
            Robot { exploration, sight, here: exploration.start(), facing: exit, steps: Vec::new() };
        let first = View::of(robot.star(), exit, sight);
        robot.look_around(turning);
        for (index, travel) in exploration.travels().iter().enumerate() {
            if index > 0 {
                robot.look_around(turning);
                robot.face(travel.exit, turning);
            }
            robot.travel(travel);
        }
        Some(Trace { first, steps: robot.steps })
    }

    /// The views, in order: one more than there are schemas.
    pub fn views(&self) -> impl ExactSizeIterator<Item = &View> {
        Moments { first: Some(&self.first), rest: self.steps.iter() }
    }

    /// The view at a moment.
    ///
    /// # Panics
    /// If the trace is over by then.
    #[must_use]
    pub fn view(&self, moment: usize) -> &View {
        moment.checked_sub(1).map_or(&self.first, |step| &self.steps[step].view)
    }

    /// The actions and what they led to, in order.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The schemas, in order.
    pub fn schemas(&self) -> impl ExactSizeIterator<Item = Schema<'_>> {
        self.steps.iter().zip(self.views()).map(|(step, from)| {
            let Step { action, change, view } = step;
            Schema { from, action: *action, to: view, change: *change }
        })
    }
}

/// The views of a trace, in order.
struct Moments<'a> {
    first: Option<&'a View>,
    rest: std::slice::Iter<'a, Step>,
}

impl<'a> Iterator for Moments<'a> {
    type Item = &'a View;

    fn next(&mut self) -> Option<&'a View> {
        self.first.take().or_else(|| self.rest.next().map(|step| &step.view))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let length = usize::from(self.first.is_some()) + self.rest.len();
        (length, Some(length))
    }
}

impl ExactSizeIterator for Moments<'_> {}

/// A robot that repeats an exploration and writes down what it does and sees.
struct Robot<'a> {
    exploration: &'a Exploration,
    sight: Sight,
    here: StarType,
    facing: Olp,
    steps: Vec<Step>,
}

impl<'a> Robot<'a> {
    fn named(&self) -> &'a NamedStar {
        &self.exploration.star_types()[self.here.index()]
    }

    fn star(&self) -> &'a Star {
        &self.named().star
    }

    fn look_around(&mut self, turning: Turning) {
        if matches!(turning, Turning::Direct | Turning::Stepwise) {
            return;
        }
        for _ in 0..self.star().degree() {
            if turning == Turning::AllRoundAndAround {
                self.turn_around();
                self.turn_around();
            }
            self.turn(1);
        }
    }

    fn face(&mut self, exit: Olp, turning: Turning) {
        let degree = self.star().degree();
        let clockwise = self.facing.turn_to(exit, degree);
        match turning {
            _ if clockwise == 0 => {} // straight on: no action at all
            _ if exit == self.star().opposite(self.facing) => self.turn_around(),
            Turning::Direct => self.turn(clockwise),
            _ => (0..clockwise).for_each(|_| self.turn(1)),
        }
    }

    fn turn(&mut self, clockwise: u32) {
        let facing = self.facing.turned(clockwise, self.star().degree());
        let angle = self.angle_to(facing).map(|angle| angle.rem_euclid(TAU) - TAU);
        self.end_up(facing, Action::Turn { clockwise }, Change { rotation: angle, ..Change::default() });
    }

    fn turn_around(&mut self) {
        let facing = self.star().opposite(self.facing);
        let angle = self.angle_to(facing).map(wrap);
        self.end_up(facing, Action::TurnAround, Change { rotation: angle, ..Change::default() });
    }

    /// Counterclockwise from where the robot looks to another oriented local path.
    fn angle_to(&self, olp: Olp) -> Option<f64> {
        Some(heading(self.named(), olp)? - heading(self.named(), self.facing)?)
    }

    fn travel(&mut self, travel: &Travel) {
        let departure = heading(self.named(), travel.exit);
        self.here = travel.star;
        let facing = self.star().opposite(travel.entry);
        let arrival = heading(self.named(), facing);
        let change = travel.odometry.map_or(Change::default(), |odometry| {
            let rotation = departure.zip(arrival).map(|(from, to)| wrap(odometry.theta + to - from));
            let covariance = rotation.and(covariance(&odometry));
            Change { distance: Some(odometry.x.hypot(odometry.y)), rotation, covariance }
        });
        self.end_up(facing, Action::Travel, change);
    }

    fn end_up(&mut self, facing: Olp, action: Action, change: Change) {
        self.facing = facing;
        let view = View::of(self.star(), facing, self.sight);
        self.steps.push(Step { action, change, view });
    }
}

/// Where the robot looks in the place's frame when it faces an oriented local path: along its bearing, or
/// else away from its opposite's.
fn heading(named: &NamedStar, olp: Olp) -> Option<f64> {
    let bearing = |olp: Olp| named.bearings[olp.index()];
    bearing(olp).or_else(|| bearing(named.star.opposite(olp)).map(|behind| behind + PI))
}

/// The covariance of (distance, rotation): J C Jᵀ with the derivatives of √(x² + y²) and of θ.
fn covariance(odometry: &Odometry) -> Option<[[f64; 2]; 2]> {
    let Odometry { x, y, covariance: c, .. } = odometry;
    let distance = x.hypot(*y);
    (distance > 0.0).then(|| {
        let (along_x, along_y) = (x / distance, y / distance);
        let both = along_x * c[0][2] + along_y * c[1][2];
        let variance =
            along_x * along_x * c[0][0] + 2.0 * along_x * along_y * c[0][1] + along_y * along_y * c[1][1];
        [[variance, both], [both, c[2][2]]]
    })
}

/// The same direction in (−π, π].
fn wrap(angle: f64) -> f64 {
    PI - (PI - angle).rem_euclid(TAU)
}
