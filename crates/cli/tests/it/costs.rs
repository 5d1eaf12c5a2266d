//! Costs of cells: `run` and `reach` with `--costs`, and on a raster as the map.

use mediant_formats::{Georeference, Surface, SurfaceOptions, read_surface};
use serde_json::Value;

use crate::{
    common::{Files, mediant_with, run, succeeds},
    errors::check,
};

/// A map with a wall, and its costs: a road of cost 1 along the bottom, through land of cost 4.
const MAP: &str = "type octile\nheight 3\nwidth 5\nmap\n.....\n..@..\n.....\n";
const COSTS: &str = "ncols 5\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n\
                     4 4 4 4 4\n1 4 9 4 1\n1 1 1 1 1\n";

fn files() -> (Files, String) {
    let files = Files::new();
    let (map, costs) = (files.add("land.map", MAP), files.add("costs.asc", COSTS));
    (files, format!("{map} --costs {costs}"))
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).expect("a line of JSON")).collect()
}

#[test]
fn a_path_tells_its_cost_and_its_length() {
    let (_files, arguments) = files();
    let lines = lines(&succeeds(&format!("run {arguments} --from 0,0 --to 4,0 --k 2 --format jsonl")));
    let (run, query) = (&lines[0], &lines[1]);
    assert_eq!((&run["costs"], &run["engine"]), (&serde_json::json!([1.0, 4.0]), &"astar".into()));
    // Half a cell of cost 4, the road, and back: against 16 along the top.
    assert_eq!((query["cost"].as_f64(), query["length"].as_f64()), (Some(11.0), Some(8.0)));
    assert!(query["lower_bound"].is_null() && query["bound"].is_null());
    let text = succeeds(&format!("run {arguments} --from 0,0 --to 4,0 --k 2"));
    assert!(text.contains("11.0000") && text.contains("length 8.0000 cells"), "{text}");
    assert!(!text.contains("certificate"), "{text}");
    // Without costs the top is as short as can be.
    let plain = arguments.split(' ').next().expect("a map");
    let plain = self::lines(&succeeds(&format!("run {plain} --from 0,0 --to 4,0 --k 2 --format jsonl")));
    assert_eq!((plain[1]["cost"].as_f64(), plain[1].get("length")), (Some(4.0), None));
}

#[test]
fn a_table_is_of_costs_and_of_times() {
    let (files, arguments) = files();
    let table = "--from 0,0 --from 0,2 --to 4,0 --k 2 --format csv";
    let expected = "start_x,start_y,goal_x,goal_y,distance\n0,0,4,0,11\n0,2,4,0,7.5\n";
    assert_eq!(succeeds(&format!("table {arguments} {table}")), expected);
    let map = files.path("land.map");
    let flat = files.add("flat.asc", COSTS.replace(['9', '4'], "1"));
    let times = succeeds(&format!("table {map} --elevation {flat} {table}"));
    assert!(times.starts_with("start_x"), "{times}");
}

#[test]
fn lengths_of_a_scenario_are_no_costs() {
    let (files, arguments) = files();
    let scenario = files.add("land.scen", "version 1\n0\tland.map\t5\t3\t0\t0\t4\t0\t4\n");
    let text = succeeds(&format!("run {arguments} --scen {scenario} --k 2"));
    assert!(text.contains("11.0000") && !text.contains("reference"), "{text}");
    let lines = lines(&succeeds(&format!("run {arguments} --scen {scenario} --k 2 --format jsonl")));
    assert!(lines[1]["reference"].is_null() && lines[2]["reference"].is_null(), "{lines:?}");
}

#[test]
fn limits_are_in_costs() {
    let (_files, arguments) = files();
    let stopped =
        lines(&succeeds(&format!("run {arguments} --from 0,0 --to 4,0 --k 2 --max-cost 10 --format jsonl")));
    assert_eq!((&stopped[1]["status"], &stopped[1]["stopped_by"]), (&"stopped".into(), &"cost".into()));
    let reached = succeeds(&format!("reach {arguments} --from 0,2 --k 2 --within 2 -o -"));
    let expected = "x,y,distance\n0,1,1\n0,2,0\n1,2,1\n2,2,2\n";
    assert_eq!(reached, expected);
}

