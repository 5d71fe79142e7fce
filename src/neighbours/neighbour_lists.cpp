#include "neighbours/neighbour_lists.hpp"

#include "core/all_equal.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace carom {

namespace {

/// Rounding of the search in single precision stays below this fraction of a contact distance.
constexpr double search_slack = 1e-4;

/// Radii within a factor of two of the largest, which is 1, have size -1, and so on down.
int size_of(float radius) { return std::ilogb(std::nextafter(radius, 0.0F)); }

}  // namespace

NeighbourLists::NeighbourLists(const FixedAxis& x, const FixedAxis& y, const std::vector<double>& radius)
    : axes_{x, y}, around_(radius.size()), kernel_(&neighbour_search_kernel()) {
  if (!radius.empty()) largest_ = *std::max_element(radius.begin(), radius.end());
  one_radius_ = all_equal(radius);
  radius_.reserve(one_radius_ ? 1 : radius.size());
  for (std::size_t i = 0; i < (one_radius_ ? std::min<std::size_t>(radius.size(), 1) : radius.size()); ++i)
    radius_.push_back(static_cast<float>(radius[i] / largest_));
  for (int a = 0; a < 2; ++a) {
    steps_[a] = largest_ / (axes_[a].unit * 0x1p32);
    nearness_.unit[a] = static_cast<float>(1.0 / steps_[a]);
  }

  std::map<int, std::pair<std::size_t, float>, std::greater<>> sizes;  // disks and largest radius, by exponent
  if (one_radius_) {
    if (!radius_.empty()) sizes[0] = {around_.disks(), radius_[0]};
  } else {
    for (const float r : radius_) {
      auto& [disks, largest] = sizes[size_of(r)];
      ++disks;
      largest = std::max(largest, r);
    }
    std::map<int, std::uint8_t> number;
    for (const auto& size : sizes) number.emplace(size.first, static_cast<std::uint8_t>(number.size()));
    layer_of_.resize(radius_.size());
    for (std::size_t i = 0; i < radius_.size(); ++i) layer_of_[i] = number[size_of(radius_[i])];
  }
  for (const auto& size : sizes) sizes_.push_back({size.second.first, size.second.second});
}

NeighbourLists::NeighbourLists(const NeighbourLists& whole, std::size_t slots)
    : axes_{whole.axes_[0], whole.axes_[1]},
      largest_(whole.largest_),
      radius_(whole.one_radius_ ? whole.radius_ : std::vector<float>(slots)),
      one_radius_(whole.one_radius_),
      half_width_(whole.half_width_),
      around_(slots),
      sizes_(whole.sizes_),
      layer_of_(whole.layer_of_.empty() ? 0 : slots),
      empty_(slots, 1),
      kernel_(whole.kernel_),
      steps_{whole.steps_[0], whole.steps_[1]} {
  nearness_ = whole.nearness_;
  const double share = static_cast<double>(slots) / static_cast<double>(std::max<std::size_t>(whole.around_.disks(), 1));
  for (Size& size : sizes_) size.disks = static_cast<std::size_t>(share * static_cast<double>(size.disks)) + 1;
}

void NeighbourLists::rebuild(double half_width, std::span<const NeighbourhoodCentre> centres) {
  half_width_ = half_width;
  h_ = half_width / largest_;
  // A few steps of the centres, and of single precision, on the safe side.
  nearness_.two_halves = static_cast<float>(2.0 * h_ * (1.0 + 1e-6) + 4.0 / std::min(steps_[0], steps_[1]));

  if (sliding_) sliding_->set_neighbourhoods(2.0 * h_, 2.0 * (1.0 + h_));

  layers_.clear();
  for (const auto& [disks, largest] : sizes_)
    layers_.emplace_back(axes_[0], axes_[1], largest, 2.0 * (static_cast<double>(largest) + h_) * largest_, disks);

  around_.clear();
  const auto disks = static_cast<std::int32_t>(around_.disks());
  for (std::int32_t i = 0; i < disks; ++i) {
    if (empty(i)) continue;
    const NeighbourhoodCentre centre = centres[static_cast<std::size_t>(i)];
    around_.set_centre(i, centre);
    layers_[layer_of(i)].insert(i, centre, radius(i));
  }
  for (std::int32_t i = 0; i < disks; ++i) {
    if (empty(i)) continue;
    search(i);
    around_.assign(i, found());
  }
}

