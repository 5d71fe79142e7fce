// The engine of 113 bits is left out: Boost's software numbers are no literal type for this compiler, and a page is no place to
// wait for them.
#include "simulation/make_textbook.hpp"

#include <stdexcept>

namespace carom::detail {

template <>
std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Disks&, State) {
  throw std::invalid_argument("the engine \"textbook-quad\" is not in this page");
}

}  // namespace carom::detail
