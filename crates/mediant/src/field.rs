//! Distance fields in a space.

mod between_centers;
#[cfg(feature = "costs")]
mod costs;
mod heading;
mod rows;
mod sources;

use std::{fmt, num::NonZeroUsize, sync::Arc};

#[cfg(feature = "costs")]
use mediant_costs::{CostField, CostGraph};
#[cfg(feature = "walking")]
use mediant_costs::{Heading, WalkingField, WalkingGraph};
use mediant_grid::{
    Centers, Change as GridChange, Corners, FreeSpace, GridGraph, Identity, Interrupt, MapId, Mismatch,
    Point, Vertex,
};
use mediant_moves::FiniteK;
use mediant_search::{
    self as search, AnyAngleField, AnyAngleFields, FieldError, FieldQuery, Path, QueryError,
};

use self::between_centers::{CenterField, CenterFields};
pub(crate) use self::sources::Sources;
use crate::{
    change::Change,
    error::Error,
    never::NEVER,
    setup_error::SetupError,
    shared_rules::{Shared, pruning},
    space::{Layers, Placed, Space},
};

/// The distance of every vertex to the nearest of one or many sources, with the paths and directions out of
/// it: one goal for many agents, or what lies within reach. Over N(k) for every finite k, and exactly at any
/// angle. Where cells have [costs](crate::Map::costs) it has costs in place of distances: a cost distance, or
/// accumulated cost surface.
///
/// **Points.** At any angle a source may be any [point](Point) of the free space, as a start or goal of a
/// [`Query`](crate::Query) may, and so may a place that is asked about. It is rounded to a multiple of 1/1024
/// of a cell. A field holds the distances of vertices, row by row; that of a point between them is found when
/// it is asked for, from all that the point sees.
///
/// ```
/// use mediant::{DiagonalGap, K, Map, Motion};
///
/// let space = Map::from_rows(["....", ".##.", "...."])?.space(Motion::centers(K::N8))?;
/// let field = space.field([(0, 0), (3, 2)])?;
/// assert_eq!((field.get((3, 0)), field.get((1, 1))), (Some(2.0), None));
/// assert_eq!(field.next((3, 0)), Some((3, 1).into()));
/// assert_eq!(field.path_from((3, 0)).map(|path| path.cost()), Some(2.0));
///
/// let any = Map::from_rows(["....", ".##.", "...."])?.space(Motion::new(K::ANY, DiagonalGap::Open))?;
/// let field = any.field([(0.5, 1.5)])?;
/// assert_eq!((field.get((0.5, 2.5)), field.next((1, 1))), (Some(1.0), Some((0.5, 1.5).into())));
/// # Ok::<(), mediant::Error>(())
/// ```
pub struct Field {
    inner: Inner,
}

enum Inner {
    Centers(search::Field<Arc<GridGraph<Centers>>>),
    Corners(search::Field<Arc<GridGraph<Corners>>>),
    AnyAngle(AnyAngleField<Arc<FreeSpace<Corners>>>),
    BetweenCenters(CenterField),
    #[cfg(feature = "costs")]
    Costs(CostField),
    #[cfg(feature = "walking")]
    Walking(WalkingField),
}

/// Makes one field after another in a space, on scratch memory of its own: make one for each thread.
pub struct Fields {
    inner: Makers,
    /// The interrupt of all its fields.
    interrupt: Interrupt,
}

enum Makers {
    Centers(search::Fields<Arc<GridGraph<Centers>>, Centers>),
    Corners(search::Fields<Arc<GridGraph<Corners>>, Corners>),
    AnyAngle(AnyAngleFields<Arc<FreeSpace<Corners>>>),
    BetweenCenters(Box<CenterFields>),
    #[cfg(feature = "costs")]
    Costs(Arc<CostGraph>, NonZeroUsize),
    #[cfg(feature = "walking")]
    Walking(Arc<WalkingGraph>),
}

impl Space {
    /// The distance of every vertex to the nearest source. At any angle sources may lie between vertices.
    ///
    /// # Errors
    /// As for [`Fields::field`].
    pub fn field<P: Into<Point>>(&self, sources: impl IntoIterator<Item = P>) -> Result<Field, Error> {
        self.fields()?.field(sources)
    }

