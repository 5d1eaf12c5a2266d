//! Published numbers, compared with ours.

/// A published number, compared with ours.
///
/// ```
/// use mediant_report::{Claim, Verdict};
/// let claim = Claim::new("Table 1", "mean cost", 2.0, Some(2.05));
/// assert_eq!(claim.verdict(), Verdict::Matched);
/// assert_eq!(claim.within(0.01).verdict(), Verdict::Deviates);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Where it is published: a table and column, a figure, a section.
    pub source: String,
    /// The quantity, in words.
    pub what: String,
    /// The number as published.
    pub published: f64,
    /// Our number; `None` if it was not measured.
    pub ours: Option<f64>,
    /// By how much ours may differ, as a fraction of the published number.
    pub tolerance: f64,
    /// The standard error of ours from the random choice of its instances, as a fraction of ours; 0 if the
    /// instances are those of the publication.
    pub standard_error: f64,
    /// Why the numbers differ, if they do: found out, not guessed. One cause a line.
    pub cause: String,
    /// How many digits after the point the numbers are written with.
    pub digits: usize,
    /// The unit that follows the numbers, with its space: ` %`, ` ×`.
    pub unit: String,
    /// Whether it is a time, or a comparison of times: another machine and program have others.
    pub is_time: bool,
}

/// The verdict on our number beside a published one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Ours is within the tolerance.
    Matched,
    /// Ours is not, but differs by no more than the random choice of instances explains: two standard errors
    /// of the difference of two samples.
    WithinSampling,
    /// Ours differs by more.
    Deviates,
    /// Ours was not measured.
    Missing,
}

impl Claim {
    /// A number that was measured on other instances than the publication's: ours may differ by 3 %.
    #[must_use]
    pub fn new(
        source: impl Into<String>,
        what: impl Into<String>,
        published: f64,
        ours: Option<f64>,
    ) -> Self {
        Self {
            source: source.into(),
            what: what.into(),
            published,
            ours,
            tolerance: 0.03,
            standard_error: 0.0,
            cause: String::new(),
            digits: 2,
            unit: String::new(),
            is_time: false,
        }
    }

    /// The same claim with the standard error of ours, as a fraction of ours.
    #[must_use]
    pub fn standard_error(mut self, error: Option<f64>) -> Self {
        self.standard_error = error.unwrap_or(0.0);
        self
    }

    /// The same claim for a number that was measured on the same instances: ours has to agree in all printed
    /// `digits` after the point.
    #[must_use]
    pub fn exact(mut self, digits: usize) -> Self {
        // Half a unit of the last digit, since the publication rounded, and a little for the rounding of f64.
        self.tolerance =
            0.5000001 * 10_f64.powi(-(digits as i32)) / self.published.abs().max(f64::MIN_POSITIVE);
        self.digits = digits;
        self
    }

    /// The same claim with another tolerance, as a fraction of the published number.
    #[must_use]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The same claim with its numbers written with this many digits after the point, followed by `unit`.
    #[must_use]
    pub fn written(mut self, digits: usize, unit: &str) -> Self {
        (self.digits, self.unit) = (digits, unit.to_owned());
        self
    }

    /// The same claim as one of times, if `is_time`.
    #[must_use]
    pub const fn of_times(mut self, is_time: bool) -> Self {
        self.is_time = is_time;
        self
    }

    /// The same claim with the cause of a difference.
    #[must_use]
    pub fn because(mut self, cause: impl Into<String>) -> Self {
        self.cause = cause.into();
        self
    }

    /// By how much ours differs, as a fraction of the published number.
    #[must_use]
    pub fn difference(&self) -> Option<f64> {
        Some(self.ours? / self.published - 1.0)
    }

    /// The verdict on our number beside the published one.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self.difference().map(f64::abs) {
            None => Verdict::Missing,
            Some(difference) if difference <= self.tolerance => Verdict::Matched,
            Some(difference) if difference <= 2.0 * std::f64::consts::SQRT_2 * self.standard_error => {
                Verdict::WithinSampling
            }
            Some(_) => Verdict::Deviates,
        }
    }

    /// A number as the claim writes it.
    #[must_use]
    pub fn text(&self, number: f64) -> String {
        format!("{number:.*}{}", self.digits, self.unit)
    }
}

impl Verdict {
    /// A mark for a table cell.
    #[must_use]
    pub const fn mark(self) -> &'static str {
        match self {
            Self::Matched => "✓",
            Self::WithinSampling => "≈",
            Self::Deviates => "✗",
            Self::Missing => "–",
        }
    }
}

/// The number of claims of each [`Verdict`]: matched, within sampling, deviating, missing.
#[must_use]
pub fn verdicts<'c>(claims: impl IntoIterator<Item = &'c Claim>) -> [usize; 4] {
    let found: Vec<Verdict> = claims.into_iter().map(Claim::verdict).collect();
    let count = |verdict| found.iter().filter(|&&found| found == verdict).count();
    [Verdict::Matched, Verdict::WithinSampling, Verdict::Deviates, Verdict::Missing].map(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_tolerance_and_error() {
        let claim = |ours| Claim::new("Table 1", "cost", 2.0, ours);
        let claims = [
            claim(Some(2.05)),
            claim(Some(2.1)).standard_error(Some(0.02)),
            claim(Some(2.1)).standard_error(Some(0.01)),
            claim(None),
        ];
        let verdict: Vec<&str> = claims.iter().map(|claim| claim.verdict().mark()).collect();
        assert_eq!(verdict, ["✓", "≈", "✗", "–"]);
        assert_eq!(verdicts(&claims), [1, 1, 1, 1]);
        assert_eq!(claim(Some(2.19)).within(0.1).verdict(), Verdict::Matched);
    }

    #[test]
    fn printed_digits() {
        let claim = |ours| Claim::new("Table I", "length", 751.7737, Some(ours)).exact(4).verdict();
        assert_eq!([claim(751.773_74), claim(751.773_66)], [Verdict::Matched; 2]);
        assert_eq!([claim(751.773_8), claim(752.3595)], [Verdict::Deviates; 2]);
        assert_eq!(Claim::new("", "", 19.0, None).written(1, " %").text(18.04), "18.0 %");
    }
}
