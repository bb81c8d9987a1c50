//! The chart: for each scene, how many times as long as `pineda` each peer takes.

use crate::backend::Peer;
use crate::measure::{Measurement, Results};
use crate::scene::SceneName;
use crate::table;
use std::fmt::Write;

/// In pixels of the drawing.
const WIDTH: f64 = 860.0;
const LEFT: f64 = 150.0;
const TOP: f64 = 74.0;
const BAR: f64 = 13.0;
const GAP: f64 = 11.0;
/// What a bar's text may stick out beyond it.
const RIGHT: f64 = 130.0;

/// The results with the most threads, as an SVG: the axis is logarithmic, the same length always the same factor.
pub(crate) fn svg(results: &Results) -> String {
    let threads = results.write_bandwidths.iter().map(|&(threads, _)| threads).max().unwrap_or(1);
    let of_count = |one: &&Measurement| one.threads == one.peer.useful_threads(threads);
    let all: Vec<&Measurement> = results.measurements.iter().filter(of_count).collect();
    let mut scenes: Vec<SceneName> = all.iter().map(|one| one.scene).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let mut peers: Vec<Peer> = all.iter().map(|one| one.peer).collect();
    peers.sort_unstable();
    peers.dedup();

    let times = || all.iter().map(|one| one.median_ms());
    let (least, most) = (times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max));
    // A shortest bar has to be seen, too.
    let axis = Axis { first: least / 2.0, last: most };
    let mut bars = String::new();
    let mut y = TOP;
    for scene in scenes {
        let of_scene: Vec<&&Measurement> = all.iter().filter(|one| one.scene == scene).collect();
        let ours = of_scene.iter().find(|one| one.peer == Peer::Pineda).map(|one| one.median_ms());
        let middle = y + 0.5 * BAR * of_scene.len() as f64;
        let name = scene.as_str();
        text(&mut bars, [LEFT - 8.0, middle + 4.0], "text-anchor=\"end\" font-weight=\"600\"", name);
        for one in of_scene {
            let (ms, color) = (one.median_ms(), color(one.peer));
            let end = axis.place(ms);
            let width = end - LEFT;
            let height = BAR - 1.0;
            let _ =
                writeln!(bars, r#"<rect x="{LEFT}" y="{y:.1}" width="{width:.1}" height="{height}" fill="{color}"/>"#);
            let mut label = if ms < 10.0 { format!("{ms:.1} ms") } else { format!("{ms:.0} ms") };
            if let Some(ours) = ours.filter(|_| one.peer != Peer::Pineda) {
                label += &format!(", {:.1}x", ms / ours);
            }
            text(&mut bars, [end + 5.0, y + BAR - 3.0], "font-size=\"11\"", &label);
            y += BAR;
        }
        y += GAP;
    }

    let machine = &results.machine;
    let mut head = String::new();
    text(
        &mut head,
        [12.0, 22.0],
        "font-size=\"16\" font-weight=\"600\"",
        &format!("Milliseconds a frame, {threads} threads (shorter is better; the axis is logarithmic)"),
    );
    let mean = table::mean(&table::best_ratios(&results.measurements, threads));
    let about = format!(
        "{}, {} cores, {}; {}. The best peer takes {mean:.1} times as long (geometric mean).",
        machine.cpu, machine.cores, machine.simd, machine.date
    );
    text(&mut head, [12.0, 40.0], "font-size=\"11\" fill=\"#555\"", &about);
    let mut x = LEFT;
    for peer in peers {
        let color = color(peer);
        let _ = writeln!(head, r#"<rect x="{x:.0}" y="50" width="11" height="11" fill="{color}"/>"#);
        text(&mut head, [x + 16.0, 60.0], "", peer.as_str());
        x += 118.0;
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {y:.0}\" width=\"{WIDTH}\" height=\"{y:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{head}{bars}</svg>\n"
    )
}

/// Where a time's bar ends.
struct Axis {
    first: f64,
    last: f64,
}

impl Axis {
    fn place(&self, ms: f64) -> f64 {
        LEFT + (WIDTH - LEFT - RIGHT) * (ms / self.first).ln() / (self.last / self.first).ln()
    }
}

fn text(out: &mut String, [x, y]: [f64; 2], attributes: &str, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    let _ = writeln!(out, r#"<text x="{x:.1}" y="{y:.1}" {attributes}>{text}</text>"#);
}

/// Colours that colour-blind people tell apart (Okabe and Ito 2008).
fn color(peer: Peer) -> &'static str {
    match peer {
        Peer::Pineda => "#d55e00",
        Peer::Lavapipe => "#0072b2",
        Peer::Swiftshader => "#56b4e9",
        Peer::Llvmpipe => "#009e73",
        Peer::Euc => "#999999",
        Peer::Embree => "#cc79a7",
    }
}
