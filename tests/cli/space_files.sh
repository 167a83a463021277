#!/usr/bin/env bash
# Cells in space: files of simulations, of Voro++ and of meshes.
# Usage: space_files.sh VORPIPE
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
source "$here/harness.sh"

# places FILE: x, y and z of each row.
places() { awk -F, 'NR > 1 {print $2, $3, $4}' "$1"; }
# box_is NUMBERS: the domain of out/run.json.
box_is() { tr -d ' \n' <out/run.json | grep -qF "\"domain\":[$1]" || fail "the domain is not $1"; }

# -- Extended xyz -----------------------------------------------------------------------------------------
cat >in/two.xyz <<'END'
3
Properties=id:I:1:species:S:1:pos:R:3:force:R:2:radius:R:1 energy=-1.5 Lattice="4 0 0 0 5 0 0 0 6" pbc="F F F" Origin="-1 0 1"
7 Cu 0 1 2 0.5 1.5 1
5 Cu 1 2 3 0.5 2.5 0.5
2 O 2.5 4 6 0.5 3.5 0
1
Properties=species:S:1:pos:R:3
O 0 0 0
END
notes "an extended xyz is in space" "in/two.xyz: what follows its first 3 sites is not read" \
  cells --sites in/two.xyz --check -o out/two.csv --stats out/run.json
box_is -1.0,0.0,1.0,3.0,5.0,7.0
[ "$(places out/two.csv | tr '\n' ' ')" = "0 1 2 1 2 3 2.5 4 6 " ] || fail "other places"
[ "$(cut -d, -f5 out/two.csv | tr '\n' ' ')" = "weight 1 0.25 0 " ] || fail "radii are not squared"
[ "$(cut -d, -f14- out/two.csv | sed -n '1p;3p' | tr '\n' ' ')" = "id,species,force_1,force_2 5,Cu,0.5,2.5 " ] ||
  fail "attributes do not come back"
name="the run again" cases=$((cases + 1))
run 0 rerun out/run.json
gzip -k in/two.xyz && mv in/two.xyz.gz in/two.extxyz.gz
name="packed" cases=$((cases + 1))
run 0 cells --sites in/two.extxyz.gz -o out/one.csv
cmp out/two.csv out/one.csv || fail "other cells"
name="standard input" cases=$((cases + 1))
"$vorpipe" cells --sites - --format extxyz -o out/one.csv <in/two.xyz >log/out 2>log/err || fail "refused"
cmp out/two.csv out/one.csv || fail "other cells"
name="another domain" cases=$((cases + 1))
run 0 cells --sites in/two.xyz --domain -9,-9,-9,9,9,9 -o out/one.csv --stats out/run.json
box_is -9.0,-9.0,-9.0,9.0,9.0,9.0
printf '2\nlattice="2 0 0 0 2 0 0 0 2" a="Lattice=1 2"\nH 0 0 0\nH 1 1 1\n' >in/period.xyz
notes "a lattice is a period" "in/period.xyz: repeats itself along x, y, z; its cells do so with --domain and --periodic" \
  cells --sites in/period.xyz -o out/one.csv --stats out/run.json
box_is 0.0,0.0,0.0,2.0,2.0,2.0
printf '2\nLattice="2 0 0 1 2 0 0 0 2"\nH 0 0 0\nH 1 1 1\n' >in/tilted.xyz
notes "a tilted cell" "in/tilted.xyz: its cell is tilted, and is not used: --lattice names it" \
  cells --sites in/tilted.xyz -o out/one.csv --stats out/run.json
box_is -0.05,-0.05,-0.05,1.05,1.05,1.05
refuses_xyz() {
  printf "2\n$2\nH 0 0 0\nH 1 1 1\n" >in/wrong.xyz
  fails 2 "$2" "in/wrong.xyz:$1" cells --sites in/wrong.xyz -o out/old.csv
}
refuses_xyz "2:10: Lattice has 8 numbers, and not 9" 'Lattice="1 0 0 0 1 0 0 0"'
refuses_xyz "2:14: \"b\" is not a number" 'Lattice="1 0 b 0 1 0 0 0 1"'
refuses_xyz "2:12: Properties: are no list of NAME:TYPE:COUNT" 'Properties=species:S:1:pos'
refuses_xyz "2:12: Properties: pos has 2 columns, and not 3" 'Properties=species:S:1:pos:R:2'
refuses_xyz "2:12: the header" 'Properties=species:S:1:velo:R:3'
refuses_xyz "3:1: the row has 4 fields, the header 5" 'Properties=species:S:1:pos:R:3:q:R:1'
refuses_xyz '2:36: pbc: "X" is neither T nor F' 'Lattice="1 0 0 0 1 0 0 0 1" pbc="T X F"'

