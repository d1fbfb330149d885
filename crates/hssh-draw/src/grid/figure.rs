//! A grid with its medial axis, gateways and stars as an SVG picture.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use hssh_local::{Gateway, Lattice, LocalStar, OccupancyGrid, Skeleton};

use super::cells::data_uri;
use crate::interior::roomiest;
use crate::svg::{Point, escape};

/// The longer side of the picture in pixels.
const SIZE: f64 = 1200.0;

/// Colors of local paths, in the order of their numbers.
const LOCAL_PATHS: [&str; 5] = ["#d55e00", "#cc79a7", "#882255", "#332288", "#e69f00"];

/// A region to be drawn.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RegionPicture {
    /// The rings around it and around its holes, in metres.
    pub rings: Vec<Vec<[f64; 2]>>,
    /// Its color, as `#rrggbb`.
    pub color: String,
    /// What is written into it.
    pub name: String,
}

/// What is drawn over a grid; nothing is drawn of what is left out.
#[derive(Clone, Debug, Default)]
pub struct GridPicture<'a> {
    /// The medial axis.
    pub skeleton: Option<&'a Skeleton>,
    /// Constrictions of the axis that belong to no place in particular.
    pub constrictions: &'a [Gateway],
    /// Places: a center in metres, with the star around it.
    pub places: Vec<([f64; 2], &'a LocalStar)>,
    /// Ways that were travelled, in metres, each with the color of its line.
    pub ways: Vec<(Vec<[f64; 2]>, &'static str)>,
    /// Regions, under all else.
    pub regions: Vec<RegionPicture>,
    /// Places without their stars, in metres, with their numbers.
    pub dots: Vec<[f64; 2]>,
    /// Where the robot is, in metres.
    pub robot: Option<[f64; 2]>,
}

/// The color of a way as it was.
pub const TRUE_WAY: &str = "#0072b2";
/// The color of a way as odometry told it.
pub const TOLD_WAY: &str = "#e69f00";

/// Draws a grid as an SVG text of its own: free cells white, unknown ones gray, obstacles black. Each
/// local path of a star has a color; a path that ends at the place ends in a bar there.
#[must_use]
pub fn draw_grid(grid: &OccupancyGrid, picture: &GridPicture<'_>) -> String {
    let (width, height) = (f64::from(grid.lattice().width()), f64::from(grid.lattice().height()));
    let scale = SIZE / width.max(height);
    let mut canvas = Canvas { lattice: *grid.lattice(), text: String::new(), unit: 0.0 };
    canvas.unit = (0.05 / grid.lattice().resolution()).max(1.0 / scale);
    let _ = writeln!(
        canvas.text,
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{:.0}" height="{:.0}" viewBox="0 0 {width} {height}">"#,
        width * scale,
        height * scale
    );
    let _ = writeln!(
        canvas.text,
        r#"<image width="{width}" height="{height}" style="image-rendering:pixelated" xlink:href="{}"/>"#,
        data_uri(grid)
    );
    for region in &picture.regions {
        canvas.region(region);
    }
    for edge in picture.skeleton.iter().flat_map(|skeleton| &skeleton.edges) {
        let points = edge.points.iter().map(|point| point.point);
        canvas.polyline(points, "#56b4e9", 1.5);
    }
    for (way, color) in &picture.ways {
        canvas.polyline(way.iter().copied(), color, 1.6);
    }
    for (number, (center, star)) in picture.places.iter().enumerate() {
        canvas.star(*center, star, number);
    }
    for gateway in picture.constrictions {
        canvas.line(gateway.line, "#009e73", 5.0);
    }
    for (number, &dot) in picture.dots.iter().enumerate() {
        canvas.numbered(dot, number);
    }
    for region in picture.regions.iter().filter(|region| !region.name.is_empty()) {
        canvas.name(region);
    }
    if let Some(robot) = picture.robot {
        canvas.disk(robot, 5.0, "#0072b2");
    }
    canvas.text + "</svg>\n"
}

struct Canvas {
    lattice: Lattice,
    text: String,
    /// The width of a thin line, in cells: about 5 cm.
    unit: f64,
}

impl Canvas {
    /// A point in metres as columns from the left and rows from the top.
    fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [column, row] = self.lattice.continuous(point);
        [column, f64::from(self.lattice.height()) - row]
    }

    fn polyline(&mut self, points: impl Iterator<Item = [f64; 2]>, color: &str, width: f64) {
        let corner = |point: [f64; 2]| {
            let [x, y] = self.at(point);
            format!("{x:.1},{y:.1}")
        };
        let corners: Vec<String> = points.map(corner).collect();
        let _ = writeln!(
            self.text,
            r#"<polyline fill="none" stroke="{color}" stroke-width="{:.1}" points="{}"/>"#,
            width * self.unit,
            corners.join(" ")
        );
    }

    fn line(&mut self, ends: [[f64; 2]; 2], color: &str, width: f64) {
        let [[x1, y1], [x2, y2]] = ends.map(|end| self.at(end));
        let _ = writeln!(
            self.text,
            r#"<line x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}" stroke="{color}" stroke-width="{:.1}" stroke-linecap="round"/>"#,
            width * self.unit
        );
    }

    fn disk(&mut self, center: [f64; 2], radius: f64, color: &str) {
        let [x, y] = self.at(center);
        let _ = writeln!(
            self.text,
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="{:.1}" fill="{color}"/>"#,
            radius * self.unit
        );
    }

    /// Gateways across, local paths along, and the number of the place.
    fn star(&mut self, center: [f64; 2], star: &LocalStar, number: usize) {
        for ((end, &bearing), gateway) in star.star.ends().iter().zip(&star.bearings).zip(&star.gateways) {
            let color = LOCAL_PATHS[end.name.local_path as usize % LOCAL_PATHS.len()];
            match gateway {
                Some(gateway) => {
                    self.line(gateway.line, color, 2.0);
                    self.line([center, gateway.position], color, 3.0);
                    let tip = ahead(gateway.position, gateway.bearing, 12.0 * self.length());
                    self.line([gateway.position, tip], color, 3.0);
                }
                None => {
                    let stop = ahead(center, bearing, 10.0 * self.length());
                    let bar =
                        [FRAC_PI_2, -FRAC_PI_2].map(|turn| ahead(stop, bearing + turn, 5.0 * self.length()));
                    self.line([center, stop], color, 3.0);
                    self.line(bar, color, 3.0);
                }
            }
        }
        self.numbered(center, number);
    }

    /// A region as an area.
    fn region(&mut self, region: &RegionPicture) {
        let ring = |ring: &Vec<[f64; 2]>| {
            let corner = |&point: &[f64; 2]| {
                let [x, y] = self.at(point);
                format!("{x:.1} {y:.1}")
            };
            format!("M{}Z", ring.iter().map(corner).collect::<Vec<_>>().join("L"))
        };
        let outline: String = region.rings.iter().map(ring).collect();
        let _ = writeln!(
            self.text,
            r#"<path fill="{color}" fill-opacity="0.45" fill-rule="evenodd" stroke="{color}" stroke-width="{:.1}" d="{outline}"/>"#,
            self.unit,
            color = region.color
        );
    }

    /// The name of a region where there is most room in it.
    fn name(&mut self, region: &RegionPicture) {
        let ring = |ring: &Vec<[f64; 2]>| ring.iter().copied().map(Point::from).collect();
        let rings: Vec<Vec<Point>> = region.rings.iter().map(ring).collect();
        let Some(middle) = roomiest(&rings, &[]) else { return };
        let [x, y] = self.at(middle.into());
        let _ = writeln!(
            self.text,
            r##"<text x="{x:.1}" y="{y:.1}" dy="-0.9em" font-family="sans-serif" font-size="{:.1}" text-anchor="middle" fill="#222222">{}</text>"##,
            9.0 * self.unit,
            escape(&region.name)
        );
    }

    /// A place with its number.
    fn numbered(&mut self, center: [f64; 2], number: usize) {
        self.disk(center, 7.0, "#222222");
        let [x, y] = self.at(center);
        let _ = writeln!(
            self.text,
            r##"<text x="{x:.1}" y="{y:.1}" dy="0.35em" font-family="sans-serif" font-size="{:.1}" text-anchor="middle" fill="#ffffff">{number}</text>"##,
            9.0 * self.unit
        );
    }

    /// The width of a thin line in metres.
    fn length(&self) -> f64 {
        self.unit * self.lattice.resolution()
    }
}

fn ahead(from: [f64; 2], bearing: f64, distance: f64) -> [f64; 2] {
    [from[0] + distance * bearing.cos(), from[1] + distance * bearing.sin()]
}
