# `vorpipe view` in a real window, driven by scripts: view.sh VORPIPE. Each picture that it shows is the one that
# the command line draws which it prints for it.
source "$(dirname "$0")/../cli/harness.sh" "$1"

mkdir bin && ln -s "$vorpipe" bin/vorpipe
export PATH=$PWD/bin:$PATH

# What a person may do. The view lies inside the domain, beyond which a window is dark and a picture empty.
cat >play.txt <<'END'
# The panel would cover this small window.
key tab
wait
move 160 120
scroll 3
wait
key e
key s
screenshot early.png
wait
screenshot 1.png
key c control
wait
# Adds one, drags another, removes a third.
move 60 50
press left
release left
wait
move 60 50
press left
move 75 62
move 90 80
release left
wait
move 230 180
press right
release right
wait
screenshot 2.png
key c control
wait
# Weights, and other colors.
move 160 120
scroll 2 control
wait
key 4
key m
wait
screenshot 3.png
key c control
wait
key n
wait
screenshot 4.png
key c control
wait
key z control
wait
screenshot 5.png
key c control
wait
key y control
resize 240 300
wait
screenshot 6.png
key c control
wait
minimize
restore
wait
screenshot 7.png
key c control
wait
key tab
wait
screenshot panel.png panel
key tab
wait
screenshot 8.png panel
key c control
wait
close
END

# same I LINE: the I-th picture is what the command line draws.
same() {
  local line=${2/-o picture.png/-o $1.drawn.png}
  if ! bash -c "$line" >log/out 2>log/err; then
    fail "the command line fails: $line"
  elif ! vorpipe diff "$1.png" "$1.drawn.png" >log/out 2>log/err; then
    fail "picture $1 is not what is drawn by: $line"
  fi
}

