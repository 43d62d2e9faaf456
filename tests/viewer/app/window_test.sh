#!/usr/bin/env bash
# Drives dpe_viewer in a window as a person does, by xdotool, and reads what it says it
# shows (--state_file). Starts an X server of its own.
#
#   window_test.sh BIN_FOLDER SOURCE_FOLDER
#
# Exit code 77 (skipped): something that the test needs is not installed.
set -uo pipefail
bin="$(cd "$1" && pwd)"
source_folder="$(cd "$2" && pwd)"
for tool in Xvfb xdotool; do
  if ! command -v "$tool" > /dev/null; then
    echo "skipped: $tool is not installed"
    exit 77
  fi
done
if [[ "$("$bin/dpe_viewer" --list_devices 2> /dev/null)" != 0* ]]; then
  echo "skipped: there is no Vulkan device"
  exit 77
fi

scratch="$(mktemp -d)"
viewer_pid=""
server_pid=""
clean_up() {
  if [[ -n "$viewer_pid" ]]; then kill "$viewer_pid" 2> /dev/null; fi
  if [[ -n "$server_pid" ]]; then kill "$server_pid" 2> /dev/null; fi
  rm -rf "$scratch"
}
trap clean_up EXIT
state="$scratch/state.jsonl"
failures=0

field() {  # NAME: its value in the last state: a number, true, "text" or [..]
  tail -n 1 "$state" 2> /dev/null |
      sed -nE "s/.*\"$1\":(\[[^]]*\]|\"[^\"]*\"|[^,}]*)[,}].*/\1/p"
}

# wait_for WHAT COMMAND...: until the command succeeds.
wait_for() {
  local what="$1" k
  shift
  for ((k = 0; k < 200; ++k)); do
    if "$@"; then
      echo "ok     $what"
      return
    fi
    sleep 0.1
  done
  echo "FAILED $what: $(tail -n 1 "$state")"
  failures=$((failures + 1))
}

is() { [[ "$(field "$1")" == "$2" ]]; }
is_not() {  # not, and there is a value
  local value
  value="$(field "$1")"
  [[ -n "$value" && "$value" != "$2" ]]
}
above() { awk -v a="$(field "$1")" -v b="$2" 'BEGIN {exit !(a != "" && a > b)}'; }
below() { awk -v a="$(field "$1")" -v b="$2" 'BEGIN {exit !(a != "" && a < b)}'; }
has_line() { [[ -s "$state" ]]; }
has_file() { compgen -G "$1" > /dev/null; }
key() { xdotool key --window "$window" "$1"; }

until_is() {  # NAME VALUE
  local k
  for ((k = 0; k < 100; ++k)); do
    if is "$1" "$2"; then return; fi
    sleep 0.1
  done
}

# What a key or a drag is to change is read before it: the viewer may have done it by the
# time that the shell looks.

# press_widget NAME [RIGHT]: as a mouse does, so many pixels right of its middle. A
# panel sees what is done between one picture and the next, so each step waits for one.
press_widget() {
  local place x y
  place="$(field "at_$1")"
  IFS=, read -r x y <<< "${place//[][]/}"
  x=$((x + ${2:-0}))
  move_to "$x" "$y"
  xdotool mousedown 1; until_is button_down true
  xdotool mouseup 1; until_is button_down false
}

move_to() {  # X Y
  xdotool mousemove --window "$window" "$1" "$2"
  until_is cursor "[$1.0,$2.0]"
}

drag() {  # BUTTON RIGHT DOWN
  xdotool mousedown "$1"; until_is button_down true
  xdotool mousemove_relative -- "$2" "$3"
  xdotool mouseup "$1"; until_is button_down false
}

# set_wm_state NUMBER: what a window manager, which is not there, says of a window:
# 1 normal, 3 iconified.
set_wm_state() {
  python3 - "$window" "$1" << 'END'
import ctypes, sys
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p
display = ctypes.c_void_p(x11.XOpenDisplay(None))
atom = x11.XInternAtom(display, b"WM_STATE", 0)
value = (ctypes.c_long * 2)(int(sys.argv[2]), 0)
x11.XChangeProperty(display, int(sys.argv[1]), atom, atom, 32, 0, value, 2)
x11.XCloseDisplay(display)
END
}
iconify() { set_wm_state 3 && xdotool windowunmap "$window"; }
deiconify() { xdotool windowmap "$window" && set_wm_state 1; }
num_states() { wc -l < "$state"; }
has_more_states() { [[ "$(num_states)" -gt "$1" ]]; }

# The server takes the first free number and says which.
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3> "$scratch/display" \
    2> /dev/null &
server_pid=$!
for ((k = 0; k < 300; ++k)); do
  if [[ -s "$scratch/display" ]]; then break; fi
  sleep 0.1
done
DISPLAY=":$(cat "$scratch/display")"
export DISPLAY
cd "$scratch" || exit 1
"$bin/dpe_viewer" "$source_folder/data/side.txt" --paused --validation \
    --state_file="$state" --size=900x700 > "$scratch/out" 2> "$scratch/err" &
