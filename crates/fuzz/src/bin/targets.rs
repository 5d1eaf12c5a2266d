//! The program that libFuzzer drives: one for all targets, since each link takes a minute and its file
//! hundreds of megabytes. The environment variable `MEDIANT_FUZZ` names the target, `MEDIANT_FUZZ_SEEDS` a
//! folder to which it writes valid inputs before it begins.
#![no_main]

use std::{path::PathBuf, sync::LazyLock};

use libfuzzer_sys::fuzz_target;
use mediant_fuzz::{Target, seeds};

static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let name = std::env::var("MEDIANT_FUZZ").unwrap_or_default();
    Target::find(&name).unwrap_or_else(|| {
        eprintln!("MEDIANT_FUZZ is `{name}`: {}", Target::names());
        std::process::exit(2)
    })
});

fn write_seeds() {
    let Some(folder) = std::env::var_os("MEDIANT_FUZZ_SEEDS").map(PathBuf::from) else { return };
    for (at, data) in seeds(&TARGET).into_iter().enumerate() {
        let _ = std::fs::write(folder.join(format!("seed-{at:03}")), data);
    }
}

fuzz_target!(init: write_seeds(), |data: &[u8]| (TARGET.run)(data));
