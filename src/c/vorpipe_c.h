/* vorpipe from C: Voronoi (Thiessen, Dirichlet) and power (Laguerre, radical) diagrams of sites in the plane.
 *
 * The one interface whose binary form stays: a program built against this header runs with any later library
 * of the same SONAME. Coordinates are the caller's own units. No function prints, exits or throws.
 *
 * - A function that can fail returns a vorpipe_code; vorpipe_last_error() then says what is wrong, in one
 * line. What it would have written through a pointer is left alone.
 * - Structs of options begin with their size: begin with `vorpipe_cells_options options = {sizeof options};`.
 * What is zero is left to the library, which knows of fields that a program built earlier does not have.
 * - Objects are opaque and the caller's, to be freed by the function of their name. Freeing NULL does
 * nothing. What a function returns as `const` belongs to the object it is asked of, and lives as long.
 * - One object is used by one thread at a time, but for diagrams and pictures, which are never changed. A
 * session has one run at a time: another one is refused by VORPIPE_DEVICE, from its progress as well. */
#ifndef VORPIPE_C_H
#define VORPIPE_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define VORPIPE_API __attribute__((visibility("default")))
#else
#define VORPIPE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Codes ---- */

/* The numbers are the exit codes of the program `vorpipe`. */
typedef int32_t vorpipe_code;
enum {
  VORPIPE_DONE = 0,
  VORPIPE_DIFFERENT = 1,  /* done, and a promise is broken, or what was compared differs */
  VORPIPE_INPUT = 2,      /* the options or the data are wrong */
  VORPIPE_DEVICE = 3,     /* no such backend or device here, or it failed; or memory or the disk is full */
  VORPIPE_CANCELLED = 130 /* the caller's progress asked to stop */
};

/* What of the input an error is about. */
typedef int32_t vorpipe_subject;
enum {
  VORPIPE_SUBJECT_NONE = 0,
  VORPIPE_SUBJECT_SITES = 1,
  VORPIPE_SUBJECT_WEIGHTS = 2,
  VORPIPE_SUBJECT_DOMAIN = 3,
  VORPIPE_SUBJECT_OUTLINE = 4,
  VORPIPE_SUBJECT_PERIOD = 5,
  VORPIPE_SUBJECT_DENSITY = 6,
  VORPIPE_SUBJECT_SEARCH = 7,
  VORPIPE_SUBJECT_MASSES = 8
};

/* Of the last call of this thread that did not return VORPIPE_DONE; "" and none before that. */
VORPIPE_API const char* vorpipe_last_error(void);
VORPIPE_API vorpipe_subject vorpipe_last_subject(void);

/* As `vorpipe --version` prints it: "0.2.0". */
VORPIPE_API const char* vorpipe_version(void);

/* ---- Names ---- */

/* Lists of the names that options take. */
typedef int32_t vorpipe_list;
enum {
  VORPIPE_BACKENDS = 1,      /* "auto", "vulkan", ..., "cpu" */
  VORPIPE_COLORMAPS = 2,     /* "viridis", ... */
  VORPIPE_CELLS_FORMATS = 3, /* "csv", "npz", ... */
  VORPIPE_FEATURES = 4,      /* of devices, as Vulkan names them: "geometryShader" */
  VORPIPE_LIMITS = 5,        /* of devices: "maxTexelBufferElements" */
  VORPIPE_SITES_FORMATS = 6, /* "csv", "geojson", ... */
  VORPIPE_EDGES_FORMATS = 7,
  VORPIPE_PICTURE_FORMATS = 8, /* "png", "svg", "npy", ... */
  VORPIPE_FLUID_CASES = 9      /* "taylor-green", ... */
};

/* A name of a list; NULL where there is no such list or `index` is past its end. */
VORPIPE_API const char* vorpipe_name(vorpipe_list list, size_t index);

/* ---- Calls back ---- */

/* Called from the calling thread with a stage's name and the part done in [0, 1]; what is not 0 asks to stop.
 */
typedef int32_t (*vorpipe_progress)(void* user, const char* stage, double fraction);

/* Gets the bytes of a file, some at a time; what is not 0 refuses them. */
typedef int32_t (*vorpipe_write)(void* user, const void* bytes, size_t count);

/* ---- Devices ---- */

/* Pretends that a device lacks a feature, or has a smaller limit. */
typedef struct vorpipe_limit {
  const char* name;
  uint64_t value;
} vorpipe_limit;

typedef struct vorpipe_session_options {
  uint32_t struct_size;
  int32_t threads;     /* CPU threads; 0: all */
  const char* backend; /* NULL: "auto" */
  const char* device;  /* NULL: the best; else an index or a part of a name */
  int32_t validation;  /* not 0: Vulkan's validation layers are on */
  uint32_t disabled_count;
  const char* const* disabled; /* features */
  uint64_t limit_count;
  const vorpipe_limit* limits;
} vorpipe_session_options;

typedef struct vorpipe_device_info {
  uint32_t struct_size;
  int32_t usable; /* 0 or 1 */
  const char* backend;
  const char* name;
  const char* driver;
  const char* type;   /* "discrete", "integrated", "virtual", "cpu", "other" */
  const char* reason; /* why it cannot be used, and what would help; "" where it can */
} vorpipe_device_info;

/* Every backend with its devices; a backend without any has one entry that says why. */
typedef struct vorpipe_devices vorpipe_devices;
/* Of `options`, which may be NULL, `disabled` and `limits` count. */
VORPIPE_API vorpipe_code vorpipe_devices_find(const vorpipe_session_options* options,
                                              vorpipe_devices** devices);
VORPIPE_API void vorpipe_devices_free(vorpipe_devices* devices);
VORPIPE_API size_t vorpipe_devices_count(const vorpipe_devices* devices);
/* Writes as much of `info` as its struct_size says. Past the end: VORPIPE_INPUT. */
VORPIPE_API vorpipe_code vorpipe_devices_get(const vorpipe_devices* devices, size_t index,
                                             vorpipe_device_info* info);
/* Whether a device has a feature: 1, 0, or -1 where that is not known. */
VORPIPE_API int32_t vorpipe_devices_feature(const vorpipe_devices* devices, size_t index,
                                            const char* feature);
/* Writes a limit. VORPIPE_INPUT where it is not known. */
VORPIPE_API vorpipe_code vorpipe_devices_limit(const vorpipe_devices* devices, size_t index,
                                               const char* limit, uint64_t* value);

/* ---- Sessions ---- */

/* One backend, ready to work; opened once for many runs. Where its device refuses memory it is given less at
 * a time. Where it fails and the backend's name was "auto" or "vulkan", the next one takes over. */
typedef struct vorpipe_session vorpipe_session;
VORPIPE_API vorpipe_code vorpipe_session_open(const vorpipe_session_options* options,
                                              vorpipe_session** session);
VORPIPE_API void vorpipe_session_free(vorpipe_session* session);
/* The device in use. */
VORPIPE_API vorpipe_code vorpipe_session_device(const vorpipe_session* session, vorpipe_device_info* info);
/* Why this backend was taken; "" where the caller named it. */
VORPIPE_API const char* vorpipe_session_choice(const vorpipe_session* session);

/* ---- Input ---- */

