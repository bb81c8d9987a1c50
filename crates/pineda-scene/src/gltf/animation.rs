//! Animations: what nodes' transforms and morph weights are at a time (specification, 3.11 and appendix C).

use std::collections::HashMap;

use super::accessor::{Accessor, Accessors};
use super::schema::{Animation, AnimationSampler, Root};
use crate::Error;
use crate::limits::Budget;

/// What an animation says of a node; `None` where it says nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Animated {
    pub(super) translation: Option<[f64; 3]>,
    /// x, y, z, w; not necessarily of length 1.
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) weights: Option<Vec<f64>>,
}

/// By the nodes' numbers.
pub(super) type AnimatedNodes = HashMap<usize, Animated>;

/// All that animation `number` says at `time`, in seconds.
pub(super) fn at(
    root: &Root,
    number: usize,
    time: f64,
    accessors: &Accessors<'_>,
    budget: &mut Budget,
) -> Result<AnimatedNodes, Error> {
    let mut nodes = AnimatedNodes::new();
    let animation = &root.animations[number];
    for (channel_number, channel) in animation.channels.iter().enumerate() {
        let Some(node) = channel.target.node else { continue };
        let place = format!("animation {number}, channel {channel_number}");
        let wrong = |message: String| Error::gltf(place.as_str(), message);
        let missing = || wrong(format!("its sampler {} does not exist", channel.sampler));
        let sampler = animation.samplers.get(channel.sampler.index()).ok_or_else(missing)?;
        if node.index() >= root.nodes.len() {
            return Err(wrong(format!("its node {node} does not exist")));
        }
        let path = channel.target.path.as_str();
        if !matches!(path, "translation" | "rotation" | "scale" | "weights") {
            continue;
        }
        let keys = Keys::new(sampler, &place, accessors, budget)?;
        let animated = nodes.entry(node.index()).or_default();
        match path {
            "translation" => animated.translation = Some(keys.vector(time, 3).map_err(wrong)?),
            "scale" => animated.scale = Some(keys.vector(time, 3).map_err(wrong)?),
            "rotation" => animated.rotation = Some(keys.rotation(time).map_err(wrong)?),
            _ => animated.weights = Some(keys.weights(time, budget).map_err(wrong)?),
        }
    }
    Ok(nodes)
}

/// The time of an animation's last key; 0 for one without keys. What is wrong with it is said when it is asked for.
pub(super) fn duration(animation: &Animation, accessors: &Accessors<'_>, budget: &mut Budget) -> f64 {
    let last = |sampler: &AnimationSampler| {
        let times = accessors.get(sampler.input, "animation", budget).ok().filter(|times| times.channels == 1)?;
        let [last] = times.element(times.count.checked_sub(1)?, 0.0);
        Some(last)
    };
    animation.samplers.iter().filter_map(last).fold(0.0, |longest, time| if time > longest { time } else { longest })
}

/// A sampler: times, and a value for each (three for each, if it is a cubic spline: tangent in, value, tangent out).
struct Keys<'a> {
    times: Accessor<'a>,
    values: Accessor<'a>,
    interpolation: Interpolation,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Interpolation {
    Step,
    Linear,
    CubicSpline,
}

/// Between which keys a time lies.
#[derive(Clone, Copy)]
enum Span {
    /// Just this key: before the first, after the last, or nothing to interpolate.
    At(usize),
    /// From this key to the next: how far (within 0..1), and how many seconds they are apart.
    Between(usize, f64, f64),
}

impl<'a> Keys<'a> {
    fn new(
        sampler: &AnimationSampler,
        place: &str,
        accessors: &Accessors<'a>,
        budget: &mut Budget,
    ) -> Result<Self, Error> {
        let times = accessors.get(sampler.input, &format!("{place}, input"), budget)?;
        let values = accessors.get(sampler.output, &format!("{place}, output"), budget)?;
        let interpolation = match sampler.interpolation.as_deref() {
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::CubicSpline,
            _ => Interpolation::Linear,
        };
        if times.channels != 1 || times.count == 0 {
            return Err(Error::gltf(place, "its times must be single numbers, at least one"));
        }
        Ok(Self { times, values, interpolation })
    }

    fn time(&self, key: usize) -> f64 {
        let [time] = self.times.element(key, 0.0);
        time
    }

    fn span(&self, time: f64) -> Span {
        // The first key that is later.
        let (mut from, mut to) = (0, self.times.count);
        while from < to {
            let middle = from.midpoint(to);
            if self.time(middle) <= time { from = middle + 1 } else { to = middle }
        }
        if from == 0 || from == self.times.count || self.interpolation == Interpolation::Step {
            return Span::At(from.saturating_sub(1));
        }
        let key = from - 1;
        let (start, end) = (self.time(key), self.time(from));
        let seconds = end - start;
        if time > start && seconds > 0.0 {
            Span::Between(key, (time - start) / seconds, seconds)
        } else {
            Span::At(key)
        }
    }

