//! Paths that keep off walls: the widest disc that has a path.

use std::sync::Arc;

use mediant_moves::K;

use super::Clearance;
use crate::{
    FreeSpace, Grid, Placement, Vertex,
    interrupt::{Interrupt, Interrupted},
};

/// The widest disc that has a path: see [`Clearance::widest`].
#[derive(Clone, Debug)]
pub struct Widest<T> {
    /// The radius of the disc, in cells. 0 if not even the smallest of the [radii](Clearance::radii) was to
    /// be tried.
    pub radius: f64,
    /// The map of that disc.
    pub map: Arc<Grid>,
    /// The result of the search on this map.
    pub found: T,
}

impl Clearance {
    /// The largest disc on whose map `search` finds something, for example a path that is short enough, with
    /// what it found there. `None` if it finds nothing even on the map itself.
    ///
    /// Only discs up to the radius `at_most` are tried; the [largest disc](Self::largest_disc_at) at the ends
    /// of a query is such a limit. If n of the [`radii`](Self::radii) are left, at most log₂(n) + 2 maps are
    /// searched.
    ///
    /// # What is promised
    ///
    /// The *width* of a path is the largest radius of a disc on whose map it is legal.
    /// [Guarantees](Self#guarantees) of the disc that moves along it are above. Let `search` be an engine
    /// that finds shortest paths, and let it answer with its path if that is at most so long, and with
    /// nothing otherwise. Then no path that is at most so long is wider than the one that is returned. If the
    /// limit is the length of the shortest path on the map itself, the result is a shortest path that keeps
    /// off walls as far as any shortest path does, measured where it comes nearest. With 1.1 times that
    /// length, it keeps off as far as a surplus of 10 % can buy. How far it keeps off elsewhere is not
    /// promised.
    ///
    /// This needs that what is legal on the map of a disc is legal on those of smaller ones, which holds
    /// under all rules, but for one case: under [`DiagonalGap::Closed`](crate::DiagonalGap::Closed), for ends
    /// whose own cells (those to the lower right) are not free on the map of the widest path. There, and
    /// where `search` may find longer paths on maps with more free cells, the path still is as short as
    /// `search` says and has the stated width, but there may be a wider one.
    ///
    /// A limit on lengths that are floating-point numbers needs some slack, since two paths of one length can
    /// have sums that differ in the last digits.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Centers, Clearance, CornerRule, Fit, FreeSpace, Outside};
    /// // A short way through a narrow door, a long way through a wide one.
    /// let map = AsciiMap::parse("
    ///     ...#.......
    ///     .a...b.....
    ///     ...#.......
    ///     ...#.......
    ///     ...........
    ///     ...........
    ///     ...........
    /// ")?;
    /// let (a, b) = (map.mark('a').unwrap(), map.mark('b').unwrap());
    /// let clearance = Clearance::new(Arc::new(map.grid), Fit::Centers, Outside::Blocked);
    /// // Any path at all.
    /// let any = |map: &Arc<_>| {
    ///     let space = FreeSpace::<Centers>::new(Arc::clone(map), CornerRule::Never);
    ///     Ok::<_, ()>(space.connected(a, b).then_some(()))
    /// };
    /// assert_eq!(clearance.widest(f64::INFINITY, any).unwrap().unwrap().radius, 1.5);
    /// // A straight path.
    /// let straight = |map: &Arc<_>| {
    ///     let space = FreeSpace::<Centers>::new(Arc::clone(map), CornerRule::Never);
    ///     Ok::<_, ()>(space.sees(a, b).then_some(()))
    /// };
    /// assert_eq!(clearance.widest(f64::INFINITY, straight).unwrap().unwrap().radius, 0.5);
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// The first error of `search`.
    pub fn widest<T, E>(
        &self,
        at_most: f64,
        search: impl FnMut(&Arc<Grid>) -> Result<Option<T>, E>,
    ) -> Result<Option<Widest<T>>, E> {
        self.bisect(at_most, &Interrupt::NEVER, |_| unreachable!("nothing stops this work"), search)
    }

    /// [`widest`](Self::widest), which an interrupt can stop where `search` does not work; it asks before
    /// each row of a map.
    ///
    /// # Errors
    /// As for [`widest`](Self::widest), and the error of an interrupt.
    pub fn widest_interruptible<T, E: From<Interrupted>>(
        &self,
        at_most: f64,
        interrupt: &Interrupt,
        search: impl FnMut(&Arc<Grid>) -> Result<Option<T>, E>,
    ) -> Result<Option<Widest<T>>, E> {
        self.bisect(at_most, interrupt, E::from, search)
    }

    fn bisect<T, E>(
        &self,
        at_most: f64,
        interrupt: &Interrupt,
        stopped: impl Fn(Interrupted) -> E,
        mut search: impl FnMut(&Arc<Grid>) -> Result<Option<T>, E>,
    ) -> Result<Option<Widest<T>>, E> {
        let mut squares = self.squared_radii(interrupt).map_err(&stopped)?;
        squares.retain(|&squared| self.root(squared) <= at_most);
        // The smallest radius leaves the map as it is.
        let mut map = Arc::clone(&self.grid);
        let mut radius = squares.first().map_or(0.0, |&squared| self.root(squared));
        let Some(mut found) = search(&map)? else {
            return Ok(None);
        };
        let (mut low, mut high) = (0, squares.len());
        while low + 1 < high {
            let middle = usize::midpoint(low, high);
            let narrower = Arc::new(self.at_least(squares[middle], interrupt).map_err(&stopped)?);
            match search(&narrower)? {
                Some(path) => {
                    (low, radius) = (middle, self.root(squares[middle]));
                    (found, map) = (path, narrower);
                }
                None => high = middle,
            }
        }
        Ok(Some(Widest { radius, map, found }))
    }

    /// The radius of the largest disc that can go from one vertex to another at all, over N(k): the clearance
    /// of the widest way at its narrowest place. `None` if there is no way.
    ///
    /// Linear in the map for each disc that is tried. The exception of [`widest`](Self::widest) holds here
    /// too.
    #[must_use]
    pub fn bottleneck<P: Placement>(&self, rule: P::Rule, k: K, from: Vertex, to: Vertex) -> Option<f64> {
        let ends = [from, to].map(|at| self.largest_disc_at(P::KIND, at));
        let at_most = ends[0]?.min(ends[1]?);
        let connected = |map: &Arc<Grid>| {
            let space = FreeSpace::<P>::for_k(Arc::clone(map), rule, k);
            Ok::<_, std::convert::Infallible>(space.connected(from, to).then_some(()))
        };
        let Ok(widest) = self.widest(at_most, connected);
        widest.map(|widest| widest.radius)
    }
}
