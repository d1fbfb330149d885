//! The same log as another robot would have kept it: fewer scans, a shorter laser, one that is turned.

use hssh_local::LaserLog;

/// How far the short laser sees, in metres.
const SHORT: f64 = 8.0;

/// What is changed in a log.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Variant {
    AsItIs,
    /// Every second scan is left out.
    Half,
    /// Nothing comes back from farther than 8 m.
    Short,
    /// All beams are one beam to the left of where they are said to be.
    Turned,
}

impl Variant {
    pub(super) const ALL: [Variant; 4] = [Variant::AsItIs, Variant::Half, Variant::Short, Variant::Turned];

    pub(super) fn name(self) -> &'static str {
        match self {
            Variant::AsItIs => "as it is",
            Variant::Half => "every second scan",
            Variant::Short => "8 m",
            Variant::Turned => "turned by a beam",
        }
    }

    /// The changed log.
    pub(super) fn of(self, log: &LaserLog) -> LaserLog {
        let mut log = log.clone();
        match self {
            Variant::AsItIs => {}
            Variant::Half => log.scans = log.scans.into_iter().step_by(2).collect(),
            Variant::Short => {
                log.max_range = log.max_range.min(SHORT);
                for range in log.scans.iter_mut().flat_map(|scan| &mut scan.scan.ranges) {
                    *range = if *range < SHORT { *range } else { f64::INFINITY };
                }
            }
            Variant::Turned => {
                for scan in &mut log.scans {
                    scan.scan.ranges.rotate_right(1);
                    scan.scan.ranges.iter_mut().take(1).for_each(|first| *first = f64::INFINITY);
                }
            }
        }
        log
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log() -> LaserLog {
        let scan = |x: u32| format!("FLASER 3 1.0 9.0 3.0 {x} 0 0 {x} 0 0 {x} nohost {x}\n");
        LaserLog::read((0..3).map(scan).collect::<String>().as_bytes()).unwrap()
    }

    fn ranges(variant: Variant) -> Vec<Vec<f64>> {
        variant.of(&log()).scans.into_iter().map(|scan| scan.scan.ranges).collect()
    }

    #[test]
    fn variants_change_what_they_say() {
        let none = f64::INFINITY;
        assert_eq!(ranges(Variant::AsItIs), vec![vec![1.0, 9.0, 3.0]; 3]);
        assert_eq!(ranges(Variant::Half), vec![vec![1.0, 9.0, 3.0]; 2]);
        assert_eq!(ranges(Variant::Short), vec![vec![1.0, none, 3.0]; 3]);
        assert_eq!(ranges(Variant::Turned), vec![vec![none, 1.0, 9.0]; 3]);
    }
}
