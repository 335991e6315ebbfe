//! Times of a record among the samples of a run.

/// Most samples of a run.
const MOST: f64 = 1e6;

/// Samples between two neighbouring times of a record that is not even.
const FINER: f64 = 10.0;

/// Share of a sample by which times may be off.
const EVEN: f64 = 1e-6;

/// Samples from which a value between them is interpolated.
const POINTS: usize = 6;

/// How a run is sampled so that the times of a record are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Duration of the run (s).
    pub duration: f64,
    /// Equal intervals between its samples.
    pub samples: usize,
    /// The times, in samples.
    places: Vec<f64>,
    /// Whether all times are those of samples.
    pub even: bool,
}

impl Grid {
    /// Of ascending times, none below zero.
    ///
    /// # Errors
    /// What is wrong with the times, in words.
    pub fn of(times: &[f64]) -> Result<Self, String> {
        let last = *times.last().ok_or("the record has no rows")?;
        if let Some(pair) = times.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(format!(
                "its times do not rise: {} s, then {} s",
                pair[0], pair[1]
            ));
        }
        if last == 0.0 {
            return Err("it has no row after the start of the run".to_owned());
        }
        if times[0] < 0.0 || last < 0.0 || !last.is_finite() {
            return Err("its times begin at 0 or later: a run has no others".to_owned());
        }
        let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
        let first = Some(times[0]).filter(|first| *first > 0.0);
        let least = steps.chain(first).fold(f64::INFINITY, f64::min);
        let on =
            |samples: f64| -> Vec<f64> { times.iter().map(|time| time / last * samples).collect() };
        let samples = (last / least).round();
        let places = on(samples);
        let even = places
            .iter()
            .all(|place| (place - place.round()).abs() <= EVEN * samples.max(1.0).sqrt());
        if even && samples <= MOST {
            return Ok(Self {
                duration: last,
                samples: samples as usize,
                places,
                even,
            });
        }
        let samples = (FINER * samples).min(MOST);
        if samples < last / least {
            return Err("its times lie too close beside each other for their range".to_owned());
        }
        Ok(Self {
            duration: last,
            samples: samples as usize,
            places: on(samples),
            even: false,
        })
    }

    /// The values at the times, from those of all samples; `None`: there are others.
    pub fn at_times(&self, values: &[f64]) -> Option<Vec<f64>> {
        if values.len() != self.samples + 1 {
            return None;
        }
        let value = |place: &f64| match self.even {
            true => values[place.round() as usize],
            false => interpolated(values, *place),
        };
        let found: Vec<f64> = self.places.iter().map(value).collect();
        found.iter().all(|one| one.is_finite()).then_some(found)
    }
}

/// The polynomial through the samples about a place.
fn interpolated(values: &[f64], place: f64) -> f64 {
    let points = POINTS.min(values.len());
    let first = (place.floor() as usize + 1).saturating_sub(points / 2);
    let first = first.min(values.len() - points);
    let own = |at: usize| (first + at) as f64;
    (0..points)
        .map(|at| {
            let others = (0..points).filter(|other| *other != at);
            let weight: f64 = others
                .map(|other| (place - own(other)) / (own(at) - own(other)))
                .product();
            weight * values[first + at]
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::Grid;

    #[test]
    fn even_times_are_samples() {
        let times: Vec<f64> = (1..=200).map(|number| 2e-5 * f64::from(number)).collect();
        let grid = Grid::of(&times).unwrap();
        assert_eq!((grid.samples, grid.even), (200, true));
        let values: Vec<f64> = (0..=200).map(f64::from).collect();
        assert_eq!(grid.at_times(&values).unwrap()[..3], [1.0, 2.0, 3.0]);
        assert_eq!(grid.at_times(&values[1..]), None);
        // A gap in the record, and a start at 0.
        assert_eq!(Grid::of(&[0.0, 0.1, 0.2, 0.7]).unwrap().samples, 7);
    }

    #[test]
    fn other_times_are_interpolated() {
        let times = [0.1, 0.2618, 0.3, 0.9142, 1.0];
        let grid = Grid::of(&times).unwrap();
        assert!(!grid.even);
        let f = |t: f64| (3.0 * t).sin();
        let values: Vec<f64> = (0..=grid.samples)
            .map(|at| f(at as f64 / grid.samples as f64))
            .collect();
        for (found, time) in grid.at_times(&values).unwrap().iter().zip(times) {
            assert!((found - f(time)).abs() < 1e-9, "{found} {}", f(time));
        }
    }

    #[test]
    fn wrong_times_are_refused() {
        assert!(Grid::of(&[]).unwrap_err().contains("no rows"));
        assert!(
            Grid::of(&[0.0, 0.2, 0.1])
                .unwrap_err()
                .contains("do not rise")
        );
        assert!(Grid::of(&[-0.1, 0.1]).unwrap_err().contains("begin at 0"));
        assert!(
            Grid::of(&[0.0, 1e-12, 1.0])
                .unwrap_err()
                .contains("too close")
        );
    }
}
