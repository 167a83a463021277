#include "cli/view_fluid.h"

#include <memory>
#include <utility>

#include "vorpipe/fluid.h"

namespace vorpipe::cli {

Result<view::Opened> openFluidForView(const FluidChoices& choices, const BackendOptions& backend,
                                      const SearchOptions& search) {
  auto setup = startOf(choices);
  if (!setup) return tl::unexpected(std::move(setup.error()));
  setup->options.search = search;
  if (!choices.until) setup->options.until = FluidOptions{}.until;
  auto session = Session::open(backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  const auto fluid = Fluid::begin(*session, std::move(setup->state), setup->options);
  if (!fluid) return asFluidOption(fluid.error(), choices);
  auto begun = std::make_shared<view::FluidSnapshot>();
  begun->setup = {fluid->state(), setup->options};
  begun->last = fluid->last();
  begun->sites = std::make_shared<const Sites>(begun->setup.state.sites);
  begun->is_begun = true;
  return view::openedFluid(std::move(begun), choices.begin.empty() ? choices.resume : choices.begin);
}

}  // namespace vorpipe::cli
