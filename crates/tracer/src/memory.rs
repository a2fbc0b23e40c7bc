//! How much memory there is and was used, where the system says so (Linux).

use scene_format::desc::{Caustics, Integrator, Render};
use std::fs::read_to_string;
use tracer_core::{Crop, Film, LayerSet};

/// Bytes that the sums of a picture, or part of one, take at most: light paths need room where they fall.
pub fn of_film(crop: Crop, render: &Render, layers: LayerSet, halves: bool) -> u64 {
    let clamped = render.clamp.is_some();
    let light_paths = render.integrator == Integrator::Full && render.caustics == Caustics::Photons;
    Film::bytes_of(crop, clamped, light_paths, layers, halves)
}

/// The most bytes that this process has held so far.
pub fn peak() -> Option<u64> {
    kibibytes(&read_to_string("/proc/self/status").ok()?, "VmHWM:")
}

/// Bytes that this process may still take: what the machine has free, or its control group or the limit of its address
/// space (`ulimit -v`) allows.
pub fn available() -> Option<u64> {
    let machine = kibibytes(&read_to_string("/proc/meminfo").ok()?, "MemAvailable:")?;
    let number = |path: &str| read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let group = number("/sys/fs/cgroup/memory.max")
        .zip(number("/sys/fs/cgroup/memory.current"))
        .map(|(most, current)| most.saturating_sub(current));
    let space = address_space(&read_to_string("/proc/self/limits").unwrap_or_default())
        .zip(kibibytes(&read_to_string("/proc/self/status").unwrap_or_default(), "VmSize:"))
        .map(|(most, current)| most.saturating_sub(current));
    Some([group, space].into_iter().flatten().fold(machine, u64::min))
}

/// The soft limit; `None` where there is none.
fn address_space(limits: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

fn kibibytes(text: &str, field: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(field))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|k| k * 1024)
}

/// Bytes for people: `1.5 GiB`.
pub fn human(bytes: u64) -> String {
    const UNITS: [&str; 5] = ["B", "KiB", "MiB", "GiB", "TiB"];
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 { format!("{bytes} B") } else { format!("{value:.1} {}", UNITS[unit]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_said_in_binary_units() {
        assert_eq!(human(0), "0 B");
        assert_eq!(human(1023), "1023 B");
        assert_eq!(human(1536), "1.5 KiB");
        assert_eq!(human(3 << 30), "3.0 GiB");
    }

    #[test]
    fn fields_of_proc_are_read() {
        assert_eq!(kibibytes("VmPeak:\t  10 kB\nVmHWM:\t    12 kB\n", "VmHWM:"), Some(12 * 1024));
        assert_eq!(kibibytes("VmPeak:\t  10 kB\n", "VmHWM:"), None);
        let limits = |soft: &str| format!("Limit  Soft Limit\nMax address space         {soft}  unlimited  bytes\n");
        assert_eq!(address_space(&limits("4096")), Some(4096));
        assert_eq!(address_space(&limits("unlimited")), None);
    }
}
