//! How long distance transform, medial axis, places, regions and roadmap take on large maps.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use hssh_local::{
    DistanceField, FreeSpace, Lattice, Occupancy, OccupancyGrid, PlaceGraph, PlaceGraphError, PlaceOptions,
    RegionMap, RegionOptions, Roadmap, RoadmapOptions, Skeleton, neighborhood, read_map,
};

use crate::bench::usage::Usage;

/// Runs of each measurement, of which the median counts.
const RUNS: usize = 5;

/// Cells along one side of the large map, and of the one of which regions and roadmap are found once.
const SIDE: u32 = 2048;
const LARGEST: u32 = 10_000;

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let floor = read_map(&folder.join("3.yaml"))?;
    let large = repeated(&floor, SIDE)?;
    let parameters = PlaceOptions::default();
    let is_obstacle = |index: usize| large.cells()[index] != Occupancy::Free;
    let distance = median(|| drop(DistanceField::new(*large.lattice(), is_obstacle)));
    let free = FreeSpace::new(&large, &parameters.skeleton);
    let free_space = median(|| drop(FreeSpace::new(&large, &parameters.skeleton)));
    let skeleton = median(|| drop(Skeleton::new(&large, &free, &parameters.skeleton)));
    let whole = median(|| drop(PlaceGraph::new(&large, &parameters)));
    let window = floor.window([-13.6, -11.8], 10.0).ok_or("gdc3: no window")?;
    let local = median(|| drop(neighborhood(&window, [-13.6, -11.8], &parameters)));
    Ok(format!(
        "speed, median of {RUNS}, on {SIDE} × {SIDE} cells (4.2 megapixels, gdc3 repeated): distance transform {distance:.0} ms, \
         free space {free_space:.0} ms, medial axis with graph {skeleton:.0} ms, all places {whole:.0} ms, \
         a neighborhood of {} × {} cells {local:.2} ms\n{}",
        window.lattice().width(),
        window.lattice().height(),
        regions(&floor)?
    ))
}

/// What regions and roadmap take together, on one thread and on two.
fn regions(floor: &OccupancyGrid) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    for (side, runs) in [(SIDE, RUNS), (LARGEST, 1)] {
        let grid = repeated(floor, side)?;
        for threads in [1, 2] {
            let crew = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            let (before, start) = (Usage::now()?, Instant::now());
            for _ in 0..runs {
                crew.install(|| {
                    let map = RegionMap::new(&grid, &RegionOptions::default())?;
                    drop(Roadmap::new(&grid, &map, &RoadmapOptions::default()));
                    Ok::<(), PlaceGraphError>(())
                })?;
            }
            let (after, runs) = (Usage::now()?, runs as f64);
            text += &format!(
                "regions and roadmap of {side} × {side} cells, threads {threads}: {:.2} s of processor time, {:.2} s elapsed, \
                 at most {:.2} GB so far\n",
                (after.user_seconds - before.user_seconds) / runs,
                start.elapsed().as_secs_f64() / runs,
                after.peak_bytes as f64 / 1e9,
            );
        }
    }
    Ok(text)
}

fn median(run: impl Fn()) -> f64 {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

/// A square map of the same floor again and again.
fn repeated(floor: &OccupancyGrid, side: u32) -> Result<OccupancyGrid, Box<dyn Error>> {
    let (width, height) = (floor.lattice().width(), floor.lattice().height());
    let lattice = Lattice::new(side, side, floor.lattice().resolution(), [0.0; 2])?;
    let cells = lattice
        .cells()
        .map(|cell| floor.get(hssh_local::Cell { column: cell.column % width, row: cell.row % height }));
    Ok(OccupancyGrid::new(lattice, cells.collect())?)
}
