// A use of all that the package has, for the compiler. No line of it runs.

import init, {
  type Answer,
  bound,
  type CostmapOptions,
  type Costs,
  checkSetup,
  type EngineInfo,
  type Exceptions,
  engines,
  type Field,
  type Goals,
  Grid,
  type How,
  type Index,
  type InflationOptions,
  initSync,
  type MapOptions,
  type MediantError,
  type Motion,
  moves,
  type NearestGoal,
  type Options,
  Picture,
  type Planner,
  type Point,
  type Points,
  type Radius,
  Scenario,
  type Space,
  spaced,
  Trace,
  version,
  type WholeMotion,
  type WidestPath,
  type Wishes,
  World,
} from "mediant";

const bytes = new Uint8Array();
await init({ module_or_path: bytes });
initSync({ module: bytes });

const text: string = version();
const all: EngineInfo[] = engines();
const able = all.map(({ name, title, how, placements, maxK, any, guarantee, paper, index, options }) =>
  [name, title, how, placements.join(), maxK.toFixed(), any, guarantee, paper, index, options.join()].join(),
);
const star: Int32Array = moves(4);

const motion: Motion = { k: 3, placement: "center", corners: "one" };
const any: Motion = { k: "any", gap: "closed" };
const factor: number | undefined = bound(motion) ?? bound({ neighbors: 8 });
const why: string | undefined = checkSetup("anya", any, { smooth: "taut" });

const picture: MapOptions = { threshold: 0.3, invert: true, unknown: "free", ros: 1, free: "W" };
const read = Grid.read("map.yaml", bytes, { "map.pgm": bytes }, picture);
const [width, height]: [number, number] | Int32Array | number[] = Grid.size("map.png", bytes);
const rows = Grid.fromRows(["..", ".#"], { free: ".", blocked: "#" });
const grid = new Grid(2, 2, new Uint8Array(4)).edit(0, 0, 1, 1, Uint8Array.of(1));
const clearance: Float64Array = grid.clearance();
const smaller: Grid = grid.forDisc(1.5, any).forSquare(2);
const costs: Costs = Float32Array.of(1, 2, 4, 8);
const land: Grid = new Grid(2, 2, new Uint8Array(4), { costs, cellSize: [30, 20] })
  .withCosts([1, 2, 3, 4], [1, 1])
  .editCosts([[0, 0]], [null])
  .editCosts([0, 0], 2);
const soft: InflationOptions = { inflationRadius: 2, inscribedRadius: 1, costScalingFactor: 3, weight: 4 };
const unknown: CostmapOptions = { weight: 1, unknown: 252 };
const robots: Grid = Grid.fromCostmap(2, 1, Uint8ClampedArray.of(0, 255), unknown);
const each: Float64Array | undefined = grid.inflated(soft).costs() ?? robots.costs() ?? land.costs();
const [wide, high]: readonly [number, number] = land.cellSize ?? [1, 1];
const price: number | undefined = land.space({ k: 3 }).editCosts([1, 1], 5).cost(new Int32Array(4));
const { cost, length }: Answer = land.find([0, 0], [1, 1]);
const world: World = new World(2, 2, 0.05, [1, 2]);
const placed: Grid = grid
  .withWorld(world)
  .editCells([[0, 0]], true)
  .editCells([0, 1], Uint8Array.of(1));
const radius: Radius = { meters: 0.02 };
const fitted: Grid = placed.forDisc(radius, motion);
const sizes: number[] = [fitted.width, world.width, world.height];
const place: [number, number, number] = placed.world?.origin ?? [world.resolution, world.cells(1), 0];
const where: Point | undefined = world.vertexAt(1.02, 2.02, "corner") ?? world.placeAt(1.02, 2.02);
const meters: Float64Array = world.pointOf([0, 0]);
const scenario: Scenario = Scenario.read(bytes);
scenario.check(grid);
const instances: [Int32Array, Int32Array, Float64Array] = [
  scenario.starts(),
  scenario.goals(),
  scenario.lengths(),
];
const groups: [number, Uint32Array, string[]] = [scenario.length, scenario.buckets(), scenario.maps()];
const facts = [grid.width, grid.height, grid.id, grid.cells().length, grid.isBlocked(0, 1), grid.toMap()];

const from: Point = [0, 0];
const to: Points = [
  [1, 1],
  [2, 2],
];
const how: How = { ...motion, engine: "jps", nearest: true, heuristic: "euclidean" };
const path: Int32Array | Float64Array | undefined = rows.path(from, Int32Array.of(1, 1, 2, 2), how);

