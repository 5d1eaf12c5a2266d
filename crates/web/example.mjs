import init, { Grid } from "mediant";

await init();
const grid = Grid.fromRows(["...#....", ".#.#.##.", ".#...#.."]); // "." is free
console.log(grid.path([0, 0], [7, 0])); // waypoints x, y, …: eight directions
console.log(grid.path([0, 0], [8, 3], { k: "any" })); // any angle, between the corners of cells

const planner = grid.space({ k: 4 }).prepare().planner(); // for many paths: 16 directions
const answer = planner.find([0, 0], [3, 0], { nearest: true }); // the goal is blocked
console.log(answer.status, answer.path, answer.distance);
