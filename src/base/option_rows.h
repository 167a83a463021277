/// Options of pictures that the program, the checks of the library and Python have alike: a row has the name,
/// range and help of one; its default is that of the struct. Flags and help of the command line, messages,
/// and the arguments and pickles of Python come from the rows.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <tuple>

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
};

inline constexpr FlagRow<RenderOptions> edges_row{"edges", &RenderOptions::edges,
                                                  "darkens the edges of the cells"},
    dual_row{"dual", &RenderOptions::dual,
             "draws lines between sites whose cells have a common edge in the domain: of the Delaunay "
             "triangulation, what does not meet beyond; a larger --margin has more of it"},
    show_sites_row{"show_sites", &RenderOptions::show_sites, "draws a dot at each site"},
    labels_row{"labels", &RenderOptions::labels,
               "writes the index of each site, counted from 0 as in --ids, into its cell where it has room"};

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
                   "how high the digits are, {0} to {1} pixels [{2}]"};

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

/// The marks of pictures, in the order of help; and all options of pictures that have rows.
inline constexpr std::tuple mark_rows{edges_row,    dual_row,   edge_width_row, show_sites_row,
                                      dot_size_row, labels_row, label_size_row};
inline constexpr auto picture_rows = std::tuple_cat(mark_rows, std::tuple{antialias_row});

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
  return "--" + nameWith('-', row.name);
}

}  // namespace vorpipe
