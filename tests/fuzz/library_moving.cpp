/// What moves sites, called in any order.
#include "library_calls.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

vorpipe_fluid_options fluidOptions(ByteStream& stream, std::array<double, 18>& numbers) {
  vorpipe_fluid_options options{};
  options.struct_size = sizeof options;
  options.scheme = smallNumber(stream);
  options.diagrams = 1 + stream.choice(8);
  if (stream.choice(4) == 0) options.step = stream.number();
  if (stream.choice(4) == 0) options.until = stream.number();
  if (stream.choice(4) == 0) options.tolerance = stream.number();
  if (stream.choice(4) == 0) options.epsilon = stream.number();
  options.has_gravity = smallNumber(stream);
  options.gravity_y = -1;
  options.count = stream.choice(10);
  for (double& number : numbers) number = stream.number();
  if (stream.flag()) options.velocities = numbers.data();
  if (stream.flag()) options.volumes = numbers.data() + 1;
  if (stream.flag()) options.densities = numbers.data() + 2;
  return options;
}

void beginFluid(ByteStream& stream, Shelves& shelves) {
  static constexpr std::array<const char*, 7> cases = {"taylor-green",    "gresho",    "shear", "no.npz",
                                                       "rayleigh-taylor", "dam-break", nullptr};
  std::array<double, 18> numbers{};
  const auto options = fluidOptions(stream, numbers);
  vorpipe_fluid* fluid = nullptr;
  if (stream.flag()) {
    const auto parcels = std::uint64_t{1} + stream.choice(30);
    told(vorpipe_fluid_read(librarySession(), cases[stream.choice(cases.size())], parcels, &options, &fluid));
  } else {
    told(vorpipe_fluid_begin(librarySession(), shelves.inputs.get(stream), &options, &fluid));
  }
  shelves.fluids.put(stream, fluid);
}

void pushFluid(ByteStream& stream, vorpipe_fluid* fluid) {
  std::array<double, 18> numbers{};
  for (double& number : numbers) number = stream.number();
  told(vorpipe_fluid_push(fluid, numbers.data(), stream.choice(numbers.size() / 2 + 1)));
}

void askFluid(ByteStream& stream, const vorpipe_fluid* fluid) {
  vorpipe_array array{};
  told(vorpipe_fluid_array(fluid, smallNumber(stream), &array));
  vorpipe_fluid_figures figures{};
  told(vorpipe_fluid_last(fluid, const_cast<vorpipe_fluid_figures*>(optional(stream, figures))));
  (void)vorpipe_fluid_ended(fluid);
  (void)vorpipe_fluid_note(fluid, stream.choice(3));
  int writes = static_cast<int>(stream.choice(9));
  const vorpipe_code code = vorpipe_fluid_write(fluid, stream.flag() ? "npz" : "csv", takeBytes, &writes);
  require(code == VORPIPE_DEVICE ? writes < 0 : true, vorpipe_last_error());
}

void flow(ByteStream& stream, Shelves& shelves) {
  vorpipe_fluid* const fluid = shelves.fluids.get(stream);
  switch (stream.choice(6)) {
    case 0:
      return beginFluid(stream, shelves);
    case 1: {
      int32_t more = 0;
      return told(vorpipe_fluid_step(fluid, nullptr, &more));
    }
    case 2: {
      vorpipe_fluid_run_options options{};
      options.has_until = smallNumber(stream);
      options.until = stream.number();
      options.steps = 1 + stream.choice(3);
      return told(vorpipe_fluid_run(fluid, optional(stream, options)));
    }
    case 3:
      return pushFluid(stream, fluid);
    case 4:
      return askFluid(stream, fluid);
    default: {
      vorpipe_input* result = nullptr;
      told(vorpipe_fluid_input(fluid, &result));
      return shelves.inputs.put(stream, result);
    }
  }
}

}  // namespace

void move(ByteStream& stream, Shelves& shelves) {
  const vorpipe_input* const input = shelves.inputs.get(stream);
  const auto kind = stream.take<std::uint8_t>();
  if (kind >= 192) return flow(stream, shelves);
  switch (kind % 4) {
    case 0: {
      vorpipe_relax_options options{};
      options.method = smallNumber(stream);
      options.iterations = 1 + stream.choice(3);
      vorpipe_relaxation* relaxation = nullptr;
      options.struct_size = sizeof options;
      told(vorpipe_relax_begin(librarySession(), input, &options, &relaxation));
      return shelves.relaxations.put(stream, relaxation);
    }
    case 1:
      return told(vorpipe_relaxation_step(shelves.relaxations.get(stream), nullptr));
    case 2: {
      vorpipe_transport_options options{};
      options.struct_size = sizeof options;
      options.diagrams = 1 + stream.choice(8);
      options.normalize = 1;
      options.surface = smallNumber(stream);
      if (stream.choice(4) == 0) options.fill = stream.number();
      if (stream.choice(4) == 0) options.tolerance = stream.number();
      vorpipe_transported* transported = nullptr;
      told(vorpipe_transport(librarySession(), input, &options, &transported));
      return shelves.transported.put(stream, transported);
    }
    default: {
      vorpipe_input* result = nullptr;
      told(stream.flag() ? vorpipe_relaxation_input(shelves.relaxations.get(stream), &result)
                         : vorpipe_transported_input(shelves.transported.get(stream), &result));
      return shelves.inputs.put(stream, result);
    }
  }
}

}  // namespace vorpipe::fuzz
