//! Stars: the local topology of a place (Definition 2.1).

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::ids::Olp;

/// One of the two directions of a local path, told apart by an arbitrary sign.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Sign {
    /// `LP+`
    Plus,
    /// `LP-`
    Minus,
}

/// The name of an oriented local path inside its star, as the thesis writes it: `1+`, `0-`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct OlpName {
    /// The identifier of the local path.
    pub local_path: u32,
    /// Which of its two directions.
    pub sign: Sign,
}

impl OlpName {
    /// The same local path in the other direction.
    #[must_use]
    pub fn opposite(self) -> Self {
        let sign = match self.sign {
            Sign::Plus => Sign::Minus,
            Sign::Minus => Sign::Plus,
        };
        OlpName { sign, ..self }
    }
}

impl fmt::Display for OlpName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = match self.sign {
            Sign::Plus => '+',
            Sign::Minus => '-',
        };
        write!(f, "{}{sign}", self.local_path)
    }
}

impl FromStr for OlpName {
    type Err = StarError;

    fn from_str(text: &str) -> Result<Self, StarError> {
        let malformed = || StarError::MalformedName(text.to_owned());
        let (digits, sign) = match text.strip_suffix('+') {
            Some(digits) => (digits, Sign::Plus),
            None => (text.strip_suffix('-').ok_or_else(malformed)?, Sign::Minus),
        };
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(malformed());
        }
        let local_path = digits.parse().map_err(|_| malformed())?;
        Ok(OlpName { local_path, sign })
    }
}

/// Whether a path goes on outside the place: the basic attribute domain {T, C}.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Passability {
    /// `T`: the path continues; the oriented local path is a gateway.
    Travelable,
    /// `C`: the path ends at this place.
    Closed,
}

/// An oriented local path as it stands in a star: its name and its attribute α.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct StarEnd {
    /// The name, used by people only: no isomorphism looks at it.
    pub name: OlpName,
    /// Travelable or closed.
    pub passability: Passability,
    /// A richer attribute: a control law, an appearance. Isomorphisms preserve it.
    pub label: Option<String>,
}

/// The local topology of a place: oriented local paths in clockwise order (Definition 2.1).
///
/// Where the enumeration begins is immaterial to isomorphisms, but it fixes what an [`Olp`] means.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
pub struct Star {
    ends: Vec<StarEnd>,
    /// `opposite[olp]`: the other direction of the same local path.
    opposite: Vec<Olp>,
}

/// What is wrong with the enumeration of a star's oriented local paths.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum StarError {
    /// A star without any local path.
    #[error("a star needs at least one local path, this one is empty")]
    Empty,
    /// The text is not `<number>+` or `<number>-`.
    #[error(
        "`{0}` does not name an oriented local path: write a local path's number and a sign, like `0+` or `1-`"
    )]
    MalformedName(String),
    /// The same oriented local path stands twice in the circular order.
    #[error("`{0}` stands twice in the star: every oriented local path has one position")]
    Repeated(OlpName),
    /// `LP+ ∈ S` iff `LP- ∈ S` does not hold.
    #[error(
        "`{0}` has no opposite: a star with `{0}` must also list `{opposite}`, closed if the path ends here",
        opposite = .0.opposite()
    )]
    Unpaired(OlpName),
}

impl Star {
    /// A star from its oriented local paths in clockwise order.
    ///
    /// # Errors
    /// If there are none, if a name is repeated, or if one direction of a local path is missing.
    pub fn new(ends: impl IntoIterator<Item = StarEnd>) -> Result<Self, StarError> {
        let ends: Vec<StarEnd> = ends.into_iter().collect();
        if ends.is_empty() {
            return Err(StarError::Empty);
        }
        let mut position = std::collections::BTreeMap::new();
        for (index, end) in ends.iter().enumerate() {
            if position.insert(end.name, Olp::new(index as u32)).is_some() {
                return Err(StarError::Repeated(end.name));
            }
        }
        let opposite = ends
            .iter()
            .map(|end| position.get(&end.name.opposite()).copied().ok_or(StarError::Unpaired(end.name)))
            .collect::<Result<_, _>>()?;
        Ok(Star { ends, opposite })
    }

    /// The number of oriented local paths: twice the number of local paths.
    #[must_use]
    pub fn degree(&self) -> u32 {
        self.ends.len() as u32
    }

    /// The oriented local paths in clockwise order.
    #[must_use]
    pub fn ends(&self) -> &[StarEnd] {
        &self.ends
    }

    /// All oriented local paths, clockwise.
    pub fn olps(&self) -> impl ExactSizeIterator<Item = Olp> + use<> {
        (0..self.degree()).map(Olp::new)
    }

