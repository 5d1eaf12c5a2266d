//! Fields that follow chains of changes, against new ones.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Interrupt, Placement,
    Rules, Vertex,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, on_all_cores, random_change, random_free_vertex, rooms, seeds, suite_grid};
use mediant_search::{AnyAngleFields, CanonicalRule, Field, FieldError, FieldQuery, Fields, Pruning};

type Graph<P> = Arc<GridGraph<P>>;

/// The fate of a field.
#[derive(Clone, Copy, Debug, Default)]
struct Told {
    repaired: u64,
    anew: u64,
    refused: u64,
    /// Distances that a repair changed.
    changed: u64,
}

impl Told {
    fn plus(self, other: Self) -> Self {
        Self {
            repaired: self.repaired + other.repaired,
            anew: self.anew + other.anew,
            refused: self.refused + other.refused,
            changed: self.changed + other.changed,
        }
    }
}

fn makers<P: Placement>(graph: &Graph<P>, rule: &Arc<CanonicalRule<P>>) -> Fields<Graph<P>, P> {
    let pruning = Pruning::with_rule(graph, Arc::clone(rule)).unwrap();
    Fields::with_pruning(Arc::clone(graph), Arc::new(pruning)).unwrap()
}

/// A query with the sources, and at random a limit or vertices at which the field ends.
struct Asked {
    sources: Vec<Vertex>,
    until: Vec<Vertex>,
    limit: f64,
}

impl Asked {
    fn random(rng: &mut Rng, grid: &Grid, kind: mediant_grid::PlacementKind) -> Self {
        let mut free = |count: u32| (0..count).filter_map(|_| random_free_vertex(rng, grid, kind)).collect();
        let (sources, until) = (free(1), free(2));
        let mut asked = Self { sources, until, limit: f64::INFINITY };
        match rng.below(4) {
            0 => asked.limit = f64::from(rng.below(20)) * 0.75,
            1 => return asked,
            2 => {
                let more = (0..4).filter_map(|_| random_free_vertex(rng, grid, kind));
                asked.sources.extend(more);
            }
            _ => {}
        }
        asked.until.clear();
        asked
    }

    fn query(&self) -> FieldQuery<'_> {
        FieldQuery::new(&self.sources).within(self.limit).until(&self.until)
    }
}

fn check_chain<P: Placement>(
    seed: u64,
    rule: P::Rule,
    canonical: &Arc<CanonicalRule<P>>,
    k: FiniteK,
) -> Told {
    let (mut rng, mut told) = (Rng::new(seed ^ 0xF01D), Told::default());
    let grid = match seed % 5 {
        4 => rooms(&mut rng, 50, 40),
        _ => suite_grid(seed).0,
    };
    let mut graph = Arc::new(GridGraph::<P>::new(Arc::new(grid), k, rule).unwrap());
    let asked = Asked::random(&mut rng, graph.grid(), P::KIND);
    let query = asked.query();
    let Ok(mut field) = makers(&graph, canonical).field(query) else { return told };
    let first = field.clone();
    for step in 0..20 {
        let change = random_change(&mut rng, graph.grid());
        let after = Arc::new(GridGraph::in_space(&graph.after(&change), k).unwrap());
        let mut fields = makers(&after, canonical);
        let message = format!(
            "seed {seed}, {}, k = {k}, {query:?}, change {step}: {:?}",
            graph.rules(),
            change.cells()
        );
        let new = fields.field(query);
        let repaired = field.repaired(Arc::clone(&after), &change, &Interrupt::NEVER);
        let next = match (repaired, new) {
            (Err(error), Err(expected)) => {
                assert_eq!(error, expected, "{message}");
                let error = fields.again(&field, &Interrupt::NEVER).err();
                assert_eq!(error, Some(expected), "{message}");
                told.refused += 1;
                continue;
            }
            (Ok(repaired), Ok(new)) => {
                let next = repaired.unwrap_or_else(|| {
                    told.anew += 1;
                    fields.again(&field, &Interrupt::NEVER).unwrap()
                });
                check_same(&next, &new, &message);
                next
            }
            (repaired, new) => panic!("{message}: {repaired:?}, new {new:?}"),
        };
        told.repaired += 1;
        told.changed += next.costs().iter().zip(field.costs()).filter(|(a, b)| a != b).count() as u64;
        (field, graph) = (next, after);
    }
    // Nothing that was made of it has changed the first one.
    let again = makers(&Arc::new(first.graph().clone()), canonical).field(query).unwrap();
    assert!(first.costs() == again.costs(), "seed {seed}");
    told.repaired -= told.anew;
    told
}

