//! Contacts at rest at an instant, and the combination of rest and sliding that agrees with its
//! own forces.

use super::hold::weight;
use nalgebra::{DMatrix, DVector};

/// Share by which the force of what breaks loose exceeds its limit, so that nothing stops and
/// starts by rounding; half of it where a contact is decided.
pub(super) const EXCESS: f64 = 1e-10;
/// Share of a limit that is nothing but rounding, where a friction is not engaged.
pub(super) const UNFELT: f64 = 1e-14;
/// Share of the accelerations that holding forces may leave.
const UNHELD: f64 = 1e-9;
/// Singular values below this share of the greatest are zero.
pub(super) const SINGULAR: f64 = 1e-12;

/// Contacts at rest, by their numbers, with what their forces do at an instant.
pub(super) struct AtRest {
    pub(super) contacts: Vec<usize>,
    /// A·D: accelerations by shares of the limits.
    pub(super) mobility: DMatrix<f64>,
    /// Accelerations without their forces.
    pub(super) free: DVector<f64>,
    pub(super) limits: Vec<f64>,
    /// How far they are engaged.
    pub(super) engaged: Vec<f64>,
    /// Friction as sliding begins, as a share of the limit.
    pub(super) begins: Vec<f64>,
    /// Where a contact goes whatever its force: in a dead centre, where it moves nothing.
    pub(super) leads: Vec<Option<i8>>,
}

impl AtRest {
    /// The shares of the limits with which those in a combination that stick hold their nodes;
    /// `None`: no forces hold them. The others slide: −1, 1; 0: it sticks.
    fn shares(&self, senses: &[i8]) -> Option<DVector<f64>> {
        let count = senses.len();
        let stuck: Vec<usize> = (0..count).filter(|&k| senses[k] == 0).collect();
        let sliding = |k: usize| -f64::from(senses[k]) * self.begins[k];
        let mut shares = DVector::from_fn(count, |k, _| sliding(k));
        if stuck.is_empty() {
            return Some(shares);
        }
        let left = &self.free + &self.mobility * &shares;
        let weight = |k: usize| self.weight(stuck[k]);
        let own = |row: usize, column: usize| {
            let per_force = self.mobility[(stuck[row], stuck[column])] / self.limits[stuck[column]];
            weight(row) * per_force * weight(column)
        };
        let matrix = DMatrix::from_fn(stuck.len(), stuck.len(), own);
        let right = DVector::from_fn(stuck.len(), |k, _| -weight(k) * left[stuck[k]]);
        let singular = matrix.clone().svd(true, true);
        let least = SINGULAR * singular.singular_values.max();
        let found = singular.solve(&right, least).ok()?;
        for (k, &place) in stuck.iter().enumerate() {
            shares[place] = found[k] * weight(k) / self.limits[place];
        }
        let rest = &matrix * &found - &right;
        let held = rest.amax() <= UNHELD * right.amax();
        (held && found.iter().all(|share| share.is_finite())).then_some(shares)
    }

    /// Weight of a contact, as in an evaluation.
    fn weight(&self, contact: usize) -> f64 {
        let limit = self.limits[contact];
        weight(limit, self.mobility[(contact, contact)] / limit)
    }

    /// True where a combination agrees with its own forces.
    fn agrees(&self, senses: &[i8]) -> bool {
        let most = |k: usize| self.engaged[k] * (1.0 + 0.5 * EXCESS) + UNFELT;
        let Some(shares) = self.shares(senses) else {
            return false;
        };
        let mut tried = senses.to_vec();
        for k in 0..senses.len() {
            if let Some(lead) = self.leads[k] {
                if senses[k] != lead {
                    return false;
                }
                continue;
            }
            if senses[k] == 0 {
                if shares[k].abs() > most(k) {
                    return false;
                }
                continue;
            }
            // What slides is what could not be held.
            tried[k] = 0;
            let breaks = match self.shares(&tried) {
                Some(shares) => -f64::from(senses[k]) * shares[k] > most(k),
                None => self.acceleration(k, senses) * f64::from(senses[k]) > 0.0,
            };
            tried[k] = senses[k];
            if !breaks {
                return false;
            }
        }
        true
    }

