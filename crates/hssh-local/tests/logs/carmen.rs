//! Reading logs: what is in them, what is wrong with them, and where.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;
use hssh_local::{LaserLog, LogError, LogWarning};
use hssh_metrics::Pose;

/// Three beams are enough to see everything.
const LOG: &str = "\
# a comment
PARAM robot_front_laser_max 20.0 nohost 0
ODOM 0 0 0 0 0 0 0.1 nohost 0.1
FLASER 3 1.5 20.0 2.5 9 9 9 0.5 0 0.1 0.2 nohost 0.2
RLASER 2 1 1 0 0 0 0 0 0 0.2 nohost 0.2
FLASER 3 1.5 0 2.5 9 9 9 1.0 0 0.1 0.3 nohost 0.3
";

fn read(text: &str) -> Result<LaserLog, LogError> {
    LaserLog::read(text.as_bytes())
}

fn gzip(text: &str) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(text.as_bytes()).unwrap();
    encoder.finish().unwrap()
}

/// The warnings of a log that is right but for one more line at its end.
fn warnings(line: &str) -> Vec<String> {
    let log = read(&format!("{LOG}{line}")).unwrap();
    assert_eq!(log.scans.len(), 2, "{line}");
    log.warnings.iter().map(LogWarning::to_string).collect()
}

#[test]
fn scans_and_raw_odometry_come_out_in_order() {
    let log = read(LOG).unwrap();
    assert_eq!(log.beams(), 3);
    assert_eq!(log.scans[0].scan.ranges, [1.5, f64::INFINITY, 2.5]);
    assert_eq!(log.scans[1].scan.ranges, [1.5, f64::INFINITY, 2.5]);
    assert_eq!(log.scans[0].odometry, Pose::new(0.5, 0.0, 0.1));
    assert_eq!(log.scans[0].corrected, Pose::new(9.0, 9.0, 9.0));
    assert_eq!(log.trajectory.len(), 3);
    assert_eq!((log.scans[0].moment, log.scans[1].moment), (1, 2));
    assert_eq!((log.scans[0].line, log.scans[1].line), (4, 6));
    assert_eq!((log.scans[0].time, log.scans[1].time), (Some(0.2), Some(0.3)));
    assert_eq!((log.skipped["#"], log.skipped["RLASER"]), (1, 1));
    assert!(log.warnings.is_empty());
}

#[test]
fn compressed_or_not_is_all_the_same() {
    assert_eq!(LaserLog::read(&gzip(LOG)[..]).unwrap(), read(LOG).unwrap());
}

#[test]
fn nothing_comes_back_from_fifty_metres_where_the_log_says_nothing() {
    let log = read("FLASER 2 49.9 50 0 0 0 0 0 0 0 h 0\n").unwrap();
    assert_eq!(log.scans[0].scan.ranges, [49.9, f64::INFINITY]);
}

#[test]
fn a_bad_message_is_left_out_with_line_and_word() {
    for (line, expected) in [
        (
            "FLASER 3 1 nan 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: word 4, `nan`, is no finite number",
        ),
        ("FLASER 3 1 1 -2 0 0 0 0 0 0 0 h 0\n", "line 7: FLASER left out: word 5, `-2`, is a negative range"),
        ("FLASER 3 1 1 1x 0 0 0 0 0 0 0 h 0\n", "line 7: FLASER left out: word 5, `1x`, is no finite number"),
        (
            "FLASER 4 1 1 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: the message has 14 words, but 4 beams take 15",
        ),
        (
            "FLASER -1 1 1 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: word 2, `-1`, is no number of beams between 1 and 100000",
        ),
        (
            "FLASER 2 1 1 0 0 0 0 0 0 0 h 0\n",
            "line 7: FLASER left out: the scan has 2 beams, but the scans before it have 3",
        ),
        ("ODOM 1 2\n", "line 7: ODOM left out: the message ends after 3 words, 4 are needed"),
    ] {
        assert_eq!(warnings(line), [expected]);
    }
}

#[test]
fn a_log_that_breaks_off_is_used_up_to_there() {
    let broken = warnings("FLASER 3 1 1");
    assert_eq!(broken.len(), 1);
    assert!(broken[0].starts_with("line 7: the log breaks off here"), "{}", broken[0]);

    let whole = gzip(&LOG.repeat(200));
    let log = LaserLog::read(&whole[..whole.len() / 2]).unwrap();
    assert!((1..400).contains(&log.scans.len()));
    assert!(matches!(log.warnings[..], [LogWarning::BreaksOff { .. }]), "{:?}", log.warnings);
}

#[test]
fn what_is_no_log_of_a_laser_says_so() {
    assert!(matches!(read(""), Err(LogError::Empty)));
    let refusal = |text: &str| read(text).unwrap_err().to_string();
    assert_eq!(
        refusal("ODOM 0 0 0\nROBOTLASER1 0 0 0\n"),
        "the log has no usable laser scan: 2 lines, among them 1 ODOM, 1 `ROBOTLASER1`; a log needs FLASER messages"
    );
    assert!(refusal("FLASER 1 x 0 0 0 0 0 0\n").contains("line 1: FLASER left out: word 3, `x`"));
    assert!(LaserLog::read(&vec![b'a'; 9 << 20][..]).unwrap_err().to_string().contains("no CARMEN log"));
}