/* Sites with their weights, the domain they have cells in, and a density over it. */
typedef struct vorpipe_input vorpipe_input;

/* The cell of site i is where |x - p_i|^2 - w_i is least. Strides are in bytes from one number to the next;
 * 0: the numbers follow each other. The numbers are copied. */
typedef struct vorpipe_sites {
  uint32_t struct_size;
  uint64_t count;
  const double* x;
  const double* y;
  const double* weight; /* NULL: all are equal */
  size_t position_stride;
  size_t weight_stride;
  const double* z; /* of sites in space, which vorpipe_cells alone takes; NULL: the plane */
} vorpipe_sites;

typedef int32_t vorpipe_axes;
enum { VORPIPE_PERIODIC_NONE = 0, VORPIPE_PERIODIC_X = 1, VORPIPE_PERIODIC_Y = 2, VORPIPE_PERIODIC_XY = 3 };

/* `count` points, x and y in turn. Ring r has the points ring_offsets[r] .. ring_offsets[r + 1] - 1, the
 * first of which is not repeated; polygon p has the rings polygon_offsets[p] .. polygon_offsets[p + 1] - 1,
 * its outer ring first, then its holes. Both tables have one number more than there are rings and polygons.
 */
typedef struct vorpipe_outline {
  uint32_t struct_size;
  uint64_t point_count, ring_count, polygon_count;
  const double* points;
  const uint64_t* ring_offsets;
  const uint64_t* polygon_offsets;
} vorpipe_outline;

/* Sites of the caller's; or of a file or generator, as the program's --sites names it: "stations.csv",
 * "random:1000" with `seed`. The domain is the box of the sites, grown on every side by 5 % of its longer
 * side; that of a generator is the unit square. Setting a box has a generator fill it: of lattices that may
 * be another number of sites. */
VORPIPE_API vorpipe_code vorpipe_input_create(const vorpipe_sites* sites, vorpipe_input** input);
VORPIPE_API vorpipe_code vorpipe_input_read(const char* sites, uint64_t seed, vorpipe_input** input);
VORPIPE_API void vorpipe_input_free(vorpipe_input* input);
/* Moves the sites, in the system that the input has; or replaces them by another number of sites. Without
 * weights they keep those that are set. Attributes and weights that are kept must be of this number. The
 * domain and whatever else is set stays; one that was not set is found anew, as that of the caller's sites.
 */
VORPIPE_API vorpipe_code vorpipe_input_set_sites(vorpipe_input* input, const vorpipe_sites* sites);
/* vorpipe_sites in floats; runs compute in double. */
typedef struct vorpipe_sites_float {
  uint32_t struct_size;
  uint64_t count;
  const float* x;
  const float* y;
  const float* weight;
  size_t position_stride;
  size_t weight_stride;
} vorpipe_sites_float;
VORPIPE_API vorpipe_code vorpipe_input_create_float(const vorpipe_sites_float* sites, vorpipe_input** input);
VORPIPE_API vorpipe_code vorpipe_input_set_sites_float(vorpipe_input* input,
                                                       const vorpipe_sites_float* sites);
VORPIPE_API uint64_t vorpipe_input_count(const vorpipe_input* input);

/* How a file with sites is read, where it does not say so itself. */
typedef struct vorpipe_read_options {
  uint32_t struct_size;
  int32_t skip_missing;       /* not 0: leaves out rows without a place or a weight, and counts them */
  uint64_t seed;              /* of a generator; 0: 1 */
  const char* format;         /* as VORPIPE_SITES_FORMATS; NULL: by the file's extension */
  const char* const* columns; /* x and y, or x, y and weight, by name or number; or one with points in WKT */
  uint32_t column_count;      /* 0: as the header says */
  int32_t keep_attributes;    /* not 0: for the files that are written of the cells */
  const char* layer;          /* of a GeoPackage; NULL: its only one with points */
} vorpipe_read_options;
/* `options` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_input_read_with(const char* sites, const vorpipe_read_options* options,
                                                 vorpipe_input** input);
/* Rows that were left out. */
VORPIPE_API uint64_t vorpipe_input_skipped(const vorpipe_input* input);
/* What was reinterpreted or changed, a line each, in the order in which it came to be: while sites were read,
 * and when their domain was found, by a run or vorpipe_input_domain. NULL past the end. */
VORPIPE_API const char* vorpipe_input_note(const vorpipe_input* input, size_t index);

/* Weights, one for each site; of the caller's, or out of a file. */
VORPIPE_API vorpipe_code vorpipe_input_set_weights(vorpipe_input* input, const double* weights,
                                                   uint64_t count);
VORPIPE_API vorpipe_code vorpipe_input_read_weights(vorpipe_input* input, const char* path);
/* Evenly distributed from `low` to `high`; the same seed gives the same on every platform. */
VORPIPE_API vorpipe_code vorpipe_input_random_weights(vorpipe_input* input, double low, double high,
                                                      uint64_t seed);
/* What cells are clipped to: a box, along the axes of which the domain may repeat itself; polygons, of the
 * caller's or out of a file (GeoJSON, WKT or GeoPackage), which are dissolved where they touch or overlap; or
 * the convex hull of the sites. What is set last counts. */
VORPIPE_API vorpipe_code vorpipe_input_set_box(vorpipe_input* input, double xmin, double ymin, double xmax,
                                               double ymax, vorpipe_axes periodic);
/* The domain of sites in space [their box, grown on every side by 5 % of its longest side]. */
VORPIPE_API vorpipe_code vorpipe_input_set_box3(vorpipe_input* input, double xmin, double ymin, double zmin,
                                                double xmax, double ymax, double zmax);
/* Not 0: that box repeats along the axis, and sites outside are images of sites inside. */
VORPIPE_API vorpipe_code vorpipe_input_set_periodic3(vorpipe_input* input, int32_t x, int32_t y, int32_t z);
/* Instead of a box: sites in space repeat by three vectors, 9 numbers. */
VORPIPE_API vorpipe_code vorpipe_input_set_lattice(vorpipe_input* input, const double* vectors);
VORPIPE_API vorpipe_code vorpipe_input_set_outline(vorpipe_input* input, const vorpipe_outline* outline);
VORPIPE_API vorpipe_code vorpipe_input_read_outline(vorpipe_input* input, const char* path);
VORPIPE_API vorpipe_code vorpipe_input_set_hull(vorpipe_input* input);
/* Mends polygons that cross themselves, which are refused otherwise; a note says what that changed. */
VORPIPE_API vorpipe_code vorpipe_input_repair_outline(vorpipe_input* input);
/* How much larger than the sites the box is that is not set, or the hull: 0 or more, in the unit of the
 * domain; or where `relative` is not 0, as a part of the longer side. */
VORPIPE_API vorpipe_code vorpipe_input_set_margin(vorpipe_input* input, double margin, int32_t relative);
/* Sites and domain are in degrees of longitude and latitude: makes cells in an equal-area plane around a
 * center, or with NAN, NAN amid the domain or the sites. Its unit is the kilometer, that of areas and
 * lengths; positions of diagrams come back in degrees, and a locator takes them. */
