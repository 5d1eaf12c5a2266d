//! The revision and the machine of this very run.

use std::{
    env, fs,
    path::Path,
    process::{Command, Stdio},
    thread,
};

use crate::Machine;

/// The revision of the sources at `root` by `git describe`, with `-dirty` if files differ from it; `unknown`
/// where git does not answer.
#[must_use]
pub fn revision(root: &Path) -> String {
    let git = Command::new("git")
        .args(["describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"])
        .current_dir(root)
        .stderr(Stdio::null())
        .output();
    match git {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).trim().to_owned(),
        _ => "unknown".to_owned(),
    }
}

impl Machine {
    /// The machine that this runs on.
    #[must_use]
    pub fn here() -> Self {
        let about = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let cpu = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
        Self {
            os: env::consts::OS.to_owned(),
            arch: env::consts::ARCH.to_owned(),
            cpu: cpu.map(|(_, name)| name.trim().to_owned()),
            threads: thread::available_parallelism().ok().map(usize::from),
        }
    }
}