fn check_same<P: Placement>(field: &Field<Graph<P>>, new: &Field<Graph<P>>, message: &str) {
    assert_eq!((field.identity(), field.query()), (new.identity(), new.query()), "{message}");
    for (id, (cost, expected)) in (0..).zip(field.costs().iter().zip(new.costs())) {
        let at = new.graph().vertex(mediant_grid::VertexId(id));
        assert_eq!(cost, expected, "{message}: at {at}");
    }
}

fn check_rules(rules: Rules, k: u32, maps: u64) -> Told {
    fn on<P: Placement>(rule: P::Rule, k: u32, maps: u64) -> Told {
        let k = FiniteK::new(k).unwrap();
        let canonical = Arc::new(CanonicalRule::<P>::new(k, rule));
        let told = on_all_cores(seeds(maps), |seed| check_chain::<P>(seed, rule, &canonical, k));
        told.into_iter().fold(Told::default(), Told::plus)
    }
    match rules {
        Rules::Center(rule) => on::<Centers>(rule, k, maps),
        Rules::Corner(rule) | Rules::CenterGap(rule) => on::<Corners>(rule, k, maps),
    }
}

#[test]
fn fields_follow_chains_of_changes() {
    for rules in Rules::ALL {
        let mut told = Told::default();
        for (k, maps) in [(2, 24), (3, 24), (4, 12), (5, 8)] {
            told = told.plus(check_rules(rules, k, maps));
        }
        let maps = seeds(40).end;
        assert!(told.repaired > 3 * maps && told.anew > maps / 4 && told.refused > maps / 4, "{told:?}");
        assert!(told.changed > 100 * maps, "{told:?}");
    }
}

#[test]
fn fields_of_large_k_follow_changes() {
    for (rules, k) in [(Rules::Corner(DiagonalGap::Closed), 6), (Rules::Center(CornerRule::One), 7)] {
        check_rules(rules, k, 2);
    }
}

/// Each cell of all maps of nine cells, where the oddest gaps are, from each vertex.
#[test]
fn fields_on_maps_of_nine_cells_follow_each_cell() {
    let map = |cells: u32| Arc::new(Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).unwrap());
    let mut repaired = 0;
    for (k, step) in [(2, 1), (3, 7)] {
        let k = FiniteK::new(k).unwrap();
        let graph = |cells: u32| {
            let graph = GridGraph::<Corners>::new(map(cells), k, DiagonalGap::Closed).unwrap();
            Arc::new(graph)
        };
        let graphs: Vec<_> = (0..1 << 9).map(graph).collect();
        for (cells, graph) in (0..).zip(&graphs).step_by(step) {
            let sources = (0..16).map(|at| Vertex::new(at % 4, at / 4));
            for source in sources.filter(|&at| graph.is_free(at)) {
                let field = Fields::new(Arc::clone(graph)).field(FieldQuery::new(&[source])).unwrap();
                for cell in (source.x.cast_unsigned() % 2..9).step_by(2) {
                    let after = &graphs[cells ^ 1 << cell];
                    let change = Change::between(Arc::clone(graph.grid()), Arc::clone(after.grid())).unwrap();
                    let new = Fields::new(Arc::clone(after)).field(FieldQuery::new(&[source]));
                    let found = field.repaired(Arc::clone(after), &change, &Interrupt::NEVER);
                    let message = format!("map {cells:#o}, cell {cell}, k = {k}, from {source}");
                    match (found, new) {
                        (Ok(Some(found)), Ok(new)) => check_same(&found, &new, &message),
                        (found, new) => assert_eq!(found.err(), new.err(), "{message}"),
                    }
                    repaired += 1;
                }
            }
        }
    }
    assert!(repaired > 10_000, "{repaired}");
}

