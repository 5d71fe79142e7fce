#pragma once
// Close pairs in O(N) per step: a list of pairs, found through a grid of cells, that holds until a disk is farther than half the
// list's margin from where it was when the list was made. The method "grid" is guarded.hpp with this list: the pairs in contact
// are those that a search of all pairs finds, taken in the same order, so its trajectory is that of "guarded" to the last bit.

#include "stepper/bodies.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class ClosePairs {
 public:
  /// Makes a list for steps of dt. Its margin is at least `least_margin` times what the fastest disk goes in a step.
  ClosePairs(const Bodies& bodies, double dt, double least_margin = 0.0);

  /// Returns the approximate number of disk pairs that a step examines.
  [[nodiscard]] static double work(double disks) { return 8 * disks; }

  /// Makes the list anew if a disk has strayed. All have just flown for `time`.
  void moved(const Bodies& bodies, double time);

  /// Makes the list anew if a disk may have strayed or may do so in a coming flight for `time`, in which none is faster than
  /// `fastest`. Requires flights shorter than half the box along periodic axes.
  void about_to_move(const Bodies& bodies, double time, double fastest);

  /// Returns whether disk i is too far from where it was for the list to have all pairs of it that are in contact.
  [[nodiscard]] bool strayed(const Bodies& bodies, std::size_t i) const {
    return bodies.squared_distance(bodies.r[i], built_[i]) > farthest_squared_;
  }

  /// Calls `contact` for pairs, as AllPairs::for_contacts() does.
  template <class Contact>
  void for_contacts(const Bodies& bodies, Contact contact) {
    find_contacts(bodies);
    for (const Touching& pair : touching_) contact(pair.i, pair.j, pair.r);
  }

  /// Calls look(i, j, sigma^2) for all pairs of the list, in no particular order.
  template <class Look>
  void for_pairs(Look look) const {
    for (std::size_t p = 0; p < pairs_; ++p) look(close_[p].i, close_[p].j, close_[p].sigma_squared);
  }

  /// Calls look(j, sigma^2) for every disk j != i that may be in contact with disk i, unless one of them has strayed.
  template <class Look>
  void for_near(std::uint32_t i, Look look) {
    if (!near_is_made_) list_both_ways();
    for (std::uint32_t k = first_near_[i]; k < first_near_[i + 1]; ++k) look(near_[k].j, near_[k].sigma_squared);
  }

  [[nodiscard]] std::size_t bytes() const {
    return (first_.capacity() + cell_.capacity() + first_near_.capacity()) * sizeof(std::uint32_t) +
           near_.capacity() * sizeof(Near) + sorted_.capacity() * sizeof(Sorted) + built_.capacity() * sizeof(Vec2<double>) +
           close_.capacity() * sizeof(Close) + touching_.capacity() * sizeof(Touching);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(margin_, tuned_for_, farthest_squared_, cells_[0], cells_[1], per_length_, first_, sorted_, cell_, built_, close_,
            pairs_);
  }

 private:
  struct Close {
    std::uint32_t i, j;  ///< i < j
    double sigma_squared;
  };
  struct Sorted {
    Vec2<double> r;
    double radius;
    std::uint32_t disk;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(r, radius, disk);
    }
  };
  struct Touching {
    std::uint32_t i, j;
    Vec2<double> r;
  };
  struct Near {
    std::uint32_t j;
    double sigma_squared;
  };

  /// Returns how far any disk may still go without having strayed; negative where one has.
  [[nodiscard]] double room(const Bodies& bodies) const;
  void tune(const Bodies& bodies, double fastest, double time);
  void find_contacts(const Bodies& bodies);
  void rebuild(const Bodies& bodies);
  void list_both_ways();
  void sort_into_cells(const Bodies& bodies);
  void add_close(const Bodies& bodies, std::size_t a, std::size_t begin, std::size_t end);
  [[nodiscard]] std::size_t cell_of(const Bodies& bodies, const Vec2<double>& r) const;

  double least_margin_;            ///< in flights of the fastest disk
  double margin_ = 0.0;            ///< pairs with a gap below this are in the list
  double tuned_for_ = 0.0;         ///< the longest flight in a step that the margin is made for
  double farthest_squared_ = 0.0;  ///< square of how far a disk may go until the list is made anew
  std::size_t cells_[2] = {1, 1};
  Vec2<double> per_length_;           ///< cells per unit of length
  std::vector<std::uint32_t> first_;  ///< of each cell, in `sorted_`; one more at the end
  std::vector<Sorted> sorted_;        ///< disks, cell by cell
  std::vector<std::uint32_t> cell_;   ///< of each disk
  std::vector<Vec2<double>> built_;   ///< positions for which the list was made
  std::vector<Close> close_;          ///< the list is the first `pairs_` of it
  std::size_t pairs_ = 0;
  std::vector<Touching> touching_;
  bool near_is_made_ = false;              ///< whether the next two belong to the list; they are made when they are needed
  std::vector<std::uint32_t> first_near_;  ///< of each disk, in `near_`; one more at the end
  std::vector<Near> near_;
};

}  // namespace carom