#[test]
fn a_raster_is_a_map_whose_numbers_are_costs() {
    let files = Files::new();
    let surface = Surface::new(3, 2, vec![2_u8, 2, 2, 0, 8, 2]).expect("six numbers");
    let place = Georeference::from_cell_size(30.0, 20.0).expect("a size");
    let surface = surface.with_no_data(Some(0.0)).with_georeference(place);
    for name in ["land.tif", "land.asc", "land.npy"] {
        let path = files.path(name);
        surface.save(&path).expect("it can be written");
        if name.ends_with("npy") {
            // It keeps neither the size of a cell nor what has no data.
            let message = format!("{path}: the cost of cell (0, 1) is 0: it must be a positive number");
            let ran = run(&format!("reach {path} --from 0,0"));
            assert!(ran.stderr.contains(&message), "{}", ran.stderr);
            continue;
        }
        let outputs = ["cost.tif", "cost.asc", "cost.npy"].map(|name| files.path(name));
        succeeds(&format!(
            "reach {path} --from 0,0 --k 2 -o {} -o {} -o {}",
            outputs[0], outputs[1], outputs[2]
        ));
        for output in outputs {
            let read = read_surface(&output, &SurfaceOptions::default()).expect("a raster");
            let costs: Vec<f64> = read.iter().map(|cost| cost.unwrap_or(f64::INFINITY)).collect();
            assert_eq!(costs, [0.0, 60.0, 120.0, f64::INFINITY, 160.0, 160.0], "{output} of {path}");
            let is_placed = !output.ends_with("npy");
            assert_eq!(read.cell_size(), is_placed.then_some((30.0, 20.0)), "{output} of {path}");
        }
    }
}

#[test]
fn landmarks_are_built_and_searched() {
    let (files, arguments) = files();
    let index = files.path("land.idx");
    let built = succeeds(&format!("build {arguments} --k 2 --landmarks 4 -o {index}"));
    assert!(built.contains("landmarks of land.map"), "{built}");
    let query = "--from 0,0 --to 4,0 --k 2 --format jsonl";
    let cost =
        |options: &str| lines(&succeeds(&format!("run {arguments} {query} {options}")))[1]["cost"].as_f64();
    let head = |options: &str| lines(&succeeds(&format!("run {arguments} {query} {options}"))).remove(0);
    for options in ["--engine landmarks", "--engine alt --landmarks 16", &format!("--index {index}")] {
        assert_eq!(cost(options), Some(11.0), "{options}");
        assert_eq!(head(options)["engine"], "landmarks", "{options}");
    }
    assert_eq!(head(&format!("--index {index}"))["landmarks"], 4);
    // The index belongs to the costs.
    let plain = arguments.split(' ').next().expect("a map");
    let ran = run(&format!("run {plain} --from 0,0 --to 4,0 --k 2 --index {index}"));
    assert!(ran.status == Some(2) && ran.stderr.contains("land.idx"), "{}", ran.stderr);
    check(
        &format!("build {arguments} --engine astar -o {index}"),
        "astar has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks",
    );
}

#[test]
fn paths_turn_at_any_angle_and_cost_no_more() {
    let (_files, arguments) = files();
    let line = |options: &str| {
        lines(&succeeds(&format!("run {arguments} --from 0,0 --to 4,0 --format jsonl {options}"))).remove(1)
    };
    let cost = |options: &str| line(options)["cost"].as_f64().expect("a path");
    let least = cost("--engine astar");
    for options in ["--engine theta", "--engine lazy-theta", "--smooth", "--engine landmarks --smooth"] {
        let found = line(options);
        assert!(cost(options) <= least && found["length"].as_f64() > Some(4.0), "{options}: {found}");
    }
    check(
        &format!("run {arguments} --from 0,0 --to 4,0 --smooth=taut"),
        "on costs of cells there is no taut smoothing: smooth linearly, which never costs more",
    );
}

