use std::fs::File; use std::io::Write;
use hssh_local::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let log = LaserLog::read(File::open(&args[1]).unwrap()).unwrap();
    let start = std::time::Instant::now();
    let track = track(&log, &MatchOptions::default(), |_| ());
    let t1 = start.elapsed().as_secs_f64();
    let mut options = ClosingOptions::default();
    if let Ok(v) = std::env::var("AGREE") { options.least_agreement = v.parse().unwrap(); }
    if let Ok(v) = std::env::var("SCORE") { options.least_score = v.parse().unwrap(); }
    let closed = close_loops(&log, &track, &options, |_| ()).unwrap();
    let t2 = start.elapsed().as_secs_f64();
    eprintln!("{} scans, {:.0} m, track {t1:.1} s, closing {:.1} s, {} closures, {} doubted", log.scans.len(), track.scans.last().unwrap().travelled, t2 - t1, closed.closures.len(), closed.closures.iter().filter(|c| c.weight < 0.5).count());
    let write = |name: &str, poses: &mut dyn Iterator<Item = hssh_metrics::Pose>| {
        let mut file = File::create(format!("{}.{name}.tum", args[2])).unwrap();
        for (i, pose) in poses.enumerate() { writeln!(file, "{i} {} {} 0 0 0 {} {}", pose.x, pose.y, (pose.theta/2.0).sin(), (pose.theta/2.0).cos()).unwrap(); }
    };
    write("raw", &mut log.scans.iter().map(|s| s.odometry));
    write("track", &mut track.scans.iter().map(|s| s.pose));
    write("closed", &mut closed.poses.iter().copied());
}
