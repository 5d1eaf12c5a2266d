//! Maps from files in memory, and as text.

use std::path::Path;

use js_sys::{Array, Uint8Array};
use mediant::{
    Error, ErrorCode, Map,
    errors::ReadError,
    files::{Fraction, MapOptions, RosVersion},
};
use mediant_formats::MapFile;
use wasm_bindgen::{JsCast, prelude::*};

use super::{
    Grid,
    tiles::{TILES, tiles},
};
use crate::{
    arguments::{bytes, flag, number, text, word},
    errors::{argument, coded, raised, wrong_type},
    keywords::{entries, unknown_key},
};

#[wasm_bindgen]
impl Grid {
    /// Reads a map: a MovingAI map (`.`, `G` and `S` are free cells), a PNG, PGM or PBM picture (pixels
    /// darker than half are blocked), or the YAML file of a ROS map, whose picture is in `files` under its
    /// name (as nav2 reads it since 2025; unknown cells are blocked). The content tells the kind, else the
    /// name does.
    ///
    /// ```js
    /// const file = input.files[0];
    /// const grid = Grid.read(file.name, new Uint8Array(await file.arrayBuffer()));
    /// ```
    ///
    /// @throws MediantError `map-format` for what is no map, `file-missing` for a picture that is not in
    /// `files`.
    pub fn read(
        #[wasm_bindgen(unchecked_param_type = "string")] name: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array", js_name = bytes)] file: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Record<string, Uint8Array>")] files: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "MapOptions")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        let (files, options) = (Files::read(name, file, files)?, map_options(options)?);
        let read = Map::open_in(&files.name, &options, |path| files.get(path));
        let (map, world) = read.map_err(|error| files.raised(error))?;
        Ok(Self { world, ..Self::new(map) })
    }

    /// The width and the height that the header of a map states, without making the map: so that one that is
    /// too large can be refused. The arguments are those of `read`.
    ///
    /// @throws MediantError as `read`.
    #[wasm_bindgen(unchecked_return_type = "[width: number, height: number]")]
    pub fn size(
        #[wasm_bindgen(unchecked_param_type = "string")] name: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array", js_name = bytes)] file: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Record<string, Uint8Array>")] files: &JsValue,
    ) -> Result<Array, JsValue> {
        let files = Files::read(name, file, files)?;
        let size = Map::size_in(&files.name, |path| files.get(path));
        let (width, height) = size.map_err(|error| files.raised(error))?;
        Ok(Array::of2(&width.into(), &height.into()))
    }

    /// The map as the text of a MovingAI map: `.` for free and `@` for blocked cells.
    #[wasm_bindgen(js_name = toMap)]
    pub fn to_map(&self) -> String {
        String::from_utf8_lossy(MapFile::from_grid(self.map.grid()).as_bytes()).into_owned()
    }
}

/// Files in memory.
struct Files {
    name: String,
    file: JsValue,
    others: Vec<(String, JsValue)>,
}

impl Files {
    /// The files of a call.
    fn read(name: &JsValue, file: &JsValue, others: &JsValue) -> Result<Self, JsValue> {
        let name = text("name", "the name of a file", name)?;
        let others = entries("files", others)?;
        let is_bytes = |value: &JsValue| value.is_instance_of::<Uint8Array>();
        if !is_bytes(file) {
            return Err(wrong_type("bytes", "a Uint8Array", file));
        }
        if let Some((name, value)) = others.iter().find(|(_, value)| !is_bytes(value)) {
            return Err(wrong_type(&format!("files['{name}']"), "a Uint8Array", value));
        }
        Ok(Self { name, file: file.clone(), others })
    }

    /// The bytes of a file: by its path, else by its name alone.
    fn get(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        let missing = || ReadError::Missing { path: path.to_owned() };
        let no_memory = |_| {
            let source = std::io::ErrorKind::OutOfMemory.into();
            ReadError::Unreadable { path: path.to_owned(), source }
        };
        if path == Path::new(&self.name) {
            return bytes("bytes", &self.file).map_err(no_memory);
        }
        let by_path = self.others.iter().find(|(name, _)| Path::new(name) == path);
        let by_name = || self.others.iter().find(|(name, _)| Path::new(name).file_name() == path.file_name());
        let (_, file) = by_path.or_else(by_name).ok_or_else(missing)?;
        bytes("files", file).map_err(no_memory)
    }

    /// The error of reading: there is no folder in which a file could be missing.
    fn raised(&self, error: Error) -> JsValue {
        if let Error::Read(ReadError::RosImage { source, .. }) = &error
            && let ReadError::Missing { path } = &**source
        {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let text = format!(
                "{}: the picture that the key `image` names is missing: give it as files['{name}']",
                self.name
            );
            return coded(ErrorCode::FileMissing, &text);
        }
        raised(error)
    }
}

/// The options for reading a map file.
fn map_options(given: &JsValue) -> Result<MapOptions, JsValue> {
    let mut options = MapOptions::default();
    let (mut free, mut blocked) = (None, None);
    for (key, value) in entries("options", given)? {
        match key.as_str() {
            "threshold" | "invert" | "unknown" | "ros" | "free" | "blocked" if value.is_undefined() => {}
            "threshold" => {
                options.threshold = Fraction::try_from(number(&key, &value)?)
                    .map_err(|wrong| argument(&key, &wrong.to_string()))?;
            }
            "invert" => options.invert = flag(&key, &value)?,
            "unknown" => {
                options.unknown = word(&key, &value)?;
            }
            "ros" => {
                options.ros = match value.as_f64() {
                    Some(1.0) => RosVersion::Ros1,
                    Some(2.0) => RosVersion::Ros2,
                    _ => return Err(argument(&key, "expected 1 or 2")),
                };
            }
            "free" => free = Some(text(&key, TILES, &value)?),
            "blocked" => blocked = Some(text(&key, TILES, &value)?),
            _ => {
                let known = "threshold, invert, unknown, ros, free, blocked";
                return Err(unknown_key("options", &key, known));
            }
        }
    }
    options.tiles = tiles(free.as_deref(), blocked.as_deref())?;
    Ok(options)
}
