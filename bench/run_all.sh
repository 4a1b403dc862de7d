#!/bin/sh
# Runs every benchmark of README.md with the settings of its tables, then draws the plots and writes the tables:
#
#   bench/run_all.sh [BUILD_FOLDER] [RESULTS_FOLDER]      (default: build, bench/results)
#
# Minutes on quiet cores: 12 in all; NOOK_BENCH_ONLY="tree overhead" runs some alone. THREADS (default 2) is how many
# threads both sides get; RESOLUTION (default 1024 for AO, 512 for other rays) the pixels a side of `occlusion`; CLOCK=--cpu-time counts CPU seconds, for a machine that is busy otherwise.
set -eu
here=$(dirname "$0")
build=${1:-build}
results=${2:-$here/results}
threads=${THREADS:-2}
clock=${CLOCK:-}
bench=$build/bin/nook_bench
mkdir -p "$results"

wanted() {
  [ -z "${NOOK_BENCH_ONLY:-}" ] || case " $NOOK_BENCH_ONLY " in *" $1 "*) ;; *) return 1 ;; esac
  # A result is replaced, not added to.
  case $1 in micro) rm -f "$results/micro.json" ;; scaling) rm -f "$results/scaling.jsonl" "$results/options.jsonl" ;; *) rm -f "$results/$1.jsonl" ;; esac
}

"$bench" machine > "$results/machine.txt"

if wanted occlusion; then
  rounds=5
  run() { "$bench" occlusion --rounds $rounds --threads "$threads" --output "$results/occlusion.jsonl" $clock "$@"; }
  ao() { run --resolution "${RESOLUTION:-1024}" --rays ao "$@"; }
  other() { run --resolution "${RESOLUTION:-512}" "$@"; }
  for scene in bunny room cornell spaceship; do ao --scene $scene; done
  for scene in bunny room cornell; do ao --scene $scene -D TRAVERSAL_PORTABLE=1; done
  for scene in bunny room; do
    other --scene $scene --rays ro --exponent 30
    other --scene $scene --rays ro --exponent 300
  done
  for scene in bunny room cornell; do other --scene $scene --rays own; done
  rounds=21  # of some milliseconds each
  for scene in bunny room cornell; do other --scene $scene --rays primary; done
fi
if wanted tree; then
  for scene in bunny room; do
    for refined in "" --refined; do
      for n in 1 "$threads"; do "$bench" tree --scene $scene --rounds 7 --threads "$n" $refined --output "$results/tree.jsonl" $clock; done
    done
  done
fi
if wanted end_to_end; then
  run() { "$bench" end-to-end --threads "$threads" --output "$results/end_to_end.jsonl" $clock "$@"; }
  for scene in bunny room; do run --scene $scene --directions 16 --rounds 5; done
  run --scene bunny --directions 16 --rounds 3 --cold
  run --scene bunny --directions 256 --rounds 1
fi
if wanted overhead; then "$bench" overhead --rounds 30 --threads "$threads" --output "$results/overhead.jsonl"; fi
if wanted effects; then "$bench" effects --output "$results/effects.jsonl" $clock; fi
if wanted instances; then "$bench" instances --threads "$threads" --output "$results/instances.jsonl"; fi
if wanted scaling; then
  "$bench" scaling --rounds 2 --threads "$threads" --output "$results/scaling.jsonl" --options-output "$results/options.jsonl" $clock
fi
if wanted micro && [ -x "$build/bin/nook_bench_micro" ]; then
  "$build/bin/nook_bench_micro" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
    --benchmark_min_time=0.1 --benchmark_out="$results/micro.json" --benchmark_out_format=json
fi
if [ "$results" = "$here/results" ]; then
  "${PYTHON:-/usr/bin/python3}" "$here/charts/plots.py"
else
  "${PYTHON:-/usr/bin/python3}" "$here/charts/plots.py" "$results"
fi
