#pragma once
// What cannot be read or written to begin with is the user's to mend: exit code 2, and nothing was done.

#include "cli/commands.hpp"
#include "io/output_error.hpp"

namespace carom::cli {

/// Does `action`, whose OutputError becomes a UsageError of the same sentence.
template <class Action>
auto before_anything(Action action) -> decltype(action()) {
  try {
    return action();
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace carom::cli
