//! The hot entry functions are vector code: the disassembly of this very program holds wide registers, and no lane
//! operation was left standing as a call, which costs a factor of 20 and changes no bit.
#![cfg(target_arch = "x86_64")]

use std::collections::BTreeMap;
use std::process::Command;
use tracer_core::{RenderOptions, Unobserved, compile, render};

/// What was counted in the functions whose name holds a word.
#[derive(Debug, Default, PartialEq)]
struct Counted {
    /// Instructions on 512-bit registers.
    zmm: usize,
    /// Instructions on 256-bit registers.
    ymm: usize,
    /// Calls of intrinsics, or of lane operations and stages that should have been inlined.
    calls: Vec<String>,
}

/// What is in the name of a part of a stage (`Lanes::apart`).
const PART: &str = "Lanes>::apart::enter";

/// Counts in the entry functions of the stages, per level.
fn count(disassembly: &str) -> BTreeMap<&'static str, Counted> {
    let mut levels: BTreeMap<&'static str, Counted> = BTreeMap::new();
    let mut level = None;
    for line in disassembly.lines() {
        if line.ends_with(">:") {
            level = ["avx512", "avx2"].into_iter().find(|l| {
                line.contains(&format!("engine::kernels::{l}::"))
                    || (line.contains(&format!("lanes::{l}::")) && line.contains(PART))
            });
            // A stage that stands alone was not inlined into an entry function.
            if level.is_none() && line.contains("engine::stages::") && line.contains("closure") {
                level = Some("avx512");
                levels.entry("avx512").or_default().calls.push(line.to_owned());
            }
            continue;
        }
        let Some(counted) = level.map(|l| levels.entry(l).or_default()) else { continue };
        counted.zmm += usize::from(line.contains("%zmm"));
        counted.ymm += usize::from(line.contains("%ymm"));
        let inlined = ["core_arch", "lanes::", "engine::stages::", "math::vector"];
        // Curved shapes and curved lights are looked up one by one in double precision, by a call on purpose; so are
        // parts of stages, which count themselves.
        let on_purpose = ["engine::stages::shapes::find", "engine::stages::lights::curved::", PART];
        let one_by_one = on_purpose.iter().any(|word| line.contains(word));
        if line.contains("call") && !one_by_one && inlined.iter().any(|word| line.contains(word)) {
            counted.calls.push(line.to_owned());
        }
    }
    levels
}

#[test]
fn entry_functions_are_vector_code() {
    // The engine has to be linked in.
    let mut scene = scene_format::SceneDesc::default();
    scene.image.width = 8.into();
    scene.image.height = 8.into();
    let scene = compile(&scene).expect("an empty scene compiles");
    render(&scene, &RenderOptions { samples: Some(1), ..RenderOptions::default() }, &Unobserved);

    let program = std::env::current_exe().expect("this program has a path");
    let output = Command::new("objdump")
        .args(["--disassemble", "--demangle", "--no-show-raw-insn"])
        .arg(program)
        .output()
        .expect("objdump (package binutils) is needed to look at the machine code");
    assert!(output.status.success(), "objdump failed: {}", String::from_utf8_lossy(&output.stderr));
    let levels = count(&String::from_utf8_lossy(&output.stdout));
    let (avx512, avx2) = (&levels["avx512"], &levels["avx2"]);
    assert_eq!(avx512.calls, Vec::<String>::new(), "not inlined");
    assert_eq!(avx2.calls, Vec::<String>::new(), "not inlined");
    // Some three thousand in each; a stage in scalar code would leave far fewer.
    assert!(avx512.zmm > 1500, "{} instructions on 512-bit registers", avx512.zmm);
    assert!(avx2.ymm > 1500, "{} instructions on 256-bit registers", avx2.ymm);
}

#[test]
fn a_call_that_was_not_inlined_is_seen() {
    let text = "0000 <tracer_core::engine::kernels::avx512::shade_entry>:\n  vaddps %zmm0,%zmm1,%zmm2\n  \
                call 10 <core::core_arch::x86::avx512f::_mm512_mul_ps>\n0020 <other>:\n  call 10 <core::core_arch::x>\n\
                ";
    let counted = &count(text)["avx512"];
    assert_eq!((counted.zmm, counted.calls.len()), (1, 1));
}
