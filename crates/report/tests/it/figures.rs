//! Figures: a snapshot of each kind, and what holds for every figure, checked on random ones from fixed
//! seeds.

use mediant_grid::{AsciiMap, Grid};
use mediant_moves::{DecompositionTree, FiniteK, Vector};
use mediant_report::{Axis, Chart, GridDrawing, Mark, NeighborhoodDrawing, Scale, Series, TreeDrawing};

use crate::svg::{Element, check, points, texts};

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Mostly usual numbers, sometimes one of any size and sign, sometimes one that no axis can show.
    fn value(&mut self) -> f64 {
        const ODD: [f64; 10] = [
            0.0,
            -0.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN,
            f64::MIN_POSITIVE,
            5e-324,
            -1.0,
        ];
        match self.below(12) {
            0 => ODD[self.below(10) as usize],
            1 => (self.unit() - 0.5) * 10_f64.powi(self.below(600) as i32 - 300),
            _ => 100.0 * self.unit(),
        }
    }
}

fn marks(elements: &[Element]) -> usize {
    elements.iter().filter(|element| element.is("mark") || element.is("hollow")).count()
}

fn small_chart() -> Chart {
    let x = Axis::new("k").ticks((2..6).map(|k| (f64::from(k), format!("k = {k}"))));
    Chart::new("Nodes expanded", x, Axis::new("nodes, mean").log())
        .note("20 instances; seed 7")
        .series(Series::new("A*", Mark::Line, [(2.0, 31.0), (3.0, 470.0), (4.0, 1250.0), (5.0, 3100.0)]))
        .series(
            Series::new("JPS", Mark::Points, [(2.0, 3.0), (3.0, 0.0), (5.0, 9.0)])
                .labels(["2 µs", "3 µs", "5 µs"].map(str::to_owned))
                .hollow(),
        )
        .series(Series::new("bound", Mark::Reference, [(2.0, 100.0), (5.0, 100.0)]))
}

fn tree(v: (i32, i32), k: u32) -> DecompositionTree {
    DecompositionTree::new(Vector::new(v.0, v.1), FiniteK::new(k).expect("a k"))
        .expect("a move of level k or more")
}

fn small_map() -> Grid {
    let drawing = "
        .....
        .##..
        .##..
        ....#
    ";
    AsciiMap::parse(drawing).expect("a map").grid
}

#[test]
fn a_chart_is_drawn() {
    insta::assert_snapshot!(small_chart().svg());
}

#[test]
fn a_map_is_drawn() {
    let drawing = GridDrawing::new("Around a block", &small_map())
        .note("center placement")
        .path("k = 2", [(0.5, 0.5), (0.5, 3.5), (3.5, 3.5)])
        .path("shortest", [(0.5, 0.5), (0.5, 2.5), (1.5, 3.5), (3.5, 3.5)]);
    insta::assert_snapshot!(drawing.svg());
}

/// Each path has a group of its own, and the same elements as in the drawing that stands still.
#[test]
fn paths_come_forward_in_turn() {
    let drawing = GridDrawing::new("Around a block", &small_map())
        .path("k = 2", [(0.5, 0.5), (0.5, 3.5), (3.5, 3.5)])
        .path("shortest", [(0.5, 0.5), (0.5, 2.5), (1.5, 3.5), (3.5, 3.5)]);
    let still = drawing.svg();
    let moving = drawing.in_turn().svg();
    let groups: Vec<String> = check(&moving, "in turn")
        .iter()
        .filter(|element| element.name == "g")
        .filter_map(|element| element.attribute("class").map(str::to_owned))
        .collect();
    assert_eq!(groups, ["turn turn0", "turn turn1"]);
    assert_eq!(moving.matches("@keyframes").count(), 2);
    // At the turn of each the other is faint; at the last turns both are there.
    let rule = "@keyframes turn1{0%,25.0%{opacity:0.1}30.0%,50.0%{opacity:1}100%{opacity:1}}";
    assert!(moving.contains(rule), "{moving}");
    let is_of_turns = |line: &&str| line.contains("turn") || *line == "</g>";
    let without: Vec<&str> = moving.lines().filter(|line| !is_of_turns(line)).collect();
    assert_eq!(without, still.lines().collect::<Vec<_>>());
}

