//! From an experiment's world and route to what the robot experienced, and where it truly was.

use std::error::Error;
use std::fs;
use std::path::Path;

use hssh_causal::Exploration;
use hssh_world::{
    PlaceId, Route, World, cover, graphml, grid, momepy, random_planar, random_walk, snake, thesis_3x4,
};

use crate::experiment::schema::{RouteSource, WorldSource};
use crate::root;

/// Metres between the places of simulated worlds; topology does not see them.
const SPACING: f64 = 8.0;

/// An exploration and the places truly visited in it, by number, if they are known.
pub(crate) struct Case {
    /// What the robot wrote down.
    pub(crate) exploration: Exploration,
    /// Where it was, the start first.
    pub(crate) visits: Option<Vec<usize>>,
}

/// Why there is no case.
pub(crate) enum Missing {
    /// It takes a file of the data folder, which is not there.
    Data(String),
    /// Something is wrong.
    Error(Box<dyn Error>),
}

impl<E: Into<Box<dyn Error>>> From<E> for Missing {
    fn from(error: E) -> Self {
        Missing::Error(error.into())
    }
}

/// Sends the robot through the world.
pub(crate) fn case(
    world: &WorldSource,
    route: Option<&RouteSource>,
    data: Option<&Path>,
) -> Result<Case, Missing> {
    let built = match world {
        WorldSource::Exploration { file, visits } => {
            let path = root::fixtures().join(file);
            let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            let exploration = Exploration::from_ron(&text).map_err(|error| error.render(file, &text))?;
            let visits = visits.as_deref().map(numbered);
            if visits.as_ref().is_some_and(|visits| visits.len() != exploration.travels().len() + 1) {
                return Err(Missing::from("one visit has to be named for the start and one for each travel"));
            }
            return Ok(Case { exploration, visits });
        }
        WorldSource::Grid { rows, columns } => grid(*rows, *columns, SPACING)?,
        WorldSource::RandomPlanar { places, density, seed } => {
            random_planar(*places, *density, SPACING, *seed)?
        }
        WorldSource::Streets { file } => streets(file, data)?,
    };
    let route = route.ok_or("a world needs a route: add `route: …` to the run")?;
    let route = through(&built, world, route)?;
    let visits = built.visits(&route)?.into_iter().map(PlaceId::index).collect();
    Ok(Case { exploration: built.explore(&route)?, visits: Some(visits) })
}

fn streets(file: &str, data: Option<&Path>) -> Result<World, Missing> {
    let path = data.map(|data| data.join(file)).filter(|path| path.is_file());
    let path = path.ok_or_else(|| Missing::Data(file.to_owned()))?;
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let is_graphml = path.extension().is_some_and(|extension| extension == "graphml");
    let network = if is_graphml { graphml::read(&text) } else { momepy::read(&text) };
    let network = network.map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(network.to_world()?)
}

fn through(world: &World, source: &WorldSource, route: &RouteSource) -> Result<Route, Box<dyn Error>> {
    match (route, source) {
        (RouteSource::Snake, WorldSource::Grid { rows, columns }) => {
            Ok(world.route_through(&snake(*rows, *columns))?)
        }
        (RouteSource::Thesis3x4, WorldSource::Grid { rows: 3, columns: 4 }) => {
            Ok(world.route_through(&thesis_3x4())?)
        }
        (RouteSource::Snake | RouteSource::Thesis3x4, _) => {
            Err("the routes of section 3.4 lead through grids; thesis_3x4 through that of 3 × 4".into())
        }
        (RouteSource::Cover { seed, travels }, _) => {
            let mut route = cover(world, *seed)?;
            route.exits.truncate(travels.unwrap_or(usize::MAX));
            Ok(route)
        }
        (RouteSource::RandomWalk { travels, seed }, _) => Ok(random_walk(world, *travels, *seed)),
        (RouteSource::Places(places), _) => {
            let places: Vec<PlaceId> = places.iter().copied().map(PlaceId).collect();
            Ok(world.route_through(&places)?)
        }
    }
}

/// Names as numbers, the same for the same name.
fn numbered(names: &[String]) -> Vec<usize> {
    let number = |name| names.iter().position(|other| other == name).expect("it is one of them");
    names.iter().map(number).collect()
}
