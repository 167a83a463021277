/// Zip archives of files that are in memory.
#pragma once

#include <span>

#include "io/arrays/zip_entry.h"
#include "io/files/output_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Writes an archive of at least one entry, stored without compression, and with a fixed time, so that
/// equal entries give equal bytes. Takes no more memory than the archive's headers. Error (device):
/// writing failed.
Result<void> writeZip(OutputFile& file, std::span<const ZipEntry> entries);

}  // namespace vorpipe
