#!/usr/bin/env bash
# Whether a log and the bags that scripts/convert-log.py makes of it have the same answer, byte for byte.
#
#     scripts/compare-bags.sh robot.log.gz FOLDER [hssh]
#
# Needs the Python package rosbags. What is compared is FOLDER/clock.log.gz, the log with the times that the bags have. The answer names its input, so that each is given by a link of the same name.
set -euo pipefail
log="$(realpath "$1")" folder="$(realpath -m "$2")" hssh="$(realpath "${3:-target/release/hssh}")"
script="$(realpath "$(dirname "$0")")/convert-log.py"
[[ -f "$folder/clock.log.gz" ]] || python3 "$script" "$log" "$folder"
work="$(mktemp -d)"
trap 'rm -r "$work"' EXIT
cd "$work"
answer() {
    rm -f input
    ln -s "$1" input
    "$hssh" map input --json --threads 1 2>/dev/null | grep -v '"seconds"' || true
}
answer "$folder/clock.log.gz" >log.json
[[ -s log.json ]] || { echo "the log has no answer"; exit 1; }
differ=0
for bag in "$folder"/*; do
    [[ "$bag" == "$folder/clock.log.gz" ]] && continue
    answer "$bag" >bag.json
    if cmp -s log.json bag.json; then echo "same: $bag"; else echo "differs: $bag"; diff log.json bag.json | head -8 || true; differ=1; fi
done
exit $differ
