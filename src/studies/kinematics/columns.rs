//! The quantities of a linkage: their names, units and columns. Their values are in
//! [`super::values`], in the same order.

use super::request::KinematicsRequest;
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::spec::PairKind;
use crate::math::jet::Jet;

/// Quantity that a column shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// q, or the displacement of an output or pair.
    Displacement,
    /// Speed of the displacement.
    Speed,
    /// Acceleration of the displacement.
    Acceleration,
    /// First transfer function, d/dq.
    First,
    /// Second transfer function, d²/dq².
    Second,
    /// Third transfer function, d³/dq³.
    Third,
    /// Angle of a link's frame, continuous.
    Angle,
    /// Angular speed.
    AngularSpeed,
    /// Angular acceleration.
    AngularAcceleration,
    /// Coordinates of a point.
    X,
    /// Coordinates of a point.
    Y,
    /// Components of its speed.
    SpeedX,
    /// Components of its speed.
    SpeedY,
    /// Size of its speed.
    SpeedSize,
    /// Components of its acceleration.
    AccelerationX,
    /// Components of its acceleration.
    AccelerationY,
    /// Size of its acceleration.
    AccelerationSize,
    /// Component of its acceleration along its path, positive where it becomes faster.
    AccelerationAlong,
    /// Component of its acceleration across its path, positive to the left of the way it goes.
    AccelerationAcross,
    /// Radius of curvature of its path, positive where the path bends to the left as the
    /// input grows; none where the path is straight or has a cusp.
    CurvatureRadius,
    /// The point of the plane about which the link turns at the moment; none where it does not turn.
    InstantCentreX,
    /// The point of the plane about which the link turns at the moment; none where it does not turn.
    InstantCentreY,
    /// First transfer function of x.
    FirstX,
    /// First transfer function of y.
    FirstY,
    /// Second transfer function of x.
    SecondX,
    /// Second transfer function of y.
    SecondY,
    /// Third transfer function of x.
    ThirdX,
    /// Third transfer function of y.
    ThirdY,
    /// Direction of a guide in the plane.
    GuideDirection,
    /// Speed of the block along its guide.
    RelativeSpeed,
    /// Acceleration of the block along its guide.
    RelativeAcceleration,
    /// Speed of the guide's point under the block, along the guide.
    TransportSpeedAlong,
    /// Speed of the guide's point under the block, 90° to the left of the guide.
    TransportSpeedAcross,
    /// Acceleration of the guide's point under the block, along the guide.
    TransportAccelerationAlong,
    /// Transport acceleration, 90° to the left of the guide.
    TransportAccelerationAcross,
    /// Coriolis acceleration 2·ω·v_r, 90° to the left of the guide.
    CoriolisAcceleration,
}

/// Shape of a column's unit: length or angle over powers of input and time.
#[derive(Clone, Copy, Debug)]
enum Unit {
    Time(u8),
    Transfer(u8),
}

