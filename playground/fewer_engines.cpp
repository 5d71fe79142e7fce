// The textbook engine is here in double precision alone: it runs what no other engine covers. The other widths are for studies of
// rounding, and would make the page larger; that of 113 bits is no literal type for this compiler either.
#include "simulation/make_textbook.hpp"

#include <memory>
#include <stdexcept>

namespace carom::detail {

template <>
std::unique_ptr<AnyEngine> make_textbook<float>(const Scene&, const Disks&, State) {
  throw std::invalid_argument("the engine \"textbook-float\" is not in this page");
}
template <>
std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene&, const Disks&, State) {
  throw std::invalid_argument("the engine \"textbook-long-double\" is not in this page");
}
template <>
std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Disks&, State) {
  throw std::invalid_argument("the engine \"textbook-quad\" is not in this page");
}

}  // namespace carom::detail
