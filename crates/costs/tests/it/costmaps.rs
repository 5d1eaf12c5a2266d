//! Costmaps: inflation against nav2's formula by brute force, and against how nav2 spreads it; occupancies;
//! what cells cost; errors.

use std::collections::BTreeMap;

use mediant_costs::{Costmap, CostsError, Inflation, Traversal};
use mediant_grid::{Interrupt, StoppedBy};
use mediant_oracle::{Rng, caves, check_interrupts, noise, seeds};

fn one<T: Copy>(rng: &mut Rng, items: &[T]) -> T {
    *rng.pick(items).expect("there are some")
}

/// A costmap of random bytes, most of them free, and how to inflate it.
fn random(seed: u64) -> (Costmap, Inflation) {
    let mut rng = Rng::new(seed);
    let (width, height) = (1 + rng.below(40), 1 + rng.below(30));
    let obstacles = one(&mut rng, &[0, 1, 5, 30]);
    let bytes: Vec<u8> = (0..width * height)
        .map(|_| match rng.below(100) {
            roll if roll < obstacles => 254,
            roll if roll < 2 * obstacles => rng.below(256) as u8,
            roll if roll < 3 * obstacles => 255,
            _ => 0,
        })
        .collect();
    let resolution = one(&mut rng, &[1.0, 0.05, 0.1]);
    let inscribed = one(&mut rng, &[0.0, 0.5, 1.0, 2.3]);
    let inflation = Inflation {
        resolution,
        inscribed_radius: inscribed * resolution,
        inflation_radius: (inscribed + one(&mut rng, &[0.0, 1.0, 3.7, 8.0, 1e9])) * resolution,
        cost_scaling_factor: one(&mut rng, &[0.0, 0.1, 0.7, 3.0]) / resolution,
        inflate_unknown: rng.chance(50),
        inflate_around_unknown: rng.chance(50),
    };
    (Costmap::from_bytes(width, height, bytes).expect("as many as cells"), inflation)
}

fn cells(costmap: &Costmap) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (width, height) = (costmap.width(), costmap.height());
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

fn inflated(costmap: &Costmap, inflation: &Inflation) -> Costmap {
    costmap.inflated(inflation, &Interrupt::NEVER).unwrap_or_else(|error| panic!("{error}: {inflation:?}"))
}

/// The documented formula at a distance in cells. Both of its values where rounding may decide.
fn formula(inflation: &Inflation, cells: f64) -> [u8; 2] {
    let distance = cells * inflation.resolution;
    if cells == 0.0 {
        return [254; 2];
    }
    if distance <= inflation.inscribed_radius {
        return [253; 2];
    }
    let cost = 252.0 * f64::exp(-inflation.cost_scaling_factor * (distance - inflation.inscribed_radius));
    [(cost - 1e-9).max(0.0) as u8, (cost + 1e-9) as u8]
}

#[test]
fn costs_are_those_of_the_formula_at_the_nearest_obstacle() {
    let mut kinds = [0; 4];
    for seed in seeds(400) {
        let (costmap, inflation) = random(seed);
        let found = inflated(&costmap, &inflation);
        let is_source = |byte: u8| byte == 254 || inflation.inflate_around_unknown && byte == 255;
        let sources: Vec<_> = cells(&costmap)
            .filter(|&(x, y)| costmap.get(x, y).is_some_and(is_source))
            .map(|(x, y)| (f64::from(x), f64::from(y)))
            .collect();
        let reach = (inflation.inflation_radius / inflation.resolution).ceil();
        for ((x, y), (&before, &after)) in cells(&costmap).zip(costmap.bytes().iter().zip(found.bytes())) {
            let (cx, cy) = (f64::from(x), f64::from(y));
            let distances = sources.iter().map(|&(i, j)| ((cx - i).powi(2) + (cy - j).powi(2)).sqrt());
            let nearest = distances.fold(f64::INFINITY, f64::min);
            let costs = if nearest <= reach && reach > 0.0 { formula(&inflation, nearest) } else { [0; 2] };
            let expected = costs.map(|cost| match before {
                255 if cost == 254 || cost == 253 => cost,
                255 if inflation.inflate_unknown && cost > 0 => cost,
                before => before.max(cost),
            });
            assert!(
                expected.contains(&after),
                "seed {seed}, ({x}, {y}): {after}, {expected:?}, {inflation:?}"
            );
            let is_unknown = before == 255;
            kinds[0] += i32::from(is_unknown && after == 254);
            kinds[1] += i32::from(is_unknown && after < 253);
            kinds[2] += i32::from(is_unknown && after == 255);
            kinds[3] += i32::from(!is_unknown && after > before && after < 253);
        }
    }
    assert!(kinds.into_iter().all(|seen| seen > 100), "{kinds:?}");
}

