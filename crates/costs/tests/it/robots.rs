//! A robot that keeps off walls, by soft costs and by the widest disc.

use std::{fmt::Write, sync::Arc};

use mediant_costs::{CostAStar, CostGraph, CostSurface, Costmap, Inflation, Traversal};
use mediant_grid::{Clearance, CornerRule, Fit, Grid, Interrupt, Outside, Rules};
use mediant_moves::FiniteK;
use mediant_search::{Ends, Path, Planner};

const RULES: Rules = Rules::Center(CornerRule::Never);

/// The cheapest path on a surface over N(4).
fn path(costs: CostSurface, ends: Ends) -> Option<Path> {
    let graph = CostGraph::new(Arc::new(costs), RULES, FiniteK::N16).expect("a small k");
    let mut planner = CostAStar::new(Arc::new(graph));
    planner.solve(ends).ok()?.path().cloned()
}

/// The shortest path on a map.
fn shortest(grid: &Grid, ends: Ends) -> Option<Path> {
    path(CostSurface::uniform(grid, &Interrupt::NEVER).expect("nothing stops it"), ends)
}

/// The least and the mean distance to obstacles, in cells, at ten points or more a cell along a path.
fn clearance(path: &Path, map: &Grid) -> (f64, f64) {
    let cells = || (0..map.height() as i32).flat_map(|y| (0..map.width() as i32).map(move |x| (x, y)));
    let blocked: Vec<_> = cells().filter(|&(x, y)| map.is_blocked(x, y)).collect();
    // From the center of a cell, or a point beside it, to a square of side 1.
    let gap = |point: f64, cell: i32| ((point - f64::from(cell)).abs() - 0.5).max(0.0);
    let (mut least, mut sum, mut points) = (f64::INFINITY, 0.0, 0.0);
    for leg in path.waypoints().windows(2) {
        let (dx, dy) = (leg[1].x - leg[0].x, leg[1].y - leg[0].y);
        let steps = 10 * (dx.abs() + dy.abs());
        for step in 0..steps {
            let point = |from: i32, d: i32| f64::from(from) + f64::from(d * step) / f64::from(steps);
            let (x, y) = (point(leg[0].x, dx), point(leg[0].y, dy));
            let squares = blocked.iter().map(|&(i, j)| gap(x, i).powi(2) + gap(y, j).powi(2));
            let distance = squares.fold(f64::INFINITY, f64::min).sqrt();
            least = least.min(distance);
            (sum, points) = (sum + distance, points + 1.0);
        }
    }
    (least, sum / points)
}

#[test]
fn soft_costs_lead_through_the_wide_passage_in_its_middle() {
    // A short way through a door of 3 cells, and a longer one through a gate of 11.
    let map = Grid::from_fn(60, 40, |x, y| {
        let in_wall = (27..33).contains(&x) && !(25..28).contains(&y) && !(6..17).contains(&y);
        in_wall || x == 0 || y == 0 || x == 59 || y == 39
    });
    let map = Arc::new(map.expect("a small map"));
    let ends = Ends::new((8, 26), (51, 26));
    let measured = Clearance::new(Arc::clone(&map), Fit::Centers, Outside::Blocked);

    let plain = shortest(&map, ends).expect("there is a door");
    let inflation = Inflation {
        resolution: 0.05,
        inscribed_radius: 0.05,
        inflation_radius: 0.5,
        cost_scaling_factor: 3.0,
        ..Inflation::default()
    };
    let costmap = Costmap::from_grid(&map).inflated(&inflation, &Interrupt::NEVER).expect("good settings");
    let costs = costmap.to_costs(3.0, &Traversal::default(), &Interrupt::NEVER).expect("a weight");
    let soft = path(costs, ends).expect("there is a gate");
    let search = |map: &Arc<Grid>| Ok::<_, ()>(shortest(map, ends));
    let widest = measured.widest(f64::INFINITY, search).expect("it does not fail").expect("there is a way");
    let widest = widest.found;

    let mut table = String::new();
    for (name, path) in [("plain", &plain), ("soft", &soft), ("widest", &widest)] {
        let (least, mean) = clearance(path, &map);
        writeln!(table, "{name:6}  length {:.1}, clearance {least:.1}, in the mean {mean:.1}", path.length())
            .expect("a string takes all");
    }
    assert_eq!(
        table,
        "plain   length 43.0, clearance 1.5, in the mean 6.9\n\
         soft    length 58.8, clearance 5.5, in the mean 9.5\n\
         widest  length 55.1, clearance 5.5, in the mean 8.6\n"
    );
}

#[test]
fn gray_maps_of_ros_become_costs() {
    use mediant_formats::{Raster, RosMap, RosMode, RosSettings, RosVersion};
    // A short way over dark ground, and a light one around it.
    let shade = |x: u32, y: u32| if (2..7).contains(&x) && y < 4 { 120 } else { 250 };
    let picture =
        |shade: &dyn Fn(u32, u32) -> u32| Raster::from_fn(9, 6, 255, shade).expect("a small picture");
    let mut settings = RosSettings::new("depot.pgm", 1.0, [0.0; 3]);
    settings.mode = RosMode::Scale;
    let scale = RosMap::new(settings.clone(), picture(&shade)).expect("good settings");
    settings.mode = RosMode::Raw;
    let raw = |x: u32, y: u32| if (2..7).contains(&x) && y < 4 { 90 } else { 0 };
    let raw = RosMap::new(settings, picture(&raw)).expect("good settings");
    for (map, dark) in [(scale, 185), (raw, 228)] {
        for ros in [RosVersion::Ros1, RosVersion::Ros2] {
            let costmap = Costmap::from_occupancies(9, 6, map.occupancies(ros)).expect("as many as cells");
            assert_eq!((costmap.get(0, 0), costmap.get(3, 0)), (Some(0), Some(dark)), "{ros:?}");
            let costs = |weight| costmap.to_costs(weight, &Traversal::default(), &Interrupt::NEVER);
            let [across, around] =
                [0.0, 10.0].map(|weight| path(costs(weight).expect("a weight"), Ends::new((0, 0), (8, 0))));
            assert_eq!(across.map(|path| path.length()), Some(8.0));
            assert!(around.is_some_and(|path| path.waypoints().iter().any(|at| at.y >= 4)));
        }
    }
}
