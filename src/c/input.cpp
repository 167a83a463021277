/// Sites, their weights and attributes, and a density.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "io/base/attribute.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/sites/attribute_values.h"
#include "io/sites/density_file.h"
#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"
#include "io/sites/weights_file.h"

namespace vorpipe::c {
namespace {

/// Copies `count` numbers, each `stride` bytes after the one before; 0: without gaps.
template <class Number>
std::vector<double> copied(const Number* numbers, std::uint64_t count, std::size_t stride) {
  if (stride == 0 || stride == sizeof(Number)) return {numbers, numbers + count};
  std::vector<double> copy(count);
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbers);
  for (std::uint64_t k = 0; k < count; ++k) {
    Number number;
    std::memcpy(&number, bytes + k * stride, sizeof(Number));
    copy[k] = number;
  }
  return copy;
}

/// Makes an input with the caller's sites.
Result<vorpipe_input> inputOf(Sites sites) {
  vorpipe_input input;
  input.sites = std::make_shared<const Sites>(std::move(sites));
  input.attributes = std::make_shared<const std::vector<Attribute>>();
  input.name = "sites";
  return input;
}

/// Makes an input with sites of a file or a generator.
Result<vorpipe_input> inputOf(const std::string& spec, std::uint64_t seed, const ReadOptions& options) {
  VORPIPE_VAR(source, loadSites(spec, seed, options));
  SiteTable& table = source.table;
  vorpipe_input input;
  input.sites = std::make_shared<const Sites>(std::move(table.sites));
  input.attributes = std::make_shared<const std::vector<Attribute>>(std::move(table.attributes));
  input.system = std::move(table.system);
  input.name = spec;
  input.from = source.generator ? SitesFrom::generator : SitesFrom::file;
  input.generator = source.generator;
  input.skipped = table.skipped;
  input.notes.assign(table.notes.begin(), table.notes.end());
  return input;
}

Result<ReadOptions> readOptions(const vorpipe_read_options& given) {
  ReadOptions options;
  options.attributes = given.keep_attributes != 0;
  options.skip_missing = given.skip_missing != 0;
  if (given.format != nullptr) options.format = given.format;
  if (given.layer != nullptr) options.layer = given.layer;
  if (given.column_count > 3) {
    return inputError(fmt::format("columns: are {} of at most 3", given.column_count));
  }
  if (given.column_count > 0 && given.columns == nullptr) return inputError("columns: is NULL");
  for (std::uint32_t k = 0; k < given.column_count; ++k) {
    if (given.columns[k] == nullptr) return inputError(fmt::format("columns: number {} is NULL", k));
    options.columns.emplace_back(given.columns[k]);
  }
  return options;
}

/// Stores the new object for the caller.
vorpipe_code giveInput(Result<vorpipe_input> made, vorpipe_input** input) {
  if (!made) return fail(made.error());
  *input = new vorpipe_input(std::move(*made));
  return VORPIPE_DONE;
}

vorpipe_code setWeights(vorpipe_input& input, Result<std::vector<double>> weights) {
  if (!weights) return fail(weights.error());
  Sites sites = *input.sites;
  sites.weight = std::move(*weights);
  input.sites = std::make_shared<const Sites>(std::move(sites));
  input.placed = nullptr;
  return VORPIPE_DONE;
}

/// Replaces the density; `name` is that of its file.
void takeDensity(vorpipe_input& input, DensityFile density, std::string name) {
  input.density = std::move(density.density);
  input.density_system = std::move(density.system);
  input.density_name = std::move(name);
  input.density_looked_at = nullptr;
}

/// Error (input): numbers so near to each other would overlap.
Result<void> checkStride(std::size_t stride, std::size_t size, std::string_view name) {
  if (stride == 0 || stride >= size) return {};
  return inputError(fmt::format("{}: {} bytes, where a number has {}", name, stride, size));
}

/// `Given` is vorpipe_sites or vorpipe_sites_float.
template <class Given>
Result<Sites> sitesOf(const Given& given) {
  if (given.count > max_sites) {
    return inputError(fmt::format("sites: {} of at most {}", given.count, max_sites));
  }
  if (given.count > 0 && given.x == nullptr) return inputError("x: is NULL");
  if (given.count > 0 && given.y == nullptr) return inputError("y: is NULL");
  VORPIPE_TRY(checkStride(given.position_stride, sizeof(*given.x), "position_stride"));
  if (given.weight != nullptr) {
    VORPIPE_TRY(checkStride(given.weight_stride, sizeof(*given.weight), "weight_stride"));
  }
  Sites sites;
  sites.x = copied(given.x, given.count, given.position_stride);
  sites.y = copied(given.y, given.count, given.position_stride);
  if (given.weight != nullptr) sites.weight = copied(given.weight, given.count, given.weight_stride);
  for (std::uint64_t k = 0; k < given.count; ++k) {
    if (std::isfinite(sites.x[k]) && std::isfinite(sites.y[k])) continue;
    return tl::unexpected(
        Error{ErrorCode::input, fmt::format("sites: site {} is not finite", k), false, Subject::sites});
  }
  return sites;
}

using SharedNumbers = std::shared_ptr<const std::vector<double>>;

/// The z of sites in space; null in the plane. Error (input): one is not finite.
template <class Given>
Result<SharedNumbers> thirdOf(const Given& given) {
  if constexpr (requires { given.z; }) {
    if (given.z == nullptr) return nullptr;
    auto z = std::make_shared<const std::vector<double>>(copied(given.z, given.count, given.position_stride));
    for (std::uint64_t k = 0; k < given.count; ++k) {
      if (std::isfinite((*z)[k])) continue;
      return tl::unexpected(
          Error{ErrorCode::input, fmt::format("sites: site {} is not finite", k), false, Subject::sites});
    }
    return z;
  }
  return nullptr;
}

template <class Given>
vorpipe_code createInput(const Given* sites, std::string_view name, vorpipe_input** input) {
  VORPIPE_NEEDS(sites, input);
  return guarded([&] {
    VORPIPE_TAKE(given, taken(sites, name));
    VORPIPE_TAKE(copy, sitesOf(given));
    VORPIPE_TAKE(z, thirdOf(given));
    auto made = inputOf(std::move(copy));
    if (made) made->z = z;
    return giveInput(std::move(made), input);
  });
}

/// Replaces the sites. Errors (input): there are none; weights or attributes that stay are of another number.
Result<void> replaceSites(vorpipe_input& input, Sites sites) {
  if (sites.size() == 0) return inputError("sites: there are none");
  const std::vector<double>& weight = input.sites->weight;
  if (sites.weight.empty() && !weight.empty() && weight.size() != sites.size()) {
    return inputError(fmt::format("weights: {} for {} sites", weight.size(), sites.size()));
  }
  if (!input.attributes->empty() && input.sites->size() != sites.size()) {
    return inputError(
        fmt::format("attributes: are of {} sites, not of {}", input.sites->size(), sites.size()));
  }
  if (sites.weight.empty()) sites.weight = weight;
  input.sites = std::make_shared<const Sites>(std::move(sites));
  input.from = SitesFrom::caller;
  input.generator = std::nullopt;
  findAnew(input);
  return {};
}

template <class Given>
vorpipe_code setSites(vorpipe_input* input, const Given* sites, std::string_view name) {
  VORPIPE_NEEDS(input, sites);
  return guarded([&] {
    VORPIPE_TAKE(given, taken(sites, name));
    VORPIPE_TAKE(copy, sitesOf(given));
    VORPIPE_TAKE(z, thirdOf(given));
    auto replaced = replaceSites(*input, std::move(copy));
    if (replaced) input->z = z;
    return codeOf(std::move(replaced));
  });
}

vorpipe_attribute_type numberOf(AttributeType type) {
  return static_cast<vorpipe_attribute_type>(type) + VORPIPE_INTEGER;
}

/// Returns the attribute of an index; null if there is none.
const Attribute* attributeAt(const vorpipe_input* input, std::size_t index) {
  return input == nullptr || index >= input->attributes->size() ? nullptr : &(*input->attributes)[index];
}

/// Makes an attribute with the caller's values. Errors (input): those of checkAttribute; there is no such
/// type.
Result<Attribute> attributeOf(const char* name, vorpipe_attribute_type type, const vorpipe_text* values,
                              std::uint64_t count) {
  constexpr std::array types{AttributeType::text,    AttributeType::integer, AttributeType::real,
                             AttributeType::boolean, AttributeType::text,    AttributeType::json};
  VORPIPE_LET(known, chosen(types, type, "type"));
  Attribute attribute(name, known);
  for (std::uint64_t site = 0; site < count; ++site) {
    const auto& [data, size] = values[site];
    attribute.add(data == nullptr ? std::nullopt : std::optional(std::string_view(data, size)));
  }
  if (type == VORPIPE_INFERRED) attribute.inferType();
  VORPIPE_TRY(checkAttribute(attribute));
  return attribute;
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_input_create(const vorpipe_sites* sites, vorpipe_input** input) {
  return createInput(sites, "vorpipe_sites", input);
}

vorpipe_code vorpipe_input_create_float(const vorpipe_sites_float* sites, vorpipe_input** input) {
  return createInput(sites, "vorpipe_sites_float", input);
}

vorpipe_code vorpipe_input_set_sites(vorpipe_input* input, const vorpipe_sites* sites) {
  return setSites(input, sites, "vorpipe_sites");
}

vorpipe_code vorpipe_input_set_sites_float(vorpipe_input* input, const vorpipe_sites_float* sites) {
  return setSites(input, sites, "vorpipe_sites_float");
}

vorpipe_code vorpipe_input_read(const char* sites, uint64_t seed, vorpipe_input** input) {
  VORPIPE_NEEDS(sites, input);
  return guarded([&] { return giveInput(inputOf(sites, seed, {.attributes = false}), input); });
}

vorpipe_code vorpipe_input_read_with(const char* sites, const vorpipe_read_options* options,
                                     vorpipe_input** input) {
  VORPIPE_NEEDS(sites, input);
  return guarded([&] {
    VORPIPE_TAKE(given, taken(options, "vorpipe_read_options"));
    VORPIPE_TAKE(reading, readOptions(given));
    return giveInput(inputOf(sites, given.seed == 0 ? 1 : given.seed, reading), input);
  });
}

void vorpipe_input_free(vorpipe_input* input) { delete input; }

uint64_t vorpipe_input_count(const vorpipe_input* input) {
  return input == nullptr ? 0 : input->sites->size();
}

uint64_t vorpipe_input_skipped(const vorpipe_input* input) { return input == nullptr ? 0 : input->skipped; }

const char* vorpipe_input_note(const vorpipe_input* input, size_t index) {
  return input == nullptr || index >= input->notes.size() ? nullptr : input->notes[index].c_str();
}

vorpipe_code vorpipe_input_set_weights(vorpipe_input* input, const double* weights, uint64_t count) {
  VORPIPE_NEEDS(input, weights);
  return guarded([&] {
    if (count != input->sites->size()) {
      return fail(VORPIPE_INPUT, fmt::format("weights: {} for {} sites", count, input->sites->size()),
                  Subject::weights);
    }
    return setWeights(*input, std::vector<double>(weights, weights + count));
  });
}

vorpipe_code vorpipe_input_read_weights(vorpipe_input* input, const char* path) {
  VORPIPE_NEEDS(input, path);
  return guarded([&] { return setWeights(*input, readWeights(path, input->sites->size())); });
}

vorpipe_code vorpipe_input_random_weights(vorpipe_input* input, double low, double high, uint64_t seed) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (!std::isfinite(high - low) || low > high) {
      return fail(VORPIPE_INPUT, fmt::format("weights: none are from {} to {}", low, high), Subject::weights);
    }
    return setWeights(*input, randomWeights(low, high, input->sites->size(), seed));
  });
}

