// Dumps and data files of LAMMPS.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "base/words.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/simulation_cell.h"
#include "io/sites/sites_reader.h"
#include "io/sites/text_rows.h"

namespace vorpipe {
namespace {

/// A word of a line, and its column from 1.
struct Word {
  std::string_view text;
  std::size_t column;
};

/// The words before a #.
std::vector<Word> wordsIn(std::string_view line) {
  std::vector<Word> words;
  const std::string_view text = line.substr(0, line.find('#'));
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
    words.push_back({text.substr(at, end - at), at + 1});
    at = end;
  }
  return words;
}

/// Reads numbers from the first words of the last line.
template <std::size_t count>
Result<std::array<double, count>> numbersOf(const LineReader& lines, const std::vector<Word>& words) {
  if (words.size() < count)
    return lines.errorAt(1, fmt::format("the line has {} of {} numbers", words.size(), count));
  std::array<double, count> numbers{};
  for (std::size_t k = 0; k < count; ++k) {
    const auto number = parseNumber(words[k].text);
    if (!number) return lines.errorAt(words[k].column, number.error());
    numbers[k] = *number;
  }
  return numbers;
}

// -- Dumps ------------------------------------------------------------------------------------------------

tl::unexpected<Error> endsEarly(const LineReader& lines, std::string_view before) {
  return inputError(fmt::format("{}: ends before its {}", lines.name(), before));
}

/// Reads what follows BOX BOUNDS: two bounds of each axis, with the tilts of a cell as a third number; or
/// with "abc origin" three vectors and where they begin.
Result<SimulationCell> readBounds(LineReader& lines, std::string_view header) {
  const bool tilted = header.find("xy xz yz") != std::string_view::npos;
  const bool general = header.find("abc origin") != std::string_view::npos;
  std::array<bool, 3> periodic{};
  std::size_t axis = 0;
  for (const Word& word : wordsIn(header)) {
    const bool boundary = word.text.size() == 2 && std::ranges::all_of(word.text, [](char letter) {
                            return std::string_view("pfsm").find(letter) != std::string_view::npos;
                          });
    if (boundary && axis < 3) periodic[axis++] = word.text == "pp";
  }
  std::array<double, 3> low{}, high{}, tilt{};
  SimulationCell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    VORPIPE_LET(line, lines.next());
    if (!line) return endsEarly(lines, "box");
    const auto words = wordsIn(*line);
    if (general) {
      VORPIPE_LET(row, numbersOf<4>(lines, words));
      cell.vectors[k] = {row[0], row[1], row[2]};
      (k == 0 ? cell.origin.x : k == 1 ? cell.origin.y : cell.origin.z) = row[3];
      continue;
    }
    VORPIPE_LET(bounds, numbersOf<2>(lines, words));
    low[k] = bounds[0];
    high[k] = bounds[1];
    if (!tilted) continue;
    VORPIPE_LET(row, numbersOf<3>(lines, words));
    tilt[k] = row[2];
  }
  if (!general) {
    // The bounds are those of the tilted cell's own box.
    const auto [xy, xz, yz] = tilt;
    low[0] -= std::min({0.0, xy, xz, xy + xz});
    high[0] -= std::max({0.0, xy, xz, xy + xz});
    low[1] -= std::min(0.0, yz);
    high[1] -= std::max(0.0, yz);
    cell = tiltedCell(low, high, tilt);
  }
  cell.periodic = periodic;
  return cell;
}

/// A dump up to its atoms.
struct DumpHead {
  std::optional<std::uint64_t> count;
  std::optional<SimulationCell> cell;
};

