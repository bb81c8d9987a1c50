//! The file of `pineda raster`.

use super::make::utf16;
use super::{Blank, Case, Error, Picture, Wanted, case};

const GOOD: &str = r#"{"size": [32, 32], "vertices": [{"position": [1, 1], "color": [1, 0, 0]}, {"position": [30, 2]}, {"position": [3, 30]}], "triangles": [[0, 1, 2]]}"#;

pub(super) fn cases() -> Vec<Case> {
    let of = |name, text: &str, wanted: Wanted| case(name, "a.json", text, wanted).options(&["raster"]);
    let with = |name, from: &str, to: &str, wanted| {
        assert!(GOOD.contains(from));
        of(name, &GOOD.replace(from, to), wanted)
    };
    let clip = |name, position: &str, wanted| {
        with(name, "{\"size\": [32, 32],", "{\"size\": [32, 32], \"space\": \"clip\",", wanted)
            .edited("[30, 2]", position)
    };
    vec![
        of("raster-good", GOOD, Picture(&[])),
        of("raster-empty", "", Error(&["EOF", "line 1"])),
        of("raster-cut-short", &GOOD[..60], Error(&["EOF", "line 1"])),
        of("raster-list", "[]", Error(&["line 1"])),
        of("raster-deep", &"[".repeat(100_000), Error(&["line 1"])),
        of("raster-key-unknown", &GOOD.replace("\"size\"", "\"shape\""), Error(&["unknown field `shape`"])),
        of(
            "raster-key-twice",
            &GOOD.replace("{\"size\"", "{\"size\": [1, 1], \"size\""),
            Error(&["duplicate field `size`"]),
        ),
        of("raster-mark", &format!("\u{feff}{GOOD}"), Picture(&[])),
        case("raster-utf16", "a.json", utf16(GOOD), Error(&["line 1", "UTF-16"])).options(&["raster"]),
        with("raster-size-0", "[32, 32]", "[0, 32]", Error(&["1 to 16384"])),
        with("raster-size-huge", "[32, 32]", "[4000000000, 4000000000]", Error(&["1 to 16384"])),
        with("raster-size-negative", "[32, 32]", "[-1, 32]", Error(&["line 1"])),
        with(
            "raster-index-out-of-range",
            "[0, 1, 2]",
            "[0, 1, 3]",
            Error(&["triangles[0][2]", "index 3", "there are 3"]),
        ),
        with("raster-index-negative", "[0, 1, 2]", "[0, 1, -2]", Error(&["line 1"])),
        with("raster-triangle-of-two", "[0, 1, 2]", "[0, 1]", Error(&["line 1"])),
        with("raster-position-of-one", "[30, 2]", "[30]", Error(&["1 numbers, expected 2 to 4"])),
        with("raster-position-infinite", "[30, 2]", "[1e999, 2]", Error(&["number out of range"])),
        with("raster-position-too-large", "[30, 2]", "[1e300, 2]", Error(&["number out of range"])),
        with("raster-position-largest", "[30, 2]", "[3.4e38, -3.4e38]", Picture(&[])),
        with("raster-depth-twice", "[30, 2]", "[30, 2, 0.5], \"depth\": 1", Error(&["vertices[1]", "give it once"])),
        with("raster-w-0", "[30, 2]", "[30, 2, 0, 0]", Error(&["vertices[1]", "w must be above 0"])),
        with("raster-w-tiny", "[30, 2]", "[30, 2, 0, 1e-45]", Picture(&[])),
        clip("raster-clip-behind", "[0.5, 0.5, 0.5, -1]", Blank(&[])),
        clip("raster-clip-nowhere", "[0, 0, 0, 0]", Blank(&[])),
        clip("raster-clip-largest", "[3.4e38, -3.4e38, 3.4e38, 3.4e38]", Blank(&[])),
        with("raster-colour-huge", "[1, 0, 0]", "[3e38, -3e38, 0, 3e38]", Picture(&[])),
        with("raster-background-nan", "{\"size\"", "{\"background\": [NaN, 0, 0], \"size\"", Error(&["line 1"])),
        with("raster-without-triangles", "[[0, 1, 2]]", "null", Picture(&[])),
    ]
}

impl Case {
    fn edited(mut self, from: &str, to: &str) -> Self {
        let text = String::from_utf8(self.files[0].1.clone()).unwrap();
        self.files[0].1 = text.replace(from, to).into();
        self
    }
}
