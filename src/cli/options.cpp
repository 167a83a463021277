#include "cli/options.h"

#include <cstdlib>

namespace vorpipe::cli {
namespace {

constexpr int most_threads = 1024;

/// Makes a repeatable option take one value each time, so that it does not swallow what follows.
void repeatable(CLI::Option* option) {
  option->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

bool validationAskedByEnvironment() {
  const char* value = std::getenv("VORPIPE_VALIDATION");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace

CLI::Option* addFile(CLI::App& app, const std::string& name, std::string& target,
                     const std::string& extension, const std::string& description) {
  return addParsed(app, name, target, extension.empty() ? "FILE" : "FILE" + extension, description,
                   [extension](std::string_view text) { return parseFile(text, extension); });
}

CLI::Option* addInputOptions(CLI::App& app, InputOptions& options) {
  auto* sites =
      app.add_option("--sites", options.sites,
                     "random:N, square:N, hex:N, jitter:N, clusters:N, circle:N, or a file: .csv with a "
                     "header that names x, y and optionally weight or radius, .xyz, .txt, .npy; - is "
                     "CSV on standard input");
  sites->type_name("SPEC");
  addParsed(app, "--seed", options.seed, "S", "seed of the generator [1]", [](std::string_view text) {
    return parseWhole(text, 0, UINT64_MAX);
  })->needs(sites);
  addParsed(app, "--domain", options.domain, "XMIN,YMIN,XMAX,YMAX",
            "what is drawn [0,0,1,1; for files the box of the sites, grown by 5 % of its longer side]",
            parseDomain)
      ->needs(sites);
  return sites;
}

void addBackendChoice(CLI::App& app, BackendOptions& options) {
  app.add_option("--backend", options.name, "auto, vulkan, vulkan-geometry, opengl or cpu [auto]")
      ->type_name("NAME");
  app.add_option("--device", options.device, "index or part of the name, as `vorpipe devices` lists them")
      ->type_name("DEVICE");
}

void addRunOptions(CLI::App& app, BackendOptions& options) {
  addParsed(app, "--threads", options.threads, "N", "CPU threads [all]", [](std::string_view text) {
    return parseWhole(text, 1, most_threads).map([](std::uint64_t n) { return static_cast<int>(n); });
  });
  options.validation = validationAskedByEnvironment();
  app.add_flag("--validate", options.validation,
               "Vulkan validation layers; a message of theirs fails the run [VORPIPE_VALIDATION=1]");
}

void addMaskOptions(CLI::App& app, Mask& mask) {
  auto* disable = app.add_option("--disable", mask.disabled,
                                 "pretend that devices lack a feature, such as geometryShader; repeatable");
  disable->type_name("FEATURE");
  repeatable(disable);
  auto* limit = app.add_option_function<std::vector<std::string>>(
      "--limit",
      [&mask](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) mask.limits.push_back(*parseLimit(text));
      },
      "pretend that devices have a smaller limit, such as maxTexelBufferElements=65536; repeatable");
  limit->type_name("NAME=VALUE");
  limit->check([](const std::string& text) {
    const auto parsed = parseLimit(text);
    return parsed ? std::string() : parsed.error();
  });
  repeatable(limit);
}

void addSearchOptions(CLI::App& app, SearchOptions& options) {
  addParsed(app, "--search", options, "flann[:K]",
            "the K nearest neighbors by FLANN, K from 3 to 1024 [flann:30]", parseSearch);
}

void addSizeOption(CLI::App& app, std::optional<Size>& size) {
  addParsed(app, "--size", size, "WxH", "pixels [the longer side 1000, the domain's aspect]", parseSize);
}

void addTalkOptions(CLI::App& app, TalkOptions& options) {
  auto* quiet = app.add_flag("--quiet", options.quiet, "prints nothing but errors");
  app.add_flag("--verbose", options.verbose, "says more")->excludes(quiet);
}

}  // namespace vorpipe::cli
