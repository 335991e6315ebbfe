//! Whatever the bytes, reading ends with a scene or with diagnostics: never
//! with a panic, and never late.

use dam::scene::{BuiltIn, Document, Overrides, Reading};
use std::time::{Duration, Instant};

const SEEDS: [&str; 2] = [
    include_str!("../schema_scene.json"),
    include_str!("../rocker_scene.json"),
];

/// Numbers and texts that break careless readers.
const NASTY: &[&str] = &[
    "1e999",
    "-1e999",
    "1e-999",
    "-0",
    "0",
    "1e308",
    "-1e308",
    "5e-324",
    "4294967296",
    "1e18",
    "0.30000000000000004",
    "null",
    "true",
    "\"\"",
    "\"1e999 m\"",
    "\"-1e308 km\"",
    "\"90 deg\"",
    "\"1 m^9\"",
    "\"1 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9\"",
    "\"1 /\"",
    "\"\\u0000\"",
    "\"\\ud800\"",
    "\"µ\"",
    "\"1 µ\"",
    "[]",
    "{}",
    "[[]]",
    "{\"\":{}}",
    "\"run\"",
    "\"rocker\"",
    "1e",
    "--1",
    "01",
    "0x10",
    "NaN",
    "'a'",
    "// x",
    "/*",
    "\u{feff}",
    "\u{2028}",
    "é",
    "10000",
];

/// A small generator with a fixed seed (xorshift64*).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.next() >> 16) as usize % bound.max(1)
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

fn read(bytes: &[u8], overrides: &Overrides) -> Option<Reading> {
    let document = match Document::parse("x.json", bytes) {
        Ok(document) => document,
        Err(diagnostics) => {
            assert!(diagnostics.has_errors());
            assert!(!diagnostics.render(false).is_empty());
            return None;
        }
    };
    match document.scene(&BuiltIn, overrides) {
        Ok(reading) => Some(reading),
        Err(diagnostics) => {
            assert!(diagnostics.has_errors());
            assert!(!diagnostics.render(false).is_empty());
            None
        }
    }
}

/// Pieces of JSON: texts, numbers, words, punctuation, white space.
fn tokens(text: &str) -> Vec<&str> {
    let (mut all, mut rest) = (Vec::new(), text);
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            c if c.is_alphanumeric() || c == '-' => rest
                .find(|c: char| !(c.is_alphanumeric() || "+-.".contains(c)))
                .unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        all.push(&rest[..length]);
        rest = &rest[length..];
    }
    all
}

/// The number of tokens changed is small, so that most of the scene stays sound.
fn mutate(random: &mut Random, seed: &[&str]) -> String {
    let mut tokens: Vec<&str> = seed.to_vec();
    for _ in 0..1 + random.below(3) {
        let (at, other) = (random.below(tokens.len()), random.below(tokens.len()));
        match random.below(5) {
            0 => drop(tokens.remove(at)),
            1 => tokens.insert(at, tokens[other]),
            2 => tokens.swap(at, other),
            3 => tokens[at] = random.one(NASTY),
            _ => tokens[at] = tokens[other],
        }
    }
    tokens.concat()
}

/// A value in place of another value keeps the scene JSON, and reaches deeper.
fn replace_value(random: &mut Random, seed: &[&str]) -> String {
    let mut tokens: Vec<&str> = seed.to_vec();
    let values: Vec<usize> = (2..tokens.len())
        .filter(|&at| tokens[at].starts_with(|c: char| c == '"' || c == '-' || c.is_ascii_digit()))
        .collect();
    for _ in 0..1 + random.below(2) {
        let at = random.one(&values);
        let other = random.one(&values);
        tokens[at] = if random.below(2) == 0 {
            tokens[other]
        } else {
            random.one(NASTY)
        };
    }
    tokens.concat()
}

fn flip_bytes(random: &mut Random, seed: &str) -> Vec<u8> {
    let mut bytes = seed.as_bytes().to_vec();
    for _ in 0..1 + random.below(8) {
        let at = random.below(bytes.len());
        bytes[at] = (random.next() >> 32) as u8;
    }
    bytes.truncate(bytes.len() - random.below(bytes.len()) * random.below(2));
    bytes
}

fn noise(random: &mut Random) -> Vec<u8> {
    let alphabet = b"{}[]\",:0123456789.eE+-truefalsnd \n\\u/*'\xff\x00\xc3\xa9";
    let length = random.below(200);
    let plain = random.below(2) == 0;
    let mut byte = || match plain {
        true => random.one(alphabet),
        false => (random.next() >> 32) as u8,
    };
    (0..length).map(|_| byte()).collect()
}

