#include "stepper/grid.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Returns the margin, in diameters, at which looking at the pairs of the list and making it anew cost least together. Per disk
/// and step the first takes about 2 ns for each of the rho pi (sigma + margin)^2 / 2 pairs of a disk, the second 80 ns every
/// margin / (2 v_max dt) steps; only their ratio matters, and not much.
double best_margin(double density, double sigma, double farthest, double smallest) {
  double best = smallest / sigma, least = 1e300;
  for (double margin = std::max(0.05, smallest / sigma); margin < 1.5; margin *= 1.15) {
    const double reach = sigma * (1.0 + margin);
    const double steps = std::max(1.0, std::floor(margin * sigma / (2.0 * farthest)));
    const double cost = density * reach * reach * 1.57 * 2.0 + 80.0 / steps;
    if (cost < least) {
      least = cost;
      best = margin;
    }
  }
  return best * sigma;
}

}  // namespace

ClosePairs::ClosePairs(const Bodies& bodies, double dt, double least_margin) : least_margin_(least_margin) {
  sorted_.resize(bodies.count());
  cell_.resize(bodies.count());
  if (bodies.count() == 0) return;
  tune(bodies, bodies.fastest(), dt);
  rebuild(bodies);
}

/// Chooses margin and cells for flights for `time` of disks as fast as that.
void ClosePairs::tune(const Bodies& bodies, double fastest, double time) {
  tuned_for_ = fastest * time;
  const double sigma = 2.0 * *std::max_element(bodies.radius.begin(), bodies.radius.end());
  const double density = static_cast<double>(bodies.count()) / bodies.domain.length.prod();
  margin_ = best_margin(density, sigma, tuned_for_, least_margin_ * tuned_for_);
  farthest_squared_ = 0.25 * margin_ * margin_ * (1.0 - 1e-9);
  // Cells no narrower than the reach of a pair, and not more than a few per disk. Where fewer than three would go round a
  // periodic axis, one is all.
  const double width = std::max(sigma + margin_, 0.5 / std::sqrt(density));
  for (int axis = 0; axis < 2; ++axis) {
    const double most = std::floor(bodies.domain.length[axis] / width * (1.0 - 1e-9));
    const double fewest = bodies.domain.periodic[axis] ? 3.0 : 1.0;
    cells_[axis] = most < fewest ? 1 : static_cast<std::size_t>(std::min(most, 4.0 * static_cast<double>(bodies.count()) + 1.0));
    per_length_[axis] = static_cast<double>(cells_[axis]) / bodies.domain.length[axis];
  }
  first_.resize(cells_[0] * cells_[1] + 1);
}

double ClosePairs::room(const Bodies& bodies) const {
  double farthest = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) farthest = std::max(farthest, bodies.squared_distance(bodies.r[i], built_[i]));
  return farthest <= farthest_squared_ ? std::sqrt(farthest_squared_) - std::sqrt(farthest) : -1.0;
}

void ClosePairs::moved(const Bodies& bodies, double time) {
  if (room(bodies) >= 0.0) return;
  const double fastest = bodies.fastest();
  if (fastest * time > 1.2 * tuned_for_) tune(bodies, fastest, time);
  rebuild(bodies);
}

void ClosePairs::about_to_move(const Bodies& bodies, double time, double fastest) {
  if (bodies.count() == 0 || fastest * time <= room(bodies) * (1.0 - 1e-9)) return;
  if (fastest * time > 1.2 * tuned_for_) tune(bodies, fastest, time);
  rebuild(bodies);
}

/// Disks beyond a wall count as in the cell next to it.
std::size_t ClosePairs::cell_of(const Bodies& bodies, const Vec2<double>& r) const {
  std::size_t place[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double cells = (r[axis] - bodies.domain.lower[axis]) * per_length_[axis];
    place[axis] = static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(cells_[axis] - 1)));
  }
  return place[0] + cells_[0] * place[1];
}

