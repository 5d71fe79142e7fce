#pragma once
// The guarded method in O(N) per step: a list of close pairs, found through a grid of cells, that holds until disks may have
// moved by the list's margin. The pairs in contact are those that a search of all pairs finds, taken in the same order, so the
// trajectory is that of guarded.hpp to the last bit.

#include "stepper/bodies.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class ClosePairs {
 public:
  ClosePairs(const Bodies& bodies, double dt);

  /// Returns the approximate number of disk pairs that a step examines.
  [[nodiscard]] static double work(double disks) { return 8 * disks; }

  /// Updates the grid after a move. `farthest` is the longest distance that a disk went in it.
  void moved(const Bodies& bodies, double farthest);

  /// Calls `contact` for pairs, as AllPairs::for_contacts() does.
  template <class Contact>
  void for_contacts(const Bodies& bodies, Contact contact) {
    find_contacts(bodies);
    for (const Touching& pair : touching_) contact(pair.i, pair.j, pair.r);
  }
  [[nodiscard]] std::size_t bytes() const {
    return (first_.capacity() + cell_.capacity()) * sizeof(std::uint32_t) + sorted_.capacity() * sizeof(Sorted) +
           close_.capacity() * sizeof(Close) + touching_.capacity() * sizeof(Touching);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(margin_, approached_, cells_[0], cells_[1], per_length_, first_, sorted_, cell_, close_, pairs_);
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

  void find_contacts(const Bodies& bodies);
  void rebuild(const Bodies& bodies);
  void sort_into_cells(const Bodies& bodies);
  void add_close(const Bodies& bodies, std::size_t a, std::size_t begin, std::size_t end);
  [[nodiscard]] std::size_t cell_of(const Bodies& bodies, const Vec2<double>& r) const;

  double margin_ = 0.0;      ///< pairs with a gap below this are in the list
  double approached_ = 0.0;  ///< by how much two disks may have come nearer since it was made
  std::size_t cells_[2] = {1, 1};
  Vec2<double> per_length_;           ///< cells per unit of length
  std::vector<std::uint32_t> first_;  ///< of each cell, in `sorted_`; one more at the end
  std::vector<Sorted> sorted_;        ///< disks, cell by cell
  std::vector<std::uint32_t> cell_;   ///< of each disk
  std::vector<Close> close_;          ///< the list is the first `pairs_` of it
  std::size_t pairs_ = 0;
  std::vector<Touching> touching_;
};

}  // namespace carom
