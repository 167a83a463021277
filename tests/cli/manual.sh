# What the program writes of its own command line, man pages and completions: bash manual.sh VORPIPE
source "$(dirname "$0")/harness.sh" "$1"

subcommands=$("$vorpipe" --help | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z]*\) .*/\1/p')
pages="vorpipe"
for subcommand in $subcommands; do pages+=" vorpipe-$subcommand"; done
mkdir man files

# case_of NAME: what follows is about this.
case_of() {
  name=$1
  cases=$((cases + 1))
  : >log/out
  : >log/err
}

# -- Pages ----------------------------------------------------------------------------------------------
for page in $pages; do
  name="the page $page"
  subcommand=${page#vorpipe}
  succeeds "$name" --help-man ${subcommand#-}
  cp log/out "man/$page.1"
  grep -q '[^ -~]' log/out && fail "it is not ASCII: $(grep -m1 '[^ -~]' log/out)"
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS "EXIT STATUS" EXAMPLES "SEE ALSO"; do
    grep -qxF ".SH $section" log/out || fail "no $section"
  done
done
case_of "the page of the program has all subcommands"
for subcommand in $subcommands; do
  grep -qxF "\\fB$subcommand\\fP" man/vorpipe.1 || fail "not $subcommand"
done
[ "$(echo $pages | wc -w)" -eq 13 ] || fail "there are not twelve subcommands: $subcommands"

# Options stand in groups, in one order everywhere, and each in one.
for subcommand in $subcommands; do
  case_of "groups of $subcommand"
  "$vorpipe" "$subcommand" --help >files/help
  groups=$(grep -oE '^[A-Z][a-z]+:$' files/help | tr -d : | grep -vx 'Positionals\|Examples\?')
  ordered=$(for group in Input Domain Cells Relaxation Masses Fluid Picture Window Measurement Comparison Output Device Run Help; do
    grep -x $group <<<"$groups"
  done)
  [ "$groups" = "$ordered" ] || fail "they are: $(xargs <<<"$groups")"
  [ "$(sed -n 's/^\.SS //p' "man/vorpipe-$subcommand.1")" = "$groups" ] || fail "the page has others"
  [ -z "$(grep -oE '^  (-[a-z],)?-[a-z-]+' files/help | sort | uniq -d)" ] || fail "an option stands twice"
  grep -qE '^Examples?:$' files/help || fail "there is no example"
  cat -s files/help | cmp -s - files/help || fail "two empty lines"
  # The page's examples are run below.
  sed -n '/^Example/,$ s/^    //p' files/help >files/examples
  [ "$(wc -l <files/examples)" -eq "$(sed -n '/^\.EX$/,/^\.EE$/p' "man/vorpipe-$subcommand.1" | grep -vc '^\.E')" ] ||
    fail "the page has other examples"
done
case_of "help is short and begins with an example"
"$vorpipe" --help >log/out
[ "$(wc -l <log/out)" -le 30 ] || fail "it has more than 30 lines"
expect "    vorpipe render --sites random:10000 -o voronoi.png"

# text PAGE: as it is read, without the marks of bold and underlined.
text() { MANWIDTH=80 man --encoding=ascii --local-file "man/$1.1" 2>log/err | col -b; }
# Small systems have a man that only says that there are no pages; that of others takes other options.
if man --version 2>/dev/null | grep -qE '^man [0-9]'; then
  for page in $pages; do
    case_of "man says nothing about $page"
    LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "man/$page.1" 2>log/err >/dev/null
    [ -s log/err ] && fail "man has warnings"
    case_of "every option of --help stands in $page"
    subcommand=${page#vorpipe}
    "$vorpipe" ${subcommand#-} --help >files/help
    text "$page" >files/text
    grep -oE '^  (-[a-z],)?-[a-z-]+' files/help | tr -d ' ' | tr ',' '\n' >files/options
    [ -s files/options ] || fail "--help lists no option"
    missing=$(grep -oE '^ +(-h, )?-[a-z-]+' files/text | tr -d ' ' | tr ',' '\n' | grep -vxFf - files/options)
    [ -z "$missing" ] || fail "not $(xargs <<<"$missing")"
  done
else
  skipped "man reads the pages" "there is no man-db"
fi
if command -v groff >/dev/null && echo . | groff -man -ww -Tascii >/dev/null 2>&1; then
  for page in $pages; do
    case_of "groff says nothing about $page"
    groff -man -ww -Tascii "man/$page.1" >/dev/null 2>log/err || fail "exit code $?"
    [ -s log/err ] && fail "groff has warnings"
  done
else
  skipped "groff reads the pages" "there is no groff with the macros of man"
fi

# Examples are run as they stand, in order.
printf 'x,y\n1,2\n4,1\n3,5\n2,2.5\n' >sites.csv
printf 'POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0))' >outline.wkt
printf '{"type":"Polygon","coordinates":[[[0,0],[6,0],[6,6],[0,6],[0,0]]]}' >outline.geojson
echo close >play.txt
mkdir bin && ln -s "$vorpipe" bin/vorpipe
for page in $pages; do
  grep -q '^\.EX$' "man/$page.1" || { case_of "$page" && fail "it has no example"; }
  while IFS= read -r command; do
    case_of "the example of $page: $command"
    DISPLAY='' WAYLAND_DISPLAY='' PATH=$PWD/bin:$PATH bash -c "$command" >log/out 2>log/err </dev/null
    code=$?
    if [ "$page" = vorpipe-view ]; then
      # There is no display; tests/view/view.sh has one.
      [ "$code" -eq 3 ] || fail "exit code $code"
      one_line
    elif [ "$code" -eq 3 ] && [ -z "${VORPIPE_EXPECTED_BACKENDS-}" ]; then
      skipped "$command" "a backend cannot be used here"
    elif [ "$code" -ne 0 ]; then
      fail "exit code $code"
    fi
  done < <(sed -n '/^\.EX$/,/^\.EE$/ { /^\.E[XE]$/! { s/\\(aq/'"'"'/g; s/\\(ga/`/g; s/\\(ti/~/g; s/\\(ha/^/g; s/\\-/-/g; s/\\e/\\/g; p } }' "man/$page.1")
done

fails 2 "a page of what is no subcommand" '--help-man: "paint" is not one of render, cells,' --help-man paint
fails 2 "completions for a shell that is not known" '--completions: "tcsh" is not one of bash, zsh, fish' --completions tcsh
fails 2 "completions for no shell" '--completions: ""' --completions
fails 2 "two shells" '--completions: "zsh" is too much' --completions bash zsh

# -- Completions ----------------------------------------------------------------------------------------
for shell in bash zsh fish; do
  succeeds "completions for $shell" --completions $shell
  cp log/out "completions.$shell"
done
mkdir files/folder
: >files/a.csv
: >files/b.NPY
: >files/c.png
: >files/d.doc
: >files/e.geojson
: >files/f.json
rm files/help files/text files/options files/examples

# offered_SHELL LINE: what a shell offers for the last word of a line, one to a line.
offered_bash() {
  cd files && bash --norc -c '
    source ../completions.bash
    read -ra COMP_WORDS <<<"$(sed "s/\([=:]\)/ \1 /g" <<<"$1")"
    [[ $1 != *" " ]] || COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _vorpipe
    printf "%s\n" "${COMPREPLY[@]}"' bash "$1"
}
# fish 4 lists what has the word amid it as well, which Tab takes where nothing begins with the word.
offered_fish() {
  cd files && fish --no-config -c 'source ../completions.fish; complete -C $argv[1] | string split -f1 \t' "$1" |
    sed 's/^--[a-z-]*=//' | awk -v word="${1##*[ =]}" 'index($0, word) == 1'
}

# offers LINE WORD...: $shell offers these, and nothing else.
offers() {
  case_of "$shell completes '$1'"
  ("offered_$shell" "$1") 2>log/err | sed 's|/$||' | LC_ALL=C sort -u | xargs >log/out
  shift
  [ "$(cat log/out)" = "$*" ] || fail "not '$*'"
  [ -s log/err ] && fail "something on standard error"
}

backend_names=$("$vorpipe" render --help | sed -n 's/.*what computes: \(.*\) or \(.*\) \[auto\].*/\1, \2/p' | tr -d ,)
[ -n "$backend_names" ] || { case_of "names of backends" && fail "--help has none"; }
backend_names=$(printf '%s\n' $backend_names | LC_ALL=C sort | xargs)

for shell in bash fish; do
  if ! command -v $shell >/dev/null; then
    skipped "completions of $shell" "there is no $shell"
    continue
  fi
  offers "vorpipe ren" render
  offers "vorpipe de" devices
  offers "vorpipe cells --ba" --backend
  offers "vorpipe cells --weig" --weights
  offers "vorpipe devices --weig"
  offers "vorpipe render --color n" neighbors
  offers "vorpipe render --colormap=vi" viridis
  offers "vorpipe cells --backend " $backend_names
  offers "vorpipe cells --backend vulkan-c" vulkan-compute
  offers "vorpipe cells --backend=vulkan-c" vulkan-compute
  offers "vorpipe cells --periodic " x xy xyz xz y yz z
  offers "vorpipe cells --search g" grid
  offers "vorpipe bench th" thesis
  offers "vorpipe cells --disable shader" shaderFloat64
  offers "vorpipe compare --backends op" opengl
  offers "vorpipe compare --backends cpu,op" cpu,opengl
  offers "vorpipe cells --sites ran" random:
  offers "vorpipe cells --limit=maxTexelB" maxTexelBufferElements=
  offers "vorpipe cells --threads "
  offers "vorpipe cells --threads=4 --quie" --quiet
  offers "vorpipe cells --sites=random:9 --quie" --quiet
  # Files of other kinds are offered only where there is none that is right.
  offers "vorpipe diff " b.NPY c.png folder
  offers "vorpipe cells --domain " e.geojson f.json folder hull
  offers "vorpipe cells --weights=" a.csv b.NPY folder
  offers "vorpipe cells --sites a." a.csv
  offers "vorpipe cells -o d" d.doc
done

case_of "bash loses nothing where = does not break words"
(
  cd files && bash --norc -c '
    source ../completions.bash
    COMP_WORDS=(vorpipe cells --backend=vulkan-c) COMP_CWORD=2
    _vorpipe
    echo "${COMPREPLY[*]}"'
) >log/out 2>log/err
[ "$(cat log/out)" = --backend=vulkan-compute ] || fail "not --backend=vulkan-compute"

# typed_zsh LINE SETUP: what a zsh that is typed into makes of a line, once Tab is pressed.
typed_zsh() {
  timeout 60 zsh -f -c '
    zmodload zsh/zpty
    zpty typed "cd files && exec zsh -f -i"
    zpty -w typed "PS1= PS2=; unsetopt beep; autoload -Uz compinit; $2"
    zpty -w typed "show() { print -r -- \"LINE<\$BUFFER>\"; BUFFER=; zle accept-line }; zle -N show; bindkey ^T show"
    zpty -w typed "print -r -- REA\"\"DY"
    zpty -r -m typed ready "*READY*"
    zpty -n -w typed "$1"$'"'\\t\\x14'"'
    zpty -r -m typed line "*LINE<*>*" && print -r -- "${${line##*LINE<}%%>*}"
    zpty -d typed' zsh "$1" "$2"
}
if command -v zsh >/dev/null; then
  case_of "zsh reads its completions"
  zsh -n completions.zsh >log/out 2>log/err || fail "exit code $?"
  mkdir zsh && cp completions.zsh zsh/_vorpipe
  case_of "zsh completes by a script that is sourced"
  typed_zsh "vorpipe ren" 'compinit -D -u; source ../completions.zsh' >log/out 2>log/err </dev/null
  [ "$(sed 's/ *$//' log/out)" = "vorpipe render" ] || fail "not 'vorpipe render'"
  # As it is installed.
  while IFS='|' read -r typed line; do
    case_of "zsh completes '$typed'"
    typed_zsh "$typed" 'fpath=(../zsh $fpath); compinit -u -d ../zcompdump' >log/out 2>log/err </dev/null
    [ "$(sed 's/ *$//' log/out)" = "$line" ] || fail "not '$line'"
  done <<'END'
vorpipe ren|vorpipe render
vorpipe cells --ba|vorpipe cells --backend=
vorpipe cells --backend op|vorpipe cells --backend opengl
vorpipe cells --backend=op|vorpipe cells --backend=opengl
vorpipe render --color n|vorpipe render --color neighbors
vorpipe compare --backends cpu,op|vorpipe compare --backends cpu,opengl,
vorpipe cells --sites ran|vorpipe cells --sites random:
vorpipe cells --sites a.|vorpipe cells --sites a.csv
vorpipe cells --domain e|vorpipe cells --domain e.geojson
vorpipe bench th|vorpipe bench thesis
END
else
  skipped "completions of zsh" "there is no zsh"
fi

# -- What is offered is taken ---------------------------------------------------------------------------
# Words and kinds of files stand in one place for help and completions, but not all of them where they are read.
for sites in $( (offered_bash "vorpipe cells --sites ") | grep ':$'); do
  case $sites in
    icosahedral: | fibonacci:) succeeds "sites ${sites}12" cells --globe --backend cpu --sites "${sites}12" --check ;;
    *) succeeds "sites ${sites}9" cells --backend cpu --sites "${sites}9" --check ;;
  esac
done
for option in --sites --domain --weights --density; do
  extensions=$(sed -n "s/.*'cells $option').*_vorpipe_files '\([^']*\)'.*/\1/p" completions.bash)
  [ -n "$extensions" ] || { case_of "files of $option" && fail "none are offered"; }
  for extension in $extensions; do
    : >"empty$extension"
    arguments="--sites random:9 $option empty$extension"
    [ $option != --sites ] || arguments="--sites empty$extension"
    fails 2 "$option with $extension" "empty$extension" cells --backend cpu $arguments --stats out/old.json
    grep -q "unknown kind\|is neither" log/err && fail "it is not known"
  done
done

finish
