//! The SVG figure of a pose graph: trajectory, closures, ellipses, start and end, a scale in metres.

use hssh_metrics::{PoseGraph, PoseId};
use nalgebra::vector;

use super::ellipse::ellipse_95;
use super::{EdgeKind, PoseGraphOptions};
use crate::svg::{Anchor, Canvas, Point, toward};

/// The longer side of the drawing without its texts, in pixels.
const SIZE: f64 = 820.0;
const MARGIN: f64 = 18.0;
const TEXT: f64 = 13.0;
/// Up to this many poses, each is marked with the direction it looks.
const MOST_MARKED_POSES: usize = 60;

/// From the graph's metres, y up, to the canvas's pixels, y down.
struct Frame {
    low: Point,
    pixels_per_meter: f64,
}

impl Frame {
    /// The frame in which all poses and ellipses fit.
    fn around(points: impl Iterator<Item = Point>) -> Self {
        let (mut low, mut high) = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
        for point in points {
            (low, high) = (low.inf(&point), high.sup(&point));
        }
        let extent = (high - low).amax();
        // Nothing, or a single place, has no extent: a metre then fills the picture.
        let extent = if extent.is_finite() && extent > 0.0 { extent } else { 1.0 };
        let low = if low.iter().all(|value| value.is_finite()) { low } else { Point::zeros() };
        Frame { low, pixels_per_meter: SIZE / extent }
    }

    fn on_canvas(&self, point: Point) -> Point {
        let offset = (point - self.low) * self.pixels_per_meter;
        vector![offset.x, -offset.y]
    }
}

/// A pose graph as an SVG document, at the poses it holds.
///
/// The trajectory is blue, closures are orange, refused ones red and dashed; the start is a circle, the end a
/// square. Ellipses hold the true position with a probability of 95 %.
#[must_use]
pub fn draw_pose_graph(graph: &PoseGraph, options: &PoseGraphOptions) -> String {
    let outlines: Vec<Vec<Point>> = options
        .covariances
        .iter()
        .filter_map(|&(pose, covariance)| {
            let center = graph.poses().get(pose.index())?.translation();
            Some(ellipse_95(&covariance)?.iter().map(|corner| center + corner).collect())
        })
        .collect();
    let positions = graph.poses().iter().map(|pose| pose.translation());
    let frame = Frame::around(positions.chain(outlines.iter().flatten().copied()));
    let mut canvas = Canvas::default();

    draw_ellipses(&mut canvas, &frame, &outlines);
    for kind in [EdgeKind::Odometry, EdgeKind::Closure, EdgeKind::Refused] {
        draw_edges(&mut canvas, &frame, graph, options, kind);
    }
    draw_poses(&mut canvas, &frame, graph);
    draw_texts(&mut canvas, &frame, graph, options, !outlines.is_empty());
    canvas.finish(MARGIN, options.title.as_deref().unwrap_or("Pose graph"))
}

fn draw_ellipses(canvas: &mut Canvas, frame: &Frame, outlines: &[Vec<Point>]) {
    canvas.open(r##"class="covariances" fill="#009e73" fill-opacity="0.07" stroke="#009e73" stroke-opacity="0.6" stroke-width="0.7""##);
    for outline in outlines {
        let corners: Vec<Point> = outline.iter().map(|&corner| frame.on_canvas(corner)).collect();
        canvas.polygon(&corners, "");
    }
    canvas.close();
}

/// How edges of a kind are drawn, their class first.
fn stroke(kind: EdgeKind) -> &'static str {
    match kind {
        EdgeKind::Odometry => {
            r##"class="odometry" stroke="#0072b2" stroke-width="1.6" stroke-linecap="round""##
        }
        EdgeKind::Closure => r##"class="closures" stroke="#d55e00" stroke-width="1" stroke-opacity="0.75""##,
        EdgeKind::Refused => {
            r##"class="refused" stroke="#c0143c" stroke-width="1" stroke-dasharray="5 4" stroke-opacity="0.8""##
        }
    }
}

fn draw_edges(
    canvas: &mut Canvas,
    frame: &Frame,
    graph: &PoseGraph,
    options: &PoseGraphOptions,
    kind: EdgeKind,
) {
    canvas.open(stroke(kind));
    for (index, edge) in graph.edges().iter().enumerate() {
        if options.kinds.get(index).copied().unwrap_or(EdgeKind::Odometry) == kind {
            let ends = [edge.from, edge.to].map(|pose| frame.on_canvas(graph.pose(pose).translation()));
            canvas.line(ends[0], ends[1], "");
        }
    }
    canvas.close();
}

