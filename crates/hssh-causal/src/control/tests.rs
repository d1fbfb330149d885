//! Laws of the control laws, in corridors and crossings that are known exactly.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;

use super::*;

/// What is seen `y` metres left of the midline of a corridor 2 m wide, looking along `heading`, which ends
/// `end` metres ahead.
fn corridor(y: f64, heading: f64, end: f64) -> Percept {
    let range = |index: u32| {
        let (sin, cos) = (heading + TAU * f64::from(index) / 360.0).sin_cos();
        let side = if sin > 0.0 { (1.0 - y) / sin } else { (1.0 + y) / sin.abs() };
        let front = if cos > 0.0 { end / cos } else { f64::INFINITY };
        side.min(front)
    };
    Percept { ranges: (0..360).map(range).collect(), neighborhood: None }
}

/// What is seen from (x, y) where two corridors of 2 m width cross at the origin.
fn crossing(x: f64, y: f64, heading: f64) -> Percept {
    let range = |index: u32| {
        let (sin, cos) = (heading + TAU * f64::from(index) / 360.0).sin_cos();
        let mut steps = (1..1000).map(|step| 0.02 * f64::from(step));
        let is_free = |r: f64| (x + r * cos).abs() < 1.0 || (y + r * sin).abs() < 1.0;
        steps.find(|&r| !is_free(r)).unwrap_or(f64::INFINITY)
    };
    Percept { ranges: (0..360).map(range).collect(), neighborhood: Some(vicinity(x, y, heading)) }
}

/// The four gateways of the crossing, 1.5 m from its center.
fn vicinity(x: f64, y: f64, heading: f64) -> Vicinity {
    let (sin, cos) = heading.sin_cos();
    let exit = |k: u32| {
        let bearing = f64::from(k) * PI / 2.0;
        let (dx, dy) = (1.5 * bearing.cos() - x, 1.5 * bearing.sin() - y);
        Exit {
            position: [cos * dx + sin * dy, cos * dy - sin * dx],
            bearing: wrapped(bearing - heading),
            width: 2.0,
        }
    };
    Vicinity { number: 0, center: None, gateways: (0..4).map(exit).collect() }
}

fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

/// Where a command of a tenth of a second leads.
fn moved([x, y, heading]: [f64; 3], command: Command) -> [f64; 3] {
    let middle = heading + command.turn * 0.05;
    let way = command.speed * 0.1;
    [x + way * middle.cos(), y + way * middle.sin(), heading + command.turn * 0.1]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// From where the corridor's direction is among those, 60 degrees to either side, in which the law looks for
    /// room: turned farther, and near a wall, it has something in its way and ends.
    #[test]
    fn the_midline_is_reached_and_kept(y in -0.6_f64..0.6, heading in -1.0_f64..1.0) {
        let handling = Handling::default();
        let law = ControlLaw::FollowMidline { width: 2.0 };
        let mut pose = [0.0, y, heading];
        for step in 0..300 {
            let percept = corridor(pose[1], pose[2], 1000.0);
            prop_assert!(law.is_applicable(&percept) && !law.is_finished(&percept, &handling));
            pose = moved(pose, law.command(&percept, &handling));
            prop_assert!(pose[1].abs() < 1.0 - handling.radius, "{pose:?} touches a wall");
            prop_assert!(step < 150 || pose[1].abs() < 0.06, "{pose:?} is off the midline");
        }
        prop_assert!(pose[0] > 10.0, "{pose:?} did not go on");
    }

    #[test]
    fn hill_climbing_ends_in_the_middle(x in -1.0_f64..1.0, y in -0.4_f64..0.4, heading in -PI..PI) {
        let handling = Handling::default();
        let mut pose = [x, y, heading];
        for _ in 0..300 {
            let percept = crossing(pose[0], pose[1], pose[2]);
            prop_assert!(ControlLaw::HillClimb.is_applicable(&percept));
            if ControlLaw::HillClimb.is_finished(&percept, &handling) {
                break;
            }
            pose = moved(pose, ControlLaw::HillClimb.command(&percept, &handling));
        }
        prop_assert!(pose[0].hypot(pose[1]) < 0.15, "{pose:?} is no middle");
    }

    #[test]
    fn a_place_is_left_by_the_gateway_asked_for(gateway in 0_usize..4, heading in -PI..PI) {
        let handling = Handling::default();
        let law = ControlLaw::Leave { neighborhood: 0, gateway };
        let mut pose = [0.0, 0.0, heading];
        for _ in 0..200 {
            let percept = crossing(pose[0], pose[1], pose[2]);
            prop_assert!(law.is_applicable(&percept) && !law.is_finished(&percept, &handling));
            pose = moved(pose, law.command(&percept, &handling));
            if pose[0].hypot(pose[1]) > 2.5 {
                break;
            }
        }
        let out = pose[1].atan2(pose[0]);
        prop_assert!(pose[0].hypot(pose[1]) > 2.5, "{pose:?} is still here");
        prop_assert!(wrapped(out - gateway as f64 * PI / 2.0).abs() < 0.1, "{pose:?} is not beyond {gateway}");
    }
}

/// Where the local model knows the center, the robot climbs to it, though the middle of the crossing has more room.
#[test]
fn hill_climbing_ends_at_the_center_that_is_known() {
    let handling = Handling::default();
    let mut pose = [-1.5, 0.2, 0.4];
    for _ in 0..300 {
        let mut percept = crossing(pose[0], pose[1], pose[2]);
        let (sin, cos) = pose[2].sin_cos();
        let (dx, dy) = (0.3 - pose[0], -0.3 - pose[1]);
        let center = [cos * dx + sin * dy, cos * dy - sin * dx];
        percept.neighborhood = percept.neighborhood.map(|here| Vicinity { center: Some(center), ..here });
        if ControlLaw::HillClimb.is_finished(&percept, &handling) {
            break;
        }
        pose = moved(pose, ControlLaw::HillClimb.command(&percept, &handling));
    }
    assert!((pose[0] - 0.3).hypot(pose[1] + 0.3) < 0.15, "{pose:?}");
}

#[test]
fn the_end_of_a_corridor_ends_the_following() {
    let law = ControlLaw::FollowMidline { width: 2.0 };
    let ends = |distance| law.is_finished(&corridor(0.0, 0.0, distance), &Handling::default());
    assert!(!ends(3.0) && ends(0.4));
}

#[test]
fn another_neighborhood_is_not_left() {
    let here = crossing(0.0, 0.0, 0.0);
    for law in
        [ControlLaw::Leave { neighborhood: 1, gateway: 0 }, ControlLaw::Leave { neighborhood: 0, gateway: 4 }]
    {
        assert!(!law.is_applicable(&here) && law.is_finished(&here, &Handling::default()));
        assert_eq!(law.command(&here, &Handling::default()), Command::REST);
    }
    let vicinity = vicinity(0.0, 0.0, 0.0);
    assert_eq!(travel(&vicinity, 4), None);
    assert_eq!(travel(&vicinity, 2).map(|laws| laws.len()), Some(3));
}
