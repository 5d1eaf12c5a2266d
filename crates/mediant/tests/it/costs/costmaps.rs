//! Costmaps of robots: those of the crate, and maps of ROS from files.

use mediant::{
    Costmap, ErrorCode, Inflation, Limits, Map, Motion, Traversal,
    files::{MapOptions, Unknown},
};
use mediant_costs::Costmap as Bytes;
use mediant_formats::{Raster, RosMap, RosMode, RosSettings};
use mediant_grid::Interrupt;
use mediant_oracle::{Rng, seeds};

/// Costs of a map are those that the crate makes of it, with the map's blocked cells.
#[test]
fn costs_of_a_map_are_those_of_the_crate() {
    let mut priced = 0;
    for seed in seeds(40) {
        let mut rng = Rng::new(seed);
        let (width, height) = (1 + rng.below(20), 1 + rng.below(20));
        let map = Map::from_fn(width, height, |_, _| rng.chance(9)).expect("a small map");
        let inflation = Inflation {
            resolution: 0.05,
            inscribed_radius: 0.025 * f64::from(rng.below(3)),
            inflation_radius: 0.05 + 0.05 * f64::from(rng.below(5)),
            cost_scaling_factor: f64::from(rng.below(12)),
            ..Inflation::default()
        };
        let weight = f64::from(rng.below(6));
        let about = format!("seed {seed}: {inflation:?}, weight {weight}\n{map}");
        let costmap = map.inflated(&inflation).unwrap_or_else(|error| panic!("{error}: {about}"));
        let bytes = Bytes::from_grid(map.grid()).inflated(&inflation, &Interrupt::NEVER).expect("it is one");
        assert_eq!(costmap.bytes(), bytes.bytes(), "{about}");
        let costs = costmap.costs(weight).unwrap_or_else(|error| panic!("{error}: {about}"));
        let surface = bytes.to_costs(weight, &Traversal::default(), &Interrupt::NEVER).expect("it is one");
        assert_eq!(**costs.surface(), surface, "{about}");
        for (x, y) in (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y))) {
            let is_blocked = costmap.get((x, y)).is_none_or(|byte| byte >= Costmap::INSCRIBED);
            assert_eq!(costs.map().is_blocked((x, y)), is_blocked, "({x}, {y}): {about}");
            assert_eq!(costs.cost((x, y)).is_none(), is_blocked, "({x}, {y}): {about}");
            assert!(is_blocked || map.is_free((x, y)), "({x}, {y}) is a wall: {about}");
            priced += u32::from(costs.cost((x, y)).is_some_and(|cost| cost > 1.0));
        }
        let again = costmap.within(Limits::new()).costs_with(weight, &Traversal::default());
        assert_eq!(again.expect("nothing stops it"), costs, "{about}");
    }
    assert!(priced > 100, "only {priced} cells beside walls");
}

/// Shades of ROS maps are costs in the modes `scale` and `raw`, and the place in the world is kept.
#[test]
fn maps_of_ros_are_costmaps_in_all_modes() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("depot.yaml");
    let shades = [250, 120, 0, 205, 60, 90];
    for (mode, [free, gray], bytes) in [
        (RosMode::Trinary, [false, true], [0, 255, 254, 255, 254, 255]),
        (RosMode::Scale, [false, false], [0, 185, 254, 0, 254, 253]),
        (RosMode::Raw, [true, true], [255, 255, 0, 255, 152, 228]),
    ] {
        let picture = Raster::from_fn(3, 2, 255, |x, y| shades[(3 * y + x) as usize]).expect("a picture");
        let mut settings = RosSettings::new("depot.pgm", 0.05, [-1.0, -2.0, 0.0]);
        settings.mode = mode;
        RosMap::new(settings, picture).expect("a map").save(&file).expect("two files");
        let (costmap, world) = Costmap::open_with(&file, &MapOptions::default()).expect("a ROS map");
        assert_eq!(costmap.bytes(), bytes, "{mode}");
        assert_eq!(world.map(|world| (world.resolution(), world.origin())), Some((0.05, [-1.0, -2.0, 0.0])));
        assert_eq!((costmap.width(), costmap.height(), costmap.get((3, 0))), (3, 2, None));
        let options = MapOptions { unknown: Unknown::Free, ..MapOptions::default() };
        let (known, _) = Costmap::open_with(&file, &options).expect("a ROS map");
        let expected = bytes.map(|byte| if byte == Costmap::UNKNOWN { Costmap::FREE } else { byte });
        assert_eq!(known.bytes(), expected, "{mode}");
        let costs = Costmap::open(&file).and_then(|costmap| costmap.costs(2.0)).expect("a weight");
        assert_eq!([(0, 0), (1, 0)].map(|at| costs.map().is_blocked(at)), [free, gray], "{mode}");
    }
    // A map of another kind has free and blocked cells.
    let plain = folder.path().join("depot.map");
    std::fs::write(&plain, "type octile\nheight 1\nwidth 3\nmap\n.@.\n").expect("a file");
    let (costmap, world) = Costmap::open_with(&plain, &MapOptions::default()).expect("a map");
    assert_eq!((costmap.bytes(), world), (&[0, 254, 0][..], None));
    let error = Costmap::open(folder.path().join("none.yaml")).expect_err("no file");
    assert_eq!(error.code(), ErrorCode::FileMissing);
}

