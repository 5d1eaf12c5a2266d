//! From a path cell by cell to its waypoints.

use mediant_grid::Vertex;

/// Writes the waypoints of a path over N(k) to `waypoints`: its first and last vertex, and those at which it
/// turns.
pub(crate) fn waypoints(path: &[Vertex], waypoints: &mut Vec<Vertex>) {
    waypoints.clear();
    for &at in path {
        if waypoints.last() == Some(&at) {
            continue;
        }
        if let [.., before, last] = waypoints[..] {
            let (arrival, departure) = (before.to(last), last.to(at));
            if arrival.det(departure) == 0 && arrival.dot(departure) > 0 {
                waypoints.pop();
            }
        }
        waypoints.push(at);
    }
}
