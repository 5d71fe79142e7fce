#include "neighbours/neighbour_lists.hpp"

#include <functional>
#include <map>
#include <utility>

namespace carom {

namespace {

/// Rounding of the search in single precision stays below this fraction of a contact distance.
constexpr double search_slack = 1e-4;

}  // namespace

NeighbourLists::NeighbourLists(const FixedAxis& x, const FixedAxis& y, const std::vector<double>& radius)
    : axes_{x, y}, homes_(radius.size()), kernel_(&cage_kernel()) {
  if (!radius.empty()) largest_ = *std::max_element(radius.begin(), radius.end());
  one_radius_ = std::adjacent_find(radius.begin(), radius.end(), std::not_equal_to<>()) == radius.end();
  radius_.reserve(one_radius_ ? 1 : radius.size());
  for (std::size_t i = 0; i < (one_radius_ ? std::min<std::size_t>(radius.size(), 1) : radius.size()); ++i)
    radius_.push_back(static_cast<float>(radius[i] / largest_));
  for (int a = 0; a < 2; ++a) {
    steps_[a] = largest_ / (axes_[a].unit * 0x1p32);
    nearness_.unit[a] = static_cast<float>(1.0 / steps_[a]);
  }
}

void NeighbourLists::rebuild(double half_width, std::span<const CageCentre> centres) {
  half_width_ = half_width;
  // A few steps of the centres, and of single precision, on the safe side.
  const double h = half_width / largest_;
  nearness_.two_halves = static_cast<float>(2.0 * h * (1.0 + 1e-6) + 4.0 / std::min(steps_[0], steps_[1]));

  std::map<int, std::pair<std::size_t, float>, std::greater<>> sizes;  // disks and largest radius, by exponent
  if (one_radius_) {
    if (!homes_.empty()) sizes[0] = {homes_.size(), radius_[0]};
  } else {
    for (const float r : radius_) {
      auto& [disks, largest] = sizes[std::ilogb(r)];
      ++disks;
      largest = std::max(largest, r);
    }
    std::map<int, std::uint8_t> number;
    for (const auto& size : sizes) number.emplace(size.first, static_cast<std::uint8_t>(number.size()));
    layer_of_.resize(radius_.size());
    for (std::size_t i = 0; i < radius_.size(); ++i) layer_of_[i] = number[std::ilogb(radius_[i])];
  }
  layers_.clear();
  for (const auto& size : sizes) {
    const auto [disks, largest] = size.second;
    layers_.emplace_back(axes_[0], axes_[1], largest, 2.0 * (largest + h) * largest_, disks);
  }

  const auto disks = static_cast<std::int32_t>(homes_.size());
  free_.clear();
  ids_.resize(homes_.size() * room);
  for (std::int32_t i = 0; i < disks; ++i) {
    const auto k = static_cast<std::size_t>(i);
    homes_[k] = {centres[k], static_cast<std::uint32_t>(i), 0, 0};
    std::fill_n(list(i), room, i);
    layers_[layer_of(i)].insert(i, centres[k], radius(i));
  }
  for (std::int32_t i = 0; i < disks; ++i) {
    search(i, home(i).centre, false);
    set_list(i);
  }
}

std::span<const std::int32_t> NeighbourLists::move_cage(std::int32_t i, CageCentre centre) {
  const CageCentre before = home(i).centre;
  layers_[layer_of(i)].move(i, before, centre, radius(i));
  home(i).centre = centre;
  search(i, before, true);
  const std::size_t kept = found_count_ - fresh_count_;
  if (kept < count(i)) {
    if (gone_.size() < count(i)) gone_.resize(2 * std::size_t{count(i)});
    const std::size_t gone = kernel_->absent(ids(i), count(i), found_.data(), found_count_, gone_.data());
    for (std::size_t k = 0; k < gone; ++k) remove(gone_[k], i);
    changes_ += gone;
  }
  for (std::size_t k = 0; k < fresh_count_; ++k) append(fresh_[k], i);
  changes_ += fresh_count_;
  set_list(i);
  const std::size_t padded = std::max<std::size_t>((fresh_count_ + 7) / 8 * 8, 8);
  for (std::size_t k = fresh_count_; k < padded; ++k) fresh_[k] = i;
  return {fresh_.data(), padded};
}

/// The cells of a layer in which there may be cages near one of a disk of the given radius.
CageRange NeighbourLists::range_around(CageCentre centre, float radius, const CageCells& layer) const {
  const double reach =
      (static_cast<double>(radius) + static_cast<double>(layer.largest_radius()) + 2.0 * half_width_ / largest_) *
      (1.0 + search_slack);
  return layer.around(centre, {reach * steps_[0] + 8.0, reach * steps_[1] + 8.0});
}

/// Fills found_ and fresh_ with those near the cage of disk i as it is now.
void NeighbourLists::search(std::int32_t i, CageCentre before, bool was_listed) {
  const CageQuery query{i, radius(i), home(i).centre, before, was_listed};
  found_count_ = fresh_count_ = 0;
  for (const CageCells& layer : layers_) {
    const CageRange range = range_around(query.centre, query.radius, layer);
    // Room for eight disks of every block, those that follow full ones included.
    const std::size_t most = found_count_ + 8 * (CageCells::cells_in(range) + layer.spilled()) + 16;
    if (found_.size() < most) found_.resize(most), fresh_.resize(most);
    CagesFound found{found_.data(), found_count_, fresh_.data(), fresh_count_};
    kernel_->search(layer.blocks(), layer.next(), range, query, nearness_, found);
    found_count_ = found.all_count;
    fresh_count_ = found.fresh_count;
  }
}

void NeighbourLists::prefetch_cells(std::int32_t i) const {
  asm volatile("");  // see Engine::look_ahead
  const CageCells& layer = layers_[layer_of(i)];
  layer.prefetch(range_around(home(i).centre, radius(i), layer));
  for (std::uint32_t k = 0; k < std::min(home(i).count, room); ++k) {
    prefetch_home(ids(i)[k]);
    prefetch_likely_list(ids(i)[k]);
  }
}

/// The list of disk i becomes what search() found.
void NeighbourLists::set_list(std::int32_t i) {
  const auto count = static_cast<std::uint32_t>(found_count_);
  const std::uint32_t old = home(i).count;
  if (count > room << home(i).size) grow(i, count);
  std::int32_t* mine = list(i);
  std::copy_n(found_.data(), found_count_, mine);
  if (old > count) std::fill(mine + count, mine + old, i);
  home(i).set_count(count);
}

void NeighbourLists::append(std::int32_t i, std::int32_t id) {
  const std::uint32_t count = home(i).count;
  if (count == room << home(i).size) grow(i, count + 1);
  list(i)[count] = id;
  home(i).set_count(count + 1);
}

void NeighbourLists::remove(std::int32_t i, std::int32_t id) {
  std::int32_t* mine = list(i);
  const std::uint32_t last = home(i).count - 1;
  const std::size_t at = kernel_->position(mine, id);
  mine[at] = mine[last];
  mine[last] = i;
  home(i).set_count(last);
}

/// Moves the list of disk i to where `count` ids have room.
void NeighbourLists::grow(std::int32_t i, std::uint32_t count) {
  const Home old = home(i);
  const auto size = static_cast<std::uint32_t>(std::bit_width((count - 1) / room));
  if (free_.size() <= size) free_.resize(size + 1);
  std::uint32_t place;
  if (free_[size].empty()) {
    place = static_cast<std::uint32_t>(ids_.size() / room);
    ids_.resize(ids_.size() + (std::size_t{room} << size));
  } else {
    place = free_[size].back();
    free_[size].pop_back();
  }
  if (free_.size() <= old.size) free_.resize(old.size + 1U);
  free_[old.size].push_back(old.place);
  home(i).place = place;
  home(i).size = size & 31U;
  const std::int32_t* from = ids_.data() + std::size_t{room} * old.place;
  std::fill(std::copy_n(from, old.count, list(i)), list(i) + (room << size), i);
}

bool NeighbourLists::near(std::int32_t i, std::int32_t j) const {
  return kernel_->near(home(j).centre, radius(j), home(i).centre, radius(i), nearness_);
}

std::uint64_t NeighbourLists::entries() const {
  std::uint64_t sum = 0;
  for (const Home& some : homes_) sum += some.count;
  return sum;
}

std::size_t NeighbourLists::bytes() const {
  std::size_t sum = homes_.capacity() * sizeof(Home) + ids_.capacity() * sizeof(std::int32_t) +
                    (one_radius_ ? 0 : radius_.capacity() * sizeof(float)) + layer_of_.capacity();
  for (const CageCells& layer : layers_) sum += layer.bytes();
  return sum;
}

}  // namespace carom