# -- LAMMPS -----------------------------------------------------------------------------------------------
cat >in/run.dump <<'END'
ITEM: TIMESTEP
1000
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
-1 3
0 8.0e0
2 10
ITEM: ATOMS id type xs ys zs diameter vx
12 1 0.25 0.5 0.75 3 0.1
3 2 0.5 0.25 0.5 1 0.2
ITEM: TIMESTEP
2000
END
notes "a dump" "in/run.dump: what follows its first 2 sites is not read" \
  cells --sites in/run.dump --check -o out/run.csv --stats out/run.json
box_is -1.0,0.0,2.0,3.0,8.0,10.0
[ "$(places out/run.csv | tr '\n' ' ')" = "0 4 8 1 2 6 " ] || fail "fractions of the box are not places"
[ "$(cut -d, -f5,14- out/run.csv | tr '\n' ' ')" = "weight,id,type,vx 2.25,12,1,0.1 0.25,3,2,0.2 " ] || fail "the columns"
sed '1,2d;s/ff ff ff/pp ff pp/;/^ITEM: ATOMS/s/xs ys zs/x y z/;/^ITEM: TIMESTEP/,$d' in/run.dump >in/plain.lammpstrj
notes "a dump with periods" "in/plain.lammpstrj: repeats itself along x, z; its cells do so with --domain and --periodic" \
  cells --sites in/plain.lammpstrj --columns x,y,z -o out/one.csv
[ "$(places out/one.csv | head -n 1)" = "0.25 0.5 0.75" ] || fail "other places"
refuses_dump() {
  sed "$2" in/run.dump >in/wrong.dump
  fails 2 "$2" "in/wrong.dump:$1" cells --sites in/wrong.dump -o out/old.csv
}
refuses_dump "4:1: \"two\" is no number of atoms" '4s/2/two/'
refuses_dump "6:4: \"x\" is not a number" '6s/3/x/'
refuses_dump "9:13: the header" '9s/xs ys/a b/'
refuses_dump "11:5: \"q\" is not a number (column x)" '11s/0.5/q/'
refuses_dump "1:1: a text dump of LAMMPS begins with" '1s/ITEM:/THING/'
refuses_dump " ends before its ITEM: ATOMS" '9,$d'
refuses_dump " ends after 1 of 2 sites" '11,$d'
cat >in/salt.data <<'END'
LAMMPS data file, of hand
2 atoms
0 bonds

0 4 xlo xhi # Angstrom
0 4 ylo yhi
-2 2 zlo zhi

Masses

1 22.98

Atoms # full

1 1 1 1.0 1 1 1 0 0 -1
2 1 2 -1.0 3 3 -1 0 0 0

Velocities

1 0 0 0
END
succeeds "a data file" cells --sites in/salt.data --check -o out/salt.csv --stats out/run.json
box_is 0.0,0.0,-2.0,4.0,4.0,2.0
[ "$(places out/salt.csv | tr '\n' ' ')" = "1 1 1 3 3 -1 " ] || fail "other places"
[ "$(sed -n 2p out/salt.csv | cut -d, -f14-)" = 1,1,1,1.0,0,0,-1 ] || fail "attributes do not come back"
sed 's/# full//' in/salt.data >in/mute.lmp
fails 2 "a style without a name" "in/mute.lmp:15:1: the section Atoms does not name its style" cells --sites in/mute.lmp -o out/old.csv
succeeds "columns by number" cells --sites in/mute.lmp --columns 5,6,7 -o out/one.csv
cmp <(places out/salt.csv) <(places out/one.csv) || fail "other places"
sed 's/full/sphere/;s/ 0 0 [-0]*1*$//' in/salt.data >in/sphere.lmp
succeeds "a style of balls" cells --sites in/sphere.lmp -o out/one.csv
[ "$(cut -d, -f5 out/one.csv | tr '\n' ' ')" = "weight 0.25 1 " ] || fail "diameters are not twice radii"
sed 's/full/bond/' in/salt.data >in/wrong.lmp
fails 2 "another style's fields" "in/wrong.lmp:15:1: the row has 10 fields, those of style bond have 6, or 9 with images" \
  cells --sites in/wrong.lmp -o out/old.csv
sed '2s/2/3/' in/salt.data >in/wrong.lmp
fails 2 "fewer atoms than announced" "in/wrong.lmp:18:1: the row has 1 fields" cells --sites in/wrong.lmp -o out/old.csv
sed 's/Atoms/Atome/' in/salt.data >in/wrong.lmp
fails 2 "no atoms" "in/wrong.lmp: ends before its section Atoms" cells --sites in/wrong.lmp -o out/old.csv
fails 2 "a picture of a dump" "there are \`cells\` alone" render --sites in/run.dump -o out/old.png

