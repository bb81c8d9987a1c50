//! Words of text formats (OBJ, MTL, PLY, ASCII STL), straight from the bytes: files need not be UTF-8.

/// A cursor over words and lines. A line ends with LF, CR LF or CR; words are separated by any other ASCII white space.
#[derive(Clone)]
pub(crate) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    syntax: Syntax,
}

/// What differs from one text format to the next.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Syntax {
    /// Words and lines, nothing else.
    Plain,
    /// `#` before a word begins a comment, and `\` at a line's end continues it (OBJ, MTL).
    Wavefront,
}

impl<'a> Text<'a> {
    pub(crate) fn new(bytes: &'a [u8], syntax: Syntax) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { bytes, at, line: 1, syntax }
    }

    /// The number of the current line, from 1.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// The offset of the next byte.
    pub(crate) fn offset(&self) -> usize {
        self.at
    }

    /// How many bytes are left.
    pub(crate) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next word of this line.
    pub(crate) fn word(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let start = self.at;
        while let Some(&byte) = self.bytes.get(self.at) {
            if is_blank(byte) || is_line_end(byte) || (byte == b'\\' && self.continuation().is_some()) {
                break;
            }
            self.at += 1;
        }
        (self.at > start).then(|| &self.bytes[start..self.at])
    }

    /// The next word, on this line or a later one.
    pub(crate) fn word_on_any_line(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.word() {
                return Some(word);
            }
            if !self.next_line() {
                return None;
            }
        }
    }

    /// The rest of this line without white space at its ends, for names with spaces in them.
    pub(crate) fn rest(&mut self) -> &'a [u8] {
        let start = self.at;
        self.at += self.bytes[start..].iter().position(|&b| is_line_end(b)).unwrap_or(self.bytes.len() - start);
        self.bytes[start..self.at].trim_ascii()
    }

    /// Goes to the beginning of the next line; `false` at the end of the file.
    pub(crate) fn next_line(&mut self) -> bool {
        loop {
            match self.bytes.get(self.at) {
                None => return false,
                Some(b'\\') if self.syntax == Syntax::Wavefront => self.skip_backslash(),
                Some(&byte) => {
                    self.at += 1;
                    if is_line_end(byte) {
                        self.finish_line_end(byte);
                        return self.at < self.bytes.len();
                    }
                }
            }
        }
    }

    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if is_blank(byte) {
                self.at += 1;
            } else if self.syntax == Syntax::Wavefront && byte == b'#' {
                // A comment ends with its line, and a backslash in it means nothing.
                while self.bytes.get(self.at).is_some_and(|&b| !is_line_end(b)) {
                    self.at += 1;
                }
            } else if byte == b'\\' && self.continuation().is_some() {
                self.skip_backslash();
            } else {
                break;
            }
        }
    }

    /// At a backslash: where the line end behind it is, if there is one.
    fn continuation(&self) -> Option<usize> {
        if self.syntax != Syntax::Wavefront {
            return None;
        }
        // White space between the two cannot be seen in an editor, so it does not count.
        let behind = self.bytes.get(self.at + 1..)?;
        let blanks = behind.iter().position(|&b| !is_blank(b))?;
        is_line_end(behind[blanks]).then_some(self.at + 1 + blanks)
    }

    /// Past a backslash, and past the line end that it takes away.
    fn skip_backslash(&mut self) {
        match self.continuation() {
            Some(end) => {
                self.at = end + 1;
                self.finish_line_end(self.bytes[end]);
            }
            None => self.at += 1,
        }
    }

    /// Just past the byte `end` of a line end: the LF of CR LF belongs to it.
    fn finish_line_end(&mut self, end: u8) {
        if end == b'\r' && self.bytes.get(self.at) == Some(&b'\n') {
            self.at += 1;
        }
        self.line += 1;
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// A decimal number, correctly rounded. Also infinities and NaN, as C runtimes spell them.
pub(crate) fn float(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok().or_else(|| unusual_float(word))
}

/// [`float`], rounded once to f32.
pub(crate) fn float32(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.parse().ok().or_else(|| unusual_float(word).map(|f| f as f32))
}

/// `-nan(ind)` and `1.#QNAN` (printf of glibc and of MSVC).
fn unusual_float(word: &[u8]) -> Option<f64> {
    let unsigned = word.strip_prefix(b"-").unwrap_or(word).to_ascii_lowercase();
    if unsigned.starts_with(b"nan(") || unsigned.starts_with(b"1.#") { Some(f64::NAN) } else { None }
}

/// A decimal integer.
pub(crate) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = value * 10 + i64::from(digit - b'0');
    }
    Some(if negative { -value } else { value })
}

