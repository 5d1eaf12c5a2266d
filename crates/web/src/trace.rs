//! The events of a search, one by one.

use std::{
    cell::{RefCell, RefMut},
    rc::Rc,
};

use js_sys::Uint32Array;
use mediant::{
    Space as Inner, Vertex,
    search::{NodeEvent, Observer},
};
use wasm_bindgen::prelude::*;

use crate::{
    arguments::{flag, integer, room},
    errors::{argument, coded, no_memory},
};

/// Records the events of searches: of `Planner.find`, `step` and `finish`.
///
/// ```js
/// const trace = new Trace();
/// planner.find([0, 0], [9, 9], {}, trace);
/// trace.expanded; // how many vertices were expanded
/// trace.steps();  // which, and in which order
/// ```
#[wasm_bindgen]
pub struct Trace {
    events: Rc<RefCell<Events>>,
}

/// The events so far.
#[derive(Default)]
pub(crate) struct Events {
    /// Vertices in a row, once there is an event.
    row: Option<u32>,
    /// One number an event: 2 · v + 1 where vertex v was expanded, 2 · v where it was generated.
    steps: Vec<u32>,
    /// Every event, if they are kept.
    all: Option<Vec<(Kind, NodeEvent)>>,
    expanded: u64,
    generated: u64,
    updated: u64,
    scanned: u64,
    /// Whether an event had no room.
    is_cut: bool,
}

/// The kind of an event at a vertex.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Expanded,
    Generated,
    Updated,
}

/// Adds an item, if there is memory for it.
fn push<T>(items: &mut Vec<T>, item: T) -> bool {
    if items.len() == items.capacity() && items.try_reserve(items.len().max(1024)).is_err() {
        return false;
    }
    items.push(item);
    true
}

impl Events {
    /// The number of a vertex, row by row.
    fn number(&self, at: Vertex) -> u32 {
        // Fewer than 2³¹ vertices.
        at.y as u32 * self.row.unwrap_or(0) + at.x as u32
    }

    fn keep(&mut self, kind: Kind, node: NodeEvent) {
        let step = match kind {
            Kind::Expanded => Some(2 * self.number(node.at) + 1),
            Kind::Generated => Some(2 * self.number(node.at)),
            Kind::Updated => None,
        };
        let has_room = step.is_none_or(|step| push(&mut self.steps, step))
            && self.all.as_mut().is_none_or(|all| push(all, (kind, node)));
        self.is_cut |= !has_room;
    }
}

impl Observer for Events {
    fn expanded(&mut self, node: NodeEvent) {
        self.expanded += 1;
        self.keep(Kind::Expanded, node);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.generated += 1;
        self.keep(Kind::Generated, node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.updated += 1;
        self.keep(Kind::Updated, node);
    }

    fn scanned(&mut self, vertices: u32) {
        self.scanned += u64::from(vertices);
    }
}

impl Trace {
    /// The recorder of a search in this space.
    pub(crate) fn recorder(&self, space: &Inner) -> Result<RefMut<'_, Events>, JsValue> {
        let mut events = self.events.try_borrow_mut().map_err(|_| in_use())?;
        let row = row_of(space);
        if events.row.is_some_and(|known| known != row) {
            let text = "trace: it has events of a space of another size: clear it first";
            return Err(coded(mediant::ErrorCode::Mismatch, text));
        }
        events.row = Some(row);
        Ok(events)
    }

    /// All events of a search in this space.
    pub(crate) fn with_all<T>(
        &self,
        space: &Inner,
        use_them: impl FnOnce(&[(Kind, NodeEvent)]) -> Result<T, JsValue>,
    ) -> Result<T, JsValue> {
        let events = self.events.try_borrow().map_err(|_| in_use())?;
        let Some(all) = &events.all else {
            return Err(argument("trace", "it does not keep all events: make it by new Trace(true)"));
        };
        if events.row.is_some_and(|row| row != row_of(space)) {
            return Err(coded(
                mediant::ErrorCode::Mismatch,
                "planner: it searches a map of another size than the trace has",
            ));
        }
        if events.is_cut {
            return Err(no_memory("the trace"));
        }
        use_them(all)
    }

