//! From an exploration or a robot's log to an answer, step by step: survey, likeness, search, maps, grid.

mod assemble;
mod building;
mod driven;
mod engine;
mod error;
mod input;
mod laser;
mod online;
mod options;
mod places;
mod reading;
mod scans;
mod tracked;

pub use engine::{Checkpoints, Keeper, Means, Monitor, Searchers, Source, Store};
pub use error::{PipelineError, SearchFailure};
pub use input::{Input, SurveyedLog};
pub use laser::LaserChoice;
pub use online::{Belief, History};
pub use options::{
    GenusOrder, MappingOptions, MetricalScore, OptionsError, PosteriorChoice, PriorKind, SearchChoice,
    SearchLimits, SearchMethod, VisitChoice,
};
pub use places::PlaceChoice;
pub use reading::ReadingChoice;
pub use tracked::TrackedLog;

use std::sync::Arc;
use std::thread::available_parallelism;

use hssh_causal::Exploration;
use hssh_draw::SearchTree;
use hssh_local::{OccupancyGrid, PerceptionModel, building_map, resemblance};
use hssh_metrics::{Pose, PoseGraph};
use hssh_search::{Mapper, Tree};
use hssh_topology::{Isomorphism, Position};

use crate::answer::{Answer, AnswerWarning, AnsweredMap, ReadingAccount, Spot, Verdict, WarningKind};
use assemble::{Assembly, records};
use building::Building;
use engine::{Likeness, Telling};
pub(crate) use engine::{Searched, Task};

/// More threads than that for each core are of no use.
const THREADS_PER_CORE: usize = 4;

/// An answer, with what is too large to be part of it.
pub struct Mapped {
    /// The answer.
    pub answer: Answer,
    searched: Searched,
    /// By rank.
    placed: Vec<PlacedMap>,
    /// What the first map makes of the building, if there is a log.
    building: Option<Building>,
    /// What the maps are of, if errors of perception were reckoned with.
    corrected: Option<Exploration>,
}

/// Where a map has the robot on each visit, and its pose graph if travels were measured.
struct PlacedMap {
    positions: Vec<Position>,
    graph: Option<PoseGraph>,
}

impl PlacedMap {
    /// Where every scan of the log was taken, in the frame of the first place.
    fn scan_poses(&self, input: &Input) -> Option<Vec<Pose>> {
        let SurveyedLog { survey, .. } = input.surveyed.as_ref()?;
        driven::scan_poses(survey, &self.positions, self.graph.as_ref())
    }
}

/// Finds the maps that explain an input. `monitor` shows other threads how far the search is, and lets them stop it.
///
/// # Errors
/// If options make no sense or contradict one another, measurements that the search needs are missing or useless, or the operating system
/// gives no threads.
pub fn map(input: &Input, options: &MappingOptions, monitor: &Arc<Monitor>) -> Result<Mapped, PipelineError> {
    map_with(input, options, monitor, &Means::default())
}