/// For messages and names: what is not UTF-8 is replaced, what is long is cut.
pub(crate) fn shown(bytes: &[u8]) -> String {
    const LONGEST: usize = 200;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST)]);
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str, syntax: Syntax) -> Vec<(usize, Vec<String>)> {
        let mut text = Text::new(text.as_bytes(), syntax);
        let mut lines = Vec::new();
        loop {
            let mut words = Vec::new();
            let first = text.word();
            let number = text.line();
            words.extend(first.map(shown));
            while let Some(word) = text.word() {
                words.push(shown(word));
            }
            lines.push((number, words));
            if !text.next_line() {
                return lines;
            }
        }
    }

    #[test]
    fn text_line_ends_of_all_kinds() {
        let words = |words: &[&str]| words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>();
        let expected = vec![(1, words(&["a", "b"])), (2, words(&["c"])), (3, vec![]), (4, words(&["d"]))];
        for text in ["a b\nc\n\nd", "a\tb \r\n c\r\n\r\nd\r\n", "\u{feff}a\x0bb\rc\r\r\x0cd"] {
            assert_eq!(lines(text, Syntax::Plain), expected, "{text:?}");
        }
    }

    #[test]
    fn text_comments_and_continued_lines() {
        let read = |text| lines(text, Syntax::Wavefront).into_iter().map(|(_, words)| words).collect::<Vec<_>>();
        assert_eq!(read("f 1 \\\n2 \\ \r\n 3\n# a \\\nf"), [vec!["f", "1", "2", "3"], vec![], vec!["f"]]);
        assert_eq!(read("a\\\nb c\\d #e"), [vec!["a", "b", "c\\d"]]);
        assert_eq!(read("m Material_#24"), [vec!["m", "Material_#24"]]);
        assert_eq!(lines("# x\nf \\\n1\nv", Syntax::Wavefront)[2].0, 4, "line numbers count continued lines");
    }

    #[test]
    fn text_rest_of_line() {
        let mut text = Text::new(b"usemtl my  red # paint \r\nv", Syntax::Wavefront);
        assert_eq!(text.word(), Some(&b"usemtl"[..]));
        assert_eq!(text.rest(), b"my  red # paint");
        assert_eq!(text.rest(), b"");
        assert_eq!(text.word_on_any_line(), Some(&b"v"[..]));
        assert_eq!(text.word_on_any_line(), None);
        assert_eq!(text.remaining(), 0);
    }

    #[test]
    fn text_numbers() {
        assert_eq!(float(b"-1.5e3"), Some(-1500.0));
        assert_eq!(float(b"+.5"), Some(0.5));
        assert_eq!(float32(b"1e60"), Some(f32::INFINITY));
        assert!(float(b"-nan(ind)").unwrap().is_nan() && float(b"1.#QNAN").unwrap().is_nan());
        assert!(float(b"NaN").unwrap().is_nan());
        assert_eq!(float(b"1,5"), None);
        assert_eq!(float(b"\xff"), None);
        assert_eq!(integer(b"-12"), Some(-12));
        assert_eq!(integer(b"+7"), Some(7));
        for bad in [&b""[..], b"-", b"1.0", b"1x", b"9999999999999999999"] {
            assert_eq!(integer(bad), None);
        }
    }
}
