//! Places in a text as windows count them: in UTF-16 units, every line break as one, be it one
//! byte or two.

/// Goes through a text in the units of windows.
pub(super) struct UnitTraversal<'t> {
    text: &'t str,
    /// The byte that it has come to.
    pub(super) at: usize,
}

impl<'t> UnitTraversal<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// Goes on by some units; `None`: the text ends before, or a character is split.
    pub(super) fn skip_units(&mut self, units: u64) -> Option<()> {
        let mut left = units;
        let mut rest = self.text[self.at..].chars();
        while left > 0 {
            let next = rest.next()?;
            self.at += next.len_utf8();
            if next == '\r' && rest.as_str().starts_with('\n') {
                rest.next();
                self.at += 1;
            }
            left = left.checked_sub(next.len_utf16() as u64)?;
        }
        Some(())
    }
}

/// Length of a text in the units of windows.
pub(super) fn length(text: &str) -> usize {
    text.encode_utf16().count() - text.matches("\r\n").count()
}

/// Turns bytes into the units of windows; they must ascend.
#[derive(Debug)]
pub(super) struct Counter<'t> {
    text: &'t str,
    at: usize,
    units: usize,
}

impl<'t> Counter<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            at: 0,
            units: 0,
        }
    }

    /// The units before a byte.
    pub(super) fn units(&mut self, byte: usize) -> usize {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        if byte < self.at {
            (self.at, self.units) = (0, 0);
        }
        self.units += length(&self.text[self.at..byte]);
        self.at = byte;
        self.units
    }
}

#[cfg(test)]
mod tests {
    use super::Counter;

    #[test]
    fn bytes_become_units() {
        let text = "µ\r\n😀x";
        let mut counter = Counter::new(text);
        assert_eq!(
            [0, 2, 4, 8, 9].map(|byte| counter.units(byte)),
            [0, 1, 2, 4, 5]
        );
        assert_eq!(counter.units(2), 1);
        assert_eq!(counter.units(99), 5);
    }
}
