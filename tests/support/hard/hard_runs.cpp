#include "support/hard/hard_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <optional>
#include <utility>

namespace vorpipe::test {
namespace {

/// The text with # for each number that is a word.
std::string withoutNumbers(std::string_view text) {
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::string out;
  const char *at = text.data(), *const end = text.data() + text.size();
  while (at != end) {
    double number = 0;
    const char* const after = std::from_chars(at, end, number).ptr;
    const bool is_number =
        after != at && (out.empty() || !isWord(out.back())) && (after == end || !isWord(*after));
    out += is_number ? '#' : *at;
    at = is_number ? after : at + 1;
  }
  return out;
}

/// Adds the faults of one run after another.
class RunFaults {
 public:
  RunFaults(const HardInput& input, const HardPlan& plan) : input_(input), plan_(plan) {}

  void cells(Session& session) {
    const auto options = cellsOptions(input_);
    const auto diagram = session.cells(input_.sites, options);
    if (!taken(session, "cells", diagram)) return;
    noteChecked(session, "cells", check(input_.sites, options, *diagram, plan_.threads), diagram->report);
    if (!first_cells_) {
      first_cells_ = std::move(*diagram);
      return;
    }
    const auto diff = diffCells(*first_cells_, *diagram);
    if (diff && diff->agree()) return;
    note(session, "cells",
         !diff ? diff.error().message
               : fmt::format(
                     "differ: {} statuses, {} neighbors and {} areas are not those of the first backend",
                     diff->statuses, diff->neighbors, diff->areas));
  }

  void picture(Session& session) {
    const auto options = pictureOptions(input_);
    const auto rendering = session.render(input_.sites, options);
    if (!taken(session, "picture", rendering)) return;
    noteChecked(session, "picture", check(input_.sites, options, *rendering, plan_.threads),
                rendering->report);
    if (!first_picture_) {
      first_picture_ = std::move(*rendering);
      return;
    }
    compare(session, *rendering);
  }

  HardResult result;

 private:
  template <class Made>
  bool taken(const Session& session, std::string_view run, const Result<Made>& made) {
    if (made) return true;
    if (isRefusal(made.error())) {
      result.refused = true;
      result.refusal = made.error().message;
    } else {
      note(session, run, "error: " + made.error().message);
    }
    return false;
  }

  void noteChecked(const Session& session, std::string_view run,
                   const Result<std::vector<std::string>>& broken, const Report& report) {
    if (!broken) {
      note(session, run, broken.error().message);
      return;
    }
    for (const auto& line : *broken) note(session, run, line);
    for (const auto& line : report.validation_messages) note(session, run, "validation: " + line);
  }

  void compare(const Session& session, const Rendering& rendering) {
    const auto& ids = rendering.image.ids;
    const auto diff = diffIds(first_picture_->image.ids, ids, input_.width, input_.height, input_.sites,
                              input_.domain, input_.periodic);
    if (!diff || !diff->agree()) {
      note(session, "picture",
           !diff ? diff.error().message
                 : fmt::format("differs: {} wrong pixels and {} ties, {} allowed, from the first backend's",
                               diff->wrong, diff->ties, diff->ties_allowed));
    }
    if (rendering.status != first_picture_->status || rendering.owner != first_picture_->owner)
      note(session, "picture", "statuses are not those of the first backend");
  }

  void note(const Session& session, std::string_view run, std::string message) {
    result.faults.push_back({session.device().backend, std::string(run), std::move(message)});
  }

  const HardInput& input_;
  const HardPlan& plan_;
  std::optional<Diagram> first_cells_;
  std::optional<Rendering> first_picture_;
};

Sites without(const Sites& sites, std::size_t begin, std::size_t end) {
  Sites left;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (i >= begin && i < end) continue;
    left.x.push_back(sites.x[i]);
    left.y.push_back(sites.y[i]);
    if (!sites.weight.empty()) left.weight.push_back(sites.weight[i]);
  }
  return left;
}

}  // namespace

bool isRefusal(const Error& error) {
  const auto says = [&](std::string_view text) { return error.message.find(text) != std::string::npos; };
  return error.code == ErrorCode::input &&
         (says("but nearer to each other than") || says("is nearer to its own image than"));
}

std::string HardFault::kind() const {
  constexpr std::size_t long_enough = 48;
  return fmt::format("{} {}: {}", backend, run, withoutNumbers(message).substr(0, long_enough));
}

HardResult runHardInput(const HardInput& input, std::span<Session* const> sessions, const HardPlan& plan) {
  RunFaults running(input, plan);
  if (const auto taken = checkInput(input.sites, cellsOptions(input), plan.threads); !taken) {
    running.result.refused = true;
    running.result.refusal = taken.error().message;
    return std::move(running.result);
  }
  for (auto* const session : sessions) {
    if (plan.cells) running.cells(*session);
    if (plan.pictures) running.picture(*session);
  }
  return std::move(running.result);
}

HardInput shrunken(const HardInput& input, const HardFault& fault, std::span<Session* const> sessions,
                   double most_seconds) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto isLate = [&] {
    return std::chrono::duration<double>(Clock::now() - begin).count() > most_seconds;
  };
  const HardPlan plan{fault.run == "cells", fault.run == "picture", 1};
  const auto fails = [&](const HardInput& candidate) {
    const auto result = runHardInput(candidate, sessions, plan);
    return std::ranges::any_of(result.faults, [&](const auto& each) { return each.kind() == fault.kind(); });
  };
  HardInput least = input;
  std::size_t step = std::max<std::size_t>(least.sites.size() / 2, 1);
  while (!isLate()) {
    bool smaller = false;
    for (std::size_t first = 0; first < least.sites.size() && least.sites.size() > 1 && !isLate();) {
      HardInput candidate = least;
      candidate.sites = without(least.sites, first, first + step);
      if (candidate.sites.size() > 0 && fails(candidate)) {
        least = std::move(candidate);
        smaller = true;
      } else {
        first += step;
      }
    }
    if (!smaller && step == 1) break;
    if (!smaller || step >= least.sites.size()) step = std::max<std::size_t>(step / 2, 1);
  }
  return least;
}

}  // namespace vorpipe::test
