//! Published numbers beside ours.

/// A group of published numbers, all of one table column or one sentence, beside ours.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Where it is published: a table and column, a figure, a section.
    pub source: String,
    /// What is said.
    pub what: String,
    /// The number as published.
    pub published: f64,
    /// Ours; `None` where it was not measured.
    pub ours: Option<f64>,
    /// By how much ours may differ: a part of the published number.
    pub tolerance: f64,
    /// The standard error of ours by the draw of its instances, a part of ours; 0 where the instances are the same.
    pub error: f64,
    /// Why they differ, where they do: found, not guessed. A line a cause.
    pub cause: String,
    /// How the numbers are written: digits after the point, and what follows.
    pub digits: usize,
    /// The unit, with its space: ` %`, ` ×`.
    pub unit: String,
}

/// What becomes of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Ours is within the tolerance.
    Matched,
    /// Ours is not, but within what another draw of the instances makes: two standard errors of the difference of two draws.
    Drawn,
    /// It differs.
    Deviates,
    /// Ours was not measured.
    Missing,
}

impl Claim {
    /// A ratio or another number that was measured on instances that were drawn anew: within 3 %.
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
            error: 0.0,
            cause: String::new(),
            digits: 2,
            unit: String::new(),
        }
    }

    /// With the standard error of ours, a part of it.
    #[must_use]
    pub fn drawn(mut self, error: Option<f64>) -> Self {
        self.error = error.unwrap_or(0.0);
        self
    }

    /// On the same instances: to the printed digits.
    #[must_use]
    pub fn exact(mut self, digits: usize) -> Self {
        // Half a unit of the last digit, and as much again for how the publication may have rounded.
        self.tolerance =
            0.5000001 * 10_f64.powi(-(digits as i32)) / self.published.abs().max(f64::MIN_POSITIVE);
        self.digits = digits;
        self
    }

    /// Within another part of the published number.
    #[must_use]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// How the numbers are written.
    #[must_use]
    pub fn written(mut self, digits: usize, unit: &str) -> Self {
        (self.digits, self.unit) = (digits, unit.to_owned());
        self
    }

    /// Why they differ, should they.
    #[must_use]
    pub fn because(mut self, cause: impl Into<String>) -> Self {
        self.cause = cause.into();
        self
    }

    /// By how much ours differs, a part of the published number.
    #[must_use]
    pub fn difference(&self) -> Option<f64> {
        Some(self.ours? / self.published - 1.0)
    }

    /// What becomes of it.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self.difference().map(f64::abs) {
            None => Verdict::Missing,
            Some(difference) if difference <= self.tolerance => Verdict::Matched,
            Some(difference) if difference <= 2.0 * std::f64::consts::SQRT_2 * self.error => Verdict::Drawn,
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
            Self::Drawn => "≈",
            Self::Deviates => "✗",
            Self::Missing => "–",
        }
    }
}

/// How many of the claims are matched, within the draw, deviating and missing.
#[must_use]
pub fn verdicts(claims: &[Claim]) -> [usize; 4] {
    let count = |verdict| claims.iter().filter(|claim| claim.verdict() == verdict).count();
    [Verdict::Matched, Verdict::Drawn, Verdict::Deviates, Verdict::Missing].map(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_tolerance_and_error() {
        let claim = |ours| Claim::new("Table 1", "cost", 2.0, ours);
        let claims = [
            claim(Some(2.05)),
            claim(Some(2.1)).drawn(Some(0.02)),
            claim(Some(2.1)).drawn(Some(0.01)),
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
