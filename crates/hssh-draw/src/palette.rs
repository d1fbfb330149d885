//! Colors and dash patterns of paths, told apart with every kind of color vision.

use std::collections::BTreeMap;

use hssh_topology::{PathId, TopologicalMap};

/// Okabe and Ito's colors without yellow, which is too pale for lines on white, and two dark ones of Tol's.
const COLORS: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#882255", "#332288"];

/// Dash patterns in units of the line width: when the colors are used up, they come again dashed.
const DASHES: [&[f64]; 4] = [&[], &[3.0, 1.4], &[1.2, 1.2], &[4.0, 1.2, 1.2, 1.2]];

/// What is drawn for paths with a single place.
const SINGLE: &str = "#70757a";

/// How a path is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct PathStyle {
    /// As written in SVG and DOT.
    pub(crate) color: &'static str,
    /// Lengths of dashes and gaps in units of the line width; none for a solid line.
    pub(crate) dashes: &'static [f64],
}

/// The styles of a map's paths.
pub(crate) struct Palette(BTreeMap<PathId, PathStyle>);

impl Palette {
    /// Gives the paths with more than one place their styles, in order of creation.
    pub(crate) fn of(map: &TopologicalMap) -> Self {
        let is_long = |&path: &PathId| map.places_on_path(path) > 1 || map.is_circular(path);
        let style = |rank: usize| PathStyle {
            color: COLORS[rank % COLORS.len()],
            dashes: DASHES[rank / COLORS.len() % DASHES.len()],
        };
        Palette(map.paths().filter(is_long).enumerate().map(|(rank, path)| (path, style(rank))).collect())
    }

    /// The style of a path; of one with a single place: plain gray.
    pub(crate) fn style(&self, path: PathId) -> PathStyle {
        self.0.get(&path).copied().unwrap_or(PathStyle { color: SINGLE, dashes: &[] })
    }
}
