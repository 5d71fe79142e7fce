#include "python/parts.hpp"
namespace carom::python {
void add_runs(nanobind::module_&) {}
}  // namespace carom::python
