//! A star type out of its list of ends (Definition 2.1).

use std::collections::BTreeSet;

use hssh_topology::{OlpName, Star, StarEnd, StarError};

use crate::NamedStar;
use crate::bearings::{BearingError, check_bearings};

use super::end::parse_end;
use super::error::{Fault, Faults, Span};
use super::tree::{Shape, Value};

const ENDS: &str =
    "a star is a list of its ends in clockwise order: `[\"0+\", \"1+ closed\", \"0-\", \"1-\"]`";

/// Reads the star type called `name`, noting what is wrong with its ends.
pub(super) fn read_star(name: &str, value: &Value<'_>, faults: &mut Faults) -> Option<NamedStar> {
    let Shape::List(items) = &value.shape else {
        faults.add(Fault::new(
            value.head(),
            format!("expected the ends of star `{name}`, found {}", value.describe()),
            ENDS,
        ));
        return None;
    };
    let read: Vec<_> = items.iter().map(|item| faults.keep(read_end(item))).collect();
    let (ends, bearings): (Vec<StarEnd>, Vec<Option<f64>>) =
        read.into_iter().collect::<Option<Vec<_>>>()?.into_iter().unzip();
    let places: Vec<(OlpName, Span)> =
        ends.iter().zip(items).map(|(end, item)| (end.name, item.span)).collect();
    let star = Star::new(ends).map_err(|error| no_star(name, &error, &places, value));
    let star = faults.keep(star)?;
    let checked = check_bearings(&star, &bearings).map_err(|error| wrong_bearing(&error, &places, value));
    faults.keep(checked)?;
    Some(NamedStar { name: name.to_owned(), star, bearings })
}

fn read_end(value: &Value<'_>) -> Result<(StarEnd, Option<f64>), Fault> {
    match &value.shape {
        Shape::Text(text) => parse_end(text, value.span),
        Shape::Number(text) | Shape::Word(text) => Err(Fault::new(
            value.span,
            format!("expected an end of a star, found {}", value.describe()),
            format!("ends stand in double quotes: \"{text}\""),
        )),
        _ => Err(Fault::new(
            value.head(),
            format!("expected an end of a star, found {}", value.describe()),
            "an end is one text in quotes, like \"1+\" or \"1+ closed @90\"",
        )),
    }
}

/// Why the ends make no star, pointing at the last end of that name.
fn no_star(star: &str, error: &StarError, places: &[(OlpName, Span)], list: &Value<'_>) -> Fault {
    match *error {
        StarError::Repeated(olp) => {
            let opposite = olp.opposite();
            let names: BTreeSet<OlpName> = places.iter().map(|&(name, _)| name).collect();
            let help = if names.contains(&opposite) {
                "every oriented local path has one position in the clockwise order: give this one another number"
                    .to_owned()
            } else {
                format!("did you mean `{opposite}`?")
            };
            Fault::new(place(places, olp, list), format!("`{olp}` stands twice in star `{star}`"), help)
        }
        StarError::Unpaired(olp) => Fault::new(
            place(places, olp, list),
            format!("`{olp}` has no opposite in star `{star}`"),
            format!(
                "every local path has two ends: add \"{opposite}\", or \"{opposite} closed\" if the path stops at this place",
                opposite = olp.opposite()
            ),
        ),
        StarError::Empty | StarError::MalformedName(_) => {
            Fault::new(list.head(), format!("star `{star}` has no ends"), ENDS)
        }
    }
}

fn wrong_bearing(error: &BearingError, places: &[(OlpName, Span)], list: &Value<'_>) -> Fault {
    let help = match error {
        BearingError::OutOfRange(_) => {
            "write degrees between -180 and 180, counterclockwise from the x axis of the place".to_owned()
        }
        BearingError::Coincide { .. } => {
            "bearings need not be given: leave out the one that was not measured".to_owned()
        }
        BearingError::NotClockwise { .. } => {
            "ends are listed clockwise and bearings grow counterclockwise, so along the list they decrease and come around once: like @90, @0, @-90, @180"
                .to_owned()
        }
    };
    Fault::new(place(places, error.olp(), list), error.to_string(), help)
}

fn place(places: &[(OlpName, Span)], olp: OlpName, list: &Value<'_>) -> Span {
    places.iter().rev().find(|&&(name, _)| name == olp).map_or(list.head(), |&(_, span)| span)
}
