#!/bin/sh
# Runs every fuzz target for so many seconds, one after the other, and prints what came of each: how many inputs, how much of the program they
# reached, and how many findings there were.
#
#     scripts/fuzz.sh SECONDS [TARGET ...]
#
# Needs cargo-fuzz and a nightly compiler. What is found interesting is kept in fuzz/corpus, findings in fuzz/artifacts.
set -eu

seconds=${1:?how many seconds for each target?}
shift
cd "$(dirname "$0")/.."
cargo +nightly fuzz build -s none
[ $# -gt 0 ] || set -- $(cargo +nightly fuzz list)
printf '%-14s %12s %10s %9s\n' target inputs reached findings
for target; do
    corpus=fuzz/corpus/$target
    artifacts=fuzz/artifacts/$target
    mkdir -p "$corpus" "$artifacts"
    case $target in
    pose_graph) seeds="fixtures/graphs fixtures/graphs/malformed" ;;
    exploration | mapping) seeds="crates/hssh-causal/tests/data fixtures/malformed" ;;
    *) seeds="" ;;
    esac
    told=$(mktemp)
    # A finding ends the run of its target, and is told in the last column.
    cargo +nightly fuzz run -s none "$target" "$corpus" $seeds -- \
        -rss_limit_mb=2048 -timeout=120 -max_total_time="$seconds" -print_final_stats=1 >"$told" 2>&1 || true
    inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$told")
    reached=$(sed -n 's/.*cov: \([0-9]*\).*/\1/p' "$told" | tail -n 1)
    printf '%-14s %12s %10s %9s\n' "$target" "${inputs:-?}" "${reached:-?}" "$(ls "$artifacts" | wc -l)"
    rm -f "$told"
done
