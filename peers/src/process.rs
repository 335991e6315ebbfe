//! A case as a scene, given to the program: what a user waits for.

use crate::chain::Chain;
use crate::solution::Timing;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The scene of a chain; dampings link by link, as the cases have them.
fn scene(chain: &Chain) -> serde_json::Value {
    serde_json::json!({
        "dam": 1,
        "name": "a case of the comparison",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
            "rocker": {
                "kind": "rocker", "input": "shaft",
                "position": { "sine": { "amplitude": "90 deg" } },
                "inertia": chain.inertia.iter().sum::<f64>(),
                "stiffness": chain.stiffness[0] / chain.masses as f64,
                "dampings": chain.damping,
                "masses": chain.masses,
                "pair": { "closure": "force" },
                "loads": { "closing": { "mass": "last", "constant": -chain.load } }
            }
        },
        "run": { "duration": chain.duration, "start": "on_law" }
    })
}

/// The program `dam` beside this one, as `peers/run` builds it.
fn program() -> Result<PathBuf, String> {
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let path = own.with_file_name("dam");
    match path.exists() {
        true => Ok(path),
        false => Err(format!("{} is not built", path.display())),
    }
}

fn answer(program: &Path, scene: &Path) -> Result<serde_json::Value, String> {
    let output = Command::new(program)
        .arg("run")
        .arg(scene)
        .args(["--json", "--quiet"])
        .output()
        .map_err(|error| error.to_string())?;
    serde_json::from_slice(&output.stdout)
        .map_err(|_| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Wall time of `dam run SCENE --quiet` from its start to its end, the scene read from a
/// file and all figures and the energy audit printed; checked by the count of switches.
///
/// # Errors
/// The program is missing, or answers otherwise than the reference.
pub(crate) fn timing(chain: &Chain, switches: usize) -> Result<Timing, String> {
    let program = program()?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let path = folder.path().join("case.json");
    std::fs::write(&path, scene(chain).to_string()).map_err(|error| error.to_string())?;
    let found = answer(&program, &path)?;
    if found["run"]["switches"] != switches || found["run"]["method"] != "exact" {
        return Err(format!("dam run: {}", found["run"]));
    }
    let budget = Duration::from_millis(600);
    Ok(Timing::measure(budget, || {
        let mut command = Command::new(&program);
        command.arg("run").arg(&path).arg("--quiet").output()
    }))
}
