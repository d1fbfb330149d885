//! What visits look like beyond their stars: how much more alike two visits are than two places at random.

use hssh_topology::Isomorphism;

/// Log-likelihood ratios for pairs of visits to be at one place, by the star isomorphism from the later visit to
/// the earlier one. They come from comparing local maps (section 2.4) or views; where nothing is known, the ratio is 0.
///
/// A hypothesis that takes a visit for an old place gains the ratio of that visit with the place's first
/// one. One that takes it for a new place gains nothing.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Appearance {
    /// By later visit, earlier visit, and rotation of φ.
    ratios: Vec<Vec<Vec<f64>>>,
    /// By visit: the greatest ratio with any earlier one, or 0 if all are negative.
    greatest: Vec<f64>,
}

impl Appearance {
    /// Compares that many visits, the later one first: `ratio(later, earlier, rotation)` for all rotations below `degree`,
    /// the degree of the later visit's star.
    ///
    /// Ratios that are not finite count as 0.
    #[must_use]
    pub fn new(degrees: &[u32], mut ratio: impl FnMut(usize, usize, u32) -> f64) -> Self {
        let mut appearance = Appearance::default();
        for (later, &degree) in degrees.iter().enumerate() {
            let row = (0..later).map(|earlier| (0..degree).map(|turn| ratio(later, earlier, turn)).collect());
            appearance.push(row.collect());
        }
        appearance
    }

    /// Compares one visit more with all before: by earlier visit and rotation, as far as anything is known.
    ///
    /// Ratios that are not finite count as 0.
    pub fn push(&mut self, mut row: Vec<Vec<f64>>) {
        row.iter_mut().flatten().filter(|ratio| !ratio.is_finite()).for_each(|ratio| *ratio = 0.0);
        self.greatest.push(row.iter().flatten().copied().fold(0.0, f64::max));
        self.ratios.push(row);
    }

    /// How many visits were compared.
    #[must_use]
    pub fn visits(&self) -> usize {
        self.ratios.len()
    }

    /// All ratios but 0: later visit, earlier visit, rotation, ratio.
    pub(crate) fn ratios(&self) -> impl Iterator<Item = (usize, usize, usize, f64)> + '_ {
        let rows = self.ratios.iter().enumerate();
        let pairs = rows.flat_map(|(later, row)| row.iter().enumerate().map(move |pair| (later, pair)));
        let all = pairs.flat_map(|(later, (earlier, turns))| {
            turns.iter().enumerate().map(move |(turn, &ratio)| (later, earlier, turn, ratio))
        });
        all.filter(|(.., ratio)| *ratio != 0.0)
    }

    /// What it costs to take a visit for a new place: the gain that is given away. Never negative.
    pub(crate) fn of_new_place(&self, visit: usize) -> f64 {
        self.greatest.get(visit).copied().unwrap_or(0.0)
    }

    /// What it costs to take a visit for the place first seen on an earlier one. Never negative.
    pub(crate) fn of_old_place(&self, visit: usize, first: usize, phi: Isomorphism) -> f64 {
        let ratio = self.ratios.get(visit).and_then(|row| row.get(first)?.get(phi.rotation() as usize));
        self.of_new_place(visit) - ratio.copied().unwrap_or(0.0)
    }
}
