/// Computes the cells of random sites whenever a line comes on standard input, and prints how many seconds
/// that took: what tests/bench/python.py measures Python's call beside. call N [space]
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <span>
#include <string>

#include "vorpipe.h"

namespace {

template <class Cells>
int answer(const Cells& cells) {
  for (std::string line; std::getline(std::cin, line);) {
    const auto begin = std::chrono::steady_clock::now();
    const auto diagram = cells();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (!diagram) return EXIT_FAILURE;
    std::cout << taken.count() << std::endl;
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** arguments) {
  const bool in_space = count == 3 && std::string("space") == arguments[2];
  if (count != 2 && !in_space) return EXIT_FAILURE;
  auto session = vorpipe::Session::open({.name = "cpu", .device = "", .threads = 0, .mask = {}});
  if (!session) return EXIT_FAILURE;
  const auto number = std::stoull(arguments[1]);
  if (in_space) {
    const auto sites = vorpipe::generate(vorpipe::Pattern3::random, number, 1);
    vorpipe::Cells3Options options{};
    options.domain = {0, 0, 0, 1, 1, 1};
    return answer([&] { return session->cells(std::span(sites), options); });
  }
  const auto sites = vorpipe::generate(vorpipe::Pattern::random, number, 1);
  vorpipe::CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  return answer([&] { return session->cells(sites, options); });
}
