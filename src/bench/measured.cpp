#include "bench/measured.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "base/try.h"

namespace vorpipe::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string grouped(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t place = 0; place < digits.size(); ++place) {
    if (place > 0 && (digits.size() - place) % 3 == 0) text += ',';
    text += digits[place];
  }
  return text;
}

std::string cellText(const Cell& cell) {
  return std::visit(
      Overloaded{[](const std::string& text) { return text; },
                 [](std::uint64_t count) { return grouped(count); },
                 [](double number) { return numberText(number); },
                 [](const Samples& samples) {
                   const double middle = median(samples);
                   const double part = middle > 0 ? spread(samples) / middle : 0;
                   return fmt::format("{} ({:.1f} %)", numberText(middle), 100 * part);
                 },
                 [](const Missing& missing) { return missing.why.empty() ? "-" : missing.why; }},
      cell);
}

/// Escapes bars, which would end the cell, and line ends, which would end the row.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

bool isNumber(const Cell& cell) { return !std::holds_alternative<std::string>(cell); }

std::string row(std::span<const std::string> places) {
  std::string line = "|";
  for (const auto& place : places) line += fmt::format(" {} |", escaped(place));
  return line + '\n';
}

Json cellJson(const Cell& cell) {
  return std::visit(
      Overloaded{[](const Samples& samples) {
                   return Json{{"median", median(samples)},
                               {"least", least(samples)},
                               {"spread", spread(samples)},
                               {"samples", samples}};
                 },
                 [](const Missing&) { return Json(nullptr); }, [](const auto& value) { return Json(value); }},
      cell);
}

/// A round of all courses, in the order that the generator gives.
template <class Generator>
Result<void> runRound(std::span<Course> courses, bool counts, Generator& generator,
                      const std::function<Result<void>(const Course&)>& keep_running) {
  std::vector<std::size_t> order(courses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Not std::shuffle, whose order differs between libraries.
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(order[left - 1], order[generator() % left]);
  for (const auto index : order) {
    Course& course = courses[index];
    VORPIPE_TRY(keep_running(course));
    if (!course.failed.empty()) continue;
    if (auto done = course.run(counts); !done) {
      if (done.error().code == ErrorCode::cancelled) return done;
      course.failed = done.error().message;
    }
  }
  return {};
}

}  // namespace

double median(Samples samples) {
  assert(!samples.empty());
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(samples.begin(), middle));
}

double least(const Samples& samples) { return *std::ranges::min_element(samples); }

double spread(const Samples& samples) {
  const double middle = median(samples);
  Samples off;
  for (const double sample : samples) off.push_back(std::abs(sample - middle));
  return median(std::move(off));
}

std::string numberText(double value) {
  const double size = std::abs(value);
  if (value == 0) return "0";
  if (!std::isfinite(value)) return fmt::format("{}", value);
  if (size < 1e-4) return fmt::format("{:.2e}", value);
  if (size >= 999.5) {
    return fmt::format("{}{}", value < 0 ? "-" : "", grouped(static_cast<std::uint64_t>(std::llround(size))));
  }
  constexpr double three_whole_digits = 99.95;
  return size >= three_whole_digits ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::string markdown(const Table& table) {
  std::string text = fmt::format("### {}\n\n", table.title);
  std::vector<std::string> places;
  std::string rule = "|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    places.push_back(table.columns[c].heading);
    const bool numbers =
        std::ranges::all_of(table.rows, [c](const auto& cells) { return isNumber(cells[c]); });
    rule += numbers ? "---:|" : "---|";
  }
  text += row(places) + rule + '\n';
  for (const auto& cells : table.rows) {
    assert(cells.size() == table.columns.size());
    places.clear();
    for (const Cell& cell : cells) places.push_back(cellText(cell));
    text += row(places);
  }
  for (const auto& note : table.notes) text += fmt::format("\n{}\n", note);
  return text;
}

Json json(const Table& table) {
  Json rows = Json::array();
  for (const auto& cells : table.rows) {
    Json object = Json::object(), missing = Json::object();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      object[table.columns[c].key] = cellJson(cells[c]);
      const auto* none = std::get_if<Missing>(&cells[c]);
      if (none != nullptr && !none->why.empty()) missing[table.columns[c].key] = none->why;
    }
    if (!missing.empty()) object["missing"] = std::move(missing);
    rows.push_back(std::move(object));
  }
  Json headings = Json::object();
  for (const auto& column : table.columns) headings[column.key] = column.heading;
  return {{"name", table.name},
          {"title", table.title},
          {"columns", std::move(headings)},
          {"rows", std::move(rows)},
          {"notes", table.notes}};
}

Result<void> interleave(std::span<Course> courses, int repetitions, const Progress& progress) {
  // The seed only has to be the same each time.
  std::minstd_rand generator(1);
  const auto all = static_cast<double>(courses.size()) * (repetitions + 1);
  double done = 0;
  const auto keep_running = [&](const Course& course) -> Result<void> {
    const double part = done++ / all;
    if (!progress || progress(course.name, part)) return {};
    return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
  };
  for (int round = 0; round <= repetitions; ++round) {
    VORPIPE_TRY(runRound(courses, round > 0, generator, keep_running));
  }
  return {};
}

}  // namespace vorpipe::bench
