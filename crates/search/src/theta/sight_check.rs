//! When lines of sight are checked: the point in which Theta* and Lazy Theta* differ.

use std::fmt::Debug;

/// When a search checks that a node sees its parent.
pub trait SightCheck: sealed::Sealed + Copy + Debug {
    /// Whether that is when the node is generated. Otherwise it is when the node is expanded.
    const EAGER: bool;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Eager {}
    impl Sealed for super::Lazy {}
}

/// When the node is generated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Eager;

impl SightCheck for Eager {
    const EAGER: bool = true;
}

/// When the node is expanded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lazy;

impl SightCheck for Lazy {
    const EAGER: bool = false;
}