/// The same with other means than those of this process.
///
/// # Errors
/// As [`map`], and if what was kept is of another search or damaged, or a process is lost.
pub fn map_with(
    input: &Input,
    options: &MappingOptions,
    monitor: &Arc<Monitor>,
    means: &Means<'_>,
) -> Result<Mapped, PipelineError> {
    options.check()?;
    let mut options = options.clone();
    let considered = options.limits.travels.unwrap_or(usize::MAX).min(input.exploration.travels().len());
    let exploration = input.exploration.prefix(considered);
    options.visits.constraints()?.check(considered)?;
    let mut warnings = input.surveyed.as_ref().map(SurveyedLog::warnings).unwrap_or_default();
    if input.surveyed.is_none() {
        for doubt in exploration.doubts() {
            let spot = Spot::Visit(doubt.travel as u64 + 1);
            AnswerWarning::record(&mut warnings, WarningKind::Questionable, spot, || doubt.to_string());
        }
    }
    options.search.threads = useful_threads(options.search.threads, &mut warnings);
    let method = options.method_for(&exploration)?;
    let read = match options.readings.model {
        None => None,
        Some(_) if input.surveyed.is_some() => return Err(PipelineError::ReadingsOfLog),
        Some(_) if exploration.travels().iter().any(|travel| travel.odometry.is_none()) => {
            return Err(PipelineError::UnmeasuredReadings);
        }
        Some(model) => {
            let posterior = engine::model(&exploration, &options)?;
            Some(reading::read(&exploration, model, posterior, &options, monitor, means)?)
        }
    };
    if let Some(reading::Read { exploration, account, stop }) = read {
        let corrected = Input::exploration(input.name.clone(), exploration);
        let exact = options.given(&account);
        // What is not read to its end will be read otherwise when it is gone on with.
        let checkpoints = means.checkpoints.clone().filter(|_| stop.is_complete());
        let mut mapped = map_with(
            &corrected,
            &exact,
            monitor,
            &Means { checkpoints, store: means.store.clone(), ..Means::default() },
        )?;
        if !stop.is_complete() {
            mapped.answer.search.stop = stop;
        }
        mapped.rest_on(account, warnings);
        mapped.corrected = Some(corrected.exploration);
        return Ok(mapped);
    }
    let likeness = input.surveyed.as_ref().map(|surveyed| surveyed.likeness(options.posterior.likeness));
    let exploration = &exploration;
    let task = Task { exploration, options: &options, method, likeness, monitor, is_online: false, means };
    Ok(answered(input, exploration, &options, task.search()?, warnings))
}

/// The answer that a search gives, of an input of which the travels of `exploration` were to be explained.
pub(crate) fn answered(
    input: &Input,
    exploration: &Exploration,
    options: &MappingOptions,
    searched: Searched,
    mut warnings: Vec<AnswerWarning>,
) -> Mapped {
    let considered = exploration.travels().len();
    let (maps, placed) = told(input, &searched, exploration, &mut warnings);
    let account = input.account(considered, searched.explained as u64);
    let mut certificate = searched.certificate.clone();
    if let Some(evidence) = &account.evidence {
        certificate.trust_survey(evidence);
    }
    let said = options.visits.same.len() + options.visits.different.len();
    if said > 0 {
        certificate.trust_said(said);
    }
    let mut answer = Answer {
        format: Answer::FORMAT.to_owned(),
        version: Answer::VERSION,
        verdict: Verdict::of(&account, &searched.summary, &certificate),
        input: account,
        search: searched.summary.clone(),
        certificate,
        visits: records(input, considered, maps.first()),
        building: None,
        maps,
        readings: None,
        warnings,
    };
    let building = match (&input.surveyed, placed.first().and_then(|map| map.scan_poses(input))) {
        (Some(surveyed), Some(poses)) => {
            Building::new(surveyed, &poses).map_err(|problem| building::warn(&mut answer, &problem)).ok()
        }
        _ => None,
    };
    if let (Some(building), Some(surveyed)) = (&building, &input.surveyed) {
        building.tell(surveyed, &mut answer);
    }
    Mapped { answer, searched, placed, building, corrected: None }
}

/// The maps of the ranking, placed where measured travels allow it.
fn told(
    input: &Input,
    searched: &Searched,
    exploration: &Exploration,
    warnings: &mut Vec<AnswerWarning>,
) -> (Vec<AnsweredMap>, Vec<PlacedMap>) {
    let (mut maps, mut placed) = (Vec::new(), Vec::new());
    let approaches = input.surveyed.as_ref().map(|surveyed| driven::Approaches::new(&surveyed.survey));
    let approaches = approaches.as_ref();
    let mut first: Option<Telling> = None;
    for (index, found) in searched.ranking().iter().enumerate() {
        let rank = index + 1;
        let Some(telling) = searched.telling(found) else { break };
        let graph = searched.pose_graph(rank, &telling.positions, exploration).unwrap_or_else(|problem| {
            let spot = Spot::Map(rank as u64);
            AnswerWarning::record(warnings, WarningKind::NoPoses, spot, || problem.to_string());
            None
        });
        let mut map =
            Assembly { input, found, telling: &telling, graph: graph.as_ref(), approaches }.map(rank);
        map.difference = first.as_ref().and_then(|first| searched.difference(first, &telling));
        // Of several maps that are equally good, the first is not the one to be judged.
        if let (1, Some(graph), 1) = (rank, &graph, searched.summary.found.tied) {
            tell_improbable(graph, exploration, warnings);
        }
        maps.push(map);
        placed.push(PlacedMap { positions: telling.positions.clone(), graph });
        first.get_or_insert(telling);
    }
    (maps, placed)
}

