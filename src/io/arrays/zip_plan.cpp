#include "io/arrays/zip_plan.h"

#include <iterator>
#include <new>

namespace vorpipe {

void ZipPlan::write(std::string_view bytes) {
  const auto next = pieces.upper_bound(position);
  ZipPiece* const piece = next == pieces.begin() ? nullptr : &std::prev(next)->second;
  const std::uint64_t offset = piece == nullptr ? 0 : position - std::prev(next)->first;
  if (reading != nullptr) {
    if (piece == nullptr || piece->entry != reading) {
      pieces.emplace(position, ZipPiece{{}, reading});
    }
  } else if (piece != nullptr && piece->entry == nullptr && offset <= piece->bytes.size()) {
    piece->bytes.replace(offset, bytes.size(), bytes);
  } else {
    pieces.emplace(position, ZipPiece{std::string(bytes), nullptr});
  }
  position += bytes.size();
}

std::uint64_t ZipPlan::size() const {
  return pieces.empty() ? 0 : pieces.rbegin()->first + pieces.rbegin()->second.size();
}

zip_int64_t zipStatOf(zip_uint64_t size, void* data) {
  auto* const stat = static_cast<zip_stat_t*>(data);
  zip_stat_init(stat);
  stat->size = size;
  stat->valid = ZIP_STAT_SIZE;
  return sizeof(zip_stat_t);
}

namespace {

zip_int64_t write(ZipPlan& plan, std::string_view bytes) {
  try {
    plan.write(bytes);
    return static_cast<zip_int64_t>(bytes.size());
  } catch (const std::bad_alloc&) {
    zip_error_set(&plan.error, ZIP_ER_MEMORY, 0);
    return -1;
  }
}

zip_int64_t seek(ZipPlan& plan, void* data, zip_uint64_t length) {
  const zip_int64_t position =
      zip_source_seek_compute_offset(plan.position, plan.size(), data, length, &plan.error);
  if (position < 0) {
    return -1;
  }
  plan.position = static_cast<std::uint64_t>(position);
  return 0;
}

}  // namespace

zip_int64_t onZipPlan(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  auto& plan = *static_cast<ZipPlan*>(user);
  switch (command) {
    case ZIP_SOURCE_SUPPORTS:
      // libzip asks for a source that can be read as well.
      return zip_source_make_command_bitmap(
          ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR,
          ZIP_SOURCE_FREE, ZIP_SOURCE_SEEK, ZIP_SOURCE_TELL, ZIP_SOURCE_BEGIN_WRITE, ZIP_SOURCE_COMMIT_WRITE,
          ZIP_SOURCE_ROLLBACK_WRITE, ZIP_SOURCE_WRITE, ZIP_SOURCE_SEEK_WRITE, ZIP_SOURCE_TELL_WRITE,
          ZIP_SOURCE_REMOVE, -1);
    case ZIP_SOURCE_STAT:
      return zipStatOf(0, data);
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&plan.error, data, length);
    case ZIP_SOURCE_WRITE:
      return write(plan, {static_cast<const char*>(data), length});
    case ZIP_SOURCE_SEEK_WRITE:
      return seek(plan, data, length);
    case ZIP_SOURCE_TELL_WRITE:
      return static_cast<zip_int64_t>(plan.position);
    case ZIP_SOURCE_OPEN:
    case ZIP_SOURCE_READ:
    case ZIP_SOURCE_CLOSE:
    case ZIP_SOURCE_FREE:
    case ZIP_SOURCE_BEGIN_WRITE:
    case ZIP_SOURCE_COMMIT_WRITE:
    case ZIP_SOURCE_ROLLBACK_WRITE:
      return 0;
    default:
      zip_error_set(&plan.error, ZIP_ER_OPNOTSUPP, 0);
      return -1;
  }
}

}  // namespace vorpipe
