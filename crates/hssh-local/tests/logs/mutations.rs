//! Damaged logs and maps: whatever the bytes, reading ends with something finite or with an error.

use std::path::PathBuf;

use hssh_local::{LaserLog, read_map};
use proptest::prelude::*;
use proptest::sample::Index;

/// What takes the place of a word: numbers out of all proportion, and what is no number.
const WORDS: [&str; 14] = [
    "1e308",
    "-1e308",
    "1e15",
    "inf",
    "nan",
    "-1",
    "0",
    "",
    "x",
    "\u{feff}",
    "99999999999999999999",
    "-0",
    "FLASER",
    "1e-308",
];

/// A log of a short drive: 12 scans of 9 beams, with odometry in between and parameters at both ends.
fn log() -> String {
    let scan = |index: u32| {
        let ranges: Vec<String> = (0..9).map(|beam| format!("{:.2}", 2.0 + f64::from(beam % 4))).collect();
        let x = 0.3 * f64::from(index);
        format!(
            "ODOM {x} 0 0 0 0 0 {index} h {index}\nFLASER 9 {} {x} 0 0 {x} 0 0.01 {index} h {index}\n",
            ranges.join(" ")
        )
    };
    let scans: String = (0..12).map(scan).collect();
    format!("PARAM robot_frontlaser_offset 0.1 h 0\n{scans}PARAM robot_front_laser_max 20 h 0\n")
}

/// Some of its words replaced, and some of its bytes.
fn damaged(text: &str, words: &[(Index, Index)], bytes: &[(Index, u8)], cut: Option<Index>) -> Vec<u8> {
    let mut parts: Vec<&str> = text.split_inclusive([' ', '\n']).collect();
    for (at, word) in words {
        let at = at.index(parts.len());
        parts[at] = WORDS[word.index(WORDS.len())];
    }
    let mut damaged = parts.join(" ").into_bytes();
    for (at, byte) in bytes {
        let at = at.index(damaged.len());
        damaged[at] = *byte;
    }
    if let Some(cut) = cut {
        damaged.truncate(cut.index(damaged.len()));
    }
    damaged
}

/// Words to be replaced and by which, bytes likewise, and where the text ends.
type Damage = (Vec<(Index, Index)>, Vec<(Index, u8)>, Option<Index>);

fn damage() -> impl Strategy<Value = Damage> {
    let words = prop::collection::vec(any::<(Index, Index)>(), 0..4);
    let bytes = prop::collection::vec(any::<(Index, u8)>(), 0..3);
    (words, bytes, prop::option::weighted(0.2, any::<Index>()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn damaged_logs_are_read_or_refused((words, bytes, cut) in damage()) {
        match LaserLog::read(&damaged(&log(), &words, &bytes, cut)[..]) {
            Ok(log) => {
                prop_assert!(log.trajectory.iter().all(|pose| pose.is_finite()));
                prop_assert!(log.max_range.is_finite() && log.max_range > 0.0);
                prop_assert!(log.scans.iter().any(|scan| scan.scan.ranges.len() == log.beams()));
                prop_assert!(log.scans.iter().all(|scan| log.trajectory[scan.moment] == scan.odometry));
                prop_assert!(log.warnings.iter().all(|warning| warning.to_string().len() < 600));
            }
            Err(error) => prop_assert!(error.to_string().len() < 1200),
        }
    }

    #[test]
    fn damaged_maps_are_read_or_refused((words, bytes, cut) in damage(), is_image in any::<bool>()) {
        let folder: PathBuf = std::env::temp_dir().join(format!("hssh-mutations-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let yaml = "image: a.pgm\nresolution: 0.05\norigin: [ 1 , 2 , 0 ]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
        let image = "P2 \n4 3 \n255 \n0 254 205 1 \n0 254 205 1 \n0 254 205 1 \n";
        let damaged = damaged(if is_image { image } else { yaml }, &words, &bytes, cut);
        std::fs::write(folder.join("a.yaml"), if is_image { yaml.as_bytes() } else { &damaged }).unwrap();
        std::fs::write(folder.join("a.pgm"), if is_image { &damaged } else { image.as_bytes() }).unwrap();
        match read_map(&folder.join("a.yaml")) {
            Ok(grid) => prop_assert!(grid.lattice().resolution().is_finite()),
            Err(error) => prop_assert!(!error.to_string().contains("panicked")),
        }
        let _ = std::fs::remove_dir_all(&folder);
    }
}
