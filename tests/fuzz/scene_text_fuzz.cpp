// Bytes as a scene's text: it is read or refused in a sentence with its place, and what was read is the same when it is written
// down and read again.

#include <carom/scene.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  carom::Scene scene;
  try {
    scene = carom::parse_scene(text, "fuzz.toml", {}, "/nonexistent");
  } catch (const carom::SceneError&) {
    return 0;
  }
  const std::string once = carom::resolved_toml(scene);
  const std::string twice = carom::resolved_toml(carom::parse_scene(once, "resolved.toml", {}, "/nonexistent"));
  if (once != twice) {
    std::fprintf(stderr, "%s\nis read as\n%s\n", once.c_str(), twice.c_str());
    std::abort();
  }
  return 0;
}
