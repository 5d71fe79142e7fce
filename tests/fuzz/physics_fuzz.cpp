// Bytes become a small scene with any effects and extreme numbers; every engine that covers it must stay sound, and all must
// agree.

#include "support/decoded_scene.hpp"
#include "support/engine_agreement.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = carom::test::decoded_scene({data, size});
  try {
    const carom::Scene scene = carom::parse_scene(text);
    if (const std::string fault = carom::test::disagreement(scene); !fault.empty()) {
      std::fprintf(stderr, "%s\n%s\n", text.c_str(), fault.c_str());
      std::abort();
    }
  } catch (const carom::SceneError&) {  // refused, in a sentence
  }
  return 0;
}
