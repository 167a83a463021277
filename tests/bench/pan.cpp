/// How long a picture of another view takes: bench_pan BACKEND SITES PART, of the domain's sides; 1 for all.
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace {

using namespace vorpipe;

constexpr double width = 16, height = 9;
constexpr int frames = 11;

double cpuMilliseconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto of = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  return of(used.ru_utime) + of(used.ru_stime);
}

RenderOptions frameOf(int number, double part) {
  RenderOptions options{};
  options.domain = {0, 0, width, height};
  options.width = 1280;
  options.height = 720;
  const double step = 0.002 * part * number, low = part < 1 ? 0.3 + step : step;
  options.view = Box{low * width, low * height, (low + part) * width, (low + part) * height};
  return options;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// The first picture finds what the others need not.
template <class Draw>
bool measure(const std::string& name, double part, const Draw& draw) {
  std::vector<double> clock, cpu;
  for (int number = 0; number <= frames; ++number) {
    const double before = cpuMilliseconds();
    const auto begin = std::chrono::steady_clock::now();
    const auto drawn = draw(frameOf(number, part));
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    if (!drawn) {
      fmt::print(stderr, "{}\n", drawn.error().message);
      return false;
    }
    if (number == 0) continue;
    clock.push_back(taken.count());
    cpu.push_back(cpuMilliseconds() - before);
  }
  fmt::print("{}: {:.1f} ms, {:.1f} ms of CPU time\n", name, median(clock), median(cpu));
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    fmt::print(stderr, "bench_pan BACKEND SITES PART\n");
    return 2;
  }
  BackendOptions options;
  options.name = arguments[1];
  auto session = Session::open(options);
  if (!session) {
    fmt::print(stderr, "{}\n", session.error().message);
    return 3;
  }
  Sites sites = generate(Pattern::random, std::strtoull(arguments[2], nullptr, 10), 1);
  for (double& x : sites.x) x *= width;
  for (double& y : sites.y) y *= height;
  const double part = std::strtod(arguments[3], nullptr);
  KeptSites kept(*session, sites);
  const bool done =
      measure("Session::render", part, [&](const RenderOptions& of) { return session->render(sites, of); }) &&
      measure("KeptSites::render", part, [&](const RenderOptions& of) { return kept.render(of); });
  return done ? 0 : 1;
}
