//! The arguments that say what is asked: the ends of a single query, and what is wished beyond a path between
//! the ends of each.

use std::time::{Duration, Instant};

use clap::Args;
use mediant::{Exceptions, Motion, PlacementKind, Point, PointEnds, Query, Vertex, call::Wishes};

use super::value::{Place, parse_place};
use crate::{
    failure::Failure,
    map::NamedMap,
    terminal::numbers::{count, time},
};

/// The ends of queries, their wishes, and the cells that count otherwise for them.
#[derive(Args, Clone, Debug)]
pub(crate) struct QueryArgs {
    /// The start of a single query: a vertex, at any angle any point, such as 2.03,0.5. Of several (repeat
    /// it), the one with the shortest path is taken
    #[arg(id = "from", long = "from", value_name = "X,Y", requires = "aim")]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    from_places: Vec<Place>,
    /// The goal of a single query, likewise. Of several (repeat it), the one with the shortest path is taken
    #[arg(id = "to", long = "to", value_name = "X,Y", requires = "from")]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    to_places: Vec<Place>,
    /// The ends of paths at the starts, once the map is known.
    #[arg(skip)]
    pub(crate) from: Vec<Point>,
    #[arg(skip)]
    pub(crate) to: Vec<Point>,
    /// With `--world`, how far the starts and the goals were moved to the nearest vertices, at any angle to
    /// the nearest points, in meters, of several the furthest.
    #[arg(skip)]
    pub(crate) moved: Option<[f64; 2]>,
    /// Measure the path of each query without making it: with hub labels this takes less time
    #[arg(long, conflicts_with_all = ["tolerance", "nearest", "snap", "max-cost"])]
    #[arg(conflicts_with_all = ["max-expansions", "timeout"])]
    #[arg(conflicts_with_all = ["distances", "draw", "trace"])]
    pub(crate) distance: bool,
    /// Starts and goals count as free, also where the map has them as blocked: agents mark their own cells
    #[arg(long, conflicts_with_all = ["distance", "distances", "trace"])]
    pub(crate) free_ends: bool,
    /// For these queries, this cell counts as blocked (repeat it), such as that of another agent
    #[arg(long = "block", value_name = "X,Y", conflicts_with_all = ["distance", "distances", "trace"])]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    blocked_places: Vec<Place>,
    /// For these queries, this cell counts as free (repeat it)
    #[arg(long = "unblock", value_name = "X,Y", conflicts_with_all = ["distance", "distances", "trace"])]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    free_places: Vec<Place>,
    /// The cells of `--block` and `--unblock`, once the map is known.
    #[arg(skip)]
    pub(crate) cells: [Vec<Vertex>; 2],
    /// Wishes beyond the ends, with lengths in cells once the map is known.
    #[arg(skip)]
    pub(crate) wishes: Wishes,
}

impl QueryArgs {
    /// Finds the ends of paths at the places that were named, and measures lengths in cells.
    pub(crate) fn on(&self, wishes: &Wishes, map: &NamedMap, motion: Motion) -> Result<Self, Failure> {
        let placement = motion.rules.placement();
        let ends = |places: &[Place]| -> Result<Vec<Point>, Failure> {
            places.iter().map(|&place| map.end(motion, place)).collect()
        };
        let mut asked = self.clone();
        asked.wishes = wishes.clone();
        (asked.from, asked.to) = (ends(&self.from_places)?, ends(&self.to_places)?);
        let cells = |places: &[Place]| -> Result<Vec<Vertex>, Failure> {
            places.iter().map(|&place| map.vertex(PlacementKind::Center, place)).collect()
        };
        asked.cells = [cells(&self.blocked_places)?, cells(&self.free_places)?];
        if let Some(frame) = map.frame {
            if !self.from_places.is_empty() {
                let starts = map.moved(placement, &self.from_places, &asked.from);
                let goals = map.moved(placement, &self.to_places, &asked.to);
                asked.moved = starts.zip(goals).map(Into::into);
            }
            let cells = |meters: f64| frame.cells(meters);
            asked.wishes.tolerance = wishes.tolerance.map(cells);
            asked.wishes.max_cost = wishes.max_cost.map(cells);
        }
        Ok(asked)
    }

    /// The query for the path of a query. Its deadline runs from now on.
    pub(crate) fn between(&self, ends: PointEnds) -> Query {
        let mut limits = self.wishes.limits();
        if let Some(millis) = self.wishes.timeout {
            let begin = Instant::now();
            // So long that no duration holds it is no deadline.
            let span = Duration::try_from_secs_f64(millis / 1e3).unwrap_or(Duration::MAX);
            limits = limits.deadline(move || begin.elapsed() >= span);
        }
        if self.has_several_ends() {
            self.wishes.query(&self.from, &self.to, limits)
        } else {
            self.wishes.query(&[ends.start], &[ends.goal], limits)
        }
    }

