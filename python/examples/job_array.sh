#!/bin/bash
# A map on a cluster with SLURM: each task of a job array computes its share of the cells.
#
#   sbatch --array=0-9 job_array.sh 400 SCENE --x "…=0.05:1:20" --y "…=1e6:1e8:20:log"
#   sbatch --dependency=afterok:JOB job_array.sh merge SCENE --x … --y … --out map
#
# 400 is the number of cells. The arguments of both are the same, so that both mean the same map.
# The parts lie in the folder PARTS, which all nodes see. A task that failed is run again by its number.
#SBATCH --job-name=dam-map
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
set -euo pipefail

parts="${PARTS:-parts}"
cells="$1"
shift
if [ "$cells" = merge ]; then
    exec dam map "$@" --merge "$parts"/part-*
fi
task="$SLURM_ARRAY_TASK_ID"
tasks="$SLURM_ARRAY_TASK_COUNT"
from=$((cells * task / tasks))
to=$((cells * (task + 1) / tasks))
mkdir -p "$parts"
# Whole or not at all: a part of a task that was killed is not merged.
dam map "$@" --cells "$from:$to" > "$parts/.part-$task.$$"
mv "$parts/.part-$task.$$" "$parts/part-$task"
