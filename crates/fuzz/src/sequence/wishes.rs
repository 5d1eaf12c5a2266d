//! Wishes that are combined: several ends, a tolerance, what to do where there is no way or an end is
//! blocked, and a limit; and queries that are mistaken.

use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicUsize, Ordering},
};

use mediant::{Answer, Error, ErrorCode, K, Limit, Limits, Point, Query, Vertex, errors::QueryError};

use super::{Run, known::ROOM};
use crate::bytes::Bytes;

/// A query with wishes, as the oracle reads it.
pub(super) struct Wished {
    starts: Vec<Vertex>,
    goals: Vec<Vertex>,
    tolerance: f64,
    nearest: bool,
    snap: bool,
}

/// The pairs of ends between which the best path is sought.
struct Sought {
    pairs: Vec<(Vertex, Vertex)>,
    /// Whether the goals are what is nearest to those of the query.
    is_nearest: bool,
}

/// A deadline that is over at its n-th look.
#[derive(Clone)]
pub(crate) struct NthLook {
    looks: Arc<AtomicUsize>,
    over_at: usize,
}

impl NthLook {
    pub(crate) fn new(bytes: &mut Bytes<'_>) -> Self {
        Self { looks: Arc::default(), over_at: 1 + usize::from(bytes.byte() % 24) }
    }

    pub(crate) fn limits(&self) -> Limits {
        let Self { looks, over_at } = self.clone();
        Limits::new().deadline(move || looks.fetch_add(1, Ordering::Relaxed) + 1 >= over_at)
    }

    /// Whether somebody looked when it was over.
    pub(crate) fn is_heard(&self) -> bool {
        self.looks.load(Ordering::Relaxed) >= self.over_at
    }
}

/// A limit, and what stops by it.
enum Kind {
    None,
    Cost(f64),
    Expansions(u64),
    Flag,
    Look(NthLook),
}

impl Kind {
    fn limits(&self) -> Limits {
        match self {
            Self::None => Limits::new(),
            Self::Cost(most) => Limits::new().cost(*most),
            Self::Expansions(most) => Limits::new().expansions(*most),
            Self::Flag => Limits::new().cancel(Arc::new(AtomicBool::new(true))),
            Self::Look(look) => look.limits(),
        }
    }

    const fn by(&self) -> Option<Limit> {
        match self {
            Self::None => None,
            Self::Cost(_) => Some(Limit::Cost),
            Self::Expansions(_) => Some(Limit::Expansions),
            Self::Flag => Some(Limit::Cancelled),
            Self::Look(_) => Some(Limit::Timeout),
        }
    }
}

impl Wished {
    fn query(&self) -> Query {
        let query = Query::between(self.starts.iter().copied(), self.goals.iter().copied());
        let query = if self.nearest { query.nearest() } else { query };
        let query = if self.snap { query.snap() } else { query };
        if self.tolerance > 0.0 { query.tolerance(self.tolerance) } else { query }
    }

    fn told(&self) -> String {
        let Self { starts, goals, tolerance, nearest, snap } = self;
        format!("path {starts:?} {goals:?}, tolerance {tolerance}, nearest: {nearest}, snap: {snap}")
    }
}

impl Run {
    /// Wishes and ends of any kind, also blocked ones and some outside the map.
    fn wished(&self, bytes: &mut Bytes<'_>) -> Wished {
        let flags = bytes.byte();
        let mut ends = |most: u8| (0..1 + most).map(|_| self.vertex(bytes)).collect();
        let (starts, goals) = (ends(flags & 1), ends(flags >> 1 & 3));
        let tolerance = if flags & 8 == 0 { 0.0 } else { f64::from(bytes.byte() % 8) / 2.0 };
        Wished { starts, goals, tolerance, nearest: flags & 16 != 0, snap: flags & 32 != 0 }
    }

    fn on_map(&self, at: Vertex) -> bool {
        let (width, height) = self.known.size();
        (0..width).contains(&at.x) && (0..height).contains(&at.y)
    }

    /// The free vertex nearest to a place, after it is moved to the map; of several the first row by row.
    fn snapped(&self, at: Vertex) -> Option<Vertex> {
        let at = self.known.clamped(at);
        self.known.free().into_iter().min_by_key(|&free| (self.known.distance(free, at), free.y, free.x))
    }

