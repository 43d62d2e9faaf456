# The few assertions that the script tests share; sourced.
# shellcheck shell=bash
failures=0

# expect NAME STATUS PATTERN COMMAND...: runs the command and compares its exit code, and
# looks for an extended regular expression in what it printed ("" for anything).
expect() {
  local name="$1" status="$2" pattern="$3" output actual=0
  shift 3
  output="$("$@" 2>&1 < /dev/null)" || actual=$?
  if [[ "$actual" != "$status" ]]; then
    echo "FAILED $name: exit code $actual instead of $status"
  elif [[ -n "$pattern" ]] && ! grep -Eq -- "$pattern" <<< "$output"; then
    echo "FAILED $name: no match for '$pattern'"
  else
    echo "ok     $name"
    return
  fi
  echo "         ${output//$'\n'/$'\n         '}"
  failures=$((failures + 1))
}

finish() {
  echo "$failures failure(s)"
  [[ "$failures" == 0 ]]
}