#[test]
fn any_angle_fields_are_kept_where_no_path_comes_near() {
    let told = on_all_cores(seeds(60), |seed| {
        let (mut rng, mut kept) = (Rng::new(seed), 0);
        let grid = if seed % 3 == 0 { rooms(&mut rng, 40, 30) } else { suite_grid(seed).0 };
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
        let mut space = Arc::new(FreeSpace::<Corners>::new(Arc::new(grid), gap));
        let asked = Asked::random(&mut rng, space.grid(), Corners::KIND);
        let query = asked.query();
        let Ok(mut field) = AnyAngleFields::new(Arc::clone(&space)).field(query) else { return kept };
        for _ in 0..20 {
            let change = random_change(&mut rng, space.grid());
            let after = Arc::new(space.after(&change));
            let new = AnyAngleFields::new(Arc::clone(&after)).field(query);
            let message = format!("seed {seed}, {gap:?}, {query:?}: {:?}", change.cells());
            match (field.repaired(Arc::clone(&after), &change), new) {
                (Ok(repaired), Ok(new)) => {
                    if let Some(found) = repaired {
                        assert_eq!(found.identity(), new.identity());
                        assert!(found.lengths() == new.lengths(), "{message}");
                        assert!(new.iter().all(|(at, _)| found.next(at) == new.next(at)), "{message}");
                        kept += 1;
                    }
                    (field, space) = (new, after);
                }
                (found, new) => assert_eq!(found.err(), new.err(), "{message}"),
            }
        }
        kept
    });
    let (kept, maps) = (told.iter().sum::<u64>(), told.len() as u64);
    assert!(kept > maps / 2, "{kept}");
}

/// A repair looks at what is cut off, unless hardly anything else is left for a new field.
#[test]
fn fields_without_what_is_cut_off() {
    // Rooms of 12 × 12, 100 × 100 and 80 × 100 cells in a row, with a door between two.
    let is_wall = |x: u32, y: u32| [12, 113].contains(&x) && y != 5 || x < 12 && y >= 12;
    let grid = Arc::new(Grid::from_fn(194, 100, is_wall).unwrap());
    let k = FiniteK::N8;
    let graph = Arc::new(GridGraph::<Centers>::new(Arc::clone(&grid), k, CornerRule::Never).unwrap());
    for (source, door, is_repaired) in
        [((3, 3), (12, 5), false), ((3, 3), (113, 5), false), ((150, 50), (12, 5), true)]
    {
        let sources = [source.into()];
        let field = Fields::new(Arc::clone(&graph)).field(FieldQuery::new(&sources)).unwrap();
        let closed = Change::new(Arc::clone(&grid)).edit_cells([(door.0, door.1, true)]);
        let after = Arc::new(GridGraph::in_space(&graph.after(&closed), k).unwrap());
        let new = Fields::new(Arc::clone(&after)).field(FieldQuery::new(&sources)).unwrap();
        let found = field.repaired(after, &closed, &Interrupt::NEVER).unwrap();
        assert_eq!(found.is_some(), is_repaired, "from {source:?}");
        found.iter().for_each(|found| check_same(found, &new, "a door is closed"));
    }
}

