//! Textures of the scenes: noise and lines, with mip chains, the same bits everywhere.

/// Texels along each side of every texture; a power of two.
pub(crate) const SIZE: u32 = 1024;

/// 8-bit linear colours, all levels, the largest first, each row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Texture {
    pub(crate) levels: Vec<Vec<[u8; 4]>>,
}

impl Texture {
    /// Bricks: their colours, joints and grain depend on the seed.
    pub(super) fn bricks(seed: u32) -> Self {
        let hash = |x: u32, y: u32| {
            let h = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ seed).wrapping_mul(0xc2b2_ae3d);
            (h ^ h >> 15).wrapping_mul(0x2c1b_3c6d) >> 24
        };
        let texel = |x: u32, y: u32| {
            let row = y / 64;
            let across = (x + 64 * (row % 2)) % SIZE;
            let is_joint = y % 64 < 6 || across % 128 < 6;
            let (brick, grain) = (hash(across / 128, row + 99), hash(x, y) / 8);
            let tint = |base: u32, gain: u32| ((base + brick * gain / 256 + grain).min(255)) as u8;
            if is_joint {
                [tint(150, 0), tint(145, 0), tint(140, 0), 255]
            } else {
                [tint(120, 90), tint(60, 70), tint(45, 60), 255]
            }
        };
        let mut levels = vec![(0..SIZE * SIZE).map(|k| texel(k % SIZE, k / SIZE)).collect::<Vec<_>>()];
        let mut size = SIZE as usize;
        while size > 1 {
            let larger = &levels[levels.len() - 1];
            let half = size / 2;
            let smaller = (0..half * half).map(|k| {
                let at = 2 * (k / half) * size + 2 * (k % half);
                let four = [at, at + 1, at + size, at + size + 1].map(|i| larger[i].map(u16::from));
                std::array::from_fn(|c| ((four[0][c] + four[1][c] + four[2][c] + four[3][c] + 2) / 4) as u8)
            });
            let smaller = smaller.collect();
            levels.push(smaller);
            size = half;
        }
        Self { levels }
    }
}

/// A depth map of 16 bits: waves.
pub(super) fn waves() -> Vec<u16> {
    let wave = |k: u32| libm::sinf(std::f32::consts::TAU * 12.0 * k as f32 / SIZE as f32);
    (0..SIZE * SIZE).map(|k| (32_768.0 + 13_000.0 * wave(k % SIZE) * wave(k / SIZE)) as u16).collect()
}
