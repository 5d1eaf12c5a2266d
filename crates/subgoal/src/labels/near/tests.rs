//! Goals near a vertex against all goals.

use mediant_grid::Vertex;
use mediant_oracle::Rng;

use super::Strips;

#[test]
fn all_goals_within_a_distance_are_found_in_order() {
    let (mut counts, mut found) = ([0, 0], Vec::new());
    for seed in 0..200 {
        let mut rng = Rng::new(seed);
        let (width, height) = (1 + rng.below(90), 1 + rng.below(90));
        let (left, top) = (rng.below(50) as i32, rng.below(50) as i32);
        let pick =
            |rng: &mut Rng| Vertex::new(left + rng.below(width) as i32, top + rng.below(height) as i32);
        let goals: Vec<Vertex> = (0..rng.below(120)).map(|_| pick(&mut rng)).collect();
        let strips = Strips::new(&goals);
        for _ in 0..20 {
            let from = Vertex::new(rng.below(150) as i32, rng.below(150) as i32);
            let range = [4, 40, 300][rng.below(3) as usize];
            let most = rng.below(range) as i32;
            strips.near(from, most, &mut found);
            let is_near = |at: Vertex| from.to(at).norm_squared() <= u64::from(most.unsigned_abs()).pow(2);
            let all = goals.iter().zip(0..).filter(|&(&at, _)| is_near(at)).map(|(_, number)| number);
            assert!(found.iter().copied().eq(all), "{found:?} within {most} of {from}, seed {seed}");
            counts[0] += found.len();
            counts[1] += goals.len();
        }
    }
    assert!(counts[0] > 10_000 && counts[1] > 2 * counts[0], "{counts:?}");
}
