//! Grid maps: what is known of each cell.

use std::path::PathBuf;

use hssh_draw::{GridPicture, draw_grid};
use hssh_local::{
    Lattice, Occupancy, OccupancyGrid, encode_png, read_floor_plan, read_map_with_remarks, write_map,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::arrays::{cells, shaped};
use crate::errors::{Kind, argument, error};
use crate::watch::{calmly, finished};

/// A grid map: what is known of each cell.
///
/// Parameters
/// ----------
/// cells : array_like of bool or int, shape (H, W)
///     Row 0 is the one at the *bottom*, as in ROS's OccupancyGrid. Of bools, True is an obstacle and False is free. Of integers, 0 is
///     free, 100 an obstacle, and -1 (255 in uint8) unknown, and nothing else is taken; ``Grid.from_image`` takes the pixels of an image.
/// resolution : float
///     Metres from one cell to the next.
/// origin : (float, float), optional
///     The lower left corner of the lower left cell: metres in the frame of the map.
///
/// Examples
/// --------
/// >>> import hssh, numpy as np
/// >>> cells = np.ones((40, 120), bool)
/// >>> cells[10:30, 10:110] = False
/// >>> hssh.Grid(cells, 0.1)
/// <Grid: 120 x 40 cells of 0.1 m>
#[pyclass(name = "Grid", module = "hssh", frozen)]
pub(crate) struct PyGrid {
    pub(crate) grid: OccupancyGrid,
    pub(crate) name: String,
    remarks: Vec<String>,
}

impl PyGrid {
    pub(crate) fn of(grid: OccupancyGrid, name: String) -> Self {
        PyGrid { grid, name, remarks: Vec::new() }
    }

    /// Opens a grid map by its YAML file, or an image of which the size of a pixel is known.
    pub(crate) fn open(py: Python<'_>, path: PathBuf, resolution: Option<f64>) -> PyResult<Self> {
        let name = path.display().to_string();
        let read = finished(py, |_| match resolution {
            None => read_map_with_remarks(&path),
            Some(resolution) => Ok((read_floor_plan(&path, resolution)?, Vec::new())),
        })?;
        let (grid, remarks) = read.map_err(|problem| error(Kind::Format, problem))?;
        Ok(PyGrid { grid, name, remarks })
    }

    fn made(
        [height, width]: [usize; 2],
        cells: Vec<Occupancy>,
        resolution: f64,
        origin: [f64; 2],
    ) -> PyResult<Self> {
        let side =
            |side: usize| u32::try_from(side).map_err(|_| argument(format!("{side} cells are too many")));
        let lattice = Lattice::new(side(width)?, side(height)?, resolution, origin);
        let grid = OccupancyGrid::new(lattice.map_err(argument)?, cells).map_err(argument)?;
        Ok(PyGrid::of(grid, "grid".to_owned()))
    }
}

#[pymethods]
impl PyGrid {
    #[new]
    #[pyo3(signature = (cells, resolution, origin = [0.0, 0.0]))]
    fn new(cells: &Bound<'_, PyAny>, resolution: f64, origin: [f64; 2]) -> PyResult<Self> {
        let (kind, shape, numbers) = self::cells("cells", cells)?;
        calmly(|| {
            let known = |(index, &number): (usize, &i64)| match (kind, number) {
                ('b', 1) | (_, 100) => Ok(Occupancy::Occupied),
                (_, 0) => Ok(Occupancy::Free),
                (_, -1) | ('u', 255) => Ok(Occupancy::Unknown),
                _ => Err(argument(format!(
                    "cells[{}, {}] is {number}: 0 is free, 100 is an obstacle, -1 is unknown; Grid.from_image takes pixels, and \
                     bools are True for obstacles",
                    index / shape[1],
                    index % shape[1]
                ))),
            };
            let cells = numbers.iter().enumerate().map(known).collect::<PyResult<_>>()?;
            PyGrid::made(shape, cells, resolution, origin)
        })
    }

    /// A grid from the pixels of an image, as ROS's map_server reads them.
    ///
    /// Parameters
    /// ----------
    /// pixels : array_like of uint8, shape (H, W)
    ///     Row 0 is the one at the *top*; white is free and black is an obstacle, unless `negate`.
    /// resolution : float
    ///     Metres per pixel.
    /// origin : (float, float), optional
    ///     The lower left corner of the image: metres in the frame of the map.
    /// negate : bool, optional
    ///     Whether black is free and white is an obstacle.
    /// occupied_thresh, free_thresh : float, optional
    ///     A pixel darker than the one is an obstacle, one lighter than the other is free, from 0 (white) to 1 (black); in between
    ///     it is unknown.
    ///
    /// Returns
    /// -------
    /// Grid
    #[staticmethod]
    #[pyo3(signature = (pixels, resolution, origin = [0.0, 0.0], *, negate = false, occupied_thresh = 0.65, free_thresh = 0.196))]
    fn from_image(
        pixels: &Bound<'_, PyAny>,
        resolution: f64,
        origin: [f64; 2],
        negate: bool,
        occupied_thresh: f64,
        free_thresh: f64,
    ) -> PyResult<Self> {
        let (_, shape, numbers) = self::cells("pixels", pixels)?;
        if !(0.0..=1.0).contains(&occupied_thresh) || !(0.0..=occupied_thresh).contains(&free_thresh) {
            return Err(argument(
                "thresholds are between 0 and 1, and free_thresh is no more than occupied_thresh",
            ));
        }
        if let Some(odd) = numbers.iter().position(|pixel| !(0..=255).contains(pixel)) {
            return Err(argument(format!(
                "pixels[{}, {}] is {}, and a pixel is from 0 to 255",
                odd / shape[1],
                odd % shape[1],
                numbers[odd]
            )));
        }
        calmly(|| {
            let known = |pixel: i64| {
                let light = pixel as f64 / 255.0;
                let dark = if negate { light } else { 1.0 - light };
                match dark {
                    dark if dark > occupied_thresh => Occupancy::Occupied,
                    dark if dark < free_thresh => Occupancy::Free,
                    _ => Occupancy::Unknown,
                }
            };
            let rows = numbers.chunks_exact(shape[1].max(1)).rev();
            let cells = rows.flatten().map(|&pixel| known(pixel)).collect();
            PyGrid::made(shape, cells, resolution, origin)
        })
    }

    /// ndarray of int8, shape (H, W): What is known of each cell, the bottom row first: 0 free, 100 an obstacle, -1 unknown.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let known = |cell: &Occupancy| match cell {
            Occupancy::Unknown => -1_i8,
            Occupancy::Free => 0,
            Occupancy::Occupied => 100,
        };
        let lattice = self.grid.lattice();
        let shape = [lattice.height() as usize, lattice.width() as usize];
        shaped(py, self.grid.cells().iter().map(known).collect(), shape)
    }

    /// (int, int): How many rows and columns there are.
    #[getter]
    fn shape(&self) -> (u32, u32) {
        (self.grid.lattice().height(), self.grid.lattice().width())
    }

    /// float: Metres from one cell to the next.
    #[getter]
    fn resolution(&self) -> f64 {
        self.grid.lattice().resolution()
    }

    /// ndarray of float64, shape (2,): The lower left corner of the lower left cell: metres in the frame of the map.
    #[getter]
    fn origin<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        PyArray1::from_slice(py, &self.grid.lattice().origin()).into_any()
    }

    /// str: What the map is called: its file, if it has one.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// list of str: What of the file was read otherwise than it says.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.remarks.clone()
    }

    /// Writes the map for ROS's map_server: the YAML file, and a PGM image beside it.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        write_map(&self.grid, &path).map_err(|problem| error(Kind::File, problem))
    }

    /// The map as SVG.
    fn to_svg(&self, py: Python<'_>) -> PyResult<String> {
        finished(py, |_| draw_grid(&self.grid, &GridPicture::default()))
    }

    /// The map as a PNG image, one pixel a cell.
    fn to_png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &finished(py, |_| encode_png(&self.grid))?))
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.to_png(py)
    }

    fn __repr__(&self) -> String {
        let lattice = self.grid.lattice();
        format!("<Grid: {} x {} cells of {} m>", lattice.width(), lattice.height(), lattice.resolution())
    }
}
