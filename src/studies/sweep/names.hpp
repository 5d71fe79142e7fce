#pragma once
// Names of a sweep's points: readable, fit for any file system, the same every time.

#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Returns the shortest endings that still tell dotted keys apart: "radius" for "disks.0.radius" where no other key ends so, else
/// "0.radius" and "1.radius".
[[nodiscard]] std::vector<std::string> short_keys(const std::vector<std::string>& keys);

/// Returns text such as "radius=0.1_boundary=periodic" from short keys and values in TOML. What file systems or shells may mind
/// becomes "-", and a long value its beginning and a hash of all of it. Absent values (empty) are left out; "scene" where all
/// are.
[[nodiscard]] std::string point_name(const std::vector<std::string>& short_keys, const std::vector<std::string>& values);

/// Returns whether a user may call a point so: letters, digits and . _ = + -, a letter or a digit first, at most 100 of them.
[[nodiscard]] bool is_point_name(std::string_view name);

}  // namespace carom
