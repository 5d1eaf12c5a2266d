//! Spaces: maps with rules of motion.

use std::cell::RefCell;

use js_sys::{Function, Int32Array, JsString};
use mediant::{
    Demand, Limits, Map, Motion, Path, Space as Inner, Vertex, files::WorldFrame, search::Progress,
};
use wasm_bindgen::{JsCast, prelude::*};

use crate::{
    answer,
    arguments::{path_points, point},
    errors::{broken, raised, wrong_type},
    grid::{Edit, Grid},
    index::Index,
    keywords::{Keywords, OPTIONS},
    memory,
    types::{JsChoice, JsMotion},
};

/// A map with rules of motion and a k: what can be searched. It never changes.
#[wasm_bindgen]
pub struct Space {
    pub(crate) inner: Inner,
    pub(crate) world: Option<WorldFrame>,
}

/// The points that `of` finds along a path, as x, y, ….
fn along(path: &JsValue, of: impl FnOnce(&Path) -> Vec<(i32, i32)>) -> Result<Int32Array, JsValue> {
    let path = Path::new(path_points("path", path)?);
    // Waypoints may be anywhere. A step along an axis touches two cells at most, and a list may be half
    // empty.
    let steps =
        |ends: &[Vertex]| u64::from(ends[0].x.abs_diff(ends[1].x)) + u64::from(ends[0].y.abs_diff(ends[1].y));
    let most: u64 = path.waypoints().windows(2).map(|ends| 2 * steps(ends) + 4).sum();
    memory::check("the points along the path", most, 32)?;
    let flat: Vec<i32> = of(&path).into_iter().flat_map(|(x, y)| [x, y]).collect();
    Ok(Int32Array::from(&flat[..]))
}

/// The most vertices that a map can have.
pub(crate) fn vertices(map: &Map) -> u64 {
    (u64::from(map.width()) + 1) * (u64::from(map.height()) + 1)
}

impl Space {
    /// A map at its place in the world, with rules of motion.
    pub(crate) fn of(map: &Map, motion: Motion, world: Option<WorldFrame>) -> Result<Self, JsValue> {
        memory::check("the space", vertices(map), memory::SPACE)?;
        Ok(Self { inner: map.space(motion).map_err(raised)?, world })
    }

    /// Checks that there is room for so many bytes a vertex.
    pub(crate) fn check_room(&self, what: &str, bytes: u64) -> Result<(), JsValue> {
        memory::check(what, vertices(self.inner.map()), bytes)
    }
}

#[wasm_bindgen]
impl Space {
    /// The map.
    #[wasm_bindgen(getter)]
    pub fn grid(&self) -> Grid {
        Grid { map: self.inner.map().clone(), world: self.world }
    }

    /// The rules of motion and the k, in full.
    #[wasm_bindgen(getter)]
    pub fn motion(&self) -> JsMotion {
        answer::motion(self.inner.motion())
    }

    /// Whether a path may stand on this vertex; false outside the map. A vertex on a closed gap is free, too,
    /// but a path starts or ends there only through the vertex's own cell, and if that is blocked, not at
    /// all.
    #[wasm_bindgen(js_name = isFree)]
    pub fn is_free(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(self.inner.is_free(point("at", at)?))
    }

