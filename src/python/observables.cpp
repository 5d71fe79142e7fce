#include "python/parts.hpp"
namespace carom::python {
void add_observables(nanobind::module_&) {}
}  // namespace carom::python
