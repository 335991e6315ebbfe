//! What joints look like: pitch circles, strands, pitch lines, cams with their
//! rollers.

/// A line that goes with a link; `None`: with the ground.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outline {
    /// The pitch circle of a wheel: its link, its centre in that link's frame and its radius (m).
    Circle(Option<usize>, [f64; 2], f64),
    /// A strand or a pitch line: the carrier, both ends in its frame (m).
    Line(Option<usize>, [[f64; 2]; 2]),
    /// A closed curve: the flank of a cam in its frame (m).
    Flank(Option<usize>, Vec<[f64; 2]>),
    /// The roller of a cam: its link, its centre in that link's frame and its radius (m).
    Roller(Option<usize>, [f64; 2], f64),
}
