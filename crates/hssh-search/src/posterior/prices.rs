//! What so many new places cost at least: the sum of the least prices among the travels that are left.

/// In so many classes prices are told apart.
const CLASSES: usize = 32;

/// The prices of new places in classes of about as many travels each, by travels explained. Each price counts as the least of its class, so
/// that sums are a little too low rather than too high, and take neither time nor memory with the square of the travels.
#[derive(Clone, Debug)]
pub(super) struct Prices {
    /// By class, ascending: the least price.
    least: Vec<f64>,
    /// By travels explained: how many of those left are in each class.
    left: Vec<[u32; CLASSES]>,
}

impl Prices {
    /// By travel: what it costs if it leads to a new place. What is negative counts as nothing.
    pub(super) fn new(prices: &[f64]) -> Self {
        let prices: Vec<f64> = prices.iter().map(|price| price.max(0.0)).collect();
        let mut sorted = prices.clone();
        sorted.sort_by(f64::total_cmp);
        let classes = if sorted.is_empty() { 0 } else { CLASSES };
        let mut least: Vec<f64> = (0..classes).map(|class| sorted[class * sorted.len() / CLASSES]).collect();
        least.dedup();
        let mut left = vec![[0; CLASSES]; prices.len() + 1];
        for (travel, price) in prices.iter().enumerate().rev() {
            left[travel] = left[travel + 1];
            left[travel][least.partition_point(|least| least <= price) - 1] += 1;
        }
        Prices { least, left }
    }

    /// What so many new places cost at least if so many travels are explained.
    pub(super) fn sum(&self, explained: usize, places: u32) -> f64 {
        let (mut open, mut sum) = (places, 0.0);
        for (least, left) in self.least.iter().zip(&self.left[explained]) {
            if open == 0 {
                break;
            }
            let paid = open.min(*left);
            sum += least * f64::from(paid);
            open -= paid;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Never more than the sum of the least prices, and all of it where there are few prices.
    #[test]
    fn sums_are_those_of_the_least_prices() {
        for (travels, is_exact) in [(0, true), (1, true), (20, true), (500, false)] {
            let price = |travel: usize| (travel * 37 % 101) as f64 / 8.0 - 2.0;
            let prices: Vec<f64> = (0..travels).map(price).collect();
            let classes = Prices::new(&prices);
            for explained in 0..=travels {
                let mut ahead: Vec<f64> = prices[explained..].iter().map(|price| price.max(0.0)).collect();
                ahead.sort_by(f64::total_cmp);
                let mut expected = 0.0;
                for places in 0..=ahead.len() {
                    let sum = classes.sum(explained, places as u32);
                    assert!(sum <= expected + 1e-9, "{explained}, {places}: {sum} of {expected}");
                    assert!(sum >= expected - if is_exact { 1e-9 } else { 0.6 * places as f64 });
                    expected += ahead.get(places).copied().unwrap_or(0.0);
                }
            }
        }
    }
}
