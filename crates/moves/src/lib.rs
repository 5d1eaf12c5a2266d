//! The mathematics of the 2^k neighborhoods.
//!
//! N(2) is the 4-connected neighborhood. N(k + 1) inserts the *mediant*, the vector sum, between every two
//! adjacent moves of N(k). So k = 3 is the 8-connected grid, k = 4 has sixteen moves, and in the limit there
//! is every direction.
//!
//! **The key decision: moves are computed, not enumerated.** A quadrant is a level of the Stern–Brocot tree.
//! The j-th move, the index of a move, the two moves around a vector and the distance h_k all result from a
//! walk over k − 2 levels of mediants, in registers. The only table is [`CostTable`], for searches that look
//! costs up.
//!
//! Obstacles are not here. Which cells a move sweeps on a map is defined in `mediant-grid`. Measurements are
//! in `docs/measurements/moves.md`.
//!
//! The crate is `no_std` and has no dependencies. Feature `std` (default) uses the hardware's square roots.
//! Feature `alloc` (default, implied by `std`) adds what needs a heap: [`CostTable`], [`DecompositionTree`],
//! [`LinearSearch`]. Feature `serde` adds the one dependency that there can be, without a heap: it reads and
//! writes [`K`] and [`FiniteK`].
//!
//! ```
//! use mediant_moves::{FiniteK, Neighborhood, Vector, bound_at_corners, decompose, distance};
//!
//! let moves = Neighborhood::new(FiniteK::N16)?;
//! assert_eq!((moves.len(), moves.contains(Vector::new(1, 2))), (16, true));
//!
//! // On an empty grid, the shortest path to (7, 9) takes (1, 2) twice and (1, 1) five times.
//! let d = Vector::new(7, 9);
//! let parts = decompose(d, FiniteK::N16).unwrap();
//! assert_eq!((parts.alpha, parts.v, parts.beta, parts.w), (2, Vector::new(1, 2), 5, Vector::new(1, 1)));
//! assert!((parts.length() - distance(d, FiniteK::N16)).abs() < 1e-12);
//!
//! // Among obstacles it is at most 2.75 % longer than the shortest any-angle path.
//! assert!(bound_at_corners(FiniteK::N16) < 1.0275);
//! # Ok::<(), mediant_moves::KError>(())
//! ```
//!
//! # Statements and their tests
//!
//! Each statement of the three papers, with the test in `tests/it/` that checks it for every k up to 14 or
//! beyond, against naive definitions of its own.
//!
//! Rivera, Hernández, Baier 2017, 'Grid Pathfinding on the 2^k Neighborhoods':
//!
//! | statement | test |
//! |---|---|
//! | Eq. 1, 2: the insertion | `rivera2017::equations_1_and_2_old_moves_at_even_indices_and_sums_at_odd_ones` |
//! | Eq. 3–5: 𝒩⁰, 𝒩¹, 𝒩² | `rivera2017::equations_3_to_5_the_first_three_quadrants` |
//! | Eq. 6: the full neighborhood | `rivera2017::equation_6_all_signs_of_the_quadrant` |
//! | Proposition 1: no two moves are parallel | `rivera2017::proposition_1_no_two_moves_are_parallel` |
//! | Proposition 2: 2^k moves; its proof misprints 2^i + 1 as 2^(i+1) | `rivera2017::proposition_2_the_neighborhood_has_2_to_the_k_moves` |
//! | Theorem 1: the radius is Fib(k − 2), to k = 47 | `rivera2017::theorem_1_radius_is_fibonacci` |
//! | Eq. 7, 8: an odd move from two earlier ones | `rivera2017::equations_7_and_8_an_odd_move_from_the_two_quadrants_before` |
//! | Lemma 1: no coordinate above Fib(i) | `rivera2017::lemma_1_no_coordinate_exceeds_fibonacci` |
//! | Lemma 2, Eq. 9, 10: index F_i attains it, to i = 45 | `rivera2017::lemma_2_the_index_that_attains_fibonacci` |
//! | Theorem 2, Eq. 11–13: two moves are enough for the linear program | `rivera2017::theorem_2_the_two_moves_around_a_vertex_are_the_linear_optimum` |
//! | Eq. 15, 16: cutting a path where it crosses a ray | none: a step of Theorem 2's proof |
//! | Theorem 3, Eq. 14: its optimum is integral | `rivera2017::theorem_3_the_linear_optimum_is_integral` |
//! | Eq. 17, 18: from k + 1 back to k | `rivera2017::equations_17_and_18_the_factors_one_level_back` |
//! | Corollary 1: h_k is the shortest path, against Dijkstra | `rivera2017::corollary_1_no_path_on_an_empty_grid_is_shorter` |
//! | Algorithm 1: closed forms for k = 3, 4, 5 | `rivera2017::algorithm_1_the_closed_forms` |
//! | 'The 2^k-Tile Heuristic': linear = iterative = naive | `rivera2017::the_heuristic_three_ways` |
//! | 15, 6 and 1 optimal paths to (4, 2) | `rivera2017::optimal_paths_are_fewer_for_larger_k` |
//! | canonical order: odd before even | `rivera2017::canonical_paths_take_the_odd_move_first`, `rivera2017::canonical_parity_is_that_of_the_first_quadrant` |
//! | canonical successors: each cell once | `rivera2017::canonical_successors_generate_each_cell_once_and_at_optimal_cost` |
//! | Theorem 4: canonical A* is complete | none here: it is about grids with obstacles, and 'complete' is not 'optimal' |
//!
//! Hormazábal, Díaz, Hernández, Baier 2017, 'Fast and Almost Optimal Any-Angle Pathfinding Using the 2^k
//! Neighborhoods':
//!
//! | statement | test |
//! |---|---|
//! | Eq. 1: the quadrant by index, whose j ends at 2^m (misprint: 2^m + 1) | `hormazabal2017::equation_1_each_move_from_the_quadrant_before` |
//! | Eq. 2: two consecutive moves | `hormazabal2017::equation_2_two_consecutive_moves_make_up_the_vertex` |
//! | Definitions 1, 2, Theorem 1: subgoal graphs | none here: they are about grids with obstacles |
//! | Algorithm 1: h₃₂ | `hormazabal2017::algorithm_1_the_distance_for_32_neighbors` |
//! | Algorithm 2 and its invariants | `hormazabal2017::algorithm_2_keeps_its_invariants` |
//! | its two misprints | `hormazabal2017::algorithm_2_as_printed_is_not_the_distance` |
//! | example (10, 8) | `hormazabal2017::example_factorization_of_10_8` |
//! | Theorem 2: it returns h_k | `hormazabal2017::theorem_2_the_iterative_algorithm_is_the_distance` |
//! | … for every `i32` displacement, to k = 100 and at k = 2³² − 1 | `hormazabal2017::theorem_2_holds_for_any_k_and_any_displacement` |
//! | … as do table and linear search | `hormazabal2017::theorem_2_the_linear_search_finds_the_same_beyond_small_displacements` |
//! | 65–75 % of the linear search's time | `cargo xtask reproduce-tables --only hormazabal2017-distance`; figures in `docs/measurements/moves.md` |
//!
//! Kramm, Rivera, Hernández, Baier 2018, 'A Suboptimality Bound for 2^k Grid Path Planning':
//!
//! | statement | test |
//! |---|---|
//! | Eq. 1: det | `kramm2018::equation_1_the_determinant` |
//! | Theorem 1: h_k by the moves that contain the vertex | `kramm2018::theorem_1_the_distance_by_the_adjacent_moves_that_contain_the_vertex` |
//! | example (7, 9), a move from k = 8 on (misprint: 9) | `kramm2018::example_factorization_of_7_9` |
//! | Proposition 4: det = 1 | `kramm2018::proposition_4_adjacent_moves_have_determinant_1` |
//! | Proposition 5: the sine | `kramm2018::proposition_5_the_sine_between_adjacent_moves` |
//! | Proposition 6: lengths from 1 | `kramm2018::proposition_6_no_move_is_shorter_than_1` |
//! | Proposition 7: each pair of relative primes is a move | `kramm2018::proposition_7_relative_primes_are_a_move_of_some_neighborhood` |
//! | Eq. 3–5: the worst direction; m is q / p (misprint: p / q) | `kramm2018::equations_3_to_5_the_direction_of_the_largest_ratio` |
//! | Lemma 8: the bound between two moves | `kramm2018::lemma_8_the_bound_between_two_moves` |
//! | Lemma 9, R1, R2: the first angle is the largest | `kramm2018::lemma_9_the_first_angle_is_the_largest` |
//! | Eq. 6–12 | none: steps of Lemma 9's proof |
//! | Theorem 10: h_k ≤ Γ_k‖d‖ | `kramm2018::theorem_10_no_vertex_of_an_empty_grid_exceeds_the_bound` |
//! | Theorem 2: the values of Γ_k | `kramm2018::theorem_2_the_values_of_the_bound` |
//! | Theorem 2: 1 + 1/(8k²) + O(1/k³) | `kramm2018::theorem_2_the_bound_falls_quadratically` |
//! | Theorem 2: tight, at (n, ⌊n(s + k − 2)⌋) (misprint: a lost parenthesis) | `kramm2018::theorem_2_the_bound_is_tight` |
//! | Theorem 3, Eq. 2: the values at centers | `kramm2018::theorem_3_the_values_of_the_bound_at_centers` |
//! | Theorem 3, its induction | `kramm2018::theorem_3_more_moves_never_lengthen_a_path` |
//! | Theorem 2 with obstacles | none here: `crates/search/tests/it/exact.rs` |
//! | Theorem 3 with obstacles, Figure 6: where it holds and where not | none here: `crates/search/tests/it/kramm2018.rs` |
//! | Lemma 11: the cells of two adjacent moves | `kramm2018_trees::lemma_11_two_adjacent_moves_enter_only_cells_of_their_sum`, `kramm2018_trees::the_cells_that_a_move_enters` |
//! | level, and a mediant's: 1 + the larger (misprint: their sum) | `kramm2018_trees::level_is_the_first_k_that_has_the_move`, `kramm2018_trees::level_is_1_more_than_the_larger_of_the_parents` |
//! | of two adjacent moves one has level k | `kramm2018_trees::of_two_adjacent_moves_one_is_new_and_one_is_old` |
//! | Algorithm 2: decomposition trees | `kramm2018_trees::algorithm_2_the_decomposition_tree` |
//! | Lemma 12: at most two labels | `kramm2018_trees::lemma_12_at_most_two_adjacent_moves_label_the_leaves` |
//! | Lemma 13: the leaves are an optimal path, for coordinates to 20 | `kramm2018_trees::lemma_13_the_leaves_are_an_optimal_path_within_the_cells_of_the_move` |
//! | Figure 5: the trees of (7, 5) | `kramm2018_trees::figure_5_the_trees_of_7_5` |
//!
//! `tests/it/cost.rs` tests the claims of [`Cost`] and [`CostTable`], `tests/it/api.rs` the rest and the
//! limits of all ranges.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod bounds;
mod cost;
mod decomposition;
mod distance;
mod finite_k;
mod k;
mod level;
mod quadrant;
#[cfg(doctest)]
mod readme;
mod sector;
#[cfg(feature = "serde")]
mod serialized;
mod sqrt;
mod vector;

pub use bounds::{
    BOUND_WITHOUT_CORNER_CUTTING, bound_at_centers, bound_at_corners, smallest_k_at_centers,
    smallest_k_at_corners,
};
pub use cost::Cost;
pub use decomposition::{Decomposition, containing, decompose};
pub use distance::{distance, distance_16, distance_32, distance_any_angle, manhattan, octile};
pub use finite_k::{FiniteK, KError};
pub use k::{K, ParseKError};
pub use level::{adjacent, level, parents};
pub use quadrant::{Neighborhood, Parity, Quadrant, QuadrantMoves};
pub use vector::Vector;

#[cfg(feature = "alloc")]
pub use cost::CostTable;
#[cfg(feature = "alloc")]
pub use decomposition::{DecompositionTree, TreeNode};
#[cfg(feature = "alloc")]
pub use distance::LinearSearch;
