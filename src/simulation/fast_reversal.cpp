#include "effects/reversal.hpp"
#include "simulation/make_fast_engine.hpp"

namespace carom::detail {
template std::unique_ptr<AnyEngine> make_fast_engine<Reversal>(const Scene& scene, const Disks& disks, State start);
}  // namespace carom::detail