/// A tip for each move, and as many corners on the circle.
#[test]
fn neighborhoods_are_drawn() -> Result<(), mediant_moves::KError> {
    let ks = || (2..=6).filter_map(|k| FiniteK::new(k).ok());
    let moves = check(&NeighborhoodDrawing::moves("Moves", ks())?.note("of five k").svg(), "moves");
    let tips = |elements: &[Element], class: &str| {
        elements.iter().filter(|element| element.name == "circle" && element.is(class)).count()
    };
    // The five centers are gray, as are the moves that N(k − 1) has.
    assert_eq!((tips(&moves, "s1"), tips(&moves, "r")), (4 + 4 + 8 + 16 + 32, 5 + 4 + 8 + 16 + 32));
    let reach = NeighborhoodDrawing::reach("Reach", ks())?.svg();
    let figures: Vec<usize> = check(&reach, "reach")
        .iter()
        .filter(|element| element.name == "path" && element.is("s0"))
        .map(|element| points(element).len())
        .collect();
    assert_eq!(figures, [4, 8, 16, 32, 64]);
    assert!(reach.contains("at worst 8.24 % longer") && reach.contains("at worst 0.75 % longer"));
    Ok(())
}

#[test]
fn trees_are_drawn() {
    let drawing = TreeDrawing::new("The move (3, 2)").note("Kramm et al. 2018, Algorithm 2");
    let drawing =
        (3..=5).rev().fold(drawing, |drawing, k| drawing.tree(format!("level {k}"), &tree((3, 2), k)));
    insta::assert_snapshot!(drawing.svg());
}

fn random_axis(random: &mut Random) -> Axis {
    let mut axis = Axis::new("number & <unit>");
    if random.below(2) == 0 {
        axis = axis.log();
    }
    if random.below(4) == 0 {
        axis = axis.range(random.value(), random.value());
    }
    if random.below(4) == 0 {
        let count = random.below(60);
        axis = axis.ticks((0..count).map(|i| (random.value(), format!("map {i}"))).collect::<Vec<_>>());
    }
    axis
}

#[test]
fn every_chart_is_whole() {
    let (mut lines, mut drawn) = (0, 0);
    for seed in 0..150 {
        let mut random = Random(seed);
        let (x, y) = (random_axis(&mut random), random_axis(&mut random));
        let mut chart = Chart::new("Chart", x, y).note("note");
        let (mut names, mut labels, mut expected) = (Vec::new(), Vec::new(), 0);
        for i in 0..random.below(20) {
            let mark = [Mark::Line, Mark::Points, Mark::Reference][random.below(3) as usize];
            let count = [0, 1, 2, 12, 60][random.below(5) as usize];
            let at: Vec<(f64, f64)> = (0..count).map(|_| (random.value(), random.value())).collect();
            let finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
            let name = format!("s{i}<&");
            let mut series = Series::new(&name, mark, at.clone());
            names.push(name);
            if random.below(3) == 0 {
                let texts: Vec<String> = (0..count).map(|j| format!("p{i}.{j}")).collect();
                let seen = at.iter().zip(&texts).filter(|(at, _)| finite(at) && mark != Mark::Reference);
                labels.extend(seen.map(|(_, text)| text.clone()));
                series = series.labels(texts);
            }
            if mark != Mark::Reference {
                // One in the legend, one at each point.
                expected += 1 + at.iter().filter(|at| finite(at)).count();
            }
            if random.below(4) == 0 {
                series = series.style(random.next() as usize).hollow();
            }
            chart.push(series);
        }
        let svg = chart.svg();
        assert_eq!(svg, chart.svg(), "seed {seed}: the same bytes each time");
        let elements = check(&svg, &format!("seed {seed}"));
        assert_eq!(marks(&elements), expected, "seed {seed}: a marker a point");
        let texts = texts(&elements);
        for text in names.iter().chain(&labels) {
            assert!(texts.contains(text), "seed {seed}: {text} is not named");
        }
        lines += elements.iter().filter(|element| element.is("curve")).count();
        drawn += expected;
    }
    assert!(lines > 500 && drawn > 5_000, "{lines} lines, {drawn} markers: too few to show anything");
}

#[test]
fn charts_with_next_to_nothing_are_drawn() {
    let one = vec![(3.0, 4.0)];
    let equal = vec![(1.0, 5.0), (1.0, 5.0), (1.0, 5.0)];
    let zero = vec![(0.0, 0.0), (0.0, 0.0)];
    let none = vec![(f64::NAN, 1.0), (1.0, f64::INFINITY)];
    let huge = vec![(f64::MAX, f64::MAX), (f64::MIN, f64::MIN), (1e-310, 5e-324)];
    let close = vec![(1.0, 1e15), (1.0 + 1e-15, 1e15 + 1.0)];
    for (points, count) in [(vec![], 0), (one, 1), (equal, 3), (zero, 2), (none, 0), (huge, 3), (close, 2)] {
        for mark in [Mark::Line, Mark::Points] {
            for log in [false, true] {
                let axis = || if log { Axis::new("a").log() } else { Axis::new("a") };
                assert_eq!(axis().scale(), if log { Scale::Log } else { Scale::Linear });
                let chart = Chart::new("t", axis(), axis()).series(Series::new("s", mark, points.clone()));
                let what = format!("{points:?} {mark:?} {:?}", axis().scale());
                assert_eq!(marks(&check(&chart.svg(), &what)), count + 1, "{what}");
            }
        }
    }
    assert_eq!(marks(&check(&Chart::new("", Axis::new(""), Axis::new("")).svg(), "no series")), 0);
}

