//! Indexes: the preparation of an engine.

use mediant::{Change, Guarantee, Index as Inner, files::WorldFrame, options::Levels};
use wasm_bindgen::prelude::*;

use crate::{arguments::object, errors::raised, grid::OfCells, memory, planner::Planner, space::Space};

/// The preparation of an engine in a space: `Space.prepare`, `Space.load` and `repair` make it. It never
/// changes; any number of planners share it.
#[wasm_bindgen]
pub struct Index {
    pub(crate) inner: Inner,
    pub(crate) world: Option<WorldFrame>,
}

impl Index {
    /// The guarantee of its paths.
    fn promised(&self) -> Guarantee {
        match self.inner.setup().guarantee() {
            Guarantee::Optimal(k) if OfCells::of(self.inner.space()).is_some() => Guarantee::Cheapest(k),
            guarantee => guarantee,
        }
    }
}

#[wasm_bindgen]
impl Index {
    /// The engine.
    #[wasm_bindgen(getter)]
    pub fn engine(&self) -> String {
        self.inner.setup().engine.kind().name().to_owned()
    }

    /// The engine that searches: `engine`, but for subgoals of a map on which they would be slow, as on
    /// noise. Nothing is kept of them there, and the best engine that prepares little searches. Its paths
    /// are as good.
    #[wasm_bindgen(getter, js_name = searchedBy)]
    pub fn searched_by(&self) -> String {
        self.inner.searched_by().name().to_owned()
    }

    /// The levels of its subgoal graph or clusters, or what it has instead: `"contracted"`, a contraction
    /// hierarchy, or `"labels"`, hub labels. Undefined for an index without any.
    #[wasm_bindgen(
        getter,
        unchecked_return_type = "number | \"all\" | \"contracted\" | \"labels\" | undefined"
    )]
    pub fn levels(&self) -> JsValue {
        match self.inner.levels() {
            Some(Levels::Number(number)) => number.get().into(),
            Some(levels) => levels.to_string().into(),
            None => JsValue::UNDEFINED,
        }
    }

    /// The engine, k, rule and options in one text: the same text, the same answers.
    #[wasm_bindgen(getter)]
    pub fn setup(&self) -> String {
        self.inner.setup().to_string()
    }

    /// The guarantee of its paths: `"optimal(3)"`, `"optimal(any)"`, `"at-most(3)"`, `"suboptimal"`; where
    /// cells have costs `"cheapest(3)"`.
    #[wasm_bindgen(getter)]
    pub fn guarantee(&self) -> String {
        self.promised().to_string()
    }

    /// Whether its paths are shortest over its k.
    #[wasm_bindgen(getter)]
    pub fn optimal(&self) -> bool {
        self.inner.setup().optimal_over().is_some()
    }

    /// An upper bound on its paths' lengths, as a multiple of the shortest at any angle: 1.08 is 8 % longer.
    /// Undefined where nothing is proven, as on costs.
    #[wasm_bindgen(getter)]
    pub fn bound(&self) -> Option<f64> {
        self.promised().bound(self.inner.setup().rules())
    }

    /// The memory that it uses beyond the space, in bytes.
    #[wasm_bindgen(getter, js_name = memoryBytes)]
    pub fn memory_bytes(&self) -> f64 {
        self.inner.memory_bytes() as f64
    }

    /// The way in which it came about.
    #[wasm_bindgen(
        getter,
        unchecked_return_type = "\"prepared\" | \"loaded\" | \"repaired\" | \"unchanged\""
    )]
    pub fn origin(&self) -> String {
        self.inner.origin().name().to_owned()
    }

    /// Whether nothing of it is that of an earlier map: false for subgoals that were repaired, until
    /// `finish`.
    #[wasm_bindgen(getter, js_name = isFinished)]
    pub fn is_finished(&self) -> bool {
        self.inner.is_finished()
    }

    /// The space that it belongs to.
    #[wasm_bindgen(getter)]
    pub fn space(&self) -> Space {
        Space { inner: self.inner.space().clone(), world: self.world }
    }

    /// A planner on this index, with scratch memory of its own.
    ///
    /// @throws MediantError `memory` if there is no room for it.
    pub fn planner(&self) -> Result<Planner, JsValue> {
        self.space().check_room("the planner", memory::PLANNER)?;
        Ok(Planner::new(self.inner.try_planner().map_err(raised)?))
    }

    /// The index for a changed map of the same rules and k, repaired by work that follows the difference of
    /// the maps where the engine's index can be, else prepared anew: `origin` says which it was. This index
    /// stays as it is.
    ///
    /// @throws MediantError `mismatch` for a space of other rules or another k.
    pub fn repair(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Space")] space: &JsValue,
    ) -> Result<Index, JsValue> {
        let space: Space = object("space", "Space", space)?;
        space.check_room("the index", memory::INDEX)?;
        let change = Change::between(self.inner.space(), &space.inner).map_err(raised)?;
        Ok(Self { inner: self.inner.repair(&change).map_err(raised)?, world: space.world })
    }

    /// This index with all that a repair left made anew. After it, subgoals go on with the labels or the
    /// graph of the earlier map where these prove the answer; elsewhere another engine searches
    /// (`Planner.searchedBy`). To make them anew takes as long as `Space.prepare`: do it after some edits, in
    /// a worker, which gets the cells and gives back `toBytes`.
    ///
    /// @throws MediantError as `Space.prepare`.
    pub fn finish(&self) -> Result<Index, JsValue> {
        self.space().check_room("the index", memory::INDEX)?;
        Ok(Self { inner: self.inner.finish().map_err(raised)?, world: self.world })
    }

    /// A second handle to the same index, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: self.inner.clone(), world: self.world }
    }
}