/// Inflation from obstacle to neighbor in the order of distance, where each cell keeps the obstacle of the
/// neighbor that came first: how nav2 did it for many years.
fn spread(costmap: &Costmap, inflation: &Inflation) -> Vec<u8> {
    let (width, height) = (i64::from(costmap.width()), i64::from(costmap.height()));
    let reach = (inflation.inflation_radius / inflation.resolution).ceil() as i64;
    let mut bytes = costmap.bytes().to_vec();
    let mut seen = vec![false; bytes.len()];
    let lethal = cells(costmap).filter(|&(x, y)| costmap.get(x, y) == Some(254));
    let mut waiting = BTreeMap::from([(
        0,
        lethal.map(|(x, y)| [i64::from(x), i64::from(y)]).map(|at| (at, at)).collect::<Vec<_>>(),
    )]);
    let mut level = 0;
    while let Some((&squared, _)) = waiting.range(level..).next() {
        let mut next = 0;
        while let Some(&([x, y], source)) = waiting.get(&squared).and_then(|cells| cells.get(next)) {
            next += 1;
            let at = (y * width + x) as usize;
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            let [cost, _] = formula(inflation, (squared as f64).sqrt());
            bytes[at] = bytes[at].max(cost);
            for [x, y] in [[x - 1, y], [x, y - 1], [x + 1, y], [x, y + 1]] {
                let squared = (x - source[0]).pow(2) + (y - source[1]).pow(2);
                let on_map = (0..width).contains(&x) && (0..height).contains(&y);
                if on_map && squared <= reach * reach && !seen[(y * width + x) as usize] {
                    waiting.entry(squared).or_default().push(([x, y], source));
                }
            }
        }
        level = squared + 1;
    }
    bytes
}

#[test]
fn nav2_differs_where_it_does_not_measure_exactly() {
    let (mut all, mut by_spreading, mut by_hundredths, mut most) = (0, 0, 0, [0, 0]);
    for seed in seeds(30) {
        let mut rng = Rng::new(seed);
        let percent = one(&mut rng, &[1, 3, 10]);
        let grid = if rng.chance(50) { noise(&mut rng, 90, 70, percent) } else { caves(&mut rng, 90, 70) };
        let costmap = Costmap::from_grid(&grid);
        let inflation = Inflation {
            resolution: 0.05,
            inscribed_radius: 0.1,
            inflation_radius: 0.55,
            cost_scaling_factor: 3.0,
            ..Inflation::default()
        };
        let exact = inflated(&costmap, &inflation);
        let squared = grid.squared_center_distances(&Interrupt::NEVER).expect("nothing stops it");
        for ((&exact, spread), &squared) in
            exact.bytes().iter().zip(spread(&costmap, &inflation)).zip(&squared)
        {
            // An obstacle that is not the nearest one is farther.
            assert!(spread <= exact, "seed {seed}");
            let hundredths = (f64::from(squared).sqrt() * 100.0).round() / 100.0;
            let [rounded, _] = if exact == 0 { [0; 2] } else { formula(&inflation, hundredths) };
            all += 1;
            by_spreading += i32::from(spread != exact);
            by_hundredths += i32::from(rounded != exact);
            most = [most[0].max(exact.abs_diff(spread)), most[1].max(exact.abs_diff(rounded))];
        }
    }
    assert!(by_spreading * 100 < all && most[0] <= 30, "{by_spreading} of {all}, {most:?}");
    assert!(by_hundredths > 0 && most[1] <= 1, "{by_hundredths} of {all}, {most:?}");
}

