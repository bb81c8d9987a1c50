//! All images of a model: decoded when they are first asked for, several at a time.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::decode::{Header, Kind, decode, header};
use crate::limits::Budget;
use crate::text::shown;
use crate::{Image, Limits};

/// An image before it is decoded.
#[derive(Debug)]
pub(crate) enum Encoded {
    /// Its file's bytes.
    Bytes(Arc<Vec<u8>>),
    /// Part of something that the reader has: what [`ImageStore::get`]'s `bytes_of` is asked for.
    Elsewhere,
    /// Why it is not there, as the end of a sentence that begins with its name.
    Missing(String),
}

/// A model's images by number.
#[derive(Debug, Default)]
pub(crate) struct ImageStore {
    /// Each image's name for people, and where it is.
    entries: Vec<(Arc<str>, Encoded)>,
    state: Mutex<State>,
    limits: Limits,
    /// Bytes of the model and all of its files.
    model_bytes: u64,
}

#[derive(Debug, Default)]
struct State {
    /// Parallel to the entries, or shorter.
    decoded: Vec<Option<Result<Arc<Image>, String>>>,
    pixels: u64,
    /// Bytes of the images that have been decoded; those that several images share, several times.
    bytes: u64,
}

/// An image that is about to be decoded.
struct Job<'a> {
    number: usize,
    bytes: &'a [u8],
    header: Header,
}

impl ImageStore {
    /// The files' bytes have been counted in `budget`.
    pub(crate) fn new(entries: Vec<(Arc<str>, Encoded)>, budget: &Budget) -> Self {
        Self { entries, state: Mutex::default(), limits: *budget.limits(), model_bytes: budget.bytes() }
    }

    /// The images with these numbers, or why they cannot be had, as one line each.
    pub(crate) fn get<'a>(
        &'a self,
        numbers: &[usize],
        bytes_of: impl Fn(usize) -> Result<&'a [u8], String>,
    ) -> Vec<Result<Arc<Image>, String>> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.decoded.resize(self.entries.len(), None);
        let mut jobs: Vec<Job<'_>> = Vec::new();
        for &number in numbers {
            if state.decoded[number].is_some() {
                continue;
            }
            // Taken now, so that a number that comes twice is one job.
            state.decoded[number] = Some(Err(String::new()));
            match self.job(number, &bytes_of, &mut state) {
                Ok(job) => jobs.push(job),
                Err(reason) => state.decoded[number] = Some(Err(self.line(number, &reason))),
            }
        }
        for (job, texels) in jobs.iter().zip(decode_all(&jobs)) {
            let image = texels.map(|texels| {
                let Header { width, height, .. } = job.header;
                Arc::new(Image { name: self.entries[job.number].0.clone(), width, height, texels })
            });
            let reason = |reason: String| self.line(job.number, &format!("cannot be decoded: {reason}"));
            state.decoded[job.number] = Some(image.map_err(reason));
        }
        let known = |number: &usize| state.decoded[*number].clone().unwrap_or_else(|| Err(String::new()));
        numbers.iter().map(known).collect()
    }

    fn job<'a>(
        &'a self,
        number: usize,
        bytes_of: impl Fn(usize) -> Result<&'a [u8], String>,
        state: &mut State,
    ) -> Result<Job<'a>, String> {
        let bytes = match &self.entries[number].1 {
            Encoded::Bytes(bytes) => bytes,
            Encoded::Elsewhere => bytes_of(number)?,
            Encoded::Missing(reason) => return Err(reason.clone()),
        };
        let header = header(bytes).map_err(|reason| format!("cannot be decoded: {reason}"))?;
        self.check([header.width, header.height], header.is_16_bit, bytes.len(), state)?;
        Ok(Job { number, bytes, header })
    }

    /// Counts an image of 8 bits a channel that is made of others.
    pub(crate) fn count(&self, width: u32, height: u32) -> Result<(), String> {
        self.check([width, height], false, 0, &mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Counts an image against the limits.
    fn check(&self, [width, height]: [u32; 2], is_16_bit: bool, bytes: usize, state: &mut State) -> Result<(), String> {
        let count = u64::from(width) * u64::from(height);
        let too_large = |what: &str, limit: u64, field: &str| {
            Err(format!("has {width} x {height} pixels; {limit} are allowed{what} ({field})"))
        };
        if count > self.limits.image_pixels {
            return too_large("", self.limits.image_pixels, "Limits::image_pixels");
        }
        let pixels = state.pixels + count * if is_16_bit { 2 } else { 1 };
        // Images may share their bytes, which allow no more pixels for it.
        let bytes = (state.bytes + bytes as u64).min(self.model_bytes);
        if pixels > self.limits.pixels {
            return too_large(" in all images", self.limits.pixels, "Limits::pixels");
        }
        let expanded = bytes.saturating_mul(32).saturating_add(self.limits.expanded_pixels);
        if pixels > expanded {
            return too_large(" for all images of so few bytes", expanded, "Limits::expanded_pixels");
        }
        (state.pixels, state.bytes) = (pixels, bytes);
        Ok(())
    }

    fn line(&self, number: usize, reason: &str) -> String {
        // Decoders' own messages are of any length and number of lines.
        let reason: Vec<&str> = reason.split_whitespace().collect();
        format!("image '{}' {}", self.entries[number].0, shown(reason.join(" ").as_bytes()))
    }
}

/// Every job's pixels, in order.
fn decode_all(jobs: &[Job<'_>]) -> Vec<Result<crate::Texels, String>> {
    /// Pixels that are decoded at a time by decoders that need memory beside the result.
    const AT_A_TIME: u64 = 1 << 25;
    let weight = |job: &Job<'_>| if job.header.kind == Kind::Png { 0 } else { job.header.pixels() };
    let mut texels = Vec::with_capacity(jobs.len());
    let mut rest = jobs;
    while !rest.is_empty() {
        let mut sum = 0;
        let mut fits = |job: &Job<'_>| {
            sum += weight(job);
            sum <= AT_A_TIME
        };
        let count = rest.iter().take_while(|job| fits(job)).count().max(1);
        let (batch, behind) = rest.split_at(count);
        texels.extend(decode_batch(batch));
        rest = behind;
    }
    texels
}

fn decode_batch(jobs: &[Job<'_>]) -> Vec<Result<crate::Texels, String>> {
    let results: Vec<OnceLock<_>> = jobs.iter().map(|_| OnceLock::new()).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(at) else { return };
            // Fuzzed decoders, but not ours: should one panic all the same, it is the image that is at fault.
            let decoded = std::panic::catch_unwind(|| decode(job.bytes, job.header));
            let _ = results[at].set(decoded.unwrap_or_else(|_| Err("its decoder gave up".to_owned())));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    std::thread::scope(|scope| {
        for _ in 1..threads {
            // An error means that there is no thread to be had: the others do its share.
            let _ = std::thread::Builder::new().spawn_scoped(scope, work);
        }
        work();
    });
    results.into_iter().map(|result| result.into_inner().unwrap_or_else(|| Err("not decoded".to_owned()))).collect()
}
