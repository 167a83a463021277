/// Files with sites, written and read by a test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {

class SitesOfFiles : public InTemporaryDirectory {
 protected:
  /// What a file with these bytes holds; fails the test where it is refused.
  [[nodiscard]] SiteTable good(std::string_view name, std::string_view bytes,
                               const ReadOptions& options = {}) const {
    return goodFile(write(name, bytes), options);
  }
  [[nodiscard]] static SiteTable goodFile(const std::string& file, const ReadOptions& options = {}) {
    auto table = readSites(file, options);
    EXPECT_TRUE(table) << table.error().message;
    return table ? std::move(*table) : SiteTable{};
  }

  /// What follows the file's path in the error message.
  [[nodiscard]] std::string bad(std::string_view name, std::string_view bytes,
                                const ReadOptions& options = {}) const {
    return badFile(write(name, bytes), options);
  }
  [[nodiscard]] static std::string badFile(const std::string& file, const ReadOptions& options = {}) {
    const auto table = readSites(file, options);
    if (table) return "was accepted";
    EXPECT_EQ(table.error().code, ErrorCode::input);
    EXPECT_EQ(table.error().message.find('\n'), std::string::npos);
    EXPECT_TRUE(table.error().message.starts_with(file + ":")) << table.error().message;
    return table.error().message.substr(std::min(file.size() + 1, table.error().message.size()));
  }

  /// Notes without the file's path, one after the other.
  [[nodiscard]] static std::string notes(const SiteTable& table) {
    std::string all;
    for (const std::string& note : table.notes) all += note.substr(note.find(": ")) + "\n";
    return all;
  }

  /// Columns to read.
  static ReadOptions columns(std::vector<std::string> names) {
    ReadOptions options;
    options.columns = std::move(names);
    return options;
  }
  static ReadOptions skipping() {
    ReadOptions options;
    options.skip_missing = true;
    return options;
  }
};

/// "NAME (TYPE): value, value", a missing one being "-".
inline std::string textOf(const Attribute& attribute) {
  constexpr const char* types[] = {"integer", "real", "boolean", "text", "json"};
  std::string text = attribute.name() + " (" + types[static_cast<int>(attribute.type())] + "): ";
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    text += (site > 0 ? ", " : "") + std::string(attribute.at(site).value_or("-"));
  }
  return text;
}

inline std::vector<std::string> textsOf(const SiteTable& table) {
  std::vector<std::string> texts;
  for (const Attribute& attribute : table.attributes) texts.push_back(textOf(attribute));
  return texts;
}

}  // namespace vorpipe::test
