//! A slider-crank without masses, for tests of the loads on its slide.

use dam::lower::lower;
use dam::model::Model;
use dam::scene::{BuiltIn, Document, Overrides};

/// A crank of 60 mm and a rod of 300 mm behind a drive of this motion, with more objects, more
/// properties of the linkage, and these outputs.
pub(super) fn press(motion: &str, more: &str, properties: &str, outputs: &str) -> Model {
    let text = format!(
        r#"{{ "dam": 1, "name": "press", "objects": {{
            "drive": {{ "kind": "drive", "motion": {motion} }},
            {more}
            "press": {{ "kind": "linkage", "input": "drive", "driver": "R01", {properties}
                "ground": {{ "O": [0, 0] }},
                "links": {{ "crank": {{ "points": {{ "A": [0.06, 0] }} }},
                    "rod": {{ "points": {{ "C": [0.3, 0] }} }}, "slide": {{}} }},
                "pairs": {{
                    "R01": {{ "revolute": ["ground.O", "crank.origin"] }},
                    "R12": {{ "revolute": ["crank.A", "rod.origin"] }},
                    "R23": {{ "revolute": ["rod.C", "slide.origin"] }},
                    "P03": {{ "sliding": {{ "guide": "ground.O", "block": "slide.origin" }} }} }},
                "assembly": {{ "slide": {{ "near": [0.36, 0] }} }},
                "outputs": {{ {outputs} }} }} }},
            "run": {{ "duration": 0.7 }} }}"#
    );
    let document = Document::parse("press", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none());
    lower(&reading.unwrap_or_else(|faults| panic!("{faults:#?}")).scene).unwrap()
}