void NeighbourLists::fill(std::int32_t i, DiskSize size) {
  const auto slot = static_cast<std::size_t>(i);
  empty_[slot] = 0;
  if (!one_radius_) radius_[slot] = size.radius;
  if (!layer_of_.empty()) layer_of_[slot] = static_cast<std::uint8_t>(size.layer);
}

void NeighbourLists::insert(std::int32_t i, DiskSize size, NeighbourhoodCentre centre) {
  fill(i, size);
  layers_[layer_of(i)].insert(i, centre, radius(i));
  around_.set_centre(i, centre);
  search(i);
  for (const std::int32_t j : found()) around_.append(j, i);
  around_.assign(i, found());
}

void NeighbourLists::remove(std::int32_t i) {
  for (std::uint32_t k = 0; k < count(i); ++k) {
    const std::int32_t j = ids(i)[k];
    around_.remove_at(j, kernel_->position(ids(j), i));
  }
  layers_[layer_of(i)].remove(i, centre(i));
  if (found_.size() < 16) found_.resize(16);
  around_.assign(i, {found_.data(), std::size_t{0}});
  empty_[static_cast<std::size_t>(i)] = 1;
}

void NeighbourLists::clear() {
  layers_ = std::vector<NeighbourhoodCells>();
  around_.release();
}

std::span<const std::int32_t> NeighbourLists::begin_move(std::int32_t i, NeighbourhoodCentre to) {
  const NeighbourhoodCentre from = centre(i);
  around_.set_centre(i, to);
  search(i);
  // Not before the search, which excludes the disk itself: it would wait until what has just been written has left the processor.
  layers_[layer_of(i)].move(i, from, to, radius(i));
  if (gone_.size() < count(i) + 16) gone_.resize(2 * std::size_t{count(i)} + 16);
  const auto [fresh, gone] = kernel_->compare(ids(i), count(i), found_.data(), found_count_, fresh_.data(), gone_.data());
  for (std::size_t k = fresh; k < fresh + 8; ++k) fresh_[k] = i;
  for (std::size_t k = gone; k < gone + 4; ++k) gone_[k] = i;
  for (std::size_t k = 0; k < 4; ++k) around_.prefetch_list(fresh_[k]), around_.prefetch_list(gone_[k]);
  around_.assign(i, found());
  change_ = {fresh, gone};
  return {fresh_.data(), fresh};
}

void NeighbourLists::end_move(std::int32_t i) {
  const auto [fresh, gone] = change_;
  for (std::size_t k = 0; k < gone; ++k) around_.remove_at(gone_[k], kernel_->position(ids(gone_[k]), i));
  for (std::size_t k = 0; k < fresh; ++k) around_.append(fresh_[k], i);
  changes_ += gone + fresh;
  change_ = {0, 0};
}

/// The largest distance, in largest radii, at which the neighbourhood of a disk of the given radius is near one of a layer.
double NeighbourLists::reach(float radius, const NeighbourhoodCells& layer) const {
  return (static_cast<double>(radius) + static_cast<double>(layer.largest_radius()) + 2.0 * h_) * (1.0 + search_slack);
}

/// The cells of a layer in which there may be neighbourhoods near one of a disk of the given radius.
CellRange NeighbourLists::range_around(NeighbourhoodCentre centre, float radius, const NeighbourhoodCells& layer) const {
  const double to = reach(radius, layer);
  return layer.around(centre, {to * steps_[0] + 8.0, to * steps_[1] + 8.0});
}