    /// Whether there is a path from one vertex to another, in constant time.
    pub fn connected(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] from: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] to: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(self.inner.connected(point("from", from)?, point("to", to)?))
    }

    /// Whether the straight segment between two vertices obeys the rules of motion. It is judged for itself:
    /// a closed gap that it passes is in its way, one at which it begins or ends is not. `check` judges whole
    /// paths.
    pub fn sees(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] from: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] to: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(self.inner.sees(point("from", from)?, point("to", to)?))
    }

    /// Whether a path, x, y, …, obeys the rules of motion, at any angle: whether it still holds after an
    /// edit.
    pub fn holds(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Int32Array")] path: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(self.inner.check(&Path::new(path_points("path", path)?)).is_ok())
    }

    /// Throws what is wrong with a path that does not hold: the segment, and the first blocked cell on it.
    ///
    /// @throws MediantError `broken-path`.
    pub fn check(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Int32Array")] path: &JsValue,
    ) -> Result<(), JsValue> {
        self.inner.check(&Path::new(path_points("path", path)?)).map_err(|error| broken(&error))
    }

    /// The walk along a path, x, y, …: every vertex on it, where its waypoints are the turns alone.
    ///
    /// @throws MediantError `memory` for waypoints that are too far apart.
    pub fn vertices(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Int32Array")] path: &JsValue,
    ) -> Result<Int32Array, JsValue> {
        along(path, |path| path.vertices().map(|at| (at.x, at.y)).collect())
    }

    /// The cells that a path, x, y, …, touches. They are no walk: passing between four cells a path touches
    /// all of them, and along a grid line those on both sides.
    ///
    /// @throws MediantError `memory` for waypoints that are too far apart.
    #[wasm_bindgen(js_name = touchedCells)]
    pub fn touched_cells(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Int32Array")] path: &JsValue,
    ) -> Result<Int32Array, JsValue> {
        let placement = self.inner.motion().rules.placement();
        along(path, |path| path.touched_cells(placement).collect())
    }

    /// The engine that we would take for many paths, and why, in a sentence.
    pub fn engine(&self) -> JsChoice {
        let choice = self.inner.engine();
        answer::object_of([("engine", Some(choice.engine.name().into())), ("why", Some(choice.why.into()))])
    }

    /// The same rules and k on an edited map: see `Grid.edit`. This space stays as it is.
    ///
    /// @throws MediantError as `Grid.edit`.
    pub fn edit(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] width: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] height: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray")] blocked: &JsValue,
    ) -> Result<Self, JsValue> {
        let edit = Edit::read([x, y, width, height], blocked)?;
        let map = self.inner.map().edit(edit.at, |x, y| edit.is_blocked(x, y)).map_err(raised)?;
        Self::of(&map, self.inner.motion(), self.world)
    }

    /// Prepares what an engine needs; by default the engine that `engine()` names. `progress` is called with
    /// a stage (`"edges"`, `"hierarchy"`, `"sight"` or `"labels"`), and how much of it is done of all. What
    /// it throws stops the preparation. From outside, a preparation is stopped by ending its worker.
    ///
    /// ```js
    /// const index = space.prepare("subgoal");
    /// const path = index.planner().find([0, 0], [9, 9]).path;
    /// ```
    ///
    /// @throws MediantError `engine-…` for an engine that does not take the motion or the options;
    /// `index-range` for a map that is too large for the index; what `progress` throws.
    pub fn prepare(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "string")] engine: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Options")] options: &JsValue,
        #[wasm_bindgen(
            unchecked_optional_param_type = "(stage: string, done: number, total: number) => void"
        )]
        progress: &JsValue,
    ) -> Result<Index, JsValue> {
        let keywords = Keywords::read("options", options, OPTIONS)?.with("engine", engine)?;
        let (setup, _) = self.inner.setup(&keywords.call, Demand::Paths(u64::MAX)).map_err(raised)?;
        let listener = match progress.dyn_ref::<Function>() {
            Some(function) => Some(function.clone()),
            None if progress.is_undefined() || progress.is_null() => None,
            None => return Err(wrong_type("progress", "a function", progress)),
        };
        self.check_room("the index", memory::INDEX)?;
        let listening = Listening::begin(listener);
        let limits = Limits::new().deadline(has_thrown);
        let index = self.inner.within(&limits).prepare_with_progress(setup.engine, &tell);
        listening.end()?;
        let inner = index.map_err(raised)?.with_smoothing(setup.smoothing);
        Ok(Index { inner, world: self.world })
    }

    /// A second handle to the same space, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: self.inner.clone(), world: self.world }
    }
}

thread_local! {
    /// The listeners of the preparations that run, the innermost last: the library's listener must be able to
    /// go to other threads, and a function of JavaScript is not. Beside each stands the value that it has
    /// thrown.
    static LISTENERS: RefCell<Vec<Listener>> = const { RefCell::new(Vec::new()) };
}

type Listener = (Option<Function>, Option<JsValue>);

/// A preparation that somebody listens to.
struct Listening;

impl Listening {
    fn begin(listener: Option<Function>) -> Self {
        LISTENERS.with_borrow_mut(|listeners| listeners.push((listener, None)));
        Self
    }

    /// Ends it.
    ///
    /// # Errors
    /// The value that the listener has thrown.
    fn end(self) -> Result<(), JsValue> {
        let listener = LISTENERS.with_borrow_mut(Vec::pop);
        listener.and_then(|(_, thrown)| thrown).map_or(Ok(()), Err)
    }
}

/// Whether the one that listens has thrown: then the preparation stops.
fn has_thrown() -> bool {
    LISTENERS.with_borrow(|listeners| matches!(listeners.last(), Some((_, Some(_)))))
}

/// Tells the one that listens. Once it has thrown, it is told no more.
fn tell(progress: Progress) {
    let listener = LISTENERS.with_borrow(|listeners| listeners.last().cloned());
    let Some((Some(function), None)) = listener else { return };
    let stage = progress.stage.name();
    let [done, total] = [progress.done, progress.total].map(|count| JsValue::from(count as f64));
    let called = function.call3(&JsValue::UNDEFINED, &JsString::from(stage), &done, &total);
    if let Err(thrown) = called {
        LISTENERS.with_borrow_mut(|listeners| {
            if let Some(last) = listeners.last_mut() {
                last.1 = Some(thrown);
            }
        });
    }
}
