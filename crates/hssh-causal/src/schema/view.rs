//! Views: what the robot sees of a place when it faces one of its oriented local paths (section 2.1.2).

use std::fmt;

use hssh_topology::{Olp, OlpName, Passability, Sign, Star, StarEnd};

/// How much of a place one view takes in.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Sight {
    /// The whole star, as a local perceptual model gives it (section 2.2.1).
    Place,
    /// Only the oriented local path that the robot faces, as at a distinctive state of the basic SSH.
    Ahead,
}

/// The image of a place at a distinctive state: from where the robot stands, looking along one oriented
/// local path.
///
/// Two views of whole places are equal if and only if an isomorphism (Definition 2.2) takes the one star
/// to the other and the faced oriented local path to the faced one: the names in the star are replaced by
/// numbers in the order of sight.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum View {
    /// The star, clockwise from the faced oriented local path, which is `Olp::new(0)` and named `0+`.
    Place(Star),
    /// What is ahead.
    Ahead {
        /// Whether the path goes on.
        passability: Passability,
        /// Its richer attribute.
        label: Option<String>,
    },
}

impl View {
    /// What a robot with that sight sees at a star when it faces `facing`.
    ///
    /// # Panics
    /// If the star has no such oriented local path.
    #[must_use]
    pub fn of(star: &Star, facing: Olp, sight: Sight) -> Self {
        match sight {
            Sight::Place => View::Place(seen_from(star, facing)),
            Sight::Ahead => {
                let StarEnd { passability, label, .. } = star.ends()[facing.index()].clone();
                View::Ahead { passability, label }
            }
        }
    }

    /// What is ahead: whether the faced oriented local path can be travelled, and its richer attribute.
    #[must_use]
    pub fn ahead(&self) -> (Passability, Option<String>) {
        match self {
            View::Place(star) => (star.ends()[0].passability, star.ends()[0].label.clone()),
            View::Ahead { passability, label } => (*passability, label.clone()),
        }
    }
}

/// The star with its ends counted from `facing` and its local paths named in that order.
fn seen_from(star: &Star, facing: Olp) -> Star {
    let degree = star.degree();
    let turned = |offset: u32| facing.turned(offset, degree);
    let mut seen: Vec<Olp> = Vec::new();
    let mut name = |olp: Olp| {
        let known = seen.iter().position(|&first| first == star.opposite(olp));
        let sign = if known.is_some() { Sign::Minus } else { Sign::Plus };
        let local_path = known.unwrap_or_else(|| {
            seen.push(olp);
            seen.len() - 1
        });
        OlpName { local_path: local_path as u32, sign }
    };
    let ends = (0..degree).map(turned).map(|olp| {
        let StarEnd { passability, label, .. } = star.ends()[olp.index()].clone();
        StarEnd { name: name(olp), passability, label }
    });
    Star::new(ends.collect::<Vec<_>>()).expect("renaming the local paths of a star keeps their pairs")
}

/// The short form of a star, the faced end first: `0+ (1+) 0- 1-`; of what is ahead only that end's
/// attribute: `travelable`, `closed`, with its label behind a colon.
impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let suffix = |label: &Option<String>| label.as_ref().map_or(String::new(), |text| format!(":{text}"));
        match self {
            View::Ahead { passability: Passability::Travelable, label } => {
                write!(f, "travelable{}", suffix(label))
            }
            View::Ahead { passability: Passability::Closed, label } => write!(f, "closed{}", suffix(label)),
            View::Place(star) => {
                let ends = star.ends().iter().map(|end| match end.passability {
                    Passability::Travelable => format!("{}{}", end.name, suffix(&end.label)),
                    Passability::Closed => format!("({}{})", end.name, suffix(&end.label)),
                });
                f.write_str(&ends.collect::<Vec<_>>().join(" "))
            }
        }
    }
}