    /// Acceleration of a contact in a combination.
    fn acceleration(&self, contact: usize, senses: &[i8]) -> f64 {
        let shares = self.shares(senses);
        shares.map_or(f64::NAN, |shares| {
            (&self.free + &self.mobility * shares)[contact]
        })
    }

    /// The combination that comes about: of those that agree the one with most at rest.
    ///
    /// # Errors
    /// The number of such combinations, which is not one.
    pub(super) fn decide(&self) -> Result<Vec<i8>, usize> {
        let count = self.contacts.len();
        let mut best: Option<(usize, Vec<i8>)> = None;
        let mut alike = 0;
        for number in 0..3usize.pow(count as u32) {
            let digit = |k: usize| (number / 3usize.pow(k as u32) % 3) as i8;
            let senses: Vec<i8> = (0..count).map(|k| [0, 1, -1][digit(k) as usize]).collect();
            let resting = senses.iter().filter(|&&sense| sense == 0).count();
            if best.as_ref().is_some_and(|(most, _)| resting < *most) || !self.agrees(&senses) {
                continue;
            }
            alike = match &best {
                Some((most, _)) if *most == resting => alike + 1,
                _ => 1,
            };
            best = Some((resting, senses));
        }
        match best {
            Some((_, senses)) if alike == 1 => Ok(senses),
            _ => Err(alike),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two blocks of 1 kg, the first pulled by a force, rubbing on each other (2 N) and the
    /// second on the ground (limits as given).
    fn stacked(pull: f64, ground: f64) -> AtRest {
        let limits = [2.0, ground];
        // w₁ = v₁ − v₂, w₂ = v₂.
        let mobility = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 1.0]);
        AtRest {
            contacts: vec![0, 1],
            mobility: mobility * DMatrix::from_diagonal(&DVector::from_row_slice(&limits)),
            free: DVector::from_row_slice(&[pull, 0.0]),
            limits: limits.to_vec(),
            engaged: vec![1.0, 1.0],
            begins: vec![1.0, 1.0],
            leads: vec![None, None],
        }
    }

    #[test]
    fn stacked_blocks_rest_slide_together_or_one_on_the_other() {
        // The ground holds more than the joint: the upper block alone slides beyond 2 N.
        assert_eq!(stacked(1.9, 3.0).decide(), Ok(vec![0, 0]));
        assert_eq!(stacked(2.1, 3.0).decide(), Ok(vec![1, 0]));
        assert_eq!(stacked(-2.1, 3.0).decide(), Ok(vec![-1, 0]));
        // The ground holds less: both slide together up to 2·2 − 1 N, then one on the other.
        assert_eq!(stacked(0.9, 1.0).decide(), Ok(vec![0, 0]));
        assert_eq!(stacked(2.9, 1.0).decide(), Ok(vec![0, 1]));
        assert_eq!(stacked(3.1, 1.0).decide(), Ok(vec![1, 1]));
    }

    #[test]
    fn what_can_rest_rests_and_what_holds_the_same_shares_the_force() {
        let one = |pull: f64| AtRest {
            contacts: vec![0, 1],
            mobility: DMatrix::from_row_slice(2, 2, &[1.0, 3.0, 1.0, 3.0]),
            free: DVector::from_row_slice(&[pull, pull]),
            limits: vec![1.0, 3.0],
            engaged: vec![1.0, 1.0],
            begins: vec![0.5, 0.5],
            leads: vec![None, None],
        };
        assert_eq!(one(3.9).decide(), Ok(vec![0, 0]));
        let shares = one(3.0).shares(&[0, 0]).unwrap();
        approx::assert_relative_eq!(shares[0], shares[1], max_relative = 1e-12);
        approx::assert_relative_eq!(shares[0], -0.75, max_relative = 1e-12);
        assert_eq!(one(-4.1).decide(), Ok(vec![-1, -1]));
    }
}
