// The scene as TOML with every default filled in: doubles with as many digits as it takes to read the same bits again.

#include <carom/scene.hpp>

#include "scene/changes.hpp"
#include "scene/observables_known.hpp"
#include "scene/resolved_effects.hpp"
#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <string_view>
#include <variant>
#include <vector>

namespace carom {
namespace {

using detail::number_text;
using detail::quoted_text;
using Buffer = fmt::memory_buffer;

template <class... Args>
void put(Buffer& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

void put_pairs(Buffer& out, const std::vector<Eigen::Vector2d>& pairs) {
  put(out, "[");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    put(out, "{}[{}, {}]", i == 0 ? "" : (i % 4 == 0 ? ",\n  " : ", "), number_text(pairs[i][0]), number_text(pairs[i][1]));
  }
  put(out, "]\n");
}

void put_numbers(Buffer& out, const std::vector<double>& numbers) {
  put(out, "[");
  for (std::size_t i = 0; i < numbers.size(); ++i)
    put(out, "{}{}", i == 0 ? "" : (i % 8 == 0 ? ",\n  " : ", "), number_text(numbers[i]));
  put(out, "]\n");
}

struct PutPositions {
  Buffer& out;
  void operator()(const RandomPositions& random) const {
    if (!random.region) {
      put(out, "positions = \"random\"\n");
    } else if (const auto* circle = std::get_if<CircleRegion>(&*random.region)) {
      put(out, "positions = {{ random = {{ centre = [{}, {}], radius = {} }} }}\n", number_text(circle->centre.x()),
          number_text(circle->centre.y()), number_text(circle->radius));
    } else {
      const auto& rectangle = std::get<RectangleRegion>(*random.region);
      put(out, "positions = {{ random = {{ x = [{}, {}], y = [{}, {}] }} }}\n", number_text(rectangle.lower.x()),
          number_text(rectangle.upper.x()), number_text(rectangle.lower.y()), number_text(rectangle.upper.y()));
    }
  }
  void operator()(const SquareLattice&) const { put(out, "positions = \"square\"\n"); }
  void operator()(const HexagonalLattice&) const { put(out, "positions = \"hexagonal\"\n"); }
  void operator()(const FilePositions& file) const { put(out, "positions = {{ file = {} }}\n", quoted_text(file.path)); }
  void operator()(const GrownPositions& grown) const {
    put(out, "positions = {{ packing_fraction = {} }}\n", number_text(grown.packing_fraction));
  }
  void operator()(const ListedPositions& list) const {
    put(out, "positions = ");
    put_pairs(out, list.values);
  }
};

struct PutVelocities {
  Buffer& out;
  void operator()(const AtRest&) const { put(out, "velocities = \"rest\"\n"); }
  void operator()(const UniformVelocities& law) const { put(out, "velocities = {{ uniform = {} }}\n", number_text(law.maximum)); }
  void operator()(const MaxwellVelocities& law) const {
    put(out, "velocities = {{ temperature = {} }}\n", number_text(law.temperature));
  }
  void operator()(const FixedSpeed& law) const { put(out, "velocities = {{ speed = {} }}\n", number_text(law.speed)); }
  void operator()(const FileVelocities&) const { put(out, "# velocities: the columns vx, vy of the start file\n"); }
  void operator()(const ListedVelocities& list) const {
    put(out, "velocities = ");
    put_pairs(out, list.values);
  }
};

/// Radius or mass, as `key` says: one number for all disks, or one for each.
void put_property(Buffer& out, std::string_view key, double of_all, const std::vector<double>& of_each, const Species& species) {
  // A value of zero stands for none. A start file has a column then, and so may stay out of the scene.
  const bool in_file = std::holds_alternative<FilePositions>(species.positions) || (of_each.empty() && species.count > 0);
  if (of_all > 0.0 && of_each.empty()) {  // where both are given, each disk has its own
    put(out, "{} = {}\n", key, number_text(of_all));
  } else if (in_file) {
    put(out, "# {}: a column of the start file\n", key);
  } else {
    put(out, "{} = ", key);
    put_numbers(out, of_each);
  }
}

void put_species(Buffer& out, const Species& species) {
  put(out, "\n[[disks]]\n");
  if (!species.name.empty()) put(out, "name = {}\n", quoted_text(species.name));  // a program may leave it out
  put(out, "count = {}\n", species.count);
  put_property(out, "radius", species.radius, species.radii, species);
  put_property(out, "mass", species.mass, species.masses, species);
  std::visit(PutPositions{out}, species.positions);
  std::visit(PutVelocities{out}, species.velocities);
}

void put_run(Buffer& out, const Run& run) {
  put(out, "\n[run]\n");
  if (run.time) put(out, "time = {}\n", number_text(*run.time));
  if (run.collisions) put(out, "collisions = {}\n", *run.collisions);
  if (run.sample_every) put(out, "sample_every = {}\n", number_text(*run.sample_every));
  if (run.sample_every_collisions) put(out, "sample_every = {{ collisions = {} }}\n", *run.sample_every_collisions);
  if (const auto& log = run.sample_log)
    put(out, "sample_log = {{ base = {}, per_block = {}, block = {} }}\n", number_text(log->base), log->per_block,
        number_text(log->block));
  if (run.equilibrate && run.equilibrate->time) put(out, "equilibrate = {{ time = {} }}\n", number_text(*run.equilibrate->time));
  if (run.equilibrate && run.equilibrate->collisions_per_disk) {
    put(out, "equilibrate = {{ collisions_per_disk = {} }}\n", number_text(*run.equilibrate->collisions_per_disk));
  }
  put(out, "seed = {}\nkeep_momentum = {}\n", run.seed, run.keep_momentum);
  if (run.accept_overlap) put(out, "accept_overlap = true\n");
}

void put_observe(Buffer& out, const std::vector<ObservableRequest>& requests) {
  if (!requests.empty()) put(out, "\n[observe]\n");
  for (const ObservableRequest& request : requests) {
    const detail::KnownObservable* const known = detail::find_observable(request.name);
    const std::string_view range = known == nullptr ? "range" : known->range_key;
    const std::string_view largest = known == nullptr ? "largest" : known->largest_key;
    std::vector<std::string> settings;
    if (request.every) settings.push_back(fmt::format("every = {}", number_text(*request.every)));
    if (request.range) settings.push_back(fmt::format("{} = {}", range, number_text(*request.range)));
    if (known != nullptr && known->takes_list && !request.wave_numbers.empty()) {
      std::vector<std::string> numbers;
      for (const double k : request.wave_numbers) numbers.push_back(number_text(k));
      settings.push_back(fmt::format("{} = [{}]", largest, fmt::join(numbers, ", ")));
    } else if (request.largest) {
      settings.push_back(fmt::format("{} = {}", largest, number_text(*request.largest)));
    }
    if (request.axis)
      settings.push_back(fmt::format("axis = \"{}\"", detail::axis_words.at(static_cast<std::size_t>(*request.axis))));
    if (request.bins) settings.push_back(fmt::format("bins = {}", *request.bins));
    if (request.cells) settings.push_back(fmt::format("cells = [{}, {}]", (*request.cells)[0], (*request.cells)[1]));
    if (request.disks) settings.push_back(fmt::format("disks = {}", *request.disks));
    put(out, "{} = {}\n", request.name, settings.empty() ? "true" : fmt::format("{{ {} }}", fmt::join(settings, ", ")));
  }
}

}  // namespace

std::string resolved_toml(const Scene& scene) {
  const auto boundary = [&](int axis) { return scene.box.periodic(axis) ? "periodic" : "walls"; };
  Buffer out;
  put(out, "title = {}\n", quoted_text(scene.title));
  if (scene.species.empty()) put(out, "disks = []\n");
  if (const std::optional<Circle>& circle = scene.effects.circle) {
    put(out, "\n[box]\ncircle = {{ centre = [{}, {}], radius = {} }}\n", number_text(circle->centre[0]),
        number_text(circle->centre[1]), number_text(circle->radius));
  } else {
    put(out, "\n[box]\nx = [{}, {}]\ny = [{}, {}]\n", number_text(scene.box.lower[0]), number_text(scene.box.upper[0]),
        number_text(scene.box.lower[1]), number_text(scene.box.upper[1]));
    put(out, "boundary = {{ x = \"{}\", y = \"{}\" }}\n", boundary(0), boundary(1));
  }
  for (const Species& species : scene.species) put_species(out, species);
  put(out, "{}", detail::effects_toml(scene.effects));
  put_run(out, scene.run);
  // Without samples there are no files of them, whatever a program has set.
  const bool sampled = scene.run.is_sampled();
  put(out, "\n[output]\ntrajectory = {}\nxyz = {}\ncsv = {}\nevents = {}\nunwrapped = {}\n", sampled && scene.output.trajectory,
      sampled && scene.output.xyz, sampled && scene.output.csv, scene.output.events, sampled && scene.output.unwrapped);
  put_observe(out, scene.observe);
  for (const Change& change : scene.changes) put(out, "\n{}", changes_text(change));
  return fmt::to_string(out);
}

}  // namespace carom