/// Warns of measured travels that the best map bends by more than their covariances can explain.
fn tell_improbable(graph: &PoseGraph, exploration: &Exploration, warnings: &mut Vec<AnswerWarning>) {
    /// Three numbers that err as they should have a larger χ² once in a million times.
    const IMPROBABLE: f64 = 30.66;
    let measured = exploration.travels().iter().enumerate().filter(|(_, travel)| travel.odometry.is_some());
    for ((travel, _), edge) in measured.zip(graph.edges()) {
        let chi2 = edge.chi2(graph.pose(edge.from), graph.pose(edge.to));
        if chi2 > IMPROBABLE {
            let (from, to) = (travel, travel + 1);
            AnswerWarning::record(
                warnings,
                WarningKind::ImprobableTravel,
                Spot::Visit(travel as u64 + 1),
                || {
                    format!(
                        "the best map bends the travel from visit {from} to visit {to} by χ² = {chi2:.0}, which its \
                     covariance explains less than once in a million times: a star, a travel or the map is wrong"
                    )
                },
            );
        }
    }
}

/// As many threads as are of use.
fn useful_threads(asked: usize, warnings: &mut Vec<AnswerWarning>) -> usize {
    let most = THREADS_PER_CORE * available_parallelism().map_or(1, usize::from);
    if asked > most {
        let sentence =
            format!("{asked} threads are more than are of use on this machine: {most} are started");
        warnings.push(AnswerWarning::once(WarningKind::FewerThreads, sentence));
    }
    asked.min(most)
}

impl MappingOptions {
    /// The method for an exploration: what was chosen, or what its measurements allow.
    pub(crate) fn method_for(&self, exploration: &Exploration) -> Result<SearchMethod, PipelineError> {
        let is_measured = || exploration.travels().iter().all(|travel| travel.odometry.is_some());
        let usual = if exploration.travels().is_empty() || self.search.genus.is_some() || !is_measured() {
            SearchMethod::BreadthFirst
        } else {
            SearchMethod::Posterior
        };
        match self.search.method.unwrap_or(usual) {
            SearchMethod::BreadthFirst | SearchMethod::Count | SearchMethod::PosteriorBreadthFirst
                if self.search.closed =>
            {
                Err(PipelineError::ClosedOfAll)
            }
            SearchMethod::Posterior
            | SearchMethod::PosteriorBestFirst
            | SearchMethod::PosteriorBreadthFirst
            | SearchMethod::PosteriorProof
                if self.search.genus.is_some() =>
            {
                Err(PipelineError::GenusOfPosterior)
            }
            SearchMethod::Count if self.visits != VisitChoice::default() => Err(PipelineError::CountedVisits),
            method => Ok(method),
        }
    }
}

impl MappingOptions {
    /// What they are for the exploration as it must have been, by an account of what was misread.
    fn given(&self, account: &ReadingAccount) -> Self {
        // What is said of visits that are taken for none is true of no place.
        let number = |told: usize| account.visits.iter().find(|[other, _]| *other == told as u64);
        let number = |told: usize| number(told).map(|&[_, visit]| visit as usize);
        MappingOptions {
            visits: self.visits.renumbered(number),
            readings: ReadingChoice::default(),
            limits: SearchLimits { travels: None, ..self.limits },
            ..self.clone()
        }
    }
}

