// Where the disks start: listed and lattice positions first, then random ones into the room that is left.

#include "core/random.hpp"
#include "neighbours/disks_at_rest.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"
#include "scene/fixed_shapes.hpp"
#include "scene/refusal.hpp"
#include "scene/regions.hpp"
#include "simulation/placing_watch.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace carom {

namespace {

/// Tries for one disk before random placement gives up. At the packing fractions that random sequential addition
/// reaches in practice (0.53) one try in 1e4 succeeds.
constexpr int placement_tries = 1'000'000;

struct Ids {
  std::int64_t begin;
  std::int64_t end;
};

class Placement {
 public:
  Placement(const Scene& scene, const Disks& disks, const PlacingHook& placing)
      : scene_(scene),
        disks_(disks),
        scales_(contact_scales<double>(scene.effects, disks)),
        in_place_(scene.box, disks.radius, scales_),
        positions_(2, static_cast<Eigen::Index>(disks.count())),
        watch_(placing, [this] { return static_cast<double>(placed_) / static_cast<double>(disks_.count()); }) {
    std::int64_t first = 0;
    for (const Species& species : scene.species) {
      ids_.push_back({first, first + species.count});
      first += species.count;
    }
  }

  Eigen::Matrix2Xd run() {
    for (std::size_t s = 0; s < ids_.size(); ++s) {
      if (const auto* listed = std::get_if<ListedPositions>(&scene_.species[s].positions)) place_listed(s, listed->values);
      if (const auto* file = std::get_if<FilePositions>(&scene_.species[s].positions)) place_listed(s, file->values);
    }
    place_on_lattice<SquareLattice>("square", square_lattice);
    place_on_lattice<HexagonalLattice>("hexagonal", hexagonal_lattice);
    place_at_random();
    return positions_;
  }

 private:
  void put(std::int64_t i, const Eigen::Vector2d& position) {
    positions_.col(i) = position;
    in_place_.insert(static_cast<std::int32_t>(i), position);
    ++placed_;
  }

  [[nodiscard]] std::optional<ShapeOverlap> upon_shape(std::int64_t i, const Eigen::Vector2d& position, double tolerance) const {
    return overlapped_shape(scene_.box, scene_.effects, position, disks_.radius[static_cast<std::size_t>(i)], tolerance);
  }

  void place_listed(std::size_t s, const std::vector<Eigen::Vector2d>& values) {
    for (std::int64_t i = ids_[s].begin; i < ids_[s].end; ++i) put(i, values[static_cast<std::size_t>(i - ids_[s].begin)]);
  }

  /// All species that ask for the same lattice share it: the sites are for all of them, dealt out at random.
  template <class Kind>
  void place_on_lattice(const char* name, Lattice (*make)(const Box&, std::int64_t, double)) {
    std::vector<std::int64_t> ids;
    std::vector<std::size_t> species;
    for (std::size_t s = 0; s < ids_.size(); ++s) {
      if (!std::holds_alternative<Kind>(scene_.species[s].positions) || scene_.species[s].count == 0) continue;
      species.push_back(s);
      for (std::int64_t i = ids_[s].begin; i < ids_[s].end; ++i) ids.push_back(i);
    }
    if (ids.empty()) return;
    double diameter = 0.0;
    for (const std::int64_t i : ids) diameter = std::max(diameter, 2.0 * disks_.radius[static_cast<std::size_t>(i)]);
    const std::string where = fmt::format("disks.{}.positions", species.front());
    const Lattice lattice = make(scene_.box, static_cast<std::int64_t>(ids.size()), diameter);
    if (lattice.spacing < diameter * (1.0 - detail::touching)) {
      throw detail::scene_error(
          scene_, where,
          fmt::format(
              "a {} lattice of {} disks in this box has a spacing of {:.6g}, less than the diameter {:.6g}; take fewer or "
              "smaller disks{}",
              name, ids.size(), lattice.spacing, diameter, std::is_same_v<Kind, SquareLattice> ? R"(, or "hexagonal")" : ""));
    }
    for (const detail::UnlikeContact& pair : detail::unlike_contacts(scene_)) {
      const auto on_lattice = [&](std::int64_t kind) {
        return std::ranges::find(species, static_cast<std::size_t>(kind)) != species.end();
      };
      if (!on_lattice(pair.one) || !on_lattice(pair.other) || lattice.spacing >= pair.largest * (1.0 - detail::touching))
        continue;
      throw detail::scene_error(
          scene_, where,
          fmt::format("a {} lattice of {} disks in this box has a spacing of {:.6g}, and disks of species {} and {} touch {:.6g} "
                      "apart; make delta smaller, or take fewer or smaller disks",
                      name, ids.size(), lattice.spacing, pair.one, pair.other, pair.largest));
    }
    if (species.size() > 1) shuffle(ids);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Eigen::Vector2d site = lattice.sites.col(static_cast<Eigen::Index>(k));
      if (const auto shape = upon_shape(ids[k], site, detail::touching)) {
        throw detail::scene_error(scene_, where,
                                  fmt::format("the {} lattice puts disk {} upon {}; give all positions one by one, or ask for "
                                              "\"random\"",
                                              name, ids[k], path_of_shape(scene_.effects, shape->shape)));
      }
      const auto found = in_place_.deepest(site, static_cast<std::int32_t>(ids[k]));
      if (found.relative_overlap > detail::touching) {
        throw detail::scene_error(
            scene_, where,
            fmt::format(
                "the {} lattice puts disk {} upon disk {}, whose position is given elsewhere; give all positions one by one, or "
                "ask for \"random\"",
                name, ids[k], found.disk));
      }
      put(ids[k], site);
    }
  }

