//! The accuracy that arguments ask for.

use super::failure::Failure;
use crate::studies::order::USUAL_SHARE;
use serde_json::Value;

/// The setting of `run.accuracy` that `--accuracy` and `--figure` stand for: a share of all
/// figures, or one for each. None where nothing is said.
pub(super) fn setting(accuracies: &[String], figures: &[String]) -> Result<Vec<String>, Failure> {
    let (of_one, of_all): (Vec<&String>, Vec<&String>) =
        accuracies.iter().partition(|given| given.contains('='));
    let share = match of_all[..] {
        [] => None,
        [share] if of_one.is_empty() => Some(share.as_str()),
        _ => {
            return Err(Failure::Other(format!(
                "--accuracy {}: a share of all results is given alone; for several write \
                 FIGURE=ACCURACY, for example rocker.delta_abs=\"1 %\"",
                of_all[0]
            )));
        }
    };
    if let (Some(share), true) = (share, figures.is_empty()) {
        return Ok(vec![format!("run.accuracy={share}")]);
    }
    let mut all = serde_json::Map::new();
    let usual = format!("{} %", 100.0 * USUAL_SHARE);
    for figure in figures {
        let figure = figure.trim().to_owned();
        all.insert(figure, number_or_text(share.unwrap_or(&usual)));
    }
    for one in of_one {
        if let Some((figure, accuracy)) = one.split_once('=') {
            all.insert(figure.trim().to_owned(), number_or_text(accuracy));
        }
    }
    Ok(match all.is_empty() {
        true => Vec::new(),
        false => vec![format!("run.accuracy={}", Value::from(all))],
    })
}

/// A number, or a text with a unit.
fn number_or_text(text: &str) -> Value {
    let text = text.trim();
    let number = text.parse::<f64>().ok().map(Value::from);
    number.unwrap_or_else(|| Value::from(text))
}

#[cfg(test)]
mod tests {
    use super::setting;

    #[test]
    fn a_share_is_of_all_or_of_those_named() {
        let asked = |accuracies: &[&str], figures: &[&str]| {
            let owned = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect();
            let (accuracies, figures): (Vec<String>, Vec<String>) =
                (owned(accuracies), owned(figures));
            setting(&accuracies, &figures).ok().map(|all| all.join(","))
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(asked(&[], &[]), some(""));
        assert_eq!(asked(&["2 %"], &[]), some("run.accuracy=2 %"));
        assert_eq!(
            asked(&["2 %"], &["a.b"]),
            some(r#"run.accuracy={"a.b":"2 %"}"#)
        );
        assert_eq!(asked(&[], &["a.b"]), some(r#"run.accuracy={"a.b":"1 %"}"#));
        assert_eq!(asked(&["a.b=2"], &[]), some(r#"run.accuracy={"a.b":2.0}"#));
        assert_eq!(asked(&["1 %", "a.b=2"], &[]), None);
        assert_eq!(asked(&["1 %", "2 %"], &[]), None);
    }
}
