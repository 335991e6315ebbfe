//! What a linkage does that hardly anybody means: outputs that never move, links without length,
//! approximate positions far from the assembly, cams that are undercut.

use super::Linkage;
use super::choice::{distance_from_choice, number_text};
use super::couplings;
use super::elements::slides;
use super::solve::{Guess, solve};
use super::spec::{AssemblyChoice, AssemblySpec, OutputKind};

/// An output that moves less than this, in radians or sizes of the linkage for each radian
/// or size of the input, stands still.
const STILL: f64 = 1e-9;
/// Positions at which outputs are looked at.
const POSITIONS: usize = 100;
/// An approximate position this far from the assembly, in sizes, is worth a word.
const OFF: f64 = 0.1;
/// An approximate angle this far from the only assembly that moves is worth a word (rad).
const TURNED: f64 = 0.25;
/// Points nearer than this, in sizes, lie in the same place.
const SAME_PLACE: f64 = 1e-9;

impl Linkage {
    /// Sentences about what is allowed and hardly meant.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = self.far_positions();
        remarks.extend(self.links_without_length());
        remarks.extend(self.still_outputs());
        remarks.extend(couplings::remarks_on_couplings(self.spec()));
        remarks
    }

    /// Approximate positions that are not near the assembly.
    fn far_positions(&self) -> Vec<String> {
        let (spec, plan) = (self.spec(), &self.core.plan);
        let mut state = plan.state();
        let course = &self.core.course;
        let guess = Guess::Table(&course.table);
        let at = (spec.start, spec.start);
        if solve::<1>(plan, course, guess, &mut state, at, plan.steps.len()).is_err() {
            return Vec::new();
        }
        plan.attach::<1>(&mut state);
        let far = |choice: &AssemblySpec| {
            let off = distance_from_choice(choice, &state, plan.size);
            let name = &spec.links[choice.link].name;
            match choice.choice {
                AssemblyChoice::Near { .. } if off > OFF => Some(format!(
                    "the approximate position of `{name}` is {} m away from the nearest assembly, \
                     which is taken; `near` in its `assembly` means its place where the input starts",
                    number_text(off * plan.size)
                )),
                // Of others the angle chooses the assembly, however far it is.
                AssemblyChoice::Angle(_) if off > TURNED && !spec.redundant.is_empty() => {
                    Some(format!(
                        "the approximate angle of `{name}` is {} deg away from the nearest \
                         assembly that moves",
                        number_text(off.to_degrees())
                    ))
                }
                _ => None,
            }
        };
        spec.assembly.iter().filter_map(far).collect()
    }

    /// Links of which all pins lie in one place.
    fn links_without_length(&self) -> Vec<String> {
        let (spec, size) = (self.spec(), self.typical_length());
        let links = 0..spec.links.len();
        links
            .filter_map(|link| {
                let own = spec.pairs.iter().flat_map(|pair| {
                    let sides = [pair.on, pair.link].into_iter();
                    sides.map(move |side| (pair, side))
                });
                let own: Vec<_> = own.filter(|(_, side)| side.link == Some(link)).collect();
                let (first, rest) = own.split_first()?;
                let same = |at: [f64; 2]| {
                    (at[0] - first.1.at[0]).hypot(at[1] - first.1.at[1]) <= SAME_PLACE * size
                };
                let pins = own
                    .iter()
                    .all(|(pair, side)| !slides(pair) && same(side.at));
                (pins && !rest.is_empty()).then(|| {
                    let names: Vec<&str> = own.iter().map(|(pair, _)| pair.name.as_str()).collect();
                    format!(
                        "`{}` has no length: its pins {} lie in the same place",
                        spec.links[link].name,
                        names.join(" and ")
                    )
                })
            })
            .collect()
    }

    /// Outputs that never move.
    fn still_outputs(&self) -> Vec<String> {
        let outputs = self.spec().outputs.len();
        let mut greatest = vec![0.0f64; outputs];
        let mut workspace = self.workspace();
        let inputs = &self.core.course.table.inputs;
        let (first, last) = (inputs[0], inputs[inputs.len() - 1]);
        for k in 0..POSITIONS {
            let q = first + (last - first) * (k as f64 + 0.5) / POSITIONS as f64;
            if self.solve(q, 1, &mut workspace).is_err() {
                return Vec::new();
            }
            for (output, greatest) in greatest.iter_mut().enumerate() {
                *greatest = greatest.max(self.output(output, &workspace).first.abs());
            }
        }
        let outputs = self.spec().outputs.iter().zip(greatest);
        let still = outputs
            .filter(|(output, greatest)| *greatest <= STILL * self.ordinary_transfer(&output.kind));
        still
            .map(|(output, _)| {
                let why = match output.kind {
                    OutputKind::Angle { .. } => "its link does not turn",
                    OutputKind::Point { .. } => "its direction is across the path of its point",
                    OutputKind::Pair { .. } => "both links of its pair move as one",
                };
                format!("the output `{}` never moves: {why}", output.name)
            })
            .collect()
    }

    /// Transfer function of an output that moves as the linkage is large.
    fn ordinary_transfer(&self, output: &OutputKind) -> f64 {
        let spec = self.spec();
        let sliding = |pair: usize| slides(&spec.pairs[pair]);
        let unit = |sliding: bool| if sliding { self.typical_length() } else { 1.0 };
        let own = match output {
            OutputKind::Angle { .. } => false,
            OutputKind::Point { .. } => true,
            OutputKind::Pair { pair } => sliding(*pair),
        };
        unit(own) / unit(sliding(spec.driver))
    }
}
