//! Bags as `scripts/make-bags.py` writes them by another library: a robot in a room of which the walls are known, so that
//! each beam has to end on one, whatever the laser, its mount and the file are.

use std::path::{Path, PathBuf};

use hssh_io::{GrowingBag, RecordingError, RecordingOptions, bag_account, follow_bag, read_bag};
use hssh_local::LaserLog;
use hssh_metrics::Pose;

fn bag(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/bags").join(name)
}

fn read(name: &str) -> LaserLog {
    read_with(name, &RecordingOptions::default())
}

fn read_with(name: &str, options: &RecordingOptions) -> LaserLog {
    read_bag(&bag(name), options).unwrap_or_else(|error| panic!("{name}: {error}")).log
}

fn warnings(log: &LaserLog) -> String {
    log.warnings.iter().map(|warning| format!("{warning}\n")).collect()
}

/// How far the worst hit is from the walls of the room: x from −2 to 4, y from −2 to 2.
fn off_walls(log: &LaserLog) -> f64 {
    let hits = log.scans.iter().flat_map(|logged| {
        let (scan, pose) = (&logged.scan, logged.odometry);
        scan.hits(50.0).map(move |(_, hit)| pose.translation() + pose.rotation() * hit)
    });
    let off = |[x, y]: [f64; 2]| {
        [x + 2.0, 4.0 - x, y + 2.0, 2.0 - y].map(f64::abs).into_iter().fold(f64::MAX, f64::min)
    };
    hits.map(|hit| off([hit.x, hit.y])).fold(0.0, f64::max)
}

#[test]
fn beams_end_on_walls_in_bags_of_every_kind() {
    let names = [
        "usual",
        "usual/usual.mcap",
        "upside-down",
        "clockwise",
        "all-around",
        "tf-only",
        "two-lasers",
        "sqlite",
        "sqlite/sqlite.db3",
        "sqlite-file",
        "sqlite-file/sqlite-file.db3.zstd",
        "sqlite-message",
        "ros1.bag",
        "ros1-bz2.bag",
        "ros1-lz4.bag",
    ];
    for name in names {
        let log = read(name);
        assert_eq!((log.scans.len(), warnings(&log).as_str()), (6, ""), "{name}");
        assert!(off_walls(&log) < 1e-3, "{name}: {}", off_walls(&log));
        // One beam of each brought nothing.
        assert!(
            log.scans
                .iter()
                .all(|scan| scan.scan.ranges.iter().filter(|range| range.is_infinite()).count() == 1)
        );
        assert!((log.scans[5].odometry.theta - 0.5).abs() < 1e-9, "{name}");
    }
    for name in ["sqlite", "sqlite-file", "sqlite-message", "ros1.bag", "ros1-bz2.bag", "ros1-lz4.bag"] {
        assert_eq!(read(name), read("usual"), "{name}");
    }
}

/// They call their frames alike, and are told apart by the names of topics.
#[test]
fn of_two_robots_each_has_its_own_odometry_and_frames() {
    for (name, odometry) in [("two-robots", "odometry from /robot"), ("two-robots-tf", "odometry from /tf")] {
        let read = |scan: Option<&str>| {
            let options = RecordingOptions { scan: scan.map(str::to_owned), ..RecordingOptions::default() };
            read_bag(&bag(name), &options).unwrap_or_else(|error| panic!("{name}: {error}"))
        };
        let first = read(None);
        assert_eq!((first.log.scans.len(), warnings(&first.log).as_str()), (6, ""), "{name}");
        assert!(off_walls(&first.log) < 1e-3, "{name}: {}", off_walls(&first.log));
        assert!(first.used[1].starts_with(odometry), "{:?}", first.used);
        let second = read(Some("/robot2/scan"));
        // It ended at (−2.9, 2.2), turned by −3.3, and its laser sits half a metre behind the axis.
        let laser = Pose::new(-2.9, 2.2, -3.3).compose(Pose::new(-0.5, 0.0, 0.0));
        let off = laser.between(second.log.scans.last().unwrap().odometry);
        assert!(off.translation().norm() < 1e-6 && off.theta.abs() < 1e-6, "{name}: {off:?}");
    }
    let used = read_bag(&bag("two-robots"), &RecordingOptions::default()).unwrap().used;
    assert!(used[0].ends_with("; not /robot2/scan, which --scan chooses"), "{used:?}");
    assert!(used[1].starts_with("odometry from /robot1/odom"), "{used:?}");
}

#[test]
fn what_is_asked_for_is_used() {
    let rear = RecordingOptions { scan: Some("rear".into()), ..RecordingOptions::default() };
    let log = read_with("two-lasers", &rear);
    assert_eq!(log.beams(), 11);
    assert!(
        warnings(&log).contains("no transform says where the laser's frame `rear_laser` is in `base_link`")
    );
    let both = RecordingOptions { scan: Some("/scan,rear".into()), ..RecordingOptions::default() };
    let merged = read_bag(&bag("two-lasers"), &both).unwrap();
    assert!(merged.used[1].starts_with("merged with scans from /rear"), "{:?}", merged.used);
    assert_eq!(merged.log.scans.len(), 6);
    // One scan for each of the first laser, with nearly all the hits of both.
    assert!(merged.log.scans.iter().all(|scan| scan.scan.view == std::f64::consts::TAU));
    let none = RecordingOptions { odometry: Some("none".into()), ..RecordingOptions::default() };
    assert!(warnings(&read_with("usual", &none)).contains("there is no odometry"));
    let frames = RecordingOptions { odometry: Some("odom".into()), ..RecordingOptions::default() };
    assert_eq!(read_with("tf-only", &frames), read("tf-only"));
    let wrong = RecordingOptions { scan: Some("/front".into()), ..RecordingOptions::default() };
    let error = read_bag(&bag("two-lasers"), &wrong).unwrap_err().to_string();
    assert_eq!(error, "--scan /front: the bag has no scans of that topic; it has /scan, /rear");
}

