//! Counts as colours.

/// Few counts, well told apart: 0 black, 1 blue, 2 green, 3 yellow, 4 orange, 5 red, 6 magenta, more white.
pub(crate) fn count_color(count: u32) -> [u8; 3] {
    match count {
        0 => [0, 0, 0],
        1 => [40, 90, 200],
        2 => [40, 170, 70],
        3 => [240, 220, 50],
        4 => [245, 140, 30],
        5 => [220, 40, 40],
        6 => [200, 60, 200],
        _ => [255, 255, 255],
    }
}

/// Many counts, as something that glows the hotter it is: a step of colour for each doubling.
pub(crate) fn heat(count: u32) -> [u8; 3] {
    const STEPS: [[u8; 3]; 6] =
        [[30, 28, 92], [92, 30, 126], [150, 40, 130], [222, 62, 78], [250, 200, 70], [255, 255, 255]];
    let Some(step) = count.checked_ilog2() else { return [0; 3] };
    let step = step as usize;
    if step + 1 >= STEPS.len() {
        return STEPS[STEPS.len() - 1];
    }
    // Linear between powers of two, in whole numbers.
    let (from, to) = (STEPS[step], STEPS[step + 1]);
    let (part, whole) = (count - (1 << step), 1 << step);
    [0, 1, 2].map(|c| ((u32::from(from[c]) * (whole - part) + u32::from(to[c]) * part) / whole) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_rises() {
        let light = |count: u32| heat(count).into_iter().map(u32::from).sum::<u32>();
        assert!((0..40).all(|count| light(count) <= light(count + 1)));
        assert_eq!([heat(0), heat(1), heat(32), heat(u32::MAX)], [[0; 3], [30, 28, 92], [255; 3], [255; 3]]);
        assert!((0..32).all(|count| heat(count) != heat(count + 1)));
    }
}
