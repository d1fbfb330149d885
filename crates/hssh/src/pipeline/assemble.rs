//! An answer put together from what a search found: places, links, paths, visits and poses of each map.

use std::collections::BTreeMap;

use hssh_causal::Exploration;
use hssh_local::{Visit, visit_frames};
use hssh_metrics::{Marginals, Pose, PoseGraph};
use hssh_topology::{MapOlp, Measure, Olp, PlaceId, Position, TopologicalMap};

use super::driven::{Approaches, Drives, length};
use super::engine::{FoundMap, Telling, measured};
use super::input::{Input, SurveyedLog};
use crate::answer::{
    AnsweredEnd, AnsweredLink, AnsweredMap, AnsweredPath, AnsweredPlace, AnsweredVisit, CurrentPosition,
    EndReference, EndState, Finding, PlacedPose, VisitRecord,
};

/// A map as it was found, and what it is an explanation of.
pub(super) struct Assembly<'a> {
    pub(super) input: &'a Input,
    pub(super) found: &'a FoundMap,
    pub(super) telling: &'a Telling,
    pub(super) graph: Option<&'a PoseGraph>,
    /// Of a log.
    pub(super) approaches: Option<&'a Approaches>,
}

impl Assembly<'_> {
    /// The map of that rank.
    pub(super) fn map(&self, rank: usize) -> AnsweredMap {
        let Telling { hypothesis, positions } = self.telling;
        let map = &hypothesis.map;
        let (visits, links) = self.visits();
        AnsweredMap {
            rank: rank as u64,
            branch: self.found.branch.clone(),
            optimal: self.found.optimal,
            tied: self.found.tied,
            probability: self.probability(),
            costs: self.found.costs.clone(),
            measure: measured(Measure::of(map)),
            closed: map.is_closed(),
            nearly_closed: map.is_nearly_closed(),
            places: self.places(),
            links,
            paths: self.paths(),
            visits,
            trajectory: Vec::new(),
            current: CurrentPosition {
                place: hypothesis.position.place.number(),
                rotation: positions.last().map_or(0, |position| position.phi.rotation()),
            },
            difference: None,
        }
    }

    /// Its probability: that of the search, and that what a log's places rest on does not mislead.
    fn probability(&self) -> Option<[f64; 2]> {
        let evidence = self.input.surveyed.as_ref().map_or(1.0, |surveyed| surveyed.evidence().probability);
        self.found.probability.map(|range| range.map(|probability| probability * evidence))
    }

    fn exploration(&self) -> &Exploration {
        &self.input.exploration
    }

    fn map_itself(&self) -> &TopologicalMap {
        &self.telling.hypothesis.map
    }

    fn end(&self, olp: MapOlp) -> EndReference {
        let map = self.map_itself();
        let place = map.place(olp);
        let star = &self.exploration().star_types()[map.star(place).index()].star;
        EndReference { place: place.number(), end: star.name(map.local(olp)).to_string() }
    }

    fn places(&self) -> Vec<AnsweredPlace> {
        let map = self.map_itself();
        let marginals = self.graph.and_then(|graph| Marginals::new(graph).ok());
        let covariances = marginals.map(|marginals| marginals.covariances());
        let pose = |index: usize| {
            let pose = *self.graph?.poses().get(index)?;
            let covariance = covariances.as_ref().map(|covariances| {
                let covariance = covariances[index];
                [0, 1, 2].map(|row| [0, 1, 2].map(|column| covariance[(row, column)]))
            });
            placed(pose, covariance)
        };
        let place = |(index, place)| {
            let named = &self.exploration().star_types()[map.star(place).index()];
            let first_visit = self.first_visit(place);
            let end = |olp: MapOlp| {
                let local = map.local(olp);
                let leads_to = map.linked(olp).map(|other| self.end(other));
                AnsweredEnd {
                    name: named.star.name(local).to_string(),
                    state: match leads_to {
                        Some(_) => EndState::Linked,
                        None if map.is_pending(olp) => EndState::Pending,
                        None => EndState::Closed,
                    },
                    label: named.star.ends()[local.index()].label.clone(),
                    bearing: named.bearings[local.index()],
                    leads_to,
                    gateway: first_visit.and_then(|visit| gateway(visit, local)),
                }
            };
            AnsweredPlace {
                star: named.name.clone(),
                ends: map.olps_of(place).map(end).collect(),
                pose: pose(index),
                region: None,
            }
        };
        map.places().enumerate().map(place).collect()
    }

    /// The first visit to a place, of a log whose places have poses.
    fn first_visit(&self, place: PlaceId) -> Option<&Visit> {
        let SurveyedLog { survey, .. } = self.input.surveyed.as_ref().filter(|_| self.graph.is_some())?;
        let visit = self.telling.positions.iter().position(|position| position.place == place)?;
        survey.visits.get(visit)
    }

    fn paths(&self) -> Vec<AnsweredPath> {
        let map = self.map_itself();
        let courses = map.courses().into_iter();
        let path = |course: hssh_topology::Course| AnsweredPath {
            places: course.downstream.iter().map(|&olp| map.place(olp).number()).collect(),
            ahead: course.downstream.iter().map(|&olp| self.end(olp).end).collect(),
            circular: course.circular,
        };
        courses.map(path).collect()
    }

    /// The visits, and the links in the order in which they were travelled first.
    fn visits(&self) -> (Vec<AnsweredVisit>, Vec<AnsweredLink>) {
        let (map, positions) = (self.map_itself(), &self.telling.positions);
        let mut robots = self.robots().into_iter();
        let mut links: Vec<AnsweredLink> = Vec::new();
        let mut used: BTreeMap<MapOlp, MapOlp> = BTreeMap::new();
        let mut places_seen = 0;
        let mut visits: Vec<AnsweredVisit> = Vec::with_capacity(positions.len());
        for (index, position) in positions.iter().enumerate() {
            let before = index.checked_sub(1);
            let travel = before.map(|before| &self.exploration().travels()[before]);
            let exit = before.zip(travel).map(|(before, travel)| olp(map, &positions[before], travel.exit));
            let entry = travel.map(|travel| olp(map, position, travel.entry));
            let is_new_place = position.place.index() == places_seen;
            places_seen += usize::from(is_new_place);
            let mut finding = if is_new_place { Finding::NewPlace } else { Finding::Closure };
            match exit.zip(entry) {
                None => finding = Finding::Start,
                Some((exit, entry)) if used.get(&exit) == Some(&entry) => finding = Finding::Predicted,
                Some((exit, entry)) => {
                    used.extend([(exit, entry), (entry, exit)]);
                    links.push(AnsweredLink { from: self.end(exit), to: self.end(entry), way: Vec::new() });
                }
            }
            if let (Some(last), Some(exit)) = (visits.last_mut(), exit) {
                last.exit = Some(self.end(exit).end);
            }
            visits.push(AnsweredVisit {
                place: position.place.number(),
                rotation: position.phi.rotation(),
                finding,
                entry: entry.map(|entry| self.end(entry).end),
                exit: None,
                robot: robots.next().and_then(|pose| placed(pose, None)),
            });
        }
        self.add_ways(&visits, &mut links);
        (visits, links)
    }

    /// Gives each link of a log's map the shortest line of the travels along it, which may be of either direction.
    fn add_ways(&self, visits: &[AnsweredVisit], links: &mut [AnsweredLink]) {
        let log = self.input.surveyed.as_ref().zip(self.approaches).zip(self.graph);
        let Some(((SurveyedLog { survey, .. }, approaches), graph)) = log else { return };
        let Some(drives) = Drives::new(survey, approaches, &self.telling.positions, graph) else { return };
        for (visit, pair) in visits.windows(2).enumerate() {
            let end = |visit: &AnsweredVisit, end: &Option<String>| {
                Some(EndReference { place: visit.place, end: end.clone()? })
            };
            let ends = end(&pair[0], &pair[0].exit).zip(end(&pair[1], &pair[1].entry));
            let Some((exit, entry)) = ends else { continue };
            let is_along = |link: &&mut AnsweredLink| {
                (&link.from, &link.to) == (&exit, &entry) || (&link.from, &link.to) == (&entry, &exit)
            };
            let Some(link) = links.iter_mut().find(is_along) else { continue };
            let mut line = drives.line(visit);
            if link.from != exit {
                line.reverse();
            }
            if link.way.is_empty() || length(&line) < length(&link.way) {
                link.way = line;
            }
        }
    }

    /// Where the robot was at the scan nearest to each visit's place; nothing without a log or poses.
    fn robots(&self) -> Vec<Pose> {
        let (Some(SurveyedLog { survey, .. }), Some(graph)) = (&self.input.surveyed, self.graph) else {
            return Vec::new();
        };
        let frames = visit_frames(&survey.visits, &self.telling.positions, graph.poses());
        let robot = |(frame, visit): (&Pose, &Visit)| {
            frame.compose(visit.frame.between(survey.track.scans[visit.reference].pose))
        };
        frames.iter().zip(&survey.visits).map(robot).collect()
    }
}

