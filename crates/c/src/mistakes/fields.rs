//! Calls of fields.

use library::PlacementKind;

use super::{
    ask,
    draw::untouched,
    model::{End, FieldModel, inner_of, is_near, length},
    world::World,
};
use crate::{
    code::Code,
    field::{
        FieldHandle, mediant_field_direction, mediant_field_distances, mediant_field_flow, mediant_field_get,
        mediant_field_nearest_source, mediant_field_new, mediant_field_next, mediant_field_path_from,
        mediant_field_repair, mediant_field_size,
    },
    points::Point,
    space::SpaceHandle,
};

impl FieldModel {
    /// The distance of a point; infinity beyond the limit. None where rounding decides.
    fn distance(&self, at: Point) -> Option<f64> {
        let costs = self.sources.iter().filter_map(|&source| self.space.cost(source, at));
        let least = costs.fold(f64::INFINITY, f64::min);
        if least.is_finite() && is_near(least, self.limit) {
            return None;
        }
        Some(if least > self.limit { f64::INFINITY } else { least })
    }

    fn size(&self) -> (u32, u32) {
        let extra = u32::from(self.space.motion.rules.placement() == PlacementKind::Corner);
        (self.space.map.size.0 + extra, self.space.map.size.1 + extra)
    }

    fn check(&self, at: Point, found: f64) {
        if let Some(expected) = self.distance(at) {
            let case =
                || format!("{at:?} from {:?} in {}\n{:?}", self.sources, self.space.motion, self.space.map);
            assert!(is_near(found, expected), "{found}, not {expected}, within {}: {}", self.limit, case());
        }
    }
}

/// Any call of a field.
pub(super) fn any(world: &mut World) {
    match world.rng.below(8) {
        _ if world.fields.is_empty() => make(world),
        0 if world.fields.len() < 6 => make(world),
        1 => repair(world),
        2 => whole(world),
        _ => at_a_point(world),
    }
}

fn make(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let sources = world.ends(space.as_deref(), End::Start);
    let limit = [f64::INFINITY, f64::INFINITY, 3.0, 0.0, 5.3, -1.0, f64::NAN][world.rng.below(7) as usize];
    if limit.is_nan() || limit < 0.0 {
        world.wrong(Code::Number);
    }
    if sources.is_empty() {
        world.maybe(&[Code::NoEnd]);
    }
    if space.as_ref().is_some_and(|space| space.map.costs.is_some()) {
        world.maybe(&[Code::Motion, Code::EngineK, Code::EngineRules, Code::EngineWithout]);
    }
    let (array, watcher, place) = (world.values(&sources), world.watcher(0), world.place());
    let code =
        ask!(mediant_field_new(SpaceHandle { id }, array.at, array.count, limit, watcher.at, place.at));
    watcher.caller.check();
    if world.ended("field_new", code) {
        let model = FieldModel { space: space.expect("right"), sources, limit };
        world.fields.add(place.values()[0].id, model);
    }
}

fn repair(world: &mut World) {
    let (id, field) = world.handle(|world| &world.fields);
    let (other, space) = world.handle(|world| &world.spaces);
    let place = world.place();
    if let (Some(field), Some(space)) = (&field, &space) {
        let was = &field.space;
        if was.motion != space.motion {
            world.wrong(Code::Mismatch);
        }
        if was.map.costs.is_some() != space.map.costs.is_some() {
            world.maybe(&[Code::Mismatch, Code::EngineWithout, Code::Cost]);
        }
        for &source in &field.sources {
            world.note_end(Some(space), source, End::Start);
        }
    }
    let code = ask!(mediant_field_repair(FieldHandle { id }, SpaceHandle { id: other }, place.at));
    if world.ended("field_repair", code) {
        let (field, space) = (field.expect("right"), space.expect("right"));
        let model = FieldModel { space, sources: field.sources.clone(), limit: field.limit };
        world.fields.add(place.values()[0].id, model);
    }
}

