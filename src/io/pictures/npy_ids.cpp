#include "io/pictures/npy_ids.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <type_traits>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/npy_array.h"

namespace vorpipe {
namespace {

template <class Integer>
Result<void> readElements(InputFile& file, const NpyHeader& header, Image& image) {
  const std::uint64_t columns = header.shape[1];
  VORPIPE_TRY(checkRoom(file.name(), "ids", header.shape[0] * columns * sizeof(std::uint32_t)));
  image.ids.resize(header.shape[0] * columns);
  return eachPixel<Integer>(
      file, header, [&](std::uint64_t row, std::uint64_t column, Integer value) -> Result<void> {
        const bool none = std::is_signed_v<Integer> && value == static_cast<Integer>(-1);
        if (!none && (std::cmp_less(value, 0) || std::cmp_greater(value, no_site))) {
          return inputError(fmt::format("{}: element [{}, {}] (counted from 0) is {}; an id is 0 to {}",
                                        file.name(), row, column, value, no_site));
        }
        image.ids[row * columns + column] = none ? no_site : static_cast<std::uint32_t>(value);
        return {};
      });
}

Result<void> readByType(InputFile& file, const NpyHeader& header, Image& image) {
  const bool is_signed = header.kind == 'i';
  if (header.size == 4) {
    return is_signed ? readElements<std::int32_t>(file, header, image)
                     : readElements<std::uint32_t>(file, header, image);
  }
  return is_signed ? readElements<std::int64_t>(file, header, image)
                   : readElements<std::uint64_t>(file, header, image);
}

Result<Image> readImage(InputFile& file) {
  VORPIPE_LET(header, readNpyHeader(file));
  const bool integer = (header.kind == 'i' || header.kind == 'u') && (header.size == 4 || header.size == 8);
  const auto& shape = header.shape;
  if (!integer || shape.size() != 2 || std::min(shape[0], shape[1]) < 1 ||
      std::max(shape[0], shape[1]) > max_extent) {
    return inputError(
        fmt::format("{}: holds {}; uint32, int32, uint64 or int64 (H, W) with 1 to {} rows and "
                    "columns is needed",
                    file.name(), header.description, max_extent));
  }
  Image image;
  image.height = static_cast<int>(shape[0]);
  image.width = static_cast<int>(shape[1]);
  VORPIPE_TRY(readByType(file, header, image));
  return image;
}

}  // namespace

Result<void> writeNpyIds(ByteSink& sink, int width, int height, std::span<const std::uint32_t> ids) {
  const std::uint64_t shape[] = {static_cast<std::uint64_t>(height), static_cast<std::uint64_t>(width)};
  VORPIPE_TRY(sink.write(npyHeader(npyType<std::uint32_t>(), shape)));
  return sink.write({reinterpret_cast<const char*>(ids.data()), ids.size_bytes()});
}

Result<Image> readNpyIds(const std::string& path) {
  try {
    VORPIPE_VAR(file, InputFile::open(path));
    return readImage(file);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its ids");
  }
}

}  // namespace vorpipe
