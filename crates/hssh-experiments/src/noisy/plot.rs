//! Line charts as SVG.

use std::error::Error;
use std::path::Path;

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

/// One line of a chart.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Curves over two axes.
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x: String,
    pub(crate) y: String,
    /// Which of the axes are logarithmic.
    pub(crate) logarithmic: [bool; 2],
    pub(crate) curves: Vec<Curve>,
}

/// Draws a chart into a file.
pub(crate) fn draw(file: &Path, chart: &Chart) -> Result<(), Box<dyn Error>> {
    let range = |axis: usize| {
        let of = |&(x, y): &(f64, f64)| if axis == 0 { x } else { y };
        let values = chart.curves.iter().flat_map(|curve| &curve.points).map(of);
        let (low, high) =
            values.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        if chart.logarithmic[axis] { 0.9 * low..1.1 * high } else { (low.min(0.0))..1.03 * high }
    };
    match chart.logarithmic {
        [true, true] => on_axes(file, chart, range(0).log_scale(), range(1).log_scale()),
        [true, false] => on_axes(file, chart, range(0).log_scale(), range(1)),
        [false, true] => on_axes(file, chart, range(0), range(1).log_scale()),
        [false, false] => on_axes(file, chart, range(0), range(1)),
    }
}

fn on_axes<X, Y>(file: &Path, chart: &Chart, x: X, y: Y) -> Result<(), Box<dyn Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let area = SVGBackend::new(file, (900, 560)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut axes = ChartBuilder::on(&area)
        .caption(&chart.title, ("sans-serif", 22))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(x, y)?;
    axes.configure_mesh()
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .x_label_formatter(&|value| format!("{}", (value * 100.0).round() / 100.0))
        .light_line_style(WHITE)
        .draw()?;
    for (index, curve) in chart.curves.iter().enumerate() {
        let color = Palette99::pick(index).to_rgba();
        let line = LineSeries::new(curve.points.iter().copied(), color.stroke_width(2)).point_size(3);
        axes.draw_series(line)?
            .label(&curve.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
    }
    axes.configure_series_labels()
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .position(SeriesLabelPosition::LowerLeft)
        .draw()?;
    area.present()?;
    Ok(())
}
