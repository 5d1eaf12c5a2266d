//! Makes the text of a scenario.

use mediant_grid::Vertex;

use super::{
    error::ScenarioError,
    instance::{Instance, LENGTHS, MAP_NAMES, is_length, is_map_name},
};

/// The text of a scenario of these queries: version 1, fields separated by tabs.
pub(super) fn text(instances: &[Instance]) -> Result<String, ScenarioError> {
    let mut text = "version 1\n".to_owned();
    for (index, instance) in instances.iter().enumerate() {
        let Instance { bucket, map, width, height, start, goal, optimal } = instance;
        if !is_map_name(map) {
            let found = format!("{map:?}");
            return Err(ScenarioError::Unwritable { index, field: "map", expected: MAP_NAMES, found });
        }
        if !is_length(*optimal) {
            let (field, found) = ("optimal length", optimal.to_string());
            return Err(ScenarioError::Unwritable { index, field, expected: LENGTHS, found });
        }
        let Vertex { x: start_x, y: start_y } = start;
        let Vertex { x: goal_x, y: goal_y } = goal;
        text += &format!(
            "{bucket}\t{map}\t{width}\t{height}\t{start_x}\t{start_y}\t{goal_x}\t{goal_y}\t{optimal}\n"
        );
    }
    Ok(text)
}