#[test]
fn far_beyond_the_table_costs_are_the_formula_too() {
    // 2²⁰ squared distances are a table: 1,024 cells.
    let costmap =
        Costmap::from_bytes(1500, 1, (0..1500).map(|x| if x == 0 { 254 } else { 0 }).collect::<Vec<_>>());
    let costmap = costmap.expect("as many as cells");
    let inflation = Inflation {
        resolution: 1.0,
        inscribed_radius: 3.0,
        inflation_radius: 1400.0,
        cost_scaling_factor: 0.001,
        ..Inflation::default()
    };
    for (x, &byte) in inflated(&costmap, &inflation).bytes().iter().enumerate() {
        let expected = if x > 1400 { [0; 2] } else { formula(&inflation, x as f64) };
        assert!(expected.contains(&byte), "{x}: {byte}, {expected:?}");
    }
}

#[test]
fn occupancies_become_bytes_in_order() {
    let all = (0..=255).map(Some).chain([None]);
    let costmap = Costmap::from_occupancies(257, 1, all).expect("as many as cells");
    let bytes = costmap.bytes();
    assert!(bytes[..101].is_sorted_by(|a, b| a < b), "{bytes:?}");
    assert_eq!((bytes[0], bytes[50], bytes[98], bytes[99], bytes[100]), (0, 127, 248, 253, 254));
    assert!(bytes[100..256].iter().all(|&byte| byte == 254) && bytes[256] == 255);
    assert_eq!(costmap.flipped(), costmap);
    assert_eq!([(256, 0), (257, 0), (0, 1)].map(|(x, y)| costmap.get(x, y)), [Some(255), None, None]);
    for seed in seeds(20) {
        let (costmap, _) = random(seed);
        let flipped = costmap.flipped();
        let top = costmap.height() - 1;
        assert!(cells(&costmap).all(|(x, y)| flipped.get(x, y) == costmap.get(x, top - y)));
    }
}

#[test]
fn cells_cost_what_their_bytes_say() {
    let bytes: Vec<u8> = (0..=255).collect();
    let costmap = Costmap::from_bytes(16, 16, bytes).expect("as many as cells");
    for (unknown, inscribed) in [(None, false), (Some(100), false), (None, true), (Some(255), true)] {
        let traversal = Traversal { unknown, inscribed, cell_size: 0.05 };
        for weight in [0.0, 1.0, Costmap::NAVFN, 300.0] {
            let costs = costmap.to_costs(weight, &traversal, &Interrupt::NEVER).expect("a weight");
            assert_eq!(costs.cell_size(), (0.05, 0.05));
            for byte in 0..=255 {
                let taken_for = match byte {
                    253 if !inscribed => None,
                    254 => None,
                    255 => unknown,
                    byte => Some(byte),
                };
                let found = costs.cost(u32::from(byte) % 16, u32::from(byte) / 16);
                let expected = taken_for.map(|byte| 1.0 + weight * f64::from(byte) / 252.0);
                assert_eq!(found.is_some(), expected.is_some(), "{byte}");
                let error = found.unwrap_or(0.0) - expected.unwrap_or(0.0);
                assert!(error.abs() < 1e-6, "{byte}: {found:?}, {expected:?}");
            }
        }
    }
    // NavFn's own numbers: 50 for a free cell, 251 for the dearest.
    let navfn = costmap.to_costs(Costmap::NAVFN, &Traversal::default(), &Interrupt::NEVER).expect("a weight");
    assert!(navfn.cost(252 % 16, 252 / 16).is_some_and(|cost| (50.0 * cost - 251.6).abs() < 1e-6));
}

