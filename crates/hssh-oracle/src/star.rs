//! What a star says, derived from its list of ends alone (Definition 2.1, section 2.3.3).

use hssh_topology::Star;

/// The other end of the same local path.
pub(crate) fn opposite(star: &Star, end: usize) -> usize {
    let ends = star.ends();
    (0..ends.len())
        .find(|&other| other != end && ends[other].name.local_path == ends[end].name.local_path)
        .expect("a star lists both ends of each of its local paths")
}

/// The ends on the right-hand side when one looks along `end`: those met clockwise from it before
/// its opposite.
pub(crate) fn right_of(star: &Star, end: usize) -> Vec<usize> {
    let degree = star.ends().len();
    let behind = opposite(star, end);
    (1..degree).map(|steps| (end + steps) % degree).take_while(|&other| other != behind).collect()
}

/// Every rotation that takes the ends of `from` to ends of `to` and keeps attributes and opposites.
pub(crate) fn isomorphisms(from: &Star, to: &Star) -> Vec<usize> {
    let degree = from.ends().len();
    if to.ends().len() != degree {
        return Vec::new();
    }
    let keeps = |rotation: usize, end: usize| {
        let image = (end + rotation) % degree;
        let (a, b) = (&from.ends()[end], &to.ends()[image]);
        let same_attribute = a.passability == b.passability && a.label == b.label;
        same_attribute && (opposite(from, end) + rotation) % degree == opposite(to, image)
    };
    (0..degree).filter(|&rotation| (0..degree).all(|end| keeps(rotation, end))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star(text: &str) -> Star {
        text.parse().unwrap()
    }

    /// Remark 2.2.1: a "+" has four self-isomorphisms, a "T" and an "L" one.
    #[test]
    fn self_isomorphisms_of_crossings() {
        let count = |text: &str| isomorphisms(&star(text), &star(text)).len();
        assert_eq!(count("0+ 1+ 0- 1-"), 4);
        assert_eq!(count("0+ (1+) 0- 1-"), 1);
        assert_eq!(count("0+ 1+ (0-) (1-)"), 1);
    }

    #[test]
    fn an_isomorphism_keeps_travel_label_and_opposite() {
        let count = |a: &str, b: &str| isomorphisms(&star(a), &star(b)).len();
        assert_eq!(count("0+ (1+) 0- 1-", "(1+) 0- 1- 0+"), 1);
        assert_eq!(count("0+ (1+) 0- 1-", "0+ 1+ 0- 1-"), 0);
        assert_eq!(count("0+ 1+:door 0- 1-", "0+ 1+ 0- 1-"), 0);
        assert_eq!(count("0+ 1+ 0- 1-", "0+ 0- 1+ 1-"), 0);
        assert_eq!(count("0+ 0-", "0+ 1+ 0- 1-"), 0);
        assert_eq!(count("0+ 0- 1+ 1-", "0+ 0- 1+ 1-"), 2);
    }

    #[test]
    fn the_right_hand_side_is_clockwise() {
        assert_eq!(right_of(&star("0+ 1+ 2- 0- 2+ 1-"), 0), [1, 2]);
        assert_eq!(right_of(&star("0+ 1+ 2- 0- 2+ 1-"), 3), [4, 5]);
        assert_eq!(right_of(&star("0+ 0- 1+ 1-"), 0), [0; 0]);
        assert_eq!(right_of(&star("0+ 0- 1+ 1-"), 1), [2, 3]);
    }
}
