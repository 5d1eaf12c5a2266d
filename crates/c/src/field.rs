//! Distance fields.

#![allow(unsafe_code, reason = "functions of C")]

use std::sync::Arc;

use library::{Change, Field, Space, Vertex};

use crate::{
    answer,
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    memory,
    points::{self, Point},
    space::SpaceHandle,
    watch::{Watch, Watcher},
    words,
};

/// The distance of every vertex to the nearest source. It never changes; any number of threads may use it.
/// `{0}` is no field.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FieldHandle {
    /// Its number.
    pub id: u64,
}

/// A field, and the space that it is of.
pub(crate) struct OfSpace {
    field: Field,
    space: Space,
}

impl Held for OfSpace {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<OfSpace>> = Table::new(Kind::Field);
        &HANDLES
    }
}

impl FieldHandle {
    /// Keeps a field, and writes its handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    unsafe fn put(field: OfSpace, place: *mut Self) -> Result<(), Failure> {
        memory::check_place("field", place)?;
        let id = OfSpace::handles().share(field)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("field", place, Self { id }) }
    }
}

/// The distances of all vertices to the nearest source, up to `limit` cells (or costs); infinity is none.
///
/// # Safety
/// `sources` leads to `count` points; `watcher` is null or leads to one; `field` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_new(
    space: SpaceHandle,
    sources: *const Point,
    count: usize,
    limit: f64,
    watcher: *const Watcher,
    field: *mut FieldHandle,
) -> Code {
    call(|| {
        memory::check_place("field", field)?;
        let space = Space::handles().get(space.id)?;
        // SAFETY: the caller promises it.
        let (sources, watch) = unsafe { (points::read("sources", sources, count)?, Watch::read(watcher)?) };
        let made = space.within(words::limits(&watch)).field_within(sources, limit);
        let made = made.map_err(|error| watch.failure(error).of_sources())?;
        // SAFETY: as above.
        unsafe { FieldHandle::put(OfSpace { field: made, space: Space::clone(&space) }, field) }
    })
}

/// Frees a field.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_field_free(field: FieldHandle) -> Code {
    call(|| OfSpace::handles().free(field.id))
}

/// The field of the same sources on a changed map of the same motion, by work that follows the vertices whose
/// distances change, where that can be.
///
/// # Safety
/// `repaired` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_repair(
    field: FieldHandle,
    space: SpaceHandle,
    repaired: *mut FieldHandle,
) -> Code {
    call(|| {
        let (field, space) = (OfSpace::handles().get(field.id)?, Space::handles().get(space.id)?);
        let change = Change::between(&field.space, &space)?;
        let made = OfSpace { field: field.field.repair(&change)?, space: Space::clone(&space) };
        // SAFETY: the caller promises it.
        unsafe { FieldHandle::put(made, repaired) }
    })
}

/// The numbers of vertices in a row, and of rows.
///
/// # Safety
/// Both lead to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_size(field: FieldHandle, width: *mut u32, height: *mut u32) -> Code {
    call(|| {
        memory::check_place("height", height)?;
        let field = OfSpace::handles().get(field.id)?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("width", width, field.field.width())?;
            memory::put("height", height, field.field.height())
        }
    })
}

/// Writes the distances of all vertices, row by row, as many as there is room for; infinity where no path
/// leads.
///
/// # Safety
/// `distances` leads to memory for `room` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_distances(
    field: FieldHandle,
    distances: *mut f64,
    room: usize,
) -> Code {
    call(|| {
        let field = OfSpace::handles().get(field.id)?;
        // SAFETY: the caller promises it.
        unsafe { memory::fill("distances", distances, room, field.field.lengths()) }
    })
}

