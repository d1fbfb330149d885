//! Makes `fixtures/aces.ron`: the exploration of section 2.4's building from a laser log of that floor.
//!
//! Places, corridors and visits are given by hand in `logs/aces-topology.txt`. Everything metrical
//! comes from what the robot itself had, `logs/aces.log.gz`: its raw odometry, and one scan per
//! visit that shows how it stands to the walls. The log's corrected poses choose which scan stands
//! for a visit, name the quadrant of the very first heading, and score the result.

mod drive;
mod score;
pub(crate) mod topology;
mod walls;

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::Path;

use hssh_causal::{Exploration, NamedStar, Odometry, Travel};
use hssh_local::{LaserLog, LoggedScan};
use hssh_metrics::{Pose, wrap_angle};
use hssh_world::World;

use drive::Noise;
use topology::{Topology, Visit};

/// One visit as the robot lived it.
struct Stay {
    /// The place's number in the topology.
    place: usize,
    /// The scan that stands for the visit.
    scan: usize,
    /// The robot's heading in the place's frame when it took the scan, from the scan's walls.
    heading: f64,
}

/// Writes the exploration to `out` and returns a table that compares it with the corrected poses.
///
/// `data` is the folder that contains `logs/`. The command is `cargo xtask aces <data>`.
pub(crate) fn make(data: &Path, out: &Path) -> Result<String, Box<dyn Error>> {
    let (text, table) = text_and_table(data)?;
    fs::write(out, text)?;
    Ok(table)
}

