//! Conditions on the base circle that have no closed form: looked for over the
//! places of the innermost follower.

use super::BaseRange;
use crate::kinematics::cam::disc::DiscCam;
use crate::kinematics::cam::spec::{CamGeometry, Contact, Guide};
use crate::math::roots::root;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of a scan.
const STEPS: usize = 160;

/// Result of a scan: where the share is at most 1, and where it is least.
pub(super) struct Scan {
    pub(super) ranges: Vec<BaseRange>,
    /// Base radius and share.
    pub(super) best: (f64, f64),
}

impl DiscCam {
    /// Where a share (a function of the base circle) is at most 1.
    pub(super) fn scan(&self, share: impl Fn(&Self) -> f64) -> Scan {
        let places = self.places();
        let cam = |place: f64| {
            let prime = self.prime_at(place)?;
            self.with_prime_radius(prime)
        };
        let excess = |place: f64| cam(place).map_or(f64::INFINITY, |cam| share(&cam) - 1.0);
        let base = |place: f64| {
            self.prime_at(place)
                .map_or(0.0, |prime| self.base_of(prime))
        };
        let values: Vec<f64> = places.iter().map(|&place| excess(place)).collect();
        let mut best = (0.0, f64::INFINITY);
        let mut ranges: Vec<BaseRange> = Vec::new();
        let open = matches!(self.geometry().guide, Guide::Translating { .. });
        for (index, (&place, &value)) in places.iter().zip(&values).enumerate() {
            if value < best.1 {
                best = (base(place), value);
            }
            let edge = |other: usize| match values[other].is_finite() {
                true => base(root(&excess, places[other], place)),
                false => base(place),
            };
            let before = index.checked_sub(1).filter(|&other| values[other] > 0.0);
            if value <= 0.0 && (index == 0 || before.is_some()) {
                let from = before.map_or(base(place), edge);
                ranges.push(BaseRange { from, to: None });
            }
            let after =
                Some(index + 1).filter(|&other| values.get(other).is_some_and(|v| *v > 0.0));
            let last = index + 1 == values.len();
            if let (true, Some(range)) = (value <= 0.0, ranges.last_mut())
                && (after.is_some() || (last && !open))
            {
                range.to = Some(after.map_or(base(place), edge));
            }
        }
        best.1 += 1.0;
        Scan { ranges, best }
    }

    /// Places of the innermost follower that are tried.
    fn places(&self) -> Vec<f64> {
        let stroke = self.motion().stroke();
        let step = |index: usize| index as f64 / STEPS as f64;
        match self.geometry().guide {
            Guide::Translating { .. } => {
                let [slope, bend] = self.motion().sizes();
                let size = stroke + slope + bend;
                (0..=STEPS)
                    .map(|index| size * 10f64.powf(-4.0 + 7.0 * step(index)))
                    .collect()
            }
            Guide::Turning { .. } => {
                let end = match self.geometry().roller() {
                    Some(_) => PI,
                    None => FRAC_PI_2,
                } - stroke;
                (1..STEPS).map(|index| end * step(index)).collect()
            }
        }
    }

    /// Prime radius of a follower that is innermost at a place; `None` where the
    /// roller would not fit or the base circle vanishes.
    fn prime_at(&self, place: f64) -> Option<f64> {
        let geometry: &CamGeometry = self.geometry();
        let prime = match (geometry.guide, geometry.contact) {
            (Guide::Translating { .. }, Contact::Flat { .. }) => place,
            (Guide::Translating { offset }, _) => place.hypot(offset),
            (
                Guide::Turning {
                    centre_distance, ..
                },
                Contact::Flat { face_offset, .. },
            ) => centre_distance * place.sin() - face_offset,
            (
                Guide::Turning {
                    centre_distance: a,
                    arm: l,
                    ..
                },
                _,
            ) => {
                let half = (0.5 * place).sin();
                ((a - l).powi(2) + 4.0 * a * l * half * half).sqrt()
            }
        };
        let base = self.base_of(prime);
        (prime > 0.0 && base > 0.0).then_some(prime)
    }
}
