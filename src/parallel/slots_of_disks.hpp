#pragma once
// Which slot of a domain has the disk with an id: an array over all ids, as long as that is not much longer than the domain has
// slots; else a hash table with open addressing, since each of many domains would have an array as long as the box has disks.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class SlotsOfDisks {
 public:
  /// A table for ids below `ids` that has room for `most` disks.
  SlotsOfDisks(std::size_t ids, std::size_t most)
      : by_id_(ids <= 4 * most ? ids : 0, -1), hashed_(ids <= 4 * most ? 0 : most + most / 2 + 1) {}

  /// Returns the slot of the disk with that id, -1 where it has none. O(1).
  [[nodiscard]] std::int32_t find(std::int32_t disk) const {
    return hashed_.empty() ? by_id_[static_cast<std::size_t>(disk)] : hashed_[place_of(disk)].slot;
  }
  /// Notes the slot of a disk that has none. Requires room for it.
  void insert(std::int32_t disk, std::int32_t slot) {
    if (hashed_.empty())
      by_id_[static_cast<std::size_t>(disk)] = slot;
    else
      hashed_[place_of(disk)] = {disk, slot};
  }
  /// Takes all slots from their disks.
  void clear() {
    by_id_.assign(by_id_.size(), -1);
    hashed_.assign(hashed_.size(), Entry{});
  }

  [[nodiscard]] std::size_t bytes() const {
    return by_id_.capacity() * sizeof(std::int32_t) + hashed_.capacity() * sizeof(Entry);
  }

 private:
  struct Entry {
    std::int32_t disk = -1;
    std::int32_t slot = -1;
  };

  /// The place of a disk, or the free one where it would be.
  [[nodiscard]] std::size_t place_of(std::int32_t disk) const {
    const std::uint32_t hash = static_cast<std::uint32_t>(disk) * 0x9E3779B9U;
    auto place = static_cast<std::size_t>(hash * static_cast<std::uint64_t>(hashed_.size()) >> 32);
    while (hashed_[place].disk != disk && hashed_[place].disk >= 0)
      if (++place == hashed_.size()) place = 0;
    return place;
  }

  std::vector<std::int32_t> by_id_;
  std::vector<Entry> hashed_;
};

}  // namespace carom
