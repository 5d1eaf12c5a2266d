//! Spaces: maps with rules of motion.

use js_sys::Int32Array;
use mediant::{Motion, Path, PlacementKind, Point, Rules, Space as Inner, files::WorldFrame};
use wasm_bindgen::prelude::*;

use crate::{
    answer,
    arguments::{path_points, point},
    errors::broken,
    grid::{Grid, OfCells},
    keywords::{Keywords, MOTION},
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
    let path = Path::through(path_points("path", path)?);
    // Waypoints may be anywhere. A step along an axis touches two cells at most, and a list may be half
    // empty.
    let steps = |(from, to): (Point, Point)| {
        let ((x, y), (to_x, to_y)) = (from.parts(), to.parts());
        (x.abs_diff(to_x) + y.abs_diff(to_y)) / Point::PARTS as u64
    };
    let segments = path.points().zip(path.points().skip(1));
    let most: u64 = segments.map(|ends| 2 * steps(ends) + 8).sum();
    memory::check("the points along the path", most, 32)?;
    let flat: Vec<i32> = of(&path).into_iter().flat_map(|(x, y)| [x, y]).collect();
    Ok(Int32Array::from(&flat[..]))
}

impl Space {
    /// A map at its place in the world, with rules of motion.
    pub(crate) fn of(grid: &Grid, motion: Motion) -> Result<Self, JsValue> {
        memory::check("the space", memory::vertices(&grid.map), memory::SPACE)?;
        Ok(Self { inner: grid.searched(motion)?, world: grid.world })
    }

    /// Checks that there is room for so many bytes a vertex.
    pub(crate) fn check_room(&self, what: &str, bytes: u64) -> Result<(), JsValue> {
        memory::check(what, memory::vertices(self.inner.map()), bytes)
    }
}

#[wasm_bindgen]
impl Grid {
    /// This map with rules of motion: what is searched. By default eight directions between the centers of
    /// cells, without cutting corners.
    ///
    /// ```js
    /// const space = grid.space({ k: "any" }); // any direction, between the corners of cells
    /// const centers = grid.space({ k: "any", placement: "center" }); // the same between their centers
    /// ```
    ///
    /// @throws MediantError `motion` where no engine searches: k above 12; k above
    /// 8 where cells have costs.
    pub fn space(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "Motion")] motion: &JsValue,
    ) -> Result<Space, JsValue> {
        let motion = Keywords::read("motion", motion, MOTION)?.motion()?;
        Space::of(self, motion)
    }
}

#[wasm_bindgen]
impl Space {
    /// The map.
    #[wasm_bindgen(getter)]
    pub fn grid(&self) -> Grid {
        Grid { map: self.inner.map().clone(), world: self.world, costs: OfCells::of(&self.inner) }
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
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(self.inner.check(&Path::through(path_points("path", path)?)).is_ok())
    }

    /// Throws what is wrong with a path that does not hold: the segment, and the first blocked cell on it.
    ///
    /// @throws MediantError `broken-path`.
    pub fn check(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
    ) -> Result<(), JsValue> {
        self.inner.check(&Path::through(path_points("path", path)?)).map_err(|error| broken(&error))
    }

    /// The walk along a path, x, y, …: every vertex on it, where its waypoints are the turns alone. A path
    /// with points between vertices has none.
    ///
    /// @throws MediantError `memory` for waypoints that are too far apart.
    pub fn vertices(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
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
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
    ) -> Result<Int32Array, JsValue> {
        let rules = self.inner.motion().rules;
        along(path, |path| match rules {
            Rules::CenterGap(_) => path.at_corners().touched_cells(PlacementKind::Corner).collect(),
            _ => path.touched_cells(rules.placement()).collect(),
        })
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
        Self::of(&self.grid().edit(x, y, width, height, blocked)?, self.inner.motion())
    }

    /// A second handle to the same space, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: self.inner.clone(), world: self.world }
    }
}
