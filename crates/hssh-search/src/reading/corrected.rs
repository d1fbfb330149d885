//! The exploration as it must have been, if an account is right: every visit to every place, each with the place's whole star.

use hssh_causal::{Exploration, ExplorationError, NamedStar, Odometry, StarType, Travel, check_bearings};
use hssh_metrics::Pose;
use hssh_topology::{Account, Arrival, ChartEnd, Element, Olp, PlaceId, Sight};

use crate::reading::reader::ReadMap;
use crate::reading::state::Passage;

/// What an account takes for an error of perception. Visits are counted from 0, the start.
#[derive(Clone, PartialEq, Debug)]
pub enum Correction {
    /// Ends of the place were not seen on a visit.
    Missed {
        /// The visit.
        visit: usize,
        /// The place.
        place: PlaceId,
        /// The ends.
        ends: Vec<ChartEnd>,
    },
    /// Ends were seen that no visit to the place had shown before.
    New {
        /// The visit.
        visit: usize,
        /// The place.
        place: PlaceId,
        /// The ends.
        ends: Vec<ChartEnd>,
    },
    /// A place was passed without a report on the travel to a visit.
    Passed {
        /// The visit.
        visit: usize,
        /// The place.
        place: PlaceId,
    },
    /// The report of a visit is of no place.
    False {
        /// The visit.
        visit: usize,
    },
    /// On the travel to a visit the robot turned, and came back to where it was.
    TurnedBack {
        /// The visit.
        visit: usize,
        /// The place.
        place: PlaceId,
    },
}

/// An exploration that needs no readings.
#[derive(Clone, Debug)]
pub struct Corrected {
    /// Every place that was visited or passed, in order, each with the star of the account.
    pub exploration: Exploration,
    /// By visit of it: the visit of the exploration as told, counted from 0; `None` if the place was passed unreported.
    pub told: Vec<Option<usize>>,
    /// By visit of it: the place.
    pub places: Vec<PlaceId>,
}

/// The standard deviations of ways that were not measured by themselves: m, m, rad.
const UNMEASURED: [f64; 3] = [0.5, 0.5, 0.2];

/// One visit after another, as they are put together.
struct Course {
    travels: Vec<Travel>,
    told: Vec<Option<usize>>,
    places: Vec<PlaceId>,
}

impl ReadMap {
    /// What the account takes for errors, in the order of the visits.
    ///
    /// # Panics
    /// If the exploration is not the one that was read.
    #[must_use]
    pub fn corrections(&self, exploration: &Exploration) -> Vec<Correction> {
        let mut corrections = Vec::new();
        let mut account = Account::begin(exploration.star(exploration.start()));
        for (index, (travel, passage)) in exploration.travels().iter().zip(&self.passages).enumerate() {
            let visit = index + 1;
            let passed = account.passed(travel.exit, &passage.way);
            let place_of = |end: ChartEnd| self.chart.end(end).place;
            corrections.extend(
                passed.iter().map(|&[enter, _]| Correction::Passed { visit, place: place_of(enter) }),
            );
            match &passage.way.arrival {
                Arrival::False => corrections.push(Correction::False { visit }),
                Arrival::TurnedBack(reading) => {
                    corrections.push(Correction::TurnedBack { visit, place: reading.place });
                }
                _ => {}
            }
            if let Some(reading) = passage.way.arrival.reading() {
                let place = reading.place;
                let missed = |element: &Element| match *element {
                    Element::Missed(end) => Some(end),
                    _ => None,
                };
                let new = |element: &Element| match *element {
                    Element::New(olp) => passage.seen[olp.index()],
                    _ => None,
                };
                let missed: Vec<ChartEnd> = reading.merged.iter().filter_map(missed).collect();
                let new: Vec<ChartEnd> = reading.merged.iter().filter_map(new).collect();
                if !missed.is_empty() {
                    corrections.push(Correction::Missed { visit, place, ends: missed });
                }
                if !new.is_empty() {
                    corrections.push(Correction::New { visit, place, ends: new });
                }
            }
            let sight = Sight { star: exploration.star(travel.star), entry: travel.entry };
            account = account.follow(travel.exit, sight, &passage.way);
        }
        corrections
    }