#[test]
fn directions_and_allocation_are_written() {
    let (files, arguments) = files();
    let reach = format!("reach {arguments} --from 0,2 --from 4,2 --k 2");
    let expected = "x,y,source\n0,0,0\n1,0,0\n2,0,0\n3,0,1\n4,0,1\n0,1,0\n1,1,0\n3,1,1\n4,1,1\n0,2,0\n1,2,0\n\
                    2,2,0\n3,2,1\n4,2,1\n";
    assert_eq!(succeeds(&format!("{reach} --allocation -o -")), expected);
    let links = succeeds(&format!("{reach} --directions arcgis -o -"));
    // South, and west; a source is 0.
    for row in ["x,y,direction", "0,1,3", "1,2,5", "0,2,0"] {
        assert!(links.lines().any(|line| line == row), "{row}: {links}");
    }
    let grass = succeeds(&format!("{reach} --directions grass -o -"));
    assert!(grass.contains("\n0,1,270\n") && !grass.contains("\n0,2,"), "{grass}");
    assert!(succeeds(&format!("{reach} --directions degrees -o -")).contains("\n1,2,270\n"));
    let outputs = ["links.tif", "links.npy", "links.png"].map(|name| files.path(name));
    let written = format!("-o {} -o {} -o {}", outputs[0], outputs[1], outputs[2]);
    succeeds(&format!("{reach} --directions arcgis {written}"));
    let read = read_surface(&outputs[0], &SurfaceOptions::default()).expect("a raster");
    assert_eq!(read.iter().filter(Option::is_none).count(), 1, "the wall");
    check(
        &format!("{reach} --k 4 --directions arcgis -o -").replace("--k 2 ", ""),
        "back links of ArcGIS are for k = 2 and 3, not for k = 4: choose --directions degrees",
    );
}

#[test]
fn what_does_not_go_with_costs_is_said() {
    let (files, arguments) = files();
    check(
        &format!("run {arguments} --from 0,0 --to 4,0 --engine jps"),
        "jps knows no costs of cells: on costs choose astar, dijkstra, theta, lazy-theta, landmarks",
    );
    let cure =
        "choose a k from 2 to 8 (4 to 256 neighbors), by astar, dijkstra, theta, lazy-theta, landmarks";
    for (options, k) in
        [("--k any", "any"), ("--engine anya", "any"), ("--k any --engine theta", "any"), ("--k 9", "9")]
    {
        check(
            &format!("run {arguments} --from 0,0 --to 4,0 {options}"),
            &format!("on costs of cells no engine searches k = {k}: {cure}"),
        );
    }
    check(
        &format!("run {} --elevation --from 0,0 --to 4,0 --k any", files.path("costs.asc")),
        "on costs of cells no engine searches k = any: choose a k from 2 to 8 (4 to 256 neighbors), by astar, dijkstra",
    );
    check(
        &format!("run {arguments} --from 0,0 --to 4,0 --radius 1"),
        "--radius does not go with costs: leave it out, or leave the costs out",
    );
    let small = files.add("small.asc", "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 1\n");
    let map = files.path("land.map");
    check(
        &format!("reach {map} --from 0,0 --costs {small}"),
        &format!(
            "{small}: 2 columns and 1 rows of numbers, and the map has 5 and 3: give one number for each cell"
        ),
    );
    let wrong = files.add("wrong.asc", COSTS.replace("9 4 1", "9 -4 1"));
    check(
        &format!("reach {map} --from 0,0 --costs {wrong}"),
        &format!(
            "{wrong}: the cost of cell (3, 1) is -4: it must be a positive number, from 1e-120 to 1e120; a cell that \
             cannot be entered is marked as blocked, not by its cost: in a raster it has no data (NaN in NPY, or \
             --no-data VALUE); for heights there is --elevation"
        ),
    );
    check(
        &format!("reach {small} --from 0,0 --costs {small}"),
        &format!(
            "--costs {small} for small.asc, whose cells have numbers of their own: leave one of the two out"
        ),
    );
    check(
        &format!("reach {small} --from 0.5,0.5 --world"),
        "small.asc is a raster, on which places are columns and rows of cells: leave --world out, and count them \
         from 0, from the left and from the top",
    );
    check(
        &format!("reach {small} --from 0,0 --free W"),
        "the map small.asc has no characters for tiles: leave --free out, or give a MovingAI map",
    );
    for options in ["--to 4,0 --unblock 2,1", "--to 2,1 --free-ends"] {
        let ran = run(&format!("run {arguments} --from 0,0 {options}"));
        let said = "error: cell (2, 1) is blocked and has no cost, so that it cannot be freed: leave --unblock and \
                    --free-ends out, or give it a cost in the raster\n";
        assert_eq!((ran.status, ran.stderr.as_str()), (Some(2), said), "{options}");
    }
    let missing = run(&format!("reach {map} --from 0,0 --costs no.tif"));
    assert!(missing.status == Some(2) && missing.stderr.contains("no.tif"), "{}", missing.stderr);
}