void ClosePairs::rebuild(const Bodies& bodies) {
  built_ = bodies.r;
  near_is_made_ = false;
  sort_into_cells(bodies);
  pairs_ = 0;
  const bool round_x = bodies.domain.periodic[0] && cells_[0] > 1, round_y = bodies.domain.periodic[1] && cells_[1] > 1;
  for (std::size_t y = 0; y < cells_[1]; ++y) {
    const std::size_t row = cells_[0] * y, row_above = y + 1 < cells_[1] ? row + cells_[0] : 0;
    const bool has_above = y + 1 < cells_[1] || round_y;
    for (std::size_t x = 0; x < cells_[0]; ++x) {
      // Half of what is around: the cell to the right, and the three above, which follow one another but at the edge.
      const std::size_t left = x > 0 ? x - 1 : 0, right = std::min(x + 1, cells_[0] - 1);
      const std::size_t end = first_[row + x + 1];
      for (std::size_t a = first_[row + x]; a < end; ++a) {
        add_close(bodies, a, a + 1, first_[row + right + 1]);
        if (x == cells_[0] - 1 && round_x) add_close(bodies, a, first_[row], first_[row + 1]);
        if (!has_above) continue;
        add_close(bodies, a, first_[row_above + left], first_[row_above + right + 1]);
        if (x == cells_[0] - 1 && round_x) add_close(bodies, a, first_[row_above], first_[row_above + 1]);
        if (x == 0 && round_x) add_close(bodies, a, first_[row_above + cells_[0] - 1], first_[row_above + cells_[0]]);
      }
    }
  }
}

/// Counting sort.
void ClosePairs::sort_into_cells(const Bodies& bodies) {
  std::fill(first_.begin(), first_.end(), 0U);
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    cell_[i] = static_cast<std::uint32_t>(cell_of(bodies, bodies.r[i]));
    ++first_[cell_[i]];
  }
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_) first = end += first;
  for (std::size_t i = bodies.count(); i-- > 0;)  // from behind: the ends of the cells become their beginnings
    sorted_[--first_[cell_[i]]] = {bodies.r[i], bodies.radius[i], static_cast<std::uint32_t>(i)};
}

/// Disk `a` of the sorted ones with those in [begin, end). Every pair is written and the close ones are kept: a guess of which
/// are close would be wrong every third time.
void ClosePairs::add_close(const Bodies& bodies, std::size_t a, std::size_t begin, std::size_t end) {
  if (begin >= end) return;
  if (close_.size() < pairs_ + (end - begin)) close_.resize(2 * (pairs_ + (end - begin)));
  const Sorted& mine = sorted_[a];
  for (std::size_t b = begin; b < end; ++b) {
    const Sorted& other = sorted_[b];
    const double sigma = mine.radius + other.radius;
    const double reach = sigma + margin_;
    close_[pairs_] = {std::min(mine.disk, other.disk), std::max(mine.disk, other.disk), sigma * sigma};
    pairs_ += bodies.squared_distance(mine.r, other.r) <= reach * reach ? 1U : 0U;
  }
}

/// Counting sort of the list by one disk of a pair and by the other.
void ClosePairs::list_both_ways() {
  near_is_made_ = true;
  first_near_.assign(cell_.size() + 1, 0U);
  near_.resize(2 * pairs_);
  for (std::size_t p = 0; p < pairs_; ++p) {
    ++first_near_[close_[p].i];
    ++first_near_[close_[p].j];
  }
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_near_) first = end += first;
  for (std::size_t p = 0; p < pairs_; ++p) {
    near_[--first_near_[close_[p].i]] = {close_[p].j, close_[p].sigma_squared};
    near_[--first_near_[close_[p].j]] = {close_[p].i, close_[p].sigma_squared};
  }
}

void ClosePairs::find_contacts(const Bodies& bodies) {
  touching_.clear();
  for (std::size_t p = 0; p < pairs_; ++p) {
    const Close& pair = close_[p];
    if (bodies.squared_distance(bodies.r[pair.i], bodies.r[pair.j]) < pair.sigma_squared)
      touching_.push_back({pair.i, pair.j, bodies.separation(bodies.r[pair.i], bodies.r[pair.j])});
  }
  std::sort(touching_.begin(), touching_.end(),
            [](const Touching& a, const Touching& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
}

}  // namespace carom
