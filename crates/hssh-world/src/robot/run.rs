//! The robot on its way: it perceives, obeys control laws, and keeps the log (section 2.1.1).

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use hssh_causal::control::{Action, Command, ControlLaw, Percept, approach, travel};
use hssh_local::{Gateway, LatticeError, OccupancyGrid, PlaceGraph, PlaceNumber};
use hssh_metrics::{Pose, wrap_angle};
use hssh_topology::Olp;
use nalgebra::vector;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::body::touches;
use super::options::RobotOptions;
use super::outlook::Outlook;
use super::record::{Ending, Moment, Stop};
use super::strategy::{Guide, Plan, Strategy};

/// The robot is at a place of the map if its center is this near, in metres, beyond the clearance there.
const AT_PLACE: f64 = 1.5;
/// What looked like a place from afar may be none so often.
const MOST_ILLUSIONS: usize = 10;
/// What looked like the end of a corridor may be a niche so often.
const MOST_NICHES: usize = 5;
/// A gateway that the robot reads may be the one meant if it leads the same way up to this much, in radians.
const SAME_GATEWAY: f64 = 0.7;

/// A robot on its way.
pub(super) struct Run<'a> {
    grid: &'a OccupancyGrid,
    graph: &'a PlaceGraph,
    options: &'a RobotOptions,
    interrupted: &'a dyn Fn() -> bool,
    outlook: Outlook,
    pose: Pose,
    odometry: Pose,
    /// Where the gateway led by which it left last, in the frame of its local map.
    course: f64,
    moments: Vec<Moment>,
    stops: Vec<Stop>,
    /// Where it was when it logged a scan last, and when it looked for a place last.
    scanned_at: Option<Pose>,
    looked_at: Option<Pose>,
    /// One source of randomness each, so that more noise does not change which way is taken.
    in_laser: ChaCha8Rng,
    in_wheels: ChaCha8Rng,
    in_choice: ChaCha8Rng,
}

