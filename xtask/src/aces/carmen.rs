//! Reads CARMEN logs: `FLASER n r… x y θ odom_x odom_y odom_θ …` and `ODOM x y θ …`.

use hssh_metrics::Pose;

/// A laser scan and where it was taken.
pub(super) struct Scan {
    /// Metres, from −90° (right) to 90° (left).
    pub(super) ranges: Vec<f64>,
    /// The pose after scan matching: for scoring.
    pub(super) corrected: Pose,
    /// The raw odometry.
    pub(super) raw: Pose,
    /// Its position in [`Log::raw`].
    pub(super) raw_index: usize,
}

/// The scans of a log, and its whole raw trajectory.
pub(super) struct Log {
    pub(super) scans: Vec<Scan>,
    pub(super) raw: Vec<Pose>,
}

impl Scan {
    /// The direction of a beam in radians, counterclockwise from straight ahead.
    pub(super) fn beam_direction(&self, beam: usize) -> f64 {
        let steps = self.ranges.len() - self.ranges.len() % 2; // 181 beams span 180 steps, and so do 180
        (180.0 * beam as f64 / steps as f64 - 90.0).to_radians()
    }
}

/// Reads a log; messages of other kinds are passed over.
pub(super) fn read(text: &str) -> Result<Log, String> {
    let mut log = Log { scans: Vec::new(), raw: Vec::new() };
    for (index, line) in text.lines().enumerate() {
        read_message(line, &mut log).map_err(|problem| format!("log line {}: {problem}", index + 1))?;
    }
    Ok(log)
}

fn read_message(line: &str, log: &mut Log) -> Result<(), String> {
    let mut words = line.split_whitespace();
    match words.next() {
        Some("FLASER") => {
            let beams = words.next().and_then(|word| word.parse().ok()).ok_or("no number of beams")?;
            let ranges = (0..beams).map(|_| number(words.next())).collect::<Result<Vec<f64>, _>>()?;
            let corrected = pose(&mut words)?;
            let raw = pose(&mut words)?;
            log.scans.push(Scan { ranges, corrected, raw, raw_index: log.raw.len() });
            log.raw.push(raw);
        }
        Some("ODOM") => log.raw.push(pose(&mut words)?),
        _ => {}
    }
    Ok(())
}

fn pose<'a>(words: &mut impl Iterator<Item = &'a str>) -> Result<Pose, String> {
    Ok(Pose::new(number(words.next())?, number(words.next())?, number(words.next())?))
}

fn number(word: Option<&str>) -> Result<f64, String> {
    let word = word.ok_or("the message ends too early")?;
    let value: Option<f64> = word.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| format!("`{word}` is no finite number"))
}