VORPIPE_API vorpipe_code vorpipe_input_project(vorpipe_input* input, double longitude, double latitude);
/* Sites are degrees of longitude and latitude of the whole Earth, which is the domain: cells are those on the
 * sphere, areas square kilometers on the ellipsoid, lengths kilometers. Of cells alone. */
VORPIPE_API vorpipe_code vorpipe_input_set_globe(vorpipe_input* input);
/* What lies around cells. */
typedef int32_t vorpipe_surface;
enum {
  VORPIPE_SURFACE_NONE = 0, /* cells fill the domain */
  VORPIPE_SURFACE_FREE = 1  /* air does: each cell ends at a disc around its site, whose squared radius is
                             * the weight */
};
/* What cells, pictures and locators of this input have around them; of fluids as well. A free surface takes
 * no outline, period or density yet. Cells have polygons in place of arcs, whose edges belong to
 * VORPIPE_WALL_OUTLINE, and no triangles; VORPIPE_BORDER_PARTS has the arcs. */
VORPIPE_API vorpipe_code vorpipe_input_set_surface(vorpipe_input* input, vorpipe_surface surface);
/* Writes xmin, ymin, xmax and ymax of the domain as runs have it, in the plane of a projection, and refuses
 * what they would. */
VORPIPE_API vorpipe_code vorpipe_input_domain(const vorpipe_input* input, double* box);

/* What coordinates are: for the files that are written of them, and to refuse an outline in another system
 * than that of the sites. */
typedef int32_t vorpipe_system_kind;
enum { VORPIPE_SYSTEM_UNKNOWN = 0, VORPIPE_SYSTEM_DEGREES = 1, VORPIPE_SYSTEM_PLANE = 2 };
/* `epsg` is the number of a coordinate system of EPSG's; 0: none, of degrees WGS 84. */
VORPIPE_API vorpipe_code vorpipe_input_set_system(vorpipe_input* input, vorpipe_system_kind kind,
                                                  int64_t epsg);
/* The same by name: "EPSG:25832", "OGC:CRS84", or a definition in WKT. */
VORPIPE_API vorpipe_code vorpipe_input_name_system(vorpipe_input* input, const char* name);
/* The system of the outline that is set; of a file that names its own it is known. */
VORPIPE_API vorpipe_code vorpipe_input_name_outline_system(vorpipe_input* input, const char* name);
/* As it is set or was read. */
VORPIPE_API vorpipe_code vorpipe_input_system(const vorpipe_input* input, vorpipe_system_kind* kind,
                                              int64_t* epsg);
/* A density, constant in each of width x height pixels, the top row first; or a picture (dark is dense) or
 * array. */
VORPIPE_API vorpipe_code vorpipe_input_set_density(vorpipe_input* input, const double* values, int32_t width,
                                                   int32_t height);
VORPIPE_API vorpipe_code vorpipe_input_read_density(vorpipe_input* input, const char* path);
/* Where the pixels of the density that is set lie, in the unit of the domain as runs have it; beyond it there
 * is nothing. Else they are where a world file or GDAL's .aux.xml beside the density's says, or cover the
 * domain. */
VORPIPE_API vorpipe_code vorpipe_input_set_density_box(vorpipe_input* input, double xmin, double ymin,
                                                       double xmax, double ymax);

/* ---- Attributes ---- */

/* How values of an attribute read. */
typedef int32_t vorpipe_attribute_type;
enum {
  VORPIPE_INFERRED = 0, /* the narrowest of the first three that all values are, else text */
  VORPIPE_INTEGER = 1,  /* of 64 bits with a sign, written as in JSON */
  VORPIPE_REAL = 2,     /* written as in JSON */
  VORPIPE_BOOLEAN = 3,  /* "true", "false" */
  VORPIPE_TEXT = 4,
  VORPIPE_JSON = 5 /* in one line */
};

/* UTF-8 without a zero at its end; data is NULL where a value is missing. */
typedef struct vorpipe_text {
  const char* data;
  uint64_t size;
} vorpipe_text;

/* What else is known of sites, such as their names: a value for each, in columns. Files of cells that have
 * attributes get them: .csv, .geojson, .geojsonl and .gpkg. */
VORPIPE_API size_t vorpipe_input_attribute_count(const vorpipe_input* input);
/* NULL and 0 past the end. */
VORPIPE_API const char* vorpipe_input_attribute_name(const vorpipe_input* input, size_t attribute);
VORPIPE_API vorpipe_attribute_type vorpipe_input_attribute_type(const vorpipe_input* input, size_t attribute);
/* Writes the value of a site, which belongs to the input. */
VORPIPE_API vorpipe_code vorpipe_input_attribute(const vorpipe_input* input, size_t attribute, uint64_t site,
                                                 vorpipe_text* value);
/* Adds a column of `count` values, one for each site, which are copied. */
VORPIPE_API vorpipe_code vorpipe_input_add_attribute(vorpipe_input* input, const char* name,
                                                     vorpipe_attribute_type type, const vorpipe_text* values,
                                                     uint64_t count);

/* ---- Arrays ---- */

typedef int32_t vorpipe_type;
enum {
  VORPIPE_UINT8 = 1,
  VORPIPE_INT32 = 2,
  VORPIPE_UINT32 = 3,
  VORPIPE_INT64 = 4,
  VORPIPE_UINT64 = 5,
  VORPIPE_DOUBLE = 6,
  VORPIPE_FLOAT = 7
};

/* `count` rows of `columns` numbers of one type, without gaps. */
typedef struct vorpipe_array {
  const void* data; /* NULL where count is 0 */
  uint64_t count;
  vorpipe_type type;
  int32_t columns;
} vorpipe_array;

/* ---- Cells ---- */

typedef int32_t vorpipe_search;
enum { VORPIPE_SEARCH_GRID = 0, VORPIPE_SEARCH_FLANN = 1 };

typedef int32_t vorpipe_detail;
enum {
  VORPIPE_EVERYTHING = 0, /* all that follows, and triangles */
  VORPIPE_MEASURES = 1,   /* status, owner, area, centroid, offsets, neighbors, mass */
  VORPIPE_POLYGONS = 2    /* and perimeter, second moments, vertices, edge lengths */
};

typedef struct vorpipe_cells_options {
  uint32_t struct_size;
  vorpipe_detail detail;
  vorpipe_search search;
  int32_t search_neighbors; /* FLANN's first k; 0: 30 */
  vorpipe_progress progress;
  void* progress_user;
} vorpipe_cells_options;

/* Cells, in the order of the sites: one for each of them, whatever happened to it. */
typedef struct vorpipe_diagram vorpipe_diagram;
/* `options` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_cells(vorpipe_session* session, const vorpipe_input* input,
                                       const vorpipe_cells_options* options, vorpipe_diagram** diagram);
VORPIPE_API void vorpipe_diagram_free(vorpipe_diagram* diagram);

/* What became of a site. */
enum { VORPIPE_OK = 0, VORPIPE_EMPTY = 1, VORPIPE_DUPLICATE = 2 };

/* In neighbors: walls of the domain, and its outline. Others are sites. */
enum {
  VORPIPE_WALL_XMIN = -1,
  VORPIPE_WALL_XMAX = -2,
  VORPIPE_WALL_YMIN = -3,
  VORPIPE_WALL_YMAX = -4,
  VORPIPE_WALL_OUTLINE = -5,
  VORPIPE_WALL_ZMIN = -6,
  VORPIPE_WALL_ZMAX = -7
};

