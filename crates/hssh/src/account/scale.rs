//! Whether a grid map is drawn to the scale that its resolution says: rooms as wide as squares, or narrower than a robot, are those of
//! another one.

use super::regions::{PassageAccount, RegionAccount};

/// Metres: half of the regions of a building are no wider than this…
const WIDE: f64 = 12.0;
/// …and half of what leads from one to another is narrower than this.
const WIDE_PASSAGE: f64 = 5.0;
/// Metres: in a building, some region is wider than this.
const NARROW: f64 = 1.0;

/// What speaks against the scale of a map, if anything does.
pub(super) fn doubted_scale(regions: &[RegionAccount], passages: &[PassageAccount]) -> Option<String> {
    let width = middle(regions.iter().map(|region| region.width))?;
    let widest = regions.iter().map(|region| region.width).fold(0.0, f64::max);
    let ask = "is the map's resolution right? Places, ways and widths are wrong by what it is wrong by";
    if widest < NARROW {
        return Some(format!("no room or corridor of this map is wider than {widest:.1} m: {ask}"));
    }
    let passage = middle(passages.iter().map(|passage| passage.gateway.width))?;
    (width > WIDE && passage > WIDE_PASSAGE).then(|| {
        format!(
            "half of the rooms and corridors of this map are wider than {width:.0} m, and half of what leads from one to another is \
             {passage:.0} m wide or more: {ask}"
        )
    })
}

fn middle(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
