//! Files are written whole or not at all.

use crate::workspace::Workspace;
use std::fs;

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Workspace::new("outputs");
    fs::create_dir(folder.path("folder.png")).unwrap();
    folder.fail(&["raster", "-o", "picture.gif"], 2, &[".png, .jpg,", "picture.gif", "help: "]);
    folder.fail(&["raster", "-o", "picture"], 2, &["or .ppm"]);
    folder.fail(&["raster", "-o", "picture.exr"], 2, &["EXR is for"]);
    folder.fail(&["raster", "-o", "picture.jpg", "--show", "depth"], 2, &["16 bits"]);
    folder.fail(&["raster", "-o", "folder.png"], 1, &["it is a folder", "where: folder.png"]);
    folder.fail(
        &["raster", "-o", "nowhere/picture.png"],
        1,
        &["its folder does not exist", "where: nowhere/picture.png"],
    );
}

#[test]
fn outputs_replace_what_was_there() {
    let folder = Workspace::new("replace");
    folder.write("picture.ppm", "something else");
    folder.succeed(&["raster", "-o", "picture.ppm"]);
    assert!(folder.read("picture.ppm").starts_with(b"P6\n512 512\n255\n"));
    assert_eq!(folder.files(), ["picture.ppm"]);
}

#[test]
fn outputs_survive_a_failure() {
    let folder = Workspace::new("survive");
    folder.write("picture.png", "precious");
    folder.write("broken.json", "{");
    folder.fail(&["raster", "broken.json", "-o", "picture.png"], 1, &["line 1"]);
    folder.fail(&["render", "missing.obj", "-o", "picture.png"], 1, &["missing.obj"]);
    assert_eq!(folder.read("picture.png"), b"precious");
}

#[test]
#[cfg(unix)]
fn outputs_that_are_read_only_stay_as_they_are() {
    let folder = Workspace::new("read-only");
    folder.write("picture.png", "precious");
    let mut permissions = fs::metadata(folder.path("picture.png")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(folder.path("picture.png"), permissions).unwrap();
    folder.fail(&["raster", "-o", "picture.png"], 1, &["read-only"]);
    assert_eq!(folder.read("picture.png"), b"precious");
}

#[test]
#[cfg(unix)]
fn outputs_through_a_link_replace_what_it_leads_to() {
    let folder = Workspace::new("link");
    folder.write("there.ppm", "");
    std::os::unix::fs::symlink("there.ppm", folder.path("link.ppm")).unwrap();
    folder.succeed(&["raster", "-o", "link.ppm"]);
    assert!(folder.read("there.ppm").starts_with(b"P6"));
    assert!(fs::symlink_metadata(folder.path("link.ppm")).unwrap().is_symlink());
}

/// A disk that is full: the picture's file does not come into being.
#[test]
#[cfg(target_os = "linux")]
fn outputs_on_a_full_disk() {
    let folder = Workspace::new("full");
    std::os::unix::fs::symlink("/dev/full", folder.path("full.png")).unwrap();
    folder.fail(&["raster", "-o", "full.png"], 1, &["cannot be written", "where: full.png"]);
}