/// Names the columns of ITEM: ATOMS, and says how they are places.
Result<void> takeAtomColumns(TextRows& rows, std::string_view line, const DumpHead& head) {
  constexpr std::string_view item = "ITEM: ATOMS";
  std::vector<std::string> names;
  for (const Word& word : wordsIn(line)) names.emplace_back(word.text);
  names.erase(names.begin(), names.begin() + 2);
  constexpr std::array<std::string_view, 4> endings = {"", "u", "s", "su"};
  const auto has = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  // --columns says which columns are places by their own names.
  std::vector<std::string> called = names;
  for (const std::string_view ending : endings) {
    const std::array<std::string, 3> triple{fmt::format("x{}", ending), fmt::format("y{}", ending),
                                            fmt::format("z{}", ending)};
    if (!rows.options().columns.empty() || !std::ranges::all_of(triple, has)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      *(called.begin() + (std::ranges::find(names, triple[k]) - names.begin())) = triple[k].substr(0, 1);
    break;
  }
  // Particles of a dump have either a radius or a diameter.
  const auto diameter = std::ranges::find(called, "diameter");
  if (diameter != called.end() && !has("radius") && rows.options().columns.empty()) {
    *diameter = "radius";
    rows.halveWeights();
  }
  VORPIPE_TRY(rows.takeNames(called, item.size() + 2));
  std::size_t scaled = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string& name = names[rows.columns()[k]];
    scaled += name == std::string(1, "xyz"[k]) + "s" || name == std::string(1, "xyz"[k]) + "su";
  }
  if (scaled == 0) return {};
  if (scaled != 3)
    return rows.lines().errorAt(item.size() + 2,
                                "some of x, y and z are fractions of the box, and others are not");
  if (!head.cell) return rows.lines().errorAt(1, "places are fractions of a box, and there is none before");
  rows.placeBy([cell = *head.cell](const std::array<double, 3>& at) { return placeIn(cell, at); });
  return {};
}

/// Reads items up to the atoms.
Result<DumpHead> readDumpHead(TextRows& rows) {
  LineReader& lines = rows.lines();
  DumpHead head;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) return endsEarly(lines, "ITEM: ATOMS");
    const std::string_view item = trimmed(*line);
    if (item.starts_with("ITEM: NUMBER OF ATOMS")) {
      VORPIPE_LET(number, lines.next());
      if (!number) return endsEarly(lines, "number of atoms");
      head.count = wholeNumber<std::uint64_t>(trimmed(*number));
      if (!head.count) return lines.errorAt(1, inQuotes(trimmed(*number)) + " is no number of atoms");
    } else if (item.starts_with("ITEM: BOX BOUNDS")) {
      const std::string header(item);
      VORPIPE_LET(cell, readBounds(lines, header));
      head.cell = cell;
    } else if (item.starts_with("ITEM: ATOMS")) {
      if (!head.count) return lines.errorAt(1, "atoms begin before their number");
      VORPIPE_TRY(takeAtomColumns(rows, item, head));
      return head;
    } else if (lines.number() == 1 && !item.starts_with("ITEM:")) {
      return lines.errorAt(1, "a text dump of LAMMPS begins with \"ITEM:\"");
    }
  }
}

// -- Data files -------------------------------------------------------------------------------------------

/// The columns of an atom style, up to three numbers of images that may follow.
struct AtomStyle {
  std::string_view name, columns;
};
constexpr std::array<AtomStyle, 9> atom_styles = {{
    {"atomic", "id type x y z"},
    {"charge", "id type q x y z"},
    {"bond", "id molecule type x y z"},
    {"angle", "id molecule type x y z"},
    {"molecular", "id molecule type x y z"},
    {"full", "id molecule type q x y z"},
    {"sphere", "id type radius density x y z"},
    {"dipole", "id type q x y z mux muy muz"},
    {"ellipsoid", "id type ellipsoid density x y z"},
}};
constexpr std::array<std::string_view, 3> image_names = {"image_x", "image_y", "image_z"};

/// What the header of a data file says.
struct DataHead {
  std::optional<std::uint64_t> count;
  SimulationCell cell;
  std::string style;  ///< in the comment of the section; may be empty
};

