use super::{Expr, Index, Relation, symbol};
use std::f64::consts::PI;

fn phi(index: Index) -> Expr {
    symbol("φ", index).expr()
}

#[test]
fn one_tree_gives_both_notations() {
    let stiffness = symbol("c", Index::Mass(2)).expr();
    let inertia = symbol("J", Index::Mass(1)).expr();
    let acceleration = symbol("φ", Index::Mass(1)).rate().rate().expr();
    let right = Expr::sum(vec![
        symbol("F", Index::None).expr().negative(),
        stiffness.times(phi(Index::Mass(2)).minus(phi(Index::Mass(1)))),
    ]);
    let equation = inertia.times(acceleration).compare(Relation::Equal, right);
    assert_eq!(equation.unicode(), "J₁φ\u{308}₁ = −F + c₂(φ₂ − φ₁)");
    assert_eq!(
        equation.latex(),
        r"J_{1}\,\ddot{\varphi}_{1} = -F + c_{2}\,\left(\varphi_{2} - \varphi_{1}\right)"
    );
}

#[test]
fn angles_are_written_as_parts_of_pi() {
    let text = |value| (Expr::Angle(value).unicode(), Expr::Angle(value).latex());
    assert_eq!(text(PI / 2.0), ("π/2".into(), r"\frac{\pi}{2}".into()));
    assert_eq!(text(-2.0 * PI / 3.0).0, "−2π/3");
    assert_eq!(text(20.0 * PI).0, "20π");
    assert_eq!(text(1.0), ("1".into(), "1".into()));
    assert_eq!(text(0.0).0, "0");
    let sine = Expr::Angle(PI / 2.0).times(Expr::Function("sin", Box::new(phi(Index::None))));
    assert_eq!(sine.unicode(), "(π/2)·sin φ");
}

#[test]
fn brackets_stand_where_they_must() {
    let (a, b) = (symbol("a", Index::None), symbol("b", Index::None));
    let sum = || a.clone().expr().plus(b.clone());
    assert_eq!(sum().negative().unicode(), "−(a + b)");
    assert_eq!(sum().squared().unicode(), "(a + b)²");
    assert_eq!(a.clone().expr().over(sum()).unicode(), "a/(a + b)");
    let prime = symbol("U", Index::Word("r_1".into())).prime();
    assert_eq!(prime.clone().expr().squared().unicode(), "(U′_r_1)²");
    assert_eq!(
        prime.expr().squared().latex(),
        r"\left(U'_{\mathrm{r\_1}}\right)^{2}"
    );
    assert_eq!(Expr::Number(-2.0).times(a).unicode(), "(−2)a");
    assert_eq!(Expr::Number(1.5e-7).latex(), r"1.5 \cdot 10^{-7}");
}
