/// vorpipe: Voronoi diagrams of sites in the plane, on any GPU or without one.
///
/// The public interface: plain data and functions. Nothing here prints, exits or throws on bad
/// input; a function that can fail returns Result. Coordinates are the caller's own units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace vorpipe {

/// The project's version, as `vorpipe --version` prints it.
std::string_view version();

enum class ErrorCode : std::uint8_t {
  input,      ///< the options or the data are wrong (exit code 2)
  device,     ///< no such backend or device here, or it failed (exit code 3)
  cancelled,  ///< the caller's Progress asked to stop
};

/// What went wrong outside the program: one line that names the thing, the place and what to do.
struct Error {
  ErrorCode code;
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// An axis-parallel rectangle; valid when finite and xmin < xmax, ymin < ymax.
struct Box {
  double xmin, ymin, xmax, ymax;
};

struct Point {
  double x, y;
};

/// A domain of any shape: polygons with holes, none of which cross or overlap. Ring r has the points
/// ring_offsets[r] .. ring_offsets[r + 1] - 1, the first of which is not repeated at its end; polygon p has
/// the rings polygon_offsets[p] .. polygon_offsets[p + 1] - 1: its outer ring, then its holes, each in either
/// direction. No points: there is no outline.
struct Outline {
  std::vector<Point> points;
  std::vector<std::uint64_t> ring_offsets, polygon_offsets;
  [[nodiscard]] bool empty() const { return points.empty(); }
};

/// The axes along which the domain repeats itself.
enum class Periodic : std::uint8_t { none, x, y, xy };

/// A density over the domain, constant in each pixel; laid out as Image. Finite, and not negative.
struct Density {
  int width = 0, height = 0;
  std::vector<double> values;  ///< mass per unit of area; empty: there is no density
};

/// Sites in the caller's order. `weight` is empty or as long as x and y. The cell of site i is where
/// |x - p_i|^2 - w_i is least (a power diagram; also Laguerre, radical or weighted Voronoi diagram). Adding
/// a number to all weights changes nothing; with equal weights it is the Voronoi diagram.
struct Sites {
  std::vector<double> x, y, weight;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// The sites as a periodic domain takes them. Along the axes that repeat, a site beyond the domain is moved
/// into it, by whole periods, and coordinates are rounded to some 2^-52 of the domain's side or of its
/// largest coordinate, if that is larger: then images are exact copies. Sites that are now equal, modulo the
/// period, are duplicates. Errors (input): no valid domain, no sites or not finite ones; a site more than
/// 2^50 periods away.
Result<Sites> wrapped(const Sites& sites, const Box& domain, Periodic periodic);

/// How many sites and images together the cells of a domain are found among, to tell how much memory that
/// takes: one and a little for each of many even sites, up to nine for each of a few, or of very uneven ones.
/// If the first choice of images turns out to be too small, more are taken. Errors: those of wrapped().
Result<std::uint64_t> sitesAndImages(const Sites& sites, const Box& domain, Periodic periodic,
                                     int threads = 0);

/// Generators of sites in the unit square; the same seed gives the same sites on every platform.
enum class Pattern : std::uint8_t {
  random,    ///< white noise
  square,    ///< square lattice of floor(sqrt(n))^2 sites
  hex,       ///< hexagonal lattice of about n sites
  jitter,    ///< square lattice, each site moved at random inside its own square
  clusters,  ///< about 100 normal clusters of different sizes
  circle,    ///< evenly spaced on a circle of radius 0.4 about the center
};

/// Returns about n sites of a pattern (exactly n but for `square` and `hex`), n >= 1.
/// Sites of the patterns without randomness do not depend on seed.
Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed);

/// Pretends that a device lacks features or has smaller limits, by their Vulkan names
/// (`geometryShader`; `maxTexelBufferElements`). A limit can only be lowered.
struct Mask {
  std::vector<std::string> disabled;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// The names that BackendOptions::name takes.
std::vector<std::string> backendNames();

/// The names of features and of limits that a Mask takes.
std::vector<std::string> featureNames();
std::vector<std::string> limitNames();

struct BackendOptions {
  std::string name = "auto";  ///< auto, vulkan, vulkan-geometry, vulkan-compute, opengl, cpu
  std::string device;         ///< empty: the best; else an index or a part of a name, as devices() lists
  int threads = 0;            ///< CPU threads; 0: all
  Mask mask;
  bool validation = false;  ///< Vulkan validation layers, core and synchronization
};

/// One device of one backend, usable or not.
struct DeviceInfo {
  std::string backend, name, driver;
  std::string type;  ///< discrete, integrated, virtual, cpu, other
  bool usable = false;
  std::string reason;  ///< why it cannot be used, and what would help; empty when usable
  std::vector<std::pair<std::string, bool>> features;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// Every backend with its devices; a backend without any has one entry that says why.
std::vector<DeviceInfo> devices(const Mask& mask);

/// What became of a site.
enum class Status : std::uint8_t {
  ok,         ///< it has a cell inside the domain, certified
  empty,      ///< certified: no part of the domain is nearest to it; it lies outside, or others hide it
  duplicate,  ///< another site has the same position and owns the cell: the heaviest, then the earliest
};

/// How the sites that may cut a cell are found.
enum class Search : std::uint8_t {
  grid,   ///< a walk over a uniform grid, fused with the clipping; no fixed number of neighbors
  flann,  ///< the k nearest neighbors by FLANN, doubled for the cells that k does not certify
};

struct SearchOptions {
  Search method = Search::grid;
  int neighbors = 30;  ///< FLANN's k, 3 to 1024
};

/// Called from the calling thread with a stage's name and the part done in [0, 1];
/// returning false stops the run with ErrorCode::cancelled.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

enum class ColorBy : std::uint8_t { site, area, neighbors, weight };

struct RenderOptions {
  Box domain;         ///< what is drawn, and what cells are clipped to
  Outline outline{};  ///< what cells are clipped to besides, inside the domain; pixels beyond it have no site
  Periodic periodic = Periodic::none;
  int width, height;  ///< pixels, 1 to 32768 each
  ColorBy color = ColorBy::site;
  std::string colormap = "viridis";  ///< one of colormaps()
  bool edges = false;                ///< darkens pixels beside which another cell begins
  bool show_sites = false;           ///< a dot at each site
  SearchOptions search;
  Progress progress;  ///< may be empty
};

std::vector<std::string> colormaps();

inline constexpr std::uint32_t no_site = 0xFFFFFFFFu;

/// Row 0 is the top (largest y). The center of pixel (row, column) is
/// x = xmin + (column + 0.5) / width (xmax - xmin), y = ymax - (row + 0.5) / height (ymax - ymin).
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba;  ///< R in the lowest byte
  std::vector<std::uint32_t> ids;   ///< index of the site in the input, or no_site
};

/// Wall time by stage in milliseconds; negative where a stage does not apply.
struct Times {
  double order = -1, upload = -1, search = -1, cells = -1, draw = -1, download = -1;
};

/// What a run did, for --stats.
struct Report {
  std::string backend, device, driver;
  std::uint64_t ok = 0, empty = 0, duplicate = 0;
  std::uint64_t retried = 0;    ///< cells redone on the device with more neighbors or more room
  std::uint64_t in_double = 0;  ///< cells certified in double on the host
  std::uint64_t exact = 0;      ///< cells decided in exact arithmetic
  Times time_ms;
  std::vector<std::string> validation_messages;  ///< empty unless validation was on and spoke
};

struct Rendering {
  Image image;
  std::vector<Status> status;        ///< by site, in input order
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  Report report;
};

/// How one pixel of two id images compares.
enum class PixelMatch : std::uint8_t { equal, tie, wrong };

/// A pixel whose center is at most this far, in pixels, from the bisector of two sites may go to
/// either: backends snap vertices to 1/256 pixel, and draw cells widened by half of that.
inline constexpr double tie_distance = 1.0 / 128;

/// One pixel that two id images give to different sites.
struct IdDifference {
  int row = 0, column = 0;
  std::uint32_t a = no_site, b = no_site;
  double distance = 0;  ///< of the pixel's center to the bisector of a and b in pixels; infinite without one
};

struct IdDiff {
  std::uint64_t equal = 0, ties = 0, wrong = 0;
  std::uint64_t ties_allowed = 0;   ///< the cell boundaries' length in pixel sides, frame included
  double widest_tie = 0;            ///< largest distance of a tie
  std::vector<IdDifference> first;  ///< the first 10 wrong pixels in reading order
  IdDifference worst;               ///< the wrong pixel farthest from the bisector; meaningless if wrong is 0
  std::vector<PixelMatch> pixels;
  /// True when rounding explains every difference.
  [[nodiscard]] bool agree() const { return wrong == 0 && ties <= ties_allowed; }
};

/// Compares two id images of width x height pixels without knowing the sites: every difference is wrong.
IdDiff diffIds(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width, int height);

/// Compares two id images of the same sites and domain, laid out as Image::ids.
///
/// A differing pixel is a tie when its center lies within tie_distance of the bisector of its two
/// sites, and a cell ends at one of its four sides in one of the images; else it is wrong, as it is
/// when an id names no site or both sites have one position (the lower index owns that cell). This
/// misses no legal difference: a center that is within the distance of both drawn cells lies on one
/// side of their bisector, and the cell on the other side is no nearer than the bisector itself.
///
/// Ties are also counted against the length of the cell boundaries, the image's frame among them,
/// in the image that has less of it: a row of pixel centers that lies on a boundary (as a lattice
/// may have it everywhere) is one tie for each pixel side of that boundary, and nothing legal is more.
///
/// In a periodic domain the bisector is that of the images nearest to the center.
///
/// Errors (input): no valid domain; those of wrapped().
Result<IdDiff> diffIds(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width,
                       int height, const Sites& sites, const Box& domain, Periodic periodic = Periodic::none);

/// Where and how much two pictures differ; rows and columns are inclusive and only set when different > 0.
struct ImageDiff {
  std::uint64_t different = 0;  ///< pixels
  int largest = 0;              ///< largest difference of a channel, 0 to 255
  int first_row = 0, first_column = 0;
  int top = 0, left = 0, bottom = 0, right = 0;  ///< box of the differing pixels
  std::vector<PixelMatch> pixels;                ///< equal or wrong
};

/// Compares two pictures of width x height RGBA pixels, laid out as Image::rgba.
ImageDiff diffImages(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width,
                     int height);

/// Which parts of a Diagram are wanted; what is not costs no time.
enum class Detail : std::uint8_t {
  measures,    ///< status, owner, area, centroid, cell_offsets, neighbors
  polygons,    ///< and perimeter, second moments, vertices, edge lengths
  everything,  ///< and triangles
};

struct CellsOptions {
  Box domain;         ///< what cells are clipped to
  Outline outline{};  ///< what cells are clipped to besides, inside the domain
  Periodic periodic = Periodic::none;
  Density density{};  ///< over the domain
  SearchOptions search;
  Detail detail = Detail::everything;
  Progress progress;  ///< may be empty
};

/// In `Diagram::neighbors`: the domain's walls xmin, xmax, ymin, ymax, and the outline.
inline constexpr std::int64_t wall_xmin = -1, wall_xmax = -2, wall_ymin = -3, wall_ymax = -4,
                              wall_outline = -5;

/// Cells as data, in input order and in the caller's units: one record for each site, whatever
/// happened to it. Cell i has the vertices cell_offsets[i] .. cell_offsets[i + 1] - 1, counter-
/// clockwise; edge k of a cell runs from its vertex k to the next and belongs to its neighbor k, so
/// that one table of offsets serves vertices, neighbors and edge lengths.
/// An edge shorter than 1e-6 of the distance between its two sites is a tie: neither cell has it.
///
/// In a domain with an outline a cell may have several rings, outer ones counter-clockwise, each followed
/// by its holes, clockwise; a neighbor may have several edges. Where an axis is periodic, a cell is whole,
/// around its site, as wrapped() places it, and may reach beyond the domain; it may neighbor itself.
struct Diagram {
  std::vector<Status> status;
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  std::vector<double> area, perimeter;
  std::vector<Point> centroid;                        ///< of the cell; the site itself where there is no cell
  std::vector<std::array<double, 3>> second_moments;  ///< about the centroid: integrals of xx, xy, yy
  std::vector<std::uint64_t> cell_offsets;            ///< size: sites + 1
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;  ///< indices of sites, or walls
  std::vector<double> edge_lengths;
  /// Of a periodic domain, one for each of `neighbors`: the image of the neighbor that the cell meets stands
  /// that many widths and heights of the domain from the neighbor itself, as wrapped() places it.
  std::vector<std::array<std::int32_t, 2>> neighbor_shifts;
  /// Of a domain with an outline: where in `vertices` each ring begins, ascending; it ends where the next one
  /// or the cell does. Empty without an outline: every cell is one ring.
  std::vector<std::uint64_t> ring_starts;
  std::vector<double> mass;          ///< of a density, by site: its integral over the cell
  std::vector<Point> mass_centroid;  ///< by site: center of the mass; the centroid where there is no mass
  /// The Delaunay triangulation of all sites but duplicates, whatever the domain: counter-clockwise from the
  /// lowest index, ties triangulated from the lowest index; empty if all sites lie on a line. With weights,
  /// the regular triangulation, without hidden sites. Empty where the domain is periodic.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Report report;
};

/// The sum of the cells' areas, without what adding up would round off.
double areaSum(const Diagram& diagram);

/// Areas of one cell may differ by this part of the larger and this part of the mean cell.
inline constexpr double area_slack_of_cell = 1e-5, area_slack_of_mean = 1e-9;

/// One site whose cells differ in two diagrams, and how.
struct CellDifference {
  std::uint32_t site = 0;
  bool status = false, neighbors = false, area = false;  ///< status stands for the owner as well
  double area_a = 0, area_b = 0;
};

struct CellsDiff {
  std::uint64_t equal = 0;                               ///< sites without a difference
  std::uint64_t statuses = 0, neighbors = 0, areas = 0;  ///< sites that differ in each
  std::uint32_t worst_site = 0;                          ///< whose areas differ most, by what is allowed
  double worst_area = 0;                                 ///< that difference, as a part of what is allowed
  std::vector<CellDifference> first;                     ///< the first 10 sites that differ
  [[nodiscard]] bool agree() const { return statuses == 0 && neighbors == 0 && areas == 0; }
};

/// Compares two diagrams of the same sites and domain: status and owner of every site, the sets of its
/// neighbors, walls and shifts included, and its area. Error (input): they have different numbers of sites.
Result<CellsDiff> diffCells(const Diagram& a, const Diagram& b);

/// Verifies what is promised about cells, with nothing of what computes them: statuses and owners, each
/// record at its site's place, areas that add up to the domain's (to 1e-12), neighbors that name each
/// other with the same edge, closed convex polygons, counter-clockwise, on the bisectors of their
/// neighbors, Euler's formula for cells and triangles, and the nearest sites of sampled places. `options`
/// are those of the run; parts that its detail leaves out are not looked at. Returns one line for each
/// promise that is broken, which begins with its name. Error (device): out of memory.
Result<std::vector<std::string>> check(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads = 0);

/// The same for a picture: statuses and owners, no uncovered pixel, and the nearest site of each pixel
/// in double (of 4 million sampled pixels in larger pictures).
Result<std::vector<std::string>> check(const Sites& sites, const RenderOptions& options,
                                       const Rendering& rendering, int threads = 0);

class Backend;

/// One backend, ready to work. Not thread-safe.
class Session {
 public:
  /// Opens the backend that options name; an error says which is missing and what would help.
  static Result<Session> open(const BackendOptions& options);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Draws the diagram of at least one finite site. Errors: no sites, a number that is not finite,
  /// a domain or size out of range (input); the device failed (device); progress said stop.
  Result<Rendering> render(const Sites& sites, const RenderOptions& options);

  /// Computes the cells of at least one finite site. Errors: as render's.
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options);

  /// backend, device and driver in use; usable is true.
  [[nodiscard]] const DeviceInfo& device() const;
  /// Why `auto` or `vulkan` took this backend; empty where the caller named it.
  [[nodiscard]] const std::string& choice() const;

 private:
  Session();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe
