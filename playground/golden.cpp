// Compares the final states of example scenes, computed by WebAssembly, with tests/golden/hashes.txt. Run by node, with the
// checkout as its argument; prints a line for each hash that differs, and ends with 1 then.

#include "golden/run_hash.hpp"

#include <cstdio>
#include <fstream>
#include <string>

int main(int count, char** arguments) {
  const std::string root = count > 1 ? arguments[1] : "..";
  std::ifstream file(root + "/tests/golden/hashes.txt");
  int compared = 0, differing = 0;
  for (std::string scene, engine, recorded; file >> scene >> engine >> recorded;) {
    ++compared;
    const std::string hash = carom::test::hash_of_run(carom::load_scene(root + "/docs/scenes/" + scene + ".toml"), engine);
    if (hash == recorded) continue;
    ++differing;
    std::printf("%s %s: %s here, %s recorded\n", scene.c_str(), engine.c_str(), hash.c_str(), recorded.c_str());
  }
  std::printf("%d of %d golden hashes are equal\n", compared - differing, compared);
  return compared > 0 && differing == 0 ? 0 : 1;
}
