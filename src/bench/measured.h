/// Measurements and their output: repeated runs, their medians and spread, tables in Markdown and in JSON,
/// and curves in SVG. `vorpipe bench` and the programs of tests/bench use the same.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::bench {

/// One quantity, measured repeatedly; in the order of the measurements.
using Samples = std::vector<double>;

/// Returns the median of at least one sample; for an even number, the mean of the middle two.
double median(Samples samples);
double least(const Samples& samples);
/// The median absolute deviation from the median: half of the samples lie at most that far from it.
double spread(const Samples& samples);

/// Marks a missing figure and says why; nothing to say where a figure makes no sense.
struct Missing {
  std::string why;
};

/// The contents of one cell of a table: words, a whole number, a number, a measured quantity, or nothing.
using Cell = std::variant<std::string, std::uint64_t, double, Samples, Missing>;

struct Column {
  std::string key;      ///< in JSON
  std::string heading;  ///< in Markdown, with the unit
};

struct Table {
  std::string name;   ///< in JSON
  std::string title;  ///< in Markdown
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows{};  ///< each as long as columns
  std::vector<std::string> notes{};       ///< below the table
};

/// Three digits, as "0.00123", "12.3" or "1,234"; a number below 1e-4 as "1.23e-05".
std::string numberText(double value);

/// A heading, the table and its notes. A measured quantity is its median and, in brackets, its spread as a
/// part of that: "0.396 (1.2 %)".
std::string markdown(const Table& table);

/// The table as an object: name, title, notes, and rows, objects by the columns' keys. A measured quantity
/// is {"median", "least", "spread", "samples"}; what is missing is null, and the row's "missing" says why.
nlohmann::ordered_json json(const Table& table);

/// Something to measure. `run` does it once; `counts`: whether to keep the figures or only to warm up.
struct Course {
  std::string name;                              ///< for the progress
  std::function<Result<void>(bool counts)> run;  ///< an error ends only this course, except `cancelled`
  std::string failed{};                          ///< out: its error
};

/// Runs every course once to warm up, then `repetitions` rounds of all of them, each in its own order, the
/// same in every program. Other activity of the machine thus affects all courses alike. A course that fails
/// is not run again. Error (cancelled): progress or a course requested it.
Result<void> interleave(std::span<Course> courses, int repetitions, const Progress& progress);

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x and y, all above 0
  bool theirs = false;                            ///< figures of another program: dashed
};

struct Plot {
  std::string title, x, y;  ///< the axes' names with their units
  std::vector<Curve> curves;
};

/// A drawing of all plots that have a point, two side by side, with `caption` below. A curve has one color
/// in all of them, by its name.
std::string svg(std::span<const Plot> plots, const std::string& caption);

}  // namespace vorpipe::bench