vorpipe_code vorpipe_input_set_density(vorpipe_input* input, const double* values, int32_t width,
                                       int32_t height) {
  VORPIPE_NEEDS(input, values);
  return guarded([&] {
    if (width < 1 || height < 1) {
      return fail(VORPIPE_INPUT, fmt::format("density: is {} x {} pixels", width, height), Subject::density);
    }
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    takeDensity(*input, {{width, height, std::vector<double>(values, values + count)}, {}}, {});
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_read_density(vorpipe_input* input, const char* path) {
  VORPIPE_NEEDS(input, path);
  return guarded([&] {
    VORPIPE_TAKE(density, readDensity(path));
    takeDensity(*input, std::move(density), path);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_density_box(vorpipe_input* input, double xmin, double ymin, double xmax,
                                           double ymax) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (input->density.values.empty()) {
      return fail(VORPIPE_INPUT, "density: there is none that a box could be of", Subject::density);
    }
    if (!(xmin < xmax) || !(ymin < ymax) || !std::isfinite(xmax - xmin) || !std::isfinite(ymax - ymin)) {
      return fail(VORPIPE_INPUT, fmt::format("density: {},{},{},{} is no box", xmin, ymin, xmax, ymax),
                  Subject::density);
    }
    input->density.box = Box{xmin, ymin, xmax, ymax};
    input->density_system = {};
    input->density_looked_at = nullptr;
    return vorpipe_code{VORPIPE_DONE};
  });
}

size_t vorpipe_input_attribute_count(const vorpipe_input* input) {
  return input == nullptr ? 0 : input->attributes->size();
}

const char* vorpipe_input_attribute_name(const vorpipe_input* input, size_t attribute) {
  const Attribute* const at = attributeAt(input, attribute);
  return at == nullptr ? nullptr : at->name().c_str();
}

vorpipe_attribute_type vorpipe_input_attribute_type(const vorpipe_input* input, size_t attribute) {
  const Attribute* const at = attributeAt(input, attribute);
  return at == nullptr ? 0 : numberOf(at->type());
}

vorpipe_code vorpipe_input_attribute(const vorpipe_input* input, size_t attribute, uint64_t site,
                                     vorpipe_text* value) {
  VORPIPE_NEEDS(input, value);
  return guarded([&] {
    const Attribute* const at = attributeAt(input, attribute);
    if (at == nullptr) return fail(VORPIPE_INPUT, fmt::format("attribute: there is no number {}", attribute));
    if (site >= at->size()) return fail(VORPIPE_INPUT, fmt::format("site: there is no number {}", site));
    const auto text = at->at(site);
    *value = text ? vorpipe_text{text->data(), text->size()} : vorpipe_text{nullptr, 0};
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_add_attribute(vorpipe_input* input, const char* name, vorpipe_attribute_type type,
                                         const vorpipe_text* values, uint64_t count) {
  VORPIPE_NEEDS(input, name);
  if (values == nullptr && count > 0) return missing("values");
  return guarded([&] {
    if (count != input->sites->size()) {
      return fail(VORPIPE_INPUT, fmt::format("{}: {} values for {} sites", vorpipe::inQuotes(name), count,
                                             input->sites->size()));
    }
    VORPIPE_TAKE(attribute, attributeOf(name, type, values, count));
    std::vector<Attribute> all = *input->attributes;
    all.push_back(std::move(attribute));
    input->attributes = std::make_shared<const std::vector<Attribute>>(std::move(all));
    input->placed = nullptr;
    return vorpipe_code{VORPIPE_DONE};
  });
}