    /// The distances of those vertices whose distance to the nearest source is at most `limit` cells (or
    /// costs): what an agent can reach, if it goes no further. A vertex at exactly that distance is within
    /// it: all limits leave room for the rounding of lengths, one part in 2³¹.
    ///
    /// # Errors
    /// As for [`Fields::field_within`].
    pub fn field_within<P: Into<Point>>(
        &self,
        sources: impl IntoIterator<Item = P>,
        limit: f64,
    ) -> Result<Field, Error> {
        self.fields()?.field_within(sources, limit)
    }

    /// A maker of fields in this space, which reuses its scratch memory.
    ///
    /// # Errors
    /// None that a space which exists can have.
    pub fn fields(&self) -> Result<Fields, Error> {
        self.fields_of(&NEVER)
    }

    pub(crate) fn field_of(&self, query: FieldQuery<'_>, interrupt: &Interrupt) -> Result<Field, Error> {
        self.fields_of(interrupt)?.make(query)
    }

    pub(crate) fn fields_of(&self, interrupt: &Interrupt) -> Result<Fields, Error> {
        Ok(Fields { inner: self.makers(interrupt)?, interrupt: interrupt.clone() })
    }

    fn makers(&self, interrupt: &Interrupt) -> Result<Makers, Error> {
        #[cfg(feature = "costs")]
        if let Some(surface) = self.surface() {
            return Ok(Makers::Costs(Arc::clone(&surface.graph), NonZeroUsize::MIN));
        }
        #[cfg(feature = "walking")]
        if let Some(walk) = self.walk() {
            return Ok(Makers::Walking(Arc::clone(&walk.graph)));
        }
        self.map().check_sides("a field without costs")?;
        Ok(match (self.placed(), self.motion().k.finite()) {
            (Placed::Centers(layers), Some(k)) => Makers::Centers(fields_over(layers, k, interrupt)?),
            (Placed::Corners(layers), Some(k)) => Makers::Corners(fields_over(layers, k, interrupt)?),
            (Placed::Corners(layers), None) if self.is_between_centers() => {
                Makers::BetweenCenters(Box::new(CenterFields::new(self, &layers.free, interrupt)?))
            }
            (Placed::Corners(layers), None) => {
                Makers::AnyAngle(AnyAngleFields::interruptible(Arc::clone(&layers.free), interrupt)?)
            }
            (Placed::Centers(_), None) => {
                return Err(SetupError::Motion { motion: self.motion() }.into());
            }
        })
    }
}

/// A maker of fields over N(k).
fn fields_over<P: Shared>(
    layers: &Layers<P>,
    k: FiniteK,
    interrupt: &Interrupt,
) -> Result<search::Fields<Arc<GridGraph<P>>, P>, Error> {
    let graph = layers.graph(k)?;
    let pruning = pruning(graph, interrupt)?;
    Ok(search::Fields::with_pruning_interruptible(Arc::clone(graph), pruning, interrupt)??)
}

impl Fields {
    /// The same fields, where cells have costs each by so many threads, which are there for as long as it
    /// takes; other fields, and those of several sources, are made on one. Two threads took 0.55 to
    /// 0.70 of the time of one (`docs/measurements/costs.md`).
    #[must_use]
    pub fn on_threads(self, threads: NonZeroUsize) -> Self {
        #[cfg(feature = "costs")]
        if let Makers::Costs(graph, _) = self.inner {
            return Self { inner: Makers::Costs(graph, threads), ..self };
        }
        let _ = threads;
        self
    }

    /// The distance of every vertex to the nearest source. Without a source it is empty.
    ///
    /// # Errors
    /// [`Error::Query`] for the first source that is blocked or outside the map, or lies between vertices
    /// where paths start at vertices: over N(k) and on costs; [`Error::OutOfMemory`] before a field of costs
    /// is made for which there is no room.
    pub fn field<P: Into<Point>>(&mut self, sources: impl IntoIterator<Item = P>) -> Result<Field, Error> {
        self.make(Sources::of(sources).query())
    }