impl SurveyedLog {
    /// What the laser says of visits: where it shows that the robot was back, another place is improbable; and how much alike
    /// the local maps of all pairs of visits are, times a weight (section 2.4).
    fn likeness(&self, weight: f64) -> Likeness {
        let visits = &self.survey.visits;
        let degrees: Vec<u32> = visits.iter().map(|visit| visit.star.star.degree()).collect();
        let is_return: Vec<bool> = (0..visits.len()).map(|visit| self.survey.shows_return(visit)).collect();
        let shown = -PerceptionModel::default().wrong_return.ln();
        Likeness::new(&degrees, |later, earlier, rotation| {
            let (first, second) = (&visits[earlier], &visits[later]);
            // Visits to one spot show one star, turned as the track is.
            let is_shown = is_return[later] && first.spot == second.spot && rotation == 0;
            let returned = if is_shown { shown } else { 0.0 };
            if weight == 0.0 {
                return returned;
            }
            let mut isomorphisms = Isomorphism::all(&second.star.star, &first.star.star);
            let phi = isomorphisms.find(|phi| phi.rotation() == rotation);
            let found = phi.and_then(|phi| resemblance(first, second, phi));
            returned + found.map_or(0.0, |found| weight * found.log_likelihood_ratio)
        })
    }
}

impl Mapped {
    /// The pose graph of a map of the ranking, the best being 1: a pose for each place, in the frame of the first, and an
    /// edge for each measured travel. `None` if travels were not measured.
    #[must_use]
    pub fn pose_graph(&self, rank: usize) -> Option<&PoseGraph> {
        self.placed(rank)?.graph.as_ref()
    }

    /// What the proof rests on, as text that another program can check: docs/certificate.md. `None` if nothing is
    /// proved.
    #[must_use]
    pub fn certificate(&self, input: &Input) -> Option<String> {
        let travels = self.answer.input.explained as usize;
        self.searched.certificate_text(&self.exploration(input).prefix(travels))
    }

    /// What the maps are of: the input's exploration, or that as it must have been.
    #[must_use]
    pub fn exploration<'a>(&'a self, input: &'a Input) -> &'a Exploration {
        self.corrected.as_ref().unwrap_or(&input.exploration)
    }

    /// The exploration as it must have been, if errors of perception were reckoned with: what the maps are of.
    #[must_use]
    pub fn corrected(&self) -> Option<&Exploration> {
        self.corrected.as_ref()
    }

    /// The answer, and the mapper to go on with.
    pub(crate) fn into_answer_and_mapper(self) -> (Answer, Option<Box<Mapper>>) {
        (self.answer, self.searched.into_mapper())
    }

    /// The maps are those of an account of what was misread: no more probable than that.
    fn rest_on(&mut self, account: ReadingAccount, warnings: Vec<AnswerWarning>) {
        for map in &mut self.answer.maps {
            map.probability = map.probability.map(|[_, most]| [0.0, most * account.at_most]);
            map.optimal &= account.proved;
        }
        self.answer.certificate.trust_readings(&account);
        self.answer.verdict.rest_on(&account);
        self.answer.warnings.splice(0..0, warnings);
        self.answer.readings = Some(account);
    }

    /// The tree that was searched, with the best maps framed; maps are taken along up to `most_maps` nodes. `None` if it was
    /// only counted.
    #[must_use]
    pub fn tree(&self, most_maps: usize) -> Option<SearchTree> {
        self.searched.tree(most_maps)
    }

