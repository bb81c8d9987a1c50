//! Completions and manual pages.

use crate::workspace::Workspace;

#[test]
fn shell_completions() {
    let folder = Workspace::new("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = folder.run(&["completions", shell]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        assert!(run.stdout.contains("shading") && run.stdout.contains("pineda"), "{shell}");
    }
    folder.fail(&["completions", "tcsh"], 2, &["tcsh", "bash"]);
}

#[test]
fn shell_manual_pages() {
    let folder = Workspace::new("man");
    for (arguments, parts) in [
        (&["man"][..], [".TH pineda", "render"]),
        (&["man", "render"], [".TH pineda-render", "azimuth"]),
        (&["man", "info"], [".TH pineda-info", "json"]),
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        for part in parts {
            assert!(run.stdout.contains(part), "{arguments:?}: no {part} in {}", &run.stdout[..400]);
        }
    }
    folder.fail(&["man", "paint"], 2, &["no command paint", "render, info, raster"]);
}
