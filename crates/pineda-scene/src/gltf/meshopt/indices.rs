//! Modes 1 and 2: indices of triangles, and of anything else.

use super::{Stream, cut_short, unzigzag};

/// Mode 2: each index as a difference from one of two that came before.
pub(super) fn sequence(bytes: &[u8], count: usize) -> Result<Vec<u32>, String> {
    const TAIL: usize = 4;
    let end = bytes.len().checked_sub(TAIL).filter(|&end| end >= 1).ok_or_else(cut_short)?;
    if bytes[0] & 0xf0 != 0xd0 || bytes[0] & 15 > 1 {
        return Err("its compressed data are of no known version".to_owned());
    }
    let mut stream = Stream(&bytes[1..end]);
    // Each takes a byte at least.
    if count > stream.0.len() {
        return Err(cut_short());
    }
    let mut last = [0u32; 2];
    let mut indices = Vec::with_capacity(count);
    for _ in 0..count {
        let number = stream.number()?;
        let last = &mut last[(number & 1) as usize];
        *last = last.wrapping_add(unzigzag(number >> 1));
        indices.push(*last);
    }
    stream.end()?;
    Ok(indices)
}

/// Mode 1: a byte for each triangle says which of the edges and vertices of late it has; further bytes, what is new.
pub(super) fn triangles(bytes: &[u8], count: usize) -> Result<Vec<u32>, String> {
    const TAIL: usize = 16;
    let tail = bytes.len().checked_sub(TAIL).filter(|&tail| tail >= 1).ok_or_else(cut_short)?;
    if bytes[0] & 0xf0 != 0xe0 || bytes[0] & 15 > 1 {
        return Err("its compressed data are of no known version".to_owned());
    }
    if !count.is_multiple_of(3) {
        return Err(format!("{count} indices are no triangles"));
    }
    let (table, mut stream) = (&bytes[tail..], Stream(&bytes[1..tail]));
    let codes = stream.take(count / 3)?;
    let mut decoder = Triangles { next: 0, last: 0, edges: Fifo::default(), vertices: Fifo::default(), stream };
    let mut indices = Vec::with_capacity(count);
    for &code in codes {
        indices.extend(decoder.triangle(code, table)?);
    }
    decoder.stream.end()?;
    Ok(indices)
}

struct Triangles<'a> {
    /// The smallest index that has not come yet.
    next: u32,
    /// The last index that was given in full.
    last: u32,
    edges: Fifo<[u32; 2]>,
    vertices: Fifo<u32>,
    stream: Stream<'a>,
}

impl Triangles<'_> {
    fn triangle(&mut self, code: u8, table: &[u8]) -> Result<[u32; 3], String> {
        let (high, low) = (code >> 4, code & 15);
        if high < 15 {
            return self.at_edge(high, low);
        }
        let (first_is_next, pair) = match low {
            0..14 => (true, table[usize::from(low)]),
            _ => {
                let pair = self.stream.byte()?;
                if pair == 0 {
                    self.next = 0;
                }
                (low == 14, pair)
            }
        };
        let a = if first_is_next { self.new_vertex() } else { self.given_vertex()? };
        let (b, b_is_new) = self.vertex(pair >> 4)?;
        let (c, c_is_new) = self.vertex(pair & 15)?;
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        self.vertices.push(a);
        for (vertex, is_new) in [(b, b_is_new), (c, c_is_new)] {
            if is_new {
                self.vertices.push(vertex);
            }
        }
        Ok([a, b, c])
    }

    /// A triangle at an edge of late.
    fn at_edge(&mut self, edge: u8, third: u8) -> Result<[u32; 3], String> {
        let [a, b] = self.edges.get(edge);
        let c = match third {
            0 => self.new_vertex(),
            1..13 => self.vertices.get(third),
            13 | 14 => {
                self.last = if third == 13 { self.last.wrapping_sub(1) } else { self.last.wrapping_add(1) };
                self.last
            }
            _ => self.given_vertex()?,
        };
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        if !(1..13).contains(&third) {
            self.vertices.push(c);
        }
        Ok([a, b, c])
    }

    /// A vertex by four bits, and whether it is one that has not been seen of late.
    fn vertex(&mut self, code: u8) -> Result<(u32, bool), String> {
        Ok(match code {
            0 => (self.new_vertex(), true),
            15 => (self.given_vertex()?, true),
            code => (self.vertices.get(code - 1), false),
        })
    }

    fn new_vertex(&mut self) -> u32 {
        let vertex = self.next;
        self.next = self.next.wrapping_add(1);
        vertex
    }

    fn given_vertex(&mut self) -> Result<u32, String> {
        self.last = self.last.wrapping_add(unzigzag(self.stream.number()?));
        Ok(self.last)
    }
}

/// The last sixteen of something. What was never written is 0: an index that is checked like any other.
#[derive(Default)]
struct Fifo<T> {
    entries: [T; 16],
    next: usize,
}

impl<T: Copy> Fifo<T> {
    fn push(&mut self, entry: T) {
        self.entries[self.next] = entry;
        self.next = (self.next + 1) % 16;
    }

    /// 0 is the last one that was written.
    fn get(&self, back: u8) -> T {
        self.entries[(self.next + 15 - usize::from(back)) % 16]
    }
}
