//! Regions and places of floor plans against their true rooms: the IPA room segmentation benchmark (Bormann et al., 2016).

use std::error::Error;
use std::path::{Path, PathBuf};

use hssh_local::{
    OccupancyGrid, RegionMap, RegionOptions, Roadmap, RoadmapOptions, read_floor_plan, read_map,
};

use super::segmentation::{Agreement, Rooms};
use crate::table::aligned;

/// Metres per pixel of all plans.
pub(crate) const RESOLUTION: f64 = 0.05;
/// What the truth is called, and the plan with furniture.
const TRUTH: &str = "_gt_segmentation.png";
const FURNISHED: &str = "_furnitures.png";

/// Places in rooms.
#[derive(Clone, Copy, Default)]
struct Places {
    rooms: usize,
    with_place: usize,
    places: usize,
}

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let heads = ["", "MCC", "precision", "recall", "F1", "regions", "rooms with a place", "places a room"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for ending in [".png", FURNISHED] {
        let (mut all, mut sum) = (Vec::new(), Places::default());
        for name in names(folder)? {
            let plan = folder.join(format!("{name}{ending}"));
            if !plan.exists() {
                continue;
            }
            let rooms = truth(folder, &name)?;
            let grid = read_floor_plan(&plan, RESOLUTION)?;
            let map = RegionMap::new(&grid, &RegionOptions::default())?;
            let (agreement, places) = (Agreement::of(&map, &rooms), places(&grid, &map, &rooms));
            rows.push(row(
                plan.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
                &agreement,
                places,
            ));
            all.push(agreement);
            sum.rooms += places.rooms;
            sum.with_place += places.with_place;
            sum.places += places.places;
        }
        let name = if ending == FURNISHED { "mean, furnished" } else { "mean" };
        rows.push(row(name.to_owned(), &Agreement::mean(&all), sum));
    }
    Ok(format!("regions of floor plans against their true rooms\n{}", aligned(&rows)))
}

fn row(name: String, agreement: &Agreement, places: Places) -> Vec<String> {
    let [mcc, precision, recall, f1, regions] = agreement.cells();
    let with_place = format!("{:.1}%", 100.0 * places.with_place as f64 / places.rooms as f64);
    let a_room = format!("{:.2}", places.places as f64 / places.rooms as f64);
    vec![name, mcc, precision, recall, f1, regions, with_place, a_room]
}

/// The plans that have a truth.
pub(crate) fn names(folder: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        names.extend(name.strip_suffix(TRUTH).map(str::to_owned));
    }
    names.sort();
    Ok(names)
}

/// The true rooms of a plan: white areas that lines part, however faint.
pub(crate) fn truth(folder: &Path, name: &str) -> Result<Rooms, Box<dyn Error>> {
    let image = std::fs::canonicalize(folder.join(format!("{name}{TRUTH}")))?;
    let yaml: PathBuf = std::env::temp_dir().join(format!("hssh-rooms-{}.yaml", std::process::id()));
    let text = format!(
        "image: {}\nresolution: {RESOLUTION}\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.019\n",
        image.display()
    );
    std::fs::write(&yaml, text)?;
    let grid = read_map(&yaml);
    std::fs::remove_file(&yaml)?;
    Ok(Rooms::of(&grid?))
}

fn places(grid: &OccupancyGrid, map: &RegionMap, rooms: &Rooms) -> Places {
    let roadmap = Roadmap::new(grid, map, &RoadmapOptions::default());
    let mut count = vec![0; rooms.count];
    for place in &roadmap.places {
        let cell = map.lattice().cell_at(place.center);
        if let Some(room) = cell.and_then(|cell| rooms.room_of[map.lattice().index(cell)]) {
            count[room as usize] += 1;
        }
    }
    Places {
        rooms: rooms.count,
        with_place: count.iter().filter(|&&places| places > 0).count(),
        places: count.iter().sum(),
    }
}
