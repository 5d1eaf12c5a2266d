//! Fields from their sources, where a way and the one back cost different times.

#[cfg(feature = "walking")]
use std::sync::Arc;

#[cfg(feature = "walking")]
use mediant_costs::{CostFieldQuery, Heading, WalkingField, WalkingGraph};
use mediant_grid::{Interrupt, Point, Vertex};
use mediant_search::{FieldQuery, Path};

use super::{Field, Sources};
#[cfg(feature = "walking")]
use super::{Inner, sources::vertices};
#[cfg(feature = "walking")]
use crate::memory_check;
use crate::{error::Error, never::NEVER, space::Space, within::Within};

impl Space {
    /// The cost from the nearest source to every vertex: [`field`](Self::field) has that from every vertex to
    /// it. They differ in a space to [walk on](crate::Map::walking), where [`Field::path_to`] has the paths
    /// of this one; everywhere else they are the same.
    ///
    /// # Errors
    /// As for [`field`](Self::field).
    pub fn field_from<P: Into<Point>>(&self, sources: impl IntoIterator<Item = P>) -> Result<Field, Error> {
        self.field_from_within(sources, f64::INFINITY)
    }

    /// [`field_from`](Self::field_from) with those vertices alone that cost at most `limit`: what can be
    /// reached, say, in 3,600 seconds.
    ///
    /// # Errors
    /// As for [`field_within`](Self::field_within).
    pub fn field_from_within<P: Into<Point>>(
        &self,
        sources: impl IntoIterator<Item = P>,
        limit: f64,
    ) -> Result<Field, Error> {
        self.field_from_by(Sources::of(sources).query().within(limit), &NEVER)
    }

    pub(crate) fn field_from_of(
        &self,
        sources: &[Vertex],
        limit: f64,
        interrupt: &Interrupt,
    ) -> Result<Field, Error> {
        self.field_from_by(FieldQuery::new(sources).within(limit), interrupt)
    }

    fn field_from_by(&self, query: FieldQuery<'_>, interrupt: &Interrupt) -> Result<Field, Error> {
        #[cfg(feature = "walking")]
        if let Some(walk) = self.walk() {
            return over_elevation(&walk.graph, Heading::FromSources, query, interrupt);
        }
        self.field_of(query, interrupt)
    }
}

impl Within<'_, Space> {
    /// [`Space::field_from`].
    ///
    /// # Errors
    /// As for [`Space::field_from`], and [`Error::Stopped`].
    pub fn field_from<P: Into<Point>>(&self, sources: impl IntoIterator<Item = P>) -> Result<Field, Error> {
        self.field_from_within(sources, f64::INFINITY)
    }

    /// [`Space::field_from_within`].
    ///
    /// # Errors
    /// As for [`Space::field_from_within`], and [`Error::Stopped`].
    pub fn field_from_within<P: Into<Point>>(
        &self,
        sources: impl IntoIterator<Item = P>,
        limit: f64,
    ) -> Result<Field, Error> {
        self.of.field_from_by(Sources::of(sources).query().within(limit), self.limits.interrupt())
    }
}

impl Field {
    /// The shortest path from the nearest source to a vertex: [`path_from`](Self::path_from) the other way.
    /// In a space to walk on, a field [from its sources](Space::field_from) has these paths alone, and one to
    /// them has the others; `None` in the other one, and where there is no distance.
    #[must_use]
    pub fn path_to(&self, at: impl Into<Point>) -> Option<Path> {
        let at = at.into();
        #[cfg(feature = "walking")]
        if let Inner::Walking(field) = &self.inner {
            return along(field, Heading::FromSources, at.vertex()?);
        }
        self.path_from(at).map(|path| path.reversed())
    }
}

/// A field over elevation. With one source that is the nearest to all; of several it is written down.
#[cfg(feature = "walking")]
pub(super) fn over_elevation(
    graph: &Arc<WalkingGraph>,
    heading: Heading,
    query: FieldQuery<'_>,
    interrupt: &Interrupt,
) -> Result<Field, Error> {
    let sources = vertices(&query)?;
    let has_several = sources.len() > 1;
    let query = CostFieldQuery::new(sources).within(query.limit);
    let query = if has_several { query.with_allocation() } else { query };
    memory_check::check("the field", WalkingField::bytes(graph, has_several) as u64)?;
    let field = WalkingField::new(Arc::clone(graph), heading, query, interrupt)?;
    Ok(Field { inner: Inner::Walking(field) })
}

/// The same field in another space.
#[cfg(feature = "walking")]
pub(super) fn again(field: &WalkingField, after: &Space, interrupt: &Interrupt) -> Result<Field, Error> {
    let CostFieldQuery { sources, limit, .. } = field.query();
    match field.heading() {
        Heading::FromSources => after.field_from_of(sources, limit, interrupt),
        Heading::ToSources => after.field_of(FieldQuery::new(sources).within(limit), interrupt),
    }
}

/// The path of a field between a vertex and its source, if it has this heading.
#[cfg(feature = "walking")]
pub(super) fn along(field: &WalkingField, heading: Heading, at: Vertex) -> Option<Path> {
    if field.heading() == heading { field.path(at) } else { None }
}

/// The source that is nearest to a vertex.
#[cfg(feature = "walking")]
pub(super) fn nearest_source(field: &WalkingField, at: Vertex) -> Option<Vertex> {
    match field.sources() {
        &[only] => field.cost(at).map(|_| only),
        sources => sources.get(field.allocation(at)? as usize).copied(),
    }
}
