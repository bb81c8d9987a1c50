//! Pictures of letters, for tests that show what they mean.

/// One line per row: `.` for a pixel that is not covered, `#` for one covered once, a digit (or `+` beyond 9) for more.
pub fn picture<Count: Copy + Into<u32>>(cells: &[Count], width: u32) -> String {
    let letter = |&cell: &Count| match cell.into() {
        0 => '.',
        1 => '#',
        count => char::from_digit(count, 10).unwrap_or('+'),
    };
    cells.chunks(width as usize).flat_map(|row| row.iter().map(letter).chain(['\n'])).collect()
}
