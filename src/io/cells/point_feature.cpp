#include "io/cells/point_feature.h"

#include <string>
#include <vector>

#include "io/base/field_text.h"
#include "io/cells/cell_attributes.h"

namespace vorpipe {

Result<void> writePointFeatures(ByteSink& sink, FeaturesAs as, const PointsOutput& output) {
  const Sites& sites = output.sites;
  std::vector<std::string> keys;
  for (const std::string& name : pointAttributeNames(output.attributes)) {
    Bytes key;
    printJsonString(key, name);
    key.push_back(':');
    keys.push_back(fmt::to_string(key));
  }
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},"properties":{{)"), site);
    if (!sites.weight.empty()) print(text, FMT_COMPILE(R"("weight":{})"), sites.weight[site]);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (k > 0 || !sites.weight.empty()) text.push_back(',');
      text.append(keys[k]);
      printJsonValue(text, output.attributes[k], site);
    }
    text.append(std::string_view(R"(},"geometry":{"type":"Point","coordinates":)"));
    printJsonPoint(text, {sites.x[site], sites.y[site]});
    text.append(std::string_view("}}"));
    return true;
  };
  return writeFeatures(sink, as, sites.size(), put, output.threads);
}

}  // namespace vorpipe
