//! Places in the tolerance zones: points of a Sobol sequence with Owen's scrambling
//! (B. Burley, Journal of Computer Graphics Techniques 9(4), 2020).

use super::zone::Zone;
use crate::dynamics::audit::draw;
use sobol_burley::{NUM_DIMENSIONS, sample};

/// Most dimensions: two coordinates each.
pub const MOST_DIMENSIONS: usize = NUM_DIMENSIONS as usize / 2;

/// Most samples: the sequence has 2¹⁶ points, and each makes two.
pub const MOST_SAMPLES: usize = 1 << 17;

/// Half of the distance of two coordinates, which are multiples of 2⁻²⁴.
const HALF_STEP: f64 = 1.0 / (1 << 25) as f64;

/// The plan of a study by samples: each point of the sequence makes two samples, A and B, that
/// are independent. A sample whose other dimensions are those of A and whose dimension i is that
/// of B shows the effect of i (I. M. Sobol 2001; A. Saltelli and others 2010).
#[derive(Clone, Debug, PartialEq)]
pub struct SamplePlan {
    zones: Vec<Zone>,
    seed: u32,
    /// Whether effects of single dimensions are looked at.
    mixed: bool,
}

impl SamplePlan {
    /// A plan. With one dimension there is nothing to mix.
    pub fn new(zones: Vec<Zone>, seed: u32) -> Self {
        let mixed = zones.len() > 1;
        Self { zones, seed, mixed }
    }

    /// Number of runs of a point.
    pub fn runs(&self) -> usize {
        2 + if self.mixed { self.zones.len() } else { 0 }
    }

    /// The runs of a point, as deviations of all dimensions: A, B, then A with each dimension of
    /// B in turn.
    pub fn rows(&self, point: usize) -> Vec<Vec<f64>> {
        let count = self.zones.len();
        let seed = draw(u64::from(self.seed)) as u32;
        // (Neighbouring dimensions of the sequence are paired best.)
        let of = |which: usize| -> Vec<f64> {
            let coordinate = |at: usize| {
                let own = sample(point as u32, (2 * at + which) as u32, seed);
                f64::from(own) + HALF_STEP
            };
            let each = self.zones.iter().enumerate();
            each.map(|(at, zone)| zone.quantile(coordinate(at)))
                .collect()
        };
        let (a, b) = (of(0), of(1));
        let mixed = (0..count).filter(|_| self.mixed).map(|at| {
            let mut row = a.clone();
            row[at] = b[at];
            row
        });
        let mixed: Vec<Vec<f64>> = mixed.collect();
        [a, b].into_iter().chain(mixed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::zone::{Distribution, Zone};
    use super::SamplePlan;

    fn zones() -> Vec<Zone> {
        let zone = |distribution| Zone {
            lower: 1.0,
            upper: 3.0,
            distribution,
        };
        vec![zone(Distribution::Uniform), zone(Distribution::Normal)]
    }

    #[test]
    fn samples_have_the_distribution_of_their_zones() {
        let plan = SamplePlan::new(zones(), 7);
        let rows: Vec<Vec<f64>> = (0..4096)
            .flat_map(|point| plan.rows(point).into_iter().take(2))
            .collect();
        for (at, zone) in zones().iter().enumerate() {
            let values: Vec<f64> = rows.iter().map(|row| row[at]).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let squares = values.iter().map(|value| (value - 2.0).powi(2));
            let sigma = (squares.sum::<f64>() / values.len() as f64).sqrt();
            assert!((mean - 2.0).abs() < 1e-4, "{mean}");
            assert!((sigma / zone.sigma() - 1.0).abs() < 2e-3, "{sigma}");
            assert!(values.iter().all(|value| value.is_finite()));
        }
        let within = rows.iter().filter(|row| (1.0..=3.0).contains(&row[0]));
        assert_eq!(within.count(), rows.len());
    }

    #[test]
    fn a_mixed_sample_differs_from_a_in_one_dimension() {
        let plan = SamplePlan::new(zones(), 1);
        let rows = plan.rows(5);
        assert_eq!(rows.len(), plan.runs());
        assert_eq!(rows[2], [rows[1][0], rows[0][1]]);
        assert_eq!(rows[3], [rows[0][0], rows[1][1]]);
        assert_ne!(SamplePlan::new(zones(), 2).rows(5), rows);
        assert_eq!(SamplePlan::new(zones()[..1].to_vec(), 1).rows(5).len(), 2);
    }
}
