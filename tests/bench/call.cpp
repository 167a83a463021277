/// Computes the cells of random sites whenever a line comes on standard input, and prints how many seconds
/// that took: what tests/bench/python.py measures Python's call beside. call N
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>

#include "vorpipe.h"

int main(int count, char** arguments) {
  if (count != 2) return EXIT_FAILURE;
  auto session = vorpipe::Session::open({.name = "cpu", .device = "", .threads = 0, .mask = {}});
  if (!session) return EXIT_FAILURE;
  const auto sites = vorpipe::generate(vorpipe::Pattern::random, std::stoull(arguments[1]), 1);
  vorpipe::CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  for (std::string line; std::getline(std::cin, line);) {
    const auto begin = std::chrono::steady_clock::now();
    const auto diagram = session->cells(sites, options);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (!diagram) return EXIT_FAILURE;
    std::cout << taken.count() << std::endl;
  }
  return EXIT_SUCCESS;
}
