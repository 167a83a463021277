/// Pictures as shapes (vector graphics).
#include <fmt/core.h>

#include <string>

#include "base/try.h"
#include "c/failure.h"
#include "c/files.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "c/session_use.h"
#include "c/surface.h"
#include "io/base/error.h"
#include "io/pictures/picture_file.h"

namespace vorpipe::c {
namespace {

/// Returns the format of shapes that a path names. Error (input): it names none.
Result<const PictureFormat*> shapesFormatOf(const std::string& path) {
  const auto format = pictureFormatOf(path);
  if (format && !(*format)->of_shapes) {
    return inputError(fmt::format("{}: is made of pixels, which vorpipe_render draws", path));
  }
  return format;
}

/// Finds the cells, and writes them as a picture.
Result<void> draw(vorpipe_session& session, const vorpipe_input& input, const vorpipe_render_options* given,
                  const PictureFormat& format, ByteSink& to) {
  const auto placed = placedInput(input);
  if (!placed) return tl::unexpected(placed.error());
  const auto options = renderOptions(**placed, given);
  if (!options) return tl::unexpected(options.error());
  VORPIPE_TRY(checkPicture(*options));
  CellsOptions cells = cellsOptions(*options);
  cells.detail = Detail::polygons;
  const Sites& sites = *(*placed)->sites;
  const auto found = cellsWith(input.surface, session.session, sites, cells);
  if (!found) return tl::unexpected(found.error());
  return format.write(to, {sites, *options, nullptr, &*found, (*placed)->domain.system, session.threads});
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_draw(vorpipe_session* session, const vorpipe_input* input,
                          const vorpipe_render_options* options, const char* format, vorpipe_write write,
                          void* user) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guardedRun(*session, [&] {
    const auto known = shapesFormatOf(std::string("picture.") + format);
    if (!known) return fail(known.error());
    auto sink = sinkOf(format, write, user);
    return codeOf(draw(*session, *input, options, **known, sink));
  });
}

vorpipe_code vorpipe_draw_save(vorpipe_session* session, const vorpipe_input* input,
                               const vorpipe_render_options* options, const char* path) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (path == nullptr) return missing("path");
  return guardedRun(*session, [&] {
    const auto known = shapesFormatOf(path);
    if (!known) return fail(known.error());
    return codeOf(save(path, [&](ByteSink& to) { return draw(*session, *input, options, **known, to); }));
  });
}