# -- Voro++ -----------------------------------------------------------------------------------------------
codes="%i|%q|%x %y %z|%r|%w|%P|%p|%o|%m|%g|%E|%s|%e|%F|%A|%a|%f|%t|%l|%n|%v|%c|%C"
awk 'BEGIN {srand(5); for (i = 1; i <= 300; ++i) print 1000 - 2 * i, rand(), rand(), 2 * rand(), 0.1 * rand()}' >in/pack.voro
succeeds "Voro++'s sites and lines" cells --sites in/pack.voro --domain 0,0,0,1,1,2 --id @id --voro-format "$codes" \
  --check -o out/pack.vol --stats out/run.json
name="the lines again" cases=$((cases + 1))
run 0 rerun out/run.json
name="the usual lines" cases=$((cases + 1))
run 0 cells --sites in/pack.voro --domain 0,0,0,1,1,2 -o out/usual.vol
mentions "in/pack.voro: not used: id"
[ "$(awk 'NR == 1 {print NF}' out/usual.vol)" = 6 ] || fail "the usual lines are not of i, x, y, z, v and r"
name="one thread" cases=$((cases + 1))
run 0 cells --sites in/pack.voro --domain 0,0,0,1,1,2 --threads 1 -o out/one.vol
cmp out/usual.vol out/one.vol || fail "two runs differ"
name="lines on standard output" cases=$((cases + 1))
run 0 cells --sites in/pack.voro --domain 0,0,0,1,1,2 -o - --format vol
cmp out/usual.vol log/out || fail "not the file"
if ! has_numpy; then
  skipped "Voro++'s own lines" "there is no python3 with NumPy"
elif voro++ --version >/dev/null 2>&1; then
  name="Voro++'s own lines" cases=$((cases + 1))
  cp in/pack.voro in/pack
  voro++ -r -c "$codes" 0 1 0 1 0 2 in/pack >log/out 2>log/err || fail "Voro++ failed"
  "$python" "$here/space_file_readers.py" lines out/pack.vol in/pack.vol >log/out 2>log/err || fail "they differ"
else
  skipped "Voro++'s own lines" "there is no voro++"
fi
fails 2 "an unknown code" "--voro-format: \"%k\" is no code of Voro++; they are %i %q" cells --sites fcc:9 --voro-format "%k" -o out/old.vol
fails 2 "no code" "--voro-format: \"x\" has no code" cells --sites fcc:9 --voro-format x -o out/old.vol
fails 2 "no lines" "--voro-format: there is no file of such lines: -o FILE.vol" cells --sites fcc:9 --voro-format %i -o out/old.csv
fails 2 "lines in the plane" "-o: out/old.vol: is a file of cells in space" cells --sites random:9 -o out/old.vol
fails 2 "their format in the plane" "--voro-format: is of files of cells in space" cells --sites random:9 --voro-format %i -o out/old.csv
fails 2 "a name for each site" "--id: the sites have no attribute \"name\"" cells --sites in/pack.voro --id @name -o out/old.vol
fails 2 "names elsewhere" "--id: of files of cells in space a .vol alone names sites" cells --sites in/pack.voro --id @id -o out/old.csv
printf 'x,y,z,weight\n0,0,0,-1\n1,1,1,0\n' >in/negative.csv
fails 2 "no radius" "%r is a radius, and the weight -1 of site 0 is of none" cells --dim 3 --sites in/negative.csv -o out/old.vol
printf '1 0 0\n' >in/wrong.voro
fails 2 "too few fields" "in/wrong.voro:1:1: the row has 3 fields; Voro++ reads id x y z, or id x y z r" cells --sites in/wrong.voro -o out/old.csv

# -- Read back by others ------------------------------------------------------------------------------------
if has_numpy; then
  succeeds "surfaces" cells --sites random:200 --dim 3 -o out/foam.stl -o out/foam.npz
  name="other programs read the surfaces" cases=$((cases + 1))
  "$python" "$here/space_file_readers.py" surfaces out/foam >log/out 2>log/err || fail "they do not"
  grep -q SKIPPED log/out && skipped "meshio reads surfaces" "there is no meshio for $python"
  name="files that ASE writes" cases=$((cases + 1))
  "$python" "$here/space_file_readers.py" write in >log/out 2>log/err || fail "it does not"
  if grep -q SKIPPED log/out; then
    skipped "files that ASE writes" "there is no ASE for $python"
  else
    for file in ase.extxyz ase.xyz ase.data; do
      name="ASE's $file" cases=$((cases + 1))
      run 0 cells --sites in/$file --check -o out/ase.csv --stats out/run.json
      cmp <(places out/ase.csv | awk '{printf "%.6f %.6f %.6f\n", $1, $2, $3}') in/ase.txt || fail "other places"
      box_is 0.0,0.0,0.0,9.0,10.0,11.0
    done
  fi
else
  skipped "other programs read the files" "there is no python3 with NumPy"
fi

finish
