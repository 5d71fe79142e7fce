#pragma once
// Disks in flight as the engine keeps them: straight lines in space and time, in fixed-point coordinates.
//
// A line stays as it is until the next collision: position = x + v t with t the time since the epoch, so there is
// nothing to bring up to date when other disks move on. Coordinates are 64-bit integers. On a periodic axis the whole range is
// one box length, so that the difference of two coordinates, wrapping as integers do, *is* the nearest image; and the resolution,
// 2^-64 of a box length, is the same everywhere.

#include <cstdint>

namespace carom {

/// A disk among equals: half a cache line.
struct alignas(32) Flight {
  std::int64_t x[2];  ///< position at the epoch, in units of FixedAxis::unit from the middle of the box
  double v[2];        ///< length / time
};

/// A disk among disks of other sizes or masses: one cache line.
struct alignas(64) SizedFlight {
  std::int64_t x[2];
  double v[2];
  double radius;
  double mass;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(x, v, radius, mass);
  }
};

/// A disk of a mixture whose diameters are not additive: one cache line.
struct alignas(64) MixedFlight {
  std::int64_t x[2];
  double v[2];
  double radius;
  double mass;
  std::int32_t species;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(x, v, radius, mass, species);
  }
};

/// Returns a - b as integers that wrap: the nearest image on a periodic axis.
[[nodiscard]] inline std::int64_t wrapped_difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

/// Returns, from the upper halves of two coordinates, how many boxes the image of b nearest to a lies above b: -1, 0 or 1.
[[nodiscard]] inline std::int32_t boxes_between(std::int32_t a, std::int32_t b) {
  const std::int64_t apart = std::int64_t{a} - std::int64_t{b};
  const auto nearest = static_cast<std::int32_t>(static_cast<std::uint32_t>(apart));
  return static_cast<std::int32_t>((apart - nearest) / (std::int64_t{1} << 32));
}

}  // namespace carom
