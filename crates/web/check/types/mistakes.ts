import { Grid, type Motion } from "mediant";

const grid = new Grid(2, 2, new Uint8Array(4));
grid.path([0, 0], [1, 1], { k: "all" }); // wrong
grid.path([0, 0], "there"); // wrong
grid.path([0, 0, 0], [1, 1]); // wrong
grid.space({ placement: "middle" }); // wrong
grid.space({ kk: 3 }); // wrong
new Grid(2, 2, "..#."); // wrong
const path: Int32Array = grid.path([0, 0], [1, 1]); // wrong
const motion: Motion = { corners: true }; // wrong
grid.space().prepare("subgoal", { levels: "label" }); // wrong
grid
  .space()
  .prepare()
  .planner()
  .distances([0, 0], [[1, 1]]); // wrong
grid.width = 3; // wrong
new Grid(2, 2, new Uint8Array(4), { cost: [1, 1, 1, 1] }); // wrong
grid.withCosts("1111"); // wrong
grid.inflated({ inscribedRadius: 1 }); // wrong

export { motion, path };
