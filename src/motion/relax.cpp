#include <utility>

#include "vorpipe.h"

namespace vorpipe {

Result<Relaxed> relax(Session& session, Sites sites, const RelaxOptions& options,
                      const RelaxWatcher& watcher) {
  auto relaxation = Relaxation::begin(session, std::move(sites), options);
  if (!relaxation) return tl::unexpected(std::move(relaxation.error()));
  bool stopped = false;
  while (!stopped) {
    const auto more = relaxation->step();
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    stopped = watcher && !watcher(*relaxation);
  }
  return Relaxed{relaxation->sites(), relaxation->trace(), stopped ? RelaxEnd::cancelled : relaxation->end(),
                 relaxation->report()};
}

}  // namespace vorpipe
