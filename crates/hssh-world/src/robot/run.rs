//! The robot on its way: it perceives, obeys control laws, and keeps the log (section 2.1.1).

use std::f64::consts::TAU;

use hssh_causal::control::{Action, Command, ControlLaw, Percept, approach, travel};
use hssh_local::{Gateway, OccupancyGrid, PlaceGraph, PlaceNumber, neighborhood};
use hssh_metrics::Pose;
use nalgebra::vector;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::body::touches;
use super::drive::{Ending, Moment, Stop};
use super::options::RobotOptions;
use super::outlook::Outlook;
use super::strategy::{Guide, Plan, Strategy};

/// A gateway that the robot reads is the one meant if it is this near to it, in metres, or within its width.
const SAME_GATEWAY: f64 = 1.0;

/// A robot on its way.
pub(super) struct Run<'a> {
    grid: &'a OccupancyGrid,
    graph: &'a PlaceGraph,
    options: &'a RobotOptions,
    outlook: Outlook,
    pose: Pose,
    odometry: Pose,
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
    ) -> Self {
        let stream = |number| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(number);
            random
        };
        Run {
            grid,
            graph,
            options,
            outlook: Outlook::new(),
            pose: Pose::new(start[0], start[1], 0.0),
            odometry: Pose::IDENTITY,
            moments: Vec::new(),
            stops: Vec::new(),
            scanned_at: None,
            looked_at: None,
            in_laser: stream(0),
            in_wheels: stream(1),
            in_choice: stream(2),
        }
    }

    pub(super) fn into_log(self) -> (Vec<Moment>, Vec<Stop>) {
        (self.moments, self.stops)
    }

    /// Goes to the place at hand, and travels as the strategy says.
    pub(super) fn travel(&mut self, strategy: Strategy) -> Result<(), Ending> {
        let mut guide = Guide::new(self.graph, strategy);
        let mut plan: Option<Plan> = None;
        let start = self.first_action();
        self.turn_around()?;
        self.perform(&start)?;
        for _ in 0..self.options.travels {
            let here = self.stop(plan);
            let entry = plan.filter(|plan| Some(plan.to.0) == here).map(|plan| plan.to.1);
            let next = here.and_then(|here| Some((here, guide.next(here, entry, &mut self.in_choice)?)));
            let Some((here, next)) = next else {
                self.turn_around()?;
                return if here.is_some() && guide.is_done() { Ok(()) } else { Err(Ending::NoWayOn) };
            };
            let meant = self.graph.place(here).star.gateways[next.exit.index()].ok_or(Ending::NoWayOn)?;
            let action = self.way_out(&meant).ok_or(Ending::NoWayOn)?;
            if let Some(stop) = self.stops.last_mut() {
                stop.exit = Some(next.exit);
            }
            self.perform(&action)?;
            plan = Some(next);
        }
        self.stop(plan);
        self.turn_around()
    }

    /// In a place, center; in a corridor, follow it, one way or the other.
    fn first_action(&mut self) -> Action {
        let at = [self.pose.x, self.pose.y];
        self.look();
        if self.outlook.vicinity(self.pose).is_some() {
            return vec![ControlLaw::HillClimb];
        }
        let window = self.grid.window(at, self.options.window);
        let found = window.and_then(|window| neighborhood(&window, at, &self.options.places).ok());
        let ahead = found.and_then(|found| found.star.gateways().next().copied());
        if let Some(gateway) = ahead {
            self.pose = Pose::new(self.pose.x, self.pose.y, gateway.bearing);
        }
        approach(ahead.map_or(self.options.window, |gateway| gateway.width))
    }

    /// The travel by the gateway that the robot reads nearest to the one meant.
    fn way_out(&self, meant: &Gateway) -> Option<Action> {
        let off = |gateway: &Gateway| {
            let [dx, dy] = [0, 1].map(|axis| gateway.position[axis] - meant.position[axis]);
            dx.hypot(dy)
        };
        let read = self.outlook.gateways().iter().enumerate();
        let (index, gateway) = read.min_by(|a, b| off(a.1).total_cmp(&off(b.1)))?;
        let is_meant = off(gateway) <= meant.width.max(SAME_GATEWAY);
        travel(&self.outlook.vicinity(self.pose)?, index).filter(|_| is_meant)
    }

    /// Applies each law of an action until it ends.
    fn perform(&mut self, action: &Action) -> Result<(), Ending> {
        for &law in action {
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
        }
        Ok(())
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
        Percept { ranges, neighborhood: self.outlook.vicinity(self.pose) }
    }

    /// Logs what is perceived, moves for one period, and looks around.
    fn obey(&mut self, command: Command, percept: &Percept) -> Result<(), Ending> {
        self.log(percept);
        let twist = vector![command.speed, 0.0, command.turn] * self.options.period;
        let moved = self.pose.compose(Pose::exp(twist));
        if touches(self.grid, [moved.x, moved.y], self.options.handling.radius) {
            return Err(Ending::Collision);
        }
        self.pose = moved;
        self.odometry = self.odometry.compose(self.options.odometer.measure(twist, &mut self.in_wheels));
        let is_far = |from: Pose| from.between(moved).translation().norm() >= self.options.look_distance;
        if self.looked_at.is_none_or(is_far) {
            self.look();
        }
        Ok(())
    }

    fn look(&mut self) {
        self.outlook.look(self.grid, [self.pose.x, self.pose.y], self.options);
        self.looked_at = Some(self.pose);
    }

    fn log(&mut self, percept: &Percept) {
        let is_due = self.scanned_at.is_none_or(|from| {
            let step = from.between(self.pose);
            step.translation().norm() >= self.options.scan_distance
                || step.theta.abs() >= self.options.scan_turn
        });
        if is_due {
            self.scanned_at = Some(self.pose);
        }
        self.moments.push(Moment {
            time: self.moments.len() as f64 * self.options.period,
            pose: self.pose,
            odometry: self.odometry,
            scan: is_due.then(|| self.options.laser.scan(&percept.ranges)),
        });
    }

    /// Writes down that the robot is in a distinctive state, and reads the gateways anew; the place it truly is
    /// at, if it is at one.
    fn stop(&mut self, plan: Option<Plan>) -> Option<PlaceNumber> {
        let at = [self.pose.x, self.pose.y];
        self.outlook.read_again(self.grid, at, self.options);
        let places = self.graph.places.iter().enumerate().map(|(number, place)| {
            let off = (place.center[0] - at[0]).hypot(place.center[1] - at[1]);
            (PlaceNumber(number as u32), off, place.clearance)
        });
        let nearest = places.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, off, reach)| off <= reach);
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
