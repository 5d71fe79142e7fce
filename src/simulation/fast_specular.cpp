#include "effects/specular.hpp"
#include "simulation/make_fast_engine.hpp"

namespace carom::detail {
template std::unique_ptr<AnyEngine> make_fast_engine<Specular>(const Scene& scene, const Disks& disks, State start);
}  // namespace carom::detail
