//! Answering queries on a [`ClusterGraph`].

use std::{
    ops::{Deref, DerefMut},
    sync::Arc,
};

use mediant_grid::{Centers, Change, GridGraph, Identity, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{Part, SearchTree},
};

use super::{
    cluster_search::ClusterSearch,
    fixed_cost::FixedCost,
    graph::ClusterGraph,
    level::{Bounds, Level, Node},
    search::{Endpoint, Goal, HpaSearch, search},
    straighten::{Straighten, free_elbow},
};
use crate::{
    HierarchyError, check,
    waypoints::waypoints,
    window::{MAX_SIDE, insert},
};

/// HPA* (Botea, Müller & Schaeffer 2004, 'Near Optimal Hierarchical Path-Finding'), with one or more levels.
///
/// A query goes through the steps of the paper's Sections 3.3 to 3.5. Start and goal are *inserted*: the
/// costs from them to the nodes of their clusters are found. A* finds an abstract path on the highest level
/// on which the two lie in different clusters. This path is *refined* level by level, down to cells. Last, it
/// is *straightened* ([`with_straightening`](Self::with_straightening)): the paper's smoothing joins vertices
/// on one straight line, this one joins vertices by a shortest path over N(k) on an empty grid, so that paths
/// stay paths over N(k).
///
/// `G` and `I` are how the planner holds the grid graph and its index: by reference or by `Arc`. A planner
/// that holds its index in a `Box` can [repair](Self::repair) it.
///
/// **Ties** are decided by the order of the open lists: f, then h, then the number of the node or cell. Paths
/// and counts are the same each time and on every platform. An observer gets the events of all searches, on
/// every level and within clusters; percolations are counted only in the searches over levels. Scratch
/// memory: 24 bytes for each number that a node may have (20 in a cluster of 10 × 10 cells).
#[derive(Clone, Debug)]
pub struct HpaStar<G, I> {
    grid_graph: G,
    index: I,
    straightens: bool,
    tree: SearchTree,
    cluster_search: ClusterSearch,
    /// For the start and the goal: the costs between it and the nodes of its cluster, level by level.
    endpoint_costs: [Vec<Vec<FixedCost>>; 2],
    abstract_path: Vec<PathNode>,
    /// The abstract path on the level below, while it is made.
    refined: Vec<PathNode>,
    cells: Vec<Vertex>,
    straighten: Straighten,
    phase: Phase,
    /// Searches within clusters while a path of an unfinished search is refined. Made when first needed.
    second_tree: Option<SearchTree>,
}

/// The phase of the current search.
#[derive(Clone, Copy, Debug)]
enum Phase {
    /// Nothing: no search was begun, or there is no path.
    None,
    /// It searches the abstract path.
    Search(AbstractQuery),
    /// It has found a path: its cells, or, if they were found without a search, its waypoints.
    Found { goal: Vertex, is_direct: bool },
}

/// A query, after start and goal were inserted.
#[derive(Clone, Copy, Debug)]
struct AbstractQuery {
    start: Vertex,
    goal: Vertex,
    /// The level on which it is searched.
    top: usize,
    /// The cost from start to goal within a cluster of the lowest level.
    direct: FixedCost,
}

/// A node of an abstract path.
#[derive(Clone, Copy, Debug)]
struct PathNode {
    at: Vertex,
    /// The number of the node, or that of the start or the goal.
    id: u32,
}

impl HpaStar<(), ()> {
    /// The scratch memory that a planner on this graph takes when it is made, in bytes. The size of the map
    /// and the clustering decide it, so that it is the same after a repair.
    #[must_use]
    pub fn scratch_bytes(index: &ClusterGraph) -> usize {
        SearchTree::<()>::bytes(index.most_nodes() + 2)
    }
}

impl<G, I> HpaStar<G, I>
where
    G: Deref<Target = GridGraph<Centers>>,
    I: Deref<Target = ClusterGraph>,
{
    /// A planner on `index`, which must be that of `grid_graph`; it straightens its paths.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for the index of another map, rule of motion or k.
    pub fn new(grid_graph: G, index: I) -> Result<Self, HierarchyError> {
        check::belongs(index.identity, &grid_graph)?;
        let nodes = index.most_nodes();
        let costs = vec![Vec::new(); index.levels.len()];
        Ok(Self {
            straightens: true,
            tree: SearchTree::new(nodes + 2),
            cluster_search: ClusterSearch::new(index.k),
            endpoint_costs: [costs.clone(), costs],
            abstract_path: Vec::new(),
            refined: Vec::new(),
            cells: Vec::new(),
            straighten: Straighten::default(),
            phase: Phase::None,
            second_tree: None,
            grid_graph,
            index,
        })
    }

    /// Continues on another grid graph and its index: those of a map after a change. The search that was
    /// begun last is forgotten. The scratch memory is kept if there is room for the nodes.
    ///
    /// # Errors
    /// As for [`new`](Self::new). Nothing is changed then.
    pub fn follow(&mut self, grid_graph: G, index: I) -> Result<(), HierarchyError> {
        check::belongs(index.identity, &grid_graph)?;
        if index.k != self.index.k {
            self.cluster_search = ClusterSearch::new(index.k);
        }
        let nodes = index.most_nodes() + 2;
        self.tree.fit(nodes);
        if let Some(second) = &mut self.second_tree {
            second.fit(nodes);
        }
        self.endpoint_costs.iter_mut().for_each(|costs| costs.resize(index.levels.len(), Vec::new()));
        self.phase = Phase::None;
        (self.grid_graph, self.index) = (grid_graph, index);
        Ok(())
    }

    /// Whether the planner straightens its paths, or returns them unstraightened, as refinement leaves them.
    #[must_use]
    pub fn with_straightening(self, straightens: bool) -> Self {
        Self { straightens, ..self }
    }
}

