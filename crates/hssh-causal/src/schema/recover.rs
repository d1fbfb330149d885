//! From schemas back to an exploration, where every view shows a whole place (section 2.3).

use hssh_topology::{Olp, Star};

use super::{Action, Trace, View};
use crate::{Exploration, ExplorationError, NamedStar, StarType, Travel};

/// Why a trace does not tell an exploration.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum RecoverError {
    /// A view shows only what is ahead.
    #[error(
        "the view at moment {} shows only what is ahead: a star is told by views of whole places, else see what `stays` says", .0 + 1
    )]
    NoStar(usize),
    /// A turn led to a view that the star seen on arrival does not have there.
    #[error(
        "schema {}: after `{action}` the place looks like `{seen}`, but by the star seen on arrival it should be `{expected}`",
        schema + 1
    )]
    Turn {
        /// The schema, counted from 0.
        schema: usize,
        /// The turn.
        action: Action,
        /// The view after it.
        seen: String,
        /// The view that the star has there.
        expected: String,
    },
    /// A travel leaves or enters by a closed end.
    #[error(transparent)]
    Exploration(#[from] ExplorationError),
}

/// The exploration that a trace of views of whole places comes from.
///
/// It is the same up to isomorphism of each star: a star type is what is seen on arrival, ends counted
/// from the one ahead. Which star types a file had told apart by nothing but name, bearings and odometry are
/// not in the views, and therefore lost; so are turns after the last travel.
///
/// # Errors
/// If a view is not of a whole place, if a turn contradicts the star seen on arrival, or if the robot used
/// a closed end.
pub fn exploration(trace: &Trace) -> Result<Exploration, RecoverError> {
    let mut stars: Vec<&Star> = Vec::new();
    let mut type_of = |star| {
        let known = stars.iter().position(|&other| other == star);
        StarType(known.unwrap_or_else(|| {
            stars.push(star);
            stars.len() - 1
        }) as u32)
    };
    let mut here = star_at(trace, 0)?;
    let mut facing = Olp::new(0);
    let start = type_of(here);
    let mut travels = Vec::new();
    for (schema, step) in trace.steps().iter().enumerate() {
        let after = star_at(trace, schema + 1)?;
        if step.action.is_travel() {
            // The robot looks the way it came in.
            let entry = after.opposite(Olp::new(0));
            travels.push(Travel { exit: facing, entry, star: type_of(after), odometry: None });
            (here, facing) = (after, Olp::new(0));
            continue;
        }
        facing = match step.action {
            Action::Turn { clockwise } => facing.turned(clockwise, here.degree()),
            _ => here.opposite(facing),
        };
        let expected = View::of(here, facing, super::Sight::Place);
        if expected != step.view {
            let (seen, expected) = (step.view.to_string(), expected.to_string());
            return Err(RecoverError::Turn { schema, action: step.action, seen, expected });
        }
    }
    let star_types = stars.iter().enumerate().map(|(index, &star)| NamedStar {
        name: format!("S{}", index + 1),
        bearings: vec![None; star.ends().len()],
        star: star.clone(),
    });
    Ok(Exploration::new(star_types.collect(), start, travels)?)
}

fn star_at(trace: &Trace, moment: usize) -> Result<&Star, RecoverError> {
    match trace.view(moment) {
        View::Place(star) => Ok(star),
        View::Ahead { .. } => Err(RecoverError::NoStar(moment)),
    }
}
