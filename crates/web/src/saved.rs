//! Indexes as bytes.

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;

use crate::{
    arguments::bytes,
    errors::raised,
    index::Index,
    keywords::{Keywords, OPTIONS},
    space::Space,
};

#[wasm_bindgen]
impl Space {
    /// The index of bytes that `Index.toBytes` gave for the same map and motion.
    ///
    /// @throws MediantError `mismatch` for the index of another map or motion, `index-damaged` and
    /// `index-engine` for bytes that are no whole index, or one of another version.
    pub fn load(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array")] index: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Options")] options: &JsValue,
    ) -> Result<Index, JsValue> {
        let keywords = Keywords::read("options", options, OPTIONS)?;
        let index = self.inner.index_from_bytes(bytes("bytes", index)?).map_err(raised)?;
        let call = keywords.call;
        let index = if call.has_options() { index.with_call(&call).map_err(raised)? } else { index };
        Ok(Index { inner: index, world: self.world })
    }
}

#[wasm_bindgen]
impl Index {
    /// The index as bytes, for `Space.load`.
    ///
    /// @throws MediantError `engine-without` for an engine whose index is not saved.
    #[wasm_bindgen(js_name = toBytes)]
    pub fn to_bytes(&self) -> Result<Uint8Array, JsValue> {
        Ok(Uint8Array::from(&self.inner.to_bytes().map_err(raised)?[..]))
    }
}