    /// The cells that count otherwise than on the map; `None` if none was asked for.
    pub(crate) fn exceptions(&self) -> Option<Exceptions> {
        let [blocked, free] = &self.cells;
        let cells = Exceptions::new().blocked(blocked.iter().copied()).free(free.iter().copied());
        let exceptions = if self.free_ends { cells.free_ends() } else { cells };
        (exceptions != Exceptions::new()).then_some(exceptions)
    }

    /// An option by which cells count otherwise than on the map, if one was given.
    pub(crate) const fn exception(&self) -> Option<&'static str> {
        match (self.free_ends, self.blocked_places.is_empty(), self.free_places.is_empty()) {
            (true, ..) => Some("--free-ends"),
            (_, false, _) => Some("--block"),
            (_, _, false) => Some("--unblock"),
            (false, true, true) => None,
        }
    }

    /// Whether a single query has more than one start or goal.
    pub(crate) const fn has_several_ends(&self) -> bool {
        self.from_places.len() > 1 || self.to_places.len() > 1
    }

    /// The wishes in words, without the coordinates.
    pub(crate) fn in_words(&self) -> Vec<String> {
        let wishes = &self.wishes;
        let several = |ends: &[Point], name| (ends.len() > 1).then(|| format!("{} {name}", ends.len()));
        let several = match (several(&self.from, "starts"), several(&self.to, "goals")) {
            (Some(starts), Some(goals)) => Some(format!("from any of {starts} to any of {goals}")),
            (Some(starts), None) => Some(format!("from any of {starts}")),
            (None, goals) => goals.map(|goals| format!("to any of {goals}")),
        };
        let mut words: Vec<String> = several.into_iter().collect();
        words.extend(wishes.tolerance.map(|cells| format!("within {} of the goal", of_cells(cells))));
        words.extend(self.distance.then(|| "lengths without paths".to_owned()));
        words.extend(wishes.nearest.then(|| "if there is no way, to the nearest vertex".to_owned()));
        words.extend(wishes.snap.then(|| "blocked ends moved to the nearest vertex".to_owned()));
        words.extend(self.free_ends.then(|| "ends count as free".to_owned()));
        let cells = [("blocked", &self.cells[0]), ("free", &self.cells[1])];
        let cells = cells.into_iter().filter(|(_, cells)| !cells.is_empty());
        words.extend(
            cells.map(|(name, cells)| {
                format!("{} {name}", count(cells.len() as u64, "more cell", "more cells"))
            }),
        );
        let limits = [
            wishes.max_cost.map(|cells| format!("cost {cells}")),
            wishes.max_expansions.map(|most| count(most, "expansion", "expansions")),
            wishes.timeout.map(|millis| time(millis * 1e6)),
        ];
        let limits: Vec<String> = limits.into_iter().flatten().collect();
        words.extend(wishes.has_limits().then(|| format!("limits: {}", limits.join(", "))));
        words
    }
}

/// A number of cells in words.
fn of_cells(cells: f64) -> String {
    if cells == 1.0 { "1 cell".to_owned() } else { format!("{cells} cells") }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::args::{Cli, Command, ReadingArgs};

    fn wishes(options: &str) -> QueryArgs {
        let words = "mediant run builtin:cave".split(' ').chain(options.split_whitespace());
        match Cli::try_parse_from(words).map(|cli| cli.command) {
            Ok(Command::Run(run)) => {
                let map = NamedMap::load_ground(&run.map, ReadingArgs::default()).expect("a bundled map");
                run.query.on(run.flags.0.wishes(), &map, Motion::default()).expect("vertices")
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_query_without_wishes_stays_a_query() {
        let ends = PointEnds::new((1, 2), (3, 4));
        for options in ["", "--from 5,6 --to 7,8", "--every 2"] {
            let wishes = wishes(options);
            assert_eq!(wishes.between(ends).as_points(), Some(ends), "{options}");
            assert_eq!(wishes.in_words(), [""; 0], "{options}");
        }
        for options in
            ["--tolerance 1", "--nearest", "--snap", "--max-cost 1", "--max-expansions 0", "--timeout 9"]
        {
            let wishes = wishes(options);
            assert_eq!(wishes.between(ends).as_points(), None, "{options}");
            assert_eq!(wishes.in_words().len(), 1, "{options}");
        }
    }

    #[test]
    fn several_ends_are_in_the_order_of_the_arguments() {
        let wishes = wishes("--from 5,6 --from 1,1 --to 7,8 --to 0,0 --to 9,9");
        let query = wishes.between(PointEnds::new((5, 6), (7, 8)));
        let at = |x, y| Vertex::new(x, y);
        assert_eq!(query.starts(), [at(5, 6), at(1, 1)]);
        assert_eq!(query.goals(), [at(7, 8), at(0, 0), at(9, 9)]);
        assert_eq!(wishes.in_words(), ["from any of 2 starts to any of 3 goals"]);
    }

    #[test]
    fn a_deadline_that_no_clock_reaches_is_none() {
        let wishes = wishes("--timeout 1e300 --tolerance 1");
        assert!(wishes.between(PointEnds::new((0, 0), (1, 1))).as_points().is_none());
        assert_eq!(wishes.in_words()[0], "within 1 cell of the goal");
    }
}
