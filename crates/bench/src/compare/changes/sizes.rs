//! Part 2: how long a repair takes, by the size of the change and of the map.

use std::time::Instant;

use mediant::{Engine, Map, Motion, Rectangle, Setup, Space};
use mediant_grid::{Grid, Vertex};
use mediant_moves::K;
use mediant_oracle::Rng;
use mediant_report::{Row, stats::median};

use super::{Part, contestant::Follower, maps::Kind, text};
use crate::compare::CompareError;

const SIDES: [u32; 3] = [512, 1_024, 2_048];
/// So many places change and become as they were.
const PLACES: usize = 10;

/// A change of the study.
#[derive(Clone, Copy)]
enum Size {
    /// A square of so many cells a side is blocked.
    Square(u32),
    /// So many scattered cells become what they were not.
    Scattered(u32),
}

impl Size {
    const ALL: [Self; 4] = [Self::Square(1), Self::Square(10), Self::Square(100), Self::Scattered(500)];

    fn name(self) -> String {
        match self {
            Self::Square(1) => "1 cell".to_owned(),
            Self::Square(side) => format!("{side} × {side}"),
            Self::Scattered(count) => format!("{count} scattered"),
        }
    }
}

/// The cells of a change, to be blocked or given back.
enum Place {
    Square(Rectangle),
    Cells(Vec<Vertex>),
}

impl Place {
    fn new(size: Size, side: u32, rng: &mut Rng) -> Self {
        match size {
            Size::Square(length) => {
                let [x, y] = [(); 2].map(|()| rng.below(side - length + 1));
                Self::Square(Rectangle::new(x, y, length, length))
            }
            Size::Scattered(count) => {
                let cell = |_| (rng.below(side) as i32, rng.below(side) as i32).into();
                Self::Cells((0..count).map(cell).collect())
            }
        }
    }

    /// Changes the cells, or gives them back as they were on `before`.
    fn edit(&self, space: &Space, before: &Grid, back: bool) -> Result<mediant::Change, mediant::Error> {
        match self {
            Self::Square(at) => space.edit(*at, |x, y| !back || before.is_blocked(x as i32, y as i32)),
            Self::Cells(cells) => {
                space.edit_cells(cells.iter().map(|&at| (at, before.is_blocked(at.x, at.y) == back)))
            }
        }
    }
}

/// The rows of both kinds of maps.
pub(super) fn measure() -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for (kind, side) in Kind::ALL.into_iter().flat_map(|kind| SIDES.map(|side| (kind, side))) {
        let map = kind.map(side)?;
        for (engine, motion) in [
            (Engine::Canonical, Motion::centers(K::N8)),
            (Engine::JpsBlock, Motion::centers(K::N8)),
            (Engine::JpsPlus, Motion::centers(K::N8)),
            (Engine::Hpa, Motion::centers(K::N8)),
            (Engine::Anya, Motion::corners(K::ANY)),
        ] {
            rows.extend(of_engine(&kind.name(side), &map, Setup::new(engine, motion))?);
        }
    }
    Ok(rows)
}

fn of_engine(name: &str, map: &Map, setup: Setup) -> Result<Vec<Row>, CompareError> {
    let micros = |start: Instant| start.elapsed().as_secs_f64() * 1e6;
    let anew = || {
        let start = Instant::now();
        let follower = Follower::new(map, setup)?;
        Ok::<_, CompareError>((follower, micros(start)))
    };
    let ((mut follower, first), (_, second)) = (anew()?, anew()?);
    let (mut rng, before) = (Rng::new(super::SEED), map.grid());
    // Memory is warm, and the arrays that edits take turns in are there.
    let warm = Place::new(Size::Square(1), map.width(), &mut rng);
    let ends = super::timelines::connected_ends(&follower.space, &mut rng);
    follower.planner.path(ends.start, ends.goal)?;
    for back in [false, true, false, true] {
        let change = warm.edit(&follower.space, before, back)?;
        follower.follow(&change)?;
    }
    let mut rows = Vec::new();
    for size in Size::ALL {
        let mut times = Vec::new();
        for _ in 0..PLACES {
            let place = Place::new(size, map.width(), &mut rng);
            for back in [false, true] {
                let start = Instant::now();
                let change = place.edit(&follower.space, before, back)?;
                follower.follow(&change)?;
                drop(change);
                times.push(micros(start));
            }
        }
        rows.push(
            Part::Sizes
                .row(name, map)
                .key("motion", text(setup.motion))
                .key("engine", setup.engine.kind())
                .key("size", size.name())
                .with("edit", median(&times))
                .with("worst", times.iter().copied().reduce(f64::max))
                .with("prepared", first.min(second)),
        );
    }
    Ok(rows)
}