  void shuffle(std::vector<std::int64_t>& ids) const {
    RandomStream random(scene_.run.seed, Stream::lattice_sites);
    for (std::size_t k = ids.size(); k > 1; --k) {
      boost::random::uniform_int_distribution<std::size_t> pick(0, k - 1);
      std::swap(ids[k - 1], ids[pick(random)]);
    }
  }

  /// Random sequential addition, the largest disks first.
  void place_at_random() {
    struct Waiting {
      std::int64_t id;
      std::size_t species;
    };
    std::vector<Waiting> waiting;
    for (std::size_t s = 0; s < ids_.size(); ++s) {
      if (!std::holds_alternative<RandomPositions>(scene_.species[s].positions)) continue;
      for (std::int64_t i = ids_[s].begin; i < ids_[s].end; ++i) waiting.push_back({i, s});
    }
    const auto radius_of = [&](const Waiting& w) { return disks_.radius[static_cast<std::size_t>(w.id)]; };
    std::stable_sort(waiting.begin(), waiting.end(),
                     [&](const Waiting& a, const Waiting& b) { return radius_of(a) > radius_of(b); });
    for (const Waiting& disk : waiting) put(disk.id, find_room(disk.id, disk.species));
  }

  Eigen::Vector2d find_room(std::int64_t i, std::size_t species) {
    const double radius = disks_.radius[static_cast<std::size_t>(i)];
    const auto& region = std::get<RandomPositions>(scene_.species[species].positions).region;
    const Rectangle within = region ? detail::bounds_of(*region) : Rectangle{scene_.box.lower, scene_.box.upper};
    RandomStream random(scene_.run.seed, Stream::positions, static_cast<std::uint64_t>(i));
    for (int tries = 0; tries < placement_tries; ++tries) {
      watch_.pass();
      Eigen::Vector2d position;
      for (int a = 0; a < 2; ++a) {
        const double margin = scene_.box.periodic(a) && !region ? 0.0 : radius;
        const double from = within.lower[a] + margin;
        const double to = within.upper[a] - margin;
        position[a] = from < to ? boost::random::uniform_real_distribution<double>(from, to)(random) : 0.5 * (from + to);
      }
      if (region && !detail::holds_disk(*region, position, radius)) continue;
      if (!in_place_.overlaps(position, static_cast<std::int32_t>(i)) && !upon_shape(i, position, 0.0)) return position;
    }
    if (region)
      throw detail::scene_error(
          scene_, fmt::format("disks.{}.positions", species),
          fmt::format("no room for disk {} of radius {:g} in disks.{}.positions.random after {} random tries; take fewer or "
                      "smaller disks, or a larger region",
                      i, radius, species, placement_tries));
    throw detail::scene_error(
        scene_, fmt::format("disks.{}.positions", species),
        fmt::format("no room for disk {} of radius {:g} after {} random tries: the scene asks for a packing "
                    "fraction of {:.4g}, and random "
                    "placement of equal disks ends at {}; take fewer or smaller disks, or positions = \"hexagonal\"",
                    i, radius, placement_tries, scene_.packing_fraction(), detail::random_limit));
  }

  const Scene& scene_;
  const Disks& disks_;
  ContactScales<double> scales_;
  DisksAtRest in_place_;
  Eigen::Matrix2Xd positions_;
  std::vector<Ids> ids_;  ///< of each species
  std::int64_t placed_ = 0;
  detail::PlacingWatch watch_;
};

}  // namespace

Eigen::Matrix2Xd draw_positions(const Scene& scene, const Disks& disks, const PlacingHook& placing) {
  const auto is_grown = [](const Species& species) {
    return species.count > 0 && std::holds_alternative<GrownPositions>(species.positions);
  };
  return std::ranges::any_of(scene.species, is_grown) ? grown_positions(scene, disks, placing)
                                                      : Placement(scene, disks, placing).run();
}

}  // namespace carom
