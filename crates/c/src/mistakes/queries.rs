//! Queries with wishes, and what their answers may be.

use std::{ffi::CString, rc::Rc};

use super::{
    model::{Begun, End, IndexModel, SpaceModel, inner_of, is_near, length},
    world::World,
};
use crate::{
    answer::Answer,
    code::{Code, PathLimit, PathStatus},
    points::Point,
};

/// The wishes beyond the ends of a path.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wish {
    nearest: bool,
    snap: bool,
    tolerance: f64,
    max_cost: Option<f64>,
    expansions: bool,
    timeout: bool,
}

const NONE: Wish =
    Wish { nearest: false, snap: false, tolerance: 0.0, max_cost: None, expansions: false, timeout: false };

const WISHES: [(&str, Wish); 12] = [
    ("", NONE),
    (" ", NONE),
    ("nearest=false snap=false", NONE),
    ("nearest", Wish { nearest: true, ..NONE }),
    ("snap", Wish { snap: true, ..NONE }),
    ("tolerance=1.5", Wish { tolerance: 1.5, ..NONE }),
    ("max_cost=4.5", Wish { max_cost: Some(4.5), ..NONE }),
    ("max_cost=1e300 timeout=1e300", Wish { max_cost: Some(1e300), timeout: true, ..NONE }),
    ("max_expansions=3", Wish { expansions: true, ..NONE }),
    ("max_expansions=18446744073709551615 tolerance=0", Wish { expansions: true, ..NONE }),
    ("timeout=0", Wish { timeout: true, ..NONE }),
    (
        "nearest snap tolerance=2 max_cost=9",
        Wish { nearest: true, snap: true, tolerance: 2.0, max_cost: Some(9.0), ..NONE },
    ),
];

const BAD: [(&str, Code); 7] = [
    ("tolerance=-1", Code::Argument),
    ("max_cost=nan", Code::Argument),
    ("nearest=perhaps", Code::Argument),
    ("k=3", Code::Argument),
    ("timeout", Code::Argument),
    ("max_expansions=-1", Code::Argument),
    ("max_expansions=some", Code::Argument),
];

impl Begun {
    /// Whether something may stop it before its search.
    pub(super) const fn may_stop(&self) -> bool {
        self.can_stop || self.wish.timeout
    }

    /// Whether its ends may be others than were asked for.
    pub(super) const fn is_moved(&self) -> bool {
        self.wish.snap
    }
}

/// A query that was drawn.
pub(super) struct Asked {
    pub(super) words: CString,
    pub(super) begun: Begun,
}

impl World {
    /// Draws the ends and the wishes of a query.
    pub(super) fn query(&mut self, space: Option<&SpaceModel>) -> Asked {
        let some = |world: &mut Self| {
            let count = [1, 1, 1, 1, 1, 2, 3, 0][world.rng.below(8) as usize];
            (0..count).map(|_| world.point(space)).collect::<Vec<_>>()
        };
        let (starts, goals) = (some(self), some(self));
        let texts = WISHES.map(|(text, _)| text);
        let (words, which) = self.words(&texts, &BAD);
        let wish = which.map_or(NONE, |which| WISHES[which].1);
        for (ends, end) in [(&starts, End::Start), (&goals, End::Goal)] {
            if ends.is_empty() {
                self.wrong(Code::NoEnd);
            }
            for &at in ends {
                let is_number = SpaceModel::known_wrong(at, end).is_empty();
                let may_move = wish.snap || end == End::Goal && (wish.nearest || wish.tolerance > 0.0);
                match space {
                    Some(space) if may_move && is_number => self.maybe(&space.wrong_end(at, end)),
                    space => self.note_end(space, at, end),
                }
            }
        }
        self.log.push(format!("    from {starts:?} to {goals:?}, wishes {words:?}"));
        let begun = Begun { starts, goals, wish, can_stop: false };
        Asked { words, begun }
    }
}

/// Checks an answer: `index` found it in `space`, which is its own or one with other cells.
pub(super) fn check(
    index: &Rc<IndexModel>,
    space: &SpaceModel,
    asked: &Begun,
    answer: &Answer,
    points: &[Point],
) {
    let Begun { starts, goals, wish, .. } = asked;
    let case = || format!("{answer:?} of {asked:?} with {points:?} by {}\n{:?}", index.setup, space.map);
    let pairs = starts.iter().flat_map(|&start| goals.iter().map(move |&goal| (start, goal)));
    let costs = pairs.filter_map(|(start, goal)| space.cost(start, goal));
    let expected = costs.fold(f64::INFINITY, f64::min);
    assert_eq!(answer.point_count, points.len(), "{}", case());
    assert_eq!(answer.status == PathStatus::Stopped, answer.stopped_by != PathLimit::None, "{}", case());
    let is_plain = !wish.snap && wish.tolerance == 0.0;
    // Before its search it has the first start, whatever that is.
    let is_before = answer.status == PathStatus::Stopped && asked.may_stop() && points.len() == 1;
    if let (Some(&first), Some(&last), false) = (points.first(), points.last(), is_before) {
        space.check(points, (first, last), answer.length, false);
        let is_end = |ends: &[Point], at| ends.iter().any(|&end| inner_of(end) == inner_of(at));
        assert!(wish.snap || is_end(starts, first), "{}", case());
        if answer.status == PathStatus::Found && is_plain {
            assert!(is_end(goals, last), "{}", case());
            index.check_path(space, (first, last), points, answer.distance);
            assert!(!index.is_exact() || is_near(answer.distance, expected), "not {expected}: {}", case());
        }
    }
    if index.is_exact() && is_plain {
        let bound = answer.lower_bound;
        assert!(bound <= expected || is_near(bound, expected), "bound of {expected}: {}", case());
    }
    match answer.status {
        PathStatus::Found => {
            assert!(!points.is_empty() && answer.distance.is_finite(), "{}", case());
            let most = wish.max_cost.unwrap_or(f64::INFINITY);
            assert!(answer.distance <= most || is_near(answer.distance, most), "{}", case());
            let last = points[points.len() - 1];
            let near = |goal: &Point| length(&[*goal, last]) <= wish.tolerance + 1e-3;
            assert!(wish.snap || goals.iter().any(near), "{}", case());
        }
        PathStatus::Unreachable => {
            assert!(points.is_empty() && answer.distance == f64::INFINITY, "{}", case());
            assert!(wish.snap || expected == f64::INFINITY, "not {expected}: {}", case());
        }
        PathStatus::Nearest => {
            assert!(wish.nearest && !points.is_empty(), "{}", case());
            assert!(wish.snap || expected == f64::INFINITY, "not {expected}: {}", case());
        }
        PathStatus::Stopped => {
            let may = match answer.stopped_by {
                PathLimit::None => false,
                PathLimit::Cost => {
                    let is_over =
                        wish.max_cost.is_some_and(|most| expected > most || is_near(expected, most));
                    is_over || wish.max_cost.is_some() && !(index.is_exact() && is_plain)
                }
                PathLimit::Expansions => wish.expansions,
                PathLimit::Timeout => wish.timeout,
                PathLimit::Cancelled => asked.can_stop,
            };
            assert!(may && answer.distance.is_nan(), "not {expected}: {}", case());
        }
    }
}
