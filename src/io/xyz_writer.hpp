#pragma once
// trajectory.xyz: extended XYZ that OVITO reads. Disks lie in the plane z = 0 of a box as thick as the largest disk; the
// species of a scene are called H, He, Li, ... in their order, because readers expect chemical symbols.

#include "io/text_file.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// H, He, Li, ...; from the 119th species on they are used again from the first.
std::string_view chemical_symbol(std::int32_t species);

/// Every number is written with the fewest digits that read back as the same double.
class XyzWriter {
 public:
  /// `kept`: goes on after so many bytes of a file that is there.
  XyzWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, std::optional<std::uint64_t> kept = {});

  void sample(const State& state);  ///< positions are written as they are, radii as they have grown
  void flush() { file_.flush(); }
  void close() { file_.close(); }

  [[nodiscard]] std::uint64_t written() const { return file_.written(); }
  [[nodiscard]] std::size_t buffered_bytes() const { return file_.buffered_bytes(); }

 private:
  struct Kind {  ///< of equal disks
    double radius;
    double mass;
  };
  void describe_box(const State& state);
  void describe_kinds(double scale);

  detail::TextFile file_;
  Box box_;
  double diameter_;            ///< diameter of the largest disk at scale 1
  double displacement_ = 0.0;  ///< of the images above, of which head_ tells
  std::string head_;           ///< the comment line up to the time
  std::vector<Kind> kinds_;
  double tails_scale_ = 1.0;        ///< for which tails_ are
  std::vector<std::string> tails_;  ///< per kind: " radius mass "
  std::vector<std::size_t> tail_;   ///< per disk, which of them
  std::vector<std::int32_t> species_;
};

}  // namespace carom
