//! Memory of this process, as the kernel counts it.

use std::fs;

/// Bytes in `VmRSS` (resident now) or `VmHWM` (resident at most so far); `None` where the kernel does not say.
pub fn resident(field: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with(field))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}
