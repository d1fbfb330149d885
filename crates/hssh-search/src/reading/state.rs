//! What an account of an exploration comes to in metrical terms: a frame for each place that was reported, and the travels between them.

use std::sync::Arc;

use hssh_causal::Odometry;
use hssh_metrics::{Pose, PoseGraph, PoseId, UncertainPose, UncertaintyError};
use hssh_topology::{Account, ChartEnd, Observation, PlaceId, Reading, Sight, StarId, Way};
use serde::{Deserialize, Serialize};

use crate::experience::Experience;
use crate::frames::{bearings, circular_mean};
use crate::measured::{MeasuredTravel, PlacedTravel};
use crate::posterior::Layout;

/// A direction in the frame of a place, or of a visit: rad.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub(crate) struct Bearing {
    pub(crate) angle: f64,
    /// Else it is only where ends are spread evenly.
    pub(crate) measured: bool,
}

/// By star, and by end: the bearings as seen.
#[derive(Debug)]
pub(crate) struct Sights(Vec<Vec<Bearing>>);

impl Sights {
    pub(crate) fn of(experience: &Experience) -> Self {
        let star_bearings = |(number, star): (usize, _)| {
            let measured = experience.bearings(StarId::new(number as u32));
            let angles = bearings(star, measured);
            let bearing = |(angle, known): (f64, &Option<f64>)| Bearing { angle, measured: known.is_some() };
            angles.into_iter().zip(measured).map(bearing).collect()
        };
        Sights(experience.catalog.stars().enumerate().map(star_bearings).collect())
    }

    pub(crate) fn of_star(&self, star: StarId) -> &[Bearing] {
        &self.0[star.index()]
    }
}

/// Measured travels that lead from one place to another, with how the frames of the visits are turned against those of the places.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Leg {
    /// The travels, those to false visits among them.
    travels: [u32; 2],
    from: (PoseId, f64),
    to: (PoseId, f64),
}

/// One step of a branch: how the travel is explained.
#[derive(Debug)]
pub(crate) struct Trace {
    pub(super) before: Option<Arc<Trace>>,
    pub(crate) step: Passage,
}

/// How a travel is explained, and where it led.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Passage {
    /// How.
    pub way: Way,
    /// The end of the chart that the robot left by.
    pub exit: ChartEnd,
    /// The place that it came to; `None` if the report is of none.
    pub place: Option<PlaceId>,
    /// By end of the star seen there: the end of the place that it is.
    pub seen: Vec<Option<ChartEnd>>,
    /// The frame of the place in that of the place before, as measured since the robot was there.
    #[serde(with = "written")]
    pub measured: Option<Odometry>,
}

/// Odometry as plain numbers: its pose, and its covariance row by row.
mod written {
    use hssh_causal::Odometry;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    type Numbers = ([f64; 3], [[f64; 3]; 3]);

    pub(super) fn serialize<S: Serializer>(
        told: &Option<Odometry>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let numbers =
            |&Odometry { x, y, theta, covariance }: &Odometry| -> Numbers { ([x, y, theta], covariance) };
        told.as_ref().map(numbers).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Odometry>, D::Error> {
        let numbers: Option<Numbers> = Option::deserialize(deserializer)?;
        Ok(numbers.map(|([x, y, theta], covariance)| Odometry { x, y, theta, covariance }))
    }
}

/// An account with its layout.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) account: Account,
    pub(crate) layout: Layout,
    /// By place: its pose, if it was ever reported.
    places: Vec<Option<PoseId>>,
    /// By end: its bearing in the frame of its place, if that was ever reported.
    bearings: Vec<Option<Bearing>>,
    legs: Vec<Leg>,
    /// How the frame of the last visit to a place is turned against that of the place.
    turn: f64,
    /// The first travel since.
    since: u32,
    /// Written by itself, since states share it.
    #[serde(skip)]
    pub(super) trace: Option<Arc<Trace>>,
}

impl State {
    /// The first visit.
    pub(crate) fn begin(experience: &Experience, sights: &Sights) -> Self {
        let start = experience.start;
        let account = Account::begin(experience.catalog.star(start));
        State {
            account,
            layout: Layout::first(),
            places: vec![Some(PoseId(0))],
            bearings: sights.of_star(start).iter().copied().map(Some).collect(),
            legs: Vec::new(),
            turn: 0.0,
            since: 0,
            trace: None,
        }
    }

