//! Standard input and output.

use crate::workspace::Workspace;
use std::io::Write;
use std::process::{Output, Stdio};

const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn pipe(folder: &Workspace, arguments: &[&str], input: &[u8]) -> Output {
    let mut command = folder.command(arguments);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // It may end before it has read all.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

#[test]
fn streams_take_a_model_and_give_a_picture() {
    let folder = Workspace::new("pipes");
    folder.write("a.obj", TRIANGLE);
    folder.succeed(&["render", "a.obj", "-o", "a.png", "--size", "8x8"]);
    let to_pipe = ["render", "-", "-o", "-", "--size", "8x8", "--picture-format", "png"];
    for more in [&[][..], &["--model-format", "obj"]] {
        let output = pipe(&folder, &[&to_pipe[..], more].concat(), TRIANGLE);
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        assert_eq!(output.stdout, folder.read("a.png"));
    }
    let output = pipe(&folder, &["raster", "-o", "-", "--picture-format", "ppm"], b"");
    assert!(output.stdout.starts_with(b"P6\n512 512"));
}

#[test]
fn streams_that_cannot_be() {
    let folder = Workspace::new("no-pipes");
    folder.fail(&["render", "-o", "-"], 2, &["--picture-format"]);
    folder.fail(&["render", "-o", "-", "--picture-format", "png", "--json"], 2, &["the report"]);
    folder.fail(&["render", "-", "-", "--out-dir", "."], 2, &["once"]);
    folder.fail(&["render", "-", "-o", "a.png"], 1, &["standard input", "--model-format"]);
    let output = pipe(&folder, &["render", "-", "-o", "a.png"], b"Dear Sir or Madam");
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no known format"));
    // The files that a model names cannot be found from there.
    let gltf = br#"{"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": 4}]}"#;
    let output = pipe(&folder, &["render", "-", "-o", "a.png"], gltf);
    assert_eq!((output.status.code(), folder.files().len()), (Some(1), 0), "{output:?}");
}