    /// The vertices that were expanded, in order, and those that were only reached, once each. `None` if they
    /// are of a space of another size than `width` × `height` vertices.
    pub(crate) fn vertices(&self, (width, height): (u32, u32)) -> Result<Option<Expanded>, JsValue> {
        self.read(|events| {
            if events.row.is_some_and(|row| row != width) {
                return Ok(None);
            }
            let mut is_expanded = room(width as usize * height as usize, false, "the trace")?;
            for step in events.steps.iter().filter(|&step| step % 2 == 1) {
                match is_expanded.get_mut(*step as usize / 2) {
                    Some(is_expanded) => *is_expanded = true,
                    None => return Ok(None),
                }
            }
            let at = |step: &u32| Vertex::new((step / 2 % width) as i32, (step / 2 / width) as i32);
            let is_open =
                |step: &&u32| step.is_multiple_of(2) && is_expanded.get(**step as usize / 2) == Some(&false);
            let expanded = events.steps.iter().filter(|&step| step % 2 == 1).map(at).collect();
            Ok(Some((expanded, events.steps.iter().filter(is_open).map(at).collect())))
        })?
    }

    fn read<T>(&self, value: impl FnOnce(&Events) -> T) -> Result<T, JsValue> {
        self.events.try_borrow().map(|events| value(&events)).map_err(|_| in_use())
    }
}

/// The vertices that were expanded, and those that were only generated.
type Expanded = (Vec<Vertex>, Vec<Vertex>);

/// The number of vertices in a row: of corners where paths bend at corners, also between centers.
fn row_of(space: &Inner) -> u32 {
    space.map().width() + u32::from(space.motion().rules.gap().is_some())
}

/// The error for a trace that a search is writing to.
fn in_use() -> JsValue {
    coded(mediant::ErrorCode::Argument, "trace: a search is writing to it: wait until it has ended")
}

#[wasm_bindgen]
impl Trace {
    /// An empty trace. With `all` it keeps every event with its costs and its parent, for `posthoc`.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "boolean")] all: &JsValue,
    ) -> Result<Self, JsValue> {
        let keeps_all = !all.is_undefined() && flag("all", all)?;
        let events = Events { all: keeps_all.then(Vec::new), ..Events::default() };
        Ok(Self { events: Rc::new(RefCell::new(events)) })
    }

    /// The number of expanded vertices, without the goal, at which a search stops.
    #[wasm_bindgen(getter)]
    pub fn expanded(&self) -> Result<f64, JsValue> {
        self.read(|events| events.expanded as f64)
    }

    /// The number of vertices that were reached for the first time.
    #[wasm_bindgen(getter)]
    pub fn generated(&self) -> Result<f64, JsValue> {
        self.read(|events| events.generated as f64)
    }

    /// The number of times that a shorter path to a vertex was found.
    #[wasm_bindgen(getter)]
    pub fn updated(&self) -> Result<f64, JsValue> {
        self.read(|events| events.updated as f64)
    }

    /// The number of vertices that jump point searches looked at in their jumps.
    #[wasm_bindgen(getter)]
    pub fn scanned(&self) -> Result<f64, JsValue> {
        self.read(|events| events.scanned as f64)
    }

    /// The events in their order from number `from` on, one number each: 2·v + 1 where vertex v was expanded,
    /// 2·v where it was generated; v = y · (vertices in a row) + x. At corners a row has one vertex more than
    /// cells.
    ///
    /// @throws MediantError `memory` if there was no room for all events.
    pub fn steps(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "number")] from: &JsValue,
    ) -> Result<Uint32Array, JsValue> {
        let from = if from.is_undefined() { 0 } else { integer("from", from, 0)? };
        self.read(|events| {
            if events.is_cut {
                return Err(no_memory("the trace"));
            }
            let from = usize::try_from(from).unwrap_or(usize::MAX).min(events.steps.len());
            Ok(Uint32Array::from(&events.steps[from..]))
        })?
    }

    /// Forgets all events.
    pub fn clear(&self) -> Result<(), JsValue> {
        let mut events = self.events.try_borrow_mut().map_err(|_| in_use())?;
        let all = events.all.is_some().then(Vec::new);
        *events = Events { all, ..Events::default() };
        Ok(())
    }

    /// A second handle to the same trace, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { events: Rc::clone(&self.events) }
    }
}
