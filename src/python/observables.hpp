#pragma once
// Observables that are written in Python, and what observables have measured.

#include <carom/observe.hpp>

#include <nanobind/nanobind.h>

#include <exception>
#include <functional>
#include <memory>
#include <vector>

namespace carom::python {

/// A tuple as type checkers see it.
using AnyTuple = nanobind::typed<nanobind::tuple, nanobind::any, nanobind::ellipsis>;

/// A function that is given what sample(), collisions() or finish() of an observable has thrown. The observable is not called
/// again then, has no results, and is no longer saved.
using ObservableFailed = std::function<void(std::exception_ptr)>;

/// Returns an observable that calls the methods of a carom.Observable: name, step, needs_positions and follows_collisions once,
/// the others as the library calls its own. Collisions come in batches. Requires the interpreter's lock. Without `failed`, what
/// they throw reaches the caller.
[[nodiscard]] std::unique_ptr<Observable> observable_of(const nanobind::object& object, ObservableFailed failed = {});

/// Returns what was measured as plain tuples, of which carom._measured makes numbers and tables: (name, note, scalars, tables), a
/// scalar being (name, value, error, unit, time, note) and a table (name, [(column, unit, array)]).
[[nodiscard]] nanobind::typed<nanobind::list, AnyTuple> tuples_of(const std::vector<Measurement>& measurements);

}  // namespace carom::python
