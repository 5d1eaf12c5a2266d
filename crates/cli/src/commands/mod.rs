//! The commands of the program.

pub(crate) mod build;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod demo;
pub(crate) mod engines;
pub(crate) mod manual;
pub(crate) mod moves;
pub(crate) mod reach;
pub(crate) mod run;
pub(crate) mod table;