/// Reads lines of a number and what it is, up to the section Atoms; other sections are passed by.
Result<DataHead> readDataHead(LineReader& lines) {
  DataHead head;
  std::array<double, 3> low{-0.5, -0.5, -0.5}, high{0.5, 0.5, 0.5}, tilt{};
  const auto ends = [](const std::vector<Word>& words, std::string_view a, std::string_view b) {
    return words.size() == 4 && words[2].text == a && words[3].text == b;
  };
  VORPIPE_TRY(lines.next());  // a comment, whatever it says
  bool sections = false;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) return endsEarly(lines, "section Atoms");
    const auto words = wordsIn(*line);
    if (words.empty()) continue;
    if (words[0].text == "Atoms") {
      const std::size_t comment = line->find('#');
      if (comment != std::string_view::npos) head.style = lowerCase(trimmed(line->substr(comment + 1)));
      break;
    }
    // A section's name begins with a letter, and what is in it is of no interest.
    sections = sections || (words[0].text[0] >= 'A' && words[0].text[0] <= 'Z');
    if (sections) continue;
    if (words.size() == 2 && words[1].text == "atoms") {
      head.count = wholeNumber<std::uint64_t>(words[0].text);
      if (!head.count)
        return lines.errorAt(words[0].column, inQuotes(words[0].text) + " is no number of atoms");
    }
    constexpr std::array<std::array<std::string_view, 2>, 3> bounds = {
        {{"xlo", "xhi"}, {"ylo", "yhi"}, {"zlo", "zhi"}}};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!ends(words, bounds[k][0], bounds[k][1])) continue;
      VORPIPE_LET(numbers, numbersOf<2>(lines, words));
      low[k] = numbers[0];
      high[k] = numbers[1];
    }
    if (words.size() == 6 && words[3].text == "xy" && words[4].text == "xz" && words[5].text == "yz") {
      VORPIPE_LET(numbers, numbersOf<3>(lines, words));
      tilt = numbers;
    }
  }
  if (!head.count) return lines.errorAt(1, "the section Atoms begins before a line \"N atoms\"");
  head.cell = tiltedCell(low, high, tilt);
  return head;
}

/// Takes the columns of the first row by its style, or by --columns.
Result<void> takeStyle(TextRows& rows, const std::string& style) {
  const std::size_t count = rows.fields().size();
  const auto& options = rows.options();
  const auto* const found = std::ranges::find(atom_styles, style, &AtomStyle::name);
  // Of all styles, atomic alone has so few columns.
  constexpr std::size_t fewest = 5;
  const bool known = found != atom_styles.end(), atomic = style.empty() && count == fewest;
  if (!known && !atomic) {
    if (!options.columns.empty()) {
      VORPIPE_VAR(columns, numberedColumns(options.columns, count, rows.lines().name(), options.third));
      rows.takeColumns(std::move(columns), count);
      return {};
    }
    std::vector<std::string_view> names;
    for (const AtomStyle& other : atom_styles) names.push_back(other.name);
    return rows.lines().errorAt(
        1, style.empty()
               ? fmt::format(
                     "the section Atoms does not name its style, as \"Atoms # full\" does; known are {}; "
                     "or --columns X,Y,Z by their numbers",
                     fmt::join(names, ", "))
               : fmt::format(
                     "atom style {} is none of {}; --columns X,Y,Z by their numbers says where places are",
                     inQuotes(style), fmt::join(names, ", ")));
  }
  std::vector<std::string> names;
  for (const Word& word : wordsIn(known ? found->columns : atom_styles.front().columns))
    names.emplace_back(word.text);
  if (count == names.size() + image_names.size())
    names.insert(names.end(), image_names.begin(), image_names.end());
  if (count != names.size()) {
    return rows.lines().errorAt(
        1, fmt::format("the row has {} fields, those of style {} have {}, or {} with images", count,
                       known ? style : "atomic", names.size(), names.size() + image_names.size()));
  }
  if (style == "sphere" && options.columns.empty()) rows.halveWeights();  // the file has diameters
  return rows.takeNames(names);
}

}  // namespace

Result<SiteTable> readLammpsDump(InputFile file, const ReadOptions& options) {
  TextRows rows(std::move(file), options);
  VORPIPE_VAR(head, readDumpHead(rows));
  VORPIPE_TRY(rows.takeRows(*head.count));
  SiteTable table = rows.finish();
  table.cell = head.cell;
  return table;
}

Result<SiteTable> readLammpsData(InputFile file, const ReadOptions& options) {
  TextRows rows(std::move(file), options);
  VORPIPE_VAR(head, readDataHead(rows.lines()));
  if (*head.count > 0) {
    VORPIPE_LET(there, rows.next());
    if (!there) return endsEarly(rows.lines(), "atoms");
    VORPIPE_TRY(takeStyle(rows, head.style));
    VORPIPE_TRY(rows.take());
    VORPIPE_TRY(rows.takeRows(*head.count - 1, 1, TextRows::Rest::unnoted));
  }
  SiteTable table = rows.finish();
  table.cell = head.cell;
  return table;
}

}  // namespace vorpipe