fn text_and_table(data: &Path) -> Result<(String, String), Box<dyn Error>> {
    let path = data.join("logs/aces.log.gz");
    let file = fs::File::open(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let log = LaserLog::read(file)?;
    let topology = topology::read(&fs::read_to_string(data.join("logs/aces-topology.txt"))?)?;
    let world = topology.network.to_world()?;
    let stays = stays(&log, &topology)?;
    let odometry = odometry(&log, &stays);
    let exploration = exploration(&world, &stays, &odometry)?;
    let score = score::score(&log, &topology, &stays, &odometry);
    Ok((format!("{}\n{}", comment(&score), exploration.to_ron()), score.table))
}

/// For every visit its scan and the heading read from it.
///
/// Walls tell the heading up to quarter turns. The quarter is the one nearest to the heading at the
/// visit before plus what the raw odometry turned since. At the first visit it is a matter of
/// naming, and taken from the corrected pose so that x is the east of the topology.
fn stays(log: &LaserLog, topology: &Topology) -> Result<Vec<Stay>, Box<dyn Error>> {
    let mut stays: Vec<Stay> = Vec::new();
    for visit in &topology.visits {
        let index = nearest_scan(log, topology, visit)?;
        let scan = &log.scans[index];
        let expected = stays.last().map_or(scan.corrected.theta, |before| {
            before.heading + scan.odometry.theta - log.scans[before.scan].odometry.theta
        });
        let walls = walls::direction(&scan.scan).ok_or_else(|| format!("scan {index} shows no walls"))?;
        let quarters = ((expected + walls) / FRAC_PI_2).round();
        let heading = wrap_angle(quarters * FRAC_PI_2 - walls);
        stays.push(Stay { place: visit.place, scan: index, heading });
    }
    Ok(stays)
}

/// The scan of a visit that was taken nearest to the place's centre.
fn nearest_scan(log: &LaserLog, topology: &Topology, visit: &Visit) -> Result<usize, Box<dyn Error>> {
    let centre = topology.network.crossings[visit.place].position;
    let distance = |scan: &LoggedScan| (scan.corrected.x - centre.x).hypot(scan.corrected.y - centre.y);
    let scans = visit.scans.iter().cloned().flatten().filter(|&index| index < log.scans.len());
    let nearest = scans.min_by(|&a, &b| distance(&log.scans[a]).total_cmp(&distance(&log.scans[b])));
    Ok(nearest.ok_or_else(|| format!("the log has none of the scans {:?}", visit.scans))?)
}

/// The measured relative poses of the places of successive visits.
fn odometry(log: &LaserLog, stays: &[Stay]) -> Vec<Odometry> {
    let noise = Noise::of_this_robot();
    stays
        .windows(2)
        .map(|pair| {
            let [from, to] = [&pair[0], &pair[1]];
            let (first, last) = (log.scans[from.scan].moment, log.scans[to.scan].moment);
            drive::place_to_place(from.heading, &log.trajectory[first..=last], to.heading, &noise)
        })
        .collect()
}

/// The exploration: the route through the topology with nominal bearings and measured odometry.
fn exploration(world: &World, stays: &[Stay], odometry: &[Odometry]) -> Result<Exploration, Box<dyn Error>> {
    let places: Vec<_> = stays.iter().map(|stay| hssh_world::PlaceId(stay.place as u32)).collect();
    let route = world.route_through(&places)?;
    let bare = world.explore(&route)?;
    let travels = bare.travels().iter().zip(odometry);
    let travels = travels.map(|(travel, &odometry)| Travel { odometry: Some(odometry), ..*travel }).collect();
    let star_types = bare.star_types().iter().map(as_seen_between_walls).collect();
    Ok(Exploration::new(star_types, bare.start(), travels)?)
}

/// A star whose corridors run along the walls' two directions, named by shape and open ends.
fn as_seen_between_walls(named: &NamedStar) -> NamedStar {
    let quarters = |bearing: f64| (bearing / FRAC_PI_2).round();
    let nominal = |bearing: f64| wrap_angle(quarters(bearing) * FRAC_PI_2) + 0.0; // no −0
    let letter = |bearing: f64| match quarters(bearing).rem_euclid(4.0) as u32 {
        0 => 'E',
        1 => 'N',
        2 => 'W',
        _ => 'S',
    };
    let open: String =
        named.star.gateways().filter_map(|olp| named.bearings[olp.index()]).map(letter).collect();
    let name = match open.len() {
        2 => format!("L-{open}"),
        3 => format!("T-{open}"),
        _ => "+".to_owned(),
    };
    let bearings = named.bearings.iter().map(|bearing| bearing.map(nominal)).collect();
    NamedStar { name, star: named.star.clone(), bearings }
}

/// What the file says about itself.
fn comment(score: &score::Score) -> String {
    let Noise { distance, heading, turn, position_fix, heading_fix } = Noise::of_this_robot();
    format!(
        "\
// The exploration of the ACES building of section 2.4: 14 travels through nine places.
// Made from a laser log of that floor by `cargo xtask aces <data>`; do not edit.
//
// Stars: by hand. Bearings are nominal: corridors run along the walls, x is east. So star types that
// are turned against one another have names of their own, but are isomorphic: L-ES and L-SW.
//
// Odometry: the place of arrival as seen from the place of departure, from raw wheel odometry between
// the scans taken nearest to the two places' centres (the corrected poses say which these are). A place's
// frame is aligned with the walls around it; the robot's heading in it is read from the walls in that one
// scan, its quarter turn kept by raw odometry since the visit before.
//
// Covariance: compounded to first order over every step of the raw trajectory, in which the distance
// errs by {distance} m/√m and the heading by {heading} rad/√m and {turn} rad/√rad; {position_fix} m along each axis
// and {heading_fix} rad are added for how the robot stands at either place. The first three numbers maximize
// the likelihood of the 14 travels' errors against poses corrected by scan matching (mean χ² {:.2} for
// 3 numbers a travel); the other two are about the root mean square of what the scans show. The heading
// errs to one side, by {:+.3} rad a travel; that is left in.
//
// Headings read from walls differ from the corrected ones by {:.1}° (root mean square), at most {:.1}°.",
        score.mean_chi_squared,
        score.mean_turn,
        score.heading_rms.to_degrees(),
        score.heading_worst.to_degrees(),
    )
}

/// A pose that only turns.
fn turned(theta: f64) -> Pose {
    Pose::new(0.0, 0.0, theta)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIXTURE: &str = include_str!("../../../fixtures/aces.ron");

    #[test]
    fn the_fixture_is_what_the_log_gives() {
        let Some(data) = std::env::var_os("HSSH_DATA") else {
            #[allow(clippy::print_stderr)] // says why nothing was tested
            {
                eprintln!("skipped: set HSSH_DATA to the folder with logs/");
            }
            return;
        };
        assert_eq!(text_and_table(Path::new(&data)).unwrap().0, FIXTURE);
    }

    #[test]
    fn the_fixture_has_the_stars_of_section_2_4() {
        let exploration = Exploration::from_ron(FIXTURE).unwrap();
        assert_eq!(exploration.travels().len(), 14);
        let gateways = |named: &NamedStar| named.star.gateways().count();
        let mut counts: Vec<_> = exploration.star_types().iter().map(gateways).collect();
        counts.sort_unstable();
        assert_eq!(counts, [2, 2, 2, 2, 3, 3, 3, 3, 4]);
        // Corridors of 18 to 24 m between places whose frames are aligned.
        for travel in exploration.travels() {
            let odometry = travel.odometry.unwrap();
            assert!(odometry.theta.abs() < 0.2 && (17.0..25.0).contains(&odometry.x.hypot(odometry.y)));
        }
    }
}