/// Fills found_ with the disks near the present neighbourhood of disk i.
void NeighbourLists::search(std::int32_t i) {
  const NeighbourQuery query{i, radius(i), centre(i)};
  found_count_ = 0;
  for (const NeighbourhoodCells& layer : layers_) {
    const CellRange range = range_around(query.centre, query.radius, layer);
    if (cells_.size() < NeighbourhoodCells::cells_in(range) + 12) cells_.resize(NeighbourhoodCells::cells_in(range) + 12);
    // Room for eight disks of every block, those that follow full ones included.
    const std::size_t most = found_count_ + 8 * (NeighbourhoodCells::cells_in(range) + layer.spilled()) + 16;
    if (found_.size() < most) found_.resize(most), fresh_.resize(most);
    const std::size_t cells = NeighbourhoodCells::list_cells(range, cells_.data());
    std::int32_t* const end =
        kernel_->search(layer.blocks(), layer.next(), cells_.data(), cells, query, nearness_, found_.data() + found_count_);
    found_count_ = static_cast<std::size_t>(end - found_.data());
  }
  if (sliding_ && sliding_->by_edge(query.centre)) search_across(query);
}

/// Corrects what search() has found for a neighbourhood near an edge past which images slide.
void NeighbourLists::search_across(const NeighbourQuery& query) {
  const std::int32_t upwards = query.centre.y > 0 ? 1 : -1;
  const auto beyond = [&](std::int32_t j) { return boxes_between(query.centre.y, centre(j).y) != 0; };
  const auto end = found_.begin() + static_cast<std::ptrdiff_t>(found_count_);
  found_.resize(static_cast<std::size_t>(std::remove_if(found_.begin(), end, beyond) - found_.begin()));
  for (const NeighbourhoodCells& layer : layers_) {
    const NeighbourhoodCentre from = sliding_->as_seen_from_beyond(query.centre, upwards);
    const double to = reach(query.radius, layer);
    const CellRange range = layer.around(from, {(to + sliding_->way()) * steps_[0] + 8.0, to * steps_[1] + 8.0});
    layer.for_each(range, [&](std::int32_t j, NeighbourhoodCentre at, float radius) {
      if (j != query.id && boxes_between(query.centre.y, at.y) == upwards && near(query.centre, query.radius, at, radius))
        found_.push_back(j);
    });
  }
  found_count_ = found_.size();
  found_.resize(found_count_ + 16);  // which may be read
  fresh_.resize(found_.size());
}

void NeighbourLists::slide(std::int64_t displacement, double way) {
  if (!sliding_) sliding_.emplace(std::array{1.0 / steps_[0], 1.0 / steps_[1]});
  sliding_->set_way(static_cast<std::int32_t>(displacement >> 32), way / largest_);
  if (layers_.empty()) return;
  sliding_->set_neighbourhoods(2.0 * h_, 2.0 * (1.0 + h_));
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(around_.disks()); ++i) {
    if (!sliding_->by_edge(centre(i))) continue;
    search(i);
    around_.assign(i, found());
  }
}

void NeighbourLists::prefetch_cells(std::int32_t i, NeighbourhoodCentre to) const {
  const NeighbourhoodCells& layer = layers_[layer_of(i)];
  layer.prefetch_blocks(range_around(to, radius(i), layer));
  for (std::uint32_t k = 0; k < count(i); ++k) prefetch_list_early(ids(i)[k]);
}

bool NeighbourLists::near(std::int32_t i, std::int32_t j) const { return near(centre(j), radius(j), centre(i), radius(i)); }

bool NeighbourLists::near(NeighbourhoodCentre a, float radius_a, NeighbourhoodCentre b, float radius_b) const {
  if (sliding_ && boxes_between(a.y, b.y) != 0) return sliding_->near(a, radius_a, b, radius_b);
  return kernel_->near(a, radius_a, b, radius_b, nearness_);
}

std::uint32_t NeighbourLists::median_count() const {
  if (around_.disks() == 0) return 0;
  std::vector<std::uint32_t> counts(around_.disks());
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = count(static_cast<std::int32_t>(i));
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

std::uint64_t NeighbourLists::entries() const {
  std::uint64_t sum = 0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(around_.disks()); ++i) sum += count(i);
  return sum;
}

std::size_t NeighbourLists::bytes() const {
  std::size_t sum = around_.bytes() + (one_radius_ ? 0 : radius_.capacity() * sizeof(float)) + layer_of_.capacity();
  for (const NeighbourhoodCells& layer : layers_) sum += layer.bytes();
  return sum;
}

}  // namespace carom
