//! The tables that are printed of logs.

use super::Compared;
use super::drift::Drift;
use super::figures::Figures;
use crate::table::aligned;

/// The figures of each log.
pub(super) fn of_logs(all: &[Figures]) -> String {
    let header = [
        "log",
        "scans",
        "m",
        "raw, m",
        "track, m",
        "closed, m",
        "close, m",
        "blur, m",
        "of the reference",
        "recall",
        "precision",
        "visits",
        "places",
        "links",
        "one place",
        "right",
        "probability",
        "survey, s",
        "search, s",
    ];
    let number = |value: Option<f64>, digits: usize| {
        value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
    };
    let row = |log: &Figures| {
        let count = |count: Option<usize>| count.map_or_else(|| "–".to_owned(), |count| count.to_string());
        let mut row = vec![log.name.to_owned(), log.scans.to_string(), format!("{:.0}", log.metres)];
        row.extend(log.off.map(|off| number(off, 2)));
        row.push(number(log.close, 3));
        row.extend(log.blur.map(|blur| number(blur, 3)));
        row.extend([log.revisit_recall, log.revisit_precision].map(|part| number(part, 3)));
        row.push(log.visits.to_string());
        row.extend([log.size.map(|size| size.0), log.size.map(|size| size.1)].map(count));
        row.extend([log.same_place.recall(), log.same_place.precision()].map(|part| number(part, 3)));
        row.push(number(log.probability, 3));
        row.extend(log.seconds.map(|seconds| format!("{seconds:.1}")));
        row
    };
    let rows: Vec<Vec<String>> =
        std::iter::once(header.map(str::to_owned).to_vec()).chain(all.iter().map(row)).collect();
    format!(
        "raw, track, closed: root mean square distance of raw odometry, the matched scans and the closed track from the \
         corrected poses\nclose: mean error of the relative position of scans that are back within 1.5 m; recall: of those \
         back within 1 m, the part that is within 1 m; precision: of those said to be, the part within 3 m\none place: of \
         pairs of visits within 1.5 m, the part with one place; right: of pairs with one place, the part within 4 m\n{}",
        aligned(&rows)
    )
}

/// Trajectories of one log beside one another.
pub(super) fn of_compared(all: &[Compared]) -> String {
    let header =
        ["log", "by", "off, m", "close, m", "blur, m", "relations", "s", "MB"].map(str::to_owned).to_vec();
    let number = |value: Option<f64>, digits: usize| {
        value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
    };
    let row = |one: &Compared| {
        let relations =
            one.relations.map_or_else(|| "–".to_owned(), |[metres, radians]| size(metres, radians));
        let megabytes = one.cost.map(|cost| cost[1]).filter(|&megabytes| megabytes > 0.0);
        vec![
            one.log.to_owned(),
            one.by.clone(),
            number(one.off, 2),
            number(one.close, 3),
            number(one.blur, 3),
            relations,
            number(one.cost.map(|cost| cost[0]), 1),
            number(megabytes, 0),
        ]
    };
    let rows: Vec<Vec<String>> = std::iter::once(header).chain(all.iter().map(row)).collect();
    format!(
        "off and close as above; blur: mean distance of hits at revisits from one another's; relations: mean error against \
         those that were verified by hand; seconds of processor time, and the most memory of the process so far\n{}",
        aligned(&rows)
    )
}

/// The errors of motion over stretches of the way.
pub(super) fn of_drift(all: &[Drift]) -> String {
    let header = ["log", "over, m", "raw", "track", "χ²"].map(str::to_owned).to_vec();
    let row = |drift: &Drift| {
        let [raw, track] = [drift.raw, drift.track].map(|[metres, radians]| size(metres, radians));
        vec![drift.name.to_owned(), format!("{:.0}", drift.stretch), raw, track, format!("{:.1}", drift.chi2)]
    };
    let rows: Vec<Vec<String>> = std::iter::once(header).chain(all.iter().map(row)).collect();
    format!(
        "median error of motion over stretches of the way, and median χ² of the track's (2.4 if covariances are right)\n{}",
        aligned(&rows)
    )
}

fn size(metres: f64, radians: f64) -> String {
    format!("{metres:.3} m {:.2}°", radians.to_degrees())
}