impl<'a> Run<'a> {
    pub(super) fn new(
        grid: &'a OccupancyGrid,
        graph: &'a PlaceGraph,
        start: [f64; 2],
        options: &'a RobotOptions,
        seed: u64,
        interrupted: &'a dyn Fn() -> bool,
    ) -> Result<Self, LatticeError> {
        let stream = |number| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(number);
            random
        };
        Ok(Run {
            grid,
            graph,
            options,
            interrupted,
            outlook: Outlook::new(options.outlook)?,
            pose: Pose::new(start[0], start[1], 0.0),
            odometry: Pose::IDENTITY,
            course: 0.0,
            moments: Vec::new(),
            stops: Vec::new(),
            scanned_at: None,
            looked_at: None,
            in_laser: stream(0),
            in_wheels: stream(1),
            in_choice: stream(2),
        })
    }

    pub(super) fn into_log(self) -> (Vec<Moment>, Vec<Stop>) {
        (self.moments, self.stops)
    }

    /// Goes to the place at hand, and travels as the strategy says.
    pub(super) fn travel(&mut self, strategy: Strategy) -> Result<(), Ending> {
        let mut guide = Guide::new(self.graph, strategy);
        let mut plan: Option<Plan> = None;
        self.turn_around()?;
        let start = self.first_action();
        self.go(&start)?;
        for _ in 0..self.options.travels {
            let ahead = self.outlook.pose().theta;
            self.arrive()?;
            let Some(here) = self.stop(plan) else {
                // Something is like a place that the map does not have: straight on.
                let action = self.way_toward(ahead).ok_or(Ending::NoWayOn)?;
                self.go(&action)?;
                continue;
            };
            let entry = plan.filter(|plan| plan.to.0 == here).map(|plan| plan.to.1);
            plan.filter(|plan| plan.to.0 != here).into_iter().for_each(|plan| guide.miss(plan));
            let star = &self.graph.place(here).star;
            let turned = self.outlook.pose().theta - self.pose.theta;
            let way_out = |olp: Olp| {
                let meant = star.gateways[olp.index()]?;
                Some((olp, self.way_toward(meant.bearing + turned)?))
            };
            let mut seen: BTreeMap<Olp, Action> = star.star.gateways().filter_map(way_out).collect();
            let next = guide.next(here, entry, |exit| seen.contains_key(&exit), &mut self.in_choice);
            let found = next.and_then(|next| Some((next, seen.remove(&next.exit)?)));
            let Some((next, action)) = found else {
                return if guide.is_done(here) { Ok(()) } else { Err(Ending::NoWayOn) };
            };
            if let Some(stop) = self.stops.last_mut() {
                stop.exit = Some(next.exit);
            }
            self.go(&action)?;
            plan = Some(next);
        }
        self.arrive()?;
        let here = self.stop(plan);
        let is_done = here.is_some_and(|here| guide.is_done(here));
        match guide.left(here) {
            left if left > 0 && !is_done => Err(Ending::OutOfTravels(left)),
            _ => Ok(()),
        }
    }

    /// In a place, center; in a corridor, follow it, one way or the other.
    fn first_action(&mut self) -> Action {
        self.look();
        if self.outlook.vicinity().is_some() {
            return vec![ControlLaw::HillClimb];
        }
        approach(self.corridor_width())
    }

    /// Turns around once, so that the whole neighborhood was seen, and centers in it. If it is none when seen so
    /// well, goes on where the corridor led: climbing toward the illusion may have turned the robot back.
    fn arrive(&mut self) -> Result<(), Ending> {
        for _ in 0..MOST_ILLUSIONS {
            self.turn_around()?;
            self.look();
            self.outlook.read_again();
            if self.outlook.vicinity().is_some() {
                match self.perform(&vec![ControlLaw::HillClimb]) {
                    Err(Ending::Lost(ControlLaw::HillClimb)) => continue,
                    ended => return ended,
                }
            }
            self.face(self.course)?;
            let width = self.corridor_width();
            self.go(&approach(width))?;
        }
        Err(Ending::Lost(ControlLaw::HillClimb))
    }

    /// How wide the corridor is that the robot is in, in metres.
    fn corridor_width(&self) -> f64 {
        let sighting = self.outlook.sighting();
        let width = sighting.and_then(|found| found.gateways.first().map(|gateway| gateway.width));
        width.unwrap_or(f64::INFINITY)
    }

    /// The travel by the gateway that leads most in a direction, in the frame of the robot's local map; none if
    /// no gateway does.
    fn way_toward(&self, bearing: f64) -> Option<Action> {
        let off = |gateway: &Gateway| wrap_angle(gateway.bearing - bearing).abs();
        let read = self.outlook.gateways().map(off).enumerate();
        let (index, off) = read.min_by(|a, b| a.1.total_cmp(&b.1))?;
        travel(&self.outlook.vicinity()?, index).filter(|_| off <= SAME_GATEWAY)
    }

    /// Performs an action that leads to a place. A climb that does not end, since from there a scan alone shows no place, is the end of it, too:
    /// whoever turns around then sees more.
    fn go(&mut self, action: &Action) -> Result<(), Ending> {
        match self.perform(action) {
            Err(Ending::Lost(ControlLaw::HillClimb)) => Ok(()),
            ended => ended,
        }
    }

    /// Applies each law of an action until it ends. Where a niche seemed to be the end of the corridor, the robot turns
    /// to where the corridor led and follows it on.
    fn perform(&mut self, action: &Action) -> Result<(), Ending> {
        for &law in action {
            if let ControlLaw::Leave { gateway, .. } = law {
                self.course = self.outlook.gateways().nth(gateway).map_or(self.course, |way| way.bearing);
            }
            for _ in 0..MOST_NICHES {
                if law != ControlLaw::HillClimb || law.is_applicable(&self.perceive()) {
                    break;
                }
                self.face(self.course)?;
                self.apply(ControlLaw::FollowMidline { width: self.corridor_width() })?;
            }
            self.apply(law)?;
        }
        Ok(())
    }

    /// Applies a law until it ends.
    fn apply(&mut self, law: ControlLaw) -> Result<(), Ending> {
        let mut percept = self.perceive();
        if !law.is_applicable(&percept) {
            return Err(Ending::Lost(law));
        }
        let patience = (self.options.patience / self.options.period) as u64;
        let mut commands = 0;
        while !law.is_finished(&percept, &self.options.handling) {
            if commands == patience {
                return Err(Ending::Lost(law));
            }
            self.obey(law.command(&percept, &self.options.handling), &percept)?;
            percept = self.perceive();
            commands += 1;
        }
        Ok(())
    }

    /// Turns on the spot until it looks in a direction, in the frame of the local map.
    fn face(&mut self, bearing: f64) -> Result<(), Ending> {
        loop {
            let off = wrap_angle(bearing - self.outlook.pose().theta);
            let most = self.options.handling.turn;
            let turn = (off / self.options.period).clamp(-most, most);
            let percept = self.perceive();
            self.obey(Command { speed: 0.0, turn }, &percept)?;
            if off.abs() <= most * self.options.period {
                return Ok(());
            }
        }
    }

    /// Turns around once on the spot.
    fn turn_around(&mut self) -> Result<(), Ending> {
        let command = Command { speed: 0.0, turn: self.options.handling.turn };
        let commands = (TAU / (command.turn * self.options.period)).ceil() as u32;
        for _ in 0..commands {
            let percept = self.perceive();
            self.obey(command, &percept)?;
        }
        Ok(())
    }

    fn perceive(&mut self) -> Percept {
        let ranges = self.options.laser.sweep(self.grid, self.pose, &mut self.in_laser);
        Percept { ranges, neighborhood: self.outlook.vicinity() }
    }

    /// Logs what is perceived, moves for one period, and looks around.
    fn obey(&mut self, command: Command, percept: &Percept) -> Result<(), Ending> {
        self.log(percept);
        if (self.interrupted)() {
            return Err(Ending::Interrupted);
        }
        let twist = vector![command.speed, 0.0, command.turn] * self.options.period;
        let moved = self.pose.compose(Pose::exp(twist));
        if touches(self.grid, [moved.x, moved.y], self.options.handling.radius) {
            return Err(Ending::Collision);
        }
        self.pose = moved;
        self.odometry = self.odometry.compose(self.options.odometer.measure(twist, &mut self.in_wheels));
        self.outlook.move_on(self.odometry);
        let is_far = |from: Pose| from.between(moved).translation().norm() >= self.options.look_distance;
        if self.looked_at.is_none_or(is_far) {
            self.look();
        }
        Ok(())
    }

    fn look(&mut self) {
        self.outlook.look();
        self.looked_at = Some(self.pose);
    }

    /// Writes down where the robot is, and a scan if it is time for one.
    fn log(&mut self, percept: &Percept) {
        let is_due = self.scanned_at.is_none_or(|from| {
            let step = from.between(self.pose);
            step.translation().norm() >= self.options.scan_distance
                || step.theta.abs() >= self.options.scan_turn
        });
        let scan = is_due.then(|| self.options.laser.front(&percept.ranges));
        if let Some(front) = &scan {
            self.scanned_at = Some(self.pose);
            self.outlook.take_in(front, &self.options.laser.back(&percept.ranges));
        }
        self.moments.push(Moment {
            time: self.moments.len() as f64 * self.options.period,
            pose: self.pose,
            odometry: self.odometry,
            scan: scan.map(|scan| scan.ranges),
        });
    }

    /// Writes down that the robot is in a distinctive state; the place it truly is at, if it is at one.
    fn stop(&mut self, plan: Option<Plan>) -> Option<PlaceNumber> {
        let at = [self.pose.x, self.pose.y];
        let places = self.graph.places.iter().enumerate().map(|(number, place)| {
            let off = (place.center[0] - at[0]).hypot(place.center[1] - at[1]);
            (PlaceNumber(number as u32), off, place.clearance)
        });
        let nearest = places
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, off, clearance)| *off <= clearance + AT_PLACE);
        self.stops.push(Stop {
            place: nearest.map(|(number, ..)| number),
            meant: plan.map(|plan| plan.to.0),
            pose: self.pose,
            off_center: nearest.map(|(_, off, _)| off),
            exit: None,
            moment: self.moments.len(),
        });
        nearest.map(|(number, ..)| number)
    }
}
