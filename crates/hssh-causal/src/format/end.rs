//! One end of a star in one string: `"1+ closed @90 #office"`.

use hssh_topology::{OlpName, Passability, StarEnd};

use super::error::{Fault, Span};
use super::suggest::nearest;

const NOTATION: &str = "an end is its name, then `closed` if the path stops here, `@` with its bearing in degrees if measured, and `#` with a label if any: \"1+ closed @90 #office\"";

/// The end that a string describes and its bearing in radians.
pub(super) fn parse_end(text: &str, span: Span) -> Result<(StarEnd, Option<f64>), Fault> {
    let (description, label) = match text.split_once('#') {
        Some((description, label)) => (description, Some(parse_label(label, span)?)),
        None => (text, None),
    };
    let mut words = description.split_whitespace();
    let name = parse_name(words.next().unwrap_or(""), span)?;
    let mut passability = Passability::Travelable;
    let mut bearing = None;
    for word in words {
        if word == "closed" && passability == Passability::Travelable {
            passability = Passability::Closed;
        } else if let Some(angle) = word.strip_prefix('@').filter(|_| bearing.is_none()) {
            bearing = Some(parse_bearing(angle, span)?);
        } else {
            return Err(unknown_word(word, span));
        }
    }
    Ok((StarEnd { name, passability, label }, bearing))
}

/// The string that [`parse_end`] reads as this end with this bearing.
pub(super) fn write_end(end: &StarEnd, bearing: Option<f64>) -> String {
    let mut text = end.name.to_string();
    if end.passability == Passability::Closed {
        text.push_str(" closed");
    }
    if let Some(radians) = bearing {
        text.push_str(" @");
        text.push_str(&write_bearing(radians));
    }
    if let Some(label) = &end.label {
        text.push_str(" #");
        text.push_str(label);
    }
    text
}

/// A name such as `1+`, alone.
pub(super) fn parse_name(word: &str, span: Span) -> Result<OlpName, Fault> {
    word.parse().map_err(|_| {
        let message = match word {
            "" => "the name of an oriented local path is missing".to_owned(),
            _ => format!("`{word}` does not name an oriented local path"),
        };
        Fault::new(span, message, name_help(word))
    })
}

/// What was probably meant by a word that is no name.
fn name_help(word: &str) -> String {
    if let Some((name, label)) = word.split_once(':') {
        return format!("a label is written behind a `#`: \"{name} #{label}\"");
    }
    if let Some(name) = word.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        return format!("a closed end is written \"{name} closed\"");
    }
    let after_digits = word.trim_start_matches(|c: char| c.is_ascii_digit());
    let (digits, rest) = word.split_at(word.len() - after_digits.len());
    match (digits.parse::<u32>(), rest.chars().next()) {
        (Ok(number), Some(sign @ ('+' | '-'))) => {
            format!("put a space behind the name: \"{number}{sign} {}\"", &rest[1..])
        }
        (Ok(number), _) => {
            format!("write the number of the local path and a sign: `{number}+` or `{number}-`")
        }
        (Err(_), _) if !digits.is_empty() => {
            format!("local paths are numbered from 0 to at most {}", u32::MAX)
        }
        (Err(_), _) => "write the number of a local path and a sign, like `0+` or `1-`".to_owned(),
    }
}

fn parse_label(label: &str, span: Span) -> Result<String, Fault> {
    let label = label.trim();
    if label.is_empty() {
        return Err(Fault::new(
            span,
            "the label behind `#` is empty",
            "write the label, or leave out the `#`",
        ));
    }
    Ok(label.to_owned())
}

/// Degrees, or radians if the number is followed by `rad`.
fn parse_bearing(angle: &str, span: Span) -> Result<f64, Fault> {
    let finite = |number: &str| number.parse::<f64>().ok().filter(|value| value.is_finite());
    let radians = match angle.strip_suffix("rad") {
        Some(number) => finite(number),
        None => finite(angle).map(f64::to_radians),
    };
    radians.ok_or_else(|| {
        let number = angle.trim_end_matches(|c: char| !c.is_ascii_digit());
        let help = match finite(number) {
            Some(_) => format!("write degrees without a unit: `@{number}`"),
            None => "write degrees counterclockwise directly behind the `@`: `@90` or `@-12.5`".to_owned(),
        };
        Fault::new(span, format!("the bearing `@{angle}` is no number"), help)
    })
}

/// The shortest degrees that [`parse_bearing`] takes to exactly this bearing. About one bearing in
/// seven is the image of no degrees that short, or of none at all; it is written in radians.
fn write_bearing(radians: f64) -> String {
    let degrees = radians.to_degrees();
    (0..=15)
        .map(|digits| format!("{degrees:.digits$}"))
        .find(|text| {
            text.parse::<f64>().is_ok_and(|degrees| degrees.to_radians().to_bits() == radians.to_bits())
        })
        .unwrap_or_else(|| format!("{radians:?}rad"))
}

fn unknown_word(word: &str, span: Span) -> Fault {
    let (message, help) = match (word, nearest(word, ["closed", "travelable"])) {
        ("closed", _) => ("`closed` is written twice".to_owned(), NOTATION.to_owned()),
        (_, Some("closed")) => (format!("`{word}` is not understood"), "did you mean `closed`?".to_owned()),
        (_, Some(_)) => (
            format!("`{word}` is not understood"),
            "an end is travelable unless it says `closed`: leave the word out".to_owned(),
        ),
        _ if word.starts_with('@') => ("this end has two bearings".to_owned(), NOTATION.to_owned()),
        _ => (
            format!("`{word}` is neither `closed` nor a bearing nor a label"),
            format!("if it is a label, write `#{word}`; {NOTATION}"),
        ),
    };
    Fault::new(span, message, help)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPAN: Span = Span { start: 0, end: 0 };

    #[test]
    fn right_angles_are_written_as_people_write_them() {
        for (degrees, text) in [(0.0_f64, "0"), (90.0, "90"), (-90.0, "-90"), (180.0, "180"), (12.5, "12.5")]
        {
            assert_eq!(write_bearing(degrees.to_radians()), text);
        }
    }

    #[test]
    fn bearings_return_bit_for_bit() {
        let mut radians = -6.25_f64;
        for step in 0..20_000 {
            let text = write_bearing(radians);
            assert_eq!(parse_bearing(&text, SPAN).unwrap().to_bits(), radians.to_bits(), "{text}");
            radians = if step % 2 == 0 { radians.next_up() } else { radians + 6.25e-4 };
        }
        for radians in [-0.0, 1e-300, f64::MIN_POSITIVE / 2.0, std::f64::consts::TAU] {
            let text = write_bearing(radians);
            assert_eq!(parse_bearing(&text, SPAN).unwrap().to_bits(), f64::to_bits(radians), "{text}");
        }
    }

    #[test]
    fn every_part_is_read() {
        let (end, bearing) = parse_end("12- @-30 closed # the office # 3", SPAN).unwrap();
        assert_eq!(end.name.to_string(), "12-");
        assert_eq!(end.passability, Passability::Closed);
        assert_eq!(end.label.as_deref(), Some("the office # 3"));
        assert_eq!(bearing, Some((-30.0_f64).to_radians()));
        assert_eq!(write_end(&end, bearing), "12- closed @-30 #the office # 3");
    }
}
