//! All explanations of an exploration, travel by travel.

use hssh_causal::Exploration;

use super::chart::Chart;
use super::merge::Sight;
use super::model::ReadingModel;
use super::travel::Travelling;
use super::way::Here;
use crate::axiom::Rules;

/// One sequence of ways, from the first visit through all travels.
#[derive(Clone, PartialEq, Debug)]
pub struct ReadHypothesis {
    /// The sum of all prices, in nats.
    pub cost: f64,
    /// By visit, the start first: the number of the visit on which its place was first reported; `None` for a false
    /// visit.
    pub visits: Vec<Option<usize>>,
    /// How many places there are, also those never reported.
    pub places: usize,
    /// How many links there are.
    pub links: usize,
    /// How many open ends have no link.
    pub pending: usize,
}

/// What explains the travels so far.
struct Account {
    chart: Chart,
    here: Here,
    cost: f64,
    /// By visit: its place.
    visits: Vec<Option<usize>>,
}

/// All explanations of an exploration, by cost and visits. Odometry is not looked at.
#[must_use]
pub fn enumerate_readings(
    exploration: &Exploration,
    rules: &Rules,
    model: &ReadingModel,
) -> Vec<ReadHypothesis> {
    let travels = exploration.travels();
    let mut accounts = vec![Account::first(exploration)];
    for (index, travel) in travels.iter().enumerate() {
        let came_in_by = index.checked_sub(1).map(|before| travels[before].entry);
        let turned = came_in_by == Some(travel.exit);
        let sight = Sight { star: exploration.star(travel.star), entry: travel.entry.index() };
        let travelling = Travelling { model, sight };
        accounts = accounts
            .iter()
            .flat_map(|account| account.successors(travelling, travel.exit.index(), turned))
            .filter(|account| account.chart.obeys(rules))
            .collect();
    }
    let mut hypotheses: Vec<ReadHypothesis> = accounts.iter().map(Account::hypothesis).collect();
    hypotheses.sort_by(|a, b| a.cost.total_cmp(&b.cost).then_with(|| a.visits.cmp(&b.visits)));
    hypotheses
}

impl Account {
    fn first(exploration: &Exploration) -> Self {
        let mut chart = Chart::default();
        let place = chart.add_visited_place(exploration.star(exploration.start()));
        let image = (0..chart.ends.len()).map(|end| chart.ends[end].open.then_some(end)).collect();
        Account { chart, here: Here::At { place, image }, cost: 0.0, visits: vec![Some(place)] }
    }

    /// What explains one more travel; `turned` says that it leaves a star by the end by which it came in.
    fn successors(&self, travelling: Travelling, exit: usize, turned: bool) -> Vec<Self> {
        let ways = match &self.here {
            Here::At { image, .. } => {
                travelling.leave(&self.chart, image[exit].expect("the robot leaves by an open end"))
            }
            Here::Underway { exit } if turned => travelling.back(&self.chart, *exit),
            Here::Underway { exit } => travelling.leave(&self.chart, *exit),
        };
        ways.into_iter()
            .filter(|(way, _)| way.price <= travelling.model.limit && way.price.is_finite())
            .map(|(way, here)| {
                let visit = match here {
                    Here::At { place, .. } => Some(place),
                    Here::Underway { .. } => None,
                };
                let visits = [self.visits.as_slice(), &[visit]].concat();
                Account { chart: way.chart, here, cost: self.cost + way.price, visits }
            })
            .collect()
    }

    fn hypothesis(&self) -> ReadHypothesis {
        let first_visit = |place: &usize| {
            self.visits.iter().position(|visit| visit.as_ref() == Some(place)).expect("it was visited")
        };
        ReadHypothesis {
            cost: self.cost,
            visits: self.visits.iter().map(|visit| visit.as_ref().map(first_visit)).collect(),
            places: self.chart.places.len(),
            links: self.chart.links.len(),
            pending: self.chart.pending().len(),
        }
    }
}
