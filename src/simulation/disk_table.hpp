#pragma once

#include "core/all_equal.hpp"

#include <carom/collisions.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace carom {

/// The table of disks that have these ids in an engine's slots.
[[nodiscard]] inline std::shared_ptr<const DiskTable> disk_table(std::vector<std::int32_t> ids, const Disks& disks) {
  const auto one_if_equal = [](const std::vector<double>& values) {
    return !values.empty() && all_equal(values) ? std::vector<double>{values.front()} : values;
  };
  return std::make_shared<const DiskTable>(DiskTable{std::move(ids), one_if_equal(disks.radius), one_if_equal(disks.mass)});
}

}  // namespace carom