/// Writes the directions in which the shortest paths leave the vertices, row by row: dx, dy, of length 1
/// together; 0, 0 at sources and where no path leads. As many numbers as there is room for.
///
/// # Safety
/// `flow` leads to memory for `room` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_flow(field: FieldHandle, flow: *mut f32, room: usize) -> Code {
    call(|| {
        let field = OfSpace::handles().get(field.id)?;
        let (width, height) = (field.field.width() as i32, field.field.height() as i32);
        let vertices = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        let both = vertices.flat_map(|at| {
            let (dx, dy) = field.field.direction(at).unwrap_or((0.0, 0.0));
            [dx as f32, dy as f32]
        });
        // SAFETY: the caller promises it.
        unsafe { memory::fill("flow", flow, room, both) }
    })
}

/// The distance of a point; infinity where no path leads. Threads that ask one field wait for one another, a
/// tenth of a microsecond each time: for many vertices `mediant_field_distances` has them all.
///
/// # Safety
/// `distance` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_get(field: FieldHandle, at: Point, distance: *mut f64) -> Code {
    call(|| {
        let known = OfSpace::handles().get(field.id)?.field.get(at.inner("at")?);
        // SAFETY: the caller promises it.
        unsafe { memory::put("distance", distance, known.unwrap_or(f64::INFINITY)) }
    })
}

/// The direction in which the shortest path leaves a point; 0, 0 at a source and where no path leads.
///
/// # Safety
/// `direction` leads to memory for a point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_direction(
    field: FieldHandle,
    at: Point,
    direction: *mut Point,
) -> Code {
    call(|| {
        let known = OfSpace::handles().get(field.id)?.field.direction(at.inner("at")?);
        let (x, y) = known.unwrap_or((0.0, 0.0));
        // SAFETY: the caller promises it.
        unsafe { memory::put("direction", direction, Point { x, y }) }
    })
}

/// The vertex to which the shortest path leads next, and whether there is one: 1, or 0 at a source and where
/// no path leads.
///
/// # Safety
/// `next` leads to memory for a point, `there` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_next(
    field: FieldHandle,
    at: Point,
    next: *mut Point,
    there: *mut i32,
) -> Code {
    call(|| {
        let known = OfSpace::handles().get(field.id)?.field.next(at.inner("at")?);
        // SAFETY: the caller promises it.
        unsafe { put_some(("next", next), known, there) }
    })
}

/// The source that is nearest to a point, and whether there is one: 1, or 0 where no path leads.
///
/// # Safety
/// `source` leads to memory for a point, `there` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_nearest_source(
    field: FieldHandle,
    at: Point,
    source: *mut Point,
    there: *mut i32,
) -> Code {
    call(|| {
        let known = OfSpace::handles().get(field.id)?.field.nearest_source(at.inner("at")?);
        // SAFETY: the caller promises it.
        unsafe { put_some(("source", source), known, there) }
    })
}

/// Writes a point, if there is one, and whether there is.
///
/// # Safety
/// As for [`memory::put`].
unsafe fn put_some(
    (name, place): (&str, *mut Point),
    point: Option<library::Point>,
    there: *mut i32,
) -> Result<(), Failure> {
    memory::check_place("there", there)?;
    memory::check_place(name, place)?;
    // SAFETY: the caller promises it.
    unsafe {
        if let Some(point) = point {
            memory::put(name, place, point.into())?;
        }
        memory::put("there", there, i32::from(point.is_some()))
    }
}

/// The shortest path from a point to the nearest source: its points, as many as there is room for, and how
/// many there are; 0 where none leads.
///
/// # Safety
/// `points` leads to memory for `room` points; `count` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_field_path_from(
    field: FieldHandle,
    at: Point,
    points: *mut Point,
    room: usize,
    count: *mut usize,
) -> Code {
    call(|| {
        answer::check_places(points, room, count)?;
        let path = OfSpace::handles().get(field.id)?.field.path_from(at.inner("at")?);
        // SAFETY: the caller promises it.
        unsafe { answer::write(path.as_ref(), (points, room), count) }
    })
}
