//! What is counted about a finished map: preference values and the kinds of closedness
//! (sections 2.3.2, 3.3 and 3.4).

use crate::map::Map;
use crate::path::Path;

/// The values of the preference policy (2.1); smaller is preferred, in lexicographic order.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Value {
    /// f1: pairs of a path and a place off it that is on neither side of it or on both.
    pub unrelated: usize,
    /// f2: paths.
    pub paths: usize,
    /// f3: places.
    pub places: usize,
}

/// Everything the published tables ask about a map, and its genus.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Facts {
    /// f1, f2 and f3.
    pub value: Value,
    /// f2′ of chapter 4: the paths with at least two places.
    pub long_paths: usize,
    /// The genus of the underlying embedded graph.
    pub genus: usize,
    /// No pending gateway is left.
    pub closed: bool,
    /// No pending gateway lies on a path with only one place: what the tables call "closed".
    pub nearly_closed: bool,
    /// No two paths share two places and no three form a triangle.
    pub perpendicular: bool,
}

impl Facts {
    /// All of them, from the definitions.
    #[must_use]
    pub fn of(map: &Map) -> Self {
        let paths = map.paths();
        Facts {
            value: Value {
                unrelated: paths.iter().map(|path| unrelated(map, path)).sum(),
                paths: paths.len(),
                places: map.places.len(),
            },
            long_paths: paths.iter().filter(|path| path.headings.len() >= 2).count(),
            genus: map.rotation_system().genus(),
            closed: map.pending_gateways().is_empty(),
            nearly_closed: is_nearly_closed(map),
            perpendicular: is_perpendicular(map, &paths),
        }
    }
}

fn unrelated(map: &Map, path: &Path) -> usize {
    let (right, left) = (path.right(map), path.left(map));
    let has_one_side = |place: &usize| right.contains(place) != left.contains(place);
    (0..map.places.len()).filter(|&place| !path.meets(place)).filter(|place| !has_one_side(place)).count()
}

fn is_nearly_closed(map: &Map) -> bool {
    map.pending_gateways().into_iter().all(|end| Path::through(map, end).headings.len() >= 2)
}

/// "No two global paths intersect each other in more than one place and no three global paths form a
/// triangle" (section 3.4); three paths through one common place form none.
pub(crate) fn is_perpendicular(map: &Map, paths: &[Path]) -> bool {
    let shared = |a: &Path, b: &Path| {
        (0..map.places.len()).filter(|&place| a.meets(place) && b.meets(place)).collect::<Vec<_>>()
    };
    for (i, a) in paths.iter().enumerate() {
        for (j, b) in paths.iter().enumerate().skip(i + 1) {
            let ab = shared(a, b);
            if ab.len() > 1 {
                return false;
            }
            for c in &paths[j + 1..] {
                let (bc, ca) = (shared(b, c), shared(c, a));
                let all_meet = !ab.is_empty() && !bc.is_empty() && !ca.is_empty();
                if all_meet && (ab != bc || bc != ca) {
                    return false;
                }
            }
        }
    }
    true
}