#[test]
fn pictures_show_the_land() {
    let (files, arguments) = files();
    let picture = |line: &str, name: &str| {
        let path = files.path(name);
        succeeds(&format!("run {line} --from 0,0 --to 4,0 --draw {path}"));
        std::fs::read(path).expect("a picture")
    };
    let svg = |line: &str| String::from_utf8(picture(line, "path.svg")).expect("text");
    let plain = arguments.split(' ').next().expect("a map");
    assert!(svg(plain).contains("expanded: ") && !svg(plain).contains("colors: "));
    let land = svg(&arguments);
    assert!(!land.contains("expanded: "), "{land}");
    for part in ["1 to 4", "colors: what a unit of length costs"] {
        assert!(land.contains(part), "{part}: {land}");
    }
    assert!(svg(&format!("{} --elevation", files.path("costs.asc"))).contains("colors: elevation"));
    // At corners a vertex has the mean of the free cells around it: 4, 4 and 9.
    let swamp = files.add("swamp.asc", COSTS.replace("1 4 9 4 1", "1 9 9 4 1"));
    let at_corners = svg(&format!("{plain} --costs {swamp} --placement corner"));
    assert!(at_corners.contains(">1 to 5.67<"), "{at_corners}");
    assert_ne!(picture(plain, "path.png"), picture(&arguments, "path.png"));
    // On the screen dear cells are lighter.
    let screen = |line: &str| {
        let line = format!("run {line} --from 0,0 --to 4,0 --k 2 --engine astar --draw");
        let words: Vec<&str> = line.split(' ').collect();
        mediant_with(&words, &[("CLICOLOR_FORCE", "1"), ("COLORTERM", "truecolor")]).stdout
    };
    let [cheap, dear] = ["48;2;22;38;46m", "48;2;154;98;44m"];
    let drawn = screen(&arguments);
    assert!(drawn.contains(cheap) && drawn.contains(dear), "{drawn}");
    assert!(!screen(plain).contains(cheap) && !screen(plain).contains(dear));
}

