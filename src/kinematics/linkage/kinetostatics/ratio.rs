//! Kinematic ratio i and dynamic transmission ratio χ of an output.

use super::Kinetostatics;
use super::external::{Input, wrenches};
use super::place::AT_REST;
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::spec::{ForceLaw, OutputKind};

/// Sign that the dynamic transmission ratio is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Convention {
    /// χ = M₁/Mₙ·sign i⁺, both positive along their coordinates; without masses
    /// and friction χ = −|i| (K. Maczyński, S. Suwaj, 1987).
    #[default]
    Paper,
    /// The load counted positive against its coordinate; without masses and
    /// friction χ = +|i|.
    LoadPositive,
}

impl Convention {
    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::LoadPositive => "load_positive",
        }
    }
}

/// What an output and its load make of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transmission {
    /// Kinematic ratio i: output's displacement per unit of the input.
    pub ratio: f64,
    /// di/dq.
    pub slope: f64,
    /// Sign of i, just after the position where i = 0 (sign i⁺).
    pub sign: f64,
    /// Generalised force Mₙ of the load along the output (N·m or N); `None`
    /// where the load has no such equivalent.
    pub load: Option<f64>,
    /// Power of the load (W), positive where it drives.
    pub load_power: f64,
}

impl Transmission {
    /// Dynamic transmission ratio for a driving force (m, 1, 1/m); `None`
    /// without a load.
    pub fn dynamic_ratio(&self, drive: f64, convention: Convention) -> Option<f64> {
        let load = self.load.filter(|load| *load != 0.0)?;
        let chi = drive / load * self.sign;
        Some(match convention {
            Convention::Paper => chi,
            Convention::LoadPositive => -chi,
        })
    }

    /// True where the load drives: it pushes the output along its motion, or
    /// is about to.
    pub fn load_drives(&self, direction: f64) -> bool {
        self.load
            .is_some_and(|load| load * self.sign * direction > 0.0)
    }
}

impl Kinetostatics {
    /// Forces, couples and tables that act on the link of an output: its load.
    pub fn loads_of(&self, output: usize) -> Vec<usize> {
        let Some(link) = self.output_link(output) else {
            return Vec::new();
        };
        let acts = |law: &ForceLaw| match law {
            ForceLaw::Force { point, .. } | ForceLaw::Table { point, .. } => {
                point.link == Some(link)
            }
            ForceLaw::Couple { link: on, .. } | ForceLaw::CoupleTable { link: on, .. } => {
                *on == link
            }
            ForceLaw::Strut { .. } | ForceLaw::Torsion { .. } => false,
        };
        let forces = self.spec.forces.iter().enumerate();
        forces
            .filter(|(_, force)| acts(&force.law))
            .map(|(index, _)| index)
            .collect()
    }

    /// Ratio, sign and load of an output at the position solved last.
    /// `loads`: indices of the forces that make up the load.
    pub fn transmission(
        &self,
        output: usize,
        loads: &[usize],
        coordinate: f64,
        w: &ForceWorkspace,
    ) -> Transmission {
        let [ratio, slope] = self.output_rates(output, w);
        let scale = AT_REST * self.output_scale(output);
        let sign = if ratio.abs() > scale {
            ratio.signum()
        } else if slope.abs() > scale {
            (slope * w.direction).signum()
        } else {
            0.0
        };
        let input = Input {
            coordinate,
            speed: w.speed,
        };
        let behind = w.output_loads[output];
        let own = self.load(output, loads, input, [ratio, slope], w);
        let load = match own {
            Some(own) if !loads.is_empty() => Some(own + behind),
            None if !loads.is_empty() => None,
            _ => (behind != 0.0).then_some(behind),
        };
        let forces: f64 = loads.iter().map(|&force| w.forces[force]).sum();
        Transmission {
            ratio,
            slope,
            sign,
            load,
            load_power: (forces + w.output_forces[output]) * w.speed,
        }
    }

    /// Mₙ: couples and forces on the output's link, reduced to the output.
    fn load(
        &self,
        output: usize,
        loads: &[usize],
        input: Input,
        [ratio, slope]: [f64; 2],
        w: &ForceWorkspace,
    ) -> Option<f64> {
        let link = self.output_link(output)?;
        let frame = &w.links[link];
        let pivot = self.pivot(link, w);
        let (mut sum, mut work, mut change) = (0.0, 0.0, 0.0);
        for &force in loads {
            let found = wrenches(
                &self.spec.forces[force].law,
                &w.links,
                input,
                |pair| [w.pairs[pair].coordinate, w.pairs[pair].rates[0]],
                |_| [None; 2],
            );
            for wrench in found.into_iter().flatten() {
                let [fx, fy] = wrench.force;
                let at = &wrench.point;
                work += fx * at.first[0] + fy * at.first[1] + wrench.couple * frame.first[2];
                change += fx * at.second[0] + fy * at.second[1] + wrench.couple * frame.second[2];
                sum += match self.direct(output, pivot, w) {
                    Direct::Moment([x, y]) => {
                        wrench.couple + (at.place[0] - x) * fy - (at.place[1] - y) * fx
                    }
                    Direct::Along([x, y]) => fx * x + fy * y,
                    Direct::Work => 0.0,
                };
            }
        }
        let clear = 1e-6 * self.output_scale(output);
        match self.direct(output, pivot, w) {
            Direct::Work if ratio.abs() > clear => Some(work / ratio),
            Direct::Work if work.abs() <= clear * change.abs() && slope.abs() > clear => {
                Some(change / slope)
            }
            Direct::Work => None,
            _ => Some(sum),
        }
    }

    /// Where a link turns about a point of the ground.
    fn pivot(&self, link: usize, w: &ForceWorkspace) -> Option<[f64; 2]> {
        let pairs = self.spec.pairs.iter().enumerate();
        let mut grounded = pairs.filter(|(_, pair)| {
            let ends = [pair.on.link, pair.link.link];
            let turns = !pair.slides();
            turns && ends.contains(&None) && ends.contains(&Some(link))
        });
        grounded.next().map(|(index, _)| w.pairs[index].point)
    }

    /// How the load of an output follows without its rate, which may vanish.
    fn direct(&self, output: usize, pivot: Option<[f64; 2]>, w: &ForceWorkspace) -> Direct {
        let rest = AT_REST * self.units[self.spec.driver] / self.length;
        let slides = |link: usize| {
            let frame = &w.links[link];
            frame.first[2].abs() <= rest && frame.second[2].abs() <= rest
        };
        match (self.spec.outputs[output].kind, pivot) {
            (OutputKind::Angle { .. }, Some(pivot)) => Direct::Moment(pivot),
            (OutputKind::Pair { pair }, pivot) => match (self.spec.pairs[pair].slides(), pivot) {
                (false, Some(pivot)) => Direct::Moment(pivot),
                (true, _) => Direct::Along(w.pairs[pair].tangent),
                _ => Direct::Work,
            },
            (OutputKind::Point { point, direction }, _) if point.link.is_some_and(slides) => {
                let (sin, cos) = direction.sin_cos();
                Direct::Along([cos, sin])
            }
            _ => Direct::Work,
        }
    }
}

/// How a load is reduced to its output.
#[derive(Clone, Copy, Debug)]
enum Direct {
    /// Moment about a fixed point.
    Moment([f64; 2]),
    /// Component along a direction.
    Along([f64; 2]),
    /// Virtual work over the ratio.
    Work,
}