viewer_pid=$!
wait_for "a window opens and says what it shows" has_line
if [[ "$failures" != 0 ]]; then
  cat "$scratch/out" "$scratch/err"
  exit 1
fi
window="$(xdotool search --name 'dpe_viewer - side' | tail -n 1)"
xdotool windowfocus "$window" 2> /dev/null
wait_for "it has the size that was asked for" is size "[900,700]"
wait_for "it begins paused at frame 0" is frame 0

key Right; wait_for "Right goes a frame on" is frame 1
key Right; wait_for "and another" is frame 2
key Left; wait_for "Left goes a frame back" is frame 1
key space; wait_for "Space goes on" is paused false
wait_for "the cloth moves by itself" above frame 10
key space; wait_for "Space pauses" is paused true
key Home; wait_for "Home restarts" is frame 0
number=1
for color in plain stiffness mass stretch speed distance; do
  key "$number"
  wait_for "$number colours by $color" is color "\"$color\""
  number=$((number + 1))
done
wait_for "without a target it says why distances are grey" is_not missing '""'
key 7
wait_for "without a report it says so of deviations" is_not missing '""'
key 1
wait_for "and no more of what has no colours" is missing '""'

yaw="$(field yaw)"
press_widget play
wait_for "the button plays" is paused false
wait_for "and the cloth moves" above frame 10
press_widget play
wait_for "the button pauses" is paused true
here="$(field frame)"
press_widget frame -60
wait_for "the time line goes back" below frame "$here"
here="$(field frame)"
press_widget step
wait_for "the button > goes a frame on" above frame "$here"
press_widget color_speed
wait_for "a button chooses colours" is color '"speed"'
press_widget stiffness 50
wait_for "a slider makes the cloth stiffer" above stiffness 1.5
press_widget stiffness -50
wait_for "or softer" below stiffness 0.7
press_widget save_scene
wait_for "a button writes the scene" has_file "$scratch/side_tuned.txt"
press_widget as_in_the_file
wait_for "a button takes all that back" is stiffness 1.0
wait_for "nothing of this turned the camera" is yaw "$yaw"
key Home; wait_for "Home restarts" is frame 0

yaw="$(field yaw)" pitch="$(field pitch)" distance="$(field distance)"
target="$(field target)"
move_to 600 400
drag 1 80 30
wait_for "a left drag to the right orbits" below yaw "$yaw"
wait_for "and down raises the camera" above pitch "$pitch"
wait_for "but does not pan" is target "$target"
orbited="$(field yaw)"
drag 3 40 20
wait_for "a right drag pans" is_not target "$target"
wait_for "but does not orbit" is yaw "$orbited"
panned="$(field target)"
xdotool keydown shift
drag 1 -30 10
xdotool keyup shift
wait_for "so does a drag with Shift" is_not target "$panned"
wait_for "which does not orbit either" is yaw "$orbited"
xdotool click 4; wait_for "the wheel comes closer" below distance "$distance"
closer="$(field distance)"
xdotool click 5; wait_for "and goes back" above distance "$closer"
here="$(field distance)"
key w; wait_for "W comes closer" below distance "$here"
key r; wait_for "R resets the distance" is distance "$distance"
wait_for "and the direction" is yaw "$yaw"
wait_for "and the place" is target "$target"
key s; wait_for "S goes away" above distance "$distance"
here="$(field distance)"
key f; wait_for "F frames the cloth" below distance "$here"
key h; wait_for "H shows the keys" is help true
key h; wait_for "and hides them" is help false
key p; wait_for "P writes a PNG" has_file "$scratch/dpe_viewer_0001.png"
xdotool windowsize "$window" 700 500
wait_for "the picture follows the window's size" is size "[700,500]"
xdotool windowunmap "$window"; sleep 0.5; xdotool windowmap "$window"; sleep 0.5
xdotool windowsize "$window" 640 480
wait_for "it goes on after it was hidden" is size "[640,480]"
if command -v python3 > /dev/null; then
  # Unmapping took the focus away, as no window manager is there to give it back.
  xdotool windowfocus "$window" 2> /dev/null
  key space; wait_for "it plays" is paused false
  iconify; sleep 1  # longer than a picture takes
  before="$(num_states)"
  sleep 1
  if has_more_states "$before"; then
    echo "FAILED it draws nothing while it is minimised"
    failures=$((failures + 1))
  fi
  deiconify
  wait_for "it goes on after it was minimised" has_more_states "$before"
  xdotool windowfocus "$window" 2> /dev/null
  key space; wait_for "it pauses" is paused true
fi
key Escape
wait "$viewer_pid"
code=$?
viewer_pid=""
if [[ "$code" != 0 ]]; then
  echo "FAILED Esc ends it with exit code 0: $code"
  failures=$((failures + 1))
fi
if [[ -s "$scratch/err" ]]; then
  echo "FAILED it has nothing to complain about:"
  cat "$scratch/err"
  failures=$((failures + 1))
fi
echo "$failures failure(s)"
[[ "$failures" == 0 ]]