/// The line across an end's way out, in the frame of the place.
fn gateway(visit: &Visit, end: Olp) -> Option<[[f64; 2]; 2]> {
    let line = visit.star.gateways.get(end.index())?.as_ref()?.line;
    let seen = |[x, y]: [f64; 2]| visit.frame.between(Pose::new(x, y, 0.0));
    let ends = line.map(seen).map(|pose| [pose.x, pose.y]);
    ends.iter().flatten().all(|number| number.is_finite()).then_some(ends)
}

/// An end of the star seen on a visit, as an end of the map.
fn olp(map: &TopologicalMap, position: &Position, seen: Olp) -> MapOlp {
    map.olp(position.place, position.phi.apply(seen))
}

/// A pose whose numbers are all finite.
fn placed(pose: Pose, covariance: Option<[[f64; 3]; 3]>) -> Option<PlacedPose> {
    let covariance = covariance.filter(|rows| rows.iter().flatten().all(|number| number.is_finite()));
    pose.is_finite().then_some(PlacedPose { x: pose.x, y: pose.y, theta: pose.theta, covariance })
}

/// What the robot met on the visits of the travels considered.
pub(super) fn records(input: &Input, considered: usize, best: Option<&AnsweredMap>) -> Vec<VisitRecord> {
    let record = |(index, star): (usize, hssh_causal::StarType)| {
        let surveyed = input.surveyed.as_ref();
        let visit = surveyed.and_then(|surveyed| Some((surveyed, surveyed.survey.visits.get(index)?)));
        VisitRecord {
            star: input.exploration.star_types()[star.index()].name.clone(),
            place: best.and_then(|map| Some(map.visits.get(index)?.place)),
            scan: visit.map(|(surveyed, visit)| surveyed.scan_number(visit.reference)),
            scans: visit.map(|(surveyed, visit)| {
                let (first, last) = visit.scans;
                [first, last].map(|scan| surveyed.scan_number(scan))
            }),
            region: None,
            times: visit.and_then(|(surveyed, visit)| {
                let time = |scan: usize| surveyed.log.scans[scan].time;
                Some([time(visit.scans.0)?, time(visit.scans.1)?])
            }),
        }
    };
    input.exploration.visits().take(considered + 1).enumerate().map(record).collect()
}
