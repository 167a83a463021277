#include "cli/manual/prose.h"

#include <algorithm>
#include <array>

namespace vorpipe::cli {
namespace {

const std::vector<Prose> pages = {
    {"",
     {"`vorpipe` computes and draws Voronoi diagrams of sites in the plane: for each site its cell, "
      "which is nearer to it than to any other site, also called its Thiessen polygon or Dirichlet cell. "
      "With weights these are power diagrams, also called Laguerre or radical tessellations. The domain "
      "is a box, a box that repeats itself, or polygons with holes.",
      "Cells are found on a graphics device through Vulkan or OpenGL 4.1, by Mesa's software drivers, "
      "or by the CPU alone. Every cell is certified complete, and neighbors agree about the edge "
      "between them. `--check` verifies a run with code that shares nothing with what computed it.",
      "Errors are one line on standard error. Output files appear whole, or stay as they were."},
     {{"Draw 10,000 random sites:", {"vorpipe render --sites random:10000 -o voronoi.png"}},
      {"Get areas, neighbors and polygons of the sites of a file:",
       {"vorpipe cells --sites sites.csv -o cells.csv -o cells.geojson"}},
      {"See which devices are here:", {"vorpipe devices"}}}},
    {"render",
     {"Each pixel belongs to the site that is nearest to its center. `-o` is the picture, `--ids` an "
      "array with the number of that site, in the order of the input. Without either of them, `--check` "
      "verifies and nothing is written.",
      "Colors by area or neighbors, weights, and outlines that sites lie beyond take the cells first, "
      "as `vorpipe cells` computes them."},
     {{"Draw sites of a file with their cells' edges:",
       {"vorpipe render --sites sites.csv --edges --show-sites -o sites.png"}},
      {"Show how large cells are:",
       {"vorpipe render --sites jitter:2000 --color area --colormap magma -o area.png"}},
      {"Draw a figure for print, and the same as shapes:",
       {"vorpipe render --sites random:60 --edges --dual --labels --no-fill --antialias 4 -o figure.png "
        "-o figure.pdf"}},
      {"Draw a power diagram:",
       {"vorpipe render --sites random:300 --random-weights 0,0.01 --color weight -o power.png"}},
      {"Get the site of each pixel as an array:",
       {"vorpipe render --sites random:1000 --size 500x500 --ids ids.npy"}}}},
    {"cells",
     {"There is a record for each site, in the order of the input: polygon, area, perimeter, centroid, "
      "second moments, and neighbors with the lengths of the edges between. Each format has what it can "
      "hold; .npz has everything. Without `-o` the cells are computed, and verified by `--check`.",
      "Neighbors run counter-clockwise. The walls of the domain are -1 to -4 (xmin, xmax, ymin, ymax), "
      "an outline is -5. The status of a site is ok, empty where no part of the domain is nearest to "
      "it, or duplicate where another site stands in the same place and owns the cell."},
     {{"Get the cells as a table and as arrays:",
       {"vorpipe cells --sites sites.csv -o cells.csv -o cells.npz"}},
      {"Read sites from a pipe:",
       {"printf 'x,y\\n1,2\\n4,1\\n3,5\\n' | vorpipe cells --sites - -o three.csv"}},
      {"Clip the cells to polygons:",
       {"vorpipe cells --sites sites.csv --domain outline.geojson -o clipped.geojson"}},
      {"Verify a diagram that repeats itself:",
       {"vorpipe cells --sites random:1000 --periodic xy --check"}}}},
    {"view",
     {"Drag to look around, turn the wheel to zoom; click to add a site, drag one to move it, click it "
      "with the right button to remove it, turn the wheel with Ctrl held to change its weight. `?` "
      "lists the keys. What is shown is what `vorpipe render` draws, and Ctrl+C copies the command line "
      "that draws it. Without `--sites` there are a few random ones to begin with.",
      "A script has one event on a line: `move X Y`, `press BUTTON`, `release BUTTON`, `scroll STEPS`, "
      "`key NAME`, `text ...`, `resize W H`, `minimize`, `restore`, `drop FILE` and `close`; `shift`, "
      "`control` or `alt` after press, scroll and key are held. `wait` goes on when the picture of all "
      "that came before is shown, `wait SECONDS` after a time. `screenshot FILE.png` saves what is "
      "shown, without the panel, or with it where `panel` follows."},
     {{"Look at the sites of a file:", {"vorpipe view --sites sites.csv --color area"}},
      {"Save what the window shows, and close it:",
       {"vorpipe view --sites random:1000 --edges --screenshot window.png"}},
      {"Watch sites relax, and keep the film:",
       {"vorpipe view --sites random:1000 --relax --record relax.mp4"}},
      {"Play a script:", {"vorpipe view --sites random:1000 --script play.txt"}}}},
    {"relax",
     {"Each site moves to where the energy falls: the sum over all cells of the integral of the squared "
      "distance to the site. It is least where every site is the centroid of its cell. Areas become alike, "
      "and cells nearly regular hexagons, whose lattice no diagram is better than: the energy is printed as "
      "a part of the lattice's.",
      "Sites stay in the domain, and along periodic axes come back at the other side. A site at the place "
      "of another is set beside it, one outside of the domain is moved into it, and one that a density "
      "leaves without mass is moved into a cell that has much. Weights stay as they are.",
      "After Ctrl-C the files have what was reached; a second one ends the program without."},
     {{"Relax 10,000 random sites, and see how the energy fell:",
       {"vorpipe relax --sites random:10000 -o relaxed.csv --trace trace.csv"}},
      {"Make even cells of sites that repeat themselves, with a picture:",
       {"vorpipe relax --sites random:500 --periodic xy --cells even.npz --picture even.png"}},
      {"Take a few of Lloyd's steps, and keep all that is between:",
       {"vorpipe relax --sites clusters:500 --method lloyd --iterations 4 --save-every 1 -o step.csv"}}}},
    {"transport",
     {"The cell of site p of weight w is where |x - p|^2 - w is least. For any masses that add up to what "
      "the domain has there are weights that give each cell its own, and only one choice of them but for a "
      "number added to all: the solution of semi-discrete optimal transport. Newton's method finds it "
      "(Kitagawa, Merigot and Thibert 2019), from the weights of the sites if these leave each cell some "
      "mass.",
      "Sites do not move, and may lie anywhere: outside of the domain, or crowded in a corner. Two at one "
      "place are refused. With a free surface cells are cut by discs, whose squared radii are the weights.",
      "Where the tolerance is not reached, or after Ctrl-C, the files have what was reached; the exit code "
      "is 1 then, or 130."},
     {{"Give 1,000 random sites equal areas, and see how the worst cell came to its own:",
       {"vorpipe transport --sites random:1000 -o equal.csv --trace trace.csv"}},
      {"Share a square out by the numbers in a file, with a picture:",
       {"seq 1 6 >masses.txt",
        "vorpipe transport --sites random:6 --masses masses.txt --normalize --picture shares.png"}},
      {"Begin with the weights of another run:",
       {"vorpipe transport --sites jitter:500 --save-weights weights.npy",
        "vorpipe transport --sites jitter:500 --weights weights.npy --cells cells.npz"}}}},
    {"fluid",
     {"Each site carries a part of the fluid, which is its cell and keeps its area: weights are found "
      "for that at each step. `--scheme springs` pulls sites to the centroids of their cells, and keeps "
      "the sum of all energies; `--scheme projection` takes from velocities what would change areas, "
      "and is more exact while cells stay round.",
      "`taylor-green` and `gresho` are vortices that never change, which shows errors; `shear` rolls "
      "up, `rayleigh-taylor` has a heavy fluid above a light one, and `dam-break` a column of water "
      "that falls, with a free surface.",
      "After Ctrl-C the files have what was reached; a second one ends the program without. Where areas "
      "cannot be found the files have the step before, and the exit status is 1."},
     {{"Break a dam, and keep a picture of every tenth step:",
       {"vorpipe fluid --case dam-break --particles 500 --time 0.1 --frames dam"}},
      {"Follow a vortex exactly, with a row for each step:",
       {"vorpipe fluid --case taylor-green --particles 256 --scheme projection --trace trace.csv"}},
      {"Stop, and go on:",
       {"vorpipe fluid --case shear --particles 256 --steps 5 --checkpoint shear.npz",
        "vorpipe fluid --resume shear.npz --steps 5 -o sites.csv"}}}},
    {"diff",
     {"`vorpipe render --ids` writes id arrays. With `--sites`, and what else they were made with, a "
      "pixel whose center lies within 1/128 of a pixel of the bisector of its two sites is a tie, and "
      "any other difference is wrong. Without `--sites`, and in pictures, every difference is."},
     {{"Compare what two backends draw:",
       {"vorpipe render --backend cpu --sites square:100 --ids a.npy",
        "vorpipe render --backend opengl --sites square:100 --ids b.npy",
        "vorpipe diff a.npy b.npy --sites square:100 -o where.png"}},
      {"See whether two runs draw the same to the bit:",
       {"vorpipe render --backend cpu --sites random:100 -o a.png",
        "vorpipe render --backend cpu --sites random:100 --threads 1 -o b.png", "vorpipe diff a.png b.png"}},
      {"Allow what drivers may do otherwise, with a report for a script:",
       {"vorpipe render --backend opengl --sites random:100 -o c.png",
        "vorpipe diff a.png c.png --max-difference 2 --max-pixels 200 --json diff.json"}}}},
    {"compare",
     {"The same sites are drawn and computed on each backend, and every pair is compared, pixel by "
      "pixel and cell by cell. It is a difference where pixels differ by more than ties, or cells by "
      "status, neighbors or area. A pixel whose center lies on an edge may go to either cell: the table "
      "says how many did, and how many could at most."},
     {{"Compare a device with the CPU, and write every figure:",
       {"vorpipe compare --backends vulkan-compute,cpu --sites hex:1000 --report report.json"}},
      {"See where the pictures of two backends differ:",
       {"vorpipe compare --backends opengl,cpu --sites square:100 --size 200x200 -o side-by-side.png"}},
      {"Verify each of them besides:",
       {"vorpipe compare --backends vulkan-compute,cpu --sites clusters:500 --size 100x100 --check"}},
      {"Compare with ids that an earlier run wrote:",
       {"vorpipe render --sites hex:100 --size 200 --ids kept.npy",
        "vorpipe compare --backends opengl --sites hex:100 --reference kept.npy"}}}},
    {"rerun",
     {"`--stats` of `render`, `cells`, `relax`, `transport` and `compare` writes the arguments of a "
      "run, and for each file that it read and wrote how many bytes it has and their hash, as "
      "`xxh128sum` prints it. Where an input has changed since, that is refused. Else the run is done "
      "again, files are written where they were written then, and their hashes are compared. Paths are "
      "relative to the current folder. The file of `--stats` stays as it is.",
      "Another version, revision, backend or device is told of on standard error; it may have another "
      "result."},
     {{"Run again, and see whether it comes to the same bytes:",
       {"vorpipe cells --backend cpu --sites sites.csv -o cells.npz --stats run.json",
        "vorpipe rerun run.json"}},
      {"Get the command line:", {"vorpipe rerun --dry-run run.json"}}}},
    {"devices",
     {"For each device it says what `--device` takes, and for a backend that cannot be used, what would "
      "help."},
     {{"List devices as a table, or as JSON with their limits:",
       {"vorpipe devices", "vorpipe devices --json"}},
      {"See what another machine would lack:",
       {"vorpipe devices --disable geometryShader --limit maxTexelBufferElements=65536"}}}},
    {"bench",
     {"The tables say how time grows with sites, what each stage of a run takes, how kinds of input "
      "differ, what memory it takes, and have the measurements of the thesis that the method comes "
      "from. Where none is named all are measured, up to a size that takes some minutes."},
     {{"See how kinds of input differ on the CPU:",
       {"vorpipe bench inputs --backend cpu --max-sites 10000 --json inputs.json"}},
      {"Measure how much memory a run takes:",
       {"vorpipe bench memory --backend cpu --max-sites 1000 --max-side 500 --repetitions 1"}},
      {"Draw how time grows with sites and with pixels:",
       {"vorpipe bench scaling --backend cpu --max-sites 1000 --max-side 500 --plot scaling.svg"}}}},
    {"selftest",
     {"Scenes of the program's own are computed and drawn on each backend and device, and judged by `cpu`. "
      "It is a difference where a promise is broken. A bug report wants the file that `--json` writes."},
     {{"Test one backend within seconds:",
       {"vorpipe selftest --quick --backend cpu --json selftest.json"}}}}};

constexpr std::array<Row, 5> exit_statuses = {
    {{"0", "Done, and everything is certified."},
     {"1",
      "A comparison found a difference, or a promise is broken; `rerun` came to other bytes, `transport` not "
      "to the tolerance; areas of a `fluid` could not be found, or its energy exploded."},
     {"2",
      "The command line or an input file is wrong; the message names the option, or file, line and column."},
     {"3",
      "There is no such device or backend here, or it failed; or memory, a display or ffmpeg is missing. The "
      "message says what would help."},
     {"130, 143", "Interrupted: 128 and the signal's number."}}};

constexpr std::array<Row, 5> variables = {
    {{"VORPIPE_VALIDATION",
      "Where it is 1, yes, true or on, Vulkan's validation layers are on, as by `--validate`."},
     {"VK_DRIVER_FILES", "The Vulkan drivers to use, as for every program: the files that describe them."},
     {"LIBGL_ALWAYS_SOFTWARE", "Where it is true, OpenGL is that of Mesa's software drivers."},
     {"GALLIUM_DRIVER", "Which of these, such as llvmpipe."},
     {"LP_NUM_THREADS",
      "Threads of Mesa's software drivers; set for them by `--threads` where it is not set."}}};

}  // namespace

Prose proseOf(std::string_view subcommand) {
  const auto page = std::ranges::find(pages, subcommand, &Prose::subcommand);
  return page == pages.end() ? Prose{subcommand, {}, {}} : *page;
}

std::span<const Row> exitStatuses() { return exit_statuses; }
std::span<const Row> environment() { return variables; }

}  // namespace vorpipe::cli