    /// The distances of those vertices whose distance to the nearest source is at most `limit` cells.
    ///
    /// # Errors
    /// As for [`field`](Self::field), and [`Error::Query`] for a limit that is negative or not a number.
    pub fn field_within<P: Into<Point>>(
        &mut self,
        sources: impl IntoIterator<Item = P>,
        limit: f64,
    ) -> Result<Field, Error> {
        self.make(Sources::of(sources).query().within(limit))
    }

    fn make(&mut self, query: FieldQuery<'_>) -> Result<Field, Error> {
        let interrupt = &self.interrupt;
        let inner = match &mut self.inner {
            Makers::Centers(fields) => fields.field_interruptible(query, interrupt).map(Inner::Centers),
            Makers::Corners(fields) => fields.field_interruptible(query, interrupt).map(Inner::Corners),
            Makers::AnyAngle(fields) => fields.field_interruptible(query, interrupt).map(Inner::AnyAngle),
            Makers::BetweenCenters(fields) => fields.field(query, interrupt).map(Inner::BetweenCenters),
            #[cfg(feature = "costs")]
            Makers::Costs(graph, threads) => return costs::on_costs((graph, *threads), query, interrupt),
            #[cfg(feature = "walking")]
            Makers::Walking(graph) => {
                return heading::over_elevation(graph, Heading::ToSources, query, interrupt);
            }
        };
        Ok(Field { inner: inner.map_err(told)? })
    }
}

/// The error of a field as one of the library.
fn told(error: FieldError) -> Error {
    match error {
        FieldError::Query(error) => error.into(),
        FieldError::Mismatch(mismatch) => mismatch.into(),
        FieldError::Interrupted(interrupted) => interrupted.into(),
        _ => QueryError::CostLimit.into(),
    }
}

/// A field over N(k) after a change of its map; anew where there is no change of this map to repair it by, or
/// where that takes less work.
fn repaired_over<P: Shared>(
    field: &search::Field<Arc<GridGraph<P>>>,
    layers: &Layers<P>,
    (k, change): (FiniteK, Option<&GridChange>),
    interrupt: &Interrupt,
) -> Result<search::Field<Arc<GridGraph<P>>>, Error> {
    if let Some(change) = change {
        let repaired = field.repaired(Arc::clone(layers.graph(k)?), change, interrupt);
        if let Some(repaired) = repaired.map_err(told)? {
            return Ok(repaired);
        }
    }
    fields_over(layers, k, interrupt)?.again(field, interrupt).map_err(told)
}

/// The same expression for a field of each kind.
macro_rules! of_each {
    ($inner:expr, $field:ident => $value:expr) => {
        match $inner {
            Inner::Centers($field) => $value,
            Inner::Corners($field) => $value,
            Inner::AnyAngle($field) => $value,
            Inner::BetweenCenters($field) => $value,
            #[cfg(feature = "costs")]
            Inner::Costs($field) => $value,
            #[cfg(feature = "walking")]
            Inner::Walking($field) => $value,
        }
    };
}

impl Field {
    /// The field of the same sources and limit in the space after a change: the same as one made anew, to the
    /// last bit. Over N(k) the work follows the vertices whose distance, or cost, changes. Where these are
    /// many it is made anew, and so it is at any angle, unless no path in it comes near the change; where
    /// costs leave the [bounds](crate::Costs::bounds) of the map, or closed gaps come or go between cells of
    /// costs; and over elevation. This field stays as it is; the next repair takes its memory, if it is given
    /// up by then.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let space = Map::from_fn(40, 30, |x, y| x == 20 && y > 0)?.space(Motion::centers(3))?;
    /// let mut field = space.field([(0, 15)])?;
    /// // A door in the wall.
    /// let change = space.edit_cells([((20, 15), false)])?;
    /// field = field.repair(&change)?;
    /// assert_eq!(field.get((39, 15)), Some(39.0));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mismatch`] for a change of another map, of other rules or another k; [`Error::Query`] for the
    /// first source that is now blocked or outside the map.
    pub fn repair(&self, change: &Change) -> Result<Self, Error> {
        self.repaired(change, &NEVER)
    }

