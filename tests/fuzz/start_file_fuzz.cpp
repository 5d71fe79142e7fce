// Bytes as a start file, CSV or .npy by how they begin: it is read or refused in a sentence, and every number that was read is
// finite.

#include "scene/start_file.hpp"

#include <carom/scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto file = carom::detail::parse_start_file(text, "fuzz.csv");
    const auto finite = [](const auto& place) { return place.allFinite(); };
    const auto positive = [](double number) { return number > 0.0 && std::isfinite(number); };
    const bool sound = std::all_of(file.positions.begin(), file.positions.end(), finite) &&
                       std::all_of(file.velocities.begin(), file.velocities.end(), finite) &&
                       std::all_of(file.radii.begin(), file.radii.end(), positive) &&
                       std::all_of(file.masses.begin(), file.masses.end(), positive);
    if (!sound) std::abort();
  } catch (const carom::SceneError&) {
  }
  return 0;
}