/// Marks the first pose and the last, and all poses with their directions if there are few.
fn draw_poses(canvas: &mut Canvas, frame: &Frame, graph: &PoseGraph) {
    let at = |pose: PoseId| frame.on_canvas(graph.pose(pose).translation());
    canvas.open(r#"class="poses""#);
    if graph.poses().len() <= MOST_MARKED_POSES {
        for pose in graph.pose_ids() {
            let (center, ahead) = (at(pose), toward(-graph.pose(pose).theta));
            let aside = vector![-ahead.y, ahead.x];
            let corners = [
                center + ahead * 11.0,
                center - ahead * 5.0 + aside * 5.0,
                center - ahead * 5.0 - aside * 5.0,
            ];
            canvas.polygon(&corners, r##"fill="#0072b2" stroke="#ffffff" stroke-width="0.8""##);
        }
    }
    let mut ids = graph.pose_ids();
    if let Some(first) = ids.next() {
        if let Some(last) = ids.last() {
            let half = Point::repeat(5.0);
            let style = r##"fill="#ffffff" stroke="#222222" stroke-width="1.6""##;
            canvas.rectangle(at(last) - half, at(last) + half, style);
        }
        canvas.circle(at(first), 5.5, r##"fill="#ffe08a" stroke="#222222" stroke-width="1.6""##);
    }
    canvas.close();
}

/// The title above; below, a scale and what the colors mean.
fn draw_texts(
    canvas: &mut Canvas,
    frame: &Frame,
    graph: &PoseGraph,
    options: &PoseGraphOptions,
    has_ellipses: bool,
) {
    let (low, high) = canvas.bounds();
    if let Some(title) = &options.title {
        let at = vector![low.x, low.y - 1.6 * TEXT];
        canvas.text(at, 1.15 * TEXT, Anchor::Start, title, r##"fill="#111111" font-weight="bold""##);
    }
    let ink = r##"fill="#444444""##;
    let meters = round_length(SIZE / 5.0 / frame.pixels_per_meter);
    let (start, length) =
        (vector![low.x, high.y + 2.0 * TEXT], vector![meters * frame.pixels_per_meter, 0.0]);
    canvas.line(start, start + length, r##"class="scale" stroke="#444444" stroke-width="2""##);
    canvas.text(start + length + vector![8.0, 0.0], TEXT, Anchor::Start, &format!("{meters} m"), ink);

    let count = |kind: EdgeKind| options.kinds.iter().filter(|&&other| other == kind).count();
    let (closures, refused) = (count(EdgeKind::Closure), count(EdgeKind::Refused));
    let odometry = graph.edges().len() - closures - refused;
    let mut notes = vec![(Some(EdgeKind::Odometry), format!("trajectory, {odometry} edges"))];
    if closures > 0 {
        notes.push((Some(EdgeKind::Closure), format!("closures, {closures}")));
    }
    if refused > 0 {
        notes.push((Some(EdgeKind::Refused), format!("refused, {refused}")));
    }
    if has_ellipses {
        notes.push((None, "the true position is inside, 95 %".to_owned()));
    }
    for (row, (kind, note)) in notes.iter().enumerate() {
        let middle = start + vector![0.0, (1.6 * row as f64 + 1.8) * TEXT];
        match kind {
            Some(kind) => canvas.line(middle, middle + vector![24.0, 0.0], stroke(*kind)),
            None => canvas.circle(
                middle + vector![12.0, 0.0],
                5.0,
                r##"fill="#009e73" fill-opacity="0.14" stroke="#009e73""##,
            ),
        }
        canvas.text(middle + vector![32.0, 0.0], TEXT, Anchor::Start, note, ink);
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is not above a length.
fn round_length(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * power);
    steps.into_iter().find(|&step| step <= length).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hssh_metrics::{Edge, Information, Pose};
    use nalgebra::Matrix2;

    fn triangle() -> PoseGraph {
        let mut graph = PoseGraph::new();
        let poses = [(0.0, 0.0, 0.0), (3.0, 0.0, 2.0), (0.0, 4.0, -1.5)];
        let ids = poses.map(|(x, y, theta)| graph.add_pose(Pose::new(x, y, theta)));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let relative_pose = graph.pose(ids[from]).between(graph.pose(ids[to]));
            let information = Information::identity();
            graph.add_edge(Edge { from: ids[from], to: ids[to], relative_pose, information }).unwrap();
        }
        graph
    }

    #[test]
    fn every_edge_is_drawn_once_in_its_own_manner() {
        let graph = triangle();
        let options = PoseGraphOptions {
            title: Some("three < four".to_owned()),
            kinds: vec![EdgeKind::Odometry, EdgeKind::Refused, EdgeKind::Closure],
            covariances: vec![(PoseId(1), Matrix2::identity() * 0.04), (PoseId(7), Matrix2::identity())],
        };
        let svg = draw_pose_graph(&graph, &options);
        assert!(svg.contains("three &lt; four"));
        assert_eq!(svg.matches("<line").count(), 3 + 1 + 3, "edges, scale, legend");
        assert_eq!(svg.matches("<polygon").count(), 1 + 3, "one ellipse, for the other pose does not exist");
        assert_eq!(svg, draw_pose_graph(&graph, &options));
    }

    #[test]
    fn a_graph_without_extent_is_drawn_too() {
        for poses in [0, 1, 2] {
            let mut graph = PoseGraph::new();
            for _ in 0..poses {
                graph.add_pose(Pose::IDENTITY);
            }
            let svg = draw_pose_graph(&graph, &PoseGraphOptions::default());
            assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }

    #[test]
    fn scales_are_round() {
        let lengths = [1.0, 1.9, 2.0, 4.99, 7.0, 34.0, 0.03].map(round_length);
        let expected = [1.0, 1.0, 2.0, 2.0, 5.0, 20.0, 0.02];
        assert!(
            lengths.iter().zip(expected).all(|(length, round)| (length - round).abs() < 1e-12),
            "{lengths:?}"
        );
    }
}
