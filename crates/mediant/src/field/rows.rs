//! Fields as rows of numbers, for rasters.

use std::collections::HashMap;

#[cfg(feature = "costs")]
use mediant_costs::DirectionCode;
#[cfg(feature = "costs")]
use mediant_grid::Vector;
use mediant_grid::{Point, Vertex};

#[cfg(feature = "costs")]
use super::costs;
use super::{Field, Inner};
use crate::error::Error;

/// A vector in the direction of a point between vertices, in halves of its parts: longer than each move.
#[cfg(feature = "costs")]
fn halves(from: Vertex, to: Point) -> Vector {
    let ((from_x, from_y), (to_x, to_y)) = (Point::from(from).parts(), to.parts());
    let halves = |from: i64, to: i64| 2 * (to - from) as i32;
    Vector::new(halves(from_x, to_x), halves(from_y, to_y))
}

/// The number of a vertex whose source is not known yet.
const UNKNOWN: u32 = u32::MAX;

impl Field {
    /// The sources, in the order in which they were given.
    #[must_use]
    pub fn sources(&self) -> Vec<Point> {
        match &self.inner {
            Inner::Centers(field) => field.query().all_sources().collect(),
            Inner::Corners(field) => field.query().all_sources().collect(),
            Inner::AnyAngle(field) => field.query().all_sources().collect(),
            Inner::BetweenCenters(field) => field.sources().to_vec(),
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.query().sources.iter().map(Point::from).collect(),
            #[cfg(feature = "walking")]
            Inner::Walking(field) => field.query().sources.iter().map(Point::from).collect(),
        }
    }

    /// [`lengths`](Self::lengths) of a field that is not needed any more. Where cells have costs no second
    /// array is made: the field's own memory is put in order.
    #[must_use]
    pub fn into_lengths(self) -> Vec<f64> {
        match self.inner {
            #[cfg(feature = "costs")]
            Inner::Costs(field) => field.into_rows(),
            inner => Self { inner }.lengths(),
        }
    }

    /// For each vertex, row by row, the sum of its distances in two fields: the length, or the cost, of the
    /// best path from a source of one to a source of the other that leads over it. The vertices with little
    /// more than the least are a *corridor*. Infinite where a vertex is not in both fields.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let space = Map::new(5, 3)?.costs([1, 1, 1, 1, 1, 4, 4, 4, 4, 4, 9, 9, 9, 9,
    /// 9])?.space(Motion::centers(2))?; let corridor = space.field([(0, 0)])?.corridor(&space.field([(4,
    /// 0)])?)?; assert_eq!([corridor[2], corridor[7]], [4.0, 4.0 + 2.0 * 2.5]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mismatch`] for fields of different spaces; [`Error::Walking`] for two fields over elevation
    /// of which none is [from its sources](crate::Space::field_from), or none to them.
    pub fn corridor(&self, other: &Self) -> Result<Vec<f64>, Error> {
        self.identity().check("the field", ("the other field", other.identity()))?;
        #[cfg(feature = "costs")]
        if let (Inner::Costs(field), Inner::Costs(other)) = (&self.inner, &other.inner) {
            return field.corridor(other).map_err(costs::told);
        }
        #[cfg(feature = "walking")]
        if let (Inner::Walking(field), Inner::Walking(other)) = (&self.inner, &other.inner) {
            return Ok(field.corridor(other)?);
        }
        Ok(self.lengths().into_iter().zip(other.lengths()).map(|(one, other)| one + other).collect())
    }

    /// The *allocation* of all vertices, row by row: [`width`](Self::width) × [`height`](Self::height)
    /// numbers. Each is that of the [nearest source](Self::nearest_source), from 0, in the order in which
    /// sources were given; `None` where there is no distance.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let space = Map::from_rows(["...#."])?.costs([1, 1, 9, 1, 1])?.space(Motion::default())?;
    /// let field = space.field([(2, 0), (0, 0)])?;
    /// assert_eq!(field.allocation(), [Some(1), Some(1), Some(0), None, None]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn allocation(&self) -> Vec<Option<u32>> {
        let number = |at: Vertex| at.y as usize * self.width() as usize + at.x as usize;
        #[cfg(feature = "costs")]
        if let Inner::Costs(field) = &self.inner {
            let has_one = field.sources().len() == 1;
            let source = |at| if has_one { field.cost(at).map(|_| 0) } else { field.allocation(at) };
            return self.vertices().map(source).collect();
        }
        let mut sources = HashMap::new();
        for (number, at) in (0..).zip(self.sources()) {
            sources.entry(at).or_insert(number);
        }
        if let Inner::BetweenCenters(field) = &self.inner {
            // The way leads over corners.
            let source = |at: Vertex| sources.get(&field.nearest_source(at.into())?).copied();
            return self.vertices().map(source).collect();
        }
        let mut found = vec![UNKNOWN; self.width() as usize * self.height() as usize];
        let mut on_the_way = Vec::new();
        for (from, _) in self.iter() {
            // Each vertex is asked once: the way ends where a source is known.
            let mut at = from;
            let source = loop {
                let known = found[number(at)];
                if known != UNKNOWN {
                    break known;
                }
                on_the_way.push(at);
                let end = match self.next(at).map(|next| (next, next.vertex())) {
                    Some((_, Some(next))) => {
                        at = next;
                        continue;
                    }
                    Some((between, None)) => between,
                    None => at.into(),
                };
                break sources.get(&end).copied().unwrap_or(UNKNOWN);
            };
            on_the_way.drain(..).for_each(|at| found[number(at)] = source);
        }
        found.into_iter().map(|source| Some(source).filter(|&source| source != UNKNOWN)).collect()
    }

    /// The directions from all vertices to their nearest source, row by row, as numbers that other programs
    /// read: [`width`](Self::width) × [`height`](Self::height) of them, not a number where there is none.
    /// ArcGIS calls them *back links* or *back directions*, GRASS *movement directions*. A direction leads to
    /// [`next`](Self::next): one move away, so it is one of 2ᵏ; at any angle it is that of the first segment.
    ///
    /// ```
    /// use mediant::{DirectionCode, Map, Motion};
    ///
    /// let field = Map::from_rows(["..", ".#"])?.space(Motion::centers(3))?.field([(0, 0)])?;
    /// let links = field.directions(DirectionCode::ArcGisBackLink);
    /// // 0 is a source, 5 is west, 7 is north.
    /// assert_eq!(links[..3], [0.0, 5.0, 7.0]);
    /// assert!(links[3].is_nan());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[cfg(feature = "costs")]
    #[must_use]
    pub fn directions(&self, code: DirectionCode) -> Vec<f64> {
        let direction = |at: Vertex| match self.next(at) {
            Some(next) => code.of(next.vertex().map_or_else(|| halves(at, next), |next| at.to(next))),
            None => self.get(at).and_then(|_| code.of_source()),
        };
        self.vertices().map(|at| direction(at).unwrap_or(f64::NAN)).collect()
    }

    /// All vertices, row by row.
    fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        let (width, height) = (self.width() as i32, self.height() as i32);
        (0..height).flat_map(move |y| (0..width).map(move |x| Vertex::new(x, y)))
    }
}
