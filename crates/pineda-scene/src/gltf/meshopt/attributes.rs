//! Mode 0: elements of any kind, as differences from one to the next.
//!
//! ```text
//! header byte | blocks ... | padding | baseline element | channel modes (version 1)
//!
//! block:  control bits, 2 for each byte of an element (version 1)
//!         for each byte of an element: the differences of up to 256 elements, in groups of 16
//! group:  16 numbers of 0, 1, 2, 4 or 8 bits; one with all bits set stands for a whole byte behind them
//! ```
//!
//! Four bytes of an element are a channel. Its mode says what its differences are: of bytes, of 16-bit numbers, or the
//! bits that have changed.

use super::{Stream, cut_short, unzigzag};

const GROUP: usize = 16;
const BLOCK: usize = 256;
const BLOCK_BYTES: usize = 8192;

pub(super) fn decode(bytes: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    let is_newer = match bytes.first() {
        Some(0xa0) => false,
        Some(0xa1) => true,
        _ => return Err("its compressed data are of no known version".to_owned()),
    };
    let channels = stride / 4;
    let (tail, least) = if is_newer { (stride + channels, 24) } else { (stride, 32) };
    let padded = tail.max(least);
    let blocks_end = bytes.len().checked_sub(padded).filter(|&end| end >= 1).ok_or_else(cut_short)?;
    let (baseline, modes) = bytes[bytes.len() - tail..].split_at(stride);
    let modes: Vec<Mode> = match is_newer {
        true => modes.iter().map(|&mode| Mode::of(mode)).collect::<Result<_, _>>()?,
        false => vec![Mode::Bytes; channels],
    };

    let mut stream = Stream(&bytes[1..blocks_end]);
    let in_block = ((BLOCK_BYTES / stride) & !(GROUP - 1)).min(BLOCK);
    // Each block has its control bits at least, or else the headers of its groups.
    let least = count.div_ceil(in_block).saturating_mul(if is_newer { channels } else { stride });
    if stream.0.len() < least {
        return Err(cut_short());
    }
    let size = count.checked_mul(stride).ok_or_else(cut_short)?;
    let mut decoded = vec![0; size];
    let mut last = baseline.to_vec();
    for block in decoded.chunks_mut(in_block * stride) {
        let elements = block.len() / stride;
        let controls = if is_newer { stream.take(channels)? } else { &[] };
        for (channel, mode) in modes.iter().enumerate() {
            let mut differences = [[0; BLOCK]; 4];
            for (byte, differences) in differences.iter_mut().enumerate() {
                let control = controls.get(channel).map(|controls| controls >> (2 * byte) & 3);
                read_bytes(&mut stream, control, &mut differences[..elements])?;
            }
            let last = last[4 * channel..].first_chunk_mut().ok_or_else(cut_short)?;
            for (element, values) in block.chunks_exact_mut(stride).enumerate() {
                *last = mode.add(*last, differences.map(|of_byte| of_byte[element]));
                values[4 * channel..4 * channel + 4].copy_from_slice(last);
            }
        }
    }
    stream.end()?;
    Ok(decoded)
}

/// What a channel's differences are.
#[derive(Clone, Copy)]
enum Mode {
    Bytes,
    Words,
    /// Bits that have changed, turned to the left by so many places.
    Bits(u32),
}

impl Mode {
    fn of(code: u8) -> Result<Self, String> {
        match (code & 15, code >> 4) {
            (0, 0) => Ok(Self::Bytes),
            (1, 0) => Ok(Self::Words),
            (2, turn) => Ok(Self::Bits(u32::from(turn))),
            _ => Err(format!("channel mode {code} does not exist")),
        }
    }

    fn add(self, last: [u8; 4], difference: [u8; 4]) -> [u8; 4] {
        match self {
            Self::Bytes => std::array::from_fn(|i| last[i].wrapping_add(unzigzag(u32::from(difference[i])) as u8)),
            Self::Words => {
                let word = |of: [u8; 4], i: usize| u16::from_le_bytes([of[2 * i], of[2 * i + 1]]);
                let sum = |i: usize| {
                    let difference = unzigzag(u32::from(word(difference, i))) as u16;
                    word(last, i).wrapping_add(difference).to_le_bytes()
                };
                let [[a, b], [c, d]] = [sum(0), sum(1)];
                [a, b, c, d]
            }
            Self::Bits(turn) => {
                let changed = u32::from_le_bytes(difference).rotate_right(turn);
                (u32::from_le_bytes(last) ^ changed).to_le_bytes()
            }
        }
    }
}

/// The differences of one byte of a block's elements.
fn read_bytes(stream: &mut Stream<'_>, control: Option<u8>, out: &mut [u8]) -> Result<(), String> {
    let bits = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        // All zero, as `out` is.
        Some(2) => return Ok(()),
        Some(_) => {
            out.copy_from_slice(stream.take(out.len())?);
            return Ok(());
        }
    };
    let groups = out.len().div_ceil(GROUP);
    let header = stream.take(groups.div_ceil(4))?;
    for (number, out) in out.chunks_mut(GROUP).enumerate() {
        let bits = bits[usize::from(header[number / 4] >> (2 * (number % 4)) & 3)];
        let group = read_group(stream, bits)?;
        out.copy_from_slice(&group[..out.len()]);
    }
    Ok(())
}

/// Sixteen numbers of so many bits.
fn read_group(stream: &mut Stream<'_>, bits: usize) -> Result<[u8; GROUP], String> {
    let mut group = [0; GROUP];
    let packed = stream.take(bits * GROUP / 8)?;
    match bits {
        0 => return Ok(group),
        8 => {
            group.copy_from_slice(packed);
            return Ok(group);
        }
        _ => {}
    }
    let sentinel = (1 << bits) - 1;
    let in_byte = 8 / bits;
    for (i, number) in group.iter_mut().enumerate() {
        // Single bits begin at the lowest, others at the highest.
        let place = if bits == 1 { i % 8 } else { 8 - bits * (i % in_byte + 1) };
        let short = packed[i / in_byte] >> place & sentinel;
        *number = if short == sentinel { stream.byte()? } else { short };
    }
    Ok(group)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The specification's own example.
    #[test]
    fn meshopt_group_of_four_bits() {
        let bytes = [0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5];
        let mut stream = Stream(&bytes);
        let group = read_group(&mut stream, 4).unwrap();
        assert!(stream.end().is_ok());
        let signed = group.map(|byte| unzigzag(u32::from(byte)) as i8);
        assert_eq!(signed, [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0]);
    }
}
