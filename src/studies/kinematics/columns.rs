//! The quantities of a linkage: their names, units and columns. Their values are in
//! [`super::values`], in the same order.

use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::spec::LinkageSpec;
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
    /// What is declared of a quantity: its name in addresses and headers, the shape of its unit,
    /// and its meaning in a few words, with the sign.
    #[rustfmt::skip]
    fn declared(self) -> (&'static str, Unit, &'static str) {
        match self {
            Self::Displacement => ("displacement", Unit::Time(0), "Displacement"),
            Self::Speed => ("speed", Unit::Time(1), "Speed of the displacement"),
            Self::Acceleration => ("acceleration", Unit::Time(2), "Acceleration of the displacement"),
            Self::First => ("first_transfer", Unit::Transfer(1), "First transfer function: derivative by the input"),
            Self::Second => ("second_transfer", Unit::Transfer(2), "Second transfer function: second derivative by the input"),
            Self::Third => ("third_transfer", Unit::Transfer(3), "Third transfer function: third derivative by the input"),
            Self::Angle => ("angle", Unit::Time(0), "Angle of the frame of the link, counterclockwise, continuous"),
            Self::AngularSpeed => ("angular_speed", Unit::Time(1), "Angular speed of the link, counterclockwise"),
            Self::AngularAcceleration => ("angular_acceleration", Unit::Time(2), "Angular acceleration of the link, counterclockwise"),
            Self::X => ("x", Unit::Time(0), "x of the point in the frame of the ground"),
            Self::Y => ("y", Unit::Time(0), "y of the point in the frame of the ground"),
            Self::SpeedX => ("speed_x", Unit::Time(1), "x component of its speed"),
            Self::SpeedY => ("speed_y", Unit::Time(1), "y component of its speed"),
            Self::SpeedSize => ("speed", Unit::Time(1), "Size of its speed, ≥ 0"),
            Self::AccelerationX => ("acceleration_x", Unit::Time(2), "x component of its acceleration"),
            Self::AccelerationY => ("acceleration_y", Unit::Time(2), "y component of its acceleration"),
            Self::AccelerationSize => ("acceleration", Unit::Time(2), "Size of its acceleration, ≥ 0"),
            Self::AccelerationAlong => ("acceleration_along_path", Unit::Time(2), "Acceleration along its path; positive: it becomes faster"),
            Self::AccelerationAcross => ("acceleration_across_path", Unit::Time(2), "Acceleration across its path; positive: to the left of its motion"),
            Self::CurvatureRadius => ("radius_of_curvature", Unit::Time(0), "Radius of curvature of its path; positive: the path bends to the left"),
            Self::InstantCentreX => ("instant_centre_x", Unit::Time(0), "x of the instant centre of the link; absent where it does not turn"),
            Self::InstantCentreY => ("instant_centre_y", Unit::Time(0), "y of the instant centre of the link; absent where it does not turn"),
            Self::FirstX => ("first_transfer_x", Unit::Transfer(1), "First transfer function of x"),
            Self::FirstY => ("first_transfer_y", Unit::Transfer(1), "First transfer function of y"),
            Self::SecondX => ("second_transfer_x", Unit::Transfer(2), "Second transfer function of x"),
            Self::SecondY => ("second_transfer_y", Unit::Transfer(2), "Second transfer function of y"),
            Self::ThirdX => ("third_transfer_x", Unit::Transfer(3), "Third transfer function of x"),
            Self::ThirdY => ("third_transfer_y", Unit::Transfer(3), "Third transfer function of y"),
            Self::GuideDirection => ("guide_direction", Unit::Time(0), "Direction of the guide in the plane, counterclockwise"),
            Self::RelativeSpeed => ("relative_speed", Unit::Time(1), "Speed of the block along its guide"),
            Self::RelativeAcceleration => ("relative_acceleration", Unit::Time(2), "Acceleration of the block along its guide"),
            Self::TransportSpeedAlong => ("transport_speed_along", Unit::Time(1), "Speed of the guide's point under the block, along the guide"),
            Self::TransportSpeedAcross => ("transport_speed_across", Unit::Time(1), "Speed of the guide's point under the block, 90° to the left of the guide"),
            Self::TransportAccelerationAlong => ("transport_acceleration_along", Unit::Time(2), "Acceleration of the guide's point under the block, along the guide"),
            Self::TransportAccelerationAcross => ("transport_acceleration_across", Unit::Time(2), "Acceleration of the guide's point under the block, 90° to the left of the guide"),
            Self::CoriolisAcceleration => ("coriolis_acceleration", Unit::Time(2), "Coriolis acceleration 2·ω·v_r, 90° to the left of the guide"),
        }
    }

    /// Name in addresses and headers.
    pub fn name(self) -> &'static str {
        self.declared().0
    }

    fn shape(self) -> Unit {
        self.declared().1
    }

    /// Meaning in a few words, with the sign.
    pub(super) fn meaning(self) -> &'static str {
        self.declared().2
    }

    /// SI unit of the quantity itself, of something whose own unit is this.
    fn own_unit(self, own: &str) -> &str {
        match self {
            Self::GuideDirection => "rad",
            Self::InstantCentreX | Self::InstantCentreY => "m",
            _ => own,
        }
    }

    /// True for a quantity that goes through infinity in ordinary motion.
    pub fn passes_infinity(self) -> bool {
        matches!(
            self,
            Self::CurvatureRadius | Self::InstantCentreX | Self::InstantCentreY
        )
    }

    /// Ordinary size of a quantity of something of size `own` (1 rad, or the size of the
    /// linkage) behind an input of size `input` with the motion `q`.
    pub(super) fn ordinary_size(self, own: f64, input: f64, q: Jet) -> f64 {
        let rate = q.first.abs() / input;
        match self.shape() {
            Unit::Time(0) => own,
            Unit::Time(1) => own * rate,
            Unit::Time(_) => own * (rate * rate + q.second.abs() / input),
            Unit::Transfer(order) => own / input.powi(i32::from(order)),
        }
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
pub(super) struct ColumnHeading {
    pub(super) owner: String,
    pub(super) quantity: Quantity,
    /// Of a transfer function: the input, where there are several.
    pub(super) by: Option<String>,
    pub(super) unit: String,
    /// True for an angle and its derivatives.
    pub(super) turning: bool,
}

pub(super) fn heading(owner: &str, quantity: Quantity, own: &str, input: &str) -> ColumnHeading {
    let own = quantity.own_unit(own);
    let unit = match quantity.shape() {
        Unit::Time(0) => own.to_owned(),
        Unit::Time(1) => format!("{own}/s"),
        Unit::Time(_) => format!("{own}/s²"),
        Unit::Transfer(order) => transfer_unit(own, input, order),
    };
    ColumnHeading {
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

/// The quantities of an owner, in the order of its columns with one input.
pub(super) struct Quantities {
    /// Its motion over time.
    pub(super) motion: &'static [Quantity],
    /// Its transfer functions, of ascending order.
    pub(super) transfer: &'static [Quantity],
    /// What follows from its motion.
    pub(super) more: &'static [Quantity],
}

impl Quantities {
    /// All of them.
    pub(super) fn all(&self) -> impl Iterator<Item = Quantity> {
        let parts = [self.motion, self.transfer, self.more];
        parts.into_iter().flatten().copied()
    }

    /// The first transfer functions: all that there is of several inputs.
    pub(super) fn first_transfer_functions(&self) -> impl Iterator<Item = Quantity> {
        let transfer = self.transfer.iter().copied();
        transfer.filter(|quantity| matches!(quantity.shape(), Unit::Transfer(1)))
    }
}

use Quantity as Q;
pub(super) const LINK: Quantities = Quantities {
    motion: &[Q::Angle, Q::AngularSpeed, Q::AngularAcceleration],
    transfer: &[Q::First, Q::Second, Q::Third],
    more: &[Q::InstantCentreX, Q::InstantCentreY],
};
#[rustfmt::skip]
pub(super) const POINT: Quantities = Quantities {
    motion: &[
        Q::X, Q::Y, Q::SpeedX, Q::SpeedY, Q::SpeedSize,
        Q::AccelerationX, Q::AccelerationY, Q::AccelerationSize,
    ],
    transfer: &[Q::FirstX, Q::FirstY, Q::SecondX, Q::SecondY, Q::ThirdX, Q::ThirdY],
    more: &[Q::AccelerationAlong, Q::AccelerationAcross, Q::CurvatureRadius],
};
pub(super) const OUTPUT: Quantities = Quantities {
    motion: &[Q::Displacement, Q::Speed, Q::Acceleration],
    transfer: LINK.transfer,
    more: &[],
};
pub(super) const SLIDE: Quantities = Quantities {
    motion: &[Q::Displacement, Q::RelativeSpeed, Q::RelativeAcceleration],
    transfer: LINK.transfer,
    more: &[
        Q::GuideDirection,
        Q::TransportSpeedAlong,
        Q::TransportSpeedAcross,
        Q::TransportAccelerationAlong,
        Q::TransportAccelerationAcross,
        Q::CoriolisAcceleration,
    ],
};

/// What moves a linkage.
pub(super) enum Inputs<'a> {
    /// One input: its transfer functions stand amid the other quantities.
    One(Coordinate),
    /// Several: first transfer functions by each of them stand behind.
    Several(Vec<(&'a str, Coordinate)>),
}

impl Inputs<'_> {
    /// Columns of an owner whose own unit is this.
    fn of_owner(&self, owner: &str, quantities: &Quantities, own: &str) -> Vec<ColumnHeading> {
        let inputs = match self {
            Self::One(only) => {
                let heading = |what| heading(owner, what, own, only.unit());
                return quantities.all().map(heading).collect();
            }
            Self::Several(inputs) => inputs,
        };
        let moved = quantities.motion.iter().chain(quantities.more);
        let moved = moved.map(|&what| heading(owner, what, own, ""));
        let by = inputs.iter().flat_map(|&(input, coordinate)| {
            quantities
                .first_transfer_functions()
                .map(move |what| ColumnHeading {
                    by: Some(input.to_owned()),
                    ..heading(owner, what, own, coordinate.unit())
                })
        });
        moved.chain(by).collect()
    }
}

/// The columns of a linkage, in the order in which `values` fills them:
/// inputs, links, their named points, sliding pairs, outputs.
pub(super) fn headings(
    spec: &LinkageSpec,
    inputs: &Inputs<'_>,
    outputs: &[Coordinate],
) -> Vec<ColumnHeading> {
    let named = match inputs {
        Inputs::One(only) => &vec![("input", *only)],
        Inputs::Several(inputs) => inputs,
    };
    let mut out = Vec::new();
    for (name, own) in named {
        let motion = OUTPUT.motion.iter();
        out.extend(motion.map(|&what| heading(name, what, own.unit(), own.unit())));
    }
    let mut add = |owner: &str, quantities: &Quantities, own: &str| {
        out.extend(inputs.of_owner(owner, quantities, own));
    };
    for link in &spec.links {
        let name = format!("links.{}", link.name);
        add(&name, &LINK, "rad");
        for point in &link.points {
            add(&format!("{name}.{}", point.name), &POINT, "m");
        }
    }
    for pair in spec.pairs.iter().filter(|pair| pair.slides()) {
        add(&format!("pairs.{}", pair.name), &SLIDE, "m");
    }
    for (output, own) in spec.outputs.iter().zip(outputs) {
        add(&output.name, &OUTPUT, own.unit());
    }
    out
}