#[test]
fn settings_that_cannot_be_are_refused() {
    let costmap = Costmap::from_bytes(2, 1, [254, 0]).expect("two cells");
    let refused = |change: fn(&mut Inflation, f64), bad: f64| {
        let mut inflation = Inflation::default();
        change(&mut inflation, bad);
        let error = costmap.inflated(&inflation, &Interrupt::NEVER).expect_err("a bad setting").to_string();
        assert!(error.contains("must be"), "{error}");
    };
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        refused(|inflation, bad| inflation.resolution = bad, bad);
        refused(|inflation, bad| inflation.inscribed_radius = bad, bad);
        refused(|inflation, bad| inflation.inflation_radius = bad, bad);
        refused(|inflation, bad| inflation.cost_scaling_factor = bad, bad);
        let costs = costmap.to_costs(bad, &Traversal::default(), &Interrupt::NEVER);
        assert!(matches!(costs, Err(CostsError::Setting { name: "weight", .. })));
    }
    refused(|inflation, bad| inflation.resolution = bad, 0.0);
    let small = Inflation { inscribed_radius: 0.3, inflation_radius: 0.2, ..Inflation::default() };
    let error = costmap.inflated(&small, &Interrupt::NEVER).expect_err("too small");
    assert_eq!(
        error.to_string(),
        "`inflation_radius` is 0.2 and `inscribed_radius` 0.3: cells between them would seem free, and a robot on \
         them would touch an obstacle; choose an inflation radius of at least the inscribed one"
    );
    let nothing = Inflation { inscribed_radius: 0.0, inflation_radius: 0.0, ..Inflation::default() };
    assert_eq!(costmap.inflated(&nothing, &Interrupt::NEVER), Ok(costmap.clone()));
    let heavy =
        costmap.to_costs(1e6, &Traversal { unknown: Some(1), ..Traversal::default() }, &Interrupt::NEVER);
    assert!(heavy.is_ok(), "all free cells cost 1");
    let dear = Costmap::from_bytes(2, 1, [1, 0]).expect("two cells");
    let dear = dear.to_costs(1e9, &Traversal::default(), &Interrupt::NEVER);
    assert!(matches!(dear, Err(CostsError::Range { .. })));
    let sizeless = Traversal { cell_size: 0.0, ..Traversal::default() };
    let sizeless = costmap.to_costs(1.0, &sizeless, &Interrupt::NEVER);
    assert!(matches!(sizeless, Err(CostsError::CellSize { .. })));
}

#[test]
fn sizes_and_counts_are_refused() {
    assert!(matches!(Costmap::from_bytes(0, 3, []), Err(CostsError::Size { .. })));
    assert!(matches!(Costmap::from_bytes(2, 2, [0; 3]), Err(CostsError::Count { found: 3, expected: 4 })));
    let endless = Costmap::from_occupancies(2, 2, std::iter::repeat(None));
    assert!(matches!(endless, Err(CostsError::Count { found: 5, expected: 4 })));
    let few = Costmap::from_occupancies(2, 2, [Some(0)]);
    assert!(matches!(few, Err(CostsError::Count { found: 1, expected: 4 })));
    let long = Costmap::from_bytes(40_000, 1, vec![0; 40_000]).expect("a side of a cost surface");
    let error = long.inflated(&Inflation::default(), &Interrupt::NEVER).expect_err("a long side");
    assert!(matches!(error, CostsError::Inflated { width: 40_000, .. }), "{error}");
}

#[test]
fn inflation_and_surfaces_stop() {
    let costmap = Costmap::from_bytes(64, 64, vec![0; 64 * 64]).expect("as many as cells");
    let by = |error: &CostsError| match error {
        CostsError::Interrupted(interrupted) => Some(interrupted.by),
        _ => None::<StoppedBy>,
    };
    check_interrupts("inflation", 192, |i| costmap.inflated(&Inflation::default(), i), by);
    check_interrupts("costs", 128, |i| costmap.to_costs(1.0, &Traversal::default(), i), by);
}
