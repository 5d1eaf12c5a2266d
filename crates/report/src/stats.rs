//! Means, medians, and ratios of means with their standard errors.

/// The arithmetic mean; `None` of no values.
#[must_use]
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The geometric mean of positive values; `None` of no values.
#[must_use]
pub fn geometric_mean(values: &[f64]) -> Option<f64> {
    let logarithms: f64 = values.iter().map(|value| value.ln()).sum();
    (!values.is_empty()).then(|| (logarithms / values.len() as f64).exp())
}

/// The middle value, or the mean of the two in the middle; `None` of no values.
#[must_use]
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.len().checked_sub(1)? / 2, sorted.len() / 2);
    Some(f64::midpoint(sorted[low], sorted[high]))
}

/// The ratio of the means of pairs `(a, b)`, and its standard error, if the pairs are a random sample of
/// many.
///
/// The error is computed from the residuals of `a` against `ratio · b` (Cochran, *Sampling Techniques*, 1977,
/// Section 2.11). `None` of fewer than two pairs, or if the `b` sum to 0.
#[must_use]
pub fn ratio_of_means(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (a, b) = pairs.iter().fold((0.0, 0.0), |(a, b), pair| (a + pair.0, b + pair.1));
    if pairs.len() < 2 || b == 0.0 {
        return None;
    }
    let ratio = a / b;
    let residuals: f64 = pairs.iter().map(|(a, b)| (a - ratio * b).powi(2)).sum();
    let n = pairs.len() as f64;
    Some((ratio, (residuals * n / (n - 1.0)).sqrt() / b.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_none() {
        assert_eq!((mean(&[]), geometric_mean(&[]), median(&[])), (None, None, None));
        assert_eq!((ratio_of_means(&[(1.0, 2.0)]), ratio_of_means(&[(1.0, 0.0); 3])), (None, None));
    }

    #[test]
    fn means_and_medians() {
        assert_eq!(mean(&[1.0, 2.0, 6.0]), Some(3.0));
        assert!((geometric_mean(&[2.0, 8.0]).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!((median(&[9.0]), median(&[9.0, 1.0, 2.0])), (Some(9.0), Some(2.0)));
        assert_eq!(median(&[9.0, 1.0, 2.0, 4.0]), Some(3.0));
    }

    #[test]
    fn ratios_vary_as_their_error_says() {
        // Pairs of the same ratio have no error.
        let (ratio, error) = ratio_of_means(&[(1.0, 2.0), (3.0, 6.0), (2.0, 4.0)]).unwrap();
        assert!((ratio - 0.5).abs() < 1e-12 && error < 1e-12);
        // The ratios of 400 samples of 100 pairs vary by the mean of their errors.
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let samples: Vec<(f64, f64)> = (0..400)
            .map(|_| {
                let pairs: Vec<(f64, f64)> = (0..100)
                    .map(|_| {
                        let b = 1.0 + uniform();
                        (b * (0.5 + uniform()), b)
                    })
                    .collect();
                ratio_of_means(&pairs).unwrap()
            })
            .collect();
        let ratios: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
        let center = mean(&ratios).unwrap();
        let spread =
            mean(&ratios.iter().map(|ratio| (ratio - center).powi(2)).collect::<Vec<_>>()).unwrap().sqrt();
        let said = mean(&samples.iter().map(|sample| sample.1).collect::<Vec<_>>()).unwrap();
        assert!((center - 1.0).abs() < 0.01, "{center}");
        assert!((said / spread - 1.0).abs() < 0.15, "{said} of {spread}");
    }
}
