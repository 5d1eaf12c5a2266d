//! The module that Python loads.

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule(gil_used = false)]
mod _mediant {
    #[pymodule_export]
    use crate::{
        answer::PyAnswer,
        field::Field,
        grid::{Disc, Grid},
        index::{Index, Search},
        keywords::{bound, moves},
        paths::Paths,
        scenario::Scenario,
        spaced::spaced,
        world::World,
    };

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
