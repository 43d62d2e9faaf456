#!/usr/bin/env bash
# docs/results/regenerate.sh, with a run_experiments that only pretends.
set -euo pipefail
root="$(cd "$1/.." && pwd)"
# shellcheck source=expect.sh
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/docs/results" "$scratch/build/bin"
cp "$root/docs/results/regenerate.sh" "$root/docs/results/README.md" \
    "$scratch/docs/results"
regenerate="$scratch/docs/results/regenerate.sh"

expect "without a build" 1 "build first" bash "$regenerate"
cat > "$scratch/build/bin/run_experiments" << 'PROGRAM'
#!/usr/bin/env bash
if [[ "$1" == --list ]]; then
  printf 'Experiments:\n  good: works\n  bad: fails\n  worse: writes nothing\n'
  printf 'Kinds of jobs:\n  cost: counts\n'
  exit
fi
mkdir -p "$3/rows"
if [[ -f "$3/rows/old" ]]; then echo "rows were kept"; fi
touch "$3/rows/old"
[[ "$1" != worse ]] || exit 3
printf '# The %s one\n\ntext %s\n' "$1" "${*:4}" > "$3/report.md"
echo "a,b" > "$3/$1.csv"
if [[ "$1" == bad ]]; then printf '\nNot done:\n\n- job: crashed\n' >> "$3/report.md"; fi
PROGRAM
chmod +x "$scratch/build/bin/run_experiments"

expect "an experiment that there is not" 1 "there are: good bad worse" \
    bash "$regenerate" cost
expect "one experiment" 0 "Wrote .*/docs/results/good" bash "$regenerate" good
expect "flags reach the program" 0 "Wrote" bash "$regenerate" good -- --jobs 1
expect "the page" 0 "text --jobs 1" cat "$scratch/docs/results/good/README.md"
expect "the table" 0 "a,b" cat "$scratch/docs/results/good/good.csv"
touch "$scratch/docs/results/good/stale.svg"
expect "rows of an earlier run are dropped" 1 "" \
    bash -c "bash '$regenerate' good | grep 'rows were kept'"
expect "rows are kept where asked for" 0 "rows were kept" \
    bash "$regenerate" --resume good
expect "stale pictures go" 1 "" test -e "$scratch/docs/results/good/stale.svg"
expect "failures are told" 1 "not every job was done in: bad worse" bash "$regenerate"
expect "the index names the pages" 0 "\[bad\]\(bad/README.md\) \| The bad one" \
    cat "$scratch/docs/results/README.md"
expect "the index keeps its end" 0 "end of pages" tail -1 "$scratch/docs/results/README.md"
expect "no page without a report" 1 "" test -e "$scratch/docs/results/worse"
expect "an unknown option" 1 "unknown option '--x'" bash "$regenerate" --x
finish