/* Cell i has the vertices offsets[i] .. offsets[i + 1] - 1, counter-clockwise; edge k of a cell runs from its
 * vertex k to the next and belongs to its neighbor k: one table of offsets serves vertices, neighbors and
 * edge lengths. docs/guide.md says what ties, holes and periodic cells are. */
typedef int32_t vorpipe_diagram_field;
enum {
  VORPIPE_CELL_STATUS = 1,    /* by site: uint8 */
  VORPIPE_CELL_OWNER = 2,     /* by site: uint32, the site that owns its cell: itself but for duplicates */
  VORPIPE_CELL_AREA = 3,      /* by site: double */
  VORPIPE_CELL_PERIMETER = 4, /* by site: double */
  VORPIPE_CELL_CENTROID = 5,  /* by site: 2 doubles; the site itself where there is no cell */
  VORPIPE_CELL_SECOND_MOMENTS = 6, /* by site: 3 doubles, xx, xy and yy about the centroid */
  VORPIPE_CELL_OFFSETS = 7,        /* by site, and one more: uint64 */
  VORPIPE_CELL_VERTICES = 8,       /* 2 doubles */
  VORPIPE_CELL_NEIGHBORS = 9,      /* int64: sites, or walls */
  VORPIPE_CELL_EDGE_LENGTHS = 10,  /* double */
  VORPIPE_CELL_NEIGHBOR_SHIFTS =
      11,                          /* 2 int32: periods from the neighbor to its image; of periodic domains */
  VORPIPE_CELL_RING_STARTS = 12,   /* uint64: where rings begin in vertices; of domains with an outline */
  VORPIPE_CELL_MASS = 13,          /* by site: double; with a density */
  VORPIPE_CELL_MASS_CENTROID = 14, /* by site: 2 doubles; with a density */
  VORPIPE_TRIANGLES = 15,          /* 3 uint32: the Delaunay or regular triangulation of the sites */
  /* What cells share, found when first asked for. An entry is an index into vertices, neighbors and edge
   * lengths. Of VORPIPE_EVERYTHING and VORPIPE_POLYGONS. */
  VORPIPE_SHARED_VERTICES = 16, /* 2 doubles: each vertex once */
  VORPIPE_VERTEX_OF = 17,       /* by entry: uint32, its shared vertex */
  VORPIPE_EDGE_OF = 18,         /* by entry: uint32, its edge */
  VORPIPE_EDGE_ENTRY = 19,      /* by edge: uint64, its first entry */
  VORPIPE_EDGE_VERTICES = 20,   /* by edge: 2 uint32, shared vertices */
  VORPIPE_EDGE_CELLS = 21,      /* by edge: 2 int64, sites; the second may be a wall */
  /* Of a free surface: the lines around cells, counter-clockwise, found when first asked for. */
  VORPIPE_BORDER_OFFSETS = 22, /* by site, and one more: uint64, where the parts of its border begin */
  VORPIPE_BORDER_PARTS = 23,   /* 5 doubles: from and to; the angle of an arc around the site, 0: straight */
  VORPIPE_BORDER_NEIGHBORS = 24, /* by part: int64, as VORPIPE_CELL_NEIGHBORS */
  /* Cells as indexed triangles for a GPU, found when first asked for: each vertex belongs to one cell. Of
   * VORPIPE_EVERYTHING and VORPIPE_POLYGONS. */
  VORPIPE_MESH_VERTICES = 25,    /* 2 floats: VORPIPE_CELL_VERTICES, rounded */
  VORPIPE_MESH_SITES = 26,       /* by vertex: uint32 */
  VORPIPE_MESH_TRIANGLES = 27,   /* 3 uint32: vertices, counter-clockwise, cell after cell */
  VORPIPE_CELL_SOLID_ANGLE = 28, /* by site: double, steradians; of the globe */
  /* Of cells in space. VORPIPE_CELL_OFFSETS says where the faces of a cell begin, in ascending order of
   * VORPIPE_CELL_NEIGHBORS; VORPIPE_CELL_CENTROID has 3 doubles, VORPIPE_CELL_SECOND_MOMENTS 6: xx, yy, zz,
   * yz, xz and xy. From VORPIPE_FACE_OFFSETS on not of VORPIPE_MEASURES. docs/space.md says what ties are. */
  VORPIPE_CELL_VOLUME = 29,         /* by site: double */
  VORPIPE_CELL_SURFACE = 30,        /* by site: double, its area */
  VORPIPE_FACE_AREA = 31,           /* by face: double */
  VORPIPE_FACE_OFFSETS = 32,        /* by face, and one more: uint64, where its vertices begin */
  VORPIPE_FACE_VERTICES = 33,       /* uint32: vertices around faces, counter-clockwise seen from outside */
  VORPIPE_SPACE_VERTICES = 34,      /* 3 doubles: each vertex once */
  VORPIPE_VERTEX_SITE_OFFSETS = 35, /* by vertex, and one more: uint64 */
  VORPIPE_VERTEX_SITES = 36,        /* int64: the sites and walls that meet in each vertex */
  /* 3 int32: sides of the box, or vectors of the lattice, from the neighbor to its image; of sites that
   * repeat, whose faces with one neighbor ascend by these */
  VORPIPE_FACE_SHIFTS = 37
};

/* Writes an array of the diagram, which it keeps. One that this diagram does not have is empty. */
VORPIPE_API vorpipe_code vorpipe_diagram_array(const vorpipe_diagram* diagram, vorpipe_diagram_field field,
                                               vorpipe_array* array);
VORPIPE_API double vorpipe_diagram_area_sum(const vorpipe_diagram* diagram);
/* 3 of cells in space; what is of the plane alone then ends with VORPIPE_INPUT. */
VORPIPE_API int32_t vorpipe_diagram_dimension(const vorpipe_diagram* diagram);
VORPIPE_API double vorpipe_diagram_volume_sum(const vorpipe_diagram* diagram);

/* Verifies what is promised about cells, with nothing of what computes them. VORPIPE_DIFFERENT: a promise is
 * broken; the last error names the first, and `broken`, which may be NULL, gets each in a line of its own. */
VORPIPE_API vorpipe_code vorpipe_diagram_check(const vorpipe_diagram* diagram, int32_t threads,
                                               vorpipe_write broken, void* user);

/* Writes a file: to the caller, of a format by its name; or to a path, by its extension, whole or not at all.
 */
