//! Files that are no files: folders, pipes, devices, links; and names that lead elsewhere.

use super::make::Gltf;
use super::{Error, Folder, Picture, Wanted, problem};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

fn pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// `options` as in a [`Case`](super::Case).
fn check(name: &str, file: &str, options: &[&str], wanted: Wanted, make: impl Fn(&Path)) {
    let folder = Folder::new(&format!("places-{name}"));
    make(&folder.0);
    if let Some(problem) = problem(&folder.0, file, options, wanted) {
        panic!("{name}: {problem}");
    }
}

/// What is read first, whatever reads it.
const READERS: [(&str, &[&str]); 5] = [
    ("a.obj", &["--shading", "unlit"]),
    ("a", &["--shading", "unlit", "--model-format", "gltf"]),
    ("a.json", &["raster"]),
    ("a.hdr", &["--environment"]),
    ("a.exr", &["--environment"]),
];

#[test]
fn malformed_places_of_the_file_itself() {
    for (number, (file, options)) in READERS.iter().enumerate() {
        let check = |what: &str, says: &'static [&'static str], make: &dyn Fn(&Path)| {
            check(&format!("{what}-{number}"), file, options, Error(says), |folder| make(&folder.join(file)));
        };
        check("missing", &["cannot be read", "No such file"], &|_| ());
        check("folder", &["cannot be read", "is a directory"], &|path| fs::create_dir(path).unwrap());
        check("pipe", &["cannot be read", "not a regular file"], &pipe);
        check("endless", &["cannot be read", "not a regular file"], &|path| symlink("/dev/zero", path).unwrap());
        check("link-to-itself", &["cannot be read", "symbolic links"], &|path| symlink(path, path).unwrap());
    }
}

#[test]
fn malformed_places_of_files_beside_it() {
    let gltf = |name: &str, uri: &str, says: &'static [&'static str], make: &dyn Fn(&Path)| {
        check(name, "a.gltf", &["--shading", "unlit"], Error(says), |folder| {
            fs::write(folder.join("a.gltf"), Gltf::plain().text_with(uri)).unwrap();
            make(&folder.join("a.bin"));
        });
    };
    gltf("buffer-folder", "a.bin", &["'a.bin'", "is a directory"], &|path| fs::create_dir(path).unwrap());
    gltf("buffer-pipe", "a.bin", &["'a.bin'", "not a regular file"], &pipe);
    gltf("buffer-endless", "a.bin", &["'a.bin'", "not a regular file"], &|path| symlink("/dev/zero", path).unwrap());
    gltf("buffer-link-to-itself", "a.bin", &["'a.bin'", "symbolic links"], &|path| symlink(path, path).unwrap());
    let outside = &["which is not in the model's folder"];
    gltf("buffer-above", "../a.bin", outside, &|_| ());
    gltf("buffer-above-in-percents", "%2e%2e%2Fa.bin", outside, &|_| ());
    gltf("buffer-above-after-all", "a/../../a.bin", outside, &|_| ());
    gltf("buffer-absolute", "/dev/zero", outside, &|_| ());
    gltf("buffer-of-file-scheme", "file:///dev/zero", outside, &|_| ());
    gltf("buffer-on-the-network", "http://127.0.0.1/a.bin", outside, &|_| ());
    gltf("buffer-of-windows", "C:\\a.bin", outside, &|_| ());
    gltf("buffer-of-a-share", "\\\\127.0.0.1\\a.bin", outside, &|_| ());

    let obj = |name: &str, says: &'static [&'static str], make: &dyn Fn(&Path)| {
        check(name, "a.obj", &["--shading", "unlit"], Picture(says), |folder| {
            fs::write(
                folder.join("a.obj"),
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n",
            )
            .unwrap();
            make(folder);
        });
    };
    obj("library-pipe", &["a.mtl", "not a regular file"], &|folder| pipe(&folder.join("a.mtl")));
    obj("library-endless", &["a.mtl", "not a regular file"], &|folder| {
        symlink("/dev/zero", folder.join("a.mtl")).unwrap();
    });
    obj("image-pipe", &["image 'b.png'", "not a regular file"], &|folder| {
        fs::write(folder.join("a.mtl"), "newmtl a\nmap_Kd b.png\n").unwrap();
        pipe(&folder.join("b.png"));
    });
}

/// As documented: links may lead anywhere, for whoever made them could have copied the file.
#[test]
fn malformed_places_are_not_links_that_lead_elsewhere() {
    check("link", "a.gltf", &["--shading", "unlit"], Picture(&[]), |folder| {
        fs::create_dir(folder.join("elsewhere")).unwrap();
        fs::write(folder.join("elsewhere/b.bin"), Gltf::plain().binary).unwrap();
        fs::write(folder.join("a.gltf"), Gltf::plain().text_with("a.bin")).unwrap();
        symlink("elsewhere/b.bin", folder.join("a.bin")).unwrap();
    });
}
