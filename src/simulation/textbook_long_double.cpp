#include "simulation/make_textbook.hpp"

namespace carom::detail {
template std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene& scene, const Disks& disks, State start);
}  // namespace carom::detail
