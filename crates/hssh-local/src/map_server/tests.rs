//! Maps survive being written and read, and damaged files are refused by name.

use std::path::PathBuf;

use super::{read_floor_plan, read_map, read_map_with_remarks, write_map, write_png};
use crate::grid::{Lattice, Occupancy, OccupancyGrid};

/// A folder of its own for one test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("hssh-map-server-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Three rows of one kind each, free at the bottom.
fn striped() -> OccupancyGrid {
    let lattice = Lattice::new(5, 3, 0.1, [-2.5, 1.0 / 3.0]).unwrap();
    let kinds = [Occupancy::Free, Occupancy::Unknown, Occupancy::Occupied];
    let cells = lattice.cells().map(|cell| kinds[cell.row as usize]).collect();
    OccupancyGrid::new(lattice, cells).unwrap()
}

#[test]
fn what_is_written_reads_back() {
    let folder = folder("round-trip");
    let grid = striped();
    write_map(&grid, &folder.join("floor.yaml")).unwrap();
    assert_eq!(read_map(&folder.join("floor.yaml")).unwrap(), grid);
    write_png(&grid, &folder.join("floor.png")).unwrap();
    let plan = read_floor_plan(&folder.join("floor.png"), 0.1).unwrap();
    assert_eq!(plan.cells(), grid.cells());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_top_row_of_the_image_is_the_last_row_and_thresholds_decide() {
    let folder = folder("rows");
    std::fs::write(folder.join("a.pgm"), "P2\n# a comment\n2 2\n255\n0 254\n205 100\n").unwrap();
    let yaml = "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    let read = |yaml: &str| {
        std::fs::write(folder.join("a.yaml"), yaml).unwrap();
        read_map(&folder.join("a.yaml"))
    };
    use Occupancy::{Free, Occupied, Unknown};
    let grid = read(yaml).unwrap();
    assert_eq!(grid.cells(), [Unknown, Unknown, Occupied, Free]);
    assert_eq!(grid.lattice().origin(), [1.0, 2.0]);
    assert_eq!(
        read(&yaml.replace("negate: 0", "negate: 1")).unwrap().cells(),
        [Occupied, Unknown, Free, Occupied]
    );
    assert_eq!(read(&format!("{yaml}mode: raw\n")).unwrap().cells(), [Unknown, Occupied, Free, Unknown]);

    let refusal = |yaml: &str| read(yaml).unwrap_err().to_string();
    let turned = refusal(&yaml.replace("2, 0]", "2, 90]"));
    assert!(turned.contains("a.yaml: `origin` turns the map by 90 rad"), "{turned}");
    let missing = refusal(&yaml.replace("resolution: 0.5\n", ""));
    assert!(missing.contains("a.yaml") && missing.contains("resolution"), "{missing}");
    let kind = refusal(&yaml.replace("0.5", "coarse"));
    assert!(kind.contains("a.yaml") && kind.contains("line 2"), "{kind}");
    let nowhere = refusal(&yaml.replace("a.pgm", "b.pgm"));
    assert!(nowhere.contains("a.yaml names the image") && nowhere.contains("b.pgm"), "{nowhere}");
    let thresholds = refusal(&yaml.replace("0.196", "0.9"));
    assert!(thresholds.contains("`free_thresh` is 0.9"), "{thresholds}");
    let size = refusal(&yaml.replace("0.5", "-0.5"));
    assert!(size.contains("a.yaml: the resolution must be a positive number"), "{size}");
    std::fs::remove_dir_all(folder).unwrap();
}

/// What programs write for yes and no, and the mark of the unknown where the threshold would free it.
#[test]
fn every_writer_of_maps_is_understood() {
    let folder = folder("writers");
    use Occupancy::{Free, Occupied, Unknown};
    let image = |grays: &str| std::fs::write(folder.join("a.pgm"), format!("P2 3 1 255 {grays}\n")).unwrap();
    let read = |negate: &str, free: &str| {
        let yaml = format!(
            "\u{feff}image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: {negate}\noccupied_thresh: 0.65\nfree_thresh: {free}\n"
        );
        std::fs::write(folder.join("a.yaml"), yaml).unwrap();
        read_map_with_remarks(&folder.join("a.yaml"))
    };
    image("0 205 254");
    for negate in ["0", "false", "False", "no"] {
        assert_eq!(read(negate, "0.196").unwrap().0.cells(), [Occupied, Unknown, Free], "{negate}");
    }
    for negate in ["1", "true", "TRUE", "yes"] {
        assert_eq!(read(negate, "0.196").unwrap().0.cells(), [Free, Occupied, Occupied], "{negate}");
    }
    let refusal = read("perhaps", "0.196").unwrap_err().to_string();
    assert!(refusal.contains("0, 1, true or false") && refusal.contains("line 4"), "{refusal}");
    assert_eq!(refusal.lines().count(), 1);

    let (grid, remarks) = read("0", "0.25").unwrap();
    assert_eq!(grid.cells(), [Occupied, Unknown, Free]);
    assert!(remarks[0].contains("free_thresh: 0.196"), "{remarks:?}");
    // A drawing in many grays means what it says.
    image("0 205 230");
    let (grid, remarks) = read("0", "0.25").unwrap();
    assert_eq!((grid.cells(), remarks.len()), (&[Occupied, Free, Free][..], 0));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn numbers_out_of_proportion_are_refused() {
    let folder = folder("proportion");
    std::fs::write(folder.join("a.pgm"), "P2 1 1 255 0\n").unwrap();
    let refusal = |resolution: &str, x: &str| {
        let yaml = format!(
            "image: a.pgm\nresolution: {resolution}\norigin: [{x}, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.1\n"
        );
        std::fs::write(folder.join("a.yaml"), yaml).unwrap();
        read_map(&folder.join("a.yaml")).unwrap_err().to_string()
    };
    for resolution in ["1e308", "5000", "1e-9", "0", "-1", ".nan", ".inf"] {
        assert!(refusal(resolution, "0").contains("the resolution must be"), "{resolution}");
    }
    for x in ["1e308", "-1e9", ".inf"] {
        assert!(refusal("0.05", x).contains("the origin must be"), "{x}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn damaged_images_are_refused() {
    let folder = folder("damaged");
    let refusal = |bytes: &[u8]| {
        std::fs::write(folder.join("a.pgm"), bytes).unwrap();
        read_floor_plan(&folder.join("a.pgm"), 0.1).unwrap_err().to_string()
    };
    for bytes in [&b"P5\n100 100\n255\nabc"[..], b"", b"hello", b"P2\n2 2\n255\n1 2 3"] {
        let message = refusal(bytes);
        assert!(
            message.contains("a.pgm: no readable image, PGM (P2, P5), PNG, BMP, JPEG, TIFF or WebP"),
            "{message}"
        );
    }
    let huge = refusal(b"P5\n4000000000 4000000000\n255\n");
    assert!(huge.contains("a.pgm"), "{huge}");
    std::fs::remove_dir_all(folder).unwrap();
}
