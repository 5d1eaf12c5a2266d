//! Costs from rasters of numbers.

use mediant::{
    Costs, Error, ErrorCode, Limits, Map, Motion,
    files::{Georeference, Surface, SurfaceOptions},
};
use mediant_formats::MapFile;

/// Two rows of three costs; the last cell has none.
fn surface() -> Surface {
    let surface = Surface::new(3, 2, vec![2_u8, 4, 2, 2, 8, 0]).expect("six numbers");
    let place = Georeference::from_cell_size(30.0, 20.0).expect("a size");
    surface.with_no_data(Some(0.0)).with_georeference(place)
}

#[test]
fn rasters_are_read_with_their_cells() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["land.tif", "land.asc"] {
        let file = folder.path().join(name);
        surface().save(&file).expect("a file");
        let (costs, place) = Costs::open_with(&file, &SurfaceOptions::default()).expect("a raster");
        assert_eq!((costs.cell_size(), place.cell_size()), ((30.0, 20.0), Some((30.0, 20.0))), "{name}");
        assert_eq!(costs.cost((1, 1)), Some(8.0));
        assert!(costs.map().is_blocked((2, 1)) && costs.map().is_free((2, 0)));
        assert_eq!(costs, Costs::from_surface(&surface()).expect("costs"));
        assert_eq!(costs, Costs::open(&file).expect("a raster"));
        let within = Costs::open_within(&file, &SurfaceOptions::default(), Limits::new());
        assert_eq!(within.expect("nothing stops it").0, costs);
        let space = costs.space(Motion::centers(2)).expect("k = 2");
        assert_eq!(space.path((0, 0), (0, 1)).expect("free").map(|path| path.cost()), Some(40.0));
    }
    let map = Map::from_rows(["#..", "..."]).expect("a map");
    let costs = map.costs_of(&surface()).expect("the same size");
    let blocked = [(0, 0), (1, 0), (2, 1)].map(|at| costs.map().is_blocked(at));
    assert_eq!(blocked, [true, false, true]);
}

#[test]
fn bad_rasters_are_errors_that_say_what_to_do() {
    let error = Map::new(3, 3).expect("a map").costs_of(&surface()).expect_err("another size");
    assert_eq!((error.code(), matches!(error, Error::OtherSize { .. })), (ErrorCode::Cost, true));
    assert!(
        error.to_string().contains("3 columns and 2 rows of numbers, and the map has 3 and 3"),
        "{error}"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("land.npy");
    for wrong in [-4.0, 0.0, f64::INFINITY] {
        Surface::new(2, 1, vec![1.0, wrong]).expect("two numbers").save(&file).expect("a file");
        let error = Costs::open(&file).expect_err("no cost");
        let text = error.to_string();
        assert_eq!(error.code(), ErrorCode::Cost, "{text}");
        assert!(text.contains("land.npy") && text.contains("(1, 0)"), "{text}");
    }
    // A cell that has no number has no data.
    Surface::new(2, 1, vec![1.0, f64::NAN]).expect("two numbers").save(&file).expect("a file");
    assert!(Costs::open(&file).expect("costs").map().is_blocked((1, 0)));
    let map = folder.path().join("plain.map");
    let plain = MapFile::from_grid(Map::new(2, 2).expect("a map").grid());
    plain.write(&mut std::fs::File::create(&map).expect("a file")).expect("it is written");
    assert_eq!(Costs::open(&map).unwrap_err().code(), ErrorCode::FileUnreadable);
    assert_eq!(Costs::open(folder.path().join("none.tif")).unwrap_err().code(), ErrorCode::FileMissing);
    let stop = Limits::new().deadline(|| true);
    let stopped = Costs::open_within(&file, &SurfaceOptions::default(), &stop);
    assert_eq!(stopped.unwrap_err().code(), ErrorCode::Stopped);
}
