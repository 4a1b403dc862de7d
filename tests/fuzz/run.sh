#!/bin/bash
# tests/fuzz/run.sh BUILD SECONDS WORK [TARGET...]: each target SECONDS through its libFuzzer harness (preset fuzz), one after the
# other; preset afl's builds are driven by AFL++. WORK keeps the growing corpora, WORK/found what brought a reader down,
# WORK/table.jsonl a line a run. tests/fuzz/corpus and the built-in seeds are where it starts.
set -u
build=$(realpath "$1") seconds=$2 work=$3
shift 3
targets=${*:-scene mesh ply stl compressed materials points part image study delivery command}
mkdir -p "$work/found"
work=$(realpath "$work")
corpus=$(realpath "$(dirname "$0")")/corpus
if [ -d /dev/shm ]; then export TMPDIR=/dev/shm; fi
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=${ASAN_OPTIONS:-}
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
"$build/bin/nook_fuzz" --seeds "$seeds" || exit 1

for target in $targets; do
  harness=$build/bin/nook_fuzz_$target
  mkdir -p "$work/$target" "$corpus/$target"
  cp "$corpus/$target/"* "$seeds/$target/" 2>/dev/null
  if nm "$harness" | grep -q __afl_area_ptr; then
    AFL_NO_UI=1 AFL_SKIP_CPUFREQ=1 AFL_NO_AFFINITY=1 AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES=1 AFL_AUTORESUME=1 \
      afl-fuzz -V "$seconds" -m none -t 20000 -x "$seeds/$target.dict" -i "$seeds/$target" -o "$work/afl-$target" \
      -- "$harness" >"$work/$target.afl.log" 2>&1
    stats=$work/afl-$target/default/fuzzer_stats
    count() { sed -n "s/^$1 *: //p" "$stats"; }
    cp "$work/afl-$target"/default/crashes/id* "$work/afl-$target"/default/hangs/id* "$work/found/" 2>/dev/null
    echo "{\"target\": \"$target\", \"engine\": \"AFL++\", \"seconds\": $(count run_time), \"inputs\": $(count execs_done)," \
      "\"corpus\": $(count corpus_count), \"crashes\": $(count saved_crashes), \"hangs\": $(count saved_hangs)}"
  else
    before=$(find "$work/found" -type f | wc -l)
    start=$(date +%s)
    "$harness" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2560 -max_len=8192 -dict="$seeds/$target.dict" \
      -artifact_prefix="$work/found/$target-" -print_final_stats=1 "$work/$target" "$seeds/$target" >"$work/$target.log" 2>&1
    inputs=$(sed -n 's/^stat::number_of_executed_units: //p' "$work/$target.log")
    echo "{\"target\": \"$target\", \"engine\": \"libFuzzer\", \"seconds\": $(($(date +%s) - start)), \"inputs\": ${inputs:-0}," \
      "\"corpus\": $(find "$work/$target" -type f | wc -l), \"found\": $(($(find "$work/found" -type f | wc -l) - before))}"
  fi | tee -a "$work/table.jsonl"
done
