//! A recorded search as a file for the Posthoc visualizer.

use std::io::{self, Write};

use mediant::{
    PointEnds,
    search::{Observer, Tracer},
};
use wasm_bindgen::prelude::*;

use crate::{
    arguments::{object, point},
    errors::{coded, no_memory},
    planner::Planner,
    trace::{Kind, Trace},
};

/// A text that grows as long as there is memory.
#[derive(Default)]
struct Text(Vec<u8>);

impl Write for Text {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.try_reserve(bytes.len())?;
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[wasm_bindgen]
impl Trace {
    /// The search that was recorded last, as a JSON text for the [Posthoc](https://posthoc.pathfinding.ai)
    /// visualizer: the map, the events, the path of the planner's answer. `start` and `goal` are those of the
    /// query. The trace must have been made with `all`, and hold one search: `clear` it before the next.
    ///
    /// @throws MediantError `argument` for a trace that does not keep all events, `mismatch` for a planner on
    /// a map of another size, `memory` if there is no room for the text.
    pub fn posthoc(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Planner")] planner: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] goal: &JsValue,
    ) -> Result<String, JsValue> {
        let searched = object::<Planner>("planner", "Planner", planner)?.searched()?;
        let query = PointEnds::new(point("start", start)?, point("goal", goal)?);
        self.with_all(&searched.space, |events| {
            let placement = searched.space.motion().rules.placement();
            let write = || -> io::Result<Text> {
                let mut tracer = Tracer::new(Text::default(), searched.space.map().grid(), placement)?;
                tracer = tracer.in_space(&searched.space);
                tracer.begin(query, searched.answer.as_ref());
                for &(kind, node) in events {
                    match kind {
                        Kind::Expanded => tracer.expanded(node),
                        Kind::Generated => tracer.generated(node),
                        Kind::Updated => tracer.updated(node),
                    }
                }
                tracer.end(searched.answer.as_ref());
                tracer.finish()
            };
            let Text(text) = write().map_err(|_| no_memory("the trace's text"))?;
            String::from_utf8(text).map_err(|_| coded(mediant::ErrorCode::Other, "the trace is no text"))
        })
    }
}
