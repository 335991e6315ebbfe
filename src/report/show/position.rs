//! Position functions and prescribed motions as formulas.

use crate::model::Law;
use crate::motion::DriveMotion;
use crate::position::Position;
use crate::report::math::{Expr, Index, symbol};

/// U at the displacement `phi`, the lever included, as a formula; functions
/// without a short formula are named in words.
pub fn formula(law: &Law, phi: Expr) -> Expr {
    let bare = position_formula(&law.position, phi);
    if law.lever == 1.0 {
        bare
    } else {
        Expr::Number(law.lever).times(bare)
    }
}

/// U(φ) in a few words, for the edges of the object graph.
pub fn summary(law: &Law) -> String {
    formula(law, symbol("φ", Index::None).expr()).unicode()
}

fn position_formula(position: &Position, phi: Expr) -> Expr {
    match position {
        Position::Ratio { ratio, offset } => {
            Expr::sum(vec![Expr::Number(*ratio).times(phi), Expr::Angle(*offset)])
        }
        Position::Sine {
            amplitude,
            harmonic,
            phase,
            offset,
        } => {
            let argument = Expr::sum(vec![
                Expr::Number(*harmonic).times(phi),
                Expr::Angle(*phase),
            ]);
            let wave = Expr::Function("sin", Box::new(argument));
            Expr::sum(vec![
                Expr::Angle(*amplitude).times(wave),
                Expr::Angle(*offset),
            ])
        }
        Position::Custom(_) => Expr::Words("own function of the driver's displacement".into()),
    }
}

/// φ(t) of a prescribed drive as a formula.
pub fn motion_formula(motion: &DriveMotion) -> Expr {
    match motion {
        DriveMotion::Constant { speed, angle } => {
            let time = symbol("t", Index::None);
            Expr::sum(vec![Expr::Angle(*speed).times(time), Expr::Angle(*angle)])
        }
    }
}

/// A prescribed motion in a few words, for the box of the drive.
pub fn motion_summary(motion: &DriveMotion) -> String {
    match motion {
        DriveMotion::Constant { speed, .. } => {
            format!("{} rad/s", Expr::Angle(*speed).unicode())
        }
    }
}
