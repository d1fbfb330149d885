//! Regions as an image: one color for each.

use png::{BitDepth, ColorType, Compression, Encoder};

use super::kind::RegionNumber;
use super::region_map::RegionMap;
use crate::grid::Cell;

/// The part of the circle of hues from one region to the next: by the golden ratio, neighbors in number are unlike.
const HUE_STEP: f64 = 0.618_033_988_749_895;

impl RegionNumber {
    /// The color of the region in pictures, red, green and blue; regions below 4096 all have different ones, none black.
    #[must_use]
    pub fn color(self) -> [u8; 3] {
        let hue = 6.0 * (f64::from(self.0) * HUE_STEP).fract();
        let channel = |shift: f64| {
            let off = ((hue + shift).rem_euclid(6.0) - 3.0).abs();
            (90.0 + 150.0 * (off - 1.0).clamp(0.0, 1.0)) as u8
        };
        // The lowest bits number the regions, so that no two have one color.
        let bits = |number: u32, shift: u32| (number >> shift & 0xF) as u8;
        [
            channel(0.0) & 0xF0 | bits(self.0, 8),
            channel(4.0) & 0xF0 | bits(self.0, 4),
            channel(2.0) & 0xF0 | bits(self.0, 0),
        ]
    }
}

impl RegionMap {
    /// A PNG image of the size of the grid: every region in [its color](RegionNumber::color), all else black.
    #[must_use]
    pub fn encode_png(&self) -> Vec<u8> {
        let (width, height) = (self.lattice.width(), self.lattice.height());
        let colors: Vec<[u8; 3]> =
            (0..self.regions.len() as u32).map(|number| RegionNumber(number).color()).collect();
        let color = |cell: Cell| self.region_of(cell).map_or([0; 3], |region| colors[region.index()]);
        let rows = (0..height).rev().flat_map(|row| (0..width).map(move |column| Cell { column, row }));
        let pixels: Vec<u8> = rows.flat_map(color).collect();
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
        written.expect("an image with at least one pixel is written to memory");
        bytes
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn no_two_regions_have_one_color() {
        let colors: BTreeSet<[u8; 3]> = (0..4096).map(|number| RegionNumber(number).color()).collect();
        assert_eq!(colors.len(), 4096);
        assert!(!colors.contains(&[0; 3]));
    }
}