#[test]
fn the_robot_is_followed_without_odometry() {
    let log = read("scans-only");
    assert!(warnings(&log).contains("there is no odometry"));
    assert_eq!(log.scans.len(), 6);
}

#[test]
fn what_is_doubtful_is_told() {
    let log = read("two-clocks");
    assert!(warnings(&log).contains("two clocks, 5000.0 s apart: the times of recording are used instead"));
    assert!(off_walls(&log) < 1e-3);
    let log = read("backwards");
    assert!(warnings(&log).contains("time runs backwards by 59.5 s at scan 4"), "{}", warnings(&log));
    assert!(off_walls(&log) < 1e-3);
    assert!(warnings(&read("no-mount")).contains("--laser-pose"));
}

#[test]
fn bags_without_a_laser_say_what_they_have() {
    let told = |name: &str| read_bag(&bag(name), &RecordingOptions::default()).unwrap_err().to_string();
    assert!(
        told("clouds").contains("only clouds of points (/points): make scans of them"),
        "{}",
        told("clouds")
    );
    assert!(told("no-laser").contains("it has /odom (nav_msgs/msg/Odometry)"), "{}", told("no-laser"));
    let account = bag_account(&bag("clouds"), &RecordingOptions::default()).unwrap();
    assert!(account.to_string().starts_with("nothing can be used: the bag has no sensor_msgs/LaserScan"));
    let account = bag_account(&bag("two-lasers"), &RecordingOptions::default()).unwrap().to_string();
    assert!(
        account.contains(
            "used:\n  scans from /scan (frame `laser`, 41 beams over 229°); not /rear, which --scan chooses; \
             --scan /scan,/rear merges them"
        ),
        "{account}"
    );
}

/// Wherever a bag is cut or overwritten, it is used as far as it goes or refused in words.
#[test]
fn damaged_bags_are_used_up_to_the_break() {
    let folder = tempfile::tempdir().unwrap();
    let mut partial = 0;
    for name in ["usual/usual.mcap", "sqlite/sqlite.db3", "ros1.bag", "ros1-lz4.bag", "ros1-bz2.bag"] {
        let whole = std::fs::read(bag(name)).unwrap();
        let file = folder.path().join("damaged");
        for part in 0..60 {
            let at = whole.len() * part / 60;
            for overwrite in [false, true] {
                let mut bytes = whole.clone();
                if overwrite {
                    bytes[at..].iter_mut().take(16).for_each(|byte| *byte ^= 0xA5)
                } else {
                    bytes.truncate(at)
                }
                std::fs::write(&file, bytes).unwrap();
                match read_bag(&file, &RecordingOptions::default()) {
                    Ok(read) => {
                        partial += usize::from(read.log.scans.len() < 6 && !read.log.warnings.is_empty())
                    }
                    Err(error) => assert!(!error.to_string().is_empty()),
                }
            }
        }
    }
    assert!(partial > 20, "{partial}");
}

#[test]
fn what_is_no_bag_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let read = |path: &Path| read_bag(path, &RecordingOptions::default()).unwrap_err();
    assert!(matches!(read(&folder.path().join("absent")), RecordingError::Bag(_)));
    assert!(read(folder.path()).to_string().contains("neither a metadata.yaml"));
    std::fs::write(folder.path().join("x.mcap"), b"").unwrap();
    assert!(read(folder.path()).to_string().contains("it is empty"));
    let old = folder.path().join("old.bag");
    std::fs::write(&old, b"#ROSBAG V1.2\n").unwrap();
    assert!(read(&old).to_string().contains("another version"));
    let mut packed = std::fs::read(bag("ros1-lz4.bag")).unwrap();
    let mut at = 0;
    while let Some(found) = packed[at..].windows(15).position(|window| window == b"compression=lz4") {
        at += found + 15;
        packed[at - 3..at].copy_from_slice(b"lz9");
    }
    std::fs::write(&old, packed).unwrap();
    assert!(read(&old).to_string().contains("compressed by `lz9`"), "{}", read(&old));
}

/// However an MCAP file comes through a pipe, in the end its log is that of the file.
#[test]
fn a_bag_that_comes_is_in_the_end_the_bag() {
    /// Gives a few bytes at a time.
    struct Dripping<'a>(&'a [u8]);
    impl std::io::Read for Dripping<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let count = self.0.len().min(buffer.len()).min(97);
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }
    let file = bag("usual/usual.mcap");
    let bytes = std::fs::read(&file).unwrap();
    let mut growing = GrowingBag::new(RecordingOptions::default());
    let mut scans = Vec::new();
    let followed = follow_bag(Path::new("-"), Dripping(&bytes), |change| {
        change(&mut growing);
        scans.push((growing.scans(), growing.log().map_or(0, |log| log.scans.len())));
    });
    followed.unwrap();
    assert!(scans.is_sorted() && scans.iter().all(|(come, settled)| settled <= come));
    assert_eq!(growing.read().unwrap(), read_bag(&file, &RecordingOptions::default()).unwrap());
    assert!(growing.read().unwrap().log.scans.len() > 3);
    let cut = follow_bag(Path::new("-"), &bytes[..bytes.len() / 2], |change| change(&mut growing));
    assert!(cut.is_ok() || matches!(cut, Err(RecordingError::Bag(_))));
}
