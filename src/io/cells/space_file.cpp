#include "io/cells/space_file.h"

#include <fmt/core.h>

#include <array>
#include <new>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/field_text.h"
#include "io/base/print.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/npz_arrays.h"
#include "io/cells/space_writers.h"

namespace vorpipe {
namespace {

constexpr SpaceFormat space_npz{.extension = ".npz", .detail = Detail3::polyhedra, .write = writeSpaceNpz},
    space_csv{.extension = ".csv", .detail = Detail3::measures, .write = writeSpaceCsv, .attributes = true},
    space_vtu{
        .extension = ".vtu", .detail = Detail3::polyhedra, .write = writeSpaceVtu, .only_polyhedra = true},
    space_obj{
        .extension = ".obj", .detail = Detail3::polyhedra, .write = writeSpaceObj, .only_polyhedra = true},
    space_ply{.extension = ".ply", .detail = Detail3::polyhedra, .write = writeSpacePly},
    space_stl{
        .extension = ".stl", .detail = Detail3::polyhedra, .write = writeSpaceStl, .only_polyhedra = true},
    space_vol{
        .extension = ".vol", .detail = Detail3::polyhedra, .write = writeSpaceVoro, .only_polyhedra = true};
constexpr std::array space_formats{&space_npz, &space_csv, &space_vtu, &space_obj,
                                   &space_ply, &space_stl, &space_vol};
constexpr std::span<const SpaceFormat* const> all_space_formats(space_formats);

/// Appends a row of the .csv.
void printSpaceRecord(Bytes& text, const SpaceOutput& output, std::size_t site) {
  const Diagram3& d = output.diagram;
  const Point3 &p = output.sites[site], &c = d.centroid[site];
  const auto begin = d.face_offsets[site], end = d.face_offsets[site + 1];
  print(text, FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},{},{},"), site, p.x, p.y, p.z,
        output.weights.empty() ? 0.0 : output.weights[site], statusWord(d.status[site]), d.volume[site],
        d.surface[site], c.x, c.y, c.z, end - begin);
  join(text, end - begin, " ",
       [&](Bytes& to, std::size_t k) { print(to, FMT_COMPILE("{}"), d.neighbors[begin + k]); });
  if (!d.neighbor_shifts.empty()) {
    text.push_back(',');
    join(text, end - begin, " ", [&](Bytes& to, std::size_t k) {
      const auto& [x, y, z] = d.neighbor_shifts[begin + k];
      print(to, FMT_COMPILE("{}:{}:{}"), x, y, z);
    });
  }
  if (d.report.duplicate > 0) print(text, FMT_COMPILE(",{}"), d.owner[site]);
  printCsvValues(text, output.attributes, site);
  text.push_back('\n');
}

}  // namespace

Result<void> writeSpaceNpz(ByteSink& sink, const SpaceOutput& output) {
  const Diagram3& d = output.diagram;
  NpzArrays arrays;
  arrays.add<double, 3>("sites", output.sites);
  arrays.addUnlessEmpty<double>("weights", output.weights);
  arrays.add<std::uint8_t>("status", d.status);
  arrays.add<std::uint32_t>("owner", d.owner);
  arrays.add<double>("volumes", d.volume);
  arrays.add<double>("areas", d.surface);
  arrays.add<double, 3>("centroids", d.centroid);
  // Offsets are signed because NumPy's sum of uint64 and int64 is float64.
  arrays.add<std::int64_t>("neighbor_offsets", d.face_offsets);
  arrays.add<std::int64_t>("neighbors", d.neighbors);
  arrays.add<double>("face_areas", d.face_areas);
  if (!d.neighbor_shifts.empty()) arrays.add<std::int32_t, 3>("neighbor_shifts", d.neighbor_shifts);
  if (output.detail == Detail3::polyhedra) {
    arrays.add<double, 6>("second_moments", d.second_moments);
    arrays.add<std::int64_t>("face_vertex_offsets", d.face_vertex_offsets);
    arrays.add<std::uint32_t>("face_vertices", d.face_vertices);
    arrays.add<double, 3>("vertices", d.vertices);
    arrays.add<std::int64_t>("vertex_site_offsets", d.vertex_site_offsets);
    arrays.add<std::int64_t>("vertex_sites", d.vertex_sites);
  }
  return arrays.write(sink);
}

Result<void> writeSpaceCsv(ByteSink& sink, const SpaceOutput& output) {
  Bytes header;
  header.append(
      std::string_view("site,x,y,z,weight,status,volume,area,centroid_x,centroid_y,centroid_z,faces,"
                       "neighbors"));
  if (!output.diagram.neighbor_shifts.empty()) header.append(std::string_view(",neighbor_shifts"));
  if (output.diagram.report.duplicate > 0) header.append(std::string_view(",owner"));
  printCsvNames(header, attributeNamesInSpace(output.attributes));
  header.push_back('\n');
  VORPIPE_TRY(writeAll(sink, header));
  const auto put = [&](Bytes& text, std::size_t site) { printSpaceRecord(text, output, site); };
  return writeEach(sink, output.sites.size(), put, output.threads);
}

std::vector<std::string_view> spaceExtensions() { return extensionsOf(all_space_formats); }

Result<const SpaceFormat*> spaceFormatOf(const std::string& path) {
  return formatFor(path, "cells in space", all_space_formats);
}

Result<void> writeSpaceCells(ByteSink& sink, const SpaceOutput& output, const SpaceFormat& format) {
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write its cells");
  }
}

}  // namespace vorpipe
