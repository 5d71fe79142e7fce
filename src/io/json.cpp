#include "io/json.hpp"

#include "core/instructions.hpp"

#include <carom/version.hpp>

namespace carom::detail {

nlohmann::ordered_json build_json() {
  const BuildInfo& build = build_info();
  return {{"version", build.version},
          {"commit", build.commit},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"instructions", name_of(chosen_instructions())}};
}

}  // namespace carom::detail