fn whole(world: &mut World) {
    let (id, field) = world.handle(|world| &world.fields);
    let handle = FieldHandle { id };
    let (width, height) = (world.place::<u32>(), world.place::<u32>());
    let code = ask!(mediant_field_size(handle, width.at, height.at));
    if world.ended("field_size", code) {
        assert_eq!(field.as_ref().map(|field| field.size()), Some((width.values()[0], height.values()[0])));
    }
    let (id, field) = world.handle(|world| &world.fields);
    let (handle, (columns, rows)) = (FieldHandle { id }, field.as_ref().map_or((2, 2), |field| field.size()));
    let count = (columns * rows) as usize;
    if world.rng.chance(50) {
        let flow = world.room::<f32>(2 * count);
        let code = ask!(mediant_field_flow(handle, flow.at, flow.count));
        if world.ended("field_flow", code) {
            let is_unit = |pair: &[f32]| {
                pair[0] == 0.0 && pair[1] == 0.0 || (pair[0].hypot(pair[1]) - 1.0).abs() < 1e-6
            };
            assert!(flow.values()[..flow.count.min(2 * count) / 2 * 2].chunks(2).all(is_unit), "a flow");
        }
        return;
    }
    let distances = world.room::<f64>(count);
    let code = ask!(mediant_field_distances(handle, distances.at, distances.count));
    if world.ended("field_distances", code) {
        let (found, field) = (distances.values(), field.expect("right"));
        assert!(
            found.iter().skip(count).all(|value| value.to_bits() == untouched::<u64>()),
            "beyond the vertices"
        );
        // At any angle the reference takes long.
        let every = if field.space.finite().is_some() { 1 } else { 7 };
        for (at, &found) in found.iter().take(count).enumerate().step_by(every) {
            let (x, y) = (at as u32 % columns, at as u32 / columns);
            field.check(Point { x: x.into(), y: y.into() }, found);
        }
    }
}

fn at_a_point(world: &mut World) {
    let (id, field) = world.handle(|world| &world.fields);
    let space = field.as_ref().map(|field| field.space.clone());
    let (handle, at) = (FieldHandle { id }, world.end(space.as_deref(), End::Other));
    let is_number = || library::Point::nearest(at.x, at.y).is_some();
    match world.rng.below(4) {
        0 => {
            let place = world.place::<f64>();
            let code = ask!(mediant_field_get(handle, at, place.at));
            if world.ended("field_get", code) {
                field.expect("right").check(at, place.values()[0]);
            }
        }
        1 => {
            let place = world.place::<Point>();
            let code = ask!(mediant_field_direction(handle, at, place.at));
            if world.ended("field_direction", code) {
                let Point { x, y } = place.values()[0];
                assert!((x, y) == (0.0, 0.0) || is_near(x.hypot(y), 1.0), "a direction {x}, {y}");
            }
        }
        2 => {
            let (place, there) = (world.place::<Point>(), world.place::<i32>());
            let (name, code) = if world.rng.chance(50) {
                ("field_next", ask!(mediant_field_next(handle, at, place.at, there.at)))
            } else {
                ("field_nearest_source", ask!(mediant_field_nearest_source(handle, at, place.at, there.at)))
            };
            if world.ended(name, code) {
                let (field, is_there) = (field.expect("right"), there.values()[0] == 1);
                if let (Some(distance), "field_nearest_source") = (field.distance(at), name) {
                    assert_eq!(is_there, distance.is_finite(), "{name}");
                }
                assert!(is_there || place.is_untouched(), "{name}: written, and not there");
                if is_there && name == "field_nearest_source" {
                    let source = place.values()[0];
                    let cost = field.space.cost(source, at).unwrap_or(f64::INFINITY);
                    field.check(at, cost);
                }
            }
        }
        _ => {
            let (points, count) = (world.room::<Point>(40), world.place::<usize>());
            let code = ask!(mediant_field_path_from(handle, at, points.at, points.count, count.at));
            if world.ended("field_path_from", code) {
                let (field, count) = (field.expect("right"), count.values()[0]);
                let found: Vec<Point> = points.values().into_iter().take(count).collect();
                if let Some(distance) = field.distance(at) {
                    assert_eq!(count > 0, distance.is_finite(), "field_path_from");
                }
                if count > 0 && found.len() == count {
                    assert!(is_number() && inner_of(found[0]) == inner_of(at), "{found:?} from {at:?}");
                    let ends = (found[0], found[count - 1]);
                    field.space.check(&found, ends, length(&found), field.space.map.costs.is_none());
                    if field.space.map.costs.is_none() {
                        field.check(at, length(&found));
                    }
                }
            }
        }
    }
}