#[test]
fn bands_and_numbers_for_no_data_are_honored() {
    let (files, arguments) = files();
    // Two bands of 2 × 3 cells.
    let text = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 3)}";
    let begin = [b"\x93NUMPY\x01\0", &(text.len() as u16).to_le_bytes()[..], text.as_bytes()].concat();
    let array = files.add("bands.npy", [&begin[..], &[1, 1, 1, 1, 1, 1], &[2, 7, 2, 2, 2, 2]].concat());
    let reach = |options: &str| succeeds(&format!("reach {array} --from 0,0 --k 2 -o - {options}"));
    assert!(reach("--band 1").contains("\n2,0,2\n") && reach("--band 2").contains("\n2,0,8\n"));
    assert!(!reach("--band 2 --no-data 7").contains("\n1,0,"));
    let ran = run(&format!("reach {array} --from 0,0"));
    assert!(ran.status == Some(2) && ran.stderr.contains("one band, found 2"), "{}", ran.stderr);
    let costs = files.path("costs.asc");
    check(
        &format!("reach {arguments} --from 0,0 --band 2"),
        &format!("{costs}: expected band 1, which is the only one, found 2; name no band"),
    );
    // It counts more than what the file says.
    let ran = run(&format!("reach {arguments} --from 0,0 --k 2 --no-data 4"));
    assert!(ran.status == Some(1) && ran.stderr.contains("(0, 0) is blocked"), "{}", ran.stderr);
    let heights = files.path("heights.npy");
    Surface::new(3, 1, vec![-1.0_f32, 5.0, -9999.0]).expect("three").save(&heights).expect("a file");
    let walk = format!("reach {heights} --elevation --cell-size 10 --from 0,0 -o -");
    assert_eq!(succeeds(&format!("{walk} --no-data -9999")).lines().count(), 3);
    assert_eq!(succeeds(&walk).lines().count(), 4);
    // A picture of gray, and what is written of it.
    let gray = files.path("gray.png");
    Surface::new(3, 1, vec![0_u8, 5, 9]).expect("three").save(&gray).expect("a file");
    let written = files.path("gray.npy");
    succeeds(&format!("convert {gray} --no-data 0 -o {written}"));
    let read = read_surface(&written, &SurfaceOptions::default()).expect("a raster");
    assert_eq!(read.iter().collect::<Vec<_>>(), [None, Some(5.0), Some(9.0)]);
    let map = files.path("band.map");
    succeeds(&format!("convert {array} --band 2 --no-data 7 -o {map}"));
    assert!(std::fs::read_to_string(&map).expect("a map").contains("\n.@.\n...\n"));
    for option in ["--band 1", "--no-data 0"] {
        let name = option.split(' ').next().expect("a name");
        for line in ["reach builtin:cave --from 2,5".to_owned(), format!("convert builtin:cave -o {map}")] {
            check(
                &format!("{line} {option}"),
                &format!("{name} is for a raster of costs or elevations: leave it out, or give one"),
            );
        }
    }
    let ran = run(&format!("reach {array} --from 0,0 --no-data none"));
    assert!(ran.status == Some(2) && ran.stderr.contains("such as -9999"), "{}", ran.stderr);
}

#[test]
fn a_grid_in_degrees_is_refused() {
    let (files, arguments) = files();
    files.add("costs.prj", "PROJCS[\"UTM\",GEOGCS[\"WGS 84\"]]");
    succeeds(&format!("reach {arguments} --from 0,0"));
    files.add("costs.prj", "GEOGCS[\"WGS 84\"]");
    let costs = files.path("costs.asc");
    let degrees = format!(
        "{costs}: the coordinates are degrees, and the width of a cell differs from row to row: project it to \
         meters first, as by `gdalwarp -t_srs EPSG:3857`, or better by a projection that keeps lengths there"
    );
    for line in [format!("reach {arguments}"), format!("reach {costs}"), format!("reach {costs} --elevation")]
    {
        check(&format!("{line} --from 0,0"), &degrees);
    }
}

/// The places of a CSV, and their numbers.
fn number(csv: &str) -> Vec<(String, f64)> {
    let rows = csv.lines().skip(1).map(|row| row.rsplit_once(',').expect("a number"));
    rows.map(|(at, cost)| (at.to_owned(), cost.parse().expect("a number"))).collect()
}

