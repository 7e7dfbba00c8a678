#!/bin/sh
# A study of Perfora as a Slurm job array: sbatch --array=0-63 slurm-array.sh STUDY.toml DIR
# DIR lies on a disk that all nodes see. Task 0 asks and works, the others work. Submitted again, it goes on.
#SBATCH --job-name=perfora
#SBATCH --cpus-per-task=1
#SBATCH --time=24:00:00
#SBATCH --signal=B:TERM@120
set -u
study=$1
folder=$2
perfora=${PERFORA:-perfora}
asks=

# Before the time limit: what is under way writes its checkpoint, and the journal is closed.
trap 'kill -TERM $works $asks 2>/dev/null; wait; exit 75' TERM

if [ "${SLURM_ARRAY_TASK_ID:-0}" = "${SLURM_ARRAY_TASK_MIN:-0}" ]; then
  resume=
  [ -e "$folder/journal.jsonl" ] && resume=--resume
  "$perfora" optimize "$study" -o "$folder" --shared $resume &
  asks=$!
fi
"$perfora" work "$folder" --threads "${SLURM_CPUS_PER_TASK:-1}" &
works=$!
wait $works
status=$?
if [ -n "$asks" ]; then
  wait $asks
  status=$?
fi
exit $status
