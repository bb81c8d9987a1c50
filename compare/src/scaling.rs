//! How `pineda`'s time and memory grow: `micro` from a thousand triangles to ten million, `medium` from 256 x 256 pixels to 8192 x 8192; each point a process of its own.

use crate::cli::Scaling;
use crate::draw::Report;
use crate::machine::Machine;
use crate::measure::median;
use anyhow::{Context, Result, ensure};
use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// One point of a curve.
struct Point {
    /// Triangles, or pixels.
    count: f64,
    ms: f64,
    /// Without the scene.
    mib: Option<f64>,
}

/// A curve, and what its points count.
struct Curve {
    scene: &'static str,
    unit: &'static str,
    points: Vec<Point>,
}

pub(crate) fn scaling(arguments: &Scaling) -> Result<()> {
    let machine = Machine::this();
    let threads = arguments.threads.unwrap_or(machine.cores);
    std::fs::create_dir_all(&arguments.out_dir)
        .with_context(|| format!("cannot make the folder {}", arguments.out_dir.display()))?;
    let report = arguments.out_dir.join("report.json");
    let triangles = [1_000, 10_000, 100_000, 1_000_000, 10_000_000];
    let sides = [256, 512, 1024, 2048, 4096, 8192_u32];
    let curves = [
        Curve {
            scene: "micro",
            unit: "triangles",
            points: triangles
                .map(|count| point("micro", "--triangles", count, f64::from(count), threads, &report))
                .into_iter()
                .collect::<Result<_>>()?,
        },
        Curve {
            scene: "medium",
            unit: "pixels",
            points: sides
                .map(|side| point("medium", "--side", side, f64::from(side).powi(2), threads, &report))
                .into_iter()
                .collect::<Result<_>>()?,
        },
    ];
    std::fs::remove_file(&report).with_context(|| format!("cannot remove {}", report.display()))?;
    println!("{}, {} cores, {}; {}; {threads} threads", machine.cpu, machine.cores, machine.simd, machine.date);
    curves.iter().for_each(print);
    let path = arguments.out_dir.join("scaling.svg");
    std::fs::write(&path, svg(&curves, &machine)).with_context(|| format!("cannot write {}", path.display()))?;
    println!("\nwritten: {}", path.display());
    Ok(())
}

/// Draws the scene in a process of its own, where `option` is `value`.
fn point(scene: &str, option: &str, value: u32, count: f64, threads: usize, path: &Path) -> Result<Point> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["draw", "--peer", "pineda", "--scene", scene, option, &value.to_string()]);
    command.args(["--threads", &threads.to_string(), "--seconds", "2", "--frames", "500", "--report"]).arg(path);
    let output = command.stdin(Stdio::null()).stdout(Stdio::null()).output().context("cannot start this program")?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{scene} {option} {value}: {}", said.trim());
    let report: Report = serde_json::from_slice(&std::fs::read(path)?)?;
    Ok(Point { count, ms: median(&report.frames_ms), mib: report.peak_mib.map(|peak| peak - report.scene_mib) })
}

fn print(curve: &Curve) {
    let Curve { scene, unit, points } = curve;
    println!("\n| `{scene}`, {unit} | ms a frame | ns each | MiB beside the scene |\n| ---: | ---: | ---: | ---: |");
    for Point { count, ms, mib } in points {
        let mib = mib.map_or_else(|| "unknown".to_owned(), |mib| format!("{mib:.0}"));
        println!("| {count:.0} | {ms:.2} | {:.2} | {mib} |", 1e6 * ms / count);
    }
}

/// Both curves next to each other; all axes are logarithmic, a decade as long across as upwards, so that growth in proportion is a line at 45 degrees.
fn svg(curves: &[Curve; 2], machine: &Machine) -> String {
    const DECADE: f64 = 70.0;
    const PANEL: f64 = 430.0;
    const BOTTOM: f64 = 400.0;
    let mut body = String::new();
    for (number, Curve { scene, unit, points }) in curves.iter().enumerate() {
        let left = 60.0 + PANEL * number as f64;
        let first = points[0].count.log10().floor();
        let x = |count: f64| left + DECADE * (count.log10() - first);
        // From a hundredth of a millisecond.
        let y = |ms: f64| BOTTOM - DECADE * (ms.log10() + 2.0);
        let last = points[points.len() - 1].count.log10().ceil();
        for power in first as i32..=last as i32 {
            let at = x(10_f64.powi(power));
            let _ = writeln!(
                body,
                r##"<path d="M{at:.1} {BOTTOM}V50" stroke="#ddd"/><text x="{at:.1}" y="418" text-anchor="middle">10<tspan dy="-5" font-size="9">{power}</tspan></text>"##
            );
        }
        for power in -2..=3 {
            let (at, ms) = (y(10_f64.powi(power)), 10_f64.powi(power));
            let right = x(10_f64.powf(last));
            let _ = writeln!(
                body,
                r##"<path d="M{left} {at:.1}H{right:.1}" stroke="#ddd"/><text x="{:.1}" y="{:.1}" text-anchor="end">{ms}</text>"##,
                left - 6.0,
                at + 4.0
            );
        }
        let line: Vec<String> =
            points.iter().map(|point| format!("{:.1},{:.1}", x(point.count), y(point.ms))).collect();
        let _ = writeln!(
            body,
            r##"<polyline points="{}" fill="none" stroke="#d55e00" stroke-width="2"/>"##,
            line.join(" ")
        );
        for point in points {
            let _ = writeln!(
                body,
                r##"<circle cx="{:.1}" cy="{:.1}" r="3" fill="#d55e00"/>"##,
                x(point.count),
                y(point.ms)
            );
        }
        let _ = writeln!(body, r#"<text x="{left}" y="40" font-weight="600">{scene}: ms a frame by {unit}</text>"#);
    }
    let Machine { cpu, cores, simd, date } = machine;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 880 430\" width=\"880\" height=\"430\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"12\" y=\"18\" fill=\"#555\">{cpu}, {cores} cores, {simd}; {date}</text>\n{body}</svg>\n"
    )
}