#[test]
fn what_an_axis_cannot_show_is_on_its_border() {
    let chart = Chart::new("t", Axis::new("x"), Axis::new("y").log()).series(Series::new(
        "s",
        Mark::Points,
        [(1.0, 0.03), (2.0, 0.0), (3.0, -4.0), (4.0, 7.0)],
    ));
    let elements = check(&chart.svg(), "clamped");
    let hollow: Vec<f64> =
        elements.iter().filter(|element| element.is("hollow")).map(|element| element.number("cy")).collect();
    assert_eq!(hollow.len(), 2, "0 and −4 are hollow");
    assert_eq!(hollow[0], hollow[1], "on one border");
    let filled = elements.iter().filter(|element| element.is("mark") && element.name == "circle");
    assert!(filled.map(|element| element.number("cy")).all(|y| y < hollow[0]), "below all others");
    assert!(texts(&elements).contains(&"≤ 0.01".to_owned()), "{:?}", texts(&elements));

    let chart = Chart::new("t", Axis::new("x").range(0.0, 3.0), Axis::new("y")).series(Series::new(
        "s",
        Mark::Points,
        [(1.0, 1.0), (4.0, 1.0)],
    ));
    let elements = check(&chart.svg(), "beyond a range");
    assert_eq!(elements.iter().filter(|element| element.is("hollow")).count(), 1);
    assert!(texts(&elements).contains(&"≥ 3".to_owned()), "{:?}", texts(&elements));
}

#[test]
fn references_are_cut_not_bent() {
    let chart = Chart::new("t", Axis::new("x").range(0.0, 1.0), Axis::new("y").range(0.0, 1.0))
        .series(Series::new("inside", Mark::Points, [(0.5, 0.5)]))
        .series(Series::new("y = x", Mark::Reference, [(-1e6, -1e6), (1e6, 1e6)]))
        .series(Series::new("outside", Mark::Reference, [(0.0, 2.0), (1.0, 3.0)]));
    let elements = check(&chart.svg(), "references");
    let point = points(elements.iter().find(|element| element.is("mark")).expect("a marker"))[0];
    let lines: Vec<Vec<(f64, f64)>> = elements.iter().filter(|element| element.is("r")).map(points).collect();
    // One in the plot and two in the legend.
    assert_eq!(lines.len(), 3, "{lines:?}");
    let (from, to) = (lines[0][0], lines[0][1]);
    let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
    assert!((middle.0 - point.0).hypot(middle.1 - point.1) < 0.1, "{middle:?} is not {point:?}");
    assert!((from.0 - to.0).abs() > 100.0 && !texts(&elements).iter().any(|text| text.contains('≥')));
}

#[test]
fn lines_break_where_nothing_was_measured() {
    let points = [(1.0, 1.0), (2.0, 2.0), (3.0, f64::NAN), (4.0, 2.0), (5.0, 1.0)];
    let chart = Chart::new("t", Axis::new("x"), Axis::new("y")).series(Series::new("s", Mark::Line, points));
    let elements = check(&chart.svg(), "a gap");
    // The legend has one as well.
    assert_eq!(elements.iter().filter(|element| element.is("curve")).count(), 3);
    assert_eq!(marks(&elements), 5);
}

#[test]
fn the_first_series_differ_in_all() {
    let mut chart = Chart::new("t", Axis::new("x"), Axis::new("y"));
    for i in 0..72 {
        chart.push(Series::new(format!("s{i}"), Mark::Line, [(f64::NAN, 0.0)]));
    }
    let elements = check(&chart.svg(), "legend");
    let class = |element: &Element| element.attribute("class").unwrap_or_default().to_owned();
    let lines: Vec<String> = elements.iter().filter(|element| element.is("curve")).map(class).collect();
    let markers: Vec<&Element> = elements.iter().filter(|element| element.is("mark")).collect();
    let shape = |element: &Element| {
        let at = points(element);
        let relative = at.iter().map(|p| ((p.0 - at[0].0) * 5.0, (p.1 - at[0].1) * 5.0));
        relative.map(|(x, y)| format!("{x:.0},{y:.0} ")).collect::<String>()
    };
    let shapes: Vec<String> = markers.iter().map(|element| shape(element)).collect();
    assert_eq!((lines.len(), shapes.len()), (72, 72));
    for i in 0..72 {
        for j in 0..i {
            assert!((&lines[i], &shapes[i]) != (&lines[j], &shapes[j]), "{i} looks like {j}");
            let color = |line: &str| line.split(' ').find(|class| class.starts_with('s')).map(str::to_owned);
            assert!(i >= 8 || (color(&lines[i]) != color(&lines[j]) && shapes[i] != shapes[j]), "{i}, {j}");
        }
    }
}

