//! The examples of the guide's pages, compiled and run as documentation tests.

/// A page for each line: a name of its own, and the file.
macro_rules! pages {
    ($($name:ident: $file:literal,)*) => {
        $(
            #[doc = include_str!(concat!("../../../docs/guide/src/", $file))]
            struct $name;
        )*
    };
}

pages! {
    Idea: "idea.md",
    Rust: "start/rust.md",
    Choose: "choose.md",
    Prepared: "prepared.md",
    Queries: "queries.md",
    Changing: "tasks/changing.md",
    Robots: "tasks/robots.md",
    Games: "tasks/games.md",
    Gis: "tasks/gis.md",
    Astar: "engines/astar.md",
    Canonical: "engines/canonical.md",
    Jps: "engines/jps.md",
    Anya: "engines/anya.md",
    Subgoal: "engines/subgoal.md",
    Labels: "engines/labels.md",
    Theta: "engines/theta.md",
    Hierarchies: "engines/hierarchies.md",
    Fields: "engines/fields.md",
    Costs: "engines/costs.md",
    Landmarks: "engines/landmarks.md",
    Repair: "engines/repair.md",
}