    /// The pose of a place, if it was ever reported.
    pub(crate) fn pose_of(&self, place: PlaceId) -> Option<PoseId> {
        self.places.get(place.index()).copied().flatten()
    }

    /// Where a place is in the layout.
    pub(crate) fn located(&self, place: PlaceId) -> Option<Pose> {
        Some(self.layout.poses[self.pose_of(place)?.index()])
    }

    /// The bearing of an end in the frame of its place.
    pub(crate) fn bearing(&self, end: ChartEnd) -> Option<Bearing> {
        self.bearings.get(end.index()).copied().flatten()
    }

    /// By what angle the frame of a visit is turned against that of the place: the mean over the ends that are the same.
    pub(crate) fn turn_under(&self, reading: &Reading, sight: Sight<'_>, seen: &[Bearing]) -> f64 {
        let pairs = reading.pairs(&self.account.chart, sight.star);
        circular_mean(
            pairs.iter().filter_map(|&(olp, end)| Some(self.bearing(end)?.angle - seen[olp.index()].angle)),
        )
    }

    /// What was measured since the last visit to a place, up to and with a travel.
    pub(crate) fn measured_since(
        &self,
        travel: usize,
        travels: &[MeasuredTravel],
    ) -> Result<MeasuredTravel, UncertaintyError> {
        compose(&travels[self.since as usize..=travel])
    }

    /// A travel from the last visit to a place to a visit whose frame is turned by `turn` against that of the place with that pose.
    pub(crate) fn placed(&self, measured: &MeasuredTravel, to: PoseId, turn: f64) -> PlacedTravel {
        let from = self.pose_of(self.account.place).expect("the robot was reported there");
        measured.between((from, turned(self.turn)), (to, turned(turn)))
    }

    /// What the travel makes of it if that is its way; χ² and poses are those from before, with one pose more if the place had none.
    pub(crate) fn follow(
        &self,
        travel: usize,
        observation: Observation,
        sight: Sight<'_>,
        seen: &[Bearing],
        way: &Way,
        travels: Option<&[MeasuredTravel]>,
    ) -> Result<State, UncertaintyError> {
        let exit = self.account.exit(observation.exit);
        let account = self.account.follow(observation.exit, sight, way);
        let mut next = State { account, ..self.clone() };
        let passage = |place, seen, measured| {
            let step = Passage { way: way.clone(), exit, place, seen, measured };
            Some(Arc::new(Trace { before: self.trace.clone(), step }))
        };
        if next.account.underway.is_some() {
            next.trace = passage(None, Vec::new(), None);
            return Ok(next);
        }
        let place = next.account.place;
        next.places.resize(next.account.chart.place_count() as usize, None);
        next.bearings.resize(next.account.chart.end_count(), None);
        let known = next.places[place.index()];
        let turn = match (known, way.arrival.reading()) {
            (Some(_), Some(reading)) => self.turn_under(reading, sight, seen),
            _ => 0.0,
        };
        let pose = known.unwrap_or(PoseId(next.layout.poses.len() as u32));
        let measured = travels.map(|travels| self.measured_since(travel, travels)).transpose()?;
        let placed = measured.map(|measured| self.placed(&measured, pose, turn));
        if known.is_none() {
            next.places[place.index()] = Some(pose);
            let from = self.located(self.account.place).expect("the robot was reported there");
            next.layout.poses.push(placed.map_or(Pose::IDENTITY, |placed| from.compose(placed.pose)));
        }
        for (olp, end) in next.account.seen.iter().enumerate() {
            let Some(end) = *end else { continue };
            let Bearing { angle, measured } = seen[olp];
            next.bearings[end.index()].get_or_insert(Bearing { angle: angle + turn, measured });
        }
        let from = (self.pose_of(self.account.place).expect("the robot was reported there"), self.turn);
        next.legs.push(Leg { travels: [self.since, travel as u32], from, to: (pose, turn) });
        (next.turn, next.since) = (turn, travel as u32 + 1);
        next.trace = passage(Some(place), next.account.seen.clone(), placed.map(|placed| odometry(&placed)));
        Ok(next)
    }