    /// The free vertices that an end means; the code of the mistake if there is none.
    fn ends_of(&self, wished: &Wished, at: Vertex, is_start: bool) -> Result<Vec<Vertex>, ErrorCode> {
        let reach = wished.tolerance * (1.0 + 1e-9);
        let meant: Vec<Vertex> = if !is_start && wished.tolerance > 0.0 && self.on_map(at) {
            self.known.free().into_iter().filter(|free| free.distance(at) <= reach).collect()
        } else {
            Some(at).filter(|&at| self.known.is_free(at)).into_iter().collect()
        };
        let blocked = if is_start { ErrorCode::StartBlocked } else { ErrorCode::GoalBlocked };
        let outside = if is_start { ErrorCode::StartOutside } else { ErrorCode::GoalOutside };
        if !meant.is_empty() {
            Ok(meant)
        } else if wished.snap {
            self.snapped(at).map(|at| vec![at]).ok_or(blocked)
        } else if !self.on_map(at) {
            Err(outside)
        } else if is_start || !wished.nearest {
            Err(blocked)
        } else {
            Ok(Vec::new())
        }
    }

    /// The pairs that the query asks for; the codes of its mistakes if there are any.
    fn sought(&self, wished: &Wished) -> Result<Sought, Vec<ErrorCode>> {
        let mut codes = Vec::new();
        let mut all = |ends: &[Vertex], is_start: bool| -> Vec<Vertex> {
            let of = |&at: &Vertex| self.ends_of(wished, at, is_start);
            let (found, wrong): (Vec<_>, Vec<_>) = ends.iter().map(of).partition(Result::is_ok);
            codes.extend(wrong.into_iter().filter_map(Result::err));
            found.into_iter().flatten().flatten().collect()
        };
        let (starts, goals) = (all(&wished.starts, true), all(&wished.goals, false));
        if !codes.is_empty() {
            return Err(codes);
        }
        let connected = |from: Vertex, to: Vertex| self.known.cost(from, to).is_some();
        let pairs = |goals: &[Vertex]| -> Vec<(Vertex, Vertex)> {
            let pairs = goals.iter().flat_map(|&to| starts.iter().map(move |&from| (from, to)));
            pairs.filter(|&(from, to)| connected(from, to)).collect()
        };
        let direct = pairs(&goals);
        if !direct.is_empty() || !wished.nearest {
            return Ok(Sought { pairs: direct, is_nearest: false });
        }
        let reached = self.known.free().into_iter();
        let reached: Vec<Vertex> =
            reached.filter(|&at| starts.iter().any(|&start| connected(start, at))).collect();
        let from_goals = |at: Vertex| {
            wished.goals.iter().map(|&goal| self.known.distance(at, self.known.clamped(goal))).min()
        };
        let least = reached.iter().filter_map(|&at| from_goals(at)).min();
        let near: Vec<Vertex> = reached.into_iter().filter(|&at| from_goals(at) == least).collect();
        Ok(Sought { pairs: pairs(&near), is_nearest: true })
    }

    fn kind(&self, bytes: &mut Bytes<'_>, sought: Option<&Sought>) -> Kind {
        let (which, number) = (bytes.byte(), bytes.byte());
        let least = sought.and_then(|sought| self.known.best(&sought.pairs));
        match which % 8 {
            0 => {
                let part = [1.0, 1.0 - 1e-6, 1.0 + 1e-6, 0.5][usize::from(number) % 4];
                Kind::Cost(least.unwrap_or(3.0) * part)
            }
            1 => Kind::Expansions(u64::from(number % 32)),
            2 => Kind::Flag,
            3 | 4 => Kind::Look(NthLook::new(&mut Bytes::new(&[number]))),
            _ => Kind::None,
        }
    }

    /// A query with wishes of all kinds, at once and in steps.
    pub(super) fn wish(&mut self, bytes: &mut Bytes<'_>) {
        let wished = self.wished(bytes);
        let sought = self.sought(&wished);
        let kind = self.kind(bytes, sought.as_ref().ok());
        let expansions = u64::from(1 + bytes.byte() % 7);
        self.say(&format!("{}, within {:?}", wished.told(), kind.limits()));
        let query = wished.query().within(kind.limits());
        let answer = self.planner.find(query.clone());
        match &sought {
            Ok(sought) => self.check_wish(answer.clone(), sought, &kind),
            Err(codes) => {
                let code = answer.clone().map_err(|error| Error::from(error).code());
                let is_right = code.as_ref().is_err_and(|code| codes.contains(code));
                self.check(is_right, || format!("{code:?}, not one of {codes:?}"));
            }
        }
        if !matches!(kind, Kind::Look(_)) {
            self.say(&format!("in steps of {expansions}"));
            let in_steps = self.in_steps(&query, expansions);
            self.check(in_steps == answer, || format!("{in_steps:?}, not {answer:?}"));
        }
    }