using space: Space = read.space(motion);
const whole: WholeMotion = space.motion;
const { engine, why: because } = space.engine();
const seen: boolean[] = [space.isFree(from), space.connected(from, [1, 1]), space.sees(from, [1, 1])];
if (path && space.holds(path)) space.check(path);
if (path) facts.push(space.vertices(path).length, space.touchedCells(path).length);
const edited: Space = space.edit(0, 0, 1, 1, new Uint8Array(1));
const widest: WidestPath | undefined = space.widestPath(from, [1, 1], 0.2);
if (widest) facts.push(widest.path.length, widest.distance, widest.radius);

const options: Options = {
  heuristic: "hk",
  levels: "all",
  memory: "8MB",
  side: 8,
  smooth: "linear",
};
const index: Index = space.prepare("hpa", options, (stage: string, done: number, of: number) => {
  facts.push(stage, done / of);
});
const loaded: Index = edited.load(index.toBytes(), options);
const repaired: Index = index.repair(edited);
facts.push(index.engine, index.setup, index.guarantee, index.optimal, index.bound ?? 0, index.memoryBytes);
facts.push(index.levels ?? "none", index.searchedBy);
const guided: Index = land.space({ k: 4 }).prepare("landmarks", { landmarks: 4 });
facts.push(guided.engine);
facts.push(loaded.origin === "loaded", repaired.finish().isFinished, repaired.space.grid.width);

const wishes: Wishes = {
  nearest: true,
  snap: true,
  tolerance: 1,
  maxCost: 10,
  maxExpansions: 100,
  timeout: 5,
};
const planner: Planner = index.planner();
planner.follow(repaired);
const trace = new Trace(true);
const answer: Answer = planner.find(from, to, wishes, trace);
if (answer.status === "stopped") facts.push(answer.stoppedBy ?? "", answer.best?.length ?? 0);
facts.push(answer.distance, answer.lowerBound, answer.path?.length ?? 0);
facts.push(answer.anyAngleLowerBound ?? 0, answer.path ? spaced(answer.path, 0.5).length : 0);
const exceptions: Exceptions = { blocked: [[1, 1]], free: [0, 1], freeEnds: true };
const around: Answer = planner.findExcept(from, to, exceptions, wishes);
planner.begin(from, to, wishes);
let next: Answer | undefined;
while (!(next = planner.step(10, trace)))
  facts.push(planner.best()?.length ?? 0, planner.pathTo(from)?.length ?? 0);
const last: Answer = planner.finish(trace);
facts.push(
  planner.lowerBound,
  planner.expansions,
  trace.steps(3).length,
  trace.posthoc(planner, from, [1, 1]),
);
facts.push(trace.expanded, trace.generated, trace.scanned, trace.updated);
trace.clear();

const hotels: Goals = index.goals(to);
const far: Float64Array = planner.distances(from, hotels);
const near: NearestGoal | undefined = planner.nearest(from, hotels);
facts.push(planner.distance(from, [1, 1]), far.length, near?.goal ?? -1, near?.distance ?? Infinity);
facts.push(hotels.length, hotels.points().length);
hotels.free();

const field: Field = space.field(to, 10, (done, total) => facts.push(done / total));
const arrays: [Float64Array, Float32Array] = [field.distances(), field.flow()];
facts.push(
  field.width,
  field.height,
  field.get(from),
  field.next(from)?.[0] ?? 0,
  field.nearestSource(from)?.[0] ?? 0,
  field.pathFrom(from)?.length ?? 0,
);

const drawing = new Picture(grid, "corner");
drawing.field(field);
drawing.searched(trace);
drawing.path("name", star);
drawing.start(from);
drawing.goal(to);
drawing.radius(0.5);
drawing.caption("text");
drawing.largestSide(512);
const files: [Uint8Array, string] = [drawing.png(), drawing.svg()];

try {
  grid.path(from, [9, 9]);
} catch (error) {
  const { name, code, message } = error as MediantError;
  facts.push(name, code, message);
}
planner.free();

export {
  able,
  around,
  arrays,
  because,
  clearance,
  cost,
  each,
  engine,
  factor,
  facts,
  files,
  groups,
  height,
  high,
  instances,
  last,
  length,
  meters,
  next,
  place,
  price,
  seen,
  sizes,
  smaller,
  text,
  where,
  whole,
  why,
  wide,
  width,
};
