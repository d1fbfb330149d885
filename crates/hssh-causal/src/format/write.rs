//! Explorations written as a person would write them.

use std::fmt::Write;

use crate::{Exploration, NamedStar, Odometry, Travel};

use super::end::write_end;

/// The whole text.
pub(super) fn write_exploration(exploration: &Exploration) -> String {
    let name = |star_type: crate::StarType| quoted(&exploration.star_types()[star_type.index()].name);
    let mut text = String::from("Exploration(\n    stars: {\n");
    for named in exploration.star_types() {
        push_line(&mut text, &write_star(named));
    }
    text.push_str("    },\n    start: ");
    text.push_str(&name(exploration.start()));
    text.push_str(",\n    travels: [\n");
    let mut here = exploration.start();
    for travel in exploration.travels() {
        let (exit, entry) =
            (exploration.star(here).name(travel.exit), exploration.star(travel.star).name(travel.entry));
        let star = name(travel.star);
        let odometry = write_odometry(travel);
        push_line(&mut text, &format!("(exit: \"{exit}\", entry: \"{entry}\", star: {star}{odometry})"));
        here = travel.star;
    }
    text.push_str("    ],\n)\n");
    text
}

fn push_line(text: &mut String, item: &str) {
    text.push_str("        ");
    text.push_str(item);
    text.push_str(",\n");
}

/// `"T": ["0+", "1+ closed", "0-", "1-"]`
fn write_star(named: &NamedStar) -> String {
    let ends = named.star.ends().iter().zip(&named.bearings);
    let ends: Vec<String> = ends.map(|(end, &bearing)| quoted(&write_end(end, bearing))).collect();
    format!("{}: [{}]", quoted(&named.name), ends.join(", "))
}

fn write_odometry(travel: &Travel) -> String {
    let Some(Odometry { x, y, theta, covariance }) = &travel.odometry else { return String::new() };
    let covariance = write_covariance(covariance);
    format!(", odometry: (x: {x:?}, y: {y:?}, theta: {theta:?}, covariance: {covariance})")
}

/// The diagonal if nothing else is in it, otherwise the rows.
fn write_covariance(covariance: &[[f64; 3]; 3]) -> String {
    let is_diagonal = (0..3).all(|row| {
        (0..3).all(|column| row == column || covariance[row][column].to_bits() == 0.0_f64.to_bits())
    });
    if is_diagonal {
        return format!("{:?}", [covariance[0][0], covariance[1][1], covariance[2][2]]);
    }
    format!("{covariance:?}")
}

/// Text in quotes, with the escapes that RON has.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() => {
                write!(quoted, "\\u{{{:x}}}", u32::from(c)).expect("a string takes everything");
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
