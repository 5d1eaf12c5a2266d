//! Agents walk to one goal by a field, and none steps on another: `cargo run -p mediant --example agents`.
#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use mediant::{Map, Motion, Vertex};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_rows([
        "....................",
        ".######..####..####.",
        ".#....#..#.....#..#.",
        ".#..........#..#....",
        ".#....#..#..#..#..#.",
        ".######..####..####.",
        "....................",
    ])?;
    let goal = Vertex::new(17, 3);
    // One field serves all agents: the distance of every cell to the goal.
    let field = map.space(Motion::default())?.field([goal])?;
    let mut agents: Vec<Vertex> = (0..6).map(|number| Vertex::new(2 + number % 3, 2 + number / 3)).collect();
    for turn in 0..=30 {
        if turn % 10 == 0 {
            draw(turn, &map, &agents, goal);
        }
        for number in 0..agents.len() {
            let at = agents[number];
            // The free neighbor that is nearest to the goal, if it is nearer than where the agent stands.
            let steps = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| Vertex::new(at.x + dx, at.y + dy)));
            let free = steps.filter(|to| map.is_free(*to) && (*to == goal || !agents.contains(to)));
            // A diagonal step needs both cells beside it.
            let legal = free.filter(|to| map.is_free((to.x, at.y)) && map.is_free((at.x, to.y)));
            let ranked = legal.filter_map(|to| Some((field.get(to)?, to)));
            let best = ranked.min_by(|(a, _), (b, _)| a.total_cmp(b));
            if let Some((_, to)) = best.filter(|(length, _)| field.get(at).is_some_and(|now| *length < now)) {
                agents[number] = to;
            }
        }
        agents.retain(|at| *at != goal);
    }
    assert!(agents.is_empty(), "all have arrived");
    Ok(())
}

fn draw(turn: u32, map: &Map, agents: &[Vertex], goal: Vertex) {
    println!("turn {turn}: {} on their way", agents.len());
    for (row, y) in map.to_string().lines().zip(0..) {
        let mark = |(cell, x): (char, i32)| match Vertex::new(x, y) {
            at if agents.contains(&at) => 'o',
            at if at == goal => 'X',
            _ => cell,
        };
        println!("  {}", row.chars().zip(0..).map(mark).collect::<String>());
    }
}
