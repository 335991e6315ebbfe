//! What surrounds the mathematics: nothing stalls, nothing is lost.

#[path = "outside/ends.rs"]
mod ends;
#[path = "outside/folder.rs"]
mod folder;
#[path = "outside/long_chains.rs"]
mod long_chains;
#[path = "outside/terminal.rs"]
mod terminal;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The program with a scene of `scenarios/`, or of anywhere.
fn dam(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dam"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args);
    command
}

fn output(args: &[&str]) -> Output {
    dam(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Writes a scene into a folder.
fn scene(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("scene.json");
    std::fs::write(&path, text).unwrap();
    path
}

/// One command of each kind, quick.
const COMMANDS: [&[&str]; 20] = [
    &["run", "scenarios/limits/short_rod.json"],
    &["run", "scenarios/limits/short_rod.json", "--json"],
    &["check", "scenarios/limits/short_rod.json"],
    &["schema"],
    &["show", "scenarios/rocker/two_masses.json"],
    &[
        "compare",
        "scenarios/limits/short_rod.json",
        "--over",
        "slide.inertia=1,2",
    ],
    &["law", "list"],
    &["law", "show", "sine"],
    &[
        "law",
        "compare",
        "scenarios/cams/flat_tappet.json",
        "--at",
        "valve.position.cam.law",
        "--law",
        "3-4-5",
        "--law",
        "cycloidal",
    ],
    &["cam", "scenarios/cams/flat_tappet.json"],
    &[
        "map",
        "scenarios/rocker/one_mass.json",
        "--x",
        "rocker.inertia=0.05:0.1:2",
    ],
    &[
        "methods",
        "scenarios/rocker/one_mass.json",
        "--methods",
        "exact",
        "--repeats",
        "1",
    ],
    &["kinematics", "scenarios/kinetostatics/slider_crank.json"],
    &["forces", "scenarios/kinetostatics/slider_crank.json"],
    &[
        "steady",
        "--inertia=1",
        "--work=cos(phi)",
        "--mean-speed",
        "10",
    ],
    &["new", "lever"],
    &["completions", "bash"],
    &["manual"],
    &["manual", "law", "show"],
    &["--help"],
];
