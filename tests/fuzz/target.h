/// What is fuzzed. A target takes any bytes; it must not crash, hang or take memory that its input does not
/// pay for, and must keep what it promises.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "vorpipe/result.h"

namespace vorpipe::fuzz {

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
  std::size_t longest;     ///< bytes of an input: as many as a run of some milliseconds has
  std::string_view words;  ///< dict/WORDS.dict; empty: none
};

/// All of them.
std::span<const Target> targets();
/// Null: there is none of that name.
const Target* targetNamed(std::string_view name);

/// Ends the process, with a line on standard error, where a promise is broken.
void require(bool kept, std::string_view promise);

/// What users get to see of a bad file: one line, not long, that begins with `subject`.
void requireTold(const Error& error, std::string_view subject);

/// Holds bytes as a file of a kind, in memory where the system can; the path is the same for a kind until the
/// process ends.
const std::string& fileOf(std::string_view extension, std::string_view bytes);

// The targets, in the files beside this.
void fuzzCsv(std::string_view bytes);
void fuzzText(std::string_view bytes);
void fuzzNpy(std::string_view bytes);
void fuzzGeoJson(std::string_view bytes);
void fuzzGeoJsonLines(std::string_view bytes);
void fuzzWkt(std::string_view bytes);
void fuzzGeoPackage(std::string_view bytes);
void fuzzGeometry(std::string_view bytes);
void fuzzWeights(std::string_view bytes);
void fuzzMasses(std::string_view bytes);
void fuzzOutlineGeoJson(std::string_view bytes);
void fuzzOutlineWkt(std::string_view bytes);
void fuzzDensityNpy(std::string_view bytes);
void fuzzPng(std::string_view bytes);
void fuzzJpeg(std::string_view bytes);
void fuzzIds(std::string_view bytes);
void fuzzCheckpoint(std::string_view bytes);
void fuzzRecordedRun(std::string_view bytes);
void fuzzScript(std::string_view bytes);
void fuzzCommandLine(std::string_view bytes);
void fuzzLibrary(std::string_view bytes);
void fuzzCells(std::string_view bytes);
void fuzzJudge(std::string_view bytes);
void fuzzSpace(std::string_view bytes);
void fuzzSpaceSites(std::string_view bytes);

}  // namespace vorpipe::fuzz