    /// The exploration as it must have been. Visits that were none are left out, and so are those after which the robot had only turned
    /// back; places passed unreported are visited. Ways that were not measured by themselves are what the layout says.
    ///
    /// # Errors
    /// Never, if the exploration is the one that was read.
    pub fn corrected(&self, exploration: &Exploration) -> Result<Corrected, ExplorationError> {
        let stars: Vec<NamedStar> = self.chart.places().map(|place| self.named_star(place)).collect();
        let mut course = Course { travels: Vec::new(), told: vec![Some(0)], places: vec![PlaceId::new(0)] };
        let mut account = Account::begin(exploration.star(exploration.start()));
        for (index, (travel, passage)) in exploration.travels().iter().zip(&self.passages).enumerate() {
            let passed = account.passed(travel.exit, &passage.way);
            if let Some(place) = passage.place
                && !matches!(passage.way.arrival, Arrival::TurnedBack(_))
            {
                self.go(&mut course, passage, &passed, travel.entry);
                course.told.push(Some(index + 1));
                course.places.push(place);
            }
            let sight = Sight { star: exploration.star(travel.star), entry: travel.entry };
            account = account.follow(travel.exit, sight, &passage.way);
        }
        let Course { travels, told, places } = course;
        let exploration = Exploration::new(stars, StarType(0), travels)?;
        Ok(Corrected { exploration, told, places })
    }

    /// The star of a place, with bearings as far as they agree with the clockwise order: those of ends that were first seen later need not.
    fn named_star(&self, place: PlaceId) -> NamedStar {
        let ends = self.chart.ends_of(place);
        let (name, star) = (format!("P{place}"), self.chart.star(place));
        let bearings: Vec<Option<f64>> = ends.iter().map(|end| self.bearings[end.index()]).collect();
        let bearings = match check_bearings(&star, &bearings) {
            Ok(()) => bearings,
            Err(_) => vec![None; ends.len()],
        };
        NamedStar { name, star, bearings }
    }

    /// The travels from one reported place to the next: through those that were passed, and those found on the way later.
    fn go(&self, course: &mut Course, passage: &Passage, passed: &[[ChartEnd; 2]], entry: Olp) {
        let before = course.travels.len();
        let last = passage.seen[entry.index()].expect("the entry is open");
        let mut exit = passage.exit;
        let stops = passed.iter().map(|&[enter, leave]| (enter, Some(leave))).chain([(last, None)]);
        for (enter, leave) in stops {
            let mut reached = self.chart.end(exit).link.expect("it was gone along");
            while reached != enter {
                let Some(onward) = self.chart.through(reached) else { break };
                self.visit(course, exit, reached, true);
                exit = onward;
                reached = self.chart.end(exit).link.expect("it was gone along");
            }
            self.visit(course, exit, enter, leave.is_some());
            exit = leave.unwrap_or(exit);
        }
        if let [only] = &mut course.travels[before..] {
            only.odometry = passage.measured.or(only.odometry);
        }
    }

    fn visit(&self, course: &mut Course, exit: ChartEnd, entry: ChartEnd, unreported: bool) {
        let [from, to] = [exit, entry].map(|end| self.chart.end(end).place);
        course.travels.push(Travel {
            exit: self.olp(exit),
            entry: self.olp(entry),
            star: StarType(to.number()),
            odometry: self.way_between(from, to),
        });
        if unreported {
            course.told.push(None);
            course.places.push(to);
        }
    }

    fn olp(&self, end: ChartEnd) -> Olp {
        let ends = self.chart.ends_of(self.chart.end(end).place);
        Olp::new(ends.iter().position(|&other| other == end).unwrap_or(0) as u32)
    }

    /// Where the layout has one place in the frame of another, if it has both.
    fn way_between(&self, from: PlaceId, to: PlaceId) -> Option<Odometry> {
        let pose = |place: PlaceId| self.poses[place.index()];
        let Pose { x, y, theta } = pose(from)?.between(pose(to)?);
        let [sx, sy, st] = UNMEASURED.map(|deviation| deviation * deviation);
        let covariance = [[sx, 0.0, 0.0], [0.0, sy, 0.0], [0.0, 0.0, st]];
        Some(Odometry { x, y, theta, covariance })
    }
}
