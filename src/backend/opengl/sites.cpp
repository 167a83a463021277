#include "backend/opengl/sites.h"

#include <fmt/core.h>

#include <vector>

#include "backend/site_texels.h"

namespace vorpipe::opengl {

// The input of site.vert.
Sites::Sites()
    : which_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      grid_(GL_UNIFORM_BUFFER, GL_STATIC_DRAW),
      sites_(GL_RGBA32F, sites_unit),
      bins_(GL_R32UI, bins_unit),
      marks_(GL_RG32UI, marks_unit),
      weights_(GL_RG32F, weights_unit),
      heaviest_(GL_RGBA32F, heaviest_unit) {
  glGenVertexArrays(1, &vertices_);
  glBindVertexArray(vertices_);
  glEnableVertexAttribArray(0);
  which_.bind();
  glVertexAttribIPointer(0, 1, GL_UNSIGNED_INT, sizeof(std::uint32_t), bufferOffset(0));
}

Result<void> Sites::upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) {
  const SiteGridUniform block = siteGridUniform(sites);
  grid_.write(std::as_bytes(std::span(&block, 1)));
  bins_.write(std::as_bytes(std::span(sites.grid.offsets)));
  std::vector<std::byte> texels(sites.size() * sizeof(SiteTexel));
  writeSiteTexels(sites, texels.data());
  sites_.write(texels);
  weighted_ = !sites.weight.empty();
  if (weighted_) {
    texels.resize(sites.size() * sizeof(WeightTexel));
    writeWeightTexels(sites, texels.data());
    weights_.write(texels);
    texels.resize(heaviestBytes(sites));
    writeHeaviest(sites, texels.data());
    heaviest_.write(texels);
  }
  if (!palette_index.empty()) {
    texels.resize(sites.size() * sizeof(SiteMark));
    writeSiteMarks(sites, palette_index, texels.data());
    marks_.write(texels);
  }
  return takeErrors(fmt::format("sending {} sites to the device", sites.size()));
}

Result<void> Sites::send(std::span<const std::uint32_t> which) {
  glBindVertexArray(vertices_);
  which_.write(std::as_bytes(which));
  glBindBufferBase(GL_UNIFORM_BUFFER, grid_binding, grid_.name());
  return takeErrors(fmt::format("sending the indices of {} sites to the device", which.size()));
}

}  // namespace vorpipe::opengl
