//! The elevation of a space to walk on.

#[cfg(not(feature = "walking"))]
pub(crate) use self::absent::Walk;
#[cfg(feature = "walking")]
pub(crate) use self::given::Walk;

#[cfg(feature = "walking")]
mod given {
    use std::sync::Arc;

    use mediant_costs::WalkingGraph;
    use mediant_grid::{Identity, Interrupt};
    use mediant_search::{Path, PathCosts};

    use crate::{
        error::Error, motion::Motion, setup_error::SetupError, space::Space, surface::Weighed,
        walking::Walking,
    };

    /// Elevations of cells, and their search graph.
    #[derive(Clone, Debug)]
    pub(crate) struct Walk {
        pub(crate) walking: Walking,
        pub(crate) graph: Arc<WalkingGraph>,
    }

    impl Weighed for Walk {
        fn identity(&self) -> Identity {
            self.graph.identity()
        }

        fn memory_bytes(&self) -> usize {
            self.graph.map().memory_bytes() + self.graph.memory_bytes()
        }

        fn path_costs(&self) -> Arc<dyn PathCosts> {
            Arc::<WalkingGraph>::clone(&self.graph)
        }

        fn cost(&self, path: &Path) -> Option<f64> {
            self.graph.path_cost(path).map(|cost| self.graph.to_f64(cost))
        }
    }

    impl Space {
        /// Elevations with rules of motion and a k.
        pub(crate) fn of_walking(of: &Walking, motion: Motion, interrupt: &Interrupt) -> Result<Self, Error> {
            const MAX: u32 = WalkingGraph::MAX_K;
            motion.check_k()?;
            let k = motion.k.finite().filter(|k| k.get() <= MAX);
            let k = k.ok_or_else(|| SetupError::k_on_costs(motion.k, MAX, true))?;
            let graph = Arc::new(WalkingGraph::new(Arc::clone(of.ground()), motion.rules, k)?);
            Self::searched(of.map(), (None, Some(Walk { walking: of.alone(), graph })), motion, interrupt)
        }

        /// The elevation of its cells and the pace, if it is a space to [walk on](crate::Map::walking).
        #[must_use]
        pub fn walking(&self) -> Option<&Walking> {
            self.walk().map(|walk| &walk.walking)
        }
    }
}

#[cfg(not(feature = "walking"))]
mod absent {
    use std::sync::Arc;

    use mediant_grid::Identity;
    use mediant_search::{Path, PathCosts};

    use crate::surface::Weighed;

    /// Without the feature `walking` no space has elevations.
    #[derive(Clone, Debug)]
    pub(crate) enum Walk {}

    impl Weighed for Walk {
        fn identity(&self) -> Identity {
            match *self {}
        }

        fn memory_bytes(&self) -> usize {
            match *self {}
        }

        fn path_costs(&self) -> Arc<dyn PathCosts> {
            match *self {}
        }

        fn cost(&self, _: &Path) -> Option<f64> {
            match *self {}
        }
    }
}
