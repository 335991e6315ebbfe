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

/// Whether all elements are closed in their order.
#[cfg(feature = "live")]
fn is_well_formed(text: &str) -> bool {
    let mut open = Vec::new();
    for part in text.split('<').skip(1) {
        let Some((tag, _)) = part.split_once('>') else {
            return false;
        };
        match tag.strip_prefix('/') {
            Some(name) if open.pop() != Some(name) => return false,
            Some(_) => {}
            None if tag.ends_with('/') => {}
            None => open.push(tag.split(' ').next().unwrap_or(tag)),
        }
    }
    open.is_empty()
}

#[cfg(feature = "live")]
#[test]
fn mathml_says_what_the_text_says() {
    let inertia = symbol("J", Index::Mass(1)).expr();
    let speed = symbol("φ", Index::Word("left_rocker".into())).rate().expr();
    let equation = inertia.times(speed.clone()).compare(
        Relation::Equal,
        Expr::sum(vec![
            symbol("F", Index::None).expr().negative(),
            Expr::Number(-2.5),
        ]),
    );
    assert_eq!(
        equation.mathml(),
        "<msub><mi>J</mi><mn>1</mn></msub><mspace width=\"0.17em\"/>\
         <mrow data-of=\"left_rocker\"><msub><mover><mi>φ</mi><mo>˙</mo></mover><mtext>left_rocker</mtext></msub></mrow>\
         <mo>=</mo><mo form=\"prefix\">−</mo><mi>F</mi><mo>−</mo><mn>2.5</mn>"
    );
    assert_eq!(
        Expr::Number(-1.5e-7).mathml(),
        "<mo form=\"prefix\">−</mo><mn>1.5</mn><mo>·</mo><msup><mn>10</mn><mn>−7</mn></msup>"
    );
    // All that there is, nested; what is read of it is the text without its signs of layout.
    let word = |text: &str| Expr::Words(text.to_owned());
    let all = Expr::Cases(vec![
        (
            Expr::Absolute(Box::new(speed.clone().squared()))
                .over(Expr::Root(Box::new(phi(Index::Any(-1))))),
            Expr::All(vec![
                phi(Index::Mass(2)).compare(Relation::Less, Expr::Angle(PI / 3.0)),
                speed.compare(Relation::Unequal, Expr::Number(0.0)),
            ]),
        ),
        (
            Expr::Greater(
                Box::new(Expr::At(
                    symbol("U", Index::WordMass("a<b".into(), 3)).prime(),
                    Box::new(phi(Index::None)),
                )),
                Box::new(Expr::Function(
                    "sin",
                    Box::new(phi(Index::None).minus(Expr::Number(1.0))),
                )),
            ),
            word("otherwise & <else>"),
        ),
    ]);
    let mathml = all.mathml();
    assert!(is_well_formed(&mathml), "{mathml}");
    let read: String = mathml
        .split('<')
        .skip(1)
        .filter_map(|part| Some(part.split_once('>')?.1))
        .collect();
    assert_eq!(
        read.replace('\u{a0}', " "),
        "{|φ˙left_rocker2|φm−1while φ2&lt;π3 and φ˙left_rocker≠0max(Ua&lt;b,3′(φ),sin(φ−1))otherwise &amp; &lt;else&gt;"
    );
}
