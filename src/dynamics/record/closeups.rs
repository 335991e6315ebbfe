//! Rows behind switches, as many as a page can use: of a run with many switches they follow
//! every second one, every fourth, …, so that what is kept is spread over the whole run.

/// Most numbers that are kept, unless there are very many columns.
const MOST: usize = 400_000;

/// Rows that there is room for in any case.
const LEAST_ROWS: usize = 1_000;

/// Rows on the way, column by column.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    pub(super) times: Vec<f64>,
    pub(super) columns: Vec<Vec<f64>>,
}

impl Table {
    /// So many columns, with room for so many rows.
    pub(super) fn new(columns: usize, room: usize) -> Self {
        Self {
            times: Vec::with_capacity(room),
            columns: (0..columns).map(|_| Vec::with_capacity(room)).collect(),
        }
    }

    pub(super) fn push(&mut self, time: f64, row: &[f64]) {
        self.times.push(time);
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(*value);
        }
    }
}

/// Rows behind switches, in groups, one a switch.
#[derive(Clone, Debug)]
pub(super) struct Groups {
    pub(super) table: Table,
    /// First rows of the groups.
    starts: Vec<usize>,
    most_rows: usize,
    /// Number of switches so far.
    switches: u64,
    /// Switches from group to group.
    pub(super) every: u64,
}

impl Groups {
    /// No rows yet, of so many columns.
    pub(super) fn new(columns: usize) -> Self {
        Self {
            table: Table::new(columns, 0),
            starts: Vec::new(),
            most_rows: (MOST / columns.max(1)).max(LEAST_ROWS),
            switches: 0,
            every: 1,
        }
    }

    /// Hears of a switch: true where rows are to follow it.
    pub(super) fn begin_after_switch(&mut self) -> bool {
        let number = self.switches;
        self.switches += 1;
        if self.table.times.len() > self.most_rows {
            self.drop_every_second();
        }
        let followed = number.is_multiple_of(self.every);
        if followed {
            self.starts.push(self.table.times.len());
        }
        followed
    }

    /// Drops every second group.
    fn drop_every_second(&mut self) {
        let end = self.table.times.len();
        let ends = self.starts.iter().skip(1).chain([&end]);
        let groups = self.starts.iter().zip(ends).map(|(from, to)| *from..*to);
        let kept: Vec<std::ops::Range<usize>> = groups.step_by(2).collect();
        let thin = |values: &mut Vec<f64>| {
            let mut to = 0;
            for rows in &kept {
                values.copy_within(rows.clone(), to);
                to += rows.len();
            }
            values.truncate(to);
        };
        thin(&mut self.table.times);
        self.table.columns.iter_mut().for_each(thin);
        let mut next = 0;
        self.starts.clear();
        for rows in &kept {
            self.starts.push(next);
            next += rows.len();
        }
        self.every *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::{Groups, LEAST_ROWS};

    #[test]
    fn rows_are_bounded_and_follow_equally_spaced_switches() {
        let mut groups = Groups::new(400);
        let numbers = [1.0; 400];
        assert_eq!(groups.most_rows, LEAST_ROWS);
        let rows = |switch: u64| 3 + switch % 5;
        for switch in 0..20_000 {
            if groups.begin_after_switch() {
                for row in 0..rows(switch) {
                    groups
                        .table
                        .push(switch as f64 + 0.1 * row as f64, &numbers);
                }
            }
            assert!(groups.table.times.len() <= LEAST_ROWS + 10);
        }
        assert!(groups.every >= 64, "{}", groups.every);
        let all = (0..20_000).step_by(groups.every as usize);
        let expected = all
            .flat_map(|switch| (0..rows(switch)).map(move |row| switch as f64 + 0.1 * row as f64));
        assert_eq!(groups.table.times, expected.collect::<Vec<_>>());
    }

    #[test]
    fn few_switches_are_all_followed() {
        let mut groups = Groups::new(3);
        for switch in 0..50 {
            assert!(groups.begin_after_switch());
            groups.table.push(f64::from(switch), &[1.0, 2.0, 3.0]);
        }
        assert_eq!((groups.every, groups.table.times.len()), (1, 50));
        assert_eq!(groups.table.columns[2], [3.0; 50]);
    }
}