    pub(crate) fn repaired(&self, change: &Change, interrupt: &Interrupt) -> Result<Self, Error> {
        let (belongs_to, before, after) = (self.identity(), change.before().identity(), change.after());
        let (prepared, other) = ("the field", "the space before the change");
        let mismatch = Mismatch { prepared, belongs_to, other, other_belongs_to: before };
        if belongs_to != before {
            return Err(mismatch.into());
        }
        if change.before().has_costs() != after.has_costs() {
            let other = "the space after the change";
            return Err(Mismatch { other, other_belongs_to: after.identity(), ..mismatch }.into());
        }
        if !after.has_costs() {
            after.map().check_sides("a field without costs")?;
        }
        let is_of_the_same_size = before.map.map(MapId::size) == after.identity().map.map(MapId::size);
        let cells = is_of_the_same_size.then(|| change.of_grid());
        let inner = match (&self.inner, after.placed(), after.motion().k.finite()) {
            #[cfg(feature = "costs")]
            (Inner::Costs(field), ..) => return costs::repaired(field, change, interrupt),
            #[cfg(feature = "walking")]
            (Inner::Walking(field), ..) => return heading::again(field, after, interrupt),
            (Inner::Centers(field), Placed::Centers(layers), Some(k)) => {
                Inner::Centers(repaired_over(field, layers, (k, cells), interrupt)?)
            }
            (Inner::Corners(field), Placed::Corners(layers), Some(k)) => {
                Inner::Corners(repaired_over(field, layers, (k, cells), interrupt)?)
            }
            (Inner::BetweenCenters(field), ..) => {
                let query = FieldQuery::from_points(field.sources()).within(field.limit());
                return after.fields_of(interrupt)?.make(query);
            }
            (Inner::AnyAngle(field), Placed::Corners(layers), None) => {
                let kept = cells.map(|change| field.repaired(Arc::clone(&layers.free), change));
                match kept.transpose().map_err(told)?.flatten() {
                    Some(field) => Inner::AnyAngle(field),
                    None => return after.fields_of(interrupt)?.make(field.query()),
                }
            }
            // Placement and k are those of the identity.
            _ => return Err(mismatch.into()),
        };
        Ok(Self { inner })
    }

    /// The distance of a vertex to the nearest source, in cells; `None` if no path leads to one, if it is
    /// beyond the limit, or if the vertex is blocked or outside the map. Over N(k) it is the number that
    /// [`Planner::distance`](crate::Planner::distance) finds. Where cells have costs it is the least cost. At
    /// any angle a point between vertices has a distance, too; elsewhere it has none.
    #[must_use]
    pub fn get(&self, at: impl Into<Point>) -> Option<f64> {
        let at = at.into();
        match &self.inner {
            Inner::Centers(field) => field.get(at.vertex()?).map(|cost| cost.to_f64()),
            Inner::Corners(field) => field.get(at.vertex()?).map(|cost| cost.to_f64()),
            Inner::AnyAngle(field) => field.get(at),
            Inner::BetweenCenters(field) => field.get(at),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.get(at.vertex()?),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => field.get(at.vertex()?),
        }
    }

