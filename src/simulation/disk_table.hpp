#pragma once

#include "core/all_equal.hpp"
#include "scene/contact_scales.hpp"

#include <carom/collisions.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace carom {

/// The table of disks that have these ids in an engine's slots.
[[nodiscard]] inline std::shared_ptr<const DiskTable> disk_table(std::vector<std::int32_t> ids, const Disks& disks,
                                                                 const Effects& effects) {
  const auto one_if_equal = [](const std::vector<double>& values) {
    return !values.empty() && all_equal(values) ? std::vector<double>{values.front()} : values;
  };
  DiskTable table{std::move(ids), one_if_equal(disks.radius), one_if_equal(disks.mass)};
  if (const ContactScales<double> scales = contact_scales<double>(effects, disks); !scales.additive()) {
    table.species = disks.species;
    table.kinds = static_cast<std::size_t>(scales.kinds());
    table.contact_scales.assign(scales.rows(), scales.rows() + table.kinds * table.kinds);
  }
  return std::make_shared<const DiskTable>(std::move(table));
}

}  // namespace carom
