//! Programs of calls from bytes.

use crate::mistakes;

/// Runs the program of calls that these bytes are. It panics where a call does what it should not.
pub fn run(bytes: &[u8]) {
    mistakes::run_bytes(bytes);
}
