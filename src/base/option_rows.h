/// Options that the program, the library and Python have alike: a row has the name, range and help of one;
/// its default is that of the struct. Flags and help of the command line, messages, checks of the library,
/// the commands that the window copies, and the arguments and pickles of Python come from the rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>

#include "base/option_names.h"
#include "vorpipe.h"

namespace vorpipe {

template <class Struct>
struct FlagRow {
  const char* name;  ///< that of the member, and of Python's argument
  bool Struct::*member;
  const char* help;  ///< of the command line
};

template <class Struct, class Number>
struct NumberRow {
  const char* name;
  Number Struct::*member;
  Number least, most;
  Number least_given;                        ///< more than `least` if 0 means that the option is not given
  std::array<const FlagRow<Struct>*, 2> of;  ///< flags that it needs one of; null: none
  const char* unit;                          ///< in messages, after a space
  const char* value;                         ///< its name in help
  const char* help;                          ///< {0} is `least_given`, {1} is `most`, {2} is the default
  const char* range = nullptr;               ///< in messages, if it is not a number from one to another
  const char* zero = nullptr;                ///< a word for 0
  const char* flag = nullptr;                ///< of the command line, if it is not made of the name
};

/// One of the names of an enumeration.
template <class Struct, class Enum>
struct ChoiceRow {
  const char* name;
  Enum Struct::*member;
  const char* value;
  const char* help;
};

template <class Struct>
struct PointRow {
  const char* name;
  Point Struct::*member;
  const char* value;
  const char* help;
};

template <class Struct>
struct ColorRow {
  const char* name;
  std::optional<Color> Struct::*member;
  std::array<const FlagRow<Struct>*, 2> of;
  bool opaque;  ///< takes no other colors
  const char* help;
  const char* value = "C";
};

inline constexpr FlagRow<RenderOptions> edges_row{"edges", &RenderOptions::edges,
                                                  "draws the edges of the cells"},
    dual_row{"dual", &RenderOptions::dual,
             "draws lines between sites whose cells have a common edge in the domain: of the Delaunay "
             "triangulation, what does not meet beyond; a larger --margin has more of it"},
    show_sites_row{"show_sites", &RenderOptions::show_sites, "draws a dot at each site"},
    labels_row{
        "labels", &RenderOptions::labels,
        "writes the index of each site, counted from 0 as in --ids, or @NAME, an attribute of it, into its "
        "cell where it has room"};

inline constexpr NumberRow<RenderOptions, double> edge_width_row{
    "edge_width",
    &RenderOptions::edge_width,
    1,
    100,
    1,
    {&edges_row, &dual_row},
    " pixels",
    "PX",
    "how wide edges and lines of --dual are, {0} to {1} pixels; edges in a .png without "
    "--antialias have a whole number of them [{2}]"},
    dot_size_row{"dot_size",
                 &RenderOptions::dot_size,
                 0,
                 100,
                 1,
                 {&show_sites_row, nullptr},
                 " pixels",
                 "PX",
                 "how wide dots are, {0} to {1} pixels [by the spacing of the sites that show]"},
    label_size_row{"label_size",
                   &RenderOptions::label_size,
                   5,
                   200,
                   5,
                   {&labels_row, nullptr},
                   " pixels",
                   "PX",
                   "how high digits and capital letters are, {0} to {1} pixels [{2}]"};

inline constexpr ColorRow<RenderOptions> edge_color_row{
    "edge_color",
    &RenderOptions::edge_color,
    {&edges_row, nullptr},
    true,
    "the color of the edges: #rgb, #rrggbb or a name of CSS, as white [#181818]"},
    background_row{
        "background",
        &RenderOptions::background,
        {},
        false,
        "the color of what is no cell, and of cells with --no-fill: #rgb, #rrggbb, #rrggbbaa with an "
        "opacity, or a name of CSS [transparent, and white cells]"};

inline constexpr NumberRow<RenderOptions, int> antialias_row{
    "antialias",
    &RenderOptions::antialias,
    1,
    8,
    1,
    {},
    "",
    "N",
    "smooths a .png: each pixel has the mean color of N x N places, {0} to {1}; --ids are those of the "
    "centers [{2}]"};

inline constexpr NumberRow<RenderOptions, double> graticule_row{
    "graticule",
    &RenderOptions::graticule,
    0,
    90,
    0.1,
    {},
    " degrees",
    "DEGREES",
    "with --globe, draws meridians and parallels, so many degrees apart, {0} to {1}, and the border of the "
    "map "
    "[none]"};

/// The marks of pictures, in the order of help; and all options of pictures that have rows.
inline constexpr std::tuple mark_rows{edges_row,      edge_color_row, dual_row,   edge_width_row,
                                      show_sites_row, dot_size_row,   labels_row, label_size_row};
inline constexpr auto picture_rows =
    std::tuple_cat(mark_rows, std::tuple{background_row, antialias_row, graticule_row});

inline constexpr double without_end = std::numeric_limits<double>::infinity(),
                        above_zero = std::numeric_limits<double>::denorm_min();

inline constexpr FlagRow<RelaxOptions> equal_masses_row{
    "equal_masses", &RelaxOptions::equal_masses,
    "relaxes under the square of the density: then cells get equal masses, as stippling wants "
    "it; else sites are as dense as its square root"};

inline constexpr std::tuple method_rows{
    ChoiceRow<RelaxOptions, RelaxMethod>{
        "method", &RelaxOptions::method, "NAME",
        "how sites move: lbfgs, which comes as far in 30 diagrams as Lloyd's steps in 200; or lloyd, "
        "each to the centroid of its cell [{}]"},
    NumberRow<RelaxOptions, std::uint64_t>{"iterations",
                                           &RelaxOptions::iterations,
                                           0,
                                           UINT32_MAX,
                                           0,
                                           {},
                                           "",
                                           "N",
                                           "the most diagrams to compute after the first [{2}]"},
    NumberRow<RelaxOptions, double>{
        "tolerance",
        &RelaxOptions::tolerance,
        0,
        without_end,
        0,
        {},
        "",
        "T",
        "ends when no site would move farther than this part of the spacing, the square root of the mean "
        "area [{2}: never]",
        "a number of 0 or more"}};

inline constexpr auto relax_rows = std::tuple_cat(method_rows, std::tuple{equal_masses_row});

inline constexpr std::tuple transport_rows{
    NumberRow<TransportOptions, double>{
        "tolerance",
        &TransportOptions::tolerance,
        above_zero,
        without_end,
        above_zero,
        {},
        "",
        "T",
        "ends when no cell differs from its mass by more than this part of it [{2}]",
        "a number above 0"},
    NumberRow<TransportOptions, std::uint64_t>{"diagrams",
                                               &TransportOptions::diagrams,
                                               1,
                                               UINT32_MAX,
                                               1,
                                               {},
                                               "",
                                               "N",
                                               "the most diagrams to compute [{2}]"}};

/// Returns a row of what must be more than 0.
constexpr NumberRow<FluidOptions, double> fluidRow(const char* name, double FluidOptions::*member,
                                                   const char* value, const char* help,
                                                   const char* zero = nullptr, const char* flag = nullptr) {
  return {name, member, above_zero, without_end, above_zero, {}, "", value, help, "more than 0", zero, flag};
}

/// {2} in the help of `until` is when a fluid ends without it.
inline constexpr std::tuple fluid_rows{
    fluidRow("until", &FluidOptions::until, "T", "the time at which it ends [{2}]", nullptr, "--time"),
    fluidRow("step", &FluidOptions::step, "S",
             "time of a step; auto: as long as speeds and springs allow [auto]", "auto"),
    ChoiceRow<FluidOptions, FluidScheme>{
        "scheme", &FluidOptions::scheme, "NAME",
        "projection, with reflection, for domains that are full; springs, which pull sites to the centroids "
        "of "
        "their cells, and have free surfaces; or auto, the first but for a free surface [{}]"},
    fluidRow(
        "epsilon", &FluidOptions::epsilon, "E",
        "softness of springs, a time: they swing in 2 pi of it [2 spacings of cells over the largest first "
        "speed, or over half of that of a fall from the top; 3 spacings with a free surface]"),
    NumberRow<FluidOptions, double>{
        "viscosity",
        &FluidOptions::viscosity,
        0,
        without_end,
        0,
        {},
        "",
        "NU",
        "kinematic viscosity: the domain's unit squared per time [as the case has "
        "it, or {2}]",
        "a number of 0 or more"},
    ChoiceRow<FluidOptions, FluidWalls>{"walls", &FluidOptions::walls, "NAME",
                                        "slip, along which a viscous fluid slides; or no-slip, to which it "
                                        "sticks [as the case has it, or {}]"},
    NumberRow<FluidOptions, double>{
        "centering",
        &FluidOptions::centering,
        0,
        without_end,
        0,
        {},
        "",
        "RATE",
        "by projection: sites also move to the centroids of their cells, at this rate, per time; cells keep "
        "their velocities [as the case has it, or {2}]",
        "a number of 0 or more"},
    PointRow<FluidOptions>{"gravity", &FluidOptions::gravity, "GX,GY", "acceleration [as the case has it]"},
    fluidRow("tolerance", &FluidOptions::tolerance, "T",
             "no area differs from its own by more than this part of it [{2}]")};

/// Calls `visit` with each row of a table.
template <class Rows, class Visit>
constexpr void forEachRow(const Rows& rows, const Visit& visit) {
  std::apply([&](const auto&... row) { (visit(row), ...); }, rows);
}

/// Returns the name with another separator of words than _.
inline std::string nameWith(char separator, std::string name) {
  std::ranges::replace(name, '_', separator);
  return name;
}

/// Returns the name of a row's option on the command line.
template <class Row>
std::string flagOf(const Row& row) {
  if constexpr (requires { row.flag; }) {
    if (row.flag != nullptr) return row.flag;
  }
  return "--" + nameWith('-', row.name);
}

}  // namespace vorpipe
