//! Distance fields.

use std::rc::Rc;

use js_sys::{Float32Array, Float64Array};
use mediant::{Field as Inner, Vertex};
use wasm_bindgen::prelude::*;

use crate::{
    answer::{flat, pair},
    arguments::{Points, point, positive, room},
    errors::raised_for,
    listening::{Listening, tell},
    memory,
    space::Space,
    types::JsWaypoints,
};

/// The distance of every vertex to the nearest source, with the paths and directions to it: one goal for many
/// agents, or what lies within reach. `Space.field` makes it.
#[wasm_bindgen]
pub struct Field {
    pub(crate) inner: Rc<Inner>,
}

impl Field {
    pub(crate) fn new(inner: Inner) -> Self {
        Self { inner: Rc::new(inner) }
    }
}

#[wasm_bindgen]
impl Field {
    /// The number of vertices in a row.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.inner.width()
    }

    /// The number of rows of vertices.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.inner.height()
    }

    /// The distances of all vertices in cells, row by row; `Infinity` where no path leads.
    pub fn distances(&self) -> Result<Float64Array, JsValue> {
        let vertices = u64::from(self.inner.width()) * u64::from(self.inner.height());
        memory::check("the array of distances", vertices, 8)?;
        Ok(Float64Array::from(&self.inner.lengths()[..]))
    }

    /// The directions in which the shortest paths leave the vertices, row by row: dx, dy, of length 1
    /// together; 0, 0 at sources and where no path leads.
    pub fn flow(&self) -> Result<Float32Array, JsValue> {
        let (width, height) = (self.inner.width() as usize, self.inner.height() as usize);
        let mut flow = room(2 * width * height, 0.0_f32, "the array of directions")?;
        for (y, row) in flow.chunks_exact_mut(2 * width).enumerate() {
            for (x, to) in row.chunks_exact_mut(2).enumerate() {
                if let Some((dx, dy)) = self.inner.direction(Vertex::new(x as i32, y as i32)) {
                    to.copy_from_slice(&[dx as f32, dy as f32]);
                }
            }
        }
        Ok(Float32Array::from(&flow[..]))
    }

    /// The distance of a vertex in cells; `Infinity` where no path leads.
    pub fn get(&self, #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue) -> Result<f64, JsValue> {
        Ok(self.inner.get(point("at", at)?).unwrap_or(f64::INFINITY))
    }

    /// The vertex to which the shortest path leads next: one move away; at any angle the next corner of an
    /// obstacle on it, at which it bends or goes straight on, or the source. Undefined at a source, and where
    /// no path leads.
    #[wasm_bindgen(unchecked_return_type = "Point | undefined")]
    pub fn next(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let next = self.inner.next(point("at", at)?);
        Ok(next.map_or(JsValue::UNDEFINED, |at| pair(at).into()))
    }

    /// The shortest path from a vertex to the nearest source, x, y, …; undefined where none leads.
    #[wasm_bindgen(js_name = pathFrom)]
    pub fn path_from(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<Option<JsWaypoints>, JsValue> {
        Ok(self.inner.path_from(point("at", at)?).as_ref().map(flat))
    }

    /// The source that is nearest to a vertex; undefined where no path leads.
    #[wasm_bindgen(js_name = nearestSource, unchecked_return_type = "Point | undefined")]
    pub fn nearest_source(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let source = self.inner.nearest_source(point("at", at)?);
        Ok(source.map_or(JsValue::UNDEFINED, |at| pair(at).into()))
    }

    /// A second handle to the same field, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: Rc::clone(&self.inner) }
    }
}

#[wasm_bindgen]
impl Space {
    /// The distance of every vertex to the nearest source, up to a limit in cells if there is one. A vertex
    /// at exactly that distance is in the field. Where cells have costs, `progress` is called now and then
    /// with the number of vertices that have their cost, and of all that are not blocked. If some cannot be
    /// reached, or cost more than the limit, it ends with fewer than all. If it throws, so does the call.
    ///
    /// ```js
    /// const field = space.field([0, 0]);
    /// field.get([3, 0]); // 3
    /// ```
    ///
    /// @throws MediantError `start-blocked`, `start-outside` for a source that is blocked or outside the map;
    /// what `progress` throws.
    pub fn field(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] sources: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "number")] limit: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "(done: number, total: number) => void")]
        progress: &JsValue,
    ) -> Result<Field, JsValue> {
        let sources = Points::read("sources", sources)?;
        self.check_room("the field", memory::FIELD)?;
        let sources = sources.as_slice().iter().copied();
        let none = limit.is_undefined() || limit.is_null();
        let limit = if none { f64::INFINITY } else { positive("limit", limit)? };
        let listening = Listening::begin(progress)?;
        let limits = listening.limits().progress(|done, total| {
            tell(done, total, |listener, done, total| listener.call2(&JsValue::UNDEFINED, done, total));
        });
        let field = self.inner.within(limits).field_within(sources, limit);
        listening.end()?;
        Ok(Field::new(field.map_err(|error| raised_for("source", error))?))
    }
}