    /// Tells the exploration again, travel by travel, to the on-line search, and asks it after each for the best map. It goes by the
    /// options of the answer, but knows nothing that comes later: new places lie where corridors as long as those so far lead. Maps need
    /// not be closed on the way. Visits and stars are those of the answer; along a log, of its whole survey. The search is given
    /// up beyond `most_nodes` hypotheses.
    ///
    /// # Errors
    /// If the search cannot begin; then there would be no answer either.
    pub fn history(
        &self,
        input: &Input,
        options: &MappingOptions,
        most_nodes: u64,
        monitor: &Arc<Monitor>,
    ) -> Result<History, PipelineError> {
        let considered = self.answer.input.considered as usize;
        let (exploration, options) = match (&self.corrected, &self.answer.readings) {
            (Some(corrected), Some(account)) => (corrected.clone(), options.given(account)),
            _ => (input.exploration.prefix(considered), options.clone()),
        };
        let method = options.method_for(&exploration)?;
        let surveyed = input.surveyed.as_ref();
        let likeness = surveyed.map(|surveyed| surveyed.likeness(options.posterior.likeness));
        let (exploration, options) = (&exploration, &options);
        let (is_online, means) = (true, &Means::default());
        let task = Task { exploration, options, method, likeness, monitor, is_online, means };
        let mut history = task.history(most_nodes)?;
        // As in the answer, what the places of a log rest on is a factor.
        let evidence = surveyed.map_or(1.0, |surveyed| surveyed.evidence().probability);
        for belief in &mut history.beliefs {
            belief.probability = belief.probability.map(|range| range.map(|part| part * evidence));
        }
        Ok(history)
    }

    /// All hypotheses that the search made. `None` if they were only counted.
    #[must_use]
    pub fn hypotheses(&self) -> Option<&Tree> {
        self.searched.hypotheses()
    }

    /// Where every scan of the log was taken, in the frame of the first place of a map. `None` without a log, without
    /// such a map, or if the map's places are not placed.
    #[must_use]
    pub fn scan_poses(&self, input: &Input, rank: usize) -> Option<Vec<Pose>> {
        self.placed(rank)?.scan_poses(input)
    }

    /// Where every laser scan of the log was taken and when, those that cannot be used among them: they have the pose
    /// of the scan before. In the frame of the first place of a map; if it has no poses, in that of the first scan. The
    /// time is that of the log, or the number of the scan. `None` without a log.
    #[must_use]
    pub fn trajectory(&self, input: &Input, rank: usize) -> Option<Vec<(f64, Pose)>> {
        let surveyed = input.surveyed.as_ref()?;
        let tracked = || surveyed.survey.track.scans.iter().map(|scan| scan.pose).collect();
        let poses = self.scan_poses(input, rank).unwrap_or_else(tracked);
        Some(scans::timed(&surveyed.log, &poses))
    }

    /// Puts the trajectory into each map of the answer: when every scan of the log was taken and where. Nothing without a log.
    pub fn carry_trajectories(&mut self, input: &Input) {
        for rank in 1..=self.answer.maps.len() {
            let trajectory = self.trajectory(input, rank).unwrap_or_default();
            self.answer.maps[rank - 1].trajectory =
                trajectory.iter().map(|&(time, pose)| [time, pose.x, pose.y, pose.theta]).collect();
        }
    }

    /// All scans of the log in one pose graph, in the frame of the first place of a map: the tracked steps, and what the laser
    /// shows of the ways that the robot came back to. If the map has visits at another place than the laser shows, the matches
    /// that contradict it are left out, and an edge for each visit says at which place it has it. `None` without a log, or
    /// without such a map.
    #[must_use]
    pub fn scan_graph(&self, input: &Input, rank: usize) -> Option<PoseGraph> {
        let SurveyedLog { survey, .. } = input.surveyed.as_ref()?;
        let poses = self.scan_poses(input, rank)?;
        let PlacedMap { positions, .. } = self.placed(rank)?;
        Some(if survey.agrees_with(positions) {
            survey.placed_graph(poses)
        } else {
            survey.bent_graph(poses, positions)
        })
    }

    /// The grid map of the whole building, all scans in the frame of the first place of a map.
    ///
    /// # Errors
    /// If there are no scans, no such map, or the grid would be too large.
    pub fn building(&self, input: &Input, rank: usize) -> Result<OccupancyGrid, PipelineError> {
        if let (1, Some(building)) = (rank, &self.building) {
            return Ok(building.grid().clone());
        }
        let poses = self.scan_poses(input, rank);
        let (surveyed, poses) = input.surveyed.as_ref().zip(poses).ok_or(PipelineError::NoScans)?;
        Ok(building_map(&surveyed.log, &poses)?)
    }

    fn placed(&self, rank: usize) -> Option<&PlacedMap> {
        self.placed.get(rank.checked_sub(1)?)
    }
}
