//! Did you mean …?

/// The candidate most like `word`, if any is like enough.
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    most_like(word, &mut candidates.into_iter())
}

fn most_like<'a>(word: &str, candidates: &mut dyn Iterator<Item = &'a str>) -> Option<&'a str> {
    // Long strangers cannot be a slip of the pen, and would cost time.
    if word.len() > 64 {
        return None;
    }
    let lower = word.to_lowercase();
    let score = |candidate: &str| {
        let other = candidate.to_lowercase();
        let edits = strsim::damerau_levenshtein(&lower, &other);
        let longest = lower.chars().count().max(other.chars().count()).max(1);
        let close_in_edits = edits * 3 <= longest + 1;
        let alike = strsim::jaro_winkler(&lower, &other);
        (close_in_edits || alike > 0.9).then_some((edits, alike))
    };
    // The fewest edits; of several the one that is most alike.
    let mut best: Option<((usize, f64), &str)> = None;
    for candidate in candidates {
        if let Some((edits, alike)) = score(candidate)
            && best.is_none_or(|((few, most), _)| edits < few || edits == few && alike > most)
        {
            best = Some(((edits, alike), candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The hint ``did you mean `rocker`?``, if any candidate is like enough.
pub fn did_you_mean<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    closest(word, candidates).map(|found| format!("did you mean `{found}`?"))
}

/// `` `a`, `b` or `c` ``; a dash when there is nothing.
pub fn quoted_list<'a>(names: impl IntoIterator<Item = &'a str>, last_word: &str) -> String {
    list_of_quoted(&mut names.into_iter(), last_word)
}

fn list_of_quoted(names: &mut dyn Iterator<Item = &str>, last_word: &str) -> String {
    let mut quoted: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    match quoted.pop() {
        None => "—".to_owned(),
        Some(only) if quoted.is_empty() => only,
        Some(last) => format!("{} {last_word} {last}", quoted.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let kinds = [
            "drive",
            "shaft",
            "crank",
            "rocker",
            "slider",
            "cam_follower",
        ];
        assert_eq!(closest("rokcer", kinds), Some("rocker"));
        assert_eq!(closest("Slider", kinds), Some("slider"));
        assert_eq!(closest("camfollower", kinds), Some("cam_follower"));
        assert_eq!(closest("banana", kinds), None);
        assert_eq!(closest("", kinds), None);
    }
}