    /// The pose graph of the reported places, and what travels from a place to itself add to χ².
    pub(crate) fn graph(&self, travels: &[MeasuredTravel]) -> Result<(PoseGraph, f64), UncertaintyError> {
        let mut graph = PoseGraph::new();
        for pose in self.layout.poses.iter() {
            graph.add_pose(pose);
        }
        let mut loops = 0.0;
        for leg in &self.legs {
            let [first, last] = leg.travels;
            let measured = compose(&travels[first as usize..=last as usize])?;
            let end = |(pose, turn)| (pose, turned(turn));
            let placed = measured.between(end(leg.from), end(leg.to));
            if placed.from == placed.to {
                loops += placed.chi2_as_loop();
            } else {
                graph.add_edge(placed.edge()).expect("a state has its places, and odometry is finite");
            }
        }
        graph.anchor(PoseId(0)).expect("every state has its first place");
        Ok((graph, loops))
    }

    /// How each travel is explained.
    pub(crate) fn passages(&self) -> Vec<Passage> {
        let traces = std::iter::successors(self.trace.as_ref(), |trace| trace.before.as_ref());
        let mut passages: Vec<Passage> = traces.map(|trace| trace.step.clone()).collect();
        passages.reverse();
        passages
    }

    /// Where the robot was on each visit, the start first; `None` where the report is of no place.
    pub(crate) fn visits(&self) -> Vec<Option<PlaceId>> {
        let traces = std::iter::successors(self.trace.as_ref(), |trace| trace.before.as_ref());
        let mut visits: Vec<_> = traces.map(|trace| trace.step.place).collect();
        visits.push(Some(PlaceId::new(0)));
        visits.reverse();
        visits
    }

    /// Whether a state that was read is one, of so many travels.
    pub(super) fn is_sound(&self, travels: usize) -> bool {
        let Account { chart, place, seen, underway } = &self.account;
        let is_end = |end: ChartEnd| end.index() < chart.end_count();
        let is_pose = |pose: PoseId| pose.index() < self.layout.poses.len();
        let is_leg = |leg: &Leg| {
            let [first, last] = leg.travels;
            first <= last && (last as usize) < travels && is_pose(leg.from.0) && is_pose(leg.to.0)
        };
        chart.is_sound()
            && place.index() < chart.place_count() as usize
            && seen.iter().flatten().all(|&end| is_end(end))
            && underway.is_none_or(|underway| is_end(underway.exit))
            && self.pose_of(*place).is_some()
            && self.places.iter().flatten().all(|&pose| is_pose(pose))
            && self.bearings.len() <= chart.end_count()
            && self.legs.iter().all(is_leg)
            && self.since as usize <= travels
    }

    /// About what it takes.
    pub(crate) fn bytes(&self) -> u64 {
        let chart = self.account.chart.end_count() * 64 + self.places.len() * 80;
        let own =
            self.layout.poses.len() * 24 + self.bearings.len() * 24 + self.legs.len() * size_of::<Leg>();
        (chart + own) as u64
    }
}

/// A travel between places as an exploration has it.
fn odometry(placed: &PlacedTravel) -> Odometry {
    let Pose { x, y, theta } = placed.pose;
    let covariance = [0, 1, 2].map(|row| [0, 1, 2].map(|column| placed.covariance.matrix()[(row, column)]));
    Odometry { x, y, theta, covariance }
}

fn turned(turn: f64) -> Pose {
    Pose::new(0.0, 0.0, turn)
}

/// Travels one after the other, as one.
fn compose(travels: &[MeasuredTravel]) -> Result<MeasuredTravel, UncertaintyError> {
    let uncertain =
        |travel: &MeasuredTravel| UncertainPose { mean: travel.pose, covariance: travel.covariance };
    let chain: Vec<UncertainPose> = travels.iter().map(uncertain).collect();
    let UncertainPose { mean, covariance } = UncertainPose::compound(&chain)?.expect("a leg has travels");
    Ok(MeasuredTravel { pose: mean, covariance })
}

/// A travel, and what was seen where it led.
pub(crate) fn sight(experience: &Experience, travel: usize) -> (Observation, Sight<'_>) {
    let observation = experience.observations[travel];
    let star = experience.catalog.star(observation.star);
    (observation, Sight { star, entry: observation.entry })
}
