//! The places of landmarks.

use mediant_grid::{Interrupt, Interrupted, Vertex, room_for};

use crate::{graph::CostGraph, scan::Visit};

/// The components that have landmarks.
pub(super) struct Components {
    /// By state.
    labels: Vec<u32>,
    /// A vertex of each.
    first: Vec<Vertex>,
}

/// A state of no component, or of a small one.
const NO_LABEL: u32 = u32::MAX;
/// The stage that an interrupted call names.
const DURING: &str = "finding the components";
/// A component with fewer states has no landmark: a search there is short.
const FEWEST: usize = 64;

impl Components {
    pub(super) fn of(graph: &CostGraph, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        // The labels, and a list that doubles until it may hold all states.
        room_for::<u32>(4 * graph.states(), DURING)?;
        let mut flood = Flood { graph, labels: vec![NO_LABEL; graph.states()], label: 0, found: Vec::new() };
        let mut first = Vec::new();
        let mut scanned = 0;
        for at in vertices(graph).filter(|&at| graph.is_free(at)) {
            let Some(state) = graph.end(at).filter(|&state| flood.labels[state] == NO_LABEL) else {
                continue;
            };
            flood.found.clear();
            flood.relax(0, state, 0);
            let mut next = 0;
            while let Some(&state) = flood.found.get(next) {
                interrupt.check_every(1 << 14, scanned, DURING)?;
                graph.scan((state as usize, 0), &mut flood);
                (next, scanned) = (next + 1, scanned + 1);
            }
            if flood.found.len() < FEWEST {
                flood.found.iter().for_each(|&state| flood.labels[state as usize] = SMALL);
            } else {
                first.push(at);
                flood.label += 1;
            }
        }
        let mut labels = flood.labels;
        labels.iter_mut().filter(|label| **label == SMALL).for_each(|label| *label = NO_LABEL);
        Ok(Self { labels, first })
    }

    /// A vertex of each component.
    pub(super) fn first(&self) -> &[Vertex] {
        &self.first
    }

    /// The states of all components.
    pub(super) fn states(&self) -> impl Iterator<Item = usize> {
        (0..).zip(&self.labels).filter(|(_, label)| **label != NO_LABEL).map(|(state, _)| state)
    }

    /// The vertex of each component with the greatest value, the first of several, and the greatest of these
    /// values.
    pub(super) fn farthest(
        &self,
        graph: &CostGraph,
        value: &mut dyn FnMut(usize) -> u64,
    ) -> (Vec<Vertex>, u64) {
        let mut farthest: Vec<(u64, Vertex)> = self.first.iter().map(|&at| (0, at)).collect();
        for at in vertices(graph) {
            let Some(state) = graph.end(at) else { continue };
            if let Some(known) = farthest.get_mut(self.labels[state] as usize) {
                let value = value(state);
                if value > known.0 {
                    *known = (value, at);
                }
            }
        }
        let greatest = farthest.iter().map(|&(value, _)| value).max();
        (farthest.into_iter().map(|(_, at)| at).collect(), greatest.unwrap_or_default())
    }
}

/// In the place of labels while the components are found.
const SMALL: u32 = NO_LABEL - 1;

/// All vertices, row by row.
fn vertices(graph: &CostGraph) -> impl Iterator<Item = Vertex> + use<> {
    let (width, height) = graph.size();
    (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
}

/// A search for the states of a component.
struct Flood<'g> {
    graph: &'g CostGraph,
    labels: Vec<u32>,
    label: u32,
    found: Vec<u32>,
}

impl Visit for Flood<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        if self.labels[to] == NO_LABEL && !self.graph.is_blocked(to) { u64::MAX } else { 0 }
    }

    fn relax(&mut self, _: usize, to: usize, _: u64) {
        self.labels[to] = self.label;
        self.found.push(to as u32);
    }
}
