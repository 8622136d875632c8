//! Memory that this process can still have.

use std::fs::read_to_string;

/// Bytes that the host still gives to this process: the least of what is free, what its address space has left, and what its
/// group of processes may take. None where the host does not tell.
pub fn available() -> Option<u64> {
    [free(), address_space(), group()].into_iter().flatten().min()
}

fn free() -> Option<u64> {
    kibibytes(&read_to_string("/proc/meminfo").ok()?, "MemAvailable:")
}

/// What `ulimit -v` leaves.
fn address_space() -> Option<u64> {
    let limits = read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let most: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(most.saturating_sub(kibibytes(&read_to_string("/proc/self/status").ok()?, "VmSize:")?))
}

/// What a container leaves, by the second version of control groups.
fn group() -> Option<u64> {
    let number = |name: &str| read_to_string(format!("/sys/fs/cgroup/memory.{name}")).ok()?.trim().parse::<u64>().ok();
    Some(number("max")?.saturating_sub(number("current")?))
}

/// A line such as `MemAvailable:  1234 kB`.
fn kibibytes(text: &str, key: &str) -> Option<u64> {
    let number: u64 = text.lines().find_map(|line| line.strip_prefix(key))?.split_whitespace().next()?.parse().ok()?;
    Some(1024 * number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_kernel_are_read() {
        assert_eq!(kibibytes("MemTotal: 9 kB\nMemAvailable:   12 kB\n", "MemAvailable:"), Some(12 * 1024));
        assert_eq!(kibibytes("MemTotal: 9 kB\n", "MemAvailable:"), None);
        assert!(available().is_none_or(|bytes| bytes > 0));
    }
}
