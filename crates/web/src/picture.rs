//! Pictures of maps with paths, fields and searches.

use std::rc::Rc;

use js_sys::Uint8Array;
use mediant::{Field as Distances, Map, PlacementKind, Point, Vertex};
use mediant_formats::Picture as Drawn;
use wasm_bindgen::prelude::*;

use crate::{
    arguments::{Points, integer_32, object, path_points, positive, text, word},
    errors::{coded, no_memory},
    field::Field,
    grid::Grid,
    memory,
    trace::Trace,
};

/// A picture of a map, as PNG or SVG: from back to front the free cells, a field as colors with contour
/// lines, what a search expanded, the blocked cells, the way of an agent, the paths, the start and the goal.
///
/// ```js
/// const picture = new Picture(grid, "center");
/// picture.path("shortest", path);
/// document.body.innerHTML = picture.svg();
/// ```
#[wasm_bindgen]
pub struct Picture {
    map: Map,
    placement: PlacementKind,
    field: Option<Rc<Distances>>,
    expanded: Vec<Vertex>,
    open: Vec<Vertex>,
    paths: Vec<(String, Vec<Point>)>,
    starts: Vec<Point>,
    goals: Vec<Point>,
    radius: f64,
    caption: String,
    largest_side: Option<u32>,
}

impl Picture {
    /// The number of vertices in a row, and of rows.
    fn size(&self) -> (u32, u32) {
        let more = u32::from(self.placement == PlacementKind::Corner);
        (self.map.width() + more, self.map.height() + more)
    }

    /// The picture, once there is room for its pixels.
    fn drawn(&self) -> Result<Drawn<'_>, JsValue> {
        let side = u64::from(self.largest_side.unwrap_or(4096).clamp(64, 16_384)) + 64;
        let (width, height) = (u64::from(self.map.width()), u64::from(self.map.height()));
        // Small maps are enlarged, up to 40 pixels a cell and 1200 a side.
        let [width, height] = [width, height].map(|cells| (40 * cells + 64).min(side));
        memory::check("the picture", width * height, 16)?;
        let mut drawn = Drawn::new(self.map.grid(), self.placement)
            .expanded(self.expanded.iter().copied())
            .open(self.open.iter().copied())
            .starts(self.starts.iter().copied())
            .goals(self.goals.iter().copied())
            .radius(self.radius)
            .caption(self.caption.as_str());
        if let Some(field) = &self.field {
            drawn = drawn.field(|at| field.get(at));
        }
        if let Some(side) = self.largest_side {
            drawn = drawn.largest_side(side);
        }
        for (name, points) in &self.paths {
            drawn = drawn.path(name.as_str(), points.iter().map(|at| (at.x(), at.y())));
        }
        Ok(drawn)
    }
}

/// The error for what has vertices of another map.
fn other_size(name: &str) -> JsValue {
    coded(
        mediant::ErrorCode::Mismatch,
        &format!("{name}: it belongs to a map of another size, or to another placement"),
    )
}

#[wasm_bindgen]
impl Picture {
    /// A map; the placement says where vertices are.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_param_type = "Grid")] grid: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "\"center\" | \"corner\"")] placement: &JsValue,
    ) -> Result<Self, JsValue> {
        let grid: Grid = object("grid", "Grid", grid)?;
        Ok(Self {
            map: grid.map.clone(),
            placement: word("placement", placement)?,
            field: None,
            expanded: Vec::new(),
            open: Vec::new(),
            paths: Vec::new(),
            starts: Vec::new(),
            goals: Vec::new(),
            radius: 0.0,
            caption: String::new(),
            largest_side: None,
        })
    }

    /// Shows a field as colors: the farther, the darker.
    ///
    /// @throws MediantError `mismatch` for a field of a map of another size.
    pub fn field(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Field")] field: &JsValue,
    ) -> Result<(), JsValue> {
        let field: Field = object("field", "Field", field)?;
        if (field.inner.width(), field.inner.height()) != self.size() {
            return Err(other_size("field"));
        }
        self.field = Some(Rc::clone(&field.inner));
        Ok(())
    }

    /// Shows the vertices that a search expanded, the later the darker, and those that it only reached.
    ///
    /// @throws MediantError `mismatch` for a trace of a map of another size.
    pub fn searched(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Trace")] trace: &JsValue,
    ) -> Result<(), JsValue> {
        let trace: Trace = object("trace", "Trace", trace)?;
        (self.expanded, self.open) = trace.vertices(self.size())?.ok_or_else(|| other_size("trace"))?;
        Ok(())
    }

    /// Adds a path, x, y, …. SVG shows its name in the legend.
    pub fn path(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "string")] name: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] points: &JsValue,
    ) -> Result<(), JsValue> {
        let name = text("name", "a text", name)?;
        self.paths.push((name, path_points("points", points)?));
        Ok(())
    }

    /// Marks the start, or several.
    pub fn start(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Points")] at: &JsValue,
    ) -> Result<(), JsValue> {
        self.starts = Points::read("at", at)?.into_vec();
        Ok(())
    }

    /// Marks the goal, or several.
    pub fn goal(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Points")] at: &JsValue,
    ) -> Result<(), JsValue> {
        self.goals = Points::read("at", at)?.into_vec();
        Ok(())
    }

    /// Shows the way of a disc of this radius, in cells, along each path.
    pub fn radius(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "number")] cells: &JsValue,
    ) -> Result<(), JsValue> {
        self.radius = positive("cells", cells)?;
        Ok(())
    }

    /// A line of text below, in SVG alone.
    pub fn caption(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "string")] text: &JsValue,
    ) -> Result<(), JsValue> {
        self.caption = crate::arguments::text("text", "a text", text)?;
        Ok(())
    }

    /// The most pixels of the map's longer side: 4096 without, from 64 to 16,384. Where the map has more
    /// cells, a pixel covers several of them.
    #[wasm_bindgen(js_name = largestSide)]
    pub fn largest_side(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "number")] pixels: &JsValue,
    ) -> Result<(), JsValue> {
        self.largest_side = Some(integer_32("pixels", pixels, 1)?);
        Ok(())
    }

    /// The picture as the bytes of a PNG.
    ///
    /// @throws MediantError `memory` if there is no room for its pixels.
    pub fn png(&self) -> Result<Uint8Array, JsValue> {
        let mut png = Vec::new();
        self.drawn()?.write_png(&mut png).map_err(|_| no_memory("the picture"))?;
        Ok(Uint8Array::from(&png[..]))
    }

    /// The picture as SVG. It adapts to dark pages.
    ///
    /// @throws MediantError `memory` if there is no room for it.
    pub fn svg(&self) -> Result<String, JsValue> {
        Ok(self.drawn()?.svg())
    }
}