    /// The vertices that have a distance, row by row.
    #[must_use]
    pub fn iter(&self) -> Box<dyn Iterator<Item = (Vertex, f64)> + '_> {
        match &self.inner {
            Inner::Centers(field) => Box::new(field.iter().map(|(at, cost)| (at, cost.to_f64()))),
            Inner::Corners(field) => Box::new(field.iter().map(|(at, cost)| (at, cost.to_f64()))),
            Inner::AnyAngle(field) => Box::new(field.iter()),
            Inner::BetweenCenters(field) => Box::new(field.iter()),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => Box::new(field.iter()),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => Box::new(field.iter()),
        }
    }

    /// The distances of all vertices, row by row: [`width`](Self::width) × [`height`](Self::height) numbers,
    /// infinite where there is none.
    #[must_use]
    pub fn lengths(&self) -> Vec<f64> {
        match &self.inner {
            Inner::Centers(field) => field.lengths().collect(),
            Inner::Corners(field) => field.lengths().collect(),
            Inner::AnyAngle(field) => field.lengths().to_vec(),
            Inner::BetweenCenters(field) => field.lengths().collect(),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.rows().collect(),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => field.rows().collect(),
        }
    }

    /// The vertex to which the shortest path to the nearest source leads next: one move away; at any angle
    /// the next corner of an obstacle on it, or the source. There it mostly bends, but it may go straight on,
    /// where its line only touches the corner ([`path_from`](Self::path_from) has waypoints at bends alone).
    /// `None` at a source, and where there is no distance. It is a vertex, unless it is a source between
    /// vertices.
    #[must_use]
    pub fn next(&self, at: impl Into<Point>) -> Option<Point> {
        let at = at.into();
        match &self.inner {
            Inner::Centers(field) => field.next(at.vertex()?).map(Point::from),
            Inner::Corners(field) => field.next(at.vertex()?).map(Point::from),
            Inner::AnyAngle(field) => field.next(at),
            Inner::BetweenCenters(field) => field.next(at),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.next(at.vertex()?).map(Point::from),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => field.next(at.vertex()?).map(Point::from),
        }
    }

    /// The direction in which that path leaves a vertex, as a vector of length 1, x to the right and y down.
    #[must_use]
    pub fn direction(&self, at: impl Into<Point>) -> Option<(f64, f64)> {
        let at = at.into();
        let next = self.next(at)?;
        let ((x, y), (to_x, to_y)) = (at.parts(), next.parts());
        let (dx, dy) = ((to_x - x) as f64, (to_y - y) as f64);
        let length = (dx * dx + dy * dy).sqrt();
        Some((dx / length, dy / length))
    }

    /// The shortest path from a vertex to the nearest source; `None` where there is no distance. A field over
    /// elevation that leads [from its sources](Space::field_from) has [`path_to`](Self::path_to) instead.
    #[must_use]
    pub fn path_from(&self, at: impl Into<Point>) -> Option<Path> {
        let at = at.into();
        match &self.inner {
            Inner::Centers(field) => field.path_from(at.vertex()?),
            Inner::Corners(field) => field.path_from(at.vertex()?),
            Inner::AnyAngle(field) => field.path_from(at),
            Inner::BetweenCenters(field) => field.path_from(at),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.path_from(at.vertex()?),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => heading::along(field, Heading::ToSources, at.vertex()?),
        }
    }

    /// The source to which that path leads. Where cells have costs it is, of several that are equally near,
    /// the first one in the list; the path may lead to another one.
    #[must_use]
    pub fn nearest_source(&self, at: impl Into<Point>) -> Option<Point> {
        let at = at.into();
        match &self.inner {
            Inner::Centers(field) => field.nearest_source(at.vertex()?).map(Point::from),
            Inner::Corners(field) => field.nearest_source(at.vertex()?).map(Point::from),
            Inner::AnyAngle(field) => field.nearest_source(at),
            Inner::BetweenCenters(field) => field.nearest_source(at),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => match (field.sources(), at.vertex()?) {
                ([only], at) => field.cost(at).map(|_| only.into()),
                (sources, at) => sources.get(field.allocation(at)? as usize).map(Point::from),
            },
            #[cfg(feature = "walking")]
            Inner::Walking(field) => heading::nearest_source(field, at.vertex()?).map(Point::from),
        }
    }

    /// The number of vertices in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        of_each!(&self.inner, field => field.width())
    }

    /// The number of rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        of_each!(&self.inner, field => field.height())
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        of_each!(&self.inner, field => field.identity())
    }
}

impl fmt::Debug for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Field").field("identity", &self.identity()).finish_non_exhaustive()
    }
}

impl fmt::Debug for Fields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let identity = match &self.inner {
            Makers::Centers(fields) => fields.identity(),
            Makers::Corners(fields) => fields.identity(),
            Makers::AnyAngle(fields) => fields.identity(),
            Makers::BetweenCenters(fields) => fields.identity(),
            #[cfg(feature = "costs")]
            Makers::Costs(graph, _) => graph.identity(),
            #[cfg(feature = "walking")]
            Makers::Walking(graph) => graph.identity(),
        };
        f.debug_struct("Fields").field("identity", &identity).finish_non_exhaustive()
    }
}
