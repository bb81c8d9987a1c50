//! *How* to draw: every combination that must not matter.

use pineda::{Renderer, Settings, Simd, TileSize};

/// Every SIMD level of this machine with 1, 2 and 7 threads and every tile size.
pub fn every_setting() -> Vec<Settings> {
    let mut all = Vec::new();
    for simd in Simd::available() {
        for threads in [1, 2, 7] {
            for tile in TileSize::ALL {
                all.push(Settings { simd, threads, tile, ..Settings::default() });
            }
        }
    }
    all
}

/// A renderer for each setting, kept from one case to the next: so that whatever a pass leaves in one is proved harmless to the next, too.
#[derive(Debug)]
pub struct Renderers(Vec<Renderer>);

impl Default for Renderers {
    fn default() -> Self {
        let renderer = |settings| Renderer::new(settings).expect("an available level");
        Self(every_setting().into_iter().map(renderer).collect())
    }
}

impl Renderers {
    /// The renderer of `every_setting()[n]`, counted round.
    pub fn nth(&mut self, n: u64) -> &mut Renderer {
        let count = self.0.len() as u64;
        &mut self.0[(n % count) as usize]
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.0.len() as u64
    }
}
