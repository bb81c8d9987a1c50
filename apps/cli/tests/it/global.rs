//! Options of every command, help, and standard streams.

use crate::workspace::Workspace;
use std::process::Stdio;

#[test]
fn global_help_has_examples_for_each_command() {
    let folder = Workspace::new("help");
    for (arguments, part) in [
        (&["--help"][..], "pineda render -o picture.png"),
        (&["raster", "--help"], "\"triangles\": [[0, 1, 2]]"),
        (&["raster", "-h"], "pineda raster -o raster2d.ppm"),
        (&["render", "--help"], "pineda render spot.obj -o spot.png"),
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
        assert!(run.stdout.contains("Examples:") && run.stdout.contains(part), "{arguments:?}: {}", run.stdout);
    }
}

#[test]
fn global_bad_usage_is_2() {
    let folder = Workspace::new("usage");
    folder.fail(&["paint"], 2, &["paint"]);
    folder.fail(&["raster"], 2, &["--output"]);
    folder.fail(&["raster", "-o", "a.png", "--colour"], 2, &["--colour"]);
    folder.fail(&["raster", "-o", "a.png", "--threads", "0"], 2, &["--threads"]);
    folder.fail(&["raster", "-o", "a.png", "--threads", "many"], 2, &["--threads"]);
    folder.fail(&["raster", "-o", "a.png", "--simd", "mmx"], 2, &["mmx", "sse4.2"]);
    let foreign = if cfg!(target_arch = "aarch64") { "avx2" } else { "neon" };
    folder.fail(&["raster", "-o", "a.png", "--simd", foreign], 2, &["this machine has no", foreign, "scalar"]);
    assert_eq!(folder.run(&[]).code, 2);
}

#[test]
fn global_settings_change_no_byte() {
    let folder = Workspace::new("settings");
    folder.succeed(&["render", "-o", "auto.png", "--size", "64x48"]);
    folder.succeed(&["render", "-o", "one.png", "--size", "64x48", "--threads", "1", "--simd", "scalar"]);
    folder.succeed(&["--threads", "7", "render", "-o", "seven.png", "--size", "64x48"]);
    assert_eq!(folder.read("one.png"), folder.read("auto.png"));
    assert_eq!(folder.read("seven.png"), folder.read("auto.png"));
}

/// `pineda --help | head -1`.
#[test]
fn global_broken_pipe_is_no_panic() {
    let folder = Workspace::new("pipe");
    let mut child =
        folder.command(&["raster", "--help"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"));
}
