#include "python/parts.hpp"
namespace carom::python {
void add_studies(nanobind::module_&) {}
}  // namespace carom::python
