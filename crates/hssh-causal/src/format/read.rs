//! An exploration out of its RON text: star types, the start, and the travels ⟨exit, entry, star⟩.

use hssh_topology::{Olp, OlpName, Star};

use crate::{Exploration, NamedStar, StarType, Travel};

use super::end::parse_name;
use super::error::{Fault, Faults, ParseError, Span};
use super::odometry::read_odometry;
use super::parser::parse;
use super::record::{Record, Schema};
use super::star::read_star;
use super::suggest::{did_you_mean, listed};
use super::tree::{Shape, Value};

const EXPLORATION: Schema = Schema {
    what: "an exploration",
    name: "Exploration",
    required: &["stars", "start", "travels"],
    optional: &[],
    example: "Exploration(stars: {..}, start: \"L\", travels: [..])",
};

const TRAVEL: Schema = Schema {
    what: "a travel",
    name: "Travel",
    required: &["exit", "entry", "star"],
    optional: &["odometry"],
    example: "(exit: \"1+\", entry: \"0-\", star: \"T\")",
};

const STARS: &str =
    "star types are a map from names to ends: `{\"L\": [\"0+\", \"1+ closed\", \"0- closed\", \"1-\"]}`";

/// Reads a file's bytes.
pub(super) fn read_bytes(bytes: &[u8]) -> Result<Exploration, ParseError> {
    let valid = bytes.utf8_chunks().next().map_or("", |chunk| chunk.valid());
    let Some(&stray) = bytes.get(valid.len()) else { return read_exploration(valid) };
    let message = match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "this file is UTF-16, not UTF-8".to_owned(),
        _ => format!("byte {} (0x{stray:02x}) is no UTF-8 text", valid.len() + 1),
    };
    let help = "an exploration is a plain text file: save it as UTF-8, or check that this is the right file";
    let span = Span { start: valid.len(), end: valid.len() };
    Err(ParseError::single(Fault::new(span, message, help), valid))
}

/// Reads a text.
pub(super) fn read_exploration(text: &str) -> Result<Exploration, ParseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let root = parse(text).map_err(|fault| ParseError::single(fault, text))?;
    let mut faults = Faults::default();
    let parts = read_parts(&root, &mut faults);
    if let Some(error) = faults.into_error(text) {
        return Err(error);
    }
    let whole = |message: String| {
        let fault = Fault::new(root.head(), message, "correct the exploration as a whole");
        ParseError::single(fault, text)
    };
    let (star_types, start, travels) =
        parts.ok_or_else(|| whole("this is not a complete exploration".to_owned()))?;
    Exploration::new(star_types, start, travels).map_err(|error| whole(error.to_string()))
}

/// The arguments of [`Exploration::new`]; whatever is missing from them has been noted.
fn read_parts(root: &Value<'_>, faults: &mut Faults) -> Option<(Vec<NamedStar>, StarType, Vec<Travel>)> {
    let record = Record::read(root, &EXPLORATION, faults)?;
    let stars = Stars::read(record.get("stars")?, faults)?;
    let start = record.get("start").and_then(|value| faults.keep(stars.find(value)).flatten());
    let travels = read_travels(record.get("travels")?, start, &stars, faults)?;
    let star_types = stars.0.into_iter().map(|(_, star)| star).collect::<Option<Vec<_>>>()?;
    Some((star_types, start?, travels))
}

/// The star types by name; without a star where its ends are wrong.
struct Stars(Vec<(String, Option<NamedStar>)>);

impl Stars {
    fn read(value: &Value<'_>, faults: &mut Faults) -> Option<Self> {
        let Shape::Map(entries) = &value.shape else {
            faults.add(Fault::new(
                value.head(),
                format!("expected the star types, found {}", value.describe()),
                STARS,
            ));
            return None;
        };
        let mut stars = Stars(Vec::new());
        for (key, ends) in entries {
            let Some(name) = faults.keep(text(key, "the name of a star type")) else { continue };
            if stars.0.iter().any(|(known, _)| known == name) {
                faults.add(Fault::new(
                    key.span,
                    format!("two star types are named `{name}`"),
                    "rename one of them, or remove it if they are the same",
                ));
                continue;
            }
            let star = read_star(name, ends, faults);
            stars.0.push((name.to_owned(), star));
        }
        if entries.is_empty() {
            faults.add(Fault::new(value.head(), "there are no star types", STARS));
            return None;
        }
        Some(stars)
    }

    /// The star type of a name; nothing if it is known but its ends are wrong.
    fn find(&self, value: &Value<'_>) -> Result<Option<StarType>, Fault> {
        let name = text(value, "the name of a star type")?;
        let names = self.0.iter().map(|(name, _)| name.as_str());
        match names.clone().position(|known| known == name) {
            Some(index) => Ok(self.0[index].1.as_ref().map(|_| StarType(index as u32))),
            None => Err(Fault::new(
                value.span,
                format!("no star type is named `{name}`"),
                format!("{}the star types are {}", did_you_mean(name, names.clone()), listed(names)),
            )),
        }
    }

