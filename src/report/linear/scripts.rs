//! Scripts that load linear equations into other programs.

/// For Python with python-control: `system` is the state space of `linear.json` beside it.
pub const PYTHON: &str = r#""""Loads linear.json, which dam wrote, as `system`, a state space of python-control.

The law of an object is three inputs: the law, its speed and its acceleration. `by_law` gives the transfer function
that multiplies the law; its names are those of the file.
"""

import json
from pathlib import Path

import control
import numpy

data = json.loads((Path(__file__).parent / "linear.json").read_text(encoding="utf-8"))
matrices = [numpy.array(data[name], dtype=float) for name in "ABCD"]
states, inputs, outputs = ([signal["name"] for signal in data[name]] for name in ("states", "inputs", "outputs"))
# Names in python-control have no dots.
plain = [[name.replace(".", "_") for name in names] for names in (states, inputs, outputs)]
system = control.ss(*matrices, states=plain[0], inputs=plain[1], outputs=plain[2], name="linear")


def by_law(output: str, law: str, frequency: float) -> complex:
    """Output over the law at a frequency (Hz)."""
    s = 2j * numpy.pi * frequency
    answer = system(s)
    row, column = outputs.index(output), inputs.index(law)
    return complex(sum(answer[row, column + order] * s**order for order in range(3)))


if __name__ == "__main__":
    print(system)
"#;

/// For Matlab with its Control System Toolbox, or GNU Octave with its package `control`.
pub const MATLAB: &str = r#"% Loads linear.json, which dam wrote, as the state space `system`.
% The law of an object is three inputs: the law, its speed and its acceleration.
data = jsondecode(fileread(fullfile(fileparts(mfilename('fullpath')), 'linear.json')));
columns = numel(data.inputs);
rows = numel(data.outputs);
states = numel(data.states);
system = ss(reshape(data.A, states, states), reshape(data.B, states, columns), ...
            reshape(data.C, rows, states), reshape(data.D, rows, columns), ...
            'StateName', {data.states.name}, 'InputName', {data.inputs.name}, ...
            'OutputName', {data.outputs.name});
"#;
