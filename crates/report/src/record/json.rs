//! Records as JSON.

use super::{document::Record, error::RecordError};

impl Record {
    /// Parses the JSON of a record, and [checks](Self::check) it.
    ///
    /// # Errors
    /// [`RecordError`] says what is wrong with the text.
    pub fn parse(text: &str) -> Result<Self, RecordError> {
        let record: Self = serde_json::from_str(text)?;
        record.check()?;
        Ok(record)
    }

    /// The record as JSON, with one row a line, so that a changed number is one changed line.
    #[must_use]
    pub fn json(&self) -> String {
        // Serialization cannot fail: the values are texts, finite numbers, lists, and maps whose keys are
        // texts.
        let text = |value: serde_json::Result<String>| value.unwrap_or_default();
        let lines = |rows: Vec<String>| {
            if rows.is_empty() { "[]".to_owned() } else { format!("[\n    {}\n  ]", rows.join(",\n    ")) }
        };
        format!(
            "{{\n  \"id\": {},\n  \"title\": {},\n  \"provenance\": {},\n  \
             \"columns\": {},\n  \"rows\": {}\n}}\n",
            text(serde_json::to_string(&self.id)),
            text(serde_json::to_string(&self.title)),
            text(serde_json::to_string(&self.provenance)),
            lines(self.columns.iter().map(|column| text(serde_json::to_string(column))).collect()),
            lines(self.rows.iter().map(|row| text(serde_json::to_string(row))).collect()),
        )
    }
}