VORPIPE_API vorpipe_code vorpipe_diagram_write(const vorpipe_diagram* diagram, const char* format,
                                               vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_diagram_save(const vorpipe_diagram* diagram, const char* path);
typedef struct vorpipe_write_options {
  uint32_t struct_size;
  int32_t only_cells; /* not 0: leaves out sites without a cell, in files of features */
} vorpipe_write_options;
/* The same; `options` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_diagram_write_with(const vorpipe_diagram* diagram, const char* format,
                                                    const vorpipe_write_options* options, vorpipe_write write,
                                                    void* user);
VORPIPE_API vorpipe_code vorpipe_diagram_save_with(const vorpipe_diagram* diagram, const char* path,
                                                   const vorpipe_write_options* options);
/* The edges of cells as lines, each once, with its two sites and its length. Formats: VORPIPE_EDGES_FORMATS.
 */
VORPIPE_API vorpipe_code vorpipe_diagram_write_edges(const vorpipe_diagram* diagram, const char* format,
                                                     vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_diagram_save_edges(const vorpipe_diagram* diagram, const char* path);

/* How cells of two diagrams of the same sites and domain differ. */
typedef struct vorpipe_cells_difference {
  uint32_t struct_size;
  uint32_t worst_site;                        /* whose areas differ most, by what is allowed */
  uint64_t equal, statuses, neighbors, areas; /* sites */
  double worst_area;                          /* as a part of what is allowed */
} vorpipe_cells_difference;
/* VORPIPE_DIFFERENT where they do not agree. `difference` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_diagrams_compare(const vorpipe_diagram* a, const vorpipe_diagram* b,
                                                  vorpipe_cells_difference* difference);

/* ---- Places ---- */

/* Where a place or a pixel has none. */
#define VORPIPE_NO_SITE 0xFFFFFFFFu

/* Finds the sites in whose cells places lie, without the cells. May be used by several threads at a time. */
typedef struct vorpipe_locator vorpipe_locator;
VORPIPE_API vorpipe_code vorpipe_locator_create(const vorpipe_input* input, int32_t threads,
                                                vorpipe_locator** locator);
VORPIPE_API void vorpipe_locator_free(vorpipe_locator* locator);
/* `places` are `count` pairs of x and y; `sites` gets as many, VORPIPE_NO_SITE where a place is not in the
 * domain. */
VORPIPE_API vorpipe_code vorpipe_locator_find(const vorpipe_locator* locator, const double* places,
                                              uint64_t count, uint32_t* sites);

/* ---- Pictures ---- */

typedef int32_t vorpipe_color;
enum { VORPIPE_BY_SITE = 0, VORPIPE_BY_AREA = 1, VORPIPE_BY_NEIGHBORS = 2, VORPIPE_BY_WEIGHT = 3 };

/* How values become colors. */
typedef int32_t vorpipe_color_scale;
enum {
  VORPIPE_SCALE_AUTOMATIC = 0, /* quantiles by area and by weight, linear by neighbors */
  VORPIPE_SCALE_LINEAR = 1,
  VORPIPE_SCALE_LOG = 2,
  VORPIPE_SCALE_QUANTILE = 3 /* as many cells have one color as another */
};

/* What becomes of a domain in a picture of another aspect. */
typedef int32_t vorpipe_fit;
enum {
  VORPIPE_FIT_AUTOMATIC = 0, /* letterbox where sites are of a file or there is an outline, else stretch */
  VORPIPE_FIT_STRETCH = 1,   /* it fills the picture */
  VORPIPE_FIT_LETTERBOX = 2  /* it keeps its aspect, in the middle; pixels beside it have no site */
};

/* Flat maps of the globe, from 180 degrees west to 180 degrees east. */
typedef int32_t vorpipe_map;
enum {
  VORPIPE_MAP_PLATE_CARREE = 0, /* longitude and latitude, in degrees */
  VORPIPE_MAP_EQUAL_EARTH = 1   /* areas are true; meters, as EPSG:8857 */
};

typedef struct vorpipe_render_options {
  uint32_t struct_size;
  int32_t width, height; /* pixels, 1 to 32768; both 0: the longer side is 1000 */
  vorpipe_color color;
  const char* colormap; /* NULL: "viridis" */
  int32_t edges;        /* not 0: darkens pixels beside which another cell begins */
  int32_t show_sites;   /* not 0: a dot at each site */
  vorpipe_search search;
  int32_t search_neighbors;
  vorpipe_progress progress;
  void* progress_user;
  vorpipe_color_scale color_scale;
  int32_t has_range; /* not 0: these values have the first and the last color, as have those beyond */
  double range_low, range_high; /* 0 otherwise: the least and the greatest value */
  int32_t legend;               /* not 0: draws in a corner what colors stand for */
  vorpipe_fit fit;
  double edge_width; /* of edges and of the dual: pixels, 1 to 100; 0: 1 */
  double dot_size;   /* of a site, across, pixels up to 100; 0: by the spacing of sites */
  int32_t antialias; /* pixels have the mean color of as many rows and columns of places, 1 to 8; 0: 1 */
  int32_t dual;      /* not 0: lines between sites whose cells have a common edge */
  int32_t labels;    /* not 0: the index of each site, where there is room for it */
  int32_t no_fill;   /* not 0: cells are white */
  double label_size; /* the height of digits, pixels, 5 to 200; 0: 10 */
  int32_t has_view;  /* not 0: the picture shows this part of the plane; colors are as they are without */
  double view_xmin, view_ymin, view_xmax, view_ymax; /* 0 otherwise */
  const char* edge_color; /* of edges: "#rgb", "#rrggbb" or a name of CSS; NULL: "#181818" */
  const char* background; /* of what is no cell, and of cells with no_fill; may be "#rrggbbaa"; NULL:
                             transparent, and white cells */
  vorpipe_map map; /* of an input on the globe; its view is in the map's unit, and it keeps its aspect */
  int32_t has_view_from; /* not 0: the globe as seen from far above this place, in place of a map */
  double view_from_longitude, view_from_latitude; /* degrees */
  double graticule; /* degrees between meridians, and between parallels, on the globe: 0.1 to 90; 0: none */
} vorpipe_render_options;

typedef struct vorpipe_picture vorpipe_picture;
VORPIPE_API vorpipe_code vorpipe_render(vorpipe_session* session, const vorpipe_input* input,
                                        const vorpipe_render_options* options, vorpipe_picture** picture);
/* Reads a PNG, which has pixels, or ids out of an .npy, which has ids, and nothing else. */
VORPIPE_API vorpipe_code vorpipe_picture_read(const char* path, vorpipe_picture** picture);
VORPIPE_API void vorpipe_picture_free(vorpipe_picture* picture);

/* Rows of pixels, the top one first. */
typedef int32_t vorpipe_picture_field;
enum {
  VORPIPE_PICTURE_RGBA = 1,   /* by row: 4 x width uint8 */
  VORPIPE_PICTURE_IDS = 2,    /* by row: width uint32, the site of each pixel, or VORPIPE_NO_SITE */
  VORPIPE_PICTURE_STATUS = 3, /* by site: uint8 */
  VORPIPE_PICTURE_OWNER = 4   /* by site: uint32 */
};
VORPIPE_API vorpipe_code vorpipe_picture_array(const vorpipe_picture* picture, vorpipe_picture_field field,
                                               vorpipe_array* array);
VORPIPE_API int32_t vorpipe_picture_width(const vorpipe_picture* picture);
VORPIPE_API int32_t vorpipe_picture_height(const vorpipe_picture* picture);

/* What colors stand for. */
typedef struct vorpipe_color_key {
  uint32_t struct_size;
  vorpipe_color color; /* VORPIPE_BY_SITE: for nothing, and there are no ticks */
  vorpipe_color_scale scale;
  double low, high;    /* of the first and the last color */
  vorpipe_array ticks; /* 2 doubles: a place along the colors, in [0, 1], and its value; 1 if all are equal */
} vorpipe_color_key;
VORPIPE_API vorpipe_code vorpipe_picture_key(const vorpipe_picture* picture, vorpipe_color_key* key);

/* As vorpipe_diagram_check. */
VORPIPE_API vorpipe_code vorpipe_picture_check(const vorpipe_picture* picture, int32_t threads,
                                               vorpipe_write broken, void* user);
/* Formats: "png", the pixels; "npy" and "tif", the ids, with their place in GeoTIFF; "pgw", the place of the
 * pixels of a PNG, as a world file. */
VORPIPE_API vorpipe_code vorpipe_picture_write(const vorpipe_picture* picture, const char* format,
                                               vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_picture_save(const vorpipe_picture* picture, const char* path);
/* The same picture as shapes. Formats: "svg", "pdf". */
VORPIPE_API vorpipe_code vorpipe_draw(vorpipe_session* session, const vorpipe_input* input,
                                      const vorpipe_render_options* options, const char* format,
                                      vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_draw_save(vorpipe_session* session, const vorpipe_input* input,
                                           const vorpipe_render_options* options, const char* path);

typedef struct vorpipe_picture_difference {
  uint32_t struct_size;
  uint32_t largest;            /* of pixels' colors, where ids were not compared: 0 to 255 */
  uint64_t equal, ties, wrong; /* pixels */
  uint64_t ties_allowed; /* what is within 1/128 of a pixel of the cells' boundaries may go to either cell */
  double widest_tie;     /* in pixels */
} vorpipe_picture_difference;
/* Compares ids where both have them, by the sites of one that was drawn; else the pixels, where any
 * difference counts. VORPIPE_DIFFERENT where they do not agree. `difference` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_pictures_compare(const vorpipe_picture* a, const vorpipe_picture* b,
                                                  vorpipe_picture_difference* difference);

/* ---- Reports ---- */

/* What a run did. Times are in milliseconds, negative where a stage does not apply. */
typedef struct vorpipe_report {
  uint32_t struct_size;
  uint32_t note_count; /* what did not go as it began: vorpipe_diagram_note, vorpipe_picture_note */
  const char* backend;
  const char* device;
  const char* driver;
  uint64_t ok, empty, duplicate;              /* sites, by what became of them */
  uint64_t hidden;                            /* of the empty: by others that are heavier */
  uint64_t retried, in_double, exact, pixels; /* how often cells and pixels were asked for again */
  double order_ms, upload_ms, search_ms, cells_ms, draw_ms, download_ms;
  uint64_t validation_count; /* messages of Vulkan's validation layers: any is a fault */
} vorpipe_report;
VORPIPE_API vorpipe_code vorpipe_diagram_report(const vorpipe_diagram* diagram, vorpipe_report* report);
VORPIPE_API vorpipe_code vorpipe_picture_report(const vorpipe_picture* picture, vorpipe_report* report);
/* NULL past the end. */
VORPIPE_API const char* vorpipe_diagram_note(const vorpipe_diagram* diagram, size_t index);
VORPIPE_API const char* vorpipe_picture_note(const vorpipe_picture* picture, size_t index);
VORPIPE_API const char* vorpipe_diagram_validation(const vorpipe_diagram* diagram, size_t index);
VORPIPE_API const char* vorpipe_picture_validation(const vorpipe_picture* picture, size_t index);

/* ---- Relaxation ---- */

/* How sites move. */
typedef int32_t vorpipe_relax_method;
enum {
  VORPIPE_RELAX_LBFGS = 0, /* accelerated: as far after 35 diagrams as Lloyd's steps after 200 */
  VORPIPE_RELAX_LLOYD = 1  /* each to the centroid of its cell */
};

typedef struct vorpipe_relax_options {
  uint32_t struct_size;
  vorpipe_relax_method method;
  uint64_t iterations;  /* the most diagrams after the first; 0: 50 */
  double tolerance;     /* ends when no site would move by this part of the spacing; 0: never */
  int32_t equal_masses; /* not 0: relaxes under the square of the density, so that cells get equal masses */
  vorpipe_search search;
  int32_t search_neighbors;
  vorpipe_progress progress; /* of each diagram; saying stop ends the relaxation with what was reached */
  void* progress_user;
} vorpipe_relax_options;

/* Sites that move until each is the centroid of its cell: under the input's density, in its domain. The
 * session outlives it. */
typedef struct vorpipe_relaxation vorpipe_relaxation;
/* Computes the first diagram. `options` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_relax_begin(vorpipe_session* session, const vorpipe_input* input,
                                             const vorpipe_relax_options* options,
                                             vorpipe_relaxation** relaxation);
/* Computes the next one. `more`, which may be NULL, gets whether there was one: 0 at the end. */
VORPIPE_API vorpipe_code vorpipe_relaxation_step(vorpipe_relaxation* relaxation, int32_t* more);
/* All of them. */
VORPIPE_API vorpipe_code vorpipe_relax(vorpipe_session* session, const vorpipe_input* input,
                                       const vorpipe_relax_options* options, vorpipe_relaxation** relaxation);
VORPIPE_API void vorpipe_relaxation_free(vorpipe_relaxation* relaxation);

typedef int32_t vorpipe_relaxation_field;
enum {
  VORPIPE_RELAXED_SITES = 1, /* by site: 2 doubles, in degrees where the input is projected */
  /* by diagram: 5 doubles: its number, the energy, that as a part of the hexagonal lattice's (NaN with
   * weights), the longest way of a site in spacings, seconds since the first */
  VORPIPE_RELAXED_TRACE = 2,
  /* by diagram: a byte; 0: its energy was too high, and the sites went back to where they were before */
  VORPIPE_RELAXED_TAKEN = 3
};
/* Good until the next step. */
VORPIPE_API vorpipe_code vorpipe_relaxation_array(const vorpipe_relaxation* relaxation,
                                                  vorpipe_relaxation_field field, vorpipe_array* array);

/* Why a relaxation ended. */
typedef int32_t vorpipe_relax_end;
enum {
  VORPIPE_RELAX_ITERATIONS = 0,
  VORPIPE_RELAX_TOLERANCE = 1,
  VORPIPE_RELAX_STAGNATED = 2, /* nothing was left to gain but rounding */
  VORPIPE_RELAX_CANCELLED = 3
};
VORPIPE_API vorpipe_relax_end vorpipe_relaxation_end(const vorpipe_relaxation* relaxation);
/* Of the last diagram. */
VORPIPE_API vorpipe_code vorpipe_relaxation_report(const vorpipe_relaxation* relaxation,
                                                   vorpipe_report* report);
VORPIPE_API const char* vorpipe_relaxation_note(const vorpipe_relaxation* relaxation, size_t index);
/* The sites where they are, as an input: same domain, weights, density and attributes. The domain stays until
 * another one, a margin or a projection is set. For the caller to free. */
VORPIPE_API vorpipe_code vorpipe_relaxation_input(const vorpipe_relaxation* relaxation,
                                                  vorpipe_input** input);
/* The sites as a file that sites are read from: "csv", "txt", "npy", "geojson", "geojsonl", "gpkg" or "wkt".
 */
VORPIPE_API vorpipe_code vorpipe_relaxation_write(const vorpipe_relaxation* relaxation, const char* format,
                                                  vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_relaxation_save(const vorpipe_relaxation* relaxation, const char* path);

/* ---- Transport ---- */

/* One diagram of a transport. */
typedef struct vorpipe_transport_step {
  uint32_t struct_size;
  int32_t taken; /* 0: it was not kept, and the Newton step is tried again, half as long */
  uint64_t diagram, newton, linear_iterations;
  double length;             /* part of the Newton step that was tried, up to 1 */
  double norm, worst, least; /* root of the sum of squared differences; largest difference, and least mass, as
                              * parts of the mass asked for; NaN: a cell was empty */
  double seconds;
} vorpipe_transport_step;

/* Called after each diagram, from the calling thread; what is not 0 ends the transport with what was reached.
 */
typedef int32_t (*vorpipe_transport_watch)(void* user, const vorpipe_transport_step* step);

typedef struct vorpipe_transport_options {
  uint32_t struct_size;
  int32_t normalize;    /* not 0: scales the masses so that they add up to what the domain has */
  const double* masses; /* by site, each more than 0; NULL: equal ones */
  uint64_t mass_count;
  double fill;      /* a free surface, and this part of what the domain has for all cells; 0: cells fill it */
  double tolerance; /* ends when no cell differs from its mass by more than this part of it; 0: 1e-8 */
  uint64_t diagrams; /* the most that are computed; 0: 400 */
  vorpipe_surface surface;
  vorpipe_search search;
  int32_t search_neighbors;
  vorpipe_transport_watch watch;
  void* watch_user;
  vorpipe_progress progress; /* of each diagram; saying stop ends the transport with what was reached */
  void* progress_user;
} vorpipe_transport_options;

/* The weights that give each cell its mass: its area, or what the input's density has in it. They begin with
 * the input's weights, where these leave each cell some. */
typedef struct vorpipe_transported vorpipe_transported;
/* `options` may be NULL. VORPIPE_DONE where the tolerance was not reached as well: see
 * vorpipe_transported_end. */
VORPIPE_API vorpipe_code vorpipe_transport(vorpipe_session* session, const vorpipe_input* input,
                                           const vorpipe_transport_options* options,
                                           vorpipe_transported** transported);
VORPIPE_API void vorpipe_transported_free(vorpipe_transported* transported);

typedef int32_t vorpipe_transported_field;
enum {
  VORPIPE_TRANSPORTED_WEIGHTS = 1, /* by site: double */
  VORPIPE_TRANSPORTED_MASSES = 2,  /* by site: double, what the cells have; none where nothing was measured */
  VORPIPE_TRANSPORTED_AREAS = 3,   /* likewise */
  VORPIPE_TRANSPORTED_CENTROIDS = 4, /* likewise: 2 doubles, of the mass; in degrees where the input is
                                      * projected */
  VORPIPE_TRANSPORTED_STATUS = 5,    /* likewise: uint8 */
  /* by diagram: 9 doubles: diagram, newton, length, taken, norm, worst, least, linear_iterations, seconds, as
   * in vorpipe_transport_step */
  VORPIPE_TRANSPORTED_TRACE = 6
};
VORPIPE_API vorpipe_code vorpipe_transported_array(const vorpipe_transported* transported,
                                                   vorpipe_transported_field field, vorpipe_array* array);

/* Why a transport ended. */
typedef int32_t vorpipe_transport_end;
enum {
  VORPIPE_TRANSPORT_CONVERGED = 0,
  VORPIPE_TRANSPORT_STAGNATED = 1, /* at what rounding allows */
  VORPIPE_TRANSPORT_DIAGRAMS = 2,
  VORPIPE_TRANSPORT_CANCELLED = 3
};
VORPIPE_API vorpipe_transport_end vorpipe_transported_end(const vorpipe_transported* transported);
/* The integral of the squared distance to the site over all cells: the squared Wasserstein distance between
 * the density and the sites' masses. */
VORPIPE_API double vorpipe_transported_cost(const vorpipe_transported* transported);
/* Of the last diagram. */
VORPIPE_API vorpipe_code vorpipe_transported_report(const vorpipe_transported* transported,
                                                    vorpipe_report* report);
VORPIPE_API const char* vorpipe_transported_note(const vorpipe_transported* transported, size_t index);
/* The sites with these weights, as an input of the same surface: for cells and pictures, or to save. For the
 * caller to free. */
VORPIPE_API vorpipe_code vorpipe_transported_input(const vorpipe_transported* transported,
                                                   vorpipe_input** input);
/* As vorpipe_relaxation_write and vorpipe_relaxation_save: the sites with these weights. */
VORPIPE_API vorpipe_code vorpipe_transported_write(const vorpipe_transported* transported, const char* format,
                                                   vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_transported_save(const vorpipe_transported* transported, const char* path);

/* ---- Fluids ---- */

/* How velocities come to be those of a fluid that cannot be compressed. */
typedef int32_t vorpipe_fluid_scheme;
enum {
  VORPIPE_FLUID_USUAL = 0, /* as a case or a file has it, else springs with a free surface, and projection */
  VORPIPE_FLUID_SPRINGS = 1,   /* springs pull each site to the centroid of its cell */
  VORPIPE_FLUID_PROJECTION = 2 /* velocities change no area, by a pressure; for domains that are full */
};

/* What a viscous fluid does at walls. */
typedef int32_t vorpipe_fluid_walls;
enum {
  VORPIPE_WALLS_USUAL = 0, /* as a case or a file has it, else slip */
  VORPIPE_WALLS_SLIP = 1,
  VORPIPE_WALLS_NO_SLIP = 2 /* it sticks to them; for domains that are full */
};

typedef struct vorpipe_fluid_options {
  uint32_t struct_size;
  vorpipe_fluid_scheme scheme;
  double step;       /* of time; 0: as a case or a file has it, else as long as speeds and springs allow */
  double epsilon;    /* a time: springs swing in 2 pi of it; 0: likewise, else 2 spacings over a usual speed,
                      * 3 with a free surface */
  double until;      /* time at which it ends, with a shorter step; 0: likewise, else never */
  double tolerance;  /* no area differs from its volume by more than this part; 0: likewise, else 1e-6 */
  uint64_t diagrams; /* the most for each set of areas; 0: likewise, else 100 */
  double gravity_x, gravity_y;
  int32_t has_gravity; /* 0: gravity is as a case or a file has it, else none */
  vorpipe_search search;
  int32_t search_neighbors;
  uint64_t count;            /* of the sites that the next three have numbers for; each may be NULL */
  const double* velocities;  /* x and y in turn; NULL: at rest */
  const double* volumes;     /* areas of cells, each more than 0; NULL: equal shares of the domain */
  const double* densities;   /* masses per volume; NULL: 1 */
  vorpipe_progress progress; /* of each diagram; saying stop ends the step, as if it had not begun */
  void* progress_user;
  double viscosity; /* kinematic, area per time; 0: as a case or a file has it, else none */
  vorpipe_fluid_walls walls;
  double centering; /* rate, per time, at which sites move to their centroids by projection; 0: likewise */
} vorpipe_fluid_options;

/* What a step has come to. */
typedef struct vorpipe_fluid_figures {
  uint32_t struct_size;
  uint32_t halvings; /* steps were halved so often, since areas could not be found */
  uint64_t step;
  double time, length;                       /* length: of the step */
  double kinetic, potential, spring, energy; /* energy: their sum */
  double momentum_x, momentum_y;
  double worst;    /* largest |area - volume| / volume */
  double farthest; /* largest distance of a site to its centroid, in spacings */
  uint64_t diagrams, linear_iterations;
  double seconds; /* since it began */
} vorpipe_fluid_figures;

/* Why a fluid ended. */
typedef int32_t vorpipe_fluid_end;
enum {
  VORPIPE_FLUID_GOES_ON = 0,
  VORPIPE_FLUID_TIME = 1,
  VORPIPE_FLUID_AREAS = 2, /* they could not be found even for short steps */
  VORPIPE_FLUID_CANCELLED = 3
};

/* A fluid whose parcels are cells that keep their areas. The session outlives it. */
typedef struct vorpipe_fluid vorpipe_fluid;
/* Of the sites, weights, box, outline, period and surface of an input, which has no projection or density.
 * A free surface asks for volumes. `options` may be NULL. */
VORPIPE_API vorpipe_code vorpipe_fluid_begin(vorpipe_session* session, const vorpipe_input* input,
                                             const vorpipe_fluid_options* options, vorpipe_fluid** fluid);
/* A case of VORPIPE_FLUID_CASES with about `parcels` cells, 0: its usual number; or an .npz file, of which
 * vorpipe_fluid_save and `vorpipe fluid --checkpoint` write the kind. Options that are not zero replace those
 * that it has. */
VORPIPE_API vorpipe_code vorpipe_fluid_read(vorpipe_session* session, const char* name, uint64_t parcels,
                                            const vorpipe_fluid_options* options, vorpipe_fluid** fluid);
VORPIPE_API void vorpipe_fluid_free(vorpipe_fluid* fluid);
/* Makes a step. `figures` gets what it has come to, `more` whether there was one: 0 at the end. Both may be
 * NULL. */
VORPIPE_API vorpipe_code vorpipe_fluid_step(vorpipe_fluid* fluid, vorpipe_fluid_figures* figures,
                                            int32_t* more);

/* Called after each step, from the calling thread; what is not 0 ends the run. */
typedef int32_t (*vorpipe_fluid_watch)(void* user, const vorpipe_fluid_figures* figures);
typedef struct vorpipe_fluid_run_options {
  uint32_t struct_size;
  int32_t has_until; /* not 0: the fluid's time to end is another from now on */
  double until;
  uint64_t steps; /* the most that are made; 0: as many as it takes */
  vorpipe_fluid_watch watch;
  void* watch_user;
} vorpipe_fluid_run_options;
/* Makes steps until the fluid ends, which a time or a number of steps must do. One that had ended goes on:
 * without another time from then on without an end; and where a step was cancelled, or its areas were not
 * found, from before that. */
VORPIPE_API vorpipe_code vorpipe_fluid_run(vorpipe_fluid* fluid, const vorpipe_fluid_run_options* options);
/* Adds to the velocities of all sites: `count` pairs of x and y. */
VORPIPE_API vorpipe_code vorpipe_fluid_push(vorpipe_fluid* fluid, const double* velocities, uint64_t count);

typedef int32_t vorpipe_fluid_field;
enum {
  VORPIPE_FLUID_SITES = 1, /* by site: 2 doubles */
  VORPIPE_FLUID_WEIGHTS = 2,
  VORPIPE_FLUID_VELOCITIES = 3, /* by site: 2 doubles */
  VORPIPE_FLUID_PRESSURES = 4,  /* of the last step; by projection none before the first */
  VORPIPE_FLUID_VOLUMES = 5,
  VORPIPE_FLUID_DENSITIES = 6 /* none where all are 1 */
};
/* Good until the next step or push. */
VORPIPE_API vorpipe_code vorpipe_fluid_array(const vorpipe_fluid* fluid, vorpipe_fluid_field field,
                                             vorpipe_array* array);
/* The figures of its state. */
VORPIPE_API vorpipe_code vorpipe_fluid_last(const vorpipe_fluid* fluid, vorpipe_fluid_figures* figures);
VORPIPE_API vorpipe_fluid_end vorpipe_fluid_ended(const vorpipe_fluid* fluid);
/* The error of its velocities, relative to the exact ones; NaN where those are not known. */
VORPIPE_API double vorpipe_fluid_velocity_error(const vorpipe_fluid* fluid);
/* Of the last diagram. */
VORPIPE_API vorpipe_code vorpipe_fluid_report(const vorpipe_fluid* fluid, vorpipe_report* report);
VORPIPE_API const char* vorpipe_fluid_note(const vorpipe_fluid* fluid, size_t index);
/* The sites where they are, with their weights, as an input of the same surface: for cells and pictures. For
 * the caller to free. */
VORPIPE_API vorpipe_code vorpipe_fluid_input(const vorpipe_fluid* fluid, vorpipe_input** input);
/* "npz" has all that later steps depend on: a fluid that goes on from it gives the same bytes. Others as
 * vorpipe_relaxation_write and vorpipe_relaxation_save: the sites with their weights. */
VORPIPE_API vorpipe_code vorpipe_fluid_write(const vorpipe_fluid* fluid, const char* format,
                                             vorpipe_write write, void* user);
VORPIPE_API vorpipe_code vorpipe_fluid_save(const vorpipe_fluid* fluid, const char* path);

/* ---- Memory ---- */

/* Bytes that a program takes at the peak which does nothing but this run, and keeps what it returns. */
VORPIPE_API vorpipe_code vorpipe_cells_memory(const vorpipe_session* session, const vorpipe_input* input,
                                              const vorpipe_cells_options* options, uint64_t* bytes);
VORPIPE_API vorpipe_code vorpipe_render_memory(const vorpipe_session* session, const vorpipe_input* input,
                                               const vorpipe_render_options* options, uint64_t* bytes);
/* What this process may come to have, by what the system has and its limits. */
VORPIPE_API uint64_t vorpipe_memory_limit(void);

/* ---- Selftest ---- */

typedef struct vorpipe_selftest_options {
  uint32_t struct_size;
  int32_t quick;       /* not 0: fewer and smaller scenes */
  const char* backend; /* NULL: all */
  const char* device;  /* NULL: all */
  uint64_t seed;       /* of the scenes; 0: 1 */
  int32_t threads;
  uint32_t disabled_count;
  const char* const* disabled; /* as in vorpipe_session_options */
  uint64_t limit_count;
  const vorpipe_limit* limits;
  vorpipe_progress progress;
  void* progress_user;
} vorpipe_selftest_options;

/* Runs scenes on every backend and device here, judged by "cpu". `json`, which may be NULL, gets what was
 * found. VORPIPE_DIFFERENT: a promise is broken. */
VORPIPE_API vorpipe_code vorpipe_selftest(const vorpipe_selftest_options* options, vorpipe_write json,
                                          void* user);

#ifdef __cplusplus
}
#endif

#endif