impl<G, I> HpaStar<G, I>
where
    G: Deref<Target = GridGraph<Centers>>,
    I: DerefMut<Target = ClusterGraph>,
{
    /// Changes the map: `grid_graph` is that of the map after the change. Repairs the index, and keeps the
    /// scratch memory. The search that was begun last is forgotten.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for a grid graph of another rule of motion or k, or of another map than
    /// the one after the change, and for a change of another map than the index is of. Nothing is changed
    /// then.
    pub fn repair(&mut self, grid_graph: G, change: &Change) -> Result<(), HierarchyError> {
        check::same_moves(self.index.identity, &grid_graph)?;
        check::after(&grid_graph, change)?;
        self.index.repair(change)?;
        self.phase = Phase::None;
        self.grid_graph = grid_graph;
        Ok(())
    }
}

const DAMAGED: QueryError = QueryError::GaveUp { why: "the index was read from damaged bytes; make it anew" };

impl<G, I> Planner for HpaStar<G, I>
where
    G: Deref<Target = GridGraph<Centers>>,
    I: Deref<Target = ClusterGraph>,
{
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.phase = Phase::None;
        if query.ids(&self.grid_graph)?.is_none() {
            return Ok(SearchStatus::Unreachable);
        }
        let Ends { start, goal, .. } = query;
        // A free path that costs h_k is the best that straightening can find: no search is needed.
        let elbow = match () {
            () if start == goal => Some(goal),
            () if self.straightens => free_elbow(&self.grid_graph, start, goal),
            () => None,
        };
        if let Some(elbow) = elbow {
            self.cells.clear();
            self.cells.extend([start, elbow, goal]);
            self.phase = Phase::Found { goal, is_direct: true };
            return Ok(SearchStatus::Found);
        }
        let separates = |level: &Arc<Level>| level.cluster_at(start) != level.cluster_at(goal);
        let top = self.index.levels.iter().rposition(separates).unwrap_or(0);
        let direct = self.insert(query, top, &mut Part::new(observer));
        let query = AbstractQuery { start, goal, top, direct };
        self.phase = Phase::Search(query);
        Ok(self.search(query, true, observer))
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        let query = match self.phase {
            Phase::None => return Ok(SearchStatus::Unreachable),
            Phase::Found { .. } => return Ok(SearchStatus::Found),
            Phase::Search(query) => query,
        };
        match self.search(query, false, observer) {
            SearchStatus::Searching => Ok(SearchStatus::Searching),
            SearchStatus::Unreachable => Err(DAMAGED),
            SearchStatus::Found => {
                let level = &self.index.levels[query.top];
                trace(level, &self.tree, query, level.goal_id(), query.goal, &mut self.abstract_path);
                self.refine_all(query.top, &mut Part::new(observer)).ok_or(DAMAGED)?;
                self.phase = Phase::Found { goal: query.goal, is_direct: false };
                Ok(SearchStatus::Found)
            }
        }
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        match self.phase {
            Phase::None => return None,
            Phase::Found { goal, is_direct } => {
                if goal != at {
                    return None;
                }
                if is_direct {
                    let mut path = Vec::with_capacity(3);
                    waypoints(&self.cells, &mut path);
                    return Some(Path::new(path));
                }
            }
            Phase::Search(query) if at == query.start => return Some(Path::new(vec![at])),
            Phase::Search(query) => {
                // Outside the map there is no cluster.
                self.grid_graph.id(at)?;
                let level = &self.index.levels[query.top];
                let cluster = level.cluster_at(at);
                let mut nodes = level.nodes_of(cluster).iter().zip(level.first_node(cluster)..);
                let (_, id) = nodes.find(|&(node, id)| node.at() == at && self.tree.cost(id).is_some())?;
                trace(level, &self.tree, query, id, at, &mut self.abstract_path);
                // The search goes on afterwards, so that its tree must stay.
                let second = self.second_tree.take().unwrap_or_else(|| self.tree.clone());
                let first = std::mem::replace(&mut self.tree, second);
                let refined = self.refine_all(query.top, &mut ());
                self.second_tree = Some(std::mem::replace(&mut self.tree, first));
                refined?;
            }
        }
        Some(Path::new(if self.straightens {
            self.straighten.path(&self.grid_graph, &self.cells)
        } else {
            let mut path = Vec::with_capacity(self.cells.len());
            waypoints(&self.cells, &mut path);
            path
        }))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }

    fn identity(&self) -> Identity {
        self.grid_graph.identity()
    }
}

