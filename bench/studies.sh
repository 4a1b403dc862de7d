#!/bin/sh
# Measures the kept studies again and draws the chart of the front page; some five minutes, on a machine that does nothing else.
#   bench/studies.sh [NOOK]     default: build/bin/nook; the scenes must be generated
set -eu
cd "$(dirname "$0")/.."
nook=${1:-build/bin/nook}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kept=
for study in cbox_ao_cosine:70 cbox_ro:60 spaceship_ao_cosine:60 room_ao:100; do
  name=${study%:*}
  "$nook" study "scenes/$name.toml" -o "$work/$name" --budget "${study#*:}"
  mkdir -p "bench/studies/$name"
  cp "$work/$name/study.csv" "bench/studies/$name/"
  # Less the single runs, which are three quarters of the file.
  /usr/bin/python3 -c 'import json, sys; study = json.load(sys.stdin); del study["runs"]; json.dump(study, sys.stdout)' \
    <"$work/$name/study.json" >"bench/studies/$name/study.json"
  kept="$kept bench/studies/$name/study.json"
done
# shellcheck disable=SC2086
/usr/bin/python3 bench/charts/study_chart.py docs/images/what_accuracy_costs.png $kept
