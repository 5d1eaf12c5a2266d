//! Fields as rows of numbers, for rasters.

use std::collections::HashMap;

#[cfg(feature = "costs")]
use mediant_costs::DirectionCode;
use mediant_grid::Vertex;

use super::{Field, Inner, of_each};

/// The number of a vertex whose source is not known yet.
const UNKNOWN: u32 = u32::MAX;

impl Field {
    /// The sources, in the order in which they were given.
    #[must_use]
    pub fn sources(&self) -> &[Vertex] {
        of_each!(&self.inner, field => field.query().sources)
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
        for (number, &at) in (0..).zip(self.sources()) {
            sources.entry(at).or_insert(number);
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
                match self.next(at) {
                    Some(next) => at = next,
                    None => break sources.get(&at).copied().unwrap_or(UNKNOWN),
                }
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
            Some(next) => code.of(at.to(next)),
            None => self.get(at).and_then(|_| code.of_source()),
        };
        self.vertices().map(|at| direction(at).unwrap_or(f64::NAN)).collect()
    }

    /// All vertices, row by row.
    #[cfg(feature = "costs")]
    fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        let (width, height) = (self.width() as i32, self.height() as i32);
        (0..height).flat_map(move |y| (0..width).map(move |x| Vertex::new(x, y)))
    }
}
