//! `cargo xtask asm`: the kernels' machine code.
//!
//! A kernel is written once and compiled for each SIMD level inside of that level's `vectorize_*` wrapper: `fearless_simd`'s, and for SSE2, which x86-64 has anyway, `vectorize_baseline` of `pineda`'s own. All that it does to lanes must be inlined there: a function
//! that is not is compiled without the level's instructions, and passes its vectors through memory. One missing `#[inline(always)]` made a kernel six times slower in a
//! trial, and no test of pictures notices. So this looks at what the wrappers of a release build
//!
//! - call: no lane operation, no function of `pineda`'s that computes with lanes;
//! - do one number at a time: no more than setting up triangles and planes takes. A single lane operation that fell apart leaves sixteen.
//!
//! It needs `objdump`, which comes with the linker: binutils, or LLVM's.

use crate::run::{cargo, root, run};
use std::collections::BTreeMap;
use std::process::Command;

/// Functions that must not be called from a kernel: parts of these names.
const LANE_CODE: [&str; 10] = [
    "fearless_simd::",
    "pineda::wide",
    "pineda::lanes",
    "pineda::math",
    "pineda::transpose",
    "pineda::tile::view",
    "core::iter::",
    "core::array::",
    "libm::",
    "fma",
];

/// Scalar float operations of a kernel. Measured: at most 39 with AVX-512 and AVX2, 74 with SSE2, most of them planes of single triangles in f64.
const MOST_SCALARS: [(&str, usize); 4] = [("baseline", 256), ("sse4_2", 256), ("avx2", 128), ("avx512", 96)];

/// Scalar divisions and square roots of a kernel. Measured: one.
const MOST_DIVISIONS: usize = 8;

/// A level has setup, coverage in three sizes, visibility, interpolation, shading, ...
const LEAST_KERNELS: [(&str, usize); 4] = [("baseline", 10), ("sse4_2", 10), ("avx2", 10), ("avx512", 10)];

/// Builds the kernels in release and looks at them.
pub(crate) fn asm() -> Result<(), String> {
    if !cfg!(target_arch = "x86_64") {
        println!("the machine code is looked at on x86-64 only");
        return Ok(());
    }
    // With the command line's features, as all the other steps have it: else the library would be built once more.
    let packages = ["--package", "pineda-proof", "--package", "pineda-cli"];
    run(cargo().args(["build", "--quiet", "--release", "--bin", "prove"]).args(packages))?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into);
    let binary = target.join("release").join(format!("prove{}", std::env::consts::EXE_SUFFIX));
    let objdump = |arguments: &[&str]| -> Result<String, String> {
        let output = Command::new("objdump").args(arguments).arg(&binary).output();
        let output = output.map_err(|error| {
            format!("`objdump` cannot be started ({error}); it is part of binutils: `apt-get install binutils`")
        })?;
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let kernels = kernels(&objdump(&["-d", "--no-show-raw-insn", "-C"])?, &objdump(&["-R"])?);
    let mut problems = Vec::new();
    for (level, least) in LEAST_KERNELS {
        let of_level: Vec<_> = kernels.iter().filter(|kernel| kernel.level == level).collect();
        let instructions: usize = of_level.iter().map(|kernel| kernel.instructions).sum();
        let scalars = of_level.iter().map(|kernel| kernel.scalars).max().unwrap_or(0);
        println!("{level:>7}: {} kernels, {instructions} instructions, {scalars} scalars at most", of_level.len());
        if of_level.len() < least {
            problems.push(format!("{level}: {} kernels were found instead of at least {least}", of_level.len()));
        }
    }
    problems.extend(kernels.iter().flat_map(Kernel::problems));
    if problems.is_empty() { Ok(()) } else { Err(problems.join("\n")) }
}

/// A `vectorize_*` function of the disassembly.
#[derive(Debug, Default, PartialEq, Eq)]
struct Kernel {
    level: String,
    address: String,
    instructions: usize,
    /// Scalar additions, subtractions, multiplications.
    scalars: usize,
    /// Scalar divisions and square roots.
    divisions: usize,
    calls: Vec<String>,
}

impl Kernel {
    fn problems(&self) -> Vec<String> {
        let Self { level, address, scalars, divisions, .. } = self;
        let place = format!("{level} kernel at {address} ({} instructions)", self.instructions);
        // Angles beyond 2^18 are taken one at a time, apart from the kernel, because hardly any are.
        let is_lane_code = |name: &&String| {
            LANE_CODE.iter().any(|part| name.contains(part))
                && !["vectorize", "huge_angle"].iter().any(|apart| name.contains(apart))
        };
        let mut problems: Vec<String> =
            self.calls.iter().filter(is_lane_code).map(|name| format!("{place} calls {name}")).collect();
        let most = MOST_SCALARS.iter().find(|(name, _)| name == level).map_or(0, |&(_, most)| most);
        if *scalars > most {
            problems.push(format!(
                "{place} has {scalars} scalar float operations; {most} are enough for what is not in lanes"
            ));
        }
        if *divisions > MOST_DIVISIONS {
            problems.push(format!(
                "{place} has {divisions} scalar divisions and square roots; at most {MOST_DIVISIONS} are expected"
            ));
        }
        problems
    }
}

