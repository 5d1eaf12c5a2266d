//! A program in a process of its own.

use std::{
    env, fs,
    path::Path,
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::{super::Options, Task, list::Runner, report::Report};

/// The core on which all run, one after another.
const CORE: &str = "0";

/// Runs a program on a map, and reads what it says.
///
/// # Errors
/// In words, why there is no report.
pub(super) fn run(runner: &Runner, folder: &Path, task: &Task, options: &Options) -> Result<Report, String> {
    let scratch = tempfile::tempdir().map_err(|error| error.to_string())?;
    let (said, errors) = (scratch.path().join("said"), scratch.path().join("errors"));
    let to = |path: &Path| fs::File::create(path).map_err(|error| error.to_string());
    let mut command = command(runner, folder)?;
    command
        .arg(&task.map)
        .arg(&task.scenario)
        .arg(options.passes.to_string())
        .arg(options.seconds.to_string());
    // Files and no pipes: nobody waits for a reader while the clock runs.
    command.stdin(Stdio::null()).stdout(to(&said)?).stderr(to(&errors)?).current_dir(folder);
    let longest = Duration::from_secs_f64(60.0 * options.minutes);
    let ended = waited(&mut command, longest)?;
    let text = |path: &Path| fs::read_to_string(path).unwrap_or_default();
    if !ended {
        let errors = text(&errors);
        let last = errors.lines().last().unwrap_or("it says nothing about it");
        return Err(format!("it failed: {last}"));
    }
    text(&said).parse::<Report>()?.check(task.problem.len())
}

/// The program, on one core where the system has a command for that.
fn command(runner: &Runner, folder: &Path) -> Result<Command, String> {
    let words = match runner {
        Runner::Ours(_, setup) => {
            let program = env::current_exe().map_err(|error| error.to_string())?;
            vec![program.into_os_string(), "--alone".into(), setup.into()]
        }
        Runner::Theirs(peer, _) => {
            let beside = folder.join(&peer.command[0]);
            let program = if beside.is_file() { beside.into() } else { (&peer.command[0]).into() };
            let rest = peer.command[1..].iter().map(Into::into);
            [program].into_iter().chain(rest).collect()
        }
    };
    let pins = Command::new("taskset").arg("--version").stdout(Stdio::null()).status();
    let pinned = pins.is_ok_and(|status| status.success());
    let mut command = Command::new(if pinned { "taskset".as_ref() } else { words[0].as_os_str() });
    if pinned {
        command.args(["--cpu-list", CORE]).arg(&words[0]);
    }
    command.args(&words[1..]);
    Ok(command)
}

/// Whether it ended well.
///
/// # Errors
/// In words, that it cannot be started, or took too long.
fn waited(command: &mut Command, longest: Duration) -> Result<bool, String> {
    let begin = Instant::now();
    let mut child = command.spawn().map_err(|error| format!("it cannot be started: {error}"))?;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status.success()),
            Ok(None) if begin.elapsed() < longest => thread::sleep(Duration::from_millis(20)),
            Ok(None) => {
                // It may have ended in between.
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("it took longer than {} minutes", longest.as_secs_f64() / 60.0));
            }
            Err(error) => return Err(error.to_string()),
        }
    }
}
