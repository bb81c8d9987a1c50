//! The tables that people read.

use crate::backend::Peer;
use crate::measure::{Measurement, Results};
use crate::scene::{Scene, SceneName};

/// Prints machine, versions, tables per number of threads (Markdown, so that they can be pasted) and the check of the pictures.
pub(crate) fn print(results: &Results) {
    let machine = &results.machine;
    println!("{}, {} cores, {}; {}", machine.cpu, machine.cores, machine.simd, machine.date);
    println!("1920 x 1080 unless the scene says otherwise, image in memory; {} rounds", results.rounds);
    let mut versions: Vec<(Peer, &str)> =
        results.measurements.iter().map(|one| (one.peer, one.version.as_str())).collect();
    versions.sort_unstable();
    versions.dedup();
    for (peer, version) in versions {
        println!("- {}: {version}", peer.as_str());
    }
    let mut counts: Vec<usize> = results.measurements.iter().map(|one| one.threads).collect();
    counts.sort_unstable_by(|a, b| b.cmp(a));
    counts.dedup();
    for threads in counts {
        println!("\nthreads: {threads}; median ms a frame (fastest frame), ratio of medians");
        print_table(&results.measurements, threads, time_cell);
        println!("\nthreads: {threads}; processor time in ms a frame, all threads together, and its ratio");
        print_table(&results.measurements, threads, cpu_cell);
        println!("\nthreads: {threads}; at most so many MiB of memory");
        print_table(&results.measurements, threads, memory_cell);
        print_mean(&results.measurements, threads);
        print_fill(results, threads);
    }
    print_likenesses(results);
}

/// One row for each scene, one column for each renderer; `cell` is given a measurement and the same one of the first renderer.
fn print_table(measurements: &[Measurement], threads: usize, cell: fn(&Measurement, Option<&Measurement>) -> String) {
    let of_count = |one: &&Measurement| one.threads == one.peer.useful_threads(threads);
    let mut peers: Vec<Peer> = measurements.iter().filter(of_count).map(|one| one.peer).collect();
    peers.sort_unstable();
    peers.dedup();
    let mut scenes: Vec<SceneName> = measurements.iter().filter(of_count).map(|one| one.scene).collect();
    scenes.sort_unstable();
    scenes.dedup();

    let mut rows = vec![vec!["scene".to_owned()]];
    rows[0].extend(peers.iter().map(|&peer| heading(peer, threads)));
    for scene in scenes {
        let find = |peer| measurements.iter().filter(of_count).find(|one| one.scene == scene && one.peer == peer);
        let mut row = vec![scene.as_str().to_owned()];
        row.extend(peers.iter().map(|&peer| find(peer).map_or_else(String::new, |one| cell(one, find(peers[0])))));
        rows.push(row);
    }
    print_rows(&rows);
}

fn heading(peer: Peer, threads: usize) -> String {
    let useful = peer.useful_threads(threads);
    if useful == threads { peer.as_str().to_owned() } else { format!("{} ({useful} thread)", peer.as_str()) }
}

fn time_cell(one: &Measurement, first: Option<&Measurement>) -> String {
    let ratio = first.filter(|first| first.peer != one.peer).map(|first| one.median_ms() / first.median_ms());
    format!("{:.2} ({:.2}){}", one.median_ms(), one.minimum_ms(), ratio_text(ratio))
}

fn cpu_cell(one: &Measurement, first: Option<&Measurement>) -> String {
    let Some(cpu_ms) = one.cpu_ms() else { return "unknown".to_owned() };
    let first = first.filter(|first| first.peer != one.peer).and_then(Measurement::cpu_ms);
    format!("{cpu_ms:.2}{}", ratio_text(first.map(|first| cpu_ms / first)))
}

fn memory_cell(one: &Measurement, _: Option<&Measurement>) -> String {
    one.peak_mib.map_or_else(|| "unknown".to_owned(), |mib| format!("{mib:.0}"))
}

/// How many times as long the best peer takes, scene by scene.
pub(crate) fn best_ratios(measurements: &[Measurement], threads: usize) -> Vec<(SceneName, f64)> {
    let of_count = |one: &&Measurement| one.threads == one.peer.useful_threads(threads);
    let ours = measurements.iter().filter(of_count).filter(|one| one.peer == Peer::Pineda);
    ours.filter_map(|ours| {
        let peers = measurements.iter().filter(of_count);
        let peers = peers.filter(|one| one.scene == ours.scene && one.peer != Peer::Pineda);
        let best = peers.map(Measurement::median_ms).reduce(f64::min)?;
        Some((ours.scene, best / ours.median_ms()))
    })
    .collect()
}

/// The geometric mean of [`best_ratios`].
pub(crate) fn mean(ratios: &[(SceneName, f64)]) -> f64 {
    (ratios.iter().map(|(_, ratio)| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp()
}

fn print_mean(measurements: &[Measurement], threads: usize) {
    let ratios = best_ratios(measurements, threads);
    if let Some((scene, least)) = ratios.iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
        let (count, scene) = (ratios.len(), scene.as_str());
        println!(
            "\nThe best peer takes {:.1} times as long, on geometric average over {count} scenes; at least {least:.1} times ({scene}).",
            mean(&ratios)
        );
    }
}

/// How near a picture of layers comes to what must be written anyway.
fn print_fill(results: &Results, threads: usize) {
    let Some(&(_, rate)) = results.write_bandwidths.iter().find(|(count, _)| *count == threads) else { return };
    println!("A plain loop writes {rate:.1} GB/s (threads: {threads}).");
    for scene in [SceneName::FillFrontToBack, SceneName::FillBackToFront] {
        let ours = |one: &&Measurement| one.peer == Peer::Pineda && one.scene == scene && one.threads == threads;
        if let Some(ours) = results.measurements.iter().find(ours) {
            let [width, height] = Scene::new(scene).size;
            let least_ms = f64::from(4 * width * height) / rate / 1e6;
            let name = scene.as_str();
            println!(
                "Writing the picture of {name} so takes {least_ms:.2} ms, {:.0} % of the frame's time.",
                100.0 * least_ms / ours.median_ms()
            );
        }
    }
}

fn ratio_text(ratio: Option<f64>) -> String {
    ratio.map_or_else(String::new, |ratio| format!(" {ratio:.1}x"))
}

/// The first row is the heading; all columns but the first are numbers.
fn print_rows(rows: &[Vec<String>]) {
    let widths: Vec<usize> =
        (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column].len()).max().unwrap_or(0)).collect();
    for (number, row) in rows.iter().enumerate() {
        let mut line = format!("| {:<width$} |", row[0], width = widths[0]);
        for (text, width) in row.iter().zip(&widths).skip(1) {
            line += &format!(" {text:>width$} |");
        }
        println!("{line}");
        if number == 0 {
            let rules: Vec<String> = widths[1..].iter().map(|width| format!(" {}: |", "-".repeat(width - 1))).collect();
            println!("| {} |{}", "-".repeat(widths[0]), rules.concat());
        }
    }
}

fn print_likenesses(results: &Results) {
    println!("\npixels that differ by more than 2 codes");
    for one in &results.likenesses {
        let verdict = if one.is_alike() { "alike" } else { "NOT THE SAME PICTURE" };
        let (scene, peer, reference) = (one.scene.as_str(), one.peer.as_str(), one.reference.as_str());
        println!("- {scene}: {peer} against {reference} {:.3} %, {verdict}", 100.0 * one.differing);
    }
}
