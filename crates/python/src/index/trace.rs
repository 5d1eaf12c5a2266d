//! The events of a search in steps.

use std::{io, path::PathBuf, time::Instant};

use mediant::{
    Answer, Cost, Limits, PointEnds, Space, Vertex,
    search::{Counters, NodeEvent, Observer, Tracer},
};
use mediant_formats::NewFile;
use pyo3::{exceptions::PyMemoryError, prelude::*};

use crate::{background::LOOK, errors::raised};

/// The number of expansions between two looks at the clock.
const EXPANSIONS_PER_LOOK: u32 = 64;

/// An event of a vertex.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Expanded,
    Generated,
    Updated,
}

/// The events of a search.
#[derive(Default)]
pub(super) struct Events {
    all: Vec<(Kind, NodeEvent)>,
    counters: Counters,
    /// Whether an event had no room.
    is_cut: bool,
}

impl Events {
    /// The numbers of events.
    pub(super) const fn counters(&self) -> Counters {
        self.counters
    }

    /// The events, if there was room for all.
    pub(super) fn whole(&self) -> PyResult<&Self> {
        if self.is_cut {
            return Err(PyMemoryError::new_err("there is no room for all events of the search"));
        }
        Ok(self)
    }

    /// The vertices of the events of a kind, in their order.
    pub(super) fn vertices(&self, of: Kind) -> impl Iterator<Item = Vertex> {
        self.all.iter().filter(move |(kind, _)| *kind == of).map(|(_, node)| node.at)
    }

    /// Writes the events to a file for the Posthoc visualizer, between the ends of a query and the path of
    /// its answer.
    pub(super) fn write(
        &self,
        path: PathBuf,
        space: &Space,
        (query, answer): (PointEnds, Option<&Answer>),
        limits: &Limits,
    ) -> PyResult<()> {
        let (placement, interrupt) = (space.motion().rules.placement(), limits.interrupt());
        let written = NewFile::write_with(path, |file| {
            let mut tracer = Tracer::new(file, space.map().grid(), placement)?.in_space(space);
            tracer.begin(query, answer);
            for chunk in self.all.chunks(1024) {
                interrupt.check("writing a trace").map_err(io::Error::other)?;
                for &(kind, node) in chunk {
                    match kind {
                        Kind::Expanded => tracer.expanded(node),
                        Kind::Generated => tracer.generated(node),
                        Kind::Updated => tracer.updated(node),
                    }
                }
            }
            tracer.end(answer);
            tracer.finish().map(drop)
        });
        written.map_err(|error| raised(mediant::Error::from(error)))
    }

    fn keep(&mut self, kind: Kind, node: NodeEvent) {
        let is_full = self.all.len() == self.all.capacity();
        if self.is_cut || (is_full && self.all.try_reserve(self.all.len().max(1024)).is_err()) {
            self.is_cut = true;
            return;
        }
        self.all.push((kind, node));
    }
}

impl Observer for Events {
    fn expanded(&mut self, node: NodeEvent) {
        self.counters.expanded(node);
        self.keep(Kind::Expanded, node);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.counters.generated(node);
        self.keep(Kind::Generated, node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.counters.updated(node);
        self.keep(Kind::Updated, node);
    }

    fn percolated(&mut self, swaps: u32) {
        self.counters.percolated(swaps);
    }

    fn fell_back(&mut self) {
        self.counters.fell_back();
    }

    fn scanned(&mut self, vertices: u32) {
        self.counters.scanned(vertices);
    }
}

/// Pauses a search for a signal whose handler raises, and hands its events on.
pub(super) struct Watched<'a> {
    events: &'a mut dyn Observer,
    asked: u32,
    next: Instant,
    pub(super) raised: Option<PyErr>,
}

impl<'a> Watched<'a> {
    pub(super) fn new(events: &'a mut dyn Observer) -> Self {
        Self { events, asked: 0, next: Instant::now() + LOOK, raised: None }
    }
}

impl Observer for Watched<'_> {
    fn expanded(&mut self, node: NodeEvent) {
        self.events.expanded(node);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.events.generated(node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.events.updated(node);
    }

    fn percolated(&mut self, swaps: u32) {
        self.events.percolated(swaps);
    }

    fn fell_back(&mut self) {
        self.events.fell_back();
    }

    fn scanned(&mut self, vertices: u32) {
        self.events.scanned(vertices);
    }

    fn pauses(&mut self, _: Cost) -> bool {
        self.asked = self.asked.wrapping_add(1);
        if !self.asked.is_multiple_of(EXPANSIONS_PER_LOOK) {
            return false;
        }
        let now = Instant::now();
        if now < self.next {
            return false;
        }
        self.next = now + LOOK;
        self.raised = Python::attach(|py| py.check_signals()).err();
        self.raised.is_some()
    }
}