    /// The oriented local paths that can be travelled, clockwise.
    pub fn gateways(&self) -> impl Iterator<Item = Olp> + '_ {
        self.olps().filter(|&olp| self.is_travelable(olp))
    }

    /// The clockwise neighbour, `next` of Definition 2.1.
    #[must_use]
    pub fn next(&self, olp: Olp) -> Olp {
        olp.turned(1, self.degree())
    }

    /// The other direction of the same local path.
    #[must_use]
    pub fn opposite(&self, olp: Olp) -> Olp {
        self.opposite[olp.index()]
    }

    /// Whether the path goes on in this direction: whether the oriented local path is a gateway.
    #[must_use]
    pub fn is_travelable(&self, olp: Olp) -> bool {
        self.ends[olp.index()].passability == Passability::Travelable
    }

    /// The name of an oriented local path.
    #[must_use]
    pub fn name(&self, olp: Olp) -> OlpName {
        self.ends[olp.index()].name
    }

    /// The oriented local path of a name, if the star has it.
    #[must_use]
    pub fn find(&self, name: OlpName) -> Option<Olp> {
        self.olps().find(|&olp| self.name(olp) == name)
    }

    /// Whether `other` lies on the right-hand side when one looks along `olp`: whether it comes
    /// before the opposite of `olp` in clockwise order (section 2.3.3).
    #[must_use]
    pub fn is_right_of(&self, olp: Olp, other: Olp) -> bool {
        let offset = olp.turn_to(other, self.degree());
        0 < offset && offset < olp.turn_to(self.opposite(olp), self.degree())
    }
}

/// The star in the thesis's notation: `[<0+,T>, <1+,C>, <0-,T>, <1-,T>]`.
impl fmt::Display for Star {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[")?;
        for (index, end) in self.ends.iter().enumerate() {
            let separator = if index == 0 { "" } else { ", " };
            let passability = match end.passability {
                Passability::Travelable => 'T',
                Passability::Closed => 'C',
            };
            write!(f, "{separator}<{},{passability}", end.name)?;
            if let Some(label) = &end.label {
                write!(f, ",{label}")?;
            }
            write!(f, ">")?;
        }
        write!(f, "]")
    }
}

/// Reads the short form for use in code: names in clockwise order separated by white space, a closed
/// end in parentheses, a label after a colon: `0+ (1+) 0- 1-:door`. Files of explorations spell the
/// same out, `1+ closed` and `1- #door`, and have bearings beside it.
impl FromStr for Star {
    type Err = StarError;

    fn from_str(text: &str) -> Result<Self, StarError> {
        Star::new(text.split_whitespace().map(parse_end).collect::<Result<Vec<_>, _>>()?)
    }
}

fn parse_end(text: &str) -> Result<StarEnd, StarError> {
    let (inner, passability) = match text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        Some(inner) => (inner, Passability::Closed),
        None => (text, Passability::Travelable),
    };
    let (name, label) = match inner.split_once(':') {
        Some((name, label)) => (name, Some(label.to_owned())),
        None => (inner, None),
    };
    Ok(StarEnd { name: name.parse()?, passability, label })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn example_2_1_reads_and_prints() {
        let tee: Star = "0+ (1+) 0- 1-".parse().unwrap();
        assert_eq!(tee.to_string(), "[<0+,T>, <1+,C>, <0-,T>, <1-,T>]");
        assert_eq!(tee.gateways().count(), 3);
        assert_eq!(tee.opposite(Olp::new(1)), Olp::new(3));
    }

    #[test]
    fn sides_are_disjoint_and_complete() {
        let star: Star = "0+ 1+ 2- 0- 2+ 1-".parse().unwrap();
        for olp in star.olps() {
            for other in star.olps() {
                let on_path = other == olp || other == star.opposite(olp);
                let right = star.is_right_of(olp, other);
                let left = star.is_right_of(star.opposite(olp), other);
                assert_eq!(u8::from(on_path) + u8::from(right) + u8::from(left), 1);
            }
        }
    }

    #[test]
    fn refuses_what_is_no_star() {
        let error = |text: &str| text.parse::<Star>().unwrap_err();
        assert_eq!(error(""), StarError::Empty);
        assert_eq!(
            error("0+ 0- 0+").to_string(),
            "`0+` stands twice in the star: every oriented local path has one position"
        );
        assert!(matches!(error("0+ 1+ 0-"), StarError::Unpaired(_)));
        assert!(matches!(error("0+ x 0-"), StarError::MalformedName(_)));
        assert!(matches!(error("0+ 99999999999- 0-"), StarError::MalformedName(_)));
    }
}