#[test]
fn fields_are_refused_what_is_not_theirs() {
    let grid = |side| Arc::new(Grid::from_fn(side, side, |_, _| false).unwrap());
    let graph = |grid: &Arc<Grid>, k| {
        let k = FiniteK::new(k).unwrap();
        Arc::new(GridGraph::<Centers>::new(Arc::clone(grid), k, CornerRule::Never).unwrap())
    };
    let (map, never) = (grid(9), &Interrupt::NEVER);
    let change = Change::new(Arc::clone(&map)).edit_cells([(3, 3, true)]);
    let field = Fields::new(graph(&map, 3)).field(FieldQuery::new(&[Vertex::new(0, 0)])).unwrap();
    let is_mismatch = |error: Option<FieldError>| matches!(error, Some(FieldError::Mismatch(_)));
    assert!(is_mismatch(field.repaired(graph(&map, 3), &change, never).err()), "the graph before");
    assert!(is_mismatch(field.repaired(graph(change.after(), 4), &change, never).err()), "another k");
    let other = Change::new(grid(8)).edit_cells([(3, 3, true)]);
    assert!(is_mismatch(field.repaired(graph(other.after(), 3), &other, never).err()), "another map");
    assert!(is_mismatch(Fields::new(graph(&map, 4)).again(&field, never).err()), "another k");
    // A map of another size can be asked the same.
    let small = Fields::new(graph(&grid(5), 3)).again(&field, never).unwrap();
    assert_eq!(small.iter().count(), 25);
    let found = field.repaired(graph(change.after(), 3), &change, never).unwrap().unwrap();
    assert_eq!(
        (found.get(Vertex::new(3, 3)), found.get(Vertex::new(1, 0))),
        (None, Some(Cost::from_bits(1 << 32)))
    );
}

/// A list of cells is blocked or freed, first one of them, then two, and so on. Counts the changes that a
/// field follows. After all others it is made anew, and is equal: only these counts show when a repair is
/// given up.
#[test]
fn the_number_of_repairs_is_pinned() {
    fn repaired<P: Placement>(rule: P::Rule, k: u32, limit: f64) -> [usize; 2] {
        let (k, mut rng) = (FiniteK::new(k).unwrap(), Rng::new(7));
        let grid = Arc::new(rooms(&mut rng, 170, 130));
        let mut cells: Vec<(u32, u32)> = (0..400).map(|_| (rng.below(170), rng.below(130))).collect();
        cells.retain(|cell| !(60..64).contains(&cell.0));
        let graph = Arc::new(GridGraph::<P>::new(Arc::clone(&grid), k, rule).unwrap());
        let at = (50..120).map(|y| Vertex::new(62, y)).find(|&at| graph.is_free(at)).unwrap();
        let mut fields = makers(&graph, &Arc::new(CanonicalRule::<P>::new(k, rule)));
        let field = fields.field(FieldQuery::new(&[at]).within(limit)).unwrap();
        [true, false].map(|is_blocked| {
            let is_repaired = |&count: &usize| {
                let cells = cells[..count].iter().map(|&(x, y)| (x, y, is_blocked));
                let change = Change::new(Arc::clone(&grid)).edit_cells(cells);
                let after = Arc::new(GridGraph::in_space(&graph.after(&change), k).unwrap());
                field.repaired(after, &change, &Interrupt::NEVER).unwrap().is_some()
            };
            (1..=cells.len()).filter(is_repaired).count()
        })
    }
    let found = [f64::INFINITY, 60.0, 20.0].map(|limit| {
        [
            repaired::<Centers>(CornerRule::Never, 3, limit),
            repaired::<Centers>(CornerRule::One, 5, limit),
            repaired::<Corners>(DiagonalGap::Open, 2, limit),
            repaired::<Corners>(DiagonalGap::Closed, 4, limit),
        ]
    });
    let within_20 = [[1, 10], [1, 8], [1, 10], [1, 8]];
    assert_eq!(found, [[[7, 16], [5, 10], [6, 12], [5, 10]], [[5, 10]; 4], within_20]);
}
