#include "c/moved_sites.h"

#include "c/array.h"
#include "c/failure.h"
#include "c/files.h"
#include "c/placed_input.h"
#include "c/structs.h"
#include "io/cells/points_file.h"

namespace vorpipe::c {
namespace {

Result<void> writeTo(ByteSink& to, const MovedSites& moved, const PointsFormat& format) {
  return writePoints(
      to, {shownSites(moved.placed, moved.sites), *moved.input.attributes, systemOf(moved.placed)}, format);
}

}  // namespace

vorpipe_code writeMoved(const MovedSites& moved, const char* format, vorpipe_write write, void* user) {
  const auto known = pointsFormatOf(std::string("sites.") + format);
  if (!known) return fail(known.error());
  auto sink = sinkOf(format, write, user);
  return codeOf(writeTo(sink, moved, **known));
}

vorpipe_code saveMoved(const MovedSites& moved, const char* path) {
  const auto known = pointsFormatOf(path);
  if (!known) return fail(known.error());
  return codeOf(save(path, [&](ByteSink& to) { return writeTo(to, moved, **known); }));
}

vorpipe_code giveMoved(const MovedSites& moved, Surface surface, vorpipe_input** input) {
  auto made = inputOf(moved.input, moved.placed, moved.sites);
  made->surface = surface;
  *input = made.release();
  return VORPIPE_DONE;
}

vorpipe_code giveReport(const Report& report, vorpipe_report* to) {
  return codeOf(give(reportOf(report), to, "vorpipe_report"));
}

}  // namespace vorpipe::c