#[test]
fn soft_costs_keep_off_walls() {
    let map = Map::from_fn(40, 30, |x, y| x == 20 && !(4..7).contains(&y) && y < 16).expect("a small map");
    let inflation = Inflation {
        resolution: 1.0,
        inscribed_radius: 1.0,
        inflation_radius: 8.0,
        cost_scaling_factor: 0.15,
        ..Inflation::default()
    };
    let costmap = map.inflated(&inflation).expect("good settings");
    let path = |weight: f64| {
        let space = costmap.costs(weight).and_then(|costs| costs.space(Motion::centers(4)));
        space.and_then(|space| space.path((5, 5), (35, 5))).expect("free").expect("there is a way")
    };
    let (short, soft) = (path(0.0), path(3.0));
    assert_eq!((short.cost(), short.length()), (30.0, 30.0));
    assert!(soft.length() > 30.0 && soft.vertices().any(|at| at.y > 16), "{soft}");
}

#[test]
fn bad_settings_are_errors_that_say_what_to_do() {
    let map = Map::new(4, 3).expect("a small map");
    let bad = |inflation: Inflation| {
        let error = map.inflated(&inflation).expect_err("it is bad");
        (error.code(), error.to_string())
    };
    let good = Inflation::default();
    for number in [-1.0, f64::NAN, f64::INFINITY] {
        for (wrong, name) in [
            (Inflation { resolution: number, ..good }, "resolution"),
            (Inflation { inscribed_radius: number, ..good }, "inscribed_radius"),
            (Inflation { inflation_radius: number, ..good }, "inflation_radius"),
            (Inflation { cost_scaling_factor: number, ..good }, "cost_scaling_factor"),
        ] {
            let (code, text) = bad(wrong);
            assert!(code == ErrorCode::Number && text.contains(name) && text.contains("must be"), "{text}");
        }
        let error = Costmap::from(&map).costs(number).expect_err("no weight");
        assert!(error.code() == ErrorCode::Number && error.to_string().contains("weight"), "{error}");
    }
    assert_eq!(bad(Inflation { inflation_radius: 0.05, ..good }).0, ErrorCode::Number);
    let steep = Costmap::from_bytes(2, 1, [0, 1]).expect("two bytes");
    assert_eq!(steep.costs(1e9).unwrap_err().code(), ErrorCode::Cost);
    assert_eq!(Costmap::from_bytes(2, 2, [0; 3]).unwrap_err().code(), ErrorCode::Cost);
    assert_eq!(Costmap::from_bytes(0, 2, []).unwrap_err().code(), ErrorCode::MapSize);
    assert_eq!(Costmap::from_occupancies(2, 1, [Some(0); 3]).unwrap_err().code(), ErrorCode::Cost);
    // A surface may have longer sides than a map.
    let long = Costmap::from_bytes(1 << 17, 1, vec![0; 1 << 17]).expect("a long costmap");
    assert_eq!(long.costs(1.0).unwrap_err().code(), ErrorCode::MapSize);
    assert_eq!(long.inflated(&good).unwrap_err().code(), ErrorCode::MapSize);
    let stop = Limits::new().deadline(|| true);
    assert_eq!(Costmap::from(&map).within(&stop).inflated(&good).unwrap_err().code(), ErrorCode::Stopped);
}