    fn get(&self, star_type: StarType) -> Option<&NamedStar> {
        self.0[star_type.index()].1.as_ref()
    }
}

/// Reads the travels, following the robot from star to star.
fn read_travels(
    value: &Value<'_>,
    start: Option<StarType>,
    stars: &Stars,
    faults: &mut Faults,
) -> Option<Vec<Travel>> {
    let Shape::List(items) = &value.shape else {
        faults.add(Fault::new(
            value.head(),
            format!("expected the list of travels, found {}", value.describe()),
            format!("travels stand in square brackets: `[{}]`", TRAVEL.example),
        ));
        return None;
    };
    let mut travels = Vec::new();
    let mut here = start;
    for (index, item) in items.iter().enumerate() {
        let record = Record::read(item, &TRAVEL, faults);
        let there = record
            .as_ref()
            .and_then(|record| record.get("star"))
            .and_then(|star| faults.keep(stars.find(star)).flatten());
        travels.extend(record.and_then(|record| {
            let route = Route { travel: index + 1, here, there };
            read_travel(&record, &route, stars, faults)
        }));
        here = there;
    }
    Some(travels)
}

/// Between which star types a travel leads; one of them is unknown if its name was wrong.
struct Route {
    /// The travel, counted from 1.
    travel: usize,
    here: Option<StarType>,
    there: Option<StarType>,
}

/// Reads a travel.
fn read_travel(record: &Record<'_, '_>, route: &Route, stars: &Stars, faults: &mut Faults) -> Option<Travel> {
    let mut end = |field, star_type: Option<StarType>, verb| {
        let named = star_type.and_then(|star_type| stars.get(star_type));
        let value = record.get(field)?;
        faults.keep(read_olp(value, named, &format!("travel {} {verb}", route.travel))).flatten()
    };
    let exit = end("exit", route.here, "leaves");
    let entry = end("entry", route.there, "enters");
    let odometry = match record.get("odometry") {
        Some(value) => Some(read_odometry(value, faults)?),
        None => None,
    };
    Some(Travel { exit: exit?, entry: entry?, star: route.there?, odometry })
}

/// The gateway of a name in the star that the robot leaves or enters, if the star is known.
fn read_olp(value: &Value<'_>, named: Option<&NamedStar>, event: &str) -> Result<Option<Olp>, Fault> {
    let written = text(value, "the name of an oriented local path")?;
    let name = match written.split_once(char::is_whitespace) {
        Some((name, _)) if !name.is_empty() => return Err(more_than_a_name(written, name, value.span)),
        _ => parse_name(written, value.span)?,
    };
    let Some(named) = named else { return Ok(None) };
    let olp = named.star.find(name).ok_or_else(|| {
        Fault::new(
            value.span,
            format!("{event} star `{}`, which has no end `{name}`", named.name),
            format!("the ends of `{}`, clockwise: {}", named.name, ends(&named.star)),
        )
    })?;
    if !named.star.is_travelable(olp) {
        return Err(closed_end(named, name, event, value.span));
    }
    Ok(Some(olp))
}

fn more_than_a_name(written: &str, name: &str, span: Span) -> Fault {
    let message = format!("`{written}` is more than the name of an oriented local path");
    Fault::new(span, message, format!("write only its name here: \"{name}\""))
}

fn closed_end(named: &NamedStar, name: OlpName, event: &str, span: Span) -> Fault {
    let open = listed(named.star.gateways().map(|olp| named.star.name(olp)));
    let help = match open.as_str() {
        "" => format!("all ends of `{}` are closed: check its list of ends", named.name),
        open => format!("travelable in `{}`: {open}; otherwise another star was seen here", named.name),
    };
    let message = format!("{event} star `{}` by `{name}`, which is closed", named.name);
    Fault::new(span, message, help)
}

fn ends(star: &Star) -> String {
    let end = |olp| {
        let closed = if star.is_travelable(olp) { "" } else { " (closed)" };
        format!("`{}`{closed}", star.name(olp))
    };
    star.olps().map(end).collect::<Vec<_>>().join(", ")
}

/// Text in quotes.
fn text<'v>(value: &'v Value<'_>, wanted: &str) -> Result<&'v str, Fault> {
    let help = match &value.shape {
        Shape::Text(text) => return Ok(text),
        Shape::Number(text) | Shape::Word(text) => format!("{wanted} stands in double quotes: \"{text}\""),
        _ => format!("{wanted} is one text in double quotes"),
    };
    Err(Fault::new(value.head(), format!("expected {wanted}, found {}", value.describe()), help))
}
