//! Places in the world: the size of cells, degrees, meters.

use mediant_formats::{Georeference, Surface, SurfaceOptions, read_surface};

use super::files;

fn fixture(name: &str) -> Surface {
    let path = files().into_iter().find(|path| path.ends_with(name)).unwrap();
    read_surface(path, &SurfaceOptions::default()).unwrap()
}

/// The lengths of a degree, by the tables of the National Geospatial-Intelligence Agency for WGS 84.
#[test]
fn degrees_in_meters() {
    let surface = fixture("gdal-point.tif");
    assert!(surface.is_in_degrees());
    let (width, height) = surface.cell_size().unwrap();
    assert_eq!((width, height), (0.5, 0.25));
    // The first row is from 60.25 to 60 degrees.
    for row in 0..surface.height() {
        let (x, y) = surface.cell_meters(row).unwrap();
        let latitude = 60.125 - 0.25 * f64::from(row);
        let angle = latitude.to_radians();
        let degree_y = 111_132.954 - 559.822 * (2.0 * angle).cos() + 1.175 * (4.0 * angle).cos()
            - 0.0023 * (6.0 * angle).cos();
        let degree_x = 111_412.84 * angle.cos() - 93.5 * (3.0 * angle).cos() + 0.118 * (5.0 * angle).cos();
        assert!((x / width - degree_x).abs() < 0.05, "row {row}: {x}");
        assert!((y / height - degree_y).abs() < 0.05, "row {row}: {y}");
    }
    assert_eq!(surface.cell_meters(surface.height()), None);
    // The same place without GeoKeys is in nobody knows which unit.
    assert_eq!(fixture("gdal-dx-dy.asc").cell_meters(0), None);
}

#[test]
fn cell_sizes() {
    for wrong in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        assert!(Georeference::from_cell_size(wrong.0, wrong.1).is_err());
    }
    let surface = Surface::new(1, 1, vec![1_u8]).unwrap();
    assert_eq!(surface.cell_size(), None);
    let surface = surface.with_georeference(Georeference::from_cell_size(2.0, 3.0).unwrap());
    assert_eq!((surface.cell_size(), surface.georeference().lower_left()), (Some((2.0, 3.0)), None));
}

#[test]
fn no_data_in_the_type_of_the_samples() {
    let numbers = vec![f32::MIN, 0.1, f32::NAN];
    let surface = Surface::new(3, 1, numbers).unwrap();
    assert_eq!(surface.get(0, 0), Some(f64::from(f32::MIN)));
    // As programs print it.
    let surface = surface.with_no_data(Some(-3.402823466e38));
    assert_eq!([0, 1, 2].map(|x| surface.get(x, 0)), [None, Some(f64::from(0.1_f32)), None]);
    let surface = surface.with_no_data(Some(0.1));
    assert_eq!([0, 1, 2].map(|x| surface.get(x, 0)), [Some(f64::from(f32::MIN)), None, None]);
    let surface = surface.with_no_data(Some(f64::NAN));
    assert_eq!((surface.no_data(), surface.iter().flatten().count()), (None, 2));
    assert_eq!((surface.get(3, 0), surface.get(0, 1)), (None, None));
}

#[test]
fn a_file_beside_a_grid_says_that_it_is_in_degrees() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| read_surface(folder.path().join(name), &SurfaceOptions::default()).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("dem.asc", "ncols 2\nnrows 1\nxllcorner 9\nyllcorner 60\ncellsize 0.5\n1 2\n");
    assert!(!read("dem.asc").is_in_degrees());
    for (text, expected) in [("PROJCS[\"UTM\",GEOGCS[]]", false), ("GEOGCS[\"WGS 84\"]", true)] {
        write("dem.prj", text);
        assert_eq!(read("dem.asc").is_in_degrees(), expected, "{text}");
    }
    let surface = read("dem.asc");
    let (width, height) = surface.cell_meters(0).unwrap();
    assert!((width - 27_664.0).abs() < 250.0 && (height - 55_720.0).abs() < 50.0, "{width} × {height}");
    // It stays so in a GeoTIFF, beside which the file has nothing to say.
    surface.save(folder.path().join("dem.tif")).unwrap();
    assert!(read("dem.tif").is_in_degrees());
    let meters = Georeference::from_cell_size(30.0, 30.0).unwrap();
    let plain = Surface::new(1, 1, vec![1_u8]).unwrap();
    plain.clone().with_georeference(meters).save(folder.path().join("dem.tif")).unwrap();
    plain.save(folder.path().join("dem.npy")).unwrap();
    assert!(!read("dem.tif").is_in_degrees() && !read("dem.npy").is_in_degrees());
}