/// Refining returns `None` where there is no path although the map has one: then the index was
/// read from damaged bytes.
impl<G, I> HpaStar<G, I>
where
    G: Deref<Target = GridGraph<Centers>>,
    I: Deref<Target = ClusterGraph>,
{
    /// Finds the costs from start and goal to the nodes of their clusters, on the levels up to `top`. Returns
    /// the cost from one to the other within a cluster of the lowest level.
    fn insert(&mut self, query: Ends, top: usize, observer: &mut impl Observer) -> FixedCost {
        let direct = self.insert_lowest(0, query.start, Some(query.goal), observer);
        self.insert_lowest(1, query.goal, None, observer);
        let Self { grid_graph, index, tree, endpoint_costs, .. } = self;
        for number in 1..=top {
            let (below, level) = (&index.levels[number - 1], &index.levels[number]);
            for (costs, at) in endpoint_costs.iter_mut().zip([query.start, query.goal]) {
                let (lower, upper) = costs.split_at_mut(number);
                let cluster = level.cluster_at(at);
                let bounds = level.bounds(cluster, grid_graph.grid());
                let endpoint = Endpoint { cluster: below.cluster_at(at), costs: &lower[number - 1] };
                search(below, bounds, tree, |_| Cost::ZERO, endpoint, None, observer);
                let costs = level.nodes_of(cluster).iter().map(|node| FixedCost::new(tree.cost(node.below)));
                upper[0].clear();
                upper[0].extend(costs);
            }
        }
        direct
    }

    /// Finds the costs from the start (`which` = 0) or the goal (1), which is `at`, to the nodes of its
    /// cluster on the lowest level. Returns the cost to `other` if that is in the same cluster.
    fn insert_lowest(
        &mut self,
        which: usize,
        at: Vertex,
        other: Option<Vertex>,
        observer: &mut impl Observer,
    ) -> FixedCost {
        let Self { grid_graph, index, cluster_search, endpoint_costs, .. } = self;
        let level = &index.levels[0];
        let cluster = level.cluster_at(at);
        let bounds = level.bounds(cluster, grid_graph.grid());
        let other = other.filter(|&other| bounds.contains(other));
        let targets = level.nodes_of(cluster).iter().map(Node::at).chain(other);
        let costs = &mut endpoint_costs[which][0];
        costs.clear();
        // Where a path of cost h_k is free to each of them, there is nothing to search.
        let cost = |to: Vertex| free_elbow(grid_graph, at, to).map(|_| index.costs.distance(at.to(to)));
        costs.extend(targets.clone().map_while(cost).map(|cost| FixedCost::new(Some(cost))));
        if costs.len() < targets.clone().count() {
            let window = bounds.window(grid_graph.grid());
            let cells = targets.map(|target| window.cell(target));
            let mut set = [0; MAX_SIDE as usize];
            cells.clone().for_each(|cell| insert(&mut set, cell));
            cluster_search.flood(&index.costs, &window, window.cell(at), &set, observer);
            costs.clear();
            costs.extend(cells.map(|cell| FixedCost::new(cluster_search.cost(cell))));
        }
        other.and_then(|_| costs.pop()).unwrap_or(FixedCost::NONE)
    }

    /// Begins or continues the search of the abstract path.
    fn search<O: Observer>(&mut self, query: AbstractQuery, begins: bool, observer: &mut O) -> SearchStatus {
        let Self { index, tree, endpoint_costs, .. } = self;
        let AbstractQuery { start, goal, top, direct } = query;
        let level = &index.levels[top];
        let [from, to] = [(start, 0), (goal, 1)].map(|(at, which)| Endpoint {
            cluster: level.cluster_at(at),
            costs: &endpoint_costs[which][top],
        });
        let to = Some(Goal { endpoint: to, direct });
        let estimate = |at: Vertex| index.costs.distance(at.to(goal));
        let mut search = HpaSearch { level, bounds: Bounds::ALL, tree, estimate, observer };
        if begins {
            search.begin(from, to);
            return SearchStatus::Searching;
        }
        search.run(to)
    }

    /// Refines the abstract path of level `top` down to cells.
    fn refine_all(&mut self, top: usize, observer: &mut impl Observer) -> Option<()> {
        for number in (0..top).rev() {
            self.refine(number, observer)?;
        }
        self.refine_to_cells(observer)
    }

    /// Replaces the abstract path by one on the level below it, `number`: within each cluster that it
    /// crosses, by a shortest.
    fn refine(&mut self, number: usize, observer: &mut impl Observer) -> Option<()> {
        let Self { grid_graph, index, tree, endpoint_costs, abstract_path, refined, .. } = self;
        let (below, level) = (&index.levels[number], &index.levels[number + 1]);
        // A node of the path as an endpoint on the level below; and its index in its cluster there, if it is
        // not start or goal.
        let endpoint = |path_node: PathNode| {
            let cluster = below.cluster_at(path_node.at);
            let node = (path_node.id < level.start_id()).then(|| level.node(path_node.id).below);
            let costs = match node {
                Some(id) => below.costs_from(id),
                None => &endpoint_costs[usize::from(path_node.id == level.goal_id())][number],
            };
            (Endpoint { cluster, costs }, node.map(|id| (id - below.first_node(cluster)) as usize))
        };
        let on_level_below = |node: PathNode| match node.id {
            id if id == level.start_id() => PathNode { id: below.start_id(), ..node },
            id if id == level.goal_id() => PathNode { id: below.goal_id(), ..node },
            id => PathNode { id: level.node(id).below, ..node },
        };
        refined.clear();
        refined.extend(abstract_path.first().map(|&node| on_level_below(node)));
        for edge in abstract_path.windows(2) {
            let [from, to] = [edge[0], edge[1]];
            let cluster = level.cluster_at(from.at);
            if cluster == level.cluster_at(to.at) {
                let ((start, start_index), (goal, goal_index)) = (endpoint(from), endpoint(to));
                // At least one of the two is a node; costs hold in both directions.
                let direct = match (start.cluster == goal.cluster, start_index, goal_index) {
                    (true, _, Some(index)) => start.costs[index],
                    (true, Some(index), None) => goal.costs[index],
                    _ => FixedCost::NONE,
                };
                let bounds = level.bounds(cluster, grid_graph.grid());
                let estimate = |at: Vertex| index.costs.distance(at.to(to.at));
                let goal = Goal { endpoint: goal, direct };
                if !search(below, bounds, tree, estimate, start, Some(goal), observer) {
                    return None;
                }
                append_path(below, tree, PathNode { at: to.at, id: below.goal_id() }, refined);
                refined.pop();
            }
            refined.push(on_level_below(to));
        }
        std::mem::swap(abstract_path, refined);
        Some(())
    }

    /// Refines the abstract path of the lowest level to cells: each edge to a path that turns once if that is
    /// free, else to a shortest path within the cluster.
    fn refine_to_cells(&mut self, observer: &mut impl Observer) -> Option<()> {
        let Self { grid_graph, index, cluster_search, abstract_path, cells, .. } = self;
        let (level, grid) = (&index.levels[0], grid_graph.grid());
        cells.clear();
        cells.extend(abstract_path.first().map(|node| node.at));
        for edge in abstract_path.windows(2) {
            let [from, to] = [edge[0].at, edge[1].at];
            let cluster = level.cluster_at(from);
            if !grid_graph.is_free(to) {
                return None;
            }
            if cluster != level.cluster_at(to) {
                cells.push(to);
                continue;
            }
            if let Some(elbow) = free_elbow(grid_graph, from, to) {
                cells.extend([elbow, to]);
                continue;
            }
            // Searched backward, so that the parents lead forward.
            let window = level.bounds(cluster, grid).window(grid);
            let [first, last] = [from, to].map(|at| window.cell(at));
            if !cluster_search.path(&index.costs, &window, last, first, observer) {
                return None;
            }
            let mut cell = first;
            while cell != last {
                cell = cluster_search.parent(cell);
                cells.push(window.vertex(cell));
            }
        }
        Some(())
    }
}

/// Writes the abstract path to a node, or to the goal.
fn trace(
    level: &Level,
    tree: &SearchTree,
    query: AbstractQuery,
    id: u32,
    at: Vertex,
    path: &mut Vec<PathNode>,
) {
    path.clear();
    path.push(PathNode { at: query.start, id: level.start_id() });
    append_path(level, tree, PathNode { at, id }, path);
}

/// Appends the path of a search: what comes after its start, up to a node or the goal.
fn append_path(level: &Level, tree: &SearchTree, last: PathNode, path: &mut Vec<PathNode>) {
    let first = path.len();
    path.push(last);
    let mut id = last.id;
    while let Some((parent, ())) = tree.parent(id).filter(|&(parent, ())| parent != level.start_id()) {
        path.push(PathNode { at: level.node(parent).at(), id: parent });
        id = parent;
    }
    path[first..].reverse();
}