    fn in_steps(&mut self, query: &Query, expansions: u64) -> Result<Answer, QueryError> {
        self.planner.begin(query)?;
        loop {
            if let Some(answer) = self.planner.step(expansions)? {
                return Ok(answer);
            }
        }
    }

    fn check_wish(&mut self, answer: Result<Answer, QueryError>, sought: &Sought, kind: &Kind) {
        if let Kind::Look(look) = kind {
            let is_stopped = matches!(answer, Ok(Answer::Stopped(_)));
            self.check(is_stopped == look.is_heard(), || {
                format!("heard at its deadline: {}, but {answer:?}", look.is_heard())
            });
        }
        match answer {
            Ok(Answer::Stopped(stopped)) => {
                self.check(Some(stopped.by) == kind.by(), || format!("{stopped:?}"));
                let least = self.known.best(&sought.pairs).filter(|_| self.guarantee().is_optimal());
                if let Some(least) = least {
                    let bound = stopped.lower_bound;
                    self.check(bound <= least * (1.0 + ROOM), || format!("at least {bound}, not {least}"));
                    let is_within = matches!(kind, Kind::Cost(most) if least <= most * (1.0 - 1e-9));
                    self.check(!is_within, || format!("{least} is within the limit"));
                }
                let best = stopped.best;
                self.check(self.known.holds(&best), || format!("{best} is not legal"));
            }
            Ok(Answer::Nearest(path)) => {
                self.check(sought.is_nearest, || format!("{path}, though there is a path"));
                self.check_path(&path, &sought.pairs);
                self.check_within(kind, path.cost());
            }
            Ok(Answer::Found(path)) => {
                self.check(!sought.is_nearest, || format!("{path}, though there is no path"));
                self.check_path(&path, &sought.pairs);
                self.check_within(kind, path.cost());
            }
            answer => self.check_answer(answer, &sought.pairs),
        }
    }

    fn check_within(&self, kind: &Kind, cost: f64) {
        if let Kind::Cost(most) = *kind {
            self.check(cost <= most * (1.0 + ROOM), || format!("{cost} is not within {most}"));
        }
    }

    /// A question that must be refused, with its code; the planner answers afterwards.
    pub(super) fn mistake(&mut self, bytes: &mut Bytes<'_>) {
        let (which, at) = (bytes.byte(), self.vertex(bytes));
        let none: [Vertex; 0] = [];
        let between = Point::from_parts(512, 512);
        let ask = |run: &mut Self, query: Query| run.planner.find(query).err().map(Error::from);
        let (what, error, code) = match which % 8 {
            0 => ("tolerance", ask(self, Query::new(at, at).tolerance(-1.0)), ErrorCode::Number),
            1 => ("tolerance", ask(self, Query::new(at, at).tolerance(f64::NAN)), ErrorCode::Number),
            2 => ("limit", ask(self, Query::new(at, at).within(Limits::new().cost(-0.5))), ErrorCode::Number),
            3 => ("no start", ask(self, Query::between(none, [at])), ErrorCode::NoEnd),
            4 if self.known.is_free(at) => {
                ("no goal", ask(self, Query::between([at], none).nearest().snap()), ErrorCode::NoEnd)
            }
            5 if self.setup.k() != K::Any => {
                ("between", ask(self, Query::new(between, between).snap()), ErrorCode::Between)
            }
            6 => {
                let _ = self.planner.begin(Query::between(none, none));
                ("step", self.planner.step(9).err().map(Error::from), ErrorCode::NotBegun)
            }
            _ => {
                let cell = Vertex::new(-1 - at.x.abs(), at.y);
                ("edit", self.space.edit_cells([(cell, true)]).err(), ErrorCode::EditOutside)
            }
        };
        self.say(&format!("mistake: {what}, at {at}"));
        let found = error.map(|error| error.code());
        self.check(found == Some(code), || format!("{found:?}, not {code:?}"));
    }
}
