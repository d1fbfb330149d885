//! The building under a map: its regions as areas with names, and its doors as lines.

use nalgebra::vector;

use super::BuildingPicture;
use super::clearance::Obstacles;
use super::marks::Scene;
use crate::svg::{Anchor, Canvas, Point, number, text_width};

/// The size of what regions are called, in pixels.
const NAME_SIZE: f64 = 9.0;

/// The longer side of a building in a picture, at least, in pixels.
const SIDE: f64 = 1000.0;

impl BuildingPicture {
    /// By how much a picture must be stretched, of which a pixel is so many metres.
    pub(super) fn stretch(&self, pixel: f64) -> f64 {
        let corners = || self.regions.iter().flat_map(|region| &region.rings).flatten();
        let side = [0, 1].map(|axis| {
            let low = corners().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
            let high = corners().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
            (high - low) / pixel
        });
        let longer = side[0].max(side[1]);
        if longer > 0.0 { (SIDE / longer).max(1.0) } else { 1.0 }
    }
}

/// Draws regions in their colors, and doors across.
pub(super) fn draw_building(canvas: &mut Canvas, scene: &Scene, building: &BuildingPicture) {
    let at = |[x, y]: [f64; 2]| scene.on_canvas(vector![x, y]);
    canvas.open(r#"class="building""#);
    for region in &building.regions {
        let rings: Vec<Vec<Point>> =
            region.rings.iter().map(|ring| ring.iter().copied().map(at).collect()).collect();
        let attributes = format!(
            r#"fill="{color}" fill-opacity="0.28" fill-rule="evenodd" stroke="{color}" stroke-width="1""#,
            color = region.color
        );
        canvas.area(&rings, &attributes);
    }
    for &[left, right] in &building.doors {
        let width = number(0.9 * scene.line);
        canvas.line(
            at(left),
            at(right),
            &format!(r##"class="door" stroke="#009e73" stroke-width="{width}" stroke-linecap="round""##),
        );
    }
    canvas.close();
}

/// Writes what regions are called where there is room within them, with links and places drawn already.
pub(super) fn draw_names(
    canvas: &mut Canvas,
    scene: &Scene,
    building: &BuildingPicture,
    obstacles: &mut Obstacles,
) {
    let at = |&[x, y]: &[f64; 2]| scene.on_canvas(vector![x, y]);
    canvas.open(r#"class="regions""#);
    for region in building.regions.iter().filter(|region| !region.name.is_empty()) {
        let rings: Vec<Vec<Point>> = region.rings.iter().map(|ring| ring.iter().map(at).collect()).collect();
        let Some(middle) = obstacles.roomiest(&rings) else { continue };
        canvas.text(
            middle,
            NAME_SIZE,
            Anchor::Middle,
            &region.name,
            r##"class="region" fill="#555555" stroke="#ffffff" stroke-opacity="0.7" stroke-width="2" paint-order="stroke""##,
        );
        let half = text_width(&region.name, NAME_SIZE) / 2.0;
        for part in [-0.7, 0.0, 0.7] {
            obstacles.add(middle + vector![part * half, 0.0], NAME_SIZE / 2.0);
        }
    }
    canvas.close();
}