#[test]
fn a_corridor_is_the_least_cost_over_each_cell() {
    let (_files, arguments) = files();
    for motion in ["--k 2", "--k 4", "--k 5 --placement corner"] {
        let reach = format!("reach {arguments} {motion} -o -");
        let [from, to] =
            ["--from 0,0 --from 0,2", "--from 4,0"].map(|ends| number(&succeeds(&format!("{reach} {ends}"))));
        let text = succeeds(&format!("{reach} --from 0,0 --from 0,2 --to 4,0 --corridor"));
        assert!(text.starts_with("x,y,cost\n"), "{text}");
        let corridor = number(&text);
        assert_eq!(corridor.len(), from.len(), "{motion}");
        for (((at, sum), one), other) in corridor.iter().zip(&from).zip(&to) {
            assert!(*at == one.0 && *at == other.0, "{motion}: {at}");
            assert!((sum - one.1 - other.1).abs() < 1e-9 * sum, "{motion}: {at}");
        }
        let least = corridor.iter().map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min);
        let near = number(&succeeds(&format!(
            "{reach} --from 0,0 --from 0,2 --to 4,0 --corridor --within {}",
            least + 1.0
        )));
        assert!(near.iter().all(|(_, cost)| *cost <= least + 1.0) && !near.is_empty(), "{motion}");
        assert_eq!(near.len(), corridor.iter().filter(|(_, cost)| *cost <= least + 1.0).count(), "{motion}");
        let said = succeeds(&format!("reach {arguments} {motion} --from 0,0 --from 0,2 --to 4,0 --corridor"));
        assert!(said.contains(&format!("on ways from 2 sources to (4, 0), the best {least:.4}")), "{said}");
    }
}

#[test]
fn a_corridor_is_written_in_all_formats() {
    let (files, arguments) = files();
    let outputs = ["way.tif", "way.asc", "way.npy", "way.png", "way.svg"].map(|name| files.path(name));
    let written = outputs.iter().map(|path| format!(" -o {path}")).collect::<String>();
    succeeds(&format!("reach {arguments} --k 2 --from 0,2 --to 4,2 --corridor{written}"));
    for output in &outputs[..3] {
        let read = read_surface(output, &SurfaceOptions::default()).expect("a raster");
        let costs = [0, 1, 2, 3, 4].map(|x| read.get(x, 2));
        assert_eq!((costs, read.get(2, 0)), ([Some(4.0); 5], Some(23.0)), "{output}");
    }
    assert_eq!(
        read_surface(&outputs[0], &SurfaceOptions::default()).expect("a raster").get(2, 1),
        None,
        "the wall"
    );
}

#[test]
fn a_corridor_is_of_lengths_or_of_times() {
    let (files, arguments) = files();
    // On a map without costs they are lengths, over elevation times there and on.
    let map = files.path("land.map");
    let plain = succeeds(&format!("reach {map} --k 2 --from 0,0 --to 4,0 --corridor -o -"));
    assert!(plain.contains("\n2,0,4\n") && plain.contains("\n2,2,8\n"), "{plain}");
    let hill = files.add("hill.asc", "ncols 3\nnrows 1\ncellsize 10\n0 5 9\n");
    let time = |ends: &str| {
        let times = number(&succeeds(&format!("reach {hill} --elevation {ends} -o -")));
        times.iter().map(|(_, time)| *time).collect::<Vec<f64>>()
    };
    let (up, all) = (time("--from 0,0")[2], time("--from 0,0 --to 2,0 --corridor"));
    assert!(all.len() == 3 && all.iter().all(|time| (time - up).abs() < 1e-6 * up), "{all:?}, not {up}");
    let apart = files.add("apart.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let said = succeeds(&format!("reach {apart} --from 0,0 --to 2,0 --corridor"));
    assert!(said.ends_with("no way from (0, 0) to (2, 0)\n"), "{said}");
    check(
        &format!("reach {arguments} --from 0,0 --to 4,0"),
        "--from cannot be used with --to but for the paths between them: leave one of the two out, or give --corridor",
    );
    for (options, part) in
        [("--corridor", "--to"), ("--to 4,0 --corridor --allocation", "cannot be used with")]
    {
        let ran = run(&format!("reach {arguments} --from 0,0 {options}"));
        assert!(ran.status == Some(2) && ran.stderr.contains(part), "{options}: {}", ran.stderr);
    }
    let ran = run(&format!("reach {arguments} --from 0,0 --to 2,1 --corridor"));
    assert!(ran.status == Some(1) && ran.stderr.contains("the goal (2, 1) is blocked"), "{}", ran.stderr);
}