impl Quantity {
    /// Name in addresses and headers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Speed => "speed",
            Self::Acceleration => "acceleration",
            Self::First => "first_transfer",
            Self::Second => "second_transfer",
            Self::Third => "third_transfer",
            Self::Angle => "angle",
            Self::AngularSpeed => "angular_speed",
            Self::AngularAcceleration => "angular_acceleration",
            Self::X => "x",
            Self::Y => "y",
            Self::SpeedX => "speed_x",
            Self::SpeedY => "speed_y",
            Self::SpeedSize => "speed",
            Self::AccelerationX => "acceleration_x",
            Self::AccelerationY => "acceleration_y",
            Self::AccelerationSize => "acceleration",
            Self::AccelerationAlong => "acceleration_along_path",
            Self::AccelerationAcross => "acceleration_across_path",
            Self::CurvatureRadius => "radius_of_curvature",
            Self::InstantCentreX => "instant_centre_x",
            Self::InstantCentreY => "instant_centre_y",
            Self::FirstX => "first_transfer_x",
            Self::FirstY => "first_transfer_y",
            Self::SecondX => "second_transfer_x",
            Self::SecondY => "second_transfer_y",
            Self::ThirdX => "third_transfer_x",
            Self::ThirdY => "third_transfer_y",
            Self::GuideDirection => "guide_direction",
            Self::RelativeSpeed => "relative_speed",
            Self::RelativeAcceleration => "relative_acceleration",
            Self::TransportSpeedAlong => "transport_speed_along",
            Self::TransportSpeedAcross => "transport_speed_across",
            Self::TransportAccelerationAlong => "transport_acceleration_along",
            Self::TransportAccelerationAcross => "transport_acceleration_across",
            Self::CoriolisAcceleration => "coriolis_acceleration",
        }
    }

    /// SI units of the quantity itself, of something whose own units are these.
    pub(super) fn own_units<'a>(self, own: &'a [&'a str]) -> &'a [&'a str] {
        match self {
            Self::GuideDirection => &["rad"],
            _ => own,
        }
    }

    /// Meaning in a few words, with the sign.
    #[rustfmt::skip]
    pub(super) fn meaning(self) -> &'static str {
        match self {
            Self::Displacement => "Displacement",
            Self::Speed => "Speed of the displacement",
            Self::Acceleration => "Acceleration of the displacement",
            Self::First => "First transfer function: derivative by the input",
            Self::Second => "Second transfer function: second derivative by the input",
            Self::Third => "Third transfer function: third derivative by the input",
            Self::Angle => "Angle of the frame of the link, counterclockwise, continuous",
            Self::AngularSpeed => "Angular speed of the link, counterclockwise",
            Self::AngularAcceleration => "Angular acceleration of the link, counterclockwise",
            Self::X => "x of the point in the frame of the ground",
            Self::Y => "y of the point in the frame of the ground",
            Self::SpeedX => "x component of its speed",
            Self::SpeedY => "y component of its speed",
            Self::SpeedSize => "Size of its speed, ≥ 0",
            Self::AccelerationX => "x component of its acceleration",
            Self::AccelerationY => "y component of its acceleration",
            Self::AccelerationSize => "Size of its acceleration, ≥ 0",
            Self::AccelerationAlong => "Acceleration along its path; positive: it becomes faster",
            Self::AccelerationAcross => "Acceleration across its path; positive: to the left of its motion",
            Self::CurvatureRadius => "Radius of curvature of its path; positive: the path bends to the left",
            Self::InstantCentreX => "x of the instant centre of the link; absent where it does not turn",
            Self::InstantCentreY => "y of the instant centre of the link; absent where it does not turn",
            Self::FirstX => "First transfer function of x",
            Self::FirstY => "First transfer function of y",
            Self::SecondX => "Second transfer function of x",
            Self::SecondY => "Second transfer function of y",
            Self::ThirdX => "Third transfer function of x",
            Self::ThirdY => "Third transfer function of y",
            Self::GuideDirection => "Direction of the guide in the plane, counterclockwise",
            Self::RelativeSpeed => "Speed of the block along its guide",
            Self::RelativeAcceleration => "Acceleration of the block along its guide",
            Self::TransportSpeedAlong => "Speed of the guide's point under the block, along the guide",
            Self::TransportSpeedAcross => "Speed of the guide's point under the block, 90° to the left of the guide",
            Self::TransportAccelerationAlong => "Acceleration of the guide's point under the block, along the guide",
            Self::TransportAccelerationAcross => "Acceleration of the guide's point under the block, 90° to the left of the guide",
            Self::CoriolisAcceleration => "Coriolis acceleration 2·ω·v_r, 90° to the left of the guide",
        }
    }

    fn shape(self) -> Unit {
        match self {
            Self::Displacement
            | Self::Angle
            | Self::X
            | Self::Y
            | Self::GuideDirection
            | Self::CurvatureRadius
            | Self::InstantCentreX
            | Self::InstantCentreY => Unit::Time(0),
            Self::Speed
            | Self::AngularSpeed
            | Self::SpeedX
            | Self::SpeedY
            | Self::SpeedSize
            | Self::RelativeSpeed
            | Self::TransportSpeedAlong
            | Self::TransportSpeedAcross => Unit::Time(1),
            Self::Acceleration
            | Self::AngularAcceleration
            | Self::AccelerationX
            | Self::AccelerationY
            | Self::AccelerationSize
            | Self::AccelerationAlong
            | Self::AccelerationAcross
            | Self::RelativeAcceleration
            | Self::TransportAccelerationAlong
            | Self::TransportAccelerationAcross
            | Self::CoriolisAcceleration => Unit::Time(2),
            Self::First | Self::FirstX | Self::FirstY => Unit::Transfer(1),
            Self::Second | Self::SecondX | Self::SecondY => Unit::Transfer(2),
            Self::Third | Self::ThirdX | Self::ThirdY => Unit::Transfer(3),
        }
    }
}

impl Quantity {
    /// True for a quantity that goes through infinity in ordinary motion.
    pub fn passes_infinity(self) -> bool {
        matches!(
            self,
            Self::CurvatureRadius | Self::InstantCentreX | Self::InstantCentreY
        )
    }

    /// Ordinary size of a quantity of something of size `own` (1 rad, or the size of the
    /// linkage) behind an input of size `input` with the motion `q`.
    pub(super) fn scale(self, own: f64, input: f64, q: Jet) -> f64 {
        let rate = q.first.abs() / input;
        match self.shape() {
            Unit::Time(0) => own,
            Unit::Time(1) => own * rate,
            Unit::Time(_) => own * (rate * rate + q.second.abs() / input),
            Unit::Transfer(order) => own / input.powi(i32::from(order)),
        }
    }
}