#[test]
fn text_is_escaped() {
    const NASTY: &str = "</text><script>\"a\" & 'b'\u{7}";
    const SEEN: &str = "</text><script>\"a\" & 'b'";
    let chart = Chart::new(NASTY, Axis::new(NASTY).ticks([(1.0, NASTY.to_owned())]), Axis::new(NASTY))
        .note(NASTY)
        .series(Series::new(NASTY, Mark::Line, [(1.0, 1.0)]).labels([NASTY.to_owned()]));
    let map = GridDrawing::new(NASTY, &small_map()).note(NASTY).path(NASTY, [(0.0, 0.0), (1.0, 1.0)]);
    let trees = TreeDrawing::new(NASTY).note(NASTY).tree(NASTY, &tree((2, 1), 3));
    // Title, note, axes, tick, series, label; title, note, path; title, note, caption.
    for (svg, count) in [(chart.svg(), 7), (map.svg(), 3), (trees.svg(), 3)] {
        let texts = texts(&check(&svg, "escaped"));
        // A long text is broken into lines.
        let all = texts.join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(all.matches(SEEN).count(), count, "{all}");
        assert!(!svg.contains("<script"));
    }
}

#[test]
fn every_map_is_whole() {
    for seed in 0..60 {
        let mut random = Random(seed);
        let (width, height) = (1 + random.below(70) as u32, 1 + random.below(70) as u32);
        let mut blocked: Vec<bool> = (0..width * height).map(|_| random.below(3) == 0).collect();
        blocked[0] = true;
        let grid = Grid::from_fn(width, height, |x, y| blocked[(y * width + x) as usize]).expect("a map");
        let path: Vec<(f64, f64)> = (0..random.below(6)).map(|_| (random.value(), random.value())).collect();
        let svg = GridDrawing::new("Map", &grid).path("some way", path).svg();
        let elements = check(&svg, &format!("seed {seed}"));
        assert!(texts(&elements).contains(&"some way".to_owned()), "seed {seed}");
        // The rectangles cover just the blocked cells, each once.
        let mut covered = vec![0; blocked.len()];
        let walls = elements.iter().find(|element| element.is("wall")).expect("a blocked cell");
        let d = walls.attribute("d").expect("a path");
        for rectangle in d.split('M').filter(|part| !part.is_empty()) {
            let numbers: Vec<u32> = rectangle
                .split(|c: char| !c.is_ascii_digit())
                .filter(|part| !part.is_empty())
                .map(|part| part.parse().expect("a cell"))
                .collect();
            let [left, top, right, bottom, _] = numbers[..] else { panic!("{rectangle}") };
            for y in top..bottom {
                (left..right).for_each(|x| covered[(y * width + x) as usize] += 1);
            }
        }
        let expected: Vec<i32> = blocked.iter().map(|&blocked| i32::from(blocked)).collect();
        assert_eq!(covered, expected, "seed {seed}");
    }
}

#[test]
fn every_tree_is_whole() {
    for v in [(1, 0), (0, -1), (-7, 5), (13, 8), (60, 1), (-1, -90)] {
        let trees: Vec<DecompositionTree> = (2..=9)
            .filter_map(|k| DecompositionTree::new(Vector::new(v.0, v.1), FiniteK::new(k).expect("a k")))
            .collect();
        assert!(!trees.is_empty(), "{v:?} is a move");
        let drawing = trees.iter().fold(TreeDrawing::new("t"), |drawing, tree| drawing.tree("level", tree));
        let elements = check(&drawing.svg(), &format!("{v:?}"));
        let count = |class: &str| elements.iter().filter(|element| element.is(class)).count();
        let leaves: usize = trees.iter().map(|tree| tree.leaves().count()).sum();
        let nodes: usize = trees.iter().map(|tree| tree.nodes().len()).sum();
        assert_eq!((count("leaf"), count("node")), (leaves, nodes - leaves), "{v:?}");
        assert_eq!(count("edge"), nodes - trees.len(), "{v:?}: a tree has one edge less than nodes");
        let boxes: Vec<Vec<(f64, f64)>> =
            elements.iter().filter(|element| element.is("leaf") || element.is("node")).map(points).collect();
        for (i, a) in boxes.iter().enumerate() {
            for b in &boxes[..i] {
                let apart = a[1].0 < b[0].0 || b[1].0 < a[0].0 || a[1].1 < b[0].1 || b[1].1 < a[0].1;
                assert!(apart, "{v:?}: {a:?} covers {b:?}");
            }
        }
    }
    assert_eq!(check(&TreeDrawing::new("none").svg(), "no tree").len(), 6);
}
