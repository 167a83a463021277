#!/usr/bin/env bash
# Runs a command on a display of its own, without a screen: under_display.sh COMMAND...
#
# The command finds the display in DISPLAY, and in VORPIPE_TEST_SCREEN a file that the X server keeps what it shows
# in, as `xwd` writes it. A small window manager runs there, without which no window is minimized.
set -u
here=$(cd "$(dirname "$0")" && pwd)
python=${VORPIPE_TEST_PYTHON:-python3}
if ! command -v Xvfb >/dev/null; then exec sh "$here/../skip.sh" "there is no Xvfb"; fi
folder=$(mktemp -d) || exit 1
server='' manager=''
end() {
  [[ -z $manager ]] || kill "$manager" 2>/dev/null
  [[ -z $server ]] || { kill "$server" 2>/dev/null; wait "$server" 2>/dev/null; }
  rm -rf "$folder"
}
trap end EXIT

# The server writes its number when it is ready; it takes one that is free. Without -noreset it would begin anew
# whenever its last window is closed.
mkfifo "$folder/number" "$folder/ready"
Xvfb -displayfd 3 -screen 0 1600x1200x24 -noreset -nolisten tcp -fbdir "$folder" \
  3>"$folder/number" >"$folder/log" 2>&1 &
server=$!
if ! read -r number <"$folder/number"; then
  cat "$folder/log" >&2
  echo "Xvfb does not start" >&2
  exit 1
fi
export VORPIPE_TEST_PYTHON=$python DISPLAY=:$number VORPIPE_TEST_SCREEN=$folder/Xvfb_screen0
unset WAYLAND_DISPLAY XAUTHORITY
"$python" "$here/window_manager.py" >"$folder/ready" &
manager=$!
if ! read -r _ <"$folder/ready"; then
  echo "the window manager does not start" >&2
  exit 1
fi
"$@"