/// SI unit of a coordinate.
pub(super) fn unit_of(coordinate: Coordinate) -> &'static str {
    match coordinate {
        Coordinate::Turning => "rad",
        Coordinate::Sliding => "m",
    }
}

/// Name of a column.
pub(super) fn name(owner: &str, quantity: Quantity, by: Option<&str>) -> String {
    let name = format!("{owner}.{}", quantity.name());
    match by {
        Some(input) => format!("{name}.{input}"),
        None => name,
    }
}

/// A column without its values.
pub(super) struct Heading {
    pub(super) owner: String,
    pub(super) quantity: Quantity,
    /// Of a transfer function: the input, where there are several.
    pub(super) by: Option<String>,
    pub(super) unit: String,
    /// True for an angle and its derivatives.
    pub(super) turning: bool,
}

pub(super) fn heading(owner: &str, quantity: Quantity, own: &str, input: &str) -> Heading {
    let unit = match quantity.shape() {
        Unit::Time(0) => own.to_owned(),
        Unit::Time(1) => format!("{own}/s"),
        Unit::Time(_) => format!("{own}/s²"),
        Unit::Transfer(order) => transfer_unit(own, input, order),
    };
    Heading {
        owner: owner.to_owned(),
        quantity,
        by: None,
        unit,
        turning: own == "rad",
    }
}

/// `m/rad²`, `1` of m/m.
fn transfer_unit(own: &str, input: &str, order: u8) -> String {
    let power = |order: u8| ["", "", "²", "³"][order as usize];
    match (own == input, order) {
        (true, 1) => "1".to_owned(),
        (true, order) => format!("1/{input}{}", power(order - 1)),
        (false, order) => format!("{own}/{input}{}", power(order)),
    }
}

pub(super) const LINK: [Quantity; 6] = [
    Quantity::Angle,
    Quantity::AngularSpeed,
    Quantity::AngularAcceleration,
    Quantity::First,
    Quantity::Second,
    Quantity::Third,
];
pub(super) const CENTRE: [Quantity; 2] = [Quantity::InstantCentreX, Quantity::InstantCentreY];
pub(super) const POINT: [Quantity; 17] = [
    Quantity::X,
    Quantity::Y,
    Quantity::SpeedX,
    Quantity::SpeedY,
    Quantity::SpeedSize,
    Quantity::AccelerationX,
    Quantity::AccelerationY,
    Quantity::AccelerationSize,
    Quantity::FirstX,
    Quantity::FirstY,
    Quantity::SecondX,
    Quantity::SecondY,
    Quantity::ThirdX,
    Quantity::ThirdY,
    Quantity::AccelerationAlong,
    Quantity::AccelerationAcross,
    Quantity::CurvatureRadius,
];
pub(super) const OUTPUT: [Quantity; 6] = [
    Quantity::Displacement,
    Quantity::Speed,
    Quantity::Acceleration,
    Quantity::First,
    Quantity::Second,
    Quantity::Third,
];
pub(super) const SLIDE: [Quantity; 12] = [
    Quantity::Displacement,
    Quantity::RelativeSpeed,
    Quantity::RelativeAcceleration,
    Quantity::First,
    Quantity::Second,
    Quantity::Third,
    Quantity::GuideDirection,
    Quantity::TransportSpeedAlong,
    Quantity::TransportSpeedAcross,
    Quantity::TransportAccelerationAlong,
    Quantity::TransportAccelerationAcross,
    Quantity::CoriolisAcceleration,
];

/// The columns of a linkage, in the order in which `values` fills them:
/// input, links, their named points, sliding pairs, outputs.
pub(super) fn headings(asked: &KinematicsRequest<'_>) -> Vec<Heading> {
    let spec = asked.linkage.spec();
    let input = unit_of(asked.input);
    let mut out = Vec::new();
    for quantity in &OUTPUT[..3] {
        out.push(heading("input", *quantity, input, input));
    }
    for link in &spec.links {
        let name = format!("links.{}", link.name);
        out.extend(LINK.map(|quantity| heading(&name, quantity, "rad", input)));
        out.extend(CENTRE.map(|quantity| heading(&name, quantity, "m", input)));
        for point in &link.points {
            let owner = format!("{name}.{}", point.name);
            out.extend(POINT.map(|quantity| heading(&owner, quantity, "m", input)));
        }
    }
    for pair in &spec.pairs {
        if matches!(pair.kind, PairKind::Sliding { .. }) {
            let name = format!("pairs.{}", pair.name);
            let slide = |quantity| {
                let angle = quantity == Quantity::GuideDirection;
                let own = if angle { "rad" } else { "m" };
                heading(&name, quantity, own, input)
            };
            out.extend(SLIDE.map(slide));
        }
    }
    for (index, output) in spec.outputs.iter().enumerate() {
        let own = unit_of(asked.outputs[index]);
        out.extend(OUTPUT.map(|quantity| heading(&output.name, quantity, own, input)));
    }
    out
}
