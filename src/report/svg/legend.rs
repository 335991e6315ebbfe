//! The places of the names in a legend.

/// Names side by side, in as many rows as they need.
pub(super) struct Legend {
    ends: [f64; 2],
    row: f64,
    rows: u32,
    next: f64,
}

impl Legend {
    /// A legend between the `ends` in x, with rows of this height (pixels).
    pub(super) fn new(ends: [f64; 2], row: f64) -> Self {
        Self {
            ends,
            row,
            rows: 0,
            next: ends[0],
        }
    }

    /// Where an entry that takes this `room` begins: x, and how far below the
    /// first row. An entry alone in its row may be wider than the row.
    pub(super) fn place(&mut self, room: f64) -> (f64, f64) {
        let [left, right] = self.ends;
        let full = self.next > left && self.next + room > right;
        if self.rows == 0 || full {
            self.next = left;
            self.rows += 1;
        }
        let x = self.next;
        self.next += room;
        (x, f64::from(self.rows - 1) * self.row)
    }

    /// What all rows take.
    pub(super) fn height(&self) -> f64 {
        f64::from(self.rows) * self.row
    }
}
