//! Copies of maps to walk on, from the elevations and frictions that they have.

use mediant_costs::{Pace, WalkingBounds, WalkingError, WalkingMap};
use mediant_grid::Interrupt;
use mediant_oracle::{Rng, seeds};

use super::ground::for_random_grounds;

const NEVER: &Interrupt = &Interrupt::NEVER;

/// The copy of a map with these bounds.
fn copy(of: &WalkingMap, pace: &Pace, bounds: WalkingBounds) -> Result<WalkingMap, WalkingError> {
    let ground = |x, y| Some((of.elevation(x, y)?, of.friction(x, y)?));
    WalkingMap::with_bounds((of.width(), of.height()), of.cell_size(), pace, bounds, NEVER, ground)
}

#[test]
fn a_copy_is_equal_to_its_map() {
    for_random_grounds(30, |ground, graph, about| {
        let map = graph.map();
        let again = copy(map, ground.pace(), map.ground_bounds()).expect(about);
        assert_eq!((&again, again.id(), again.unit()), (&**map, map.id(), map.unit()), "{about}");
        assert_eq!((again.bounds(), again.ground_bounds()), (map.bounds(), map.ground_bounds()), "{about}");
    });
}

/// Ranges next to powers of two, which a rounded number would leave.
#[test]
fn a_copy_has_the_units_of_its_map() {
    let mut others = 0;
    for seed in seeds(300) {
        let mut rng = Rng::new(seed);
        let mut near = |exponent: u32| {
            let power = f64::from(1 << rng.below(exponent));
            power - power * f64::from(rng.below(9)) / f64::from(1 << (29 + rng.below(3))) / 2.0
        };
        let (lowest, range, rough) = (near(9) / 3.0, near(12), near(3) - 0.6);
        let numbers: Vec<(f64, f64)> = (0..12)
            .map(|_| (lowest + range * f64::from(rng.below(9)) / 8.0, rough * f64::from(rng.below(4)) / 3.0))
            .collect();
        let pace = Pace::Table(vec![(-1.0, 0.6), (0.0, 0.5), (1.0, 0.6)]);
        let ground = |x: u32, y: u32| (x != y).then_some(numbers[(y * 4 + x) as usize]);
        let Ok(map) = WalkingMap::with_friction((4, 3), (50.0, 40.0), &pace, NEVER, ground) else {
            assert!(rough < 0.0, "seed {seed}");
            continue;
        };
        let again = copy(&map, &pace, map.ground_bounds()).expect("the same numbers");
        assert_eq!((&again, again.unit(), again.bounds()), (&map, map.unit(), map.bounds()), "seed {seed}");
        // Bounds that are none count as not given.
        let none = WalkingBounds { elevation: (1.0, f64::NAN), friction: (0.0, 1.0) };
        others += u32::from(copy(&map, &pace, none).expect("the same numbers") != map);
    }
    assert!(others > 0, "bounds make no difference");
}

#[test]
fn numbers_beyond_the_bounds_are_those_within() {
    let pace = Pace::Tobler;
    let made = |bounds, elevation: f64| {
        let ground = move |x, _| Some((f64::from(x) * elevation, 0.25));
        WalkingMap::with_bounds((3, 2), (10.0, 10.0), &pace, bounds, NEVER, ground)
    };
    let bounds = WalkingBounds { elevation: (0.0, 2.0), friction: (0.25, 0.25) };
    let map = made(bounds, 1.0).expect("within");
    assert_eq!(made(bounds, 9.0).expect("beyond").elevation(2, 1), Some(2.0));
    assert_eq!(map.ground_bounds(), bounds);
    assert!(matches!(made(bounds, f64::INFINITY), Err(WalkingError::Elevation { .. })));
    for (least, greatest) in [(1.0, 0.0), (f64::NEG_INFINITY, 0.0), (f64::MIN, f64::MAX), (f64::NAN, 1.0)] {
        let elevation = WalkingBounds { elevation: (least, greatest), ..bounds };
        assert_eq!(made(elevation, 1.0).as_ref(), Ok(&map));
        let friction = WalkingBounds { friction: (least, greatest), ..bounds };
        assert_eq!(made(friction, 1.0).as_ref(), Ok(&map));
    }
}