# plays WINDOW BACKEND OPTION...
plays() {
  local window=$1 backend=$2
  shift 2
  name="a window by $window, drawn by $backend"
  cases=$((cases + 1))
  rm -f ./*.png ./*.csv
  run 0 view --sites random:300 --seed 5 --window "$window" --backend "$backend" --size 320x240 --script play.txt "$@"
  [ -s log/err ] && fail "something on standard error"
  cp log/out commands
  local i=0 line
  while IFS= read -r line; do
    i=$((i + 1))
    same $i "$line"
  done <commands
  [ $i -eq 8 ] || fail "there are $i command lines"
  cmp -s 6.png 7.png || fail "another picture after it was minimized"
  cmp -s 7.png 8.png || fail "the panel does not go away"
  cmp -s 3.png 5.png || fail "undo does not bring back what was before a step"
  cmp -s 3.png 4.png && fail "a step of relaxation moves nothing"
  cmp -s panel.png 7.png && fail "there is no panel"
}
plays vulkan cpu
plays vulkan vulkan-compute
plays opengl opengl

# A fluid: steps, strokes, a pause. The view lies inside the box, in which there is water and air.
cat >stir.txt <<'END'
key tab
wait
move 100 150
scroll 3
wait
key n
wait
key n
wait
screenshot 1.png
key c control
wait
key e
move 60 160
press left
move 90 170
move 120 160
release left
wait
key n
wait
screenshot 2.png
key c control
wait
key 6
wait
screenshot 3.png
key c control
wait
# A fluid is not edited.
press right
release right
key z control
wait
screenshot 4.png
key space
wait
wait
key space
wait
screenshot 5.png
wait 0.2
screenshot 6.png
key r
wait
key n
wait
key n
wait
key e
key 1
wait
screenshot 7.png
key c control
wait
close
END

# flows WINDOW BACKEND: plays it twice, and compares pictures with those of films that go on from there.
flows() {
  local window=$1 backend=$2 i line
  name="a fluid in a window by $window, drawn by $backend"
  cases=$((cases + 1))
  rm -rf ./*.png ./*.npz film-* first
  local fluid="--case dam-break --particles 128 --time 0.5 --backend $backend"
  for turn in 1 2; do
    run 0 view $fluid --window "$window" --size 320x240 --script stir.txt
    [ -s log/err ] && fail "something on standard error"
    if [ $turn = 1 ]; then mkdir first && mv ./*.png ./*.npz first && cp log/out commands; fi
  done
  for i in 1 2 3 4 7; do cmp -s $i.png first/$i.png || fail "picture $i of the same script differs"; done
  i=0
  while IFS= read -r line; do
    i=$((i + 1))
    line=${line/--steps 100/--steps 0} && line=${line/--frames frames/--frames film-$i}
    bash -c "$line" >log/out 2>log/err || fail "the command line fails: $line"
    vorpipe diff "$([ $i = 4 ] && echo 7 || echo $i).png" film-$i/frame-00001.png >log/out 2>log/err ||
      fail "the film does not begin with the picture: $line"
  done <commands
  [ $i -eq 4 ] || fail "there are $i command lines"
  run 0 fluid $fluid --steps 2 --checkpoint two.npz
  cmp -s two.npz vorpipe-fluid.npz || fail "two steps are not those of vorpipe fluid"
  cmp -s 1.png 7.png || fail "it does not begin again"
  cmp -s 3.png 4.png || fail "an edit changes the fluid"
  cmp -s 4.png 5.png && fail "it does not flow"
  cmp -s 5.png 6.png || fail "it does not pause"
  cmp -s vorpipe-fluid.npz vorpipe-fluid-2.npz && fail "strokes and a step change nothing"
}
flows vulkan cpu
flows opengl opengl

name="a checkpoint that is dropped"
cases=$((cases + 1))
printf 'key tab\ndrop two.npz\nwait\nmove 100 150\nscroll 3\nwait\nscreenshot dropped.png\nclose\n' >drop.txt
run 0 view --window opengl --backend opengl --size 320x240 --script drop.txt
cmp -s dropped.png 1.png || fail "another picture than that of the fluid"

name="some pictures of a fluid that flows"
cases=$((cases + 1))
run 0 view --case shear --particles 64 --window opengl --backend cpu --size 64x48 --frames 2 --screenshot flown.png
[ -s flown.png ] || fail "there is no screenshot"

name="a film of numbered pictures"
cases=$((cases + 1))
printf 'wait\nkey e\nwait 0.1\nclose\n' >film.txt
run 0 view --sites square:9 --window opengl --backend cpu --size 64x48 --script film.txt --record film
[ "$(ls film | xargs)" = "$(seq -f 'frame-%05g.png' 5 | xargs)" ] || fail "the folder has $(ls film | xargs)"

name="some pictures of sites that relax"
cases=$((cases + 1))
run 0 view --sites random:50 --relax --window opengl --backend cpu --size 64x48 --frames 3 --screenshot relaxed.png
[ -s relaxed.png ] || fail "there is no screenshot"

# The panel ends at 294 pixels; of nine squares the pointer is in the middle one, whose label is on its right.
name="the cell under the pointer"
cases=$((cases + 1))
printf 'move 100 20\nwait 0.5\nscreenshot away.png panel\nmove 560 250\nwait 0.5\nmove 561 250\nwait\nscreenshot over.png panel\nclose\n' >over.txt
run 0 view --sites square:9 --window opengl --backend cpu --size 900x500 --script over.txt
"${VORPIPE_TEST_PYTHON:-python3}" - <<'END' 2>log/err || fail "there is no line around it"
from PIL import Image, ImageChops
away, over = (Image.open(name).convert("RGB") for name in ("away.png", "over.png"))
white = [(x, y) for y in range(500) for x in range(300, 900)
         if over.getpixel((x, y)) > (220, 220, 220) and min(over.getpixel((x, y))) > 220 and min(away.getpixel((x, y))) < 220]
left, top, right, bottom = (f(p[k] for p in white) for f in (min, max) for k in (0, 1))
assert 140 < right - left < 170 and 140 < bottom - top < 170, (left, top, right, bottom)
assert left < 561 < right and top < 250 < bottom
sides = sum(x - left < 3 for x, _ in white), sum(y - top < 3 for _, y in white)
assert min(sides) > 130, sides
END

# As a person begins: what the screen has is what a window of its own shows.
name="a window without a script"
cases=$((cases + 1))
shown() {
  "${VORPIPE_TEST_PYTHON:-python3}" - "$VORPIPE_TEST_SCREEN" "$@" <<'END' 2>log/err
import struct, sys
with open(sys.argv[1], "rb") as file:
    data = file.read()
head = struct.unpack(">25I", data[:100])
begin, width, line = head[0] + 12 * head[19], head[4], head[12]
left, top, right, bottom = (int(n) for n in sys.argv[2:6])
rows = [data[begin + y * line + 4 * left : begin + y * line + 4 * right] for y in range(top, bottom)]
print(len({row[k : k + 3] for row in rows for k in range(0, len(row), 4)}))
END
}
"$vorpipe" view --sites square:4 --window opengl --backend cpu --size 900x500 >log/out 2>log/seen &
viewer=$!
colors=0
for _ in $(seq 100); do
  colors=$(shown 420 475 780 490) && [ "$colors" -gt 6 ] && break
  sleep 0.1
done
[ "$colors" -gt 6 ] || fail "there is no line of help: $colors colors"
# Each of four squares has its color; with their sites there are white and black as well.
for _ in $(seq 100); do
  colors=$(shown 365 15 835 400) && [ "$colors" -ge 6 ] && break
  sleep 0.1
done
[ "$colors" -ge 6 ] || fail "there are no sites: $colors colors"
for _ in $(seq 150); do
  colors=$(shown 420 475 780 490) && [ "$colors" -le 6 ] && break
  sleep 0.1
done
[ "$colors" -le 6 ] || fail "the line of help stays: $colors colors"
kill $viewer
wait $viewer 2>/dev/null

# Before there is a window.
echo jump >wrong.txt
fails 2 "a script that is wrong" 'wrong.txt:1:1: "jump" is no event' view --script wrong.txt
fails 2 "no such case" '--case: "river" is not' view --case river
fails 2 "a fluid that cannot begin" '--scheme: projection is for domains that are full' view --backend cpu \
  --case dam-break --particles 32 --scheme projection
fails 2 "sites beside a fluid" "--sites: is for sites that are not a fluid's" view --case shear --sites random:9
fails 2 "names in a window" '--labels: "@name" is for render, relax and transport; here labels are indices' view --sites random:9 --labels @name
fails 2 "an attribute in a window" '--color: "@rain" is for render' view --sites random:9 --color @rain
fails 2 "a photograph in a window" '--color: "a.jpg" is for render' view --sites random:9 --color a.jpg
fails 2 "a legend beside a window" '--legend: "beside" is for render' view --sites random:9 --color area --legend beside
fails 2 "a film that is none" '--record: "a.gif" is the name of a file that is no film' view --sites random:9 --record a.gif
fails 2 "an option of fluids" '--run: is for fluids; name one with --case or --resume' view --run
DISPLAY='' fails 3 "no display" display view --sites random:9

# A server of its own, which ends while a window of it is recorded.
for window in opengl vulkan; do
  name="a display that goes away, $window"
  cases=$((cases + 1))
  mkfifo number-$window
  Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>number-$window >/dev/null 2>&1 &
  server=$!
  read -r number <number-$window
  DISPLAY=:$number "$vorpipe" view --sites random:100 --relax --window $window --backend cpu --size 64x48 \
    --record recorded-$window >log/out 2>log/err &
  viewer=$!
  until [ -e recorded-$window/frame-00002.png ] || ! kill -0 $viewer 2>/dev/null; do sleep 0.05; done
  kill $server
  wait $viewer
  code=$?
  wait $server
  [ "$code" -eq 3 ] || fail "exit code $code, not 3"
  one_line
done
finish