    /// Elements of `values` that a key has.
    fn elements_per_key(&self, channels: usize) -> Result<usize, String> {
        let parts = if self.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let per_key = self.values.count / self.times.count;
        if self.values.channels != channels || per_key < parts {
            let (keys, values) = (self.times.count, self.values.count);
            return Err(format!(
                "{values} values of {} numbers each for {keys} times: expected {parts} for each, of {channels} numbers",
                self.values.channels
            ));
        }
        Ok(per_key)
    }

    /// Three numbers, such as a translation.
    fn vector<const N: usize>(&self, time: f64, channels: usize) -> Result<[f64; N], String> {
        self.elements_per_key(channels)?;
        let value = |element: usize| self.values.element::<N>(element, 0.0);
        let mix = |weights: &[(f64, usize)]| {
            let mut sum = [0.0; N];
            for &(weight, element) in weights {
                for (sum, value) in sum.iter_mut().zip(value(element)) {
                    *sum += weight * value;
                }
            }
            sum
        };
        Ok(match (self.span(time), self.interpolation) {
            (Span::At(key), Interpolation::CubicSpline) => value(3 * key + 1),
            (Span::At(key), _) => value(key),
            (Span::Between(key, t, seconds), Interpolation::CubicSpline) => {
                let [v0, b0, v1, a1] = hermite(t, seconds);
                mix(&[(v0, 3 * key + 1), (b0, 3 * key + 2), (v1, 3 * key + 4), (a1, 3 * key + 3)])
            }
            (Span::Between(key, t, _), _) => mix(&[(1.0 - t, key), (t, key + 1)]),
        })
    }

    /// A rotation: along the shortest arc, if it is linear.
    fn rotation(&self, time: f64) -> Result<[f64; 4], String> {
        match (self.span(time), self.interpolation) {
            (Span::Between(key, t, _), Interpolation::Linear) => {
                self.elements_per_key(4)?;
                Ok(slerp(self.values.element(key, 0.0), self.values.element(key + 1, 0.0), t))
            }
            _ => self.vector(time, 4),
        }
    }

    /// Any number of morph weights: each key has all of them, of a spline all tangents in, then all values, then all
    /// tangents out.
    fn weights(&self, time: f64, budget: &mut Budget) -> Result<Vec<f64>, String> {
        let per_key = self.elements_per_key(1)?;
        let is_spline = self.interpolation == Interpolation::CubicSpline;
        let count = if is_spline { per_key / 3 } else { per_key };
        budget.elements(count as u64).map_err(|error| error.to_string())?;
        let value = |element: usize| {
            let [value] = self.values.element(element, 0.0);
            value
        };
        let first = |key: usize, part: usize| key * per_key + part * count;
        let at = |i: usize| match (self.span(time), is_spline) {
            (Span::At(key), true) => value(first(key, 1) + i),
            (Span::At(key), false) => value(first(key, 0) + i),
            (Span::Between(key, t, seconds), true) => {
                let [v0, b0, v1, a1] = hermite(t, seconds);
                let (first_value, out, next_in, next_value) =
                    (first(key, 1), first(key, 2), first(key + 1, 0), first(key + 1, 1));
                v0 * value(first_value + i) + b0 * value(out + i) + v1 * value(next_value + i) + a1 * value(next_in + i)
            }
            (Span::Between(key, t, _), false) => {
                (1.0 - t) * value(first(key, 0) + i) + t * value(first(key + 1, 0) + i)
            }
        };
        Ok((0..count).map(at).collect())
    }
}

/// The cubic spline's weights of a key's value and outgoing tangent, and of the next key's value and incoming tangent.
fn hermite(t: f64, seconds: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [2.0 * t3 - 3.0 * t2 + 1.0, seconds * (t3 - 2.0 * t2 + t), -2.0 * t3 + 3.0 * t2, seconds * (t3 - t2)]
}

/// Spherical linear interpolation of two quaternions, the shorter way around.
fn slerp(a: [f64; 4], b: [f64; 4], t: f64) -> [f64; 4] {
    let (a, b) = (unit(a), unit(b));
    let cos = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    let (sign, cos) = if cos < 0.0 { (-1.0, -cos) } else { (1.0, cos) };
    // Closer together, the arc is a line in double precision, and its sine no longer has digits to divide by.
    let (from, to) = if cos > 1.0 - 1e-12 {
        (1.0 - t, t)
    } else {
        let angle = libm::acos(cos);
        let sin = libm::sin(angle);
        (libm::sin(angle * (1.0 - t)) / sin, libm::sin(angle * t) / sin)
    };
    std::array::from_fn(|c| from * a[c] + sign * to * b[c])
}

fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    if length > 0.0 && length.is_finite() { q.map(|c| c / length) } else { [0.0, 0.0, 0.0, 1.0] }
}
