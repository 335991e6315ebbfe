//! Plans of motion as scenes state them.

use crate::fault::Faults;
use crate::kinematics::motion::law::LawSpec;

/// A plan of motion (cyclogram): stations on the driver's axis, and the
/// motion from each to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CycleSpec {
    /// Stations, their arguments strictly ascending.
    pub stations: Vec<Station>,
    /// Length of the cycle (rad or s); the motion of the last station then
    /// leads to the first, one period on. `None`: one pass, rest before and after.
    pub period: Option<f64>,
    /// Displacement gained in every period: of an indexing motion its pitch.
    pub advance: f64,
    /// Added to the driver's displacement.
    pub phase: f64,
}

/// A place in a plan of motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// The driver's displacement, or the time.
    pub at: f64,
    /// Displacement there.
    pub displacement: f64,
    /// Prescribed first derivative, taken by smooth motions that meet here.
    pub speed: Option<f64>,
    /// Prescribed second derivative, taken by smooth motions that meet here.
    pub acceleration: Option<f64>,
    /// Order up to which smooth motions match their neighbour here, 1 … 3.
    pub order: usize,
    /// Motion from here to the next station.
    pub motion: Motion,
}

/// The motion between two stations.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Rest.
    Dwell,
    /// Constant speed.
    Uniform,
    /// A law of a full stroke, from rest to rest.
    Law(LawSpec),
    /// The polynomial of least degree that takes the derivatives of both ends.
    Smooth,
}

/// Order up to which smooth motions match their neighbours unless said otherwise.
pub const USUAL_ORDER: usize = 2;

/// Most stations of a plan.
pub(crate) const MOST_STATIONS: usize = 100;

/// Rounding allowed between places that are to be the same, of the period.
const SLACK: f64 = 1e-9;

impl CycleSpec {
    /// Checks numbers, order and periodicity.
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.finite("advance", self.advance);
        faults.finite("phase", self.phase);
        if let Some(period) = self.period {
            faults.positive("period", period);
        } else if self.advance != 0.0 {
            let message = "a plan that does not repeat has no advance";
            faults.add("advance", message, "give `period`, or leave out `advance`");
        }
        let count = self.stations.len();
        if !(2..=MOST_STATIONS).contains(&count) {
            let message = format!("{count} stations");
            let hint = format!("give between 2 and {MOST_STATIONS}");
            faults.add("stations", message, &hint);
        }
        for (index, station) in self.stations.iter().enumerate() {
            let path = |name: &str| format!("stations[{index}].{name}");
            faults.finite(&path("at"), station.at);
            faults.finite(&path("displacement"), station.displacement);
            faults.finite(&path("speed"), station.speed.unwrap_or(0.0));
            faults.finite(&path("acceleration"), station.acceleration.unwrap_or(0.0));
            if !(1..=3).contains(&station.order) {
                let message = format!("{} is no order to match", station.order);
                faults.add(path("match"), message, "give 1, 2 or 3");
            }
        }
        for (index, pair) in self.stations.windows(2).enumerate() {
            if pair[1].at <= pair[0].at {
                let message = format!("{} does not come after {}", pair[1].at, pair[0].at);
                let path = format!("stations[{}].at", index + 1);
                faults.add(path, message, "put the stations in ascending order");
            }
        }
    }

    /// The stations without one that closes the period, which must come back
    /// to the first.
    pub(super) fn open_stations(&self, faults: &mut Faults) -> Vec<Station> {
        let mut stations = self.stations.clone();
        let (Some(period), Some(first), Some(last)) =
            (self.period, self.stations.first(), self.stations.last())
        else {
            return stations;
        };
        let (reach, index) = (last.at - first.at, stations.len() - 1);
        if reach > period * (1.0 + SLACK) {
            let message =
                format!("the stations extend over {reach}, more than the period {period}");
            let hint = "all stations must lie within one period";
            faults.add(format!("stations[{index}].at"), message, hint);
        } else if reach >= period * (1.0 - SLACK) {
            let back = first.displacement + self.advance;
            let sizes = self.stations.iter().map(|s| s.displacement.abs());
            let size = sizes.fold(back.abs(), f64::max);
            if (last.displacement - back).abs() > SLACK * size {
                let message = format!(
                    "the plan is not periodic: it ends at {}, and begins again at {back}",
                    last.displacement
                );
                let hint = "let the last station come back to the first, plus `advance`";
                faults.add(format!("stations[{index}].displacement"), message, hint);
            }
            if last.speed.is_some() || last.acceleration.is_some() {
                let message = "the last station is the first, one period on";
                let hint = "prescribe speed and acceleration at the first station";
                faults.add(format!("stations[{index}]"), message, hint);
            }
            stations.pop();
        }
        stations
    }
}
