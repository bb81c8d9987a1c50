//! The command under limits of memory and time, which the system sets.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Of address space, and so of more than is ever used: 1 GiB, in KiB.
const MOST_MEMORY: &str = "1048576";
/// Of all threads together, in seconds: so that a machine that is busy otherwise changes nothing.
const MOST_WORK: &str = "5";
/// For what waits, rather than works, for ever.
const MOST_TIME: Duration = Duration::from_secs(60);

pub(super) struct Outcome {
    /// `None`: a signal ended it, as it does when there is no memory.
    pub(super) code: Option<i32>,
    pub(super) stderr: String,
}

/// The command in a folder; an error if it takes too long, panics or is killed.
pub(super) fn run(folder: &Path, arguments: &[&str]) -> Result<Outcome, String> {
    // Other systems do not know of all these limits.
    let mut command = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        let script = "ulimit -v $0 && ulimit -t $1 && shift && exec \"$@\"";
        shell.args(["-c", script, MOST_MEMORY, MOST_WORK, env!("CARGO_BIN_EXE_pineda")]);
        shell
    } else {
        Command::new(env!("CARGO_BIN_EXE_pineda"))
    };
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let start = Instant::now();
    let mut child = command.spawn().unwrap();
    // What it says fits into the pipe, so it need not be read meanwhile.
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > MOST_TIME {
            child.kill().unwrap();
            child.wait().unwrap();
            return Err(format!("takes more than {} s", MOST_TIME.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8(output.stderr).map_err(|_| "says what is not UTF-8".to_owned())?;
    if output.status.code().is_none() || stderr.contains("panicked") {
        return Err(format!("{}, said:\n{stderr}", output.status));
    }
    Ok(Outcome { code: output.status.code(), stderr })
}
