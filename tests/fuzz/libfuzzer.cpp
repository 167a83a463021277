/// What libFuzzer calls: fuzz --target=NAME FOLDER...; fuzz --list names the targets, each with its longest
/// input and its dictionary.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "target.h"

using namespace vorpipe::fuzz;

namespace {

const Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--target=";
  for (int k = 1; k < *count; ++k) {
    const std::string_view argument = (*arguments)[k];
    if (argument.starts_with(option)) chosen = targetNamed(argument.substr(option.size()));
    if (argument == "--list") {
      for (const Target& target : targets())
        std::printf("%s %zu %s\n", target.name.data(), target.longest, target.words.data());
      std::exit(0);
    }
  }
  if (chosen != nullptr) return 0;
  std::fputs("fuzz: --target=NAME is needed; --list has the names\n", stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  // Not the bytes themselves: a target that reads beyond them is then seen to.
  if (size <= chosen->longest) chosen->run({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