fn nesting(random: &mut Random) -> Vec<u8> {
    let open = random.one(&["[", "{\"a\":", "{\"objects\":", "[1,", "\"[", "{\"a\":["]);
    let mut text = open.repeat(random.below(3000));
    text.push_str(random.one(NASTY));
    text.into_bytes()
}

/// Inputs of the test below; `DAM_BAD_INPUTS=100000` asks for more of them.
fn inputs() -> usize {
    let asked = std::env::var("DAM_BAD_INPUTS").ok();
    asked.map_or(15_000, |asked| asked.parse().expect("a number of inputs"))
}

#[test]
fn bad_inputs_end_well() {
    let seeds: Vec<Vec<&str>> = SEEDS.iter().map(|seed| tokens(seed)).collect();
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let none = Overrides::none();
    let (mut read_well, mut slowest) = (0, Duration::ZERO);
    let inputs = inputs();
    for round in 0..inputs {
        // Mostly the small seed: ten times as many mutations in the same time.
        let which = usize::from(round % 16 != 0);
        let bytes = match round % 5 {
            0 => flip_bytes(&mut random, SEEDS[which]),
            1 => noise(&mut random),
            2 if round % 100 == 2 => nesting(&mut random),
            2 | 3 => replace_value(&mut random, &seeds[which]).into_bytes(),
            _ => mutate(&mut random, &seeds[which]).into_bytes(),
        };
        let start = Instant::now();
        read_well += usize::from(read(&bytes, &none).is_some());
        slowest = slowest.max(start.elapsed());
    }
    // Some mutations are harmless; if none were, the test would test little.
    assert!(
        (inputs / 50..inputs / 10 * 9).contains(&read_well),
        "{read_well} of {inputs} were read"
    );
    assert!(slowest < HONEST, "{slowest:?}");
}

#[test]
fn bad_overrides_end_well() {
    let words = [
        "rocker",
        "shaft",
        "run",
        "objects",
        "expect",
        "name",
        "dam",
        "masses",
        "position",
        "sine",
        "pair",
        "loads",
        "closing",
        "from",
        "tolerance",
        "start",
        ".",
        "..",
        "[0]",
        "[",
        "]",
        "=",
        "[99999999999999999999]",
        " ",
        "é",
        "\"",
        "{\"closure\":\"form\",\"gap\":1}",
    ];
    let mut random = Random(7);
    for _ in 0..20_000 {
        let argument: String = (0..random.below(8))
            .map(|_| match random.below(4) {
                0 => random.one(NASTY),
                1 => ".",
                _ => random.one(&words),
            })
            .collect();
        read(SEEDS[1].as_bytes(), &Overrides::new([argument]));
    }
}

/// No honest reading needs so long, on a busy machine either.
const HONEST: Duration = Duration::from_secs(20);

/// Reads a text and refuses it in good time.
fn refused(what: &str, text: &str) {
    let start = Instant::now();
    assert!(
        read(text.as_bytes(), &Overrides::none()).is_none(),
        "{what}"
    );
    let time = start.elapsed();
    assert!(time < HONEST, "{what}: {time:?}");
}

#[test]
fn large_files_are_refused_in_good_time() {
    refused("white space", &" ".repeat(5 * 1024 * 1024));
    refused(
        "long list",
        &format!("{{\"dam\": [{}1]}}", "1,".repeat(1_000_000)),
    );
    let long_text = "x".repeat(3_000_000);
    refused("long text", &format!("{{\"name\": \"{long_text}\"}}"));
    refused(
        "same names",
        &format!("{{{}\"dam\": 1}}", "\"x\": 1,".repeat(100_000)),
    );
    let names: String = (0..100_000).map(|n| format!("\"name{n}\": 1,")).collect();
    refused("many names", &format!("{{{names}\"dam\": 1}}"));
    let object = |n| {
        format!(
            "\"o{n}\": {{\"kind\": \"shaft\", \"input\": \"o{}\"}},",
            (n + 1) % 2_000
        )
    };
    let objects: String = (0..2_000).map(object).collect();
    refused(
        "a long cycle",
        &format!("{{\"dam\": 1, \"objects\": {{{objects} \"x\": 1}}}}"),
    );
}