/// Reads `objdump -d -C` and `objdump -R`.
fn kernels(disassembly: &str, relocations: &str) -> Vec<Kernel> {
    let names: BTreeMap<u64, &str> = disassembly.lines().filter_map(function).collect();
    // Most calls go through a table of addresses, which the loader fills in: "0001234 R_X86_64_RELATIVE *ABS*+0x5678".
    let table: BTreeMap<u64, String> = relocations.lines().filter_map(|line| relocation(line, &names)).collect();
    let mut kernels = Vec::new();
    let mut current: Option<Kernel> = None;
    let mut registers: BTreeMap<String, String> = BTreeMap::new();
    for line in disassembly.lines() {
        if let Some((address, name)) = function(line) {
            kernels.extend(current.take());
            registers.clear();
            if let Some((_, level)) = name.split_once("vectorize_") {
                let level = level.trim_end_matches('>').to_owned();
                current = Some(Kernel { level, address: format!("{address:#x}"), ..Kernel::default() });
            }
            continue;
        }
        let (Some(kernel), Some((_, instruction))) = (current.as_mut(), line.split_once(":\t")) else { continue };
        let mut words = instruction.split_whitespace();
        let operation = words.next().unwrap_or_default();
        let operands = words.next().unwrap_or_default();
        kernel.instructions += 1;
        let through_table = instruction.split_once("# ").and_then(|(_, comment)| {
            table.get(&u64::from_str_radix(comment.split_whitespace().next()?, 16).ok()?).cloned()
        });
        if operation.starts_with("call") {
            let direct = instruction.split_once('<').map(|(_, name)| name.trim_end_matches('>').to_owned());
            let register = operands.trim_start_matches('*');
            kernel.calls.extend(through_table.or_else(|| registers.get(register).cloned()).or(direct));
        } else if let (true, Some(name)) = (operation.starts_with("mov"), through_table) {
            let register = operands.rsplit(',').next().unwrap_or_default();
            registers.insert(register.to_owned(), name);
        }
        let scalar = operation.trim_start_matches('v');
        let scalar = scalar.strip_suffix("ss").or_else(|| scalar.strip_suffix("sd"));
        match scalar {
            Some("add" | "sub" | "mul") => kernel.scalars += 1,
            Some("div" | "sqrt") => kernel.divisions += 1,
            _ => {}
        }
    }
    kernels.extend(current);
    kernels
}

/// `0000000000001234 <name>:`
fn function(line: &str) -> Option<(u64, &str)> {
    let (address, name) = line.strip_suffix(">:")?.split_once(" <")?;
    Some((u64::from_str_radix(address, 16).ok()?, name))
}

/// `0000000000001234 R_X86_64_RELATIVE  *ABS*+0x0000000000005678`, or with a name of another library's at its end.
fn relocation(line: &str, names: &BTreeMap<u64, &str>) -> Option<(u64, String)> {
    let mut words = line.split_whitespace();
    let place = u64::from_str_radix(words.next()?, 16).ok()?;
    let target = words.nth(1)?;
    let name = match target.strip_prefix("*ABS*+0x") {
        Some(address) => (*names.get(&u64::from_str_radix(address, 16).ok()?)?).to_owned(),
        None => target.to_owned(),
    };
    Some((place, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISASSEMBLY: &str = "
0000000000001000 <fearless_simd::avx2::add>:
    1000:\tret
0000000000002000 <<fearless_simd::Avx2 as Simd>::vectorize::vectorize_avx2>:
    2000:\tmov    0x2f00(%rip),%r15        # 4f00 <_DYNAMIC+0x10>
    2004:\tvmulss %xmm0,%xmm1,%xmm2
    2008:\tvmulps %ymm0,%ymm1,%ymm2
    200c:\tcall   1000 <fearless_simd::avx2::add>
    2010:\tcall   *%r15
    2014:\tcall   *0x2f08(%rip)        # 4f08 <_DYNAMIC+0x18>
    2018:\tvdivss %xmm0,%xmm1,%xmm2
";
    const RELOCATIONS: &str = "
0000000000004f00 R_X86_64_RELATIVE  *ABS*+0x0000000000001000
0000000000004f08 R_X86_64_GLOB_DAT  memcpy@GLIBC_2.14
";

    #[test]
    fn calls_are_found_directly_through_the_table_and_in_registers() {
        let kernels = kernels(DISASSEMBLY, RELOCATIONS);
        assert_eq!(kernels.len(), 1);
        let kernel = &kernels[0];
        let add = "fearless_simd::avx2::add";
        assert_eq!(kernel.calls, [add, add, "memcpy@GLIBC_2.14"]);
        assert_eq!((kernel.level.as_str(), kernel.instructions, kernel.scalars, kernel.divisions), ("avx2", 7, 1, 1));
        assert_eq!(kernel.problems().len(), 2, "{:?}", kernel.problems());
    }
}
