use super::*;
use crate::dynamics::laws::parameter::Domain;

/// Numbers at which a law is tried.
fn tried(law: &'static ContactForceLaw) -> ContactLaw {
    let number = |own: &&Parameter| match own.domain {
        Domain::Between(from, to) => from + 0.6 * (to - from),
        _ => 1.75,
    };
    ContactLaw::new(law, law.parameters.iter().map(number))
}

#[test]
fn what_a_law_declares_is_what_its_form_is() {
    for declared in CONTACT_LAWS {
        let law = tried(declared);
        let form = law.form();
        assert_eq!(declared.is_linear(), form.is_linear(), "{}", declared.key);
        assert_eq!(declared.is_rigid(), law.is_rigid(), "{}", declared.key);
        let of_power = matches!(form, ContactForm::Power { .. });
        assert_eq!(declared.has_power_stiffness(), of_power, "{}", declared.key);
        assert!(declared.parameters.len() <= MOST, "{}", declared.key);
        let loses = !declared.parameters.is_empty();
        assert_eq!(law.is_lossless(), !loses, "{}", declared.key);
        let numbers: Vec<f64> = law.parameters().map(|(_, value)| value).collect();
        assert_eq!(ContactLaw::law_of_key(declared.key, &numbers), Some(law));
    }
    assert_eq!(ContactLaw::law_of_key("hertz", &[]), None);
}

/// What a law says of its force agrees with its form. The words are written for people, here
/// as numbers: `K` and `k` the stiffness.
#[test]
fn the_force_that_the_schema_states_is_that_of_the_form() {
    let (stiffness, p, rate) = (7.0, 0.25, 0.5);
    for declared in CONTACT_LAWS {
        let law = tried(declared);
        let (form, damping) = law.of_link(0.0);
        if form.restitution().is_some() {
            continue;
        }
        let names = ["p", "p_dot", "k"].into_iter();
        let keys = declared.parameters.iter().map(|own| own.key);
        let names: Vec<&str> = names.chain(keys).collect();
        let text = declared
            .doc
            .replace('·', "*")
            .replace('−', "-")
            .replace('ṗ', "p_dot")
            .replace('K', "k");
        let formula = crate::math::expression::Expression::new(&text, &names).expect(&text);
        let own = [p, rate, stiffness].into_iter();
        let values: Vec<f64> = own.chain(law.parameters().map(|own| own.1)).collect();
        let stated = formula
            .program()
            .value
            .evaluate(&values, &|_| crate::math::expression::OPEN);
        let elastic = stiffness * f64::powf(p, form.exponent());
        let force = match form.factor() {
            None => elastic + damping * rate,
            Some(chi) => elastic * (1.0 + chi * rate),
        };
        approx::assert_relative_eq!(stated, force, max_relative = 1e-14);
    }
}

#[test]
fn a_property_of_several_laws_names_them() {
    let docs: Vec<String> = properties().into_iter().map(|(_, doc)| doc).collect();
    let wanted = "χ of `hunt_crossley` and `hertz`, seconds per unit of indentation";
    assert!(docs.iter().any(|doc| doc == wanted), "{docs:?}");
    assert_eq!(
        keys(|law| law.is_linear(), "`", "and"),
        "`elastic` and `kelvin_voigt`"
    );
    assert_eq!(keys(|law| law.is_rigid(), "", "or"), "restitution");
    assert_eq!(law_of_link(Loss::Factor(0.5)).key, "hunt_crossley");
    assert_eq!(law_of_link(Loss::Damper).key, "kelvin_voigt");
}
