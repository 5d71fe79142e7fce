#pragma once
// Bytes that ranks send each other (carom/ranks.hpp): numbers, texts and lists of records one behind the other, as they lie in
// memory. All ranks are the same program, so what one puts in, another takes out in the same order.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace carom {

class Packet {
 public:
  template <class Record>
  void put(const Record& record) {
    put_all(std::span(&record, 1));
  }
  /// Puts records in without their number.
  template <class Record>
  void put_all(std::span<const Record> records) {
    static_assert(std::is_trivially_destructible_v<Record>);
    bytes_.append(reinterpret_cast<const char*>(records.data()), records.size_bytes());
  }
  /// Puts records in behind their number.
  template <class Record>
  void put_list(const std::vector<Record>& records) {
    put(static_cast<std::uint64_t>(records.size()));
    put_all(std::span<const Record>(records));
  }

  [[nodiscard]] std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads a packet, which must outlive it.
class PacketReader {
 public:
  explicit PacketReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  template <class Record>
  [[nodiscard]] Record take() {
    Record record{};
    copy(&record, sizeof record);
    return record;
  }
  /// Takes so many records.
  template <class Record>
  void take_all(std::size_t count, std::vector<Record>& records) {
    records.resize(count);
    copy(records.data(), count * sizeof(Record));
  }
  /// Takes records that put_list() has put in.
  template <class Record>
  void take_list(std::vector<Record>& records) {
    take_all(take<std::uint64_t>(), records);
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace carom
