#include "bench/child.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#ifdef __APPLE__
extern char** environ;
#endif

namespace vorpipe::bench {
namespace {

constexpr auto glance = std::chrono::milliseconds(20);
constexpr mode_t readable = 0600;

tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected(Error{ErrorCode::device, std::move(message)});
}

std::string lastLine(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

Result<pid_t> start(const std::string& program, const std::vector<std::string>& arguments,
                    const std::string& errors) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::unique_ptr<posix_spawn_file_actions_t, int (*)(posix_spawn_file_actions_t*)> release(
      &files, posix_spawn_file_actions_destroy);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   readable);
  pid_t child = 0;
  const int code = posix_spawn(&child, program.c_str(), &files, nullptr, pointers.data(), environ);
  if (code != 0) return failure(fmt::format("{}: {}", program, std::strerror(code)));
  return child;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code none;
  std::string name = (std::filesystem::temp_directory_path(none) / "vorpipe-bench-XXXXXX").string();
  if (!none && mkdtemp(name.data()) != nullptr) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

Result<void> runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& errors, const std::function<bool()>& go_on) {
  const auto child = start(program, arguments, errors);
  if (!child) return tl::unexpected(child.error());
  int status = 0;
  while (waitpid(*child, &status, WNOHANG) == 0) {
    if (!go_on()) {
      kill(*child, SIGKILL);
      waitpid(*child, &status, 0);
      return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
    }
    std::this_thread::sleep_for(glance);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string said = lastLine(errors);
  if (WIFSIGNALED(status)) {
    return failure(fmt::format("ended by signal {}{}{}", WTERMSIG(status), said.empty() ? "" : ": ", said));
  }
  constexpr std::string_view name = "vorpipe: ";
  constexpr int refused = 2;
  return tl::unexpected(Error{WEXITSTATUS(status) == refused ? ErrorCode::input : ErrorCode::device,
                              said.starts_with(name) ? said.substr(name.size()) : said});
}

}  // namespace vorpipe::bench
