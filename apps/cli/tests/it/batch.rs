//! Several models at a time.

use crate::workspace::Workspace;
use serde_json::Value;
use std::fs;
use std::time::{Duration, SystemTime};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const SMALL: [&str; 4] = ["--out-dir", "out", "--size", "8x8"];

/// Two models that are fine, and two that are not.
fn folder(name: &str) -> Workspace {
    let folder = Workspace::new(name);
    folder.write("a.obj", TRIANGLE);
    folder.write("b.obj", "v 0 0 0\nf 1 2 3\n");
    folder.write("c.obj", TRIANGLE);
    folder
}

fn files(folder: &Workspace) -> Vec<String> {
    let names =
        fs::read_dir(folder.path("out")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn batch_draws_what_is_good_and_lists_what_is_not() {
    let folder = folder("batch");
    for jobs in ["1", "3"] {
        let models = ["render", "a.obj", "b.obj", "missing.obj", "c.obj", "--jobs", jobs];
        let run = folder.run(&[&models[..], &SMALL].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""));
        for part in ["where: b.obj", "line 2", "where: missing.obj", "2 of 4 models"] {
            assert!(run.stderr.contains(part), "no {part} in {}", run.stderr);
        }
        assert!(run.stderr.find("b.obj") < run.stderr.find("missing.obj"), "in the order in which they were named");
        assert_eq!(files(&folder), ["a.png", "c.png"]);
    }
    folder.succeed(&["render", "a.obj", "-o", "alone.png", "--size", "8x8"]);
    assert_eq!(folder.read("out/a.png"), folder.read("alone.png"));
}

#[test]
fn batch_reports_for_programs() {
    let folder = folder("report");
    let run = folder.run(&[&["render", "a.obj", "b.obj", "--json"], &SMALL[..]].concat());
    assert_eq!(run.code, 1);
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(["drawn", "failed", "skipped"].map(|what| report[what].as_u64().unwrap()), [1, 1, 0]);
    let [good, bad] = [&report["models"][0], &report["models"][1]];
    assert_eq!(["input", "status"].map(|what| good[what].as_str().unwrap()), ["a.obj", "drawn"]);
    assert_eq!(good["size"], serde_json::json!([8, 8]));
    assert!(good["output"].as_str().unwrap().ends_with("a.png") && good["seconds"].is_number());
    assert_eq!([&bad["status"], &bad["error"]["place"]].map(|text| text.as_str().unwrap()), ["failed", "b.obj"]);
    assert!(bad["error"]["message"].as_str().unwrap().contains("line 2"));
    // Of one model, too; notes are in the report and nowhere else.
    folder.write("d.obj", "mtllib gone.mtl\n".to_owned() + TRIANGLE);
    let run = folder.run(&["render", "d.obj", "-o", "d.png", "--size", "8x8", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert!(report["models"][0]["notes"][0].as_str().unwrap().contains("gone.mtl"), "{report}");
}

#[test]
fn batch_resumes() {
    let folder = folder("resume");
    let resume = [&["render", "a.obj", "c.obj", "--resume", "--json"], &SMALL[..]].concat();
    let statuses = || {
        let report: Value = serde_json::from_str(&folder.run(&resume).stdout).unwrap();
        [0, 1].map(|k| report["models"][k]["status"].as_str().unwrap().to_owned())
    };
    assert_eq!(statuses(), ["drawn", "drawn"]);
    assert_eq!(statuses(), ["skipped", "skipped"]);
    fs::remove_file(folder.path("out/a.png")).unwrap();
    assert_eq!(statuses(), ["drawn", "skipped"]);
    let model = fs::File::options().append(true).open(folder.path("c.obj")).unwrap();
    model.set_modified(SystemTime::now() + Duration::from_secs(60)).unwrap();
    assert_eq!(statuses(), ["skipped", "drawn"]);
}

#[test]
fn batch_of_the_same_names() {
    let folder = Workspace::new("same-names");
    for path in ["chairs", "tables"] {
        fs::create_dir(folder.path(path)).unwrap();
        folder.write(&format!("{path}/a.obj"), TRIANGLE);
    }
    folder.write("chairs/a.ply", TRIANGLE);
    let both = ["render", "chairs/a.obj", "tables/a.obj"];
    let parts = ["the same picture", "chairs/a.obj", "tables/a.obj", "--keep-folders"];
    folder.fail(&[&both[..], &SMALL].concat(), 2, &parts);
    folder.succeed(&[&both[..], &SMALL, &["--keep-folders"]].concat());
    assert_eq!(folder.read("out/chairs/a.png"), folder.read("out/tables/a.png"));
    let keep = [&SMALL[..], &["--keep-folders"]].concat();
    folder.fail(&[&["render", "chairs/a.obj", "chairs/a.ply"], &keep[..]].concat(), 2, &["two runs"]);
    folder.fail(&[&["render", "chairs/a.obj", "chairs/a.obj"], &keep[..]].concat(), 2, &["name it once"]);
    folder.fail(&[&["render", "../a.obj"], &keep[..]].concat(), 2, &["`..`"]);
}

#[test]
fn batch_usage() {
    let folder = folder("batch-usage");
    folder.fail(&["render", "a.obj", "c.obj", "-o", "a.png"], 2, &["2 models", "--out-dir"]);
    folder.fail(&["render", "--out-dir", "out"], 2, &["no models", "help: "]);
    folder.fail(&["render", "a.obj"], 2, &["--output"]);
    folder.fail(&["render", "a.obj", "-o", "a.png", "--out-dir", "out"], 2, &["cannot be used"]);
    folder.fail(&["render", "a.obj", "-o", "a.png", "--resume"], 2, &["--resume"]);
    folder.fail(&["render", "a.obj", "--out-dir", "a.obj"], 1, &["folder for pictures", "where: a.obj"]);
    folder.succeed(&["render", "a.obj", "--out-dir", "deep/er", "--size", "8x8", "--picture-format", "webp"]);
    assert!(folder.read("deep/er/a.webp").starts_with(b"RIFF"));
}
