/// What the sources name of an interface to devices, so that no test forgets a function of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <regex>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace vorpipe::test {

/// The names like `pattern` in all sources of these folders of `src`.
inline std::set<std::string> functionsNamed(const std::regex& pattern,
                                            std::initializer_list<std::string_view> folders) {
  std::set<std::string> names;
  for (const std::string_view folder : folders) {
    const auto root = std::filesystem::path(VORPIPE_SOURCES) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      for (std::sregex_iterator found(text.begin(), text.end(), pattern), end; found != end; ++found) {
        names.insert(found->str());
      }
    }
  }
  return names;
}

/// Every one is in one of the lists, and every one of the lists is called.
inline void expectListed(const std::set<std::string>& called,
                         std::initializer_list<std::span<const std::string_view>> lists) {
  std::set<std::string> listed;
  for (const auto& list : lists) listed.insert(list.begin(), list.end());
  for (const std::string& name : called) {
    EXPECT_TRUE(listed.contains(name))
        << name << " is called, and neither made to fail nor named as one that cannot";
  }
  for (const std::string& name : listed) EXPECT_TRUE(called.contains(name)) << name << " is not called";
}

}  // namespace vorpipe::test
